//! Reads the table `[system]`: from measured quantities to M, C and K.

use super::beam::End;
use super::builder::{Builder, MOST_MASSES};
use super::model::Model;
use super::planes::Planes;
use super::value::{Section, Value};
use crate::error::{Error, Result, Subject};
use crate::scene::{BeamSection, Chain, Damping, Oscillator, Structure, System};
use std::ops::Range;
use toml::Spanned;

/// A system and the model from which it was built.
pub(super) struct Built {
    pub model: Model,
    pub system: System,
    pub planes: Planes,
    /// Damping that is still to be applied: modal ratios after the reduction to modes; every kind
    /// but a matrix after the condensation of massless degrees of freedom.
    pub pending: Option<Damping>,
}

impl Built {
    /// A system in one plane, of which `two` tells whether it moves in both.
    fn of(model: Model, structure: Structure, pending: Option<Damping>, two: bool) -> Self {
        let (system, planes) = match (two, &model) {
            (false, _) => (structure, Planes::One),
            (true, Model::Matrices(_) | Model::Modal(_)) => (structure, Planes::Named),
            (true, _) => (structure.in_two_planes(), Planes::Two(structure.mass.size())),
        };
        // A ratio is that of a mode of one plane; in two equal planes there are two of each.
        let pending = pending.map(|damping| match (damping, planes) {
            (Damping::Modal(ratios), Planes::Two(_)) => {
                Damping::Modal(ratios.iter().flat_map(|&ratio| [ratio; 2]).collect())
            }
            (other, _) => other,
        });
        Self { model, system: system.into(), planes, pending }
    }
}

impl Builder<'_> {
    /// The system of the file and its model.
    pub fn system(&mut self, file: &Section<'_>) -> Result<Built> {
        let system = file.required_section("system");
        let bodies = file.sections("body");
        if bodies.is_empty() {
            if file.section("system").is_none() {
                let help = format!("{}, or several [[body]]", self.kinds_expected());
                return Err(self.source.error(file.span.clone(), "`system` is missing in the case file", &help));
            }
            return self.one_system(&system);
        }
        if let Some((kind, table)) = Self::kinds(&system).next() {
            let title = format!("`system.{kind}` beside [[body]]");
            let help = "expected it as a table [body.KIND] of one more [[body]], or no bodies";
            return Err(self.source.error(table.span, &title, help));
        }
        let two = self.two_planes(system.number("planes"), "bodies")?;
        let (model, structure) = self.bodies(&bodies, two)?;
        self.positions.push(("system".into(), bodies.first().map_or(system.span.clone(), |body| body.span.clone())));
        let own = structure.damping.entries().any(|entry| entry.2 != 0.0);
        let (structure, pending) = self.damped(&system, structure, own, self.modes.is_some())?;
        Ok(Built::of(model, structure, pending, two))
    }

    /// The tables of `owner` that say what vibrates, each with its kind.
    fn kinds<'s>(owner: &Section<'s>) -> impl Iterator<Item = (&'static str, Section<'s>)> {
        let kinds = ["oscillator", "chain", "bar", "beam", "matrices", "modal"];
        kinds.into_iter().filter_map(|kind| Some((kind, owner.section(kind)?)))
    }

    fn kinds_expected(&self) -> String {
        let of = self.owner;
        format!(
            "expected one of the tables [{of}.oscillator], [{of}.chain], [{of}.bar], [{of}.beam], [{of}.matrices], \
             [{of}.modal]"
        )
    }

    /// The one table of `owner`, a system or body, that says what vibrates, with its kind; notes
    /// where it stands.
    pub fn kind_of<'s>(&mut self, owner: &Section<'s>) -> Result<(&'static str, Section<'s>)> {
        let one = self.kinds_expected();
        let mut given = Self::kinds(owner);
        let Some((kind, table)) = given.next() else {
            let title = format!("`{}` does not say what vibrates", self.owner);
            return Err(self.source.error(owner.span.clone(), &title, &one));
        };
        if let Some((second, other)) = given.next() {
            let later = if table.span.start > other.span.start { table.span } else { other.span };
            return Err(self.source.error(later, &format!("two systems, `{kind}` and `{second}`"), &one));
        }
        let name = if kind == "modal" { "modal data" } else { kind };
        self.positions.push(("system".into(), table.span.clone()));
        self.positions.push((name.into(), table.span.clone()));
        Ok((kind, table))
    }

    fn one_system(&mut self, system: &Section<'_>) -> Result<Built> {
        let (kind, table) = self.kind_of(system)?;
        let two = self.two_planes(system.number("planes"), kind)?;
        if kind == "oscillator" {
            return self.oscillator(system, &table, two);
        }
        let (model, structure) = self.structure(system, kind, &table, two)?;
        let own = has_damping(kind, &table);
        let (structure, pending) = self.damped(system, structure, own, self.modes.is_some())?;
        Ok(Built::of(model, structure, pending, two))
    }

    /// The structure with the damping of the table of `owner`, a system or body, which may not have
    /// its `own`; or that damping, if it is applied later.
    pub fn damped(
        &mut self,
        owner: &Section<'_>,
        structure: Structure,
        own: bool,
        cut: bool,
    ) -> Result<(Structure, Option<Damping>)> {
        let Some(damping) = owner.section("damping") else { return Ok((structure, None)) };
        if own {
            let help =
                format!("expected the damping beside the matrices, modes or bodies, or [{}.damping]", self.owner);
            let title = format!("`{}` gives its damping twice", self.owner);
            return Err(self.source.error(damping.span, &title, &help));
        }
        let massless = !structure.massless().is_empty();
        Ok(match self.damping(&damping)? {
            ratios @ Damping::Modal(_) if cut => (structure, Some(ratios)),
            later @ (Damping::Modal(_) | Damping::Rayleigh { .. }) if massless => (structure, Some(later)),
            damping => (structure.with_damping(&damping).map_err(|error| self.at_key(error))?, None),
        })
    }

    fn oscillator(&mut self, system: &Section<'_>, table: &Section<'_>, two: bool) -> Result<Built> {
        for key in ["damping", "modes", "static_correction"] {
            if let Some(span) = system.span_of(key) {
                let title = format!("`system.{key}` beside an oscillator");
                let help = "expected it beside a chain, bar, beam or matrices; an oscillator has one degree of \
                            freedom, and its damping in N s/m";
                return Err(self.source.error(span, &title, help));
            }
        }
        let system = self.oscillator_of(table);
        let (system, planes) = if two {
            system.validate().map_err(|error| self.at_key(error))?;
            (system.structure().in_two_planes().into(), Planes::Two(1))
        } else {
            (system, Planes::One)
        };
        Ok(Built { model: Model::Oscillator, system, planes, pending: None })
    }

    /// The oscillator that `table` describes.
    pub fn oscillator_of(&mut self, table: &Section<'_>) -> System {
        let [mass, damping, stiffness] =
            ["mass", "damping", "stiffness"].map(|key| self.required(("oscillator", key), table, key));
        System::Oscillator(Oscillator { mass, damping, stiffness })
    }

    /// The structure that `table` of this `kind`, in a system or body, describes, in one plane,
    /// without the damping of the table `damping` beside it.
    pub fn structure(
        &mut self,
        system: &Section<'_>,
        kind: &str,
        table: &Section<'_>,
        two: bool,
    ) -> Result<(Model, Structure)> {
        let (model, structure) = match kind {
            "chain" => {
                let chain = self.chain(table)?;
                let structure = chain.structure();
                (Model::Chain(chain), structure)
            }
            "bar" => {
                let bar = self.bar(table)?;
                let structure = bar.structure();
                (Model::Bar(bar), structure)
            }
            "beam" => {
                let beam = self.beam(table)?;
                if let (true, BeamSection::Rectangle { .. }) = (two, beam.section) {
                    let title = "`system.planes` is 2 beside a rectangular section";
                    let help = "expected no planes: a rectangular section bends in one plane; planes = 2 takes a \
                                tube, outer_diameter in place of width and height";
                    let span = system.span_of("planes").unwrap_or(table.span.clone());
                    return Err(self.source.error(span, title, help));
                }
                let structure = beam.structure();
                (Model::Beam(beam), structure)
            }
            "matrices" => {
                let structure = self.matrices(table)?;
                (Model::Matrices(structure.mass.size()), Ok(structure))
            }
            _ => {
                let modal = self.modal(table)?;
                let structure = modal.structure();
                (Model::Modal(modal), structure)
            }
        };
        Ok((model, structure.map_err(|error| self.at_key(error))?))
    }

    /// True for `planes = 2`, which `kind` must allow.
    fn two_planes(&self, planes: Option<Spanned<f64>>, kind: &str) -> Result<bool> {
        let Some(planes) = planes else { return Ok(false) };
        match (*planes.get_ref(), kind) {
            (1.0, _) => Ok(false),
            (2.0, "oscillator" | "chain" | "beam" | "matrices" | "modal" | "bodies") => Ok(true),
            (2.0, _) => Err(self.bar_in_two_planes(planes.span())),
            _ => Err(self.refuse_as(planes.span(), "system.planes")),
        }
    }

    /// The error of a bar, at `span`, in two planes.
    pub fn bar_in_two_planes(&self, span: Range<usize>) -> Error {
        let help = "expected no planes: a bar moves along itself; a tube in bending is a beam";
        self.source.error(span, "`system.planes` is 2 beside a bar", help)
    }

    fn chain(&mut self, chain: &Section<'_>) -> Result<Chain> {
        let (Some(masses), Some(springs)) = (chain.get("masses"), chain.get("springs")) else {
            return Err(self.refuse_as(chain.span.clone(), &format!("{}.chain", self.owner)));
        };
        let (key, subject) = (format!("{}.chain.masses", self.owner), Subject::from(("chain", "masses")));
        self.positions.push((subject.clone(), masses.span()));
        let masses = match (masses.get_ref(), chain.number("mass")) {
            (Value::Number(x), Some(mass)) => {
                let count = self.count(&key, *x, masses.span(), MOST_MASSES)?;
                self.positions.push((subject.value(0), mass.span()));
                vec![self.number(("chain", "mass"), &mass); count]
            }
            (Value::List(items), None) => self.list(&key, subject, items)?,
            (Value::List(_), Some(mass)) => {
                let help = "expected mass only where masses says how many there are";
                let title = format!("`{}.chain.mass` beside a list of masses", self.owner);
                return Err(self.source.error(mass.span(), &title, help));
            }
            (Value::Number(_), None) => {
                let help = "expected mass = a number above 0, in kg: that of each";
                let title = format!("`mass` is missing in `{}.chain`", self.owner);
                return Err(self.source.error(masses.span(), &title, help));
            }
            _ => return Err(self.refuse_as(masses.span(), &key)),
        };
        let (key, subject) = (format!("{}.chain.springs", self.owner), Subject::from(("chain", "springs")));
        self.positions.push((subject.clone(), springs.span()));
        let springs = match springs.get_ref() {
            Value::Number(k) => {
                self.positions.push((subject.value(0), springs.span()));
                vec![*k; masses.len().saturating_sub(1)]
            }
            Value::List(items) => self.list(&key, subject, items)?,
            _ => return Err(self.refuse_as(springs.span(), &key)),
        };
        let grounds = self.ends("chain", chain, 0.0, |end| match end {
            End::Free => Some(0.0),
            End::Sprung { stiffness, .. } => Some(stiffness),
            End::Pinned | End::Clamped => None,
        })?;
        Ok(Chain { masses, springs, grounds })
    }
}

/// True if the `table` of this `kind` of system has its own damping.
pub(super) fn has_damping(kind: &str, table: &Section<'_>) -> bool {
    match kind {
        "matrices" => table.get("damping").is_some(),
        "modal" => table.get("damping_ratios").is_some(),
        _ => false,
    }
}
