//! Corners: places at which several rigid contacts push.
//!
//! Coulomb's law alone leaves there what the contacts press against each other. A rebound from one
//! flat that presses the body along another one asks for impulses of any size, whose friction adds
//! energy; and a body that is stopped in a corner has any decomposition of the impulse
//! R = Σ (−pᵢ nᵢ + fᵢ tᵢ) that stops it into the cones |fᵢ| ≤ μᵢ pᵢ. The one with the least sum of
//! pushes has one contact, where R lies in its cone, or two, each at its limit.

use super::friction_contact::{FrictionContact, State};
use super::normal::dot;

/// A velocity below this share of the largest change that a contact makes is rest.
const REST: f64 = 1e-9;

/// A sum of pushes that is smaller by less is the same.
const SAME: f64 = 1e-9;

/// True for a rigid contact that pushes at a place of two rows.
fn pushes(touch: &FrictionContact) -> bool {
    touch.compliance == 0.0 && touch.impulse[0] > 0.0 && touch.rows[0] != touch.rows[1]
}

/// True if friction adds more energy than `most` in a corner: the work at the mean of the
/// velocities `rates` before and those after the impulses, which change them by `change`.
pub(super) fn gains(touches: &[FrictionContact], (rates, change): (&[f64], &[f64]), most: f64) -> bool {
    let work = |touch: &FrictionContact| {
        let mean = touch.rows.map(|row| rates[row] + 0.5 * change[row]);
        touch.impulse[1] * dot(touch.tangent, mean)
    };
    touches.iter().filter(|touch| pushes(touch)).any(|touch| {
        let here = || touches.iter().filter(|other| other.rows == touch.rows && pushes(other));
        here().count() > 1 && here().map(work).sum::<f64>() > most
    })
}

/// Gives the contacts of each corner in which the body is stopped the impulses of the least sum of
/// pushes that stop it; the velocities `y` of all rows stay.
pub(super) fn relieve(touches: &mut [FrictionContact], y: &[f64]) {
    for first in 0..touches.len() {
        let rows = touches[first].rows;
        let here: Vec<usize> =
            (first..touches.len()).filter(|&at| touches[at].rows == rows && pushes(&touches[at])).collect();
        let seen = touches[..first].iter().any(|touch| touch.rows == rows && pushes(touch));
        if here.len() < 2 || seen {
            continue;
        }
        let largest = here.iter().map(|&at| touches[at].own[0] * touches[at].impulse[0]).fold(0.0, f64::max);
        if rows.iter().any(|&row| y[row].abs() > REST * largest) {
            continue;
        }
        let whole = here.iter().fold([0.0; 2], |sum, &at| {
            let push = touches[at].push(touches[at].impulse);
            [sum[0] + push[0], sum[1] + push[1]]
        });
        let Some(found) = least(touches, &here, whole) else { continue };
        for &at in &here {
            let impulse = found.iter().find(|(contact, _)| *contact == at).map_or([0.0; 2], |one| one.1);
            touches[at].impulse = impulse;
            touches[at].state = if impulse[0] > 0.0 { State::Stick } else { State::Open };
        }
    }
}

/// The impulses (p, f) of one or two of the contacts `here` with the least sum of pushes whose sum
/// on the body is `whole`; `None` where rounding leaves none.
fn least(touches: &[FrictionContact], here: &[usize], whole: [f64; 2]) -> Option<Vec<(usize, [f64; 2])>> {
    let (mut best, mut found) = (f64::INFINITY, None);
    for &at in here {
        let touch = &touches[at];
        // Without friction a contact has no tangent, and `whole` must be along its normal.
        let across = [-touch.normal[1], touch.normal[0]];
        let [p, f] = [-dot(touch.normal, whole), dot(across, whole)];
        if p < best * (1.0 - SAME) && f.abs() <= touch.friction * p {
            (best, found) = (p, Some(vec![(at, [p, f])]));
        }
    }
    // Along an edge of its cone the impulse of a contact is p (−n ± μ t).
    let edges = here.iter().flat_map(|&at| [-1.0, 1.0].map(|sign| (at, [1.0, sign * touches[at].friction])));
    let edges: Vec<(usize, [f64; 2])> = edges.collect();
    for (k, &(one, a)) in edges.iter().enumerate() {
        for &(two, b) in edges[k + 1..].iter().filter(|edge| edge.0 != one) {
            let [u, v] = [touches[one].push(a), touches[two].push(b)];
            let area = u[0] * v[1] - u[1] * v[0];
            let p = (whole[0] * v[1] - whole[1] * v[0]) / area;
            let q = (u[0] * whole[1] - u[1] * whole[0]) / area;
            if p >= 0.0 && q >= 0.0 && p + q < best * (1.0 - SAME) {
                (best, found) = (p + q, Some(vec![(one, a.map(|x| p * x)), (two, b.map(|x| q * x))]));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact of a body of 1 kg at this angle, with the impulse (p, f).
    fn touch(index: usize, degrees: f64, friction: f64, impulse: [f64; 2]) -> FrictionContact {
        let normal = [degrees.to_radians().cos(), degrees.to_radians().sin()];
        FrictionContact {
            index,
            rows: [0, 1],
            normal,
            tangent: if friction > 0.0 { [-normal[1], normal[0]] } else { [0.0; 2] },
            bound: 0.0,
            friction,
            compliance: 0.0,
            kinetic: friction,
            holding: friction,
            came: 0.0,
            own: [1.0, 0.0, 1.0],
            state: State::Stick,
            impulse,
            slides: 0.0,
        }
    }

    fn whole(touches: &[FrictionContact]) -> [f64; 2] {
        touches.iter().map(|touch| touch.push(touch.impulse)).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]])
    }

    #[test]
    fn no_other_impulses_of_the_same_sum_have_a_smaller_sum_of_pushes() {
        for (angle, friction) in [(120.0, 0.5), (150.0, 0.3), (80.0, 0.2), (60.0, 1.2)] {
            for k in 0..60 {
                // Pushes and shares of the limit that differ from one to the next.
                let [a, b, c, d] = [0.7, 1.3, 2.9, 4.1].map(|rate: f64| (rate * f64::from(k) + 0.3).sin());
                let first = touch(0, 0.0, friction, [1.0 + 0.9 * a, (1.0 + 0.9 * a) * friction * c]);
                let other = touch(1, angle, friction, [1.0 + 0.9 * b, (1.0 + 0.9 * b) * friction * d]);
                let mut touches = [first, other];
                let sum = whole(&touches);
                relieve(&mut touches, &[0.0; 2]);
                let found = whole(&touches);
                assert!((0..2).all(|i| (found[i] - sum[i]).abs() < 1e-12), "{sum:?} {found:?}");
                let slack = |touch: &FrictionContact| touch.friction * touch.impulse[0] - touch.impulse[1].abs();
                assert!(touches.iter().all(|touch| touch.impulse[0] >= 0.0 && slack(touch) > -1e-12), "{touches:?}");
                let pushes = touches[0].impulse[0] + touches[1].impulse[0];
                // All impulses of the first in steps of 1 %; those of the other follow.
                for (i, j) in (0..=300).flat_map(|i| (-20..=20).map(move |j| (i, j))) {
                    let p = f64::from(i) * 0.01;
                    let given = first.push([p, p * friction * f64::from(j) / 20.0]);
                    let rest = [sum[0] - given[0], sum[1] - given[1]];
                    let [q, f] = [-dot(other.normal, rest), dot(other.tangent, rest)];
                    assert!(q < 0.0 || f.abs() > friction * q || p + q > pushes - 1e-12, "{p} {q} {pushes}");
                }
            }
        }
    }

    #[test]
    fn without_friction_two_contacts_have_the_impulses_of_their_normals() {
        let both = [touch(0, 0.0, 0.0, [1.0, 0.0]), touch(1, 120.0, 0.0, [2.0, 0.0])];
        let mut touches = both;
        relieve(&mut touches, &[0.0; 2]);
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-15 && a[1] == b[1];
        assert!(touches.iter().zip(both).all(|(found, given)| near(found.impulse, given.impulse)), "{touches:?}");
    }

    #[test]
    fn a_body_that_moves_or_touches_one_wall_only_keeps_its_impulses() {
        let both = [touch(0, 0.0, 0.5, [1.0, 0.2]), touch(1, 120.0, 0.5, [2.0, -0.3])];
        for y in [[1e-3, 0.0], [0.0, -1e-3]] {
            let mut touches = both;
            relieve(&mut touches, &y);
            assert_eq!(touches.map(|touch| touch.impulse), [[1.0, 0.2], [2.0, -0.3]]);
        }
        let mut apart = [both[0], FrictionContact { rows: [2, 3], ..both[1] }];
        relieve(&mut apart, &[0.0; 4]);
        assert_eq!(apart.map(|touch| touch.impulse), [[1.0, 0.2], [2.0, -0.3]]);
    }

    #[test]
    fn a_rebound_along_another_flat_is_one_to_which_friction_adds_energy() {
        // Along the flat at 120° into that at 0°, and back at half the speed: friction of 0.5 that
        // opposes the way back asks for pushes of 10.03 and 9.36, and works for the motion.
        let (p, q) = (10.030_769_230_769, 9.358_974_358_974);
        let touches = [touch(0, 0.0, 0.5, [p, 0.5 * p]), touch(1, 120.0, 0.5, [q, -0.5 * q])];
        let along = [60_f64.to_radians().sin(), 0.5];
        assert!(gains(&touches, (&along, &along.map(|v| -1.5 * v)), 1e-9));
        // Stopped with the least pushes.
        let mut stopped = touches;
        let stop = [-along[0], -along[1]];
        let found = least(&touches, &[0, 1], stop).unwrap();
        found.iter().for_each(|(at, impulse)| stopped[*at].impulse = *impulse);
        assert!(!gains(&stopped, (&along, &stop), 1e-9));
    }
}
