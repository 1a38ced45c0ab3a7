//! Tables on the page of a run, in a real browser: each is there, whole, and what is said of it is
//! true.
use crate::browser::{opened, results};
use crate::chromium::Browser;
use serde_json::json;
use std::fs;

#[test]
fn the_page_of_a_run_has_the_derivatives_that_were_asked_for() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let case = ["run", "elastic-wall", "--set", "time.end=0.5", "--set", "time.output_times=[0.1, 0.3]"];
    let page = results(dir.path(), &[&case[..], &["--derivative", "wall.upper.stiffness"]].concat());
    let mut tab = opened(&mut browser, &page);
    // First what 1 % more of the key changes: of two walls, three numbers each.
    let effects = tab.evaluate("document.querySelector('#derivatives .scroll').textContent").to_string();
    assert!(effects.contains("1 % more of wall.upper.stiffness") && effects.contains("largest impulse"), "{effects}");
    for (index, name) in [(1, "derivatives.csv"), (2, "output-derivatives.csv")] {
        let table = format!("document.querySelectorAll('#derivatives .scroll')[{index}]");
        let heads = tab.evaluate(&format!("[...{table}.querySelectorAll('th')].map((th) => th.textContent)"));
        let rows = tab.evaluate(&format!("{table}.querySelectorAll('tbody tr:not(.space)').length"));
        let file = fs::read_to_string(page.with_file_name(name)).unwrap();
        let header: Vec<&str> = file.lines().next().unwrap().split(',').collect();
        assert_eq!((heads, rows), (json!(header), json!(file.lines().count() - 1)), "{name}");
        assert!(header.iter().any(|name| name.contains("_by_wall_upper_stiffness_")), "{header:?}");
    }
    tab.close();
}

#[test]
fn sliders_alone_have_no_orbit_and_no_ring_and_no_table_hides_its_last_row() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &["run", "dry-friction-damper", "--no-verdict"]);
    let mut tab = opened(&mut browser, &page);
    let title = tab.evaluate("document.querySelector('#supports h2').textContent");
    let text = tab.evaluate("document.querySelector('#supports').textContent").to_string();
    assert!(title == "Sliders" && !text.contains("ring") && text.contains("pad"), "{title}: {text}");
    // Below the table there is room for the bar that scrolls it sideways.
    for section in ["#supports", "#statistics"] {
        let hidden = format!(
            "(({{ scrollHeight, clientHeight }}) => scrollHeight - clientHeight)\
            (document.querySelector('{section} .scroll'))"
        );
        assert_eq!(tab.evaluate(&hidden), json!(0), "{section}");
    }
    tab.close();
}
