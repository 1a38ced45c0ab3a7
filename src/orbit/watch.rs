//! The events of an exact run.

use super::periodic::Orbit;
use super::signature::{Event, Kind, Signature};
use crate::scene::{Scene, Wall};
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

/// Watches the steps of the exact scheme and records the events.
#[derive(Debug)]
pub(super) struct Watch<'a> {
    walls: &'a [Wall],
    /// The forcing period, s, and a typical displacement, m.
    period: f64,
    length: f64,
    /// Rigid walls on which the structure rests, and elastic walls that push.
    resting: Vec<usize>,
    touching: Vec<usize>,
    q: Vec<f64>,
    v: Vec<f64>,
    pub passages: Vec<Passage>,
    /// True once a step has shown which walls were in contact at the start.
    begun: bool,
}

impl<'a> Watch<'a> {
    /// A watch for runs of `scene`, whose loads repeat themselves after `period` (s).
    pub fn new(scene: &'a Scene, period: f64) -> Self {
        let zero = vec![0.0; scene.system.degrees_of_freedom()];
        Self {
            walls: &scene.walls,
            period,
            length: scene.orbit_length(),
            resting: Vec::new(),
            touching: Vec::new(),
            q: zero.clone(),
            v: zero,
            passages: Vec::new(),
            begun: false,
        }
    }

    fn note(&mut self, kind: Kind, wall: usize, time: f64, speed: f64) {
        self.passages.push(Passage { event: Event { kind, wall }, phase: time / self.period, speed });
    }

    /// Speed into wall number `wall`, m/s.
    fn toward(&self, wall: &Wall) -> f64 {
        -wall.side().sign() * wall.row().dot(&self.v)
    }

    pub fn observe(&mut self, step: &Step<'_>) {
        let (start, end) = match step.path {
            Path::Exact(arc) => (arc.start(), arc.end()),
            Path::Series(series) => (series.start(), series.end()),
            _ => return,
        };
        let (mut resting, mut touching) = (Vec::new(), Vec::new());
        match step.path {
            Path::Exact(arc) => {
                resting.extend(arc.rests_on());
                touching.extend(arc.touching());
            }
            Path::Series(series) => {
                series
                    .acting_walls()
                    .for_each(|(wall, holds)| if holds { &mut resting } else { &mut touching }.push(wall));
            }
            _ => {}
        }
        step.path.state(start, &mut self.q, &mut self.v);
        if self.begun {
            let before = std::mem::take(&mut self.resting);
            for &wall in before.iter().filter(|wall| !resting.contains(wall)) {
                self.note(Kind::Release, wall, start, 0.0);
            }
            for &wall in resting.iter().filter(|wall| !before.contains(wall)) {
                self.rest(wall, start);
            }
            self.pushes(&touching, start);
        }
        (self.resting, self.touching, self.begun) = (resting, touching, true);
        step.path.state(end, &mut self.q, &mut self.v);
        for (wall, place) in self.walls.iter().enumerate() {
            let struck = step.jump.get(wall).is_some_and(|jump| *jump != 0.0);
            // A wall on which the structure rests only transmits the impulses of impacts at other
            // walls.
            if struck && !self.resting.contains(&wall) {
                self.note(Kind::Impact, wall, step.end, self.toward(place));
            }
        }
    }

    /// Records the changes at the elastic walls, of which `touching` push from `start` (s) on.
    fn pushes(&mut self, touching: &[usize], start: f64) {
        for (wall, place) in self.walls.iter().enumerate() {
            let now = touching.contains(&wall);
            if place.law.is_rigid() || now == self.touching.contains(&wall) {
                continue;
            }
            let on_face = place.gap(place.row().dot(&self.q)).abs() <= 1e-9 * self.length;
            let toward = self.toward(place);
            let (kind, speed) = match (now, on_face) {
                (true, true) => (Kind::Enter, toward),
                (true, false) => (Kind::Again, -toward),
                (false, _) => (Kind::Leave, -toward),
            };
            self.note(kind, wall, start, speed);
        }
    }

    /// Records that the body has come to rest on `wall`: an impact just recorded there becomes a
    /// rest.
    fn rest(&mut self, wall: usize, time: f64) {
        let phase = time / self.period;
        let impact = Event { kind: Kind::Impact, wall };
        let last = self.passages.iter_mut().rev().take_while(|p| p.phase == phase).find(|p| p.event == impact);
        match last {
            Some(last) => last.event.kind = Kind::Rest,
            None => self.note(Kind::Rest, wall, time, 0.0),
        }
    }
}

/// The passages with each accumulation of impacts at a wall of `scene` as one event.
pub(super) fn gathered(passages: Vec<Passage>, scene: &Scene) -> Vec<Passage> {
    let mut kept: Vec<Passage> = Vec::new();
    for mut passage in passages {
        let wall = passage.event.wall;
        let bounces = scene.walls.get(wall).and_then(|wall| wall.law.restitution()).is_some_and(|e| e > 0.0);
        if passage.event.kind == Kind::Rest && bounces {
            while let Some(before) = kept.last()
                && before.event.kind == Kind::Impact
                && before.event.wall == wall
                && before.speed > passage.speed
            {
                passage = *before;
                kept.pop();
            }
            passage.event.kind = Kind::Chatter;
        }
        kept.push(passage);
    }
    kept
}

/// The orbit of these events in `periods` forcing periods of `forcing_period` seconds.
pub(super) fn orbit_of(passages: &[Passage], periods: u32, forcing_period: f64) -> Orbit {
    let events = passages.iter().map(|passage| passage.event).collect();
    Orbit {
        signature: Signature { events, periods, symmetric: false },
        phases: passages.iter().map(|passage| passage.phase).collect(),
        speeds: passages.iter().map(|passage| passage.speed).collect(),
        forcing_period,
    }
}
