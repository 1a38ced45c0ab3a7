//! `signorini report`: the report on results that exist.

use super::ui::Ui;
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use crate::output::manifest::{self, MANIFEST};
use crate::output::record::TABLES;
use crate::report;
use serde_json::json;
use std::path::PathBuf;

/// Write the report on a folder of results: one HTML file that needs no network
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  signorini report out/rigid-walls-sine/run
  signorini report out/rigid-walls-sine/compare --out comparison.html

run, compare, chart, stability, sweep, orbit and continue write report.html beside their results
already, unless --no-report is given.")]
pub struct Args {
    /// Folder of results of run, compare, chart, stability, sweep, orbit or continue
    #[arg(value_hint = clap::ValueHint::DirPath)]
    folder: PathBuf,
    /// The file to write [default: report.html in that folder]
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    out: Option<PathBuf>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let Some(manifest) = manifest::read(&args.folder) else {
        let reason =
            format!("holds no {MANIFEST} that can be read; expected a folder of results, such as out/CASE/run");
        return Err(Error::io(args.folder.display(), reason, true));
    };
    let page = report::page(&args.folder, &manifest)?;
    let path = args.out.clone().unwrap_or_else(|| args.folder.join(report::FILE));
    if manifest.get(TABLES).is_none() {
        ui.message("the version that made these results recorded no digests: their tables are not verified");
    }
    match &args.out {
        Some(path) => write_whole(path, page.as_bytes())?,
        // Listed, so that a later run without a report takes this one away.
        None => manifest::add(&args.folder, manifest, report::FILE, page.as_bytes())?,
    }
    ui.close_with(format!("wrote the page; open {}", path.display()));
    if ui.json() {
        ui.document(&json!({ "command": "report", "results": args.folder, "files_written": [path] }))?;
    }
    Ok(())
}

/// The command line of this process as a POSIX shell takes it.
pub(super) fn command_line() -> String {
    let words = std::env::args_os().skip(1).map(|word| quoted(&word.to_string_lossy()));
    std::iter::once("signorini".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}

/// A word as a POSIX shell takes it.
pub(super) fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=+.,/:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}
