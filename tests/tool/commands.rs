//! The tool as a user meets it: commands, files, exit codes.
use crate::command::command;
use crate::table::csv;
use std::fs;
use std::path::Path;
use std::process::Output;

/// Runs the tool in `folder`.
fn signorini(folder: &Path, args: &[&str]) -> Output {
    command(folder, args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs it and expects success; gives stdout.
fn done(folder: &Path, args: &[&str]) -> String {
    let output = signorini(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Runs it and expects the exit code; gives stderr.
fn refused(folder: &Path, args: &[&str], code: i32) -> String {
    let output = signorini(folder, args);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{args:?}: {message}");
    // Before it the tool may say which case it took.
    assert!(message.lines().any(|line| line.starts_with("error: ")), "{args:?}: {message}");
    assert!(!message.contains("panicked"), "{args:?}: {message}");
    assert!(output.stdout.is_empty(), "{args:?} printed data: {}", text(&output.stdout));
    message
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The rows of a comparison printed as JSON.
fn rows(document: &str) -> Vec<serde_json::Value> {
    let document: serde_json::Value = serde_json::from_str(document).unwrap();
    document["rows"].as_array().unwrap().clone()
}

fn assert_svg(path: &Path) {
    let svg = fs::read_to_string(path).unwrap();
    roxmltree::Document::parse(&svg).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
}

#[test]
fn a_run_writes_everything_it_promises() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["run", "rigid-walls-sine", "--end", "1", "--restitution", "0.8"]);
    let out = dir.path().join("out/rigid-walls-sine/run");
    let (header, rows) = csv(&out.join("trajectory.csv"));
    let expected = "time_s,displacement_m,velocity_m_per_s,\
        contact_force_upper_N,contact_impulse_upper_N_s,\
        contact_force_lower_N,contact_impulse_lower_N_s";
    assert_eq!(header.join(","), expected);
    assert_eq!(rows.len(), 1001);
    assert_eq!(rows[0][0].parse::<f64>().unwrap(), 0.0);
    assert_eq!(rows[1000][0].parse::<f64>().unwrap(), 1.0);
    // What is read back is what the library computes, to the last bit.
    let case = signorini::case::Case::embedded("rigid-walls-sine").unwrap();
    let mut scene = case.scene.with_duration(1.0);
    scene.walls = scene.walls.into_iter().map(|wall| wall.with_restitution(0.8)).collect();
    let options = signorini::Options::new(case.time);
    let run = signorini::run(&scene, &signorini::Scheme::Located, &options).unwrap();
    let columns = [(1, run.trajectory.displacement()), (2, run.trajectory.velocity())];
    for (column, computed) in columns {
        let read: Vec<f64> = rows.iter().map(|row| row[column].parse().unwrap()).collect();
        assert_eq!(read, computed);
    }
    let summary = json(&out.join("summary.json"));
    for (column, wall, sign) in [(4, "upper", -1.0), (6, "lower", 1.0)] {
        let impulses: Vec<f64> = rows.iter().map(|r| r[column].parse().unwrap()).collect();
        assert!(impulses.iter().all(|p| p * sign >= 0.0));
        // A sum of a thousand terms in another order: rounding.
        let total = summary["impulse_whole_run_n_s"][wall].as_f64().unwrap();
        assert!((impulses.iter().sum::<f64>() - total).abs() < 1e-12);
        assert!(total * sign > 0.1);
    }
    let (header, contacts) = csv(&out.join("contacts.csv"));
    assert_eq!(
        header.join(","),
        "wall,start_s,end_s,impulse_N_s,peak_force_N,approach_speed_m_per_s,departure_speed_m_per_s"
    );
    for contact in &contacts {
        assert_eq!(contact[1], contact[2], "an impact is an instant");
        assert_eq!(contact[4], "", "and its force is not finite");
        let (approach, departure): (f64, f64) = (contact[5].parse().unwrap(), contact[6].parse().unwrap());
        // moreau-jean puts e into the velocities themselves.
        assert!((departure / approach - 0.8).abs() < 1e-12);
    }
    assert!(summary["residuals"]["complementarity"].as_f64().unwrap() <= 1e-12);
    for key in
        ["scheme", "scheme_reason", "qp_solver", "qp_reason", "steps", "counters", "wall_clock_s", "statistics", "wear"]
    {
        assert!(!summary[key].is_null(), "{key}");
    }
    for name in ["displacement.svg", "velocity.svg", "phase.svg", "contact-force.svg"] {
        assert_svg(&out.join(name));
    }
}

#[test]
fn the_exact_scheme_records_the_50_digit_states() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["run", "independent-code", "--scheme", "event", "--sample", "1", "--out", "here"]);
    let (_, rows) = csv(&dir.path().join("here/trajectory.csv"));
    // 50-digit arithmetic, exact between impacts; double precision holds it to rounding up to 2 s.
    for (row, u) in [(1, -0.004_273_265_748_152_696), (2, 0.004_819_844_401_208_915)] {
        assert!((rows[row][1].parse::<f64>().unwrap() - u).abs() < 1e-15);
    }
}

/// The short table of `compare` fits a narrow terminal, and one sentence says what it shows.
#[test]
fn compare_ends_with_a_short_table_and_one_sentence() {
    let dir = tempfile::tempdir().unwrap();
    let said = done(dir.path(), &["compare", "rigid-walls-sine", "--no-report"]);
    let (table, conclusion) = said.trim_end().rsplit_once('\n').unwrap();
    assert!(table.lines().all(|line| line.chars().count() <= 60), "{table}");
    assert_eq!(table.lines().filter(|line| line.starts_with("located") || line.starts_with("penalty:")).count(), 5);
    // The best method with its error in compare.csv, the best penalty, and the worst, deeper than
    // ±5 mm.
    let (header, rows) = csv(&dir.path().join("out/rigid-walls-sine/compare/compare.csv"));
    let number = |row: &[String], name: &str| {
        row[header.iter().position(|head| head == name).unwrap()].parse::<f64>().unwrap_or(f64::NAN)
    };
    let error = two_digits(number(&rows[0], "error_over_gap"));
    let begin = format!("located agrees with the exact motion to {error:e} of the gap until chaos takes over at ");
    assert!(conclusion.starts_with(&begin), "{conclusion}");
    let soft = rows.iter().find(|row| row[0] == "penalty:epsilon=1e-6").unwrap();
    let deep = number(soft, "penetration_m") / 5e-3;
    assert!(deep > 1.0);
    let stiff = rows.iter().find(|row| row[0] == "penalty:epsilon=1e-12").unwrap();
    let until = two_digits(number(stiff, "agrees_until_s"));
    let penalties = format!(
        "; the penalty at ε = 1e-12 departs from it at {until} s; the penalty at ε = 1e-6 passes the walls by {} of \
         the gap",
        two_digits(deep)
    );
    assert!(conclusion.ends_with(&penalties), "{conclusion}");
    assert!(conclusion.matches(';').count() == 2 && conclusion.chars().count() < 240, "{conclusion}");
}

/// A penalty that leaves the exact motion is said to do so when it does, as the table has it, and
/// not when chaos takes over; without a penalty the worst of the other methods is named.
#[test]
fn the_conclusion_of_compare_names_when_the_worst_method_departs() {
    let dir = tempfile::tempdir().unwrap();
    let compare = |schemes: &str, out: &str| {
        let asked = [
            "compare",
            "rigid-walls-sine",
            "--no-report",
            "--no-verdict",
            "--end",
            "1",
            "--schemes",
            schemes,
            "--out",
            out,
        ];
        let said = done(dir.path(), &asked);
        let (header, rows) = csv(&dir.path().join(out).join("compare.csv"));
        let at = header.iter().position(|head| head == "agrees_until_s").unwrap();
        let until: Vec<f64> = rows.iter().map(|row| row[at].parse().unwrap_or(f64::NAN)).collect();
        (said.trim_end().rsplit_once('\n').unwrap().1.to_owned(), until)
    };
    let (said, until) = compare("penalty:epsilon=1e-9,located,penalty:epsilon=1e-12", "both");
    let worst = format!("; the penalty at ε = 1e-9 departs from it at {} s", two_digits(until[0]));
    assert!(said.starts_with("located agrees with ") && said.ends_with(&worst) && until[0] < 0.1, "{said}");
    let (said, until) = compare("newmark,located", "constrained");
    let worst = format!("; newmark departs from it at {} s", two_digits(until[0]));
    assert!(said.ends_with(&worst) || said.ends_with("; newmark is refuted"), "{said}");
    let (said, until) = compare("penalty:epsilon=1e-9", "alone");
    let alone = format!("the penalty at ε = 1e-9 departs from the exact motion at {} s", two_digits(until[0]));
    assert_eq!(said, alone);
}

fn two_digits(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap()
}

#[test]
fn compare_gives_the_force_in_round_supports() {
    let dir = tempfile::tempdir().unwrap();
    let asked = ["compare", "whirl-in-a-hole", "--schemes", "moreau-jean", "--end", "1"];
    let short = done(dir.path(), &asked);
    // The force of the rotating mass, and one contact.
    assert!(
        short.lines().any(|line| line.starts_with("moreau-jean  ") && line.contains(" 1 ") && line.contains("7.06")),
        "{short}"
    );
    let table = done(dir.path(), &[&asked[..], &["--verbose"]].concat());
    assert!(table.contains("contacts hole") && table.contains("|impulse| hole (N s)"), "{table}");
    let (header, lines) = csv(&dir.path().join("out/whirl-in-a-hole/compare/compare-walls.csv"));
    assert_eq!(header, ["method", "wall", "impulse_N_s", "contacts", "peak_force_N"]);
    let [line] = lines.as_slice() else { panic!("{lines:?}") };
    assert_eq!((line[1].as_str(), line[3].as_str()), ("hole", "1"));
    // The steady force in closed form, for 1 s; the midpoint rule on the circle is 2e-7 off.
    for column in [2, 4] {
        let found: f64 = line[column].parse().unwrap();
        assert!((found / 7.064_267_168_051_028 - 1.0).abs() < 1e-6, "{line:?}");
    }
}

#[test]
fn compare_puts_qp_penalty_and_the_exact_motion_side_by_side() {
    let dir = tempfile::tempdir().unwrap();
    let table = done(dir.path(), &["compare", "rigid-walls-sine", "--end", "1", "--json"]);
    let rows = rows(&table);
    let methods: Vec<_> = rows.iter().map(|r| r["method"].as_str().unwrap()).collect();
    let expected = [
        "located",
        "located:qp=clarabel",
        "penalty:epsilon=1e-12",
        "penalty:epsilon=1e-9",
        "penalty:epsilon=1e-6",
        "event",
    ];
    assert_eq!(methods, expected);
    let out = dir.path().join("out/rigid-walls-sine/compare");
    let (header, lines) = csv(&out.join("compare.csv"));
    assert_eq!(lines.len(), 6);
    for column in ["error_over_gap", "horizon_s", "largest_displacement_m", "complementarity_residual", "step_ns"] {
        assert!(header.iter().any(|h| h == column), "{column}");
    }
    let (header, lines) = csv(&out.join("compare-walls.csv"));
    assert_eq!(header.join(","), "method,wall,impulse_N_s,contacts,peak_force_N");
    assert_eq!(lines.len(), 12, "a row for each method and wall");
    for line in &lines {
        // Upper walls push down.
        assert!((line[1] == "upper") == (line[2].parse::<f64>().unwrap() < 0.0) && line[3].parse::<u64>().unwrap() > 0);
    }
    // The softest penalty is off by the gap itself, the QP by its step.
    let error = |row: usize| rows[row]["error_over_gap"].as_f64().unwrap();
    assert!(error(0) < 0.05 && error(4) > 0.5);
    for method in methods {
        let folder = out.join(method.replace([':', ',', '='], "-"));
        assert!(folder.join("trajectory.csv").exists(), "{}", folder.display());
        assert!(folder.join("contacts.csv").exists());
    }
    for name in ["displacement.svg", "velocity.svg", "phase.svg", "contact-force.svg"] {
        assert_svg(&out.join(name));
    }
}

#[test]
fn methods_are_named_as_the_table_prints_them() {
    let dir = tempfile::tempdir().unwrap();
    let list = "moreau-jean:theta=0.75,paoli-schatzman,penalty:epsilon=1e-9,\
        integrator=trapezoidal,implicit-euler,newmark:qp=clarabel";
    let table = done(dir.path(), &["compare", "rigid-walls-sine", "--end", "0.2", "--schemes", list, "--json"]);
    let rows = rows(&table);
    let methods: Vec<_> = rows.iter().map(|r| r["method"].as_str().unwrap().to_owned()).collect();
    assert_eq!(methods.join(","), format!("{list},event"));
}

#[test]
fn a_failed_method_is_a_row_with_its_reason() {
    let dir = tempfile::tempdir().unwrap();
    let list = "moreau-jean,penalty:stiffness=1e14,integrator=central-difference";
    let output = signorini(dir.path(), &["compare", "rigid-walls-sine", "--end", "1", "--schemes", list, "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let rows = rows(&text(&output.stdout));
    assert!(rows[0]["failure"].is_null() && rows[0]["refuted"] == false);
    assert_eq!(rows[1]["findings"][0]["refuted"], "diverged", "{}", rows[1]);
    assert_eq!(rows[1]["findings"].as_array().unwrap().len(), 1);
    // Newton's method fails: there is no run.
    let list = "moreau-jean,penalty:epsilon=1e-300";
    let request = ["compare", "rigid-walls-sine", "--end", "1", "--schemes", list, "--json", "--force"];
    let table = done(dir.path(), &request);
    let rows = self::rows(&table);
    assert!(rows[1]["failure"].as_str().unwrap().contains("did not converge"), "{}", rows[1]);
}

#[test]
fn a_run_that_diverges_writes_the_rows_up_to_there_and_exits_with_1() {
    let dir = tempfile::tempdir().unwrap();
    let scheme = "penalty:stiffness=1e14,integrator=central-difference";
    let output = signorini(dir.path(), &["run", "rigid-walls-sine", "--end", "1", "--scheme", scheme, "--out", "o"]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    let said = message.lines().find(|line| line.starts_with("refuted: ")).unwrap();
    // 2/√(1e14) s is the limit of its step.
    assert!(said.contains("diverged") && said.contains("2.0e-7 s") && said.contains(scheme), "{message}");
    let (header, rows) = csv(&dir.path().join("o/trajectory.csv"));
    let last: f64 = rows.last().unwrap()[0].parse().unwrap();
    assert!(last > 0.0 && last < 0.2, "{last}");
    assert!(rows.iter().flatten().all(|cell| cell.parse::<f64>().is_ok_and(f64::is_finite)), "{header:?}");
    let summary = json(&dir.path().join("o/summary.json"));
    assert_eq!(summary["refuted"], true);
    assert_eq!(summary["findings"][0]["refuted"], "diverged");
    assert!(dir.path().join("o/report.html").exists());
}

#[test]
fn a_run_that_fails_exits_with_1_and_leaves_older_results_alone() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["run", "rigid-walls-sine", "--end", "0.1", "--out", "o"]);
    let before = fs::read(dir.path().join("o/trajectory.csv")).unwrap();
    let scheme = "penalty:epsilon=1e-300";
    let message =
        refused(dir.path(), &["run", "rigid-walls-sine", "--end", "1", "--scheme", scheme, "--out", "o", "--force"], 1);
    assert!(message.contains("t = "), "{message}");
    assert_eq!(fs::read(dir.path().join("o/trajectory.csv")).unwrap(), before);
    let left: Vec<_> = fs::read_dir(dir.path().join("o")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left.len(), 9, "{left:?}");
}

#[test]
fn a_wrong_request_exits_with_2_and_says_what_would_be_accepted() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("taken"), "a file").unwrap();
    let case = "rigid-walls-sine";
    // Sliders have no wall that faces them, which is not what is wrong with a penalty.
    let wall = "[[wall]]\nname = \"stop\"\nside = \"both\"\ngap = 1.0\n";
    let rubs = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/dry-friction-damper.toml");
    fs::write(dir.path().join("rubs.toml"), fs::read_to_string(rubs).unwrap() + wall).unwrap();
    let (dry, vary, normal) = ("dry-friction-damper", "--vary", "slider.pad.normal_force=1,2");
    let requests: &[(&[&str], &str)] = &[
        (&["run", "nowhere.toml"], "nowhere.toml"),
        (&["compare", "nowhere"], "signorini new"),
        (&["run", case, "--scheme", "runge-kutta"], "moreau-jean"),
        (&["run", case, "--scheme", "moreau-jean:theta=0.2"], "0.5 to 1"),
        (&["run", case, "--scheme", "moreau-jean:tetha=0.5"], "theta"),
        (&["run", case, "--scheme", "event:step=1"], "no settings"),
        (&["run", case, "--scheme", "penalty:epsilon=nan"], "finite"),
        (&["run", case, "--theta", "0.6", "--scheme", "paoli-schatzman"], "moreau-jean"),
        (&["run", case, "--epsilon", "1e-9"], "penalty"),
        (&["run", case, "--integrator", "trapezoidal"], "penalty"),
        (&["run", case, "--scheme", "penalty", "--epsilon", "-1"], "above 0"),
        (&["run", case, "--step", "nan"], "above 0"),
        (&["run", case, "--step", "0"], "above 0"),
        (&["run", case, "--step", "-1e-3"], "above 0"),
        (&["run", case, "--step", "20"], "time.step"),
        (&["run", case, "--step", "1e-12"], "1e10"),
        (&["run", case, "--sample", "1e-9"], "1e7"),
        (&["run", case, "--end", "inf"], "finite"),
        (&["run", case, "--end", "-1"], "above 0"),
        (&["run", case, "--restitution", "1.5"], "0 to 1"),
        (&["run", "linear-sine", "--restitution", "0.5"], "rigid wall"),
        (&["run", case, "--out", "taken/here"], "taken"),
        (&["compare", case, "--end", "0.1", "--out", "taken"], "taken"),
        (&["compare", "bouncing-ball", "--end", "0.1", "--epsilon", "1e-9"], "stiffness"),
        (
            &["run", "rubs.toml", "--scheme", "penalty", "--epsilon", "1e-9"],
            "expected moreau-jean, located or no friction",
        ),
        (&["sweep", dry, vary, normal, "--measure", "lyapunov"], "the measure lyapunov, with friction at the slider"),
        (&["sweep", dry, vary, normal, "--measure", "attractor"], "\"pad\"; expected no friction"),
        (&["sweep", dry, vary, normal, "--measure", "impacts", "--kernel", "batch"], "\"pad\"; expected no friction"),
        (&["run", case, "--scheme", "event", "--qp", "clarabel"], "quadratic"),
        (&["run", case, "--scheme", "event:qp=clarabel"], "quadratic"),
        (&["run", case, "--scheme", "penalty:epsilon=1e-9", "--epsilon", "1e-6"], "either"),
        (&["run", case, "--scheme", "moreau-jean:theta=0.6", "--theta", "0.7"], "either"),
        (&["run", case, "--scheme", "generalized-alpha:rho=1.5"], "0 to 1"),
        (&["run", case, "--scheme", "generalized-alpha", "--rho", "-0.1"], "0 to 1"),
        (&["run", case, "--scheme", "generalized-alpha:rho=0.5", "--rho", "0.7"], "either"),
        (&["run", case, "--rho", "0.6", "--scheme", "moreau-jean"], "generalized-alpha"),
        (&["compare", case, "--schemes", "moreau-jean,event,moreau-jean"], "twice"),
        (&["new", "no-such-case"], "rigid-walls-sine"),
        (&["explain", "nowhere"], "nowhere"),
    ];
    for (request, hint) in requests {
        let message = refused(dir.path(), request, 2);
        assert!(message.contains(hint), "{request:?} does not mention {hint}: {message}");
    }
    assert_eq!(fs::read_to_string(dir.path().join("taken")).unwrap(), "a file");
}

#[test]
fn words_that_are_no_command_exit_with_2() {
    let dir = tempfile::tempdir().unwrap();
    for args in [
        &["walk"][..],
        &["run"],
        &["run", "a", "b"],
        &["run", "a", "--step", "fast"],
        &["run", "a", "--qp", "simplex"],
        &[],
    ] {
        assert_eq!(signorini(dir.path(), args).status.code(), Some(2), "{args:?}");
    }
}

#[test]
fn new_writes_a_case_that_runs_and_never_overwrites() {
    let dir = tempfile::tempdir().unwrap();
    assert!(done(dir.path(), &["new"]).contains("bouncing-ball"));
    done(dir.path(), &["new", "tabulated-pulse"]);
    done(dir.path(), &["run", "tabulated-pulse.toml"]);
    assert!(refused(dir.path(), &["new", "tabulated-pulse"], 2).contains("exists"));
    done(dir.path(), &["new", "bouncing-ball", "--out", "sub/ball.toml"]);
    done(dir.path(), &["explain", "sub/ball.toml"]);
}

#[test]
fn figures_draws_all_figures_of_the_source() {
    let dir = tempfile::tempdir().unwrap();
    done(dir.path(), &["figures", "--out", "f"]);
    let mut numbers: Vec<char> = Vec::new();
    for entry in fs::read_dir(dir.path().join("f")).unwrap() {
        let path = entry.unwrap().path();
        if path.file_name().unwrap() == "request.json" {
            continue;
        }
        assert_svg(&path);
        numbers.push(path.file_name().unwrap().to_str().unwrap().chars().nth(3).unwrap());
    }
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers, ['2', '3', '4', '5', '6', '7', '8', '9']);
}

#[test]
fn help_has_examples_everywhere_and_quiet_is_quiet() {
    let dir = tempfile::tempdir().unwrap();
    for command in [
        &["--help"][..],
        &["run", "--help"],
        &["compare", "--help"],
        &["explain", "--help"],
        &["figures", "--help"],
        &["new", "--help"],
    ] {
        assert!(done(dir.path(), command).contains("Example"), "{command:?}");
    }
    // The example of an error by name keeps it.
    let help = done(dir.path(), &["--help"]);
    let example = help.lines().find(|line| line.contains("--accuracy 1e-6")).unwrap();
    let words = example.split_whitespace().skip(1).take_while(|word| *word != "an");
    done(dir.path(), &words.collect::<Vec<_>>());
    assert!(done(dir.path(), &["--version"]).contains(env!("CARGO_PKG_VERSION")));
    assert!(done(dir.path(), &["completions", "bash"]).contains("compare"));
    let output = signorini(dir.path(), &["run", "linear-sine", "--quiet"]);
    assert!(output.status.success() && output.stderr.is_empty());
}

/// A tube at two supports, small enough to be refined at once.
const TUBE: &str = "title = \"A small tube\"\n[system]\nmodes = 2\n[system.beam]\nlength = 1.0\n\
    youngs_modulus = 2e11\ndensity = 7850.0\n\
    outer_diameter = 0.02\ninner_diameter = 0.018\nelements = 4\nleft = \"pinned\"\n\
    right = \"pinned\"\n[system.damping]\nratio = 0.05\n\
    [[wall]]\nname = \"support\"\nat = { position = 0.4 }\nside = \"both\"\ngap = 1e-4\nstiffness = 1e6\n\
    [[load]]\nat = { position = 0.5 }\nharmonic = { amplitude = 50.0, frequency = 40.0 }\n\
    [[probe]]\nname = \"middle\"\nat = { position = 0.5 }\n[time]\nend = 0.05\nstep = 2e-5\nsample = 1e-4\n";

#[test]
fn a_run_of_a_structure_names_its_probes_and_walls_and_tells_its_truncation() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("tube.toml"), TUBE).unwrap();
    let output = signorini(dir.path(), &["run", "tube.toml", "--out", "o"]);
    let said = text(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("truncation: with 4 of 8 modes in place of 2 the impulse changes by up to"), "{said}");
    // Of the largest impulse of any wall, and not of what that wall has.
    let told = said.split("the impulse changes by up to ").nth(1).unwrap();
    assert!(told.split_once(" % ").unwrap().1.starts_with("of the largest (wall \"support"), "{said}");
    assert!(told.contains(", the peak by up to ") && told.matches(" % of the largest (wall ").count() == 2, "{said}");
    let page = fs::read_to_string(dir.path().join("o/report.html")).unwrap();
    assert!(page.contains("More modes change impulses by up to ") && !page.contains("of what they are then"));
    let (header, rows) = csv(&dir.path().join("o/trajectory.csv"));
    let expected = "time_s,displacement_middle_m,velocity_middle_m_per_s,\
        contact_force_support_upper_N,contact_impulse_support_upper_N_s,\
        contact_force_support_lower_N,contact_impulse_support_lower_N_s";
    assert_eq!(header.join(","), expected);
    assert_eq!(rows.len(), 501);
    let summary = json(&dir.path().join("o/summary.json"));
    let scene = &summary["scene"];
    assert_eq!(scene["beam"]["elements"], 4);
    assert_eq!(
        (scene["structure"]["degrees_of_freedom"].as_u64(), scene["structure"]["unknowns"].as_u64()),
        (Some(8), Some(2))
    );
    assert_eq!(scene["structure"]["frequencies_hz"].as_array().unwrap().len(), 2);
    assert_eq!(scene["walls"][0]["at"]["position_m"], 0.4);
    assert!(
        scene["walls"][0]["effective_mass_kg"].as_f64() > scene["walls"][0]["effective_mass_of_all_modes_kg"].as_f64()
    );
    assert_eq!(summary["qp_solver"], "condensed");
    assert_eq!(summary["truncation"]["modes"], serde_json::json!([2, 4]));
    // The impulses of the check are those of the run that it repeats.
    done(dir.path(), &["run", "tube.toml", "--modes", "4", "--no-verdict", "--out", "more"]);
    let more = json(&dir.path().join("more/summary.json"));
    for (index, wall) in ["support-upper", "support-lower"].into_iter().enumerate() {
        let check = &summary["truncation"]["walls"][index];
        // The window is the whole run here; its impulse is summed in ten batches, which rounds
        // elsewhere: some ulps of 1 N s.
        for (number, run) in [&summary, &more].into_iter().enumerate() {
            let whole = run["impulse_whole_run_n_s"][wall].as_f64().unwrap();
            assert!((check["impulse_n_s"][number].as_f64().unwrap() - whole).abs() <= 1e-14);
        }
    }
    assert!(more["truncation"].is_null() && more["refinement"].is_null());
}

#[test]
fn accuracy_finds_the_modes_as_well_as_the_step() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("tube.toml"), TUBE).unwrap();
    let request = ["run", "tube.toml", "--scheme", "moreau-jean", "--accuracy", "0.05", "--out", "o"];
    let output = signorini(dir.path(), &request);
    let said = text(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(said.contains("modes: ") && said.contains("accuracy: asked for 5e-2"), "{said}");
    let summary = json(&dir.path().join("o/summary.json"));
    assert_eq!(summary["modes"]["kept"], true);
    assert_eq!(summary["modes"]["modes"], summary["scene"]["structure"]["modes"]);
    assert!(summary["accuracy"]["reached"].as_f64().unwrap() <= 0.05);
}

#[test]
fn explain_tells_structures() {
    let dir = tempfile::tempdir().unwrap();
    let tube = done(dir.path(), &["explain", "tube-loose-supports", "--modes", "30"]);
    for words in [
        "120 degrees of freedom, cut to 30 modes",
        "classical damping",
        "diagonal",
        "condensed",
        "1 m along it",
        "restitution holds with the mass that 30 of 120 modes have",
    ] {
        assert!(tube.contains(words), "{words}: {tube}");
    }
    let chain = done(dir.path(), &["explain", "chain-200"]);
    for words in ["a chain, in full", "C = 1e-5 K", "tridiagonal", "and 388 walls more", "degree of freedom 0"] {
        assert!(chain.contains(words), "{words}: {chain}");
    }
    assert!(done(dir.path(), &["explain", "rigid-walls-sine"]).contains("clamp: one unknown"));
}

#[test]
fn wrong_requests_about_structures_exit_with_2() {
    let dir = tempfile::tempdir().unwrap();
    let static_tube = TUBE.replace("modes = 2", "modes = 2\nstatic_correction = true").replace("stiffness = 1e6\n", "");
    fs::write(dir.path().join("static.toml"), static_tube).unwrap();
    let free = TUBE.split("[[wall]]").next().unwrap().replace("pinned", "free").replace("modes = 2", "planes = 2");
    fs::write(dir.path().join("free.toml"), free + "[time]\nend = 0.05\nstep = 2e-5\n").unwrap();
    let requests: &[(&[&str], &str)] = &[
        (&["run", "rigid-walls-sine", "--modes", "1"], "one degree of freedom"),
        (&["explain", "rigid-walls-sine", "--modes", "1"], "one degree of freedom"),
        (&["run", "chain-20", "--modes", "0"], "a whole number from 1"),
        (&["run", "chain-20", "--modes", "21"], "from 1 to 20"),
        (&["compare", "tube-loose-supports", "--modes", "121"], "from 1 to 120"),
        (&["run", "static.toml", "--restitution", "0.5"], "cannot rebound"),
        (&["run", "chain-20", "--qp", "clamp"], "more than one unknown"),
        (&["run", "two-tubes", "--modes", "1"], "modes is 1, with which the support"),
        (&["run", "free.toml", "--modes", "1"], "modes is 1\n"),
        (&["run", "chain-200", "--sample", "1e-7", "--step", "1e-7"], "time.sample"),
    ];
    for (request, hint) in requests {
        let message = refused(dir.path(), request, 2);
        assert!(message.contains(hint), "{request:?} does not mention {hint}: {message}");
    }
}
