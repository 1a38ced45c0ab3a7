//! Periodic orbits of structures, by shooting: Newton's method on the free run over one orbit.
//!
//! P takes the state at an instant to that N forcing periods later, by the exact scheme; x = P(x)
//! is solved by x ← x + (1 − P′)⁻¹ (P(x) − x), with P′ the product of propagators and saltation
//! matrices ([`Product`]). P is smooth where no impact of the orbit grazes; lasting contacts are
//! allowed.

use super::orbit_run::{OrbitRun, Recorded, run};
use super::periodic::{Orbit, REPEATED};
use super::signature::MOST_PERIODS;
use super::strobe::{Scales, is_stable, multipliers, newton_step, state, vector};
use crate::error::{Error, Result};
use crate::scene::{Scene, State, forcing_period};
use crate::scheme::{Scheme, Stepper, check_exact};
use crate::variation::Product;
use nalgebra::DVector;

/// Most forcing periods of an orbit.
const LONGEST: usize = 32;

/// Tolerance for states to count as repeated, in gaps, and in gaps times the forcing's Ω …
const NEAR: f64 = 1e-3;

/// … and how often they must be repeated.
const REPEATS: usize = 3;

/// Most iterations.
const ITERATIONS: usize = 12;

/// Tolerance for the solution to come back to its start, in the same units.
const CLOSES: f64 = 1e-10;

/// Most degrees of freedom: the matrices are dense.
const MOST_UNKNOWNS: usize = 200;

/// A periodic orbit of a structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// Forcing periods of one orbit.
    pub periods: u32,
    /// The forcing period, s.
    pub forcing_period: f64,
    /// The events of one orbit after `time`.
    pub orbit: Orbit,
    /// An instant of the orbit, s, at which nothing happens …
    pub time: f64,
    /// … and the state then.
    pub state: State,
    /// Floquet multipliers over one orbit, real and imaginary parts, the largest first; 2n of them.
    pub multipliers: Vec<[f64; 2]>,
    /// How far the free run over one orbit misses its start: in gaps, and gaps times the forcing's
    /// Ω.
    pub closure: f64,
    /// Contact episodes that end at each wall in one orbit, in the scene's order.
    pub contacts: Vec<u64>,
    /// Impulse of each wall on the structure over one orbit, N s, signed as the force.
    pub impulses: Vec<f64>,
}

impl Shot {
    /// The orbit of `scene`, a scene close to the one of this orbit, from which Newton's method
    /// starts.
    ///
    /// # Errors
    /// As [`shoot`]; [`Error::Invalid`] for a state of another number of degrees of freedom, or for
    /// values that are not finite.
    pub fn corrected(&self, scene: &Scene) -> Result<Self> {
        let shooting = Shooting::new(scene)?;
        self.check(scene.system.degrees_of_freedom())?;
        // The phase of the load stays as it is.
        shooting.solve(self.time / self.forcing_period * shooting.period, self.state.clone(), self.periods)
    }

    /// Refuses data that cannot be an orbit of `n` degrees of freedom.
    pub(super) fn check(&self, n: usize) -> Result<()> {
        let State { q, v } = &self.state;
        if q.len() != n || v.len() != n {
            let found = format!("a state of {} displacements and {} velocities", q.len(), v.len());
            return Err(Error::invalid("start", found, format!("{n} of each, one for each degree of freedom")));
        }
        if !(1..=MOST_PERIODS).contains(&self.periods) {
            let found = format!("an orbit of {} forcing periods", self.periods);
            return Err(Error::invalid("start", found, format!("1 to {MOST_PERIODS} of them")));
        }
        let numbers = q.iter().chain(v).chain([&self.time, &self.forcing_period]);
        match numbers.copied().find(|x| !x.is_finite()) {
            Some(x) => Err(Error::invalid("start", x, "finite numbers")),
            None if self.forcing_period > 0.0 && self.time >= 0.0 => Ok(()),
            None => {
                let found = format!("time {:?} s, forcing period {:?} s", self.time, self.forcing_period);
                Err(Error::invalid("start", found, "a time of 0 or more and a period above 0"))
            }
        }
    }

    /// True if all multipliers lie inside the unit circle.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        is_stable(&self.multipliers)
    }
}

/// The periodic orbit on which a run of `scene` settles, for any number of degrees of freedom up to
/// 200: `settle` forcing periods are run by the exact scheme, and the states once a period compared
/// until they repeat themselves after up to 32 of them. [`SETTLE`](super::SETTLE) is a usual value
/// of `settle`. `progress` is called with the share of the run that is done.
///
/// # Errors
/// [`Error::Invalid`] for a scene that does not validate or has no forcing period;
/// [`Error::NoOrbit`] where the states do not come back, where Newton's method does not converge,
/// or where the derivative of the run does not exist; those of a run.
pub fn shoot(scene: &Scene, settle: u32, progress: &dyn Fn(f64)) -> Result<Shot> {
    let shooting = Shooting::new(scene)?;
    let (time, state, periods) = shooting.settled(settle, progress)?;
    shooting.solve(time, state, periods)
}

/// The forcing period of `scene`, s, if its orbits can be found by shooting.
///
/// # Errors
/// [`Error::Invalid`] for a scene of which they cannot.
pub(super) fn posed(scene: &Scene) -> Result<f64> {
    scene.validate()?;
    check_exact(scene, "an orbit")?;
    check_dense(scene, "shooting")?;
    // Such a scene is refused before any run.
    Product::new(scene)?;
    forcing_period(scene)
}

/// Refuses a scene of more degrees of freedom than the dense matrices of `what` are made for.
pub(super) fn check_dense(scene: &Scene, what: &str) -> Result<()> {
    let n = scene.system.degrees_of_freedom();
    if n > MOST_UNKNOWNS {
        let expected = format!("at most {MOST_UNKNOWNS}: the matrices of {what} are dense (reduce it to modes)");
        return Err(Error::invalid("system", format!("one of {n} degrees of freedom"), expected));
    }
    Ok(())
}

struct Shooting<'a> {
    scene: &'a Scene,
    period: f64,
    scales: Scales,
}

impl<'a> Shooting<'a> {
    fn new(scene: &'a Scene) -> Result<Self> {
        let period = posed(scene)?;
        Ok(Self { scene, period, scales: Scales::new(scene.orbit_length(), period) })
    }

    /// An instant (s) between two events after `settle` periods, the state then, and the number of
    /// periods after which it is repeated.
    fn settled(&self, settle: u32, progress: &dyn Fn(f64)) -> Result<(f64, State, u32)> {
        let first = f64::from(settle) * self.period;
        let most = (REPEATS + 1) * LONGEST + 1;
        let end = first + most as f64 * self.period;
        let mut stepper = Stepper::new(&self.scene.clone().with_duration(end), &Scheme::Event, self.period)?;
        while stepper.time() < first {
            stepper.step()?;
            progress(stepper.time() / end);
        }
        // The middle of the longest stretch without events in one period.
        let (mut longest, mut strobe) = (0.0, first);
        while stepper.time() < first + self.period {
            let step = stepper.step()?;
            if step.end - step.start > longest {
                (longest, strobe) = (step.end - step.start, 0.5 * (step.start + step.end));
            }
        }
        let mut states: Vec<DVector<f64>> = Vec::new();
        let mut starts: Vec<State> = Vec::new();
        strobe += self.period;
        let begin = strobe;
        while states.len() < most - 1 {
            let due = begin + states.len() as f64 * self.period;
            let step = stepper.step()?;
            if step.end >= due {
                let mut state = State { q: step.q.to_vec(), v: step.v.to_vec() };
                step.path.state(due, &mut state.q, &mut state.v);
                states.push(vector(&state.q, &state.v));
                starts.push(state);
                progress(step.end / end);
                if let Some(periods) = self.comes_back(&states) {
                    let last = starts.len() - 1;
                    return Ok((begin + last as f64 * self.period, starts.swap_remove(last), periods));
                }
            }
        }
        Err(Error::no_orbit(format!(
            "the motion does not come back within {LONGEST} forcing periods after {settle} of \
             them: it is chaotic or has not settled yet (settle longer, or start elsewhere)"
        )))
    }

    fn comes_back(&self, states: &[DVector<f64>]) -> Option<u32> {
        let count = states.len();
        // Without a gap the motion is measured by its own size.
        let largest = || states.iter().fold(0.0, |most: f64, x| most.max(self.scales.size(x)));
        let near = NEAR * self.scene.orbit_gap().map_or_else(largest, |_| 1.0);
        let apart = |j: usize, n: usize| self.scales.size(&(&states[j] - &states[j - n]));
        let back = |n: usize| (count - REPEATS * n..count).all(|j| apart(j, n) <= near);
        (1..=LONGEST).find(|&n| count >= (REPEATS + 1) * n && back(n)).map(|n| n as u32)
    }

    /// The orbit of `periods` forcing periods near `start`; where it repeats a shorter one, that
    /// one.
    fn solve(&self, time: f64, start: State, periods: u32) -> Result<Shot> {
        let found = self.solved(time, start, periods)?;
        let x = vector(&found.state.q, &found.state.v);
        for shorter in (1..periods).filter(|&shorter| periods.is_multiple_of(shorter)) {
            let span = [found.time, found.time + f64::from(shorter) * self.period];
            let motion = run(self.scene, self.period, span, &x, Recorded::Events)?;
            if self.scales.size(&(&motion.end - &x)) <= REPEATED {
                return self.solved(found.time, found.state, shorter);
            }
        }
        Ok(found)
    }

    fn solved(&self, time: f64, start: State, periods: u32) -> Result<Shot> {
        // The time is moved into the first period, so that no digits are lost to a late time.
        let time = time - (time / self.period).floor() * self.period;
        let end = time + f64::from(periods) * self.period;
        let mut x = vector(&start.q, &start.v);
        let mut best: Option<(f64, DVector<f64>, OrbitRun)> = None;
        for _ in 0..ITERATIONS {
            let motion = run(self.scene, self.period, [time, end], &x, Recorded::All)?;
            let gap = &motion.end - &x;
            let miss = self.scales.size(&gap);
            let improved = best.as_ref().is_none_or(|(least, ..)| miss < 0.5 * least);
            let step = newton_step(&motion.derivative, &gap);
            if best.as_ref().is_none_or(|(least, ..)| miss < *least) {
                best = Some((miss, x.clone(), motion));
            }
            // Once rounding limits the residual, further steps do not help.
            if !improved && best.as_ref().is_some_and(|(least, ..)| *least <= CLOSES) {
                break;
            }
            let step = step.ok_or_else(|| Error::no_orbit("the equations are singular there: a multiplier is 1"))?;
            x += step;
        }
        let Some((closure, x, motion)) = best.filter(|(miss, ..)| *miss <= CLOSES) else {
            return Err(Error::no_orbit(format!(
                "shooting did not converge in {ITERATIONS} iterations: an impact of the orbit \
                 nearly grazes, or it has not settled yet"
            )));
        };
        Ok(Shot {
            periods,
            forcing_period: self.period,
            orbit: motion.orbit(periods, self.period),
            time,
            state: state(&x),
            multipliers: multipliers(&motion.derivative).iter().map(|z| [z.re, z.im]).collect(),
            closure,
            contacts: motion.contacts,
            impulses: motion.impulses,
        })
    }
}
