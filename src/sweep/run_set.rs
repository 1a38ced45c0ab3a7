//! Which runs of a sweep are made together: realisations of chains.

use crate::study::realisations::PILOTS;

/// Runs that are made together, each on one thread.
#[derive(Debug)]
pub(super) enum RunSet {
    /// The first realisations of each chain, so many of so many chains.
    First { of_chain: u64, chains: u64 },
    /// The realisations after the pilots, in all up to each chain.
    Further { ends: Vec<u64> },
}

impl RunSet {
    /// The realisations after the pilots of chains that have so many in all.
    pub fn further(counts: &[u64]) -> Self {
        let more = |end: &mut u64, count: &u64| {
            *end += count.saturating_sub(PILOTS);
            Some(*end)
        };
        Self::Further { ends: counts.iter().scan(0, more).collect() }
    }

    /// How many runs these are.
    pub fn count(&self) -> u64 {
        match self {
            Self::First { of_chain, chains } => of_chain * chains,
            Self::Further { ends } => ends.last().copied().unwrap_or(0),
        }
    }

    /// The number of the chain of run number `run` of these, and that of its realisation, from 0.
    pub fn at(&self, run: u64) -> (u64, u64) {
        match self {
            Self::First { of_chain, .. } => (run / of_chain, run % of_chain),
            Self::Further { ends } => {
                let chain = ends.partition_point(|end| *end <= run);
                let before = chain.checked_sub(1).and_then(|before| ends.get(before)).copied().unwrap_or(0);
                (chain as u64, PILOTS + run - before)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_run_is_there_once() {
        let first = RunSet::First { of_chain: 3, chains: 2 };
        let places = |set: &RunSet| (0..set.count()).map(|run| set.at(run)).collect::<Vec<_>>();
        assert_eq!(places(&first), [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2)]);
        // Chains that need no more than their pilots, at the beginning, amidst and at the end.
        let further = RunSet::further(&[6, 8, 6, 6, 7, 6]);
        assert_eq!(places(&further), [(1, 6), (1, 7), (4, 6)]);
        assert_eq!(RunSet::further(&[6, 6]).count() + RunSet::further(&[]).count(), 0);
    }
}
