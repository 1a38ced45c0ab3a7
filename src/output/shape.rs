//! `shape.csv`: the displacement of the whole structure over time, at stations along it, from which
//! a report draws it in motion.
//!
//! A case names a few probes only; a drawing needs places all along a tube, and every mass of a
//! chain. They are recorded as probes beside those of the case, and taken out of the run again
//! before any other output is made from it.

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

/// Prefix of the columns of a structure in one plane; and of one in two planes, with the direction
/// of each plane, degrees.
const ONE: (&str, f64) = ("displacement_", 0.0);
const PLANES: [(&str, f64); 2] = [("displacement_y_", 0.0), ("displacement_z_", 90.0)];

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
    /// The stations of `case`, in two planes those along y and then those along z. There are no
    /// stations for an oscillator, for matrices and modes, whose places are not in a line, and for
    /// a run of very many rows.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        let places: Vec<(String, Place)> = match &case.model {
            Model::Beam(beam) => along(case, beam.length),
            Model::Bar(bar) => along(case, bar.length),
            Model::Chain(chain) => {
                let every = chain.masses.len().div_ceil(MOST_MASSES).max(1);
                let masses = (0..chain.masses.len()).step_by(every);
                masses.map(|i| (format!("of_mass_{i}_m"), Place::Dof(i))).collect()
            }
            _ => Vec::new(),
        };
        let planes = if case.planes.is_two() { &PLANES[..] } else { &[ONE][..] };
        let rows = case.scene.duration / case.time.sample.unwrap_or(case.time.step).max(case.time.step);
        if 2.0 * rows * (planes.len() * places.len()) as f64 > MOST_VALUES {
            return Self::default();
        }
        let station = |&(plane, degrees): &(&str, f64), (name, place): &(String, Place)| {
            let place = Place::Towards { place: Box::new(place.clone()), degrees };
            Some(Probe { name: format!("{plane}{name}"), at: row(case, &place)? })
        };
        let all = planes.iter().flat_map(|plane| places.iter().map(move |place| (plane, place)));
        Self { probes: all.filter_map(|(plane, place)| station(plane, place)).collect() }
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

    /// Where the stations are.
    #[must_use]
    pub fn stations(&self) -> Option<Stations> {
        let names = self.probes.iter().map(|probe| probe.name.clone());
        Stations::of(&std::iter::once("time_s".to_owned()).chain(names).collect::<Vec<_>>())
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
    let supports = case.written.supports.iter().map(|support| &support.place);
    at.extend(places.chain(supports).filter_map(Place::position));
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

/// The column of the station at `x` m, after its plane: the digits as part of an identifier, `p`
/// for the point and `m` for a minus.
fn column(x: f64) -> String {
    format!("at_{}_m", digits(Some(x)).replace('.', "p").replace('-', "m"))
}

/// The stations of a `shape.csv`.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Where they are: in m along the structure, or the numbers of masses.
    pub places: Vec<f64>,
    /// The planes, 1 or 2, in each of which the table has a displacement of every station.
    pub planes: usize,
}

impl Stations {
    /// The stations of a table with that header; `None` for another table.
    #[must_use]
    pub fn of(header: &[String]) -> Option<Self> {
        let (first, rest) = header.split_first()?;
        let all = |names: &[String], plane: &str| -> Option<Vec<f64>> {
            let station = |name: &String| {
                let inner = name.strip_prefix(plane)?.strip_suffix("_m")?;
                let number = inner.strip_prefix("at_").or(inner.strip_prefix("of_mass_"))?;
                number.replace('p', ".").replace('m', "-").parse::<f64>().ok()
            };
            names.iter().map(station).collect()
        };
        if first != "time_s" {
            return None;
        }
        if let Some(places) = all(rest, ONE.0) {
            return Some(Self { places, planes: 1 });
        }
        let (y, z) = rest.split_at(rest.len() / 2);
        let [y, z] = [all(y, PLANES[0].0)?, all(z, PLANES[1].0)?];
        (y == z).then_some(Self { places: y, planes: 2 })
    }
}

#[cfg(test)]
mod tests {
    use super::{ONE, PLANES, Stations, column};

    fn header(planes: &[(&str, f64)], places: &[f64]) -> Vec<String> {
        let stations = |plane: &str| places.iter().map(|&x| format!("{plane}{}", column(x))).collect::<Vec<_>>();
        let all = planes.iter().flat_map(|(plane, _)| stations(plane));
        std::iter::once("time_s".to_owned()).chain(all).collect()
    }

    #[test]
    fn a_header_says_where_its_stations_are() {
        let places = vec![0.0, 0.1, 1.0 / 3.0, 1e-7, 2.5e21];
        for planes in [&[ONE][..], &PLANES[..]] {
            let names = header(planes, &places);
            assert!(names.iter().all(|name| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')));
            let expected = Stations { places: places.clone(), planes: planes.len() };
            assert_eq!(Stations::of(&names), Some(expected));
        }
        let mass = ["time_s".to_owned(), "displacement_of_mass_7_m".to_owned()];
        assert_eq!(Stations::of(&mass).unwrap().places, [7.0]);
    }

    #[test]
    fn another_header_has_no_stations() {
        let mut names = header(&PLANES, &[0.0, 1.0]);
        names.swap(3, 4);
        assert_eq!(Stations::of(&names), None, "the planes differ");
        assert_eq!(Stations::of(&["time_s".to_owned(), "contact_force_m".to_owned()]), None);
        assert_eq!(Stations::of(&["step".to_owned()]), None);
        assert_eq!(Stations::of(&[]), None);
    }
}
