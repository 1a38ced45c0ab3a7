//! `signorini compare`: the main job.

use super::drawing::Stretch;
use super::noted;
use super::request::Request;
use super::run::{Picture, write};
use super::ui::Ui;
use super::verdicts;
use crate::case::Case;
use crate::error::Result;
use crate::output::atomic::{check_folder, write_whole};
use crate::output::csv;
use crate::output::pictures::{Labelled, Sheet};
use crate::output::summary::{Checks, Reasons};
use crate::scheme::{Method, Scheme};
use crate::study::choice;
use crate::study::compare::{Comparison, Row, any_succeeded, compare, default_methods};
use crate::study::verdict::{self, Verdict};
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  signorini compare cases/rigid-walls-sine.toml
  signorini compare rigid-walls-sine --restitution 0.8
  signorini compare rigid-walls-sine --schemes moreau-jean,paoli-schatzman,implicit-euler,newmark
  signorini compare rigid-walls-sine --schemes 'moreau-jean:theta=0.75;penalty:epsilon=1e-9,integrator=trapezoidal'

Methods are written as in the table. Separate them by commas; where a method's own settings need commas, by semicolons.";

/// Compare methods on one case: constrained QP, penalty and the exact motion, side by side
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    request: Request,
    /// Methods to compare [default: the constrained QP, the same through Clarabel, every penalty of the case]; the exact one is always there
    #[arg(long, value_name = "A,B,…", alias = "scheme")]
    schemes: Option<String>,
    /// Do not repeat the methods with half the step
    #[arg(long)]
    no_verdict: bool,
    #[command(flatten)]
    stretch: Stretch,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.request.case()?;
    let methods = match &args.schemes {
        Some(list) => split(list).map(|name| args.request.method(name, &case)).collect::<Result<Vec<_>>>()?,
        None => {
            let chosen = args.request.method(&choice::choose(&case.scene).method.to_string(), &case)?;
            let integrator = case.penalty.integrator.unwrap_or_default();
            let penalty = |&law| Method::new(Scheme::Penalty { law, integrator });
            if case.scene.walls.is_empty() {
                vec![chosen]
            } else {
                default_methods(chosen, case.penalty.laws.iter().map(penalty))
            }
        }
    };
    args.request.check_use(&methods)?;
    // A stretch that makes no sense is refused before anything runs.
    args.stretch.span(&case, case.scene.duration)?;
    let folder = args.request.folder(&case, "compare");
    check_folder(&folder)?;
    let count = methods.len() as u64 + 1;
    let progress = ui.progress("comparing", if args.no_verdict { count } else { count + count * verdict::COST as u64 });
    let comparison = compare(&case.scene, &methods, &case.time, &|done| progress.set(done))?;
    let mut verdicts = vec![None; comparison.rows.len()];
    if !args.no_verdict {
        verdicts = verdicts::check(&case, &comparison, &|rows| progress.set(count + rows * verdict::COST as u64));
    }
    progress.finish();
    any_succeeded(&comparison)?;
    files(&folder, &case, &comparison, &verdicts, &args.stretch)?;
    table(&case, &comparison, ui);
    for row in &comparison.rows {
        if let Err(error) = &row.outcome {
            ui.message(&format!("- {} failed: {error}", row.method));
        }
    }
    for finding in &comparison.findings {
        ui.message(&format!("- {finding}"));
    }
    if case.penalty.laws.is_empty() && args.schemes.is_none() && case.scene.walls.iter().any(|w| w.law.is_rigid()) {
        ui.message("- the case has no [penalty] table: no penalty was compared");
    }
    for note in noted::of_rows(&comparison).iter().chain(&case.notes()) {
        ui.message(&format!("- {note}"));
    }
    ui.message(&format!("results in {}", folder.display()));
    if !args.no_verdict {
        ui.message(&format!("refinement: {}", verdicts::line(&comparison, &verdicts)));
    }
    Ok(())
}

/// Methods separated by semicolons, or by those commas that begin a new method rather than a setting.
pub(super) fn split(list: &str) -> impl Iterator<Item = &str> {
    let by_semicolon = list.contains(';');
    let mut parts = Vec::new();
    let mut start = 0;
    for (i, c) in list.char_indices() {
        let next = list[i + c.len_utf8()..].split([',', ';']).next().unwrap_or("");
        // `integrator=trapezoidal` is a setting, `penalty:epsilon=1e-9` and `event` are methods.
        let begins = next.contains(':') || !next.contains('=');
        if c == ';' || (c == ',' && !by_semicolon && begins) {
            parts.push(&list[start..i]);
            start = i + c.len_utf8();
        }
    }
    parts.push(&list[start..]);
    parts.into_iter().map(str::trim).filter(|part| !part.is_empty())
}

/// A method's name as a folder: `penalty-epsilon-1e-9-integrator-trapezoidal`.
pub(super) fn folder_name(method: &Method) -> String {
    method.to_string().replace([':', ',', '='], "-")
}

fn files(
    folder: &Path,
    case: &Case,
    comparison: &Comparison,
    verdicts: &[Option<Verdict>],
    stretch: &Stretch,
) -> Result<()> {
    let span = stretch.span(case, case.scene.duration)?;
    for (look, (row, verdict)) in comparison.rows.iter().zip(verdicts).enumerate() {
        if let Ok(run) = &row.outcome {
            let reasons =
                Reasons { scheme: "part of a comparison".into(), qp: choice::qp_reason(&row.method, &case.scene) };
            let checks = Checks { refinement: verdict.as_ref(), ..Checks::default() };
            write(
                &folder.join(folder_name(&row.method)),
                case,
                run,
                &row.method,
                &reasons,
                checks,
                Picture { span, look },
            )?;
        }
    }
    let labels: Vec<String> = comparison.rows.iter().map(|row| row.method.to_string()).collect();
    let runs: Vec<Labelled<'_>> = comparison
        .rows
        .iter()
        .zip(&labels)
        .enumerate()
        .filter_map(|(look, (row, label))| {
            let run = row.outcome.as_ref().ok()?;
            Some(Labelled { label, run, reference: row.method.scheme == Scheme::Event, look })
        })
        .collect();
    let refined =
        comparison.refined.as_ref().map(|(method, run)| (format!("{method}, h = {:.1e} s", run.grid.step), run));
    let runs: Vec<Labelled<'_>> = match &refined {
        Some((label, run)) => runs.into_iter().chain([Labelled { label, run, reference: true, look: 0 }]).collect(),
        None => runs,
    };
    let title = case.title.as_deref().unwrap_or(&case.name);
    let sheet = Sheet { title, scene: &case.scene, runs: &runs, span: stretch.span(case, comparison.horizon)? };
    for (name, svg) in sheet.figures()? {
        write_whole(&folder.join(format!("{name}.svg")), svg.as_bytes())?;
    }
    let (header, rows) = cells(case, comparison, |x| format!("{x:.16e}"));
    csv::table(&folder.join("compare.csv"), &header, rows.into_iter())
}

/// The table as text cells, numbers as `show` writes them.
fn cells(case: &Case, comparison: &Comparison, show: impl Fn(f64) -> String) -> (Vec<String>, Vec<Vec<String>>) {
    let mut header: Vec<String> = ["method", "step_s", "restitution", "restitution_least", "restitution_largest"]
        .into_iter()
        .chain([
            "error_over_gap",
            "horizon_s",
            "agrees_until_s",
            "largest_displacement_m",
            "penetration_m",
            "peak_force_N",
        ])
        .map(str::to_owned)
        .collect();
    let walls = &case.scene.walls;
    header.extend(walls.iter().map(|w| format!("impulse_{}_Ns", w.name)));
    header.extend(walls.iter().map(|w| format!("contacts_{}", w.name)));
    header.extend(walls.iter().map(|w| format!("peak_force_{}_N", w.name)));
    header.extend(["energy_residual", "complementarity_residual", "step_ns", "failure"].map(str::to_owned));
    let number = |x: Option<f64>| x.map_or_else(String::new, &show);
    let line = |row: &Row| {
        let mut line = vec![row.method.to_string()];
        let run = match &row.outcome {
            Ok(run) => run,
            Err(error) => {
                line.resize(header.len() - 1, String::new());
                line.push(error.to_string());
                return line;
            }
        };
        let exact = row.method.scheme == Scheme::Event;
        let e = row.restitution;
        line.push(number((!exact).then_some(run.grid.step)));
        line.extend([e.map(|e| e.median), e.map(|e| e.least), e.map(|e| e.largest)].map(number));
        line.push(number(row.error));
        line.push(number(row.error.map(|_| comparison.horizon)));
        line.push(number(row.agrees_until));
        line.push(show(largest(run.trajectory.displacements())));
        line.push(show(penetration(case, run)));
        line.push(number(peak(run, None)));
        line.extend(walls.iter().map(|w| number(run.trajectory.impulse(&w.name).ok())));
        let contacts = |wall| run.trajectory.contacts().iter().filter(|c| c.wall == wall).count();
        line.extend((0..walls.len()).map(|wall| contacts(wall).to_string()));
        line.extend((0..walls.len()).map(|wall| number(peak(run, Some(wall)))));
        line.extend([run.residuals.energy.residual, run.residuals.complementarity].map(&show));
        line.push(number(row.step_ns));
        line.push(String::new());
        line
    };
    let rows = comparison.rows.iter().map(line).collect();
    (header, rows)
}

fn largest(columns: &[Vec<f64>]) -> f64 {
    columns.iter().flatten().fold(0.0, |a, x| a.max(x.abs()))
}

/// Deepest position behind a wall that the scene calls rigid, m.
fn penetration(case: &Case, run: &crate::run::Run) -> f64 {
    let walls = case.scene.walls.iter().zip(&run.residuals.depth_m);
    walls.filter(|(wall, _)| wall.law.is_rigid()).fold(0.0, |a, (_, depth)| a.max(*depth))
}

/// Largest force of the contacts whose force is finite, N: of one wall, or of all.
fn peak(run: &crate::run::Run, wall: Option<usize>) -> Option<f64> {
    let here = run.trajectory.contacts().iter().filter(|c| wall.is_none_or(|wall| c.wall == wall));
    here.filter_map(|c| c.peak_force).reduce(f64::max)
}

fn table(case: &Case, comparison: &Comparison, ui: &Ui) {
    if ui.json() {
        let (header, rows) = cells(case, comparison, |x| format!("{x:.16e}"));
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        ui.table(&header, &rows);
        return;
    }
    let rows: Vec<_> = comparison.rows.iter().map(|row| terminal_row(case, comparison, row)).collect();
    let walls: Vec<&str> = case.scene.walls.iter().map(|w| w.name.as_str()).collect();
    let of_walls = match walls.len() {
        count if count > MOST_WALLS => format!("Σ|impulse| of {count} walls (N s)"),
        _ => format!("impulse {} (N s)", walls.join(" ")),
    };
    let mut header = TERMINAL_HEADER;
    header[IMPULSE_COLUMN] = of_walls.trim();
    ui.table(&header, &rows);
}

/// The columns a reader compares, in few characters; the CSV and `--json` have them all. Columns of walls list them in the scene's order,
/// or sum over them.
const TERMINAL_HEADER: [&str; 13] = [
    "method",
    "step (s)",
    "e",
    "error/gap",
    "until (s)",
    "max |u| (mm)",
    "penetr. (mm)",
    "peak F (N)",
    "impulse (N s)",
    "contacts",
    "energy res.",
    "compl. res.",
    "ns/step",
];

/// Walls that the terminal lists one by one, at most: beyond, it shows sums over all.
const MOST_WALLS: usize = 4;

/// Where the impulses stand among them.
const IMPULSE_COLUMN: usize = 8;

fn terminal_row(case: &Case, comparison: &Comparison, row: &Row) -> Vec<String> {
    let short = |x: f64| if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") };
    let run = match &row.outcome {
        Ok(run) => run,
        Err(_) => return vec![row.method.to_string(), "failed".to_owned()],
    };
    let exact = row.method.scheme == Scheme::Event;
    let dash = || "-".to_owned();
    let e = row.restitution.map_or_else(dash, |e| {
        if e.largest - e.least < 5e-4 {
            format!("{:.3}", e.median)
        } else {
            format!("{:.2} ({:.2}..{:.2})", e.median, e.least, e.largest)
        }
    });
    let walls = &case.scene.walls;
    let many = walls.len() > MOST_WALLS;
    let per_wall = |text: &dyn Fn(usize, &str) -> String| {
        let all: Vec<String> = walls.iter().enumerate().map(|(i, w)| text(i, &w.name)).collect();
        if all.is_empty() { dash() } else { all.join(" ") }
    };
    let impacts_only = !run.trajectory.contacts().is_empty();
    vec![
        row.method.to_string(),
        if exact { "exact".into() } else { format!("{:.3e}", run.grid.step) },
        e,
        row.error.map_or_else(|| if exact { "reference".into() } else { dash() }, short),
        row.agrees_until.map_or_else(dash, |t| {
            if t >= comparison.horizon.max(case.scene.duration) { "end".into() } else { format!("{t:.3}") }
        }),
        format!("{:.4}", 1e3 * largest(run.trajectory.displacements())),
        short(1e3 * penetration(case, run)),
        peak(run, None).map_or_else(|| if impacts_only { "impacts".into() } else { dash() }, |f| format!("{f:.2}")),
        if many {
            let impulse = |w: &crate::scene::Wall| run.trajectory.impulse(&w.name).unwrap_or(f64::NAN).abs();
            format!("{:.3}", walls.iter().map(impulse).sum::<f64>())
        } else {
            per_wall(&|_, name| format!("{:+.3}", run.trajectory.impulse(name).unwrap_or(f64::NAN)))
        },
        if many {
            run.trajectory.contacts().len().to_string()
        } else {
            per_wall(&|i, _| run.trajectory.contacts().iter().filter(|c| c.wall == i).count().to_string())
        },
        short(run.residuals.energy.residual),
        short(run.residuals.complementarity),
        row.step_ns.map_or_else(dash, |ns| format!("{ns:.0}")),
    ]
}
