//! `windows.journal`: the windows of histories of wear that were run, so that an interrupted study
//! goes on, and a finished one to further years.

use super::journal::{Journal, is_there};
use super::results::Results;
use crate::error::Result;
use crate::study::realisations::Realisation;
use crate::study::wear_history::{WearHistories, WearPlan, WearWindow};

/// Name of the file.
const JOURNAL: &str = "windows.journal";

/// Most windows of a history: at the shortest step and with every step halved. Those beyond it are
/// run again after an interruption.
const MOST_WINDOWS: u64 = 4096;

/// The journal of the windows of histories of wear.
#[derive(Debug)]
pub struct WindowJournal {
    journal: Journal,
}

impl WindowJournal {
    /// Opens the journal in the folder of `results`, for `histories` histories: as it is, where the
    /// folder holds results of this request, whole or not, or of fewer years, and it does not begin
    /// `anew`.
    ///
    /// # Errors
    /// [`crate::Error::Io`] where it cannot be read or written.
    pub fn open(results: &mut Results, histories: usize, anew: bool) -> Result<Self> {
        let folder = results.folder().to_owned();
        let windows = MOST_WINDOWS.saturating_mul(histories as u64);
        let anew = anew || !is_there(&folder, JOURNAL);
        let journal = Journal::open(&folder, JOURNAL, windows, anew, |number| place(number, windows))?;
        results.begin_and_keep(JOURNAL)?;
        Ok(Self { journal })
    }

    /// Follows the histories of `plan`, whose first windows are `first` where these were run
    /// already. Windows that are in the journal are not run again, and those that are run are added
    /// to it. `progress` is called with the share of the service that is done. Returns with the
    /// histories how many windows were there.
    ///
    /// # Errors
    /// As [`WearPlan::follow`]; [`crate::Error::Io`] where the journal cannot be read or written.
    pub fn follow(
        &mut self,
        plan: &WearPlan<'_>,
        first: &[Realisation],
        progress: &mut dyn FnMut(f64),
    ) -> Result<(WearHistories, u64)> {
        let mut kept = self.kept()?;
        let mut ran = 0;
        for member in first.iter().skip(kept.len()) {
            let window = WearWindow::of(member, plan.supports);
            self.keep(&window)?;
            kept.push(window);
            ran += 1;
        }
        let mut keep = |window: &WearWindow| {
            ran += 1;
            self.keep(window)
        };
        let found = plan.follow(&kept, &mut keep, progress)?;
        let there = found.windows - ran;
        Ok((found, there))
    }

    /// The windows that earlier processes have run, from number 1 up to the first that is not
    /// there.
    fn kept(&mut self) -> Result<Vec<WearWindow>> {
        let mut kept = Vec::new();
        while let Some(bytes) = self.journal.read(kept.len())? {
            let window = serde_json::from_slice::<WearWindow>(&bytes).ok();
            let Some(window) = window.filter(|window| window.number == kept.len() as u64 + 1) else { break };
            kept.push(window);
        }
        Ok(kept)
    }

    /// Keeps a window.
    fn keep(&mut self, window: &WearWindow) -> Result<()> {
        let mut body = serde_json::to_vec(window).unwrap_or_default();
        body.push(b'\n');
        self.journal.add(window.number, place(window.number, u64::MAX).unwrap_or(usize::MAX), &body)?;
        self.journal.flush()
    }
}

/// Where window `number`, from 1, stands among so many.
fn place(number: u64, windows: u64) -> Option<usize> {
    usize::try_from(number.checked_sub(1)?).ok().filter(|place| (*place as u64) < windows)
}
