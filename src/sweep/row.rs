//! One row: its case built, run and measured.

use super::plan::{Plan, Point};
use super::sample::Sample;
use super::watch::Watch;
use crate::case::{Case, KeyValue};
use crate::error::{Error, Result};
use crate::residual::{Finding, Judge};
use crate::scene::{Checked, State};
use crate::scheme::{Method, Scheme, Stepper};
use crate::time::TimeGrid;
use std::fmt;

/// What became of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// It ran to its end.
    Ok,
    /// It ran to its end, but the exact scheme has handed a stretch of impacts to moreau-jean.
    Handed,
    /// Its values make no case.
    Invalid,
    /// The exact scheme met more contact events than it follows.
    TooManyEvents,
    /// Numbers stopped being finite.
    NotFinite,
    /// A step was not solved: the quadratic programme, or Newton's method.
    NotSolved,
    /// The judge found that the scheme did not keep its word.
    Refuted,
    /// It failed in another way.
    Failed,
}

impl Status {
    /// The word in the table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Handed => "handed",
            Self::Invalid => "invalid",
            Self::TooManyEvents => "too-many-events",
            Self::NotFinite => "not-finite",
            Self::NotSolved => "not-solved",
            Self::Refuted => "refuted",
            Self::Failed => "failed",
        }
    }

    /// True for a row with numbers that hold.
    #[must_use]
    pub fn is_good(self) -> bool {
        matches!(self, Self::Ok | Self::Handed)
    }

    fn of(error: &Error) -> Self {
        match error {
            Error::TooManyEvents { .. } => Self::TooManyEvents,
            Error::NotFinite { .. } => Self::NotFinite,
            Error::Qp { .. } | Error::Newton { .. } => Self::NotSolved,
            Error::Refuted { .. } => Self::Refuted,
            error if error.is_request() => Self::Invalid,
            _ => Self::Failed,
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A row of a sweep.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Its number, from 0.
    pub number: u64,
    /// `up` or `down` along a followed axis; none where none is followed.
    pub direction: Option<&'static str>,
    /// What was set, as in the columns of the axes.
    pub values: Vec<KeyValue>,
    /// What became of it.
    pub status: Status,
    /// Why, in a sentence; empty for `ok`.
    pub error: String,
    /// The measures, as in their columns; none where a measure has no value, and in a row that
    /// failed.
    pub measures: Vec<Option<f64>>,
    /// Its instants.
    pub samples: Vec<Sample>,
    /// The state at its end, from which the next row of a followed axis starts; none where it
    /// failed.
    pub end: Option<State>,
}

impl Row {
    /// Says why there is nothing in it.
    pub(super) fn fail(&mut self, error: &Error) {
        self.status = Status::of(error);
        self.error = sentence(error);
    }
}

/// What a run of one row gives.
struct Done {
    measures: Vec<Option<f64>>,
    samples: Vec<Sample>,
    end: State,
    handed: usize,
    findings: Vec<Finding>,
}

impl Plan {
    /// Computes the row of `point`, from the state `start` where it follows another. A row's
    /// numbers depend on nothing else.
    pub(super) fn row(&self, point: &Point, start: Option<&State>) -> Row {
        let mut row = self.blank(point);
        match self.build(point, start).and_then(|(case, method)| self.perform(case, method, self.is_judged(point.row)))
        {
            Ok(done) => {
                (row.measures, row.samples, row.end) = (done.measures, done.samples, Some(done.end));
                if done.handed > 0 {
                    row.status = Status::Handed;
                    row.error = format!("{} stretches of impacts by moreau-jean", done.handed);
                }
                if !done.findings.is_empty() {
                    row.status = Status::Refuted;
                    row.error = done.findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
                }
            }
            Err(error) => row.fail(&error),
        }
        row
    }

    /// The row of `point` before anything is known of it.
    pub(super) fn blank(&self, point: &Point) -> Row {
        let axes = self.sweep.axes.iter().zip(&point.values);
        Row {
            number: point.row,
            direction: point.direction,
            values: axes.flat_map(|(axis, value)| axis.cells(value)).collect(),
            status: Status::Ok,
            error: String::new(),
            measures: vec![None; self.measured()],
            samples: Vec::new(),
            end: None,
        }
    }

    /// How many columns of measures there are.
    pub(super) fn measured(&self) -> usize {
        self.sweep.measures.iter().map(|measure| measure.columns(&self.base.scene).len()).sum()
    }

    fn perform(&self, case: Case, method: Method, judged: bool) -> Result<Done> {
        let scene = &Checked::new(&case.scene)?;
        let mut time = case.time;
        let exact = method.scheme == Scheme::Event;
        // Nothing is recorded: the bound on rows is none of a row's. A spacing that is given stays,
        // since steps end on its rows, as in `run`.
        time.sample = time.sample.or(Some(scene.duration));
        let grid =
            if exact { TimeGrid::exact(scene.duration, &time) } else { TimeGrid::stepping(scene.duration, &time) }?;
        let mut stepper = Stepper::by(scene, method, grid.step)?;
        let start = stepper.state();
        let mut watch = Watch::new(&self.sweep, stepper.scene(), &time, &start)?;
        let mut judge = judged.then(|| {
            let seen = stepper.checked();
            Judge::over(seen.shared(), seen.wall_masses(), stepper.contract(), grid.step, (&start.q, &start.v))
        });
        let mut count = 0;
        loop {
            let step = stepper.step()?;
            watch.see(&step);
            if let Some(judge) = &mut judge {
                judge.see(&step);
            }
            count += 1;
            let ended = if exact { step.end >= scene.duration } else { count == grid.steps };
            if ended {
                break;
            }
        }
        let open = stepper.open_contacts();
        let (measures, samples) = watch.finish(&self.sweep, stepper.checked(), &open);
        Ok(Done {
            measures,
            samples,
            end: stepper.state(),
            handed: stepper.handed().len(),
            findings: judge.map_or_else(Vec::new, |judge| judge.findings()),
        })
    }
}

/// An error in one line: of one that shows a place of the case file, what is wrong and what would
/// do.
fn sentence(error: &Error) -> String {
    let text = error.to_string();
    let told: Vec<&str> = match error {
        Error::Case { .. } => {
            let help = |line: &str| line.split_once("= help: ").map_or("", |(_, help)| help).to_owned();
            let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
            let help = text.lines().map(help).find(|help| !help.is_empty());
            return help.map_or_else(|| first.to_owned(), |help| format!("{first}; {help}"));
        }
        _ => text.lines().map(str::trim).collect(),
    };
    told.join("; ")
}
