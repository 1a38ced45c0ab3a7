//! Pages in a narrow window, and tables that fit a wide one.
use crate::browser::{opened, results};
use crate::chromium::{Browser, Tab};
use serde_json::json;
use std::env::consts::{ARCH, OS};

/// By how many pixels the part of the page at `selector` is wider than what is seen of it.
fn excess(tab: &mut Tab<'_>, selector: &str) -> f64 {
    let part = format!("document.querySelector('{selector}')");
    tab.evaluate(&format!("{part}.scrollWidth - {part}.clientWidth")).as_f64().unwrap()
}

#[test]
fn the_stable_steps_are_cards_on_a_phone() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let short = ["--set", "time.end=0.2", "--set", "penalty.epsilon=[1e-9]"];
    let page = results(dir.path(), &[&["stability", "rigid-walls-sine"], &short[..]].concat());
    let mut tab = opened(&mut browser, &page);
    tab.width(390);
    tab.frame();
    assert_eq!(excess(&mut tab, "#steps .scroll"), 0.0);
    // Every reason has the width of the card, and the numbers without a column have names.
    let narrowest = "Math.min(...[...document.querySelectorAll('#steps td:nth-child(6):not(.none)')].map((td) => \
        td.clientWidth))";
    assert!(tab.evaluate(narrowest).as_f64().unwrap() > 300.0, "{}", tab.evaluate(narrowest));
    let name = "getComputedStyle(document.querySelector('#steps td:nth-child(4)'), '::before').content";
    assert_eq!(tab.evaluate(name), json!("\"impact on a rigid wall \""));
    tab.close();
}

#[test]
fn curves_of_a_chart_are_named_below_it_on_a_phone() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let few = ["--schemes", "event,moreau-jean,penalty:epsilon=1e-6", "--end", "1", "--levels", "4", "--repeats", "1"];
    // On a busy machine a coarse run may seem so slow that the fine one would be left out.
    let page = results(dir.path(), &[&["chart", "rigid-walls-sine", "--longest", "100"], &few[..]].concat());
    let mut tab = opened(&mut browser, &page);
    assert_eq!(tab.evaluate("document.querySelector('#work .curves').hidden"), true);
    tab.width(390);
    tab.frame();
    tab.frame();
    assert_eq!(tab.evaluate("document.querySelector('#work .curves').hidden"), false);
    let names = tab.evaluate("[...document.querySelectorAll('#work .curves li')].map((one) => one.textContent)");
    let names: Vec<String> = serde_json::from_value(names).unwrap();
    assert_eq!(names.len(), 3, "{names:?}");
    assert!(names[0].starts_with("event: ") && names[0].ends_with(", beyond the left edge"), "{names:?}");
    assert_eq!(names[1], "moreau-jean");
    assert!(names[2].starts_with("ε = 1e-6: floor ") && names[2].ends_with(", beyond the right edge"), "{names:?}");
    tab.close();
}

#[test]
fn the_table_of_a_comparison_fits_the_page() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &["compare", "rigid-walls-sine", "--end", "1", "--no-verdict"]);
    let mut tab = opened(&mut browser, &page);
    tab.width(1280);
    tab.frame();
    assert_eq!(excess(&mut tab, "#methods .scroll"), 0.0);
    // On a phone the method stays in view beside each number.
    tab.width(390);
    tab.frame();
    tab.evaluate("document.querySelector('#methods .scroll').scrollLeft = 1000");
    let left = "document.querySelector('#methods tbody tr:not(.space) td').getBoundingClientRect().left - \
        document.querySelector('#methods .scroll').getBoundingClientRect().left";
    assert!(tab.evaluate(left).as_f64().unwrap().abs() < 2.0, "{}", tab.evaluate(left));
    tab.close();
}

#[test]
fn the_verification_manual_is_read_on_a_phone() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &["verify"]).with_file_name("verification.html");
    let mut tab = browser.open(&page);
    tab.until("document.readyState === 'complete'");
    tab.width(390);
    tab.frame();
    assert_eq!(excess(&mut tab, "html"), 0.0);
    // To be filed: when, by what and on what it was made.
    let made = tab.evaluate("document.body.textContent").to_string();
    let by = format!(" UTC by signorini {} on {}, {}.", env!("CARGO_PKG_VERSION"), OS, ARCH);
    assert!(made.contains("All ") && made.contains("Made 2") && made.contains(&by), "{made:.400}");
    // Value, deviation and verdict of every line are within the window.
    let seen = "[...document.querySelectorAll('td')].every((td) => { const box = td.getBoundingClientRect(); \
        return box.width > 0 && box.left >= 0 && box.right <= innerWidth; })";
    assert_eq!(tab.evaluate(seen), true);
    let names = "[...document.querySelectorAll('tbody tr:first-child td')].map((td) => td.dataset.name || '')";
    let expected = ["", "", "expected", "found", "deviation", "tolerance", "", "tolerance:", "source:"];
    assert_eq!(tab.evaluate(names), json!(expected));
    tab.close();
}
