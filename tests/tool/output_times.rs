//! `output_times` of a case: the files of a run, of a comparison and of derivatives.

use crate::command::said;
use crate::derivatives::BALL;
use crate::table::csv;
use std::fs;

/// The ball that falls from 1 m onto a floor of restitution 0.8, asked for before and after its
/// impact at 0.4515 s and after the end.
fn ball() -> String {
    format!("{BALL}output_times = [0.3, 0.6, 1.2]\n")
}

/// Height and velocity of the ball dropped from `h` metres, at 0.3 and 0.6 s: closed form.
fn closed(h: f64) -> [[f64; 2]; 2] {
    let g = 9.81;
    let (fall, speed) = ((2.0 * h / g).sqrt(), 0.8 * (2.0 * g * h).sqrt());
    let after = 0.6 - fall;
    [[h - 0.5 * g * 0.09, -g * 0.3], [speed * after - 0.5 * g * after * after, speed - g * after]]
}

fn numbers(row: &[String]) -> Vec<f64> {
    row.iter().map(|cell| cell.parse().unwrap()).collect()
}

#[test]
fn states_at_output_times_have_a_table_of_their_own_and_derivatives() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("ball.toml"), ball()).unwrap();
    let key = "initial.displacement";
    let (_, err) = said(dir.path(), &["run", "ball.toml", "--derivative", key, "--no-verdict", "--out", "o"], 0);
    assert!(err.contains("1 of 3 output times lie after the end, 1.0 s: they are left out"), "{err}");

    let (header, rows) = csv(&dir.path().join("o/output.csv"));
    assert_eq!(header, ["time_s", "displacement_m", "velocity_m_per_s"]);
    let wanted = closed(1.0);
    let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
    assert_eq!(rows.len(), 2);
    for (row, (time, [q, v])) in rows.iter().zip([0.3, 0.6].into_iter().zip(wanted)) {
        let row = numbers(row);
        assert!(row[0] == time && close(row[1], q) && close(row[2], v), "{row:?}, closed form {q} m, {v} m/s");
    }

    // Other times are another request, which does not replace these results unasked.
    let other = ["run", "ball.toml", "--derivative", key, "--no-verdict", "--out", "o"];
    let err = said(dir.path(), &[&other[..], &["--set", "time.output_times=[0.3]"]].concat(), 2).1;
    assert!(err.contains("another request") && err.contains("output_times"), "{err}");

    let (header, rows) = csv(&dir.path().join("o/output-derivatives.csv"));
    let by = "by_initial_displacement";
    let [of_q, of_v] = [format!("displacement_{by}_m_per_m"), format!("velocity_{by}_m_per_s_per_m")];
    assert_eq!(header, ["time_s", "displacement_m", &of_q, "velocity_m_per_s", &of_v]);
    // Central differences of the closed form: 1e-6 m to either side, right to 1e-9.
    let (more, less) = (closed(1.0 + 1e-6), closed(1.0 - 1e-6));
    for (row, (more, less)) in rows.iter().zip(more.iter().zip(less)) {
        let row = numbers(row);
        let slope = |part: usize| (more[part] - less[part]) / 2e-6;
        assert!((row[2] - slope(0)).abs() < 1e-8 && (row[4] - slope(1)).abs() < 1e-8, "{row:?}");
    }
}

#[test]
fn each_method_of_a_comparison_has_the_table_and_a_run_without_times_has_none() {
    let dir = tempfile::tempdir().unwrap();
    let times = ["--set", "time.output_times=[0.0123, 0.0456]", "--end", "0.1"];
    said(dir.path(), &[&["compare", "rigid-walls-sine", "--out", "c"], &times[..]].concat(), 0);
    let methods: Vec<_> = fs::read_dir(dir.path().join("c")).unwrap().map(|entry| entry.unwrap().path()).collect();
    let folders: Vec<_> = methods.iter().filter(|path| path.join("trajectory.csv").exists()).collect();
    assert!(folders.len() >= 3, "{methods:?}");
    for folder in folders {
        assert_eq!(csv(&folder.join("output.csv")).1.len(), 2, "{folder:?}");
    }
    // Two planes: a probe along y and one along z of each support.
    let tube = ["run", "tube-round-supports", "--end", "0.02", "--set", "time.statistics_from=0", "--no-verdict"];
    said(dir.path(), &[&tube[..], &["--set", "time.output_times=[0.01]", "--out", "t"]].concat(), 0);
    let (header, rows) = csv(&dir.path().join("t/output.csv"));
    assert!(header.contains(&"displacement_plate_1_z_m".to_owned()) && rows.len() == 1, "{header:?}");
    said(dir.path(), &[&tube[..], &["--out", "without"]].concat(), 0);
    assert!(!dir.path().join("without/output.csv").exists());
}
