//! Modes of vibration.

use super::definite::definite;
use super::{dense, krylov};
use crate::error::{Error, Result};
use crate::linear::{Operator, Symmetric};
use crate::order::sort_by_number;
use crate::scene::structure::{finite_matrix, matrix_of};
use crate::scene::{Row, Structure};
use std::ops::Range;

/// Up to this many degrees of freedom full matrices are used where they help: for all modes at
/// once, and for modal damping.
pub const MOST_DENSE: usize = 600;

/// The most modes of a larger structure.
pub const MOST_MODES: usize = 500;

/// Modes of the undamped structure, slowest first: K φᵢ = ωᵢ² M φᵢ, φᵢᵀ M φⱼ = δᵢⱼ.
///
/// ω of a rigid-body motion is exactly 0, that is where φᵀKφ is no larger than the rounding in K
/// and φ. The largest component of a shape, weighted by the root of its mass, is positive, so that
/// shapes can be compared between runs. Shapes of equal ω are an arbitrary basis of their space,
/// but each moves only one of the parts that M and K do not couple.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Modes {
    /// ωᵢ, rad/s, increasing; k entries.
    pub omega: Vec<f64>,
    /// φᵢ, k vectors of one value per degree of freedom, 1/√kg for displacements.
    pub shapes: Vec<Vec<f64>>,
}

/// λ = φᵀKφ below this many roundings of |φ|ᵀ|K||φ| is 0 …
const RIGID: f64 = 8.0 * f64::EPSILON;
/// … and so is λ below this share of the largest kᵢᵢ/mᵢᵢ: the energy due to an error of 1e-11 in
/// the shape, the largest that remains.
const SHAPE: f64 = 1e-22;

/// Most uncoupled blocks whose modes are computed apart; a structure of more is taken as one.
const MOST_BLOCKS: usize = 1024;

/// Components within this relative distance of the largest count as equal to it: the first of them
/// determines the sign, independent of rounding.
const TIE: f64 = 1e-6;

impl Modes {
    /// The `count` slowest modes of M and K, from 1 to n; C does not matter.
    ///
    /// Up to [`MOST_DENSE`] degrees of freedom many modes are found all at once, from the symmetric
    /// eigenvalue problem L⁻¹ K L⁻ᵀ with M = L Lᵀ; few modes, and those of larger structures, by
    /// the Lanczos method on (K + σM)⁻¹M, until ‖(K + σM)⁻¹Mφ − φ/(ω² + σ)‖ ≤ 1e-11/(ω² + σ) in the
    /// norm of M. Sylvester's law of inertia then checks that none was missed.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `modes` for a number of modes that is out of range or was not
    /// reached; under `system` where M is not positive definite or K has a negative ω².
    pub fn lowest(structure: &Structure, count: usize) -> Result<Self> {
        let n = structure.mass.size();
        if count == 0 || count > n {
            return Err(Error::invalid("modes", count, format!("from 1 to {n}, the degrees of freedom")));
        }
        if n > MOST_DENSE && count > MOST_MODES {
            let expected = format!("at most {MOST_MODES} for more than {MOST_DENSE} degrees of freedom");
            return Err(Error::invalid("modes", count, expected));
        }
        finite_matrix("mass", &structure.mass)?;
        finite_matrix("stiffness", &structure.stiffness)?;
        if structure.mass.half_bandwidth() == 0 && structure.stiffness.half_bandwidth() == 0 {
            return uncoupled(structure, count);
        }
        let blocks = uncoupled_blocks(structure);
        if !blocks.is_empty() {
            return Self::of_blocks(&blocks, n, count);
        }
        let all_at_once = n <= MOST_DENSE && (n <= 40 || 3 * count > n);
        let (scaled, unit) = scaled(structure);
        let mut shapes = if all_at_once { dense::lowest(&scaled, count)? } else { krylov::lowest(&scaled, count)? };
        shapes.iter_mut().flatten().for_each(|x| *x *= unit);
        Self::finish(structure, shapes)
    }

    /// The `count` slowest modes of `n` degrees of freedom in uncoupled `blocks`, each of them with
    /// its first degree of freedom. Every mode moves one block only; of equal ω that of the first
    /// block comes first. The modes of equal blocks, as the two planes of a tube, are computed
    /// once.
    fn of_blocks(blocks: &[(usize, Structure)], n: usize, count: usize) -> Result<Self> {
        let mut merged: Vec<(f64, usize, Vec<f64>)> = Vec::new();
        for (index, (_, block)) in blocks.iter().enumerate() {
            if blocks[..index].iter().any(|other| other.1 == *block) {
                continue;
            }
            let equal: Vec<usize> = blocks.iter().filter(|other| other.1 == *block).map(|other| other.0).collect();
            let needed = count.div_ceil(equal.len()).min(block.mass.size());
            let own = Self::lowest(block, needed)?;
            for (omega, shape) in own.omega.into_iter().zip(own.shapes) {
                merged.extend(equal.iter().map(|&first| (omega, first, shape.clone())));
            }
        }
        sort_by_number(&mut merged, |a| a.0);
        merged.truncate(count);
        let whole = |(omega, first, shape): (f64, usize, Vec<f64>)| {
            let mut all = vec![0.0; n];
            all.iter_mut().skip(first).zip(shape).for_each(|(all, x)| *all = x);
            (omega, all)
        };
        let (omega, shapes) = merged.into_iter().map(whole).unzip();
        Ok(Self { omega, shapes })
    }

    /// ω, order and sign of shapes that are M-orthonormal already.
    fn finish(structure: &Structure, shapes: Vec<Vec<f64>>) -> Result<Self> {
        let stiffness = Operator::new(&structure.stiffness);
        let size = Operator::new(&Symmetric::from_entries(
            structure.stiffness.size(),
            structure.stiffness.entries().map(|(i, j, value)| (i, j, value.abs())),
        ));
        let weight: Vec<f64> = structure.mass.diagonal_entries().into_iter().map(f64::sqrt).collect();
        let squares = structure.stiffness.diagonal_entries();
        let fastest = squares.iter().zip(&weight).map(|(k, w)| k / w / w).fold(0.0_f64, f64::max);
        let mut modes = Vec::with_capacity(shapes.len());
        let mut product = vec![0.0; weight.len()];
        for mut shape in shapes {
            let form = |operator: &Operator, x: &[f64], product: &mut [f64]| {
                product.fill(0.0);
                operator.add_product(1.0, x, product);
                product.iter().zip(x).map(|(a, b)| a * b).sum::<f64>()
            };
            let lambda = form(&stiffness, &shape, &mut product);
            let magnitude: Vec<f64> = shape.iter().map(|x| x.abs()).collect();
            let rounding = RIGID * form(&size, &magnitude, &mut product) + SHAPE * fastest;
            // Errors of the shape itself add to the rounding of its energy: within a hundred times
            // that, a negative λ does not mean that K is indefinite.
            if lambda < -100.0 * rounding {
                let expected = "a positive semidefinite matrix: no motion gains energy from the springs";
                return Err(Error::invalid(
                    ("system", "stiffness matrix"),
                    format!("ω² = {lambda:e} rad²/s² for a mode"),
                    expected,
                ));
            }
            let omega = if lambda <= rounding { 0.0 } else { lambda.sqrt() };
            let largest = shape.iter().zip(&weight).fold(0.0_f64, |a, (x, w)| a.max(x.abs() * w));
            let first = shape.iter().zip(&weight).find(|(x, w)| x.abs() * **w >= (1.0 - TIE) * largest);
            if first.is_some_and(|(x, _)| *x < 0.0) {
                shape.iter_mut().for_each(|x| *x = -*x);
            }
            modes.push((omega, shape));
        }
        sort_by_number(&mut modes, |a| a.0);
        let (omega, shapes) = modes.into_iter().unzip();
        Ok(Self { omega, shapes })
    }

    /// k.
    #[must_use]
    pub fn count(&self) -> usize {
        self.omega.len()
    }

    /// Number of rigid-body motions among them.
    #[must_use]
    pub fn rigid(&self) -> usize {
        self.omega.iter().filter(|omega| **omega == 0.0).count()
    }

    /// φᵀCφ/2ω, k entries: the damping ratios with the matrix C, of rigid-body motions 0.
    #[must_use]
    pub fn ratios(&self, damping: &Symmetric) -> Vec<f64> {
        let ratio = |(omega, shape): (&f64, &Vec<f64>)| {
            if *omega > 0.0 { damping.form(shape, shape) / (2.0 * omega) } else { 0.0 }
        };
        self.omega.iter().zip(&self.shapes).map(ratio).collect()
    }

    /// g Φ, k entries: the row in modal coordinates.
    #[must_use]
    pub fn seen(&self, row: &Row) -> Vec<f64> {
        self.shapes.iter().map(|shape| row.dot(shape)).collect()
    }

    /// Φᵀ M q, k entries: the modal coordinates of a displacement or velocity.
    #[must_use]
    pub fn coordinates(&self, mass: &Symmetric, q: &[f64]) -> Vec<f64> {
        let mut momentum = vec![0.0; q.len()];
        mass.add_product(1.0, q, &mut momentum);
        let dot = |shape: &Vec<f64>| shape.iter().zip(&momentum).map(|(a, b)| a * b).sum();
        self.shapes.iter().map(dot).collect()
    }

    /// Φ a, n entries: the displacement or velocity of modal coordinates.
    #[must_use]
    pub fn expand(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.shapes.first().map_or(0, Vec::len)];
        for (shape, a) in self.shapes.iter().zip(coordinates) {
            q.iter_mut().zip(shape).for_each(|(q, x)| *q += a * x);
        }
        q
    }
}

/// M and K of the stretches of degrees of freedom that neither M nor K couples, as the two planes
/// of a tube or bodies that only walls couple, each with its first degree of freedom; none where
/// all are coupled. The modes of blocks are computed apart: otherwise modes of equal ω would be an
/// arbitrary basis of their space.
fn uncoupled_blocks(structure: &Structure) -> Vec<(usize, Structure)> {
    let n = structure.mass.size();
    let matrices = [&structure.mass, &structure.stiffness];
    // The last degree of freedom that an entry couples with each, or with an earlier one.
    let mut reach: Vec<usize> = (0..n).collect();
    for (i, j, value) in matrices.into_iter().flat_map(Symmetric::entries) {
        if let Some(reach) = reach.get_mut(i.min(j)).filter(|_| value != 0.0) {
            *reach = (*reach).max(i.max(j));
        }
    }
    let mut blocks = Vec::new();
    let (mut first, mut last) = (0, 0);
    for (i, reach) in reach.into_iter().enumerate() {
        if i > last {
            blocks.push(first..i);
            first = i;
        }
        last = last.max(reach);
    }
    blocks.push(first..n);
    if blocks.len() == 1 || blocks.len() > MOST_BLOCKS {
        return Vec::new();
    }
    let [mut masses, mut stiffnesses] = matrices.map(|matrix| parts(matrix, &blocks).into_iter());
    let part = |block: Range<usize>| {
        let (mass, stiffness) = masses.next().zip(stiffnesses.next())?;
        Some((block.start, Structure { mass, damping: Symmetric::zeros(block.len()), stiffness }))
    };
    blocks.into_iter().filter_map(part).collect()
}

/// The parts of a block-diagonal matrix on its `blocks`, which lie one after another.
fn parts(matrix: &Symmetric, blocks: &[Range<usize>]) -> Vec<Symmetric> {
    let mut entries = vec![Vec::new(); blocks.len()];
    for (i, j, value) in matrix.entries().filter(|entry| entry.2 != 0.0) {
        let index = blocks.partition_point(|block| block.end <= i);
        if let (Some(block), Some(entries)) = (blocks.get(index), entries.get_mut(index)) {
            entries.push((i - block.start, j - block.start, value));
        }
    }
    blocks.iter().zip(entries).map(|(block, entries)| Symmetric::from_entries(block.len(), entries)).collect()
}

/// The structure in units in which the largest diagonal entries of M and of K are 1, so that no
/// square overflows, and the factor by which its shapes must be multiplied.
fn scaled(structure: &Structure) -> (Structure, f64) {
    let unit = |matrix: &Symmetric| {
        let largest = matrix.diagonal_entries().into_iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        // Scaling by a power of 2 does not round; a matrix of zeros is not scaled.
        if largest > 0.0 { 2.0_f64.powf(largest.log2().round()) } else { 1.0 }
    };
    let mass = unit(&structure.mass);
    let scaled = Structure {
        mass: Symmetric::sum(&[(1.0 / mass, &structure.mass)]),
        damping: Symmetric::zeros(0),
        stiffness: Symmetric::sum(&[(1.0 / unit(&structure.stiffness), &structure.stiffness)]),
    };
    (scaled, 1.0 / mass.sqrt())
}

/// The modes of a structure whose M and K are diagonal: its degrees of freedom.
fn uncoupled(structure: &Structure, count: usize) -> Result<Modes> {
    definite(&structure.mass)?;
    let (m, k) = (structure.mass.diagonal_entries(), structure.stiffness.diagonal_entries());
    if let Some(row) = k.iter().position(|k| *k < 0.0) {
        let key = matrix_of("stiffness").entry(row, row);
        return Err(Error::invalid(key, format_args!("{:?}", k[row]), "0 or more"));
    }
    let mut order: Vec<usize> = (0..m.len()).collect();
    sort_by_number(&mut order, |&a| k[a] / m[a]);
    order.truncate(count);
    let omega = order.iter().map(|&i| (k[i] / m[i]).sqrt()).collect();
    let shape = |&i: &usize| {
        let mut shape = vec![0.0; m.len()];
        shape[i] = 1.0 / m[i].sqrt();
        shape
    };
    Ok(Modes { omega, shapes: order.iter().map(shape).collect() })
}
