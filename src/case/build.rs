//! Builds a case from a case file. The scene and the options check the values themselves; this
//! module knows the position of each value in the file, and refuses combinations that the format
//! allows but that make no sense.

use super::builder::{Builder, MOST_MASSES};
use super::case_file::CaseFile;
use super::check;
use super::model::Model;
use super::planes::Planes;
use super::report::Source;
use super::schema::CASE;
use super::value::Section;
use super::walls::NewWall;
use super::{Case, FileRead, PenaltyOptions, Place, StatisticsOptions, Truncated, Written};
use crate::error::{Error, Result, Subject, escaped};
use crate::scene::{Condensation, Damping, Row, Scene, Slider, State, Structure, System, Turbulence};
use crate::scheme::{Integrator, PenaltyLaw, equilibrium};
use crate::study::truncation::{Start, Unreduced};
use std::ops::Range;
use toml::Spanned;

/// Builds the case of `document`.
///
/// If a `start` is given and has as many degrees of freedom as the scene, the scene starts from it
/// instead of the file's initial state; a rigid wall behind which it lies moves the body to the
/// wall.
pub(super) fn case(document: &CaseFile, start: Option<&State>) -> Result<Case> {
    let (name, text) = (document.name_with_changes(), document.effective()?);
    let source = Source { name: &name, text: &text };
    let values = check::read(&source, &CASE)?;
    let mut builder = Builder {
        source,
        positions: Vec::new(),
        document,
        owner: "system",
        model: Model::Oscillator,
        planes: Planes::One,
        modes: None,
        joints: Vec::new(),
        materials: Vec::new(),
        body: None,
        n: 1,
        static_correction: false,
        is_changed_later: false,
        written: Written::default(),
    };
    builder.case(&Section::root(&values), start)
}

impl Builder<'_> {
    fn case(&mut self, file: &Section<'_>, start: Option<&State>) -> Result<Case> {
        let (system, time) = (file.required_section("system"), file.required_section("time"));
        self.modes = self.modes(&system)?;
        let built = self.system(file)?;
        let total = built.system.degrees_of_freedom();
        self.describe(file, (built.model, built.planes), total)?;
        let modes = self.modes_of_planes()?.or(self.modes_of_data(file, total));
        self.is_changed_later = modes.is_some_and(|modes| modes < total) || built.pending.is_some();
        let duration = self.end_of_run(&time)?;
        let (scene, places, sliders) = self.scene(file, built.system, duration)?;
        let (wear, sectors) = self.wear(file.section("wear").as_ref())?;
        let turbulence = self.fields(file, scene.duration, modes.is_some())?;
        let (is_step_given, time) = (time.get("step").is_some(), self.time(&time, duration, sectors));
        let statistics = file.section("statistics").map(|section| self.statistics(&section));
        let penalty = file.section("penalty").map(|penalty| self.penalty(&penalty)).transpose()?;
        let penalty = penalty.unwrap_or_default().of(&scene);
        let (mut scene, condensation) = self
            .condensed(scene, built.pending.as_ref().filter(|d| modes.is_none() || !matches!(d, Damping::Modal(_))))?;
        let sliders = self.sliders_with_mass(sliders, condensation.as_ref())?;
        self.start_in_equilibrium(&mut scene)?;
        let text = |key| file.word(key).map(|text| escaped(text.get_ref()).into_owned());
        let mut case = Case {
            name: self.document.name().to_owned(),
            document: self.document.clone(),
            title: text("title"),
            source: text("source"),
            model: self.model.clone(),
            planes: self.planes,
            places,
            scene,
            sliders,
            condensation,
            truncated: None,
            fluid_elastic: None,
            time,
            statistics,
            penalty,
            wear,
            written: std::mem::take(&mut self.written),
        };
        let set_start = |case: &mut Case| start.into_iter().for_each(|start| start_from(&mut case.scene, start));
        let built_already = modes.is_none() && case.sliders.is_empty() && is_step_given;
        if built_already {
            set_start(&mut case);
        }
        case.check().map_err(|error| self.locate(error, &case.scene))?;
        match (modes, file.section("flow")) {
            (Some(modes), _) => self.reduce(&mut case, modes, (built.pending, turbulence), file)?,
            (None, Some(flow)) => return Err(self.without_flow(&flow)),
            (None, None) => self.add_sliders(&mut case)?,
        }
        if !built_already {
            set_start(&mut case);
            self.choose_step(file, &mut case)?;
            case.check().map_err(|error| self.locate(error, &case.scene))?;
        }
        case.scatter_start();
        Ok(case)
    }

    /// Starts the `scene` in static equilibrium, where the file asks for that.
    fn start_in_equilibrium(&self, scene: &mut Scene) -> Result<()> {
        if self.written.start == Start::Equilibrium {
            scene.initial.q = equilibrium(scene).map_err(|error| self.locate(error, scene))?;
        }
        Ok(())
    }

    /// Notes what the system of `total` degrees of freedom is, and where its points lie.
    fn describe(&mut self, file: &Section<'_>, (model, planes): (Model, Planes), total: usize) -> Result<()> {
        (self.model, self.planes) = (model, planes);
        self.n = if let Planes::Two(n) = planes { n } else { total };
        self.lines(file)
    }

    /// The fields of all tables `[[turbulence]]` in a run until `end` (s).
    fn fields(&mut self, file: &Section<'_>, end: f64, modes: bool) -> Result<Vec<Turbulence>> {
        let mut fields = Vec::new();
        for (index, table) in file.sections("turbulence").iter().enumerate() {
            fields.extend(self.turbulence(index, table, end, modes)?);
        }
        Ok(fields)
    }

    /// The scene of `system` with its initial state, walls, supports, loads and probes, the place
    /// of each wall and slider, and the sliders, which the scene does not have yet.
    fn scene(&mut self, file: &Section<'_>, system: System, duration: f64) -> Result<(Scene, Vec<Place>, Vec<Slider>)> {
        let mut scene = Scene::at_rest(system).with_duration(duration);
        if let Some(initial) = file.section("initial") {
            scene.initial = self.initial(&initial)?;
        }
        self.materials = self.materials(file)?;
        let walls = self.walls_and_supports(file, &mut scene.supports)?;
        let sliders = self.sliders(&file.sections("slider"), &walls)?;
        self.loads(&file.sections("load"), &mut scene)?;
        let sites = walls.iter().map(NewWall::location).chain(sliders.iter().map(|new| new.site.clone()));
        scene.probes = self.probes(&file.sections("probe"), &sites.collect::<Vec<_>>())?;
        scene.output_times = self.output_times(&file.required_section("time"));
        let (all, mut places): (_, Vec<_>) = walls.into_iter().map(|new| (new.wall, new.place)).unzip();
        scene.walls = all;
        places.extend(sliders.iter().map(|new| new.site.place.clone()));
        Ok((scene, places, sliders.into_iter().map(|new| new.slider).collect()))
    }

    /// Reduces the case to its slowest `modes`, under the fields of `turbulence`, with the
    /// `damping` that is given by ratios of these modes; and its margins in a flow, which `file`
    /// asks for.
    fn reduce(
        &mut self,
        case: &mut Case,
        modes: usize,
        (damping, turbulence): (Option<Damping>, Vec<Turbulence>),
        file: &Section<'_>,
    ) -> Result<()> {
        let whole = Unreduced {
            scene: case.scene.clone(),
            damping: damping.filter(|damping| matches!(damping, Damping::Modal(_))),
            static_correction: self.static_correction,
            start: case.written.start,
            planes: self.planes.modes(),
            turbulence,
            sliders: case.sliders.clone(),
            scatter: None,
        };
        // Where the file leaves `modes` out all are kept, which condensed degrees of freedom do not
        // have.
        let all = whole.scene.system.degrees_of_freedom();
        let modes = if file.required_section("system").get("modes").is_some() { modes } else { all };
        let reduction = whole.cut(modes).map_err(|error| self.locate(error, &case.scene))?;
        case.scene = reduction.scene.clone();
        case.fluid_elastic = self.flow(file, (&whole, &reduction.modes), &case.written.lines)?;
        case.truncated = Some(Truncated { whole, reduction });
        Ok(())
    }

    /// Full name and text of the file that the case calls `name` at `span`; an error names it after
    /// `owner` and says what is `expected` in it.
    pub fn open(&mut self, owner: &str, name: &str, span: Range<usize>, expected: &str) -> Result<(String, String)> {
        let (path, text) = self.document.open(name).map_err(|reason| {
            let help = format!("{expected}; its path is relative to the case file");
            self.source.error(span, &format!("{owner} {name:?}: {reason}"), &help)
        })?;
        if self.written.files.iter().all(|known| known.file != name) {
            self.written.files.push(FileRead::new(name, &path, &text));
        }
        Ok((path, text))
    }

    /// The scene without its massless degrees of freedom, and with the damping that is applied
    /// after they are condensed.
    fn condensed(&self, scene: Scene, pending: Option<&Damping>) -> Result<(Scene, Option<Condensation>)> {
        let System::Structure(structure) = &scene.system else { return Ok((scene, None)) };
        if structure.massless().is_empty() {
            return Ok((scene, None));
        }
        let (mut less, condensation) = scene.condensed().map_err(|error| self.locate(error, &scene))?;
        let massless = |row: &Row| row.entries().iter().any(|(i, _)| condensation.massless.contains(i));
        let hole = scene.holes().find(|hole| massless(&hole.at.y) || massless(&hole.at.z));
        if let Some(hole) = hole {
            let span = self.nearest(&Subject::support(hole.name).part("at")).unwrap_or(0..0);
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
    fn modes(&mut self, system: &Section<'_>) -> Result<Option<usize>> {
        let modes = system.number("modes").map(|modes| self.whole_number("modes", &modes, MOST_MASSES)).transpose()?;
        if let Some(correction) = system.truth("static_correction") {
            self.positions.push(("static correction".into(), correction.clone()));
            self.static_correction = true;
            if modes.is_none() {
                let help = "expected modes = k beside it: without them nothing is left out that could be corrected";
                return Err(self.source.error(correction, "`static_correction` without `modes`", help));
            }
        }
        Ok(modes)
    }

    /// The number of modes in all planes, where the file asks for some in each.
    fn modes_of_planes(&self) -> Result<Option<usize>> {
        if let (Some(more), Planes::Two(n)) = (self.modes.filter(|modes| *modes > self.n), self.planes) {
            let expected = format!("from 1 to {n}, the degrees of freedom of one plane");
            return Err(self.at_key(Error::invalid("modes", more, expected)));
        }
        Ok(self.modes.map(|modes| modes * self.planes.modes()))
    }

    /// All of the `total` modes where every turbulence acts on modal data, which are modes already.
    fn modes_of_data(&self, file: &Section<'_>, total: usize) -> Option<usize> {
        let tables = file.sections("turbulence");
        let modal = |table: &Section<'_>| match &self.model {
            Model::Bodies(_) => {
                let body = table.word("body").and_then(|name| self.model.body(name.get_ref()));
                body.is_some_and(|body| matches!(body.model, Model::Modal(_)))
            }
            model => matches!(model, Model::Modal(_)),
        };
        (!tables.is_empty() && tables.iter().all(modal)).then_some(total)
    }

    fn statistics(&mut self, statistics: &Section<'_>) -> StatisticsOptions {
        let spectra = statistics.truth("spectra");
        self.note(("statistics", "spectra"), spectra.clone());
        let rest = self.optional(("statistics", "rest"), statistics, "rest").unwrap_or(0.0);
        StatisticsOptions { rest, spectra: spectra.is_some() }
    }

    fn penalty(&mut self, penalty: &Section<'_>) -> Result<PenaltyOptions> {
        if self.static_correction {
            let help = "expected no [penalty]: with static_correction rigid walls are springs of the compliance \
                        that the modes leave out already";
            return Err(self.source.error(penalty.span.clone(), "`penalty` beside static_correction", help));
        }
        let (epsilon, stiffness) = (penalty.numbers("epsilon"), penalty.numbers("stiffness"));
        if let (Some(_), Some(stiffness)) = (&epsilon, &stiffness) {
            let help = "expected epsilon for the source's law, or stiffness for the linear one";
            return Err(self.source.error(stiffness.span(), "`penalty` has both epsilon and stiffness", help));
        }
        if let (None, Some(damping)) = (&stiffness, penalty.span_of("damping")) {
            let help = "expected damping only beside stiffness: the other law has none";
            return Err(self.source.error(damping, "`penalty.damping` is given without stiffness", help));
        }
        for (key, list) in [("epsilon", &epsilon), ("stiffness", &stiffness)] {
            if let Some(list) = list.as_ref().filter(|list| list.get_ref().is_empty()) {
                return Err(self.refuse(list.span(), &format!("penalty.{key}"), "one value or more"));
            }
        }
        let mut laws = Vec::new();
        for epsilon in epsilon.iter().flat_map(Spanned::get_ref) {
            let epsilon = self.law(laws.len(), "epsilon", epsilon);
            laws.push(PenaltyLaw::Quartic { epsilon });
        }
        for stiffness in stiffness.iter().flat_map(Spanned::get_ref) {
            let key = Subject::nth("penalty law", laws.len()).part("damping");
            let damping = self.optional(key, penalty, "damping").unwrap_or(0.0);
            let stiffness = self.law(laws.len(), "stiffness", stiffness);
            laws.push(PenaltyLaw::Linear { stiffness, damping });
        }
        let integrator = penalty.word("integrator").map(|name| {
            name.get_ref().parse::<Integrator>().map_err(|_| {
                self.refuse(name.span(), "penalty.integrator", &Integrator::ALL.map(Integrator::name).join(", "))
            })
        });
        Ok(PenaltyOptions { laws, integrator: integrator.transpose()? })
    }

    fn law(&mut self, index: usize, what: &'static str, value: &Spanned<f64>) -> f64 {
        let law = Subject::nth("penalty law", index);
        self.positions.push((law.clone(), value.span()));
        self.number(law.part(what), value)
    }
}

/// Makes `scene` start from `state`, if it has as many degrees of freedom. If the state lies behind
/// a rigid wall, the body is moved to the wall and keeps its velocity.
fn start_from(scene: &mut Scene, state: &State) {
    let n = scene.system.degrees_of_freedom();
    if state.q.len() == n && state.v.len() == n {
        scene.initial.clone_from(state);
        scene.step_out_of_walls();
    }
}
