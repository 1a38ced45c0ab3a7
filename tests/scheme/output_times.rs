//! States at output times, which need not be rows, against closed forms and the independent
//! event-driven motion.

use crate::common::event_driven::EventDriven;
use crate::common::{driven, schemes, source};
use signorini::{Chain, Options, Probe, Row, Scene, Scheme, Wall, run};

/// Times that are no multiples of a step, the first at the start and the last at the end.
const TIMES: [f64; 6] = [0.0, 0.0317, 0.171_3, 0.296_7, 0.333_33, 0.4];

fn states(scene: &Scene, scheme: Scheme, h: f64) -> Vec<(f64, f64)> {
    let found = run(scene, &scheme, &Options::with_step(h).with_sample(scene.duration)).expect("a run");
    let output = found.trajectory.output();
    assert_eq!(output.time, scene.output_times, "{scheme}");
    output.displacement[0].iter().copied().zip(output.velocity[0].iter().copied()).collect()
}

fn largest(a: &[(f64, f64)], b: &[(f64, f64)], of: fn(&(f64, f64)) -> f64) -> f64 {
    a.iter().zip(b).map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max)
}

#[test]
fn states_are_those_of_the_exact_motion_and_of_order_two_between_the_steps_of_a_grid() {
    for scene in [driven(), source(0.8, 0.4).with_initial(&[0.0], &[0.5])] {
        let scene = scene.with_duration(0.4).with_output_times(&TIMES);
        let mut exact = EventDriven::new(&scene);
        let wanted: Vec<(f64, f64)> = TIMES.iter().map(|&time| exact.advance(time)).collect();
        // Roots and recurrences of the two programmes differ by rounding, which impacts carry on.
        let found = states(&scene, Scheme::Event, 0.1);
        assert!(largest(&found, &wanted, |s| s.0) < 1e-14 && largest(&found, &wanted, |s| s.1) < 1e-12);
        // Where impacts are located, halving the step quarters the errors, between 3 and 5 times.
        let of = |h: f64| states(&scene, Scheme::Located, h);
        let (coarse, fine) = (of(4e-4), of(2e-4));
        for part in [|s: &(f64, f64)| s.0, |s: &(f64, f64)| s.1] {
            let ratio = largest(&coarse, &wanted, part) / largest(&fine, &wanted, part);
            assert!((3.0..5.0).contains(&ratio), "{ratio}: {coarse:?}, {fine:?}, {wanted:?}");
        }
        assert!(largest(&fine, &wanted, |s| s.0) < 1e-6, "{fine:?} m, exact {wanted:?}");
    }
}

#[test]
fn at_the_times_of_rows_the_states_are_the_rows() {
    for scheme in schemes().into_iter().filter(|scheme| *scheme != Scheme::Newmark) {
        let rows = 90;
        let duration = 0.1 * f64::from(rows) / 3.0 * 0.1;
        let scene = source(0.8, 0.4).with_duration(duration).with_initial(&[0.0], &[0.5]);
        let options = Options::with_step(duration / 540.0).with_sample(duration / f64::from(rows));
        let plain = run(&scene, &scheme, &options).expect("a run").trajectory;
        let scene = scene.with_output_times(plain.time());
        // Steps far from walls are recorded together where a run is judged, else one by one.
        let judged = run(&scene, &scheme, &options).expect("a run").trajectory;
        let alone = run(&scene, &scheme, &options.unjudged()).expect("a run").trajectory;
        assert_eq!(judged, alone, "{scheme}");
        let output = judged.output();
        assert_eq!(output.time, plain.time(), "{scheme}");
        for (what, states, rows) in [
            ("displacement", &output.displacement[0], plain.displacement()),
            ("velocity", &output.velocity[0], plain.velocity()),
        ] {
            // Of an exact scheme the same time, in another order of operations.
            let off = states.iter().zip(rows).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= if scheme == Scheme::Event { 1e-15 } else { 0.0 }, "{scheme}: {what} off by {off}");
        }
    }
}

#[test]
fn between_steps_in_which_a_wall_pushes_the_displacement_is_straight_and_the_velocity_that_of_the_end() {
    // 2 m/s to a wall at 0.01 m, of restitution ½: by moreau-jean in the step in which it arrives.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.01).with_restitution(0.5))
        .with_initial(&[0.0], &[2.0])
        .with_duration(0.02)
        .with_output_times(&[0.003, 0.0055, 0.0125]);
    let found = states(&scene, Scheme::MoreauJean { theta: 0.5 }, 2e-3);
    let rows = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(2e-3)).expect("a run").trajectory;
    let (q, v) = (rows.displacement(), rows.velocity());
    let struck = v.iter().position(|v| *v < 0.0).expect("an impact");
    assert_eq!(struck, 3, "{v:?}");
    assert_eq!(found[0], (0.006, 2.0));
    assert_eq!(found[1].1, -1.0);
    assert!((found[1].0 - (0.25 * q[2] + 0.75 * q[3])).abs() < 1e-16);
    assert!((found[2].0 - (0.75 * q[6] + 0.25 * q[7])).abs() < 1e-16 && found[2].1 == -1.0);
}

#[test]
fn a_structure_has_the_states_of_all_probes_and_times_after_the_end_are_left_out() {
    let chain = Chain { masses: vec![1.0; 3], springs: vec![1e3; 2], grounds: [1e3, 0.0] };
    let mut scene = Scene::structure(chain.structure().expect("a chain")).with_duration(0.2);
    scene.initial.v = vec![1.0, 0.0, 0.5];
    scene.probes = [0, 2].map(|dof| Probe { name: format!("m{dof}"), at: Row::dof(dof) }).to_vec();
    let scene = scene.with_output_times(&[0.05, 0.131, 0.3]);
    let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("a run").trajectory;
    let grid = run(&scene, &Scheme::Located, &Options::with_step(1e-4)).expect("a run").trajectory;
    for output in [exact.output(), grid.output()] {
        assert_eq!((output.time.as_slice(), output.displacement.len()), (&[0.05, 0.131][..], 2));
    }
    for probe in 0..2 {
        for time in 0..2 {
            let [a, b] = [exact.output(), grid.output()].map(|output| output.displacement[probe][time]);
            // Of order 2: ω² h² t/24 of the speeds of 1 m/s, at most 8e-9 here.
            assert!((a - b).abs() < 1e-7, "{a} and {b}");
        }
    }
}

#[test]
fn output_times_out_of_order_are_refused_by_their_number() {
    for (times, words) in [
        (&[-0.1][..], "value 1"),
        (&[0.1, 0.1], "value 2"),
        (&[0.1, f64::NAN], "value 2"),
        (&[0.1, 0.2, f64::INFINITY], "value 3"),
    ] {
        let error = driven().with_output_times(times).validate().expect_err("no times").to_string();
        assert!(error.contains("output times") && error.contains(words), "{error}");
    }
}
