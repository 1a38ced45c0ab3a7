//! The work of wear over the rows of a run, and in each of its contacts.

use crate::scene::Scene;
use crate::step::{Contact, Step};
use crate::wear::{ImpulseDuration, SlidingContacts, SlidingPiece};
use serde::{Deserialize, Serialize};

/// What a contact of a support did.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct EpisodeWear {
    /// Where it began, degrees from +y towards +z.
    pub angle: f64,
    /// Its work of wear ∫ F_n |v_t| dt, J.
    pub work: f64,
    /// The distance slid in it, m; 0 for an impact, which takes no time.
    pub sliding: f64,
}

/// The work of wear of each support since the start, and of the open contacts.
#[derive(Debug, Clone)]
pub(super) struct Worn {
    sliding: SlidingContacts,
    /// J, one for each support.
    pub work: Vec<f64>,
    /// One for each contact of the supports that is open.
    open: Vec<Option<EpisodeWear>>,
    /// The contacts that pushed at the end of the current step, of exact motion.
    jumps: Vec<(usize, EpisodeWear)>,
    /// What slid between two times (s) of the current step, those added last; NaN before.
    pieces: Vec<SlidingPiece>,
    within: [f64; 2],
}

impl Worn {
    pub fn new(scene: &Scene) -> Self {
        let sliding = SlidingContacts::new(scene);
        let open = if sliding.is_empty() { 0 } else { sliding.contacts() };
        Self {
            work: vec![0.0; scene.supports.len()],
            open: vec![None; open],
            jumps: Vec::new(),
            pieces: Vec::new(),
            within: [f64::NAN; 2],
            sliding,
        }
    }

    /// True for a scene without supports.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.sliding.is_empty()
    }

    /// Adds what slid in `step` between two times in it, s.
    pub fn add(&mut self, step: &Step<'_>, within: [f64; 2]) {
        let Self { sliding, work, open, jumps, pieces, .. } = self;
        self.within = within;
        pieces.clear();
        sliding.observe(step, within, |piece: &SlidingPiece| {
            pieces.push(*piece);
            if let Some(sum) = work.get_mut(piece.support) {
                *sum += piece.work;
            }
            let fresh = || {
                let angle = sliding.angle_at_start(piece, step, within[0]);
                EpisodeWear { angle, work: 0.0, sliding: 0.0 }
            };
            if piece.duration == ImpulseDuration::Instant {
                jumps.push((piece.contact, EpisodeWear { work: piece.work, ..fresh() }));
            } else if let Some(open) = open.get_mut(piece.contact) {
                let contact = open.get_or_insert_with(fresh);
                contact.work += piece.work;
                contact.sliding += piece.sliding;
            }
        });
    }

    /// Begins a step.
    pub fn begin(&mut self) {
        self.within = [f64::NAN; 2];
    }

    /// What slid between the times of the current step that were added last.
    pub fn slid(&self) -> ([f64; 2], &[SlidingPiece]) {
        (self.within, &self.pieces)
    }

    /// Takes the contacts that end, and calls `each` for every one of them.
    pub fn close(&mut self, closed: &[Contact], mut each: impl FnMut(Option<EpisodeWear>)) {
        for contact in closed {
            each(self.take(contact));
        }
        for (index, jump) in std::mem::take(&mut self.jumps) {
            // An impact that begins a contact.
            if let Some(open) = self.open.get_mut(index) {
                let contact = open.get_or_insert(EpisodeWear { work: 0.0, ..jump });
                contact.work += jump.work;
            }
        }
    }

    fn take(&mut self, contact: &Contact) -> Option<EpisodeWear> {
        let instant = contact.end == Some(contact.start);
        let jump = self.jumps.iter().position(|(index, _)| *index == contact.wall).filter(|_| instant);
        if let Some(at) = jump {
            return Some(self.jumps.swap_remove(at).1);
        }
        let worn = self.open.get_mut(contact.wall)?.take()?;
        Some(EpisodeWear { sliding: if instant { 0.0 } else { worn.sliding }, ..worn })
    }
}
