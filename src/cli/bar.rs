//! Progress of work under way, on stderr.

use super::estimate::{DurationEstimate, WorkUnderWay};
use super::terminal::print_message;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

/// After this time a progress bar appears, and a line says how long the work will take.
const PATIENCE: Duration = Duration::from_secs(1);

/// Resolution of a progress bar.
const UNITS: u64 = 10_000;

/// Progress of work; shared between threads by reference. It is removed when it is dropped.
#[derive(Debug)]
pub struct Bar {
    quiet: bool,
    shown: Option<ProgressBar>,
    /// Where the duration of the work is announced.
    announced: Option<WorkUnderWay>,
    started: Instant,
}

impl Bar {
    /// A bar that appears after a second, if stderr is a terminal and `quiet` is not set. Where the
    /// duration of the work can be estimated, a line says then how long it will take, and why.
    #[must_use]
    pub fn new(label: &str, estimate: Option<DurationEstimate>, quiet: bool) -> Self {
        let shown = (!quiet && io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::with_draw_target(Some(UNITS), ProgressDrawTarget::hidden());
            let style = ProgressStyle::with_template("{msg:20} {wide_bar} {percent:>3} % {eta}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar.set_message(label.to_owned());
            bar
        });
        let above = shown.clone();
        let announced = estimate
            .filter(|_| !quiet)
            .map(|estimate| estimate.announce(PATIENCE, move |line| print_above(above.as_ref(), line)));
        Self { quiet, shown, announced, started: Instant::now() }
    }

    /// Sets the share of the work done.
    pub fn set_share(&self, share: f64) {
        if let Some(announced) = &self.announced {
            announced.set_share(share);
        }
        let Some(shown) = &self.shown else { return };
        if shown.is_hidden() && self.started.elapsed() > PATIENCE {
            shown.set_draw_target(ProgressDrawTarget::stderr());
        }
        shown.set_position((share * UNITS as f64) as u64);
    }

    /// Prints a line above the bar, unless quiet.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            print_above(self.shown.as_ref(), text);
        }
    }
}

fn print_above(bar: Option<&ProgressBar>, text: &str) {
    match bar {
        Some(bar) => bar.suspend(|| print_message(text)),
        None => print_message(text),
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        if let Some(shown) = &self.shown {
            shown.finish_and_clear();
        }
    }
}
