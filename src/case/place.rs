//! Reads the key `at`: the location of walls, loads and probes.

use super::builder::Builder;
use super::model::{Model, Place};
use super::planes::Planes;
use super::points::listed;
use super::value::{Entry, Name, Section, Value};
use crate::error::{Error, Part, Result, Subject};
use crate::scene::{BeamEnd, Row};
use toml::Spanned;

/// A location, its row, and the suffix of the names there: empty, or `-` and a number where `at` is
/// "each".
#[derive(Debug, Clone)]
pub(super) struct Site {
    pub suffix: String,
    pub place: Place,
    pub row: Row,
}

/// Most walls, and most probes, of a scene; each of them has its own results.
pub(super) const MOST_PLACES: usize = 4096;

/// What is located, on which the values of `at` depend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Located {
    /// A load, which may be spread.
    Load,
    /// A support, around one place with a displacement along y and one along z.
    Support,
    /// A wall, slider or probe, of which each place may have one.
    Other,
}

/// True for the name of a plane.
fn is_plane(name: &str) -> bool {
    name == "y" || name == "z"
}

impl Builder<'_> {
    /// The values of `at` that this system, or the body whose places are read, accepts.
    fn takes(&self, located: Located) -> String {
        // A row has one displacement, and a support surrounds one place.
        let (spread, around) = (located == Located::Load, located == Located::Support);
        if let Model::Bodies(_) = self.model {
            let row = if around { "" } else { ", row" };
            return format!(
                "at = {{ body = .., position = .. }}, or dof, joint, point{row} in place of position; body is {}",
                self.names_of_bodies()
            );
        }
        let each = match &self.body {
            Some(body) => format!(", each beside body = {body:?}"),
            None if spread || around => String::new(),
            None => ", or \"each\"".to_owned(),
        };
        let last = self.n.saturating_sub(1);
        if let Model::Modal(modal) = &self.model {
            let names = self.points_of(modal);
            let first = names.first().copied().unwrap_or("tip");
            let of = if names.is_empty() { "shapes names none".to_owned() } else { format!("of {}", listed(&names)) };
            let points = format!("at = {{ point = {first:?} }} ({of}), {{ points = [[{first:?}, 1.0], [.., -1.0]] }}");
            return if self.planes == Planes::Named {
                let row = if around { "" } else { ", or { row = [[0, 1.0]] } without direction" };
                format!("{points}, with the shapes {first}-y and {first}-z{row}")
            } else {
                format!("{points}, {{ dof = 0 to {last} }}, a mode{each}")
            };
        }
        let dof = match self.planes {
            Planes::Named => {
                let row = if around { "" } else { ", or { row = [[0, 1.0], [1, -1.0]] } without direction" };
                return format!("at = {{ y = [[0, 1.0]], z = [[1, 1.0]] }}, degrees of freedom 0 to {last}{row}");
            }
            _ if around => format!("{{ dof = 0 to {last} }}"),
            _ => format!("{{ dof = 0 to {last} }}, {{ row = [[0, 1.0], [1, -1.0]] }}"),
        };
        // The last joint is the right end, where nothing can touch what is held.
        let held = matches!(&self.model, Model::Beam(beam) if matches!(beam.right, BeamEnd::Pinned | BeamEnd::Clamped));
        let joint = match self.joints.len().saturating_sub(usize::from(held)) {
            0 => String::new(),
            1 => ", { joint = 1 }".to_owned(),
            count => format!(", {{ joint = 1 to {count} }}"),
        };
        let dof = format!("{dof}{joint}");
        match self.model.length() {
            Some(length) if spread => {
                format!("at = {{ position = 0 to {length:?} m }}, {{ spread = [from, to] }} in m, {dof}{each}")
            }
            Some(length) => format!("at = {{ position = 0 to {length:?} m }}, {dof}{each}"),
            None => format!("at = {dof}{each}"),
        }
    }

    /// The locations that `at` in the table of `owner` refers to. `owner` is the wall, load or
    /// probe, by name and as the subject of errors. Only loads may be spread.
    pub fn sites(
        &mut self,
        (owner, subject): (&str, Subject),
        table: &Section<'_>,
        located: Located,
    ) -> Result<Vec<Site>> {
        let key = format!("{owner}: at");
        let Some(at) = table.get("at") else {
            if self.n == 1 {
                return Ok(vec![Site { suffix: String::new(), place: Place::Dof(0), row: Row::dof(0) }]);
            }
            let title = format!("`at` is missing in {owner}");
            return Err(self.source.error(table.span.clone(), &title, &format!("expected {}", self.takes(located))));
        };
        let kind = match subject.parts() {
            [Part::Named(kind, _)] => kind,
            _ => "place",
        };
        self.positions.push((subject.part("at"), at.span()));
        if let Value::Word(word) = at.get_ref()
            && word == "each"
            && located != Located::Load
            && self.planes != Planes::Named
            && !matches!(self.model, Model::Bodies(_))
        {
            let count = self.model.places(self.n);
            if count > MOST_PLACES {
                let title = format!("{owner} makes {count} {kind}s");
                return Err(self.source.error(at.span(), &title, &format!("expected at most {MOST_PLACES} in all")));
            }
            let site = |(i, place): (String, Place)| {
                let row = self.model.row(&place)?;
                Ok(Site { suffix: format!("-{i}"), place, row })
            };
            return self.model.each(self.n).into_iter().map(site).collect();
        }
        let place = self.place_of(&key, at, located)?;
        let (row, moves) = self.row_there(&place)?;
        if !moves {
            let title = format!("{key}: nothing moves there");
            return Err(self.source.error(
                at.span(),
                &title,
                &format!("expected {}, where the structure is not held", self.takes(located)),
            ));
        }
        Ok(vec![Site { suffix: String::new(), place, row }])
    }

    /// The place that the table `at` gives: alone, on a body, or relative to another place.
    fn place_of(&mut self, key: &str, at: &Spanned<Value<'_>>, located: Located) -> Result<Place> {
        let refuse = |builder: &Self| Err(builder.refuse(at.span(), key, &builder.takes(located)));
        let Value::Table(entries) = at.get_ref() else { return refuse(self) };
        let named = |word: &str| entries.iter().find(|entry| entry.0.get_ref() == word).map(|entry| &entry.1);
        let own: Vec<&Entry<'_>> =
            entries.iter().filter(|entry| !["body", "relative_to"].contains(&entry.0.get_ref().as_ref())).collect();
        let place = match (&self.model, named("body")) {
            (Model::Bodies(_), None) => return refuse(self),
            (_, None) => self.place_alone(key, at, &own, located)?,
            (_, Some(name)) => {
                let body_key = format!("{key}: body");
                let Value::Word(word) = name.get_ref() else {
                    return Err(self.refuse(name.span(), &body_key, &self.names_of_bodies()));
                };
                let body = self.body_named(&body_key, word, name.span())?;
                let (row, two) = (own.iter().find(|entry| entry.0.get_ref() == "row"), self.planes.is_two());
                if let (Some(row), true) = (row, two) {
                    let title = format!("{key}: row on a body, and the system moves in two planes");
                    return Err(self.source.error(row.0.span(), &title, "expected dof, position or joint"));
                }
                self.on_body(body, |builder| builder.place_alone(key, at, &own, located))?.on(Some(word))
            }
        };
        let Some(to) = named("relative_to") else { return Ok(place) };
        let to = (self.place_of(&format!("{key}: relative_to"), to, located)?, to.span());
        if self.planes.is_two() && [&place, &to.0].iter().any(|place| matches!(place, Place::Row(_))) {
            let title = format!("{key}: relative_to and row, and the system moves in two planes");
            return Err(self.source.error(to.1, &title, "expected no relative_to: a row may hold the difference"));
        }
        Ok(Place::Relative { place: Box::new(place), to: Box::new(to.0) })
    }

    /// The place of `entries`, of the table `at` without its body and the place it is relative to.
    fn place_alone(
        &mut self,
        key: &str,
        at: &Spanned<Value<'_>>,
        entries: &[&Entry<'_>],
        located: Located,
    ) -> Result<Place> {
        match entries {
            [_] | [_, _] if self.planes == Planes::Named && entries.iter().all(|entry| is_plane(entry.0.get_ref())) => {
                self.rows_of(key, entries)
            }
            [(kind, value)] => {
                let place = self.place(key, kind, value, located)?;
                self.row_there(&place).map_err(|error| self.at_value(key, error, value))?;
                Ok(place)
            }
            // A body of one degree of freedom has one place.
            [] if self.n == 1 => Ok(Place::Dof(0)),
            [] => Err(self.refuse(at.span(), key, &self.takes(located))),
            [_, .., last] => {
                let title = format!("{key} gives more than one place");
                Err(self.source.error(last.0.span(), &title, &format!("expected one of {}", self.takes(located))))
            }
        }
    }

    /// The row of a place, empty where both planes have one of their own, and whether it can move.
    fn row_there(&self, place: &Place) -> Result<(Row, bool)> {
        if self.planes == Planes::Named && !matches!(place, Place::Row(_)) {
            let rows = self.planes.rows(&self.model, place)?;
            return Ok((Row::new(Vec::new()), !(rows.y.is_blind() && rows.z.is_blind())));
        }
        let row = self.model.row(place)?;
        let moves = !row.is_blind();
        Ok((row, moves))
    }

    fn place(&self, key: &str, kind: &Name<'_>, value: &Spanned<Value<'_>>, located: Located) -> Result<Place> {
        let on_line = matches!(self.model, Model::Bar(_) | Model::Beam(_));
        match kind.get_ref().as_ref() {
            "dof" if self.planes == Planes::Named => {
                let kind_of_dof =
                    if let Model::Modal(_) = self.model { "mode" } else { "degree of freedom of matrices" };
                let title = format!("{key}: a {kind_of_dof} in two planes has no direction");
                Err(self.source.error(kind.span(), &title, &format!("expected {}", self.takes(located))))
            }
            "dof" => Ok(Place::Dof(self.dof(&format!("{key}: dof"), value, self.n)?)),
            "row" => Ok(Place::Row(self.row(&format!("{key}: row"), value)?)),
            word @ ("point" | "points") if matches!(self.model, Model::Modal(_)) => {
                self.points(&format!("{key}: {word}"), value)
            }
            word @ ("position" | "spread") if !on_line => {
                let title = format!("{key}: a {} has no positions", self.model.kind());
                let hint = if word == "spread" { "one load for each place, or a row" } else { &self.takes(located) };
                Err(self.source.error(kind.span(), &title, &format!("expected {hint}")))
            }
            "position" => {
                let position = self.finite(&format!("{key}: position"), value, "a number, in m from the left end")?;
                Ok(Place::Position(position))
            }
            "joint" if !self.joints.is_empty() => {
                let count = self.joints.len();
                let joint = self.finite(&format!("{key}: joint"), value, "the number of a span, which ends there")?;
                let index = (1..=count).find(|number| *number as f64 == joint);
                match index.and_then(|number| self.joints.get(number - 1)) {
                    Some(position) => Ok(Place::Position(*position)),
                    None => {
                        let expected = format!("a whole number from 1 to {count}, the spans");
                        Err(self.refuse(value.span(), &format!("{key}: joint"), &expected))
                    }
                }
            }
            "spread" if located == Located::Load => {
                let wanted = "[from, to], two numbers in m from the left end";
                let Value::List(ends) = value.get_ref() else {
                    return Err(self.refuse(value.span(), &format!("{key}: spread"), wanted));
                };
                let [from, to] = ends.as_slice() else {
                    return Err(self.refuse(value.span(), &format!("{key}: spread"), wanted));
                };
                let from = self.finite(&format!("{key}: spread"), from, wanted)?;
                let to = self.finite(&format!("{key}: spread"), to, wanted)?;
                Ok(Place::Spread { from, to })
            }
            other => {
                let title = format!("unknown key `{other}` in {key}");
                Err(self.source.error(kind.span(), &title, &format!("expected {}", self.takes(located))))
            }
        }
    }

    /// The rows along y and along z of matrices of both planes.
    fn rows_of(&self, key: &str, entries: &[&Entry<'_>]) -> Result<Place> {
        let (mut y, mut z) = (Vec::new(), Vec::new());
        for (plane, value) in entries {
            let row = self.row(&format!("{key}: {}", plane.get_ref()), value)?;
            if plane.get_ref() == "y" { y = row } else { z = row }
        }
        Ok(Place::Rows { y, z })
    }

    /// The number of one of `n` degrees of freedom.
    pub fn dof(&self, key: &str, value: &Spanned<Value<'_>>, n: usize) -> Result<usize> {
        let last = n.saturating_sub(1);
        match value.get_ref() {
            Value::Number(x) if x.fract() == 0.0 && (0.0..=last as f64).contains(x) => Ok(*x as usize),
            _ => Err(self.refuse(value.span(), key, &format!("a degree of freedom, a whole number from 0 to {last}"))),
        }
    }

    /// Weights of degrees of freedom, in two planes of both.
    pub fn row(&self, key: &str, value: &Spanned<Value<'_>>) -> Result<Vec<(usize, f64)>> {
        let wanted = "pairs of a degree of freedom and a weight, each once: [[0, 1.0], [1, -1.0]]";
        let entries = self.pairs(key, value, wanted)?;
        let mut row: Vec<(usize, f64)> = Vec::new();
        for (dof, weight) in entries {
            let i = self.dof(&format!("{key}: degree of freedom"), dof, self.total())?;
            if row.iter().any(|entry| entry.0 == i) {
                return Err(self.refuse(
                    dof.span(),
                    &format!("{key}: degree of freedom"),
                    "each degree of freedom once",
                ));
            }
            let weight = self.finite(&format!("{key}: weight"), weight, "a finite number")?;
            row.push((i, weight));
        }
        if row.iter().all(|entry| entry.1 == 0.0) {
            return Err(self.refuse(value.span(), key, &format!("{wanted}, one of the weights not 0")));
        }
        Ok(row)
    }

    /// A list of pairs.
    pub fn pairs<'v>(
        &self,
        key: &str,
        value: &'v Spanned<Value<'v>>,
        wanted: &str,
    ) -> Result<Vec<(&'v Spanned<Value<'v>>, &'v Spanned<Value<'v>>)>> {
        let Value::List(items) = value.get_ref() else { return Err(self.refuse(value.span(), key, wanted)) };
        if items.is_empty() {
            return Err(self.refuse(value.span(), key, wanted));
        }
        let mut pairs = Vec::new();
        for item in items {
            match item.get_ref() {
                Value::List(pair) if pair.len() == 2 => pairs.push((&pair[0], &pair[1])),
                _ => return Err(self.refuse(item.span(), key, wanted)),
            }
        }
        Ok(pairs)
    }

    /// A finite number.
    pub fn finite(&self, key: &str, value: &Spanned<Value<'_>>, wanted: &str) -> Result<f64> {
        match value.get_ref() {
            Value::Number(x) if x.is_finite() => Ok(*x),
            _ => Err(self.refuse(value.span(), key, wanted)),
        }
    }

    /// Pairs of finite numbers.
    pub fn number_pairs(&self, key: &str, value: &Spanned<Value<'_>>, wanted: &str) -> Result<Vec<[f64; 2]>> {
        let pairs = self.pairs(key, value, wanted)?.into_iter();
        pairs.map(|(x, y)| Ok([self.finite(key, x, wanted)?, self.finite(key, y, wanted)?])).collect()
    }

    /// The error of a bar or beam, shown at the value that it refers to.
    fn at_value(&self, key: &str, error: Error, value: &Spanned<Value<'_>>) -> Error {
        match error {
            Error::Invalid { value: found, expected, .. } => {
                self.source.error(value.span(), &format!("{key} is {found}"), &format!("expected {expected}"))
            }
            other => other,
        }
    }
}
