//! One disk alone, in closed form.
//!
//! The multiplier μ of |(I + μW)⁻¹z_f| = γ, where z_f, outside of the disk, is what the other
//! blocks leave. In two dimensions adj(I + μW) = I + μ adj(W), so no eigenvalues are needed:
//!
//! z(μ) = (z_f + μg)/(1 + tμ + dμ²),   t = tr W,   d = det W,   g = adj(W) z_f.
//!
//! Newton's method on 1/|z| (Moré & Sorensen 1983, doi:10.1137/0904038), whose graph is concave,
//! climbs from μ₀ = (|z_f|/γ − 1)/λ_max without passing the root; for W = wI μ₀ is the root.

use super::{dot, norm};

/// Most steps of Newton's method: it takes 14 at a condition of 1e6.
const MOST_STEPS: u32 = 60;

/// μ ≥ 0 of the disk of this radius γ for W = [[a, b], [b, c]], and z_f at |z_f| > γ. Infinite, or
/// without |z| = γ, where W is singular and z_f cannot be moved into the disk.
pub(super) fn multiplier([a, b, c]: [f64; 3], free: [f64; 2], radius: f64) -> f64 {
    let (trace, det) = (a + c, (a * c - b * b).max(0.0));
    let adjugate = [c * free[0] - b * free[1], a * free[1] - b * free[0]];
    let largest = 0.5 * trace + (0.5 * (a - c)).hypot(b);
    let mut mu = (norm(free) / radius - 1.0) / largest;
    for _ in 0..MOST_STEPS {
        let below = 1.0 + mu * (trace + mu * det);
        let z = [0, 1].map(|i: usize| (free[i] + mu * adjugate[i]) / below);
        let size = norm(z);
        let pull = [a * z[0] + b * z[1], b * z[0] + c * z[1]];
        let slope = (dot(z, pull) + mu * det * size * size) / below;
        let next = mu + size * size * (size / radius - 1.0) / slope;
        // A relative test would go on for ever where z_f is outside by a rounding.
        if next.is_nan() || next <= mu {
            break;
        }
        mu = next;
    }
    mu
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit};

    #[test]
    fn the_disk_is_met_to_rounding_whatever_its_compliance() {
        let mut worst = 0.0_f64;
        for case in 0..100_000_u64 {
            let draw = |k: u64| unit(mix(7, case, k));
            let (turn, stretch) = (6.3 * draw(0), 10_f64.powf(-6.0 * draw(1)));
            let ([cos, sin], size) = ([turn.cos(), turn.sin()], 10_f64.powf(8.0 * draw(2) - 4.0));
            // Eigenvalues `size` and `size · stretch`.
            let w = [
                size * (cos * cos + stretch * sin * sin),
                size * cos * sin * (1.0 - stretch),
                size * (sin * sin + stretch * cos * cos),
            ];
            let (radius, angle) = (10_f64.powf(6.0 * draw(3) - 3.0), 6.3 * draw(4));
            let beyond = 1.0 + 10_f64.powf(16.0 * draw(5) - 14.0);
            let free = [radius * beyond * angle.cos(), radius * beyond * angle.sin()];
            let mu = multiplier(w, free, radius);
            // In the eigenvectors: z = z_f/(1 + μλ) without cancellation.
            let along = (cos * free[0] + sin * free[1]) / (1.0 + mu * size);
            let across = (cos * free[1] - sin * free[0]) / (1.0 + mu * size * stretch);
            worst = worst.max((along.hypot(across) / radius - 1.0).abs());
            assert!(mu > 0.0, "case {case}: {mu}");
        }
        // Eigenvalues come out of the entries of W with a part in 1e16 of the larger one, which is
        // up to 1e6 of the smaller.
        assert!(worst < 1e-9, "{worst:e}");
    }

    #[test]
    fn a_round_compliance_needs_no_iteration() {
        let mu = multiplier([2.0, 0.0, 2.0], [3.0, 4.0], 2.0);
        // z = z_f/(1 + 2μ) with |z_f| = 5: 2μ = 3/2.
        assert!((mu - 0.75).abs() < 1e-15, "{mu}");
    }
}
