//! The largest stable step of each scheme on a case, with the reason: the table, and the conclusion
//! in one sentence, for the terminal and the page of the report.

use super::cheapest::time;
use super::table::Table;
use super::work_precision::label;
use crate::order::sort_by_number;
use crate::scheme::{Method, Scheme};
use crate::study::stability::class::{FAST, LOSS, MISCOUNTED};
use crate::study::stability::family::Parameter;
use crate::study::stability::impact::ImpactMap;
use crate::study::stability::plan::{Maps, Row};
use serde_json::{Value, json};

/// One scheme, with its largest stable step.
#[derive(Debug, Clone)]
pub struct StableStep {
    scheme: Scheme,
    /// Its name without what the tables of a case share.
    label: String,
    /// The largest step that is stable together with all smaller ones, s; `None` where there is
    /// none.
    step: Option<f64>,
    /// The same, by the frequency of the scene.
    by_omega: Option<f64>,
    /// h²k_w/m at this step, for a penalty.
    kappa: Option<f64>,
    /// Smallest and largest restitution of one free impact on a rigid wall; for a penalty at
    /// h²k_w/m = 1. `None` without a rigid wall.
    restitution: Option<(f64, f64)>,
    /// The run with the smallest step that is not stable: its step (s), class and reason.
    beyond: Option<(f64, &'static str, String)>,
}

/// The largest stable step of each scheme with the case's own parameters, the largest first.
#[must_use]
pub fn stable_steps(maps: &Maps, impacts: &[ImpactMap]) -> Vec<StableStep> {
    let mut all: Vec<StableStep> = maps.own().map(|row| stable_step(row, maps, impacts)).collect();
    sort_by_number(&mut all, |a| -a.step.unwrap_or(0.0));
    all
}

fn stable_step(row: &Row, maps: &Maps, impacts: &[ImpactMap]) -> StableStep {
    let scheme = row.subject.scheme;
    let step = row.stable.as_ref().and_then(|stable| stable.step);
    let beyond = row.stable.as_ref().and_then(|stable| stable.beyond.as_ref());
    StableStep {
        scheme,
        label: label(&Method::new(scheme)),
        step,
        by_omega: step.map(|h| h * maps.scale.omega),
        kappa: step.and_then(|h| row.subject.kappa(&maps.scale, h)),
        restitution: restitution(&scheme, impacts).filter(|_| row.subject.parameter != Parameter::WallStiffness),
        beyond: beyond.map(|cell| (cell.step, cell.class.name(), cell.reason.clone())),
    }
}

/// Range of the restitution over all phases; for a penalty at h²k_w/m = 1.
fn restitution(scheme: &Scheme, impacts: &[ImpactMap]) -> Option<(f64, f64)> {
    let same = |map: &&ImpactMap| match (map.scheme, *scheme) {
        (Scheme::Penalty { integrator: a, .. }, Scheme::Penalty { integrator: b, .. }) => {
            a == b && map.kappa == Some(1.0)
        }
        (a, b) => a == b,
    };
    impacts.iter().find(same).and_then(ImpactMap::range)
}

/// A range of restitutions: one number where it does not depend on the phase.
pub(crate) fn range_text((low, high): (f64, f64)) -> String {
    let shown = |e: f64| if e < 100.0 { format!("{e:.4}") } else { format!("{e:.0}") };
    if high - low < 1e-9 { shown(low) } else { format!("{} to {}", shown(low), shown(high)) }
}

/// When a run counts as stable, in one sentence.
#[must_use]
pub fn criterion() -> String {
    format!(
        "a step is stable where it and all smaller ones of the grid leave the motion of the right kind: no energy \
         gained at the walls, at most {:.0} % lost per impact beyond restitution, contacts within a factor of \
         {MISCOUNTED} and speeds within {FAST} of a fine run; that is no accuracy, which chart measures",
        100.0 * LOSS
    )
}

/// What is stable, in one sentence: the largest step of each scheme, of the penalties together.
#[must_use]
pub fn conclusion(steps: &[StableStep]) -> String {
    let (penalties, others): (Vec<&StableStep>, Vec<&StableStep>) = steps.iter().partition(|one| one.is_penalty());
    let mut parts: Vec<String> = Vec::new();
    let stable: Vec<&StableStep> = others.iter().copied().filter(|one| one.step.is_some()).collect();
    for group in stable.chunk_by(|a, b| a.step_text() == b.step_text()) {
        let names: Vec<&str> = group.iter().map(|one| one.label.as_str()).collect();
        parts.push(format!(
            "{} {}",
            names.join(" and "),
            group.iter().map(|one| one.step_text()).next().unwrap_or_default()
        ));
    }
    if let Some((best, worst)) =
        penalties.iter().find(|one| one.step.is_some()).zip(penalties.iter().rfind(|one| one.step.is_some()))
    {
        parts.push(format!("penalties {} to {}", worst.step_text(), best.step_text()));
    }
    let none = others.iter().filter(|one| one.step.is_none()).map(|one| match &one.beyond {
        Some((_, class, _)) => format!("{} ({class})", one.label),
        None => one.label.clone(),
    });
    let mut none: Vec<String> = none.collect();
    let lost = penalties.iter().filter(|one| one.step.is_none()).count();
    if lost > 0 {
        none.push(format!("{lost} of {} penalties", penalties.len()));
    }
    if !none.is_empty() {
        parts.push(format!("none for {}", none.join(" and ")));
    }
    format!("largest stable step: {}", parts.join(", "))
}

/// The column of restitutions.
const IMPACT: &str = "impact on a rigid wall";

/// The table for the terminal.
#[must_use]
pub fn table(steps: &[StableStep]) -> Table {
    let mut headers = vec!["scheme", "largest stable step (s)", "hω", "h²k_w/m", IMPACT, "beyond it"];
    let mut rows: Vec<Vec<String>> = steps.iter().map(StableStep::line).collect();
    if steps.iter().all(|one| one.restitution.is_none()) {
        headers.retain(|name| *name != IMPACT);
        rows.iter_mut().for_each(|row| drop(row.remove(row.len() - 2)));
    }
    Table::new(&headers, rows)
}

/// The rows as JSON.
#[must_use]
pub fn rows(steps: &[StableStep]) -> Value {
    steps.iter().map(StableStep::document).collect()
}

impl StableStep {
    fn is_penalty(&self) -> bool {
        matches!(self.scheme, Scheme::Penalty { .. })
    }

    /// The step to two digits, and no more than it is; where all steps of the grid are stable, the
    /// largest of them.
    fn step_text(&self) -> String {
        let least = if self.beyond.is_none() { "at least " } else { "" };
        self.step.map_or_else(|| "none".to_owned(), |h| format!("{least}{}", time(rounded_down(h))))
    }

    fn line(&self) -> Vec<String> {
        let at = if self.is_penalty() { " at h²k_w/m = 1" } else { "" };
        let short = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:.2e}"));
        vec![
            self.label.clone(),
            self.step.map_or_else(|| "none".to_owned(), |h| format!("{:.1e}", rounded_down(h))),
            short(self.by_omega),
            short(self.kappa),
            self.restitution.map_or_else(String::new, |range| format!("{}{at}", range_text(range))),
            self.beyond.as_ref().map_or_else(
                || "stable on the whole grid".to_owned(),
                |(step, class, reason)| format!("{step:.2e} s {class}: {reason}"),
            ),
        ]
    }

    fn document(&self) -> Value {
        json!({
            "scheme": self.scheme.to_string(),
            "label": self.label,
            "largest_stable_step_s": self.step,
            "largest_stable_step_times_omega": self.by_omega,
            "kappa": self.kappa,
            "restitution": self.restitution.map(|(least, largest)| json!({ "least": least, "largest": largest })),
            "beyond": self.beyond.as_ref().map(|(step, class, reason)| json!({
                "step_s": step,
                "class": class,
                "reason": reason,
            })),
        })
    }
}

/// A step (s) to two digits, no more than it is: a longer one was not tried, or is not stable.
fn rounded_down(step: f64) -> f64 {
    let unit = 10f64.powf(step.log10().floor() - 1.0);
    // A step of two digits is a little less than as many units by rounding.
    (step / unit + 1e-9).floor() * unit
}

#[cfg(test)]
mod tests {
    use super::{StableStep, conclusion, rounded_down};
    use crate::scheme::{Integrator, PenaltyLaw, Scheme};

    fn one(scheme: Scheme, label: &str, step: Option<f64>, class: Option<&'static str>) -> StableStep {
        let beyond = class.map(|class| (1.0, class, "a reason".to_owned()));
        StableStep { scheme, label: label.to_owned(), step, by_omega: None, kappa: None, restitution: None, beyond }
    }

    #[test]
    fn a_step_is_not_told_longer_than_it_is() {
        for (step, told) in [(0.18638, 0.18), (0.05, 0.05), (2e-5, 2e-5), (9.99e-4, 9.9e-4), (1.0, 1.0)] {
            assert!((rounded_down(step) / told - 1.0).abs() < 1e-12, "{step}");
        }
    }

    #[test]
    fn the_conclusion_names_steps_and_schemes_without_any() {
        let law = PenaltyLaw::Quartic { epsilon: 1e-9 };
        let springs = Scheme::Penalty { law, integrator: Integrator::Trapezoidal };
        let steps = [
            one(Scheme::Located, "located", Some(0.0729), Some("another-motion")),
            one(Scheme::GeneralizedAlpha { rho: 0.8 }, "generalized-alpha", Some(0.0721), Some("another-motion")),
            one(springs, "a", Some(0.05), Some("diverged")),
            one(Scheme::PaoliSchatzman, "paoli-schatzman", Some(0.01), None),
            one(springs, "b", Some(2e-5), Some("diverged")),
            one(Scheme::Newmark, "newmark", None, Some("diverged")),
            one(springs, "c", None, Some("diverged")),
        ];
        assert_eq!(
            conclusion(&steps),
            "largest stable step: located and generalized-alpha 72 ms, paoli-schatzman at least 10 ms, penalties 20 µs \
             to 50 ms, none for newmark (diverged) and 1 of 3 penalties"
        );
    }
}
