//! `impact-map.csv`, `stability.csv` and the pictures of a stability study.

use super::csv;
use super::figure::{Class as Tone, Curve, Figure, HeatMap, Mark, Panel, Scale};
use super::stable_steps::range_text;
use crate::error::Result;
use crate::scheme::Scheme;
use crate::study::stability::class::{Class, Measurement};
use crate::study::stability::family::{Parameter, SchemeFamily};
use crate::study::stability::impact::{Impact, ImpactMap, KAPPAS, alike};
use crate::study::stability::lasting::{Lasting, LastingForce, Quality, Seen};
use crate::study::stability::plan::{Maps, Row};
use crate::study::stability::row::Cell;
use serde_json::{Value, json};
use std::path::Path;

/// Writes one row per scheme and phase.
pub fn impacts(path: &Path, maps: &[ImpactMap]) -> Result<()> {
    type Point<'a> = (&'a ImpactMap, &'a Result<Impact>);
    let seen = |point: &Point<'_>, of: fn(&Impact) -> Option<f64>| number(point.1.as_ref().ok().and_then(of));
    let columns: [csv::Column<'_, Point<'_>>; 9] = [
        ("scheme", &|(map, _)| map.scheme.to_string().split(':').next().unwrap_or_default().to_owned()),
        ("integrator_or_setting", &|(map, _)| match map.scheme {
            Scheme::MoreauJean { theta } => theta.to_string(),
            Scheme::GeneralizedAlpha { rho } => rho.to_string(),
            Scheme::Penalty { integrator, .. } => integrator.to_string(),
            _ => String::new(),
        }),
        ("kappa", &|(map, _)| number(map.kappa)),
        ("phase", &|point| seen(point, |impact| Some(impact.phase))),
        ("restitution", &|point| seen(point, |impact| Some(impact.restitution))),
        ("theory", &|point| seen(point, |impact| impact.theory)),
        ("depth_over_step_length", &|point| seen(point, |impact| Some(impact.depth))),
        ("contact_steps", &|(_, impact)| cell(impact.as_ref().ok().map(|impact| impact.contact_steps))),
        ("failure", &|(_, impact)| cell(impact.as_ref().err())),
    ];
    csv::records(path, &columns, maps.iter().flat_map(|map| map.impacts.iter().map(move |impact| (map, impact))))
}

/// Writes one row per cell of every map; a failed cell gives the reason.
pub fn cells(path: &Path, maps: &Maps) -> Result<()> {
    type Square<'a> = (&'a Row, &'a Cell);
    let value =
        |square: &Square<'_>, of: fn(&Measurement) -> Option<f64>| number(square.1.measured.as_ref().and_then(of));
    let counted = |square: &Square<'_>, of: fn(&Measurement) -> usize| cell(square.1.measured.as_ref().map(of));
    let columns: [csv::Column<'_, Square<'_>>; 21] = [
        ("scheme", &|(row, _)| row.subject.family.to_string()),
        ("parameter", &|(row, _)| row.subject.parameter.name().to_owned()),
        ("value", &|(row, _)| number(Some(row.subject.value).filter(|value| value.is_finite()))),
        ("case_value", &|(row, _)| row.subject.own.to_string()),
        ("step_s", &|(_, cell)| number(Some(cell.step))),
        ("step_times_omega", &|(_, cell)| number(Some(cell.step * maps.scale.omega))),
        ("kappa", &|(row, cell)| number(row.subject.kappa(&maps.scale, cell.step))),
        ("class", &|(_, cell)| cell.class.to_string()),
        ("reason", &|(_, cell)| cell.reason.clone()),
        ("energy_growth_per_impact", &|square| value(square, |m| m.growth)),
        ("largest_speed_over_reference", &|square| value(square, |m| Some(m.speed))),
        ("rms_speed_over_reference", &|square| value(square, |m| Some(m.rms_speed))),
        ("contacts", &|square| counted(square, |m| m.contacts)),
        ("reference_contacts_least", &|(row, square)| cell(square.measured.as_ref().map(|_| row.contacts.low))),
        ("reference_contacts_most", &|(row, square)| cell(square.measured.as_ref().map(|_| row.contacts.high))),
        ("missed", &|square| counted(square, |m| m.missed)),
        ("spurious", &|square| counted(square, |m| m.spurious)),
        ("depth_m", &|square| value(square, |m| Some(m.depth))),
        ("depth_over_bound", &|square| value(square, |m| Some(m.passed))),
        ("frozen_share", &|square| value(square, |m| Some(m.frozen))),
        ("rest", &|(_, square)| cell(square.measured.as_ref().map(|m| m.rest))),
    ];
    csv::records(path, &columns, maps.rows.iter().flat_map(|row| row.cells.iter().map(move |cell| (row, cell))))
}

/// Writes one row per scheme and step of [`Quality`]: energies as shares of the reference's largest
/// energy, and the largest lasting contact; a failed run gives the reason.
pub fn quality(path: &Path, quality: &Quality) -> Result<()> {
    let seen = |line: &LastingForce, of: fn(&Seen) -> f64| number(line.outcome.as_ref().ok().map(of));
    let contact = |line: &LastingForce| line.outcome.as_ref().ok().and_then(|seen| seen.contact.clone());
    let lasting = |line: &LastingForce, of: fn(&Lasting) -> f64| number(contact(line).map(|c| of(&c.1)));
    let columns: [csv::Column<'_, &LastingForce>; 12] = [
        ("scheme", &|line| line.name.clone()),
        ("step_s", &|line| number(Some(line.step))),
        ("largest_energy", &|line| seen(line, |seen| seen.largest)),
        ("last_energy", &|line| seen(line, |seen| seen.last)),
        ("lost_at_walls", &|line| seen(line, |seen| seen.lost_at_walls)),
        ("unexplained_energy", &|line| seen(line, |seen| seen.unexplained)),
        ("wall", &|line| cell(contact(line).map(|contact| contact.0))),
        ("contact_start_s", &|line| lasting(line, |c| c.start)),
        ("contact_end_s", &|line| lasting(line, |c| c.end)),
        ("contact_impulse_N_s", &|line| lasting(line, |c| c.impulse)),
        ("ripple", &|line| lasting(line, |c| c.ripple)),
        ("failure", &|line| cell(line.outcome.as_ref().err())),
    ];
    csv::records(path, &columns, &quality.lines)
}

/// Nine significant digits, enough for a measurement; empty where there is no value.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| format!("{x:.8e}"))
}

/// Empty where there is no value.
fn cell(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
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
