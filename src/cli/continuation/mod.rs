//! `signorini continue`: branches of periodic orbits over a key.

mod args;
mod loci;

pub use args::Args;

use super::pipeline::Answer;
use super::ui::Ui;
use crate::error::Result;
use crate::orbit::branch::{Graph, Locus, OnLocus};
use crate::output::branch_folder::{self, BranchRequest};
use crate::output::branches::{Drawn, ended};
use crate::output::first_orbit::FirstOrbit;
use crate::output::request::{extended, request};
use crate::output::results::Results;
use crate::output::scene_family::SceneFamily;
use crate::output::table::Table;
use crate::output::varied::Varied;
use crate::output::{self, overlay};
use serde_json::json;

pub fn answer(args: &Args, ui: &Ui) -> Result<Answer> {
    let family = args.family(ui)?;
    let (read, problem) = (args.from.as_deref(), family.problem.as_ref());
    let first = read.map(|path| FirstOrbit::read(path, &family.case, problem)).transpose()?;
    let key = &family.key;
    let beneath = args.over.as_deref().map(|path| overlay::read(path, &key.key, &key.column())).transpose()?;
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
    let drawn = branch_folder::drawn(&found, &family);
    let document = branch_folder::write(&mut results, &drawn, &family, beneath.as_deref(), !args.place.no_report)?;
    let mut traced = Vec::new();
    if let Some(second) = &family.second {
        traced = loci::follow(&family, second, &found, args, ui)?;
        write_loci(&mut results, &traced, &family, second)?;
    }
    results.add_to_manifest("orbit_command", json!(args.case.command_line("orbit")));
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
    let request = BranchRequest { switch: args.switch.parse()?, depth: args.depth, points: args.points };
    ui.with_bar("branches", |bar| request.follow(family, first, &mut |share| bar.set_share(share)))
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
        let stable = drawn.points_on(number).filter(|point| point.floquet.is_stable()).count();
        vec![
            (number + 1).to_string(),
            signature,
            first.orbit.signature.periods.to_string(),
            drawn.points_on(number).count().to_string(),
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
