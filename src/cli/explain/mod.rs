//! `signorini explain`: which model, scheme and solver would be chosen, and why, without running
//! the case.

mod model;
mod penalty;

use super::pace::{Estimate, estimate, words};
use super::request::Changes;
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::notes;
use crate::output::summary;
use crate::scene::{System, WallSpring};
use crate::scheme::{Method, Scheme};
use crate::study::choice::{self, Choice};
use model::{MOST_WALLS, excitations, supports, walls, what};
use penalty::Penalty;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::time::Duration;

/// Say which model, scheme and solver a case would get, and why, without running it
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini explain cases/rigid-walls-sine.toml")]
pub struct Args {
    /// Case file, or the name of a built-in case; a file of that name is taken before a built-in
    /// case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    case: String,
    #[command(flatten)]
    changes: Changes,
    /// Modes to keep, in place of the case's
    #[arg(long, value_name = "K")]
    modes: Option<usize>,
}

/// Time for which a run is stepped to estimate its duration.
const MOMENT: Duration = Duration::from_millis(50);

/// One heading of the explanation and its lines.
struct Section {
    heading: &'static str,
    lines: Vec<String>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.changes.case(&args.case, ui)?;
    let case = match args.modes {
        Some(modes) => case.with_modes(modes)?,
        None => case,
    };
    let choice = choice::choose(&case.scene);
    let exact = Method::new(Scheme::Event);
    let [own, event] = [choice.method, exact].map(|method| estimate(&case.scene, &method, case.time.step, MOMENT));
    if ui.json() {
        return ui.document(&document(&case, &choice, own.as_ref(), event.as_ref())?);
    }
    let mut text = vec![format!("{}: {}", case.name, case.title.as_deref().unwrap_or("no title"))];
    for Section { heading, lines } in sections(&case, &choice, own.as_ref(), event.as_ref())? {
        text.push(heading.to_owned());
        text.extend(lines.iter().map(|line| format!("  {line}")));
    }
    ui.prose(&text.join("\n"))
}

fn sections(case: &Case, choice: &Choice, own: Option<&Estimate>, event: Option<&Estimate>) -> Result<Vec<Section>> {
    let mut sections = Vec::new();
    let mut tell = |heading, lines: Vec<String>| {
        if !lines.is_empty() {
            sections.push(Section { heading, lines });
        }
    };
    let mut model = what(case);
    model.extend(choice::body(&case.scene));
    model.extend(supports(case));
    model.extend(walls(case));
    model.push(choice::loads(&case.scene));
    model.extend(excitations(case));
    model.extend(case.notes().iter().map(|note| format!("note: {note}")));
    tell("model", model);
    let mut schemes = vec![format!("{}: {}", choice.method, choice.reason)];
    if choice::takes(&case.scene, &Scheme::Event, case.time.step) {
        schemes.push("event: exact, from impact to impact without a step; the reference of `compare`".to_owned());
    }
    schemes.extend(choice::at_supports(&case.scene, case.time.step));
    tell("scheme", schemes);
    tell("matrices", choice::path(&case.scene, case.time.step).into_iter().collect());
    tell(
        "solver of the quadratic programmes",
        vec![format!("{}: {}", solver(case), choice::qp_reason(&choice.method, &case.scene))],
    );
    let mut steps = step(case);
    steps.extend(setup(case, choice).iter().map(|note| format!("note: {note}")));
    tell("step", steps);
    let time = |name: String, estimate: &Estimate| format!("{name}: {}; {}", duration(estimate), estimate.cause);
    let times = [(choice.method.to_string(), own), ("event".to_owned(), event)];
    tell("time of a run", times.into_iter().filter_map(|(name, one)| Some(time(name, one?))).collect());
    let mut penalties: Vec<String> = Penalty::all(case)?.iter().map(Penalty::line).collect();
    let rigid: Vec<f64> = case.scene.contact_laws().filter_map(|law| law.restitution()).collect();
    if !penalties.is_empty() && rigid.iter().any(|&e| e < 1.0) {
        penalties.push("note: a lossless penalty tends to e = 1, not to the walls' restitution".to_owned());
    }
    tell("penalty, for comparison", penalties);
    Ok(sections)
}

/// The explanation as one JSON document.
fn document(case: &Case, choice: &Choice, own: Option<&Estimate>, event: Option<&Estimate>) -> Result<Value> {
    let h = case.time.step;
    let [slowest, fastest] = case.scene.system.frequencies().map(|omega| omega / TAU);
    let estimate = |of: Option<&Estimate>| of.map(|e| json!({ "seconds": e.seconds, "set_by": e.cause }));
    let seen = |index: usize, words: &String| {
        let wall = case.scene.walls.get(index);
        let stiffness = wall.and_then(|wall| wall.law.spring()).map(|spring| spring.stiffness);
        let mass = masses(case).get(index).copied();
        json!({
            "name": wall.map(|wall| &wall.name),
            "mass_kg": mass,
            "kappa": stiffness.zip(mass).map(|(k, m)| h * h * k / m),
            "in_words": words,
        })
    };
    let walls: Vec<Value> = choice::walls(&case.scene).iter().enumerate().map(|(i, words)| seen(i, words)).collect();
    let mut model = what(case);
    model.extend(choice::body(&case.scene));
    model.extend(supports(case));
    model.push(choice::loads(&case.scene));
    model.extend(excitations(case));
    Ok(json!({
        "program": format!("signorini {}", env!("CARGO_PKG_VERSION")),
        "case": case.name,
        "title": case.title,
        "source": case.source,
        "scene": summary::scene(case),
        "model": model,
        "slowest_frequency_hz": slowest,
        "fastest_frequency_hz": fastest,
        "walls": walls,
        "scheme": choice.method.to_string(),
        "scheme_reason": choice.reason,
        "qp_solver": solver(case),
        "qp_reason": choice::qp_reason(&choice.method, &case.scene),
        "matrices": choice::path(&case.scene, h),
        "step_s": h,
        "steps": (case.scene.duration / h).round() as u64,
        "step_times_omega": h * fastest * TAU,
        "estimated_time": { "scheme": estimate(own), "event": estimate(event) },
        "penalties": Penalty::all(case)?.iter().map(Penalty::document).collect::<Vec<_>>(),
        "notes": case.notes().into_iter().chain(setup(case, choice)).collect::<Vec<_>>(),
    }))
}

/// Notes on the step and the scene that need no run.
fn setup(case: &Case, choice: &Choice) -> Vec<String> {
    let mut said = notes::setup(&case.scene, &choice.method.scheme, case.time.step);
    said.extend(notes::resting(&case.scene, case.time.step));
    said
}

/// The duration of a run in words, estimated from a short piece of it.
fn duration(estimate: &Estimate) -> String {
    if estimate.seconds.is_finite() {
        format!("about {} of stepping", words(estimate.seconds))
    } else {
        "too long to estimate".to_owned()
    }
}

fn solver(case: &Case) -> &'static str {
    if case.scene.holes().any(|hole| !hole.law.is_rigid()) {
        "disks"
    } else if case.scene.turns_or_rubs() {
        "sweeps"
    } else if matches!(case.scene.system, System::Oscillator(_)) {
        "clamp"
    } else {
        "condensed"
    }
}

fn masses(case: &Case) -> Vec<f64> {
    case.scene.wall_masses()
}

/// The step compared with the fastest motion, and with each elastic wall.
fn step(case: &Case) -> Vec<String> {
    let [_, omega] = case.scene.system.frequencies();
    let h = case.time.step;
    let resolved = if omega > 0.0 { format!(", h ω = {:.2e}", h * omega) } else { String::new() };
    let mut lines = vec![format!("{h:e} s, {:.0} steps{resolved}", case.scene.duration / h)];
    for (wall, mass) in case.scene.walls.iter().zip(masses(case)).take(MOST_WALLS) {
        if let Some(WallSpring { stiffness, .. }) = wall.law.spring() {
            lines.push(format!("{:?}: h² k_a/m = {:.2e}", wall.name, h * h * stiffness / mass));
        }
    }
    lines
}
