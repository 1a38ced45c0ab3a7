//! `signorini completions`: completion scripts for shells.

use super::ui::Ui;
use crate::error::Result;
use clap_complete::Shell;

/// Print completions for a shell
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini completions bash > /etc/bash_completion.d/signorini")]
pub struct Args {
    /// The shell
    shell: Shell,
}

/// Prints completions for `command`, the whole tool.
pub fn execute(args: &Args, mut command: clap::Command, ui: &Ui) -> Result<()> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut command, "signorini", &mut text);
    let script = String::from_utf8_lossy(&text);
    if ui.json() {
        return ui.document(&serde_json::json!({ "shell": args.shell.to_string(), "script": script }));
    }
    ui.answer(&script)
}
