//! Margins of a tube in a cross flow, in all that shows them: explanation, notes, JSON and pages.
use crate::command::said;
use crate::table::summary;
use serde_json::Value;
use std::fs;

const CASE: [&str; 7] =
    ["tube-in-cross-flow", "--set", "flow.connors=3", "--set", "turbulence.1.velocity=1.2", "--set", "system.modes=4"];

const SHORT: [&str; 4] = ["--set", "time.end=0.2", "--set", "time.statistics_from=0.1"];

/// The margin of the slowest mode with supports active: 1.139646 m/s of the closed form by 1.2.
fn is_known(margins: &Value) {
    let margin = margins["active"][0]["margin"].as_f64().unwrap();
    assert!((margin / 0.949_705 - 1.0).abs() < 1e-4, "{margins}");
    assert_eq!((margins["connors"].as_f64(), margins["inactive"].as_array().unwrap().len()), (Some(3.0), 4));
}

#[test]
fn margins_are_in_the_explanation_the_notes_the_json_and_the_pages() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let (out, _) = said(path, &[&["explain"], &CASE[..]].concat(), 0);
    for words in
        ["fluid-elastic margins", "K = 3", "supports inactive: 4.0599 Hz", "margin 0.950", "work rates mean nothing"]
    {
        assert!(out.contains(words), "{words}: {out}");
    }
    let (out, _) = said(path, &[&["explain", "--json"], &CASE[..]].concat(), 0);
    is_known(&serde_json::from_str::<Value>(&out).unwrap()["scene"]["fluid_elastic"]);

    let (_, err) = said(path, &[&["run"], &CASE[..], &SHORT, &["--no-verdict", "--out", "r"]].concat(), 0);
    assert!(err.contains("note: unstable: work rates mean nothing"), "{err}");
    let summary = summary(&path.join("r"));
    is_known(&summary["scene"]["fluid_elastic"]);

    let years = ["--years", "1", "--histories", "1", "--json", "--out", "w"];
    let (out, err) = said(path, &[&["wear"], &CASE[..], &SHORT, &years].concat(), 0);
    assert!(err.contains("note: unstable: work rates mean nothing"), "{err}");
    is_known(&serde_json::from_str::<Value>(&out).unwrap()["fluid_elastic"]);

    for page in ["r", "w"] {
        let page = fs::read_to_string(path.join(page).join("report.html")).unwrap();
        let data = page.split("\"margins\":").nth(1).unwrap();
        let margins = serde_json::Deserializer::from_str(data).into_iter::<Value>().next().unwrap();
        is_known(&margins.unwrap());
        assert!(page.contains("work rates mean nothing"));
    }
}

#[test]
fn margins_of_several_bodies_name_them_in_all_that_shows_margins() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let case =
        ["two-tubes", "--set", "flow.connors=3", "--set", "body.right.beam.length=1.6", "--set", "system.modes=8"];
    let (out, _) = said(path, &[&["explain"], &case[..]].concat(), 0);
    for words in ["Hz of \"left\", ζ", "Hz of \"right\", ζ", "Hz of \"left\", \"right\", ζ", "work rates mean nothing"]
    {
        assert!(out.contains(words), "{words}: {out}");
    }
    let (_, err) = said(path, &[&["run"], &case[..], &SHORT, &["--no-verdict", "--out", "r"]].concat(), 0);
    assert!(err.contains("in the mode of") && err.contains("Hz of \"left\""), "{err}");
    let summary = summary(&path.join("r"));
    let active = summary["scene"]["fluid_elastic"]["active"].as_array().unwrap();
    assert!(active.iter().any(|one| one["bodies"] == serde_json::json!(["left", "right"])), "{active:?}");
    let page = fs::read_to_string(path.join("r/report.html")).unwrap();
    assert!(page.contains("\"bodies\":[\"left\",\"right\"]"));
}

/// Rows beyond the limit say so whatever the case itself is, alone, with realisations, and merged.
#[test]
fn rows_of_a_sweep_beyond_the_limit_are_told_and_say_so_themselves() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let sweep = |base: &str, more: &[&str]| {
        let base = format!("turbulence.1.velocity={base}");
        let own = ["sweep", "tube-in-cross-flow", "--set", "flow.connors=3", "--set", &base, "--set", "system.modes=4"];
        let vary = ["--vary", "turbulence.1.velocity=0.5,1.2,3", "--measure", "work_rate"];
        said(path, &[&own[..], &SHORT, &vary, more].concat(), 0)
    };
    let told = "2 of 3 rows are beyond the fluid-elastic limit: work rates there mean nothing";
    let parts = ["--no-report", "--out", "parts", "--shard"];
    for (base, more, out) in [
        ("0.5", &["--out", "stable"][..], "stable"),
        ("3", &["--out", "unstable", "--json"], "unstable"),
        ("0.5", &["--out", "seeds", "--seeds", "2"], "seeds"),
        ("0.5", &[&parts[..], &["1/2"]].concat(), ""),
        ("0.5", &[&parts[..], &["2/2"]].concat(), ""),
    ] {
        let (_, err) = sweep(base, more);
        let Some(folder) = Some(path.join(out)).filter(|_| !out.is_empty()) else { continue };
        assert!(err.contains(&format!("note: {told}")) && err.contains("(among rows 1 to 2"), "{err}");
        assert!(!err.contains("unstable: work rates"), "{err}");
        let mut table = csv::Reader::from_path(folder.join("sweep.csv")).unwrap();
        let rows: Vec<std::collections::HashMap<String, String>> = table.deserialize().map(Result::unwrap).collect();
        assert!(rows.iter().all(|row| row["status"] == "ok") && rows[0]["error"].is_empty(), "{rows:?}");
        for (row, margin) in rows.iter().zip(["", "margin 0.950", "margin 0.380"]).skip(1) {
            assert!(row["error"].contains("unstable: work rates mean nothing") && row["error"].contains(margin));
        }
        let summary: Value = serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap();
        let notes: Vec<&str> = summary["notes"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        assert_eq!(notes.iter().filter(|note| note.contains("fluid-elastic limit: ")).count(), 1, "{notes:?}");
        assert!(fs::read_to_string(folder.join("report.html")).unwrap().contains(told));
    }
    let (_, err) = said(path, &["merge", "parts", "--out", "merged"], 0);
    assert!(err.contains(told), "{err}");
    // A finished sweep that is read again says the same.
    assert!(sweep("0.5", &["--out", "stable"]).1.contains(told));
}

#[test]
fn rows_beyond_the_limit_have_no_part_in_the_shares_of_a_random_design() {
    let dir = tempfile::tempdir().unwrap();
    let case = ["tube-in-cross-flow", "--set", "flow.connors=3", "--set", "system.modes=4"];
    let design = ["--vary", "turbulence.1.velocity=0.8:1.5", "--random", "uniform", "--points", "20"];
    let own = ["--measure", "work_rate", "--out", "drawn"];
    said(dir.path(), &[&["sweep"], &case[..], &SHORT, &design, &own].concat(), 0);
    let lines = |name: &str, column: &str| -> Vec<String> {
        let mut table = csv::Reader::from_path(dir.path().join("drawn").join(name)).unwrap();
        let at = table.headers().unwrap().iter().position(|header| header == column).unwrap();
        table.records().map(|row| row.unwrap()[at].to_owned()).collect()
    };
    let stable = lines("sweep.csv", "error").iter().filter(|error| !error.contains("beyond the fluid-elastic")).count();
    assert!((5..20).contains(&stable), "{stable}");
    let rows = lines("shares.csv", "rows");
    assert!(!rows.is_empty() && rows.iter().all(|rows| *rows == stable.to_string()), "{rows:?} of {stable}");
}
