//! The statistics that a case asks for in `[statistics]`: joined episodes and spectra.

use super::episodes::Episodes;
use super::results::Results;
use super::spectra::{self, SpectrumFile};
use crate::case::Case;
use crate::error::Result;
use crate::run::Run;
use serde::Serialize;

/// The results that `[statistics]` asks for, in the form of the summary.
#[derive(Debug, Clone, Serialize)]
pub struct Detail {
    /// Joined episodes of every wall and support.
    pub episodes: Episodes,
    /// Spectra of probes, walls and supports.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spectra: Vec<SpectrumFile>,
}

impl Detail {
    /// The results of `run`; `None` where the case has no such table.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] for a run with too few rows for a spectrum.
    pub fn of(case: &Case, run: &Run) -> Result<Option<Self>> {
        let Some(options) = case.statistics else { return Ok(None) };
        let spectra = if options.spectra { spectra::of(case, run)? } else { Vec::new() };
        Ok(Some(Self { episodes: Episodes::of(case, run, options.rest), spectra }))
    }

    /// Writes its files into the folder of `results`, under the names that `named` gives; `title`
    /// is that of the figures.
    pub fn write(&self, results: &mut Results, title: &str, named: impl Fn(&str) -> String) -> Result<()> {
        self.episodes.write(results, &named)?;
        spectra::write(&self.spectra, results, title, &named)
    }
}
