//! What Clarabel finds, before Newton's method makes it exact.

use super::super::norm;
use super::super::tests::{Case, Draws, Units};
use super::*;

/// The system of a case, released under its bounds, unless these allow the free motion.
fn released(case: &Case) -> Option<(System, Vec<f64>)> {
    let mut system = System::new(&case.problem).expect("a definite matrix");
    let mut x = vec![0.0; case.b.len()];
    system.release(&case.b, &mut x);
    (!system.is_free(&case.bounds)).then_some((system, x))
}

#[test]
fn the_multipliers_found_solve_the_programme_and_name_the_blocks_in_play_in_any_units() {
    let (mut circles, mut lows, mut highs, mut open) = (0, 0, 0, 0);
    for seed in 0..60 {
        let case = Case::random(&mut Draws::new(11, 2000 + seed), 4, None);
        let mut known: Option<Vec<State>> = None;
        for units in Units::all() {
            let case = case.in_units(units);
            let Some((mut system, mut x)) = released(&case) else { continue };
            let iterations = find(&case.problem, &mut system).expect("a solution");
            assert!((1..100).contains(&iterations), "{seed}: {iterations}");
            system.respond(&mut x);
            let miss = case.miss(&x, &system.r);
            // Clarabel stops at 1e-10 of the objective, which leaves its root in the motion.
            assert!(miss < 1e-4, "{seed}, {units:?}: {miss:e}");
            for (block, state) in system.states.iter().enumerate() {
                let push = system.push(block);
                match (state, &case.bounds[block]) {
                    (State::Free, _) => {
                        open += 1;
                        assert_eq!(push, [0.0; 2], "{seed}, {units:?}: {block}");
                    }
                    (State::Circle, DiskBound::Disk { radius, .. }) => {
                        circles += 1;
                        let mu = norm(push) / radius;
                        assert!((system.mu[block] / mu - 1.0).abs() < 1e-12, "{seed}, {units:?}: {block}");
                    }
                    (State::Low | State::High, DiskBound::Strip { normal, .. }) => {
                        let low = *state == State::Low;
                        *(if low { &mut lows } else { &mut highs }) += 1;
                        assert_eq!(dot(*normal, push) > 0.0, low, "{seed}, {units:?}: {block}");
                    }
                    other => panic!("{seed}, {units:?}: {other:?}"),
                }
            }
            let known = known.get_or_insert_with(|| system.states.clone());
            assert_eq!(*known, system.states, "{seed}, {units:?}");
        }
    }
    assert!(circles > 100 && lows > 10 && highs > 10 && open > 50, "{circles} {lows} {highs} {open}");
}

#[test]
fn a_free_motion_that_violates_nothing_is_refused() {
    let mut case = Case::random(&mut Draws::new(11, 3), 1, None);
    let wide = || DiskBound::Disk { centre: [0.0; 2], radius: 1e3 };
    case.bounds.iter_mut().for_each(|bound| *bound = wide());
    let mut system = System::new(&case.problem).expect("a definite matrix");
    system.release(&case.b, &mut vec![0.0; case.b.len()]);
    assert!(system.is_free(&case.bounds));
    let failure = find(&case.problem, &mut system).expect_err("nothing to do");
    assert_eq!(failure, Failure::NotSolved { status: "no violation to scale by" });
}

#[test]
fn the_two_blocks_that_weigh_most_in_a_certificate_are_named() {
    let named = |certificate: &[(usize, f64)]| {
        let line = |&(block, _): &(usize, f64)| ConeRow { block, along: [0.0; 2], bound: 0.0 };
        let lines: Vec<ConeRow> = certificate.iter().map(line).collect();
        match apart(&lines, &certificate.iter().map(|entry| entry.1).collect::<Vec<_>>()) {
            Failure::Infeasible { row, against } => [row, against],
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(named(&[(0, 5.0), (1, 3.0), (2, -4.0)]), [0, 2]);
    assert_eq!(named(&[(0, 5.0), (1, 4.0), (2, 1.0)]), [0, 1]);
    assert_eq!(named(&[(0, 1.0), (1, 2.0), (2, 3.0), (3, 4.0)]), [3, 2]);
    // Of the lines of a block the heaviest counts.
    assert_eq!(named(&[(0, 2.0), (1, 4.0), (0, -6.0)]), [0, 1]);
    assert_eq!(named(&[(0, 2.0), (0, 1.0), (1, 4.0), (1, 0.0)]), [1, 0]);
    // A block alone is apart from itself, whatever weighs nothing.
    assert_eq!(named(&[(0, 0.0), (1, 3.0)]), [1, 1]);
    assert_eq!(named(&[(1, 3.0), (0, 0.0)]), [1, 1]);
}
