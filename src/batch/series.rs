//! The constants of a lane, from which its motion over one step follows.
//!
//! Time is measured in steps of d seconds, z = τ/d, and velocity in metres per step, w = q̇ d. Then
//!
//! u″ + αu′ + κu = p + Σ A sin(θz + φ),  α = cd/m, κ = kd²/m, p = f₀d²/m, A ← Ad²/m, θ = ωd.
//!
//! With the impulse response S (S″ + αS′ + κS = 0, S(0) = 0, S′(0) = 1), its integral I, and the
//! responses F, G from rest to cos θz and sin θz, the motion from (u, w) under a sine whose phase
//! now has the sine s and cosine c is
//!
//! u(z) = u + w S(z) + (p − κu) I(z) + A s F(z) + A c G(z).
//!
//! There is no stationary solution in it, and so no special case of resonance, of zero stiffness or
//! of strong damping: all four functions are entire in every parameter. They are computed by their
//! power series; d is chosen so that no rate of the lane advances by more than [`REACH`] radians in
//! a step, and the error after [`ORDER`] terms is then [`REACH`]^17/17! = 7e-18.

use super::lane::Lane;

/// Number of coefficients, of z to z¹⁶: there is no constant term.
pub(super) const ORDER: usize = 16;

/// Maximum angle of the fastest rate in a step, rad.
pub(super) const REACH: f64 = 0.7;

/// Maximum number of steps in a period of the load; beyond it the scheme `event`, whose steps adapt
/// to the motion, is faster.
const MOST_STEPS: f64 = 2048.0;

/// Number of terms of the series from which the constants of a whole step are summed.
const TERMS: usize = 32;

/// Responses to one sine.
#[derive(Debug, Clone)]
pub(super) struct Wave {
    /// A, m per step squared.
    pub amplitude: f64,
    /// θ, rad per step.
    pub theta: f64,
    /// cos θ and sin θ.
    pub turn: [f64; 2],
    /// sin φ and cos φ at the start of every period.
    pub start: [f64; 2],
    /// A F and A G: coefficients of z, z² …
    pub series: [[f64; ORDER]; 2],
    /// A F and A G over a whole step: displacement, velocity.
    pub whole: [[f64; 2]; 2],
}

/// The constants of a lane.
#[derive(Debug, Clone)]
pub(super) struct LaneConstants {
    /// d, s.
    pub step: f64,
    /// Number of steps in a period, not an integer in general.
    pub steps: f64,
    /// α, κ and p.
    pub alpha: f64,
    pub kappa: f64,
    pub push: f64,
    /// |p| + Σ|A|: an upper bound of the load, m per step squared.
    pub load: f64,
    /// S and I: coefficients of z, z² …
    pub impulse: [f64; ORDER],
    pub integral: [f64; ORDER],
    /// S, S′ and I over a whole step.
    pub whole: [f64; 3],
    /// b₀, b₁, b₂ of the bound |u⁗|/288 ≤ b₀ + b₁|w| + b₂|u| over a step from (u, w).
    pub bound: [f64; 3],
    pub waves: Vec<Wave>,
}

impl LaneConstants {
    /// `None` where a period takes too many steps.
    pub fn of(lane: &Lane) -> Option<Self> {
        let (m, period) = (lane.body.mass, lane.period);
        let (sigma, natural) = (0.5 * lane.body.damping / m, lane.body.stiffness / m);
        // A body without frequencies of its own or of a load still takes at least one step per
        // period.
        let steps = (lane.fastest() * period / REACH).max(1.0);
        if steps.is_nan() || steps > MOST_STEPS {
            return None;
        }
        let d = period / steps;
        let (alpha, kappa, unit) = (2.0 * sigma * d, natural * d * d, d * d / m);
        let push = lane.constant * unit;
        let free = response(alpha, kappa, [0.0, 1.0], |_| 0.0);
        let mut integral = [0.0; TERMS];
        for n in 1..TERMS {
            integral[n] = free[n - 1] / n as f64;
        }
        let waves: Vec<Wave> = lane
            .sines
            .iter()
            .map(|sine| Wave::of([alpha, kappa], sine.amplitude * unit, lane.omega(sine) * d, sine.phase))
            .collect();
        let [v, r] = [rate(&free), sum(&integral)];
        Some(Self {
            step: d,
            steps,
            alpha,
            kappa,
            push,
            load: push.abs() + waves.iter().map(|w| w.amplitude.abs()).sum::<f64>(),
            impulse: cut(&free),
            integral: cut(&integral),
            whole: [sum(&free), v, r],
            bound: bound([alpha, kappa], push, lane.sines.iter().map(|s| (s.amplitude * unit, lane.omega(s) * d))),
            waves,
        })
    }
}

impl Wave {
    /// Sine and cosine of its phase `t` steps after a period began.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let ([s, c], [sin, cos]) = (sin_cos(self.theta * t), self.start);
        [sin * c + cos * s, cos * c - sin * s]
    }

    fn of([alpha, kappa]: [f64; 2], amplitude: f64, theta: f64, phase: f64) -> Self {
        // (−1)^{n/2} θⁿ/n! for even n (cosine), the like for odd n (sine).
        let mut powers = [1.0; TERMS];
        for n in 1..TERMS {
            powers[n] = powers[n - 1] * theta / n as f64;
        }
        let wave = |odd: usize| {
            move |n: usize| match n {
                n if n % 2 != odd => 0.0,
                n if (n / 2).is_multiple_of(2) => amplitude * powers[n],
                n => -amplitude * powers[n],
            }
        };
        let both = [0, 1].map(|odd| response(alpha, kappa, [0.0; 2], wave(odd)));
        let [sin, cos] = sin_cos(theta);
        Self {
            amplitude,
            theta,
            turn: [cos, sin],
            start: sin_cos(phase),
            series: both.map(|x| cut(&x)),
            whole: both.map(|x| [sum(&x), rate(&x)]),
        }
    }
}

/// Coefficients of the solution of u″ + αu′ + κu = Σ pₙzⁿ from `start`: (n + 2)(n + 1)uₙ₊₂ = pₙ −
/// α(n + 1)uₙ₊₁ − κuₙ.
fn response(alpha: f64, kappa: f64, start: [f64; 2], push: impl Fn(usize) -> f64) -> [f64; TERMS] {
    let mut u = [0.0; TERMS];
    [u[0], u[1]] = start;
    for n in 0..TERMS - 2 {
        let next = (n + 1) as f64;
        u[n + 2] = (push(n) - alpha * next * u[n + 1] - kappa * u[n]) / (next * (next + 1.0));
    }
    u
}

/// The coefficients of z, z² … that lanes use.
fn cut(u: &[f64; TERMS]) -> [f64; ORDER] {
    std::array::from_fn(|n| u[n + 1])
}

/// Value at z = 1, the small terms first.
fn sum(u: &[f64; TERMS]) -> f64 {
    u.iter().rev().sum()
}

/// Derivative at z = 1.
fn rate(u: &[f64; TERMS]) -> f64 {
    u.iter().enumerate().rev().map(|(n, u)| n as f64 * u).sum()
}

/// A bound on |u⁗|/288 over a step.
///
/// The energy R² = w² + κu² obeys R R′ = w(p + Σ…) − αw² ≤ RΦ₀ with Φₙ the largest |n-th
/// derivative| of the load, so that R ≤ |w| + √κ|u| + Φ₀ within a step. From the equation and its
/// derivatives |u″| ≤ Φ₀ + αR + √κR, |u‴| ≤ Φ₁ + α|u″| + κR and |u⁗| ≤ Φ₂ + α|u‴| + κ|u″|.
fn bound([alpha, kappa]: [f64; 2], push: f64, waves: impl Iterator<Item = (f64, f64)>) -> [f64; 3] {
    let mut load = [push.abs(), 0.0, 0.0];
    for (amplitude, theta) in waves {
        let a = amplitude.abs();
        load = [load[0] + a, load[1] + a * theta, load[2] + a * theta * theta];
    }
    let (root, mixed) = (kappa.sqrt(), alpha * alpha + kappa);
    let of_energy = mixed * (alpha + root) + alpha * kappa;
    let of_load = load[2] + alpha * load[1] + mixed * load[0];
    [of_load + of_energy * load[0], of_energy, of_energy * root].map(|b| b / 288.0)
}

/// sin x/x in x², and cos x: good to rounding for |x| ≤ 0.8.
pub(super) const SINE: [f64; 8] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
];
/// See [`SINE`]; the last two terms are of the size of rounding.
pub(super) const COSINE: [f64; 10] = [
    1.0,
    -0.5,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    -1.0 / 6_402_373_705_728_000.0,
];

/// sin x and cos x by additions and products only, so that they have the same bits on every
/// machine: the system's mathematical library may select its code by processor.
pub(super) fn sin_cos(x: f64) -> [f64; 2] {
    // π/2 in three parts of 33 bits (Cody & Waite): the first two products are exact for a million
    // quarter turns.
    const PARTS: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
    let quarters = (x * std::f64::consts::FRAC_2_PI).round();
    let y = PARTS.iter().fold(x, |x, part| x - quarters * part);
    let square = y * y;
    let value = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * square + c);
    let (sin, cos) = (y * value(&SINE), value(&COSINE));
    match quarters.rem_euclid(4.0) {
        1.0 => [cos, -sin],
        2.0 => [-sin, -cos],
        3.0 => [-cos, sin],
        _ => [sin, cos],
    }
}
