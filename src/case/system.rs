//! Reads the table `[system]`: from measured quantities to M, C and K.

use super::builder::{Builder, MOST_MASSES};
use super::model::Model;
use super::planes::Planes;
use super::schema::accepted;
use super::value::{Section, Value};
use super::wording::written;
use crate::error::{Error, Result, Subject};
use crate::scene::{
    Bar, BarEnd, Beam, BeamEnd, BeamSection, Chain, Damping, MOST_ELEMENTS, MassMatrix, Oscillator, System,
};
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

/// All conditions at an end that the file can give; each system accepts some of them.
enum End {
    Free,
    Pinned,
    Clamped,
    Sprung { stiffness: f64, rotational: f64 },
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
        self.places.push(("system".into(), table.span.clone()));
        self.places.push((name.into(), table.span.clone()));
        let two = self.two_planes(system.number("planes"), kind)?;
        if kind == "oscillator" {
            for key in ["damping", "modes", "static_correction"] {
                if let Some(span) = system.span_of(key) {
                    let title = format!("`system.{key}` beside an oscillator");
                    let help = "expected it beside a chain, bar, beam or matrices; an oscillator has one degree of \
                                freedom, and its damping in N s/m";
                    return Err(self.source.error(span, &title, help));
                }
            }
            let [mass, damping, stiffness] =
                ["mass", "damping", "stiffness"].map(|key| self.required(("oscillator", key), &table, key));
            let system = System::Oscillator(Oscillator { mass, damping, stiffness });
            let (system, planes) = if two {
                system.validate().map_err(|error| self.at_key(error))?;
                (system.structure().in_two_planes().into(), Planes::Two(1))
            } else {
                (system, Planes::One)
            };
            return Ok(Built { model: Model::Oscillator, system, planes, pending: None });
        }
        let (mut own_damping, mut pending) = (None, None);
        let (model, structure) = match kind {
            "chain" => {
                let chain = self.chain(&table)?;
                let structure = chain.structure();
                (Model::Chain(chain), structure)
            }
            "bar" => {
                let bar = self.bar(&table)?;
                let structure = bar.structure();
                (Model::Bar(bar), structure)
            }
            "beam" => {
                let beam = self.beam(&table)?;
                if let (true, BeamSection::Rectangle { .. }) = (two, beam.section) {
                    let title = "`system.planes` is 2 beside a rectangular section";
                    let help = "expected no planes: a rectangular section bends in one plane; planes = 2 takes a \
                                tube, outer_diameter in place of width and height";
                    return Err(self.source.error(system.span_of("planes").unwrap_or(table.span), title, help));
                }
                let structure = beam.structure();
                (Model::Beam(beam), structure)
            }
            "matrices" => {
                own_damping = table.get("damping");
                let structure = self.matrices(&table)?;
                (Model::Matrices(structure.mass.size()), Ok(structure))
            }
            _ => {
                own_damping = table.get("damping_ratios");
                let modal = self.modal(&table)?;
                let structure = modal.structure();
                (Model::Modal(modal), structure)
            }
        };
        let mut structure = structure.map_err(|error| self.at_key(error))?;
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
            (true, Model::Matrices(_)) => Planes::Named,
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

    /// True for `planes = 2`, which `kind` must allow.
    fn two_planes(&mut self, planes: Option<Spanned<f64>>, kind: &str) -> Result<bool> {
        let Some(planes) = planes else { return Ok(false) };
        match (*planes.get_ref(), kind) {
            (1.0, _) => Ok(false),
            (2.0, "oscillator" | "chain" | "beam" | "matrices") => Ok(true),
            (2.0, kind) => {
                let title = format!("`system.planes` is 2 beside a {kind}");
                let why = match kind {
                    "bar" => "a bar moves along itself; a tube in bending is a beam",
                    _ => "of modes each point has the direction of its shape: name one point for y and one for z",
                };
                Err(self.source.error(planes.span(), &title, &format!("expected no planes: {why}")))
            }
            _ => Err(self.refuse_as(planes.span(), "system.planes")),
        }
    }

    fn chain(&mut self, chain: &Section<'_>) -> Result<Chain> {
        let (Some(masses), Some(springs)) = (chain.get("masses"), chain.get("springs")) else {
            return Err(self.refuse_as(chain.span.clone(), "system.chain"));
        };
        let (key, subject) = ("system.chain.masses", Subject::from(("chain", "masses")));
        self.places.push((subject.clone(), masses.span()));
        let masses = match (masses.get_ref(), chain.number("mass")) {
            (Value::Number(x), Some(mass)) => {
                let count = self.count(key, *x, masses.span(), MOST_MASSES)?;
                self.places.push((subject.value(0), mass.span()));
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
        self.places.push((subject.clone(), springs.span()));
        let springs = match springs.get_ref() {
            Value::Number(k) => {
                self.places.push((subject.value(0), springs.span()));
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

    fn bar(&mut self, bar: &Section<'_>) -> Result<Bar> {
        let mass = match bar.word("mass_matrix") {
            None => MassMatrix::Consistent,
            Some(word) => match *word.get_ref() {
                "consistent" => MassMatrix::Consistent,
                "lumped" => MassMatrix::Lumped,
                _ => return Err(self.refuse_as(word.span(), "system.bar.mass_matrix")),
            },
        };
        let mut ends = [BarEnd::Free; 2];
        for (side, made) in ["left", "right"].into_iter().zip(&mut ends) {
            let Some(end) = bar.get(side) else { continue };
            *made = match self.end("system.bar", side, end)? {
                End::Free => BarEnd::Free,
                End::Clamped => BarEnd::Fixed,
                End::Sprung { stiffness, .. } => BarEnd::Sprung { stiffness },
                End::Pinned => return Err(self.refuse_as(end.span(), &format!("system.bar.{side}"))),
            };
        }
        let [left, right] = ends;
        let mut number = |key| self.required(("bar", key), bar, key);
        let [length, area] = ["length", "area"].map(&mut number);
        let [youngs_modulus, density] = ["youngs_modulus", "density"].map(&mut number);
        let elements = self.whole(("bar", "elements"), &bar.required("elements"), MOST_ELEMENTS)?;
        Ok(Bar { length, area, youngs_modulus, density, elements, left, right, mass })
    }

    fn beam(&mut self, beam: &Section<'_>) -> Result<Beam> {
        let mut ends = [BeamEnd::Free; 2];
        for (side, made) in ["left", "right"].into_iter().zip(&mut ends) {
            let Some(end) = beam.get(side) else { continue };
            *made = match self.end("system.beam", side, end)? {
                End::Free => BeamEnd::Free,
                End::Pinned => BeamEnd::Pinned,
                End::Clamped => BeamEnd::Clamped,
                End::Sprung { stiffness, rotational } => BeamEnd::Sprung { stiffness, rotational },
            };
        }
        let [left, right] = ends;
        let length = self.length(beam)?;
        let mut number = |key| self.required(("beam", key), beam, key);
        let youngs_modulus = number("youngs_modulus");
        let density = number("density");
        let section = self.cross_section(beam)?;
        let added_mass = self.optional(("beam", "added_mass"), beam, "added_mass").unwrap_or(0.0);
        let elements = self.whole(("beam", "elements"), &beam.required("elements"), MOST_ELEMENTS)?;
        Ok(Beam { length, youngs_modulus, density, section, added_mass, elements, left, right })
    }

    /// The section of a beam: the diameters of a tube, or the sides of a rectangle.
    fn cross_section(&mut self, beam: &Section<'_>) -> Result<BeamSection> {
        let missing = |key: &str, help: &str| {
            let title = format!("`{key}` is missing in `system.beam`");
            self.source.error(beam.span.clone(), &title, help)
        };
        let diameter = beam.span_of("outer_diameter").or(beam.span_of("inner_diameter"));
        match (diameter, beam.get("width"), beam.get("height")) {
            (Some(at), Some(_), _) | (Some(at), _, Some(_)) => {
                let help = "expected one section: outer_diameter and inner_diameter of a tube, or width and height of \
                            a rectangle";
                Err(self.source.error(at, "`system.beam` has a diameter and a side of a rectangle", help))
            }
            (None, Some(_), None) => {
                let help = "expected height = a number above 0, in m, in the direction of the vibration, beside width";
                Err(missing("height", help))
            }
            (None, None, Some(_)) => {
                let help = "expected width = a number above 0, in m, across the vibration, beside height";
                Err(missing("width", help))
            }
            (None, Some(_), Some(_)) => {
                let [width, height] = ["width", "height"].map(|key| self.required(("beam", key), beam, key));
                Ok(BeamSection::Rectangle { width, height })
            }
            (_, None, None) if beam.get("outer_diameter").is_none() => {
                let help = "expected outer_diameter = a number above 0, in m, or width and height of a rectangle";
                Err(missing("outer_diameter", help))
            }
            (_, None, None) => {
                let outer_diameter = self.required(("beam", "outer_diameter"), beam, "outer_diameter");
                let inner = self.optional(("beam", "inner_diameter"), beam, "inner_diameter");
                Ok(BeamSection::Tube { outer_diameter, inner_diameter: inner.unwrap_or(0.0) })
            }
        }
    }

    /// The length of a beam, m; where it is the sum of spans, their joints are noted.
    fn length(&mut self, beam: &Section<'_>) -> Result<f64> {
        let (length, spans) = (beam.number("length"), beam.numbers("spans"));
        match (length, spans) {
            (Some(length), None) => Ok(self.number(("beam", "length"), &length)),
            (None, Some(spans)) => {
                let mut reached = 0.0;
                for span in spans.get_ref() {
                    if !(span.get_ref().is_finite() && *span.get_ref() > 0.0) {
                        return Err(self.refuse(span.span(), "system.beam.spans", "numbers above 0, in m"));
                    }
                    reached += span.get_ref();
                    self.joints.push(reached);
                }
                self.places.push((("beam", "length").into(), spans.span()));
                Ok(reached)
            }
            (Some(_), Some(spans)) => {
                let help = "expected one of them: the length is the sum of the spans";
                Err(self.source.error(spans.span(), "`system.beam` has a length and spans", help))
            }
            (None, None) => {
                let help = "expected length = a number above 0, in m, or spans = a list of them, whose sum it is";
                Err(self.source.error(beam.span.clone(), "`length` is missing in `system.beam`", help))
            }
        }
    }

    fn end(&mut self, table: &str, side: &str, end: &Spanned<Value<'_>>) -> Result<End> {
        let key = format!("{table}.{side}");
        match end.get_ref() {
            Value::Word(word) => match word.as_ref() {
                "free" => Ok(End::Free),
                "pinned" => Ok(End::Pinned),
                "clamped" => Ok(End::Clamped),
                _ => Err(self.refuse_as(end.span(), &key)),
            },
            Value::Table(entries) => {
                let (mut stiffness, mut rotational) = (None, 0.0);
                for (name, value) in entries {
                    let part = format!("{key}.{}", name.get_ref());
                    let known =
                        name.get_ref() == "stiffness" || (name.get_ref() == "rotational" && table == "system.beam");
                    if !known {
                        let title = format!("unknown key `{}` in `{table}.{side}`", name.get_ref());
                        let help = format!("expected {}", accepted(&key).unwrap_or_default());
                        return Err(self.source.error(name.span(), &title, &help));
                    }
                    let x = self.finite(&part, value, "a number, 0 or more")?;
                    if x < 0.0 {
                        return Err(self.refuse(value.span(), &part, "a number, 0 or more"));
                    }
                    if name.get_ref() == "stiffness" { stiffness = Some(x) } else { rotational = x }
                }
                let stiffness = stiffness.ok_or_else(|| self.refuse_as(end.span(), &key))?;
                Ok(End::Sprung { stiffness, rotational })
            }
            _ => Err(self.refuse_as(end.span(), &key)),
        }
    }

    /// A list of numbers, with the position of each noted.
    pub fn list(&mut self, key: &str, subject: Subject, items: &[Spanned<Value<'_>>]) -> Result<Vec<f64>> {
        let mut list = Vec::with_capacity(items.len());
        for (i, item) in items.iter().enumerate() {
            let Value::Number(x) = item.get_ref() else { return Err(self.refuse_as(item.span(), key)) };
            self.places.push((subject.clone().value(i), item.span()));
            list.push(*x);
        }
        Ok(list)
    }

    /// A whole number from 1 to `most`.
    pub fn whole(&mut self, subject: impl Into<Subject>, value: &Spanned<f64>, most: usize) -> Result<usize> {
        let subject = subject.into();
        let x = self.number(subject.clone(), value);
        self.count(&written(&subject), x, value.span(), most)
    }

    fn count(&self, key: &str, x: f64, span: Range<usize>, most: usize) -> Result<usize> {
        if x.fract() == 0.0 && (1.0..=most as f64).contains(&x) {
            Ok(x as usize)
        } else {
            Err(self.refuse(span, key, &format!("a whole number from 1 to {most}")))
        }
    }

    /// An error at a key, with the accepted values of that key.
    pub fn refuse_as(&self, span: Range<usize>, key: &str) -> Error {
        self.refuse(span, key, &accepted(key).unwrap_or_default())
    }
}
