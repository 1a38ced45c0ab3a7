//! Contact episodes: consecutive steps in which a wall pushes, joined into one row of the contact
//! table.
//!
//! A contact exists where a force or an impulse acts. A body that stands at a wall without pressing
//! is not in contact with it, whatever the scheme: the force that a scheme computes there is
//! rounding, and counts as 0.

use crate::scene::{LoadKind, Scene, Side, System, Wall, WallLaw};
use crate::step::{Bound, Contact, Contract};

/// An impact on a rigid wall takes one step in a velocity-level scheme and up to two in a
/// position-level one. Longer episodes are lasting contact, whose force is finite after those first
/// steps.
pub(crate) const IMPACT_STEPS: u64 = 2;

/// Rounding error of a sum of a few terms, relative to the largest.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Limit up to which an impulse at one wall is rounding: `force` · h + `inertia`/h, N s.
#[derive(Debug, Clone, Copy)]
struct Floor {
    /// N: rounding error of the forces that balance where a body rests.
    force: f64,
    /// kg m: rounding error of the displacement times the mass, where a scheme computes its
    /// impulses from displacements.
    inertia: f64,
}

impl Floor {
    /// One per wall of `scene`.
    fn all(scene: &Scene, masses: &[f64], contract: Contract) -> Vec<Self> {
        let size = |kind: &LoadKind| match kind {
            LoadKind::Constant { force } => force.abs(),
            LoadKind::Harmonic { amplitude, .. } => amplitude.abs(),
            LoadKind::Table(table) => table.force().iter().fold(0.0, |most: f64, f| most.max(f.abs())),
            _ => 0.0,
        };
        let loads: f64 = scene.loads.iter().map(|load| size(&load.kind)).sum();
        // For a structure the loads alone set the scale: what its springs carry at rest comes from
        // the loads.
        let spring = if let System::Oscillator(o) = scene.system { o.stiffness } else { 0.0 };
        let positions = matches!(contract.promise.rigid.displacement, Some(Bound::End | Bound::Reflected));
        let spring_of = |law: WallLaw| law.spring().map_or(0.0, |spring| spring.stiffness);
        let floor = |(wall, mass): (&crate::scene::Wall, &f64)| {
            let place = wall.position().abs();
            let own = spring_of(wall.law);
            let displaced = if wall.is_round() { contract.promise.hole.is_some() } else { positions };
            let inertia = if displaced { mass * place } else { 0.0 };
            Self { force: ROUNDING * (loads + (spring + own) * place), inertia: ROUNDING * inertia }
        };
        scene.walls.iter().zip(masses).map(floor).collect()
    }

    /// True if an impulse `p` (N s) of a step of `h` (s) is rounding; without a division, since
    /// this runs for every pushing wall in every step.
    #[inline]
    fn holds(&self, p: f64, h: f64) -> bool {
        p.abs() * h <= self.force * h * h + self.inertia
    }
}

/// If the momentum that a rigid wall reverses in a step exceeds this share of the step's impulse,
/// the step contains an impact and impulse/h is not a force. (The last bounces of an accumulation
/// come in adjacent steps and end in a lasting force.)
const BLOW: f64 = 1e-2;

/// The least length of the parts, of the longest one, over which a round wall's mean force is told.
const SHORT: f64 = 0.5;

/// An open episode at one wall.
#[derive(Debug, Clone, Copy)]
struct Open {
    first: f64,
    last: f64,
    steps: u64,
    impulse: f64,
    /// ∫ t dp, for the instant of an impact spread over two steps.
    moment: f64,
    /// Largest finite force, N; `None` while every step had an impact in it.
    peak: Option<f64>,
    /// The middle (s) of the last two parts in which the wall pushed, and its mean force there, N.
    forces: [Option<(f64, f64)>; 2],
    /// Impulse and length of parts too short for a mean force of their own, N s and s.
    short: (f64, f64),
    approach: f64,
    departure: f64,
}

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
    side: Vec<Side>,
    /// The sign of each wall's impulses.
    sign: Vec<f64>,
    open: Vec<Option<Open>>,
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
        for &wall in pushing {
            if let Some(&p) = impulse.get(wall) {
                self.push(wall, start + self.instant * h, h, p, rates(wall));
            }
        }
        before.clear();
        before.extend_from_slice(pushing);
        self.pushed = before;
    }

    /// The sign of the impulse of an episode.
    fn sign(&self, wall: usize) -> f64 {
        self.sign[wall]
    }

    /// Closes the episode, if any, of a wall that does not push.
    fn part(&mut self, wall: usize) {
        if let Some(episode) = self.open.get_mut(wall).and_then(Option::take) {
            let is_impact = self.is_impact(wall, &episode);
            self.closed.push(contact(wall, self.sign(wall), is_impact, &episode, true));
        }
    }

    /// True if an episode at this wall is an impact, which has no finite force.
    fn is_impact(&self, wall: usize, episode: &Open) -> bool {
        self.rigid[wall] && episode.steps <= self.impact_steps
    }

    /// As [`Self::part`], for an impulse that is rounding: rare, so kept out of the fast path.
    #[cold]
    #[inline(never)]
    fn leave(&mut self, wall: usize) {
        self.part(wall);
    }

    fn push(&mut self, wall: usize, instant: f64, h: f64, p: f64, rates: Rates) {
        if self.floor[wall].holds(p, h) {
            return self.leave(wall);
        }
        let sign = self.side[wall].sign();
        let Rates { before, struck, after } = rates;
        // A blow towards a rigid wall ends a rest on it: an impact with an approach speed of its
        // own follows. In a spring the contact goes on.
        if self.rigid[wall] && sign * (struck - before) < 0.0 {
            self.part(wall);
        }
        let fresh = Open {
            first: instant,
            last: instant,
            steps: 0,
            impulse: 0.0,
            moment: 0.0,
            peak: None,
            forces: [None; 2],
            short: (0.0, 0.0),
            approach: (-sign * struck).max(0.0),
            departure: 0.0,
        };
        let episode = self.open[wall].get_or_insert(fresh);
        episode.steps += 1;
        episode.last = instant;
        episode.impulse += p.abs();
        episode.moment += p.abs() * instant;
        episode.departure = (sign * after).max(0.0);
        let blow = episode.steps <= self.impact_steps || self.mass[wall] * struck.abs() > BLOW * p.abs();
        if !self.rigid[wall] || !blow {
            episode.peak = Some(episode.peak.unwrap_or(0.0).max(p.abs() / h));
        }
        self.any = true;
    }

    /// Adds a part of a step of `length` seconds, at whose end the impulses `jump` (N s) act; the
    /// rest of `impulse` acts over it. The velocities ẇ (m/s) are those at its end: before it,
    /// after its blows, after the jump.
    pub(crate) fn observe_part(
        &mut self,
        [start, end]: [f64; 2],
        length: f64,
        (impulse, jump): (&[f64], &[f64]),
        pushing: &[usize],
        rates: impl Fn(usize) -> Rates,
    ) {
        self.closed.clear();
        let over = |wall: usize| impulse[wall] - jump[wall];
        self.longest = self.longest.max(length);
        if length > 0.0 {
            let mut pushed = std::mem::take(&mut self.pushed);
            pushed.retain(|&wall| {
                let pushes = over(wall) != 0.0 && !self.floor[wall].holds(over(wall), length);
                if !pushes {
                    self.release(wall, [start, end]);
                }
                pushes
            });
            self.pushed = pushed;
        }
        for &wall in pushing {
            if length > 0.0 && over(wall) != 0.0 && !self.floor[wall].holds(over(wall), length) {
                let (rates, round, longest) = (rates(wall), self.round[wall], self.longest);
                let episode = self.open(wall, start, rates.before);
                episode.steps += 1;
                (episode.last, episode.impulse) = (end, episode.impulse + over(wall).abs());
                let force = over(wall).abs() / length;
                episode.forces = [episode.forces[1], Some((0.5 * (start + end), force))];
                episode.short = (episode.short.0 + over(wall).abs(), episode.short.1 + length);
                // Along a circle a short part reflects what a long one has left across it.
                if !round || episode.short.1 >= SHORT * longest {
                    let (impulse, span) = std::mem::take(&mut episode.short);
                    episode.peak = Some(episode.peak.unwrap_or(0.0).max(impulse / span));
                }
                self.leave_at(wall, rates.after);
            }
            if jump[wall] != 0.0 {
                self.last_impact = end;
                self.part(wall);
                let rates = rates(wall);
                let episode = self.open(wall, end, rates.struck);
                (episode.impulse, episode.moment) = (jump[wall].abs(), jump[wall].abs() * end);
                self.leave_at(wall, rates.after);
            }
        }
        self.any = !self.pushed.is_empty();
    }

    /// The open episode at a wall, begun now at `time` (s) with the velocity ẇ `rate` (m/s) unless
    /// there is one.
    fn open(&mut self, wall: usize, time: f64, rate: f64) -> &mut Open {
        if !self.pushed.contains(&wall) {
            self.pushed.push(wall);
        }
        let approach = (-self.side[wall].sign() * rate).max(0.0);
        self.open[wall].get_or_insert(Open {
            first: time,
            last: time,
            steps: 0,
            impulse: 0.0,
            moment: 0.0,
            peak: None,
            forces: [None; 2],
            short: (0.0, 0.0),
            approach,
            departure: 0.0,
        })
    }

    /// Closes the episode of a wall that does not push in the part from `start` to `end` (s). Where
    /// the last one did not end with an impact, its force vanished between the middle of that part
    /// and of this one: where the straight line through its last two means does.
    fn release(&mut self, wall: usize, [start, end]: [f64; 2]) {
        if let Some(episode) = self.open[wall].as_mut().filter(|_| start > self.last_impact)
            && let [Some((before, more)), Some((middle, force))] = episode.forces
            && more > force
        {
            let vanishes = middle + force * (middle - before) / (more - force);
            episode.last = vanishes.clamp(middle, 0.5 * (start + end));
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
        rows.map(|(wall, e)| contact(wall, self.sign(wall), self.is_impact(wall, e), e, false)).collect()
    }
}

/// The mean force of an impulse over some length; `None` without one.
fn mean_of((impulse, length): (f64, f64)) -> Option<f64> {
    (length > 0.0).then(|| impulse / length)
}

fn contact(wall: usize, sign: f64, impact: bool, episode: &Open, ended: bool) -> Contact {
    let (start, end) = if impact {
        let mean = episode.moment / episode.impulse;
        (mean, mean)
    } else {
        (episode.first, episode.last)
    };
    Contact {
        wall,
        start,
        end: ended.then_some(end),
        impulse: sign * episode.impulse,
        peak_force: if impact { None } else { episode.peak.or_else(|| mean_of(episode.short)) },
        approach_speed: episode.approach,
        departure_speed: ended.then_some(episode.departure),
    }
}

#[cfg(test)]
mod tests;
