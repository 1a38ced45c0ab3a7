//! Sums over steps, for the check of a whole run's momentum.

use super::matrices::{Matrices, Part};
use super::scratch::Scratch;
use super::step_motion::StepMotion;
use crate::linear::{Lanes, Pass, pass, running_max};
use crate::scene::Scene;
use crate::step::Step;
use pulp::Simd;
use std::ops::{Add, Sub};

/// A sum and the rounding error of it so far, with `x` added (Kahan 1965,
/// doi:10.1145/363707.363723): where something rests, each of 1e7 equal terms would be rounded to
/// the same side.
#[inline(always)]
pub(super) fn compensated<T: Copy + Add<Output = T> + Sub<Output = T>>([sum, lost]: [T; 2], x: T) -> [T; 2] {
    let term = x - lost;
    let next = sum + term;
    [next, (next - sum) - term]
}

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
    fn new(n: usize) -> Self {
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

    /// As [`Forces::add`] on each of n degrees of freedom, for the load of a step, N, and the
    /// momentum that springs and dampers take in it, N s.
    #[inline(always)]
    fn add<S: Simd>(
        &mut self,
        simd: S,
        first: bool,
        (h, per_h): (f64, f64),
        [load, spring, damper]: [&[f64]; 3],
        n: usize,
    ) {
        let Self { load: last_load, own, changes, largest, exchanged } = self;
        let sums = [&mut last_load[..], own, changes, largest, exchanged];
        let changed = if first { 0.0 } else { 1.0 };
        let [] = pass(simd, n, ([load, spring, damper], sums), &AddForces { h, per_h, changed });
    }
}

/// From the load of a step of h seconds, N, and the momentum that springs and dampers take in it, N
/// s: the entries of [`ForceSums`] with these, in its order. The changes count `changed` times.
struct AddForces {
    h: f64,
    per_h: f64,
    changed: f64,
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

/// Sums over the steps of a run on a grid; vectors have one entry per degree of freedom or per
/// wall.
#[derive(Debug)]
pub(super) struct MomentumSums {
    /// Displacement and velocity at the start of the run, m and m/s, and velocity at the end of the
    /// last step.
    pub start: Vec<f64>,
    pub first: Vec<f64>,
    pub last: Vec<f64>,
    /// ∫q dt (m s), ∫v dt (m) and ∫f dt (N s). ∫v is used for a rule whose walls correct the
    /// displacement besides the velocity; for all others it is the displacement from start to end.
    pub place: Vec<f64>,
    pub rate: Vec<f64>,
    pub load: Vec<f64>,
    /// The rounding errors of these three sums.
    lost: [Vec<f64>; 3],
    /// The forces on each degree of freedom.
    pub forces: ForceSums,
    /// Sum of each wall's impulses over the steps seen, N s, and the sum of their magnitudes.
    pub seen: Vec<f64>,
    pub sizes: Vec<f64>,
    /// The recorder's value of that sum, once [`Judge::hear`](super::Judge::hear) has been called.
    pub recorded: Option<Vec<f64>>,
    pub steps: u64,
    /// True once a step or an impact has begun the sums.
    begun: bool,
    /// Start of the first step, s.
    pub from: f64,
    /// True as long as every step was one of the run's own grid, and no wall answered a blow under
    /// a staggered rule. Such a rule then either keeps the blow's instant or leaves out what the
    /// damper feels of it, and the ends of the run do not tell which.
    pub whole: bool,
}

impl MomentumSums {
    pub fn new(scene: &Scene, q: &[f64], v: &[f64]) -> Self {
        let (n, walls) = (v.len(), scene.walls.len());
        let zero = || vec![0.0; n];
        Self {
            start: q.to_vec(),
            first: v.to_vec(),
            last: v.to_vec(),
            place: zero(),
            rate: zero(),
            load: zero(),
            lost: [(); 3].map(|()| zero()),
            forces: ForceSums::new(n),
            seen: vec![0.0; walls],
            sizes: vec![0.0; walls],
            recorded: None,
            steps: 0,
            begun: false,
            from: 0.0,
            whole: true,
        }
    }

    /// Begins the sums with the first step of a run.
    #[inline(always)]
    pub fn begin(&mut self, step: &Step<'_>) {
        if !self.begun {
            (self.begun, self.from) = (true, step.start);
            // A staggered rule balances momentum from half a step before the start to half a step
            // before the end, whatever velocities it shows there.
            self.first.copy_from_slice(step.velocity_before);
        }
    }

    /// Adds a step, whose mean forces are in `means`.
    #[inline(always)]
    pub fn add<S: Simd>(&mut self, simd: S, moves: &StepMotion<'_>, means: &Scratch, first: bool, n: usize) {
        let hs = (moves.h, moves.per_h);
        self.forces.add(simd, first, hs, [&means.load, &means.spring, &means.damper], n);
        self.add_ends(simd, moves, n);
    }

    /// Adds the state at the ends of a step and its loads.
    #[inline(always)]
    pub fn add_ends<S: Simd>(&mut self, simd: S, moves: &StepMotion<'_>, n: usize) {
        let &StepMotion { h, from, shown, load_start, load_end, extra, after, .. } = moves;
        let [place_lost, _, load_lost] = &mut self.lost;
        let sums = [&mut self.place[..], place_lost, &mut self.load, load_lost, &mut self.last];
        let [] = pass(simd, n, ([from, shown, load_start, load_end, extra, after], sums), &AddEnds { h });
    }

    /// Adds the way of a step of `h` seconds to `rate`, by the velocities at its ends, of which the
    /// first is that at the end of the step before.
    pub fn add_way(&mut self, h: f64, velocity_after: &[f64]) {
        let [_, lost, _] = &mut self.lost;
        let ends = self.last.iter().zip(velocity_after);
        for ((rate, lost), (before, after)) in self.rate.iter_mut().zip(lost).zip(ends) {
            [*rate, *lost] = compensated([*rate, *lost], 0.5 * h * (before + after));
        }
    }

    /// Adds the change of the structure's own force by the displacement `beyond` (m) that blows add
    /// to a step's rule: the ends of the step and of the next contain it, and the mean force of
    /// neither need do so. `work` has the length of `beyond`.
    pub fn displace(&mut self, matrices: &Matrices, beyond: &[f64], work: &mut [f64]) {
        matrices.product(Part::Stiffness, 1.0, beyond, work);
        self.forces.changes.iter_mut().zip(work).for_each(|(sum, change)| *sum += change.abs());
    }

    /// Adds n steps of one degree of freedom without extra force, after the first.
    #[inline(always)]
    pub fn add_all(&mut self, moves: &StepMotion<'_>, means: &Scratch, n: usize) {
        let ([place], [load], [place_lost, _, load_lost]) = (&mut self.place[..], &mut self.load[..], &mut self.lost)
        else {
            return;
        };
        let (mean, spring, damper) = (&means.load[..n], &means.spring[..n], &means.damper[..n]);
        let &StepMotion { h, per_h, .. } = moves;
        let mut sum = self.forces.of(0);
        for i in 0..n {
            sum.add(false, h, own([mean[i], spring[i], damper[i]], per_h));
        }
        self.forces.set(0, sum);
        let ends = |start: &[f64], end: &[f64]| 0.5 * h * start.iter().zip(end).map(|(a, b)| a + b).sum::<f64>();
        let sums = [(place, place_lost, moves.from, moves.shown), (load, load_lost, moves.load_start, moves.load_end)];
        for (sum, lost, start, end) in sums {
            [*sum, lost[0]] = compensated([*sum, lost[0]], ends(&start[..n], &end[..n]));
        }
        self.last.fill(moves.after[n - 1]);
    }
}

/// From the displacements and loads (N) at both ends of a step of h seconds, the extra force, N,
/// and the velocity at its end: ∫q dt and ∫f dt with these, and that velocity.
struct AddEnds {
    h: f64,
}

impl Pass<6, 5, 0> for AddEnds {
    #[inline(always)]
    fn of<S: Simd>(
        &self,
        [q0, q1, start, end, extra, after]: [Lanes<S>; 6],
        [place, place_lost, load, load_lost, _]: [Lanes<S>; 5],
        _: [Lanes<S>; 0],
    ) -> ([Lanes<S>; 5], [Lanes<S>; 0]) {
        let half = 0.5 * self.h;
        let [place, place_lost] = compensated([place, place_lost], (q0 + q1) * half);
        let [load, load_lost] = compensated([load, load_lost], (start + end) * half + extra * self.h);
        ([place, place_lost, load, load_lost, after], [])
    }
}

/// The mean load of a step, N, and the mean forces of the structure's springs and dampers, which
/// are given with the opposite sign times the step: N s. The mean force is summed without dampers,
/// whose impulse follows exactly from the displacement between start and end.
#[inline(always)]
fn own([load, spring, damper]: [f64; 3], per_h: f64) -> [f64; 3] {
    [load, -spring * per_h, -damper * per_h]
}
