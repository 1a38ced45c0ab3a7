//! Turbulence on modal data: the forces of a beam on its own modes, and files that are refused.
use crate::refused::{Wrong, not_refused};
use signorini::case::{Case, Model};
use signorini::{Load, LoadKind};
use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;

/// Two modes of a tube of 3 m with three points, in one plane.
const MODES: &str = r#"[system.modal]
frequencies = [4.0, 16.0]
damping_ratios = 0.02
shapes = { a = [0.0, 0.0], b = [1.0, 0.5], c = [0.0, -1.0], off = [0.3, 0.3] }

[[turbulence]]
line = { c = 3.0, a = 0.0, b = 1.0 }
spectrum = [[1.0, 0.02], [40.0, 0.02]]
from = 1.0
to = 40.0
correlation_length = 0.5
seed = 3

[[wall]]
name = "stop"
at = { point = "off" }
side = "upper"
position = 1e-3
stiffness = 1e4

[time]
end = 4.0
step = 1e-3
"#;

/// The same with the points of the line as they lie along the tube.
fn modes() -> String {
    MODES.replace("{ c = 3.0, a = 0.0, b = 1.0 }", "{ a = 0.0, b = 1.0, c = 3.0 }")
}

fn case(text: &str) -> Case {
    Case::parse(text, "modes.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

/// The forces of the last `count` loads of the scene, each with its mode.
fn forces(case: &Case, count: usize) -> Vec<(usize, Vec<f64>)> {
    let of = |load: &Load| match &load.kind {
        LoadKind::Table(table) => (load.at.entries()[0].0, table.time().iter().map(|t| table.piece(*t).0).collect()),
        other => panic!("{other:?}"),
    };
    case.scene.loads[case.scene.loads.len() - count..].iter().map(of).collect()
}

fn rms(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|x| x * x).sum::<f64>() / count).sqrt()
}

const FLOW: &str = "density = 740.0\nvelocity = [[0.0, 0.3], [3.0, 0.6]]\n\
                    reduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]\n\
                    from = 1.0\nto = 40.0\ncorrelation_length = 0.2\nseed = 5\n";
const TIME: &str = "[time]\nend = 10.0\nstep = 1e-3\n";

/// Elements of the tube.
const ELEMENTS: u32 = 60;

/// A tube of 3 m on its `count` slowest modes in a flow, and the same as modal data with a point
/// for each node; `tails` end the files.
fn tube_and_modes(count: usize, tails: [&str; 2]) -> [Case; 2] {
    let length = 3.0;
    let [own, given] = tails;
    let beam = case(&format!(
        "[system]\nmodes = {count}\n[system.beam]\nlength = {length:?}\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
         outer_diameter = 0.02\nelements = {ELEMENTS}\nleft = \"pinned\"\nright = \"pinned\"\n\
         [system.damping]\nratio = 0.02\n[[turbulence]]\n{FLOW}{own}{TIME}"
    ));
    let Model::Beam(tube) = &beam.model else { panic!("no beam") };
    let reduction = &beam.truncated.as_ref().unwrap().reduction;
    let (mut shapes, mut line) = (String::new(), String::new());
    for node in 0..=ELEMENTS {
        let x = length * f64::from(node) / f64::from(ELEMENTS);
        writeln!(shapes, "n{node} = {:?}", reduction.modes.seen(&tube.at(x).unwrap())).unwrap();
        write!(line, "n{node} = {x:?}, ").unwrap();
    }
    let modal = case(&format!(
        "[system.modal]\nomega = {:?}\ndamping_ratios = 0.02\n[system.modal.shapes]\n{shapes}\
         [[turbulence]]\ndiameter = 0.02\nline = {{ {} }}\n{FLOW}{given}{TIME}",
        reduction.modes.omega,
        line.trim_end_matches(", ")
    ));
    [beam, modal]
}

/// The mean of a sine of the wave number k of `mode`, from 0, less that of its chord over an
/// element of the length l is (kl)²/12 of it, to the next order.
fn short(mode: usize) -> f64 {
    (PI * (mode as f64 + 1.0) / f64::from(ELEMENTS)).powi(2) / 12.0
}

#[test]
fn a_beam_and_its_own_modes_have_the_same_forces_to_the_error_of_straight_shapes_between_points() {
    let cases = tube_and_modes(6, ["", ""]);
    let [expected, found] = cases.each_ref().map(|case| forces(case, 6));
    for ((mode, whole), (same, straight)) in expected.iter().zip(&found) {
        assert!(mode == same && whole.len() == straight.len());
        let short = short(*mode);
        let ratio = rms(straight.iter().copied()) / rms(whole.iter().copied());
        assert!(((1.0 - ratio) / short - 1.0).abs() < 0.2, "mode {mode}: {ratio} instead of {}", 1.0 - short);
        let apart = rms(whole.iter().zip(straight).map(|(a, b)| a - b)) / rms(whole.iter().copied());
        assert!(apart < 1.5 * short, "mode {mode}: {apart:e} of its force, the chords leave {short:e}");
    }
}

#[test]
fn modal_data_have_the_margins_of_their_beam() {
    let support = |place: &str| {
        format!("[[wall]]\nname = \"plate\"\nat = {place}\nside = \"upper\"\nposition = 1e-3\n[flow]\nconnors = 3.0\n")
    };
    // Margins do not depend on the mass per metre: that of the velocities is doubled here.
    let mass = 7850.0 * 0.25 * PI * 0.02 * 0.02;
    let own = support("{ position = 1.0 }");
    let given = support("{ point = \"n20\" }") + &format!("mass_per_metre = {:?}\n", 2.0 * mass);
    let cases = tube_and_modes(6, [&own, &given]);
    let [beam, modal] = cases.each_ref().map(|case| case.fluid_elastic.as_ref().unwrap());
    assert_eq!((beam.inactive.len(), modal.inactive.len()), (6, 6));
    for (mode, (whole, straight)) in beam.inactive.iter().zip(&modal.inactive).enumerate() {
        // Rounding of the eigen-solver.
        assert!((straight.frequency_hz / whole.frequency_hz - 1.0).abs() < 1e-12);
        assert!((straight.damping_ratio / 0.02 - 1.0).abs() < 1e-12);
        let [margins, velocities] = [
            whole.margin.unwrap() / straight.margin.unwrap(),
            straight.critical_velocity_m_per_s / whole.critical_velocity_m_per_s,
        ];
        // V_e is short by the chords of the shape: twice in φ², once in its square root.
        let short = short(mode);
        assert!(((1.0 - margins) / short - 1.0).abs() < 0.2, "mode {mode}: {margins} instead of {}", 1.0 - short);
        assert!((velocities / 2.0_f64.sqrt() - 1.0).abs() < 1e-12, "{velocities}");
    }
    // One constraint on six modes leaves five, each between its own free mode and the next
    // (Rayleigh's theorem), and none below that of the whole beam; ratios that are equal stay so.
    assert_eq!(modal.active.len(), 5);
    for (i, (held, whole)) in modal.active.iter().zip(&beam.active).enumerate() {
        let between = [i, i + 1].map(|i| modal.inactive[i].frequency_hz);
        assert!(between[0] < held.frequency_hz && held.frequency_hz <= between[1] * (1.0 + 1e-12), "{held:?}");
        assert!(held.frequency_hz > whole.frequency_hz * (1.0 - 1e-12), "{held:?} below {whole:?}");
        assert!((held.damping_ratio / 0.02 - 1.0).abs() < 1e-12, "{held:?}");
    }
    // What six modes lack of the shape of a held tube: 1 % of the first frequency.
    assert!(modal.active[0].frequency_hz < 1.01 * beam.active[0].frequency_hz);
}

#[test]
fn the_line_may_be_a_file_and_the_modes_fewer() {
    let own = case(&modes());
    assert_eq!(own.scene.loads.len(), 2);
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("line.csv"), "point,position_m\na,0.0\nb,1.0\nc,3.0\n").unwrap();
    let path = dir.path().join("modes.toml");
    fs::write(&path, modes().replace("{ a = 0.0, b = 1.0, c = 3.0 }", "\"line.csv\"")).unwrap();
    let read = Case::read(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.scene, own.scene);
    // The forces on the first modes stay as fewer are kept.
    let one = case(&format!("[system]\nmodes = 1\n{}", modes()));
    assert_eq!(forces(&one, 1), forces(&own, 2)[..1]);
    // Twice the speed of a shape is twice its force, and another seed another force.
    let twice = case(&modes().replace("b = [1.0, 0.5]", "b = [2.0, 0.5]"));
    let [once, twice] = [&own, &twice].map(|case| forces(case, 2).remove(0).1);
    assert!(once.iter().zip(&twice).all(|(a, b)| (2.0 * a - b).abs() <= 1e-9 * rms(twice.iter().copied())));
    assert_ne!(own.realisation(2).unwrap().scene.loads, own.scene.loads);
    for file in ["a,0.0\nb,wide\n", "a,0.0\nb\n", "a,0.0\na,1.0\n", ""] {
        fs::write(dir.path().join("line.csv"), file).unwrap();
        let said = Case::read(&path).unwrap_err().to_string();
        assert!(said.contains("line.csv") && said.contains("expected"), "{file:?}: {said}");
    }
}

#[test]
fn in_two_planes_each_field_moves_the_modes_of_its_plane() {
    let shapes = "[system.modal.shapes]\na-y = [0.0, 0.0]\na-z = [0.0, 0.0]\nb-y = [1.0, 0.0]\n\
                  b-z = [0.0, 1.0]\nc-y = [0.5, 0.0]\nc-z = [0.0, 0.5]";
    let own = "shapes = { a = [0.0, 0.0], b = [1.0, 0.5], c = [0.0, -1.0], off = [0.3, 0.3] }";
    let both = modes().replace("[system.modal]", "[system]\nplanes = 2\n[system.modal]");
    let both = both.replace(own, shapes).replace("[[turbulence]]", "[[turbulence]]\ndirection = \"both\"");
    let both = both.replace("at = { point = \"off\" }", "at = { point = \"b\" }\ndirection = 0");
    let loads = forces(&case(&both), 2);
    assert_eq!([loads[0].0, loads[1].0], [0, 1], "one field for each plane, on its mode alone");
    let along_z = case(&both.replace("direction = \"both\"", "direction = 90"));
    assert_eq!(forces(&along_z, 1)[0].0, 1);
}

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    ("no line", "line = { a = 0.0, b = 1.0, c = 3.0 }\n", "", "6:1", &["`line` is missing in turbulence 1", "point and position_m"]),
    ("out of order", "a = 0.0, b = 1.0, c = 3.0", "c = 3.0, a = 0.0, b = 1.0", "7:19", &["turbulence 1: line: \"a\" lies at 0.0 m, after a point at 3.0 m", "increase"]),
    ("the same position", "b = 1.0, c", "b = 0.0, c", "7:19", &["\"b\" lies at 0.0 m", "increase"]),
    ("one point", "a = 0.0, b = 1.0, c = 3.0", "a = 0.0", "7:8", &["line has 1 point", "two points or more"]),
    ("no shape", "c = 3.0 }", "d = 3.0 }", "7:28", &["a point \"d\" without a shape", "a, b, c, off"]),
    ("a word for a position", "c = 3.0 }", "c = \"end\" }", "7:32", &["line: c", "a finite number"]),
    ("a list", "{ a = 0.0, b = 1.0, c = 3.0 }", "[0.0, 3.0]", "7:8", &["turbulence 1: line", "CSV"]),
    ("no file", "{ a = 0.0, b = 1.0, c = 3.0 }", "\"no.csv\"", "7:8", &["no.csv", "relative to the case file"]),
    ("beyond the line", "seed = 3\n", "seed = 3\nalong = [1.0, 4.0]\n", "13:9", &["turbulence 1: along", "from 0 to 3.0 m"]),
    ("no diameter", "spectrum = [[1.0, 0.02], [40.0, 0.02]]", "density = 1.0\nvelocity = 1.0\nreduced = [[0.01, 1.0], [9.0, 1.0]]", "8:11", &["`diameter` is missing in turbulence 1"]),
    ("a diameter of 0", "spectrum = [[1.0, 0.02], [40.0, 0.02]]", "diameter = 0\ndensity = 1.0\nvelocity = 1.0\nreduced = [[0.01, 1.0], [9.0, 1.0]]", "8:12", &["turbulence 1: diameter", "above 0"]),
    ("a diameter beside a spectrum", "seed = 3\n", "seed = 3\ndiameter = 0.02\n", "13:12", &["diameter beside spectrum"]),
    ("margins", "[time]", "[flow]\nconnors = 3.0\n[time]", "21:1", &["`flow` without the flow of a turbulence", "a beam or modal data"]),
];

#[test]
fn every_wrong_line_is_refused_at_its_place() {
    let right = modes();
    case(&right);
    let missed = not_refused(&right, WRONG);
    assert!(missed.is_empty(), "{missed}");
}

#[test]
fn a_beam_has_neither_line_nor_diameter_and_a_chain_no_turbulence() {
    let beam = "[system]\nmodes = 2\n[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
                outer_diameter = 0.02\nelements = 30\nleft = \"pinned\"\nright = \"pinned\"\n\
                [system.damping]\nratio = 0.02\n";
    let chain = "[system.chain]\nmasses = [1.0, 1.0]\nsprings = [1.0]\nleft = { stiffness = 1.0 }\n";
    for (system, more, words) in [
        (beam, "line = { a = 0.0, b = 1.0 }\n", "line beside a beam"),
        (beam, "diameter = 0.02\n", "diameter beside a beam"),
        (chain, "", "turbulence 1 acts on no tube"),
    ] {
        let text = format!("{system}[[turbulence]]\n{more}{FLOW}{TIME}");
        let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(words) && said.contains("expected"), "{said}");
    }
}

#[test]
fn a_body_by_its_modes_needs_no_number_of_modes() {
    let alone = case(&modes());
    let body = |text: &str| {
        let other = "[[body]]\nname = \"other\"\n[body.oscillator]\nmass = 1.0\ndamping = 0.1\nstiffness = 1e6\n\n";
        let tube = text.replace("[system.modal]", "[[body]]\nname = \"tube\"\n[body.modal]");
        let tube = tube.replace("[[turbulence]]", &format!("{other}[[turbulence]]\nbody = \"tube\""));
        tube.replace("at = { point", "at = { body = \"tube\", point")
    };
    let beside = case(&body(&modes()));
    assert_eq!(beside.scene.system.degrees_of_freedom(), 3);
    // The oscillator of 159 Hz is the fastest mode; those of the tube come before it, with the
    // forces that they have alone, to the roundings of a product of matrices.
    for ((own, force), (mode, alone)) in forces(&beside, beside.scene.loads.len()).iter().zip(forces(&alone, 2)) {
        assert_eq!(*own, mode);
        assert!(force.iter().zip(&alone).all(|(x, y)| (x.abs() - y.abs()).abs() <= 1e-12 * rms(alone.iter().copied())));
    }
    // A beam under turbulence still has to say how many of its modes are kept.
    let beam = "[body.beam]\nlength = 3.0\nelements = 6\nouter_diameter = 0.02\ninner_diameter = 0.016\n\
                youngs_modulus = 2e11\ndensity = 8000.0\nleft = \"pinned\"\nright = \"pinned\"\n";
    let text = body(&modes()).replace("[body.oscillator]\nmass = 1.0\ndamping = 0.1\nstiffness = 1e6\n", beam);
    let field = "[[turbulence]]\nbody = \"other\"\nspectrum = [[1.0, 0.02], [40.0, 0.02]]\nfrom = 1.0\nto = 40.0\n\
                 correlation_length = 0.5\n[[wall]]";
    let error = Case::parse(&text.replace("[[wall]]", field), "modes.toml", "").unwrap_err().to_string();
    assert!(error.contains("expected modes = k in [system]"), "{error}");
}
