//! Forces and impulses of the walls that touch during an arc.

use super::arc::Arc;
use super::touch::Support;

impl Arc {
    /// Force of wall `wall` on the body at `t`, N, signed: 0 if it does not touch.
    #[must_use]
    pub fn contact_force(&self, wall: usize, t: f64) -> f64 {
        let touches = self.support.is_some_and(|s| s.wall == wall) || self.touching.iter().any(|a| a.wall == wall);
        if touches { self.force_at(wall, t, self.state(t)) } else { 0.0 }
    }

    /// True if the elastic wall `wall` touches during the arc.
    pub(crate) fn touches_wall(&self, wall: usize) -> bool {
        self.touching.iter().any(|touch| touch.wall == wall)
    }

    /// As [`Arc::contact_force`], where the state (m, m/s) at `t` is known already.
    pub(crate) fn force_at(&self, wall: usize, t: f64, (q, v): (f64, f64)) -> f64 {
        if let Some(support) = self.support.filter(|s| s.wall == wall) {
            return support.side.sign() * self.pressing(support, self.since(t))[0].max(0.0);
        }
        let Some(touch) = self.touching.iter().find(|a| a.wall == wall) else { return 0.0 };
        -touch.stiffness * (q - touch.position) - touch.damping * v
    }

    /// The rate of that force at the end, N/s, where velocity (m/s) and acceleration (m/s²) there
    /// are known.
    pub(crate) fn force_rate_at_end(&self, wall: usize, [v, a]: [f64; 2]) -> f64 {
        if let Some(support) = self.support.filter(|s| s.wall == wall) {
            return support.side.sign() * self.pressing(support, self.span())[1];
        }
        self.touching.iter().find(|a| a.wall == wall).map_or(0.0, |touch| -touch.stiffness * v - touch.damping * a)
    }

    /// Impulse of wall `wall` on the body over [from, to] within the arc, N s, in closed form.
    ///
    /// For an elastic wall it follows from the momentum balance, K ∫q = ∫f + Σk_a g T − mΔv − CΔq,
    /// where K and C include the touching walls; since k_a ≤ K, no rounding error is amplified.
    #[must_use]
    pub fn contact_impulse(&self, wall: usize, from: f64, to: f64) -> f64 {
        let touch = self.touching.iter().find(|a| a.wall == wall);
        if touch.is_none() && self.support.is_none_or(|support| support.wall != wall) {
            return 0.0;
        }
        let (span, load) = (self.since(to) - self.since(from), self.load_impulse(from, to));
        if let Some(support) = self.support {
            let others = self.elastic_at_rest();
            if support.wall == wall {
                let push = (self.body.stiffness * self.initial[0] - others) * span - load;
                return support.side.sign() * (support.side.sign() * push).max(0.0);
            }
        }
        let Some(touch) = touch else { return 0.0 };
        if self.support.is_some() {
            return -touch.stiffness * (self.initial[0] - touch.position) * span;
        }
        let ((q0, v0), (q1, v1)) = (self.state(from), self.state(to));
        // Shifted to this wall's position, x = q − g, so that a stiff wall far from the origin
        // causes no cancellation.
        let (mut k, mut c) = (self.body.stiffness, self.body.damping);
        let mut push = load - self.body.stiffness * touch.position * span;
        for a in &self.touching {
            k += a.stiffness;
            c += a.damping;
            push += a.stiffness * (a.position - touch.position) * span;
        }
        let area = (push - self.body.mass * (v1 - v0) - c * (q1 - q0)) / k;
        -touch.stiffness * area - touch.damping * (q1 - q0)
    }

    /// The force R ≥ 0 with which the supporting wall pushes, and its first three derivatives, N,
    /// N/s …
    pub(crate) fn pressing(&self, support: Support, tau: f64) -> [f64; 4] {
        let (f, sign) = (self.force.jet(tau), support.side.sign());
        let steady = self.body.stiffness * self.initial[0] - self.elastic_at_rest();
        [sign * (steady - f[0]), -sign * f[1], -sign * f[2], -sign * f[3]]
    }

    /// Σ r_a of the touching elastic walls at the rest position, N, signed.
    fn elastic_at_rest(&self) -> f64 {
        self.touching.iter().map(|a| -a.stiffness * (self.initial[0] - a.position)).sum()
    }

    /// Bound on |R⁗|, N/s⁴.
    pub(crate) fn pressing_bound(&self) -> f64 {
        self.force.bounds[2]
    }
}
