//! The orbit that touches a wall without speed, and the orbits beside it that strike the wall.
//!
//! In a time window around the touch the wall is moved far away: the map P̃ computed so is smooth
//! at the graze, and so is the gap at the turning point of the motion in the window. The grazing
//! orbit solves P̃(x; λ) = x, gap(x; λ) = 0. From there the orbits without the contact go along the
//! tangent of P̃(x; λ) = x. Those that strike a rigid wall with the speed v go, to first order in
//! v, along
//!
//! (P̃′ − 1) δx + ∂P̃/∂λ δλ + K v = 0, ∂gap/∂x δx + ∂gap/∂λ δλ = 0,
//!
//! where K is the change of the end state by an impact of unit speed: (1 + e) d in the velocity,
//! propagated to the end. Without the wall the motion would reach the depth v²/2a behind it, a
//! being the acceleration at the touch; the first orbit of that branch is computed for this depth.

use super::{Posed, Shots};
use crate::error::{Error, Result};
use crate::flow::SeriesBody;
use crate::orbit::branch::arclength::{Vector, extended, tangent};
use crate::orbit::branch::line::Begin;
use crate::orbit::branch::point::Point;
use crate::orbit::orbit_run::{OrbitRun, Recorded, Touch, run};
use crate::orbit::strobe::multipliers;
use crate::orbit::watch::Passage;
use nalgebra::{Complex, DMatrix, DVector};

/// Distance by which a wall is moved away, in typical displacements.
const AWAY: f64 = 8.0;

/// Most iterations, and the residual of map and gap at which they end.
const ITERATIONS: usize = 12;
const SOLVED: f64 = 1e-13;
const ACCEPTED: f64 = 1e-10;

/// Time after the touch over which the acceleration is computed, as a share of the rest of the
/// window.
const SOON: f64 = 1e-4;

/// Impact speeds, over the scale of speeds, that are tried first on the branch with the impact …
const SPEEDS: [f64; 4] = [3e-3, 1e-3, 3e-4, 1e-4];

/// … and steps tried on the branch without it, or on that with an elastic contact.
const BESIDE: [f64; 4] = [1e-3, 3e-4, 1e-4, 1e-5];

/// Most iterations for the first orbit with the impact, and the change at which they end, over the
/// square of its speed.
const STRIKES: usize = 30;
const STRUCK: f64 = 1e-4;

/// A contact that is about to vanish, or to begin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub wall: usize,
    /// The interval in which it happens, in cycles, and its approximate instant.
    pub window: [f64; 2],
    pub at: f64,
}

/// The map with the wall moved away in the window.
struct Free {
    posed: Posed,
    motion: OrbitRun,
    touch: Touch,
    /// The derivative of the gap with respect to the scaled state, over the scale of lengths.
    gap: Vector,
    /// The derivative of the scaled end with respect to the velocity at the touch: 2n × n.
    after: DMatrix<f64>,
    /// The second derivative of the gap in time there, m/s².
    acceleration: f64,
}

/// The grazing orbit.
pub(super) struct Graze {
    pub y: Vector,
    pub touch: Touch,
    pub motion: OrbitRun,
    period: f64,
    own: Vec<Complex<f64>>,
    /// The derivatives of the map (all rows but the last) and the gap (the last row) with respect
    /// to state and key.
    matrix: DMatrix<f64>,
    /// K, for a speed of 1 m/s.
    kick: Vector,
    acceleration: f64,
    contact: Contact,
    pub rigid: bool,
}

impl<'a> Shots<'a> {
    /// The map from the state `x` with the wall of `contact` moved away in its window; with its
    /// derivatives if `whole`.
    fn free(&self, posed: Posed, x: &Vector, contact: &Contact, whole: bool) -> Result<Free> {
        let Posed { scene, period } = &posed;
        let n = x.len() / 2;
        let mut open = scene.clone();
        let Some(wall) = open.walls.get_mut(contact.wall) else { return Err(gone()) };
        let shift = -wall.side().sign() * AWAY * self.scales.length;
        *wall = wall.clone().with_position(wall.position() + shift);
        let recorded = if whole { Recorded::All } else { Recorded::Events };
        let at = |phase: f64| phase * period;
        let [from, to] = contact.window.map(at);
        let ends = [at(self.strobe), at(self.strobe + self.cycles())];
        let first = run(scene, *period, [ends[0], from], x, recorded)?;
        let within = run(&open, *period, [from, to], &first.end, Recorded::Touches)?;
        let near = |touch: &&Touch| (touch.phase - contact.at).abs();
        let mine = within.touches.iter().filter(|touch| touch.wall == contact.wall);
        let touch = mine.min_by(|a, b| near(a).total_cmp(&near(b))).copied().ok_or_else(gone)?;
        let touch = Touch { gap: touch.gap - AWAY * self.scales.length, ..touch };
        let time = at(touch.phase);
        let last = run(scene, *period, [to, ends[1]], &within.end, recorded)?;
        let mut motion = OrbitRun { end: last.end, ..within };
        motion.passages = [first.passages, motion.passages, last.passages].concat();
        motion.touches = Vec::new();
        motion.largest = first.largest.max(motion.largest).max(last.largest);
        let mut free = Free {
            motion,
            touch,
            gap: DVector::zeros(0),
            after: DMatrix::zeros(0, 0),
            acceleration: 0.0,
            posed: Posed { scene: scene.clone(), period: *period },
        };
        if !whole {
            return Ok(free);
        }
        let until = run(&open, *period, [from, time], &first.end, Recorded::All)?;
        let since = run(&open, *period, [time, to], &until.end, Recorded::All)?;
        let soon = run(&open, *period, [time, time + SOON * (to - time)], &until.end, Recorded::Events)?;
        let wall = &scene.walls[contact.wall];
        let sign = wall.side().sign();
        let rate = |x: &DVector<f64>| sign * wall.row().dot(&x.as_slice()[n..]);
        free.acceleration = (rate(&soon.end) - rate(&until.end)) / (SOON * (to - time));
        let before = self.scales.similar(&(&until.derivative * &first.derivative));
        let after = self.scales.similar(&(&last.derivative * &since.derivative)) * self.sign();
        let mut row = vec![0.0; n];
        wall.row().add_transposed(sign, &mut row);
        free.gap = DVector::from_fn(2 * n, |j, _| (0..n).map(|i| row[i] * before[(i, j)]).sum());
        free.motion.derivative = &after * &before;
        free.after = after.columns(n, n).into_owned();
        Ok(free)
    }

    /// The orbit near `guess` that touches the wall of `contact` without speed.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where there is none, or the derivative of the motion does not exist.
    pub(super) fn graze(&self, guess: &Vector, contact: Contact) -> Result<Graze> {
        let n = guess.len() - 1;
        let mut y = guess.clone();
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let (value, x) = (self.value(&y), self.state(&y));
            let free = self.free(self.posed(value)?, &x, &contact, true)?;
            let end = |free: &Free| {
                extended(&(self.scales.scaled(&free.motion.end) * self.sign()), free.touch.gap / self.scales.length)
            };
            let residual = end(&free) - extended(&y.rows(0, n).into_owned(), 0.0);
            let column = self.column(&y, |posed| {
                let posed = Posed { scene: posed.scene.clone(), period: posed.period };
                Ok(Some(end(&self.free(posed, &x, &contact, false)?)))
            })?;
            let map = &free.motion.derivative - DMatrix::identity(n, n);
            let row = |i: usize, j: usize| if i < n { map[(i, j)] } else { free.gap[j] };
            let matrix = DMatrix::from_fn(n + 1, n + 1, |i, j| if j < n { row(i, j) } else { column[i] });
            let size = residual.amax();
            if size <= SOLVED || size >= 0.5 * last && size <= ACCEPTED {
                let own = multipliers(&free.motion.derivative);
                let kick = self.kick(&free, &contact)?;
                let Free { motion, touch, acceleration, posed, .. } = free;
                let period = posed.period;
                let rigid = posed.scene.walls.get(contact.wall).is_some_and(|wall| wall.law.is_rigid());
                return Ok(Graze { y, touch, motion, period, own, matrix, kick, acceleration, contact, rigid });
            }
            let step = matrix.lu().solve(&residual).filter(|step| step.norm() <= 1.0).ok_or_else(gone)?;
            y -= step;
            last = size;
        }
        Err(Error::no_orbit("no orbit was found that touches the wall without speed"))
    }

    /// The change of the scaled end by an impact of 1 m/s at the touch; 0 at an elastic wall.
    fn kick(&self, free: &Free, contact: &Contact) -> Result<Vector> {
        let scene = &free.posed.scene;
        let wall = scene.walls.get(contact.wall).ok_or_else(gone)?;
        let Some(restitution) = wall.law.restitution() else { return Ok(DVector::zeros(free.after.nrows())) };
        let mut body = SeriesBody::new(scene).ok_or_else(gone)?;
        let mut aside = vec![0.0; body.n];
        wall.row().add_transposed(1.0, &mut aside);
        body.solve(&mut aside);
        let mass = wall.row().dot(&aside);
        let change = (1.0 + restitution) * wall.side().sign() / mass / self.scales.speed;
        Ok(&free.after * DVector::from_vec(aside) * change)
    }

    /// The special point of a graze; `vanished` are the events of the contact whose speed is 0
    /// there and which still belongs to the branch's signature.
    pub(super) fn grazing(&self, graze: &Graze, vanished: &[Passage]) -> Point {
        let mut motion = graze.motion.clone();
        let place = motion.passages.partition_point(|p| p.phase < graze.touch.phase);
        let still = vanished.iter().map(|p| Passage { phase: graze.touch.phase, speed: 0.0, ..*p });
        motion.passages.splice(place..place, still);
        if vanished.is_empty() {
            motion.touches = vec![graze.touch];
        }
        self.point(&graze.y, graze.period, &motion, graze.own.clone())
    }

    /// The start of the branch without the contact, or with an elastic one.
    pub(super) fn smooth_beside(&self, graze: &Graze, strikes: bool) -> Result<Begin<Self>> {
        let n = graze.y.len() - 1;
        let matrix = graze.matrix.rows(0, n).into_owned();
        let row = graze.matrix.row(n).transpose();
        // The direction is towards the wall or away from it.
        let along = tangent(&matrix, &(if strikes { -row } else { row }))?;
        let count = graze.motion.passages.len();
        for step in BESIDE {
            let Ok((y, linear, _)) = self.correct(&(&graze.y + &along * step), &along, None) else { continue };
            let more = linear.motion.passages.len() > count;
            if more == strikes && (&y - &graze.y).norm() <= 2.0 * step {
                return Ok(Begin { curve: self.anew(), y, along, both: false });
            }
        }
        Err(Error::no_orbit("no orbit was found beyond the graze"))
    }

    /// The start of the branch on which the structure strikes the rigid wall.
    pub(super) fn striking_beside(&self, graze: &Graze) -> Result<Begin<Self>> {
        let n = graze.y.len() - 1;
        let solver = graze.matrix.clone().lu();
        let solve = |map: &Vector, gap: f64| solver.solve(&extended(map, gap)).ok_or_else(gone);
        let along = solve(&-&graze.kick, 0.0)? * self.scales.speed;
        if !(graze.acceleration > 0.0 && along.norm() > 0.0) {
            return Err(gone());
        }
        let (count, unit_along) = (graze.motion.passages.len(), along.normalize());
        let depth = |v: f64| v * v / (2.0 * graze.acceleration * self.scales.length);
        for share in SPEEDS {
            let wanted = share * self.scales.speed;
            let mut y = &graze.y + &along * share + solve(&DVector::zeros(n), -depth(wanted))?;
            let mut found = false;
            for _ in 0..STRIKES {
                let x = self.state(&y);
                let Ok(motion) = self.posed(self.value(&y)).and_then(|posed| self.run(&posed, &x, Recorded::Events))
                else {
                    break;
                };
                let [from, to] = graze.contact.window;
                let mine = motion.passages.iter().find(|p| {
                    p.event.wall == graze.contact.wall && p.event.kind.is_approach() && p.phase > from && p.phase < to
                });
                let v = mine.map_or(0.0, |p| p.speed);
                let residual = self.scales.scaled(&(&motion.end * self.sign() - &x));
                let map = -residual - &graze.kick * (wanted - v);
                let step = solve(&map, depth(v) - depth(wanted))?;
                found = v > 0.0 && step.norm() <= STRUCK * share * share;
                y += step;
                if found || !y.iter().all(|x| x.is_finite()) {
                    break;
                }
            }
            let Some((y, linear, _)) = found.then(|| self.correct(&y, &unit_along, None).ok()).flatten() else {
                continue;
            };
            if linear.motion.passages.len() == count + 1 && (&y - &graze.y).norm() <= 4.0 * share * along.norm() {
                return Ok(Begin { curve: self.anew(), y, along: unit_along, both: false });
            }
        }
        Err(Error::no_orbit("no orbit was found that strikes the wall beyond the graze"))
    }

    /// The same curve for another signature.
    pub(super) fn anew(&self) -> Self {
        Self { first: 0, ..self.clone() }
    }
}

fn gone() -> Error {
    Error::no_orbit("no wall is touched there")
}
