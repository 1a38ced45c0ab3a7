//! `[statistics]`: joined episodes and spectra of a run, in files, summary and on the terminal.
use crate::command::said;
use crate::shaken::square_of_bars;
use crate::table::summary;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The columns of a CSV file of numbers, under its header.
fn columns(path: &Path) -> (String, Vec<Vec<f64>>) {
    let text = fs::read_to_string(path).unwrap();
    let (header, rows) = text.split_once('\n').unwrap();
    let mut columns = vec![Vec::new(); header.split(',').count()];
    for line in rows.lines() {
        columns.iter_mut().zip(line.split(',')).for_each(|(column, cell)| column.push(cell.parse().unwrap()));
    }
    (header.to_owned(), columns)
}

/// A body that is pressed into a spring stop and shaken without leaving it.
const PRESSED: &str = r#"
[system.oscillator]
mass = 1.0
damping = 20.0
stiffness = 100.0

[[wall]]
name = "stop"
side = "upper"
position = 0.0
stiffness = 4000.0

[[load]]
constant = { force = 40.0 }

[[load]]
random = { rms = 3.0, from = 1.0, to = 30.0, seed = 5 }

[initial]
displacement = 9.75609756e-3

[time]
end = 20.0
step = 1e-3
sample = 5e-3
force_averaging = 5e-3
"#;

/// Ten seconds in the square, with spectra.
fn square() -> String {
    let time = "[time]\nend = 10.0\nstep = 1e-3\nstatistics_from = 1.0\n";
    square_of_bars("", &format!("{time}\n[statistics]\nrest = 0.01\nspectra = true\n"))
}

#[test]
fn the_force_of_a_spring_has_the_spectrum_of_its_displacement() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("pressed.toml"), format!("{PRESSED}\n[statistics]\nspectra = true\n")).unwrap();
    let (out, err) = said(dir.path(), &["run", "pressed.toml", "--no-verdict", "--out", "out"], 0);
    assert!(out.contains("episodes") && err.contains("episodes are single contacts"), "{out}{err}");
    let path = dir.path().join("out");
    let (header, displacement) = columns(&path.join("spectrum-displacement.csv"));
    assert_eq!(header, "frequency_Hz,displacement_m2_per_Hz");
    let (header, force) = columns(&path.join("spectrum-stop.csv"));
    assert_eq!(header, "frequency_Hz,contact_force_N2_per_Hz");
    assert_eq!(displacement[0], force[0]);
    // Averaging over w = 5 ms multiplies by sinc²(f w). The averages lie half a row before the
    // rows, which moves the segments against each other: a thousandth of their length of 512.
    let mut compared = 0;
    for (i, &f) in force[0].iter().enumerate().filter(|(_, f)| (1.5..29.5).contains(*f)) {
        let x = std::f64::consts::PI * f * 5e-3;
        let expected = 4000.0 * 4000.0 * displacement[1][i] * (x.sin() / x).powi(2);
        assert!((force[1][i] / expected - 1.0).abs() < 0.02, "{f} Hz: {} instead of {expected}", force[1][i]);
        compared += 1;
    }
    assert!(compared > 60, "{compared}");
    for name in ["displacement-spectrum.svg", "contact-force-spectrum.svg", "episodes.csv", "exceedances.csv"] {
        assert!(path.join(name).exists(), "{name}");
    }
    let summary = summary(&path);
    let spectra = summary["spectra"].as_array().unwrap();
    let stop = spectra.iter().find(|one| one["file"] == "spectrum-stop").unwrap();
    assert_eq!((&stop["quantity"], &stop["averaged_over_s"]), (&"contact_force".into(), &5e-3.into()));
    assert_eq!(stop["segments"], 14);
    // One contact, which never ends.
    let one = &summary["episodes"]["places"][0];
    assert_eq!((&one["place"], &one["episodes"]), (&"stop".into(), &1.into()));
    assert_eq!(one["impulse_n_s"]["max"], summary["statistics"]["walls"][0]["episode_impulse_n_s"]["max"]);
    assert_eq!(one["peak_force_n"]["max"], summary["statistics"]["walls"][0]["episode_peak_force_n"]["max"]);
}

#[test]
fn a_support_has_episodes_and_spectra_of_its_own() {
    let square = square();
    let round = square.replace("shape = \"flats\"\nsides = 4", "shape = \"round\"\nfriction = 0.2");
    // Friction of 0.8 is up to 0.8²/(1 + 0.8²) = 39 % of the mean square.
    let rough = square.replace("shape = \"flats\"", "shape = \"flats\"\nfriction = 0.8");
    for (case, flats) in [(&square, 4), (&rough, 4), (&round, 0)] {
        support(case, flats);
    }
}

#[test]
fn the_spectrum_of_a_slider_holds_the_friction_that_reverses() {
    let dir = tempfile::tempdir().unwrap();
    let case = include_str!("../../cases/dry-friction-damper.toml");
    let case = format!("{case}force_averaging = 5.026548245743669e-4\n\n[statistics]\nspectra = true\n");
    fs::write(dir.path().join("pad.toml"), case).unwrap();
    said(dir.path(), &["run", "pad.toml", "--no-verdict", "--out", "out"], 0);
    let (header, spectrum) = columns(&dir.path().join("out/spectrum-pad.csv"));
    assert_eq!(header, "frequency_Hz,contact_force_y_N2_per_Hz,contact_force_z_N2_per_Hz");
    // The pad slides all the time (Den Hartog 1931), with ±μN = ±2 N: the variance is 4 N². In two
    // rows of a hundred the force reverses, and their means may be anything between: 2 %.
    let [along, normal] = [1, 2].map(|column| spectrum[column].iter().sum::<f64>() * spectrum[0][1]);
    assert!((along / 4.0 - 1.0).abs() < 0.02, "{along}");
    // The normal force is constant: only rounding varies.
    assert!(normal < 1e-20, "{normal}");
}

/// Runs `case`, which has one support of so many `flats`; a round one has none.
fn support(case: &str, flats: usize) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("square.toml"), case).unwrap();
    let (out, err) = said(path, &["run", "square.toml", "--no-verdict", "--out", "out"], 0);
    assert!(out.contains("99 %") && err.contains("less than 1e-2 s apart are one episode"), "{out}{err}");
    let results = summary(&path.join("out"));
    let places = results["episodes"]["places"].as_array().unwrap();
    assert_eq!(places.len(), flats + 1);
    let bars = &places[flats];
    assert_eq!((&bars["place"], &bars["kind"]), (&"bars".into(), &"support".into()));
    // Its episodes hold the whole impulse: Σ|p| = mean force times the window, but for an episode
    // that reaches over the window's start, one of dozens.
    let force = &results["statistics"]["supports"][0]["force"];
    let number = |value: &Value| value.as_f64().unwrap();
    let count = number(&bars["episodes"]);
    let sum = number(&bars["impulse_n_s"]["mean"]) * count;
    assert!(count > 20.0 && (sum / (9.0 * number(&force["mean_n"])) - 1.0).abs() < 0.05, "{bars}");
    // Joined, they are fewer than the contacts of the flats.
    let walls = results["statistics"]["walls"].as_array().unwrap();
    let contacts: f64 = walls.iter().map(|wall| number(&wall["contacts"])).sum();
    let all = number(&results["statistics"]["supports"][0]["contacts"]);
    assert!(count < all && (flats == 0 || all == contacts), "{count} of {all}, {contacts}");
    let counts = bars["impulse_n_s"]["exceedances"].as_array().unwrap();
    assert!(counts.len() == 20 && counts.windows(2).all(|pair| number(&pair[0]) >= number(&pair[1])));
    let rows = fs::read_to_string(path.join("out/exceedances.csv")).unwrap();
    assert_eq!(rows.lines().filter(|line| line.starts_with("bars,support,impulse,N_s,")).count(), 20);
    assert!(!rows.contains("peak_force"), "rigid flats have no peak force");

    // The spectra of both components hold the mean square that the statistics have: Welch weights
    // the ends of the window less, a few per cent of which are the difference.
    let (header, spectrum) = columns(&path.join("out/spectrum-bars.csv"));
    assert_eq!(header, "frequency_Hz,contact_force_y_N2_per_Hz,contact_force_z_N2_per_Hz");
    let power = (spectrum[1].iter().sum::<f64>() + spectrum[2].iter().sum::<f64>()) * spectrum[0][1];
    let mean: f64 = force["mean_vector_n"].as_array().unwrap().iter().map(|x| number(x).powi(2)).sum();
    let square = number(&force["rms_n"]).powi(2);
    assert!(((power + mean) / square - 1.0).abs() < 0.15, "{} {square}", power + mean);
    assert!(!path.join("out/spectrum-bars-flat-1.csv").exists(), "the support has the spectrum of its flats");

    // The summary repeats the run, and another rest is another request.
    said(path, &["run", "out/summary.json", "--no-verdict", "--out", "again"], 0);
    assert_eq!(summary(&path.join("again"))["episodes"], results["episodes"]);
    let args = ["run", "square.toml", "--no-verdict", "--out", "out", "--set", "statistics.rest=0.02"];
    let (_, err) = said(path, &args, 2);
    assert!(err.contains("rest_s: 0.01 there, 0.02 asked"), "{err}");
}

#[test]
fn what_is_not_asked_for_is_not_there() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("pressed.toml"), PRESSED).unwrap();
    said(path, &["run", "pressed.toml", "--no-verdict", "--no-report", "--out", "out"], 0);
    let mut names: Vec<String> =
        fs::read_dir(path.join("out")).unwrap().map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    let figures = ["contact-force.svg", "displacement.svg", "phase.svg", "velocity.svg"];
    let mut expected = [&figures[..], &["contacts.csv", "request.json", "summary.json", "trajectory.csv"]].concat();
    expected.sort_unstable();
    assert_eq!(names, expected);
    let summary = summary(&path.join("out"));
    assert!(summary.get("episodes").is_none() && summary.get("spectra").is_none());
    assert!(summary["case_file"].get("statistics").is_none());
}

#[test]
fn a_window_that_begins_too_early_is_told_with_where_it_should_begin() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/src/verification/scenes/sdnd104.toml");
    let dir = tempfile::tempdir().unwrap();
    // SDND104 of code_aster at 15 m/s²: from the start the work rate is 16.10 W, where 15.27 W are
    // published for its periodic motion. At 1.5 m/s² it has settled by 4 s.
    for (acceleration, from, said_so) in [("15", "0", true), ("1.5", "4", false)] {
        let amplitude = format!("load.1.harmonic.amplitude={acceleration}");
        let window = format!("time.statistics_from={from}");
        let asked = ["run", scene, "--step", "1e-3", "--no-verdict", "--set", &amplitude, "--set", &window];
        let (_, err) = said(dir.path(), &[&asked[..], &["--out", from]].concat(), 0);
        assert_eq!(err.contains("note: still settling: the work rate of support \"flat\" is "), said_so, "{err}");
        assert_eq!(err.contains("begin the statistics at t = "), said_so, "{err}");
    }
}
