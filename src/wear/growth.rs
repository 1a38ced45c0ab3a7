//! How a support opens by wear: what its work of wear does to its gaps.
//!
//! With the coefficients k_t of the tube and k_s of the support, k = k_t + k_s, the radius R of the
//! tube, the width w of the support, and the work E done there, of which E(θ) dθ at the angle θ:
//!
//! - *Even*, of a round support: its gap grows by the mean depth of tube and support,
//!   d₀ = k E/(2πRw).
//! - *Shifted*, of a round support: the local depth d(θ) = k E(θ)/(Rw) opens the gap to γ + d(θ).
//!   Of its harmonics 0 and 1 a circle with the gap γ + d₀, moved by
//!   d₁ = (1/π) ∫ d(θ) (cos θ, sin θ) dθ, has the same gap up to |d₁|²/2γ; higher harmonics are
//!   lost. A circle that is moved further than it grew would lie within the old one on the other
//!   side, where nothing is put on: |d₁| ≤ d₀.
//! - *Flats*: each flat recedes by the depth of its scar, at which the segment that it cuts off the
//!   tube has the volume k E of the work done at that flat. Where it stands for another tube, both
//!   come closer by the depth at which the lens of both circles has that volume.
//!
//! In each case the support stays convex, so that contacts are found as before.

use super::archard::{Archard, Scar};
use super::depth::{Bearing, all_round};
use super::wear_work::WearWork;
use serde::{Deserialize, Serialize};

/// What its wear does to the gaps of a support.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Growth {
    /// Nothing: the gaps stay as they are, and wear is counted all the same.
    #[default]
    Kept,
    /// The gap of a round support grows evenly all round.
    Even,
    /// The gap of a round support grows, and its centre moves towards the deeper side.
    Shifted,
    /// Each flat recedes by its scar.
    Flats,
}

/// What wear has made of the gaps of a support.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Opening {
    /// By how much each of its walls has receded, m.
    pub recession: Vec<f64>,
    /// Where its centre has moved, along y and z, m.
    pub shift: [f64; 2],
}

impl Growth {
    /// Its name in case files; that of gaps that stay is none of them.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::Even => "even",
            Self::Shifted => "shifted",
            Self::Flats => "flats",
        }
    }

    /// The opening of a support of the law `law` after `work` (J). A flat that has worn through the
    /// tube recedes no further than its diameter; without a scar in the law nothing opens.
    #[must_use]
    pub fn opening(self, law: &Archard, work: &WearWork) -> Opening {
        let still = Opening { recession: vec![0.0; work.walls.len()], shift: [0.0; 2] };
        let Some(scar) = law.scar else { return still };
        let Scar { width, radius, bearing } = scar;
        match self {
            Self::Kept => still,
            Self::Even => {
                Opening { recession: vec![work.total * law.even_depth_by_work(scar); work.walls.len()], ..still }
            }
            Self::Shifted => {
                let even = work.total * law.even_depth_by_work(scar);
                let [y, z] = work.first_harmonic().map(|part| 2.0 * part * law.even_depth_by_work(scar));
                let size = y.hypot(z);
                let kept = if size > even { even / size } else { 1.0 };
                Opening { recession: vec![even; work.walls.len()], shift: [kept * y, kept * z] }
            }
            Self::Flats => {
                let k = law.both_coefficients();
                let depth = |work: &f64| bearing.depth(k * work, width, radius).unwrap_or(2.0 * radius);
                Opening { recession: work.walls.iter().map(depth).collect(), ..still }
            }
        }
    }

    /// The time (s) until a wall, of which `gaps` (m) are those of the start, has receded by
    /// `share` of its gap, after `work` (J) at the rate `rate` (W); infinite where none does.
    pub(crate) fn time_to_open(self, law: &Archard, gaps: &[f64], work: &WearWork, rate: &WearWork, share: f64) -> f64 {
        let Some(scar) = law.scar else { return f64::INFINITY };
        let Scar { width, radius, bearing } = scar;
        let open = self.opening(law, work).recession;
        let time = |((gap, receded), (work, rate)): ((&f64, &f64), (f64, f64))| {
            let further = share * (gap + receded);
            match self {
                Self::Kept => f64::INFINITY,
                Self::Even | Self::Shifted => {
                    let speed = rate * law.even_depth_by_work(scar);
                    if speed > 0.0 { further / speed } else { f64::INFINITY }
                }
                // A flat without a gap has none to compare with.
                Self::Flats if rate > 0.0 && further > 0.0 => {
                    let until = bearing.area(receded + further, radius) * width / law.both_coefficients();
                    (until - work).max(0.0) / rate
                }
                Self::Flats => f64::INFINITY,
            }
        };
        let of_wall = |index: usize| match self {
            Self::Flats => [work, rate].map(|work| work.walls.get(index).copied().unwrap_or(0.0)),
            _ => [work.total, rate.total],
        };
        let walls = gaps.iter().zip(&open).enumerate().map(|(index, gap)| (gap, of_wall(index).into()));
        walls.map(time).fold(f64::INFINITY, f64::min)
    }
}

impl Archard {
    /// Depth of tube and support together, evenly all round, by the work of wear, m/J.
    fn even_depth_by_work(&self, scar: Scar) -> f64 {
        all_round(self.both_coefficients(), scar.width, scar.radius)
    }

    /// Depth worn off the tube by `work` (J) in each sector of a round support, or at each of the
    /// flats, m, and nowhere deeper than one scar of all of it; none without a coefficient of the
    /// tube or a scar. NaN where it would cut the tube in two.
    #[must_use]
    pub fn depths(&self, growth: Growth, work: &WearWork) -> Vec<f64> {
        let Some((coefficient, scar)) = self.coefficient.zip(self.scar) else { return Vec::new() };
        let Scar { width, radius, bearing } = scar;
        // A sector narrower than the scar that all of the wear makes is no deeper than that.
        let flat = |work: &f64| self.scar_depth(scar, *work).unwrap_or(f64::NAN);
        let one_scar = flat(&work.total);
        let sector = |own: &f64| all_round(coefficient * own * work.sectors.len() as f64, width, radius);
        let own: Vec<f64> = match (growth, bearing) {
            (Growth::Flats | Growth::Kept, Bearing::Flat | Bearing::Tube { .. }) => {
                work.walls.iter().map(flat).collect()
            }
            _ => work.sectors.iter().map(sector).collect(),
        };
        // What is worn off twice the radius deep is cut off.
        let whole = |depth: f64| if depth <= 2.0 * radius { depth.min(one_scar) } else { f64::NAN };
        own.into_iter().map(whole).collect()
    }

    /// Depth worn off the tube where it is deepest, m: the largest of [`Archard::depths`], 0 where
    /// there are none, NaN where one is.
    #[must_use]
    pub fn deepest(&self, growth: Growth, work: &WearWork) -> f64 {
        let larger = |most: f64, depth: f64| if depth.is_nan() || depth > most { depth } else { most };
        self.depths(growth, work).into_iter().fold(0.0, larger)
    }

    /// The work within the service at constant `rates` (W), J; `None` where it takes no depth off
    /// the tube, without a coefficient of it or a scar.
    #[must_use]
    pub fn work_in_service(&self, rates: &WearWork) -> Option<WearWork> {
        self.coefficient.and(self.scar)?;
        Some(WearWork::none(rates.sectors.len(), rates.walls.len()).advanced(rates, rates, self.service))
    }

    /// Depth worn off the tube within the service where it is deepest, m, at constant `rates` (W);
    /// `None` where there is no such work, and where it would cut the tube in two.
    #[must_use]
    pub fn deepest_in_service(&self, growth: Growth, rates: &WearWork) -> Option<f64> {
        Some(self.deepest(growth, &self.work_in_service(rates)?)).filter(|depth| !depth.is_nan())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// k of 1e-12 1/Pa in all, on a tube of 19.05 mm over 25 mm.
    fn law(bearing: Bearing) -> Archard {
        let scar = Some(Scar { width: 0.025, radius: 0.009_525, bearing });
        Archard { coefficient: Some(4e-13), support_coefficient: Some(6e-13), service: 1.0, scar }
    }

    fn round(sectors: Vec<f64>) -> WearWork {
        WearWork { total: sectors.iter().sum(), walls: vec![sectors.iter().sum()], sectors }
    }

    #[test]
    fn a_shifted_hole_has_the_harmonics_0_and_1_of_the_depth() {
        let law = law(Bearing::Hole { gap: 2e-4 });
        // E(θ) = E/2π (1 + a cos(θ − φ)), by sectors: ∫ cos(θ − φ) is a difference of sines.
        let (all, a, phi, count): (f64, f64, f64, usize) = (1e5, 0.7, 0.4, 12);
        let edge = |k: usize| TAU * k as f64 / count as f64 - phi;
        let sectors = (0..count).map(|k| all / TAU * (TAU / count as f64 + a * (edge(k + 1).sin() - edge(k).sin())));
        let open = Growth::Shifted.opening(&law, &round(sectors.collect()));
        let even = 1e-12 * all / (TAU * 0.009_525 * 0.025);
        assert!((open.recession[0] / even - 1.0).abs() < 1e-14);
        // d₁ is a times the mean depth; even work within sectors of 30 degrees keeps sinc² of it.
        let half: f64 = PI / count as f64;
        let size = even * a * (half.sin() / half).powi(2);
        for (found, wanted) in open.shift.iter().zip([phi.cos(), phi.sin()]) {
            assert!((found / (size * wanted) - 1.0).abs() < 1e-12, "{found}");
        }
        assert_eq!(Growth::Even.opening(&law, &round(vec![all])).shift, [0.0; 2]);
    }

    #[test]
    fn a_hole_is_moved_no_further_than_it_grew_and_even_work_moves_nothing() {
        let law = law(Bearing::Hole { gap: 2e-4 });
        let mut sectors = vec![0.0; 12];
        sectors[3] = 1e5;
        let open = Growth::Shifted.opening(&law, &round(sectors));
        let [y, z] = open.shift;
        assert!((y.hypot(z) / open.recession[0] - 1.0).abs() < 1e-14);
        // Towards the middle of the sector, 105 degrees.
        assert!((z.atan2(y).to_degrees() - 105.0).abs() < 1e-10);
        let open = Growth::Shifted.opening(&law, &round(vec![1e4; 12]));
        assert!(open.shift.iter().all(|x| x.abs() < 1e-14 * open.recession[0]));
    }

    #[test]
    fn each_flat_recedes_by_its_own_scar() {
        let law = law(Bearing::Flat);
        // 3e-8 m³ of both make 0.350324405082514 mm, computed with 40 digits.
        let work = WearWork { total: 3e4, sectors: vec![3e4; 1], walls: vec![3e4, 0.0] };
        let open = Growth::Flats.opening(&law, &work);
        assert!((open.recession[0] / 0.350_324_405_082_514_47e-3 - 1.0).abs() < 1e-12);
        assert_eq!((open.recession[1], open.shift), (0.0, [0.0; 2]));
        // Of the tube comes 0.4 of it.
        let own = Bearing::Flat.depth(0.4 * 3e-8, 0.025, 0.009_525).unwrap();
        assert_eq!(law.deepest(Growth::Flats, &work), own);
        // From there at 1 W until half of the gap and recession have gone again.
        let rate = WearWork { total: 1.0, sectors: vec![1.0], walls: vec![1.0, 0.0] };
        let time = Growth::Flats.time_to_open(&law, &[1e-4, 1e-4], &work, &rate, 0.5);
        let then = Growth::Flats.opening(&law, &work.advanced(&rate, &rate, time)).recession[0];
        assert!((then / (1.5 * open.recession[0] + 0.5e-4) - 1.0).abs() < 1e-12, "{then}");
        assert_eq!(Growth::Kept.opening(&law, &work).recession, [0.0, 0.0]);
        assert_eq!(Growth::Kept.time_to_open(&law, &[1e-4], &work, &rate, 0.5), f64::INFINITY);
    }

    #[test]
    fn two_tubes_come_closer_by_the_depths_of_both() {
        let work = WearWork { total: 3e4, sectors: vec![3e4], walls: vec![3e4] };
        let [left, right] = [(4e-13, 6e-13), (6e-13, 4e-13)].map(|(own, other)| Archard {
            coefficient: Some(own),
            support_coefficient: Some(other),
            ..law(Bearing::Tube { radius: 0.009_525 })
        });
        let closer = Growth::Flats.opening(&left, &work).recession[0];
        let depths = [left, right].map(|law| law.deepest(Growth::Flats, &work));
        assert!((depths[0] / depths[1] * 1.5 - 1.0).abs() < 1e-12, "{depths:?}");
        assert!(((depths[0] + depths[1]) / closer - 1.0).abs() < 1e-12, "{depths:?} {closer:e}");
        // Of equal tubes that wear alike each loses the segment that a plane cuts off.
        let alike = Archard { coefficient: Some(5e-13), support_coefficient: Some(5e-13), ..left };
        let segment = Bearing::Flat.depth(1.5e-8, 0.025, 0.009_525).unwrap();
        assert!((alike.deepest(Growth::Kept, &work) / segment - 1.0).abs() < 1e-12);
        let rate = WearWork { total: 1.0, sectors: vec![1.0], walls: vec![1.0] };
        let time = Growth::Flats.time_to_open(&left, &[1e-4], &work, &rate, 0.5);
        let then = Growth::Flats.opening(&left, &work.advanced(&rate, &rate, time)).recession[0];
        assert!((then / (1.5 * closer + 0.5e-4) - 1.0).abs() < 1e-12, "{then}");
    }

    #[test]
    fn the_deepest_sector_has_its_work_on_its_part_of_the_circle() {
        let mut sectors = vec![1e4; 12];
        sectors[5] = 3e4;
        let depth = law(Bearing::Hole { gap: 2e-4 }).deepest(Growth::Even, &round(sectors));
        assert!((depth / (4e-13 * 3e4 / (0.009_525 * TAU / 12.0 * 0.025)) - 1.0).abs() < 1e-13);
        // All of it off one sector would be 25 mm deep, where the tube ends after 19.05 mm.
        let mut sectors = vec![0.0; 12];
        sectors[5] = 8e6;
        assert!(law(Bearing::Hole { gap: 2e-4 }).deepest(Growth::Even, &round(sectors)).is_nan());
    }

    #[test]
    fn the_deepest_part_is_the_deepest_of_all_sectors_or_flats() {
        let mut sectors = vec![1e4; 12];
        sectors[5] = 3e4;
        let hole = law(Bearing::Hole { gap: 2e-4 });
        let depths = hole.depths(Growth::Even, &round(sectors.clone()));
        assert_eq!((depths.len(), depths[5]), (12, hole.deepest(Growth::Even, &round(sectors))));
        assert!((depths[5] / depths[0] - 3.0).abs() < 1e-14);
        let work = WearWork { total: 3e4, sectors: vec![2.5e3; 12], walls: vec![2e4, 1e4] };
        let flat = law(Bearing::Flat).depths(Growth::Kept, &work);
        let wanted = [2e4, 1e4].map(|work| Bearing::Flat.depth(4e-13 * work, 0.025, 0.009_525).unwrap());
        assert_eq!(flat, wanted);
        // More than the tube at one flat; and nothing of a tube without a coefficient.
        let through = WearWork { walls: vec![1e12, 0.0], total: 1e12, ..work.clone() };
        assert!(law(Bearing::Flat).deepest(Growth::Flats, &through).is_nan());
        assert!(Archard { coefficient: None, ..hole }.depths(Growth::Even, &work).is_empty());
    }
}
