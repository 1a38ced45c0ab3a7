//! The values of an axis of a sweep.

use super::random::Normal;
use crate::case::KeyValue;
use crate::error::{Error, Result};
use crate::scene::finite;

/// The values of an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// A list.
    List(Vec<KeyValue>),
    /// Equal differences between neighbours.
    Linear {
        /// First.
        from: f64,
        /// Last.
        to: f64,
        /// How many, two or more.
        points: u64,
    },
    /// Equal ratios between neighbours; the first and the last value are above 0.
    Log {
        /// First.
        from: f64,
        /// Last.
        to: f64,
        /// How many, two or more.
        points: u64,
    },
    /// Drawn from a uniform distribution between two bounds, of the value or of its logarithm, by a
    /// [`Random`](super::Random) design.
    Range {
        /// Lower bound.
        from: f64,
        /// Upper bound.
        to: f64,
        /// True if the logarithm is uniformly distributed.
        log: bool,
    },
    /// Drawn from a normal distribution, by a [`Random`](super::Random) design.
    Normal(Normal),
}

/// The value of a grid as a person would type it: the number of at most 12 digits next to `x`,
/// where the two differ only by the rounding of numbers of size `scale`, from which `x` was
/// computed.
fn typed(x: f64, scale: f64) -> f64 {
    let rounding = 4.0 * f64::EPSILON * scale;
    if x.abs() <= rounding {
        return 0.0;
    }
    let near: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    if (near - x).abs() <= rounding { near } else { x }
}

impl Values {
    /// True if a random design draws its values.
    pub(super) fn is_drawn(&self) -> bool {
        matches!(self, Self::Range { .. } | Self::Normal(_))
    }

    /// The values in words, by which requests are told apart.
    pub(super) fn described(&self) -> String {
        match self {
            Self::List(list) => format!("[{}]", list.iter().map(KeyValue::to_string).collect::<Vec<_>>().join(", ")),
            other => format!("{other:?}"),
        }
    }

    /// Number of its values; 1 if they are drawn.
    pub(super) fn count(&self) -> u64 {
        match self {
            Self::List(list) => list.len() as u64,
            Self::Linear { points, .. } | Self::Log { points, .. } => *points,
            Self::Range { .. } | Self::Normal(_) => 1,
        }
    }

    /// Value number `index`; for drawn values, the quantile of `share`, from 0
    /// to 1.
    pub(super) fn at(&self, index: u64, share: f64) -> KeyValue {
        // Both ends are exact.
        let between = |from: f64, to: f64, points: u64| match index {
            0 => from,
            i if i + 1 >= points => to,
            i => from + (to - from) * (i as f64 / (points - 1) as f64),
        };
        match self {
            Self::List(list) => list.get(index as usize).cloned().unwrap_or_else(|| KeyValue::from(f64::NAN)),
            Self::Linear { from, to, points } => typed(between(*from, *to, *points), from.abs().max(to.abs())).into(),
            Self::Log { from, to, points } if index == 0 || index + 1 >= *points => between(*from, *to, *points).into(),
            Self::Log { from, to, points } => {
                let value = between(from.ln(), to.ln(), *points).exp();
                typed(value, value * from.ln().abs().max(to.ln().abs()).max(1.0)).into()
            }
            Self::Range { from, to, log: false } => (from + (to - from) * share).into(),
            Self::Range { from, to, log: true } => {
                (from.ln() + (to.ln() - from.ln()) * share).exp().clamp(*from, *to).into()
            }
            Self::Normal(normal) => normal.at(share).into(),
        }
    }

    /// The first value that is a word.
    pub(super) fn word(&self) -> Option<&KeyValue> {
        if let Self::List(list) = self { list.iter().find(|value| value.number().is_none()) } else { None }
    }

    /// Checks the values; `key` names a key of theirs in messages.
    pub(super) fn validate(&self, key: &dyn Fn(&str) -> String) -> Result<()> {
        match self {
            Self::List(list) if list.is_empty() => {
                Err(Error::invalid(key("values"), "an empty list", "one value or more"))
            }
            Self::List(_) => Ok(()),
            Self::Linear { from, to, points } => grid(key, *from, *to, *points),
            Self::Log { from, to, points } => {
                grid(key, *from, *to, *points)?;
                above_zero(key, from.min(*to))
            }
            Self::Range { from, to, log } => {
                finite(key("from"), *from)?;
                finite(key("to"), *to)?;
                if from >= to {
                    return Err(Error::invalid(key("to"), format_args!("{to:?}"), format!("more than from, {from:?}")));
                }
                if *log { above_zero(key, *from) } else { Ok(()) }
            }
            Self::Normal(normal) => normal.validate(&key("normal")),
        }
    }
}

fn grid(key: &dyn Fn(&str) -> String, from: f64, to: f64, points: u64) -> Result<()> {
    finite(key("from"), from)?;
    finite(key("to"), to)?;
    if from == to {
        let expected = "a number other than from: the range is empty";
        return Err(Error::invalid(key("to"), format_args!("{to:?}"), expected));
    }
    if points < 2 {
        return Err(Error::invalid(key("points"), points, "2 or more; a single value is a list"));
    }
    Ok(())
}

fn above_zero(key: &dyn Fn(&str) -> String, least: f64) -> Result<()> {
    if least > 0.0 {
        return Ok(());
    }
    Err(Error::invalid(key("from"), format_args!("{least:?}"), "a number above 0 on a logarithmic scale"))
}
