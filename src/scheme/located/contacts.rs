//! Which rigid walls the body touches, and the impact law at an instant.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::programme::Programme;
use super::super::space::{Space, zero};
use super::part::Part;
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Scene, Wall, WallLaw};

/// Where the body is at a rigid wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// In front of it.
    Away,
    /// On its face, at rest.
    Resting,
    /// On its face, moving away.
    Leaving,
    /// On its face, moving into it.
    Struck,
}

/// The rigid walls that the body touches, and the law of their impacts.
#[derive(Debug)]
pub(super) struct Contacts<S: Space> {
    /// The programme of an impact, in the metric of the mass.
    law: Programme<S>,
    places: Vec<Place>,
    /// The walls on the other side of each wall's row.
    opposite: Vec<Vec<usize>>,
    /// The change of the rate of each wall's gap in the last part, m/s, and its length, s.
    changes: Vec<f64>,
    length: f64,
    /// No momentum but that of the walls.
    none: S::Vector,
    impulse: Vec<f64>,
    pushing: Vec<usize>,
    /// Impacts so far.
    pub impacts: u64,
}

impl<S: Space> Contacts<S> {
    pub fn new(scene: &Scene, body: &Body<S>, backend: Backend) -> Result<Self> {
        let walls = scene.walls.len();
        let opposite = |wall: &Wall| {
            let faces = |other: &Wall| other.row() == wall.row() && other.side() != wall.side();
            (0..walls).filter(|&other| scene.walls.get(other).is_some_and(faces)).collect()
        };
        let (mass, scale) = (body.matrices.mass.clone(), scene.gap_scale() / body.h);
        Ok(Self {
            law: Programme::over(scene, WallLaw::is_rigid, mass, scale, |_, _| 0.0, backend)?,
            places: vec![Place::Away; walls],
            opposite: scene.walls.iter().map(opposite).collect(),
            changes: vec![0.0; walls],
            length: 0.0,
            none: zero::<S>(body.n),
            impulse: vec![0.0; walls],
            pushing: Vec::with_capacity(walls),
            impacts: 0,
        })
    }

    /// Finds where the state of `frame` is at each rigid wall. A speed that moves the body by less
    /// than the touching distance within a step is rest.
    pub fn classify(&mut self, body: &Body<S>, part: &Part<S>, frame: &Frame<S>) {
        for (wall, (face, place)) in body.walls.iter().zip(&mut self.places).enumerate() {
            let touches = face.law.is_rigid() && -face.depth(body.seen(wall, &frame.q)) <= body.touch;
            *place = if touches {
                let rate = face.sign * body.seen(wall, &frame.v);
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

    /// Notes that the body touches no rigid wall.
    pub fn leave_all(&mut self) {
        self.places.fill(Place::Away);
    }

    /// True if the body rests on this wall.
    pub fn rests(&self, wall: usize) -> bool {
        self.places[wall] == Place::Resting
    }

    /// True if the body rests on a wall of the other side of this wall's row too.
    pub fn rests_between(&self, wall: usize) -> bool {
        self.opposite[wall].iter().any(|&other| self.rests(other))
    }

    /// True if the body moves into a wall that it touches.
    pub fn is_struck(&self) -> bool {
        self.places.contains(&Place::Struck)
    }

    /// Forgets how the rates of the gaps changed: the last part had no length.
    pub fn forget_changes(&mut self) {
        self.length = 0.0;
    }

    /// Keeps how the rates of the gaps changed in a part of `length` seconds.
    pub fn set_changes(&mut self, body: &Body<S>, delta: &S::Vector, length: f64) {
        self.length = length;
        for (wall, (face, change)) in body.walls.iter().zip(&mut self.changes).enumerate() {
            *change = face.sign * body.seen(wall, delta);
        }
    }

    /// Applies the impact law to the state of `frame`, if a wall is struck, and writes the impulses
    /// of the instant. Returns whether there was an impact.
    pub fn strike(&mut self, body: &Body<S>, part: &Part<S>, frame: &mut Frame<S>, step: u64) -> Result<bool> {
        self.classify(body, part, frame);
        if !self.is_struck() {
            return Ok(false);
        }
        self.impacts += 1;
        self.law.free();
        frame.resting.clear();
        for row in 0..self.law.count_rows() {
            for number in self.law.walls(row) {
                let face = self.law.wall(number);
                let rate = body.seen(face.index, &frame.v);
                let bound = match self.places[face.index] {
                    Place::Away => continue,
                    Place::Resting => -rate,
                    Place::Leaving => -2.0 * rate,
                    Place::Struck => {
                        let e = face.law.restitution().unwrap_or(0.0);
                        let ends = e > 0.0 && self.rebounds_end(face.index, e, rate.abs(), body.h);
                        if ends {
                            frame.resting.push(face.index);
                        }
                        if ends { -rate } else { -(1.0 + e) * rate }
                    }
                };
                self.law.bind(row, number, bound);
            }
        }
        let Self { law, none, impulse, pushing, .. } = self;
        law.solve(none, (frame.end, step), impulse, pushing)?;
        for (v, d) in frame.v.as_mut().iter_mut().zip(law.x().as_ref()) {
            *v += d;
        }
        for wall in pushing.drain(..) {
            frame.push_at_end(wall, std::mem::take(&mut impulse[wall]));
        }
        Ok(true)
    }

    /// True if the rebounds of a body that strikes a wall at `speed` (m/s) end within a step of `h`
    /// seconds, under the acceleration of the last part.
    fn rebounds_end(&self, wall: usize, e: f64, speed: f64, h: f64) -> bool {
        let pressed = -self.changes[wall];
        e < 1.0 && self.length > 0.0 && 2.0 * e * speed * self.length <= (1.0 - e) * h * pressed
    }
}
