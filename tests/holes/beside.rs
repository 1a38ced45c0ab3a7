//! Walls beside a round hole that nothing reaches: a scheme that steps round holes makes the steps
//! that it makes without the hole, where other code computes them.

use crate::random_structures::at;
use crate::rubbing::{body, hole, isotropic, load, with};
use signorini::residual::{Energy, Judge};
use signorini::{Contact, Integrator, Load, PenaltyLaw, Row, Scene, Scheme, State, Step, Stepper, Wall, heading};

/// Gap of the hole, m: far more than the structure moves.
const FAR: f64 = 1.0;

fn rigid() -> Wall {
    hole("far", body(), FAR, 0.5, 0.0)
}

fn ring() -> Wall {
    rigid().with_elasticity(1e4, 10.0)
}

/// The schemes, and the hole with which each of them is stepped by code of its own.
fn schemes() -> [(Scheme, Wall); 6] {
    let law = PenaltyLaw::Linear { stiffness: 3e4, damping: 20.0 };
    [
        (Scheme::MoreauJean { theta: 0.5 }, rigid()),
        (Scheme::MoreauJean { theta: 0.5 }, ring()),
        (Scheme::MoreauJean { theta: 0.8 }, ring()),
        (Scheme::ImplicitEuler, rigid()),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, rigid()),
        (Scheme::Penalty { law, integrator: Integrator::DiscreteGradient }, rigid()),
    ]
}

/// A body that both planes throw against rigid and elastic walls on several rows, under loads and
/// blows, one of them half way between two steps.
fn scene(damping: f64) -> Scene {
    let oblique = || Row::new(vec![(0, 0.6), (1, 0.8)]);
    isotropic(1.2, damping, 300.0)
        .with_wall(at(Wall::upper("rigid", 0.9e-3).with_restitution(0.6), Row::dof(0)))
        .with_wall(at(Wall::lower("spring", -0.7e-3).with_elasticity(2e4, 15.0), Row::dof(0)))
        .with_wall(at(Wall::upper("pad", 1e-3).with_elasticity(5e3, 40.0), oblique()))
        .with_wall(at(Wall::lower("floor", -0.6e-3).with_restitution(0.3), Row::dof(1)))
        .with_load(load(Load::harmonic(9.0, 9.0, 0.4), oblique()))
        .with_load(load(Load::constant(-2.0), Row::dof(1)))
        .with_load(load(Load::impulse(0.2, 0.050_05), Row::dof(0)))
        .with_load(load(Load::impulse(-0.3, 0.120_07), oblique()))
        .with_initial(&[0.5e-3, -0.2e-3], &[0.3, -0.1])
}

/// Fails unless both steps are the same up to `small` m, m/s and N s.
fn same(one: &Step<'_>, other: &Step<'_>, what: &str, small: [f64; 3]) {
    let near = |a: &[f64], b: &[f64], small: f64, of: &str| {
        let fits = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= small);
        assert!(fits, "{what}, {of} at {} s: {a:?}, {b:?}", one.end);
    };
    let [place, speed, push] = small;
    near(one.q, other.q, place, "q");
    near(one.v, other.v, speed, "v");
    near(one.velocity_before, other.velocity_before, speed, "the velocity before");
    near(one.velocity_after, other.velocity_after, speed, "the velocity after");
    // Behind the walls stand holes of one scene, which do not push.
    let (walls, holes) = one.impulse.split_at(other.impulse.len());
    near(walls, other.impulse, push, "impulses");
    let h = one.end - one.start;
    near(&one.force[..walls.len()], other.force, push / h, "forces");
    assert!(holes.iter().all(|p| *p == 0.0), "{what}: {holes:?}");
    let ended = |step: &Step<'_>| step.closed.iter().map(|c| (c.wall, c.end.is_some())).collect::<Vec<_>>();
    assert_eq!(ended(one), ended(other), "{what}, contacts that end at {} s", one.end);
    for (a, b) in one.closed.iter().zip(other.closed) {
        near(&[a.approach_speed], &[b.approach_speed], speed, "an approach");
        near(&[a.impulse], &[b.impulse], 1e3 * push, "the impulse of an episode");
    }
}

#[test]
fn a_hole_out_of_reach_changes_no_step() {
    let h = 1e-4;
    for (scheme, far) in schemes() {
        // One damper is far beyond critical, and once the spring is the only wall.
        for (damping, lone) in [(0.0, false), (3.0, false), (3.0, true), (500.0, false)] {
            let what = format!("{scheme}, damping {damping}, one wall: {lone}, {far:?}");
            let mut scene = scene(damping);
            scene.walls.retain(|wall| !lone || wall.name == "spring");
            let mut beside = Stepper::new(&with(scene.clone(), far.clone()), &scheme, h).expect("with the hole");
            let mut bare = Stepper::new(&scene, &scheme, h).expect("without it");
            let mut pushed = [0_u32; 4];
            for number in 0..3000_u32 {
                // An extra force for a while, every other step; and once both start anew in the
                // walls.
                let extra = [0.7, -1.1].map(|f| if number % 2 == 1 { f } else { 0.0 });
                let given = (800..1000).contains(&number).then_some(extra);
                if number == 2000 {
                    let state = State { q: vec![-0.8e-3, -0.6e-3], v: vec![-0.2, 0.1] };
                    let time = h * 1500.0;
                    beside.set_state(time, &state).expect("a state");
                    bare.set_state(time, &state).expect("a state");
                }
                let (one, other) = match given {
                    Some(extra) => (beside.step_with(&extra), bare.step_with(&extra)),
                    None => (beside.step(), bare.step()),
                };
                let (one, other) = (one.expect("a step"), other.expect("a step"));
                // Rounding of the two solvers, 1e-10 of the gaps of 1 mm; over h in velocities and
                // impulses.
                same(&one, &other, &what, [1e-13, 1e-9, 1e-9]);
                one.impulse.iter().zip(&mut pushed).for_each(|(p, sum)| *sum += u32::from(*p != 0.0));
            }
            let walls = &pushed[..scene.walls.len()];
            assert!(damping > 3.0 || walls.iter().all(|&count| count > 3), "{what}: {pushed:?}");
            assert_eq!(beside.time(), bare.time(), "{what}");
        }
    }
}

#[test]
fn along_a_diameter_the_contacts_are_those_of_two_walls() {
    let (h, gap, degrees) = (1e-4, 1e-3, 110.0);
    let [c, s] = heading(degrees);
    let along = Row::new(vec![(0, c), (1, s)]);
    // Once a rigid hole is stepped by the code for rings, since one of those is far away.
    let each = schemes().map(|(scheme, hole)| (scheme, hole, None));
    for (scheme, hole, far) in each.into_iter().chain([(Scheme::MoreauJean { theta: 0.5 }, rigid(), Some(ring()))]) {
        let law = hole.law;
        for damping in [0.0, 4.0] {
            let what = format!("{scheme}, damping {damping}, {law:?}");
            let wall = |wall: Wall| Wall { law, ..wall };
            let mut line = Scene::oscillator(1.2, damping, 300.0)
                .with_wall(wall(Wall::upper("upper", gap)))
                .with_wall(wall(Wall::lower("lower", -gap)))
                .with_initial(&[0.2e-3], &[0.1]);
            let mut round = with(isotropic(1.2, damping, 300.0), hole.clone().with_position(gap))
                .with_initial(&[0.2e-3 * c, 0.2e-3 * s], &[0.1 * c, 0.1 * s]);
            if let Some(far) = far.clone() {
                round = with(round, Wall { name: "ring".to_owned(), ..far });
            }
            // Pressed onto one side, with blows into it and off it, and one onto the other side;
            // within steps and at their ends.
            let small = [(-2e-4, 0.09), (-2e-4, 0.095_02), (2e-4, 0.146_04), (-2e-4, 0.148_06)];
            let blows = [(0.04, 0.100_03), (0.05, 0.150_08), (-0.08, 0.200_05), (-0.4, 0.25), (0.1, 0.300_02)];
            let blows = blows.into_iter().chain(small).map(|(impulse, time)| Load::impulse(impulse, time));
            for one in [Load::constant(5.0), Load::harmonic(2.0, 3.0, 0.1)].into_iter().chain(blows) {
                line = line.with_load(one.clone());
                round = round.with_load(load(one, along.clone()));
            }
            let mut planar = Stepper::new(&line, &scheme, h).expect("between walls");
            let mut turning = Stepper::new(&round, &scheme, h).expect("in the hole");
            let judge = |stepper: &Stepper| {
                let state = stepper.state();
                Judge::new(stepper.scene(), stepper.contract(), h, &state.q, &state.v)
            };
            let (mut judge_of_line, mut judge_of_hole) = (judge(&planar), judge(&turning));
            let (mut pushes, mut ended) = (0_u64, 0);
            for number in 0..5000_u32 {
                if number == 4000 {
                    let (q, v) = (gap, 0.05);
                    planar.set_state(0.2, &State { q: vec![q], v: vec![v] }).expect("a state");
                    let state = State { q: vec![q * c, q * s], v: vec![v * c, v * s] };
                    turning.set_state(0.2, &state).expect("a state");
                }
                let extra = f64::from(u8::from((1200..1300).contains(&number) && number % 2 == 0));
                let (one, other) = if (1000..1400).contains(&number) {
                    (turning.step_with(&[extra * c, extra * s]), planar.step_with(&[extra]))
                } else {
                    (turning.step(), planar.step())
                };
                let (one, other) = (one.expect("a step"), other.expect("a step"));
                // A judge cannot go on where a stepper starts anew.
                if number < 4000 {
                    judge_of_hole.observe(&one);
                    judge_of_line.observe(&other);
                }
                let near = |a: f64, b: f64, small: f64, of: &str| {
                    assert!((a - b).abs() < small, "{what}, {of} at {} s: {a}, {b}", one.end);
                };
                near(c * one.q[0] + s * one.q[1], other.q[0], 1e-13, "w");
                near(c * one.v[0] + s * one.v[1], other.v[0], 1e-9, "its velocity");
                let p = (other.impulse[0] + other.impulse[1]).abs();
                near(one.impulse[0], p, 1e-9, "impulses");
                pushes += u64::from(p > 0.0);
                assert_eq!(
                    one.closed.len(),
                    other.closed.len(),
                    "{what}, {} s: {:?}, {:?}",
                    one.end,
                    one.closed,
                    other.closed
                );
                for (a, b) in one.closed.iter().zip(other.closed) {
                    assert_eq!((a.wall, a.end.is_some()), (0, b.end.is_some()), "{what}: {a:?}, {b:?}");
                    near(a.start, b.start, 1e-12, "the start of a contact");
                    near(a.end.unwrap_or(0.0), b.end.unwrap_or(0.0), 1e-12, "its end");
                    near(a.impulse, b.impulse.abs(), 1e-7, "the impulse of a contact");
                    near(a.approach_speed, b.approach_speed, 1e-9, "the approach");
                    let left = |contact: &Contact| contact.departure_speed.unwrap_or(f64::NAN);
                    near(left(a), left(b), 1e-9, "the departure");
                    near(a.peak_force.unwrap_or(0.0), b.peak_force.unwrap_or(0.0), 1e-5, "the peak");
                    ended += 1;
                }
            }
            assert!(pushes > 500 && ended > 4, "{what}: {pushes}, {ended}");
            // Steps without contact are no programmes.
            let counters = turning.counters();
            let work =
                if matches!(scheme, Scheme::Penalty { .. }) { counters.newton_iterations } else { counters.qp_solves };
            assert!((pushes..=3 * pushes).contains(&work), "{what}: {pushes} pushes, {counters:?}");
            // The ledgers agree entry by entry, and so does how deep the body came.
            let (one, other) = (judge_of_hole.residuals(), judge_of_line.residuals());
            assert_eq!((judge_of_hole.findings(), judge_of_line.findings()), (vec![], vec![]), "{what}");
            let entries = |e: &Energy| {
                let ends = [e.initial_j, e.final_j, e.largest_j, e.load_work_j];
                (ends, [e.damping_j, e.impact_loss_j, e.wall_damping_j, e.friction_j, e.exchanged_j])
            };
            let ((a, b), (c, d)) = (entries(&one.energy), entries(&other.energy));
            for (x, y) in a.iter().chain(&b).zip(c.iter().chain(&d)) {
                // Rounding of states, over ten thousand steps.
                assert!(
                    (x - y).abs() < 1e-9 * other.energy.exchanged_j,
                    "{what}: {:?}, {:?}",
                    one.energy,
                    other.energy
                );
            }
            let deepest = other.depth_m.iter().fold(0.0_f64, |most, d| most.max(*d));
            assert!((one.depth_m[0] - deepest).abs() < 1e-12, "{what}: {:?}, {:?}", one.depth_m, other.depth_m);
        }
    }
}
