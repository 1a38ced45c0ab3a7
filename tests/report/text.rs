//! The report: what it holds, that no text of a case becomes markup, and that it is written whole
//! or not at all.
use crate::command::said;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// The text between two marks, each of which must be there once.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.split_once(from).unwrap().1.split_once(to).unwrap().0
}

pub(crate) fn data(page: &str) -> Value {
    serde_json::from_str(between(page, r#"<script type="application/json" id="data">"#, "</script>")).unwrap()
}

/// The bytes of a base64 text, decoded apart from the encoder under test.
fn bytes(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("{other} is no digit"),
    };
    let mut out = Vec::new();
    for four in text.as_bytes().chunks(4) {
        let digits: Vec<u32> = four.iter().filter(|c| **c != b'=').map(|c| u32::from(digit(*c))).collect();
        let bits = digits.iter().enumerate().fold(0, |bits, (i, d)| bits | d << (18 - 6 * i));
        out.extend(bits.to_be_bytes().get(1..digits.len()).unwrap());
    }
    out
}

fn singles(column: &Value) -> Vec<f32> {
    let bytes = bytes(column["f32"].as_str().unwrap());
    bytes.chunks_exact(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect()
}

fn doubles(column: &Value) -> Vec<f64> {
    let bytes = bytes(column["f64"].as_str().unwrap());
    bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).collect()
}

/// The column of a CSV file, by its index; empty cells are NaN.
fn column(path: &Path, index: usize) -> Vec<f64> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| line.split(',').nth(index).unwrap().parse().unwrap_or(f64::NAN)).collect()
}

const CASE: &str = "rigid-walls-sine";

/// A stretch of a branch of the source oscillator, with the symmetry breaking at 4.57 Hz in it.
const SOFT: [&str; 7] =
    [CASE, "--set", "wall.*.restitution=0.8", "--key", "load.1.harmonic.frequency", "--range", "4.4:5.5"];

#[test]
fn the_page_of_a_run_holds_its_rows_and_contacts() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["run", CASE, "--end", "1", "--no-verdict", "--out", "o"], 0);
    let folder = dir.path().join("o");
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    let data = data(&page);
    let run = &data["runs"][0];
    let displacement = column(&folder.join("trajectory.csv"), 1);
    let rounded: Vec<f32> = displacement.iter().map(|x| *x as f32).collect();
    assert_eq!(singles(&run["probes"][0]["q"]), rounded);
    assert_eq!(run["rows"], displacement.len());
    let starts = doubles(&run["contacts"]["start"]);
    assert_eq!(starts, column(&folder.join("contacts.csv"), 1));
    assert!(starts.len() > 5);
    assert_eq!(data["command"], "signorini run rigid-walls-sine --end 1 --no-verdict --out o");
    assert_eq!(data["title"], "Two rigid walls, 5 Hz sine");
    assert!(data["case"].as_str().unwrap().contains("stiffness = 100.0"));
    assert_eq!(data["summary"]["scheme"], "located");
    let cards = data["cards"].as_array().unwrap();
    let states: Vec<_> =
        cards.iter().map(|card| (card["title"].as_str().unwrap(), card["state"].as_str().unwrap())).collect();
    let expected = [("Refinement", "open"), ("Contact conditions", "good"), ("Energy", "good"), ("Momentum", "good")];
    assert_eq!(states, expected);
    // Listed, so that a later request takes it away.
    let manifest = fs::read_to_string(folder.join("request.json")).unwrap();
    assert!(manifest.contains("\"report.html\""));
}

/// Of contacts shorter than the rows each has its peak in the drawing, with the sign of its
/// impulse.
#[test]
fn no_pulse_of_a_spring_is_lost_between_rows() {
    let dir = tempfile::tempdir().unwrap();
    let penalty = ["--scheme", "penalty", "--epsilon", "1e-12", "--end", "0.5", "--no-verdict", "--out", "o"];
    said(dir.path(), &[&["run", CASE][..], &penalty].concat(), 0);
    let folder = dir.path().join("o");
    let page = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    let drawn: Vec<(f64, f32)> = page["runs"][0]["forces"].as_array().unwrap().iter().fold(Vec::new(), |all, force| {
        [all, doubles(&force["time"]).into_iter().zip(singles(&force["force"])).collect()].concat()
    });
    let of = |index: usize| column(&folder.join("contacts.csv"), index);
    let (start, end, impulse, peak) = (of(1), of(2), of(3), of(4));
    assert!(peak.len() >= 6, "{peak:?}");
    for k in 0..peak.len() {
        let top = peak[k].copysign(impulse[k]) as f32;
        let within = |t: f64| t > start[k] && t < end[k];
        assert!(drawn.iter().any(|(t, f)| within(*t) && *f == top), "{top} N at {} s: {drawn:?}", start[k]);
    }
}

/// Contacts in round supports are contacts: a page that counts those of flat walls alone says 0.
#[test]
fn contacts_in_round_supports_are_counted() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["run", "tube-round-supports", "--end", "0.05", "--no-verdict", "--out", "o"], 0);
    let folder = dir.path().join("o");
    let data = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    let contacts = column(&folder.join("contacts.csv"), 1).len();
    let facts = data["facts"].as_array().unwrap();
    let fact = |label: &str| facts.iter().find(|fact| fact["label"] == label).unwrap()["value"].as_str().unwrap();
    assert!(contacts > 5 && fact("contacts") == contacts.to_string(), "{facts:?}");
    let walls = data["summary"]["statistics"]["walls"].as_array().unwrap();
    let power: f64 = walls.iter().map(|wall| wall["impact_power_w"].as_f64().unwrap()).sum();
    // Figures of a page have three digits.
    let shown: f64 = fact("impact power").parse().unwrap();
    assert!(power > 0.0 && (shown - 1e3 * power).abs() < 5e-3 * 1e3 * power, "{shown} mW for {power} W");
}

/// The page names the SHA-256 of its script and its style, and nothing in it may be fetched.
#[test]
fn a_page_allows_its_own_script_and_no_connection() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["run", CASE, "--end", "0.2", "--no-verdict", "--out", "o"], 0);
    let page = fs::read_to_string(dir.path().join("o/report.html")).unwrap();
    let policy = between(&page, r#"http-equiv="Content-Security-Policy" content=""#, "\"");
    assert!(policy.starts_with("default-src 'none';"), "{policy}");
    for word in ["unsafe", "http", "*", "connect"] {
        assert!(!policy.contains(word), "{policy}");
    }
    // What a browser makes of the hashes is tested in one.
    assert_eq!(policy.matches("'sha256-").count(), 2);
    for mark in ["%DATA%", "%SCRIPT", "%STYLE", "%TITLE%", "%PROGRAM%"] {
        assert!(!page.contains(mark), "{mark}");
    }
    let code = page.replace("http://www.w3.org/2000/svg", "");
    let data = between(&page, r#"<script type="application/json" id="data">"#, "</script>");
    assert!(!code.replace(data, "").contains("://"), "the page must not refer to other places");
}

/// The numbers of a CSV file by the names of its columns.
fn named(path: &Path, name: &str) -> Vec<f64> {
    let text = fs::read_to_string(path).unwrap();
    let index = text.lines().next().unwrap().split(',').position(|own| own == name).unwrap();
    column(path, index)
}

/// The motion along an orbit is that of its events: it begins at the wall with e times the approach
/// speed, and comes back to the same wall with the approach speed. Newton's method has solved for
/// the speed; the file has six digits, and the period's end is 200 mm/s times its rounding off.
#[test]
fn the_page_of_branches_holds_their_orbits() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &[&["continue"], &SOFT[..], &["--out", "c"]].concat(), 0);
    let folder = dir.path().join("c");
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    let data = data(&page);
    let part = &data["continue"];
    let (phases, speeds) = (doubles(&part["events"]["phases"]), doubles(&part["events"]["speeds"]));
    let table = folder.join("branches.csv");
    let branches = named(&table, "branch");
    let first = named(&table, "speed_1_m_per_s");
    assert_eq!(part["points"]["rows"], branches.len());
    assert!(branches.len() > 20 && branches.contains(&2.0));
    let events = |branch: f64| part["branches"][branch as usize - 1]["events"].as_array().unwrap().len();
    let mut at = 0;
    for (branch, speed) in branches.iter().zip(&first) {
        assert_eq!(speeds[at], *speed);
        at += events(*branch);
    }
    assert_eq!((at, at), (speeds.len(), phases.len()));
    assert_eq!(part["branches"][0]["events"], serde_json::json!([{ "wall": "lower", "kind": "impact" }]));
    // Every orbit is drawn.
    let whole = |column: &Value| -> Vec<usize> {
        bytes(column["u32"].as_str().unwrap())
            .chunks_exact(4)
            .map(|four| u32::from_le_bytes(four.try_into().unwrap()) as usize)
            .collect()
    };
    let orbits = &part["orbits"];
    assert_eq!(whole(&orbits["row"]), (0..branches.len()).collect::<Vec<_>>());
    let (q, v) = (singles(&orbits["q"]), singles(&orbits["v"]));
    let begin = whole(&orbits["first"]);
    for (row, speed) in first.iter().enumerate() {
        let last = begin.get(row + 1).map_or(q.len(), |next| *next) - 1;
        let near = |x: f32, expected: f64| (f64::from(x) - expected).abs() <= 2e-5 * expected.abs();
        assert!(near(q[begin[row]], -5e-3) && near(v[begin[row]], 0.8 * speed), "{row}");
        assert!(near(q[last], -5e-3) && near(v[last], -speed), "{row}: {} {speed}", v[last]);
        // In between it goes to the other wall and no farther.
        let top = q[begin[row]..=last].iter().fold(0.0_f32, |top, q| top.max(*q));
        assert!(near(top, 5e-3), "{row}: {top}");
    }
    assert_eq!(
        part["walls"][1],
        serde_json::json!({ "name": "lower", "side": "lower", "position_m": -0.005, "rigid": true })
    );
    assert!(part["command"].as_str().unwrap().starts_with("signorini orbit rigid"));
    // Without a report nothing is written for it.
    said(dir.path(), &[&["continue"], &SOFT[..], &["--out", "n", "--no-report"]].concat(), 0);
    assert!(!dir.path().join("n/orbits.csv").exists() && !dir.path().join("n/report.html").exists());
    // The page can be made later, and says what it lacks.
    said(dir.path(), &["report", "n"], 0);
    let page = fs::read_to_string(dir.path().join("n/report.html")).unwrap();
    assert!(self::data(&page)["notes"].to_string().contains("no orbits.csv"));
}

/// A wall that the key moves has no one place.
#[test]
fn a_key_that_moves_a_wall_leaves_it_without_a_place() {
    let dir = tempfile::tempdir().unwrap();
    let key = ["--key", "wall.upper.position", "--range", "4.9e-3:5.1e-3", "--switch", "no", "--out", "c"];
    said(dir.path(), &[&["continue"], &SOFT[..3], &key].concat(), 0);
    let walls = data(&fs::read_to_string(dir.path().join("c/report.html")).unwrap())["continue"]["walls"].clone();
    assert!(walls[0]["position_m"].is_null() && walls[1]["position_m"] == -5e-3, "{walls}");
}

/// The contacts of an orbit are those of its events, the mirror half included, and the impulse of a
/// rigid impact is m (1 + e) v.
#[test]
fn the_page_of_an_orbit_holds_its_motion_and_contacts() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &[&["orbit"], &SOFT[..3], &["--out", "o"]].concat(), 0);
    let folder = dir.path().join("o");
    let data = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    let speed = data["summary"]["events"][0]["speed_m_per_s"].as_f64().unwrap();
    let phase = data["summary"]["events"][0]["phase_cycles"].as_f64().unwrap();
    let (starts, impulses) = (column(&folder.join("contacts.csv"), 1), column(&folder.join("contacts.csv"), 3));
    assert_eq!(impulses.len(), 2);
    for (start, impulse) in starts.iter().zip(&impulses) {
        // 1 kg; the exact scheme computes to some units in the last place.
        assert!((impulse.abs() - 1.8 * speed).abs() < 1e-12, "{impulse} {speed}");
        let cycles = (start / 0.2 - phase) * 2.0;
        assert!((cycles - cycles.round()).abs() < 1e-9, "{start}");
    }
    let motion = &data["orbit"]["motion"];
    let written: Vec<f32> = column(&folder.join("orbit.csv"), 2).iter().map(|x| *x as f32).collect();
    assert_eq!(singles(&motion["q"]), written);
    assert_eq!(motion["forces"], serde_json::json!([]));
    let states: Vec<_> = data["cards"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| (c["title"].as_str().unwrap(), c["state"].as_str().unwrap()))
        .collect();
    assert_eq!(states, [("Stability", "good"), ("Admissible", "good"), ("Free run", "good")]);
    assert!(data["case"].as_str().unwrap().contains("restitution = 0.8"));
    // The unstable twin.
    let twin = ["--signature", "U", "--symmetric", "--start", "0.743,0.033", "--out", "t"];
    said(dir.path(), &[&["orbit"], &SOFT[..3], &twin].concat(), 0);
    let page = self::data(&fs::read_to_string(dir.path().join("t/report.html")).unwrap());
    assert_eq!(page["cards"][0]["state"], "mind");
}

#[test]
fn text_of_a_case_never_becomes_markup() {
    let dir = tempfile::tempdir().unwrap();
    let evil = "</script><script>alert(1)</script><img src=x onerror=alert(2)><!-- \u{2028} ' &amp; \u{202e}";
    let case = format!(
        "title = \"{evil}\"\nsource = \"<b>%SCRIPT%</b>\"\n[system.oscillator]\nmass = 1.0\n\
         damping = 0.0\nstiffness = 100.0\n\
         [[wall]]\nname = \"upper\"\nside = \"upper\"\nposition = 1e-3\n[[load]]\n\
         harmonic = {{ amplitude = 3.0, frequency = 5.0 }}\n[time]\nend = 0.5\nstep = 1e-4\n"
    );
    fs::write(dir.path().join("evil.toml"), case).unwrap();
    for command in ["run", "compare"] {
        said(dir.path(), &[command, "evil.toml", "--no-verdict", "--out", command], 0);
        let page = fs::read_to_string(dir.path().join(command).join("report.html")).unwrap();
        assert_eq!(page.matches("</script").count(), 2, "{command}");
        assert_eq!(page.matches("<script").count(), 2, "{command}");
        assert_eq!(page.matches("<img").count() + page.matches("<!--").count() + page.matches("<b>").count(), 0);
        assert!(between(&page, "<title>", "</title>").starts_with("&lt;/script&gt;&lt;script&gt;"));
        assert_eq!(data(&page)["title"], evil, "{command}");
    }
    // Orbits, of a motion that comes to rest.
    let text = fs::read_to_string(dir.path().join("evil.toml")).unwrap();
    let case =
        text.replace("position = 1e-3", "position = 5e-3\nrestitution = 0.8").replace("damping = 0.0", "damping = 0.2");
    fs::write(dir.path().join("soft.toml"), case).unwrap();
    let over = ["--key", "load.1.harmonic.frequency", "--range", "4.9:5.1", "--switch", "no"];
    for args in [
        &["orbit", "soft.toml", "--out", "orbit"][..],
        &[&["continue", "soft.toml"], &over[..], &["--out", "continue"]].concat(),
    ] {
        said(dir.path(), args, 0);
        let page = fs::read_to_string(dir.path().join(args[0]).join("report.html")).unwrap();
        assert_eq!(page.matches("</script").count() + page.matches("<script").count(), 4, "{args:?}");
        assert_eq!(page.matches("<img").count() + page.matches("<!--").count() + page.matches("<b>").count(), 0);
        assert_eq!(data(&page)["title"], evil, "{args:?}");
    }
}

#[test]
fn a_report_of_existing_results_is_that_of_the_command() {
    let dir = tempfile::tempdir().unwrap();
    let requests: [&[&str]; 7] = [
        &["run", "chain-20", "--end", "0.3"],
        &["compare", CASE, "--end", "0.5"],
        &["chart", CASE, "--end", "0.4", "--schemes", "event,moreau-jean", "--steps", "1e-3:1e-4", "--levels", "2"],
        &["sweep", CASE, "--vary", "load.1.harmonic.frequency=4:5:3", "--measure", "contacts"],
        &["run", "tube-loose-supports", "--end", "0.02", "--no-verdict"],
        &["orbit", CASE, "--set", "wall.*.restitution=0.8"],
        &[&["continue"], &SOFT[..]].concat(),
    ];
    for (index, request) in requests.iter().enumerate() {
        let out = format!("o{index}");
        said(dir.path(), &[request, &["--out", &out][..]].concat(), 0);
        let written = fs::read(dir.path().join(&out).join("report.html")).unwrap();
        fs::remove_file(dir.path().join(&out).join("report.html")).unwrap();
        let told = said(dir.path(), &["report", &out], 0).1;
        assert!(told.contains("report.html"), "{told}");
        assert!(fs::read(dir.path().join(&out).join("report.html")).unwrap() == written, "{request:?}");
        said(dir.path(), &["report", &out, "--out", "elsewhere.html"], 0);
        assert!(fs::read(dir.path().join("elsewhere.html")).unwrap() == written, "{request:?}");
    }
}

/// The tube is drawn from its shape, and the shape does not enter what others read.
#[test]
fn a_structure_has_its_shape_beside_its_rows() {
    let dir = tempfile::tempdir().unwrap();
    let ask = |out: &str, more: &[&str]| {
        let args = ["run", "tube-loose-supports", "--end", "0.05", "--no-verdict", "--out", out];
        said(dir.path(), &[&args, more].concat(), 0);
        fs::read_to_string(dir.path().join(out).join("trajectory.csv")).unwrap()
    };
    assert_eq!(ask("with", &[]), ask("without", &["--no-report"]));
    assert!(!dir.path().join("without/report.html").exists() && !dir.path().join("without/shape.csv").exists());
    let page = fs::read_to_string(dir.path().join("with/report.html")).unwrap();
    let run = &data(&page)["runs"][0];
    let stations: Vec<f64> = run["shape"]["stations"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    // The supports, where the tube is watched too, and its pinned ends.
    let station = |x: f64| stations.iter().position(|other| (other - x).abs() < 1e-9).unwrap();
    let shape = dir.path().join("with/shape.csv");
    assert!(column(&shape, 1 + station(0.0)).iter().all(|u| *u == 0.0));
    let watched = column(&dir.path().join("with/trajectory.csv"), 1);
    let drawn = column(&shape, 1 + station(1.0));
    assert_eq!(watched.len(), drawn.len());
    // The file has six digits.
    assert!(watched.iter().zip(&drawn).all(|(a, b)| (a - b).abs() <= 1e-5 * a.abs()));
}

/// In two planes the shape has both, and its station at a support moves as the support's probes do.
#[test]
fn a_structure_in_two_planes_has_both_in_its_shape() {
    let dir = tempfile::tempdir().unwrap();
    for case in ["tube-round-supports", "tube-lattice-bars"] {
        let late = ["--end", "0.1", "--set", "time.statistics_from=0"];
        said(dir.path(), &[&["run", case, "--no-verdict", "--out", case], &late[..]].concat(), 0);
        let page = fs::read_to_string(dir.path().join(case).join("report.html")).unwrap();
        let page = data(&page);
        let shape = &page["runs"][0]["shape"];
        let stations: Vec<f64> = shape["stations"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
        assert_eq!(shape["planes"], 2);
        let supports = page["scene"]["supports"].as_array().unwrap();
        assert_eq!(supports.len(), 2);
        let rows = fs::read_to_string(dir.path().join(case).join("trajectory.csv")).unwrap();
        let header: Vec<&str> = rows.lines().next().unwrap().split(',').collect();
        for support in supports {
            let at = support["at"]["position"].as_f64().unwrap();
            let station = stations.iter().position(|other| (other - at).abs() < 1e-9).unwrap();
            for (plane, axis) in ["y", "z"].into_iter().enumerate() {
                let drawn = column(&dir.path().join(case).join("shape.csv"), 1 + plane * stations.len() + station);
                let name = format!("displacement_{}_{axis}_m", support["name"].as_str().unwrap().replace('-', "_"));
                let watched =
                    header.iter().position(|head| **head == name).unwrap_or_else(|| panic!("{name} {rows:.900}"));
                let watched = column(&dir.path().join(case).join("trajectory.csv"), watched);
                assert!(watched.iter().any(|u| *u != 0.0));
                // The file has six digits.
                assert!(watched.iter().zip(&drawn).all(|(a, b)| (a - b).abs() <= 1e-5 * a.abs()), "{case} {name}");
            }
            // The gap of 0.2 mm, and the corners of bars.
            let reach = support["reach"].as_f64().unwrap();
            let corner = if support["round"] == true { 1.0 } else { 1.45 };
            assert!((reach - corner * 0.2e-3).abs() < 1e-12, "{reach}");
            assert!(
                support["gaps"].as_array().unwrap().iter().all(|gap| (gap.as_f64().unwrap() - 0.2e-3).abs() < 1e-12)
            );
        }
    }
}

/// The page of a comparison draws the whole structure as its first method moves it.
#[test]
fn a_comparison_of_a_structure_has_its_shape() {
    let dir = tempfile::tempdir().unwrap();
    let ask = ["compare", "chain-20", "--schemes", "moreau-jean", "--end", "0.2", "--no-verdict", "--out"];
    said(dir.path(), &[&ask[..], &["with"]].concat(), 0);
    said(dir.path(), &[&ask[..], &["without", "--no-report"]].concat(), 0);
    let page = fs::read_to_string(dir.path().join("with/report.html")).unwrap();
    let page = data(&page);
    let drawn: Vec<bool> = page["runs"].as_array().unwrap().iter().map(|run| run["shape"].is_object()).collect();
    assert_eq!(drawn, [true, false]);
    assert_eq!(page["runs"][0]["shape"]["stations"].as_array().unwrap().len(), 20);
    let rows = |folder: &str| fs::read_to_string(dir.path().join(folder).join("moreau-jean/trajectory.csv")).unwrap();
    assert_eq!(rows("with"), rows("without"));
    assert!(!dir.path().join("without/moreau-jean/shape.csv").exists());
}

/// A row of a sweep whose own run was kept is named on the page that is made anew, and no other.
#[test]
fn the_page_of_a_sweep_knows_the_runs_kept_of_its_rows() {
    let dir = tempfile::tempdir().unwrap();
    let sweep = ["sweep", CASE, "--vary", "load.1.harmonic.frequency=4:5:3", "--measure", "contacts", "--out", "s"];
    said(dir.path(), &sweep, 0);
    let page = || fs::read_to_string(dir.path().join("s/report.html")).unwrap();
    assert_eq!(data(&page())["sweep"]["kept"], serde_json::json!([]));
    said(dir.path(), &["run", CASE, "--end", "0.1", "--no-verdict", "--out", "s/rows/2"], 0);
    for folder in ["s/rows/77", "s/rows/1", "s/rows/3", "s/rows/other"] {
        fs::create_dir_all(dir.path().join(folder)).unwrap();
    }
    for row in [3, 77] {
        fs::write(dir.path().join(format!("s/rows/{row}/report.html")), "").unwrap();
    }
    said(dir.path(), &["report", "s"], 0);
    assert_eq!(data(&page())["sweep"]["kept"], serde_json::json!([2]));
    // A case without a title stands under its name.
    let untitled = "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n\
                    [[wall]]\nname = \"stop\"\nside = \"both\"\ngap = 1e-3\n[time]\nend = 0.1\nstep = 1e-3\n";
    fs::write(dir.path().join("cart.toml"), untitled).unwrap();
    for request in [&["run"][..], &["sweep", "--vary", "wall.*.gap=1e-3,2e-3", "--measure", "contacts"]] {
        said(dir.path(), &[request, &["cart.toml", "--force", "--out", "s"]].concat(), 0);
        assert_eq!(data(&page())["title"], "cart", "{request:?}");
    }
}

#[test]
fn a_long_run_is_drawn_from_its_extremes_and_says_so() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["run", CASE, "--step", "5e-5", "--sample", "5e-5", "--no-verdict", "--out", "o"], 0);
    let page = fs::read_to_string(dir.path().join("o/report.html")).unwrap();
    let run = &data(&page)["runs"][0];
    let all = column(&dir.path().join("o/trajectory.csv"), 1);
    assert_eq!(all.len(), 200_001);
    let kept: Vec<usize> = bytes(run["kept"]["u32"].as_str().unwrap())
        .chunks_exact(4)
        .map(|four| u32::from_le_bytes(four.try_into().unwrap()) as usize)
        .collect();
    let drawn = singles(&run["probes"][0]["q"]);
    assert!(kept.len() == drawn.len() && kept.len() <= 100_002 && kept.windows(2).all(|pair| pair[0] < pair[1]));
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(f64::NEG_INFINITY, f64::max);
    let rounded = largest(&mut all.iter().map(|x| f64::from(*x as f32)));
    assert_eq!(largest(&mut drawn.iter().map(|x| f64::from(*x))), rounded);
    assert!(data(&page)["notes"].to_string().contains("of 200001 rows"));
    assert!(page.len() < 2_500_000, "{} bytes", page.len());
}

/// Makes the manifest in `folder` one of a version that recorded nothing of its tables and
/// documents, so that they are read as they are.
pub(crate) fn forget_records(folder: &Path) {
    let path = folder.join("request.json");
    let mut manifest: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    for records in ["tables", "documents"] {
        manifest.as_object_mut().unwrap().remove(records).unwrap();
    }
    fs::write(path, manifest.to_string()).unwrap();
}

#[test]
fn what_cannot_be_shown_is_one_clear_error() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("empty")).unwrap();
    for (folder, word) in [("empty", "request.json"), ("absent", "request.json")] {
        assert!(said(dir.path(), &["report", folder], 2).1.contains(word));
    }
    said(dir.path(), &["run", CASE, "--end", "0.2", "--no-verdict", "--out", "o"], 0);
    let folder = dir.path().join("o");
    forget_records(&folder);
    let before = fs::read(folder.join("report.html")).unwrap();
    let broken = |name: &str, text: &str, words: &[&str]| {
        let whole = fs::read(folder.join(name)).unwrap();
        fs::write(folder.join(name), text).unwrap();
        let told = said(dir.path(), &["report", "o"], 2).1;
        for word in words {
            assert!(told.contains(word), "{name}: {word}: {told}");
        }
        fs::write(folder.join(name), whole).unwrap();
        // The earlier report stays as it was.
        assert!(fs::read(folder.join("report.html")).unwrap() == before);
    };
    broken("trajectory.csv", "time_s,displacement_m\n0.0,nonsense\n", &["line 2", "displacement_m", "\"nonsense\""]);
    broken("trajectory.csv", "time_s,displacement_m\n0.0,1.0\n", &["2 columns", "each of the 2 walls"]);
    broken("trajectory.csv", "", &["trajectory.csv"]);
    broken("contacts.csv", "wall,start_s\nupper,0.1\n", &["contacts.csv", "has no column"]);
    broken("summary.json", "{", &["summary.json", "not valid JSON"]);
    broken("request.json", r#"{"request":{"command":"figures"},"files":[]}"#, &["\"figures\"", "no report"]);
    // A folder in place of a file.
    assert!(said(dir.path(), &["report", "o", "--out", "empty"], 2).1.contains("empty"));
    fs::remove_file(folder.join("contacts.csv")).unwrap();
    assert!(said(dir.path(), &["report", "o"], 2).1.contains("contacts.csv"));
}

/// A name in compare.csv must not lead out of the folder.
#[test]
fn a_comparison_reads_within_its_folder_only() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["compare", CASE, "--end", "0.2", "--no-verdict", "--out", "c"], 0);
    forget_records(&dir.path().join("c"));
    let table = dir.path().join("c/compare.csv");
    let text = fs::read_to_string(&table).unwrap();
    fs::write(&table, text.replacen("located,", "../c/event,", 1)).unwrap();
    assert!(said(dir.path(), &["report", "c"], 2).1.contains("not the name of a method"));
}

/// The curves of the page, in the light theme, are those of the SVG figures.
#[test]
fn curves_have_the_colours_of_the_figures() {
    use signorini::output::figure::{Curve, Figure, Panel};
    let css = include_str!("../../src/report/page/page.css");
    for n in 0..8 {
        let colour = css.split_once(&format!("--c{n}: ")).unwrap().1.split_once(';').unwrap().0;
        let panel = Panel::new("y").curve(Curve::new("a curve", [(0.0, 0.0), (1.0, 1.0)]).look(n));
        let svg = Figure::new("a figure", "x").panel(panel).to_svg();
        assert!(colour.starts_with('#') && svg.contains(&format!("\"{colour}\"")), "{n}: {colour}");
    }
}

/// The conclusion of a chart is that of its table: told in the terminal, in the JSON and on the
/// page.
#[test]
fn a_chart_says_what_one_percent_costs() {
    let dir = tempfile::tempdir().unwrap();
    let schemes = ["--schemes", "event,moreau-jean,penalty:epsilon=1e-9"];
    // A run may take as long as it likes: on a busy machine a coarse one may seem so slow that the
    // fine one would be left out.
    let every = ["--levels", "3", "--repeats", "1", "--longest", "100"];
    let chart = [&["chart", CASE, "--end", "0.5", "--out", "c"], &every[..], &schemes[..]];
    let told = said(dir.path(), &chart.concat(), 0).1;
    let page = fs::read_to_string(dir.path().join("c/report.html")).unwrap();
    let chart = &data(&page)["chart"];
    let conclusion = chart["conclusions"]["displacement_error_over_gap"].as_str().unwrap();
    assert!(told.lines().any(|line| line == conclusion), "{conclusion}: {told}");
    let rows = fs::read_to_string(dir.path().join("c/work-precision.csv")).unwrap();
    // The cheapest exact run is the only one.
    let event: f64 = rows.lines().nth(1).unwrap().split(',').nth(2).unwrap().parse().unwrap();
    let exact = chart["cheapest"].as_array().unwrap().iter().find(|row| row["kind"] == "exact").unwrap();
    assert_eq!(exact["seconds"].as_f64(), Some(event));
    // The picture says it too, and the floor of the penalty with its reason.
    let svg = fs::read_to_string(dir.path().join("c/work-precision.svg")).unwrap();
    assert!(svg.contains(&format!(">{conclusion}<")), "{conclusion}");
    let floor = &chart["floors"][0];
    let label = floor["displacement_error_over_gap"]["label"].as_str().unwrap();
    assert!(label.starts_with("ε = 1e-9: floor ") && svg.contains(&format!(">{label}<")), "{label}");
    let column = rows.lines().next().unwrap().split(',').position(|name| name == "modelling_error_over_gap").unwrap();
    let modelling = rows.lines().find(|row| row.starts_with("penalty")).unwrap().split(',').nth(column).unwrap();
    let at = floor["displacement_error_over_gap"]["at"].as_f64().unwrap();
    assert!((at / modelling.parse::<f64>().unwrap() - 1.0).abs() < 1e-12, "{at} {modelling}");
    // No step brings a penalty of 1e-9 to 1 %: it tends to its floor, rounded down to two digits.
    let least = conclusion.split_once("penalty tends to ").unwrap().1.split(' ').next().unwrap();
    let least = 1e-2 * least.parse::<f64>().unwrap();
    assert!(least <= at * (1.0 + 1e-12) && least > 0.9 * at, "{least} {at}");
    // The impulse has a conclusion and a floor of its own.
    let impulse = "impulse_error_of_the_worst_wall";
    assert!(chart["conclusions"][impulse].as_str().unwrap().starts_with("for 1 % of the impulse: "), "{chart}");
    let own = &floor[impulse];
    let share = format!("{} of the impulse", own["label"].as_str().unwrap().split_once("floor ").unwrap().1);
    assert!(own["reason"].as_str().unwrap().contains(&share), "{own}");
    let reason = floor["displacement_error_over_gap"]["reason"].as_str().unwrap();
    assert!(told.contains(reason) && reason.contains("its walls give way and"), "{reason}");
    // Made anew from the folder, the page is the same.
    said(dir.path(), &["report", "c"], 0);
    assert_eq!(fs::read_to_string(dir.path().join("c/report.html")).unwrap(), page);
}

/// Two runs, or two sweeps over one key, stand in the same figures; what does not go together is
/// refused.
#[test]
fn other_results_are_drawn_in_the_same_figures() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path();
    let sweep = ["sweep", CASE, "--scheme", "event", "--settle", "5", "--keep", "5", "--measure", "approach_speed_max"];
    for (e, rows) in [("0.7", "4:6:3"), ("0.8", "4:6:5")] {
        let set = format!("wall.*.restitution={e}");
        let vary = format!("load.1.harmonic.frequency={rows}");
        said(folder, &[&sweep[..], &["--set", &set, "--vary", &vary, "--out", &format!("s{e}")]].concat(), 0);
        said(folder, &["run", CASE, "--set", &set, "--end", "0.5", "--no-verdict", "--out", &format!("r{e}")], 0);
    }
    let page = |path: &str| data(&fs::read_to_string(folder.join(path)).unwrap());
    said(folder, &["report", "s0.7", "--over", "s0.8", "--out", "s.html"], 0);
    let over = &page("s.html")["sweep"]["over"];
    assert_eq!((&over["name"], &over["table"]["rows"]), (&"s0.8".into(), &5.into()), "{over}");
    assert_eq!(page("s.html")["sweep"]["table"]["rows"], 3);
    said(folder, &["report", "r0.7", "--over", "r0.8", "--out", "r.html"], 0);
    let runs = page("r.html")["runs"].clone();
    assert_eq!((runs.as_array().unwrap().len(), &runs[0]), (2, &page("r0.7/report.html")["runs"][0]));
    let own = page("r0.8/report.html")["runs"][0].clone();
    assert_eq!((&runs[1]["probes"], &runs[1]["contacts"]), (&own["probes"], &own["contacts"]));
    assert_eq!(runs[1]["label"], "located, r0.8");
    // The page within the folder is as before.
    assert_eq!(page("r0.7/report.html")["runs"].as_array().unwrap().len(), 1);
    // A comparison over a run, and a run over a comparison: all motions together.
    let schemes = ["--schemes", "located,penalty:epsilon=1e-9", "--no-verdict", "--end", "0.5"];
    said(folder, &[&["compare", CASE], &schemes[..], &["--out", "c"]].concat(), 0);
    said(folder, &["report", "r0.7", "--over", "c", "--out", "rc.html"], 0);
    said(folder, &["report", "c", "--over", "r0.7", "--out", "cr.html"], 0);
    let labels = |path: &str| -> Vec<String> {
        let runs = page(path)["runs"].clone();
        runs.as_array().unwrap().iter().map(|run| run["label"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(labels("rc.html"), ["located", "located, c", "penalty:epsilon=1e-9, c", "event, c"]);
    assert_eq!(labels("cr.html"), ["located", "penalty:epsilon=1e-9", "event", "located, r0.7"]);
    // A chart over a chart: its curves beside those of other programs.
    for steps in ["1e-3", "1e-4"] {
        let of = ["--schemes", "located,penalty:epsilon=1e-9", "--end", "0.5", "--repeats", "1", "--out", steps];
        said(folder, &[&["chart", CASE, "--steps", &format!("{steps}:5e-5"), "--levels", "3"], &of[..]].concat(), 0);
    }
    said(folder, &["report", "1e-3", "--over", "1e-4", "--out", "w.html"], 0);
    let programs = page("w.html")["chart"]["programs"].clone();
    let names: Vec<&str> = programs.as_array().unwrap().iter().map(|one| one[0].as_str().unwrap()).collect();
    assert_eq!(names, ["located, 1e-4", "ε = 1e-9, discrete-gradient, 1e-4"]);
    assert!(programs[0][1].as_array().unwrap().len() >= 2, "{programs}");
    // An orbit over an orbit, and a study of wear over one that lasts longer.
    for e in ["0.6", "0.8"] {
        said(folder, &["orbit", CASE, "--set", &format!("wall.*.restitution={e}"), "--out", &format!("o{e}")], 0);
    }
    said(folder, &["report", "o0.8", "--over", "o0.6", "--out", "o.html"], 0);
    let orbit = page("o.html")["orbit"].clone();
    assert_eq!(orbit["over"]["motion"], page("o0.6/report.html")["orbit"]["motion"]);
    assert_ne!(orbit["over"]["motion"], orbit["motion"]);
    for years in ["1e-3", "2e-3"] {
        let wear = ["wear", "tube-round-supports", "--years", years, "--end", "0.1", "--histories", "1"];
        said(folder, &[&wear[..], &["--set", "time.statistics_from=0", "--out", &format!("y{years}")]].concat(), 0);
    }
    said(folder, &["report", "y1e-3", "--over", "y2e-3", "--out", "y.html"], 0);
    let over = page("y.html")["wear"]["over"].clone();
    assert_eq!((&over["name"], &over["years"]), (&"y2e-3".into(), &page("y2e-3/report.html")["wear"]["years"]));
    said(folder, &["orbit", "two-masses", "--out", "structure"], 0);
    said(folder, &["run", "bouncing-ball", "--end", "0.5", "--no-verdict", "--out", "ball"], 0);
    for (own, other, words) in [
        ("r0.7", "s0.8", "holds results of \"sweep\"; expected those of run or compare"),
        ("1e-3", "c", "holds results of \"compare\"; expected those of chart"),
        ("r0.7", "ball", "its run has other walls than that of the page"),
        ("r0.7", "none", "none: holds no request.json"),
        ("o0.8", "structure", "both have their motion in orbit.csv"),
        ("o0.8", "y1e-3", "holds results of \"wear\"; expected those of orbit"),
    ] {
        let told = said(folder, &["report", own, "--over", other, "--out", "x.html"], 2).1;
        assert!(told.contains(words), "{words}: {told}");
    }
    assert!(!folder.join("x.html").exists());
}

/// A run with several realisations shows the first alone, and says so in its titles.
#[test]
fn one_of_several_realisations_is_called_so() {
    let dir = tempfile::tempdir().unwrap();
    let run = ["run", "tube-round-supports", "--end", "0.1", "--no-verdict", "--set", "time.statistics_from=0"];
    for (seeds, called) in [("1", false), ("2", true)] {
        said(dir.path(), &[&run[..], &["--seeds", seeds, "--out", seeds]].concat(), 0);
        let page = data(&fs::read_to_string(dir.path().join(seeds).join("report.html")).unwrap());
        assert_eq!(page["title"].as_str().unwrap().ends_with(": 2 draws"), called, "{}", page["title"]);
        assert_eq!(page["subtitle"].as_str().unwrap().contains("means over 2"), called, "{}", page["subtitle"]);
        let svg = fs::read_to_string(dir.path().join(seeds).join("displacement.svg")).unwrap();
        assert_eq!(svg.contains("draw 1 of 2"), called);
    }
}
