//! What a reader of a sweep's table must know beside it.

use super::Plan;

impl Plan {
    /// Random forces that take time and memory, in words.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.base.large_random_forces().collect()
    }
}
