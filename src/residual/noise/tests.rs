//! Rounding errors, against numbers worked out by hand.

use super::*;
use crate::residual::scratch::Scratch;
use crate::residual::step_motion::StepMotion;
use crate::step::Balance;
use pulp::Scalar;

/// The rounding error of the balance of a step of `span` seconds.
fn force(noise: &mut NoiseModel, span: f64, clock: f64) -> f64 {
    (noise.span, noise.clock) = (span, clock);
    noise.force()
}

#[test]
fn sizes_of_a_step_make_the_rounding_errors_of_its_balances() {
    // m = 4 kg, k = 9 N/m, c = 16 N s/m, and a wall that feels 16 kg.
    let weights = Weights {
        root_mass: vec![2.0],
        per_root_mass: vec![0.5],
        roots: [vec![2.0], vec![3.0], vec![4.0]],
        seen: vec![1.0],
    };
    let mut noise = NoiseModel::new(&weights, &[16.0], 0.5);
    let unit = UNITS * f64::EPSILON;
    // A step of 0.5 s ends at −2 m with 3 m/s, under −13 N at its start, −7 N at its end, an extra
    // force of 2 N (−8 N in the mean), and a blow of 1 N s. The largest force is that at the end
    // with the extra one, 9 N.
    let moves = StepMotion {
        h: 0.5,
        per_h: 2.0,
        from: &[0.0],
        to: &[-2.0],
        shown: &[-2.0],
        before: &[-1.0],
        after: &[3.0],
        v: &[3.0],
        load_start: &[-13.0],
        load_end: &[-7.0],
        extra: &[2.0],
        blow: &[1.0],
    };
    let sizes = |moves| Scratch::new(1).means(Scalar, Balance::Theta(0.5), moves, &weights, 1);
    noise.step(&sizes(&moves));
    // Way 2 + 0.5 · 3 m: 7 m√kg and 10.5 √J; 6 √J of speed, 12 √W in the damper, 4.5 N/√kg.
    let (spring, damper) = (1.5 * 10.5, 2.0 * 12.0);
    assert_eq!(noise.path(), unit * 7.0);
    assert_eq!(force(&mut noise, 0.25, 1.0), unit * (6.0 / 0.25 + spring + damper + 4.5));
    assert_eq!(force(&mut noise, 0.25, 3.0), unit * (6.0 / 0.25 + 3.0 * (spring + damper + 4.5)));
    // A rigid wall of 12 N is no load, an elastic one of 20 N is one.
    noise.push(0, 0.0, false);
    noise.push(0, -12.0, true);
    assert_eq!(force(&mut noise, 1.0, 1.0), unit * (6.0 + spring + damper + 4.5 + 3.0));
    noise.push(0, 20.0, false);
    assert_eq!(force(&mut noise, 1.0, 1.0), unit * (6.0 + spring + damper + 5.0 + 5.0));
    assert_eq!(noise.wall_force(0), 4.0 * force(&mut noise, 1.0, 1.0));
    noise.load(-5.5);
    assert_eq!(force(&mut noise, 1.0, 1.0), unit * (6.0 + spring + damper + 5.5 + 5.0));
    assert_eq!((noise.of(3.0), noise.place(3.0)), (unit * 3.0, unit * 3.0 + 0.5 * MET));
    // Two steps of 2 s, in which the load gives 11 √J and the walls 10 √J.
    noise.span = 2.0;
    noise.book(1.0, 2.0);
    let states = 36.0 + 10.5 * 10.5 + 11.0 * (11.0 + 10.0);
    let one = unit * (states + 5.5 * 7.0);
    assert_eq!(noise.energy, 2.0 * one);
    noise.book(3.0, 1.0);
    assert_eq!(noise.energy, 2.0 * one + unit * (3.0 * states + 5.5 * 7.0));
    // A state notes the same sizes as a step with one velocity, and a blow those of its force.
    let mut state = NoiseModel::new(&weights, &[], 0.5);
    state.state(&[-2.0], &[-3.0], 0.5, &weights);
    assert_eq!((state.path(), force(&mut state, 0.25, 1.0)), (unit * 7.0, unit * (6.0 / 0.25 + spring + damper)));
    let mut struck = NoiseModel::new(&weights, &[], 0.5);
    struck.step(&sizes(&StepMotion { blow: &[-10.0], ..moves }));
    assert_eq!(force(&mut struck, 1.0, 1.0), unit * (6.0 + spring + damper + 10.0));
    // Sums over four degrees of freedom have twice the rounding; one without springs has no rate.
    let mut four = weights.repeated(4);
    four.roots.iter_mut().zip([1.0, 0.0, 0.0]).for_each(|(roots, root)| roots[0] = root);
    let mut many = NoiseModel::new(&four, &[], 0.5);
    many.state(&[0.0, -2.0, 0.0, 0.0], &[0.0, 3.0, 0.0, 0.0], 0.5, &four);
    assert_eq!(force(&mut many, 1.0, 1.0), 2.0 * unit * (6.0 + spring + damper));
}
