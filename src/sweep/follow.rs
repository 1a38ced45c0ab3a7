//! Rows that start one from another.

use crate::error::names;

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

names!(Follow: "direction to follow", No => "no", Up => "up", Down => "down", Both => "both");
