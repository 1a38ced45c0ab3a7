//! The energy that a scheme itself produces, for one degree of freedom: a few operations per step,
//! much cheaper than the judge.

use crate::scene::Wall;
use crate::scheme::Stepper;
use crate::step::{Balance, Step};

/// The energy that a scheme produces between impacts. The load need not be known: by the momentum
/// balance that every scheme declares ([`Balance`]), the work of load and dampers in a step equals
/// the change of energy except for the terms summed here.
///
/// θ-balance: p·Δq/h + ΔU − (θ−½)(mΔv² + kΔq²). Staggered: p·(v₋ + v₊)/2 + ΔU between half steps. U
/// is the energy in the springs of the walls; the energy that their dashpots take, and the energy
/// left in a damped wall when it releases the body, do not count as a loss of the scheme. Steps in
/// which a rigid wall pushes are left out: the energy change there is computed from the speeds
/// before and after.
pub(super) struct Ledger {
    springs: Vec<Spring>,
    /// Indices of the rigid walls.
    rigid: Vec<usize>,
    balance: Balance,
    h: f64,
    mass: f64,
    stiffness: f64,
    q: f64,
    /// True where a wall pushed or held the body in the last step: staggered, the energy change of
    /// a wall spans two steps.
    busy: bool,
    made: f64,
}

/// A wall that is not rigid.
struct Spring {
    index: usize,
    wall: Wall,
    /// Energy stored in it at the end of the last step, J.
    stored: f64,
}

impl Ledger {
    pub fn new(stepper: &Stepper, h: f64) -> Self {
        let scene = stepper.scene();
        let (mass, stiffness) = (scene.system.mass_form(&[1.0], &[1.0]), scene.system.stiffness_form(&[1.0], &[1.0]));
        let q = at(&stepper.state().q);
        let (mut springs, mut rigid) = (Vec::new(), Vec::new());
        for (index, wall) in scene.walls.iter().enumerate() {
            if wall.law.is_rigid() {
                rigid.push(index);
                continue;
            }
            springs.push(Spring { index, wall: wall.clone(), stored: wall.law.energy(-wall.gap(q)) });
        }
        Self { springs, rigid, balance: stepper.contract().balance, h, mass, stiffness, q, busy: true, made: 0.0 }
    }

    /// The energy produced so far, J.
    pub fn made(&self) -> f64 {
        self.made
    }

    /// Adds a step; `busy` where a wall pushed in it or holds the body at its end.
    #[inline]
    pub fn observe(&mut self, step: &Step<'_>, busy: bool) {
        let (q, before, after) = (at(step.q), at(step.velocity_before), at(step.velocity_after));
        let shift = q - self.q;
        let touched = busy || self.busy;
        let impulse = |index: usize| step.impulse.get(index).copied().unwrap_or(0.0);
        let struck = touched && self.rigid.iter().any(|&index| impulse(index) != 0.0);
        if let (Balance::Theta(theta), false) = (self.balance, struck)
            && theta != 0.5
        {
            let jump = after - before;
            self.made -= (theta - 0.5) * (self.mass * jump * jump + self.stiffness * shift * shift);
        }
        if touched {
            let staggered = matches!(self.balance, Balance::Staggered(_));
            let length = step.length(self.h);
            let over = |shift: f64| if length > 0.0 { shift / length } else { 0.0 };
            let rate = if staggered { 0.5 * (before + after) } else { over(shift) };
            for spring in &mut self.springs {
                let wall = &spring.wall;
                let (depth, depth_end) = (-wall.gap(self.q), -wall.gap(q));
                let (energy, energy_end) = (wall.law.energy(depth), wall.law.energy(depth_end));
                let stored = if staggered { 0.5 * (energy + energy_end) } else { energy_end };
                let p = impulse(spring.index);
                if p != 0.0 || !wall.law.is_damped() {
                    self.made += p * rate + stored - spring.stored;
                    // Impulse of the dashpot, part of p.
                    let depth_rate = -wall.side().sign() * rate;
                    let plate_rate = if staggered { depth_rate } else { over(depth_end.max(0.0) - depth.max(0.0)) };
                    let dashpot = wall.law.dashpot(wall.law.mean_force(depth, depth_end).0);
                    self.made += dashpot * plate_rate * depth_rate * length;
                }
                spring.stored = stored;
            }
        }
        self.busy = busy;
        self.q = q;
    }
}

/// The value of the only degree of freedom.
pub(super) fn at(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}
