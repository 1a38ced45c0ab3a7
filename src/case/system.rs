//! Reads the table `[system]`: from measured quantities to M, C and K.

use super::accepted::accepted;
use super::builder::{Builder, MOST_MASSES};
use super::file;
use super::model::Model;
use super::planes::Planes;
use super::value::{Number, Section, Value};
use super::wording::written;
use crate::error::{Error, Result, Subject};
use crate::scene::{Bar, BarEnd, Beam, BeamEnd, Chain, Damping, MOST_ELEMENTS, MassMatrix, Oscillator, System};
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
    pub fn system(&mut self, section: Section<file::System>, cut: bool) -> Result<Built> {
        let Section { span, value: system } = section;
        let given: Vec<(&'static str, Range<usize>)> = [
            ("oscillator", system.oscillator.as_ref().map(|s| s.span.clone())),
            ("chain", system.chain.as_ref().map(|s| s.span.clone())),
            ("bar", system.bar.as_ref().map(|s| s.span.clone())),
            ("beam", system.beam.as_ref().map(|s| s.span.clone())),
            ("matrices", system.matrices.as_ref().map(|s| s.span.clone())),
            ("modal", system.modal.as_ref().map(|s| s.span.clone())),
        ]
        .into_iter()
        .filter_map(|(kind, span)| Some((kind, span?)))
        .collect();
        let one = "expected one of the tables [system.oscillator], [system.chain], [system.bar], [system.beam], \
                   [system.matrices], [system.modal]";
        match given.as_slice() {
            [] => return Err(self.source.error(span, "`system` does not say what vibrates", one)),
            [_] => {}
            [(first, a), (second, b), ..] => {
                let later = if a.start > b.start { a } else { b };
                let title = format!("two systems, `{first}` and `{second}`");
                return Err(self.source.error(later.clone(), &title, one));
            }
        }
        let table = if given[0].0 == "modal" { "modal data" } else { given[0].0 };
        self.places.push(("system".into(), given[0].1.clone()));
        self.places.push((table.into(), given[0].1.clone()));
        let two = self.two_planes(system.planes.as_ref(), given[0].0)?;
        if let Some(oscillator) = system.oscillator {
            for (key, span) in [
                ("damping", system.damping.as_ref().map(|s| s.span.clone())),
                ("modes", system.modes.as_ref().map(Spanned::span)),
                ("static_correction", system.static_correction.as_ref().map(Spanned::span)),
            ] {
                if let Some(span) = span {
                    let title = format!("`system.{key}` beside an oscillator");
                    let help = "expected it beside a chain, bar, beam or matrices; an oscillator has one mode, \
                                and its damping in N s/m";
                    return Err(self.source.error(span, &title, help));
                }
            }
            let o = oscillator.value;
            let mass = self.number(("oscillator", "mass"), &o.mass);
            let damping = self.number(("oscillator", "damping"), &o.damping);
            let stiffness = self.number(("oscillator", "stiffness"), &o.stiffness);
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
        let (model, structure) = if let Some(chain) = system.chain {
            let chain = self.chain(chain.value)?;
            let structure = chain.structure();
            (Model::Chain(chain), structure)
        } else if let Some(bar) = system.bar {
            let bar = self.bar(bar.value)?;
            let structure = bar.structure();
            (Model::Bar(bar), structure)
        } else if let Some(beam) = system.beam {
            let beam = self.beam(beam.value)?;
            let structure = beam.structure();
            (Model::Beam(beam), structure)
        } else if let Some(matrices) = system.matrices {
            own_damping = matrices.value.damping.as_ref().map(Spanned::span);
            let structure = self.matrices(&matrices.value)?;
            (Model::Matrices(structure.mass.size()), Ok(structure))
        } else if let Some(modal) = system.modal {
            own_damping = modal.value.damping_ratios.as_ref().map(Spanned::span);
            let modal = self.modal(&modal.value, modal.span)?;
            let structure = modal.structure();
            (Model::Modal(modal), structure)
        } else {
            return Err(self.source.error(span, "`system` does not say what vibrates", one));
        };
        let mut structure = structure.map_err(|error| self.at_key(error))?;
        if let Some(damping) = system.damping {
            if own_damping.is_some() {
                let help = "expected the damping beside the matrices or modes, or [system.damping]";
                return Err(self.source.error(damping.span, "`system` gives its damping twice", help));
            }
            let massless = !structure.massless().is_empty();
            let damping = self.damping(damping)?;
            self.written.damping = Some(damping.clone());
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
    fn two_planes(&mut self, planes: Option<&Spanned<Number>>, kind: &str) -> Result<bool> {
        let Some(planes) = planes else { return Ok(false) };
        match (planes.get_ref().0, kind) {
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

    fn chain(&mut self, chain: file::Chain) -> Result<Chain> {
        let (key, subject) = ("system.chain.masses", Subject::from(("chain", "masses")));
        self.places.push((subject.clone(), chain.masses.span()));
        let masses = match (chain.masses.get_ref(), &chain.mass) {
            (Value::Number(x), Some(mass)) => {
                let count = self.count(key, *x, chain.masses.span(), MOST_MASSES)?;
                self.places.push((subject.value(0), mass.span()));
                vec![self.number(("chain", "mass"), mass); count]
            }
            (Value::List(items), None) => self.list(key, subject, items)?,
            (Value::List(_), Some(mass)) => {
                let help = "expected mass only where masses says how many there are";
                return Err(self.source.error(mass.span(), "`system.chain.mass` beside a list of masses", help));
            }
            (Value::Number(_), None) => {
                let help = "expected mass = a number above 0, in kg: that of each";
                return Err(self.source.error(chain.masses.span(), "`mass` is missing in `system.chain`", help));
            }
            _ => return Err(self.refuse_as(chain.masses.span(), key)),
        };
        let (key, subject) = ("system.chain.springs", Subject::from(("chain", "springs")));
        self.places.push((subject.clone(), chain.springs.span()));
        let springs = match chain.springs.get_ref() {
            Value::Number(k) => {
                self.places.push((subject.value(0), chain.springs.span()));
                vec![*k; masses.len().saturating_sub(1)]
            }
            Value::List(items) => self.list(key, subject, items)?,
            _ => return Err(self.refuse_as(chain.springs.span(), key)),
        };
        let mut grounds = [0.0; 2];
        for (side, end, ground) in
            [("left", &chain.left, 0), ("right", &chain.right, 1)].map(|(side, end, i)| (side, end, i))
        {
            let Some(end) = end else { continue };
            grounds[ground] = match self.end("system.chain", side, end)? {
                End::Free => 0.0,
                End::Sprung { stiffness, .. } => stiffness,
                End::Pinned | End::Clamped => return Err(self.refuse_as(end.span(), &format!("system.chain.{side}"))),
            };
        }
        Ok(Chain { masses, springs, grounds })
    }

    fn bar(&mut self, bar: file::Bar) -> Result<Bar> {
        let mass = match bar.mass_matrix.as_ref().map(|word| word.get_ref().as_str()) {
            None | Some("consistent") => MassMatrix::Consistent,
            Some("lumped") => MassMatrix::Lumped,
            Some(_) => {
                let span = bar.mass_matrix.map_or(0..0, |word| word.span());
                return Err(self.refuse_as(span, "system.bar.mass_matrix"));
            }
        };
        let mut ends = [BarEnd::Free; 2];
        for (i, (side, end)) in [("left", &bar.left), ("right", &bar.right)].into_iter().enumerate() {
            ends[i] = match self.end("system.bar", side, end)? {
                End::Free => BarEnd::Free,
                End::Clamped => BarEnd::Fixed,
                End::Sprung { stiffness, .. } => BarEnd::Sprung { stiffness },
                End::Pinned => return Err(self.refuse_as(end.span(), &format!("system.bar.{side}"))),
            };
        }
        Ok(Bar {
            length: self.number(("bar", "length"), &bar.length),
            area: self.number(("bar", "area"), &bar.area),
            youngs_modulus: self.number(("bar", "youngs_modulus"), &bar.youngs_modulus),
            density: self.number(("bar", "density"), &bar.density),
            elements: self.whole(("bar", "elements"), &bar.elements, MOST_ELEMENTS)?,
            left: ends[0],
            right: ends[1],
            mass,
        })
    }

    fn beam(&mut self, beam: file::Beam) -> Result<Beam> {
        let mut ends = [BeamEnd::Free; 2];
        for (i, (side, end)) in [("left", &beam.left), ("right", &beam.right)].into_iter().enumerate() {
            ends[i] = match self.end("system.beam", side, end)? {
                End::Free => BeamEnd::Free,
                End::Pinned => BeamEnd::Pinned,
                End::Clamped => BeamEnd::Clamped,
                End::Sprung { stiffness, rotational } => BeamEnd::Sprung { stiffness, rotational },
            };
        }
        Ok(Beam {
            length: self.number(("beam", "length"), &beam.length),
            youngs_modulus: self.number(("beam", "youngs_modulus"), &beam.youngs_modulus),
            density: self.number(("beam", "density"), &beam.density),
            outer_diameter: self.number(("beam", "outer_diameter"), &beam.outer_diameter),
            inner_diameter: self.optional(("beam", "inner_diameter"), beam.inner_diameter.as_ref()).unwrap_or(0.0),
            added_mass: self.optional(("beam", "added_mass"), beam.added_mass.as_ref()).unwrap_or(0.0),
            elements: self.whole(("beam", "elements"), &beam.elements, MOST_ELEMENTS)?,
            left: ends[0],
            right: ends[1],
        })
    }

    fn end(&mut self, table: &str, side: &str, end: &Spanned<Value>) -> Result<End> {
        let key = format!("{table}.{side}");
        match end.get_ref() {
            Value::Word(word) => match word.as_str() {
                "free" => Ok(End::Free),
                "pinned" => Ok(End::Pinned),
                "clamped" => Ok(End::Clamped),
                _ => Err(self.refuse_as(end.span(), &key)),
            },
            Value::Table(entries) => {
                let (mut stiffness, mut rotational) = (None, 0.0);
                for (name, value) in entries {
                    let key = format!("{key}.{}", name.get_ref());
                    let known =
                        name.get_ref() == "stiffness" || (name.get_ref() == "rotational" && table == "system.beam");
                    if !known {
                        let title = format!("unknown key `{}` in `{table}.{side}`", name.get_ref());
                        let help = format!("expected {}", accepted(&format!("{table}.{side}")).unwrap_or_default());
                        return Err(self.source.error(name.span(), &title, &help));
                    }
                    let x = self.finite(&key, value, "a number, 0 or more")?;
                    if x < 0.0 {
                        return Err(self.refuse(value.span(), &key, "a number, 0 or more"));
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
    pub fn list(&mut self, key: &str, subject: Subject, items: &[Spanned<Value>]) -> Result<Vec<f64>> {
        let mut list = Vec::with_capacity(items.len());
        for (i, item) in items.iter().enumerate() {
            let Value::Number(x) = item.get_ref() else { return Err(self.refuse_as(item.span(), key)) };
            self.places.push((subject.clone().value(i), item.span()));
            list.push(*x);
        }
        Ok(list)
    }

    /// A whole number from 1 to `most`.
    pub fn whole(&mut self, subject: impl Into<Subject>, value: &Spanned<Number>, most: usize) -> Result<usize> {
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
        self.refuse(span, key, accepted(key).unwrap_or("another value"))
    }
}
