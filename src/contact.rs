//! Contact episodes: consecutive steps in which a wall pushes, joined into one row of the contact
//! table.
//!
//! A contact exists where a force or an impulse acts. A body that stands at a wall without pressing
//! is not in contact with it, whatever the scheme: the force that a scheme computes there is
//! rounding, and counts as 0.

mod floor;
mod open;

use crate::scene::{Scene, Side, Wall};
use crate::step::{Contact, Contract};
use floor::Floor;
use open::OpenEpisode;

/// An impact on a rigid wall takes one step in a velocity-level scheme and up to two in a
/// position-level one. Longer episodes are lasting contact, whose force is finite after those first
/// steps.
pub(crate) const IMPACT_STEPS: u64 = 2;

/// If the momentum that a rigid wall reverses in a step exceeds this share of the step's impulse,
/// the step contains an impact and impulse/h is not a force, nor at other rigid walls, to which the
/// structure may pass it on. (The last bounces of an accumulation come in adjacent steps and end in
/// a lasting force.)
const BLOW: f64 = 1e-2;

/// A part shorter than this, of the longest one, ends no contact: its impulse may be rounding.
const BRIEF: f64 = 1e-6;

/// The least length of the parts, of the longest one, over which a round wall's mean force is told.
const SHORT: f64 = 0.5;

/// Velocities of a step at the row of a wall, m/s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    /// At its start.
    pub before: f64,
    /// After the blows in it, which come first.
    pub struck: f64,
    /// At its end.
    pub after: f64,
}

/// Velocities of a part of a step at the row of a wall, m/s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartRates {
    /// At its start.
    pub before: f64,
    /// At its end, before the blows there.
    pub arrived: f64,
    /// After these blows.
    pub struck: f64,
    /// After the impacts at its end.
    pub after: f64,
}

/// Joins the impulses of a scheme on a grid into episodes, and closes an episode when a wall stops
/// pushing. A round wall counts as an upper one along the normal of each step, with positive
/// impulses.
#[derive(Debug, Clone)]
pub(crate) struct Episodes {
    instant: f64,
    /// Largest number of steps of an impact on a rigid wall.
    impact_steps: u64,
    /// The instant of the last impact at any wall, s, where steps are divided at impacts.
    last_impact: f64,
    /// The longest part so far, s.
    longest: f64,
    rigid: Vec<bool>,
    round: Vec<bool>,
    floor: Vec<Floor>,
    /// The mass that each wall feels, kg.
    mass: Vec<f64>,
    /// The dashpot of each wall where its spring does not push yet, N s/m.
    dashpot: Vec<f64>,
    side: Vec<Side>,
    /// The sign of each wall's impulses.
    sign: Vec<f64>,
    open: Vec<Option<OpenEpisode>>,
    any: bool,
    /// Walls that pushed in the last step.
    pushed: Vec<usize>,
    closed: Vec<Contact>,
}

impl Episodes {
    /// For `scene`, whose walls feel `masses` (kg).
    pub(crate) fn new(scene: &Scene, masses: &[f64], contract: Contract) -> Self {
        let walls = scene.walls.len();
        Self {
            instant: contract.instant,
            impact_steps: if contract.divides { 0 } else { IMPACT_STEPS },
            last_impact: f64::NEG_INFINITY,
            longest: 0.0,
            rigid: scene.walls.iter().map(|w| w.law.is_rigid()).collect(),
            round: scene.walls.iter().map(Wall::is_round).collect(),
            floor: Floor::all(scene, masses, contract),
            mass: masses.to_vec(),
            dashpot: scene.walls.iter().map(|w| w.law.dashpot(0.0)).collect(),
            side: scene.walls.iter().map(|w| w.side()).collect(),
            sign: scene.walls.iter().map(|w| w.sign()).collect(),
            open: vec![None; walls],
            any: false,
            pushed: Vec::with_capacity(walls),
            // A step may close both a rest and the impact that ended it.
            closed: Vec::with_capacity(2 * walls),
        }
    }

    /// Drops all episodes.
    pub(crate) fn forget(&mut self) {
        self.open.fill(None);
        self.pushed.clear();
        self.closed.clear();
        self.any = false;
    }

    /// Episodes that the last step closed.
    #[inline]
    pub(crate) fn closed(&self) -> &[Contact] {
        &self.closed
    }

    /// True if a step without impulses would change nothing: the common case, which must be cheap.
    #[inline]
    pub(crate) fn idle(&self) -> bool {
        !self.any && self.closed.is_empty()
    }

    /// Adds one step from `start` over `h` (s) with its impulses (N s) and, per wall, its
    /// velocities ẇ (m/s). `pushing` lists the walls with an impulse: only these are looked at.
    pub(crate) fn observe(
        &mut self,
        start: f64,
        h: f64,
        impulse: &[f64],
        pushing: &[usize],
        rates: impl Fn(usize) -> Rates,
    ) {
        self.closed.clear();
        self.any = false;
        let mut before = std::mem::take(&mut self.pushed);
        for &wall in &before {
            if impulse.get(wall).is_none_or(|&p| p == 0.0) {
                self.part(wall);
            }
        }
        let mut impact = false;
        for &wall in pushing {
            if let Some(&p) = impulse.get(wall) {
                impact |= self.push(wall, start + self.instant * h, (h, p), rates(wall));
            }
        }
        for &wall in pushing {
            if let (Some(Some(episode)), Some(p)) = (self.open.get_mut(wall), impulse.get(wall))
                && (!self.rigid[wall] || !(impact || episode.steps <= self.impact_steps))
            {
                episode.peak = Some(episode.peak.unwrap_or(0.0).max(p.abs() / h));
            }
        }
        before.clear();
        before.extend_from_slice(pushing);
        self.pushed = before;
    }

    /// Closes the episode, if any, of a wall that does not push.
    fn part(&mut self, wall: usize) {
        if let Some(episode) = self.open.get_mut(wall).and_then(Option::take) {
            self.closed.push(self.contact(wall, &episode, true));
        }
    }

    /// The contact at `wall`, ended or still open.
    fn contact(&self, wall: usize, episode: &OpenEpisode, ended: bool) -> Contact {
        let is_impact = self.rigid[wall] && episode.steps <= self.impact_steps;
        let contact = episode.contact(wall, self.sign[wall], is_impact, ended);
        // A dashpot pushes with c·v at the first instant; the mean over the first step is less.
        let at_once = self.dashpot[wall] * contact.approach_speed;
        Contact { peak_force: contact.peak_force.map(|peak| peak.max(at_once)), ..contact }
    }

    /// As [`Self::part`], for an impulse that is rounding: rare, so kept out of the fast path.
    #[cold]
    #[inline(never)]
    fn leave(&mut self, wall: usize) {
        self.part(wall);
    }

    /// True if the impulse `p` (N s) of a rigid wall is in large part that of an impact, at which
    /// the body arrives with the velocity ẇ `struck` (m/s).
    #[inline]
    fn reverses(&self, wall: usize, struck: f64, p: f64) -> bool {
        self.rigid[wall] && self.mass[wall] * struck.abs() > BLOW * p.abs()
    }

    /// Adds the impulse `p` (N s) of a wall in a step of `h` seconds. Returns whether it is that of
    /// an impact.
    fn push(&mut self, wall: usize, instant: f64, (h, p): (f64, f64), rates: Rates) -> bool {
        if self.floor[wall].holds(p, h) {
            self.leave(wall);
            return false;
        }
        let sign = self.side[wall].sign();
        let Rates { before, struck, after } = rates;
        // A blow towards a rigid wall ends a rest on it: an impact with an approach speed of its
        // own follows. In a spring the contact goes on.
        if self.rigid[wall] && sign * (struck - before) < 0.0 {
            self.part(wall);
        }
        let fresh = OpenEpisode::new(instant, (-sign * struck).max(0.0));
        let episode = self.open[wall].get_or_insert(fresh);
        episode.steps += 1;
        episode.last = instant;
        episode.impulse += p.abs();
        episode.moment += p.abs() * instant;
        episode.departure = (sign * after).max(0.0);
        self.any = true;
        self.reverses(wall, struck, p)
    }

    /// Adds a part of a step of `length` seconds, at whose end the impulses `jump` (N s) act; the
    /// rest of `impulse` acts over it.
    pub(crate) fn observe_part(
        &mut self,
        [start, end]: [f64; 2],
        length: f64,
        (impulse, jump): (&[f64], &[f64]),
        pushing: &[usize],
        rates: impl Fn(usize) -> PartRates,
    ) {
        self.closed.clear();
        let over = |wall: usize| impulse[wall] - jump[wall];
        self.longest = self.longest.max(length);
        if length > BRIEF * self.longest {
            let mut pushed = std::mem::take(&mut self.pushed);
            pushed.retain(|&wall| {
                let pushes = over(wall) != 0.0 && !self.floor[wall].holds(over(wall), length);
                if !pushes {
                    self.release(wall, [start, end], rates(wall));
                }
                pushes
            });
            self.pushed = pushed;
        }
        // Beside a blow elsewhere, or at an instant of its own, the impulse of a contact that lasts
        // on may be rounding.
        let rounding = pushing.iter().fold(0.0, |most: f64, &wall| most.max(jump[wall].abs())) * f64::EPSILON;
        for &wall in pushing {
            let struck = jump[wall].abs() > rounding.max(self.floor[wall].force * self.longest);
            if length > 0.0 && over(wall) != 0.0 && !self.floor[wall].holds(over(wall), length) {
                let (rates, round, longest) = (rates(wall), self.round[wall], self.longest);
                let episode = self.open(wall, start, rates.before);
                episode.steps += 1;
                (episode.last, episode.impulse) = (end, episode.impulse + over(wall).abs());
                let force = over(wall).abs() / length;
                episode.forces = [episode.forces[1], Some((0.5 * (start + end), force))];
                episode.acceleration = (rates.arrived - rates.before) / length;
                episode.blown = rates.struck != rates.arrived;
                episode.short = (episode.short.0 + over(wall).abs(), episode.short.1 + length);
                // Along a circle a short part reflects what a long one has left across it.
                if !round || episode.short.1 >= SHORT * longest {
                    let (impulse, span) = std::mem::take(&mut episode.short);
                    episode.peak = Some(episode.peak.unwrap_or(0.0).max(impulse / span));
                }
                // It ends as the impact begins.
                self.leave_at(wall, if struck { rates.struck } else { rates.after });
            }
            if struck {
                self.last_impact = end;
                let rates = rates(wall);
                // What the structure passes on from an impact elsewhere ends no contact that lasts.
                if self.reverses(wall, rates.struck, jump[wall]) {
                    self.part(wall);
                }
                let episode = self.open(wall, end, rates.struck);
                (episode.impulse, episode.last) = (episode.impulse + jump[wall].abs(), end);
                episode.moment += jump[wall].abs() * end;
                self.leave_at(wall, rates.after);
            }
        }
        self.any = !self.pushed.is_empty();
    }

    /// The open episode at a wall, begun now at `time` (s) with the velocity ẇ `rate` (m/s) unless
    /// there is one.
    fn open(&mut self, wall: usize, time: f64, rate: f64) -> &mut OpenEpisode {
        if !self.pushed.contains(&wall) {
            self.pushed.push(wall);
        }
        let approach = (-self.side[wall].sign() * rate).max(0.0);
        self.open[wall].get_or_insert(OpenEpisode::new(time, approach))
    }

    /// Closes the episode of a wall that does not push in the part from `start` to `end` (s) with
    /// these velocities. Where the last one did not end with an impact, its force vanished between
    /// the middle of that part and of this one: where the straight line through its last two means
    /// does, or at a blow between the two parts. The velocity is linear over a part.
    fn release(&mut self, wall: usize, [start, end]: [f64; 2], rates: PartRates) {
        let sign = self.side[wall].sign();
        if let Some(episode) = self.open[wall].as_mut().filter(|_| start > self.last_impact)
            && let [Some((before, more)), Some((middle, force))] = episode.forces
            && more > force
        {
            let vanishes = middle + force * (middle - before) / (more - force);
            episode.last = vanishes.clamp(middle, if episode.blown { start } else { 0.5 * (start + end) });
            let now = (rates.arrived - rates.before) / (end - start);
            let acceleration = if episode.last < start { episode.acceleration } else { now };
            let left = rates.before + acceleration * (episode.last - start);
            episode.departure = (sign * left).max(0.0);
        }
        self.part(wall);
    }

    /// Sets the velocity ẇ (m/s) with which the body leaves a wall.
    fn leave_at(&mut self, wall: usize, rate: f64) {
        let departure = (self.side[wall].sign() * rate).max(0.0);
        if let Some(episode) = &mut self.open[wall] {
            episode.departure = departure;
        }
    }

    /// Episodes still open at the end of the run.
    pub(crate) fn still_open(&self) -> Vec<Contact> {
        let rows = self.open.iter().enumerate().filter_map(|(wall, open)| open.as_ref().map(|e| (wall, e)));
        rows.map(|(wall, episode)| self.contact(wall, episode, false)).collect()
    }
}

#[cfg(test)]
mod tests;
