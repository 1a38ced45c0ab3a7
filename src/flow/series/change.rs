//! The series of small changes of a motion, some of which changes of the scene drive.
//!
//! The motion M q̈ + C q̇ + K q = f + Gᵀ r has a series of its own. Its change by a change of the
//! scene obeys
//!
//! M δq̈ + C δq̇ + K δq = Gᵀ δr + δf − δM q̈ − δC q̇ − δK q + δGᵀ r,
//!
//! with δr = −k_a G δq − c_a G δq̇ + δr₀ at an elastic wall, where δr₀ is what the change of the
//! wall itself adds, and with δr at held rows such that G δq̈ = −δG q̈. So its terms follow from
//! those of the motion by the same recurrence, over the same stretch. That of a change of the start
//! alone has no terms of its own. All changes are computed side by side: one product with a matrix
//! serves them all.

use super::{HeldRow, HeldRows, Series, SeriesBody, TERMS, Touching};
use crate::linear::Operator;

/// What a change of the scene adds to the equation of the change of a motion. Term k is the
/// coefficient of xᵏ in the series of the stretch.
pub(crate) trait Drive {
    /// True if it adds to the force.
    fn pushes(&self) -> bool;

    /// Adds term `k` of δf − δM q̈ − δC q̇ − δK q + δGᵀ r to `force`, N.
    fn add_force(&self, base: &Series, k: usize, force: &mut [f64]);

    /// Term `k` of δr₀ of a wall that touches, N.
    fn push(&self, base: &Series, k: usize, touching: &Touching) -> f64;

    /// Term `k` of −δG q̈ at a held row, m/s².
    fn acceleration(&self, base: &Series, k: usize, held: &HeldRow) -> f64;
}

/// The series of several changes.
#[derive(Debug)]
pub(crate) struct Changes {
    n: usize,
    /// Number of changes.
    count: usize,
    terms: usize,
    unit: f64,
    /// K and C of all changes side by side.
    stiffness: Operator,
    damping: Option<Operator>,
    /// 1/M likewise, where M is diagonal.
    inverse: Option<Vec<f64>>,
    /// Terms of δq one after the other, n · count entries each: degree of freedom i of change c is
    /// entry i · count + c.
    motion: Vec<f64>,
    /// Terms of δr, N, of the touching elastic walls, then of the held rows: TERMS · count entries
    /// each.
    forces: Vec<f64>,
    /// Work space: displacement and velocity of all changes side by side, and the force of one.
    now: [Vec<f64>; 2],
    own: Vec<f64>,
}

impl Changes {
    /// Series of `count` changes.
    pub fn new(body: &SeriesBody, count: usize) -> Self {
        let (n, slots) = (body.n, body.rows.count() + body.row_of.len());
        let size = n * count;
        let diagonal = body.inertia.as_diagonal();
        Self {
            n,
            count,
            terms: 1,
            unit: 1.0,
            stiffness: body.stiffness.side_by_side(count),
            damping: body.damping.as_ref().map(|damping| damping.side_by_side(count)),
            inverse: diagonal.map(|m| m.iter().flat_map(|m| std::iter::repeat_n(1.0 / m, count)).collect()),
            motion: vec![0.0; size * TERMS],
            forces: vec![0.0; slots * TERMS * count],
            now: [vec![0.0; size], vec![0.0; size]],
            own: vec![0.0; n],
        }
    }

    /// Number of changes.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Computes the series over the stretch of `base` from `columns`, (δq, δq̇) at its start, n
    /// entries each and one change after the other. The first changes are driven by `drives`.
    pub fn fill(
        &mut self,
        body: &mut SeriesBody,
        base: &Series,
        (touching, hold): (&[Touching], &HeldRows),
        columns: &[f64],
        drives: &[impl Drive],
        scratch: &mut [f64],
    ) {
        // In one piece, the recursion of the terms: each part works on slices of the one before.
        (self.terms, self.unit) = (base.terms(), base.unit());
        let (n, count, unit) = (self.n, self.count, self.unit);
        let size = n * count;
        self.forces[..(touching.len() + hold.rows().len()) * TERMS * count].fill(0.0);
        for (c, change) in columns.chunks_exact(2 * n).enumerate().take(count) {
            for i in 0..n {
                self.motion[i * count + c] = change[i];
                self.motion[size + i * count + c] = change[n + i] * unit;
            }
        }
        for k in 0..self.terms - 2 {
            let Self { motion, forces, stiffness, damping, inverse, own, .. } = self;
            let (known, next) = motion.split_at_mut((k + 2) * size);
            let (now, rate) = (&known[k * size..(k + 1) * size], &known[(k + 1) * size..]);
            let force = &mut next[..size];
            let per_second = (k + 1) as f64 / unit;
            force.fill(0.0);
            for (c, drive) in drives.iter().enumerate().take(count).filter(|(_, drive)| drive.pushes()) {
                own.fill(0.0);
                drive.add_force(base, k, own);
                force.iter_mut().skip(c).step_by(count).zip(&*own).for_each(|(f, own)| *f = *own);
            }
            stiffness.add_product(-1.0, now, force);
            if let Some(damping) = damping {
                damping.add_product(-per_second, rate, force);
            }
            for (slot, t) in touching.iter().enumerate() {
                let pushes = &mut forces[(slot * TERMS + k) * count..(slot * TERMS + k + 1) * count];
                let own = |c: usize| drives.get(c).map_or(0.0, |drive| drive.push(base, k, t));
                push_back(
                    body.rows.row(t.row),
                    [t.stiffness, t.damping * per_second],
                    [now, rate],
                    (force, pushes),
                    own,
                );
            }
            let factor = unit * unit / ((k + 1) * (k + 2)) as f64;
            if let (Some(inverse), true) = (inverse, hold.rows().is_empty()) {
                force.iter_mut().zip(&*inverse).for_each(|(f, inverse)| *f *= inverse * factor);
                continue;
            }
            for c in 0..count {
                own.iter_mut().zip(force.iter().skip(c).step_by(count)).for_each(|(own, f)| *own = *f);
                let wanted = |held: &HeldRow| drives.get(c).map_or(0.0, |drive| drive.acceleration(base, k, held));
                let tell = |i: usize, push: f64| forces[((touching.len() + i) * TERMS + k) * count + c] += push;
                hold.balance(body, own, scratch, wanted, tell);
                body.solve(own);
                force.iter_mut().skip(c).step_by(count).zip(&*own).for_each(|(f, own)| *f = factor * own);
            }
        }
    }

    /// Writes δq (m) and δq̇ (m/s) of all changes at x to `columns`, as [`Changes::fill`] takes
    /// them.
    pub fn state_at(&mut self, x: f64, columns: &mut [f64]) {
        let (n, count) = (self.n, self.count);
        let Self { motion, now: [q, v], terms, unit, .. } = self;
        q.fill(0.0);
        v.fill(0.0);
        for (k, term) in motion.chunks_exact(n * count).enumerate().take(*terms).skip(1).rev() {
            let per = k as f64;
            for ((q, v), a) in q.iter_mut().zip(&mut *v).zip(term) {
                *q = *q * x + a;
                *v = *v * x + per * a;
            }
        }
        q.iter_mut().zip(&*motion).for_each(|(q, a)| *q = *q * x + a);
        let inverse = 1.0 / *unit;
        for (c, change) in columns.chunks_exact_mut(2 * n).enumerate().take(count) {
            for i in 0..n {
                change[i] = q[i * count + c];
                change[n + i] = v[i * count + c] * inverse;
            }
        }
    }

    /// δr of a wall by change number `change` at x, N, and ∫ δr over the stretch up to x, N s: of a
    /// wall of `touching`, or all that acts at its row, if `hold` holds that; both are those of
    /// [`Changes::fill`].
    pub fn push(
        &self,
        body: &SeriesBody,
        (touching, hold): (&[Touching], &HeldRows),
        (change, wall): (usize, usize),
        x: f64,
    ) -> [f64; 2] {
        let row = body.row_of.get(wall);
        let held = || hold.rows().iter().position(|held| Some(&held.row) == row).map(|held| touching.len() + held);
        let Some(slot) = touching.iter().position(|t| t.wall == wall).or_else(held) else { return [0.0; 2] };
        let first = slot * TERMS * self.count + change;
        let force = self.forces.iter().skip(first).step_by(self.count).take(self.terms).enumerate();
        let (mut now, mut sum, mut power) = (0.0, 0.0, 1.0);
        for (k, c) in force {
            now += c * power;
            power *= x;
            sum += c * power / (k + 1) as f64;
        }
        [now, sum * self.unit]
    }

    /// Term `k` of g δq by change number `change`, for the entries of a row g.
    pub fn seen(&self, row: &[(usize, f64)], k: usize, change: usize) -> f64 {
        let term = self.motion.get(k * self.n * self.count..).unwrap_or_default();
        row.iter().map(|&(j, g)| g * term.get(j * self.count + change).copied().unwrap_or(0.0)).sum()
    }
}

/// Adds the forces of an elastic wall at `row` to those of all changes, and sets them: `own` less
/// k_a times `now` and c_a times `rate` there.
fn push_back(
    row: &[(usize, f64)],
    [stiffness, damping]: [f64; 2],
    [now, rate]: [&[f64]; 2],
    (force, pushes): (&mut [f64], &mut [f64]),
    own: impl Fn(usize) -> f64,
) {
    let count = pushes.len();
    for (c, push) in pushes.iter_mut().enumerate() {
        let seen = |x: &[f64]| row.iter().map(|&(j, g)| g * x[j * count + c]).sum::<f64>();
        *push = own(c) - stiffness * seen(now) - damping * seen(rate);
        row.iter().for_each(|&(j, g)| force[j * count + c] += g * *push);
    }
}
