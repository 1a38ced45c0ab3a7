//! What a reader of a sweep's table must know beside it.

use super::Plan;

impl Plan {
    /// What a reader of the results must know of the case as it stands, and random forces that take
    /// time and memory, in words. Whether its flow is stable, each row says for itself.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let flow = self.base.unstable_in_flow();
        let own = self.base.notes().into_iter().filter(|note| flow.as_ref() != Some(note));
        own.chain(self.base.large_random_forces()).collect()
    }
}
