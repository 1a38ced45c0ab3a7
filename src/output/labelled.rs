//! A run that is drawn.

use super::figure::Curve;
use crate::run::Run;

/// A run with the label of its curves.
#[derive(Debug, Clone, Copy)]
pub struct Labelled<'a> {
    /// Label in the legend.
    pub label: &'a str,
    /// The run.
    pub run: &'a Run,
    /// True for the reference, drawn wide and pale beneath the others.
    pub reference: bool,
    /// Index of its colour and dash pattern, the same in all figures of one command.
    pub look: usize,
}

impl Labelled<'_> {
    /// A curve of the run.
    pub(super) fn curve(&self, points: impl IntoIterator<Item = (f64, f64)>) -> Curve {
        let curve = Curve::new(self.label, points).look(self.look);
        if self.reference { curve.backdrop() } else { curve }
    }
}
