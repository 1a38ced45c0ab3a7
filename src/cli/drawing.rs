//! The stretch of time of a command's pictures.

use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::Span;

/// The stretch of time that pictures show.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct PlotSpan {
    /// Pictures from this time on, s [default: the start]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    from: Option<f64>,
    /// Pictures up to this time, s [default: the end, in compare the horizon of the comparison]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    to: Option<f64>,
}

impl PlotSpan {
    /// The stretch asked for; without `--to` it ends at `until` (s), or at the end of the run where
    /// `until` lies before its beginning.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a stretch that does not lie within the run.
    pub fn within(&self, case: &Case, until: f64) -> Result<Span> {
        let end = case.scene.duration;
        let from = self.from.unwrap_or(0.0);
        if !(0.0..end).contains(&from) {
            return Err(Error::invalid("--from", from, format!("a time from 0 to below the end of the run, {end} s")));
        }
        let to = self.to.unwrap_or(if until > from { until } else { end });
        if !(to > from && to <= end) {
            let expected = format!("a time above {from} s, where the pictures begin, and up to the end, {end} s");
            return Err(Error::invalid("--to", to, expected));
        }
        Ok(Span { from, to })
    }
}
