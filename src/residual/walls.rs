//! What a run shows of its walls, against the scheme's promise.

use super::front::ComplementarityFront;
use super::largest_residual::Residual;
use super::noise::NoiseModel;
use crate::scene::Scene;
use crate::step::LastImpacts;

/// What a run has shown of its walls; vectors have one entry per wall.
#[derive(Debug, Default)]
pub(super) struct WallCheck {
    /// Pairs of gap (m) and pressure (N), and of speed of rebound (m/s) and pressure (N).
    pub gaps: ComplementarityFront,
    pub rebounds: ComplementarityFront,
    /// Errors of forces against the law of their wall, N.
    pub law: Residual,
    /// Deepest place behind each wall, m.
    pub depth: Vec<f64>,
    /// Largest pull, N.
    pub tension: f64,
    /// Largest force, N.
    pub force_scale: f64,
    /// Force of each elastic wall at the end of the last step, N.
    pub last_force: Vec<f64>,
    /// The last impacts at each wall, at the ends of parts of steps.
    pub last_impacts: Vec<LastImpacts>,
    /// Distance within which a wall counts as touched, m.
    pub touch: f64,
}

impl WallCheck {
    /// Of a run that starts from the state `q` (m), `v` (m/s).
    pub fn new(scene: &Scene, q: &[f64], v: &[f64]) -> Self {
        Self {
            depth: vec![0.0; scene.walls.len()],
            last_force: scene.walls.iter().map(|wall| wall.law_force(wall.row().dot(q), wall.row().dot(v))).collect(),
            last_impacts: vec![LastImpacts::NONE; scene.walls.len()],
            touch: scene.touching_distance(),
            ..Self::default()
        }
    }

    /// Notes the `pressure` of a wall, N, and the largest force that it had in the step.
    pub fn observe_force(&mut self, noise: &mut NoiseModel, wall: usize, (pressure, largest): (f64, f64), rigid: bool) {
        self.force_scale = self.force_scale.max(largest);
        self.tension = self.tension.max(-pressure);
        noise.push(wall, largest, rigid);
    }

    /// Notes how far the body is behind a wall, m.
    #[inline(always)]
    pub fn observe_depth(&mut self, wall: usize, depth: f64) {
        if let Some(deepest) = self.depth.get_mut(wall) {
            *deepest = deepest.max(depth);
        }
    }

    /// Notes the gap of a rigid wall (or the slack of a bound), whose terms are of this `size`, m,
    /// and its pressure, N.
    pub fn observe_gap(&mut self, noise: &NoiseModel, wall: usize, (gap, size): (f64, f64), pressure: f64) {
        if gap < 0.0 || pressure != 0.0 {
            let pressure = (pressure, noise.wall_force(wall));
            self.gaps.add((gap, noise.place(size)), pressure, noise.end, wall);
        }
    }

    /// Notes the speed by which a rebound exceeds what the law demands, m/s, with its rounding
    /// error, and the wall's pressure, N.
    pub fn observe_rebound(&mut self, noise: &NoiseModel, wall: usize, slack: (f64, f64), pressure: f64) {
        self.rebounds.add(slack, (pressure, noise.wall_force(wall)), noise.end, wall);
    }

    /// Notes the `error` of a wall's force against its law, N, of which the rounding error of the
    /// body's place explains `place`.
    pub fn observe_law(&mut self, noise: &NoiseModel, wall: usize, error: f64, place: f64) {
        if error > 0.0 || error.is_nan() {
            self.law.observe(error, place + noise.wall_force(wall), noise.end, Some(wall));
        }
    }
}
