//! The page of a sweep: curves, maps and bifurcation diagrams.

use super::folder::{Cells, Folder};
use super::html::FILE;
use crate::error::{Error, Result};
use crate::output::manifest::MANIFEST;
use crate::study::realisations::RealisationCount;
use crate::sweep::{NO_KEY, SENSITIVITY_TABLES, Tables, asked, caution, coefficients, in_words};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::path::Path;

/// The tables of the rows and of their instants.
pub(super) const TABLE: &str = "sweep.csv";
pub(super) const SAMPLES: &str = "samples.csv";

/// Most cells of the tables that a page holds: some tens of megabytes of HTML.
const MOST_CELLS: usize = 4_000_000;

/// The table of the attractors, for a sweep that has them, and the columns that the page shows.
const ATTRACTORS: &str = "attractors.csv";
const TOLD: [&str; 8] =
    ["attractor", "rows", "share", "signature", "period", "phases_cycles", "approach_speeds_m_per_s", "multipliers"];

/// Where the run of a row of a sweep is looked for, within the folder of the sweep: in a folder of
/// that row's number.
const ROWS: &str = "rows";

/// The rows whose own runs have a report, by their numbers.
fn kept(folder: &Path, table: &Cells) -> Vec<usize> {
    let all = std::fs::read_dir(folder.join(ROWS)).into_iter().flatten().flatten();
    let row = |entry: std::fs::DirEntry| entry.file_name().to_str()?.parse::<usize>().ok();
    let known: HashSet<&str> = (0..table.rows.len()).map(|row| table.text(row, "row")).collect();
    let has = |row: &usize| {
        known.contains(row.to_string().as_str()) && folder.join(ROWS).join(row.to_string()).join(FILE).is_file()
    };
    let mut rows: Vec<usize> = all.filter_map(row).filter(has).collect();
    rows.sort_unstable();
    rows
}

/// Why the tables are too large for a page; `None` where they are not.
pub(super) fn too_large(folder: &Folder<'_>) -> Result<Option<String>> {
    let mut count = 0;
    for name in [TABLE, SAMPLES] {
        if folder.has(name) {
            let (rows, columns) = folder.size(name)?;
            count += rows * columns;
        }
    }
    Ok((count > MOST_CELLS).then(|| format!("its tables have {count} cells; a report holds {MOST_CELLS} at most")))
}

/// What to do where the tables in `folder` are too large for a page, for this reason.
pub(super) fn without_page(folder: &Path, reason: &str) -> String {
    let fewer = if folder.join(SAMPLES).exists() { "points, measures or --most-samples" } else { "points or measures" };
    format!(
        "no {FILE}: {reason}; the tables and the pictures are complete. For a page, ask for fewer {fewer} in another \
         --out; in Python, pandas.read_csv({:?}) reads the table",
        folder.join(TABLE).display().to_string()
    )
}

/// The walls or supports of these names.
pub(super) fn names(list: &Value) -> Vec<Value> {
    list.as_array().into_iter().flatten().map(|name| json!({ "name": name })).collect()
}

/// The arguments of `run` for so many realisations.
fn seeds_asked(count: RealisationCount) -> String {
    match count {
        RealisationCount::Exactly(count) => format!("--seeds {count}"),
        RealisationCount::Within { share, most, .. } => format!("--until-interval {share} --most-seeds {most}"),
    }
}

/// What the page of a sweep shows.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    if let Some(reason) = too_large(folder)? {
        return Err(Error::io(folder.path.display(), reason, true));
    }
    let table = folder.cells(TABLE)?;
    let samples = if folder.has(SAMPLES) { Some(folder.cells(SAMPLES)?) } else { None };
    let attractors = if folder.has(ATTRACTORS) { Some(folder.cells(ATTRACTORS)?) } else { None };
    let request = &folder.manifest["request"];
    let seeds = request.as_object().and_then(asked);
    let axes: Vec<Value> = request["vary"].as_array().cloned().unwrap_or_default();
    let keys = axes.len();
    let summary = if folder.has("summary.json") { folder.json("summary.json")? } else { Value::Null };
    let mut page = json!({
        "title": summary["title"],
        "subtitle": match seeds {
            Some(count) => format!("{} rows × {}", table.rows.len(), in_words(count)),
            None => format!("{} rows", table.rows.len()),
        },
        "command": summary["command_line"],
        "sweep": {
            "table": table.for_page(None),
            "attractors": attractors.map(|attractors| attractors.for_page(Some(&TOLD))),
            "samples": samples.map(|samples| samples.for_page(None)),
            "axes": axes,
            "walls": names(&request["wall_names"]),
            "supports": names(&request["support_names"]),
            "scheme": request["methods"][0],
            "window": request["run"],
            "kept": kept(folder.path, &table),
            "seeds": seeds.map(in_words),
            "seeds_asked": seeds.map(seeds_asked),
            "no_key": NO_KEY,
            "unstable": Tables::read(&folder.path.join(TABLE))?.instabilities(),
            "unjudged": summary["status"]["unjudged"].as_u64().unwrap_or(0),
        },
        "notes": folder.manifest["remarks"],
        "case": folder.manifest["case_text"],
        "summary": { "status": summary["status"], "first_error": summary["first_error"], MANIFEST: request },
    });
    for (name, file) in SENSITIVITY_TABLES.into_iter().filter(|(_, file)| folder.has(file)) {
        let found = folder.cells(file)?;
        page["sweep"][name] = found.for_page(None);
        // Of shares: the rows that they are fitted to.
        let rows = found.column("rows").unwrap_or_default().into_iter().reduce(f64::min);
        let least = found.column("share").unwrap_or_default().into_iter().reduce(f64::min);
        page["sweep"]["caution"] = json!(rows.and_then(|rows| caution(rows as usize, coefficients(keys), least)));
    }
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_too_large_for_a_page_says_what_to_do() {
        let said = without_page(Path::new("out/s"), "its tables have 4100000 cells; a report holds 4000000 at most");
        for words in ["4100000 cells", "fewer points or measures in another", "read_csv(\"out/s/sweep.csv\")"] {
            assert!(said.contains(words), "{words}: {said}");
        }
        // Where the sweep has samples, fewer of them help as well.
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join(SAMPLES), "").unwrap();
        let said = without_page(dir.path(), "");
        assert!(said.contains("fewer points, measures or --most-samples in another"), "{said}");
    }

    #[test]
    fn tables_of_more_cells_than_a_page_holds_are_too_large() {
        let dir = tempfile::tempdir().unwrap();
        let manifest = json!({ "request": { "command": "sweep" } });
        let folder = Folder { path: dir.path(), manifest: &manifest };
        assert_eq!(too_large(&folder).unwrap(), None, "no tables");
        let table = |rows: usize| format!("row,a,b,c\n{}", "0,1,2,3\n".repeat(rows));
        std::fs::write(dir.path().join(TABLE), table(MOST_CELLS / 4 - 1)).unwrap();
        std::fs::write(dir.path().join(SAMPLES), table(1)).unwrap();
        assert_eq!(folder.size(TABLE).unwrap(), (MOST_CELLS / 4 - 1, 4));
        assert_eq!(too_large(&folder).unwrap(), None);
        std::fs::write(dir.path().join(SAMPLES), table(2)).unwrap();
        let reason = too_large(&folder).unwrap().unwrap();
        assert!(reason.contains("4000004 cells"), "{reason}");
        assert!(contents(&folder).unwrap_err().to_string().contains(&reason));
        // A row with too few cells is not a table.
        std::fs::write(dir.path().join(SAMPLES), "row,a\n1\n").unwrap();
        assert!(too_large(&folder).unwrap_err().to_string().contains(SAMPLES));
    }
}
