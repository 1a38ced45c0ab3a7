//! The state that a scheme carries, and what it shows of each step.

use super::factor::mass_factor;
use crate::error::{Error, Result};
use crate::scene::{Loads, Scene};
use crate::scheme::grid::all_finite;
use crate::step::{Contact, Path, Step};

/// What a kernel reads and writes of each step; lent out as a [`Step`]. Vectors over degrees of freedom have n entries, those over walls as
/// many as there are.
#[derive(Debug)]
pub(super) struct Frame {
    pub start: f64,
    pub end: f64,
    /// The state: at the end of the last step, m and m/s.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// Velocities that enter and leave the momentum balance, m/s.
    pub before: Vec<f64>,
    pub after: Vec<f64>,
    /// Velocity that a wall answers, m/s: `before` and the blows of the step; good where there are blows.
    pub struck: Vec<f64>,
    /// True if the step had a blow.
    pub blown: bool,
    /// The caller's extra force, N, as it enters the balance.
    pub extra: Vec<f64>,
    /// Impulse (N s) and force (N) of each wall, signed.
    pub impulse: Vec<f64>,
    pub force: Vec<f64>,
    jump: Vec<f64>,
    /// True if all walls took one restitution in the step, because with their own no displacement keeps all bounds.
    pub one_restitution: bool,
    /// Walls whose impulse is not zero; all others have an impulse and a force of zero.
    pub pushing: Vec<usize>,
}

impl Frame {
    /// The start of `scene`, after any blow at t = 0.
    pub fn new(scene: &Scene) -> Result<Self> {
        let (n, walls) = (scene.initial.q.len(), scene.walls.len());
        let mut v = scene.initial.v.clone();
        let loads = Loads::new(&scene.loads);
        let mut blow = vec![0.0; n];
        if loads.initial_blow(&mut blow) {
            mass_factor(&scene.system.structure())?.solve(&mut blow);
            v.iter_mut().zip(&blow).for_each(|(v, change)| *v += change);
        }
        Ok(Self {
            start: 0.0,
            end: 0.0,
            q: scene.initial.q.clone(),
            before: v.clone(),
            after: v.clone(),
            struck: v.clone(),
            v,
            blown: false,
            extra: vec![0.0; n],
            impulse: vec![0.0; walls],
            force: vec![0.0; walls],
            jump: vec![0.0; walls],
            one_restitution: false,
            pushing: Vec::with_capacity(walls),
        })
    }

    /// Takes the motion up anew at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    pub fn restart(&mut self, time: f64, q: &[f64], v: &[f64]) {
        (self.start, self.end, self.blown) = (time, time, false);
        self.q.copy_from_slice(q);
        for kept in [&mut self.v, &mut self.before, &mut self.after, &mut self.struck] {
            kept.copy_from_slice(v);
        }
        self.extra.fill(0.0);
        for wall in self.pushing.drain(..) {
            self.impulse[wall] = 0.0;
            self.force[wall] = 0.0;
        }
    }

    /// Begins a step of `h` seconds, number `step`: its times, and no wall touched yet.
    #[inline]
    pub fn begin(&mut self, step: u64, h: f64) {
        self.start = step as f64 * h;
        self.end = (step + 1) as f64 * h;
        self.let_go();
    }

    /// Forgets the walls of a step that is solved once more.
    pub fn let_go(&mut self) {
        for wall in self.pushing.drain(..) {
            self.impulse[wall] = 0.0;
            self.force[wall] = 0.0;
        }
    }

    /// Lists the walls whose force is not zero, over the whole of a step of `h` seconds.
    pub fn push_by_force(&mut self, h: f64) {
        for (wall, &force) in self.force.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            self.impulse[wall] = h * force;
            self.pushing.push(wall);
        }
    }

    /// Velocity that a wall answers, m/s.
    #[inline]
    pub fn struck(&self) -> &[f64] {
        if self.blown { &self.struck } else { &self.before }
    }

    /// Refuses a state that is not finite.
    #[inline]
    pub fn check(&self, step: u64) -> Result<()> {
        if all_finite(&self.q) && all_finite(&self.v) {
            return Ok(());
        }
        let what = if all_finite(&self.q) { "velocity" } else { "displacement" };
        Err(Error::NotFinite { time: self.end, step, what })
    }

    pub fn step<'a>(&'a self, index: u64, closed: &'a [Contact]) -> Step<'a> {
        Step {
            index,
            start: self.start,
            end: self.end,
            q: &self.q,
            v: &self.v,
            velocity_before: &self.before,
            velocity_after: &self.after,
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            extra: &self.extra,
            closed,
            path: if self.one_restitution { Path::OneRestitution } else { Path::Grid },
        }
    }
}
