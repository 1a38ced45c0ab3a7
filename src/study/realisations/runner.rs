//! Runs realisations on all cores.

use super::realisation::Realisation;
use crate::error::Result;
use crate::interrupt::Carried;
use crate::run::{Options, run_with_progress};
use crate::scene::Scene;
use crate::scheme::Method;
use std::num::NonZero;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Time between two reports of progress.
const TELL: Duration = Duration::from_millis(100);

/// Runs the realisations `numbers` by `method` on all cores; `scene` makes the scene of each.
/// `progress` is called with the share of the work that is done. The results do not depend on the
/// number of cores.
///
/// # Errors
/// Of the first realisation that failed, by its number; [`Error::Stopped`](crate::Error::Stopped).
pub fn realisations(
    numbers: RangeInclusive<u64>,
    scene: &(dyn Fn(u64) -> Result<Scene> + Sync),
    method: &Method,
    options: &Options,
    progress: &mut dyn FnMut(f64),
) -> Result<Vec<Realisation>> {
    let (first, last) = numbers.into_inner();
    if last < first {
        return Ok(Vec::new());
    }
    let count = last - first + 1;
    let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
    let threads = count.min(cores as u64) as usize;
    let (next, failed) = (AtomicU64::new(0), AtomicBool::new(false));
    // Share of its current run that each thread has done, as the bits of a float.
    let shares: Vec<AtomicU64> = (0..threads).map(|_| AtomicU64::new(0)).collect();
    let interrupt = &Carried::here();
    let (sender, receiver) = channel();
    let mut outcomes = Vec::new();
    std::thread::scope(|scope| {
        for share in &shares {
            let (sender, next, failed) = (sender.clone(), &next, &failed);
            let work = move || loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= count || failed.load(Ordering::Relaxed) {
                    return;
                }
                let number = first + index;
                let outcome = one(number, scene, method, options, share);
                failed.fetch_or(outcome.is_err(), Ordering::Relaxed);
                share.store(0, Ordering::Relaxed);
                if sender.send((number, outcome)).is_err() {
                    return;
                }
            };
            scope.spawn(move || interrupt.over(work));
        }
        drop(sender);
        loop {
            match receiver.recv_timeout(TELL) {
                Ok(outcome) => outcomes.push(outcome),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let under_way: f64 = shares.iter().map(|share| f64::from_bits(share.load(Ordering::Relaxed))).sum();
            progress((outcomes.len() as f64 + under_way) / count as f64);
        }
    });
    outcomes.sort_by_key(|(number, _)| *number);
    outcomes.into_iter().map(|(_, outcome)| outcome).collect()
}

fn one(
    number: u64,
    scene: &(dyn Fn(u64) -> Result<Scene> + Sync),
    method: &Method,
    options: &Options,
    share: &AtomicU64,
) -> Result<Realisation> {
    let scene = scene(number)?;
    let mut told = |time: f64| share.store((time / scene.duration).to_bits(), Ordering::Relaxed);
    let run = run_with_progress(&scene, method, options, &mut told)?;
    Ok(Realisation::of(number, &run))
}
