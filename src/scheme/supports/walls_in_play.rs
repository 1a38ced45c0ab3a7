//! The walls and holes that a step reaches, each with its bound.
//!
//! Rigid ones are in play if q + ½h v reaches them, with v after the step's blows. The bound on
//! n·ẇ⁺ is −ε n·ẇ at a flat, whose normal stays, and that of [`Turning`](crate::step::Turning) at a
//! hole, whose normal turns. A hole that pushed in the step before stays in play while the body
//! touches it. Elastic walls are always in play and yield as in moreau-jean.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::contact_rows::ContactRows;
use super::friction_contact::{FrictionContact, State};
use super::normal::{AHEAD, HoleState, TURNING, dot, hole_state};
use super::points::ContactPoint;
use crate::linear::update;
use crate::scene::{Checked, Hole};
#[cfg(doc)]
use crate::step::Friction;

/// A hole.
#[derive(Debug, Clone, Copy)]
struct Round {
    centre: [f64; 2],
    gap: f64,
    restitution: f64,
    /// Below this distance from the centre, squared, it is out of reach.
    clear: f64,
}

impl Round {
    /// A place as seen from the centre.
    #[inline(always)]
    fn offset(&self, [y, z]: [f64; 2]) -> [f64; 2] {
        [y - self.centre[0], z - self.centre[1]]
    }
}

/// All walls and holes, and what the step reaches.
#[derive(Debug)]
pub(super) struct WallsInPlay {
    theta: f64,
    /// Of all walls.
    pub points: Vec<ContactPoint>,
    /// Of round walls.
    rounds: Vec<Option<Round>>,
    /// q + ½h v.
    ahead: Vec<f64>,
    /// The mass that each wall feels, kg.
    masses: Vec<f64>,
    /// Walls in play whose rebounds end within the step.
    pub resting: Vec<usize>,
}

impl WallsInPlay {
    pub fn new(scene: &Checked, theta: f64, points: Vec<ContactPoint>) -> Self {
        let round = |hole: Hole<'_>| Round {
            centre: hole.centre,
            gap: hole.gap,
            restitution: hole.restitution,
            clear: (hole.gap * (1.0 - 2.0 * TURNING.touching)).powi(2),
        };
        Self {
            theta,
            points,
            rounds: scene.walls.iter().enumerate().map(|(index, wall)| wall.hole(index).map(round)).collect(),
            ahead: vec![0.0; scene.initial.q.len()],
            masses: scene.wall_masses().to_vec(),
            resting: Vec::with_capacity(scene.walls.len()),
        }
    }

    /// True for a round wall.
    pub fn is_round(&self, wall: usize) -> bool {
        self.rounds[wall].is_some()
    }

    /// Sets how far the step of `h` seconds reaches.
    #[inline(always)]
    pub fn set_reach(&mut self, frame: &Frame<Matrices>, h: f64) {
        self.resting.clear();
        update(&mut self.ahead, [&frame.q, frame.struck()], |_, [q, v]| q + AHEAD * h * v);
    }

    /// A wall, if it is in play; `push` is its push in the last step, N s, and what it `did` there.
    pub fn wall(
        &mut self,
        wall: usize,
        (body, frame): (&Body<Matrices>, &Frame<Matrices>),
        places: &ContactRows,
        (push, did): (f64, State),
    ) -> Option<FrictionContact> {
        let (face, point) = (body.walls[wall], self.points[wall]);
        let (bound, compliance) = match (face.law.spring(), face.law.restitution()) {
            // As in moreau-jean: the row exceeds a bound on δ by compliance times impulse.
            (Some(_), _) => {
                let (w, before) = (body.seen(wall, &frame.q), body.seen(wall, &frame.v));
                let (bound, compliance) = face.spring_bound(w, before, (body.h, self.theta));
                (-face.sign * (before + bound), compliance)
            }
            (_, Some(restitution)) if face.depth(body.seen(wall, &self.ahead)) >= -body.touch => {
                let struck = body.seen(wall, frame.struck());
                let approach = -face.sign * struck;
                let epsilon = if approach < 0.0 {
                    1.0
                } else if self.rests(wall, restitution, approach, push) {
                    self.resting.push(wall);
                    0.0
                } else {
                    restitution
                };
                (-epsilon * approach, 0.0)
            }
            _ => return None,
        };
        let (contact, law) = ((wall, point.rows), (point.friction.sticking, compliance));
        let touch = FrictionContact::new(places, contact, (point.normal, bound), law);
        Some(touch.after(point.friction, did))
    }

    /// True if the rebounds of a body that arrives at a wall with friction at this speed (m/s) end
    /// within the step, under the push of the last step, N s: [`Friction`].
    fn rests(&self, wall: usize, restitution: f64, approach: f64, push: f64) -> bool {
        let rebounds = 2.0 * restitution * self.masses[wall] * approach;
        self.points[wall].friction.acts() && push > 0.0 && rebounds <= (1.0 - restitution) * push
    }

    /// A round wall, if it is in play; in the last step it `did` that, and `turned` is that of
    /// [`HoleState`] if it pushed there, else 0.
    #[inline(always)]
    pub fn hole(
        &self,
        index: usize,
        (frame, h): (&Frame<Matrices>, f64),
        places: &ContactRows,
        (turned, did): (f64, State),
    ) -> Option<(FrictionContact, HoleState)> {
        let (round, point) = (self.rounds[index]?, self.points[index]);
        let ahead = round.offset(places.pair(point.rows, &self.ahead));
        if turned == 0.0 && dot(ahead, ahead) < round.clear {
            return None;
        }
        let (at, rate) = (places.pair(point.rows, &frame.q), places.pair(point.rows, frame.struck()));
        let met = hole_state((round.gap, round.restitution), [round.offset(at), rate], h, turned)?;
        Some((self.touch(index, &met, places, did), met))
    }

    /// The contact with a round wall that was `met`.
    #[inline(never)]
    fn touch(&self, index: usize, met: &HoleState, places: &ContactRows, did: State) -> FrictionContact {
        let point = self.points[index];
        let (contact, law) = ((index, point.rows), (point.friction.sticking, 0.0));
        let touch = FrictionContact::new(places, contact, (met.normal, met.bound), law);
        touch.after(point.friction, did)
    }
}
