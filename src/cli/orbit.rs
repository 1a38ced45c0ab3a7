//! `signorini orbit`: a periodic orbit of a case, and its Floquet multipliers.

use super::request::{Changes, Destination};
use super::ui::Ui;
use crate::case::Case;
use crate::error::{Error, Result};
use crate::orbit::{Floquet, Kind, Orbit, Problem, SETTLE, Signature, closed_forms, shoot};
use crate::output::asked::{asked, with};
use crate::output::atomic::write_whole;
use crate::output::json;
use crate::output::periodic::{Known, listed, read, read_shot, shot};
use crate::output::results::Results;
use crate::output::summary;
use crate::output::table::Table;
use crate::scene::System;
use serde_json::{Map, Value, json};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' --settle 400
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' --list
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --signature U --symmetric --start 0.743,0.033
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --from out/rigid-walls-sine/orbit/orbit.json

A signature is a list of walls, one for each impact, by name (upper,lower) or, where no two names
begin alike, by letter (UL); other events are written upper:rest, upper:release, pad:enter,
pad:leave. --start has the phase of each event in cycles of the forcing period and its speed in
m/s. With --symmetric both mean the first half of an orbit that is its own mirror image.
Writes orbit.json (which --from and `signorini continue` read), orbit.csv (the motion),
contacts.csv, pictures of phase plane and time, and report.html, which shows them all. Of a
structure the orbit on which its run settles, or one near that of --from, is found by shooting,
and orbit.json and report.html are written. docs/orbits.md has the method.";

/// A periodic orbit: from a run that settles, a signature or a file; multipliers, forces, check
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Case file, summary.json of a run, or the name of a built-in case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    case: String,
    #[command(flatten)]
    changes: Changes,
    /// Forcing periods that are run before the motion is checked for repetition
    #[arg(long, value_name = "N", default_value_t = SETTLE)]
    settle: u32,
    /// List all orbits of one impact per period of the orbit (or one on each of two mirrored walls)
    /// up to 8 forcing periods, from closed forms; for any number of degrees of freedom
    #[arg(long, conflicts_with_all = ["signature", "from", "settle"])]
    list: bool,
    /// Events of the orbit, such as UL or upper,lower
    #[arg(long, value_name = "EVENTS", requires = "start", conflicts_with_all = ["from", "settle"])]
    signature: Option<String>,
    /// Phase (cycles) and speed (m/s) of each event of --signature
    #[arg(long, value_name = "θ,v,…", value_delimiter = ',', requires = "signature", allow_hyphen_values = true)]
    start: Vec<f64>,
    /// Forcing periods of the orbit of --signature
    #[arg(long, value_name = "N", default_value_t = 1, requires = "signature")]
    periods: u32,
    /// --signature is the first half of an orbit that is its own mirror image
    #[arg(long, requires = "signature")]
    symmetric: bool,
    /// Start from an orbit that was written before, of this case or one near it
    #[arg(long, value_name = "FILE", conflicts_with = "settle", value_hint = clap::ValueHint::FilePath)]
    from: Option<PathBuf>,
    #[command(flatten)]
    place: Destination,
}

/// Longest orbits of --list, forcing periods.
const LISTED: u32 = 8;

/// Instants of the motion over one orbit.
const POINTS: u32 = 2000;

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let case = args.changes.case(&args.case, ui)?;
    if args.list {
        return list(&case, ui);
    }
    let request = with(
        asked("orbit", &case, &[]),
        json!({
            "settle": args.settle,
            "signature": args.signature,
            "start": args.start,
            "periods": args.periods,
            "symmetric": args.symmetric,
            "from": args.from,
        }),
    );
    if let System::Structure(_) = case.scene.system {
        return structure(args, &case, request, ui);
    }
    let problem = Problem::new(case.scene.clone())?;
    let start = args.start(&problem)?;
    let mut results = args.place.results(&case, "orbit", request)?;
    let orbit = match start {
        Some(start) if start.signature.chatters() => start,
        Some(start) => problem.correct(&start)?,
        None => {
            let bar = ui.progress("settling", 1000);
            let found = problem.settled_with(args.settle, &|share| bar.share(share));
            bar.finish();
            found?
        }
    };
    let judged = problem.judge(&orbit, POINTS)?;
    let (floquet, admissible) = (problem.floquet(&orbit)?, problem.admissible(&orbit)?);
    let known = Known { problem: &problem, orbit: &orbit, floquet, admissible, judged: &judged };
    let document = known.document(&case.name);
    let place = results.place("orbit.json")?;
    write_whole(&place, json::text(&document).as_bytes())?;
    if !judged.motion.is_empty() {
        known.motion(&results.place("orbit.csv")?)?;
        known.contacts(&results.place("contacts.csv")?)?;
        let title = format!("{}: {}", case.title.as_deref().unwrap_or(&case.name), headline(&problem, &orbit));
        results.draw("phase", &known.portrait(&title))?;
        results.draw("motion", &known.picture(&title))?;
    }
    args.finish(&mut results, &case, ui)?;
    if ui.json() {
        ui.document(&document)?;
    } else {
        report(&known, ui)?;
    }
    match known.admissible.reason(problem.scene()) {
        Some(reason) => Err(Error::no_orbit(format!("no body can follow what was found: {reason}"))),
        None if !judged.holds() => Err(Error::no_orbit(format!(
            "the free run from it does not come back: it misses its start by {:.1e} of the gap, and rounding \
             explains {:.1e}{}",
            judged.closure,
            judged.tolerance,
            if judged.same_events { "" } else { ", and goes through other events" }
        ))),
        None => Ok(()),
    }
}

impl Args {
    /// Finishes the folder, with the report where one is wanted.
    fn finish(&self, results: &mut Results, case: &Case, ui: &Ui) -> Result<()> {
        results.tell("case_file", summary::case_file(case));
        super::run::finish(results, "", !self.place.no_report, ui)
    }

    /// The orbit from which Newton's method starts; `None` where a run is to settle.
    fn start(&self, problem: &Problem) -> Result<Option<Orbit>> {
        if let Some(path) = &self.from {
            return read(path, problem.scene()).map(Some);
        }
        let Some(text) = &self.signature else { return Ok(None) };
        let mut signature = Signature::parse(text, self.periods, problem.scene())?;
        signature.symmetric = self.symmetric;
        signature.check(problem.scene())?;
        let count = signature.events.len();
        if self.start.len() != 2 * count {
            let expected = format!("{}: phase and speed of each of {count} events", 2 * count);
            return Err(Error::invalid("--start", format!("{} numbers", self.start.len()), expected));
        }
        let pick = |offset: usize| self.start.iter().skip(offset).step_by(2).copied().collect();
        let forcing_period = problem.forcing_period();
        Ok(Some(Orbit { signature, phases: pick(0), speeds: pick(1), forcing_period }))
    }
}

/// The orbit of a structure, by shooting.
fn structure(args: &Args, case: &Case, request: Map<String, Value>, ui: &Ui) -> Result<()> {
    if args.signature.is_some() {
        let expected = "a case of one degree of freedom; the orbit of a structure is the one on which its run settles \
                        (--settle), or one near that of a file (--from)";
        return Err(Error::invalid("--signature", "given", expected));
    }
    let (scene, modal) = (&case.scene, case.truncated.is_some());
    let from = args.from.as_deref().map(|path| read_shot(path, scene, modal)).transpose()?;
    let mut results = args.place.results(case, "orbit", request)?;
    let bar = ui.progress("settling", 1000);
    let found = match from {
        Some(from) => from.corrected(scene),
        None => shoot(scene, args.settle, &|share| bar.share(share)),
    };
    bar.finish();
    let found = found?;
    let document = shot(&found, scene, &case.name, modal);
    write_whole(&results.place("orbit.json")?, json::text(&document).as_bytes())?;
    args.finish(&mut results, case, ui)?;
    if ui.json() {
        return ui.document(&document);
    }
    let period = f64::from(found.periods) * found.forcing_period;
    let turns =
        if found.periods == 1 { "1 forcing period".to_owned() } else { format!("{} forcing periods", found.periods) };
    ui.prose(&format!("orbit: {turns}, period {period:.9} s"))?;
    let shown = found.multipliers.iter().take(4).map(|[re, im]| match im {
        0.0 => format!("{re:.9}"),
        im => format!("{re:.9} {im:+.9}i"),
    });
    let verdict = if found.is_stable() { "stable" } else { "unstable" };
    ui.prose(&format!(
        "largest of {} Floquet multipliers: {} ({verdict})",
        found.multipliers.len(),
        shown.collect::<Vec<_>>().join(", ")
    ))?;
    let rows = scene.walls.iter().zip(&found.contacts).zip(&found.impulses);
    let row = |((wall, contacts), impulse): ((&crate::scene::Wall, &u64), &f64)| {
        vec![wall.name.clone(), contacts.to_string(), format!("{impulse:.9e}")]
    };
    ui.table(&Table::new(&["wall", "contacts", "impulse (N s)"], rows.map(row).collect()), "orbit.json")?;
    ui.prose(&format!("free run over one period: comes back within {:.1e} of the gap", found.closure))
}

/// The orbit in a few words.
fn headline(problem: &Problem, orbit: &Orbit) -> String {
    let whole = orbit.signature.periods;
    let symmetric = if orbit.signature.symmetric { ", symmetric" } else { "" };
    let periods = if whole == 1 { "1 forcing period".to_owned() } else { format!("{whole} forcing periods") };
    match orbit.signature.written(problem.scene()).as_str() {
        "" => format!("touches no wall, {periods}"),
        written if orbit.signature.symmetric => format!("{written} and mirror, {periods}{symmetric}"),
        written => format!("{written}, {periods}"),
    }
}

fn report(known: &Known<'_>, ui: &Ui) -> Result<()> {
    let Known { problem, orbit, floquet, admissible, judged } = known;
    let scene = problem.scene();
    let name = |wall: usize| scene.walls.get(wall).map_or("", |wall| wall.name.as_str());
    ui.prose(&format!("orbit: {}, period {:.9} s", headline(problem, orbit), orbit.period()))?;
    if !orbit.phases.is_empty() {
        let rows = orbit.signature.events.iter().enumerate().map(|(index, event)| {
            let number = |values: &[f64]| values.get(index).map_or_else(String::new, |x| format!("{x:.12}"));
            let speed = if event.kind == Kind::Release { "-".to_owned() } else { number(&orbit.speeds) };
            vec![event.kind.to_string(), name(event.wall).to_owned(), number(&orbit.phases), speed]
        });
        ui.table(&Table::new(&["event", "wall", "phase (cycles)", "speed (m/s)"], rows.collect()), "orbit.json")?;
    }
    for line in multipliers(floquet) {
        ui.prose(&line)?;
    }
    let near = admissible.nearest.map_or_else(String::new, |nearest| {
        format!(", nearest to a wall that it does not strike: {:.4e} m ({})", nearest.gap, name(nearest.wall))
    });
    ui.prose(&format!("displacement at most {:.6e} m{near}", admissible.largest))?;
    if judged.motion.is_empty() {
        return Ok(());
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
    ui.table(&Table::new(&header, rows.collect()), "orbit.json")?;
    ui.prose(&format!(
        "free run over one period: comes back within {:.1e} of the gap, {} events",
        judged.closure,
        if judged.same_events { "the same" } else { "other" }
    ))
}

/// The multipliers in words.
fn multipliers(floquet: &Floquet) -> Vec<String> {
    let shown = |values: &[[f64; 2]]| {
        let one = |[re, im]: &[f64; 2]| if *im == 0.0 { format!("{re:.12}") } else { format!("{re:.12} {im:+.12}i") };
        values.iter().map(one).collect::<Vec<_>>().join(", ")
    };
    let largest = floquet.multipliers.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max);
    let verdict = if floquet.is_stable() { "stable" } else { "unstable" };
    let mut lines =
        vec![format!("Floquet multipliers: {} ({verdict}, largest |μ| {largest:.9})", shown(&floquet.multipliers))];
    lines.extend(floquet.half.as_deref().map(|half| format!("of the half map: {}", shown(half))));
    lines
}

fn list(case: &Case, ui: &Ui) -> Result<()> {
    let scene = &case.scene;
    let forms = closed_forms(scene, LISTED)?;
    // With several degrees of freedom the motion between the impacts is not checked.
    let problem = Problem::new(scene.clone()).ok();
    let holds = |form: &crate::orbit::ClosedForm| {
        let problem = problem.as_ref()?;
        Some(problem.admissible(&form.orbit(problem)).ok()?.holds())
    };
    let found: Vec<_> = forms.into_iter().map(|form| (form.clone(), holds(&form))).collect();
    if ui.json() {
        return ui.document(&listed(&found, scene));
    }
    if found.is_empty() {
        return ui.prose(&format!("no orbit of one impact per period of the orbit in up to {LISTED} forcing periods"));
    }
    let rows = found.iter().map(|(form, admissible)| {
        let wall = scene.walls.get(form.wall).map_or("", |wall| wall.name.as_str());
        let largest = form.multipliers.first().map_or(0.0, |m| m[0].hypot(m[1]));
        vec![
            wall.to_owned(),
            form.periods.to_string(),
            if form.symmetric { "yes" } else { "no" }.to_owned(),
            format!("{:.9}", form.phase),
            format!("{:.9e}", form.speed),
            format!("{largest:.6e}"),
            if form.is_stable() { "stable" } else { "unstable" }.to_owned(),
            match admissible {
                Some(true) => "yes",
                Some(false) => "no, passes a wall",
                None => "not looked at",
            }
            .to_owned(),
        ]
    });
    let header =
        ["wall", "periods", "symmetric", "phase (cycles)", "speed (m/s)", "largest |μ|", "stability", "admissible"];
    ui.table(&Table::new(&header, rows.collect()), "--json")
}
