//! Runs of the command-line tool.

use std::path::Path;
use std::process::{Command, Stdio};

/// The tool with `args`, in `folder`, at no width that the terminal of the tests would set.
pub fn command(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    command.args(args).current_dir(folder).env_remove("COLUMNS").stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// What the tool said on stdout and on stderr; the test fails where it ends with another code than
/// `code`, or panics.
pub fn said(folder: &Path, args: &[&str], code: i32) -> (String, String) {
    let output = command(folder, args).output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(code), "{args:?}: {out} {err}");
    assert!(!err.contains("panicked"), "{args:?}: {err}");
    (out, err)
}
