//! What is estimated over realisations, and where.

use crate::statistics::{
    ContactPlace, LargestForce, PlaceKind, Statistics, SupportStatistics, WallStatistics, WearStatistics,
};
use serde::Serialize;

/// A quantity of a wall or a support that has a mean over realisations.
///
/// Not all of them converge as steps and modes are refined ([`Measure::converges`]): each further
/// mode and each smaller step resolves further small impacts, and the mass that a wall feels falls
/// as modes are added. These are shown beside what refinements make of them, and not judged. The
/// root mean square of impulse/h at a rigid wall grows without limit as h → 0:
/// [`Measure::ForceRms`] is that of the force averaged over
/// [`TimeOptions::force_averaging`](crate::TimeOptions::force_averaging).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Measure {
    /// Mean over time of |force|, Σ|p|/T; at a support that of all its flats together. N.
    ForceMean,
    /// Mean over time of a support's force on the structure along y, N.
    ForceMeanY,
    /// The same along z, N.
    ForceMeanZ,
    /// Root mean square of the force: at an elastic wall of the force itself, else averaged over
    /// intervals. N.
    ForceRms,
    /// Work of wear per unit time, W; of supports in two planes. Without friction it is an upper
    /// figure.
    WorkRate,
    /// What friction takes out of the motion per unit time, W; of supports with friction.
    FrictionPower,
    /// Largest |force| in the window, N: of an elastic wall or support at an instant, of a rigid
    /// one the largest mean over a stretch of
    /// [`TimeOptions::force_averaging`](crate::TimeOptions::force_averaging). It grows with the
    /// window.
    ForceLargest,
    /// The share of the work of wear that impacts do; of rigid supports in two planes. It need not
    /// converge.
    ImpactShare,
    /// Distance slid in contact per unit time, m/s; of supports in two planes. At rigid supports it
    /// need not converge, since impacts have none.
    SlidingRate,
    /// Number of contacts that begin in the window. It need not converge.
    Contacts,
    /// Power of the impacts at a wall, W. It need not converge.
    ImpactPower,
}

/// One quantity of one place in one realisation.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Figure {
    /// Where.
    pub place: ContactPlace,
    /// What.
    pub measure: Measure,
    /// Its value, in the unit of the measure.
    pub value: f64,
    /// Half width of its 95 % interval from the batches of the window; `None` where too few
    /// contacts began, and for extremes.
    pub batch_half_width_95: Option<f64>,
    /// The same over the first and over the second half of the window; `None` unless
    /// [`Measure::is_judged`].
    pub halves: Option<[f64; 2]>,
}

/// A value, the half width of its interval by batches, and its values over the halves of the
/// window.
type Found = (f64, Option<f64>, Option<[f64; 2]>);

impl Measure {
    /// All of them, in the order of tables.
    pub const ALL: [Self; 11] = [
        Self::ForceMean,
        Self::ForceMeanY,
        Self::ForceMeanZ,
        Self::ForceRms,
        Self::WorkRate,
        Self::FrictionPower,
        Self::ForceLargest,
        Self::ImpactShare,
        Self::SlidingRate,
        Self::Contacts,
        Self::ImpactPower,
    ];

    /// Its name in tables and documents, that of the same measure of sweeps where there is one.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ForceMean => "force_mean",
            Self::ForceMeanY => "force_mean_y",
            Self::ForceMeanZ => "force_mean_z",
            Self::ForceRms => "force_rms",
            Self::WorkRate => "work_rate",
            Self::FrictionPower => "friction_power",
            Self::ForceLargest => "force_largest",
            Self::ImpactShare => "impact_share",
            Self::SlidingRate => "sliding_rate",
            Self::Contacts => "contacts",
            Self::ImpactPower => "impact_power",
        }
    }

    /// Its name in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::ForceMean => "mean force",
            Self::ForceMeanY => "mean force along y",
            Self::ForceMeanZ => "mean force along z",
            Self::ForceRms => "RMS force",
            Self::WorkRate => "work rate",
            Self::FrictionPower => "friction power",
            Self::ForceLargest => "largest force",
            Self::ImpactShare => "impact share",
            Self::SlidingRate => "sliding rate",
            Self::Contacts => "contacts",
            Self::ImpactPower => "impact power",
        }
    }

    /// It and `place` in words.
    pub(super) fn at(self, place: &ContactPlace) -> String {
        format!("{} of {} {:?}", self.words(), place.kind.word(), place.name)
    }

    /// Its unit; empty for shares and numbers.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::WorkRate | Self::FrictionPower | Self::ImpactPower => "W",
            Self::SlidingRate => "m/s",
            Self::ImpactShare | Self::Contacts => "",
            Self::ForceMean | Self::ForceMeanY | Self::ForceMeanZ | Self::ForceRms | Self::ForceLargest => "N",
        }
    }

    /// True for those whose error is given in parts: work rate, mean force and RMS force.
    #[must_use]
    pub fn is_judged(self) -> bool {
        matches!(self, Self::WorkRate | Self::ForceMean | Self::ForceRms)
    }

    /// False for those that need not converge as steps and modes are refined.
    #[must_use]
    pub fn converges(self) -> bool {
        !matches!(self, Self::ImpactShare | Self::SlidingRate | Self::Contacts | Self::ImpactPower)
    }

    /// The value at a wall.
    fn of_wall(self, wall: &WallStatistics) -> Option<Found> {
        let force = wall.force?;
        match self {
            Self::ForceMean => Some((force.mean_n, force.mean_half_width_95_n, Some(force.mean_of_halves_n))),
            Self::ForceRms => Some((force.rms_n, force.rms_half_width_95_n, Some(force.rms_of_halves_n))),
            Self::ForceLargest => Some(largest(wall.force_largest)),
            Self::Contacts => Some((wall.contacts as f64, None, None)),
            Self::ImpactPower => Some((wall.impact_power_w, wall.half_width_95.map(|half| half.impact_power_w), None)),
            Self::ForceMeanY
            | Self::ForceMeanZ
            | Self::WorkRate
            | Self::FrictionPower
            | Self::ImpactShare
            | Self::SlidingRate => None,
        }
    }

    /// The value at a support, over a window of so many `seconds`.
    fn of_support(self, support: &SupportStatistics, wear: Option<&WearStatistics>, seconds: f64) -> Option<Found> {
        let force = support.force?;
        let vector =
            |axis: usize| (force.mean_vector_n[axis], force.mean_vector_half_width_95_n.map(|half| half[axis]), None);
        match self {
            Self::ForceMean => Some((force.mean_n, force.mean_half_width_95_n, Some(force.mean_of_halves_n))),
            Self::ForceMeanY => Some(vector(0)),
            Self::ForceMeanZ => Some(vector(1)),
            Self::ForceRms => Some((force.rms_n, force.rms_half_width_95_n, Some(force.rms_of_halves_n))),
            Self::WorkRate => {
                wear.map(|wear| (wear.work_rate_w, wear.work_rate_half_width_95_w, Some(wear.work_rate_of_halves_w)))
            }
            Self::FrictionPower => {
                wear.filter(|wear| wear.friction > 0.0).map(|wear| (wear.friction_power_w, None, None))
            }
            Self::ForceLargest => Some(largest(support.force_largest)),
            Self::ImpactShare => wear.and_then(|wear| Some((wear.impact_share?, None, None))),
            Self::SlidingRate => wear.map(|wear| (wear.sliding_m / seconds, None, None)),
            Self::Contacts => Some((support.contacts as f64, None, None)),
            Self::ImpactPower => None,
        }
    }
}

/// The largest force, 0 where nothing pushed.
fn largest(force: Option<LargestForce>) -> Found {
    (force.map_or(0.0, |force| force.mean_n), None, None)
}

/// Every measure of every place in `statistics`: supports, then walls, those of a support's flats
/// among them, in the scene's order.
pub(super) fn figures(statistics: &Statistics) -> Vec<Figure> {
    let seconds = statistics.to_s - statistics.from_s;
    let mut figures = Vec::new();
    let mut add = |name: &str, kind: PlaceKind, of: &dyn Fn(Measure) -> Option<Found>| {
        for measure in Measure::ALL {
            let place = || ContactPlace { name: name.to_owned(), kind };
            let figure =
                |(value, half, halves)| Figure { place: place(), measure, value, batch_half_width_95: half, halves };
            figures.extend(of(measure).map(figure));
        }
    };
    for support in &statistics.supports {
        let wear = statistics.wear.iter().find(|wear| wear.support == support.support);
        add(&support.support, PlaceKind::Support, &|measure| measure.of_support(support, wear, seconds));
    }
    for wall in statistics.walls.iter().filter(|wall| !wall.round) {
        add(&wall.wall, PlaceKind::Wall, &|measure| measure.of_wall(wall));
    }
    figures
}
