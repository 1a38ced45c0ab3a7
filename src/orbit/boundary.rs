//! The boundary at which an orbit meets a wall, and its states just before and after an event
//! there.

use super::signature::Kind;
use crate::variation::WallTangent;

/// A wall as the equations of an orbit use it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Boundary {
    /// g, m.
    pub position: f64,
    /// The direction into the wall: +1 for an upper wall, −1 for a lower one.
    pub toward: f64,
    pub law: BoundaryLaw,
}

/// The law of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BoundaryLaw {
    /// With restitution e.
    Rigid(f64),
    /// k_a, N/m, and c_a, N s/m.
    Elastic { stiffness: f64, damping: f64 },
}

/// A state q (m), q̇ (m/s) that depends on the speed v of an event, and its derivative with respect
/// to v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OnWall {
    pub state: [f64; 2],
    pub rate: [f64; 2],
}

impl Boundary {
    /// The state just before an event of speed `v` (m/s).
    pub fn before(&self, kind: Kind, v: f64) -> OnWall {
        let on_face = |d: f64| OnWall { state: [self.position, d * v], rate: [0.0, d] };
        match (kind, self.law) {
            (Kind::Leave | Kind::Again, BoundaryLaw::Elastic { stiffness, damping }) => {
                // k_a s + c_a ṡ = 0 at the speed v out of the wall.
                let depth = self.toward * damping / stiffness;
                OnWall { state: [self.position + depth * v, -self.toward * v], rate: [depth, -self.toward] }
            }
            _ => on_face(self.toward),
        }
    }

    /// The state just after it.
    pub fn after(&self, kind: Kind, v: f64) -> OnWall {
        let scaled = |factor: f64| {
            let d = self.toward * factor;
            OnWall { state: [self.position, d * v], rate: [0.0, d] }
        };
        match (kind, self.law) {
            (Kind::Impact | Kind::Chatter, BoundaryLaw::Rigid(e)) => scaled(-e),
            (Kind::Rest | Kind::Release, _) => scaled(0.0),
            _ => self.before(kind, v),
        }
    }

    /// The derivative of the state just before an event of speed `v` (m/s), which does not change,
    /// with respect to a key that changes the wall by `by`.
    pub fn before_by(&self, kind: Kind, v: f64, by: &WallTangent) -> [f64; 2] {
        match (kind, self.law) {
            (Kind::Leave | Kind::Again, BoundaryLaw::Elastic { stiffness, damping }) => {
                let depth = self.toward * (by.damping - damping * by.stiffness / stiffness) / stiffness;
                [by.position + depth * v, 0.0]
            }
            _ => [by.position, 0.0],
        }
    }

    /// The same of the state just after it.
    pub fn after_by(&self, kind: Kind, v: f64, by: &WallTangent) -> [f64; 2] {
        match (kind, self.law) {
            (Kind::Impact | Kind::Chatter, BoundaryLaw::Rigid(_)) => [by.position, -self.toward * by.restitution * v],
            (Kind::Rest | Kind::Release, _) => [by.position, 0.0],
            _ => self.before_by(kind, v, by),
        }
    }

    /// Distance of `q` (m) to the wall, m; below 0 behind its face.
    pub fn gap(&self, q: f64) -> f64 {
        self.toward * (self.position - q)
    }
}
