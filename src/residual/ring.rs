//! Checks of elastic round holes against the law of their pressure
//! ([`Elastic`](crate::step::Elastic)), from the displacements at both ends of a step.

use super::Judge;
use super::complementarity::mean_pressure;
use super::hole_motion::HoleMotion;
use super::largest_residual::Residual;
use super::round::HolePush;
use crate::scene::{Hole, WallSpring};
use crate::step::{Bound, Law};

impl Judge {
    /// Checks a ring of this gap and law, and notes the part of its force that is not along the
    /// normal in `askew` (N). `end` is w at the step's end without what blows add.
    pub(super) fn hold_ring(
        &mut self,
        hole: &Hole<'_>,
        motion: &HoleMotion,
        (did, end): (&HolePush, [f64; 2]),
        askew: &mut Residual,
    ) {
        let (start, h) = (motion.start, self.h);
        let (place, gap, law) = (hole.index, hole.gap, hole.law);
        let (r0, r1, c) = (start[0].hypot(start[1]), end[0].hypot(end[1]), law.dashpot(0.0));
        let noise = self.noise.place(self.way(hole, motion));
        // The vector along which the ring pushes, its pressure, and how that changes with depth.
        // Where rounding decides, the pressure is accepted between two.
        let (at, expected, slope) = match (law.spring(), self.contract.promise.elastic.law) {
            (Some(WallSpring { stiffness, damping }), Law::Depth(theta)) => {
                let at = [0, 1].map(|i: usize| (1.0 - theta) * start[i] + theta * end[i]);
                let distance = at[0].hypot(at[1]);
                // Where the dashpot's plate is at the step's start: on the body or the circle.
                let (body, circle) = ((at[0] * start[0] + at[1] * start[1]) / distance, r0.max(gap));
                let plates = match self.contract.promise.hole == Some(Bound::Along) {
                    // The way goes through the centre, which has no normal.
                    true if distance <= noise && r0 >= gap - noise => [-r0, r0],
                    true if (r0 - gap).abs() <= noise => [body, circle],
                    true if r0 >= gap => [body; 2],
                    _ => [circle; 2],
                };
                let pressure = |plate: f64| stiffness * (distance - gap) + damping * (distance - plate) / (theta * h);
                (at, plates.map(pressure), stiffness + damping / (theta * h))
            }
            (_, Law::Gradient) => {
                let at = [0, 1].map(|i: usize| 0.5 * (start[i] + end[i]));
                let (s0, s1) = (r0 - gap, r1 - gap);
                let mean = mean_pressure(&law, s0, s1) + c * (s1.max(0.0) - s0.max(0.0)) / h;
                // Over the way from w to w⁺ the force does the work of the pressure over
                // |w⁺| − |w|.
                let share = 2.0 * at[0].hypot(at[1]) / (r0 + r1);
                (at, [mean * share; 2], law.tangent(s0.max(s1).max(f64::MIN_POSITIVE)) + 2.0 * c / h)
            }
            _ => return,
        };
        let distance = at[0].hypot(at[1]);
        let pressure = did.impulse / h;
        let [one, other] = expected.map(|expected| expected.max(0.0));
        let (least, most) = (one.min(other), one.max(other));
        // A pressure that is no number is not between them.
        let error = match pressure {
            _ if pressure < least => least - pressure,
            _ if pressure <= most => 0.0,
            _ => pressure - most,
        };
        self.walls.observe_law(&self.noise, place, error, slope * noise);
        if pressure != 0.0 {
            let across = pressure * (did.normal[0] - at[0] / distance).hypot(did.normal[1] - at[1] / distance);
            let noise = pressure * noise / distance + self.noise.wall_force(place);
            askew.observe(across, noise, self.noise.end, Some(place));
        }
    }
}
