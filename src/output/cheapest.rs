//! The cheapest methods of a chart: the table, and the conclusion in one sentence, for the terminal
//! and the page of the report.

use super::table::Table;
use super::work_precision::label;
use crate::scene::Scene;
use crate::scheme::SchemeKind;
use crate::study::work_precision::{Peer, Quantity, WorkPrecision};
use serde_json::{Value, json};

/// The errors for which the table names the cheapest methods.
const TOLERANCES: [(f64, &str); 5] = [(0.1, "10 %"), (1e-2, "1 %"), (1e-3, "0.1 %"), (1e-6, "1e-6"), (1e-9, "1e-9")];

/// The error of the displacement that the conclusion is about: what an engineer asks for.
const ASKED: f64 = 1e-2;

/// What the methods of other programs are called.
const OTHER: &str = "other program";

/// A row of the table: an error within a tolerance, and the cheapest method of a kind that has it.
#[derive(Debug, Clone)]
pub struct Best {
    quantity: Quantity,
    tolerance: f64,
    within: &'static str,
    kind: &'static str,
    exact: bool,
    method: Option<Cheapest>,
}

/// The method that reaches a tolerance in the least time.
#[derive(Debug, Clone)]
struct Cheapest {
    name: String,
    short: String,
    step: Option<f64>,
    seconds: f64,
    reached: f64,
}

/// For each error and tolerance the cheapest method of each kind, and of the other programs.
#[must_use]
pub fn cheapest(chart: &WorkPrecision, peers: &[Peer]) -> Vec<Best> {
    let mut rows = Vec::new();
    for quantity in Quantity::ALL {
        let present = |kind: &SchemeKind| chart.series.iter().any(|s| s.method.scheme.entry().kind == *kind);
        for kind in SchemeKind::ALL.into_iter().filter(present) {
            for (tolerance, within) in TOLERANCES {
                let best = chart.cheapest(kind, quantity, tolerance);
                let method = best.map(|(series, step, m)| Cheapest {
                    name: series.method.to_string(),
                    short: label(&series.method),
                    step,
                    seconds: m.seconds,
                    reached: quantity.of(&m.errors).unwrap_or(f64::NAN),
                });
                rows.push(Best {
                    quantity,
                    tolerance,
                    within,
                    kind: kind.name(),
                    exact: kind == SchemeKind::Exact,
                    method,
                });
            }
        }
    }
    for (tolerance, within) in TOLERANCES.into_iter().filter(|_| !peers.is_empty()) {
        let reached = peers.iter().filter(|p| p.error <= tolerance);
        let best = reached.min_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let method = best.map(|p| Cheapest {
            name: p.label(),
            short: p.label(),
            step: None,
            seconds: p.seconds,
            reached: p.error,
        });
        rows.push(Best { quantity: Quantity::Displacement, tolerance, within, kind: OTHER, exact: false, method });
    }
    rows
}

/// The rows as JSON; `shown` marks those of the table for the terminal.
#[must_use]
pub fn rows(best: &[Best]) -> Value {
    groups(best)
        .flat_map(|(shown, group)| group.iter().enumerate().map(move |(i, row)| row.document(i < shown)))
        .collect()
}

/// The table for the terminal: of each error and kind the tolerances that are reached, and the
/// first that is not; of the exact scheme one row.
#[must_use]
pub fn table(best: &[Best]) -> Table {
    let header = ["error within", "kind", "cheapest method", "step (s)", "time (s)"];
    let lines = groups(best).flat_map(|(shown, group)| group.iter().take(shown).map(Best::line)).collect();
    Table::new(&header, lines)
}

/// The rows of each error and kind, and how many of them the table shows.
fn groups(best: &[Best]) -> impl Iterator<Item = (usize, &[Best])> {
    best.chunk_by(|a, b| a.quantity == b.quantity && a.kind == b.kind).map(|group| {
        let reached = group.iter().take_while(|row| row.method.is_some()).count();
        (if group.iter().any(|row| row.exact) { 1 } else { reached + 1 }, group)
    })
}

/// What the chart says, in one sentence: what a displacement known to 1 % of the gap costs with
/// each kind of method, or how near a kind comes that does not reach it.
#[must_use]
pub fn conclusion(scene: &Scene, chart: &WorkPrecision, peers: &[Peer], best: &[Best]) -> String {
    let asked = best.iter().filter(|row| row.quantity == Quantity::Displacement && row.tolerance == ASKED);
    let parts = asked.map(|row| match &row.method {
        Some(method) => format!("{} {}", method.short, time(method.seconds)),
        None => match least(chart, peers, row.kind) {
            Some(error) => format!("{} stays above {}", row.kind, percent(error)),
            None => format!("{}: no run has a result", row.kind),
        },
    });
    let parts: Vec<String> = parts.collect();
    let of = if scene.walls.is_empty() && scene.supports.is_empty() { "reference length" } else { "gap" };
    format!("for 1 % of the {of}: {}", parts.join(", "))
}

/// The least error of the displacement that a kind comes to with its finest steps; one that a
/// coarse run has by chance does not count, as in the table.
fn least(chart: &WorkPrecision, peers: &[Peer], kind: &str) -> Option<f64> {
    let of_kind = chart.series.iter().filter(|series| series.method.scheme.entry().kind.name() == kind);
    let own = of_kind.filter_map(|series| series.measured().last().map(|(_, m)| m.errors.displacement));
    let others = peers.iter().filter(|_| kind == OTHER).map(|peer| peer.error);
    own.chain(others).filter(|error| error.is_finite()).reduce(f64::min)
}

/// A share as a percentage of two digits, rounded down: what has this share is not below it.
fn percent(x: f64) -> String {
    let percent = 100.0 * x;
    if percent <= 0.0 {
        return "0 %".to_owned();
    }
    let unit = 10_f64.powf(percent.log10().floor() - 1.0);
    let down: f64 = format!("{:.1e}", (percent / unit).floor() * unit).parse().unwrap_or(percent);
    if down < 1e4 { format!("{down} %") } else { format!("{down:e} %") }
}

/// A time to two digits, in the unit that suits it.
pub(super) fn time(seconds: f64) -> String {
    let rounded: f64 = format!("{seconds:.1e}").parse().unwrap_or(seconds);
    let units = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns")];
    let (unit, name) = units.into_iter().find(|(unit, _)| rounded >= *unit).unwrap_or((1e-9, "ns"));
    let value: f64 = format!("{:.1e}", rounded / unit).parse().unwrap_or(rounded);
    format!("{value} {name}")
}

impl Best {
    fn document(&self, shown: bool) -> Value {
        let method = self.method.as_ref();
        json!({
            "error": self.quantity.name(),
            "tolerance": self.tolerance,
            "within": self.within(),
            "kind": self.kind,
            "method": method.map(|m| &m.name),
            "label": method.map(|m| &m.short),
            "step_s": method.and_then(|m| m.step),
            "seconds": method.map(|m| m.seconds),
            "reached": method.map(|m| m.reached),
            "shown": shown,
        })
    }

    /// The tolerance in words; of the exact scheme the error that it has.
    fn within(&self) -> String {
        match &self.method {
            Some(method) if self.exact => format!("{:.0e}", method.reached),
            _ => self.within.to_owned(),
        }
    }

    /// The row for the terminal.
    fn line(&self) -> Vec<String> {
        let mut line = vec![format!("{} {}", self.quantity.name(), self.within()), self.kind.to_owned()];
        match &self.method {
            Some(m) => line.extend([
                m.short.clone(),
                m.step.map_or_else(|| "-".into(), |h| format!("{h:.1e}")),
                format!("{:.1e}", m.seconds),
            ]),
            None => line.extend(["none of the steps tried".into(), "-".into(), "-".into()]),
        }
        line
    }
}

#[cfg(test)]
mod tests {
    use super::{percent, time};

    #[test]
    fn times_and_shares_have_two_digits() {
        let times = [3.475e-6, 1.17e-3, 0.0999, 12.34, 1e-10, 9.99e-4].map(time);
        assert_eq!(times, ["3.5 µs", "1.2 ms", "100 ms", "12 s", "0.1 ns", "1 ms"]);
        // Rounded down, so that a run of this error is not below it.
        let shares = [0.063_09, 0.0999, 1.99, 3e-5, 0.0, 1e6].map(percent);
        assert_eq!(shares, ["6.3 %", "9.9 %", "190 %", "0.003 %", "0 %", "1e8 %"]);
    }
}
