//! `summary.json`: the case, the cost and the checks of a run.

mod scene;

pub use scene::scene;

use super::detail::Detail;
use super::realisations;
use super::request::program;
use super::supports;
use super::worn_means;
use crate::case::{Case, FileRead};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::residual::{Finding, Residuals};
use crate::run::Run;
use crate::scheme::Counters;
use crate::statistics::{ContactSite, PlaceKind, Statistics};
use crate::study::accuracy::Accuracy;
use crate::study::realisations::Realisations;
use crate::study::truncation::{ChosenModes, Truncation};
use crate::study::verdict::Verdict;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// All of `summary.json`; every number in SI units.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    program: String,
    case: &'a str,
    refuted: bool,
    findings: &'a [Finding],
    title: Option<&'a str>,
    source: Option<&'a str>,
    case_file: Value,
    files: &'a [FileRead],
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
    /// Of a wall signed as its force, of a round support Σ|p|.
    impulse_whole_run_n_s: BTreeMap<&'a str, f64>,
    statistics: &'a Statistics,
    #[serde(skip_serializing_if = "no_supports")]
    supports: Value,
    wear: &'static str,
    #[serde(flatten)]
    checks: Checks<'a>,
    notes: Vec<String>,
}

/// What was computed beside the run: checks against other runs, each null where it was not made,
/// and what was asked for.
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
    /// What the keys asked for change; absent where none were.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<&'a Value>,
    /// The run among further realisations of its random loads; absent where they were not asked
    /// for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub realisations: Option<&'a Realisations>,
    /// The statistics that the case asks for; absent where it does not.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub detail: Option<&'a Detail>,
}

/// Why the scheme and the solver were chosen, one sentence each.
#[derive(Debug, Clone)]
pub struct Reasons {
    /// Of the scheme.
    pub scheme: String,
    /// Of the solver.
    pub qp: String,
}

/// The impulse of each wall and round support over the whole run, N s.
fn impulses<'a>(case: &'a Case, run: &Run) -> Result<BTreeMap<&'a str, f64>> {
    let impulse = |site: ContactSite<'a>| {
        let impulse = match site.kind {
            PlaceKind::Wall => run.trajectory.impulse(site.name)?,
            PlaceKind::Support => {
                let here = run.trajectory.contacts().iter().filter(|contact| contact.wall == site.wall);
                here.map(|contact| contact.impulse.abs()).sum()
            }
        };
        Ok((site.name, impulse))
    };
    ContactSite::all(&case.scene).map(impulse).collect()
}

/// The summary of `run` on `case`, and of the `checks` made of it, as JSON: what the file holds,
/// and what `run --json` prints, both with what is recorded of the tables beside it. A number that
/// is not finite is null.
///
/// # Errors
/// Never in practice: only walls of the trajectory itself are looked up, and the case was read from
/// its document.
pub fn document(case: &Case, run: &Run, reasons: &Reasons, checks: Checks<'_>) -> Result<Value> {
    let exact = run.scheme.is_exact();
    let study = checks.realisations;
    let summary = Summary {
        program: program(),
        case: &case.name,
        refuted: !run.findings.is_empty(),
        findings: &run.findings,
        title: case.title.as_deref(),
        source: case.source.as_deref(),
        case_file: case.document.json()?,
        files: &case.written.files,
        scene: scene(case),
        scheme: run.scheme.to_string(),
        scheme_reason: &reasons.scheme,
        qp_solver: match run.backend {
            _ if !run.scheme.has_qp() => "none".into(),
            // Round supports and friction have no quadratic programme.
            Backend::Auto => "sweeps".into(),
            backend => backend.to_string(),
        },
        qp_reason: &reasons.qp,
        step_s: (!exact).then_some(run.grid.step),
        steps: run.counters.steps,
        rows: run.grid.rows + 1,
        counters: run.counters,
        wall_clock_s: run.seconds,
        residuals: &run.residuals,
        impulse_whole_run_n_s: impulses(case, run)?,
        statistics: &run.statistics,
        supports: supports::document(case, run),
        wear: if run.statistics.wear.is_empty() {
            "impact power only: contact is frictionless and the motion normal to the wall, so there is no \
             sliding wear here"
        } else {
            "each support and slider has its work rate of sliding; one without friction is an upper figure; the \
             impact power of walls is that of their normal motion alone"
        },
        checks,
        notes: run.notes.iter().cloned().chain(case.notes()).chain(supports::warnings(case, run)).collect(),
    };
    let mut document = serde_json::to_value(&summary)
        .map_err(|error| Error::io("the summary", error.to_string(), false).caused_by(error))?;
    if let Some(study) = study {
        add_study(&mut document["realisations"], case, study);
    }
    // The wear of supports stands under a key of its own, which a scene without supports does not
    // have.
    if let Some(statistics) = document.get_mut("statistics").and_then(Value::as_object_mut) {
        statistics.remove("wear");
        if statistics.get("supports").is_some_and(no_supports) {
            statistics.remove("supports");
        }
    }
    Ok(document)
}

/// Adds to a study of realisations of `case` what follows from it with the data of the case.
fn add_study(out: &mut Value, case: &Case, study: &Realisations) {
    out["worn"] = worn_means::document(case, study);
    out["limit_m"] = json!(case.wear.limit);
    out["seeds"] = realisations::seeds(case);
    out["notes"] = json!([study.groups_in_words(), worn_means::warnings(case, study)].concat());
}

/// True for a scene without supports.
fn no_supports(supports: &Value) -> bool {
    supports.as_array().is_none_or(Vec::is_empty)
}
