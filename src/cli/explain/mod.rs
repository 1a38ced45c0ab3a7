//! `signorini explain`: which model, scheme and solver would be chosen, and why, without running
//! the case.

mod flow;
mod model;
mod penalty;

use super::case_args::CaseArgs;
use super::pipeline::Answer;
use super::run_time::{RunTime, run_time, time_in_words};
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::output::document::under_head;
use crate::output::summary;
use crate::run::notes;
use crate::scene::{System, WallSpring};
use crate::scheme::{Method, Scheme, Stepper};
use crate::study::choice::{self, Choice};
use model::{MOST_WALLS, excitation_count, excitations, frequencies, frequencies_in_words, supports, walls, what};
use penalty::Penalty;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::time::Duration;

/// Say which model, scheme and solver a case would get, and why, without running it
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini explain cases/rigid-walls-sine.toml")]
pub struct Args {
    #[command(flatten)]
    case: CaseArgs,
    /// Modes to keep, in place of the case's
    #[arg(long, value_name = "K")]
    modes: Option<i64>,
}

/// Time for which a run is stepped to estimate its duration.
const MOMENT: Duration = Duration::from_millis(50);

/// One heading of the explanation and its lines.
struct Section {
    heading: &'static str,
    lines: Vec<String>,
}

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.case.read(ui)?;
    let case = match args.modes {
        Some(modes) => case.with("system.modes", modes)?,
        None => case,
    };
    let choice = choice::choose(&case.scene);
    let times = [choice.method, Method::new(Scheme::Event)]
        .map(|method| run_time(&case.scene, &method, case.time.step, MOMENT));
    let natural = frequencies(&case);
    let mut answer = Answer::new(document(&case, &choice, &times, &natural)?);
    answer.prose(format!("{}: {}", case.name, case.title.as_deref().unwrap_or("no title")));
    for Section { heading, lines } in sections(&case, &choice, &times, &natural)? {
        answer.prose(heading.to_owned());
        lines.iter().for_each(|line| answer.prose(format!("  {line}")));
    }
    Ok(answer)
}

/// The explanation; `times` are those of a run by the chosen scheme, and by the exact one,
/// `natural` the slowest natural frequencies, Hz.
fn sections(case: &Case, choice: &Choice, times: &[Option<RunTime>; 2], natural: &[f64]) -> Result<Vec<Section>> {
    let mut sections = Vec::new();
    let mut tell = |heading, lines: Vec<String>| {
        if !lines.is_empty() {
            sections.push(Section { heading, lines });
        }
    };
    let (mut model, scene) = (what(case), case.without_sliders());
    model.extend(choice::body(&scene));
    model.extend(frequencies_in_words(case, natural));
    model.extend(supports(case));
    model.extend(walls(case));
    model.push(excitation_count(case));
    model.extend(excitations(case));
    model.extend(case.notes().iter().map(|note| format!("note: {note}")));
    tell("model", model);
    tell("fluid-elastic margins", flow::margins(case));
    let mut schemes = vec![format!("{}: {}", choice.method, choice.reason)];
    if Stepper::takes(&case.scene, &Scheme::Event, case.time.step) {
        schemes.push("event: exact, from impact to impact without a step; the reference of `compare`".to_owned());
    }
    schemes.extend(choice::at_supports(&case.scene, case.time.step));
    tell("scheme", schemes);
    tell("matrices", choice::path(&case.scene, case.time.step).into_iter().collect());
    tell(
        "solver of the quadratic programmes",
        vec![format!("{}: {}", solver(case, &choice.method), choice::qp_reason(&choice.method, &case.scene))],
    );
    let mut steps = step(case);
    steps.extend(setup(case, choice).iter().map(|note| format!("note: {note}")));
    tell("step", steps);
    let line = |(name, time): (String, &RunTime)| format!("{name}: {}; {}", in_words(time), time.cause);
    let names = [choice.method.to_string(), "event".to_owned()];
    let known = names.into_iter().zip(times).filter_map(|(name, time)| Some((name, time.as_ref()?)));
    tell("time of a run", known.map(line).collect());
    let mut penalties: Vec<String> = Penalty::all(case)?.iter().map(Penalty::line).collect();
    let rigid: Vec<f64> = case.scene.walls.iter().map(|wall| wall.law).filter_map(|law| law.restitution()).collect();
    if !penalties.is_empty() && rigid.iter().any(|&e| e < 1.0) {
        penalties.push("note: a lossless penalty tends to e = 1, not to the walls' restitution".to_owned());
    }
    tell("penalty, for comparison", penalties);
    Ok(sections)
}

/// The explanation as one JSON document.
fn document(case: &Case, choice: &Choice, times: &[Option<RunTime>; 2], natural: &[f64]) -> Result<Value> {
    let h = case.time.step;
    let [slowest, fastest] = case.scene.system.frequencies().map(|omega| omega / TAU);
    let [own, event] =
        times.each_ref().map(|time| time.as_ref().map(|time| json!({ "seconds": time.seconds, "set_by": time.cause })));
    let masses = case.scene.wall_masses();
    let seen = |(index, words): (usize, String)| {
        let wall = case.scene.walls.get(index);
        let stiffness = wall.and_then(|wall| wall.law.spring()).map(|spring| spring.stiffness);
        let mass = masses.get(index).copied();
        json!({
            "name": wall.map(|wall| &wall.name),
            "mass_kg": mass,
            "kappa": stiffness.zip(mass).map(|(k, m)| h * h * k / m),
            "in_words": words,
        })
    };
    let (mut model, scene) = (what(case), case.without_sliders());
    let walls: Vec<Value> = choice::walls(&scene).into_iter().map(seen).collect();
    model.extend(choice::body(&scene));
    model.extend(supports(case));
    model.push(excitation_count(case));
    model.extend(excitations(case));
    let document = json!({
        "scene": summary::scene(case),
        "model": model,
        "slowest_frequency_hz": slowest,
        "fastest_frequency_hz": fastest,
        "frequencies_hz": natural,
        "walls": walls,
        "scheme": choice.method.to_string(),
        "scheme_reason": choice.reason,
        "qp_solver": solver(case, &choice.method),
        "qp_reason": choice::qp_reason(&choice.method, &case.scene),
        "matrices": choice::path(&case.scene, h),
        "step_s": h,
        "steps": (case.scene.duration / h).round() as u64,
        "step_times_omega": h * fastest * TAU,
        "estimated_time": { "scheme": own, "event": event },
        "penalties": Penalty::all(case)?.iter().map(Penalty::document).collect::<Vec<_>>(),
        "notes": case.notes().into_iter().chain(setup(case, choice)).collect::<Vec<_>>(),
    });
    Ok(under_head(case, document))
}

/// Notes on the step and the scene that need no run.
fn setup(case: &Case, choice: &Choice) -> Vec<String> {
    let mut said = notes::setup(&case.scene, &choice.method.scheme, case.time.step, true);
    let walls = case.scene.walls.len() - case.sliders.len();
    said.extend(notes::resting(&case.scene, walls, case.time.step));
    said.extend(notes::late_output(&case.scene));
    said
}

/// The duration of a run in words, estimated from a short piece of it.
fn in_words(time: &RunTime) -> String {
    if time.seconds.is_finite() {
        format!("about {} of stepping", time_in_words(time.seconds))
    } else {
        "too long to estimate".to_owned()
    }
}

fn solver(case: &Case, method: &Method) -> &'static str {
    if !method.scheme.has_qp() {
        "none"
    } else if choice::takes_disks(method, &case.scene) {
        "disks"
    } else if case.scene.turns_or_rubs() {
        "sweeps"
    } else if matches!(case.scene.system, System::Oscillator(_)) {
        "clamp"
    } else {
        "condensed"
    }
}

/// The step compared with the fastest motion, and with each elastic wall.
fn step(case: &Case) -> Vec<String> {
    let [_, omega] = case.scene.system.frequencies();
    let h = case.time.step;
    let resolved = if omega > 0.0 { format!(", h ω = {:.2e}", h * omega) } else { String::new() };
    let mut lines = vec![format!("{h:e} s, {:.0} steps{resolved}", case.scene.duration / h)];
    lines.extend(case.written.chosen_step.map(|_| {
        "the case gives no step: this is the largest of one digit that is at most 50 µs and a tenth of the period of \
         the fastest mode"
            .to_owned()
    }));
    let flats = case.scene.walls.iter().zip(case.scene.wall_masses()).filter(|(wall, _)| !wall.is_round());
    for (wall, mass) in flats.take(MOST_WALLS) {
        if let Some(WallSpring { stiffness, .. }) = wall.law.spring() {
            lines.push(format!("{:?}: h² k_a/m = {:.2e}", wall.name, h * h * stiffness / mass));
        }
    }
    lines
}
