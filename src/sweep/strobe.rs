//! The state once per forcing period.

use crate::scene::State;
use crate::step::Step;

/// Maximum number of forcing periods after which a motion may repeat itself.
const MOST_PERIODS: usize = 32;

/// Tolerance of a repetition: in gaps, where there is none in sizes of the motion, and for
/// velocities in these times the angular frequency of the forcing.
const NEAR: f64 = 1e-3;

/// Number of repetitions required.
const REPEATS: usize = 3;

/// Fewest forcing periods after which a motion of one period is known to repeat itself.
pub(super) const LEAST_KEPT: usize = REPEATS + 1;

/// Largest relative change of the squared distances between the states of one repetition, over two
/// repetitions. A transient that turns about an orbit of fewer periods, by multipliers of modulus
/// μ, changes them by 1 − μ⁴ᴺ.
const LASTING: f64 = 0.05;

/// Records the state at the end of every period of the window.
#[derive(Debug, Clone)]
pub(super) struct Strobe {
    /// Number of the next instant, from the start of the row, and of the last one.
    next: u32,
    last: u32,
    period: f64,
    /// Time, s, and state at the end of the last step.
    before: (f64, State),
    /// Time (s) and state of each instant.
    pub taken: Vec<(f64, State)>,
}

impl Strobe {
    /// Records the ends of `keep` periods (s) after `settle` of them, of a row that begins at
    /// `start`.
    pub fn new(period: f64, settle: u32, keep: u32, start: &State) -> Self {
        Self { next: settle + 1, last: settle + keep, period, before: (0.0, start.clone()), taken: Vec::new() }
    }

    /// The forcing period, s.
    pub fn period(&self) -> f64 {
        self.period
    }

    fn due(&self) -> f64 {
        f64::from(self.next) * self.period
    }

    fn take(&mut self, time: f64, state: State) {
        self.taken.push((time, state));
        self.next += 1;
    }

    pub fn observe(&mut self, step: &Step<'_>) {
        while self.next <= self.last && self.due() <= step.end {
            let due = self.due();
            // Right-continuous: at the end of a step the state is that after an impact there.
            if due == step.end {
                self.take(due, State { q: step.q.to_vec(), v: step.v.to_vec() });
                break;
            }
            let mut state = self.before.1.clone();
            match step.between(self.before.0, due) {
                Some(between) => {
                    for (i, (q, v)) in state.q.iter_mut().zip(&mut state.v).enumerate() {
                        [*q, *v] = between.along([*q, *v], |x| x.get(i).copied().unwrap_or(0.0));
                    }
                }
                None => step.path.state(due, &mut state.q, &mut state.v),
            }
            self.take(due, state);
        }
        let (end, state) = &mut self.before;
        *end = step.end;
        state.q.copy_from_slice(step.q);
        state.v.copy_from_slice(step.v);
    }

    /// Number of periods after which the motion repeats itself; see [`repeats`].
    pub fn repeats(&self, gap: Option<f64>) -> Option<usize> {
        repeats(&self.taken.iter().map(|(_, state)| state).collect::<Vec<_>>(), self.period, gap)
    }
}

/// The smallest number of periods N up to 32 for which each of the last 3 N of `states`, one per
/// `period` (s), equals the one N before it, to 1e-3 of the `gap` (m), or else of the largest of
/// the states, and of that length times the angular frequency; `None` if there is no such N, or if
/// what tells these N periods from fewer decays or grows: a transient that has not settled. An N
/// for which too few states were kept is not tried.
pub(super) fn repeats(states: &[&State], period: f64, gap: Option<f64>) -> Option<usize> {
    let omega = std::f64::consts::TAU / period;
    let largest = |of: fn(&State) -> &Vec<f64>| states.iter().flat_map(|s| of(s)).fold(0.0, |x: f64, q| x.max(q.abs()));
    let length = gap.unwrap_or_else(|| largest(|s| &s.q).max(largest(|s| &s.v) / omega));
    let near = |a: &State, b: &State| {
        let apart = |x: &[f64], y: &[f64], scale: f64| x.iter().zip(y).all(|(x, y)| (x - y).abs() <= NEAR * scale);
        apart(&a.q, &b.q, length) && apart(&a.v, &b.v, length * omega)
    };
    let count = states.len();
    let periods = (1..=MOST_PERIODS).find(|&n| {
        count >= LEAST_KEPT * n
            && (count - REPEATS * n..count).all(|j| match (states.get(j), states.get(j - n)) {
                (Some(a), Some(b)) => near(a, b),
                _ => false,
            })
    })?;
    // The squared distances of the N states up to the one numbered `end` from those `fewer` periods
    // before each.
    let squared = |fewer: usize, end: usize| -> f64 {
        let part = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - y).powi(2)).sum::<f64>();
        let apart = |(a, b): (&&State, &&State)| part(&a.q, &b.q) + part(&a.v, &b.v) / omega.powi(2);
        let pairs = states.iter().zip(states.iter().skip(fewer)).skip(end - fewer - periods);
        pairs.take(periods).map(apart).sum()
    };
    let lasts = |fewer: usize| {
        let [first, last] = [count - 2 * periods, count].map(|end| squared(fewer, end));
        (last - first).abs() <= LASTING * first
    };
    (1..periods).filter(|fewer| periods.is_multiple_of(*fewer)).all(lasts).then_some(periods)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Load, Scene, Wall};
    use crate::scheme::{Scheme, Stepper};
    use std::f64::consts::TAU;

    /// The strobes of a run in steps of 1 ms, of which no whole number makes a period of 1.75 Hz,
    /// but of seven.
    fn taken(scene: &Scene, scheme: Scheme) -> Strobe {
        let mut strobe = Strobe::new(1.0 / 1.75, 60, 20, &scene.initial);
        let mut stepper = Stepper::new(scene, &scheme, 1e-3).unwrap();
        while strobe.taken.len() < 20 {
            strobe.observe(&stepper.step().unwrap());
        }
        strobe
    }

    #[test]
    fn steps_that_divide_no_period_see_the_motion_at_its_ends() {
        let omega = TAU * 1.75;
        let free = Scene::oscillator(1.0, 2.0, 100.0).with_load(Load::harmonic(3.0, 1.75, 0.0)).with_duration(60.0);
        let (a, b) = (100.0 - omega * omega, 2.0 * omega);
        let scale = 3.0 / (a * a + b * b);
        for scheme in [Scheme::Located, Scheme::MoreauJean { theta: 0.5 }, Scheme::Newmark, Scheme::Event] {
            for (_, state) in taken(&free, scheme).taken {
                // Steady motion: q = 3 (a sin ωt − b cos ωt)/(a² + b²); schemes of order 2 err by
                // (ωh)² of it.
                let error = [state.q[0] + scale * b, (state.v[0] - scale * a * omega) / omega];
                let size = scale * a.hypot(b) * (omega * 1e-3).powi(2);
                assert!(error.iter().all(|error| error.abs() < size), "{scheme}: {error:?} {size:e}");
            }
        }
        // One impact a period: the motion repeats itself after one.
        let struck = free.with_wall(Wall::upper("stop", 0.02).with_restitution(0.5));
        let settled = |scheme: Scheme| taken(&struck, scheme).repeats(Some(0.02));
        for scheme in [Scheme::Located, Scheme::Event] {
            assert_eq!(settled(scheme), Some(1), "{scheme}");
        }
    }

    fn strobe(states: &[f64]) -> Strobe {
        let state = |x: f64| State { q: vec![x], v: vec![-x] };
        let mut strobe = Strobe::new(1.0, 1, states.len() as u32, &state(0.0));
        for &x in states {
            strobe.take(strobe.due(), state(x));
        }
        strobe
    }

    #[test]
    fn the_least_period_is_found_and_none_where_there_is_none() {
        assert_eq!(strobe(&[1.0; 10]).repeats(Some(1.0)), Some(1));
        let two = [1.0, 2.0].repeat(6);
        assert_eq!(strobe(&two).repeats(Some(1.0)), Some(2));
        let three: Vec<f64> = [1.0, 2.0, 1.0].repeat(5);
        assert_eq!(strobe(&three).repeats(Some(1.0)), Some(3));
        let rising: Vec<f64> = (0..40).map(f64::from).collect();
        assert_eq!(strobe(&rising).repeats(Some(1.0)), None);
        // A transient that changes sign from period to period, and turns in five: the orbit, of one
        // period, is not reached yet.
        let turning = |share: f64| {
            let at = |k: i32| 0.5 + 0.005 * 0.97_f64.powi(k) * (TAU * share * f64::from(k)).cos();
            (0..40).map(at).collect::<Vec<f64>>()
        };
        assert_eq!(strobe(&turning(0.5)).repeats(Some(1.0)), None);
        assert_eq!(strobe(&turning(0.2)).repeats(Some(1.0)), None);
        // One about two periods.
        let about_two: Vec<f64> =
            two.iter().cycle().zip(turning(0.25)).take(40).map(|(x, transient)| x + transient).collect();
        assert_eq!(strobe(&about_two).repeats(Some(1.0)), None);
        // Too few instants to decide.
        assert_eq!(strobe(&[1.0, 1.0]).repeats(Some(1.0)), None);
        // Without a gap a motion is measured by its own size.
        let small: Vec<f64> = two.iter().enumerate().map(|(i, x)| 1e-6 * (x + 0.01 * f64::from(i as u32))).collect();
        assert_eq!(strobe(&small).repeats(None), None);
        assert_eq!(strobe(&two.iter().map(|x| 1e-6 * x).collect::<Vec<_>>()).repeats(None), Some(2));
        assert_eq!(strobe(&[0.0; 10]).repeats(None), Some(1));
    }
}
