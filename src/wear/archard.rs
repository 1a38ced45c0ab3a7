//! Archard's law at a support: the volumes worn off in service, and the depth of the scar.

use super::depth::{Bearing, all_round};
use serde::{Deserialize, Serialize};

/// How a tube and its support wear: V = k W T, with k the wear coefficient (Archard 1953,
/// doi:10.1063/1.1721448; 1/Pa), W the work rate and T the time in service.
///
/// ```
/// use signorini::wear::{Archard, Bearing, Scar};
///
/// // 10 mW for ten years of 3.156e7 s at 1e-14 1/Pa, on a tube of 19.05 mm in a hole 25 mm wide.
/// let scar = Scar { width: 25e-3, radius: 9.525e-3, bearing: Bearing::Hole { gap: 0.2e-3 } };
/// let law = Archard { coefficient: Some(1e-14), support_coefficient: None, service: 3.156e8, scar: Some(scar) };
/// let worn = law.worn(0.01);
/// assert!((worn.volume_m3.unwrap() / 3.156e-8 - 1.0).abs() < 1e-12);
/// assert!((worn.depth_one_scar_m.unwrap() / 0.114e-3 - 1.0).abs() < 0.02);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Archard {
    /// k of the tube, 1/Pa.
    pub coefficient: Option<f64>,
    /// k of the support, 1/Pa.
    pub support_coefficient: Option<f64>,
    /// T, s.
    pub service: f64,
    /// The geometry of the scar; without it no depth is computed.
    pub scar: Option<Scar>,
}

/// What is expected where a depth is asked for and sliders alone wear.
#[cfg(feature = "case")]
pub(crate) const SCAR: &str = "a support with width and radius: sliders have no depth";

/// The geometry of a scar on a tube.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Scar {
    /// Width of the support along the tube, m.
    pub width: f64,
    /// Radius of the tube, m.
    pub radius: f64,
    /// What the tube bears against.
    pub bearing: Bearing,
}

/// Wear of a support and its tube in service; `None` where no coefficient or no scar is given, and
/// where the volume would be negative or NaN.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Worn {
    /// Volume worn off the tube, m³.
    pub volume_m3: Option<f64>,
    /// Depth on the tube if all of it comes off one scar, m; also `None` where that would cut the
    /// tube in two.
    pub depth_one_scar_m: Option<f64>,
    /// Depth on the tube if it comes off evenly all round, m.
    pub depth_all_round_m: Option<f64>,
    /// Volume worn off the support, m³.
    pub support_volume_m3: Option<f64>,
}

impl Archard {
    /// The wear by a work rate (W).
    #[must_use]
    pub fn worn(&self, work_rate: f64) -> Worn {
        let volume = |coefficient: Option<f64>| {
            coefficient.map(|k| k * work_rate * self.service).filter(|volume| *volume >= 0.0)
        };
        let volume_m3 = volume(self.coefficient);
        let scarred = volume_m3.zip(self.scar);
        Worn {
            volume_m3,
            depth_one_scar_m: scarred.and_then(|(_, scar)| self.scar_depth(scar, work_rate * self.service)),
            depth_all_round_m: scarred.map(|(volume, scar)| all_round(volume, scar.width, scar.radius)),
            support_volume_m3: volume(self.support_coefficient),
        }
    }

    /// Depth of one scar on the tube by `work` (J), m; `None` where that would cut the tube in two,
    /// and where the work is negative or NaN.
    ///
    /// The scar of the tube alone, but where it bears against another one: what both lose is the
    /// lens in which their circles overlap, and at each point of it they wear in the ratio of their
    /// coefficients.
    pub(super) fn scar_depth(&self, Scar { width, radius, bearing }: Scar, work: f64) -> Option<f64> {
        let (own, both) = (self.coefficient?, self.both_coefficients());
        match bearing {
            Bearing::Tube { .. } => bearing.depth(both * work, width, radius).map(|depth| own / both * depth),
            Bearing::Flat | Bearing::Hole { .. } => bearing.depth(own * work, width, radius),
        }
    }

    /// k of tube and support, 1/Pa.
    pub(super) fn both_coefficients(&self) -> f64 {
        self.coefficient.unwrap_or(0.0) + self.support_coefficient.unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_follow_work_and_depths_follow_volumes() {
        // The reference volume of 3e-8 m³, and depths with 40 digits.
        let scar = |bearing| Some(Scar { width: 0.025, radius: 0.009_525, bearing });
        let law = |scar| Archard { coefficient: Some(1e-14), support_coefficient: Some(2e-14), service: 3e8, scar };
        let hole = law(scar(Bearing::Hole { gap: 0.000_2 })).worn(0.01);
        let flat = law(scar(Bearing::Flat)).worn(0.01);
        let near = |found: Option<f64>, wanted: f64| (found.unwrap() / wanted - 1.0).abs() < 1e-12;
        assert!(near(hole.volume_m3, 3e-8) && near(hole.support_volume_m3, 6e-8));
        assert!(near(hole.depth_one_scar_m, 0.000_109_216_051_031_080_68));
        assert!(near(flat.depth_one_scar_m, 0.000_350_324_405_082_514_47));
        assert!(near(flat.depth_all_round_m, 3e-8 / (std::f64::consts::TAU * 0.009_525 * 0.025)));
        assert_eq!(law(None).worn(0.01).depth_all_round_m, None);
        for bad in [f64::NAN, -1.0] {
            let none = law(scar(Bearing::Flat)).worn(bad);
            assert_eq!((none.volume_m3, none.support_volume_m3, none.depth_all_round_m), (None, None, None), "{bad}");
        }
        let none = Archard { coefficient: None, ..law(scar(Bearing::Flat)) }.worn(0.01);
        assert_eq!((none.volume_m3, none.depth_one_scar_m, none.depth_all_round_m), (None, None, None));
        // A thousand times the service would cut the tube in two.
        assert_eq!(law(scar(Bearing::Flat)).worn(10.0).depth_one_scar_m, None);
    }
}
