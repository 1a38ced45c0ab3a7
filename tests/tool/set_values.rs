//! `--set KEY=VALUE`: a value of the case by its key, on every command that takes a case.
use crate::command::said;
use signorini::case::{Case, CaseFile, Embedded, Key};

#[test]
fn every_command_with_a_case_takes_it() {
    let dir = tempfile::tempdir().unwrap();
    let set = ["--set", "wall.upper.position=6e-3", "--set", "time.end=0.2"];
    let commands: [&[&str]; 5] = [
        &["run", "rigid-walls-sine", "--no-verdict", "--json"],
        &["compare", "rigid-walls-sine", "--no-verdict", "--json"],
        &["chart", "rigid-walls-sine", "--schemes", "event", "--levels", "1", "--json"],
        &["explain", "rigid-walls-sine", "--json"],
        &["stability", "rigid-walls-sine", "--set", "load.1.harmonic.amplitude=1.5", "--most-steps", "20000", "--json"],
    ];
    for command in commands {
        let (out, _) = said(dir.path(), &[command, &set].concat(), 0);
        let document: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert!(document.is_object(), "{command:?}");
        if ["run", "compare", "explain"].contains(&command[0]) {
            assert!(out.contains("0.006"), "{command:?}: {out}");
        }
        let wrong = [command, &["--set", "wall.upper.position=inf"]].concat();
        let (_, err) = said(dir.path(), &wrong, 2);
        assert!(err.contains("wall.upper.position = inf:"), "{command:?}: {err}");
    }
}

#[test]
fn a_value_that_is_set_does_what_the_same_value_in_the_file_does() {
    let embedded = Embedded::named("rigid-walls-sine").unwrap();
    let changed = embedded.text.replace("frequency = 5.0", "frequency = 4.5").replace("end = 10.0 ", "end = 2.0 ");
    assert_ne!(changed, embedded.text);
    let written = Case::parse(&changed, "rigid-walls-sine.toml", "").unwrap();
    let mut file = CaseFile::embedded("rigid-walls-sine").unwrap();
    for (key, value) in [("load.1.harmonic.frequency", 4.5), ("time.end", 2.0)] {
        file.set(&key.parse().unwrap(), &value.into()).unwrap();
    }
    assert_eq!(file.case().unwrap(), written);
}

#[test]
fn what_a_case_has_at_each_of_its_keys_makes_the_same_case_again() {
    // Read each number by its key and set it to itself: the case stays as it was, whatever is
    // written how.
    let keys = [
        "system.oscillator.mass",
        "system.chain.springs",
        "system.beam.outer_diameter",
        "system.beam.left",
        "system.damping.ratio",
        "wall.*.side",
        "wall.lower.restitution",
        "load.1.harmonic.amplitude",
        "initial.displacement",
        "time.step",
        "penalty.epsilon",
    ];
    let mut set = 0;
    for embedded in Embedded::all() {
        let mut file = CaseFile::embedded(embedded.name).unwrap();
        let original = file.case().unwrap();
        for key in keys.map(|key| key.parse::<Key>().unwrap()) {
            // No wall is named `lower` in some.
            if let Some(value) = file.get(&key).unwrap() {
                file.set(&key, &value).unwrap();
                set += 1;
            }
        }
        assert_eq!(file.case().unwrap(), original, "{}", embedded.name);
    }
    assert!(set > 60, "{set}");
}

#[test]
fn the_summary_of_a_run_can_be_changed_by_keys_too() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["run", "tabulated-pulse", "--no-verdict"], 0);
    let summary = "out/tabulated-pulse/run/summary.json";
    let (out, _) = said(dir.path(), &["explain", summary, "--set", "system.oscillator.mass=2.5", "--json"], 0);
    assert!(out.contains("2.5"), "{out}");
}

#[test]
fn bad_keys_and_values_are_named_with_what_would_do() {
    let dir = tempfile::tempdir().unwrap();
    for (set, words) in [
        ("wall.uper.position=1", "no wall is named \"uper\"; did you mean upper? there is upper, lower"),
        ("wall.upper.positon=1", "did you mean wall.upper.position?"),
        ("load.2.harmonic.phase=1", "no load is named \"2\"; there is 1"),
        ("wall.upper.position", "KEY=VALUE"),
        ("wall.upper.position=", "a number, a word"),
        ("wall.upper.position=far", "takes a number"),
        ("wall.upper.restitution=2", "expected a number from 0 to 1"),
        ("penalty.epsilon.7=1e-9", "an entry of that list from 0 to below 3"),
        ("system.chain.springs=1", "chain"),
    ] {
        let (_, err) = said(dir.path(), &["explain", "rigid-walls-sine", "--set", set], 2);
        assert!(err.contains(words), "{set}: {err}");
    }
}

#[test]
fn values_are_set_before_anything_of_the_case_is_checked() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    // The end asked for is later than the window's begin, which the file's end of 10 s is not.
    let late = ["run", "rigid-walls-sine", "--end", "12", "--set", "time.statistics_from=11", "--no-verdict", "--json"];
    let run: serde_json::Value = serde_json::from_str(&said(path, &late, 0).0).unwrap();
    assert_eq!(run["case_file"]["time"]["statistics_from"], 11.0, "{run}");
    // The number of modes, without which turbulence is refused, may come from the command line.
    let text = Embedded::named("tube-in-cross-flow").unwrap().text;
    let without: String =
        text.lines().filter(|line| !line.starts_with("modes = 20")).map(|l| format!("{l}\n")).collect();
    assert_ne!(without.lines().count(), text.lines().count());
    std::fs::write(path.join("tube.toml"), without).unwrap();
    for modes in [&["--set", "system.modes=4"][..], &["--set", "time.end=2", "--set", "system.modes=4"]] {
        let (out, _) = said(path, &[&["explain", "tube.toml"], modes].concat(), 0);
        assert!(out.contains("cut to 4 modes in each plane"), "{out}");
    }
    let run = ["run", "tube.toml", "--modes", "4", "--end", "0.02", "--no-verdict", "--out", "four"];
    said(path, &run, 0);
    // What is wrong in the file itself is shown at its own line, whatever else is set.
    let line = 1 + text.lines().filter(|l| !l.starts_with("modes = 20")).position(|l| l == "[[turbulence]]").unwrap();
    let (_, err) = said(path, &["explain", "tube.toml", "--set", "time.end=0.5"], 2);
    assert!(err.contains(&format!("--> tube.toml:{line}:")) && err.contains("expected modes = k"), "{err}");
}

#[test]
fn fields_of_bodies_are_set_by_their_keys() {
    let dir = tempfile::tempdir().unwrap();
    let body = |name: &str| {
        format!("[[body]]\nname = \"{name}\"\n[body.oscillator]\nmass = 1.0\ndamping = 0.1\nstiffness = 100.0\n")
    };
    let rest = "[initial]\nvelocity = { a = 0.2, b = 0.3 }\n[time]\nend = 0.1\nstep = 1e-3\n";
    std::fs::write(dir.path().join("two.toml"), format!("{}{}{rest}", body("a"), body("b"))).unwrap();
    let two = CaseFile::read(dir.path().join("two.toml")).unwrap();
    for (key, expected) in [("initial.velocity.a", [0.1, 0.3]), ("initial.velocity.b", [0.2, 0.1])] {
        let mut set = two.clone();
        set.set(&key.parse().unwrap(), &0.1.into()).unwrap();
        assert_eq!(set.case().unwrap().scene.initial.v, expected, "{key}");
    }
    said(dir.path(), &["run", "two.toml", "--no-verdict", "--set", "initial.velocity.a=0.1"], 0);
    let (_, err) = said(dir.path(), &["explain", "two.toml", "--set", "initial.velocity.c=0.1"], 2);
    assert!(err.contains("unknown key `c` in `initial.velocity`"), "{err}");
}

/// M of another size than K, by a key, beside damping that is computed from both.
#[test]
fn a_matrix_of_another_size_is_refused_whatever_is_computed_of_it() {
    let dir = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| std::fs::write(dir.path().join(name), text).unwrap();
    file("K.csv", "2000,-1000,0\n-1000,2000,-1000\n0,-1000,1000\n");
    file("M.csv", "1,0,0\n0,1,0\n0,0,1\n");
    file("M2.csv", "1,0\n0,1\n");
    file("M4.csv", "1,0,0,0\n0,1,0,0\n0,0,1,0\n0,0,0,1\n");
    let matrices = "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.csv\"\n";
    let rest = "[[load]]\nat = { dof = 0 }\nconstant = { force = 1.0 }\n[time]\nend = 0.1\nstep = 1e-3\n";
    for (damping, start) in [
        ("[system.damping]\nratio = 0.01\n", ""),
        ("[system.damping]\nrayleigh = { mass = 0.1, stiffness = 1e-4 }\n", ""),
        ("", "[initial]\nequilibrium = true\n"),
        ("", ""),
    ] {
        file("k.toml", &format!("{matrices}{damping}{start}{rest}"));
        said(dir.path(), &["explain", "k.toml"], 0);
        for (mass, n) in [("M2.csv", 2), ("M4.csv", 4)] {
            let set = format!("system.matrices.mass={mass}");
            for command in ["run", "explain"] {
                let (_, err) = said(dir.path(), &[command, "k.toml", "--set", &set], 2);
                assert!(
                    err.contains("stiffness matrix is 3 × 3")
                        && err.contains(&format!("expected {n} × {n}, as the mass")),
                    "{err}"
                );
                assert!(err.contains(":3:13\n"), "{err}");
            }
        }
    }
    let other = signorini::Structure { mass: signorini::linear::Symmetric::diagonal(&[1.0; 2]), ..Default::default() };
    let refused = other.with_damping(&signorini::Damping::Modal(vec![0.01])).unwrap_err();
    assert!(refused.to_string().contains("stiffness matrix is 0 × 0; expected 2 × 2"), "{refused}");
}
