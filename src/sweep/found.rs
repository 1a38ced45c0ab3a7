//! The rows of a sweep that earlier processes have computed.

use super::block::Block;
use super::plan::Plan;
use super::shard::Shard;
use crate::error::Result;
use crate::output::journal::Journal;
use crate::scene::State;
use std::collections::BTreeMap;

/// The rows that earlier processes have computed.
#[derive(Debug, Default)]
pub(super) struct RowsFound {
    /// Number of rows done of each chain, of each realisation by itself; empty if none is done.
    done: Vec<u32>,
    /// The states from which interrupted chains continue.
    states: BTreeMap<u64, State>,
}

impl RowsFound {
    pub(super) fn of(plan: &Plan, journal: &mut Journal, shard: Shard) -> Result<Self> {
        let mut found = Self::default();
        if journal.done() == 0 {
            return Ok(found);
        }
        let (length, runs) = (plan.chain_rows(), plan.runs_of_row());
        for own in 0..shard.chains(plan.chains) * runs {
            let place = |along: u64| ((own / runs * length + along) * runs + own % runs) as usize;
            let done = (0..length).find(|&along| !journal.has(place(along))).unwrap_or(length);
            if plan.sweep.followed().is_some() && done > 0 && done < length {
                let last = Block::read(journal, place(done - 1))?.and_then(|block| block.end);
                found.states.extend(last.map(|state| (own, state)));
            }
            found.done.push(done as u32);
        }
        Ok(found)
    }

    /// Number of rows done of chain number `own`, and the state from which the next one starts.
    pub(super) fn chain(&self, own: u64) -> (u64, Option<State>) {
        let done = self.done.get(own as usize).copied().unwrap_or(0);
        (u64::from(done), self.states.get(&own).cloned())
    }
}
