//! The chains of a sweep, computed on several threads.

use super::batched::TOGETHER;
use super::found::RowsFound;
use super::plan::{Plan, Point};
use super::request::Kernel;
use super::row::Row;
use super::run_set::RunSet;
use super::shard::Shard;
use crate::error::Result;
use crate::interrupt::Carried;
use crate::parallel::{Take, on_threads};

impl Plan {
    /// Computes the `runs` of the chains of `shard` on `threads` threads, each from the row after
    /// those `found`.
    /// Every row, those of a chain in their order, goes through `convert` on its own thread, and
    /// then to `receive` on this one. Chains begin in their order, so the rows of a journal are
    /// nearly sorted.
    pub(super) fn compute<T: Send>(
        &self,
        (shard, runs): (Shard, &RunSet),
        threads: usize,
        found: &RowsFound,
        convert: &(dyn Fn(Row) -> T + Sync),
        receive: &mut dyn FnMut(Option<T>) -> Result<()>,
    ) -> Result<()> {
        let interrupt = Carried::here();
        let work = |group: u64, send: &mut Take<'_, T>| {
            self.group(group, (shard, runs), found, &mut |row| {
                interrupt.check()?;
                Ok(send(convert(row)))
            })
        };
        on_threads(self.groups(shard, runs), threads, &work, receive)
    }

    /// Number of groups of `runs`, those of chains of `shard`; a group is computed by one thread.
    /// Each realisation of a chain is a group.
    pub(super) fn groups(&self, shard: Shard, runs: &RunSet) -> u64 {
        if self.sweep.kernel == Kernel::Batch { shard.chains(self.chains).div_ceil(TOGETHER) } else { runs.count() }
    }

    /// Computes the rows of group number `group` that were not `found`, one after another, and
    /// passes each to `take` until that returns false.
    ///
    /// # Errors
    /// Those of `take`.
    pub(super) fn group(
        &self,
        group: u64,
        (shard, runs): (Shard, &RunSet),
        found: &RowsFound,
        take: &mut dyn FnMut(Row) -> Result<bool>,
    ) -> Result<()> {
        if self.sweep.kernel == Kernel::Batch {
            let chains = group * TOGETHER..shard.chains(self.chains).min((group + 1) * TOGETHER);
            let open = chains.filter(|own| found.chain(*own).0 == 0);
            let points: Vec<Point> = open.map(|own| self.point(shard.chain(own), 0)).collect();
            for row in self.batched(&points) {
                if !take(row)? {
                    break;
                }
            }
            return Ok(());
        }
        let (own, index) = runs.at(group);
        let (done, mut start) = found.chain(own * self.runs_of_row() + index);
        let chain = shard.chain(own);
        for along in done..self.chain_rows() {
            let realisation = self.sweep.realisations.map(|_| index + 1);
            let row = self.row(&Point { realisation, ..self.point(chain, along) }, start.as_ref());
            // A row that failed leaves no state: the next one starts from the case's initial state.
            start = row.end.clone().filter(|_| self.sweep.followed().is_some());
            if !take(row)? {
                break;
            }
        }
        Ok(())
    }
}
