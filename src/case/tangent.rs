//! The derivative of the scene of a case with respect to a key.

use super::{Case, Key};
use crate::error::{Error, Result};
use crate::variation::SceneTangent;

impl Case {
    /// The derivative of the scene with respect to the number at `key` in the case file, or that
    /// which holds where the file leaves it out, through
    /// all that follows from it there: the matrices of a beam from its dimensions, the modes of a
    /// reduced structure, the forces of a random load with the same seed.
    ///
    /// ```
    /// use signorini::case::Case;
    ///
    /// let case = Case::embedded("rigid-walls-sine")?;
    /// let tangent = case.tangent(&"load.1.harmonic.amplitude".parse()?)?;
    /// assert!(tangent.error() < 1e-10);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for a key whose value is no number, or a whole one such as a count, or
    /// that the file leaves out where no number holds then; else as [`SceneTangent::new`].
    pub fn tangent(&self, key: &Key) -> Result<SceneTangent> {
        let name = key.to_string();
        if key.is_whole() {
            let expected = "a key that can change by any small amount";
            return Err(Error::invalid(format!("derivative by {name}"), "a whole number", expected));
        }
        let value = match self.document.get(key)? {
            Some(value) => value.number(),
            None => key.default_number(),
        };
        let Some(value) = value else {
            // A name that nothing in the file has says so.
            self.document.clone().set(key, &1.0.into())?;
            let expected = "a key that has a number in the case file or by default";
            return Err(Error::invalid(
                format!("derivative by {name}"),
                "left out, no number, or several that differ",
                expected,
            ));
        };
        SceneTangent::new(&name, value, |x| {
            let mut document = self.document.clone();
            document.set(key, &x.into())?;
            Ok(document.case()?.scene)
        })
    }
}
