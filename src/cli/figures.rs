//! `signorini figures`: the figures of the source, from the built-in cases.

use super::estimate::DurationEstimate;
use super::formats::PictureFormats;
use super::pipeline::Answer;
use super::ui::Ui;
use crate::case::{Case, Embedded};
use crate::error::{Error, Result};
use crate::output::Span;
use crate::output::figure::{Curve, Figure, Mark, Panel};
use crate::output::pictures::{FigureSet, Labelled};
use crate::output::results::Results;
use crate::run::{Options, Run, run_with_progress};
use crate::scheme::{Method, Scheme};
use crate::study::choice;
use serde_json::json;
use std::path::PathBuf;

/// Draw figures 2 to 9 of the study that the built-in cases reproduce
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  signorini figures --out figures")]
pub struct Args {
    /// Folder for the figures
    #[arg(long, value_name = "DIR", default_value = "out/figures", value_hint = clap::ValueHint::DirPath)]
    out: PathBuf,
    /// Replace other results in that folder
    #[arg(long)]
    force: bool,
    #[command(flatten)]
    formats: PictureFormats,
}

/// One figure of the source: its number, the case, and its content.
struct Plate {
    number: u32,
    case: &'static str,
    content: Content,
}

/// What a figure of the source shows.
#[derive(Clone, Copy, PartialEq)]
enum Content {
    /// Displacement, velocity and phase plot of the constrained QP over the exact motion.
    Response,
    /// The same for every penalty of the case.
    Penalties,
    /// Displacement over the 50-digit reference values.
    Independent,
    /// Contact force over time.
    Force,
}

const PLATES: [Plate; 8] = [
    Plate { number: 2, case: "linear-sine", content: Content::Response },
    Plate { number: 3, case: "linear-impulse", content: Content::Response },
    Plate { number: 4, case: "rigid-walls-sine", content: Content::Response },
    Plate { number: 5, case: "penalty-epsilon", content: Content::Penalties },
    Plate { number: 6, case: "independent-code", content: Content::Independent },
    Plate { number: 7, case: "rigid-walls-impulse", content: Content::Response },
    Plate { number: 8, case: "elastic-wall", content: Content::Response },
    Plate { number: 9, case: "elastic-wall", content: Content::Force },
];

/// Time shown, s: enough periods to see the motion, few enough to tell them apart.
const SHOWN: f64 = 2.0;

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let request = json!({ "command": "figures" }).as_object().cloned().unwrap_or_default();
    let mut results = Results::open(&args.out, request, args.force, args.formats.usable()?)?;
    // Each method has one look in all figures: its index in the order in which methods first
    // appear.
    let mut known = Vec::new();
    let mut written = Vec::new();
    for plate in &PLATES {
        let mut case = Case::embedded(plate.case)?;
        case.scene.duration = case.scene.duration.min(SHOWN);
        case.time.sample = Some(case.time.step.max(case.scene.duration / 4000.0));
        for (name, svg) in plate.draw(&case, &mut known, ui)? {
            written.extend(results.draw(&format!("fig{}-{name}", plate.number), &svg)?);
        }
    }
    let mut answer = Answer::of(results, false, json!({ "command": "figures" }));
    answer.messages(written.iter().map(|path| format!("wrote {}", path.display())));
    Ok(answer)
}

impl Plate {
    /// The pictures of this figure, by their names.
    fn draw(&self, case: &Case, known: &mut Vec<String>, ui: &Ui) -> Result<Vec<(&'static str, String)>> {
        let integrator = case.penalty.integrator.unwrap_or_default();
        let mut methods = vec![choice::choose(&case.scene).method];
        if self.content == Content::Penalties {
            methods.extend(case.penalty.laws.iter().map(|&law| Method::new(Scheme::Penalty { law, integrator })));
        } else {
            methods.push(Method::new(Scheme::Event));
        }
        let runs = methods.iter().map(|method| self.run(case, method, ui)).collect::<Result<Vec<Run>>>()?;
        let labels: Vec<String> = methods.iter().map(|m| label(m, integrator)).collect();
        let title = format!("{} ({})", case.heading(), case.source.as_deref().unwrap_or("source"));
        if self.content == Content::Independent {
            return Ok(vec![("displacement", independent(case, &title, &labels, &runs, known)?)]);
        }
        let labelled: Vec<Labelled<'_>> = methods
            .iter()
            .zip(&labels)
            .zip(&runs)
            .map(|((m, label), run)| {
                let look = place(known, label);
                Labelled { label, run, reference: m.scheme == Scheme::Event, look }
            })
            .collect();
        let span = Span { from: 0.0, to: case.scene.duration };
        let sheet = FigureSet { title: &title, scene: &case.scene, runs: &labelled, span };
        let force = self.content == Content::Force;
        Ok(sheet.figures().into_iter().filter(|(name, _)| (*name == "contact-force") == force).collect())
    }

    fn run(&self, case: &Case, method: &Method, ui: &Ui) -> Result<Run> {
        let estimate = DurationEstimate::of_run(&case.scene, method, case.time.step);
        let end = case.scene.duration;
        let run = ui.with_estimate(&method.to_string(), estimate, |bar| {
            run_with_progress(&case.scene, method, &Options::new(case.time), &mut |time| bar.set_share(time / end))
        })?;
        ui.refute(&format!("figure {}, {method}", self.number), &run.findings);
        Ok(run)
    }
}

/// Index of a label in `known`; a new label is appended.
fn place(known: &mut Vec<String>, label: &str) -> usize {
    let found = known.iter().position(|other| other == label);
    found.unwrap_or_else(|| {
        known.push(label.to_owned());
        known.len() - 1
    })
}

/// The method's name without what all penalties of a figure share.
fn label(method: &Method, integrator: crate::scheme::Integrator) -> String {
    let text = method.to_string().replace(&format!(",integrator={integrator}"), "");
    if method.scheme == Scheme::Event { "event (exact)".into() } else { text }
}

/// The 50-digit impacts and states over the computed displacement, mm.
fn independent(case: &Case, title: &str, labels: &[String], runs: &[Run], known: &mut Vec<String>) -> Result<String> {
    let mut panel = Panel::new("Displacement (mm)");
    for (label, run) in labels.iter().zip(runs) {
        let rows = run.trajectory.time().iter().zip(run.trajectory.displacement());
        let curve = Curve::new(label.as_str(), rows.map(|(&t, &u)| (t, 1e3 * u))).look(place(known, label));
        panel = panel.curve(if run.scheme == Scheme::Event { curve.backdrop() } else { curve });
    }
    let points = Embedded::reference_points().ok_or_else(|| Error::Case {
        report: "error: the built-in reference values cannot be read".into(),
        cause: None,
    })?;
    let shown = points.into_iter().filter(|p| p.0 <= case.scene.duration);
    // NaN between any two points leaves markers without a line.
    let shown = shown.flat_map(|(t, u)| [(t, 1e3 * u), (t, f64::NAN)]);
    panel = panel.curve(Curve::new("50-digit reference", shown).marked().look(place(known, "50-digit reference")));
    for wall in &case.scene.walls {
        panel = panel.mark(Mark::wall(1e3 * wall.position(), wall.name.as_str()));
    }
    Ok(Figure::new(title, "Time (s)").panel(panel).to_svg())
}
