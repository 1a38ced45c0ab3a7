//! The forces are those of the laws, each iteration solves the linear problem that it is made for,
//! and a line search ends near the minimum of the function that it searches.

use super::super::matrices::Matrices;
use super::*;
use crate::hash::{mix, unit};
use crate::linear::Symmetric;
use crate::scene::{Row, Scene, Structure, Wall};

/// From −1 to 1, the same in every run.
fn draw(stream: u64, index: usize) -> f64 {
    2.0 * unit(mix(11, stream, index as u64)) - 1.0
}

/// The solution of a linear system by elimination with the largest pivot of each column.
fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in (0..n).filter(|&i| i != k) {
            let factor = a[i][k] / a[k][k];
            (0..n).for_each(|j| a[i][j] -= factor * a[k][j]);
            b[i] -= factor * b[k];
        }
    }
    (0..n).map(|k| b[k] / a[k][k]).collect()
}

/// `m` walls behind rows of random weights on `n` coupled masses, and S computed column by column:
/// gᵢ M⁻¹ gⱼ times `scale`.
fn problem(stream: u64, (m, n): (usize, usize), scale: f64) -> (ForceLawSolver, Vec<Vec<f64>>) {
    let couple = |i: usize, j: usize| 0.3 * draw(stream, 100 + i * n + j);
    let mass: Vec<Vec<f64>> = (0..n)
        .map(|i| (0..n).map(|j| if i == j { 2.0 + draw(stream, i) } else { couple(i.max(j), i.min(j)) }).collect())
        .collect();
    let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let matrix = Symmetric::from_entries(n, lower.map(|(i, j)| (i, j, mass[i][j])));
    let rows: Vec<Vec<f64>> = (0..m).map(|w| (0..n).map(|i| draw(stream, 200 + w * n + i)).collect()).collect();
    let mut scene =
        Scene::structure(Structure { mass: matrix, damping: Symmetric::zeros(n), stiffness: Symmetric::zeros(n) });
    for (w, row) in rows.iter().enumerate() {
        let at = Row::new(row.iter().copied().enumerate().collect());
        scene = scene.with_wall(Wall::upper(&format!("w{w}"), 1.0).at(at));
    }
    let body = Body::<Matrices>::new(&scene, 1e-3).unwrap();
    let mut factor = Matrices::factor(&body.theta_matrix(0.5)).unwrap();
    let walls = ForceLawSolver::new(&mut factor, &body, scale);
    let answers: Vec<Vec<f64>> = rows.iter().map(|row| solved(mass.clone(), row.clone())).collect();
    let seen = |i: usize, j: usize| scale * rows[i].iter().zip(&answers[j]).map(|(g, x)| g * x).sum::<f64>();
    let s = (0..m).map(|i| (0..m).map(|j| seen(i, j)).collect()).collect();
    (walls, s)
}

/// I + D S.
fn condensed(s: &[Vec<f64>], slope: &[f64]) -> Vec<Vec<f64>> {
    let entry = |i: usize, j: usize| f64::from(u8::from(i == j)) + slope[i] * s[i][j];
    (0..slope.len()).map(|i| (0..slope.len()).map(|j| entry(i, j)).collect()).collect()
}

/// Slopes of which some are 0.
fn slopes(stream: u64, m: usize, largest: f64) -> Vec<f64> {
    (0..m).map(|i| (largest * draw(stream, 300 + i)).max(0.0)).collect()
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(1e-9, |size: f64, x| size.max(x.abs()));
    for (found, expected) in found.iter().zip(expected) {
        // Rounding of eliminations whose matrices have condition numbers of some 1e3.
        assert!((found - expected).abs() <= 1e-11 * size, "{found:e}, expected {expected:e}");
    }
}

#[test]
fn each_wall_is_moved_by_the_force_of_another_as_the_masses_let_it() {
    for stream in 0..20 {
        let m = 1 + stream as usize % 5;
        let (walls, s) = problem(stream, (m, 4), 0.25);
        for (i, row) in s.iter().enumerate() {
            assert_near(&walls.s[i * m..(i + 1) * m], row);
            assert!((0..m).all(|j| walls.s[i * m + j].to_bits() == walls.s[j * m + i].to_bits()));
        }
    }
}

#[test]
fn linear_laws_are_met_by_one_iteration_and_a_change_is_answered_to_first_order() {
    for stream in 0..200 {
        let m = 1 + stream as usize % 6;
        // Fewer masses than walls too: S is then singular.
        let (mut walls, s) = problem(stream, (m, 1 + stream as usize % 4), 0.5);
        let (slope, constant) = (slopes(stream, m, 20.0), |i: usize| draw(stream, 400 + i));
        let free: Vec<f64> = (0..m).map(|i| draw(stream, 500 + i)).collect();
        walls.free.copy_from_slice(&free);
        let law = |i: usize, y: f64| LawResponse { force: constant(i) - slope[i] * y, slope: slope[i], noise: 0.0 };
        walls.solve(law).unwrap();
        // r + D S r = c − D y₀.
        let expected = solved(condensed(&s, &slope), (0..m).map(|i| constant(i) - slope[i] * free[i]).collect());
        assert_near(&walls.force, &expected);
        // One iteration solves it, the next finds so; its rounding may take another.
        assert!((2..=3).contains(&walls.iterations), "{} iterations", walls.iterations);
        // The forces of a y that is made 1e-6 beside the one found: r + D S r = c − D (y₀ +
        // change).
        let change: Vec<f64> = (0..m).map(|i| 1e-6 * draw(stream, 600 + i)).collect();
        let moved = |i: usize| constant(i) - slope[i] * (free[i] + change[i]);
        let expected = solved(condensed(&s, &slope), (0..m).map(moved).collect());
        walls.refine(&walls.y.iter().zip(&change).map(|(y, change)| y + change).collect::<Vec<_>>());
        assert_near(&walls.guess, &expected);
    }
}

#[test]
fn springs_that_only_push_carry_what_the_one_consistent_choice_of_contacts_carries() {
    for stream in 0..300 {
        let m = 1 + stream as usize % 5;
        let (mut walls, s) = problem(stream, (m, 4), 1.0);
        let stiff: Vec<f64> = (0..m).map(|i| (6.0 * draw(stream, 700 + i)).exp2()).collect();
        let free: Vec<f64> = (0..m).map(|i| draw(stream, 500 + i)).collect();
        walls.free.copy_from_slice(&free);
        let law = |i: usize, y: f64| LawResponse {
            force: stiff[i] * (-y).max(0.0),
            slope: if y < 0.0 { stiff[i] } else { 0.0 },
            noise: 0.0,
        };
        walls.solve(law).unwrap();
        let consistent = (0..1_u32 << m).find_map(|active| {
            let slope: Vec<f64> = (0..m).map(|i| if (active >> i) & 1 == 1 { stiff[i] } else { 0.0 }).collect();
            let force = solved(condensed(&s, &slope), (0..m).map(|i| -slope[i] * free[i]).collect());
            let y = |i: usize| free[i] + (0..m).map(|j| s[i][j] * force[j]).sum::<f64>();
            (0..m).all(|i| (y(i) < 0.0) == (slope[i] > 0.0)).then_some(force)
        });
        assert_near(&walls.force, &consistent.expect("contacts"));
        // Each iteration changes which walls touch; there are 2⁵ choices at most.
        assert!(walls.iterations < 20, "{} iterations", walls.iterations);
    }
}

#[test]
fn a_correction_makes_no_wall_pull_and_the_others_carry_what_it_carried() {
    let mut released = 0;
    for stream in 0..300 {
        let m = 2 + stream as usize % 4;
        let (mut walls, s) = problem(stream, (m, 4), 1.0);
        let stiff: Vec<f64> = (0..m).map(|i| (6.0 * draw(stream, 700 + i)).exp2()).collect();
        // All walls push, and all but the first keep on.
        let pushing: Vec<f64> = (0..m).map(|i| if i == 0 { 1e-9 } else { 2.0 + draw(stream, 500 + i) }).collect();
        let y: Vec<f64> = pushing.iter().zip(&stiff).map(|(force, stiff)| -force / stiff).collect();
        for (free, (y, row)) in walls.free.iter_mut().zip(y.iter().zip(&s)) {
            *free = y - row.iter().zip(&pushing).map(|(s, force)| s * force).sum::<f64>();
        }
        let free = walls.free.clone();
        let law = |i: usize, y: f64| LawResponse {
            force: stiff[i] * (-y).max(0.0),
            slope: if y < 0.0 { stiff[i] } else { 0.0 },
            noise: 0.0,
        };
        walls.solve(law).unwrap();
        let away = |i: usize| if i == 0 { 1e-6 } else { 0.0 };
        let made: Vec<f64> = (0..m).map(|i| walls.y[i] + away(i)).collect();
        walls.refine(&made);
        let slope: Vec<f64> = (0..m).map(|i| if i == 0 { 0.0 } else { stiff[i] }).collect();
        assert_near(&walls.guess, &solved(condensed(&s, &slope), (0..m).map(|i| -slope[i] * free[i]).collect()));
        released += u32::from(walls.guess[0] == 0.0);
    }
    assert_eq!(released, 300);
}

#[test]
fn stiff_walls_on_one_row_share_a_force_that_rounding_divides_without_pulling() {
    // A body of 1.45 kg, deep in two damped springs at once: at the velocity y, of 1e6 m/s, the
    // second alone can give 2e7 N, and y is known to 1e-10 m/s, 1e-10 · 6e24 N of the first.
    let s = 0.0583;
    let mut pulled = 0;
    for stream in 0..400 {
        let of_row = || ForceLawSolver { s: vec![s; 4], ..problem(stream, (2, 1), 1.0).0 };
        let before = -1.3e6 + 1e5 * draw(stream, 1);
        let force = 2e7 * (1.5 + draw(stream, 2));
        let (elastic, dashpot) = ([5e24, 9.3e11], [5.4e24, 6.4e11]);
        let law = |i: usize, y: f64| {
            let pressure = elastic[i] - dashpot[i] * 0.5 * (before + y);
            if pressure > 0.0 {
                LawResponse { force: pressure, slope: 0.5 * dashpot[i], noise: 0.0 }
            } else {
                LawResponse { force: 0.0, slope: 0.0, noise: 0.0 }
            }
        };
        // The second wall pushes with `force` at this y, where the first would pull.
        let y = 2.0 * (elastic[1] - force) / dashpot[1] - before;
        let mut walls = of_row();
        walls.free.fill(y - s * force);
        walls.solve(law).unwrap();
        pulled += u32::from(walls.guess.iter().any(|guess| *guess < 0.0));
        walls.refine_pulls();
        // The dashpot turns the rounding of y into 6.4e11 · 1e6 · 2⁻⁵³ N and some more.
        assert_eq!(walls.guess[0], 0.0);
        assert!((walls.guess[1] - force).abs() < 1e-4 * force, "{:?} for {force}", walls.guess);
    }
    assert!(pulled > 100, "{pulled} of 400 pulled");
}

#[test]
fn a_line_search_ends_near_the_minimum_or_takes_the_whole_step() {
    let mut shortened = 0;
    for stream in 0..400 {
        let m = 1 + stream as usize % 4;
        let (mut walls, s) = problem(stream, (m, 4), 1.0);
        // In units of 1e-6 to 1e6 N too.
        let unit = (20.0 * draw(stream, 1)).exp2();
        let force = |i: usize, y: f64| unit * ((5.0 * draw(stream, 700 + i)).exp2() * (-y).max(0.0) - y - y.powi(3));
        let law = |i: usize, y: f64| LawResponse { force: force(i, y), slope: 0.0, noise: 0.0 };
        // Forces of the size that the laws have there, and far larger ones.
        let guess: Vec<f64> =
            (0..m).map(|i| unit * draw(stream, 800 + i) * (8.0 * draw(stream, 900 + i)).max(0.0).exp2()).collect();
        walls.s.iter_mut().for_each(|s| *s /= unit);
        // From where the laws are flat to where they are steep, too.
        let y: Vec<f64> = (0..m).map(|i| draw(stream, 500 + i) * (4.0 * draw(stream, 1000 + i)).exp2()).collect();
        walls.guess.copy_from_slice(&guess);
        for (free, (y, row)) in walls.free.iter_mut().zip(y.iter().zip(&s)) {
            *free = y - row.iter().zip(&guess).map(|(s, force)| s / unit * force).sum::<f64>();
        }
        walls.place();
        // Up to 1e3 N times S cancel.
        (0..m).for_each(|i| assert!((walls.y[i] - y[i]).abs() < 1e-11));
        // Down the slope, from far too short to far too long.
        let length = (6.0 * draw(stream, 2)).exp2();
        for (i, (y, guess)) in y.iter().zip(&guess).enumerate() {
            walls.force[i] = force(i, *y);
            walls.step[i] = length * (walls.force[i] - guess);
        }
        let step = walls.step.clone();
        let shift: Vec<f64> = (0..m).map(|i| (0..m).map(|j| s[i][j] / unit * step[j]).sum()).collect();
        let beyond = if stream % 2 == 0 { BEYOND } else { 0.0 };
        walls.search(&law, beyond);
        let most = (0..m).max_by(|&i, &j| step[i].abs().total_cmp(&step[j].abs())).unwrap();
        let taken = (walls.guess[most] - guess[most]) / step[most];
        (0..m).for_each(|i| assert!((walls.guess[i] - guess[i] - taken * step[i]).abs() < 1e-11 * unit));
        let slope = |t: f64| -> f64 {
            (0..m).map(|i| shift[i] * (guess[i] + t * step[i] - force(i, y[i] + t * shift[i]))).sum()
        };
        // The slope along the step rises from below 0. What is taken is rounded, which the slope
        // feels by its own slope: at most some 1e3 of its first value.
        let (start, here, rounding) = (slope(0.0), slope(taken), 1e-9 * slope(0.0).abs());
        assert!(start < 0.0 && here <= -beyond * start + rounding, "{stream}: {start:e} to {here:e} at {taken}");
        assert!((taken - 1.0).abs() < 1e-12 || here >= 0.5 * start - rounding, "{stream}: {here:e} at {taken}");
        shortened += u32::from(taken < 0.99);
    }
    assert!(shortened > 100, "{shortened} of 400 steps were too long");
}
