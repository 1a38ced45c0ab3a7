//! The events of an exact run.

use super::problem::{Problem, StopLaw};
use super::signature::{Event, Kind};
use crate::step::{Path, Step};

/// An event of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    pub event: Event,
    /// Cycles of the forcing period since t = 0.
    pub phase: f64,
    /// See [`Kind`], m/s.
    pub speed: f64,
}

/// Watches the steps of the exact scheme and writes down what happens.
#[derive(Debug)]
pub(super) struct Watch<'a> {
    problem: &'a Problem,
    touching: Vec<usize>,
    resting: Option<usize>,
    pub passages: Vec<Passage>,
    /// True once a step has been seen that tells the state the run started in.
    begun: bool,
}

impl<'a> Watch<'a> {
    pub fn new(problem: &'a Problem) -> Self {
        Self { problem, touching: Vec::new(), resting: None, passages: Vec::new(), begun: false }
    }

    fn note(&mut self, kind: Kind, wall: usize, time: f64, speed: f64) {
        let phase = time / self.problem.forcing_period();
        self.passages.push(Passage { event: Event { kind, wall }, phase, speed });
    }

    pub fn see(&mut self, step: &Step<'_>) {
        let Path::Exact(arc) = step.path else { return };
        let start = arc.start();
        let (q, v) = arc.state(start);
        let resting = arc.rests_on();
        if self.begun && resting != self.resting {
            if let Some(wall) = self.resting {
                self.note(Kind::Release, wall, start, 0.0);
            }
            if let Some(wall) = resting {
                self.rest(wall, start);
            }
        }
        self.resting = resting;
        for (wall, stop) in self.problem.stops().iter().enumerate() {
            let (now, before) = (arc.touching().any(|w| w == wall), self.touching.contains(&wall));
            if now == before || !self.begun {
                continue;
            }
            let StopLaw::Elastic { .. } = stop.law else { continue };
            let [length, _] = self.problem.scales();
            let toward = stop.toward * v;
            let on_face = stop.gap(q).abs() <= 1e-9 * length;
            let (kind, speed) = match (now, on_face) {
                (true, true) => (Kind::Enter, toward),
                (true, false) => (Kind::Again, -toward),
                (false, _) => (Kind::Leave, -toward),
            };
            self.note(kind, wall, start, speed);
        }
        self.touching.clear();
        self.touching.extend(arc.touching());
        self.begun = true;
        let left = arc.state(arc.end()).1;
        for (wall, _) in step.jump.iter().enumerate().filter(|(_, jump)| **jump != 0.0) {
            let toward = self.problem.stop(wall).map_or(0.0, |stop| stop.toward * left);
            self.note(Kind::Impact, wall, step.end, toward);
        }
    }

    /// The body has come to rest on `wall`: with the impact that has just been noted, if one was.
    fn rest(&mut self, wall: usize, time: f64) {
        let phase = time / self.problem.forcing_period();
        match self.passages.last_mut() {
            Some(last) if last.event == (Event { kind: Kind::Impact, wall }) && last.phase == phase => {
                last.event.kind = Kind::Rest;
            }
            _ => self.note(Kind::Rest, wall, time, 0.0),
        }
    }
}
