//! `signorini continue`: branches of periodic orbits over a key.

mod args;
mod family;
mod loci;
mod varied;

pub use args::Args;

use super::first_orbit::FirstOrbit;
use super::pipeline::Answer;
use super::ui::Ui;
use crate::error::Result;
use crate::orbit::branch::{Graph, Locus, OnLocus, Point, Request, Switch, graph};
use crate::output::atomic::write_whole;
use crate::output::branches::{Drawn, ended};
use crate::output::request::{extended, request};
use crate::output::results::Results;
use crate::output::table::Table;
use crate::output::{self, json, orbits, overlay};
use family::SceneFamily;
use serde_json::{Value, json};
use varied::Varied;

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let family = SceneFamily::new(args, ui)?;
    let (read, problem) = (args.from.as_deref(), family.problem.as_ref());
    let first = read.map(|path| FirstOrbit::read(path, &family.case, problem)).transpose()?;
    let column = family.key.column();
    let beneath = args.over.as_deref().map(|path| overlay::read(path, &family.key.key, &column)).transpose()?;
    let case = &family.case;
    let asked = extended(request("continue", case, &[]), args.settings());
    let mut results = args.place.open(case, "continue", asked)?;
    let settled = || {
        ui.with_bar("settling", |bar| {
            FirstOrbit::settled(&case.scene, problem, args.settle, &|share| bar.set_share(share))
        })
    };
    let first = first.map_or_else(settled, Ok)?;
    let found = branches(args, &family, &first, ui)?;
    let drawn = Drawn { graph: &found, column, label: family.key.label(), scene: &case.scene };
    let document = write(&mut results, &drawn, &family, beneath.as_deref(), !args.place.no_report)?;
    let mut traced = Vec::new();
    if let Some(second) = &family.second {
        traced = loci::follow(&family, second, &found, args, ui)?;
        write_loci(&mut results, &traced, &family, second)?;
    }
    results.add_to_manifest("orbit_command", json!(args.orbit_command()));
    results.add_to_manifest("case_file", case.document.json()?);
    let mut answer = Answer::of(results, !args.place.no_report, document);
    show_branches(&mut answer, &drawn);
    show_specials(&mut answer, &drawn);
    for (number, locus) in traced.iter().enumerate() {
        answer.prose(format!("locus {} of {}", number + 1, in_words(locus)));
    }
    Ok(answer)
}

/// Follows the branches with a progress bar, which shows the value of the key on the current one.
fn branches(args: &Args, family: &SceneFamily, first: &FirstOrbit, ui: &Ui) -> Result<Graph> {
    let Varied { value, range, .. } = family.key;
    let switch = match args.switch.as_str() {
        "no" => Switch::No,
        "all" => Switch::All,
        _ => Switch::Stable,
    };
    let request = Request { range, switch, depth: args.depth, points: args.points as usize };
    let [low, high] = range;
    ui.with_bar("branches", |bar| {
        let mut progress = |point: &Point| bar.set_share((point.value - low) / (high - low));
        graph(&|value| family.scene(value), first.start(), value, &request, &mut progress)
    })
}

/// Writes the files of the branches, and returns their document.
fn write(
    results: &mut Results,
    drawn: &Drawn<'_>,
    family: &SceneFamily,
    beneath: Option<&[(f64, f64)]>,
    report: bool,
) -> Result<Value> {
    drawn.branches(&results.place("branches.csv")?)?;
    drawn.specials(&results.place("special.csv")?)?;
    let scene = &family.case.scene;
    let mut document = drawn.document();
    // Another value of the key shows which walls it moves.
    let mut points = drawn.graph.branches.iter().flat_map(|branch| &branch.points);
    let moved = points.find(|point| point.value != family.key.value);
    let other = moved.map(|point| family.scene(point.value)).transpose()?;
    document["walls"] = orbits::walls(scene, other.as_ref().unwrap_or(scene), drawn.place());
    if drawn.tells_states() {
        document["place"] = json!(scene.walls.get(drawn.place()).map(|wall| &wall.name));
    }
    write_whole(&results.place("branches.json")?, json::text(&document).as_bytes())?;
    let title = format!("{}: branches of periodic orbits", family.title());
    results.draw("branches", &drawn.picture(&title, beneath.unwrap_or_default()))?;
    if let Some(points) = beneath {
        overlay::write(&results.place(overlay::FILE)?, &drawn.column, points)?;
    }
    if report {
        orbits::write(&results.place(orbits::FILE)?, drawn, &|value| family.scene(value))?;
    }
    Ok(document)
}

/// Writes the files of the loci over both keys.
fn write_loci(results: &mut Results, traced: &[Locus], family: &SceneFamily, second: &Varied) -> Result<()> {
    let keys = [&family.key, second];
    output::loci::table(&results.place("loci.csv")?, traced, &keys.map(Varied::column), &family.case.scene)?;
    let title = format!("{}: loci of special points", family.title());
    results.draw("loci", &output::loci::picture(traced, &keys.map(Varied::label), &title))?;
    Ok(())
}

/// A locus: its length and its ends.
fn in_words(locus: &Locus) -> String {
    let end = |point: Option<&OnLocus>, end| {
        let values = |point: &OnLocus| format!("({:.9}, {:.9})", point.values[0], point.values[1]);
        format!("{} ({})", point.map_or_else(String::new, values), ended(end))
    };
    format!(
        "{}: {} points from {} to {}",
        locus.label,
        locus.points.len(),
        end(locus.points.first(), &locus.ends[0]),
        end(locus.points.last(), &locus.ends[1])
    )
}

/// Shows the branches.
fn show_branches(answer: &mut Answer, drawn: &Drawn<'_>) {
    let graph = drawn.graph;
    let rows = graph.branches.iter().enumerate().map(|(number, branch)| {
        let (Some(first), Some(last)) = (branch.points.first(), branch.points.last()) else { return Vec::new() };
        let signature = match first.orbit.signature.written(drawn.scene).as_str() {
            "" => "no contact".to_owned(),
            written if first.orbit.signature.symmetric => format!("{written} and mirror"),
            written => written.to_owned(),
        };
        let begins = match (&branch.ends[0], branch.from) {
            (Some(end), _) => ended(end),
            (None, Some(special)) => format!("special {}", special + 1),
            (None, None) => String::new(),
        };
        let stable = branch.points.iter().filter(|point| point.floquet.is_stable()).count();
        vec![
            (number + 1).to_string(),
            signature,
            first.orbit.signature.periods.to_string(),
            branch.points.len().to_string(),
            stable.to_string(),
            format!("{:.9}", first.value),
            begins,
            format!("{:.9}", last.value),
            branch.ends[1].as_ref().map_or_else(String::new, ended),
        ]
    });
    let header = ["branch", "signature", "periods", "points", "stable", "from", "begins at", "to", "ends at"];
    answer.table(Table::new(&header, rows.collect()), "branches.json");
}

/// Shows the special points.
fn show_specials(answer: &mut Answer, drawn: &Drawn<'_>) {
    let graph = drawn.graph;
    if graph.specials.is_empty() {
        return;
    }
    let rows = graph.specials.iter().enumerate().map(|(number, special)| {
        let leads: Vec<String> = special.leads_to.iter().map(|branch| (branch + 1).to_string()).collect();
        vec![
            (number + 1).to_string(),
            match drawn.wall(special) {
                Some(wall) => format!("{} at {wall}", special.label),
                None => special.label.to_string(),
            },
            format!("{:.12}", special.point.value),
            (special.branch + 1).to_string(),
            leads.join(" "),
            special.reason.clone().unwrap_or_default(),
        ]
    });
    let header = ["special", "what", &drawn.label, "branch", "leads to", "not followed because"];
    answer.table(Table::new(&header, rows.collect()), "special.csv");
}
