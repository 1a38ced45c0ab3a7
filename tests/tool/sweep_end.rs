//! `sweep --end`: an edit of the case, as `--end` of `run` and `chart` is.
use crate::command::said;
use crate::table::{number, rows, summary};
use std::fs;

#[test]
fn the_end_of_a_sweep_is_that_of_its_case() {
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "wall.*.restitution=0.5,1", "--measure", "contacts,displacement_max"];
    let sweep =
        |more: &[&str], code| said(dir.path(), &[&["sweep", "rigid-walls-sine"], &vary[..], more].concat(), code);
    sweep(&["--end", "0.5", "--out", "end"], 0);
    sweep(&["--set", "time.end=0.5", "--out", "set"], 0);
    let table = |out: &str| fs::read_to_string(dir.path().join(out).join("sweep.csv")).unwrap();
    assert_eq!(table("end"), table("set"));
    sweep(&["--out", "whole"], 0);
    assert_ne!(table("end"), table("whole"));
    // A window of statistics beyond the end begins at 0, as in a run.
    let (_, told) = sweep(&["--set", "time.statistics_from=2", "--end", "0.5", "--out", "window"], 0);
    assert!(told.contains("note: statistics begin at 0 s, not at 2 s"), "{told}");
    assert_eq!(table("window"), table("end"));
    // Rows with a window of their own have no such end.
    let (_, told) = sweep(&["--end", "0.5", "--settle", "5", "--keep", "5"], 2);
    assert!(told.contains("--end") && told.contains("--keep"), "{told}");
    let file = "case = \"rigid-walls-sine\"\n[[vary]]\nkey = \"wall.*.restitution\"\nvalues = [0.5, 1.0]\n\
        [run]\nkeep = { periods = 5 }\n[measure]\ncolumns = [\"contacts\"]\n";
    fs::write(dir.path().join("own.toml"), file).unwrap();
    let (_, told) = said(dir.path(), &["sweep", "own.toml", "--end", "0.5"], 2);
    assert!(told.contains("--end") && told.contains("settle and keep"), "{told}");
}

/// A row of a sweep over periods is the run with the same periods, by itself: the page of a sweep
/// gives that command. A run and its row sum their impulses in another order.
#[test]
fn a_run_over_periods_is_the_row_of_a_sweep_over_them() {
    let dir = tempfile::tempdir().unwrap();
    let periods = ["--settle", "20", "--keep", "10", "--scheme", "event"];
    let vary = ["--vary", "load.1.harmonic.frequency=4.5,6", "--measure", "contacts,impulse"];
    said(
        dir.path(),
        &[&["sweep", "rigid-walls-sine"], &vary[..], &periods, &["--out", "s", "--no-report"]].concat(),
        0,
    );
    for row in rows(&dir.path().join("s/sweep.csv")) {
        let set = format!("load.1.harmonic.frequency={}", row["frequency_Hz"]);
        let own = ["--set", &set, "--no-verdict", "--no-report", "--force", "--out", "r"];
        said(dir.path(), &[&["run", "rigid-walls-sine"], &own[..], &periods].concat(), 0);
        let summary = summary(&dir.path().join("r"));
        let wall = &summary["statistics"]["walls"][0];
        assert_eq!(number(&row, "contacts_upper"), wall["contacts"].as_f64().unwrap());
        let impulse = wall["force"]["impulse_n_s"].as_f64().unwrap();
        assert!((number(&row, "impulse_upper_N_s") - impulse).abs() <= 1e-12 * impulse.abs(), "{impulse} {row:?}");
    }
    let (_, told) = said(dir.path(), &["run", "rigid-walls-sine", "--settle", "2"], 2);
    assert!(told.contains("--keep"), "{told}");
    let (_, told) = said(dir.path(), &["run", "tabulated-pulse", "--keep", "2"], 2);
    assert!(told.contains("does not repeat"), "{told}");
}
