//! The motion between the ends of a step on a grid, or of a part of one.

use super::{Path, Step};

/// The motion between the end of the last step and that of a step whose motion is known at its ends
/// only.
///
/// Within a step in which no wall pushes, and within a part of a step up to its impact, the
/// displacement is the cubic through the displacements and velocities at both ends (Hermite), which
/// is the path of the θ = ½ rule itself. In a step with an impulse nothing is known of the path
/// between its ends: the displacement there is straight, and the velocity that of the end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Between<'a> {
    /// Displacement, m, and velocity, m/s, at the end: of a part that before the impact there.
    q: &'a [f64],
    v: &'a [f64],
    straight: bool,
    /// The length of the stretch, s, and the share of it that has passed.
    length: f64,
    share: f64,
}

impl<'a> Step<'a> {
    /// The motion at `time` (s) between `start` (s), the end of the last step, and the end of this
    /// one; `None` for exact motion, which [`Path::state`] gives.
    pub(crate) fn between(&self, start: f64, time: f64) -> Option<Between<'a>> {
        let (v, straight) = match self.path {
            Path::Exact(_) | Path::Series(_) => return None,
            Path::Part { .. } => (self.velocity_after, false),
            Path::Grid | Path::OneRestitution | Path::Handed { .. } => (self.v, self.impulse.iter().any(|&p| p != 0.0)),
        };
        let length = self.end - start;
        Some(Between { q: self.q, v, straight, length, share: ((time - start) / length).clamp(0.0, 1.0) })
    }
}

impl Between<'_> {
    /// Displacement (m) and velocity (m/s) along `of`, which gives the component of a vector, where
    /// they were `from` at the end of the last step.
    pub fn along(&self, [q0, v0]: [f64; 2], of: impl Fn(&[f64]) -> f64) -> [f64; 2] {
        let (q1, v1) = (of(self.q), of(self.v));
        let (s, length) = (self.share, self.length);
        if self.straight {
            return [q0 + s * (q1 - q0), v1];
        }
        let mean = (q1 - q0) / length;
        // The deviations of both velocities from the mean one bend the straight line.
        let (d0, d1) = (v0 - mean, v1 - mean);
        let q = q0 + s * (q1 - q0) + length * s * (1.0 - s) * ((1.0 - s) * d0 - s * d1);
        let v = mean + (1.0 - s) * (1.0 - 3.0 * s) * d0 + s * (3.0 * s - 2.0) * d1;
        [q, v]
    }
}
