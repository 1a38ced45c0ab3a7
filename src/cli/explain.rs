//! `signorini explain`: what would be chosen, and why, without running.

use super::request::case;
use super::ui::Ui;
use crate::case::{Case, Model};
use crate::error::Result;
use crate::scene::{Scene, System, WallLaw};
use crate::study::choice;

/// Say which model, scheme and solver a case would get, and why, without running it
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini explain cases/rigid-walls-sine.toml")]
pub struct Args {
    /// Case file, or the name of a built-in case
    case: String,
    /// Modes to keep, in place of the case's
    #[arg(long, value_name = "K")]
    modes: Option<usize>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = case(&args.case)?;
    let case = match args.modes {
        Some(modes) => case.with_modes(modes)?,
        None => case,
    };
    let choice = choice::choose(&case.scene);
    let [_, omega] = case.scene.system.frequencies();
    let masses = case.scene.wall_masses();
    let least = masses.iter().copied().fold(f64::INFINITY, f64::min);
    let h = case.time.step;
    ui.answer(&format!("{}: {}", case.name, case.title.as_deref().unwrap_or("no title")));
    ui.answer("model");
    for line in describe(&case) {
        ui.answer(&format!("  {line}"));
    }
    for line in choice::model(&case.scene) {
        ui.answer(&format!("  {line}"));
    }
    ui.answer("scheme");
    ui.answer(&format!("  {}: {}", choice.method, choice.reason));
    ui.answer("  event: exact, from impact to impact without a step; the reference of `compare`");
    if let Some(path) = choice::path(&case.scene, h) {
        ui.answer("matrices");
        ui.answer(&format!("  {path}"));
    }
    ui.answer("solver of the quadratic programmes");
    let solver = if matches!(case.scene.system, System::Oscillator(_)) { "clamp" } else { "condensed" };
    ui.answer(&format!("  {solver}: {}", choice::qp_reason(&choice.method, &case.scene)));
    ui.answer("step");
    let steps = case.scene.duration / h;
    ui.answer(&format!(
        "  {h:e} s, {steps:.0} steps{}",
        if omega > 0.0 { format!(", h ω = {:.2e}", h * omega) } else { String::new() }
    ));
    for (wall, mass) in case.scene.walls.iter().zip(&masses).take(MOST_WALLS) {
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

/// Most walls that are told one by one.
const MOST_WALLS: usize = 12;

/// What the file says a structure is, where its walls sit, and what a truncation leaves of it; nothing for an oscillator.
fn describe(case: &Case) -> Vec<String> {
    let what = match &case.model {
        Model::Oscillator => return Vec::new(),
        Model::Chain(chain) => format!("a chain of {} masses", chain.masses.len()),
        Model::Bar(bar) => format!("a bar of {} m, {} elements", bar.length, bar.elements),
        Model::Beam(beam) => format!(
            "a tube of {} m, {} elements: EI = {:.4} N m², {:.4} kg/m",
            beam.length,
            beam.elements,
            beam.bending_stiffness(),
            beam.mass_per_metre()
        ),
        Model::Matrices(_) => "a structure by its matrices".to_owned(),
        other => other.kind().to_owned(),
    };
    let mut lines = vec![format!("{what}: {} degrees of freedom", case.whole().system.degrees_of_freedom())];
    let walls = case.scene.walls.iter().zip(&case.places);
    lines.extend(walls.take(MOST_WALLS).map(|(wall, place)| format!("wall {:?} on {place}", wall.name)));
    if let Some(truncated) = &case.truncated {
        let reduction = &truncated.reduction;
        let next = reduction.next_omega.map_or("nothing is left out".to_owned(), |omega| {
            format!("the next, left out, is {:.6} Hz", omega / std::f64::consts::TAU)
        });
        lines.push(format!("cut to {} modes; {next}", reduction.modes.count()));
        for (wall, left) in case.scene.walls.iter().zip(&reduction.walls).take(MOST_WALLS) {
            lines.push(format!(
                "wall {:?}: {:.4} kg where all modes have {:.4} kg, {:.2} % of the static compliance",
                wall.name,
                left.mass_kept,
                left.mass,
                100.0 * left.share()
            ));
        }
    }
    lines.extend(case.notes());
    lines
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
