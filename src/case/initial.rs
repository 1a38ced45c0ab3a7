//! Reads the table `[initial]`: fields over the structure.

use super::builder::Builder;
use super::model::Model;
use super::value::Value;
use crate::error::{Result, Subject};
use toml::Spanned;

impl Builder<'_> {
    /// The forms of a field that this system accepts.
    fn takes_field(&self, unit: &str) -> String {
        let last = self.n.saturating_sub(1);
        let of_dofs = format!("a list of {} numbers in {unit}, or {{ dofs = [[0 to {last}, {unit}]] }}", self.n);
        match self.model.length() {
            Some(length) => format!("{{ profile = [[0.0 m, {unit}], .., [{length:?} m, {unit}]] }}, {of_dofs}"),
            None if self.n == 1 => format!("a number, in {unit}"),
            None => of_dofs,
        }
    }

    /// A displacement or velocity of every degree of freedom; 0 where none is given.
    pub fn field(&mut self, part: &'static str, value: Option<&Spanned<Value>>) -> Result<Vec<f64>> {
        let Some(value) = value else { return Ok(vec![0.0; self.n]) };
        let (subject, key) = (Subject::from(("initial state", part)), &format!("initial.{part}"));
        self.places.push((subject.clone(), value.span()));
        let wanted = self.takes_field(if part == "velocity" { "m/s" } else { "m" });
        match value.get_ref() {
            Value::Number(x) if self.n == 1 => Ok(vec![*x]),
            Value::List(items) if !matches!(self.model, Model::Oscillator) => {
                if items.len() != self.n {
                    let title = format!("{key} has {} values", items.len());
                    return Err(self.source.error(value.span(), &title, &format!("expected {wanted}")));
                }
                items.iter().map(|item| self.finite(key, item, &wanted)).collect()
            }
            Value::Table(entries) if !matches!(self.model, Model::Oscillator) => match entries.as_slice() {
                [(name, points)] if name.get_ref() == "profile" => self.profile((key, subject), name, points, &wanted),
                [(name, list)] if name.get_ref() == "dofs" => {
                    let mut field = vec![0.0; self.n];
                    for (dof, x) in self.pairs(&format!("{key}.dofs"), list, &wanted)? {
                        let i = self.dof(&format!("{key}.dofs"), dof)?;
                        field[i] = self.finite(&format!("{key}.dofs"), x, &wanted)?;
                    }
                    Ok(field)
                }
                [(name, _)] => {
                    let title = format!("unknown key `{}` in `{key}`", name.get_ref());
                    Err(self.source.error(name.span(), &title, &format!("expected {wanted}")))
                }
                _ => Err(self.refuse(value.span(), key, &wanted)),
            },
            other => {
                let title = format!("`{key}` takes no {}", other.kind().trim_start_matches("a "));
                Err(self.source.error(value.span(), &title, &format!("expected {wanted}")))
            }
        }
    }

    fn profile(
        &mut self,
        (key, subject): (&str, Subject),
        name: &Spanned<String>,
        list: &Spanned<Value>,
        wanted: &str,
    ) -> Result<Vec<f64>> {
        let mut points = Vec::new();
        if self.has_positions() {
            for (x, value) in self.pairs(&format!("{key}.profile"), list, wanted)? {
                let at = |value| self.finite(&format!("{key}.profile"), value, wanted);
                points.push((at(x)?, at(value)?));
            }
        }
        match &self.model {
            Model::Bar(bar) => bar.field_through(subject, &points).map_err(|error| self.at_key(error)),
            Model::Beam(beam) => beam.field_through(subject, &points).map_err(|error| self.at_key(error)),
            other => {
                let title = format!("`{key}`: a {} has no positions", other.kind());
                Err(self.source.error(name.span(), &title, &format!("expected {wanted}")))
            }
        }
    }
}
