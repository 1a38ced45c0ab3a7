//! The loop over a group of lanes: each lane computes one oscillator until it is done, and then the
//! next.

use super::slots::{Group, LaneJob, Results};
use super::state::State;
use super::vector::{Mask, Vector};
use pulp::{Simd, WithSimd};

/// Maximum number of impacts in a period; with more, the oscillator is left to the scheme `event`.
const MOST_IMPACTS: f64 = 4096.0;

/// Smallest share of a step that is tried: an oscillator undecided there (a grazing contact, to
/// rounding) is left to the scheme `event`.
const LEAST_SHARE: f64 = 1e-6;

/// The oscillators to compute, with at most `W` sines each.
pub(super) struct Engine<'a, const W: usize> {
    pub guests: &'a [LaneJob<'a>],
    pub results: Results<'a>,
}

impl<const W: usize> WithSimd for Engine<'_, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { guests, mut results } = self;
        let zero = Vector::splat(simd, 0.0);
        let mut group = Group::<S, W>::new(simd);
        let mut next = 0;
        (0..S::F64_LANES).for_each(|slot| group.fill(slot, guests, &mut next, &mut results));
        loop {
            let active = group.busy.gt(zero);
            if !active.any() {
                return;
            }
            let mut a = group.state;
            let mut held = !active;
            loop {
                let (b, stop) = group.constants.march(&a);
                held = held | stop;
                a = a.or(held, &b);
                if held.every() {
                    break;
                }
            }
            let ended = group.constants.stretch(&mut a, active);
            group.constants.restart(&mut a, ended.strobed);
            group.state = a;
            group.count(&ended);
            let [lower, upper] = ended.struck;
            let arrived = (a.w * a.w).le(group.constants.tail);
            let stuck = !a.share.gt(zero.all(LEAST_SHARE));
            let lost = active & (stuck | group.recent().gt(zero.all(MOST_IMPACTS)));
            if !(ended.strobed | lost | ((lower | upper) & arrived)).any() {
                continue;
            }
            // What happened: undecided, end of a period, arrival at the lower or the upper wall
            // almost without speed.
            let one = zero.all(1.0);
            let (lost, strobed) = (lost.pick(one, zero), ended.strobed.pick(one, zero));
            let (lower, upper) = ((lower & arrived).pick(one, zero), (upper & arrived).pick(one, zero));
            for slot in 0..S::F64_LANES {
                let (lost, strobed) = (lost.get(slot) > 0.0, strobed.get(slot) > 0.0);
                let (lower, upper) = (lower.get(slot) > 0.0, upper.get(slot) > 0.0);
                let over = lost
                    || (strobed && group.strobe(slot, guests, &mut results))
                    || ((lower || upper) && group.arrive(slot, usize::from(upper), guests, &mut results));
                if over {
                    group.fill(slot, guests, &mut next, &mut results);
                }
            }
        }
    }
}

impl<S: Simd, const W: usize> State<S, W> {
    /// This state in the lanes that are `held`, `b` in the others.
    #[inline(always)]
    fn or(&self, held: Mask<S>, b: &Self) -> Self {
        let mut c = *b;
        c.t = held.pick(self.t, b.t);
        c.u = held.pick(self.u, b.u);
        c.w = held.pick(self.w, b.w);
        for (new, old) in c.phase.iter_mut().zip(&self.phase) {
            new[0] = held.pick(old[0], new[0]);
            new[1] = held.pick(old[1], new[1]);
        }
        for (new, old) in c.tangent.iter_mut().zip(self.tangent) {
            *new = held.pick(old, *new);
        }
        c
    }
}
