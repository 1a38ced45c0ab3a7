//! The scene from which another was made by damping, condensation or reduction.

use serde::{Deserialize, Serialize};
use signorini as sg;

/// A scene before it is damped, condensed, or reduced to modes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    pub scene: sg::Scene,
    pub damping: Option<sg::Damping>,
    pub modes: Option<usize>,
    pub static_correction: bool,
    /// Fields of turbulence, whose forces act on the modes.
    pub turbulence: Vec<sg::Turbulence>,
}

impl Origin {
    /// The scene that is run.
    pub fn built(&self) -> sg::Result<sg::Scene> {
        let massless = |s: &sg::SharedStructure| !s.massless().is_empty();
        let mut scene = match &self.scene.system {
            sg::System::Structure(structure) if massless(structure) => self.scene.condensed()?.0,
            _ => self.scene.clone(),
        };
        let damping = self.damping.as_ref();
        if let Some(modes) = self.modes {
            let reduction = scene.reduced(modes, self.static_correction)?;
            let duration = scene.duration;
            let turbulent = self.turbulence.iter().map(|field| field.forces(&reduction.modes, duration));
            let turbulent = turbulent.collect::<sg::Result<Vec<_>>>()?.concat();
            scene = damping.map_or(Ok(reduction.clone()), |damping| reduction.with_damping(damping))?.scene;
            scene.loads.extend(turbulent);
        } else if let (Some(damping), sg::System::Structure(structure)) = (damping, &scene.system) {
            scene.system = (**structure).clone().with_damping(damping)?.into();
        }
        scene.validate()?;
        Ok(scene)
    }
}
