//! The numbers of realisations that a recorded request asks for.

use super::table::{MOST_SEEDS, SEEDS, UNTIL_INTERVAL};
use crate::study::realisations::{PILOTS, RealisationCount};
use serde_json::{Map, Value};

/// How many realisations the rows of `request` have; `None` where a row is one run.
pub(crate) fn asked(request: &Map<String, Value>) -> Option<RealisationCount> {
    let number = |key: &str| request.get(key).and_then(Value::as_u64);
    let share = request.get(UNTIL_INTERVAL).and_then(Value::as_f64);
    match (number(SEEDS), share, number(MOST_SEEDS)) {
        (Some(count), ..) => Some(RealisationCount::Exactly(count)),
        (None, Some(share), Some(most)) => Some(RealisationCount::Within { share, most, most_time: None }),
        _ => None,
    }
}

/// A number of realisations in words: `6 realisations`.
pub(crate) fn in_words(count: RealisationCount) -> String {
    match count {
        RealisationCount::Exactly(count) => format!("{count} realisations"),
        RealisationCount::Within { .. } => format!("{PILOTS} or more realisations"),
    }
}
