//! `signorini new`: writes a case file to start from.

use super::ui::Ui;
use super::values;
use crate::case::Embedded;
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use serde_json::json;
use std::path::PathBuf;

/// Write a built-in case as a file to start from; without a name, list them
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini new rigid-walls-sine --out my-case.toml")]
pub struct Args {
    /// Name of the case
    #[arg(value_parser = values::built_in(), hide_possible_values = true)]
    name: Option<String>,
    /// File to write [default: NAME.toml here]; the tables a case reads go beside it
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let Some(name) = &args.name else {
        let title = |case: &Embedded| case.case().ok().and_then(|c| c.title).unwrap_or_default();
        let cases = Embedded::all().iter().map(|case| (case.name, title(case)));
        if ui.json() {
            let list: Vec<_> = cases.map(|(case, title)| json!({ "case": case, "title": title })).collect();
            return ui.document(&json!({ "cases": list }));
        }
        let lines: Vec<_> = cases.map(|(case, title)| format!("{case:20} {title}")).collect();
        return ui.answer(&lines.join("\n"));
    };
    let embedded = Embedded::named(name)?;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let tables = embedded.tables.iter().map(|(file, text)| (path.with_file_name(file), *text));
    let files: Vec<_> = std::iter::once((path.clone(), embedded.text)).chain(tables).collect();
    if let Some((taken, _)) = files.iter().find(|(path, _)| path.exists()).filter(|_| !args.force) {
        let reason = "already exists; --out FILE writes elsewhere, --force replaces it".to_owned();
        return Err(Error::io(taken.display(), reason, true));
    }
    for (path, text) in &files {
        write_whole(path, text.as_bytes())?;
        ui.message(&format!("wrote {}", path.display()));
    }
    if ui.json() {
        let paths: Vec<_> = files.iter().map(|(path, _)| path).collect();
        ui.document(&json!({ "files_written": paths }))?;
    }
    Ok(())
}
