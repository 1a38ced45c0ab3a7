//! The runs of a sweep that did not fail, by row and realisation.

use super::columns::Source;
use super::status::Status;
use super::table::{REALISATION, REALISATIONS, TABLE, Table};
use crate::error::Result;
use crate::study::realisations::mean_of;
use std::collections::{BTreeMap, BTreeSet};

/// The values of the measures of the runs that did not fail, by row and realisation.
pub(super) struct Runs(BTreeMap<(u64, u64), Vec<Option<f64>>>);

impl Runs {
    /// The runs in the tables of `source`, with the values of `columns`.
    pub fn read(source: &Source<'_>, columns: &[String]) -> Result<Self> {
        let name = if source.seeds.is_some() { REALISATIONS } else { TABLE };
        let table = Table::open(&source.folder.join(name))?;
        let indices = columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>>>()?;
        let (row, status) = (table.column("row")?, table.column("status")?);
        let realisation = table.column(REALISATION).ok();
        let mut runs = BTreeMap::new();
        table.each(|line| {
            let number = |index: usize| line.number(index).unwrap_or(0.0) as u64;
            if Status::is_good_word(line.text(status)) {
                let values = indices.iter().map(|&index| line.number(index)).collect();
                runs.insert((number(row), realisation.map_or(0, number)), values);
            }
        })?;
        Ok(Self(runs))
    }

    /// The values of measure number `index` in `row`, by realisation.
    pub fn of(&self, row: u64, index: usize) -> BTreeMap<u64, f64> {
        let own = self.0.range((row, 0)..=(row, u64::MAX));
        own.filter_map(|((_, k), values)| Some((*k, (*values.get(index)?)?))).collect()
    }

    /// The mean of them.
    pub fn mean(&self, row: u64, index: usize) -> Option<f64> {
        let values: Vec<f64> = self.of(row, index).into_values().collect();
        (!values.is_empty()).then(|| mean_of(&values).0)
    }

    /// The variance of measure number `index` within rows beside what the realisations have in
    /// common, whose seeds are the same in every row: Σ(y_rk − ȳ_r − ȳ_k + ȳ)² over (R − 1)(K − 1),
    /// for R rows and the K realisations that all of them have. `None` for fewer than two of
    /// either.
    pub fn scatter(&self, index: usize) -> Option<f64> {
        let numbers: BTreeSet<u64> = self.0.keys().map(|(row, _)| *row).collect();
        let rows: Vec<BTreeMap<u64, f64>> = numbers.into_iter().map(|row| self.of(row, index)).collect();
        let in_all = |k: &&u64| rows.iter().all(|row| row.contains_key(*k));
        let common: Vec<u64> = rows.first()?.keys().filter(in_all).copied().collect();
        let table: Vec<Vec<f64>> =
            rows.iter().map(|row| common.iter().filter_map(|k| row.get(k)).copied().collect()).collect();
        let (r, k) = (table.len(), common.len());
        if r < 2 || k < 2 {
            return None;
        }
        let of_row: Vec<f64> = table.iter().map(|row| mean_of(row).0).collect();
        let column = |k: usize| table.iter().filter_map(|row| row.get(k)).copied().collect::<Vec<f64>>();
        let of_realisation: Vec<f64> = (0..k).map(|k| mean_of(&column(k)).0).collect();
        let all = mean_of(&of_row).0;
        let left = table.iter().zip(&of_row).flat_map(|(row, of_row)| {
            row.iter().zip(&of_realisation).map(move |(y, of_realisation)| (y - of_row - of_realisation + all).powi(2))
        });
        Some(left.sum::<f64>() / ((r - 1) * (k - 1)) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_realisations_have_in_common_is_no_scatter() {
        // 10 r + 3 k, and 1 more at one place of a table of 3 × 2: its residuals are ±1/3 and ±1/6.
        let value = |r: u64, k: u64| 10.0 * r as f64 + 3.0 * k as f64 + if (r, k) == (1, 2) { 1.0 } else { 0.0 };
        let table = |rows: u64, of: u64| {
            let each = (0..rows).flat_map(|r| (1..=of).map(move |k| (r, k)));
            Runs(each.map(|(r, k)| ((r, k), vec![Some(value(r, k))])).collect())
        };
        let squares = 2.0 * (1.0_f64 / 3.0).powi(2) + 4.0 * (1.0_f64 / 6.0).powi(2);
        assert!((table(3, 2).scatter(0).unwrap() - squares / 2.0).abs() < 1e-12);
        assert_eq!((table(1, 2).scatter(0), table(3, 1).scatter(0), table(3, 2).scatter(1)), (None, None, None));
        // A realisation that one row lacks is left out.
        let mut runs = table(3, 3);
        runs.0.remove(&(2, 3));
        assert_eq!(runs.scatter(0), table(3, 2).scatter(0));
    }
}
