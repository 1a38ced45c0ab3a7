//! The runs of a sweep that did not fail, by row and realisation.

use super::columns::Source;
use super::measure::depths_column;
use super::status::Status;
use super::table::{REALISATION, REALISATIONS, TABLE, Table, numbers_of};
use crate::error::Result;
use crate::study::realisations::{Deepest, mean_of};
use std::collections::{BTreeMap, BTreeSet};

/// The values of the measures of the runs that did not fail, by row and realisation; of a deepest
/// depth those of the part that is the deepest in the mean of the row, so that their mean is that
/// of `sweep.csv`.
pub(super) struct Runs {
    values: BTreeMap<(u64, u64), Vec<Option<f64>>>,
    /// The bias of taking the largest, by row and number of the measure.
    biases: BTreeMap<(u64, usize), f64>,
}

/// The depths of all parts, by row and number of the measure, with the number of the realisation.
type Depths = BTreeMap<(u64, usize), Vec<(u64, Vec<f64>)>>;

impl Runs {
    /// The runs in the tables of `source`, with the values of `columns`.
    pub fn read(source: &Source<'_>, columns: &[String]) -> Result<Self> {
        let name = if source.seeds.is_some() { REALISATIONS } else { TABLE };
        let table = Table::open(&source.folder.join(name))?;
        let indices = columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>>>()?;
        let list = |(index, column): (usize, &String)| Some((index, table.column(&depths_column(column)?).ok()?));
        let lists: Vec<(usize, usize)> = columns.iter().enumerate().filter_map(list).collect();
        let (row, status) = (table.column("row")?, table.column("status")?);
        let realisation = table.column(REALISATION).ok();
        let (mut values, mut depths) = (BTreeMap::new(), Depths::new());
        table.each(|line| {
            let number = |index: usize| line.number(index).unwrap_or(0.0) as u64;
            if Status::is_good_word(line.text(status)) {
                let (row, k) = (number(row), realisation.map_or(0, number));
                values.insert((row, k), indices.iter().map(|&index| line.number(index)).collect());
                for &(index, column) in &lists {
                    if let Some(list) = numbers_of(line.text(column)) {
                        depths.entry((row, index)).or_default().push((k, list));
                    }
                }
            }
        })?;
        let mut runs = Self { values, biases: BTreeMap::new() };
        runs.take_deepest(depths);
        Ok(runs)
    }

    /// Makes of the deepest depths of single runs those of the part that is the deepest in the
    /// mean.
    fn take_deepest(&mut self, depths: Depths) {
        for ((row, index), own) in depths {
            let (numbers, lists): (Vec<u64>, Vec<Vec<f64>>) = own.into_iter().unzip();
            let deepest = Deepest::of(&lists);
            self.biases.insert((row, index), deepest.bias);
            for (k, list) in numbers.into_iter().zip(lists) {
                let value = self.values.get_mut(&(row, k)).and_then(|values| values.get_mut(index));
                if let (Some(value), Some(own)) = (value, list.get(deepest.part)) {
                    *value = Some(*own);
                }
            }
        }
    }

    /// The bias of measure number `index` in `row`: 0 of all but the deepest depth.
    pub fn bias(&self, row: u64, index: usize) -> f64 {
        self.biases.get(&(row, index)).copied().unwrap_or(0.0)
    }

    /// The values of measure number `index` in `row`, by realisation.
    pub fn of(&self, row: u64, index: usize) -> BTreeMap<u64, f64> {
        let own = self.values.range((row, 0)..=(row, u64::MAX));
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
        let numbers: BTreeSet<u64> = self.values.keys().map(|(row, _)| *row).collect();
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
            let values = each.map(|(r, k)| ((r, k), vec![Some(value(r, k))])).collect();
            Runs { values, biases: BTreeMap::new() }
        };
        let squares = 2.0 * (1.0_f64 / 3.0).powi(2) + 4.0 * (1.0_f64 / 6.0).powi(2);
        assert!((table(3, 2).scatter(0).unwrap() - squares / 2.0).abs() < 1e-12);
        assert_eq!((table(1, 2).scatter(0), table(3, 1).scatter(0), table(3, 2).scatter(1)), (None, None, None));
        // A realisation that one row lacks is left out.
        let mut runs = table(3, 3);
        runs.values.remove(&(2, 3));
        assert_eq!(runs.scatter(0), table(3, 2).scatter(0));
    }

    #[test]
    fn the_deepest_depth_is_that_of_the_part_that_is_the_deepest_in_the_mean() {
        // By the largest of each the mean is 3; the means of the parts are 2 and 1, and the
        // jackknife's pseudo-values are 4 − 2 and 4 − 4.
        let folder = tempfile::tempdir().unwrap();
        let lines = "row,realisation,status,depth_deepest_a_m,depths_a_m\n0,1,ok,4,4.0 0.0\n0,2,ok,2,0.0 2.0\n";
        std::fs::write(folder.path().join(REALISATIONS), lines).unwrap();
        let request = serde_json::json!({ "vary": [], "columns": ["row", "error", "depth_deepest_a_m"], "seeds": 2 });
        let source = Source::new(folder.path(), request.as_object().unwrap(), "");
        let runs = Runs::read(&source, &["depth_deepest_a_m".to_owned()]).unwrap();
        assert_eq!((runs.bias(0, 0), runs.mean(0, 0)), (1.0, Some(2.0)));
        assert_eq!(runs.of(0, 0).into_values().collect::<Vec<_>>(), [4.0, 0.0]);
    }
}
