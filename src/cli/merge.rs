//! `signorini merge`: joins the shards of a sweep.

use super::drawing::Formats;
use super::report::quoted;
use super::run::last_line;
use super::sweep::{tell_pictures, tell_status};
use super::ui::Ui;
use crate::error::Result;
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
    #[command(flatten)]
    formats: Formats,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let formats = args.formats.usable()?;
    let (merged, mut results) = merge_in(&args.folders, &args.out, args.force, formats)?;
    let Merged { rows, shards, tables, request, title, picture, differing_arithmetic, unverified } = merged;
    let (drawn, left_out) = picture.draw(&mut results, &request, &title)?;
    let counts: serde_json::Map<String, serde_json::Value> =
        tables.counts.iter().map(|(status, count)| (status.clone(), json!(count))).collect();
    let document = json!({
        "program": format!("signorini {}", env!("CARGO_PKG_VERSION")),
        "case": request.get("case"),
        "rows": rows,
        "shards": shards,
        "status": counts,
        "first_error": tables.first_error,
        "differing_arithmetic": differing_arithmetic,
        "request": request,
        "pictures": drawn,
        "results": args.out,
    });
    let document = write_summary(&mut results, document)?;
    results.finish()?;
    for folder in unverified {
        let folder = folder.display();
        ui.message(&format!("{folder}: of a version that recorded no digests: its tables are not verified"));
    }
    if differing_arithmetic {
        ui.message(
            "the shards come from machines whose sines and exponentials differ in their last digits: rows that \
             are sensitive to them \
             may differ from those of one machine",
        );
    }
    ui.message(&format!("{rows} rows of {shards} shards"));
    tell_status(&args.out, &tables, rows, ui)?;
    tell_pictures((&drawn, &left_out), ui);
    let page = format!("; `signorini report {}` writes a page to open", quoted(&args.out.display().to_string()));
    ui.close_with(last_line(&args.out, &page, false));
    if ui.json() {
        ui.document(&document)?;
    }
    Ok(())
}
