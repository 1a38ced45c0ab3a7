//! The stepper: one public type over all schemes.

use super::grid::{Frame, Handed, Scalar};
use super::kernel::Kernel;
use super::{Method, Scheme};
use crate::contact::{Episodes, Rates};
use crate::error::{Error, Result, Subject};
use crate::qp::Backend;
use crate::scene::{Checked, Row, Scene, State, System, Wall, WallLaw};
use crate::scheme::Counters;
use crate::step::{Contact, Contract, Path, Step};
use crate::time::MOST_STEPS;

/// Advances a scene step by step.
///
/// ```
/// use signorini::{Scene, Scheme, Stepper, Wall};
///
/// let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 0.1)).with_initial(&[0.0], &[1.0]);
/// let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3)?;
/// while stepper.time() < 0.2 {
///     let step = stepper.step()?;
///     assert!(step.q[0] < 0.1 + 1e-3);
/// }
/// assert_eq!(stepper.state().v, [-1.0]);
/// # Ok::<(), signorini::Error>(())
/// ```
///
/// A stepper goes on for as long as it is asked to, whatever the scheme: the duration of the scene is where [`run()`](crate::run()) ends,
/// and no limit here. The exact scheme, whose steps end at events, ends one there too. Loads go on past it: constant and harmonic
/// ones as before, blows at their times, tables by their rows and as zero after the last.
///
/// A step allocates nothing, apart from Clarabel's own single allocation where that solver was asked for.
#[derive(Debug)]
pub struct Stepper {
    scene: Checked,
    scheme: Scheme,
    contract: Contract,
    step: f64,
    backend: Backend,
    index: u64,
    /// Steps made before the state was last set, and the index they led to then.
    before: (u64, u64),
    kernel: Kernel,
    frame: Frame,
    episodes: Episodes,
}

impl Stepper {
    /// A stepper for `scene` by `method`, a [`Scheme`] or a [`Method`], with steps of `step` seconds. For the exact scheme, which steps
    /// from event to event, `step` is the longest stretch of one step.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scene, scheme or step that makes no sense.
    pub fn new(scene: &Scene, method: &(impl Copy + Into<Method>), step: f64) -> Result<Self> {
        Self::by(&Checked::new(scene)?, (*method).into(), step)
    }

    /// The same over a scene that is checked already.
    pub(crate) fn by(scene: &Checked, Method { scheme, backend }: Method, step: f64) -> Result<Self> {
        scheme.validate()?;
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::invalid("step", step, "a finite number above 0"));
        }
        let scene = match scheme {
            Scheme::Penalty { law, .. } => scene.with_laws(|scene| scene.penalised(law))?,
            Scheme::Event => scene.clone(),
            _ => without_quartic(scene)?.clone(),
        };
        // A wall behind a lever is more than the scalar kernels hold: then the oscillator is a structure of 1 × 1 matrices.
        let direct = scene.walls.iter().all(|wall| wall.at == Row::dof(0));
        let single = matches!(scene.system, System::Oscillator(_)) && direct;
        // One degree of freedom: the programme has one unknown, and a clamp solves it exactly.
        let backend = if single && backend == Backend::Auto { Backend::Clamp } else { backend };
        let kernel = Kernel::new(scene.shared(), &scheme, step, backend, single)?;
        let backend =
            if let Kernel::Structure(kernel) = &kernel { kernel.backend().unwrap_or(backend) } else { backend };
        let (q, v) = if single { Scalar::new(&scene, step).start(&scene) } else { (0.0, 0.0) };
        let frame = Frame::new(q, v, scene.walls.len());
        let contract = scheme.contract();
        let episodes = Episodes::new(&scene, scene.wall_masses(), contract);
        Ok(Self { scene, scheme, contract, step, backend, index: 0, before: (0, 0), kernel, frame, episodes })
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// [`Error::Qp`], [`Error::Newton`], [`Error::NotFinite`] or [`Error::TooManyEvents`], with the time and the step.
    #[inline]
    pub fn step(&mut self) -> Result<Step<'_>> {
        self.advance(0.0)?;
        Ok(self.last())
    }

    /// Advances by one step under an extra force (N, one value per degree of freedom), constant over the step: for
    /// co-simulation with another program.
    ///
    /// # Errors
    /// As [`Stepper::step`]; [`Error::Invalid`] for a force of the wrong length or not finite.
    #[inline]
    pub fn step_with(&mut self, extra: &[f64]) -> Result<Step<'_>> {
        if matches!(self.kernel, Kernel::Structure(_) | Kernel::StructureEvent(_)) {
            let n = self.scene.system.degrees_of_freedom();
            if let Some(force) = extra.iter().find(|force| !force.is_finite()) {
                return Err(Error::invalid("extra force", force, "a finite number"));
            }
            if extra.len() != n {
                let found = format!("{} values", extra.len());
                return Err(Error::invalid("extra force", found, format!("{n}, one per degree of freedom")));
            }
            self.advance_structure(Some(extra))?;
            return Ok(self.last());
        }
        match *extra {
            [force] if force.is_finite() => self.advance(force)?,
            [force] => return Err(Error::invalid("extra force", force, "a finite number")),
            _ => {
                let found = format!("{} values", extra.len());
                return Err(Error::invalid("extra force", found, "one per degree of freedom"));
            }
        }
        Ok(self.last())
    }

    /// Puts the scene into `state` at `time` (s), forwards or backwards: so a co-simulation repeats a step, or restarts from
    /// what it has saved of [`Stepper::time`] and [`Stepper::state`]. The state is that after whatever happened at that instant: a
    /// load's impulse at `time` is in it.
    ///
    /// A scheme on a grid goes on from a multiple of its step; the exact scheme from any time. `moreau-jean`, `implicit-euler`
    /// and the penalty's other one-step rules then make the same steps as if they had come there by themselves. `paoli-schatzman`,
    /// `generalized-alpha`, `newmark` and the penalty's `central-difference` carry more than the state from step to step (accelerations, a
    /// velocity half a step back) and begin anew as at a start; so does a contact of the exact scheme that has lasted. Contact episodes
    /// under way are forgotten. A [`Recorder`](crate::Recorder) or [`Judge`](crate::residual::Judge) that has watched so far cannot go on
    /// watching.
    ///
    /// The work counters go on. An extra force ([`Stepper::step_with`]) is not part of the state. The exact scheme sets itself up
    /// anew, which for a large structure costs more than a step.
    ///
    /// ```
    /// use signorini::{Scene, Scheme, Stepper, Wall};
    ///
    /// let scene = Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("stop", 0.01)).with_initial(&[0.0], &[1.0]);
    /// let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3)?;
    /// for _ in 0..5 {
    ///     stepper.step()?;
    /// }
    /// let (time, saved) = (stepper.time(), stepper.state());
    /// // A first guess of the force that the other program gives, and the step again with a better one.
    /// let guess = stepper.step_with(&[0.5])?.q[0];
    /// stepper.set_state(time, &saved)?;
    /// let better = stepper.step_with(&[0.2])?.q[0];
    /// assert!(better < guess);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for a time that is negative, not finite or no multiple of the step of a scheme on a grid, a state of the wrong
    /// length or not finite, or for the exact scheme one behind a rigid wall. The stepper is then as it was.
    pub fn set_state(&mut self, time: f64, state: &State) -> Result<()> {
        let exact = self.scheme == Scheme::Event;
        let index = self.index_at(time, exact)?;
        let n = self.scene.system.degrees_of_freedom();
        for (part, values) in [("displacement", &state.q), ("velocity", &state.v)] {
            if values.len() != n {
                let expected = format!("{n}, one per degree of freedom");
                return Err(Error::invalid(("state", part), format!("{} values", values.len()), expected));
            }
            if let Some(x) = values.iter().find(|x| !x.is_finite()) {
                return Err(Error::invalid(("state", part), x, "finite numbers"));
            }
        }
        let touch = self.scene.touching_distance();
        let behind = |wall: &&Wall| wall.law.is_rigid() && wall.gap(wall.at.dot(&state.q)) < -touch;
        if let (true, Some(wall)) = (exact, self.scene.walls.iter().find(behind)) {
            let found = format!("{:?} at the rigid wall {:?}", wall.at.dot(&state.q), wall.name);
            let expected = format!("a place before it, which stands at {:?}", wall.position);
            return Err(Error::invalid(("state", "displacement"), found, expected));
        }
        self.kernel.restart(self.scene.shared(), time, &state.q, &state.v)?;
        let first = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        self.frame.restart(time, first(&state.q), first(&state.v));
        self.episodes = Episodes::new(&self.scene, self.scene.wall_masses(), self.contract);
        let (made, from) = self.before;
        self.before = (made + (self.index - from), index);
        self.index = index;
        Ok(())
    }

    /// The number of the step that starts at `time`.
    fn index_at(&self, time: f64, exact: bool) -> Result<u64> {
        if !(time.is_finite() && time >= 0.0) {
            return Err(Error::invalid("time", format_args!("{time:?}"), "a finite number, 0 or more"));
        }
        if exact {
            return Ok(self.index);
        }
        let steps = time / self.step;
        // Times of steps are products, to the rounding of 1e10 of them.
        if (steps - steps.round()).abs() > 1e-6 || steps > MOST_STEPS {
            let expected = format!("a multiple of the step, {:?} s, at most 1e10 of them", self.step);
            return Err(Error::invalid("time", format_args!("{time:?}"), expected));
        }
        Ok(steps.round() as u64)
    }

    /// A step of several degrees of freedom.
    #[inline(never)]
    fn advance_structure(&mut self, extra: Option<&[f64]>) -> Result<()> {
        match &mut self.kernel {
            Kernel::Structure(kernel) => {
                kernel.advance(self.index, extra)?;
                kernel.tell(&self.scene, self.step, &mut self.episodes);
            }
            Kernel::StructureEvent(event) => event.advance(extra)?,
            _ => {}
        }
        self.index += 1;
        Ok(())
    }

    fn advance(&mut self, extra: f64) -> Result<()> {
        let (index, frame) = (self.index, &mut self.frame);
        frame.extra[0] = extra;
        match &mut self.kernel {
            Kernel::MoreauJean(kernel) => kernel.advance(index, extra, frame),
            Kernel::PaoliSchatzman(kernel) => kernel.advance(index, extra, frame),
            Kernel::Position(kernel) => kernel.advance(index, extra, frame),
            Kernel::Penalty(kernel) => kernel.advance(index, extra, frame),
            Kernel::CentralDifference(kernel) => kernel.advance(index, extra, frame),
            Kernel::Event(event) => event.advance(extra),
            Kernel::Structure(_) | Kernel::StructureEvent(_) => return self.advance_structure(None),
        }?;
        self.index += 1;
        // The exact scheme leaves the frame untouched and keeps its own episodes.
        if frame.touched || !self.episodes.idle() {
            let walls = &self.scene.walls;
            let seen = |wall: usize, v: &[f64]| walls.get(wall).map_or(0.0, |w| w.at.dot(v));
            let rates = |wall: usize| Rates {
                before: seen(wall, &frame.before),
                struck: seen(wall, &frame.struck),
                after: seen(wall, &frame.after),
            };
            self.episodes.see(frame.start, self.step, &frame.impulse, rates);
        }
        Ok(())
    }

    /// The step just made. Inlined, so that a caller pays for the fields it reads only.
    #[inline]
    fn last(&self) -> Step<'_> {
        let (index, frame) = (self.index - 1, &self.frame);
        if matches!(self.kernel, Kernel::Event(_) | Kernel::Structure(_) | Kernel::StructureEvent(_)) {
            return self.last_elsewhere(index);
        }
        Step {
            index,
            start: frame.start,
            end: frame.end,
            q: &frame.q,
            v: &frame.v,
            velocity_before: &frame.before,
            velocity_after: &frame.after,
            impulse: &frame.impulse,
            jump: &frame.jump,
            force: &frame.force,
            extra: &frame.extra,
            closed: self.episodes.closed(),
            path: Path::Grid,
        }
    }

    /// The step just made by a kernel that keeps a frame of its own.
    #[inline(never)]
    fn last_elsewhere(&self, index: u64) -> Step<'_> {
        match &self.kernel {
            Kernel::Structure(kernel) => kernel.step(index, &self.episodes),
            Kernel::StructureEvent(event) => event.step(index),
            Kernel::Event(event) => event.step(index, &self.frame.extra),
            _ => self.last(),
        }
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        match &self.kernel {
            Kernel::Event(event) => event.end(),
            Kernel::Structure(kernel) => kernel.end(),
            Kernel::StructureEvent(event) => event.end(),
            _ => self.frame.end,
        }
    }

    /// State reached; at the start, the state after any impulse at t = 0.
    #[must_use]
    pub fn state(&self) -> State {
        match &self.kernel {
            Kernel::Event(event) => State { q: event.q().to_vec(), v: event.v().to_vec() },
            Kernel::Structure(kernel) => {
                let (q, v) = kernel.state();
                State { q: q.to_vec(), v: v.to_vec() }
            }
            Kernel::StructureEvent(event) => {
                let (q, v) = event.state();
                State { q: q.to_vec(), v: v.to_vec() }
            }
            _ => State { q: self.frame.q.to_vec(), v: self.frame.v.to_vec() },
        }
    }

    /// The scene as the scheme sees it: a penalty's walls are springs here.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The same, shared.
    pub(crate) fn checked(&self) -> &Checked {
        &self.scene
    }

    /// The scheme.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// What every step keeps, for whoever judges it.
    #[must_use]
    pub fn contract(&self) -> Contract {
        self.contract
    }

    /// The solver of the quadratic programmes: the one in force.
    #[must_use]
    pub fn backend(&self) -> Backend {
        self.backend
    }

    /// Contact episodes that are still open.
    #[must_use]
    pub fn open_contacts(&self) -> Vec<Contact> {
        match &self.kernel {
            Kernel::Event(event) => event.open_contacts().copied().collect(),
            Kernel::StructureEvent(event) => event.open_contacts().copied().collect(),
            _ => self.episodes.still_open(),
        }
    }

    /// Stretches that the exact scheme has handed to moreau-jean so far; none for other schemes.
    #[must_use]
    pub fn handed(&self) -> &[Handed] {
        if let Kernel::StructureEvent(event) = &self.kernel { event.stretches() } else { &[] }
    }

    /// What the run has cost so far.
    #[must_use]
    pub fn counters(&self) -> Counters {
        let (made, index) = self.before;
        let mut counters = Counters { steps: made + (self.index - index), ..Counters::default() };
        self.kernel.count(&mut counters);
        counters
    }
}

/// The scene, if its walls are such that a quadratic programme can hold them: the φ² law is none of those.
fn without_quartic(scene: &Checked) -> Result<&Checked> {
    match scene.walls.iter().find(|wall| matches!(wall.law, WallLaw::Quartic { .. })) {
        Some(wall) => Err(Error::invalid(
            Subject::wall(&wall.name).part("law"),
            "the φ² penalty",
            "a rigid or an elastic wall, or the scheme penalty, which steps through that law",
        )),
        None => Ok(scene),
    }
}
