//! `work-precision.csv`, `work-precision-walls.csv` and the charts of accuracy against speed.

use super::csv;
use super::figure::{Curve, Figure, Mark, Panel};
use super::floors;
use crate::error::{Result, amount};
use crate::order::sort_by_number;
use crate::scene::Scene;
use crate::scheme::{Method, PenaltyLaw, Scheme};
use crate::study::work_precision::{
    Errors, Measured, MethodPoints, Outcome, Peer, Point, Quantity, WorkPrecision, pareto,
};
use std::path::Path;

/// Errors below this are negligible and are not shown on the chart: a decade less than the least
/// error of the table of cheapest methods, whose points lie below that.
const NEGLIGIBLE: f64 = 1e-9;
/// An error beyond the gap makes a result useless, however cheap: it is not on the front.
const NO_ANSWER: f64 = 1.0;

/// Writes one row per point: errors, times, counters, and the reason where a run failed or was left
/// out.
pub fn table(path: &Path, chart: &WorkPrecision) -> Result<()> {
    let front = front(chart, &[]);
    let rows = chart.series.iter().flat_map(|s| s.points.iter().map(move |p| (&s.method, p)));
    csv::table(path, &header(), rows.map(|(method, point)| row(chart, method, point, &front)))
}

/// Writes one row per point that ran and per wall, for any number of walls: the errors of impulses
/// against the scene and, for a penalty, also against its own springs.
pub fn walls(path: &Path, scene: &Scene, chart: &WorkPrecision) -> Result<()> {
    type Place<'a> = (&'a Method, Option<f64>, &'a Measured, usize, &'a str);
    let error = |errors: Option<&Errors>, wall: usize| number(errors.and_then(|e| e.impulse.get(wall).copied()));
    let columns: [csv::Column<'_, Place<'_>>; 5] = [
        ("method", &|(method, ..)| method.to_string()),
        ("step_s", &|(_, step, ..)| number(*step)),
        ("wall", &|(.., wall)| (*wall).to_owned()),
        ("impulse_error", &|(_, _, m, wall, _)| error(Some(&m.errors), *wall)),
        ("own_impulse_error", &|(_, _, m, wall, _)| error(m.own.as_ref(), *wall)),
    ];
    let points = chart.series.iter().flat_map(|s| s.measured().map(move |(step, m)| (&s.method, step, m)));
    let rows = points.flat_map(|(method, step, m)| {
        let walls = scene.walls.iter().enumerate();
        walls.map(move |(index, wall)| (method, step, m, index, wall.name.as_str()))
    });
    csv::records(path, &columns, rows)
}

fn number(x: Option<f64>) -> String {
    x.map_or_else(String::new, |x| format!("{x:.16e}"))
}

/// The name of the column of an error.
pub(crate) const fn column(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Displacement => "displacement_error_over_gap",
        Quantity::Impulse => "impulse_error_of_the_worst_wall",
        Quantity::ContactTime => "contact_time_error",
    }
}

fn header() -> Vec<String> {
    let [displacement, impulse, contact_time] = Quantity::ALL.map(column);
    let errors = [displacement, "velocity_graph_error", impulse, contact_time, "contacts_missing", "contacts_spurious"];
    let errors = |prefix: &str| errors.map(|name| format!("{prefix}{name}"));
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

/// Why a point has no numbers, an error after the word `failed`; `None` where it has them.
pub(super) fn failure(outcome: &Outcome, failed: &str) -> Option<String> {
    match outcome {
        Outcome::Failed(error) => Some(format!("{failed}{error}")),
        Outcome::LeftOut(seconds) => Some(format!("left out: it would take about {seconds:.1} s")),
        Outcome::Ran(_) => None,
    }
}

fn row(chart: &WorkPrecision, method: &Method, point: &Point, front: &[(f64, f64)]) -> Vec<String> {
    let mut row = vec![method.to_string(), number(point.step)];
    let Some(m) = point.measured() else {
        row.resize(header().len() - 1, String::new());
        row.push(failure(&point.outcome, "failed: ").unwrap_or_default());
        return row;
    };
    let errors = |e: Option<&Errors>| {
        let mut cells = vec![number(e.map(|e| e.displacement)), number(e.map(|e| e.velocity))];
        cells.push(number(e.and_then(Errors::worst_impulse)));
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

/// The points, including those of other programs, that no other point beats in both error and time.
fn front(chart: &WorkPrecision, peers: &[Peer]) -> Vec<(f64, f64)> {
    let own = chart.series.iter().flat_map(|s| s.measured().map(|(_, m)| (m.errors.displacement, m.seconds)));
    pareto(own.chain(peers.iter().map(|p| (p.error, p.seconds))).filter(|p| p.0 <= NO_ANSWER))
}

/// The figures, each with its file name without extension: error across, time up, both logarithmic.
/// `work-precision` has a panel for each error against the scene; for each penalty it shows the
/// modelling error (its floor) and one integrator, since all integrators end at the same floor.
/// `work-precision-penalties` shows all of them against their own springs. `conclusion`, what the
/// chart says in one sentence, stands below the title.
#[must_use]
pub fn charts(title: &str, conclusion: &str, chart: &WorkPrecision, peers: &[Peer]) -> Vec<(&'static str, String)> {
    let title = format!("{title}, t ≤ {} s", amount(chart.horizon.end, 4));
    let mut charts = vec![("work-precision", against_the_scene(&title, conclusion, chart, peers))];
    if !chart.floors.is_empty() {
        charts.push(("work-precision-penalties", against_their_springs(&title, chart)));
    }
    charts
}

fn against_the_scene(title: &str, conclusion: &str, chart: &WorkPrecision, peers: &[Peer]) -> String {
    let mut figure = Figure::new(title, "Error (–)").subtitle(conclusion).log();
    let mut all = Vec::new();
    for quantity in Quantity::ALL {
        let series = shown(chart).map(|(number, series)| (number, label(&series.method), points(series, quantity)));
        let mut curves: Vec<_> = series.collect();
        if quantity == Quantity::Displacement {
            curves
                .extend(programs(peers).into_iter().zip(curves.len()..).map(|((label, points), n)| (n, label, points)));
        }
        if curves.iter().all(|curve| curve.2.is_empty()) {
            continue;
        }
        let mut panel = Panel::new("Wall-clock time (s)").log().heading(heading(quantity));
        let best = pareto(curves.iter().flat_map(|curve| curve.2.iter().copied()).filter(|p| p.0 <= NO_ANSWER));
        panel = panel.curve(Curve::new("Pareto front", best).front());
        for (number, label, points) in curves {
            all.extend(points.iter().map(|p| p.0));
            panel = panel.curve(Curve::new(label, points).marked().look(number));
        }
        for floor in &chart.floors {
            if let Some(error) = floors::of(floor, quantity) {
                panel = panel.mark(Mark::floor(error, floors::mark(floor, error)).upright());
            }
        }
        figure = figure.panel(panel);
    }
    let (low, high) = range(&all);
    figure.range(low, high).to_svg()
}

fn heading(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Displacement => "Displacement: largest difference / gap",
        Quantity::Impulse => "Impulse: difference at the worst wall / all impulses",
        Quantity::ContactTime => "Contact times: largest shift / duration, where no contact is missing",
    }
}

/// The series of the first figure, numbered: for each penalty only the first integrator.
fn shown(chart: &WorkPrecision) -> impl Iterator<Item = (usize, &MethodPoints)> {
    let mut laws = Vec::new();
    let first = move |series: &&MethodPoints| match series.method.scheme {
        Scheme::Penalty { law, .. } if laws.contains(&law) => false,
        Scheme::Penalty { law, .. } => {
            laws.push(law);
            true
        }
        _ => true,
    };
    chart.series.iter().filter(first).enumerate()
}

/// Error and time of each run that has this error.
fn points(series: &MethodPoints, quantity: Quantity) -> Vec<(f64, f64)> {
    let point = |m: &Measured| Some((quantity.of(&m.errors)?, m.seconds));
    series.measured().filter_map(|(_, m)| point(m)).filter(|p| p.0.is_finite()).collect()
}

/// The points of other programs by label, by rising time: error over the gap, and time (s).
pub(crate) fn programs(peers: &[Peer]) -> Vec<(String, Vec<(f64, f64)>)> {
    let mut programs: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for peer in peers {
        let point = (peer.error, peer.seconds);
        match programs.iter_mut().find(|known| known.0 == peer.label()) {
            Some(known) => known.1.push(point),
            None => programs.push((peer.label(), vec![point])),
        }
    }
    programs.iter_mut().for_each(|p| sort_by_number(&mut p.1, |point| point.1));
    programs
}

/// Whole decades that hold the errors between [`NEGLIGIBLE`] and [`NO_ANSWER`]; values beyond are
/// marked at the edge.
fn range(errors: &[f64]) -> (f64, f64) {
    let within = errors.iter().copied().filter(|e| (NEGLIGIBLE..=NO_ANSWER).contains(e));
    let least = within.fold(0.1, f64::min);
    (10_f64.powf((0.9 * least).log10().floor()), NO_ANSWER)
}

fn against_their_springs(title: &str, chart: &WorkPrecision) -> String {
    let mut panel = Panel::new("Wall-clock time (s)").log().heading("Penalties against their own springs");
    let penalties = chart.series.iter().filter(|s| matches!(s.method.scheme, Scheme::Penalty { .. }));
    let mut all = Vec::new();
    for (number, series) in penalties.enumerate() {
        // An error below the uncertainty of its reference is meaningless.
        let known = chart.known(&series.method.scheme);
        let own = |m: &Measured| m.own.as_ref().map(|e| e.displacement).filter(|e| *e > known);
        let points: Vec<_> = series.measured().filter_map(|(_, m)| Some((own(m)?, m.seconds))).collect();
        all.extend(points.iter().map(|p| p.0));
        panel = panel.curve(Curve::new(label(&series.method), points).marked().look(number));
    }
    let (low, high) = range(&all);
    let figure = Figure::new(title, "Largest error of the displacement / gap (–)").log().panel(panel);
    figure.range(low, high).to_svg()
}

/// A short label of a method: `ε = 1e-9, trapezoidal`.
#[must_use]
pub fn label(method: &Method) -> String {
    match method.scheme {
        Scheme::Penalty { law, integrator } => format!("{}, {integrator}", law_label(law)),
        _ => method.to_string(),
    }
}

pub(super) fn law_label(law: PenaltyLaw) -> String {
    match law {
        PenaltyLaw::None => "penalty".to_owned(),
        PenaltyLaw::Quartic { epsilon } => format!("ε = {epsilon:e}"),
        PenaltyLaw::Linear { stiffness, damping: 0.0 } => format!("k = {stiffness:e}"),
        PenaltyLaw::Linear { stiffness, damping } => format!("k = {stiffness:e}, c = {damping:e}"),
    }
}
