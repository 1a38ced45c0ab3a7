//! Methods by name, with what the case says of them.

use super::Case;
use crate::error::{Error, Result};
use crate::scheme::{Method, Scheme};

impl Case {
    /// The method that the word `name` asks for, `event`, `moreau-jean:theta=0.6` or `penalty`: a penalty without numbers has those of the case's
    /// first law, and its integrator unless the word names one.
    ///
    /// # Errors
    /// [`Error::Unknown`] or [`Error::Invalid`] for a word that names none.
    pub fn method(&self, name: &str) -> Result<Method> {
        let name = name.trim();
        let penalty = name == "penalty" || name.starts_with("penalty:");
        let mut method: Method = if penalty && !name.contains("epsilon=") && !name.contains("stiffness=") {
            let law = self.penalty.laws.first().ok_or_else(|| {
                let expected = "an --epsilon, or a case with a [penalty] table, or penalty:stiffness=…";
                Error::invalid("scheme", "penalty", expected)
            })?;
            let settings = name.strip_prefix("penalty:").unwrap_or("");
            format!("penalty:{law},{settings}").parse()?
        } else {
            name.parse()?
        };
        if let Scheme::Penalty { integrator, .. } = &mut method.scheme
            && !name.contains("integrator=")
        {
            *integrator = self.penalty.integrator.unwrap_or_default();
        }
        Ok(method)
    }
}
