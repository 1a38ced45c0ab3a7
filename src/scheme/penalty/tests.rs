//! Each step satisfies the balance of the head of the file with the forces of its walls, and the
//! slopes that Newton's method is given are those of the forces.

use super::super::line::Line;
use super::super::matrices::Matrices;
use super::*;
use crate::hash::{mix, unit};
use crate::linear::Symmetric;
use crate::scene::{Load, Row, Side, Structure, Wall};

const MEANS: [(f64, Mean); 3] = [(0.5, Mean::Ends), (1.0, Mean::Ends), (0.5, Mean::DiscreteGradient)];

const LAWS: [WallLaw; 4] = [
    WallLaw::Elastic { stiffness: 200.0, damping: 0.0 },
    WallLaw::Elastic { stiffness: 200.0, damping: 0.5 },
    WallLaw::Quartic { epsilon: 0.5, span: 3.0 },
    WallLaw::HuntCrossley { stiffness: 200.0, exponent: 2.5, dissipation: 0.3 },
];

/// From −1 to 1, the same in every run.
fn draw(stream: u64, index: usize) -> f64 {
    2.0 * unit(mix(12, stream, index as u64)) - 1.0
}

/// The energy of a law at the depth `s`, and its force there without the dashpot.
fn spring(law: &WallLaw, s: f64) -> (f64, f64) {
    let s = s.max(0.0);
    match *law {
        WallLaw::Elastic { stiffness, .. } => (0.5 * stiffness * s * s, stiffness * s),
        WallLaw::Quartic { epsilon, span } => {
            let phi = s * (s + span);
            (phi * phi / (2.0 * epsilon), phi * (2.0 * s + span) / epsilon)
        }
        WallLaw::HuntCrossley { stiffness, exponent, .. } => {
            let force = stiffness * s.powf(exponent);
            (force * s / (exponent + 1.0), force)
        }
        WallLaw::Rigid { .. } => panic!("no spring"),
    }
}

/// The mean force between two depths that are not equal, by its definition.
fn mean_force(law: &WallLaw, (theta, mean): (f64, Mean), h: f64, [s0, s1]: [f64; 2]) -> f64 {
    if s0 <= 0.0 && s1 <= 0.0 {
        return 0.0;
    }
    let elastic = match mean {
        Mean::Ends => (1.0 - theta) * spring(law, s0).1 + theta * spring(law, s1).1,
        Mean::DiscreteGradient => (spring(law, s1).0 - spring(law, s0).0) / (s1 - s0),
    };
    (elastic + law.dashpot(elastic) * (s1.max(0.0) - s0.max(0.0)) / h).max(0.0)
}

#[test]
fn the_tangent_is_the_derivative_of_the_mean_pressure() {
    for index in 0..2000 {
        let law = LAWS[index % LAWS.len()];
        let (theta, mean) = MEANS[index / LAWS.len() % 3];
        let (h, s0, s1) = ((3.0 * draw(1, index)).exp2(), draw(2, index), draw(3, index));
        let at = |s1: f64| mean_pressure(&law, mean, theta, h, s0, s1);
        let expected = mean_force(&law, (theta, mean), h, [s0, s1]);
        // Differences of energies of some 100 J over depths that differ by δ.
        let rounding = 1e-12 / (s1 - s0).abs();
        assert!((at(s1).0 - expected).abs() < rounding.max(1e-12), "{law:?} {mean:?}: {s0} to {s1}");
        let d = 1e-5;
        // Where the body reaches or leaves the wall, or the dashpot's pull ends, there is a corner;
        // and a gradient over a short way is a difference of nearly equal energies.
        let ends = [s1 - d, s1 + d];
        if ends[0] * ends[1] <= 0.0
            || (s1 - s0).abs() < 0.01
            || ends.iter().any(|&s| (at(s).0 > 0.0) != (at(s1).0 > 0.0))
        {
            continue;
        }
        let slope = (at(ends[1]).0 - at(ends[0]).0) / (2.0 * d);
        // The third derivative, some 1e3 N/m³, or the energy over the cube of the way between the
        // ends, times d².
        let close = 1e-5 * (1.0 + slope.abs());
        assert!((at(s1).1 - slope).abs() < close, "{law:?} {mean:?}: {} for {slope}, {s0} to {s1}", at(s1).1);
    }
}

/// One degree of freedom behind a wall on this side with this law.
fn behind(side: Side, law: WallLaw) -> Scene {
    let wall = Wall { law, ..Wall::flat("wall", side, 0.1) };
    Scene::oscillator(1.0, 0.0, 0.0).with_wall(wall)
}

#[test]
fn a_wall_answers_by_its_depth_at_both_ends_and_tells_how_it_yields() {
    for index in 0..300 {
        let side = if index % 2 == 0 { Side::Upper } else { Side::Lower };
        // A law without a corner near by: both depths are above 0.
        let (law, (theta, mean)) = (LAWS[index % LAWS.len()], MEANS[index / LAWS.len() % 3]);
        let (h, sign) = ((3.0 * draw(4, index)).exp2(), if side == Side::Upper { -1.0 } else { 1.0 });
        let [s0, s1] = [5, 6].map(|stream| 1.5 + draw(stream, index));
        let mut rule = Penalty::<Line>::new(&behind(side, law), theta, mean, h).unwrap();
        // Into an upper wall the body goes upwards.
        let (place, rate) = (0.1 - sign * s0, -sign * (s1 - s0) / h);
        let mut at = |place: f64, rate: f64| {
            rule.place[0] = place;
            rule.law_response(0, rate)
        };
        let answer = at(place, rate);
        let expected = sign * mean_force(&law, (theta, mean), h, [s0, s1]);
        assert!((answer.force - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{law:?}: {answer:?}, {expected}");
        // The dashpot's pull is cut off.
        if expected == 0.0 {
            continue;
        }
        let d = 1e-5;
        let slope = (at(place, rate + d / h).force - at(place, rate - d / h).force) / (2.0 * d / h);
        assert!((answer.slope + slope).abs() < 1e-6 * slope.abs(), "{law:?}: {answer:?}, {slope}");
        // A depth that is in error by a share of itself is so as if the rate were by that share of
        // the noise.
        assert!((answer.noise * h - s0).abs() < 1e-12, "{answer:?}, {s0} m");
    }
}

/// Largest violation of the step's equations, relative to the largest of their terms: v⁺ and the
/// forces must be those that follow from q⁺, and M(v⁺ − v) the momentum of all forces.
fn violation<S: Space>(scene: &Scene, (theta, mean): (f64, Mean), h: f64) -> f64 {
    let mut rule = Penalty::<S>::new(scene, theta, mean, h).unwrap();
    let mut frame = Frame::<S>::new(scene).unwrap();
    rule.restart(scene, 0.0, &frame).unwrap();
    rule.advance(0, &mut frame).unwrap();
    // A few are enough; a bisection to rounding takes some 50.
    assert!(rule.walls.iterations < 25, "{} iterations", rule.walls.iterations);
    let (n, structure) = (scene.initial.q.len(), scene.system.structure());
    let [q, v] = [&scene.initial.q, &scene.initial.v];
    let mean_of = |a: &[f64], b: &[f64]| -> Vec<f64> { (0..n).map(|i| (1.0 - theta) * a[i] + theta * b[i]).collect() };
    let (place, rate) = (mean_of(q, frame.q.as_ref()), mean_of(v, frame.v.as_ref()));
    let mut momentum = vec![h * 1.5; n];
    let change: Vec<f64> = (0..n).map(|i| frame.v[i] - v[i]).collect();
    structure.mass.add_product(-1.0, &change, &mut momentum);
    structure.damping.add_product(-h, &rate, &mut momentum);
    structure.stiffness.add_product(-h, &place, &mut momentum);
    let mut worst = 0.0_f64;
    for (wall, given) in scene.walls.iter().enumerate() {
        let sign = if given.side() == Side::Upper { -1.0 } else { 1.0 };
        let depth = |q: &[f64]| sign * (given.position() - given.row().dot(q));
        let depths = [depth(q), depth(frame.q.as_ref())];
        let force = sign * mean_force(&given.law, (theta, mean), h, depths);
        worst = worst.max((force - frame.force[wall]).abs() / (1.0 + force.abs()));
        assert!((frame.impulse[wall] - h * frame.force[wall]).abs() <= 1e-15 * (1.0 + h * force.abs()));
        assert_eq!(frame.pushing.contains(&wall), frame.force[wall] != 0.0);
        given.row().entries().iter().for_each(|&(i, weight)| momentum[i] += h * weight * force);
    }
    let moved = (0..n).map(|i| (frame.q[i] - q[i] - h * rate[i]).abs());
    momentum.iter().map(|p| p.abs()).chain(moved).fold(worst, f64::max)
}

#[test]
fn every_step_of_one_body_satisfies_its_balance() {
    for index in 0..2000 {
        let (law, kind) = (LAWS[index % LAWS.len()], MEANS[index / LAWS.len() % 3]);
        let h = 0.05 * (2.0 * draw(7, index)).exp2();
        let wall = |side: Side, position: f64| Wall { law, ..Wall::flat("wall", side, position) };
        // The walls of some scenes stand behind one another: both push on what is between them.
        let place = if index % 4 == 3 { -0.2 } else { 0.4 };
        // Through the upper wall, through the lower one, within them, out of them and beside them.
        let mut scene = Scene::oscillator(1.0, 0.3, 2.0)
            .with_wall(wall(Side::Upper, place))
            .with_wall(Wall { law: LAWS[index / 12 % LAWS.len()], ..wall(Side::Lower, -place) })
            .with_load(Load::constant(1.5))
            .with_initial(&[draw(8, index)], &[10.0 * draw(9, index)]);
        // Terms of some 100 N s; a discrete gradient's are divided by the way of a step.
        let found = violation::<Line>(&scene, kind, h);
        assert!(found < 1e-10, "{index}: {law:?} {kind:?}: {found:e}");
        scene.walls.iter_mut().for_each(|wall| *wall = wall.clone().at(Row::new(vec![(0, 1.0)])));
        let found = violation::<Matrices>(&scene, kind, h);
        assert!(found < 1e-10, "{index}, as a matrix: {law:?} {kind:?}: {found:e}");
    }
}

#[test]
fn every_step_of_a_structure_satisfies_its_balance() {
    for index in 0..600 {
        let (kind, h) = (MEANS[index / 3 % 3], 0.05 * (2.0 * draw(7, index)).exp2());
        let n = 2 + index % 2;
        let band = |i: usize, x: f64| if i > 0 { vec![(i, i, 2.0 * x), (i, i - 1, -x)] } else { vec![(0, 0, 2.0 * x)] };
        let chain = |x: f64| Symmetric::from_entries(n, (0..n).flat_map(|i| band(i, x)));
        let structure =
            Structure { mass: Symmetric::diagonal(&vec![1.0; n]), damping: chain(0.3), stiffness: chain(20.0) };
        let mut scene = Scene::structure(structure);
        for i in 0..n {
            scene.loads.push(Load { at: Row::dof(i), ..Load::constant(1.5) });
        }
        for wall in 0..4 {
            let side = if wall % 2 == 0 { Side::Upper } else { Side::Lower };
            let row = (0..n).map(|i| (i, draw(20 + wall, index * n + i))).collect();
            let law = LAWS[(index + wall as usize) % LAWS.len()];
            let position = if side == Side::Upper { 0.2 } else { -0.2 };
            scene = scene.with_wall(Wall { law, ..Wall::flat("wall", side, position).at(Row::new(row)) });
        }
        let state =
            |stream: u64, size: f64| -> Vec<f64> { (0..n).map(|i| size * draw(stream, 3 * index + i)).collect() };
        let scene = scene.with_initial(&state(30, 0.6), &state(31, 8.0));
        let found = violation::<Matrices>(&scene, kind, h);
        assert!(found < 1e-10, "{index}: {kind:?}: {found:e}");
    }
}
