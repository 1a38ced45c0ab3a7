//! A check of solutions and a generator of programmes, written without the solvers they test.
#![allow(dead_code)]

use nalgebra::{DMatrix, DVector};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Problem, Rhs, Solution};

/// SplitMix64: the same programmes on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }
    pub fn decade(&mut self, a: f64, b: f64) -> f64 {
        10_f64.powf(self.between(a, b))
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

/// What stays the same over all programmes, as full matrices, which the check and the enumeration
/// use.
#[derive(Debug, Clone)]
pub struct Dense {
    pub a: DMatrix<f64>,
    pub g: DMatrix<f64>,
    pub compliance: DVector<f64>,
}

impl Dense {
    pub fn problem(&self) -> Problem {
        let n = self.a.ncols();
        let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).map(|(i, j)| (i, j, self.a[(i, j)]));
        let entries = |i: usize| (0..n).map(|j| (j, self.g[(i, j)])).filter(|entry| entry.1 != 0.0).collect();
        let rows: Vec<Vec<(usize, f64)>> = (0..self.g.nrows()).map(entries).collect();
        Problem {
            a: Symmetric::from_entries(n, lower.filter(|entry| entry.0 == entry.1 || entry.2 != 0.0)),
            g: Rows::new(n, rows.iter().map(Vec::as_slice)),
            compliance: self.compliance.as_slice().to_vec(),
        }
    }
}

/// A programme of one step, owned.
#[derive(Debug, Clone)]
pub struct Case {
    pub problem: Dense,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
    pub scale: f64,
}

impl Case {
    pub fn rhs(&self) -> Rhs<'_> {
        Rhs { b: &self.b, lo: &self.lo, hi: &self.hi }
    }
}

/// A feasible random programme with n unknowns and m rows, over many orders of magnitude of
/// stiffness and length.
pub fn random_case(random: &mut Random, n: usize, m: usize) -> Case {
    let stiffness = random.decade(-6.0, 9.0);
    let length = random.decade(-9.0, 3.0);
    let factor = DMatrix::from_fn(n, n, |_, _| random.between(-1.0, 1.0));
    let a = (&factor * factor.transpose() + DMatrix::identity(n, n)) * stiffness;
    let mut g = DMatrix::from_fn(m, n, |_, _| random.between(-1.0, 1.0));
    let compliance =
        DVector::from_fn(m, |_, _| if random.chance(0.3) { random.decade(-2.0, 2.0) / stiffness } else { 0.0 });
    // Now and then two walls see the same motion.
    if m > 1 && random.chance(0.2) {
        let first = g.row(0).clone_owned();
        g.set_row(m - 1, &first);
    }
    // Bounds around a point, so that the programme is feasible; touching ones are degenerate.
    let point = DVector::from_fn(n, |_, _| random.between(-1.0, 1.0) * length);
    let seen = &g * &point;
    let side = |random: &mut Random| {
        if random.chance(0.3) {
            f64::INFINITY
        } else if random.chance(0.1) {
            0.0
        } else {
            random.decade(-3.0, 0.3) * length
        }
    };
    let lo = seen.iter().map(|w| w - side(random)).collect();
    let hi = seen.iter().map(|w| w + side(random)).collect();
    let push = random.decade(-2.0, 1.0);
    // Now and then the load holds the body exactly at the point: force = gap = 0 where a bound
    // touches.
    let b = if random.chance(0.1) {
        (&a * &point).as_slice().to_vec()
    } else {
        (0..n).map(|_| random.between(-1.0, 1.0) * stiffness * length * push).collect()
    };
    Case { problem: Dense { a, g, compliance }, b, lo, hi, scale: length }
}

/// The largest violation of the optimality conditions, each made dimensionless by the size of the
/// terms it compares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    pub stationarity: f64,
    pub feasibility: f64,
    pub complementarity: f64,
}

impl Residual {
    pub fn worst(self) -> f64 {
        self.stationarity.max(self.feasibility).max(self.complementarity)
    }
}

/// What the check needs of a problem, computed once for all its programmes.
pub struct Judge<'a> {
    problem: &'a Dense,
    inverse: DMatrix<f64>,
    /// G A⁻¹Gᵀ + diag(c).
    pub w: DMatrix<f64>,
}

impl<'a> Judge<'a> {
    pub fn new(problem: &'a Dense) -> Self {
        let Dense { a, g, compliance } = problem;
        let inverse = a.clone().cholesky().expect("positive definite").inverse();
        let w = g * &inverse * g.transpose() + DMatrix::from_diagonal(compliance);
        Self { problem, inverse, w }
    }

    /// A x − b − Gᵀ r = 0;  l ≤ y ≤ u with y = G x + c r;  r ≥ 0 only at l, ≤ 0 only at u.
    pub fn judge(&self, rhs: &Rhs, scale: f64, solution: &Solution) -> Residual {
        let Dense { a, g, compliance } = self.problem;
        let x = DVector::from_column_slice(&solution.x);
        let r = DVector::from_column_slice(&solution.multiplier);
        let b = DVector::from_column_slice(rhs.b);
        let left = a * &x - &b - g.tr_mul(&r);
        let size = a.abs() * x.abs() + b.abs() + g.abs().tr_mul(&r.abs());
        let stationarity = left.amax() / size.amax().max(f64::MIN_POSITIVE);

        let free = g * (&self.inverse * &b);
        let (mut feasibility, mut complementarity) = (0.0_f64, 0.0_f64);
        for i in 0..r.len() {
            let y = (g.row(i) * &x)[0] + compliance[i] * r[i];
            let terms = (g.row(i).abs() * x.abs())[0] + (compliance[i] * r[i]).abs();
            // A force has 16 digits, and so has the motion that the largest of them may cause here:
            // 1e-3 of it, times 1e-12, is 4 ulps.
            let weight = |j: usize| self.w[(j, j)].sqrt();
            let caused = (0..r.len()).fold(0.0, |most, j| f64::max(most, weight(i) * weight(j) * r[j].abs()));
            let length = scale.max(terms).max(free[i].abs()).max(1e-3 * caused);
            feasibility = feasibility.max((rhs.lo[i] - y) / length).max((y - rhs.hi[i]) / length);
            // The force as the displacement it causes at its own row, against the gap on its side.
            let reach = r[i].abs() * self.w[(i, i)] / length;
            let gap = if r[i] > 0.0 { y - rhs.lo[i] } else { rhs.hi[i] - y }.abs() / length;
            complementarity = complementarity.max(reach.min(gap));
        }
        Residual { stationarity, feasibility, complementarity }
    }

    /// Of all forces that hold the body at `x`, those of least Σ Wᵢᵢ rᵢ², by trying every set of
    /// rows that stand on a bound; `None` where no set holds it to 1e-9.
    pub fn least_share(&self, rhs: &Rhs, scale: f64, x: &[f64]) -> Option<Vec<f64>> {
        let Dense { a, g, compliance } = self.problem;
        let x = DVector::from_column_slice(x);
        let mut needed = a * &x - DVector::from_column_slice(rhs.b);
        let size = (a.abs() * x.abs()).amax().max(rhs.b.iter().fold(0.0, |m, v| f64::max(m, v.abs())));
        let (m, y) = (g.nrows(), g * &x);
        let mut fixed = vec![0.0; m];
        let mut touching = vec![];
        for i in 0..m {
            let (below, above) = (rhs.lo[i] - y[i], rhs.hi[i] - y[i]);
            if compliance[i] > 0.0 {
                fixed[i] = if below > 0.0 { below } else { above.min(0.0) } / compliance[i];
                needed -= g.row(i).transpose() * fixed[i];
            } else if below.abs().min(above.abs()) <= 1e-10 * scale.max(y[i].abs()) {
                touching.push((i, if below.abs() < above.abs() { 1.0 } else { -1.0 }, below.abs() == above.abs()));
            }
        }
        let mut best: Option<(f64, Vec<f64>)> = None;
        for set in 0..1_usize << touching.len() {
            let chosen: Vec<(usize, f64, bool)> =
                touching.iter().enumerate().filter(|(k, _)| set >> k & 1 == 1).map(|t| *t.1).collect();
            let weight = |i: usize| self.w[(i, i)].sqrt();
            let columns = DMatrix::from_fn(x.len(), chosen.len(), |j, k| g[(chosen[k].0, j)] / weight(chosen[k].0));
            let u = if chosen.is_empty() {
                DVector::zeros(0)
            } else {
                let svd = columns.clone().svd(true, true);
                let cut = 1e-8 * svd.singular_values.max();
                svd.solve(&needed, cut).expect("both factors")
            };
            let left = if chosen.is_empty() { needed.amax() } else { (&columns * &u - &needed).amax() };
            let most = u.amax();
            let sound = u.iter().zip(&chosen).all(|(u, (_, sign, both))| *both || sign * u >= -1e-10 * most);
            if left <= 1e-9 * size && sound && best.as_ref().is_none_or(|(least, _)| u.norm() < *least * (1.0 - 1e-9)) {
                let mut r = fixed.clone();
                chosen.iter().zip(u.iter()).for_each(|((i, ..), u)| r[*i] = u / weight(*i));
                best = Some((u.norm(), r));
            }
        }
        best.map(|(_, r)| r)
    }
}

pub fn judge(case: &Case, solution: &Solution) -> Residual {
    Judge::new(&case.problem).judge(&case.rhs(), case.scale, solution)
}

/// The minimiser by trying every set of active bounds: 3^m equality systems.
pub fn brute_force(case: &Case) -> Option<Solution> {
    let Dense { a, g, compliance } = &case.problem;
    let (n, m) = (a.ncols(), g.nrows());
    let mut best: Option<(f64, Solution)> = None;
    for code in 0..3_usize.pow(m as u32) {
        let digit = |i: usize| code / 3_usize.pow(i as u32) % 3;
        let active: Vec<usize> = (0..m).filter(|&i| digit(i) > 0).collect();
        let bound = |i: usize| if digit(i) == 1 { case.lo[i] } else { case.hi[i] };
        if active.iter().any(|&i| bound(i).is_infinite()) {
            continue;
        }
        // [A −Gᵀ; G C] [x; r] = [b; bound], in units of the stiffness so that LU meets no mixture
        // of scales.
        let k = a.amax();
        let size = n + active.len();
        let mut matrix = DMatrix::zeros(size, size);
        let mut right = DVector::zeros(size);
        matrix.view_mut((0, 0), (n, n)).copy_from(&(a / k));
        for j in 0..n {
            right[j] = case.b[j] / k;
        }
        for (p, &i) in active.iter().enumerate() {
            for j in 0..n {
                matrix[(j, n + p)] = -g[(i, j)];
                matrix[(n + p, j)] = g[(i, j)];
            }
            matrix[(n + p, n + p)] = compliance[i] * k;
            right[n + p] = bound(i);
        }
        let lu = matrix.full_piv_lu();
        if lu.u().diagonal().iter().any(|d| d.abs() < 1e-11) {
            continue;
        }
        let Some(z) = lu.solve(&right) else { continue };
        let mut multiplier = vec![0.0; m];
        for (p, &i) in active.iter().enumerate() {
            multiplier[i] = z[n + p] * k;
        }
        let signs = active.iter().map(|&i| if digit(i) == 1 { -multiplier[i] } else { multiplier[i] });
        let wrong = signs.fold(0.0, f64::max) / (k * case.scale);
        let solution = Solution { x: z.as_slice()[..n].to_vec(), multiplier };
        let measure = judge(case, &solution).worst().max(wrong);
        if best.as_ref().is_none_or(|(least, _)| measure < *least) {
            best = Some((measure, solution));
        }
    }
    // A set that satisfies every condition to rounding; others miss by the size of the data.
    best.filter(|(measure, _)| *measure < 1e-9).map(|(_, solution)| solution)
}
