//! What a step on a grid did, as the checks of its balance take it.

use crate::step::Step;

/// What a step did, one entry per degree of freedom; or what several steps of one degree of freedom
/// did, one entry per step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepMotion<'a> {
    /// The length of a step, s, and one over it.
    pub h: f64,
    pub per_h: f64,
    /// Displacements at the start and at the end, the latter without what blows add to it, m.
    pub from: &'a [f64],
    pub to: &'a [f64],
    /// Displacement at the end as it is shown, m.
    pub shown: &'a [f64],
    /// Velocities that enter and leave the balance, and the shown one at the end, m/s.
    pub before: &'a [f64],
    pub after: &'a [f64],
    pub v: &'a [f64],
    /// Loads at the start and at the end, and the extra force, N.
    pub load_start: &'a [f64],
    pub load_end: &'a [f64],
    pub extra: &'a [f64],
    /// Impulse of the blows, N s.
    pub blow: &'a [f64],
}

impl<'a> StepMotion<'a> {
    /// Those of a step of `h` seconds (and 1/h) from the displacement `from` to `to`, with its
    /// loads at both ends and its blows.
    #[inline(always)]
    pub fn of(
        step: &Step<'a>,
        (h, per_h): (f64, f64),
        (from, to): (&'a [f64], &'a [f64]),
        (load_start, load_end): (&'a [f64], &'a [f64]),
        blow: &'a [f64],
    ) -> Self {
        let &Step { q: shown, velocity_before: before, velocity_after: after, v, extra, .. } = step;
        Self { h, per_h, from, to, shown, before, after, v, load_start, load_end, extra, blow }
    }
}
