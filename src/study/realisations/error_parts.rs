//! The error of a mean over realisations, in four parts.

use serde::Serialize;

/// One part of the error of a mean: what a refinement is expected to add to it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ErrorPart {
    /// Its mean over the realisations, in the unit of the estimate.
    pub mean: f64,
    /// Half width of the 95 % interval of that mean, by Student's t.
    pub half_width_95: f64,
}

/// The parts of the error of a mean.
///
/// Each is a mean of differences between values of the same realisation, with its interval. Where
/// the interval holds 0 the part is not seen; that is no proof that there is none, for in an
/// irregular motion two runs of the same realisation part and their difference scatters: the part
/// is then known to be [`ErrorPart::at_most`] so large.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ErrorParts {
    /// Of a window that begins too early: its second half less the first.
    pub start: ErrorPart,
    /// Of the step h: half the step less this one, times 2ᵖ/(2ᵖ − 1) with the order p of the
    /// scheme. `None` for the exact scheme, and where that was not computed or is refuted.
    pub step: Option<ErrorPart>,
    /// Of the modes left out: twice the modes less these. `None` where no more can be had, and
    /// where that was not computed or is refuted.
    pub modes: Option<ErrorPart>,
    /// Of the number of realisations: half width of the 95 % interval of the mean.
    pub sampling_half_width_95: f64,
    /// The sum of the |means| and the root of the sum of the squared half widths.
    pub total: f64,
}

impl ErrorPart {
    pub(super) const fn new(mean: f64, half_width_95: f64) -> Self {
        Self { mean, half_width_95 }
    }

    /// The same part of an error `factor` times as large.
    pub(super) fn times(self, factor: f64) -> Self {
        Self { mean: factor * self.mean, half_width_95: factor * self.half_width_95 }
    }

    /// True where its interval does not hold 0.
    #[must_use]
    pub fn is_seen(&self) -> bool {
        self.mean.abs() > self.half_width_95
    }

    /// The end of its interval that is farther from 0, by its magnitude.
    #[must_use]
    pub fn at_most(&self) -> f64 {
        self.mean.abs() + self.half_width_95
    }
}

impl ErrorParts {
    /// The parts with their total, beside the half width `sampling` of the mean.
    pub(super) fn new(start: ErrorPart, step: Option<ErrorPart>, modes: Option<ErrorPart>, sampling: f64) -> Self {
        let parts = [Some(start), step, modes].into_iter().flatten();
        let means: f64 = parts.clone().map(|part| part.mean.abs()).sum();
        let squares: f64 = parts.map(|part| part.half_width_95.powi(2)).sum();
        let total = means + (squares + sampling * sampling).sqrt();
        Self { start, step, modes, sampling_half_width_95: sampling, total }
    }
}
