//! The motion at a round hole over a stretch: w along y and z as polynomials.
//!
//! A structure that slides round a hole has |w|² = γ² and the force ρ = r w/γ, r ≤ 0 and of
//! magnitude N = −r. With w = Σ w_k xᵏ and r = Σ r_k xᵏ, order by order (Cauchy products),
//!
//! ρ_k = Σ_j r_j w_{k−j}/γ,    2 w_0 · w_{k+2} = −Σ_{j=1}^{k+1} w_j · w_{k+2−j}:
//!
//! r_k is linear in the terms before it, with a matrix that is the same for all orders, since r_k
//! itself acts along w_0, the row n·P at the start. So it is found as the force of a wall is, by
//! [`HeldRows`](super::HeldRows), which demands this w_{k+2} instead of 0.

/// w at a hole over a stretch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Circle {
    /// γ, m.
    pub radius: f64,
    /// w_k along y and z, m.
    pub w: [Vec<f64>; 2],
}

impl Circle {
    /// A circle with memory for `terms` terms.
    pub fn new(radius: f64, terms: usize) -> Self {
        Self { radius, w: [vec![0.0; terms], vec![0.0; terms]] }
    }

    /// Sets w_k.
    #[inline]
    pub fn set(&mut self, k: usize, [y, z]: [f64; 2]) {
        (self.w[0][k], self.w[1][k]) = (y, z);
    }

    /// |w_k|, without the guard of `hypot` against overflow, which these sizes do not need.
    #[inline]
    pub fn size(&self, k: usize) -> f64 {
        let [y, z] = [self.w[0][k], self.w[1][k]];
        (y * y + z * z).sqrt()
    }

    pub fn scale(&mut self, k: usize, power: f64) {
        self.w.iter_mut().for_each(|w| w[k] *= power);
    }

    /// Σ_{j<k} r_j w_{k−j}/γ for the terms `r` known, k of them: the force of order k without r_k.
    pub fn turned(&self, r: &[f64]) -> [f64; 2] {
        let k = r.len();
        [0, 1].map(|axis: usize| {
            let w = &self.w[axis];
            r.iter().enumerate().map(|(j, r)| r * w[k - j]).sum::<f64>() / self.radius
        })
    }

    /// The n · w_k that keeps the motion on the circle, from the terms before: −Σ_{j=1}^{k−1} w_j ·
    /// w_{k−j}/2γ.
    pub fn bend(&self, k: usize) -> f64 {
        let sum: f64 = self.w.iter().map(|w| (1..k).map(|j| w[j] * w[k - j]).sum::<f64>()).sum();
        -0.5 * sum / self.radius
    }

    /// |ẅ| over γ at the start, in units of the stretch.
    pub fn start(&self) -> f64 {
        2.0 * self.size(2) / self.radius
    }

    /// (γ² − |w|²)/2γ at the start, m.
    pub fn gap(&self) -> f64 {
        let distance = self.w[0][0].hypot(self.w[1][0]);
        0.5 * (self.radius - distance) * (self.radius + distance) / self.radius
    }

    /// |w|²/2γ as far as `out` reaches, from `terms` terms of w.
    pub fn square(&self, terms: usize, out: &mut [f64]) {
        for (k, out) in out.iter_mut().enumerate() {
            let range = (k + 1).saturating_sub(terms)..=k.min(terms - 1);
            let sum: f64 = self.w.iter().map(|w| range.clone().map(|j| w[j] * w[k - j]).sum::<f64>()).sum();
            *out = 0.5 * sum / self.radius;
        }
    }
}
