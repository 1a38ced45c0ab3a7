//! The case files that come with the crate: each gives the scene that it describes.
use signorini::case::{Case, Embedded};
use signorini::case::{Model, Place};
use signorini::{Chain, Damping, Load, LoadKind, Probe, Row, Scene, Wall};
use signorini::{Integrator, PenaltyLaw};
use std::fs;
use std::path::Path;

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cases"))
}

fn embedded(name: &str) -> Case {
    Case::embedded(name).unwrap_or_else(|error| panic!("{error}"))
}

fn source(end: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_duration(end)
}

fn between_rigid_walls(end: f64) -> Scene {
    source(end).with_wall(Wall::upper("upper", 5e-3)).with_wall(Wall::lower("lower", -5e-3))
}

fn sine() -> Load {
    Load::harmonic(3.0, 5.0, 0.0)
}

fn quartic() -> Vec<PenaltyLaw> {
    [1e-12, 1e-9, 1e-6].map(|epsilon| PenaltyLaw::Quartic { epsilon }).to_vec()
}

#[test]
fn every_file_of_the_folder_is_embedded_and_reads_the_same() {
    let mut names: Vec<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    let mut known: Vec<String> = Embedded::all().iter().map(|case| case.name.to_owned()).collect();
    known.sort();
    assert_eq!(names, known);
    for name in names {
        let read = Case::read(folder().join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, embedded(&name));
        assert_eq!(read.name, name);
        assert!(read.title.is_some() && read.source.is_some(), "{name}");
        assert!(read.time.sample.is_some(), "{name}");
    }
    assert!(Case::embedded("no-such-case").is_err_and(|e| e.to_string().contains("bouncing-ball")));
}

#[test]
fn the_page_about_the_cases_names_each_of_them() {
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    for case in Embedded::all() {
        assert!(page.contains(&format!("`{}`", case.name)), "{}", case.name);
    }
}

#[test]
fn linear_cases_have_no_walls() {
    let case = embedded("linear-sine");
    assert_eq!(case.scene, source(10.0).with_load(sine()));
    assert_eq!((case.time.step, case.time.sample, case.time.statistics_from), (1e-4, Some(1e-3), 0.0));
    assert_eq!(embedded("linear-impulse").scene, source(10.0).with_load(Load::impulse(0.1, 0.0)));
}

#[test]
fn the_main_scene_stands_between_rigid_walls_of_restitution_1() {
    for (name, end) in [("rigid-walls-sine", 10.0), ("penalty-epsilon", 10.0), ("independent-code", 2.0)] {
        let case = embedded(name);
        assert_eq!(case.scene, between_rigid_walls(end).with_load(sine()), "{name}");
        assert_eq!(case.penalty.laws, quartic(), "{name}");
    }
    assert_eq!(embedded("penalty-epsilon").penalty.integrator, Some(Integrator::DiscreteGradient));
    let case = embedded("rigid-walls-impulse");
    assert_eq!(case.scene, between_rigid_walls(10.0).with_load(Load::impulse(0.1, 0.0)));
    assert!(Embedded::named("rigid-walls-impulse").is_ok_and(|case| case.text.contains("ASSUMED")));
}

#[test]
fn the_elastic_wall_is_as_stiff_as_the_oscillator() {
    let case = embedded("elastic-wall");
    let walls = [Wall::upper("upper", 5e-3).with_elasticity(100.0, 0.0), Wall::lower("lower", -5e-3)];
    let scene = walls.into_iter().fold(source(10.0), Scene::with_wall);
    assert_eq!(case.scene, scene.with_load(sine()));
    assert_eq!(case.penalty.laws, quartic());
}

#[test]
fn the_cases_of_the_field_are_the_published_ones() {
    let ball = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(10.0);
    assert_eq!(embedded("bouncing-ball").scene, ball);
    let sdnd101 = Scene::oscillator(100.0, 0.0, 1e4)
        .with_wall(Wall::upper("stop", 0.0).with_elasticity(1e6, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.5);
    assert_eq!(embedded("code-aster-sdnd101").scene, sdnd101);
    let sdnd108a = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", -2.0).with_elasticity(100.0, 0.0))
        .with_load(Load::constant(-10.0))
        .with_initial(&[0.0], &[-1.0])
        .with_duration(1.1);
    assert_eq!(embedded("code-aster-sdnd108a").scene, sdnd108a);
    let siconos = Scene::oscillator(1e-3, 0.0, 100.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81e-3))
        .with_initial(&[1.0], &[0.0])
        .with_duration(0.1);
    assert_eq!(embedded("siconos-oscillator").scene, siconos);
}

#[test]
fn the_tabulated_pulse_reads_its_table() {
    let case = embedded("tabulated-pulse");
    let [Load { kind: LoadKind::Table(table), .. }] = case.scene.loads.as_slice() else {
        panic!("{:?}", case.scene.loads);
    };
    assert_eq!(table.time(), [0.0, 0.01, 0.02, 0.03, 0.04, 0.05]);
    assert_eq!(table.force(), [0.0, 5000.0, 4200.0, 2600.0, 1100.0, 0.0]);
    assert_eq!(case.scene.walls, [Wall::upper("restraint", 0.01).with_elasticity(2e6, 1000.0)]);
}

#[test]
fn the_chains_are_those_of_the_benchmark() {
    for n in [20, 200] {
        let case = embedded(&format!("chain-{n}"));
        let chain = Chain { masses: vec![1.0; n], springs: vec![1e4; n - 1], grounds: [1e4; 2] };
        let damping = Damping::Rayleigh { mass: 0.0, stiffness: 1e-5 };
        let structure = chain.structure().unwrap().with_damping(&damping).unwrap();
        assert_eq!(case.scene.system, structure.into());
        assert_eq!(case.scene.walls.len(), 2 * n);
        for (i, pair) in case.scene.walls.chunks(2).enumerate() {
            let wall = |name: &str, position: f64| {
                let wall = if position > 0.0 { Wall::upper(name, position) } else { Wall::lower(name, position) };
                wall.with_restitution(0.0).at(Row::dof(i))
            };
            assert_eq!(pair, [wall(&format!("box-{i}-upper"), 1e-3), wall(&format!("box-{i}-lower"), -1e-3)]);
        }
        assert_eq!(case.scene.loads, [Load::harmonic(50.0, 5.0, 0.0)]);
        assert_eq!(case.time.step, 1e-3);
    }
}

#[test]
fn the_bar_starts_compressed_above_its_wall() {
    let case = embedded("bar-impact");
    let scene = &case.scene;
    // One eighth of the elastic energy of a strain of 1/2, E A L = 1: exact, as the profile is
    // linear.
    assert!((0.5 * scene.system.stiffness_form(&scene.initial.q, &scene.initial.q) - 0.125).abs() < 1e-14);
    assert!(scene.initial.v.iter().all(|v| *v == 0.0));
    assert_eq!(scene.walls[0].row().dot(&scene.initial.q), 0.5);
    assert_eq!(scene.walls[0].law.restitution(), Some(0.0));
    assert_eq!(scene.probes.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(), ["end", "middle"]);
    assert!((scene.probes[1].at.dot(&scene.initial.q) - 0.25).abs() < 1e-15);
}

#[test]
fn the_tube_is_cut_to_modes_and_keeps_its_whole() {
    let case = embedded("tube-loose-supports");
    let truncated = case.truncated.as_ref().unwrap();
    assert_eq!((case.scene.system.degrees_of_freedom(), case.unreduced().system.degrees_of_freedom()), (20, 120));
    // A pinned-pinned beam: ω = (iπ/L)² √(EI/m′); Hermite elements are too stiff by (kh)⁴/1440.
    let Model::Beam(beam) = &case.model else { panic!("{:?}", case.model) };
    for (i, omega) in truncated.reduction.modes.omega.iter().enumerate().take(10) {
        let wave = (i as f64 + 1.0) * std::f64::consts::PI / beam.length;
        let exact = wave * wave * (beam.bending_stiffness() / beam.mass_per_metre()).sqrt();
        let stiffer = (wave * beam.length / beam.elements as f64).powi(4) / 1440.0;
        assert!((omega / exact - 1.0 - stiffer).abs() < 0.05 * stiffer + 1e-9, "{i}: {omega} {exact}");
        let e: Vec<f64> = (0..20).map(|j| if j == i { 1.0 } else { 0.0 }).collect();
        // One per cent of critical damping: 2 ζ ω.
        assert!((case.scene.system.damping_form(&e, &e) - 0.02 * omega).abs() < 1e-12 * omega);
    }
    assert_eq!(case.places, [1.0, 1.0, 2.0, 2.0].map(Place::Position));
    let more = case.with("system.modes", 40).unwrap();
    assert_eq!((more.scene.system.degrees_of_freedom(), more.unreduced()), (40, case.unreduced()));
    assert!(case.with("system.modes", 121).is_err());
    assert!(embedded("rigid-walls-sine").with("system.modes", 1).is_err_and(|e| e.is_request()));
    assert!(embedded("chain-20").with("system.modes", 5).is_ok_and(|c| c.scene.system.degrees_of_freedom() == 5));
}

#[test]
fn a_place_means_the_same_however_it_is_said() {
    let text = |at: &str, probes: &str| {
        format!(
            "[system.bar]\nlength = 2.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\n\
             elements = 4\nleft = \"clamped\"\nright = \"free\"\n\
             [[wall]]\nname = \"stop\"\nat = {at}\nside = \"both\"\ngap = 1.0\n{probes}[time]\nend = 1.0\nstep = 1e-2\n"
        )
    };
    let read = |at: &str, probes: &str| Case::parse(&text(at, probes), "bar.toml", "").unwrap();
    // The clamped node is left out: the node at 1 m, the third, is degree of freedom 1.
    let case = read("{ position = 1.0 }", "");
    for other in ["{ dof = 1 }", "{ row = [[1, 1.0]] }"] {
        assert_eq!(read(other, "").scene, case.scene);
    }
    assert_eq!(case.scene.probes, [Probe { name: "stop".into(), at: Row::dof(1) }]);
    let each = read("\"each\"", "[[probe]]\nname = \"node\"\nat = \"each\"\n");
    let names: Vec<_> = each.scene.walls.iter().map(|w| w.name.as_str()).collect();
    let expected: Vec<_> = (1..=4).flat_map(|i| [format!("stop-{i}-upper"), format!("stop-{i}-lower")]).collect();
    assert_eq!(names, expected);
    assert_eq!(each.scene.probes.len(), 4);
    let none =
        text("{ dof = 0 }", "").split("[[wall]]").next().unwrap().to_owned() + "[time]\nend = 1.0\nstep = 1e-2\n";
    assert_eq!(
        Case::parse(&none, "bar.toml", "").unwrap().scene.probes,
        [Probe { name: "middle".into(), at: Row::dof(1) }]
    );
}

#[test]
fn a_system_of_one_degree_of_freedom_needs_no_place() {
    let text = "[system.chain]\nmasses = [2.0]\nsprings = []\nleft = { stiffness = 8.0 }\n\
        [[wall]]\nname = \"stop\"\nside = \"upper\"\n\
        position = 1.0\n[[load]]\nconstant = { force = 1.0 }\n[initial]\n\
        displacement = 0.5\n[time]\nend = 1.0\nstep = 1e-2\n";
    let case = Case::parse(text, "one.toml", "").unwrap();
    assert_eq!(case.scene.probes, [Probe { name: String::new(), at: Row::dof(0) }]);
    assert_eq!((case.scene.walls[0].row().clone(), case.scene.initial.q.clone()), (Row::dof(0), vec![0.5]));
    assert_eq!(case.scene.system.frequencies()[0], 2.0);
}

#[test]
fn matrices_of_files_are_those_of_the_builder() {
    let folder = tempfile::tempdir().unwrap();
    let chain = Chain { masses: vec![1.0, 2.0, 3.0], springs: vec![4.0, 5.0], grounds: [6.0, 0.0] };
    let structure = chain.structure().unwrap();
    let mut lines = String::from("%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n");
    for (i, j, value) in structure.stiffness.entries() {
        lines += &format!("{} {} {value:?}\n", i + 1, j + 1);
    }
    fs::write(folder.path().join("K.mtx"), lines).unwrap();
    fs::write(folder.path().join("M.csv"), "1,0,0\n0,2,0\n0,0,3\n").unwrap();
    let rest = "[[probe]]\nname = \"a\"\nat = { dof = 0 }\n[time]\nend = 1.0\nstep = 1e-2\n";
    let of_files = format!(
        "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.mtx\"\n[system.damping]\n\
         rayleigh = {{ mass = 0.5 }}\n{rest}"
    );
    let of_builder = format!(
        "[system.chain]\nmasses = [1, 2, 3]\nsprings = [4, 5]\nleft = {{ stiffness = 6 }}\n\
         [system.damping]\nrayleigh = {{ mass = 0.5 }}\n{rest}"
    );
    let read = |text: &str| Case::parse(text, "case.toml", folder.path()).unwrap().scene;
    let [files, builder] = [read(&of_files), read(&of_builder)].map(|scene| scene.system.structure());
    for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
        for (a, b) in
            [(&files.mass, &builder.mass), (&files.damping, &builder.damping), (&files.stiffness, &builder.stiffness)]
        {
            assert_eq!(a.get(i, j), b.get(i, j), "{i} {j}");
        }
    }
}

#[test]
fn a_table_that_no_memory_holds_is_refused() {
    let case = embedded("chain-200").with("time.step", 1e-6);
    // 807 columns, 1e6 rows.
    let case = case.and_then(|case| case.with("time.sample", 1e-6));
    assert!(case.is_err_and(|e| e.is_request() && e.to_string().contains("time.sample is 1e-6")));
}

#[test]
fn a_measured_table_is_read_by_the_names_of_its_columns() {
    let folder = tempfile::tempdir().unwrap();
    let case = |keys: &str| {
        let text = format!(
            "[system.oscillator]\nmass = 1\ndamping = 0\nstiffness = 1\n[[load]]\n\
             table = {{ file = \"force.csv\"{keys} }}\n\
             [time]\nend = 1\nstep = 0.1\n"
        );
        fs::write(folder.path().join("case.toml"), text).unwrap();
        Case::read(folder.path().join("case.toml")).unwrap_or_else(|error| panic!("{error}"))
    };
    let table = |case: &Case| match &case.scene.loads[0].kind {
        LoadKind::Table(table) => (table.time().to_vec(), table.force().to_vec()),
        other => panic!("{other:?}"),
    };
    // As a German data logger writes it: a byte-order mark, semicolons, decimal commas, quotes,
    // spaces, columns of no interest.
    let german =
        "\u{feff}\"t\"; F1 ;\"F2; raw\";Bemerkung\r\n0,0;1,5;-2,25;ok\r\n 0,5 ;2;\"1e-3\";a,b\r\n1;3;0,125;\r\n";
    fs::write(folder.path().join("force.csv"), german).unwrap();
    let read = case(", time = \"t\", force = \"F2; raw\", delimiter = \";\", decimal = \",\", scale = 2.0");
    assert_eq!(table(&read), (vec![0.0, 0.5, 1.0], vec![-4.5, 2e-3, 0.25]));
    fs::write(folder.path().join("force.csv"), "force_N\ttime_s\n1\t0\n2\t1\n").unwrap();
    assert_eq!(table(&case(", delimiter = \"\\t\", scale = -1e3")), (vec![0.0, 1.0], vec![-1e3, -2e3]));
    assert_eq!(table(&case(", delimiter = \"\\t\", scale = 0, time_scale = 0.5")), (vec![0.0, 0.5], vec![0.0; 2]));
    // A table with further columns besides the two is accepted.
    fs::write(folder.path().join("force.csv"), "time_s,force_N,note\n0,1,start\n1,2,end\n").unwrap();
    assert_eq!(table(&case("")), (vec![0.0, 1.0], vec![1.0, 2.0]));
}
