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
    /// Sliders, which the scene does not have.
    pub sliders: Vec<sg::Slider>,
}

impl Origin {
    /// A scene that is run as it is.
    pub fn of(scene: sg::Scene) -> Self {
        let (turbulence, sliders) = (Vec::new(), Vec::new());
        Self { scene, damping: None, modes: None, static_correction: false, turbulence, sliders }
    }

    /// The scene that is run.
    pub fn built(&self) -> sg::Result<sg::Scene> {
        let massless = |s: &sg::SharedStructure| !s.massless().is_empty();
        let mut scene = match &self.scene.system {
            sg::System::Structure(structure) if massless(structure) => self.scene.condensed()?.0,
            _ => self.scene.clone(),
        };
        let damping = self.damping.as_ref();
        let (mut sliders, mut turbulent) = (self.sliders.clone(), Vec::new());
        if let Some(modes) = self.modes {
            let reduction = scene.reduced(modes, self.static_correction)?;
            sliders.iter_mut().for_each(|slider| *slider = slider.on(&reduction.modes));
            for field in &self.turbulence {
                turbulent.extend(field.forces(&reduction.modes, scene.duration)?);
            }
            scene = damping.map_or(Ok(reduction.clone()), |damping| reduction.with_damping(damping))?.scene;
        } else if let (Some(damping), sg::System::Structure(structure)) = (damping, &scene.system) {
            scene.system = (**structure).clone().with_damping(damping)?.into();
        }
        for slider in &sliders {
            scene = scene.with_slider(slider)?;
        }
        scene.loads.extend(turbulent);
        scene.validate()?;
        Ok(scene)
    }
}
