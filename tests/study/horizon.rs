//! The growth of a perturbation, against runs that really are perturbed.

use signorini::study::horizon::{Growth, LARGEST_GROWTH};
use signorini::{Integrator, Load, Options, PenaltyLaw, Scene, Scheme, Stepper, Wall, run};

/// The source scene, for so many seconds.
pub fn source(e: f64, duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(duration)
}

/// State at the end and largest speed on the way, of the exact run from (q, v).
fn end(scene: &Scene, q: f64, v: f64) -> ([f64; 2], f64) {
    let scene = scene.clone().with_initial(&[q], &[v]);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, scene.duration).unwrap();
    let mut speed = 0.0_f64;
    while stepper.time() < scene.duration {
        speed = speed.max(stepper.step().unwrap().v[0].abs());
    }
    let state = stepper.state();
    ([state.q[0], state.v[0]], speed)
}

/// Largest singular value of the scaled derivative by central differences.
fn by_differences(scene: &Scene) -> f64 {
    let (length, (_, speed)) = (scene.gap_scale(), end(scene, scene.initial.q[0], scene.initial.v[0]));
    let delta = 1e-7;
    let column = |dq: f64, dv: f64| {
        let (q, v) = (scene.initial.q[0], scene.initial.v[0]);
        let (plus, minus) = (end(scene, q + dq, v + dv).0, end(scene, q - dq, v - dv).0);
        [(plus[0] - minus[0]) / (2.0 * delta * length), (plus[1] - minus[1]) / (2.0 * delta * speed)]
    };
    let (a, b) = (column(delta * length, 0.0), column(0.0, delta * speed));
    let matrix = nalgebra::Matrix2::new(a[0], b[0], a[1], b[1]);
    matrix.singular_values()[0]
}

#[test]
fn the_saltation_matrices_give_the_growth_that_perturbed_runs_show() {
    let elastic = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_elasticity(100.0, 3.0))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    let ball = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.7))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.3]);
    for scene in [source(1.0, 1.0), source(0.8, 1.0), elastic, ball] {
        for duration in [0.05, 0.3, 1.0] {
            let scene = scene.clone().with_duration(duration);
            let exact = *Growth::of(&scene).unwrap().factor.last().unwrap();
            let measured = by_differences(&scene);
            // Central differences of 1e-7: truncation grows with the square of the growth, at most
            // 2e-4 here.
            assert!((exact / measured - 1.0).abs() < 1e-3, "{exact} against {measured} after {duration} s");
        }
    }
}

#[test]
fn the_source_scene_is_chaotic_at_e_1_and_forgets_its_start_at_e_08() {
    // Known of this scene: two starts 1e-16 apart are 8 times that apart after 1 s and some 1e11
    // after 10 s, in displacement alone.
    let growth = Growth::of(&source(1.0, 10.0)).unwrap();
    let after = growth.until(1.0);
    assert!((5.0..50.0).contains(&after), "{after}");
    assert!(growth.until(10.0) > 1e10);
    let horizon = growth.horizon(1e2);
    assert!((1.0..5.0).contains(&horizon), "{horizon}");
    let settled = Growth::of(&source(0.8, 10.0)).unwrap();
    assert!(settled.until(10.0) < 10.0);
    assert_eq!(settled.horizon(1e2), 10.0);
}

/// A body that grazes a wall by 1e-7 of its amplitude at its first impact: the change grows by the
/// impact, not before it.
#[test]
fn a_growth_by_an_impact_begins_at_the_impact() {
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.8))
        .with_initial(&[-5.000_1e-3], &[0.0])
        .with_duration(3.0);
    // −cos ωt = g/a, with a little over half a period of π/10 s.
    let impact = 0.1 * (-5e-3_f64 / 5.000_1e-3).acos();
    let horizon = Growth::of(&scene).unwrap().horizon(1e2);
    // Rounding of the acos near its end, √ε.
    assert!((horizon - impact).abs() < 1e-8, "{horizon} {impact}");
}

/// Between walls a thousand times as far as it goes, a vibration is linear: no change grows.
#[test]
fn a_vibration_far_from_its_walls_is_predictable_to_the_end() {
    let mut scene = source(1.0, 10.0);
    for (wall, far) in scene.walls.iter_mut().zip([5.0, -5.0]) {
        *wall = if far > 0.0 { Wall::upper("upper", far) } else { Wall::lower("lower", far) };
    }
    let growth = Growth::of(&scene).unwrap();
    // Φ of a vibration with damping, in units of its own: a turn that shrinks.
    assert!(growth.until(10.0) < 1.1, "{}", growth.until(10.0));
    assert_eq!(growth.horizon(1e2), 10.0);
}

#[test]
fn a_body_that_came_to_rest_has_forgotten_its_start() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.0))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1e-3], &[0.0])
        .with_duration(1.0);
    assert_eq!(*Growth::of(&scene).unwrap().factor.last().unwrap(), 0.0);
}

/// What comes after a rest is as sensitive as it is from a start just off the wall: the rest wipes
/// out changes of the start, not those that the body leaves with.
#[test]
fn a_motion_after_a_rest_is_as_chaotic_as_any() {
    let phase = std::f64::consts::FRAC_PI_2;
    let resting = |place: f64| Scene {
        loads: vec![Load::harmonic(3.0, 5.0, phase)],
        ..source(1.0, 10.0).with_initial(&[place], &[0.0])
    };
    let [on, off] = [5e-3, 4.9e-3].map(|place| Growth::of(&resting(place)).unwrap());
    assert!(on.until(10.0) > 1e10 && off.until(10.0) > 1e10, "{:e} {:e}", on.until(10.0), off.until(10.0));
    let horizon = on.horizon(LARGEST_GROWTH);
    assert!(horizon > 0.1 && horizon < 5.0, "{horizon}");
    // What a run of another scheme differs by stays below a tenth of the gap up to there, and is as
    // large as the gap later.
    let scene = resting(5e-3);
    let exact = run(&scene, &Scheme::Event, &Options::with_step(1e-4).with_sample(0.01)).unwrap();
    let located = run(&scene, &Scheme::Located, &Options::with_step(1e-4).with_sample(0.01)).unwrap();
    let [exact, located] = [&exact, &located].map(|run| &run.trajectory);
    let apart = |within: &dyn Fn(f64) -> bool| {
        let rows = exact.time().iter().zip(exact.displacements()[0].iter().zip(&located.displacements()[0]));
        rows.filter(|(time, _)| within(**time)).map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(apart(&|time| time < horizon) < 5e-4, "{:e}", apart(&|time| time < horizon));
    assert!(apart(&|time| time > 5.0) > 5e-3);
}

/// A free body that strikes a wall of Hertz's law once and leaves at its speed of approach: starts
/// that differ in speed by δ are as far apart after the impact as they would be on a straight way.
/// Within the contact, which takes a hundredth of the flight, their velocities differ by some 100
/// δ.
#[test]
fn one_elastic_impact_does_not_end_a_comparison() {
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("stop", 0.5).with_hunt_crossley(1e7, 1.5, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(1.0);
    let method = Scheme::Penalty { law: PenaltyLaw::None, integrator: Integrator::DiscreteGradient }.into();
    let growth = Growth::by_runs(&scene, &method, 1e-4).unwrap();
    assert_eq!(growth.horizon(LARGEST_GROWTH), scene.duration);
    // The way of 1 m over the gap of 0.5 m, and the speed.
    let way = 1.0_f64.hypot(2.0);
    assert!((0.5 * way..1.5 * way).contains(&growth.until(1.0)), "{}", growth.until(1.0));
}

#[test]
fn a_stiff_dashpot_does_not_make_a_motion_unpredictable() {
    // A body thrown at a wall that stops it in 1e-4 s: earlier by δt, it is slower by c v δt/m for
    // as long. Starts 1e-6 m apart never differ by more than 3 times that, in rows of 1e-3 s.
    let scene = Scene::oscillator(1.0, 0.5, 300.0)
        .with_wall(Wall::upper("pad", 4e-3).with_elasticity(5e3, 1e4))
        .with_initial(&[0.0], &[0.3])
        .with_duration(0.5);
    let growth = Growth::of(&scene).unwrap();
    assert!(growth.factor.iter().all(|factor| *factor < 5.0), "{:?}", growth.factor);
    assert_eq!(growth.horizon(LARGEST_GROWTH), scene.duration);
}

/// A block on a pad, a spring and a dashpot beneath it, is a damped oscillator: nothing grows in
/// it. It starts on the pad and so has no gap that would tell speeds and displacements together.
#[test]
fn nothing_grows_in_a_block_on_its_pad() {
    let block = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("pad", 0.0).with_elasticity(100.0, 10.0))
        .with_load(Load::constant(1.0));
    let growth = Growth::of(&block).unwrap();
    assert_eq!(growth.horizon(LARGEST_GROWTH), block.duration);
    // At ζ = ½ a change at most grows by the transient of a damped oscillator.
    assert!(growth.until(block.duration) < 2.0, "{growth:?}");
}

/// The horizon of a scene in other units of mass is the same, also of a structure in modes, whose
/// coordinates are no displacements.
#[test]
fn the_unit_of_mass_does_not_change_a_horizon() {
    let horizons: Vec<f64> = [1.0, 2_f64.powi(-20), 2_f64.powi(20)].into_iter().flat_map(horizons_in_unit).collect();
    // Powers of 2 scale the runs exactly, but for the square roots in the modes.
    for pair in horizons.chunks(2).skip(1) {
        assert!((pair[0] - horizons[0]).abs() < 1e-9 && (pair[1] - horizons[1]).abs() < 0.05, "{horizons:?}");
    }
    // The same structure in its masses, and in all of its modes: of other directions of the change.
    assert!((horizons[1] / horizons[0] - 1.0).abs() < 0.3, "{horizons:?}");
}

/// The horizons of a chain that a pad rubs and walls stop, whose masses and forces are `unit` times
/// as large: in its masses, and in its modes.
fn horizons_in_unit(unit: f64) -> [f64; 2] {
    let text = |modes: &str| {
        let [masses, springs] = [[1.0, 0.5, 0.8], [200.0, 300.0, 100.0]].map(|values| values.map(|x| x * unit));
        format!(
            "[system]\nchain = {{ masses = {masses:?}, springs = [{:?}, {:?}], left = {{ stiffness = {:?} }}, \
             right = \"free\" }}\ndamping = {{ rayleigh = {{ mass = 0.1, stiffness = 1e-4 }} }}\n{modes}\n\
             [[wall]]\nname = \"a\"\nat = {{ dof = 2 }}\nside = \"upper\"\nposition = 0.003\nrestitution = 0.5\n\
             [[wall]]\nname = \"c\"\nat = {{ row = [[1, 1.0], [2, -1.0]] }}\nside = \"upper\"\nposition = 0.001\n\
             restitution = 0.8\n[[load]]\nharmonic = {{ amplitude = {:?}, frequency = 3.0 }}\nat = {{ dof = 1 }}\n\
             [[slider]]\nname = \"pad\"\nat = {{ dof = 1 }}\nnormal_force = {:?}\nfriction = 0.3\n\
             [initial]\nvelocity = [0.1, 0.0, -0.05]\n[time]\nend = 1.0\nstep = 1e-4",
            springs[0],
            springs[1],
            springs[2],
            2.0 * unit,
            0.3 * unit
        )
    };
    ["", "modes = 3\n"].map(|modes| {
        let case = signorini::case::CaseFile::from_text(&text(modes), "chain.toml", ".").case().unwrap();
        let method = Scheme::MoreauJean { theta: 0.5 }.into();
        Growth::by_runs(&case.scene, &method, 1e-4).unwrap().horizon(LARGEST_GROWTH)
    })
}
