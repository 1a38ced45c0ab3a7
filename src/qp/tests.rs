//! Programmes that make no sense.

pub(super) mod trial;

use super::*;

const INF: f64 = f64::INFINITY;

fn problem(a: f64, g: f64, compliance: f64) -> Problem {
    let rows: [&[(usize, f64)]; 2] = [&[(0, 1.0)], &[(0, g)]];
    Problem { a: Symmetric::diagonal(&[a]), g: Rows::new(1, rows), compliance: vec![0.0, compliance] }
}

#[test]
fn the_number_that_is_none_is_named() {
    assert_eq!(problem(2.0, 0.0, 0.0).check(), Ok(()));
    assert_eq!(problem(2.0, -1.0, 3.0).check(), Ok(()));
    let fault = |what, index| Err(Failure::NotFinite { what, index });
    for bad in [f64::NAN, INF, -INF] {
        assert_eq!(problem(bad, 1.0, 0.0).check(), fault("A, row", 0), "{bad}");
        assert_eq!(problem(2.0, bad, 0.0).check(), fault("G, row", 1), "{bad}");
        assert_eq!(problem(2.0, 1.0, bad).check(), fault("compliance", 1), "{bad}");
    }
    assert_eq!(problem(2.0, 1.0, -1.0).check(), fault("compliance", 1));
}

#[test]
fn bounds_cross_by_a_share_of_the_lengths_of_the_programme() {
    for unit in [1e-12, 1.0, 1e12] {
        let crossed = |scale: f64, lo: f64, by: f64| {
            let (lo, hi) = ([-INF, lo * unit], [INF, (lo - by) * unit]);
            Rhs { b: &[], lo: &lo, hi: &hi }.check(scale * unit, 0..2)
        };
        let refused = Err(Failure::Infeasible { row: 1, against: 1 });
        // 1e-12 of the scale, or of the bounds where those are larger.
        assert_eq!((crossed(1.0, 0.0, 0.9e-12), crossed(1.0, 0.0, 1.1e-12)), (Ok(()), refused), "{unit}");
        assert_eq!((crossed(1e-3, 100.0, 0.9e-10), crossed(1e-3, 100.0, 1.1e-10)), (Ok(()), refused), "{unit}");
        assert_eq!(crossed(1.0, 1.0, 0.0), Ok(()), "{unit}");
    }
}
