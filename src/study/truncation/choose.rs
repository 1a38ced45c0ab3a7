//! Chooses the number of modes.

use super::unreduced::reaches_all_walls;
use super::{Truncation, Unreduced};
use crate::error::{Error, Result};
use crate::run::{Options, Run, run_with_progress};
use crate::scene::Reduction;
use crate::scheme::Method;
use crate::time::TimeOptions;
use serde::Serialize;
use std::fmt;

/// Most modes that are tried, unless the structure has no more than this.
pub const MOST_CHOSEN: usize = 200;

/// Largest change by an increase, as a share of the tolerance. The truncation error falls at worst
/// like 1/k in the number of modes k (the wall force of a bar): in that case twice the last change,
/// for an increase by half, is still to come; and an increase may change little by chance.
const QUIET: f64 = 0.25;

/// Number of successive increases that must change less than that, not counted those whose modes
/// do not move all walls: with these nothing can change.
const QUIET_INCREASES: usize = 2;

/// After this many successive increases that each changed more than [`IDLE`], and more than half as
/// much as the first of them, adding modes is given up: peaks of impacts grow with every mode, and
/// impulses of a chaotic motion differ by chance.
const IDLE_INCREASES: usize = 3;
const IDLE: f64 = 0.1;

/// One number of modes that was tried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModesLevel {
    /// The modes.
    pub modes: usize,
    /// Largest change of an impulse or peak from the number tried before; `None` for the first.
    pub change: Option<f64>,
    /// The quantity with that change.
    pub quantity: Option<String>,
}

/// A number of modes, and how it was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ChosenModes {
    /// The change that was allowed.
    pub tolerance: f64,
    /// The modes chosen.
    pub modes: usize,
    /// Degrees of freedom of the whole structure, hence its number of modes.
    pub degrees_of_freedom: usize,
    /// True if the tolerance is kept: two successive increases by modes that move all walls changed
    /// less than a quarter of it, or no mode is left out.
    pub kept: bool,
    /// What was tried, in order.
    pub levels: Vec<ModesLevel>,
}

impl ChosenModes {
    /// The error to report if the tolerance is not kept.
    #[must_use]
    pub fn shortfall(&self) -> Option<Error> {
        let last = self.levels.last().filter(|_| !self.kept)?;
        let quantity = last.quantity.clone().unwrap_or_else(|| "nothing to compare".to_owned());
        Some(Error::Truncated {
            tolerance: self.tolerance,
            reached: last.change.unwrap_or(f64::INFINITY),
            quantity,
            modes: last.modes,
        })
    }
}

/// Increases the number of modes by half, from `start` on, until two successive increases, by modes
/// that move all walls, change no wall's impulse and peak by more than a quarter of `tolerance`;
/// runs are by `method` with the step and window of `time`. Where the changes do not decrease, it
/// gives up and keeps `start`, the cheapest number, since no other number tried is known to be more
/// accurate. `progress` is called with the time (s) that the current run has reached.
///
/// # Errors
/// Errors of a reduction or a run.
pub fn choose_modes(
    whole: &Unreduced,
    start: usize,
    method: &Method,
    time: &TimeOptions,
    tolerance: f64,
    progress: &mut dyn FnMut(f64),
) -> Result<ChosenModes> {
    let options = Options::new(*time);
    let mut make = |modes: usize| -> Result<(Reduction, Run)> {
        let cut = whole.cut(modes)?;
        let run = run_with_progress(&cut.scene, method, &options, progress)?.unrefuted()?;
        Ok((cut, run))
    };
    let mut last = make(start)?;
    // The modes that were the last to move all walls.
    let mut told = last.0.clone();
    let n = last.0.degrees_of_freedom;
    let most = if n <= MOST_CHOSEN { n } else { MOST_CHOSEN.max(start) };
    let mut levels = vec![ModesLevel { modes: start, change: None, quantity: None }];
    let (mut modes, mut quiet) = (start, 0);
    while modes < most && quiet < QUIET_INCREASES {
        modes = (modes + modes.div_ceil(2)).next_multiple_of(whole.planes.max(1)).min(most);
        let next = make(modes)?;
        let truncation = Truncation::between(whole, [&last.0, &next.0], [&last.1, &next.1]);
        let (change, quantity) = truncation.worst();
        let tells = reaches_all_walls(&told, &next.0);
        quiet = match change <= QUIET * tolerance {
            true => quiet + usize::from(tells),
            false => 0,
        };
        if tells {
            told = next.0.clone();
        }
        levels.push(ModesLevel { modes, change: Some(change), quantity: Some(quantity) });
        last = next;
        let changes: Vec<f64> = levels.iter().filter_map(|l| l.change).collect();
        let idle = |c: &[f64; IDLE_INCREASES]| c.iter().all(|x| *x > IDLE.max(0.5 * c[0]) && *x > tolerance);
        if changes.last_chunk().is_some_and(idle) {
            return Ok(ChosenModes { tolerance, modes: start, degrees_of_freedom: n, kept: start == n, levels });
        }
    }
    let kept = quiet >= QUIET_INCREASES || modes == n;
    Ok(ChosenModes { tolerance, modes, degrees_of_freedom: n, kept, levels })
}

impl fmt::Display for ChosenModes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {}", self.modes, self.degrees_of_freedom)?;
        if self.modes == self.degrees_of_freedom {
            f.write_str(", all there are")?;
        }
        for (i, level) in self.levels.iter().enumerate() {
            let (Some(change), Some(quantity)) = (level.change, &level.quantity) else { continue };
            let lead = if i == 1 { ": each increase changed by" } else { "," };
            write!(f, "{lead} {change:.1e} the {quantity}, to {}", level.modes)?;
        }
        Ok(())
    }
}
