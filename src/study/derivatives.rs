//! The derivatives of an exact run with respect to keys of its scene.

use super::horizon::LARGEST_GROWTH;
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper, check_exact};
use crate::variation::{
    ContactDerivative, ContactDerivatives, KeyVariation, MeanDerivative, MotionDerivative, NoDerivative, SceneTangent,
};

/// The derivatives of an exact run with respect to several keys.
///
/// ```
/// use signorini::study::derivatives::Derivatives;
/// use signorini::variation::SceneTangent;
/// use signorini::{Load, Scene, Wall};
///
/// let scene = |gap: f64, amplitude: f64| {
///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
///         .with_wall(Wall::upper("stop", gap).with_restitution(0.6))
///         .with_load(Load::harmonic(amplitude, 2.5, 0.0))
///         .with_duration(1.0))
/// };
/// let keys = [
///     SceneTangent::new("gap", 5e-3, |gap| scene(gap, 3.0))?,
///     SceneTangent::new("amplitude", 3.0, |amplitude| scene(5e-3, amplitude))?,
/// ];
/// let derivatives = Derivatives::new(&scene(5e-3, 3.0)?, &keys, &[0.5, 1.0])?;
/// assert!(derivatives.ended.is_none());
/// // Gap and load larger by the same share make a larger motion with the same instants.
/// let first = derivatives.contacts.get(0).expect("an impact");
/// assert!((5e-3 * first.start_by[0] + 3.0 * first.start_by[1]).abs() < 1e-12);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Derivatives {
    /// The contacts that have ended, in the order of their ends; with the derivatives by each key.
    pub contacts: ContactDerivatives,
    /// Displacements and velocities of the probes at the times asked for; NaN from the time of
    /// `ended` on.
    pub motion: MotionDerivative,
    /// Means of displacements and forces over the whole run; `None` where `ended` is not.
    pub means: Option<MeanDerivative>,
    /// Why there are no derivatives from a time on, if there are none.
    pub ended: Option<NoDerivative>,
    /// The number of contacts that are still open where the derivatives end: they are not among
    /// `contacts`.
    pub open: usize,
    /// For each key why there are none by it from a time on, where the key itself is the reason:
    /// they are NaN from then on, and those by the other keys go on. Where every key has such a
    /// reason, the last one is that of `ended`.
    pub lost: Vec<Option<NoDerivative>>,
    /// The largest growth of a change of the start since it was smallest.
    pub growth: f64,
}

/// A number that a run has for a wall, and its derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Measured {
    /// The wall, by its index in the scene.
    pub wall: usize,
    /// What it is, as in the header of a table: `largest_impulse`, `impulse`, `approach_speed`.
    pub name: &'static str,
    /// In words.
    pub words: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// The number.
    pub value: f64,
    /// Its derivatives with respect to each key, per unit of the key.
    pub derivative: Vec<f64>,
}

impl Derivatives {
    /// An error if no run of `scene` has derivatives, whatever the keys are.
    ///
    /// # Errors
    /// What the exact scheme refuses, friction for one; [`Error::Invalid`] for round supports.
    pub fn check(scene: &Scene) -> Result<()> {
        // First, since it refuses every round support, whatever the exact scheme takes.
        KeyVariation::new(scene, &[], &[])?;
        check_exact(scene, "derivatives")?;
        Stepper::new(scene, &Scheme::Event, scene.duration).map(drop)
    }

    /// The derivatives of the exact run of `scene` with respect to the keys of `tangents`, with
    /// displacements and velocities of the probes at `times` (s, increasing, from 0 to the end).
    ///
    /// # Errors
    /// As [`Derivatives::check`], [`Error::Invalid`] without keys and for times outside of the run
    /// or not increasing, and errors of the exact scheme. A run that has no derivative from a time
    /// on is none: see [`Derivatives::ended`].
    pub fn new(scene: &Scene, tangents: &[SceneTangent], times: &[f64]) -> Result<Self> {
        let mut variation = KeyVariation::new(scene, tangents, times)?;
        if tangents.is_empty() {
            return Err(Error::invalid("keys", "none", "one key or more"));
        }
        if let Some(time) = times.iter().find(|time| !(0.0..=scene.duration).contains(*time)) {
            let expected = format!("from 0 to the end, {:?} s", scene.duration);
            return Err(Error::invalid("times", format_args!("{time:?}"), expected));
        }
        let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration)?;
        let mut ended = None;
        while stepper.time() < scene.duration && ended.is_none() {
            ended = variation.propagate(&stepper.step()?).err();
        }
        let means = ended.is_none().then(|| variation.means());
        let (lost, open) = (variation.lost().to_vec(), variation.open_contacts());
        let (contacts, motion) = variation.take_results();
        Ok(Self { contacts, motion, means, ended, open, lost, growth: variation.growth() })
    }

    /// The contacts that ended while no change of the start had grown by more than
    /// [`LARGEST_GROWTH`]: those for which a change of a key by some per cent is small.
    pub fn predictable(&self) -> impl Iterator<Item = ContactDerivative<'_>> {
        self.contacts.iter().filter(|one| one.growth <= LARGEST_GROWTH)
    }

    /// What the [predictable](Self::predictable) contacts of each wall come to, with derivatives:
    /// the largest impulse, the sum of the impulses, and the mean approach speed. Walls without
    /// such a contact are left out.
    #[must_use]
    pub fn measured(&self) -> Vec<Measured> {
        let mut walls: Vec<usize> = self.predictable().map(|one| one.contact.wall).collect();
        walls.sort_unstable();
        walls.dedup();
        walls.into_iter().flat_map(|wall| self.measured_at(wall)).collect()
    }

    fn measured_at(&self, wall: usize) -> Vec<Measured> {
        let own: Vec<ContactDerivative<'_>> = self.predictable().filter(|one| one.contact.wall == wall).collect();
        let count = own.len() as f64;
        let sum = |of: for<'a> fn(&ContactDerivative<'a>) -> (f64, &'a [f64]), share: f64| {
            let mut total = (0.0, Vec::new());
            for (value, derivative) in own.iter().map(of) {
                total.0 += share * value;
                total.1.resize(derivative.len(), 0.0);
                total.1.iter_mut().zip(derivative).for_each(|(sum, x): (&mut f64, _)| *sum += share * x);
            }
            total
        };
        let largest = own.iter().max_by(|a, b| a.contact.impulse.abs().total_cmp(&b.contact.impulse.abs()));
        let largest = largest.map(|c| (c.contact.impulse, c.impulse_by.to_vec())).unwrap_or_default();
        let all = [
            ("largest_impulse", "the largest impulse", "N s", largest),
            ("impulse", "the sum of the impulses", "N s", sum(|c| (c.contact.impulse, c.impulse_by), 1.0)),
            (
                "approach_speed",
                "the mean approach speed",
                "m/s",
                sum(|c| (c.contact.approach_speed, c.approach_speed_by), 1.0 / count),
            ),
        ];
        let measured =
            |(name, words, unit, (value, derivative))| Measured { wall, name, words, unit, value, derivative };
        all.into_iter().map(measured).collect()
    }
}
