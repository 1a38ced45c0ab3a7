//! What the benches share: timing, and Clarabel as one would set it by hand.

#![allow(dead_code)] // each bench uses a part of it

use clarabel::solver::DefaultSettings;
use std::time::Instant;

/// Settings of the bare Clarabel that the library is timed against: the library's own tolerances,
/// and updates of the data allowed.
pub fn clarabel_settings() -> DefaultSettings<f64> {
    DefaultSettings {
        verbose: false,
        presolve_enable: false,
        max_threads: 1,
        tol_gap_abs: 1e-9,
        tol_gap_rel: 1e-9,
        tol_feas: 1e-9,
        ..DefaultSettings::default()
    }
}

/// Nanoseconds per call of `work`, over `calls` of them.
pub fn time(calls: usize, mut work: impl FnMut(usize)) -> f64 {
    let start = Instant::now();
    for call in 0..calls {
        work(call);
    }
    start.elapsed().as_secs_f64() * 1e9 / calls as f64
}

/// The best of `rounds` for each side; the sides alternate within every round, so that a busy
/// machine affects both alike.
pub fn race<const N: usize>(rounds: usize, mut round: impl FnMut() -> [f64; N]) -> [f64; N] {
    let mut best = [f64::INFINITY; N];
    for _ in 0..rounds {
        for (best, cost) in best.iter_mut().zip(round()) {
            *best = best.min(cost);
        }
    }
    best
}
