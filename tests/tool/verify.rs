//! `verify`: the verification manual, as a user runs it.
use std::fs;
use std::process::Command;

#[test]
fn every_value_of_the_manual_is_found_within_its_tolerance() {
    let dir = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_signorini")).args(args).current_dir(dir.path()).output().unwrap()
    };
    let output = run(&["verify"]);
    let (said, told) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{said}{told}");
    assert!(!said.contains("FAILS") && said.contains("values are within their tolerances"), "{said}");
    assert!(told.contains("open out/verify/verification.html"), "{told}");
    let mut table = csv::Reader::from_path(dir.path().join("out/verify/verification.csv")).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    assert!((55..65).contains(&rows.len()), "{}: the help and README.md say some 60", rows.len());
    for row in &rows {
        let [expected, found, tolerance] = [6, 7, 8].map(|column| row[column].parse::<f64>().unwrap());
        assert!((found - expected).abs() <= tolerance && tolerance <= 0.03 * expected.abs().max(2e-3), "{row:?}");
    }
    let page = fs::read_to_string(dir.path().join("out/verify/verification.html")).unwrap();
    assert_eq!(page.matches("<td class=\"holds\">").count(), rows.len());
    assert!(!page.contains("<script") && page.contains("default-src 'none'"));
    // As JSON, and in a folder that holds the results of another request.
    let json = run(&["verify", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(document["values"].as_array().map(Vec::len), Some(rows.len()));
    assert_eq!(run(&["run", "bouncing-ball", "--end", "0.1", "--out", "other"]).status.code(), Some(0));
    assert_eq!(run(&["verify", "--out", "other"]).status.code(), Some(2));
    assert!(!dir.path().join("other/verification.csv").exists());
}
