//! The force of a round hole over a stretch, as magnitude and along y and z.

use super::Series;
use super::circle::Circle;

impl Series {
    /// The circle of a round wall.
    fn circle(&self, wall: usize) -> Option<&Circle> {
        self.circles.get(self.round_walls.iter().position(|&round| round == wall)?)
    }

    /// Displacement w (m) at the round wall of index `wall`, from its centre, and its rate (m/s) at
    /// `t`.
    pub(crate) fn at_hole(&self, wall: usize, t: f64) -> ([f64; 2], [f64; 2]) {
        let Some(circle) = self.circle(wall) else { return ([0.0; 2], [0.0; 2]) };
        let x = (t - self.start) / self.unit;
        let ([y, z], mut place, mut rate) = (circle.w.each_ref().map(|w| &w[..self.terms]), [0.0; 2], [0.0; 2]);
        // One loop: each of the four sums waits for its own last term only.
        for (k, (y, z)) in y.iter().zip(z).enumerate().skip(1).rev() {
            let k = k as f64;
            place = [place[0] * x + y, place[1] * x + z];
            rate = [rate[0] * x + k * y, rate[1] * x + k * z];
        }
        ([place[0] * x + y[0], place[1] * x + z[0]], rate.map(|rate| rate / self.unit))
    }

    /// Force of a wall at `t`, N, as results count it: signed, of a round wall its magnitude.
    pub(crate) fn counted_force(&self, wall: usize, t: f64) -> f64 {
        let force = self.contact_force(wall, t);
        if self.round_walls.contains(&wall) { force.abs() } else { force }
    }

    /// Impulse of a wall over [from, to] within the stretch, N s, as results count it.
    pub(crate) fn counted_impulse(&self, wall: usize, from: f64, to: f64) -> f64 {
        let impulse = self.contact_impulse(wall, from, to);
        if self.round_walls.contains(&wall) { impulse.abs() } else { impulse }
    }

    /// Magnitude of the force of the round wall of index `wall` at `t`, N: 0 if it does not act.
    pub(crate) fn hole_pressure(&self, wall: usize, t: f64) -> f64 {
        self.contact_force(wall, t).abs()
    }

    /// ∫ of that magnitude over [from, to] within the stretch, N s.
    pub(crate) fn hole_push(&self, wall: usize, from: f64, to: f64) -> f64 {
        self.contact_impulse(wall, from, to).abs()
    }

    /// Force of the round wall of index `wall` on the structure along y and z at `t`, N: 0 if it
    /// does not act.
    #[must_use]
    pub fn hole_force(&self, wall: usize, t: f64) -> [f64; 2] {
        let pressure = self.hole_pressure(wall, t);
        if pressure == 0.0 {
            return [0.0; 2];
        }
        let ([y, z], _) = self.at_hole(wall, t);
        let distance = y.hypot(z);
        [-pressure * y / distance, -pressure * z / distance]
    }

    /// Impulse of the round wall of index `wall` on the structure along y and z over [from, to]
    /// within the stretch, N s, in closed form.
    #[must_use]
    pub fn hole_impulse(&self, wall: usize, from: f64, to: f64) -> [f64; 2] {
        self.round_impulse(wall).map_or([0.0; 2], |impulse| impulse.between(from, to))
    }

    /// The same as a function of both times, for many pieces of the stretch; `None` if the wall
    /// does not act.
    pub(crate) fn round_impulse(&self, wall: usize) -> Option<RoundImpulse> {
        let (acting, circle) = (self.of_wall(wall)?, self.circle(wall)?);
        let force = self.force(acting.slot);
        let along = |w: &[f64]| -> Vec<f64> {
            let coefficient = |k: usize| {
                let range = (k + 1).saturating_sub(self.terms)..=k.min(self.terms - 1);
                range.map(|j| force[j] * w[k - j]).sum()
            };
            (0..2 * self.terms - 1).map(coefficient).collect()
        };
        let along = [0, 1].map(|axis: usize| along(&circle.w[axis][..self.terms]));
        Some(RoundImpulse { along, start: self.start, unit: self.unit, radius: circle.radius })
    }
}

/// The impulse of a round wall on the structure over pieces of a stretch: its force along
/// y and z, the products of its pressure with the place, by powers of x.
#[derive(Debug, Clone)]
pub(crate) struct RoundImpulse {
    along: [Vec<f64>; 2],
    start: f64,
    unit: f64,
    radius: f64,
}

impl RoundImpulse {
    /// Over [from, to] within the stretch, N s.
    pub(crate) fn between(&self, from: f64, to: f64) -> [f64; 2] {
        let (a, b) = ((from - self.start) / self.unit, (to - self.start) / self.unit);
        self.along.each_ref().map(|coefficients| {
            let (mut sum, mut mixed, mut power) = (0.0, 1.0, 1.0);
            for (k, c) in coefficients.iter().enumerate() {
                // As for the impulse of a flat wall.
                sum += c * mixed / (k + 1) as f64;
                power *= b;
                mixed = a * mixed + power;
            }
            sum * (b - a) * self.unit / self.radius
        })
    }
}
