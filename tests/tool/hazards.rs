//! The tool must not hang, mislead or lose results: names, output that cannot be written, widths,
//! JSON, words, time.
use crate::command::{command, said};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

const CASE: &str = "rigid-walls-sine";

#[test]
fn results_of_another_request_are_kept_by_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let commands: [(&[&str], &str); 4] = [
        (&["run", CASE, "--no-verdict"], "out/rigid-walls-sine/run/summary.json"),
        (&["compare", CASE, "--no-verdict"], "out/rigid-walls-sine/compare/compare.csv"),
        (
            &["chart", CASE, "--schemes", "event,moreau-jean", "--steps", "1e-3:1e-4", "--levels", "2"],
            "out/rigid-walls-sine/chart/work-precision.csv",
        ),
        (&["run", CASE, "--accuracy", "1e-3", "--out", "accurate"], "accurate/summary.json"),
    ];
    for (command, file) in commands {
        let ask = |more: &[&str], code| said(dir.path(), &[command, more].concat(), code).1;
        ask(&["--end", "0.4"], 0);
        let before = fs::read(dir.path().join(file)).unwrap();
        let refused = ask(&["--end", "0.2"], 2);
        for words in ["another request", "made 20", "end_s: 0.4 there, 0.2 asked", "--force", "--out"] {
            assert!(refused.contains(words), "{command:?} does not say {words}: {refused}");
        }
        assert_eq!(fs::read(dir.path().join(file)).unwrap(), before, "{command:?}");
        let again = ask(&["--end", "0.4"], 0);
        assert!(again.contains("replaced the results in") && again.contains("made 20"), "{command:?}: {again}");
        ask(&["--end", "0.2", "--force"], 0);
        assert_ne!(fs::read(dir.path().join(file)).unwrap(), before, "{command:?}");
    }
}

#[test]
fn an_edited_case_is_another_request_and_an_edited_comment_is_not() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mine.toml");
    said(dir.path(), &["new", CASE, "--out", "mine.toml"], 0);
    let original = fs::read_to_string(&path).unwrap();
    let ask = |code| said(dir.path(), &["run", "mine.toml", "--no-verdict", "--end", "0.1"], code).1;
    ask(0);
    fs::write(&path, format!("# measured on Monday\n{original}")).unwrap();
    ask(0);
    fs::write(&path, original.replace("restitution = 1.0", "restitution = 0.9")).unwrap();
    assert!(ask(2).contains("wall.upper.restitution: 1 there, 0.9 asked"));
}

#[test]
fn nothing_of_a_replaced_comparison_stays_beside_the_new_one() {
    let dir = tempfile::tempdir().unwrap();
    let ask = |schemes: &str, more: &[&str]| {
        let request = [&["compare", CASE, "--end", "0.1", "--no-verdict", "--schemes", schemes][..], more].concat();
        said(dir.path(), &request, 0)
    };
    let folder = dir.path().join("out/rigid-walls-sine/compare");
    ask("moreau-jean,newmark", &[]);
    assert!(folder.join("newmark/summary.json").exists());
    fs::write(folder.join("notes.txt"), "mine").unwrap();
    ask("moreau-jean", &["--force"]);
    assert!(!folder.join("newmark").exists() && folder.join("moreau-jean/summary.json").exists());
    assert!(folder.join("notes.txt").exists(), "only results are taken away");
}

#[test]
fn a_file_beats_a_built_in_case_and_the_tool_says_which_it_took() {
    let dir = tempfile::tempdir().unwrap();
    let explained = || said(dir.path(), &["explain", "elastic-wall"], 0);
    let (built_in, message) = explained();
    assert!(message.contains("the built-in case"), "{message}");
    said(dir.path(), &["new", "elastic-wall"], 0);
    let path = dir.path().join("elastic-wall.toml");
    let edited = fs::read_to_string(&path).unwrap().replace("mass = 1.0", "mass = 3.0");
    fs::write(&path, edited).unwrap();
    let (own, message) = explained();
    assert!(message.contains("the file elastic-wall.toml, not the built-in case"), "{message}");
    assert_ne!(own.lines().nth(2), built_in.lines().nth(2), "the natural frequency is that of the file");
    for command in ["run", "compare", "stability", "chart"] {
        let (_, message) = said(dir.path(), &[command, "elastic-wall", "--restitution", "7"], 2);
        assert!(message.contains("the file elastic-wall.toml"), "{command}: {message}");
    }
    // A folder of that name, such as one of results, is no case.
    fs::create_dir(dir.path().join("bouncing-ball")).unwrap();
    assert!(said(dir.path(), &["explain", "bouncing-ball"], 0).1.contains("the built-in case"));
}

#[cfg(target_os = "linux")]
#[test]
fn an_answer_that_cannot_be_written_is_a_failure() {
    let dir = tempfile::tempdir().unwrap();
    let requests: [&[&str]; 8] = [
        &["new"],
        &["--help"],
        &["--version"],
        &["explain", CASE],
        &["completions", "bash"],
        &["run", CASE, "--end", "0.1", "--no-verdict"],
        &["run", CASE, "--end", "0.1", "--no-verdict", "--json"],
        &["compare", CASE, "--end", "0.1", "--no-verdict"],
    ];
    for request in requests {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = command(dir.path(), request).stdout(full).output().unwrap();
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{request:?}: {message}");
        assert!(message.contains("error: standard output: No space left"), "{request:?}: {message}");
    }
}

/// Where stdout is closed the runtime opens /dev/null in its place, so that every write succeeds.
#[cfg(unix)]
#[test]
fn a_closed_stdout_is_a_failure_and_one_that_is_thrown_away_is_none() {
    let dir = tempfile::tempdir().unwrap();
    let shell = |request: &[&str], redirection: &str| {
        let script = format!("exec \"$0\" \"$@\" {redirection}");
        let tool = env!("CARGO_BIN_EXE_signorini");
        Command::new("sh").args(["-c", &script, tool]).args(request).current_dir(dir.path()).output().unwrap()
    };
    let requests: [&[&str]; 7] = [
        &["new"],
        &["--help"],
        &["run", "--help"],
        &["explain", CASE],
        &["completions", "bash"],
        &["run", CASE, "--end", "0.1", "--no-verdict"],
        &["run", CASE, "--end", "0.1", "--no-verdict", "--json"],
    ];
    for request in requests {
        let closed = shell(request, ">&-");
        let message = text(&closed.stderr);
        assert_eq!(closed.status.code(), Some(1), "{request:?}: {message}");
        assert!(message.contains("error: standard output: it is closed"), "{request:?}: {message}");
        for thrown_away in [">/dev/null", ">/dev/null 2>&-", "2>&-"] {
            let output = shell(request, thrown_away);
            assert_eq!(output.status.code(), Some(0), "{request:?} {thrown_away}: {}", text(&output.stderr));
        }
        // As by a program that ignores the output, such as one with subprocess.DEVNULL.
        let output = command(dir.path(), request).stdout(Stdio::null()).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{request:?}: {}", text(&output.stderr));
    }
    // The error of a wrong request goes to stderr, and needs no stdout.
    assert_eq!(shell(&["run", CASE, "--no-such-option"], ">&-").status.code(), Some(2));
    // Files are no answer: all of them are written before it.
    assert!(dir.path().join("out/rigid-walls-sine/run/request.json").exists());
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let dir = tempfile::tempdir().unwrap();
    for request in [&["completions", "bash"][..], &["explain", CASE], &["--help"], &["compare", CASE, "--end", "0.1"]] {
        let mut child = command(dir.path(), request).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // As `head` does once it has its lines.
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{request:?}: {message}");
        assert!(!message.contains("panicked") && !message.contains("roken pipe"), "{request:?}: {message}");
    }
}

#[test]
fn tables_fit_the_terminal_and_no_number_is_broken() {
    let dir = tempfile::tempdir().unwrap();
    let requests: [&[&str]; 4] = [
        &["compare", CASE, "--end", "0.3", "--no-verdict"],
        &["compare", "chain-20", "--end", "0.02", "--no-verdict"],
        &["run", "tube-loose-supports", "--end", "0.05", "--no-verdict"],
        &["chart", CASE, "--end", "0.1", "--steps", "1e-3:5e-4", "--levels", "2", "--repeats", "1"],
    ];
    for request in requests {
        for width in [40, 80, 120, 200] {
            let columns = width.to_string();
            let request = [request, &["--quiet"]].concat();
            let output = command(dir.path(), &request).env("COLUMNS", &columns).output().unwrap();
            let table = text(&output.stdout);
            assert!(output.status.success() && !table.trim().is_empty(), "{request:?}");
            for line in table.lines() {
                assert!(line.chars().count() <= width, "{request:?} at {width}: {line}");
            }
        }
    }
    // All that has room in the widest stands in the narrowest, too, in blocks.
    let compare = |columns: &str| {
        let request = ["compare", CASE, "--end", "0.3", "--no-verdict"];
        text(&command(dir.path(), &request).env("COLUMNS", columns).output().unwrap().stdout)
    };
    let numbers = |table: &str| table.split_whitespace().filter(|word| word.parse::<f64>().is_ok()).count();
    // Times per step differ in their digits only.
    assert_eq!(numbers(&compare("80")), numbers(&compare("200")));
    // So do worn volume and depths of a tube in the width of a page.
    let wears = ["run", "tube-round-supports", "--end", "0.1", "--no-verdict", "--set", "wear.coefficient=1e-14"];
    let output = command(dir.path(), &wears).env("COLUMNS", "78").output().unwrap();
    let (shown, said) = (text(&output.stdout), text(&output.stderr));
    for heading in ["worn (mm³)", "one scar", "all round"] {
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(heading.split(' ').all(|word| words.contains(word)), "{heading}: {shown}");
    }
    assert!(shown.lines().all(|line| line.chars().count() <= 78) && !said.contains("no room for"), "{shown}{said}");
}

fn document(folder: &Path, args: &[&str], code: i32) -> Value {
    let (out, _) = said(folder, &[args, &["--json"]].concat(), code);
    serde_json::from_str(&out).unwrap_or_else(|error| panic!("{args:?}: {error}: {out}"))
}

#[test]
fn json_is_one_document_for_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let ask = |args: &[&str]| document(dir.path(), args, 0);
    assert!(ask(&["new"])["cases"].as_array().unwrap().len() > 10);
    assert_eq!(ask(&["new", "bouncing-ball", "--out", "ball.toml"])["files_written"][0], "ball.toml");
    assert!(ask(&["completions", "bash"])["script"].as_str().unwrap().contains("signorini"));
    let explained = ask(&["explain", "elastic-wall"]);
    assert_eq!(explained["scheme"], "located");
    assert!(explained["walls"][0]["mass_kg"].is_f64() && explained["estimated_time"]["event"]["seconds"].is_f64());
    assert!(explained["model"][0].as_str().unwrap().contains("natural frequency"));

    let run = ask(&["run", CASE, "--end", "0.3"]);
    let summary = fs::read_to_string(dir.path().join("out/rigid-walls-sine/run/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    for (key, value) in summary.as_object().unwrap() {
        assert_eq!(&run[key], value, "{key}");
    }
    assert!(run["refinement"]["displacement"].is_f64() && run["residuals"]["complementarity"].is_number());
    assert!(run["notes"].is_array() && run["results"] == "out/rigid-walls-sine/run");
    let wall = &run["statistics"]["walls"][0];
    assert!(wall["contacts"].is_u64() && wall["episode_peak_force_n"]["max"].is_null(), "{wall}");

    let compare = ask(&["compare", CASE, "--end", "0.3", "--schemes", "moreau-jean,event"]);
    assert_eq!(compare["rows"].as_array().unwrap().len(), 2);
    let row = &compare["rows"][0];
    assert_eq!(row["method"], "moreau-jean");
    for key in ["residuals", "statistics", "refinement", "counters"] {
        assert!(row[key].is_object(), "{key}");
    }
    for (key, value) in row.as_object().unwrap() {
        assert!(value != "-" && value != "impacts", "{key}");
    }
    assert!(compare["findings"].is_array() && compare["scene"]["walls"].is_array());

    let chart =
        ask(&["chart", CASE, "--end", "0.1", "--schemes", "moreau-jean", "--steps", "1e-3:5e-4", "--levels", "2"]);
    assert!(chart["series"][0]["points"][0]["errors"]["impulse"]["upper"].is_number());
    let figures = ask(&["figures", "--out", "f"]);
    assert!(figures["files_written"].as_array().unwrap().len() >= 8);
}

#[test]
fn json_of_a_failure_is_a_document_too() {
    let dir = tempfile::tempdir().unwrap();
    let wrong = document(dir.path(), &["run", "nowhere.toml"], 2);
    assert!(wrong["error"].as_str().unwrap().contains("nowhere.toml") && wrong["exit_code"] == 2);
    // A run that misses the requested accuracy has results, and reports it in the same document.
    let request = ["run", CASE, "--scheme", "moreau-jean", "--accuracy", "1e-9", "--of", "motion", "--end", "10"];
    let short = document(dir.path(), &request, 1);
    assert!(short["error"].is_string());
}

#[test]
fn words_that_are_nearly_right_are_named() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["new", CASE, "--out", "c.toml"], 0);
    let case = fs::read_to_string(dir.path().join("c.toml")).unwrap();
    let with = |from: &str, to: &str| {
        let changed = case.replace(from, to);
        assert_ne!(changed, case);
        fs::write(dir.path().join("c.toml"), changed).unwrap();
        said(dir.path(), &["explain", "c.toml"], 2).1
    };
    assert!(with("restitution =", "restitutoin =").contains("did you mean `restitution`?"));
    let friction = with("restitution =", "friction =");
    assert!(friction.contains("[[slider]] in one plane") && !friction.contains("did you mean"), "{friction}");
    assert!(with("[system.oscillator]", "[system.ocsillator]").contains("did you mean `oscillator`?"));
    assert!(with("[[wall]]", "[wall]").contains("[[wall]] table, in double brackets"));
    let comma = with("mass = 1.0", "mass = 1,0");
    assert!(comma.contains("decimal comma") && comma.contains("1.0") && comma.contains(":9:9"), "{comma}");
    for (request, near) in [
        (["run", "rigid-wall-sine", "--end", "1"], "did you mean rigid-walls-sine?"),
        (["run", "rigid-walls-sin.toml", "--end", "1"], "did you mean rigid-walls-sine?"),
        (["run", CASE, "--scheme", "moreau-jaen"], "did you mean moreau-jean?"),
        (["run", CASE, "--qp", "clarabell"], "'clarabel'"),
        (["run", CASE, "--integrator", "trapezodial"], "'trapezoidal'"),
        (["new", "bouncing-bal", "--out", "b"], "did you mean bouncing-ball?"),
    ] {
        let (_, message) = said(dir.path(), &request, 2);
        assert!(message.contains(near), "{request:?}: {message}");
    }
}

#[test]
fn a_wide_row_is_not_echoed_whole() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["new", "tabulated-pulse"], 0);
    let wide: Vec<String> = (0..5000).map(|i| format!("{i}.0")).collect();
    let wide = wide.join(",");
    for table in [
        format!("time_s,force_N\n{wide}\n"),
        format!("{wide}\n0,1\n1,2\n"),
        format!("time_s,force_N\n0,{}\n", "x".repeat(9000)),
    ] {
        fs::write(dir.path().join("tabulated-pulse.csv"), table).unwrap();
        let (_, message) = said(dir.path(), &["explain", "tabulated-pulse.toml"], 2);
        let longest = message.lines().map(|line| line.chars().count()).max().unwrap();
        assert!(longest < 300 && message.len() < 1500, "{longest}: {message}");
    }
}

#[test]
fn shells_complete_schemes_solvers_and_cases() {
    let dir = tempfile::tempdir().unwrap();
    let script = said(dir.path(), &["completions", "bash"], 0).0;
    for words in [
        "moreau-jean located paoli-schatzman generalized-alpha",
        "condensed clarabel",
        "trapezoidal implicit-euler",
        "linear-sine linear-impulse",
    ] {
        assert!(script.contains(words), "{words}");
    }
    // Shell completion does not list every accepted value.
    said(dir.path(), &["run", CASE, "--end", "0.1", "--no-verdict", "--scheme", "moreau-jean:theta=0.75"], 0);
}

/// A bar whose modulus has some zeros too many: its fastest mode is at 10 GHz, and all its modes
/// are asked for.
const STIFF: &str = "[system.bar]\nlength = 1.0\narea = 1e-4\nyoungs_modulus = 2e19\n\
    density = 7850.0\nelements = 40\nleft = \"clamped\"\n\
    right = \"free\"\n[[wall]]\nname = \"stop\"\nat = { position = 1.0 }\nside = \"upper\"\n\
    position = 1e-3\n[[load]]\nat = { position = 1.0 }\n\
    harmonic = { amplitude = 10.0, frequency = 25.0 }\n[time]\nend = 10.0\nstep = 1e-4\n";

#[test]
fn a_run_of_hours_says_so_and_names_the_mode_that_sets_it() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("stiff.toml"), STIFF).unwrap();
    let (explained, _) = said(dir.path(), &["explain", "stiff.toml"], 0);
    let line = explained.lines().find(|line| line.trim().starts_with("event: about")).unwrap();
    assert!(line.contains("the fastest mode") && line.contains("Hz"), "{line}");
    assert!([" h ", "days", "years"].iter().any(|unit| line.contains(unit)), "{line}");
    for request in [
        &["run", "stiff.toml", "--scheme", "event", "--no-verdict"][..],
        &["run", "stiff.toml", "--step", "1e-8", "--sample", "1e-2"],
    ] {
        let line = forecast(dir.path(), request);
        assert!(line.contains(" more: "), "{request:?}: {line}");
        assert!(line.contains("the fastest mode") || line.contains("set by time.end and time.step"), "{line}");
    }
}

/// One degree of freedom whose stiffness has some zeros too many, before a wall that it does not
/// reach: one step of the exact scheme is the whole run, so that nothing comes back from it.
const STIFF_ALONE: &str = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 4e29\n\
    [[wall]]\nname = \"stop\"\n\
    side = \"upper\"\nposition = 1e-3\n[[load]]\n\
    harmonic = { amplitude = 10.0, frequency = 25.0 }\n[time]\nend = 10.0\nstep = 1e-4\n";

#[test]
fn a_single_step_of_hours_is_spoken_of_in_every_command_that_makes_it() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("stiff.toml"), STIFF_ALONE).unwrap();
    let requests: [&[&str]; 5] = [
        &["run", "stiff.toml", "--scheme", "event"],
        &["run", "stiff.toml", "--accuracy", "1e-3"],
        &["compare", "stiff.toml"],
        &["chart", "stiff.toml"],
        &["stability", "stiff.toml"],
    ];
    for request in requests {
        let line = forecast(dir.path(), request);
        // The maps come first, by schemes that take no notice of what they do not resolve.
        if request[0] == "stability" && line.contains(" rows, set by the slowest frequency") {
            continue;
        }
        assert!(line.contains("the fastest mode, 1.0"), "{request:?}: {line}");
        assert!([" h ", "days", "years"].iter().any(|unit| line.contains(unit)), "{request:?}: {line}");
    }
}

/// The line in which a command that takes hours says so; the command is killed then.
fn forecast(folder: &Path, request: &[&str]) -> String {
    let mut child = command(folder, request).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let stderr = child.stderr.take().unwrap();
    let (sender, lines) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        use std::io::BufRead;
        for line in std::io::BufReader::new(stderr).lines().map_while(Result::ok) {
            let _ = sender.send(line);
        }
    });
    let started = Instant::now();
    // A second of the tool's own patience, and what a busy machine adds to it.
    let patience = Duration::from_secs(60);
    let line = std::iter::from_fn(|| lines.recv_timeout(patience.saturating_sub(started.elapsed())).ok())
        .find(|line| line.starts_with("about "));
    child.kill().unwrap();
    child.wait().unwrap();
    line.unwrap_or_else(|| panic!("{request:?} says nothing"))
}

/// Control characters that a terminal obeys, other than the end of a line.
fn obeyed(text: &str) -> Option<char> {
    text.chars().find(|c| c.is_control() && *c != '\n')
}

#[test]
fn control_characters_of_names_are_escaped_wherever_they_are_shown() {
    let dir = tempfile::tempdir().unwrap();
    let (out, _) = said(dir.path(), &["new", CASE], 0);
    assert!(obeyed(&out).is_none());
    let case = fs::read_to_string(dir.path().join("rigid-walls-sine.toml")).unwrap();
    let body: String = case.lines().filter(|line| !line.starts_with("title")).map(|line| format!("{line}\n")).collect();
    let titled = format!("title = \"two\\u001b[31m\\nwalls\\u0000\"\n{body}");
    let evil = "a\u{1b}[31m\nb.toml";
    fs::write(dir.path().join(evil), &titled).unwrap();
    let files = "out/folder";
    for (args, code) in [
        (vec!["run", evil, "--end", "0.5", "--out", files], 0),
        (vec!["explain", evil], 0),
        (vec!["run", evil, "--end", "0.5", "--json", "--out", files], 0),
        (vec!["run", "no\u{1b}[31m\nsuch.toml"], 2),
        (vec!["run", CASE, "--set", "wall.a\u{1b}\n.gap=1"], 2),
        (vec!["run", CASE, "--scheme", "a\u{1b}\n"], 2),
        (vec!["run", CASE, "--end", "0.5", "--out", "out/b\u{1b}\nc"], 0),
    ] {
        let (out, err) = said(dir.path(), &args, code);
        assert_eq!(obeyed(&out).or(obeyed(&err)), None, "{args:?}: {out}{err}");
        assert!(!err.contains("31m\nsuch") && !err.contains("[31m\nb") && !err.contains("\nc"), "{args:?}: {err}");
    }
    for (text, name) in [
        (titled.replace("\"upper\"", "\"up\\u001b\\n\\u0000\""), "wall 1: name"),
        (format!("{body}\n\"x\\u001b\\n\\u0000y\" = 1\n"), "unknown key `x"),
    ] {
        fs::write(dir.path().join("wrong.toml"), text).unwrap();
        let (_, err) = said(dir.path(), &["run", "wrong.toml"], 2);
        assert!(err.contains(name) && obeyed(&err).is_none() && !err.contains("\ny`"), "{err}");
    }
    // In the files as on the terminal.
    for entry in fs::read_dir(dir.path().join(files)).unwrap() {
        let path = entry.unwrap().path();
        let written = fs::read_to_string(&path).unwrap();
        assert_eq!(obeyed(&written.replace('\t', " ")), None, "{}", path.display());
    }
    let page = fs::read_to_string(dir.path().join(files).join("report.html")).unwrap();
    assert!(page.contains("<title>two\\u{1b}[31m\\u{a}walls\\u{0}</title>"));
}

#[test]
fn a_page_that_is_forwarded_names_no_folder_of_the_machine() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().canonicalize().unwrap();
    let whole = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    said(&folder, &["new", "tabulated-pulse"], 0);
    said(&folder, &["new", CASE], 0);
    let (pulse, case) = (whole("tabulated-pulse.toml"), whole("rigid-walls-sine.toml"));
    let quiet = "--no-verdict";
    let orbit = ["--set", "wall.*.restitution=0.8", "--settle", "50"];
    let from = ["--set", "wall.*.restitution=0.8"];
    for args in [
        vec!["run", &pulse, quiet, "--out", &whole("a")],
        vec!["compare", &pulse, quiet, "--out", &whole("b")],
        [vec!["orbit", &case, "--out", &whole("c")], orbit.to_vec()].concat(),
        [vec!["orbit", &case, "--from", &whole("c/orbit.json"), "--out", &whole("d")], from.to_vec()].concat(),
        vec!["sweep", &pulse, "--vary", "time.step=1e-4,2e-4", "--measure", "contacts", "--out", &whole("e")],
        vec!["run", &whole("a/summary.json"), quiet, "--out", &whole("f")],
    ] {
        said(&folder, &args, 0);
    }
    for name in ["a", "b", "c", "d", "e", "f"] {
        let page = fs::read_to_string(folder.join(name).join("report.html")).unwrap();
        assert!(!page.contains(folder.to_str().unwrap()), "{name}");
    }
    let page = fs::read_to_string(folder.join("a/report.html")).unwrap();
    assert!(page.contains("signorini run tabulated-pulse.toml --no-verdict --out a\""));
    assert!(page.contains(r#""file":"tabulated-pulse.csv""#));
    // The summary keeps the path, by which the run was repeated from another folder.
    let summary: Value = serde_json::from_slice(&fs::read(folder.join("f/summary.json")).unwrap()).unwrap();
    assert_eq!(summary["files"][0]["path"], whole("tabulated-pulse.csv"));
}

#[test]
fn a_random_force_of_many_rows_says_its_size_before_the_run() {
    let dir = tempfile::tempdir().unwrap();
    let case = |to: &str| {
        format!(
            "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n[[wall]]\nname = \"a\"\nside = \
             \"upper\"\nposition = 1.0\n[[load]]\nrandom = {{ rms = 1.0, from = 1.0, to = {to} }}\n[time]\nend = \
             1.0\nstep = 1e-3\n"
        )
    };
    let explained = |to: &str, code| {
        fs::write(dir.path().join("band.toml"), case(to)).unwrap();
        said(dir.path(), &["explain", "band.toml"], code).1
    };
    // 16 rows in a period of the fastest line, and a power of two: 2^21 and two more.
    let said = explained("1e5", 0);
    assert!(said.contains("load 1: random: a table of 2097154 rows, 34 MB") && said.contains("1e5 Hz"), "{said}");
    assert!(!explained("1e3", 0).contains("a table of"));
    let said = explained("2e6", 2);
    assert!(said.contains("band is up to 2000000.0 Hz over 1.0 s") && said.contains("at most 2^24 rows"), "{said}");
}
