//! `sweep --random`: the shares of keys in the variance of measures.
use crate::command::said;
use serde_json::Value;
use signorini::case::CaseFile;
use signorini::sweep::{Axis, Design, Measure, Random, Shard, Sweep, SweepOptions, Values};
use std::fs;
use std::path::Path;

/// A linear oscillator before a stop that it does not reach: its displacement is in proportion to
/// the amplitude of the load, whatever the restitution.
const LINEAR: &str = "\
[system.oscillator]
mass = 1.0
damping = 2.0
stiffness = 400.0
[[wall]]
name = \"stop\"
side = \"upper\"
position = 10.0
restitution = 0.5
[[load]]
harmonic = { amplitude = 3.0, frequency = 2.0 }
[time]
end = 3.0
step = 1e-3
";

fn sweep(folder: &Path, points: &str, more: &[&str]) -> (String, String) {
    fs::write(folder.join("linear.toml"), LINEAR).unwrap();
    let keys = ["--vary", "load.1.harmonic.amplitude=1:5", "--vary", "wall.stop.restitution=0.2:0.9"];
    let own = ["--random", "lhs", "--points", points, "--measure", "displacement_max,contacts", "--force"];
    said(folder, &[&["sweep", "linear.toml"], &keys[..], &own, more].concat(), 0)
}

/// The lines of `shares.csv`: key, measure and share.
fn shares(folder: &Path) -> Vec<(String, String, f64)> {
    let mut table = csv::Reader::from_path(folder.join("out/linear/sweep/shares.csv")).unwrap();
    assert_eq!(table.headers().unwrap(), vec!["key", "place", "measure", "unit", "share", "half_width_95", "rows"]);
    let line = |row: csv::StringRecord| (row[0].to_owned(), row[2].to_owned(), row[4].parse().unwrap());
    table.records().map(|row| line(row.unwrap())).collect()
}

#[test]
fn the_shares_of_a_random_design_are_those_of_the_law() {
    let dir = tempfile::tempdir().unwrap();
    let (out, err) = sweep(dir.path(), "40", &[]);
    let found = shares(dir.path());
    // All of the variance is the amplitude's; no contact occurs, so that their number has none.
    assert_eq!(found.len(), 3, "{found:?}");
    let expected = [("load.1.harmonic.amplitude", 1.0), ("wall.stop.restitution", 0.0), ("interactions", 0.0)];
    for ((key, measure, share), (name, value)) in found.iter().zip(expected) {
        assert_eq!((key.as_str(), measure.as_str()), (name, "displacement_max"));
        // The motion is computed to rounding, and the fit holds a straight line exactly.
        assert!((share - value).abs() < 1e-9, "{key}: {share}");
    }
    assert!(out.contains("displacement_max") && out.contains("100.0 ± 0.0"), "{out}");
    assert!(err.contains("the share of each key in the variance"), "{err}");
    // Of shards the same.
    let whole = fs::read(dir.path().join("out/linear/sweep/shares.csv")).unwrap();
    for shard in ["1/2", "2/2"] {
        sweep(dir.path(), "40", &["--shard", shard, "--out", "parts"]);
    }
    assert!(!dir.path().join("parts/shares.csv").exists());
    said(dir.path(), &["merge", "parts", "--out", "joined"], 0);
    assert_eq!(fs::read(dir.path().join("joined/shares.csv")).unwrap(), whole);
}

#[test]
fn too_few_rows_have_no_shares_and_few_a_note() {
    let dir = tempfile::tempdir().unwrap();
    let (_, err) = sweep(dir.path(), "7", &[]);
    assert!(!dir.path().join("out/linear/sweep/shares.csv").exists());
    assert!(err.contains("no shares of the keys from 7 rows with a value: they take more than 7"), "{err}");
    let (_, err) = sweep(dir.path(), "12", &[]);
    assert_eq!(shares(dir.path()).len(), 3);
    assert!(err.contains("note: 12 rows for 7 coefficients"), "{err}");
}

/// A library call that finds the sweep finished adds no table, and takes away nothing.
#[test]
fn a_call_of_the_library_leaves_the_files_of_the_tool() {
    let dir = tempfile::tempdir().unwrap();
    let options = SweepOptions { threads: None, shard: Shard::WHOLE, force: false };
    for points in ["7", "12"] {
        sweep(dir.path(), points, &[]);
        let axis = |key: &str, from: f64, to: f64| Axis::new(key, Values::Range { from, to, log: false }).unwrap();
        let plan = Sweep::new(CaseFile::read(dir.path().join("linear.toml")).unwrap())
            .vary(axis("load.1.harmonic.amplitude", 1.0, 5.0))
            .vary(axis("wall.stop.restitution", 0.2, 0.9))
            .drawn(Random { design: Design::LatinHypercube, points: points.parse().unwrap(), seed: None })
            .measure([Measure::DisplacementMax, Measure::Contacts])
            .plan()
            .unwrap();
        let own = dir.path().join("out/linear/sweep");
        assert_eq!(plan.run_into(&own, options, &|_| {}).unwrap().found, points.parse::<u64>().unwrap());
        for file in ["sweep.csv", "sweep.svg", "summary.json", "report.html"] {
            assert!(own.join(file).exists(), "{file} of {points} points");
        }
        // Into a folder of its own the library writes the same table.
        let other = dir.path().join(points);
        plan.run_into(&other, options, &|_| {}).unwrap();
        assert_eq!(fs::read(other.join("shares.csv")).ok(), fs::read(own.join("shares.csv")).ok());
    }
}

/// The document has what the tables have.
#[test]
fn the_document_has_the_rows_and_the_shares() {
    let dir = tempfile::tempdir().unwrap();
    let document: Value = serde_json::from_str(&sweep(dir.path(), "20", &["--json"]).0).unwrap();
    let shares = shares(dir.path());
    assert_eq!(document["shares"].as_array().unwrap().len(), shares.len());
    for (one, (key, measure, share)) in document["shares"].as_array().unwrap().iter().zip(shares) {
        assert_eq!((one["key"].as_str(), one["measure"].as_str()), (Some(&*key), Some(&*measure)));
        assert_eq!(one["share"].as_f64(), Some(share));
    }
    let mut table = csv::Reader::from_path(dir.path().join("out/linear/sweep/sweep.csv")).unwrap();
    let header = table.headers().unwrap().clone();
    let values = document["values"].as_array().unwrap();
    assert_eq!((values.len(), document["rows"].as_u64()), (20, Some(20)));
    for (one, row) in values.iter().zip(table.records().map(Result::unwrap)) {
        for (name, cell) in header.iter().zip(&row) {
            let number = cell.parse().ok();
            assert!(
                one[name].as_f64() == number && one[name].as_str().is_none_or(|word| word == cell),
                "{name}: {one}"
            );
        }
        assert!(one["error"].is_null() && one["row"].is_u64(), "{one}");
    }
}
