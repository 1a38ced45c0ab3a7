//! `sweep --until-interval`: rows that equal `run --until-interval` bit for bit, threads and
//! shards, rows out of reach, and what is refused.
use crate::command::said;
use crate::shaken::square_of_bars;
use crate::table::{rows, summary};
use signorini::case::CaseFile;
use signorini::sweep::{Axis, Measure, Shard, Status, Sweep, SweepOptions};
use std::fs;
use std::path::Path;

/// A second in the square.
fn square() -> String {
    square_of_bars("", "[time]\nend = 1.0\nstep = 1e-3\nstatistics_from = 0.2\n")
}

const GAPS: [&str; 3] = ["1e-3", "2e-3", "1e-2"];
const SWEEP: [&str; 6] =
    ["sweep", "square.toml", "--vary", "support.bars.gap=1e-3,2e-3,1e-2", "--measure", "work_rate,force_mean"];

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("square.toml"), square()).unwrap();
    dir
}

fn bytes(folder: &Path) -> Vec<Vec<u8>> {
    ["sweep.csv", "realisations.csv"].map(|name| fs::read(folder.join(name)).unwrap()).to_vec()
}

#[test]
fn a_row_is_run_until_its_interval_bit_for_bit() {
    let dir = folder();
    let path = dir.path();
    let (out, err) = said(path, &[&SWEEP[..], &["--until-interval", "30%", "--out", "s"]].concat(), 0);
    assert!(out.contains("Seeds") && err.contains("3 rows × 6 or more realisations"), "{out}{err}");
    let (means, realisations) = (rows(&path.join("s/sweep.csv")), rows(&path.join("s/realisations.csv")));
    let mut counts = Vec::new();
    for (row, (gap, mean)) in GAPS.iter().zip(&means).enumerate() {
        let set = format!("support.bars.gap={gap}");
        let run = ["run", "square.toml", "--set", &set, "--until-interval", "30%", "--no-verdict", "--out", gap];
        said(path, &run, 0);
        let summary = summary(&path.join(gap));
        let study = &summary["realisations"];
        assert_eq!((mean["seeds"].clone(), mean["status"].as_str()), (study["count"].to_string(), "ok"), "{gap}");
        let own = realisations.iter().filter(|run| run["row"] == row.to_string());
        assert_eq!(own.count().to_string(), mean["seeds"]);
        for (measure, name, unit) in [("work_rate", "work_rate", "W"), ("force_mean", "force_mean", "N")] {
            let all = study["estimates"].as_array().unwrap().iter();
            let one = all.into_iter().find(|one| one["place"] == "bars" && one["measure"] == measure).unwrap();
            let cell = |column: String| mean[&column].parse::<f64>().unwrap();
            assert_eq!(cell(format!("{name}_bars_{unit}")), one["mean"].as_f64().unwrap());
            assert_eq!(cell(format!("{name}_half_width_95_bars_{unit}")), one["half_width_95"].as_f64().unwrap());
        }
        counts.push(mean["seeds"].parse::<u64>().unwrap());
    }
    assert!(counts.iter().all(|count| *count >= 6) && counts[0] != counts[2], "{counts:?}");
    let page = fs::read_to_string(path.join("s/report.html")).unwrap();
    assert!(page.contains("6 or more realisations") && page.contains("--until-interval 0.3 --most-seeds 200"));
    // The same command again finds all of it; another share is another request.
    let (_, err) = said(path, &[&SWEEP[..], &["--until-interval", "0.3", "--out", "s"]].concat(), 0);
    assert!(err.contains("all of them there already"), "{err}");
    let (_, err) = said(path, &[&SWEEP[..], &["--until-interval", "20%", "--out", "s"]].concat(), 2);
    assert!(err.contains("until_interval: 0.3 there, 0.2 asked"), "{err}");
    // Threads and shards change no byte.
    let whole = bytes(&path.join("s"));
    let again = |more: &[&str]| said(path, &[&SWEEP[..], &["--until-interval", "30%"], more].concat(), 0);
    again(&["--threads", "1", "--out", "one"]);
    assert!(bytes(&path.join("one")) == whole);
    for shard in ["2/2", "1/2"] {
        again(&["--shard", shard, "--out", "parts"]);
    }
    let (out, _) = said(path, &["merge", "parts", "--out", "merged"], 0);
    assert!(out.contains(" ± ") && bytes(&path.join("merged")) == whole, "{out}");
    let (out, _) = again(&["--plan"]);
    assert!(out.contains("first six, which say how many more"), "{out}");
}

#[test]
fn rows_in_memory_are_those_of_the_tables() {
    let dir = folder();
    let path = dir.path();
    let file = CaseFile::read(path.join("square.toml")).unwrap();
    let sweep = Sweep::new(file).vary(Axis::list("support.bars.gap", &[1e-3.into(), 1e-2.into()]).unwrap());
    let plan = sweep.measure([Measure::WorkRate]).until_interval(0.4, None).unwrap().plan().unwrap();
    let options = SweepOptions { threads: Some(2), shard: Shard::WHOLE, force: false };
    let finished = plan.run_into(&path.join("s"), options, &|_| {}).unwrap();
    let in_memory = plan.rows(2).unwrap();
    let table = rows(&path.join("s/realisations.csv"));
    assert!(finished.runs > 12 && plan.runs() == 12);
    assert_eq!((in_memory.len() as u64, table.len() as u64), (finished.runs, finished.runs));
    for (row, line) in in_memory.iter().zip(&table) {
        let number = row.realisation.unwrap_or(0).to_string();
        assert_eq!((row.number.to_string(), number), (line["row"].clone(), line["realisation"].clone()));
        assert_eq!((row.status, row.measures[0]), (Status::Ok, line["work_rate_bars_W"].parse().ok()));
    }
}

#[test]
fn rows_whose_intervals_are_out_of_reach_are_partial_with_the_reason() {
    let dir = folder();
    let path = dir.path();
    let asked = ["--until-interval", "1%", "--most-seeds", "7", "--out", "s"];
    let (_, err) = said(path, &[&SWEEP[..], &asked].concat(), 1);
    assert!(err.contains("partial: 3 of 3 rows"), "{err}");
    for row in rows(&path.join("s/sweep.csv")) {
        assert_eq!((row["seeds"].as_str(), row["status"].as_str()), ("7", "partial"));
        assert!(row["error"].starts_with("an interval of ± 1.0 % was not reached: 7 of "), "{row:?}");
        assert!(row["error"].contains("work rate of support \"bars\"") && !row["work_rate_bars_W"].is_empty());
    }
    // Nothing touches: nothing scatters, and six realisations are enough.
    let wide = ["sweep", "square.toml", "--vary", "support.bars.gap=1,2", "--measure", "work_rate"];
    said(path, &[&wide[..], &["--until-interval", "1%", "--out", "w"]].concat(), 0);
    assert!(rows(&path.join("w/sweep.csv")).iter().all(|row| row["seeds"] == "6" && row["status"] == "ok"));
}

#[test]
fn intervals_that_cannot_decide_are_refused_by_name() {
    let dir = folder();
    let refused = |args: &[&str], words: &[&str]| {
        let (_, err) = said(dir.path(), args, 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    let with = |more: &[&'static str]| [&SWEEP[..], more].concat();
    for share in ["0", "1", "-5%", "nan", "five"] {
        refused(&with(&["--until-interval", share]), &["--until-interval", "above 0 and below 1"]);
    }
    refused(&with(&["--until-interval", "5%", "--seeds", "6"]), &["cannot be used with"]);
    refused(&with(&["--until-interval", "5%", "--most-seeds", "5"]), &["--most-seeds", "6 or more"]);
    refused(&with(&["--most-seeds", "9"]), &["--until-interval"]);
    refused(
        &[
            "sweep",
            "square.toml",
            "--vary",
            "support.bars.gap=1e-3:2e-3:3",
            "--follow",
            "up",
            "--measure",
            "work_rate",
            "--until-interval",
            "5%",
        ],
        &["--until-interval", "nothing followed"],
    );
    refused(
        &[
            "sweep",
            "square.toml",
            "--vary",
            "support.bars.gap=1e-3,2e-3",
            "--measure",
            "contacts",
            "--until-interval",
            "5%",
        ],
        &["--until-interval", "work_rate, force_mean"],
    );
    refused(
        &[
            "sweep",
            "rigid-walls-sine",
            "--vary",
            "wall.upper.position=5e-3,6e-3",
            "--measure",
            "force_mean",
            "--until-interval",
            "5%",
        ],
        &["--until-interval", "a random load"],
    );
    refused(&with(&["--until-interval", "5%", "--most-seeds", "100000000"]), &["at most 100000000 runs"]);
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1, "a refused request leaves nothing");
}
