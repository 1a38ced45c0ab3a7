//! Cost of a step, of an impact and of a step through Clarabel, each beside a loop written by hand
//! for that one scene and doing the same arithmetic; the sides alternate. Prints a table, checks
//! that both sides found the same motion, and asserts nothing about time.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSolver, IPSolver, NonnegativeConeT};
use signorini::qp::Backend;
use signorini::{Load, Method, Scene, Scheme, Stepper, Wall};
use std::f64::consts::TAU;
use std::hint::black_box;

mod support;
use support::{clarabel_settings, race, time};

/// Best of these rounds counts.
const ROUNDS: usize = 300;

/// The source scene: m q̈ + c q̇ + k q = A sin(ωt + φ) between walls at ±g, from rest.
#[derive(Clone, Copy)]
struct Source {
    m: f64,
    c: f64,
    k: f64,
    g: f64,
    e: f64,
    amplitude: f64,
    omega: f64,
    phase: f64,
}

/// What both sides have to agree on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Outcome {
    q: f64,
    v: f64,
    /// Σ of the displacements read after every step, m.
    sum: f64,
    /// Σ of the magnitudes of the impulses, N s.
    impulse: f64,
}

impl Outcome {
    /// The loads of two ways differ by 1e-14 of themselves at most, and the impacts of two seconds
    /// make less than 1e4 times of it.
    fn check(&self, other: &Self, s: Source) {
        let speed = s.amplitude / (s.m * s.omega);
        let pairs = [
            (self.q, other.q, s.g),
            (self.v, other.v, speed),
            (self.sum, other.sum, 1e4 * s.g),
            (self.impulse, other.impulse, 1.0),
        ];
        for (a, b, scale) in pairs {
            assert!((a - b).abs() <= 1e-10 * scale, "another motion: {self:?} {other:?}");
        }
    }
}

impl Source {
    fn new(e: f64) -> Self {
        Self { m: 1.0, c: 0.2, k: 100.0, g: 5e-3, e, amplitude: 3.0, omega: TAU * 5.0, phase: 0.0 }
    }

    fn scene(&self) -> Scene {
        Scene::oscillator(self.m, self.c, self.k)
            .with_wall(Wall::upper("upper", self.g).with_restitution(self.e))
            .with_wall(Wall::lower("lower", -self.g).with_restitution(self.e))
            .with_load(Load::harmonic(self.amplitude, self.omega / TAU, self.phase))
    }
}

/// The load at the instants kh by libm's sine.
fn by_sine(s: Source, h: f64) -> impl FnMut(u64) -> f64 {
    move |k| s.amplitude * (s.omega * (k as f64 * h) + s.phase).sin()
}

/// The same by rotation, set anew every 256 instants; k must count up from 0.
fn by_rotation(s: Source, h: f64) -> impl FnMut(u64) -> f64 {
    let ((turn_s, turn_c), (mut sin, mut cos)) = ((s.omega * h).sin_cos(), (0.0, 0.0));
    move |k| {
        if k.is_multiple_of(256) {
            (sin, cos) = (s.omega * (k as f64 * h) + s.phase).sin_cos();
        } else {
            (sin, cos) = (sin * turn_c + cos * turn_s, cos * turn_c - sin * turn_s);
        }
        s.amplitude * sin
    }
}

/// Moreau–Jean by hand.
fn bare_moreau_jean(s: Source, theta: f64, h: f64, steps: u64, mut force: impl FnMut(u64) -> f64) -> Outcome {
    let ht = h * theta;
    let a = s.m + ht * s.c + ht * ht * s.k;
    let inverse = 1.0 / a;
    let touch = 1e-12 * s.g;
    let (mut q, mut v, mut load) = (0.0, 0.0, force(0));
    let (mut sum, mut impulse) = (0.0, 0.0);
    for step in 0..steps {
        let load_end = force(step + 1);
        let mean = (1.0 - theta) * load + theta * load_end;
        let b = h * (mean - s.c * v - s.k * (q + ht * v));
        let mut delta = b * inverse;
        let reach = q + 0.5 * h * v;
        if reach >= s.g - touch {
            let bound = -(1.0 + if v >= 0.0 { s.e } else { 1.0 }) * v;
            if delta > bound {
                delta = bound;
                impulse += b - a * delta;
            }
        } else if reach <= -s.g + touch {
            let bound = -(1.0 + if v <= 0.0 { s.e } else { 1.0 }) * v;
            if delta < bound {
                delta = bound;
                impulse += a * delta - b;
            }
        }
        q += h * (v + theta * delta);
        v += delta;
        load = load_end;
        sum += q;
    }
    Outcome { q, v, sum, impulse }
}

/// The same through the library; the impulses of all steps with contact are read.
fn stepped(stepper: &mut Stepper, steps: u64) -> Outcome {
    let (mut q, mut v, mut sum, mut impulse) = (0.0, 0.0, 0.0, 0.0);
    for _ in 0..steps {
        let step = stepper.step().expect("a step");
        (q, v) = (step.q[0], step.v[0]);
        sum += q;
        for p in step.impulse {
            impulse += p.abs();
        }
    }
    Outcome { q, v, sum, impulse }
}

/// The same from contact to contact, without the displacements in between.
fn glided(stepper: &mut Stepper, steps: u64) -> Outcome {
    let (mut q, mut v, mut impulse, mut made) = (0.0, 0.0, 0.0, 0);
    while made < steps {
        let step = stepper.advance_quiet(steps - made).expect("steps");
        (q, v, made) = (step.q[0], step.v[0], step.index + 1);
        for p in step.impulse {
            impulse += p.abs();
        }
    }
    Outcome { q, v, sum: 0.0, impulse }
}

/// The e = 1 motion between two impacts, by hand: Re(Z e^{λτ}) from the impact on, and the steady
/// Im(S e^{i(ωt + φ)}).
struct Flight {
    s: Source,
    sigma: f64,
    kappa: f64,
    damped: f64,
    steady: [f64; 2],
    start: f64,
    free: [f64; 2],
}

impl Flight {
    fn new(s: Source) -> Self {
        let (sigma, kappa) = (0.5 * s.c / s.m, s.k / s.m);
        let (re, im) = (kappa - s.omega * s.omega, 2.0 * sigma * s.omega);
        let gain = s.amplitude / s.m / (re * re + im * im);
        let damped = (kappa - sigma * sigma).sqrt();
        Self { s, sigma, kappa, damped, steady: [gain * re, -gain * im], start: 0.0, free: [0.0; 2] }
    }

    fn begin(&mut self, start: f64, q: f64, v: f64) {
        let ([re, im], (sin, cos)) = (self.steady, (self.s.omega * start + self.s.phase).sin_cos());
        let x = q - (re * sin + im * cos);
        let dx = v - self.s.omega * (re * cos - im * sin);
        (self.start, self.free) = (start, [x, -(dx + self.sigma * x) / self.damped]);
    }

    /// Displacement, velocity and acceleration.
    fn at(&self, tau: f64) -> [f64; 3] {
        let (decay, (sd, cd)) = ((-self.sigma * tau).exp(), (self.damped * tau).sin_cos());
        let ([a, b], [re, im]) = (self.free, self.steady);
        let (x, y) = (decay * (a * cd - b * sd), decay * (a * sd + b * cd));
        let (sin, cos) = (self.s.omega * (self.start + tau) + self.s.phase).sin_cos();
        let q = x + re * sin + im * cos;
        let v = -self.sigma * x - self.damped * y + self.s.omega * (re * cos - im * sin);
        [q, v, self.s.amplitude / self.s.m * sin - 2.0 * self.sigma * v - self.kappa * q]
    }

    /// The root of f in (low, high), from a guess: Newton's method, halving where it leaves the
    /// bracket. `f` gives value and slope from a state, the value's sign at `low` being that of
    /// `sign`.
    fn root(&self, mut low: f64, mut high: f64, guess: f64, sign: f64, f: impl Fn([f64; 3]) -> [f64; 2]) -> f64 {
        let mut tau = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
        for _ in 0..60 {
            let [value, slope] = f(self.at(tau));
            if sign * value > 0.0 {
                low = tau
            } else {
                high = tau
            }
            let newton = tau - value / slope;
            // Convergence is quadratic: after so small a step the error is rounding.
            if (newton - tau).abs() <= 1e-8 / self.s.omega {
                return newton;
            }
            tau = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        }
        tau
    }
}

/// Impulses of the impacts up to `end`, by hand. Scans in eighths of the load's period; an interval
/// in which the curvature could bring the body to a wall is searched.
fn bare_event(s: Source, end: f64, found: &mut Vec<f64>) {
    let mut flight = Flight::new(s);
    let stride = TAU / s.omega / 8.0;
    let (mut t, mut q, mut v) = (0.0, 0.0, 0.0);
    let steady = flight.steady[0].hypot(flight.steady[1]);
    loop {
        flight.begin(t, q, v);
        let [a, b] = flight.free;
        let sagitta = (flight.kappa * (a * a + b * b).sqrt() + s.omega * s.omega * steady) * stride * stride / 8.0;
        let (mut from, mut low) = (0.0, [q, v, 0.0]);
        let mut left = if q.abs() == s.g { q.signum() } else { 0.0 };
        let hit = loop {
            let to = from + stride;
            let high = flight.at(to);
            let side = if high[0] + low[0] > 0.0 { 1.0 } else { -1.0 };
            let (before, after) = (side * low[0] - s.g, side * high[0] - s.g);
            if before.max(after) + sagitta > 0.0 {
                let turns = side * low[1] > 0.0 && side * high[1] < 0.0;
                let mut bracket = (after > 0.0).then_some((from, to));
                if left == side {
                    // It has just left this wall: the root at the start does not count.
                    let peak = || flight.root(from, to, from - low[1] / low[2], -side, |[_, v, a]| [v, a]);
                    bracket = bracket.map(|(_, to)| (peak(), to));
                } else if bracket.is_none() && turns {
                    let peak = flight.root(from, to, from - low[1] / low[2], side, |[_, v, a]| [v, a]);
                    bracket = (side * flight.at(peak)[0] > s.g).then_some((from, peak));
                }
                if let Some((near, far)) = bracket {
                    // The parabola from the left end is a first guess.
                    let [q, v, a] = low;
                    let (gap, speed, push) = (s.g - side * q, side * v, side * a);
                    let root = (speed * speed + 2.0 * push * gap).max(0.0).sqrt();
                    let guess = from + 2.0 * gap / (speed + root);
                    break Some((flight.root(near, far, guess, -1.0, |[q, v, _]| [side * q - s.g, side * v]), side));
                }
            }
            (from, low, left) = (to, high, 0.0);
            if t + to >= end {
                break None;
            }
        };
        let Some((tau, side)) = hit.filter(|hit| t + hit.0 < end) else { return };
        let before = flight.at(tau)[1];
        (t, q, v) = (t + tau, side * s.g, -s.e * before);
        found.push(s.m * (v - before));
    }
}

/// The library's impacts.
fn exact(stepper: &mut Stepper, end: f64, found: &mut Vec<f64>) {
    while stepper.time() < end {
        let step = stepper.step().expect("a step");
        for &p in step.jump {
            if p != 0.0 {
                found.push(p);
            }
        }
    }
}

/// A body that rests against a wall and is pressed by a varying load: every step is a programme in
/// contact.
fn pressed() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.0))
        .with_load(Load::constant(3.0))
        .with_load(Load::harmonic(1.0, 5.0, 0.0))
        .with_initial(&[5e-3], &[0.0])
}

/// Clarabel as one would call it by hand for such a step, dimensionless: ½ x² − b x over x ≤ 0.
fn bare_clarabel() -> DefaultSolver<f64> {
    let one = CscMatrix::new(1, 1, vec![0, 1], vec![0], vec![1.0]);
    DefaultSolver::new(&one, &[0.0], &one, &[0.0], &[NonnegativeConeT(1)], clarabel_settings())
        .expect("a sound programme")
}

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };
const H: f64 = 1e-4;

fn stepper(scene: &Scene, backend: Backend) -> Stepper {
    Stepper::new(scene, &Method { scheme: MOREAU_JEAN, backend }, H).expect("a scene")
}

fn main() {
    println!("{:<56} {:>10} {:>10} {:>7}", "nanoseconds for", "by hand", "library", "ratio");
    let row = |what: &str, [hand, ours]: [f64; 2]| {
        println!("{what:<56} {hand:>10.1} {ours:>10.1} {:>7.2}", ours / hand);
    };
    for e in [1.0, 0.8] {
        let (source, steps) = (Source::new(e), 20_000);
        let (scene, [mut hand, mut turned, mut ours]) = (source.scene(), [Outcome::default(); 3]);
        let [sine, rotation, library] = race(ROUNDS, || {
            let (s, h) = (black_box(source), black_box(H));
            let sine = time(1, |_| hand = bare_moreau_jean(s, black_box(0.5), h, steps, by_sine(s, h)));
            let rotation = time(1, |_| turned = bare_moreau_jean(s, black_box(0.5), h, steps, by_rotation(s, h)));
            let mut stepper = stepper(&scene, Backend::Clamp);
            let library = time(1, |_| ours = stepped(&mut stepper, steps));
            [sine, rotation, library].map(|ns| ns / steps as f64)
        });
        hand.check(&ours, source);
        turned.check(&ours, source);
        let [rotation_alone, many] = race(ROUNDS, || {
            let (s, h) = (black_box(source), black_box(H));
            let alone = time(1, |_| turned = bare_moreau_jean(s, black_box(0.5), h, steps, by_rotation(s, h)));
            let mut stepper = stepper(&scene, Backend::Clamp);
            let many = time(1, |_| ours = glided(&mut stepper, steps));
            [alone, many].map(|ns| ns / steps as f64)
        });
        turned.check(&Outcome { sum: turned.sum, ..ours }, source);
        row(&format!("a step of moreau-jean, e = {e}: libm's sine by hand"), [sine, library]);
        row(&format!("a step of moreau-jean, e = {e}: rotation by hand"), [rotation, library]);
        row("the same, from contact to contact in a call", [rotation_alone, many]);
    }

    let (source, end) = (Source::new(1.0), 10.0);
    let (scene, [mut hand, mut ours]) = (source.scene().with_duration(end), [(); 2].map(|()| Vec::with_capacity(1000)));
    let best = race(ROUNDS, || {
        hand.clear();
        ours.clear();
        let by_hand = time(1, |_| bare_event(black_box(source), black_box(end), &mut hand));
        let mut stepper = Stepper::new(&scene, &Scheme::Event, end).expect("a scene");
        let library = time(1, |_| exact(&mut stepper, end, &mut ours));
        [by_hand / hand.len() as f64, library / ours.len() as f64]
    });
    assert_eq!(hand.len(), ours.len(), "other impacts");
    // Rounding errors grow by 1e5 in the first half of the run and by 4e11 in all of it.
    for (impact, (a, b)) in hand.iter().zip(&ours).enumerate() {
        assert!((a - b).abs() < if impact < hand.len() / 2 { 1e-9 } else { 1e-2 }, "impact {impact}: {a} {b}");
    }
    row(&format!("an impact of event, {} of them", ours.len()), best);

    let (scene, steps) = (pressed(), 100);
    let (mut direct, mut stepper, mut n) = (bare_clarabel(), stepper(&scene, Backend::Clarabel), 0);
    let (mut linear, mut by_hand, before) = (vec![0.0], 0, stepper.counters());
    let best = race(ROUNDS, || {
        let hand = time(steps, |step| {
            // The pressing force, relative to its mean.
            let press = (2.5 + (TAU * 5.0 * H * (n + step) as f64).sin()) / 2.5;
            linear[0] = -press;
            direct.update_q(&linear).expect("updatable");
            direct.solve();
            by_hand += u64::from(direct.solution.iterations);
            black_box(&direct.solution.x);
        });
        n += steps;
        let library = time(steps, |_| {
            black_box(stepper.step().expect("a step"));
        });
        [hand, library]
    });
    let after = stepper.counters();
    assert_eq!(after.qp_solves, after.steps, "every step is in contact");
    row("a step of moreau-jean by clarabel", best);
    let ours = after.interior_point_iterations - before.interior_point_iterations;
    let [hand, ours] = [by_hand, ours].map(|iterations| iterations as f64 / n as f64);
    println!("  of which interior-point iterations                    {hand:>10.2} {ours:>10.2}");
}
