//! Rows that start one from another.

use crate::error::{Error, Result, named};
use std::str::FromStr;

/// The direction in which the values of an axis are taken, if each row starts from the end of the
/// last one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Follow {
    /// None: every row starts from the case's initial state.
    #[default]
    No,
    /// Rising values, each row from the state at the end of the last one.
    Up,
    /// Falling values, each row from the state at the end of the last one.
    Down,
    /// Up, and then down again.
    Both,
}

impl Follow {
    /// The words for it in a sweep file.
    pub(super) const ALL: [(&'static str, Self); 4] =
        [("no", Self::No), ("up", Self::Up), ("down", Self::Down), ("both", Self::Both)];
}

impl FromStr for Follow {
    type Err = Error;

    fn from_str(word: &str) -> Result<Self> {
        named("direction to follow", word, Self::ALL)
    }
}
