//! What round supports and friction do between two rows.

use crate::flow::Series;
use crate::scene::Scene;
use crate::step::Step;

/// What round supports and friction did since the last row; all empty in scenes without.
#[derive(Debug, Clone)]
pub(super) struct PlaneImpulses {
    /// The indices of the round walls.
    pub walls: Vec<usize>,
    /// Impulse of each round support along y and z, and friction of each wall, N s.
    pub holes: Vec<[f64; 2]>,
    pub friction: Vec<f64>,
}

impl PlaneImpulses {
    pub fn new(scene: &Scene) -> Self {
        let walls: Vec<usize> = scene.holes().map(|hole| hole.index).collect();
        Self {
            holes: vec![[0.0; 2]; walls.len()],
            walls,
            friction: vec![0.0; if scene.turns_or_rubs() { scene.walls.len() } else { 0 }],
        }
    }

    /// Adds the impulses of the holes over a piece of a stretch of exact motion (s).
    #[inline(never)]
    pub fn follow(&mut self, series: &Series, [from, to]: [f64; 2]) {
        for (&hole, sum) in self.walls.iter().zip(&mut self.holes) {
            let push = series.hole_impulse(hole, from, to);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
        }
    }

    /// Adds the impulses of the holes at the instant that ends a step of exact motion.
    #[inline(never)]
    pub fn jump(&mut self, step: &Step<'_>) {
        for (sum, &wall) in self.holes.iter_mut().zip(&self.walls) {
            let push = step.normal[wall].map(|n| -step.jump[wall] * n);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
        }
    }

    /// Adds one step on a grid.
    #[inline(never)]
    pub fn observe(&mut self, step: &Step<'_>) {
        // In most steps nothing pushes.
        let still = [step.impulse, step.friction].iter().all(|x| x.iter().all(|x| *x == 0.0));
        if still && step.turned.iter().all(|turned| *turned == [0.0; 2]) {
            return;
        }
        for (sum, f) in self.friction.iter_mut().zip(step.friction) {
            *sum += f;
        }
        for (sum, hole) in self.holes.iter_mut().zip(&self.walls) {
            let push = step.hole_push(*hole);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
        }
    }
}
