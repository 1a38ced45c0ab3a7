//! The unknowns of the complementarity problem, its matrix, and what they say of the contacts.

use super::{Coulomb, CoulombContact, Mode, Unknown};

/// The most by which the unit of a rate is larger than the largest rate of approach: a row of
/// smaller numbers would itself be taken for rounding.
const FASTEST: f64 = 1e6;

impl Coulomb {
    pub(super) fn unknowns(&self) -> Vec<Unknown> {
        let of = |(index, contact): (usize, &CoulombContact)| {
            let all =
                [Unknown::Press(index), Unknown::Rub(index, 1.0), Unknown::Rub(index, -1.0), Unknown::Slip(index)];
            all.into_iter().take(if contact.friction > 0.0 { 4 } else { 1 })
        };
        self.contacts.iter().enumerate().flat_map(of).collect()
    }

    /// Matrix and right-hand side of the complementarity problem: impulses in units of 1/√W_kk, so
    /// that the diagonal of W is 1, and rates in the unit that is returned beside them. A row of
    /// W whose rate is far larger than that of any approach, of a contact that slides or separates
    /// fast, is in a unit of its own (as λ is in the row of a tangent): beside it, pivots would
    /// take the approaches for rounding.
    pub(super) fn complementarity(&self, unknowns: &[Unknown]) -> (Vec<f64>, Vec<f64>, f64) {
        use Unknown::{Press, Rub, Slip};
        let n = self.scale.len();
        // The row of W, and the sign.
        let row = |unknown: Unknown| match unknown {
            Press(i) => Some((2 * i, 1.0)),
            Rub(i, sign) => Some((2 * i + 1, sign)),
            Slip(_) => None,
        };
        let rate = |k: usize| self.contacts[k / 2].free[k % 2] * self.scale[k];
        let approach = (0..n).step_by(2).fold(0.0_f64, |most, k| most.max(-rate(k)));
        let unit = |k: usize| match approach / rate(k).abs() {
            share if share < 1.0 => share.max(FASTEST.recip()),
            _ => 1.0,
        };
        let entry = |to: Unknown, from: Unknown| match (row(to), row(from)) {
            (Some((k, one)), Some((l, other))) => {
                one * other * self.response[k * n + l] * self.scale[k] * self.scale[l] * unit(k)
            }
            _ => match (to, from) {
                (Rub(i, _), Slip(j)) if i == j => 1.0,
                (Slip(i), Rub(j, _)) if i == j => -1.0,
                (Slip(i), Press(j)) if i == j => self.contacts[i].friction * self.scale[2 * i] / self.scale[2 * i + 1],
                _ => 0.0,
            },
        };
        let free = |unknown: Unknown| row(unknown).map_or(0.0, |(k, sign)| sign * rate(k) * unit(k));
        let matrix = unknowns.iter().flat_map(|&to| unknowns.iter().map(move |&from| entry(to, from))).collect();
        let mut free: Vec<f64> = unknowns.iter().map(|&unknown| free(unknown)).collect();
        let largest = free.iter().fold(f64::MIN_POSITIVE, |most, u| most.max(u.abs()));
        free.iter_mut().for_each(|u| *u /= largest);
        (matrix, free, largest)
    }

    /// p and f of the unknowns.
    pub(super) fn impulses(&self, unknowns: &[Unknown], z: &[f64], largest: f64) -> Vec<[f64; 2]> {
        let mut impulses = vec![[0.0; 2]; self.contacts.len()];
        for (unknown, z) in unknowns.iter().zip(z) {
            match *unknown {
                Unknown::Press(i) => impulses[i][0] = z * self.scale[2 * i] * largest,
                Unknown::Rub(i, sign) => impulses[i][1] += sign * z * self.scale[2 * i + 1] * largest,
                Unknown::Slip(_) => {}
            }
        }
        impulses
    }

    /// The states of the unknowns.
    pub(super) fn modes(&self, unknowns: &[Unknown], z: &[f64]) -> Vec<Mode> {
        let mut modes = vec![Mode::Open; self.contacts.len()];
        let mut rubs = vec![0.0; self.contacts.len()];
        for (unknown, &z) in unknowns.iter().zip(z) {
            match *unknown {
                Unknown::Press(i) if z > 0.0 => {
                    modes[i] = if self.contacts[i].friction > 0.0 { Mode::Stick } else { Mode::Slip(0.0) };
                }
                Unknown::Rub(i, sign) => rubs[i] += sign * z,
                Unknown::Slip(i) if z > 0.0 && modes[i] == Mode::Stick => modes[i] = Mode::Slip(f64::signum(rubs[i])),
                _ => {}
            }
        }
        modes
    }
}
