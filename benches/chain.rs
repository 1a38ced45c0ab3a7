//! Cost of a step of moreau-jean on chains of 20 and 200 masses between walls: the library beside a
//! loop written by hand for this one scene (a tridiagonal system solved anew with the masses at
//! their walls held, by a primal–dual active set). The sides are measured alternately. Prints a
//! table, checks that both found the same motion while that is predictable, and asserts nothing
//! about time.

use signorini::linear::Symmetric;
use signorini::{Load, Row, Scene, Scheme, Stepper, Structure, Wall};
use std::f64::consts::TAU;
use std::hint::black_box;

mod support;
use support::{race, time};

/// kg, N/m, s: every chain has one of each; walls at ±GAP, m, with e = 0.
const STIFFNESS: f64 = 1e4;
const DAMPING: f64 = 1e-5;
const GAP: f64 = 1e-3;
const AMPLITUDE: f64 = 50.0;
const FREQUENCY: f64 = 5.0;
const H: f64 = 1e-3;

/// Best of these rounds counts; each follows the motion for this long, s.
const ROUNDS: usize = 15;
const END: f64 = 10.0;
/// Up to here the motion is predictable: runs that round differently still agree, s.
const PREDICTABLE: f64 = 0.2;

fn scene(n: usize) -> Scene {
    let neighbours = |k: f64| {
        let own = (0..n).map(move |i| (i, i, 2.0 * k));
        Symmetric::from_entries(n, own.chain((1..n).map(move |i| (i, i - 1, -k))))
    };
    let structure = Structure {
        mass: Symmetric::diagonal(&vec![1.0; n]),
        damping: neighbours(DAMPING * STIFFNESS),
        stiffness: neighbours(STIFFNESS),
    };
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_duration(END);
    scene.system = structure.into();
    scene.initial.q = vec![0.0; n];
    scene.initial.v = vec![0.0; n];
    for i in 0..n {
        for wall in [Wall::upper(&format!("upper-{i}"), GAP), Wall::lower(&format!("lower-{i}"), -GAP)] {
            scene.walls.push(wall.with_restitution(0.0).at(Row::dof(i)));
        }
    }
    scene.with_load(Load::harmonic(AMPLITUDE, FREQUENCY, 0.0))
}

/// What both sides have to agree on: the displacements at the last predictable instant, and the
/// total number of contacts.
#[derive(Debug, Clone, PartialEq, Default)]
struct Outcome {
    q: Vec<f64>,
    /// Masses held by a wall, summed over steps.
    held: u64,
}

/// The chain by hand. Vectors have an entry 0 at either end.
struct ByHand {
    n: usize,
    u: Vec<f64>,
    v: Vec<f64>,
    x: Vec<f64>,
    r: Vec<f64>,
    /// Elimination of the free chain: superdiagonal over pivot, 1/pivot; and that of the present
    /// step.
    free: Vec<[f64; 2]>,
    upper: Vec<f64>,
    /// Wall at which a mass is held (1 upper, −1 lower, 0 none), and the wall that it would reach.
    held: Vec<i8>,
    reach: Vec<i8>,
    diagonal: f64,
    off: f64,
}

impl ByHand {
    fn new(n: usize) -> Self {
        let c = 0.5 * H * DAMPING * STIFFNESS + 0.25 * H * H * STIFFNESS;
        let (diagonal, off) = (1.0 + 2.0 * c, -c);
        let mut free = vec![[0.0; 2]; n + 2];
        for i in 1..=n {
            let pivot = diagonal - off * free[i - 1][0];
            free[i] = [off / pivot, 1.0 / pivot];
        }
        let zero = || vec![0.0; n + 2];
        let side = || vec![0; n + 2];
        Self {
            n,
            u: zero(),
            v: zero(),
            x: zero(),
            r: zero(),
            free,
            upper: zero(),
            held: side(),
            reach: side(),
            diagonal,
            off,
        }
    }

    fn run(&mut self, steps: u64, outcome: &mut Outcome) {
        let n = self.n;
        let (k, b, c) = (STIFFNESS, DAMPING, -self.off);
        let (drag, spring) = (c - H * b * k - 0.5 * H * H * k, -H * k);
        let force = |t: f64| AMPLITUDE * (TAU * FREQUENCY * t).sin();
        let mut before = force(0.0);
        for step in 0..steps {
            let after = force((step + 1) as f64 * H);
            let mut meets = false;
            for i in 1..=n {
                let second = |x: &[f64]| 2.0 * x[i] - x[i - 1] - x[i + 1];
                self.r[i] = self.v[i] + drag * second(&self.v) + spring * second(&self.u);
                let ahead = self.u[i] + 0.5 * H * self.v[i];
                self.reach[i] = i8::from(ahead >= GAP) - i8::from(ahead <= -GAP);
                meets |= self.reach[i] != 0;
                if self.held[i] != self.reach[i] {
                    self.held[i] = 0;
                }
            }
            self.r[1] += 0.5 * H * (before + after);
            before = after;
            for _ in 0..50 {
                self.eliminate();
                if !meets || !self.change() {
                    break;
                }
            }
            for i in 1..=n {
                self.u[i] += 0.5 * H * (self.x[i] + self.v[i]);
                self.v[i] = self.x[i];
                outcome.held += u64::from(self.held[i] != 0);
            }
            if step + 1 == (PREDICTABLE / H).round() as u64 {
                outcome.q.clear();
                outcome.q.extend_from_slice(&self.u[1..=n]);
            }
        }
    }

    /// The velocities with the held masses at rest.
    fn eliminate(&mut self) {
        let (mut last, mut ratio, mut changed) = (0.0, 0.0, false);
        for i in 1..=self.n {
            if self.held[i] != 0 {
                (last, ratio, changed) = (0.0, 0.0, true);
            } else {
                let inverse = if changed { 1.0 / (self.diagonal - self.off * ratio) } else { self.free[i][1] };
                ratio = self.off * inverse;
                last = (self.r[i] - self.off * last) * inverse;
            }
            (self.upper[i], self.x[i]) = (ratio, last);
        }
        for i in (1..self.n).rev() {
            self.x[i] -= self.upper[i] * self.x[i + 1];
        }
    }

    /// Releases the masses whose wall would pull and holds those that would pass their wall. True
    /// if there were any.
    fn change(&mut self) -> bool {
        let mut changed = false;
        for i in 1..=self.n {
            let side = f64::from(self.reach[i]);
            if side == 0.0 {
                continue;
            }
            if self.held[i] != 0 {
                if (self.off * (self.x[i - 1] + self.x[i + 1]) - self.r[i]) * side > 0.0 {
                    (self.held[i], changed) = (0, true);
                }
            } else if self.x[i] * side > 0.0 {
                (self.held[i], changed) = (self.reach[i], true);
            }
        }
        changed
    }
}

/// The same through the library.
fn stepped(stepper: &mut Stepper, steps: u64, outcome: &mut Outcome) {
    for index in 0..steps {
        let step = stepper.step().expect("a step");
        if index + 1 == (PREDICTABLE / H).round() as u64 {
            outcome.q.clear();
            outcome.q.extend_from_slice(step.q);
        }
        outcome.held += step.impulse.iter().filter(|p| **p != 0.0).count() as u64;
    }
}

fn main() {
    println!("{:<32} {:>10} {:>10} {:>7}", "nanoseconds for a step of", "by hand", "library", "ratio");
    for n in [20, 200] {
        let scene = scene(n);
        let steps = (END / H).round() as u64;
        let mut counters = None;
        let mut outcomes = [Outcome::default(), Outcome::default()];
        let best = race(ROUNDS, || {
            outcomes = [Outcome::default(), Outcome::default()];
            let [hand, ours] = &mut outcomes;
            let mut chain = black_box(ByHand::new(n));
            let by_hand = time(1, |_| chain.run(steps, hand));
            let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, H).expect("a scene");
            let library = time(1, |_| stepped(&mut stepper, steps, ours));
            counters = Some(stepper.counters());
            [by_hand, library].map(|ns| ns / steps as f64)
        });
        let [hand, ours] = &outcomes;
        for (a, b) in hand.q.iter().zip(&ours.q) {
            assert!((a - b).abs() < 1e-9 * GAP, "another motion: {a} {b}");
        }
        let [by_hand, library] = best;
        println!(
            "{:<32} {by_hand:>10.1} {library:>10.1} {:>7.2}",
            format!("chain-{n}, moreau-jean, e = 0"),
            library / by_hand
        );
        let mean = |held: u64| held as f64 / steps as f64;
        println!("  masses held, mean over the run {:>10.2} {:>10.2}", mean(hand.held), mean(ours.held));
        if let Some(counters) = counters {
            let per_step = |count: u64| count as f64 / steps as f64;
            println!(
                "  programmes a step                         {:>10.2}, pivots {:.4}, {} left to Clarabel",
                per_step(counters.qp_solves),
                per_step(counters.pivots),
                counters.qp_fallbacks
            );
        }
    }
}
