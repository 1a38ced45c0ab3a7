//! `shape.csv`: the displacement of the whole structure over time, at stations along it, from which
//! a report draws it in motion.
//!
//! A case names a few probes only; a drawing needs places all along a tube, and every mass of a
//! chain. They are recorded as probes beside those of the case, and taken out of the run again
//! before any other output is made from it.

use super::atomic::WholeFile;
use super::csv::digits;
use crate::case::{Body, Case, Line, Model, Place};
use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::run::Run;
use crate::scene::{Bar, Beam, Probe, Row, Scene};
use std::io::Write;
use std::path::Path;

/// The file's name.
pub const FILE: &str = "shape.csv";

/// Prefix of the columns of a structure in one plane; and of one in two planes, with the direction
/// of each plane, degrees.
const ONE: (&str, f64) = ("displacement_", 0.0);
const PLANES: [(&str, f64); 2] = [("displacement_y_", 0.0), ("displacement_z_", 90.0)];

/// What begins the name of a station, after its plane: the body, where there are several, and how
/// its place is told, by a position along a bar or beam or by the number of a mass.
const BODY: &str = "of_";
const AT: &str = "at_";
const MASS: &str = "of_mass_";

/// What begins the name of a station at a wall of matrices or modes, before the number of the wall,
/// from 0, and its name.
const WALL: &str = "of_wall_";

/// Stations at equal distances along a bar or beam, beside those at walls and loads; and most
/// masses of a chain, or walls of matrices and modes.
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
    /// The stations of `case`, in two planes those along y and then those along z; of several
    /// bodies, in each plane body by body. Where the file does not say along which line matrices or
    /// modes lie, their stations are, in one plane, the walls where no probe watches, and in two
    /// there are none. There are none either for an oscillator that is the system, and for a run of
    /// very many rows.
    #[must_use]
    pub fn of(case: &Case) -> Self {
        let places: Vec<(String, Place)> = match &case.model {
            Model::Bodies(bodies) => bodies.iter().flat_map(|body| on_body(case, body)).collect(),
            Model::Matrices(_) | Model::Modal(_) if !case.planes.is_two() && case.line(None).is_none() => {
                unwatched(case)
            }
            model => along(case, model, None),
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
        // No probe of a case has a name with a space.
        scene
            .probes
            .extend(self.probes.iter().map(|Probe { name, at }| Probe { name: format!("at {name}"), at: at.clone() }));
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

/// The stations on one of several bodies; an oscillator is a chain of one mass.
fn on_body<'a>(case: &'a Case, body: &'a Body) -> impl Iterator<Item = (String, Place)> + 'a {
    let stations = match &body.model {
        Model::Oscillator => vec![mass(0)],
        model => along(case, model, Some(&body.name)),
    };
    stations.into_iter().map(|(name, place)| (format!("{BODY}{}_{name}", body.name), place.on(Some(&body.name))))
}

/// The stations along `model`, the system or the body of that name: of a bar or beam at equal
/// distances, of matrices and modes on a line at their points, and at the walls and loads, so that
/// what is drawn touches a wall where it does; of a chain its masses.
fn along(case: &Case, model: &Model, body: Option<&str>) -> Vec<(String, Place)> {
    let mut at: Vec<(f64, Place)> = match model {
        Model::Beam(Beam { length, .. }) | Model::Bar(Bar { length, .. }) => {
            let share = |i: usize| length * (i as f64 / (ALONG - 1) as f64);
            (0..ALONG).map(|i| (share(i), Place::Position(share(i)))).collect()
        }
        Model::Chain(chain) => {
            let every = chain.masses.len().div_ceil(MOST_MASSES).max(1);
            return (0..chain.masses.len()).step_by(every).map(mass).collect();
        }
        _ => case.line(body).map_or_else(Vec::new, on_line),
    };
    let (Some(begin), Some(end)) = (at.first().map(|at| at.0), at.last().map(|at| at.0)) else { return Vec::new() };
    let places = case.places.iter().chain(&case.written.loads);
    let supports = case.written.supports.iter().map(|support| &support.place);
    let touched = places.chain(supports).flat_map(|place| case.ends(place)).filter(|one| one.0 == body);
    let point = |x: f64| case.line(body).and_then(|line| line.points.iter().find(|point| point.1 == x));
    let station = |x: f64| (x, point(x).map_or(Place::Position(x), |point| point.0.clone()));
    at.extend(touched.filter_map(|one| one.1).map(station));
    sort_by_number(&mut at, |a| a.0);
    at.dedup_by(|a, b| (a.0 - b.0).abs() <= 1e-9 * (end - begin));
    at.into_iter().map(|(x, place)| (column(x), place)).collect()
}

/// The points of a line, of very many some at equal numbers of points, with the last.
fn on_line(line: &Line) -> Vec<(f64, Place)> {
    let every = line.points.len().div_ceil(MOST_MASSES).max(1);
    let points = line.points.iter().step_by(every).chain(line.points.last());
    points.map(|(place, x)| (*x, place.clone())).collect()
}

/// The walls where no probe watches, of several at one place the first.
fn unwatched(case: &Case) -> Vec<(String, Place)> {
    let mut known: Vec<&Place> = case.written.probes.iter().collect();
    let mut all = Vec::new();
    for (wall, place) in case.places.iter().enumerate().filter(|(_, place)| case.sees(place).is_some()) {
        if !known.contains(&place) && all.len() < MOST_MASSES {
            known.push(place);
            let name = case.scene.wall_name(wall).unwrap_or_default().replace('-', "_");
            all.push((format!("{WALL}{wall}_{name}_m"), place.clone()));
        }
    }
    all
}

/// The station of a mass of a chain.
fn mass(i: usize) -> (String, Place) {
    (format!("{MASS}{i}_m"), Place::Dof(i))
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
    format!("{AT}{}_m", digits(Some(x)).replace('.', "p").replace('-', "m"))
}

/// The stations of a `shape.csv`.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Those of the system, or of each body.
    pub bodies: Vec<BodyStations>,
    /// The planes, 1 or 2, in each of which the table has a displacement of every station.
    pub planes: usize,
}

/// The stations on the system or on one of several bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyStations {
    /// The body's name; empty where there is one system.
    pub name: String,
    /// Where they are: in m along the structure, or the numbers of masses or walls.
    pub places: Vec<f64>,
    /// The number of its first one among those of a plane.
    pub first: usize,
}

impl Stations {
    /// The stations of a table with that header; `None` for another table.
    #[must_use]
    pub fn of(header: &[String]) -> Option<Self> {
        let (first, rest) = header.split_first()?;
        if first != "time_s" {
            return None;
        }
        if let Some(bodies) = BodyStations::all(rest, ONE.0) {
            return Some(Self { bodies, planes: 1 });
        }
        let (y, z) = rest.split_at(rest.len() / 2);
        let [y, z] = [BodyStations::all(y, PLANES[0].0)?, BodyStations::all(z, PLANES[1].0)?];
        (y == z).then_some(Self { bodies: y, planes: 2 })
    }

    /// The number of stations in a plane.
    #[must_use]
    pub fn count(&self) -> usize {
        self.bodies.iter().map(|body| body.places.len()).sum()
    }

    /// The numbers of the columns after the time that have a body's stations, those along y first.
    pub fn columns(&self, body: &BodyStations) -> impl Iterator<Item = usize> {
        let (count, first, own) = (self.count(), body.first, body.places.len());
        (0..self.planes).flat_map(move |plane| (0..own).map(move |k| plane * count + first + k))
    }
}

impl BodyStations {
    /// The bodies of columns of those `names`, which begin with `plane`.
    fn all(names: &[String], plane: &str) -> Option<Vec<Self>> {
        let mut bodies: Vec<Self> = Vec::new();
        for (index, name) in names.iter().enumerate() {
            let (body, place) = station(name.strip_prefix(plane)?.strip_suffix("_m")?)?;
            match bodies.last_mut().filter(|last| last.name == body) {
                Some(last) => last.places.push(place),
                None => bodies.push(Self { name: body.to_owned(), places: vec![place], first: index }),
            }
        }
        Some(bodies)
    }
}

/// The body and the place of a station, of its name without plane and unit.
fn station(name: &str) -> Option<(&str, f64)> {
    let number = |text: &str| text.replace('p', ".").replace('m', "-").parse::<f64>().ok();
    let alone = [AT, MASS].into_iter().find_map(|before| name.strip_prefix(before)).and_then(number);
    let wall = || name.strip_prefix(WALL)?.split('_').next()?.parse().ok();
    if let Some(place) = alone.or_else(wall) {
        return Some(("", place));
    }
    let named = name.strip_prefix(BODY)?;
    [AT, MASS].into_iter().find_map(|before| {
        let (body, place) = named.rsplit_once(before)?;
        Some((body.strip_suffix('_')?, number(place)?))
    })
}

#[cfg(test)]
mod tests {
    use super::{BodyStations, ONE, PLANES, Stations, column};

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
            let own = BodyStations { name: String::new(), places: places.clone(), first: 0 };
            let expected = Stations { bodies: vec![own], planes: planes.len() };
            assert_eq!(Stations::of(&names), Some(expected));
        }
        let mass = ["time_s".to_owned(), "displacement_of_mass_7_m".to_owned()];
        assert_eq!(Stations::of(&mass).unwrap().bodies[0].places, [7.0]);
        let walls = ["time_s", "displacement_of_wall_0_m", "displacement_of_wall_12_r_upper_m"].map(str::to_owned);
        assert_eq!(Stations::of(&walls).unwrap().bodies[0].places, [0.0, 12.0]);
    }

    #[test]
    fn bodies_keep_their_names_whatever_these_look_like() {
        for name in ["left", "y", "mass", "at", "a-b_of_mass_2", "of_at_1_m"] {
            for planes in [&[ONE][..], &PLANES[..]] {
                let of = |plane: &str| {
                    let own = [0.0, 0.5].map(|x| format!("{plane}of_{name}_{}", column(x)));
                    own.into_iter().chain([format!("{plane}of_post_of_mass_0_m")]).collect::<Vec<_>>()
                };
                let mut header = vec!["time_s".to_owned()];
                header.extend(planes.iter().flat_map(|(plane, _)| of(plane)));
                let stations = Stations::of(&header).unwrap();
                let body = |name: &str, places: &[f64], first| BodyStations {
                    name: name.to_owned(),
                    places: places.to_vec(),
                    first,
                };
                assert_eq!(stations.bodies, [body(name, &[0.0, 0.5], 0), body("post", &[0.0], 2)]);
                let last: Vec<usize> = stations.columns(&stations.bodies[1]).collect();
                assert_eq!(last, [2, 5][..planes.len()]);
            }
        }
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
