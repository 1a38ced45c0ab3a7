//! Folders of results: one writer at a time, nothing lost by kills and power cuts, and damaged or
//! special files in place of tables.
use crate::command::command;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Longest time that a command of this file may take: only one that hangs does.
const PATIENCE: Duration = Duration::from_secs(120);

fn spawned(folder: &Path, args: &[&str]) -> Child {
    command(folder, args)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(fs::File::create(folder.join("stderr.txt")).unwrap())
        .spawn()
        .unwrap()
}

/// Runs the tool and expects the exit code; gives what it says on stderr.
fn said(folder: &Path, args: &[&str], code: i32) -> String {
    let mut child = spawned(folder, args);
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if started.elapsed() > PATIENCE {
            child.kill().unwrap();
            panic!("{args:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let text = fs::read_to_string(folder.join("stderr.txt")).unwrap();
    assert_eq!(status.code(), Some(code), "{args:?}: {text}");
    assert!(!text.contains("panicked"), "{args:?}: {text}");
    text
}

/// Names and bytes of all files in `folder` and its folders.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all.extend(contents(&path));
        } else {
            all.push((path.clone(), fs::read(&path).unwrap()));
        }
    }
    all.sort();
    all
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Makes the manifest in `folder` one of a version that recorded nothing of its tables.
fn forget_records(folder: &Path) {
    let path = folder.join("request.json");
    let mut manifest = json(&path);
    for records in ["tables", "documents"] {
        manifest.as_object_mut().unwrap().remove(records).unwrap();
    }
    fs::write(path, manifest.to_string()).unwrap();
}

const RUN: [&str; 6] = ["run", "rigid-walls-sine", "--end", "0.2", "--no-verdict", "--out"];

const SWEEP: [&str; 11] = [
    "sweep",
    "rigid-walls-sine",
    "--vary",
    "load.1.harmonic.frequency=4:5:12",
    "--measure",
    "contacts",
    "--samples",
    "impacts",
    "--scheme",
    "event",
    "--out",
];

fn asked<'a>(command: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [command, more].concat()
}

/// The rows and the digest, as `sha256sum` prints it, of a table are those in the manifest and in
/// the summary beside it.
#[test]
fn tables_are_recorded_with_rows_and_digest() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &asked(&RUN, &["run"]), 0);
    said(dir.path(), &asked(&SWEEP, &["sweep"]), 0);
    let compare = ["compare", "chain-20", "--end", "0.02", "--no-verdict", "--out", "compare"];
    said(dir.path(), &compare, 0);
    let mut count = 0;
    for (path, bytes) in contents(dir.path()) {
        if path.extension().is_none_or(|end| end != "csv") {
            continue;
        }
        let relative = path.strip_prefix(dir.path()).unwrap().to_str().unwrap();
        let (folder, name) = relative.split_once('/').unwrap();
        let recorded = &json(&dir.path().join(folder).join("request.json"))["tables"][name];
        let sum = Command::new("sha256sum").arg(&path).output().unwrap().stdout;
        assert_eq!(recorded["sha256"].as_str().unwrap().as_bytes(), &sum[..64], "{relative}");
        assert_eq!(recorded["bytes"], bytes.len());
        // No cell of these tables has a line break.
        assert_eq!(recorded["rows"], bytes.iter().filter(|byte| **byte == b'\n').count() - 1, "{relative}");
        let summary = path.with_file_name("summary.json");
        if summary.exists() {
            assert_eq!(json(&summary)["tables"][path.file_name().unwrap().to_str().unwrap()], *recorded);
            count += 1;
        }
    }
    // Two of the run, two of the sweep, two of each method, and the shape of the first.
    assert!(count > 4 + 2 * 2, "{count} tables");
    // The summary is still a case.
    said(dir.path(), &["run", "run/summary.json", "--end", "0.2", "--no-verdict", "--out", "again"], 0);
    let table = |folder: &str| fs::read(dir.path().join(folder).join("trajectory.csv")).unwrap();
    assert!(table("run") == table("again"));
}

/// A damage of a table: words that name it, and what does it to the file of this path.
type Damage = (&'static str, Box<dyn Fn(&Path)>);

/// All damages of the table at `path`, which is whole.
fn damages(path: &Path) -> Vec<Damage> {
    let whole = fs::read(path).unwrap();
    let lines = whole.iter().filter(|byte| **byte == b'\n').count();
    assert!(lines > 2, "{} has rows to lose", path.display());
    let digit = whole.iter().rposition(u8::is_ascii_digit).unwrap();
    let mut changed = whole.clone();
    changed[digit] = if changed[digit] == b'1' { b'2' } else { b'1' };
    let last = whole[..whole.len() - 1].iter().rposition(|byte| *byte == b'\n').unwrap();
    let (short, more) = (whole[..=last].to_vec(), [&whole[..], &whole[last + 1..]].concat());
    let put = |bytes: Vec<u8>| -> Box<dyn Fn(&Path)> { Box::new(move |path| fs::write(path, &bytes).unwrap()) };
    let mut all: Vec<Damage> = vec![
        ("was changed", put(changed)),
        ("rows in", put(short)),
        ("bytes, where", put(more)),
        ("is empty", put(Vec::new())),
        ("no such file", Box::new(|_| {})),
        ("a folder", Box::new(|path| fs::create_dir(path).unwrap())),
    ];
    if cfg!(unix) {
        let command = |name: &'static str, before: &'static [&'static str]| -> Box<dyn Fn(&Path)> {
            Box::new(move |path| assert!(Command::new(name).args(before).arg(path).status().unwrap().success()))
        };
        all.push(("not a regular file", command("ln", &["-s", "/dev/zero"])));
        all.push(("not a regular file", command("mkfifo", &[])));
    }
    all
}

/// Puts each damage in place of the table at `path`, calls `then` with the words that name it, and
/// puts the table back.
fn damaged(path: &Path, then: impl Fn(&str)) {
    let whole = fs::read(path).unwrap();
    let remove = || {
        let is_folder = fs::symlink_metadata(path).is_ok_and(|meta| meta.is_dir());
        let _ = if is_folder { fs::remove_dir(path) } else { fs::remove_file(path) };
    };
    for (words, damage) in damages(path) {
        remove();
        damage(path);
        then(words);
        remove();
        fs::write(path, &whole).unwrap();
    }
}

#[test]
fn a_report_names_the_table_that_is_not_as_it_was_written() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &asked(&RUN, &["run"]), 0);
    said(dir.path(), &asked(&SWEEP, &["sweep"]), 0);
    for (folder, tables) in [("run", ["trajectory.csv", "contacts.csv"]), ("sweep", ["sweep.csv", "samples.csv"])] {
        for name in tables {
            let before = fs::read(dir.path().join(folder).join("report.html")).unwrap();
            damaged(&dir.path().join(folder).join(name), |words| {
                let told = said(dir.path(), &["report", folder], 2);
                assert!(told.contains(name) && told.contains(words), "{folder}/{name}, {words}: {told}");
            });
            said(dir.path(), &["report", folder], 0);
            assert!(fs::read(dir.path().join(folder).join("report.html")).unwrap() == before);
        }
        // Of a version that recorded nothing the tables are read as they are, and that is said.
        forget_records(&dir.path().join(folder));
        assert!(said(dir.path(), &["report", folder], 0).contains("not verified"));
        for special in ["summary.json", tables[0]] {
            let path = dir.path().join(folder).join(special);
            fs::remove_file(&path).unwrap();
            assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
            let told = said(dir.path(), &["report", folder], 2);
            assert!(told.contains(special) && told.contains("not a regular file"), "{told}");
            fs::remove_file(&path).unwrap();
            said(dir.path(), &asked(if folder == "run" { &RUN } else { &SWEEP }, &[folder, "--force"]), 0);
        }
    }
}

/// Tables that no page shows, too, and those in the folders of a folder.
#[test]
fn a_report_names_any_recorded_file_that_is_not_as_it_was_written() {
    let dir = tempfile::tempdir().unwrap();
    let tube = ["new", "tube", "--length", "2", "--supports", "3", "--out", "t.toml"];
    said(dir.path(), &tube, 0);
    let short = ["--set", "time.end=0.02", "--set", "system.modes=6", "--set", "time.step=4e-5", "--no-verdict"];
    let short = [&short[..], &["--set", "time.statistics_from=0.004"]].concat();
    said(dir.path(), &[&["run", "t.toml", "--seeds", "2", "--out", "run"], &short[..]].concat(), 0);
    said(dir.path(), &[&["compare", "t.toml", "--out", "compare"], &short[..]].concat(), 0);
    for (folder, least) in [("run", 8), ("compare", 8)] {
        let manifest = json(&dir.path().join(folder).join("request.json"));
        let names = |key: &str| manifest[key].as_object().unwrap().keys().cloned().collect::<Vec<String>>();
        let all = [names("tables"), names("documents")].concat();
        assert!(all.len() >= least && all.iter().any(|name| name.ends_with("supports.csv")), "{all:?}");
        for name in all {
            let path = dir.path().join(folder).join(&name);
            let whole = fs::read(&path).unwrap();
            let last = whole.len() - 2;
            let changed = [&whole[..last], b"~", &whole[last + 1..]].concat();
            for (words, damage) in
                [("was changed", Some(&changed[..])), ("is empty", Some(&[])), ("no such file", None)]
            {
                fs::remove_file(&path).unwrap();
                damage.into_iter().for_each(|bytes| fs::write(&path, bytes).unwrap());
                let told = said(dir.path(), &["report", folder], 2);
                assert!(told.contains(&name) && told.contains(words), "{folder}/{name}, {words}: {told}");
                // Nor is another page drawn over it.
                if folder == "run" && damage.is_none() {
                    let over = said(dir.path(), &["report", "compare", "--over", folder, "--out", "over.html"], 2);
                    assert!(over.contains(&name), "{name}: {over}");
                }
                fs::write(&path, &whole).unwrap();
            }
        }
        said(dir.path(), &["report", folder], 0);
    }
}

#[test]
fn a_report_names_the_summary_that_was_changed() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &asked(&RUN, &["run"]), 0);
    let path = dir.path().join("run/summary.json");
    let whole = fs::read_to_string(&path).unwrap();
    let recorded = &json(&dir.path().join("run/request.json"))["documents"]["summary.json"];
    assert_eq!(recorded["bytes"], whole.len());
    let at = whole.find("\"impulse_n_s\"").expect("the impulse of a wall");
    let digit = at + whole[at..].find(|c: char| c.is_ascii_digit() && c != '9').unwrap();
    let changed = format!("{}9{}", &whole[..digit], &whole[digit + 1..]);
    for (words, text) in [("was changed", changed.as_str()), ("is empty", ""), ("bytes were written", &whole[1..])] {
        fs::write(&path, text).unwrap();
        let told = said(dir.path(), &["report", "run"], 2);
        assert!(told.contains("summary.json") && told.contains(words), "{words}: {told}");
    }
    fs::write(&path, whole).unwrap();
    said(dir.path(), &["report", "run"], 0);
}

#[test]
fn a_finished_sweep_is_computed_again_where_a_table_is_damaged() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &asked(&SWEEP, &["out"]), 0);
    let tables = ["sweep.csv", "samples.csv"].map(|name| dir.path().join("out").join(name));
    let whole = tables.each_ref().map(|path| fs::read(path).unwrap());
    let again = |words: &str| {
        let told = said(dir.path(), &asked(&SWEEP, &["out"]), 0);
        assert!(told.contains("computed again") && told.contains(words), "{words}: {told}");
        assert!(!told.contains("there already"), "{words}: {told}");
        assert!(tables.each_ref().map(|path| fs::read(path).unwrap()) == whole, "{words}");
    };
    for path in &tables {
        damaged(path, |words| {
            // A folder in the way has to be removed by its owner.
            if words != "a folder" {
                again(words);
            }
        });
    }
    // As after a power cut: the names are on the disk, the contents are not, the journal is gone.
    tables.iter().for_each(|path| fs::write(path, "").unwrap());
    again("is empty");
    assert!(said(dir.path(), &asked(&SWEEP, &["out"]), 0).contains("all of them there already"));
    // Of a version that recorded nothing, the number of rows is still known.
    forget_records(&dir.path().join("out"));
    let short = whole[0].split_inclusive(|byte| *byte == b'\n').take(7).collect::<Vec<_>>().concat();
    fs::write(&tables[0], short).unwrap();
    again("6 of 12 rows");
    forget_records(&dir.path().join("out"));
    assert!(said(dir.path(), &asked(&SWEEP, &["out"]), 0).contains("all of them there already"));
    assert!(json(&dir.path().join("out/request.json"))["tables"]["samples.csv"]["rows"].is_u64());
}

#[test]
fn a_damaged_shard_is_named_and_nothing_is_merged() {
    let dir = tempfile::tempdir().unwrap();
    let basin = [
        "sweep",
        "rigid-walls-sine",
        "--set",
        "wall.*.restitution=0.8",
        "--vary",
        "initial.displacement=-4e-3:4e-3:4",
        "--vary",
        "initial.velocity=-0.3:0.3:3",
        "--measure",
        "attractor",
        "--settle",
        "30",
        "--keep",
        "20",
        "--scheme",
        "event",
        "--out",
    ];
    let sweeps: [(&str, &[&str], &[&str]); 2] =
        [("a", &SWEEP, &["sweep.csv", "samples.csv"]), ("b", &basin, &["sweep.csv", "attractors.csv"])];
    for (out, request, names) in sweeps {
        said(dir.path(), &asked(request, &[out]), 0);
        let parts = format!("{out}-parts");
        for shard in ["1/2", "2/2"] {
            said(dir.path(), &asked(request, &[&parts, "--shard", shard]), 0);
        }
        let (merged, shard) = (dir.path().join("merged"), dir.path().join(&parts).join("shard-2-of-2"));
        for name in names {
            let all = |words: &str| {
                let told = said(dir.path(), &["merge", &parts, "--out", "merged"], 2);
                assert!(told.contains(name) && told.contains(words), "{name}, {words}: {told}");
                assert!(!merged.exists() || contents(&merged).is_empty(), "{name}, {words}");
            };
            if fs::read(shard.join(name)).unwrap().iter().filter(|byte| **byte == b'\n').count() > 2 {
                damaged(&shard.join(name), all);
            } else {
                let whole = fs::read(shard.join(name)).unwrap();
                fs::write(shard.join(name), "").unwrap();
                all("is empty");
                fs::write(shard.join(name), whole).unwrap();
            }
        }
        said(dir.path(), &["merge", &parts, "--out", "merged"], 0);
        for name in names {
            let table = |folder: &str| fs::read(dir.path().join(folder).join(name)).unwrap();
            assert!(table("merged") == table(out), "{name}");
        }
        // Of a version that recorded nothing, rows are counted.
        forget_records(&shard);
        fs::remove_dir_all(&merged).unwrap();
        assert!(said(dir.path(), &["merge", &parts, "--out", "merged"], 0).contains("not verified"));
        fs::remove_dir_all(&merged).unwrap();
        let whole = fs::read(shard.join("sweep.csv")).unwrap();
        let last = whole.split_inclusive(|byte| *byte == b'\n').next_back().unwrap();
        fs::write(shard.join("sweep.csv"), [&whole[..], last].concat()).unwrap();
        assert!(said(dir.path(), &["merge", &parts, "--out", "merged"], 2).contains("row"));
        assert!(!merged.exists() || contents(&merged).is_empty());
    }
}

/// Each command that takes long holds its folder from the beginning.
#[test]
fn a_second_writer_is_refused_in_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let requests: [&[&str]; 5] = [
        &["run", "rigid-walls-sine", "--end", "1e5", "--step", "1e-5", "--sample", "1", "--no-verdict"],
        &["compare", "rigid-walls-sine", "--end", "1e4", "--step", "1e-5", "--sample", "1", "--no-verdict"],
        &["chart", "rigid-walls-sine", "--end", "1e4", "--steps", "1e-5:1e-6", "--levels", "2"],
        &["stability", "rigid-walls-sine"],
        &[
            "sweep",
            "rigid-walls-sine",
            "--vary",
            "load.1.harmonic.frequency=4:5:8",
            "--measure",
            "contacts",
            "--set",
            "time.end=1e4",
            "--scheme",
            "moreau-jean",
            "--set",
            "time.step=1e-6",
        ],
    ];
    for (index, request) in requests.iter().enumerate() {
        let out = format!("o{index}");
        let mut first = spawned(dir.path(), &asked(request, &["--out", &out]));
        let started = Instant::now();
        // The file stands a moment before its lock is taken, and has content only after that.
        let lock = dir.path().join(&out).join(".signorini.lock");
        while std::fs::metadata(&lock).map_or(0, |file| file.len()) == 0 {
            assert!(first.try_wait().unwrap().is_none(), "{request:?} ends without a lock");
            assert!(started.elapsed() < PATIENCE, "{request:?} takes no lock");
            std::thread::sleep(Duration::from_millis(1));
        }
        let told = said(dir.path(), &asked(request, &["--out", &out]), 2);
        assert!(told.contains(&out) && told.contains("another process is at work"), "{request:?}: {told}");
        first.kill().unwrap();
        first.wait().unwrap();
    }
    // The lock of a killed process counts no more.
    said(dir.path(), &asked(&RUN, &["o0", "--force"]), 0);
    assert!(!dir.path().join("o0/.signorini.lock").exists());
}

/// Whatever the instant: the results before it are whole, or the folder says that they are not; the
/// same command is accepted and leaves nothing of the killed ones.
#[test]
fn a_killed_run_is_repeated_by_the_same_command() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    said(path, &asked(&RUN, &["whole"]), 0);
    let names = |folder: &str| {
        let folder = path.join(folder);
        contents(&folder).iter().map(|(file, _)| file.strip_prefix(&folder).unwrap().to_owned()).collect::<Vec<_>>()
    };
    let kills = std::env::var("SIGNORINI_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(40);
    said(path, &asked(&RUN, &["out"]), 0);
    let mut done = 0;
    for kill in 0..kills {
        let mut child = spawned(path, &asked(&RUN, &["out"]));
        // Spread over twice the time that it takes on a quiet machine.
        std::thread::sleep(Duration::from_micros((kill * 7919) % 60_000));
        done += u32::from(child.try_wait().unwrap().is_some());
        let _ = child.kill();
        child.wait().unwrap();
        let unfinished = json(&path.join("out/request.json")).get("unfinished").is_some();
        let told = said(path, &["report", "out"], if unfinished { 2 } else { 0 });
        assert!(told.contains(if unfinished { "not finished" } else { "wrote" }), "kill {kill}: {told}");
        // Of another request nothing is replaced.
        let other = ["run", "rigid-walls-sine", "--end", "0.1", "--no-verdict", "--out", "out"];
        assert!(said(path, &other, 2).contains("another request"), "kill {kill}");
        if kill % 4 == 0 {
            said(path, &asked(&RUN, &["out"]), 0);
            assert_eq!(names("out"), names("whole"), "kill {kill}");
        }
    }
    println!("{done} of {kills} were done before they were killed");
    said(path, &asked(&RUN, &["out"]), 0);
    assert_eq!(names("out"), names("whole"));
    for table in ["trajectory.csv", "contacts.csv"] {
        assert!(fs::read(path.join("out").join(table)).unwrap() == fs::read(path.join("whole").join(table)).unwrap());
    }
}

/// The folder as a kill between two of the files leaves it, with what was still to be written, and
/// with temporary files of earlier versions.
#[test]
fn what_a_kill_amidst_the_files_leaves_is_replaced_and_taken_away() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("out");
    said(dir.path(), &asked(&RUN, &["out"]), 0);
    let mut manifest = json(&path.join("request.json"));
    manifest["unfinished"] = true.into();
    manifest["files"].as_array_mut().unwrap().push("earlier/old.csv".into());
    fs::write(path.join("request.json"), manifest.to_string()).unwrap();
    fs::create_dir_all(path.join("earlier")).unwrap();
    fs::create_dir_all(path.join(".signorini.partial/deep")).unwrap();
    for name in [
        "earlier/old.csv",
        "earlier/.old.csv.77-1.partial",
        ".summary.json.4242-7.partial",
        ".signorini.partial/deep/a.csv",
        ".signorini.lock",
        "mine.txt",
    ] {
        fs::write(path.join(name), "left").unwrap();
    }
    fs::remove_file(path.join("trajectory.csv")).unwrap();
    assert!(said(dir.path(), &["report", "out"], 2).contains("not finished"));
    said(dir.path(), &asked(&RUN, &["out"]), 0);
    let left: Vec<PathBuf> = contents(&path).into_iter().map(|(file, _)| file).collect();
    let hidden = |file: &PathBuf| file.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
    assert!(!left.iter().any(hidden) && !path.join("earlier").exists(), "{left:?}");
    assert!(path.join("mine.txt").exists() && path.join("trajectory.csv").exists());
    said(dir.path(), &["report", "out"], 0);
}

/// A full disk during the run leaves the earlier results as they were.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_earlier_results() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &asked(&RUN, &["out"]), 0);
    let before = contents(&dir.path().join("out"));
    // Files of at most 8 blocks of 1024 bytes: writing beyond fails, as on a full disk.
    let tool = env!("CARGO_BIN_EXE_signorini");
    let script = format!("trap '' XFSZ; ulimit -f 8; exec {tool} {}", asked(&RUN, &["out"]).join(" "));
    let output = Command::new("bash").args(["-c", &script]).current_dir(dir.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(contents(&dir.path().join("out")) == before);
}

/// Files that a user names: pipes would wait, devices have no end.
#[cfg(unix)]
#[test]
fn special_files_in_place_of_named_ones_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    assert!(Command::new("mkfifo").arg(dir.path().join("pipe")).status().unwrap().success());
    fs::create_dir(dir.path().join("folder")).unwrap();
    let case = "rigid-walls-sine";
    for file in ["pipe", "/dev/zero", "folder"] {
        let table = format!(
            "[system.oscillator]\nmass = 1.0\ndamping = 1.0\nstiffness = 100.0\n[time]\nend = 1.0\nstep = 1e-3\n\
             [[load]]\ntable = {{ file = \"{file}\" }}\n"
        );
        fs::write(dir.path().join("case.toml"), table).unwrap();
        let requests: [&[&str]; 9] = [
            &["run", file],
            &["explain", file],
            &["compare", file],
            &["sweep", file],
            &["sweep", file, "--vary", "time.end=1:2:2"],
            &["run", "case.toml"],
            &["orbit", case, "--set", "wall.*.restitution=0.8", "--from", file],
            &["report", file],
            &["merge", file, "--out", "merged"],
        ];
        for request in requests {
            let told = said(dir.path(), request, 2);
            let name = file.trim_start_matches('/');
            assert!(told.contains(name), "{request:?}: {told}");
        }
    }
    let sweep = ["continue", case, "--set", "wall.*.restitution=0.8", "--key", "load.1.harmonic.frequency"];
    let told = said(dir.path(), &asked(&sweep, &["--range", "4:5", "--over", "pipe"]), 2);
    assert!(told.contains("not a regular file"), "{told}");
}

/// A page of the user's own is no result of the tool: a run into its folder leaves it.
#[test]
fn a_page_that_no_manifest_lists_is_not_replaced() {
    let dir = tempfile::tempdir().unwrap();
    let (folder, page) = (dir.path(), dir.path().join("out/report.html"));
    fs::create_dir(page.parent().unwrap()).unwrap();
    fs::write(&page, "of the user").unwrap();
    let args = ["run", "bouncing-ball", "--end", "0.1", "--out", "out"];
    assert!(said(folder, &args, 2).contains("holds results (report.html) but no request.json"));
    assert_eq!(fs::read_to_string(&page).unwrap(), "of the user");
    said(folder, &[&args[..], &["--force"]].concat(), 0);
    assert!(fs::read_to_string(&page).unwrap().starts_with("<!doctype html>"));
}
