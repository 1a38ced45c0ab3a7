//! Blows, that is loads of no duration, within a step.

use crate::linear::Factor;
use crate::scene::{Scene, System};

/// What the blows of a step do; vectors over degrees of freedom, zero in scenes without blows.
#[derive(Debug, Clone)]
pub(super) struct Blows {
    /// N s.
    pub impulse: Vec<f64>,
    /// Change of velocity, m/s.
    pub struck: Vec<f64>,
    /// Impulse and change of velocity while they are hidden.
    hidden: [Vec<f64>; 2],
    /// The displacement that they add to that of the step's rule, m, zero in steps without a blow;
    /// and the displacement at the step's end without it.
    pub beyond: Vec<f64>,
    pub arrived: Vec<f64>,
    /// The displacement whose velocity the damper feels in the step's balance, m.
    pub felt: Vec<f64>,
}

impl Blows {
    /// Zeros for n degrees of freedom.
    pub fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self {
            impulse: zero(),
            struck: zero(),
            hidden: [zero(), zero()],
            beyond: zero(),
            arrived: zero(),
            felt: zero(),
        }
    }

    /// Hides the blows of a step, or shows them again.
    pub fn hide(&mut self) {
        let [impulse, struck] = &mut self.hidden;
        std::mem::swap(&mut self.impulse, impulse);
        std::mem::swap(&mut self.struck, struck);
    }
}

/// M⁻¹x in place: the velocities (m/s) that the impulses x (N s) give.
pub(super) fn divide(scene: &Scene, mass: Option<&mut Factor>, x: &mut [f64]) {
    if let Some(mass) = mass {
        mass.solve(x);
    }
    if let System::Oscillator(o) = &scene.system {
        x.iter_mut().for_each(|x| *x /= o.mass);
    }
}
