//! The run whose attractor is looked for.

use super::motion::Attractor;
use super::orbit::{Orbit, find, leap, near};
use crate::error::Result;
use crate::orbit::strobe::{Scales, vector};
use crate::scene::{Checked, Scene, Side, State};
use crate::scheme::{Method, Scheme, Stepper};
use crate::step::{Path, Step};
use crate::variation::{Exponents, NoDerivative};
use nalgebra::DVector;
use std::collections::VecDeque;

/// Most periods of the load after which a motion may repeat itself.
const MOST_PERIODS: usize = 32;

/// Tolerance for states to count as repeated.
const NEAR: f64 = 1e-3;

/// How often they must have been repeated at the end of the run.
const REPEATS: usize = 3;

/// How often the run must approach the orbit as its derivative predicts, the tolerance for this as
/// a share of the distance before, and the distance below which the run has arrived.
const APPROACHES: u32 = 2;
const AS_SAID: f64 = 0.2;
const THERE: f64 = 1e-9;

/// A motion is chaotic if its exponent is this many standard errors above 0.
const ERRORS: f64 = 3.0;

/// An orbit that the run may be approaching.
struct Candidate {
    orbit: Orbit,
    /// Number of the strobe at which it was found, or last approached, and the distance there.
    at: u32,
    distance: DVector<f64>,
    approaches: u32,
}

struct Search<'a> {
    scene: &'a Checked,
    period: f64,
    scales: Scales,
    /// The last states once a period, the latest at the end.
    strobes: VecDeque<DVector<f64>>,
    /// True if the present flight stays between the walls for ever.
    quiet: bool,
    /// True once its steady motion has been looked for: without damping it attracts nothing.
    steady: bool,
    candidate: Option<Candidate>,
    /// Number of the strobe from which on an orbit is looked for again, and the number of failed
    /// searches.
    next: u32,
    vain: u32,
}

impl Attractor {
    /// The attractor that `scene` comes to from its start, under loads that repeat themselves every
    /// `period` (s): after at most `settle` + `keep` periods, of which the exponent is that of the
    /// last `keep`. `None` where that does not decide it.
    ///
    /// ```
    /// use signorini::study::attractor::Attractor;
    /// use signorini::{Load, Scene, Wall};
    ///
    /// let scene = Scene::oscillator(1.0, 0.2, 100.0)
    ///     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
    ///     .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
    ///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
    /// let Some(Attractor::Periodic { touches, .. }) = Attractor::of(&scene, 0.2, 400, 60)? else { panic!() };
    /// assert_eq!(touches.len(), 2); // an impact on each wall
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the scheme `event`.
    pub fn of(scene: &Scene, period: f64, settle: u32, keep: u32) -> Result<Option<Self>> {
        let mut scene = scene.clone();
        scene.duration = f64::from(settle.saturating_add(keep)) * period;
        follow(&Checked::new(&scene)?, period, [settle, keep], |_| ())
    }
}

/// The largest Lyapunov exponent (1/s) of the stable periodic motion over `count` periods (s) of
/// the load that passes near `state` at a whole one of them: ln|μ| over its time. `None` without
/// one.
#[cfg(feature = "cli")]
pub(crate) fn exponent(scene: &Checked, period: f64, count: usize, state: &State) -> Option<f64> {
    let orbit = near(scene, period, count, &vector(&state.q, &state.v))?;
    let largest = orbit.multipliers().first()?.norm();
    Some(largest.ln() / (orbit.strobes.len() as f64 * period))
}

/// The attractor that the run of `scene` comes to within `settle` + `keep` periods (s); `observe`
/// is called with every step.
pub(crate) fn follow(
    scene: &Checked,
    period: f64,
    [settle, keep]: [u32; 2],
    mut observe: impl FnMut(&Step<'_>),
) -> Result<Option<Attractor>> {
    let mut stepper = Stepper::by(scene, Method::new(Scheme::Event), period)?;
    let start = stepper.state();
    let mut search = Search {
        scene,
        period,
        scales: Scales::new(scene.orbit_length(), period),
        strobes: VecDeque::from([vector(&start.q, &start.v)]),
        quiet: false,
        steady: false,
        candidate: None,
        next: 1,
        vain: 0,
    };
    let last = settle.saturating_add(keep);
    let window = [settle, last].map(|count| f64::from(count) * period);
    let mut growth = std::result::Result::<_, NoDerivative>::Ok(Exponents::new(scene, 1, window)?);
    for count in 1..=last {
        loop {
            let step = stepper.step()?;
            observe(&step);
            search.quiet = search.is_quiet(&step);
            if step.start >= window[0]
                && let Ok(exponents) = &mut growth
                && let Err(none) = exponents.observe(&step)
            {
                growth = Err(none);
            }
            if step.end >= f64::from(count) * period * (1.0 - 1e-12) {
                break;
            }
        }
        if let Some(attractor) = search.strobe(count, &stepper.state()) {
            return Ok(Some(attractor));
        }
    }
    if let Some(orbit) = search.repeated() {
        return Ok(Some(orbit.attractor(scene)));
    }
    let largest = growth.ok().map(|exponents| exponents.largest());
    let chaotic = largest.is_some_and(|e| e.error_per_s.is_some_and(|error| e.per_s > ERRORS * error));
    Ok(chaotic.then_some(Attractor::Chaotic))
}

impl Search<'_> {
    /// True if the motion that `step` has ended with meets no wall any more.
    fn is_quiet(&self, step: &Step<'_>) -> bool {
        let Path::Exact(arc) = step.path else { return false };
        if step.jump.iter().any(|&p| p != 0.0) {
            return false;
        }
        let Some([low, high]) = arc.reach_for_ever() else { return false };
        self.scene.walls.iter().all(|wall| match wall.side() {
            Side::Upper => high < wall.position(),
            Side::Lower => low > wall.position(),
        })
    }

    /// The attractor, if the state at the end of period number `count` decides it.
    fn strobe(&mut self, count: u32, state: &State) -> Option<Attractor> {
        let x = vector(&state.q, &state.v);
        self.strobes.push_back(x.clone());
        if self.strobes.len() > (REPEATS + 1) * MOST_PERIODS + 1 {
            self.strobes.pop_front();
        }
        if self.quiet && !self.steady {
            // The motion is linear from here on: one Newton step finds the steady motion, however
            // far away.
            self.steady = true;
            let landed = leap(self.scene, self.period, &x);
            let orbit = landed.and_then(|to| find(self.scene, self.period, 1, &to, self.scales));
            if let Some(orbit) = orbit.filter(|orbit| orbit.is_quiet() && orbit.is_stable()) {
                return Some(orbit.attractor(self.scene));
            }
        }
        match self.candidate.take() {
            Some(candidate) => self.approached(candidate, count, &x),
            None => {
                if count >= self.next {
                    self.find_candidate(count, &x);
                }
                None
            }
        }
    }

    /// Looks for an orbit that the run may be approaching.
    fn find_candidate(&mut self, count: u32, x: &DVector<f64>) {
        let last = self.strobes.len() - 1;
        let returned = |n: &usize| {
            let before = last.checked_sub(*n).and_then(|at| self.strobes.get(at));
            before.is_some_and(|before| self.scales.size(&(x - before)) < NEAR)
        };
        let Some(n) = (1..=MOST_PERIODS).find(returned) else { return };
        let found = near(self.scene, self.period, n, x);
        let distance = found.as_ref().and_then(|orbit| Some(x - orbit.strobes.first()?));
        match (found, distance) {
            (Some(orbit), Some(distance)) => {
                self.candidate = Some(Candidate { orbit, at: count, distance, approaches: 0 });
            }
            _ => self.wait(count, n),
        }
    }

    /// Waits longer after every failed search: near unstable orbits there are many of them.
    fn wait(&mut self, count: u32, n: usize) {
        self.vain += 1;
        self.next = count + ((n as u32) << self.vain.min(6));
    }

    /// Whether the run comes to `candidate`.
    fn approached(&mut self, mut candidate: Candidate, count: u32, x: &DVector<f64>) -> Option<Attractor> {
        let n = candidate.orbit.strobes.len();
        if count < candidate.at + n as u32 {
            self.candidate = Some(candidate);
            return None;
        }
        let distance = x - candidate.orbit.strobes.first()?;
        let said = &candidate.orbit.matrix * &candidate.distance;
        let before = self.scales.size(&candidate.distance);
        let is_as_said = self.scales.size(&(&distance - said)) <= AS_SAID * before + THERE;
        if !is_as_said {
            self.wait(count, n);
            return None;
        }
        candidate.approaches += 1;
        if candidate.approaches >= APPROACHES {
            return Some(candidate.orbit.attractor(self.scene));
        }
        (candidate.at, candidate.distance) = (count, distance);
        self.candidate = Some(candidate);
        None
    }

    /// The orbit on which the motion has repeated itself up to the end of the run.
    fn repeated(&self) -> Option<Orbit> {
        let count = self.strobes.len();
        let equal = |j: usize, n: usize| match (self.strobes.get(j), self.strobes.get(j - n)) {
            (Some(a), Some(b)) => self.scales.size(&(a - b)) < NEAR,
            _ => false,
        };
        let repeats = |n: &usize| count > (REPEATS + 1) * n && (count - REPEATS * n..count).all(|j| equal(j, *n));
        let n = (1..=MOST_PERIODS).find(repeats)?;
        near(self.scene, self.period, n, self.strobes.back()?)
    }
}
