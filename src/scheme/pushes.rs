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

#[cfg(test)]
mod tests {
    use super::super::Scheme;
    use super::*;
    use crate::scene::{Scene, Wall};

    #[test]
    fn a_contact_ends_when_its_push_is_cleared_and_is_forgotten_when_the_state_is_set() {
        let scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(Wall::upper("stop", 1.0));
        let contract = Scheme::MoreauJean { theta: 0.5 }.contract();
        let mut pushes = Pushes::new(&Checked::new(&scene).unwrap(), contract);
        let told = |pushes: &mut Pushes, step: f64| {
            pushes.tell(0.5 * step, 0.5, |_, known| known);
            (pushes.still_open().len(), pushes.closed().len())
        };
        pushes.rates[0] = Rates { before: 1.0, struck: 1.0, after: -1.0 };
        pushes.push(0, -2.0);
        assert_eq!(told(&mut pushes, 0.0), (1, 0));
        pushes.clear();
        assert_eq!(told(&mut pushes, 1.0), (0, 1));
        assert_eq!((pushes.closed()[0].impulse, pushes.closed()[0].approach_speed), (-2.0, 1.0));
        assert_eq!(told(&mut pushes, 2.0), (0, 0));
        pushes.push(0, -2.0);
        assert_eq!(told(&mut pushes, 3.0), (1, 0));
        pushes.forget();
        assert_eq!((pushes.still_open().len(), pushes.closed().len()), (0, 0));
    }
}
