//! Programmes of a beam on many supports, in sequence, for tests and benches: more rows than
//! unknowns.

use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, Solver};

/// b, lo and hi of one step.
pub type Step = (Vec<f64>, Vec<f64>, Vec<f64>);

/// Gap of a stop, m, and the time step, s.
pub const GAP: f64 = 1e-6;
pub const STEP: f64 = 1e-3;

/// A diagonal, and one dense row for each support.
pub struct Beam {
    pub a: Vec<f64>,
    pub g: Vec<Vec<f64>>,
}

impl Beam {
    pub fn problem(&self) -> Problem {
        let n = self.a.len();
        let rows: Vec<Vec<(usize, f64)>> = self.g.iter().map(|row| row.iter().copied().enumerate().collect()).collect();
        Problem {
            a: Symmetric::diagonal(&self.a),
            g: Rows::new(n, rows.iter().map(Vec::as_slice)),
            compliance: vec![0.0; self.g.len()],
        }
    }
}

/// Steps of moreau-jean (e = 0, θ = ½, h = 1 ms) of a pinned beam with `modes` modes, the first at
/// 20 Hz, between `supports` equal supports with stops 1 µm below and above: pressed down by its
/// weight, and shaken by `shake` m/s² in every mode. Bounds are 0 where a stop is reached and
/// infinite elsewhere. The first 50 steps, in which it falls, are left out; only programmes that
/// meet a bound are kept.
pub fn programmes(modes: usize, supports: usize, shake: f64, count: usize) -> (Beam, Vec<Step>) {
    let (h, gap, pi) = (STEP, GAP, std::f64::consts::PI);
    let rate: Vec<f64> = (1..=modes).map(|j| 40.0 * pi * (j * j) as f64).collect();
    let a: Vec<f64> = rate.iter().map(|w| 1.0 + 0.25 * h * h * w * w + 0.5 * h * 0.02 * w).collect();
    let shape = |x: f64| (1..=modes).map(|j| 2_f64.sqrt() * (j as f64 * pi * x).sin()).collect::<Vec<f64>>();
    let g: Vec<Vec<f64>> = (1..=supports).map(|i| shape(i as f64 / (supports + 1) as f64)).collect();
    let beam = Beam { a, g };
    let mut solver = Solver::new(beam.problem(), Backend::Condensed, GAP / STEP).expect("a sound problem");
    let (mut q, mut v) = (vec![0.0; modes], vec![0.0; modes]);
    let mut steps = Vec::new();
    let mut step = 0;
    while steps.len() < count {
        let t = h * f64::from(step);
        let load = |j: usize| {
            let weight = if j.is_multiple_of(2) { -10.0 * 2_f64.sqrt() * 2.0 / ((j + 1) as f64 * pi) } else { 0.0 };
            weight * (1.0 + 0.2 * shake * (95.0 * t).sin()) + shake / (j + 1) as f64 * (140.0 * t + j as f64).sin()
        };
        let force = |j: usize| load(j) - rate[j] * rate[j] * (q[j] + 0.25 * h * v[j]) - 0.01 * rate[j] * v[j];
        let b: Vec<f64> = (0..modes).map(|j| v[j] + h * force(j)).collect();
        let seen =
            |row: &Vec<f64>| row.iter().zip(q.iter().zip(&v)).map(|(g, (q, v))| g * (q + 0.5 * h * v)).sum::<f64>();
        let reached: Vec<f64> = beam.g.iter().map(seen).collect();
        let lo: Vec<f64> = reached.iter().map(|&w| if w <= -gap { 0.0 } else { f64::NEG_INFINITY }).collect();
        let hi: Vec<f64> = reached.iter().map(|&w| if w >= gap { 0.0 } else { f64::INFINITY }).collect();
        let free = solver.counters().free;
        let found = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).expect("feasible");
        let next = found.x.clone();
        for j in 0..modes {
            q[j] += 0.5 * h * (v[j] + next[j]);
        }
        v = next;
        if step >= 50 && solver.counters().free == free {
            steps.push((b, lo, hi));
        }
        step += 1;
    }
    (beam, steps)
}
