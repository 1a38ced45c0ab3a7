//! `signorini orbit`: a periodic orbit of a case, and its Floquet multipliers.

mod args;
mod derivative;
mod list;
mod structure;

pub use args::Args;

use super::pipeline::Answer;
use super::ui::Ui;
use crate::error::{Error, Result};
use crate::orbit::strobe::stability_in_words;
use crate::orbit::{Floquet, Kind, Orbit, Problem};
use crate::output::first_orbit::FirstOrbit;
use crate::output::json;
use crate::output::periodic::{self, Known, closure_of, tells_state};
use crate::output::table::Table;
use crate::scene::System;
use derivative::Wanted;
use list::list;
use structure::{structure, told};

/// Instants of the motion over one orbit.
const POINTS: u32 = 2000;

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.case.read(ui)?;
    if args.list {
        return list(&case);
    }
    case.check_repeats()?;
    let wanted = Wanted::of(args, &case)?;
    let is_state = args.from.as_deref().map(tells_state).transpose()?.unwrap_or(false);
    if is_state || matches!(case.scene.system, System::Structure(_)) {
        return structure(args, &case, &wanted, ui);
    }
    let problem = Problem::new(case.scene.clone())?;
    let start = args.start_orbit(&problem)?;
    let mut results = args.open(&case)?;
    let orbit = match start {
        Some(start) if start.signature.chatters() => start,
        Some(start) => problem.correct(&start)?,
        None => {
            let settled = ui.with_bar("settling", |bar| {
                let progress = |share| bar.set_share(share);
                FirstOrbit::settled(&case.scene, Some(&problem), args.settle, &progress)
            })?;
            match settled {
                FirstOrbit::Orbit(orbit) => orbit,
                FirstOrbit::Shot(shot) => return told(args, &case, &wanted, &shot, results),
            }
        }
    };
    let judged = problem.judge(&orbit, POINTS)?;
    let (floquet, admissible) = (problem.floquet(&orbit)?, problem.admissible(&orbit)?);
    let known = Known { problem: &problem, orbit: &orbit, floquet, admissible, judged: &judged };
    let mut document = known.document(&case.name);
    let derivatives = wanted.of_events(&known)?;
    if let Some(found) = &derivatives {
        document["derivatives"] = wanted.document(&case, found);
        wanted.write(&case, found, &mut results)?;
    }
    results.write("orbit.json", json::text(&document))?;
    if !judged.motion.is_empty() {
        known.motion(&results.place("orbit.csv")?)?;
        known.contacts(&results.place("contacts.csv")?)?;
        let title = format!("{}: {}", case.heading(), headline(&problem, &orbit));
        results.draw("phase", &known.portrait(&title))?;
        results.draw("motion", &known.picture(&title))?;
    }
    let mut answer = Answer::of(results, !args.place.no_report, document);
    show(&mut answer, &known);
    if let Some(found) = &derivatives {
        wanted.show(&mut answer, &case, found);
    }
    answer.fall_short(fault(&known));
    Ok(answer)
}

/// Why what was found is no orbit.
fn fault(known: &Known<'_>) -> Option<Error> {
    let judged = known.judged;
    match known.admissible.reason(known.problem.scene()) {
        Some(reason) => Some(Error::no_orbit(format!("no body can follow what was found: {reason}"))),
        None if !judged.holds() => Some(Error::no_orbit(format!(
            "the free run from it does not come back: it misses its start by {:.1e} of {}, and rounding \
             explains {:.1e}{}",
            judged.closure,
            closure_of(known.problem.scene()),
            judged.tolerance,
            if judged.same_events { "" } else { ", and goes through other events" }
        ))),
        None => None,
    }
}

/// The orbit in a few words.
fn headline(problem: &Problem, orbit: &Orbit) -> String {
    let signature = &orbit.signature;
    periodic::headline(&signature.written(problem.scene()), signature.symmetric, signature.periods.into())
}

/// Shows an orbit of one degree of freedom.
fn show(answer: &mut Answer, known: &Known<'_>) {
    let Known { problem, orbit, floquet, admissible, judged } = known;
    let scene = problem.scene();
    let name = |wall: usize| scene.walls.get(wall).map_or("", |wall| wall.name.as_str());
    answer.prose(format!("orbit: {}, period {:.9} s", headline(problem, orbit), orbit.period()));
    if !orbit.phases.is_empty() {
        let rows = orbit.signature.events.iter().enumerate().map(|(index, event)| {
            let number = |values: &[f64]| values.get(index).map_or_else(String::new, |x| format!("{x:.12}"));
            let speed = if event.kind == Kind::Release { "-".to_owned() } else { number(&orbit.speeds) };
            vec![event.kind.to_string(), name(event.wall).to_owned(), number(&orbit.phases), speed]
        });
        let header = ["event", "wall", "phase (cycles)", "speed (m/s)"];
        answer.table(Table::new(&header, rows.collect()), "orbit.json");
    }
    multipliers(floquet).into_iter().for_each(|line| answer.prose(line));
    let near = admissible.nearest.map_or_else(String::new, |nearest| {
        format!(", nearest to a wall without striking it: {:.4e} m ({})", nearest.gap, name(nearest.wall))
    });
    answer.prose(format!("displacement at most {:.6e} m{near}", admissible.largest));
    if judged.motion.is_empty() {
        return;
    }
    let rows = judged.walls.iter().enumerate().map(|(wall, share)| {
        let peak = if share.peak_force > 0.0 { format!("{:.6e}", share.peak_force) } else { "-".to_owned() };
        vec![
            name(wall).to_owned(),
            share.contacts.to_string(),
            format!("{:.9e}", share.impulse),
            format!("{:.9e}", share.approach_speed),
            peak,
        ]
    });
    let header = ["wall", "contacts", "impulse (N s)", "largest speed (m/s)", "largest lasting force (N)"];
    answer.table(Table::new(&header, rows.collect()), "orbit.json");
    answer.prose(format!(
        "free run over one period: comes back within {:.1e} of {}, {} events",
        judged.closure,
        closure_of(scene),
        if judged.same_events { "the same" } else { "other" }
    ));
}

/// The multipliers in words.
fn multipliers(floquet: &Floquet) -> Vec<String> {
    let shown = |values: &[[f64; 2]]| {
        let one = |[re, im]: &[f64; 2]| if *im == 0.0 { format!("{re:.12}") } else { format!("{re:.12} {im:+.12}i") };
        values.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    let largest = floquet.multipliers.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let verdict = stability_in_words(&floquet.multipliers);
    let mut lines =
        vec![format!("Floquet multipliers: {} ({verdict}, largest |μ| {largest:.9})", shown(&floquet.multipliers))];
    lines.extend(floquet.half.as_deref().map(|half| format!("of the half map: {}", shown(half))));
    lines
}
