//! First roots of polynomials that are 0 to rounding at their start, and the walls of a row.

use super::*;
use crate::scene::Wall;

const NOISE: f64 = 1e-15;

/// The first event of a gap up to x = 1, with this rounding error of each coefficient.
fn seen(c: &[f64], zeros: Option<LeadingZeros>, noise: f64) -> FirstRoot {
    watch(c).first(zeros, || Rounding::new([noise; NOISES], 0.0), true, false, 1.0)
}

fn watch(c: &[f64]) -> RowPolynomial {
    let mut watched = RowPolynomial { c: [0.0; TERMS], terms: c.len() };
    watched.c[..c.len()].copy_from_slice(c);
    watched
}

#[track_caller]
fn assert_root(found: FirstRoot, root: f64) {
    assert!(matches!(found, FirstRoot::Root(x) if (x - root).abs() <= 1e-14 * root), "{found:?} for {root:e}");
}

#[test]
fn a_gap_that_is_0_to_rounding_stays_closed_until_it_is_known_to_fall() {
    // All within rounding: as it stands, the first polynomial is below 0 from x = 0.1 on.
    assert_eq!(seen(&[1e-18, -1e-17, 1e-17, -1e-16], None, NOISE), FirstRoot::Nothing);
    assert_eq!(seen(&[0.0; 4], None, 0.0), FirstRoot::Nothing);
    for falls in [[1e-18, -1e-3, 0.0, 0.0], [0.0, 0.0, -1e-3, 0.0], [0.0, 1e-18, 1e-18, -1e-3]] {
        assert_eq!(seen(&falls, None, NOISE), FirstRoot::Now, "{falls:?}");
    }
    assert_root(seen(&[1e-18, 1.0, -2.0, 0.0], None, NOISE), 0.5);
    assert_root(seen(&[0.25, -1.0, 0.0, 0.0], None, NOISE), 0.25);
}

#[test]
fn a_gap_below_0_by_more_than_rounding_is_an_event_unless_it_rises() {
    assert_eq!(seen(&[-1e-13, 0.0, 0.0, 0.0], None, NOISE), FirstRoot::Now);
    assert_eq!(seen(&[-2e-15, 0.0, 0.0, 0.0], None, NOISE), FirstRoot::Nothing);
    assert_eq!(seen(&[-2e-15, 1.0, 0.0, 0.0], None, NOISE), FirstRoot::Nothing);
    // A force below 0 is one in any case.
    let force = watch(&[-2e-15, 1.0, 0.0, 0.0]);
    assert_eq!(force.first(None, || Rounding::new([NOISE; NOISES], 0.0), true, true, 1.0), FirstRoot::Now);
}

#[test]
fn what_an_event_has_decided_is_not_contradicted_by_rounding() {
    // Two coefficients are 0, the third rises by little: as they stand there is a root at 0.1.
    assert_eq!(seen(&[1e-18, -1e-17, 1e-18, 0.0], Some(LeadingZeros::Then(2)), NOISE), FirstRoot::Nothing);
    assert_eq!(seen(&[0.0, 0.0, -1e-17, 1.0], Some(LeadingZeros::Then(2)), NOISE), FirstRoot::Nothing);
    for zeros in [LeadingZeros::Then(2), LeadingZeros::Unknown(2), LeadingZeros::All] {
        assert_eq!(seen(&[0.0; 4], Some(zeros), 0.0), FirstRoot::Nothing, "{zeros:?}");
    }
    // A rise below rounding, which was decided, and the fall after it.
    assert_root(seen(&[0.0, 1e-17, -1.0, 0.0], Some(LeadingZeros::Then(1)), NOISE), 1e-17);
    // Beyond the coefficients whose rounding is known.
    assert_root(seen(&[0.0, 0.0, 0.0, 0.0, 1e-3, -1.0], Some(LeadingZeros::Then(4)), NOISE), 1e-3);
    for least in [-1e-20, 0.0] {
        assert_eq!(seen(&[0.0, 0.0, 0.0, 0.0, least, 1.0], Some(LeadingZeros::Then(4)), NOISE), FirstRoot::Nothing);
    }
}

#[test]
fn doubt_enlarges_the_rounding_errors() {
    let c = watch(&[0.0, -2e-15, 0.0, 0.0]);
    let first = |doubt| c.first(None, || Rounding::new([NOISE; NOISES], 0.0).doubted(doubt), true, false, 1.0);
    assert_eq!((first(1.0), first(4.0)), (FirstRoot::Now, FirstRoot::Nothing));
}

#[test]
fn the_nearest_walls_of_a_row_share_its_force_and_the_most_elastic_its_impulse() {
    let (e, side) = ([0.3, 0.7, 0.7, 0.9, 0.2], [1.0, 1.0, 1.0, 1.5, 1.0]);
    for order in [[0, 1, 2, 3, 4], [2, 0, 1, 4, 3], [3, 4, 1, 0, 2]] {
        for sign in [1.0, -1.0] {
            let wall = |&i: &usize| {
                let wall = if sign > 0.0 { Wall::lower("", -side[i]) } else { Wall::upper("", side[i]) };
                wall.with_restitution(e[i])
            };
            let scene = order.iter().map(wall).fold(Scene::oscillator(1.0, 0.0, 0.0), Scene::with_wall);
            let row = WallRow::new(&scene, &[0, 1, 2, 3, 4]);
            let at = usize::from(sign < 0.0);
            let found = (row.bound[at], row.restitution[at], row.carriers[at], row.strikers[at]);
            assert_eq!(found, (-sign, 0.7, 4, 2), "{order:?}");
            assert!(row.bound[1 - at].is_infinite() && row.carriers[1 - at] == 0, "{order:?}");
        }
    }
}
