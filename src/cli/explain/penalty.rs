//! How well a step resolves the penalties of a case.

use crate::case::Case;
use crate::error::Result;
use crate::scene::Scene;
use crate::scheme::{Integrator, PenaltyLaw, Scheme, Stepper};
use serde_json::{Value, json};

/// A penalty of the case, and how well its step resolves it.
pub(super) struct Penalty {
    law: PenaltyLaw,
    integrator: Integrator,
    /// h² k_w/m.
    kappa: f64,
}

impl Penalty {
    /// All penalties of a case whose scheme takes its scene.
    pub(super) fn all(case: &Case) -> Result<Vec<Self>> {
        let integrator = case.penalty.integrator.unwrap_or_default();
        let least = case.scene.wall_masses().into_iter().fold(f64::INFINITY, f64::min);
        let h = case.time.step;
        let one =
            |&law: &PenaltyLaw| stiffest(&case.scene, law).map(|k| Self { law, integrator, kappa: h * h * k / least });
        let taken = |law: &&PenaltyLaw| Stepper::takes(&case.scene, &Scheme::Penalty { law: **law, integrator }, h);
        case.penalty.laws.iter().filter(|law| **law != PenaltyLaw::None).filter(taken).map(one).collect()
    }

    /// True if the step resolves its wall.
    fn resolved(&self) -> bool {
        self.kappa < 0.1
    }

    /// In words.
    pub(super) fn line(&self) -> String {
        let verdict = if self.resolved() { "the step resolves the wall" } else { "the step does not resolve the wall" };
        format!("{}, {}: h² k_w/m = {:.2e}, {verdict}", self.law, self.integrator, self.kappa)
    }

    pub(super) fn document(&self) -> Value {
        json!({
            "law": self.law.to_string(),
            "integrator": self.integrator.to_string(),
            "kappa": self.kappa,
            "resolved": self.resolved(),
        })
    }
}

/// Stiffness at its face of the stiffest wall or hole of the penalised scene, N/m.
fn stiffest(scene: &Scene, law: PenaltyLaw) -> Result<f64> {
    let scene = scene.penalised(law)?;
    Ok(scene.walls.iter().map(|wall| wall.law).filter_map(|law| law.stiffness()).fold(0.0, f64::max))
}
