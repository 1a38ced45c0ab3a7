//! The slowest modes of a large structure, by Lanczos' method.

use super::definite::definite;
use super::dense::eigen;
use crate::error::{Error, Result};
use crate::hash::next_unit;
use crate::interrupt::Asking;
use crate::linear::{Factor, Operator, Symmetric, negative_pivots};
use crate::scene::Structure;
use crate::scene::scales::fastest_squared;
use nalgebra::DMatrix;

/// Number of start vectors: up to this many modes of one frequency are found together.
const BLOCK: usize = 4;
/// A Ritz pair (θ, φ) has converged if ‖(K + σM)⁻¹Mφ − θφ‖ is below this times θ …
const TOLERANCE: f64 = 1e-11;
/// … or below this times the largest θ, which is rounding.
const ROUNDING: f64 = 1e-14;
/// The rounding of the pivots of K, as a share of the fastest ω².
const PIVOTS: f64 = 64.0 * f64::EPSILON;
/// The first shift, as a share of the fastest ω²: large enough to make a singular K definite.
const SHIFT: f64 = 1e-11;

/// A basis V of the Krylov space of B = (K + σM)⁻¹M, orthonormal in M, extended by one vector at a
/// time: with `BLOCK` start vectors, the image B vₚ of the p-th vector is orthogonalised twice
/// against all of V, and added to it (band Lanczos with full orthogonalisation; Ruhe 1979, doi
/// 10.1090/S0025-5718-1979-0521282-9).
struct Basis {
    mass: Operator,
    factor: Factor,
    vectors: Vec<Vec<f64>>,
    /// Column p: the components of B vₚ along each vector, up to the one it added.
    images: Vec<Vec<f64>>,
    product: Vec<f64>,
    seed: u64,
}

impl Basis {
    fn new(structure: &Structure, sigma: f64) -> Option<Self> {
        let shifted = Symmetric::sum(&[(1.0, &structure.stiffness), (sigma, &structure.mass)]);
        let factor = Factor::new(&shifted).ok()?;
        let n = structure.mass.size();
        let mass = Operator::new(&structure.mass);
        let mut basis = Self { mass, factor, vectors: Vec::new(), images: Vec::new(), product: vec![0.0; n], seed: 1 };
        for _ in 0..BLOCK.min(n) {
            basis.start();
        }
        Some(basis)
    }

    /// Adds a start vector: arbitrary but the same in each run, then smoothed once. False if the
    /// basis spans the whole space already.
    fn start(&mut self) -> bool {
        let known = self.vectors.len();
        let mut x: Vec<f64> = (0..self.product.len()).map(|_| next_unit(&mut self.seed) - 0.5).collect();
        self.image(&mut x);
        self.add(x);
        self.vectors.len() > known
    }

    /// x ← B x.
    fn image(&mut self, x: &mut Vec<f64>) {
        self.product.fill(0.0);
        self.mass.add_product(1.0, x, &mut self.product);
        self.factor.solve(&mut self.product);
        std::mem::swap(x, &mut self.product);
    }

    /// Orthogonalises `x` against the basis and adds the remainder, unless it is rounding. Returns
    /// its components; the last is the one along the new vector.
    fn add(&mut self, mut x: Vec<f64>) -> Vec<f64> {
        let mut components = vec![0.0; self.vectors.len()];
        let whole = self.norm(&x);
        for _ in 0..2 {
            self.product.fill(0.0);
            self.mass.add_product(1.0, &x, &mut self.product);
            for (v, component) in self.vectors.iter().zip(&mut components) {
                let along = dot(v, &self.product);
                *component += along;
                x.iter_mut().zip(v).for_each(|(x, v)| *x -= along * v);
            }
        }
        let norm = self.norm(&x);
        if norm > 1e-13 * whole {
            x.iter_mut().for_each(|x| *x /= norm);
            self.vectors.push(x);
            components.push(norm);
        }
        components
    }

    fn norm(&mut self, x: &[f64]) -> f64 {
        self.product.fill(0.0);
        self.mass.add_product(1.0, x, &mut self.product);
        dot(x, &self.product).max(0.0).sqrt()
    }

    /// Adds the image of the next vector. False if no vector is left: the basis is invariant, or
    /// spans Rⁿ.
    fn expand(&mut self) -> bool {
        let Some(mut x) = self.vectors.get(self.images.len()).cloned() else { return false };
        self.image(&mut x);
        let components = self.add(x);
        self.images.push(components);
        true
    }

    /// The Ritz values θ of the vectors expanded so far, largest first, their coefficients, and the
    /// norm of the residual B φ − θ φ.
    fn ritz(&self) -> Option<(Vec<f64>, DMatrix<f64>, Vec<f64>)> {
        let p = self.images.len();
        let entry = |i: usize, j: usize| self.images[j].get(i).copied().unwrap_or(0.0);
        let matrix = DMatrix::from_fn(p, p, |i, j| 0.5 * (entry(i, j) + entry(j, i)));
        let (values, vectors) = eigen(matrix)?;
        let order: Vec<usize> = (0..p).rev().collect();
        let vectors = vectors.select_columns(&order);
        let beyond = |y: usize| {
            let row = |i: usize| (0..p).map(|j| entry(i, j) * vectors[(j, y)]).sum::<f64>();
            (p..self.vectors.len()).map(|i| row(i).powi(2)).sum::<f64>().sqrt()
        };
        let residuals = (0..p).map(beyond).collect();
        Some((values.into_iter().rev().collect(), vectors, residuals))
    }

    /// φ from its coefficients.
    fn shape(&self, coefficients: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut shape = vec![0.0; self.product.len()];
        for (v, y) in self.vectors.iter().zip(coefficients) {
            shape.iter_mut().zip(v).for_each(|(s, v)| *s += y * v);
        }
        shape
    }
}

/// M-orthonormal shapes of the `count` slowest modes.
pub(super) fn lowest(structure: &Structure, count: usize) -> Result<Vec<Vec<f64>>> {
    let mass = definite(&structure.mass)?;
    let n = structure.mass.size();
    let singular = || {
        let expected = "a positive semidefinite matrix: no motion gains energy from the springs";
        Error::invalid(("system", "stiffness matrix"), "with a negative pivot", expected)
    };
    let failed = || {
        let value = format!("{count}, of which Lanczos' method found not all");
        Error::invalid(
            "modes",
            value,
            "fewer, or a coarser mesh: the slowest modes drown in the rounding of a very stiff K",
        )
    };
    let fastest_squared = fastest_squared(structure, Some(mass));
    let least = SHIFT * fastest_squared.max(f64::MIN_POSITIVE);
    // A shift within the range of the modes wanted keeps the digits of the slowest and the fastest
    // of them alike. A short run finds that range.
    let mut scout = Basis::new(structure, least).ok_or_else(singular)?;
    let mut left = count + 6 * BLOCK;
    let mut asking = Asking::here();
    while left > 0 && scout.expand() {
        asking.pass(scout.images.len() as u64)?;
        left -= 1;
    }
    let (theta, ..) = scout.ritz().ok_or_else(failed)?;
    let lambda: Vec<f64> = theta.iter().map(|theta| 1.0 / theta - least).filter(|x| *x > least).collect();
    let sigma = match (lambda.first(), lambda.get(count.min(lambda.len().saturating_sub(1)))) {
        (Some(first), Some(last)) => (first * last).sqrt().max(least),
        _ => least,
    };
    let mut basis = Basis::new(structure, sigma).ok_or_else(singular)?;
    let most = n.min(4 * count + 200);
    let mut next = (2 * count + 2 * BLOCK).min(most);
    asking.restart();
    loop {
        let mut grows = true;
        while grows && basis.images.len() < next {
            grows = basis.expand();
            asking.pass(basis.images.len() as u64)?;
        }
        let (theta, vectors, residuals) = basis.ritz().ok_or_else(failed)?;
        let largest = theta.first().copied().unwrap_or(0.0);
        let good = |i: usize| residuals[i] <= TOLERANCE * theta[i] + ROUNDING * largest;
        if theta.len() >= count && (0..count).all(good) && complete(structure, &theta[..count], sigma, fastest_squared)
        {
            return Ok((0..count).map(|i| basis.shape(vectors.column(i).iter().copied())).collect());
        }
        if next >= most && (grows || basis.vectors.len() >= n) {
            return Err(failed());
        }
        // The space is exhausted, or a mode lies outside it: another start vector is added.
        let narrow = !grows || (theta.len() >= count && (0..count).all(good));
        if narrow && !basis.start() {
            return Err(failed());
        }
        next = (next + BLOCK.max(next / 8)).min(most);
    }
}

/// True if the shapes found include all modes slower than the last of them: by Sylvester's law of
/// inertia, K − μM has as many negative pivots as there are modes below μ, which stands off the
/// last ω² by more than the rounding of the pivots.
fn complete(structure: &Structure, theta: &[f64], sigma: f64, fastest_squared: f64) -> bool {
    let lambda: Vec<f64> = theta.iter().map(|theta| 1.0 / theta - sigma).collect();
    let Some(&last) = lambda.last() else { return false };
    let mu = last - (1e-7 * last.abs().max(1e-3 * sigma)).max(PIVOTS * fastest_squared);
    // All are rigid-body motions: below them there is only rounding.
    if mu <= 1e-3 * sigma {
        return true;
    }
    let found = lambda.iter().filter(|x| **x < mu).count();
    let shifted = Symmetric::sum(&[(1.0, &structure.stiffness), (-mu, &structure.mass)]);
    negative_pivots(&shifted).is_none_or(|below| below <= found)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
