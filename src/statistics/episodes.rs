//! Contact episodes of walls and supports, joined over short rests.

use super::distribution::Distribution;
use super::place::{ContactPlace, PlaceKind};
use super::{Statistics, by_wall};
use crate::order::sort_by_number;
use crate::scene::Scene;
use crate::step::Contact;
use serde::Serialize;

/// The episodes of one wall or support that began in the window.
///
/// A body that settles on a wall bounces many times, and a structure of many modes rattles at high
/// frequency while it leans on a stop: such bounces are one event of wear. Contacts that follow one
/// another after a rest of less than a given time are joined into one episode; at a support those
/// of all its flats, and contacts that overlap in any case.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EpisodeStatistics {
    /// Where.
    #[serde(flatten)]
    pub place: ContactPlace,
    /// Number of episodes. Without joining it grows with each further mode and each smaller step.
    pub episodes: usize,
    /// That number per second.
    pub episodes_per_s: f64,
    /// Σ|p| of an episode, N s.
    pub impulse_n_s: Option<Distribution>,
    /// Largest speed in an episode with which a contact in it began, m/s.
    pub approach_speed_m_per_s: Option<Distribution>,
    /// Largest |force| in an episode, N; of elastic walls only, since the force of an impact on a
    /// rigid wall is not finite.
    pub peak_force_n: Option<Distribution>,
}

/// One episode.
#[derive(Debug, Clone, Copy)]
struct Episode {
    start: f64,
    end: f64,
    impulse: f64,
    speed: f64,
    peak: Option<f64>,
}

impl EpisodeStatistics {
    /// Those of every flat wall, then of every support of `scene`, from the `contacts` of a run
    /// with these `statistics` and their window, joined where less than `rest` (s) lies between
    /// them.
    #[must_use]
    pub fn of(scene: &Scene, statistics: &Statistics, contacts: &[Contact], rest: f64) -> Vec<Self> {
        let window = [statistics.from_s, statistics.to_s];
        let by_wall = by_wall(contacts, scene.walls.len());
        let mut all = Vec::with_capacity(scene.walls.len() + scene.supports.len());
        let flats = scene.walls.iter().zip(statistics.walls.iter().zip(&by_wall)).filter(|(wall, _)| !wall.is_round());
        for (_, (wall, own)) in flats {
            let place = ContactPlace { name: wall.wall.clone(), kind: PlaceKind::Wall };
            let elastic = wall.force.is_some_and(|force| force.rms_averaged_over_s.is_none());
            all.push(Self::at(place, own.clone(), elastic, window, rest));
        }
        for support in &scene.supports {
            let place = ContactPlace { name: support.name.clone(), kind: PlaceKind::Support };
            let own = by_wall.get(support.walls.clone()).unwrap_or_default();
            all.push(Self::at(place, own.concat(), false, window, rest));
        }
        all
    }

    fn at(place: ContactPlace, contacts: Vec<&Contact>, elastic: bool, [from, to]: [f64; 2], rest: f64) -> Self {
        let joined = join(contacts, to, rest);
        let here: Vec<Episode> = joined.into_iter().filter(|episode| episode.start >= from).collect();
        let of = |what: fn(&Episode) -> f64| Distribution::of(here.iter().map(what).collect());
        let peaks = || Distribution::of(here.iter().filter_map(|episode| episode.peak).collect());
        Self {
            place,
            episodes: here.len(),
            episodes_per_s: if to > from { here.len() as f64 / (to - from) } else { 0.0 },
            impulse_n_s: of(|episode| episode.impulse),
            approach_speed_m_per_s: of(|episode| episode.speed),
            peak_force_n: if elastic { peaks() } else { None },
        }
    }
}

/// Joins contacts that overlap, or between which less than `rest` (s) lies; one that is open lasts
/// until `to` (s).
fn join(mut contacts: Vec<&Contact>, to: f64, rest: f64) -> Vec<Episode> {
    sort_by_number(&mut contacts, |a| a.start);
    let mut episodes: Vec<Episode> = Vec::new();
    for contact in contacts {
        let end = contact.end.unwrap_or(to);
        match episodes.last_mut().filter(|last| contact.start - last.end < rest) {
            Some(last) => {
                last.end = last.end.max(end);
                last.impulse += contact.impulse.abs();
                last.speed = last.speed.max(contact.approach_speed);
                last.peak = last.peak.into_iter().chain(contact.peak_force).reduce(f64::max);
            }
            None => episodes.push(Episode {
                start: contact.start,
                end,
                impulse: contact.impulse.abs(),
                speed: contact.approach_speed,
                peak: contact.peak_force,
            }),
        }
    }
    episodes
}
