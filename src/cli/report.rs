//! `signorini report`: the report on results that exist.

use super::pipeline::Answer;
use crate::error::Result;
use crate::report::{self, Written};
use serde_json::json;
use std::path::PathBuf;

/// Write the report on a folder of results: one HTML file that needs no network
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  signorini report out/rigid-walls-sine/run
  signorini report out/rigid-walls-sine/compare --out comparison.html
  signorini report soft --over hard --out both.html
      two runs or comparisons, or two results of chart, orbit, wear or a sweep over one key, in
      the same figures

run, compare, chart, stability, sweep, orbit, continue and wear write report.html beside their
results already, unless --no-report is given.")]
pub struct Args {
    /// Folder of results of run, compare, chart, stability, sweep, orbit, continue or wear
    #[arg(value_hint = clap::ValueHint::DirPath)]
    folder: PathBuf,
    /// Other results to draw in the same figures: runs and comparisons over each other, a sweep
    /// over a sweep, and so for chart, orbit and wear
    #[arg(long, value_name = "FOLDER", value_hint = clap::ValueHint::DirPath)]
    over: Option<PathBuf>,
    /// The file to write [default: report.html in that folder]
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    out: Option<PathBuf>,
}

pub fn answer(args: &Args) -> Result<Answer> {
    let Written { path, verified } = report::write(&args.folder, args.over.as_deref(), args.out.as_deref())?;
    let document = json!({ "command": "report", "results": args.folder, "files_written": [path] });
    let mut answer = Answer::new(document);
    if !verified {
        answer.messages([report::UNVERIFIED.to_owned()]);
    }
    answer.last_line(format!("wrote the page; open {}", path.display()));
    Ok(answer)
}
