//! What a solver answers, refuses and counts.

use super::super::solver::DiskCounters;
use super::super::{DiskBound, DiskProblem, DiskSolver};
use super::{Case, Draws, Units};
use crate::linear::{Rows, Symmetric};
use crate::qp::Failure;

/// Unknowns y and z of stiffness 1 in one block of two rows.
fn plane(scale: f64) -> Result<DiskSolver, Failure> {
    let problem = DiskProblem {
        a: Symmetric::diagonal(&[1.0; 2]),
        g: Rows::new(2, [[(0, 1.0)], [(1, 1.0)]].iter().map(|row| row.as_slice())),
        blocks: vec![2],
        compliance: vec![0.0],
    };
    DiskSolver::new(problem, scale)
}

fn strip(lo: f64, hi: f64) -> DiskBound {
    DiskBound::Strip { normal: [1.0, 0.0], lo, hi }
}

#[test]
fn programmes_in_any_units_are_solved_to_rounding() {
    let mut pushing = 0;
    for seed in 0..150 {
        let case = Case::random(&mut Draws::new(11, seed), 6, None);
        for units in Units::all() {
            let case = case.in_units(units);
            let mut solver = DiskSolver::new(case.problem.clone(), units.length).expect("a sound programme");
            let found = solver.solve(&case.b, &case.bounds).expect("a solution");
            pushing += found.multiplier.iter().filter(|r| **r != 0.0).count();
            // Roundings of some ten terms, times the condition of matrices with eigenvalues from
            // 0.01 to 10.
            let miss = case.miss(&found.x, &found.multiplier);
            assert!(miss < 1e-12, "{seed}, {units:?}: {miss:e}");
        }
    }
    assert!(pushing > 1000, "{pushing}");
}

#[test]
fn more_strips_than_unknowns_that_nearly_meet_in_a_point_are_solved() {
    for seed in 0..60 {
        let mut draws = Draws::new(11, seed);
        let coupling = draws.between(-0.5, 0.5);
        let a = [(0, 0, draws.between(0.5, 1.5)), (1, 0, coupling), (1, 1, draws.between(0.5, 1.5))];
        let count = 3 + draws.below(3);
        let rows: Vec<[(usize, f64); 2]> =
            (0..count).map(|_| [(0, draws.between(-1.0, 1.0)), (1, draws.between(-1.0, 1.0))]).collect();
        let place = [[(0, 1.0)], [(1, 1.0)]];
        let problem = DiskProblem {
            a: Symmetric::from_entries(2, a),
            g: Rows::new(2, rows.iter().map(|row| &row[..]).chain(place.iter().map(|row| &row[..]))),
            blocks: [vec![1; count], vec![2]].concat(),
            compliance: vec![0.0; count + 1],
        };
        // The bounds pass the point at up to this distance, on the side that keeps it.
        let (point, near) = ([0.7, -0.4], 10.0_f64.powf(draws.between(-9.0, -3.0)));
        let mut bound = |row: &[(usize, f64); 2]| {
            let at: f64 = row.iter().map(|&(i, x)| x * point[i]).sum();
            strip(f64::NEG_INFINITY, at + near * draws.between(0.0, 1.0))
        };
        let mut bounds: Vec<DiskBound> = rows.iter().map(&mut bound).collect();
        bounds.push(DiskBound::Disk { centre: point, radius: 2.0 });
        let case = Case { problem, b: vec![draws.between(-1.0, 1.0), draws.between(-1.0, 1.0)], bounds };
        let mut solver = DiskSolver::new(case.problem.clone(), 1.0).expect("a sound programme");
        let found = solver.solve(&case.b, &case.bounds).unwrap_or_else(|fault| panic!("{seed}: {fault}"));
        // Rows within 1e-3 of parallel lose three digits.
        let miss = case.miss(&found.x, &found.multiplier);
        assert!(miss < 1e-11, "{seed}: {miss:e}");
    }
}

#[test]
fn blocks_that_hardly_feel_each_other_are_solved_to_rounding_in_any_units() {
    // Sweeps over two disks leave a power of their coupling, which may be too much to pass for
    // rounding in one unit, and nothing in another.
    for power in 8..60 {
        let coupling = (-0.25 * f64::from(power)).exp2();
        let a = [(0, 0, 1.0), (1, 1, 2.0), (2, 2, 1.5), (3, 3, 1.0), (2, 0, coupling), (3, 1, -coupling)];
        let rows: Vec<[(usize, f64); 1]> = (0..4).map(|i| [(i, 1.0)]).collect();
        let problem = DiskProblem {
            a: Symmetric::from_entries(4, a),
            g: Rows::new(4, rows.iter().map(|row| row.as_slice())),
            blocks: vec![2, 2],
            compliance: vec![0.0; 2],
        };
        let disk = |y: f64| DiskBound::Disk { centre: [y, 0.1], radius: 0.7 };
        let case = Case { problem, b: vec![2.0, -1.0, 1.5, 3.0], bounds: vec![disk(0.2), disk(-0.3)] };
        for length in [1.0, 2.0_f64.powi(-40), 2.0_f64.powi(40)] {
            let case = case.in_units(Units { length, ..Units::SI });
            let mut solver = DiskSolver::new(case.problem.clone(), length).expect("a sound programme");
            let found = solver.solve(&case.b, &case.bounds).expect("a solution");
            let miss = case.miss(&found.x, &found.multiplier);
            // Some roundings.
            assert!(miss < 1e-14, "{coupling:e}, {length:e}: {miss:e}");
        }
    }
}

#[test]
fn strips_that_would_pull_let_go_in_any_units() {
    // Without disks one linear system answers all strips in play, also those that pull.
    for seed in 0..300 {
        let mut case = Case::random(&mut Draws::new(11, 5000 + seed), 6, None);
        for bound in &mut case.bounds {
            if let DiskBound::Disk { centre: [y, _], radius } = *bound {
                *bound = strip(y - radius, y + radius);
            }
        }
        for units in Units::all() {
            let case = case.in_units(units);
            let mut solver = DiskSolver::new(case.problem.clone(), units.length).expect("a sound programme");
            let found = solver.solve(&case.b, &case.bounds).expect("a solution");
            let miss = case.miss(&found.x, &found.multiplier);
            // As above.
            assert!(miss < 1e-12, "{seed}, {units:?}: {miss:e}");
        }
    }
}

#[test]
fn many_blocks_that_depend_on_few_unknowns_are_solved_once_and_again() {
    for seed in 0..250 {
        let mut draws = Draws::new(11, 1000 + seed);
        let rank = 2 + draws.below(3);
        let case = Case::random(&mut draws, 14, Some(rank));
        let mut solver = DiskSolver::new(case.problem.clone(), 1.0).expect("a sound programme");
        let found = solver.solve(&case.b, &case.bounds).expect("a solution").clone();
        // Multipliers of blocks that press against each other may be larger than what remains.
        let miss = case.miss(&found.x, &found.multiplier);
        assert!(miss < 1e-9, "{seed}: {miss:e}");
        // From where the first ended, the second finds the same minimiser.
        let again = solver.solve(&case.b, &case.bounds).expect("a solution");
        let apart = found.x.iter().zip(&again.x).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        assert!(apart < 1e-8, "{seed}: {apart:e}");
    }
}

#[test]
fn what_lies_on_its_bound_needs_no_force_and_counts_as_free() {
    let mut solver = plane(1.0).expect("a plane");
    let disk = DiskBound::Disk { centre: [1.0, 0.0], radius: 5.0 };
    let on_bounds = [([4.0, 4.0], disk), ([2.0, 9.0], strip(2.0, 3.0)), ([3.0, 9.0], strip(2.0, 3.0))];
    for (b, bound) in on_bounds {
        let found = solver.solve(&b, &[bound]).expect("a solution");
        assert_eq!((&found.x[..], &found.multiplier[..]), (&b[..], &[0.0; 2][..]));
    }
    assert_eq!(solver.counters(), DiskCounters { solves: 3, free: 3, ..DiskCounters::default() });
    for (b, x) in [(1.0, 2.0), (5.0, 3.0)] {
        let found = solver.solve(&[b, 9.0], &[strip(2.0, 3.0)]).expect("a solution");
        assert!((found.x[0] - x).abs() < 1e-15 && (found.multiplier[0] - (x - b)).abs() < 1e-15, "{found:?}");
    }
    let DiskCounters { solves, free, fallbacks, iterations, .. } = solver.counters();
    assert_eq!([solves, free, fallbacks, iterations], [5, 3, 0, 0]);
}

#[test]
fn bounds_may_cross_by_rounding_and_no_farther() {
    // Rounding is 1e-12 of the scale or of the bounds.
    for (scale, lo, hi, crossed) in [
        (1.0, 1.0 + 1e-13, 1.0, false),
        (1.0, 1.0 + 1e-11, 1.0, true),
        (1e3, 1e-10, 0.0, false),
        (1e3, 1e-8, 0.0, true),
        (1e-3, 1e-10, 0.0, true),
        (1e-3, 1e6 + 1e-7, 1e6, false),
        (1e-3, -1e6, -1e6 - 1e-5, true),
    ] {
        let mut solver = plane(scale).expect("a plane");
        let found = solver.solve(&[0.0, 0.0], &[strip(lo, hi)]);
        assert_eq!(found.is_err(), crossed, "{scale}, {lo}, {hi}: {found:?}");
        assert!(!crossed || matches!(found, Err(Failure::Infeasible { row: 0, against: 0 })), "{found:?}");
    }
}

#[test]
fn bounds_and_scales_that_are_no_numbers_are_refused() {
    let mut solver = plane(1.0).expect("a plane");
    for (lo, hi, what) in [
        (f64::NAN, 1.0, "lower bound"),
        (f64::INFINITY, f64::INFINITY, "lower bound"),
        (0.0, f64::NAN, "upper bound"),
        (f64::NEG_INFINITY, f64::NEG_INFINITY, "upper bound"),
    ] {
        let failure = solver.solve(&[0.0; 2], &[strip(lo, hi)]).expect_err("no bounds");
        assert_eq!(failure, Failure::NotFinite { what, index: 0 }, "{lo}, {hi}");
    }
    for scale in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let refused = plane(scale).map(|_| ()).expect_err("no scale");
        assert!(matches!(refused, Failure::NotFinite { what: "scale", .. }), "{scale}: {refused:?}");
    }
}

#[test]
fn the_work_of_two_solvers_is_the_sum_of_each_count() {
    let one = DiskCounters { solves: 1, free: 20, newton: 300, fallbacks: 4000, iterations: 50_000 };
    let other = DiskCounters { solves: 6, free: 70, newton: 800, fallbacks: 9000, iterations: 20_000 };
    let both = DiskCounters { solves: 7, free: 90, newton: 1100, fallbacks: 13_000, iterations: 70_000 };
    assert_eq!(one.and(other), both);
}
