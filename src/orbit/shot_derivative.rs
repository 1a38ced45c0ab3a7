//! The derivative of a periodic orbit with respect to keys of its scene.
//!
//! With P the map from a state x at the instant t₀ to that at t₁ = t₀ + N T,
//!
//! (1 − P′) δx = ∂P − P′ f δt₀ + f δt₁,
//!
//! where f = (q̇, q̈) at that instant, and δt₀, δt₁ are 0 unless the key changes the forcing
//! period. A second run from δx gives the changes of the contacts.

use super::shooting::{Shot, posed};
use super::strobe::{newton_step, vector};
use crate::error::{Error, Result};
use crate::scene::{Scene, forcing_period};
use crate::scheme::{Scheme, Stepper};
use crate::variation::{ContactDerivative, ContactDerivatives, KeyVariation, Product, SceneTangent};
use nalgebra::DVector;

/// The derivatives of a periodic orbit with respect to several keys.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ShotDerivative {
    /// Of the forcing period, s per unit of each key.
    pub forcing_period: Vec<f64>,
    /// Of the state at the orbit's instant, which keeps its phase: (q, q̇) for each key, m and m/s
    /// per unit of the key.
    pub state: Vec<Vec<f64>>,
    /// The contacts of one orbit after that instant, with their derivatives.
    pub contacts: ContactDerivatives,
    /// Of the phase at which each of these contacts begins, cycles per unit of each key.
    pub phase: Vec<Vec<f64>>,
}

impl Shot {
    /// The derivatives of this orbit of `scene` with respect to the keys of `tangents`: its state
    /// and its contacts. Its multipliers would need second derivatives of the run, which are not
    /// known for structures; for one degree of freedom
    /// [`Problem::derivative`](super::Problem::derivative) has them.
    ///
    /// ```
    /// use signorini::orbit::shoot;
    /// use signorini::variation::SceneTangent;
    /// use signorini::{Load, Scene, Wall};
    ///
    /// let scene = |amplitude: f64| {
    ///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
    ///         .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.6))
    ///         .with_load(Load::harmonic(amplitude, 2.5, 0.0)))
    /// };
    /// let orbit = shoot(&scene(3.0)?, 100, &|_| {})?;
    /// let key = SceneTangent::new("amplitude", 3.0, scene)?;
    /// let by = orbit.derivative(&scene(3.0)?, &[key])?;
    /// assert_eq!(by.contacts.len(), orbit.orbit.signature.events.len());
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where the derivative of the run does not exist, or where a multiplier is
    /// 1 (a fold: the orbit has no derivative there); as [`Shot::corrected`] and
    /// [`SceneTangent::new`].
    pub fn derivative(&self, scene: &Scene, tangents: &[SceneTangent]) -> Result<ShotDerivative> {
        let period = posed(scene)?;
        let n = scene.system.degrees_of_freedom();
        self.check(n)?;
        let longer = tangents.iter().map(|one| one.period(scene, period)).collect::<Result<Vec<f64>>>()?;
        let still = vec![0.0; 2 * n * tangents.len()];
        let (first, product, end) = self.once(scene, tangents, &still)?;
        let cycles = self.time / self.forcing_period;
        let (mut starts, mut states) = (Vec::new(), Vec::new());
        for (column, longer) in first.state().chunks_exact(2 * n).zip(&longer) {
            let [start, stop] = [cycles, cycles + f64::from(self.periods)].map(|cycles| cycles * longer);
            let driven = DVector::from_column_slice(column) + &end * stop - product.matrix() * &end * start;
            let singular = || Error::no_orbit("a multiplier is 1: at a fold of its branch an orbit has no derivative");
            let state = newton_step(product.matrix(), &driven).ok_or_else(singular)?;
            starts.extend((&state - &end * start).iter());
            states.push(state.as_slice().to_vec());
        }
        let (mut second, ..) = self.once(scene, tangents, &starts)?;
        let (contacts, _) = second.take_results();
        let phase = |contact: ContactDerivative<'_>| {
            let of_key = |(later, longer): (&f64, &f64)| (later - contact.contact.start / period * longer) / period;
            contact.start_by.iter().zip(&longer).map(of_key).collect()
        };
        Ok(ShotDerivative {
            phase: contacts.iter().map(phase).collect(),
            forcing_period: longer,
            state: states,
            contacts,
        })
    }

    /// One orbit from its state: the derivatives by keys from `start`, those with respect to the
    /// start, and (q̇, q̈) at the end.
    fn once(
        &self,
        scene: &Scene,
        tangents: &[SceneTangent],
        start: &[f64],
    ) -> Result<(KeyVariation, Product, DVector<f64>)> {
        let to = self.time + f64::from(self.periods) * forcing_period(scene)?;
        let mut stepper = Stepper::new(&scene.clone().with_duration(to), &Scheme::Event, to)?;
        stepper.set_state(self.time, &self.state)?;
        let (mut by_key, mut product) = (KeyVariation::from_state(scene, tangents, start)?, Product::new(scene)?);
        let n = scene.system.degrees_of_freedom();
        let (mut begin, mut acceleration) = (vec![0.0; n], vec![0.0; n]);
        while stepper.time() < to {
            let step = stepper.step()?;
            by_key.propagate(&step).map_err(|reason| Error::no_orbit(reason.to_string()))?;
            if let Some(reason) = by_key.lost().iter().flatten().next() {
                return Err(Error::no_orbit(reason.to_string()));
            }
            product.observe(&step).map_err(|reason| Error::no_orbit(reason.to_string()))?;
            step.path.accelerations(&mut begin, &mut acceleration);
        }
        Ok((by_key, product, vector(&stepper.state().v, &acceleration)))
    }
}
