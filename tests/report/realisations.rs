//! Pages of runs and sweeps over realisations of random loads, in a real browser.
use crate::browser::{opened, results};
use crate::chromium::Browser;
use crate::shown::same;
use serde_json::json;
use std::fs;

const CASE: [&str; 5] = ["tube-round-supports", "--set", "time.end=0.3", "--set", "time.statistics_from=0.1"];
const SEEDS: [&str; 4] = ["--seeds", "3", "--measure", "work_rate"];

#[test]
fn the_page_of_realisations_shows_means_and_intervals() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "support.*.gap=1e-4,2e-4,4e-4"];
    let page = results(dir.path(), &[&["sweep"], &CASE[..], &vary, &SEEDS].concat());
    let mut tab = opened(&mut browser, &page);
    // One curve a support: the half widths are bands, not curves of their own.
    let chips = tab.evaluate("[...document.querySelectorAll('#sweep .chip')].map((chip) => chip.textContent)");
    assert_eq!(chips, json!(["Work rate plate 1 (W)", "Work rate plate 2 (W)"]));
    // A band is filled about each of them.
    let fills = "(() => { const pen = CanvasRenderingContext2D.prototype; globalThis.bands = 0; const own = pen.fill; \
        pen.fill = function (...args) { if (Math.abs(this.globalAlpha - 0.18) < 1e-6) bands += 1; \
        return own.apply(this, args); }; })()";
    tab.evaluate(fills);
    tab.press_button("◐");
    tab.frame();
    tab.frame();
    assert_eq!(tab.evaluate("bands"), 2);
    tab.evaluate("document.querySelectorAll('#rows tbody tr:not(.space)')[1].click()");
    let command = tab.evaluate("document.querySelector('#sweep pre.command').textContent");
    let command = command.as_str().unwrap();
    assert!(
        command.contains("--set 'support.*.gap=0.0002'") && command.contains(" --seeds 3 --out rows/1"),
        "{command}"
    );
    let text = tab.evaluate("document.querySelector('#sweep').textContent");
    assert!(text.as_str().unwrap().contains("3 realisations: shown are their means"), "{text}");
    tab.close();
}

#[test]
fn the_page_of_keys_one_at_a_time_has_the_table_of_effects() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "support.*.gap=1e-4:4e-4", "--vary", "system.damping.ratio=0.005:0.02", "--one-at-a-time"];
    let page = results(dir.path(), &[&["sweep"], &CASE[..], &vary, &SEEDS].concat());
    let mut tab = opened(&mut browser, &page);
    let cells =
        "[...document.querySelectorAll('#effects tbody tr:not(.space)')].map((tr) => tr.children[3].textContent)";
    let file = fs::read_to_string(page.with_file_name("effects.csv")).unwrap();
    let keys: Vec<&str> = file.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
    assert_eq!(keys.len(), 4);
    assert_eq!(tab.evaluate(cells), json!(keys), "in the order of the file");
    let effect = tab.evaluate("document.querySelector('#effects tbody tr:not(.space)').textContent");
    assert!(effect.as_str().unwrap().contains(" ± "), "{effect}");
    // A diagram for each of two supports, and no curves.
    let plots = "['#effects', '#sweep'].map((part) => document.querySelectorAll(`${part} .plot`).length)";
    assert_eq!(tab.evaluate(plots), json!([2, 0]));
    tab.close();
}

#[test]
fn the_page_of_a_random_design_has_the_share_of_each_key() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "wall.*.restitution=0.5:1", "--vary", "load.1.harmonic.amplitude=1:3"];
    let own = ["--random", "lhs", "--points", "12", "--measure", "impact_power"];
    let case = ["sweep", "rigid-walls-sine", "--set", "time.end=1"];
    let page = results(dir.path(), &[&case[..], &vary, &own].concat());
    let mut tab = opened(&mut browser, &page);
    let lines = "[...document.querySelectorAll('#shares tbody tr:not(.space)')]";
    let cells = tab.evaluate(&format!("{lines}.map((tr) => [3, 4].map((i) => tr.children[i].textContent))"));
    let file = fs::read_to_string(page.with_file_name("shares.csv")).unwrap();
    let told = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        json!([cells[0], format!("{:.1}", 100.0 * cells[4].parse::<f64>().unwrap())])
    };
    let expected: Vec<_> = file.lines().skip(1).map(told).collect();
    assert_eq!(expected.len(), 6, "two keys and their interactions at two walls");
    assert_eq!(cells, json!(expected), "in the order of the file");
    let plots = "document.querySelectorAll('#shares .plot').length";
    assert_eq!(tab.evaluate(plots), json!(2), "a diagram for each wall");
    let text = tab.evaluate("document.querySelector('#shares').textContent");
    assert!(text.as_str().unwrap().contains("Note: 12 rows for 7 coefficients: the shares scatter"), "{text}");
    tab.close();
}

#[test]
fn the_page_of_a_run_under_several_seeds_has_the_means_and_their_errors() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let short = ["run", "tube-round-supports", "--set", "time.end=0.15", "--set", "time.statistics_from=0.05"];
    let page = results(dir.path(), &[&short[..], &["--seeds", "2"]].concat());
    let mut tab = opened(&mut browser, &page);
    let rows = "[...document.querySelectorAll('#means tbody tr:not(.space)')]";
    let count = tab.evaluate(&format!("{rows}.length"));
    let summary = fs::read_to_string(page.with_file_name("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let estimates = summary["realisations"]["estimates"].as_array().unwrap();
    let worn = summary["realisations"]["worn"].as_array().unwrap();
    assert_eq!((worn.len(), count), (10, json!(estimates.len() + 10)), "two volumes and three depths of two supports");
    let heads = tab.evaluate("[...document.querySelectorAll('#means th')].map((th) => th.textContent.trim())");
    let heads = heads.to_string();
    assert!(["error (%)", "start (%)", "step (%)", "modes (%)"].iter().all(|head| heads.contains(head)), "{heads}");
    // The work rate of the first support: its place, what, unit, mean, error and three parts; and
    // what two refinements make of the number of contacts, which has no error.
    let mut row = |what: &str| -> Vec<String> {
        let texts = format!("{rows}.map((tr) => [...tr.children].map((td) => td.textContent))");
        let cells = tab.evaluate(&format!("{texts}.find((row) => row[1] === '{what}')"));
        cells.as_array().unwrap().iter().map(|cell| cell.as_str().unwrap().to_owned()).collect()
    };
    let cells = row("work rate");
    assert_eq!((cells.len(), cells[0].as_str(), cells[2].as_str()), (10, "plate-1", "W"));
    assert!(cells[3].contains(" ± ") && cells[5..8].iter().all(|cell| cell.contains(" ± ")), "{cells:?}");
    assert_eq!(cells[8..], ["–", "–"]);
    let contacts = row("contacts");
    let one = estimates.iter().find(|one| one["measure"] == "contacts").unwrap();
    for (told, shown) in one["refinements"].as_array().unwrap().iter().zip(&contacts[8..]) {
        let told = ["own", "then"].map(|key| told[key].as_f64().unwrap());
        let shown: Vec<f64> = shown.split(" → ").map(|number| number.parse().unwrap()).collect();
        // Three digits.
        assert!(told.iter().zip(&shown).all(|(x, y)| (x - y).abs() <= 5e-3 * x), "{told:?}, {shown:?}");
    }
    assert_eq!((contacts[4].as_str(), &heads.contains("half the step")), ("–", &true));
    let one = estimates.iter().find(|one| one["measure"] == "work_rate").unwrap();
    let share = 100.0 * one["error"]["total"].as_f64().unwrap() / one["mean"].as_f64().unwrap();
    let shown: f64 = cells[4].parse().unwrap();
    assert!((shown / share - 1.0).abs() < 0.06, "{shown} instead of {share}");
    let text = tab.evaluate("document.body.textContent").to_string();
    assert!(text.contains("The largest work rate has an error of"), "the card tells the error");
    tab.close();
}

#[test]
fn the_page_of_a_comparison_under_seeds_has_the_means_and_names_its_reference() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let case = ["compare", "two-tubes", "--set", "system.modes=2", "--set", "time.sample=1e-3", "--step", "2e-4"];
    let time = ["--set", "time.end=0.1", "--set", "time.statistics_from=0.02", "--seeds", "2", "--no-verdict"];
    let page = results(dir.path(), &[&case[..], &time, &["--schemes", "moreau-jean,located"]].concat());
    let mut tab = opened(&mut browser, &page);
    let text = tab.evaluate("document.body.textContent").to_string();
    // Friction at the tubes: the exact scheme refuses them, and the errors are against finer steps.
    for words in [
        "cross flow: 2 draws",
        "Draw 1 of 2The drawings and the numbers from here on are of this draw alone.",
        "all drawings and other numbers are of draw 1",
        "against located with steps of 2.50e-5 s: draw 1 of 2.",
        "Distance from located with steps of 2.50e-5 s",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(!text.contains("exact motion, the largest"), "{text}");
    let rows = tab.evaluate(
        "[...document.querySelectorAll('#means tbody tr:not(.space)')].map((tr) => \
        [...tr.children].map((td) => td.textContent))",
    );
    let file = fs::read_to_string(page.with_file_name("compare-realisations.csv")).unwrap();
    let rows = rows.as_array().unwrap();
    assert_eq!(rows.len(), file.lines().count() - 1);
    // Both methods of one place and quantity stand together, the second with its difference.
    let cell = |row: usize, at: usize| rows[row][at].as_str().unwrap();
    assert_eq!([cell(0, 4), cell(1, 4)], ["moreau-jean", "located"]);
    assert_eq!((cell(0, 0), cell(0, 2), cell(0, 6)), (cell(1, 0), cell(1, 2), "–"));
    // Each difference is that of the file.
    for row in (1..rows.len()).step_by(2) {
        let measure = match cell(row, 2) {
            "mean force" => "force_mean".to_owned(),
            "mean force along y" => "force_mean_y".to_owned(),
            "mean force along z" => "force_mean_z".to_owned(),
            "RMS force" => "force_rms".to_owned(),
            "largest force" => "force_largest".to_owned(),
            other => other.replace(' ', "_"),
        };
        let begins = format!("located,{},{},{measure},", cell(row, 0), cell(row, 1));
        let line = file.lines().find(|line| line.starts_with(&begins)).unwrap_or_else(|| panic!("{begins}: {file}"));
        let less: f64 = line.split(',').nth(9).unwrap().parse().unwrap();
        assert!(same(cell(row, 6), less), "{line}: {}", cell(row, 6));
    }
    tab.close();
}

#[test]
fn a_map_of_means_promises_no_bands() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "support.*.gap=1e-4,2e-4", "--vary", "system.damping.ratio=0.005,0.02"];
    let short = ["sweep", "tube-round-supports", "--set", "time.end=0.1", "--set", "time.statistics_from=0.05"];
    let page = results(dir.path(), &[&short[..], &vary, &["--seeds", "2", "--measure", "work_rate"]].concat());
    let mut tab = opened(&mut browser, &page);
    let text = tab.evaluate("document.querySelector('#sweep').textContent").to_string();
    assert!(text.contains("and the half widths of their 95 % intervals") && !text.contains("bands"), "{text}");
    tab.close();
}
