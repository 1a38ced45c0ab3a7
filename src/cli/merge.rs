//! `signorini merge`: joins the shards of a sweep.

use super::command_line::command_line;
use super::formats::FileFormats;
use super::pipeline::Answer;
use super::sweep::{picture_messages, show_tables, status_document, status_messages, write_sensitivity};
use crate::error::{Result, counted};
use crate::output::request::program;
use crate::sweep::{Merged, merge_in, write_summary};
use serde_json::json;
use std::path::PathBuf;

/// Join the shards of a sweep: gives the same tables as the sweep that was not divided
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini merge out/bifurcation/sweep --out out/bifurcation/whole")]
pub struct Args {
    /// Folders of shards, or folders that hold them
    #[arg(required = true, value_hint = clap::ValueHint::DirPath)]
    folders: Vec<PathBuf>,
    /// Folder for the joined tables
    #[arg(long, value_name = "DIR", value_hint = clap::ValueHint::DirPath)]
    out: PathBuf,
    /// Replace the results of another request
    #[arg(long)]
    force: bool,
    /// Write no report.html
    #[arg(long)]
    no_report: bool,
    #[command(flatten)]
    formats: FileFormats,
}

pub fn answer(args: &Args) -> Result<Answer> {
    let formats = args.formats.usable()?;
    let (merged, mut results) = merge_in(&args.folders, &args.out, args.force, formats)?;
    let Merged { rows, shards, tables, request, title, picture, differing_arithmetic, unverified } = merged;
    let pictures = picture.draw(&mut results, &request, &title)?;
    let document = json!({
        "program": program(),
        "case": request.get("case"),
        "rows": rows,
        "shards": shards,
        "command_line": command_line(),
        "status": status_document(&tables),
        "first_error": tables.first_error,
        "notes": tables.instabilities(),
        "differing_arithmetic": differing_arithmetic,
        "request": request,
        "pictures": pictures.drawn,
        "results": args.out,
    });
    let request = document["request"].as_object().cloned().unwrap_or_default();
    let found = write_sensitivity(&mut results, &request)?;
    let document = write_summary(&mut results, document)?;
    let mut answer = Answer::of(results, !args.no_report, document);
    show_tables(&mut answer, &args.out, &request, found.as_ref())?;
    answer.messages(unverified.iter().map(|folder| {
        format!("{}: of a version that recorded no digests: its tables are not verified", folder.display())
    }));
    if differing_arithmetic {
        let text = "the shards come from machines whose sines and exponentials differ in their last digits: rows that \
                    are sensitive to them may differ from those of one machine";
        answer.messages([text.to_owned()]);
    }
    answer.messages([format!("{} of {}", counted(rows as usize, "row"), counted(shards, "shard"))]);
    answer.messages(status_messages(&args.out, &tables, rows)?);
    answer.messages(picture_messages(&pictures));
    Ok(answer)
}
