//! Cost of a step of moreau-jean of a tube in two round holes with friction: 20 modes in each of
//! two planes, the library beside a loop written by hand for this one scene (diagonal matrices, two
//! 2 × 2 contacts answered in turn until nothing moves). The sides are measured alternately. Prints
//! a table, checks that both found the same motion while that is predictable, and asserts nothing
//! about time.

#![allow(clippy::needless_range_loop, reason = "a loop by hand")]

use signorini::linear::Symmetric;
use signorini::{Load, PlaneRows, Row, Scene, Scheme, Stepper, Structure, Wall};
use std::f64::consts::{PI, TAU};
use std::hint::black_box;

mod support;
use support::{race, time};

/// Modes of each plane; kg/m, N m², m: a pinned tube; damping ratio.
const MODES: usize = 20;
const LINE_MASS: f64 = 1.3;
const BENDING: f64 = 690.0;
const LENGTH: f64 = 3.0;
const ZETA: f64 = 0.01;
/// Two holes.
const HOLES: [f64; 2] = [1.0, 2.0];
const GAP: f64 = 0.2e-3;
const RESTITUTION: f64 = 0.5;
const FRICTION: f64 = 0.2;
/// Loads in both planes at each of these places: amplitude N, frequency Hz, phase.
const PLACES: [f64; 2] = [0.5, 2.3];
const LOADS: [[(f64, f64, f64); 2]; 2] = [[(4.0, 11.0, 0.0), (3.0, 17.0, 1.0)], [(3.5, 23.0, 2.0), (2.5, 7.0, 0.5)]];
const H: f64 = 5e-5;

/// Best of these rounds counts; each follows the motion for this long, s.
const ROUNDS: usize = 15;
const END: f64 = 2.0;
/// Up to here the motion is predictable: runs that round differently still agree, s.
const PREDICTABLE: f64 = 0.05;

/// Circular frequency of a mode, rad/s, and its value at a place, 1/√kg.
fn omega(mode: usize) -> f64 {
    let number = (mode + 1) as f64 * PI / LENGTH;
    number * number * (BENDING / LINE_MASS).sqrt()
}

fn shape(mode: usize, x: f64) -> f64 {
    (2.0 / (LINE_MASS * LENGTH)).sqrt() * ((mode + 1) as f64 * PI * x / LENGTH).sin()
}

fn scene() -> Scene {
    let plane = |value: &dyn Fn(usize) -> f64| {
        let one: Vec<f64> = (0..MODES).map(value).collect();
        Symmetric::diagonal(&[one.clone(), one].concat())
    };
    let mut scene = Scene::structure(Structure {
        mass: plane(&|_| 1.0),
        damping: plane(&|mode| 2.0 * ZETA * omega(mode)),
        stiffness: plane(&|mode| omega(mode).powi(2)),
    });
    let row = |x: f64| Row::new((0..MODES).map(|mode| (mode, shape(mode, x))).collect());
    for (index, x) in HOLES.into_iter().enumerate() {
        let (name, at) = (format!("hole-{index}"), PlaneRows::doubled(&row(x), MODES));
        let wall = Wall::round(&name, at.clone(), GAP).with_restitution(RESTITUTION).with_friction(FRICTION);
        scene = scene.with_support(&name, at, [0.0, 0.0], vec![wall]);
    }
    for (x, loads) in PLACES.into_iter().zip(LOADS) {
        let at = PlaneRows::doubled(&row(x), MODES);
        for ((amplitude, frequency, phase), at) in loads.into_iter().zip([at.y, at.z]) {
            scene.loads.push(Load { at, ..Load::harmonic(amplitude, frequency, phase) });
        }
    }
    scene.with_duration(END)
}

/// What both sides have to agree on: the displacements at the last predictable instant, and the
/// number of contacts and their impulse (N s) over the run.
#[derive(Debug, Clone, PartialEq, Default)]
struct Outcome {
    q: Vec<f64>,
    pushed: u64,
    impulse: f64,
}

const N: usize = 2 * MODES;

/// The tube by hand.
struct ByHand {
    q: [f64; N],
    v: [f64; N],
    stiffness: [f64; MODES],
    damping: [f64; MODES],
    /// 1/A of each mode.
    inverse: [f64; MODES],
    /// Shape at the holes and at the loads.
    holes: [[f64; MODES]; 2],
    loads: [[f64; MODES]; 2],
    /// Response of the holes to each other, the same in both planes.
    w: [[f64; 2]; 2],
    force: [f64; N],
    impulse: [[f64; 2]; 2],
}

impl ByHand {
    fn new() -> Self {
        let modes = |value: &dyn Fn(usize) -> f64| std::array::from_fn::<f64, MODES, _>(value);
        let stiffness = modes(&|mode| omega(mode).powi(2));
        let damping = modes(&|mode| 2.0 * ZETA * omega(mode));
        let inverse = modes(&|i| 1.0 / (1.0 + 0.5 * H * damping[i] + 0.25 * H * H * stiffness[i]));
        let holes = HOLES.map(|x| modes(&|mode| shape(mode, x)));
        let between = |a: usize, b: usize| (0..MODES).map(|i| holes[a][i] * inverse[i] * holes[b][i]).sum();
        let mut tube = Self {
            q: [0.0; N],
            v: [0.0; N],
            loads: PLACES.map(|x| modes(&|mode| shape(mode, x))),
            w: [[between(0, 0), between(0, 1)], [between(1, 0), between(1, 1)]],
            stiffness,
            damping,
            inverse,
            holes,
            force: [0.0; N],
            impulse: [[0.0; 2]; 2],
        };
        tube.force = tube.load(0.0);
        tube
    }

    fn load(&self, t: f64) -> [f64; N] {
        let mut force = [0.0; N];
        for (shape, loads) in self.loads.iter().zip(LOADS) {
            for (plane, (amplitude, frequency, phase)) in loads.into_iter().enumerate() {
                let f = amplitude * (TAU * frequency * t + phase).sin();
                for i in 0..MODES {
                    force[plane * MODES + i] += f * shape[i];
                }
            }
        }
        force
    }

    fn seen(&self, hole: usize, x: &[f64; N]) -> [f64; 2] {
        [0, 1].map(|plane| (0..MODES).map(|i| self.holes[hole][i] * x[plane * MODES + i]).sum())
    }

    fn run(&mut self, steps: u64, outcome: &mut Outcome) {
        for index in 0..steps {
            self.step(index, outcome);
            if index + 1 == (PREDICTABLE / H).round() as u64 {
                outcome.q = self.q.to_vec();
            }
        }
    }

    fn step(&mut self, index: u64, outcome: &mut Outcome) {
        let next = self.load((index + 1) as f64 * H);
        let (mut delta, mut ahead) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let mode = i % MODES;
            ahead[i] = self.q[i] + 0.5 * H * self.v[i];
            let mean = 0.5 * (self.force[i] + next[i]);
            let rest = mean - self.damping[mode] * self.v[i] - self.stiffness[mode] * ahead[i];
            delta[i] = H * rest * self.inverse[mode];
        }
        self.force = next;
        let mut met = [None; 2];
        for (hole, met) in met.iter_mut().enumerate() {
            let w = self.seen(hole, &ahead);
            if w[0] * w[0] + w[1] * w[1] >= (GAP * (1.0 - 1e-12)).powi(2) {
                *met = Some(self.meet(hole, w));
            } else {
                self.impulse[hole] = [0.0; 2];
            }
        }
        if met.iter().any(Option::is_some) {
            self.answer(&met, &mut delta, outcome);
        }
        for i in 0..N {
            self.q[i] += H * (self.v[i] + 0.5 * delta[i]);
            self.v[i] += delta[i];
        }
    }

    /// Normal and bound of a hole that is reached at `ahead`.
    fn meet(&self, hole: usize, ahead: [f64; 2]) -> ([f64; 2], f64) {
        let (w, rate) = (self.seen(hole, &self.q), self.seen(hole, &self.v));
        let reach = (ahead[0] * ahead[0] + ahead[1] * ahead[1]).sqrt();
        let n = ahead.map(|x| x / reach);
        let a = n[0] * rate[0] + n[1] * rate[1];
        if a <= 0.0 {
            return (n, -a);
        }
        let distance = (w[0] * w[0] + w[1] * w[1]).sqrt();
        let arc = ((H / GAP).powi(2) * (rate[0] * rate[0] + rate[1] * rate[1]) / 8.0).max(1e-9);
        let touching = distance >= GAP * (1.0 - arc);
        let arriving = if touching { ((w[0] * rate[0] + w[1] * rate[1]) / distance).max(0.0).min(a) } else { a };
        (n, -(RESTITUTION * arriving + a - arriving))
    }

    /// Impulses of the holes, in turn until nothing moves, and their effect on δ.
    fn answer(&mut self, met: &[Option<([f64; 2], f64)>; 2], delta: &mut [f64; N], outcome: &mut Outcome) {
        let mut y = [[0.0; 2]; 2];
        for (hole, y) in y.iter_mut().enumerate() {
            let (v, d) = (self.seen(hole, &self.v), self.seen(hole, delta));
            *y = [v[0] + d[0], v[1] + d[1]];
        }
        let free = y;
        let push = |n: [f64; 2], [p, f]: [f64; 2]| [-p * n[0] - f * n[1], -p * n[1] + f * n[0]];
        for _ in 0..100 {
            let mut moved = 0.0_f64;
            for hole in 0..2 {
                let Some((n, bound)) = met[hole] else { continue };
                // What the other hole does.
                let mut rate = free[hole];
                if let Some((other, _)) = met[1 - hole] {
                    let by = push(other, self.impulse[1 - hole]);
                    rate = [rate[0] + self.w[0][1] * by[0], rate[1] + self.w[0][1] * by[1]];
                }
                let w = self.w[hole][hole];
                let (over, t) = (n[0] * rate[0] + n[1] * rate[1] - bound, n[0] * rate[1] - n[1] * rate[0]);
                let p = (over / w).max(0.0);
                let f = (-t / w).clamp(-FRICTION * p, FRICTION * p);
                moved = moved.max((p - self.impulse[hole][0]).abs().max((f - self.impulse[hole][1]).abs()) * w);
                self.impulse[hole] = [p, f];
            }
            if moved < 1e-16 || met.iter().any(Option::is_none) {
                break;
            }
        }
        for hole in 0..2 {
            let (Some((n, _)), [p, f]) = (met[hole], self.impulse[hole]) else { continue };
            if p == 0.0 {
                continue;
            }
            outcome.pushed += 1;
            outcome.impulse += p;
            let by = push(n, [p, f]);
            for i in 0..MODES {
                let lift = self.holes[hole][i] * self.inverse[i];
                delta[i] += lift * by[0];
                delta[MODES + i] += lift * by[1];
            }
        }
    }
}

/// The same through the library.
fn stepped(stepper: &mut Stepper, steps: u64, outcome: &mut Outcome) {
    for index in 0..steps {
        let step = stepper.step().expect("a step");
        if index + 1 == (PREDICTABLE / H).round() as u64 {
            outcome.q = step.q.to_vec();
        }
        for impulse in step.impulse.iter().filter(|impulse| **impulse > 0.0) {
            outcome.pushed += 1;
            outcome.impulse += impulse;
        }
    }
}

fn main() {
    let (scene, steps) = (scene(), (END / H).round() as u64);
    let mut outcomes = [Outcome::default(), Outcome::default()];
    let mut unsettled = 0;
    let best = race(ROUNDS, || {
        outcomes = [Outcome::default(), Outcome::default()];
        let [hand, ours] = &mut outcomes;
        let mut tube = black_box(ByHand::new());
        let by_hand = time(1, |_| tube.run(steps, hand));
        let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, H).expect("a scene");
        let library = time(1, |_| stepped(&mut stepper, steps, ours));
        unsettled = stepper.counters().qp_unsettled;
        [by_hand, library].map(|ns| ns / steps as f64)
    });
    let [hand, ours] = &outcomes;
    for (a, b) in hand.q.iter().zip(&ours.q) {
        assert!((a - b).abs() < 1e-6 * GAP, "another motion: {a} {b}");
    }
    let [by_hand, library] = best;
    println!("{:<44} {:>10} {:>10} {:>7}", "nanoseconds for a step of", "by hand", "library", "ratio");
    let name = "2 × 20 modes, two holes, friction";
    println!("{name:<44} {by_hand:>10.1} {library:>10.1} {:>7.2}", library / by_hand);
    let [first, second] = [hand, ours].map(|outcome| outcome.pushed as f64 / steps as f64);
    println!("{:<44} {first:>10.3} {second:>10.3}", "  holes pushing, mean over the steps");
    let [first, second] = [hand, ours].map(|outcome| outcome.impulse / END);
    println!("{:<44} {first:>10.3} {second:>10.3}", "  mean force of both, N");
    println!("  steps whose states did not settle: {unsettled}");
}
