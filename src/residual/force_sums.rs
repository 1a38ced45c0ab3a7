//! Sums of the forces on each degree of freedom over the steps of a run.

use super::scratch::{Balanced, Scratch};
use super::weights::Weights;
use crate::linear::{Lanes, Pass, pass, running_max};
use pulp::Simd;

/// Load and own force of the structure on one degree of freedom: their values in the last step, N,
/// the sum of the changes of both from step to step, N, the largest sum of sizes, N, and the
/// momentum exchanged, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Forces {
    pub load: f64,
    pub own: f64,
    pub changes: f64,
    pub largest: f64,
    pub exchanged: f64,
}

impl Forces {
    /// Adds a step's load, own force and damper force, N; the changes of the first two from the
    /// last step are summed, except in the `first` step of a run.
    #[inline(always)]
    pub fn add(&mut self, first: bool, h: f64, [load, own, damper]: [f64; 3]) {
        if !first {
            self.changes += (load - self.load).abs() + (own - self.own).abs();
        }
        (self.load, self.own) = (load, own);
        self.largest = running_max(self.largest, load.abs() + own.abs() + damper.abs());
        self.exchanged += h * (load + own + damper).abs();
    }
}

/// The forces on each degree of freedom: every entry of [`Forces`] as a vector.
#[derive(Debug, Clone, Default)]
pub(super) struct ForceSums {
    pub load: Vec<f64>,
    pub own: Vec<f64>,
    pub changes: Vec<f64>,
    pub largest: Vec<f64>,
    pub exchanged: Vec<f64>,
}

impl ForceSums {
    /// Zeros for n degrees of freedom.
    pub fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self { load: zero(), own: zero(), changes: zero(), largest: zero(), exchanged: zero() }
    }

    /// Those on degree of freedom `i`.
    pub fn of(&self, i: usize) -> Forces {
        Forces {
            load: self.load[i],
            own: self.own[i],
            changes: self.changes[i],
            largest: self.largest[i],
            exchanged: self.exchanged[i],
        }
    }

    /// Sets those on degree of freedom `i`.
    pub fn set(&mut self, i: usize, forces: Forces) {
        let Forces { load, own, changes, largest, exchanged } = forces;
        (self.load[i], self.own[i]) = (load, own);
        (self.changes[i], self.largest[i], self.exchanged[i]) = (changes, largest, exchanged);
    }

    /// Its vectors, in their order.
    #[inline(always)]
    fn columns(&mut self) -> [&mut [f64]; 5] {
        let Self { load, own, changes, largest, exchanged } = self;
        [load, own, changes, largest, exchanged]
    }

    /// As [`Forces::add`] on each of n degrees of freedom, for the load of a step, N, and the
    /// momentum that springs and dampers take in it, N s.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        first: bool,
        (h, per_h): (f64, f64),
        [load, spring, damper]: [&[f64]; 3],
        n: usize,
    ) {
        let [] = pass(simd, n, ([load, spring, damper], self.columns()), &AddForces::new((h, per_h), first));
    }

    /// As [`ForceSums::add`] for a step whose means are in `means`, and adds the terms of inertia,
    /// damping and stiffness to the balance there as [`Scratch::products`] does, where M, C and K
    /// have no entries but these `diagonals`. Returns the largest force in a balance so far, N/√kg:
    /// `scale` before.
    #[allow(clippy::too_many_arguments)]
    #[inline(always)]
    pub fn add_products<S: Simd>(
        &mut self,
        simd: S,
        [m, c, k]: [&[f64]; 3],
        means: &mut Scratch,
        (hs, first): ((f64, f64), bool),
        blow: &[f64],
        weights: &Weights,
        n: usize,
        scale: f64,
    ) -> f64 {
        let Scratch { load, mean_q, mean_v, gained, residual, .. } = means;
        let read = [&gained[..], mean_v, mean_q, m, c, k, load, blow, &weights.per_root_mass];
        let [last_load, own, changes, largest, exchanged] = self.columns();
        let written = [&mut residual[..], last_load, own, changes, largest, exchanged];
        let what = DiagonalProducts { balanced: Balanced { per_h: hs.1 }, sums: AddForces::new(hs, first) };
        let [largest] = pass(simd, n, (read, written), &what);
        largest.largest(scale)
    }
}

/// From the load of a step of h seconds, N, and the momentum that springs and dampers take in it, N
/// s: the entries of [`ForceSums`] with these, in its order. The changes count `changed` times.
struct AddForces {
    h: f64,
    per_h: f64,
    changed: f64,
}

impl AddForces {
    /// Of a step of `h` seconds (and 1/h), perhaps the `first` of a run.
    #[inline(always)]
    fn new((h, per_h): (f64, f64), first: bool) -> Self {
        Self { h, per_h, changed: if first { 0.0 } else { 1.0 } }
    }
}

impl Pass<3, 5, 0> for AddForces {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [load, spring, damper]: [Lanes<S>; 3],
        [last_load, last_own, changes, largest, exchanged]: [Lanes<S>; 5],
        _: [Lanes<S>; 0],
    ) -> ([Lanes<S>; 5], [Lanes<S>; 0]) {
        let (own, damper) = (spring * -self.per_h, damper * -self.per_h);
        let change = (load - last_load).abs() + (own - last_own).abs();
        let size = load.abs() + own.abs() + damper.abs();
        let passed = (load + own + damper).abs() * self.h;
        ([load, own, changes + change * self.changed, largest.max(size), exchanged + passed], [])
    }
}

/// From the change of velocity, mean velocity and mean displacement in a step, the diagonals of M,
/// C and K, the load, N, the blow, N s, and 1/√m: what [`Balanced`] and [`AddForces`] write.
struct DiagonalProducts {
    balanced: Balanced,
    sums: AddForces,
}

impl Pass<9, 6, 1> for DiagonalProducts {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [gained, mean_v, mean_q, m, c, k, load, blow, per_root]: [Lanes<S>; 9],
        [open, sums @ ..]: [Lanes<S>; 6],
        largest: [Lanes<S>; 1],
    ) -> ([Lanes<S>; 6], [Lanes<S>; 1]) {
        let h = self.sums.h;
        let (inertia, damper, spring) = (m * gained, c * h * mean_v, k * h * mean_q);
        let ([open], largest) = self.balanced.of([inertia, damper, spring, load, blow, per_root], [open], largest);
        let ([a, b, c, d, e], []) = self.sums.of([load, spring, damper], sums, []);
        ([open, a, b, c, d, e], largest)
    }
}
