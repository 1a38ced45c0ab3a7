//! Reference scales of a scene: frequencies, and the mass that a wall feels.

use super::{Hole, Row, Scene, Structure, System, distinct};
use crate::linear::{Factor, Symmetric};

/// Iterations of the power method: as a reference scale, a frequency needs no more digits than
/// these give.
const ITERATIONS: usize = 60;

/// The shift that makes K definite, as a share of the largest ω² · M: rigid-body motions get a
/// frequency below it.
const SHIFT: f64 = 1e-12;

impl System {
    /// The slowest and the fastest circular frequency (rad/s) of the system without damping and
    /// walls. They are estimates, within the true range, for reference scales, and exact where M
    /// and K are diagonal, as of modes. A rigid-body motion has the frequency 0.
    #[must_use]
    pub fn frequencies(&self) -> [f64; 2] {
        match self {
            Self::Oscillator(o) => [(o.stiffness / o.mass).sqrt(); 2],
            Self::Structure(s) => s.frequencies(),
        }
    }
}

/// The same of `structure`, whose M has the factor `mass`.
pub(super) fn frequencies(structure: &Structure, mass: Option<Factor>) -> [f64; 2] {
    if let Some(squares) = structure.uncoupled_squares() {
        let bound = |start: f64, of: fn(f64, f64) -> f64| squares.iter().fold(start, |x, y| of(x, *y)).max(0.0).sqrt();
        return [bound(f64::INFINITY, f64::min), bound(0.0, f64::max)];
    }
    let fastest = fastest_squared(structure, mass);
    let shift = SHIFT * fastest;
    let shifted = Symmetric::sum(&[(1.0, &structure.stiffness), (shift, &structure.mass)]);
    // The slowest is the reciprocal of the fastest of the inverse pencil.
    let slowest = |stiffness: &Symmetric, shift: f64| {
        let inverse = power(stiffness, Factor::new(stiffness).ok(), &structure.mass).filter(|x| *x > 0.0);
        inverse.map_or(0.0, |x| (1.0 / x - shift).max(0.0))
    };
    let mut least = slowest(&shifted, shift);
    if least <= 1e3 * shift {
        // A rigid-body motion, or one far slower than the stiffest spring makes the fastest: K
        // itself tells, down to its rounding.
        least = slowest(&structure.stiffness, 0.0);
        least = if least > shift { least } else { 0.0 };
    }
    [least.sqrt(), fastest.sqrt()]
}

impl Structure {
    /// ω² (1/s²) of each degree of freedom, where M and K couple none, as in modal coordinates.
    pub(crate) fn uncoupled_squares(&self) -> Option<Vec<f64>> {
        if self.mass.half_bandwidth() > 0 || self.stiffness.half_bandwidth() > 0 {
            return None;
        }
        let (m, k) = (self.mass.diagonal_entries(), self.stiffness.diagonal_entries());
        Some(m.into_iter().zip(k).map(|(m, k)| k / m).collect())
    }
}

/// ω² of the fastest motion, 1/s².
pub(in crate::scene) fn fastest_squared(structure: &Structure, mass: Option<Factor>) -> f64 {
    power(&structure.mass, mass, &structure.stiffness).unwrap_or(0.0)
}

/// The largest λ of B x = λ A x, by the power method; `None` if A is not positive definite and so
/// has no factor.
fn power(a: &Symmetric, factor: Option<Factor>, b: &Symmetric) -> Option<f64> {
    let n = a.size();
    let mut factor = factor?;
    // A start vector with components along every mode, whatever the symmetry of the structure.
    let mut x: Vec<f64> = (0..n).map(|i| (1.0 + 0.618_033_988_75 * i as f64).fract() - 0.3).collect();
    let mut y = vec![0.0; n];
    let mut lambda = 0.0;
    for _ in 0..ITERATIONS {
        let norm = a.form(&x, &x).sqrt();
        if norm.is_nan() || norm <= 0.0 {
            return None;
        }
        x.iter_mut().for_each(|x| *x /= norm);
        lambda = b.form(&x, &x);
        y.fill(0.0);
        b.add_product(1.0, &x, &mut y);
        factor.solve(&mut y);
        std::mem::swap(&mut x, &mut y);
        if x.iter().all(|x| *x == 0.0) {
            return Some(0.0);
        }
    }
    Some(lambda.max(0.0))
}

impl Scene {
    /// The mass that each wall feels, kg, in the scene's order: 1/(g M⁻¹ gᵀ). An impulse over this
    /// mass is the change of velocity there. Infinite for a wall with a zero row. Of a
    /// round wall it is the least mass over all its directions.
    #[must_use]
    pub fn wall_masses(&self) -> Vec<f64> {
        let mut masses = self.masses_along(self.walls.iter().map(|wall| wall.row()));
        if self.holes().next().is_some() {
            let structure = self.system.structure();
            let mut factor = structure.mass_factor().ok();
            for hole in self.holes() {
                if let Some(mass) = masses.get_mut(hole.index) {
                    *mass = least_mass(&hole, structure.mass.size(), factor.as_mut());
                }
            }
        }
        masses
    }

    /// The mass that moves along each of `rows`, 1/(g M⁻¹ gᵀ), kg; infinite where nothing does.
    pub(crate) fn masses_along<'a>(&self, rows: impl Iterator<Item = &'a Row>) -> Vec<f64> {
        match &self.system {
            System::Oscillator(o) => {
                let weight = |row: &Row| row.entries().iter().map(|entry| entry.1).sum::<f64>();
                rows.map(|row| o.mass / weight(row).powi(2)).collect()
            }
            System::Structure(s) => {
                let Ok(mut factor) = s.mass_factor() else { return rows.map(|_| f64::INFINITY).collect() };
                let lumped = s.mass.half_bandwidth() == 0;
                let mut response = vec![0.0; s.mass.size()];
                let mass = |at: &Row| {
                    let mut inverse = 0.0;
                    at.add_transposed(1.0, &mut response);
                    if lumped {
                        // Entry by entry, so that the cost per wall does not depend on n.
                        for &(i, _) in at.entries() {
                            if let Some(x) = response.get_mut(i) {
                                inverse += std::mem::take(x).powi(2) / s.mass.get(i, i);
                            }
                        }
                    } else {
                        factor.solve(&mut response);
                        inverse += at.dot(&response);
                        response.fill(0.0);
                    }
                    1.0 / inverse
                };
                let places = distinct(rows);
                let masses: Vec<f64> = places.rows.into_iter().map(mass).collect();
                places.of.into_iter().filter_map(|place| masses.get(place).copied()).collect()
            }
        }
    }
}

/// The least mass that a hole feels: the reciprocal of the larger eigenvalue of its 2 × 2 matrix P
/// M⁻¹ Pᵀ; infinite where M has no factor.
fn least_mass(hole: &Hole<'_>, n: usize, mass: Option<&mut Factor>) -> f64 {
    let Some(mass) = mass else { return f64::INFINITY };
    let (y, z) = (&hole.at.y, &hole.at.z);
    let mut response = |row: &Row| {
        let mut x = vec![0.0; n];
        row.add_transposed(1.0, &mut x);
        mass.solve(&mut x);
        [y.dot(&x), z.dot(&x)]
    };
    let ([yy, yz], [_, zz]) = (response(y), response(z));
    1.0 / (0.5 * (yy + zz) + (0.5 * (yy - zz)).hypot(yz))
}

#[cfg(test)]
mod tests {
    use super::super::{Chain, System};

    #[test]
    fn a_slow_motion_beside_a_stiff_spring_is_no_rigid_body_motion() {
        // Two masses of 1 kg with a spring of 1 N/m between them, of which one end is held by 1 N/m
        // and the other by a spring so stiff that its mass stands still: ω² = 2 of the other.
        let chain = |ground: f64| Chain { masses: vec![1.0, 1.0], springs: vec![1.0], grounds: [1.0, ground] };
        for ground in [1e3, 1e8, 1e10, 1e11] {
            let [slowest, fastest] = System::from(chain(ground).structure().unwrap()).frequencies();
            // The stiff mass gives way by 1/ground; K rounds to 1e-16 of ground.
            let allowed = 1.0 / ground + 1e-14 * ground;
            assert!((slowest * slowest / 2.0 - 1.0).abs() < allowed, "{ground}: {slowest}");
            assert!((fastest * fastest / ground - 1.0).abs() < 2.0 / ground, "{ground}: {fastest}");
        }
        let free = Chain { grounds: [0.0, 0.0], ..chain(1.0) };
        assert_eq!(System::from(free.structure().unwrap()).frequencies()[0], 0.0);
    }
}
