//! What a step of a scene with supports leaves to the next one.

use super::normal::dot;
use super::touch::Touch;

/// Normals of flats at one place that are opposite to rounding.
const OPPOSITE: f64 = -1.0 + 1e-9;

/// What the last step left, and what is counted from step to step.
#[derive(Debug)]
pub(super) struct Memory {
    /// Number of walls.
    walls: usize,
    /// Impulses p and f of each wall and hole, N s, from which the next step starts.
    pub warm: Vec<[f64; 2]>,
    /// Normal of the last contact that pushed at each row's place, if any.
    last: Vec<Option<[f64; 2]>>,
    /// Steps in which a body stood still between opposite sides.
    pub frozen: u64,
    /// The largest angle by which a normal turned in a step, rad.
    pub turned: f64,
}

impl Memory {
    /// For `walls` walls among `contacts` contacts on `rows` rows.
    pub fn new(walls: usize, contacts: usize, rows: usize) -> Self {
        Self { walls, warm: vec![[0.0; 2]; contacts], last: vec![None; rows], frozen: 0, turned: 0.0 }
    }

    /// Forgets the last step.
    pub fn forget(&mut self) {
        self.last.fill(None);
        self.warm.fill([0.0; 2]);
    }

    /// Keeps what the next step needs of the contacts in play, and counts; `turns` are the angles
    /// by which the normals of holes turned, rad.
    pub fn keep(&mut self, touches: &[Touch], turns: &[f64]) {
        let mut frozen = false;
        for touch in touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            if let Some(last) = self.last[touch.rows[0]] {
                frozen |= dot(last, touch.normal) < if touch.index < self.walls { OPPOSITE } else { 0.0 };
            }
            if let Some(hole) = touch.index.checked_sub(self.walls) {
                self.turned = self.turned.max(turns[hole]);
            }
        }
        self.frozen += u64::from(frozen);
        self.forget();
        for touch in touches.iter().filter(|touch| touch.impulse[0] > 0.0) {
            self.warm[touch.index] = touch.impulse;
            if touch.compliance == 0.0 {
                self.last[touch.rows[0]] = Some(touch.normal);
            }
        }
    }
}
