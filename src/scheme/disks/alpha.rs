//! `generalized-alpha` with round holes: as [`super::super::generalized_alpha`], where the
//! equations stand, with disks on the displacement and half-planes on the velocity.
//!
//! The displacement is corrected so that every hole holds it, |w⁺| ≤ γ. Of the holes that are then
//! closed, the velocity obeys the law of [`Turning`](crate::step::Turning) with the normal n in the
//! middle of w and w⁺: what arrives rebounds by e, what only the turning of the normal adds is
//! reflected. With n at w⁺ a body that slides would lose speed as in implicit-euler; only where the
//! step crosses the hole, so that the middle says nothing of the normal, it is taken there.

use super::super::chung_hulbert::{ChungHulbert, is_met};
use super::super::matrices::Matrices;
use super::super::supports::closed_hole_state;
use super::disk_programme::DiskProgramme;
use super::hole_body::HoleBody;
use crate::error::Result;
use crate::qp::{DiskBound, DiskCounters};
use crate::scene::Scene;
use crate::step::Balance;

#[derive(Debug)]
pub(super) struct Alpha {
    rule: ChungHulbert<Matrices>,
    /// True if a rigid wall or hole is closed at the step's start.
    closed: bool,
    /// Force of each elastic wall at the step's start, N.
    held: Vec<f64>,
    /// All walls and holes, in Δ, m; the rigid ones in v⁺ − v_c, m/s.
    place: DiskProgramme,
    rate: DiskProgramme,
    zero: Vec<f64>,
    /// w of each hole at the step's start, m.
    start: Vec<[f64; 2]>,
}

impl Alpha {
    pub fn new(scene: &Scene, balance: Balance, held: &HoleBody) -> Result<Self> {
        let (body, gap) = (&held.body, scene.gap_scale());
        let rule = ChungHulbert::new(body, balance)?;
        let h = body.h;
        let mut alpha = Self {
            closed: false,
            held: vec![0.0; scene.walls.len()],
            place: DiskProgramme::new(scene, rule.matrix(body), gap, |spring| 1.0 / spring.stiffness_over(h))?,
            rate: DiskProgramme::new(scene, rule.velocity_matrix(body), gap / h, |_| 0.0)?,
            zero: vec![0.0; body.n],
            start: vec![[0.0; 2]; held.rounds.len()],
            rule,
        };
        alpha.restart(held);
        Ok(alpha)
    }

    /// Starts from the state of `held`.
    pub fn restart(&mut self, held: &HoleBody) {
        self.held = self.rule.restart(&held.body, &held.frame.q, &held.frame.v);
        let q = &held.frame.q;
        let stands = |wall: usize| {
            let face = held.body.walls[wall];
            face.law.is_rigid() && face.depth(held.body.seen(wall, q)) >= -held.body.touch
        };
        self.closed =
            (0..held.body.walls.len()).any(stands) || (0..held.rounds.len()).any(|hole| held.touches(hole, q));
    }

    /// What the rule carries, as in `Rule::carried`.
    pub fn carried(&mut self) -> [Option<(&mut Vec<f64>, i32)>; 2] {
        self.rule.carried()
    }

    /// Makes a step.
    pub fn advance(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        held.frame.before.clone_from(&held.frame.v);
        for (hole, start) in self.start.iter_mut().enumerate() {
            *start = held.offset(hole, &held.frame.q);
        }
        self.rule.predict(&mut held.body, &mut held.frame);
        let met = self.displace(step, held)?;
        self.press(held);
        let answered = held.frame.blown && held.body.damped && self.answers(held);
        if answered {
            self.rule.damp_blows(-1.0, &mut held.body, &held.frame);
        }
        if met || answered {
            self.rule.free_velocity(&held.body, &mut held.frame, |b| held.body.push(1.0, &self.held, b));
        }
        let pushed = self.correct_velocity(step, held)?;
        // What was met is closed, so its velocity is corrected too.
        let changed = pushed || answered;
        self.rule.renew(&held.body, &held.frame, changed, |force| held.body.push(1.0, &self.held, force));
        held.frame.after.clone_from(&held.frame.v);
        Ok(())
    }

    /// q⁺, v⁺ without the impulses of rigid walls and holes unless one was met, a⁺ likewise, and
    /// the forces of elastic walls. Returns whether a rigid wall or hole was met.
    fn displace(&mut self, step: u64, held: &mut HoleBody) -> Result<bool> {
        let (unfelt, closed) = (self.rule.unfelt, self.closed);
        let met = is_met(unfelt, closed, |unfelt| self.put(step, held, unfelt))?;
        self.rule.displace(self.place.x(), met, held.body.h, &mut held.frame);
        Ok(met)
    }

    /// Solves for Δ, the damper not feeling a and the extra force over `unfelt` (s). Returns
    /// whether a rigid wall or hole pushes.
    fn put(&mut self, step: u64, held: &HoleBody, unfelt: f64) -> Result<bool> {
        let (body, frame) = (&held.body, &held.frame);
        self.rule.ask(body, unfelt);
        let Self { place, rule, .. } = self;
        for (wall, face) in held.flats.iter().map(|&wall| (wall, body.walls[wall])) {
            let ahead = body.seen(wall, &rule.q);
            let bound = match face.law.spring() {
                // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                Some(spring) => {
                    let plate = face.plate(body.seen(wall, &frame.q));
                    -spring.force(ahead, face.g, plate, body.h) / spring.stiffness_over(body.h)
                }
                None => face.g - ahead,
            };
            place.bind_wall(wall, face, bound);
        }
        for hole in 0..held.rounds.len() {
            place.bind_hole(held.index(hole), held.disk(hole, self.start[hole], held.offset(hole, &rule.q)));
        }
        place.solve(&rule.b, (frame.start, step))?;
        let walls = held.flats.iter().any(|&wall| body.walls[wall].law.is_rigid() && place.of_wall(wall) != 0.0);
        Ok(walls || held.rounds.iter().any(|round| place.of_hole(round.wall) != [0.0; 2]))
    }

    /// Writes the forces of the elastic walls, and the impulses ½h(r + r⁺) of those that push at
    /// either end of the step.
    fn press(&mut self, held: &mut HoleBody) {
        let (body, frame) = (&held.body, &mut held.frame);
        for &wall in held.flats.iter().filter(|&&wall| !body.walls[wall].law.is_rigid()) {
            let force = self.place.of_wall(wall);
            let impulse = 0.5 * body.h * (self.held[wall] + force);
            self.held[wall] = force;
            if impulse != 0.0 {
                (frame.impulse[wall], frame.force[wall]) = (impulse, force);
                frame.pushing.push(wall);
            }
        }
    }

    /// True if a rigid wall is closed at q⁺.
    fn closes_wall(&self, held: &HoleBody, wall: usize) -> bool {
        let face = held.body.walls[wall];
        // A wall with a multiplier is closed too: q⁺ is at it to the rounding error of q.
        let presses = self.place.of_wall(wall) != 0.0;
        face.law.is_rigid() && (presses || face.depth(held.body.seen(wall, &held.frame.q)) >= -held.body.touch)
    }

    /// True if a rigid hole is closed at q⁺.
    fn closes_hole(&self, held: &HoleBody, hole: usize) -> bool {
        held.rounds[hole].law.is_rigid()
            && (self.place.of_hole(held.index(hole)) != [0.0; 2] || held.touches(hole, &held.frame.q))
    }

    /// True if the blows drive the body into a rigid wall or hole that is closed at q⁺: it keeps
    /// the body from that displacement, and the momentum that they would lose to the damper goes to
    /// it.
    fn answers(&self, held: &HoleBody) -> bool {
        let Some(blows) = &held.body.blows else { return false };
        let into = |hole: usize| {
            let ([y, z], [vy, vz]) = (held.offset(hole, &held.frame.q), held.seen(hole, &blows.given));
            y * vy + z * vz > 0.0
        };
        held.flats.iter().any(|&wall| held.body.drives(wall) && self.closes_wall(held, wall))
            || (0..held.rounds.len()).any(|hole| into(hole) && self.closes_hole(held, hole))
    }

    /// Solves for v⁺ and the impulses of the rigid walls and holes that are closed. Returns whether
    /// one of them may push.
    fn correct_velocity(&mut self, step: u64, held: &mut HoleBody) -> Result<bool> {
        let h = held.body.h;
        self.closed = false;
        for wall in held.flats.iter().copied() {
            if !self.closes_wall(held, wall) {
                self.rate.open_wall(wall);
                continue;
            }
            self.closed = true;
            let (face, body) = (held.body.walls[wall], &held.body);
            let struck = body.seen(wall, held.frame.struck());
            let epsilon = if face.sign * struck <= 0.0 { face.law.restitution().unwrap_or(0.0) } else { 1.0 };
            self.rate.bind_wall(wall, face, -epsilon * struck - body.seen(wall, &held.frame.v));
        }
        for hole in 0..held.rounds.len() {
            if !self.closes_hole(held, hole) {
                self.rate.bind_hole(held.index(hole), DiskBound::OPEN);
                continue;
            }
            self.closed = true;
            let (start, end) = (self.start[hole], held.offset(hole, &held.frame.q));
            let struck = held.seen(hole, held.frame.struck());
            let (gap, e) = (held.rounds[hole].gap, held.rounds[hole].law.restitution().unwrap_or(0.0));
            let met = closed_hole_state((gap, e), [start, end], struck, h);
            let normal = met.normal;
            let [vy, vz] = held.seen(hole, &held.frame.v);
            let hi = met.bound - (normal[0] * vy + normal[1] * vz);
            self.rate.bind_hole(held.index(hole), DiskBound::Strip { normal, lo: f64::NEG_INFINITY, hi });
            let index = held.index(hole);
            held.frame.normal[index] = normal;
        }
        if !self.closed {
            return Ok(false);
        }
        let mu = self.rule.mu();
        self.rate.solve(&self.zero, (held.frame.start, step))?;
        held.frame.v.iter_mut().zip(self.rate.x()).for_each(|(v, d)| *v += d);
        for &wall in &held.flats {
            let r = self.rate.of_wall(wall);
            if r != 0.0 {
                held.frame.push(wall, r / mu, h);
            }
        }
        for hole in 0..held.rounds.len() {
            let (index, [y, z]) = (held.index(hole), self.rate.of_hole(held.index(hole)));
            let [ny, nz] = held.frame.normal[index];
            let impulse = -(y * ny + z * nz) / mu;
            if impulse != 0.0 {
                held.frame.push(index, impulse, h);
            }
        }
        Ok(true)
    }

    /// The work of both programmes.
    pub fn counters(&self) -> DiskCounters {
        self.place.counters().and(self.rate.counters())
    }
}
