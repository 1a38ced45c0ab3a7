//! The impulses that count as none.

use crate::scene::{LoadKind, Scene, System, Wall, WallLaw};
use crate::step::{Bound, Contract};

/// Rounding error of a sum of a few terms, relative to the largest.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Limit up to which an impulse at one wall is rounding: `force` · h + `inertia`/h, N s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Floor {
    /// N: rounding error of the forces that balance where a body rests.
    pub force: f64,
    /// kg m: rounding error of the displacement times the mass, where a scheme computes its
    /// impulses from displacements.
    pub inertia: f64,
}

impl Floor {
    /// One per wall of `scene`.
    pub fn all(scene: &Scene, masses: &[f64], contract: Contract) -> Vec<Self> {
        let size = |kind: &LoadKind| match kind {
            LoadKind::Constant { force } => force.abs(),
            LoadKind::Harmonic { amplitude, .. } => amplitude.abs(),
            LoadKind::Table(table) => table.force().iter().fold(0.0, |most: f64, f| most.max(f.abs())),
            _ => 0.0,
        };
        let loads: f64 = scene.loads.iter().map(|load| size(&load.kind)).sum();
        // For a structure the loads alone set the scale: what its springs carry at rest comes from
        // the loads.
        let spring = if let System::Oscillator(o) = scene.system { o.stiffness } else { 0.0 };
        let positions = matches!(contract.promise.rigid.displacement, Some(Bound::End | Bound::Reflected));
        let spring_of = |law: WallLaw| law.spring().map_or(0.0, |spring| spring.stiffness);
        let floor = |(wall, mass): (&Wall, &f64)| {
            let place = wall.position().abs();
            let own = spring_of(wall.law);
            let displaced = if wall.is_round() { contract.promise.hole.is_some() } else { positions };
            let inertia = if displaced { mass * place } else { 0.0 };
            Self { force: ROUNDING * (loads + (spring + own) * place), inertia: ROUNDING * inertia }
        };
        scene.walls.iter().zip(masses).map(floor).collect()
    }

    /// True if an impulse `p` (N s) of a step of `h` (s) is rounding; without a division, since
    /// this runs for every pushing wall in every step.
    #[inline]
    pub fn holds(&self, p: f64, h: f64) -> bool {
        p.abs() * h <= self.force * h * h + self.inertia
    }
}
