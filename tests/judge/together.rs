//! A run looks at the steps between two contacts together: its rows, residuals and findings are
//! those of a judge and a recorder that are shown one step after another.

use crate::common::{INTEGRATORS, schemes_of_whole_steps, spring};
use crate::random_structures::Draws;
use signorini::residual::{Judge, Residuals};
use signorini::{Load, Options, Recorder, Scene, Scheme, Stepper, Table, Wall, run};

/// The residuals and rows of `steps` steps of `h` seconds, seen one by one.
fn one_by_one(scene: &Scene, scheme: &Scheme, h: f64, (steps, rows): (u64, u64)) -> (Judge, signorini::Trajectory) {
    let mut stepper = Stepper::new(scene, scheme, h).expect("a scene");
    let start = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &start.q, &start.v);
    let mut recorder = Recorder::new(stepper.scene(), rows, &start.q, &start.v);
    for _ in 0..steps {
        let step = stepper.step().expect("a step");
        judge.observe(&step);
        recorder.observe(&step);
    }
    (judge, recorder.finish(&stepper.open_contacts()))
}

/// Fails unless both runs have the same residuals: to the last bit, except the sums of the ledger,
/// which add the same terms in another order.
#[track_caller]
fn same(what: &str, a: &Residuals, b: &Residuals) {
    let (mut e, mut f) = (a.energy, b.energy);
    let room = 1e-12 * f.exchanged_j;
    assert!((e.residual_j - f.residual_j).abs() <= room, "{what}: {e:?}, one by one {f:?}");
    for (x, y) in [
        (&mut e.load_work_j, &mut f.load_work_j),
        (&mut e.damping_j, &mut f.damping_j),
        (&mut e.exchanged_j, &mut f.exchanged_j),
        (&mut e.largest_j, &mut f.largest_j),
        (&mut e.final_j, &mut f.final_j),
    ] {
        assert!((*x - *y).abs() <= room, "{what}: {x:e}, one by one {y:e}");
        *x = *y;
    }
    (e.residual_j, e.residual) = (f.residual_j, f.residual);
    let (mut a, mut b) = (a.clone(), b.clone());
    (a.energy, b.energy) = (e, f);
    assert_eq!(a, b, "{what}");
}

fn wall(draws: &mut Draws, name: &str, side: f64) -> Wall {
    let position = side * draws.between(3e-3, 8e-3);
    let wall = if side > 0.0 { Wall::upper(name, position) } else { Wall::lower(name, position) };
    match draws.below(4) {
        0 => wall.with_elasticity(10f64.powf(draws.between(2.0, 5.0)), 0.0),
        1 => wall.with_elasticity(10f64.powf(draws.between(2.0, 5.0)), draws.between(0.1, 20.0)),
        _ => wall.with_restitution(draws.unit()),
    }
}

fn oscillator(draws: &mut Draws) -> Scene {
    let damping = if draws.chance(0.3) { 0.0 } else { draws.between(0.1, 2.0) };
    let mut scene = Scene::oscillator(draws.between(0.5, 2.0), damping, draws.between(0.0, 200.0))
        .with_load(Load::harmonic(draws.between(1.0, 4.0), draws.between(2.0, 8.0), draws.unit()))
        .with_initial(&[draws.between(-2e-3, 2e-3)], &[draws.between(-0.1, 0.1)])
        .with_duration(2.0);
    for (name, side) in [("upper", 1.0), ("lower", -1.0)] {
        if draws.chance(0.8) {
            scene = scene.with_wall(wall(draws, name, side));
        }
    }
    if draws.chance(0.2) {
        scene = scene.with_load(Load::table(Table::new(vec![0.0, 0.7, 1.6], vec![0.0, 1.0, -1.0]).expect("a table")));
    }
    if draws.chance(0.1) {
        scene = scene.with_load(Load::impulse(0.02, draws.between(0.0, 2.0)));
    }
    scene
}

#[test]
fn steps_seen_together_are_judged_and_recorded_as_one_by_one() {
    let mut draws = Draws::new(41);
    let penalties = INTEGRATORS.map(|integrator| spring(1e4, integrator));
    let methods: Vec<Scheme> = schemes_of_whole_steps().into_iter().chain(penalties).collect();
    for number in 0..60 {
        let scene = oscillator(&mut draws);
        let scheme = methods[number % methods.len()];
        let steps = 200 + 50 * draws.below(60) as u64;
        let every = [1, 1, 2, 10][draws.below(4)];
        let h = scene.duration / steps as f64;
        let options = Options::with_step(h).with_sample(every as f64 * h);
        let made = run(&scene, &scheme, &options).expect("a run");
        let (judge, rows) = one_by_one(&scene, &scheme, made.grid.step, (steps, made.grid.rows));
        let what = format!("scene {number} by {scheme}, {steps} steps, a row every {every}");
        assert_eq!((made.grid.steps, made.trajectory.time().len() as u64), (steps, made.grid.rows + 1), "{what}");
        assert_eq!(made.trajectory, rows, "{what}");
        // The run measures the depth behind walls that the scene calls rigid, the judge behind
        // those that the scheme computes, of which a penalty has none.
        let rigid = scene.walls.iter().zip(&made.residuals.depth_m).filter(|(wall, _)| wall.law.is_rigid());
        let mut seen = judge.residuals();
        seen.penetration_m = rigid.map(|(_, depth)| *depth).fold(0.0, f64::max);
        same(&what, &made.residuals, &seen);
        let found = |found: &[signorini::residual::Finding]| -> Vec<_> { found.iter().map(|f| f.refuted).collect() };
        assert_eq!(found(&made.findings), found(&judge.findings()), "{what}");
    }
}
