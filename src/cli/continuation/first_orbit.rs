//! The start of the first branch.

use super::family::SceneFamily;
use crate::cli::ui::Ui;
use crate::error::Result;
use crate::orbit::branch::Start;
use crate::orbit::{Orbit, Shot, shoot};
use crate::output::periodic::{read, read_shot};
use std::path::Path;

/// The orbit from which the first branch starts: of one degree of freedom, or of a structure.
pub(super) enum FirstOrbit {
    Orbit(Orbit),
    Shot(Shot),
}

impl FirstOrbit {
    /// The orbit in a file of `signorini orbit`.
    pub(super) fn read(path: &Path, family: &SceneFamily) -> Result<Self> {
        let case = &family.case;
        match &family.problem {
            Some(problem) => problem.correct(&read(path, problem.scene())?).map(Self::Orbit),
            None => read_shot(path, &case.scene, case.truncated.is_some())?.corrected(&case.scene).map(Self::Shot),
        }
    }

    /// The orbit on which the case settles over `settle` forcing periods or more.
    pub(super) fn settled(family: &SceneFamily, settle: u32, ui: &Ui) -> Result<Self> {
        ui.with_bar("settling", |bar| {
            let progress = |share| bar.set_share(share);
            match &family.problem {
                Some(problem) => problem.settled_with(settle, &progress).map(Self::Orbit),
                None => shoot(&family.case.scene, settle, &progress).map(Self::Shot),
            }
        })
    }

    pub(super) fn start(&self) -> Start<'_> {
        match self {
            Self::Orbit(orbit) => Start::Orbit(orbit),
            Self::Shot(shot) => Start::Shot(shot),
        }
    }
}
