//! Whether pivoting repeats itself.

use super::side::Side;

/// Detects a repeated state by the method of Brent 1980 (doi:10.1007/BF01933190).
#[derive(Default)]
pub(super) struct Cycle {
    saved: u64,
    age: u64,
    life: u64,
    /// Number of repetitions found so far.
    pub closed: u32,
}

impl Cycle {
    /// True if the state, given by wrong rows and rows in play, has the hash of the saved one.
    pub(super) fn closes(&mut self, wrong: &[(usize, Option<Side>)], rows: &[usize]) -> bool {
        let mix = |hash: u64, word: u64| (hash.rotate_left(5) ^ word).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let hash = wrong.iter().fold(1, |hash, &(row, side)| {
            mix(hash, 4 * row as u64 + side.map_or(0, |side| 1 + u64::from(side == Side::Upper)))
        });
        let hash = rows.iter().fold(hash, |hash, &row| mix(hash, row as u64));
        if self.life > 0 && hash == self.saved {
            self.closed += 1;
            (self.life, self.age) = (0, 0);
            return true;
        }
        self.age += 1;
        if self.age > self.life {
            (self.saved, self.age, self.life) = (hash, 0, 2 * self.life + 1);
        }
        false
    }
}

#[cfg(test)]
mod tests;
