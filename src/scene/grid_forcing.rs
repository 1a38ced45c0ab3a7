//! The loads on one degree of freedom at the instants of a grid.

use super::forcing::{Forcing, Harmonic};

/// Instants after which a sine is computed anew: 32 rotations are off by some ulps of the
/// amplitude, 16 at most, and one libm sine in 32 steps costs little.
const RESTART: u64 = 32;

/// One sine A sin(ωt + φ) at the instants t = kh. From one to the next it turns by ωh, a product of
/// two rotations, where a sine costs more than all else in a step of one degree of freedom.
#[derive(Debug, Clone, Copy)]
struct Phasor {
    wave: Harmonic,
    /// sin ωh and 1 − cos ωh = 2 sin²(ωh/2): with the latter a rotation adds small numbers to large
    /// ones, and rounds once.
    turn: [f64; 2],
    /// sin and cos of ωt + φ at the last instant.
    now: [f64; 2],
}

impl Phasor {
    #[inline]
    fn turn(&mut self) {
        let ([s, c], [sin, versin]) = (self.now, self.turn);
        self.now = [s + (c * sin - s * versin), c - (s * sin + c * versin)];
    }

    fn set(&mut self, t: f64) {
        let (s, c) = (self.wave.omega * t + self.wave.phase).sin_cos();
        self.now = [s, c];
    }
}

/// All loads on one degree of freedom, without the blows, for a scheme that asks at the instants t
/// = kh one after another. The force depends on the instant only: a motion that is continued from a
/// saved state gets the same loads to the last bit.
#[derive(Debug, Clone)]
pub(crate) struct GridForcing {
    forcing: Forcing,
    h: f64,
    phasors: Vec<Phasor>,
    /// True if there are tables or functions.
    others: bool,
    /// The number k of the instant that is expected next.
    next: u64,
}

impl GridForcing {
    /// `forcing` at multiples of `h` (s).
    pub fn new(forcing: Forcing, h: f64) -> Self {
        let phasor = |wave: &Harmonic| {
            let angle = wave.omega * h;
            let turn = [angle.sin(), 2.0 * (0.5 * angle).sin().powi(2)];
            Phasor { wave: *wave, turn, now: [0.0, 1.0] }
        };
        Self {
            phasors: forcing.harmonics.iter().map(phasor).collect(),
            others: !(forcing.tables.is_empty() && forcing.functions.is_empty()),
            forcing,
            h,
            next: 0,
        }
    }

    /// Writes the forces at several `times` (s), N, wherever these lie.
    pub fn forces(&self, times: &[f64], out: &mut [f64]) {
        self.forcing.forces(times, out);
    }

    /// Force at `t` (s), N. At the instant after the last one asked for, the sines turn on.
    #[inline]
    pub fn at(&mut self, t: f64) -> f64 {
        if t == self.next as f64 * self.h && !self.next.is_multiple_of(RESTART) {
            self.next += 1;
            self.phasors.iter_mut().for_each(Phasor::turn);
        } else if !self.set(t) {
            return self.forcing.force(t);
        }
        let mut force = self.forcing.constant;
        for phasor in &self.phasors {
            force += phasor.wave.amplitude * phasor.now[0];
        }
        if self.others { force + self.forcing.irregular(t) } else { force }
    }

    /// Computes the sines at `t` as if all instants before had been asked for, and returns true;
    /// between two instants, returns false, and the sines stay those of the last instant.
    #[inline(never)]
    fn set(&mut self, t: f64) -> bool {
        let index = (t / self.h).round() as u64;
        if t != index as f64 * self.h {
            return false;
        }
        let turns = index % RESTART;
        for phasor in &mut self.phasors {
            phasor.set((index - turns) as f64 * self.h);
            (0..turns).for_each(|_| phasor.turn());
        }
        self.next = index + 1;
        true
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
                // 32 rotations, each half an ulp of amplitudes 3 and 2; and ωh·k of the rotation
                // against ωt, some ulps of the phase.
                let phase = 61.7 * 6.3 * t * f64::EPSILON;
                assert!(error < 5.0 * (16.0 * f64::EPSILON + 2.0 * phase), "{h} {index}: {error:e}");
            }
            // An instant gives the same bits whatever was asked before.
            let (mut again, seen) = (GridForcing::new(forcing.clone(), h), grid.at(77.0 * h));
            assert_eq!(again.at(77.0 * h), seen);
            assert_eq!((again.at(78.0 * h), again.at(79.0 * h)), (grid.at(78.0 * h), grid.at(79.0 * h)));
            let between = 7.3 * h;
            assert_eq!(grid.at(between), forcing.force(between));
            assert_eq!(grid.at(8.0 * h), GridForcing::new(forcing.clone(), h).at(8.0 * h));
        }
    }
}
