//! Turbulence of case files: the variance that it gives a tube in closed form, the same forces
//! under other numbers of modes, its seeds and planes, and files that are refused.
use crate::fluid_elastic::{case, with};
use crate::refused::{Wrong, not_refused};
use signorini::case::{Case, Embedded};
use signorini::{Load, LoadKind, Options, Scheme, Table, run};
use std::f64::consts::PI;

/// A tube of 3 m in one plane, cut to its first mode, under a white field.
const TUBE: &str = r#"[system]
modes = 1

[system.beam]
spans = [1.0, 2.0]
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 0.02
elements = 60
left = "pinned"
right = "pinned"

[system.damping]
ratio = 0.05

[[turbulence]]
spectrum = [[1.0, 0.02], [40.0, 0.02]]
from = 1.0
to = 40.0
correlation_length = 0.06
seed = 3

[[probe]]
name = "middle"
at = { position = 1.5 }

[time]
end = 20.0
step = 1e-3
sample = 0.1
"#;

fn table(load: &Load) -> &Table {
    match &load.kind {
        LoadKind::Table(table) => table,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_tube_has_the_variance_of_the_field_in_closed_form() {
    let case = case(TUBE);
    let (end, length, inertia, mass) = (20.0, 3.0, PI * 0.02_f64.powi(4) / 64.0, 7850.0 * PI * 1e-4);
    let omega = (PI / length).powi(2) * (2e11 * inertia / mass).sqrt();
    // ∬ sin(πx/L) sin(πx′/L) e^(−|x−x′|/λ) dx dx′ with a = 1/λ and k = π/L.
    let (a, k) = (1.0 / 0.06, PI / length);
    let sum = a * a + k * k;
    let coherent = length * a / sum + 2.0 * k * k / (sum * sum) * (1.0 + (-a * length).exp());
    // Of the deflection at the middle: a mode sin πx/L of the mass mL/2.
    let density = 0.02 * coherent / (0.5 * mass * length).powi(2);
    let response = |i: i32| {
        let s = 2.0 * PI * f64::from(i) / end;
        1.0 / ((omega * omega - s * s).powi(2) + (2.0 * 0.05 * omega * s).powi(2))
    };
    let asked: f64 = (20..=800).map(|i| density / end * response(i)).sum();
    // Four periods of the force, of which the last is steady: e^(−0.05·12·60) is left of the start.
    let mut scene = case.scene.clone();
    let force = table(&scene.loads[0]).force().to_vec();
    let rows = force.len() - 2;
    let time = (0..=4 * rows).map(|j| end * j as f64 / rows as f64).collect();
    let periods = (0..=4 * rows).map(|j| force[j % rows]).collect();
    scene.loads[0].kind = LoadKind::Table(Table::new(time, periods).unwrap());
    scene.duration = 4.0 * end;
    let sample = end / (16.0 * 800.0 * 4.0);
    let run = run(&scene, &Scheme::Event, &Options::with_step(sample).with_sample(sample)).unwrap();
    let (found, _) = run.trajectory.probe("middle").unwrap();
    let last: Vec<f64> = found.iter().rev().take((end / sample).round() as usize).copied().collect();
    let square = last.iter().map(|q| q * q).sum::<f64>() / last.len() as f64;
    // Cells of 12.5 mm and elements of 50 mm under a wave of 6 m: (kℓ)²/6 = 2.9e-5 of the force.
    // One mode has one phasor a line, so that nothing scatters from seed to seed.
    assert!((square / asked - 1.0).abs() < 6e-5, "{square:e} for {asked:e}");
}

#[test]
fn more_modes_leave_the_forces_on_the_first_as_they_are() {
    let few = with(&case(TUBE), "system.modes", 4.0);
    let many = with(&few, "system.modes", 12.0);
    assert_eq!((few.scene.loads.len(), many.scene.loads.len()), (4, 12));
    for (few, many) in few.scene.loads.iter().zip(&many.scene.loads) {
        assert_eq!(few.at, many.at);
        let [few, many] = [table(few), table(many)].map(Table::force);
        let largest = few.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        // Shapes are found to 1e-11 in the norm of the mass, whichever their number; forces of
        // modes beyond the first are differences of products of them.
        assert!(few.iter().zip(many).all(|(a, b)| (a - b).abs() < 1e-8 * largest));
    }
    // So does the run with more modes of a truncation's check.
    let whole = &few.truncated.as_ref().unwrap().whole;
    assert_eq!(whole.cut(12).unwrap().scene.loads, many.scene.loads);
}

#[test]
fn a_step_sees_the_same_forces_and_a_longer_run_others() {
    let own = case(TUBE);
    assert_eq!(with(&own, "time.step", 5e-4).scene.loads, own.scene.loads);
    let longer = with(&own, "time.end", 40.0);
    assert_eq!(table(&longer.scene.loads[0]).time().last().map(|t| (t * 100.0).round()), Some(4000.0));
}

#[test]
fn realisations_are_those_of_their_seeds() {
    let own = with(&case(TUBE), "system.modes", 3.0);
    assert!(own.is_random());
    let third = own.realisation(3).unwrap();
    assert_eq!(third.scene, with(&own, "turbulence.1.seed", 5.0).scene);
    assert_eq!(third.document.get(&"turbulence.1.seed".parse().unwrap()).unwrap(), Some(5_i64.into()));
    assert_ne!(third.scene.loads, own.scene.loads);
    assert_eq!(third.truncated.as_ref().unwrap().reduction.scene.loads, third.scene.loads);
    let last = with(&own, "turbulence.1.seed", 9_007_199_254_740_992.0);
    assert!(last.realisation(2).unwrap_err().to_string().contains("seeds go up to 2^53"));
}

#[test]
fn fields_of_two_planes_are_independent_and_add_up_to_those_of_a_direction() {
    let both = "[[turbulence]]\ndirection = \"both\"\n";
    let text =
        TUBE.replace("modes = 1", "planes = 2\nmodes = 1").replace("at = { position = 1.5 }", "at = { joint = 1 }");
    let own = case(&text.replace("[[turbulence]]\n", both));
    assert_eq!(own.scene.loads.len(), 2);
    let [y, z] = [0, 1].map(|i| table(&own.scene.loads[i]).force());
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    // 781 lines: the correlation scatters by 1/√(2·781), 2.5 %.
    assert!((dot(y, z) / (dot(y, y) * dot(z, z)).sqrt()).abs() < 0.08);
    // Of 30 degrees, cos² and sin² of the power go into the planes, by one signal.
    let slanted = case(&text.replace("[[turbulence]]\n", "[[turbulence]]\ndirection = 30\n"));
    let [along, across] = [0, 1].map(|i| table(&slanted.scene.loads[i]).force());
    assert!((dot(along, along) / dot(y, y) - 0.75).abs() < 1e-9);
    let correlation = dot(along, across) / (dot(along, along) * dot(across, across)).sqrt();
    assert!((correlation.abs() - 1.0).abs() < 1e-9, "{correlation}");
    // Two tables add up, each with signals of its own.
    let two = case(&text.replace("[[turbulence]]\n", both).replace(
        "[[probe]]",
        "[[turbulence]]\ndirection = 0\nspectrum = [[1.0, 0.02], [40.0, 0.02]]\nfrom = 1.0\nto = 40.0\n\
         correlation_length = 0.06\nseed = 3\n\n[[probe]]",
    ));
    assert_eq!(two.scene.loads.len(), 3);
    assert_ne!(table(&two.scene.loads[0]), table(&two.scene.loads[2]));
}

#[test]
fn where_the_spectrum_ends_within_the_band_is_said() {
    let flow = "density = 1000.0\nvelocity = [[0.0, 1.0], [3.0, 2.0]]\nreduced = [[0.02, 1.0], [0.5, 1e-4]]\n";
    let case = case(&TUBE.replace("spectrum = [[1.0, 0.02], [40.0, 0.02]]\n", flow));
    let notes = case.notes().join("\n");
    // 0.5 V/D with V a little over 1 m/s in the first cell; 0.02·2/0.02 = 2 Hz at the other end.
    assert!(notes.contains("turbulence 1: at 0.006 m its spectrum ends at 25.052 Hz"), "{notes}");
    assert!(notes.contains("at 2.994 m it begins at 1.998 Hz"), "{notes}");
    assert!(!self::case(TUBE).notes().join("\n").contains("turbulence"));
}

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    ("no modes", "modes = 1\n", "", "15:1", &["turbulence 1 acts through modes", "modes = k in [system]"]),
    ("two spectra", "from = 1.0\n", "from = 1.0\ndensity = 1.0\n", "17:12", &["two spectra", "spectrum = [[Hz"]),
    ("no spectrum", "spectrum = [[1.0, 0.02], [40.0, 0.02]]\n", "", "16:1", &["turbulence 1 has no spectrum", "reduced"]),
    ("a flow without velocity", "spectrum = [[1.0, 0.02], [40.0, 0.02]]", "density = 1.0\nreduced = [[1.0, 2.0], [2.0, 1.0]]", "16:1", &["`velocity` is missing in turbulence 1"]),
    ("a flow without density", "spectrum =", "velocity = 1.0\nreduced =", "16:1", &["`density` is missing in turbulence 1"]),
    ("one point", "[[1.0, 0.02], [40.0, 0.02]]", "[[1.0, 0.02]]", "17:12", &["turbulence 1: spectrum", "two pairs"]),
    ("a spectrum of numbers", "[[1.0, 0.02], [40.0, 0.02]]", "[1.0, 0.02]", "17:13", &["turbulence 1: spectrum", "(N/m)^2/Hz"]),
    ("a negative density", "[40.0, 0.02]", "[40.0, -0.02]", "17:12", &["spectrum", "above 0"]),
    ("points out of order", "[40.0, 0.02]", "[0.5, 0.02]", "17:12", &["spectrum", "more than the one before"]),
    ("no band", "to = 40.0\n", "", "16:1", &["`to` is missing in `turbulence`"]),
    ("a band upside down", "to = 40.0", "to = 0.5", "19:6", &["turbulence 1: to", "more than from"]),
    ("a band from 0", "from = 1.0", "from = 0.0", "18:8", &["turbulence 1: from", "above 0"]),
    ("a band between lines", "from = 1.0\nto = 40.0", "from = 1.01\nto = 1.02", "19:6", &["without a line", "multiple of 1/end"]),
    ("too many rows", "to = 40.0", "to = 1e7", "19:6", &["2^24 rows"]),
    ("no coherence", "correlation_length = 0.06", "correlation_length = 0", "20:22", &["turbulence 1: correlation_length", "above 0"]),
    ("half a seed", "seed = 3", "seed = 0.5", "21:8", &["turbulence 1: seed", "2^53"]),
    ("a direction in one plane", "seed = 3", "seed = 3\ndirection = 0", "22:13", &["turbulence 1 has a direction", "planes = 2"]),
    ("a place", "seed = 3", "seed = 3\nat = { position = 1.0 }", "22:1", &["unknown key `at`", "along"]),
    ("beyond the tube", "seed = 3", "seed = 3\nalong = [1.0, 4.0]", "22:9", &["turbulence 1: along", "from 0 to 3.0 m"]),
    ("backwards", "seed = 3", "seed = 3\nalong = [2.0, 1.0]", "22:9", &["turbulence 1: along", "from below to"]),
    ("a length and spans", "spans = [1.0, 2.0]", "spans = [1.0, 2.0]\nlength = 3.0", "5:9", &["a length and spans"]),
    ("neither", "spans = [1.0, 2.0]\n", "", "4:1", &["`length` is missing", "spans"]),
    ("a span of 0", "[1.0, 2.0]", "[1.0, 0.0]", "5:15", &["system.beam.spans", "above 0"]),
    ("no spans", "[1.0, 2.0]", "[]", "5:9", &["length is 0"]),
    ("a joint beyond the last", "{ position = 1.5 }", "{ joint = 3 }", "25:16", &["joint is 3", "1 to 2"]),
    ("half a joint", "{ position = 1.5 }", "{ joint = 0.5 }", "25:16", &["joint", "1 to 2"]),
];

#[test]
fn every_wrong_field_is_refused_at_its_place() {
    case(TUBE);
    let missed = not_refused(TUBE, WRONG);
    assert!(missed.is_empty(), "{missed}");
}

#[test]
fn a_rectangular_beam_takes_forces_along_it_but_no_flow_across_a_tube() {
    let plank = TUBE.replace("outer_diameter = 0.02", "width = 0.05\nheight = 0.02");
    case(&plank);
    let spectrum = "spectrum = [[1.0, 0.02], [40.0, 0.02]]";
    let flow = plank.replace(spectrum, "density = 1000.0\nvelocity = 1.0\nreduced = [[0.01, 0.05], [3.0, 8.6e-7]]");
    let said = Case::parse(&flow, "wrong.toml", "").unwrap_err().to_string();
    let words = ["wrong.toml:18:11", "the beam is rectangular", "spectrum = [[Hz", "outer_diameter of a tube"];
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn what_is_no_tube_has_no_turbulence_and_no_joints() {
    let chain = "[system.chain]\nmasses = [1.0, 1.0]\nsprings = [1.0]\nleft = { stiffness = 1.0 }\nright = \"free\"\n";
    let tables =
        "[[turbulence]]\nspectrum = [[1.0, 1.0], [2.0, 1.0]]\nfrom = 1.0\nto = 2.0\ncorrelation_length = 1.0\n";
    let said = |text: &str| Case::parse(text, "wrong.toml", "").unwrap_err().to_string();
    let time = "[time]\nend = 1.0\nstep = 1e-3\n";
    let told = said(&format!("{chain}{tables}{time}"));
    assert!(told.contains("turbulence 1 acts on no tube") && told.contains("[system.beam]"), "{told}");
    let told = said(&TUBE.replace("spans = [1.0, 2.0]", "length = 3.0").replace("{ position = 1.5 }", "{ joint = 1 }"));
    assert!(told.contains("unknown key `joint`") && told.contains("position"), "{told}");
}

#[test]
fn an_end_that_is_none_is_told_of_itself_and_not_of_a_random_load() {
    let text = Embedded::named("tube-in-cross-flow").unwrap().text;
    let line = text.lines().find(|line| line.starts_with("end = ")).unwrap();
    let random = "[[load]]\nat = { position = 1.0 }\ndirection = 0.0\n\
                  random = { rms = 1.0, from = 1.0, to = 50.0, seed = 1 }\n\n[time]";
    for text in [text.to_owned(), text.replace("[time]", random)] {
        for end in ["-0.6", "0.0", "inf"] {
            let wrong = text.replace(line, &format!("end = {end}"));
            let number = 1 + wrong.lines().position(|line| line == format!("end = {end}")).unwrap();
            let said = Case::parse(&wrong, "flow.toml", "").unwrap_err().to_string();
            assert!(said.contains(&format!("flow.toml:{number}:7")), "{said}");
            for words in ["time.end is", "a finite number above 0"] {
                assert!(said.contains(words), "{said}");
            }
        }
    }
    let case = Case::parse(text, "flow.toml", "").unwrap();
    let said = case.with("time.end", -1.0).unwrap_err().to_string();
    assert!(said.contains("time.end is -1.0") && !said.contains("turbulence"), "{said}");
}

/// Each tube has the forces of its own field, whatever another one is: what differs between two
/// runs of one seed is what was changed.
#[test]
fn the_force_on_a_tube_does_not_depend_on_another_one() {
    let own = Embedded::named("two-tubes").unwrap().case().unwrap();
    // Sixteen modes of each plane, half of them of either tube; the fields along y and z of the
    // left.
    assert_eq!(own.scene.loads.len(), 32);
    // Equal tubes share frequencies; one that is lighter or heavier changes the order of all modes.
    for added_mass in [0.564_999_9, 0.565_000_1, 0.6] {
        let changed = with(&own, "body.right.beam.added_mass", added_mass);
        for (number, (before, after)) in own.scene.loads.iter().zip(&changed.scene.loads).enumerate() {
            let [before, after] = [before, after].map(|load| table(load).force());
            let largest = before.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
            // Either sign of a shape is one; shapes are found to 1e-11.
            let same = |sign: f64| before.iter().zip(after).all(|(a, b)| (a - sign * b).abs() < 1e-8 * largest);
            assert!(number >= 16 || same(1.0) || same(-1.0), "{added_mass}: {number}");
        }
    }
}
