//! `impact-map.csv`, `stability.csv` and the pictures of a stability study.

use super::csv;
use super::figure::{Class as Tone, Curve, Figure, HeatMap, Mark, Panel, Scale};
use super::safe_steps::range_text;
use crate::error::Result;
use crate::scheme::Scheme;
use crate::study::stability::class::Class;
use crate::study::stability::family::{Parameter, SchemeFamily};
use crate::study::stability::impact::{ImpactMap, KAPPAS, alike};
use crate::study::stability::lasting::{Lasting, LastingForce, Quality};
use crate::study::stability::plan::{Maps, Row};
use serde_json::{Value, json};
use std::path::Path;

/// Writes one row per scheme and phase.
///
/// # Errors
/// [`crate::Error::Io`] where the file cannot be written.
pub fn impacts(path: &Path, maps: &[ImpactMap]) -> Result<()> {
    let header = [
        "scheme",
        "integrator_or_setting",
        "kappa",
        "phase",
        "restitution",
        "theory",
        "depth_over_step_length",
        "contact_steps",
        "failure",
    ];
    let row = |map: &ImpactMap, i: usize| {
        let kind = match map.scheme {
            Scheme::MoreauJean { theta } => theta.to_string(),
            Scheme::GeneralizedAlpha { rho } => rho.to_string(),
            Scheme::Penalty { integrator, .. } => integrator.to_string(),
            _ => String::new(),
        };
        let name = map.scheme.to_string();
        let mut row = vec![name.split(':').next().unwrap_or_default().to_owned(), kind, number(map.kappa)];
        match map.impacts.get(i) {
            Some(Ok(impact)) => row.extend([
                number(Some(impact.phase)),
                number(Some(impact.restitution)),
                number(impact.theory),
                number(Some(impact.depth)),
                impact.contact_steps.to_string(),
                String::new(),
            ]),
            Some(Err(error)) => row.extend(failure(5, error.to_string())),
            None => row.extend(failure(5, String::new())),
        }
        row
    };
    let rows = maps.iter().flat_map(|map| (0..map.impacts.len()).map(move |i| row(map, i)));
    csv::table(path, &header.map(str::to_owned), rows)
}

/// Writes one row per cell of every map; a failed cell gives the reason.
///
/// # Errors
/// [`crate::Error::Io`] where the file cannot be written.
pub fn cells(path: &Path, maps: &Maps) -> Result<()> {
    let header = [
        "scheme",
        "parameter",
        "value",
        "case_value",
        "step_s",
        "step_times_omega",
        "kappa",
        "class",
        "reason",
        "energy_growth_per_impact",
        "largest_speed_over_reference",
        "rms_speed_over_reference",
        "contacts",
        "reference_contacts_least",
        "reference_contacts_most",
        "missed",
        "spurious",
        "depth_m",
        "depth_over_bound",
        "frozen_share",
        "rest",
    ];
    let rows = maps.rows.iter().flat_map(|row| row.cells.iter().map(move |cell| (row, cell)));
    let line = |(row, cell): (&Row, &crate::study::stability::row::Cell)| {
        let subject = &row.subject;
        let mut line = vec![
            subject.family.to_string(),
            subject.parameter.name().to_owned(),
            number(subject.value.is_finite().then_some(subject.value)),
            subject.own.to_string(),
            number(Some(cell.step)),
            number(Some(cell.step * maps.scale.omega)),
            number(subject.kappa(&maps.scale, cell.step)),
            cell.class.to_string(),
            cell.reason.clone(),
        ];
        let Some(m) = &cell.measured else {
            line.extend(failure(11, String::new()));
            return line;
        };
        line.extend([
            number(m.growth),
            number(Some(m.speed)),
            number(Some(m.rms_speed)),
            m.contacts.to_string(),
            row.contacts.low.to_string(),
            row.contacts.high.to_string(),
            m.missed.to_string(),
            m.spurious.to_string(),
            number(Some(m.depth)),
            number(Some(m.passed)),
            number(Some(m.frozen)),
            m.rest.to_string(),
        ]);
        line
    };
    csv::table(path, &header.map(str::to_owned), rows.map(line))
}

/// Writes one row per scheme and step of [`Quality`]: energies as shares of the reference's largest
/// energy, and the largest lasting contact; a failed run gives the reason.
///
/// # Errors
/// [`crate::Error::Io`] where the file cannot be written.
pub fn quality(path: &Path, quality: &Quality) -> Result<()> {
    let header = [
        "scheme",
        "step_s",
        "largest_energy",
        "last_energy",
        "lost_at_walls",
        "unexplained_energy",
        "wall",
        "contact_start_s",
        "contact_end_s",
        "contact_impulse_N_s",
        "ripple",
        "failure",
    ];
    let line = |line: &LastingForce| {
        let mut row = vec![line.scheme.to_string(), number(Some(line.step))];
        match &line.outcome {
            Ok(seen) => {
                row.extend([seen.largest, seen.last, seen.lost_at_walls, seen.unexplained].map(|x| number(Some(x))));
                let contact = seen.contact.as_ref();
                row.push(contact.map_or_else(String::new, |c| c.0.clone()));
                let value = |of: fn(&Lasting) -> f64| number(contact.map(|c| of(&c.1)));
                row.extend([value(|c| c.start), value(|c| c.end), value(|c| c.impulse), value(|c| c.ripple)]);
                row.push(String::new());
            }
            Err(error) => row.extend(failure(9, error.to_string())),
        }
        row
    };
    csv::table(path, &header.map(str::to_owned), quality.lines.iter().map(line))
}

/// Nine significant digits, enough for a measurement; empty where there is no value.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| format!("{x:.8e}"))
}

/// Empty cells, then the reason.
fn failure(empty: usize, reason: String) -> impl Iterator<Item = String> {
    std::iter::repeat_n(String::new(), empty).chain([reason])
}

/// The restitution over the phase of the impact: one panel for the schemes that treat walls as
/// constraints, where those that agree have one curve with all their names, then one for the
/// penalty at each κ.
#[must_use]
pub fn impact_figure(maps: &[ImpactMap], e: f64) -> String {
    let title = format!("Restitution of one free impact, wall with e = {e}");
    let mut figure = Figure::new(title, "Phase of the impact within the step, τ (–)");
    let mut panel = Panel::new("Restitution (–)").heading("Walls as constraints").range(-0.15, 3.15);
    for group in alike(maps).iter().filter(|group| group.iter().all(|map| map.kappa.is_none())) {
        panel = panel.curve(Curve::new(names(group), group.first().map_or_else(Vec::new, |map| points(map))));
    }
    figure = figure.panel(panel);
    for kappa in KAPPAS {
        let wide = maps.iter().filter(|m| m.kappa == Some(kappa)).filter_map(ImpactMap::range);
        let (low, high) = wide.fold((1.0_f64, 1.0_f64), |(a, b), (low, high)| (a.min(low), b.max(high)));
        let mut panel = Panel::new("Restitution (–)").heading(format!("Penalty, h²k_w/m = {kappa}"));
        panel = if high / low.max(f64::MIN_POSITIVE) > 100.0 { panel.log() } else { panel };
        for (map, look) in maps.iter().filter(|m| m.kappa == Some(kappa)).zip(8..) {
            panel = panel.curve(Curve::new(format!("penalty, {}", short(map)), points(map)).look(look));
        }
        figure = figure.panel(panel.mark(Mark::floor(1.0, "no loss")));
    }
    figure.to_svg()
}

fn points(map: &ImpactMap) -> Vec<(f64, f64)> {
    map.measured().map(|i| (i.phase, i.restitution)).collect()
}

/// The name of a scheme; of a penalty that of its integrator.
fn short(map: &ImpactMap) -> String {
    match map.scheme {
        Scheme::Penalty { integrator, .. } => integrator.to_string(),
        _ => map.label.clone(),
    }
}

/// The names of schemes that agree; those of one scheme with several θ together.
fn names(group: &[&ImpactMap]) -> String {
    let theta = |map: &ImpactMap| if let Scheme::MoreauJean { theta } = map.scheme { Some(theta) } else { None };
    let runs = group.chunk_by(|a, b| theta(a).is_some() && theta(b).is_some());
    let name = |run: &[&ImpactMap]| match run {
        [one] => short(one),
        several => {
            let settings = several.iter().filter_map(|map| theta(map)).map(|theta| theta.to_string());
            format!("moreau-jean (θ = {})", settings.collect::<Vec<_>>().join(", "))
        }
    };
    runs.map(name).collect::<Vec<_>>().join(", ")
}

/// The schemes that agree at every phase of one impact as JSON, for the page: their names, and the
/// first of them by its number in `impact-map.csv`.
pub(crate) fn impact_groups(maps: &[ImpactMap]) -> Value {
    let row = |group: &Vec<&ImpactMap>| {
        let map = group.first()?;
        Some(json!({
            "names": names(group),
            "kappa": map.kappa,
            "range": map.range().map(range_text),
            "first": maps.iter().position(|other| std::ptr::eq(other, *map)),
        }))
    };
    alike(maps).iter().filter_map(row).collect()
}

/// One map of classes per family: file name without extension, and SVG text.
#[must_use]
pub fn maps_figures(maps: &Maps, title: &str) -> Vec<(String, String)> {
    SchemeFamily::all()
        .into_iter()
        .map(|family| (format!("stability-{}", slug(family)), map_figure(maps, family, title)))
        .collect()
}

fn map_figure(maps: &Maps, family: SchemeFamily, title: &str) -> String {
    let rows: Vec<&Row> = maps.map(family).collect();
    let values: Vec<f64> = rows.iter().map(|row| row.subject.value).collect();
    let parameter = rows.first().map_or(Parameter::Restitution, |row| row.subject.parameter);
    let scale = if parameter == Parameter::Restitution { Scale::Linear } else { Scale::Log };
    let steps: Vec<f64> = maps.steps.iter().map(|h| h * maps.scale.omega).collect();
    let number = |class: Class| Class::ALL.iter().position(|c| *c == class).unwrap_or(Class::ALL.len());
    let cells = rows.iter().flat_map(|row| row.cells.iter().map(|cell| number(cell.class))).collect();
    let classes = Class::ALL.iter().map(|class| Tone::new(class.name(), class.letter())).collect();
    let label = format!("Step hω (–), {}", maps.scale.origin.describe());
    let name = family.to_string().replace(":integrator=", ", ");
    HeatMap::new(format!("{title}: {name}"), (&label, Scale::Log, &steps), (parameter.label(), scale, &values))
        .classes(classes, cells)
        .to_svg()
}

/// A family's name as part of a file name.
fn slug(family: SchemeFamily) -> String {
    family.to_string().replace("integrator=", "").replace([':', '='], "-")
}
