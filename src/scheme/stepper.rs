//! The stepper: one public type over all schemes.

mod failure;
mod restart;

use super::fits;
use super::kernel::Kernel;
use super::{Handover, Method, Scheme};
use crate::error::{Error, Result};
use crate::interrupt::Asking;
use crate::qp::Backend;
use crate::scene::{Checked, Scene, State, positive};
use crate::scheme::Counters;
use crate::step::{Contact, Contract, LoadJumps, QuietSteps, Step};

/// Number of steps in a block, a power of 2: the longest loop without contact.
const BLOCK: u64 = 1 << 12;

/// A free motion that decays would need denormal numbers in the end, with which a step takes some
/// thirty times as long. At the end of each block of steps what is below this share of the gap
/// scale becomes 0.
const TINY: f64 = 1e-290;

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
/// A stepper makes steps for as long as it is called: the duration of the scene, where
/// [`run()`](crate::run()) ends, is no limit here. The exact scheme, whose steps end at events,
/// also ends a step there. Loads go on past it: constant and harmonic ones as before, blows at
/// their times, tables by their rows and as zero after the last.
///
/// A step allocates nothing, apart from Clarabel's own single allocation where that solver was
/// asked for, from the penalty in round holes, and from steps that `located` divides.
#[derive(Debug)]
pub struct Stepper {
    scene: Checked,
    scheme: Scheme,
    contract: Contract,
    step: f64,
    backend: Backend,
    index: u64,
    /// Number of steps made before the state was last set, and the index of the step that followed
    /// then.
    before: (u64, u64),
    asking: Asking,
    kernel: Kernel,
    jumps: Option<Box<LoadJumps>>,
    /// The number of the next step in which a load jumps or with which a block ends.
    due: u64,
    /// What becomes 0 at the end of a block, m.
    tiny: f64,
}

impl Stepper {
    /// True if `scheme` does not refuse `scene` with steps of `step` seconds.
    pub(crate) fn takes(scene: &Scene, scheme: &Scheme, step: f64) -> bool {
        Self::new(scene, scheme, step).is_ok()
    }

    /// A stepper for `scene` by `method`, a [`Scheme`] or a [`Method`], with steps of `step`
    /// seconds. For the exact scheme, which steps from event to event, `step` is the longest
    /// stretch of one step.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scene, scheme or step that makes no sense.
    pub fn new(scene: &Scene, method: &(impl Copy + Into<Method>), step: f64) -> Result<Self> {
        Self::by(&Checked::new(scene)?, (*method).into(), step)
    }

    /// The same for a scene that has been checked.
    pub(crate) fn by(scene: &Checked, Method { scheme, backend }: Method, step: f64) -> Result<Self> {
        scheme.validate()?;
        positive("step", step)?;
        fits::check(scene, Method { scheme, backend })?;
        let scene = match scheme {
            Scheme::Penalty { law, .. } => scene.with_laws(|scene| scene.penalised(law))?,
            _ => scene.clone(),
        };
        let kernel = Kernel::new(&scene, Method { scheme, backend }, step)?;
        let backend = kernel.motion().backend().unwrap_or(backend);
        let contract = scheme.contract();
        // A scheme that divides its steps does so at the jumps.
        let jumps = if contract.divides { None } else { LoadJumps::new(&scene, contract.balance, step).map(Box::new) };
        let (before, asking) = ((0, 0), Asking::here());
        let tiny = TINY * scene.gap_scale();
        let mut stepper =
            Self { scene, scheme, contract, step, backend, index: 0, before, asking, kernel, jumps, due: 0, tiny };
        stepper.due = stepper.due_from(0);
        Ok(stepper)
    }

    /// Advances by one step, or by one part of a step that `located` divides
    /// ([`Path::Part`](crate::Path::Part)): a program that advances to a time looks at
    /// [`Stepper::time`], and does not count calls.
    ///
    /// # Errors
    /// [`Error::Qp`], [`Error::Newton`], [`Error::NotFinite`] or [`Error::TooManyEvents`], with the
    /// time and the step; [`Error::Stopped`] under an [`Interrupt`](crate::Interrupt);
    /// [`Error::Invalid`] for a load whose function gives no finite force.
    #[inline(always)]
    pub fn step(&mut self) -> Result<Step<'_>> {
        self.advance(None)
    }

    /// Advances by one step, or by one part as [`Stepper::step`] does, under an extra force (N, one
    /// value per degree of freedom), constant over it: for co-simulation with another program.
    /// Each part of a divided step has the force that is given for it.
    ///
    /// # Errors
    /// As [`Stepper::step`]; [`Error::Invalid`] for a force of the wrong length or not finite.
    #[inline]
    pub fn step_with(&mut self, extra: &[f64]) -> Result<Step<'_>> {
        let n = self.scene.system.degrees_of_freedom();
        if extra.len() != n || extra.iter().any(|force| !force.is_finite()) {
            return Err(self.refusal(extra));
        }
        self.advance(Some(extra))
    }

    #[cold]
    fn refusal(&self, extra: &[f64]) -> Error {
        match extra.iter().find(|force| !force.is_finite()) {
            Some(force) => Error::invalid("extra force", format_args!("{force:?}"), "a finite number"),
            None => {
                let n = self.scene.system.degrees_of_freedom();
                let found = format!("{} values", extra.len());
                Error::invalid("extra force", found, format!("{n}, one per degree of freedom"))
            }
        }
    }

    #[inline(always)]
    fn advance(&mut self, extra: Option<&[f64]>) -> Result<Step<'_>> {
        let index = self.index;
        self.asking.pass(index)?;
        self.make(extra).map_err(|error| self.failure(error))?;
        Ok(self.kernel.step(index))
    }

    /// Makes one step.
    #[inline(always)]
    fn make(&mut self, extra: Option<&[f64]>) -> Result<()> {
        if self.index == self.due {
            self.make_due(extra)?;
        } else {
            self.kernel.advance(self.index, extra)?;
        }
        self.index += u64::from(!self.kernel.is_divided());
        Ok(())
    }

    /// The first step from number `index` on in which a load jumps or with which a block ends.
    fn due_from(&self, index: u64) -> u64 {
        let last = index | (BLOCK - 1);
        self.jumps.as_ref().map_or(last, |jumps| jumps.due(index).min(last))
    }

    /// Makes one step in which a load jumps or with which a block ends. Not inlined: few do.
    #[inline(never)]
    fn make_due(&mut self, extra: Option<&[f64]>) -> Result<()> {
        let index = self.index;
        match &mut self.jumps {
            Some(jumps) if jumps.due(index) == index => {
                self.kernel.advance(index, Some(jumps.force(index, extra)))?;
            }
            _ => self.kernel.advance(index, extra)?,
        }
        if self.kernel.is_divided() {
            return Ok(());
        }
        if index & (BLOCK - 1) == BLOCK - 1 {
            self.kernel.motion_mut().flush(self.tiny);
        }
        self.due = self.due_from(index + 1);
        Ok(())
    }

    /// Advances by up to `most` steps, at least by one, and stops after the first in which a wall
    /// pushes or a contact episode ends. Returns the last of these steps, whose
    /// [`index`](Step::index) tells how many there were.
    ///
    /// For a program that looks at contacts alone. `moreau-jean` and `located` make the steps
    /// between two contacts in one loop, with the same result to the last bit; other schemes make
    /// them one by one.
    ///
    /// ```
    /// use signorini::{Scene, Scheme, Stepper, Wall};
    ///
    /// let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 0.1)).with_initial(&[0.0], &[1.0]);
    /// let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3)?;
    /// let impact = stepper.advance_quiet(1000)?;
    /// assert!((impact.end - 0.1).abs() < 2e-3); // a step of 1 ms about 0.1 s
    /// assert_eq!(impact.impulse, [-2.0]); // N s, of 1 kg at 1 m/s
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Stepper::step`].
    pub fn advance_quiet(&mut self, most: u64) -> Result<Step<'_>> {
        let end = self.index.saturating_add(most.max(1));
        let mut last = self.index;
        loop {
            self.asking.pass(self.index)?;
            // The interrupt is asked between two loops.
            let until = end.min(self.due);
            let glide = self.kernel.advance_quiet(self.index, until, None);
            let reached = glide.map_err(|error| self.failure(error))?;
            if reached > self.index {
                (self.index, last) = (reached, reached - 1);
            }
            if self.index == end {
                break;
            }
            if self.index < until || self.index == self.due {
                last = self.index;
                self.make(None).map_err(|error| self.failure(error))?;
                let step = self.kernel.step(last);
                let pushed = |p: &f64| *p != 0.0;
                if step.impulse.iter().any(pushed) || !step.closed.is_empty() || self.index == end {
                    break;
                }
            }
        }
        Ok(self.kernel.step(last))
    }

    /// The index of the next step.
    pub(crate) fn index(&self) -> u64 {
        self.index
    }

    /// Makes steps in which no wall pushes, at most as many as `quiet` has room for and no more
    /// than `most`, and adds them to it. Returns how many.
    pub(crate) fn advance_quiet_into(&mut self, quiet: &mut QuietSteps, most: u64) -> Result<u64> {
        self.asking.pass(self.index)?;
        let from = self.index;
        let until = from.saturating_add(most.min(quiet.begin(from, self.time()))).min(self.due);
        let glide = self.kernel.advance_quiet(from, until, Some(quiet));
        self.index = glide.map_err(|error| self.failure(error))?;
        Ok(self.index - from)
    }

    /// True for a scheme on a grid on one degree of freedom that no hole or friction holds.
    pub(crate) fn is_line(&self) -> bool {
        matches!(self.kernel, Kernel::Line(_))
    }

    /// Time reached, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.kernel.step(self.index).end
    }

    /// State reached; at the start, the state after any impulse at t = 0.
    #[must_use]
    pub fn state(&self) -> State {
        let Step { q, v, .. } = self.kernel.step(self.index);
        State { q: q.to_vec(), v: v.to_vec() }
    }

    /// The velocity reached, m/s, one value per degree of freedom.
    #[inline]
    pub(crate) fn velocity(&self) -> &[f64] {
        self.kernel.step(self.index).v
    }

    /// The stretch (s) over which forces of rigid walls can be averaged where `asked` is asked for:
    /// of a scheme that spreads an impulse over its step none shorter than that.
    pub(crate) fn force_averaging(&self, asked: f64) -> f64 {
        let knows_instants = self.scheme.is_exact() || self.contract.divides;
        if knows_instants { asked } else { asked.max(self.step) }
    }

    /// The scene that the scheme computes: for a penalty, with springs in place of rigid walls.
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

    /// The equations and conditions that every step satisfies, for a judge.
    #[must_use]
    pub fn contract(&self) -> Contract {
        self.contract
    }

    /// The solver of the quadratic programmes that is used.
    #[must_use]
    pub fn backend(&self) -> Backend {
        self.backend
    }

    /// Contact episodes that are still open.
    #[must_use]
    pub fn open_contacts(&self) -> Vec<Contact> {
        self.kernel.motion().open_contacts()
    }

    /// Stretches that the exact scheme has left to moreau-jean so far; empty for other schemes.
    #[must_use]
    pub fn handed(&self) -> &[Handover] {
        self.kernel.motion().handed()
    }

    /// The work of the run so far.
    #[must_use]
    pub fn counters(&self) -> Counters {
        let (made, index) = self.before;
        let mut counters = Counters { steps: made + (self.index - index), ..Counters::default() };
        self.kernel.motion().count(&mut counters);
        counters
    }
}

#[cfg(test)]
mod tests;
