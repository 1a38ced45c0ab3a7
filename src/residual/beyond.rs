//! Residuals minus their rounding error, with the place where each was worst.

use super::most::most;
use super::moves::Moves;
use super::weights::Weights;

/// Rounding error of a sum in a step, in units in the last place, times √n for sums over n degrees
/// of freedom (tests of extreme scenes allow every scheme of one degree of freedom 32).
const UNITS: f64 = 64.0;

/// A solver with several unknowns counts a bound as met that is missed by 1e-12 of the gap scale
/// (or of the gap scale over a time step); twice that, since the judge computes it again.
const MET: f64 = 2e-12;

/// The worst residual so far: its value, time (s) and wall. NaN is worse than any number.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Worst {
    pub value: f64,
    pub time: f64,
    pub wall: Option<usize>,
}

impl Worst {
    pub fn see(&mut self, value: f64, time: f64, wall: Option<usize>) {
        if !self.value.is_nan() && (value > self.value || value.is_nan()) {
            *self = Self { value, time, wall };
        }
    }

    pub fn over(self, scale: f64) -> Self {
        Self { value: if self.value == 0.0 { 0.0 } else { self.value / scale }, ..self }
    }
}

/// Pairs (γ, |r|), each minus its rounding error; see [`Pairs`](super::complementarity::Pairs).
#[derive(Debug, Clone, Default)]
pub(super) struct Doubts {
    pub outside: Worst,
    pub pull: Worst,
    /// Pairs with both values positive, none of which another pair exceeds in both, with their
    /// places.
    stairs: Vec<(f64, f64, Worst)>,
}

/// Maximum number of such pairs: a run with more violates complementarity in any case.
const STAIRS: usize = 64;

impl Doubts {
    /// Adds a pair of `slack` and `pressure`, each with its rounding error.
    pub fn add(&mut self, (slack, gap_noise): (f64, f64), (pressure, force_noise): (f64, f64), time: f64, wall: usize) {
        self.outside.see(-slack - gap_noise, time, Some(wall));
        self.pull.see(-pressure - force_noise, time, Some(wall));
        let (slack, pressure) = (slack - gap_noise, pressure - force_noise);
        if slack <= 0.0 || pressure <= 0.0 || self.stairs.iter().any(|s| s.0 >= slack && s.1 >= pressure) {
            return;
        }
        self.stairs.retain(|s| s.0 > slack || s.1 > pressure);
        if self.stairs.len() < STAIRS {
            self.stairs.push((slack, pressure, Worst { value: 0.0, time, wall: Some(wall) }));
        }
    }

    /// The largest min(γ/γ₀, r/r₀), with its place.
    pub fn both(&self, gap_scale: f64, force_scale: f64) -> Worst {
        let mut worst = Worst::default();
        for (slack, pressure, at) in &self.stairs {
            worst.see((slack / gap_scale).min(pressure / force_scale), at.time, at.wall);
        }
        worst
    }
}

/// The largest terms of the balances so far, in the metric of the mass, and the rounding errors
/// that follow from them.
#[derive(Debug)]
pub(super) struct Rounding {
    /// UNITS · ε · √n.
    unit: f64,
    /// Largest √(Kᵢᵢ/Mᵢᵢ) and √(Cᵢᵢ/Mᵢᵢ).
    rates: [f64; 2],
    /// √m, with m the mass that each wall feels.
    wall: Vec<f64>,
    /// Largest |vᵢ|√Mᵢᵢ, |qᵢ|√Mᵢᵢ, |qᵢ|√Kᵢᵢ, |vᵢ|√Cᵢᵢ.
    speed: f64,
    reach: f64,
    strain: f64,
    rub: f64,
    /// Largest force of loads and of walls that are not rigid, N/√kg, and of all walls.
    load: f64,
    push: f64,
    /// Rounding error of the energy ledger so far, J.
    pub energy: f64,
}

impl Rounding {
    pub fn new(weights: &Weights, masses: &[f64]) -> Self {
        let rate = |[mass, spring, dashpot]: [f64; 3], one: bool| {
            let root = if one { spring } else { dashpot };
            if root > 0.0 { root / mass } else { 0.0 }
        };
        let largest = |one: bool| weights.roots.iter().map(|&roots| rate(roots, one)).fold(0.0, f64::max);
        Self {
            unit: UNITS * f64::EPSILON * (weights.roots.len().max(1) as f64).sqrt(),
            rates: [largest(true), largest(false)],
            wall: masses.iter().map(|mass| mass.sqrt()).collect(),
            speed: 0.0,
            reach: 0.0,
            strain: 0.0,
            rub: 0.0,
            load: 0.0,
            push: 0.0,
            energy: 0.0,
        }
    }

    /// Notes the sizes of a state: displacement (m) and velocity (m/s), and a time (s) over which
    /// that velocity moves it.
    pub fn state(&mut self, q: &[f64], v: &[f64], span: f64, weights: &Weights) {
        for ((q, v), [mass, spring, dashpot]) in q.iter().zip(v).zip(&weights.roots) {
            let (q, v) = (q.abs() + span * v.abs(), v.abs());
            self.speed = self.speed.max(v * mass);
            self.reach = self.reach.max(q * mass);
            self.strain = self.strain.max(q * spring);
            self.rub = self.rub.max(v * dashpot);
        }
    }

    /// As [`Self::state`] for what a step on a grid of `h` seconds (and 1/h) did, and notes the
    /// sizes of its mean load `mean` (N), its load at the end, the extra force and its blows.
    #[inline(always)]
    pub fn step(&mut self, moves: &Moves<'_>, mean: &[f64], weights: &Weights, (h, per_h): (f64, f64), n: usize) {
        let (q, before, after, roots) = (&moves.shown[..n], &moves.before[..n], &moves.after[..n], &weights.roots[..n]);
        let [mut speed, mut reach, mut strain, mut rub] = [self.speed, self.reach, self.strain, self.rub];
        for i in 0..n {
            let [mass, spring, dashpot] = roots[i];
            let v = most(before[i].abs(), after[i].abs());
            let q = q[i].abs() + h * v;
            speed = most(speed, v * mass);
            reach = most(reach, q * mass);
            strain = most(strain, q * spring);
            rub = most(rub, v * dashpot);
        }
        (self.speed, self.reach, self.strain, self.rub) = (speed, reach, strain, rub);
        let (end, extra, blow) = (&moves.load_end[..n], &moves.extra[..n], &moves.blow[..n]);
        let (mean, per_root, mut load) = (&mean[..n], &weights.per_root_mass[..n], self.load);
        for i in 0..n {
            let force = most(most(mean[i].abs(), blow[i].abs() * per_h), extra[i].abs() + end[i].abs());
            load = most(load, force * per_root[i]);
        }
        self.load = load;
    }

    /// Notes the size of a load, N/√kg.
    pub fn load(&mut self, force: f64) {
        self.load = self.load.max(force.abs());
    }

    /// Notes the size of a wall's force, N.
    pub fn push(&mut self, wall: usize, force: f64, rigid: bool) {
        if force == 0.0 {
            return;
        }
        let force = force.abs() / self.wall.get(wall).copied().unwrap_or(1.0);
        self.push = self.push.max(force);
        if !rigid {
            self.load = self.load.max(force);
        }
    }

    /// Rounding error of a momentum balance over `span` seconds, N/√kg; `clock` is 1 plus the error
    /// of the span's ends over the span, in ulps.
    pub fn force(&self, span: f64, clock: f64) -> f64 {
        let [spring, dashpot] = self.rates;
        self.unit * (self.speed / span + clock * (spring * self.strain + dashpot * self.rub + self.load + self.push))
    }

    /// Rounding error of a wall's force, N.
    pub fn wall_force(&self, wall: usize, span: f64, clock: f64) -> f64 {
        self.force(span, clock) * self.wall.get(wall).copied().unwrap_or(1.0)
    }

    /// Rounding error of a sum of terms of this `size`, in its unit.
    pub fn of(&self, size: f64) -> f64 {
        self.unit * size
    }

    /// As [`Self::of`], plus the tolerance of the solvers, which is relative to the gap scale.
    pub fn met(&self, size: f64, gap_scale: f64) -> f64 {
        self.unit * size + MET * gap_scale
    }

    /// Rounding error of a displacement, m√kg.
    pub fn path(&self) -> f64 {
        self.unit * self.reach
    }

    /// Adds the rounding error of as many `steps` of `span` seconds and of `bodies` degrees of
    /// freedom to that of the energy ledger. A velocity has the rounding error of the momentum that
    /// the load gives in a step, even of a body that a wall holds at rest.
    #[inline(always)]
    pub fn book(&mut self, bodies: f64, steps: f64, span: f64) {
        let given = self.load * span;
        let states = self.speed.powi(2) + self.strain.powi(2) + given.powi(2);
        let flows = bodies * states + self.load * self.reach;
        self.energy += steps * (self.unit * flows);
    }
}

#[cfg(test)]
mod tests;
