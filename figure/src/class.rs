//! Classes of a heat map.

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
}
