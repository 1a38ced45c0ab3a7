//! Methods by name, completed with settings of the case.

use super::Case;
use crate::error::{Error, Result};
use crate::scheme::{Method, Scheme};

impl Case {
    /// The method named `name`: `event`, `moreau-jean:theta=0.6` or `penalty`. A penalty without
    /// numbers gets those of the case's first law, if any wall is rigid, and the case's integrator
    /// unless the name sets one.
    ///
    /// # Errors
    /// [`Error::Unknown`] or [`Error::Invalid`] for a name that is not a method.
    pub fn method(&self, name: &str) -> Result<Method> {
        let name = name.trim();
        let penalty = name == "penalty" || name.starts_with("penalty:");
        let numbers = name.contains("epsilon=") || name.contains("stiffness=");
        let rigid = self.scene.walls.iter().any(|wall| wall.law.is_rigid());
        let mut method: Method = if penalty && rigid && !numbers {
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

#[cfg(test)]
mod tests {
    use crate::case::CaseFile;

    #[test]
    fn a_penalty_without_numbers_needs_a_law_for_rigid_walls_only() {
        let case = |wall: &str| {
            let text = format!(
                "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 100.0\n[[wall]]\nname = \"w\"\n\
                 side = \"upper\"\nposition = 1e-3\n{wall}\n[time]\nend = 0.1\nstep = 1e-3\n"
            );
            CaseFile::from_text(&text, "case.toml", "").case().unwrap()
        };
        let elastic = case("stiffness = 1e5");
        for name in ["penalty", "penalty:integrator=implicit-euler"] {
            assert!(elastic.method(name).unwrap().to_string().starts_with("penalty"), "{name}");
            let error = case("restitution = 0.5").method(name).unwrap_err();
            assert!(error.to_string().contains("expected an --epsilon"), "{error}");
        }
    }
}
