//! `branches.csv`, `special.csv`, `branches.json` and the picture of a graph of branches.

use super::csv::{self, digits};
use super::figure::{Line, Scale, Scatter, Sign};
use super::window::extent;
use crate::error::Result;
use crate::orbit::branch::{End, Graph, Label, Point, Special};
use crate::orbit::{Event, Orbit};
use crate::scene::Scene;
use serde_json::{Value, json};
use std::path::Path;

/// A graph, with the names of its columns and axis.
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

/// Most multipliers of an orbit in the tables.
const MOST_MULTIPLIERS: usize = 8;

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
        ];
        let mut header: Vec<String> = first.iter().chain(&fixed).map(|&name| name.to_owned()).collect();
        for number in 1..=self.multipliers() {
            header.extend(["re", "im"].map(|part| format!("multiplier_{number}_{part}")));
        }
        for event in 1..=self.events() {
            header.extend([format!("phase_{event}_cycles"), format!("speed_{event}_m_per_s")]);
        }
        header
    }

    /// How many multipliers have columns: the largest ones of a structure.
    fn multipliers(&self) -> usize {
        let first = self.graph.branches.iter().find_map(|branch| branch.points.first());
        first.map_or(0, |point| point.floquet.multipliers.len()).min(MOST_MULTIPLIERS)
    }

    /// True if the orbits are told by states.
    pub fn tells_states(&self) -> bool {
        self.graph.branches.iter().flat_map(|branch| &branch.points).any(|point| point.strobe.is_some())
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
        row.extend(point.floquet.multipliers.iter().take(self.multipliers()).flatten().map(|x| cell(*x)));
        for event in 0..self.events() {
            let of = |values: &[f64]| values.get(event).map_or_else(String::new, |x| cell(*x));
            row.extend([of(&orbit.phases), of(&orbit.speeds)]);
        }
        row
    }

    /// The wall at whose place the motion is drawn: the one that most of the branches meet.
    #[must_use]
    pub fn place(&self) -> usize {
        let events =
            || self.graph.branches.iter().filter_map(|b| b.points.first()).flat_map(|p| &p.orbit.signature.events);
        let meets = |wall: usize| events().filter(|event| event.wall == wall).count();
        (0..self.scene.walls.len()).rev().max_by_key(|&wall| meets(wall)).unwrap_or(0)
    }

    /// The name of the wall at which a special point happens.
    #[must_use]
    pub fn wall(&self, special: &Special) -> Option<&str> {
        self.scene.wall_name(special.wall?)
    }

    /// Every point in the order of `branches.csv`, special points among the others: the numbers of
    /// branch and point, from 1, the point, and its label, which is empty but for special points.
    #[must_use]
    pub fn points(&self) -> Vec<(usize, usize, &Point, &'static str)> {
        let mut all = Vec::new();
        for (number, branch) in self.graph.branches.iter().enumerate() {
            let mut count = 0;
            let mut add = |point, label| {
                count += 1;
                all.push((number + 1, count, point, label));
            };
            let own = |special: &&Special| special.branch == number;
            for (index, point) in branch.points.iter().enumerate() {
                for special in self.graph.specials.iter().filter(own).filter(|special| special.after == index) {
                    add(&special.point, special.label.name());
                }
                // A branch that ends at a special point has it as its last point.
                if !self.graph.specials.iter().filter(own).any(|special| special.point == *point) {
                    add(point, "");
                }
            }
            for special in self.graph.specials.iter().filter(own).filter(|s| s.after >= branch.points.len()) {
                add(&special.point, special.label.name());
            }
        }
        all
    }

    /// The points on a branch, special points among them, as in `branches.csv`.
    pub fn points_on(&self, branch: usize) -> impl Iterator<Item = &Point> {
        self.points().into_iter().filter(move |(number, ..)| *number == branch + 1).map(|(_, _, point, _)| point)
    }

    /// Writes one row per point of each branch, in order along it; special points stand among them
    /// with their label.
    pub fn branches(&self, path: &Path) -> Result<()> {
        let rows = self
            .points()
            .into_iter()
            .map(|(branch, number, point, label)| self.row(vec![branch.to_string(), number.to_string()], point, label));
        csv::table(path, &self.header(&["branch", "point"]), rows)
    }

    /// Writes one row per special point, with the branches that it leads to.
    pub fn specials(&self, path: &Path) -> Result<()> {
        let rows = self.graph.specials.iter().enumerate().map(|(number, special)| {
            let leads = special.leads_to.iter().map(|branch| (branch + 1).to_string()).collect::<Vec<_>>().join(" ");
            let first = vec![
                (number + 1).to_string(),
                (special.branch + 1).to_string(),
                leads,
                special.reason.clone().unwrap_or_default(),
                self.wall(special).unwrap_or_default().to_owned(),
            ];
            self.row(first, &special.point, special.label.name())
        });
        csv::table(path, &self.header(&["special", "branch", "leads_to", "not_followed_because", "wall"]), rows)
    }

    /// The graph as a document: branches with their ends, and special points.
    #[must_use]
    pub fn document(&self) -> Value {
        let end = |end: &Option<End>| match end {
            None => json!("special point"),
            Some(end) => json!(ended(end)),
        };
        let events = |orbit: &Orbit| -> Vec<Value> {
            let events = orbit.signature.events.iter();
            let one = |event: &Event| json!({ "wall": self.scene.wall_name(event.wall), "kind": event.kind.name() });
            events.map(one).collect()
        };
        let branches = self.graph.branches.iter().enumerate().map(|(number, branch)| {
            let (first, last) = (branch.points.first(), branch.points.last());
            json!({
                "branch": number + 1,
                "signature": first.map(|point| point.orbit.signature.written(self.scene)),
                "events": first.map(|point| events(&point.orbit)),
                "periods": first.map(|point| point.orbit.signature.periods),
                "symmetric": first.map(|point| point.orbit.signature.symmetric),
                "points": self.points_on(number).count(),
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
                "wall": self.wall(special),
                "leads_to": special.leads_to.iter().map(|branch| branch + 1).collect::<Vec<_>>(),
                "not_followed_because": special.reason,
                "phases_cycles": special.point.orbit.phases,
                "speeds_m_per_s": special.point.orbit.speeds,
            })
        };
        json!({
            "key": self.column,
            "label": self.label,
            "branches": branches.collect::<Vec<_>>(),
            "specials": self.graph.specials.iter().enumerate().map(special).collect::<Vec<_>>(),
        })
    }

    /// The approach speeds over the key: stable orbits solid, unstable ones dashed,
    /// special points marked; `beneath` are points of other results.
    #[must_use]
    pub fn picture(&self, title: &str, beneath: &[(f64, f64)]) -> String {
        let shown = |point: &Point| {
            let orbit = &point.orbit;
            let met = orbit.signature.events.iter().zip(&orbit.speeds).filter(|(event, _)| event.kind.is_approach());
            met.map(|(_, speed)| *speed).filter(|v| v.is_finite()).collect::<Vec<_>>()
        };
        let all = || self.graph.branches.iter().flat_map(|branch| &branch.points);
        let values = all().map(|point| point.value).chain(beneath.iter().map(|point| point.0));
        let x = extent(values.filter(|x| x.is_finite()));
        let speeds = all().flat_map(shown).chain(beneath.iter().map(|point| point.1));
        let (_, top) = extent(speeds.filter(|v| v.is_finite()));
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
        Label::NeimarkSacker => Sign::Disc,
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
        End::Refused(reason) => format!("end of what the key accepts: {reason}"),
        End::Stuck(reason) => format!("stuck: {reason}"),
    }
}
