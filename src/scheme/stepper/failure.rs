//! What a step that failed is blamed on.

use super::Stepper;
use crate::error::{Error, Subject};
use crate::scene::{LoadKind, finite};

impl Stepper {
    /// The error of a step that failed: that of a load whose function gave no finite force there,
    /// else `error`. Steps made in one loop up to that one are counted.
    #[cold]
    pub(super) fn failure(&mut self, error: Error) -> Error {
        let (Error::NotFinite { time, step, .. } | Error::Qp { time, step, .. } | Error::Newton { time, step, .. }) =
            error
        else {
            return error;
        };
        if !self.scheme.is_exact() {
            self.index = step;
        }
        let ends = [step as f64 * self.step, time, (step + 1) as f64 * self.step];
        let forces = |time: f64| {
            self.scene.loads.iter().enumerate().find_map(move |(index, load)| match &load.kind {
                LoadKind::Function(f) => {
                    finite(Subject::nth("load", index).part(format!("f({time:?})")), f.at(time)).err()
                }
                _ => None,
            })
        };
        ends.into_iter().find_map(forces).unwrap_or(error)
    }
}
