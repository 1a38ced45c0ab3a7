//! `signorini new`: a case file to start from.

use super::ui::Ui;
use crate::case::Embedded;
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use std::path::PathBuf;

/// Write a built-in case as a file to start from; without a name, list them
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini new rigid-walls-sine --out my-case.toml")]
pub struct Args {
    /// Name of the case
    name: Option<String>,
    /// File to write [default: NAME.toml here]; the tables a case reads go beside it
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let Some(name) = &args.name else {
        let title = |case: &&Embedded| case.case().ok().and_then(|c| c.title).unwrap_or_default();
        let rows: Vec<_> = Embedded::all().iter().map(|e| vec![e.name.to_owned(), title(&e)]).collect();
        ui.table(&["case", "title"], &rows);
        return Ok(());
    };
    let embedded = Embedded::named(name)?;
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let tables = embedded.tables.iter().map(|(file, text)| (path.with_file_name(file), *text));
    let files: Vec<_> = std::iter::once((path.clone(), embedded.text)).chain(tables).collect();
    if let Some((taken, _)) = files.iter().find(|(path, _)| path.exists()) {
        let reason = "already exists; --out FILE writes elsewhere".to_owned();
        return Err(Error::Io { path: taken.display().to_string(), reason, request: true });
    }
    for (path, text) in &files {
        write_whole(path, text.as_bytes())?;
        ui.message(&format!("wrote {}", path.display()));
    }
    Ok(())
}
