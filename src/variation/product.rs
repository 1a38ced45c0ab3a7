//! The derivative along a run, as a product over its steps.

use super::no_derivative::NoDerivative;
use super::oscillator::OscillatorVariation;
use super::saltation;
use super::structure::StructureVariation;
use crate::error::Result;
use crate::scene::Scene;
use crate::step::Step;
use nalgebra::DMatrix;

/// Propagates changes of the start over the steps of a run of the scheme `event`, for any number of
/// degrees of freedom n.
///
/// A change has 2n entries: δq (m), then δq̇ (m/s). Starting from the columns of the identity gives
/// the derivative of the state with respect to the start ([`Product`]), from one vector its growth
/// in that direction ([`Exponents`](super::Exponents)).
#[derive(Debug)]
pub struct Variation(Kind);

#[derive(Debug)]
enum Kind {
    Oscillator(OscillatorVariation),
    Structure(Box<StructureVariation>),
}

impl Variation {
    /// A variation for runs of `scene`, from the start or from any step of the run.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn new(scene: &Scene) -> Result<Self> {
        scene.validate()?;
        Ok(Self(if scene.is_line() {
            Kind::Oscillator(OscillatorVariation::new(scene)?)
        } else {
            Kind::Structure(Box::new(StructureVariation::new(scene)?))
        }))
    }

    /// n.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        match &self.0 {
            Kind::Oscillator(_) => 1,
            Kind::Structure(structure) => structure.degrees_of_freedom(),
        }
    }

    /// Propagates `changes`, 2n entries each and one after the other, over `step`, the event at its
    /// end included. Entries beyond a whole number of changes are left as they are. After an error
    /// the changes are meaningless.
    ///
    /// # Errors
    /// [`NoDerivative`].
    pub fn propagate(&mut self, step: &Step<'_>, changes: &mut [f64]) -> std::result::Result<(), NoDerivative> {
        match &mut self.0 {
            Kind::Oscillator(oscillator) => {
                let matrix = oscillator.over(step)?;
                for change in changes.chunks_exact_mut(2) {
                    if let &mut [q, v] = change {
                        change.copy_from_slice(&saltation::apply(matrix, [q, v]));
                    }
                }
                Ok(())
            }
            Kind::Structure(structure) => structure.propagate(step, changes),
        }
    }
}

/// The derivative of the state with respect to the start, ∂(q, q̇)(t)/∂(q, q̇)(0), along a run of
/// the scheme `event`.
///
/// Rows and columns are q₀ … qₙ₋₁ (m), q̇₀ … q̇ₙ₋₁ (m/s). Over the period of a periodic motion it
/// is the monodromy matrix, whose eigenvalues are the Floquet multipliers. A row held by a rigid
/// wall reduces its rank by 2.
#[derive(Debug)]
pub struct Product {
    variation: Variation,
    matrix: DMatrix<f64>,
}

impl Product {
    /// The identity: the product before the first step of a run of `scene`.
    ///
    /// # Errors
    /// As [`Scene::validate`].
    pub fn new(scene: &Scene) -> Result<Self> {
        let variation = Variation::new(scene)?;
        let size = 2 * variation.degrees_of_freedom();
        Ok(Self { variation, matrix: DMatrix::identity(size, size) })
    }

    /// Multiplies the product by the derivative over `step`.
    ///
    /// # Errors
    /// [`NoDerivative`]; the matrix is meaningless from then on.
    pub fn observe(&mut self, step: &Step<'_>) -> std::result::Result<(), NoDerivative> {
        self.variation.propagate(step, self.matrix.as_mut_slice())
    }

    /// The product so far, 2n × 2n.
    #[must_use]
    pub fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Sets the product to the identity, for example at the start of a period.
    pub fn restart(&mut self) {
        self.matrix.fill_with_identity();
    }
}
