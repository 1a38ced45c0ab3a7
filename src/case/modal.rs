//! Reads the table `[system.modal]`: modes as finite-element programs export them.

use super::builder::Builder;
use super::report::Source;
use super::value::{Section, Value};
use crate::error::{Result, Subject, counted};
use crate::scene::{ModalData, ModalPoint};
use std::f64::consts::TAU;
use toml::Spanned;

/// Description of the file of shapes, for messages.
const SHAPES: &str = "expected a row for each point: its name, then its displacement in each mode, with commas \
                      between them; a header line above is ignored";

/// What a file of points and numbers holds.
pub(super) struct PointFile {
    /// How many numbers each point has.
    pub values: usize,
    /// What they are, for messages.
    pub each: &'static str,
    /// What the file is, for messages.
    pub description: &'static str,
}

impl Builder<'_> {
    /// The modes, and the points whose shapes are known.
    pub fn modal(&mut self, modal: &Section<'_>) -> Result<ModalData> {
        let omega = match (modal.numbers("frequencies"), modal.numbers("omega")) {
            (Some(_), Some(omega)) => {
                let help = "expected frequencies (Hz) or omega (rad/s)";
                return Err(self.source.error(
                    omega.span(),
                    &format!("`{}.modal` has both frequencies and omega", self.owner),
                    help,
                ));
            }
            (None, None) => {
                let help = "expected frequencies = a list of numbers, 0 or more, in Hz, or omega = the same in rad/s";
                return Err(self.source.error(
                    modal.span.clone(),
                    &format!("`frequencies` is missing in `{}.modal`", self.owner),
                    help,
                ));
            }
            (Some(list), None) => self.each("frequencies", "omega", &list, TAU)?,
            (None, Some(list)) => self.each("omega", "omega", &list, 1.0)?,
        };
        let k = omega.len();
        let masses = self.of_modes("masses", modal.get("masses"), 1.0, k)?;
        let ratios = self.of_modes("damping_ratios", modal.get("damping_ratios"), 0.0, k)?;
        self.note_ratios(&ratios);
        let points = match modal.get("shapes") {
            None => Vec::new(),
            Some(shapes) => self.shapes(shapes, k)?,
        };
        Ok(ModalData { omega, masses, ratios, points })
    }

    /// A list of numbers, each multiplied by `factor`; errors name `name`.
    fn each(
        &mut self,
        key: &str,
        name: &'static str,
        list: &Spanned<Vec<Spanned<f64>>>,
        factor: f64,
    ) -> Result<Vec<f64>> {
        let wanted = "a list of numbers, 0 or more: one for each mode";
        if list.get_ref().is_empty() {
            return Err(self.refuse(list.span(), &format!("{}.modal.{key}", self.owner), wanted));
        }
        let mut values = Vec::with_capacity(list.get_ref().len());
        for (i, item) in list.get_ref().iter().enumerate() {
            let x = *item.get_ref();
            if !(x.is_finite() && x >= 0.0) {
                return Err(self.refuse(
                    item.span(),
                    &format!("{}.modal.{key}: value {}", self.owner, i + 1),
                    "0 or more",
                ));
            }
            self.positions.push((Subject::from(("modal data", name)).value(i), item.span()));
            values.push(factor * x);
        }
        Ok(values)
    }

    /// A number for all `k` modes, or a list with one for each.
    fn of_modes(
        &mut self,
        name: &'static str,
        value: Option<&Spanned<Value<'_>>>,
        plain: f64,
        k: usize,
    ) -> Result<Vec<f64>> {
        let Some(value) = value else { return Ok(vec![plain; k]) };
        let key = format!("{}.modal.{name}", self.owner);
        let subject = Subject::from(("modal data", name.trim_start_matches("damping_")));
        self.positions.push((subject.clone(), value.span()));
        match value.get_ref() {
            Value::Number(x) => {
                self.positions.push((subject.value(0), value.span()));
                Ok(vec![*x; k])
            }
            Value::List(items) if items.len() == k => self.list(&key, subject, items),
            Value::List(items) => {
                let title = format!("{key} has {}", counted(items.len(), "value"));
                let help = format!("expected {k}, one for each mode, or one number for all");
                Err(self.source.error(value.span(), &title, &help))
            }
            _ => Err(self.refuse_as(value.span(), &key)),
        }
    }

    fn shapes(&mut self, shapes: &Spanned<Value<'_>>, k: usize) -> Result<Vec<ModalPoint>> {
        let key = &format!("{}.modal.shapes", self.owner);
        let subject = Subject::from(("modal data", "shapes"));
        self.positions.push((subject.clone(), shapes.span()));
        match shapes.get_ref() {
            Value::Word(file) => {
                let (path, text) = self.open("shapes", file, shapes.span(), SHAPES)?;
                points(&path, &text, &PointFile { values: k, each: "one for each mode", description: SHAPES })
            }
            Value::Table(entries) => {
                let mut points = Vec::with_capacity(entries.len());
                for (name, shape) in entries {
                    let key = format!("{key}.{}", name.get_ref());
                    self.name(&key, name.get_ref(), name.span())?;
                    self.positions.push((subject.clone().part(name.get_ref().to_string()), shape.span()));
                    let Value::List(items) = shape.get_ref() else {
                        return Err(self.refuse(
                            shape.span(),
                            &key,
                            &format!("a list of {k} numbers, one for each mode"),
                        ));
                    };
                    if items.len() != k {
                        let title = format!("{key} has {}", counted(items.len(), "value"));
                        return Err(self.source.error(
                            shape.span(),
                            &title,
                            &format!("expected {k}, one for each mode"),
                        ));
                    }
                    let wanted = "a finite number";
                    let shape = items.iter().map(|item| self.finite(&key, item, wanted)).collect::<Result<_>>()?;
                    points.push(ModalPoint { name: name.get_ref().to_string(), shape });
                }
                Ok(points)
            }
            _ => Err(self.refuse_as(shapes.span(), key)),
        }
    }
}

/// The points in a `file`, called `name`, of this text.
pub(super) fn points(name: &str, text: &str, file: &PointFile) -> Result<Vec<ModalPoint>> {
    let PointFile { values: k, each, description } = *file;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source { name, text };
    let mut points: Vec<ModalPoint> = Vec::new();
    let (mut start, mut first) = (0, true);
    for raw in text.split_inclusive('\n') {
        let line = start..start + raw.trim_end_matches(['\n', '\r']).len();
        start += raw.len();
        let written = source.slice(line.clone()).to_owned();
        if written.trim().is_empty() {
            continue;
        }
        let mut cells = written.split(',').map(|cell| cell.trim().trim_matches('"'));
        let point = cells.next().unwrap_or_default().to_owned();
        let cells: Vec<&str> = cells.collect();
        let header = std::mem::replace(&mut first, false) && cells.iter().all(|cell| cell.parse::<f64>().is_err());
        if header && !cells.is_empty() {
            continue;
        }
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if point.is_empty() || !point.chars().all(fits) {
            let title = format!("the name of a point is {point:?}");
            return Err(source.error(line, &title, "expected letters, digits, - and _"));
        }
        if points.iter().any(|other| other.name == point) {
            return Err(source.error(
                line,
                &format!("the point {point:?} comes a second time"),
                "expected each point once",
            ));
        }
        if cells.len() != k {
            let title = format!("{} at the point {point:?}", counted(cells.len(), "value"));
            return Err(source.error(line, &title, &format!("expected {k}, {each}")));
        }
        let mut shape = Vec::with_capacity(k);
        for cell in cells {
            match cell.parse::<f64>() {
                Ok(x) if x.is_finite() => shape.push(x),
                _ => return Err(source.error(line, &format!("{cell:?} is no finite number"), description)),
            }
        }
        points.push(ModalPoint { name: point, shape });
    }
    if points.is_empty() { Err(source.error(text.len()..text.len(), "no points", description)) } else { Ok(points) }
}
