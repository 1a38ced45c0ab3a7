//! A row prepared for products.

use crate::linear::{Columns, Segment};
use crate::scene::Row;

/// A row is stored with the zeros between its entries if that makes it at most this many times as
/// long.
const FILL: usize = 4;

/// A row.
#[derive(Debug, Clone)]
pub(super) enum View {
    /// One degree of freedom, and its weight.
    One(usize, f64),
    /// A segment of all degrees of freedom, zeros included.
    Run(Segment),
    /// Too long with its zeros.
    Wide(Row),
}

impl View {
    pub fn new(row: &Row) -> Self {
        let entries = row.entries();
        if let &[(i, weight)] = entries {
            return Self::One(i, weight);
        }
        let first = entries.iter().map(|entry| entry.0).min().unwrap_or(0);
        let length = entries.iter().map(|entry| entry.0 + 1 - first).max().unwrap_or(0);
        if length > FILL * entries.len() {
            return Self::Wide(row.clone());
        }
        let mut run = vec![0.0; length];
        for &(i, weight) in entries {
            if let Some(sum) = run.get_mut(i - first) {
                *sum += weight;
            }
        }
        Self::Run(Segment::from(first, run))
    }

    /// The row times `x`.
    #[inline(always)]
    pub fn of(&self, x: &[f64]) -> f64 {
        match self {
            Self::One(i, weight) => x.get(*i).map_or(0.0, |x| weight * x),
            Self::Run(segment) => segment.dot(x),
            Self::Wide(row) => row.dot(x),
        }
    }

    /// The row times several vectors, each summed in the order of its entries.
    #[inline(always)]
    pub fn each<'a, const K: usize>(&self, vectors: [&'a [f64]; K]) -> [f64; K]
    where
        [&'a [f64]; K]: Columns<f64, K>,
    {
        match self {
            Self::Run(segment) => segment.products(vectors).0,
            Self::One(..) => vectors.map(|x| self.of(x)),
            Self::Wide(row) => vectors.map(|x| row.dot(x)),
        }
    }

    /// The sum of the sizes of the terms of the row times `x`.
    #[inline(always)]
    pub fn size(&self, x: &[f64]) -> f64 {
        match self {
            Self::One(i, weight) => x.get(*i).map_or(0.0, |x| (weight * x).abs()),
            Self::Run(segment) => segment.size(x),
            Self::Wide(row) => row.size(x),
        }
    }
}
