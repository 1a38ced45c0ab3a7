//! What a field asks of the forces on modes, each scaled to a largest displacement of 1 along the
//! stretch, so that they are forces in N whatever the modes' own scale.

use super::coherence::CellCoherence;
use super::{Modes, Turbulence};
use crate::error::Result;

/// The forces that a field asks for.
pub(crate) struct Asked<'a> {
    field: &'a Turbulence,
    /// ∫ φ dx over each cell, for each mode that moves along the stretch.
    weights: Vec<(usize, Vec<f64>)>,
    /// For each of these modes its number, from 0, and what scales its force.
    pub modes: Vec<(usize, f64)>,
}

impl Turbulence {
    /// What the field asks of the forces on `modes`.
    pub(crate) fn asked(&self, modes: &Modes) -> Asked<'_> {
        let mut weights = self.weights(modes);
        let scale = |(mode, weights): &mut (usize, Vec<f64>)| {
            let largest = weights.iter().fold(0.0_f64, |most, w| most.max(w.abs())) / self.cell_length();
            weights.iter_mut().for_each(|w| *w /= largest);
            (*mode, 1.0 / largest)
        };
        let modes = weights.iter_mut().map(scale).collect();
        Asked { field: self, weights, modes }
    }
}

impl Asked<'_> {
    /// The frequencies of the lines in a run of `end` seconds, Hz.
    ///
    /// # Errors
    /// As [`Turbulence::forces`].
    pub fn lines(&self, end: f64) -> Result<impl ExactSizeIterator<Item = f64> + use<>> {
        let lines = self.field.lines(end)?;
        Ok(lines.numbers().map(move |line| lines.frequency(line)))
    }

    /// The cross-densities at the frequency `f` (Hz), N²/Hz: the lower triangle by rows, one row a
    /// mode.
    pub fn at(&self, f: f64) -> Vec<Vec<f64>> {
        let coherence = CellCoherence::new(self.field.cell_length(), self.field.correlation_length);
        self.field.cross_densities(coherence, &self.weights, f)
    }
}
