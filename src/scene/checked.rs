//! A validated scene.

use super::Scene;
use crate::error::Result;
use std::ops::Deref;
use std::sync::Arc;

/// A scene that [`Scene::validate`] has passed, shared by all parts of a run, with the mass that
/// each of its walls feels.
#[derive(Debug, Clone)]
pub(crate) struct Checked {
    scene: Arc<Scene>,
    masses: Arc<[f64]>,
}

impl Checked {
    /// Checks `scene`.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn new(scene: &Scene) -> Result<Self> {
        scene.validate()?;
        Ok(Self { scene: Arc::new(scene.clone()), masses: scene.wall_masses().into() })
    }

    /// A scene made of the parts of one that was checked, at a state that may be behind walls and
    /// holes by rounding.
    pub fn made(scene: Scene) -> Self {
        let masses = scene.wall_masses().into();
        Self { scene: Arc::new(scene), masses }
    }

    /// The same scene with the walls' laws changed by `change`, which must check them; nothing else
    /// may change.
    pub fn with_laws(&self, change: impl FnOnce(&Scene) -> Result<Scene>) -> Result<Self> {
        Ok(Self { scene: Arc::new(change(&self.scene)?), masses: Arc::clone(&self.masses) })
    }

    /// As [`Scene::wall_masses`], computed once.
    pub fn wall_masses(&self) -> &[f64] {
        &self.masses
    }

    /// The scene, to be shared.
    pub fn shared(&self) -> &Arc<Scene> {
        &self.scene
    }
}

impl Deref for Checked {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}
