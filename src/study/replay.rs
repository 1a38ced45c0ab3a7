//! The exact motion once more, with another rounding.

use crate::error::Result;
use crate::run::Run;
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper};
use crate::trajectory::{Recorder, Trajectory};

/// Stretches of the other run over the duration: no divisor of anything, so that its stops fall on no row and no period.
const STRETCHES: f64 = 97.3;

/// The stride of the other run, s: the exact scheme stops at its multiples and begins its closed form anew, with other roundings.
#[must_use]
pub fn stride(scene: &Scene) -> f64 {
    scene.duration / STRETCHES
}

/// The exact motion of `scene` at the rows of `run`, with stops at every multiple of [`stride`].
///
/// # Errors
/// What the exact scheme reports.
pub fn replay(scene: &Scene, run: &Run) -> Result<Trajectory> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, stride(scene))?;
    let state = stepper.state();
    let mut recorder = Recorder::new(scene, run.grid.rows, &state.q, &state.v);
    while stepper.time() < scene.duration {
        recorder.see(&stepper.step()?);
    }
    Ok(recorder.finish(&stepper.open_contacts()))
}
