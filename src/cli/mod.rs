//! The command-line tool: parse, call, print. One file per command; `pipeline` has what all of
//! them share.
//!
//! # Files
//!
//! Parses, calls, prints: one file per command (`run/`, `compare.rs` with `compare_seeds.rs` and
//! `verdicts.rs`, `chart.rs`, `stability.rs`, `wear.rs`, `sweep/`, `merge.rs`, `orbit/`,
//! `continuation/`, `report.rs`, `explain/`, `new/`, `figures.rs`, `verify.rs`, `completions.rs`),
//! `case_args.rs`, `request.rs`, `formats.rs`, `derivative_keys.rs` and `drawing.rs` for arguments
//! that several have, `command_line.rs` for lines as a shell takes them, `pipeline.rs` for what all
//! commands share (the folder of results, the report, what is printed), `ui.rs` for stdout and
//! stderr (`bar.rs` shows progress, `terminal.rs` breaks lines), `estimate.rs` says how long work
//! will take (`run_time.rs` tries a run for that), `realisations.rs` makes the study of
//! realisations of `run` and `wear`, `values.rs` lists the values that shells complete (feature
//! `cli`).

mod bar;
mod case_args;
mod chart;
mod command_line;
mod compare;
mod compare_seeds;
mod completions;
mod continuation;
mod derivative_keys;
mod drawing;
mod estimate;
mod explain;
mod figures;
mod formats;
mod merge;
mod new;
mod orbit;
mod pipeline;
mod realisations;
mod report;
mod request;
mod run;
mod run_time;
mod stability;
mod sweep;
mod terminal;
mod ui;
mod values;
mod verdicts;
mod verify;
mod wear;

use crate::error::Result;
use clap::{Parser, Subcommand};
use std::process::ExitCode;
use ui::Ui;

pub use ui::Stdout;

const EXAMPLES: &str = "\
Examples:
  signorini compare cases/rigid-walls-sine.toml      the constrained QP against the penalty, side by side
  signorini run rigid-walls-sine --restitution 0.8   one run of a built-in case
  signorini run elastic-wall --end 4 --accuracy 1e-6   an error by name instead of a step
  signorini chart rigid-walls-sine --end 1           accuracy against speed
  signorini stability bouncing-ball                  where each scheme fails
  signorini sweep rigid-walls-sine --vary load.1.harmonic.frequency=1:10:91 --measure contacts    curves and maps
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8'   a periodic orbit and its multipliers
  signorini continue rigid-walls-sine --set 'wall.*.restitution=0.8' --key load.1.harmonic.frequency --range 1:16
  signorini wear tube-in-cross-flow --years 40       depth over the years, with its interval
  signorini explain elastic-wall                     what would be chosen, and why
  signorini new bouncing-ball                        a case file to start from
  signorini report out/rigid-walls-sine/run          one HTML page of results that exist
  signorini verify                                   published values and closed forms, on this machine

Results go to out/CASE/COMMAND or --out DIR; those of another request are replaced with --force only.
Beside them report.html shows them all: one file that opens without network; --no-report leaves it out.
A name stands for the file of that name, then for NAME.toml, then for the built-in case.

Exit codes: 0 done, 1 the run failed or its answer could not be written, 2 the request was wrong.";

/// Vibrating structures between walls: contact forces by one convex QP per time step, by penalty,
/// and exactly.
#[derive(Debug, Parser)]
#[command(name = "signorini", version, about, after_help = EXAMPLES, arg_required_else_help = true)]
struct Cli {
    /// Print only errors and results
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Print one JSON document instead of tables and text
    #[arg(long, global = true)]
    json: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Args),
    Chart(chart::Args),
    Compare(compare::Args),
    #[command(name = "continue")]
    Continue(continuation::Args),
    Explain(explain::Args),
    Figures(figures::Args),
    Merge(merge::Args),
    New(new::Args),
    Orbit(orbit::Args),
    Report(report::Args),
    Stability(stability::Args),
    Sweep(sweep::Args),
    Verify(verify::Args),
    Wear(wear::Args),
    Completions(completions::Args),
}

/// Runs the tool on the process's arguments: data to stdout, messages to stderr. If stderr is
/// closed, messages are dropped and nothing else changes; if stdout is closed, the command fails.
#[must_use]
pub fn main(stdout: Stdout) -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(text) => {
            // What was asked for is not known, since the words could not be read.
            if text.use_stderr() && std::env::args_os().skip(1).any(|word| word == "--json") {
                Ui::new(true, true, stdout).refused(&text);
            }
            return answer(&text, stdout);
        }
    };
    let ui = Ui::new(cli.quiet, cli.json, stdout);
    match execute(&cli.command, &ui) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            ui.error(&error);
            ExitCode::from(if error.is_request() { 2 } else { 1 })
        }
    }
}

/// Prints clap's text and exits as the tool does: 0 after --help and --version, 2 after a wrong
/// request, 1 if the text cannot be written. A reader that closes a pipe early is not an error.
fn answer(text: &clap::Error, stdout: Stdout) -> ExitCode {
    let printed = if text.use_stderr() { text.print() } else { stdout.check().and_then(|()| text.print()) };
    match printed {
        Err(error) if !text.use_stderr() && error.kind() != std::io::ErrorKind::BrokenPipe => {
            Ui::new(false, false, stdout).error(&ui::unwritable(&error));
            ExitCode::FAILURE
        }
        _ => ExitCode::from(u8::try_from(text.exit_code()).unwrap_or(2)),
    }
}

fn execute(command: &Command, ui: &Ui) -> Result<()> {
    let answer = match command {
        Command::Run(args) => run::answer(args, ui)?,
        Command::Chart(args) => chart::answer(args, ui)?,
        Command::Compare(args) => compare::answer(args, ui)?,
        Command::Explain(args) => explain::answer(args, ui)?,
        Command::Figures(args) => figures::answer(args, ui)?,
        Command::Merge(args) => merge::answer(args)?,
        Command::Orbit(args) => orbit::answer(args, ui)?,
        Command::Continue(args) => continuation::answer(args, ui)?,
        Command::New(args) => new::answer(args)?,
        Command::Report(args) => report::answer(args)?,
        Command::Stability(args) => stability::answer(args, ui)?,
        Command::Sweep(args) => sweep::answer(args, ui)?,
        Command::Verify(args) => verify::answer(args, ui)?,
        Command::Wear(args) => wear::answer(args, ui)?,
        Command::Completions(args) => completions::answer(args, self::command()),
    };
    answer.conclude(ui)
}

/// The tool's command, for shell completions and tests.
#[must_use]
pub fn command() -> clap::Command {
    <Cli as clap::CommandFactory>::command()
}

#[cfg(test)]
mod tests {
    use super::{Cli, Stdout, Ui, execute};
    use crate::linear::counted as factored;
    use crate::scene::counted as checked;
    use clap::Parser;

    /// Number of times that `signorini run CASE --scheme moreau-jean --no-verdict` checks a scene,
    /// and the sizes of the matrices that it factors.
    fn counted(case: &str) -> (usize, Vec<usize>) {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out").display().to_string();
        let line = format!("signorini run {case} --scheme moreau-jean --no-verdict --end 0.01 --quiet --out {out}");
        let cli = Cli::try_parse_from(line.split(' ')).unwrap();
        checked::take();
        factored::take();
        execute(&cli.command, &Ui::new(true, false, Stdout::Open)).unwrap();
        (checked::take(), factored::take())
    }

    /// Each matrix is factored once, however many users it has: M, C and K where the scene is
    /// checked, K + σM for the slowest frequency, and the matrix of a step. A scene is checked
    /// where it is read, where the command line has changed it, and where it is run.
    #[test]
    fn a_run_checks_its_scene_and_factors_its_matrices_once() {
        assert_eq!(counted("chain-200"), (2, vec![200; 5]));
        // The whole tube: M, C and K; two factors to find its modes, and one for the static
        // remainder. The reduced scene, whose matrices are diagonal: M and K, and the matrix of a
        // step twice, once to estimate how long the run will take.
        let [whole, modes] = [vec![120; 6], vec![20; 4]];
        assert_eq!(counted("tube-loose-supports"), (4, [whole, modes].concat()));
    }
}
