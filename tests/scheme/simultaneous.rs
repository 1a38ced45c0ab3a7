//! Impacts at several walls at once: Moreau's law.

use crate::random_structures::{at, scene};
use signorini::linear::Symmetric;
use signorini::{Options, Row, Scheme, Wall, run};

#[test]
fn touching_equal_masses_leave_as_moreaus_law_has_it() {
    // Three masses of 1 kg in a row that touch; the first is struck from the left and has 1 m/s.
    // Newton's cradle would send the last one off alone, (0, 0, 1): that is two impacts one after
    // the other. Moreau's law takes them at once, ẇ⁺ = −e ẇ at the contact that is struck and ẇ⁺ =
    // 0 at the one that is at rest, with impulses of 4/3 and 2/3 N s at e = 1.
    for (e, leaves, impulses) in [
        (1.0, [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0], [4.0 / 3.0, 2.0 / 3.0]),
        (0.5, [0.0, 0.5, 0.5], [1.0, 0.5]),
        (0.0, [1.0 / 3.0; 3], [2.0 / 3.0, 1.0 / 3.0]),
    ] {
        let zero = || Symmetric::diagonal(&[0.0; 3]);
        let mut scene = scene(Symmetric::diagonal(&[1.0; 3]), zero(), zero()).with_initial(&[0.0; 3], &[1.0, 0.0, 0.0]);
        for (name, i) in [("first", 0), ("second", 1)] {
            let between = Row::new(vec![(i + 1, 1.0), (i, -1.0)]);
            scene = scene.with_wall(at(Wall::lower(name, 0.0).with_restitution(e), between));
        }
        let scene = scene.with_duration(0.1);
        for scheme in [
            Scheme::Event,
            Scheme::MoreauJean { theta: 0.5 },
            Scheme::MoreauJean { theta: 1.0 },
            Scheme::GeneralizedAlpha { rho: 0.8 },
        ] {
            for (dof, leaves) in leaves.iter().enumerate() {
                let mut seen = scene.clone();
                seen.probes[0].at = Row::dof(dof);
                let run = run(&seen, &scheme, &Options::with_step(1e-3)).expect("a run");
                let v = run.trajectory.velocity().last().copied().expect("rows");
                // One impact of 1 m/s: its rounding.
                assert!((v - leaves).abs() < 1e-14, "{scheme}, e = {e}, mass {dof}: {v} m/s, not {leaves}");
                for (wall, impulse) in ["first", "second"].iter().zip(impulses) {
                    let p = run.trajectory.impulse(wall).expect("a wall");
                    assert!((p - impulse).abs() < 1e-14, "{scheme}, e = {e}, {wall}: {p} N s, not {impulse}");
                }
            }
        }
    }
}
