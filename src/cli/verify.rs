//! `signorini verify`: the verification manual, run on this machine.

use super::formats::TableFormats;
use super::pipeline::Answer;
use super::ui::Ui;
use crate::error::Result;
use crate::output::results::Results;
use crate::output::verification::{TABLE, conclusion, shortfall, table, write};
use crate::report::verification::{FILE, page};
use crate::verification::verify;
use serde_json::json;
use std::path::PathBuf;

/// Compare some 60 values with what others published or with closed forms, on this machine
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini verify\n\nWrites verification.html, a page to file with a report, \
    and verification.csv. Exit code 1 if a value is not within its tolerance.")]
pub struct Args {
    /// Folder for the results
    #[arg(long, value_name = "DIR", default_value = "out/verify", value_hint = clap::ValueHint::DirPath)]
    out: PathBuf,
    /// Replace other results in that folder
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    tables: TableFormats,
}

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let request = json!({ "command": "verify" }).as_object().cloned().unwrap_or_default();
    let mut results = Results::open(&args.out, request, args.force, args.tables.usable()?)?;
    let (lines, failures) = ui.with_bar("verifying", |bar| verify(&|share| bar.set_share(share)));
    write(&results.place(TABLE)?, &lines)?;
    let manifest = results.manifest();
    results.write(FILE, page(&lines, manifest["made"].as_str().unwrap_or_default()))?;
    let conclusion = conclusion(&lines);
    let page_to_open = format!("; open {}", args.out.join(FILE).display());
    let mut answer =
        Answer::of(results, false, json!({ "command": "verify", "conclusion": conclusion, "values": lines }));
    answer.table(table(&lines), TABLE);
    answer.messages(failures.iter().map(|(case, error)| format!("- {case} could not be run: {error}")));
    answer.prose(conclusion);
    answer.close_with(page_to_open);
    answer.fall_short(shortfall(&lines));
    Ok(answer)
}
