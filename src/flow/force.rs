//! The load over one arc, as a function of the time since its start.

use crate::elementary::sin_cos;
use crate::scene::{Forcing, Harmonic};

/// One sine, A sin(ω τ + θ), with θ its phase at the arc's start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    /// A, N.
    pub amplitude: f64,
    /// ω, rad/s; above 0.
    pub omega: f64,
    /// Its phase at the time 0, rad.
    phase: f64,
    /// sin θ and cos θ.
    pub sin: f64,
    /// See `sin`.
    pub cos: f64,
}

/// f(τ) = f₀ + f₁ τ + Σ A sin(ωτ + θ), N, where τ is the time since the arc's start (s).
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct LocalForce {
    /// f₀, N.
    pub constant: f64,
    /// f₁, N/s.
    pub slope: f64,
    /// The sines.
    pub waves: Vec<Wave>,
    /// Bounds on |f″|, |f‴| … |f⁽⁶⁾|, N/s² and so on.
    pub bounds: [f64; 5],
    /// Σ|A|, N, and Σ|A|ω, N/s.
    sizes: [f64; 2],
    /// The largest ω, rad/s; 0 without sines.
    pub fastest: f64,
    /// The part of f₀ that does not depend on the arc, N.
    lasting: f64,
}

impl LocalForce {
    /// The loads of `forcing`, to be [set](Self::set) to an instant.
    pub fn new(forcing: &Forcing) -> Self {
        let mut force = Self { lasting: forcing.constant, ..Self::default() };
        for &Harmonic { amplitude, omega, phase } in &forcing.harmonics {
            if omega == 0.0 || amplitude == 0.0 {
                force.lasting += amplitude * phase.sin();
                continue;
            }
            force.waves.push(Wave { amplitude, omega, phase, sin: 0.0, cos: 1.0 });
            let mut size = amplitude.abs();
            for sum in force.sizes.iter_mut().chain(&mut force.bounds) {
                *sum += size;
                size *= omega;
            }
            force.fastest = force.fastest.max(omega);
        }
        force
    }

    /// Sets the loads to their values just after `start` + `late`, plus the constant force `extra`
    /// (N); valid up to the next row of a table of `forcing`. `late` is the rounding error of the
    /// time `start`.
    pub fn set(&mut self, forcing: &Forcing, [start, late]: [f64; 2], extra: f64) {
        (self.constant, self.slope) = (self.lasting + extra, 0.0);
        for table in &forcing.tables {
            let (value, slope) = table.piece(start);
            self.constant += value + slope * late;
            self.slope += slope;
        }
        for w in &mut self.waves {
            (w.sin, w.cos) = sin_cos(w.omega * start + w.phase + w.omega * late);
        }
    }

    /// f, f′, f″, f‴ at `tau`.
    pub fn jet(&self, tau: f64) -> [f64; 4] {
        let mut f = [self.constant + self.slope * tau, self.slope, 0.0, 0.0];
        for w in &self.waves {
            let (s, c) = sin_cos(w.omega * tau);
            let (sin, cos) = (w.amplitude * (w.sin * c + w.cos * s), w.amplitude * (w.cos * c - w.sin * s));
            f[0] += sin;
            f[1] += w.omega * cos;
            f[2] -= w.omega * w.omega * sin;
            f[3] -= w.omega * w.omega * w.omega * cos;
        }
        f
    }

    /// f, f′ … f⁗ at the arc's start.
    #[inline]
    pub fn start(&self) -> [f64; 5] {
        let mut f = [self.constant, self.slope, 0.0, 0.0, 0.0];
        for w in &self.waves {
            let (mut sin, mut cos) = (w.amplitude * w.sin, w.amplitude * w.cos);
            for f in &mut f {
                *f += sin;
                (sin, cos) = (w.omega * cos, -w.omega * sin);
            }
        }
        f
    }

    /// A bound on |f(τ) − f(0)| for τ up to `span` (s), N.
    pub fn variation(&self, span: f64) -> f64 {
        self.slope.abs() * span + 2.0 * self.sizes[0]
    }

    /// ∫ f over [from, to], N s. For a sine it is A Δ sin(ω mid + θ) sinc(ωΔ/2), which stays
    /// accurate as ω → 0.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let (span, mid) = (to - from, 0.5 * (from + to));
        let mut sum = (self.constant + self.slope * mid) * span;
        for w in &self.waves {
            let (s, c) = sin_cos(w.omega * mid);
            let half = 0.5 * w.omega * span;
            let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
            sum += w.amplitude * span * (w.sin * c + w.cos * s) * sinc;
        }
        sum
    }

    /// |f₀| + |f₁| `span` + Σ|A|: a bound on |f|, N.
    pub fn size(&self, span: f64) -> f64 {
        self.constant.abs() + self.slope.abs() * span + self.sizes[0]
    }

    /// |f₁| + Σ|A|ω: a bound on |f′|, N/s.
    pub fn rate_size(&self) -> f64 {
        self.slope.abs() + self.sizes[1]
    }
}
