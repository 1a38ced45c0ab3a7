//! When a run has diverged.
//!
//! The energy of M q̈ + C q̇ + K q = f + r, that of the motion and of the springs of structure and
//! walls, changes by the work of the loads, less what damping and impacts take, or plus what
//! negative damping of at most γ = max(−Cᵢᵢ/Mᵢᵢ, 0) adds. With ‖f‖² = fᵀM⁻¹f and Cauchy–Schwarz:
//!
//! dE/dt ≤ q̇ᵀf + γ q̇ᵀM q̇ ≤ √(2E) ‖f‖ + 2γE, so
//! √(q̇ᵀM q̇) ≤ √(2E) ≤ S(t) = e^(γt) (√(2E(0)) + ∫‖f‖ dt + Σ‖J‖),
//!
//! with the blows J. No motion of the scene is faster: neither a resonance, nor a free body under a
//! constant force, which travels far, nor a rebound. A run faster than [`FACTOR`] times S has
//! diverged.

use crate::error::Error;
use crate::linear::{Factor, Symmetric, sum_of_products};
use crate::residual::{Finding, Refuted};
use crate::scene::{Checked, LoadKind, Scene, State};
use crate::scheme::{Integrator, Scheme, Stepper};

/// A run that is this much faster than its start and its loads allow has diverged. A scheme's own
/// error of the energy, which the ledger shows and a note states, stays far below.
pub(crate) const FACTOR: f64 = 1e6;

/// Iterations of the power method: a ratio of norms that decides about a factor of 1e6 needs no
/// more digits than these give.
const ITERATIONS: usize = 30;

/// Tells whether a run has diverged.
pub(crate) struct Divergence {
    scene: Checked,
    scheme: Scheme,
    h: f64,
    /// √(2E(0)), with a lower limit for scenes without any energy, √J.
    start: f64,
    /// ∫‖f‖dt + Σ‖J‖ over the whole run, with the diagonal of M for M and without loads that are
    /// functions, √J.
    given: f64,
    /// γ, 1/s.
    growth: f64,
    /// Mᵢᵢ.
    mass: Vec<f64>,
    /// A run is sound as long as Σ Mᵢᵢ q̇ᵢ² is below this, J.
    sound: f64,
}

/// When and why a run counts as diverged.
#[derive(Debug, Clone)]
pub(crate) struct Diverged {
    /// Time at which that was seen, s.
    pub time: f64,
    /// √(q̇ᵀM q̇) over S, at most the largest double.
    pub ratio: f64,
    /// What was seen, and the likely cause.
    pub cause: String,
}

impl Divergence {
    /// The limit for a run by `stepper` in steps of `h` (s), from the state `start`.
    pub fn new(stepper: &Stepper, h: f64, start: &State) -> Self {
        let scene = stepper.checked().clone();
        let structure = scene.system.structure();
        let (mass, damping) = (structure.mass.diagonal_entries(), structure.damping.diagonal_entries());
        let growth = damping.iter().zip(&mass).map(|(c, m)| -c / m).fold(0.0, f64::max);
        let heaviest = mass.iter().copied().fold(0.0, f64::max);
        let least = heaviest.sqrt() * scene.gap_scale() / scene.duration;
        let start = (2.0 * energy(&scene, start)).sqrt().max(least);
        let given = over_roots(&impulses(&scene, |load| integral(load, scene.duration)), &mass);
        // |Mᵢⱼ| ≤ √(Mᵢᵢ Mⱼⱼ), so vᵀMv ≤ n Σ Mᵢᵢ vᵢ².
        let coupled = if structure.mass.half_bandwidth() == 0 { 1.0 } else { mass.len() as f64 };
        let sound = (FACTOR * (start + given)).powi(2) / coupled;
        Self { scheme: stepper.scheme(), scene, h, start, given, growth, mass, sound }
    }

    /// Whether the run has diverged, with the velocity `v` (m/s) at `time` (s).
    #[inline]
    pub fn at(&mut self, time: f64, v: &[f64]) -> Option<Diverged> {
        let squares = sum_of_products(&self.mass, v, v);
        if squares <= self.sound { None } else { self.suspect(time, v, squares) }
    }

    #[cold]
    fn suspect(&mut self, time: f64, v: &[f64], squares: f64) -> Option<Diverged> {
        let sampled = |load: &LoadKind| match load {
            LoadKind::Function(f) => {
                let steps = (time / self.h).ceil();
                (0..=steps as u64).map(|k| self.h * f.at(k as f64 * self.h).abs()).sum()
            }
            _ => 0.0,
        };
        let functions = over_roots(&impulses(&self.scene, sampled), &self.mass);
        let structure = self.scene.system.structure();
        let given = (self.given + functions) * diagonal_share(&structure.mass, structure.mass_factor().ok()).sqrt();
        let most = (self.start + given) * (self.growth * time).exp();
        let ratio = self.scene.system.mass_form(v, v).sqrt() / most;
        if ratio <= FACTOR {
            // Asked again when the run is faster by another half.
            self.sound = 2.0 * squares;
            return None;
        }
        Some(Diverged { time, ratio: ratio.min(f64::MAX), cause: self.cause() })
    }

    /// The run's end where a step gave no finite state, if `error` says so.
    pub fn overflow(&self, error: &Error) -> Option<Diverged> {
        let Error::NotFinite { time, what, .. } = error else { return None };
        let cause = format!("the {what} is no longer finite; {}", self.cause());
        Some(Diverged { time: *time, ratio: f64::MAX, cause })
    }

    /// The likely cause.
    fn cause(&self) -> String {
        match self.scheme {
            Scheme::Penalty { integrator: Integrator::CentralDifference, .. }
                if self.scene.walls.iter().all(|wall| wall.law.is_cubic()) =>
            {
                let masses = self.scene.wall_masses();
                let laws = self.scene.walls.iter().map(|wall| wall.law).map(|law| law.tangent(f64::MIN_POSITIVE));
                let walls = laws.zip(masses).map(|(k, m)| k / m).fold(0.0, f64::max);
                let [_, fastest] = self.scene.system.frequencies();
                let limit = 2.0 / (fastest * fastest + walls).sqrt();
                format!(
                    "central-difference is stable below a step of about {limit:.1e} s, 2 over the fastest circular \
                     frequency, walls included; the step is {:.1e} s",
                    self.h
                )
            }
            Scheme::Event => "its loads or its start are beyond what numbers can hold".to_owned(),
            scheme => format!("a step of {:.1e} s may be too large for {scheme}", self.h),
        }
    }
}

impl Diverged {
    /// The finding of the run that it ended.
    pub fn finding(self) -> Finding {
        Finding::of_run(Refuted::Diverged, self.ratio, FACTOR, self.cause, self.time)
    }

    /// The error of a run that has no findings.
    pub fn error(self, step: u64) -> Error {
        Error::Diverged { time: self.time, step, ratio: self.ratio, cause: self.cause }
    }
}

/// Energy of motion and of all springs at `state`, J.
fn energy(scene: &Scene, State { q, v }: &State) -> f64 {
    let walls: f64 = scene.walls.iter().map(|wall| wall.law.energy(-wall.gap(wall.coordinate(q)))).sum();
    scene.system.energy(q, v) + walls
}

/// Bounds on the impulse of all loads on each degree of freedom, N s; `of` gives that of a load.
fn impulses(scene: &Scene, of: impl Fn(&LoadKind) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0; scene.system.degrees_of_freedom()];
    for load in &scene.loads {
        let impulse = of(&load.kind);
        for &(i, weight) in load.at.entries() {
            if let Some(sum) = sums.get_mut(i) {
                *sum += weight.abs() * impulse;
            }
        }
    }
    sums
}

/// ∫|f|dt of a load up to `end` (s), or its blow, N s; 0 for a function.
fn integral(load: &LoadKind, end: f64) -> f64 {
    match load {
        LoadKind::Constant { force } => force.abs() * end,
        LoadKind::Harmonic { amplitude, .. } => amplitude.abs() * end,
        LoadKind::Impulse { impulse, .. } => impulse.abs(),
        LoadKind::Table(table) => {
            let pairs = table.time().windows(2).zip(table.force().windows(2));
            pairs.map(|(t, f)| 0.5 * (t[1] - t[0]) * (f[0].abs() + f[1].abs())).sum()
        }
        LoadKind::Function(_) => 0.0,
    }
}

/// Σ |pᵢ|/√Mᵢᵢ, which is at least √(pᵀD⁻¹p).
fn over_roots(impulse: &[f64], mass: &[f64]) -> f64 {
    impulse.iter().zip(mass).map(|(p, m)| p.abs() / m.sqrt()).sum()
}

/// The largest λ of D x = λ M x, with the diagonal D of M, by the power method: pᵀM⁻¹p is at most λ
/// times pᵀD⁻¹p.
fn diagonal_share(mass: &Symmetric, factor: Option<Factor>) -> f64 {
    let Some(mut factor) = factor.filter(|_| mass.half_bandwidth() > 0) else { return 1.0 };
    let diagonal = mass.diagonal_entries();
    let mut x: Vec<f64> = (0..diagonal.len()).map(|i| 1.0 - 2.0 * (i % 2) as f64 + 1e-3 * i as f64).collect();
    let mut share = 1.0;
    for _ in 0..ITERATIONS {
        let norm = mass.form(&x, &x).sqrt();
        x.iter_mut().for_each(|x| *x /= norm);
        share = x.iter().zip(&diagonal).map(|(x, d)| d * x * x).sum();
        x.iter_mut().zip(&diagonal).for_each(|(x, d)| *x *= d);
        factor.solve(&mut x);
    }
    share.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_the_diagonal_is_that_of_the_softest_motion() {
        // M = [[1, r], [r, 1]] has the eigenvalues 1 ± r, and D = I: λ = 1/(1 − r).
        for r in [0.5, -0.5, 0.999] {
            let mass = Symmetric::from_entries(2, [(0, 0, 1.0), (1, 0, r), (1, 1, 1.0)]);
            let share = diagonal_share(&mass, Factor::new(&mass).ok());
            assert!((share * (1.0 - f64::abs(r)) - 1.0).abs() < 1e-3, "{r}: {share}");
        }
        assert_eq!(diagonal_share(&Symmetric::diagonal(&[2.0, 3.0]), None), 1.0);
    }

    #[test]
    fn a_load_gives_at_most_the_integral_of_its_magnitude() {
        let table = crate::scene::Table::new(vec![0.0, 1.0, 2.0], vec![0.0, -4.0, 2.0]).expect("a table");
        // Two triangles of 2 N s, the second from −4 to 2 N: 3 N s bound it.
        assert_eq!(integral(&LoadKind::Table(table), 9.0), 5.0);
        assert_eq!(integral(&LoadKind::Constant { force: -3.0 }, 2.0), 6.0);
        assert_eq!(integral(&LoadKind::Impulse { impulse: -0.5, time: 1.0 }, 2.0), 0.5);
    }
}
