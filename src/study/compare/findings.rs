//! What explains the differences between the methods of a comparison, in sentences.

use super::comparison::{Comparison, is_aperiodic};
use crate::qp::Backend;
use crate::scene::Scene;
use crate::scheme::Realised;
use crate::study::difference;
use crate::study::horizon::{LARGEST_GROWTH, Source};

/// Sentences on the laws that the methods realise, on their reference, and on the growth of
/// perturbations.
pub(super) fn of(scene: &Scene, comparison: &Comparison) -> Vec<String> {
    let mut findings = law_findings(scene, comparison);
    findings.extend(clarabel_difference(scene, comparison));
    if let Err(error) = &comparison.reference {
        findings.push(match comparison.reference_in_words() {
            Some(reference) => format!("no exact motion: errors are against {reference}"),
            None => format!("no reference: {error}"),
        });
    }
    findings.extend(growth_finding(scene, comparison));
    findings
}

/// That penalty springs without loss are compared with walls that take energy.
#[must_use]
pub fn other_restitution(scene: &Scene, comparison: &Comparison) -> Option<String> {
    let mut asked: Vec<f64> = Vec::new();
    for e in scene.walls.iter().filter_map(|wall| wall.law.restitution()) {
        if !asked.contains(&e) {
            asked.push(e);
        }
    }
    let lossless = comparison.rows.iter().any(|row| row.method.scheme.is_lossless());
    (lossless && asked.iter().any(|&e| e != 1.0)).then(|| {
        let e = asked.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        format!(
            "the walls ask for e = {e}, a lossless penalty spring tends to e = 1: the two do not converge to one \
             another"
        )
    })
}

/// Where the methods realise another restitution than the walls ask for.
fn law_findings(scene: &Scene, comparison: &Comparison) -> Vec<String> {
    let mut findings = Vec::new();
    let asked: Vec<f64> = scene.walls.iter().map(|wall| wall.law).filter_map(|law| law.restitution()).collect();
    let realised = |restitution| {
        comparison.rows.iter().map(|row| row.method.scheme).find(|s| s.entry().restitution == restitution)
    };
    let lossless = comparison.rows.iter().any(|row| row.method.scheme.is_lossless());
    if lossless && asked.iter().all(|&e| e == 1.0) {
        findings.push(
            "every wall has e = 1, the limit of a lossless penalty spring: QP and penalty converge to one motion, \
             the penalty as ε → 0 and h²k_w/m → 0 both"
                .to_owned(),
        );
    }
    findings.extend(other_restitution(scene, comparison));
    if let Some(scheme) = realised(Realised::Zero).filter(|_| asked.iter().any(|&e| e > 0.0)) {
        findings.push(format!("{scheme} on positions tends to e = 0: it does not converge to walls that rebound"));
    }
    if let Some(scheme) = realised(Realised::ByChance).filter(|_| !asked.is_empty()) {
        findings.push(format!(
            "{scheme} shows what goes wrong: by chance it realises an e between 1/3 and 3 (of slow impacts \
             under load also beyond), and it gains energy"
        ));
    }
    findings
}

/// Whether a perturbation of the start grows, and up to when errors are taken for that reason.
fn growth_finding(scene: &Scene, comparison: &Comparison) -> Option<String> {
    let by =
        comparison.growth_by.filter(|by| *by != Source::Saltation).map_or_else(String::new, |by| format!(" ({by})"));
    // A table need not repeat itself, and random loads do not.
    let [chaotic, predictable] =
        if is_aperiodic(scene) { ["sensitive", "not sensitive"] } else { ["chaos", "not chaotic"] };
    let growth = comparison.growth.filter(|_| comparison.reference_run().is_some())?;
    Some(if comparison.horizon < scene.duration {
        format!(
            "{chaotic}: a perturbation of the start grows {growth:.1e}-fold over the run{by}, and \
             {LARGEST_GROWTH:e}-fold by t = {:.3} s; errors are taken up \
             to then, later compare impulses, contact counts and RMS",
            comparison.horizon
        )
    } else {
        format!(
            "{predictable}: a perturbation of the start never grows beyond {growth:.1}-fold{by}, so errors are \
             taken over the whole run"
        )
    })
}

/// How much solving through Clarabel changed, where a method was run both ways.
fn clarabel_difference(scene: &Scene, comparison: &Comparison) -> Option<String> {
    let through = comparison.rows.iter().find(|r| r.method.backend == Backend::Clarabel)?;
    let own = comparison
        .rows
        .iter()
        .find(|r| r.method.scheme == through.method.scheme && r.method.backend != Backend::Clarabel)?;
    let (a, b) = (own.outcome.as_ref().ok()?, through.outcome.as_ref().ok()?);
    let length = difference::error_length(scene, &b.trajectory);
    let (mut near, mut all) = (0.0_f64, 0.0_f64);
    for (t, difference) in difference::rows(&a.trajectory, &b.trajectory) {
        let difference = difference / length;
        all = all.max(difference);
        if t <= comparison.horizon {
            near = near.max(difference);
        }
    }
    let until = a.trajectory.time().iter().take_while(|t| **t <= comparison.horizon).count();
    let walls = a.trajectory.contact_forces().iter().zip(b.trajectory.contact_forces());
    let pairs = walls.flat_map(|(x, y)| x.iter().zip(y).take(until));
    let force = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let scale = a.residuals.force_scale_n.max(f64::MIN_POSITIVE);
    // Clarabel's solution is polished by the same routine that the condensed solver uses.
    let both = if a.backend == Backend::Condensed {
        "; the same exact solve ends both, so a difference shows only where other walls push"
    } else {
        ""
    };
    Some(format!(
        "{} by {} against every contact step through Clarabel ({} QPs, {} interior-point iterations): \
         displacement differs by at most {near:.1e} of {} \
         up to the horizon ({all:.1e} over the run), force by {:.1e} of the largest{both}",
        own.method.scheme,
        a.backend,
        b.counters.qp_solves,
        b.counters.interior_point_iterations,
        if scene.gap().is_some() { "the gap" } else { "the largest displacement" },
        force / scale
    ))
}
