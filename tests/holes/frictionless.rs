//! Round holes without friction: closed forms with 25 digits, the motion between planar walls, and
//! what holds of every scene.

use crate::event::free;
use crate::pendulum::{IMPULSE, PERIOD, WORK, pendulum};
use crate::random_structures::Draws;
use crate::rubbing::{
    MOREAU_JEAN, Sums, body, energy, follow, hole, isotropic, load, random_scene, rotating, turned, with, with_flats,
};
use crate::steps::beside_line;
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, Solver};
use signorini::{
    Bound, Integrator, Load, Method, Options, PenaltyLaw, Promise, Row, Scene, Scheme, Stepper, Structure, System,
    Wall, heading, run,
};
use std::f64::consts::TAU;

/// The body of `disk-whirl`, which a rotating force presses round a hole: start with this lag (rad)
/// and friction.
fn whirl(lag: f64, friction: f64) -> Scene {
    let (gap, omega) = (5e-3, TAU * 5.0);
    let scene = with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), gap, 0.3, friction));
    rotating(scene, 3.0, 5.0)
        .with_initial(&[gap * lag.cos(), -gap * lag.sin()], &[gap * omega * lag.sin(), gap * omega * lag.cos()])
}

#[test]
fn a_body_pressed_round_a_hole_slides_with_the_exact_force() {
    const FORCE: f64 = 7.434_637_702_628_067;
    const WORK_RATE: f64 = 1.167_830_159_433_901_7;
    let scene = whirl(0.010_472_166_918_182_78, 0.0);
    // The midpoint rule on the circle: order 2, and after many turns no farther out than after one.
    for (h, steps) in [(1e-3, 4000_u64), (1e-4, 40_000), (1e-5, 40_000)] {
        let (mut worst, mut out, mut sums) = (0.0_f64, 0.0_f64, Sums::default());
        follow(&scene, h, steps, |step| {
            worst = worst.max((step.impulse[0] / h / FORCE - 1.0).abs());
            out = out.max(step.q[0].hypot(step.q[1]) / 5e-3 - 1.0);
            sums.observe(&scene, step);
        });
        let share = (h / 1e-3).powi(2);
        let span = h * steps as f64;
        // The start is that of the exact motion, so the force swings about its mean at first.
        assert!((sums.impulse / span / FORCE - 1.0).abs() < 1.5e-5 * share, "h = {h}: {sums:?}");
        assert!(worst < 1.5e-4 * share + 1e-11, "h = {h}: {worst:e}");
        assert!((sums.work / span / WORK_RATE - 1.0).abs() < 6e-5 * share, "h = {h}: {sums:?}");
        // The depth is that of the sagitta's second order, and some roundings.
        assert!(out < 1e-6 * share.powi(2) + 1e-13, "h = {h}: {out:e}");
    }
}

#[test]
fn a_pendulum_in_a_hole_is_followed_with_order_two() {
    let scene = pendulum();
    let error = |steps: u64| {
        let mut sums = Sums::default();
        follow(&scene, PERIOD / steps as f64, steps, |step| sums.observe(&scene, step));
        [sums.work / WORK - 1.0, sums.impulse / IMPULSE - 1.0]
    };
    let [coarse, fine] = [2000, 8000].map(error);
    // 9e-11 at 2e5 steps a period, of order 2.
    for k in [0, 1] {
        assert!(fine[k].abs() < 1e-7, "{fine:?}");
        let order = (coarse[k] / fine[k]).abs().log2() / 2.0;
        assert!(k == 1 || (1.8..2.2).contains(&order), "{order}: {coarse:?} {fine:?}");
    }
}

#[test]
fn infinitely_many_impacts_settle_into_sliding() {
    const IMPULSE: f64 = 0.702_536_953_348_094_1;
    const WORK: f64 = 0.023_886_256_413_835_2;
    let scene = free(0.5);
    let error = |h: f64, steps: u64| {
        let (mut sums, mut speed) = (Sums::default(), 0.0);
        let stepper = follow(&scene, h, steps, |step| {
            sums.observe(&scene, step);
            speed = step.v[0].hypot(step.v[1]);
        });
        // It slides for ever at its tangential speed; what is left of the normal one would add its
        // square.
        assert!((speed / 0.034 - 1.0).abs() < 200.0 * h, "h = {h}: {speed}");
        assert_eq!(stepper.open_contacts().len(), 1, "h = {h}");
        [(sums.work / WORK - 1.0).abs(), (sums.impulse / IMPULSE - 1.0).abs()]
    };
    let [coarse, fine] = [(1e-5, 50_000), (1e-6, 500_000)].map(|(h, steps)| error(h, steps));
    // Order 1 through impacts: 2.6e-4 and 3.4e-5, 6e-5 and 8e-6.
    assert!(coarse[0] < 4e-4 && fine[0] < 5e-5 && coarse[1] < 1e-4 && fine[1] < 1.2e-5, "{coarse:?} {fine:?}");
}

#[test]
fn a_billiard_keeps_its_energy_and_its_chords() {
    let scene = free(1.0);
    let start = energy(&scene, &scene.initial.q, &scene.initial.v);
    let mut sums = Sums::default();
    let stepper = follow(&scene, 1e-6, 500_000, |step| sums.observe(&scene, step));
    let state = stepper.state();
    // Reflections keep the speed: some hundred roundings.
    assert!((energy(&scene, &state.q, &state.v) / start - 1.0).abs() < 1e-13);
    assert_eq!(sums.arrivals, 17);
    assert!((sums.impulse / 5.563_584_470_465_061 - 1.0).abs() < 1e-5, "{sums:?}");
    assert!((sums.work / 0.189_161_871_995_812_1 - 1.0).abs() < 1e-4, "{sums:?}");
    // Each landing is up to ½hv behind the hole, which turns the chords a little.
    let way = (state.q[0] - 0.343_353_434_007_003_8e-3).hypot(state.q[1] - -0.438_081_571_122_920_4e-3);
    assert!(way < 4e-3 * 2e-3, "{way:e}");
}

#[test]
fn an_impulse_turns_the_velocity_as_the_mass_wants() {
    // Where the mass is not the same in both directions, by a hole and by a flat.
    let mass = Symmetric::from_entries(2, [(0, 0, 2.0), (0, 1, 0.9), (1, 1, 1.0)]);
    let none = || Symmetric::diagonal(&[0.0; 2]);
    let scene = Scene::structure(Structure { mass, damping: none(), stiffness: none() });
    let [c, s] = [0.4_f64.cos(), 0.4_f64.sin()];
    let round = with(scene.clone(), hole("hole", body(), 1.0, 0.6, 0.0));
    let round = round.with_initial(&[(1.0 - 1.2e-9) * c, (1.0 - 1.2e-9) * s], &[0.3, 0.05]);
    let flat = with_flats(scene, "flat", body(), &[(0.4_f64.to_degrees(), 0.0)], 0.6, 0.0);
    // A hole far off makes it a scene with supports.
    let flat = with(flat, hole("far", body(), 1e3, 0.0, 0.0)).with_initial(&[0.0; 2], &[0.3, 0.05]);
    // The normal of the hole is that half a step ahead, 4e-10 rad on.
    for (scene, h, within) in [(round, 1e-8, 2e-9), (flat, 1e-3, 1e-14)] {
        let mut stepper = Stepper::new(&scene, &MOREAU_JEAN, h).unwrap();
        let step = stepper.step().unwrap();
        let p: f64 = step.impulse.iter().map(|p| p.abs()).sum();
        assert!((p - 1.112_951_674_372_231_9).abs() < within, "{p}");
        assert!((step.v[0] - -0.233_641_142_000_973_82).abs() < within, "{:?}", step.v);
        assert!((step.v[1] - 0.096_873_231_697_204_91).abs() < within, "{:?}", step.v);
    }
}

#[test]
fn along_a_diameter_a_hole_is_a_pair_of_walls() {
    // The same oscillator in one plane, and 30° from +y in two.
    for (e, direction) in [(0.0, 30.0), (0.7, 30.0), (1.0, 140.0), (0.5, 90.0)] {
        let [c, s] = heading(direction);
        let line = Scene::oscillator(1.2, 0.6, 900.0)
            .with_wall(Wall::upper("upper", 2e-3).with_restitution(e))
            .with_wall(Wall::lower("lower", -2e-3).with_restitution(e))
            .with_load(Load::harmonic(5.0, 6.0, 0.3))
            .with_initial(&[1e-3], &[0.2]);
        let round = with(isotropic(1.2, 0.6, 900.0), hole("hole", body(), 2e-3, e, 0.0))
            .with_load(load(Load::harmonic(5.0, 6.0, 0.3), Row::new(vec![(0, c), (1, s)])))
            .with_initial(&[1e-3 * c, 1e-3 * s], &[0.2 * c, 0.2 * s]);
        // Impacts, and sliding back and forth, multiply the roundings by little.
        let within = [1e-13 * 2e-3 * 1e3, 1e-13 * 1e3, 1e-10];
        let pushes = beside_line([&line, &round], [c, s], &MOREAU_JEAN, 8000, within);
        assert!(pushes > 10, "{e}: {pushes}");
    }
}

#[test]
fn a_plane_that_nothing_moves_stays_at_rest() {
    let scene = with(isotropic(1.0, 0.2, 400.0), hole("hole", body(), 1e-3, 0.5, 0.3))
        .with_load(load(Load::harmonic(3.0, 7.0, 0.0), Row::dof(0)));
    let line = Scene::oscillator(1.0, 0.2, 400.0)
        .with_wall(Wall::upper("upper", 1e-3).with_restitution(0.5))
        .with_wall(Wall::lower("lower", -1e-3).with_restitution(0.5))
        .with_load(Load::harmonic(3.0, 7.0, 0.0));
    let mut beside = Stepper::new(&line, &MOREAU_JEAN, 1e-4).unwrap();
    let mut pushed = 0;
    follow(&scene, 1e-4, 10_000, |step| {
        let other = beside.step().unwrap();
        assert_eq!((step.q[1], step.v[1]), (0.0, 0.0));
        assert!((step.q[0] - other.q[0]).abs() < 1e-14 && (step.v[0] - other.v[0]).abs() < 1e-11);
        pushed += u32::from(step.impulse[0] > 0.0);
    });
    assert!(pushed > 10);
}

/// The largest relative growth of the energy in a step of `scenes` random scenes.
fn growth(seeds: std::ops::Range<u64>, steps: u64) -> (f64, u64) {
    let (mut worst, mut unsettled) = (0.0_f64, 0);
    for seed in seeds {
        let mut draws = Draws::new(seed);
        let scene = random_scene(&mut draws, 0.0);
        let h = [1e-4, 1e-3, 5e-3][draws.below(3)];
        let mut before = energy(&scene, &scene.initial.q, &scene.initial.v);
        let stepper = follow(&scene, h, steps, |step| {
            let after = energy(&scene, step.q, step.v);
            worst = worst.max((after - before) / before.max(1e-12));
            before = after;
        });
        unsettled += stepper.counters().qp_unsettled;
    }
    (worst, unsettled)
}

#[test]
fn energy_never_grows() {
    let (worst, unsettled) = growth(0..300, 300);
    // Some roundings of the terms of the energy, up to n² of them.
    assert!(worst < 1e-12, "{worst:e}");
    assert_eq!(unsettled, 0);
}

#[test]
#[ignore = "minutes: cargo test --release --test holes frictionless -- --ignored --nocapture"]
fn energy_never_grows_in_a_hundred_thousand_scenes() {
    let (worst, unsettled) = growth(0..100_000, 300);
    println!("largest relative growth of the energy in a step: {worst:e}; steps not settled: {unsettled}");
    assert!(worst < 1e-11, "{worst:e}");
}

/// The change of velocity in a step of `h` seconds from `q`, `v` of a scene without loads and
/// damping, as the minimiser of a quadratic programme by Clarabel: over the walls and holes in
/// reach, with the bounds of [`signorini::Turning`].
fn by_clarabel(scene: &Scene, h: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
    let n = q.len();
    let System::Structure(structure) = &scene.system else { panic!("a structure") };
    let a = Symmetric::sum(&[(1.0, &structure.mass), (0.25 * h * h, &structure.stiffness)]);
    let mean: Vec<f64> = q.iter().zip(v).map(|(q, v)| q + 0.5 * h * v).collect();
    let mut b = vec![0.0; n];
    structure.stiffness.add_product(-h, &mean, &mut b);
    let (mut rows, mut hi) = (Vec::new(), Vec::new());
    for hole in scene.holes() {
        let (w, rate, ahead) = (hole.offset(q), hole.seen(v), hole.offset(&mean));
        let reach = ahead[0].hypot(ahead[1]);
        if reach < hole.gap * (1.0 - 1e-12) {
            continue;
        }
        let n = ahead.map(|x| x / reach);
        let approach = n[0] * rate[0] + n[1] * rate[1];
        let distance = w[0].hypot(w[1]);
        let arc = ((h * rate[0].hypot(rate[1]) / hole.gap).powi(2) / 8.0).clamp(1e-9, 0.999);
        let arriving = if distance < hole.gap * (1.0 - arc) {
            approach
        } else {
            ((w[0] * rate[0] + w[1] * rate[1]) / distance).clamp(0.0, approach.max(0.0))
        };
        let kept = if approach > 0.0 { hole.restitution * arriving + approach - arriving } else { approach };
        let (y, z) = (hole.at.y.entries(), hole.at.z.entries());
        let part = |row: &[(usize, f64)], share: f64| row.iter().map(move |&(i, x)| (i, share * x)).collect::<Vec<_>>();
        rows.push([part(y, n[0]), part(z, n[1])].concat());
        hi.push(-kept - approach);
    }
    for wall in scene.walls.iter().filter(|wall| !wall.is_round() && wall.gap(wall.coordinate(&mean)) <= 0.0) {
        let sign = -wall.side().sign();
        let approach = sign * wall.row().dot(v);
        let epsilon = if approach > 0.0 { wall.law.restitution().unwrap() } else { 1.0 };
        rows.push(wall.row().entries().iter().map(|&(i, x)| (i, sign * x)).collect());
        hi.push(-(1.0 + epsilon) * approach);
    }
    let g = Rows::new(n, rows.iter().map(Vec::as_slice));
    let lo = vec![f64::NEG_INFINITY; hi.len()];
    let problem = Problem { a, compliance: vec![0.0; hi.len()], g };
    let mut solver = Solver::new(problem, Backend::Clarabel, 0.1).expect("a sound programme");
    solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("solved").x.clone()
}

#[test]
fn without_friction_a_step_is_the_minimiser_that_clarabel_finds() {
    let mut crowded = 0;
    for seed in 1000..1040_u64 {
        let mut draws = Draws::new(seed);
        let scene = random_scene(&mut draws, 0.0);
        let h = 1e-3;
        let (mut q, mut v) = (scene.initial.q.clone(), scene.initial.v.clone());
        follow(&scene, h, 100, |step| {
            let pushing = step.impulse.iter().filter(|p| **p != 0.0).count();
            if pushing > 0 {
                let delta = by_clarabel(&scene, h, &q, &v);
                let scale = v.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
                for ((delta, after), before) in delta.iter().zip(step.v).zip(&v) {
                    // Clarabel's active set is solved for to rounding, of masses up to 1e2 apart.
                    assert!((before + delta - after).abs() < 1e-10 * scale, "seed {seed}, {}", step.end);
                }
                crowded += usize::from(pushing > 1);
            }
            (q, v) = (step.q.to_vec(), step.v.to_vec());
        });
    }
    assert!(crowded > 20, "{crowded}");
}

#[test]
fn a_turned_scene_has_the_turned_motion() {
    let scene = with(isotropic(1.0, 0.3, 200.0), hole("hole", body(), 1e-3, 0.5, 0.0));
    let scene = with_flats(scene, "flats", body(), &[(10.0, 0.9e-3), (130.0, 1.1e-3), (250.0, 0.8e-3)], 0.4, 0.0)
        .with_load(load(Load::harmonic(4.0, 9.0, 0.2), Row::new(vec![(0, 1.0), (1, 0.4)])))
        .with_initial(&[0.1e-3, -0.2e-3], &[0.05, 0.02]);
    let other = turned(&scene, 37.0);
    let mut beside = Stepper::new(&other, &MOREAU_JEAN, 1e-4).unwrap();
    let [c, s] = heading(37.0);
    let mut sums = Sums::default();
    follow(&scene, 1e-4, 2000, |step| {
        let image = beside.step().unwrap();
        let back = [c * image.q[0] + s * image.q[1], c * image.q[1] - s * image.q[0]];
        // 30 impacts multiply roundings of 1e-19 m.
        assert!((back[0] - step.q[0]).hypot(back[1] - step.q[1]) < 1e-9 * 1e-3, "{}", step.end);
        sums.observe(&scene, step);
    });
    assert!(sums.arrivals > 20, "{sums:?}");
}

const PENALTY: Scheme =
    Scheme::Penalty { law: PenaltyLaw::Linear { stiffness: 1e7, damping: 0.0 }, integrator: Integrator::Trapezoidal };

#[test]
fn other_schemes_refuse_round_holes_and_say_why() {
    let scene = free(0.5);
    for (scheme, words) in [
        (Scheme::PaoliSchatzman, "does not keep the energy"),
        (Scheme::Newmark, "does not keep the energy"),
        (PENALTY, "expected discrete-gradient"),
    ] {
        let error = Stepper::new(&scene, &scheme, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains(words), "{error}");
    }
    for backend in [Backend::Condensed, Backend::Clarabel, Backend::Clamp] {
        let error = Stepper::new(&scene, &Method { scheme: MOREAU_JEAN, backend }, 1e-4).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("no quadratic programme"), "{error}");
    }
    // The contract states the split, and only moreau-jean's does.
    let Promise { round, rigid, .. } = MOREAU_JEAN.contract().promise;
    assert!(round.is_some() && rigid.displacement != Some(Bound::End));
    assert!(Scheme::PaoliSchatzman.contract().promise.round.is_none());
}

#[test]
fn a_recorded_run_accounts_for_its_momentum_and_shows_the_forces() {
    let scene = whirl(0.010_472_166_918_182_78, 0.0).with_duration(0.4);
    let run = run(&scene, &MOREAU_JEAN, &Options::with_step(1e-4)).unwrap();
    assert_eq!(run.findings, []);
    let [y, z] = &run.trajectory.hole_forces()[0];
    let last = y.last().unwrap().hypot(*z.last().unwrap());
    assert!((last / 7.434_637_702_628_067 - 1.0).abs() < 1e-6, "{last}");
    assert_eq!(run.trajectory.holes(), ["hole"]);
    // One contact from start to end, at the only wall.
    let contacts = run.trajectory.contacts();
    assert_eq!((contacts.len(), contacts[0].wall, contacts[0].end), (1, 0, None));
    assert_eq!(scene.wall_name(0), Some("hole"));
    assert!((contacts[0].impulse / 0.4 / 7.434_637_702_628_067 - 1.0).abs() < 1e-4);
}
