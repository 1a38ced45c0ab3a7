//! The table of the effects of keys that are varied one at a time.

use crate::cli::pipeline::Answer;
use crate::error::amount;
use crate::output::realisations::with_interval;
use crate::output::table::Table;
use crate::study::realisations::RealisationCount;
use crate::sweep::{Effect, in_words};

/// Most lines of the table.
const MOST_LINES: usize = 40;

/// Shows the effects, by measure and place, the widest bar first.
pub(super) fn show_effects(answer: &mut Answer, effects: &[Effect], seeds: Option<RealisationCount>) {
    let number = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| amount(x, 5));
    let row = |one: &Effect| {
        let [low, high] = one.bounds.map(|bound| amount(bound, 6));
        let effect = one.effect.map_or_else(|| "-".to_owned(), |x| with_interval(x, one.half_width_95));
        let seen = if one.is_seen() { "" } else { "not distinguished from none" };
        let [at_low, at_high] = one.at.map(number);
        vec![one.column.clone(), one.key.clone(), low, high, at_low, at_high, effect, seen.to_owned()]
    };
    let header = ["measure", "key", "low", "high", "at low", "at high", "effect", ""];
    let every = effects.iter().all(Effect::is_seen);
    let cut = |mut cells: Vec<String>| {
        cells.truncate(if every { header.len() - 1 } else { header.len() });
        cells
    };
    let rows = effects.iter().take(MOST_LINES).map(|one| cut(row(one))).collect();
    let header = if every { &header[..header.len() - 1] } else { &header[..] };
    answer.table(Table::new(header, rows), "effects.csv");
    answer.messages([match seeds {
        Some(count) => format!(
            "effect: the mean over {} of the measure at the upper bound less that at the lower one, under the same \
             seeds; ± is the half width of its 95 % interval, by Student's t",
            in_words(count)
        ),
        None => "effect: the measure at the upper bound less that at the lower one, the other keys as in the case"
            .to_owned(),
    }]);
    if let Some(one) = effects.iter().find(|one| one.turns_between()) {
        answer.messages([format!(
            "note: {} lies on one side of its value in the case at both bounds of {}: it has a largest or least value \
             between them, and the effect says little; the keys stand in the order of their bars in the picture, from \
             the least to the largest value",
            one.column, one.key
        )]);
    }
}
