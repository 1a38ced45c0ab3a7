//! From a case file to a case. What a value may be is checked by the scene and the options themselves; this file knows
//! where each value stands, and what can be written but not be meant.

use super::file::{self, File, Number, Section};
use super::report::Source;
use super::{Case, PenaltyOptions, TimeOptions, table};
use crate::error::{Error, Result};
use crate::scene::{Load, Scene, Wall};
use crate::scheme::{Integrator, PenaltyLaw};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// How the text of a table file is found: its full name and its text, or why there is none.
pub(super) type TableReader<'a> = &'a dyn Fn(&str) -> std::result::Result<(String, String), String>;

/// Builds the case that `text` holds.
pub(super) fn case(text: &str, name: &str, tables: TableReader<'_>) -> Result<Case> {
    let source = Source { name, text };
    let file: File = toml::from_str(text).map_err(|error| source.toml(error))?;
    let mut builder = Builder { source, places: Vec::new(), tables };
    let case = builder.case(file)?;
    case.validate().map_err(|error| builder.locate(error, &case.scene))?;
    Ok(case)
}

struct Builder<'a> {
    source: Source<'a>,
    /// The key that an error names, and where its value stands.
    places: Vec<(String, Range<usize>)>,
    tables: TableReader<'a>,
}

impl Builder<'_> {
    fn case(&mut self, file: File) -> Result<Case> {
        let oscillator = file.system.value.oscillator.value;
        let mass = self.number("system.oscillator.mass", &oscillator.mass);
        let damping = self.number("system.oscillator.damping", &oscillator.damping);
        let stiffness = self.number("system.oscillator.stiffness", &oscillator.stiffness);
        let time = file.time.value;
        let end = self.number("time.end", &time.end);
        let mut scene = Scene::oscillator(mass, damping, stiffness).with_duration(end);
        if let Some(Section { value: initial, .. }) = file.initial {
            let displacement = self.optional("initial.displacement", initial.displacement.as_ref()).unwrap_or(0.0);
            let velocity = self.optional("initial.velocity", initial.velocity.as_ref()).unwrap_or(0.0);
            scene = scene.with_initial(&[displacement], &[velocity]);
        }
        for (index, wall) in file.wall.into_iter().enumerate() {
            scene.walls.push(self.wall(index, wall.value)?);
        }
        for (index, load) in file.load.into_iter().enumerate() {
            scene.loads.push(self.load(index, load)?);
        }
        let time = TimeOptions {
            step: self.number("time.step", &time.step),
            sample: self.optional("time.sample", time.sample.as_ref()),
            statistics_from: self.optional("time.statistics_from", time.statistics_from.as_ref()).unwrap_or(0.0),
        };
        let penalty = file.penalty.map(|penalty| self.penalty(penalty.value)).transpose()?.unwrap_or_default();
        let stem = Path::new(self.source.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case");
        Ok(Case { name: stem.to_owned(), title: file.title, source: file.source, scene, time, penalty })
    }

    fn wall(&mut self, index: usize, wall: file::Wall) -> Result<Wall> {
        let name = wall.name.get_ref();
        let key = |what: &str| format!("wall {name:?}: {what}");
        self.places.push((format!("wall {}: name", index + 1), wall.name.span()));
        let position = self.number(key("position"), &wall.position);
        let built = match wall.side.get_ref().as_str() {
            "upper" => Wall::upper(name, position),
            "lower" => Wall::lower(name, position),
            _ => return Err(self.refuse(wall.side.span(), &key("side"), "\"upper\" or \"lower\"")),
        };
        let restitution = self.optional(key("restitution"), wall.restitution.as_ref());
        let stiffness = self.optional(key("stiffness"), wall.stiffness.as_ref());
        let damping = self.optional(key("damping"), wall.damping.as_ref());
        match (restitution, stiffness, damping) {
            (None, None, None) => Ok(built),
            (Some(e), None, None) => Ok(built.with_restitution(e)),
            (None, Some(stiffness), damping) => Ok(built.with_elasticity(stiffness, damping.unwrap_or(0.0))),
            (Some(_), Some(_), _) => Err(self.source.error(
                wall.restitution.map_or(0..0, |e| e.span()),
                &format!("wall {name:?} has both restitution and stiffness"),
                "expected restitution for a rigid wall, or stiffness for an elastic one; what an elastic wall gives \
                 back follows from its stiffness and damping",
            )),
            (_, None, Some(_)) => Err(self.source.error(
                wall.damping.map_or(0..0, |c| c.span()),
                &format!("wall {name:?} has damping without stiffness"),
                "expected stiffness beside it, in N/m (an elastic wall); a rigid wall loses energy by restitution",
            )),
        }
    }

    fn load(&mut self, index: usize, load: Section<file::Load>) -> Result<Load> {
        let key = |what: &str| format!("load {}: {what}", index + 1);
        let file::Load { constant, harmonic, impulse, table } = load.value;
        self.places.push((format!("load {}", index + 1), load.span.clone()));
        let given: Vec<_> = [
            ("constant", constant.as_ref().map(|s| s.span.clone())),
            ("harmonic", harmonic.as_ref().map(|s| s.span.clone())),
            ("impulse", impulse.as_ref().map(|s| s.span.clone())),
            ("table", table.as_ref().map(|s| s.span.clone())),
        ]
        .into_iter()
        .filter_map(|(kind, span)| Some((kind, span?)))
        .collect();
        if let [(first, _), (second, span), ..] = given.as_slice() {
            return Err(self.source.error(
                span.clone(),
                &format!("load {} has two kinds, `{first}` and `{second}`", index + 1),
                "expected one kind in each [[load]]; loads add up, so write a second [[load]]",
            ));
        }
        if let Some(Section { value: constant, .. }) = constant {
            return Ok(Load::constant(self.number(key("force"), &constant.force)));
        }
        if let Some(Section { value: sine, .. }) = harmonic {
            let amplitude = self.number(key("amplitude"), &sine.amplitude);
            let frequency = self.number(key("frequency"), &sine.frequency);
            let phase = self.optional(key("phase"), sine.phase.as_ref()).unwrap_or(0.0);
            return Ok(Load::harmonic(amplitude, frequency, phase));
        }
        if let Some(Section { value: blow, .. }) = impulse {
            let impulse = self.number(key("impulse"), &blow.impulse);
            let time = self.optional(key("time"), blow.time.as_ref()).unwrap_or(0.0);
            return Ok(Load::impulse(impulse, time));
        }
        let Some(Section { value: table, .. }) = table else {
            let help = "expected one of constant = { force }, harmonic = { amplitude, frequency, phase }, \
                        impulse = { impulse, time }, table = { file }";
            return Err(self.source.error(load.span, &format!("load {} has no kind", index + 1), help));
        };
        let file = table.file.get_ref();
        let (path, text) = (self.tables)(file).map_err(|reason| {
            let help = "expected a CSV file with the header time_s,force_N; its path is relative to the case file";
            self.source.error(table.file.span(), &format!("load {}: table {file:?}: {reason}", index + 1), help)
        })?;
        Ok(Load::table(table::read(&path, &text)?))
    }

    fn penalty(&mut self, penalty: file::Penalty) -> Result<PenaltyOptions> {
        if let (Some(_), Some(stiffness)) = (&penalty.epsilon, &penalty.stiffness) {
            let help = "expected epsilon for the source's law, or stiffness for the linear one";
            return Err(self.source.error(stiffness.span(), "`penalty` has both epsilon and stiffness", help));
        }
        if let (None, Some(damping)) = (&penalty.stiffness, &penalty.damping) {
            let help = "expected damping only beside stiffness: the other law has none";
            return Err(self.source.error(damping.span(), "`penalty.damping` is given without stiffness", help));
        }
        for (key, list) in [("epsilon", &penalty.epsilon), ("stiffness", &penalty.stiffness)] {
            if let Some(list) = list.as_ref().filter(|list| list.get_ref().is_empty()) {
                return Err(self.refuse(list.span(), &format!("penalty.{key}"), "one value or more"));
            }
        }
        let mut laws = Vec::new();
        for epsilon in penalty.epsilon.iter().flat_map(Spanned::get_ref) {
            let epsilon = self.law(laws.len(), "epsilon", epsilon);
            laws.push(PenaltyLaw::Quartic { epsilon });
        }
        for stiffness in penalty.stiffness.iter().flat_map(Spanned::get_ref) {
            let key = format!("penalty law {}: damping", laws.len() + 1);
            let damping = self.optional(key, penalty.damping.as_ref()).unwrap_or(0.0);
            let stiffness = self.law(laws.len(), "stiffness", stiffness);
            laws.push(PenaltyLaw::Linear { stiffness, damping });
        }
        let integrator = match &penalty.integrator {
            Some(name) => Some(name.get_ref().parse::<Integrator>().map_err(|_| {
                self.refuse(name.span(), "penalty.integrator", &Integrator::ALL.map(Integrator::name).join(", "))
            })?),
            None => None,
        };
        Ok(PenaltyOptions { laws, integrator })
    }

    fn law(&mut self, index: usize, what: &str, value: &Spanned<Number>) -> f64 {
        self.places.push((format!("penalty law {}", index + 1), value.span()));
        self.number(format!("penalty law {}: {what}", index + 1), value)
    }

    /// The number, its place noted under the key by which an error would name it.
    fn number(&mut self, key: impl Into<String>, value: &Spanned<Number>) -> f64 {
        self.places.push((key.into(), value.span()));
        value.get_ref().0
    }

    fn optional(&mut self, key: impl Into<String>, value: Option<&Spanned<Number>>) -> Option<f64> {
        value.map(|value| self.number(key, value))
    }

    fn refuse(&self, span: Range<usize>, key: &str, expected: &str) -> Error {
        let title = format!("{key} is {}", self.source.slice(span.clone()));
        self.source.error(span, &title, &format!("expected {expected}"))
    }

    /// The same error, shown at its place.
    fn locate(&self, error: Error, scene: &Scene) -> Error {
        let Error::Invalid { key, value, expected } = error else { return error };
        let place = |key: &str| self.places.iter().find(|(k, _)| k == key).map(|(_, span)| span.clone());
        // A start that is not written down is 0: then the wall that it lies behind is what is wrong.
        let behind = |wall: &&Wall| wall.law.is_rigid() && wall.gap(wall.at.dot(&scene.initial.q)) < 0.0;
        let wall = || scene.walls.iter().find(behind).filter(|_| key == "initial.displacement");
        let span = place(&key)
            .or_else(|| wall().and_then(|wall| place(&format!("wall {:?}: position", wall.name))))
            .or_else(|| place(key.split(": ").next().unwrap_or_default()))
            .unwrap_or(0..0);
        self.source.error(span, &format!("{key} is {value}"), &format!("expected {expected}"))
    }
}
