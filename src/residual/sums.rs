//! What the check of a whole run's momentum sums up, step by step.

use super::most::most;
use crate::scene::Scene;

/// Load and own force of the structure on one degree of freedom: those of the last step, N, the sum of the changes of both, the
/// largest size of their sum, N, and the momentum handed over, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Forces {
    pub load: f64,
    pub own: f64,
    pub changes: f64,
    pub largest: f64,
    pub exchanged: f64,
}

/// Sums over the steps of a run on a grid; vectors over degrees of freedom have n entries, those over walls as many as there are.
#[derive(Debug)]
pub(super) struct Sums {
    /// Displacement and velocity at the start of the run, m and m/s, and velocity at the end of the last step.
    pub start: Vec<f64>,
    pub first: Vec<f64>,
    pub last: Vec<f64>,
    /// ∫q dt (m s), ∫f dt (N s), and ∫v dt (m) of a rule whose walls correct the displacement beside the velocity: of all others it is the
    /// way from start to end.
    pub place: Vec<f64>,
    pub rate: Vec<f64>,
    pub load: Vec<f64>,
    /// The forces on each degree of freedom.
    pub forces: Vec<Forces>,
    /// Impulse that each wall gave in the steps seen, N s, and the sum of its sizes.
    pub seen: Vec<f64>,
    pub sizes: Vec<f64>,
    /// What the recorder has of it, once it has been heard.
    pub recorded: Option<Vec<f64>>,
    pub steps: u64,
    /// Start of the first step, s.
    pub from: f64,
    /// True as long as every step was one of the run's own grid, and no wall answered a blow of a staggered rule, which then keeps the
    /// blow's timing or leaves out what the damper feels of it: which of the two, the ends do not tell.
    pub whole: bool,
}

impl Sums {
    pub fn new(scene: &Scene, q: &[f64], v: &[f64]) -> Self {
        let (n, walls) = (v.len(), scene.walls.len());
        let zero = || vec![0.0; n];
        Self {
            start: q.to_vec(),
            first: v.to_vec(),
            last: v.to_vec(),
            place: zero(),
            rate: zero(),
            load: zero(),
            forces: vec![Forces::default(); n],
            seen: vec![0.0; walls],
            sizes: vec![0.0; walls],
            recorded: None,
            steps: 0,
            from: 0.0,
            whole: true,
        }
    }

    /// Adds a step's load, own force and damper force on degree of freedom `i`, N, the first two of which count as changes; `first` of a
    /// run, which has no step before it.
    #[inline(always)]
    pub fn add(&mut self, i: usize, first: bool, h: f64, [load, own, damper]: [f64; 3]) {
        let Some(force) = self.forces.get_mut(i) else { return };
        if !first {
            force.changes += (load - force.load).abs() + (own - force.own).abs();
        }
        (force.load, force.own) = (load, own);
        force.largest = most(force.largest, load.abs() + own.abs() + damper.abs());
        force.exchanged += h * (load + own + damper).abs();
    }
}
