//! What the tool prints: lines as wide as the terminal, the page to open, what differs and what is
//! left out by name, and what a path should have been.
use crate::command::command;
use std::fs;
use std::path::Path;

/// Runs the tool in `folder`, on a terminal of `width` columns where one is given, and expects the
/// exit code; gives stdout and stderr.
fn on(width: Option<usize>, folder: &Path, args: &[&str], code: i32) -> (String, String) {
    let mut command = command(folder, args);
    if let Some(width) = width {
        command.env("COLUMNS", width.to_string());
    }
    let output = command.output().unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert_eq!(output.status.code(), Some(code), "{args:?}: {err}");
    (out, err)
}

fn said(folder: &Path, args: &[&str], code: i32) -> String {
    on(None, folder, args, code).1
}

/// Messages of a run, and the sentences of `explain`, have the same words on a terminal of any
/// width, and no line has more columns unless a single word has.
#[test]
fn lines_break_between_words() {
    let dir = tempfile::tempdir().unwrap();
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let run = ["run", "rigid-walls-sine", "--end", "0.5", "--no-verdict", "--no-report"];
    let explain = ["explain", "tube-round-supports"];
    let refused = ["run", "rigid-walls-sine", "--scheme", "event", "--step", "1e-3"];
    // The time that a run took differs from run to run.
    let of = |width: Option<usize>| {
        let text = [on(width, dir.path(), &run, 0).1, on(width, dir.path(), &refused, 2).1];
        let timed = |line: &&str| !line.contains("energy balance") && !line.contains(" made ");
        let lines = text.concat();
        lines.lines().filter(timed).collect::<Vec<_>>().join("\n")
    };
    let timed = |text: String| text.split("time of a run").next().unwrap_or_default().to_owned();
    let explained = |width: Option<usize>| timed(on(width, dir.path(), &explain, 0).0);
    let whole = explained(None);
    assert!(whole.lines().any(|line| line.chars().count() > 120));
    of(None);
    for width in [40, 80, 120] {
        assert_eq!(words(&explained(Some(width))), words(&whole), "{width}");
        for text in [of(Some(width)), explained(Some(width))] {
            for line in text.lines() {
                assert!(line.chars().count() <= width || words(line).len() == 1, "{width}: {line:?}");
            }
        }
    }
}

#[test]
fn the_last_line_names_the_page_to_open() {
    let dir = tempfile::tempdir().unwrap();
    let orbit = ["--set", "wall.*.restitution=0.8", "--set", "load.1.harmonic.frequency=5"];
    for (number, args) in [
        &["run", "rigid-walls-sine", "--end", "0.2"][..],
        &["run", "rigid-walls-sine", "--end", "0.2", "--accuracy", "1e-2"],
        &["compare", "rigid-walls-sine", "--end", "0.2"],
        &["sweep", "rigid-walls-sine", "--vary", "time.end=0.2,0.3", "--measure", "contacts"],
        &[&["orbit", "rigid-walls-sine"][..], &orbit].concat(),
    ]
    .iter()
    .enumerate()
    {
        let out = format!("out-{number}");
        let err = said(dir.path(), &[args, &["--out", &out][..]].concat(), 0);
        let page = format!("{out}/report.html");
        assert_eq!(err.lines().last(), Some(format!("results in {out}; open {page}").as_str()), "{args:?}: {err}");
        assert!(dir.path().join(&page).is_file(), "{page}");
        let bare = said(dir.path(), &[args, &["--out", &out, "--no-report"][..]].concat(), 0);
        assert_eq!(bare.lines().last(), Some(format!("results in {out}").as_str()), "{args:?}: {bare}");
    }
    let sweep = ["sweep", "rigid-walls-sine", "--vary", "time.end=0.2,0.3", "--measure", "contacts"];
    for shard in ["1/2", "2/2"] {
        said(dir.path(), &[&sweep[..], &["--shard", shard, "--out", "parts"]].concat(), 0);
    }
    let err = said(dir.path(), &["merge", "parts", "--out", "whole"], 0);
    assert_eq!(err.lines().last(), Some("results in whole; open whole/report.html"), "{err}");
    let bare = said(dir.path(), &["merge", "parts", "--out", "whole", "--no-report"], 0);
    assert_eq!(bare.lines().last(), Some("results in whole"), "{bare}");
    assert!(!dir.path().join("whole/report.html").exists());
    let err = said(dir.path(), &["report", "out-0"], 0);
    assert_eq!(err.lines().last(), Some("wrote the page; open out-0/report.html"), "{err}");
}

#[test]
fn a_refusal_of_another_request_names_the_values_that_differ() {
    let dir = tempfile::tempdir().unwrap();
    let run = |case: &str, more: &[&str], code: i32| {
        let out = format!("out-{case}");
        let own = ["run", case, "--end", "0.01", "--no-verdict", "--no-report", "--out", &out];
        said(dir.path(), &[&own[..], more].concat(), code)
    };
    run("rigid-walls-sine", &[], 0);
    let err = run("rigid-walls-sine", &["--set", "wall.upper.position=6e-3", "--restitution", "0.5"], 2);
    for line in [
        "  wall.upper.position: 0.005 there, 0.006 asked\n",
        "  wall.upper.restitution: 1 there, 0.5 asked\n",
        "  wall.lower.restitution: 1 there, 0.5 asked\n",
    ] {
        assert!(err.contains(line), "{line}: {err}");
    }
    assert!(!err.contains("walls: other"), "{err}");
    run("tube-round-supports", &[], 0);
    let err = run("tube-round-supports", &["--set", "support.plate-1.gap=3e-4"], 2);
    assert!(err.contains("  support.plate-1.gap: 2e-4 there, 3e-4 asked\n"), "{err}");
    // Another number of rows of a table has no value by which it could be named.
    let table = |rows: &str| fs::write(dir.path().join("force.csv"), format!("time_s,force_N\n{rows}")).unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1.0\n\
        [[load]]\ntable = { file = \"force.csv\" }\n[time]\nend = 1.0\nstep = 1e-3\n";
    fs::write(dir.path().join("pulse.toml"), case).unwrap();
    table("0,0\n1,1\n");
    run("pulse.toml", &[], 0);
    table("0,0\n1,2\n");
    let err = run("pulse.toml", &[], 2);
    assert!(err.contains("  loads: other data there\n"), "{err}");
}

#[test]
fn a_path_of_the_wrong_kind_is_refused_with_what_was_expected() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("file"), "x").unwrap();
    fs::create_dir(dir.path().join("folder")).unwrap();
    let orbit = ["orbit", "rigid-walls-sine", "--from", "folder"];
    let branches = ["continue", "rigid-walls-sine", "--key", "load.1.harmonic.frequency", "--range", "4:5"];
    let merge = |from| ["merge", from, "--out", "merged"];
    for (args, expected) in [
        (&["run", "linear-sine", "--out", "file"][..], "this is a file, where a folder for results is expected"),
        (&["run", "linear-sine", "--out", "file/within"], "file is a file, where a folder is expected"),
        (&merge("file"), "expected a shard of a sweep, or a folder that holds shards"),
        (&merge("nowhere"), "expected a shard of a sweep, or a folder that holds shards"),
        (&orbit, "a folder, not a file; expected the orbit.json of `signorini orbit`"),
        (
            &[&branches[..], &["--over", "folder"]].concat(),
            "expected a folder of results of sweep, continue, orbit, run or compare",
        ),
        (&["chart", "rigid-walls-sine", "--with", "folder"], "expected a CSV file with the columns program"),
    ] {
        let err = said(dir.path(), args, 2);
        assert!(err.contains(expected), "{args:?}: {err}");
    }
}

#[test]
fn values_of_a_grid_are_those_that_would_be_typed() {
    let dir = tempfile::tempdir().unwrap();
    let column = |vary: &str, out: &str| {
        let own = ["sweep", "rigid-walls-sine", "--set", "time.end=0.02", "--vary", vary, "--measure", "contacts"];
        said(dir.path(), &[&own[..], &["--no-report", "--out", out]].concat(), 0);
        let table = fs::read_to_string(dir.path().join(out).join("sweep.csv")).unwrap();
        table.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(column("time.step=1e-3:1e-5:3:log", "log"), ["0.001", "0.0001", "0.00001"]);
    assert_eq!(column("penalty.epsilon.0=1e-12:1e-6:7:log", "wide")[1..4], ["1e-11", "1e-10", "1e-9"]);
    let tenths = column("initial.velocity=-1:1:21", "linear");
    assert_eq!(tenths[9..14], ["-0.1", "0.0", "0.1", "0.2", "0.3"]);
    // What no one would type stays as it is computed.
    let thirds: f64 = column("initial.velocity=0:1:4", "thirds")[1].parse().unwrap();
    assert_eq!(thirds, 1.0 / 3.0);
}

#[test]
fn curves_and_measures_that_a_picture_leaves_out_are_named() {
    let dir = tempfile::tempdir().unwrap();
    let own = ["sweep", "rigid-walls-sine", "--set", "time.end=0.3", "--no-report"];
    let run = |more: &[&str], out: &str| said(dir.path(), &[&own[..], more, &["--out", out]].concat(), 0);
    // Two walls by five restitutions: ten curves, of which eight are drawn.
    let frequency = ["--vary", "load.1.harmonic.frequency=4:5:7", "--measure", "contacts"];
    let err = run(&[&["--vary", "wall.*.restitution=0.5,0.6,0.7,0.8,0.9"][..], &frequency].concat(), "curves");
    let named = "no room for contacts upper: restitution 0.9; contacts lower: restitution 0.9; sweep.csv has them all";
    assert!(err.contains(named), "{err}");
    let measures = "contacts,impulse,force_mean,force_rms,impact_power,displacement_max";
    let err = run(&["--vary", "load.1.harmonic.frequency=4:5:7", "--measure", measures], "panels");
    assert!(err.contains("no room for impact_power; displacement_max; sweep.csv has them all"), "{err}");
    let map = ["--vary", "load.1.harmonic.frequency=4:5:6", "--vary", "load.1.harmonic.amplitude=2:3:6"];
    let err = run(&[&map[..], &["--measure", "displacement_max,velocity_max"]].concat(), "map");
    assert!(err.contains("no room for velocity_max_m_per_s; sweep.csv has them all"), "{err}");
}

#[test]
fn starts_whose_attractor_was_not_found_are_counted() {
    let dir = tempfile::tempdir().unwrap();
    // Three periods are too few for an orbit to repeat itself three times.
    let starts = ["--vary", "initial.displacement=-4e-3:4e-3:6", "--vary", "initial.velocity=-0.3:0.3:6"];
    let run = |keep: &str, out: &str| {
        let own = ["sweep", "rigid-walls-sine", "--set", "wall.*.restitution=0.8", "--measure", "attractor"];
        let by = ["--scheme", "event", "--settle", "1", "--keep", keep, "--no-report", "--out", out];
        let err = said(dir.path(), &[&own[..], &starts, &by].concat(), 0);
        let table = fs::read_to_string(dir.path().join(out).join("sweep.csv")).unwrap();
        (table.lines().filter(|line| line.ends_with(',')).count(), err)
    };
    let (empty, err) = run("3", "short");
    assert!(empty > 0);
    assert!(err.contains(&format!("undecided: {empty} of 36 starts, whose attractor was not found")), "{err}");
    let (empty, err) = run("400", "long");
    assert!(empty == 0 && !err.contains("undecided"), "{err}");
}

#[test]
fn words_are_those_of_the_field() {
    let dir = tempfile::tempdir().unwrap();
    let run = said(dir.path(), &["run", "rigid-walls-sine", "--end", "0.2"], 0);
    assert!(run.contains("energy balance"), "{run}");
    let help = on(None, dir.path(), &["stability", "--help"], 0).0;
    assert!(help.contains("another-motion"), "{help}");
    let explained = on(None, dir.path(), &["explain", "rigid-walls-sine"], 0).0;
    for text in [run, help, explained] {
        for word in ["ledger", "astray", "source scene"] {
            assert!(!text.contains(word), "{word}: {text}");
        }
    }
}

#[test]
fn a_wrong_command_line_is_a_json_document_too() {
    let dir = tempfile::tempdir().unwrap();
    for (args, words) in [
        (&["run", "--json"][..], "required arguments were not provided"),
        (&["merge", "nope", "--json"], "--out <DIR>"),
        (&["run", "elastic-wall", "--ends", "2", "--json"], "unexpected argument '--ends'"),
        (&["explain", "nowhere", "--json"], "nowhere"),
    ] {
        let (out, err) = crate::command::said(dir.path(), args, 2);
        let document: serde_json::Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{args:?}: {out}"));
        assert_eq!(document["exit_code"], 2, "{args:?}");
        let text = document["error"].as_str().unwrap();
        assert!(text.contains(words) && err.contains(words), "{args:?}: {out}{err}");
    }
    let (out, _) = crate::command::said(dir.path(), &["run", "--help", "--json"], 0);
    assert!(out.contains("Usage:"), "{out}");
}

/// With `--json` every command that writes a folder names it and its files.
#[test]
fn the_document_of_every_command_names_the_folder_and_its_files() {
    let dir = tempfile::tempdir().unwrap();
    let (case, value) = ("rigid-walls-sine", "wall.*.restitution=0.8");
    let branches = ["--key", "load.1.harmonic.frequency", "--range", "4.9:5.1", "--points", "5", "--switch", "no"];
    for args in [
        &["run", case, "--end", "0.1", "--no-verdict"][..],
        &["compare", case, "--end", "0.1", "--no-verdict"],
        &["chart", case, "--end", "0.1", "--levels", "2", "--repeats", "1"],
        &["sweep", case, "--vary", "time.end=0.2,0.3", "--measure", "contacts"],
        &["orbit", case, "--set", value, "--set", "load.1.harmonic.frequency=5"],
        &[&["continue", case, "--set", value, "--set", "load.1.harmonic.frequency=5"][..], &branches].concat(),
    ] {
        let own = ["--json", "--no-report", "--out", args[0]];
        let (out, _) = on(None, dir.path(), &[args, &own[..]].concat(), 0);
        let document: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!(document["results"], args[0], "{args:?}");
        let files = document["files_written"].as_array().unwrap();
        assert!(files.len() > 1, "{args:?}");
        for file in files {
            assert!(dir.path().join(args[0]).join(file.as_str().unwrap()).is_file(), "{args:?}: {file}");
        }
    }
}
