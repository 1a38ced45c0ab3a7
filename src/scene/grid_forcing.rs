//! The loads on one degree of freedom at the instants of a grid.

use super::forcing::{Forcing, Harmonic};

/// Steps after which a sine is computed anew: 64 rotations accumulate an error of at most 1e-14 of
/// its amplitude, and one libm sine in 64 steps has no measurable cost.
const RESTART: u64 = 64;

/// One sine A sin(ωt + φ) at the instants t = kh. From one instant to the next its phase advances
/// by ωh, which is a rotation (a complex product); computing the sine would cost more than all else
/// in a step of one degree of freedom.
#[derive(Debug, Clone, Copy)]
struct Phasor {
    amplitude: f64,
    omega: f64,
    phase: f64,
    /// sin and cos of ωh, and of ωt + φ at the last instant.
    turn: [f64; 2],
    now: [f64; 2],
}

impl Phasor {
    fn turn(&mut self) {
        let ([s, c], [turn_s, turn_c]) = (self.now, self.turn);
        self.now = [s * turn_c + c * turn_s, c * turn_c - s * turn_s];
    }

    fn set(&mut self, t: f64) {
        let (s, c) = (self.omega * t + self.phase).sin_cos();
        self.now = [s, c];
    }
}

/// All loads on one degree of freedom, without the blows, for a scheme that evaluates them at the
/// instants t = kh in order.
#[derive(Debug, Clone)]
pub(crate) struct GridForcing {
    forcing: Forcing,
    h: f64,
    phasors: Vec<Phasor>,
    /// True if there are tables or functions.
    others: bool,
    /// The index k of the instant that is expected next.
    next: u64,
}

impl GridForcing {
    /// `forcing` at multiples of `h` (s).
    pub fn new(forcing: Forcing, h: f64) -> Self {
        let phasor = |wave: &Harmonic| {
            let (s, c) = (wave.omega * h).sin_cos();
            let Harmonic { amplitude, omega, phase } = *wave;
            Phasor { amplitude, omega, phase, turn: [s, c], now: [0.0, 1.0] }
        };
        Self {
            phasors: forcing.harmonics.iter().map(phasor).collect(),
            others: !(forcing.tables.is_empty() && forcing.functions.is_empty()),
            forcing,
            h,
            next: 0,
        }
    }

    /// Force at `t` (s), N. At the instant that follows the last one, the sines are rotated; at any
    /// other instant they are computed anew.
    #[inline]
    pub fn at(&mut self, t: f64) -> f64 {
        if t == self.next as f64 * self.h && !self.next.is_multiple_of(RESTART) {
            self.next += 1;
            self.phasors.iter_mut().for_each(Phasor::turn);
        } else {
            self.set(t);
        }
        let mut force = self.forcing.constant;
        for phasor in &self.phasors {
            force += phasor.amplitude * phasor.now[0];
        }
        if self.others { force + self.forcing.irregular(t) } else { force }
    }

    #[inline(never)]
    fn set(&mut self, t: f64) {
        self.next = (t / self.h).round() as u64 + 1;
        self.phasors.iter_mut().for_each(|phasor| phasor.set(t));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Load, Table};

    #[test]
    fn sines_that_turn_are_those_of_the_library() {
        let loads = [
            Load::constant(0.7),
            Load::harmonic(3.0, 5.0, 0.4),
            Load::harmonic(-2.0, 61.7, 1.0),
            Load::table(Table::new(vec![0.0, 0.5, 2.0], vec![0.0, 4.0, 1.0]).expect("a table")),
        ];
        let forcing = Forcing::on(0, &loads);
        for h in [1e-5, 1e-3, 0.037] {
            let mut grid = GridForcing::new(forcing.clone(), h);
            // In order, then at a much earlier instant, then far ahead.
            for index in (0..2000).chain([3, 4, 5, 1_000_000, 1_000_001]) {
                let t = f64::from(index) * h;
                let error = (grid.at(t) - forcing.force(t)).abs();
                // 64 rotations, each with some ulps of amplitudes 3 and 2; and ωh·k of the rotation
                // instead of ωt, an ulp of the phase.
                let phase = 61.7 * 6.3 * t * f64::EPSILON;
                assert!(error < 5.0 * (64.0 * 2.0 * f64::EPSILON + 2.0 * phase), "{h} {index}: {error:e}");
            }
            let between = 7.3 * h;
            assert_eq!(grid.at(between), forcing.force(between));
        }
    }
}
