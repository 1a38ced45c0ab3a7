//! Periodic orbits of structures, by shooting: Newton's method on the free run over one orbit.
//!
//! P takes the state at an instant to that N forcing periods later, by the exact scheme; x = P(x) is
//! solved by x ← x + (1 − P′)⁻¹ (P(x) − x), with P′ the product of propagators and saltation
//! matrices ([`Product`]). P is smooth where no impact of the orbit grazes; contacts that last are
//! no obstacle.

use super::forcing::forcing_period;
use super::strobe::{Scales, multipliers, newton_step, state, vector};
use crate::error::{Error, Result};
use crate::scene::{Scene, State};
use crate::scheme::{Scheme, Stepper};
use crate::variation::Product;
use nalgebra::{DMatrix, DVector};

/// Most forcing periods of an orbit.
const LONGEST: usize = 32;

/// How near the states must come back, in gaps, and in gaps times the forcing's Ω …
const NEAR: f64 = 1e-3;

/// … and how often.
const REPEATS: usize = 3;

/// Most iterations.
const ITERATIONS: usize = 12;

/// How near the solution must come back.
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
    /// True if all multipliers lie inside the unit circle.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.multipliers.iter().all(|[re, im]| re.hypot(*im) < 1.0)
    }
}

/// The periodic orbit on which a run of `scene` settles, for any number of degrees of freedom up to
/// 200: `settle` forcing periods are run by the exact scheme, and the states once a period compared
/// until they come back after up to 32 of them. `progress` is told the share of the run that is
/// done.
///
/// # Errors
/// [`Error::Invalid`] for a scene that does not validate or has no forcing period;
/// [`Error::NoOrbit`] where the states do not come back, where Newton's method does not converge, or
/// where the derivative of the run does not exist; those of a run.
pub fn shoot(scene: &Scene, settle: u32, progress: &dyn Fn(f64)) -> Result<Shot> {
    scene.validate()?;
    let n = scene.system.degrees_of_freedom();
    if n > MOST_UNKNOWNS {
        let expected = format!("at most {MOST_UNKNOWNS}: the matrices of shooting are dense (reduce it to modes)");
        return Err(Error::invalid("system", format!("one of {n} degrees of freedom"), expected));
    }
    // Refused here rather than after the run.
    Product::new(scene)?;
    let period = forcing_period(scene)?;
    let shooting = Shooting { scene, period, scales: Scales::new(scene.gap_scale(), period) };
    let (time, state, periods) = shooting.settled(settle, progress)?;
    shooting.solve(time, state, periods)
}

struct Shooting<'a> {
    scene: &'a Scene,
    period: f64,
    scales: Scales,
}

/// A run over one orbit.
struct Turn {
    end: DVector<f64>,
    derivative: DMatrix<f64>,
    contacts: Vec<u64>,
    impulses: Vec<f64>,
}

impl Shooting<'_> {
    fn stepper(&self, end: f64, stride: f64) -> Result<Stepper> {
        let mut scene = self.scene.clone();
        scene.duration = end;
        Stepper::new(&scene, &Scheme::Event, stride)
    }

    /// An instant (s) between two events after `settle` periods, the state then, and after how many
    /// periods it comes back.
    fn settled(&self, settle: u32, progress: &dyn Fn(f64)) -> Result<(f64, State, u32)> {
        let first = f64::from(settle) * self.period;
        let most = (REPEATS + 1) * LONGEST + 1;
        let end = first + most as f64 * self.period;
        let mut stepper = self.stepper(end, self.period)?;
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
            "the motion does not come back within {LONGEST} forcing periods after {settle} of them: it is chaotic or has \
             not settled yet (settle longer, or start elsewhere)"
        )))
    }

    fn comes_back(&self, states: &[DVector<f64>]) -> Option<u32> {
        let count = states.len();
        let back =
            |n: usize| (count - REPEATS * n..count).all(|j| self.scales.size(&(&states[j] - &states[j - n])) < NEAR);
        (1..=LONGEST).find(|&n| count >= (REPEATS + 1) * n && back(n)).map(|n| n as u32)
    }

    fn turn(&self, time: f64, start: &State, periods: u32) -> Result<Turn> {
        let end = time + f64::from(periods) * self.period;
        let mut stepper = self.stepper(end, end)?;
        stepper.set_state(time, start)?;
        let mut product = Product::new(self.scene)?;
        let walls = self.scene.walls.len();
        let (mut contacts, mut impulses) = (vec![0; walls], vec![0.0; walls]);
        while stepper.time() < end {
            let step = stepper.step()?;
            product.see(&step).map_err(|error| Error::no_orbit(error.to_string()))?;
            for contact in step.closed {
                if let Some(count) = contacts.get_mut(contact.wall) {
                    *count += 1;
                }
            }
            impulses.iter_mut().zip(step.impulse).for_each(|(sum, impulse)| *sum += impulse);
        }
        let State { q, v } = stepper.state();
        let end = vector(&q, &v);
        Ok(Turn { end, derivative: product.matrix().clone(), contacts, impulses })
    }

    fn solve(&self, time: f64, start: State, periods: u32) -> Result<Shot> {
        // Phases are those of the first periods: nothing is lost to rounding of a late time.
        let time = time - (time / self.period).floor() * self.period;
        let mut x = vector(&start.q, &start.v);
        let mut best: Option<(f64, DVector<f64>, Turn)> = None;
        for _ in 0..ITERATIONS {
            let turn = self.turn(time, &state(&x), periods)?;
            let gap = &turn.end - &x;
            let miss = self.scales.size(&gap);
            let improved = best.as_ref().is_none_or(|(least, ..)| miss < 0.5 * least);
            let step = newton_step(&turn.derivative, &gap);
            if best.as_ref().is_none_or(|(least, ..)| miss < *least) {
                best = Some((miss, x.clone(), turn));
            }
            // Where rounding ends the fall, no further step helps.
            if !improved && best.as_ref().is_some_and(|(least, ..)| *least <= CLOSES) {
                break;
            }
            let step = step.ok_or_else(|| Error::no_orbit("the equations are singular there: a multiplier is 1"))?;
            x += step;
        }
        let Some((closure, x, turn)) = best.filter(|(miss, ..)| *miss <= CLOSES) else {
            return Err(Error::no_orbit(format!(
                "shooting did not converge in {ITERATIONS} iterations: an impact of the orbit nearly grazes, or it has not \
                 settled yet"
            )));
        };
        Ok(Shot {
            periods,
            forcing_period: self.period,
            time,
            state: state(&x),
            multipliers: multipliers(&turn.derivative).iter().map(|z| [z.re, z.im]).collect(),
            closure,
            contacts: turn.contacts,
            impulses: turn.impulses,
        })
    }
}
