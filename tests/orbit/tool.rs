//! `signorini orbit` and `signorini continue`: files that read back, exit codes, and what they say
//! of wrong requests.
use crate::command::said;
use serde_json::Value;
use std::fs;
use std::path::Path;

const CASE: &str = "rigid-walls-sine";
const SOFT: [&str; 3] = [CASE, "--set", "wall.*.restitution=0.8"];

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The determinant of the monodromy matrix of one impact at each of two walls is
/// (e₁ e₂)² exp(−c T/m), that of two multipliers of one modulus the square of it.
#[test]
fn keys_change_an_orbit_as_its_closed_form_says() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let keys = ["wall.upper.restitution", "load.1.harmonic.frequency", "load.1.harmonic.amplitude"];
    let asked = ["--derivative", &keys.join(","), "--out", "a"];
    let (out, _) = said(path, &[&["orbit"], &SOFT[..], &asked].concat(), 0);
    let found = &json(&path.join("a/orbit.json"))["derivatives"];
    // e = 0.8, T = 0.2 s and c/m = 0.2 1/s; δT = −T δf/f.
    let shares = [1.0 / 0.8, 0.5 * 0.2 * 0.2 / 5.0, 0.0];
    for multiplier in found["multipliers"].as_array().unwrap() {
        let part = |value: &Value| [0, 1].map(|part| value[part].as_f64().unwrap());
        let [re, im] = part(&multiplier["value"]);
        for (key, share) in shares.iter().enumerate() {
            let [by_re, by_im] = part(&multiplier["derivative"][key]);
            let of_modulus = (re * by_re + im * by_im) / (re * re + im * im);
            assert!((of_modulus - share).abs() < 1e-12, "{}: {of_modulus} {share}", keys[key]);
        }
    }
    let row = out.lines().find(|line| line.contains("largest |multiplier|")).unwrap();
    assert!(row.split_whitespace().collect::<Vec<_>>().join(" ").contains("+1.000 % +0.020 %"), "{row}");
    // Both walls and each of their events; a table with the same numbers, and one of multipliers.
    let events = found["events"].as_array().unwrap();
    assert_eq!([&events[0]["wall"], &events[1]["wall"]], ["lower", "upper"]);
    let table = fs::read_to_string(path.join("a/derivatives.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    assert!(lines[0].starts_with("wall,kind,phase_cycles,speed_m_per_s,phase_by_wall_upper_restitution_cycles,"));
    assert_eq!(lines.len(), 3);
    let speed = &events[1]["numbers"][1];
    assert_eq!(lines[2].split(',').nth(5).unwrap().parse::<f64>().unwrap(), speed["derivative"][0]);
    assert_eq!(fs::read_to_string(path.join("a/multipliers.csv")).unwrap().lines().count(), 3);
    // The orbits on both sides, whose difference errs by the square of 1e-4.
    fs::write(path.join("whole.json"), whole(&json(&path.join("a/orbit.json"))).to_string()).unwrap();
    let [less, more] = ["0.7999", "0.8001"].map(|e| {
        let near = ["--set", &format!("wall.upper.restitution={e}"), "--from", "whole.json", "--out", e];
        said(path, &[&["orbit"], &SOFT[..], &near].concat(), 0);
        json(&path.join(e).join("orbit.json"))
    });
    for (index, event) in events.iter().enumerate() {
        let speed = |orbit: &Value| orbit["events"][index]["speed_m_per_s"].as_f64().unwrap();
        let by = event["numbers"][1]["derivative"][0].as_f64().unwrap();
        let difference = (speed(&more) - speed(&less)) / 2e-4;
        assert!((difference - by).abs() < 1e-3 * by.abs(), "{difference} {by}");
    }
    // Of a structure: load and gap larger by one share make the same orbit larger by it.
    let set = ["orbit", "two-masses", "--set", "load.1.harmonic.amplitude=60", "--out", "c"];
    let keys = ["--derivative", "load.1.harmonic.amplitude,wall.stop.position"];
    said(path, &[&set[..], &keys].concat(), 0);
    let found = &json(&path.join("c/orbit.json"))["derivatives"];
    assert_eq!(found["events"].as_array().unwrap().len(), 2);
    for number in found["events"].as_array().unwrap().iter().flat_map(|event| event["numbers"].as_array().unwrap()) {
        let by = |key: usize| number["derivative"][key].as_f64().unwrap();
        let (together, value) = (60.0 * by(0) + 5e-3 * by(1), number["value"].as_f64().unwrap());
        let expected = if number["name"] == "phase" { 0.0 } else { value };
        assert!((together - expected).abs() < 1e-8 * value.abs(), "{number}");
    }
    for (more, words) in [
        ("time.step", "--derivative is time.step; expected a key on which orbits depend"),
        ("initial.velocity", "--derivative is initial.velocity; expected a key on which orbits depend"),
        ("wall.upper.restitution,wall.upper.restitution", "for the second time"),
        ("wall.side.restitution", "no wall is named \"side\""),
    ] {
        let (_, err) = said(path, &[&["orbit"], &SOFT[..], &["--derivative", more]].concat(), 2);
        assert!(err.contains(words), "{more}: {err}");
    }
}

/// The document of an orbit that is its own mirror image, by the events of both halves.
fn whole(half: &Value) -> Value {
    let mut whole = half.clone();
    whole["symmetric"] = false.into();
    let mut mirrored = half["events"][0].clone();
    mirrored["wall"] = if mirrored["wall"] == "lower" { "upper" } else { "lower" }.into();
    mirrored["phase_cycles"] = (mirrored["phase_cycles"].as_f64().unwrap() + 0.5).into();
    whole["events"].as_array_mut().unwrap().push(mirrored);
    whole
}

#[test]
fn an_orbit_is_written_and_read_back() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let (out, _) = said(path, &[&["orbit"], &SOFT[..], &["--out", "a"]].concat(), 0);
    assert!(out.contains("its mirror image") && out.contains("stable") && out.contains("the same events"), "{out}");
    let first = json(&path.join("a/orbit.json"));
    assert_eq!((&first["periods"], &first["symmetric"]), (&Value::from(1), &Value::from(true)));
    let speed = |orbit: &Value| orbit["events"][0]["speed_m_per_s"].as_f64().unwrap();
    assert!((speed(&first) - 0.169_410_591_358_373_47).abs() < 1e-12);
    for file in ["orbit.csv", "phase.svg", "motion.svg", "request.json"] {
        assert!(path.join("a").join(file).is_file(), "{file}");
    }
    let table = fs::read_to_string(path.join("a/orbit.csv")).unwrap();
    let header = "time_s,phase_cycles,displacement_m,velocity_m_per_s,contact_force_upper_N,contact_force_lower_N";
    assert!(table.starts_with(header) && table.lines().count() > 2000);
    // The same orbit from the file, and a neighbouring case from it.
    said(path, &[&["orbit"], &SOFT[..], &["--from", "a/orbit.json", "--out", "b"]].concat(), 0);
    assert!((speed(&json(&path.join("b/orbit.json"))) - speed(&first)).abs() < 1e-12);
    let near = ["--set", "load.1.harmonic.frequency=5.05", "--from", "a/orbit.json", "--out", "c"];
    said(path, &[&["orbit"], &SOFT[..], &near].concat(), 0);
    assert!((speed(&json(&path.join("c/orbit.json"))) - speed(&first)).abs() > 1e-4);
    // The twin, from a start by hand.
    let twin = ["--signature", "U", "--symmetric", "--start", "0.743,0.033", "--out", "d"];
    let (out, _) = said(path, &[&["orbit"], &SOFT[..], &twin].concat(), 0);
    assert!(out.contains("unstable"), "{out}");
    let listed = said(path, &[&["orbit", "--json", "--list"], &SOFT[..]].concat(), 0).0;
    let listed: Value = serde_json::from_str(&listed).unwrap();
    let twins = listed["orbits"].as_array().unwrap().iter().filter(|orbit| orbit["admissible"] == true);
    assert!(twins.count() >= 2);
}

#[test]
fn an_orbit_that_no_body_can_follow_is_written_and_fails() {
    let dir = tempfile::tempdir().unwrap();
    let listed = said(dir.path(), &[&["orbit", "--json", "--list"], &SOFT[..]].concat(), 0).0;
    let listed: Value = serde_json::from_str(&listed).unwrap();
    let virtually = listed["orbits"].as_array().unwrap().iter().find(|orbit| orbit["admissible"] == false).unwrap();
    let start = format!("{},{}", virtually["phase_cycles"], virtually["speed_m_per_s"]);
    let (wall, periods) = (virtually["wall"].as_str().unwrap(), virtually["periods"].to_string());
    let mut args = [&["orbit"], &SOFT[..], &["--signature", wall, "--start", &start, "--periods", &periods]].concat();
    if virtually["symmetric"] == true {
        args.push("--symmetric");
    }
    let (_, err) = said(dir.path(), &args, 1);
    assert!(err.contains("through wall"), "{err}");
    assert_eq!(json(&dir.path().join("out/rigid-walls-sine/orbit/orbit.json"))["admissible"], false);
}

#[test]
fn a_structure_settles_on_an_orbit() {
    let dir = tempfile::tempdir().unwrap();
    let case = "title = \"two\"\n[system.chain]\nmasses = [1.0, 0.5]\nsprings = [60.0]\n\
        left = { stiffness = 80.0 }\nright = { stiffness = 20.0 }\n\
        [system.damping]\nrayleigh = { mass = 0.3, stiffness = 2e-3 }\n[[wall]]\n\
        name = \"stop\"\nside = \"upper\"\nposition = 5e-3\n\
        restitution = 0.6\nat = { dof = 0 }\n[[load]]\n\
        harmonic = { amplitude = 2.0, frequency = 1.9 }\nat = { dof = 0 }\n\
        [[probe]]\nname = \"first\"\nat = { dof = 0 }\n[time]\nend = 1.0\nstep = 1e-4\n";
    fs::write(dir.path().join("two.toml"), case).unwrap();
    let (out, _) = said(dir.path(), &["orbit", "two.toml"], 0);
    assert!(out.contains("of 4 Floquet multipliers") && out.contains("stop"), "{out}");
    let (out, _) = said(dir.path(), &["orbit", "two.toml", "--list"], 0);
    // The one on which it settles is admissible, those of several periods pass the stop.
    let rows: Vec<&str> = out.lines().filter(|line| line.starts_with("stop")).collect();
    let admissible = |row: &str| row.trim_end().ends_with("yes");
    assert!(rows.len() > 3 && admissible(rows[0]) && rows[0].contains("stable"), "{out}");
    assert!(rows[1..].iter().all(|row| row.contains("no, passes a wall") || admissible(row)), "{out}");
    assert!(rows.iter().any(|row| row.contains("no, passes a wall")), "{out}");
    // The orbit is written and read back, also for a neighbouring case.
    let path = dir.path();
    let written = path.join("out/two/orbit/orbit.json");
    let first = json(&written);
    assert_eq!((&first["signature"], &first["events"][0]["kind"]), (&Value::from("S"), &Value::from("impact")));
    let from = written.to_str().unwrap();
    said(path, &["orbit", "two.toml", "--from", from, "--out", "again"], 0);
    let again = json(&path.join("again/orbit.json"));
    let speed = |orbit: &Value| orbit["events"][0]["speed_m_per_s"].as_f64().unwrap();
    assert!((speed(&first) - speed(&again)).abs() < 1e-10);
    said(path, &["orbit", "two.toml", "--set", "load.1.harmonic.frequency=1.91", "--from", from, "--out", "near"], 0);
    let near = json(&path.join("near/orbit.json"));
    assert!((speed(&first) - speed(&near)).abs() > 1e-5 && near["closure"].as_f64().unwrap() < 1e-10);
    fs::write(path.join("no.json"), "{}").unwrap();
    fs::write(path.join("modal.json"), r#"{"periods": 1, "coordinates": "modal"}"#).unwrap();
    let short = r#"{"periods": 1, "coordinates": "degrees of freedom", "forcing_period_s": 0.5, "time_s": 0.1,
        "displacement_m": [1e-3], "velocity_m_per_s": [0.0]}"#;
    fs::write(path.join("short.json"), short).unwrap();
    for (more, words) in [
        (&["--signature", "S", "--start", "0.1,0.1"][..], "one degree of freedom"),
        (&["--from", "two.toml"], "not valid JSON"),
        (&["--from", "no.json"], "periods"),
        (&["--from", "modal.json"], "those of the case: degrees of freedom"),
        (&["--from", "short.json"], "2 of each"),
    ] {
        let (_, err) = said(path, &[&["orbit", "two.toml"], more, &["--out", "refused"]].concat(), 2);
        assert!(err.contains(words), "{more:?}: {err}");
    }
}

#[test]
fn branches_of_a_structure_are_written() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let key = ["continue", "two-masses", "--key", "load.1.harmonic.frequency", "--range", "1.75:2.3"];
    let (out, _) = said(path, &[&key[..], &["--switch", "no", "--out", "b"]].concat(), 0);
    for words in ["grazing-in at stop", "neimark-sacker", "1.937599199", "period-doubling"] {
        assert!(out.contains(words), "{words}: {out}");
    }
    let graph = json(&path.join("b/branches.json"));
    assert_eq!((&graph["place"], &graph["walls"][0]["position_m"]), (&Value::from("stop"), &Value::from(5e-3)));
    let grazes = graph["specials"].as_array().unwrap().iter().filter(|special| special["label"] == "grazing-in");
    assert!(grazes.clone().count() >= 2 && grazes.clone().all(|special| special["wall"] == "stop"));
    let table = fs::read_to_string(path.join("b/branches.csv")).unwrap();
    // The document counts the points of the table, special ones among them.
    for branch in graph["branches"].as_array().unwrap() {
        let begins = format!("{},", branch["branch"]);
        assert_eq!(branch["points"], table.lines().filter(|line| line.starts_with(&begins)).count());
    }
    let header = table.lines().next().unwrap();
    assert!(header.contains("multiplier_4_im") && !header.contains("multiplier_5"), "{header}");
    let motion = fs::read_to_string(path.join("b/orbits.csv")).unwrap();
    assert!(motion.lines().count() > 1000 && motion.lines().skip(1).all(|line| line.split(',').count() == 5));
    // The motion of each orbit comes back, to the digits that are written.
    let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = motion.lines().skip(1).map(row).collect();
    for orbit in rows.chunk_by(|a, b| a[..2] == b[..2]) {
        let (first, last) = (&orbit[0], &orbit[orbit.len() - 1]);
        let turn = last[2] - first[2];
        assert!((turn - turn.round()).abs() < 2e-6 && turn > 0.5, "{first:?} {last:?}");
        assert!((first[3] - last[3]).abs() < 1e-7, "{first:?} {last:?}");
    }
    for file in ["branches.svg", "special.csv", "report.html"] {
        assert!(path.join("b").join(file).is_file(), "{file}");
    }
    // From a file, and the same twice.
    said(path, &["orbit", "two-masses", "--set", "load.1.harmonic.frequency=2.3", "--out", "o"], 0);
    let from = ["--set", "load.1.harmonic.frequency=2.3", "--from", "o/orbit.json", "--switch", "no"];
    let range = ["continue", "two-masses", "--key", "load.1.harmonic.frequency", "--range", "2.2:2.4"];
    for out in ["c", "d"] {
        said(path, &[&range[..], &from, &["--out", out]].concat(), 0);
    }
    for file in ["branches.csv", "special.csv", "branches.json", "orbits.csv", "branches.svg"] {
        let [c, d] = ["c", "d"].map(|out| fs::read(path.join(out).join(file)).unwrap());
        assert!(c == d, "{file}");
    }
    // What is refused, by name.
    for (args, words) in [
        (&["--second", "wall.stop.restitution", "--second-range", "0.5:0.8"][..], "one degree of freedom"),
        (&["--from", "b/branches.json"], "periods"),
    ] {
        let (_, err) = said(path, &[&key[..], args, &["--out", "e"]].concat(), 2);
        assert!(err.contains(words), "{args:?}: {err}");
    }
    let modal = ["continue", "tube-loose-supports", "--key", "system.damping.ratio", "--range", "0.001:0.1"];
    let (_, err) = said(path, &modal, 2);
    assert!(err.contains("a key outside of [system]"), "{err}");
    assert!(!path.join("e").exists());
}

#[test]
fn branches_are_written_and_joined() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let key = ["--key", "load.1.harmonic.frequency"];
    let sweep =
        ["--vary", "load.1.harmonic.frequency=4.4:6:9", "--samples", "impacts", "--settle", "100", "--keep", "20"];
    said(path, &[&["sweep"], &SOFT[..], &sweep, &["--scheme", "event", "--out", "s"]].concat(), 0);
    let more = ["--range", "4:16", "--switch", "all", "--depth", "1", "--over", "s/sweep.csv", "--out", "b"];
    let (out, _) = said(path, &[&["continue"], &SOFT[..], &key, &more].concat(), 0);
    for words in ["fold", "symmetry-breaking", "grazing-out", "14.610019877", "4.570839133", "4.210773813"] {
        assert!(out.contains(words), "{words}: {out}");
    }
    // The points beneath are the impacts of the sweep's rows.
    let lines = |file: &str| fs::read_to_string(path.join(file)).unwrap().lines().count();
    assert!(lines("b/beneath.csv") > 100 && lines("b/beneath.csv") == lines("s/samples.csv"));
    let graph = json(&path.join("b/branches.json"));
    assert!(graph["branches"].as_array().unwrap().len() >= 3);
    let leads = |label: &str| {
        let all = graph["specials"].as_array().unwrap();
        all.iter().find(|special| special["label"] == label).unwrap()["leads_to"].as_array().unwrap().len()
    };
    assert_eq!((leads("fold"), leads("symmetry-breaking"), leads("grazing-out")), (0, 1, 1));
    let table = fs::read_to_string(path.join("b/branches.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(header.starts_with("branch,point,frequency_Hz,period,symmetric,signature,label,stable"), "{header}");
    // Points are numbered without a gap, and special points stand where they were passed.
    let mut last = (0, 0);
    for line in table.lines().skip(1) {
        let number = |index: usize| line.split(',').nth(index).unwrap().parse::<i32>().unwrap();
        let now = (number(0), number(1));
        assert!(now == (last.0, last.1 + 1) || now == (last.0 + 1, 1), "{line}");
        last = now;
    }
    assert_eq!(table.matches("fold").count(), 1);
    // So can be a folder: the sweep, other branches, a run and an orbit at the case's frequency.
    let run = ["run", CASE, "--set", "wall.*.restitution=0.8", "--end", "2", "--no-verdict", "--out", "r"];
    said(path, &run, 0);
    said(path, &[&["orbit"], &SOFT[..], &["--out", "o"]].concat(), 0);
    let points = |over: &str| {
        let more = ["--range", "4.9:5.1", "--over", over, "--out", "over", "--force"];
        said(path, &[&["continue"], &SOFT[..], &key, &more].concat(), 0);
        let text = fs::read_to_string(path.join("over/beneath.csv")).unwrap();
        let pair = |line: &str| line.split(',').map(|cell| cell.parse().unwrap()).collect::<Vec<f64>>();
        text.lines().skip(1).map(pair).collect::<Vec<_>>()
    };
    assert_eq!(points("s").len() + 1, lines("s/samples.csv"));
    // All events of these branches are impacts: as many as there are speeds.
    let speeds: Vec<usize> =
        header.split(',').enumerate().filter(|(_, name)| name.starts_with("speed_")).map(|(index, _)| index).collect();
    let told = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        speeds.iter().filter(|index| !cells[**index].is_empty()).count()
    };
    let impacts: usize = table.lines().skip(1).map(told).sum();
    assert_eq!(points("b").len(), impacts);
    let orbit = points("o");
    assert!(orbit.len() == 2 && orbit.iter().all(|point| (point[0] - 5.0).abs() < 1e-12), "{orbit:?}");
    let run = points("r");
    assert_eq!(run.len() + 1, lines("r/contacts.csv"));
    // Of a comparison the exact motion.
    let compare = ["compare", CASE, "--set", "wall.*.restitution=0.8", "--end", "2", "--no-verdict", "--out", "c"];
    said(path, &[&compare[..], &["--schemes", "moreau-jean"]].concat(), 0);
    assert_eq!(points("c").len() + 1, lines("c/event/contacts.csv"));
    // The run settles on the orbit.
    assert!(run.iter().all(|point| point[0] == 5.0) && (run.last().unwrap()[1] - orbit[0][1]).abs() < 1e-2, "{run:?}");
    let second =
        ["--second", "wall.*.restitution", "--second-range", "0.7:0.9", "--locus", "grazing-out", "--out", "l"];
    let (out, _) =
        said(path, &[&["continue"], &SOFT[..], &key, &["--range", "4.1:16", "--switch", "no"], &second].concat(), 0);
    assert!(out.contains("locus 1 of grazing-out"), "{out}");
    assert!(
        fs::read_to_string(path.join("l/loci.csv")).unwrap().starts_with("locus,label,point,frequency_Hz,restitution")
    );
    // Where no special point has a locus, that is said.
    let none = ["--second", "wall.*.restitution", "--second-range", "0.7:0.9", "--out", "n"];
    let (_, err) =
        said(path, &[&["continue"], &SOFT[..], &key, &["--range", "4.9:5", "--switch", "no"], &none].concat(), 0);
    assert!(err.contains("no special point was found whose locus can be followed (fold, "), "{err}");
    let picture = fs::read_to_string(path.join("b/branches.svg")).unwrap();
    assert!(picture.contains("stroke-dasharray") && picture.contains("symmetry-breaking"));
}

#[test]
fn wrong_requests_say_what_would_be_accepted() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("no.json"), "{").unwrap();
    fs::write(
        path.join("other.json"),
        r#"{"periods": 1, "symmetric": false, "forcing_period_s": 0.2, "events": [{"wall": "side"}]}"#,
    )
    .unwrap();
    let wall = r#"{"periods": 1, "symmetric": false, "forcing_period_s": 0.2,
        "events": [{"wall": "side", "kind": "impact", "phase_cycles": 0.1, "speed_m_per_s": 0.1}]}"#;
    fs::write(path.join("wall.json"), wall).unwrap();
    let orbit: [(&[&str], &str); 12] = [
        (&["--signature", "UL"], "--start"),
        (&["--start", "0.1,0.2"], "--signature"),
        (&["--signature", "UL", "--start", "0.1,0.2"], "4: phase and speed of each of 2 events"),
        (&["--signature", "UX", "--start", "0.1,0.2"], "no wall is named \"UX\""),
        (&["--signature", "U", "--start", "0.1,x"], "invalid"),
        (&["--signature", "U", "--start", "0.1,0.1", "--periods", "0"], "1 to 64"),
        (&["--signature", "U", "--start", "0.1,0.1", "--periods", "2", "--symmetric"], "odd number"),
        (&["--signature", "upper:enter", "--start", "0.1,0.1"], "which is rigid"),
        (&["--from", "none.json"], "none.json"),
        (&["--from", "no.json"], "not valid JSON"),
        (&["--from", "other.json"], "entry 1, wall and kind"),
        (&["--from", "wall.json"], "no wall is named \"side\""),
    ];
    for (more, words) in orbit {
        let (_, err) = said(path, &[&["orbit"], &SOFT[..], more].concat(), 2);
        assert!(err.contains(words), "{more:?} does not say {words}: {err}");
    }
    let frequency = "load.1.harmonic.frequency";
    let branch: [(&[&str], &str); 16] = [
        (&["--key", frequency, "--range", "4:6", "--second", "system.oscillator.mass"], "--second-range"),
        (&["--key", frequency, "--range", "4:6", "--second", frequency, "--second-range", "4:6"], "a key other than"),
        // No orbit changes with these.
        (&["--key", "time.end", "--range", "1:9"], "--key is time.end; expected a key on which orbits depend"),
        (
            &["--key", frequency, "--range", "4:6", "--second", "initial.velocity", "--second-range", "0:1"],
            "--second is initial.velocity",
        ),
        (
            &["--key", frequency, "--range", "4:6", "--second", "system.oscillator.mass", "--second-range", "2:3"],
            "the case's value of the key, 1.0, in it",
        ),
        (
            &["--key", frequency, "--range", "4:6", "--second", "system.oscillator.mass", "--second-range", "3:2"],
            "--second-range is \"3:2\"",
        ),
        (&["--key", frequency, "--range", "4:6", "--second", "title", "--second-range", "2:3"], "--second is title"),
        (&["--key", frequency], "--range"),
        (&["--key", frequency, "--range", "5"], "A:B"),
        (&["--key", frequency, "--range", "6:5"], "the first below the second"),
        (&["--key", frequency, "--range", "nan:5"], "A:B"),
        (&["--key", frequency, "--range", "6:7"], "the case's value of the key, 5.0, in it"),
        (&["--key", "load.1.harmonic.frequenzy", "--range", "4:6"], "did you mean"),
        (&["--key", "title", "--range", "4:6"], "title"),
        (&["--key", frequency, "--range", "4:6", "--switch", "some"], "some"),
        (&["--key", frequency, "--range", "4:6", "--over", "none.csv"], "none.csv"),
    ];
    for (more, words) in branch {
        let (_, err) = said(path, &[&["continue"], &SOFT[..], more].concat(), 2);
        assert!(err.contains(words), "{more:?} does not say {words}: {err}");
    }
    // Nothing was written.
    assert!(!path.join("out").exists() || fs::read_dir(path.join("out/rigid-walls-sine")).unwrap().count() == 0);
    // A motion that does not repeat itself: the reason, and exit code 1.
    let (_, err) = said(path, &["orbit", CASE, "--settle", "20"], 1);
    assert!(err.contains("do not repeat themselves within 32 forcing periods after 20"), "{err}");
}

/// One stop at the place of rest: no gap, and a motion of some millimetres.
const ONE_STOP: &str = r#"
[system.oscillator]
mass = 1.0
damping = 0.2
stiffness = 100.0
[[wall]]
name = "stop"
side = "upper"
position = 0.0
restitution = 0.5
[[load]]
harmonic = { amplitude = 3.0, frequency = 5.0 }
[time]
end = 5.0
step = 1e-3
"#;

#[test]
fn a_motion_without_a_gap_is_measured_by_its_own_size() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("stop.toml"), ONE_STOP).unwrap();
    let orbit = ["orbit", "stop.toml", "--restitution", "0.8", "--settle", "200"];
    let (out, _) = said(dir.path(), &orbit, 0);
    assert!(out.contains(" of max |u|, the same events") && !out.contains("gap"), "{out}");
    // Chaos within a millimetre of an unstable orbit is not settled on it.
    let chaos = ["--set", "load.1.harmonic.frequency=4.8", "--out", "chaos"];
    let (_, err) = said(dir.path(), &[&orbit[..], &chaos].concat(), 1);
    assert!(err.contains("do not repeat themselves"), "{err}");
}

/// One degree of freedom that never leaves its pad.
const PRESSED: &str = r#"
[system.oscillator]
mass = 1.0
damping = 0.5
stiffness = 100.0
[[wall]]
name = "pad"
side = "upper"
position = -1e-3
stiffness = 300.0
[[load]]
harmonic = { amplitude = 0.05, frequency = 2.0 }
[time]
end = 5.0
step = 1e-3
"#;

#[test]
fn a_motion_that_never_leaves_its_wall_is_found_and_followed_by_its_state() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("pressed.toml"), PRESSED).unwrap();
    let (out, _) = said(path, &["orbit", "pressed.toml", "--out", "a"], 0);
    assert!(out.contains("always") && out.contains("stable"), "{out}");
    let orbit = json(&path.join("a/orbit.json"));
    // m q̈ + c q̇ + (K + k) q = f − k g: the multipliers are exp(λT) of this linear system, and the
    // pad's mean force is k K |g|/(K + k) = 0.075 N.
    let omega = (400.0_f64 - 0.25 * 0.25).sqrt();
    let (size, angle) = ((-0.25 * 0.5_f64).exp(), 0.5 * omega);
    let multiplier = |part: usize| orbit["multipliers"][0][part].as_f64().unwrap();
    assert!((multiplier(0) - size * angle.cos()).abs() < 1e-9, "{orbit}");
    assert!((multiplier(1).abs() - (size * angle.sin()).abs()).abs() < 1e-9, "{orbit}");
    let impulse = orbit["walls"][0]["impulse_n_s"].as_f64().unwrap();
    assert!((impulse + 0.075 * 0.5).abs() < 1e-12, "{orbit}");
    // From its file it is found again, and followed to where the pad opens: there the amplitude of
    // the pad's force is its mean.
    said(path, &["orbit", "pressed.toml", "--from", "a/orbit.json", "--out", "b"], 0);
    let key = ["--key", "load.1.harmonic.amplitude", "--range", "0.03:0.08"];
    for (from, out) in [(&[][..], "c"), (&["--from", "a/orbit.json"], "d")] {
        let (told, _) =
            said(path, &[&["continue", "pressed.toml", "--switch", "no", "--out", out], &key[..], from].concat(), 0);
        assert!(told.contains("pad:always") && !told.contains("no contact"), "{told}");
        let pulsation = 4.0 * std::f64::consts::PI;
        let opens = 0.075 * (400.0 - pulsation * pulsation).hypot(0.5 * pulsation) / 300.0;
        let graph = json(&path.join(out).join("branches.json"));
        let special = graph["specials"][0]["value"].as_f64().unwrap();
        assert!((special - opens).abs() < 1e-9, "{special} for {opens}");
    }
    // Each kind of file is refused by name where it does not fit.
    let events = ["orbit", "pressed.toml", "--signature", "pad:always", "--start", "0.1,0.0", "--out", "e"];
    let (_, err) = said(path, &events, 2);
    assert!(err.contains("always at wall \"pad\"") && err.contains("by its state"), "{err}");
    said(path, &[&["orbit"], &SOFT[..], &["--out", "f"]].concat(), 0);
    let (_, err) = said(path, &["orbit", "two-masses", "--from", "f/orbit.json", "--out", "g"], 2);
    assert!(err.contains("f/orbit.json") && err.contains("by its events"), "{err}");
}
