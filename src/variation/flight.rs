//! The derivatives of single flights of one degree of freedom by keys.

use super::no_derivative::NoDerivative;
use super::structure::StructureVariation;
use super::tangent::SceneTangent;
use crate::error::Result;
use crate::flow::Arc;
use crate::scene::Scene;

/// Propagates the derivatives with respect to keys over flights in closed form, one by one: what
/// happens at their ends is left to the caller.
#[derive(Debug)]
pub(crate) struct FlightVariation(StructureVariation);

impl FlightVariation {
    /// For flights of `scene`, of one degree of freedom, and the keys of `tangents`.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn new(scene: &Scene, tangents: &[SceneTangent]) -> Result<Self> {
        Ok(Self(StructureVariation::with_keys(scene, tangents, &[])?))
    }

    /// Propagates `columns`, (δq, δq̇) of each key one after the other, from the start of `arc` to
    /// its end, both at fixed instants.
    ///
    /// # Errors
    /// [`NoDerivative::Together`] where the body rests on two walls that a key moves apart.
    pub fn over(&mut self, arc: &Arc, columns: &mut [f64]) -> std::result::Result<(), NoDerivative> {
        self.0.fly(arc, columns)
    }
}
