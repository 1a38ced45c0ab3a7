//! The cheapest methods of a chart: the table, and the conclusion in one sentence, for the
//! terminal, the picture and the page of the report.

use super::table::Table;
use super::work_precision::label;
use crate::scene::Scene;
use crate::scheme::SchemeKind;
use crate::study::work_precision::{Peer, Quantity, WorkPrecision};
use serde_json::{Value, json};

/// The errors for which the table names the cheapest methods, and the words for them.
const TOLERANCES: [(f64, &str); 8] = [
    (1e-1, "10 %"),
    (1e-2, "1 %"),
    (1e-3, "0.1 %"),
    (1e-4, "1e-4"),
    (1e-5, "1e-5"),
    (1e-6, "1e-6"),
    (1e-7, "1e-7"),
    (1e-8, "1e-8"),
];

/// The error that the conclusions are about: what an engineer asks for.
const ASKED: f64 = 1e-2;

/// What the methods of other programs are called.
const OTHER: &str = "other program";

/// An error within a tolerance, and the cheapest method of a kind that has it.
#[derive(Debug, Clone)]
pub struct Best {
    quantity: Quantity,
    tolerance: f64,
    within: &'static str,
    kind: &'static str,
    method: Option<Cheapest>,
    /// Where no method has it: how near the kind comes.
    missed: String,
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
            let missed = missed(chart, kind, quantity);
            for (tolerance, within) in TOLERANCES {
                let best = chart.cheapest(kind, quantity, tolerance);
                let method = best.map(|(series, step, m)| Cheapest {
                    name: series.method.to_string(),
                    short: label(&series.method),
                    step,
                    seconds: m.seconds,
                    reached: quantity.of(&m.errors).unwrap_or(f64::NAN),
                });
                rows.push(Best { quantity, tolerance, within, kind: kind.name(), method, missed: missed.clone() });
            }
        }
    }
    let least = peers.iter().map(|peer| peer.error).reduce(f64::min);
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
        let missed = above(least);
        rows.push(Best { quantity: Quantity::Displacement, tolerance, within, kind: OTHER, method, missed });
    }
    rows
}

/// How near a kind of methods comes to an error that it does not reach. Springs have a floor, to
/// which ever finer steps lead; other methods stay above an error with the steps that were tried.
fn missed(chart: &WorkPrecision, kind: SchemeKind, quantity: Quantity) -> String {
    let of_kind = || chart.series.iter().filter(|series| series.method.scheme.entry().kind == kind);
    // With the finest steps; what a coarse run has by chance does not count, as in the table.
    let finest = of_kind().filter_map(|series| quantity.of(&series.measured().last()?.1.errors));
    let finest = finest.filter(|error| error.is_finite()).reduce(f64::min);
    let floor = |scheme| quantity.of(chart.floor(scheme)?.errors.as_ref()?).filter(|error| error.is_finite());
    let floors: Option<Vec<f64>> = of_kind().map(|series| floor(&series.method.scheme)).collect();
    match floors.and_then(|floors| floors.into_iter().reduce(f64::min)) {
        Some(least) => format!("tends to {} at best", percent(least)),
        None => above(finest),
    }
}

fn above(least: Option<f64>) -> String {
    least.map_or_else(|| "no result".to_owned(), |least| format!("stays above {}", percent(least)))
}

/// The rows as JSON.
#[must_use]
pub fn rows(best: &[Best]) -> Value {
    best.iter().map(Best::document).collect()
}

/// The tables for the terminal, one for each error: a row for each tolerance, a column for each
/// kind.
#[must_use]
pub fn tables(best: &[Best]) -> Vec<Table> {
    let of = |group: &[Best]| {
        let kinds: Vec<&[Best]> = group.chunk_by(|a, b| a.kind == b.kind).collect();
        let quantity = group.first().map_or("", |row| row.quantity.name());
        let header: Vec<&str> = std::iter::once(quantity).chain(kinds.iter().map(|kind| kind[0].kind)).collect();
        let line = |(i, (_, within)): (usize, (f64, &str))| {
            std::iter::once(within.to_owned()).chain(kinds.iter().map(|kind| kind[i].cell())).collect()
        };
        Table::new(&header, TOLERANCES.into_iter().enumerate().map(line).collect())
    };
    let mut sorted: Vec<Best> = best.to_vec();
    sorted.sort_by_key(|row| Quantity::ALL.iter().position(|quantity| *quantity == row.quantity));
    sorted.chunk_by(|a, b| a.quantity == b.quantity).map(of).collect()
}

/// What the chart says of an error, in one sentence: what 1 % costs with each kind of method, or
/// how near a kind comes that does not reach it.
#[must_use]
pub fn conclusion(scene: &Scene, best: &[Best], quantity: Quantity) -> String {
    let asked = best.iter().filter(|row| row.quantity == quantity && row.tolerance == ASKED);
    let parts: Vec<String> = asked
        .map(|row| match &row.method {
            Some(method) => format!("{} {}", method.short, time(method.seconds)),
            None => format!("{} {}", row.kind, row.missed),
        })
        .collect();
    let of = match quantity {
        Quantity::Displacement if scene.gap().is_none() => "reference length",
        _ => whole(quantity),
    };
    format!("for 1 % of the {of}: {}", parts.join(", "))
}

/// What an error is a share of.
pub(super) const fn whole(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Displacement => "gap",
        Quantity::Impulse => "impulse",
        Quantity::ContactTime => "duration",
    }
}

/// A share of two digits, rounded down: what has this share is not below it. As a percentage,
/// unless it is far from 1.
pub(super) fn percent(x: f64) -> String {
    if x <= 0.0 {
        return "0 %".to_owned();
    }
    let unit = 10_f64.powf(x.log10().floor() - 1.0);
    let down = (x / unit).floor() * unit;
    let digits = |x: f64| format!("{x:.1e}").parse::<f64>().unwrap_or(x);
    if (1e-4..1e2).contains(&down) { format!("{} %", digits(100.0 * down)) } else { format!("{:e}", digits(down)) }
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
    fn document(&self) -> Value {
        let method = self.method.as_ref();
        json!({
            "error": self.quantity.name(),
            "tolerance": self.tolerance,
            "within": self.within,
            "kind": self.kind,
            "method": method.map(|m| &m.name),
            "label": method.map(|m| &m.short),
            "step_s": method.and_then(|m| m.step),
            "seconds": method.map(|m| m.seconds),
            "reached": method.map(|m| m.reached),
            "missed": if method.is_none() { Some(&self.missed) } else { None },
        })
    }

    /// The cell for the terminal: method, time and step.
    fn cell(&self) -> String {
        let Some(method) = &self.method else { return self.missed.clone() };
        let step = method.step.map_or_else(String::new, |step| format!(", h = {}", time(step)));
        format!("{} {}{step}", method.short, time(method.seconds))
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
        let shares = [0.063_09, 0.0999, 1.99, 3.19e-4, 3.19e-5, 0.0, 1.27e6].map(percent);
        assert_eq!(shares, ["6.3 %", "9.9 %", "190 %", "0.031 %", "3.1e-5", "0 %", "1.2e6"]);
    }
}
