//! Scenes.

use crate::error::{raise, wrong};
use crate::load::Load;
use crate::origin::Origin;
use crate::pickle::{Reduced, State, pickled, unpickled};
use crate::place::{Model, Place};
use crate::plan::Plan;
use crate::run::Run;
use crate::values::{Damping, Values, whole};
use crate::wall::Wall;
use crate::work::{LARGE, compute, compute_apart};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use serde::{Deserialize, Serialize};
use signorini as sg;
use signorini::wear::{Archard, Growth};
use std::mem;

/// M q̈ + C q̇ + K q = f(t) + Gᵀ r(t), bounded by walls, over a duration. Scenes are made by
/// ``oscillator``, ``chain``, ``bar``, ``beam``, ``matrices``, ``modal`` and ``load``, never
/// change, are equal by value, and can be pickled.
#[pyclass(frozen, eq, module = "signorini", from_py_object)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// The scene that is run.
    pub scene: sg::Scene,
    /// How its locations are interpreted.
    pub model: Model,
    /// The scene from which it was made, where that differs.
    pub origin: Option<Box<Origin>>,
    /// The laws of wear of its supports, by their names, and what becomes of their gaps.
    pub laws: Vec<(String, Archard, Growth)>,
}

impl Scene {
    pub fn new(scene: sg::Scene, model: Model) -> Self {
        Self { scene, model, origin: None, laws: Vec::new() }
    }
}

#[pymethods]
impl Scene {
    /// The scene with the given values in place of its own.
    ///
    /// Parameters
    /// ----------
    /// walls : sequence of Wall, optional
    /// loads : sequence of Load, optional
    /// probes : mapping of str to place, optional
    ///     Places whose displacement and velocity are recorded, by name.
    /// output_times : sequence of float, optional
    ///     s, increasing: times at which `Run.output` has the states of the probes; they need not
    ///     be rows. Those after the end are left out, as `Run.notes` then says.
    /// displacement, velocity : float or sequence of float, optional
    ///     The start, m and m/s: one value per degree of freedom.
    /// duration : float, optional
    ///     s.
    /// damping : float, sequence of float or Rayleigh, optional
    ///     Of a structure: a share of critical damping for all modes, one for each from the slowest
    ///     on (the last for all further ones), or Rayleigh's.
    /// modes : int, optional
    ///     Reduce a structure to this many modes, the slowest.
    /// static_correction : bool, optional
    ///     Whether walls get the compliance of the modes left out.
    ///
    /// Returns
    /// -------
    /// Scene
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For the first value that makes no sense: which, and what would be accepted.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> free = sg.oscillator(1.0, 0.2, 100.0)
    /// >>> struck = free.replace(walls=[sg.Wall.upper("stop", 5e-3)], velocity=0.1)
    /// >>> struck.run("event").impulse("stop") < 0
    /// True
    #[pyo3(signature = (*, walls=None, loads=None, probes=None, output_times=None, displacement=None, velocity=None,
                        duration=None, damping=None, modes=None, static_correction=None))]
    #[expect(clippy::too_many_arguments, reason = "they are Python's keywords")]
    fn replace(
        &self,
        py: Python<'_>,
        walls: Option<Vec<Wall>>,
        loads: Option<Vec<Load>>,
        probes: Option<Bound<'_, PyDict>>,
        output_times: Option<Vec<f64>>,
        displacement: Option<Values>,
        velocity: Option<Values>,
        duration: Option<f64>,
        damping: Option<Damping>,
        modes: Option<Bound<'_, PyAny>>,
        static_correction: Option<bool>,
    ) -> PyResult<Self> {
        let modes =
            modes.map(|modes| whole("modes", &modes, 1, u64::from(u32::MAX))).transpose()?.map(|modes| modes as usize);
        let own = || Origin::of(self.scene.clone());
        let mut origin = self.origin.as_deref().cloned().unwrap_or_else(own);
        let scene = &mut origin.scene;
        let n = scene.system.degrees_of_freedom();
        if let Some(walls) = walls {
            let flat = self.flat_walls(walls, n)?;
            replace_flat(scene, flat);
        }
        if let Some(loads) = loads {
            scene.loads = self.loads_of(loads, n)?;
        }
        if let Some(probes) = probes {
            scene.probes = self.probes_of(&probes, n)?;
        }
        scene.output_times = output_times.unwrap_or_else(|| mem::take(&mut scene.output_times));
        displacement.map_or(Ok(()), |values| values.put("displacement", &mut scene.initial.q))?;
        velocity.map_or(Ok(()), |values| values.put("velocity", &mut scene.initial.v))?;
        scene.duration = duration.unwrap_or(scene.duration);
        if let (Some(_), sg::System::Oscillator(_)) = (&damping, &scene.system) {
            return Err(wrong(
                "damping",
                "given, beside that of the oscillator",
                "no damping here: `oscillator` takes it, in N s/m",
            ));
        }
        origin.damping = damping.map(|damping| damping.0).or(origin.damping);
        origin.modes = modes.or(origin.modes);
        origin.static_correction = static_correction.unwrap_or(origin.static_correction);
        if origin.static_correction && origin.modes.is_none() {
            return Err(wrong("static_correction", "True, without modes", "modes: it replaces those left out"));
        }
        let built = if n < LARGE {
            compute(py, || origin.built())?
        } else {
            let origin = origin.clone();
            compute_apart(py, move || origin.built())?
        };
        let same = origin.damping.is_none() && origin.modes.is_none() && built.initial.q.len() == n;
        let (model, laws) = (self.model.clone(), self.laws.clone());
        Ok(Self { scene: built, model, origin: (!same).then(|| Box::new(origin)), laws })
    }

    /// Runs the scene to its end.
    ///
    /// Parameters
    /// ----------
    /// scheme : str, optional
    ///     A scheme in the words of the command-line tool: ``"moreau-jean"``, ``"event"``,
    ///     ``"penalty:epsilon=1e-9"``, ``"moreau-jean:theta=0.6,qp=clarabel"``; chosen if left out.
    /// step : float, optional
    ///     s. Every scheme but ``event`` needs one, or ``accuracy``.
    /// accuracy : float, optional
    ///     The error to keep, as a share of the gap; scheme and step that keep it are found.
    /// sample : float, optional
    ///     Time between two recorded rows, s; every step, a thousand rows of ``event``, and with
    ///     ``accuracy`` the coarsest step tried.
    /// statistics_from : float
    ///     Where the window of the statistics begins, s.
    ///
    /// Returns
    /// -------
    /// Run
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For a wrong request.
    /// RunError
    ///     For a run that failed: `DivergedError`, `TooManyEventsError`, `NotSolvedError`, or
    ///     `RefutedError`, whose ``run`` is the run that broke the scheme's promises.
    ///
    /// Warns
    /// -----
    /// AccuracyWarning
    ///     Where the accuracy asked for is not kept to the end.
    /// ResultWarning
    ///     For each note that concerns the results: a step that does not resolve a load or a mode,
    ///     energy that the scheme created. `Run.notes` has them too.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> scene = sg.load("rigid-walls-sine").scene.replace(duration=2.0)
    /// >>> scene.run("moreau-jean", step=1e-4)
    /// <Run: moreau-jean, 20001 rows to 2.0 s, 20 contacts>
    #[pyo3(signature = (scheme=None, *, step=None, accuracy=None, sample=None, statistics_from=0.0))]
    fn run(
        slf: &Bound<'_, Self>,
        scheme: Option<&str>,
        step: Option<f64>,
        accuracy: Option<f64>,
        sample: Option<f64>,
        statistics_from: f64,
    ) -> PyResult<Py<Run>> {
        if let Some(tolerance) = accuracy {
            return Run::to_accuracy(slf, (scheme, step), tolerance, (sample, statistics_from), None);
        }
        let plan = Plan::new(&slf.get().scene, scheme, step, sample, statistics_from)?;
        plan.check_step(step)?;
        Run::make(slf, plan, None)
    }

    /// The flat walls, in the order of the results.
    #[getter]
    fn walls<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let flat = self.given().walls.iter().filter(|wall| !wall.is_round());
        let walls = flat.map(|wall| Wall { wall: wall.clone(), place: self.place(wall.row()) });
        PyTuple::new(py, walls.collect::<Vec<_>>())
    }

    /// The names of all walls, flat and round, in the order of the results.
    #[getter]
    fn _wall_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.scene.walls.iter().map(|wall| &wall.name))
    }

    /// The loads.
    #[getter]
    fn loads<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.given().loads.iter().map(|load| Load::of_scene(load.clone(), self.place(&load.at))))
    }

    /// The names of the probes; an oscillator has one without a name.
    #[getter]
    fn probes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.scene.probes.iter().map(|probe| &probe.name))
    }

    /// s.
    #[getter]
    fn duration(&self) -> f64 {
        self.scene.duration
    }

    /// The number of degrees of freedom that are stepped: of a scene reduced to modes, the modes.
    #[getter]
    fn degrees_of_freedom(&self) -> usize {
        self.scene.system.degrees_of_freedom() - self.sliders()
    }

    /// Half the least distance between two walls, m: errors are shares of it.
    #[getter]
    fn gap_scale(&self) -> f64 {
        self.scene.gap_scale()
    }

    fn __repr__(&self) -> String {
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let body = match (&self.plain().system, &self.origin) {
            (sg::System::Oscillator(o), _) => {
                format!("oscillator of {:?} kg, {:?} N s/m, {:?} N/m", o.mass, o.damping, o.stiffness)
            }
            (_, Some(origin)) if origin.modes.is_some() => {
                format!("{} of {} modes", self.degrees_of_freedom(), origin.scene.system.degrees_of_freedom())
            }
            _ => count(self.degrees_of_freedom(), "degree") + " of freedom",
        };
        let count_of = |n: usize, what: &str| count(n - self.sliders(), what);
        let (walls, loads) = (count_of(self.scene.walls.len(), "wall"), count_of(self.scene.loads.len(), "load"));
        let sliders = if self.sliders() > 0 { count(self.sliders(), "slider") + ", " } else { String::new() };
        format!("<Scene: {body}, {walls}, {sliders}{loads}, {:?} s>", self.scene.duration)
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        use sg::study::choice::{body, loads, walls};
        let scene = self.plain();
        let lines = move || {
            let mut lines = body(&scene);
            lines.extend(walls(&scene).into_iter().map(|(_, line)| line));
            lines.push(format!("{}, {:?} s", loads(&scene), scene.duration));
            Ok(lines.join("\n"))
        };
        // The natural frequencies of a large structure take seconds.
        if self.degrees_of_freedom() < LARGE { lines().map_err(raise) } else { compute_apart(py, lines) }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, State<'py>>> {
        Ok((slf.get_type().getattr("_restore")?, pickled(slf.py(), slf.get())?))
    }

    #[staticmethod]
    fn _restore(version: &str, bytes: &[u8]) -> PyResult<Self> {
        let scene: Self = unpickled(version, bytes)?;
        scene.scene.validate().map_err(raise)?;
        Ok(scene)
    }
}

impl Scene {
    /// The number of its sliders.
    fn sliders(&self) -> usize {
        self.origin.as_ref().map_or(0, |origin| origin.sliders.len())
    }

    /// The scene that is stepped, without its sliders.
    fn plain(&self) -> sg::Scene {
        match self.sliders() {
            0 => self.scene.clone(),
            count => self.scene.without_sliders(count),
        }
    }

    /// The scene in the coordinates in which it was given.
    fn given(&self) -> &sg::Scene {
        self.origin.as_ref().map_or(&self.scene, |origin| &origin.scene)
    }

    /// Walls of Python, each at its row among `n` degrees of freedom.
    fn flat_walls(&self, walls: Vec<Wall>, n: usize) -> PyResult<Vec<sg::Wall>> {
        let stand = |Wall { wall, place }: Wall| {
            let at = self.model.row(&format!("wall {:?}", wall.name), &place, n)?;
            Ok(wall.at(at))
        };
        walls.into_iter().map(stand).collect()
    }

    fn loads_of(&self, loads: Vec<Load>, n: usize) -> PyResult<Vec<sg::Load>> {
        let act = |(i, load): (usize, Load)| {
            let owner = format!("load {}", i + 1);
            let (load, place) = load.in_one_plane(&owner)?;
            let at = self.model.row(&owner, &place, n)?;
            Ok(sg::Load { at, ..load })
        };
        loads.into_iter().enumerate().map(act).collect()
    }

    fn probes_of(&self, probes: &Bound<'_, PyDict>, n: usize) -> PyResult<Vec<sg::Probe>> {
        let observe = |(name, place): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            let (name, place) = (name.extract::<String>()?, place.extract::<Place>()?);
            let at = self.model.row(&format!("probe {name:?}"), &place, n)?;
            Ok(sg::Probe { name, at })
        };
        probes.iter().map(observe).collect()
    }

    fn place(&self, row: &sg::Row) -> Place {
        match self.given().system {
            sg::System::Oscillator(_) if *row == sg::Row::dof(0) => Place::Only,
            _ => Place::Row(row.entries().to_vec()),
        }
    }
}

/// Gives the scene the walls `flat` in place of its flat ones. A support of flat walls stays where
/// all of them do, in their order; round supports, which only a case file makes, stay as they are.
fn replace_flat(scene: &mut sg::Scene, flat: Vec<sg::Wall>) {
    let (before, supports) = (mem::replace(&mut scene.walls, flat), mem::take(&mut scene.supports));
    for mut support in supports {
        let members = before.get(support.walls.clone()).unwrap_or_default();
        let first = if members.iter().any(sg::Wall::is_round) {
            scene.walls.extend_from_slice(members);
            Some(scene.walls.len() - members.len())
        } else {
            let names = || members.iter().map(|wall| &wall.name);
            let is_support =
                |first: &usize| scene.walls[*first..].iter().map(|w| &w.name).take(members.len()).eq(names());
            (0..scene.walls.len()).find(is_support)
        };
        if let Some(first) = first {
            support.walls = first..first + members.len();
            scene.supports.push(support);
        }
    }
}
