//! `signorini continue`: branches of periodic orbits over a key.

mod begin;
mod loci;
mod varied;

use super::request::{Changes, Destination};
use super::ui::Ui;
use crate::case::{CaseFile, KeyValue};
use crate::error::{Error, Result};
use crate::orbit::branch::{Graph, Request, Switch, graph};
use crate::orbit::{Problem, SETTLE};
use crate::output::asked::{asked, with};
use crate::output::atomic::write_whole;
use crate::output::branches::{Drawn, ended};
use crate::output::table::Table;
use crate::output::{self, beneath, json, orbits, summary};
use crate::scene::Scene;
use begin::Begin;
use serde_json::json;
use std::path::PathBuf;
use varied::Varied;

const EXAMPLES: &str = "\
Examples:
  signorini continue rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --set load.1.harmonic.frequency=5 --key load.1.harmonic.frequency --range 1:16
  signorini continue rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --key 'wall.*.restitution' --range 0.3:1 --switch all
  signorini continue bouncing-ball.toml --key load.2.harmonic.amplitude --range 1:30 \\
      --from out/bouncing-ball/orbit/orbit.json
  signorini continue rigid-walls-sine … --second 'wall.*.restitution' \\
      --second-range 0.3:0.95 --locus fold,symmetry-breaking
  signorini continue rigid-walls-sine … --over out/rigid-walls-sine/sweep/sweep.csv
      a sweep's points beneath the branches

The branch starts from the orbit of --from, or from the one on which the case settles, at the
case's value of the key. Writes branches.csv (every orbit), special.csv (folds, period doublings,
broken symmetries, grazings, rests), branches.json, a picture (stable orbits solid, unstable ones
dashed), and report.html, in which a click on an orbit shows it, drawn from orbits.csv. With
--second also loci.csv and a picture: where the special points of the branches move in the plane
of two keys. Of a structure the motion is drawn at the place of the wall that most orbits meet; a
change of the walls that an orbit meets ends a branch, and the next one begins there.
docs/orbits.md has the method and the labels.";

/// Branches of periodic orbits over a key: special points located, other branches found
#[derive(Debug, clap::Args)]
#[command(name = "continue", after_help = EXAMPLES)]
pub struct Args {
    /// Case file, summary.json of a run, or the name of a built-in case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    case: String,
    #[command(flatten)]
    changes: Changes,
    /// The key whose value changes along the branches, such as load.1.harmonic.frequency
    #[arg(long, value_name = "KEY")]
    key: String,
    /// The range of its values
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    range: String,
    /// Start from an orbit that `signorini orbit` has written
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    from: Option<PathBuf>,
    /// Forcing periods that are run before the motion is checked for repetition
    #[arg(long, value_name = "N", default_value_t = SETTLE, conflicts_with = "from")]
    settle: u32,
    /// Which branches that begin at special points are followed: no, stable (beside stable orbits),
    /// all
    #[arg(long, value_name = "WORD", default_value = "stable")]
    #[arg(value_parser = ["no", "stable", "all"], hide_possible_values = true)]
    switch: String,
    /// Maximum number of switches between the first branch and any other
    #[arg(long, value_name = "N", default_value_t = 4)]
    depth: u32,
    /// Most points of one branch
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(2..))]
    points: u32,
    /// Draw the points of a sweep in the same key beneath the branches
    #[arg(long, value_name = "SWEEP.CSV", value_hint = clap::ValueHint::FilePath)]
    over: Option<PathBuf>,
    /// Follow special points in the plane of --key and this key
    #[arg(long, value_name = "KEY", requires = "second_range")]
    second: Option<String>,
    /// The range of the values of --second
    #[arg(long, value_name = "A:B", requires = "second", allow_hyphen_values = true)]
    second_range: Option<String>,
    /// Which special points: fold, period-doubling, symmetry-breaking, grazing-in, grazing-out
    /// [default: all of them]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', requires = "second", hide_possible_values = true,
        value_parser = ["fold", "period-doubling", "symmetry-breaking", "grazing-in", "grazing-out"])]
    locus: Vec<String>,
    #[command(flatten)]
    place: Destination,
}

pub fn execute(args: &Args, ui: &Ui) -> Result<()> {
    let file = args.changes.case_file(&args.case, ui)?;
    let case = file.case()?;
    let varied = Varied::new(&file, ("--key", &args.key), ("--range", &args.range))?;
    let Varied { key, value, range } = &varied;
    if case.truncated.is_some() && key.to_string().starts_with("system.") {
        let expected =
            "a key outside of [system], or a case without modes: the modes of one value are not those of another";
        return Err(Error::invalid("--key", key, expected));
    }
    let scene_at = |value: f64| -> Result<Scene> {
        let mut file = file.clone();
        file.set(key, &KeyValue::from(value))?;
        Ok(file.case()?.scene)
    };
    let second = args.second(&file)?;
    let lines = case.scene.is_line();
    if let (Some(second), false) = (&args.second, lines) {
        let expected =
            "a case of one degree of freedom: the special points of structures are not followed over two keys";
        return Err(Error::invalid("--second", second, expected));
    }
    // A scene that cannot be followed at all is refused before the folder of results is made.
    let problem = if lines { Some(Problem::new(case.scene.clone())?) } else { None };
    let from = args.from.as_deref().map(|path| Begin::read(path, &case, problem.as_ref())).transpose()?;
    let request = Request {
        range: *range,
        switch: match args.switch.as_str() {
            "no" => Switch::No,
            "all" => Switch::All,
            _ => Switch::Stable,
        },
        depth: args.depth,
        points: args.points as usize,
    };
    let asked = with(
        asked("continue", &case, &[]),
        json!({
            "key": args.key,
            "range": args.range,
            "from": args.from,
            "settle": args.settle,
            "switch": args.switch,
            "depth": args.depth,
            "points": args.points,
            "over": args.over,
            "second": args.second,
            "second_range": args.second_range,
            "locus": args.locus,
        }),
    );
    let column = varied.column();
    let points = args.over.as_deref().map(|path| beneath::read(path, &column)).transpose()?.unwrap_or_default();
    let mut results = args.place.results(&case, "continue", asked)?;
    let start = match from {
        Some(from) => from,
        None => Begin::settled(&case.scene, problem.as_ref(), args.settle, ui)?,
    };
    let found = watched(&scene_at, &start, *value, &request, ui)?;
    let drawn = Drawn { graph: &found, column, label: varied.label(), scene: &case.scene };
    drawn.branches(&results.place("branches.csv")?)?;
    drawn.specials(&results.place("special.csv")?)?;
    let mut document = drawn.document();
    // Another value of the key shows which walls it moves.
    let moved = found.branches.iter().flat_map(|branch| &branch.points).find(|point| point.value != *value);
    let other = moved.map(|point| scene_at(point.value)).transpose()?;
    document["walls"] = orbits::walls(&case.scene, other.as_ref().unwrap_or(&case.scene), drawn.place());
    if !lines {
        document["place"] = json!(case.scene.walls.get(drawn.place()).map(|wall| &wall.name));
    }
    write_whole(&results.place("branches.json")?, json::text(&document).as_bytes())?;
    let title = case.title.as_deref().unwrap_or(&case.name);
    results.draw("branches", &drawn.picture(&format!("{title}: branches of periodic orbits"), &points))?;
    if args.over.is_some() {
        beneath::write(&results.place(beneath::FILE)?, &drawn.column, &points)?;
    }
    if !args.place.no_report {
        orbits::write(&results.place(orbits::FILE)?, &drawn, &scene_at)?;
    }
    let mut traced = Vec::new();
    if let Some(second) = &second {
        let varied = [&varied, second];
        traced = loci::follow(&file, &found, varied, (&args.locus, args.points as usize), ui)?;
        let columns = varied.map(Varied::column);
        output::loci::table(&results.place("loci.csv")?, &traced, &columns, &case.scene)?;
        let labels = varied.map(Varied::label);
        results.draw("loci", &output::loci::picture(&traced, &labels, &format!("{title}: loci of special points")))?;
    }
    results.tell("orbit_command", json!(args.changes.command_line("orbit", &args.case)));
    results.tell("case_file", summary::case_file(&case));
    super::run::finish(&mut results, "", !args.place.no_report, ui)?;
    if ui.json() {
        ui.document(&document)?;
    } else {
        report(&drawn, ui)?;
        for (number, locus) in traced.iter().enumerate() {
            let values = |point: Option<&crate::orbit::branch::OnLocus>| {
                point.map_or_else(String::new, |point| format!("({:.9}, {:.9})", point.values[0], point.values[1]))
            };
            ui.prose(&format!(
                "locus {} of {}: {} points from {} ({}) to {} ({})",
                number + 1,
                locus.label,
                locus.points.len(),
                values(locus.points.first()),
                ended(&locus.ends[0]),
                values(locus.points.last()),
                ended(&locus.ends[1])
            ))?;
        }
    }
    Ok(())
}

impl Args {
    /// The second key, if one is asked for.
    fn second(&self, file: &CaseFile) -> Result<Option<Varied>> {
        let (Some(key), Some(text)) = (&self.second, &self.second_range) else { return Ok(None) };
        if *key == self.key {
            return Err(Error::invalid("--second", key, "a key other than --key"));
        }
        Varied::new(file, ("--second", key), ("--second-range", text)).map(Some)
    }
}

/// Follows the branches with a progress bar, which shows the value of the key on the current one.
fn watched(
    family: &dyn Fn(f64) -> Result<Scene>,
    start: &Begin,
    value: f64,
    request: &Request,
    ui: &Ui,
) -> Result<Graph> {
    let bar = ui.progress("branches", 1000);
    let [low, high] = request.range;
    let found =
        graph(family, start.start(), value, request, &mut |point| bar.share((point.value - low) / (high - low)));
    bar.finish();
    found
}

fn report(drawn: &Drawn<'_>, ui: &Ui) -> Result<()> {
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
    ui.table(&Table::new(&header, rows.collect()), "branches.json")?;
    if graph.specials.is_empty() {
        return Ok(());
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
    ui.table(&Table::new(&header, rows.collect()), "special.csv")
}
