//! What a reader must know of a run: sentences, drawn from its residuals and counters.

use crate::run::Run;
use crate::scene::{Scene, WallLaw};
use crate::scheme::Scheme;

/// A ledger or an impact gain beyond this share of the energy exchanged is worth a sentence.
const WORTH_SAYING: f64 = 1e-2;

pub(crate) fn notes(scene: &Scene, run: &Run) -> Vec<String> {
    let mut notes = Vec::new();
    let energy = &run.residuals.energy;
    let restitution = |law: WallLaw| if let WallLaw::Rigid { restitution } = law { Some(restitution) } else { None };
    let asked: Vec<f64> = scene.walls.iter().filter_map(|w| restitution(w.law)).collect();
    if run.grid.shortened {
        notes.push(format!(
            "the step was shortened to {:e} s so that steps end on the rows and at the end",
            run.grid.step
        ));
    }
    if run.scheme == Scheme::Newmark && !asked.is_empty() {
        notes.push(
            "newmark is an exhibit: its restitution is between 1/3 and 3, by chance of the phase of each impact".into(),
        );
    }
    if run.scheme == Scheme::ImplicitEuler && asked.iter().any(|&e| e > 0.0) {
        notes.push("implicit-euler realises e = 0, not the walls' own restitution".into());
    }
    if matches!(run.scheme, Scheme::Penalty { .. }) && asked.iter().any(|&e| e < 1.0) {
        notes.push("a penalty spring without damping realises e = 1, not the walls' own restitution".into());
    }
    if energy.impact_loss_j < -WORTH_SAYING * energy.initial_j.max(energy.largest_j) {
        notes.push(format!(
            "the scheme created {:.3e} J at the rigid walls (largest energy of the run {:.3e} J): do not trust this run",
            -energy.impact_loss_j, energy.largest_j
        ));
    } else if energy.residual > WORTH_SAYING {
        notes.push(format!(
            "the energy ledger is open by {:.1} % of the energy exchanged ({:+.3e} J, largest energy {:.3e} J): the step is too large for this scheme",
            100.0 * energy.residual, energy.residual_j, energy.largest_j
        ));
    }
    if run.counters.frozen_steps > 0 {
        notes.push(format!(
            "in {} steps opposite walls took turns: the body crosses the gap in less than a step and stands still; use a smaller step",
            run.counters.frozen_steps
        ));
    }
    notes
}
