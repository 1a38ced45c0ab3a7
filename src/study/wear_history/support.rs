//! A support that wears.

use super::state::WearState;
use crate::scene::Scene;
use crate::wear::{Archard, Growth, Opening, WearWork, Worn};

/// A support that wears.
#[derive(Debug, Clone, PartialEq)]
pub struct WearingSupport {
    /// Its name.
    pub name: String,
    /// The gap of each of its walls at the start, m: of a round support the radial one.
    pub gaps: Vec<f64>,
    /// What wear does to these gaps.
    pub growth: Growth,
    /// The law of wear, with the coefficients of tube and support and a scar. Its service counts
    /// for nothing: depths follow from the work done.
    pub law: Archard,
    /// Thickness of the tube's wall, m; `None` where it is not known, or is no tube: then it counts
    /// as worn through at its radius.
    pub wall: Option<f64>,
}

impl WearingSupport {
    /// True if the support has a gap at each wall, a wear coefficient and a scar.
    pub(super) fn wears(&self) -> bool {
        let coefficient = self.law.coefficient.or(self.law.support_coefficient);
        let sound = |gap: &f64| gap.is_finite() && *gap >= 0.0;
        coefficient.is_some() && self.law.scar.is_some() && !self.gaps.is_empty() && self.gaps.iter().all(sound)
    }

    /// The depth at which the tube is worn through, m.
    pub(super) fn end(&self) -> Option<f64> {
        self.wall.or(self.law.scar.map(|scar| scar.radius))
    }

    /// What the work `work` (J) has made of it.
    pub(super) fn opening(&self, work: &WearWork) -> Opening {
        self.growth.opening(&self.law, work)
    }

    /// Makes of it in `scene` what wear has made: its walls recede, and its centre moves. A scene
    /// without this support stays as it is.
    pub fn open(&self, scene: &mut Scene, opening: &Opening) {
        let Some(support) = scene.supports.iter_mut().find(|support| support.name == self.name) else { return };
        let round = support.hole(&scene.walls).is_some();
        let walls = support.walls.clone();
        for (wall, by) in walls.zip(&opening.recession) {
            if let Some(wall) = scene.walls.get_mut(wall) {
                wall.open(*by, opening.shift);
            }
        }
        if round {
            support.centre.iter_mut().zip(opening.shift).for_each(|(centre, shift)| *centre += shift);
        }
    }

    /// The gap of each wall after the work `work` (J), m.
    pub(super) fn gaps_after(&self, work: &WearWork) -> Vec<f64> {
        self.gaps.iter().zip(self.opening(work).recession).map(|(gap, receded)| gap + receded).collect()
    }

    /// The depth worn off the tube by the work `work` (J) in each sector, or at each flat, m.
    pub(super) fn depths(&self, work: &WearWork) -> Vec<f64> {
        self.law.depths(self.growth, work)
    }

    /// The state after the work `work` (J) at the work rate `rate` (W).
    pub(super) fn state(&self, work: &WearWork, rate: f64) -> WearState {
        let worn = self.worn(work);
        WearState {
            gap_m: self.gaps_after(work).into_iter().fold(f64::INFINITY, f64::min),
            shift_m: self.opening(work).shift,
            work_j: work.total,
            work_rate_w: rate,
            depth_deepest_m: self.law.deepest(self.growth, work),
            depth_all_round_m: worn.depth_all_round_m.unwrap_or(0.0),
            depth_one_scar_m: self.depth_one_scar(work),
        }
    }

    /// The depths by the mean of the work of several histories, and about it those of each, as of
    /// [`WearWork::about_mean`], m: in each sector, or at each flat.
    pub(super) fn depths_about_mean(&self, works: &[WearWork]) -> Vec<Vec<f64>> {
        WearWork::about_mean(works, |work| self.depths(work))
    }

    /// Likewise of one scar.
    pub(super) fn scars_about_mean(&self, works: &[WearWork]) -> Vec<f64> {
        WearWork::about_mean(works, |work| vec![self.depth_one_scar(work)]).concat()
    }

    fn worn(&self, work: &WearWork) -> Worn {
        Archard { service: 1.0, ..self.law }.worn(work.total)
    }

    /// The depth if the work `work` (J) makes one scar, m; NaN where that would cut the tube in
    /// two.
    fn depth_one_scar(&self, work: &WearWork) -> f64 {
        let worn = self.worn(work);
        let wears = work.total > 0.0 && worn.volume_m3.is_some();
        if wears { worn.depth_one_scar_m.unwrap_or(f64::NAN) } else { 0.0 }
    }
}
