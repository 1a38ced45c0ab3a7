//! `compare --seeds`: means of methods that equal those of their runs, and paired differences.
use crate::command::said;
use crate::shaken::before_a_stop;
use std::fs;
use std::path::Path;

fn place() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("stop.toml"), before_a_stop(5e-3)).unwrap();
    dir
}

/// The lines of a table, as they are.
fn lines(path: &Path) -> Vec<String> {
    fs::read_to_string(path).unwrap().lines().map(str::to_owned).collect()
}

#[test]
fn means_are_those_of_run_and_differences_are_paired_by_seed() {
    let dir = place();
    let path = dir.path();
    let penalty = "penalty:stiffness=1e6";
    let schemes = format!("moreau-jean,{penalty}");
    let own = ["compare", "stop.toml", "--schemes", &schemes, "--seeds", "3", "--no-verdict", "--out", "compared"];
    let (out, err) = said(path, &own, 0);
    assert!(out.contains("less event") && out.contains("mean force (N)") && out.contains(" ± "), "{out}");
    assert!(err.contains("over 3 realisations") && err.contains("of realisation 1 alone"), "{err}");
    let compared = lines(&path.join("compared/realisations.csv"));
    let names = ["moreau-jean", penalty, "event"];
    // The mean forces of each method, by realisation, from runs of their own.
    let mut forces = Vec::new();
    for (index, scheme) in names.into_iter().enumerate() {
        let own = ["run", "stop.toml", "--scheme", scheme, "--seeds", "3", "--no-verdict", "--out"];
        // The exact run has the rows of the comparison.
        let rows = if scheme == "event" { &["--sample", "1e-3"][..] } else { &[] };
        said(path, &[&own[..], &[&format!("run-{index}")], rows].concat(), 0);
        let alone = lines(&path.join(format!("run-{index}/realisations.csv")));
        let of_method = |line: &String| line.strip_prefix(&format!("{scheme},")).map(str::to_owned);
        let same: Vec<String> = compared.iter().filter_map(of_method).collect();
        assert_eq!(same, alone[1..], "{scheme}");
        assert_eq!(compared[0], format!("method,{}", alone[0]));
        forces
            .push(alone[1..].iter().map(|line| line.split(',').nth(3).unwrap().parse().unwrap()).collect::<Vec<f64>>());
    }
    let means = lines(&path.join("compared/compare-realisations.csv"));
    let cells = |method: &str| -> Vec<String> {
        let start = format!("{method},stop,wall,force_mean,N,");
        let line = means.iter().find(|line| line.starts_with(&start)).unwrap_or_else(|| panic!("{means:?}"));
        line.split(',').skip(5).map(str::to_owned).collect()
    };
    for index in [0, 1] {
        let pairs: Vec<f64> = forces[index].iter().zip(&forces[2]).map(|(x, exact)| x - exact).collect();
        let mean = pairs.iter().sum::<f64>() / 3.0;
        let square: f64 = pairs.iter().map(|x| (x - mean).powi(2)).sum();
        // t₂ in closed form; the other side's is known to 1e-11.
        let half = (2.0 * 0.95_f64.powi(2) / (1.0 - 0.95_f64.powi(2))).sqrt() * (square / 2.0 / 3.0).sqrt();
        let cells = cells(names[index]);
        let number = |at: usize| cells[at].parse::<f64>().unwrap();
        assert_eq!((number(0), cells[3].as_str()), (forces[index].iter().sum::<f64>() / 3.0, "event"));
        assert_eq!(number(4), mean);
        assert!((number(5) / half - 1.0).abs() < 2e-11, "{cells:?}");
    }
    assert_eq!(cells("event")[3..], ["", "", "", "0"]);
}

#[test]
fn the_errors_of_each_method_are_those_of_run() {
    let dir = place();
    let path = dir.path();
    let own = ["compare", "stop.toml", "--schemes", "moreau-jean,located", "--seeds", "3", "--out", "compared"];
    let (out, err) = said(path, &own, 0);
    let compared = lines(&path.join("compared/errors.csv"));
    for scheme in ["moreau-jean", "located", "event"] {
        let own = ["run", "stop.toml", "--scheme", scheme, "--seeds", "3", "--out", scheme];
        // The exact run has the rows of the comparison.
        let rows = if scheme == "event" { &["--sample", "1e-3"][..] } else { &[] };
        said(path, &[&own[..], rows].concat(), 0);
        let alone = lines(&path.join(scheme).join("errors.csv"));
        let of_method = |line: &String| line.strip_prefix(&format!("{scheme},")).map(str::to_owned);
        assert_eq!(compared.iter().filter_map(of_method).collect::<Vec<_>>(), alone[1..], "{scheme}");
        assert_eq!(compared[0], format!("method,{}", alone[0]));
        // The exact scheme has no step.
        assert_eq!(alone[1].split(',').nth(9) == Some(""), scheme == "event", "{alone:?}");
        assert_eq!(out.lines().filter(|line| line.contains(&format!("mean force  {scheme} "))).count(), 1, "{out}");
    }
    assert!(err.contains("step: the change by half the step, twice or 4/3 of it"), "{err}");
    let own = ["compare", "stop.toml", "--schemes", "moreau-jean", "--seeds", "3", "--no-verdict", "--out", "plain"];
    let (_, err) = said(path, &own, 0);
    assert!(!path.join("plain/errors.csv").exists() && !err.contains("errors: start"), "{err}");
}

#[test]
fn a_method_with_a_refuted_realisation_is_named() {
    let dir = place();
    let path = dir.path();
    // The third realisation alone comes to the stop so early that an explicit rule diverges.
    let own = ["compare", "stop.toml", "--set", "wall.stop.position=20e-3", "--seeds", "3", "--no-verdict"];
    let penalty = "penalty:stiffness=1e12,integrator=central-difference";
    let schemes = ["--schemes", &format!("moreau-jean;{penalty}"), "--out", "out"];
    let (_, err) = said(path, &[&own[..], &schemes].concat(), 1);
    assert!(err.contains(&format!("refuted: {penalty}, realisation 3: the run diverged")), "{err}");
    assert!(err.contains("1 of 3 realisations are refuted: its means are wrong"), "{err}");
}

#[test]
fn seeds_that_make_no_sense_are_refused() {
    let dir = place();
    for (args, words) in [
        (&["rigid-walls-sine", "--seeds", "3"][..], "a random load"),
        (&["stop.toml", "--seeds", "0"], "1 or more"),
        (&["stop.toml", "--seeds", "-1"], "--seeds"),
    ] {
        let (_, err) = said(dir.path(), &[&["compare"], args].concat(), 2);
        assert!(err.contains(words), "{args:?}: {err}");
    }
    assert!(!dir.path().join("out").exists(), "a refused request leaves nothing");
}
