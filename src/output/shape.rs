//! `shape.csv`: the displacement of the whole structure over time, at stations along it, from which
//! a report draws it in motion.
//!
//! A case names the places that it watches, and these are few; a drawing needs places all along a
//! tube, and every mass of a chain. They are recorded as probes beside those of the case, and taken
//! out of the run again before anything else sees it.

use super::atomic::WholeFile;
use super::csv::digits;
use crate::case::{Case, Model, Place};
use crate::error::{Error, Result};
use crate::run::Run;
use crate::scene::{Probe, Row, Scene};
use std::io::Write;
use std::path::Path;

/// The file's name.
pub const FILE: &str = "shape.csv";

/// Stations at equal distances along a bar or beam, beside those at walls and loads; and most
/// masses of a chain.
const ALONG: usize = 31;
const MOST_MASSES: usize = 64;
/// Most numbers that are recorded for a drawing, displacements and velocities; runs of more rows
/// have no `shape.csv`.
const MOST_VALUES: f64 = 1e7;
/// Most rows of the file: rows at equal distances, in which a drawing moves smoothly.
const MOST_ROWS: usize = 20_000;

/// Where a structure is drawn.
#[derive(Debug, Clone, Default)]
pub struct Shape {
    probes: Vec<Probe>,
}

impl Shape {
    /// The stations of `case`: none for an oscillator, for matrices and for modes, whose places are
    /// not in a line, for two planes, nor for a run of very many rows.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        let places: Vec<(String, Place)> = match &case.model {
            Model::Beam(beam) => along(case, beam.length),
            Model::Bar(bar) => along(case, bar.length),
            Model::Chain(chain) => {
                let every = chain.masses.len().div_ceil(MOST_MASSES).max(1);
                let masses = (0..chain.masses.len()).step_by(every);
                masses.map(|i| (format!("displacement_of_mass_{i}_m"), Place::Dof(i))).collect()
            }
            _ => Vec::new(),
        };
        // In two planes a place has two displacements, which one line of stations does not show.
        let places = if case.planes.is_two() { Vec::new() } else { places };
        let rows = case.scene.duration / case.time.sample.unwrap_or(case.time.step).max(case.time.step);
        if 2.0 * rows * places.len() as f64 > MOST_VALUES {
            return Self::default();
        }
        let probe = |(name, place): (String, Place)| Some(Probe { name, at: row(case, &place)? });
        Self { probes: places.into_iter().filter_map(probe).collect() }
    }

    /// The scene of `case` with the stations among its probes, after those of the case.
    #[must_use]
    pub fn watched(&self, case: &Case) -> Scene {
        let mut scene = case.scene.clone();
        scene.probes.extend(self.probes.iter().cloned());
        scene
    }

    /// Takes the stations out of a run of [`Shape::watched`]: the displacement (m) at each, over
    /// the rows of the run.
    #[must_use]
    pub fn take(&self, run: &mut Run) -> Vec<Vec<f64>> {
        run.trajectory.take_last_probes(self.probes.len())
    }

    /// Writes the displacements that [`Shape::take`] gave, with six digits: a drawing shows no
    /// more. The header has the place of each station, in m, or the number of its mass.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be written; it is written whole or not at all.
    pub fn write(&self, path: &Path, time: &[f64], columns: &[Vec<f64>]) -> Result<()> {
        let failed = |error: std::io::Error| Error::io(path.display(), error.to_string(), false).caused_by(error);
        let mut file = WholeFile::create(path)?;
        let names: Vec<&str> =
            std::iter::once("time_s").chain(self.probes.iter().map(|probe| probe.name.as_str())).collect();
        writeln!(file, "{}", names.join(",")).map_err(failed)?;
        for row in (0..time.len()).step_by(time.len().div_ceil(MOST_ROWS).max(1)) {
            let mut line = digits(time.get(row).copied());
            for column in columns {
                line.push_str(&format!(",{:.5e}", column.get(row).copied().unwrap_or(f64::NAN)));
            }
            writeln!(file, "{line}").map_err(failed)?;
        }
        file.finish()
    }

    /// True where there is nothing to draw.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.probes.is_empty()
    }
}

/// Stations along a bar or beam of that length, m: at equal distances, and at the walls and loads,
/// so that what is drawn touches a wall where it does.
fn along(case: &Case, length: f64) -> Vec<(String, Place)> {
    let mut at: Vec<f64> = (0..ALONG).map(|i| length * (i as f64 / (ALONG - 1) as f64)).collect();
    let places = case.places.iter().chain(&case.written.loads);
    at.extend(places.filter_map(|place| if let Place::Position(x) = place { Some(*x) } else { None }));
    at.sort_by(f64::total_cmp);
    at.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * length);
    at.into_iter().map(|x| (column(x), Place::Position(x))).collect()
}

/// The row of the scene that sees `place`, in modal coordinates where the case is reduced to modes.
fn row(case: &Case, place: &Place) -> Option<Row> {
    let row = case.sees(place)?;
    Some(match &case.truncated {
        Some(truncated) => Row::new(truncated.reduction.modes.seen(&row).into_iter().enumerate().collect()),
        None => row,
    })
}

/// The column of the station at `x` m: its digits as part of an identifier, `p` for the point and
/// `m` for a minus.
fn column(x: f64) -> String {
    format!("displacement_at_{}_m", digits(Some(x)).replace('.', "p").replace('-', "m"))
}

/// Where the stations of a table with that header are: in m along the structure, or the numbers of
/// masses; `None` for another table.
#[must_use]
pub fn stations(header: &[String]) -> Option<Vec<f64>> {
    let (first, rest) = header.split_first()?;
    let station = |name: &String| {
        let inner = name.strip_suffix("_m")?;
        let number = inner.strip_prefix("displacement_at_").or(inner.strip_prefix("displacement_of_mass_"))?;
        number.replace('p', ".").replace('m', "-").parse::<f64>().ok()
    };
    (first == "time_s").then(|| rest.iter().map(station).collect()).flatten()
}

#[cfg(test)]
mod tests {
    use super::{column, stations};

    #[test]
    fn a_header_says_where_its_stations_are() {
        let places = [0.0, 0.1, 1.0 / 3.0, 1e-7, 2.5e21];
        let names: Vec<String> = std::iter::once("time_s".to_owned()).chain(places.map(column)).collect();
        assert!(names.iter().all(|name| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')));
        assert_eq!(stations(&names).unwrap(), places);
        assert_eq!(stations(&["time_s".to_owned(), "displacement_of_mass_7_m".to_owned()]).unwrap(), [7.0]);
        assert!(stations(&["time_s".to_owned(), "contact_force_m".to_owned()]).is_none());
    }
}
