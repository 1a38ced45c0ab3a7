//! Impacts at several walls at once: Moreau's law.

use crate::random_structures::{at, scene};
use signorini::linear::Symmetric;
use signorini::{Load, Options, Row, Scheme, Wall, run};

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

/// Three masses, of which two walls of w = u₁ − u₃/2 and of u₁ bound the motion. At 1.5703388 s the
/// upper wall of w and the lower one of u₁ are struck in turn without end, ever faster and weaker
/// (with 80 digits: the speeds at the lower wall shrink by 0.64, the gaps below 1e-16 m), after
/// which the body rests at both. What leaves them with 7 mm/s, or with e times the speed of the
/// last impact, is elsewhere at 1.8 s.
#[test]
fn impacts_that_accumulate_between_two_walls_end_in_rest_at_both() {
    let stiffness = [
        (0, 0, 25275.108707591608),
        (1, 0, -6381.982935699494),
        (1, 1, 18197.18583701363),
        (2, 1, -11815.202901314135),
        (2, 2, 11815.202901314135),
    ];
    let masses = [380.2672332923389, 411.76633684804506, 421.9874370462233];
    let zero = Symmetric::diagonal(&[0.0; 3]);
    let start = [-0.20640827104328355, -0.1348033700740926, -0.06401696204187395];
    let mut jam = scene(Symmetric::diagonal(&masses), zero, Symmetric::from_entries(3, stiffness))
        .with_initial(&[0.0; 3], &start)
        .with_duration(1.62);
    let relative = || Row::new(vec![(0, 1.0), (2, -0.5)]);
    for (wall, row) in [
        (Wall::upper("w0", 0.03627833461997646).with_restitution(0.0), relative()),
        (Wall::lower("w1", -0.0467589178849175).with_restitution(0.832871238750658), relative()),
        (Wall::lower("w2", 0.0).with_restitution(0.9467786753892906), Row::dof(0)),
        (Wall::upper("w3", 0.03392185176927239).with_restitution(0.0), Row::dof(0)),
    ] {
        jam = jam.with_wall(at(wall, row));
    }
    for load in [
        Load::harmonic(1491.8092695214518, 1.7383427145754724, 1.5243846249429578),
        Load::harmonic(504.3424970554355, 0.24891513521937447, 4.979439326872298),
        Load::constant(-484.8124860652747),
    ] {
        jam = jam.with_load(Load { at: Row::dof(2), ..load });
    }
    jam.probes[0].at = Row::dof(2);
    let ends = |scheme: Scheme, step: f64| {
        let run = run(&jam, &scheme, &Options::with_step(step)).expect("a run");
        assert!(run.findings.is_empty(), "{scheme}: {:?}", run.findings);
        let place = *run.trajectory.displacement().last().expect("rows");
        [place, run.trajectory.impulse("w2").expect("a wall"), run.state.q[0]]
    };
    let exact = ends(Scheme::Event, 1.62);
    assert!(exact[2].abs() < 1e-15, "at the lower wall: {exact:?}");
    // Of order 2 with a step of the tenth: 2 h² m and 1e5 h² N s.
    for step in [1e-3_f64, 1e-4] {
        let run = ends(Scheme::Located, step);
        assert!(run[2].abs() < 1e-15, "at the lower wall: {run:?}");
        let [place, impulse] = [0, 1].map(|quantity| (run[quantity] - exact[quantity]).abs() / step.powi(2));
        assert!(place < 2.0 && impulse < 1e5, "{step}: {place} h² m, {impulse} h² N s");
    }
}
