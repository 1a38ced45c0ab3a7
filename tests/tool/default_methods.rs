//! The methods of `compare` and `chart` where some schemes have no rule for the walls of a case.
use crate::command::said;
use std::fs;

const CASE: &str = "dry-friction-damper";

/// The first cell of each row of a table.
fn first_cells(csv: &str) -> Vec<String> {
    let mut cells: Vec<String> = csv.lines().skip(1).map(|line| line.split(',').next().unwrap().to_owned()).collect();
    cells.dedup();
    cells
}

#[test]
fn schemes_that_refuse_the_walls_have_rows_only_where_they_are_asked_for() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let short = ["--set", "time.end=0.05", "--out"];
    let own = [&["compare", CASE, "--no-verdict"], &short[..], &["own"]].concat();
    let (out, err) = said(path, &own, 0);
    assert_eq!(first_cells(&fs::read_to_string(path.join("own/compare.csv")).unwrap()), ["moreau-jean", "located"]);
    assert!(!out.contains("failed") && !err.contains("event failed"), "{out}{err}");
    // The reference is of order 2 also where the scheme by default is not.
    let page = fs::read_to_string(path.join("own/report.html")).unwrap();
    assert!(page.contains(r#""reference":"located with steps of 1.56e-5 s""#));

    let asked = [&["compare", CASE, "--no-verdict", "--schemes", "moreau-jean,event"], &short[..], &["asked"]].concat();
    let (_, err) = said(path, &asked, 0);
    assert!(err.contains("- event failed") && err.contains("no friction"), "{err}");

    let steps = ["--steps", "1e-3:5e-4", "--levels", "2", "--repeats", "1"];
    let chart = [&["chart", CASE], &steps[..], &short, &["chart"]].concat();
    let (_, err) = said(path, &chart, 0);
    let table = fs::read_to_string(path.join("chart/work-precision.csv")).unwrap();
    assert_eq!(first_cells(&table), ["moreau-jean", "located"]);
    let refused = "refused here: event, paoli-schatzman, generalized-alpha, implicit-euler, newmark";
    assert!(err.contains(refused) && err.contains("reference: located refined"), "{err}");
}
