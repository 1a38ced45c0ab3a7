//! Shards: parts of a sweep that are computed separately.

use super::plan::Plan;
use crate::error::{Error, Result};
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Part `index` of `of`: the chains `index` − 1, `index` − 1 + `of`, …, so that expensive and cheap
/// chains are spread evenly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// From 1 to `of`.
    index: u64,
    of: u64,
}

impl Default for Shard {
    /// The whole sweep.
    fn default() -> Self {
        Self::WHOLE
    }
}

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Self = Self { index: 1, of: 1 };

    /// Number of the shard, from 1.
    #[must_use]
    pub fn index(self) -> u64 {
        self.index
    }

    /// Number of shards.
    #[must_use]
    pub fn of(self) -> u64 {
        self.of
    }

    /// The folder of its results, within `folder`, that of all shards.
    #[must_use]
    pub fn folder(self, folder: &Path) -> PathBuf {
        if self == Self::WHOLE {
            folder.to_owned()
        } else {
            folder.join(format!("shard-{}-of-{}", self.index, self.of))
        }
    }

    /// Number of its chains, of `chains` in all.
    pub(super) fn chains(self, chains: u64) -> u64 {
        (chains + self.of - self.index) / self.of
    }

    /// The number in the sweep of its chain number `own`.
    pub(super) fn chain(self, own: u64) -> u64 {
        own * self.of + self.index - 1
    }

    /// The position among its runs of run number `run` of `plan`; `None` for a run of another
    /// shard. All runs of a row are in one shard.
    pub(super) fn place(self, plan: &Plan, run: u64) -> Option<usize> {
        let (row, of_row) = (run / plan.runs_of_row(), run % plan.runs_of_row());
        let (chain, along) = (row / plan.chain_rows(), row % plan.chain_rows());
        let own = chain.checked_sub(self.index - 1).filter(|c| c % self.of == 0 && chain < plan.chains)? / self.of;
        usize::try_from((own * plan.chain_rows() + along) * plan.runs_of_row() + of_row).ok()
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let wrong = || Error::invalid("--shard", format_args!("{text:?}"), "I/N with I from 1 to N, such as 3/128");
        let (index, of) = text.split_once('/').ok_or_else(wrong)?;
        let number = |text: &str| text.trim().parse::<u64>().map_err(|_| wrong());
        let shard = Self { index: number(index)?, of: number(of)? };
        if shard.index == 0 || shard.index > shard.of || shard.of > 1_000_000 { Err(wrong()) } else { Ok(shard) }
    }
}
