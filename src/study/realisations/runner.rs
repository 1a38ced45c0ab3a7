//! Runs realisations on all cores.

use super::realisation::Realisation;
use crate::error::Result;
use crate::order::sort_by_number;
use crate::parallel::{Take, cores, on_threads};
use crate::run::{Options, run_with_progress};
use crate::scene::Scene;
use crate::scheme::Method;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

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
    let failed = AtomicBool::new(false);
    // Share of each run that is done, as the bits of a float.
    let shares: Vec<AtomicU64> = (0..count).map(|_| AtomicU64::new(0)).collect();
    let work = |index: u64, send: &mut Take<'_, (u64, Result<Realisation>)>| {
        if let Some(share) = shares.get(index as usize).filter(|_| !failed.load(Ordering::Relaxed)) {
            let outcome = one(first + index, scene, method, options, share);
            share.store(1.0_f64.to_bits(), Ordering::Relaxed);
            failed.fetch_or(outcome.is_err(), Ordering::Relaxed);
            send((index, outcome));
        }
        Ok(())
    };
    let mut outcomes = Vec::new();
    on_threads(count, cores(), &work, &mut |outcome| {
        outcomes.extend(outcome);
        let done: f64 = shares.iter().map(|share| f64::from_bits(share.load(Ordering::Relaxed))).sum();
        progress(done / count as f64);
        Ok(())
    })?;
    sort_by_number(&mut outcomes, |(index, _)| *index as f64);
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
