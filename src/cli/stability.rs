//! `signorini stability`: where each scheme fails on a case.

use super::case_args::CaseArgs;
use super::estimate::DurationEstimate;
use super::pipeline::{Answer, Destination};
use super::ui::Ui;
use crate::case::Case;
use crate::error::Result;
use crate::output::request::{extended, request};
use crate::output::stable_steps::{StableStep, conclusion, criterion, rows, stable_steps, table};
use crate::output::table::Table;
use crate::output::{document, stability as output};
use crate::parallel::cores;
use crate::scheme::{PenaltyLaw, Scheme};
use crate::study::stability::family::{MapRequest, SchemeFamily};
use crate::study::stability::impact;
use crate::study::stability::lasting::{LastingForce, MULTIPLES, Quality};
use crate::study::stability::plan::{Grid, Maps, Plan};
use serde_json::json;

const EXAMPLES: &str = "\
Examples:
  signorini stability cases/rigid-walls-sine.toml
  signorini stability rigid-walls-sine --restitution 0.8
  signorini stability bouncing-ball --most-steps 50000

Writes impact-map.csv and .svg (the restitution of one free impact by its phase within the step),
stability.csv (every run of every map) and one stability-*.svg a scheme: classes over step and
restitution, ε or wall stiffness; and lasting-contact.csv, what each scheme does at the case's
step, at a quarter and at four times of it, to the energy and to the force of the largest contact
that lasts: its ripple is the deviation of the force from its mean, over that mean (0: constant,
1: on and off). report.html shows them all; every cell of a map tells its class and the reason.

Classes, from harmless to worst, against a fine run of the same scene:
  stable           energy kept as the walls' law has it; speeds, contacts and rest as in the
                   reference (right in kind, not exact)
  dissipative      more than 5 % of the energy arriving at the walls lost per impact, beyond what
                   restitution takes
  frozen           the body stands still, or crosses the gap in less than a step
  another-motion   a wall passed beyond the scheme's bound, contacts off by a factor of 2, speeds
                   above 1.5 or below 0.7 of the reference's, or no rest where rest is due
  energy-gaining   more than 1 % of the energy arriving at the walls made per impact
  diverged         speeds above 10 times the reference's, not finite, or a step that cannot be
                   solved";

/// h²k_w/m, at the case's step, of the penalty that is used for a case without one; it is resolved.
const KAPPA: f64 = 0.1;

/// Map where each scheme fails on a case: steps against restitution, ε or wall stiffness
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    case: CaseArgs,
    /// Most steps of a run of a map: it takes that much longer, and its finest steps are that much
    /// finer [default: 1e6, for many degrees of freedom fewer]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1000..=1_000_000_000))]
    most_steps: Option<u64>,
    #[command(flatten)]
    place: Destination,
}

/// Maps, then energy and lasting contacts.
///
/// # Errors
/// A case that makes no sense or has no wall, a folder that cannot be written, a reference run that
/// fails.
pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let case = args.case.read(ui)?;
    let asked = extended(request("stability", &case, &[]), json!({ "most_steps": args.most_steps }));
    let mut results = args.place.open(&case, "stability", asked)?;
    let question = MapRequest { scene: &case.scene, laws: &case.penalty.laws };
    let mut grid = Grid::of(&case.scene);
    grid.most_steps = args.most_steps.map_or(grid.most_steps, |most| most as f64);
    let plan = Plan::new(question, &grid)?;
    let e = impact::wall_restitution(&case.scene);
    let impacts = impact::maps(plan.scale.mass, case.time.step, e);
    output::impacts(&results.place("impact-map.csv")?, &impacts)?;
    results.draw("impact-map", &output::impact_figure(&impacts, e))?;
    let work = plan.work();
    let estimate = DurationEstimate::of_maps(&case.scene, work, plan.subjects.len());
    let maps = ui.with_estimate("stability", estimate, |bar| {
        plan.run(&|done| bar.set_share(done as f64 / work.max(1) as f64))
    })?;
    output::cells(&results.place("stability.csv")?, &maps)?;
    for (name, svg) in output::maps_figures(&maps, case.heading()) {
        results.draw(&name, &svg)?;
    }
    let quality = lasting_contacts(&case, &maps, ui)?;
    output::quality(&results.place("lasting-contact.csv")?, &quality)?;
    results.add_to_manifest("case_file", case.document.json()?);
    let steps = stable_steps(&maps, &impacts);
    results.add_to_manifest("remarks", json!(case.notes()));
    results.add_to_manifest("conclusion", json!(conclusion(&steps)));
    results.add_to_manifest("stable_steps", rows(&steps));
    results.add_to_manifest("impacts", output::impact_groups(&impacts));
    let mut document = document::stability(&case, &maps, &quality);
    document["conclusion"] = json!(conclusion(&steps));
    document["schemes"] = rows(&steps);
    let mut answer = Answer::of(results, !args.place.no_report, document);
    show_maps(&mut answer, &maps, &steps);
    show_contacts(&mut answer, &quality);
    Ok(answer)
}

/// Energy and lasting contacts of each scheme.
fn lasting_contacts(case: &Case, maps: &Maps, ui: &Ui) -> Result<Quality> {
    let schemes = schemes(case);
    // Each at four times, one and a quarter of the step, in parallel; judged and recorded.
    let runs = 2.0 * MULTIPLES.iter().map(|multiple| 1.0 / multiple).sum::<f64>() * schemes.len() as f64;
    let estimate = DurationEstimate::of_contacts(&case.scene, case.time.step, runs / cores() as f64);
    let quality =
        ui.with_estimate("contacts", estimate, |_| Quality::of(&case.scene, &schemes, &case.time, &maps.scale))?;
    for line in &quality.lines {
        if let Err(error) = &line.outcome {
            ui.refute_failed(&format!("{}, h = {:.2e} s", line.name, line.step), error);
        }
    }
    Ok(quality)
}

/// The schemes of the maps with the case's own penalties, or with a spring of `KAPPA` at its step.
fn schemes(case: &Case) -> Vec<Scheme> {
    let mass = case.scene.wall_masses().into_iter().reduce(f64::min).unwrap_or(1.0);
    let stiffness = KAPPA * mass / (case.time.step * case.time.step);
    // Without the digits of rounding.
    let stiffness = format!("{stiffness:.6e}").parse().unwrap_or(stiffness);
    let own = case.penalty.laws.first().copied();
    let law = own.unwrap_or(PenaltyLaw::Linear { stiffness, damping: 0.0 });
    let scheme = |family| match family {
        SchemeFamily::Constrained(scheme) => scheme,
        SchemeFamily::Penalty(integrator) => Scheme::Penalty { law, integrator },
    };
    SchemeFamily::all().into_iter().map(scheme).collect()
}

/// Shows what each scheme does to the energy and to the force of a lasting contact.
fn show_contacts(answer: &mut Answer, quality: &Quality) {
    let lasts = |line: &LastingForce| line.outcome.as_ref().is_ok_and(|seen| seen.contact.is_some());
    let what = if quality.lines.iter().any(lasts) {
        ", and the force of the largest lasting contact"
    } else {
        "; no contact lasts"
    };
    answer.remarks([format!("energy, in shares of {:.3e} J{what}:", quality.energy)]);
    let headers = [
        "scheme",
        "step (s)",
        "largest energy",
        "at the end",
        "lost at walls",
        "unexplained",
        "ripple",
        "impulse (N s)",
        "contact (s)",
    ];
    answer.table(Table::new(&headers, quality.lines.iter().map(contact_cells).collect()), "lasting-contact.csv");
    answer.remarks(failures(quality));
}

/// Why runs failed.
fn failures(quality: &Quality) -> impl Iterator<Item = String> {
    quality.lines.iter().filter_map(|line| {
        let error = line.outcome.as_ref().err()?;
        Some(format!("{}, h = {:.2e} s, failed: {error}", line.name, line.step))
    })
}

fn contact_cells(line: &LastingForce) -> Vec<String> {
    let mut row = vec![line.name.clone(), format!("{:.2e}", line.step)];
    match &line.outcome {
        Err(_) => {
            row.resize(8, "-".to_owned());
            row.push("failed".to_owned());
        }
        Ok(seen) => {
            row.extend([seen.largest, seen.last, seen.lost_at_walls].map(share));
            row.push(format!("{:.1e}", seen.unexplained));
            row.extend(match &seen.contact {
                Some((wall, c)) => [
                    format!("{:.3}", c.ripple),
                    if c.impulse.abs() < 1e4 { format!("{:.4}", c.impulse) } else { format!("{:.2e}", c.impulse) },
                    format!("{wall} {:.4} to {:.4}", c.start, c.end),
                ],
                None => ["-".to_owned(), "-".to_owned(), "-".to_owned()],
            });
        }
    }
    row
}

/// Three decimals where they mean something; a share of millions belongs to a diverging scheme, and
/// gets an exponent.
fn share(x: f64) -> String {
    if x.abs() < 1e4 { format!("{x:.3}") } else { format!("{x:.2e}") }
}

/// Shows the largest stable step of each scheme.
fn show_maps(answer: &mut Answer, maps: &Maps, steps: &[StableStep]) {
    let (first, last) = (maps.steps.first().copied().unwrap_or(0.0), maps.steps.last().copied().unwrap_or(0.0));
    answer.remarks([format!(
        "{} steps from {first:.2e} to {last:.2e} s, runs of {:.4} s, {} ({:.4} rad/s)",
        maps.steps.len(),
        maps.horizon,
        maps.scale.origin.describe(),
        maps.scale.omega
    )]);
    answer.table(table(steps), "stability.csv");
    answer.remarks([conclusion(steps), criterion()]);
}
