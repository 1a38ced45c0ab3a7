//! What happens at the special points of branches.

use super::point::Point;
use crate::error::names;

/// A special point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Label {
    /// The branch turns back in the key: two orbits meet (a multiplier 1).
    Fold,
    /// A branch of twice the period begins (a multiplier −1).
    PeriodDoubling,
    /// Two orbits that are not symmetric, each the mirror image of the other, branch off a
    /// symmetric one (a multiplier −1 of the half map, 1 of the whole).
    SymmetryBreaking,
    /// Another branch crosses (a multiplier 1); only for structures.
    BranchPoint,
    /// A pair of complex multipliers crosses the unit circle: a quasi-periodic motion begins; only
    /// for structures.
    NeimarkSacker,
    /// The speed of an impact of the orbit has become 0: the orbits beyond lack this impact.
    GrazingOut,
    /// The orbit touches another wall, or a wall once more, at speed 0: the orbits beyond have one
    /// more event.
    GrazingIn,
    /// After an impact with e = 0 the body is not pulled off its wall any more: a rest begins.
    RestBegins,
    /// The duration of a rest has become 0.
    RestEnds,
    /// The duration of a contact with an elastic wall has become 0; or a pause of duration 0 within
    /// one begins, or, where the wall has a dashpot, a push of duration 0.
    ContactEnds,
    /// Two events coincide: what follows depends on which of them is first.
    Corner,
}

names!(Label,
    Fold => "fold", PeriodDoubling => "period-doubling", SymmetryBreaking => "symmetry-breaking",
    BranchPoint => "branch-point", NeimarkSacker => "neimark-sacker", GrazingOut => "grazing-out",
    GrazingIn => "grazing-in", RestBegins => "rest-begins", RestEnds => "rest-ends",
    ContactEnds => "contact-ends", Corner => "corner");

impl Label {
    /// Those that can be followed in the plane of two keys.
    pub const WITH_LOCUS: [Self; 5] =
        [Self::Fold, Self::PeriodDoubling, Self::SymmetryBreaking, Self::GrazingIn, Self::GrazingOut];

    /// The wall at which it happens, to event number `event` of `point`.
    pub(super) fn wall(self, event: usize, point: &Point) -> Option<usize> {
        match self {
            _ if !self.ends() => None,
            Self::GrazingIn => point.admissible.nearest.map(|nearest| nearest.wall),
            _ => point.orbit.signature.events.get(event).map(|event| event.wall),
        }
    }

    /// True where the branch ends: no body follows the orbits beyond.
    #[must_use]
    pub fn ends(self) -> bool {
        use Label::{BranchPoint, Fold, NeimarkSacker, PeriodDoubling, SymmetryBreaking};
        !matches!(self, Fold | PeriodDoubling | SymmetryBreaking | BranchPoint | NeimarkSacker)
    }
}
