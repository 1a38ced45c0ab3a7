//! `signorini explain`: what would be chosen, and why, without running.

use super::request::case;
use super::ui::Ui;
use crate::error::Result;
use crate::scene::{Scene, WallLaw};
use crate::study::choice;

/// Say which model, scheme and solver a case would get, and why, without running it
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini explain cases/rigid-walls-sine.toml")]
pub struct Args {
    /// Case file, or the name of a built-in case
    case: String,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = case(&args.case)?;
    let choice = choice::choose(&case.scene);
    let [_, omega] = case.scene.system.frequencies();
    let masses = case.scene.wall_masses();
    let least = masses.iter().copied().fold(f64::INFINITY, f64::min);
    let h = case.time.step;
    ui.answer(&format!("{}: {}", case.name, case.title.as_deref().unwrap_or("no title")));
    ui.answer("model");
    for line in choice::model(&case.scene) {
        ui.answer(&format!("  {line}"));
    }
    ui.answer("scheme");
    ui.answer(&format!("  {}: {}", choice.method, choice.reason));
    ui.answer("  event: exact, from impact to impact without a step; the reference of `compare`");
    ui.answer("solver of the quadratic programmes");
    ui.answer(&format!("  clamp: {}", choice::qp_reason(&choice.method)));
    ui.answer("step");
    let steps = case.scene.duration / h;
    ui.answer(&format!(
        "  {h:e} s, {steps:.0} steps{}",
        if omega > 0.0 { format!(", h ω = {:.2e}", h * omega) } else { String::new() }
    ));
    for (wall, mass) in case.scene.walls.iter().zip(&masses) {
        if let WallLaw::Elastic { stiffness, .. } = wall.law {
            ui.answer(&format!("  {:?}: h² k_a/m = {:.2e}", wall.name, h * h * stiffness / mass));
        }
    }
    if !case.penalty.laws.is_empty() {
        ui.answer("penalty, for comparison");
        let integrator = case.penalty.integrator.unwrap_or_default();
        for law in &case.penalty.laws {
            let kappa = stiffest(&case.scene, *law).map(|k| h * h * k / least)?;
            let verdict = if kappa < 0.1 { "the step resolves the wall" } else { "the step does not resolve the wall" };
            ui.answer(&format!("  {law}, {integrator}: h² k_w/m = {kappa:.2e}, {verdict}"));
        }
    }
    let rigid: Vec<f64> = case.scene.walls.iter().filter_map(|w| w.law.restitution()).collect();
    if !case.penalty.laws.is_empty() && rigid.iter().any(|&e| e < 1.0) {
        ui.answer("  note: a lossless penalty tends to e = 1, not to the walls' restitution");
    }
    Ok(())
}

/// Stiffness at the wall of the stiffest wall of the penalised scene, N/m.
fn stiffest(scene: &Scene, law: crate::scheme::PenaltyLaw) -> Result<f64> {
    let scene = scene.penalised(law)?;
    let stiffness = |w: &crate::scene::Wall| match w.law {
        WallLaw::Rigid { .. } => 0.0,
        WallLaw::Elastic { stiffness, .. } => stiffness,
        WallLaw::Quartic { epsilon, span } => span * span / epsilon,
    };
    Ok(scene.walls.iter().map(stiffness).fold(0.0, f64::max))
}
