//! Where steps end, what they show, and what is refused.

use super::*;
use crate::scene::Load;

/// A body of 2 kg without a spring.
fn free() -> Scene {
    Scene::oscillator(2.0, 0.0, 0.0).with_duration(20.0)
}

#[test]
fn a_blow_soon_after_one_at_the_start_acts_at_its_time() {
    // At 0.5 m/s from the start and 2 m/s from 0.25 s on, whether a step ends there or not.
    for stride in [0.125, 0.4, 3.0] {
        let scene = free().with_load(Load::impulse(3.0, 0.25)).with_load(Load::impulse(1.0, 0.0));
        let mut event = Event::new(&scene, stride).unwrap();
        assert_eq!((event.v(), event.limit()), (&[0.5][..], stride.min(0.25)));
        while event.end() < 3.0 {
            event.advance(0.0).unwrap();
        }
        // Rounding of a sum of some ten terms.
        let expected = 0.125 + 2.0 * (event.end() - 0.25);
        assert!((event.q()[0] - expected).abs() < 1e-14, "{stride}: {} {expected}", event.q()[0]);
    }
}
