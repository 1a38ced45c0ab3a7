//! `orbit --derivative`: what the keys of the case change.

use super::args::Args;
use crate::case::Case;
use crate::cli::derivative_keys::{derivative_keys, record_effects, show_effects};
use crate::cli::pipeline::Answer;
use crate::error::Result;
use crate::orbit::Shot;
use crate::output::derivatives::FILE;
use crate::output::effects::DerivativeKey;
use crate::output::orbit_derivatives::{self as output, MULTIPLIERS_FILE};
use crate::output::periodic::Known;
use crate::output::results::Results;
use crate::output::table::Table;
use crate::output::varied::check_changes_orbits;
use crate::scene::Scene;
use crate::study::orbit_derivatives::OrbitDerivatives;
use crate::variation::SceneTangent;
use serde_json::Value;

/// The keys asked for, and the derivatives of the scene by them; none where none are asked for.
pub(super) struct Wanted {
    keys: Vec<DerivativeKey>,
    tangents: Vec<SceneTangent>,
}

impl Wanted {
    pub fn of(args: &Args, case: &Case) -> Result<Self> {
        for name in &args.derivative {
            check_changes_orbits("--derivative", name)?;
        }
        let (keys, tangents) = derivative_keys(case, &args.derivative)?;
        Ok(Self { keys, tangents })
    }

    /// The derivatives of an orbit of one degree of freedom.
    pub fn of_events(&self, known: &Known<'_>) -> Result<Option<OrbitDerivatives>> {
        let asked = !self.keys.is_empty();
        asked.then(|| OrbitDerivatives::of_events(known.problem, known.orbit, &self.tangents)).transpose()
    }

    /// The derivatives of an orbit that is known by its state.
    pub fn of_state(&self, scene: &Scene, found: &Shot) -> Result<Option<OrbitDerivatives>> {
        let asked = !self.keys.is_empty();
        asked.then(|| OrbitDerivatives::of_state(scene, found, &self.tangents)).transpose()
    }

    /// Writes the tables.
    pub fn write(&self, case: &Case, found: &OrbitDerivatives, results: &mut Results) -> Result<()> {
        output::write(&results.place(FILE)?, &case.scene, &self.keys, found)?;
        if let Some(multipliers) = &found.multipliers {
            output::write_multipliers(&results.place(MULTIPLIERS_FILE)?, &self.keys, multipliers)?;
        }
        let (table, remarks) = self.effects(case, found);
        record_effects(results, table, &remarks);
        Ok(())
    }

    /// The table of what 1 % more of each key changes, and what a reader of it must know.
    fn effects(&self, case: &Case, found: &OrbitDerivatives) -> (Option<Table>, Vec<String>) {
        (output::table(&case.scene, &self.keys, found), output::remarks(&case.scene, &self.keys, found))
    }

    /// The derivatives as JSON.
    pub fn document(&self, case: &Case, found: &OrbitDerivatives) -> Value {
        output::document(&case.scene, &self.keys, found)
    }

    /// Shows the table of what 1 % more of each key changes.
    pub fn show(&self, answer: &mut Answer, case: &Case, found: &OrbitDerivatives) {
        let (table, remarks) = self.effects(case, found);
        show_effects(answer, table, remarks);
    }
}
