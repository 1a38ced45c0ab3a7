//! What the tool prints: lines as wide as the terminal, the page to open, what differs and what is
//! left out by name, and what a path should have been.
use std::fs;
use std::path::Path;
use std::process::Command;

/// Runs the tool in `folder`, on a terminal of `width` columns where one is given, and expects the
/// exit code; gives stdout and stderr.
fn on(width: Option<usize>, folder: &Path, args: &[&str], code: i32) -> (String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.args(args).current_dir(folder).env_remove("COLUMNS");
    if let Some(width) = width {
        command.env("COLUMNS", width.to_string());
    }
    let output = command.output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(code), "{args:?}: {err}");
    (out, err)
}

fn said(folder: &Path, args: &[&str], code: i32) -> String {
    on(None, folder, args, code).1
}

/// Messages of a run, and the sentences of `explain`, have the same words on a terminal of any
/// width, and no line has more columns unless a single word has.
#[test]
fn lines_break_between_words() {
    let dir = tempfile::tempdir().unwrap();
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let run = ["run", "rigid-walls-sine", "--end", "0.5", "--no-verdict", "--no-report"];
    let explain = ["explain", "tube-round-supports"];
    let refused = ["run", "rigid-walls-sine", "--scheme", "event", "--step", "1e-3"];
    // The time that a run took differs from run to run.
    let of = |width: Option<usize>| {
        let text = [on(width, dir.path(), &run, 0).1, on(width, dir.path(), &refused, 2).1];
        let timed = |line: &&str| !line.contains("energy balance") && !line.contains(" made ");
        let lines = text.concat();
        lines.lines().filter(timed).collect::<Vec<_>>().join("\n")
    };
    let timed = |text: String| text.split("time of a run").next().unwrap_or_default().to_owned();
    let explained = |width: Option<usize>| timed(on(width, dir.path(), &explain, 0).0);
    let whole = explained(None);
    assert!(whole.lines().any(|line| line.chars().count() > 120));
    of(None);
    for width in [40, 80, 120] {
        assert_eq!(words(&explained(Some(width))), words(&whole), "{width}");
        for text in [of(Some(width)), explained(Some(width))] {
            for line in text.lines() {
                assert!(line.chars().count() <= width || words(line).len() == 1, "{width}: {line:?}");
            }
        }
    }
}
