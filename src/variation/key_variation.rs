//! The derivative of a run with respect to keys.

use super::contact_changes::ContactDerivatives;
use super::exponents::direction;
use super::keys::MotionDerivative;
use super::means::MeanDerivative;
use super::no_derivative::NoDerivative;
use super::structure::{StructureVariation, name_of};
use super::tangent::SceneTangent;
use crate::error::{Error, Result};
use crate::scene::{Scene, System};
use crate::step::Step;

/// An impact that multiplies such a change by more than this counts as a graze: the approach is
/// then known to less than half of its digits.
const STEEPEST: f64 = 1e4;

/// The growth up to which derivatives are exact to 1e-8: the state is exact to about 1e-15 of
/// itself, and its error reaches the derivative with one power of the growth more.
const MOST_GROWTH: f64 = 1e6;

/// The derivative of a run of the scheme `event` with respect to several keys at once.
///
/// Each key has a column (δq, δq̇) that starts from the derivative of the initial state. Along a
/// flight it obeys
///
/// M δq̈ + C δq̇ + K δq = δf − δM q̈ − δC q̇ − δK q,
///
/// whose series follows from that of the motion; at an event the saltation matrix
/// ([`saltation`](super::saltation)) is applied, with the displacement of the wall in place of that
/// of the body where the key moves the wall, and with −δe G q̇⁻ added to the departure speed where
/// it changes the restitution. One further column without a key, the witness, tells how fast
/// changes grow: the derivative is given up where it is known to be worth nothing
/// ([`NoDerivative`]).
#[derive(Debug)]
pub struct KeyVariation {
    variation: StructureVariation,
    keys: usize,
    columns: Vec<f64>,
    witness: Witness,
    system: System,
    /// 1/s: a displacement times it counts as a velocity, besides the energy of its springs.
    rate: f64,
    growth: f64,
}

/// The size of a change of the start, carried along to tell how fast changes grow, and the least
/// that it has had.
#[derive(Debug, Clone, Copy)]
struct Witness {
    size: f64,
    least: f64,
}

impl KeyVariation {
    /// The derivative of runs of `scene` from their start with respect to the keys of `tangents`,
    /// with displacements and velocities of the scene's probes at `times` (s, increasing).
    ///
    /// # Errors
    /// As [`Scene::validate`]; [`Error::Invalid`] for a scene with round supports, or for times
    /// that are not finite and increasing.
    pub fn new(scene: &Scene, tangents: &[SceneTangent], times: &[f64]) -> Result<Self> {
        scene.validate()?;
        if times.iter().any(|t| !t.is_finite()) || times.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(Error::invalid("times", "a list", "finite numbers, s, each above the one before"));
        }
        let mut variation = StructureVariation::with_keys(scene, tangents, times)?;
        variation.from_start = true;
        let columns = variation.keys.start(&mut variation.flow, &scene.initial.v);
        Ok(Self::of(scene, variation, columns, tangents.len()))
    }

    /// The derivative of a run of `scene` from a state at any time, with `start` as the derivative
    /// of that state: (δq, δq̇) for each key one after the other.
    ///
    /// # Errors
    /// As [`KeyVariation::new`].
    pub(crate) fn from_state(scene: &Scene, tangents: &[SceneTangent], start: &[f64]) -> Result<Self> {
        let variation = StructureVariation::with_keys(scene, tangents, &[])?;
        let size = 2 * variation.degrees_of_freedom() * tangents.len();
        let mut columns = start.to_vec();
        columns.resize(size, 0.0);
        Ok(Self::of(scene, variation, columns, tangents.len()))
    }

    fn of(scene: &Scene, variation: StructureVariation, mut columns: Vec<f64>, keys: usize) -> Self {
        columns.resize(columns.len() + 2 * variation.degrees_of_freedom(), 0.0);
        let mut this = Self {
            variation,
            keys,
            columns,
            witness: Witness { size: 0.0, least: 0.0 },
            system: scene.system.clone(),
            rate: 1.0 / scene.duration,
            growth: 1.0,
        };
        this.renew();
        this
    }

    /// Propagates the derivative over `step`; steps must come in turn from the start of the run.
    ///
    /// # Errors
    /// [`NoDerivative`]: what has been read so far holds, and there is nothing more from then on.
    /// What ends the derivatives by one key only is none while there are others:
    /// [`KeyVariation::lost`].
    pub fn propagate(&mut self, step: &Step<'_>) -> std::result::Result<(), NoDerivative> {
        self.variation.propagate(step, &mut self.columns)?;
        self.give_up()?;
        self.variation.keys.means.add_impulses(step);
        let size = self.witness_size();
        let before = std::mem::replace(&mut self.witness.size, size);
        self.witness.least = self.witness.least.min(size);
        if size == 0.0 {
            self.renew();
        } else {
            let struck = step.jump.iter().position(|&p| p != 0.0);
            if let Some(wall) = struck.filter(|_| size > STEEPEST * before) {
                return Err(NoDerivative::Graze { time: step.end, wall: name_of(&self.variation.names, wall) });
            }
            let growth = size / self.witness.least;
            self.growth = self.growth.max(growth);
            if growth > MOST_GROWTH || growth.is_nan() {
                return Err(NoDerivative::Horizon { time: step.end, growth });
            }
        }
        self.variation.keys.contacts.note_growth(self.growth);
        Ok(())
    }

    /// Makes the columns of lost keys NaN.
    ///
    /// # Errors
    /// Why the last key was lost, where all are.
    fn give_up(&mut self) -> std::result::Result<(), NoDerivative> {
        let lost = &self.variation.keys.lost;
        let size = 2 * self.variation.degrees_of_freedom();
        let columns = self.columns.chunks_exact_mut(size).zip(lost);
        columns.filter(|(_, lost)| lost.is_some()).for_each(|(column, _)| column.fill(f64::NAN));
        if lost.is_empty() || lost.iter().any(Option::is_none) {
            return Ok(());
        }
        let last = lost.iter().flatten().max_by(|a, b| a.time().total_cmp(&b.time()));
        last.map_or(Ok(()), |reason| Err(reason.clone()))
    }

    /// For each key why there are no derivatives by it from a time on, if there are none, while
    /// those by other keys go on: they are NaN from then on.
    #[must_use]
    pub fn lost(&self) -> &[Option<NoDerivative>] {
        &self.variation.keys.lost
    }

    /// The number of contacts that are still open.
    pub(crate) fn open_contacts(&self) -> usize {
        self.variation.keys.contacts.open()
    }

    /// The contacts that have ended, and the displacements and velocities of the probes at the
    /// times asked for, with their derivatives: the variation has none of them afterwards.
    pub(crate) fn take_results(&mut self) -> (ContactDerivatives, MotionDerivative) {
        let keys = &mut self.variation.keys;
        (keys.contacts.take_ended(), std::mem::take(&mut keys.motion.found))
    }

    /// Means of displacements and forces from the start of the run up to now, with their
    /// derivatives.
    #[must_use]
    pub fn means(&self) -> MeanDerivative {
        let keys = &self.variation.keys;
        keys.means.means(&keys.contacts.total())
    }

    /// The derivative of the state now, (δq, δq̇) for each key one after the other: m and m/s per
    /// unit of the key. NaN for keys that are [lost](Self::lost).
    #[must_use]
    pub fn state(&self) -> &[f64] {
        let size = 2 * self.variation.degrees_of_freedom();
        self.columns.get(..size * self.keys).unwrap_or_default()
    }

    /// The largest growth of a change of the start so far, since it was smallest.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.growth
    }

    /// √(δq̇ᵀMδq̇ + δqᵀKδq + δqᵀMδq/T²) of the witness, √J, with T the duration: it does not grow
    /// by the exchange between springs and masses.
    fn witness_size(&self) -> f64 {
        let n = self.variation.degrees_of_freedom();
        let Some((q, v)) = self.columns.get(2 * n * self.keys..).and_then(|witness| witness.split_at_checked(n)) else {
            return 0.0;
        };
        let slow = self.rate * self.rate * self.system.mass_form(q, q);
        (self.system.mass_form(v, v) + self.system.stiffness_form(q, q) + slow).sqrt()
    }

    /// Begins the witness, or begins it anew once a rest has made it 0: with the velocities that
    /// impulses at the walls give, and displacements of the same shape and about the same energy.
    fn renew(&mut self) {
        let (n, body) = (self.variation.degrees_of_freedom(), &self.variation.flow.body);
        let mut change = vec![0.0; n];
        for row in 0..body.rows.count() {
            body.add_column(row, direction(row), &mut change);
        }
        if body.rows.count() == 0 {
            change.iter_mut().enumerate().for_each(|(i, x)| *x = direction(i));
        }
        let [mass, spring] = [self.system.mass_form(&change, &change), self.system.stiffness_form(&change, &change)];
        let scale = (mass / (spring + self.rate * self.rate * mass)).sqrt();
        let displaced: Vec<f64> = change.iter().map(|v| scale * v).collect();
        let witness = self.columns.iter_mut().skip(2 * n * self.keys);
        witness.zip(displaced.iter().chain(&change)).for_each(|(x, new)| *x = *new);
        let size = self.witness_size();
        self.witness = Witness { size, least: size };
    }
}
