//! What the tool says of a run's accuracy and of its schemes: with units, and only what was seen.
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs the tool in `folder` and expects the exit code; gives stdout and stderr.
fn said(folder: &Path, args: &[&str], code: i32) -> (String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_signorini")).args(args).current_dir(folder).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(code), "{args:?}: {err}");
    (out, err)
}

fn line<'a>(text: &'a str, begins: &str) -> &'a str {
    text.lines().find(|line| line.starts_with(begins)).unwrap_or_else(|| panic!("{begins}: {text}"))
}

fn summary(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("summary.json")).unwrap()).unwrap()
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
