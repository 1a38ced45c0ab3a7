//! `run --derivative`: the columns of derivatives.csv, and what is refused.

use crate::command::said;
use std::fs;
use std::path::Path;

/// A ball of 2 kg that falls from 1 m onto a floor.
pub const BALL: &str = r#"
[system.oscillator]
mass = 2.0
damping = 0.0
stiffness = 0.0

[initial]
displacement = 1.0
velocity = 0.0

[[wall]]
name = "floor"
side = "lower"
position = 0.0
restitution = 0.8

[[load]]
constant = { force = -19.62 }

[time]
end = 1.0
step = 1e-3
"#;

/// A swing whose stop is where it turns.
const SWING: &str = r#"
[system.oscillator]
mass = 1.0
damping = 0.0
stiffness = 100.0

[initial]
displacement = -0.01
velocity = 0.0

[[wall]]
name = "stop"
side = "upper"
position = 0.01
restitution = 0.5

[time]
end = 1.0
step = 1e-3
"#;

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("ball.toml"), BALL).unwrap();
    fs::write(dir.path().join("swing.toml"), SWING).unwrap();
    dir
}

/// The derivatives of a file, by column.
fn columns(folder: &Path, out: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = fs::read_to_string(folder.join(out).join("derivatives.csv")).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    (lines.next().unwrap(), lines.collect())
}

#[test]
fn the_file_has_five_derivatives_of_each_contact_by_each_key() {
    let dir = folder();
    let keys = "wall.floor.restitution,system.oscillator.mass";
    let args = ["run", "ball.toml", "--derivative", keys, "--out", "out", "--no-report"];
    let (out, _) = said(dir.path(), &args, 0);
    assert!(out.contains("1 % more of") && out.contains("the sum of the impulses"), "{out}");
    let (header, rows) = columns(dir.path(), "out");
    let of_key = |word: &str, per: &str| {
        [
            "start_by_{}_s",
            "end_by_{}_s",
            "approach_speed_by_{}_m_per_s",
            "departure_speed_by_{}_m_per_s",
            "impulse_by_{}_N_s",
        ]
        .map(|name| format!("{}{per}", name.replace("{}", word)))
    };
    let expected = [of_key("wall_floor_restitution", ""), of_key("system_oscillator_mass", "_per_kg")].concat();
    assert_eq!(header[8..], expected);
    // It falls for √(2/g) s and bounces for 2e times as long.
    assert_eq!(rows.len(), 1);
    let number = |name: &str| {
        let at = header.iter().position(|column| column == name).unwrap();
        rows[0][at].parse::<f64>().unwrap()
    };
    let speed = (2.0 * 9.81_f64).sqrt();
    for (name, value) in [
        ("start_by_wall_floor_restitution_s", 0.0),
        ("departure_speed_by_wall_floor_restitution_m_per_s", speed),
        ("impulse_by_wall_floor_restitution_N_s", 2.0 * speed),
        // The weight is a force of its own: a heavier ball falls slower.
        ("approach_speed_by_system_oscillator_mass_m_per_s_per_kg", -speed / 4.0),
    ] {
        // Rounding of a few products.
        assert!((number(name) - value).abs() <= 1e-12 * speed, "{name}: {} {value}", number(name));
    }
    assert!(rows.iter().flatten().all(|cell| cell != "-0.0"), "{rows:?}");
    let text = fs::read_to_string(dir.path().join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&text).unwrap();
    let impulse = &summary["derivatives"]["measured"][1];
    assert_eq!((&impulse["wall"], &impulse["name"]), (&"floor".into(), &"impulse".into()));
    assert_eq!(impulse["derivative"][0].as_f64(), Some(number("impulse_by_wall_floor_restitution_N_s")));
}

#[test]
fn a_motion_that_meets_no_wall_says_why_the_file_is_empty() {
    let dir = folder();
    let args = ["run", "linear-sine", "--derivative", "load.1.harmonic.amplitude", "--end", "1", "--no-report"];
    let (_, err) = said(dir.path(), &args, 0);
    assert!(err.contains("derivatives.csv has no rows, since the motion meets no wall"), "{err}");
}

#[test]
fn a_key_that_the_file_leaves_out_has_the_derivative_at_its_default() {
    let dir = tempfile::tempdir().unwrap();
    let written = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/cases/elastic-wall.toml")).unwrap();
    let derivatives = |text: &str, out: &str| {
        fs::write(dir.path().join("case.toml"), text).unwrap();
        let run = ["run", "case.toml", "--derivative", "load.1.harmonic.phase", "--out", out];
        said(dir.path(), &run, 0);
        fs::read_to_string(dir.path().join(out).join("derivatives.csv")).unwrap()
    };
    let left_out = written.replacen(", phase = 0.0 }", " }", 1);
    assert!(written != left_out && !left_out.contains("phase"));
    assert_eq!(derivatives(&left_out, "left-out"), derivatives(&written, "written"));
}

#[test]
fn what_cannot_be_differentiated_is_refused_in_one_message() {
    let dir = folder();
    let refused = |extra: &[&str], words: &[&str]| {
        let case = if words.contains(&"friction") { "dry-friction-damper" } else { "ball.toml" };
        let args = [&["run", case, "--out", "refused"][..], extra].concat();
        let (_, err) = said(dir.path(), &args, 2);
        assert!(words.iter().all(|word| err.contains(word)), "{err}");
        assert_eq!(err.matches("error:").count(), 1, "{err}");
        assert!(!dir.path().join("refused").exists());
    };
    refused(&["--derivative", "wall.floor.stifness"], &["stifness"]);
    refused(&["--derivative", "wall.floor.name"], &["wall.floor.name"]);
    refused(
        &["--derivative", "wall.floor.position,wall.floor.restitution, wall.floor.position"],
        &["wall.floor.position, for the second time", "expected each key once"],
    );
    refused(&["--derivative", "load.1.random.seed"], &["load.1.random.seed is a whole number"]);
    refused(&["--derivative", "system.modes"], &["derivative by system.modes is a whole number", "small amount"]);
    refused(&["--derivative", "time.step"], &["time.step", "depends"]);
    refused(&["--derivative", "time.end"], &["time.end", "duration"]);
    refused(&["--derivative", "wall.floor.restitution", "--scheme", "moreau-jean"], &["--scheme", "event"]);
    // Not the key is at fault, but the exact scheme has no law for the contact.
    refused(
        &["--derivative", "slider.pad.friction"],
        &["friction", "asked for derivatives, with friction", "slider \"pad\"; expected no friction", "exact"],
    );
}

#[test]
fn a_graze_and_the_horizon_end_the_derivatives_with_their_reason() {
    let dir = folder();
    let args = ["run", "swing.toml", "--derivative", "initial.displacement", "--out", "grazed", "--no-report"];
    let (out, err) = said(dir.path(), &args, 0);
    assert!(format!("{out}{err}").contains("wall \"stop\" is grazed"), "{out}{err}");
    // Between rigid walls that return all of the speed the motion is not predictable for long.
    let args = ["run", "rigid-walls-sine", "--derivative", "wall.upper.restitution", "--out", "chaos", "--no-report"];
    let set = ["--set", "load.1.harmonic.amplitude=30", "--set", "time.end=60"];
    let (out, err) = said(dir.path(), &[&args[..], &set].concat(), 0);
    assert!(format!("{out}{err}").contains("no longer predictable"), "{out}{err}");
    let (header, rows) = columns(dir.path(), "chaos");
    let growth = header.iter().position(|column| column == "growth").unwrap();
    assert!(rows.len() > 3, "{rows:?}");
    assert!(rows.iter().all(|row| row[growth].parse::<f64>().unwrap() <= 1e6));
}

/// The rows of the table in the terminal, from its header on.
fn table_of(out: &str) -> String {
    let at = out.find(" number ").expect("a table");
    out[at..].split("derivatives.csv").next().unwrap_or_default().to_owned()
}

#[test]
fn a_share_of_a_key_that_would_change_much_is_told_smaller() {
    // A ball falls from h = 1 m onto a floor at g = 0.99 m: its speed √(2G (h − g)) changes by
    // −g/2(h − g) = −49.5 % for 1 % more of g, and by −0.495 % for 0.01 % more.
    let dir = folder();
    let near = ["--set", "wall.floor.position=0.99", "--set", "time.end=0.05"];
    let args = ["run", "ball.toml", "--derivative", "wall.floor.position,wall.floor.restitution", "--no-report"];
    let (out, err) = said(dir.path(), &[&args[..], &near].concat(), 0);
    let all = format!("{out}{err}");
    let table = table_of(&out);
    assert!(table.contains("0.01 % more of") && table.contains("-0.49500 %") && !table.contains("-49."), "{table}");
    // The impulse grows as 1 + e: by 0.8/1.8 % for 1 % more of e, which is as small as it says.
    assert!(table.contains(" 1 % more of") && table.contains("+0.444 %"), "{table}");
    assert!(all.contains("1 % more of wall.floor.position would change a number of the table by more"), "{all}");
    assert!(!all.contains("1 % more of wall.floor.restitution would"), "{all}");
}

#[test]
fn a_number_that_is_0_has_no_percent() {
    // A body of 1 kg that touches a pad approaches it with the speed 0, whatever its weight is.
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 0.0\n\
                [[wall]]\nname = \"pad\"\nside = \"upper\"\nposition = 0.0\nstiffness = 100.0\n\
                [[load]]\nconstant = { force = 1.0 }\n\
                [[load]]\nimpulse = { impulse = -0.5, time = 0.3 }\n[time]\nend = 1.0\nstep = 1e-3\n";
    fs::write(dir.path().join("pad.toml"), case).unwrap();
    let args = ["run", "pad.toml", "--derivative", "load.1.constant.force", "--no-report"];
    let (out, _) = said(dir.path(), &args, 0);
    let table = table_of(&out);
    assert!(table.contains("+0.000e0 m/s") && table.contains(" %") && !table.contains("NaN"), "{table}");
}
