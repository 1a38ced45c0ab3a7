//! The free motion of q̈ + 2σ q̇ + κ q = 0: constants of a body and the walls that touch it.

use nalgebra::Complex;

/// The characteristic roots of λ² + 2σλ + κ = 0, both in the closed left half plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Roots {
    /// λ = −σ ± iω_d.
    Pair {
        /// Damped circular frequency √(κ − σ²), rad/s; above 0.
        omega: f64,
        /// λ, λ² … λ⁶ of the root above the real axis, 1/s and so on.
        powers: [Complex<f64>; 6],
    },
    /// λ = −σ ± δ, both real; the slow one is −κ/(σ + δ), free of cancellation at any damping.
    Real {
        /// The root nearer to 0, 1/s.
        slow: f64,
        /// The other, 1/s.
        fast: f64,
    },
}

/// The constants of the equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Equation {
    /// Mass (kg), damping c (N s/m) and stiffness k (N/m).
    pub of: [f64; 3],
    /// σ = c/2m, 1/s.
    pub sigma: f64,
    /// κ = k/m, 1/s².
    pub kappa: f64,
    /// √κ, rad/s.
    pub natural: f64,
    pub roots: Roots,
    /// The largest |S|, S the impulse response: min(1/√κ, 1/2δ), s; infinite for a free body.
    pub longest: f64,
}

impl Equation {
    /// The constants for mass (kg), damping c (N s/m) and stiffness k (N/m).
    pub fn new([mass, c, k]: [f64; 3]) -> Self {
        let (sigma, kappa) = (0.5 * c / mass, k / mass);
        let natural = kappa.sqrt();
        let excess = sigma * sigma - kappa;
        let mut longest = 1.0 / natural;
        let roots = if excess < 0.0 {
            let root = Complex::new(-sigma, (-excess).sqrt());
            let (square, cube) = (root * root, root * root * root);
            let powers = [root, square, cube, square * square, square * cube, cube * cube];
            Roots::Pair { omega: root.im, powers }
        } else {
            let delta = excess.sqrt();
            longest = longest.min(0.5 / delta);
            let slow = if kappa == 0.0 { 0.0 } else { -kappa / (sigma + delta) };
            Roots::Real { slow, fast: -(sigma + delta) }
        };
        Self { of: [mass, c, k], sigma, kappa, natural, roots, longest }
    }
}
