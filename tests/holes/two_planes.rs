//! Structures in two planes: closed forms, the same scene turned, and planes that do not feel each
//! other.
use signorini::case::Case;
use signorini::{Integrator, Options, PenaltyLaw, Row, Run, Scene, Scheme, Side, System, run};

fn case(text: &str) -> Case {
    Case::parse(text, "planes.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

fn made(scene: &Scene, scheme: &Scheme, step: f64) -> Run {
    run(scene, scheme, &Options::with_step(step)).unwrap_or_else(|error| panic!("{scheme:?}: {error}"))
}

/// Schemes that treat walls each in its own way; the penalty has a spring of 1e6 N/m.
fn schemes() -> Vec<Scheme> {
    let law = PenaltyLaw::Linear { stiffness: 1e6, damping: 0.0 };
    vec![
        Scheme::MoreauJean { theta: 0.5 },
        Scheme::PaoliSchatzman,
        Scheme::ImplicitEuler,
        Scheme::GeneralizedAlpha { rho: 0.8 },
        Scheme::Penalty { law, integrator: Integrator::DiscreteGradient },
        Scheme::Event,
    ]
}

/// The tube of the tests, its plane or planes, and what stands beside it.
fn tube(planes: &str, rest: &str) -> Case {
    case(&format!(
        "[system]\n{planes}modes = 6\n[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
         outer_diameter = 19.05e-3\ninner_diameter = 15.75e-3\nadded_mass = 0.565\nelements = 12\n\
         left = \"pinned\"\nright = \"clamped\"\n[system.damping]\nratio = 0.01\n{rest}\
         [time]\nend = 0.1\nstep = 1e-4\n"
    ))
}

/// Largest difference of two columns, over the size of the first.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let size = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(size > 0.0);
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

#[test]
fn a_free_mass_in_a_square_hole_follows_the_closed_form() {
    // In the axes of the hole two billiards that know nothing of each other: positions and sum of
    // impulses by unfolding them, with 40 digits.
    let square = case(
        "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.3\ndamping = 0.0\nstiffness = 0.0\n\
         [[support]]\nname = \"hole\"\nshape = \"flats\"\nsides = 4\nturn = 20\ngap = 1e-3\nrestitution = 1.0\n\
         [initial]\ndisplacement = [2e-4, -6e-4]\nvelocity = [0.05, 0.083]\n[time]\nend = 1.0\nstep = 1e-3\n",
    );
    let run = made(&square.scene, &Scheme::Event, 1e-3);
    let impacts = |wall: usize| run.trajectory.contacts().iter().filter(|contact| contact.wall == wall).count();
    assert_eq!([impacts(0) + impacts(2), impacts(1) + impacts(3)], [38, 30]);
    let end = |probe: &str| *run.trajectory.probe(probe).unwrap().0.last().unwrap();
    // 68 impacts, each placed to some roundings of 1e-3 m.
    assert!((end("hole-y") - -0.695_430_580_189_188_9e-3).abs() < 1e-14, "{:e}", end("hole-y"));
    assert!((end("hole-z") - 0.024_911_860_094_672_3e-3).abs() < 1e-14, "{:e}", end("hole-z"));
    let impulse: f64 = square.scene.walls.iter().map(|wall| run.trajectory.impulse(&wall.name).unwrap().abs()).sum();
    assert!((impulse / 12.196_474_998_008_064 - 1.0).abs() < 1e-13, "{impulse}");
}

#[test]
fn a_turned_scene_has_the_turned_motion() {
    // Three flats at one place and four at another, with loads and start in all directions, before
    // and after all of it is turned by 37°.
    let scene = |turn: f64| {
        let [sin, cos] = [turn.to_radians().sin(), turn.to_radians().cos()];
        let start = |y: f64, z: f64| (y * cos - z * sin, y * sin + z * cos);
        let (y, z) = start(0.2, -0.1);
        tube(
            "planes = 2\n",
            &format!(
                "[[support]]\nname = \"a\"\nat = {{ position = 1.0 }}\nshape = \"flats\"\ndirections = [{}, {}, {}]\n\
                 gap = [1e-4, 2e-4, 1.5e-4]\nrestitution = 0.5\n\
                 [[support]]\nname = \"b\"\nat = {{ position = 2.0 }}\nshape = \"flats\"\nsides = 4\nturn = {}\n\
                 gap = 2e-4\ncentre = [{:e}, {:e}]\nrestitution = 0.5\n\
                 [[load]]\nat = {{ position = 0.5 }}\ndirection = {}\n\
                 harmonic = {{ amplitude = 60.0, frequency = 25.0 }}\n\
                 [[load]]\nat = {{ position = 1.6 }}\ndirection = {}\n\
                 harmonic = {{ amplitude = 40.0, frequency = 33.0 }}\n\
                 [initial]\nvelocity = {{ y = {{ profile = [[0.0, 0.0], [1.5, {y}], [3.0, 0.0]] }}, \
                 z = {{ profile = [[0.0, 0.0], [1.5, {z}], [3.0, 0.0]] }} }}\n",
                turn,
                turn + 110.0,
                turn + 250.0,
                turn + 30.0,
                start(2e-5, 1e-5).0,
                start(2e-5, 1e-5).1,
                turn + 10.0,
                turn + 100.0,
            ),
        )
        .scene
    };
    let turn = 37.0_f64;
    let [sin, cos] = [turn.to_radians().sin(), turn.to_radians().cos()];
    for scheme in schemes() {
        let [before, after] = [0.0, turn].map(|turn| made(&scene(turn), &scheme, 1e-4));
        let contacts = before.trajectory.contacts().len();
        assert!(contacts > 20, "{scheme:?}: {contacts}");
        for place in ["a", "b"] {
            let of = |run: &Run, plane: &str| run.trajectory.probe(&format!("{place}-{plane}")).unwrap().0.to_vec();
            let (y, z) = (of(&before, "y"), of(&before, "z"));
            let turned: Vec<f64> = y.iter().zip(&z).map(|(y, z)| cos * y - sin * z).collect();
            // Rounding of the rows, 1e-16, grows at every impact, about thirty of them.
            let error = apart(&turned, &of(&after, "y"));
            assert!(error < 1e-7, "{scheme:?} at {place}: {error:e}");
        }
    }
}

#[test]
fn planes_without_a_common_wall_move_as_each_alone() {
    let walls = |name: &str, direction: &str| {
        format!(
            "[[wall]]\nname = \"{name}\"\nat = {{ position = 1.0 }}\n{direction}side = \"both\"\ngap = 2e-4\n\
             restitution = 0.5\n"
        )
    };
    let load = |direction: &str, force: f64, frequency: f64| {
        format!(
            "[[load]]\nat = {{ position = 0.5 }}\n{direction}harmonic = {{ amplitude = {force:?}, frequency = \
             {frequency:?} }}\n"
        )
    };
    let loads = [(60.0, 25.0), (45.0, 32.0)];
    let alone = loads.map(|(force, frequency)| tube("", &(walls("wall", "") + &load("", force, frequency))));
    let flats = "[[support]]\nname = \"s\"\nat = { position = 1.0 }\nshape = \"flats\"\nsides = 4\n\
        gap = 2e-4\nrestitution = 0.5\n";
    let two = [("direction = 0\n", loads[0]), ("direction = 90\n", loads[1])]
        .map(|(direction, (force, frequency))| load(direction, force, frequency));
    let two = tube("planes = 2\n", &format!("{flats}{}{}", two[0], two[1]));
    // One plane loaded alone, between walls in its direction.
    let silent =
        tube("planes = 2\n", &(walls("wall", "direction = 0\n") + &load("direction = 0\n", loads[0].0, loads[0].1)));
    for scheme in schemes() {
        let alone = alone.each_ref().map(|case| made(&case.scene, &scheme, 1e-4));
        let [both, silent] = [&two, &silent].map(|case| made(&case.scene, &scheme, 1e-4));
        // The two planes share the sums over rows and degrees of freedom, whose order may differ:
        // rounding, which impacts let grow, those of generalized-alpha about threefold each.
        let grown = if let Scheme::GeneralizedAlpha { .. } = scheme { 1e-5 } else { 1e-8 };
        for (plane, run) in ["s-y", "s-z"].into_iter().zip(&alone) {
            let error = apart(run.trajectory.displacement(), both.trajectory.probe(plane).unwrap().0);
            assert!(error < grown, "{scheme:?} {plane}: {error:e}");
            assert!(run.trajectory.contacts().len() > 2, "{scheme:?}");
        }
        let error = apart(alone[0].trajectory.displacement(), silent.trajectory.probe("wall-y").unwrap().0);
        assert!(error < grown, "{scheme:?}: {error:e}");
        assert!(silent.trajectory.probe("wall-z").unwrap().0.iter().all(|&z| z == 0.0), "{scheme:?}");
    }
}

#[test]
fn modes_come_in_pairs_each_in_one_plane() {
    let walls =
        "[[wall]]\nname = \"wall\"\nat = { position = 1.0 }\ndirection = 30\nside = \"upper\"\nposition = 1e-3\n";
    let [one, two] = [("", walls.replace("direction = 30\n", "")), ("planes = 2\n", walls.to_owned())]
        .map(|(planes, walls)| tube(planes, &walls));
    let [one, two] = [&one, &two].map(|case| &case.truncated.as_ref().unwrap().reduction);
    assert_eq!((one.modes.count(), two.modes.count()), (6, 12));
    for (i, (omega, shape)) in one.modes.omega.iter().zip(&one.modes.shapes).enumerate() {
        assert_eq!(two.modes.omega[2 * i..2 * i + 2], [*omega; 2]);
        let still = vec![0.0; shape.len()];
        assert_eq!(two.modes.shapes[2 * i], [shape.as_slice(), &still].concat());
        assert_eq!(two.modes.shapes[2 * i + 1], [still.as_slice(), shape].concat());
    }
    assert_eq!(one.next_omega, two.next_omega);
    // A straight tube feels the same mass in every direction: cos² + sin² of one rounding each.
    assert!((one.walls[0].mass / two.walls[0].mass - 1.0).abs() < 1e-13);
    assert!((one.walls[0].share() / two.walls[0].share() - 1.0).abs() < 1e-9);
}

#[test]
fn matrices_of_both_planes_are_the_chain_in_two_planes() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    // Two masses in each plane; y in the degrees of freedom 0 and 2, z in 1 and 3.
    write("m.csv", "2,0,0,0\n0,2,0,0\n0,0,1,0\n0,0,0,1\n");
    write("k.csv", "700,0,-300,0\n0,700,0,-300\n-300,0,300,0\n0,-300,0,300\n");
    let rest = |tip: &str| {
        format!(
            "[[support]]\nname = \"s\"\n{tip}shape = \"flats\"\nsides = 3\nturn = 15\ngap = 5e-3\nrestitution = 0.8\n\
             [[load]]\n{tip}direction = 40\nharmonic = {{ amplitude = 4.0, frequency = 1.5 }}\n\
             [[load]]\n{tip}direction = 130\nharmonic = {{ amplitude = 3.0, frequency = 2.2 }}\n\
             [time]\nend = 2.0\nstep = 1e-3\n"
        )
    };
    let matrices = format!(
        "[system]\nplanes = 2\n[system.matrices]\nmass = \"m.csv\"\nstiffness = \"k.csv\"\n{}",
        rest("at = { y = [[2, 1.0]], z = [[3, 1.0]] }\n")
    );
    let chain = format!(
        "[system]\nplanes = 2\n[system.chain]\nmasses = [2.0, 1.0]\nsprings = 300.0\n\
         left = {{ stiffness = 400.0 }}\n{}",
        rest("at = { dof = 1 }\n")
    );
    let matrices = Case::parse(&matrices, "matrices.toml", folder.path()).unwrap();
    let (chain, end) = (case(&chain), 2.0);
    assert_eq!((matrices.scene.duration, chain.scene.system.degrees_of_freedom()), (end, 4));
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Event] {
        let [a, b] = [&matrices, &chain].map(|case| made(&case.scene, &scheme, 1e-3));
        assert!(a.trajectory.contacts().len() > 10, "{scheme:?}");
        for plane in ["s-y", "s-z"] {
            let [a, b] = [&a, &b].map(|run| run.trajectory.probe(plane).unwrap().0);
            // Another order of the same sums; impacts let their rounding grow.
            assert!(apart(a, b) < 1e-9, "{scheme:?} {plane}: {:e}", apart(a, b));
        }
    }
}

/// Modal data of both planes for a tube in two planes, each pair of modes of one frequency turned
/// by `turn` (deg), so that they move in both planes.
fn modal_data(tube: &Case, turn: f64, rest: &str) -> Case {
    let System::Structure(structure) = &tube.scene.system else { panic!("a structure") };
    let omega: Vec<f64> = structure.stiffness.diagonal_entries().iter().map(|k| k.sqrt()).collect();
    let along = |row: &Row| -> Vec<f64> {
        let mut shape = vec![0.0; omega.len()];
        row.entries().iter().for_each(|&(i, x)| shape[i] = x);
        let [sin, cos] = [turn.to_radians().sin(), turn.to_radians().cos()];
        let turned = |pair: &[f64]| [cos * pair[0] + sin * pair[1], cos * pair[1] - sin * pair[0]];
        shape.chunks(2).flat_map(turned).collect()
    };
    assert!(omega.chunks(2).all(|pair| (pair[0] / pair[1] - 1.0).abs() < 1e-9), "{omega:?}");
    let shapes = |support: &signorini::Support| {
        let [y, z] = [&support.at.y, &support.at.z].map(along);
        format!("{0}-y = {y:?}, {0}-z = {z:?}", support.name)
    };
    let shapes: Vec<String> = tube.scene.supports.iter().map(shapes).collect();
    case(&format!(
        "[system]\nplanes = 2\n[system.modal]\nomega = {omega:?}\ndamping_ratios = 0.01\n\
         shapes = {{ {} }}\n{rest}[time]\nend = 0.1\nstep = 1e-4\n",
        shapes.join(", ")
    ))
}

#[test]
fn modal_data_of_both_planes_is_the_tube_whose_modes_they_are() {
    let rest = |a: &str, b: &str| {
        format!(
            "[[support]]\nname = \"a\"\nat = {{ {a} }}\nshape = \"round\"\ngap = 2e-4\nrestitution = 0.5\n\
             friction = 0.2\n\
             [[support]]\nname = \"b\"\nat = {{ {b} }}\nshape = \"flats\"\nsides = 3\ngap = 1e-4\nrestitution = 0.5\n\
             [[load]]\nat = {{ {a} }}\ndirection = 30\nharmonic = {{ amplitude = 60.0, frequency = 21.0 }}\n\
             [[load]]\nat = {{ {b} }}\ndirection = 100\nharmonic = {{ amplitude = 40.0, frequency = 37.0 }}\n"
        )
    };
    let points = rest("point = \"a\"", "point = \"b\"");
    let whole = tube("planes = 2\n", &rest("position = 1.0", "position = 2.0"));
    for turn in [0.0, 35.0] {
        let modal = modal_data(&whole, turn, &points);
        for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Located] {
            let [a, b] = [&whole, &modal].map(|case| made(&case.scene, &scheme, 1e-4));
            assert!(a.trajectory.contacts().len() > 10, "{scheme:?}");
            for probe in ["a-y", "a-z", "b-y", "b-z"] {
                let [a, b] = [&a, &b].map(|run| run.trajectory.probe(probe).unwrap().0);
                // Other rounding of the same sums, which each of some 30 impacts lets grow.
                assert!(apart(a, b) < 1e-6, "{scheme:?} {turn} {probe}: {:e}", apart(a, b));
            }
        }
    }
}

#[test]
fn one_plane_is_what_it_was() {
    // planes = 1 is the default, and leaves an oscillator its three numbers.
    let text = "[system]\nplanes = 1\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n\
        [[wall]]\nname = \"w\"\nside = \"upper\"\nposition = 5e-3\n[time]\nend = 1.0\nstep = 1e-3\n";
    let one = case(text);
    assert!(matches!(one.scene.system, System::Oscillator(_)));
    assert_eq!(*one.scene.walls[0].row(), Row::dof(0));
    assert_eq!(one.scene, case(&text.replace("planes = 1\n", "")).scene);
}

#[test]
fn opposite_flats_are_the_two_walls_of_one_row() {
    let flats = |list: &str| {
        let text = format!(
            "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n\
             [[support]]\nname = \"s\"\nshape = \"flats\"\n{list}\ngap = 2e-3\ncentre = [1e-3, 0.0]\n\
             [time]\nend = 1.0\nstep = 1e-3\n"
        );
        case(&text).scene
    };
    let scene = flats("directions = [0, 180, 90]");
    let [right, left, top] = scene.walls.as_slice() else { panic!("{:?}", scene.walls) };
    assert_eq!((right.side(), right.position()), (Side::Upper, 3e-3));
    assert_eq!((left.side(), left.position()), (Side::Lower, -1e-3));
    assert_eq!((top.side(), top.position()), (Side::Upper, 2e-3));
    assert!(right.row() == left.row() && *top.row() == Row::dof(1));
    assert_eq!([&right.name, &left.name, &top.name], ["s-flat-1", "s-flat-2", "s-flat-3"]);
    assert_eq!(scene.gap_scale(), 2e-3);
    assert_eq!(flats("sides = 4").walls.len(), 4);
}
