//! `branches.csv`, `special.csv`, `branches.json` and the picture of a graph of branches.

use super::csv::{self, digits};
use super::figure::{Line, Scale, Scatter, Sign};
use crate::error::{Error, Result};
use crate::orbit::branch::{End, Graph, Label, Point, Special};
use crate::scene::Scene;
use serde_json::{Value, json};
use std::path::Path;

/// A graph with what names its columns.
#[derive(Debug)]
pub struct Drawn<'a> {
    /// The branches.
    pub graph: &'a Graph,
    /// The column of the key: its path and unit.
    pub column: String,
    /// The axis of the key.
    pub label: String,
    /// The scene at the start, for the names of walls.
    pub scene: &'a Scene,
}

/// A finite number, or an empty cell.
fn cell(x: f64) -> String {
    digits(x.is_finite().then_some(x))
}

impl Drawn<'_> {
    fn header(&self, first: &[&str]) -> Vec<String> {
        let fixed = [
            self.column.as_str(),
            "period",
            "symmetric",
            "signature",
            "label",
            "stable",
            "admissible",
            "period_s",
            "least_speed_m_per_s",
            "least_gap_m",
            "displacement_max_m",
            "multiplier_1_re",
            "multiplier_1_im",
            "multiplier_2_re",
            "multiplier_2_im",
        ];
        let mut header: Vec<String> = first.iter().chain(&fixed).map(|&name| name.to_owned()).collect();
        for event in 1..=self.events() {
            header.extend([format!("phase_{event}_cycles"), format!("speed_{event}_m_per_s")]);
        }
        header
    }

    fn events(&self) -> usize {
        let points = self.graph.branches.iter().flat_map(|branch| branch.points.first());
        points.map(|point| point.orbit.phases.len()).max().unwrap_or(0)
    }

    fn row(&self, first: Vec<String>, point: &Point, label: &str) -> Vec<String> {
        let orbit = &point.orbit;
        let mut row = first;
        let yes = |truth: bool| if truth { "1" } else { "0" }.to_owned();
        row.extend([
            cell(point.value),
            orbit.signature.periods.to_string(),
            yes(orbit.signature.symmetric),
            orbit.signature.written(self.scene),
            label.to_owned(),
            yes(point.floquet.is_stable()),
            yes(point.admissible.holds()),
            cell(orbit.period()),
            cell(point.admissible.least_speed),
            point.admissible.nearest.map_or_else(String::new, |nearest| cell(nearest.gap)),
            cell(point.admissible.largest),
        ]);
        row.extend(point.floquet.multipliers.iter().flatten().map(|x| cell(*x)));
        for event in 0..self.events() {
            let of = |values: &[f64]| values.get(event).map_or_else(String::new, |x| cell(*x));
            row.extend([of(&orbit.phases), of(&orbit.speeds)]);
        }
        row
    }

    /// Writes one row per point of each branch, in order along it; special points stand among them
    /// with their label.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be written.
    pub fn branches(&self, path: &Path) -> Result<()> {
        let mut rows = Vec::new();
        for (number, branch) in self.graph.branches.iter().enumerate() {
            let mut count = 0;
            for (index, point) in branch.points.iter().enumerate() {
                let passed = self.graph.specials.iter().filter(|s| s.branch == number && s.after == index);
                for special in passed {
                    count += 1;
                    let first = vec![(number + 1).to_string(), count.to_string()];
                    rows.push(self.row(first, &special.point, special.label.name()));
                }
                // A branch that ends at a special point has it as its last.
                if self.graph.specials.iter().any(|s| s.branch == number && s.point == *point) {
                    continue;
                }
                count += 1;
                rows.push(self.row(vec![(number + 1).to_string(), count.to_string()], point, ""));
            }
            for special in self.graph.specials.iter().filter(|s| s.branch == number && s.after >= branch.points.len()) {
                count += 1;
                let first = vec![(number + 1).to_string(), count.to_string()];
                rows.push(self.row(first, &special.point, special.label.name()));
            }
        }
        csv::table(path, &self.header(&["branch", "point"]), rows.into_iter())
    }

    /// Writes one row per special point, with the branches that it leads to.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be written.
    pub fn specials(&self, path: &Path) -> Result<()> {
        let rows = self.graph.specials.iter().enumerate().map(|(number, special)| {
            let leads = special.leads_to.iter().map(|branch| (branch + 1).to_string()).collect::<Vec<_>>().join(" ");
            let first = vec![
                (number + 1).to_string(),
                (special.branch + 1).to_string(),
                leads,
                special.reason.clone().unwrap_or_default(),
            ];
            self.row(first, &special.point, special.label.name())
        });
        csv::table(path, &self.header(&["special", "branch", "leads_to", "not_followed_because"]), rows)
    }

    /// The graph as a document: branches with their ends, and special points.
    #[must_use]
    pub fn document(&self) -> Value {
        let end = |end: &Option<End>| match end {
            None => json!("special point"),
            Some(end) => json!(ended(end)),
        };
        let branches = self.graph.branches.iter().enumerate().map(|(number, branch)| {
            let (first, last) = (branch.points.first(), branch.points.last());
            json!({
                "branch": number + 1,
                "signature": first.map(|point| point.orbit.signature.written(self.scene)),
                "periods": first.map(|point| point.orbit.signature.periods),
                "symmetric": first.map(|point| point.orbit.signature.symmetric),
                "points": branch.points.len(),
                "from": first.map(|point| point.value),
                "to": last.map(|point| point.value),
                "found_at_special": branch.from.map(|special| special + 1),
                "switches": branch.depth,
                "begins": end(&branch.ends[0]),
                "ends": end(&branch.ends[1]),
            })
        });
        let special = |(number, special): (usize, &Special)| {
            json!({
                "special": number + 1,
                "label": special.label.name(),
                "branch": special.branch + 1,
                "value": special.point.value,
                "leads_to": special.leads_to.iter().map(|branch| branch + 1).collect::<Vec<_>>(),
                "not_followed_because": special.reason,
                "phases_cycles": special.point.orbit.phases,
                "speeds_m_per_s": special.point.orbit.speeds,
            })
        };
        json!({
            "key": self.column,
            "branches": branches.collect::<Vec<_>>(),
            "specials": self.graph.specials.iter().enumerate().map(special).collect::<Vec<_>>(),
        })
    }

    /// The approach speeds over the key: stable orbits solid, unstable ones dashed,
    /// special points marked; `beneath` are points of a sweep.
    #[must_use]
    pub fn picture(&self, title: &str, beneath: &[(f64, f64)]) -> String {
        let shown = |point: &Point| {
            let orbit = &point.orbit;
            let met = orbit.signature.events.iter().zip(&orbit.speeds).filter(|(event, _)| event.kind.is_approach());
            met.map(|(_, speed)| *speed).filter(|v| v.is_finite()).collect::<Vec<_>>()
        };
        let all = || self.graph.branches.iter().flat_map(|branch| &branch.points);
        let extent = |values: &mut dyn Iterator<Item = f64>| {
            values.filter(|x| x.is_finite()).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let x = extent(&mut all().map(|point| point.value).chain(beneath.iter().map(|point| point.0)));
        let (_, top) = extent(&mut all().flat_map(shown).chain(beneath.iter().map(|point| point.1)));
        let top = if top.is_finite() && top > 0.0 { top } else { 1.0 };
        let mut scatter = Scatter::new(
            title,
            (&self.label, Scale::Linear, x),
            ("Approach speed (m/s)", Scale::Linear, (0.0, top)),
            &[""],
        );
        for (x, y) in beneath {
            scatter.add(0, *x, *y);
        }
        for branch in &self.graph.branches {
            let events = branch.points.first().map_or(0, |point| point.orbit.speeds.len());
            // A motion without events has the speed 0.
            let speed = |point: &Point, event: usize| {
                if events == 0 { Some(0.0) } else { point.orbit.speeds.get(event).copied() }
            };
            for run in branch.points.chunk_by(|a, b| kind(a) == kind(b)) {
                let (line, label) = run.first().map_or((Line::Solid, ""), kind);
                let next = run.last().and_then(|last| {
                    let index = branch.points.iter().position(|point| std::ptr::eq(point, last))?;
                    branch.points.get(index + 1)
                });
                let kinds = branch.points.first().map_or(&[][..], |point| &point.orbit.signature.events);
                let met =
                    (0..events.max(1)).filter(|&event| kinds.get(event).is_none_or(|event| event.kind.is_approach()));
                for event in met {
                    let points = run.iter().chain(next).filter_map(|point| Some((point.value, speed(point, event)?)));
                    scatter.line(line, label, points.collect());
                }
            }
        }
        for special in &self.graph.specials {
            let (sign, label) = sign(special.label);
            // A graze is on the axis; of other points the fastest impact is marked.
            let grazes = matches!(special.label, Label::GrazingIn | Label::GrazingOut);
            let fastest = shown(&special.point).into_iter().fold(0.0, f64::max);
            scatter.sign(sign, label, (special.point.value, if grazes { 0.0 } else { fastest }));
        }
        scatter.to_svg()
    }
}

/// How the orbits of a stretch are drawn.
fn kind(point: &Point) -> (Line, &'static str) {
    // At a graze the speed is 0 to rounding.
    let top = point.orbit.speeds.iter().fold(0.0_f64, |top, speed| top.max(speed.abs()));
    match (point.admissible.least_speed >= -1e-6 * top, point.floquet.is_stable()) {
        (false, _) => (Line::Dotted, "passes a wall"),
        (true, true) => (Line::Solid, "stable"),
        (true, false) => (Line::Dashed, "unstable"),
    }
}

fn sign(label: Label) -> (Sign, &'static str) {
    let sign = match label {
        Label::Fold => Sign::Triangle,
        Label::PeriodDoubling => Sign::Diamond,
        Label::SymmetryBreaking => Sign::Ring,
        Label::GrazingIn => Sign::Cross,
        Label::GrazingOut => Sign::Plus,
        _ => Sign::Square,
    };
    (sign, label.name())
}

/// Why a branch ends, in words.
#[must_use]
pub fn ended(end: &End) -> String {
    match end {
        End::Range => "end of the range".to_owned(),
        End::Special(label) => label.name().to_owned(),
        End::Closed => "closes".to_owned(),
        End::Points => "as many points as were asked for".to_owned(),
        End::Stuck(reason) => format!("stuck: {reason}"),
    }
}

/// Points of a sweep that vary `column`, to be drawn beneath: the approach speeds of the instants
/// beside the table, else the column of the table that begins with `approach_speed`.
///
/// # Errors
/// [`Error::Io`] for a table that cannot be read; [`Error::Unknown`] for one without the column.
pub fn beneath(path: &Path, column: &str) -> Result<Vec<(f64, f64)>> {
    let failed = |path: &Path, error: &::csv::Error| Error::io(path.display(), error.to_string(), true);
    let open = |path: &Path| ::csv::Reader::from_path(path).map_err(|error| failed(path, &error));
    let place = |header: &::csv::StringRecord, name: &str| header.iter().position(|own| own == name);
    let mut table = open(path)?;
    let header = table.headers().map_err(|error| failed(path, &error))?.clone();
    let unknown = |name: &str| Error::Unknown {
        kind: "column of the sweep",
        name: name.to_owned(),
        known: header.iter().map(str::to_owned).collect(),
    };
    let own = place(&header, column).ok_or_else(|| unknown(column))?;
    let number =
        |record: &::csv::StringRecord, index: usize| record.get(index).and_then(|text| text.parse::<f64>().ok());
    let samples = path.with_file_name("samples.csv");
    let speed = header.iter().position(|name| name.starts_with("approach_speed"));
    let mut of_row = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    for record in table.records() {
        let record = record.map_err(|error| failed(path, &error))?;
        let (Some(row), Some(x)) = (record.get(0).map(str::to_owned), number(&record, own)) else { continue };
        of_row.insert(row, x);
        points.extend(speed.and_then(|index| number(&record, index)).map(|y| (x, y)));
    }
    if !samples.is_file() {
        return if speed.is_some() { Ok(points) } else { Err(unknown("approach_speed")) };
    }
    points.clear();
    let mut table = open(&samples)?;
    let header = table.headers().map_err(|error| failed(&samples, &error))?.clone();
    let Some(speed) = place(&header, "approach_speed_m_per_s") else {
        return Err(Error::Unknown {
            kind: "column of the sweep's instants",
            name: "approach_speed_m_per_s".to_owned(),
            known: header.iter().map(str::to_owned).collect(),
        });
    };
    for record in table.records() {
        let record = record.map_err(|error| failed(&samples, &error))?;
        let x = record.get(0).and_then(|row| of_row.get(row));
        points.extend(x.zip(number(&record, speed)).map(|(x, y)| (*x, y)));
    }
    Ok(points)
}
