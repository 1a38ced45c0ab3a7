//! `signorini explain`: which model, scheme and solver would be chosen, and why, without running
//! the case.

use super::pace::{Estimate, estimate, words};
use super::request::Changes;
use super::ui::Ui;
use crate::case::{Case, Model, Origin, Support};
use crate::error::Result;
use crate::notes;
use crate::output::summary;
use crate::scene::{self, Density, Flats, LoadKind, Scene, Shape, System, WallLaw};
use crate::scheme::{Integrator, Method, PenaltyLaw, Scheme};
use crate::study::choice::{self, Choice};
use crate::study::truncation::Start;
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
    ui.answer(&text.join("\n"))
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
    let elastic = case.scene.holes().any(|hole| !hole.law.is_rigid());
    if !elastic && case.scene.supports.iter().all(|support| support.friction == 0.0) {
        schemes.push("event: exact, from impact to impact without a step; the reference of `compare`".to_owned());
    }
    schemes.extend(choice::at_holes(&case.scene));
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
    let mut penalties: Vec<String> = penalties(case)?.iter().map(Penalty::line).collect();
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
        let stiffness = wall.and_then(|wall| match wall.law {
            WallLaw::Elastic { stiffness, .. } => Some(stiffness),
            _ => None,
        });
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
        "penalties": penalties(case)?.iter().map(Penalty::document).collect::<Vec<_>>(),
        "notes": case.notes().into_iter().chain(setup(case, choice)).collect::<Vec<_>>(),
    }))
}

/// Notes on the step and the scene that need no run.
fn setup(case: &Case, choice: &Choice) -> Vec<String> {
    let mut said = notes::setup(&case.scene, &choice.method.scheme, case.time.step);
    said.extend(notes::resting(&case.scene));
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
        if let WallLaw::Elastic { stiffness, .. } = wall.law {
            lines.push(format!("{:?}: h² k_a/m = {:.2e}", wall.name, h * h * stiffness / mass));
        }
    }
    lines
}

/// A penalty of the case, and how well its step resolves it.
struct Penalty {
    law: PenaltyLaw,
    integrator: Integrator,
    kappa: f64,
}

fn penalties(case: &Case) -> Result<Vec<Penalty>> {
    let integrator = case.penalty.integrator.unwrap_or_default();
    let least = masses(case).into_iter().fold(f64::INFINITY, f64::min);
    let h = case.time.step;
    let one =
        |&law: &PenaltyLaw| stiffest(&case.scene, law).map(|k| Penalty { law, integrator, kappa: h * h * k / least });
    case.penalty.laws.iter().map(one).collect()
}

impl Penalty {
    fn resolved(&self) -> bool {
        self.kappa < 0.1
    }

    fn line(&self) -> String {
        let verdict = if self.resolved() { "the step resolves the wall" } else { "the step does not resolve the wall" };
        format!("{}, {}: h² k_w/m = {:.2e}, {verdict}", self.law, self.integrator, self.kappa)
    }

    fn document(&self) -> Value {
        json!({
            "law": self.law.to_string(),
            "integrator": self.integrator.to_string(),
            "kappa": self.kappa,
            "resolved": self.resolved(),
        })
    }
}

/// Most walls that are listed one by one.
const MOST_WALLS: usize = 12;

/// The structure as the file describes it, and its reduction; nothing for an oscillator.
fn what(case: &Case) -> Vec<String> {
    let what = match &case.model {
        Model::Oscillator if !case.planes.is_two() => return Vec::new(),
        Model::Oscillator => "an oscillator".to_owned(),
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
    let what = if case.planes.is_two() { format!("{what}, in two planes") } else { what };
    let mut lines = Vec::new();
    if let Some(truncated) = &case.truncated {
        let next = truncated.reduction.next_omega.map_or("nothing is left out".to_owned(), |omega| {
            format!("the next, left out, has {:.6} Hz", omega / std::f64::consts::TAU)
        });
        let n = truncated.reduction.degrees_of_freedom;
        let each = if case.planes.modes() > 1 { " in each plane" } else { "" };
        let modes = truncated.reduction.modes.count() / case.planes.modes();
        lines.push(format!("{what}: {n} degrees of freedom, cut to {modes} modes{each}; {next}"));
    } else {
        lines.push(format!("{what}, in full"));
    }
    lines
}

/// Random loads, motions of the base, and the start, in words.
fn excitations(case: &Case) -> Vec<String> {
    let seconds = |both: bool| if both { " along y, and an independent one along z" } else { "" };
    let line = |(index, origin): (usize, &Origin)| match origin {
        Origin::Random { force, file, both } => {
            let density = match (&force.density, file) {
                (_, Some(file)) => format!("of the density in {file}"),
                (Density::Flat { rms, from, to }, _) => format!("{rms} N RMS from {from} to {to} Hz"),
                (Density::Points(points), _) => format!("of a density of {} points", points.len()),
            };
            let rows = match case.scene.loads.get(index).map(|load| &load.kind) {
                Some(LoadKind::Table(table)) => table.time().len(),
                _ => 0,
            };
            Some(format!(
                "load {}: random{}, {density}, seed {}: a table of {rows} rows, the same for every step and scheme",
                index + 1,
                seconds(*both),
                force.seed
            ))
        }
        Origin::Base { file, .. } => Some(format!(
            "load {}: the base moves as {file} says; displacements are relative to it, and walls move along",
            index + 1
        )),
        Origin::Stated | Origin::Table { .. } | Origin::Second(_) => None,
    };
    let mut lines: Vec<String> = case.written.origins.iter().enumerate().filter_map(line).collect();
    if case.written.start == Start::Equilibrium {
        lines.push("start: at rest in static equilibrium under the constant loads".to_owned());
    }
    lines
}

/// Each support, and what its flats are to the schemes.
fn supports(case: &Case) -> Vec<String> {
    let line = |(support, there): (&Support, &scene::Support)| {
        let off = match there.centre {
            [0.0, 0.0] => String::new(),
            [y, z] => format!(", its centre at ({y}, {z}) m"),
        };
        let rubs = match there.friction {
            0.0 => "without friction, so that its work rate is an upper figure".to_owned(),
            friction => format!("friction {friction}"),
        };
        let (name, place) = (&support.name, &support.place);
        let Some((Flats { flats, .. }, _)) = &support.flats else {
            let (gap, law) = match &there.shape {
                Shape::Round { gap, law: WallLaw::Elastic { stiffness, damping } } => {
                    (*gap, format!("elastic, {stiffness:?} N/m and {damping:?} N s/m"))
                }
                Shape::Round { gap, law } => (*gap, format!("rigid, restitution {}", law.restitution().unwrap_or(0.0))),
                Shape::Flats(_) => (0.0, String::new()),
            };
            return format!(
                "support {name:?}, on {place}: a round hole, a gap of {gap} m all round{off}; {law}, {rubs}"
            );
        };
        let mut gaps: Vec<f64> = flats.iter().map(|flat| flat.gap).collect();
        gaps.sort_by(f64::total_cmp);
        let gap = match (gaps.first(), gaps.last()) {
            (Some(least), Some(most)) if least < most => format!("gaps of {least} to {most} m"),
            (Some(gap), _) => format!("a gap of {gap} m"),
            _ => String::new(),
        };
        let directions: Vec<String> =
            flats.iter().take(MOST_WALLS).map(|flat| format!("{}°", flat.direction)).collect();
        let more = if flats.len() > MOST_WALLS { ", .." } else { "" };
        format!(
            "support {name:?}, on {place}: {} flats towards {}{more}, {gap}{off}; each flat is a wall along its \
             normal, {rubs}",
            flats.len(),
            directions.join(", ")
        )
    };
    let mut lines: Vec<String> =
        case.written.supports.iter().zip(&case.scene.supports).take(MOST_WALLS).map(line).collect();
    if let Some(service) = case.wear.service {
        lines.push(format!("wear: volume = coefficient x work rate x {service:e} s"));
    }
    lines
}

/// Each wall, its location, and the share of the structure's compliance there that a truncation
/// keeps.
fn walls(case: &Case) -> Vec<String> {
    let mut lines = choice::walls(&case.scene);
    for (index, line) in lines.iter_mut().enumerate() {
        if let Some(place) = case.places.get(index).filter(|_| case.has_places()) {
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

/// Stiffness at its face of the stiffest wall or hole of the penalised scene, N/m.
fn stiffest(scene: &Scene, law: PenaltyLaw) -> Result<f64> {
    let scene = scene.penalised(law)?;
    let stiffness = |law: WallLaw| match law {
        WallLaw::Rigid { .. } => 0.0,
        WallLaw::Elastic { stiffness, .. } => stiffness,
        WallLaw::Quartic { epsilon, span } => span * span / epsilon,
    };
    Ok(scene.contact_laws().map(stiffness).fold(0.0, f64::max))
}
