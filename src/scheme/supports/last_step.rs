//! What a step of a scene with supports leaves to the next one.

use super::friction_contact::{FrictionContact, State};
use super::normal::dot;
use crate::scene::Scene;

/// Normals of flats at one place that are opposite to rounding.
const OPPOSITE: f64 = -1.0 + 1e-9;

/// What the last step left, and what is counted from step to step.
#[derive(Debug)]
pub(super) struct LastStep {
    /// True for each wall that is round.
    round: Vec<bool>,
    /// True for each flat that leaves no room to move.
    snug: Vec<bool>,
    /// The push p of each wall and hole, N s.
    pub pushes: Vec<f64>,
    /// The largest angle by which the normal of each hole turned in a step since its contact began,
    /// rad; 0 if it did not push.
    pub turns: Vec<f64>,
    /// What each wall and hole did; one that did not push was open.
    pub did: Vec<State>,
    /// Normal of the last contact that pushed at each row's place, if any.
    last: Vec<Option<[f64; 2]>>,
    /// Steps in which a body stood still between opposite sides.
    pub frozen: u64,
    /// The largest angle by which a normal turned in a step, rad.
    pub turned: f64,
}

impl LastStep {
    /// For walls of which some are `round` and some `snug`, on `rows` rows.
    pub fn new(round: Vec<bool>, snug: Vec<bool>, rows: usize) -> Self {
        Self {
            snug,
            pushes: vec![0.0; round.len()],
            turns: vec![0.0; round.len()],
            did: vec![State::Open; round.len()],
            round,
            last: vec![None; rows],
            frozen: 0,
            turned: 0.0,
        }
    }

    /// Begins at the displacement `q` (m) and the velocity `v` (m/s).
    pub fn begin(&mut self, scene: &Scene, q: &[f64], v: &[f64]) {
        self.forget();
        for (index, did) in self.did.iter_mut().enumerate() {
            if scene.stands_on(index, q, v) {
                *did = State::Stick;
            }
        }
    }

    /// Forgets the last step.
    pub fn forget(&mut self) {
        self.last.fill(None);
        self.pushes.fill(0.0);
        self.turns.fill(0.0);
        self.did.fill(State::Open);
    }

    /// Keeps what the next step needs of the contacts in play, and counts; `turned` gives the
    /// largest angle by which the normal of each turned in a step since its contact began, rad.
    pub fn keep(&mut self, touches: &[FrictionContact], turned: impl Fn(usize) -> f64) {
        let mut frozen = false;
        for touch in touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            if let Some(last) = self.last[touch.rows[0]] {
                frozen |= dot(last, touch.normal) < if self.round[touch.index] { 0.0 } else { OPPOSITE };
            }
            self.turned = self.turned.max(turned(touch.index));
        }
        self.frozen += u64::from(frozen);
        self.forget();
        for touch in touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            self.pushes[touch.index] = touch.impulse[0];
            self.turns[touch.index] = turned(touch.index);
            self.did[touch.index] = touch.state;
            if touch.compliance == 0.0 && !self.snug[touch.index] {
                self.last[touch.rows[0]] = Some(touch.normal);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contacts 0 and 1 are walls, 2 and 3 holes, each on rows of its own.
    fn touch(index: usize, degrees: f64, impulse: [f64; 2]) -> FrictionContact {
        let normal = [degrees.to_radians().cos(), degrees.to_radians().sin()];
        FrictionContact {
            index,
            rows: [2 * index, 2 * index + 1],
            normal,
            tangent: [-normal[1], normal[0]],
            bound: 0.0,
            friction: 0.3,
            compliance: 0.0,
            kinetic: 0.3,
            holding: 0.3,
            came: 0.0,
            own: [1.0, 0.0, 1.0],
            state: State::Ahead,
            impulse,
            slides: 0.0,
        }
    }

    fn memory() -> LastStep {
        LastStep::new(vec![false, false, true, true], vec![false; 4], 8)
    }

    #[test]
    fn a_body_is_frozen_between_opposite_flats_or_sides_of_a_hole_that_push_one_after_the_other() {
        // A flat that pushes after another one of its place: frozen if they are opposite. In a hole
        // it is enough that the normals are more than a right angle apart.
        for (index, degrees, frozen) in
            [(0, 180.0, 1), (0, 179.0, 0), (1, -180.0, 1), (2, 180.0, 1), (2, 91.0, 1), (2, 89.0, 0), (3, -120.0, 1)]
        {
            let mut memory = memory();
            memory.keep(&[touch(index, 0.0, [1.0, 0.0])], |_| 0.0);
            assert_eq!(memory.frozen, 0);
            memory.keep(&[touch(index, degrees, [1.0, 0.0])], |_| 0.0);
            assert_eq!(memory.frozen, frozen, "{index}, {degrees}");
            // Only the last step counts, not the one before, nor a place of another contact.
            memory.keep(&[touch((index + 1) % 4, degrees + 180.0, [1.0, 0.0])], |_| 0.0);
            memory.keep(&[touch(index, 0.0, [1.0, 0.0])], |_| 0.0);
            assert_eq!(memory.frozen, frozen, "{index}, {degrees}");
        }
    }

    #[test]
    fn what_does_not_push_or_yields_freezes_nothing() {
        let open = touch(0, 0.0, [0.0; 2]);
        let elastic = FrictionContact { compliance: 0.1, ..touch(0, 0.0, [1.0, 0.0]) };
        let opposite = touch(0, 180.0, [1.0, 0.0]);
        for (first, second) in [(open, opposite), (elastic, opposite), (opposite, open)] {
            let mut memory = memory();
            memory.keep(&[first], |_| 0.0);
            memory.keep(&[second], |_| 0.0);
            assert_eq!(memory.frozen, 0, "{first:?}, {second:?}");
        }
        let mut memory = memory();
        memory.keep(&[touch(0, 0.0, [1.0, 0.0]), touch(2, 0.0, [1.0, 0.0])], |_| 0.0);
        memory.forget();
        memory.keep(&[opposite, touch(2, 180.0, [1.0, 0.0])], |_| 0.0);
        assert_eq!(memory.frozen, 0);
        // Two of them in a step freeze it once.
        memory.keep(&[touch(0, 0.0, [1.0, 0.0]), touch(2, 0.0, [1.0, 0.0])], |_| 0.0);
        assert_eq!(memory.frozen, 1);
    }

    #[test]
    fn the_pushes_of_a_step_are_kept_for_the_next_one_only() {
        let mut memory = memory();
        memory.keep(&[touch(1, 0.0, [2.0, -0.5]), touch(3, 0.0, [3.0, 0.7]), touch(2, 0.0, [0.0; 2])], |_| 0.0);
        assert_eq!(memory.pushes, [0.0, 2.0, 0.0, 3.0]);
        assert_eq!(memory.did, [State::Open, State::Ahead, State::Open, State::Ahead]);
        memory.keep(&[touch(0, 0.0, [1.0, 0.0])], |_| 0.0);
        assert_eq!(memory.pushes, [1.0, 0.0, 0.0, 0.0]);
        memory.forget();
        assert_eq!((&memory.pushes, &memory.did), (&vec![0.0; 4], &vec![State::Open; 4]));
    }

    #[test]
    fn the_largest_turn_is_that_of_a_hole_that_pushes() {
        let mut memory = memory();
        memory.keep(&[touch(2, 0.0, [0.0; 2])], |_| 0.6);
        assert!(memory.turned == 0.0);
        for (turns, largest) in [([0.1, 0.9], 0.1), ([0.3, 0.9], 0.3), ([0.2, 0.9], 0.3)] {
            memory.keep(&[touch(2, 0.0, [1.0, 0.0])], |index| turns[index - 2]);
            assert!(memory.turned == largest, "{turns:?}: {}", memory.turned);
        }
    }
}
