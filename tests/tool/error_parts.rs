//! The errors of means over realisations: the table, `errors.csv`, the summary, the exit code.
use crate::command::said;
use crate::shaken::square_of_bars;
use crate::table::summary;
use std::fs;
use std::path::Path;

/// Bars with friction.
fn square() -> String {
    let time = "[time]\nend = 2.0\nstep = 1e-3\nsample = 1e-2\nstatistics_from = 0.5\n";
    square_of_bars("friction = 0.2\n", time)
}

/// A pinned tube in four modes before a stop, in one plane.
const TUBE: &str = r#"
[system]
modes = 4

[system.beam]
length = 1.0
elements = 10
outer_diameter = 19.05e-3
inner_diameter = 15.75e-3
youngs_modulus = 2e11
density = 7850.0
left = "pinned"
right = "pinned"

[system.damping]
ratio = 0.01

[[wall]]
name = "stop"
side = "upper"
at = { position = 0.5 }
position = 2e-5
restitution = 0.5

[[load]]
at = { position = 0.3 }
random = { rms = 20.0, from = 5.0, to = 200.0, seed = 3 }

[time]
end = 0.3
step = 1e-4
sample = 1e-3
statistics_from = 0.1
"#;

fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("square.toml"), square()).unwrap();
    fs::write(dir.path().join("tube.toml"), TUBE).unwrap();
    dir
}

fn cells(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// The column `name` of `table`, in the rows of `place`, as numbers.
fn column(table: &[Vec<String>], place: &str, name: &str) -> Vec<f64> {
    let at = table[0].iter().position(|cell| cell == name).unwrap();
    let row = table[0].iter().position(|cell| cell == "place").unwrap();
    table[1..].iter().filter(|cells| cells[row] == place).map(|cells| cells[at].parse().unwrap()).collect()
}

/// The parts that the table of errors has, in its order.
fn parts(out: &str) -> Vec<&str> {
    let heading = out.lines().find(|line| line.starts_with("place") && line.contains("mean of")).unwrap();
    heading.split_whitespace().filter(|word| ["start", "step", "modes", "sampling"].contains(word)).collect()
}

/// Mean and half width of the 95 % interval of `values`, with t from a table.
fn student(values: &[f64], t: f64) -> [f64; 2] {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
    [mean, t * (square / count).sqrt()]
}

#[test]
fn each_part_is_what_runs_with_the_same_seeds_differ_by() {
    let dir = folder();
    let path = dir.path();
    let run = ["run", "square.toml", "--scheme", "moreau-jean"];
    let (out, err) = said(path, &[&run[..], &["--seeds", "7", "--out", "seven"]].concat(), 0);
    let plain = |out: &str, more: &[&str]| {
        said(path, &[&run[..], &["--no-verdict", "--out", out], more].concat(), 0);
        cells(&path.join(out).join("realisations.csv"))
    };
    let whole = cells(&path.join("seven/realisations.csv"));
    let halved = plain("half", &["--seeds", "6", "--step", "5e-4"]);
    let second = plain("second", &["--seeds", "7", "--set", "time.statistics_from=1.25"]);
    let errors = cells(&path.join("seven/errors.csv"));
    let header = "place,kind,measure,unit,mean,half_width_95,error,start,start_half_width_95,step,step_half_width_95,\
                  modes,modes_half_width_95";
    assert_eq!(errors[0].join(","), header);
    // Three means of the support and two of each of its flats.
    assert_eq!(errors.len(), 1 + 3 + 4 * 2);
    let summary = summary(&path.join("seven"));
    let estimates = summary["realisations"]["estimates"].as_array().unwrap();
    for (measure, unit) in [("work_rate", "W"), ("force_mean", "N")] {
        let of = |table: &[Vec<String>]| column(table, "bars", &format!("{measure}_{unit}"));
        let (whole, halved, second) = (of(&whole), of(&halved), of(&second));
        // t of five and of six degrees of freedom. The first half is twice the whole less the
        // second.
        let doubled: Vec<f64> = halved.iter().zip(&whole).map(|(half, whole)| 2.0 * (half - whole)).collect();
        let halves: Vec<f64> = second.iter().zip(&whole).map(|(second, whole)| 2.0 * (second - whole)).collect();
        let (step, start) = (student(&doubled, 2.570_581_835_6), student(&halves, 2.446_911_851_1));
        let [mean, sampling] = student(&whole, 2.446_911_851_1);
        let total = step[0].abs() + start[0].abs() + (step[1].powi(2) + start[1].powi(2) + sampling.powi(2)).sqrt();
        let row = errors.iter().find(|row| row[0] == "bars" && row[2] == measure).unwrap();
        let expected = [mean, sampling, total, start[0], start[1], step[0], step[1]];
        for (cell, wanted) in row[4..].iter().zip(expected) {
            let cell: f64 = cell.parse().unwrap();
            assert!((cell - wanted).abs() < 1e-6 * mean, "{measure}: {row:?}, {expected:?}");
        }
        assert_eq!((row[3].as_str(), row[11].as_str(), row[12].as_str()), (unit, "", ""), "no modes are left out");
        let one = estimates.iter().find(|one| one["place"] == "bars" && one["measure"] == measure).unwrap();
        assert_eq!(one["error"]["step"]["mean"].as_f64(), row[9].parse().ok());
        assert_eq!(one["error"]["total"].as_f64(), row[6].parse().ok());
        assert!(one["error"]["modes"].is_null());
    }
    // What need not converge has no error: it is the mean of the six that were run again, beside
    // that with half the step. The flats have no work of sliding of their own.
    for (measure, column_name) in
        [("impact_share", "impact_share"), ("sliding_rate", "sliding_rate_m_per_s"), ("contacts", "contacts")]
    {
        let one = estimates.iter().find(|one| one["place"] == "bars" && one["measure"] == measure).unwrap();
        assert!(one["error"].is_null());
        let told = one["refinements"].as_array().unwrap();
        assert_eq!((told.len(), &told[0]["refined"]["half_step"]["order"]), (1, &1.into()));
        for (table, key) in [(&whole, "own"), (&halved, "then")] {
            let values = column(table, "bars", column_name);
            let mean = values.iter().take(6).sum::<f64>() / 6.0;
            // Cells have six digits.
            assert!((told[0][key].as_f64().unwrap() / mean - 1.0).abs() < 1e-5, "{measure} {key}: {told:?}, {mean}");
        }
        assert!(out.contains(&measure.replace('_', " ")), "{out}");
    }
    assert!(errors.iter().all(|row| row[2] != "contacts"));
    let share = |place: &str| estimates.iter().any(|one| one["place"] == place && one["measure"] == "impact_share");
    assert!(share("bars") && !share("bars-flat-1"));
    assert!(err.contains("need not converge"), "{err}");
    let check = &summary["realisations"]["checks"][0];
    assert_eq!((&check["count"], &check["refined"]["half_step"]["order"]), (&6.into(), &1.into()));
    assert_eq!(parts(&out), ["start", "step", "sampling"]);
    assert!(out.lines().filter(|line| line.contains('±')).all(|line| line.chars().count() <= 78), "{out}");
    assert!(err.contains("from the first 6 of 7 realisations") && err.contains("bars: work rate"), "{err}");
    assert!(!path.join("half/errors.csv").exists(), "without a verdict there are no errors");
}

#[test]
fn modes_are_a_part_where_some_are_left_out_and_the_step_where_the_scheme_has_one() {
    let dir = folder();
    let path = dir.path();
    let (out, err) = said(path, &["run", "tube.toml", "--scheme", "event", "--seeds", "2", "--out", "exact"], 0);
    assert_eq!(parts(&out), ["start", "modes", "sampling"]);
    assert!(err.contains("modes: the change by 8 modes") && err.contains("stop: mean force "), "{err}");
    let (out, err) = said(path, &["run", "tube.toml", "--seeds", "2", "--out", "located"], 0);
    assert_eq!(parts(&out), ["start", "step", "modes", "sampling"]);
    assert!(err.contains("step: 4/3 of the change by half the step"), "{err}");
    // The part of the modes is what the same seeds with 8 modes change.
    said(path, &["run", "tube.toml", "--modes", "8", "--seeds", "2", "--no-verdict", "--out", "eight"], 0);
    let of = |out: &str| column(&cells(&path.join(out).join("realisations.csv")), "stop", "force_mean_N");
    let changes: Vec<f64> = of("eight").iter().zip(of("located")).map(|(eight, four)| eight - four).collect();
    let errors = cells(&path.join("located/errors.csv"));
    let modes = column(&errors, "stop", "modes")[0];
    assert!((modes - student(&changes, 12.7).as_slice()[0]).abs() < 1e-9 * modes.abs(), "{modes} {changes:?}");
    // One realisation has no intervals, and hence no errors.
    let (_, err) = said(path, &["run", "tube.toml", "--seeds", "1", "--out", "one"], 0);
    assert!(!path.join("one/errors.csv").exists() && !err.contains("second half of the window"), "{err}");
}

#[test]
fn a_refuted_check_fails_the_command_and_gives_no_part() {
    let dir = folder();
    let path = dir.path();
    // Explicit, and stable with 4 modes up to 785 Hz, not with 8 up to 3.1 kHz.
    let scheme = "penalty:stiffness=1e4,integrator=central-difference";
    let args = ["run", "tube.toml", "--scheme", scheme, "--step", "3e-4", "--seeds", "2", "--out", "wrong"];
    let (out, err) = said(path, &args, 1);
    assert!(err.contains("with 8 modes 2 of 2 realisations are refuted: that part of the errors"), "{err}");
    assert!(err.contains("refuted by the judge") && err.contains("realisation 2 with 8 modes"), "{err}");
    assert_eq!(parts(&out), ["start", "step", "sampling"]);
    let summary = summary(&path.join("wrong"));
    assert_eq!(summary["realisations"]["checks"][1]["refuted"], serde_json::json!([1, 2]));
}
