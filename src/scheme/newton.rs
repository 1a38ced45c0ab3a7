//! Walls with force laws, condensed onto their rows: find y with
//!
//! y = y₀ + S r(y),    S = G A⁻¹ Gᵀ · scale (m × m, semidefinite),
//!
//! where each force rᵢ(yᵢ) never rises with yᵢ. These are the optimality conditions of a convex
//! function. Semismooth Newton (Qi & Sun 1993, doi:10.1007/BF01581275) on the forces, with a line
//! search on that function's derivative, converges from any start, usually in a few iterations
//! without the search. For piecewise linear laws it ends after finitely many iterations.

use super::body::Body;
use super::space::{Space, zero};

/// Maximum number of iterations. A few are enough; reaching this many means that numbers are not
/// finite.
const LIMIT: usize = 200;
/// From this iteration on, a step must not go beyond the minimum along its direction; before, it
/// may go a little beyond.
const STRICT: usize = 20;
/// How far beyond: largest slope there, relative to the slope at the start of the step.
const BEYOND: f64 = 0.1;
/// Maximum number of bisections in the line search; a step 2⁻⁶⁰ as long changes nothing.
const SEARCH: usize = 60;

/// The force of a wall at its yᵢ.
#[derive(Debug, Clone, Copy)]
pub(super) struct LawResponse {
    /// rᵢ, signed.
    pub force: f64,
    /// −drᵢ/dyᵢ, ≥ 0.
    pub slope: f64,
    /// Size of the other terms, in units of yᵢ, whose rounding errors enter the force.
    pub noise: f64,
}

/// The condensed problem and its work space.
#[derive(Debug, Default)]
pub(super) struct ForceLawSolver {
    m: usize,
    /// S, by rows.
    s: Vec<f64>,
    /// y₀, m entries, written by the caller.
    pub free: Vec<f64>,
    /// y, the forces of the laws there, and −dr/dy, m entries each.
    pub y: Vec<f64>,
    pub force: Vec<f64>,
    pub slope: Vec<f64>,
    /// The forces that make y. A stiff law turns the rounding error of y into a far larger one of
    /// `force`; these have only their own.
    pub guess: Vec<f64>,
    size: Vec<f64>,
    step: Vec<f64>,
    shift: Vec<f64>,
    active: Vec<usize>,
    /// The lower Cholesky factor of I + E S E on the active walls (those with a slope), by rows
    /// with stride m, and E = √slope.
    factor: Vec<f64>,
    root: Vec<f64>,
    u: Vec<f64>,
    pub iterations: u64,
}

impl ForceLawSolver {
    /// The walls of `body`, with the factor of A.
    pub fn new<S: Space>(a: &mut S::Factor, body: &Body<S>, scale: f64) -> Self {
        let m = body.walls.len();
        let mut s = vec![0.0; m * m];
        let mut response = zero::<S>(body.n);
        for j in 0..m {
            response.as_mut().fill(0.0);
            S::add_transposed(&body.rows, j, scale, &mut response);
            S::solve(a, &mut response);
            for i in 0..m {
                s[i * m + j] = body.seen(i, &response);
            }
        }
        for i in 0..m {
            for j in 0..i {
                let mean = 0.5 * (s[i * m + j] + s[j * m + i]);
                (s[i * m + j], s[j * m + i]) = (mean, mean);
            }
        }
        let zero = || vec![0.0; m];
        Self {
            m,
            s,
            free: zero(),
            force: zero(),
            slope: zero(),
            y: zero(),
            size: zero(),
            guess: zero(),
            step: zero(),
            shift: zero(),
            active: Vec::with_capacity(m),
            factor: vec![0.0; m * m],
            root: zero(),
            u: zero(),
            iterations: 0,
        }
    }

    /// Solves for the forces; they and their slopes are left in `force` and `slope`.
    ///
    /// # Errors
    /// If it does not converge: the largest difference between a force and its law.
    pub fn solve(&mut self, law: impl Fn(usize, f64) -> LawResponse) -> Result<(), f64> {
        let m = self.m;
        self.guess.fill(0.0);
        let units = (4 + m) as f64 * f64::EPSILON;
        let mut worst = f64::NAN;
        for iteration in 0..LIMIT {
            self.iterations += 1;
            worst = 0.0;
            let mut settled = true;
            self.place();
            for i in 0..m {
                let answer = law(i, self.y[i]);
                (self.force[i], self.slope[i]) = (answer.force, answer.slope);
                let mismatch = answer.force - self.guess[i];
                // y is known to the rounding error of its terms only, and the force to the error
                // that follows by the law.
                let size = answer.force.abs() + self.guess[i].abs() + answer.slope * (self.size[i] + answer.noise);
                settled &= mismatch.abs() <= units * size;
                worst = f64::max(worst, mismatch.abs());
                self.step[i] = mismatch;
            }
            if settled {
                return Ok(());
            }
            self.correct();
            self.search(&law, if iteration < STRICT { BEYOND } else { 0.0 });
        }
        Err(worst)
    }

    /// y = y₀ + S · guess, and the size of its terms.
    fn place(&mut self) {
        self.y.copy_from_slice(&self.free);
        self.size.iter_mut().zip(&self.free).for_each(|(size, y)| *size = y.abs());
        for (j, &force) in self.guess.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            for i in 0..self.m {
                let term = self.s[i * self.m + j] * force;
                self.y[i] += term;
                self.size[i] += term.abs();
            }
        }
    }

    /// x with (I + D S) x = `step`, in place, with D the slopes.
    fn correct(&mut self) {
        let m = self.m;
        let Self { s, step, active, factor, root, u, slope, .. } = self;
        active.clear();
        active.extend((0..m).filter(|&i| slope[i] > 0.0));
        // Walls without a slope take their difference as it is, and change the y of the others.
        for (k, &i) in active.iter().enumerate() {
            root[k] = slope[i].sqrt();
            let others: f64 =
                (0..m).filter(|&j| slope[j] <= 0.0 && step[j] != 0.0).map(|j| s[i * m + j] * step[j]).sum();
            u[k] = step[i] / root[k] - root[k] * others;
        }
        for k in 0..active.len() {
            let (done, line) = factor.split_at_mut(k * m);
            for j in 0..=k {
                let unit = f64::from(u8::from(j == k));
                let entry = unit + root[k] * s[active[k] * m + active[j]] * root[j];
                let above = if j < k { &done[j * m..j * m + j] } else { &[] };
                let dot: f64 = if j < k {
                    above.iter().zip(line.iter()).map(|(a, b)| a * b).sum()
                } else {
                    line[..k].iter().map(|a| a * a).sum()
                };
                line[j] =
                    if j < k { (entry - dot) / done[j * m + j] } else { (entry - dot).max(f64::MIN_POSITIVE).sqrt() };
            }
        }
        let k = active.len();
        for i in 0..k {
            let dot: f64 = factor[i * m..i * m + i].iter().zip(u.iter()).map(|(a, b)| a * b).sum();
            u[i] = (u[i] - dot) / factor[i * m + i];
        }
        for i in (0..k).rev() {
            u[i] /= factor[i * m + i];
            for j in 0..i {
                u[j] -= factor[i * m + j] * u[i];
            }
        }
        for (k, &i) in active.iter().enumerate() {
            step[i] = root[k] * u[k];
        }
    }

    /// Line search: takes the whole step, unless the convex function would rise again along it.
    fn search(&mut self, law: &impl Fn(usize, f64) -> LawResponse, beyond: f64) {
        let m = self.m;
        self.shift.fill(0.0);
        for (j, &step) in self.step.iter().enumerate().filter(|(_, step)| **step != 0.0) {
            for i in 0..m {
                self.shift[i] += self.s[i * m + j] * step;
            }
        }
        // The derivative of that function along the step.
        let Self { shift, guess, step, y, force, .. } = self;
        let start: f64 = (0..m).map(|i| shift[i] * (guess[i] - force[i])).sum();
        let slope = |t: f64| -> f64 {
            (0..m).map(|i| shift[i] * (guess[i] + t * step[i] - law(i, y[i] + t * shift[i]).force)).sum()
        };
        let (mut low, mut t) = (0.0, 1.0);
        let mut high = 1.0;
        for _ in 0..SEARCH {
            // If the slope at the start is rounding error, there is no minimum to search for.
            let here = slope(t);
            if here.is_nan() || here <= beyond * start.abs() {
                if t == 1.0 || here >= 0.5 * start {
                    break;
                }
                low = t;
            } else {
                high = t;
            }
            t = 0.5 * (low + high);
        }
        guess.iter_mut().zip(step.iter()).for_each(|(guess, step)| *guess += t * step);
    }

    /// Corrects the forces `guess` where they make the `made` y in place of y₀ + S · guess: until
    /// they are the forces of the laws there, which to first order are `force` − D (`made` − y).
    pub fn refine(&mut self, made: &[f64]) {
        self.approach_laws(made);
        self.end_pulls();
    }

    /// Ends forces that pull in what `solve` found, which are rounding errors: two walls on one row
    /// whose laws are stiff share a force only as far as the rounding of y tells. Such forces may
    /// be far larger than those that are left, which are nearer to their laws without their
    /// rounding.
    pub fn refine_pulls(&mut self) {
        if self.end_pulls() {
            let of_laws = self.y.clone();
            self.place();
            let made = std::mem::replace(&mut self.y, of_laws);
            self.refine(&made);
        }
    }

    /// One step of Newton's method from the forces `guess`, which make the `made` y.
    fn approach_laws(&mut self, made: &[f64]) {
        for (i, step) in self.step.iter_mut().enumerate() {
            *step = self.force[i] - self.slope[i] * (made[i] - self.y[i]) - self.guess[i];
        }
        self.correct_guess();
    }

    /// A wall that would pull, which is rounding error, has no force, and the others take over what
    /// it had. True if there was any.
    fn end_pulls(&mut self) -> bool {
        let mut ended = false;
        for _ in 0..=self.m {
            let mut pulls = false;
            for i in 0..self.m {
                let pull = self.guess[i] != 0.0 && self.guess[i] * self.force[i] <= 0.0;
                self.step[i] = if pull { -self.guess[i] } else { 0.0 };
                if pull {
                    (self.force[i], self.slope[i]) = (0.0, 0.0);
                }
                pulls |= pull;
            }
            if !pulls {
                break;
            }
            ended = true;
            self.correct_guess();
        }
        ended
    }

    /// Adds what `step` becomes by `correct`.
    fn correct_guess(&mut self) {
        self.correct();
        self.guess.iter_mut().zip(&self.step).for_each(|(guess, step)| *guess += step);
    }
}

#[cfg(test)]
mod tests;
