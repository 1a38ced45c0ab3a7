//! The rows that the interior point finds, compared with those of the dual active-set method.

use super::super::active_set::ActiveSet;
use super::*;
use crate::qp::tests::trial::{Dense, Draws, chain};

#[test]
fn the_rows_that_push_are_found_in_all_units() {
    let mut draws = Draws::new(11, 0);
    let mut held = 0;
    for trial in 0..60 {
        let (n, m) = (1 + trial % 6, 1 + trial % 5);
        let (a, _, problem) = chain(&mut draws, n, m);
        let mut system = Delassus::new(&problem).expect("definite");
        let mut interior = Clarabel::new(&problem, &system);
        let mut play = Pivoting::new(&system);
        let length = 10_f64.powf(draws.between(-9.0, 9.0));
        for step in 0..3 {
            let x = draws.vector(n) * length * 3.0;
            system.complete(x.as_slice());
            // Bounds around 0 can be met together.
            let room = |draws: &mut Draws| {
                if draws.chance(0.3) { f64::INFINITY } else { draws.between(0.1, 1.0) * length }
            };
            let (lo, hi): (Vec<_>, Vec<_>) = (0..m).map(|_| (-room(&mut draws), room(&mut draws))).unzip();
            let b = &a * &x;
            let rhs = Rhs { b: b.as_slice(), lo: &lo, hi: &hi };
            let beyond = |i: usize| (lo[i] - system.y[i]).max(system.y[i] - hi[i]) / system.weight[i];
            let violation = (0..m).map(beyond).fold(0.0, f64::max);
            if violation == 0.0 {
                continue;
            }
            interior.find(&system, &rhs, violation, length, &mut play).expect("solved");
            let mut r = vec![0.0; m];
            ActiveSet::new(m).solve(&system, &rhs, length, 999, &mut r).expect("feasible");
            let side = |r: f64| if r > 0.0 { Side::Lower } else { Side::Upper };
            let pushing: Vec<_> = (0..m).filter(|&i| r[i] != 0.0).map(|i| (i, side(r[i]))).collect();
            assert_eq!(play.called().collect::<Vec<_>>(), pushing, "trial {trial}.{step}");
            held += pushing.len();
        }
    }
    assert!(held > 100, "{held}");
}

#[test]
fn walls_at_one_place_leave_an_interior_however_small_the_violation() {
    // Both rows stand at 1, where the body is to 1e-10, which is beside 1 what 16 ulps are beside
    // 4e-5; bounds moved by less could cross.
    let dense = Dense::rigid([[1.0], [1.0]]);
    let system = dense.system(&[1.0 - 1e-10]);
    let (mut interior, mut play) = (Clarabel::new(&dense.problem(), &system), Pivoting::new(&system));
    let rhs = Rhs { b: &[1.0 - 1e-10], lo: &[1.0, f64::NEG_INFINITY], hi: &[f64::INFINITY, 1.0] };
    assert!(interior.find(&system, &rhs, 1e-10, 1.0, &mut play).is_ok());
    assert_eq!(play.called().collect::<Vec<_>>(), [(0, Side::Lower)]);
}

#[test]
fn entries_at_one_place_are_added_up() {
    let columns = [vec![(2, 1.0), (0, 3.0), (2, 0.5)], vec![], vec![(1, 0.0), (2, 4.0)], vec![(2, 7.0)]];
    let matrix = by_columns(3, &columns);
    assert_eq!((matrix.m, matrix.n), (3, 4));
    assert_eq!((matrix.colptr, matrix.rowval), (vec![0, 2, 2, 3, 4], vec![0, 2, 2, 2]));
    assert_eq!(matrix.nzval, [3.0, 1.5, 4.0, 7.0]);
}
