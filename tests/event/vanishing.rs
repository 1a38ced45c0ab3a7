//! Bodies at rest on a wall at an instant at which the load and its rate vanish: the next
//! derivative decides whether they stay.

use signorini::linear::Symmetric;
use signorini::{Load, Options, Scene, Scheme, Structure, Wall, run};

/// A body of 2 kg at rest at the wall, of one degree of freedom or as a structure.
fn body(wall: Wall, structure: bool) -> Scene {
    let mut scene = Scene::oscillator(2.0, 0.0, 0.0);
    if structure {
        let one = |x: f64| Symmetric::diagonal(&[x]);
        scene.system = Structure { mass: one(2.0), damping: one(0.0), stiffness: one(0.0) }.into();
    }
    scene.with_wall(wall).with_duration(0.2)
}

#[test]
fn the_curvature_of_the_load_lifts_a_body_or_presses_it() {
    // ±5 (1 − cos 7t) N, of which the first two derivatives are 0 at the start.
    let (a, omega, t) = (5.0, 7.0, 0.2_f64);
    // Twice integrated over the mass, and once.
    let place = a / 2.0 * (0.5 * t * t - (1.0 - (omega * t).cos()) / (omega * omega));
    let impulse = a * (t - (omega * t).sin() / omega);
    let cosine = |amplitude: f64| Load::harmonic(amplitude, omega / std::f64::consts::TAU, 0.5 * std::f64::consts::PI);
    // A body that is held at 0 has no energy but rounding.
    for (structure, from, s) in
        [false, true].into_iter().flat_map(|b| [(b, 0.1, 1.0), (b, 0.1, -1.0), (b, 0.0, 1.0), (b, 0.0, -1.0)])
    {
        let wall = if s > 0.0 { Wall::upper("wall", from) } else { Wall::lower("wall", -from) };
        for push in [1.0, -1.0] {
            let scene = body(wall.clone(), structure)
                .with_initial(&[s * from], &[0.0])
                .with_load(Load::constant(s * push * a))
                .with_load(cosine(-s * push * a));
            let made = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
            let q = *made.trajectory.displacement().last().expect("rows");
            let p = made.trajectory.impulse("wall").expect("a wall");
            let (q_expected, p_expected) =
                if push > 0.0 { (s * from, -s * impulse) } else { (s * (from - place), 0.0) };
            let what = format!("structure: {structure}, from {from}, side {s}, pressed: {}", push > 0.0);
            // Two loads of 5 N cancel at the start: their rounding, 1e-15 N, acts for 0.2 s.
            assert!((q - q_expected).abs() < 1e-9, "{what}: {q} m, not {q_expected} m");
            assert!((p - p_expected).abs() < 1e-9, "{what}: {p} N s, not {p_expected} N s");
            assert_eq!(made.findings, [], "{what}");
        }
    }
}
