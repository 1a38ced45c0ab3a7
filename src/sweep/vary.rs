//! `[[vary]]` of a sweep file: keys that vary together, and their values.

use super::axis::{Axis, Values};
use super::follow::Follow;
use super::random::Normal;
use crate::case::KeyValue;
use crate::error::{Error, Result};
use serde::Deserialize;

/// The table.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Vary {
    key: Option<String>,
    keys: Option<Vec<String>>,
    factors: Option<Vec<f64>>,
    name: Option<String>,
    values: Option<Vec<toml::Value>>,
    from: Option<f64>,
    to: Option<f64>,
    points: Option<u64>,
    scale: Option<String>,
    normal: Option<NormalTable>,
    follow: Option<String>,
}

/// Its key `normal`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct NormalTable {
    mean: f64,
    deviation: f64,
    least: Option<f64>,
    most: Option<f64>,
}

impl Vary {
    /// The axis that it describes.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a key that no case has, and values or factors that do not go
    /// together.
    pub(super) fn axis(self) -> Result<Axis> {
        let keys = match (self.key, self.keys) {
            (Some(key), None) => vec![key],
            (None, Some(keys)) if !keys.is_empty() => keys,
            _ => {
                return Err(Error::invalid(
                    "[[vary]]",
                    "no key, or both key and keys",
                    "key = \"…\", or keys = [\"…\", \"…\"] that are tied",
                ));
            }
        };
        let label = format!("[[vary]] {}", self.name.as_ref().unwrap_or(&keys[0]));
        let refuse =
            |what: &str, found: &str, expected: &str| Err(Error::invalid(format!("{label}: {what}"), found, expected));
        let log = match self.scale.as_deref() {
            None | Some("linear") => false,
            Some("log") => true,
            Some(other) => return refuse("scale", &format!("{other:?}"), "\"linear\" or \"log\""),
        };
        let values = match (self.values, self.from, self.to, self.points, self.normal) {
            (Some(values), None, None, None, None) => {
                Values::List(values.into_iter().map(KeyValue::from_toml).collect())
            }
            (None, Some(from), Some(to), Some(points), None) if log => Values::Log { from, to, points },
            (None, Some(from), Some(to), Some(points), None) => Values::Linear { from, to, points },
            (None, Some(from), Some(to), None, None) => Values::Range { from, to, log },
            (None, None, None, None, Some(NormalTable { mean, deviation, least, most })) => {
                Values::Normal(Normal { mean, deviation, least, most })
            }
            _ => {
                let expected =
                    "values = [..]; or from, to and points; with [random] from and to, or normal = { mean, deviation }";
                return refuse("values", "none, or several kinds of them", expected);
            }
        };
        let factors = self.factors.unwrap_or_else(|| vec![1.0; keys.len()]);
        if factors.len() != keys.len() {
            return refuse("factors", &format!("{} for {} keys", factors.len(), keys.len()), "one factor a key");
        }
        let targets =
            keys.iter().zip(factors).map(|(key, factor)| Ok((key.parse()?, factor))).collect::<Result<Vec<_>>>()?;
        let follow = self.follow.map_or(Ok(Follow::No), |word| word.parse())?;
        Ok(Axis { targets, name: self.name, values, follow })
    }
}
