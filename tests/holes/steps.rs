//! Steps by any scheme, shown to a test or to a judge.

use signorini::residual::Judge;
use signorini::{Finding, HoleStep, Scene, Scheme, Step, Stepper};

/// `steps` steps of `h` seconds, each shown to `see`.
pub fn follow(scene: &Scene, scheme: &Scheme, h: f64, steps: u64, mut see: impl FnMut(&Step<'_>)) -> Stepper {
    let mut stepper = Stepper::new(scene, scheme, h).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..steps {
        see(&stepper.step().unwrap_or_else(|error| panic!("{error}")));
    }
    stepper
}

/// What a judge finds in `steps` steps of `h` seconds, of each of which `alter` has changed holes
/// and displacement before.
pub fn judged(
    scene: &Scene,
    scheme: &Scheme,
    (h, steps): (f64, u64),
    mut alter: impl FnMut(&Step<'_>, &mut Vec<HoleStep>, &mut Vec<f64>),
) -> Vec<Finding> {
    let mut stepper = Stepper::new(scene, scheme, h).unwrap_or_else(|error| panic!("{error}"));
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), h, &state.q, &state.v);
    for _ in 0..steps {
        let mut step = stepper.step().unwrap_or_else(|error| panic!("{error}"));
        let (mut holes, mut q) = (step.holes.to_vec(), step.q.to_vec());
        alter(&step, &mut holes, &mut q);
        (step.holes, step.q) = (&holes, &q);
        judge.see(&step);
    }
    judge.findings()
}
