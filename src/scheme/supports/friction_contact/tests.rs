//! The answer of one contact alone, and which coefficient of friction it has.

use super::*;
use crate::linear::{Factor, Symmetric};
use crate::scene::Row;

/// The contact of a mass matrix [[2, 0.9], [0.9, 1]] with a flat in the direction of `normal`.
fn one(normal: [f64; 2], friction: f64) -> (ContactRows, FrictionContact) {
    let mass = Symmetric::from_entries(2, [(0, 0, 2.0), (0, 1, 0.9), (1, 1, 1.0)]);
    let rows = [Row::dof(0), Row::dof(1)];
    let places = ContactRows::new(2, &[&rows[0], &rows[1]], &mut Factor::new(&mass).unwrap());
    let touch = FrictionContact::new(&places, (0, [0, 1]), (normal, 0.0), (friction, 0.0));
    (places, touch)
}

#[test]
fn the_answer_obeys_the_law_in_every_state() {
    let mut seen = [0; 4];
    for k in 0..2000 {
        // Directions, friction and velocities that cover all states.
        let turn = 0.37 * f64::from(k);
        let normal = [turn.cos(), turn.sin()];
        let friction = 0.05 * f64::from(k % 9);
        let (places, mut touch) = one(normal, friction);
        let mut y = vec![(1.3 * turn).sin(), (2.1 * turn).cos()];
        let (_, answered) = touch.answer(&places, &mut y);
        assert!(answered, "{touch:?}");
        let (n, t) = (dot(normal, y.clone().try_into().unwrap()), y[1] * normal[0] - y[0] * normal[1]);
        let [p, f] = touch.impulse;
        // Some roundings of velocities near 1 m/s and of compliances near 5 1/kg.
        let rounding = 1e-14;
        assert!(p >= 0.0 && n <= rounding && (p * n).abs() <= rounding, "{touch:?}: {n}");
        assert!(f.abs() <= friction * p + rounding, "{touch:?}");
        assert!((friction * p + f * t.signum()).min(t.abs()) <= rounding || p == 0.0, "{touch:?}: {t}");
        assert!(touch.holds(&y, rounding), "{touch:?}");
        seen[touch.state as usize] += 1;
        // Answered again, nothing changes.
        assert!(touch.answer(&places, &mut y).0 <= rounding);
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

#[test]
fn a_guess_is_the_state_of_the_answer_whatever_the_impulse_was() {
    for k in 0..2000 {
        let turn = 0.37 * f64::from(k);
        let (places, mut touch) = one([turn.cos(), turn.sin()], 0.1 * f64::from(k % 9));
        // Velocities without the contact, and an impulse that it may have.
        let mut y = vec![(1.3 * turn).sin(), (2.1 * turn).cos()];
        let (_, mut fresh) = one(touch.normal, touch.friction);
        fresh.answer(&places, &mut y.clone());
        let rubs = f64::from(u8::from(touch.friction > 0.0));
        touch.impulse = [(0.7 * turn).sin(), rubs * (1.7 * turn).cos()];
        places.add(touch.rows, touch.push(touch.impulse), &mut y);
        assert_eq!(touch.guess(&y), fresh.state, "{touch:?}");
    }
}

#[test]
fn which_coefficient_a_contact_has_follows_from_what_it_did_and_does() {
    let both = FrictionCoefficients { sticking: 0.5, sliding: 0.2 };
    let (_, touch) = one([1.0, 0.0], both.sticking);
    // What it did, and one answer after the other with a push of 1 N s: state and friction
    // impulse, and the coefficient and whether it changed after that.
    for (did, answers) in [
        (State::Open, &[(State::Stick, 0.1, 0.2, false)][..]),
        (State::Open, &[(State::Ahead, -0.2, 0.2, false)]),
        (State::Stick, &[(State::Stick, 0.4, 0.5, false)]),
        // A slide begins; a stop in the same step is one with kinetic friction.
        (State::Stick, &[(State::Back, 0.5, 0.2, true), (State::Stick, 0.1, 0.2, false)]),
        (State::Ahead, &[(State::Ahead, -0.2, 0.2, false)]),
        (State::Ahead, &[(State::Stick, -0.1, 0.2, false)]),
        // It turns, and is held, or slides back all the same.
        (State::Ahead, &[(State::Back, 0.2, 0.5, true), (State::Stick, 0.4, 0.5, false)]),
        (State::Back, &[(State::Ahead, -0.2, 0.5, true), (State::Stick, -0.4, 0.5, false)]),
        (State::Ahead, &[(State::Back, 0.2, 0.5, true), (State::Back, 0.5, 0.2, true), (State::Back, 0.2, 0.2, false)]),
        // Held by what it would have been pushed on with.
        (State::Ahead, &[(State::Back, 0.2, 0.5, true), (State::Stick, -0.4, 0.2, true)]),
    ] {
        let mut touch = touch.after(both, did);
        for &(state, f, friction, changes) in answers {
            (touch.state, touch.impulse) = (state, [1.0, f]);
            let y = [0.0, state.sign()];
            assert_eq!((touch.changes_friction(&y, 1e-9), touch.friction), (changes, friction), "{did:?} {state:?}");
        }
    }
    // Without kinetic friction the velocity tells which way it slides.
    let mut touch = touch.after(FrictionCoefficients { sliding: 0.0, ..both }, State::Ahead);
    (touch.state, touch.impulse) = (State::Ahead, [1.0, 0.0]);
    let mut changes = |along: f64| touch.changes_friction(&[0.0, along], 1e-9);
    assert!(!changes(0.1) && changes(-0.1) && touch.friction == 0.5);
    // At its limit, and held by others: it sticks.
    let mut touch = touch.after(both, State::Stick);
    (touch.state, touch.impulse) = (State::Ahead, [1.0, -0.5]);
    assert!(!touch.changes_friction(&[0.0, 1e-10], 1e-9) && touch.state == State::Stick && touch.friction == 0.5);
}

#[test]
fn a_state_is_known_by_the_velocity_and_the_push() {
    for (friction, p, t, state) in [
        (0.5, 0.0, 0.0, State::Open),
        (0.5, 1.0, 1e-9, State::Stick),
        (0.5, 1.0, 1e-6, State::Ahead),
        (0.5, 1.0, -1e-6, State::Back),
        (0.0, 1.0, 1e-9, State::Ahead),
    ] {
        let (_, mut touch) = one([1.0, 0.0], 0.5);
        (touch.friction, touch.impulse) = (friction, [p, 0.0]);
        touch.recognise(&[0.0, t], 1e-8);
        assert_eq!(touch.state, state, "{friction} {p} {t}");
    }
}

#[test]
fn the_size_of_an_answer_counts_both_parts_of_the_impulse() {
    // The inverse of the mass matrix is [[1, −0.9], [−0.9, 2]]/1.19.
    let form = |x: [f64; 2]| (x[0] * x[0] - 1.8 * x[0] * x[1] + 2.0 * x[1] * x[1]) / 1.19;
    for k in 0..50 {
        let turn = 0.37 * f64::from(k);
        let (places, mut touch) = one([turn.cos(), turn.sin()], 0.4);
        let (size, _) = touch.answer(&places, &mut [(1.3 * turn).sin(), (2.1 * turn).cos()]);
        let [p, f] = touch.impulse;
        let both = form(touch.normal) * p.abs() + form(touch.tangent) * f.abs();
        // Some roundings of a few m/s.
        assert!((size - both).abs() < 1e-14, "{touch:?}: {size} {both}");
    }
}

#[test]
fn a_body_that_does_not_approach_gets_no_impulse_however_it_slides() {
    for k in 0..100 {
        let turn = 0.37 * f64::from(k);
        let (_, touch) = one([turn.cos(), turn.sin()], 0.5 * f64::from(k % 9));
        for n in [0.0, -0.1] {
            assert_eq!(touch.alone(n, (2.1 * turn).cos()), (Some(State::Open), [0.0; 2]), "{touch:?}");
        }
    }
}

#[test]
fn where_no_state_answers_the_push_is_that_without_friction() {
    // No mass has this response, whose determinant is below 0: at t = 0 the four states fail,
    // stick at p = −1/12, slip ahead at t·ẇ⁺ = −1, slip back at p = −1/4.
    let (_, touch) = one([1.0, 0.0], 1.0);
    let touch = FrictionContact { own: [4.0, 8.0, 4.0], ..touch };
    assert_eq!(touch.alone(1.0, 0.0), (None, [0.25, 0.0]));
}

#[test]
fn a_state_holds_within_the_noise_and_no_farther() {
    for [a, c] in [[1e-3, 1e3], [1e3, 1e-3]] {
        for noise in [1e-9, 1e-3] {
            let (_, touch) = one([1.0, 0.0], 0.5);
            let touch = FrictionContact { own: [a, 0.0, c], bound: 0.0, ..touch };
            let holds = |state: State, impulse: [f64; 2], y: [f64; 2]| {
                FrictionContact { state, impulse, ..touch }.holds(&y, noise)
            };
            let (less, more) = (0.5 * noise, 2.0 * noise);
            let press = 1.0;
            for state in [State::Stick, State::Ahead, State::Back] {
                assert!(holds(state, [press, 0.0], [0.0; 2]), "{state:?}");
                assert!(!holds(state, [-more / a, 0.0], [0.0; 2]), "{state:?}");
                assert!(holds(state, [press, 0.0], [less, 0.0]) && holds(state, [press, 0.0], [-less, 0.0]));
                assert!(!holds(state, [press, 0.0], [more, 0.0]) && !holds(state, [press, 0.0], [-more, 0.0]));
            }
            assert!(holds(State::Open, [0.0; 2], [less, 7.0]) && !holds(State::Open, [0.0; 2], [more, 7.0]));
            // It sticks with up to half of the push, and moves along with the side of its slip.
            assert!(holds(State::Stick, [press, 0.5 + less / c], [0.0; 2]));
            assert!(!holds(State::Stick, [press, -0.5 - more / c], [0.0; 2]));
            assert!(!holds(State::Stick, [press, 0.0], [0.0, more]));
            for (state, sign) in [(State::Ahead, 1.0), (State::Back, -1.0)] {
                assert!(holds(state, [press, 0.0], [0.0, sign]) && holds(state, [press, 0.0], [0.0, -sign * less]));
                assert!(!holds(state, [press, 0.0], [0.0, -sign * more]), "{state:?}");
                assert!(holds(state, [-less / a, 0.0], [0.0; 2]), "{state:?}");
            }
        }
    }
}
