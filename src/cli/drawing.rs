//! The options of a command's pictures.

use super::values;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::Span;
use crate::output::format::Format;

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

/// The file formats of pictures.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Formats {
    /// Write pictures as svg, pdf or png, or several of them [default: svg]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    #[arg(value_parser = values::formats(), hide_possible_values = true)]
    format: Vec<Format>,
}

impl Formats {
    /// The formats asked for, without repetition; SVG if none is given.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a format that this build cannot write.
    pub fn usable(&self) -> Result<Vec<Format>> {
        let mut formats = Vec::new();
        for format in &self.format {
            format.check()?;
            if !formats.contains(format) {
                formats.push(*format);
            }
        }
        Ok(if formats.is_empty() { vec![Format::Svg] } else { formats })
    }
}
