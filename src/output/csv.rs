//! `trajectory.csv` and `contacts.csv`, with 17 significant digits, so that reading a number back
//! gives the same float.

use super::atomic::WholeFile;
use crate::error::{Error, Result};
use crate::trajectory::Trajectory;
use std::collections::HashSet;
use std::path::Path;

/// Writes the rows of `trajectory`: time, displacement and velocity of each probe, force and
/// impulse of each wall. Forces are signed (lower wall ≥ 0, upper wall ≤ 0). The impulse in a row
/// is that since the row before it, so that a column sums to the impulse of the run. Columns carry
/// the names of probes and walls as [`words`] writes them.
///
/// # Errors
/// [`Error::Io`] where the file cannot be written; it is written whole or not at all.
pub fn trajectory(path: &Path, trajectory: &Trajectory) -> Result<()> {
    let mut header = vec!["time_s".to_owned()];
    let mut columns: Vec<&[f64]> = vec![trajectory.time()];
    for (probe, word) in trajectory.probes().iter().zip(words(trajectory.probes())) {
        let suffix = if probe.is_empty() { String::new() } else { format!("_{word}") };
        let (displacement, velocity) = trajectory.probe(probe)?;
        header.extend([format!("displacement{suffix}_m"), format!("velocity{suffix}_m_per_s")]);
        columns.extend([displacement, velocity]);
    }
    for (wall, word) in trajectory.walls().iter().zip(words(trajectory.walls())) {
        header.extend([format!("contact_force_{word}_N"), format!("contact_impulse_{word}_N_s")]);
        columns.extend([trajectory.contact_force(wall)?, trajectory.contact_impulse(wall)?]);
    }
    let rows = (0..trajectory.time().len()).map(|i| columns.iter().map(move |c| digits(c.get(i).copied())).collect());
    table(path, &header, rows)
}

/// Writes the contact episodes of `trajectory`, one per row, in order of time. A rigid impact has
/// no peak force, and an episode still open at the end of the run has no end: those cells are
/// empty.
///
/// # Errors
/// As [`trajectory`].
pub fn contacts(path: &Path, trajectory: &Trajectory) -> Result<()> {
    let header = [
        "wall",
        "start_s",
        "end_s",
        "impulse_N_s",
        "peak_force_N",
        "approach_speed_m_per_s",
        "departure_speed_m_per_s",
    ];
    let rows = trajectory.contacts().iter().map(|c| {
        vec![
            trajectory.walls().get(c.wall).cloned().unwrap_or_default(),
            digits(Some(c.start)),
            digits(c.end),
            digits(Some(c.impulse)),
            digits(c.peak_force),
            digits(Some(c.approach_speed)),
            digits(c.departure_speed),
        ]
    });
    table(path, &header.map(str::to_owned), rows)
}

/// Names as parts of column names: `_` for every `-`, so that a column name is an identifier in the
/// languages that read it (`support-upper` gives `contact_force_support_upper_N`). Names that this
/// makes equal get a number: `_2`, `_3`.
#[must_use]
pub fn words<S: AsRef<str>>(names: &[S]) -> Vec<String> {
    let mut taken = HashSet::new();
    let mut words = Vec::with_capacity(names.len());
    for name in names {
        let plain = name.as_ref().replace('-', "_");
        let mut word = plain.clone();
        let mut number = 2;
        while !taken.insert(word.clone()) {
            word = format!("{plain}_{number}");
            number += 1;
        }
        words.push(word);
    }
    words
}

/// Writes a table of text cells under a header.
///
/// # Errors
/// As [`trajectory`].
pub fn table(path: &Path, header: &[String], rows: impl Iterator<Item = Vec<String>>) -> Result<()> {
    let failed = |e: csv::Error| Error::io(path.display(), e.to_string(), false).caused_by(e);
    let mut writer = csv::Writer::from_writer(WholeFile::create(path)?);
    writer.write_record(header).map_err(failed)?;
    for row in rows {
        writer.write_record(&row).map_err(failed)?;
    }
    writer.into_inner().map_err(|e| Error::io(path.display(), e.error().to_string(), false))?.finish()
}

/// 17 significant digits; an empty cell where there is no value.
pub(crate) fn digits(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| format!("{x:.16e}"))
}

#[cfg(test)]
mod tests {
    use super::words;

    #[test]
    fn columns_have_no_hyphens_and_stay_apart() {
        assert_eq!(words(&["a-b", "a_b", "c", "a-b_2"]), ["a_b", "a_b_2", "c", "a_b_2_2"]);
    }
}
