//! Blows beside contact.

use super::*;

/// The unit vector at this angle, and the one a right angle ahead.
fn frame(angle: f64) -> [[f64; 2]; 2] {
    let (c, s) = (angle.cos(), angle.sin());
    [[c, s], [-s, c]]
}

#[test]
fn a_blow_on_one_body_moves_it_as_if_no_other_were_pressed_into_its_hole() {
    let (gap, h) = (1e-3, 1e-3);
    for (scheme, beside) in schemes() {
        for angle in [0.0, 0.6, 2.2] {
            let [n, _] = frame(angle);
            let scene = |gap: f64| {
                let supports = [&[hole(gap, 0.3)], &beside[..]].concat();
                let scene = with(masses(&[1.0, 1.0, 2.0, 3.0], &[0.5, 0.5, 30.0, 40.0]), &supports);
                let scene = pushed(scene, &Load::constant(5.0), n);
                let blow = |row: usize| Load { at: Row::dof(row), ..Load::impulse(0.1, 3.3 * h) };
                scene
                    .with_load(blow(2))
                    .with_load(blow(3))
                    .with_initial(&[1e-3 * n[0], 1e-3 * n[1], 0.0, 0.0], &[0.0; 4])
            };
            // Roundings of numbers up to 1e-4 m and 0.1 m/s; but generalized-alpha lets all dampers
            // act otherwise, to order h², in a step that meets a hole.
            let alpha = matches!(scheme, Scheme::GeneralizedAlpha { .. });
            let small = if alpha { [1e-9, 1e-6] } else { [1e-17, 1e-14] };
            // In the large hole the first body meets nothing.
            let mut alone = Stepper::new(&scene(1.5), &scheme, h).expect("a scene");
            follow(&scene(gap), &scheme, h, 8, |number, step| {
                let pressed = step.impulse[0] > 0.0;
                assert!(pressed, "{scheme}, {angle}: step {number}");
                let other = alone.step().expect("a step");
                for k in 2..4 {
                    let off = [step.q[k] - other.q[k], step.v[k] - other.v[k]].map(f64::abs);
                    assert!(off[0] < small[0] && off[1] < small[1], "{scheme}, {angle}, {number}: {off:?}");
                }
            });
        }
    }
}

#[test]
fn a_hole_in_reach_that_does_not_push_changes_nothing() {
    let (gap, h) = (1e-3, 1e-3);
    for (scheme, beside) in schemes().into_iter().take(2) {
        for angle in [0.0, 0.6, 2.2, 4.0] {
            let [n, t] = frame(angle);
            let scene = |gap: f64| {
                let supports = [&[hole(gap, 0.0)], &beside[..]].concat();
                let scene = with(masses(&[1.0; 2], &[2.0; 2]), &supports);
                // The blow throws the body towards the hole, which half a step of its velocity
                // passes; the load takes twice that velocity away until the step's end.
                let scene = pushed(scene, &Load::impulse(0.01, 0.2 * h), n);
                pushed(scene, &Load::constant(-20.0), n).with_initial(&n.map(|n| 0.998e-3 * n), &t.map(|t| 3e-3 * t))
            };
            let mut beyond = Stepper::new(&scene(1.5), &scheme, h).expect("a scene");
            let stepper = follow(&scene(gap), &scheme, h, 3, |number, step| {
                assert!(step.impulse[0] == 0.0, "{angle}: step {number}");
                let other = beyond.step().expect("a step");
                for k in 0..2 {
                    let off = [step.q[k] - other.q[k], step.v[k] - other.v[k]].map(f64::abs);
                    assert!(off[0] < 1e-17 && off[1] < 1e-14, "{scheme}, {angle}, {number}: {off:?}");
                }
            });
            assert!(stepper.counters().largest_turn_rad == 0.0, "{angle}");
            assert_eq!(stepper.open_contacts(), []);
        }
    }
}

#[test]
fn about_the_axis_of_the_hole_blows_and_contacts_turn_with_the_scene() {
    let (gap, h) = (1e-3, 1e-3);
    for (scheme, beside) in schemes() {
        // A body pressed into the hole, struck along it and into it or off it.
        for oblique in [80.0_f64, -80.0, 100.0, -100.0, 10.0] {
            let mut known: Vec<[f64; 5]> = Vec::new();
            for turn in 0..12 {
                let angle = 0.2 + f64::from(turn) * std::f64::consts::TAU / 12.0;
                let [n, t] = frame(angle);
                let [along, _] = frame(angle + oblique.to_radians());
                let supports = [&[hole(gap, 0.4)], &beside[..]].concat();
                let scene = with(masses(&[1.0; 2], &[20.0; 2]), &supports);
                let scene = pushed(scene, &Load::constant(5.0), n).with_initial(&n.map(|n| gap * n), &[0.0; 2]);
                let scene = pushed(scene, &Load::impulse(0.02, 2.3 * h), along);
                let scene = pushed(scene, &Load::impulse(0.03, 6.8 * h), along);
                let mut seen: Vec<[f64; 5]> = Vec::new();
                follow(&scene, &scheme, h, 10, |_, step| {
                    let parts = |x: &[f64]| [n, t].map(|e| e[0] * x[0] + e[1] * x[1]);
                    let ([w, u], [dw, du]) = (parts(step.q), parts(step.v));
                    seen.push([w / gap, u / gap, dw, du, step.impulse[0]]);
                });
                if known.is_empty() {
                    known = seen;
                    continue;
                }
                for (number, (one, other)) in known.iter().zip(&seen).enumerate() {
                    let off = one.iter().zip(other).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
                    // Roundings, a few times multiplied by impacts.
                    assert!(off < 1e-10, "{scheme}, {oblique}, {turn}, step {number}: {one:?} {other:?}");
                }
            }
        }
    }
}
