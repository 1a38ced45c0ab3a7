//! Weights of the degrees of freedom, by which those of different units are compared.

use crate::scene::Scene;

/// One entry per degree of freedom; for several steps of one degree of freedom, one per step.
#[derive(Debug, Clone)]
pub(super) struct Weights {
    /// √Mᵢᵢ and 1/√Mᵢᵢ.
    pub root_mass: Vec<f64>,
    pub per_root_mass: Vec<f64>,
    /// √|Mᵢᵢ|, √|Kᵢᵢ| and √|Cᵢᵢ|.
    pub roots: [Vec<f64>; 3],
    /// Largest weight of a rigid wall that sees this degree of freedom alone.
    pub seen: Vec<f64>,
}

impl Weights {
    pub fn new(scene: &Scene) -> Self {
        let structure = scene.system.structure();
        let diagonals = [&structure.mass, &structure.stiffness, &structure.damping].map(|m| m.diagonal_entries());
        let n = diagonals[0].len();
        let root = |x: &[f64]| (0..n).map(|i| x.get(i).map_or(0.0, |x| x.abs().sqrt())).collect();
        let root_mass: Vec<f64> = diagonals[0].iter().map(|m| m.sqrt()).collect();
        let mut seen = vec![0.0_f64; n];
        for wall in scene.walls.iter().filter(|wall| wall.law.is_rigid()) {
            if let &[(i, weight)] = wall.row().entries()
                && let Some(seen) = seen.get_mut(i)
            {
                *seen = seen.max(weight.abs());
            }
        }
        Self {
            per_root_mass: root_mass.iter().map(|root| 1.0 / root).collect(),
            root_mass,
            roots: [0, 1, 2].map(|j: usize| root(&diagonals[j])),
            seen,
        }
    }

    /// Those of one degree of freedom, `count` times.
    pub fn repeated(&self, count: usize) -> Self {
        Self {
            root_mass: self.root_mass.repeat(count),
            per_root_mass: self.per_root_mass.repeat(count),
            roots: [0, 1, 2].map(|j: usize| self.roots[j].repeat(count)),
            seen: self.seen.repeat(count),
        }
    }
}
