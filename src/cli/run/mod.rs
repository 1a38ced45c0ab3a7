//! `signorini run`: one case, one method.

mod accurate;
mod args;
mod checked;
mod derivative;
mod means;
mod seeds;

pub use args::Args;
pub(super) use seeds::{Seeds, checked as checked_seeds};

use super::pipeline::Answer;
use super::realisations::{self, StudyRequest};
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::output::animation;
use crate::output::episodes::Episodes;
use crate::output::run as output;
use crate::output::run_folder;
use crate::output::summary::Checks;
use crate::output::supports;
use crate::run::{Run, notes};
use crate::scene::Scene;
use crate::scheme::{Integrator, Method, PenaltyLaw, Scheme};
use crate::study::realisations::RealisationStudy;
use accurate::Searched;
use args::Of;
use checked::CheckedRun;
use serde_json::json;
use std::fmt::Display;

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.request.read(ui)?;
    // A stretch outside the run is refused before anything runs.
    let span = args.span.within(&case, case.scene.duration)?;
    let derivatives = args.derivatives.wanted(args.scheme.as_deref(), &case)?;
    let (checked, study) = made(args, case, ui)?;
    let CheckedRun { case, mut results, method, reason, run, refinement, truncation, modes, accuracy, shortfall } =
        checked;
    if let Some(study) = &study {
        run_folder::write_study(&mut results, &case, study)?;
    }
    let unchecked = [failed("half the step", refinement.as_ref()), failed("more modes", truncation.as_ref())];
    let shortfall = first_shortfall(shortfall, study.as_ref(), unchecked);
    let derivatives = match derivatives {
        Some(wanted) => wanted.write(&case, &mut results).map(|found| Some((wanted, found)))?,
        None => None,
    };
    let first = format!("{method}: {reason}");
    let changes = derivatives.as_ref().map(|(wanted, found)| wanted.document(&case, found));
    let checks = Checks {
        refinement: succeeded(refinement.as_ref()),
        truncation: succeeded(truncation.as_ref()),
        modes: succeeded(modes.as_ref()),
        accuracy: succeeded(accuracy.as_ref()),
        derivatives: changes.as_ref(),
        realisations: study.as_ref().map(|study| &study.realisations),
        ..Checks::default()
    };
    // Last, since the summary records the tables beside it.
    let mut document = run_folder::write(&mut results, "", &case, (&run, &method, reason), checks, span)?;
    if let Some(error) = &shortfall {
        document["error"] = json!(error.to_string());
    }
    let undrawn = animation::refused(&case).filter(|_| !args.request.place.no_report);
    if let Some(reason) = &undrawn {
        document["not_drawn"] = json!(reason);
    }
    let mut answer = Answer::of(results, !args.request.place.no_report, document);
    answer.messages([first].into_iter().chain(undrawn));
    let several = study.as_ref().map(|study| study.realisations.count).filter(|count| *count > 1);
    several.iter().for_each(|count| answer.prose(format!("realisation 1 of {count}:")));
    show(&mut answer, &case, &run, &method)?;
    if let Some((wanted, found)) = &derivatives {
        wanted.show(&mut answer, &case, found);
    }
    several.iter().for_each(|count| answer.prose(format!("means over {count} realisations:")));
    study.iter().for_each(|study| seeds::show(study, &mut answer, &case));
    let [refinement, truncation] =
        [checked_line("refinement", refinement.as_ref()), checked_line("truncation", truncation.as_ref())];
    let [modes, accuracy] = [checked_line("modes", modes.as_ref()), checked_line("accuracy", accuracy.as_ref())];
    let limits = refinement.as_ref().map(|_| refinement_limits(&method, &case.scene, run.grid.step));
    answer.messages(refinement.into_iter().chain(limits.into_iter().flatten()));
    answer.messages([truncation, modes, accuracy].into_iter().flatten());
    if shortfall.is_some() {
        answer.close_with(", kept in spite of the error below");
    }
    answer.fall_short(shortfall);
    Ok(answer)
}

/// What half the step does not show of the error of `method` in steps of `step` seconds.
fn refinement_limits(method: &Method, scene: &Scene, step: f64) -> Vec<String> {
    let entry = method.scheme.entry();
    let error = if scene.dashpot_wall().is_some() {
        "at a wall with a dashpot its error depends on where its steps meet the wall, and half the step may change far \
         less; located divides its steps there"
    } else {
        "its error is about twice what half the step changes, and more where changes of many impacts cancel"
    };
    let first_order = (entry.order == Some(1) && !meets_springs_alone(method, scene))
        .then(|| format!("{} is of order 1: {error}", entry.name));
    let misses = notes::misses_a_load(scene, &method.scheme, step).then(|| {
        "the step misses part of a load, see the notes: half the step may miss the same, so that the change above is \
         no error of the run; a smaller step, or --accuracy, finds it"
            .to_owned()
    });
    first_order.into_iter().chain(misses).collect()
}

/// True where the `method` is of order 2, since all walls are springs to it whose force does not
/// jump.
fn meets_springs_alone(method: &Method, scene: &Scene) -> bool {
    let springs = match method.scheme {
        Scheme::MoreauJean { theta } => theta == 0.5 && !scene.walls.iter().any(|wall| wall.law.is_rigid()),
        Scheme::Penalty { law: PenaltyLaw::Linear { damping, .. }, .. } if damping > 0.0 => false,
        Scheme::Penalty { integrator, .. } => integrator != Integrator::ImplicitEuler,
        _ => false,
    };
    springs && scene.dashpot_wall().is_none() && !scene.turns_or_rubs()
}

/// The run, and the study of realisations where one is wanted.
fn made(args: &Args, case: Case, ui: &Ui) -> Result<(CheckedRun, Option<RealisationStudy>)> {
    let tolerance = args.accuracy()?;
    if let Some(tolerance) = tolerance {
        return accurate(args, case, tolerance, ui);
    }
    let wanted = args.seeds.check(&case)?;
    let made = checked::checked(args, case, ui)?;
    let asked = wanted.map(|count| StudyRequest::new(count, !args.no_verdict));
    let study = asked.map(|asked| realisations::study(&made.case, (&made.run, &made.method), asked, "", ui));
    Ok((made, study.transpose()?))
}

/// The run that keeps an error; with the study of its realisations where that is one of means.
fn accurate(args: &Args, case: Case, tolerance: f64, ui: &Ui) -> Result<(CheckedRun, Option<RealisationStudy>)> {
    let with_study = |(run, study)| (run, Some(study));
    if args.of == Some(Of::Means) || (args.of.is_none() && case.judges_means()) {
        return means::studied(args, &case, tolerance, ui).map(with_study);
    }
    args.seeds.check_beside_motion(&case)?;
    match accurate::search(args, case, tolerance, ui)? {
        Searched::Motion(run) => Ok((*run, None)),
        Searched::Unpredictable(case, until) => means::of_chaos(args, (&case, until), tolerance, ui).map(with_study),
    }
}

fn succeeded<T>(check: Option<&Result<T>>) -> Option<&T> {
    check.and_then(|check| check.as_ref().ok())
}

/// Why the answer falls short of the request: by the run itself, by the study of its realisations,
/// or by what was not checked.
fn first_shortfall(
    own: Option<Error>,
    study: Option<&RealisationStudy>,
    unchecked: [Option<String>; 2],
) -> Option<Error> {
    let unchecked = unchecked.into_iter().flatten().chain(study.into_iter().flat_map(realisations::failed_checks));
    own.or(study.and_then(|study| study.shortfall.clone())).or(realisations::not_checked(unchecked))
}

/// What a check of the run refines, if the check failed.
fn failed<T>(refined: &str, check: Option<&Result<T>>) -> Option<String> {
    check.filter(|check| check.is_err()).map(|_| refined.to_owned())
}

/// What a check found, as a sentence.
fn checked_line<T: Display>(what: &str, check: Option<&Result<T>>) -> Option<String> {
    Some(match check? {
        Ok(found) => format!("{what}: {found}"),
        Err(error) => format!("{what}: the check of this run failed: {error}"),
    })
}

/// Shows a run: its tables with the remarks on them, its figures in a line, and its notes.
fn show(answer: &mut Answer, case: &Case, run: &Run, method: &Method) -> Result<()> {
    if let Some(table) = output::table(run) {
        answer.table(table, "summary.json");
        answer.remarks(output::remarks(run));
    }
    if let Some(table) = supports::table(case, run) {
        answer.table(table, "supports.csv");
        answer.remarks(supports::remarks(case, run));
    }
    if let Some(options) = case.statistics {
        let episodes = Episodes::of(case, run, options.rest);
        if let Some(table) = episodes.table(&case.scene) {
            answer.table(table, "episodes.csv");
            answer.remarks([episodes.remark()]);
        }
    }
    let notes = run.notes.iter().cloned().chain(case.notes()).chain(supports::warnings(case, run));
    answer.messages([output::line(case, run, method)]);
    answer.messages(notes.map(|note| format!("note: {note}")));
    Ok(())
}
