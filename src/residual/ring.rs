//! Checks of elastic round holes against the law of their pressure
//! ([`Elastic`](crate::step::Elastic)), from the displacements at both ends of a step.

use super::Judge;
use super::beyond::Worst;
use crate::scene::{Support, WallLaw};
use crate::step::{HoleStep, Law, Step};

impl Judge {
    /// Checks a ring of this gap and law; returns the part of its force that is not along the
    /// normal, N. `end` is w at the step's end without what blows add.
    pub(super) fn hold_ring(
        &mut self,
        step: &Step<'_>,
        (place, support, gap, law): (usize, &Support, f64, WallLaw),
        (did, end): (&HoleStep, [f64; 2]),
        doubt: &mut Worst,
    ) -> f64 {
        let (WallLaw::Elastic { stiffness, damping }, Law::Depth(theta)) = (law, self.contract.promise.elastic.law)
        else {
            return 0.0;
        };
        let start = support.offset(&self.q);
        let at = [0, 1].map(|i: usize| (1.0 - theta) * start[i] + theta * end[i]);
        let (distance, plate) = (at[0].hypot(at[1]), start[0].hypot(start[1]).max(gap));
        let expected = stiffness * (distance - gap) + damping * (distance - plate) / (theta * self.h);
        let pressure = did.impulse / self.h;
        let error = (pressure - expected.max(0.0)).abs();
        self.law_error = self.law_error.max(error);
        let noise = self.rounding.met(self.way(step, support, gap), self.energy.gap_scale);
        self.doubt_law(place, error, (stiffness + damping / (theta * self.h)) * noise);
        if pressure == 0.0 {
            return 0.0;
        }
        let askew = pressure * (did.normal[0] - at[0] / distance).hypot(did.normal[1] - at[1] / distance);
        let force_noise = self.rounding.wall_force(place, self.span, self.clock);
        doubt.see(askew - pressure * noise / distance - force_noise, self.now, Some(place));
        askew
    }
}
