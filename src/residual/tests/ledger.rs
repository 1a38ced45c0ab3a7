//! What walls and holes that are springs store, and what their dashpots take.

use super::*;
use crate::residual::energy::Ledger;
use crate::scene::{Load, Wall};
use crate::step::Law;

const H: f64 = 0.25;

/// 64 N/m.
fn spring(damping: f64) -> WallLaw {
    WallLaw::Elastic { stiffness: 64.0, damping }
}

fn pad(position: f64, damping: f64) -> Wall {
    Wall { law: spring(damping), ..Wall::upper("pad", position) }
}

fn start(scene: &Scene, balance: Balance, q: &[f64], v: &[f64]) -> Judge {
    let (promise, tolerances) = (Promise::springs(Law::Ends(0.5)), Tolerances::of(Conserves::Nothing));
    Judge::new(scene, Contract { balance, promise, instant: 1.0, tolerances, divides: false }, H, q, v)
}

#[test]
fn a_start_within_springs_is_a_start_with_their_energy() {
    // ½ · 64 · 0.25² = 2 J in each. Without a force a damped wall stores nothing: the body leaves
    // it so fast that it lags behind. Opposite the wall that motion presses on the hole.
    for (damping, v, in_wall) in [(0.0, 0.0, 2.0), (0.0, -9.0, 2.0), (4.0, 0.0, 2.0), (4.0, -9.0, 0.0)] {
        let walls = body([4.0; 2], 0.0).with_wall(pad(0.5, damping));
        let scene = with_hole(walls.clone(), "ring", 0.5, spring(damping));
        let own = 0.5 * 4.0 * v * v;
        for (scene, at, stored) in [
            (&walls, 0.75, in_wall),
            (&walls, 0.25, 0.0),
            (&scene, 0.75, 2.0 * in_wall),
            (&scene, -0.75, 2.0),
            (&scene, 0.25, 0.0),
        ] {
            let judge = start(scene, Balance::Theta(0.5), &[at, 0.0], &[v, 0.0]);
            let energy = judge.energy.report();
            assert_eq!(energy.initial_j, own + stored, "damping {damping}, {v} m/s, {at} m");
            assert_eq!(judge.energy.walls_store(), stored > 0.0);
        }
    }
}

#[test]
fn a_spring_without_a_dashpot_stores_with_or_without_a_push_and_takes_nothing() {
    let wall = body([4.0; 2], 0.0).with_wall(pad(0.5, 0.0));
    let ring = with_hole(body([4.0; 2], 0.0), "ring", 0.5, spring(0.0));
    for scene in [&wall, &ring] {
        for push in [0.0, 1.0] {
            let mut judge = start(scene, Balance::Theta(0.5), &[0.25, 0.0], &[]);
            let mut made = Made { q: vec![0.75, 0.0], ..Made::rest(scene, H) };
            made.impulse[0] = if scene.walls.is_empty() { push } else { -push };
            made.normal.fill([1.0, 0.0]);
            judge.observe(&made.step());
            assert_eq!(judge.energy.report().final_j, 2.0, "push {push}");
            // Out again: all of it comes back.
            made.q[0] = 0.25;
            judge.observe(&made.step());
            let energy = judge.energy.report();
            assert_eq!((energy.final_j, energy.wall_damping_j, energy.residual_j), (0.0, 0.0, 0.0), "push {push}");
        }
    }
}

#[test]
fn a_staggered_run_starts_half_a_step_before_its_first_instant() {
    // 4 kg on 100 N/m that come to 1 m at 2 m/s, 0.75 m inside a wall: half a step before they are
    // at 0.75 m. The wall stores the mean of 18 J there and 2 J a step before.
    for damping in [0.0, 0.5] {
        let scene = Scene::oscillator(4.0, 0.0, 100.0).with_wall(pad(0.25, damping));
        for (b, strain) in [(0.0, 50.0 * (0.5625 - 0.0625)), (0.25, 50.0 * 0.5625)] {
            let mut judge = start(&scene, Balance::Staggered(b), &[1.0], &[2.0]);
            let made = Made { q: vec![1.5], before: vec![2.0], after: vec![2.0], ..Made::rest(&scene, H) };
            judge.observe(&made.step());
            assert_eq!(judge.energy.report().initial_j, 8.0 + strain + 10.0, "b = {b}, damping {damping}");
        }
    }
}

#[test]
fn the_energy_of_a_staggered_run_after_a_blow_is_that_before_the_place_it_leads_to() {
    // 16 N s on 4 kg at rest: 4 m/s, and 0.25 m less than those give over the whole step, since the
    // rule counts the blow early. Half a step before 0.75 m it is at 0.25 m, and a step before
    // outside of the wall.
    let scene = Scene::oscillator(4.0, 0.0, 100.0).with_wall(pad(0.0, 0.0)).with_load(Load::impulse(16.0, 0.0625));
    for (b, strain) in [(0.0, 50.0 * (0.0625 - 0.25)), (0.25, 50.0 * 0.0625)] {
        let mut judge = start(&scene, Balance::Staggered(b), &[0.0], &[0.0]);
        let made = Made { q: vec![0.75], after: vec![4.0], ..Made::rest(&scene, H) };
        judge.observe(&made.step());
        let energy = judge.energy.report();
        assert_eq!((energy.initial_j, energy.final_j), (0.0, 32.0 + strain + 0.5 * 18.0), "b = {b}");
    }
}

#[test]
fn along_exact_motion_a_damped_wall_stores_while_it_pushes() {
    // 2 J in a wall, on a mass of 4 kg at 3 m/s and beside a spring that stores 9 J.
    let diagonal = |x: f64| Symmetric::diagonal(&[x]);
    let (mass, damping, stiffness) = (diagonal(4.0), diagonal(0.0), diagonal(32.0));
    let damped = Scene::structure(Structure { mass, damping, stiffness }).with_wall(pad(0.5, 4.0));
    let mut undamped = damped.clone();
    undamped.walls[0] = pad(0.5, 0.0);
    let own = 0.5 * (4.0 * 9.0 + 32.0 * 0.5625);
    for (scene, force, stored) in [(&damped, -1.0, 2.0), (&damped, 0.0, 0.0), (&undamped, 0.0, 2.0)] {
        let found = Ledger::energy_at(scene, &[0.75], &[3.0], |_| force);
        assert_eq!(found, own + stored, "{force} N");
    }
}

#[test]
fn a_damped_wall_in_touch_at_the_end_of_exact_motion_holds_its_energy() {
    use crate::flow::{Arc, HeldRows, Series, SeriesBody, SeriesStart, Start};
    // The motion is free, and the wall only told.
    let one = Scene::oscillator(4.0, 0.0, 0.0).with_wall(pad(0.5, 4.0));
    let many = Scene::structure(one.system.structure()).with_wall(pad(0.5, 4.0));
    let System::Oscillator(oscillator) = one.system else { panic!("one degree of freedom") };
    let forcing = Forcing::on(0, &[]);
    let mut arc = Arc::new(oscillator, 0, &forcing);
    let (time, late, span, length) = (0.0, 0.0, 0.5, 1.0);
    let from = Start { time, late, state: [0.25, 1.0], forcing: &forcing, extra: 0.0, span, length };
    arc.begin(&from, std::iter::empty(), None);
    let mut body = SeriesBody::new(&many).expect("a mass");
    let mut series = Series::new(&body);
    let from = SeriesStart { time, q: &[0.25], v: &[1.0], extra: &[0.0], until: time + span, reach: f64::INFINITY };
    series.begin(&mut body, &from, &[], &HeldRows::with_room(1), std::iter::empty(), &mut [0.0; 4]);
    for (scene, path) in [(&one, Path::Exact(&arc)), (&many, Path::Series(&series))] {
        for (force, stored) in [(0.0, 0.0), (-1.0, 2.0)] {
            let mut judge = start(scene, Balance::Exact, &[0.25], &[1.0]);
            let made = Made {
                q: vec![0.75],
                before: vec![1.0],
                after: vec![1.0],
                force: vec![force],
                ..Made::rest(scene, span)
            };
            judge.observe(&made.along(path));
            assert_eq!(judge.energy.report().final_j, 2.0 + stored, "{force} N");
        }
    }
}
