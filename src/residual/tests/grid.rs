//! Steps made by hand, some of them false: what the judge notes of them, what it allows for
//! rounding, and what it accuses. Numbers are multiples of powers of two, so that sums are exact
//! and expected values can be worked out by hand.

mod allowances;
mod momentum;
mod quiet_steps;
mod sums;
mod terms;
mod verdict;
mod walls;

use super::super::*;
use crate::scene::{Load, Structure, Table, Wall};
use crate::step::{Balance, Bound, Conserves, Elastic, Law, Promise, PromisedForce, Reached, Rigid, Tolerances};

/// The time step, s.
const H: f64 = 0.125;

/// What a step claims.
#[derive(Debug, Clone, Default)]
struct Claim {
    index: u64,
    q: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    extra: Vec<f64>,
    impulse: Vec<f64>,
    force: Vec<f64>,
    jump: Vec<f64>,
}

impl Claim {
    /// A step of one degree of freedom to `q` (m) with the velocities `before` and `after` (m/s),
    /// in which none of `walls` walls pushes.
    fn of(q: f64, before: f64, after: f64, walls: usize) -> Self {
        let zeros = || vec![0.0; walls];
        let one = |x: f64| vec![x];
        Self {
            index: 0,
            q: one(q),
            before: one(before),
            after: one(after),
            extra: one(0.0),
            impulse: zeros(),
            force: zeros(),
            jump: zeros(),
        }
    }

    fn at(self, index: u64) -> Self {
        Self { index, ..self }
    }

    /// The same with an impulse (N s) and a force (N) of the first wall.
    fn pushed(mut self, impulse: f64, force: f64) -> Self {
        (self.impulse[0], self.force[0]) = (impulse, force);
        self
    }

    fn step(&self) -> Step<'_> {
        Step {
            index: self.index,
            start: self.index as f64 * H,
            end: (self.index + 1) as f64 * H,
            q: &self.q,
            v: &self.after,
            velocity_before: &self.before,
            velocity_after: &self.after,
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            extra: &self.extra,
            ..Step::still(&[], &[])
        }
    }
}

/// A contract of `balance` alone, to which tests add what they check.
fn contract(balance: Balance) -> Contract {
    let (promise, tolerances) = (Promise::springs(Law::Depth(1.0)), Tolerances::of(Conserves::Nothing));
    Contract { balance, promise, instant: 0.5, tolerances, divides: false }
}

/// A contract of a θ-rule, θ = ½, with a bound or an impact law at rigid walls on the mean force.
fn rigid(displacement: Option<Bound>, velocity: Option<Reached>) -> Contract {
    let mut contract = contract(Balance::Theta(0.5));
    contract.promise.rigid = Rigid { force: PromisedForce::Mean, displacement, velocity };
    contract
}

/// A free body of 1 kg under `wall`, with a gap scale of 1 m.
fn under(wall: Wall) -> Scene {
    let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(wall);
    assert_eq!(scene.gap_scale(), 1.0);
    scene
}

/// A judge of a run from the displacement `q` (m) and the velocity `v` (m/s).
fn judge(scene: &Scene, contract: Contract, q: f64, v: f64) -> Judge {
    Judge::new(scene, contract, H, &[q], &[v])
}

/// A structure of two masses that are not coupled, from its diagonals of M, C and K.
fn two(diagonals: [[f64; 2]; 3]) -> Scene {
    let [mass, damping, stiffness] = diagonals.map(|x| crate::linear::Symmetric::diagonal(&x));
    Scene::structure(Structure { mass, damping, stiffness })
}

/// Fails unless both differ by no more than the judge takes off: 2e-12 of the gap scale, and of
/// that over a step of ⅛ s.
#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-10 * expected.abs(), "{found}, expected {expected}");
}
