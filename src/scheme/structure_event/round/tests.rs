//! Rows that turn, against the derivatives of (γ² − |w|²)/2γ by Leibniz' rule.

use super::super::tests::{closed, hole, masses, near, on, rigid, started, with};
use super::*;
use crate::scene::{Load, Wall};

/// The row of the hole: that of a wall comes first.
const ROW: usize = 1;
const GAP: f64 = 0.75;
const SPRING: f64 = 200.0;

/// A body of 1.3 kg on a spring, in a hole beside its place, and a third mass at a wall.
fn body(q: [f64; 2], v: [f64; 2]) -> StructureEvent {
    let scene = with(masses(&[1.3, 1.3, 1.0], &[], &[(0, 0, SPRING), (1, 1, SPRING)]), hole(GAP, 0.5, [0.3, -0.2]))
        .with_wall(rigid(Wall::upper("wall", 5.0), 0.0, &[(2, 1.0)]))
        .with_initial(&[q[0], q[1], 0.0], &[v[0], v[1], 0.0]);
    started(&scene, 0.05)
}

/// Σ C(m, j) of `product(j, m − j)` for 0 < j < m, over 2γ.
fn leibniz(m: usize, product: impl Fn(usize, usize) -> f64) -> f64 {
    let choose = |j: usize| (0..j).fold(1.0, |c: f64, i| c * (m - i) as f64 / (i + 1) as f64);
    (1..m).map(|j| choose(j) * product(j, m - j)).sum::<f64>() / (2.0 * GAP)
}

#[test]
fn a_bend_is_what_the_gap_has_beside_its_row() {
    let mut event = body([0.5, 0.1], [0.0; 2]);
    let w = [[0.6, 0.45], [0.7, -0.4], [-1.1, 0.4], [2.3, 1.7], [-0.9, 3.1]];
    for (k, [y, z]) in w.into_iter().enumerate() {
        event.derivatives[k] = vec![y, z, 0.0];
        event.sizes.derivative[k] = vec![y, z, 0.0];
    }
    let length = |k: usize| w[k][0].abs() + w[k][1].abs();
    for level in 0..3 {
        let wanted = leibniz(level + 2, |j, k| w[j][0] * w[k][0] + w[j][1] * w[k][1]);
        assert!(near(event.bend(ROW, level), wanted), "{level}: {} for {wanted}", event.bend(ROW, level));
        let wanted = leibniz(level + 2, |j, k| length(j) * length(k));
        assert!(near(event.bend_size(ROW, level), wanted), "{level}: {} for {wanted}", event.bend_size(ROW, level));
        assert!(event.bend(0, level) == 0.0 && event.bend_size(0, level) == 0.0);
    }
}

#[test]
fn a_force_that_turns_with_its_hole_has_the_derivatives_of_a_product() {
    let mut event = body([0.5, 0.1], [0.0; 2]);
    (event.derivatives[1], event.derivatives[2]) = (vec![0.7, -0.3, 9.0], vec![-1.1, 0.4, 9.0]);
    let mut closed_row = closed(ROW, -1.0);
    (closed_row.fate, closed_row.force) = (Fate::Held(0), [-5.0, 3.0, 0.0]);
    event.closed_rows = vec![closed_row];
    // Beside ṙ n and r̈ n: r ẇ/γ, and (2 ṙ ẇ + r ẅ)/γ.
    let wanted = [[0.0; 2], [-5.0 * 0.7, 5.0 * 0.3], [6.0 * 0.7 + 5.0 * 1.1, -6.0 * 0.3 - 5.0 * 0.4]];
    for (level, wanted) in wanted.into_iter().enumerate() {
        event.rhs.fill(0.0);
        event.rhs_size.fill(0.0);
        event.turn_forces(level);
        for axis in [0, 1] {
            let [found, size] = [event.rhs[axis], event.rhs_size[axis]];
            assert!(near(found, wanted[axis] / GAP), "{level} {axis}: {found} for {}", wanted[axis]);
            assert!(near(size, wanted[axis].abs() / GAP), "{level} {axis}: {size} for {}", wanted[axis]);
        }
        assert!(event.rhs[2] == 0.0);
    }
}

#[test]
fn the_direction_of_a_normal_is_as_uncertain_as_the_place() {
    // So far from the origin that the place has far larger terms than the gap.
    let mut event = body([0.3 + 0.6, -0.2 + 0.1], [0.0; 2]);
    (event.q, event.v) = (vec![50.0, -70.0, 1.0], vec![0.4, -0.9, 2.0]);
    let lean = (120.0 + 0.3 + 0.2 + GAP) / GAP;
    assert!(near(event.lean(ROW), lean) && event.lean(0) == 1.0, "{}", event.lean(ROW));
    event.begin_series(event.limit());
    let unit = event.series.unit();
    // Cut to where the term of the acceleration, far from the springs' rest, reaches twice the gap.
    let acceleration = SPRING / 1.3 * 50.0_f64.hypot(70.0);
    assert!(near(unit, (2.0 * 2.0 * GAP / acceleration).sqrt()), "{unit}");
    let wanted = noise(lean * 1.3 + 1.3 * 1.3 / GAP * unit);
    assert!(near(event.turned_speed(ROW), wanted) && event.turned_speed(0) == 0.0, "{:e}", event.turned_speed(ROW));
}

#[test]
fn a_gap_of_a_hole_has_the_rounding_errors_of_a_square() {
    let mut event = body([0.3 + 0.36, -0.2 + 0.48], [0.9, -0.7]);
    event.advance(Some(&[20.0, -11.0, 0.0])).unwrap();
    event.begin_series(event.limit());
    event.measure();
    let (unit, [y, z], [vy, vz]) = (event.series.unit(), [event.q[0], event.q[1]], [event.v[0], event.v[1]]);
    // Lengths of vectors are sums of magnitudes: |ẇ|, and half of |ẅ|.
    let w1 = (vy.abs() + vz.abs()) * unit;
    let w2 = ((20.0 - SPRING * y).abs() + (-11.0 - SPRING * z).abs()) / 1.3 * unit * unit / 2.0;
    let (force, rate) = (31.0 + SPRING * (y.abs() + z.abs()), SPRING * (vy.abs() + vz.abs()));
    let round = &event.body.rounds[0];
    let (lean, bound) = ((y.abs() + z.abs() + 0.5 + GAP) / GAP, round.bound());
    assert!(lean > 1.5 && event.hold.rows().is_empty(), "{lean}");
    let (second, third) = (noise(force / 1.3) * unit.powi(2) / 2.0, noise(rate / 1.3) * unit.powi(3) / 6.0);
    let at = y.abs() + z.abs() + event.series.span() * w1 + bound.abs();
    let wanted = [
        noise(at),
        lean * (noise(w1) + 2.0 * second),
        lean * second + noise(w1 * w1 / GAP),
        lean * third + noise(3.0 * w1 * w2 / GAP),
    ];
    let found = event.noises(ROW, bound);
    (0..4).for_each(|k| assert!(near(found[k], wanted[k]), "{k}: {:e} for {:e}", found[k], wanted[k]));
    // The terms of (γ² − |w|²)/2γ are those of w, and of the half of their square over γ.
    let terms = 1..event.series.terms();
    let way: f64 = terms.map(|k| event.series.term(k)[0].abs() + event.series.term(k)[1].abs()).sum();
    assert!(way >= w1 && near(event.round_travel(round, 1.0), way + 0.5 * way * way / GAP), "{way}");
}

#[test]
fn a_body_slides_round_a_hole_that_lies_beside_its_place() {
    let (centre, gap) = ([0.4e-3, -0.7e-3], 2e-3);
    let scene = with(masses(&[1.3; 2], &[], &[]), hole(gap, 0.5, centre))
        .with_initial(&[centre[0] + gap, centre[1]], &[0.0, 0.05])
        .with_duration(0.5);
    let mut event = started(&scene, 0.01);
    while event.time < 0.5 {
        event.advance(None).unwrap();
        let [y, z] = [event.q[0] - centre[0], event.q[1] - centre[1]];
        // Some roundings of places of some millimetres.
        assert!((y.hypot(z) - gap).abs() < 1e-17, "{}: {:e}", event.time, y.hypot(z) - gap);
        assert!((event.v[0].hypot(event.v[1]) - 0.05).abs() < 1e-14, "{:?}", event.v);
    }
}

#[test]
fn programmes_in_which_a_wall_pushes_are_counted_once() {
    for (load, pushed) in [(5.0, false), (-5.0, true)] {
        let floor = |dof: usize| rigid(Wall::lower("floor", 0.0), 0.0, &[(dof, 1.0)]);
        let scene = masses(&[1.0, 2.0], &[], &[]).with_wall(floor(0)).with_wall(floor(1));
        let scene = scene.with_load(on(Load::constant(load), 0)).with_load(on(Load::constant(load), 1));
        let mut event = started(&scene, 1.0);
        event.closed_rows = vec![closed(0, 1.0), closed(1, 1.0)];
        event.settle(None).unwrap();
        let work = event.solver_work();
        // One on the forces at the start; where nothing is pressed it has nothing to solve.
        assert_eq!(work[0], u64::from(pushed), "{load}");
        for _ in 0..2 {
            event.book_solver();
            assert!(event.solver.is_none() && event.solver_work() == work, "{load}");
        }
        event.make_solver().unwrap();
        assert_eq!(event.solver_work(), work, "{load}");
    }
}
