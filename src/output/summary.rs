//! `summary.json`: what a run was, what it cost and how far it is to be trusted.

use super::atomic::write_whole;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::residual::Residuals;
use crate::run::Run;
use crate::scene::{LoadKind, Scene, Side, System, WallLaw};
use crate::scheme::Counters;
use crate::statistics::Statistics;
use crate::study::accuracy::Accuracy;
use crate::study::truncation::{ChosenModes, Truncation};
use crate::study::verdict::Verdict;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// The whole of it; every number in SI units.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    program: String,
    case: &'a str,
    title: Option<&'a str>,
    source: Option<&'a str>,
    scene: Value,
    scheme: String,
    scheme_reason: &'a str,
    qp_solver: String,
    qp_reason: &'a str,
    step_s: Option<f64>,
    steps: u64,
    rows: u64,
    counters: Counters,
    wall_clock_s: f64,
    residuals: &'a Residuals,
    impulse_ns: BTreeMap<&'a str, f64>,
    statistics: &'a Statistics,
    wear: &'static str,
    #[serde(flatten)]
    checks: Checks<'a>,
    notes: &'a [String],
}

/// How the run was held against others; each is null where it was not.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub struct Checks<'a> {
    /// Against the same run with half the step.
    pub refinement: Option<&'a Verdict>,
    /// Against the error that was asked for.
    pub accuracy: Option<&'a Accuracy>,
    /// Against the same run with more modes.
    pub truncation: Option<&'a Truncation>,
    /// How the number of modes was chosen.
    pub modes: Option<&'a ChosenModes>,
}

/// Why the scheme and the solver were chosen, in a sentence each.
#[derive(Debug, Clone)]
pub struct Reasons {
    /// Of the scheme.
    pub scheme: String,
    /// Of the solver.
    pub qp: String,
}

/// Writes the summary of `run` on `case`, and of the `checks` made of it, to `path`.
///
/// # Errors
/// [`Error::Io`] where the file cannot be written; it is written whole or not at all.
pub fn write(path: &Path, case: &Case, run: &Run, reasons: &Reasons, checks: Checks<'_>) -> Result<()> {
    let exact = run.scheme == crate::scheme::Scheme::Event;
    let mut impulse_ns = BTreeMap::new();
    for wall in run.trajectory.walls() {
        impulse_ns.insert(wall.as_str(), run.trajectory.impulse(wall)?);
    }
    let summary = Summary {
        program: format!("signorini {}", env!("CARGO_PKG_VERSION")),
        case: &case.name,
        title: case.title.as_deref(),
        source: case.source.as_deref(),
        scene: scene(&case.scene),
        scheme: run.scheme.to_string(),
        scheme_reason: &reasons.scheme,
        qp_solver: if run.scheme.has_qp() { run.backend.to_string() } else { "none".into() },
        qp_reason: &reasons.qp,
        step_s: (!exact).then_some(run.grid.step),
        steps: run.counters.steps,
        rows: run.grid.rows + 1,
        counters: run.counters,
        wall_clock_s: run.seconds,
        residuals: &run.residuals,
        impulse_ns,
        statistics: &run.statistics,
        wear: "impact power only: contact is frictionless and the motion normal to the wall, so there is no sliding wear here",
        checks,
        notes: &run.notes,
    };
    let failed =
        |e: serde_json::Error| Error::Io { path: path.display().to_string(), reason: e.to_string(), request: false };
    let mut text = serde_json::to_string_pretty(&summary).map_err(failed)?;
    text.push('\n');
    write_whole(path, text.as_bytes())
}

fn scene(scene: &Scene) -> Value {
    let system = match &scene.system {
        System::Oscillator(o) => {
            json!({ "mass_kg": o.mass, "damping_ns_per_m": o.damping, "stiffness_n_per_m": o.stiffness })
        }
        System::Structure(s) => json!({ "degrees_of_freedom": s.mass.size() }),
    };
    let kind = if matches!(scene.system, System::Oscillator(_)) { "oscillator" } else { "structure" };
    let walls: Vec<Value> = scene
        .walls
        .iter()
        .map(|wall| {
            let side = if wall.side == Side::Upper { "upper" } else { "lower" };
            let law = match wall.law {
                WallLaw::Rigid { restitution } => json!({ "restitution": restitution }),
                WallLaw::Elastic { stiffness, damping } => {
                    json!({ "stiffness_n_per_m": stiffness, "damping_ns_per_m": damping })
                }
                WallLaw::Quartic { epsilon, span } => json!({ "epsilon_m3_per_n": epsilon, "span_m": span }),
            };
            json!({ "name": wall.name, "side": side, "position_m": wall.position, "law": law })
        })
        .collect();
    let loads: Vec<Value> = scene
        .loads
        .iter()
        .map(|load| match &load.kind {
            LoadKind::Constant { force } => json!({ "constant": { "force_n": force } }),
            LoadKind::Harmonic { amplitude, frequency, phase } => {
                json!({ "harmonic": { "amplitude_n": amplitude, "frequency_hz": frequency, "phase_rad": phase } })
            }
            LoadKind::Impulse { impulse, time } => json!({ "impulse": { "impulse_ns": impulse, "time_s": time } }),
            LoadKind::Table(table) => json!({ "table": { "rows": table.time().len() } }),
        })
        .collect();
    json!({
        kind: system,
        "walls": walls,
        "loads": loads,
        "initial": { "displacement_m": scene.initial.q, "velocity_m_per_s": scene.initial.v },
        "duration_s": scene.duration,
    })
}
