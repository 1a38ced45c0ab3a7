//! What a judge is shown of a step in place of the true values, and one of its findings.

use signorini::{Finding, Refuted, Step};

#[derive(Debug, Clone)]
pub struct Shown {
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub after: Vec<f64>,
    pub impulse: Vec<f64>,
    pub force: Vec<f64>,
}

impl Shown {
    pub fn of(step: &Step<'_>) -> Self {
        Self {
            q: step.q.to_vec(),
            v: step.v.to_vec(),
            after: step.velocity_after.to_vec(),
            impulse: step.impulse.to_vec(),
            force: step.force.to_vec(),
        }
    }

    /// `step` with these values.
    pub fn in_place<'a>(&'a self, step: &Step<'a>) -> Step<'a> {
        let mut shown = *step;
        (shown.q, shown.v, shown.velocity_after) = (&self.q, &self.v, &self.after);
        (shown.impulse, shown.force) = (&self.impulse, &self.force);
        shown
    }
}

/// The finding of that kind.
pub fn of_kind(findings: &[Finding], refuted: Refuted) -> &Finding {
    findings.iter().find(|finding| finding.refuted == refuted).unwrap_or_else(|| panic!("{refuted:?}: {findings:?}"))
}
