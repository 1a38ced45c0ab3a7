//! The line of a tube that modes describe: which of their points lie along it, and where.

use super::builder::Builder;
use super::modal::{PointFile, points};
use super::model::{Model, Place};
use super::value::{Section, Value};
use crate::error::{Result, counted};
use std::ops::Range;

/// A file of a line.
const FILE: PointFile = PointFile {
    values: 1,
    each: "its position, in m",
    description: "expected a row for each point: its name, then its position along the tube, in m, with a comma \
                  between them; a header line above is ignored",
};

/// Points along a tube, whose shape is straight between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TubeLine {
    /// The points with their positions, m, which increase.
    points: Vec<(String, f64)>,
}

impl TubeLine {
    /// Where it begins and ends, m.
    pub fn ends(&self) -> [f64; 2] {
        [self.points.first(), self.points.last()].map(|point| point.map_or(0.0, |point| point.1))
    }

    /// The number of stretches between neighbouring points.
    pub fn stretches(&self) -> usize {
        self.points.len().saturating_sub(1)
    }

    /// The mean displacement from one position to another (m) on the line, as a sum of points.
    pub fn mean(&self, from: f64, to: f64) -> Place {
        let mut weights = vec![0.0; self.points.len()];
        for (index, pair) in self.points.windows(2).enumerate() {
            let [start, end] = [pair[0].1, pair[1].1];
            let (a, b) = (from.max(start), to.min(end));
            if a < b {
                // Of a function that is straight between two points the mean is the value in the
                // middle.
                let (share, second) = ((b - a) / (to - from), (0.5 * (a + b) - start) / (end - start));
                weights[index] += share * (1.0 - second);
                weights[index + 1] += share * second;
            }
        }
        let named = self.points.iter().zip(weights).filter(|(_, weight)| *weight != 0.0);
        Place::Points(named.map(|((name, _), weight)| (name.clone(), weight)).collect())
    }
}

impl Builder<'_> {
    /// The line of the turbulence `owner`, which `table` states, on modes; `None` on a beam, which
    /// has positions of its own.
    pub fn line(&mut self, owner: &str, model: &Model, table: &Section<'_>) -> Result<Option<TubeLine>> {
        let (modal, value) = match (model, table.get("line")) {
            (Model::Modal(modal), Some(value)) => (modal, value),
            (Model::Modal(_), None) => {
                let help = "expected line = { POINT = 0.0, .. }, the points of shapes along the tube with their \
                            positions in m, or a CSV file with the columns point and position_m";
                let title = format!("`line` is missing in {owner}, which acts on modes");
                return Err(self.source.error(table.span.clone(), &title, help));
            }
            (_, Some(value)) => {
                let title = format!("{owner}: line beside a beam, which has positions of its own");
                return Err(self.source.error(value.span(), &title, "expected a line beside [system.modal] only"));
            }
            (_, None) => return Ok(None),
        };
        let key = format!("{owner}: line");
        let wanted = "a table of points and positions in m, { p0 = 0.0, p1 = 0.05 }, or the name of a CSV file";
        let mut given: Vec<(String, f64, Range<usize>)> = match value.get_ref() {
            Value::Word(file) => {
                let (path, text) = self.open(file).map_err(|reason| {
                    let help = format!("{}; its path is relative to the case file", FILE.description);
                    self.source.error(value.span(), &format!("line {file:?}: {reason}"), &help)
                })?;
                let read = points(&path, &text, &FILE)?.into_iter();
                read.filter_map(|point| Some((point.name, *point.shape.first()?, value.span()))).collect()
            }
            Value::Table(entries) => {
                let read = entries.iter().map(|(name, position)| {
                    let at = self.finite(&format!("{key}: {}", name.get_ref()), position, "a finite number, in m")?;
                    Ok((name.get_ref().to_string(), at, name.span()))
                });
                read.collect::<Result<_>>()?
            }
            _ => return Err(self.refuse(value.span(), &key, wanted)),
        };
        if given.len() < 2 {
            let title = format!("{key} has {}", counted(given.len(), "point"));
            return Err(self.source.error(value.span(), &title, "expected two points or more"));
        }
        // A table in a file has its keys in the order of their names; they count as they are
        // written.
        given.sort_by_key(|(_, _, span)| span.start);
        self.check_line(&key, &given, &self.points_of(modal))?;
        Ok(Some(TubeLine { points: given.into_iter().map(|(name, at, _)| (name, at)).collect() }))
    }

    /// Refuses points that are none of `names`, and positions that do not increase.
    fn check_line(&self, key: &str, given: &[(String, f64, Range<usize>)], names: &[&str]) -> Result<()> {
        for (name, _, span) in given {
            if !names.contains(&name.as_str()) {
                let title = format!("{key} has a point {name:?} without a shape");
                return Err(self.source.error(span.clone(), &title, &format!("expected {}", self.wanted_point(names))));
            }
        }
        for pair in given.windows(2) {
            let [(_, before, _), (name, at, span)] = pair else { continue };
            if at <= before {
                let title = format!("{key}: {name:?} lies at {at:?} m, after a point at {before:?} m");
                return Err(self.source.error(span.clone(), &title, "expected positions that increase along the tube"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_straight_lines_between_the_points() {
        let points = [("a", 1.0), ("b", 2.0), ("c", 4.0)].map(|(name, at)| (name.to_owned(), at)).to_vec();
        let line = TubeLine { points };
        let of = |from: f64, to: f64| match line.mean(from, to) {
            Place::Points(points) => points,
            other => panic!("{other:?}"),
        };
        let point = |name: &str, weight: f64| (name.to_owned(), weight);
        assert_eq!((line.ends(), line.stretches()), ([1.0, 4.0], 2));
        // By hand: the hats of a, b and c have the integrals 1/2, 3/2 and 1 over 3 m.
        assert_eq!(of(1.0, 4.0), [point("a", 0.5 / 3.0), point("b", 0.5 / 3.0 + 1.0 / 3.0), point("c", 1.0 / 3.0)]);
        assert_eq!(of(1.25, 1.75), [point("a", 0.5), point("b", 0.5)]);
        assert_eq!(of(3.0, 4.0), [point("b", 0.25), point("c", 0.75)]);
    }
}
