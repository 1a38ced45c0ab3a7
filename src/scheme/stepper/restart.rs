//! A stepper that continues from another state.

use super::Stepper;
use crate::error::{Error, Result};
use crate::scene::{State, nonnegative};
use crate::scheme::Scheme;
use crate::scheme::frame::step_at;
use crate::time::MOST_STEPS;

impl Stepper {
    /// Sets the state at `time` (s), later or earlier than now: a co-simulation can repeat a step,
    /// or restart from saved values of [`Stepper::time`] and [`Stepper::state`]. The state is that
    /// after everything that happened at that instant: a load's impulse at `time` is already part
    /// of it.
    ///
    /// A scheme on a grid continues from a multiple of its step; `located`, which divides steps,
    /// and the exact scheme from any time. `moreau-jean`, `located`, `implicit-euler` and the
    /// penalty's other one-step rules then make the same steps as if they had reached that state by
    /// themselves. `paoli-schatzman`, `generalized-alpha`, `newmark` and the penalty's
    /// `central-difference` carry more than the state from step to step (accelerations, a velocity
    /// half a step back) and restart as at the beginning; so does a lasting contact of the exact
    /// scheme. Contact episodes that have not ended are dropped. A [`Recorder`](crate::Recorder) or
    /// [`Judge`](crate::residual::Judge) that has seen the steps so far cannot be used for those
    /// that follow.
    ///
    /// The schemes on a grid do not refuse a state behind a rigid wall, where they may leave a body
    /// for a step themselves; each moves on from a deeper one in a way of its own.
    ///
    /// The work counters continue. An extra force ([`Stepper::step_with`]) is not part of the
    /// state. The exact scheme is set up again, which for a large structure costs more than a step.
    ///
    /// ```
    /// use signorini::{Scene, Scheme, Stepper, Wall};
    ///
    /// let scene = Scene::oscillator(1.0, 0.0, 100.0).with_initial(&[0.0], &[1.0]);
    /// let scene = scene.with_wall(Wall::upper("stop", 0.01));
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
    /// [`Error::Invalid`] for a time that is negative, not finite, more than 1e10 steps or no
    /// multiple of the step of a scheme on a grid, a state of the wrong length or not finite, or
    /// for the exact scheme one behind a rigid wall or outside of a round hole. The stepper is
    /// then as it was.
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
        if let (true, Some(wall)) = (exact, self.scene.wall_before(&state.q)) {
            let found = format!("{:?} at the rigid wall {:?}", wall.row().dot(&state.q), wall.name);
            let expected = format!("a place before it, which stands at {:?}", wall.position());
            return Err(Error::invalid(("state", "displacement"), found, expected));
        }
        if let (true, Some(wall)) = (exact, self.scene.walls.iter().find(|wall| wall.holds_out(&state.q))) {
            let distance = wall.coordinate(&state.q);
            let found = format!("{distance:?} m from the centre of the round support {:?}", wall.name);
            return Err(Error::invalid(("state", "displacement"), found, "a place inside of its hole"));
        }
        self.kernel.motion_mut().restart(&self.scene, time, &state.q, &state.v)?;
        let (made, from) = self.before;
        self.before = (made + (self.index - from), index);
        self.index = index;
        self.due = self.due_from(index);
        self.asking.restart();
        Ok(())
    }

    /// The number of the step that starts at `time`.
    fn index_at(&self, time: f64, exact: bool) -> Result<u64> {
        nonnegative("time", time)?;
        let steps = time / self.step;
        if exact && steps <= MOST_STEPS {
            return Ok(self.index);
        }
        if self.contract.divides && steps <= MOST_STEPS {
            return Ok(step_at(time, self.step).0);
        }
        if exact {
            let expected = format!("at most 1e10 times the longest step, {:?} s", self.step);
            return Err(Error::invalid("time", format_args!("{time:?}"), expected));
        }
        // Times of steps are products k·h, with the rounding error of k up to 1e10.
        if (steps - steps.round()).abs() > 1e-6 || steps > MOST_STEPS {
            let expected = format!("a multiple of the step, {:?} s, at most 1e10 of them", self.step);
            return Err(Error::invalid("time", format_args!("{time:?}"), expected));
        }
        Ok(steps.round() as u64)
    }
}
