//! Classes of a heat map.

use super::tone::TONES;

/// One class of a map: its name in the legend, its letter on the map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Class {
    /// Name in the legend.
    pub name: String,
    /// Letter drawn on its regions where they are large enough.
    pub letter: char,
}

impl Class {
    /// A class.
    pub fn new(name: impl Into<String>, letter: char) -> Self {
        Self { name: name.into(), letter }
    }

    /// The colour (`#rrggbb`) with which a map fills the class at this place of its list; grey for
    /// one that a map has no colour for.
    #[must_use]
    pub fn fill(place: usize) -> &'static str {
        TONES.get(place).map_or("#808080", |(fill, _)| fill)
    }
}
