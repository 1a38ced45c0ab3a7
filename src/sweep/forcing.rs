//! The period of the loads.

use crate::error::{Error, Result};
use crate::scene::{LoadKind, Scene};

/// Largest ratio of frequencies, as a quotient of whole numbers, whose common period is looked for.
const MOST_CYCLES: u32 = 1000;

/// A quotient is that of whole numbers to this share: frequencies are written with few digits.
const NEAR: f64 = 1e-9;

/// Frequencies of the sines of `scene`, Hz, each once.
fn frequencies(scene: &Scene) -> Vec<f64> {
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

/// True if a sine acts.
pub(super) fn has_sine(scene: &Scene) -> bool {
    !frequencies(scene).is_empty()
}

/// The least time, s, after which all loads of `scene` repeat themselves.
///
/// # Errors
/// [`Error::Invalid`] where there is none: no sine, a load that does not repeat, or frequencies
/// without a common period.
pub(super) fn period(scene: &Scene) -> Result<f64> {
    let refuse = |found: String, why: &str| {
        Err(Error::invalid("forcing period", found, format!("{why}; give settle and keep in seconds")))
    };
    let once = |kind: &LoadKind| matches!(kind, LoadKind::Constant { .. } | LoadKind::Harmonic { .. });
    if let Some(index) = scene.loads.iter().position(|load| !once(&load.kind)) {
        return refuse(format!("none: load {} does not repeat itself", index + 1), "constant and harmonic loads alone");
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
    // 1/f to the last digit where one sine acts; else the greatest common measure of all of them.
    let counts: Vec<u64> = all.iter().map(|f| (f / first * below as f64).round() as u64).collect();
    let common = counts.into_iter().fold(0, gcd).max(1);
    Ok(below as f64 / common as f64 / first)
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Load;

    fn with(frequencies: &[f64]) -> Scene {
        let sines = frequencies.iter().map(|&f| Load::harmonic(1.0, f, 0.0));
        sines.fold(Scene::oscillator(1.0, 0.0, 1.0).with_load(Load::constant(1.0)), Scene::with_load)
    }

    #[test]
    fn the_period_is_that_of_all_sines_together() {
        for (frequencies, expected) in [
            (&[5.0][..], 0.2),
            (&[5.0, 10.0], 0.2),
            (&[10.0, 5.0], 0.2),
            (&[4.0, 6.0], 0.5),
            (&[0.3, 0.5], 10.0),
            (&[2.0, 3.0, 5.0], 1.0),
            (&[5.0, 5.0], 0.2),
        ] {
            let found = period(&with(frequencies)).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-14, "{frequencies:?}: {found}");
        }
        assert_eq!(period(&with(&[3.7])).unwrap(), 1.0 / 3.7);
    }

    #[test]
    fn loads_without_a_common_period_are_refused_with_the_reason() {
        assert!(period(&with(&[1.0, 2.0_f64.sqrt()])).unwrap_err().to_string().contains("1.0 and 1.414"));
        assert!(period(&with(&[])).unwrap_err().to_string().contains("no load is a sine"));
        let blown = with(&[1.0]).with_load(Load::impulse(1.0, 0.5));
        assert!(period(&blown).unwrap_err().to_string().contains("load 3 does not repeat"));
    }
}
