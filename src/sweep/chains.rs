//! The chains of a sweep, computed on several threads.

use super::batched::TOGETHER;
use super::found::RowsFound;
use super::plan::{Plan, Point};
use super::request::Kernel;
use super::row::Row;
use super::shard::Shard;
use crate::error::Result;
use crate::interrupt::Carried;
use crate::parallel::{Take, on_threads};

impl Plan {
    /// Computes the chains of `shard` on `threads` threads, each from the row after those `found`.
    /// Every row, those of a chain in their order, goes through `convert` on its own thread, and
    /// then to `receive` on this one. Chains begin in their order, so the rows of a journal are
    /// nearly sorted.
    pub(super) fn compute<T: Send>(
        &self,
        shard: Shard,
        threads: usize,
        found: &RowsFound,
        convert: &(dyn Fn(Row) -> T + Sync),
        receive: &mut dyn FnMut(Option<T>) -> Result<()>,
    ) -> Result<()> {
        let interrupt = Carried::here();
        let work = |group: u64, send: &mut Take<'_, T>| {
            self.group(group, shard, found, &mut |row| {
                interrupt.check()?;
                Ok(send(convert(row)))
            })
        };
        on_threads(self.groups(shard), threads, &work, receive)
    }

    /// Number of groups of chains of `shard`; a group is computed by one thread. Each realisation
    /// of a chain is a group.
    pub(super) fn groups(&self, shard: Shard) -> u64 {
        let chains = shard.chains(self.chains);
        if self.sweep.kernel == Kernel::Batch { chains.div_ceil(TOGETHER) } else { chains * self.runs_of_row() }
    }

    /// Computes the rows of group number `group` that were not `found`, one after another, and
    /// passes each to `take` until that returns false.
    ///
    /// # Errors
    /// Those of `take`.
    pub(super) fn group(
        &self,
        group: u64,
        shard: Shard,
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
        let (done, mut start) = found.chain(group);
        let (chain, realisation) = (shard.chain(group / self.runs_of_row()), group % self.runs_of_row() + 1);
        for along in done..self.chain_rows() {
            let realisation = self.sweep.realisations.map(|_| realisation);
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
