//! `signorini sweep`: one case, many values.

mod args;
mod effects;
mod shares;

pub use args::Args;

use super::command_line::command_line;
use super::estimate::GOES_ON;
use super::pipeline::Answer;
use super::run_time::time_in_words;
use super::ui::Ui;
use crate::error::Result;
use crate::output::request::program;
use crate::output::results::Results;
use crate::study::realisations::RealisationCount;
use crate::sweep::{
    Finished, Pictures, Plan, Progress, Sensitivity, Shard, Status, SweepOptions, Tables, asked, first_rows, in_words,
    means, write_summary,
};
use effects::show_effects;
use serde_json::{Map, Value, json};
use shares::show_shares;
use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time for which rows are computed for the estimate of `--plan`.
const TRIAL: Duration = Duration::from_secs(3);

/// Interval of the lines that report progress.
const REPORT_INTERVAL: Duration = Duration::from_secs(30);

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    // A format that cannot be written is refused before anything is computed.
    args.place.formats.usable()?;
    let sweep = args.sweep(ui)?;
    let title = sweep.title().to_owned();
    let plan = sweep.plan()?;
    plan.notes().iter().for_each(|note| ui.message(&format!("note: {note}")));
    if args.plan {
        return Ok(planned(&plan));
    }
    let (finished, mut results) = run(args, &plan, &title, ui)?;
    let whole = args.shard.is_none_or(|shard| shard == Shard::WHOLE);
    let pictures = if whole { plan.draw(&mut results)? } else { Pictures::default() };
    let found = if whole { write_sensitivity(&mut results, &plan.request())? } else { None };
    let document = write_summary(&mut results, document(&plan, &finished, &pictures.drawn))?;
    let mut answer = Answer::of(results, whole && !args.place.no_report, document);
    show_tables(&mut answer, &finished.folder, &plan.request(), found.as_ref())?;
    let found = match finished.found {
        0 => String::new(),
        found if found == finished.runs => ", all of them there already".to_owned(),
        found => format!(", {found} of them there already"),
    };
    let seeds = plan.realisations().map_or_else(String::new, |count| format!(" × {}", in_words(count)));
    answer.messages([format!("{} rows{seeds} in {}{found}", finished.rows, time_in_words(finished.seconds))]);
    answer.messages(status_messages(&finished.folder, &finished.tables, finished.rows)?);
    answer.messages(finished.cautioned.sentences().map(|text| format!("note: {text}")));
    answer.messages(picture_messages(&pictures));
    if !whole {
        answer.close_with("; `signorini merge` joins the shards");
    }
    answer.fall_short(finished.failure(args.strict));
    Ok(answer)
}

/// Runs the sweep with a progress bar; a line from time to time reports progress too.
fn run(args: &Args, plan: &Plan, title: &str, ui: &Ui) -> Result<(Finished, Results)> {
    let folder = args.place.folder(title, "sweep");
    let (threads, shard) = (args.threads.map(usize::from), args.shard.unwrap_or(Shard::WHOLE));
    let options = SweepOptions { threads, shard, force: args.place.force };
    let formats = args.place.formats.usable()?;
    ui.with_bar("sweep", |bar| {
        let (said, said_once) = (Cell::new(Instant::now()), Cell::new(false));
        let progress = |Progress { done, runs, rate }| {
            bar.set_share(done as f64 / runs.max(1) as f64);
            if said.get().elapsed() > REPORT_INTERVAL {
                said.set(Instant::now());
                let left = if rate > 0.0 { (runs - done) as f64 / rate } else { f64::INFINITY };
                let what = if plan.realisations().is_some() { "realisations" } else { "rows" };
                let left = time_in_words(left);
                let goes_on =
                    if said_once.replace(true) { String::new() } else { format!("; after an interruption {GOES_ON}") };
                bar.message(&format!("{done} of {runs} {what}, {rate:.3} {what}/s, {left} left{goes_on}"));
            }
        };
        let damaged = |what: &str| bar.message(&format!("the rows are computed again: {what}"));
        plan.run_in(&folder, options, formats, &progress, &damaged)
    })
}

/// Adds the table of what the keys change in the whole sweep to `results`, and returns it.
pub(super) fn write_sensitivity(results: &mut Results, request: &Map<String, Value>) -> Result<Option<Sensitivity>> {
    let found = Sensitivity::read(results.folder(), request)?;
    found.as_ref().map(|found| found.write(results)).transpose()?;
    Ok(found)
}

/// Shows what the keys change in the sweep in `folder`, and the means over realisations of its
/// rows, where they have several; with `--json` its first rows.
pub(super) fn show_tables(
    answer: &mut Answer,
    folder: &Path,
    request: &Map<String, Value>,
    found: Option<&Sensitivity>,
) -> Result<()> {
    match found {
        Some(Sensitivity::Effects(effects)) => show_effects(answer, effects, asked(request)),
        Some(Sensitivity::Shares(shares)) => show_shares(answer, shares),
        None => {}
    }
    answer.add("values", first_rows(folder)?.into());
    if let Some((key, lines)) = found.map(Sensitivity::objects) {
        answer.add(key, lines.into());
    }
    if let Some((table, remark)) = means(folder, request)? {
        answer.table(table, "sweep.csv");
        answer.messages([remark]);
    }
    Ok(())
}

/// The size of the sweep, and estimates of its time and bytes.
fn planned(plan: &Plan) -> Answer {
    let estimate = plan.estimate(TRIAL);
    let chains = plan.count() / plan.chain_rows();
    let seeds = plan.realisations().map_or_else(String::new, |count| format!(" × {}", in_words(count)));
    let mut answer = Answer::new(json!({
        "rows": plan.count(),
        "runs": plan.runs(),
        "chains": chains,
        "columns": plan.header(),
        "method": plan.method().to_string(),
        "rows_tried": estimate.tried,
        "rows_failed": estimate.failed,
        "seconds": estimate.seconds,
        "threads": estimate.threads,
        "bytes": estimate.bytes,
    }));
    answer.prose(format!("{} rows{seeds} by {}, {} columns", plan.count(), plan.method(), plan.header().len()));
    if plan.chain_rows() > 1 {
        answer.prose(format!("chains of {} rows, {chains} in all, each on one thread", plan.chain_rows()));
    }
    let failed = if estimate.failed > 0 { format!(", {} of which failed", estimate.failed) } else { String::new() };
    let pilots = matches!(plan.realisations(), Some(RealisationCount::Within { .. }));
    answer.prose(format!(
        "{}about {} on {} threads, from {} {} tried{failed}",
        if pilots { "for the first six, which say how many more, " } else { "" },
        time_in_words(estimate.seconds),
        estimate.threads,
        estimate.tried,
        if seeds.is_empty() { "rows" } else { "realisations" }
    ));
    answer.prose(format!("about {:.1e} bytes of tables, and as much again while it runs", estimate.bytes));
    answer
}

/// The sweep as a document: `summary.json`.
fn document(plan: &Plan, finished: &Finished, drawn: &[PathBuf]) -> Value {
    json!({
        "program": program(),
        "case": plan.case().name,
        "title": plan.case().title,
        "rows": finished.rows,
        "runs": finished.runs,
        "runs_of_earlier_processes": finished.found,
        "command_line": command_line(),
        "status": status_document(&finished.tables),
        "first_error": finished.tables.first_error,
        "notes": ([plan.notes(), finished.tables.instabilities(), finished.cautioned.sentences().collect()].concat()),
        "threads": finished.threads,
        "wall_clock_s": finished.seconds,
        "request": plan.request(),
        "pictures": drawn,
        "results": finished.folder,
    })
}

/// The numbers of rows by status, as JSON.
pub(super) fn status_document(tables: &Tables) -> Value {
    tables.counts.iter().map(|(status, count)| (status.clone(), json!(count))).collect()
}

/// Most names of curves that are printed.
const MOST_NAMED: usize = 12;

/// The paths of pictures, and the names of what they leave out.
pub(super) fn picture_messages(pictures: &Pictures) -> Vec<String> {
    let mut messages: Vec<String> = pictures.drawn.iter().map(|path| format!("wrote {}", path.display())).collect();
    let left_out = &pictures.left_out;
    if !left_out.is_empty() {
        let named = left_out.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join("; ");
        let more = match left_out.len().saturating_sub(MOST_NAMED) {
            0 => String::new(),
            more => format!("; and {more} more"),
        };
        messages.push(format!(
            "the picture has no room for {named}{more}; sweep.csv has them all, and [figure] y, z and wall choose \
             others"
        ));
    }
    messages
}

/// How many of `rows` rows of the tables in `folder` have which status, apart from `ok`, and how
/// many starts lead to no attractor that was found.
pub(super) fn status_messages(folder: &Path, tables: &Tables, rows: u64) -> Result<Vec<String>> {
    let mut messages = Vec::new();
    for (status, count) in tables.counts.iter().filter(|(status, _)| status != Status::Ok.name()) {
        let hint = if status == Status::Unjudged.name() { ": nothing checked their steps; see --judged" } else { "" };
        messages.push(format!("{status}: {count} of {rows} rows{hint}"));
    }
    messages.extend(tables.instabilities().iter().map(|text| format!("note: {text}")));
    if let Some(error) = &tables.first_error {
        messages.push(format!("the first that failed: {error}"));
    }
    if let Some(undecided @ 1..) = tables.undecided(folder)? {
        messages.push(format!(
            "undecided: {undecided} of {rows} starts, whose attractor was not found: an empty cell; try a longer \
             --settle"
        ));
    }
    Ok(messages)
}
