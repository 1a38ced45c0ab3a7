//! Realisations and histories on their pages, in a real browser: where the tube wears, each draw
//! with its seeds, and numbers that are those of the files.
use crate::browser::{opened, results};
use crate::chromium::{Browser, Tab};
use crate::command::said;
use crate::shown::{number_with_half_width, same};
use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::path::Path;

const TUBE: [&str; 9] = [
    "tube-in-cross-flow",
    "--set",
    "time.end=0.3",
    "--set",
    "time.statistics_from=0.1",
    "--set",
    "time.step=1e-4",
    "--set",
    "system.modes=4",
];

fn rows(path: &Path) -> Vec<HashMap<String, String>> {
    csv::Reader::from_path(path).unwrap().deserialize().map(|row| row.unwrap()).collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?}", row[column]))
}

/// The texts of the cells of a table of the page.
fn cells(tab: &mut Tab<'_>, table: &str) -> Vec<Vec<String>> {
    let lines = format!("[...{table}.querySelectorAll('tbody tr:not(.space)')]");
    let found = tab.evaluate(&format!("{lines}.map((tr) => [...tr.children].map((td) => td.textContent))"));
    serde_json::from_value(found).unwrap()
}

/// The sectors on the page are those of the file, in micrometres.
fn check_sectors(tab: &mut Tab<'_>, folder: &Path) {
    let shown = cells(tab, "document.querySelector('#where')");
    let file = rows(&folder.join("sector-means.csv"));
    assert_eq!((shown.len(), file.len()), (24, 24), "two supports of twelve sectors");
    for (cells, row) in shown.iter().zip(&file) {
        let depth = 1e6 * number(row, "depth_m");
        assert!(cells[0] == row["place"] && same(&cells[2], depth), "{cells:?} {row:?}");
        let [from, to] = ["from_deg", "to_deg"].map(|column| number(row, column));
        assert_eq!(cells[1], format!("{from}° to {to}°"));
        let (_, half) = number_with_half_width(&cells[2]);
        let wanted = 1e6 * number(row, "depth_half_width_95_m");
        // A sector that nothing ever rubs has a depth of 0 in every realisation.
        assert!((half.unwrap_or(0.0) - wanted).abs() <= 0.06 * wanted, "{cells:?} for {wanted}");
    }
}

#[test]
fn the_page_of_realisations_has_their_sectors_strips_and_the_command_of_each() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &[&["run"], &TUBE[..], &["--seeds", "3", "--no-verdict"]].concat());
    let folder = page.parent().unwrap();
    let mut tab = opened(&mut browser, &page);
    check_sectors(&mut tab, folder);
    tab.press_button("Work rate (mW)");
    let shown = cells(&mut tab, "document.querySelector('#where')");
    let file = rows(&folder.join("sector-means.csv"));
    for (cells, row) in shown.iter().zip(&file) {
        assert!(same(&cells[2], 1e3 * number(row, "work_rate_W")), "{cells:?} {row:?}");
    }
    // Each realisation with its work rates, and the means of the summary below the strips.
    let file = rows(&folder.join("realisations.csv"));
    let of = |draw: &str, place: &str| {
        let own = |row: &&HashMap<String, String>| {
            row["realisation"] == draw && row["place"] == place && row["kind"] == "support"
        };
        number(file.iter().find(own).unwrap(), "work_rate_W")
    };
    let shown = cells(&mut tab, "document.querySelector('#realisations')");
    assert_eq!(shown.len(), 3);
    for cells in &shown {
        assert_eq!(cells[0], cells[1], "realisation k has seed k here");
        assert!(same(&cells[2], of(&cells[0], "plate-1")) && same(&cells[3], of(&cells[0], "plate-2")), "{cells:?}");
    }
    let text = tab.evaluate("document.querySelector('#realisations').textContent").to_string();
    let summary: Value = serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap();
    let estimates = summary["realisations"]["estimates"].as_array().unwrap();
    for one in estimates.iter().filter(|one| one["measure"] == "work_rate") {
        let before = format!("{} ", one["place"].as_str().unwrap());
        let told = text.split("means: ").nth(1).unwrap().split(&before).nth(1).unwrap();
        assert!(same(told.split([';', '\\']).next().unwrap(), one["mean"].as_f64().unwrap()), "{told}");
    }
    // The command makes the same realisation from the case that the page saves.
    let data = tab.evaluate("JSON.parse(document.getElementById('data').textContent).case");
    fs::write(folder.join("tube-in-cross-flow.toml"), data.as_str().unwrap()).unwrap();
    let command = shown[1].last().unwrap();
    assert!(command.contains("--set turbulence.1.seed=2"), "{command}");
    let words: Vec<&str> = command.split(' ').skip(1).chain(["--no-verdict"]).collect();
    said(folder, &words, 0);
    let alone = rows(&folder.join("realisations/2/supports.csv"));
    assert_eq!(number(&alone[0], "work_rate_W"), of("2", "plate-1"));
    tab.close();
}

#[test]
fn the_page_of_wear_has_the_sectors_and_the_histories() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let asked = ["--histories", "3", "--years", "8", "--json"];
    let page = results(dir.path(), &[&["wear"], &TUBE[..], &asked].concat());
    let folder = page.parent().unwrap();
    let mut tab = opened(&mut browser, &page);
    check_sectors(&mut tab, folder);
    let bars = tab.evaluate("document.querySelector('#where canvas').getAttribute('aria-label')").to_string();
    let years = rows(&folder.join("years.csv"));
    for row in &years[years.len() - 2..] {
        let at = format!("{} at ", row["place"]);
        let told = bars.split(&at).nth(1).unwrap().split(": ").nth(1).unwrap();
        assert!(same(told.split(';').next().unwrap(), 1e3 * number(row, "depth_deepest_m")), "{bars}");
    }
    let history = rows(&folder.join("history.csv"));
    let last: Vec<_> = history.iter().filter(|row| row["year"] == history.last().unwrap()["year"]).collect();
    let shown = cells(&mut tab, "document.querySelector('#realisations')");
    assert_eq!((shown.len(), last.len()), (3, 6));
    for row in last {
        let cells = shown.iter().find(|cells| cells[0] == row["history"]).unwrap();
        let cell = &cells[if row["place"] == "plate-1" { 2 } else { 3 }];
        assert!(same(cell, 1e3 * number(row, "depth_deepest_m")), "{cells:?} {row:?}");
    }
    // Then the flow, one motion as the page of a run has it, and what the words mean.
    let menu = tab.evaluate("[...document.querySelectorAll('nav a')].map((a) => a.textContent).join(' ')");
    assert_eq!(
        menu,
        "Wear over the years Years Where Histories Flow One motion Motion Phase Supports Contacts Definitions Notes"
    );
    let text = tab.evaluate("document.querySelector('#one-motion').textContent").to_string();
    assert!(text.contains("History 1 of 3, its first window"), "{text}");
    let supports = rows(&folder.join("first-window/supports.csv"));
    let shown = cells(&mut tab, "document.querySelector('#supports')");
    assert_eq!((shown.len(), supports.len()), (2, 2));
    for (cells, row) in shown.iter().zip(&supports) {
        assert!(cells[0] == row["support"] && same(&cells[2], number(row, "work_rate_W")), "{cells:?}");
        let own = |first: &&HashMap<String, String>| first["history"] == "1" && first["place"] == row["support"];
        assert_eq!(history.iter().find(own).unwrap()["work_rate_W"], row["work_rate_W"], "the window of year 0");
    }
    let asked = rows(&folder.join("turbulence.csv"));
    let plots = tab.evaluate("document.querySelectorAll('#flow .plot').length");
    assert!(!asked.is_empty() && plots == 2, "{plots}");
    let words = tab.evaluate("document.querySelectorAll('#definitions dt').length");
    assert_eq!(words, 14);
    tab.close();
}
