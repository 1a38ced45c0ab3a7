//! All contacts of a step together: sweeps of Gauss and Seidel over the contacts, each answered
//! exactly ([`FrictionContact::answer`]), until their states stay; then one linear system for these
//! states, so that the result is exact to rounding.
//!
//! Sweeps (Jourdan, Alart & Jean 1998, doi:10.1016/S0045-7825(97)00137-0) start without impulses:
//! contacts that stick and press against each other, as those on both sides of a wedge, may hold
//! any self-stress, and what they held in the last step, which may have been an impact, is no force
//! of this one. (Within one step `located` goes on from the impulses of other normals.) Where the
//! linear system does not confirm the states, those that it suggests are tried before the sweeps go
//! on, as in a semismooth Newton method. Where the contacts still do not settle, as where several
//! press on few degrees of freedom from nearly opposite sides, a pivoting method answers them.
//!
//! Without friction the problem is a convex programme, the sweeps descend in its dual and the
//! answer is its minimiser. With friction it is no minimisation: for large μ answers may be
//! several, or, where rebounds are demanded of a body that is wedged between its contacts, none.
//! Then those contacts give up their rebound ([`Coulomb`]), as do those whose impulses would add
//! energy ([`FrictionContacts::strike`]).

use super::contact_rows::ContactRows;
use super::corner;
use super::friction_contact::{FrictionContact, ROUNDING, State};
use super::linear::{Linear, renew};
use super::normal::dot;
use crate::linear::{Rows, Symmetric};
use crate::qp::{Backend, Coulomb, CoulombContact, Problem, Rhs, Solver};
use crate::scene::Row;

/// Most sweeps in a step, without and with friction, before a pivoting method takes over.
const MOST_SWEEPS: [u32; 2] = [200, 30];

/// Sweeps that change no velocity by more than this share of the largest are done.
const STILL: f64 = 4.0 * f64::EPSILON;

/// A gain of energy below this share of what the impulses alone would give is none.
const GAIN: f64 = 1e-9;

/// The most by which changes of velocity may exceed the velocities.
const WEDGED: f64 = 1e5;

/// The contacts of a step.
#[derive(Debug)]
pub(in crate::scheme) struct FrictionContacts {
    pub touches: Vec<FrictionContact>,
    /// Velocity of each row before the impacts of the step, m/s; at its end without contacts, and
    /// with them.
    pub before: Vec<f64>,
    pub free: Vec<f64>,
    y: Vec<f64>,
    /// Impulse on each row, N s.
    pub impulse: Vec<f64>,
    states: Vec<State>,
    linear: Linear,
    /// A, and the rows of all places.
    problem: (Symmetric, Rows),
    /// Contacts that gave up their rebound in the step.
    pub wedged: Vec<usize>,
    /// Problems that met something, those in which contacts gave up their rebound, and those
    /// without an answer.
    pub solves: u64,
    pub gave_up: u64,
    pub unsettled: u64,
}

impl FrictionContacts {
    /// For the matrix `a` of the step, these rows, and at most this number of contacts.
    pub fn new(a: Symmetric, rows: &[&Row], contacts: usize) -> Self {
        let places = Rows::new(a.size(), rows.iter().map(|row| row.entries()));
        let rows = rows.len();
        Self {
            problem: (a, places),
            touches: Vec::with_capacity(contacts),
            before: vec![0.0; rows],
            free: vec![0.0; rows],
            y: vec![0.0; rows],
            impulse: vec![0.0; rows],
            states: Vec::with_capacity(contacts),
            linear: Linear::with_capacity(2 * contacts),
            wedged: Vec::new(),
            solves: 0,
            gave_up: 0,
            unsettled: 0,
        }
    }

    /// Takes another matrix.
    pub fn renew(&mut self, a: &Symmetric) {
        self.problem.0.clone_from(a);
    }

    /// Solves for the impulses of all contacts, from the velocities `free`. Where the answer has
    /// another coefficient of friction, it is solved again with that, at most twice for each
    /// contact. Returns whether one pushes.
    pub fn solve(&mut self, places: &ContactRows) -> bool {
        loop {
            let pushes = self.solve_once(places);
            let Self { touches, free, y, .. } = self;
            if !pushes || touches.iter().all(|touch| touch.holding == touch.kinetic) {
                return pushes;
            }
            let noise = ROUNDING * most(largest_of(free), touches);
            let changes = |any, touch: &mut FrictionContact| touch.changes_friction(y, noise) | any;
            if !touches.iter_mut().fold(false, changes) {
                return true;
            }
        }
    }

    /// The velocities of two rows under the impulses that were found, m/s.
    pub fn rate(&self, rows: [usize; 2]) -> [f64; 2] {
        rows.map(|row| self.y[row])
    }

    fn solve_once(&mut self, places: &ContactRows) -> bool {
        let Self { touches, free, y, impulse, .. } = self;
        impulse.fill(0.0);
        y.copy_from_slice(free);
        let clear = |touch: &FrictionContact| dot(touch.normal, touch.rows.map(|row| y[row])) <= touch.bound;
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
            [touch] => touch.answer(places, y).1,
            _ => self.sweep(places),
        };
        let settled = settled || {
            let found = self.pivot().is_some() || self.complement(places).is_some();
            self.recognise(places);
            found
        };
        self.unsettled += u64::from(!settled);
        for touch in &self.touches {
            for (row, push) in touch.rows.into_iter().zip(touch.push(touch.impulse)) {
                self.impulse[row] += push;
            }
        }
        true
    }

    /// As [`FrictionContacts::solve`] for impacts of a body with the velocities `before`: where the
    /// impulses would add energy, the contacts give up their rebound, and it is solved again. What
    /// impulses P add to ½ẇ·A ẇ is P·ẇ⁺ − ½ P·W P, of which P·ẇ⁺ ≤ 0 without rebounds.
    pub fn strike(&mut self, places: &ContactRows) -> bool {
        let pushes = self.solve(places);
        if pushes && self.gains(places) {
            let gave_up = self.wedged.len();
            for touch in self.touches.iter_mut().filter(|touch| touch.rebounds()) {
                touch.bound = 0.0;
                self.wedged.push(touch.index);
            }
            self.gave_up += u64::from(gave_up == 0);
            self.solve(places);
        }
        pushes
    }

    /// Gives the contacts of each corner in which the body is stopped the impulses of the least sum
    /// of pushes that stop it ([`corner`]).
    pub fn relieve(&mut self, places: &ContactRows) {
        let Self { touches, free, y, .. } = self;
        if touches.len() < 2 {
            return;
        }
        renew(places, touches, free, y);
        corner::relieve(touches, y);
    }

    /// True if the impulses of rigid contacts, some of which rebound and some rub, add energy: to
    /// the velocities before the step as well as to those that it gives without them; or if
    /// friction adds more in a corner than the impulses take in all.
    fn gains(&mut self, places: &ContactRows) -> bool {
        let Self { touches, before, free, y, .. } = self;
        let pushing = |touch: &&FrictionContact| touch.impulse[0] > 0.0;
        if !touches.iter().filter(pushing).any(FrictionContact::rebounds)
            || touches.iter().all(|touch| touch.impulse[1] == 0.0)
        {
            return false;
        }
        let work = |rates: &[f64]| -> f64 {
            let of = |touch: &FrictionContact| dot(touch.push(touch.impulse), touch.rows.map(|row| rates[row]));
            touches.iter().filter(|touch| touch.compliance == 0.0).map(of).sum()
        };
        let push = |rigid: bool, y: &mut [f64]| {
            for touch in touches.iter().filter(|touch| (touch.compliance == 0.0) == rigid) {
                places.add(touch.rows, touch.push(touch.impulse), y);
            }
        };
        y.fill(0.0);
        push(true, y);
        let own = 0.5 * work(y);
        // What friction may add in a corner: no more than the impact takes in all.
        let most = |rates: &[f64]| (GAIN * own).max(-(work(rates) + own));
        if touches.len() > 1 && [&*before, free].iter().all(|rates| corner::gains(touches, (rates, y), most(rates))) {
            return true;
        }
        y.copy_from_slice(free);
        push(false, y);
        work(before).min(work(y)) + own > GAIN * own
    }

    /// Sweeps until the states stay and the linear system of these states confirms them. Returns
    /// whether that happened.
    fn sweep(&mut self, places: &ContactRows) -> bool {
        let Self { touches, free, y, states, linear, .. } = self;
        let rigid = touches.iter().filter(|touch| touch.compliance == 0.0);
        let bounds = rigid.fold(0.0_f64, |most, touch| most.max(touch.bound.abs()));
        let largest = largest_of(free).max(bounds);
        let mut due = 2;
        let most_sweeps = MOST_SWEEPS[usize::from(touches.iter().any(|touch| touch.friction > 0.0))];
        for sweep in 1..=most_sweeps {
            let (mut moved, mut answered) = (0.0_f64, true);
            for touch in touches.iter_mut() {
                let (by, found) = touch.answer(places, y);
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

impl FrictionContacts {
    /// Finds the states of the contacts from their impulses.
    #[cold]
    fn recognise(&mut self, places: &ContactRows) {
        let Self { touches, free, y, .. } = self;
        renew(places, touches, free, y);
        let noise = ROUNDING * most(largest_of(free), touches);
        touches.iter_mut().for_each(|touch| touch.recognise(y, noise));
    }

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
        let turned = |touch: &FrictionContact| places.combination(touch.rows.into_iter().zip(touch.normal));
        let rows: Vec<Vec<(usize, f64)>> = touches.iter().map(turned).collect();
        let slack = |touch: &FrictionContact| touch.bound - dot(touch.normal, touch.rows.map(|row| free[row]));
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

    /// Solves for the impulses of all contacts as a complementarity problem; `None` where rounding
    /// leaves no answer. So rare that it may allocate.
    #[cold]
    fn complement(&mut self, places: &ContactRows) -> Option<()> {
        let Self { touches, free, wedged, .. } = self;
        // An elastic wall over a short part hardly yields to an impulse: in a unit of the rate
        // along its normal in which its own response is that without compliance, the rates of all
        // contacts are comparable.
        let unit = |touch: &FrictionContact| touch.own[0] / touch.yielding();
        let contact = |touch: &FrictionContact| {
            let [beyond, along] = FrictionContact { impulse: [0.0; 2], ..*touch }.excess(free);
            let rebound = if touch.compliance == 0.0 { (-touch.bound).max(0.0) } else { 0.0 };
            CoulombContact { free: [-unit(touch) * beyond, along], friction: touch.friction, rebound }
        };
        let directions: Vec<_> = touches
            .iter()
            .flat_map(|touch| [touch.push([1.0, 0.0]), touch.push([0.0, 1.0])].map(|along| (touch.rows, along)))
            .collect();
        let mut responses = Vec::with_capacity(directions.len() * directions.len());
        for (k, &to) in directions.iter().enumerate() {
            let (touch, first) = (&touches[k / 2], responses.len());
            responses.extend(directions.iter().map(|&from| places.between(to, from)));
            if k % 2 == 0 {
                responses[first + k] += touch.compliance;
                responses[first..].iter_mut().for_each(|response| *response *= unit(touch));
            }
        }
        let contacts = touches.iter().map(contact).collect();
        let rounding = ROUNDING * largest_of(free);
        let (impulses, gave_up) = Coulomb::new(contacts, responses, rounding).solve()?;
        for (touch, impulse) in touches.iter_mut().zip(impulses) {
            touch.impulse = impulse;
        }
        for &index in &gave_up {
            touches[index].bound = 0.0;
        }
        wedged.extend(gave_up.iter().map(|&index| touches[index].index));
        self.gave_up += u64::from(!gave_up.is_empty());
        Some(())
    }
}

/// The largest of these velocities, m/s.
fn largest_of(y: &[f64]) -> f64 {
    y.iter().fold(0.0_f64, |most, y| most.max(y.abs()))
}

/// The largest of `rate` and the changes of velocity that the contacts make, m/s: contacts that
/// press against each other make larger ones than what remains of them. At most [`WEDGED`] times
/// `rate`: impulses that grow from sweep to sweep, as of a body that wedges itself, would have any
/// velocity count as rounding.
fn most(rate: f64, touches: &[FrictionContact]) -> f64 {
    let largest = touches.iter().fold(rate, |most, touch| {
        let ([a, _, c], [p, f]) = (touch.own, touch.impulse);
        most.max(a * p.abs()).max(c * f.abs())
    });
    largest.min(WEDGED * rate)
}

#[cfg(test)]
mod tests;
