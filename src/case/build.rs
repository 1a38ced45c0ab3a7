//! Builds a case from a case file. The scene and the options check the values themselves; this
//! module knows the position of each value in the file, and refuses combinations that the format
//! allows but that make no sense.

use super::builder::{Builder, MOST_MASSES, TableReader};
use super::file::{self, File};
use super::model::Model;
use super::planes::Planes;
use super::report::Source;
use super::start;
use super::value::{Number, Section};
use super::wording::written;
use super::written::NewLoad;
use super::{Case, FileRead, PenaltyOptions, StatisticsOptions, TimeOptions, Truncated, Written};
use crate::error::{Error, Result, Subject, escaped};
use crate::scene::{Condensation, Damping, Row, Scene, Shape, State, Structure, Support, System, Wall};
use crate::scheme::{Integrator, PenaltyLaw, equilibrium};
use crate::study::truncation::{Start, Whole};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// Builds the case that `text` holds.
///
/// If a `start` is given and has as many degrees of freedom as the scene, the scene starts from it
/// instead of the file's initial state; a rigid wall behind which it lies moves the body to the
/// wall.
pub(super) fn case(text: &str, name: &str, tables: TableReader<'_>, start: Option<&State>) -> Result<Case> {
    let source = Source { name, text };
    let file: File =
        toml::from_str(text).map_err(|error: toml::de::Error| source.toml(error.clone()).caused_by(error))?;
    let mut builder = Builder {
        source,
        places: Vec::new(),
        tables,
        model: Model::Oscillator,
        planes: Planes::One,
        n: 1,
        static_correction: false,
        written: Written::default(),
    };
    builder.case(file, start)
}

impl Builder<'_> {
    fn case(&mut self, file: File, start: Option<&State>) -> Result<Case> {
        let modes = self.modes(&file.system.value)?;
        let built = self.system(file.system, modes.is_some())?;
        (self.model, self.planes) = (built.model, built.planes);
        let total = built.system.degrees_of_freedom();
        self.n = if let Planes::Two(n) = self.planes { n } else { total };
        if let (Some(more), Planes::Two(n)) = (modes.filter(|modes| *modes > self.n), self.planes) {
            let expected = format!("from 1 to {n}, the degrees of freedom of one plane");
            return Err(self.at_key(Error::invalid("modes", more, expected)));
        }
        let modes = modes.map(|modes| modes * self.planes.modes());
        let time = file.time.value;
        let mut scene = Scene {
            system: built.system,
            walls: Vec::new(),
            supports: Vec::new(),
            loads: Vec::new(),
            probes: Vec::new(),
            initial: State { q: vec![0.0; total], v: vec![0.0; total] },
            duration: self.number("duration", &time.end),
        };
        if let Some(Section { value: initial, .. }) = file.initial {
            self.written.start = self.start(&initial)?;
            scene.initial.q = self.field("displacement", initial.displacement.as_ref())?;
            scene.initial.v = self.field("velocity", initial.velocity.as_ref())?;
        }
        let (mut walls, mut supports) = (Vec::new(), Vec::new());
        for (index, wall) in file.wall.into_iter().enumerate() {
            walls.extend(self.walls(index, walls.len(), wall)?);
        }
        for (index, support) in file.support.into_iter().enumerate() {
            let (support, flats) = self.support(index, walls.len(), support)?;
            supports.push(support);
            walls.extend(flats);
        }
        let (wear, sectors) = self.wear(file.wear.as_ref())?;
        let mut second = Vec::new();
        let mut loads = Vec::new();
        for (index, load) in file.load.into_iter().enumerate() {
            let mut made = self.load(index, load, scene.duration, &scene.system)?.into_iter();
            loads.extend(made.next());
            second.extend(made);
        }
        // What a load adds beyond the first comes last, so that the loads of the file keep their
        // numbers.
        for NewLoad { load, place, origin } in loads.into_iter().chain(second) {
            scene.loads.push(load);
            self.written.loads.push(place);
            self.written.origins.push(origin);
        }
        scene.probes = self.probes(file.probe, &walls)?;
        let (all, places) = walls.into_iter().map(|new| (new.wall, new.place)).unzip();
        scene.walls = all;
        scene.supports = supports;
        let time = TimeOptions {
            step: self.number("step", &time.step),
            sample: self.optional("sample", time.sample.as_ref()),
            statistics_from: self.optional("statistics_from", time.statistics_from.as_ref()).unwrap_or(0.0),
            force_averaging: self
                .optional("force_averaging", time.force_averaging.as_ref())
                .unwrap_or(TimeOptions::FORCE_AVERAGING),
            sectors,
        };
        let statistics = file.statistics.map(|section| self.statistics(&section.value));
        if let Some(penalty) = file.penalty.as_ref().filter(|_| self.static_correction) {
            let help = "expected no [penalty]: with static_correction rigid walls are springs of the compliance \
                        that the modes leave out already";
            return Err(self.source.error(penalty.span.clone(), "`penalty` beside static_correction", help));
        }
        let penalty = file.penalty.map(|penalty| self.penalty(penalty.value)).transpose()?.unwrap_or_default();
        let stem = Path::new(self.source.name).file_stem().and_then(|stem| stem.to_str()).unwrap_or("case");
        let (scene, condensation) = self
            .condensed(scene, built.pending.as_ref().filter(|d| modes.is_none() || !matches!(d, Damping::Modal(_))))?;
        let mut scene = scene;
        if self.written.start == Start::Equilibrium {
            scene.initial.q = equilibrium(&scene).map_err(|error| self.locate(error, &scene))?;
        }
        let mut case = Case {
            name: stem.to_owned(),
            title: file.title.map(|title| escaped(&title).into_owned()),
            source: file.source.map(|source| escaped(&source).into_owned()),
            model: self.model.clone(),
            planes: self.planes,
            places,
            scene,
            condensation,
            truncated: None,
            time,
            statistics,
            penalty,
            wear,
            written: std::mem::take(&mut self.written),
        };
        if let (Some(start), None) = (start, modes) {
            start::carry_on(&mut case.scene, start);
        }
        case.check().map_err(|error| self.locate(error, &case.scene))?;
        if let Some(modes) = modes {
            let ratios = built.pending.filter(|damping| matches!(damping, Damping::Modal(_)));
            let whole = Whole {
                scene: case.scene.clone(),
                damping: ratios,
                static_correction: self.static_correction,
                start: case.written.start,
                planes: self.planes.modes(),
            };
            let reduction = whole.cut(modes).map_err(|error| self.locate(error, &case.scene))?;
            case.scene = reduction.scene.clone();
            if let Some(start) = start {
                start::carry_on(&mut case.scene, start);
            }
            case.truncated = Some(Truncated { whole, reduction });
            case.check().map_err(|error| self.locate(error, &case.scene))?;
        }
        Ok(case)
    }

    /// Full name and text of the file that the case calls `name`, or why it cannot be read.
    pub fn open(&mut self, name: &str) -> std::result::Result<(String, String), String> {
        let (path, text) = (self.tables)(name)?;
        if self.written.files.iter().all(|known| known.file != name) {
            self.written.files.push(FileRead::new(name, &path, &text));
        }
        Ok((path, text))
    }

    /// The scene without its massless degrees of freedom, and with the damping that is applied
    /// after they are condensed.
    fn condensed(&mut self, scene: Scene, pending: Option<&Damping>) -> Result<(Scene, Option<Condensation>)> {
        let System::Structure(structure) = &scene.system else { return Ok((scene, None)) };
        if structure.massless().is_empty() {
            return Ok((scene, None));
        }
        let (mut less, condensation) = scene.condensed().map_err(|error| self.locate(error, &scene))?;
        let massless = |row: &Row| row.entries().iter().any(|(i, _)| condensation.massless.contains(i));
        let round = |support: &&Support| matches!(support.shape, Shape::Round { .. });
        let hole = scene.supports.iter().filter(round).find(|hole| massless(&hole.at.y) || massless(&hole.at.z));
        if let Some(hole) = hole {
            let span = self.nearest(&Subject::support(&hole.name).part("at")).unwrap_or(0..0);
            let title = format!("support {:?} is round, around degrees of freedom without mass", hole.name);
            let help = "expected mass there, or shape = \"flats\": their stiffness makes a rigid hole an elastic one";
            return Err(self.source.error(span, &title, help));
        }
        let soft = less.walls.iter().zip(&condensation.compliance).filter(|(_, s)| **s > 0.0);
        for (wall, _) in soft {
            if let Some(span) = self.noted(&Subject::wall(&wall.name).part("restitution")) {
                let title = format!("wall {:?} has restitution, and pushes degrees of freedom without mass", wall.name);
                let help = "expected no restitution: what has no mass cannot rebound, and their stiffness makes \
                            the wall a spring; or mass there";
                return Err(self.source.error(span, &title, help));
            }
        }
        if let (System::Structure(structure), Some(damping)) = (&mut less.system, pending) {
            **structure =
                Structure::clone(structure).with_damping(damping).map_err(|error| self.locate(error, &scene))?;
        }
        Ok((less, Some(condensation)))
    }

    /// Applies `modes` and `static_correction`.
    fn modes(&mut self, system: &file::System) -> Result<Option<usize>> {
        let modes = system.modes.as_ref().map(|modes| self.whole("modes", modes, MOST_MASSES)).transpose()?;
        if let Some(correction) = system.static_correction.as_ref().filter(|word| *word.get_ref()) {
            self.places.push(("static correction".into(), correction.span()));
            self.static_correction = true;
            if modes.is_none() {
                let help = "expected modes = k beside it: without them nothing is left out that could be corrected";
                return Err(self.source.error(correction.span(), "`static_correction` without `modes`", help));
            }
        }
        Ok(modes)
    }

    fn statistics(&mut self, statistics: &file::Statistics) -> StatisticsOptions {
        let spectra = statistics.spectra.as_ref();
        self.places.extend(spectra.map(|word| (("statistics", "spectra").into(), word.span())));
        let rest = self.optional(("statistics", "rest"), statistics.rest.as_ref()).unwrap_or(0.0);
        StatisticsOptions { rest, spectra: spectra.is_some_and(|word| *word.get_ref()) }
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
            let key = Subject::nth("penalty law", laws.len()).part("damping");
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

    fn law(&mut self, index: usize, what: &'static str, value: &Spanned<Number>) -> f64 {
        let law = Subject::nth("penalty law", index);
        self.places.push((law.clone(), value.span()));
        self.number(law.part(what), value)
    }

    /// The number; its position is noted under the subject that an error would name.
    pub fn number(&mut self, subject: impl Into<Subject>, value: &Spanned<Number>) -> f64 {
        self.places.push((subject.into(), value.span()));
        value.get_ref().0
    }

    pub fn optional(&mut self, subject: impl Into<Subject>, value: Option<&Spanned<Number>>) -> Option<f64> {
        value.map(|value| self.number(subject, value))
    }

    pub fn refuse(&self, span: Range<usize>, key: &str, expected: &str) -> Error {
        let title = format!("{key} is {}", self.source.slice(span.clone()));
        self.source.error(span, &title, &format!("expected {expected}"))
    }

    /// The same error, shown at its position in the file; the original error is its source.
    pub fn locate(&self, error: Error, scene: &Scene) -> Error {
        let Error::Invalid { subject, value, expected } = &error else { return error };
        // An initial displacement that is not written is 0: in that case the error is shown at the
        // wall behind which it lies.
        let behind = |wall: &&Wall| wall.law.is_rigid() && wall.gap(wall.at.dot(&scene.initial.q)) < 0.0;
        let start = Subject::from(("initial state", "displacement"));
        let wall = || scene.walls.iter().find(behind).filter(|_| *subject == start);
        let outside = |support: &&Support| support.holds_out(&scene.initial.q);
        let hole = || scene.supports.iter().find(outside).filter(|_| *subject == start);
        let span = self
            .noted(subject)
            .or_else(|| wall().and_then(|wall| self.noted(&Subject::wall(&wall.name).part("position"))))
            .or_else(|| self.nearest(subject))
            .or_else(|| hole().and_then(|hole| self.noted(&Subject::support(&hole.name).part("gap"))))
            .unwrap_or(0..0);
        let title = format!("{} is {value}", written(subject));
        let or = if wall().is_some() || hole().is_some() {
            "; or equilibrium = true in place of it: at rest between the walls and in the holes"
        } else {
            ""
        };
        self.source.error(span, &title, &format!("expected {expected}{or}")).caused_by(error.clone())
    }

    fn noted(&self, subject: &Subject) -> Option<Range<usize>> {
        self.places.iter().find(|(s, _)| s == subject).map(|(_, span)| span.clone())
    }

    /// The position of the smallest enclosing part of `subject` that was noted.
    fn nearest(&self, subject: &Subject) -> Option<Range<usize>> {
        let whole = subject.whole()?;
        self.noted(&whole).or_else(|| self.nearest(&whole))
    }
}
