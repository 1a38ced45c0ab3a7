//! The exact scheme of one degree of freedom: closed-form motion between events, which are located
//! to rounding.

mod flight;
mod gap_bounds;
mod instant;
mod motion;
mod root;
mod search;
mod view;

pub use super::exact::{EVENTS_PER_WINDOW, EventCounters, WINDOWS};

use super::exact::{CHANGES_AT_ONCE, Clock, ExactWall, StepOutput, barriers, known_loads, noise};
use super::line::Line;
use crate::error::{Error, Result};
use crate::flow::Arc;
use crate::scene::{Forcing, Oscillator, Scene, System};
use gap_bounds::GapBounds;

/// One degree of freedom between walls, advanced from event to event:
///
/// m q̈ + c q̇ + k q = f(t) + r, 0 ≤ gap ⟂ |r| ≥ 0 and ẇ⁺ = −e ẇ⁻ at a rigid wall, |r| = max(0, k_a
/// s + c_a ṡ) for s > 0 at an elastic one.
///
/// Between events the motion is an [`Arc`]. A flight in front of all walls is followed in leaps,
/// each shown to be free of contact by the cubic through both of its ends and a bound on its error.
/// Where that does not tell, the first root of each gap, and of the force of each wall that
/// touches, is approached from one side by polynomials that are lower bounds of the function. Both
/// use bounds by [`Arc`], so that no root is skipped: neither a grazing contact nor a wall is
/// missed. Gaps are resolved to rounding; a miss by less than that counts as a touch.
///
/// - A touch without approach speed, such as the tangential return of an undamped motion, is
///   located at the extremum of the gap: it has no speed and no impulse, and is no contact.
/// - An approach to a rigid wall is an impact, −m(1 + e)v. The body sticks if the flight after it
///   is unresolved in double precision, or (e < 1) lower than 1e-12 of [`Scene::gap_scale`] while
///   the pressing acceleration changes by less than 1e-6 until t∞ = t + flight/(1 − e): the rest
///   that follows carries the impulse of the tail. It also sticks, at any e below that height, if
///   the drag c makes the flights decay, like exp(−ct/3m), until they are not resolved, before the
///   pressing acceleration can have lost half of its value: those impacts have no t∞.
/// - A blow ends a rest: what it does at the wall is a new impact, at the speed that the blow
///   gives.
/// - A body at rest leaves where the pressing force becomes tensile; a force that touches 0 does
///   not release it. Contact lasts while a force acts: a body that stands at a wall without
///   pressing is not in contact with it.
/// - A motion that has decayed to ε² of the largest displacement and of the largest speed so far is
///   set to rest at the origin.
/// - More than [`EVENTS_PER_WINDOW`] events, or evaluations in the search for one, in 1/[`WINDOWS`]
///   of the duration are an error, [`Error::TooManyEvents`].
#[derive(Debug, Clone)]
pub struct Event {
    body: Oscillator,
    forcing: Forcing,
    barriers: Vec<ExactWall>,
    /// True if a wall is elastic.
    soft: bool,
    /// The largest distance of a near wall from the origin, m.
    farthest: f64,
    /// Between the walls, while the body is in front of all of them.
    room: Option<GapBounds>,
    clock: Clock,
    /// A typical displacement of the scene, m.
    length: f64,
    arc: Arc,
    time: f64,
    /// The rounding error of `time`, s: the present is this much later.
    late: f64,
    q: f64,
    v: f64,
    /// The largest displacement (m) and speed (m/s) so far.
    largest: [f64; 2],
    /// The rigid wall that carries the body at rest.
    support: Option<usize>,
    /// Index of the next impulsive load.
    blow: usize,
    /// When a body of velocity 0 was last found not to be held by the walls it touches, s.
    released: f64,
    accumulation: Option<f64>,
    /// Sizes of the terms of the acceleration (m/s²) and of its rate (m/s³): below their rounding
    /// nothing presses.
    force_size: [f64; 2],
    /// A gap below this counts as 0, m: rounding of the displacement.
    resolution: f64,
    /// [`Arc::sizes`] of the present arc.
    sizes: [f64; 4],
    steps: u64,
    shown: StepOutput<Line>,
    velocity_left: f64,
}

impl Event {
    /// The scene at its start, after the impulses at t = 0. Steps end at events and at multiples of
    /// `stride` (s).
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scene that does not validate, a stride that is not a finite number
    /// above 0, or a wall of the φ² penalty or a function of time as load, which have no
    /// closed-form motion.
    pub fn new(scene: &Scene, stride: f64) -> Result<Self> {
        scene.validate()?;
        Self::over(scene, stride)
    }

    /// The same over a scene that is checked already.
    pub(in crate::scheme) fn over(scene: &Scene, stride: f64) -> Result<Self> {
        known_loads(scene)?;
        if !(stride.is_finite() && stride > 0.0) {
            return Err(Error::invalid("stride", stride, "a finite number above 0"));
        }
        let System::Oscillator(body) = scene.system else {
            return Err(Error::invalid("scheme", "event", "one degree of freedom"));
        };
        let barriers = barriers(scene)?;
        let forcing = Forcing::on(0, &scene.loads);
        let q = scene.initial.q.first().copied().unwrap_or(0.0);
        let v = scene.initial.v.first().copied().unwrap_or(0.0) + forcing.initial_impulse() / body.mass;
        let walls = barriers.len();
        let farthest = scene.farthest_near_wall();
        let arc = Arc::new(body, walls, &forcing);
        // Blows at t = 0 are part of the initial state.
        let blow = forcing.impulses.partition_point(|blow| blow.0 <= 0.0);
        let mut event = Self {
            body,
            forcing,
            soft: scene.walls.iter().any(|wall| !wall.law.is_rigid()),
            farthest,
            room: GapBounds::between(&barriers),
            barriers,
            clock: Clock::new(scene.duration, stride),
            length: if walls > 0 { scene.gap_scale() } else { 0.0 },
            arc,
            time: 0.0,
            late: 0.0,
            q,
            v,
            largest: [0.0; 2],
            support: None,
            blow,
            released: f64::NEG_INFINITY,
            accumulation: None,
            force_size: [0.0; 2],
            resolution: noise(farthest),
            sizes: [0.0; 4],
            steps: 0,
            shown: StepOutput::new(&[v], (walls, false), 2 * walls + 2),
            velocity_left: v,
        };
        event.reclassify();
        event.set_forces(0.0);
        Ok(event)
    }

    /// Moves on to the next event, multiple of the stride, or the end of the scene, whichever is
    /// first, under a constant extra force (N). A step of no length happens where the body starts
    /// on a wall and moves into it. Past the end of the scene the motion goes on.
    ///
    /// # Errors
    /// [`Error::TooManyEvents`]; [`Error::NotFinite`] if the numbers overflow.
    pub fn advance(&mut self, extra: f64) -> Result<()> {
        self.shown.begin(self.time, &[self.v]);
        self.shown.extra = [extra];
        self.velocity_left = self.v;
        self.steps += 1;
        for _ in 0..CHANGES_AT_ONCE {
            let limit = self.limit();
            let span = (limit - self.time) - self.late;
            self.begin_arc(span, extra);
            let hit = self.search(span)?;
            if !(hit.state[0].is_finite() && hit.state[1].is_finite()) {
                return Err(Error::NotFinite { time: limit, step: self.steps, what: "state" });
            }
            self.pass(hit.tau, span, limit);
            let end = self.time;
            [self.q, self.v] = hit.state;
            self.velocity_left = self.v;
            self.arc.cut(end, hit.tau);
            self.gather_impulses();
            let changed = self.resolve_instant(hit.wall, extra);
            let jumped = self.shown.jumped();
            if end > self.shown.start || jumped || !changed {
                break;
            }
        }
        self.clock.pass(self.time);
        self.shown.add_jumps();
        self.set_forces(extra);
        self.clock.check(self.time, &self.barriers)
    }

    /// Advances the time by `tau` (s), at most to `limit` (s), which is `span` (s) away. The
    /// rounding error of the sum is kept, so that many events together have the error of one.
    fn pass(&mut self, tau: f64, span: f64, limit: f64) {
        let step = tau + self.late;
        let end = self.time + step;
        if tau >= span || end >= limit {
            (self.time, self.late) = (limit, 0.0);
        } else {
            // Knuth's sum of two numbers, which also gives its rounding error.
            let back = end - self.time;
            self.late = (self.time - (end - back)) + (step - back);
            self.time = end;
        }
    }

    /// The time at which the next arc must end, s: a multiple of the stride, a row of a table, a
    /// blow, or the end if it is still ahead.
    fn limit(&self) -> f64 {
        let mut limit = self.clock.limit(self.time);
        if let Some(&(time, _)) = self.forcing.impulses.get(self.blow) {
            limit = limit.min(time);
        }
        for table in &self.forcing.tables {
            let rows = table.time();
            if let Some(&next) = rows.get(rows.partition_point(|&t| t <= self.time)) {
                limit = limit.min(next);
            }
        }
        limit
    }

    fn count_evaluation(&mut self, tau: f64) -> Result<()> {
        self.clock.count().evaluations += 1;
        self.clock.check(self.time + tau, &self.barriers)
    }
}

#[cfg(test)]
mod tests;
