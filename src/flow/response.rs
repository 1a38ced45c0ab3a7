//! The general solution of q̈ + 2σ q̇ + κ q = φ(τ).

mod states;

use super::divided::divided_exp;
use super::force::{LocalForce, Wave};
use super::roots::{Equation, Roots};
use crate::elementary::{exp, sin_cos};
use nalgebra::Complex;

/// Displacement and its first six time derivatives at one instant: m, m/s, … m/s⁶.
pub(crate) type Jet = [f64; 7];

/// A particular solution to one sine, Im(gain · u(τ)).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    omega: f64,
    /// A/m, m/s², and A/(m D), m, with D = κ − ω² + 2iσω.
    push: f64,
    transfer: Complex<f64>,
    /// |D|, 1/s², and |A/(m D)|, m.
    distance: f64,
    size: f64,
    /// Steady: u = e^{iωτ} and gain = A e^{iθ}/(m D). From rest: u = τ² exp[λ₁τ, λ₂τ, iωτ], gain =
    /// A e^{iθ}/m.
    gain: Complex<f64>,
    steady: bool,
}

impl Part {
    fn new(wave: &Wave, equation: &Equation) -> Self {
        let Equation { sigma, kappa, of: [mass, ..], .. } = *equation;
        let (omega, push) = (wave.omega, wave.amplitude / mass);
        let d = Complex::new(kappa - omega * omega, 2.0 * sigma * omega);
        let (transfer, distance) = (push / d, size_of(d));
        Self { omega, push, transfer, distance, size: size_of(transfer), gain: transfer, steady: true }
    }
}

/// q(τ) from a state at τ = 0: free motion plus one particular solution per piece of the load.
///
/// A piece of the load contributes its steady solution (one sine and cosine to evaluate) where that
/// is not much larger than the motion, and otherwise its response from rest by divided differences,
/// which is never larger than the motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Response {
    /// Kept from arc to arc while the same walls touch.
    pub equation: Equation,
    /// Free motion. Pair: Re(Z e^{λτ}). Real: re e^{slow τ} + im S(τ), S the impulse response.
    free: Complex<f64>,
    /// Steady solution p₀ + p₁τ of the constant and ramp, m and m/s; zero where they enter from
    /// rest.
    line: [f64; 2],
    /// The constant and ramp that contribute by their response from rest, m/s² and m/s³; and
    /// whether they do.
    rest: [f64; 2],
    ramped: bool,
    parts: Vec<Part>,
    /// True if a sine contributes by its response from rest.
    resonant: bool,
    /// Σ of the sizes of the terms at τ = 0: displacement (m) and velocity (m/s). The motion has
    /// their rounding error.
    pub size: [f64; 2],
    /// Σ (ω² + κ)|P| over the steady sines, m/s²: where it exceeds force over mass, it determines
    /// the rounding error of the acceleration.
    pub steady: f64,
    /// An interval that the motion does not leave within the span, m; infinite where no bound is
    /// known.
    pub extent: [f64; 2],
}

/// A steady solution up to this many times the scene's own length is accepted: its rounding then
/// costs at most four bits.
const STEADY_SIZE: f64 = 16.0;

/// A steady solution is also accepted where the arc is so long that the response from rest reaches
/// this share of it.
const STEADY_SHARE: f64 = 0.25;

impl Response {
    /// The response of mass (kg), damping c (N s/m) and stiffness k (N/m) to `force`, from rest.
    pub fn new(of: [f64; 3], force: &LocalForce) -> Self {
        let equation = Equation::new(of);
        Self {
            equation,
            free: Complex::new(0.0, 0.0),
            line: [0.0; 2],
            rest: [0.0; 2],
            ramped: false,
            parts: force.waves.iter().map(|wave| Part::new(wave, &equation)).collect(),
            resonant: false,
            size: [0.0; 2],
            steady: 0.0,
            extent: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Solves for mass (kg), damping c (N s/m) and stiffness k (N/m) under `force`, whose sines are
    /// those that the response was made for, from the state (`q`, `v`). `span` (s) is the length of
    /// the arc, `length` (m) a typical displacement of the scene.
    pub fn set(&mut self, of: [f64; 3], force: &LocalForce, [q, v]: [f64; 2], span: f64, length: f64) {
        if self.equation.of != of {
            self.equation = Equation::new(of);
            for (part, wave) in self.parts.iter_mut().zip(&force.waves) {
                *part = Part::new(wave, &self.equation);
            }
        }
        let Equation { sigma, kappa, .. } = self.equation;
        let length = length.max(q.abs());
        // From rest, a load of acceleration φ and circular frequency ω moves the body by about φ
        // min(τ², τ/(ω + √κ + σ)); the steady motion is φ/|D|.
        let natural = self.equation.natural + sigma;
        let steady = |amplitude: f64, d: f64, omega: f64| {
            amplitude <= STEADY_SIZE * length * d || d * (span.min(1.0 / (omega + natural)) * span) >= STEADY_SHARE
        };
        let (mut x, mut dx) = (q, v);
        self.size = [q.abs(), v.abs()];
        (self.line, self.rest, self.ramped) = ([0.0; 2], [0.0; 2], false);
        if force.constant != 0.0 || force.slope != 0.0 {
            let (phi, ramp) = (force.constant / of[0], force.slope / of[0]);
            if kappa > 0.0 && steady(phi.abs() + ramp.abs() * (span + 2.0 * sigma / kappa), kappa, 0.0) {
                let p1 = ramp / kappa;
                self.line = [(phi - 2.0 * sigma * p1) / kappa, p1];
                x -= self.line[0];
                dx -= p1;
                self.size[0] += self.line[0].abs();
                self.size[1] += p1.abs();
            } else {
                (self.rest, self.ramped) = ([phi, ramp], true);
            }
        }
        self.steady = 0.0;
        self.resonant = false;
        for (part, wave) in self.parts.iter_mut().zip(&force.waves) {
            let (w, turn) = (part.omega, Complex::new(wave.cos, wave.sin));
            part.steady = steady(part.push.abs(), part.distance, w);
            if part.steady {
                part.gain = part.transfer * turn;
                x -= part.gain.im;
                dx -= w * part.gain.re;
                self.size[0] += part.size;
                self.size[1] += part.size * w;
                self.steady += part.size * (w * w + kappa);
            } else {
                part.gain = turn * part.push;
                self.resonant = true;
            }
        }
        self.free = match self.equation.roots {
            Roots::Pair { omega, .. } => Complex::new(x, -(dx + sigma * x) / omega),
            Roots::Real { slow, .. } => Complex::new(x, dx - slow * x),
        };
        self.bound_extent(span);
    }

    /// √κ of a body that oscillates, rad/s; 0 for one that is critically or more damped.
    pub fn oscillation(&self) -> f64 {
        if matches!(self.equation.roots, Roots::Pair { .. }) { self.equation.natural } else { 0.0 }
    }

    /// Bounds the motion by the sizes of its terms.
    fn bound_extent(&mut self, span: f64) {
        if self.resonant || self.ramped {
            self.extent = [f64::NEG_INFINITY, f64::INFINITY];
            return;
        }
        let reach = self.swing(span);
        let ends = [self.line[0], self.line[0] + self.line[1] * span];
        self.extent = [ends[0].min(ends[1]) - reach, ends[0].max(ends[1]) + reach];
    }

    /// The sizes of free motion and sines over `span` (s), m.
    fn swing(&self, span: f64) -> f64 {
        let free = match self.equation.roots {
            Roots::Pair { .. } => size_of(self.free),
            Roots::Real { .. } => self.free.re.abs() + self.free.im.abs() * self.equation.longest.min(span),
        };
        free + self.parts.iter().map(|part| part.size).sum::<f64>()
    }

    /// An interval that the motion does not leave at any time, m; `None` where no bound is known.
    pub fn reach_for_ever(&self) -> Option<[f64; 2]> {
        if self.resonant || self.ramped || self.line[1] != 0.0 {
            return None;
        }
        let reach = self.swing(f64::INFINITY);
        Some([self.line[0] - reach, self.line[0] + reach])
    }

    /// The displacement and its first six derivatives at `tau` ≥ 0.
    #[inline]
    pub fn jet(&self, tau: f64) -> Jet {
        self.motion(tau)
    }

    /// The displacement and the velocity at `tau` ≥ 0.
    #[inline]
    pub fn state(&self, tau: f64) -> [f64; 2] {
        self.motion(tau)
    }

    /// The displacement and its first derivatives at `tau`: two values to seven.
    #[inline(always)]
    fn motion<const N: usize>(&self, tau: f64) -> [f64; N] {
        let mut x = self.free_motion(tau);
        x[0] += self.line[0] + self.line[1] * tau;
        x[1] += self.line[1];
        for part in self.parts.iter().filter(|part| part.steady) {
            let (g, w) = (part.gain, part.omega);
            let (s, c) = sin_cos(w * tau);
            let (mut even, mut odd) = (g.re * s + g.im * c, w * (g.re * c - g.im * s));
            for (n, x) in x.iter_mut().enumerate() {
                let next = if n % 2 == 0 { &mut even } else { &mut odd };
                *x += *next;
                *next *= -w * w;
            }
        }
        if self.resonant || self.ramped {
            x.iter_mut().zip(self.rest_response(tau)).for_each(|(x, y)| *x += y);
        }
        x
    }

    /// Free motion.
    #[inline(always)]
    fn free_motion<const N: usize>(&self, tau: f64) -> [f64; N] {
        match &self.equation.roots {
            Roots::Pair { omega, powers } => {
                let decay = exp(-self.equation.sigma * tau);
                let (s, c) = sin_cos(omega * tau);
                let z = self.free * Complex::new(decay * c, decay * s);
                // Each derivative from z itself: a chain of products would make every one wait.
                let mut x = [z.re; N];
                for (x, power) in x[1..].iter_mut().zip(powers) {
                    *x = power.re * z.re - power.im * z.im;
                }
                x
            }
            Roots::Real { slow, .. } => {
                let (impulse, mut power) = (self.impulse(tau), self.free.re * (slow * tau).exp());
                std::array::from_fn(|n| {
                    let x = power + self.free.im * impulse[n];
                    power *= slow;
                    x
                })
            }
        }
    }

    /// S and its derivatives.
    #[inline(never)]
    fn impulse(&self, tau: f64) -> Jet {
        let Equation { sigma, kappa, roots, .. } = self.equation;
        let mut impulse = Jet::default();
        match roots {
            Roots::Pair { omega, .. } => {
                let decay = exp(-sigma * tau);
                let (s, c) = sin_cos(omega * tau);
                impulse[0] = decay * s / omega;
                impulse[1] = decay * c - sigma * impulse[0];
                for n in 2..impulse.len() {
                    impulse[n] = -2.0 * sigma * impulse[n - 1] - kappa * impulse[n - 2];
                }
            }
            Roots::Real { slow, fast } => {
                let (gap, lasting) = (slow - fast, (slow * tau).exp());
                let mut fading = (fast * tau).exp();
                let spread = gap * tau;
                // S = (e^{slow τ} − e^{fast τ})/(slow − fast), and S⁽ⁿ⁺¹⁾ = slow S⁽ⁿ⁾ + fastⁿ
                // e^{fast τ}.
                impulse[0] = lasting * if spread == 0.0 { tau } else { -(-spread).exp_m1() / gap };
                for n in 1..impulse.len() {
                    impulse[n] = slow * impulse[n - 1] + fading;
                    fading *= fast;
                }
            }
        }
        impulse
    }

    /// λ₁τ and λ₂τ.
    fn nodes(&self, tau: f64) -> [Complex<f64>; 2] {
        match self.equation.roots {
            Roots::Pair { powers: [root, ..], .. } => {
                let z = root * tau;
                [z, z.conj()]
            }
            Roots::Real { slow, fast } => [Complex::new(slow * tau, 0.0), Complex::new(fast * tau, 0.0)],
        }
    }

    /// The responses from rest: to the constant and the ramp, whose ∬S and ∭S are τ² exp[λ₁τ, λ₂τ,
    /// 0] and τ³ exp[λ₁τ, λ₂τ, 0, 0], and to sines.
    #[inline(never)]
    fn rest_response(&self, tau: f64) -> Jet {
        let (impulse, mut x) = (self.impulse(tau), Jet::default());
        let [phi, ramp] = self.rest;
        let ([a, b], zero) = (self.nodes(tau), Complex::new(0.0, 0.0));
        if self.ramped {
            let step = tau * tau * divided_exp([a, b, zero]).re;
            x[0] += phi * step;
            for n in 0..x.len() - 1 {
                x[n + 1] += phi * impulse[n];
            }
            if ramp != 0.0 {
                x[0] += ramp * tau.powi(3) * divided_exp([a, b, zero, zero]).re;
                x[1] += ramp * step;
                for n in 0..x.len() - 2 {
                    x[n + 2] += ramp * impulse[n];
                }
            }
        }
        for part in self.parts.iter().filter(|part| !part.steady) {
            // u′ = iω u + S, differentiated again and again.
            let w = part.omega;
            let mut u = divided_exp([a, b, Complex::new(0.0, w * tau)]) * (tau * tau);
            for (x, s) in x.iter_mut().zip(&impulse) {
                *x += (part.gain * u).im;
                u = Complex::new(-w * u.im + s, w * u.re);
            }
        }
        x
    }
}

/// |z| without the guard of `hypot` against overflow, which these sizes do not need.
#[inline]
fn size_of(z: Complex<f64>) -> f64 {
    z.norm_sqr().sqrt()
}
