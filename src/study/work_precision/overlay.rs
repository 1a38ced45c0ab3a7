//! Points measured with other programs, read from a CSV file.

use crate::error::{Error, Result};
use std::path::Path;

/// One run of another program.
#[derive(Debug, Clone, PartialEq)]
pub struct Peer {
    /// The program, for example `SciPy`.
    pub program: String,
    /// Its method, for example `DOP853`; points of one program and method make one curve.
    pub method: String,
    /// Largest |Δu| over the gap scale.
    pub error: f64,
    /// Wall-clock time, s: after a warm-up run and without the set-up.
    pub seconds: f64,
}

impl Peer {
    /// Its label in the legend.
    #[must_use]
    pub fn label(&self) -> String {
        format!("{} {}", self.program, self.method).trim().to_owned()
    }
}

/// Reads a CSV file with the columns `program,method,error_over_gap,seconds`, in any order; other
/// columns are ignored. A row whose error or time is empty is a run that failed and has no point.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read, [`Error::Invalid`] with the line of an entry that
/// makes no sense.
pub fn read(path: &Path) -> Result<Vec<Peer>> {
    let shown = path.display();
    let failed = |e: csv::Error| Error::io(path.display(), e.to_string(), true).caused_by(e);
    if !path.is_file() {
        let expected =
            "not a regular file; expected a CSV file with the columns program, method, error_over_gap and seconds";
        return Err(Error::io(shown, expected.to_owned(), true));
    }
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(failed)?;
    let header = reader.headers().map_err(failed)?.clone();
    let column = |name: &str| {
        let found = header.iter().position(|h| h == name);
        found.ok_or_else(|| {
            Error::invalid(
                format!("{shown}: header"),
                header.iter().collect::<Vec<_>>().join(","),
                format!("a column {name}"),
            )
        })
    };
    let [program, method, error, seconds] =
        [column("program")?, column("method")?, column("error_over_gap")?, column("seconds")?];
    let mut peers = Vec::new();
    for record in reader.records() {
        let record = record.map_err(failed)?;
        let line = record.position().map_or(0, csv::Position::line);
        let cell = |i: usize| record.get(i).unwrap_or_default();
        let number = |i: usize, name: &str| match cell(i) {
            "" => Ok(None),
            text => match text.parse::<f64>() {
                Ok(x) if x.is_finite() && x > 0.0 => Ok(Some(x)),
                _ => Err(Error::invalid(
                    format!("{shown}, line {line}: {name}"),
                    text,
                    "a finite number above 0, or nothing",
                )),
            },
        };
        if let (Some(error), Some(seconds)) = (number(error, "error_over_gap")?, number(seconds, "seconds")?) {
            peers.push(Peer { program: cell(program).to_owned(), method: cell(method).to_owned(), error, seconds });
        }
    }
    Ok(peers)
}
