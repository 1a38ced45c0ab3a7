//! Measures: the quantities computed for every row, by name.

use super::table::HALF_WIDTH;
use crate::error::{Error, Result, named};
use crate::output::csv;
use crate::scene::Scene;
use std::fmt;
use std::str::FromStr;

/// What a measure refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Each wall.
    Wall,
    /// Each support in two planes: a round hole, or flats around one place.
    Support,
    /// Each support, and each wall that is no flat of one: where forces add up.
    Place,
    /// Each probe.
    Probe,
    /// The whole row.
    Row,
}

impl Scope {
    /// What it refers to, in a word; `None` for the whole row.
    #[must_use]
    pub fn word(self) -> Option<&'static str> {
        match self {
            Self::Wall => Some("wall"),
            Self::Support => Some("support"),
            Self::Place => Some("place"),
            Self::Probe => Some("probe"),
            Self::Row => None,
        }
    }

    /// The names of the places of `scene` that it refers to; none for the whole row.
    #[must_use]
    pub fn places(self, scene: &Scene) -> Vec<&str> {
        match self {
            Self::Wall => scene.walls.iter().map(|wall| wall.name.as_str()).collect(),
            Self::Support => scene.supports.iter().map(|support| support.name.as_str()).collect(),
            Self::Place => {
                let alone = scene.walls.iter().enumerate().filter(|(wall, _)| scene.support_of(*wall).is_none());
                Self::Support.places(scene).into_iter().chain(alone.map(|(_, wall)| wall.name.as_str())).collect()
            }
            Self::Probe => scene.probes.iter().map(|probe| probe.name.as_str()).collect(),
            Self::Row => Vec::new(),
        }
    }
}

/// A column of a measure at a wall, a support, either of them or a probe.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct PlacedColumn {
    /// Its name, `work_rate_plate_1_W`.
    pub column: String,
    /// That name without the place, `work_rate_W`.
    pub quantity: String,
    /// The place, `plate-1`.
    pub place: String,
}

/// One measure of a row: one column per wall, per support, per probe, or per row.
///
/// All measures refer to one window, from `statistics_from`, or the end of `settle`, to the end.
/// Where [`Statistics`](crate::Statistics) has the same quantity, they are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Measure {
    /// Number of contact episodes that began in the window.
    Contacts,
    /// Number of them that are impacts, without duration.
    Impacts,
    /// Contacts per second.
    ContactRate,
    /// Share of the window in contact.
    ContactTimeRatio,
    /// Impulse of the wall on the body over the window, N s, signed.
    Impulse,
    /// Mean, largest and root mean square of |impulse| over episodes, N s.
    ImpulseMean,
    /// Largest |impulse| of an episode, N s.
    ImpulseMax,
    /// Root mean square of the impulse over episodes, N s.
    ImpulseRms,
    /// Mean of |force| over time, N: at a support of the normal force of all its walls.
    ForceMean,
    /// Root mean square of the force over time, N: at a support with its friction
    /// ([`SupportForce`](crate::SupportForce)), at a wall by
    /// [`ForceStatistics`](crate::ForceStatistics).
    ForceRms,
    /// Largest |force|, N: at elastic walls and supports at an instant, at rigid ones the largest
    /// mean over any stretch of `force_averaging`; see [`LargestForce`](crate::LargestForce).
    ForceLargest,
    /// Mean over episodes of the largest |force|, N, over those whose force is finite.
    PeakForceMean,
    /// Largest of them, N.
    PeakForceMax,
    /// Kinetic energy on arrival at the wall per time, W.
    ImpactPower,
    /// The same minus the kinetic energy on departure, W.
    ArrivedLessDepartedPower,
    /// Mean speed towards the wall at the start of an episode, m/s.
    ApproachSpeedMean,
    /// Largest of them, m/s.
    ApproachSpeedMax,
    /// Smallest of them, m/s; 0 at a grazing contact.
    ApproachSpeedLeast,
    /// Work of wear ∫ F_n |v_t| dt per time, W; see [`WearStatistics`](crate::WearStatistics).
    WorkRate,
    /// Share of that work that impacts did.
    ImpactShare,
    /// Distance slid in contact per time, m/s.
    SlidingRate,
    /// What friction takes out of the motion per time, W.
    FrictionPower,
    /// Volume worn off the tube within the service of the case, m³, by Archard's law.
    WornVolume,
    /// Volume worn off the support within the service of the case, m³, by the same law.
    SupportWornVolume,
    /// Depth on the tube where it is deepest, in a sector or at a flat, m.
    DepthDeepest,
    /// Depth on the tube if all of it comes off one scar, m.
    DepthOneScar,
    /// Depth on the tube if it comes off evenly all round, m.
    DepthAllRound,
    /// Largest |u|, m.
    DisplacementMax,
    /// Highest u, m.
    DisplacementHighest,
    /// Lowest u, m.
    DisplacementLowest,
    /// Root mean square of u over time, m.
    DisplacementRms,
    /// Largest |u̇|, m/s.
    VelocityMax,
    /// Impacts at all walls over forcing periods.
    ImpactsPerPeriod,
    /// The smallest number of forcing periods after which the motion repeats itself; the cell is
    /// empty if there is none up to 32.
    Period,
    /// Growth of a change of the start over the window, 1/s: the largest Lyapunov exponent of a
    /// long one, −∞ for one degree of freedom that rests on a wall; by the scheme `event`.
    Lyapunov,
    /// Its standard error, 1/s; see [`Exponent`](crate::variation::Exponent).
    LyapunovError,
    /// The number of the attractor that the start leads to, see
    /// [`attractor`](crate::study::attractor); the cell is empty where that was not decided.
    Attractor,
}

/// Name, scope, and unit as column names write it.
const MEASURES: [(Measure, &str, Scope, Option<&str>); 37] = [
    (Measure::Contacts, "contacts", Scope::Wall, None),
    (Measure::Impacts, "impacts", Scope::Wall, None),
    (Measure::ContactRate, "contact_rate", Scope::Wall, Some("per_s")),
    (Measure::ContactTimeRatio, "contact_time_ratio", Scope::Wall, None),
    (Measure::Impulse, "impulse", Scope::Wall, Some("N_s")),
    (Measure::ImpulseMean, "impulse_mean", Scope::Wall, Some("N_s")),
    (Measure::ImpulseMax, "impulse_max", Scope::Wall, Some("N_s")),
    (Measure::ImpulseRms, "impulse_rms", Scope::Wall, Some("N_s")),
    (Measure::ForceMean, "force_mean", Scope::Place, Some("N")),
    (Measure::ForceRms, "force_rms", Scope::Place, Some("N")),
    (Measure::ForceLargest, "force_largest", Scope::Place, Some("N")),
    (Measure::PeakForceMean, "peak_force_mean", Scope::Wall, Some("N")),
    (Measure::PeakForceMax, "peak_force_max", Scope::Wall, Some("N")),
    (Measure::ImpactPower, "impact_power", Scope::Wall, Some("W")),
    (Measure::ArrivedLessDepartedPower, "arrived_less_departed_power", Scope::Wall, Some("W")),
    (Measure::ApproachSpeedMean, "approach_speed_mean", Scope::Wall, Some("m_per_s")),
    (Measure::ApproachSpeedMax, "approach_speed_max", Scope::Wall, Some("m_per_s")),
    (Measure::ApproachSpeedLeast, "approach_speed_least", Scope::Wall, Some("m_per_s")),
    (Measure::WorkRate, "work_rate", Scope::Support, Some("W")),
    (Measure::ImpactShare, "impact_share", Scope::Support, None),
    (Measure::SlidingRate, "sliding_rate", Scope::Support, Some("m_per_s")),
    (Measure::FrictionPower, "friction_power", Scope::Support, Some("W")),
    (Measure::WornVolume, "worn_volume", Scope::Support, Some("m3")),
    (Measure::SupportWornVolume, "support_worn_volume", Scope::Support, Some("m3")),
    (Measure::DepthDeepest, "depth_deepest", Scope::Support, Some("m")),
    (Measure::DepthOneScar, "depth_one_scar", Scope::Support, Some("m")),
    (Measure::DepthAllRound, "depth_all_round", Scope::Support, Some("m")),
    (Measure::DisplacementMax, "displacement_max", Scope::Probe, Some("m")),
    (Measure::DisplacementHighest, "displacement_highest", Scope::Probe, Some("m")),
    (Measure::DisplacementLowest, "displacement_lowest", Scope::Probe, Some("m")),
    (Measure::DisplacementRms, "displacement_rms", Scope::Probe, Some("m")),
    (Measure::VelocityMax, "velocity_max", Scope::Probe, Some("m_per_s")),
    (Measure::ImpactsPerPeriod, "impacts_per_period", Scope::Row, None),
    (Measure::Period, "period", Scope::Row, None),
    (Measure::Lyapunov, "lyapunov", Scope::Row, Some("per_s")),
    (Measure::LyapunovError, "lyapunov_error", Scope::Row, Some("per_s")),
    (Measure::Attractor, "attractor", Scope::Row, None),
];

impl Measure {
    /// Every measure, in the order of the documentation.
    pub fn all() -> impl Iterator<Item = Self> {
        MEASURES.iter().map(|entry| entry.0)
    }

    fn entry(self) -> (&'static str, Scope, Option<&'static str>) {
        let entry = MEASURES.iter().find(|entry| entry.0 == self);
        entry.map_or(("", Scope::Row, None), |&(_, name, scope, unit)| (name, scope, unit))
    }

    /// Its name, for example `impulse_mean`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.entry().0
    }

    /// What it refers to.
    #[must_use]
    pub fn scope(self) -> Scope {
        self.entry().1
    }

    /// Its unit as in column names, for example `N_s`; empty for a dimensionless number.
    #[must_use]
    pub fn unit(self) -> Option<&'static str> {
        self.entry().2
    }

    /// Its columns in a table of rows of `scene`: `impulse_mean_upper_N_s`.
    #[must_use]
    pub fn columns(self, scene: &Scene) -> Vec<String> {
        self.columns_with("", scene)
    }

    /// The columns of the half widths of the intervals of its means.
    pub(super) fn half_width_columns(self, scene: &Scene) -> Vec<String> {
        self.columns_with(HALF_WIDTH, scene)
    }

    /// The columns of `realisations.csv` with the depths of all parts of each support, of which the
    /// measure is the deepest; none of another measure.
    pub(super) fn depths_columns(self, scene: &Scene) -> Vec<String> {
        self.columns(scene).iter().filter_map(|column| depths_column(column)).collect()
    }

    /// The columns, whose names have `word` after that of the measure.
    fn columns_with(self, word: &str, scene: &Scene) -> Vec<String> {
        // The probe of one degree of freedom has no name.
        let of = |name: &String| if name.is_empty() { String::new() } else { format!("_{name}") };
        let of: Vec<String> = match self.scope() {
            Scope::Row => vec![String::new()],
            scope => csv::words(&scope.places(scene)).iter().map(of).collect(),
        };
        of.iter().map(|of| self.column_of(word, of)).collect()
    }

    /// The column whose name has `word` and then `of` after that of the measure.
    fn column_of(self, word: &str, of: &str) -> String {
        let unit = self.unit().map_or_else(String::new, |unit| format!("_{unit}"));
        format!("{}{word}{of}{unit}", self.name())
    }

    /// Its columns in all tables of a sweep over `scene` that belong to a place: those of the
    /// measure, of half widths, and of the depths of all parts of each support. None of a measure
    /// of the whole row.
    #[must_use]
    pub fn placed_columns(self, scene: &Scene) -> Vec<PlacedColumn> {
        let own = ["", HALF_WIDTH].map(|word| (self.columns_with(word, scene), Some(self.column_of(word, ""))));
        let depths = (self.depths_columns(scene), depths_column(&self.column_of("", "")));
        let mut placed = Vec::new();
        for (columns, quantity) in own.into_iter().chain([depths]) {
            for (column, place) in columns.into_iter().zip(self.scope().places(scene)) {
                let quantity = quantity.clone().unwrap_or_default();
                placed.push(PlacedColumn { column, quantity, place: place.to_owned() });
            }
        }
        placed
    }

    /// True for a measure of the motion between contacts.
    pub(super) fn sees_motion(self) -> bool {
        self.scope() == Scope::Probe
    }

    /// True for a measure that counts forcing periods.
    pub(super) fn needs_period(self) -> bool {
        matches!(self, Self::ImpactsPerPeriod | Self::Period | Self::Attractor)
    }

    /// True for a measure of the growth of a change of the start.
    pub(super) fn sees_growth(self) -> bool {
        matches!(self, Self::Lyapunov | Self::LyapunovError)
    }

    /// True for a measure that takes the derivative with respect to the start, which only the
    /// scheme `event` has.
    pub(super) fn needs_event(self) -> bool {
        self.sees_growth() || self == Self::Attractor
    }

    /// True for a measure of the force over time.
    pub(super) fn sees_force(self) -> bool {
        matches!(self, Self::Impulse | Self::ForceMean | Self::ForceRms | Self::ForceLargest)
    }

    /// True for a measure of what slides at a support.
    pub(super) fn sees_sliding(self) -> bool {
        matches!(self, Self::WorkRate | Self::ImpactShare | Self::SlidingRate | Self::FrictionPower) || self.needs_law()
    }

    /// True for the depth of a scar, which a slider does not have.
    pub(super) fn needs_scar(self) -> bool {
        matches!(self, Self::DepthDeepest | Self::DepthOneScar | Self::DepthAllRound)
    }

    /// True for a measure that takes the law of wear of the case.
    pub(super) fn needs_law(self) -> bool {
        matches!(self, Self::WornVolume | Self::SupportWornVolume) || self.needs_scar()
    }
}

/// The column with the depths of all parts of the support of which `column` has the deepest; `None`
/// of another measure.
pub(super) fn depths_column(column: &str) -> Option<String> {
    column.strip_prefix(Measure::DepthDeepest.name()).map(|place| format!("depths{place}"))
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Measure {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        named("measure", name, MEASURES.iter().map(|entry| (entry.1, entry.0)))
    }
}
