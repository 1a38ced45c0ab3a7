//! Extremes and mean squares of the probes' displacements, over the window of a row.

use crate::scene::{Row, Scene, State};
use crate::step::{Path, Step};
use std::f64::consts::FRAC_PI_4;

/// Gauss's rule of four points on [0, 1]: nodes and weights.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Number of bisections that narrow a bracket to the last digit of a double.
const HALVINGS: u32 = 60;

/// Golden section, and the number of its steps: the value at an extreme is known to 1e-16 when its
/// place is known to 1e-8.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
const SECTIONS: u32 = 40;

/// Extremes and mean square of one probe.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// Highest and lowest displacement, m.
    pub highest: f64,
    pub lowest: f64,
    /// ∫u² dt, m² s.
    pub square: f64,
    /// Largest speed, m/s.
    pub speed: f64,
}

/// Sums up the motion of a scene's probes from a given time on.
///
/// Within a stretch of exact motion, an extreme is a zero of the velocity. It is bracketed by
/// instants an eighth of a period of the fastest motion apart, and then found to rounding. For a
/// scheme on a grid the extremes are those at its instants and at the begin of the window, and
/// integrals are taken by the trapezoidal rule.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    from: f64,
    probes: Vec<Row>,
    pub seen: Vec<Seen>,
    /// True if the largest speeds are requested, which takes more evaluations.
    speeds: bool,
    /// The state at the end of the last step, and memory for others.
    last: State,
    state: State,
    /// Instants of a stretch: time, displacement and velocity of a probe.
    instants: Vec<(f64, f64, f64)>,
}

impl Motion {
    /// Sums for the probes of `scene`, from the time `from` (s) on, starting at `start`.
    pub fn new(scene: &Scene, from: f64, start: &State, speeds: bool) -> Self {
        let empty = Seen { highest: f64::NEG_INFINITY, lowest: f64::INFINITY, square: 0.0, speed: 0.0 };
        let probes: Vec<Row> = scene.probes.iter().map(|probe| probe.at.clone()).collect();
        let seen = vec![empty; probes.len()];
        let mut motion =
            Self { from, probes, seen, speeds, last: start.clone(), state: start.clone(), instants: Vec::new() };
        if from <= 0.0 {
            for (probe, seen) in motion.probes.iter().zip(&mut motion.seen) {
                seen.take(probe.dot(&start.q), probe.dot(&start.v));
            }
        }
        motion
    }

    pub fn observe(&mut self, step: &Step<'_>) {
        if step.end > self.from && step.end > step.start {
            match step.path {
                Path::Exact(arc) if arc.is_rest() => self.observe_grid(step),
                Path::Exact(arc) => self.observe_path(step, arc.fastest_motion()),
                Path::Series(series) => self.observe_path(step, series.rate()),
                Path::Grid | Path::OneRestitution | Path::Part { .. } | Path::Handed { .. } => self.observe_grid(step),
            }
        }
        // A jump at the end of the step.
        self.last.q.copy_from_slice(step.q);
        self.last.v.copy_from_slice(step.v);
    }

    fn observe_grid(&mut self, step: &Step<'_>) {
        let span = step.end - step.start.max(self.from);
        // Where the window begins within the step, or with it, it begins with a state of its own,
        // straight between those of the step.
        let begins = step.start <= self.from;
        let share = ((self.from - step.start) / (step.end - step.start)).max(0.0);
        for (probe, seen) in self.probes.iter().zip(&mut self.seen) {
            let [u, v] = [probe.dot(step.q), probe.dot(step.v)];
            let at = |last: f64, now: f64| last + share * (now - last);
            let first = at(probe.dot(&self.last.q), u);
            if begins {
                seen.take(first, at(probe.dot(&self.last.v), v));
            }
            seen.take(u, v);
            seen.square += 0.5 * span * (first * first + u * u);
        }
    }

    /// A stretch of exact motion whose largest angular frequency is `rate` (rad/s).
    fn observe_path(&mut self, step: &Step<'_>, rate: f64) {
        let from = step.start.max(self.from);
        let span = step.end - from;
        let count = (span * rate / FRAC_PI_4).ceil().clamp(1.0, 1e6);
        for (index, probe) in self.probes.iter().enumerate() {
            let state = &mut self.state;
            let mut at = |t: f64| {
                step.path.state(t, &mut state.q, &mut state.v);
                (probe.dot(&state.q), probe.dot(&state.v))
            };
            self.instants.clear();
            let mut k = 0.0;
            while k <= count {
                let t = if k == count { step.end } else { from + span * (k / count) };
                let (u, v) = at(t);
                self.instants.push((t, u, v));
                k += 1.0;
            }
            let Some(seen) = self.seen.get_mut(index) else { continue };
            for &(_, u, v) in &self.instants {
                seen.take(u, v);
            }
            for pair in self.instants.windows(2) {
                let &[(a, _, va), (b, _, vb)] = pair else { continue };
                if (va < 0.0 && vb > 0.0) || (va > 0.0 && vb < 0.0) {
                    let u = turn(&mut at, [a, b], va);
                    seen.take(u, 0.0);
                }
                let square = |(node, weight): (f64, f64)| weight * at(a + (b - a) * node).0.powi(2);
                seen.square += (b - a) * GAUSS.map(square).iter().sum::<f64>();
            }
            if self.speeds {
                for bracket in brackets(&self.instants) {
                    seen.speed = seen.speed.max(largest(&mut |t| at(t).1.abs(), bracket));
                }
            }
        }
    }
}

impl Seen {
    fn take(&mut self, u: f64, v: f64) {
        self.highest = self.highest.max(u);
        self.lowest = self.lowest.min(u);
        self.speed = self.speed.max(v.abs());
    }
}

/// Intervals in which the speed may have a peak: around an instant with lower speeds on both sides,
/// and at the ends, beyond which nothing is known.
fn brackets(instants: &[(f64, f64, f64)]) -> Vec<[f64; 2]> {
    let peak = |three: &[(f64, f64, f64)]| match three {
        &[(a, _, va), (_, _, middle), (b, _, vb)] if middle.abs() >= va.abs().max(vb.abs()) => Some([a, b]),
        _ => None,
    };
    let ends = [instants.get(..2), instants.len().checked_sub(2).and_then(|from| instants.get(from..))];
    let end = |pair: &[(f64, f64, f64)]| if let &[(a, ..), (b, ..)] = pair { Some([a, b]) } else { None };
    instants.windows(3).filter_map(peak).chain(ends.into_iter().flatten().filter_map(end)).collect()
}

/// The displacement where the velocity, `va` at a, is zero within [a, b].
fn turn(at: &mut impl FnMut(f64) -> (f64, f64), [mut a, mut b]: [f64; 2], va: f64) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (a + b);
        if middle <= a || middle >= b {
            break;
        }
        if (at(middle).1 > 0.0) == (va > 0.0) {
            a = middle;
        } else {
            b = middle;
        }
    }
    at(0.5 * (a + b)).0
}

/// The largest value of `f` within [a, b], where it has one peak.
fn largest(f: &mut impl FnMut(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    let (mut c, mut d) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..SECTIONS {
        if fc > fd {
            (b, d, fd) = (d, c, fc);
            c = b - GOLDEN * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + GOLDEN * (b - a);
            fd = f(d);
        }
    }
    fc.max(fd)
}
