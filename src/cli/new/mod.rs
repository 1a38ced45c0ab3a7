//! `signorini new`: writes a case file to start from.

mod tube;

use super::pipeline::Answer;
use super::values;
use crate::case::Embedded;
use crate::error::{Error, Result};
use crate::output::atomic::write_whole;
use serde_json::json;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  signorini new rigid-walls-sine --out my-case.toml
  signorini new tube --length 4.5 --supports 3 --gap 1.5e-4   a tube in round supports, from its data";

/// Write a built-in case as a file to start from, or one of a tube; without a name, list them
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Name of the case, or `tube`
    #[arg(value_parser = values::built_in(), hide_possible_values = true)]
    name: Option<String>,
    /// File to write [default: NAME.toml here]; the tables a case reads go beside it
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    out: Option<PathBuf>,
    /// Replace existing files
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    tube: tube::Tube,
}

/// The name of a tube made from its data.
const TUBE: &str = "tube";

pub fn answer(args: &Args) -> Result<Answer> {
    let Some(name) = &args.name else { return Ok(list()) };
    let path = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}.toml")));
    let text = if name == TUBE { Some(args.tube.text(&format!("{TUBE}.toml"))?) } else { None };
    let files = match &text {
        Some(text) => vec![(path, text.as_str())],
        None => {
            if let Some(option) = args.tube.given() {
                return Err(Error::invalid(option, "given", "no such option but for `signorini new tube`"));
            }
            let embedded = Embedded::named(name)?;
            let tables = embedded.tables.iter().map(|(file, text)| (path.with_file_name(file), *text));
            std::iter::once((path.clone(), embedded.text)).chain(tables).collect::<Vec<_>>()
        }
    };
    if let Some((taken, _)) = files.iter().find(|(path, _)| path.exists()).filter(|_| !args.force) {
        let reason = "already exists; --out FILE writes elsewhere, --force replaces it".to_owned();
        return Err(Error::io(taken.display(), reason, true));
    }
    files.iter().try_for_each(|(path, text)| write_whole(path, text.as_bytes()))?;
    let paths: Vec<_> = files.iter().map(|(path, _)| path).collect();
    let mut answer = Answer::new(json!({ "files_written": paths }));
    answer.messages(paths.iter().map(|path| format!("wrote {}", path.display())));
    Ok(answer)
}

/// The built-in cases and their titles.
fn list() -> Answer {
    let title = |case: &Embedded| case.case().ok().and_then(|c| c.title).unwrap_or_default();
    let cases: Vec<_> = Embedded::all().iter().map(|case| (case.name, title(case))).collect();
    let documents: Vec<_> = cases.iter().map(|(case, title)| json!({ "case": case, "title": title })).collect();
    let mut answer = Answer::new(json!({ "cases": documents }));
    let lines: Vec<_> = cases.iter().map(|(case, title)| format!("{case:20} {title}")).collect();
    answer.verbatim(lines.join("\n"));
    answer
}
