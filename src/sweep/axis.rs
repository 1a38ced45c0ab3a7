//! An axis of a sweep: one or several keys, tied to one another, over a list, a grid or a random
//! range.

use super::follow::Follow;
use super::layout::Layout;
use super::target::{Target, with_unit};
use super::values::Values;
use crate::case::KeyValue;
use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::scene::finite;

/// One dimension of a sweep.
///
/// ```
/// use signorini::sweep::{Axis, Follow};
///
/// let axis = Axis::linear("load.1.harmonic.frequency", 1.0, 10.0, 901)?.followed(Follow::Both);
/// let epsilon = Axis::log("penalty.epsilon.0", 1e-12, 1e-6, 7)?;
/// let words = Axis::list("run.scheme", &["event".into(), "moreau-jean".into()])?;
/// // Two walls, one gap: factors 1 and −1.
/// let gap = Axis::linear("wall.upper.position", 1e-3, 5e-3, 9)?.tied("wall.lower.position", -1.0)?;
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The keys that are changed, each to its factor times the value.
    pub(super) targets: Vec<(Target, f64)>,
    pub(super) name: Option<String>,
    pub(super) values: Values,
    pub(super) follow: Follow,
}

impl Axis {
    /// `values` for `key`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a key that does not exist.
    pub fn new(key: &str, values: Values) -> Result<Self> {
        Ok(Self { targets: vec![(key.parse()?, 1.0)], name: None, values, follow: Follow::No })
    }

    /// A list of values: numbers, words, or what else the key accepts.
    ///
    /// # Errors
    /// As [`Axis::new`].
    pub fn list(key: &str, values: &[KeyValue]) -> Result<Self> {
        Self::new(key, Values::List(values.to_vec()))
    }

    /// `points` values with equal differences.
    ///
    /// # Errors
    /// As [`Axis::new`].
    pub fn linear(key: &str, from: f64, to: f64, points: u64) -> Result<Self> {
        Self::new(key, Values::Linear { from, to, points })
    }

    /// `points` values with equal ratios.
    ///
    /// # Errors
    /// As [`Axis::new`].
    pub fn log(key: &str, from: f64, to: f64, points: u64) -> Result<Self> {
        Self::new(key, Values::Log { from, to, points })
    }

    /// The same axis, which also sets `key` to `factor` times the value.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a key that does not exist.
    pub fn tied(mut self, key: &str, factor: f64) -> Result<Self> {
        self.targets.push((key.parse()?, factor));
        Ok(self)
    }

    /// The same axis, named `name` in tables and figures.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.name = Some(name.to_owned());
        self
    }

    /// The same axis, whose values are taken in that direction, each row starting from the end of
    /// the last one.
    #[must_use]
    pub fn followed(mut self, follow: Follow) -> Self {
        self.follow = follow;
        self
    }

    /// Its name in messages and in the keys `x` and `y` of a figure.
    #[must_use]
    pub fn label(&self) -> String {
        let first = self.targets.first().map_or_else(String::new, |(target, _)| target.to_string());
        self.name.clone().unwrap_or(first)
    }

    /// The numbers of its values in the order of a chain (rows that start one from another), with
    /// the direction of each.
    pub(super) fn order(&self) -> Vec<(u64, Option<&'static str>)> {
        let mut up: Vec<u64> = (0..self.values.count()).collect();
        if self.follow == Follow::No {
            return up.into_iter().map(|index| (index, None)).collect();
        }
        let number = |index: u64| self.values.at(index, 0.0).number().unwrap_or(0.0);
        sort_by_number(&mut up, |a| number(*a));
        let rising = up.iter().map(|&index| (index, Some("up")));
        let falling = up.iter().rev().map(|&index| (index, Some("down")));
        match self.follow {
            Follow::Up => rising.collect(),
            Follow::Down => falling.collect(),
            _ => rising.chain(falling).collect(),
        }
    }

    /// Names of its columns: its own name if it has one and several keys, then one per key. With
    /// `whole`, the whole keys, to tell apart keys with the same last word.
    pub(super) fn columns(&self, whole: bool) -> Vec<String> {
        let unit = self.targets.first().and_then(|(target, _)| target.unit());
        match (&self.name, self.targets.as_slice()) {
            (Some(name), [_]) => vec![with_unit(&name.replace('-', "_"), unit)],
            (None, [(target, _)]) => vec![target.column(whole)],
            (name, targets) => {
                let own = name.as_ref().map(|name| with_unit(&name.replace('-', "_"), unit));
                own.into_iter().chain(targets.iter().map(|(target, _)| target.column(true))).collect()
            }
        }
    }

    /// The cells of its columns for `value`.
    pub(super) fn cells(&self, value: &KeyValue) -> Vec<KeyValue> {
        let own = (self.name.is_some() && self.targets.len() > 1).then(|| value.clone());
        own.into_iter().chain(self.settings(value).map(|(_, value)| value)).collect()
    }

    /// The keys, each with the value it is set to, for the axis value `value`.
    pub(super) fn settings<'a>(&'a self, value: &'a KeyValue) -> impl Iterator<Item = (&'a Target, KeyValue)> {
        self.targets.iter().map(move |(target, factor)| match value.number() {
            Some(x) if *factor != 1.0 => (target, (factor * x).into()),
            _ => (target, value.clone()),
        })
    }

    /// Checks the axis by itself, among points of that `layout`.
    pub(super) fn validate(&self, layout: Layout) -> Result<()> {
        let key = |what: &str| format!("[[vary]] {}: {what}", self.label());
        if let Some(name) = &self.name {
            let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            if name.is_empty() || !name.chars().all(fits) {
                return Err(Error::invalid(key("name"), format_args!("{name:?}"), "letters, digits, - and _"));
            }
        }
        for (target, factor) in &self.targets {
            if *factor != 1.0 && *target == Target::Scheme {
                return Err(Error::invalid(key("factors"), target, "no factors: the values are words"));
            }
            finite(key("factors"), *factor)?;
        }
        self.values.validate(&key)?;
        match layout {
            Layout::Random(_) if !self.values.is_drawn() => {
                let expected = "a range or a normal distribution, without points: [random] says how many";
                return Err(Error::invalid(key("points"), "given", expected));
            }
            Layout::OneAtATime if !matches!(self.values, Values::Range { .. }) => {
                let expected = "from and to alone (--vary KEY=FROM:TO), varied one at a time";
                return Err(Error::invalid(key("points, values or normal"), "given", expected));
            }
            Layout::Grid if self.values.is_drawn() => {
                let expected = "points or values beside it, a table [random] that draws them, or --one-at-a-time";
                return Err(Error::invalid(key("from and to"), "given alone", expected));
            }
            _ => {}
        }
        self.check_follow(layout != Layout::Grid, &key)
    }

    /// Refuses to follow values without an order.
    fn check_follow(&self, unordered: bool, key: &dyn Fn(&str) -> String) -> Result<()> {
        let (found, expected) = match self.values.word() {
            _ if self.follow == Follow::No => return Ok(()),
            _ if unordered => ("given".to_owned(), "no follow in a design whose rows have no order"),
            Some(word) => (format!("given for {word}"), "numbers: words have no order"),
            None => return Ok(()),
        };
        Err(Error::invalid(key("follow"), found, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(axis: &Axis) -> Vec<f64> {
        (0..axis.values.count()).map(|index| axis.values.at(index, 0.0).number().unwrap()).collect()
    }

    #[test]
    fn grids_are_exact_at_both_ends_and_even_between() {
        let axis = Axis::linear("time.step", 0.1, 0.7, 7).unwrap();
        let values = numbers(&axis);
        assert_eq!((values[0], values[6]), (0.1, 0.7));
        assert!(values.windows(2).all(|pair| (pair[1] - pair[0] - 0.1).abs() < 1e-15));
        let values = numbers(&Axis::log("time.step", 1e-6, 1e-2, 5).unwrap());
        assert_eq!((values[0], values[4]), (1e-6, 1e-2));
        assert!(values.windows(2).all(|pair| (pair[1] / pair[0] / 10.0 - 1.0).abs() < 1e-13));
    }

    #[test]
    fn a_followed_axis_goes_up_and_down_whatever_the_order_of_the_file() {
        let list = [3.0, 1.0, 2.0].map(KeyValue::from);
        let axis = Axis::list("time.step", &list).unwrap().followed(Follow::Both);
        let order: Vec<_> = axis
            .order()
            .into_iter()
            .map(|(index, direction)| (list[index as usize].number().unwrap(), direction.unwrap()))
            .collect();
        assert_eq!(order, [(1.0, "up"), (2.0, "up"), (3.0, "up"), (3.0, "down"), (2.0, "down"), (1.0, "down")]);
    }

    #[test]
    fn tied_keys_have_a_column_each_and_a_factor() {
        let axis =
            Axis::linear("wall.upper.position", 1.0, 2.0, 2).unwrap().tied("wall.lower-2.position", -1.0).unwrap();
        assert_eq!(axis.columns(false), ["wall_upper_position_m", "wall_lower_2_position_m"]);
        assert_eq!(axis.cells(&1.5.into()), [1.5.into(), (-1.5).into()]);
        let named = axis.named("gap");
        assert_eq!(named.columns(false)[0], "gap_m");
        assert_eq!(named.cells(&1.5.into()).len(), 3);
    }
}
