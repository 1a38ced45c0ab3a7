//! `run --derivative`: what the keys of the case change.

use crate::case::Case;
use crate::cli::derivative_keys::{derivative_keys, record_effects, show_effects};
use crate::cli::pipeline::Answer;
use crate::error::{Error, Result};
use crate::output::derivatives::{self as output, FILE, STATES_FILE};
use crate::output::effects::DerivativeKey;
use crate::output::results::Results;
use crate::output::table::Table;
use crate::scheme::Scheme;
use crate::study::derivatives::Derivatives;
use crate::variation::SceneTangent;
use serde_json::Value;

/// Keys by which a run is differentiated.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct DerivativeKeys {
    /// Derivatives of the contacts by these keys of the case, in derivatives.csv and a table of
    /// what 1 % more of each changes; of the exact motion, so that the scheme is event
    #[arg(
        long,
        value_name = "KEY,...",
        value_delimiter = ',',
        conflicts_with_all = ["accuracy", "count", "until_interval"]
    )]
    derivative: Vec<String>,
}

/// The derivatives of the scene of a case with respect to the keys asked for.
pub(super) struct Wanted {
    keys: Vec<DerivativeKey>,
    tangents: Vec<SceneTangent>,
}

impl DerivativeKeys {
    /// The keys, where any are asked for.
    pub(super) fn asked(&self) -> Option<&[String]> {
        (!self.derivative.is_empty()).then_some(&self.derivative)
    }

    /// The scheme that the derivatives need, where any are asked for.
    pub(super) fn scheme(&self) -> Option<String> {
        (!self.derivative.is_empty()).then(|| Scheme::Event.to_string())
    }

    /// The derivatives of the scene of `case`, whose run is `asked` for by this scheme; `None`
    /// where none are asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for another scheme than event, or a key that is asked for twice; as
    /// [`Derivatives::check`] and [`Case::tangent`].
    pub(super) fn wanted(&self, asked: Option<&str>, case: &Case) -> Result<Option<Wanted>> {
        let Some(scheme) = self.scheme() else { return Ok(None) };
        if let Some(other) = asked.filter(|name| name.trim() != scheme) {
            let expected = "event: derivatives are those of the exact motion";
            return Err(Error::invalid("--scheme beside --derivative", other, expected));
        }
        // Before the keys are looked at: of what no run has, no key is at fault.
        Derivatives::check(&case.scene)?;
        let (keys, tangents) = derivative_keys(case, &self.derivative)?;
        Ok(Some(Wanted { keys, tangents }))
    }
}

impl Wanted {
    /// Computes the derivatives and writes their tables.
    ///
    /// # Errors
    /// As [`Derivatives::new`] and [`output::write`].
    pub fn write(&self, case: &Case, results: &mut Results) -> Result<Derivatives> {
        let found = Derivatives::new(&case.scene, &self.tangents, case.scene.reached_output_times())?;
        output::write(&results.place(FILE)?, &case.scene, &self.keys, &found)?;
        if !found.motion.time.is_empty() {
            output::write_states(&results.place(STATES_FILE)?, &case.scene, &self.keys, &found)?;
        }
        let (table, remarks) = self.effects(case, &found);
        record_effects(results, table, &remarks);
        Ok(found)
    }

    /// The table of what 1 % more of each key changes, and what a reader of it must know.
    fn effects(&self, case: &Case, found: &Derivatives) -> (Option<Table>, Vec<String>) {
        (
            output::table(&case.scene, &self.keys, found),
            output::remarks(&case.scene, case.time.statistics_from, &self.keys, found),
        )
    }

    /// The derivatives as JSON.
    pub fn document(&self, case: &Case, found: &Derivatives) -> Value {
        output::document(&case.scene, &self.keys, found)
    }

    /// Shows the table of what 1 % more of each key changes.
    pub fn show(&self, answer: &mut Answer, case: &Case, found: &Derivatives) {
        let (table, remarks) = self.effects(case, found);
        show_effects(answer, table, remarks);
    }
}
