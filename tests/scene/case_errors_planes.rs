//! Wrong case files of structures in two planes: each gives one error that names file, line,
//! column, key and what would be accepted.
use crate::refused::{Wrong, not_refused};
use signorini::case::Case;

/// A valid case file. Each wrong one differs from it in one place.
const RIGHT: &str = r#"[system]
planes = 2
modes = 3

[system.beam]
length = 3.0
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 0.02
elements = 8
left = "pinned"
right = "pinned"

[system.damping]
ratios = [0.01, 0.02]

[[wall]]
name = "stop"
at = { position = 2.0 }
direction = 30
side = "upper"
position = 1e-3

[[support]]
name = "bars"
at = { position = 1.0 }
shape = "flats"
directions = [0, 120, 240]
gap = [1e-3, 2e-3, 1e-3]
centre = [0.0, 0.0]
restitution = 0.5

[[load]]
at = { position = 0.5 }
direction = 90
harmonic = { amplitude = 3.0, frequency = 5.0 }

[[probe]]
name = "middle"
at = { position = 1.5 }

[initial]
displacement = { y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }

[time]
end = 2.0
step = 1e-3
"#;

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    // Planes.
    ("three planes", "planes = 2", "planes = 3", "2:10", &["system.planes", "planes = 1, or 2"]),
    ("a rectangle in two planes", "outer_diameter = 0.02", "width = 0.05\nheight = 0.02", "2:10", &["`system.planes` is 2 beside a rectangular section", "planes = 2 takes a tube"]),
    ("half a plane", "planes = 2", "planes = 1.5", "2:10", &["system.planes", "1, or 2"]),
    ("text for planes", "planes = 2", "planes = \"two\"", "2:10", &["system.planes", "a number"]),
    ("fields of two planes in one", "planes = 2\n", "", "42:18", &["unknown key `y`", "profile"]),
    // Directions.
    ("a wall without direction", "direction = 30\n", "", "17:1", &["`direction` is missing in wall \"stop\"", "in deg"]),
    ("a wall to nowhere", "direction = 30", "direction = nan", "20:13", &["wall \"stop\": direction", "finite"]),
    ("a wall both ways", "direction = 30", "direction = \"both\"", "20:13", &["wall.direction", "a number, in deg"]),
    ("a load without direction", "direction = 90\n", "", "33:1", &["`direction` is missing in load 1", "in deg"]),
    ("a load to infinity", "direction = 90", "direction = inf", "35:13", &["load 1: direction", "finite"]),
    ("a load upwards", "direction = 90", "direction = \"up\"", "35:13", &["load 1: direction", "in deg"]),
    ("a direction of a row", "at = { position = 2.0 }", "at = { row = [[1, 1.0]] }", "20:13", &["a row and a direction", "no direction beside row"]),
    ("a direction of a probe's row", "at = { position = 1.5 }", "at = { row = [[1, 1.0]] }\ndirection = 0", "41:13", &["a row and a direction"]),
    ("a row beyond both planes", "at = { position = 2.0 }\ndirection = 30", "at = { row = [[32, 1.0]] }", "19:16", &["wall \"stop\": at: row", "from 0 to 31"]),
    ("a degree of freedom of the other plane", "at = { position = 2.0 }", "at = { dof = 16 }", "19:14", &["wall \"stop\": at: dof", "from 0 to 15"]),
    ("a wall at an end that is held", "at = { position = 2.0 }", "at = { position = 0.0 }", "19:6", &["nothing moves there"]),
    ("rows of planes on a beam", "at = { position = 2.0 }", "at = { y = [[0, 1.0]] }", "19:8", &["unknown key `y`", "position"]),
    // Supports.
    ("a support without a place", "at = { position = 1.0 }\n", "", "24:1", &["`at` is missing in support \"bars\"", "position"]),
    ("a support everywhere", "at = { position = 1.0 }", "at = \"each\"", "26:6", &["support \"bars\": at", "one place"]),
    ("a support of a row", "at = { position = 1.0 }", "at = { row = [[1, 1.0]] }", "26:6", &["support \"bars\": at", "one place"]),
    ("a support of no shape", "shape = \"flats\"\n", "", "24:1", &["`shape` is missing in `support`", "flats"]),
    ("a star", "shape = \"flats\"", "shape = \"star\"", "27:9", &["support \"bars\": shape", "\"flats\""]),
    ("no flats", "directions = [0, 120, 240]\ngap = [1e-3, 2e-3, 1e-3]", "directions = []\ngap = 1e-3", "28:14", &["directions is 0 flats", "from 1 to 360"]),
    ("a direction twice", "[0, 120, 240]", "[0, 120, 480]", "28:23", &["for the second time", "each direction once"]),
    ("a flat nowhere", "[0, 120, 240]", "[0, nan, 240]", "28:18", &["directions: value 2 is NaN", "finite"]),
    ("directions and sides", "[0, 120, 240]", "[0, 120, 240]\nsides = 3", "29:9", &["directions and sides", "sides = 3"]),
    ("directions and a turn", "[0, 120, 240]", "[0, 120, 240]\nturn = 3", "29:8", &["directions and sides", "turn"]),
    ("no sides", "directions = [0, 120, 240]", "sides = 0", "28:9", &["support \"bars\": sides", "1 to 360"]),
    ("too many sides", "directions = [0, 120, 240]", "sides = 361", "28:9", &["support \"bars\": sides", "1 to 360"]),
    ("half a side", "directions = [0, 120, 240]", "sides = 2.5", "28:9", &["support \"bars\": sides", "whole number"]),
    ("sides turned to nowhere", "directions = [0, 120, 240]", "sides = 3\nturn = inf", "29:8", &["support \"bars\": turn", "finite"]),
    ("neither directions nor sides", "directions = [0, 120, 240]\n", "", "24:1", &["`directions` is missing", "sides = 3"]),
    ("no gap", "gap = [1e-3, 2e-3, 1e-3]\n", "", "24:1", &["`gap` is missing in `support`", "in m"]),
    ("a negative gap", "gap = [1e-3, 2e-3, 1e-3]", "gap = -1e-3", "29:7", &["support \"bars\": gap", "-0.001", "0 or more"]),
    ("a negative gap among others", "2e-3, 1e-3]", "2e-3, -1e-3]", "29:20", &["gap: value 3 is -0.001", "0 or more"]),
    ("a gap that is no number", "gap = [1e-3, 2e-3, 1e-3]", "gap = nan", "29:7", &["gap: value 1 is NaN", "0 or more"]),
    ("a gap too few", "gap = [1e-3, 2e-3, 1e-3]", "gap = [1e-3, 2e-3]", "29:7", &["support \"bars\": gap", "a list of 3"]),
    ("a gap in words", "gap = [1e-3, 2e-3, 1e-3]", "gap = \"small\"", "29:7", &["support \"bars\": gap", "a number"]),
    ("a centre of one number", "centre = [0.0, 0.0]", "centre = [0.0]", "30:10", &["support \"bars\": centre", "[y, z]"]),
    ("a centre nowhere", "centre = [0.0, 0.0]", "centre = [0.0, nan]", "30:10", &["centre is NaN", "finite"]),
    ("restitution beside stiffness", "restitution = 0.5", "restitution = 0.5\nstiffness = 1e6", "31:15", &["support \"bars\" has both restitution and stiffness"]),
    ("restitution above 1", "restitution = 0.5", "restitution = 1.5", "31:15", &["restitution is 1.5", "from 0 to 1"]),
    ("a dashpot of a rigid support", "restitution = 0.5", "damping = 3.0", "31:11", &["support \"bars\" has damping without stiffness"]),
    ("a support that begins behind a flat", "centre = [0.0, 0.0]", "centre = [5e-3, 0.0]", "43:16", &["initial.displacement", "bars-flat-2", "equilibrium = true"]),
    ("two supports of one name", "[[load]]", "[[support]]\nname = \"bars\"\nat = { position = 2.0 }\nshape = \"flats\"\nsides = 4\ngap = 1e-3\n\n[[load]]", "34:8", &["support \"bars\": name", "a name of its own"]),
    ("a wall with the name of a flat", "name = \"stop\"", "name = \"bars-flat-1\"", "25:8", &["name", "another wall has"]),
    ("an unknown key of a support", "shape = \"flats\"", "shape = \"flats\"\nfriktion = 0.2", "28:1", &["unknown key `friktion`"]),
    // Friction and wear.
    ("growth of a hole at flats", "restitution = 0.5", "restitution = 0.5\ngrowth = \"shifted\"", "32:10", &["support \"bars\": growth", "\"flats\"", "their gaps stay"]),
    ("growth by sectors", "restitution = 0.5", "restitution = 0.5\ngrowth = \"sectors\"", "32:10", &["support \"bars\": growth is \"sectors\""]),
    ("growth by a number", "restitution = 0.5", "restitution = 0.5\ngrowth = 1", "32:10", &["support.growth", "\"shifted\""]),
    ("friction that pushes", "restitution = 0.5", "restitution = 0.5\nfriction = -0.1", "32:12", &["support \"bars\": friction is -0.1", "0 or more"]),
    ("friction of no size", "restitution = 0.5", "restitution = 0.5\nfriction = nan", "32:12", &["support \"bars\": friction is NaN", "0 or more"]),
    ("friction beyond all bodies", "restitution = 0.5", "restitution = 0.5\nfriction = 11.0", "32:12", &["support \"bars\": friction is 11.0", "from 0 to 10"]),
    ("friction of both kinds, the wrong way round", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 0.2, kinetic = 0.3 }", "32:23", &["support \"bars\": friction: static is 0.2", "at least the kinetic coefficient, 0.3"]),
    ("static friction that pushes", "restitution = 0.5", "restitution = 0.5\nfriction = { static = -0.2, kinetic = 0.1 }", "32:23", &["support \"bars\": friction: static is -0.2", "0 or more"]),
    ("kinetic friction that pushes", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 0.2, kinetic = -0.1 }", "32:38", &["support \"bars\": friction: kinetic is -0.1", "0 or more"]),
    ("static friction of no size", "restitution = 0.5", "restitution = 0.5\nfriction = { static = nan, kinetic = 0.1 }", "32:23", &["support \"bars\": friction: static is NaN", "0 or more"]),
    ("kinetic friction without end", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 0.2, kinetic = inf }", "32:38", &["support \"bars\": friction: kinetic is inf", "0 or more"]),
    ("friction without end", "restitution = 0.5", "restitution = 0.5\nfriction = inf", "32:12", &["support \"bars\": friction is inf", "0 or more"]),
    ("static friction beyond all bodies", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 11.0, kinetic = 0.1 }", "32:23", &["support \"bars\": friction: static is 11.0", "from 0 to 10"]),
    ("static friction alone", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 0.2 }", "32:12", &["support \"bars\": friction has no kinetic coefficient", "{ static = .., kinetic = .. }"]),
    ("kinetic friction alone", "restitution = 0.5", "restitution = 0.5\nfriction = { kinetic = 0.2 }", "32:12", &["support \"bars\": friction has no static coefficient", "{ static = .., kinetic = .. }"]),
    ("friction of a third kind", "restitution = 0.5", "restitution = 0.5\nfriction = { static = 0.2, dynamic = 0.1 }", "32:28", &["unknown key `dynamic` in `support.friction`", "{ static = .., kinetic = .. }"]),
    ("friction in words", "restitution = 0.5", "restitution = 0.5\nfriction = \"rough\"", "32:12", &["`support.friction` takes a number or a table, not text", "friction = a number"]),
    ("static friction in words", "restitution = 0.5", "restitution = 0.5\nfriction = { static = \"high\", kinetic = 0.1 }", "32:23", &["`support.friction.static` takes a number, not text", "from 0 to 10"]),
    ("no width", "restitution = 0.5", "restitution = 0.5\nwidth = 0.0", "32:9", &["support \"bars\": width", "above 0, in m"]),
    ("a radius beside that of a beam", "restitution = 0.5", "restitution = 0.5\nwidth = 0.02\nradius = 0.01", "33:10", &["a radius, and the system is a beam", "outer_diameter"]),
    ("a depth without a width", "restitution = 0.5", "restitution = 0.5\nradius = 0.01", "32:10", &["support \"bars\" has a radius and no width", "in m along the tube"]),
    ("a width in mm", "restitution = 0.5", "restitution = 0.5\nwidth = 25.0", "32:9", &["support \"bars\": width", "at most the beam's length"]),
    ("wear that adds", "restitution = 0.5", "restitution = 0.5\ncoefficient = -1e-14", "32:15", &["support \"bars\": coefficient", "above 0, in 1/Pa"]),
    ("wear of the support that adds", "restitution = 0.5", "restitution = 0.5\nsupport_coefficient = nan", "32:23", &["support \"bars\": support_coefficient", "above 0, in 1/Pa"]),
    ("a material of none", "restitution = 0.5", "restitution = 0.5\nmaterial = \"690-410\"", "32:12", &["support \"bars\": no material is named \"690-410\"", "of which there is none"]),
    ("a material of another name", "[[support]]", "[[material]]\nname = \"690-410\"\ncoefficient = 1e-14\n\n[[support]]\nmaterial = \"690\"", "29:12", &["support \"bars\": no material is named \"690\"", "expected the name of a [[material]]: \"690-410\""]),
    ("a material and a coefficient", "[[support]]", "[[material]]\nname = \"690-410\"\ncoefficient = 1e-14\n\n[[support]]\nmaterial = \"690-410\"\ncoefficient = 1e-14", "30:15", &["support \"bars\" has a material and a coefficient", "expected one of both"]),
    ("a material without coefficients", "[[support]]", "[[material]]\nname = \"690-410\"\n\n[[support]]", "24:1", &["material \"690-410\" has no wear coefficient", "coefficient of the tube, support_coefficient or both"]),
    ("a material that adds", "[[support]]", "[[material]]\nname = \"690-410\"\ncoefficient = -1e-14\n\n[[support]]", "26:15", &["material \"690-410\": coefficient", "above 0, in 1/Pa"]),
    ("two materials of a name", "[[support]]", "[[material]]\nname = \"690\"\ncoefficient = 1e-14\n\n[[material]]\nname = \"690\"\ncoefficient = 1e-14\n\n[[support]]", "29:8", &["two materials are named \"690\"", "a name of its own"]),
    ("a material of two words", "[[support]]", "[[material]]\nname = \"690 410\"\ncoefficient = 1e-14\n\n[[support]]", "25:8", &["material: name", "letters, digits, - and _"]),
    ("no wear", "[time]", "[wear]\ncoefficient = 0.0\nservice = 1.0\n\n[time]", "46:15", &["wear: coefficient", "above 0, in 1/Pa"]),
    ("wear of infinity", "[time]", "[wear]\nsupport_coefficient = inf\nservice = 1.0\n\n[time]", "46:23", &["wear: support_coefficient", "above 0, in 1/Pa"]),
    ("a limit of no depth", "[system.beam]", "[wear]\ncoefficient = 1e-14\nlimit = 0.4\n\n[system.beam]\ninner_diameter = 0.016", "7:9", &["`wear.limit` without a support that has a width", "expected a support with width"]),
    ("a limit of no wear", "[system.beam]", "[[support]]\nname = \"plate\"\nat = { position = 2.0 }\nshape = \"round\"\ngap = 1e-3\nwidth = 0.02\n\n[wear]\nlimit = 0.4\n\n[system.beam]\ninner_diameter = 0.016", "13:9", &["a limit and no coefficient", "in 1/Pa"]),
    ("a limit of the support's wear", "[system.beam]", "[[support]]\nname = \"plate\"\nat = { position = 2.0 }\nshape = \"round\"\ngap = 1e-3\nwidth = 0.02\n\n[wear]\nsupport_coefficient = 1e-14\nlimit = 0.4\n\n[system.beam]\ninner_diameter = 0.016", "14:9", &["without a coefficient of the tube at support \"plate\"", "expected coefficient, in 1/Pa"]),
    ("a wall of a beam", "[[support]]", "[[support]]\nwall = 1e-3", "25:8", &["has a wall, and the system is a beam", "expected no wall"]),
    ("no time in service", "[time]", "[wear]\ncoefficient = 1e-14\nservice = 0.0\n\n[time]", "47:11", &["wear: service", "above 0, in s"]),
    ("service backwards", "[time]", "[wear]\ncoefficient = 1e-14\nservice = -1.0\n\n[time]", "47:11", &["wear: service", "above 0, in s"]),
    ("a service of what", "[time]", "[wear]\nservice = 1.0\n\n[time]", "46:11", &["a service and no coefficient", "in 1/Pa"]),
    ("no sectors", "[time]", "[wear]\nsectors = 0\n\n[time]", "46:11", &["wear.sectors is 0", "from 1 to 3600"]),
    ("too many sectors", "[time]", "[wear]\nsectors = 3601\n\n[time]", "46:11", &["wear.sectors is 3601", "from 1 to 3600"]),
    ("half a sector", "[time]", "[wear]\nsectors = 2.5\n\n[time]", "46:11", &["wear.sectors is 2.5", "whole number"]),
    ("an unknown key of wear", "[time]", "[wear]\nservise = 1.0\n\n[time]", "46:1", &["unknown key `servise`", "service"]),
    // Fields.
    ("a list of one plane", "displacement = { y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }", "displacement = [0.0, 0.0]", "43:16", &["initial.displacement has 2 values", "32 numbers"]),
    ("a profile of both planes", "{ y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }", "{ profile = [[0.0, 0.0], [3.0, 0.0]] }", "43:18", &["unknown key `profile`", "y = .., z = .."]),
    ("a number for a plane", "{ y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }", "{ z = 1.0 }", "43:22", &["initial.displacement.z", "takes no number", "profile"]),
    ("more modes than a plane has", "modes = 3", "modes = 17", "3:9", &["modes", "16"]),
];

/// Wrong round supports in place of the flats of `RIGHT`: what is wrong, the lines between `at` and
/// `centre`, the restitution, line:column, what the message must contain.
type WrongHole = (&'static str, &'static str, &'static str, &'static str, &'static [&'static str]);

#[rustfmt::skip]
const WRONG_HOLES: &[WrongHole] = &[
    ("a pin", "shape = \"round\"\ngap = 0.0", "restitution = 0.5", "28:7", &["support \"bars\": gap is 0.0", "a pin, not a support"]),
    ("a negative gap", "shape = \"round\"\ngap = -1e-3", "restitution = 0.5", "28:7", &["support \"bars\": gap is -1e-3", "above 0, in m"]),
    ("a gap that is no number", "shape = \"round\"\ngap = nan", "restitution = 0.5", "28:7", &["support \"bars\": gap", "above 0, in m"]),
    ("a gap without end", "shape = \"round\"\ngap = inf", "restitution = 0.5", "28:7", &["support \"bars\": gap", "above 0, in m"]),
    ("gaps of a hole", "shape = \"round\"\ngap = [1e-3, 2e-3]", "restitution = 0.5", "28:7", &["support \"bars\": gap", "above 0, in m"]),
    ("no gap", "shape = \"round\"", "restitution = 0.5", "24:1", &["`gap` is missing in `support`", "in m"]),
    ("sides of a hole", "shape = \"round\"\ngap = 1e-3\nsides = 4", "restitution = 0.5", "29:9", &["is round and has sides", "\"flats\""]),
    ("directions of a hole", "shape = \"round\"\ngap = 1e-3\ndirections = [0]", "restitution = 0.5", "29:14", &["is round and has directions", "\"flats\""]),
    ("a turn of a hole", "shape = \"round\"\ngap = 1e-3\nturn = 4", "restitution = 0.5", "29:8", &["is round and has turn", "\"flats\""]),
    ("growth of flats at a hole", "shape = \"round\"\ngap = 1e-3", "growth = \"flats\"", "30:10", &["support \"bars\": growth", "\"even\" or \"shifted\""]),
    ("a hole of no stiffness", "shape = \"round\"\ngap = 1e-3", "stiffness = 0.0", "30:13", &["support \"bars\": stiffness is 0.0"]),
    ("a damped hole", "shape = \"round\"\ngap = 1e-3", "damping = 3.0", "30:11", &["has damping without stiffness"]),
    ("too much restitution", "shape = \"round\"\ngap = 1e-3", "restitution = 1.5", "30:15", &["support \"bars\": restitution is 1.5", "from 0 to 1"]),
    ("negative restitution", "shape = \"round\"\ngap = 1e-3", "restitution = -0.5", "30:15", &["support \"bars\": restitution is -0.5", "from 0 to 1"]),
    ("friction of a hole", "shape = \"round\"\ngap = 1e-3", "friction = -0.5", "30:12", &["support \"bars\": friction is -0.5", "0 or more"]),
];

#[test]
fn every_wrong_round_support_is_refused_at_its_place() {
    let flats = "shape = \"flats\"\ndirections = [0, 120, 240]\ngap = [1e-3, 2e-3, 1e-3]";
    let mut failures = String::new();
    for (what, shape, law, place, words) in WRONG_HOLES {
        assert!(RIGHT.contains(flats));
        let text = RIGHT.replacen(flats, shape, 1).replacen("restitution = 0.5", law, 1);
        let said = match Case::parse(&text, "wrong.toml", "") {
            Ok(_) => "ACCEPTED".to_owned(),
            Err(error) => error.to_string(),
        };
        let at = format!("--> wrong.toml:{place}\n");
        let fits = said.contains(&at) && said.contains("expected") && words.iter().all(|word| said.contains(word));
        if !fits || !said.is_ascii() {
            failures += &format!("{what}: wanted {place} and {words:?}\n{said}\n\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_round_support_refuses_what_it_cannot_stand_beside() {
    let flats = "shape = \"flats\"\ndirections = [0, 120, 240]\ngap = [1e-3, 2e-3, 1e-3]";
    let round = RIGHT.replacen(flats, "shape = \"round\"\ngap = 1e-3", 1);
    let case = Case::parse(&round, "right.toml", "").unwrap_or_else(|error| panic!("{error}"));
    // The stop and the hole.
    assert_eq!((case.scene.walls.len(), case.scene.supports.len()), (2, 1));
    let start = "displacement = { y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }";
    for (old, new, place, words) in [
        // Outside of the hole: at the start, or, where it is left out, at the gap.
        (
            "centre = [0.0, 0.0]",
            "centre = [3e-3, 4e-3]",
            "42:16",
            "0.005 m from the centre of the round support \"bars\"",
        ),
        ("centre = [0.0, 0.0]", "centre = [3e-3, 4e-3]", "28:7", "at most its gap, 0.001 m"),
        ("modes = 3", "modes = 3\nstatic_correction = true", "28:9", "static_correction is true"),
    ] {
        assert!(round.contains(old));
        let text = round.replacen(old, new, 1);
        let text = if place == "28:7" { text.replacen(start, "", 1) } else { text };
        let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(&format!("--> wrong.toml:{place}")) && said.contains(words), "{said}");
    }
    // A start on the circle, to its last digits, is inside.
    let on = round.replacen("centre = [0.0, 0.0]", "centre = [6.000000000000001e-4, 8.000000000000001e-4]", 1);
    assert!(Case::parse(&on, "on.toml", "").is_ok());
    // An elastic hole, in which it may begin behind the gap.
    let soft = "restitution = 0.5";
    assert!(round.contains(soft));
    let soft = round.replacen(soft, "stiffness = 1e6\ndamping = 2.0", 1).replacen(
        "centre = [0.0, 0.0]",
        "centre = [2e-3, 0.0]",
        1,
    );
    let scene = Case::parse(&soft, "soft.toml", "").unwrap_or_else(|error| panic!("{error}")).scene;
    let law = signorini::WallLaw::Elastic { stiffness: 1e6, damping: 2.0 };
    let hole = scene.supports[0].hole(&scene.walls).unwrap();
    assert_eq!((hole.gap, hole.law), (1e-3, law));
    // In a hole off by five gaps the tube begins in static equilibrium, on its circle.
    let off =
        round.replacen("centre = [0.0, 0.0]", "centre = [3e-3, 4e-3]", 1).replacen(start, "equilibrium = true", 1);
    let scene = Case::parse(&off, "off.toml", "").unwrap_or_else(|error| panic!("{error}")).scene;
    let [y, z] = scene.supports[0].hole(&scene.walls).unwrap().offset(&scene.initial.q);
    assert!((y.hypot(z) - 1e-3).abs() < 1e-15, "{y} {z}");
}

#[test]
fn wear_without_a_support_or_a_radius_is_refused() {
    let oscillator = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n";
    let rest = "[time]\nend = 1.0\nstep = 1e-3\n";
    for (wrong, words) in [
        ("[wear]\ncoefficient = 1e-14\nservice = 1.0\n", "`wear` without a support"),
        ("[[support]]\nname = \"s\"\nshape = \"round\"\ngap = 1e-3\nwidth = 0.02\n", "a width and no radius"),
    ] {
        let said = Case::parse(&format!("{oscillator}{wrong}{rest}"), "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(words) && said.contains("expected"), "{said}");
    }
}

/// Supports that name a material have its coefficients, which a key of it changes in all of them;
/// what a material does not say is that of `[wear]`.
#[test]
fn a_material_gives_the_coefficients_of_the_supports_that_name_it() {
    let materials = "[[material]]\nname = \"690-410\"\ncoefficient = 2e-14\n\n\
                     [[material]]\nname = \"soft\"\ncoefficient = 1e-13\nsupport_coefficient = 3e-13\n\n";
    let plate = "[[support]]\nname = \"plate\"\nmaterial = \"690-410\"\nat = { position = 2.5 }\n\
                 shape = \"round\"\ngap = 1e-3\n\n";
    let bars = format!("{materials}{plate}[[support]]\nmaterial = \"690-410\"");
    let text = RIGHT.replacen("[[support]]", &bars, 1).replacen(
        "[time]",
        "[wear]\ncoefficient = 1e-15\nsupport_coefficient = 5e-15\nservice = 1.0\n\n[time]",
        1,
    );
    let case = Case::parse(&text, "right.toml", "").unwrap_or_else(|error| panic!("{error}"));
    let coefficients = |case: &Case| {
        [0, 1].map(|index| case.archard(index).map(|law| (law.coefficient, law.support_coefficient)).unwrap())
    };
    assert_eq!(coefficients(&case), [(Some(2e-14), Some(5e-15)); 2]);
    let harder = case.with("material.690-410.coefficient", 1e-16).unwrap();
    assert_eq!(coefficients(&harder), [(Some(1e-16), Some(5e-15)); 2]);
    let soft = case.with("support.bars.material", "soft").unwrap();
    let index = soft.scene.supports.iter().position(|support| support.name == "bars").unwrap();
    assert_eq!(coefficients(&soft)[index], (Some(1e-13), Some(3e-13)));
}

#[test]
fn a_wear_coefficient_in_other_units_gets_a_note() {
    let wear = |k: &str| RIGHT.replacen("[time]", &format!("[wear]\ncoefficient = {k}\nservice = 1e8\n\n[time]"), 1);
    let notes = |k: &str| Case::parse(&wear(k), "right.toml", "").unwrap_or_else(|error| panic!("{error}")).notes();
    assert!(notes("1e-14").iter().all(|note| !note.contains("1/Pa")));
    assert!(notes("1e-8").iter().any(|note| note.contains("mind the unit")));
}

#[test]
fn the_case_that_the_wrong_ones_start_from_is_right() {
    let case = Case::parse(RIGHT, "right.toml", "").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(case.scene.walls.len(), 4);
    assert_eq!(case.scene.probes.len(), 2);
}

#[test]
fn every_wrong_case_file_is_refused_at_its_place() {
    let failures = not_refused(RIGHT, WRONG);
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_point_of_modes_in_two_planes_has_a_shape_in_each() {
    let case = |shapes: &str, at: &str| {
        let text = format!(
            "[system]\nplanes = 2\n[system.modal]\nfrequencies = [1.0, 2.0]\nshapes = {{ {shapes} }}\n\
             [[support]]\nname = \"s\"\nat = {at}\nshape = \"round\"\ngap = 1e-3\nrestitution = 0.5\n\
             [time]\nend = 1.0\nstep = 1e-3\n"
        );
        Case::parse(&text, "wrong.toml", "").map(|_| ()).map_err(|error| error.to_string())
    };
    let both = "tip-y = [1.0, 2.0], tip-z = [0.5, 0.0], end-y = [1.0, 1.0]";
    assert_eq!(case(both, "{ point = \"tip\" }"), Ok(()));
    assert_eq!(case(both, "{ points = [[\"tip\", -2.0]] }"), Ok(()));
    for (shapes, at, words) in [
        (both, "{ point = \"tip-y\" }", "a point with the shapes NAME-y and NAME-z: tip"),
        (both, "{ point = \"end\" }", "a point with the shapes NAME-y and NAME-z: tip"),
        ("tip = [1.0, 2.0]", "{ point = \"tip\" }", "in two planes shapes must define both"),
        (both, "{ dof = 0 }", "a mode in two planes has no direction"),
        (both, "\"each\"", "at = { point = \"tip\" } (of tip)"),
        ("tip-y = [0.0, 0.0], tip-z = [0.0, 0.0]", "{ point = \"tip\" }", "nothing moves there"),
    ] {
        let said = case(shapes, at).unwrap_err();
        assert!(said.contains("--> wrong.toml:8:") && said.contains(words), "{at}: {said}");
    }
}

#[test]
fn a_system_that_has_no_two_planes_says_what_to_do() {
    let rest = "[time]\nend = 1.0\nstep = 1e-3\n";
    let bar = "[system.bar]\nlength = 1.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\n\
               elements = 4\nleft = \"free\"\nright = \"clamped\"\n";
    let said = Case::parse(&format!("[system]\nplanes = 2\n{bar}{rest}"), "wrong.toml", "").unwrap_err().to_string();
    assert!(said.contains("--> wrong.toml:2:10\n") && said.contains("a tube in bending is a beam"), "{said}");
    let oscillator = "[system]\nplanes = 1\n[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n";
    for (wrong, words) in [
        ("[[support]]\nname = \"s\"\nshape = \"flats\"\nsides = 4\ngap = 1e-3\n", "expected planes = 2"),
        ("[[load]]\ndirection = 0\nconstant = { force = 1.0 }\n", "moves in one plane"),
        ("[[probe]]\nname = \"p\"\ndirection = 0\n", "moves in one plane"),
    ] {
        let said = Case::parse(&format!("{oscillator}{wrong}{rest}"), "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn flats_on_one_side_are_no_error_but_a_note() {
    let open = RIGHT.replace("[0, 120, 240]", "[0, 10, 20]");
    let case = Case::parse(&open, "open.toml", "").unwrap_or_else(|error| panic!("{error}"));
    assert!(case.notes().iter().any(|note| note.contains("\"bars\" stand within a half turn")), "{:?}", case.notes());
    // Opposite flats bound the motion both ways along their line.
    for (directions, free) in [("[0, 180]", "towards 90° and 270° free"), ("[180, 90, 0]", "towards 270° free")] {
        let opposite = RIGHT.replace("[0, 120, 240]", directions).replace("[1e-3, 2e-3, 1e-3]", "1e-3");
        let notes = Case::parse(&opposite, "opposite.toml", "").unwrap_or_else(|error| panic!("{error}")).notes();
        let said = format!("the flats of support \"bars\" leave the motion {free}");
        assert!(notes.contains(&said) && notes.iter().all(|note| !note.contains("half turn")), "{notes:?}");
    }
    let closed = Case::parse(RIGHT, "closed.toml", "").unwrap_or_else(|error| panic!("{error}"));
    assert!(closed.notes().iter().all(|note| !note.contains("half turn")));
}

/// Wrong loads in place of the one of `RIGHT`: what is wrong, the keys of the load, line:column,
/// what the message must contain.
type WrongLoad = (&'static str, &'static str, &'static str, &'static [&'static str]);

#[rustfmt::skip]
const WRONG_LOADS: &[WrongLoad] = &[
    ("both ways of a sine", "at = { position = 0.5 }\ndirection = \"both\"\nharmonic = { amplitude = 1.0, frequency = 2.0 }", "35:13", &["load 1: direction", "random"]),
    ("both ways of a row", "at = { row = [[1, 1.0]] }\ndirection = \"both\"\nrandom = { rms = 1.0, from = 1.0, to = 5.0 }", "35:13", &["load 1 has no place in both planes"]),
    ("no density", "at = { position = 0.5 }\ndirection = 0\nrandom = { seed = 1 }", "36:10", &["load 1: random has no density", "psd"]),
    ("two densities", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 1.0, to = 5.0, psd = [[1.0, 1.0], [2.0, 1.0]] }", "36:51", &["two densities", "rms (N)"]),
    ("no end of the band", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 1.0 }", "36:10", &["`to` is missing in load 1: random"]),
    ("no force", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 0.0, from = 1.0, to = 5.0 }", "36:18", &["load 1: random: rms is 0.0", "above 0"]),
    ("a band from zero", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 0.0, to = 5.0 }", "36:30", &["load 1: random: from is 0.0", "above 0"]),
    ("a band backwards", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 5.0, to = 5.0 }", "36:40", &["load 1: random: to is 5.0", "more than from"]),
    ("a band without a line", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 0.1, to = 0.4 }", "36:40", &["0.1 to 0.4 Hz, without a line", "1/end = 5e-1 Hz"]),
    ("a band beyond all tables", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 1.0, to = 1e9 }", "36:40", &["2^24 rows", "at most"]),
    ("half a seed", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 1.0, to = 5.0, seed = 0.5 }", "36:52", &["load 1: random: seed", "a whole number"]),
    ("a negative seed", "at = { position = 0.5 }\ndirection = 0\nrandom = { rms = 1.0, from = 1.0, to = 5.0, seed = -1 }", "36:52", &["load 1: random: seed", "a whole number"]),
    ("a density of one point", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[1.0, 0.5]] }", "36:18", &["psd is 1 pairs", "two pairs"]),
    ("a density at zero", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[0.0, 0.5], [2.0, 0.5]] }", "36:18", &["psd: value 1: frequency is 0.0", "above 0"]),
    ("a density at negative frequencies", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[-1.0, 0.5], [2.0, 0.5]] }", "36:18", &["psd: value 1: frequency is -1.0", "above 0"]),
    ("a frequency twice", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[1.0, 0.5], [1.0, 0.4]] }", "36:18", &["psd: value 2: frequency is 1.0", "more than the one before"]),
    ("frequencies backwards", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[2.0, 0.5], [1.0, 0.4]] }", "36:18", &["psd: value 2: frequency is 1.0", "more than the one before"]),
    ("a negative density", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [[1.0, 0.5], [2.0, -0.4]] }", "36:18", &["psd: value 2: density is -0.4", "above 0"]),
    ("a density of numbers", "at = { position = 0.5 }\ndirection = 0\nrandom = { psd = [1.0, 0.5] }", "36:19", &["load 1: random: psd", "pairs"]),
    ("a density nowhere", "at = { position = 0.5 }\ndirection = 0\nrandom = { file = \"no.csv\" }", "36:19", &["load 1: random: file \"no.csv\"", "no such file", "density_N2_per_Hz"]),
    ("random and constant", "at = { position = 0.5 }\ndirection = 0\nconstant = { force = 1.0 }\nrandom = { rms = 1.0, from = 1.0, to = 5.0 }", "37:10", &["two kinds, `constant` and `random`"]),
    ("a shaken place", "at = { position = 0.5 }\ndirection = 0\nbase = { file = \"no.csv\" }", "34:6", &["load 1 has a place and a base", "no at"]),
    ("shaken nowhere", "direction = 0\nbase = { file = \"no.csv\" }", "35:17", &["load 1: base \"no.csv\"", "no such file", "acceleration_m_per_s2"]),
    ("shaken without direction", "base = { file = \"no.csv\" }", "34:8", &["`direction` is missing in load 1", "in deg"]),
    ("shaken to nowhere", "direction = nan\nbase = { file = \"no.csv\" }", "34:13", &["load 1: direction", "finite"]),
    ("the influence of a tube", "direction = 0\nbase = { file = \"no.csv\", influence = { row = [[0, 1.0]] } }", "35:39", &["influence beside a beam", "matrices and modal data"]),
    ("shaken times nothing", "direction = 0\nbase = { file = \"no.csv\", scale = inf }", "35:35", &["load 1: base: scale", "m/s^2"]),
];

#[test]
fn every_wrong_random_load_and_base_motion_is_refused_at_its_place() {
    let right = "at = { position = 0.5 }\ndirection = 90\nharmonic = { amplitude = 3.0, frequency = 5.0 }";
    let mut failures = String::new();
    for (what, load, place, words) in WRONG_LOADS {
        assert!(RIGHT.contains(right));
        let said = match Case::parse(&RIGHT.replacen(right, load, 1), "wrong.toml", "") {
            Ok(_) => "ACCEPTED".to_owned(),
            Err(error) => error.to_string(),
        };
        let at = format!("--> wrong.toml:{place}\n");
        let fits = said.contains(&at) && said.contains("expected") && words.iter().all(|word| said.contains(word));
        if !fits || !said.is_ascii() {
            failures += &format!("{what}: wanted {place} and {words:?}\n{said}\n\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn every_wrong_start_and_ratio_is_refused_at_its_place() {
    let start = "displacement = { y = { profile = [[0.0, 0.0], [3.0, 0.0]] } }";
    for (old, new, place, words) in [
        (start, "equilibrium = true\nvelocity = [0.0]", "44:12", "beside a start"),
        (start, "equilibrium = 1", "43:15", "initial.equilibrium"),
        ("ratios = [0.01, 0.02]", "ratios = [0.01, -1.0]", "15:17", "above -1"),
        ("ratios = [0.01, 0.02]", "ratios = [nan]", "15:11", "above -1"),
        ("modes = 3\n", "", "", "cut to modes"),
    ] {
        assert!(RIGHT.contains(old));
        let text = RIGHT.replacen(old, new, 1);
        // Without modes, negative ratios.
        let text = if new.is_empty() { text.replace("[0.01, 0.02]", "[-0.01, 0.02]") } else { text };
        let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(&format!("--> wrong.toml:{place}")) && said.contains(words), "{said}");
    }
    // Matrices and modal data say how the base moves them.
    let modal = "[system.modal]\nfrequencies = [1.0, 2.0]\nshapes = { tip = [1.0, 2.0] }\n[[load]]\n";
    for (base, words) in [
        ("base = { file = \"no.csv\" }", "`influence` is missing"),
        ("base = { file = \"no.csv\", influence = 1.0 }", "row = [[0, 1.0], ..]"),
        ("base = { file = \"no.csv\", influence = { row = [[2, 1.0]] } }", "from 0 to 1"),
        ("direction = 0\nbase = { file = \"no.csv\", influence = { row = [[0, 1.0]] } }", "moves in one plane"),
    ] {
        let text = format!("{modal}{base}\n[time]\nend = 1.0\nstep = 1e-3\n");
        let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
}

/// What a message offers is accepted: a support stands around one place, and no row has two
/// displacements.
#[test]
fn what_is_offered_for_a_place_of_a_support_is_accepted_there() {
    let said = |old: &str, new: &str| {
        assert!(RIGHT.contains(old));
        Case::parse(&RIGHT.replacen(old, new, 1), "wrong.toml", "").unwrap_err().to_string()
    };
    let of_support = |at: &str| said("at = { position = 1.0 }", at);
    for at in ["at = { joint = 4 }", "at = { there = 1.0 }", "at = 1.0", "at = {}", "at = { dof = 0, position = 1.0 }"]
    {
        let told = of_support(at);
        assert!(told.contains("position = 0 to 3.0 m") && told.contains("{ dof = 0 to 15 }"), "{at}: {told}");
        assert!(!told.contains("row") && !told.contains("\"each\""), "{at}: {told}");
    }
    // A wall may stand on a row, and at each place.
    let of_wall = said("at = { position = 2.0 }", "at = { joint = 4 }");
    assert!(of_wall.contains("{ row = ") && of_wall.contains("\"each\""), "{of_wall}");
    // Masses have no positions.
    let chain = "[system]\nplanes = 2\n[system.chain]\nmasses = [1.0, 2.0]\nsprings = 1e3\n\
        left = { stiffness = 1e3 }\n[[support]]\nname = \"bars\"\nat = { position = 2.0 }\nshape = \"round\"\n\
        gap = 1e-3\nrestitution = 0.5\n[time]\nend = 1.0\nstep = 1e-3\n";
    let told = Case::parse(chain, "wrong.toml", "").unwrap_err().to_string();
    assert!(told.contains("expected at = { dof = 0 to 1 }") && !told.contains("row"), "{told}");
    assert!(!told.contains("each"), "{told}");
    // What stands below in the table of keys does not stand below a message.
    let planes = said("planes = 2", "planes = 3");
    assert!(planes.contains("planes y and z; matrices") && !planes.contains("see below"), "{planes}");
}
