//! Methods by name, completed with settings of the case.

use super::Case;
use crate::error::{Error, Result};
use crate::scheme::{Method, Scheme};

impl Case {
    /// The method named `name`: `event`, `moreau-jean:theta=0.6` or `penalty`. A penalty without
    /// numbers gets those of the case's first law, and the case's integrator unless the name sets
    /// one.
    ///
    /// # Errors
    /// [`Error::Unknown`] or [`Error::Invalid`] for a name that is not a method.
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
