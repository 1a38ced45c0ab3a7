//! The force of a round hole over a stretch, as magnitude and along y and z.

use super::{Series, value};

impl Series {
    /// Displacement w (m) at hole number `hole`, from its centre, and its rate (m/s) at `t`.
    pub(crate) fn at_hole(&self, hole: usize, t: f64) -> ([f64; 2], [f64; 2]) {
        let Some(circle) = self.circles.get(hole) else { return ([0.0; 2], [0.0; 2]) };
        let x = (t - self.start) / self.unit;
        let rate = |w: &[f64]| (1..w.len()).rev().fold(0.0, |sum, k| sum * x + k as f64 * w[k]) / self.unit;
        let w = [&circle.w[0][..self.terms], &circle.w[1][..self.terms]];
        (w.map(|w| value(w, x)), w.map(rate))
    }

    /// True if hole number `hole` holds the structure on its circle, with or without a force.
    pub(crate) fn hole_acts(&self, hole: usize) -> bool {
        self.of_wall(self.walls + hole).is_some()
    }

    /// Magnitude of the force of hole number `hole` at `t`, N: 0 if it does not act.
    pub(crate) fn hole_pressure(&self, hole: usize, t: f64) -> f64 {
        self.contact_force(self.walls + hole, t).abs()
    }

    /// ∫ of that magnitude over [from, to] within the stretch, N s.
    pub(crate) fn hole_push(&self, hole: usize, from: f64, to: f64) -> f64 {
        self.contact_impulse(self.walls + hole, from, to).abs()
    }

    /// Force of hole number `hole` on the structure along y and z at `t`, N: 0 if it does not act.
    #[must_use]
    pub fn hole_force(&self, hole: usize, t: f64) -> [f64; 2] {
        let pressure = self.hole_pressure(hole, t);
        if pressure == 0.0 {
            return [0.0; 2];
        }
        let ([y, z], _) = self.at_hole(hole, t);
        let distance = y.hypot(z);
        [-pressure * y / distance, -pressure * z / distance]
    }

    /// Impulse of hole number `hole` on the structure along y and z over [from, to] within the
    /// stretch, N s, in closed form.
    #[must_use]
    pub fn hole_impulse(&self, hole: usize, from: f64, to: f64) -> [f64; 2] {
        let (Some(acting), Some(circle)) = (self.of_wall(self.walls + hole), self.circles.get(hole)) else {
            return [0.0; 2];
        };
        let force = self.force(acting.slot);
        let (a, b) = ((from - self.start) / self.unit, (to - self.start) / self.unit);
        [0, 1].map(|axis: usize| {
            let w = &circle.w[axis][..self.terms];
            let (mut sum, mut mixed, mut power) = (0.0, 1.0, 1.0);
            for k in 0..2 * self.terms - 1 {
                let range = (k + 1).saturating_sub(self.terms)..=k.min(self.terms - 1);
                let c: f64 = range.map(|j| force[j] * w[k - j]).sum();
                // As for the impulse of a wall.
                sum += c * mixed / (k + 1) as f64;
                power *= b;
                mixed = a * mixed + power;
            }
            sum * (b - a) * self.unit / circle.radius
        })
    }
}
