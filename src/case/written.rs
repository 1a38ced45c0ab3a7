//! Contents of a case file that its scene no longer shows: locations, and the files it read.

use super::digest::sha256;
use super::{Case, Place};
#[cfg(feature = "cli")]
use crate::scene::Row;
use crate::scene::{Flats, Load, RandomForce, Scatter, Scene};
use crate::study::truncation::Start;
use crate::wear::Growth;
use serde::Serialize;
use std::borrow::Cow;

/// Contents of the file, in the order of the scene.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Written {
    /// The location of each load.
    pub loads: Vec<Place>,
    /// How the file gave each load.
    pub origins: Vec<Origin>,
    /// The location of each probe.
    pub probes: Vec<Place>,
    /// Each `[[support]]` and `[[slider]]`.
    pub supports: Vec<Support>,
    /// The step, s, where the file gives none and it follows from the modes.
    pub chosen_step: Option<f64>,
    /// The start: given, or a static equilibrium.
    pub start: Start,
    /// The scatter of its velocities; `None` for none.
    pub scattered: Option<ScatteredStart>,
    /// Where the points of matrices and modes lie, of the system or of bodies; of those whose place
    /// is not stated there is none.
    pub lines: Vec<Line>,
    /// The largest damping ratio that the file gives.
    pub damping_ratio: Option<f64>,
    /// Every file that was read.
    pub files: Vec<FileRead>,
}

/// Points along a structure, whose shape is straight between them.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Line {
    /// The body on which they are, where there are several.
    pub body: Option<String>,
    /// The points as places on that body, with their positions, m, which increase.
    pub points: Vec<(Place, f64)>,
}

/// A start whose velocities scatter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ScatteredStart {
    /// Their deviates, which the start of the scene has.
    pub scatter: Scatter,
    /// The velocities about which they scatter, of the degrees of freedom of the scene, m/s.
    pub mean: Vec<f64>,
}

/// How the file gave a load.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Origin {
    /// By its numbers or as a table, which the scene shows.
    Stated,
    /// As a random force.
    Random {
        /// The force, of which the scene has a table.
        force: RandomForce,
        /// The file of its density, where there is one.
        file: Option<String>,
        /// True if the file asks for independent signals along y and z; this is the one along y.
        both: bool,
    },
    /// The signal along z of such a force; these come after all loads of the file.
    Second(RandomForce),
    /// As the dashpots at a base that moves under fixed walls; these come after all loads of the
    /// file.
    Dashpots,
    /// As a motion of the base, of which more loads may come after all loads of the file.
    Base {
        /// The motion, in words.
        motion: String,
        /// What the walls do meanwhile.
        walls: WallsOverBase,
    },
    /// As a random acceleration of the base, with which walls move.
    RandomBase {
        /// The force on the mass that moves along, of which the scene has a table.
        force: RandomForce,
        /// That mass, kg.
        mass: f64,
    },
    /// As gravity of this acceleration, m/s².
    Gravity(f64),
}

impl Origin {
    /// The force of a random load.
    pub(super) fn random(&self) -> Option<&RandomForce> {
        match self {
            Self::Random { force, .. } | Self::Second(force) | Self::RandomBase { force, .. } => Some(force),
            Self::Stated | Self::Dashpots | Self::Base { .. } | Self::Gravity(_) => None,
        }
    }

    /// The key of the load under which its seed stands; `None` for loads without a seed of their
    /// own.
    pub(super) fn seed_key(&self) -> Option<&'static str> {
        match self {
            Self::Random { .. } => Some("random"),
            Self::RandomBase { .. } => Some("base"),
            Self::Stated | Self::Second(_) | Self::Dashpots | Self::Base { .. } | Self::Gravity(_) => None,
        }
    }

    /// What the walls do over a base that moves; `None` for other loads.
    pub(super) fn walls(&self) -> Option<WallsOverBase> {
        match self {
            Self::Base { walls, .. } => Some(*walls),
            Self::RandomBase { .. } => Some(WallsOverBase::Moving),
            _ => None,
        }
    }
}

/// What walls do while the base moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallsOverBase {
    /// They move with the base, and displacements are relative to it.
    Moving,
    /// They stay where they are, and displacements are those in space.
    Fixed,
}

/// A load of the scene, its location, and how the file gave it.
pub(super) struct NewLoad {
    pub load: Load,
    pub place: Place,
    pub origin: Origin,
}

/// The data of a support that the scene does not hold.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Support {
    /// Its name.
    pub name: String,
    /// The location that it surrounds.
    pub place: Place,
    /// What stands there.
    pub shape: SupportShape,
    /// The values on which the depth of a scar there depends.
    pub wear: WearData,
    /// What wear does to its gaps over the years.
    pub growth: Growth,
}

/// What stands at a support.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SupportShape {
    /// These flats, with their place on the system of the file.
    Flats(Flats),
    /// A round hole.
    Round,
    /// A slider, of [`Case::sliders`].
    Slider,
}

/// The values on which the depth of a scar at a support depends.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WearData {
    /// Width of the support and radius of the tube that slides there, m.
    pub scar: Option<(f64, f64)>,
    /// Radius of the tube on the other side, m, where the support stands between places on two.
    pub other_tube: Option<f64>,
    /// Thickness of the tube's wall, m, where the support gives it: that of a beam is in its
    /// section.
    pub wall: Option<f64>,
    /// Wear coefficient of the tube there, 1/Pa; `None` where that of `[wear]` holds.
    pub coefficient: Option<f64>,
    /// Wear coefficient of the support, 1/Pa, likewise.
    pub support_coefficient: Option<f64>,
}

impl WearData {
    /// True if the support has a wear coefficient of its own, of tube or support.
    pub(super) fn has_coefficient(&self) -> bool {
        self.coefficient.or(self.support_coefficient).is_some()
    }
}

/// A file that a case read.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct FileRead {
    /// Its name in the case file.
    pub file: String,
    /// Path where it was found; only the name for a built-in case.
    pub path: String,
    /// Its length, bytes.
    pub bytes: usize,
    /// The SHA-256 of its bytes, as `sha256sum` prints it.
    pub sha256: String,
}

impl Line {
    /// Where it begins and ends, m.
    pub(super) fn ends(&self) -> [f64; 2] {
        [self.points.first(), self.points.last()].map(|point| point.map_or(0.0, |point| point.1))
    }

    /// The number of stretches between neighbouring points.
    pub(super) fn stretches(&self) -> usize {
        self.points.len().saturating_sub(1)
    }

    /// The displacement at `position` (m) on the line, as a sum of points of modes.
    pub(super) fn at(&self, position: f64) -> Place {
        self.sum([(position, 1.0)])
    }

    /// The mean displacement from one position to another (m) on the line, as a sum of points of
    /// modes.
    pub(super) fn mean(&self, from: f64, to: f64) -> Place {
        self.sum(self.points.windows(2).filter_map(|pair| {
            let (a, b) = (from.max(pair[0].1), to.min(pair[1].1));
            // The mean of what is straight between two points is the value in the middle.
            (a < b).then(|| (0.5 * (a + b), (b - a) / (to - from)))
        }))
    }

    /// The sum of the displacements at positions (m), each with its weight.
    fn sum(&self, positions: impl IntoIterator<Item = (f64, f64)>) -> Place {
        let mut weights = vec![0.0; self.points.len()];
        for (position, weight) in positions {
            let after = self.points.partition_point(|point| point.1 <= position);
            let first = after.clamp(1, self.stretches().max(1)) - 1;
            let Some([start, end]) = self.points.get(first..first + 2) else { continue };
            let second = (position - start.1) / (end.1 - start.1);
            weights[first] += weight * (1.0 - second);
            weights[first + 1] += weight * second;
        }
        let weighed = self.points.iter().zip(weights).filter(|(_, weight)| *weight != 0.0);
        let named = weighed.flat_map(|((place, _), weight)| {
            let Place::Points(points) = place else { return Vec::new() };
            points.iter().map(|(name, _)| (name.clone(), weight)).collect()
        });
        Place::Points(named.collect())
    }
}

#[cfg(feature = "cli")]
impl Case {
    /// The line along which the matrices or modes of the system lie, or those of the body of that
    /// name, where the file states it.
    pub(crate) fn line(&self, body: Option<&str>) -> Option<&Line> {
        self.written.lines.iter().find(|line| line.body.as_deref() == body)
    }

    /// The places of which `place` is made, two of a relative one: the body of each, where there
    /// are several, and where along a bar, a beam or a line it is, m.
    pub(crate) fn ends<'a>(&'a self, place: &'a Place) -> Vec<(Option<&'a str>, Option<f64>)> {
        let end = |body: Option<&'a str>, place: &Place| {
            let on_line = || self.line(body)?.points.iter().find(|point| point.0 == *place).map(|point| point.1);
            (body, place.position().or_else(on_line))
        };
        match place {
            Place::On { body, place } => vec![end(Some(body), place)],
            Place::Towards { place, .. } => self.ends(place),
            Place::Relative { place, to } => [self.ends(place), self.ends(to)].concat(),
            place => vec![end(None, place)],
        }
    }
}

/// Files are equal if their names and contents are, wherever they were found.
impl PartialEq for FileRead {
    fn eq(&self, other: &Self) -> bool {
        (&self.file, self.bytes, &self.sha256) == (&other.file, other.bytes, &other.sha256)
    }
}

impl Case {
    /// The scene without its sliders, in the degrees of freedom of the structure alone.
    #[must_use]
    pub fn without_sliders(&self) -> Cow<'_, Scene> {
        match self.sliders.len() {
            0 => Cow::Borrowed(&self.scene),
            count => Cow::Owned(self.scene.without_sliders(count)),
        }
    }
}

#[cfg(feature = "cli")]
impl Case {
    /// The number of tables `[[load]]`; the scene has more loads where one of them makes two.
    pub(crate) fn loads_of_file(&self) -> usize {
        let own = |origin: &&Origin| !matches!(origin, Origin::Second(_) | Origin::Dashpots);
        self.written.origins.iter().filter(own).count()
    }

    /// The row of a location of the file in the scene that is condensed but not reduced; `None`
    /// where it includes condensed degrees of freedom.
    pub(crate) fn sees(&self, place: &Place) -> Option<Row> {
        let row = self.planes.row(&self.model, place).ok()?;
        self.condensation.as_ref().map_or(Some(row.clone()), |condensation| condensation.row(&row))
    }
}

impl FileRead {
    /// The file of that name, found at `path`.
    pub(super) fn new(file: &str, path: &str, text: &str) -> Self {
        let path = if std::path::Path::new(path).exists() {
            std::path::absolute(path).map_or_else(|_| path.to_owned(), |path| path.display().to_string())
        } else {
            path.to_owned()
        };
        Self { file: file.to_owned(), path, bytes: text.len(), sha256: sha256(text.as_bytes()) }
    }
}
