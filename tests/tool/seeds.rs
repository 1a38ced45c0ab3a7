//! `run --seeds`: the files, the numbers in them, and what is refused.
use crate::command::said;
use crate::shaken::square_of_bars;
use crate::table::summary;
use std::fs;
use std::path::Path;

/// The square with a stop on the side.
fn square() -> String {
    let stop = "[[wall]]\nname = \"stop\"\ndirection = 45\nside = \"upper\"\nposition = 2.2e-3\nstiffness = 1e5\n";
    let time = "[time]\nend = 3.0\nstep = 1e-3\nstatistics_from = 0.5\n";
    square_of_bars("", &format!("{stop}\n{time}"))
}

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("square.toml"), square()).unwrap();
    dir
}

/// The rows of `realisations.csv`, as cells.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path.join("realisations.csv")).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn the_first_is_the_plain_run_and_any_other_can_be_repeated() {
    let dir = folder();
    let path = dir.path();
    let (out, err) = said(path, &["run", "square.toml", "--seeds", "4", "--out", "four"], 0);
    assert!(out.contains("deviation") && out.contains(" ± "), "{out}");
    assert!(err.contains("over 4 realisations, by Student's t") && err.contains("bars: work rate "), "{err}");
    said(path, &["run", "square.toml", "--out", "plain"], 0);
    for file in ["trajectory.csv", "contacts.csv", "displacement.svg"] {
        let read = |folder: &str| fs::read_to_string(path.join(folder).join(file)).unwrap();
        // A figure says of which realisation it is.
        let titled = if file.ends_with(".svg") { ": draw 1 of 4" } else { "" };
        let four = read("four");
        assert!(four.contains(titled), "{file} does not say that it is a draw");
        assert!(four.replace(titled, "") == read("plain"), "{file} is not that of the plain run");
    }
    let plain = summary(&path.join("plain"));
    assert!(plain.get("realisations").is_none());
    let four = summary(&path.join("four"));
    assert_eq!(four["statistics"], plain["statistics"]);
    assert_eq!(four["case_file"], plain["case_file"]);

    let header = "realisation,place,kind,force_mean_N,force_mean_y_N,force_mean_z_N,force_rms_N,\
                  work_rate_W,friction_power_W,force_largest_N,impact_share,sliding_rate_m_per_s,contacts,\
                  impact_power_W,findings";
    let rows = rows(&path.join("four"));
    assert_eq!(rows[0].join(","), header);
    // Four flats, the stop and the support.
    assert_eq!(rows.len(), 1 + 4 * 6);
    let of = |number: &str, kind: &str| {
        rows.iter().find(|row| row[0] == number && row[2] == kind && !row[1].contains("flat")).unwrap().clone()
    };
    let number = |text: &str| text.parse::<f64>().unwrap();
    // Realisation 3 has the seed 7 + 2.
    said(path, &["run", "square.toml", "--set", "load.1.random.seed=9", "--no-verdict", "--out", "third"], 0);
    let third = summary(&path.join("third"));
    for (run, realisation) in [(&plain, "1"), (&third, "3")] {
        let (bars, stop) = (of(realisation, "support"), of(realisation, "wall"));
        let known = &run["statistics"]["supports"][0];
        let support = &known["force"];
        assert_eq!(Some(number(&bars[3])), support["mean_n"].as_f64());
        assert_eq!(Some(number(&bars[6])), support["rms_n"].as_f64());
        // A rigid support has the largest mean over a stretch, an elastic wall its largest force.
        assert!(number(&bars[9]) > number(&bars[6]));
        assert_eq!(Some(number(&bars[9])), known["force_largest"]["mean_n"].as_f64());
        assert_eq!(known["force_largest"], support["largest"], "a rigid support");
        assert_eq!(Some(number(&bars[7])), run["supports"][0]["work_rate_w"].as_f64());
        assert_eq!(bars[8], "", "a support without friction has no friction power");
        let wall = &run["statistics"]["walls"][0];
        assert_eq!(wall["wall"], "stop");
        assert_eq!(Some(number(&stop[3])), wall["force"]["mean_n"].as_f64());
        assert_eq!(Some(number(&stop[9])), wall["episode_peak_force_n"]["max"].as_f64());
        let flat = rows.iter().find(|row| row[0] == realisation && row[1] == "bars-flat-1").unwrap();
        let all = run["statistics"]["walls"].as_array().unwrap();
        let rigid = all.iter().find(|wall| wall["wall"] == "bars-flat-1").unwrap();
        let largest = rigid["force"]["largest"]["mean_n"].as_f64();
        assert_eq!(number(&flat[9]), largest.unwrap_or(0.0), "a flat is a rigid wall");
        assert_eq!(rigid["force_largest"], rigid["force"]["largest"]);
        let (at, over) = (&wall["force_largest"]["at_s"], &wall["force_largest"]["averaged_over_s"]);
        assert_eq!((wall["force_largest"]["mean_n"].as_f64(), over.as_f64()), (Some(number(&stop[9])), Some(0.0)));
        let contacts =
            fs::read_to_string(path.join(if realisation == "1" { "plain" } else { "third" }).join("contacts.csv"));
        let at_it = contacts.unwrap().lines().any(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            cells[0] == "stop"
                && number(cells[1]) <= at.as_f64().unwrap()
                && at.as_f64().unwrap() <= number(cells[2])
                && cells[4].parse().ok() == Some(number(&stop[9]))
        });
        assert!(at_it, "no contact with that force lasts at {at}");
        assert_eq!(stop[4], "", "a wall has no components");
    }
    // The interval, with t of three degrees of freedom from a table.
    let values: Vec<f64> = (1..=4).map(|k| number(&of(&k.to_string(), "support")[3])).collect();
    let mean = values.iter().sum::<f64>() / 4.0;
    let deviation = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 3.0).sqrt();
    let all = four["realisations"]["estimates"].as_array().unwrap();
    let one = all.iter().find(|one| one["place"] == "bars" && one["measure"] == "force_mean").unwrap();
    let close = |key: &str, x: f64| assert!((one[key].as_f64().unwrap() / x - 1.0).abs() < 1e-9, "{key}: {one}");
    close("mean", mean);
    close("standard_deviation", deviation);
    close("half_width_95", 3.182_446_305_3 * deviation / 2.0);
    assert_eq!((&one["unit"], &one["kind"]), (&"N".into(), &"support".into()));
    assert_eq!(one["error"]["sampling_half_width_95"], one["half_width_95"]);
    assert_eq!(four["realisations"]["interval"], "student_of_realisations");
}

#[test]
fn one_realisation_says_that_its_interval_is_of_batches() {
    let dir = folder();
    let (_, err) = said(dir.path(), &["run", "square.toml", "--seeds", "1", "--no-verdict", "--out", "one"], 0);
    assert!(err.contains("batches of one realisation") && err.contains("--seeds 5 or more"), "{err}");
    assert!(!err.contains("half the step"), "{err}");
    let summary = summary(&dir.path().join("one"));
    assert_eq!(summary["realisations"]["interval"], "batches_of_one_realisation");
    let estimates = summary["realisations"]["estimates"].as_array().unwrap();
    let one = estimates.iter().find(|one| one["place"] == "bars" && one["measure"] == "force_mean").unwrap();
    let own = &summary["statistics"]["supports"][0]["force"];
    assert_eq!((&one["mean"], &one["half_width_95"]), (&own["mean_n"], &own["mean_half_width_95_n"]));
    assert!(one["standard_deviation"].is_null() && one["error"].is_null() && !one["half_width_95"].is_null());
}

#[test]
fn seeds_that_make_no_sense_are_refused() {
    let dir = folder();
    let path = dir.path();
    for (args, words) in [
        (&["square.toml", "--seeds", "0"][..], &["--seeds", "1 or more"][..]),
        (&["square.toml", "--seeds", "-1"], &["--seeds", "expected a whole number, 1 or more"]),
        (&["square.toml", "--seeds", "2.5"], &["--seeds"]),
        (&["rigid-walls-sine", "--seeds", "3"], &["--seeds", "a random load"]),
        (&["rigid-walls-sine", "--seeds", "3", "--accuracy", "1e-3"], &["--seeds", "a random load"]),
        (
            &["square.toml", "--seeds", "3", "--set", "load.1.random.seed=9007199254740992"],
            &["realisation", "at most 1", "2^53"],
        ),
    ] {
        let (_, err) = said(path, &[&["run"], args].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    }
    // Without walls there is nothing whose mean the realisations would give.
    let free = "[system.oscillator]\nmass = 1.0\ndamping = 1.0\nstiffness = 1e3\n[time]\nend = 1.0\nstep = 1e-3\n\
                [[load]]\nrandom = { rms = 1.0, from = 1.0, to = 10.0 }\n";
    fs::write(path.join("free.toml"), free).unwrap();
    for (command, option) in
        [("run", ["--seeds", "3"]), ("run", ["--until-interval", "5%"]), ("compare", ["--seeds", "3"])]
    {
        let (_, err) = said(path, &[&[command, "free.toml"], &option[..]].concat(), 2);
        assert!(err.contains(option[0]) && err.contains("with a wall or a support"), "{command}: {err}");
    }
    assert!(!path.join("out").exists(), "a refused request leaves nothing");
}

const FLOW: [&str; 6] = ["run", "tube-in-cross-flow", "--end", "0.4", "--set", "time.statistics_from=0.1"];

#[test]
fn an_interval_that_is_asked_for_takes_as_many_realisations_as_the_pilots_say() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let wide = ["--until-interval", "60%", "--no-verdict", "--out", "wide"];
    let (_, err) = said(path, &[&FLOW[..], &wide].concat(), 0);
    assert!(err.contains("pilots: after 6 realisations the work rate of support"), "{err}");
    // The realisations are those of `--seeds` of the same number.
    let table = fs::read_to_string(path.join("wide/realisations.csv")).unwrap();
    let count = table.lines().last().unwrap().split(',').next().unwrap().to_owned();
    assert!(err.contains(&format!("± 60.0 % needs {count}\n")), "{err}");
    said(path, &[&FLOW[..], &["--seeds", &count, "--no-verdict", "--out", "same"]].concat(), 0);
    assert_eq!(table, fs::read_to_string(path.join("same/realisations.csv")).unwrap());
    // Where more are needed than allowed, those are run, kept, and the exit code says so.
    let narrow = ["--until-interval", "0.01", "--most-seeds", "8", "--no-verdict", "--out", "narrow"];
    let (_, err) = said(path, &[&FLOW[..], &narrow].concat(), 1);
    assert!(err.contains("an interval of ± 1.0 % was not reached: 8 of"), "{err}");
    assert!(fs::read_to_string(path.join("narrow/realisations.csv")).unwrap().contains("\n8,"));
}

#[test]
fn intervals_that_make_no_sense_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let refused = |args: &[&str], words: &[&str]| {
        let (_, err) = said(dir.path(), args, 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    for share in ["0", "1", "-5%", "100%", "nan", "five"] {
        refused(&[&FLOW[..], &["--until-interval", share]].concat(), &["--until-interval", "above 0 and below 1"]);
    }
    refused(&[&FLOW[..], &["--until-interval", "5%", "--most-seeds", "5"]].concat(), &["--most-seeds", "6 or more"]);
    refused(&[&FLOW[..], &["--until-interval", "5%", "--seeds", "5"]].concat(), &["cannot be used with"]);
    refused(&[&FLOW[..], &["--most-seeds", "50"]].concat(), &["--until-interval"]);
    refused(&["run", "rigid-walls-sine", "--until-interval", "5%"], &["--until-interval", "random load"]);
}

#[test]
fn a_time_limits_the_realisations_to_those_that_fit_and_what_was_run_is_kept() {
    let dir = folder();
    let path = dir.path();
    let asked = ["run", "square.toml", "--until-interval", "1%", "--no-verdict"];
    // Nothing but the pilots fits into a millisecond, and they are run in any case.
    let (_, err) = said(path, &[&asked[..], &["--most-time", "1ms", "--out", "cut"]].concat(), 1);
    assert!(err.contains("; 6 are run: no more fit into 0.001 s, by the time of the pilots"), "{err}");
    assert!(err.contains("error: an interval of ± 1.0 % was not reached: 6 of "), "{err}");
    assert_eq!(summary(&path.join("cut"))["realisations"]["count"], 6);
    // They are those of their number.
    said(path, &["run", "square.toml", "--seeds", "6", "--no-verdict", "--out", "six"], 0);
    let read = |folder: &str| fs::read_to_string(path.join(folder).join("realisations.csv")).unwrap();
    assert_eq!(read("cut"), read("six"));
    // Into a day they all fit, and the limit of their number holds as without a time.
    let day = ["--most-time", "1day", "--most-seeds", "7"];
    let (_, err) = said(path, &[&asked[..], &day, &["--out", "day"]].concat(), 1);
    assert!(err.contains("; 7 are run\n"), "{err}");
    for (args, words) in [
        (&["--until-interval", "1%", "--most-time", "0s"][..], &["--most-time is 0s", "above 0"][..]),
        (&["--until-interval", "1%", "--most-time", "-1s"], &["--most-time is -1s", "above 0"]),
        (&["--until-interval", "1%", "--most-time", "10"], &["--most-time is 10", "with its unit: 10min"]),
        (&["--until-interval", "1%", "--most-time", "soon"], &["--most-time is soon", "with its unit: 10min"]),
        (&["--most-time", "10min"], &["--most-time is 10min", "--until-interval beside it"]),
        (&["--seeds", "6", "--most-time", "10min"], &["--most-time is 10min", "--until-interval beside it"]),
        (&["--accuracy", "20%", "--most-time", "10min"], &["--most-time is 10min", "beside --accuracy"]),
    ] {
        let (_, err) = said(path, &[&["run", "square.toml"], args, &["--out", "refused"]].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    }
    assert!(!path.join("refused").exists(), "a refused request leaves nothing");
}

/// The oscillator between two walls with e = 0.8 at 4.4 Hz has two attractors that are the mirror
/// images of each other. Each start settles on one of them, so that realisations of the start fall
/// into two groups; what one has at the upper wall, the other one has at the lower wall.
#[test]
fn starts_that_settle_on_two_attractors_fall_into_two_groups() {
    let dir = tempfile::tempdir().unwrap();
    let (restitution, frequency) = ("wall.*.restitution=0.8", "load.1.harmonic.frequency=4.4");
    let scatter = "initial.scatter.velocity=0.2";
    let of = ["run", "rigid-walls-sine", "--set", restitution, "--set", frequency, "--set", scatter];
    let until = ["--end", "60", "--set", "time.statistics_from=40", "--scheme", "event", "--seeds", "24"];
    let (_, err) = said(dir.path(), &[&of[..], &until, &["--out", "two", "--no-report"]].concat(), 0);
    assert!(err.contains("the realisations fall into two groups at wall \"upper\": "), "{err}");
    assert!(err.contains("a hole of more than 100 standard deviations within the groups"), "{err}");
    let rows = rows(&dir.path().join("two"));
    let forces = |wall: &str| -> Vec<f64> {
        rows.iter().filter(|row| row[1] == wall).map(|row| row[3].parse().unwrap()).collect()
    };
    let (upper, lower) = (forces("upper"), forces("lower"));
    assert_eq!((upper.len(), lower.len()), (24, 24));
    // Of the first realisation and of its mirror image; settled over 88 periods to 1e-9.
    let alike = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    let (first, mirrored) = (upper[0], lower[0]);
    assert!(!alike(first, mirrored));
    let count = upper.iter().filter(|force| alike(**force, first)).count();
    for (upper, lower) in upper.iter().zip(&lower) {
        let image = alike(*upper, mirrored) && alike(*lower, first);
        assert!(image || (alike(*upper, first) && alike(*lower, mirrored)), "{upper} {lower}");
    }
    let groups = &summary(&dir.path().join("two"))["realisations"]["groups"];
    let mut counts = [count as u64, 24 - count as u64];
    if first > mirrored {
        counts.reverse();
    }
    assert_eq!(groups[0]["counts"], serde_json::json!(counts), "{groups}");
}
