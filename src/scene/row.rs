//! Locations on a structure as sparse rows.

use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::hash::{Hash, Hasher};

/// A sparse row g of weights on the degrees of freedom: the displacement there is w = g · q, and a
/// force r there acts on the structure as gᵀ r.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    entries: Vec<(usize, f64)>,
}

impl Row {
    /// A row without entries.
    pub(crate) const NONE: Self = Self { entries: Vec::new() };

    /// The row that picks degree of freedom `index` (from 0).
    #[must_use]
    pub fn dof(index: usize) -> Self {
        Self { entries: vec![(index, 1.0)] }
    }

    /// A row of (degree of freedom, weight): the difference of two is the relative motion of two
    /// masses, unequal weights are a lever.
    #[must_use]
    pub fn new(entries: Vec<(usize, f64)>) -> Self {
        Self { entries }
    }

    /// The pairs (degree of freedom, weight), in the order given.
    #[must_use]
    pub fn entries(&self) -> &[(usize, f64)] {
        &self.entries
    }

    /// The same row where the degrees of freedom come `by` later.
    pub(crate) fn shifted(&self, by: usize) -> Self {
        Self { entries: self.entries.iter().map(|&(i, weight)| (i + by, weight)).collect() }
    }

    /// The sum of rows, each with a factor; a factor of 0 leaves its row out.
    pub(crate) fn combination<'a>(terms: impl IntoIterator<Item = (f64, &'a Self)>) -> Self {
        let scaled = |(factor, row): (f64, &'a Self)| row.entries.iter().map(move |&(i, weight)| (i, factor * weight));
        Self { entries: terms.into_iter().filter(|term| term.0 != 0.0).flat_map(scaled).collect() }
    }

    /// The row of the displacement relative to the place of `other`: g − g'.
    #[cfg(feature = "case")]
    pub(crate) fn relative_to(&self, other: &Self) -> Self {
        Self::combination([(1.0, self), (-1.0, other)])
    }

    /// True if the row is zero: no entries, or entries that cancel.
    pub(crate) fn is_blind(&self) -> bool {
        let weight = |i: usize| self.entries.iter().filter(|e| e.0 == i).map(|e| e.1).sum::<f64>();
        self.entries.iter().all(|&(i, _)| weight(i) == 0.0)
    }

    /// w = g · q for a vector `q` of one value per degree of freedom; degrees of freedom beyond its
    /// length count as 0.
    #[must_use]
    pub fn dot(&self, q: &[f64]) -> f64 {
        self.entries.iter().map(|&(i, weight)| weight * q.get(i).copied().unwrap_or(0.0)).sum()
    }

    /// Σ |gᵢ xᵢ|, the size of the terms of [`Row::dot`].
    pub(crate) fn size(&self, x: &[f64]) -> f64 {
        self.entries.iter().map(|&(i, weight)| (weight * x.get(i).copied().unwrap_or(0.0)).abs()).sum()
    }

    /// Adds gᵀ `force` to `out`; entries beyond its length are left out.
    #[inline]
    pub(crate) fn add_transposed(&self, force: f64, out: &mut [f64]) {
        for &(i, weight) in &self.entries {
            if let Some(out) = out.get_mut(i) {
                *out += weight * force;
            }
        }
    }
}

/// The distinct rows of a list.
pub(crate) struct Distinct<'a> {
    /// In the order in which they first occur.
    pub rows: Vec<&'a Row>,
    /// For each member of the list, the index of its row.
    pub of: Vec<usize>,
}

/// The distinct rows of a list: equal rows have the same entries in the same order.
pub(crate) fn distinct<'a>(list: impl IntoIterator<Item = &'a Row>) -> Distinct<'a> {
    let (mut known, mut rows, mut of) = (HashMap::new(), Vec::new(), Vec::new());
    for row in list {
        let index = *known.entry(Key(row)).or_insert(rows.len());
        if index == rows.len() {
            rows.push(row);
        }
        of.push(index);
    }
    Distinct { rows, of }
}

/// A row as a hash key. NaN weights differ from every number, so such a row equals only itself.
#[derive(PartialEq)]
struct Key<'a>(&'a Row);

impl Eq for Key<'_> {}

impl Hash for Key<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        for &(i, weight) in &self.0.entries {
            // Both zeros are equal, so their hashes must be too.
            (i, (weight + 0.0).to_bits()).hash(state);
        }
    }
}

/// A named place whose displacement and velocity are recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Probe {
    /// The name used in tables and CSV headers; empty for the single probe of an oscillator.
    pub name: String,
    /// The row of the displacement that it records.
    pub at: Row,
}
