//! The line of a structure that matrices or modes describe: which of their points lie along it, and
//! where. A drawing follows it, and turbulence acts along it.

use super::builder::Builder;
use super::modal::{PointFile, points};
use super::model::{Model, Place};
use super::planes::Planes;
use super::value::{Section, Value};
use super::written::Line;
use crate::error::{Result, counted};
use crate::order::sort_by_number;
use crate::scene::ModalData;
use std::ops::Range;
use toml::Spanned;

/// A file of a line.
const FILE: PointFile = PointFile {
    values: 1,
    each: "its position, in m",
    description: "expected a row for each point: its name, then its position along the tube, in m, with a comma \
                  between them; a header line above is ignored",
};

/// A point as the file gives it: its name in messages, its place and position, and where it stands.
type Given = (String, Place, f64, Range<usize>);

impl Builder<'_> {
    /// Reads where the points of matrices and modes lie, of the system or of each body.
    pub fn lines(&mut self, file: &Section<'_>) -> Result<()> {
        let Model::Bodies(bodies) = &self.model else {
            return self.own_line("system", &file.required_section("system"));
        };
        for (body, table) in bodies.clone().into_iter().zip(file.sections("body")) {
            let owner = format!("body {:?}", body.name);
            self.on_body(body, |builder| builder.own_line(&owner, &table))?;
        }
        Ok(())
    }

    /// Reads the line in the table of the system or body `owner`, if there is one.
    fn own_line(&mut self, owner: &str, table: &Section<'_>) -> Result<()> {
        let kind = self.model.kind();
        let own = table.section(kind);
        let Some(value) = own.as_ref().and_then(|own| own.get("line")) else { return Ok(()) };
        let key = format!("{owner}: {kind}.line");
        let given = match &self.model.clone() {
            Model::Modal(modal) => self.points_along(&key, value, modal)?,
            _ => self.dofs_along(&key, value)?,
        };
        let points = self.in_order(&key, value, given)?;
        self.written.lines.push(Line { body: self.body.clone(), points });
        Ok(())
    }

    /// The line of the turbulence `owner`, which `table` states, on modes of `body`: its own, or
    /// that of the modes; `None` on a beam, which has positions of its own.
    pub fn line(
        &mut self,
        owner: &str,
        (model, body): (&Model, Option<&str>),
        table: &Section<'_>,
    ) -> Result<Option<Line>> {
        let known = self.written.lines.iter().find(|line| line.body.as_deref() == body);
        let (modal, value) = match (model, table.get("line")) {
            (Model::Modal(modal), Some(value)) => (modal, value),
            (Model::Modal(_), None) if known.is_some() => return Ok(known.cloned()),
            (Model::Modal(_), None) => {
                let help = "expected line = { POINT = 0.0, .. }, the points of shapes along the tube with their \
                            positions in m, or a CSV file with the columns point and position_m, here or beside the \
                            shapes";
                let title = format!("`line` is missing in {owner}, which acts on modes");
                return Err(self.source.error(table.span.clone(), &title, help));
            }
            (_, Some(value)) => {
                let title = format!("{owner}: line beside a beam, which has positions of its own");
                return Err(self.source.error(value.span(), &title, "expected a line beside [system.modal] only"));
            }
            (_, None) => return Ok(None),
        };
        let (key, unknown) = (format!("{owner}: line"), known.is_none());
        let given = self.points_along(&key, value, modal)?;
        let line = Line { body: body.map(str::to_owned), points: self.in_order(&key, value, given)? };
        if unknown {
            self.written.lines.push(line.clone());
        }
        Ok(Some(line))
    }

    /// Points of `modal` with their positions, from a table or a file.
    fn points_along(&mut self, key: &str, value: &Spanned<Value<'_>>, modal: &ModalData) -> Result<Vec<Given>> {
        let wanted = "a table of points and positions in m, { p0 = 0.0, p1 = 0.05 }, or the name of a CSV file";
        let mut given: Vec<Given> = match value.get_ref() {
            Value::Word(file) => {
                let (path, text) = self.open("line", file, value.span(), FILE.description)?;
                let read = points(&path, &text, &FILE)?.into_iter();
                let point = |name: String, at: f64| (format!("{name:?}"), Place::point(&name), at, value.span());
                read.filter_map(|read| Some(point(read.name, *read.shape.first()?))).collect()
            }
            Value::Table(entries) => {
                let read = entries.iter().map(|(name, position)| {
                    let at = self.finite(&format!("{key}: {}", name.get_ref()), position, "a finite number, in m")?;
                    Ok((format!("{:?}", name.get_ref()), Place::point(name.get_ref()), at, name.span()))
                });
                read.collect::<Result<_>>()?
            }
            _ => return Err(self.refuse(value.span(), key, wanted)),
        };
        // A table in a file has its keys in the order of their names; they count as they are
        // written.
        sort_by_number(&mut given, |(_, _, _, span)| span.start as f64);
        let names = self.points_of(modal);
        let known = |place: &Place| names.iter().any(|name| *place == Place::point(name));
        match given.iter().find(|(_, place, _, _)| !known(place)) {
            None => Ok(given),
            Some((name, _, _, span)) => {
                let title = format!("{key} has a point {name} without a shape");
                Err(self.source.error(span.clone(), &title, &format!("expected {}", self.wanted_point(&names))))
            }
        }
    }

    /// Degrees of freedom of matrices with their positions, in two planes one along y and one along
    /// z at each.
    fn dofs_along(&self, key: &str, value: &Spanned<Value<'_>>) -> Result<Vec<Given>> {
        let two = self.planes == Planes::Named;
        let wanted = match two {
            false => "pairs of a degree of freedom and its position in m, [[0, 0.0], [2, 0.05]]",
            true => "the degree of freedom along y, that along z and their position in m, [[0, 1, 0.0], [2, 3, 0.05]]",
        };
        let Value::List(items) = value.get_ref() else { return Err(self.refuse(value.span(), key, wanted)) };
        let number = format!("{key}: degree of freedom");
        let given = items.iter().map(|item| {
            let parts: &[Spanned<Value<'_>>] = if let Value::List(parts) = item.get_ref() { parts } else { &[] };
            let (place, at) = match (parts, two) {
                ([dof, at], false) => (Place::Dof(self.dof(&number, dof, self.n)?), at),
                ([y, z, at], true) => {
                    let [y, z] = [self.dof(&number, y, self.n)?, self.dof(&number, z, self.n)?];
                    (Place::Rows { y: vec![(y, 1.0)], z: vec![(z, 1.0)] }, at)
                }
                _ => return Err(self.refuse(item.span(), key, wanted)),
            };
            let at = self.finite(&format!("{key}: position"), at, "a finite number, in m")?;
            Ok((place.to_string(), place, at, item.span()))
        });
        given.collect()
    }

    /// The points, of which there must be two, and whose positions must increase.
    fn in_order(&self, key: &str, value: &Spanned<Value<'_>>, given: Vec<Given>) -> Result<Vec<(Place, f64)>> {
        if given.len() < 2 {
            let title = format!("{key} has {}", counted(given.len(), "point"));
            return Err(self.source.error(value.span(), &title, "expected two points or more"));
        }
        for pair in given.windows(2) {
            let [(_, _, before, _), (name, _, at, span)] = pair else { continue };
            if at <= before {
                let title = format!("{key}: {name} lies at {at:?} m, after a point at {before:?} m");
                return Err(self.source.error(span.clone(), &title, "expected positions that increase along the tube"));
            }
        }
        Ok(given.into_iter().map(|(_, place, at, _)| (place, at)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_straight_lines_between_the_points() {
        let points = [("a", 1.0), ("b", 2.0), ("c", 4.0)].map(|(name, at)| (Place::point(name), at)).to_vec();
        let line = Line { body: None, points };
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
        let at = |position: f64| match line.at(position) {
            Place::Points(points) => points,
            other => panic!("{other:?}"),
        };
        assert_eq!((at(1.0), at(4.0)), (vec![point("a", 1.0)], vec![point("c", 1.0)]));
        assert_eq!(
            (at(1.75), at(3.5)),
            (vec![point("a", 0.25), point("b", 0.75)], vec![point("b", 0.25), point("c", 0.75)])
        );
    }
}
