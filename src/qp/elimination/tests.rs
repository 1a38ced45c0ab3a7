//! Small programmes, by the optimality conditions and by hand.

use super::*;
use crate::linear::{Rows, Symmetric};
use crate::qp::tests::trial::tridiagonal;

/// The programme with the rows `rows` (unknown, factor, compliance).
fn problem(a: Symmetric, rows: &[(usize, f64, f64)]) -> Problem {
    let entries: Vec<[(usize, f64); 1]> = rows.iter().map(|&(column, g, _)| [(column, g)]).collect();
    let g = Rows::new(a.size(), entries.iter().map(|row| row.as_slice()));
    Problem { a, g, compliance: rows.iter().map(|row| row.2).collect() }
}

/// Numbers in [0, 1) that look random: multiples of the golden ratio.
fn sequence() -> impl FnMut() -> f64 {
    let mut last = 0.0;
    move || {
        last = f64::fract(last + 0.618_033_988_749_894_8);
        // Neighbours of this sequence depend on one another; their squares' digits hardly do.
        (last * last * 1e4).fract()
    }
}

/// x, r and the count of changes, from the active set that `pivoting` holds.
fn solved(
    problem: &Problem,
    pivoting: &mut Option<Pivoting>,
    (b, lo, hi): (&[f64], &[f64], &[f64]),
) -> Option<(Vec<f64>, Vec<f64>, u64)> {
    solved_in(1.0, problem, pivoting, (b, lo, hi))
}

/// The same with the unit of length in which gaps are tested.
fn solved_in(
    scale: f64,
    problem: &Problem,
    pivoting: &mut Option<Pivoting>,
    (b, lo, hi): (&[f64], &[f64], &[f64]),
) -> Option<(Vec<f64>, Vec<f64>, u64)> {
    let mut elimination = Elimination::new(problem).expect("a band");
    let mut system = Delassus::new(problem).expect("definite");
    let (mut x, mut r) = (vec![0.0; b.len()], vec![0.0; lo.len()]);
    system.release(b, &mut x);
    system.complete(&x);
    let pivoting = pivoting.get_or_insert_with(|| Pivoting::new(&system));
    let changes = elimination.solve(&system, pivoting, &Rhs { b, lo, hi }, scale, (&mut x, &mut r))?;
    Some((x, r, changes))
}

#[test]
fn random_programmes_meet_their_optimality_conditions() {
    let mut next = sequence();
    let (mut held, mut soft, mut free, mut both) = (0, 0, 0, 0);
    for trial in 0..300 {
        let n = 2 + trial % 11;
        let width = (1 + trial % 4).min(n - 1);
        let mut a = vec![vec![0.0; n]; n];
        for i in 0..n {
            a[i][i] += 0.1 + next();
            for j in i.saturating_sub(width)..i {
                let k = 0.1 + next();
                (a[i][j], a[j][i]) = (-k, -k);
                a[i][i] += k;
                a[j][j] += k;
            }
        }
        let mut rows = Vec::new();
        for i in 0..n {
            let g = if next() < 0.3 { -0.5 - next() } else { 1.0 + next() };
            let compliance = if next() < 0.3 { next() } else { 0.0 };
            if next() < 0.8 {
                rows.push((i, g, compliance));
            }
        }
        if rows.is_empty() {
            continue;
        }
        let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let matrix = Symmetric::from_entries(n, entries.map(|(i, j)| (i, j, a[i][j])).filter(|e| e.2 != 0.0));
        let problem = problem(matrix, &rows);
        let b: Vec<f64> = (0..n).map(|_| 6.0 * next() - 3.0).collect();
        let lo: Vec<f64> = rows.iter().map(|_| if next() < 0.2 { f64::NEG_INFINITY } else { -next() }).collect();
        // Some bounds coincide.
        let upper = |&lo: &f64| if lo.is_finite() && next() < 0.2 { lo } else { next() };
        let hi: Vec<f64> = lo.iter().map(upper).collect();
        let (x, r, _) = solved(&problem, &mut None, (&b, &lo, &hi)).expect("an M-matrix settles");
        // A x = b + Gᵀr, to the rounding of a dozen terms of size 10.
        for i in 0..n {
            let force: f64 = rows.iter().zip(&r).filter(|(row, _)| row.0 == i).map(|(row, r)| row.1 * r).sum();
            let product: f64 = (0..n).map(|j| a[i][j] * x[j]).sum();
            assert!((product - b[i] - force).abs() < 1e-12, "trial {trial}, equation {i}");
        }
        for (row, &(column, g, compliance)) in rows.iter().enumerate() {
            let (y, r) = (g * x[column], r[row]);
            // Where a row pushes it stands at the bound behind which it pushes, or is as far
            // behind it as its compliance says; the others are within their bounds.
            let expected = if r > 0.0 { lo[row] } else { hi[row] } - compliance * r;
            if r == 0.0 {
                assert!(lo[row] - 1e-12 <= y && y <= hi[row] + 1e-12, "trial {trial}, row {row}: {y}");
                free += 1;
            } else {
                assert!((y - expected).abs() < 1e-12, "trial {trial}, row {row}: {y}, {expected}");
                held += 1;
            }
            soft += usize::from(compliance > 0.0 && r != 0.0);
            both += usize::from(lo[row] == hi[row] && r < 0.0);
        }
    }
    assert!(held > 300 && free > 300 && soft > 50 && both > 20, "{held} {free} {soft} {both}");
}

#[test]
fn changes_of_state_are_counted() {
    // Three unknowns apart from one another: x = b/2, of which two pass their bounds ±1.
    let rows = [(0, 1.0, 0.0), (1, 1.0, 0.0), (2, 1.0, 0.0)];
    let apart = problem(tridiagonal(3, 2.0, 0.0), &rows);
    let (lo, hi) = ([-1.0; 3], [1.0; 3]);
    let mut pivoting = None;
    let (x, r, changes) = solved(&apart, &mut pivoting, (&[4.0, 1.0, -6.0], &lo, &hi)).expect("settles");
    assert_eq!((x, r, changes), (vec![1.0, 0.5, -1.0], vec![-2.0, 0.0, 4.0], 2));
    // The set found starts the next programme, of which nothing has to change,
    let (x, r, changes) = solved(&apart, &mut pivoting, (&[8.0, 1.0, -4.0], &lo, &hi)).expect("settles");
    assert_eq!((x, r, changes), (vec![1.0, 0.5, -1.0], vec![-6.0, 0.0, 2.0], 0));
    // or one row is released.
    let (x, r, changes) = solved(&apart, &mut pivoting, (&[1.0, 1.0, -4.0], &lo, &hi)).expect("settles");
    assert_eq!((x, r, changes), (vec![0.5, 0.5, -1.0], vec![0.0, 0.0, 2.0], 1));
    // A row takes the bound that it violates, also where both lie on one side of 0.
    let mut pivoting = None;
    let (low, high) = ([0.9, -1.0, -1.0], [1.0, -0.9, 1.0]);
    let (x, r, changes) = solved(&apart, &mut pivoting, (&[2.4, -2.4, 0.0], &low, &high)).expect("settles");
    assert_eq!((x, changes), (vec![1.0, -1.0, 0.0], 2));
    assert!((r[0] + 0.4).abs() < 1e-15 && (r[1] - 0.4).abs() < 1e-15 && r[2] == 0.0, "{r:?}");
    // Where both bounds coincide, the side on which a row pushes is no change of state.
    let mut pivoting = None;
    let (lo, hi) = ([0.0, -1.0, -1.0], [0.0, 1.0, 1.0]);
    for (b, force, expected) in [(4.0, -4.0, 1), (-4.0, 4.0, 0), (4.0, -4.0, 0)] {
        let (x, r, changes) = solved(&apart, &mut pivoting, (&[b, 0.0, 0.0], &lo, &hi)).expect("settles");
        assert_eq!((x, r, changes), (vec![0.0; 3], vec![force, 0.0, 0.0], expected), "{b}");
        let side = if force > 0.0 { Side::Lower } else { Side::Upper };
        assert!(pivoting.iter().flat_map(Pivoting::called).eq([(0, side)]), "{b}");
    }
}

#[test]
fn a_bound_is_violated_by_more_than_rounding_in_all_units() {
    let apart = problem(tridiagonal(2, 1.0, 0.0), &[(0, 1.0, 0.0), (1, 1.0, 0.0)]);
    for unit in [1e-9, 1.0, 1e9] {
        // A row beyond its bound by half of what rounding may do to lengths near 1, and by twice.
        let b = [0.5e-12, 2e-12].map(|x| x * unit);
        let (x, r, changes) = solved_in(unit, &apart, &mut None, (&b, &[-unit; 2], &[0.0; 2])).expect("settles");
        assert_eq!((x, r, changes), (vec![b[0], 0.0], vec![0.0, -b[1]], 1), "{unit}");
    }
}

#[test]
fn a_held_neighbour_moves_to_the_right_hand_side() {
    // x₁ is held at 1 by 2x₁ ≤ 2, between x₀ and x₂: 4x₀ = 1, 4x₂ = 5 + 1, and its force is that of
    // its equation 4 − x₀ − x₂ = b + 2r.
    let held = problem(tridiagonal(3, 4.0, -1.0), &[(1, 2.0, 0.0)]);
    let (x, r, changes) = solved(&held, &mut None, (&[0.0, 9.0, 5.0], &[f64::NEG_INFINITY], &[2.0])).expect("settles");
    assert_eq!((x, r, changes), (vec![0.25, 1.0, 1.5], vec![0.5 * (4.0 - 0.25 - 1.5 - 9.0)], 1));
}

#[test]
fn programmes_of_another_kind_are_left_to_pivoting() {
    let two = || tridiagonal(2, 2.0, -1.0);
    let of = |a: Symmetric, rows: &[(usize, f64, f64)]| Elimination::new(&problem(a, rows)).is_some();
    assert!(of(two(), &[(0, 1.0, 0.0), (1, -2.0, 0.5)]));
    // No row, a row without an entry, two rows on one unknown.
    assert!(!of(two(), &[]));
    assert!(!of(two(), &[(0, 0.0, 0.0)]));
    assert!(!of(two(), &[(0, 1.0, 0.0), (0, 1.0, 0.0)]));
    // A row that sees two unknowns.
    let g = Rows::new(2, [[(0, 1.0), (1, -1.0)]].iter().map(|row| row.as_slice()));
    assert!(Elimination::new(&Problem { a: two(), g, compliance: vec![0.0] }).is_none());
    // A band that is too wide, and one that is just narrow enough.
    let wide = |width: usize| Symmetric::from_entries(20, (0..20).map(|i| (i, i, 9.0)).chain([(width, 0, 1.0)]));
    assert!(of(wide(WIDEST), &[(0, 1.0, 0.0)]) && !of(wide(WIDEST + 1), &[(0, 1.0, 0.0)]));
}

#[test]
fn what_does_not_settle_or_is_not_definite_changes_nothing() {
    // Not definite: D of LDLᵀ is 1 and 1 − 4.
    let bad = problem(tridiagonal(2, 1.0, 2.0), &[(0, 1.0, 0.0)]);
    let good = problem(tridiagonal(2, 1.0, 0.0), &[(0, 1.0, 0.0)]);
    let system = Delassus::new(&good).expect("definite");
    let mut pivoting = Pivoting::new(&system);
    let rhs = Rhs { b: &[5.0, 5.0], lo: &[-1.0], hi: &[9.0] };
    let (mut x, mut r) = ([7.0, 7.0], [3.0]);
    let mut elimination = Elimination::new(&bad).expect("a band");
    assert_eq!(elimination.solve(&system, &mut pivoting, &rhs, 1.0, (&mut x, &mut r)), None);
    assert_eq!((x, r, pivoting.called().count()), ([7.0, 7.0], [3.0], 0));
    // Singular: D is 1 and 1 − 1.
    let mut elimination = Elimination::new(&problem(tridiagonal(2, 1.0, 1.0), &[(0, 1.0, 0.0)])).expect("a band");
    assert_eq!(elimination.solve(&system, &mut pivoting, &rhs, 1.0, (&mut x, &mut r)), None);
    assert_eq!((x, r, pivoting.called().count()), ([7.0, 7.0], [3.0], 0));
}
