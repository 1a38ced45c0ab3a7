//! The table `[penalty]`.

use crate::error::{Error, Result, Subject};
use crate::scene::Scene;
use crate::scheme::{Integrator, PenaltyLaw, check_some_scheme};

/// The springs that replace the rigid walls in penalty runs. Elastic walls stay as they are.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PenaltyOptions {
    /// The laws, in the order of the file; a comparison makes one run with each. Empty if the case
    /// has none.
    pub laws: Vec<PenaltyLaw>,
    /// The integrator; `None` where the case leaves it to the scheme.
    pub integrator: Option<Integrator>,
}

impl PenaltyOptions {
    /// The same; where none is given and a wall of `scene` has a law that only penalties step, the
    /// penalty without a spring.
    pub(super) fn of(mut self, scene: &Scene) -> Self {
        if self.laws.is_empty() && scene.nonlinear_wall().is_some() {
            self.laws.push(PenaltyLaw::None);
        }
        self
    }

    /// Checks every law against the walls and holes of `scene`.
    ///
    /// # Errors
    /// [`Error::Invalid`] whose subject is a part of the `penalty law` of that number.
    pub fn validate(&self, scene: &Scene) -> Result<()> {
        check_some_scheme(scene)?;
        let rigid = scene.walls.iter().find(|wall| wall.law.is_rigid());
        if let (Some(wall), Some(rigid), [PenaltyLaw::None]) = (scene.nonlinear_wall(), rigid, &self.laws[..]) {
            let value = format!("{}, beside the rigid wall {:?}", wall.law.kind(), rigid.name);
            let expected = "a stiffness or an epsilon in [penalty], for the spring in place of the rigid wall: \
                            penalties alone step that law";
            return Err(Error::invalid(Subject::wall(&wall.name), value, expected));
        }
        for (index, law) in self.laws.iter().enumerate() {
            law.validate(scene).map_err(|error| match error {
                Error::Invalid { subject, value, expected } => {
                    Error::Invalid { subject: subject.within(Subject::nth("penalty law", index)), value, expected }
                }
                other => other,
            })?;
            if self.laws.iter().take(index).any(|other| other == law) {
                let key = Subject::nth("penalty law", index);
                return Err(Error::invalid(key, format_args!("{law}, given twice"), "each law once"));
            }
        }
        Ok(())
    }
}
