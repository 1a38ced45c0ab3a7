//! Bounds of the motion of an arc, and the sizes of its terms, whose rounding errors limit what is
//! known of it.

use super::arc::Arc;
use super::response::Jet;

impl Arc {
    /// The size of the steady motions' acceleration, m/s². Near resonance they cancel against the
    /// free motion, so the closed form has their rounding error beside that of the forces.
    pub(crate) fn steady_size(&self) -> f64 {
        if self.is_rest() { 0.0 } else { self.response.steady }
    }

    /// True if the forces on a body at rest balance within `noise` (N) over the whole arc without
    /// its wall, which then does not push.
    pub(crate) fn is_unpressed(&self, noise: f64) -> bool {
        let Some(support) = self.support else { return false };
        self.pressing(support, 0.0)[0].abs() <= noise && self.force.variation(self.span) <= noise
    }

    /// Bounds on the magnitudes of the derivatives `order` (from 4 to 6) and `order` + 1 of q over
    /// [τ, τ + `window`], given `jet` at τ.
    ///
    /// Each derivative y of q solves ÿ + 2σẏ + κy = ψ with ψ a derivative of the load, so that
    /// ẏ(τ+u) = S′(u) ẏ − κ y S(u) + ∫S′ψ, where |S′| ≤ 1 and |S| ≤ min(u, 1/√κ, 1/2δ) at any
    /// damping.
    #[inline]
    pub(crate) fn bounds(&self, jet: &Jet, order: usize, window: f64) -> [f64; 2] {
        let equation = &self.response.equation;
        let (kappa, rub) = (equation.kappa, 2.0 * equation.sigma);
        let reach = kappa * window.min(equation.longest);
        let load = [3, 2].map(|below| self.force.bounds[order - below] * self.inverse);
        let (now, before) = (jet[order].abs(), jet[order - 1].abs());
        // The next derivative at τ follows from the equation itself.
        let next = load[0] + rub * now + kappa * before;
        [now + reach * before + window * load[0], next + reach * now + window * load[1]]
    }

    /// The largest ω of the load, rad/s; 0 without sines.
    pub(crate) fn fastest(&self) -> f64 {
        self.force.fastest
    }

    /// The largest circular frequency in the motion, rad/s: of the load, or of the body if it
    /// oscillates; 0 if neither does.
    pub(crate) fn fastest_motion(&self) -> f64 {
        self.fastest().max(self.response.oscillation())
    }

    /// An interval that the motion does not leave during the arc, m.
    pub(crate) fn extent(&self) -> [f64; 2] {
        self.response.extent
    }

    /// An interval that the motion would not leave from the arc's start on, whatever its length, m:
    /// for a flight under constant loads and sines. `None` where no bound is known.
    pub(crate) fn reach_for_ever(&self) -> Option<[f64; 2]> {
        if self.is_rest() || self.touches() { None } else { self.response.reach_for_ever() }
    }

    /// Sizes of the terms of displacement (m), velocity (m/s), force (N) and its rate (N/s): their
    /// rounding limits the accuracy of these.
    pub(crate) fn sizes(&self) -> [f64; 4] {
        let span = self.span;
        let elastic: f64 = self.touching.iter().map(|a| a.stiffness * (self.initial[0] - a.position).abs()).sum();
        let force = self.force.size(span) + self.body.stiffness * self.initial[0].abs() + elastic;
        let [q, v] = if self.is_rest() { [self.initial[0].abs(), 0.0] } else { self.response.size };
        [q, v, force, self.force.rate_size()]
    }
}
