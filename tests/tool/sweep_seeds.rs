//! `sweep --seeds`: rows that equal `run --seeds` bit for bit, realisations that failed, shards and
//! interruptions, and what is refused.
use crate::command::{command, said};
use crate::shaken::{IN_A_FLOW, before_a_stop};
use crate::table::{number, rows, summary};
use serde_json::Value;
use signorini::case::CaseFile;
use signorini::study::realisations::RealisationCount;
use signorini::sweep::{Axis, Measure, Samples, Status, Sweep, Window};
use signorini::{Options, run};
use std::fs;
use std::path::Path;
use std::time::Duration;

const GAPS: [&str; 3] = ["0.0001", "0.0002", "0.0004"];

/// A sweep of the gaps of the tube in two round supports, three realisations each.
const FILE: &str = r#"
case = "tube-round-supports"
[set]
"time.end" = 0.4
"time.statistics_from" = 0.1
[[vary]]
key = "support.*.gap"
values = [1e-4, 2e-4, 4e-4]
[run]
seeds = 3
[measure]
columns = ["work_rate", "force_mean", "force_rms"]
samples = "impacts"
most_samples = 5
[figure]
kind = "line"
"#;

fn place() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("gaps.toml"), FILE).unwrap();
    dir
}

/// The bytes of the tables and the picture.
fn bytes(folder: &Path) -> Vec<Vec<u8>> {
    ["sweep.csv", "realisations.csv", "samples.csv", "sweep.svg"]
        .map(|name| fs::read(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}")))
        .to_vec()
}

/// Worn volume and depths of `run --seeds` and of `sweep --seeds` are the same means, with the same
/// intervals.
#[test]
fn worn_volume_and_depths_have_their_means_and_intervals() {
    let dir = tempfile::tempdir().unwrap();
    let names = ["worn_volume", "support_worn_volume", "depth_deepest", "depth_one_scar", "depth_all_round"];
    let case = ["tube-round-supports", "--set", "time.end=0.2", "--set", "time.statistics_from=0.1", "--seeds", "3"];
    let own = ["--no-verdict", "--no-report", "--out", "run"];
    let (shown, _) = said(dir.path(), &[&["run"], &case[..], &own].concat(), 0);
    assert!(shown.contains("deepest") && shown.contains("all round"), "{shown}");
    let summary: Value = serde_json::from_slice(&fs::read(dir.path().join("run/summary.json")).unwrap()).unwrap();
    let worn = summary["realisations"]["worn"].as_array().unwrap();
    let vary = ["--vary", "support.*.gap=2e-4,3e-4", "--no-report", "--out", "sweep", "--measure"];
    said(dir.path(), &[&["sweep"], &case[..], &vary, &[names.join(",").as_str()]].concat(), 0);
    let row = &rows(&dir.path().join("sweep/sweep.csv"))[0];
    assert_eq!((row["gap_m"].parse(), worn.len()), (Ok(2e-4), 10), "two supports");
    for one in worn {
        let (name, unit) = (one["measure"].as_str().unwrap(), if one["unit"] == "m" { "m" } else { "m3" });
        let place = one["place"].as_str().unwrap().replace('-', "_");
        let (mean, half) = (one["mean"].as_f64().unwrap(), one["half_width_95"].as_f64().unwrap());
        let of_row = ["", "half_width_95_"].map(|part| number(row, &format!("{name}_{part}{place}_{unit}")));
        // Depths of a row pass through its table, with all digits.
        for (row, own) in of_row.iter().zip([mean, half]) {
            assert!((row / own - 1.0).abs() < 1e-12, "{of_row:?} {one}");
        }
        assert!(mean > 0.0 && half > 0.0, "{one}");
    }
}

/// Each row has the numbers of `run --seeds` of the case with its gap, to the last bit: those of
/// the realisations, their means, and the half widths of the intervals.
#[test]
fn a_row_is_run_with_seeds_bit_for_bit() {
    let dir = place();
    let path = dir.path();
    let (out, err) = said(path, &["sweep", "gaps.toml", "--out", "sweep"], 0);
    assert!(out.contains(" ± "), "{out}");
    for words in ["95 % interval of the mean over 3 realisations", "same in every row", "3 rows × 3 realisations in"] {
        assert!(err.contains(words), "{words}: {err}");
    }
    let (means, realisations) = (rows(&path.join("sweep/sweep.csv")), rows(&path.join("sweep/realisations.csv")));
    assert_eq!((means.len(), realisations.len()), (3, 9));
    for (gap, mean) in GAPS.iter().zip(&means) {
        let set = format!("support.*.gap={gap}");
        let own = ["--set", "time.end=0.4", "--set", "time.statistics_from=0.1", "--set", &set];
        let study = ["run", "tube-round-supports", "--seeds", "3", "--no-verdict", "--force", "--out", "run"];
        said(path, &[&study[..], &own].concat(), 0);
        assert_eq!(
            (number(mean, "gap_m"), mean["status"].as_str(), mean["seeds"].as_str()),
            (gap.parse().unwrap(), "ok", "3")
        );
        let of_run = rows(&path.join("run/realisations.csv"));
        let of_row: Vec<_> = realisations.iter().filter(|run| run["row"] == mean["row"]).collect();
        let summary = summary(&path.join("run"));
        let estimates = summary["realisations"]["estimates"].as_array().unwrap();
        for (support, word) in [("plate-1", "plate_1"), ("plate-2", "plate_2")] {
            for (name, measure, unit, column) in [
                ("work_rate", "work_rate", "W", "work_rate_W"),
                ("force_mean", "force_mean", "N", "force_mean_N"),
                ("force_rms", "force_rms", "N", "force_rms_N"),
            ] {
                for (k, realisation) in of_row.iter().enumerate() {
                    let number = (k + 1).to_string();
                    let same = of_run.iter().find(|run| run["realisation"] == number && run["place"] == support);
                    assert_eq!(realisation["realisation"], number);
                    assert_eq!(realisation[&format!("{name}_{word}_{unit}")], same.unwrap()[column], "{gap} {support}");
                }
                let estimate =
                    estimates.iter().find(|one| one["place"] == support && one["measure"] == measure).unwrap();
                let of = |key: &str| estimate[key].as_f64().unwrap();
                assert_eq!(number(mean, &format!("{name}_{word}_{unit}")), of("mean"));
                assert_eq!(number(mean, &format!("{name}_half_width_95_{word}_{unit}")), of("half_width_95"));
            }
        }
    }
    // The realisations differ from one another, and the rows too.
    let all: std::collections::HashSet<&String> = realisations.iter().map(|run| &run["work_rate_plate_1_W"]).collect();
    assert_eq!(all.len(), 9);
    let samples = rows(&path.join("sweep/samples.csv"));
    assert_eq!(samples.len(), 9 * 5, "five instants of each run");
    assert!(samples.iter().all(|sample| ["1", "2", "3"].contains(&sample["realisation"].as_str())));
    let page = fs::read_to_string(path.join("sweep/report.html")).unwrap();
    assert!(page.contains("3 rows × 3 realisations") && page.contains("\"seeds_asked\":\"--seeds 3\""));
    let figure = fs::read_to_string(path.join("sweep/sweep.svg")).unwrap();
    assert!(figure.contains("means of 3 realisations, 95 % intervals"), "the title says what the bands are");
    // A band for each of three measures at each of two supports.
    assert_eq!(figure.matches("fill-opacity=\"0.18\"").count(), 6);
}

/// Rows of another duration than the case has realisations of that duration.
#[test]
fn realisations_have_the_duration_of_their_row() {
    let file = CaseFile::embedded("tube-round-supports").unwrap();
    let axis = Axis::list("support.*.gap", &[2e-4.into(), 3e-4.into()]).unwrap();
    let sweep = Sweep::new(file.clone()).vary(axis).over(Window::Seconds { settle: 0.1, keep: 0.25 }).realisations(2);
    let plan = sweep.measure([Measure::WorkRate]).sample(Samples::Impacts, 1).plan().unwrap();
    assert_eq!((plan.count(), plan.runs(), plan.realisations()), (2, 4, Some(RealisationCount::Exactly(2))));
    let rows = plan.rows(2).unwrap();
    let told: Vec<_> = rows.iter().map(|row| (row.number, row.realisation.unwrap(), row.status)).collect();
    assert_eq!(told, [(0, 1), (0, 2), (1, 1), (1, 2)].map(|(row, k)| (row, k, Status::Ok)));
    for row in &rows {
        let mut file = file.clone();
        for (key, value) in [
            ("time.end", 0.35),
            ("time.statistics_from", 0.1),
            ("support.*.gap", [2e-4, 3e-4][row.number as usize]),
            ("load.*.random.seed", row.realisation.unwrap() as f64),
        ] {
            file.set(&key.parse().unwrap(), &value.into()).unwrap();
        }
        let case = file.case().unwrap();
        let run = run(&case.scene, &plan.method(), &Options::new(case.time)).unwrap();
        let expected: Vec<_> = run.statistics.wear.iter().map(|wear| Some(wear.work_rate_w)).collect();
        assert_eq!(row.measures, expected, "row {}, realisation {:?}", row.number, row.realisation);
    }
}

#[test]
fn threads_and_shards_change_no_byte() {
    let dir = place();
    let path = dir.path();
    said(path, &["sweep", "gaps.toml", "--out", "one", "--threads", "1"], 0);
    let whole = bytes(&path.join("one"));
    said(path, &["sweep", "gaps.toml", "--out", "eight", "--threads", "8"], 0);
    assert!(bytes(&path.join("eight")) == whole, "eight threads");
    for shard in ["2/2", "1/2"] {
        said(path, &["sweep", "gaps.toml", "--out", "parts", "--shard", shard], 0);
    }
    // All realisations of a row are in one shard, whose table has its means.
    assert_eq!(rows(&path.join("parts/shard-1-of-2/sweep.csv")).len(), 2);
    assert_eq!(rows(&path.join("parts/shard-1-of-2/realisations.csv")).len(), 6);
    let (out, _) = said(path, &["merge", "parts", "--out", "merged"], 0);
    assert!(out.contains(" ± "), "{out}");
    assert!(bytes(&path.join("merged")) == whole, "two shards");
    // Rows that follow one another do so for each realisation by itself.
    let follow = |out: &str, threads: &str| {
        let own = ["sweep", "tube-round-supports", "--vary", "support.*.gap=1e-4:4e-4:3"];
        let own = [own, ["--set", "time.end=0.3", "--set", "time.statistics_from=0.1"]].concat();
        let more = ["--follow", "up", "--seeds", "2", "--measure", "work_rate", "--threads", threads, "--out", out];
        said(path, &[&own[..], &more].concat(), 0);
        rows(&path.join(out).join("realisations.csv"))
    };
    let (one, eight) = (follow("follow-one", "1"), follow("follow-eight", "8"));
    assert_eq!(one, eight);
    let places: Vec<_> = one.iter().map(|run| (run["row"].as_str(), run["realisation"].as_str())).collect();
    assert_eq!(places, [("0", "1"), ("0", "2"), ("1", "1"), ("1", "2"), ("2", "1"), ("2", "2")]);
}

/// A sweep that is killed between two realisations of a row goes on from there.
#[test]
fn a_killed_sweep_goes_on_amidst_a_row() {
    let dir = place();
    let path = dir.path();
    // The journal is flushed once a second: the runs are made longer until a sweep of nine is seen
    // at work after a flush, which takes some seconds on any machine.
    for doubling in 0..12 {
        let end = format!("time.end={}", 1.6 * f64::from(1 << doubling));
        let args = ["sweep", "gaps.toml", "--set", &end, "--threads", "1", "--out"];
        let mut child = command(path, &[&args[..], &["killed"], &["--force"]].concat()).spawn().unwrap();
        let journal = path.join("killed/rows.journal");
        // The blocks of the journal, one a run; the last may not be whole.
        let starts = |text: &str| -> Vec<usize> {
            std::iter::once(0).chain(text.match_indices("\n@").map(|(at, _)| at + 1)).collect()
        };
        let mut text = String::new();
        while child.try_wait().unwrap().is_none() && starts(&text).len() == 1 {
            std::thread::sleep(Duration::from_millis(5));
            text = fs::read_to_string(&journal).unwrap_or_default();
        }
        let at_work = child.try_wait().unwrap().is_none();
        child.kill().unwrap();
        child.wait().unwrap();
        let text = fs::read_to_string(&journal).unwrap_or_default();
        let starts = starts(&text);
        // With all nine there, the sweep was writing its tables.
        if let (true, found @ 1..9) = (at_work, starts.len() - 1) {
            // What a kill leaves that comes amidst a row.
            let kept = if found % 3 == 0 { found - 1 } else { found };
            fs::write(&journal, &text[..starts[kept]]).unwrap();
            let (_, err) = said(path, &[&args[..], &["killed"]].concat(), 0);
            // The kill came after the tables were finished.
            if err.contains(", all of them there already") {
                continue;
            }
            // Runs of a row that is not whole are not computed again.
            assert!(err.contains(&format!(", {kept} of them there already")), "{kept}: {err}");
            said(path, &[&args[..], &["whole"]].concat(), 0);
            assert!(bytes(&path.join("killed")) == bytes(&path.join("whole")));
            return;
        }
    }
    panic!("no kill came after the first flush of the journal");
}

/// A table of realisations that was changed is noticed, as the others are.
#[test]
fn a_changed_table_of_realisations_is_noticed() {
    let dir = place();
    let path = dir.path();
    for out in ["sweep", "parts"] {
        let shard: &[&str] = if out == "parts" { &["--shard", "1/1"] } else { &[] };
        said(path, &[&["sweep", "gaps.toml", "--out", out], shard].concat(), 0);
    }
    let whole = bytes(&path.join("sweep"));
    for out in ["sweep", "parts"] {
        let table = path.join(out).join("realisations.csv");
        let text = fs::read_to_string(&table).unwrap();
        fs::write(&table, text.replacen(",ok,", ",no,", 1)).unwrap();
    }
    let (_, err) = said(path, &["merge", "parts", "--out", "merged"], 2);
    assert!(err.contains("realisations.csv"), "{err}");
    let (_, err) = said(path, &["sweep", "gaps.toml", "--out", "sweep"], 0);
    assert!(err.contains("computed again") && err.contains("realisations.csv"), "{err}");
    assert!(bytes(&path.join("sweep")) == whole);
    let (_, err) = said(path, &["sweep", "gaps.toml", "--out", "sweep"], 0);
    assert!(err.contains("all of them there already"), "{err}");
    // Another number of realisations is another request.
    let (_, err) = said(path, &["sweep", "gaps.toml", "--seeds", "4", "--out", "sweep"], 2);
    assert!(err.contains("seeds"), "{err}");
}

#[test]
fn realisations_that_failed_are_named_with_reason_and_count() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("stop.toml"), before_a_stop(20e-3)).unwrap();
    // An explicit rule beyond its stability limit diverges where a realisation reaches the stop.
    let penalty = "penalty:stiffness=1e12,integrator=central-difference";
    let vary = "wall.stop.position=5e-3,20e-3,40e-3";
    let args = ["sweep", "stop.toml", "--vary", vary, "--seeds", "3", "--scheme", penalty, "--out", "out"];
    let args = [&args[..], &["--measure", "displacement_max,contacts"]].concat();
    let (out, err) = said(path, &args, 0);
    assert!(out.contains("Seeds"), "the table says how many realisations are in the means: {out}");
    for words in ["diverged: 1 of 3 rows", "partial: 1 of 3 rows", "row 0: diverged in 3 of 3 realisations (1, 2, 3): "]
    {
        assert!(err.contains(words), "{words}: {err}");
    }
    let means = rows(&path.join("out/sweep.csv"));
    let told = |column: &str| means.iter().map(|row| row[column].clone()).collect::<Vec<_>>();
    assert_eq!(told("status"), ["diverged", "partial", "ok"]);
    assert_eq!(told("seeds"), ["0", "2", "3"]);
    assert!(means[1]["error"].starts_with("diverged in 1 of 3 realisations (3): the run diverged"), "{means:?}");
    assert_eq!(means[0]["displacement_max_m"], "");
    let realisations = rows(&path.join("out/realisations.csv"));
    let of =
        |row: &str, k: &str| realisations.iter().find(|r| r["row"] == row && r["realisation"] == k).unwrap().clone();
    assert_eq!((of("1", "3")["status"].as_str(), of("1", "3")["displacement_max_m"].as_str()), ("diverged", ""));
    let both = ["1", "2"].map(|k| number(&of("1", k), "displacement_max_m"));
    assert_eq!(number(&means[1], "displacement_max_m"), (both[0] + both[1]) / 2.0);
    // The half width of two values: t₁ |a − b|/2, with t₁ from a table.
    let half = number(&means[1], "displacement_max_half_width_95_m");
    assert!((half / (12.706_204_736_2 * (both[0] - both[1]).abs() / 2.0) - 1.0).abs() < 1e-10, "{half}");
    said(path, &[&args[..], &["--strict"]].concat(), 1);
    let (out, _) = said(path, &[&args[..], &["--plan"]].concat(), 0);
    assert!(out.contains("3 rows × 3 realisations by") && out.contains("from 9 realisations tried"), "{out}");
}

/// A sweep file whose varied value has a name.
const STOP_NAMED: &str = "\
case = \"stop.toml\"
[[vary]]
key = \"wall.stop.restitution\"
name = \"NAME\"
values = [0.5, 0.6]
";

#[test]
fn seeds_that_make_no_sense_are_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("stop.toml"), before_a_stop(20e-3)).unwrap();
    let refused = |args: &[&str], words: &[&str]| {
        let (_, err) = said(path, &[&["sweep"], args].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    let stop = ["stop.toml", "--measure", "contacts", "--vary", "wall.stop.position=5e-3,20e-3"];
    let with = |more: &[&'static str]| [&stop[..], more].concat();
    refused(
        &["rigid-walls-sine", "--vary", "wall.upper.position=5e-3,6e-3", "--measure", "contacts", "--seeds", "3"],
        &["--seeds", "a case with a random load"],
    );
    refused(&with(&["--seeds", "1"]), &["--seeds", "2 or more"]);
    refused(&with(&["--seeds", "0"]), &["--seeds", "2 or more"]);
    refused(&with(&["--seeds", "-1"]), &["--seeds"]);
    refused(&with(&["--seeds", "2.5"]), &["--seeds"]);
    refused(&with(&["--seeds", "1000000000"]), &["--seeds", "at most 100000000 runs"]);
    refused(
        &with(&["--seeds", "3", "--vary", "load.1.random.seed=1,2"]),
        &["load.1.random.seed", "no seeds beside it"],
    );
    refused(&with(&["--seeds", "3", "--vary", "load.*.random.seed=1,2"]), &["random.seed", "no seeds beside it"]);
    fs::write(path.join("flow.toml"), IN_A_FLOW).unwrap();
    for vary in ["turbulence.1.seed=1,2", "turbulence.*.seed=1,2"] {
        refused(
            &["flow.toml", "--measure", "contacts", "--seeds", "2", "--vary", vary],
            &["turbulence.", ".seed", "no seeds beside it"],
        );
    }
    refused(
        &[
            "flow.toml",
            "--measure",
            "contacts",
            "--seeds",
            "2",
            "--one-at-a-time",
            "--vary",
            "turbulence.1.seed=1:5",
            "--vary",
            "wall.w.gap=1e-3:3e-3",
        ],
        &["turbulence.1.seed", "no seeds beside it"],
    );
    let named = STOP_NAMED.replace("NAME", "realisation");
    fs::write(path.join("named.toml"), named).unwrap();
    refused(&["named.toml", "--measure", "contacts", "--seeds", "3"], &["realisation", "no other column"]);
    refused(&with(&["--seeds", "3", "--set", "load.1.random.seed=9007199254740992"]), &["at most 1", "2^53"]);
    assert!(!path.join("out").exists(), "a refused request leaves nothing");
}
