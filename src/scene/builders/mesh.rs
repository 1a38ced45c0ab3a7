//! A line of equal elements: numbering, assembly, and the rows of a point or a stretch.

use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use crate::scene::Row;

/// The most elements of a bar or beam. Beyond some thousand Hermite elements K is too
/// ill-conditioned for statics (its condition number grows with the fourth power of their number),
/// long before this limit on memory.
pub const MOST_ELEMENTS: usize = 100_000;

/// A position within this distance of a node, in elements, counts as the node.
const SNAP: f64 = 1e-9;

/// Equal elements over [0, length] with N unknowns per element and N/2 per node, numbered node by
/// node; fixed unknowns are left out of q.
#[derive(Debug, Clone)]
pub(super) struct Mesh<const N: usize> {
    pub length: f64,
    pub elements: usize,
    /// Unknowns that are fixed at 0, in the numbering of all unknowns; increasing, at the two ends.
    pub fixed: Vec<usize>,
}

impl<const N: usize> Mesh<N> {
    /// Length of an element, m.
    pub fn size(&self) -> f64 {
        self.length / self.elements as f64
    }

    /// Position of a node, m.
    pub fn node(&self, i: usize) -> f64 {
        self.length * (i as f64 / self.elements as f64)
    }

    /// Number of unknowns that are not fixed.
    pub fn unknowns(&self) -> usize {
        ((self.elements + 1) * N / 2).saturating_sub(self.fixed.len())
    }

    /// The degree of freedom of an unknown; `None` if it is fixed.
    pub fn free(&self, unknown: usize) -> Option<usize> {
        let before = self.fixed.iter().filter(|&&f| f < unknown).count();
        (!self.fixed.contains(&unknown)).then(|| unknown - before)
    }

    /// The matrix of one `element`, the same for all, with `springs` (unknown, N/m or N m/rad) on
    /// the diagonal.
    pub fn assemble(&self, element: &[[f64; N]; N], springs: &[(usize, f64)]) -> Symmetric {
        let mut entries = Vec::with_capacity(self.elements * N * (N + 1) / 2 + springs.len());
        for e in 0..self.elements {
            let start = e * N / 2;
            for (a, row) in element.iter().enumerate() {
                for (b, &value) in row.iter().enumerate().take(a + 1) {
                    if let (Some(i), Some(j)) = (self.free(start + a), self.free(start + b)) {
                        entries.push((i, j, value));
                    }
                }
            }
        }
        entries.extend(springs.iter().filter_map(|&(unknown, k)| self.free(unknown).map(|i| (i, i, k))));
        Symmetric::from_entries(self.unknowns(), entries)
    }

    /// The element in which a position (m) lies, and the local coordinate there, from 0 to 1.
    fn locate(&self, key: &'static str, position: f64) -> Result<(usize, f64)> {
        if !(0.0..=self.length).contains(&position) {
            let expected = format!("a position along the structure, from 0 to {:?} m", self.length);
            return Err(Error::invalid(key, format_args!("{position:?}"), expected));
        }
        let x = position / self.length * self.elements as f64;
        let x = if (x - x.round()).abs() < SNAP { x.round() } else { x };
        let element = (x.floor() as usize).min(self.elements - 1);
        Ok((element, x - element as f64))
    }

    /// The row of the displacement at `position` (m), by the shape functions of ξ from 0 to 1.
    pub fn at(&self, position: f64, shape: impl Fn(f64) -> [f64; N]) -> Result<Row> {
        let (element, xi) = self.locate("position", position)?;
        let entries = shape(xi).into_iter().enumerate().filter(|&(_, weight)| weight != 0.0);
        Ok(Row::new(entries.filter_map(|(a, weight)| Some((self.free(element * N / 2 + a)?, weight))).collect()))
    }

    /// The row of a unit force spread evenly over [`from`, `to`] (m): the mean of the shape
    /// functions there. As the row of a displacement it gives the mean.
    pub fn spread(&self, from: f64, to: f64, shape: impl Fn(f64) -> [f64; N]) -> Result<Row> {
        let (first, start) = self.locate("from", from)?;
        let (last, end) = self.locate("to", to)?;
        if to.partial_cmp(&from) != Some(std::cmp::Ordering::Greater) || (first, start) == (last, end) {
            let expected = format!("more than the start of the stretch, {from:?} m");
            return Err(Error::invalid("to", format_args!("{to:?}"), expected));
        }
        let total = (last as f64 + end) - (first as f64 + start);
        let mut weights = vec![0.0; (last - first + 2) * N / 2];
        // Gauss quadrature with two points is exact for cubics.
        let offset = 0.5 / 3.0_f64.sqrt();
        for element in first..=last {
            let a = if element == first { start } else { 0.0 };
            let b = if element == last { end } else { 1.0 };
            for xi in [0.5 * (a + b) - offset * (b - a), 0.5 * (a + b) + offset * (b - a)] {
                let window = weights.iter_mut().skip((element - first) * N / 2);
                window.zip(shape(xi)).for_each(|(sum, w)| *sum += 0.5 * (b - a) / total * w);
            }
        }
        let entries = weights.into_iter().enumerate().filter(|&(_, weight)| weight != 0.0);
        Ok(Row::new(entries.filter_map(|(a, weight)| Some((self.free(first * N / 2 + a)?, weight))).collect()))
    }

    /// The vector q of `values` at the nodes, N/2 each in their order; values of fixed unknowns
    /// must be 0, up to rounding of the largest value of their kind.
    pub fn gather(&self, subject: impl Into<Subject>, values: &[f64]) -> Result<Vec<f64>> {
        let per_node = N / 2;
        let mut q = Vec::with_capacity(self.unknowns());
        for (i, &value) in values.iter().enumerate() {
            let place = format_args!("{value:?} at {:?} m", self.node(i / per_node)).to_string();
            if !value.is_finite() {
                return Err(Error::invalid(subject, place, "a finite number everywhere"));
            }
            if self.free(i).is_some() {
                q.push(value);
                continue;
            }
            let kind = values.iter().skip(i % per_node).step_by(per_node);
            let largest = kind.fold(0.0_f64, |a, x| a.max(x.abs()));
            if value.abs() > 1e-9 * largest {
                let what =
                    if i % per_node == 0 { "0 at an end that is held" } else { "slope 0 at an end that is clamped" };
                return Err(Error::invalid(subject, place, what));
            }
        }
        Ok(q)
    }
}

/// Checks a number of elements.
pub(super) fn elements(subject: impl Into<Subject>, elements: usize) -> Result<()> {
    if (1..=MOST_ELEMENTS).contains(&elements) {
        Ok(())
    } else {
        Err(Error::invalid(subject, elements, format!("a whole number from 1 to {MOST_ELEMENTS}")))
    }
}
