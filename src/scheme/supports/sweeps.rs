//! All contacts of a step together: sweeps of Gauss and Seidel over the contacts, each answered
//! exactly ([`Touch::answer`]), until their states stay; then one linear system for these states,
//! so that the result is exact to rounding.
//!
//! Sweeps start from the impulses of the last step (Jourdan, Alart & Jean 1998,
//! doi:10.1016/S0045-7825(97)00137-0). Where the linear system does not confirm the states, those
//! that it suggests are tried before the sweeps go on, as in a semismooth Newton method. Where
//! contacts without friction still do not settle, as where several press on few degrees of freedom
//! from nearly opposite sides, the pivoting of [`crate::qp`] answers them.
//!
//! Without friction the problem is a convex programme, the sweeps descend in its dual and the
//! answer is its minimiser. With friction it is no minimisation: for large μ answers may be several,
//! and sweeps may not settle; such steps are counted.

use super::normal::dot;
use super::places::Places;
use super::touch::{State, Touch};
use crate::linear::{Rows, Symmetric};
use crate::qp::{Backend, Problem, Rhs, Solver};
use crate::scene::Row;

/// Most sweeps in a step.
const MOST_SWEEPS: u32 = 3000;

/// From this sweep on each makes half of the change only, since states that alternate may settle
/// so; contacts without friction are left to pivoting there.
const LONG: u32 = 200;

/// Most states that are tried after one another between sweeps.
const MOST_GUESSES: u32 = 8;

/// Sweeps that change no velocity by more than this share of the largest are done.
const STILL: f64 = 4.0 * f64::EPSILON;

/// Rounding of velocities, relative to the largest: a state is accepted within this.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The most by which changes of velocity may exceed the velocities.
const WEDGED: f64 = 1e5;

/// A pivot below this share of the diagonal, which is scaled to 1, belongs to contacts whose rows
/// depend on those before: their impulses stay as the sweeps left them, and the result is accepted
/// only if it meets their bounds too.
const DEPENDENT: f64 = 1e-11;

/// The contacts of a step.
#[derive(Debug)]
pub(super) struct Sweeps {
    pub touches: Vec<Touch>,
    /// Velocity of each row at the step's end without contacts, m/s, and with them.
    pub free: Vec<f64>,
    y: Vec<f64>,
    /// Impulse on each row, N s.
    pub impulse: Vec<f64>,
    states: Vec<State>,
    linear: Linear,
    /// A, and the rows of all places.
    problem: (Symmetric, Rows),
    /// Steps that met something, and those whose states did not settle.
    pub solves: u64,
    pub unsettled: u64,
}

impl Sweeps {
    /// For the matrix `a` of the step, these rows, and at most this number of contacts.
    pub fn new(a: Symmetric, rows: &[&Row], contacts: usize) -> Self {
        let places = Rows::new(a.size(), rows.iter().map(|row| row.entries()));
        let rows = rows.len();
        Self {
            problem: (a, places),
            touches: Vec::with_capacity(contacts),
            free: vec![0.0; rows],
            y: vec![0.0; rows],
            impulse: vec![0.0; rows],
            states: Vec::with_capacity(contacts),
            linear: Linear::with_capacity(2 * contacts),
            solves: 0,
            unsettled: 0,
        }
    }

    /// Solves for the impulses of all contacts, from the velocities `free`. Returns whether one
    /// pushes.
    pub fn solve(&mut self, places: &Places) -> bool {
        let Self { touches, free, y, impulse, .. } = self;
        impulse.fill(0.0);
        y.copy_from_slice(free);
        let clear = |touch: &Touch| dot(touch.normal, touch.rows.map(|row| y[row])) <= touch.bound;
        if touches.iter().all(clear) {
            for touch in touches {
                (touch.state, touch.impulse) = (State::Open, [0.0; 2]);
            }
            return false;
        }
        self.solves += 1;
        for touch in touches.iter() {
            places.add(touch.rows, touch.push(touch.impulse), y);
        }
        let settled = match &mut touches[..] {
            [touch] => touch.answer(places, y, 1.0).1,
            _ => self.sweep(places) || self.pivot().is_some(),
        };
        self.unsettled += u64::from(!settled);
        for touch in &self.touches {
            for (row, push) in touch.rows.into_iter().zip(touch.push(touch.impulse)) {
                self.impulse[row] += push;
            }
        }
        true
    }

    /// Sweeps until the states stay and the linear system of these states confirms them. Returns
    /// whether that happened.
    fn sweep(&mut self, places: &Places) -> bool {
        let Self { touches, free, y, states, linear, .. } = self;
        let size = |y: &[f64]| y.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
        let bounds = touches.iter().fold(0.0_f64, |most, touch| most.max(touch.bound.abs()));
        let largest = size(free).max(bounds);
        let mut due = 2;
        let most_sweeps = if touches.iter().any(|touch| touch.friction > 0.0) { MOST_SWEEPS } else { LONG };
        for sweep in 1..=most_sweeps {
            let share = if sweep <= LONG { 1.0 } else { 0.5 };
            let (mut moved, mut answered) = (0.0_f64, true);
            for touch in touches.iter_mut() {
                let (by, found) = touch.answer(places, y, share);
                moved = moved.max(by);
                answered &= found;
            }
            let same =
                states.len() == touches.len() && states.iter().zip(&*touches).all(|(old, new)| *old == new.state);
            let still = moved <= STILL * most(largest, touches);
            if answered && (still || (same && sweep >= due)) {
                // The states of a problem that converges slowly may stay for long and yet be wrong.
                due = 2 * sweep;
                let noise = ROUNDING * most(largest, touches);
                if linear.settle(places, touches, (free, y), noise) || still {
                    return true;
                }
            }
            states.clear();
            states.extend(touches.iter().map(|touch| touch.state));
        }
        false
    }
}

impl Sweeps {
    /// Solves for the impulses of contacts without friction as a quadratic programme in the change
    /// of velocity that they cause; `None` where a contact has friction, or the programme fails. So
    /// rare that it may allocate.
    #[cold]
    fn pivot(&mut self) -> Option<()> {
        let Self { touches, free, .. } = self;
        if touches.iter().any(|touch| touch.friction > 0.0) {
            return None;
        }
        let (a, places) = &self.problem;
        let part = |row: usize, share: f64| places.row(row).iter().map(move |&(i, x)| (i, share * x));
        let turned = |touch: &Touch| -> Vec<(usize, f64)> {
            let ([first, second], [y, z]) = (touch.rows, touch.normal);
            part(first, y).chain(part(second, z)).collect()
        };
        let rows: Vec<Vec<(usize, f64)>> = touches.iter().map(turned).collect();
        let slack = |touch: &Touch| touch.bound - dot(touch.normal, touch.rows.map(|row| free[row]));
        let hi: Vec<f64> = touches.iter().map(slack).collect();
        let scale = hi.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let g = Rows::new(a.size(), rows.iter().map(Vec::as_slice));
        let compliance = touches.iter().map(|touch| touch.compliance).collect();
        let mut solver = Solver::new(Problem { a: a.clone(), g, compliance }, Backend::Auto, scale).ok()?;
        let (b, lo) = (vec![0.0; a.size()], vec![f64::NEG_INFINITY; hi.len()]);
        let solution = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).ok()?;
        for (touch, r) in touches.iter_mut().zip(&solution.multiplier) {
            touch.impulse = [(-r).max(0.0), 0.0];
            touch.state = if touch.impulse[0] > 0.0 { State::Ahead } else { State::Open };
        }
        Some(())
    }
}

/// The linear system of contacts whose states are known.
#[derive(Debug, Default)]
struct Linear {
    /// The unknowns: contact, and whether the unknown is f rather than p; and the factor that
    /// scales each, 1/√(its own response).
    unknowns: Vec<(usize, bool)>,
    scale: Vec<f64>,
    /// The matrix, row by row, with the right-hand side as its last column, and the order of the
    /// columns.
    matrix: Vec<f64>,
    order: Vec<usize>,
    kept: Vec<(State, [f64; 2])>,
}

impl Linear {
    fn with_capacity(unknowns: usize) -> Self {
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
    fn settle(&mut self, places: &Places, touches: &mut [Touch], (free, y): (&[f64], &mut [f64]), noise: f64) -> bool {
        self.kept.clear();
        self.kept.extend(touches.iter().map(|touch| (touch.state, touch.impulse)));
        for _ in 0..MOST_GUESSES {
            self.solve(places, touches, (free, y));
            if touches.iter().all(|touch| touch.holds(y, noise)) {
                // A force of −1e-20 N is none.
                for touch in touches.iter_mut().filter(|touch| touch.impulse[0] < 0.0) {
                    touch.impulse = [0.0; 2];
                }
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
    fn solve(&mut self, places: &Places, touches: &mut [Touch], (free, y): (&[f64], &mut [f64])) {
        renew(places, touches, free, y);
        self.set(places, touches, y);
        self.eliminate();
        let m = self.unknowns.len();
        for (k, &(index, rubs)) in self.unknowns.iter().enumerate() {
            let change = self.matrix[k * (m + 1) + m] * self.scale[k];
            touches[index].impulse[usize::from(rubs)] += change;
        }
        touches.iter_mut().for_each(Touch::comply);
        renew(places, touches, free, y);
    }

    /// Sets up the system for the changes of the impulses: one row for n·ẇ⁺ − κp = β of each
    /// contact that is not open, one for t·ẇ⁺ = 0 of each that sticks.
    fn set(&mut self, places: &Places, touches: &[Touch], y: &[f64]) {
        self.unknowns.clear();
        self.scale.clear();
        for (index, touch) in touches.iter().enumerate().filter(|(_, touch)| touch.state != State::Open) {
            self.unknowns.push((index, false));
            self.scale.push(1.0 / touch.own[0].sqrt());
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

    /// Solves the system by elimination with complete pivoting; the solution replaces the
    /// right-hand side. Unknowns left over at pivots that are rounding do not change.
    fn eliminate(&mut self) {
        let m = self.unknowns.len();
        let width = m + 1;
        let a = &mut self.matrix;
        self.order.clear();
        self.order.extend(0..m);
        let mut rank = 0;
        while rank < m {
            let mut best = (0.0, rank, rank);
            for row in rank..m {
                for column in rank..m {
                    let size = a[row * width + column].abs();
                    if size > best.0 {
                        best = (size, row, column);
                    }
                }
            }
            let (size, row, column) = best;
            if size <= DEPENDENT {
                break;
            }
            for k in 0..width {
                a.swap(rank * width + k, row * width + k);
            }
            for k in 0..m {
                a.swap(k * width + rank, k * width + column);
            }
            self.order.swap(rank, column);
            let pivot = a[rank * width + rank];
            for row in rank + 1..m {
                let factor = a[row * width + rank] / pivot;
                if factor != 0.0 {
                    for k in rank..width {
                        a[row * width + k] -= factor * a[rank * width + k];
                    }
                }
            }
            rank += 1;
        }
        // Back substitution; the solution in the order of the columns, in the diagonal.
        for k in (0..m).rev() {
            let mut x = 0.0;
            if k < rank {
                x = a[k * width + m];
                for j in k + 1..rank {
                    x -= a[k * width + j] * a[j * width + j];
                }
                x /= a[k * width + k];
            }
            a[k * width + k] = x;
        }
        for (k, &place) in self.order.iter().enumerate() {
            a[place * width + m] = a[k * width + k];
        }
    }
}

/// The largest of `rate` and the changes of velocity that the contacts make, m/s: contacts that
/// press against each other make larger ones than what remains of them. At most [`WEDGED`] times
/// `rate`: impulses that grow from sweep to sweep, as of a body that wedges itself, would have any
/// velocity count as rounding.
fn most(rate: f64, touches: &[Touch]) -> f64 {
    let largest = touches.iter().fold(rate, |most, touch| {
        let ([a, _, c], [p, f]) = (touch.own, touch.impulse);
        most.max(a * p.abs()).max(c * f.abs())
    });
    largest.min(WEDGED * rate)
}

/// Computes the velocities of all rows anew from those without contacts.
fn renew(places: &Places, touches: &[Touch], free: &[f64], y: &mut [f64]) {
    y.copy_from_slice(free);
    for touch in touches {
        places.add(touch.rows, touch.push(touch.impulse), y);
    }
}
