//! The linear system of the contacts of a step whose states are known.

use super::contact_rows::ContactRows;
use super::friction_contact::{FrictionContact, State};
use crate::qp::solve_dependent;

/// Most states that are tried after one another between sweeps.
const MOST_GUESSES: u32 = 8;

/// The linear system of contacts whose states are known.
#[derive(Debug, Default)]
pub(super) struct Linear {
    /// The unknowns: contact, and whether the unknown is f rather than p; and the factor that
    /// scales each, 1/√(its own response). Where rows of contacts depend on one another, impulses
    /// stay as they were, and the result is accepted only if it meets all bounds.
    unknowns: Vec<(usize, bool)>,
    scale: Vec<f64>,
    /// The matrix, row by row, with the right-hand side as its last column, and the order of the
    /// columns.
    matrix: Vec<f64>,
    order: Vec<usize>,
    kept: Vec<(State, [f64; 2])>,
}

impl Linear {
    pub fn with_capacity(unknowns: usize) -> Self {
        Self {
            unknowns: Vec::with_capacity(unknowns),
            scale: Vec::with_capacity(unknowns),
            matrix: Vec::with_capacity(unknowns * (unknowns + 1)),
            order: Vec::with_capacity(unknowns),
            kept: Vec::with_capacity(unknowns),
        }
    }

    /// Solves for the impulses of contacts in the states that they have. If the result does not
    /// confirm these states within `noise` (m/s), tries the states that it suggests, some times; if
    /// none is confirmed, all stays as it is.
    pub fn settle(
        &mut self,
        places: &ContactRows,
        touches: &mut [FrictionContact],
        (free, y): (&[f64], &mut [f64]),
        noise: f64,
    ) -> bool {
        self.kept.clear();
        self.kept.extend(touches.iter().map(|touch| (touch.state, touch.impulse)));
        for _ in 0..MOST_GUESSES {
            self.solve(places, touches, (free, y));
            if touches.iter().all(|touch| touch.holds(y, noise)) {
                touches.iter_mut().for_each(FrictionContact::drop_rounding);
                return true;
            }
            let mut changed = false;
            for touch in touches.iter_mut() {
                let state = touch.guess(y);
                changed |= state != touch.state;
                touch.state = state;
                touch.comply();
            }
            if !changed {
                break;
            }
        }
        for (touch, kept) in touches.iter_mut().zip(&self.kept) {
            (touch.state, touch.impulse) = *kept;
        }
        renew(places, touches, free, y);
        false
    }

    /// Solves for the impulses of contacts in the states that they have.
    pub fn solve(&mut self, places: &ContactRows, touches: &mut [FrictionContact], (free, y): (&[f64], &mut [f64])) {
        renew(places, touches, free, y);
        self.set(places, touches, y);
        solve_dependent(&mut self.matrix, &mut self.order);
        let m = self.unknowns.len();
        for (k, &(index, rubs)) in self.unknowns.iter().enumerate() {
            let change = self.matrix[k * (m + 1) + m] * self.scale[k];
            touches[index].impulse[usize::from(rubs)] += change;
        }
        touches.iter_mut().for_each(FrictionContact::comply);
        renew(places, touches, free, y);
    }

    /// Sets up the system for the changes of the impulses: one row for n·ẇ⁺ − κp = β of each
    /// contact that is not open, one for t·ẇ⁺ = 0 of each that sticks.
    fn set(&mut self, places: &ContactRows, touches: &[FrictionContact], y: &[f64]) {
        self.unknowns.clear();
        self.scale.clear();
        for (index, touch) in touches.iter().enumerate().filter(|(_, touch)| touch.state != State::Open) {
            self.unknowns.push((index, false));
            self.scale.push(1.0 / touch.yielding().sqrt());
            if touch.state == State::Stick {
                self.unknowns.push((index, true));
                self.scale.push(1.0 / touch.own[2].sqrt());
            }
        }
        self.matrix.clear();
        for (&(to, rubbed), scale) in self.unknowns.iter().zip(&self.scale) {
            let touch = &touches[to];
            // The direction of the velocity, so that the diagonal is positive.
            let along = if rubbed { touch.tangent } else { touch.normal.map(|n| -n) };
            for (&(from, rubs), other) in self.unknowns.iter().zip(&self.scale) {
                let source = &touches[from];
                let push = if rubs { [0.0, 1.0] } else { [1.0, -source.state.sign() * source.friction] };
                let mut entry = places.between((touch.rows, along), (source.rows, source.push(push)));
                if from == to && !rubs && !rubbed {
                    entry += touch.compliance;
                }
                self.matrix.push(entry * scale * other);
            }
            let [n, t] = touch.excess(y);
            self.matrix.push(scale * if rubbed { -t } else { n });
        }
    }
}

/// Computes the velocities of all rows anew from those without contacts.
pub(super) fn renew(places: &ContactRows, touches: &[FrictionContact], free: &[f64], y: &mut [f64]) {
    y.copy_from_slice(free);
    for touch in touches {
        places.add(touch.rows, touch.push(touch.impulse), y);
    }
}
