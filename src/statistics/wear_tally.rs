//! Wear statistics of supports: work of wear, sliding and friction, step by step.

use super::batch::{BatchSums, NO_SUMS, Window};
use super::settling::Beginning;
use crate::contact::IMPACT_STEPS;
use crate::scene::Scene;
use crate::step::{Path, Step};
use crate::wear::{ImpulseDuration, SlidingContacts, SlidingPiece, WearWork, sectors_over};
use serde::{Deserialize, Serialize};

/// A support over the window of the statistics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct WearStatistics {
    /// The support's name.
    pub support: String,
    /// Its kinetic coefficient of friction.
    pub friction: f64,
    /// True without friction: then the work rate is an upper figure. A structure that slides
    /// without friction is held back by its own damping alone, and may whirl round in the support.
    pub upper_figure: bool,
    /// Work rate W/T, W: the work of wear ∫ F_n |v_t| dt over the window, per unit time.
    pub work_rate_w: f64,
    /// Half width of its 95 % interval by batch means, W; `None` unless the support pushed in each
    /// batch.
    pub work_rate_half_width_95_w: Option<f64>,
    /// Work rate over the first and over the last half of the batches, W.
    #[serde(default)]
    pub work_rate_of_halves_w: [f64; 2],
    /// The share of the work that impacts did: of a scheme on a grid, the first two steps of each
    /// contact. `None` for an elastic support, where no force is an impulse, and without work.
    pub impact_share: Option<f64>,
    /// Distance slid in contact, m; impacts have none, since they take no time.
    pub sliding_m: f64,
    /// Mean sliding speed in contact, m/s: that distance over the time in contact; `None` without
    /// contact that lasts.
    pub sliding_speed_m_per_s: Option<f64>,
    /// What friction takes out of the motion per unit time, W.
    pub friction_power_w: f64,
    /// Time in contact over the window's length: of all steps in which it pushes, but for contacts
    /// of one or two steps at rigid walls, which are impacts and take none. A wall's is that of its
    /// contact episodes, up to half a step less at both ends of each. On a rigid support it depends
    /// on the step and on the number of modes.
    pub contact_time_ratio: f64,
    /// The sectors, from +y towards +z.
    pub sectors: Vec<SectorStatistics>,
    /// Work rate of each of its walls, W, in their order.
    #[serde(default)]
    pub wall_work_rates_w: Vec<f64>,
}

impl WearStatistics {
    /// Its work rates, W: all, by sector and by wall.
    #[must_use]
    pub fn rates(&self) -> WearWork {
        let sectors = self.sectors.iter().map(|sector| sector.work_rate_w).collect();
        WearWork { total: self.work_rate_w, sectors, walls: self.wall_work_rates_w.clone() }
    }
}

/// A sector of a support.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct SectorStatistics {
    /// Where it begins, degrees from +y towards +z.
    pub from_deg: f64,
    /// Where it ends, degrees.
    pub to_deg: f64,
    /// Work rate of the contacts in it, W.
    pub work_rate_w: f64,
    /// Its share of the support's impulse Σ|p|.
    pub impulse_share: f64,
}

/// The sums of one support.
#[derive(Debug, Clone)]
struct Tally {
    name: String,
    friction: f64,
    /// Σ|p|, N s, and the work of wear, J, by batches.
    pushed: BatchSums,
    work: BatchSums,
    impacts: f64,
    /// True once an impulse came whose force is not known.
    rigid: bool,
    sliding: f64,
    time: f64,
    dissipated: f64,
    /// Work, J, and Σ|p|, N s, by sectors.
    sectors: Vec<[f64; 2]>,
    /// The index of its first wall, and the work at each, J.
    first: usize,
    walls: Vec<f64>,
    /// The steps in which any of its contacts pushed.
    episode: Episode,
}

/// Neighbouring steps of a scheme on a grid in which a contact pushed.
#[derive(Debug, Clone, Copy, Default)]
struct Episode {
    /// The step after the last, and their number.
    next: u64,
    steps: u64,
    /// What the first steps add if the episode lasts.
    waiting: f64,
}

impl Episode {
    /// Adds step number `index` with `amount`; returns the number of steps, and the amount that is
    /// now known to belong to contact that lasts.
    fn add(&mut self, index: u64, amount: f64) -> (u64, f64) {
        if self.steps == 0 || self.next != index {
            *self = Self::default();
        }
        (self.next, self.steps) = (index + 1, self.steps + 1);
        self.waiting += amount;
        let lasts = self.steps > IMPACT_STEPS;
        (self.steps, if lasts { std::mem::take(&mut self.waiting) } else { 0.0 })
    }
}

/// Sums up what slides at the supports over the steps of a run: flats under every scheme, round
/// holes under those that step them.
///
/// On a grid the impulse of a step at a rigid support may be that of an impact or of a force that
/// lasts: contacts of at most two steps are impacts, which slide no distance and take no time.
#[derive(Debug, Clone)]
pub struct WearTally {
    window: Window,
    sliding: SlidingContacts,
    tallies: Tallies,
}

/// The sums of all supports.
#[derive(Debug, Clone)]
struct Tallies {
    supports: Vec<Tally>,
    /// One for each contact.
    episodes: Vec<Episode>,
    /// The last step in which each support was in contact, and where its last part began, s.
    touched: Vec<Option<(u64, f64)>>,
}

impl WearTally {
    /// For the supports of `scene` (as the scheme sees it), from the time `from` (s) to the end,
    /// with the work divided among `sectors` equal sectors.
    #[must_use]
    pub fn new(scene: &Scene, from: f64, sectors: usize) -> Self {
        let tally = |support: &crate::scene::Support| Tally {
            name: support.name.clone(),
            friction: support.friction(&scene.walls).sliding,
            pushed: NO_SUMS,
            work: NO_SUMS,
            impacts: 0.0,
            rigid: false,
            sliding: 0.0,
            time: 0.0,
            dissipated: 0.0,
            sectors: vec![[0.0; 2]; sectors],
            first: support.walls.start,
            walls: vec![0.0; support.walls.len()],
            episode: Episode::default(),
        };
        let sliding = SlidingContacts::new(scene);
        Self {
            window: Window::new(scene, from),
            tallies: Tallies {
                supports: scene.supports.iter().map(tally).collect(),
                episodes: vec![Episode::default(); sliding.contacts()],
                touched: vec![None; scene.supports.len()],
            },
            sliding,
        }
    }

    /// Adds one step; steps must come in order.
    #[inline]
    pub fn observe(&mut self, step: &Step<'_>) {
        self.observe_beside(step, ([f64::NAN; 2], &[]));
    }

    /// The same beside an observer that found what `slid` between two times, s.
    #[inline]
    pub(crate) fn observe_beside(&mut self, step: &Step<'_>, slid: ([f64; 2], &[SlidingPiece])) {
        if !self.sliding.is_empty() && step.end >= self.window.from && self.window.length > 0.0 {
            self.add(step, slid);
        }
    }

    fn add(&mut self, step: &Step<'_>, (within, pieces): ([f64; 2], &[SlidingPiece])) {
        let end = self.window.from + self.window.length;
        // Rounding of the last step's end is no time after the window.
        let part = [step.start.max(self.window.from), if step.end > end { end } else { step.end }];
        if !matches!(step.path, Path::Series(_)) {
            if within == part {
                return pieces.iter().for_each(|piece| self.tallies.add(piece, step, part, &self.window));
            }
            return self.add_part(step, part);
        }
        // Exact motion may last over many batches.
        let mut from = part[0];
        loop {
            let edge = self.window.end_at(from);
            let to = if edge > from && edge < part[1] { edge } else { part[1] };
            self.add_part(step, [from, to]);
            if to >= part[1] {
                return;
            }
            from = to;
        }
    }

    /// Adds the part of a step between two times in it, s, which lies in one batch.
    fn add_part(&mut self, step: &Step<'_>, part: [f64; 2]) {
        let Self { sliding, tallies, window } = self;
        sliding.observe(step, part, |piece| tallies.add(piece, step, part, window));
    }

    /// The statistics of each support, in the scene's order; none for a window of length 0.
    #[must_use]
    pub fn statistics(&self) -> Vec<WearStatistics> {
        if self.window.length <= 0.0 {
            return Vec::new();
        }
        self.tallies.supports.iter().map(|tally| tally.statistics(&self.window)).collect()
    }

    /// The work rate of support number `support`, one of `means` means, in the beginning of the
    /// window, if that differs from the rest.
    pub(super) fn beginning(&self, support: usize, means: usize) -> Option<Beginning> {
        self.window.beginning(&self.tallies.supports.get(support)?.work, means)
    }
}

impl Tallies {
    /// Adds what slid in a step between two times in it, s.
    fn add(&mut self, piece: &SlidingPiece, step: &Step<'_>, part: [f64; 2], window: &Window) {
        let Some(tally) = self.supports.get_mut(piece.support) else { return };
        let middle = if piece.duration == ImpulseDuration::Instant { step.end } else { 0.5 * (part[0] + part[1]) };
        tally.add(piece, window.index(middle));
        // The time of a support counts once, whichever of its walls push over the part: a blow has
        // none.
        let part = Some((step.index, part[0]));
        let touched = self.touched.get_mut(piece.support).filter(|_| piece.duration != ImpulseDuration::Instant);
        let first = touched.is_some_and(|last| std::mem::replace(last, part) != part);
        match piece.duration {
            ImpulseDuration::Instant => tally.impacts += piece.work,
            ImpulseDuration::Lasting => {
                tally.sliding += piece.sliding;
                tally.time += if first { piece.time } else { 0.0 };
            }
            ImpulseDuration::Unresolved => {
                let Some(episode) = self.episodes.get_mut(piece.contact) else { return };
                let (steps, sliding) = episode.add(step.index, piece.sliding);
                tally.sliding += sliding;
                tally.impacts += if steps <= IMPACT_STEPS { piece.work } else { 0.0 };
                if first {
                    tally.time += tally.episode.add(step.index, piece.time).1;
                }
            }
        }
    }
}

impl Tally {
    fn add(&mut self, piece: &SlidingPiece, batch: usize) {
        self.pushed[batch] += piece.impulse;
        self.work[batch] += piece.work;
        self.dissipated += piece.dissipated;
        self.rigid |= piece.duration != ImpulseDuration::Lasting;
        for (sector, share) in sectors_over(piece.angle, piece.turn, self.sectors.len()) {
            if let Some([work, pushed]) = self.sectors.get_mut(sector) {
                *work += share * piece.work;
                *pushed += share * piece.impulse;
            }
        }
        let wall = piece.contact.checked_sub(self.first).and_then(|wall| self.walls.get_mut(wall));
        wall.into_iter().for_each(|work| *work += piece.work);
    }

    fn statistics(&self, window: &Window) -> WearStatistics {
        let total = |batches: &BatchSums| batches.iter().sum::<f64>();
        let (work, pushed, length) = (total(&self.work), total(&self.pushed), window.length);
        let count = self.sectors.len();
        let edge = |k: usize| 360.0 * k as f64 / count as f64;
        let sectors = self.sectors.iter().enumerate().map(|(k, [work, p])| SectorStatistics {
            from_deg: edge(k),
            to_deg: edge(k + 1),
            work_rate_w: work / length,
            impulse_share: if pushed > 0.0 { p / pushed } else { 0.0 },
        });
        WearStatistics {
            support: self.name.clone(),
            friction: self.friction,
            upper_figure: self.friction == 0.0,
            work_rate_w: work / length,
            work_rate_half_width_95_w: window.half_width(&self.work).filter(|_| window.has_interval(&self.pushed, 0)),
            work_rate_of_halves_w: window.means_of_halves(&self.work),
            impact_share: (self.rigid && work > 0.0).then(|| (self.impacts / work).min(1.0)),
            sliding_m: self.sliding,
            sliding_speed_m_per_s: (self.time > 0.0).then(|| self.sliding / self.time),
            friction_power_w: self.dissipated / length,
            contact_time_ratio: self.time / length,
            sectors: sectors.collect(),
            wall_work_rates_w: self.walls.iter().map(|work| work / length).collect(),
        }
    }
}
