//! `signorini sweep`: one case, many values.

use super::report::command_line;
use super::request::{Changes, Destination, case_file};
use super::run::last_line;
use super::ui::Ui;
use super::values;
use crate::case::{MOST_TABLE_BYTES, read_text};
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use crate::output::format::Format;
use crate::output::results::Results;
use crate::report;
use crate::sweep::{
    Axis, Design, Finished, Follow, Kernel, Manner, Measure, Plan, Progress, Random, Shard, Status, Stretch, Sweep,
    Tables, Values, write_summary,
};
use serde_json::{Value, json};
use std::cell::Cell;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The table of the rows.
const TABLE: &str = "sweep.csv";

const EXAMPLES: &str = "\
Examples:
  signorini sweep bifurcation.toml
  signorini sweep rigid-walls-sine --vary load.1.harmonic.frequency=1:10:901 \\
      --measure contacts,displacement_max --keep 60 --settle 400
  signorini sweep rigid-walls-sine --vary 'wall.*.restitution=0.5,0.8,1' \\
      --vary time.step=1e-5:1e-3:9:log --measure force_rms
  signorini sweep rigid-walls-sine --vary load.1.harmonic.frequency=4:5:201 --follow both \\
      --scheme event --samples periods --keep 60 --settle 200
  signorini sweep rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --vary initial.displacement=-5e-3:5e-3:200 --vary initial.velocity=-0.4:0.4:200 \\
      --measure attractor,period --scheme event --settle 400 --keep 60
  signorini sweep tube.toml --vary system.damping.ratio=0.005:0.02 --random sobol \\
      --points 256 --measure impact_power
  signorini sweep bifurcation.toml --plan          how many rows, how long, how many bytes
  signorini sweep bifurcation.toml --shard 3/128   one part of 128; `signorini merge` joins them

A sweep file is TOML with a key `case`; docs/sweep.md has its format, and all measures.
After an interruption at any instant, the same command continues, and ends with the same bytes.
Results: sweep.csv, one row per point, with the reason if it failed; samples.csv, the instants;
attractors.csv, of a basin; a picture; summary.json; report.html.";

/// Many runs of one case: curves, maps, bifurcation diagrams and random designs as one table
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Sweep file; or case file, summary.json of a run, or the name of a built-in case, with --vary
    #[arg(value_hint = clap::ValueHint::FilePath)]
    file: String,
    #[command(flatten)]
    changes: Changes,
    /// Vary a value by its key: FROM:TO:POINTS, FROM:TO:POINTS:log, a list A,B,C, or FROM:TO with
    /// --random; may be given several times
    #[arg(long, value_name = "KEY=VALUES")]
    vary: Vec<String>,
    /// Take the values of the first --vary in this direction, each row starting from the end of the
    /// last one: up, down, both
    #[arg(long, value_name = "WORD")]
    follow: Option<Follow>,
    /// Measures of every row, such as contacts, impulse, force_rms, impact_power, displacement_max,
    /// period, lyapunov, attractor
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    measure: Vec<Measure>,
    /// Keep instants of every row: periods (once a forcing period) or impacts
    #[arg(long, value_name = "WORD")]
    samples: Option<crate::sweep::Samples>,
    /// Maximum number of instants of a row that are kept: the last ones [default: 200]
    #[arg(long, value_name = "N")]
    most_samples: Option<usize>,
    /// Forcing periods before the window of the measures
    #[arg(long, value_name = "N", requires = "keep")]
    settle: Option<u32>,
    /// Forcing periods in the window, in place of the case's end and statistics_from
    #[arg(long, value_name = "N")]
    keep: Option<u32>,
    /// Scheme [default: chosen from the case; see `signorini explain`]
    #[arg(long, value_name = "NAME", value_parser = values::schemes(), hide_possible_values = true)]
    scheme: Option<String>,
    /// How rows are computed: scalar, or batch (many oscillators at once, exactly) [default:
    /// scalar]
    #[arg(long, value_name = "WORD")]
    kernel: Option<Kernel>,
    /// Rows that are judged step by step, evenly spread; the others are marked unjudged [default:
    /// all; of --kernel batch 16, which the scheme event computes once more]
    #[arg(long, value_name = "N")]
    judged: Option<u64>,
    /// Draw the values of all --vary at random: uniform, lhs (Latin hypercube), sobol
    #[arg(long, value_name = "KIND", requires = "points")]
    random: Option<Design>,
    /// Points of the random design
    #[arg(long, value_name = "N", requires = "random")]
    points: Option<u64>,
    /// Seed of the random values; sobol without a seed is the plain sequence
    #[arg(long, value_name = "N", requires = "random")]
    seed: Option<u64>,
    /// Threads [default: all cores]
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Compute part I of N, in DIR/shard-I-of-N
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Print the number of rows, and estimates of time and bytes; write nothing
    #[arg(long)]
    plan: bool,
    /// Exit with code 1 if any row failed, not only if all did
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    place: Destination,
}

/// Time for which rows are computed for the estimate of `--plan`.
const TRIAL: Duration = Duration::from_secs(3);

/// Interval of the lines that report progress if there is no bar.
const SAY: Duration = Duration::from_secs(30);

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let formats = args.place.formats.usable()?;
    let sweep = args.sweep(ui)?;
    let name = sweep.title().to_owned();
    let plan = sweep.plan()?;
    if args.plan {
        return tell_plan(&plan, ui);
    }
    let out = args.place.out.clone().unwrap_or_else(|| Path::new("out").join(&name).join("sweep"));
    let threads = args.threads.map(usize::from);
    let manner = Manner { threads, shard: args.shard.unwrap_or(Shard::WHOLE), force: args.place.force };
    let (finished, mut results) = watched(&plan, &out, manner, formats, ui)?;
    let whole = manner.shard == Shard::WHOLE;
    let (drawn, left_out) = if whole { plan.draw(&mut results)? } else { Default::default() };
    let document = write_summary(&mut results, document(&plan, &finished, &drawn))?;
    results.finish()?;
    let report = whole && !args.place.no_report && write_report(&mut results, ui)?;
    tell(&finished, (&drawn, &left_out), ui)?;
    let remark = if whole { "" } else { "; `signorini merge` joins the shards" };
    ui.close_with(last_line(&finished.folder, remark, report));
    if ui.json() {
        ui.document(&document)?;
    }
    finished.failure(args.strict).map_or(Ok(()), Err)
}

/// Runs the sweep with a progress bar; without one, a line from time to time reports progress.
fn watched(plan: &Plan, out: &Path, manner: Manner, formats: Vec<Format>, ui: &Ui) -> Result<(Finished, Results)> {
    let bar = ui.progress("sweep", plan.count());
    let said = Cell::new(Instant::now());
    let progress = |Progress { done, rows, rate }| {
        bar.share(done as f64 / rows.max(1) as f64);
        if said.get().elapsed() > SAY {
            said.set(Instant::now());
            let left = if rate > 0.0 { (rows - done) as f64 / rate } else { f64::INFINITY };
            ui.beside(&bar, &format!("{done} of {rows} rows, {rate:.3} rows/s, {} left", span(left)));
        }
    };
    let damaged = |what: &str| ui.beside(&bar, &format!("the rows are computed again: {what}"));
    let finished = plan.run_in(out, manner, formats, &progress, &damaged);
    bar.finish();
    finished
}

impl Args {
    /// The sweep that the arguments describe.
    fn sweep(&self, ui: &Ui) -> Result<Sweep> {
        let path = Path::new(&self.file);
        let is_sweep = read_text(path, MOST_TABLE_BYTES).is_ok_and(|text| Sweep::is_file(&text));
        let mut sweep = if is_sweep { Sweep::read(path)? } else { Sweep::new(case_file(&self.file, ui)?) };
        for (key, value) in self.changes.pairs()? {
            sweep = sweep.set(&key, value)?;
        }
        for (index, text) in self.vary.iter().enumerate() {
            let axis = axis(text)?;
            sweep = sweep.vary(if index == 0 { axis.followed(self.follow.unwrap_or_default()) } else { axis });
        }
        if let (Some(_), true) = (self.follow, self.vary.is_empty()) {
            return Err(Error::invalid("--follow", "given", "a --vary beside it, the first of which is followed"));
        }
        if let (Some(design), Some(points)) = (self.random, self.points) {
            sweep = sweep.drawn(Random { design, points, seed: self.seed });
        }
        if let Some(keep) = self.keep {
            sweep = sweep.over(Stretch::Periods { settle: self.settle.unwrap_or(0), keep });
        }
        if let Some(kernel) = self.kernel {
            sweep = sweep.kernel(kernel);
        }
        if let Some(judged) = self.judged {
            sweep = sweep.judged(judged);
        }
        if let Some(scheme) = &self.scheme {
            sweep = sweep.by(scheme);
        }
        sweep = sweep.measure(self.measure.iter().copied());
        if let Some(samples) = self.samples {
            sweep = sweep.sample(samples, self.most_samples.unwrap_or(crate::sweep::MOST_SAMPLES));
        }
        Ok(sweep)
    }
}

/// The axis of an argument of `--vary`.
fn axis(text: &str) -> Result<Axis> {
    let wrong = || {
        let expected = "KEY=FROM:TO:POINTS, KEY=FROM:TO:POINTS:log, KEY=A,B,C, or KEY=FROM:TO with --random";
        Error::invalid("--vary", format_args!("{text:?}"), expected)
    };
    let (key, values) = text.split_once('=').ok_or_else(wrong)?;
    let parts: Vec<&str> = values.split(':').map(str::trim).collect();
    let number = |text: &str| text.parse::<f64>().map_err(|_| wrong());
    let points = |text: &str| text.parse::<u64>().map_err(|_| wrong());
    let values = match parts.as_slice() {
        [from, to] if number(from).is_ok() => Values::Range { from: number(from)?, to: number(to)?, log: false },
        [from, to, "log"] => Values::Range { from: number(from)?, to: number(to)?, log: true },
        [from, to, count] if number(from).is_ok() => {
            Values::Linear { from: number(from)?, to: number(to)?, points: points(count)? }
        }
        [from, to, count, "log"] => Values::Log { from: number(from)?, to: number(to)?, points: points(count)? },
        // Words may have colons: penalty:epsilon=1e-9.
        _ => Values::List(values.split(',').map(str::parse).collect::<Result<_>>()?),
    };
    Axis::new(key.trim(), values)
}

fn tell_plan(plan: &Plan, ui: &Ui) -> Result<()> {
    let estimate = plan.estimate(TRIAL);
    let chains = plan.count() / plan.chain_rows();
    if ui.json() {
        return ui.document(&json!({
            "rows": plan.count(),
            "chains": chains,
            "columns": plan.header(),
            "method": plan.method().to_string(),
            "rows_tried": estimate.tried,
            "rows_failed": estimate.failed,
            "seconds": estimate.seconds,
            "threads": estimate.threads,
            "bytes": estimate.bytes,
        }));
    }
    let mut lines = vec![format!("{} rows by {}, {} columns", plan.count(), plan.method(), plan.header().len())];
    if plan.chain_rows() > 1 {
        lines.push(format!("{chains} chains of {} rows, each on one thread", plan.chain_rows()));
    }
    lines.push(format!(
        "about {} on {} threads, from {} rows tried{}",
        span(estimate.seconds),
        estimate.threads,
        estimate.tried,
        if estimate.failed > 0 { format!(", {} of which failed", estimate.failed) } else { String::new() }
    ));
    lines.push(format!("about {:.1e} bytes of tables, and as much again while it runs", estimate.bytes));
    ui.prose(&lines.join("\n"))
}

/// The sweep as a document: `summary.json`.
fn document(plan: &Plan, finished: &Finished, drawn: &[PathBuf]) -> Value {
    let counts: serde_json::Map<String, Value> =
        finished.tables.counts.iter().map(|(status, count)| (status.clone(), json!(count))).collect();
    json!({
        "program": format!("signorini {}", env!("CARGO_PKG_VERSION")),
        "case": plan.case().name,
        "title": plan.case().title,
        "rows": finished.rows,
        "rows_of_earlier_runs": finished.found,
        "command_line": command_line(),
        "status": counts,
        "first_error": finished.tables.first_error,
        "threads": finished.threads,
        "wall_clock_s": finished.seconds,
        "request": plan.request(),
        "pictures": drawn,
        "results": finished.folder,
    })
}

/// What to do where the tables in `folder` are too large for a page, for this reason.
fn without_page(folder: &Path, reason: &str) -> String {
    format!(
        "no {}: {reason}; the tables and the pictures are complete. For a page, ask for fewer points, measures or \
         --most-samples in another --out; in Python, pandas.read_csv({:?}) reads the table",
        report::FILE,
        folder.join(TABLE).display().to_string()
    )
}

/// Adds the report on the sweep to its `results`, unless its tables are too large for one; true if
/// it was written.
fn write_report(results: &mut Results, ui: &Ui) -> Result<bool> {
    let manifest = results.manifest();
    if let Some(reason) = report::too_large(results.folder(), &manifest)? {
        ui.message(&without_page(results.folder(), &reason));
        return Ok(false);
    }
    let page = report::page(results.folder(), &manifest)?;
    write_whole(&results.place(report::FILE)?, page.as_bytes())?;
    results.finish()?;
    Ok(true)
}

fn tell(finished: &Finished, drawn: (&[PathBuf], &[String]), ui: &Ui) -> Result<()> {
    let found = match finished.found {
        0 => String::new(),
        found if found == finished.rows => ", all of them there already".to_owned(),
        found => format!(", {found} of them there already"),
    };
    ui.message(&format!("{} rows in {}{found}", finished.rows, span(finished.seconds)));
    tell_status(&finished.folder, &finished.tables, finished.rows, ui)?;
    tell_pictures(drawn, ui);
    Ok(())
}

/// Most names of curves that are printed.
const MOST_NAMED: usize = 12;

/// Prints the paths of pictures, and the names of what they leave out.
pub(super) fn tell_pictures((drawn, left_out): (&[PathBuf], &[String]), ui: &Ui) {
    drawn.iter().for_each(|path| ui.message(&format!("wrote {}", path.display())));
    if !left_out.is_empty() {
        let named = left_out.iter().take(MOST_NAMED).cloned().collect::<Vec<_>>().join("; ");
        let more = match left_out.len().saturating_sub(MOST_NAMED) {
            0 => String::new(),
            more => format!("; and {more} more"),
        };
        ui.message(&format!(
            "the picture has no room for {named}{more}; sweep.csv has them all, and [figure] y, z and wall choose \
             others"
        ));
    }
}

/// Prints how many of `rows` rows of the tables in `folder` have which status, apart from `ok`, and
/// how many starts lead to no attractor that was found.
pub(super) fn tell_status(folder: &Path, tables: &Tables, rows: u64, ui: &Ui) -> Result<()> {
    for (status, count) in tables.counts.iter().filter(|(status, _)| status != Status::Ok.name()) {
        let hint = if status == Status::Unjudged.name() { ": nothing checked their steps; see --judged" } else { "" };
        ui.message(&format!("{status}: {count} of {rows} rows{hint}"));
    }
    if let Some(error) = &tables.first_error {
        ui.message(&format!("the first that failed: {error}"));
    }
    if let Some(undecided @ 1..) = tables.undecided(folder)? {
        ui.message(&format!(
            "undecided: {undecided} of {rows} starts, whose attractor was not found: an empty cell; try a longer \
             --settle"
        ));
    }
    Ok(())
}

/// A length of time in words.
fn span(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "an unknown time".to_owned(),
        s if s < 120.0 => format!("{s:.1} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s if s < 172_800.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.1} days", s / 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::without_page;
    use std::path::Path;

    #[test]
    fn a_sweep_too_large_for_a_page_says_what_to_do() {
        let said = without_page(Path::new("out/s"), "its tables have 4100000 cells; a report holds 4000000 at most");
        for words in ["4100000 cells", "fewer points, measures or --most-samples", "read_csv(\"out/s/sweep.csv\")"] {
            assert!(said.contains(words), "{words}: {said}");
        }
    }
}
