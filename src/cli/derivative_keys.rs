//! The keys of `--derivative`.

use crate::case::{Case, Key};
use crate::error::{Error, Result};
use crate::output::effects::Varied;
use crate::variation::SceneTangent;

/// The keys of these names in `case`, and the derivatives of its scene by them.
///
/// # Errors
/// [`Error::Invalid`] for a key that is asked for twice; as [`Case::tangent`].
pub(super) fn varied(case: &Case, names: &[String]) -> Result<(Vec<Varied>, Vec<SceneTangent>)> {
    let (mut keys, mut tangents): (Vec<Varied>, Vec<SceneTangent>) = (Vec::new(), Vec::new());
    for name in names {
        let key: Key = name.parse()?;
        if keys.iter().any(|other| other.key == key.to_string()) {
            let found = format!("{key}, for the second time");
            return Err(Error::invalid("--derivative", found, "each key once"));
        }
        let tangent = case.tangent(&key)?;
        keys.push(Varied { key: key.to_string(), value: tangent.value(), unit: key.unit(), error: tangent.error() });
        tangents.push(tangent);
    }
    Ok((keys, tangents))
}
