//! Steps by any scheme, shown to a test or to a judge.

use signorini::residual::Judge;
use signorini::{Finding, Scene, Scheme, Step, Stepper};

/// What a round hole did in a step, as [`Step`] has it.
#[derive(Debug, Clone, Copy)]
pub struct HoleStep {
    pub normal: [f64; 2],
    pub impulse: f64,
    pub friction: f64,
    pub jump: f64,
    pub turned: [f64; 2],
}

/// The impulses of a step, to be changed before a judge sees them.
#[derive(Debug, Clone)]
pub struct Pushes {
    pub impulse: Vec<f64>,
    pub friction: Vec<f64>,
    jump: Vec<f64>,
    pub normal: Vec<[f64; 2]>,
    turned: Vec<[f64; 2]>,
}

impl Pushes {
    pub fn of(step: &Step<'_>) -> Self {
        Self {
            impulse: step.impulse.to_vec(),
            friction: step.friction.to_vec(),
            jump: step.jump.to_vec(),
            normal: step.normal.to_vec(),
            turned: step.turned.to_vec(),
        }
    }

    /// Shows these in place of the step's own.
    pub fn show<'a>(&'a self, step: &mut Step<'a>) {
        (step.impulse, step.friction, step.jump) = (&self.impulse, &self.friction, &self.jump);
        (step.normal, step.turned) = (&self.normal, &self.turned);
    }

    /// Changes what the hole did that the step counts under this number.
    pub fn alter(&mut self, hole: usize, alter: impl FnOnce(&mut HoleStep)) {
        let mut did = HoleStep {
            normal: self.normal[hole],
            impulse: self.impulse[hole],
            friction: self.friction[hole],
            jump: self.jump[hole],
            turned: self.turned[hole],
        };
        alter(&mut did);
        (self.normal[hole], self.impulse[hole], self.friction[hole]) = (did.normal, did.impulse, did.friction);
        (self.jump[hole], self.turned[hole]) = (did.jump, did.turned);
    }
}

/// `steps` steps of `h` seconds, each shown to `observe`.
pub fn follow(scene: &Scene, scheme: &Scheme, h: f64, steps: u64, mut observe: impl FnMut(&Step<'_>)) -> Stepper {
    let mut stepper = Stepper::new(scene, scheme, h).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..steps {
        observe(&stepper.step().unwrap_or_else(|error| panic!("{error}")));
    }
    stepper
}

/// How many of `steps` steps of 0.1 ms push the body of `round`, which moves on the diameter along
/// the unit vector (c, s) as that of `line` does between two walls: displacements, m, velocities,
/// m/s, and impulses, N s, are `within` these of each other.
pub fn beside_line([line, round]: [&Scene; 2], [c, s]: [f64; 2], scheme: &Scheme, steps: u64, within: [f64; 3]) -> u32 {
    let mut beside = Stepper::new(line, scheme, 1e-4).unwrap_or_else(|error| panic!("{error}"));
    let mut pushes = 0;
    follow(round, scheme, 1e-4, steps, |step| {
        let other = beside.step().unwrap_or_else(|error| panic!("{error}"));
        let [w, v] = [step.q, step.v].map(|x| c * x[0] + s * x[1]);
        let p = (other.impulse[0] + other.impulse[1]).abs();
        for ((found, known), within) in [(w, other.q[0]), (v, other.v[0]), (step.impulse[0], p)].into_iter().zip(within)
        {
            assert!((found - known).abs() < within, "{scheme:?}, {}: {found} {known}", step.end);
        }
        pushes += u32::from(step.impulse[0] > 0.0);
    });
    pushes
}

/// What a judge finds in `steps` steps of `h` seconds, of each of which `alter` has changed
/// impulses and displacement before.
pub fn judged(
    scene: &Scene,
    scheme: &Scheme,
    (h, steps): (f64, u64),
    mut alter: impl FnMut(&Step<'_>, &mut Pushes, &mut Vec<f64>),
) -> Vec<Finding> {
    let mut stepper = Stepper::new(scene, scheme, h).unwrap_or_else(|error| panic!("{error}"));
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), h, &state.q, &state.v);
    for _ in 0..steps {
        let mut step = stepper.step().unwrap_or_else(|error| panic!("{error}"));
        let (mut pushes, mut q) = (Pushes::of(&step), step.q.to_vec());
        alter(&step, &mut pushes, &mut q);
        pushes.show(&mut step);
        step.q = &q;
        judge.observe(&step);
    }
    judge.findings()
}
