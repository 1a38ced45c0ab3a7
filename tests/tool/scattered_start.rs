//! Realisations of a chaotic motion: starts that scatter.

use crate::command::said;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// An oscillator between rigid walls whose motion is chaotic and forgets its start within some
/// seconds: its Lyapunov exponent is 3.6 per second.
const CHAOTIC: [&str; 8] = [
    "run",
    "rigid-walls-sine",
    "--set",
    "wall.*.restitution=0.8",
    "--set",
    "load.1.harmonic.frequency=2.6",
    "--set",
    "time.statistics_from=10",
];

/// From starts that scatter.
const SCATTER: [&str; 2] = ["--set", "initial.scatter.velocity=1e-6"];

fn summary(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
}

#[test]
fn realisation_k_is_the_run_of_its_seed_and_a_case_without_modes_or_with_them_scatters() {
    let short = ["--end", "0.2", "--no-verdict"];
    for case in ["rigid-walls-sine", "tube-loose-supports"] {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path();
        let run = ["run", case, "--set", "initial.scatter.velocity=1e-3"];
        said(path, &[&run[..], &short, &["--seeds", "3", "--out", "three"]].concat(), 0);
        let rows = fs::read_to_string(path.join("three/realisations.csv")).unwrap();
        let third = ["--set", "initial.scatter.seed=2", "--seeds", "1", "--out", "alone"];
        said(path, &[&run[..], &short, &third].concat(), 0);
        let alone = fs::read_to_string(path.join("alone/realisations.csv")).unwrap();
        let of = |rows: &str, number: &str| {
            let own = rows.lines().filter_map(|row| row.strip_prefix(number).map(str::to_owned));
            own.collect::<Vec<_>>()
        };
        let (first, last) = (of(&rows, "1,"), of(&rows, "3,"));
        assert!(!first.is_empty() && first != last, "{case}: {rows}");
        assert_eq!(last, of(&alone, "1,"), "{case}");
    }
}

#[test]
fn means_over_starts_that_scatter_are_those_of_a_long_exact_motion() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let starts = ["--end", "30", "--step", "1e-3", "--seeds", "20", "--no-verdict", "--out", "starts"];
    said(path, &[&CHAOTIC[..], &SCATTER, &starts].concat(), 0);
    let long = ["--scheme", "event", "--end", "410", "--no-verdict", "--out", "long"];
    said(path, &[&CHAOTIC[..], &long].concat(), 0);
    let (starts, long) = (summary(&path.join("starts")), summary(&path.join("long")));
    let mut compared = 0;
    for one in starts["realisations"]["estimates"].as_array().unwrap() {
        if one["measure"] != "mean_force" {
            continue;
        }
        let walls = long["statistics"]["walls"].as_array().unwrap();
        let force = &walls.iter().find(|wall| wall["wall"] == one["place"]).unwrap()["force"];
        let number = |value: &Value| value.as_f64().unwrap();
        let (mean, half) = (number(&one["mean"]), number(&one["half_width_95"]));
        let (exact, other) = (number(&force["mean_n"]), number(&force["mean_half_width_95_n"]));
        // Two independent estimates of one mean: twice the root of the sum of squares of their 95 %
        // intervals is four standard deviations. Both are within 5 %, so that the test can fail.
        assert!((mean - exact).abs() <= 2.0 * half.hypot(other), "{mean} ± {half}, {exact} ± {other}");
        assert!(half < 0.05 * mean && other < 0.05 * exact, "{mean} ± {half}, {exact} ± {other}");
        compared += 1;
    }
    assert_eq!(compared, 2);
}

#[test]
fn the_error_of_its_means_is_kept_where_that_of_a_chaotic_motion_cannot_be() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let asked = ["--end", "30", "--accuracy", "30%"];
    let (_, err) = said(path, &[&CHAOTIC[..], &asked, &["--out", "one"]].concat(), 1);
    assert!(err.contains("is kept until t = ") && err.contains("initial.scatter"), "{err}");
    let (out, err) = said(path, &[&CHAOTIC[..], &SCATTER, &asked, &["--out", "means"]].concat(), 0);
    assert!(err.contains("accuracy: asked for 3e-1: the part of the step "), "{err}");
    assert!(out.contains("step (%)") && !out.contains("random load"), "{out}");
    let found = summary(&path.join("means"));
    assert_eq!(found["accuracy"]["judged_by"], "realisations");
    assert!(found["accuracy"]["reached"].as_f64().unwrap() <= 0.3, "{}", found["accuracy"]);
}

#[test]
fn a_scatter_that_makes_no_sense_is_refused_at_its_key() {
    let dir = tempfile::tempdir().unwrap();
    for (set, words) in [
        ("initial.scatter.velocity=0", &["initial.scatter.velocity is 0.0", "above 0"][..]),
        ("initial.scatter.velocity=-1e-6", &["initial.scatter.velocity", "above 0"]),
        ("initial.scatter.velocity=inf", &["initial.scatter.velocity", "above 0"]),
        ("initial.scatter.velocity=nan", &["initial.scatter.velocity", "above 0"]),
        ("initial.scatter.seed=1", &["`velocity` is missing"]),
        ("initial.scatter={velocity = 1e-6, seed = 1.5}", &["initial.scatter: seed", "a whole number"]),
        ("initial.scatter={velocity = 1e-6, displacement = 1e-6}", &["displacement"]),
    ] {
        let (_, err) = said(dir.path(), &["run", "rigid-walls-sine", "--set", set], 2);
        assert!(words.iter().all(|word| err.contains(word)), "{set}: {err}");
    }
    assert!(!dir.path().join("out").exists(), "a refused request leaves nothing");
}
