//! The motion over a part of a step under contacts in two planes.
//!
//! Over a part of length s, contacts in which the body rests or slides give Σ Pᵀ(−p n + f t). A
//! flat wall bounds n·ẇ⁺. Along a round wall the impulse acts along the middle of the path,
//!
//! n ∥ w + w⁺,   n·ẇ⁺ ≤ −n·ẇ,
//!
//! so that (w⁺ + w)·(w⁺ − w) = 0: the body stays on the circle, and p does no work. n is found with
//! w⁺, by repetition from w + ½sẇ. A step of implicit-euler takes n ∥ w⁺ and n·w⁺ ≤ γ instead.
//!
//! An elastic round wall pushes along n ∥ w_θ = (1 − θ)w + θw⁺ with the force of its spring and
//! dashpot there. Since n·w_θ = |w_θ|, that force is linear in n·ẇ⁺, as at a flat elastic wall. The
//! dashpot feels the rate along n: a difference of distances from the centre would be wrong by
//! ¼s|ẇ|²/γ where the body slides along the ring.

use super::super::body::Body;
use super::super::matrices::Matrices;
use super::super::space::Space;
use super::super::supports::{CROSSING, ContactRows, FrictionContact, FrictionContacts, dot};
use super::part::{Part, Push, indefinite};
use crate::linear::{Factor, Symmetric};
use crate::qp::Failure;
use crate::scene::{Row, WallSpring};

/// Most repetitions with the normals of the one before.
const MOST_TURNS: u32 = 60;

/// Normals that change by no more than this are found, rad.
const TURNED: f64 = 4.0 * f64::EPSILON;

/// How a contact bounds the motion.
#[derive(Debug, Clone, Copy)]
pub(super) enum Guide {
    /// A flat wall: n, and the bound on n·ẇ⁺, m/s.
    Flat([f64; 2], f64),
    /// A round wall along which the body slides; what rounding has left behind it returns at
    /// `return_rate` (m/s).
    Chord { return_rate: f64 },
    /// A round wall of this gap (m) that is not passed at the end.
    End { gap: f64 },
    /// An elastic round wall.
    Ring(Ring),
}

/// Where the plate of a dashpot of an elastic round wall begins, m.
#[derive(Debug, Clone, Copy)]
pub(super) enum Plate {
    /// At this distance from the centre.
    Distance(f64),
    /// On the body, which it touches.
    Body,
}

/// The force of an elastic round wall over a part of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    pub spring: WallSpring,
    /// γ, m.
    pub gap: f64,
    /// Its dashpot's plate at the start.
    pub plate: Plate,
    /// θ of the part.
    pub theta: f64,
}

impl Ring {
    /// n, and the bound on n·ẇ⁺ beyond which the ring pushes, for a body that starts at `from` (m)
    /// with `rate` (m/s) and moves by `way` (m) over `length` seconds.
    fn bound(&self, [from, rate, way]: [[f64; 2]; 3], length: f64) -> ([f64; 2], f64) {
        let normal = unit([0, 1].map(|i: usize| from[i] + self.theta * way[i]));
        let (w, speed, st) = (dot(normal, from), dot(normal, rate), self.theta * length);
        let plate = match self.plate {
            Plate::Distance(distance) => distance,
            Plate::Body => w,
        };
        let force = self.spring.force(w + st * speed, self.gap, plate, st);
        (normal, speed - length * force * self.compliance(length))
    }

    /// n·ẇ⁺ beyond the bound over the impulse, m/s per N s.
    pub fn compliance(&self, length: f64) -> f64 {
        let st = self.theta * length;
        1.0 / (st * st * self.spring.over(st))
    }
}

/// The unit vector along `x`.
fn unit(x: [f64; 2]) -> [f64; 2] {
    let size = dot(x, x).sqrt();
    if size > 0.0 { x.map(|x| x / size) } else { [1.0, 0.0] }
}

/// A contact that bounds the motion over a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneBound {
    pub wall: usize,
    pub rows: [usize; 2],
    pub guide: Guide,
    /// μ, that once it slides, and the compliance of an elastic wall, m/s per N s.
    pub friction: f64,
    pub kinetic: f64,
    pub compliance: f64,
    /// As [`FrictionContact::slides`].
    pub slides: f64,
    /// The sign of the wall's impulse.
    pub sign: f64,
    /// Displacement from the centre of a round wall, m, and rate of the place, m/s, at the start.
    pub from: [f64; 2],
    pub rate: [f64; 2],
}

impl PlaneBound {
    /// n and the bound on n·ẇ⁺ if the place moves by `way` (m) over `length` seconds; the same for
    /// a flat wall always.
    fn bound(&self, way: [f64; 2], length: f64) -> ([f64; 2], f64) {
        match self.guide {
            Guide::Flat(normal, bound) => (normal, bound),
            Guide::Chord { return_rate } => {
                let normal = unit([0, 1].map(|i: usize| 2.0 * self.from[i] + way[i]));
                (normal, -dot(normal, self.rate) - return_rate)
            }
            Guide::End { gap } => {
                let normal = unit([0, 1].map(|i: usize| self.from[i] + way[i]));
                (normal, (gap - dot(normal, self.from)) / length)
            }
            Guide::Ring(ring) => ring.bound([self.from, self.rate, way], length),
        }
    }

    /// n over a part of `length` seconds of the weight θ that changes the rate of the place by
    /// `change` (m/s).
    pub fn normal_over(&self, change: &[f64; 2], length: f64, theta: f64) -> [f64; 2] {
        self.bound([0, 1].map(|i: usize| length * (self.rate[i] + theta * change[i])), length).0
    }

    /// True if a path of `way` (m) over `length` seconds ends outside of a round wall, or is one
    /// along which an elastic one pushes.
    fn is_passed(&self, way: [f64; 2], length: f64) -> bool {
        let limit = match self.guide {
            Guide::Flat(..) => return false,
            Guide::Chord { .. } => dot(self.from, self.from),
            Guide::End { gap } => gap * gap,
            Guide::Ring(ring) => {
                // A dashpot may push where the middle of the path is clear of the ring.
                let (normal, bound) = ring.bound([self.from, self.rate, way], length);
                let rate = dot(normal, self.rate);
                return rate + (dot(normal, way) / length - rate) / ring.theta > bound;
            }
        };
        let end = [0, 1].map(|i: usize| self.from[i] + way[i]);
        dot(end, end) > limit
    }

    /// What the answer of the contacts gave up of the bound along a round wall, m/s. Where impulses
    /// that balance one another contradict a rebound, contacts give it up; here it is no rebound,
    /// but what keeps the body on the circle.
    fn given_up(&self, touch: &FrictionContact) -> f64 {
        match self.guide {
            Guide::Chord { return_rate } => touch.bound + dot(touch.normal, self.rate) + return_rate,
            _ => 0.0,
        }
    }

    /// True if the middle of the path along a round wall says little of its normal.
    fn turns_far(&self, way: [f64; 2]) -> bool {
        let middle = [0, 1].map(|i: usize| self.from[i] + 0.5 * way[i]);
        matches!(self.guide, Guide::Chord { .. }) && dot(middle, middle) < CROSSING.powi(2) * dot(self.from, self.from)
    }
}

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
        let found = find_normals((places, sweeps), holds, &part.delta, (length, theta))
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

/// Solves for the impulses of `holds` with the normals that they find themselves, over a part of
/// `length` seconds of the weight θ that changes the velocity by `delta` without them. Returns
/// whether the normals were found.
fn find_normals(
    (places, sweeps): (&ContactRows, &mut FrictionContacts),
    holds: &[PlaneBound],
    delta: &[f64],
    (length, theta): (f64, f64),
) -> bool {
    let mut ways: Vec<[f64; 2]> = holds.iter().map(|hold| hold.rate.map(|rate| length * rate)).collect();
    // Contacts that begin to slide with some normals keep their kinetic friction with all others.
    let mut frictions: Vec<f64> = holds.iter().map(|hold| hold.friction).collect();
    let mut warm = vec![[0.0; 2]; holds.len()];
    for turn in 0..MOST_TURNS {
        let touches =
            holds.iter().zip(&frictions).zip(ways.iter().zip(&warm)).map(|((hold, friction), (way, warm))| {
                let (laws, contact) = ((*friction, hold.compliance), (hold.wall, hold.rows));
                let touch = FrictionContact::new(places, contact, hold.bound(*way, length), laws, *warm);
                FrictionContact { slides: hold.slides, kinetic: hold.kinetic, ..touch }
            });
        sweeps.touches.clear();
        sweeps.touches.extend(touches);
        sweeps.solve(places);
        frictions.iter_mut().zip(&sweeps.touches).for_each(|(friction, touch)| *friction = touch.friction);
        let mut delta = delta.to_vec();
        places.lift(&sweeps.impulse, &mut delta);
        let (mut turned, mut far) = (0.0_f64, false);
        for ((hold, way), (touch, warm)) in holds.iter().zip(&mut ways).zip(sweeps.touches.iter().zip(&mut warm)) {
            let change = places.pair(hold.rows, &delta);
            let found = [0, 1].map(|i: usize| length * (hold.rate[i] + theta * change[i]));
            *warm = touch.impulse;
            let (normal, _) = hold.bound(found, length);
            if touch.impulse[0] > 0.0 || hold.is_passed(found, length) {
                turned = turned.max((normal[0] - touch.normal[0]).hypot(normal[1] - touch.normal[1]));
            }
            far |= touch.impulse[0] > 0.0 && hold.turns_far(found);
            // Normals that swing to and fro meet in the middle.
            let share = if turn % 4 == 3 && turn >= MOST_TURNS / 4 { 0.5 } else { 1.0 };
            *way = [0, 1].map(|i: usize| way[i] + share * (found[i] - way[i]));
        }
        if turned <= TURNED || far {
            return !far;
        }
    }
    false
}
