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
