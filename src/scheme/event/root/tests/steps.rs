//! Steps towards a root, from a root, and in other units.

use super::*;

#[test]
fn a_window_far_longer_than_the_way_to_the_root_does_not_shorten_the_step() {
    // The start of a transient of 20 µs; its root is 0.26 µs away.
    let below = Below {
        c: [8e-12, -3.1e-5, -102.0, 5.08e6],
        fourth: -2.53e11,
        bound: 2.54e11,
        noise: [1.8e-19, 1.8e-18, 1.3e-11, 6.6e-7],
        passes_touch: false,
    };
    for window in [1e-6, 1e-3, 0.15, 1e3] {
        let (Step::Root(s) | Step::Touch(s) | Step::Free(s)) = below.step(window) else { panic!("{window}") };
        assert!(s > 1e-7 && s < 3e-7, "{window}: {s:e}");
    }
}

#[test]
fn a_step_is_a_root_only_where_all_functions_of_the_family_are_0_to_rounding() {
    let mut draws = Draws::new(5, 5);
    let (mut roots, mut free) = (0, 0);
    for _ in 0..4000 {
        let (c, root, noise) = draws.noisy();
        // At the root the bound allows between a quarter and four times the noise, or more.
        let bound = c[4].abs().max(draws.size(2.0) * 24.0 * noise / root.powi(4));
        let w = root * (1.0 + draws.size(6.0));
        let what = format!("{c:?} {root} {w} {noise:e} {bound}");
        match below(&c, bound, noise).step(w) {
            // The lowest function is within the noise of 0, this one at most twice the noise above;
            // where the slope is small before the root, that is some way before it.
            Step::Root(s) => {
                roots += 1;
                assert!(value(&c, s).0.abs() <= 3.1 * noise, "{what}: {s}");
                assert!(s >= 0.9 * root && s <= root + 4.0 * noise / later(&c, root)[1].abs(), "{what}: {s}");
            }
            // A minimum of at most four times the noise, by a parabola.
            Step::Touch(s) => assert!(value(&c, s).0.abs() <= 5.0 * noise, "{what}: touches at {s}"),
            Step::Free(s) => {
                free += 1;
                // The bound's part is more than the noise.
                assert!(bound * s.powi(4) > 23.9 * noise && s <= root + late(&c, root), "{what}: {s}");
            }
            Step::Now => panic!("{what}"),
        }
    }
    assert!(roots > 500 && free > 500, "{roots} {free}");
    // A straight line needs no noise.
    assert_eq!(below(&[1.0, -0.5, 0.0, 0.0, 0.0], 0.0, 0.0).step(3.0), Step::Root(2.0));
}

#[test]
fn a_root_is_reached_in_few_steps() {
    let mut draws = Draws::new(5, 6);
    let mut all = 0;
    for _ in 0..4000 {
        let (c, root, noise) = draws.noisy();
        let (bound, w) = (c[4].abs() * (1.0 + draws.size(3.0)), root * (1.0 + draws.size(3.0)));
        let (mut t, mut ended) = (0.0, false);
        for _ in 0..10 {
            all += 1;
            match below(&later(&c, t), bound, noise).step(w) {
                Step::Free(s) => t += s,
                Step::Root(s) | Step::Touch(s) => (t, ended) = (t + s, true),
                Step::Now => ended = true,
            }
            if ended {
                break;
            }
        }
        let what = format!("{c:?} {root} {w} {noise:e} {bound}");
        // The noise, or four times that at a touch, and what a parabola differs from g.
        assert!(ended && value(&c, t).0.abs() <= 5.0 * noise, "{what}: {t}");
        assert!(t <= root + 4.0 * noise / later(&c, root)[1].abs(), "{what}: {t}");
    }
    // Two and a half each, on average.
    assert!(all < 10000, "{all}");
}

#[test]
fn from_a_root_the_next_one_is_not_passed_whatever_its_multiplicity() {
    let mut draws = Draws::new(5, 9);
    let mut tried = [0; 4];
    for _ in 0..6000 {
        // u, u² or u³ times a polynomial whose first root is known.
        let multiplicity = 1 + draws.between(0.0, 3.0) as usize;
        let (tail, root) = draws.known(4 - multiplicity);
        let mut c = [0.0; 5];
        for n in multiplicity..5 {
            c[n] = tail[n - multiplicity] / factorial(n - multiplicity) * factorial(n);
        }
        if c[4] > 0.0 {
            continue;
        }
        tried[multiplicity] += 1;
        let share = if draws.chance(0.5) { 0.0 } else { 1e-12 };
        let noise = [0, 1, 2, 3].map(|n| share * later(&c, root)[n].abs().max(c[n].abs()));
        let mut g = Below { noise, passes_touch: draws.chance(0.5), ..below(&c, -c[4], 0.0) };
        g.c[0] = draws.between(-1.0, 1.0) * noise[0];
        let w = root * draws.size(6.0);
        let what = format!("{c:?} {root} {w}");
        let Step::Free(s) = g.step(w) else { panic!("{what}") };
        // A bound is enough here: the next step is from a point between two roots. It is most of
        // the way, though.
        assert!(s >= 0.6 * root.min(w) && s <= w && s <= root + late(&c, root), "{what}: {s}");
        assert_eq!(Below { c: g.c.map(|c| -c), ..g }.step(w), Step::Now, "{what}");
    }
    assert!(tried[1..].iter().all(|n| *n > 500), "{tried:?}");
}

#[test]
fn a_function_of_which_all_is_0_but_the_fourth_derivative_goes_where_that_goes() {
    let g = below(&[0.0; 5], 3.0, 0.0);
    assert_eq!(g.step(2.0), Step::Free(2.0));
    assert_eq!(Below { fourth: -1.0, ..g }.step(2.0), Step::Now);
    for fourth in [0.5, 1.0, 3.0] {
        // The root of fourth·u⁴/24 − 2·bound·u⁵/(120 w), whose fourth derivative falls by twice the
        // bound in a window.
        let root = 5.0 * fourth * 2.0 / (2.0 * 3.0);
        let Step::Free(s) = (Below { fourth, ..g }).step(2.0) else { panic!("{fourth}") };
        assert!(s <= 2.0 && s < root && s >= 0.3 * root.min(2.0), "{fourth}: {s} of {root}");
    }
    assert_eq!(Below { fourth: 1.0, bound: 0.0, ..g }.step(2.0), Step::Free(2.0));
}

#[test]
fn a_function_below_0_may_rise_and_at_its_touch_it_may_pass() {
    let noise = [1e-3, 1e-4, 1e-5, 1e-6];
    for (c0, c1, passes_touch, now) in [
        // Deeper than the noise it is an event, unless it rises.
        (-2e-3, 0.0, false, true),
        (-2e-3, 1.0, false, false),
        // Where a touch is none, deeper than four times the noise.
        (-2e-3, 0.0, true, false),
        (-9e-3, 0.0, true, true),
        (-9e-3, 1.0, true, true),
        (-0.5e-3, 0.0, false, false),
    ] {
        let g = Below { c: [c0, c1, 1.0, 0.0], fourth: 0.0, bound: 1.0, noise, passes_touch };
        assert_eq!(g.step(0.5), if now { Step::Now } else { Step::Free(0.5) }, "{g:?}");
    }
}

#[test]
fn letting_go_forgives_what_is_rounding() {
    let noise = [1e-3, 1e-4, 1e-5, 1e-6];
    // As far as a step would start from 0, and for an acceleration of less than 16 times its noise.
    for (c0, c2, forgiven) in [
        (1e-3, -1e-4, true),
        (-1e-3, -1e-4, true),
        (1e-3, -2e-4, false),
        (1e-3, -1.0, false),
        (2e-3, -1e-4, false),
        (-1e-3, 1.0, true),
    ] {
        let c = [c0, -1e-4, c2, 1.0];
        let mut g = Below { c, fourth: 0.0, bound: 0.0, noise, passes_touch: false };
        g.set_aside();
        assert_eq!(g.c, if forgiven { [c0.max(0.0), 0.0, c2.max(0.0), 1.0] } else { c }, "{c0} {c2}");
        assert_ne!(g.step(0.1) == Step::Now, forgiven || c0 > 1e-3, "{c0} {c2}");
    }
}

#[test]
fn steps_do_not_depend_on_the_units() {
    let mut draws = Draws::new(5, 10);
    for _ in 0..4000 {
        let (mut c, b, w) = draws.polynomial();
        let share = draws.between(-40.0, 0.0).exp2();
        let noise = c.map(|c| share * c.abs());
        if draws.chance(0.5) {
            c[0] = noise[0] * draws.between(-5.0, 1.0);
        }
        let g = Below { c, fourth: draws.number(3.0), bound: b, noise, passes_touch: draws.chance(0.5) };
        // Powers of two, which change no rounding.
        let (length, time) = (draws.between(-9.0, 9.0).round().exp2(), draws.between(-9.0, 9.0).round().exp2());
        let rate = |n: usize| length / time.powi(n as i32);
        let other = Below {
            c: [0, 1, 2, 3].map(|n| c[n] * rate(n)),
            fourth: g.fourth * rate(4),
            bound: b * rate(4),
            noise: [0, 1, 2, 3].map(|n| noise[n] * rate(n)),
            passes_touch: g.passes_touch,
        };
        let scaled = match g.step(w) {
            Step::Now => Step::Now,
            Step::Root(s) => Step::Root(s * time),
            Step::Touch(s) => Step::Touch(s * time),
            Step::Free(s) => Step::Free(s * time),
        };
        assert_eq!(other.step(w * time), scaled, "{g:?} {w} {length} {time}");
    }
}
