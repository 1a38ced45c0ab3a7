//! An event-driven solution independent of the crate: the closed form of an underdamped oscillator
//! between events, events by bisection to the last bit. For constant and harmonic loads; contacts
//! may last but not accumulate.

use signorini::{LoadKind, Scene, Side, System, WallLaw};

/// Longest stretch searched in one piece, s: the motions here turn round at most once in it.
const STRETCH: f64 = 2e-4;

#[derive(Debug, Clone, Copy)]
struct Wall {
    sign: f64,
    g: f64,
    /// Restitution of a rigid wall.
    e: Option<f64>,
    k: f64,
    c: f64,
}

/// What the body is doing.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Free,
    /// In an elastic wall.
    In(usize),
    /// At rest on a rigid wall.
    On(usize),
}

/// An impact, or the entry into an elastic wall.
#[derive(Debug, Clone, Copy)]
pub struct Event {
    pub time: f64,
    pub wall: usize,
    pub approach: f64,
}

/// The closed form q(t) from a start at t₀.
#[derive(Debug, Clone, Copy)]
struct Flow {
    t0: f64,
    sigma: f64,
    omega: f64,
    a: f64,
    b: f64,
    mean: f64,
}

pub struct EventDriven {
    m: f64,
    c: f64,
    k: f64,
    constant: f64,
    /// (amplitude, ω, phase)
    sines: Vec<(f64, f64, f64)>,
    walls: Vec<Wall>,
    mode: Mode,
    flow: Flow,
    pub t: f64,
    pub q: f64,
    pub v: f64,
    pub events: Vec<Event>,
}

impl EventDriven {
    pub fn new(scene: &Scene) -> Self {
        let System::Oscillator(o) = &scene.system else { panic!("one degree of freedom") };
        let (mut constant, mut sines) = (0.0, Vec::new());
        for load in &scene.loads {
            match load.kind {
                LoadKind::Constant { force } => constant += force,
                LoadKind::Harmonic { amplitude, frequency, phase } => {
                    sines.push((amplitude, std::f64::consts::TAU * frequency, phase));
                }
                _ => panic!("constant and harmonic loads only"),
            }
        }
        let walls = scene.walls.iter().map(|w| {
            let (e, k, c) = match w.law {
                WallLaw::Rigid { restitution } => (Some(restitution), 0.0, 0.0),
                WallLaw::Elastic { stiffness, damping } => (None, stiffness, damping),
                _ => panic!("rigid and elastic walls only"),
            };
            Wall { sign: if w.side() == Side::Lower { 1.0 } else { -1.0 }, g: w.position(), e, k, c }
        });
        let still = Flow { t0: 0.0, sigma: 0.0, omega: 1.0, a: 0.0, b: 0.0, mean: 0.0 };
        let mut out = Self {
            m: o.mass,
            c: o.damping,
            k: o.stiffness,
            constant,
            sines,
            walls: walls.collect(),
            mode: Mode::Free,
            flow: still,
            t: 0.0,
            q: scene.initial.q[0],
            v: scene.initial.v[0],
            events: Vec::new(),
        };
        out.restart();
        out
    }

    /// States on a grid of `spacing` seconds up to `end`, the start left out.
    pub fn sample(scene: &Scene, spacing: f64, end: f64) -> Vec<(f64, f64)> {
        let mut motion = Self::new(scene);
        let rows = (end / spacing).round() as usize;
        let at = |i: usize| end * ((i + 1) as f64 / rows as f64);
        (0..rows).map(|i| motion.advance(at(i))).collect()
    }

    pub fn displacements(scene: &Scene, spacing: f64, end: f64) -> Vec<f64> {
        Self::sample(scene, spacing, end).into_iter().map(|(q, _)| q).collect()
    }

    fn load(&self, t: f64) -> f64 {
        self.sines.iter().fold(self.constant, |f, &(a, w, p)| f + a * (w * t + p).sin())
    }

    /// c, k and the constant force of the present mode.
    fn constants(&self) -> (f64, f64, f64) {
        match self.mode {
            Mode::In(i) => {
                let w = self.walls[i];
                (self.c + w.c, self.k + w.k, self.constant + w.k * w.g)
            }
            _ => (self.c, self.k, self.constant),
        }
    }

    /// The particular solution of the sines, and its rate.
    fn forced(&self, t: f64) -> (f64, f64) {
        let (c, k, _) = self.constants();
        self.sines.iter().fold((0.0, 0.0), |(q, v), &(a, w, p)| {
            let (re, im) = (k - self.m * w * w, c * w);
            let d = re * re + im * im;
            let (s, co) = (w * t + p).sin_cos();
            (q + a * (re * s - im * co) / d, v + a * w * (re * co + im * s) / d)
        })
    }

    fn restart(&mut self) {
        let (c, k, f) = self.constants();
        let sigma = 0.5 * c / self.m;
        let square = k / self.m - sigma * sigma;
        assert!(square > 0.0, "underdamped only");
        let omega = square.sqrt();
        let mean = f / k;
        let (qp, vp) = self.forced(self.t);
        let a = self.q - mean - qp;
        let b = (self.v - vp + sigma * a) / omega;
        self.flow = Flow { t0: self.t, sigma, omega, a, b, mean };
    }

    fn state(&self, t: f64) -> (f64, f64) {
        if let Mode::On(i) = self.mode {
            return (self.walls[i].g, 0.0);
        }
        let Flow { t0, sigma, omega, a, b, mean } = self.flow;
        let (s, c) = (omega * (t - t0)).sin_cos();
        let decay = (-sigma * (t - t0)).exp();
        let (qp, vp) = self.forced(t);
        let q = decay * (a * c + b * s);
        let v = decay * ((b * omega - sigma * a) * c - (a * omega + sigma * b) * s);
        (mean + qp + q, vp + v)
    }

    /// A function that is ≥ 0 while the present mode lasts, with respect to each wall.
    fn stays(&self, wall: usize, t: f64) -> f64 {
        let w = self.walls[wall];
        let (q, v) = self.state(t);
        let gap = w.sign * (q - w.g);
        let push = -w.k * gap - w.c * w.sign * v;
        match self.mode {
            Mode::On(i) if i == wall => -w.sign * (self.load(t) - self.k * w.g),
            Mode::In(i) if i == wall => push,
            // Outside, or behind the face of a damped wall that does not push: contact begins when
            // it would push.
            _ if w.e.is_none() => gap.max(-push),
            _ => gap,
        }
    }

    /// First instant in (t, to] at which the mode ends, and the wall that ends it.
    fn next_event(&self, to: f64) -> Option<(f64, usize)> {
        let mut first: Option<(f64, usize)> = None;
        let mut cuts = vec![self.t];
        // The turning point, if there is one, so that the gap is monotone on each piece.
        if self.state(self.t).1 * self.state(to).1 < 0.0 {
            let start = self.state(self.t).1.signum();
            cuts.push(bisect(self.t, to, |t| self.state(t).1 * start >= 0.0));
        }
        cuts.push(to);
        for wall in 0..self.walls.len() {
            for pair in cuts.windows(2) {
                if self.stays(wall, pair[1]) < 0.0 {
                    let t = bisect(pair[0], pair[1], |t| self.stays(wall, t) >= 0.0);
                    if first.is_none_or(|(best, _)| t < best) {
                        first = Some((t, wall));
                    }
                    break;
                }
            }
        }
        first
    }

    /// Goes to `to` and returns (q, v) there, after any impact at that instant.
    pub fn advance(&mut self, to: f64) -> (f64, f64) {
        while self.t < to {
            let end = (self.t + STRETCH).min(to);
            let Some((t, wall)) = self.next_event(end) else {
                (self.q, self.v) = self.state(end);
                self.t = end;
                continue;
            };
            (self.q, self.v) = self.state(t);
            self.t = t;
            self.pass(wall);
            self.restart();
        }
        (self.q, self.v)
    }

    fn pass(&mut self, wall: usize) {
        let w = self.walls[wall];
        if matches!(self.mode, Mode::In(i) | Mode::On(i) if i == wall) {
            self.mode = Mode::Free;
            return;
        }
        self.events.push(Event { time: self.t, wall, approach: self.v.abs() });
        let Some(e) = w.e else {
            self.mode = Mode::In(wall);
            return;
        };
        assert!(e == 0.0 || self.v.abs() > 1e-6, "impacts accumulate");
        (self.q, self.v) = (w.g, -e * self.v);
        let presses = w.sign * (self.load(self.t) - self.k * w.g) < 0.0;
        if e == 0.0 && presses {
            self.mode = Mode::On(wall);
        }
    }
}

/// The last instant (to the last bit) at which `holds`, which is true at `a` and false at `b`.
fn bisect(mut a: f64, mut b: f64, holds: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            return b;
        }
        if holds(middle) { a = middle } else { b = middle }
    }
}
