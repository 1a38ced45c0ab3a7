//! Saltation matrices: the map from a small change of the state just before an event to that just
//! after it.
//!
//! x = (q, q̇) with n degrees of freedom. A wall's row is G, d = M⁻¹Gᵀ/(G M⁻¹Gᵀ), P = I − dG and
//! R = I − (1 + e)dG; v = G q̇⁻ is the speed just before, a⁻ and a⁺ are the accelerations just
//! before and after. In blocks of (q, q̇):
//!
//! | event | S |
//! |---|---|
//! | impact | [[R, 0], [(a⁺ − R a⁻)G/v, R]] |
//! | coming to rest: e = 0 under pressure, or the closed tail of an accumulation of impacts | [[P, 0], [P M⁻¹C d G, P]] |
//! | release of a held row | I: its reaction is 0 there, so the acceleration is continuous |
//! | entering an elastic wall with dashpot c_a | [[I, 0], [−c_a M⁻¹GᵀG, I]] |
//! | end of the push, return to the surface, push again | I: the force is continuous |
//! | blow, row of a table | I: at a fixed time |
//! | several coupled rows struck at one instant | does not exist: [`NoDerivative::Together`](super::NoDerivative::Together) |
//!
//! The first follows from S = J + (f⁺ − J f⁻)nᵀ/(nᵀf⁻), where J is the derivative of the jump, f⁻
//! and f⁺ are the rates of x before and after, and n = (Gᵀ, 0) (Leine & Nijmeijer 2004,
//! doi:10.1007/978-3-540-44398-8, ch. 7; for impacts Müller 1995,
//! doi:10.1016/0960-0779(94)00170-U). With one degree of freedom its determinant is e²; its corner
//! grows like 1/v, and is infinite at a graze. The second is the same with the accelerations
//! inserted, and does not contain v. R, P and both accelerations must respect the rows that other
//! walls hold.
//!
//! The functions here are those of one degree of freedom; several degrees of freedom are treated by
//! [`Variation`](super::Variation).

/// A matrix that acts on (δq, δq̇), row by row: m and m/s.
pub type Matrix2 = [[f64; 2]; 2];

/// No event.
pub const IDENTITY: Matrix2 = [[1.0, 0.0], [0.0, 1.0]];

/// Coming to rest on a rigid wall: with one degree of freedom a change becomes 0.
pub const REST: Matrix2 = [[0.0, 0.0], [0.0, 0.0]];

/// An impact of `restitution` e at the velocity `before` (m/s, signed, just before the impact),
/// with the accelerations `accelerations` (m/s²) just before and just after:
///
/// S = [[−e, 0], [(a⁺ + e a⁻)/v, −e]].
///
/// Not finite at a velocity of 0, a graze.
///
/// ```
/// let s = signorini::variation::saltation::impact(0.8, 0.1, [-2.0, -1.9]);
/// assert!((s[0][0] * s[1][1] - s[0][1] * s[1][0] - 0.64).abs() < 1e-15);
/// ```
#[must_use]
pub fn impact(restitution: f64, before: f64, accelerations: [f64; 2]) -> Matrix2 {
    let corner = (accelerations[1] + restitution * accelerations[0]) / before;
    [[-restitution, 0.0], [corner, -restitution]]
}

/// Entering an elastic wall with the dashpot `damping` (N s/m), of a body of `mass` (kg):
/// S = [[1, 0], [−c_a/m, 1]].
#[must_use]
pub fn entry(damping: f64, mass: f64) -> Matrix2 {
    [[1.0, 0.0], [-damping / mass, 1.0]]
}

/// `a` after `b`: the matrix product a b.
#[inline]
#[must_use]
pub fn multiply(a: Matrix2, b: Matrix2) -> Matrix2 {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}

/// a x.
#[inline]
#[must_use]
pub fn apply(a: Matrix2, x: [f64; 2]) -> [f64; 2] {
    a.map(|row| row[0] * x[0] + row[1] * x[1])
}
