//! The depths of the realisations of a row, by the mean of their work rates.
//!
//! The journal keeps the work rates of each run at every support, behind the cells of its line in
//! `realisations.csv`. With all runs of the row they become the depth by their mean, and about it
//! that of each run, as [`WearWork::about_mean`] says, so that the row's mean is the first.

use super::block::Block;
use super::measure::{Measure, depths_column};
use super::plan::Plan;
use super::status::Status;
use super::table::{list_of, numbers_of};
use crate::case::Case;
use crate::error::Result;
use crate::wear::WearWork;

/// The cell of the work rates (W) at a support; empty where they are not known.
pub(super) fn rates_cell(rates: Option<&WearWork>) -> String {
    rates.map_or_else(String::new, |rates| list_of(&[&[rates.total], &rates.sectors[..], &rates.walls].concat()))
}

/// The work rates in such a cell, of a support of so many walls.
fn rates_of(cell: &str, walls: usize) -> Option<WearWork> {
    let numbers = numbers_of(cell)?;
    let (total, parts) = numbers.split_first()?;
    let (sectors, walls) = parts.split_at_checked(parts.len().checked_sub(walls)?)?;
    Some(WearWork { total: *total, sectors: sectors.to_vec(), walls: walls.to_vec() })
}

/// The columns of the depths of one support in `realisations.csv`.
#[derive(Debug, Clone, Copy)]
struct ScarColumns {
    /// The depth where it is deepest, and the depths of all its parts.
    deepest: Option<[usize; 2]>,
    one_scar: Option<usize>,
}

/// The columns of depths in `realisations.csv`.
#[derive(Debug, Clone)]
pub(super) struct Scars {
    status: usize,
    /// The number of columns, and that of those before the lists of depths.
    columns: usize,
    measured: usize,
    supports: Vec<ScarColumns>,
}

impl Scars {
    /// Those of `plan`; `None` where no depth needs the work rates of its realisations.
    pub fn of(plan: &Plan) -> Option<Self> {
        let header = plan.run_header.as_ref().filter(|_| plan.sweep.keeps_work_rates())?;
        let scene = &plan.base.scene;
        let find = |name: &String| header.iter().position(|column| column == name);
        let names = |measure: Measure| measure.columns(scene).into_iter();
        let of_support = |(deepest, one_scar): (String, String)| {
            let list = depths_column(&deepest).as_ref().and_then(find);
            let deepest = find(&deepest).zip(list).map(|(deepest, list)| [deepest, list]);
            ScarColumns { deepest, one_scar: find(&one_scar) }
        };
        let supports: Vec<ScarColumns> =
            names(Measure::DepthDeepest).zip(names(Measure::DepthOneScar)).map(of_support).collect();
        let lists = supports.iter().filter(|columns| columns.deepest.is_some()).count();
        let status = header.iter().position(|column| column == "status")?;
        Some(Self { status, columns: header.len(), measured: header.len() - lists, supports })
    }

    /// Puts depths in the place of the work rates in the `lines` of `runs`, all of row number `row`
    /// of `plan`. Those of runs without valid measures stay empty.
    ///
    /// # Errors
    /// As [`Plan::build`].
    pub fn fill(&self, lines: &mut [Vec<String>], (plan, row, runs): (&Plan, u64, &[Block])) -> Result<()> {
        let mut good = Vec::new();
        for line in lines {
            let rates = line.split_off(self.measured.min(line.len()));
            line.resize(self.columns, String::new());
            if line.get(self.status).is_some_and(|word| Status::is_good_word(word)) {
                good.push((line, rates));
            }
        }
        if good.is_empty() {
            return Ok(());
        }
        // The law of wear does not depend on the start; but where rows follow one another, the
        // start of the case may lie behind the walls of this one.
        let start = runs.first().and_then(|run| run.end.as_ref());
        let (case, _) = plan.build(&plan.point(row / plan.chain_rows(), row % plan.chain_rows()), start)?;
        for (index, columns) in self.supports.iter().enumerate() {
            columns.fill(&mut good, &case, index);
        }
        Ok(())
    }
}

impl ScarColumns {
    /// Puts the depths at support number `index` into each line, from its work rates behind it.
    /// Where a run has none, so has the row.
    fn fill(&self, runs: &mut [(&mut Vec<String>, Vec<String>)], case: &Case, index: usize) {
        let walls = case.scene.supports.get(index).map_or(0, |support| support.walls.len());
        let rates: Option<Vec<WearWork>> = runs.iter().map(|(_, rates)| rates_of(rates.get(index)?, walls)).collect();
        let Some(rates) = rates else { return };
        let all_have = |runs: &[(&mut Vec<String>, Vec<String>)], column: usize| {
            runs.iter().all(|(line, _)| line.get(column).is_some_and(|cell| !cell.is_empty()))
        };
        let mut put = |own: usize, column: usize, depths: Vec<Vec<f64>>| {
            if all_have(runs, own) {
                for ((line, _), depths) in runs.iter_mut().zip(depths) {
                    line.get_mut(column).into_iter().for_each(|cell| *cell = list_of(&depths));
                }
            }
        };
        if let Some([own, list]) = self.deepest {
            put(own, list, case.depths_about_mean(index, &rates));
        }
        if let Some(own) = self.one_scar {
            put(own, own, case.scars_about_mean(index, &rates));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_rates_are_what_was_kept_of_them() {
        for walls in [1, 2] {
            let rates = WearWork { total: 1.5, sectors: vec![0.5, 1.0 / 3.0], walls: vec![1.0; walls] };
            assert_eq!(rates_of(&rates_cell(Some(&rates)), walls), Some(rates));
        }
        assert_eq!((rates_of(&rates_cell(None), 1), rates_of("1.0 2.0", 2), rates_of("1.0 x", 0)), (None, None, None));
    }
}
