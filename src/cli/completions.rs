//! `signorini completions`: completion scripts for shells.

use super::pipeline::Answer;
use clap_complete::Shell;

/// Print completions for a shell
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini completions bash > /etc/bash_completion.d/signorini")]
pub struct Args {
    /// The shell
    shell: Shell,
}

/// Completions for `command`, the whole tool.
pub fn answer(args: &Args, mut command: clap::Command) -> Answer {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "signorini", &mut text);
    let script = String::from_utf8_lossy(&text).into_owned();
    let mut answer = Answer::new(serde_json::json!({ "shell": args.shell.to_string(), "script": script }));
    answer.verbatim(script);
    answer
}
