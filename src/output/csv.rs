//! `trajectory.csv`, `output.csv` and `contacts.csv`. Numbers have the fewest digits that read back
//! as the same float.

use super::atomic::WholeFile;
use crate::error::{Error, Result};
use crate::step::Contact;
use crate::trajectory::{OutputStates, Trajectory};
use std::collections::HashSet;
use std::io::Write;
use std::path::Path;

/// Bytes of rows that are gathered before they are written to the file.
const BLOCK: usize = 1 << 16;

/// Writes the rows of `trajectory`: time, displacement and velocity of each probe, mean force and
/// impulse of each wall and, along y and z, of each round support, and the work of wear of each
/// support since the start. Forces of walls are signed (lower wall ≥ 0, upper wall ≤ 0). The
/// impulse in a row is that since the row before it, so that a column sums to the impulse of the
/// run, and the force is that impulse over the distance of the rows. Columns carry the names of
/// probes, walls and supports as [`words`] writes them.
pub fn trajectory(path: &Path, trajectory: &Trajectory) -> Result<()> {
    let states = [trajectory.displacements(), trajectory.velocities()];
    let (mut header, mut columns) = probe_columns(trajectory.probes(), trajectory.time(), states);
    let columns_of_walls = trajectory.contact_forces().iter().zip(trajectory.contact_impulses());
    let walls = trajectory.walls().iter().zip(words(trajectory.walls())).zip(columns_of_walls);
    for ((_, word), (force, impulse)) in walls.filter(|((wall, _), _)| !trajectory.holes().contains(wall)) {
        header.extend([format!("contact_force_{word}_N"), format!("contact_impulse_{word}_N_s")]);
        columns.extend([force.as_slice(), impulse]);
    }
    let holes = trajectory.hole_forces().iter().zip(trajectory.hole_impulses());
    for (([force_y, force_z], [impulse_y, impulse_z]), word) in holes.zip(words(trajectory.holes())) {
        for (plane, force, impulse) in [("y", force_y, impulse_y), ("z", force_z, impulse_z)] {
            header.extend([format!("contact_force_{word}_{plane}_N"), format!("contact_impulse_{word}_{plane}_N_s")]);
            columns.extend([force.as_slice(), impulse.as_slice()]);
        }
    }
    for (work, word) in trajectory.wear_work().iter().zip(words(trajectory.supports())) {
        header.push(format!("wear_work_{word}_J"));
        columns.push(work);
    }
    numbers(path, &header, &columns)
}

/// Writes the states of the probes at the output times of the scene, in the columns that
/// [`trajectory`](self::trajectory()) has for them.
///
/// # Errors
/// As [`trajectory`](self::trajectory()).
pub fn output(path: &Path, trajectory: &Trajectory) -> Result<()> {
    let OutputStates { time, displacement, velocity, .. } = trajectory.output();
    let (header, columns) = probe_columns(trajectory.probes(), time, [displacement, velocity]);
    numbers(path, &header, &columns)
}

/// Header and columns of the time, and of displacement and velocity of each of `probes`.
fn probe_columns<'a>(
    probes: &[String],
    time: &'a [f64],
    [displacement, velocity]: [&'a [Vec<f64>]; 2],
) -> (Vec<String>, Vec<&'a [f64]>) {
    let (mut header, mut columns) = (vec!["time_s".to_owned()], vec![time]);
    header.extend(probe_numbers(probes).into_iter().flatten().map(|(what, unit)| format!("{what}_{unit}")));
    displacement.iter().zip(velocity).for_each(|(q, v)| columns.extend([q.as_slice(), v]));
    (header, columns)
}

/// Displacement and velocity of each of `probes` as its columns name them, with their units.
pub(super) fn probe_numbers<S: AsRef<str>>(probes: &[S]) -> Vec<[(String, &'static str); 2]> {
    let suffix = |(probe, word): (&S, String)| match probe.as_ref() {
        "" => String::new(),
        _ => format!("_{word}"),
    };
    let numbers = |suffix: String| [(format!("displacement{suffix}"), "m"), (format!("velocity{suffix}"), "m_per_s")];
    probes.iter().zip(words(probes)).map(suffix).map(numbers).collect()
}

/// Writes the contact episodes of `trajectory`, one per row, in order of time. A rigid impact has
/// no peak force, and an episode still open at the end of the run has no end: those cells are
/// empty. In scenes with supports each row also says where around the support the contact began,
/// its work of wear and the distance slid in it; those cells are empty at other walls.
pub fn contacts(path: &Path, trajectory: &Trajectory) -> Result<()> {
    let mut header = CONTACT.to_vec();
    let wears = !trajectory.supports().is_empty();
    if wears {
        header.extend(["angle_deg", "work_J", "sliding_m"]);
    }
    let name = |index: usize| trajectory.walls().get(index).cloned().unwrap_or_default();
    let rows = trajectory.contacts().iter().enumerate().map(|(index, c)| {
        let mut row = contact_cells(name(c.wall), c);
        if wears {
            let wear = trajectory.contact_wear().get(index).copied().flatten();
            row.extend([
                digits(wear.map(|wear| wear.angle)),
                digits(wear.map(|wear| wear.work)),
                digits(wear.map(|wear| wear.sliding)),
            ]);
        }
        row
    });
    table(path, &header, rows)
}

/// The columns of a contact, whatever the scene.
pub(super) const CONTACT: [&str; 7] =
    ["wall", "start_s", "end_s", "impulse_N_s", "peak_force_N", "approach_speed_m_per_s", "departure_speed_m_per_s"];

/// The cells of a contact under [`CONTACT`].
pub(super) fn contact_cells(wall: String, c: &Contact) -> Vec<String> {
    vec![
        wall,
        digits(Some(c.start)),
        digits(c.end),
        digits(Some(c.impulse)),
        digits(c.peak_force),
        digits(Some(c.approach_speed)),
        digits(c.departure_speed),
    ]
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

/// A column of a table: its header, and the cell of a record.
pub type Column<'a, R> = (&'static str, &'a dyn Fn(&R) -> String);

/// Writes a table with a row for each of `records`, by its columns.
pub fn records<R>(path: &Path, columns: &[Column<'_, R>], records: impl IntoIterator<Item = R>) -> Result<()> {
    let header: Vec<&str> = columns.iter().map(|column| column.0).collect();
    table(path, &header, records.into_iter().map(|record| columns.iter().map(|column| column.1(&record)).collect()))
}

/// Writes a table of text cells under a header.
pub fn table(path: &Path, header: &[impl AsRef<[u8]>], rows: impl Iterator<Item = Vec<String>>) -> Result<()> {
    let failed = |e: csv::Error| Error::io(path.display(), e.to_string(), false).caused_by(e);
    let mut writer = csv::Writer::from_writer(WholeFile::create(path)?);
    writer.write_record(header).map_err(failed)?;
    for row in rows {
        writer.write_record(&row).map_err(failed)?;
    }
    writer.into_inner().map_err(|e| Error::io(path.display(), e.error().to_string(), false))?.finish()
}

/// Writes columns of numbers under a header. Beside [`table`], because a row of numbers needs no
/// quotes and no string a cell: a long trajectory is written several times as fast.
pub(super) fn numbers(path: &Path, header: &[String], columns: &[&[f64]]) -> Result<()> {
    let named = |reason: String| Error::io(path.display(), reason, false);
    let mut writer = csv::Writer::from_writer(WholeFile::create(path)?);
    writer.write_record(header).map_err(|e| named(e.to_string()).caused_by(e))?;
    let mut file = writer.into_inner().map_err(|e| named(e.error().to_string()))?;
    let mut write = |text: &[u8]| file.write_all(text).map_err(|e| named(e.to_string()).caused_by(e));
    let mut text = Vec::with_capacity(2 * BLOCK);
    let mut buffer = ryu::Buffer::new();
    for row in 0..columns.iter().map(|column| column.len()).min().unwrap_or(0) {
        for (index, column) in columns.iter().enumerate() {
            if index > 0 {
                text.push(b',');
            }
            text.extend_from_slice(buffer.format(column[row]).as_bytes());
        }
        text.push(b'\n');
        if text.len() >= BLOCK {
            write(&text)?;
            text.clear();
        }
    }
    write(&text)?;
    file.finish()
}

/// The fewest digits that read back as the same number; an empty cell where there is no value.
pub(crate) fn digits(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| ryu::Buffer::new().format(x).to_owned())
}

#[cfg(test)]
mod tests {
    use super::{digits, numbers, words};

    #[test]
    fn columns_have_no_hyphens_and_stay_apart() {
        assert_eq!(words(&["a-b", "a_b", "c", "a-b_2"]), ["a_b", "a_b_2", "c", "a_b_2_2"]);
    }

    #[test]
    fn numbers_read_back_as_themselves() {
        let mut odd = vec![0.0, -0.0, 0.1, 1e-5, 1e16, -5e-324, f64::MAX, 1.0 / 3.0, f64::EPSILON];
        odd.extend((0..9000).map(|i| f64::from(i).sin() * 10f64.powi(i % 600 - 300)));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("numbers.csv");
        let negative: Vec<f64> = odd.iter().map(|x| -x).collect();
        numbers(&path, &["a".to_owned(), "b".to_owned()], &[&odd, &negative]).expect("written");
        let mut reader = csv::Reader::from_path(&path).expect("opened");
        assert_eq!(reader.headers().expect("a header"), vec!["a", "b"]);
        let mut rows = 0;
        for (record, (a, b)) in reader.records().zip(odd.iter().zip(&negative)) {
            let record = record.expect("a row");
            let read = |i: usize| record[i].parse::<f64>().expect("a number").to_bits();
            assert_eq!((read(0), read(1)), (a.to_bits(), b.to_bits()));
            assert_eq!(digits(Some(*a)), record[0]);
            rows += 1;
        }
        assert_eq!(rows, odd.len());
    }
}
