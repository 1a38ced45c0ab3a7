//! The reference of a run: fine runs from neighbouring starts.

use super::recorded_run::Record;
use super::scale::{Scale, total_mass};
use crate::scene::{Scene, System};
use crate::step::Contact;

/// Relative scatter, from run to run, of the energy that the walls take with several degrees of
/// freedom: which contacts coincide depends on chance.
pub const SCATTER: f64 = 0.04;
/// Contacts are counted where the approach is faster than this share of the reference's largest:
/// the number of slower contacts, in chatter and accumulations, depends on the resolution only.
pub const COUNTED: f64 = 0.05;
/// Speeds below this share of the reference's largest count as rest.
pub const REST: f64 = 1e-3;

/// Fine runs that others are compared with: several, from slightly different starts. Where the
/// motion is chaotic they scatter, and only a value outside their scatter is wrong.
#[derive(Debug, Clone)]
pub struct FineReference {
    /// Range, over the runs, of the largest speed, m/s.
    pub speed: Range,
    /// Range, over the runs, of the root-mean-square speed, m/s.
    pub rms_speed: Range,
    /// Range, over the runs, of the number of contacts counted.
    pub contacts: Range,
    /// Approach speed above which a contact is counted, m/s.
    pub(super) threshold: f64,
    /// Contacts of one wall less than this apart count as one, s; `None` for one degree of freedom,
    /// where each contact counts.
    pub(super) joined: Option<f64>,
    pub(super) rests: bool,
    /// Range of the energy that the walls of several degrees of freedom take, over the energy that
    /// [`exchanged`] counts.
    pub(super) taken: Range,
    /// Largest kinetic energy over the runs, J.
    pub(super) energy: f64,
}

/// Smallest and largest of several values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The smallest value.
    pub low: f64,
    /// The largest value.
    pub high: f64,
}

impl Range {
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Self {
        let all = Self { low: f64::INFINITY, high: 0.0 };
        values.fold(all, |r, x| Self { low: r.low.min(x), high: r.high.max(x) })
    }

    /// The range of a small sample with large scatter: widened by [`SCATTER`] to either side.
    pub(super) fn scattered(values: impl Iterator<Item = f64>) -> Self {
        let all = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
        let seen = values.fold(all, |r, x| Self { low: r.low.min(x), high: r.high.max(x) });
        Self { low: seen.low - SCATTER, high: seen.high + SCATTER }
    }

    /// Distance of a value from the range: 0 within it, signed outside.
    pub(super) fn beyond(self, x: f64) -> f64 {
        x - x.clamp(self.low.min(self.high), self.high)
    }

    /// The value over the nearest value of the range: 1 within it.
    pub(super) fn ratio(self, x: f64) -> f64 {
        let nearest = x.clamp(self.low.min(self.high), self.high);
        if x == nearest { 1.0 } else { x / nearest }
    }
}

impl FineReference {
    /// The ruler made of fine runs of `scene`. On a mesh, vibrations may interrupt a contact; its
    /// parts are counted as one.
    #[must_use]
    pub fn new(records: &[Record], scene: &Scene, scale: &Scale) -> Self {
        let joined = matches!(scene.system, System::Structure(_)).then(|| scale.joined());
        let masses = &scene.wall_masses()[..];
        let approach = |record: &Record| record.contacts.iter().map(|c| c.approach_speed).fold(0.0, f64::max);
        let threshold = COUNTED * Range::of(records.iter().map(approach)).high;
        let speed = Range::of(records.iter().map(|r| r.speed));
        let energy = 0.5 * total_mass(&scene.system) * speed.high * speed.high;
        Self {
            speed,
            rms_speed: Range::of(records.iter().map(|r| r.rms_speed)),
            contacts: Range::of(records.iter().map(|r| counted(&r.contacts, threshold, joined).len() as f64)),
            threshold,
            joined,
            taken: Range::scattered(records.iter().map(|r| r.made / exchanged(r, masses, energy))),
            energy,
            rests: records.iter().all(|r| r.last_speed < REST * speed.high),
        }
    }

    /// Start times of the contacts counted, s.
    pub(crate) fn contact_times(&self, record: &Record) -> Vec<f64> {
        counted(&record.contacts, self.threshold, self.joined)
    }
}

/// Starts of the contacts faster than `threshold`, in the order of the list; a contact of the same
/// wall that begins within `joined` of the end of the one before belongs to it.
pub(super) fn counted(contacts: &[Contact], threshold: f64, joined: Option<f64>) -> Vec<f64> {
    let fast = contacts.iter().filter(|c| c.approach_speed > threshold);
    let Some(joined) = joined else { return fast.map(|c| c.start).collect() };
    let mut ends: Vec<(usize, f64)> = Vec::new();
    let mut starts = Vec::new();
    for contact in fast {
        let end = contact.end.unwrap_or(f64::INFINITY);
        match ends.iter_mut().find(|(wall, _)| *wall == contact.wall) {
            Some((_, last)) => {
                if contact.start > *last + joined {
                    starts.push(contact.start);
                }
                *last = last.max(end);
            }
            None => {
                starts.push(contact.start);
                ends.push((contact.wall, end));
            }
        }
    }
    starts.sort_by(f64::total_cmp);
    starts
}

/// Kinetic energy that arrived at the walls, J: for each contact with the mass that the wall feels,
/// but at least `least` per contact, since little mass arrives at the node of a fine mesh.
pub(super) fn exchanged(record: &Record, masses: &[f64], least: f64) -> f64 {
    let energy = |c: &Contact| 0.5 * masses.get(c.wall).copied().unwrap_or(0.0) * c.approach_speed * c.approach_speed;
    record.contacts.iter().map(energy).sum::<f64>().max(least).max(f64::MIN_POSITIVE)
}
