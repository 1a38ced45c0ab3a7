//! The rounding errors of a step's balances, places and forces.

use super::scratch::StepSizes;
use super::weights::Weights;

/// Rounding error of a sum in a step, in units in the last place, times √n for sums over n degrees
/// of freedom (tests of extreme scenes allow every scheme of one degree of freedom 32).
const UNITS: f64 = 64.0;

/// A solver with several unknowns counts a bound as met that is missed by 1e-12 of the gap scale
/// (or of the gap scale over a time step); twice that, since the judge computes it again.
const MET: f64 = 2e-12;

/// The largest terms of the balances so far, in the metric of the mass, and the rounding errors
/// that follow from them in the current step.
#[derive(Debug, Default)]
pub(super) struct NoiseModel {
    /// UNITS · ε · √n.
    unit: f64,
    /// m.
    gap_scale: f64,
    /// The current step: its end and its length, s, and `clock`, which for exact motion, whose ends
    /// are known to an ulp, is 1 plus the end time over the length, else 1.
    pub end: f64,
    pub span: f64,
    pub clock: f64,
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

impl NoiseModel {
    /// Of a scene whose walls feel `masses` (kg), with the scale of its gaps (m).
    pub fn new(weights: &Weights, masses: &[f64], gap_scale: f64) -> Self {
        let [mass, spring, dashpot] = &weights.roots;
        let rate = |(root, mass): (&f64, &f64)| if *root > 0.0 { root / mass } else { 0.0 };
        let largest = |roots: &[f64]| roots.iter().zip(mass).map(rate).fold(0.0, f64::max);
        Self {
            unit: UNITS * f64::EPSILON * (mass.len().max(1) as f64).sqrt(),
            gap_scale,
            span: 1.0,
            clock: 1.0,
            rates: [largest(spring), largest(dashpot)],
            wall: masses.iter().map(|mass| mass.sqrt()).collect(),
            ..Self::default()
        }
    }

    /// Begins a step of `h` seconds on a grid, which ends at `end` (s).
    #[inline(always)]
    pub fn begin(&mut self, h: f64, end: f64) {
        (self.end, self.span, self.clock) = (end, h, 1.0);
    }

    /// Begins a stretch of exact motion from `start` to `end` (s).
    pub fn begin_exact(&mut self, start: f64, end: f64) {
        self.end = end;
        self.span = (end - start).max(f64::EPSILON * end).max(f64::MIN_POSITIVE);
        self.clock = 1.0 + end / self.span;
    }

    /// Notes the sizes of a state: displacement (m) and velocity (m/s), and a time (s) over which
    /// that velocity moves it.
    pub fn state(&mut self, q: &[f64], v: &[f64], span: f64, weights: &Weights) {
        let [mass, spring, dashpot] = &weights.roots;
        for ((((q, v), mass), spring), dashpot) in q.iter().zip(v).zip(mass).zip(spring).zip(dashpot) {
            let (q, v) = (q.abs() + span * v.abs(), v.abs());
            self.speed = self.speed.max(v * mass);
            self.reach = self.reach.max(q * mass);
            self.strain = self.strain.max(q * spring);
            self.rub = self.rub.max(v * dashpot);
        }
    }

    /// Notes the sizes of a step on a grid.
    #[inline(always)]
    pub fn step(&mut self, sizes: &StepSizes) {
        let &StepSizes { speed, reach, strain, rub, force, .. } = sizes;
        (self.speed, self.reach) = (self.speed.max(speed), self.reach.max(reach));
        (self.strain, self.rub) = (self.strain.max(strain), self.rub.max(rub));
        self.load = self.load.max(force);
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

    /// Rounding error of the momentum balance of the step, N/√kg.
    pub fn force(&self) -> f64 {
        self.over(self.span, self.clock)
    }

    /// Rounding error of the momentum balance of a step of `h` seconds on a grid, N/√kg.
    pub fn force_over(&self, h: f64) -> f64 {
        self.over(h, 1.0)
    }

    fn over(&self, span: f64, clock: f64) -> f64 {
        let [spring, dashpot] = self.rates;
        let terms = spring * self.strain + dashpot * self.rub + self.load + self.push;
        self.unit * (self.speed / span + clock * terms)
    }

    /// Rounding error of a wall's force in the step, N.
    pub fn wall_force(&self, wall: usize) -> f64 {
        self.force() * self.wall.get(wall).copied().unwrap_or(1.0)
    }

    /// Rounding error of a sum of terms of this `size`, in its unit.
    pub fn of(&self, size: f64) -> f64 {
        self.unit * size
    }

    /// Rounding error of a place whose terms are of this `size`, m, with the tolerance of the
    /// solvers, which is relative to the gap scale.
    pub fn place(&self, size: f64) -> f64 {
        self.unit * size + MET * self.gap_scale
    }

    /// As [`Self::place`], of a velocity (m/s) that moves the body for `span` seconds.
    pub fn velocity(&self, size: f64, span: f64) -> f64 {
        self.unit * size + MET * (self.gap_scale / span)
    }

    /// Rounding error of a displacement, m√kg.
    pub fn path(&self) -> f64 {
        self.unit * self.reach
    }

    /// The largest displacement so far, of whichever degree of freedom, as one of the mass that a
    /// wall feels, m.
    pub fn reach(&self, wall: usize) -> f64 {
        self.reach / self.wall.get(wall).copied().unwrap_or(1.0)
    }

    /// The change of velocity that an impulse (N s) of a wall gives to the mass that it feels, m/s.
    pub fn kick(&self, wall: usize, impulse: f64) -> f64 {
        impulse.abs() / self.wall.get(wall).map_or(1.0, |root| root * root)
    }

    /// The largest |qᵢ|√Mᵢᵢ so far, with what velocities add to it within a step, and with `other`
    /// values of the same kind, m√kg.
    pub fn largest_place(&self, other: f64) -> f64 {
        self.reach + other
    }

    /// Adds the rounding error of as many `steps` of this length and of `bodies` degrees of
    /// freedom to that of the energy ledger. A velocity has the rounding error of the momenta that
    /// the load and the walls give in a step, even of a body that walls hold at rest, which in a
    /// narrow corner push far more than the load; the load works at that velocity.
    #[inline(always)]
    pub fn book(&mut self, bodies: f64, steps: f64) {
        let given = self.load * self.span;
        let states = self.speed.powi(2) + self.strain.powi(2) + given * (given + self.push * self.span);
        let flows = bodies * states + self.load * self.reach;
        self.energy += steps * (self.unit * flows);
    }
}

#[cfg(test)]
mod tests;
