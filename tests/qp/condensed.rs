//! The condensed solver: against the optimality conditions on a hundred thousand programmes,
//! against Clarabel, against enumeration.

use crate::qp_support::{Case, Dense, Judge, Random, Residual, brute_force, judge, random_case};
use nalgebra::{DMatrix, DVector};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Failure, Problem, Rhs, Solver};

const INF: f64 = f64::INFINITY;

/// A of every kind that structures bring, condition below 1e3.
fn matrix(random: &mut Random, n: usize) -> DMatrix<f64> {
    let width = match random.below(5) {
        0 => n,
        1 => 0,
        2 => 1,
        3 => 2 + random.below(4),
        _ => usize::MAX,
    };
    let mut a = DMatrix::zeros(n, n);
    for i in 0..n {
        for j in 0..i {
            let there = if width == usize::MAX { random.chance(0.1) } else { i - j <= width };
            if there {
                a[(i, j)] = random.between(-1.0, 1.0);
                a[(j, i)] = a[(i, j)];
            }
        }
    }
    for i in 0..n {
        a[(i, i)] = a.row(i).iter().map(|v| v.abs()).sum::<f64>() + random.decade(-1.5, 1.0);
    }
    a
}

/// Rows on one unknown, on a few, or on all; some equal, some the sum of two, some almost equal to
/// the one before, up to cond W = 1e6.
fn rows(random: &mut Random, m: usize, n: usize) -> DMatrix<f64> {
    let mut g = DMatrix::zeros(m, n);
    let kind = random.below(3);
    let near = if m <= n { 0.15 } else { 0.0 };
    for i in 0..m {
        let draw = if i > 1 { random.unit() } else { 1.0 };
        if draw < 0.05 {
            let row = g.row(random.below(i)) * random.decade(-1.0, 1.0);
            g.set_row(i, &row);
        } else if draw < 0.1 {
            let row = g.row(random.below(i)) + g.row(random.below(i));
            g.set_row(i, &row);
        } else if draw < near {
            // Angle 1e-3 at least: cond W is its square.
            let angle = random.decade(-2.5, 0.0);
            let row = g.row(random.below(i)) + DMatrix::from_fn(1, n, |_, _| random.between(-1.0, 1.0)) * angle;
            g.set_row(i, &row);
        } else {
            let entries = [1, 3, n][kind];
            for _ in 0..entries {
                let j = random.below(n);
                g[(i, j)] = random.between(-1.0, 1.0);
            }
        }
    }
    g
}

/// A problem and a sequence of feasible programmes on it, as a time-stepper would pose them: bounds
/// that come, go and touch; loads that move.
fn sequence(random: &mut Random, n: usize, m: usize, length: usize) -> (Dense, Vec<Case>) {
    let (stiffness, size) = (random.decade(-6.0, 9.0), random.decade(-9.0, 3.0));
    let elastic = if random.chance(0.5) { 0.0 } else { 0.3 };
    let problem = Dense {
        a: matrix(random, n) * stiffness,
        g: rows(random, m, n),
        compliance: DVector::from_fn(m, |_, _| {
            if random.chance(elastic) { random.decade(-2.0, 2.0) / stiffness } else { 0.0 }
        }),
    };
    let point = DVector::from_fn(n, |_, _| random.between(-1.0, 1.0) * size);
    let seen = &problem.g * &point;
    let side = |random: &mut Random| match random.unit() {
        u if u < 0.3 => INF,
        u if u < 0.4 => 0.0,
        _ => random.decade(-3.0, 0.3) * size,
    };
    let lo: Vec<f64> = seen.iter().map(|w| w - side(random)).collect();
    let hi: Vec<f64> = seen.iter().map(|w| w + side(random)).collect();
    let mut b = DVector::zeros(n);
    let cases = (0..length).map(|step| {
        // The load jumps, drifts as from step to step, or holds the body exactly at the point:
        // force = gap = 0 where a bound touches.
        let push = random.decade(-2.0, 1.0) * size * stiffness;
        match random.below(8) {
            0 => b = &problem.a * &point,
            1 => b = DVector::from_fn(n, |_, _| random.between(-1.0, 1.0) * push),
            _ if step == 0 => b = DVector::from_fn(n, |_, _| random.between(-1.0, 1.0) * push),
            _ => b += DVector::from_fn(n, |_, _| random.between(-0.1, 0.1) * push),
        }
        let mut case =
            Case { problem: problem.clone(), b: b.as_slice().to_vec(), lo: lo.clone(), hi: hi.clone(), scale: size };
        for i in 0..m {
            if random.chance(0.1) {
                case.lo[i] = -INF;
            }
            if random.chance(0.1) {
                case.hi[i] = INF;
            }
        }
        case
    });
    let cases = cases.collect();
    (problem, cases)
}

#[test]
fn a_hundred_thousand_programmes_meet_the_optimality_conditions() {
    let mut random = Random(11);
    let mut worst = Residual { stationarity: 0.0, feasibility: 0.0, complementarity: 0.0 };
    let (mut programmes, mut free, mut pivots, mut fallbacks, mut loose) = (0, 0, 0, 0, 0);
    for trial in 0..6_000 {
        let (n, m) = (1 + random.below(if trial % 4 == 0 { 50 } else { 15 }), 1 + random.below(40));
        let (problem, cases) = sequence(&mut random, n, m, 20);
        let mut solver = Solver::new(problem.problem(), Backend::Condensed, cases[0].scale).expect("sound");
        let judge = Judge::new(&problem);
        for (step, case) in cases.iter().enumerate() {
            let found = solver.solve(&case.rhs()).unwrap_or_else(|e| panic!("{trial}.{step}: {e}\n{case:?}"));
            let residual = judge.judge(&case.rhs(), case.scale, found);
            // 1e-12 is the tolerance of the sign test; the balance is one solve with A, condition
            // below 1e3, of 50 unknowns.
            let settled = residual.stationarity.max(residual.complementarity);
            assert!(settled <= 1e-12, "{trial}.{step}: {residual:?}\n{case:?}\n{found:?}");
            // Where more rows than unknowns meet in one point, a few so nearly dependent that their
            // rounding decides who holds it, the test is looser by a power of ten, and then
            // another.
            assert!(residual.feasibility <= 1e-10, "{trial}.{step}: {residual:?}\n{case:?}\n{found:?}");
            loose += u32::from(residual.feasibility > 1e-12);
            worst.stationarity = worst.stationarity.max(residual.stationarity);
            worst.feasibility = worst.feasibility.max(residual.feasibility);
            worst.complementarity = worst.complementarity.max(residual.complementarity);
            // A force is 0 or pushes: it never has a trace of the wrong sign.
            for (i, &r) in found.multiplier.iter().enumerate() {
                assert!(
                    r == 0.0 || (if r > 0.0 { case.lo[i] } else { case.hi[i] }).is_finite(),
                    "{trial}.{step}: row {i}"
                );
            }
        }
        let counters = solver.counters();
        programmes += counters.solves;
        free += counters.free;
        pivots += counters.pivots;
        fallbacks += counters.fallbacks;
    }
    println!("{programmes} programmes, {free} free, {pivots} pivots, {fallbacks} fallbacks, {loose} loose: {worst:?}");
    assert!(programmes >= 100_000 && free < programmes / 2);
    // Four were seen, and 1081 fallbacks, all of them with more rows than unknowns.
    assert!(loose <= 20 && fallbacks < programmes / 50);
}

/// Largest difference of displacements and of forces, each against the largest of its kind; forces
/// as the motions they cause.
fn difference(judge: &Judge, scale: f64, a: (&[f64], &[f64]), b: (&[f64], &[f64])) -> (f64, f64) {
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most, v: f64| f64::max(most, v.abs()));
    let length = scale.max(most(&mut a.0.iter().copied()));
    let x = most(&mut a.0.iter().zip(b.0).map(|(a, b)| a - b)) / length;
    let weight = |i: usize| judge.w[(i, i)].sqrt();
    let force = most(&mut a.1.iter().enumerate().map(|(i, r)| r * weight(i)));
    let apart = most(&mut a.1.iter().zip(b.1).enumerate().map(|(i, (a, b))| (a - b) * weight(i)));
    // Forces that move nothing by more than 1e-3 of the scale are compared with those that would.
    let least = 1e-3 * scale / most(&mut (0..a.1.len()).map(weight));
    (x, if apart == 0.0 { 0.0 } else { apart / force.max(least) })
}

#[test]
fn condensed_and_clarabel_agree_on_displacement_and_force() {
    let mut random = Random(12);
    let (mut worst_x, mut worst_r, mut met, mut fallbacks) = (0.0_f64, 0.0_f64, 0, 0);
    for trial in 0..1_500 {
        let (n, m) = (1 + random.below(if trial % 4 == 0 { 50 } else { 15 }), 1 + random.below(40));
        let (problem, cases) = sequence(&mut random, n, m, 8);
        let judge = Judge::new(&problem);
        let new = |backend| Solver::new(problem.problem(), backend, cases[0].scale).expect("sound");
        let (mut condensed, mut clarabel) = (new(Backend::Condensed), new(Backend::Clarabel));
        for (step, case) in cases.iter().enumerate() {
            let exact = condensed.solve(&case.rhs()).unwrap_or_else(|e| panic!("{trial}.{step}: {e}\n{case:?}"));
            let reference = clarabel.solve(&case.rhs()).unwrap_or_else(|e| panic!("{trial}.{step}: {e}\n{case:?}"));
            let a = (exact.x.as_slice(), exact.multiplier.as_slice());
            let b = (reference.x.as_slice(), reference.multiplier.as_slice());
            let (x, r) = difference(&judge, case.scale, a, b);
            // What is required; cond W = 1e6 makes 1e-10 of an ulp.
            assert!(x <= 1e-9 && r <= 1e-9, "{trial}.{step}: {x:e} {r:e}\n{case:?}\n{exact:?}\n{reference:?}");
            (worst_x, worst_r) = (worst_x.max(x), worst_r.max(r));
            met += u32::from(exact.multiplier.iter().any(|&r| r != 0.0));
        }
        fallbacks += condensed.counters().fallbacks;
    }
    println!("{met} in contact, {fallbacks} fallbacks: displacement {worst_x:e}, force {worst_r:e}");
    assert!(met > 5_000);
}

#[test]
fn forces_are_those_of_least_norm_that_enumeration_finds() {
    let mut random = Random(13);
    let (mut compared, mut shared, mut worst) = (0, 0, 0.0_f64);
    for trial in 0..4_000 {
        let (n, m) = (1 + random.below(4), 1 + random.below(6));
        let (problem, cases) = sequence(&mut random, n, m, 3);
        let judge = Judge::new(&problem);
        let mut solver = Solver::new(problem.problem(), Backend::Condensed, cases[0].scale).expect("sound");
        for case in &cases {
            let found = solver.solve(&case.rhs()).expect("feasible");
            let Some(share) = judge.least_share(&case.rhs(), case.scale, &found.x) else { continue };
            let (_, r) = difference(&judge, case.scale, (&found.x, &share), (&found.x, &found.multiplier));
            // The enumeration takes its forces from A x − b, and finds them in rows that may be at
            // an angle of 1e-3 only.
            assert!(r <= 1e-7, "{trial}: {r:e}\n{case:#?}\n{found:?}\n{share:?}");
            worst = worst.max(r);
            compared += 1;
            let rank = (0..m).filter(|&i| found.multiplier[i] != 0.0 && case.problem.compliance[i] == 0.0).count();
            shared += u32::from(rank > n);
        }
    }
    println!("{compared} compared, {shared} of them with more forces than unknowns, largest difference {worst:e}");
    assert!(compared > 6_000 && shared > 50);
}

#[test]
fn condensed_finds_the_set_that_enumeration_finds() {
    let mut random = Random(14);
    let (mut compared, mut worst) = (0, 0.0_f64);
    for trial in 0..400 {
        let (n, m) = (1 + random.below(5), 1 + random.below(5));
        let case = random_case(&mut random, n, m);
        let Some(exact) = brute_force(&case) else { continue };
        let mut solver = Solver::new(case.problem.problem(), Backend::Condensed, case.scale).expect("sound");
        let found = solver.solve(&case.rhs()).expect("feasible");
        let (x, _) = difference(&Judge::new(&case.problem), case.scale, (&exact.x, &[]), (&found.x, &[]));
        // Both solve well-conditioned systems (A has condition < 1e2): far from the 1e-9 that
        // separates sets.
        assert!(x <= 1e-9, "{trial}: {x:e}\n{case:#?}\n{exact:?}\n{found:?}");
        worst = worst.max(x);
        compared += 1;
    }
    println!("enumeration: {compared} compared, largest difference {worst:e}");
    assert!(compared > 350, "only {compared} were comparable");
}

#[test]
fn the_matrix_on_which_plain_active_sets_cycle_is_solved_from_every_start() {
    // minimise ½ xᵀH x + cᵀx, x ≤ 0.
    let h = DMatrix::from_row_slice(3, 3, &[4.0, 5.0, -5.0, 5.0, 9.0, -5.0, -5.0, -5.0, 7.0]);
    let problem = Dense { a: h.clone(), g: DMatrix::identity(3, 3), compliance: DVector::zeros(3) };
    let case = Case { problem, b: vec![-2.0, -1.0, 3.0], lo: vec![-INF; 3], hi: vec![0.0; 3], scale: 1.0 };
    let exact = brute_force(&case).expect("unique");
    for start in 0..8_u8 {
        let mut solver = Solver::new(case.problem.problem(), Backend::Condensed, 1.0).expect("sound");
        // A programme that leaves the wanted rows in play: x is 0 with force 1 on those, and −1
        // without on the others.
        let on = |i: usize| start >> i & 1 == 1;
        let x = DVector::from_fn(3, |i, _| if on(i) { 0.0 } else { -1.0 });
        let r = DVector::from_fn(3, |i, _| if on(i) { -1.0 } else { 0.0 });
        let b = &h * x - &r;
        let before = solver.solve(&Rhs { b: b.as_slice(), ..case.rhs() }).expect("feasible").clone();
        for i in 0..3 {
            assert_eq!(before.multiplier[i] != 0.0, on(i), "start {start}");
        }
        let found = solver.solve(&case.rhs()).expect("feasible").clone();
        assert_eq!(solver.counters().fallbacks, 0);
        for i in 0..3 {
            // Condition of H is 1e2: rounding 1e-14.
            assert!((found.x[i] - exact.x[i]).abs() <= 1e-12, "{start}: {found:?} {exact:?}");
            assert!((found.multiplier[i] - exact.multiplier[i]).abs() <= 1e-12, "{start}: {found:?} {exact:?}");
        }
    }
}

#[test]
fn equal_walls_at_one_place_share_equally_and_unequal_ones_by_least_norm() {
    for backend in [Backend::Condensed, Backend::Clarabel] {
        // Two masses, the first between three equal walls, one of them half an ulp away, and one
        // that sees twice its motion.
        let problem = Dense {
            a: DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]),
            g: DMatrix::from_row_slice(5, 2, &[1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 2.0, 0.0]),
            compliance: DVector::zeros(5),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        let hi = [1.0, 1.0, 9.0, 1.0 + f64::EPSILON, 2.0];
        let found = solver.solve(&Rhs { b: &[6.0, 0.0], lo: &[-INF; 5], hi: &hi }).expect("feasible");
        // x = (1, ½), so 2 − ½ = 6 + Σ: Σ = −4.5 over 1 + 1 + 1 + 2·r₄, and of least Σ Wᵢᵢ rᵢ²:
        // every gᵢ rᵢ the same, −4.5/4.
        for (i, share) in [-1.125, -1.125, 0.0, -1.125, -0.5625].into_iter().enumerate() {
            // Rounding of a few operations on numbers below 10.
            assert!((found.multiplier[i] - share).abs() <= 1e-14, "{backend}: {found:?}");
        }
        assert!((found.x[0] - 1.0).abs() <= 1e-15 && (found.x[1] - 0.5).abs() <= 1e-15, "{backend}: {found:?}");
    }
}

#[test]
fn dependent_triples_get_the_share_of_least_norm() {
    for backend in [Backend::Condensed, Backend::Clarabel] {
        // Two masses and their sum, A = 1: W = [1 0 1; 0 1 1; 1 1 2]. All stand on a bound under
        // loads (1+p, 1+q).
        let problem = Dense {
            a: DMatrix::identity(2, 2),
            g: DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
            compliance: DVector::zeros(3),
        };
        let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
        for (p, q) in [(4.0, 4.0), (4.0, 2.0), (4.0, 0.5), (0.5, 4.0), (3.0, 0.0)] {
            let found =
                solver.solve(&Rhs { b: &[1.0 + p, 1.0 + q], lo: &[-INF; 3], hi: &[1.0, 1.0, 2.0] }).expect("feasible");
            // r = −(p − t, q − t, t) with t ≤ min(p, q) and least (p−t)² + (q−t)² + 2t²: t =
            // (p+q)/4, if it is no more.
            let t = f64::min((p + q) / 4.0, f64::min(p, q));
            for (i, share) in [p - t, q - t, t].into_iter().enumerate() {
                assert!((found.multiplier[i] + share).abs() <= 1e-14, "{backend}, {p}, {q}: {found:?}"); // as above
            }
        }
        // Bounds of the sum that the two cannot meet: named, and the solver goes on.
        let failure = solver.solve(&Rhs { b: &[5.0, 5.0], lo: &[-INF, -INF, 3.0], hi: &[1.0, 1.0, INF] }).unwrap_err();
        let Failure::Infeasible { row, against } = failure else { panic!("{backend}: {failure}") };
        assert!(row == 2 && against < 2, "{backend}: {failure:?}");
        assert!(solver.solve(&Rhs { b: &[5.0, 5.0], lo: &[-INF; 3], hi: &[1.0; 3] }).is_ok(), "{backend}");
    }
}

#[test]
fn nearly_dependent_rows_keep_their_forces() {
    // Rows e₁ and e₁ + ε e₂ over A = 1: cond W = 4/ε², and with ε = 2^-10 every number here is
    // exact but the solution's own rounding.
    let epsilon = f64::powi(2.0, -10);
    let problem = Dense {
        a: DMatrix::identity(2, 2),
        g: DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 1.0, epsilon]),
        compliance: DVector::zeros(2),
    };
    for (r1, r2) in [(-1.0, -1.0), (-0.25, -8.0), (-3.0, -0.125)] {
        let (x1, x2) = (0.5, 0.25);
        let b = [x1 - (r1 + r2), x2 - epsilon * r2];
        let rhs = Rhs { b: &b, lo: &[-INF; 2], hi: &[x1, x1 + epsilon * x2] };
        for backend in [Backend::Condensed, Backend::Clarabel] {
            let mut solver = Solver::new(problem.problem(), backend, 1.0).expect("sound");
            let found = solver.solve(&rhs).expect("feasible");
            let error = (found.multiplier[0] - r1).abs().max((found.multiplier[1] - r2).abs());
            // Rounding 1e-16 of numbers up to 8 times the condition, 4e6.
            assert!(error <= 8.0 * 4e6 * f64::EPSILON, "{backend}: {error:e} {found:?}");
        }
    }
}

/// A x − b − r of a chain with a wall pair on every mass, against the size of its terms, and the
/// worst complementarity.
fn chain_residual(coupling: f64, b: &[f64], bound: f64, x: &[f64], r: &[f64]) -> (f64, f64) {
    let at = |i: usize, d: isize| i.checked_add_signed(d).and_then(|j| x.get(j)).copied().unwrap_or(0.0);
    let (mut balance, mut size, mut worst) = (0.0_f64, 0.0_f64, 0.0_f64);
    for i in 0..x.len() {
        let left = (1.0 + 2.0 * coupling) * x[i] - coupling * (at(i, -1) + at(i, 1));
        balance = balance.max((left - b[i] - r[i]).abs());
        size = size.max(left.abs()).max(b[i].abs()).max(r[i].abs());
        let gap = if r[i] > 0.0 { x[i] + bound } else { bound - x[i] };
        worst = worst.max(x[i].abs() - bound).max(r[i].abs().min(gap.abs()));
    }
    (balance / size, worst / size)
}

#[test]
fn long_chains_are_solved_whatever_their_stiffness() {
    let mut random = Random(15);
    for (n, coupling) in [(20, 0.0025), (200, 0.0025), (200, 3.0), (500, 1e3), (2_000, 0.1)] {
        let chain = (0..n).map(|i| (i, i, 1.0 + 2.0 * coupling)).chain((1..n).map(|i| (i, i - 1, -coupling)));
        let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
        let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
        let problem = Problem { a: Symmetric::from_entries(n, chain), g, compliance: vec![0.0; n] };
        let mut solver = Solver::new(problem, Backend::Auto, 1.0).expect("sound");
        assert_eq!(solver.backend(), Backend::Condensed);
        let (lo, hi) = (vec![-1.0; n], vec![1.0; n]);
        let mut b: Vec<f64> = (0..n).map(|_| random.between(-1.3, 1.3)).collect();
        for _ in 0..100 {
            for b in &mut b {
                *b = 0.9 * *b + random.between(-0.3, 0.5);
            }
            let found = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
            let (balance, worst) = chain_residual(coupling, &b, 1.0, &found.x, &found.multiplier);
            // Condition of A is 1 + 4 · coupling: 4e3 ulps at most. The sign test's tolerance.
            assert!(balance <= 1e-12 && worst <= 1e-12, "{n}, {coupling}: {balance:e} {worst:e}");
        }
        let counters = solver.counters();
        println!("{n}, {coupling}: {counters:?}");
        assert!(counters.fallbacks == 0 && counters.free < 100);
    }
}

#[test]
fn many_more_rows_than_unknowns() {
    // As modes see many walls: dense rows over a diagonal A, W of rank 12.
    let mut random = Random(16);
    let (n, m) = (12, 300);
    let stiffness: Vec<f64> = (0..n).map(|i| f64::from((1 + i as u32).pow(2))).collect();
    let problem = Dense {
        a: DMatrix::from_diagonal(&DVector::from_vec(stiffness)),
        g: DMatrix::from_fn(m, n, |i, j| {
            (std::f64::consts::PI * (j + 1) as f64 * (i + 1) as f64 / (m + 1) as f64).sin()
        }),
        compliance: DVector::zeros(m),
    };
    let mut solver = Solver::new(problem.problem(), Backend::Condensed, 1.0).expect("sound");
    let judge = Judge::new(&problem);
    for step in 0..50 {
        let b: Vec<f64> = (0..n).map(|_| random.between(-20.0, 20.0)).collect();
        let case = Case { problem: problem.clone(), b, lo: vec![-1.0; m], hi: vec![1.0; m], scale: 1.0 };
        let found = solver.solve(&case.rhs()).unwrap_or_else(|e| panic!("{step}: {e}"));
        let residual = judge.judge(&case.rhs(), 1.0, found);
        assert!(residual.worst() <= 1e-12, "{step}: {residual:?}"); // the sign test's tolerance
    }
    println!("{:?}", solver.counters());
    let case = random_case(&mut random, 3, 9);
    let found =
        Solver::new(case.problem.problem(), Backend::Condensed, case.scale).expect("sound").solve(&case.rhs()).cloned();
    assert!(judge_worst(&case, &found.expect("feasible")) <= 1e-12);
}

fn judge_worst(case: &Case, solution: &signorini::qp::Solution) -> f64 {
    judge(case, solution).worst()
}
