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
    /// The straight way from here to `other`, at the share `share` of it.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let each = |from: &Works, to: &Works| {
            let history = |(from, to): (&Vec<WearWork>, &Vec<WearWork>)| {
                from.iter().zip(to).map(|(from, to)| from.towards(to, share)).collect()
            };
            from.iter().zip(to).map(history).collect()
        };
        Self { found: each(&self.found, &other.found), largest: each(&self.largest, &other.largest) }
    }
}
