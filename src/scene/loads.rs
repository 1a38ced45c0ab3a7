//! The loads of a scene as vectors over its degrees of freedom.

use super::forcing::Forcing;
use super::load::Load;
use super::row::{Row, distinct};

/// All loads, sorted by where they act: one sum over time for each row, however many degrees of
/// freedom it reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Loads {
    parts: Vec<(Row, Forcing)>,
    /// True if there is a blow among them.
    blows: bool,
}

impl Loads {
    /// The loads, those of one row together.
    #[must_use]
    pub fn new(loads: &[Load]) -> Self {
        let places = distinct(loads.iter().map(|load| &load.at));
        let mut lists = vec![Vec::new(); places.rows.len()];
        for (load, place) in loads.iter().zip(places.of) {
            lists[place].push(Load { kind: load.kind.clone(), at: Row::dof(0) });
        }
        let parts: Vec<_> =
            places.rows.into_iter().zip(lists).map(|(row, list)| (row.clone(), Forcing::on(0, &list))).collect();
        let blows = parts.iter().any(|(_, forcing)| !forcing.impulses.is_empty());
        Self { parts, blows }
    }

    /// Each row with the loads that act through it.
    #[must_use]
    pub fn parts(&self) -> &[(Row, Forcing)] {
        &self.parts
    }

    /// True if there is a blow at any time.
    #[inline]
    #[must_use]
    pub fn has_blows(&self) -> bool {
        self.blows
    }

    /// Writes the force of each part at `t`, N, without the blows.
    #[inline]
    pub fn forces(&self, t: f64, out: &mut [f64]) {
        for (force, (_, forcing)) in out.iter_mut().zip(&self.parts) {
            *force = forcing.force(t);
        }
    }

    /// Adds one force (N) for each part, through its row, to `out`.
    #[inline]
    pub fn scatter(&self, forces: impl Iterator<Item = f64>, out: &mut [f64]) {
        for ((row, _), force) in self.parts.iter().zip(forces) {
            scatter(row, force, out);
        }
    }

    /// Adds `scale` times the forces at `t` (N) to `out`, one value per degree of freedom, without
    /// the blows.
    #[inline]
    pub fn add_force(&self, t: f64, scale: f64, out: &mut [f64]) {
        for (row, forcing) in &self.parts {
            scatter(row, scale * forcing.force(t), out);
        }
    }

    /// Writes the sum of the blows in (from, to] to `out`, N s. Returns whether there is one.
    pub fn blow(&self, from: f64, to: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse(from, to), out)
    }

    /// Writes the moment of the blows in (from, to] about `about` (s) to `out`, N s², as
    /// [`Forcing::impulse_moment`]. Returns whether it is not zero.
    pub fn blow_moment(&self, from: f64, to: f64, about: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_moment(from, to, about), out)
    }

    /// Writes the sum of the blows within half a step `h` (s) of the instant `step` · h to `out`,
    /// as [`Forcing::impulse_about`]. Returns whether there is one.
    pub fn blow_about(&self, step: u64, h: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_about(step, h), out)
    }

    /// The same for the blows after the time `since` (s) only, as [`Forcing::impulse_about_since`].
    pub fn blow_about_since(&self, since: f64, step: u64, h: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_about_since(since, step, h), out)
    }

    /// Writes the blows at t = 0 to `out`, N s: the start is the state after them. Returns whether
    /// there is one.
    pub fn initial_blow(&self, out: &mut [f64]) -> bool {
        self.blow_by(Forcing::initial_impulse, out)
    }

    fn blow_by(&self, of: impl Fn(&Forcing) -> f64, out: &mut [f64]) -> bool {
        out.fill(0.0);
        if !self.blows {
            return false;
        }
        let mut any = false;
        for (row, forcing) in &self.parts {
            let impulse = of(forcing);
            any |= impulse != 0.0;
            scatter(row, impulse, out);
        }
        any
    }
}

#[inline]
fn scatter(row: &Row, value: f64, out: &mut [f64]) {
    if value == 0.0 {
        return;
    }
    for &(i, weight) in row.entries() {
        if let Some(sum) = out.get_mut(i) {
            *sum += weight * value;
        }
    }
}
