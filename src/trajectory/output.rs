//! Displacement and velocity of the probes at the output times of a scene.

use crate::scene::{Row, Scene};
use crate::step::{QuietSteps, Step};
use serde::{Deserialize, Serialize};

/// Rounding error of a time asked for and of the end of a step there, in units in the last place.
const UNITS: f64 = 8.0;

/// The states of the probes at the output times of a scene
/// ([`Scene::with_output_times`]), right-continuous as the rows of a
/// [`Trajectory`](super::Trajectory) are; of a run that diverged those before its end.
///
/// An exact scheme is evaluated at the times themselves. Within a step on a grid in which no wall
/// pushes, and within a part of a step up to its impact, the displacement is the cubic through the
/// displacements and velocities at both ends, which is the path of the θ = ½ rule itself. In a step
/// on a grid with an impulse nothing is known of the path between its ends: the displacement there
/// is straight, and the velocity that of the end.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct OutputStates {
    /// The output times, s, increasing.
    pub time: Vec<f64>,
    /// Displacement at each of them, m: one column per probe, in the scene's order.
    pub displacement: Vec<Vec<f64>>,
    /// Velocity at each of them, m/s: one column per probe, in the scene's order.
    pub velocity: Vec<Vec<f64>>,
}

impl OutputStates {
    /// True if there is a column of all times for each of `probes`; without times there need be
    /// none.
    pub(super) fn fit(&self, probes: usize) -> bool {
        let fit = |columns: &[Vec<f64>]| {
            columns.len() == probes && columns.iter().all(|column| column.len() == self.time.len())
        };
        self.time.is_empty() || (fit(&self.displacement) && fit(&self.velocity))
    }
}

/// Builds [`OutputStates`] from the steps of a run.
#[derive(Debug, Clone)]
pub(super) struct OutputRecorder {
    states: OutputStates,
    /// The times that are still to come, s, the next one last.
    due: Vec<f64>,
    /// The end of the last step, s, and displacement and velocity of each probe there.
    last: (f64, Vec<[f64; 2]>),
    /// Displacement and velocity within a step of exact motion, n entries each.
    state: [Vec<f64>; 2],
}

impl OutputRecorder {
    /// A recorder of the output times of `scene`, from the state `q` (m), `v` (m/s) at t = 0; here
    /// and below `probes` are the rows of its probes.
    pub fn new(scene: &Scene, probes: &[Row], q: &[f64], v: &[f64]) -> Self {
        let mut recorder = Self {
            states: OutputStates::default(),
            due: scene.reached_output_times().iter().copied().rev().collect(),
            last: (0.0, Vec::new()),
            state: [Vec::new(), Vec::new()],
        };
        if !recorder.due.is_empty() {
            let n = scene.system.degrees_of_freedom();
            recorder.states.displacement = vec![Vec::new(); probes.len()];
            recorder.states.velocity = recorder.states.displacement.clone();
            recorder.state = [vec![0.0; n], vec![0.0; n]];
            recorder.last.1.extend(seen(probes, q, v));
        }
        recorder
    }

    /// Adds a step. Steps must come in order.
    pub fn observe(&mut self, step: &Step<'_>, probes: &[Row]) {
        if self.due.is_empty() {
            return;
        }
        // A time at the end of the step itself belongs to the next one, or is the run's last.
        while let Some(&time) = self.due.last().filter(|&&time| is_before(time, step.end)) {
            self.due.pop();
            let states = self.states_within(step, time, probes);
            self.push(time, &states);
        }
        let (end, states) = &mut self.last;
        *end = step.end;
        states.clear();
        states.extend(seen(probes, step.q, step.v));
    }

    /// Adds the steps from index `from` on of `quiet`, as [`OutputRecorder::observe`] adds each.
    pub fn observe_quiet(&mut self, quiet: &QuietSteps, from: usize, probes: &[Row]) {
        let Some(&time) = self.due.last() else { return };
        let ends = quiet.end().iter().take(quiet.len());
        let first = ends.skip(from).position(|&end| is_before(time, end)).map_or(quiet.len(), |after| from + after);
        // The step before it ends where the path to the next time begins.
        (first.saturating_sub(1).max(from)..quiet.len()).for_each(|k| self.observe(&quiet.step(k), probes));
    }

    /// The states, at the end of the run.
    pub fn finish(mut self) -> OutputStates {
        let (end, states) = std::mem::take(&mut self.last);
        while let Some(time) = self.due.pop().filter(|&time| !is_before(end, time)) {
            self.push(time, &states);
        }
        self.states
    }

    fn push(&mut self, time: f64, states: &[[f64; 2]]) {
        self.states.time.push(time);
        let columns = self.states.displacement.iter_mut().zip(&mut self.states.velocity);
        for ((displacement, velocity), &[w, v]) in columns.zip(states) {
            displacement.push(w);
            velocity.push(v);
        }
    }

    /// Displacement and velocity of each probe at `time` within `step`.
    fn states_within(&mut self, step: &Step<'_>, time: f64, probes: &[Row]) -> Vec<[f64; 2]> {
        let (start, last) = &self.last;
        if !is_before(*start, time) {
            return last.clone();
        }
        if let Some(between) = step.between(*start, time) {
            return last.iter().zip(probes).map(|(&from, probe)| between.along(from, |x| probe.dot(x))).collect();
        }
        let [mut q, mut v] = std::mem::take(&mut self.state);
        step.path.state(time, &mut q, &mut v);
        let states = seen(probes, &q, &v).collect();
        self.state = [q, v];
        states
    }
}

/// Displacement and velocity of each probe.
fn seen(probes: &[Row], q: &[f64], v: &[f64]) -> impl Iterator<Item = [f64; 2]> {
    probes.iter().map(move |probe| [probe.dot(q), probe.dot(v)])
}

/// True if `time` lies before `end` by more than rounding.
fn is_before(time: f64, end: f64) -> bool {
    time < end - UNITS * f64::EPSILON * end.abs()
}
