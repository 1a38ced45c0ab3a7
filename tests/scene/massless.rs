//! Degrees of freedom without mass: static condensation, and structures by their modal data.
use signorini::case::{Case, Place};
use signorini::linear::{Factor, Symmetric};
use signorini::{
    Beam, BeamEnd, BeamSection, Damping, Error, Load, ModalData, ModalPoint, Modes, Options, Probe, Row, Scene, Scheme,
    Structure, System, Wall, WallLaw, run,
};
use std::fs;
use std::path::Path;

/// 1 kg – 100 N/m – nothing – 300 N/m – 2 kg, the first on 50 N/m to ground: the two springs in
/// series are one of 75 N/m.
fn chain(middle: f64) -> Structure {
    let entries = [(0, 0, 150.0), (1, 0, -100.0), (1, 1, 400.0), (2, 1, -300.0), (2, 2, 300.0)];
    Structure {
        mass: Symmetric::diagonal(&[1.0, middle, 2.0]),
        damping: Symmetric::zeros(3),
        stiffness: Symmetric::from_entries(3, entries),
    }
}

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * (1.0 + b.abs())
}

fn assert_matrix(matrix: &Symmetric, expected: &[(usize, usize, f64)]) {
    for &(i, j, x) in expected {
        assert!(close(matrix.get(i, j), x, 1e-14), "({i}, {j}): {} for {x}", matrix.get(i, j));
    }
}

fn structure(scene: &Scene) -> &Structure {
    match &scene.system {
        System::Structure(structure) => structure,
        other => panic!("{other:?}"),
    }
}

#[test]
fn springs_in_series_become_one() {
    let stiffness = [(0, 0, 125.0), (1, 0, -75.0), (1, 1, 75.0)];
    let mut scene = Scene::structure(chain(0.0)).with_load(Load { at: Row::dof(1), ..Load::constant(8.0) });
    scene.initial.q = vec![1e-3, 0.0, 5e-3];
    let (less, condensation) = scene.condensed().unwrap();
    assert_eq!((condensation.kept, condensation.massless), (vec![0, 2], vec![1]));
    assert_matrix(&structure(&less).stiffness, &stiffness);
    assert_matrix(&structure(&less).mass, &[(0, 0, 1.0), (1, 0, 0.0), (1, 1, 2.0)]);
    // The springs share the force of the massless node by their stiffness.
    assert_eq!(less.loads[0].at, Row::new(vec![(0, 0.25), (1, 0.75)]));
    assert_eq!(less.initial.q, vec![1e-3, 5e-3]);
    // A start of the massless node is what the springs hold it at, (1·100 + 5·300)/400 mm, or
    // nothing.
    scene.initial.q[1] = 4e-3;
    assert_eq!(scene.condensed().unwrap().0.initial.q, vec![1e-3, 5e-3]);
    scene.initial.q[1] = 3e-3;
    let said = scene.condensed().unwrap_err().to_string();
    assert!(
        said.contains("initial state: displacement") && said.contains("degree of freedom 1") && said.contains("0.004"),
        "{said}"
    );
    // Damping in proportion to stiffness acts on the springs, and so on what they are in series.
    let damped = Structure { damping: Symmetric::sum(&[(2e-3, &chain(0.0).stiffness)]), ..chain(0.0) };
    let (less, _) = Scene::structure(damped).condensed().unwrap();
    assert_matrix(&structure(&less).damping, &stiffness.map(|(i, j, k)| (i, j, 2e-3 * k)));
    // All have mass: nothing changes.
    let scene = Scene::structure(chain(0.5));
    let (same, condensation) = scene.condensed().unwrap();
    assert!(same == scene && condensation.massless.is_empty());
}

#[test]
fn a_lumped_cantilever_keeps_its_statics_and_its_frequency() {
    let beam = Beam {
        length: 2.0,
        youngs_modulus: 2e11,
        density: 7850.0,
        section: BeamSection::Tube { outer_diameter: 0.02, inner_diameter: 0.0 },
        added_mass: 0.0,
        elements: 40,
        left: BeamEnd::Clamped,
        right: BeamEnd::Free,
    };
    let consistent = beam.structure().unwrap();
    // Half of each element's mass at each of its nodes, none for the rotations.
    let element = beam.mass_per_metre() * beam.length / 40.0;
    let lumped: Vec<f64> = (0..80)
        .map(|i| {
            if i % 2 == 1 {
                0.0
            } else if i == 78 {
                0.5 * element
            } else {
                element
            }
        })
        .collect();
    let scene = Scene::structure(Structure { mass: Symmetric::diagonal(&lumped), ..consistent });
    let (less, condensation) = scene.condensed().unwrap();
    assert_eq!(condensation.massless, (0..40).map(|i| 2 * i + 1).collect::<Vec<_>>());
    let mut tip = vec![0.0; 40];
    tip[39] = 1.0;
    Factor::new(&structure(&less).stiffness).unwrap().solve(&mut tip);
    let exact = beam.length.powi(3) / (3.0 * beam.bending_stiffness());
    // Rounding times the condition of K, some 40⁴.
    assert!((tip[39] / exact - 1.0).abs() < 1e-9, "{} for {exact}", tip[39]);
    // β₁L = 1.8751; lumping 40 elements leaves some (1/40)² of the frequency.
    let omega = Modes::lowest(structure(&less), 1).unwrap().omega[0];
    let exact = 1.875_104_068_711_961_f64.powi(2) / beam.length.powi(2)
        * (beam.bending_stiffness() / beam.mass_per_metre()).sqrt();
    assert!((omega / exact - 1.0).abs() < 1e-3, "{omega} for {exact}");
}

#[test]
fn a_rigid_wall_on_a_massless_node_is_the_spring_behind_it() {
    let wall = |law| Wall { law, ..Wall::upper("stop", 1e-3).at(Row::dof(1)) };
    let scene = |middle: f64, law| {
        let mut scene = Scene::structure(chain(middle)).with_wall(wall(law)).with_duration(2.0);
        scene.probes = vec![Probe { name: "end".into(), at: Row::dof(2) }];
        scene.with_load(Load { at: Row::dof(2), ..Load::harmonic(2.0, 0.7, 0.3) })
    };
    let rigid = WallLaw::Rigid { restitution: 0.0 };
    let (less, condensation) = scene(0.0, rigid).condensed().unwrap();
    assert!(close(condensation.compliance[0], 1.0 / 400.0, 1e-15));
    let WallLaw::Elastic { stiffness, damping } = less.walls[0].law else { panic!("{:?}", less.walls[0]) };
    assert!(close(stiffness, 400.0, 1e-15) && damping == 0.0);
    let (sprung, _) = scene(0.0, WallLaw::Elastic { stiffness: 400.0, damping: 0.0 }).condensed().unwrap();
    assert!(matches!(sprung.walls[0].law, WallLaw::Elastic { stiffness, .. } if close(stiffness, 200.0, 1e-15)));
    // The same with a little mass at the node, which a wall of e = 0 stops at once: what is left of
    // it is of the order of its mass's share, 1e-4, of the impulses.
    let options = Options::with_step(1e-4);
    let exact = run(&less, &Scheme::Event, &options).unwrap();
    let light = run(&scene(1e-4, rigid), &Scheme::MoreauJean { theta: 0.5 }, &options).unwrap();
    let impulse = |run: &signorini::Run| run.trajectory.impulse("stop").unwrap();
    assert!(impulse(&exact) < -0.05, "{}", impulse(&exact));
    assert!((impulse(&light) / impulse(&exact) - 1.0).abs() < 5e-3, "{} {}", impulse(&light), impulse(&exact));
    let last = |run: &signorini::Run| *run.trajectory.displacement().last().unwrap();
    assert!(
        (last(&light) - last(&exact)).abs() < 5e-3 * last(&exact).abs().max(1e-3),
        "{} {}",
        last(&light),
        last(&exact)
    );
}

#[test]
fn what_statics_cannot_say_exactly_is_refused_by_name() {
    let free = |at: Row| Scene::structure(chain(0.0)).with_wall(Wall::upper("stop", 1e-3).at(at));
    let refused = |scene: Scene, words: &[&str]| {
        let said = scene.condensed().map(|_| "ACCEPTED").unwrap_err().to_string();
        assert!(words.iter().all(|word| said.contains(word)), "{words:?}: {said}");
    };
    refused(
        free(Row::dof(1)).with_load(Load { at: Row::dof(1), ..Load::constant(1.0) }),
        &["load 1: at", "the wall \"stop\" does not see", "mass"],
    );
    let beside = Wall::upper("other", 1e-3).at(Row::new(vec![(1, 1.0), (0, -1.0)]));
    refused(free(Row::dof(1)).with_wall(beside), &["wall \"other\": at", "\"stop\" displaces", "mass"]);
    refused(free(Row::dof(1)).with_wall(Wall::upper("twice", 2e-3).at(Row::dof(1))), &["wall \"twice\": at"]);
    let law = WallLaw::Elastic { stiffness: 1e3, damping: 1.0 };
    let dashpot = Scene::structure(chain(0.0)).with_wall(Wall { law, ..Wall::upper("soft", 1e-3).at(Row::dof(1)) });
    refused(dashpot, &["wall \"soft\": damping", "dashpot"]);
    let mut probed = Scene::structure(chain(0.0)).with_load(Load { at: Row::dof(1), ..Load::constant(1.0) });
    probed.probes = vec![Probe { name: "node".into(), at: Row::dof(1) }];
    refused(probed, &["load 1: at", "the probe \"node\" does not see"]);
    // A dashpot to ground lets the node creep: first order, no statics.
    let creeping = Structure { damping: Symmetric::diagonal(&[0.0, 1.0, 0.0]), ..chain(0.0) };
    refused(
        Scene::structure(creeping),
        &["damping matrix, row 2", "degree of freedom 1, which has no mass", "Rayleigh"],
    );
    // Neither mass nor stiffness.
    let loose = Structure { stiffness: Symmetric::diagonal(&[1.0, 0.0, 1.0]), ..chain(0.0) };
    refused(Scene::structure(loose), &["degree of freedom 1", "without stiffness"]);
    let nothing = Structure { mass: Symmetric::zeros(3), ..chain(0.0) };
    refused(Scene::structure(nothing), &["mass matrix", "mass at one degree of freedom"]);
    // Walls that face one another at one place are never touched together.
    let faced = free(Row::dof(1)).with_wall(Wall::lower("below", -1e-3).at(Row::dof(1)));
    assert!(faced.condensed().is_ok());
    // A start behind the wall, which a spring would take, is a mistake at a rigid one.
    let mut behind = free(Row::dof(1));
    behind.initial.q = vec![2e-3, 2e-3, 2e-3];
    refused(behind, &["initial state: displacement", "at most 0.001"]);
    // The error of the scene says what to do.
    let said = Scene::structure(chain(0.0)).validate().unwrap_err().to_string();
    assert!(said.contains("Scene::condensed"), "{said}");
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).unwrap();
}

#[test]
fn a_case_of_lumped_matrices_keeps_its_own_numbering() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "M.csv", "1,0,0\n0,0,0\n0,0,2\n");
    write(folder.path(), "K.csv", "150,-100,0\n-100,400,-300\n0,-300,300\n");
    let text = "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.csv\"\n[system.damping]\n\
        rayleigh = { mass = 0.1, stiffness = 1e-3 }\n\
        [[wall]]\nname = \"end\"\nat = { dof = 2 }\nside = \"upper\"\nposition = 1e-3\nrestitution = 0.5\n\
        [[wall]]\nname = \"node\"\nat = { dof = 1 }\nside = \"lower\"\nposition = -1e-3\n\
        [[load]]\nat = { dof = 0 }\nharmonic = { amplitude = 1.0, frequency = 1.0 }\n\
        [initial]\nvelocity = { dofs = [[2, 0.1]] }\n\
        [time]\nend = 1.0\nstep = 1e-3\n";
    let read = |text: &str| {
        write(folder.path(), "case.toml", text);
        Case::read(folder.path().join("case.toml"))
    };
    let case = read(text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(case.places, vec![Place::Dof(2), Place::Dof(1)]);
    assert_eq!(*case.scene.walls[0].row(), Row::dof(1));
    assert_eq!(case.scene.initial.v, vec![0.0, 0.1]);
    let k = [(0, 0, 125.0), (1, 0, -75.0), (1, 1, 75.0)];
    assert_matrix(&structure(&case.scene).stiffness, &k);
    assert_matrix(&structure(&case.scene).damping, &[(0, 0, 0.1 + 0.125), (1, 0, -0.075), (1, 1, 0.2 + 0.075)]);
    let notes = case.notes().join("\n");
    assert!(notes.contains("1 of 3 degrees of freedom have no mass") && notes.contains("\"node\""), "{notes}");
    run(&case.scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-3)).unwrap();
    let cut = read(&format!("[system]\nmodes = 1\n{text}")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(cut.scene.system.degrees_of_freedom(), 1);
    for (old, new, place, words) in [
        ("position = -1e-3", "position = -1e-3\nrestitution = 0.5", "17:15", "cannot rebound"),
        ("at = { dof = 0 }", "at = { dof = 1 }", "18:6", "the wall \"node\" does not see"),
        ("rayleigh = { mass = 0.1, stiffness = 1e-3 }", "matrix = \"M.csv\"", "", ""),
        ("rayleigh = { mass = 0.1, stiffness = 1e-3 }", "matrix = \"C.csv\"", "5:10", "no damping force"),
        ("dofs = [[2, 0.1]]", "dofs = [[2, 0.1], [1, 1.0]]", "21:12", "which has no mass"),
        ("mass = \"M.csv\"", "mass = \"Z.csv\"", "2:8", "mass at one degree of freedom"),
        ("stiffness = \"K.csv\"", "stiffness = \"L.csv\"", "1:1", "degree of freedom 1"),
    ] {
        write(folder.path(), "C.csv", "0,0,0\n0,1,0\n0,0,0\n");
        write(folder.path(), "Z.csv", "0,0,0\n0,0,0\n0,0,0\n");
        write(folder.path(), "L.csv", "150,0,0\n0,0,0\n0,0,300\n");
        let said = match read(&text.replacen(old, new, 1)) {
            Ok(_) => String::new(),
            Err(Error::Case { report, .. }) => report,
            Err(other) => panic!("{other:?}"),
        };
        let at = if place.is_empty() { String::new() } else { format!("case.toml:{place}\n") };
        assert!(said.contains(&at) && said.contains(words), "{new}: wanted {place} {words}\n{said}");
        assert_eq!(said.is_empty(), place.is_empty(), "{new}: {said}");
    }
}

#[test]
fn modal_data_make_the_scene_that_its_own_modes_make() {
    let beam = Case::embedded("tube-loose-supports").unwrap();
    let truncated = beam.truncated.as_ref().unwrap();
    let modes = &truncated.reduction.modes;
    let signorini::case::Model::Beam(tube) = &beam.model else { panic!("{:?}", beam.model) };
    // What a finite-element program exports: Hz, shapes of largest value 1 with their generalised
    // masses.
    let (mut hz, mut masses, mut shapes) = (Vec::new(), Vec::new(), vec![Vec::new(); 3]);
    let Place::Position(first) = beam.places[0] else { panic!("{:?}", beam.places) };
    let Place::Position(second) = beam.places[2] else { panic!("{:?}", beam.places) };
    for (omega, shape) in modes.omega.iter().zip(&modes.shapes) {
        let largest = shape.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        hz.push(omega / std::f64::consts::TAU);
        masses.push(1.0 / (largest * largest));
        for (points, row) in shapes.iter_mut().zip([tube.at(first), tube.at(second), tube.at(0.5)]) {
            points.push(row.unwrap().dot(shape) / largest);
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let line = |shape: &[f64]| shape.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",");
    write(
        folder.path(),
        "shapes.csv",
        &format!(
            "point,mode 1 and on\nfirst,{}\n\nsecond,{}\nload,{}\n",
            line(&shapes[0]),
            line(&shapes[1]),
            line(&shapes[2])
        ),
    );
    let text = |shapes: &str| {
        format!(
            "[system.modal]\nfrequencies = {hz:?}\nmasses = {masses:?}\ndamping_ratios = 0.01\nshapes = {shapes}\n\
             [[wall]]\nname = \"first\"\nat = {{ point = \"first\" }}\nside = \"both\"\ngap = 2e-4\nrestitution = 0.5\n\
             [[wall]]\nname = \"second\"\nat = {{ points = [[\"second\", 1.0]] }}\n\
             side = \"both\"\ngap = 2e-4\nrestitution = 0.5\n\
             [[load]]\nat = {{ point = \"load\" }}\nharmonic = {{ amplitude = 10.0, frequency = 25.0 }}\n\
             [time]\nend = 0.2\nstep = 5e-5\n"
        )
    };
    write(folder.path(), "case.toml", &text("\"shapes.csv\""));
    let case = Case::read(folder.path().join("case.toml")).unwrap_or_else(|error| panic!("{error}"));
    let inline = format!("{{ first = {:?}, second = {:?}, load = {:?} }}", shapes[0], shapes[1], shapes[2]);
    let same = Case::parse(&text(&inline), "case.toml", "").unwrap_or_else(|error| panic!("{error}"));
    // Apart from the file that was read, the two cases are equal.
    assert_eq!((&case.model, &case.places, &case.scene), (&same.model, &same.places, &same.scene));
    assert_eq!((case.written.files.len(), same.written.files.len()), (1, 0));
    let mut scene = Scene::structure(tube.structure().unwrap()).with_duration(0.2);
    for (name, position) in [("first", first), ("second", second)] {
        let at = tube.at(position).unwrap();
        for wall in [Wall::upper(&format!("{name}-upper"), 2e-4), Wall::lower(&format!("{name}-lower"), -2e-4)] {
            scene = scene.with_wall(wall.with_restitution(0.5).at(at.clone()));
        }
    }
    let scene = scene.with_load(Load { at: tube.at(0.5).unwrap(), ..Load::harmonic(10.0, 25.0, 0.0) });
    let cut = scene.reduced(modes.count(), false).unwrap().with_damping(&Damping::Modal(vec![0.01])).unwrap();
    let scheme = Scheme::MoreauJean { theta: 0.5 };
    let [ours, theirs] = [&case.scene, &cut.scene].map(|scene| run(scene, &scheme, &Options::with_step(5e-5)).unwrap());
    for wall in ["first-upper", "first-lower", "second-upper", "second-lower"] {
        let (a, b) = (ours.trajectory.impulse(wall).unwrap(), theirs.trajectory.impulse(wall).unwrap());
        // Rounding of the shapes, grown by the impacts of 0.2 s.
        assert!((a - b).abs() <= 1e-7 * b.abs(), "{wall}: {a} {b}");
    }
    assert!(theirs.trajectory.impulse("first-upper").unwrap().abs() > 1e-3);
    // One mode with a shape of 1 is the oscillator.
    let modal = ModalData {
        omega: vec![10.0],
        masses: vec![1.0],
        ratios: vec![0.01],
        points: vec![ModalPoint { name: "body".into(), shape: vec![1.0] }],
    };
    let structure = modal.structure().unwrap();
    assert_matrix(&structure.stiffness, &[(0, 0, 100.0)]);
    assert_matrix(&structure.damping, &[(0, 0, 0.2)]);
    assert_eq!(modal.at("body").unwrap(), Row::dof(0));
    assert!(modal.at("tip").unwrap_err().to_string().contains("there is body"));
}

#[test]
fn modes_without_points_say_so_and_each_point_may_have_a_wall() {
    let text = "[system.modal]\nomega = [10.0, 30.0]\n\
        shapes = { tip = [1.0, -1.0], node = [0.0, 0.0], base = [1.0, 1.0] }\n\
        [[wall]]\nname = \"stop\"\nat = \"each\"\nside = \"upper\"\nposition = 1e-3\n\
        [time]\nend = 1.0\nstep = 1e-3\n";
    let case = Case::parse(text, "case.toml", "").unwrap_or_else(|error| panic!("{error}"));
    let names: Vec<&str> = case.scene.walls.iter().map(|wall| wall.name.as_str()).collect();
    assert_eq!(names, ["stop-tip", "stop-base"]);
    assert_eq!(*case.scene.walls[1].row(), Row::new(vec![(0, 1.0), (1, 1.0)]));
    let relative = text.replace("\"each\"", "{ points = [[\"tip\", 1.0], [\"base\", -1.0]] }");
    let case = Case::parse(&relative, "case.toml", "").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(*case.scene.walls[0].row(), Row::new(vec![(1, -2.0)]));
}
