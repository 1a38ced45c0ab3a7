//! What the tool says of a run's accuracy and of its schemes: with units, and only what was seen.
use crate::command::said;
use crate::table::summary;
use std::fs;
use std::process::Command;

fn line<'a>(text: &'a str, begins: &str) -> &'a str {
    text.lines().find(|line| line.starts_with(begins)).unwrap_or_else(|| panic!("{begins}: {text}"))
}

#[test]
fn a_displacement_is_a_share_of_the_gap_only_where_there_is_one() {
    let dir = tempfile::tempdir().unwrap();
    let run = |case: &str| said(dir.path(), &["run", case, "--end", "0.5", "--no-report"], 0).1;
    let free = run("linear-sine");
    let words = line(&free, "refinement: ");
    assert!(!words.contains("gap") && words.contains(" m up to t = 0.5000 s"), "{words}");
    let struck = run("rigid-walls-sine");
    let words = line(&struck, "refinement: ");
    assert!(words.contains(" of the gap up to t = 0.5000 s"), "{words}");
    assert!(words.contains(" of its value, ") || words.contains("impulse unchanged"), "{words}");
}

/// At e = 1 a change of the start has grown 1000-fold at 2.6 s; the first row is recorded at 10 s.
#[test]
fn a_displacement_that_was_not_compared_is_not_called_unchanged() {
    let dir = tempfile::tempdir().unwrap();
    let own = ["run", "rigid-walls-sine", "--restitution", "1", "--end", "10", "--sample", "10", "--out", "out"];
    let (_, err) = said(dir.path(), &own, 0);
    let words = line(&err, "refinement: ");
    assert!(words.contains("the displacement was not compared: beyond t = 2.6"), "{words}");
    let summary = summary(&dir.path().join("out"));
    assert!(summary["refinement"]["displacement"].is_null() && summary["refinement"]["length_m"] == 5e-3);
    let page = fs::read_to_string(dir.path().join("out/report.html")).unwrap();
    assert!(page.contains("the displacement was not compared"));
}

/// Beyond its stability limit the run ends at 0.11 s, and that with half the step at 0.1 s.
#[test]
fn a_run_that_diverged_is_compared_up_to_its_last_row() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 100.0\n[[wall]]\nname = \"u\"\n\
        side = \"both\"\ngap = 5e-3\n[[load]]\nharmonic = { amplitude = 3.0, frequency = 5.0 }\n\
        [time]\nend = 10.0\nstep = 1e-2\n[penalty]\nstiffness = [1e7]\n";
    fs::write(dir.path().join("steep.toml"), case).unwrap();
    let own = ["run", "steep.toml", "--scheme", "penalty", "--integrator", "central-difference", "--no-report"];
    let (_, err) = said(dir.path(), &own, 1);
    let words = line(&err, "refinement: ");
    assert!(words.contains(" up to t = 0.1000 s;"), "{words}");
}

/// A spring of the wall that keeps energy: the power arrived less that departed is its rounding,
/// −3e-19 W. Where a load pushes the body off, it is negative, and said.
#[test]
fn rounding_is_no_work_done_on_the_body() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 100.0\n[[wall]]\nname = \"pad\"\n\
        side = \"upper\"\nposition = -1e-3\nstiffness = 1e3\ndamping = 0.0\n\
        [initial]\ndisplacement = -2e-3\nvelocity = 0.05\n[time]\nend = 3.0\nstep = 1e-3\n";
    fs::write(dir.path().join("pad.toml"), case).unwrap();
    let run = |case: &str, out: &str| {
        let own = ["run", case, "--scheme", "event", "--end", "3", "--no-verdict", "--no-report", "--out", out];
        let err = said(dir.path(), &own, 0).1;
        let power = summary(&dir.path().join(out))["statistics"]["walls"][0]["arrived_less_departed_power_w"].as_f64();
        (power.unwrap(), err.contains("arrived - left is negative"))
    };
    let (power, told) = run("pad.toml", "pad");
    assert!(power.abs() < 1e-15 && !told, "{power:e}");
    let (power, told) = run("elastic-wall", "driven");
    assert!(power < -1e-3 && told, "{power:e}");
}

#[test]
fn explain_recommends_no_scheme_that_refuses_the_scene() {
    let dir = tempfile::tempdir().unwrap();
    let flats = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n\
        [[support]]\nname = \"a\"\nshape = \"flats\"\nsides = 4\ngap = 1e-3\nfriction = 0.3\nrestitution = 0.5\n\
        [[load]]\ndirection = 20\nharmonic = { amplitude = 20.0, frequency = 3.0 }\n\
        [[load]]\ndirection = 0\nconstant = { force = 5.0 }\n[penalty]\nstiffness = [1e6]\n\
        [time]\nend = 0.05\nstep = 1e-3\n";
    fs::write(dir.path().join("flats.toml"), flats).unwrap();
    fs::write(dir.path().join("smooth.toml"), flats.replace("friction = 0.3\n", "")).unwrap();
    let round = "shape = \"round\"";
    fs::write(dir.path().join("round.toml"), flats.replace("shape = \"flats\"\nsides = 4", round)).unwrap();
    let hole = flats.replace("shape = \"flats\"\nsides = 4", round).replace("friction = 0.3\n", "");
    fs::write(dir.path().join("hole.toml"), hole).unwrap();
    let schemes = ["moreau-jean", "generalized-alpha", "implicit-euler", "event", "paoli-schatzman", "newmark"];
    for case in ["flats.toml", "smooth.toml", "round.toml", "hole.toml"] {
        let explained = said(dir.path(), &["explain", case], 0).0;
        let refused = explained.lines().find(|line| line.trim_start().starts_with("refused here: ")).unwrap_or("");
        let others: String = explained.lines().filter(|line| *line != refused).collect::<Vec<_>>().join("\n");
        for scheme in schemes {
            let run = ["run", case, "--scheme", scheme, "--no-verdict", "--no-report", "--force", "--out", "out"];
            let run = Command::new(env!("CARGO_BIN_EXE_signorini")).args(run).current_dir(dir.path()).output().unwrap();
            let refuses = run.status.code() == Some(2);
            assert_eq!(refused.contains(scheme), refuses, "{case}, {scheme}: {refused}");
            assert!(!refuses || !others.contains(scheme), "{case}, {scheme}: {others}");
        }
        let penalised = explained.contains("penalty, for comparison");
        assert_eq!(penalised, case != "flats.toml" && case != "round.toml", "{case}: {explained}");
    }
}

/// The wall of the tube is 1.65 mm. Ten years with a coefficient of 1e-11/Pa take more off than
/// that, those with 1e-14/Pa do not.
#[test]
fn a_scar_through_the_wall_of_the_tube_is_a_warning_with_its_numbers() {
    let dir = tempfile::tempdir().unwrap();
    let run = |coefficient: &str, out: &str| {
        let set = format!("wear.coefficient={coefficient}");
        let own = ["run", "tube-round-supports", "--end", "0.5", "--no-verdict", "--no-report", "--set", &set];
        said(dir.path(), &[&own[..], &["--out", out]].concat(), 0).1
    };
    let (deep, shallow) = (run("1e-11", "deep"), run("1e-14", "shallow"));
    let told = line(&deep, "note: the scar at support ");
    assert!(told.contains("goes through the tube, whose wall is 1.650 mm: "), "{told}");
    assert!(!shallow.contains("goes through the tube"), "{shallow}");
    let notes = summary(&dir.path().join("deep"))["notes"].to_string();
    assert!(notes.contains("whose wall is 1.650 mm"), "{notes}");
}

#[test]
fn a_step_that_no_scheme_of_the_request_takes_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let expected = "--step is 0.001; expected a request with a scheme that has a step in it";
    for args in [
        &["run", "rigid-walls-sine", "--scheme", "event", "--step", "1e-3"][..],
        &["compare", "rigid-walls-sine", "--schemes", "event", "--step", "1e-3"],
    ] {
        let err = said(dir.path(), args, 2).1;
        assert!(err.contains(expected), "{args:?}: {err}");
    }
    let both = ["compare", "rigid-walls-sine", "--schemes", "event,moreau-jean", "--step", "1e-3", "--end", "0.2"];
    said(dir.path(), &both, 0);
}

/// A slider's normal impulse is given, 10 N times the duration: it is neither a share to compare
/// with nor a contact. The impulses of both walls are the same to 2 %, so that the larger change as
/// the terminal has it, over its wall's, and as the page has it, over the largest, agree to two
/// digits.
#[test]
fn the_card_of_a_run_with_a_slider_has_the_change_of_the_terminal() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 1e4\n[[slider]]\nname = \"pad\"\n\
        normal_force = 10.0\nfriction = { static = 0.3, kinetic = 0.2 }\n[[load]]\n\
        harmonic = { amplitude = 10.0, frequency = 17.0 }\n[initial]\nvelocity = 0.2\n[time]\nend = 0.5\n\
        step = 2e-4\n";
    let wall = "[[wall]]\nname = \"w\"\nside = \"both\"\ngap = 0.6e-3\nrestitution = 0.6\n";
    let card = |name: &str, case: &str| {
        fs::write(dir.path().join(format!("{name}.toml")), case).unwrap();
        let case = format!("{name}.toml");
        let (_, err) = said(dir.path(), &["run", &case, "--scheme", "moreau-jean", "--out", name], 0);
        let page = fs::read_to_string(dir.path().join(name).join("report.html")).unwrap();
        (line(&err, "refinement: ").to_owned(), page)
    };
    let (words, page) = card("both", &format!("{case}{wall}"));
    assert!(
        words.contains("wall \"w-lower\": impulse -1.1e-2 of its value") && !words.contains("\"pad\": imp"),
        "{words}"
    );
    assert!(page.contains("impulses: by up to 1.1"));
    let summary = summary(&dir.path().join("both"));
    assert_eq!(summary["refinement"]["walls"].as_array().unwrap().len(), 2);
    // Of a slider alone the work rate is what changes.
    let (words, page) = card("alone", case);
    let share = words.split("work rate of support \"pad\" ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    let share = 100.0 * share.parse::<f64>().unwrap().abs();
    let told = page.split("work rates: by up to ").nth(1).and_then(|rest| rest.split(' ').next());
    let told: f64 = told.unwrap().replace('−', "-").parse().unwrap();
    // Two digits there, three here.
    assert!((told / share - 1.0).abs() < 0.06, "{told} {share}");
}
