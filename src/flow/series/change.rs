//! The series of a small change of a motion, which a change of the scene drives.
//!
//! The motion M q̈ + C q̇ + K q = f + Gᵀ r has a series of its own. Its change by a change of the
//! scene obeys
//!
//! M δq̈ + C δq̇ + K δq = Gᵀ δr + δf − δM q̈ − δC q̇ − δK q + δGᵀ r,
//!
//! with δr = −k_a G δq − c_a G δq̇ + δr₀ at an elastic wall, where δr₀ is what the change of the
//! wall itself adds, and with δr at held rows such that G δq̈ = −δG q̈. So its terms follow from
//! those of the motion by the same recurrence, over the same stretch.

use super::{HeldRow, HeldRows, Series, SeriesBody, TERMS, Touching};

/// What a change of the scene adds to the equation of the change of a motion. Term k is the
/// coefficient of xᵏ in the series of the stretch.
pub(crate) trait Drive {
    /// Adds term `k` of δf − δM q̈ − δC q̇ − δK q + δGᵀ r to `force`, N.
    fn add_force(&self, base: &Series, k: usize, force: &mut [f64]);

    /// Term `k` of δr₀ of a wall that touches, N.
    fn push(&self, base: &Series, k: usize, touching: &Touching) -> f64;

    /// Term `k` of −δG q̈ at a held row, m/s².
    fn acceleration(&self, base: &Series, k: usize, held: &HeldRow) -> f64;
}

/// The series of a change.
#[derive(Debug)]
pub(crate) struct Change {
    n: usize,
    terms: usize,
    unit: f64,
    /// Terms of δq one after the other, n entries each.
    motion: Vec<f64>,
    /// Polynomials of δr, N: of the touching elastic walls, then of the held rows.
    forces: Vec<f64>,
}

impl Change {
    /// A series without terms.
    pub fn new(body: &SeriesBody) -> Self {
        let slots = body.rows.count() + body.row_of.len();
        Self { n: body.n, terms: 1, unit: 1.0, motion: vec![0.0; body.n * TERMS], forces: vec![0.0; slots * TERMS] }
    }

    /// Computes the series over the stretch of `base` from (δq, δq̇) at its start, n entries each.
    pub fn fill(
        &mut self,
        body: &mut SeriesBody,
        base: &Series,
        (touching, hold): (&[Touching], &HeldRows),
        (q, v): (&[f64], &[f64]),
        drive: &impl Drive,
        scratch: &mut [f64],
    ) {
        let Self { n, terms, unit, motion, forces } = self;
        (*terms, *unit) = (base.terms(), base.unit());
        let (n, unit) = (*n, *unit);
        forces.fill(0.0);
        motion[..n].copy_from_slice(q);
        motion[n..2 * n].iter_mut().zip(v).for_each(|(a, v)| *a = v * unit);
        for k in 0..*terms - 2 {
            let (known, next) = motion.split_at_mut((k + 2) * n);
            let (now, rate) = (&known[k * n..(k + 1) * n], &known[(k + 1) * n..]);
            let force = &mut next[..n];
            let per_second = (k + 1) as f64 / unit;
            force.fill(0.0);
            drive.add_force(base, k, force);
            body.stiffness.add_product(-1.0, now, force);
            if let Some(damping) = &body.damping {
                damping.add_product(-per_second, rate, force);
            }
            for (slot, t) in touching.iter().enumerate() {
                let own = t.stiffness * body.rows.dot(t.row, now) + t.damping * per_second * body.rows.dot(t.row, rate);
                let push = drive.push(base, k, t) - own;
                forces[slot * TERMS + k] = push;
                body.rows.add_transposed(t.row, push, force);
            }
            let tell = |i: usize, push: f64| forces[(touching.len() + i) * TERMS + k] += push;
            hold.balance(body, force, scratch, |held| drive.acceleration(base, k, held), tell);
            body.solve(force);
            let factor = unit * unit / ((k + 1) * (k + 2)) as f64;
            force.iter_mut().for_each(|a| *a *= factor);
        }
    }

    /// δq (m) and δq̇ (m/s) at x, into slices of n entries.
    pub fn state_at(&self, x: f64, q: &mut [f64], v: &mut [f64]) {
        q.fill(0.0);
        v.fill(0.0);
        for (k, term) in self.motion.chunks_exact(self.n).enumerate().take(self.terms).rev() {
            for ((q, v), a) in q.iter_mut().zip(&mut *v).zip(term) {
                *q = *q * x + a;
                if k > 0 {
                    *v = *v * x + k as f64 * a;
                }
            }
        }
        v.iter_mut().for_each(|v| *v /= self.unit);
    }

    /// δr of a wall at x, N, and ∫ δr over the stretch up to x, N s: of a wall of `touching`, or
    /// all that acts at its row, if `hold` holds that; both are those of [`Change::fill`].
    pub fn push(&self, body: &SeriesBody, (touching, hold): (&[Touching], &HeldRows), wall: usize, x: f64) -> [f64; 2] {
        let row = body.row_of.get(wall);
        let held = || hold.rows().iter().position(|held| Some(&held.row) == row).map(|held| touching.len() + held);
        let Some(slot) = touching.iter().position(|t| t.wall == wall).or_else(held) else { return [0.0; 2] };
        let force = self.forces.iter().skip(slot * TERMS).take(self.terms).enumerate();
        let (mut now, mut sum, mut power) = (0.0, 0.0, 1.0);
        for (k, c) in force {
            now += c * power;
            power *= x;
            sum += c * power / (k + 1) as f64;
        }
        [now, sum * self.unit]
    }

    /// Term `k` of δq, n entries.
    pub fn term(&self, k: usize) -> &[f64] {
        self.motion.get(k * self.n..(k + 1) * self.n).unwrap_or_default()
    }
}
