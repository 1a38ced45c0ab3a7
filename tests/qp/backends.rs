//! Every solver against the optimality conditions, against one another, and against enumeration.

use crate::qp_support::{Case, Dense, Random, brute_force, judge, random_case};
use nalgebra::{DMatrix, DVector};
use signorini::qp::{Backend, Failure, Rhs, Solver};

fn solver(case: &Case, backend: Backend) -> Solver {
    Solver::new(case.problem.problem(), backend, case.scale).expect("a sound problem")
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, v| f64::max(most, v.abs()))
}

#[test]
fn clamp_and_clarabel_agree_on_ten_thousand_scalar_programmes_of_all_scales() {
    let mut random = Random(1);
    let (mut worst_x, mut worst_r, mut met) = (0.0_f64, 0.0_f64, 0);
    for trial in 0..10_000 {
        let m = 1 + random.below(3);
        let case = random_case(&mut random, 1, m);
        let mut exact = solver(&case, Backend::Clamp);
        let mut reference = solver(&case, Backend::Clarabel);
        let x = exact.solve(&case.rhs()).expect("feasible").clone();
        let y = reference.solve(&case.rhs()).unwrap_or_else(|failure| panic!("{trial}: {failure}\n{case:#?}")).clone();
        // Rounding of a handful of operations, 1e-16 each, on terms up to a few times their sum.
        let residual = judge(&case, &x);
        assert!(residual.worst() <= 1e-12, "{trial}: clamp {residual:?}\n{case:#?}\n{x:?}");
        let residual = judge(&case, &y);
        assert!(residual.worst() <= 1e-12, "{trial}: clarabel {residual:?}\n{case:#?}\n{y:?}");
        let a = case.problem.a[(0, 0)];
        let length = case.scale.max((case.b[0] / a).abs());
        worst_x = worst_x.max((x.x[0] - y.x[0]).abs() / length);
        // Rows that see the same motion may divide the force differently: only its sum on the body
        // is defined.
        let total = |r: &[f64]| -> f64 { r.iter().zip(case.problem.g.iter()).map(|(r, g)| r * g).sum() };
        worst_r = worst_r.max((total(&x.multiplier) - total(&y.multiplier)).abs() / (a * length));
        met += u32::from(largest(&x.multiplier) > 0.0);
    }
    println!("scalar: {met} in contact; largest difference x {worst_x:e}, force {worst_r:e}");
    assert!(met > 3_000, "only {met} programmes met a wall");
    // Both are exact: what differs is rounding, and 1e-12 is the sign test of the polishing.
    assert!(worst_x <= 1e-12 && worst_r <= 1e-12, "{worst_x:e} {worst_r:e}");
}

#[test]
fn clarabel_polished_meets_the_optimality_conditions_up_to_ten_unknowns_and_ten_rows() {
    let mut random = Random(2);
    let (mut worst, mut pivots, mut iterations, mut interior) = (0.0_f64, 0, 0, 0);
    for trial in 0..4_000 {
        let (n, m) = (1 + random.below(10), 1 + random.below(10));
        let case = random_case(&mut random, n, m);
        let mut reference = solver(&case, Backend::Clarabel);
        let found =
            reference.solve(&case.rhs()).unwrap_or_else(|failure| panic!("{trial}: {failure}\n{case:#?}")).clone();
        let residual = judge(&case, &found);
        // The required 1e-9; rows of random direction may be nearly dependent, so the condition of
        // W enters the forces.
        assert!(residual.worst() <= 1e-9, "{trial}: {residual:?}\n{case:#?}\n{found:?}");
        worst = worst.max(residual.worst());
        pivots += reference.counters().pivots;
        iterations += reference.counters().iterations;
        interior += reference.counters().solves - reference.counters().free;
    }
    println!("{interior} programmes: worst residual {worst:e}, {iterations} iterations, {pivots} pivots");
}

#[test]
fn clarabel_finds_the_set_that_enumeration_finds() {
    let mut random = Random(3);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for trial in 0..400 {
        let (n, m) = (1 + random.below(5), 1 + random.below(5));
        let case = random_case(&mut random, n, m);
        let Some(exact) = brute_force(&case) else { continue };
        let mut reference = solver(&case, Backend::Clarabel);
        let found = reference.solve(&case.rhs()).expect("feasible");
        let length = case.scale.max(largest(&exact.x));
        let error = exact.x.iter().zip(&found.x).fold(0.0, |e, (a, b)| f64::max(e, (a - b).abs())) / length;
        // Both solve well-conditioned systems (A has condition < 1e2): far from the 1e-9 that
        // separates sets.
        assert!(error <= 1e-9, "{trial}: {error:e}\n{case:#?}\n{exact:?}\n{found:?}");
        worst = worst.max(error);
        compared += 1;
    }
    println!("enumeration: {compared} compared, largest difference {worst:e}");
    assert!(compared > 350, "only {compared} were comparable");
}

#[test]
fn the_trap_of_small_numbers_is_no_trap() {
    // k = 1e3, u = 1e-6, f = 1e-3: fed as it is, the interior point's stopping test calls almost
    // anything solved.
    let problem = Dense {
        a: DMatrix::from_element(1, 1, 1e3),
        g: DMatrix::from_element(1, 1, 1.0),
        compliance: DVector::zeros(1),
    };
    let mut reference = Solver::new(problem.problem(), Backend::Clarabel, 1e-6).expect("sound");
    for step in 0..100 {
        let b = 1e-3 * (1.0 + f64::from(step) / 10.0);
        let found = reference.solve(&Rhs { b: &[b], lo: &[-0.9e-6], hi: &[0.9e-6] }).expect("feasible");
        let exact = 1e3 * 0.9e-6 - b;
        // Rounding of b itself, 2e-16, magnified by b over the smallest force, 10.
        assert!((found.multiplier[0] - exact).abs() <= 1e-14 * b, "{} {exact}", found.multiplier[0]);
    }
}

#[test]
fn bounds_may_come_and_go_from_step_to_step() {
    let mut random = Random(4);
    for _ in 0..200 {
        let (n, m) = (1 + random.below(4), 1 + random.below(5));
        let whole = random_case(&mut random, n, m);
        let mut persistent = solver(&whole, Backend::Clarabel);
        for _ in 0..20 {
            let mut case = whole.clone();
            for i in 0..m {
                if random.chance(0.5) {
                    case.lo[i] = f64::NEG_INFINITY;
                }
                if random.chance(0.5) {
                    case.hi[i] = f64::INFINITY;
                }
            }
            for b in &mut case.b {
                *b *= random.between(-3.0, 3.0);
            }
            let found = persistent.solve(&case.rhs()).expect("feasible").clone();
            let residual = judge(&case, &found);
            assert!(residual.worst() <= 1e-9, "{residual:?}\n{case:#?}\n{found:?}"); // as above
        }
    }
}

#[test]
fn a_bound_far_outside_what_the_interior_point_sees_still_holds() {
    // The first row pushes by 1e-6, the stiffly coupled second row then moves by far more than a
    // thousand times that.
    let problem = Dense {
        a: DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 1e8]),
        g: DMatrix::from_row_slice(2, 2, &[1.0, 1e8, 1.0, -1e8]),
        compliance: DVector::zeros(2),
    };
    let case = Case { problem, b: vec![0.0, 0.0], lo: vec![1e-6, f64::NEG_INFINITY], hi: vec![1.0, 1.0], scale: 1e-6 };
    let found = solver(&case, Backend::Clarabel).solve(&case.rhs()).expect("feasible").clone();
    let residual = judge(&case, &found);
    assert!(residual.worst() <= 1e-9, "{residual:?} {found:?}");
}

#[test]
fn the_matrix_on_which_plain_active_sets_cycle_is_solved() {
    // minimise ½ xᵀH x + cᵀx, x ≤ 0.
    let h = DMatrix::from_row_slice(3, 3, &[4.0, 5.0, -5.0, 5.0, 9.0, -5.0, -5.0, -5.0, 7.0]);
    let problem = Dense { a: h, g: DMatrix::identity(3, 3), compliance: DVector::zeros(3) };
    let infinite = f64::NEG_INFINITY;
    for signs in 0..8_u8 {
        let c = [2.0, 1.0, -3.0].iter().enumerate().map(|(i, c)| if signs >> i & 1 == 1 { -c } else { *c });
        let b: Vec<f64> = c.map(|c: f64| -c).collect();
        let case = Case { problem: problem.clone(), b, lo: vec![infinite; 3], hi: vec![0.0; 3], scale: 1.0 };
        let exact = brute_force(&case).expect("unique");
        let found = solver(&case, Backend::Clarabel).solve(&case.rhs()).expect("feasible").clone();
        for i in 0..3 {
            // Condition of H is 1e2: rounding 1e-14.
            assert!((found.x[i] - exact.x[i]).abs() <= 1e-12, "{found:?} {exact:?}");
            assert!((found.multiplier[i] - exact.multiplier[i]).abs() <= 1e-12, "{found:?} {exact:?}");
        }
    }
}

#[test]
fn walls_at_one_place_do_not_stop_either_solver() {
    // Three rows see the same motion; the tightest holds, and the force on the body is what it must
    // be.
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        let problem = Dense {
            a: DMatrix::from_element(1, 1, 2.0),
            g: DMatrix::from_element(3, 1, 1.0),
            compliance: DVector::zeros(3),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        let free = f64::NEG_INFINITY;
        let found = solver.solve(&Rhs { b: &[6.0], lo: &[free; 3], hi: &[1.0, 1.0, 1.0] }).expect("feasible");
        // Rounding of a few operations on numbers up to 6.
        assert!((found.multiplier.iter().sum::<f64>() + 4.0).abs() <= 1e-14, "{found:?}");
        assert!((found.x[0] - 1.0).abs() <= 1e-15, "{found:?}");
        let found = solver.solve(&Rhs { b: &[6.0], lo: &[free; 3], hi: &[1.0, 0.5, 1.0] }).expect("feasible");
        assert!((found.x[0] - 0.5).abs() <= 1e-15 && (found.multiplier[1] + 5.0).abs() <= 1e-14, "{found:?}");
        // Lower and upper wall at one place, crossing by an ulp: equality, either way of pushing.
        let (place, ulp) = (0.1 + 0.2, 0.3);
        for b in [6.0, -6.0] {
            let rhs = Rhs { b: &[b], lo: &[place, free, free], hi: &[f64::INFINITY, ulp, 5.0] };
            let found = solver.solve(&rhs).expect("one place");
            assert!((found.x[0] - 0.3).abs() <= 1e-12, "{backend} {found:?}"); // the sign test's tolerance
            assert!((found.multiplier.iter().sum::<f64>() - (0.6 - b)).abs() <= 1e-11, "{backend} {found:?}");
        }
        // The same within one row.
        let found =
            solver.solve(&Rhs { b: &[6.0], lo: &[place, free, free], hi: &[ulp, 9.0, 9.0] }).expect("one place");
        assert!((found.x[0] - 0.3).abs() <= 1e-12, "{backend} {found:?}");
    }
}

#[test]
fn bounds_that_cross_are_named() {
    let (inf, free) = (f64::INFINITY, f64::NEG_INFINITY);
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        let problem = Dense {
            a: DMatrix::from_element(1, 1, 2.0),
            g: DMatrix::from_element(3, 1, 1.0),
            compliance: DVector::zeros(3),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        let own = solver.solve(&Rhs { b: &[6.0], lo: &[free, 1.0, free], hi: &[inf, 0.9, inf] }).unwrap_err();
        assert_eq!(own, Failure::Infeasible { row: 1, against: 1 });
        let two = solver.solve(&Rhs { b: &[6.0], lo: &[free, free, 1.0], hi: &[inf, 0.9, inf] }).unwrap_err();
        let Failure::Infeasible { row, against } = two else { panic!("{backend}: {two}") };
        assert_eq!((row.min(against), row.max(against)), (1, 2));
        assert!(solver.solve(&Rhs { b: &[6.0], lo: &[free; 3], hi: &[1.0; 3] }).is_ok(), "usable afterwards");
    }
}

#[test]
fn a_number_that_is_none_is_refused_and_the_solver_goes_on() {
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        let problem = Dense {
            a: DMatrix::from_element(1, 1, 2.0),
            g: DMatrix::from_element(1, 1, 1.0),
            compliance: DVector::zeros(1),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        let good = Rhs { b: &[6.0], lo: &[-1.0], hi: &[1.0] };
        let before = solver.solve(&good).expect("feasible").clone();
        for bad in [f64::NAN, f64::INFINITY] {
            let failure = solver.solve(&Rhs { b: &[bad], ..good }).unwrap_err();
            assert_eq!(failure, Failure::NotFinite { what: "b", index: 0 });
        }
        let failure = solver.solve(&Rhs { hi: &[f64::NAN], ..good }).unwrap_err();
        assert_eq!(failure, Failure::NotFinite { what: "upper bound", index: 0 });
        let failure = solver.solve(&Rhs { lo: &[f64::INFINITY], ..good }).unwrap_err();
        assert_eq!(failure, Failure::NotFinite { what: "lower bound", index: 0 });
        let failure = solver.solve(&Rhs { b: &[1.0, 2.0], ..good }).unwrap_err();
        assert_eq!(failure, Failure::Shape { what: "entries of b", expected: 1, found: 2 });
        assert_eq!(solver.solve(&good).expect("usable"), &before);
        let indefinite = Dense { a: DMatrix::from_element(1, 1, -2.0), ..problem.clone() };
        assert_eq!(Solver::new(indefinite.problem(), backend, 1.0).unwrap_err(), Failure::NotPositiveDefinite);
        let bad_scale = Solver::new(problem.problem(), backend, 0.0).unwrap_err();
        assert_eq!(bad_scale, Failure::NotFinite { what: "scale", index: 0 });
    }
}

#[test]
fn auto_takes_the_clamp_for_one_unknown_and_condenses_more() {
    let of = |n| Dense { a: DMatrix::identity(n, n), g: DMatrix::zeros(0, n), compliance: DVector::zeros(0) }.problem();
    let one = Solver::new(of(1), Backend::Auto, 1.0).expect("sound");
    assert_eq!(one.backend(), Backend::Clamp);
    let mut two = Solver::new(of(2), Backend::Auto, 1.0).expect("sound");
    assert_eq!(two.backend(), Backend::Condensed);
    let free = two.solve(&Rhs { b: &[1.0, 2.0], lo: &[], hi: &[] }).expect("no rows at all");
    assert_eq!(free.x, [1.0, 2.0]);
    assert!(matches!(Solver::new(of(2), Backend::Clamp, 1.0), Err(Failure::Shape { .. })));
    assert!(matches!(Solver::new(of(0), Backend::Auto, 1.0), Err(Failure::Shape { .. })));
}

#[test]
fn backends_are_known_by_their_names() {
    for backend in Backend::ALL {
        assert_eq!(backend.to_string().parse(), Ok(backend));
    }
    let unknown = "simplex".parse::<Backend>().unwrap_err();
    assert_eq!(unknown.to_string(), "no QP solver is named \"simplex\"; there is auto, clamp, condensed, clarabel");
}

#[test]
fn a_row_that_sees_nothing_carries_nothing_unless_it_cannot_be_met() {
    for backend in [Backend::Clamp, Backend::Condensed, Backend::Clarabel] {
        let problem = Dense {
            a: DMatrix::from_element(1, 1, 2.0),
            g: DMatrix::from_row_slice(2, 1, &[1.0, 0.0]),
            compliance: DVector::zeros(2),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        let found = solver.solve(&Rhs { b: &[6.0], lo: &[-1.0, -1.0], hi: &[1.0, 1.0] }).expect("feasible");
        // A few roundings of a number below 4.
        assert!((found.multiplier[0] + 4.0).abs() <= 4.0 * f64::EPSILON, "{backend}: {found:?}");
        assert_eq!(found.multiplier[1], 0.0, "{backend}");
        let failure = solver.solve(&Rhs { b: &[6.0], lo: &[-1.0, 0.5], hi: &[1.0, 1.0] }).unwrap_err();
        assert!(matches!(failure, Failure::Infeasible { row: 1, .. }), "{backend}: {failure}");
    }
}

#[test]
fn a_programme_on_which_the_interior_point_goes_round_in_circles_is_solved() {
    // At Clarabel's default step fraction its iterates repeat with period four; shorter steps end
    // it.
    let problem = Dense {
        a: DMatrix::from_element(1, 1, 3055.2878678605825),
        g: DMatrix::from_column_slice(
            5,
            1,
            &[0.7898905926830451, 0.24071841997348065, 0.5854201079716461, -0.892151449047154, 0.16823158006553562],
        ),
        compliance: DVector::from_column_slice(&[0.010763075897447781, 0.007824520999232702, 0.0, 0.0, 0.0]),
    };
    let (free, inf) = (f64::NEG_INFINITY, f64::INFINITY);
    let case = Case {
        problem,
        b: vec![-0.29847879318872467],
        lo: vec![-0.002285260348153094, free, -0.00048595586968765256, free, -0.0007649787351108934],
        hi: vec![0.0034351111187768553, -0.00011386073175148528, inf, 0.0007352108525535764, inf],
        scale: 0.003855593818009572,
    };
    let mut reference = solver(&case, Backend::Clarabel);
    let found = reference.solve(&case.rhs()).expect("feasible").clone();
    assert!(reference.counters().iterations > 40, "no cycle any more: the shorter steps may go");
    assert!(judge(&case, &found).worst() <= 1e-12, "{found:?}"); // rounding, as in the scalar programmes above
}
