//! The picture of a sweep, from its tables: the kind of picture and its columns.

use super::columns::{Source, SweepAxis, is_half_width, of};
use super::measure::Measure;
use crate::error::{Error, Result, names};
use crate::output::results::Results;
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// The kind of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// A measure over one axis, a curve for each wall or probe, each direction and each value of
    /// other axes; points in a random design.
    Line,
    /// A measure over two axes, as colours.
    Heat,
    /// Which attractor each start leads to, over two axes, as tones.
    Basin,
    /// Instants over one axis, up and down in two colours.
    Bifurcation,
    /// One column of the instants over another: a Poincaré section of all rows.
    Section,
    /// What each key changes in a measure, varied one at a time, as bars.
    Tornado,
}

names!(Kind: "kind of figure",
    Line => "line", Heat => "heat", Basin => "basin", Bifurcation => "bifurcation", Section => "section",
    Tornado => "tornado");

/// The picture that is drawn; what is left out is chosen from the sweep. Columns are named in full,
/// or without wall and unit: `approach_speed`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Picture {
    /// Its kind.
    pub kind: Option<Kind>,
    /// The column along the horizontal axis.
    pub x: Option<String>,
    /// The column along the vertical axis.
    pub y: Option<String>,
    /// The column shown by the colours of a heat map.
    pub z: Option<String>,
    /// The wall whose instants or measures are drawn; all walls if `None`.
    pub wall: Option<String>,
}

/// The picture of a sweep as files, one a format; none if the tables contain nothing to draw.
#[derive(Debug, Default)]
pub(crate) struct Pictures {
    pub drawn: Vec<PathBuf>,
    /// Names of what the picture has no room for.
    pub left_out: Vec<String>,
}

/// A picture that has been drawn.
#[derive(Debug)]
pub(super) struct Drawn {
    pub svg: String,
    /// The names of the curves, and of the measures, for which it has no room.
    pub left_out: Vec<String>,
}

impl Drawn {
    /// A picture of everything.
    pub fn complete(svg: String) -> Self {
        Self { svg, left_out: Vec::new() }
    }
}

/// Maximum number of panels.
pub(super) const MOST_PANELS: usize = 4;

/// An axis with fewer values than this becomes separate curves rather than a side of a map.
const FEW: u64 = 6;

impl Picture {
    /// Checks that the tables of `request` have the columns.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a column, [`Error::Invalid`] for a kind that cannot be drawn from
    /// them.
    pub(super) fn check(&self, request: &Map<String, Value>) -> Result<()> {
        let source = Source::new(Path::new(""), request, "");
        if let (Some(wall), false) = (&self.wall, self.kind == Some(Kind::Heat)) {
            let walls = request.get("wall_names").and_then(Value::as_array).cloned().unwrap_or_default();
            if walls.iter().all(|known| known != wall) {
                let known = walls.iter().filter_map(|name| name.as_str().map(str::to_owned)).collect();
                return Err(Error::Unknown { kind: "wall", name: wall.clone(), known });
            }
        }
        let x = || Self::axis(self.x.as_ref(), &source).map(drop);
        let sampled = source.sample_columns.len() > 1;
        let kind = self.kind.or(source.one_at_a_time.then_some(Kind::Tornado));
        match kind.or(sampled.then_some(Kind::Bifurcation)) {
            Some(Kind::Bifurcation | Kind::Section) if !sampled => Err(no_samples()),
            Some(Kind::Section) => {
                self.sampled(self.x.as_ref(), 0, &source)?;
                self.sampled(self.y.as_ref(), 1, &source).map(drop)
            }
            Some(Kind::Bifurcation) => x().and_then(|()| self.sampled(self.y.as_ref(), 0, &source).map(drop)),
            Some(Kind::Tornado) if !source.one_at_a_time => {
                let expected = "design = \"one-at-a-time\" in [run] (--one-at-a-time) beside it";
                Err(Error::invalid("[figure] kind", "tornado", expected))
            }
            Some(Kind::Tornado) => self.measures(self.y.as_ref(), &source).map(drop),
            Some(Kind::Basin) if !source.tells_attractors() => {
                Err(Error::invalid("[figure] kind", "basin", "the measure attractor in [measure] columns beside it"))
            }
            Some(Kind::Basin) => self.sides(&source).map(drop),
            Some(Kind::Heat) => {
                self.sides(&source)?;
                self.measures(self.z.as_ref(), &source).map(drop)
            }
            Some(Kind::Line) => x().and_then(|()| self.measures(self.y.as_ref(), &source).map(drop)),
            None => x(),
        }
    }

    /// Written as JSON, and read from it.
    pub(super) fn document(&self) -> Value {
        json!({ "kind": self.kind.map(Kind::name), "x": self.x, "y": self.y, "z": self.z, "wall": self.wall })
    }

    pub(super) fn from_document(document: &Value) -> Self {
        let word = |key: &str| document[key].as_str().map(str::to_owned);
        let kind = word("kind").and_then(|word| word.parse().ok());
        Self { kind, x: word("x"), y: word("y"), z: word("z"), wall: word("wall") }
    }

    /// Draws the picture of the tables of `results`, of the request `request`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a column that the tables do not have, [`Error::Io`] if they cannot be
    /// read or the picture cannot be written.
    pub(crate) fn draw(&self, results: &mut Results, request: &Map<String, Value>, title: &str) -> Result<Pictures> {
        let Some(drawn) = self.drawn(results.folder(), request, title)? else { return Ok(Pictures::default()) };
        Ok(Pictures { drawn: results.draw("sweep", &drawn.svg)?, left_out: drawn.left_out })
    }

    /// The picture; `None` if there is nothing to draw.
    fn drawn(&self, folder: &Path, request: &Map<String, Value>, title: &str) -> Result<Option<Drawn>> {
        let source = Source::new(folder, request, title);
        let sampled = source.sample_columns.len() > 1;
        let is_map = || !source.random && source.axes.iter().all(|axis| axis.count >= FEW && axis.is_numeric(&source));
        let kind = self.kind.unwrap_or(match source.axes.len() {
            _ if source.one_at_a_time => Kind::Tornado,
            _ if sampled => Kind::Bifurcation,
            2 if is_map() && source.tells_attractors() => Kind::Basin,
            2 if is_map() => Kind::Heat,
            _ => Kind::Line,
        });
        if !sampled && matches!(kind, Kind::Bifurcation | Kind::Section) {
            return Err(no_samples());
        }
        match kind {
            Kind::Tornado => self.tornado(&source),
            Kind::Line => self.line(&source),
            Kind::Heat => self.heat(&source),
            Kind::Basin => Ok(self.basin(&source)?.map(Drawn::complete)),
            Kind::Bifurcation => Ok(self.bifurcation(&source)?.map(Drawn::complete)),
            Kind::Section => Ok(self.section(&source)?.map(Drawn::complete)),
        }
    }

    /// The axis named `asked`, or by default the one along which a picture is drawn.
    pub(super) fn axis<'a>(asked: Option<&String>, source: &'a Source<'_>) -> Result<&'a SweepAxis> {
        let axes = &source.axes;
        let found = match asked {
            Some(name) => axes.iter().find(|axis| axis.column == *name || axis.key == *name || of(&axis.column, name)),
            // The followed one, or else the one with the most values.
            None => axes.iter().rev().max_by_key(|axis| (axis.follows, axis.count)),
        };
        found.ok_or_else(|| Error::Unknown {
            kind: "varied value",
            name: asked.cloned().unwrap_or_default(),
            known: axes.iter().map(|axis| axis.column.clone()).collect(),
        })
    }

    /// The two axes of a map: those requested, else in the order of the file.
    pub(super) fn sides<'a>(&self, source: &'a Source<'_>) -> Result<[&'a SweepAxis; 2]> {
        let named = |asked: &Option<String>| asked.as_ref().map(|name| Self::axis(Some(name), source)).transpose();
        let other = |than: Option<&SweepAxis>| {
            let found = source.axes.iter().find(|axis| than.is_none_or(|than| than.column != axis.column));
            found.ok_or_else(|| Error::invalid("[figure] kind", "heat", "two varied values"))
        };
        Ok(match (named(&self.x)?, named(&self.y)?) {
            (Some(x), Some(y)) => [x, y],
            (Some(x), None) => [x, other(Some(x))?],
            (None, Some(y)) => [other(Some(y))?, y],
            (None, None) => {
                let x = other(None)?;
                [x, other(Some(x))?]
            }
        })
    }

    /// Each measure with each of its columns.
    ///
    /// # Errors
    /// As [`Picture::measures`].
    pub(super) fn measure_columns(&self, source: &Source<'_>) -> Result<Vec<(String, String)>> {
        let of_measure =
            |(measure, names): (String, Vec<String>)| names.into_iter().map(move |name| (measure.clone(), name));
        Ok(self.measures(None, source)?.into_iter().flat_map(of_measure).collect())
    }

    /// The columns named `asked`, or those of all measures, one list for each.
    pub(super) fn measures(&self, asked: Option<&String>, source: &Source<'_>) -> Result<Vec<(String, Vec<String>)>> {
        let from = source.columns.iter().position(|column| column == "error").map_or(0, |index| index + 1);
        let all = source.columns.get(from..).unwrap_or_default();
        let mut groups: Vec<(String, Vec<String>)> = Vec::new();
        for column in all {
            let measure =
                Measure::all().map(Measure::name).filter(|name| of(column, name)).max_by_key(|name| name.len());
            let measure = measure.unwrap_or(column).to_owned();
            if is_half_width(column, &measure) {
                continue;
            }
            let fits = self.wall.as_ref().is_none_or(|wall| column.contains(&format!("_{}", wall.replace('-', "_"))));
            match groups.iter_mut().find(|(name, _)| *name == measure) {
                Some((_, columns)) if fits => columns.push(column.clone()),
                None if fits => groups.push((measure, vec![column.clone()])),
                _ => {}
            }
        }
        let Some(asked) = asked else { return Ok(groups) };
        if let Some(column) = all.iter().find(|column| *column == asked) {
            return Ok(vec![(asked.clone(), vec![column.clone()])]);
        }
        let known = groups.iter().map(|(name, _)| name.clone()).collect();
        let found = groups.into_iter().find(|(name, _)| name == asked);
        found.map(|group| vec![group]).ok_or_else(|| Error::Unknown {
            kind: "measure in the table",
            name: asked.clone(),
            known,
        })
    }
}

/// For a kind of picture that shows samples, where the tables have none.
fn no_samples() -> Error {
    let expected = "samples = \"impacts\" or \"periods\" in [measure] beside it";
    Error::invalid("[figure] kind", "of samples", expected)
}
