//! What round supports and friction do between two rows.

use crate::flow::Series;
use crate::scene::Scene;
use crate::step::{Path, Step};

/// What round supports and friction did since the last row; all empty in scenes without.
#[derive(Debug, Clone)]
pub(super) struct PlaneImpulses {
    /// The indices of the round walls.
    pub walls: Vec<usize>,
    /// Impulse of each round support along y and z, and friction of each wall, N s.
    pub holes: Vec<[f64; 2]>,
    pub friction: Vec<f64>,
    /// Force of each round support in the last step, N; of parts of a step, their mean.
    pub force: Vec<[f64; 2]>,
    /// The step to which the last part belongs, and its length so far, s.
    pub parts: (u64, f64),
}

impl PlaneImpulses {
    pub fn new(scene: &Scene) -> Self {
        let walls: Vec<usize> = scene.holes().map(|hole| hole.index).collect();
        Self {
            force: vec![[0.0; 2]; walls.len()],
            holes: vec![[0.0; 2]; walls.len()],
            walls,
            friction: vec![0.0; if scene.turns_or_rubs() { scene.walls.len() } else { 0 }],
            parts: (u64::MAX, 0.0),
        }
    }

    /// Adds the impulses of the holes over a piece of a stretch of exact motion (s), and sets their
    /// forces to those at its end.
    #[inline(never)]
    pub fn follow(&mut self, series: &Series, [from, to]: [f64; 2]) {
        for (&hole, (sum, force)) in self.walls.iter().zip(self.holes.iter_mut().zip(&mut self.force)) {
            let push = series.hole_impulse(hole, from, to);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
            *force = series.hole_force(hole, to);
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
        let h = step.end - step.start;
        let is_part = matches!(step.path, Path::Part { .. });
        let before = if is_part && self.parts.0 == step.index { self.parts.1 } else { 0.0 };
        self.parts = (step.index, before + h);
        for (sum, f) in self.friction.iter_mut().zip(step.friction) {
            *sum += f;
        }
        for ((sum, force), hole) in self.holes.iter_mut().zip(&mut self.force).zip(&self.walls) {
            let push = step.hole_push(*hole);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
            // An impulse at the end of a part is no force, and a part of no length has none.
            let push = if step.jump[*hole] == 0.0 { push } else { [0.0; 2] };
            if h > 0.0 {
                *force = [0, 1].map(|axis: usize| (before * force[axis] + push[axis]) / (before + h));
            }
        }
    }
}
