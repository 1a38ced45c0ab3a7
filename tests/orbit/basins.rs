//! Attractors and their basins: against closed forms of the orbits, long free runs, and themselves
//! whatever computes them.
use crate::source::source;
use nalgebra::Complex;
use signorini::case::CaseFile;
use signorini::linear::Symmetric;
use signorini::study::attractor::{Attractor, Lasts};
use signorini::sweep::{Axis, Measure, Plan, Sweep, Window};
use signorini::{Load, Row, Scene, Scheme, State, Stepper, Structure, Wall};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use std::process::Command;

fn periodic(attractor: Option<Attractor>) -> (Vec<State>, Vec<signorini::study::attractor::Touch>, Vec<Complex<f64>>) {
    let Some(Attractor::Periodic { strobes, touches, multipliers }) = attractor else { panic!("{attractor:?}") };
    (strobes, touches, multipliers)
}

#[test]
fn the_symmetric_orbit_at_5_hz_has_the_speed_phase_and_multipliers_of_its_closed_form() {
    let scene = source(5.0, 0.8);
    let (strobes, touches, multipliers) = periodic(Attractor::of(&scene, 0.2, 400, 60).unwrap());
    assert_eq!((strobes.len(), touches.len()), (1, 2));
    let upper = touches.iter().find(|touch| touch.wall == 0).unwrap();
    // Newton's method closes orbits to 1e-14 of the scales.
    assert!((upper.speed - 0.169_410_591_358_373_47).abs() < 1e-12, "{upper:?}");
    assert!((upper.phase - 1.741_232_823_663_744_7 / TAU).abs() < 1e-11, "{upper:?}");
    let expected = Complex::new(0.241_955_282_238_606_5, 0.578_789_249_790_999_4);
    assert!((multipliers[0] - expected).norm() < 1e-10, "{multipliers:?}");
    assert!((multipliers[1] - expected.conj()).norm() < 1e-10, "{multipliers:?}");
}

#[test]
fn the_quiet_motion_is_the_steady_state_and_is_certain_at_once() {
    // On the quiet motion itself: amplitude and phase of the linear response.
    let scene = source(5.0, 0.8);
    let omega = TAU * 5.0;
    let response = Complex::new(3.0, 0.0) / Complex::new(100.0 - omega * omega, 0.2 * omega);
    let scene = scene.with_initial(&[1e-4], &[omega * response.re]);
    // No time at all to settle: one period is enough.
    let (strobes, touches, multipliers) = periodic(Attractor::of(&scene, 0.2, 0, 1).unwrap());
    assert!(touches.is_empty());
    assert!((strobes[0].q[0] - response.im).abs() < 1e-15 && (strobes[0].v[0] - omega * response.re).abs() < 1e-14);
    let root = Complex::new(-0.1, (100.0_f64 - 0.01).sqrt());
    assert!((multipliers[0] - (root * 0.2).exp()).norm() < 1e-13, "{multipliers:?}");
    // Without drag nothing is attracted.
    let mut undamped = scene;
    undamped.system = Scene::oscillator(1.0, 0.0, 100.0).system;
    assert_eq!(Attractor::of(&undamped, 0.2, 20, 20).unwrap(), None);
}

#[test]
fn an_orbit_that_rests_is_superstable() {
    // e = 0 at 1 Hz: from each wall the load lets go, and the other one holds.
    let (strobes, touches, multipliers) = periodic(Attractor::of(&source(1.0, 0.0), 1.0, 100, 20).unwrap());
    assert_eq!((strobes.len(), touches.len()), (1, 2));
    for touch in &touches {
        assert_eq!(touch.lasts, Lasts::Rest);
        assert!((touch.speed - 0.174_133_447_977_690_1).abs() < 1e-12, "{touch:?}");
    }
    // Let go by the upper wall at the phase 2.974 rad, it arrives at the lower one at 3.9455 rad.
    let lower = touches.iter().find(|touch| touch.wall == 1).unwrap();
    assert!((lower.phase - 3.945_519_530_218_851_5 / TAU).abs() < 1e-12, "{lower:?}");
    assert!(multipliers.iter().all(|m| m.norm() == 0.0));
    // At e = 0.5 it chatters before it rests.
    let (_, touches, multipliers) = periodic(Attractor::of(&source(1.0, 0.5), 1.0, 100, 20).unwrap());
    assert_eq!(touches.iter().map(|touch| touch.lasts).collect::<Vec<_>>(), [Lasts::Chatter; 2]);
    assert!(multipliers.iter().all(|m| m.norm() == 0.0));
}

#[test]
fn impacts_before_a_chatter_that_are_none_of_it_are_touches_of_their_own() {
    // A ball on a floor that shakes it: three throws, and then impacts that accumulate. Phases and
    // speeds are those of a free run from the first state.
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(Load::constant(-9.81))
        .with_load(Load::harmonic(30.0, 2.0, 0.0))
        .with_initial(&[0.1], &[0.0]);
    let (strobes, touches, _) = periodic(Attractor::of(&scene, 0.5, 200, 40).unwrap());
    let lasts: Vec<Lasts> = touches.iter().map(|touch| touch.lasts).collect();
    assert_eq!(lasts, [Lasts::Instant, Lasts::Instant, Lasts::Instant, Lasts::Chatter]);
    let scene = scene.with_initial(&strobes[0].q, &strobes[0].v).with_duration(4.0);
    let run = signorini::run(&scene, &Scheme::Event, &signorini::Options::with_step(4.0)).unwrap();
    for touch in &touches {
        let near = |contact: &&signorini::Contact| (contact.start / 0.5 - touch.phase).abs() < 1e-6;
        let contact = run.trajectory.contacts().iter().find(near).unwrap_or_else(|| panic!("{touch:?}"));
        assert!((contact.approach_speed - touch.speed).abs() < 1e-8, "{touch:?} {contact:?}");
    }
}

/// Pressed on its wall with more than the load lifts: no flight, though it makes no contact either.
#[test]
fn a_motion_that_never_leaves_its_wall_is_not_quiet() {
    let wall = Wall::upper("stop", 0.0);
    for (wall, contracting) in [(wall.clone().with_restitution(0.3), 0.0), (wall.with_elasticity(300.0, 0.0), 1.0)] {
        let scene = Scene::oscillator(1.0, 0.5, 100.0)
            .with_wall(wall)
            .with_load(Load::constant(4.0))
            .with_load(Load::harmonic(0.5, 2.0, 0.0));
        let (strobes, touches, multipliers) = periodic(Attractor::of(&scene, 0.5, 60, 20).unwrap());
        let lasts: Vec<Lasts> = touches.iter().map(|touch| touch.lasts).collect();
        assert_eq!((strobes.len(), lasts), (1, vec![Lasts::Always]));
        // On the spring both multipliers have the size e^{-cT/2m}; on the rigid wall nothing is
        // left.
        let size = contracting * (-0.25_f64 * 0.5).exp();
        assert!(multipliers.iter().all(|m| (m.norm() - size).abs() < 1e-12), "{multipliers:?}");
    }
}

#[test]
fn chaos_is_told_by_its_exponent() {
    assert_eq!(Attractor::of(&source(2.75, 0.8), 1.0 / 2.75, 100, 400).unwrap(), Some(Attractor::Chaotic));
}

#[test]
fn two_masses_come_to_the_orbit_that_a_long_run_shows() {
    let structure = Structure {
        mass: Symmetric::diagonal(&[1.0, 0.5]),
        damping: Symmetric::from_entries(2, [(0, 0, 1.2), (1, 0, -0.4), (1, 1, 0.6)]),
        stiffness: Symmetric::from_entries(2, [(0, 0, 150.0), (1, 0, -50.0), (1, 1, 50.0)]),
    };
    let scene = Scene::structure(structure)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.6).at(Row::dof(1)))
        .with_wall(Wall::lower("soft", -4e-3).with_elasticity(3e3, 5.0).at(Row::dof(0)))
        .with_load(Load { at: Row::dof(1), ..Load::harmonic(3.0, 2.0, 0.0) });
    let (strobes, touches, multipliers) = periodic(Attractor::of(&scene, 0.5, 300, 100).unwrap());
    assert!(!touches.is_empty() && multipliers.len() == 4);
    let end = after(&scene, 0.5, 400);
    assert!(strobes.iter().any(|strobe| near(strobe, &end, 1e-8)), "{strobes:?} {end:?}");
}

/// The state of the free run after so many periods.
fn after(scene: &Scene, period: f64, periods: u32) -> State {
    let mut stepper = Stepper::new(scene, &Scheme::Event, period).unwrap();
    while stepper.time() < f64::from(periods) * period * (1.0 - 1e-12) {
        stepper.step().unwrap();
    }
    stepper.state()
}

fn near(a: &State, b: &State, share: f64) -> bool {
    let close = |a: &[f64], b: &[f64], by: f64| a.iter().zip(b).all(|(a, b)| (a - b).abs() < by);
    close(&a.q, &b.q, share * 5e-3) && close(&a.v, &b.v, share * 0.2)
}

fn basin(points: u64) -> Plan {
    let axis = |key: &str, most: f64| Axis::linear(key, -most, most, points).unwrap();
    Sweep::new(CaseFile::embedded("rigid-walls-sine").unwrap())
        .set("wall.*.restitution", 0.8)
        .unwrap()
        .set("load.1.harmonic.frequency", 5.0)
        .unwrap()
        .vary(axis("initial.displacement", 5e-3))
        .vary(axis("initial.velocity", 0.4))
        .over(Window::Periods { settle: 400, keep: 60 })
        .by("event")
        .measure([Measure::Attractor, Measure::Period])
        .plan()
        .unwrap()
}

#[test]
fn every_start_of_a_basin_comes_to_its_attractor_in_a_long_run() {
    let plan = basin(14);
    let rows = plan.rows(2).unwrap();
    let mut first: Vec<Attractor> = Vec::new();
    for row in &rows {
        let number = row.measures[0].unwrap() as usize;
        let attractor = row.attractor.clone().unwrap();
        if number > first.len() {
            // Numbers are given in the order of the rows.
            assert_eq!(number, first.len() + 1);
            first.push(attractor.clone());
        }
        let Attractor::Periodic { strobes, touches, .. } = &first[number - 1] else { panic!() };
        assert_eq!(row.measures[1], Some(strobes.len() as f64));
        // A run of 1200 periods: the slowest multiplier, that of the quiet motion, is 0.98, and
        // 0.98^1200 is 3e-11.
        let mut scene = plan.case().scene.clone();
        let value = |at: usize| row.values[at].number().unwrap();
        scene.initial = State { q: vec![value(0)], v: vec![value(1)] };
        scene.duration = 240.0;
        let end = after(&scene, 0.2, 1200);
        assert!(strobes.iter().any(|strobe| near(strobe, &end, 1e-6)), "row {}: {end:?} {strobes:?}", row.number);
        let wanted = if strobes.len() == 3 { 6 } else { touches.len() };
        assert_eq!(touches.len(), wanted);
    }
    assert!(first.len() >= 2, "{}", first.len());
}

/// Runs the tool in `folder`, and expects success.
fn tool(folder: &Path, args: &[&str]) {
    let out = Command::new(env!("CARGO_BIN_EXE_signorini")).current_dir(folder).args(args).output().unwrap();
    assert!(out.status.success(), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
}

fn bytes(folder: &Path) -> Vec<Vec<u8>> {
    ["sweep.csv", "attractors.csv", "sweep.svg"].map(|name| fs::read(folder.join(name)).unwrap()).to_vec()
}

const FILE: &str = r#"
case = "rigid-walls-sine"
[set]
"wall.*.restitution" = 0.8
"load.1.harmonic.frequency" = 5.0
[[vary]]
key = "initial.displacement"
from = -5e-3
to = 5e-3
points = 21
[[vary]]
key = "initial.velocity"
from = -0.4
to = 0.4
points = 22
[run]
scheme = "event"
settle = { periods = 400 }
keep = { periods = 60 }
[measure]
columns = ["attractor", "period"]
[figure]
kind = "basin"
"#;

#[test]
fn threads_shards_and_interruptions_change_no_byte_and_no_number() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("basin.toml"), FILE).unwrap();
    let sweep = |args: &[&str]| tool(path, &[&["sweep", "basin.toml", "--out"], args].concat());
    sweep(&["one", "--threads", "1"]);
    sweep(&["two", "--threads", "2"]);
    let whole = bytes(&path.join("one"));
    assert_eq!(bytes(&path.join("two")), whole);
    // Numbers of a shard are its own; merged they are those of the whole.
    for shard in ["3/3", "1/3", "2/3"] {
        sweep(&["parts", "--shard", shard]);
    }
    tool(path, &["merge", "parts", "--out", "merged"]);
    assert_eq!(bytes(&path.join("merged")), whole);
    // Killed again and again, and gone on with.
    for _ in 0..20 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_signorini"))
            .current_dir(path)
            .args(["sweep", "basin.toml", "--out", "killed", "--threads", "2"])
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(20));
        let _ = child.kill();
        let _ = child.wait();
    }
    sweep(&["killed"]);
    assert_eq!(bytes(&path.join("killed")), whole);
    // What the table of the attractors counts is what the other one has.
    let read = |name: &str| {
        let text = fs::read_to_string(path.join("one").join(name)).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    let (rows, attractors) = (read("sweep.csv"), read("attractors.csv"));
    assert_eq!(attractors[0][..5], ["attractor", "rows", "share", "signature", "period"]);
    let mut counted = 0;
    for attractor in &attractors[1..] {
        let number: f64 = attractor[0].parse().unwrap();
        let found = rows[1..].iter().filter(|row| row[5].parse() == Ok(number)).count();
        assert_eq!(attractor[1], found.to_string());
        counted += found;
    }
    assert_eq!(counted, rows.len() - 1);
    assert!(attractors[1..].iter().any(|a| a[3] == "quiet") && attractors[1..].iter().any(|a| a[3] == "upper lower"));
    let svg = fs::read_to_string(path.join("one/sweep.svg")).unwrap();
    assert!(svg.contains("quiet") && svg.contains("upper lower"));
}

#[test]
fn what_does_not_go_with_attractors_is_refused_by_name() {
    let read = |text: &str| Sweep::parse(text, "basin.toml", Path::new("")).and_then(Sweep::plan);
    assert_eq!(read(FILE).unwrap().header()[3..], ["status", "error", "attractor", "period"]);
    for (from, to, words) in [
        ("\"attractor\", \"period\"", "\"attractor\", \"contacts\"", "period at most"),
        ("[measure]", "[measure]\nsamples = \"periods\"", "no samples"),
        ("\"initial.displacement\"\nfrom = -5e-3", "\"wall.upper.position\"\nfrom = 4e-3", "initial.displacement and"),
        ("points = 22", "points = 22\nfollow = \"up\"", "no followed value"),
        ("\"event\"", "\"moreau-jean\"", "--scheme event"),
        ("keep = { periods = 60 }", "keep = { seconds = 60 }", "both units"),
        ("columns = [\"attractor\", \"period\"]", "columns = [\"contacts\"]", "the measure attractor"),
    ] {
        let text = FILE.replacen(from, to, 1);
        assert_ne!(text, FILE, "{from}");
        let error = read(&text).unwrap_err();
        assert!(error.is_request() && error.to_string().contains(words), "{to}: {error}");
    }
}
