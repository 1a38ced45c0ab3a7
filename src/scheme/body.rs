//! The structure, its loads and its walls, as every scheme on a grid uses them.

use super::blows::Blows;
use super::flat_row::FlatRow;
use super::frame::Frame;
use super::space::{Space, zero};
use crate::error::Result;
use crate::linear::{Symmetric, update};
use crate::scene::{Scene, SharedStructure};

/// The matrices, loads and walls of a scene, with the length of a step.
#[derive(Debug)]
pub(super) struct Body<S: Space> {
    pub n: usize,
    pub h: f64,
    pub matrices: SharedStructure,
    pub mass: S::Operator,
    pub damping: S::Operator,
    pub stiffness: S::Operator,
    /// The faces of the walls, and the row of each wall.
    pub walls: Vec<FlatRow>,
    pub rows: S::Rows,
    /// Distance within which a wall counts as touched, m: 1e-12 of the gap scale.
    pub touch: f64,
    /// True if C is not zero.
    pub damped: bool,
    /// The vector instructions of the machine.
    pub arch: pulp::Arch,
    /// The impulsive loads ("blows"); `None` if the scene has none, as most scenes.
    pub blows: Option<Box<Blows<S>>>,
    /// Time at which the motion was started or restarted, s.
    pub since: f64,
    forces: S::Forces,
    /// The loads at the current instant of the grid and at the one before, N; a scheme updates them
    /// once per step.
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
            walls: scene.walls.iter().enumerate().map(|(index, wall)| FlatRow::new(index, wall)).collect(),
            rows: S::rows(n, scene.walls.iter().map(|wall| wall.row())),
            touch: scene.touching_distance(),
            damped: matrices.damping.diagonal_entries().iter().any(|&c| c != 0.0),
            arch: pulp::Arch::new(),
            blows: Blows::new(scene, &matrices)?.map(Box::new),
            since: 0.0,
            forces: S::forces(&scene.loads, h),
            load: zero::<S>(n),
            load_before: zero::<S>(n),
            mean: zero::<S>(n),
            matrices,
        })
    }

    /// Restarts the motion at `time` (s).
    pub fn restart(&mut self, time: f64) {
        self.since = time;
        S::force(&mut self.forces, time, &mut self.load);
    }

    /// Updates the loads to `time` (s).
    #[inline(always)]
    pub fn load_at(&mut self, time: f64) {
        std::mem::swap(&mut self.load, &mut self.load_before);
        S::force(&mut self.forces, time, &mut self.load);
    }

    /// The loads at the instant before the current one, N.
    pub fn load_before(&self) -> &S::Vector {
        &self.load_before
    }

    /// Writes the loads at `time` (s) to `out`, N, under the conditions of [`Space::force`].
    pub fn force_at(&mut self, time: f64, out: &mut S::Vector) {
        S::force(&mut self.forces, time, out);
    }

    /// The instants of the blows after t = 0, s.
    pub fn blow_instants(&self) -> impl Iterator<Item = f64> + '_ {
        self.blows.iter().flat_map(|blows| blows.instants())
    }

    /// Adds the change of velocity by the blows in (from, to] (s) to `v`. Returns whether there was
    /// one.
    pub fn kick(&mut self, from: f64, to: f64, v: &mut S::Vector) -> bool {
        self.blows.as_mut().is_some_and(|blows| blows.kick(from, to, v))
    }

    /// Writes the sum of the loads at the current instant and the extra force of the step to `b`,
    /// N.
    #[inline(always)]
    pub fn applied(&self, frame: &Frame<S>, b: &mut S::Vector) {
        for (b, (load, extra)) in b.as_mut().iter_mut().zip(self.load.as_ref().iter().zip(frame.extra.as_ref())) {
            *b = load + extra;
        }
    }

    /// The θ-method's A = M + hθC + h²θ²K.
    pub fn theta_matrix(&self, theta: f64) -> Symmetric {
        self.theta_matrix_over(self.h * theta)
    }

    /// M + sC + s²K.
    pub fn theta_matrix_over(&self, s: f64) -> Symmetric {
        self.matrices.theta_matrix(s)
    }

    /// Writes h[f_θ + f_x − C v − K(q + hθv)] to `b`, N s, and copies the velocity before the step
    /// to the frame. Must be called once per step, since it updates the loads.
    ///
    /// Not as h(f_θ + f_x) − h(C + hθK)v − hK q with both matrices kept, which takes a pass less:
    /// rounded apart from each other, they act as a small damper, which changed the energy by 2e-12
    /// of itself in 1e7 steps that conserve it to 1e-15 in this form.
    #[inline(always)]
    pub fn theta_momentum(&mut self, theta: f64, frame: &mut Frame<S>, b: &mut S::Vector) {
        self.momentum_to(frame.end, theta, (&frame.q, &frame.v, &frame.extra), b);
        frame.before.clone_from(&frame.v);
    }

    /// The same for a step that ends at `end` (s), from the state `q`, `v` under the extra force
    /// `extra`.
    #[inline(always)]
    pub fn momentum_to(
        &mut self,
        end: f64,
        theta: f64,
        (q, v, extra): (&S::Vector, &S::Vector, &S::Vector),
        b: &mut S::Vector,
    ) {
        let (h, ht) = (self.h, self.h * theta);
        // Before the state is read, so that no number must be kept in memory during the call of a
        // sine.
        self.load_at(end);
        let forces = [self.load_before.as_ref(), self.load.as_ref(), extra.as_ref()];
        update(b.as_mut(), forces, |_, [start, end, extra]| (1.0 - theta) * start + theta * end + extra);
        update(self.mean.as_mut(), [q.as_ref(), v.as_ref()], |_, [q, v]| q + ht * v);
        S::add_product(&self.damping, -1.0, v, b);
        S::add_product(&self.stiffness, -1.0, &self.mean, b);
        b.as_mut().iter_mut().for_each(|b| *b *= h);
    }

    /// The displacement of a wall's row, g·q, m; of a velocity its rate.
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

    /// Adds the impulses of the blows in (from, to] (s), times `scale`, to `b`, and writes the
    /// velocity before the step plus the change by these blows to the frame. Returns whether there
    /// was a blow.
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

    /// Computes the displacement d that the blows in each (from, to] cause up to the time `about`
    /// (s), in addition to what the step's rule makes of their sum; [`Body::shift`] adds it.
    /// Returns whether there was a blow.
    #[inline]
    pub fn find_blows(&mut self, spans: &[(f64, f64, f64)]) -> bool {
        self.blows.as_mut().is_some_and(|blows| blows.find(spans))
    }

    /// Adds the displacement d of [`Body::find_blows`] to `q`.
    pub fn shift(&self, q: &mut S::Vector) {
        if let Some(blows) = &self.blows {
            q.as_mut().iter_mut().zip(blows.shift.as_ref()).for_each(|(q, shift)| *q += shift);
        }
    }

    /// Adds the displacement that the blows of the step cause, unless they drive the structure into
    /// a rigid wall that pushes.
    #[inline]
    pub fn land(&mut self, spans: &[(f64, f64, f64)], frame: &mut Frame<S>) {
        if self.find_blows(spans) && !self.answers(&frame.pushing) {
            self.shift(&mut frame.q);
        }
    }

    /// True if the blows found drive the structure into a rigid wall among `pushing`.
    pub fn answers(&self, pushing: &[usize]) -> bool {
        pushing.iter().any(|&wall| self.drives(wall))
    }

    /// True if this wall is rigid and the blows found drive the structure into it.
    pub fn drives(&self, wall: usize) -> bool {
        let face = self.walls[wall];
        let into = |blows: &Blows<S>| face.sign * S::dot(&self.rows, wall, &blows.given) < 0.0;
        face.law.is_rigid() && self.blows.as_deref().is_some_and(into)
    }

    /// Adds −`scale` C d to `b`: the dampers' momentum over the displacement d that the blows found
    /// cause.
    pub fn damp_shift(&self, scale: f64, b: &mut S::Vector) {
        if let Some(blows) = &self.blows {
            S::add_product(&self.damping, -scale, &blows.shift, b);
        }
    }
}
