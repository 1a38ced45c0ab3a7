//! The status of a row.

use crate::error::{Error, names};

/// The status of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// It ran to its end, and the judge checked its steps.
    Ok,
    /// It ran to its end; its steps were not checked.
    Unjudged,
    /// It ran to its end, but in a stretch of impacts moreau-jean replaced the exact scheme.
    Handed,
    /// Its values give no valid case.
    Invalid,
    /// The exact scheme met more contact events than it follows.
    TooManyEvents,
    /// The state became infinite or NaN.
    NotFinite,
    /// It is far faster than its start and its loads allow, and ended there.
    Diverged,
    /// A step was not solved: the quadratic programme, or Newton's method.
    NotSolved,
    /// The judge found that the scheme violated what it promises.
    Refuted,
    /// Some realisations of its random loads have no valid measures, and its means are over the
    /// others; or its interval needs more than were allowed.
    Partial,
    /// It failed in another way.
    Failed,
}

names!(Status,
    Ok => "ok", Unjudged => "unjudged", Handed => "handed", Invalid => "invalid", TooManyEvents => "too-many-events",
    NotFinite => "not-finite", Diverged => "diverged", NotSolved => "not-solved", Refuted => "refuted",
    Partial => "partial", Failed => "failed");

impl Status {
    /// True for a row whose measures are valid.
    #[must_use]
    pub fn is_good(self) -> bool {
        matches!(self, Self::Ok | Self::Unjudged | Self::Handed)
    }

    /// The same for its word in a table.
    pub(super) fn is_good_word(word: &str) -> bool {
        [Self::Ok, Self::Unjudged, Self::Handed].iter().any(|status| status.name() == word)
    }

    pub(super) fn of(error: &Error) -> Self {
        match error {
            Error::TooManyEvents { .. } => Self::TooManyEvents,
            Error::NotFinite { .. } => Self::NotFinite,
            Error::Diverged { .. } => Self::Diverged,
            Error::Qp { .. } | Error::Newton { .. } => Self::NotSolved,
            Error::Refuted { .. } => Self::Refuted,
            error if error.is_request() => Self::Invalid,
            _ => Self::Failed,
        }
    }
}
