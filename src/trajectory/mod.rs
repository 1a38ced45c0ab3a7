//! The recorded motion: columns over time, and the contacts.
//!
//! # Files
//!
//! `Trajectory` (`columns.rs` its data), its `recorder.rs`; `plane_impulses.rs` and `worn.rs`:
//! round supports, friction and the work of wear over its rows; `output.rs`: states at the output
//! times, which need not be rows.

mod columns;
mod output;
mod plane_impulses;
mod recorder;
mod worn;

pub use output::OutputStates;
pub use recorder::Recorder;
pub use worn::EpisodeWear;

use crate::error::{Error, Result};
use crate::step::Contact;
use columns::Columns;
use serde::{Deserialize, Serialize};

/// A motion sampled at given times; the contact impulses between the samples are recorded in full.
///
/// Row 0 is the start, after any impulse at t = 0; the last row is exactly the end. States are
/// right-continuous. The force in a row is the impulse since the row before it over the distance of
/// the rows, whatever the scheme: the mean force, so that the sum of a column times that distance
/// is the impulse of the run. The forces of a step are those of [`Step`](crate::Step), and the
/// largest force of a contact is that of its [`Contact`].
///
/// ```
/// use signorini::{Load, Options, Scene, Scheme, Wall, run};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.5))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let options = Options::with_step(1e-4).with_sample(1e-2); // a row every 10 ms
/// let trajectory = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &options)?.trajectory;
///
/// assert_eq!(trajectory.time().len(), 101); // s, from 0 to 1
/// let highest = trajectory.displacement().iter().fold(0.0, |a: f64, &b| a.max(b)); // m
/// assert!(highest < 5.1e-3);
/// // Nothing that happens between two rows is lost: impulses (N s) are those since the row before.
/// let impulses: f64 = trajectory.contact_impulse("stop")?.iter().sum();
/// let contacts: f64 = trajectory.contacts().iter().map(|contact| contact.impulse).sum();
/// assert!((impulses - contacts).abs() < 1e-12 && impulses < 0.0);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Columns")]
pub struct Trajectory(Columns);

impl TryFrom<Columns> for Trajectory {
    type Error = &'static str;

    fn try_from(columns: Columns) -> std::result::Result<Self, Self::Error> {
        if columns.fit() {
            Ok(Self(columns))
        } else {
            Err("a column for each wall, hole and probe, all of one length, and contacts at these")
        }
    }
}

impl Trajectory {
    /// Times of the rows, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.0.time
    }

    /// The states at the scene's output times; empty where it has none.
    #[must_use]
    pub fn output(&self) -> &OutputStates {
        &self.0.output
    }

    /// Names of the walls, in the scene's order.
    #[must_use]
    pub fn walls(&self) -> &[String] {
        &self.0.walls
    }

    /// Names of the probes; a single empty name for an oscillator.
    #[must_use]
    pub fn probes(&self) -> &[String] {
        &self.0.probes
    }

    /// Displacement of the first probe at each row, m.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        self.0.displacement.first().map_or(&[], Vec::as_slice)
    }

    /// Velocity of the first probe at each row, m/s.
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        self.0.velocity.first().map_or(&[], Vec::as_slice)
    }

    /// Displacement at each row, m: one column per probe, in the scene's order.
    #[must_use]
    pub fn displacements(&self) -> &[Vec<f64>] {
        &self.0.displacement
    }

    /// Velocity at each row, m/s: one column per probe, in the scene's order.
    #[must_use]
    pub fn velocities(&self) -> &[Vec<f64>] {
        &self.0.velocity
    }

    /// Mean force of each wall on the body since the previous row, N: one column per wall, in the
    /// scene's order.
    #[must_use]
    pub fn contact_forces(&self) -> &[Vec<f64>] {
        &self.0.force
    }

    /// Impulse of each wall on the body since the previous row, N s: one column per wall, in the
    /// scene's order.
    #[must_use]
    pub fn contact_impulses(&self) -> &[Vec<f64>] {
        &self.0.impulse
    }

    /// Names of the round supports, in the scene's order.
    #[must_use]
    pub fn holes(&self) -> &[String] {
        &self.0.holes
    }

    /// Mean force of each round support on the body since the previous row along y and z, normal
    /// and friction together, N: two columns per round support, in the scene's order.
    #[must_use]
    pub fn hole_forces(&self) -> &[[Vec<f64>; 2]] {
        &self.0.hole_force
    }

    /// Impulse of each round support on the body since the previous row along y and z, normal and
    /// friction together, N s: two columns per round support, in the scene's order.
    #[must_use]
    pub fn hole_impulses(&self) -> &[[Vec<f64>; 2]] {
        &self.0.hole_impulse
    }

    /// Friction impulse at each wall since the previous row, N s, along (−n_z, n_y) with n the
    /// outward normal of the flat: one column per wall, in the scene's order; none in scenes
    /// without round supports and friction.
    #[must_use]
    pub fn friction_impulses(&self) -> &[Vec<f64>] {
        &self.0.friction
    }

    /// Names of the supports, in the scene's order.
    #[must_use]
    pub fn supports(&self) -> &[String] {
        &self.0.supports
    }

    /// Work of wear of each support from the start to each row, J: one column per support, in the
    /// scene's order.
    #[must_use]
    pub fn wear_work(&self) -> &[Vec<f64>] {
        &self.0.wear_work
    }

    /// What each of the contacts wore; `None` at walls that belong to no support. Empty in scenes
    /// without supports.
    #[must_use]
    pub fn contact_wear(&self) -> &[Option<EpisodeWear>] {
        &self.0.contact_wear
    }

    /// Displacement (m) and velocity (m/s) of the probe of that name at each row.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the probes there are.
    pub fn probe(&self, name: &str) -> Result<(&[f64], &[f64])> {
        let index = find("probe", name, &self.0.probes)?;
        Ok((&self.0.displacement[index], &self.0.velocity[index]))
    }

    /// Mean force of a wall on the body since the previous row, N: ≥ 0 for a lower wall, ≤ 0 for an
    /// upper one.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn contact_force(&self, wall: &str) -> Result<&[f64]> {
        Ok(&self.0.force[find("wall", wall, &self.0.walls)?])
    }

    /// Impulse of a wall on the body since the previous row, N s; signed as the force.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn contact_impulse(&self, wall: &str) -> Result<&[f64]> {
        Ok(&self.0.impulse[find("wall", wall, &self.0.walls)?])
    }

    /// Impulse of a wall on the body over the whole run, N s; signed as the force.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn impulse(&self, wall: &str) -> Result<f64> {
        Ok(self.contact_impulse(wall)?.iter().sum())
    }

    /// The contact episodes, in the order in which they began.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        &self.0.contacts
    }
}

impl Trajectory {
    /// Takes the last `count` probes out of the trajectory: the displacement (m) of each.
    #[cfg(feature = "cli")]
    pub(crate) fn take_last_probes(&mut self, count: usize) -> Vec<Vec<f64>> {
        let kept = self.0.probes.len().saturating_sub(count);
        self.0.probes.truncate(kept);
        self.0.velocity.truncate(kept);
        self.0.output.displacement.truncate(kept);
        self.0.output.velocity.truncate(kept);
        self.0.displacement.split_off(kept)
    }
}

fn find(kind: &'static str, name: &str, known: &[String]) -> Result<usize> {
    let missing = || Error::Unknown { kind, name: name.to_owned(), known: known.to_vec() };
    known.iter().position(|k| k == name).ok_or_else(missing)
}
