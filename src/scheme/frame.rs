//! The state of a scheme on a grid, and the results of its last step.

use super::space::{Space, add_change, zero};
use crate::error::{Error, Result};
use crate::scene::{Loads, Scene};
use crate::step::{Contact, Contract, Path, Step};

/// Factor by which what a rule carries may exceed the state in [`Frame::flush`].
const LOOSE: f64 = 1e10;

/// The number of the step of `h` seconds that starts at `time` (s) but for rounding, or in which it
/// lies; true in the second case.
pub(super) fn step_at(time: f64, h: f64) -> (u64, bool) {
    let nearest = (time / h).round();
    // The starts of steps are products: 300 · 1e-3 is one unit of rounding more than 0.3.
    let starts = (nearest * h - time).abs() <= 4.0 * f64::EPSILON * time.abs();
    if starts { (nearest as u64, false) } else { ((time / h).floor() as u64, true) }
}

/// What a step covers.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stretch {
    /// A step of the grid.
    Grid,
    /// A step of the grid in which all walls took the same restitution, because with their own ones
    /// no displacement satisfies all bounds.
    OneRestitution,
    /// A part of a step, of this length, s.
    Part(f64),
    /// A part of this length (s) by another scheme, under its contract.
    Other(f64, &'static Contract),
}

/// The state and the results of a step, which a scheme reads and writes, and which is lent out as a
/// [`Step`]. Vectors over degrees of freedom have n entries, those over walls one entry per wall.
#[derive(Debug)]
pub(super) struct Frame<S: Space> {
    pub start: f64,
    pub end: f64,
    /// The state: at the end of the last step, m and m/s.
    pub q: S::Vector,
    pub v: S::Vector,
    /// Velocities that enter and leave the momentum balance, m/s.
    pub before: S::Vector,
    pub after: S::Vector,
    /// Velocity before the step plus the change by its blows, m/s, to which impact laws refer;
    /// valid only if `blown`.
    pub struck: S::Vector,
    /// True if the step had a blow.
    pub blown: bool,
    /// The caller's extra force, N, as it enters the momentum balance.
    pub extra: S::Vector,
    /// True if the extra force of the last step may not be 0.
    pub forced: bool,
    /// Impulse (N s) and force (N) of each wall, signed.
    pub impulse: Vec<f64>,
    pub force: Vec<f64>,
    /// The part of the impulse of each wall that acted at the end of the step, N s.
    pub jump: Vec<f64>,
    /// Friction of each wall, N s, and the normal of each hole; both, and what the turning of the
    /// normal adds, which is nothing here, empty in scenes without friction and round holes.
    pub friction: Vec<f64>,
    pub normal: Vec<[f64; 2]>,
    turned: Vec<[f64; 2]>,
    pub stretch: Stretch,
    /// True if the step of the grid has further parts.
    pub unfinished: bool,
    /// Walls whose rebounds end within the step.
    pub resting: Vec<usize>,
    /// Walls whose impulse is not zero; all others have an impulse and a force of zero.
    pub pushing: Vec<usize>,
}

impl<S: Space> Frame<S> {
    /// The state at the start of `scene`, after any blow at t = 0.
    pub fn new(scene: &Scene) -> Result<Self> {
        let (n, walls) = (scene.initial.q.len(), scene.walls.len());
        let planar = if scene.turns_or_rubs() { walls } else { 0 };
        let mut v = S::vector(&scene.initial.v);
        let mut blow = zero::<S>(n);
        if Loads::new(&scene.loads).initial_blow(blow.as_mut()) {
            S::solve(&mut S::mass(&scene.system.structure())?, &mut blow);
            v.as_mut().iter_mut().zip(blow.as_ref()).for_each(|(v, change)| *v += change);
        }
        Ok(Self {
            start: 0.0,
            end: 0.0,
            q: S::vector(&scene.initial.q),
            before: v.clone(),
            after: v.clone(),
            struck: v.clone(),
            v,
            blown: false,
            extra: zero::<S>(n),
            forced: false,
            impulse: vec![0.0; walls],
            force: vec![0.0; walls],
            jump: vec![0.0; walls],
            friction: vec![0.0; planar],
            normal: vec![[0.0; 2]; planar],
            turned: vec![[0.0; 2]; planar],
            stretch: Stretch::Grid,
            unfinished: false,
            resting: Vec::new(),
            pushing: Vec::with_capacity(walls),
        })
    }

    /// Restarts at `time` (s) from `q` (m) and `v` (m/s), n entries each.
    pub fn restart(&mut self, time: f64, q: &[f64], v: &[f64]) {
        (self.start, self.end, self.blown) = (time, time, false);
        (self.stretch, self.unfinished) = (Stretch::Grid, false);
        self.q.as_mut().copy_from_slice(q);
        for kept in [&mut self.v, &mut self.before, &mut self.after, &mut self.struck] {
            kept.as_mut().copy_from_slice(v);
        }
        self.extra.as_mut().fill(0.0);
        self.forced = false;
        self.take_back_impulses();
    }

    /// Sets the extra force, N, of the step; none is zero.
    #[inline(always)]
    pub fn force(&mut self, extra: Option<&[f64]>) {
        if extra.is_some() || self.forced {
            self.set_extra(extra);
        }
    }

    /// Not inlined: most runs have no extra force.
    #[inline(never)]
    fn set_extra(&mut self, extra: Option<&[f64]>) {
        // A staggered rule has half of the last step's extra force in the frame.
        self.forced = extra.is_some() || self.extra.as_ref().iter().any(|&force| force != 0.0);
        match extra {
            Some(extra) => self.extra.as_mut().copy_from_slice(extra),
            None => self.extra.as_mut().fill(0.0),
        }
    }

    /// Begins step number `step` of `h` seconds: sets its times, and the forces of all walls to
    /// zero.
    #[inline]
    pub fn begin(&mut self, step: u64, h: f64) {
        self.start = step as f64 * h;
        self.end = (step + 1) as f64 * h;
        if !self.pushing.is_empty() {
            self.take_back_impulses();
        }
    }

    /// Sets the forces of all walls to zero, before a new step or before a step is solved again.
    /// Not inlined: most steps touch no wall.
    #[inline(never)]
    pub fn take_back_impulses(&mut self) {
        if !self.friction.is_empty() {
            self.pushing.iter().for_each(|&wall| self.friction[wall] = 0.0);
        }
        for wall in self.pushing.drain(..) {
            self.impulse[wall] = 0.0;
            self.force[wall] = 0.0;
            self.jump[wall] = 0.0;
        }
        self.resting.clear();
    }

    /// Adds the impulse of wall number `wall` in a step of `h` seconds, N s, which is not 0.
    pub fn push(&mut self, wall: usize, impulse: f64, h: f64) {
        (self.impulse[wall], self.force[wall]) = (impulse, impulse / h);
        self.pushing.push(wall);
    }

    /// Adds the impulse of wall number `wall` at the instant that ends the step, N s, which is not
    /// 0.
    pub fn push_at_end(&mut self, wall: usize, impulse: f64) {
        if self.impulse[wall] == 0.0 {
            self.pushing.push(wall);
        }
        self.impulse[wall] += impulse;
        self.jump[wall] = impulse;
    }

    /// Lists the walls whose force is not zero, and sets their impulses: the force times the step
    /// of `h` seconds.
    pub fn push_by_force(&mut self, h: f64) {
        for (wall, &force) in self.force.iter().enumerate().filter(|(_, force)| **force != 0.0) {
            self.impulse[wall] = h * force;
            self.pushing.push(wall);
        }
    }

    /// Advances the state by a step of the θ-rule, (h, θ), that changes the velocity by `delta`.
    #[inline(always)]
    pub fn add_change(&mut self, rule: (f64, f64), delta: &S::Vector) {
        add_change::<S>(rule, delta, &mut self.q, &mut self.v);
        self.after.clone_from(&self.v);
    }

    /// Velocity to which impact laws refer, m/s: before the step, with its blows.
    #[inline]
    pub fn struck(&self) -> &S::Vector {
        if self.blown { &self.struck } else { &self.before }
    }

    /// Sets to 0 each degree of freedom whose displacement and velocity times h are below `tiny`
    /// (m), and what the rule has `carried` is as small, up to a factor for masses and damping.
    pub fn flush(&mut self, tiny: f64, h: f64, mut carried: [Option<(&mut S::Vector, i32)>; 2]) {
        let far = |x: f64, power: i32| x.abs() * h.powi(power) >= LOOSE * tiny;
        for (i, (q, v)) in self.q.as_mut().iter_mut().zip(self.v.as_mut()).enumerate() {
            let moves = q.abs() >= tiny || v.abs() * h >= tiny;
            if moves || carried.iter().flatten().any(|(x, power)| far(x.as_ref()[i], *power)) {
                continue;
            }
            (*q, *v) = (0.0, 0.0);
            carried.iter_mut().flatten().for_each(|(x, _)| x.as_mut()[i] = 0.0);
        }
    }

    /// An error if the state is not finite.
    #[inline(always)]
    pub fn check(&self, step: u64) -> Result<()> {
        if all_finite(self.q.as_ref()) && all_finite(self.v.as_ref()) { Ok(()) } else { Err(self.refusal(step)) }
    }

    #[cold]
    fn refusal(&self, step: u64) -> Error {
        let what = if all_finite(self.q.as_ref()) { "velocity" } else { "displacement" };
        Error::NotFinite { time: self.end, step, what }
    }

    /// Step number `index`, with the contacts that ended in it. Inlined, so that the compiler
    /// leaves out the fields that a caller does not read.
    #[inline(always)]
    pub fn step<'a>(&'a self, index: u64, closed: &'a [Contact]) -> Step<'a> {
        Step {
            index,
            start: self.start,
            end: self.end,
            q: self.q.as_ref(),
            v: self.v.as_ref(),
            velocity_before: self.before.as_ref(),
            velocity_after: self.after.as_ref(),
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            friction: &self.friction,
            normal: &self.normal,
            turned: &self.turned,
            wedged: &[],
            resting: &self.resting,
            extra: self.extra.as_ref(),
            closed,
            path: match self.stretch {
                Stretch::Grid => Path::Grid,
                Stretch::OneRestitution => Path::OneRestitution,
                Stretch::Part(length) => Path::Part { length },
                Stretch::Other(step, contract) => Path::Handed { contract, step },
            },
        }
    }
}

/// True if every number is finite. There is no branch per entry, so that the compiler can check
/// several at once.
#[inline(always)]
pub(super) fn all_finite(x: &[f64]) -> bool {
    x.iter().fold(true, |all, x| all & x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::super::matrices::Matrices;
    use super::*;
    use crate::linear::Symmetric;
    use crate::scene::Structure;

    #[test]
    fn a_state_with_one_number_that_is_not_finite_is_refused_and_what_it_is_said() {
        let pair = |x: f64| Symmetric::diagonal(&[x, x]);
        let scene = Scene::structure(Structure { mass: pair(1.0), damping: pair(0.0), stiffness: pair(1.0) });
        let mut frame = Frame::<Matrices>::new(&scene).unwrap();
        frame.begin(7, 0.5);
        assert_eq!(frame.check(7), Ok(()));
        let refused = |what| Err(Error::NotFinite { time: 4.0, step: 7, what });
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            frame.restart(4.0, &[0.0, wrong], &[0.0, 0.0]);
            assert_eq!(frame.check(7), refused("displacement"));
            frame.restart(4.0, &[0.0, 0.0], &[wrong, 0.0]);
            assert_eq!(frame.check(7), refused("velocity"));
        }
    }
}
