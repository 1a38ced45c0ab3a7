//! Supports in case files: what the scene makes of them, and their way through a summary.
use signorini::case::{Case, CaseFile};
use signorini::wear::{Bearing, Scar};
use signorini::{Face, FrictionCoefficients, Options, Scheme, Wall, WallLaw, run};

/// An oscillator in two planes with a round support, flats, and [wear].
const BOTH: &str = r#"[system]
planes = 2
[system.oscillator]
mass = 1.3
damping = 0.1
stiffness = 50.0
[[support]]
name = "hole"
shape = "round"
gap = 2e-3
centre = [1e-4, -2e-4]
restitution = 0.4
friction = 0.3
width = 0.02
radius = 0.01
coefficient = 3e-15
[[support]]
name = "bars"
shape = "flats"
sides = 4
turn = 45
gap = [1e-3, 1e-3, 2e-3, 2e-3]
restitution = 0.6
friction = 0.1
[wear]
coefficient = 1e-14
support_coefficient = 2e-14
service = 3e8
sectors = 24
[time]
end = 1.0
step = 1e-3
"#;

fn parsed(text: &str) -> Case {
    Case::parse(text, "both.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_case_file_makes_the_supports_of_its_scene() {
    let case = parsed(BOTH);
    let [hole, bars] = case.scene.supports.as_slice() else { panic!("{:?}", case.scene.supports) };
    let walls = &case.scene.walls;
    let round = hole.hole(walls).unwrap();
    assert_eq!((round.index, round.gap, round.law), (0, 2e-3, WallLaw::Rigid { restitution: 0.4 }));
    assert_eq!((hole.centre, round.centre), ([1e-4, -2e-4], [1e-4, -2e-4]));
    assert_eq!((hole.friction(walls), bars.friction(walls)), (0.3.into(), 0.1.into()));
    let flats = bars.members(walls).map(|(index, wall)| match wall.face {
        Face::Flat { direction, .. } => (index, direction.unwrap()),
        Face::Round { .. } => panic!("{wall:?}"),
    });
    assert_eq!(flats.collect::<Vec<_>>(), [(1, 45.0), (2, 135.0), (3, 225.0), (4, 315.0)]);
    assert!(
        walls[1..].iter().all(|wall| wall.law == WallLaw::Rigid { restitution: 0.6 } && wall.friction == 0.1.into())
    );
    // Each place has its probes, named after its first support: both stand at the only mass.
    let names: Vec<&str> = case.scene.probes.iter().map(|probe| probe.name.as_str()).collect();
    assert_eq!(names, ["hole-y", "hole-z"]);
    assert_eq!(case.time.sectors, 24);
    // The hole has a coefficient of its own, and a scar; the bars have neither.
    let laws = [case.archard(0).unwrap(), case.archard(1).unwrap()];
    assert_eq!(laws.map(|law| law.coefficient), [Some(3e-15), Some(1e-14)]);
    assert_eq!(laws.map(|law| (law.support_coefficient, law.service)), [(Some(2e-14), 3e8); 2]);
    let scar = Scar { width: 0.02, radius: 0.01, bearing: Bearing::Hole { gap: 2e-3 } };
    assert_eq!(laws.map(|law| law.scar), [Some(scar), None]);
}

#[test]
fn a_hole_alone_gets_probes_and_a_beam_its_radius() {
    let text = BOTH.replace("[[support]]\nname = \"bars\"", "[[support]]\nname = \"other\"");
    let start = text.find("[[support]]\nname = \"other\"").unwrap();
    let end = text.find("[wear]").unwrap();
    let alone = parsed(&(text[..start].to_owned() + &text[end..]));
    let names: Vec<&str> = alone.scene.probes.iter().map(|probe| probe.name.as_str()).collect();
    assert_eq!(names, ["hole-y", "hole-z"]);
    assert_eq!(alone.scene.walls.iter().map(Wall::is_round).collect::<Vec<_>>(), [true]);
    let beam = "[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\n\
                elements = 8\nleft = \"pinned\"\nright = \"pinned\"\n";
    let from = BOTH.find("[system.oscillator]").unwrap();
    let to = BOTH.find("[[support]]").unwrap();
    let tube = (BOTH[..from].to_owned() + beam + &BOTH[to..]).replace("radius = 0.01\n", "");
    let tube = parsed(&tube.replace("shape = ", "at = { position = 1.0 }\nshape = "));
    assert_eq!(tube.archard(0).unwrap().scar.map(|scar| scar.radius), Some(0.01));
}

/// A single flat between two tubes is the other tube, in place of which several are bars.
#[test]
fn a_flat_between_two_tubes_is_the_other_tube() {
    let text = include_str!("../../cases/two-tubes.toml");
    let bearing = |text: &str| parsed(text).archard(0).unwrap().scar.unwrap().bearing;
    assert_eq!(bearing(text), Bearing::Tube { radius: 0.5 * 19.05e-3 });
    assert_eq!(bearing(&text.replace("directions = [0.0]", "directions = [0.0, 180.0]")), Bearing::Flat);
    assert!(!parsed(text).notes().join("\n").contains("on a flat"));
    // A body without a round section has a flat, which is said.
    let (before, after) = text.split_once("[[body]]\nname = \"right\"").unwrap();
    let (beam, after) = after.split_once("[[support]]").unwrap();
    let chain = beam.split_once("[body.beam]").unwrap().0.to_owned()
        + "[body.chain]\nmasses = [1.0]\nsprings = []\nleft = { stiffness = 1e4 }\n";
    let after =
        after.replace("relative_to = { body = \"right\", position = 1.0 }", "relative_to = { body = \"right\" }");
    let (supports, turbulence) = after.split_once("[[turbulence]]\nbody = \"right\"").unwrap();
    let wear = turbulence.split_once("[wear]").unwrap().1;
    let text = format!("{before}[[body]]\nname = \"right\"{chain}[[support]]{supports}[wear]{wear}");
    assert_eq!(bearing(&text), Bearing::Flat);
    assert!(parsed(&text).notes().join("\n").contains("is that of a tube on a flat: the body \"right\""));
}

/// A rod in its guide tube: scars are those of the rod, which `at` names first, and so is the wall
/// of which the limit is a share. Named first, the guide would have the scars of its outside.
#[test]
fn the_inner_one_of_two_tubes_is_named_first() {
    let text = include_str!("../../cases/two-tubes.toml");
    let round =
        text.replace("shape = \"flats\"\ndirections = [0.0]          # deg, from +y towards +z", "shape = \"round\"");
    let rod = round.replacen("outer_diameter = 19.05e-3", "outer_diameter = 15e-3", 1);
    let rod = rod.replacen("inner_diameter = 15.75e-3", "inner_diameter = 12e-3", 1);
    assert!(rod != round && round != text);
    let case = parsed(&rod);
    assert!((case.wear.limit.unwrap() / 0.6e-3 - 1.0).abs() < 1e-12);
    let scar = case.archard(0).unwrap().scar.unwrap();
    assert_eq!((scar.radius, scar.bearing), (7.5e-3, Bearing::Hole { gap: 0.1e-3 }));
    let exchanged = rod
        .replace("{ body = \"left\"", "{ body = \"x\"")
        .replace("relative_to = { body = \"right\"", "relative_to = { body = \"left\"");
    let exchanged = exchanged.replace("{ body = \"x\"", "{ body = \"right\"");
    let error = Case::parse(&exchanged, "guide.toml", "").unwrap_err().to_string();
    assert!(
        error.contains("`at` names first the tube around the other") && error.contains("the inner tube first"),
        "{error}"
    );
}

#[test]
fn a_summary_holds_the_supports_of_its_case() {
    // Read again from its JSON: the same case, also after a change of all restitutions.
    let pair = BOTH.replace("friction = 0.1", "friction = { static = 0.4, kinetic = 0.1 }");
    for text in [BOTH.to_owned(), BOTH.replace("turn = 45", "turn = 30\nwidth = 0.03\nradius = 0.01"), pair] {
        let case = parsed(&text);
        let changed = case.with("support.*.restitution", 0.25).unwrap();
        for case in [case, changed] {
            assert_eq!(parsed(&case.document.text().unwrap()), case);
        }
    }
}

#[test]
fn keys_reach_supports_and_wear() {
    let mut file = CaseFile::from_text(BOTH, "both.toml", "");
    for (key, value) in [
        ("support.hole.gap", 3e-3),
        ("support.hole.friction", 0.0),
        ("support.bars.friction", 0.0),
        ("wear.service", 1e7),
        ("wear.sectors", 6.0),
    ] {
        file.set(&key.parse().unwrap(), &value.into()).unwrap();
    }
    let case = file.case().unwrap();
    assert_eq!(case.scene.supports[0].hole(&case.scene.walls).unwrap().gap, 3e-3);
    assert!(case.scene.walls.iter().all(|wall| wall.friction == 0.0.into()));
    assert_eq!((case.time.sectors, case.wear.service), (6, Some(1e7)));
    assert_eq!("wear.coefficient".parse::<signorini::case::Key>().unwrap().unit(), Some("per_Pa"));
}

#[test]
fn friction_is_a_number_or_both_coefficients_and_keys_reach_each() {
    let with = |friction: &str| parsed(&BOTH.replace("friction = 0.1", friction)).scene;
    let both = FrictionCoefficients { sticking: 0.4, sliding: 0.1 };
    let scene = with("friction = { static = 0.4, kinetic = 0.1 }");
    assert!(scene.walls[1..].iter().all(|wall| wall.friction == both));
    assert_eq!(scene.supports[1].friction(&scene.walls), both);
    assert_eq!(with("friction = { kinetic = 0.1, static = 0.1 }"), with("friction = 0.1"));
    // As tables of results have it, and as keys change it.
    let mut file =
        CaseFile::from_text(&BOTH.replace("friction = 0.1", "friction = { static = 0.4, kinetic = 0.1 }"), "", "");
    let key = |text: &str| text.parse::<signorini::case::Key>().unwrap();
    file.set(&key("support.bars.friction.static"), &0.5.into()).unwrap();
    assert_eq!(file.case().unwrap().scene.walls[1].friction, FrictionCoefficients { sticking: 0.5, ..both });
    assert_eq!((key("support.*.friction.kinetic").word(), key("support.*.friction.static").unit()), ("kinetic", None));
    let error = file.set(&key("support.hole.friction.static"), &0.5.into()).unwrap_err().to_string();
    let table = "friction = { static = 0.3, kinetic = 0.3 }";
    assert!(error.contains(&format!("expected {table} there, in the file or by --set")), "{error}");
    // What it says to write is that, and can be varied.
    let mut file = CaseFile::from_text(&BOTH.replace("friction = 0.3", table), "", "");
    assert_eq!(file.case().unwrap().scene, with("friction = 0.1"));
    file.set(&key("support.hole.friction.static"), &0.5.into()).unwrap();
    assert_eq!(file.case().unwrap().scene.walls[0].friction.sticking, 0.5);
    let written = |friction: FrictionCoefficients| serde_json::to_value(friction).unwrap();
    assert_eq!(written(both), serde_json::json!({ "static": 0.4, "kinetic": 0.1 }));
    for friction in [both, 0.1.into()] {
        assert_eq!(serde_json::from_value::<FrictionCoefficients>(written(friction)).unwrap(), friction);
    }
}

#[test]
fn the_files_of_a_run_tell_of_its_supports() {
    // Flats alone, without friction: every scheme steps them.
    let start = BOTH.find("[[support]]\nname = \"bars\"").unwrap();
    let from = BOTH.find("[[support]]").unwrap();
    let text = (BOTH[..from].to_owned() + &BOTH[start..]).replace("friction = 0.1", "width = 0.03\nradius = 0.01");
    let text = text.replace("[time]", "[initial]\nvelocity = [0.3, 0.1]\n[time]");
    let case = parsed(&text);
    let run = run(&case.scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::new(case.time)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    signorini::output::supports::write(|name| Ok(folder.path().join(name)), &case, &run).unwrap();
    let read = |name: &str| -> Vec<Vec<String>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(folder.path().join(name)).unwrap();
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
    };
    let supports = read("supports.csv");
    let cell = |name: &str| {
        let column = supports[0].iter().position(|header| header == name).unwrap();
        supports[1][column].clone()
    };
    let number = |name: &str| cell(name).parse::<f64>().unwrap();
    assert_eq!((cell("support").as_str(), cell("work_rate_is").as_str()), ("bars", "upper figure"));
    let work = number("work_rate_W");
    assert!(work > 0.0 && number("friction_power_W") == 0.0);
    // Archard: volume = coefficient x work rate x service.
    assert!((number("worn_volume_m3") / (1e-14 * work * 3e8) - 1.0).abs() < 1e-14);
    assert!((number("support_worn_volume_m3") / (2e-14 * work * 3e8) - 1.0).abs() < 1e-14);
    let [scar, deepest, even] = ["one_scar", "deepest", "all_round"].map(|name| number(&format!("depth_{name}_m")));
    assert!(scar >= deepest && deepest > even, "{scar} {deepest} {even}");
    let sectors = read("sectors.csv");
    assert_eq!(sectors.len(), 25);
    let sum = |column: usize| sectors[1..].iter().map(|row| row[column].parse::<f64>().unwrap()).sum::<f64>();
    assert!((sum(4) / work - 1.0).abs() < 1e-12 && (sum(5) - 1.0).abs() < 1e-12);
    // The table of the terminal labels the work rate.
    let table = signorini::output::supports::table(&case, &run).unwrap().fit(None).text;
    assert!(table.contains("upper figure") && table.contains("bars"), "{table}");
    let remarks = signorini::output::supports::remarks(&case, &run).join("\n");
    assert!(remarks.contains("upper figure") && remarks.contains("3.000e8 s of service"), "{remarks}");
    let document = signorini::output::supports::document(&case, &run);
    assert_eq!(document[0]["upper_figure"], true);
    assert!((document[0]["worn"]["volume_m3"].as_f64().unwrap() / (1e-14 * work * 3e8) - 1.0).abs() < 1e-12);
}
