//! The contact episodes of walls and round holes together.

use crate::contact::{Episodes, Rates};
use crate::scene::Checked;
use crate::step::{Contact, Contract};

/// What each wall, then each hole, did in a step, for its contact episodes.
#[derive(Debug)]
pub(super) struct Pushes {
    /// N s, signed at walls.
    impulse: Vec<f64>,
    /// Those that push.
    pushing: Vec<usize>,
    pub rates: Vec<Rates>,
    episodes: Episodes,
}

impl Pushes {
    /// For all walls and holes of `scene`, whose steps satisfy `contract`.
    pub fn new(scene: &Checked, contract: Contract) -> Self {
        let contacts = scene.walls.len() + scene.holes().count();
        let still = Rates { before: 0.0, struck: 0.0, after: 0.0 };
        Self {
            impulse: vec![0.0; contacts],
            pushing: Vec::with_capacity(contacts),
            rates: vec![still; contacts],
            episodes: Episodes::new(scene, scene.wall_masses(), contract),
        }
    }

    /// Takes back all impulses of the step.
    pub fn clear(&mut self) {
        for contact in self.pushing.drain(..) {
            self.impulse[contact] = 0.0;
        }
    }

    /// Adds an impulse that is not 0, N s.
    pub fn push(&mut self, contact: usize, impulse: f64) {
        self.pushing.push(contact);
        self.impulse[contact] = impulse;
    }

    /// Passes the step of `h` seconds from `start` to the episodes; `rates` gives the velocities of
    /// those that push from what is known of them.
    pub fn tell(&mut self, start: f64, h: f64, rates: impl Fn(usize, Rates) -> Rates) {
        if !(self.pushing.is_empty() && self.episodes.idle()) {
            let known = &self.rates;
            self.episodes.see(start, h, &self.impulse, &self.pushing, |contact| rates(contact, known[contact]));
        }
    }

    /// Drops all episodes.
    pub fn forget(&mut self) {
        self.episodes.forget();
    }

    /// Episodes that the last step closed.
    pub fn closed(&self) -> &[Contact] {
        self.episodes.closed()
    }

    /// Episodes that are not closed yet.
    pub fn still_open(&self) -> Vec<Contact> {
        self.episodes.still_open()
    }
}
