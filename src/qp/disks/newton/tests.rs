//! The step of Newton's method near the solution.

use super::super::DiskSolver;
use super::super::tests::{Case, Draws};
use super::*;

/// A regular programme at its solution: the states and μ of its blocks.
fn solved(case: &Case) -> Option<System> {
    let mut solver = DiskSolver::new(case.problem.clone(), 1.0).expect("a sound programme");
    let multiplier = solver.solve(&case.b, &case.bounds).expect("a solution").multiplier.clone();
    let mut system = System::new(&case.problem).expect("a definite matrix");
    system.release(&case.b, &mut vec![0.0; case.b.len()]);
    if system.is_free(&case.bounds) {
        return None;
    }
    system.r.copy_from_slice(&multiplier);
    for block in 0..case.bounds.len() {
        let push = system.push(block);
        (system.states[block], system.mu[block]) = match case.bounds[block] {
            _ if norm(push) == 0.0 => (State::Free, 0.0),
            DiskBound::Disk { radius, .. } => (State::Circle, norm(push) / radius),
            DiskBound::Strip { normal, .. } if dot(normal, push) > 0.0 => (State::Low, 0.0),
            DiskBound::Strip { .. } => (State::High, 0.0),
        };
    }
    Some(system)
}

#[test]
fn a_step_squares_the_distance_from_the_solution() {
    let (mut together, mut beside_strips) = (0, 0);
    for seed in 0..300 {
        let mut draws = Draws::new(11, 4000 + seed);
        let case = Case::random(&mut draws, 6, None);
        let Some(mut system) = solved(&case) else { continue };
        let disks = system.states.iter().filter(|state| **state == State::Circle).count();
        if disks == 0 {
            continue;
        }
        together += u32::from(disks > 2);
        beside_strips += u32::from(system.states.iter().any(|state| matches!(state, State::Low | State::High)));
        system.mu.iter_mut().for_each(|mu| *mu *= 1.0 + 1e-5 * draws.between(-1.0, 1.0));
        let mut newton = Newton::default();
        newton.hold(&mut system);
        let before = system.miss().distance;
        assert!(newton.climb(&mut system), "{seed}: no disk leaves");
        newton.hold(&mut system);
        let after = system.miss().distance;
        // The curvature of 1/|z| over its slope squared is some tens; a step that is off by a
        // hundredth leaves more than 1e3 times the square of what a change by 1e-5 brings.
        assert!(before > 1e-12 && after < 1e3 * before * before + 1e-13, "{seed}: {before:e}, {after:e}");
    }
    assert!(together > 30 && beside_strips > 50, "{together}, {beside_strips}");
}

#[test]
fn each_step_counts() {
    let mut counted = 0;
    for seed in 0..20 {
        let case = Case::random(&mut Draws::new(11, 4000 + seed), 6, None);
        let Some(mut system) = solved(&case) else { continue };
        let mut newton = Newton::default();
        assert!(newton.settle(&mut system), "{seed}");
        // From the solution, at most until it stalls.
        assert!((1..=7).contains(&newton.steps), "{seed}: {}", newton.steps);
        counted += 1;
    }
    assert!(counted > 10, "{counted}");
}
