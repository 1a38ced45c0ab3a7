//! The share of each key in the variance of each measure, from a sweep whose values are drawn at
//! random.
//!
//! Each key is scaled to x ∈ [−1, 1] over the range that was drawn, in its logarithm where that is
//! how it was drawn. With the Legendre polynomials P₁, P₂, P₃ the additive model
//!
//! y ≈ β₀ + Σ_k f_k(x_k),   f_k = Σ_d β_kd P_d,
//!
//! is fitted to the rows by least squares; s² = RSS/(N − p) is the variance of what it leaves, with
//! N rows and p = 1 + 3K coefficients. Of the sum of squares TSS = Σ(y − ȳ)²
//!
//! key k has         (Σᵢ f_k(yᵢ − ȳ) − 3 s²)/TSS,
//! all else has      (N − 1) s²/TSS,
//!
//! which add up to 1. The terms with s² take out what the coefficients fit by chance, as in the
//! adjusted R², so that the share of a key without any effect scatters about 0. Where y is a mean
//! over realisations of random loads, the variance that it has from them ([`Runs::scatter`] over
//! their number) is the share of the realisations; what is left is that of interactions of keys and
//! of terms beyond the third degree.
//!
//! The interval of a share is that of the jackknife by groups (Quenouille 1956,
//! doi:10.1093/biomet/43.3-4.353; Tukey): row i belongs to group i mod G, the share is computed
//! anew without each group, and the G values θ_g about their mean give the half width
//! t √((G − 1)/G Σ(θ_g − θ̄)²) with Student's t of G − 1 degrees of freedom. G is a prime, so that
//! no group has a pattern of Sobol's points. Rows of a Latin hypercube or of Sobol's points fill
//! their range more evenly than independent ones: there the intervals are wider than need be. The
//! scatter of realisations counts as known.

use super::columns::{Source, SweepAxis};
use super::instability::is_meaningless;
use super::measure::Measure;
use super::picture::Picture;
use super::runs::Runs;
use super::status::Status;
use super::table::{SEEDS, TABLE, Table};
use crate::error::Result;
use crate::output::csv::digits;
use crate::output::extent;
use crate::output::figure::Scale;
use crate::statistics::student_95;
use nalgebra::{DMatrix, DVector};

/// The highest degree of the polynomials of a key.
const DEGREE: usize = 3;

/// Values of a measure that differ by less than this share of the largest are the same: some
/// hundred roundings of a run.
const ROUNDING: f64 = 1e-13;

/// Number of groups of the jackknife.
const GROUPS: usize = 13;

/// Rows for each coefficient below which shares are told with a caution.
const FEW: usize = 3;

/// A share further below 0 than this is more than the scatter of enough rows and realisations.
const BELOW_0: f64 = -0.05;

/// The columns of `shares.csv`.
pub(super) const HEADER: [&str; 7] = ["key", "place", "measure", "unit", "share", "half_width_95", "rows"];

/// What is no key in the column `key`: what interactions have, and what the means scatter.
pub(crate) const NO_KEY: [&str; 2] = ["interactions", "realisations"];

/// A share in the variance of a measure.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Share {
    /// The key, or what is no key.
    pub key: String,
    pub share: f64,
    /// Half the width of its 95 % interval; `None` where the rows without one group are too few.
    pub half_width_95: Option<f64>,
}

/// The shares in the variance of one measure at one place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shares {
    /// The column of the measure, and its parts.
    pub column: String,
    pub place: String,
    pub measure: String,
    /// Of each key, then of what is no key; empty where there are too few rows, or the measure is
    /// the same in all of them.
    pub parts: Vec<Share>,
    /// Rows that have a value, and the coefficients that are fitted to them.
    pub rows: usize,
    pub coefficients: usize,
}

/// A row: the keys, the measure, and the number of realisations of which it is the mean.
type Point = (Vec<f64>, f64, f64);

impl Shares {
    /// Its lines of `shares.csv`.
    pub(super) fn lines(&self) -> impl Iterator<Item = Vec<String>> {
        let unit = self.measure.parse::<Measure>().ok().and_then(Measure::unit).unwrap_or_default();
        self.parts.iter().map(move |Share { key, share, half_width_95 }| {
            let words = [key, &self.place, &self.measure, unit].map(str::to_owned);
            let numbers = [digits(Some(*share)), digits(*half_width_95), self.rows.to_string()];
            words.into_iter().chain(numbers).collect()
        })
    }
}

/// Number of coefficients of the fit over so many keys.
pub(crate) const fn coefficients(keys: usize) -> usize {
    1 + DEGREE * keys
}

/// What to know of the shares that so many rows give with so many coefficients, and of which the
/// `least` is this; `None` where the rows are many and no share is far below 0, by which the others
/// together exceed 1.
pub(crate) fn caution(rows: usize, coefficients: usize, least: Option<f64>) -> Option<String> {
    if rows <= coefficients {
        Some(format!("note: no shares of the keys from {rows} rows with a value: they take more than {coefficients}"))
    } else if rows < FEW * coefficients {
        let text = "the shares scatter; more --points tell more";
        Some(format!("note: {rows} rows for {coefficients} coefficients: {text}"))
    } else {
        least.filter(|least| *least < BELOW_0).map(|least| {
            format!(
                "note: a share of {:.1} % is below 0, and the others exceed 100 %: the rows, or their realisations, \
                 are too few to tell shares apart; more --points or --seeds tell more",
                100.0 * least
            )
        })
    }
}

/// The shares of the keys of `source`, a sweep that draws their values at random, for each measure
/// and place.
///
/// # Errors
/// [`Error::Io`](crate::Error::Io) for a table that cannot be read.
pub(super) fn shares(source: &Source<'_>) -> Result<Vec<Shares>> {
    let coefficients = coefficients(source.axes.len());
    let columns = Picture::default().measure_columns(source)?;
    let names: Vec<String> = columns.iter().map(|(_, name)| name.clone()).collect();
    let of_columns = points(source, &names)?;
    let runs = source.seeds.is_some().then(|| Runs::read(source, &names)).transpose()?;
    let shares = columns.into_iter().zip(of_columns).enumerate().map(|(index, ((measure, column), points))| {
        let over_count = |points: &[Point]| points.iter().map(|point| 1.0 / point.2).sum::<f64>() / points.len() as f64;
        let scatter = runs.as_ref().and_then(|runs| runs.scatter(index));
        let variance = scatter.map(|scatter| scatter * over_count(&points));
        let keys = source.axes.iter().map(|axis| axis.key.clone());
        let parts = if points.len() > coefficients { parts(&points, keys, variance) } else { None };
        Shares {
            place: source.place(&column, &measure),
            parts: parts.unwrap_or_default(),
            rows: points.len(),
            measure,
            column,
            coefficients,
        }
    });
    Ok(shares.collect())
}

/// The rows that have a value in each of `columns` and mean something, with their keys scaled to
/// [−1, 1].
fn points(source: &Source<'_>, columns: &[String]) -> Result<Vec<Vec<Point>>> {
    let table = Table::open(&source.folder.join(TABLE))?;
    let axes = source.axes.iter().map(|axis| table.column(&axis.column)).collect::<Result<Vec<_>>>()?;
    let values = columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>>>()?;
    let (status, error, seeds) = (table.column("status")?, table.column("error")?, table.column(SEEDS).ok());
    let mut all: Vec<Vec<Point>> = vec![Vec::new(); columns.len()];
    table.each(|line| {
        let key = |(axis, &index): (&SweepAxis, &usize)| {
            line.number(index).map(|x| if axis.scale == Scale::Log { x.ln() } else { x })
        };
        let keys: Option<Vec<f64>> = source.axes.iter().zip(&axes).map(key).collect();
        let counts = Status::is_good_word(line.text(status)) && !is_meaningless(line.text(error));
        let (true, Some(keys)) = (counts, keys) else { return };
        let count = seeds.and_then(|seeds| line.number(seeds)).unwrap_or(1.0);
        for (points, &value) in all.iter_mut().zip(&values) {
            points.extend(line.number(value).map(|y| (keys.clone(), y, count)));
        }
    })?;
    all.iter_mut().for_each(|points| scale(points, axes.len()));
    Ok(all)
}

/// Scales each of so many keys to [−1, 1] over the points.
fn scale(points: &mut [Point], axes: usize) {
    for axis in 0..axes {
        let of = |point: &Point| point.0.get(axis).copied().unwrap_or(0.0);
        let (low, high) = extent(points.iter().map(of));
        let scaled = |x: f64| if high > low { (2.0 * x - low - high) / (high - low) } else { 0.0 };
        points.iter_mut().filter_map(|point| point.0.get_mut(axis)).for_each(|x| *x = scaled(*x));
    }
}

/// P₁, P₂ and P₃.
fn legendre(x: f64) -> [f64; DEGREE] {
    [x, 0.5 * (3.0 * x * x - 1.0), 0.5 * x * (5.0 * x * x - 3.0)]
}

/// The share of each of the `keys`, and of what is no key, with its interval; of the measure
/// realisations have this `variance`. `None` where the measure is the same in all rows, or a key
/// is. There are more `points` than coefficients.
fn parts(points: &[Point], keys: impl Iterator<Item = String>, variance: Option<f64>) -> Option<Vec<Share>> {
    let whole = shares_of(points, variance)?;
    let half_widths = half_widths(points, variance);
    let half_width = |index: usize| half_widths.as_ref().and_then(|all| all.get(index).copied());
    let names = keys.chain(NO_KEY.map(str::to_owned));
    let shares = names.zip(whole).enumerate();
    Some(shares.map(|(index, (key, share))| Share { key, share, half_width_95: half_width(index) }).collect())
}

/// The shares of the keys, of interactions, and with a `variance` of realisations.
fn shares_of(points: &[Point], variance: Option<f64>) -> Option<Vec<f64>> {
    let (n, axes) = (points.len(), points.first()?.0.len());
    let p = coefficients(axes);
    let terms = |point: &Point| std::iter::once(1.0).chain(point.0.iter().flat_map(|&x| legendre(x))).collect();
    let rows: Vec<Vec<f64>> = points.iter().map(terms).collect();
    let matrix = DMatrix::from_fn(n, p, |i, j| rows[i][j]);
    let y = DVector::from_iterator(n, points.iter().map(|point| point.1));
    let beta = matrix.tr_mul(&matrix).cholesky()?.solve(&matrix.tr_mul(&y));
    let about_mean = y.add_scalar(-y.mean());
    let (total, left) = (about_mean.norm_squared(), (&y - &matrix * &beta).norm_squared());
    // Values that differ by their rounding only are the same, as a largest displacement at a rigid
    // wall.
    if total <= n as f64 * (ROUNDING * y.amax()).powi(2) {
        return None;
    }
    let noise = left / (n - p) as f64;
    let of_key = |axis: usize| {
        let first = 1 + DEGREE * axis;
        let own = matrix.columns(first, DEGREE) * beta.rows(first, DEGREE);
        (own.dot(&about_mean) - DEGREE as f64 * noise) / total
    };
    let mut shares: Vec<f64> = (0..axes).map(of_key).collect();
    let rest = (n - 1) as f64 * noise / total;
    let of_realisations = variance.map(|variance| variance * (n - 1) as f64 / total);
    shares.push(rest - of_realisations.unwrap_or(0.0));
    shares.extend(of_realisations);
    Some(shares)
}

/// Half the widths of the 95 % intervals of these shares; `None` where the points without one group
/// are no more than the coefficients.
fn half_widths(points: &[Point], variance: Option<f64>) -> Option<Vec<f64>> {
    let most = points.len().div_ceil(GROUPS);
    if points.len() - most <= coefficients(points.first()?.0.len()) {
        return None;
    }
    let without = |group: usize| {
        let others = points.iter().enumerate().filter(|(row, _)| row % GROUPS != group);
        shares_of(&others.map(|(_, point)| point.clone()).collect::<Vec<_>>(), variance)
    };
    let values: Vec<Vec<f64>> = (0..GROUPS).map(without).collect::<Option<_>>()?;
    let groups = GROUPS as f64;
    let half_width = |index: usize| {
        let of = || values.iter().filter_map(|shares| shares.get(index));
        let mean = of().sum::<f64>() / groups;
        let squares: f64 = of().map(|share| (share - mean).powi(2)).sum();
        student_95(GROUPS as u64 - 1) * ((groups - 1.0) / groups * squares).sqrt()
    };
    Some((0..values.first()?.len()).map(half_width).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{mix, unit};

    /// Points of three keys, the last without effect, with noise of this standard deviation (by Box
    /// and Muller).
    fn drawn(n: u64, seed: u64, y: impl Fn(f64, f64) -> f64, noise: f64) -> Vec<Point> {
        let number = |k: u64, j: u64| unit(mix(seed, k, j));
        let point = |k: u64| {
            let keys: Vec<f64> = (0..3).map(|j| 2.0 * number(k, j) - 1.0).collect();
            let normal = (-2.0 * (1.0 - number(k, 3)).ln()).sqrt() * (std::f64::consts::TAU * number(k, 4)).cos();
            let value = y(keys[0], keys[1]) + noise * normal;
            (keys, value, 1.0)
        };
        (0..n).map(point).collect()
    }

    fn found(points: &[Point], variance: Option<f64>) -> Vec<f64> {
        let keys = ["a", "b", "c"].map(str::to_owned);
        parts(points, keys.into_iter(), variance).unwrap().into_iter().map(|one| one.share).collect()
    }

    #[test]
    fn shares_of_a_sum_are_those_of_its_terms() {
        // x₁ + 2 x₂² on [−1, 1]: variances 1/3 and 4 (1/5 − 1/9) = 16/45, and 0.04 of the noise.
        let variances = [1.0 / 3.0, 16.0 / 45.0, 0.0, 0.0, 0.04];
        let total: f64 = variances.iter().sum();
        let mut mean = [0.0; 5];
        for seed in 0..50 {
            let shares = found(&drawn(200, seed, |a, b| a + 2.0 * b * b, 0.2), Some(0.04));
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{shares:?}");
            mean.iter_mut().zip(&shares).for_each(|(mean, share)| *mean += share / 50.0);
        }
        for (mean, variance) in mean.iter().zip(variances) {
            // The share of one design scatters by some 0.04, the mean of fifty by 0.006.
            assert!((mean - variance / total).abs() < 0.02, "{mean} {}", variance / total);
        }
    }

    #[test]
    fn intervals_hold_the_shares_of_the_law() {
        let variances = [1.0 / 3.0, 16.0 / 45.0, 0.0, 0.0, 0.04];
        let total: f64 = variances.iter().sum();
        let keys = || ["a", "b", "c"].map(str::to_owned).into_iter();
        for n in [32, 100] {
            let mut held = [0; 5];
            for seed in 0..200 {
                let points = drawn(n, 1000 + seed, |a, b| a + 2.0 * b * b, 0.2);
                let shares = parts(&points, keys(), Some(0.04)).unwrap();
                for ((held, one), variance) in held.iter_mut().zip(&shares).zip(variances) {
                    *held += usize::from((one.share - variance / total).abs() <= one.half_width_95.unwrap());
                }
            }
            // Of 200 intervals of 95 % between 182 and 197 hold, but for 1 in 1000; that of a key
            // without effect, whose share is small and never normal, is wider.
            assert!(held.iter().all(|held| *held >= 182), "{n} rows: {held:?}");
            assert!(held[3] <= 198 && held[4] <= 198, "{n} rows: {held:?}");
        }
        // Without a group there are fewer rows than the eleven that ten coefficients take.
        let few = parts(&drawn(11, 1, |a, _| a, 0.1), keys(), None).unwrap();
        assert!(few.iter().all(|one| one.half_width_95.is_none()), "{few:?}");
    }

    #[test]
    fn what_the_model_is_made_for_is_exact_and_the_rest_is_of_interactions() {
        let cubic = found(&drawn(40, 1, |a, b| a * a * a - 2.0 * a + b, 0.0), None);
        assert!(cubic[3].abs() < 1e-12 && cubic[2].abs() < 1e-12, "{cubic:?}");
        // The product of two keys has no part that depends on one of them. It scatters more where
        // the polynomials are large, so that more is fitted by chance, by up to p/N = 0.05.
        let mean = (0..50).map(|seed| found(&drawn(200, seed, |a, b| a * b, 0.0), None)[3]).sum::<f64>() / 50.0;
        assert!((mean - 1.0).abs() < 0.05, "{mean}");
    }

    #[test]
    fn a_share_far_below_0_is_said_where_the_rows_are_not_few() {
        let said = caution(32, 10, Some(-0.58)).expect("a note");
        assert!(said.contains("-58.0 %") && said.contains("--seeds"), "{said}");
        assert_eq!(caution(32, 10, Some(-0.04)), None);
        assert!(caution(29, 10, Some(-0.58)).expect("a note").contains("29 rows for 10 coefficients"));
    }

    #[test]
    fn a_measure_that_never_changes_has_no_shares() {
        assert_eq!(parts(&drawn(40, 1, |_, _| 3.0, 0.0), std::iter::empty(), None), None);
        // The gap of a wall, reached to rounding.
        assert_eq!(parts(&drawn(40, 1, |a, _| 5e-3 * (1.0 + 1e-15 * a), 0.0), std::iter::empty(), None), None);
        assert!(parts(&drawn(40, 1, |a, _| 5e-3 * (1.0 + 1e-9 * a), 0.0), std::iter::empty(), None).is_some());
    }
}
