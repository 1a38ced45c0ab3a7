//! `signorini run`: one scene, one method.

use super::request::Request;
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::output::atomic::{check_folder, write_whole};
use crate::output::csv;
use crate::output::pictures::{Labelled, Sheet};
use crate::output::summary::{self, Reasons};
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::Method;
use crate::study::choice;
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  signorini run cases/rigid-walls-sine.toml
  signorini run rigid-walls-sine --restitution 0.8 --step 1e-5
  signorini run rigid-walls-sine --scheme penalty --epsilon 1e-9 --integrator trapezoidal
  signorini run elastic-wall --scheme event --out results

Schemes: implicit-euler, paoli-schatzman, moreau-jean, newmark (an exhibit), penalty, event (exact).";

/// Run one case by one scheme: trajectory, contacts, summary and figures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Scheme [default: chosen from the scene; see `signorini explain`]
    #[arg(long, value_name = "NAME")]
    scheme: Option<String>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.request.case()?;
    let choice = choice::choose(&case.scene);
    let (method, reasons) = match &args.scheme {
        Some(name) => {
            let method = args.request.method(name, &case)?;
            (method, Reasons { scheme: "asked for".into(), qp: choice::qp_reason(&method) })
        }
        None => {
            let method = args.request.method(&choice.method.to_string(), &case)?;
            (method, Reasons { scheme: choice.reason, qp: choice::qp_reason(&method) })
        }
    };
    args.request.check_use(&[method])?;
    let folder = args.request.folder(&case, "run");
    check_folder(&folder)?;
    let run = perform(&case, &method, ui)?;
    ui.message(&format!("{method}: {}", reasons.scheme));
    write(&folder, &case, &run, &method, &reasons)?;
    report(&case, &run, &method, ui)?;
    ui.message(&format!("results in {}", folder.display()));
    Ok(())
}

/// Runs `case` by `method` with a progress bar.
pub(super) fn perform(case: &Case, method: &Method, ui: &Ui) -> Result<Run> {
    /// Resolution of the bar.
    const UNITS: f64 = 1000.0;
    let progress = ui.progress(&method.to_string(), UNITS as u64);
    let end = case.scene.duration;
    let options = Options { time: case.time, backend: method.backend };
    let run =
        run_with_progress(&case.scene, &method.scheme, &options, &mut |time| progress.set((UNITS * time / end) as u64));
    progress.finish();
    run
}

/// Writes the files of one run into `folder`.
pub(super) fn write(folder: &Path, case: &Case, run: &Run, method: &Method, reasons: &Reasons) -> Result<()> {
    csv::trajectory(&folder.join("trajectory.csv"), &run.trajectory)?;
    csv::contacts(&folder.join("contacts.csv"), &run.trajectory)?;
    let label = method.to_string();
    let runs = [Labelled { label: &label, run, reference: false }];
    let title = case.title.as_deref().unwrap_or(&case.name);
    let sheet = Sheet { title, scene: &case.scene, runs: &runs, until: case.scene.duration };
    for (name, svg) in sheet.figures()? {
        write_whole(&folder.join(name), svg.as_bytes())?;
    }
    summary::write(&folder.join("summary.json"), case, run, reasons)
}

fn report(case: &Case, run: &Run, method: &Method, ui: &Ui) -> Result<()> {
    let headers = [
        "wall",
        "contacts",
        "impulse (N s)",
        "largest force (N)",
        "contact time (%)",
        "impact power (W)",
        "not returned (W)",
    ];
    let mut rows = Vec::new();
    for wall in &run.statistics.walls {
        let none = if wall.contacts == 0 { "-" } else { "impacts" };
        rows.push(vec![
            wall.wall.clone(),
            wall.contacts.to_string(),
            format!("{:.6}", run.trajectory.impulse(&wall.wall)?),
            wall.peak_force_n.max.map_or_else(|| none.into(), |f| format!("{f:.4}")),
            format!("{:.3}", 100.0 * wall.contact_time_ratio),
            format!("{:.6}", wall.impact_power_w),
            format!("{:.6}", wall.unreturned_power_w),
        ]);
    }
    if !rows.is_empty() {
        ui.table(&headers, &rows);
        ui.message("impact power is normal impact only: frictionless contact has no sliding wear in it");
    }
    let r = &run.residuals;
    ui.message(&format!(
        "{method} on {}: {} steps, {} QPs by {}, complementarity {:.1e}, penetration {:.1e} m, energy ledger {:.1e}, {:.3} s",
        case.name, run.counters.steps, run.counters.qp_solves, run.backend, r.complementarity, r.penetration_m, r.energy.residual, run.seconds
    ));
    for note in &run.notes {
        ui.message(&format!("note: {note}"));
    }
    Ok(())
}
