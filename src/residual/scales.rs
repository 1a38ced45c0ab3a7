//! Scales of the residuals: reference sizes of the scene, in the metric of its mass.
//!
//! Degrees of freedom may differ in unit: metres beside radians, or modal coordinates. Forces over
//! √Mᵢᵢ can be compared with one another, and so can displacements times √Mᵢᵢ; for one degree of
//! freedom this changes nothing.

use crate::scene::Scene;

#[derive(Debug)]
pub(super) struct Scales {
    /// √m, with m the smallest mass that a wall feels; without walls that of the heaviest degree of
    /// freedom.
    root_wall_mass: f64,
    /// The gap scale, m √kg.
    pub gap: f64,
    /// The force of the structure's springs over the gap scale, N/√kg: the largest term of K q,
    /// whose sum is known to rounding only. It gives a scale to a run without loads and contacts.
    pub spring: f64,
    /// The force of the stiffest elastic wall over the gap scale, N.
    pub wall: f64,
}

impl Scales {
    pub fn new(scene: &Scene, masses: &[f64]) -> Self {
        let structure = scene.system.structure();
        let root_mass: Vec<f64> = structure.mass.diagonal_entries().into_iter().map(f64::sqrt).collect();
        let lightest = masses.iter().copied().filter(|m| m.is_finite()).reduce(f64::min);
        let root_wall_mass = lightest.map_or_else(|| root_mass.iter().fold(0.0, |a: f64, b| a.max(*b)), f64::sqrt);
        let gap = scene.gap_scale() * root_wall_mass;
        let stiffness = structure.stiffness.diagonal_entries();
        let fastest = stiffness.iter().zip(&root_mass).map(|(k, m)| k / (m * m)).fold(0.0, f64::max);
        // The tangent stiffness at the face; 0 for a rigid wall.
        let stiffest = scene.walls.iter().map(|wall| wall.law.tangent(f64::MIN_POSITIVE)).fold(0.0, f64::max);
        Self { root_wall_mass, gap, spring: fastest * gap, wall: stiffest * scene.gap_scale() }
    }

    /// The inverse of [`normal_force`](Self::normal_force), N.
    pub fn wall_force(&self, force: f64) -> f64 {
        force * self.root_wall_mass
    }

    /// A wall's force (N) over √m, with m the smallest mass that a wall feels, N/√kg.
    pub fn normal_force(&self, force: f64) -> f64 {
        force / self.root_wall_mass
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Symmetric;
    use crate::scene::{Structure, Wall};

    #[test]
    fn scales_are_those_of_the_lightest_wall_and_the_stiffest_spring() {
        // ω² = 9 and 2 1/s², and walls 0.5 m apart from their middle.
        let diagonal = |x: [f64; 2]| Symmetric::diagonal(&x);
        let mut scene = Scene::oscillator(1.0, 0.0, 1.0)
            .with_initial(&[0.0; 2], &[0.0; 2])
            .with_wall(Wall::upper("upper", 0.5))
            .with_wall(Wall::lower("lower", -0.5));
        let (mass, damping, stiffness) = (diagonal([4.0, 16.0]), diagonal([0.0; 2]), diagonal([36.0, 32.0]));
        scene.system = Structure { mass, damping, stiffness }.into();
        let scales = Scales::new(&scene, &[25.0, 9.0]);
        assert_eq!((scales.gap, scales.spring, scales.wall), (1.5, 13.5, 0.0));
        assert_eq!((scales.wall_force(12.0), scales.normal_force(12.0)), (36.0, 4.0));
        // Walls that feel no mass, and none: the heaviest degree of freedom.
        for masses in [&[f64::INFINITY; 2][..], &[]] {
            assert_eq!(Scales::new(&scene, masses).gap, 2.0);
        }
        scene.walls[0] = Wall::upper("upper", 0.5).with_elasticity(8.0, 0.0);
        scene.walls[1] = Wall::lower("lower", -0.5).with_elasticity(6.0, 1.0);
        assert_eq!(Scales::new(&scene, &[25.0, 9.0]).wall, 4.0);
    }
}
