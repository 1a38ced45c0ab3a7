//! The system of a case, and the rows of locations on it.

use crate::error::Result;
use crate::scene::{Bar, Beam, Chain, ModalData, Row};
use std::fmt;
use std::ops::Range;

/// The system as the file describes it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Model {
    /// `[system.oscillator]`.
    Oscillator,
    /// `[system.chain]`.
    Chain(Chain),
    /// `[system.bar]`.
    Bar(Bar),
    /// `[system.beam]`.
    Beam(Beam),
    /// `[system.matrices]`, with this many degrees of freedom.
    Matrices(usize),
    /// `[system.modal]`.
    Modal(ModalData),
    /// `[[body]]`: several systems, which only walls and supports couple.
    Bodies(Vec<Body>),
}

/// One of several bodies of a case.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Body {
    /// Its name.
    pub name: String,
    /// The system of its table.
    pub model: Model,
    /// Where the spans of a beam end, m, in order.
    pub joints: Vec<f64>,
    /// Its degrees of freedom among those of all bodies, in one plane.
    pub dofs: Range<usize>,
}

impl Model {
    /// Its name in the file.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Oscillator => "oscillator",
            Self::Chain(_) => "chain",
            Self::Bar(_) => "bar",
            Self::Beam(_) => "beam",
            Self::Matrices(_) => "matrices",
            Self::Modal(_) => "modal",
            Self::Bodies(_) => "bodies",
        }
    }

    /// Length of a bar or beam, m; `None` for the others, which have no positions.
    pub(super) fn length(&self) -> Option<f64> {
        match self {
            Self::Bar(bar) => Some(bar.length),
            Self::Beam(beam) => Some(beam.length),
            _ => None,
        }
    }

    /// The body of that name; `None` where there is none.
    pub(crate) fn body(&self, name: &str) -> Option<&Body> {
        let Self::Bodies(bodies) = self else { return None };
        bodies.iter().find(|body| body.name == name)
    }

    /// The systems of all bodies, or the one system.
    pub(super) fn systems(&self) -> Box<dyn Iterator<Item = &Self> + '_> {
        match self {
            Self::Bodies(bodies) => Box::new(bodies.iter().map(|body| &body.model)),
            one => Box::new(std::iter::once(one)),
        }
    }

    /// The beam on which a place is, of a relative one the first; `None` where it is on none.
    #[must_use]
    pub fn beam(&self, place: &Place) -> Option<&Beam> {
        match (self, place) {
            (Self::Beam(beam), _) => Some(beam),
            (Self::Bodies(_), Place::On { body, place }) => self.body(body)?.model.beam(place),
            (Self::Bodies(_), Place::Towards { place, .. } | Place::Relative { place, .. }) => self.beam(place),
            _ => None,
        }
    }

    /// The row of a location; errors are those of the bar, beam or modes. Positions and points on
    /// other systems give an empty row.
    pub(super) fn row(&self, place: &Place) -> Result<Row> {
        match (place, self) {
            (Place::Dof(i), _) => Ok(Row::dof(*i)),
            (Place::Row(entries), _) => Ok(Row::new(entries.clone())),
            (Place::Position(x), Self::Bar(bar)) => bar.at(*x),
            (Place::Position(x), Self::Beam(beam)) => beam.at(*x),
            (Place::Spread { from, to }, Self::Bar(bar)) => bar.spread(*from, *to),
            (Place::Spread { from, to }, Self::Beam(beam)) => beam.spread(*from, *to),
            (Place::Points(points), Self::Modal(modal)) => modal.at_sum(points),
            (Place::On { body, place }, Self::Bodies(_)) => match self.body(body) {
                Some(body) => Ok(body.model.row(place)?.shifted(body.dofs.start)),
                None => Ok(Row::new(Vec::new())),
            },
            (Place::Relative { place, to }, _) => Ok(self.row(place)?.relative_to(&self.row(to)?)),
            (Place::Position(_) | Place::Spread { .. } | Place::Points(_) | Place::On { .. }, _) => {
                Ok(Row::new(Vec::new()))
            }
            // These have rows only together with the planes.
            (Place::Rows { .. } | Place::Towards { .. }, _) => Ok(Row::new(Vec::new())),
        }
    }

    /// The number of locations of a system of `n` degrees of freedom, held ones included.
    pub(super) fn places(&self, n: usize) -> usize {
        match self {
            Self::Modal(modal) => modal.points.len(),
            Self::Bar(bar) => bar.elements + 1,
            Self::Beam(beam) => beam.elements + 1,
            _ => n,
        }
    }

    /// A location that every system of this kind has, with its name: the middle of a bar or beam,
    /// the first point of modes, the first degree of freedom.
    pub(super) fn typical_place(&self) -> (String, Place) {
        match self {
            Self::Bodies(bodies) => match bodies.first() {
                Some(Body { name, model, .. }) => {
                    let (there, place) = model.typical_place();
                    (format!("{name}-{there}"), place.on(Some(name)))
                }
                None => ("dof-0".to_owned(), Place::Dof(0)),
            },
            Self::Bar(Bar { length, .. }) | Self::Beam(Beam { length, .. }) => {
                ("middle".to_owned(), Place::Position(0.5 * length))
            }
            Self::Modal(ModalData { points, .. }) if !points.is_empty() => {
                (points[0].name.clone(), Place::point(&points[0].name))
            }
            _ => ("dof-0".to_owned(), Place::Dof(0)),
        }
    }

    /// Every location of a system of `n` degrees of freedom that can move, with its number or name:
    /// each mass, each degree of freedom of matrices, each node of a bar or beam, each point of
    /// modes.
    pub(super) fn each(&self, n: usize) -> Vec<(String, Place)> {
        if let Self::Modal(modal) = self {
            let points = modal.points.iter().filter(|point| point.shape.iter().any(|x| *x != 0.0));
            return points.map(|point| (point.name.clone(), Place::point(&point.name))).collect();
        }
        let (elements, length) = match self {
            Self::Bar(bar) => (bar.elements, bar.length),
            Self::Beam(beam) => (beam.elements, beam.length),
            _ => return (0..n).map(|i| (i.to_string(), Place::Dof(i))).collect(),
        };
        let nodes = (0..=elements).map(|i| (i.to_string(), Place::Position(length * (i as f64 / elements as f64))));
        nodes.filter(|(_, place)| self.row(place).is_ok_and(|row| !row.entries().is_empty())).collect()
    }
}

/// The location of a wall, load or probe, as the file gives it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Place {
    /// A degree of freedom, from 0.
    Dof(usize),
    /// A position along a bar or beam, m from its left end.
    Position(f64),
    /// Pairs (degree of freedom, weight).
    Row(Vec<(usize, f64)>),
    /// A stretch of a bar or beam, m from its left end: a load is spread evenly over it, a probe
    /// records the mean.
    Spread {
        /// Where it begins.
        from: f64,
        /// Where it ends.
        to: f64,
    },
    /// Points of modes with weights: one point of weight 1, or a sum of several. In two planes each
    /// has a shape along +y, NAME-y, and one along +z, NAME-z.
    Points(Vec<(String, f64)>),
    /// For matrices of both planes: pairs (degree of freedom, weight) of the displacement along +y,
    /// and of that along +z.
    Rows {
        /// Along +y.
        y: Vec<(usize, f64)>,
        /// Along +z.
        z: Vec<(usize, f64)>,
    },
    /// A place on one of several bodies.
    On {
        /// The name of the body.
        body: String,
        /// The place there.
        place: Box<Place>,
    },
    /// A place whose displacement is that relative to another place.
    Relative {
        /// The place.
        place: Box<Place>,
        /// The other one, whose displacement is subtracted.
        to: Box<Place>,
    },
    /// A place in two planes, in one direction.
    Towards {
        /// The place in the cross-section.
        place: Box<Place>,
        /// The direction, degrees from +y towards +z.
        degrees: f64,
    },
}

impl Place {
    /// The same place on the body of that name, where there is one.
    pub(crate) fn on(self, body: Option<&str>) -> Self {
        match body {
            Some(body) => Self::On { body: body.to_owned(), place: Box::new(self) },
            None => self,
        }
    }

    /// A single point of modes.
    #[must_use]
    pub fn point(name: &str) -> Self {
        Self::Points(vec![(name.to_owned(), 1.0)])
    }

    /// Where along a bar or beam the place is, m; `None` of another place.
    #[must_use]
    pub fn position(&self) -> Option<f64> {
        match self {
            Self::Position(x) => Some(*x),
            Self::Towards { place, .. } | Self::On { place, .. } | Self::Relative { place, .. } => place.position(),
            _ => None,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dof(i) => write!(f, "degree of freedom {i}"),
            Self::Position(x) => write!(f, "{x} m along it"),
            Self::Row(entries) => f.write_str(&sum(entries)),
            Self::Rows { y, z } => write!(f, "y = {}, z = {}", sum(y), sum(z)),
            Self::Towards { place, degrees } => write!(f, "{place}, towards {degrees}°"),
            Self::On { body, place } => write!(f, "{place} (body {body:?})"),
            Self::Relative { place, to } => write!(f, "{place}, relative to {to}"),
            Self::Points(points) => match points.as_slice() {
                [(name, 1.0)] => write!(f, "the point {name:?}"),
                _ => {
                    let term = |(name, weight): &(String, f64)| format!("{weight} {name}");
                    f.write_str(&points.iter().map(term).collect::<Vec<_>>().join(" + "))
                }
            },
            Self::Spread { from, to } => write!(f, "from {from} to {to} m along it"),
        }
    }
}

/// A weighted sum of degrees of freedom, in words.
fn sum(entries: &[(usize, f64)]) -> String {
    let term = |(i, weight): &(usize, f64)| format!("{weight} q{i}");
    entries.iter().map(term).collect::<Vec<_>>().join(" + ")
}
