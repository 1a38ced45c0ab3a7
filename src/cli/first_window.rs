//! The first window of the histories of wear: the case in its own gaps, whose motion is kept.

use super::estimate::DurationEstimate;
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::output::Span;
use crate::output::results::Results;
use crate::output::run::{self as output, Picture};
use crate::output::shape::{self, Shape};
use crate::output::summary::{Checks, Reasons};
use crate::output::wear_folder::FIRST_WINDOW;
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::Method;
use crate::study::choice;

/// Runs the first window of the first history by `method`, and writes its files into a folder of
/// their own in `results`; with a `report` also the shape of the structure over time. `reason` says
/// why this method.
pub(super) fn first_window(
    case: &Case,
    (method, reason): (&Method, String),
    results: &mut Results,
    report: bool,
    ui: &Ui,
) -> Result<Run> {
    let estimate = DurationEstimate::of_run(&case.scene, method, case.time.step);
    let (end, options) = (case.scene.duration, Options::new(case.time));
    let shape = if report { Shape::of(case) } else { Shape::default() };
    let mut run = ui.with_estimate("first window", estimate, |bar| {
        run_with_progress(&shape.watched(case), method, &options, &mut |time| bar.set_share(time / end))
    })?;
    let moved = shape.take(&mut run);
    if !shape.is_empty() {
        let place = results.place(&format!("{FIRST_WINDOW}/{}", shape::FILE))?;
        shape.write(&place, run.trajectory.time(), &moved)?;
    }
    let reasons = Reasons { scheme: reason, qp: choice::qp_reason(method, &case.scene) };
    let picture = Picture { span: Span { from: 0.0, to: end }, look: 0 };
    output::write(results, FIRST_WINDOW, case, &run, method, (&reasons, Checks::default()), picture)?;
    Ok(run)
}
