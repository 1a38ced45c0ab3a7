//! Reads the table `[initial]`: fields over the structure.

use super::builder::Builder;
use super::model::Model;
use super::planes::Planes;
use super::points::listed;
use super::value::{Entry, Name, Section, Value};
use super::written::ScatteredStart;
use crate::error::{Result, Subject};
use crate::scene::{Scatter, State};
use crate::study::truncation::Start;
use toml::Spanned;

/// A field that is read: its key, the subject of errors and its unit.
struct Field {
    key: String,
    subject: Subject,
    unit: &'static str,
}

impl Builder<'_> {
    /// The forms of a field of `n` degrees of freedom that this system accepts.
    fn takes_field(&self, unit: &str, n: usize) -> String {
        let last = n.saturating_sub(1);
        let of_dofs = format!("a list of {n} numbers in {unit}, or {{ dofs = [[0 to {last}, {unit}]] }}");
        if let (Model::Bodies(bodies), true) = (&self.model, n == self.n) {
            let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            return format!("{{ BODY = a field of that body, .. }}, BODY of {}, or {of_dofs}", listed(&names));
        }
        match self.model.length() {
            Some(_) if n != self.n => format!("{{ y = .., z = .. }}, {of_dofs}"),
            Some(length) => format!("{{ profile = [[0.0 m, {unit}], .., [{length:?} m, {unit}]] }}, {of_dofs}"),
            None if n == 1 => format!("a number, in {unit}"),
            None if n != self.n => format!("{{ y = .., z = .. }}, {of_dofs}"),
            None => of_dofs,
        }
    }

    /// The state from which the case starts; that of an equilibrium is found later.
    pub fn initial(&mut self, initial: &Section<'_>) -> Result<State> {
        self.written.start = self.start(initial)?;
        let scatter = initial.section("scatter").map(|section| self.scatter(&section)).transpose()?;
        self.written.scattered = scatter.map(|scatter| ScatteredStart { scatter, mean: Vec::new() });
        Ok(State { q: self.field("displacement", initial)?, v: self.field("velocity", initial)? })
    }

    /// Whether the start is given, or a static equilibrium.
    fn start(&mut self, initial: &Section<'_>) -> Result<Start> {
        let Some(equilibrium) = initial.truth("equilibrium") else { return Ok(Start::Given) };
        self.positions.push((("initial state", "equilibrium").into(), equilibrium));
        match initial.span_of("displacement").or(initial.span_of("velocity")) {
            Some(given) => {
                let help = "expected no displacement and no velocity: an equilibrium is at rest where the constant \
                            loads hold it";
                Err(self.source.error(given, "`initial.equilibrium` beside a start", help))
            }
            None => Ok(Start::Equilibrium),
        }
    }

    /// The scatter of the velocities.
    fn scatter(&self, section: &Section<'_>) -> Result<Scatter> {
        let owner = "initial.scatter";
        let deviation = section.required("velocity");
        if !(deviation.get_ref().is_finite() && *deviation.get_ref() > 0.0) {
            let help = "expected a standard deviation above 0, in m/s";
            let title = format!("{owner}.velocity is {:?}", deviation.get_ref());
            return Err(self.source.error(deviation.span(), &title, help));
        }
        let seed = section.number("seed").map_or(Ok(0), |seed| self.seed(owner, &seed))?;
        Ok(Scatter { deviation: deviation.into_inner(), seed })
    }

    /// A displacement or velocity of every degree of freedom; 0 where none is given.
    fn field(&mut self, part: &'static str, initial: &Section<'_>) -> Result<Vec<f64>> {
        let total = self.total();
        let Some(value) = initial.get(part) else { return Ok(vec![0.0; total]) };
        let subject = Subject::from(("initial state", part));
        self.positions.push((subject.clone(), value.span()));
        let unit = if part == "velocity" { "m/s" } else { "m" };
        let field = |name: &str| Field { key: format!("initial.{part}{name}"), subject: subject.clone(), unit };
        match (self.planes, value.get_ref()) {
            (Planes::Two(n), Value::Table(planes))
                if planes.iter().all(|(name, _)| ["y", "z"].contains(&name.get_ref().as_ref())) =>
            {
                let mut both = vec![0.0; total];
                for (name, value) in planes {
                    let of_plane = self.over(&field(&format!(".{}", name.get_ref())), value, n)?;
                    let from = if name.get_ref() == "y" { 0 } else { n };
                    both.iter_mut().skip(from).zip(of_plane).for_each(|(all, x)| *all = x);
                }
                Ok(both)
            }
            _ => self.over(&field(""), value, total),
        }
    }

    /// A field of `n` degrees of freedom: those of one plane, or all.
    fn over(&mut self, field: &Field, value: &Spanned<Value<'_>>, n: usize) -> Result<Vec<f64>> {
        let (key, wanted) = (&field.key, self.takes_field(field.unit, n));
        match value.get_ref() {
            Value::Number(x) if n == 1 => Ok(vec![*x]),
            Value::List(items) if self.has_fields() => {
                if items.len() != n {
                    let title = format!("{key} has {} values", items.len());
                    return Err(self.source.error(value.span(), &title, &format!("expected {wanted}")));
                }
                items.iter().map(|item| self.finite(key, item, &wanted)).collect()
            }
            Value::Table(entries) if self.has_fields() => match entries.as_slice() {
                bodies if bodies.iter().any(|(name, _)| self.model.body(name.get_ref()).is_some()) && n == self.n => {
                    self.of_bodies(field, bodies, &wanted)
                }
                [(name, points)] if name.get_ref() == "profile" && n == self.n => {
                    self.profile(field, name, points, &wanted)
                }
                [(name, list)] if name.get_ref() == "dofs" => {
                    let mut values = vec![0.0; n];
                    for (dof, x) in self.pairs(&format!("{key}.dofs"), list, &wanted)? {
                        let i = self.dof(&format!("{key}.dofs"), dof, n)?;
                        values[i] = self.finite(&format!("{key}.dofs"), x, &wanted)?;
                    }
                    Ok(values)
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

    /// A field of which the `entries` give the part of each body, in one plane; 0 on the others.
    fn of_bodies(&mut self, field: &Field, entries: &[Entry<'_>], wanted: &str) -> Result<Vec<f64>> {
        let mut all = vec![0.0; self.n];
        for (name, value) in entries {
            let Some(body) = self.model.body(name.get_ref()).cloned() else {
                let title = format!("unknown key `{}` in `{}`", name.get_ref(), field.key);
                return Err(self.source.error(name.span(), &title, &format!("expected {wanted}")));
            };
            let part =
                Field { key: format!("{}.{}", field.key, body.name), subject: field.subject.clone(), unit: field.unit };
            let dofs = body.dofs.clone();
            let own = self.on_body(body, |builder| builder.over(&part, value, dofs.len()))?;
            all.iter_mut().skip(dofs.start).zip(own).for_each(|(all, x)| *all = x);
        }
        Ok(all)
    }

    /// True where a field may be given by its degrees of freedom: not for an oscillator in one
    /// plane.
    fn has_fields(&self) -> bool {
        !matches!(self.model, Model::Oscillator) || self.planes.is_two()
    }

    fn profile(
        &self,
        Field { key, subject, .. }: &Field,
        name: &Name<'_>,
        list: &Spanned<Value<'_>>,
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
            Model::Bar(bar) => bar.field_through(subject.clone(), &points).map_err(|error| self.at_key(error)),
            Model::Beam(beam) => beam.field_through(subject.clone(), &points).map_err(|error| self.at_key(error)),
            other => {
                let title = format!("`{key}`: a {} has no positions", other.kind());
                Err(self.source.error(name.span(), &title, &format!("expected {wanted}")))
            }
        }
    }
}
