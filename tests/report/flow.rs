//! The section "Flow" of a run: turbulent forces, asked and recovered, and margins of stability.
use crate::browser::opened;
use crate::chromium::Browser;
use crate::command::said;
use crate::text::data;
use std::fs;

const SHORT: [&str; 10] = [
    "tube-in-cross-flow",
    "--no-verdict",
    "--set",
    "time.end=0.6",
    "--set",
    "time.statistics_from=0.1",
    "--set",
    "system.modes=3",
    "--out",
    "o",
];

#[test]
fn a_run_in_turbulence_has_the_section_and_one_without_has_none() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &[&["run"], &SHORT[..], &["--set", "flow.connors=3"]].concat(), 0);
    let folder = dir.path().join("o");
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    let turbulence = &data(&page)["turbulence"];
    // Six modes, three of each plane: each field has three, and three pairs of them.
    assert_eq!(turbulence["pairs"]["rows"], 6);
    let text = fs::read_to_string(folder.join("turbulence.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    assert_eq!(turbulence["spectra"]["rows"], rows.len());
    assert!(rows.len() >= 6 * 5 && rows.len().is_multiple_of(6), "{}", rows.len());
    let (y, z) = (rows.iter().filter(|row| row[0] == "1 along y"), rows.iter().filter(|row| row[0] == "1 along z"));
    assert_eq!((y.count(), z.count()), (rows.len() / 2, rows.len() / 2));
    for row in &rows {
        let [asked, recovered, scatter]: [f64; 3] = [4, 5, 6].map(|column: usize| row[column].parse().unwrap());
        // Five standard deviations of χ²_ν/ν, and what the window smears of a steep spectrum.
        assert!(asked > 0.0 && (recovered / asked - 1.0).abs() < 5.0 * scatter / asked + 0.5, "{row:?}");
    }
    fs::remove_file(folder.join("report.html")).unwrap();
    said(dir.path(), &["report", "o"], 0);
    assert_eq!(fs::read_to_string(folder.join("report.html")).unwrap(), page, "another page of the same folder");

    said(dir.path(), &["run", "tube-round-supports", "--end", "0.02", "--no-verdict", "--out", "n"], 0);
    let none = dir.path().join("n/report.html");
    assert!(data(&fs::read_to_string(&none).unwrap())["turbulence"].is_null());
    assert!(!dir.path().join("n/turbulence.csv").exists());

    let Some(mut browser) = Browser::start() else {
        eprintln!("skipped: no chromium is installed (apt-get install chromium, or SIGNORINI_BROWSER=PATH)");
        return;
    };
    let mut tab = opened(&mut browser, &folder.join("report.html"));
    assert_eq!(tab.evaluate("document.querySelectorAll('#flow .plot').length"), 2);
    let picture = "document.querySelector('#flow .plot canvas').toDataURL()";
    let first = tab.evaluate(picture);
    tab.press_button("Turbulence 1 along z");
    tab.frame();
    assert_ne!(tab.evaluate(picture), first);
    assert!(tab.evaluate("document.querySelector('#flow table').textContent").as_str().unwrap().contains("inactive"));
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0");
    tab.close();
    let mut tab = opened(&mut browser, &none);
    assert_eq!(tab.evaluate("document.querySelector('#flow')"), serde_json::Value::Null);
    tab.close();
}

#[test]
fn a_flow_beyond_the_fluid_elastic_limit_stands_first_among_the_checks() {
    let dir = tempfile::tempdir().unwrap();
    for (velocity, first) in [("3", "Flow"), ("0.5", "Refinement")] {
        let velocity = format!("turbulence.1.velocity={velocity}");
        let flow = ["--set", "flow.connors=3", "--set", &velocity, "--force"];
        said(dir.path(), &[&["run"], &SHORT[..], &flow].concat(), 0);
        let page = fs::read_to_string(dir.path().join("o/report.html")).unwrap();
        let card = &data(&page)["cards"][0];
        assert_eq!(card["title"], first, "{card}");
        if first == "Flow" {
            assert!(
                card["state"] == "bad" && card["text"].as_str().unwrap().starts_with("The flow is beyond"),
                "{card}"
            );
        }
    }
}
