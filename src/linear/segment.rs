//! Sparse vectors whose entries follow one another.

use super::entries::Columns;

/// A vector without the zeros before its first and after its last entry: of a row of one plane,
/// that plane's degrees of freedom alone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Segment {
    first: usize,
    values: Vec<f64>,
}

impl Segment {
    /// Of a vector with all its zeros.
    pub fn of(x: &[f64]) -> Self {
        let first = x.iter().position(|x| *x != 0.0).unwrap_or(0);
        let end = x.iter().rposition(|x| *x != 0.0).map_or(first, |last| last + 1);
        Self { first, values: x.get(first..end).unwrap_or_default().to_vec() }
    }

    /// Of entries (index, value) of which each follows the one before; `None` of others.
    pub fn following(entries: &[(usize, f64)]) -> Option<Self> {
        let first = entries.first().map_or(0, |entry| entry.0);
        let follow = entries.iter().enumerate().all(|(k, &(i, _))| i.checked_sub(first) == Some(k));
        follow.then(|| Self { first, values: entries.iter().map(|entry| entry.1).collect() })
    }

    /// Of a segment of values, the first of which stands at the index `first`.
    pub fn from(first: usize, values: Vec<f64>) -> Self {
        Self { first, values }
    }

    /// True if a vector of length `n` has all the entries that it covers.
    #[inline(always)]
    pub fn fits(&self, n: usize) -> bool {
        self.first + self.values.len() <= n
    }

    /// Its values and those of `x` beside them; none of a shorter `x`.
    #[inline(always)]
    pub fn beside<'a>(&'a self, x: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        match x.get(self.first..self.first + self.values.len()) {
            Some(x) => (&self.values, x),
            None => (&[], &[]),
        }
    }

    /// Its product with `x`; 0 with a shorter one.
    #[inline(always)]
    pub fn dot(&self, x: &[f64]) -> f64 {
        let (values, x) = self.beside(x);
        sum_of_terms(values, x, |term| term)
    }

    /// The sum of the sizes of the terms of its product with `x`.
    #[inline(always)]
    pub fn size(&self, x: &[f64]) -> f64 {
        let (values, x) = self.beside(x);
        sum_of_terms(values, x, f64::abs)
    }

    /// Its products with several vectors, and the sums of the sizes of their terms, each in the
    /// order of the entries; 0 with shorter vectors.
    #[inline(always)]
    pub fn products<'a, const K: usize>(&self, vectors: [&'a [f64]; K]) -> ([f64; K], [f64; K])
    where
        [&'a [f64]; K]: Columns<f64, K>,
    {
        let mut beside = vectors;
        for x in &mut beside {
            *x = x.get(self.first..self.first + self.values.len()).unwrap_or_default();
        }
        let n = beside.iter().fold(self.values.len(), |n, x| n.min(x.len()));
        let beside = beside.cut(n);
        let (mut products, mut sizes) = ([0.0; K], [0.0; K]);
        for (i, weight) in self.values[..n].iter().enumerate() {
            for ((product, size), x) in products.iter_mut().zip(&mut sizes).zip(beside.at(i)) {
                let term = weight * x;
                (*product, *size) = (*product + term, *size + term.abs());
            }
        }
        (products, sizes)
    }

    /// Adds `scale` times the vector to `out`; nothing to a shorter one.
    #[inline(always)]
    pub fn add(&self, scale: f64, out: &mut [f64]) {
        if let Some(out) = out.get_mut(self.first..self.first + self.values.len()) {
            super::update(out, [&self.values], |sum, [value]| sum + value * scale);
        }
    }

    /// Sets the entries of `out` that it covers to 0.
    #[inline(always)]
    pub fn clear(&self, out: &mut [f64]) {
        if let Some(out) = out.get_mut(self.first..self.first + self.values.len()) {
            out.fill(0.0);
        }
    }
}

/// The sum of `of` the products of a and b, in four independent sums, so that their additions
/// overlap.
#[inline(always)]
pub(crate) fn sum_of_terms(a: &[f64], b: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let (mut a, mut b) = (a.chunks_exact(4), b.chunks_exact(4));
    let mut sums = [0.0; 4];
    for (a, b) in a.by_ref().zip(b.by_ref()) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += of(a * b);
        }
    }
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| of(a * b)).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_is_what_the_vector_with_its_zeros_is_and_nothing_of_shorter_ones() {
        // Products of small integers, exact in any order.
        let whole = [0.0, 0.0, 3.0, -1.0, 0.0, 2.0, 5.0, -4.0, 0.0];
        let x: Vec<f64> = (1..=9).map(f64::from).collect();
        let given = Segment::from(2, whole[2..8].to_vec());
        let entries: Vec<(usize, f64)> = (2..8).map(|i| (i, whole[i])).collect();
        for segment in [Segment::of(&whole), given, Segment::following(&entries).unwrap()] {
            assert_eq!(segment, Segment { first: 2, values: whole[2..8].to_vec() });
            assert_eq!((segment.dot(&x), segment.size(&x)), (9.0 - 4.0 + 12.0 + 35.0 - 32.0, 92.0));
            let twice: Vec<f64> = x.iter().map(|x| 2.0 * x).collect();
            assert_eq!(segment.products([&x, &twice]), ([20.0, 40.0], [92.0, 184.0]));
            assert_eq!(segment.products([&x, &twice[..7]]), ([0.0; 2], [0.0; 2]));
            let mut out = [1.0; 9];
            segment.add(-2.0, &mut out);
            assert_eq!(out, [1.0, 1.0, -5.0, 3.0, 1.0, -3.0, -9.0, 9.0, 1.0]);
            segment.clear(&mut out);
            assert_eq!(out, [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
            segment.add(-2.0, &mut out[..7]);
            assert_eq!((segment.dot(&x[..7]), segment.size(&x[..7]), out[2]), (0.0, 0.0, 0.0));
        }
        assert_eq!(Segment::of(&[0.0; 3]).dot(&x), 0.0);
        for apart in [vec![(2, 1.0), (4, 1.0)], vec![(2, 1.0), (1, 1.0)], vec![(2, 1.0), (2, 1.0)]] {
            assert_eq!(Segment::following(&apart), None);
        }
    }
}
