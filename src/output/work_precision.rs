//! `work-precision.csv` and `work-precision.svg`.

use super::csv;
use super::figure::{Curve, Figure, Mark, Panel};
use crate::error::Result;
use crate::scene::Scene;
use crate::scheme::{Method, PenaltyLaw, Scheme};
use crate::study::work_precision::{Errors, Measured, Outcome, Peer, Point, WorkPrecision, pareto};
use std::path::Path;

/// Errors above this are all the same: off the chart.
const OFF_THE_CHART: f64 = 10.0;
/// An error beyond the gap is no answer, however cheap: it is not on the front.
const NO_ANSWER: f64 = 1.0;

/// Writes one row a point: errors, times, counters, and the reason where there is none.
///
/// # Errors
/// As [`csv::table`].
pub fn table(path: &Path, scene: &Scene, chart: &WorkPrecision) -> Result<()> {
    let walls: Vec<&str> = scene.walls.iter().map(|w| w.name.as_str()).collect();
    let front = front(chart, &[]);
    let rows = chart.series.iter().flat_map(|s| s.points.iter().map(move |p| (&s.method, p)));
    csv::table(path, &header(&walls), rows.map(|(method, point)| row(chart, method, point, &walls, &front)))
}

fn header(walls: &[&str]) -> Vec<String> {
    let errors = |prefix: &str| {
        let named = |name: &str| format!("{prefix}{name}");
        let mut columns = vec![named("displacement_error_over_gap"), named("velocity_graph_error")];
        columns.extend(walls.iter().map(|wall| named(&format!("impulse_{wall}_error"))));
        columns.extend(["contact_time_error", "contacts_missing", "contacts_spurious"].map(named));
        columns
    };
    let mut header = vec!["method".to_owned(), "step_s".to_owned(), "seconds".to_owned(), "on_front".to_owned()];
    header.extend(errors(""));
    header.extend(errors("own_"));
    header.extend(
        [
            "modelling_error_over_gap",
            "reference_known_to_over_gap",
            "own_compared_until_s",
            "compared_until_s",
            "steps",
            "events",
            "qp_solves",
            "pivots",
            "interior_point_iterations",
            "newton_iterations",
            "flow_evaluations",
            "remark",
        ]
        .map(str::to_owned),
    );
    header
}

fn row(chart: &WorkPrecision, method: &Method, point: &Point, walls: &[&str], front: &[(f64, f64)]) -> Vec<String> {
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| format!("{x:.16e}"));
    let mut row = vec![method.to_string(), number(point.step)];
    let Some(m) = point.measured() else {
        row.resize(header(walls).len() - 1, String::new());
        row.push(match &point.outcome {
            Outcome::Failed(error) => format!("failed: {error}"),
            Outcome::LeftOut(seconds) => format!("left out: it would take about {seconds:.1} s"),
            Outcome::Ran(_) => String::new(),
        });
        return row;
    };
    let errors = |e: Option<&Errors>| {
        let mut cells = vec![number(e.map(|e| e.displacement)), number(e.map(|e| e.velocity))];
        cells.extend((0..walls.len()).map(|i| number(e.and_then(|e| e.impulse.get(i).copied()))));
        cells.push(number(e.and_then(|e| e.contact_time)));
        let count = |n: Option<usize>| n.map_or_else(String::new, |n| n.to_string());
        cells.extend([count(e.map(|e| e.missing)), count(e.map(|e| e.spurious))]);
        cells
    };
    let on_front = front.contains(&(m.errors.displacement, m.seconds));
    let (scene, own) = (errors(Some(&m.errors)), errors(m.own.as_ref()));
    row.extend([number(Some(m.seconds)), if on_front { "yes" } else { "" }.to_owned()]);
    row.extend(scene);
    row.extend(own);
    let floor = chart.floor(&method.scheme).and_then(|f| f.errors.as_ref());
    row.push(number(floor.map(|e| e.displacement)));
    row.push(number(Some(chart.known(&method.scheme))));
    row.push(number(chart.floor(&method.scheme).map(|f| f.end)));
    row.push(number(Some(chart.horizon.end)));
    let c = &m.counters;
    let counters = [
        c.steps,
        c.events,
        c.qp_solves,
        c.pivots,
        c.interior_point_iterations,
        c.newton_iterations,
        c.flow_evaluations,
    ];
    row.extend(counters.map(|n| n.to_string()));
    row.push(m.notes.join("; "));
    row
}

/// The points, other programs' too, that none beats in both error and time.
fn front(chart: &WorkPrecision, peers: &[Peer]) -> Vec<(f64, f64)> {
    let own = chart.series.iter().flat_map(|s| s.measured().map(|(_, m)| (m.errors.displacement, m.seconds)));
    pareto(own.chain(peers.iter().map(|p| (p.error, p.seconds))).filter(|p| p.0 <= NO_ANSWER))
}

/// The chart: error across, time up, both logarithmic. One panel holds errors against the scene, with the floor of each penalty; a second, where
/// there are penalties, their errors against their own springs. The first shows one integrator of each penalty: below the floor they all end
/// alike.
#[must_use]
pub fn chart(title: &str, chart: &WorkPrecision, peers: &[Peer]) -> String {
    let mut first = Panel::new("Wall-clock time (s)").log();
    let mut second = Panel::new("Wall-clock time (s)").log();
    let penalties = !chart.floors.is_empty();
    if penalties {
        first = first.heading("Against the walls of the scene; of each penalty, one integrator");
        second = second.heading("Penalties against their own springs");
    }
    first = first.curve(Curve::new("Pareto front", front(chart, peers)).front());
    let mut laws = Vec::new();
    for (number, series) in chart.series.iter().enumerate() {
        let curve = |error: &dyn Fn(&Measured) -> Option<f64>| {
            let points = series.measured().filter_map(|(_, m)| Some((error(m)?, m.seconds)));
            let label = label(&series.method);
            Curve::new(label, points.filter(|p| p.0 < OFF_THE_CHART)).marked().look(number)
        };
        let law = if let Scheme::Penalty { law, .. } = series.method.scheme { Some(law) } else { None };
        if law.is_none_or(|law| !laws.contains(&law)) {
            first = first.curve(curve(&|m| Some(m.errors.displacement)));
        }
        if law.is_some() {
            // Below what its reference is known to, an error says nothing.
            let known = chart.known(&series.method.scheme);
            second = second.curve(curve(&|m| m.own.as_ref().map(|e| e.displacement).filter(|e| *e > known)));
        }
        laws.extend(law);
    }
    let mut labels: Vec<String> = Vec::new();
    for peer in peers {
        if !labels.contains(&peer.label()) {
            labels.push(peer.label());
        }
    }
    for (number, label) in labels.iter().enumerate() {
        let mut points: Vec<_> = peers.iter().filter(|p| p.label() == *label).map(|p| (p.error, p.seconds)).collect();
        points.retain(|p| p.0 < OFF_THE_CHART);
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        first = first.curve(Curve::new(label, points).marked().look(chart.series.len() + number));
    }
    for floor in &chart.floors {
        if let Some(errors) = &floor.errors {
            first = first.mark(Mark::floor(errors.displacement, law_label(floor.law)).upright());
        }
    }
    let title = format!("{title}, t ≤ {} s", significant(chart.horizon.end));
    let figure = Figure::new(title, "Largest error of the displacement / gap (–)").log().panel(first);
    if penalties { figure.panel(second).to_svg() } else { figure.to_svg() }
}

/// A method in few characters: `ε = 1e-9, trapezoidal`.
fn label(method: &Method) -> String {
    match method.scheme {
        Scheme::Penalty { law, integrator } => format!("{}, {integrator}", law_label(law)),
        _ => method.to_string(),
    }
}

fn law_label(law: PenaltyLaw) -> String {
    match law {
        PenaltyLaw::Quartic { epsilon } => format!("ε = {epsilon:e}"),
        PenaltyLaw::Linear { stiffness, damping: 0.0 } => format!("k = {stiffness:e}"),
        PenaltyLaw::Linear { stiffness, damping } => format!("k = {stiffness:e}, c = {damping:e}"),
    }
}

/// Four digits at most.
fn significant(x: f64) -> String {
    format!("{x:.3e}").parse::<f64>().map_or_else(|_| x.to_string(), |x| x.to_string())
}
