//! Base motion, the static start, and negative damping, against closed forms.
use signorini::case::Case;
use signorini::{Options, Run, Scene, Scheme, equilibrium, run};
use std::f64::consts::PI;
use std::path::Path;

fn case_in(text: &str, folder: &Path) -> Case {
    Case::parse(text, "base.toml", folder).unwrap_or_else(|error| panic!("{error}"))
}

fn case(text: &str) -> Case {
    case_in(text, Path::new(""))
}

fn made(scene: &Scene, scheme: &Scheme, step: f64) -> Run {
    run(scene, scheme, &Options::with_step(step)).unwrap_or_else(|error| panic!("{scheme:?}: {error}"))
}

fn last(run: &Run, probe: &str) -> f64 {
    *run.trajectory.probe(probe).unwrap().0.last().unwrap()
}

/// A folder with the table of a base motion.
fn shaken(rows: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("shake.csv"), format!("time_s,acceleration_m_per_s2\n{rows}")).unwrap();
    folder
}

const TUBE: &str = "[system.beam]\nlength = 2.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\n\
    inner_diameter = 0.016\nadded_mass = 0.3\nelements = 8\n";

#[test]
fn a_shaken_oscillator_meets_its_stop_when_the_closed_form_says() {
    // The built-in case: u = −(m/k)(a₀ + s t) + A cos + B sin in each half of the pulse, with 40
    // digits.
    let mut case = Case::embedded("base-pulse").unwrap();
    case.scene.duration = 0.2;
    let run = made(&case.scene, &Scheme::Event, 1e-4);
    let [first] = run.trajectory.contacts() else { panic!("{:?}", run.trajectory.contacts()) };
    // Some roundings of 0.1 s at a speed of 0.2 m/s, from displacements of 1e-2 m.
    assert!((first.start - 0.117_409_802_814_049_07).abs() < 1e-14, "{}", first.start);
    assert!((first.impulse - 0.373_370_368_626_165_9).abs() < 1e-13, "{}", first.impulse);
    // At the end of the pulse, where sums of instants round to 1e-13 s or so.
    let (q, v) = (run.trajectory.displacement().last().unwrap(), run.trajectory.velocity().last().unwrap());
    assert!((q - -0.003_497_103_514_337_992).abs() < 1e-14 && (v - 0.054_405_008_713_308_22).abs() < 1e-12, "{q} {v}");
    // moreau-jean of order 1 through the impact: a step of 1e-5 s at 0.4 m/s.
    let stepped = made(&case.scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-5);
    assert!((stepped.trajectory.displacement().last().unwrap() - q).abs() < 4e-6);
}

#[test]
fn a_free_structure_stays_behind_its_base_without_bending() {
    // No spring to the base: every point keeps its place in space, so the displacement relative to
    // the base is −∫∫a. Exactly so only if the inertia of the mesh is consistent with it.
    let folder = shaken("0,0\n0.01,2\n0.03,-1\n0.05,0\n");
    let fallen = |t: f64| {
        // Cubic pieces of a piecewise linear acceleration.
        let rows = [[0.0, 0.0], [0.01, 2.0], [0.03, -1.0], [0.05, 0.0]];
        let (mut u, mut v) = (0.0, 0.0);
        for pair in rows.windows(2) {
            let ([t0, a0], [t1, a1]) = (pair[0], pair[1]);
            let (dt, slope) = ((t.min(t1) - t0).max(0.0), (a1 - a0) / (t1 - t0));
            u += v * dt + a0 * dt * dt / 2.0 + slope * dt.powi(3) / 6.0;
            v += a0 * dt + slope * dt * dt / 2.0;
        }
        -u
    };
    let rest = "left = \"free\"\nright = \"free\"\n[[probe]]\nname = \"a\"\nat = { position = 0.0 }\n\
        [[probe]]\nname = \"b\"\nat = { position = 1.3 }\n[[load]]\nbase = { file = \"shake.csv\" }\n\
        [time]\nend = 0.05\nstep = 1e-4\n";
    let bar = "[system.bar]\nlength = 1.5\nyoungs_modulus = 2e11\ndensity = 7850.0\narea = 1e-4\nelements = 7\n";
    let chain = "[system.chain]\nmasses = [1.0, 3.0, 2.0]\nsprings = 5e3\n";
    let on_chain = rest
        .replace("left = \"free\"\nright = \"free\"\n", "")
        .replace("position = 0.0", "dof = 0")
        .replace("position = 1.3", "dof = 2");
    for text in [
        format!("{TUBE}{rest}"),
        format!("{bar}{rest}"),
        format!("{bar}mass_matrix = \"lumped\"\n{rest}"),
        format!("{chain}{on_chain}"),
    ] {
        let run = made(&case_in(&text, folder.path()).scene, &Scheme::Event, 1e-3);
        for probe in ["a", "b"] {
            let (found, expected) = (last(&run, probe), fallen(0.05));
            // Roundings of the elastic forces, up to 1e8 N/m times 1e-16 of the motion a step.
            assert!((found / expected - 1.0).abs() < 1e-8, "{text}\n{probe}: {found} {expected}");
        }
    }
}

#[test]
fn a_held_tube_settles_into_the_deflection_of_a_uniform_load() {
    // A steady acceleration for long against a heavily damped tube: 5 q L⁴/(384 E I) at the middle,
    // with q = a times the mass per metre, held ends included; in two planes along the direction.
    let folder = shaken("0,9.81\n10,9.81\n");
    let text = format!(
        "[system]\nplanes = 2\n{TUBE}left = \"pinned\"\nright = \"pinned\"\n[system.damping]\n\
         rayleigh = {{ mass = 60.0, stiffness = 1e-3 }}\n[[probe]]\nname = \"m\"\nat = {{ position = 1.0 }}\n\
         [[load]]\ndirection = 120\nbase = {{ file = \"shake.csv\" }}\n[time]\nend = 2.0\nstep = 1e-3\n"
    );
    let run = made(&case_in(&text, folder.path()).scene, &Scheme::MoreauJean { theta: 1.0 }, 1e-3);
    let area = PI / 4.0 * (0.02_f64.powi(2) - 0.016_f64.powi(2));
    let (metre, bending) = (7850.0 * area + 0.3, 2e11 * PI / 64.0 * (0.02_f64.powi(4) - 0.016_f64.powi(4)));
    let deflection = -5.0 * metre * 9.81 * 2.0_f64.powi(4) / (384.0 * bending);
    // Cubic elements are exact at nodes under an even load; damped by e^(−30 · 2).
    let [y, z] = ["m-y", "m-z"].map(|probe| last(&run, probe) / deflection);
    assert!((y - -0.5).abs() < 1e-8 && (z - 0.75_f64.sqrt()).abs() < 1e-8, "{y} {z}");
}

#[test]
fn matrices_are_shaken_through_their_influence() {
    let folder = shaken("0,0\n0.1,4\n0.2,0\n");
    std::fs::write(folder.path().join("m.csv"), "2,0\n0,3\n").unwrap();
    std::fs::write(folder.path().join("k.csv"), "500,-200\n-200,200\n").unwrap();
    let rest = "[[probe]]\nname = \"tip\"\nat = { dof = 1 }\n[time]\nend = 1.0\nstep = 1e-3\n[[load]]\n";
    let matrices = format!(
        "[system.matrices]\nmass = \"m.csv\"\nstiffness = \"k.csv\"\n{rest}\
         base = {{ file = \"shake.csv\", influence = {{ row = [[0, 1.0], [1, 1.0]] }} }}\n"
    );
    let chain = format!(
        "[system.chain]\nmasses = [2.0, 3.0]\nsprings = 200.0\nleft = {{ stiffness = 300.0 }}\n\
         {rest}base = {{ file = \"shake.csv\" }}\n"
    );
    let [a, b] =
        [matrices, chain].map(|text| last(&made(&case_in(&text, folder.path()).scene, &Scheme::Event, 1e-3), "tip"));
    assert!((a / b - 1.0).abs() < 1e-12 && a.abs() > 1e-4, "{a} {b}");
}

#[test]
fn the_static_start_is_the_closed_form_and_stays() {
    // A spring of 100 N/m under 3 N would rest at 30 mm; a rigid wall at 5 mm, or an elastic one of
    // 500 N/m there, holds it.
    let text = |wall: &str, load: f64| {
        format!(
            "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n{wall}\
             [[load]]\nconstant = {{ force = {load:?} }}\n[initial]\nequilibrium = true\n[time]\n\
             end = 1.0\nstep = 1e-3\n"
        )
    };
    let wall = "[[wall]]\nname = \"w\"\nside = \"upper\"\nposition = 5e-3\n";
    for (text, rests) in [
        (text("", 3.0), 3e-2),
        (text(wall, 3.0), 5e-3),
        (text(wall, -3.0), -3e-2),
        (text(&format!("{wall}stiffness = 500.0\n"), 3.0), (3.0 + 500.0 * 5e-3) / 600.0),
        // No spring at all: the wall alone holds it, and preload from a wall beyond the rest.
        (text(wall, 3.0).replace("stiffness = 100.0", "stiffness = 0.0"), 5e-3),
        (text(&wall.replace("5e-3", "-2e-3"), 0.0), -2e-3),
    ] {
        let case = case(&text);
        let found = case.scene.initial.q[0];
        assert!((found - rests).abs() < 1e-12 * rests.abs(), "{text}: {found} {rests}");
        for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Event] {
            let run = made(&case.scene, &scheme, 1e-3);
            let moved = run.trajectory.displacement().iter().map(|q| (q - rests).abs()).fold(0.0, f64::max);
            assert!(moved < 1e-10 * rests.abs(), "{scheme:?} {text}: {moved:e}");
        }
    }
}

#[test]
fn a_tube_pressed_between_flats_starts_at_rest_whatever_its_modes() {
    // The support's centre is off by more than its gap, and the tube sags: preload from the start.
    let text = |modes: usize| {
        format!(
            "[system]\nplanes = 2\nmodes = {modes}\n{TUBE}left = \"pinned\"\nright = \"clamped\"\n\
             [system.damping]\nratio = 0.02\n\
             [[support]]\nname = \"s\"\nat = {{ position = 0.9 }}\nshape = \"flats\"\nsides = 3\n\
             turn = 20\ngap = 1e-3\n\
             centre = [3e-3, -1e-3]\nrestitution = 0.3\n\
             [[load]]\nat = {{ spread = [0.0, 2.0] }}\ndirection = 200\nconstant = {{ force = 15.0 }}\n\
             [initial]\nequilibrium = true\n[time]\nend = 0.2\nstep = 1e-4\n"
        )
    };
    for modes in [2, 4, 14] {
        let case = case(&text(modes));
        let run = made(&case.scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-4);
        assert!(run.findings.is_empty(), "{:?}", run.findings);
        assert!(run.trajectory.contacts().iter().any(|contact| contact.end.is_none()), "{modes}: nothing pressed");
        for probe in ["s-y", "s-z"] {
            let (q, _) = run.trajectory.probe(probe).unwrap();
            let moved = q.iter().map(|x| (x - q[0]).abs()).fold(0.0, f64::max);
            // Rounding of forces of 15 N over a stiffness of 1e4 N/m, kept as a vibration.
            assert!(moved < 1e-11, "{modes} {probe}: {moved:e}");
        }
    }
    // The whole structure too: gradient of the energy against the walls' forces.
    let whole = case(&text(14)).truncated.unwrap().whole.scene;
    let q = equilibrium(&whole).unwrap();
    let mut open = vec![0.0; q.len()];
    whole.system.add_stiffness(-1.0, &q, &mut open);
    signorini::Loads::new(&whole.loads).add_force(0.0, 1.0, &mut open);
    // What is open lies in the span of the rows of walls that are touched, and pushes inwards.
    let touched: Vec<_> = whole.walls.iter().filter(|wall| wall.gap(wall.row().dot(&q)) < 1e-12).collect();
    assert!(!touched.is_empty() && touched.len() < 3);
    // K q = f + Σ gᵀr: the r of least squares, by the normal equations of two rows or one.
    let dense = |wall: &signorini::Wall| {
        let mut row = vec![0.0; q.len()];
        wall.row().entries().iter().for_each(|&(i, weight)| row[i] += weight);
        row
    };
    let rows: Vec<Vec<f64>> = touched.iter().map(|wall| dense(wall)).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let along: Vec<f64> = rows.iter().map(|row| -dot(row, &open)).collect();
    let force: Vec<f64> = match rows.as_slice() {
        [g] => vec![along[0] / dot(g, g)],
        [g, h] => {
            let (a, b, c) = (dot(g, g), dot(g, h), dot(h, h));
            let d = a * c - b * b;
            vec![(c * along[0] - b * along[1]) / d, (a * along[1] - b * along[0]) / d]
        }
        _ => panic!("{touched:?}"),
    };
    for ((wall, row), r) in touched.iter().zip(&rows).zip(&force) {
        assert!(r * wall.side().sign() > 0.1, "{}: {r} N", wall.name);
        open.iter_mut().zip(row).for_each(|(open, g)| *open += r * g);
    }
    // Nothing else is open: roundings of 1e7 N/m times 1e-3 m.
    assert!(open.iter().all(|x| x.abs() < 1e-8), "{open:?}");
}

#[test]
fn what_nothing_holds_has_no_static_start() {
    let text = "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 0.0\n[[load]]\nconstant = { force = 1.0 }\n\
        [initial]\nequilibrium = true\n[time]\nend = 1.0\nstep = 1e-3\n";
    let said = Case::parse(text, "free.toml", "").unwrap_err().to_string();
    assert!(said.contains("--> free.toml:8:15") && said.contains("neither its stiffness nor a wall"), "{said}");
    let apart = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 10.0\n\
        [[support]]\nname = \"a\"\nshape = \"flats\"\nsides = 4\ngap = 1e-3\n\
        [[support]]\nname = \"b\"\nshape = \"flats\"\nsides = 4\nturn = 45\ngap = 1e-3\ncentre = [1e-2, 0.0]\n\
        [initial]\nequilibrium = true\n[time]\nend = 1.0\nstep = 1e-3\n";
    let said = Case::parse(apart, "apart.toml", "").unwrap_err().to_string();
    assert!(said.contains("initial.equilibrium") && said.contains("a-flat-") && said.contains("b-flat-"), "{said}");
}

#[test]
fn negative_damping_grows_as_the_closed_form_and_walls_limit_it() {
    let text = |ratio: f64, wall: &str| {
        format!(
            "[system.modal]\nfrequencies = [3.0, 10.0]\ndamping_ratios = [{ratio:?}, 0.02]\n\
             shapes = {{ tip = [1.0, 0.4] }}\n{wall}\
             [[probe]]\nname = \"tip\"\nat = {{ point = \"tip\" }}\n[initial]\n\
             velocity = [0.01, 0.0]\n[time]\nend = 4.0\nstep = 1e-4\n"
        )
    };
    let free = case(&text(-0.03, ""));
    // q = v₀/ω_d e^{ζωt} sin ω_d t of the first mode; the second stays at rest.
    let (omega, zeta) = (2.0 * PI * 3.0, 0.03_f64);
    let damped = omega * (1.0 - zeta * zeta).sqrt();
    let exact = 0.01 / damped * (zeta * omega * 4.0).exp() * (damped * 4.0).sin();
    let run = made(&free.scene, &Scheme::Event, 1e-3);
    assert!((last(&run, "tip") / exact - 1.0).abs() < 1e-11, "{} {exact}", last(&run, "tip"));
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::GeneralizedAlpha { rho: 1.0 }, Scheme::PaoliSchatzman] {
        let run = made(&free.scene, &scheme, 1e-4);
        // Order 2: (ωh)²/12 of a phase of 75 rad, 2e-5.
        assert!((last(&run, "tip") / exact - 1.0).abs() < 1e-3, "{scheme:?}: {}", last(&run, "tip"));
        assert!(run.findings.is_empty(), "{scheme:?}: {:?}", run.findings);
    }
    let walls = "[[wall]]\nname = \"w\"\nat = { point = \"tip\" }\nside = \"both\"\ngap = 1e-3\nrestitution = 0.6\n";
    let held = case(&text(-0.03, walls));
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Event] {
        let run = made(&held.scene, &scheme, 1e-4);
        let (q, _) = run.trajectory.probe("tip").unwrap();
        assert!(q.iter().all(|x| x.abs() < 1.01e-3) && run.trajectory.contacts().len() > 10, "{scheme:?}");
        assert!(run.findings.is_empty(), "{scheme:?}: {:?}", run.findings);
    }
    let notes = |case: &Case| made(&case.scene, &Scheme::Event, 1e-3).notes;
    let says = |note: &String| note.contains("3.0000 Hz") && note.contains("unstable");
    assert!(notes(&free).iter().any(says), "{:?}", notes(&free));
    assert!(!notes(&case(&text(0.03, ""))).iter().any(|note| note.contains("unstable")));
}

#[test]
fn negative_ratios_of_a_tube_belong_to_its_modes() {
    let text = |modes: &str, ratios: &str| {
        format!(
            "[system]\nplanes = 2\n{modes}{TUBE}left = \"pinned\"\nright = \"pinned\"\n\
             [system.damping]\nratios = {ratios}\n\
             [[probe]]\nname = \"m\"\nat = {{ position = 1.0 }}\n[time]\nend = 1.0\nstep = 1e-3\n"
        )
    };
    let cut = case(&text("modes = 3\n", "[-0.01, 0.02]"));
    let signorini::System::Structure(structure) = &cut.scene.system else { panic!() };
    let (c, k) = (structure.damping.diagonal_entries(), structure.stiffness.diagonal_entries());
    let ratios: Vec<f64> = c.iter().zip(&k).map(|(c, k)| 0.5 * c / k.sqrt()).collect();
    for (found, asked) in ratios.iter().zip([-0.01, -0.01, 0.02, 0.02, 0.02, 0.02]) {
        assert!((found - asked).abs() < 1e-15, "{ratios:?}");
    }
    let said = Case::parse(&text("", "[-0.01, 0.02]"), "whole.toml", "").unwrap_err().to_string();
    assert!(said.contains("value 1 is -0.01") && said.contains("cut to modes"), "{said}");
    let said = Case::parse(&text("modes = 3\n", "[-1.0]"), "minus.toml", "").unwrap_err().to_string();
    assert!(said.contains("above -1"), "{said}");
}

#[test]
fn a_base_that_moves_by_a_sine_is_felt_by_its_closed_form() {
    let text = "[system.oscillator]\nmass = 2.0\ndamping = 0.0\nstiffness = 800.0\n[[load]]\n\
        base = { amplitude = 3.0, frequency = 1.5 }\n[time]\nend = 1.3\nstep = 1e-3\n";
    let run = made(&case(text).scene, &Scheme::Event, 1e-3);
    // u = −a/(ω² − Ω²) (sin Ωt − (Ω/ω) sin ωt), from rest.
    let (omega, forced, t) = (20.0_f64, 3.0 * PI, 1.3);
    let wanted = -3.0 / (omega * omega - forced * forced) * ((forced * t).sin() - forced / omega * (omega * t).sin());
    // Some roundings of amplitudes of 1e-2 m.
    assert!((last(&run, "") - wanted).abs() < 1e-14, "{} for {wanted}", last(&run, ""));
    // With a phase of a quarter it begins at its amplitude.
    let turned = text.replace("frequency = 1.5", "frequency = 0.0, phase = 1.5707963267948966");
    let run = made(&case(&turned).scene, &Scheme::Event, 1e-3);
    let wanted = -3.0 / (omega * omega) * (1.0 - (omega * t).cos());
    assert!((last(&run, "") - wanted).abs() < 1e-14, "{} for {wanted}", last(&run, ""));
}

#[test]
fn gravity_bends_a_tube_as_its_weight_does_and_presses_it_into_a_support() {
    let ends = "left = \"pinned\"\nright = \"pinned\"\n";
    let rest = "[initial]\nequilibrium = true\n[[probe]]\nname = \"middle\"\nat = { position = 1.0 }\n\
        [time]\nend = 0.1\nstep = 1e-3\n";
    let down = case(&format!("{TUBE}{ends}[[load]]\ngravity = {{ acceleration = 9.81 }}\n{rest}"));
    // 5 m′ g L⁴/(384 EI): exact at nodes under consistent nodal forces.
    let inertia = PI / 64.0 * (0.02_f64.powi(4) - 0.016_f64.powi(4));
    let weight = 9.81 * (7850.0 * PI / 4.0 * (0.02_f64.powi(2) - 0.016_f64.powi(2)) + 0.3);
    let wanted = 5.0 * weight * 16.0 / (384.0 * 2e11 * inertia);
    let found = down.scene.probes[0].at.dot(&down.scene.initial.q);
    assert!((found / wanted - 1.0).abs() < 1e-9, "{found} for {wanted}");
    // In two planes, towards −z.
    let planes = format!(
        "[system]\nplanes = 2\n{TUBE}{ends}[[load]]\ndirection = 270\ngravity = {{ acceleration = 9.81 }}\n{rest}"
    );
    let both = case(&planes);
    let seen =
        |name: &str| both.scene.probes.iter().find(|probe| probe.name == name).unwrap().at.dot(&both.scene.initial.q);
    assert!(seen("middle-y").abs() < 1e-12 * wanted && (seen("middle-z") / wanted + 1.0).abs() < 1e-9);
    // A mass on a stop weighs m g.
    let stop = "[system.oscillator]\nmass = 2.0\ndamping = 0.0\nstiffness = 0.0\n\
        [[wall]]\nname = \"floor\"\nside = \"upper\"\nposition = 0.0\nrestitution = 0.0\n\
        [[load]]\ngravity = { acceleration = 9.81 }\n[time]\nend = 0.5\nstep = 1e-3\n";
    let run = made(&case(stop).scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3);
    assert!((run.trajectory.impulse("floor").unwrap() + 2.0 * 9.81 * 0.5).abs() < 1e-12);
}

#[test]
fn a_random_motion_of_the_base_gives_the_mean_square_of_random_vibration() {
    // White acceleration of the one-sided density S on an oscillator: the displacement relative to
    // the base has the mean square m² S/(4ck). The lines have fixed amplitudes, so that the scatter
    // is that of the start at rest: with 2ζω = 8/s over 400 s some per cent.
    let text = "[system.oscillator]\nmass = 2.0\ndamping = 16.0\nstiffness = 2e4\n[time]\nend = 400.0\n\
        step = 1e-3\n[[load]]\nbase = { psd = [[0.05, 0.3], [150.0, 0.3]], seed = 4 }\n";
    let run = made(&case(text).scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3);
    let q = run.trajectory.displacement();
    let found = (q.iter().map(|q| q * q).sum::<f64>() / q.len() as f64).sqrt();
    let expected = (4.0 * 0.3 / (4.0 * 16.0 * 2e4_f64)).sqrt();
    assert!((found / expected - 1.0).abs() < 0.03, "{found} m, not {expected} m");
}

#[test]
fn a_random_motion_of_the_base_is_a_random_force_on_every_mass() {
    // Masses of 1, 2 and 4 kg: the same acceleration on each, as one force of 7 kg times it through
    // the row M/7 kg. Realisations raise its seed.
    let rest = "[system.chain]\nmasses = [1.0, 2.0, 4.0]\nsprings = 1e4\nleft = { stiffness = 1e4 }\n\
        [[wall]]\nname = \"stop\"\nat = { dof = 2 }\nside = \"upper\"\nposition = 2e-3\nrestitution = 0.5\n\
        [[probe]]\nname = \"tip\"\nat = { dof = 2 }\n[time]\nend = 2.0\nstep = 1e-3\n[[load]]\n";
    let base = case(&format!("{rest}base = {{ rms = 3.0, from = 2.0, to = 40.0, seed = 7 }}\n"));
    let force = |seed: u64| {
        let row = "at = { row = [[0, 0.14285714285714285], [1, 0.2857142857142857], [2, 0.5714285714285714]] }";
        case(&format!("{rest}{row}\nrandom = {{ rms = 21.0, from = 2.0, to = 40.0, seed = {seed} }}\n"))
    };
    for number in [1, 2] {
        let realisation = base.realisation(number).unwrap();
        let [a, b] = [&realisation.scene, &force(6 + number).scene].map(|scene| made(scene, &Scheme::Event, 1e-3));
        assert!(a.trajectory.contacts().len() > 5, "a test of nothing");
        // The products of mass and acceleration round otherwise, and impacts magnify that.
        let largest = |run: &Run| last(run, "tip");
        assert!((largest(&a) - largest(&b)).abs() < 1e-9, "{} {}", largest(&a), largest(&b));
        let seed = &realisation.document.get(&"load.1.base.seed".parse().unwrap()).unwrap().unwrap();
        assert_eq!(seed.number(), Some((6 + number) as f64));
    }
}

#[test]
fn motions_of_the_base_and_weights_that_make_no_sense_are_refused() {
    let said = |load: &str| {
        let system = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1.0\n";
        let text = format!("{system}[[load]]\n{load}\n[time]\nend = 1.0\nstep = 1e-3\n");
        Case::parse(&text, "wrong.toml", "").unwrap_err().to_string()
    };
    for (load, words) in [
        ("base = { }", ["base has no motion", "amplitude (m/s^2)"]),
        ("base = { file = \"no.csv\", amplitude = 1.0 }", ["base has two motions", "file"]),
        ("base = { rms = 1.0, from = 1.0, to = 9.0, amplitude = 1.0 }", ["base has two motions", "psd"]),
        ("base = { psd = [[1.0, 1.0], [9.0, 1.0]], file = \"no.csv\" }", ["base has two motions", "psd"]),
        ("base = { seed = 1 }", ["base has no density", "rms (m/s^2)"]),
        ("base = { rms = 1.0, from = 1.0 }", ["`to` is missing in load 1: base", "rms (m/s^2)"]),
        ("base = { rms = -2.0, from = 1.0, to = 9.0 }", ["rms is -2.0", "above 0"]),
        ("base = { psd = [[1.0, 1.0]] }", ["1 pairs", "two pairs"]),
        ("base = { amplitude = 1.0, frequency = 1.0, scale = 9.81 }", ["no file that this key reads", "file"]),
        (
            "base = { rms = 1.0, from = 1.0, to = 9.0, walls = \"fixed\" }",
            ["random or read from a file", "amplitude, frequency"],
        ),
        ("base = { amplitude = 1.0 }", ["frequency is missing", "expected frequency"]),
        ("base = { frequency = 1.0 }", ["amplitude is missing", "expected amplitude"]),
        ("base = { amplitude = nan, frequency = 1.0 }", ["amplitude is not finite", "expected amplitude"]),
        ("base = { amplitude = 1.0, frequency = -1.0 }", ["frequency is -1.0", "0 or more"]),
        ("base = { amplitude = 1.0, frequency = 1.0, phase = inf }", ["phase is not finite", "expected phase"]),
        ("gravity = { }", ["`acceleration` is missing", "9.81"]),
        ("gravity = { acceleration = inf }", ["acceleration is not finite", "9.81"]),
        (
            "gravity = { acceleration = 9.81, influence = { row = [[0, 1.0]] } }",
            ["gravity: influence beside", "expected no"],
        ),
        ("at = { dof = 0 }\ngravity = { acceleration = 9.81 }", ["a place and a gravity", "expected no at"]),
        ("direction = 0\ngravity = { acceleration = 9.81 }", ["has a direction", "planes = 2"]),
    ] {
        let said = said(load);
        assert!(words.iter().all(|word| said.contains(word)) && said.contains("--> wrong.toml:"), "{load}: {said}");
    }
}

/// A base that shakes by a sine, under walls that move along or stay in space; 40 m/s² at 3 Hz.
fn sine(walls: &str) -> String {
    format!("base = {{ amplitude = 40.0, frequency = 3.0, phase = 0.4, walls = \"{walls}\"INFLUENCE }}")
}

/// Displacement and velocity of the base, whose mean is 0.
fn base(t: f64) -> [f64; 2] {
    let omega = 6.0 * PI;
    [-40.0 / (omega * omega) * (omega * t + 0.4).sin(), -40.0 / omega * (omega * t + 0.4).cos()]
}

#[test]
fn displacements_in_space_are_those_relative_to_the_base_and_its_own() {
    // Without contact the two coordinates tell of the same motion, of every system that has them.
    let oscillator = "[system.oscillator]\nmass = 2.0\ndamping = 3.0\nstiffness = 800.0\n";
    let chain = "[system.chain]\nmasses = [1.0, 2.0]\nsprings = [500.0]\nleft = { stiffness = 300.0 }\n\
        [system.damping]\nrayleigh = { mass = 0.4, stiffness = 2e-3 }\n";
    let modal = "[system.modal]\nfrequencies = [2.0, 5.0]\nmasses = [1.0, 3.0]\ndamping_ratios = 0.05\n\
        shapes = { tip = [1.0, -0.5] }\n";
    for (system, at, shares) in [
        (oscillator, "", vec![1.0]),
        (chain, "at = { dof = 1 }\n", vec![1.0, 1.0]),
        (modal, "at = { point = \"tip\" }\n", vec![0.8, 0.3]),
    ] {
        let influence = if system == modal { ", influence = { row = [[0, 0.8], [1, 0.3]] }" } else { "" };
        let text = |walls: &str| {
            let load = sine(walls).replace("INFLUENCE", influence);
            let probe = if at.is_empty() { String::new() } else { format!("[[probe]]\nname = \"p\"\n{at}") };
            let time = "[time]\nend = 0.7\nstep = 1e-3\noutput_times = [0.1, 0.33, 0.7]\n";
            case(&format!("{system}[[load]]\n{load}\n{probe}{time}")).scene
        };
        let [mut space, mut relative] = [text("fixed"), text("moving")];
        let n = shares.len();
        space.initial.q = (0..n).map(|i| 2e-3 * (i as f64 + 1.0)).collect();
        space.initial.v = vec![0.05; n];
        let [b, rate] = base(0.0);
        relative.initial.q = space.initial.q.iter().zip(&shares).map(|(x, share)| x - share * b).collect();
        relative.initial.v = space.initial.v.iter().zip(&shares).map(|(x, share)| x - share * rate).collect();
        let [space, relative] =
            [space, relative].map(|scene| (made(&scene, &Scheme::Event, 1e-3).trajectory, scene.probes[0].at.clone()));
        let along = space.1.dot(&shares);
        let [space, relative] = [space.0.output().clone(), relative.0.output().clone()];
        for (k, &t) in space.time.iter().enumerate() {
            let [b, rate] = base(t);
            let (q, v) = (space.displacement[0][k] - along * b, space.velocity[0][k] - along * rate);
            // Displacements of 0.1 m and velocities of 2 m/s, over a thousand roundings.
            assert!((q - relative.displacement[0][k]).abs() < 1e-13, "{system} {t}: {q}, {relative:?}");
            assert!((v - relative.velocity[0][k]).abs() < 1e-12, "{system} {t}: {v}, {relative:?}");
        }
    }
}

/// Of beams and bars with held ends, whose inertia reaches the neighbours, and with springs.
#[test]
fn beams_and_bars_under_fixed_walls_have_the_motion_relative_to_the_base_and_that_of_the_base() {
    let damped = "[system.damping]\nrayleigh = { mass = 0.4, stiffness = 1e-4 }\n";
    let bar = "[system.bar]\nlength = 1.0\nyoungs_modulus = 1e6\ndensity = 1000.0\narea = 1e-3\nelements = 5\n\
        left = \"clamped\"\nright = { stiffness = 300.0 }\n";
    let beam = format!("{TUBE}left = \"pinned\"\nright = \"clamped\"\n");
    let sprung = format!("{TUBE}left = {{ stiffness = 3e4, rotational = 10.0 }}\nright = \"free\"\n");
    for system in [bar, &beam, &sprung] {
        let text = |walls: &str| {
            let load = sine(walls).replace("INFLUENCE", "");
            let probe = "[[probe]]\nname = \"p\"\nat = \"each\"\n";
            let time = "[time]\nend = 0.3\nstep = 1e-3\noutput_times = [0.1, 0.23, 0.3]\n";
            case(&format!("{system}{damped}[[load]]\n{load}\n{probe}{time}")).scene
        };
        let [space, mut relative] = [text("fixed"), text("moving")];
        // The start in space is 0: relative to the base each deflection is -b.
        let mut share = vec![0.0; relative.initial.q.len()];
        for &(dof, weight) in space.probes.iter().flat_map(|probe| probe.at.entries()) {
            share[dof] = if weight > 0.5 { 1.0 } else { share[dof] };
        }
        let [b, rate] = base(0.0);
        relative.initial.q = share.iter().map(|share| -share * b).collect();
        relative.initial.v = share.iter().map(|share| -share * rate).collect();
        let [space, relative] =
            [space, relative].map(|scene| made(&scene, &Scheme::Event, 1e-3).trajectory.output().clone());
        for (k, &t) in space.time.iter().enumerate() {
            let [b, _] = base(t);
            for (x, u) in space.displacement.iter().zip(&relative.displacement) {
                // Displacements of 0.1 m; stiffnesses of elements of 1e8 times those of the modes.
                assert!((x[k] - b - u[k]).abs() < 1e-9, "{system} {t}: {} and {}", x[k] - b, u[k]);
            }
        }
    }
}

#[test]
fn a_stop_in_space_is_struck_when_the_closed_form_says() {
    let text = format!(
        "[system.oscillator]\nmass = 2.0\ndamping = 0.0\nstiffness = 800.0\n[[load]]\n{}\n[[wall]]\nname = \"stop\"\n\
         side = \"upper\"\nposition = 0.05\nrestitution = 0.5\n[time]\nend = 1.0\nstep = 1e-3\n",
        sine("fixed").replace("INFLUENCE", "")
    );
    let case = case(&text);
    assert!(case.notes().iter().any(|note| note.contains("those in space")), "{:?}", case.notes());
    let run = made(&case.scene, &Scheme::Event, 1e-3);
    // ẍ + ω₀² x = ω₀² b from rest: x = P sin(ωt + φ) + C cos ω₀t + D sin ω₀t.
    let (natural, omega) = (20.0_f64, 6.0 * PI);
    let p = natural * natural * (-40.0 / (omega * omega)) / (natural * natural - omega * omega);
    let (c, d) = (-p * 0.4f64.sin(), -p * omega * 0.4f64.cos() / natural);
    let x = |t: f64| p * (omega * t + 0.4).sin() + c * (natural * t).cos() + d * (natural * t).sin();
    let first = run.trajectory.contacts()[0].start;
    let crossed = (0..100_000).map(|k| 1e-5 * f64::from(k)).find(|&t| x(t) > 0.05).expect("a contact");
    assert!((first - crossed).abs() < 1.1e-5, "{first}, closed form {crossed}");
    // At the instant found the closed form stands at the stop: roundings of sums of 1 m.
    assert!((x(first) - 0.05).abs() < 1e-13, "{}", x(first));
}

#[test]
fn walls_stay_fixed_only_where_the_forces_at_the_base_are_known() {
    let folder = shaken("0,0\n0.01,2\n");
    let oscillator = "[system.oscillator]\nmass = 2.0\ndamping = 0.0\nstiffness = 800.0\n";
    let chain = "[system.chain]\nmasses = [1.0, 2.0]\nsprings = [500.0]\nleft = { stiffness = 300.0 }\n";
    let sine = |more: &str| format!("amplitude = 1.0, frequency = {more}");
    for (system, base, words) in [
        (
            oscillator.to_owned(),
            "file = \"shake.csv\"".to_owned(),
            ["read from a file", "amplitude, frequency and phase"],
        ),
        (oscillator.to_owned(), sine("0.0"), ["leaves without end", "above 0"]),
        (oscillator.replace("800.0", "0.0"), sine("2.0"), ["nothing ties", "to the ground"]),
        (format!("[system]\nmodes = 1\n{chain}"), sine("2.0"), ["reduced to modes", "whole stiffness"]),
        (format!("{TUBE}left = \"free\"\nright = \"free\"\n"), sine("2.0"), ["nothing ties", "to the ground"]),
    ] {
        let time = "[time]\nend = 1.0\nstep = 1e-3\n";
        let text = format!("{system}[[load]]\nbase = {{ {base}, walls = \"fixed\" }}\n{time}");
        let error = Case::parse(&text, "base.toml", folder.path()).expect_err(words[0]).to_string();
        assert!(words.iter().all(|word| error.contains(word)) && error.contains("--> base.toml:"), "{error}");
    }
    let text = format!("{oscillator}[[load]]\nbase = {{ amplitude = 1.0, frequency = 2.0, walls = \"free\" }}\n");
    let error = Case::parse(&format!("{text}[time]\nend = 1.0\nstep = 1e-3\n"), "base.toml", "").unwrap_err();
    assert!(error.to_string().contains("expected \"moving\" or \"fixed\""), "{error}");
}

#[test]
fn bases_whose_walls_differ_are_refused() {
    let base = |walls: &str| format!("[[load]]\nbase = {{ amplitude = 2.0, frequency = 3.0{walls} }}\n");
    let oscillator = "[system.oscillator]\nmass = 2.0\ndamping = 0.0\nstiffness = 800.0\n";
    let constant = "[[load]]\nconstant = { force = 1.0 }\n";
    let parsed = |first: &str, second: &str| {
        let time = "[time]\nend = 1.0\nstep = 1e-3\n";
        Case::parse(&format!("{oscillator}{}{constant}{}{time}", base(first), base(second)), "base.toml", "")
    };
    let (fixed, moving) = (", walls = \"fixed\"", ", walls = \"moving\"");
    for (first, second) in [(fixed, ""), ("", fixed), (fixed, moving), (moving, fixed)] {
        let error = parsed(first, second).unwrap_err().to_string();
        let words = ["load 3: walls over the base are", "those of load 1 are", "expected the same `walls`"];
        assert!(words.iter().all(|word| error.contains(word)) && error.contains("--> base.toml:10:"), "{error}");
    }
    assert!(parsed(fixed, fixed).is_ok() && parsed("", moving).is_ok());
}
