//! Reads base motion: the ground to which a structure and its walls are fixed accelerates.

use super::builder::Builder;
use super::model::{Model, Place};
use super::planes::Planes;
use super::table::{self, TableColumns};
use super::value::{Section, Value};
use super::written::{NewLoad, Origin};
use crate::error::Result;
use crate::scene::{Load, LoadKind, PlaneRows, Row, System};
use std::ops::Range;
use toml::Spanned;

impl Builder<'_> {
    /// The load of a base motion. In coordinates relative to the base it is −M ι a(t), with ι = 1
    /// on every displacement in the direction of the motion: the mass m that moves along times −a,
    /// as a force, through the row M ι/m. The keys `at` and `direction` stand beside it.
    pub fn base(
        &mut self,
        owner: &str,
        base: &Section<'_>,
        (at, direction): (Option<Range<usize>>, Option<&Spanned<f64>>),
        system: &System,
    ) -> Result<NewLoad> {
        if let Some(at) = at {
            let help = "expected no at: a base moves all of the structure";
            return Err(self.source.error(at, &format!("{owner} has a place and a base"), help));
        }
        let influence = base.get("influence").map(|value| self.influence(owner, value)).transpose()?;
        let whole = matches!(self.model, Model::Matrices(_) | Model::Modal(_));
        match (whole, base.span_of("influence")) {
            (true, None) => {
                let title = format!("`influence` is missing in {owner}: base");
                let help = "expected influence = { row = [[0, 1.0], ..] }: how far each degree of freedom moves when \
                            the base moves by 1 m and the structure is rigid";
                return Err(self.source.error(base.span.clone(), &title, help));
            }
            (false, Some(at)) => {
                let title = format!("{owner}: base: influence beside a {}", self.model.kind());
                let help = "expected no influence: it is 1 on every displacement; it is for matrices and modal data";
                return Err(self.source.error(at, &title, help));
            }
            _ => {}
        }
        let (row, mass) = self.carried(system, influence.as_deref())?;
        let row = match (self.planes, direction) {
            (Planes::Two(n), Some(direction)) if direction.get_ref().is_finite() => {
                PlaneRows::doubled(&row, n).along(*direction.get_ref())
            }
            (Planes::Two(_), Some(direction)) => {
                return Err(self.refuse(direction.span(), &format!("{owner}: direction"), "a finite number, in deg"));
            }
            (Planes::Two(_), None) => {
                let help = "expected direction = a number, in deg, from +y (0) towards +z (90)";
                let title = format!("`direction` is missing in {owner}");
                return Err(self.source.error(base.span.clone(), &title, help));
            }
            (Planes::One, Some(direction)) => return Err(self.undirected(owner, direction.span())),
            (Planes::Named, Some(direction)) => {
                let help = "expected no direction beside influence, which holds the degrees of freedom of both planes";
                let title = format!("{owner} has an influence and a direction");
                return Err(self.source.error(direction.span(), &title, help));
            }
            (Planes::One | Planes::Named, None) => row,
        };
        if mass <= 0.0 {
            let span = base.span_of("influence").unwrap_or(base.span.clone());
            let title = format!("{owner}: base: influence moves no mass");
            return Err(self.source.error(span, &title, "expected the displacements of degrees of freedom with mass"));
        }
        let plain = TableColumns { force: "acceleration_m_per_s2".to_owned(), ..TableColumns::default() };
        let (owner, file) = (format!("{owner}: base"), base.required_word("file"));
        let columns = self.columns(&owner, ("acceleration", "m/s^2"), plain, base)?;
        let (path, text) = self.table_file(&owner, &file, &columns)?;
        // A mass that is not finite is refused at its own key, once the table has been read.
        let carried = if mass.is_finite() { mass } else { 1.0 };
        let felt = TableColumns { scale: -carried * columns.scale, ..columns };
        let kind = LoadKind::Table(table::read(&path, &text, &felt)?);
        let origin = Origin::Base((*file.get_ref()).to_owned());
        Ok(NewLoad { load: Load { kind, at: row }, place: Place::Row(Vec::new()), origin })
    }

    /// M ι/m over one plane, and the mass m = ιᵀM ι that moves along with the base, kg. On a bar or
    /// beam the inertia of held ends reaches their neighbours, so its row is that of an even
    /// spread.
    fn carried(&self, system: &System, influence: Option<&[(usize, f64)]>) -> Result<(Row, f64)> {
        match &self.model {
            Model::Bar(bar) => Ok((bar.spread(0.0, bar.length)?, bar.density * bar.area * bar.length)),
            Model::Beam(beam) => Ok((beam.spread(0.0, beam.length)?, beam.mass_per_metre() * beam.length)),
            Model::Chain(chain) => {
                let mass: f64 = chain.masses.iter().sum();
                Ok((Row::new(chain.masses.iter().map(|m| m / mass).enumerate().collect()), mass))
            }
            Model::Oscillator => Ok((Row::dof(0), system.mass_form(&first(system), &first(system)))),
            Model::Matrices(_) | Model::Modal(_) => {
                let n = system.degrees_of_freedom();
                let (mut moved, mut momentum) = (vec![0.0; n], vec![0.0; n]);
                for &(i, x) in influence.unwrap_or_default() {
                    moved[i] = x;
                }
                system.add_mass(1.0, &moved, &mut momentum);
                let mass = system.mass_form(&moved, &moved);
                let entries = momentum.into_iter().map(|p| p / mass).enumerate().filter(|entry| entry.1 != 0.0);
                Ok((Row::new(entries.collect()), mass))
            }
        }
    }

    /// `{ row = [[0, 1.0], ..] }`.
    fn influence(&self, owner: &str, value: &Spanned<Value<'_>>) -> Result<Vec<(usize, f64)>> {
        let key = format!("{owner}: base: influence");
        match value.get_ref() {
            Value::Table(entries) => match entries.as_slice() {
                [(name, row)] if name.get_ref() == "row" => self.row(&format!("{key}: row"), row),
                _ => Err(self.refuse(value.span(), &key, "{ row = [[0, 1.0], ..] }")),
            },
            _ => Err(self.refuse(value.span(), &key, "{ row = [[0, 1.0], ..] }")),
        }
    }
}

/// A unit motion of the first degree of freedom.
fn first(system: &System) -> Vec<f64> {
    let mut motion = vec![0.0; system.degrees_of_freedom()];
    if let Some(x) = motion.first_mut() {
        *x = 1.0;
    }
    motion
}
