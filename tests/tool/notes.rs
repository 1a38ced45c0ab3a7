//! Notes on what a user would otherwise notice late, and no notes where there is nothing to say.
use signorini::case::Embedded;
use signorini::linear::Symmetric;
use signorini::{Chain, Load, Options, PlaneRows, Probe, Row, Scene, Scheme, Structure, Table, Wall, WallLaw, run};
use std::fs;
use std::process::Command;

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

fn notes(scene: &Scene, scheme: &Scheme, step: f64) -> String {
    run(scene, scheme, &Options::with_step(step)).unwrap().notes.join("\n")
}

/// 1 kg on 100 N/m (1.6 Hz) before a wall that it reaches.
fn scene() -> Scene {
    Scene::oscillator(1.0, 0.1, 100.0).with_wall(Wall::upper("stop", 1e-3)).with_load(Load::constant(1.0))
}

#[test]
fn a_scene_in_order_has_no_note() {
    for scheme in [MOREAU, Scheme::Event] {
        assert_eq!(notes(&scene(), &scheme, 1e-3), "");
    }
}

#[test]
fn cautions_are_the_notes_that_limit_the_use_of_results() {
    let cautions = |scene: &Scene, step: f64| {
        let run = run(scene, &MOREAU, &Options::with_step(step)).unwrap();
        assert!(run.notes.ends_with(&run.cautions));
        (run.notes.len(), run.cautions.len())
    };
    assert_eq!(cautions(&scene(), 1e-3), (0, 0));
    // The step is shortened; there is no contact.
    let far = Scene::oscillator(1.0, 0.1, 100.0).with_wall(Wall::upper("stop", 1.0)).with_load(Load::constant(1.0));
    assert_eq!(cautions(&far, 1.7e-3), (2, 0));
    // And a period of the load takes six steps.
    assert_eq!(cautions(&far.with_load(Load::harmonic(1.0, 100.0, 0.0)), 1.7e-3), (3, 1));
}

#[test]
fn a_table_that_ends_or_begins_inside_the_run_is_said() {
    let table = |time: &[f64], force: &[f64]| Load::table(Table::new(time.to_vec(), force.to_vec()).unwrap());
    let short = scene().with_load(table(&[0.0, 0.5], &[1.0, 2.0]));
    for scheme in [MOREAU, Scheme::Event] {
        let said = notes(&short, &scheme, 1e-3);
        assert!(said.contains("table of load 2 ends at 0.5 s") && said.contains("at 1 s"), "{said}");
    }
    let late = scene().with_load(table(&[0.25, 2.0], &[1.0, 2.0]));
    assert!(notes(&late, &MOREAU, 1e-3).contains("table of load 2 begins at 0.25 s"));
    assert_eq!(notes(&scene().with_load(table(&[0.0, 1.0], &[1.0, 2.0])), &MOREAU, 1e-3), "");
}

/// 1 kg at 1 m/s against k s² with 1.5e6 N/m²: ½mv² = ks³/3 is a depth of 1 cm, where the wall has
/// 2ks = 3e4 N/m, so that a contact lasts some 20 ms.
#[test]
fn a_stiffening_wall_whose_strongest_contact_takes_few_steps_is_said() {
    let law = WallLaw::HuntCrossley { stiffness: 1.5e6, exponent: 2.0, dissipation: 0.0 };
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall { law, ..Wall::upper("stop", 0.0) })
        .with_initial(&[-0.01], &[1.0])
        .with_duration(0.1);
    let penalty = "penalty".parse::<Scheme>().unwrap();
    let said = notes(&scene, &penalty, 5e-3);
    assert!(said.contains("does not resolve the wall \"stop\": its strongest contact"), "{said}");
    assert!(!notes(&scene, &penalty, 1e-3).contains("strongest"));
}

#[test]
fn a_phase_that_looks_like_degrees_is_said() {
    let turned = |phase: f64| notes(&scene().with_load(Load::harmonic(1.0, 5.0, phase)), &MOREAU, 1e-3);
    assert!(turned(90.0).contains("the phase of load 2, 90 rad, is more than a turn"), "{}", turned(90.0));
    assert_eq!(turned(-std::f64::consts::TAU), "");
}

#[test]
fn walls_that_leave_no_room_are_said() {
    let between = |gap: f64| {
        let walls = [Wall::upper("above", gap), Wall::lower("below", -gap)];
        let body = Scene::oscillator(1.0, 0.5, 200.0).with_initial(&[0.0], &[1.0]).with_duration(0.1);
        notes(&walls.into_iter().fold(body, Scene::with_wall), &Scheme::Event, 1e-3)
    };
    assert!(between(0.0).contains("\"below\" and \"above\" leave no room between them"), "{}", between(0.0));
    assert_eq!(between(1e-3), "");
}

#[test]
fn a_step_that_passes_over_the_load_is_said() {
    let buzz = scene().with_load(Load::harmonic(1.0, 400.0, 0.0));
    let said = notes(&buzz, &MOREAU, 1e-3);
    assert!(said.contains("a period of load 2 (400 Hz) takes 2.5 steps"), "{said}");
    assert_eq!(notes(&buzz, &MOREAU, 1e-4), "");
    assert_eq!(notes(&buzz, &Scheme::Event, 1e-3), "");
    // 250 rows a step: a sine of 1 kHz in rows of 4 µs is lost, one of 2 Hz is not.
    let sampled = |hz: f64| {
        let time: Vec<f64> = (0..=250_000).map(|i| 4e-6 * f64::from(i)).collect();
        let force = time.iter().map(|t| (std::f64::consts::TAU * hz * t).sin()).collect();
        scene().with_load(Load::table(Table::new(time, force).unwrap()))
    };
    let said = notes(&sampled(1.3e3), &MOREAU, 1e-3);
    assert!(said.contains("the table of load 2, 250 rows a step") && said.contains("departs by up to"), "{said}");
    assert_eq!(notes(&sampled(2.0), &MOREAU, 1e-3), "");
}

#[test]
fn a_step_that_passes_over_a_mode_is_said() {
    // ω = 10 rad/s: ten steps are 63 ms.
    let said = notes(&scene(), &MOREAU, 0.1);
    assert!(said.contains("the natural frequency, 1.5915 Hz, takes 6.3 steps"), "{said}");
    let chain = Chain { masses: vec![1.0; 8], springs: vec![1e4; 7], grounds: [1e4, 0.0] };
    let mut scene = Scene::structure(chain.structure().unwrap())
        .with_load(Load { at: Row::dof(7), ..Load::constant(1.0) })
        .with_probe("tip", Row::dof(7));
    assert!(notes(&scene, &MOREAU, 0.1).contains("a period of the slowest mode"), "{}", notes(&scene, &MOREAU, 0.1));
    assert_eq!(notes(&scene, &MOREAU, 0.02), "");
    // Cut to modes, the third carries 2 % of the tip's compliance, the eighth nothing to speak of:
    // 1/(2i − 1)² of the first.
    scene.walls.push(Wall::upper("stop", 1e-5).at(Row::dof(7)));
    let cut = scene.reduced(8, false).unwrap().scene;
    let said = notes(&cut, &MOREAU, 0.02);
    assert!(said.contains("the fastest mode that a wall or load moves by 1 % or more"), "{said}");
    let said = notes(&cut, &MOREAU, 5e-3);
    let averaged = "RMS and largest forces at rigid walls are means over the step, 5e-3 s, and not over 1e-3 s";
    assert!(said.lines().count() == 1 && said.starts_with(averaged), "{said}");
}

/// Round supports count as walls do: 20 Hz along the second mode, with a sixteenth of the
/// first's compliance.
#[test]
fn a_mode_that_a_round_support_meets_is_resolved_or_said() {
    let mass = Symmetric::diagonal(&[1.0; 4]);
    let stiffness = Symmetric::diagonal(&[5.0, 20.0, 5.0, 20.0].map(|hz| (std::f64::consts::TAU * hz).powi(2)));
    let structure = Structure { mass, damping: Symmetric::diagonal(&[0.0; 4]), stiffness };
    let row = |dofs: [usize; 2]| Row::new(dofs.map(|i| (i, 1.0)).to_vec());
    let at = PlaneRows { y: row([0, 1]), z: row([2, 3]) };
    let held =
        Scene::structure(structure).with_support("plate", at.clone(), [0.0; 2], vec![Wall::round("plate", at, 1e-3)]);
    let said = notes(&held, &MOREAU, 8e-3);
    assert!(
        said.contains("the fastest mode that a wall or load moves by 1 % or more, 20 Hz, takes 6.2 steps"),
        "{said}"
    );
}

#[test]
fn a_load_that_never_acts_is_said() {
    let late = scene().with_load(Load::impulse(1.0, 1e3));
    let said = notes(&late, &MOREAU, 1e-3);
    assert!(said.contains("the blow of load 2 at 1000 s never comes: the run ends at"), "{said}");
    let nowhere = scene().with_load(Load { at: Row::new(vec![(0, 1.0), (0, -1.0)]), ..Load::constant(1.0) });
    let said = notes(&nowhere, &MOREAU, 1e-3);
    assert!(said.contains("load 2 acts on nothing"), "{said}");
}

#[test]
fn a_wall_that_the_step_does_not_resolve_is_said() {
    let law = WallLaw::Elastic { stiffness: 1e6, damping: 0.0 };
    let soft = Scene { walls: vec![Wall { law, ..Wall::upper("soft", 1e-3) }], ..scene() };
    let said = notes(&soft, &MOREAU, 1e-3);
    assert!(
        said.contains("does not resolve the wall \"soft\": h² k/m = 1.00e0") && said.contains("3.1 steps"),
        "{said}"
    );
    assert_eq!(notes(&soft, &MOREAU, 1e-4), "");
    assert_eq!(notes(&soft, &Scheme::Event, 1e-3), "");
}

#[test]
fn no_contact_at_all_is_said_with_how_near_it_came() {
    // The static deflection is 10 mm; without damping the body swings to 20 mm: a gap of 0.1 mm,
    // typed in mm.
    let far = Scene::oscillator(1.0, 0.0, 100.0).with_load(Load::constant(1.0)).with_wall(Wall::upper("stop", 0.1));
    for scheme in [MOREAU, Scheme::Event] {
        let said = notes(&far, &scheme, 1e-3);
        assert!(said.contains("no contact at all") && said.contains("8.000e-2 m from the wall \"stop\""), "{said}");
        assert!(said.contains("20.00 % of the 1.000e-1 m") || said.contains("19.99 %"), "{said}");
    }
    // A probe elsewhere sees nothing of the wall.
    let chain = Chain { masses: vec![1.0; 2], springs: vec![100.0], grounds: [100.0, 0.0] };
    let mut blind = Scene::structure(chain.structure().unwrap()).with_wall(Wall::upper("stop", 1.0).at(Row::dof(1)));
    blind.probes = vec![Probe { name: "other".into(), at: Row::dof(0) }];
    assert!(notes(&blind, &MOREAU, 1e-3).contains("no contact at all"));
}

#[test]
fn frequencies_that_no_structure_has_are_said() {
    let slow = Scene::oscillator(1.0, 0.0, 1e-6);
    assert!(
        notes(&slow, &Scheme::Event, 1e-3).contains("1.592e-4 Hz, far from"),
        "{}",
        notes(&slow, &Scheme::Event, 1e-3)
    );
    let fast = Scene::oscillator(1.0, 0.0, 1e12).with_duration(1e-5);
    assert!(notes(&fast, &MOREAU, 1e-8).contains("159200 Hz, far from"));
    assert_eq!(notes(&Scene::oscillator(1.0, 0.0, 0.0).with_load(Load::constant(1.0)), &MOREAU, 1e-3), "");
}

#[test]
fn every_command_and_the_summary_show_the_notes() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    fs::write(dir.join("force.csv"), "time_s,force_N\n0,1\n0.1,1\n").unwrap();
    let case = "[system.oscillator]\nmass = 1\ndamping = 0\nstiffness = 100\n[[wall]]\n\
        name = \"stop\"\nside = \"upper\"\nposition = 0.1\n\
        [[load]]\ntable = { file = \"force.csv\" }\n[time]\nend = 0.5\nstep = 1e-3\n";
    fs::write(dir.join("case.toml"), case).unwrap();
    let tool = |args: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_signorini")).args(args).current_dir(dir).output().unwrap();
        String::from_utf8([output.stdout, output.stderr].concat()).unwrap()
    };
    let compared = tool(&["compare", "case.toml"]);
    assert!(compared.contains("--verbose shows all quantities and the notes"), "{compared}");
    let verbose = ["compare", "case.toml", "--verbose"];
    for args in [&["run", "case.toml", "--out", "o"][..], &verbose, &["explain", "case.toml"]] {
        let said = tool(args);
        assert!(said.contains("the table of load 1 ends at 0.1 s"), "{args:?}: {said}");
        assert!(args[0] == "explain" || said.contains("no contact at all"), "{args:?}: {said}");
    }
    let summary = fs::read_to_string(dir.join("o/summary.json")).unwrap();
    assert!(summary.contains("the table of load 1 ends") && summary.contains("no contact at all"), "{summary}");
}

#[test]
fn built_in_cases_ask_for_no_finer_step() {
    for embedded in Embedded::all() {
        let case = embedded.case().unwrap();
        let scene = Scene { duration: case.scene.duration / 50.0, ..case.scene.clone() };
        let said = notes(&scene, &MOREAU, case.time.step);
        assert!(!said.contains("resolve") && !said.contains("far from"), "{}: {said}", embedded.name);
    }
}

#[test]
fn explain_says_where_moreau_jean_rests_too_deep_and_what_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path();
    // A spring of 1e4 N/m takes 10 N to the stop at 1 mm.
    let explained = |force: f64, side: &str| {
        let case = format!(
            "[system.oscillator]\nmass = 1\ndamping = 20\nstiffness = 1e4\n[[wall]]\n\
             name = \"stop\"\nside = \"{side}\"\n\
             position = {}\nrestitution = 0.3\n[[load]]\nconstant = {{ force = {force:?} }}\n\
             [time]\nend = 0.5\nstep = 1e-3\n",
            if side == "upper" { 1e-3 } else { -1e-3 }
        );
        fs::write(dir.join("case.toml"), case).unwrap();
        let mut tool = Command::new(env!("CARGO_BIN_EXE_signorini"));
        let output = tool.args(["explain", "case.toml"]).current_dir(dir).output().unwrap();
        String::from_utf8([output.stdout, output.stderr].concat())
            .unwrap()
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    for (force, side, rests) in
        [(35.0, "upper", true), (9.0, "upper", false), (-35.0, "upper", false), (-35.0, "lower", true)]
    {
        let said = explained(force, side);
        let told =
            said.contains("hold the body on wall \"stop\"") && said.contains("generalized-alpha rest on the face");
        assert_eq!(told, rests, "{force} N, {side}: {said}");
    }
}

#[test]
fn rows_of_a_sweep_with_negative_damping_are_told_once_and_say_so_themselves() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.modal]\nfrequencies = [10.0]\nmasses = [2.0]\ndamping_ratios = 0.05\nshapes = { p = [1.0] }\n\
                [[wall]]\nname = \"w\"\nat = { point = \"p\" }\nside = \"upper\"\nposition = 2e-3\nrestitution = 0.5\n\
                [[load]]\nat = { point = \"p\" }\nharmonic = { amplitude = 10.0, frequency = 8.0 }\n\
                [time]\nend = 0.2\nstep = 1e-3\n";
    fs::write(dir.path().join("grows.toml"), case).unwrap();
    let vary = ["--vary", "system.modal.damping_ratios=-0.02,0.02,0.05", "--measure", "force_rms", "--out", "out"];
    let (_, err) = crate::command::said(dir.path(), &[&["sweep", "grows.toml"], &vary[..]].concat(), 0);
    let told = "note: 1 of 3 rows is unstable by negative damping: without contact their motion grows";
    assert!(err.contains(told) && err.contains("(row 0; the column error says more)"), "{err}");
    assert!(!err.contains("runs have notes"), "{err}");
    let table = fs::read_to_string(dir.path().join("out/sweep.csv")).unwrap();
    let said = "0,-0.02,ok,\"the mode of 10.0000 Hz (-2.000e-2) has a negative damping ratio and is unstable";
    assert!(table.contains(said) && table.contains("2,0.05,ok,,"), "{table}");
}

#[test]
fn windows_that_begin_before_the_motion_has_settled_are_told_by_sweeps_as_by_runs() {
    let dir = tempfile::tempdir().unwrap();
    let fast = ["rigid-walls-sine", "--set", "initial.velocity=3", "--set", "time.step=1e-3", "--set", "time.end=4"];
    let (_, err) = crate::command::said(
        dir.path(),
        &[&["run"], &fast[..], &["--set", "wall.*.restitution=0.5", "--no-verdict", "--out", "run"]].concat(),
        0,
    );
    let note = err.lines().find_map(|line| line.strip_prefix("note: still settling: ")).expect("a note");
    let sweep = |out: &str, more: &[&str]| {
        let vary = ["--vary", "wall.*.restitution=0.5,0.6", "--measure", "force_mean", "--out", out];
        crate::command::said(dir.path(), &[&["sweep"], &fast[..], &vary, more].concat(), 0).1
    };
    let words =
        format!("note: 2 of 2 runs have not settled where their statistics begin; the first: still settling: {note}");
    let told = sweep("early", &[]);
    assert!(told.contains(&words), "{told}\n{words}");
    let later = sweep("later", &["--set", "time.statistics_from=2", "--set", "time.end=8", "--force"]);
    assert!(!later.contains("not settled"), "{later}");
}

/// Two masses in two planes, of which only the first is driven into its hole.
#[test]
fn a_support_that_is_never_touched_is_said_where_others_are() {
    let case = |second: &str, probe: &str| {
        let text = format!(
            "[system]\nplanes = 2\n[system.chain]\nmasses = [1.0, 1.0]\nsprings = 0.0\n\
             left = {{ stiffness = 100.0 }}\nright = {{ stiffness = 100.0 }}\n\
             [[support]]\nname = \"near\"\nat = {{ dof = 0 }}\nshape = \"round\"\ngap = 1e-3\nrestitution = 0.5\n\
             [[support]]\nname = \"far\"\nat = {{ dof = 1 }}\n{second}\nrestitution = 0.5\n\
             [[wall]]\nname = \"stop\"\nat = {{ dof = 1 }}\ndirection = 0\nside = \"upper\"\nposition = 1.0\n\
             restitution = 0.5\n[[load]]\nat = {{ dof = 0 }}\ndirection = 0\nconstant = {{ force = 1.0 }}\n\
             [[load]]\nat = {{ dof = 1 }}\ndirection = 90\nconstant = {{ force = 0.1 }}\n\
             {probe}[time]\nend = 1.0\nstep = 1e-3\n"
        );
        let case = signorini::case::Case::parse(&text, "two.toml", "").unwrap_or_else(|error| panic!("{error}"));
        notes(&case.scene, &MOREAU, 1e-3)
    };
    let probe = "[[probe]]\nname = \"second\"\nat = { dof = 1 }\n";
    // The body swings to twice the static 1 mm, along z.
    let round = case("shape = \"round\"\ngap = 3e-3", probe);
    let said = "no contact at the support \"far\": in the rows, the body stays within 2.000e-3 m of its centre, and \
                its gap is 3.000e-3 m";
    assert_eq!(round, said);
    let flats = case("shape = \"flats\"\nsides = 4\ngap = 3e-3", probe);
    assert_eq!(
        flats,
        "no contact at the support \"far\": in the rows, the body stays 1.000e-3 m from its wall \"far-flat-2\""
    );
    let blind = case("shape = \"round\"\ngap = 3e-3", "[[probe]]\nname = \"first\"\nat = { dof = 0 }\n");
    assert_eq!(blind, "no contact at the support \"far\"; no probe there shows how near the body came");
    // Where both are touched there is nothing to say: the wall is far on purpose.
    assert_eq!(case("shape = \"round\"\ngap = 1e-3", probe), "");
    // Sliders are pressed, and never apart.
    let pad = signorini::case::Embedded::named("dry-friction-damper").unwrap().case().unwrap();
    assert!(!notes(&pad.scene, &Scheme::Located, 1e-3).contains("no contact"));
}

/// Ratios in per cent are most likely a slip: they damp out what the case is about.
#[test]
fn a_damping_ratio_in_per_cent_has_a_note() {
    let beam = "[system.beam]\nlength = 1.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\n\
                inner_diameter = 0.0\nleft = \"pinned\"\nright = \"pinned\"\nelements = 10\n[system]\nmodes = 2\n\
                [[load]]\nat = { position = 0.5 }\nconstant = { force = 1.0 }\n[time]\nend = 0.1\nstep = 1e-5\n\
                [system.damping]\n";
    for (damping, percent) in
        [("ratio = 0.01", None), ("ratio = 1.5", Some("150 %")), ("ratios = [0.01, 5.0]", Some("500 %"))]
    {
        let text = format!("{beam}{damping}\n");
        let case = signorini::case::CaseFile::from_text(&text, "beam.toml", ".").case().unwrap();
        let odd: Vec<String> = case.notes().into_iter().filter(|note| note.contains("damping ratio")).collect();
        assert_eq!(odd.len(), usize::from(percent.is_some()), "{odd:?}");
        assert!(percent.is_none_or(|percent| odd[0].contains(percent)), "{odd:?}");
    }
}

/// Sizes in mm, moduli in GPa or MPa, densities in t/m³, gaps of metres and correlation lengths
/// beyond the tube are most likely slips.
#[test]
fn values_of_a_beam_in_other_units_have_a_note() {
    let said = |edits: &[(&str, &str)]| {
        let mut text = signorini::case::Embedded::named("tube-in-cross-flow").unwrap().text.to_owned();
        for (from, to) in edits {
            assert!(text.contains(from), "{from}");
            text = text.replace(from, to);
        }
        let case = signorini::case::CaseFile::from_text(&text, "tube.toml", ".").case().unwrap();
        case.notes().into_iter().filter(|note| note.contains("mind the unit")).collect::<Vec<_>>()
    };
    assert_eq!(said(&[]), [""; 0]);
    let millimetres = [
        ("outer_diameter = 19.05e-3", "outer_diameter = 19.05"),
        ("inner_diameter = 15.75e-3", "inner_diameter = 15.75"),
    ];
    let one: [(&[(&str, &str)], &str); 9] = [
        (&[("youngs_modulus = 200e9", "youngs_modulus = 200e3")], "a Young's modulus of 2e5 Pa is none of a solid"),
        (&[("density = 7850.0 ", "density = 7.85e-9 ")], "a density of 7.85e-9 kg/m³ is none of a structure"),
        (&[("density = 7850.0 ", "density = 7.85 ")], "a density of 7.85 kg/m³ is none of a structure"),
        (&[("youngs_modulus = 200e9", "youngs_modulus = 195e6")], "a Young's modulus of 1.95e8 Pa is that of no metal"),
        (&[("service = 1.262304e9 ", "service = 40.0 ")], "a service of 40.0 s is 0.67 minutes"),
        (&millimetres, "a beam 19.05 m wide and 3.0 m long"),
        (&millimetres[..1], "a beam 19.05 m wide and 3.0 m long"),
        (&[("gap = 0.2e-3", "gap = 0.2")], "the wall \"plate-1\" stands 0.2 m"),
        (&[("correlation_length = 0.06 ", "correlation_length = 60.0 ")], "turbulence 1: its correlation length of 60"),
    ];
    for (edits, expected) in one {
        let notes = said(edits);
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].starts_with(expected), "{notes:?}");
    }
}

/// Between two flats at 120 degrees rebounds by restitution press both, and drive the sliding: of
/// 0.205 J of the body friction alone would take 0.3 times the work, 0.235 J.
#[test]
fn friction_that_drives_the_motion_has_a_note() {
    let said = |restitution: &str| {
        let text = format!(
            "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 0.0\n[[support]]\n\
             name = \"corner\"\nshape = \"flats\"\ndirections = [0.0, 120.0]\ngap = 1e-3\n\
             restitution = {restitution}\nfriction = 0.3\n[initial]\n\
             displacement = {{ y = 0.001, z = 0.00173205080 }}\nvelocity = {{ y = 0.5, z = 0.4 }}\n[time]\n\
             end = 0.01\nstep = 1e-4\n"
        );
        let case = signorini::case::CaseFile::from_text(&text, "corner.toml", ".").case().unwrap();
        let run = run(&case.scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-4)).unwrap();
        let adds = run.statistics.wear[0].friction_power_w < 0.0;
        let note = run.cautions.iter().any(|note| note.starts_with("friction at the support \"corner\" adds"));
        (adds, note)
    };
    assert_eq!((said("0.5"), said("0.0")), ((true, true), (false, false)));
}
