//! `[[vary]]` of a sweep file: keys that vary together, and their values.

use super::axis::Axis;
use super::follow::Follow;
use super::part::{MOST_WHOLE, Part};
use super::random::Normal;
use super::values::Values;
use crate::case::Value;
use crate::error::{Error, Result};
use toml::Spanned;

/// The axis that a table `[[vary]]` describes.
///
/// # Errors
/// [`Error::Invalid`] for a key that no case has, and values or factors that do not go together.
pub(super) fn axis(vary: &Part<'_>) -> Result<Axis> {
    let keys = match (vary.word("key"), vary.table.words("keys")) {
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
    let name = vary.word("name");
    let label = format!("[[vary]] {}", name.as_ref().unwrap_or(&keys[0]));
    let refuse =
        |what: &str, found: &str, expected: &str| Err(Error::invalid(format!("{label}: {what}"), found, expected));
    let log = match vary.word("scale").as_deref() {
        None | Some("linear") => false,
        Some("log") => true,
        Some(other) => return refuse("scale", &format!("{other:?}"), "\"linear\" or \"log\""),
    };
    let list = vary.table.get("values").map(|list| match list.get_ref() {
        Value::List(items) => items.iter().map(|item| vary.value(item)).collect::<Result<Vec<_>>>(),
        _ => Err(vary.source.error(list.span(), "`vary.values` is no list", "expected values = a list: [4e-3, 5e-3]")),
    });
    let (list, points) = (list.transpose()?, vary.whole_number("points", MOST_WHOLE)?);
    let ([from, to], normal) = (["from", "to"].map(|key| vary.number(key)), vary.table.section("normal"));
    let values = match (list, from, to, points, normal) {
        (Some(values), None, None, None, None) => Values::List(values),
        (None, Some(from), Some(to), Some(points), None) if log => Values::Log { from, to, points },
        (None, Some(from), Some(to), Some(points), None) => Values::Linear { from, to, points },
        (None, Some(from), Some(to), None, None) => Values::Range { from, to, log },
        (None, None, None, None, Some(normal)) => {
            let [mean, deviation] = ["mean", "deviation"].map(|key| normal.required(key).into_inner());
            let [least, most] = ["least", "most"].map(|key| normal.number(key).map(Spanned::into_inner));
            Values::Normal(Normal { mean, deviation, least, most })
        }
        _ => {
            let expected =
                "values = [..]; or from, to and points; with [random] from and to, or normal = { mean, deviation }";
            return refuse("values", "none, or several kinds of them", expected);
        }
    };
    let factors = vary.table.numbers("factors");
    let factors: Vec<f64> = match factors {
        Some(list) => list.into_inner().into_iter().map(Spanned::into_inner).collect(),
        None => vec![1.0; keys.len()],
    };
    if factors.len() != keys.len() {
        return refuse("factors", &format!("{} for {} keys", factors.len(), keys.len()), "one factor a key");
    }
    let targets =
        keys.iter().zip(factors).map(|(key, factor)| Ok((key.parse()?, factor))).collect::<Result<Vec<_>>>()?;
    let follow = vary.word("follow").map_or(Ok(Follow::No), |word| word.parse())?;
    Ok(Axis { targets, name, values, follow })
}
