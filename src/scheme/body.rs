//! What every scheme on a grid knows of the scene.

use super::blows::Blows;
use super::frame::Frame;
use super::space::{Space, zero};
use super::stop::Stop;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::scene::{Scene, SharedStructure};

/// The structure between its walls.
#[derive(Debug)]
pub(super) struct Body<S: Space> {
    pub n: usize,
    pub h: f64,
    pub matrices: SharedStructure,
    pub mass: S::Operator,
    pub damping: S::Operator,
    pub stiffness: S::Operator,
    /// The walls, and the row of each.
    pub walls: Vec<Stop>,
    pub rows: S::Rows,
    /// Distance within which a wall counts as touched, m: 1e-12 of the gap scale.
    pub touch: f64,
    /// True if C is not zero.
    pub damped: bool,
    /// None without blows at any time, which is what most scenes have.
    pub blows: Option<Box<Blows<S>>>,
    /// When the motion began or was taken up anew, s.
    pub since: f64,
    forces: S::Forces,
    /// The loads at the present instant and at the one before, N: a scheme moves them on once a
    /// step.
    pub load: S::Vector,
    load_before: S::Vector,
    /// q + hθv, m.
    mean: S::Vector,
}

impl<S: Space> Body<S> {
    pub fn new(scene: &Scene, h: f64) -> Result<Self> {
        let matrices = scene.system.structure();
        let n = matrices.mass.size();
        Ok(Self {
            n,
            h,
            mass: S::operator(&matrices.mass),
            damping: S::operator(&matrices.damping),
            stiffness: S::operator(&matrices.stiffness),
            walls: scene.walls.iter().map(Stop::new).collect(),
            rows: S::rows(n, scene.walls.iter().map(|wall| &wall.at)),
            touch: scene.touching_distance(),
            damped: matrices.damping.diagonal_entries().iter().any(|&c| c != 0.0),
            blows: Blows::new(scene, &matrices)?.map(Box::new),
            since: 0.0,
            forces: S::forces(&scene.loads, h),
            load: zero::<S>(n),
            load_before: zero::<S>(n),
            mean: zero::<S>(n),
            matrices,
        })
    }

    /// Takes the motion up anew at `time` (s).
    pub fn restart(&mut self, time: f64) {
        self.since = time;
        S::force(&mut self.forces, time, &mut self.load);
    }

    /// Moves the loads on to `time` (s).
    #[inline]
    pub fn load_at(&mut self, time: f64) {
        std::mem::swap(&mut self.load, &mut self.load_before);
        S::force(&mut self.forces, time, &mut self.load);
    }

    /// Writes the loads at the present instant and the extra force of the step to `b`, N.
    #[inline(always)]
    pub fn applied(&self, frame: &Frame<S>, b: &mut S::Vector) {
        for (b, (load, extra)) in b.as_mut().iter_mut().zip(self.load.as_ref().iter().zip(frame.extra.as_ref())) {
            *b = load + extra;
        }
    }

    /// The θ-method's A = M + hθC + h²θ²K.
    pub fn theta_matrix(&self, theta: f64) -> Symmetric {
        let (m, ht) = (&self.matrices, self.h * theta);
        Symmetric::sum(&[(1.0, &m.mass), (ht, &m.damping), (ht * ht, &m.stiffness)])
    }

    /// Writes h[f_θ + f_x − C v − K(q + hθv)] to `b`, N s, and notes the velocity before the step.
    /// Once a step.
    ///
    /// Not as h(f_θ + f_x) − h(C + hθK)v − hK q with both matrices kept, which takes a pass less:
    /// rounded apart from each other, they act as a small damper, which changed the energy by 2e-12
    /// of itself in 1e7 steps that conserve it to 1e-15 in this form.
    #[inline(always)]
    pub fn theta_momentum(&mut self, theta: f64, frame: &mut Frame<S>, b: &mut S::Vector) {
        let (h, ht) = (self.h, self.h * theta);
        // Before the state is read: no number has to outlive the call of a sine.
        self.load_at(frame.end);
        let loads = self.load_before.as_ref().iter().zip(self.load.as_ref()).zip(frame.extra.as_ref());
        for (b, ((start, end), extra)) in b.as_mut().iter_mut().zip(loads) {
            *b = (1.0 - theta) * start + theta * end + extra;
        }
        for ((mean, q), v) in self.mean.as_mut().iter_mut().zip(frame.q.as_ref()).zip(frame.v.as_ref()) {
            *mean = q + ht * v;
        }
        S::add_product(&self.damping, -1.0, &frame.v, b);
        S::add_product(&self.stiffness, -1.0, &self.mean, b);
        b.as_mut().iter_mut().for_each(|b| *b *= h);
        frame.before.clone_from(&frame.v);
    }

    /// Where a wall sees the displacement `q` (m).
    #[inline]
    pub fn seen(&self, wall: usize, q: &S::Vector) -> f64 {
        S::dot(&self.rows, wall, q)
    }

    /// Adds `scale` times the signed `forces` of all walls to `out`, each by its row.
    #[inline]
    pub fn push(&self, scale: f64, forces: &[f64], out: &mut S::Vector) {
        for (wall, &force) in forces.iter().enumerate() {
            if force != 0.0 {
                S::add_transposed(&self.rows, wall, scale * force, out);
            }
        }
    }

    /// Adds the blows in (from, to] (s), times `scale`, to `b`, and writes the velocity that they
    /// leave to the frame, given that before the step. Returns whether there was one.
    #[inline]
    pub fn strike(&mut self, (from, to): (f64, f64), scale: f64, b: &mut S::Vector, frame: &mut Frame<S>) -> bool {
        self.blows.as_mut().is_some_and(|blows| blows.strike((from, to), scale, b, frame))
    }

    /// The same for the blows within half a step of the start of step number `step`.
    #[inline]
    pub fn strike_about(&mut self, step: u64, scale: f64, b: &mut S::Vector, frame: &mut Frame<S>) -> bool {
        let (since, h) = (self.since, self.h);
        self.blows.as_mut().is_some_and(|blows| blows.strike_about((since, step, h), scale, b, frame))
    }

    /// Finds where the blows in each (from, to] take the displacement by `about` (s) beside what a
    /// step makes of their sum: [`Body::shift`]. Returns whether there was one.
    #[inline]
    pub fn find_blows(&mut self, spans: &[(f64, f64, f64)]) -> bool {
        self.blows.as_mut().is_some_and(|blows| blows.find(spans))
    }

    /// Adds what the blows found add to the displacement to `q`.
    pub fn shift(&self, q: &mut S::Vector) {
        if let Some(blows) = &self.blows {
            q.as_mut().iter_mut().zip(blows.shift.as_ref()).for_each(|(q, shift)| *q += shift);
        }
    }

    /// Takes the structure to where the blows of the step leave it, unless a rigid wall that pushes
    /// was what they drove into.
    #[inline]
    pub fn land(&mut self, spans: &[(f64, f64, f64)], frame: &mut Frame<S>) {
        if self.find_blows(spans) && !self.answers(&frame.pushing) {
            self.shift(&mut frame.q);
        }
    }

    /// True if a rigid one of the walls `pushing` is what the blows found drive into.
    pub fn answers(&self, pushing: &[usize]) -> bool {
        pushing.iter().any(|&wall| self.drives(wall))
    }

    /// True if the blows found drive into a wall, and it is rigid.
    pub fn drives(&self, wall: usize) -> bool {
        let stop = self.walls[wall];
        let into = |blows: &Blows<S>| stop.sign * S::dot(&self.rows, wall, &blows.given) < 0.0;
        stop.law.is_rigid() && self.blows.as_deref().is_some_and(into)
    }

    /// Adds −`scale` C d to `b`: what the damper feels of the way on which the blows found take the
    /// displacement.
    pub fn damp_shift(&self, scale: f64, b: &mut S::Vector) {
        if let Some(blows) = &self.blows {
            S::add_product(&self.damping, -scale, &blows.shift, b);
        }
    }
}
