//! Matrices from all of their numbers.

use super::pairs::agree;
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;

impl Symmetric {
    /// The matrix with these rows of numbers, both triangles, which must agree to 1e-8 of the
    /// entry or of √|aᵢᵢ aⱼⱼ|; their mean is taken.
    ///
    /// ```
    /// use signorini::linear::Symmetric;
    ///
    /// let stiffness = Symmetric::from_rows(&[[4e4, -1e4], [-1e4, 1e4]])?;
    /// assert_eq!(stiffness.get(0, 1), -1e4);
    /// let refused = Symmetric::from_rows(&[vec![4e4, -1e4], vec![1e4, 1e4]]).unwrap_err();
    /// assert!(refused.to_string().contains("a symmetric matrix"));
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Invalid`] for rows that are no square, a number that is not finite, and a matrix
    /// that is not symmetric.
    pub fn from_rows(rows: &[impl AsRef<[f64]>]) -> Result<Self> {
        let n = rows.len();
        let entry = |i: usize, j: usize| rows[i].as_ref()[j];
        let key = |i: usize, j: usize| Subject::of("matrix").entry(i, j);
        let mut entries = Vec::with_capacity(n * (n + 1) / 2);
        for (i, row) in rows.iter().map(AsRef::as_ref).enumerate() {
            if row.len() != n {
                let found = format!("{} values", row.len());
                return Err(Error::invalid(Subject::of("matrix").row(i), found, format!("{n}, as many as rows")));
            }
            if let Some(j) = row.iter().position(|x| !x.is_finite()) {
                return Err(Error::invalid(key(i, j), format_args!("{:?}", row[j]), "a finite number"));
            }
            for (j, &here) in row.iter().enumerate().take(i + 1) {
                let across = entry(j, i);
                if !agree([here, across], [row[i], entry(j, j)]) {
                    let expected = format!("{across:?} as across the diagonal: a symmetric matrix");
                    return Err(Error::invalid(key(i, j), format_args!("{here:?}"), expected));
                }
                entries.push((i, j, 0.5 * (here + across)));
            }
        }
        Ok(Self::from_entries(n, entries))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_are_no_symmetric_matrix_are_refused_where_they_are_not() {
        let matrix = Symmetric::from_rows(&[[2.0, 1e-9, 0.0], [0.0, 3.0, 0.5], [0.0, 0.5, 4.0]]).unwrap();
        assert_eq!([(0, 1), (1, 2), (2, 2)].map(|(i, j)| matrix.get(i, j)), [5e-10, 0.5, 4.0]);
        assert_eq!(Symmetric::from_rows(&[[0.0; 0]; 0]).unwrap(), Symmetric::zeros(0));
        let refused = |rows: &[Vec<f64>]| Symmetric::from_rows(rows).unwrap_err().to_string();
        for (rows, told) in [
            (vec![vec![1.0, 2.0], vec![2.0]], "matrix, row 2 is 1 values; expected 2, as many as rows"),
            (vec![vec![1.0, 2.0]], "matrix, row 1 is 2 values; expected 1, as many as rows"),
            (vec![vec![1.0, f64::NAN], vec![2.0, 1.0]], "matrix, row 1, column 2 is NaN; expected a finite number"),
            (
                vec![vec![1.0, 2.0], vec![2.0 + 1e-7, 1.0]],
                "matrix, row 2, column 1 is 2.0000001; expected 2.0 as across the diagonal: a symmetric matrix",
            ),
        ] {
            assert_eq!(refused(&rows), told);
        }
    }
}
