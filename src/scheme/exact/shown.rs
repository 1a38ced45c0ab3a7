//! What a step of the exact schemes shows besides the state at its end.

use super::super::space::{Space, zero};
use crate::step::{Contact, Path, Step};

/// The last step. Vectors over walls have one entry per wall, then one per round hole, where an
/// impulse or force has the sign of an upper wall's.
#[derive(Debug, Clone)]
pub(in crate::scheme) struct StepOutput<S: Space> {
    pub start: f64,
    /// Velocity at the start, m/s, from the right.
    pub before: S::Vector,
    /// The caller's extra force, N.
    pub extra: S::Vector,
    /// Impulse of each wall (N s, signed), the part of it at the instant of the end, and its force
    /// there (N, signed).
    pub impulse: Vec<f64>,
    pub jump: Vec<f64>,
    pub force: Vec<f64>,
    /// The normal of each hole, what its turning adds to the impulse, N s, and the friction of each
    /// wall, N s, which is 0; all empty in scenes without holes.
    pub normal: Vec<[f64; 2]>,
    pub turned: Vec<[f64; 2]>,
    pub friction: Vec<f64>,
    /// Contact episodes that the step closed.
    pub closed: Vec<Contact>,
}

impl<S: Space> StepOutput<S> {
    /// Before the first step, at the velocity `v` (m/s), in a scene with so many walls, of which
    /// some are `round` or none is. A step that closes more than `contacts` episodes allocates.
    pub fn new(v: &S::Vector, (walls, round): (usize, bool), contacts: usize) -> Self {
        let planar = if round { walls } else { 0 };
        Self {
            start: 0.0,
            before: v.clone(),
            extra: zero::<S>(v.as_ref().len()),
            impulse: vec![0.0; walls],
            jump: vec![0.0; walls],
            force: vec![0.0; walls],
            normal: vec![[0.0; 2]; planar],
            turned: vec![[0.0; 2]; planar],
            friction: vec![0.0; planar],
            closed: Vec::with_capacity(contacts),
        }
    }

    /// Begins a step at `time` (s) with the velocity `v` (m/s).
    pub fn begin(&mut self, time: f64, v: &S::Vector) {
        self.closed.clear();
        self.impulse.fill(0.0);
        self.jump.fill(0.0);
        self.normal.fill([0.0; 2]);
        self.turned.fill([0.0; 2]);
        self.start = time;
        self.before.clone_from(v);
    }

    /// True if a wall gave an impulse at the instant of the end.
    pub fn jumped(&self) -> bool {
        self.jump.iter().any(|&p| p != 0.0)
    }

    /// Adds the impulses at the instant of the end to those of the step.
    pub fn add_jumps(&mut self) {
        for (impulse, jump) in self.impulse.iter_mut().zip(&self.jump) {
            *impulse += jump;
        }
    }

    /// Step number `index`, which has ended at `end` (s) in the state `q` (m), `v` (m/s).
    pub fn step<'a>(&'a self, index: u64, end: f64, (q, v): (&'a [f64], &'a [f64]), path: Path<'a>) -> Step<'a> {
        Step {
            index,
            start: self.start,
            end,
            q,
            v,
            velocity_before: self.before.as_ref(),
            velocity_after: v,
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            friction: &self.friction,
            normal: &self.normal,
            turned: &self.turned,
            wedged: &[],
            resting: &[],
            extra: self.extra.as_ref(),
            closed: &self.closed,
            path,
        }
    }
}
