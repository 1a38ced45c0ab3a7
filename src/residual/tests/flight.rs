//! The exact motion of one degree of freedom.

use super::*;
use crate::flow::{Arc, Start, Touch};
use crate::scene::{Load, Wall};

fn start(scene: &Scene, q: f64, v: f64) -> Judge {
    stretch::start(scene, (&[q], &[v]))
}

/// The exact motion of `scene` from a time and state on, over `span` seconds, with these walls in
/// touch, and the step that it makes.
fn arc(scene: &Scene, (time, q, v): (f64, f64, f64), span: f64, touching: &[Touch]) -> (Arc, Made) {
    let System::Oscillator(oscillator) = scene.system else { panic!("one degree of freedom") };
    let forcing = Forcing::on(0, &scene.loads);
    let mut arc = Arc::new(oscillator, touching.len(), &forcing);
    let from = Start { time, late: 0.0, state: [q, v], forcing: &forcing, extra: 0.0, span, length: 1.0 };
    arc.begin(&from, touching.iter().copied(), None);
    let (end, after) = arc.state(time + span);
    let force = |wall: usize| arc.contact_force(wall, time + span);
    let made = Made {
        start: time,
        end: time + span,
        q: vec![end],
        before: vec![v],
        after: vec![after],
        force: (0..scene.walls.len()).map(force).collect(),
        ..Made::rest(scene, span)
    };
    (arc, made)
}

fn touch(position: f64, stiffness: f64, damping: f64) -> Touch {
    Touch { wall: 0, position, stiffness, damping }
}

#[test]
fn a_load_that_is_another_counts_by_its_mean_force_and_works() {
    // 4 kg under 3 N for half a second, long after the start; the judge knows of 3.5 N.
    let pushed = |force: f64| Scene::oscillator(4.0, 0.0, 0.0).with_load(Load::constant(force));
    let (arc, made) = arc(&pushed(3.0), (8.0, 0.0, 2.0), 0.5, &[]);
    let mut judge = start(&pushed(3.5), 0.0, 2.0);
    judge.observe(&made.along(Path::Exact(&arc)));
    let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-12;
    assert!(
        near(judge.balance.largest, 0.5) && near(judge.balance.force.value, 0.25),
        "{} {}",
        judge.balance.largest,
        judge.balance.force.value
    );
    assert_eq!(judge.balance.scale, 1.75);
    let way = 2.0 * 0.5 + 0.5 * 0.75 * 0.25;
    let energy = judge.energy.report();
    assert!(near(energy.load_work_j, 3.5 * way) && near(-energy.residual_j, 0.5 * way), "{energy:?}");
    // 2.375 m/s at the end, and all work along the motion.
    let last = 2.0 * 2.375 * 2.375;
    assert!(near(energy.final_j, last) && near(energy.exchanged_j, last + 3.5 * way), "{energy:?}");
}

#[test]
fn a_body_behind_a_rigid_wall_is_accused_though_it_comes_back_within_the_step() {
    // To 1 m and back in 2 s; the judge's wall stands at 0.75 m.
    let thrown = |position: f64| {
        let wall = Wall::upper("wall", position);
        Scene::oscillator(4.0, 0.0, 0.0).with_wall(wall).with_load(Load::constant(-8.0))
    };
    let (arc, made) = arc(&thrown(9.0), (0.0, 0.0, 2.0), 2.0, &[]);
    let mut judge = start(&thrown(0.75), 0.0, 2.0);
    judge.observe(&made.along(Path::Exact(&arc)));
    // The nearest instant of a panel of eight or more is within 0.25 s of the highest point: at
    // most 6 cm below it.
    let depth = judge.walls.gaps.outside.excess.value;
    assert!((0.18..0.25 + 1e-12).contains(&depth) && (judge.walls.depth[0] - depth).abs() < 1e-9, "{depth}");
}

#[test]
fn the_largest_energy_within_a_stretch_includes_that_of_springs() {
    // Pressed from rest by a force f into a spring: after half a period at depth 2f/k, back after
    // a whole one. The spring is the body's own, or a wall's whose dashpot takes next to nothing.
    let (k, f, c) = (100.0, 5.0, 1e-9);
    let loaded = |scene: Scene| scene.with_load(Load::constant(f));
    let own = loaded(Scene::oscillator(1.0, 0.0, k));
    let wall = Wall::upper("pad", 0.0).with_elasticity(k, c);
    let pad = loaded(Scene::oscillator(1.0, 0.0, 0.0).with_wall(wall));
    let period = std::f64::consts::TAU / 10.0;
    for (scene, touching) in [(own, &[][..]), (pad, &[touch(0.0, k, c)])] {
        let (arc, made) = arc(&scene, (0.0, 0.0, 0.0), period, touching);
        let mut judge = start(&scene, 0.0, 0.0);
        judge.observe(&made.along(Path::Exact(&arc)));
        // The instants beside the middle are 0.3 rad from it: the depth is (1 + cos 0.3)/2 there.
        let largest = judge.energy.report().largest_j / (2.0 * f * f / k);
        assert!((0.95..1.0 + 1e-9).contains(&largest), "{largest}");
        // And so is the largest place for rounding errors.
        let reach = judge.noise.path() / judge.noise.of(2.0 * f / k);
        assert!((0.95..1.0 + 1e-9).contains(&reach), "{reach}");
        assert_eq!(judge.findings(), []);
    }
}

#[test]
fn a_damped_oscillator_with_loads_keeps_its_balance_and_its_ledger() {
    for s in [1.0, -1.0] {
        let scene = Scene::oscillator(4.0, 2.0, 100.0).with_load(Load::constant(3.0 * s));
        let (arc, made) = arc(&scene, (8.0, 0.25 * s, -s), 1.5, &[]);
        let mut judge = start(&scene, 0.25 * s, -s);
        judge.observe(&made.along(Path::Exact(&arc)));
        let energy = judge.energy.report();
        // Rounding of some 30 N and 6 J.
        assert!(
            judge.balance.largest < 1e-12 && energy.residual_j.abs() < 1e-13,
            "{} {energy:?}",
            judge.balance.largest
        );
    }
}

#[test]
fn extra_forces_are_loads_and_rounding_is_that_of_the_largest_place_speed_and_force() {
    // 4 kg under 3 N and 5 N more, from rest at 0 in either direction and back: −2 m and 4 m/s.
    for s in [1.0, -1.0] {
        let scene = Scene::oscillator(4.0, 0.0, 0.0).with_load(Load::constant(3.0 * s));
        let System::Oscillator(oscillator) = scene.system else { panic!("one degree of freedom") };
        let forcing = Forcing::on(0, &scene.loads);
        let mut arc = Arc::new(oscillator, 0, &forcing);
        let (time, late, span, length) = (0.0, 0.0, 4.0, 1.0);
        let state = [0.0, -4.0 * s];
        arc.begin(
            &Start { time, late, state, forcing: &forcing, extra: 5.0 * s, span, length },
            std::iter::empty(),
            None,
        );
        let made = Made {
            q: vec![0.0],
            before: vec![-4.0 * s],
            after: vec![4.0 * s],
            extra: vec![5.0 * s],
            ..Made::rest(&scene, span)
        };
        let mut judge = start(&scene, 0.0, -4.0 * s);
        judge.observe(&made.along(Path::Exact(&arc)));
        assert!(
            judge.balance.largest < 1e-12 && judge.balance.scale == 4.0,
            "{} {}",
            judge.balance.largest,
            judge.balance.scale
        );
        // The instants beside the middle are 0.37 s from it or less: 14 cm.
        let reach = judge.noise.path() / judge.noise.of(4.0 * 2.0);
        assert!((0.96..=1.0).contains(&reach), "{reach}");
        // The speeds at the ends, and 8 N.
        let force = judge.noise.force_over(0.5) / judge.noise.of(4.0 * 2.0 / 0.5 + 4.0);
        assert!((force - 1.0).abs() < 1e-12, "{force}");
    }
}

#[test]
fn a_spring_that_pushes_far_before_its_wall_is_accused() {
    let scene = |position: f64| {
        Scene::oscillator(4.0, 0.0, 0.0).with_wall(Wall::upper("pad", position).with_elasticity(8.0, 0.0))
    };
    let (arc, made) = arc(&scene(1.0), (0.0, 1.5, 0.0), 0.25, &[touch(1.0, 8.0, 0.0)]);
    let mut judge = start(&scene(3.0), 1.5, 0.0);
    judge.observe(&made.along(Path::Exact(&arc)));
    // 4 N at the start, and no more than 1 % less at the first instant.
    assert!((3.96..=4.0).contains(&judge.walls.law.value), "{}", judge.walls.law.value);
}

#[test]
fn the_rounding_of_a_momentum_is_that_of_the_largest_one_and_of_the_instants_of_the_load() {
    // 4 kg at 1 m/s, which had 3 m/s at the start of the run, under a load that changes by 1 N/s.
    let hum = Load::harmonic(1.0, 1.0 / std::f64::consts::TAU, 0.0);
    let free = Scene::oscillator(4.0, 0.0, 0.0);
    let (time, span, more) = (64.0, 0.5, f64::exp2(-44.0));
    let (arc, made) = arc(&free, (time, 0.0, 1.0), span, &[]);
    assert_eq!(made.after, [1.0]);
    let scene = free.with_load(hum);
    let mut judge = start(&scene, 0.0, 3.0);
    let made = Made { before: vec![1.0 + more], ..made };
    let along = energy::Along::default();
    let open = judge.energy.observe_arc(&made.along(Path::Exact(&arc)), &arc, &[0.0], &along);
    // Two units of 12 N s, and two of 1 N/s over the time since the start, for half a second.
    let rounding = f64::EPSILON * (2.0 * 12.0 + 2.0 * (time + span) * span);
    assert_less(open, 4.0 * more, rounding);
}

#[test]
fn a_dashpot_at_constant_speed_takes_its_force_times_the_way() {
    // Pressed by c v into a wall that is a dashpot alone, on either side.
    let (c, v) = (3.0, 0.5);
    for (s, wall) in [(1.0, Wall::upper("pad", 1.0)), (-1.0, Wall::lower("pad", -1.0))] {
        let scene = Scene::oscillator(4.0, 0.0, 0.0)
            .with_wall(wall.with_elasticity(0.0, c))
            .with_load(Load::constant(s * c * v));
        let (arc, made) = arc(&scene, (1.0, s * 1.5, s * v), 2.0, &[touch(s, 0.0, c)]);
        let mut judge = start(&scene, s * 1.5, s * v);
        judge.observe(&made.along(Path::Exact(&arc)));
        let (energy, lost) = (judge.energy.report(), c * v * v * 2.0);
        assert!((energy.wall_damping_j - lost).abs() < 1e-12, "{energy:?}");
        assert!((energy.load_work_j - lost).abs() < 1e-12 && energy.residual_j.abs() < 1e-12, "{energy:?}");
        assert!(
            (judge.walls.force_scale - c * v).abs() < 1e-12 && judge.walls.law.value < 1e-12,
            "{}",
            judge.walls.law.value
        );
    }
}

#[test]
fn a_force_off_its_law_counts_less_what_the_rounding_of_the_place_explains() {
    // A very heavy body passes on at 1 m/s after an hour, behind the face of a soft spring a
    // kilometre away that the judge knows to be 1 nm nearer, or further.
    let (position, time, nearer) = (1024.0, 4096.0, f64::exp2(-30.0));
    let scene = |position: f64| {
        Scene::oscillator(f64::exp2(40.0), 0.0, 0.0).with_wall(Wall::upper("pad", position).with_elasticity(1.0, 0.0))
    };
    // 32 units of 1024.5 and 1024 m, and of an hour at 1 m/s.
    let rounding = 32.0 * f64::EPSILON * (1024.5 + 1024.0 + 4096.0);
    let (arc, made) = arc(&scene(position), (time, position + 0.5, 1.0), 1e-3, &[touch(position, 1.0, 0.0)]);
    for by in [nearer, -nearer] {
        let mut judge = start(&scene(position - by), position + 0.5, 1.0);
        judge.observe(&made.along(Path::Exact(&arc)));
        // Places are rounded to 2e-13 m, and the body moves on by a millimetre.
        let error = judge.walls.law.value;
        assert!((error - (nearer - rounding)).abs() < 0.01 * rounding, "{error} {nearer} {rounding}");
    }
}

#[test]
fn at_an_instant_blows_and_impacts_act_between_the_velocities_of_the_step() {
    // 4 kg at 3 m/s, turned round by a wall to 1.5 m/s, an instant after an arc that ended at
    // 2 m/s.
    let scene = Scene::oscillator(4.0, 0.0, 0.0).with_wall(Wall::upper("wall", 1.0).with_restitution(0.5));
    let (arc, made) = arc(&scene, (0.0, 0.0, 2.0), 0.5, &[]);
    let made = Made { start: 0.5, before: vec![3.0], after: vec![-1.5], jump: vec![-18.0], ..made };
    let mut judge = start(&scene, 1.0, 3.0);
    judge.observe(&made.along(Path::Exact(&arc)));
    let energy = judge.energy.report();
    assert_eq!((energy.initial_j, energy.final_j, energy.impact_loss_j), (18.0, 4.5, 13.5));
    assert_eq!((energy.residual_j, judge.walls.tension, judge.balance.largest), (0.0, 0.0, 0.0));
    // A wall that pulls.
    let made = Made { jump: vec![18.0], ..made };
    judge.observe(&made.along(Path::Exact(&arc)));
    assert_eq!(judge.walls.tension, 18.0);
}
