//! The numbers of attractors.
//!
//! A row describes its attractor from its own run only. Attractors are numbered when all rows are
//! done, in the order of the rows; rows with the same attractor get the same number. So the numbers
//! depend on neither threads nor interruptions, and `merge` gives those of the undivided sweep.

use super::measure::Measure;
use super::table::{TABLE, Table, line_of, with_number};
use crate::error::{Error, Result};
use crate::output::atomic::WholeFile;
use crate::output::csv::digits;
use std::io::Write;
use std::path::Path;

/// The table of the attractors.
pub(super) const ATTRACTORS: &str = "attractors.csv";

/// Its first columns, which are counted; those of a row's description follow.
const COUNTED: [&str; 3] = ["attractor", "rows", "share"];
pub(super) const TOLD: [&str; 7] = [
    "signature",
    "period",
    "phases_cycles",
    "approach_speeds_m_per_s",
    "multipliers",
    "displacements_m",
    "velocities_m_per_s",
];

/// Relative tolerance for strobes to be equal, in the largest displacement and the largest
/// velocity.
const EQUAL: f64 = 1e-6;

/// The signature of a chaotic motion, and of one that touches no wall.
pub(super) const CHAOTIC: &str = "chaotic";
pub(super) const QUIET: &str = "quiet";

/// The attractors known so far, by their numbers from 1.
#[derive(Debug, Default)]
pub(super) struct Attractors(Vec<Known>);

#[derive(Debug)]
struct Known {
    cells: Vec<String>,
    strobes: Option<Strobes>,
    rows: u64,
}

/// States once a period of the load: q and v, one strobe after the other.
#[derive(Debug)]
struct Strobes {
    count: usize,
    parts: [Vec<f64>; 2],
}

/// Most contacts of a signature that is shown in full.
const SHOWN: usize = 2;

impl Strobes {
    /// The strobes in the cells of an attractor; `None` for a chaotic one.
    fn of(cells: &[String]) -> Option<Self> {
        let numbers = |at: usize| -> Option<Vec<f64>> {
            cells.get(at)?.split_whitespace().map(|word| word.parse().ok()).collect()
        };
        let (count, parts): (usize, [Vec<f64>; 2]) = (cells.get(1)?.parse().ok()?, [numbers(5)?, numbers(6)?]);
        let n = parts.iter().map(Vec::len).min().unwrap_or(0);
        (count > 0 && n > 0 && n % count == 0).then_some(Self { count, parts })
    }

    /// True for the same orbit, whichever of its strobes is listed first.
    fn is(&self, other: &Self) -> bool {
        let sizes = |of: &Self| of.parts.iter().map(Vec::len).collect::<Vec<_>>();
        if self.count != other.count || sizes(self) != sizes(other) {
            return false;
        }
        let equal = |a: &[f64], b: &[f64], begin: usize| {
            let near = EQUAL * a.iter().chain(b).fold(0.0, |most, x| f64::max(most, x.abs()));
            let from = begin * (a.len() / self.count);
            a.iter().zip(b.iter().cycle().skip(from)).all(|(a, b)| (a - b).abs() <= near)
        };
        let both = |begin: usize| self.parts.iter().zip(&other.parts).all(|(a, b)| equal(a, b, begin));
        (0..self.count).any(both)
    }
}

impl Attractors {
    /// Returns the number of the attractor that the `cells` of a row describe, and counts the row.
    pub fn number(&mut self, cells: &[String]) -> u64 {
        let strobes = Strobes::of(cells);
        let same = |known: &Known| match (&known.strobes, &strobes) {
            (Some(a), Some(b)) => a.is(b),
            (None, None) => known.cells.first() == cells.first(),
            _ => false,
        };
        let at = self.0.iter().position(same).unwrap_or(self.0.len());
        match self.0.get_mut(at) {
            Some(known) => known.rows += 1,
            None => self.0.push(Known { cells: cells.to_vec(), strobes, rows: 1 }),
        }
        at as u64 + 1
    }

    /// Writes them to the file at `path`, of a sweep of `rows` rows.
    pub fn write(&self, path: &Path, rows: u64) -> Result<()> {
        let mut file = WholeFile::create(path)?;
        let header: Vec<String> = COUNTED.iter().chain(&TOLD).map(|&name| name.to_owned()).collect();
        let lines = self.0.iter().zip(1_u64..).map(|(known, number)| {
            let share = digits(Some(known.rows as f64 / rows.max(1) as f64));
            [vec![number.to_string(), known.rows.to_string(), share], known.cells.clone()].concat()
        });
        for cells in std::iter::once(header).chain(lines) {
            let written = file.write_all(&line_of(&cells));
            written.map_err(|error| Error::io(file.path().display(), error.to_string(), false))?;
        }
        file.finish()
    }

    /// The description of each attractor in the table of `folder`, by number.
    pub fn read(folder: &Path) -> Result<Vec<Vec<String>>> {
        let mut all = Vec::new();
        Table::open(&folder.join(ATTRACTORS))?.each(|line| {
            all.push((0..TOLD.len()).map(|at| line.text(COUNTED.len() + at).to_owned()).collect());
        })?;
        Ok(all)
    }
}

/// The attractors of shards, to be numbered as those of the whole.
pub(super) struct Joined {
    column: usize,
    /// For each shard the descriptions of its attractors, by their numbers there.
    told: Vec<Vec<Vec<String>>>,
    pub all: Attractors,
}

impl Joined {
    /// The attractors of the shards in `folders`, whose tables have the header `header`; `None` for
    /// a sweep without attractors.
    pub fn of(header: &csv::StringRecord, folders: &[&Path]) -> Result<Option<Self>> {
        let column = header.iter().position(|column| column == Measure::Attractor.name());
        let there = folders.iter().all(|folder| folder.join(ATTRACTORS).exists());
        let Some(column) = column.filter(|_| there) else { return Ok(None) };
        let told = folders.iter().map(|folder| Attractors::read(folder)).collect::<Result<_>>()?;
        Ok(Some(Self { column, told, all: Attractors::default() }))
    }

    /// The line of a row of a shard, with the number of its attractor in the whole sweep; `None`
    /// for a row without an attractor.
    pub fn line(&mut self, shard: usize, row: &csv::StringRecord) -> Option<Vec<u8>> {
        let number = row.get(self.column)?.parse::<f64>().ok()?;
        let told = self.told.get(shard)?.get((number as usize).checked_sub(1)?)?;
        Some(with_number(row, self.column, self.all.number(told)))
    }
}

/// Number of rows whose attractor was found, by the tables in `folder`; `None` for a sweep that
/// does not look for attractors.
pub(super) fn rows_found(folder: &Path) -> Result<Option<u64>> {
    let asked = |table: &Table| table.column(Measure::Attractor.name()).is_ok();
    if !folder.join(ATTRACTORS).exists() || !asked(&Table::open(&folder.join(TABLE))?) {
        return Ok(None);
    }
    let mut found = 0;
    Table::open(&folder.join(ATTRACTORS))?.each(|line| found += line.number(1).unwrap_or(0.0) as u64)?;
    Ok(Some(found))
}

/// The data of a picture from that table: a short name of each attractor, and its share of the
/// rows.
pub(super) fn named(folder: &Path) -> Result<Vec<(String, f64)>> {
    let mut all = Vec::new();
    Table::open(&folder.join(ATTRACTORS))?.each(|line| {
        let (signature, period) = (line.text(COUNTED.len()), line.text(COUNTED.len() + 1));
        let contacts = signature.split(' ').count();
        let name = if contacts > SHOWN { format!("{contacts} contacts") } else { signature.to_owned() };
        let name = if ["", "1"].contains(&period) { name } else { format!("{name}, {period} periods") };
        all.push((name, line.number(2).unwrap_or(0.0)));
    })?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit(strobes: &[[f64; 2]]) -> Vec<String> {
        let list = |part: usize| strobes.iter().map(|s| s[part].to_string()).collect::<Vec<_>>().join(" ");
        let mut cells = vec!["upper".to_owned(), strobes.len().to_string()];
        cells.extend(vec![String::new(); 3]);
        cells.extend([list(0), list(1)]);
        cells
    }

    #[test]
    fn an_orbit_is_the_same_wherever_its_strobes_begin() {
        let chaotic = || [vec![CHAOTIC.to_owned()], vec![String::new(); TOLD.len() - 1]].concat();
        let mut attractors = Attractors::default();
        assert_eq!(attractors.number(&orbit(&[[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])), 1);
        assert_eq!(attractors.number(&chaotic()), 2);
        assert_eq!(attractors.number(&orbit(&[[5.0, 6.0], [1.0, 2.0], [3.0, 4.0 + 5e-6]])), 1);
        // The order counts, and so does a difference, and a sign.
        assert_eq!(attractors.number(&orbit(&[[5.0, 6.0], [3.0, 4.0], [1.0, 2.0]])), 3);
        assert_eq!(attractors.number(&orbit(&[[5.0, 6.0], [1.0, 2.0], [3.0, 4.1]])), 4);
        assert_eq!(attractors.number(&orbit(&[[-1.0, -2.0], [-3.0, -4.0], [-5.0, -6.0]])), 5);
        assert_eq!(attractors.number(&chaotic()), 2);
        let folder = tempfile::tempdir().unwrap();
        attractors.write(&folder.path().join(ATTRACTORS), 10).unwrap();
        assert_eq!(Attractors::read(folder.path()).unwrap()[3], orbit(&[[5.0, 6.0], [1.0, 2.0], [3.0, 4.1]]));
        assert_eq!(
            named(folder.path()).unwrap()[..2],
            [("upper, 3 periods".to_owned(), 0.2), (CHAOTIC.to_owned(), 0.2)]
        );
    }
}
