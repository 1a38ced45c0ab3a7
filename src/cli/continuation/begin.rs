//! The start of the first branch.

use super::super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::orbit::branch::Start;
use crate::orbit::{Orbit, Problem, Shot, shoot};
use crate::output::periodic::{read, read_shot};
use crate::scene::Scene;
use std::path::Path;

/// The orbit from which the first branch starts: of one degree of freedom, or of a structure.
pub(super) enum Begin {
    Orbit(Orbit),
    Shot(Shot),
}

impl Begin {
    /// The orbit in a file of `signorini orbit`; `problem` is that of one degree of freedom.
    pub(super) fn read(path: &Path, case: &Case, problem: Option<&Problem>) -> Result<Self> {
        match problem {
            Some(problem) => problem.correct(&read(path, problem.scene())?).map(Self::Orbit),
            None => read_shot(path, &case.scene, case.truncated.is_some())?.corrected(&case.scene).map(Self::Shot),
        }
    }

    /// The orbit on which the case settles over `settle` forcing periods or more.
    pub(super) fn settled(scene: &Scene, problem: Option<&Problem>, settle: u32, ui: &Ui) -> Result<Self> {
        let bar = ui.progress("settling", 1000);
        let progress = |share| bar.share(share);
        let found = match problem {
            Some(problem) => problem.settled_with(settle, &progress).map(Self::Orbit),
            None => shoot(scene, settle, &progress).map(Self::Shot),
        };
        bar.finish();
        found
    }

    pub(super) fn start(&self) -> Start<'_> {
        match self {
            Self::Orbit(orbit) => Start::Orbit(orbit),
            Self::Shot(shot) => Start::Shot(shot),
        }
    }
}
