//! Cost of a step's programme: the clamp, bare Clarabel (`update_q`, `update_b`, `solve`), the
//! polished solver, and the condensed one against a loop by hand and, with more rows than unknowns,
//! against Clarabel, measured in turn in one run. Prints tables; asserts nothing about time.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSolver, IPSolver, NonnegativeConeT};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, ScalarRow, Solver, clamp};
use std::hint::black_box;

#[path = "support/beam.rs"]
mod beam;
mod support;
use support::{clarabel_settings, race, time};

/// Number of rounds, of which the best counts; the sides alternate within each.
const ROUNDS: usize = 15;

/// A chain of n springs with a box of ±1 on every unknown; loads that push a varying part of it
/// against the walls.
fn chain(n: usize) -> (Problem, Vec<Vec<f64>>) {
    let a = Symmetric::from_entries(n, (0..n).map(|i| (i, i, 3.0)).chain((1..n).map(|i| (i, i - 1, -1.0))));
    let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
    let problem = Problem { a, g, compliance: vec![0.0; n] };
    let loads = (0..64)
        .map(|step| (0..n).map(|i| 5.0 * (0.37 * f64::from(step) + 0.9 * i as f64).sin() + 4.0).collect())
        .collect();
    (problem, loads)
}

fn by_columns(height: usize, columns: &[Vec<(usize, f64)>]) -> CscMatrix<f64> {
    let (mut starts, mut rows, mut values) = (vec![0], vec![], vec![]);
    for column in columns {
        rows.extend(column.iter().map(|entry| entry.0));
        values.extend(column.iter().map(|entry| entry.1));
        starts.push(rows.len());
    }
    CscMatrix::new(height, columns.len(), starts, rows, values)
}

/// Clarabel as one would call it by hand, at the same tolerance, on the same (already
/// dimensionless) programme.
fn bare(problem: &Problem) -> DefaultSolver<f64> {
    let n = problem.a.size();
    // Rows of the lower triangle are columns of the upper one; a box's rows are its columns.
    let mut columns = vec![vec![]; n];
    problem.a.entries().for_each(|(i, j, value)| columns[i].push((j, value)));
    let cost = by_columns(n, &columns);
    let rows = by_columns(2 * n, &(0..n).map(|i| vec![(i, 1.0), (n + i, -1.0)]).collect::<Vec<_>>());
    DefaultSolver::new(&cost, &vec![0.0; n], &rows, &vec![1.0; 2 * n], &[NonnegativeConeT(2 * n)], clarabel_settings())
        .expect("a sound programme")
}

/// h²θ²k of a chain of masses 1 and springs 1e4 at h = 1e-3, θ = ½: A = (1 + 2c) I − c
/// (neighbours), in velocities.
const COUPLING: f64 = 0.0025;

/// b, lo and hi of one step.
type Step = (Vec<f64>, Vec<f64>, Vec<f64>);

/// Programmes of moreau-jean on that chain: every mass between stops at ±1e-3 m without
/// restitution, driven so that about a fifth are in contact. Bounds are 0 where a stop is reached
/// and infinite elsewhere.
fn programmes(n: usize, count: usize) -> (Problem, Vec<Step>) {
    let chain = (0..n).map(|i| (i, i, 1.0 + 2.0 * COUPLING)).chain((1..n).map(|i| (i, i - 1, -COUPLING)));
    let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
    let problem = Problem { a: Symmetric::from_entries(n, chain), g, compliance: vec![0.0; n] };
    let (h, k, gap) = (1e-3, 1e4, 1e-3);
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    let mut hand = Hand::new(n, COUPLING);
    let mut steps = Vec::new();
    for step in 0..1000 + count {
        let at = |q: &[f64], i: usize, d: isize| i.checked_add_signed(d).and_then(|j| q.get(j)).copied().unwrap_or(0.0);
        let spring = |q: &[f64], i: usize| k * (2.0 * q[i] - at(q, i, -1) - at(q, i, 1));
        let drive = |i: usize| 40.0 * (31.4 * h * step as f64 + 2.4 * i as f64).sin();
        let b: Vec<f64> =
            (0..n).map(|i| v[i] + h * (drive(i) - spring(&q, i)) - 0.25 * h * h * spring(&v, i)).collect();
        let reached = |i: usize| q[i] + 0.5 * h * v[i];
        let lo: Vec<f64> = (0..n).map(|i| if reached(i) <= -gap { 0.0 } else { f64::NEG_INFINITY }).collect();
        let hi: Vec<f64> = (0..n).map(|i| if reached(i) >= gap { 0.0 } else { f64::INFINITY }).collect();
        hand.solve(&b, &lo, &hi);
        for i in 0..n {
            q[i] += 0.5 * h * (v[i] + hand.x[i]);
        }
        v.copy_from_slice(&hand.x);
        if step >= 1000 {
            steps.push((b, lo, hi));
        }
    }
    (problem, steps)
}

/// h²θ²k of a chain of masses 1 and springs 1e6 at h = 1e-2, θ = ½: a force reaches some ten
/// masses.
const STIFF: f64 = 25.0;

/// Programmes of that chain with every other mass held against its stop, a few of which change
/// between contact and separation from step to step.
fn held(n: usize, count: usize) -> (Problem, Vec<Step>) {
    let chain = (0..n).map(|i| (i, i, 1.0 + 2.0 * STIFF)).chain((1..n).map(|i| (i, i - 1, -STIFF)));
    let unit: Vec<[(usize, f64); 1]> = (0..n).map(|i| [(i, 1.0)]).collect();
    let g = Rows::new(n, unit.iter().map(|row| row.as_slice()));
    let problem = Problem { a: Symmetric::from_entries(n, chain), g, compliance: vec![0.0; n] };
    let push = |step: usize, i: usize| 1.0 + 1.05 * (0.05 * step as f64 + 0.9 * i as f64).sin();
    let stop = |i: usize| if i.is_multiple_of(2) { 0.0 } else { f64::INFINITY };
    let step = |step: usize| {
        let b = (0..n).map(|i| push(step, i)).collect();
        (b, vec![f64::NEG_INFINITY; n], (0..n).map(stop).collect())
    };
    (problem, (0..count).map(step).collect())
}

/// The same programme by hand, for this chain only: a primal-dual active set, each pass one sweep
/// of the tridiagonal system in which the masses in contact are held.
struct Hand {
    /// h²θ²k of the chain.
    coupling: f64,
    x: Vec<f64>,
    r: Vec<f64>,
    side: Vec<i8>,
    d: Vec<f64>,
    factor: (Vec<f64>, Vec<f64>),
    passes: u64,
}

impl Hand {
    fn new(n: usize, c: f64) -> Self {
        let (mut l, mut d) = (vec![0.0; n], vec![0.0; n]);
        let mut last = 0.0;
        for i in 0..n {
            l[i] = -c * last;
            d[i] = 1.0 / (1.0 + 2.0 * c + c * l[i]);
            last = d[i];
        }
        l[0] = 0.0;
        let zero = || vec![0.0; n];
        Self { coupling: c, x: zero(), r: zero(), side: vec![0; n], d: zero(), factor: (l, d), passes: 0 }
    }

    fn solve(&mut self, b: &[f64], lo: &[f64], hi: &[f64]) {
        let (n, c) = (b.len(), self.coupling);
        let (b, lo, hi) = (&b[..n], &lo[..n], &hi[..n]);
        let (x, r, side, d) = (&mut self.x[..n], &mut self.r[..n], &mut self.side[..n], &mut self.d[..n]);
        // Free motion with the factor made before.
        let (fl, fd) = (&self.factor.0[..n], &self.factor.1[..n]);
        let mut last = 0.0;
        for i in 0..n {
            last = b[i] - fl[i] * last;
            x[i] = last;
        }
        let mut next = 0.0;
        let mut inside = true;
        for i in (0..n).rev() {
            next = (x[i] + c * next) * fd[i];
            x[i] = next;
            inside &= lo[i] <= next && next <= hi[i];
        }
        r.fill(0.0);
        if inside {
            return;
        }
        for i in 0..n {
            let bound = [lo[i], 0.0, hi[i]][(side[i] + 1) as usize];
            if bound.is_infinite() {
                side[i] = 0;
            }
            if side[i] == 0 {
                side[i] = i8::from(x[i] > hi[i]) - i8::from(x[i] < lo[i]);
            }
        }
        for _ in 0..100 {
            self.passes += 1;
            // A held mass enters its neighbours' equations as a known displacement, and its own
            // equation is left out.
            let (mut last, mut pivot, mut part) = (0.0, 0.0, 0.0);
            for i in 0..n {
                if side[i] == 0 {
                    last = b[i] + c * part * last;
                    pivot = 1.0 / (1.0 + 2.0 * c - c * c * pivot);
                    part = pivot;
                } else {
                    last = if side[i] < 0 { lo[i] } else { hi[i] };
                    (pivot, part) = (0.0, 1.0);
                }
                (x[i], d[i]) = (last, pivot);
            }
            let (mut next, mut changed) = (0.0, false);
            for i in (0..n).rev() {
                if side[i] == 0 {
                    next = (x[i] + c * next) * d[i];
                    x[i] = next;
                    let new = i8::from(next > hi[i] + 1e-12) - i8::from(next < lo[i] - 1e-12);
                    changed |= new != 0;
                    // The double value marks a mass that is to be held from the next pass on.
                    side[i] = 2 * new;
                } else {
                    next = x[i];
                }
            }
            for i in 0..n {
                r[i] = 0.0;
                if side[i].abs() == 2 {
                    side[i] /= 2;
                } else if side[i] != 0 {
                    let left = if i > 0 { x[i - 1] } else { 0.0 };
                    let right = if i + 1 < n { x[i + 1] } else { 0.0 };
                    r[i] = (1.0 + 2.0 * c) * x[i] - c * (left + right) - b[i];
                    if r[i] * f64::from(side[i]) > 0.0 {
                        (r[i], side[i], changed) = (0.0, 0, true);
                    }
                }
            }
            if !changed {
                return;
            }
        }
    }
}

/// The condensed solver and Clarabel against the loop by hand.
fn chains() {
    println!(
        "{:>5} {:>10} {:>12} {:>7} {:>12} {:>24}",
        "n", "hand ns", "condensed ns", "ratio", "Clarabel ns", "in play, passes by hand, pivots, free"
    );
    let sets = [(programmes(20, 500), COUPLING), (programmes(200, 500), COUPLING), (held(1000, 100), STIFF)];
    for ((problem, steps), coupling) in sets {
        let n = problem.a.size();
        let new = |backend| Solver::new(problem.clone(), backend, 1.0).expect("a sound problem");
        let (mut hand, mut condensed, mut clarabel) =
            (Hand::new(n, coupling), new(Backend::Condensed), new(Backend::Clarabel));
        let (mut apart, mut play) = (0.0_f64, 0);
        for (b, lo, hi) in &steps {
            hand.solve(b, lo, hi);
            let found = condensed.solve(&Rhs { b, lo, hi }).expect("feasible");
            let size = hand.r.iter().fold(1.0, |most: f64, r| most.max(r.abs()));
            apart = found.multiplier.iter().zip(&hand.r).fold(apart, |most, (a, b)| most.max((a - b).abs() / size));
            play += hand.r.iter().filter(|r| **r != 0.0).count();
        }
        assert!(apart <= 1e-12, "the two differ by {apart:e}");
        hand.passes = 0;
        let before = condensed.counters();
        let calls = 10 * steps.len();
        let [by_hand, ours, theirs] = race(ROUNDS, || {
            [
                time(calls, |call| {
                    let (b, lo, hi) = &steps[call % steps.len()];
                    hand.solve(b, lo, hi);
                    black_box(&hand.x);
                }),
                time(calls, |call| {
                    let (b, lo, hi) = &steps[call % steps.len()];
                    black_box(condensed.solve(&Rhs { b, lo, hi }).expect("feasible"));
                }),
                time(steps.len() / 50, |call| {
                    let (b, lo, hi) = &steps[call % steps.len()];
                    black_box(clarabel.solve(&Rhs { b, lo, hi }).expect("feasible"));
                }),
            ]
        });
        let all = (calls * ROUNDS) as f64;
        println!(
            "{n:>5} {by_hand:>10.0} {ours:>12.0} {:>7.2} {theirs:>12.0} {:>8.1}, {:.2}, {:.2}, {:.2}",
            ours / by_hand,
            play as f64 / steps.len() as f64,
            hand.passes as f64 / all,
            (condensed.counters().pivots - before.pivots) as f64 / all,
            (condensed.counters().free - before.free) as f64 / all,
        );
    }
    println!();
}

/// More rows than unknowns: a beam between more supports than it has modes, from one that rests on
/// all of them to one that leaves most.
fn beams() {
    println!(
        "{:>5} {:>8} {:>6} {:>12} {:>12} {:>7} {:>34}",
        "modes", "supports", "shaken", "condensed µs", "Clarabel µs", "ratio", "reached, carry, pivots, fallbacks"
    );
    let sizes = [(12, 300), (20, 60), (20, 100), (60, 199)];
    for ((modes, supports), shake) in sizes.into_iter().flat_map(|size| [(size, 1.0), (size, 10.0)]) {
        let (beam, steps) = beam::programmes(modes, supports, shake, 100);
        let new = |backend| Solver::new(beam.problem(), backend, beam::GAP / beam::STEP).expect("a sound problem");
        let (mut condensed, mut clarabel) = (new(Backend::Condensed), new(Backend::Clarabel));
        let (mut reached, mut carry) = (0, 0);
        for (b, lo, hi) in &steps {
            let found = condensed.solve(&Rhs { b, lo, hi }).expect("feasible");
            carry += found.multiplier.iter().filter(|r| **r != 0.0).count();
            reached += lo.iter().zip(hi).filter(|(lo, hi)| lo.is_finite() || hi.is_finite()).count();
        }
        let before = condensed.counters();
        let few = steps.len() / 5;
        let rounds = 3;
        let [ours, theirs] = race(rounds, || {
            [
                time(steps.len(), |call| {
                    let (b, lo, hi) = &steps[call];
                    black_box(condensed.solve(&Rhs { b, lo, hi }).expect("feasible"));
                }),
                time(few, |call| {
                    let (b, lo, hi) = &steps[5 * call];
                    black_box(clarabel.solve(&Rhs { b, lo, hi }).expect("feasible"));
                }),
            ]
        });
        let (all, after) = ((rounds * steps.len()) as f64, condensed.counters());
        println!(
            "{modes:>5} {supports:>8} {shake:>6} {:>12.0} {:>12.0} {:>7.3} {:>14}, {}, {:.1}, {:.2}",
            ours / 1e3,
            theirs / 1e3,
            ours / theirs,
            reached / steps.len(),
            carry / steps.len(),
            (after.pivots - before.pivots) as f64 / all,
            (after.fallbacks - before.fallbacks) as f64 / all,
        );
    }
    println!();
}

fn main() {
    beams();
    chains();
    println!("{:>5} {:>14} {:>14} {:>8} {:>18}", "n", "bare ns", "polished ns", "ratio", "iterations a step");
    for n in [1, 5, 20, 40] {
        let (problem, loads) = chain(n);
        // Only steps that meet a wall: the free ones cost the polished solver next to nothing.
        let mut polished = Solver::new(problem.clone(), Backend::Clarabel, 1.0).expect("a sound problem");
        let (lo, hi) = (vec![-1.0; n], vec![1.0; n]);
        let mut met = |b: &Vec<f64>| {
            let found = polished.solve(&Rhs { b, lo: &lo, hi: &hi }).expect("feasible");
            found.multiplier.iter().any(|&r| r != 0.0)
        };
        let loads: Vec<_> = loads.into_iter().filter(|b| met(b)).collect();
        let mut direct = bare(&problem);
        let bounds = vec![1.0; 2 * n];
        let calls = loads.len() * (400 / n).max(1);
        let mut q = vec![0.0; n];
        let (mut hand, mut before) = (0_u64, polished.counters());
        let [best_bare, best_polished] = race(ROUNDS, || {
            hand = 0;
            let by_hand = time(calls, |call| {
                for (q, b) in q.iter_mut().zip(&loads[call % loads.len()]) {
                    *q = -b;
                }
                direct.update_q(&q).expect("updatable");
                direct.update_b(&bounds).expect("updatable");
                direct.solve();
                hand += u64::from(direct.solution.iterations);
                black_box(&direct.solution.x);
            });
            before = polished.counters();
            let ours = time(calls, |call| {
                let rhs = Rhs { b: &loads[call % loads.len()], lo: &lo, hi: &hi };
                black_box(polished.solve(&rhs).expect("feasible"));
            });
            [by_hand, ours]
        });
        let ours = polished.counters().iterations - before.iterations;
        println!(
            "{n:>5} {best_bare:>14.0} {best_polished:>14.0} {:>8.2} {:>8.1} / {:>7.1}",
            best_polished / best_bare,
            hand as f64 / calls as f64,
            ours as f64 / calls as f64
        );
    }

    let rows = [
        ScalarRow { lo: -1.0, hi: f64::INFINITY, compliance: 0.0 },
        ScalarRow { lo: f64::NEG_INFINITY, hi: 1.0, compliance: 0.0 },
    ];
    let layer = [ScalarRow { compliance: 0.1, ..rows[0] }, rows[1]];
    let (mut r, calls) = ([0.0; 2], 1_000_000);
    let problem = Problem {
        a: Symmetric::diagonal(&[3.0]),
        g: Rows::new(1, [[(0, 1.0)].as_slice(); 2]),
        compliance: vec![0.0; 2],
    };
    let mut matrices = Solver::new(problem, Backend::Clamp, 1.0).expect("a sound problem");
    let (lo, hi) = ([-1.0, f64::NEG_INFINITY], [f64::INFINITY, 1.0]);
    let best = race(ROUNDS, || {
        [
            time(calls, |_| {
                let b: f64 = black_box(6.0);
                let x = (b / 3.0).clamp(-1.0, 1.0);
                black_box((x, 3.0 * x - b));
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(1.0), &rows, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(6.0), &rows, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(clamp(3.0, black_box(-6.0), &layer, &mut r)).ok();
            }),
            time(calls, |_| {
                black_box(matrices.solve(&Rhs { b: &[black_box(6.0)], lo: &lo, hi: &hi })).ok();
            }),
        ]
    });
    println!("\nscalar, ns a call");
    let names =
        ["bare clamp of one float", "clamp(), free", "clamp(), rigid contact", "clamp(), elastic", "Solver, clamp"];
    for (name, best) in names.iter().zip(best) {
        println!("{name:<26} {best:>8.1}");
    }
}
