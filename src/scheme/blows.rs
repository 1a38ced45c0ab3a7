//! The impulsive loads ("blows") of a scene in a step: their momentum, the change of velocity and
//! the displacement within the step that they cause.

use super::frame::Frame;
use super::space::{Space, zero};
use crate::error::Result;
use crate::scene::{Loads, Scene, SharedStructure};

/// The blows, and the effect of those found last. No function here is inlined, since most scenes
/// have no blows.
#[derive(Debug)]
pub(super) struct Blows<S: Space> {
    loads: Loads,
    /// M.
    inertia: S::Factor,
    blow: S::Vector,
    /// The displacement that they cause in addition to that by the rule of the step, m, and the
    /// change of velocity, m/s.
    pub shift: S::Vector,
    pub given: S::Vector,
}

impl<S: Space> Blows<S> {
    /// The blows of `scene`; `None` if it has none.
    pub fn new(scene: &Scene, structure: &SharedStructure) -> Result<Option<Self>> {
        let (loads, n) = (Loads::new(&scene.loads), structure.mass.size());
        if !loads.has_blows() {
            return Ok(None);
        }
        let [blow, shift, given] = [zero::<S>(n), zero::<S>(n), zero::<S>(n)];
        Ok(Some(Self { loads, inertia: S::mass(structure)?, blow, shift, given }))
    }

    /// As [`Body::strike`](super::body::Body::strike).
    #[inline(never)]
    pub fn strike(&mut self, (from, to): (f64, f64), scale: f64, b: &mut S::Vector, frame: &mut Frame<S>) -> bool {
        let any = self.loads.blow(from, to, self.blow.as_mut());
        if any {
            self.apply(scale, b, frame);
        }
        any
    }

    /// As [`Body::strike_about`](super::body::Body::strike_about), with the time at which the
    /// motion began.
    #[inline(never)]
    pub fn strike_about(
        &mut self,
        (since, step, h): (f64, u64, f64),
        scale: f64,
        b: &mut S::Vector,
        frame: &mut Frame<S>,
    ) -> bool {
        let any = self.loads.blow_about_since(since, step, h, self.blow.as_mut());
        if any {
            self.apply(scale, b, frame);
        }
        any
    }

    fn apply(&mut self, scale: f64, b: &mut S::Vector, frame: &mut Frame<S>) {
        let Self { blow, inertia, .. } = self;
        b.as_mut().iter_mut().zip(blow.as_ref()).for_each(|(b, blow)| *b += scale * blow);
        S::solve(inertia, blow);
        let after = frame.before.as_ref().iter().zip(blow.as_ref()).map(|(v, change)| v + change);
        frame.struck.as_mut().iter_mut().zip(after).for_each(|(struck, v)| *struck = v);
    }

    /// As [`Body::find_blows`](super::body::Body::find_blows).
    #[inline(never)]
    pub fn find(&mut self, spans: &[(f64, f64, f64)]) -> bool {
        let Self { loads, inertia, blow, shift, given } = self;
        let mut any = false;
        shift.as_mut().fill(0.0);
        given.as_mut().fill(0.0);
        for &(from, to, about) in spans {
            any |= loads.blow(from, to, blow.as_mut());
            given.as_mut().iter_mut().zip(blow.as_ref()).for_each(|(sum, blow)| *sum += blow);
            any |= loads.blow_moment(from, to, about, blow.as_mut());
            shift.as_mut().iter_mut().zip(blow.as_ref()).for_each(|(sum, blow)| *sum += blow);
        }
        if any {
            S::solve(inertia, shift);
            S::solve(inertia, given);
        }
        any
    }

    /// The instants of the blows after t = 0, s.
    pub fn instants(&self) -> impl Iterator<Item = f64> + '_ {
        let all = self.loads.parts().iter().flat_map(|(_, forcing)| &forcing.impulses);
        all.map(|&(time, _)| time).filter(|&time| time > 0.0)
    }

    /// Adds the change of velocity by the blows in (from, to] (s) to `v`. Returns whether there was
    /// one.
    pub fn kick(&mut self, from: f64, to: f64, v: &mut S::Vector) -> bool {
        let any = self.loads.blow(from, to, self.blow.as_mut());
        if any {
            S::solve(&mut self.inertia, &mut self.blow);
            v.as_mut().iter_mut().zip(self.blow.as_ref()).for_each(|(v, change)| *v += change);
        }
        any
    }
}
