//! Reads the table `[system]`: from measured quantities to M, C and K.

use super::beam::End;
use super::builder::{Builder, MOST_MASSES};
use super::model::Model;
use super::planes::Planes;
use super::value::{Section, Value};
use crate::error::{Result, Subject};
use crate::scene::{BeamSection, Chain, Damping, Oscillator, Structure, System};
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

impl Builder<'_> {
    /// The system and its model; `cut` if it will be reduced to modes.
    pub fn system(&mut self, system: &Section<'_>, cut: bool) -> Result<Built> {
        let kinds = ["oscillator", "chain", "bar", "beam", "matrices", "modal"];
        let mut given = kinds.into_iter().filter_map(|kind| Some((kind, system.section(kind)?)));
        let one = "expected one of the tables [system.oscillator], [system.chain], [system.bar], [system.beam], \
                   [system.matrices], [system.modal]";
        let Some((kind, table)) = given.next() else {
            return Err(self.source.error(system.span.clone(), "`system` does not say what vibrates", one));
        };
        if let Some((second, other)) = given.next() {
            let later = if table.span.start > other.span.start { table.span } else { other.span };
            return Err(self.source.error(later, &format!("two systems, `{kind}` and `{second}`"), one));
        }
        let name = if kind == "modal" { "modal data" } else { kind };
        self.positions.push(("system".into(), table.span.clone()));
        self.positions.push((name.into(), table.span.clone()));
        let two = self.two_planes(system.number("planes"), kind)?;
        if kind == "oscillator" {
            return self.oscillator(system, &table, two);
        }
        let own_damping = match kind {
            "matrices" => table.get("damping"),
            "modal" => table.get("damping_ratios"),
            _ => None,
        };
        let (model, mut structure) = self.structure(system, kind, &table, two)?;
        let mut pending = None;
        if let Some(damping) = system.section("damping") {
            if own_damping.is_some() {
                let help = "expected the damping beside the matrices or modes, or [system.damping]";
                return Err(self.source.error(damping.span, "`system` gives its damping twice", help));
            }
            let massless = !structure.massless().is_empty();
            let damping = self.damping(&damping)?;
            match damping {
                ratios @ Damping::Modal(_) if cut => pending = Some(ratios),
                later @ (Damping::Modal(_) | Damping::Rayleigh { .. }) if massless => pending = Some(later),
                damping => structure = structure.with_damping(&damping).map_err(|error| self.at_key(error))?,
            }
        }
        let planes = match (two, &model) {
            (false, _) => Planes::One,
            (true, Model::Matrices(_) | Model::Modal(_)) => Planes::Named,
            (true, _) => {
                let n = structure.mass.size();
                structure = structure.in_two_planes();
                // A ratio is that of a mode of one plane; in two planes there are two of each.
                if let Some(Damping::Modal(ratios)) = &mut pending {
                    *ratios = ratios.iter().flat_map(|&ratio| [ratio; 2]).collect();
                }
                Planes::Two(n)
            }
        };
        Ok(Built { model, system: structure.into(), planes, pending })
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
        let [mass, damping, stiffness] =
            ["mass", "damping", "stiffness"].map(|key| self.required(("oscillator", key), table, key));
        let system = System::Oscillator(Oscillator { mass, damping, stiffness });
        let (system, planes) = if two {
            system.validate().map_err(|error| self.at_key(error))?;
            (system.structure().in_two_planes().into(), Planes::Two(1))
        } else {
            (system, Planes::One)
        };
        Ok(Built { model: Model::Oscillator, system, planes, pending: None })
    }

    /// The structure that `table` of this `kind` describes, in one plane, without the damping of
    /// `[system.damping]`.
    fn structure(
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
    fn two_planes(&mut self, planes: Option<Spanned<f64>>, kind: &str) -> Result<bool> {
        let Some(planes) = planes else { return Ok(false) };
        match (*planes.get_ref(), kind) {
            (1.0, _) => Ok(false),
            (2.0, "oscillator" | "chain" | "beam" | "matrices" | "modal") => Ok(true),
            (2.0, kind) => {
                let title = format!("`system.planes` is 2 beside a {kind}");
                let help = "expected no planes: a bar moves along itself; a tube in bending is a beam";
                Err(self.source.error(planes.span(), &title, help))
            }
            _ => Err(self.refuse_as(planes.span(), "system.planes")),
        }
    }

    fn chain(&mut self, chain: &Section<'_>) -> Result<Chain> {
        let (Some(masses), Some(springs)) = (chain.get("masses"), chain.get("springs")) else {
            return Err(self.refuse_as(chain.span.clone(), "system.chain"));
        };
        let (key, subject) = ("system.chain.masses", Subject::from(("chain", "masses")));
        self.positions.push((subject.clone(), masses.span()));
        let masses = match (masses.get_ref(), chain.number("mass")) {
            (Value::Number(x), Some(mass)) => {
                let count = self.count(key, *x, masses.span(), MOST_MASSES)?;
                self.positions.push((subject.value(0), mass.span()));
                vec![self.number(("chain", "mass"), &mass); count]
            }
            (Value::List(items), None) => self.list(key, subject, items)?,
            (Value::List(_), Some(mass)) => {
                let help = "expected mass only where masses says how many there are";
                return Err(self.source.error(mass.span(), "`system.chain.mass` beside a list of masses", help));
            }
            (Value::Number(_), None) => {
                let help = "expected mass = a number above 0, in kg: that of each";
                return Err(self.source.error(masses.span(), "`mass` is missing in `system.chain`", help));
            }
            _ => return Err(self.refuse_as(masses.span(), key)),
        };
        let (key, subject) = ("system.chain.springs", Subject::from(("chain", "springs")));
        self.positions.push((subject.clone(), springs.span()));
        let springs = match springs.get_ref() {
            Value::Number(k) => {
                self.positions.push((subject.value(0), springs.span()));
                vec![*k; masses.len().saturating_sub(1)]
            }
            Value::List(items) => self.list(key, subject, items)?,
            _ => return Err(self.refuse_as(springs.span(), key)),
        };
        let mut grounds = [0.0; 2];
        for (side, ground) in ["left", "right"].into_iter().zip(&mut grounds) {
            let Some(end) = chain.get(side) else { continue };
            *ground = match self.end("system.chain", side, end)? {
                End::Free => 0.0,
                End::Sprung { stiffness, .. } => stiffness,
                End::Pinned | End::Clamped => return Err(self.refuse_as(end.span(), &format!("system.chain.{side}"))),
            };
        }
        Ok(Chain { masses, springs, grounds })
    }
}
