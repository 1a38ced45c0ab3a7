//! A few sparse rows over many unknowns.

/// m sparse rows over n unknowns: the matrix G, m × n.
#[derive(Debug, Clone, PartialEq)]
pub struct Rows {
    columns: usize,
    starts: Vec<usize>,
    entries: Vec<(usize, f64)>,
    /// True if every row has one entry, as walls on degrees of freedom have: row i is entry i.
    single: bool,
}

impl Rows {
    /// Rows over `columns` unknowns, each a list of (column, value); entries beyond are left out.
    #[must_use]
    pub fn new<'a>(columns: usize, rows: impl IntoIterator<Item = &'a [(usize, f64)]>) -> Self {
        let (mut starts, mut entries) = (vec![0], Vec::new());
        for row in rows {
            entries.extend(row.iter().copied().filter(|entry| entry.0 < columns));
            starts.push(entries.len());
        }
        let single = starts.iter().enumerate().all(|(i, &start)| start == i);
        Self { columns, starts, entries, single }
    }

    /// n.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// m.
    #[must_use]
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The entries (column, value) of row `i`; empty beyond the last row.
    #[inline]
    #[must_use]
    pub fn row(&self, i: usize) -> &[(usize, f64)] {
        match (self.starts.get(i), self.starts.get(i + 1)) {
            (Some(&from), Some(&to)) => &self.entries[from..to],
            _ => &[],
        }
    }

    /// As [`Self::row`], to give its entries other values.
    #[inline]
    pub(crate) fn row_mut(&mut self, i: usize) -> &mut [(usize, f64)] {
        match (self.starts.get(i), self.starts.get(i + 1)) {
            (Some(&from), Some(&to)) => &mut self.entries[from..to],
            _ => &mut [],
        }
    }

    /// The entries of Σ wᵢ gᵢ over the `weighted` rows, pairs (i, wᵢ); two of one column
    /// stay apart, and products add them.
    pub(crate) fn combination(&self, weighted: impl IntoIterator<Item = (usize, f64)>) -> Vec<(usize, f64)> {
        let part = |(i, weight): (usize, f64)| self.row(i).iter().map(move |&(j, value)| (j, weight * value));
        weighted.into_iter().flat_map(part).collect()
    }

    /// gᵢ · x; entries beyond the length of x count as 0.
    #[inline]
    #[must_use]
    pub fn dot(&self, i: usize, x: &[f64]) -> f64 {
        if self.single {
            let value = |&(j, value): &(usize, f64)| Some(value * x.get(j)?);
            return self.entries.get(i).and_then(value).unwrap_or(0.0);
        }
        self.row(i).iter().map(|&(j, value)| value * x.get(j).copied().unwrap_or(0.0)).sum()
    }

    /// G x, m entries written to `out`.
    #[inline]
    pub fn product(&self, x: &[f64], out: &mut [f64]) {
        for (i, y) in out.iter_mut().enumerate() {
            *y = self.dot(i, x);
        }
    }

    /// Adds `force` · gᵢᵀ to `out`, n entries; what lies beyond its length is left out.
    #[inline]
    pub fn add_transposed(&self, i: usize, force: f64, out: &mut [f64]) {
        for &(j, value) in self.row(i) {
            if let Some(out) = out.get_mut(j) {
                *out += value * force;
            }
        }
    }
}
