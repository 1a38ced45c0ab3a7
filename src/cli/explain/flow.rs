//! The fluid-elastic margins of tubes in a cross flow, in words.

use crate::case::{Case, margin_in_words};
use crate::scene::{FlowMargin, FluidElastic};

/// Most modes that are listed one by one, with supports inactive and active alike.
const MOST_LISTED: usize = 6;

/// The margin of each mode with supports inactive and active; nothing where the case has no table
/// `flow`.
pub(super) fn margins(case: &Case) -> Vec<String> {
    let Some(found) = &case.fluid_elastic else { return Vec::new() };
    let mut lines = vec![format!(
        "Connors' criterion with K = {}: a mode is unstable where its margin V_c/V_e is below 1",
        found.connors
    )];
    for (supports, margins) in [("inactive", &found.inactive), ("active", &found.active)] {
        let line = |one: &FlowMargin| {
            let margin = one
                .margin
                .map_or("no flow reaches it".to_owned(), |margin| format!("margin {}", margin_in_words(margin)));
            format!(
                "supports {supports}: {:.4} Hz{}, ζ {:.3} %: V_e {:.4} m/s, V_c {:.4} m/s, {margin}",
                one.frequency_hz,
                one.of_bodies(),
                100.0 * one.damping_ratio,
                one.effective_velocity_m_per_s,
                one.critical_velocity_m_per_s
            )
        };
        lines.extend(margins.iter().take(MOST_LISTED).map(line));
        let others = margins.get(MOST_LISTED..).unwrap_or_default();
        if let Some(least) = FluidElastic::least(others) {
            lines.push(format!("{}; the least of {} modes more", line(least), others.len()));
        }
    }
    lines
}
