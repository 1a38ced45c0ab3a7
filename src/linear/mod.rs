//! Symmetric matrices, rows and factors of structures: diagonal, banded, sparse or dense. This
//! module uses nothing else of the crate.
//!
//! | type | what it holds |
//! |---|---|
//! | [`Symmetric`] | a symmetric matrix, by the rows of its lower triangle |
//! | `MatrixPolynomial` (`polynomial.rs`) | M + sC + s²K for many s |
//! | [`Rows`] | a few sparse rows, such as those of walls |
//! | `Operator` (`operator.rs`) | a symmetric matrix made ready for products, by diagonals where it is a band |
//! | [`Factor`] | L D Lᵀ of a positive definite matrix: a band's own, or a sparse one with a fill-reducing order |
//!
//! # Files
//!
//! Symmetric matrices, rows, products and factors: `symmetric.rs`, `rows.rs`, `operator.rs` and
//! `factor.rs` hold the types above (`definite.rs` is the error of a matrix without a factor);
//! `band.rs` and `band_factor.rs` for narrow, diagonal and full matrices, `sparse.rs` for all
//! others; `fourier.rs` is the fast Fourier transform; `segment.rs` and `entries.rs` are loops over
//! vectors with vector instructions.

mod band;
mod band_factor;
mod definite;
mod entries;
mod factor;
pub(crate) mod fourier;
mod operator;
mod polynomial;
mod rows;
mod segment;
mod sparse;
mod symmetric;

pub(crate) use band::sum_of_products;
pub use definite::NotDefinite;
pub(crate) use entries::{Columns, Lanes, Pass, lane_operators, pass, running_max, update};
pub use factor::Factor;
#[cfg(test)]
pub(crate) use factor::counted;
pub(crate) use operator::Operator;
pub(crate) use polynomial::MatrixPolynomial;
pub use rows::Rows;
pub(crate) use segment::{Segment, sum_of_terms};
pub(crate) use sparse::negative_pivots;
pub use symmetric::Symmetric;
