//! The refinement verdict of a comparison: every method with half its step.

use crate::case::Case;
use crate::error::Error;
use crate::scheme::{Method, Scheme};
use crate::study::compare::Comparison;
use crate::study::verdict::Verdict;

/// The verdict on every method that ran, and the methods whose check failed, with the reason;
/// `progress` is called with the number of rows done. The step matters for the scheme, not for the
/// solver, so a scheme is checked once, by the first of its solvers.
pub(super) fn check(
    case: &Case,
    comparison: &Comparison,
    progress: &dyn Fn(u64),
) -> (Vec<Option<Verdict>>, Vec<(Method, Error)>) {
    let (mut verdicts, mut failures): (Vec<Option<Verdict>>, _) = (Vec::new(), Vec::new());
    for (index, row) in comparison.rows.iter().enumerate() {
        let same = comparison.rows.iter().take(index).position(|r| r.method.scheme == row.method.scheme);
        let verdict = match (same.and_then(|i| verdicts.get(i)), &row.outcome) {
            (Some(verdict), _) => verdict.clone(),
            (None, Ok(run)) => {
                let verdict = Verdict::of(&case.scene, &row.method, run, &case.time, &mut |_| {});
                verdict.map_err(|error| failures.push((row.method, error))).ok()
            }
            (None, Err(_)) => None,
        };
        verdicts.push(verdict);
        progress(index as u64 + 1);
    }
    (verdicts, failures)
}

/// The effect of half the step, method by method, in one line; each summary has all the numbers.
pub(super) fn line(comparison: &Comparison, verdicts: &[Option<Verdict>]) -> String {
    let (mut parts, mut told) = (Vec::new(), Vec::new());
    for (row, verdict) in comparison.rows.iter().zip(verdicts) {
        let scheme = row.method.scheme;
        if scheme == Scheme::Event || told.contains(&scheme) {
            continue;
        }
        told.push(scheme);
        parts.push(match verdict {
            Some(v) => format!(
                "{scheme}: the displacement {}, impulses {}, contacts {:+}",
                v.displacement_words(),
                v.impulse_words(),
                v.contacts_gained()
            ),
            None => format!("{scheme} was not checked"),
        });
    }
    if parts.is_empty() {
        "the exact scheme has no step".into()
    } else {
        format!("with half the step: {}", parts.join("; "))
    }
}
