//! The motion over a part of a step under contacts in two planes, whose normals depend on it
//! ([`PlaneBound`]).
//!
//! With normals that are given, the impulses are those of a problem of contacts with friction. The
//! angle φ of each normal is a root of its residual r(φ), the angle between the normal of the path
//! found with φ and φ itself. Repetition, φ + r, is the first step; then each contact takes the
//! secant through its last two residuals. Most parts need one or two of these: a normal turns by
//! little from the path without contacts.

use super::super::body::Body;
use super::super::matrices::Matrices;
use super::super::space::Space;
use super::super::supports::{ContactRows, FrictionContact, FrictionContacts, dot};
use super::part::{Part, Push, indefinite};
use super::plane_bound::{Guide, PlaneBound};
use crate::linear::{Factor, Symmetric};
use crate::qp::Failure;
use crate::scene::Row;

/// Most normals of each contact that are tried.
const MOST_TURNS: u32 = 60;

/// Normals that change by no more than this are found, rad.
const TURNED: f64 = 4.0 * f64::EPSILON;

/// The least and the most that the secant may take of a residual.
const SHORT: f64 = 0.1;
const LONG: f64 = 4.0;

/// The response of the structure over parts of one length.
#[derive(Debug)]
pub(super) struct Response {
    /// M + sθC + s²θ²K, and its factor.
    matrix: Symmetric,
    factor: Factor,
    /// The responses at all rows, and the solver of the contacts; only where a contact acts.
    contacts: Option<(ContactRows, FrictionContacts)>,
    /// True if these are of `matrix`.
    current: bool,
}

impl Response {
    /// For `matrix` M + sθC + s²θ²K.
    pub fn new(matrix: Symmetric) -> Result<Self, Failure> {
        Ok(Self { factor: Factor::new(&matrix).map_err(indefinite)?, matrix, contacts: None, current: false })
    }

    /// Makes it the response for another `matrix` of the same pattern.
    pub fn renew(&mut self, matrix: &Symmetric) -> Result<(), Failure> {
        self.matrix.clone_from(matrix);
        self.current = false;
        self.factor.renew(matrix).map_err(indefinite)
    }

    /// Computes δ without contacts from the momentum of `part`.
    pub fn release(&mut self, b: &[f64], delta: &mut Vec<f64>) {
        delta.clear();
        delta.extend_from_slice(b);
        Matrices::solve(&mut self.factor, delta);
    }

    /// Computes δ and the impulses of `holds` over a part of `length` seconds of the weight θ, from
    /// the velocity `v`, for a structure with these `rows`. Returns whether the contacts were
    /// settled.
    pub fn solve(
        &mut self,
        body: &Body<Matrices>,
        (rows, holds): (&[Row], &[PlaneBound]),
        part: &mut Part<Matrices>,
        (v, length, theta): (&[f64], f64, f64),
    ) -> bool {
        self.release(&part.b, &mut part.delta);
        if holds.is_empty() {
            return true;
        }
        let unsettled = self.unsettled();
        let (places, sweeps) = self.contacts(body, rows);
        let free: Vec<f64> = v.iter().zip(&part.delta).map(|(v, d)| v + d).collect();
        for (row, rate) in sweeps.free.iter_mut().enumerate() {
            *rate = places.seen(row, &free);
        }
        let found = find_normals((places, sweeps), holds, (length, theta))
            && holds.iter().zip(&sweeps.touches).all(|(hold, touch)| length * hold.given_up(touch) <= body.touch);
        for (hold, touch) in holds.iter().zip(&sweeps.touches) {
            let [p, friction] = touch.impulse;
            if p == 0.0 {
                continue;
            }
            let normal = if matches!(hold.guide, Guide::Flat(..)) { [0.0; 2] } else { touch.normal };
            part.pushes.push(Push { wall: hold.wall, impulse: hold.sign * p, friction, normal });
            for (row, push) in touch.rows.into_iter().zip(touch.push(touch.impulse)) {
                for &(i, weight) in rows[row].entries() {
                    part.b[i] += weight * push;
                }
            }
        }
        // Solved again rather than added, so that the balance keeps its rounding where both cancel.
        self.release(&part.b, &mut part.delta);
        found && self.unsettled() == unsettled
    }

    /// The responses at all rows and the solver of the contacts, of the present matrix.
    fn contacts(&mut self, body: &Body<Matrices>, rows: &[Row]) -> (&mut ContactRows, &mut FrictionContacts) {
        let Self { matrix, factor, contacts, current } = self;
        let (places, sweeps) = match contacts {
            Some((places, sweeps)) => {
                if !*current {
                    places.renew(factor);
                    sweeps.renew(matrix);
                }
                (places, sweeps)
            }
            none => {
                let rows: Vec<&Row> = rows.iter().collect();
                let sweeps = FrictionContacts::new(matrix.clone(), &rows, body.walls.len());
                let (places, sweeps) = none.insert((ContactRows::new(body.n, &rows, factor), sweeps));
                (places, sweeps)
            }
        };
        *current = true;
        (places, sweeps)
    }

    /// Problems of the contacts without an answer.
    fn unsettled(&self) -> u64 {
        self.contacts.as_ref().map_or(0, |(_, sweeps)| sweeps.unsettled)
    }

    /// Programmes solved.
    pub fn solves(&self) -> u64 {
        self.contacts.as_ref().map_or(0, |(_, sweeps)| sweeps.solves)
    }
}

/// The search for the angle of a normal.
#[derive(Debug, Clone, Copy, Default)]
struct Secant {
    /// The last change of the angle, and the residual before it, rad.
    change: f64,
    residual: f64,
}

impl Secant {
    /// The next change of the angle, after a `residual` (rad).
    fn next(&mut self, residual: f64) -> f64 {
        let slope = (residual - self.residual) / self.change;
        let size = if self.change == 0.0 { 1.0 } else { -1.0 / slope };
        // Other contacts have a part in the change of the residual, and rounding where both are
        // small.
        let size = if size.is_finite() { size.clamp(SHORT, LONG) } else { 1.0 };
        *self = Self { change: size * residual, residual };
        self.change
    }
}

/// Solves for the impulses of `holds` with the normals that they find themselves, over a part of
/// this length (s) and weight θ. Returns whether the normals were found.
fn find_normals(
    (places, sweeps): (&ContactRows, &mut FrictionContacts),
    holds: &[PlaneBound],
    span: (f64, f64),
) -> bool {
    let length = span.0;
    let mut normals: Vec<[f64; 2]> = holds.iter().map(|hold| hold.first_normal(span)).collect();
    let mut secants = vec![Secant::default(); holds.len()];
    // Contacts that begin to slide with some normals keep their kinetic friction with all others.
    let mut frictions: Vec<f64> = holds.iter().map(|hold| hold.friction).collect();
    let mut warm = vec![[0.0; 2]; holds.len()];
    for _ in 0..MOST_TURNS {
        let touches =
            holds.iter().zip(&frictions).zip(normals.iter().zip(&warm)).map(|((hold, friction), (normal, warm))| {
                let (laws, contact) = ((*friction, hold.compliance), (hold.wall, hold.rows));
                let bound = hold.bound(*normal, length);
                let touch = FrictionContact::new(places, contact, (*normal, bound), laws);
                FrictionContact { slides: hold.slides, kinetic: hold.kinetic, impulse: *warm, ..touch }
            });
        sweeps.touches.clear();
        sweeps.touches.extend(touches);
        sweeps.solve(places);
        frictions.iter_mut().zip(&sweeps.touches).for_each(|(friction, touch)| *friction = touch.friction);
        let (mut turned, mut far) = (0.0_f64, false);
        let found = holds.iter().zip(&sweeps.touches).zip(normals.iter_mut().zip(&mut secants).zip(&mut warm));
        for ((hold, touch), ((normal, secant), warm)) in found {
            let rate = sweeps.rate(hold.rows);
            let way = hold.way([0, 1].map(|i: usize| rate[i] - hold.rate[i]), span);
            let next = hold.normal(way);
            *warm = touch.impulse;
            let residual = angle(*normal, next);
            if touch.impulse[0] > 0.0 || hold.is_passed(way, length) {
                turned = turned.max(residual.abs());
            }
            far |= touch.impulse[0] > 0.0 && hold.turns_far(way);
            let change = secant.next(residual);
            *normal = if change == residual { next } else { turn(*normal, change) };
        }
        if turned <= TURNED || far {
            return !far;
        }
    }
    false
}

/// The angle from the unit vector `a` to `b`, rad.
fn angle(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).atan2(dot(a, b))
}

/// The unit vector `a` turned by `angle` (rad).
fn turn(a: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * a[0] - sin * a[1], sin * a[0] + cos * a[1]]
}
