//! A worn support at one time.

use serde::Serialize;

/// A support at one time of a history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearState {
    /// The gap, m: of flats the least.
    pub gap_m: f64,
    /// Where the centre has moved since the start, along y and z, m.
    pub shift_m: [f64; 2],
    /// The work of wear since the start, J.
    pub work_j: f64,
    /// The work rate at this gap, W.
    pub work_rate_w: f64,
    /// The depth worn off the tube where it is deepest, m: in a sector of a round support, or at
    /// one of the flats, and no deeper than `depth_one_scar_m`; NaN where that would cut the tube
    /// in two. Of one history under random loads it is an upper figure: the part that is the
    /// deepest by chance counts. [`mean`](super::mean) has less of that.
    pub depth_deepest_m: f64,
    /// The depth worn off the tube, evenly all round, m.
    pub depth_all_round_m: f64,
    /// The depth if all that is worn off the tube comes off one scar in the first gap, m; NaN where
    /// that would cut the tube in two.
    pub depth_one_scar_m: f64,
}

/// A quantity of a support that changes over the years.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum WearQuantity {
    /// The gap, m.
    Gap,
    /// The depth worn off the tube where it is deepest, m.
    DepthDeepest,
    /// The depth worn off the tube, evenly all round, m.
    DepthAllRound,
    /// The depth if all that is worn off the tube comes off one scar, m.
    DepthOneScar,
    /// The work rate, W.
    WorkRate,
}

impl WearQuantity {
    /// Its value in a state.
    #[must_use]
    pub fn of(self, state: &WearState) -> f64 {
        match self {
            Self::Gap => state.gap_m,
            Self::DepthDeepest => state.depth_deepest_m,
            Self::DepthAllRound => state.depth_all_round_m,
            Self::DepthOneScar => state.depth_one_scar_m,
            Self::WorkRate => state.work_rate_w,
        }
    }
}
