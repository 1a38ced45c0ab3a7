//! Runs that the judge has refuted: they are reported first, and the command fails after writing
//! its results.

use super::ui::Ui;
use crate::error::{Error, Result};
use crate::residual::Finding;

/// The refuted runs of a command.
#[derive(Debug, Default)]
pub struct Refutations {
    runs: Vec<String>,
    lines: Vec<String>,
}

impl Refutations {
    /// Adds the findings of a run, under the name `run`.
    pub fn see(&mut self, run: &str, findings: &[Finding]) {
        if findings.is_empty() {
            return;
        }
        self.runs.push(run.to_owned());
        self.lines.extend(findings.iter().map(|finding| format!("refuted: {run}: {finding}")));
    }

    /// Adds a run that was refuted where it was made.
    pub fn see_error(&mut self, run: &str, error: &Error) {
        if let Error::Refuted { runs } = error {
            self.runs.push(run.to_owned());
            self.lines.extend(runs.iter().map(|why| format!("refuted: {run}: {why}")));
        }
    }

    /// Adds the refuted runs of another part of the command, which has announced them.
    pub fn join(&mut self, other: Self) {
        self.runs.extend(other.runs);
        self.lines.extend(other.lines);
    }

    /// Prints them before any other message, also with `--quiet`.
    pub fn announce(&self, ui: &Ui) {
        for line in &self.lines {
            ui.alarm(line);
        }
    }

    /// The result of the command.
    ///
    /// # Errors
    /// [`Error::Refuted`] if any run was refuted.
    pub fn verdict(self) -> Result<()> {
        if self.runs.is_empty() { Ok(()) } else { Err(Error::Refuted { runs: self.runs }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::Refuted;

    #[test]
    fn a_command_with_a_refuted_run_fails_and_names_it() {
        let mut refuted = Refutations::default();
        refuted.see("moreau-jean", &[]);
        assert!(Refutations::default().verdict().is_ok());
        let finding = Finding {
            refuted: Refuted::Penetration,
            residual: 26.6,
            tolerance: 1e-6,
            reason: "rounding".into(),
            time_s: 266.0,
            wall: Some("stop".into()),
        };
        refuted.see("event", &[finding]);
        assert_eq!(refuted.lines.len(), 1);
        assert!(refuted.lines[0].starts_with("refuted: event: the body stands behind a rigid wall"), "{refuted:?}");
        let error = refuted.verdict().expect_err("a refuted run");
        assert!(!error.is_request() && error.to_string().contains("event"), "{error}");
    }
}
