//! A wall in the exact schemes: its law, whether it touches, and its open episode.

use crate::error::{Error, Result, Subject};
use crate::flow::Touch;
use crate::scene::{Scene, Side, Wall};
use crate::step::Contact;

/// Where the body is relative to one wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::scheme) enum Phase {
    /// A rigid wall, with its restitution e.
    Rigid(f64),
    /// An elastic wall, with the body in front of it: s ≤ 0.
    Outside,
    /// An elastic wall that pushes: k_a s + c_a ṡ > 0.
    Touching,
    /// An elastic wall that does not push although the body is behind its face: k_a s + c_a ṡ ≤ 0 <
    /// s.
    Detached,
}

/// The walls of `scene`; rejects a law for which the exact motion is not available.
pub(in crate::scheme) fn barriers(scene: &Scene) -> Result<Vec<ExactWall>> {
    let barrier = |wall: &Wall| {
        ExactWall::new(wall).ok_or_else(|| {
            let key = Subject::wall(&wall.name).part("law");
            Error::invalid(key, wall.law.kind(), "a rigid or an elastic wall for the exact scheme")
        })
    };
    scene.walls.iter().map(barrier).collect()
}

/// One wall of a run, or a round hole, which is an upper wall along its normal.
#[derive(Debug, Clone)]
pub(in crate::scheme) struct ExactWall {
    pub name: String,
    /// True for a round hole, whose episodes have impulses above 0.
    round: bool,
    pub side: Side,
    /// The direction away from the wall: +1 at a lower wall, −1 at an upper one.
    pub sign: f64,
    /// Position g, m.
    pub position: f64,
    /// k_a, N/m, and c_a, N s/m; zero for a rigid wall.
    pub stiffness: f64,
    pub damping: f64,
    pub phase: Phase,
    /// When the phase last changed, s.
    pub changed: f64,
    /// The open episode.
    pub open: Option<Contact>,
}

impl ExactWall {
    /// `None` for a law that the exact schemes do not follow.
    pub fn new(wall: &Wall) -> Option<Self> {
        let (stiffness, damping, phase) = match (wall.law.restitution(), wall.law.spring()) {
            (Some(restitution), _) => (0.0, 0.0, Phase::Rigid(restitution)),
            (_, Some(spring)) => (spring.stiffness, spring.damping, Phase::Outside),
            _ => return None,
        };
        Some(Self {
            name: wall.name.clone(),
            round: wall.is_round(),
            side: wall.side(),
            sign: wall.side().sign(),
            position: wall.position(),
            stiffness,
            damping,
            phase,
            changed: f64::NEG_INFINITY,
            open: None,
        })
    }

    /// The open episode as results show it.
    pub fn shown(&self) -> Option<Contact> {
        let mut contact = self.open?;
        if self.round {
            contact.impulse = contact.impulse.abs();
        }
        Some(contact)
    }

    /// Gap at `q`, m.
    #[inline]
    pub fn gap(&self, q: f64) -> f64 {
        self.sign * (q - self.position)
    }

    /// The sum k_a s + c_a ṡ at (`q`, `v`), N.
    pub fn sum(&self, q: f64, v: f64) -> f64 {
        -self.sign * (self.stiffness * (q - self.position) + self.damping * v)
    }

    /// The wall in the form that [`Arc`](crate::flow::Arc) takes, while it touches.
    pub fn touch(&self, wall: usize) -> Option<Touch> {
        let Self { position, stiffness, damping, .. } = *self;
        (self.phase == Phase::Touching).then_some(Touch { wall, position, stiffness, damping })
    }

    /// Sets the phase of an elastic wall from the state; a body on its surface touches if it moves
    /// inwards.
    pub fn classify(&mut self, q: f64, v: f64, resolution: f64) {
        if matches!(self.phase, Phase::Rigid(_)) {
            return;
        }
        self.phase = if -self.gap(q) > resolution {
            if self.sum(q, v) > 0.0 { Phase::Touching } else { Phase::Detached }
        } else if self.gap(q) <= resolution && -self.sign * v > 0.0 {
            Phase::Touching
        } else {
            Phase::Outside
        };
    }

    /// Moves an elastic wall into its next phase at `time` (s), with the body at `q` (m) and `v`
    /// (m/s), on its surface within `resolution` (m) or behind it. Returns whether the surface was
    /// crossed.
    ///
    /// A body behind the wall without force has reached either the surface, where k_a s = 0, or a
    /// state where k_a s + c_a ṡ = 0. The one nearer to 0 tells which: the rounding error of the
    /// instant, times a high speed, may put the body further from the surface than `resolution`.
    pub fn cross(&mut self, (q, v): (f64, f64), resolution: f64, time: f64) -> bool {
        let depth = self.gap(q).abs();
        let emerged = self.phase == Phase::Detached && self.stiffness * depth < self.sum(q, v).abs();
        let at_surface = emerged || depth <= resolution;
        let next = match self.phase {
            Phase::Rigid(_) => return false,
            Phase::Outside => Phase::Touching,
            Phase::Touching if at_surface || self.damping == 0.0 => Phase::Outside,
            Phase::Touching => Phase::Detached,
            Phase::Detached if at_surface => Phase::Outside,
            Phase::Detached => Phase::Touching,
        };
        let crossed = next == Phase::Outside || self.phase == Phase::Outside;
        (self.phase, self.changed) = (next, time);
        crossed
    }

    /// Opens or closes the episode of an elastic wall according to its phase, at the velocity `v`
    /// (m/s).
    pub fn settle(&mut self, wall: usize, time: f64, v: f64, closed: &mut Vec<Contact>) {
        match self.phase {
            Phase::Touching => self.open(wall, time, -self.sign * v),
            Phase::Outside | Phase::Detached => closed.extend(self.close(time, self.sign * v)),
            Phase::Rigid(_) => {}
        }
    }

    /// Begins an episode unless one is open.
    pub fn open(&mut self, wall: usize, start: f64, approach_speed: f64) {
        if self.open.is_none() {
            self.open = Some(Contact {
                wall,
                start,
                end: None,
                impulse: 0.0,
                peak_force: None,
                approach_speed: approach_speed.max(0.0),
                departure_speed: None,
            });
        }
    }

    /// Ends the open episode and returns it; `None` if no force has acted, since a touch is no
    /// contact.
    pub fn close(&mut self, end: f64, departure_speed: f64) -> Option<Contact> {
        let known = self.shown();
        self.open = None;
        let mut contact = known.filter(|c| c.impulse != 0.0)?;
        (contact.end, contact.departure_speed) = (Some(end), Some(departure_speed.max(0.0)));
        Some(contact)
    }

    /// Records a pressure of the open episode, N.
    #[inline]
    pub fn note(&mut self, pressure: f64) {
        if let Some(contact) = &mut self.open {
            let peak = contact.peak_force.unwrap_or(0.0);
            contact.peak_force = Some(peak.max(pressure));
        }
    }
}

#[cfg(test)]
mod tests;
