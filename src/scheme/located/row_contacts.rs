//! Walls on single rows: which of them the body touches, the programme of a part that they bound,
//! and the impact law at an instant.

use super::super::Counters;
use super::super::body::Body;
use super::super::flat_row::FlatRow;
use super::super::frame::Frame;
use super::super::programme::Programme;
use super::super::space::{Space, zero};
use super::contacts::{Ahead, Contacts, Event, Place, Solved};
use super::crossing::GapPath;
use super::part::{Part, THETA, VelocityBound};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Scene, Wall, WallLaw};
use crate::step::LastImpacts;

/// The rigid walls that the body touches, and the law of their impacts.
#[derive(Debug)]
pub(super) struct RowContacts<S: Space> {
    /// The programme of an impact, in the metric of the mass.
    law: Programme<S>,
    places: Vec<Place>,
    /// The gap of each wall (m) and its rate (m/s) where the current step or part begins.
    gaps: Vec<(f64, f64)>,
    /// The displacement that each wall's row sees there (m), and the velocity (m/s).
    seen: Vec<(f64, f64)>,
    /// Walls that bound the velocity in the current step or part.
    pub holds: Vec<VelocityBound>,
    /// The walls on the other side of each wall's row.
    opposite: Vec<Vec<usize>>,
    /// The change of the rate of each wall's gap in the last part, m/s, and its length, s.
    changes: Vec<f64>,
    length: f64,
    /// The largest speed at which rebounds ended at the current instant, m/s.
    ended: f64,
    /// The last impacts at each wall.
    last: Vec<LastImpacts>,
    /// No momentum but that of the walls.
    none: S::Vector,
    impulse: Vec<f64>,
    pushing: Vec<usize>,
    /// Impacts so far.
    impacts: u64,
}

impl<S: Space> RowContacts<S> {
    pub fn new(scene: &Scene, body: &Body<S>, backend: Backend) -> Result<Self> {
        let walls = scene.walls.len();
        let opposite = |wall: &Wall| {
            let faces = |other: &Wall| other.row() == wall.row() && other.side() != wall.side();
            (0..walls).filter(|&other| scene.walls.get(other).is_some_and(faces)).collect()
        };
        let (mass, scale) = (body.matrices.mass.clone(), scene.gap_scale() / body.h);
        Ok(Self {
            law: Programme::over(scene, WallLaw::is_rigid, mass, scale, |_| 0.0, backend)?,
            places: vec![Place::Away; walls],
            gaps: vec![(f64::INFINITY, 0.0); walls],
            seen: vec![(0.0, 0.0); walls],
            holds: Vec::with_capacity(walls),
            opposite: scene.walls.iter().map(opposite).collect(),
            changes: vec![0.0; walls],
            length: 0.0,
            ended: 0.0,
            last: vec![LastImpacts::NONE; walls],
            none: zero::<S>(body.n),
            impulse: vec![0.0; walls],
            pushing: Vec::with_capacity(walls),
            impacts: 0,
        })
    }

    /// True if the body rests on this wall.
    fn rests(&self, wall: usize) -> bool {
        self.places[wall] == Place::Resting
    }

    /// True if the body rests on a wall of the other side of this wall's row too.
    fn rests_between(&self, wall: usize) -> bool {
        self.opposite[wall].iter().any(|&other| self.rests(other))
    }

    /// True if the rebounds of a body that strikes a wall at `time` (s) with `speed` (m/s) end
    /// within a step of `h` seconds, under the acceleration of the last part, in turn with impacts
    /// at other walls, or with those at another wall, whose impulse drove the body into this one.
    fn rebounds_end(&self, wall: usize, e: f64, (time, speed): (f64, f64), h: f64) -> bool {
        let pressed = -self.changes[wall];
        let ends = self.length > 0.0 && 2.0 * e * speed * self.length <= (1.0 - e) * h * pressed;
        e < 1.0 && (ends || speed <= self.ended || self.last[wall].accumulate((time, speed), h, 1.0))
    }

    /// Sets the bounds of the walls at which the body rests, no speed into them but out of them by
    /// what rounding has left behind the face, and of elastic walls, for a part of
    /// `length` seconds from the state whose contacts were classified.
    pub fn set_holds(&mut self, body: &Body<S>, length: f64) {
        self.holds.clear();
        // From behind one face the body returns as far as the others leave room: walls all round it
        // let it move by no more.
        let fell = |(wall, face): (usize, &FlatRow)| self.rests(wall) && face.depth(self.seen[wall].0) > 0.0;
        let returns = body.walls.iter().enumerate().any(fell);
        for (wall, &face) in body.walls.iter().enumerate() {
            if face.law.is_rigid() && !self.rests(wall) {
                continue;
            }
            let (w, rate) = self.seen[wall];
            let (bound, compliance) = if face.law.is_rigid() {
                let depth = if returns && !self.rests_between(wall) { face.depth(w) } else { 0.0 };
                (face.sign * depth / body.h - rate, 0.0)
            } else {
                face.spring_bound(w, rate, (length, THETA))
            };
            self.holds.push(VelocityBound { wall, upper: face.upper, bound, compliance });
        }
    }

    /// The gap of a wall along the part of `length` seconds that changes the velocity of its row by
    /// `change` (m/s).
    #[inline]
    fn gap_path(&self, body: &Body<S>, wall: usize, (change, length): (f64, f64)) -> GapPath {
        let (gap, rate) = self.gaps[wall];
        GapPath { gap, rate, change: body.walls[wall].sign * change, span: length }
    }
}

impl<S: Space> Contacts<S> for RowContacts<S> {
    /// A speed that moves the body by less than the touching distance within a step is rest.
    fn classify(&mut self, body: &Body<S>, part: &Part<S>, frame: &Frame<S>) {
        for (wall, face) in body.walls.iter().enumerate() {
            // An earlier wall of the row has seen the same.
            let earlier = self.opposite[wall].first().filter(|&&other| other < wall);
            self.seen[wall] = match earlier {
                Some(&other) => self.seen[other],
                None => (body.seen(wall, &frame.q), body.seen(wall, &frame.v)),
            };
            let (w, rate) = self.seen[wall];
            let (gap, rate) = (-face.depth(w), face.sign * rate);
            self.gaps[wall] = (gap, rate);
            self.places[wall] = if face.law.is_rigid() && gap <= body.touch {
                if rate.abs() <= body.touch / body.h + part.rounding(wall, &frame.v) {
                    Place::Resting
                } else if rate > 0.0 {
                    Place::Leaving
                } else {
                    Place::Struck
                }
            } else {
                Place::Away
            };
        }
    }

    fn is_struck(&self) -> bool {
        self.places.contains(&Place::Struck)
    }

    fn solve_contacts(&mut self, body: &Body<S>, part: &mut Part<S>, _: &Frame<S>, length: f64) -> Solved {
        self.set_holds(body, length);
        part.solve_bounded(body, length * THETA, &self.holds).map(|()| true)
    }

    fn give_up(&mut self, body: &Body<S>, part: &mut Part<S>, frame: &Frame<S>, length: f64) -> Solved {
        self.holds.clear();
        for (wall, &face) in body.walls.iter().enumerate() {
            let (w, rate) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
            let (bound, compliance) = if face.law.is_rigid() {
                ((face.g - w) / length - rate, 0.0)
            } else {
                face.spring_bound(w, rate, (length, 1.0))
            };
            self.holds.push(VelocityBound { wall, upper: face.upper, bound, compliance });
        }
        part.solve_bounded(body, length, &self.holds).map(|()| true)
    }

    fn first_event(&self, body: &Body<S>, _: &Frame<S>, (delta, length): (&S::Vector, f64)) -> Option<(f64, Event)> {
        let mut first: Option<(f64, Event)> = None;
        // The last wall that was looked at, and the change of its row's velocity.
        let mut last = (usize::MAX, 0.0);
        for (wall, face) in body.walls.iter().enumerate() {
            if self.rests(wall) {
                continue;
            }
            let same_row = self.opposite[wall].contains(&last.0);
            last = (wall, if same_row { last.1 } else { body.seen(wall, delta) });
            let path = self.gap_path(body, wall, (last.1, length));
            // An elastic wall that pushes is not entered again.
            if !face.law.is_rigid() && path.gap <= body.touch {
                continue;
            }
            if let Some(at) = path.crossing(body.touch)
                && first.is_none_or(|(earliest, _)| at < earliest)
            {
                first = Some((at, Event::Crossing(wall)));
            }
        }
        first
    }

    fn ahead(&self, body: &Body<S>, _: &Frame<S>, event: Event, (delta, length): (&S::Vector, f64)) -> Ahead {
        let (Event::Crossing(wall) | Event::Reversal(wall) | Event::Slip(wall)) = event;
        let path = self.gap_path(body, wall, (body.seen(wall, delta), length));
        Ahead { left: path.end(), rate: path.rate + path.change, met: body.touch }
    }

    fn restart(&mut self) {
        self.last.fill(LastImpacts::NONE);
    }

    fn stay(&mut self) {
        self.length = 0.0;
    }

    fn keep(&mut self, body: &Body<S>, part: &Part<S>, _: &Frame<S>, length: f64) {
        (self.length, self.ended) = (length, 0.0);
        for (wall, (face, change)) in body.walls.iter().zip(&mut self.changes).enumerate() {
            *change = face.sign * body.seen(wall, &part.delta);
        }
    }

    fn strike(&mut self, body: &Body<S>, part: &Part<S>, frame: &mut Frame<S>, step: u64) -> Result<bool> {
        self.classify(body, part, frame);
        if !self.is_struck() {
            return Ok(false);
        }
        self.impacts += 1;
        self.law.free();
        frame.resting.clear();
        for (wall, face) in body.walls.iter().enumerate() {
            let e = face.law.restitution().unwrap_or(0.0);
            let (place, rate) = (self.places[wall], self.seen[wall].1);
            if place == Place::Struck && e > 0.0 && self.rebounds_end(wall, e, (frame.end, rate.abs()), body.h) {
                frame.resting.push(wall);
            }
        }
        for row in 0..self.law.count_rows() {
            for number in self.law.walls(row) {
                let face = self.law.wall(number);
                let rate = self.seen[face.index].1;
                let bound = match self.places[face.index] {
                    // What drives the body back into a wall that it leaves strikes it next.
                    Place::Away | Place::Leaving => continue,
                    // What leaves slowly may leave: the velocity turned round is always admissible.
                    Place::Resting if face.sign * rate <= 0.0 => -rate,
                    Place::Resting => -2.0 * rate,
                    Place::Struck if frame.resting.contains(&face.index) => -rate,
                    Place::Struck => -(1.0 + face.law.restitution().unwrap_or(0.0)) * rate,
                };
                self.law.bind(row, number, bound);
            }
        }
        let Self { law, none, impulse, pushing, ended, last, seen, .. } = self;
        law.solve(none, (frame.end, step), impulse, pushing)?;
        for (v, d) in frame.v.as_mut().iter_mut().zip(law.x().as_ref()) {
            *v += d;
        }
        for wall in pushing.drain(..) {
            if frame.resting.contains(&wall) {
                *ended = ended.max(seen[wall].1.abs());
            }
            last[wall].observe(frame.end, seen[wall].1.abs());
            frame.push_at_end(wall, std::mem::take(&mut impulse[wall]));
        }
        Ok(true)
    }

    fn count(&self, counters: &mut Counters) {
        counters.qp_solves += self.impacts;
        counters.add_work(&self.law.solver_counters());
    }
}
