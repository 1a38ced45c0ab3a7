//! The page and the pictures of several bodies: each along its own axis.
use crate::browser::{opened, results};
use crate::chromium::Browser;
use crate::text::data;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;

/// A column of a table by its name.
fn column(path: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let index = lines.next().unwrap().split(',').position(|head| head == name).unwrap_or_else(|| panic!("{name}"));
    lines.map(|line| line.split(',').nth(index).unwrap().parse().unwrap()).collect()
}

/// The data of the first run of a page.
fn run_of(page: &Path) -> Value {
    data(&fs::read_to_string(page).unwrap())["runs"][0].clone()
}

#[test]
fn two_tubes_are_drawn_each_along_its_own_axis() {
    let dir = tempfile::tempdir().unwrap();
    let short = ["--set", "body.right.beam.length=1.6", "--set", "time.statistics_from=0", "--end", "0.1"];
    let page = results(dir.path(), &[&["run", "two-tubes", "--no-verdict"], &short[..]].concat());
    let folder = page.parent().unwrap();
    let bodies = &run_of(&page)["bodies"];
    assert!(run_of(&page)["shape"].is_null());
    for (name, length) in [("left", 2.0), ("right", 1.6)] {
        let stations: Vec<f64> =
            bodies[name]["stations"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        assert_eq!((stations[0], *stations.last().unwrap(), &bodies[name]["planes"]), (0.0, length, &json!(2)));
        assert!(stations.contains(&1.0), "where they touch");
    }
    // What the probes of the support watch is the difference of the two.
    for axis in ["y", "z"] {
        let watched = column(&folder.join("trajectory.csv"), &format!("displacement_midspan_{axis}_m"));
        let of = |name: &str| column(&folder.join("shape.csv"), &format!("displacement_{axis}_of_{name}_at_1p0_m"));
        let (left, right) = (of("left"), of("right"));
        let largest = left.iter().chain(&right).fold(0.0_f64, |most, u| most.max(u.abs()));
        assert!(largest > 1e-6 && watched.len() == left.len());
        // The file has six digits.
        assert!(watched.iter().zip(left.iter().zip(&right)).all(|(w, (a, b))| (a - b - w).abs() <= 2e-5 * largest));
    }
    let picture = fs::read_to_string(folder.join("animation.svg")).unwrap();
    for label in ["left, plane y", "left, plane z", "right, plane y", "right, plane z", "midspan"] {
        assert!(picture.contains(&format!(">{label}<")), "{label}");
    }
}

/// A tube in one plane that meets a post, beside modes that have no line.
const MIXED: &str = r#"title = "A tube that meets a post"
[system]
modes = 6
[[body]]
name = "tube"
[body.beam]
spans = [0.5, 1.0]
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 0.02
elements = 12
left = "pinned"
right = "clamped"
[body.damping]
ratio = 0.02
[[body]]
name = "post"
[body.oscillator]
mass = 0.5
damping = 1.0
stiffness = 2e4
[[body]]
name = "frame"
[body.modal]
frequencies = [30.0]
damping_ratios = 0.02
shapes = { a = [1.0] }
[[wall]]
name = "touch"
side = "upper"
position = 2e-4
at = { body = "tube", position = 0.7, relative_to = { body = "post", dof = 0 } }
[[wall]]
name = "stop"
side = "lower"
position = -1e-3
at = { body = "tube", position = 1.1 }
[[load]]
at = { body = "tube", position = 0.6 }
harmonic = { amplitude = 40.0, frequency = 30.0 }
[time]
end = 0.3
step = 1e-4
"#;

#[test]
fn a_tube_beside_other_bodies_opens_in_a_browser_with_those_that_have_a_line() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("mixed.toml"), MIXED).unwrap();
    let page = results(dir.path(), &["run", "mixed.toml", "--no-verdict"]);
    let run = run_of(&page);
    let names: Vec<&String> = run["bodies"].as_object().unwrap().keys().collect();
    assert_eq!(names, ["tube", "post"]);
    assert_eq!(run["bodies"]["post"]["stations"], json!([0.0]));
    let picture = fs::read_to_string(page.parent().unwrap().join("animation.svg")).unwrap();
    assert!(picture.contains(">tube, from the side<"));
    assert!(picture.contains("; without ") && picture.contains("post") && picture.contains("frame"));
    let two =
        results(dir.path(), &["run", "two-tubes", "--no-verdict", "--end", "0.1", "--set", "time.statistics_from=0"]);
    let Some(mut browser) = Browser::start() else { return };
    for page in [page, two] {
        let mut tab = opened(&mut browser, &page);
        let drawn = tab.evaluate("[...document.querySelectorAll('.drawing canvas')].map((c) => c.ariaLabel).join()");
        assert!(drawn.as_str().unwrap().contains("The bodies from the side"), "{drawn}");
    }
}
