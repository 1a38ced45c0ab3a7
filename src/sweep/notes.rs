//! What a reader of a sweep's table must know beside it.

use super::Plan;

impl Plan {
    /// What a reader of the results must know of the case as it stands, and random forces that take
    /// time and memory, in words.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.base.notes().into_iter().chain(self.base.large_random_forces()).collect()
    }
}
