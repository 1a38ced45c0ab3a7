//! The maps of a case: every scheme, step and parameter, run in parallel.

use super::family::{self, MapRequest, Parameter, SchemeFamily};
use super::fine_reference::{FineReference, Range};
use super::recorded_run::{Record, STARTS, nudged, recorded_run};
use super::row::{Cell, StableRange, Subject};
use super::scale::Scale;
use crate::error::{Error, Result};
use crate::interrupt::Carried;
use crate::scene::{Scene, System};
use crate::scheme::{Integrator, PenaltyLaw, Scheme};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Fewest steps in the coarsest cell.
const LEAST_STEPS: f64 = 20.0;

/// Extent of the maps.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Smallest step as hω. The default, 10⁻⁴, gives 6 × 10⁴ steps per natural period, which
    /// resolves the stiffest penalty of the source (h²k_w/m = 0.01).
    pub finest: f64,
    /// Largest step as hω; by default there are two steps per natural period.
    pub coarsest: f64,
    /// Number of steps per decade.
    pub per_decade: f64,
    /// Number of contacts of the reference at which the horizon ends, unless the duration ends
    /// earlier: by default a hundred, enough for a gain of 1 % per impact to show.
    pub contacts: usize,
    /// Most steps in a cell: where the finest step would need more over the horizon, the grid
    /// starts at a coarser step.
    pub most_steps: f64,
    /// The schemes to map.
    pub families: Vec<SchemeFamily>,
}

impl Default for Grid {
    fn default() -> Self {
        Self {
            finest: 1e-4,
            coarsest: 3.2,
            per_decade: 7.0,
            contacts: 100,
            most_steps: 1e6,
            families: SchemeFamily::all(),
        }
    }
}

/// Most steps in all finest cells of a map times the number of degrees of freedom, and fewest steps
/// in one cell.
const MOST_WORK: f64 = 5e5;
const FEWEST_STEPS: f64 = 1e4;

impl Grid {
    fn check(&self) -> Result<()> {
        for (key, value) in [("finest", self.finest), ("coarsest", self.coarsest), ("per_decade", self.per_decade)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(key, format_args!("{value:?}"), "a number above 0"));
            }
        }
        if self.coarsest < self.finest {
            let expected = format!("at least the finest, {:?}", self.finest);
            return Err(Error::invalid("coarsest", format_args!("{:?}", self.coarsest), expected));
        }
        if self.contacts == 0 {
            return Err(Error::invalid("contacts", 0, "1 or more"));
        }
        Ok(())
    }

    /// The grid for `scene`: the default for one degree of freedom; for several, whose steps cost
    /// in proportion, coarser steps and fewer per decade. Steps are measured by the slowest
    /// frequency, and range from where most modes are resolved to where not even the slowest is.
    #[must_use]
    pub fn of(scene: &Scene) -> Self {
        match scene.system {
            System::Oscillator(_) => Self::default(),
            _ => {
                let n = scene.system.degrees_of_freedom().max(1) as f64;
                Self { per_decade: 4.0, most_steps: (MOST_WORK / n).max(FEWEST_STEPS), ..Self::default() }
            }
        }
    }
}

/// All runs needed for the maps of a case.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The frequency by which steps are measured.
    pub scale: Scale,
    /// Duration of each run, s: until the hundredth contact of the reference, at most the case's
    /// duration.
    pub horizon: f64,
    /// The steps, s, increasing.
    pub steps: Vec<f64>,
    /// The rows of the maps, family by family, the parameter increasing.
    pub subjects: Vec<Subject>,
    /// For each subject the index of its reference.
    rulers: Vec<usize>,
    references: Vec<(Scene, Scheme)>,
}

/// A row of a map, with its runs done.
#[derive(Debug, Clone)]
pub struct Row {
    /// Scheme, parameter and scene of the row.
    pub subject: Subject,
    /// One cell per step.
    pub cells: Vec<Cell>,
    /// Number of contacts in its reference runs.
    pub contacts: Range,
    /// The largest stable step, where the parameter value is the case's own.
    pub stable: Option<StableRange>,
}

/// The maps of a case.
#[derive(Debug, Clone)]
pub struct Maps {
    /// The frequency by which steps are measured.
    pub scale: Scale,
    /// Duration of each run, s.
    pub horizon: f64,
    /// The steps, s, increasing.
    pub steps: Vec<f64>,
    /// The rows, in the order of the plan.
    pub rows: Vec<Row>,
}

impl Plan {
    /// The plan for a case. It takes one run of the case, with the finest step over its whole
    /// duration.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] for a case without walls, and errors of that run.
    pub fn new(case: MapRequest<'_>, grid: &Grid) -> Result<Self> {
        family::check(case)?;
        grid.check()?;
        let scene = case.scene;
        let first = Scale::of(scene, None);
        let finest = |scale: &Scale, horizon: f64| (grid.finest / scale.omega).max(horizon / grid.most_steps);
        let own = reference_of(scene, None);
        let h = finest(&first, scene.duration);
        let record = recorded_run(&own.0, &own.1, h, scene.duration, f64::INFINITY)?;
        let ruler = FineReference::new(std::slice::from_ref(&record), scene, &first);
        let times = ruler.contact_times(&record);
        let horizon = times.get(grid.contacts).copied().unwrap_or(scene.duration).min(scene.duration);
        let scale = Scale::of(scene, times.first().copied());
        let finest = finest(&scale, horizon);
        let coarsest = (grid.coarsest / scale.omega).min(horizon / LEAST_STEPS).max(finest);
        let ratio = 10_f64.powf(1.0 / grid.per_decade);
        let columns = ((coarsest / finest).ln() / ratio.ln() + 1e-9).floor() as i32;
        let steps = (0..=columns).map(|i| finest * ratio.powi(i)).collect();
        let mut plan = Self { scale, horizon, steps, subjects: Vec::new(), rulers: Vec::new(), references: Vec::new() };
        for &family in &grid.families {
            let parameter = Parameter::of(family, case);
            let own = parameter.own(case);
            let several = parameter != Parameter::Epsilon && parameter != Parameter::PenaltyStiffness && own.len() > 1;
            for value in parameter.values(case, scale.mass * scale.omega.powi(2)) {
                let (scene, scheme) = parameter.at(family, value, scene)?;
                plan.add(family, parameter, value, scheme, scene, own.contains(&value) && !several, true)?;
            }
            // A case whose walls differ in the parameter gets a row of its own, outside the map.
            if several && let Ok((_, scheme)) = parameter.at(family, 1.0, scene) {
                plan.add(family, parameter, f64::NAN, scheme, scene.clone(), true, false)?;
            }
        }
        Ok(plan)
    }

    #[expect(clippy::too_many_arguments, reason = "the fields of a subject")]
    fn add(
        &mut self,
        family: SchemeFamily,
        parameter: Parameter,
        value: f64,
        scheme: Scheme,
        scene: Scene,
        own: bool,
        mapped: bool,
    ) -> Result<()> {
        let (law, seen) = match scheme {
            Scheme::Penalty { law, .. } => (Some(law), scene.penalised(law)?),
            _ => (None, scene.clone()),
        };
        let reference = reference_of(&scene, law);
        let known = self.references.iter().position(|r| *r == reference);
        self.rulers.push(known.unwrap_or_else(|| {
            self.references.push(reference);
            self.references.len() - 1
        }));
        self.subjects.push(Subject { family, parameter, value, scheme, scene, seen, own, mapped });
        Ok(())
    }

    /// Number of steps in all, for a progress bar.
    #[must_use]
    pub fn work(&self) -> u64 {
        let row: u64 = self.steps.iter().map(|h| self.cost(*h)).sum();
        row * self.subjects.len() as u64
            + self.cost(self.reference_step()) * self.references.len() as u64 * u64::from(STARTS)
    }

    fn cost(&self, h: f64) -> u64 {
        (self.horizon / h).ceil() as u64
    }

    fn reference_step(&self) -> f64 {
        self.steps.first().copied().unwrap_or(self.horizon)
    }

    /// Runs everything; `progress` is called with the number of steps taken, of [`Plan::work`]. The
    /// result does not depend on the number of threads.
    ///
    /// # Errors
    /// Errors of a reference run; a run of a map that fails is a cell with the reason in it.
    pub fn run(self, progress: &(dyn Fn(u64) + Sync)) -> Result<Maps> {
        let done = AtomicU64::new(0);
        let interrupt = Carried::here();
        let tell = |steps: u64| progress(done.fetch_add(steps, Ordering::Relaxed) + steps);
        let h = self.reference_step();
        let reference = |(scene, scheme): &(Scene, Scheme)| -> Result<FineReference> {
            let run = |start: u32| -> Result<Record> {
                let scene = nudged(scene, start, &self.scale);
                let record = recorded_run(&scene, scheme, h, self.horizon, f64::INFINITY)?;
                tell(self.cost(h));
                Ok(record)
            };
            Ok(FineReference::new(&(0..STARTS).map(run).collect::<Result<Vec<_>>>()?, scene, &self.scale))
        };
        let rulers: Vec<FineReference> =
            self.references.par_iter().map(|r| interrupt.over(|| reference(r))).collect::<Result<_>>()?;
        let ruled: Vec<(&Subject, &FineReference)> =
            self.subjects.iter().zip(self.rulers.iter().filter_map(|i| rulers.get(*i))).collect();
        // The most expensive tasks first, so that no thread is left with one of them at the end.
        let tasks: Vec<_> = self.steps.iter().flat_map(|h| ruled.iter().map(move |r| (*h, *r))).collect();
        let cell = |(h, (subject, ruler)): (f64, (&Subject, &FineReference))| {
            let cell = interrupt.over(|| subject.cell(ruler, &self.scale, h, self.horizon));
            tell(self.cost(h));
            cell
        };
        let cells: Vec<Cell> = tasks.into_par_iter().with_max_len(1).map(cell).collect();
        let row = |(i, (subject, ruler)): (usize, &(&Subject, &FineReference))| {
            let cells: Vec<Cell> = cells.iter().skip(i).step_by(ruled.len()).cloned().collect();
            let find = || StableRange::find(subject, &cells, ruler, &self.scale, self.horizon);
            let stable = subject.own.then(|| interrupt.over(find));
            Row { subject: (*subject).clone(), cells, contacts: ruler.contacts, stable }
        };
        let rows = ruled.par_iter().enumerate().map(row).collect();
        Ok(Maps { scale: self.scale, horizon: self.horizon, steps: self.steps.clone(), rows })
    }
}

/// The reference scheme: moreau-jean with θ = ½, which keeps energy between impacts and the impact
/// law exactly; for a penalty the discrete gradient on the same springs, which keeps the energy of
/// the springs. Both with the finest step of the grid.
fn reference_of(scene: &Scene, law: Option<PenaltyLaw>) -> (Scene, Scheme) {
    let scheme = match law {
        Some(law) => Scheme::Penalty { law, integrator: Integrator::DiscreteGradient },
        None => Scheme::MoreauJean { theta: 0.5 },
    };
    (scene.clone(), scheme)
}

impl Maps {
    /// The rows of one family that are drawn, the parameter increasing.
    pub fn map(&self, family: SchemeFamily) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.subject.family == family && row.subject.mapped)
    }

    /// The rows with the case's own parameters, in the order of families.
    pub fn own(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.subject.own)
    }
}
