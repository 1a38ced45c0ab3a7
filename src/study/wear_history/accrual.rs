//! The work of wear of histories, as it accrues.

use crate::wear::WearWork;

/// The work at each support in each history, J; as rates, W.
pub(super) type Works = Vec<Vec<WearWork>>;

/// Work of wear, J, or rates of it, W.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Accrual {
    /// As found.
    pub found: Works,
    /// Of a single history if each work rate were larger by its half width; none of several.
    pub largest: Works,
}

impl Accrual {
    /// The work, and its rates, at the share `share` of a step of `step` seconds that makes the
    /// work `after` of it, where rates grow straight from `rates` on.
    pub fn within(&self, rates: &Self, after: &Self, step: f64, share: f64) -> (Self, Self) {
        let each = |work: &Works, rates: &Works, after: &Works| -> (Works, Works) {
            let history = |((work, rates), after): ((&Vec<WearWork>, &Vec<WearWork>), &Vec<WearWork>)| {
                let all = work.iter().zip(rates).zip(after);
                all.map(|((work, rate), after)| work.within(rate, after, step, share)).unzip()
            };
            work.iter().zip(rates).zip(after).map(history).unzip()
        };
        let (found, rates_found) = each(&self.found, &rates.found, &after.found);
        let (largest, rates_largest) = each(&self.largest, &rates.largest, &after.largest);
        (Self { found, largest }, Self { found: rates_found, largest: rates_largest })
    }

    /// The straight way from here to `other`, at the share `share` of it.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        Self {
            found: towards(&self.found, &other.found, share),
            largest: towards(&self.largest, &other.largest, share),
        }
    }
}

/// The work of each history at support number `support`.
pub(super) fn at_support(work: &Works, support: usize) -> Vec<WearWork> {
    work.iter().filter_map(|history| history.get(support).cloned()).collect()
}

/// The straight way from the one to the other, at the share `share` of it.
pub(super) fn towards(from: &Works, to: &Works, share: f64) -> Works {
    let history = |(from, to): (&Vec<WearWork>, &Vec<WearWork>)| {
        from.iter().zip(to).map(|(from, to)| from.towards(to, share)).collect()
    };
    from.iter().zip(to).map(history).collect()
}
