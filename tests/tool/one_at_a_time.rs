//! `sweep --one-at-a-time`: effects that equal differences of runs, and what is refused.
use crate::command::said;
use crate::table::{number, rows};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

const CASE: [&str; 5] = ["tube-round-supports", "--set", "time.end=0.4", "--set", "time.statistics_from=0.1"];
const GAP: &str = "support.*.gap=1e-4:4e-4";
const DAMPING: &str = "system.damping.ratio=0.005:0.02";

fn sweep(folder: &Path, out: &str, more: &[&str], code: i32) -> (String, String) {
    let own = ["--vary", GAP, "--vary", DAMPING, "--one-at-a-time", "--measure", "work_rate", "--out", out];
    said(folder, &[&["sweep"], &CASE[..], &own, more].concat(), code)
}

/// The work rates of `run --seeds 3` with `set`: of each realisation, at each support.
fn work_rates(folder: &Path, set: &str) -> HashMap<(String, String), f64> {
    let own = ["--set", set, "--seeds", "3", "--no-verdict", "--force", "--out", "run"];
    said(folder, &[&["run"], &CASE[..], &own].concat(), 0);
    let rows = rows(&folder.join("run/realisations.csv"));
    let of = |row: &HashMap<String, String>| (row["realisation"].clone(), row["place"].clone());
    rows.iter().map(|row| (of(row), number(row, "work_rate_W"))).collect()
}

#[test]
fn an_effect_is_the_mean_difference_of_runs_with_the_same_seeds() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let (out, err) = sweep(path, "whole", &["--seeds", "3"], 0);
    assert!(out.contains("support.*.gap") && out.contains(" ± "), "{out}");
    assert!(err.contains("mean over 3 realisations") && err.contains("5 rows × 3 realisations"), "{err}");
    let effects = rows(&path.join("whole/effects.csv"));
    assert_eq!(effects.len(), 4, "two keys at two supports");
    let case = work_rates(path, "time.end=0.4");
    for (key, low, high) in [("support.*.gap", "1e-4", "4e-4"), ("system.damping.ratio", "0.005", "0.02")] {
        let [at_low, at_high] = [low, high].map(|x| work_rates(path, &format!("{key}={x}")));
        for place in ["plate-1", "plate-2"] {
            let one = effects.iter().find(|one| one["key"] == key && one["place"] == place).unwrap();
            assert_eq!((one["measure"].as_str(), one["unit"].as_str(), one["seeds"].as_str()), ("work_rate", "W", "3"));
            assert_eq!([number(one, "low"), number(one, "high")], [low, high].map(|x| x.parse::<f64>().unwrap()));
            let of = |runs: &HashMap<(String, String), f64>| {
                ["1", "2", "3"].map(|k| runs[&(k.to_owned(), place.to_owned())])
            };
            let mean = |values: [f64; 3]| values.iter().sum::<f64>() / 3.0;
            assert_eq!(number(one, "base"), mean(of(&case)));
            assert_eq!(number(one, "at_low"), mean(of(&at_low)));
            assert_eq!(number(one, "at_high"), mean(of(&at_high)));
            let (a, b) = (of(&at_low), of(&at_high));
            let differences = [b[0] - a[0], b[1] - a[1], b[2] - a[2]];
            let effect = mean(differences);
            assert_eq!(number(one, "effect"), effect);
            // t₂ in closed form: √(2·0.95²/(1 − 0.95²)); the other side's is known to 1e-11.
            let square: f64 = differences.iter().map(|x| (x - effect).powi(2)).sum();
            let half = (2.0 * 0.95_f64.powi(2) / (1.0 - 0.95_f64.powi(2))).sqrt() * (square / 2.0 / 3.0).sqrt();
            assert!((number(one, "half_width_95") / half - 1.0).abs() < 2e-11, "{one:?}");
        }
    }
    // The largest effect of each measure and place stands first.
    for pair in effects.chunks(2) {
        assert_eq!(pair[0]["place"], pair[1]["place"]);
        assert!(number(&pair[0], "effect").abs() >= number(&pair[1], "effect").abs());
    }
    let table = rows(&path.join("whole/sweep.csv"));
    let points: Vec<_> = table.iter().map(|row| (number(row, "gap_m"), number(row, "ratio"))).collect();
    assert_eq!(points, [(2e-4, 0.01), (1e-4, 0.01), (4e-4, 0.01), (2e-4, 0.005), (2e-4, 0.02)]);
    let figure = fs::read_to_string(path.join("whole/sweep.svg")).unwrap();
    assert!(figure.contains("support.*.gap") && figure.contains("at the upper bound"));
    assert!(fs::read_to_string(path.join("whole/report.html")).unwrap().contains("\"effects\":{"));
    for shard in ["1/2", "2/2"] {
        sweep(path, "parts", &["--seeds", "3", "--shard", shard], 0);
    }
    assert!(!path.join("parts/shard-1-of-2/effects.csv").exists(), "a part has no effects");
    let (out, _) = said(path, &["merge", "parts", "--out", "merged"], 0);
    assert!(out.contains("support.*.gap"), "{out}");
    for name in ["sweep.csv", "realisations.csv", "effects.csv", "sweep.svg"] {
        assert!(fs::read(path.join("merged").join(name)).unwrap() == fs::read(path.join("whole").join(name)).unwrap());
    }
}

/// Without realisations an effect has no interval, and the amplitude of a linear oscillator is
/// proportional to that of its load.
#[test]
fn without_realisations_an_effect_has_no_interval() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let args = ["sweep", "linear-sine", "--vary", "load.1.harmonic.amplitude=1:3", "--one-at-a-time"];
    let (out, err) = said(path, &[&args[..], &["--measure", "displacement_rms", "--out", "out"]].concat(), 0);
    assert!(!out.contains("e0"), "numbers are written as a person writes them: {out}");
    assert!(err.contains("the measure at the upper bound less that at the lower one"), "{err}");
    let effects = rows(&path.join("out/effects.csv"));
    let [one] = effects.as_slice() else { panic!("{effects:?}") };
    assert_eq!(one["half_width_95"], "");
    // The response from rest is linear in the load: three times that of one; rounding of 1e4 steps.
    let (low, high) = (number(one, "at_low"), number(one, "at_high"));
    assert!((high / low / 3.0 - 1.0).abs() < 1e-9 && low > 0.0, "{one:?}");
    assert_eq!(number(one, "effect"), high - low);
}

#[test]
fn what_cannot_be_varied_one_at_a_time_is_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let refused = |args: &[&str], words: &[&str]| {
        let own = ["sweep", "tube-round-supports", "--measure", "work_rate"];
        let (_, err) = said(dir.path(), &[&own[..], args].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    refused(&["--vary", "support.*.gap=1e-4:4e-4"], &["from and to", "--one-at-a-time"]);
    refused(&["--vary", "support.*.gap=1e-4,4e-4", "--one-at-a-time"], &["KEY=FROM:TO", "one at a time"]);
    refused(&["--vary", "support.*.gap=1e-4:4e-4:5", "--one-at-a-time"], &["KEY=FROM:TO", "one at a time"]);
    // Two supports with two gaps have no value from which both are varied.
    let two = ["--set", "support.plate-1.gap=3e-4", "--vary", "support.*.gap=1e-4:4e-4", "--one-at-a-time"];
    refused(&two, &["support.*.gap", "--set 'support.*.gap=VALUE'"]);
    refused(
        &["--vary", "support.*.gap=1e-4:4e-4", "--one-at-a-time", "--random", "lhs", "--points", "4"],
        &["--random"],
    );
    refused(&["--vary", "support.*.gap=1e-4:4e-4", "--one-at-a-time", "--follow", "up"], &["--follow"]);
    assert!(!dir.path().join("out").exists(), "a refused request leaves nothing");
}

/// Between the bounds of the stiffness lies the resonance, which takes the displacement down at
/// both of them: the difference between the bounds is small, the bar is long, and stands first.
#[test]
fn a_key_that_turns_the_measure_between_its_bounds_has_the_longest_bar() {
    let dir = tempfile::tempdir().unwrap();
    // Without contact, at the natural frequency of 100 N/m and 1 kg.
    let alone = ["--set", "wall.upper.position=10", "--set", "wall.lower.position=-10"];
    let at_resonance = ["--set", "load.1.harmonic.frequency=1.5915"];
    let keys = ["--vary", "system.oscillator.damping=0.18:0.22", "--vary", "system.oscillator.stiffness=80:125"];
    let own = ["--one-at-a-time", "--measure", "displacement_max", "--settle", "200", "--keep", "10", "--out", "o"];
    let scheme = ["--scheme", "event"];
    let args = [&["sweep", "rigid-walls-sine"], &alone[..], &at_resonance, &keys, &own, &scheme].concat();
    let (_, told) = said(dir.path(), &args, 0);
    assert!(told.contains("on one side of its value in the case at both bounds of system.oscillator.stiff"), "{told}");
    let effects = rows(&dir.path().join("o/effects.csv"));
    let of = |row: usize| (effects[row]["key"].as_str(), number(&effects[row], "effect"));
    let ((first, stiffness), (second, damping)) = (of(0), of(1));
    assert_eq!((first, second), ("system.oscillator.stiffness", "system.oscillator.damping"));
    assert!(stiffness.abs() < 0.2 * damping.abs(), "{effects:?}");
}
