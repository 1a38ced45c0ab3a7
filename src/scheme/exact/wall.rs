//! A wall as the exact scheme sees it: its law, whether it touches, and the episode under way.

use crate::error::{Error, Result, Subject};
use crate::flow::Touch;
use crate::scene::{Scene, Side, Wall, WallLaw};
use crate::step::Contact;

/// Where the body is with respect to one wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::scheme) enum Phase {
    /// A rigid wall, with its restitution e.
    Rigid(f64),
    /// An elastic wall, before it: s ≤ 0.
    Outside,
    /// In it and pushed: k_a s + c_a ṡ > 0.
    Touching,
    /// In it but let go: k_a s + c_a ṡ ≤ 0 < s.
    Detached,
}

/// The walls of `scene`; refuses a law under which the motion is not known.
pub(in crate::scheme) fn barriers(scene: &Scene) -> Result<Vec<ExactWall>> {
    let barrier = |wall: &Wall| {
        ExactWall::new(wall).ok_or_else(|| {
            let key = Subject::wall(&wall.name).part("law");
            Error::invalid(key, "the φ² penalty", "a rigid or an elastic wall for the exact scheme")
        })
    };
    scene.walls.iter().map(barrier).collect()
}

/// One wall of a run.
#[derive(Debug, Clone)]
pub(in crate::scheme) struct ExactWall {
    pub name: String,
    pub side: Side,
    /// Away from the wall: +1 at a lower wall, −1 at an upper one.
    pub sign: f64,
    /// Position g, m.
    pub position: f64,
    /// k_a, N/m, and c_a, N s/m; zero for a rigid wall.
    pub stiffness: f64,
    pub damping: f64,
    pub phase: Phase,
    /// When the phase last changed, s.
    pub changed: f64,
    /// The episode under way.
    pub open: Option<Contact>,
}

impl ExactWall {
    /// None for a law that the exact scheme does not follow.
    pub fn new(wall: &Wall) -> Option<Self> {
        let (stiffness, damping, phase) = match wall.law {
            WallLaw::Rigid { restitution } => (0.0, 0.0, Phase::Rigid(restitution)),
            WallLaw::Elastic { stiffness, damping } => (stiffness, damping, Phase::Outside),
            WallLaw::Quartic { .. } => return None,
        };
        Some(Self {
            name: wall.name.clone(),
            side: wall.side,
            sign: wall.side.sign(),
            position: wall.position,
            stiffness,
            damping,
            phase,
            changed: f64::NEG_INFINITY,
            open: None,
        })
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

    /// The same wall as the flow needs it, while it touches.
    pub fn touch(&self, wall: usize) -> Option<Touch> {
        let Self { position, stiffness, damping, .. } = *self;
        (self.phase == Phase::Touching).then_some(Touch { wall, position, stiffness, damping })
    }

    /// Puts an elastic wall in the phase that the state asks for; a body on the surface touches if it moves inwards.
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

    /// Moves an elastic wall into its next phase at `time` (s), with the body on its surface or within. Returns whether the surface was crossed.
    pub fn cross(&mut self, at_surface: bool, time: f64) -> bool {
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

    /// Opens or closes the episode of an elastic wall as its phase asks, at the velocity `v` (m/s).
    pub fn settle(&mut self, wall: usize, time: f64, v: f64, closed: &mut Vec<Contact>) {
        match self.phase {
            Phase::Touching => self.open(wall, time, -self.sign * v),
            Phase::Outside | Phase::Detached => closed.extend(self.close(time, self.sign * v)),
            Phase::Rigid(_) => {}
        }
    }

    /// Begins an episode unless one is under way.
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

    /// Ends the episode under way and hands it over; nothing if no force has acted: a touch is no contact.
    pub fn close(&mut self, end: f64, departure_speed: f64) -> Option<Contact> {
        let mut contact = self.open.take().filter(|c| c.impulse != 0.0)?;
        (contact.end, contact.departure_speed) = (Some(end), Some(departure_speed.max(0.0)));
        Some(contact)
    }

    /// Notes a pressure of the episode under way, N.
    #[inline]
    pub fn note(&mut self, pressure: f64) {
        if let Some(contact) = &mut self.open {
            let peak = contact.peak_force.unwrap_or(0.0);
            contact.peak_force = Some(peak.max(pressure));
        }
    }
}
