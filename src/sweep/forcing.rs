//! The period of the loads, as a sweep asks for it.

use crate::error::{Error, Result};
use crate::scene::{Scene, forcing_period, frequencies};

/// True if there is a harmonic load.
pub(super) fn has_sine(scene: &Scene) -> bool {
    !frequencies(scene).is_empty()
}

/// The shortest time, s, after which all loads of `scene` repeat themselves.
///
/// # Errors
/// [`Error::Invalid`] if there is none: no harmonic load, a load that does not repeat itself, or
/// frequencies without a common period.
pub(super) fn period(scene: &Scene) -> Result<f64> {
    forcing_period(scene).map_err(|error| match error {
        Error::Invalid { subject, value, expected } => {
            Error::Invalid { subject, value, expected: format!("{expected}; give settle and keep in seconds") }
        }
        other => other,
    })
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
