//! `signorini explain`: what would be chosen, and why, without running.

use super::request::case;
use super::ui::Ui;
use crate::case::{Case, Model};
use crate::error::Result;
use crate::notes;
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
    let mut lines = what(&case);
    lines.extend(choice::body(&case.scene));
    lines.extend(walls(&case));
    lines.push(choice::loads(&case.scene));
    lines.extend(case.notes().iter().map(|note| format!("note: {note}")));
    for line in lines {
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
    for note in notes::setup(&case.scene, &choice.method.scheme, h) {
        ui.answer(&format!("  note: {note}"));
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

/// What the file says a structure is, and what it is cut to; nothing for an oscillator.
fn what(case: &Case) -> Vec<String> {
    let what = match &case.model {
        Model::Oscillator => return Vec::new(),
        Model::Chain(_) => "a chain".to_owned(),
        Model::Bar(bar) => format!("a bar of {} m, {} elements", bar.length, bar.elements),
        Model::Beam(beam) => format!(
            "a tube of {} m, {} elements, EI = {:.4} N m² and {:.4} kg/m",
            beam.length,
            beam.elements,
            beam.bending_stiffness(),
            beam.mass_per_metre()
        ),
        Model::Matrices(_) => "a structure by its matrices".to_owned(),
        Model::Modal(_) => "a structure by its modes".to_owned(),
    };
    let mut lines = Vec::new();
    if let Some(truncated) = &case.truncated {
        let next = truncated.reduction.next_omega.map_or("nothing is left out".to_owned(), |omega| {
            format!("the next, left out, has {:.6} Hz", omega / std::f64::consts::TAU)
        });
        let n = truncated.reduction.degrees_of_freedom;
        lines.push(format!(
            "{what}: {n} degrees of freedom, cut to {} modes; {next}",
            truncated.reduction.modes.count()
        ));
    } else {
        lines.push(format!("{what}, in full"));
    }
    lines
}

/// Each wall, where it sits and what a truncation leaves of the structure there.
fn walls(case: &Case) -> Vec<String> {
    let mut lines = choice::walls(&case.scene);
    for (index, line) in lines.iter_mut().enumerate() {
        if let (Some(place), false) = (case.places.get(index), matches!(case.model, Model::Oscillator)) {
            line.push_str(&format!(", on {place}"));
        }
        if let Some(left) = case.truncated.as_ref().and_then(|t| t.reduction.walls.get(index)) {
            line.push_str(&format!(
                " (all modes: {:.4e} kg; kept of the static compliance: {:.2} %)",
                left.mass,
                100.0 * left.share()
            ));
        }
    }
    let all = lines.len();
    if all > MOST_WALLS {
        lines.truncate(MOST_WALLS);
        lines.push(format!("and {} walls more", all - MOST_WALLS));
    }
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
