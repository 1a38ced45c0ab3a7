//! The period of the loads.

use super::{LoadKind, Scene};
use crate::error::{Error, Result};

/// Largest ratio of frequencies, as a quotient of whole numbers, whose common period is looked for.
const MOST_CYCLES: u32 = 1000;

/// Relative tolerance for a quotient of frequencies to be one of whole numbers: frequencies are
/// written with few digits.
const NEAR: f64 = 1e-9;

/// Frequencies of the sines of `scene`, Hz, each once.
pub(crate) fn frequencies(scene: &Scene) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for load in &scene.loads {
        if let LoadKind::Harmonic { frequency, amplitude, .. } = load.kind
            && frequency > 0.0
            && amplitude != 0.0
            && !found.contains(&frequency)
        {
            found.push(frequency);
        }
    }
    found
}

/// The least time, s, after which all loads of `scene` repeat themselves.
///
/// # Errors
/// [`Error::Invalid`] where there is none: no sine, a load that does not repeat, or frequencies
/// without a common period.
pub(crate) fn forcing_period(scene: &Scene) -> Result<f64> {
    let refuse = |found: String, why: &str| Err(Error::invalid("forcing period", found, why));
    let repeats = |kind: &LoadKind| matches!(kind, LoadKind::Constant { .. } | LoadKind::Harmonic { .. });
    if let Some(index) = scene.loads.iter().position(|load| !repeats(&load.kind)) {
        return refuse(format!("none: load {} does not repeat itself", index + 1), "only constant and harmonic loads");
    }
    let all = frequencies(scene);
    let Some((first, others)) = all.split_first() else {
        return refuse("none: no load is a sine".to_owned(), "a harmonic load");
    };
    // All are multiples of first/below.
    let mut below: u64 = 1;
    for other in others {
        let ratio = other / first * below as f64;
        let cycles = (1..=MOST_CYCLES).find(|&k| {
            let multiple = ratio * f64::from(k);
            (multiple - multiple.round()).abs() <= NEAR * multiple
        });
        match cycles {
            Some(k) if below * u64::from(k) <= u64::from(MOST_CYCLES) => below *= u64::from(k),
            _ => {
                return refuse(
                    format!("none: {first:?} and {other:?} Hz have none up to {MOST_CYCLES} cycles"),
                    "frequencies with a common period",
                );
            }
        }
    }
    // 1/f to the last digit where one sine acts; otherwise one over the greatest common divisor of
    // all frequencies.
    let counts: Vec<u64> = all.iter().map(|f| (f / first * below as f64).round() as u64).collect();
    let common = counts.into_iter().fold(0, gcd).max(1);
    Ok(below as f64 / common as f64 / first)
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}
