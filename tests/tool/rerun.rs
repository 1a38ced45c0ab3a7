//! A summary contains the whole request: the scene is rebuilt from it, and the run is the same to
//! the last bit.
use crate::command::command;
use signorini::case::{Case, Embedded};
use std::fs;
use std::path::Path;

fn signorini(folder: &Path, args: &[&str]) -> (i32, String) {
    let output = command(folder, args).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Runs `case` with `options`, and then its summary by the scheme that the summary names: both
/// leave the same files.
fn same_again(folder: &Path, case: &str, options: &[&str]) -> serde_json::Value {
    let run = |case: &str, options: &[&str], out: &str| {
        let args: Vec<&str> =
            ["run", case, "--no-verdict", "--force", "--out", out].into_iter().chain(options.iter().copied()).collect();
        let (code, said) = signorini(folder, &args);
        assert!(code <= 1, "{args:?}: {said}");
        fs::read_to_string(folder.join(out).join("summary.json")).unwrap()
    };
    let text = run(case, options, "first");
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let scheme = summary["scheme"].as_str().unwrap().to_owned();
    let again = run("first/summary.json", &["--scheme", &scheme], "second");
    for name in ["trajectory.csv", "contacts.csv"] {
        let [a, b] = ["first", "second"].map(|out| fs::read_to_string(folder.join(out).join(name)).unwrap());
        assert!(a == b && a.lines().count() > 0, "{case} {options:?}: {name} differs");
    }
    let again: serde_json::Value = serde_json::from_str(&again).unwrap();
    for key in ["case", "case_file", "files", "scheme", "step_s", "residuals", "statistics"] {
        assert_eq!(summary[key], again[key], "{case} {options:?}: {key}");
    }
    assert!(!text.contains("-0.0,") && !text.contains("-0.0\n") && !text.contains("-0.0]"), "{case}: −0");
    summary
}

#[test]
fn every_built_in_case_is_run_again_from_its_summary() {
    let folder = tempfile::tempdir().unwrap();
    for embedded in Embedded::all() {
        let end = format!("{:e}", Case::embedded(embedded.name).unwrap().scene.duration / 50.0);
        let summary = same_again(folder.path(), embedded.name, &["--end", &end]);
        assert_eq!(summary["case"], embedded.name);
        // A start at rest of 200 masses takes no line.
        let lines = fs::read_to_string(folder.path().join("first/summary.json")).unwrap();
        assert!(lines.lines().filter(|line| line.trim() == "0.0,").count() == 0, "{}", embedded.name);
    }
}

#[test]
fn what_the_command_line_changed_is_in_the_summary() {
    let folder = tempfile::tempdir().unwrap();
    let end = ["--end", "0.3"];
    let options =
        [&end[..], &["--restitution", "0.35", "--step", "3e-4", "--sample", "6e-4", "--force-averaging", "2e-3"]]
            .concat();
    let summary = same_again(folder.path(), "rigid-walls-sine", &options);
    assert_eq!(summary["case_file"]["wall"][0]["restitution"], 0.35);
    let time = serde_json::json!({ "end": 0.3, "step": 3e-4, "sample": 6e-4, "force_averaging": 2e-3 });
    assert_eq!(summary["case_file"]["time"], time);
    // 150 stretches over the window.
    let averaged = |wall: usize| &summary["statistics"]["walls"][wall]["force"]["rms_averaged_over_s"];
    assert!(averaged(0).as_f64().is_some_and(|s| (s - 2e-3).abs() < 1e-12), "{}", averaged(0));
    same_again(folder.path(), "rigid-walls-sine", &["--end", "0.3", "--scheme", "event"]);
    same_again(folder.path(), "rigid-walls-sine", &["--end", "0.3", "--scheme", "penalty", "--epsilon", "2e-9"]);
    let summary =
        same_again(folder.path(), "tube-loose-supports", &["--end", "0.02", "--modes", "7", "--restitution", "0"]);
    assert_eq!(summary["case_file"]["system"]["modes"], 7);
    // Rows farther apart than the run is long are left out.
    let summary = same_again(folder.path(), "rigid-walls-sine", &["--set", "time.sample=0.5", "--end", "0.3"]);
    assert_eq!(summary["case_file"]["time"], serde_json::json!({ "end": 0.3, "step": 1e-4 }));
    // An epsilon takes the place of the case's springs.
    let springs = ["--set", "penalty={ stiffness = [1e6], damping = 2.0 }", "--scheme", "penalty", "--end", "0.1"];
    let summary = same_again(folder.path(), "rigid-walls-sine", &[&springs[..], &["--epsilon", "2e-9"]].concat());
    assert_eq!(summary["case_file"]["penalty"], serde_json::json!({ "epsilon": [2e-9] }));
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

const TIME: &str = "[time]\nend = 0.1\nstep = 1e-3\nstatistics_from = 0.05\n";

#[test]
fn tables_matrices_and_modes_are_found_again_and_known_by_their_content() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    write(dir, "force.csv", "t;F\n0,0;0,5\n0,03;-1,5\n0,2;3\n");
    let table = "[system.oscillator]\nmass = 1\ndamping = 0.1\nstiffness = 100\n[[wall]]\n\
        name = \"stop\"\nside = \"upper\"\nposition = 1e-4\n\
        [[load]]\n\
        table = { file = \"force.csv\", time = \"t\", force = \"F\", delimiter = \";\", \
        decimal = \",\", scale = 2.0 }\n\
        [[load]]\nimpulse = { impulse = 0.01, time = 0.02 }\n[initial]\n\
        displacement = -1e-3\nvelocity = 0.1\n";
    write(dir, "table.toml", &format!("{table}{TIME}"));
    let summary = same_again(dir, "table.toml", &[]);
    let file = &summary["files"][0];
    assert_eq!((&file["file"], &file["bytes"]), (&"force.csv".into(), &28.into()));
    assert_eq!(file["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(summary["case_file"]["load"][0]["table"]["file"], "force.csv");
    // Changed since, the table is no longer that of the run; gone, it is missed.
    write(dir, "force.csv", "t;F\n0,0;0,5\n0,03;-1,6\n0,2;3\n");
    let (code, said) = signorini(dir, &["run", "first/summary.json", "--no-verdict", "--out", "third"]);
    assert!(code == 2 && said.contains("is not what the run read") && said.contains("force.csv"), "{code} {said}");
    fs::remove_file(dir.join("force.csv")).unwrap();
    let (code, said) = signorini(dir, &["run", "first/summary.json", "--no-verdict", "--out", "third"]);
    assert!(code == 2 && said.contains("no such file"), "{code} {said}");

    // Three degrees of freedom, one of them without mass and with a wall.
    write(dir, "M.csv", "1,0,0\n0,0,0\n0,0,2\n");
    write(dir, "K.csv", "150,-100,0\n-100,400,-300\n0,-300,300\n");
    let matrices = "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.csv\"\n[system.damping]\n\
        rayleigh = { mass = 0.1, stiffness = 1e-3 }\n\
        [[wall]]\nname = \"end\"\nat = { dof = 2 }\nside = \"both\"\ngap = 1e-3\nrestitution = 0.5\n\
        [[wall]]\nname = \"node\"\nat = { row = [[1, 1.0], [0, -0.5]] }\n\
        side = \"lower\"\nposition = -1e-4\n\
        [[load]]\nat = { dof = 0 }\nharmonic = { amplitude = 1.0, frequency = 1.0, phase = 0.5 }\n\
        [initial]\nvelocity = [0.0, 0.0, 0.1]\n";
    write(dir, "matrices.toml", &format!("{matrices}{TIME}"));
    let summary = same_again(dir, "matrices.toml", &[]);
    assert_eq!(summary["files"].as_array().unwrap().len(), 2);
    assert_eq!(summary["case_file"]["initial"], serde_json::json!({ "velocity": [0.0, 0.0, 0.1] }));
    assert_eq!(summary["case_file"]["wall"][0]["at"], serde_json::json!({ "dof": 2 }));

    write(dir, "shapes.csv", "tip,1.0,-0.7\nbase,0.3,0.4\n");
    let modal = "[system.modal]\nfrequencies = [5.3, 31.7]\ndamping_ratios = [0.01, 0.02]\nshapes = \"shapes.csv\"\n\
        [[wall]]\nname = \"stop\"\nat = { points = [[\"tip\", 1.0], [\"base\", -1.0]] }\n\
        side = \"upper\"\nposition = 1e-4\nstiffness = 1e4\ndamping = 1.0\n\
        [[load]]\nat = { point = \"tip\" }\nconstant = { force = 3.0 }\n[[probe]]\n\
        name = \"each\"\nat = \"each\"\n";
    write(dir, "modal.toml", &format!("{modal}{TIME}"));
    same_again(dir, "modal.toml", &[]);
    write(dir, "cut.toml", &format!("[system]\nmodes = 1\nstatic_correction = true\n{modal}{TIME}"));
    same_again(dir, "cut.toml", &[]);
    let bar = "[system.bar]\nlength = 2.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\n\
        elements = 9\nleft = \"clamped\"\nright = \"free\"\n\
        mass_matrix = \"lumped\"\n[initial]\ndisplacement = { profile = [[0.0, 0.0], [2.0, 0.1]] }\n";
    write(dir, "bar.toml", &format!("{bar}{TIME}"));
    same_again(dir, "bar.toml", &[]);
}

#[test]
fn a_json_file_that_is_no_summary_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    for (text, words) in [
        ("{", "not valid JSON"),
        ("{}", "not the summary of a run"),
        ("{ \"case_file\": 3 }", "not the summary of a run"),
        ("{ \"case_file\": { \"time\": null } }", "case_file"),
        ("{ \"case_file\": { \"time\": { \"end\": 1.0, \"step\": 0.1 } } }", "`system` is missing"),
    ] {
        write(dir, "summary.json", text);
        let (code, said) = signorini(dir, &["run", "summary.json"]);
        assert!(code == 2 && said.starts_with("error: ") && said.contains(words), "{text}: {code} {said}");
    }
}
