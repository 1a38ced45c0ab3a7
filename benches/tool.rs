//! Cost of the tool's own runs: the verdict over the run alone, in processor time, and realisations
//! on two cores over one, in wall-clock time. The sides alternate; the best of each counts. Prints
//! ratios, asserts nothing about time. Needs Linux, whose `/proc` and `taskset` it uses.
//!
//! `cargo bench --bench tool`

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

mod support;
use support::race;

const ROUNDS: usize = 5;

/// Runs the tool on some of the machine's cores, and returns its processor time in ticks of the
/// kernel and its wall-clock time, s.
fn run(out: &Path, cores: &str, arguments: &[&str]) -> [f64; 2] {
    // The ticks that ended children have spent in user mode.
    let spent = || {
        let stat = std::fs::read_to_string("/proc/self/stat").expect("Linux");
        stat.split_whitespace().nth(15).and_then(|ticks| ticks.parse::<f64>().ok()).expect("a number of ticks")
    };
    let (before, started) = (spent(), Instant::now());
    let mut tool = Command::new("taskset");
    tool.args(["--cpu-list", cores, env!("CARGO_BIN_EXE_signorini"), "run", "--quiet", "--force", "--out"]).arg(out);
    let status = tool.args(arguments).stdout(Stdio::null()).status().expect("taskset");
    assert!(status.success(), "{arguments:?}");
    [spent() - before, started.elapsed().as_secs_f64()]
}

fn main() {
    let out = std::env::temp_dir().join(format!("signorini-bench-{}", std::process::id()));
    for case in ["tube-loose-supports", "tube-round-supports"] {
        let user = |arguments: &[&str]| run(&out, "0,1", arguments)[0];
        let [alone, checked] = race(ROUNDS, || [user(&[case, "--no-verdict"]), user(&[case])]);
        println!("{case:<24} with its verdict over without: {:.2}", checked / alone);
    }
    let seeds = ["tube-round-supports", "--seeds", "6", "--no-verdict"];
    let [one, two] = race(ROUNDS, || ["0", "0,1"].map(|cores| run(&out, cores, &seeds)[1]));
    println!("{:<24} six realisations, one core over two: {:.2}", seeds[0], one / two);
    std::fs::remove_dir_all(&out).expect("the results");
}
