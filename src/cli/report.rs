//! `signorini report`: the report on results that exist.

use super::pipeline::Answer;
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use crate::output::manifest::{self, MANIFEST};
use crate::output::record::TABLES;
use crate::report;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Write the report on a folder of results: one HTML file that needs no network
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  signorini report out/rigid-walls-sine/run
  signorini report out/rigid-walls-sine/compare --out comparison.html
  signorini report soft --over hard --out both.html
      two runs, or two sweeps over one key, in the same figures

run, compare, chart, stability, sweep, orbit, continue and wear write report.html beside their
results already, unless --no-report is given.")]
pub struct Args {
    /// Folder of results of run, compare, chart, stability, sweep, orbit, continue or wear
    #[arg(value_hint = clap::ValueHint::DirPath)]
    folder: PathBuf,
    /// Other results to draw in the same figures: of a run over a run, of a sweep over a sweep
    #[arg(long, value_name = "FOLDER", value_hint = clap::ValueHint::DirPath)]
    over: Option<PathBuf>,
    /// The file to write [default: report.html in that folder]
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    out: Option<PathBuf>,
}

pub fn answer(args: &Args) -> Result<Answer> {
    let manifest = manifest_of(&args.folder)?;
    let page = match &args.over {
        Some(over) => report::page_over(&args.folder, &manifest, (over, &manifest_of(over)?))?,
        None => report::page(&args.folder, &manifest)?,
    };
    let path = args.out.clone().unwrap_or_else(|| args.folder.join(report::FILE));
    let verified = manifest.get(TABLES).is_some();
    match &args.out {
        Some(path) => write_whole(path, page.as_bytes())?,
        // Listed, so that a later run without a report takes this one away.
        None => manifest::add(&args.folder, manifest, report::FILE, page.as_bytes())?,
    }
    let document = json!({ "command": "report", "results": args.folder, "files_written": [path] });
    let mut answer = Answer::new(document);
    if !verified {
        let text = "the version that made these results recorded no digests: their tables are not verified";
        answer.messages([text.to_owned()]);
    }
    answer.last_line(format!("wrote the page; open {}", path.display()));
    Ok(answer)
}

/// What was asked for the results in `folder`.
fn manifest_of(folder: &Path) -> Result<Value> {
    manifest::read(folder).ok_or_else(|| {
        let reason =
            format!("holds no {MANIFEST} that can be read; expected a folder of results, such as out/CASE/run");
        Error::io(folder.display(), reason, true)
    })
}
