//! The general solution of q̈ + 2σ q̇ + κ q = φ(τ).

use super::divided::divided_exp;
use super::elementary::{exp, sin_cos};
use super::force::LocalForce;
use super::roots::{Equation, Roots};
use nalgebra::Complex;

/// Displacement and its first four time derivatives at one instant: m, m/s, … m/s⁴.
pub(crate) type Jet = [f64; 5];

/// A particular solution to one sine, Im(gain · u(τ)).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    omega: f64,
    /// Steady: u = e^{iωτ} and gain = A e^{iθ}/(m D), D = κ − ω² + 2iσω. From rest: u = τ² exp[λ₁τ,
    /// λ₂τ, iωτ], gain = A e^{iθ}/m.
    gain: Complex<f64>,
    steady: bool,
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
    /// The constant and ramp that contribute by their response from rest, m/s² and m/s³.
    rest: [f64; 2],
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

impl Default for Response {
    fn default() -> Self {
        Self {
            equation: Equation::new([1.0, 0.0, 0.0]),
            free: Complex::new(0.0, 0.0),
            line: [0.0; 2],
            rest: [0.0; 2],
            parts: Vec::new(),
            resonant: false,
            size: [0.0; 2],
            steady: 0.0,
            extent: [f64::NEG_INFINITY, f64::INFINITY],
        }
    }
}

impl Response {
    /// A response with room for `waves` sines.
    pub fn with_room(waves: usize) -> Self {
        Self { parts: Vec::with_capacity(waves), ..Self::default() }
    }

    /// Solves for mass (kg), damping c (N s/m) and stiffness k (N/m) under `force` from the state
    /// (`q`, `v`). `span` (s) is the length of the arc, `length` (m) a typical displacement of the
    /// scene.
    pub fn set(&mut self, [mass, c, k]: [f64; 3], force: &LocalForce, [q, v]: [f64; 2], span: f64, length: f64) {
        if self.equation.of != [mass, c, k] {
            self.equation = Equation::new([mass, c, k]);
        }
        let Equation { sigma, kappa, .. } = self.equation;
        let length = length.max(q.abs());
        // From rest, a load of acceleration φ and circular frequency ω moves the body by about φ
        // min(τ², τ/(ω + √κ + σ)); the steady motion is φ/|D|.
        let natural = self.equation.natural + sigma;
        let steady = |amplitude: f64, d: f64, omega: f64| {
            let reached = span.min(1.0 / (omega + natural)) * span;
            amplitude <= STEADY_SIZE * length * d || d * reached >= STEADY_SHARE
        };
        let (mut x, mut dx) = (q, v);
        self.size = [q.abs(), v.abs()];
        let (phi, ramp) = (force.constant / mass, force.slope / mass);
        if kappa > 0.0 && steady(phi.abs() + ramp.abs() * (span + 2.0 * sigma / kappa), kappa, 0.0) {
            let p1 = ramp / kappa;
            self.line = [(phi - 2.0 * sigma * p1) / kappa, p1];
            self.rest = [0.0; 2];
            x -= self.line[0];
            dx -= p1;
            self.size[0] += self.line[0].abs();
            self.size[1] += p1.abs();
        } else {
            self.line = [0.0; 2];
            self.rest = [phi, ramp];
        }
        self.parts.clear();
        self.steady = 0.0;
        for w in &force.waves {
            let gain = Complex::new(w.cos, w.sin) * (w.amplitude / mass);
            let d = Complex::new(kappa - w.omega * w.omega, 2.0 * sigma * w.omega);
            let is_steady = steady(size_of(gain), size_of(d), w.omega);
            let gain = if is_steady { gain / d } else { gain };
            if is_steady {
                x -= gain.im;
                dx -= w.omega * gain.re;
                let size = size_of(gain);
                self.size[0] += size;
                self.size[1] += size * w.omega;
                self.steady += size * (w.omega * w.omega + kappa);
            }
            self.parts.push(Part { omega: w.omega, gain, steady: is_steady });
        }
        self.resonant = self.parts.iter().any(|p| !p.steady);
        self.free = match self.equation.roots {
            Roots::Pair { omega, .. } => Complex::new(x, -(dx + sigma * x) / omega),
            Roots::Real { slow, .. } => Complex::new(x, dx - slow * x),
        };
        self.bound_extent(span);
    }

    /// √κ of a body that oscillates, rad/s; 0 of one that is critically or more damped.
    pub fn oscillation(&self) -> f64 {
        if matches!(self.equation.roots, Roots::Pair { .. }) { self.equation.natural } else { 0.0 }
    }

    /// Bounds the motion by the sizes of its terms.
    fn bound_extent(&mut self, span: f64) {
        if self.resonant || self.rest != [0.0; 2] {
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
        free + self.parts.iter().map(|p| size_of(p.gain)).sum::<f64>()
    }

    /// An interval that the motion does not leave at any time, m; `None` where no bound is known.
    pub fn reach_for_ever(&self) -> Option<[f64; 2]> {
        if self.resonant || self.rest != [0.0; 2] || self.line[1] != 0.0 {
            return None;
        }
        let reach = self.swing(f64::INFINITY);
        Some([self.line[0] - reach, self.line[0] + reach])
    }

    /// The displacement and its first four derivatives at `tau` ≥ 0.
    #[inline]
    pub fn jet(&self, tau: f64) -> Jet {
        let (mut x, impulse) = self.free_jet(tau);
        x[0] += self.line[0] + self.line[1] * tau;
        x[1] += self.line[1];
        if self.rest != [0.0; 2] {
            self.add_rest(tau, &impulse, &mut x);
        }
        for part in &self.parts {
            let w = part.omega;
            if part.steady {
                let (s, c) = sin_cos(w * tau);
                let (g, w2) = (part.gain, w * w);
                let (im, re) = (g.re * s + g.im * c, g.re * c - g.im * s);
                x[0] += im;
                x[1] += w * re;
                x[2] -= w2 * im;
                x[3] -= w2 * w * re;
                x[4] += w2 * w2 * im;
            } else {
                // u′ = iω u + S, differentiated again and again.
                let [a, b] = self.nodes(tau);
                let mut u = divided_exp([a, b, Complex::new(0.0, w * tau)]) * (tau * tau);
                for (x, s) in x.iter_mut().zip(&impulse) {
                    *x += (part.gain * u).im;
                    u = Complex::new(-w * u.im + s, w * u.re);
                }
            }
        }
        x
    }

    /// Free motion, and S with its derivatives (not computed where no piece of the load responds
    /// from rest).
    #[inline]
    fn free_jet(&self, tau: f64) -> (Jet, Jet) {
        let wanted = self.resonant || self.rest != [0.0; 2];
        let mut impulse = [0.0; 5];
        match self.equation.roots {
            Roots::Pair { omega, powers } => {
                let Equation { sigma, kappa, .. } = self.equation;
                let decay = exp(-sigma * tau);
                let (s, c) = sin_cos(omega * tau);
                let z = self.free * Complex::new(decay * c, decay * s);
                // Each derivative from z itself: a chain of products would make every one wait.
                let [v, a, jerk, snap] = powers.map(|power| power.re * z.re - power.im * z.im);
                let x = [z.re, v, a, jerk, snap];
                if wanted {
                    impulse[0] = decay * s / omega;
                    impulse[1] = decay * c - sigma * impulse[0];
                    for n in 2..5 {
                        impulse[n] = -2.0 * sigma * impulse[n - 1] - kappa * impulse[n - 2];
                    }
                }
                (x, impulse)
            }
            Roots::Real { slow, fast } => {
                let (gap, lasting) = (slow - fast, (slow * tau).exp());
                let mut fading = (fast * tau).exp();
                let spread = gap * tau;
                // S = (e^{slow τ} − e^{fast τ})/(slow − fast), and S⁽ⁿ⁺¹⁾ = slow S⁽ⁿ⁾ + fastⁿ
                // e^{fast τ}.
                impulse[0] = lasting * if spread == 0.0 { tau } else { -(-spread).exp_m1() / gap };
                for n in 1..5 {
                    impulse[n] = slow * impulse[n - 1] + fading;
                    fading *= fast;
                }
                let mut power = self.free.re * lasting;
                let x = impulse.map(|s| {
                    let x = power + self.free.im * s;
                    power *= slow;
                    x
                });
                (x, impulse)
            }
        }
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

    /// Adds the response from rest to the constant and the ramp: ∬S and ∭S are τ² exp[λ₁τ, λ₂τ, 0]
    /// and τ³ exp[λ₁τ, λ₂τ, 0, 0].
    fn add_rest(&self, tau: f64, impulse: &Jet, x: &mut Jet) {
        let [phi, ramp] = self.rest;
        let ([a, b], zero) = (self.nodes(tau), Complex::new(0.0, 0.0));
        let step = tau * tau * divided_exp([a, b, zero]).re;
        x[0] += phi * step;
        for n in 0..4 {
            x[n + 1] += phi * impulse[n];
        }
        if ramp != 0.0 {
            x[0] += ramp * tau.powi(3) * divided_exp([a, b, zero, zero]).re;
            x[1] += ramp * step;
            for n in 0..3 {
                x[n + 2] += ramp * impulse[n];
            }
        }
    }
}

/// |z| without the guard of `hypot` against overflow, which these sizes do not need.
#[inline]
fn size_of(z: Complex<f64>) -> f64 {
    z.norm_sqr().sqrt()
}
