//! Timing shared by the benches.

use std::time::Instant;

/// Nanoseconds for each call of `work`, over `calls` of them.
pub fn time(calls: usize, mut work: impl FnMut(usize)) -> f64 {
    let start = Instant::now();
    for call in 0..calls {
        work(call);
    }
    start.elapsed().as_secs_f64() * 1e9 / calls as f64
}

/// The best of `rounds` for each side, the sides taking turns within every round so that a busy machine is fair to both.
pub fn race<const N: usize>(rounds: usize, mut round: impl FnMut() -> [f64; N]) -> [f64; N] {
    let mut best = [f64::INFINITY; N];
    for _ in 0..rounds {
        for (best, cost) in best.iter_mut().zip(round()) {
            *best = best.min(cost);
        }
    }
    best
}
