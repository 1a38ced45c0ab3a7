//! What the check of the first window of a study of wear says of its years, in sentences.

use crate::error::Result;
use crate::study::truncation::Truncation;
use crate::study::verdict::{Verdict, WorkRateVerdict};

/// What half the step and more modes change in the work rates of the first window: the rates of all
/// later ones err alike, and with them the years.
#[must_use]
pub fn remarks(refinement: &Result<Verdict>, truncation: Option<&Result<Truncation>>) -> Vec<String> {
    let half_step = match refinement {
        Ok(verdict) if verdict.findings.is_empty() => told("half the step", &verdict.work_rates),
        Ok(_) => Some("the first window with half the step was refuted: its error is not known".to_owned()),
        Err(error) => Some(format!("the first window was not run with half the step: {error}")),
    };
    let modes = truncation.and_then(|truncation| match truncation {
        Ok(truncation) if truncation.findings.is_empty() => {
            let [own, more] = truncation.modes;
            told(&format!("{more} modes in place of {own}"), &truncation.work_rates)
        }
        Ok(_) => Some("the first window with more modes was refuted: the error of its modes is not known".to_owned()),
        Err(error) => Some(format!("the first window was not run with more modes: {error}")),
    });
    let mut told: Vec<String> = half_step.into_iter().chain(modes).collect();
    if !told.is_empty() {
        told.push(
            "the work rates of later windows, and with them the years, err as those of the first; intervals do not \
             have these errors. Two runs of an irregular motion differ by chance, too: --until-interval tells errors \
             with their intervals"
                .to_owned(),
        );
    }
    told
}

/// What `change` makes of the work rates; `None` without any.
fn told(change: &str, rates: &[WorkRateVerdict]) -> Option<String> {
    let rates: Vec<String> = WorkRateVerdict::hardest(rates).into_iter().map(ToString::to_string).collect();
    (!rates.is_empty()).then(|| format!("the first window with {change}: {}", rates.join("; ")))
}
