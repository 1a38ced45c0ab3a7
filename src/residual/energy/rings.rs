//! Energy in elastic round holes.

use crate::scene::{Hole, Scene};
use crate::step::Step;

/// What each elastic hole stored after the last step, J; 0 of rigid ones.
#[derive(Debug, Clone, Default)]
pub(super) struct Rings {
    held: Vec<f64>,
}

impl Rings {
    /// The elastic holes of `scene` at `q`; none is kept in a scene without.
    pub fn new(scene: &Scene, q: &[f64]) -> Self {
        if scene.holes().all(|hole| hole.law.is_rigid()) {
            return Self::default();
        }
        let stores = |hole: Hole<'_>| stored(&hole, distance(&hole, q), distance(&hole, q) > hole.gap);
        Self { held: scene.holes().map(stores).collect() }
    }

    /// What all of them store, J.
    pub fn stored(&self) -> f64 {
        self.held.iter().sum()
    }

    /// What they store after a step of `h` seconds from `q0` to `q1`, and what their dashpots take
    /// in it, J. As at elastic walls.
    pub fn see(&mut self, scene: &Scene, h: f64, (q0, q1): (&[f64], &[f64]), step: &Step<'_>) -> (f64, f64) {
        let mut lost = 0.0;
        for ((hole, did), held) in scene.holes().zip(step.holes).zip(&mut self.held) {
            let (r0, r1, touches) = (distance(&hole, q0), distance(&hole, q1), did.impulse != 0.0);
            let before = std::mem::replace(held, stored(&hole, r1, touches));
            let damping = hole.law.damping();
            if damping > 0.0 {
                if touches {
                    let rate = ((r1 - hole.gap).max(0.0) - (r0 - hole.gap).max(0.0)) / h;
                    lost += damping * rate * rate * h;
                    lost -= if before == 0.0 { hole.law.energy(r0 - hole.gap) } else { 0.0 };
                } else {
                    lost += before;
                }
            }
        }
        (self.stored(), lost)
    }

    /// What they store at `q`, J, pushing or not as after the last step.
    pub fn displace(&mut self, scene: &Scene, q: &[f64]) -> f64 {
        for (hole, held) in scene.holes().zip(&mut self.held) {
            *held = stored(&hole, distance(&hole, q), *held != 0.0);
        }
        self.stored()
    }
}

fn distance(hole: &Hole<'_>, q: &[f64]) -> f64 {
    let [y, z] = hole.support.offset(q);
    y.hypot(z)
}

/// Energy stored in a hole at this distance from its centre, J; 0 for a damped one that does not
/// push.
fn stored(hole: &Hole<'_>, distance: f64, touching: bool) -> f64 {
    if hole.law.damping() > 0.0 && !touching { 0.0 } else { hole.law.energy(distance - hole.gap) }
}
