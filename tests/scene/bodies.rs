//! Several bodies in one case, which only walls and supports couple: against closed forms, and
//! against the same motion of one body by symmetry.
use crate::refused::{Wrong, not_refused};
use signorini::case::{Case, Key};
use signorini::{Modes, Run, Scheme, System};

fn case(text: &str) -> Case {
    Case::parse(text, "bodies.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

fn run(case: &Case, scheme: &Scheme) -> Run {
    let options = signorini::Options::new(case.time);
    let run = signorini::run(&case.scene, scheme, &options).unwrap_or_else(|error| panic!("{scheme:?}: {error}"));
    assert!(run.findings.is_empty(), "{scheme:?}: {:?}", run.findings);
    run
}

const LOCATED: Scheme = Scheme::Located;

/// Two free carts, the first of which runs into the second.
const CARTS: &str = r#"[[body]]
name = "left"
[body.oscillator]
mass = 1.0
damping = 0.0
stiffness = 0.0

[[body]]
name = "right"
[body.oscillator]
mass = 3.0
damping = 0.0
stiffness = 0.0

[[wall]]
name = "touch"
at = { body = "left", dof = 0, relative_to = { body = "right", dof = 0 } }
side = "upper"
position = 0.5
restitution = 0.5

[[probe]]
name = "left"
at = { body = "left", dof = 0 }

[[probe]]
name = "right"
at = { body = "right", dof = 0 }

[initial]
velocity = { left = 2.0 }

[time]
end = 1.0
step = 1e-3
"#;

#[test]
fn a_body_of_one_degree_of_freedom_needs_no_more_than_its_name() {
    assert_eq!(case(&CARTS.replace(", dof = 0", "")).scene, case(CARTS).scene);
}

#[test]
fn two_carts_collide_as_momentum_and_restitution_say() {
    // Momentum 2 N s stays, and the relative velocity of 2 m/s becomes −1 m/s: −1/4 and 3/4 m/s.
    let case = case(CARTS);
    for scheme in [LOCATED, Scheme::Event, Scheme::MoreauJean { theta: 0.5 }] {
        let run = run(&case, &scheme);
        let speed = |probe: &str| *run.trajectory.probe(probe).unwrap().1.last().unwrap();
        // Some roundings of 2 m/s.
        assert!((speed("left") + 0.25).abs() < 1e-14 && (speed("right") - 0.75).abs() < 1e-14, "{scheme:?}");
        let [contact] = run.trajectory.contacts() else { panic!("{:?}", run.trajectory.contacts()) };
        // The judge's residual of a QP solved to 1e-12 of the impulse.
        assert!((contact.impulse.abs() - 2.25).abs() < 1e-11, "{}", contact.impulse);
    }
}

#[test]
fn two_equal_bars_exchange_their_velocities_in_the_time_of_two_passes_of_a_wave() {
    // Saint-Venant (1867): bars of 1 m, E A = 1 N and ρ A = 1 kg/m, hence c = 1 m/s; the contact
    // lasts 2 L/c = 2 s under a force of ρ A c v/2 = 0.5 N, and the bar that struck stands still
    // after it.
    let bar = "length = 1.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\nelements = 200\nleft = \"free\"\n\
               right = \"free\"\n";
    let case = case(&format!(
        "[[body]]\nname = \"moving\"\n[body.bar]\n{bar}[[body]]\nname = \"still\"\n[body.bar]\n{bar}\
         [[wall]]\nname = \"ends\"\nside = \"upper\"\nposition = 0.0\nrestitution = 0.0\n\
         at = {{ body = \"moving\", position = 1.0, relative_to = {{ body = \"still\", position = 0.0 }} }}\n\
         [[probe]]\nname = \"moving\"\nat = {{ body = \"moving\", position = 0.5 }}\n\
         [[probe]]\nname = \"still\"\nat = {{ body = \"still\", position = 0.5 }}\n\
         [initial]\nvelocity = {{ moving = {{ profile = [[0.0, 1.0], [1.0, 1.0]] }} }}\n\
         [time]\nend = 3.0\nstep = 1e-3\n"
    ));
    let run = run(&case, &Scheme::MoreauJean { theta: 0.5 });
    // The front of a wave is smeared over some elements, and so are the ends of the contact and the
    // displacements: some per cent with 200 elements, of order 2/3 in their length.
    let impulse: f64 = run.trajectory.contacts().iter().map(|contact| contact.impulse).sum();
    assert!((impulse.abs() - 1.0).abs() < 0.01, "{impulse}");
    let last = run.trajectory.contacts().last().unwrap().end.unwrap();
    assert!((last - 2.0).abs() < 0.06, "{last}");
    let at = |probe: &str, row: usize| run.trajectory.probe(probe).unwrap().0[row];
    let drift = |probe: &str| at(probe, 3000) - at(probe, 2200);
    assert!(drift("moving").abs() < 0.02 && (drift("still") - 0.8).abs() < 0.02);
}

/// A tube of 2 m in six modes.
fn tube(gap: f64, bodies: bool, rest: &str) -> String {
    let beam = "length = 2.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\ninner_diameter = 0.016\n\
                elements = 12\nleft = \"pinned\"\nright = \"clamped\"\n";
    let damping = "[system.damping]\nratio = 0.01\n";
    let load = |body: &str, sign: f64| {
        let force = 20.0 * sign;
        format!("[[load]]\nat = {{ {body}position = 0.7 }}\nharmonic = {{ amplitude = {force:?}, frequency = 15.0 }}\n")
    };
    let wall = |at: &str| {
        format!(
            "[[wall]]\nname = \"touch\"\nside = \"upper\"\nposition = {gap:?}\nrestitution = 0.6\nat = {{ {at} }}\n"
        )
    };
    let time = "[time]\nend = 0.3\nstep = 1e-4\n";
    if bodies {
        let body = |name: &str| format!("[[body]]\nname = \"{name}\"\n[body.beam]\n{beam}");
        let at = "body = \"a\", position = 1.0, relative_to = { body = \"b\", position = 1.0 }";
        let loads = load("body = \"a\", ", 1.0) + &load("body = \"b\", ", -1.0);
        let probe = "[[probe]]\nname = \"middle\"\nat = { body = \"a\", position = 1.0 }\n";
        let (system, bodies) = ("[system]\nmodes = 12\n", body("a") + &body("b"));
        format!("{system}{damping}{bodies}{}{loads}{probe}{rest}{time}", wall(at))
    } else {
        let probe = "[[probe]]\nname = \"middle\"\nat = { position = 1.0 }\n";
        let system = format!("[system]\nmodes = 6\n[system.beam]\n{beam}{damping}");
        format!("{system}{}{}{probe}{rest}{time}", wall("position = 1.0"), load("", 1.0))
    }
}

#[test]
fn tubes_that_move_against_each_other_meet_as_one_meets_a_wall_halfway() {
    let (single, pair) = (case(&tube(1e-3, false, "")), case(&tube(2e-3, true, "")));
    for scheme in [LOCATED, Scheme::MoreauJean { theta: 0.5 }] {
        let (single, pair) = (run(&single, &scheme), run(&pair, &scheme));
        let impacts = single.trajectory.contacts().len();
        assert!(impacts >= 3 && pair.trajectory.contacts().len() == impacts, "{impacts}");
        let (one, two) = (single.trajectory.probe("middle").unwrap().0, pair.trajectory.probe("middle").unwrap().0);
        // Roundings of a QP of another metric, carried through a few impacts.
        let apart = one.iter().zip(two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9 * 1e-3, "{scheme:?}: {apart}");
    }
}

#[test]
fn rods_in_each_other_rub_as_one_rubs_in_a_hole_of_half_the_gap() {
    // Two masses on springs in two planes that move against each other; between them a round gap
    // with friction, on whose line of symmetry each sees a hole that stands.
    let mass = "mass = 0.5\ndamping = 2.0\nstiffness = 2e4\n";
    let rotating = |body: &str, sign: f64| {
        let load = |direction: f64, phase: f64| {
            format!(
                "[[load]]\n{body}direction = {direction:?}\n\
                 harmonic = {{ amplitude = {:?}, frequency = 25.0, phase = {phase:?} }}\n",
                60.0 * sign
            )
        };
        load(0.0, 0.5 * std::f64::consts::PI) + &load(90.0, 0.0)
    };
    let support = |at: &str, gap: f64| {
        format!(
            "[[support]]\nname = \"gap\"\nshape = \"round\"\ngap = {gap:?}\nrestitution = 0.3\nfriction = 0.2\n{at}\n"
        )
    };
    let time = "[time]\nend = 0.5\nstep = 1e-4\n";
    let single = format!(
        "[system]\nplanes = 2\n[system.oscillator]\n{mass}{}{}[[probe]]\nname = \"rod\"\nat = {{ dof = 0 }}\n{time}",
        support("at = { dof = 0 }", 1e-3),
        rotating("at = { dof = 0 }\n", 1.0)
    );
    let at = "at = { body = \"rod\", dof = 0, relative_to = { body = \"sleeve\", dof = 0 } }";
    let pair = format!(
        "[system]\nplanes = 2\n[[body]]\nname = \"rod\"\n[body.oscillator]\n{mass}[[body]]\nname = \"sleeve\"\n\
         [body.oscillator]\n{mass}{}{}{}[[probe]]\nname = \"rod\"\nat = {{ body = \"rod\", dof = 0 }}\n{time}",
        support(at, 2e-3),
        rotating("at = { body = \"rod\", dof = 0 }\n", 1.0),
        rotating("at = { body = \"sleeve\", dof = 0 }\n", -1.0)
    );
    let (single, pair) = (run(&case(&single), &LOCATED), run(&case(&pair), &LOCATED));
    assert!(!single.trajectory.contacts().is_empty());
    for probe in ["rod-y", "rod-z"] {
        let (one, two) = (single.trajectory.probe(probe).unwrap().0, pair.trajectory.probe(probe).unwrap().0);
        let apart = one.iter().zip(two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Instants are located to 1e-12 of a step, at speeds of 0.2 m/s, through a few impacts.
        assert!(apart < 1e-9 * 1e-3, "{probe}: {apart}");
    }
    // The same normal force slides twice as far between the two.
    let power = |run: &Run| run.statistics.wear[0].work_rate_w;
    assert!((power(&pair) / power(&single) - 2.0).abs() < 1e-6, "{} {}", power(&pair), power(&single));
}

#[test]
fn the_modes_of_uncoupled_bodies_are_those_of_each() {
    let beam = |length: f64| {
        format!(
            "length = {length:?}\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\nelements = 10\n\
             left = \"pinned\"\nright = \"pinned\"\n"
        )
    };
    let time = "[time]\nend = 0.1\nstep = 1e-4\n";
    let alone = |length: f64| case(&format!("[system.beam]\n{}{time}", beam(length)));
    let both = |second: f64| {
        case(&format!(
            "[[body]]\nname = \"a\"\n[body.beam]\n{}[[body]]\nname = \"b\"\n[body.beam]\n{}{time}",
            beam(2.0),
            beam(second)
        ))
    };
    let modes = |case: &Case, count: usize| {
        let System::Structure(structure) = &case.scene.system else { panic!() };
        Modes::lowest(structure, count).unwrap()
    };
    for second in [2.0, 3.0] {
        let mut expected: Vec<f64> = [2.0, second].iter().flat_map(|&l| modes(&alone(l), 6).omega).collect();
        expected.sort_by(f64::total_cmp);
        let found = modes(&both(second), 8);
        assert_eq!(found.omega, expected[..8], "{second}");
        // Each mode moves one body, also where both have the same frequencies.
        let n = found.shapes[0].len() / 2;
        let still = |part: &[f64]| part.iter().all(|x| *x == 0.0);
        assert!(found.shapes.iter().all(|shape| still(&shape[..n]) != still(&shape[n..])), "{second}");
    }
}

#[test]
fn gravity_and_a_moving_base_act_on_every_body_as_on_it_alone() {
    let chain = "masses = [1.0, 2.0]\nsprings = 1e3\nleft = { stiffness = 2e3 }\n";
    let beam = "length = 2.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\nelements = 6\n\
                left = \"clamped\"\nright = \"free\"\n";
    let oscillator = "mass = 0.5\ndamping = 1.0\nstiffness = 500.0\n";
    let systems =
        [("chain", chain, "dof = 1"), ("beam", beam, "position = 2.0"), ("oscillator", oscillator, "dof = 0")];
    for load in ["gravity = { acceleration = 9.81 }", "base = { amplitude = 3.0, frequency = 4.0 }"] {
        let rest = format!("[[load]]\n{load}\n[time]\nend = 0.5\nstep = 1e-3\n");
        let probe = |name: &str, at: &str| format!("[[probe]]\nname = \"{name}\"\nat = {{ {at} }}\n");
        let mut text = String::new();
        for (kind, table, _) in systems {
            text += &format!("[[body]]\nname = \"{kind}\"\n[body.{kind}]\n{table}");
        }
        for (kind, _, at) in systems {
            text += &probe(kind, &format!("body = \"{kind}\", {at}"));
        }
        let all = run(&case(&(text + &rest)), &Scheme::MoreauJean { theta: 0.5 });
        for (kind, table, at) in systems {
            let alone = format!("[system.{kind}]\n{table}{}{rest}", probe(kind, at));
            let alone = run(&case(&alone), &Scheme::MoreauJean { theta: 0.5 });
            let (one, among) = (alone.trajectory.probe(kind), all.trajectory.probe(kind).unwrap().0);
            let one = one.map_or_else(|_| alone.trajectory.displacement(), |probe| probe.0);
            let largest = one.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            let apart = one.iter().zip(among).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Roundings of the beam, whose stiffness is 1e8 times that of the others.
            assert!(largest > 0.0 && apart < 1e-9 * largest, "{kind}, {load}: {apart} of {largest}");
        }
    }
}

#[test]
fn turbulence_shakes_one_body_as_it_shakes_a_tube_alone() {
    let field = "spectrum = [[1.0, 0.02], [60.0, 0.02]]\nfrom = 1.0\nto = 60.0\ncorrelation_length = 0.3\nseed = 4\n";
    // The six slowest modes are those of the first tube, of which the phases of the field so stay
    // the same; with no wall in reach both motions are linear.
    let single = case(&tube(1.0, false, &format!("[[turbulence]]\n{field}")));
    let pair = tube(2.0, true, &format!("[[turbulence]]\nbody = \"a\"\n{field}"));
    let pair = pair.replace("modes = 12", "modes = 6");
    let (before, b) = pair.split_at(pair.rfind("length = 2.0").unwrap());
    let b = b
        .replacen("length = 2.0", "length = 0.2", 1)
        .replace("body = \"b\", position = 1.0", "body = \"b\", position = 0.1");
    let pair = case(&(before.to_owned() + &b.replace("body = \"b\", position = 0.7", "body = \"b\", position = 0.1")));
    let (single, pair) = (run(&single, &LOCATED), run(&pair, &LOCATED));
    let (one, two) = (single.trajectory.probe("middle").unwrap().0, pair.trajectory.probe("middle").unwrap().0);
    let apart = one.iter().zip(two).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let largest = one.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    // Roundings of the sums of the modes at the probe.
    assert!(largest > 1e-4 && apart < 1e-12 * largest, "{apart} of {largest}");
}

#[test]
fn values_of_bodies_have_keys() {
    let key: Key = "body.right.oscillator.mass".parse().unwrap();
    assert!(key.unit() == Some("kg") && key.shapes_system());
    let heavier = case(CARTS).with("body.right.oscillator.mass", 1.0).unwrap();
    // Equal masses: the relative mass is ½ kg.
    assert_eq!(heavier.scene.wall_masses(), [0.5]);
    let place: Key = "wall.touch.at.relative_to.position".parse().unwrap();
    assert_eq!(place.unit(), Some("m"));
}

/// Two tubes in two planes.
const TUBES: &str = r#"[system]
planes = 2
modes = 4

[[body]]
name = "a"
[body.beam]
length = 2.0
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 0.02
elements = 6
left = "pinned"
right = "pinned"

[[body]]
name = "b"
[body.chain]
masses = [1.0, 2.0]
springs = 1e3
left = { stiffness = 1e3 }

[[support]]
name = "touch"
at = { body = "a", position = 1.0, relative_to = { body = "b", dof = 1 } }
shape = "flats"
directions = [0.0]
gap = 1e-3

[time]
end = 1.0
step = 1e-3
"#;

#[rustfmt::skip]
const WRONG_CARTS: &[Wrong] = &[
    ("no kind", "[body.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 0.0\n", "", "1:1", &["`body` does not say what vibrates", "[body.chain]"]),
    ("two kinds", "[[body]]\nname = \"right\"", "[body.chain]\nmasses = [1.0]\nsprings = 0\n\n[[body]]\nname = \"right\"", "8:1", &["two systems, `oscillator` and `chain`"]),
    ("one name twice", "name = \"right\"", "name = \"left\"", "9:8", &["body 2: name", "a name of its own"]),
    ("a name with a space", "name = \"right\"", "name = \"the right\"", "9:8", &["body 2: name", "letters"]),
    ("no name", "name = \"right\"\n", "", "8:1", &["`name` is missing in `body`"]),
    ("a system beside bodies", "[[wall]]", "[system.chain]\nmasses = [1.0]\nsprings = 0\n[[wall]]", "15:1", &["`system.chain` beside [[body]]"]),
    ("no mass", "mass = 3.0", "mass = 0", "11:8", &["body.oscillator.mass", "above 0"]),
    ("no body in a place", "at = { body = \"left\", dof = 0, relative", "at = { dof = 0, relative", "17:6", &["wall \"touch\": at", "\"left\", \"right\""]),
    ("an unknown body", "at = { body = \"left\", dof", "at = { body = \"middle\", dof", "17:15", &["wall \"touch\": at: body", "\"left\", \"right\""]),
    ("a body by number", "at = { body = \"left\", dof", "at = { body = 1, dof", "17:15", &["wall \"touch\": at: body"]),
    ("an unknown body it is relative to", "{ body = \"right\", dof = 0 } }", "{ body = \"middle\", dof = 0 } }", "17:55", &["at: relative_to: body"]),
    ("relative to a number", "relative_to = { body = \"right\", dof = 0 }", "relative_to = 3", "17:46", &["at: relative_to"]),
    ("relative to itself", "relative_to = { body = \"right\", dof = 0 }", "relative_to = { body = \"left\", dof = 0 }", "17:6", &["nothing moves there"]),
    ("a degree of freedom of another body", "dof = 0 } }", "dof = 1 } }", "17:70", &["dof is 1", "from 0 to 0"]),
    ("each of the bodies", "at = { body = \"left\", dof = 0, relative_to = { body = \"right\", dof = 0 } }", "at = \"each\"", "17:6", &["wall \"touch\": at"]),
    ("a position on an oscillator", "at = { body = \"left\", dof = 0 }", "at = { body = \"left\", position = 0.5 }", "24:23", &["a oscillator has no positions"]),
    ("a start of no body", "velocity = { left = 2.0 }", "velocity = { left = 2.0, middle = 1.0 }", "31:26", &["unknown key `middle`", "left, right"]),
    ("a list for a body", "velocity = { left = 2.0 }", "velocity = { left = [2.0] }", "31:21", &["initial.velocity.left", "a number"]),
    ("a number for all", "velocity = { left = 2.0 }", "velocity = 2.0", "31:12", &["initial.velocity", "BODY"]),
];

#[rustfmt::skip]
const WRONG_TUBES: &[Wrong] = &[
    ("a bar in two planes", "[body.chain]\nmasses = [1.0, 2.0]\nsprings = 1e3\nleft = { stiffness = 1e3 }", "[body.bar]\nlength = 1.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\nelements = 2\nleft = \"free\"\nright = \"free\"", "18:1", &["`system.planes` is 2 beside a bar"]),
    ("modes in two planes", "[body.chain]\nmasses = [1.0, 2.0]\nsprings = 1e3\nleft = { stiffness = 1e3 }", "[body.modal]\nfrequencies = [1.0]\nshapes = { tip = [1.0] }", "18:1", &["given by modal", "oscillator, chain or beam"]),
    ("a place beyond a body", "position = 1.0, relative", "position = 2.5, relative", "25:31", &["support \"touch\": at is 2.5", "from 0 to 2.0 m"]),
    ("a row in two planes", "{ body = \"b\", dof = 1 }", "{ body = \"b\", row = [[0, 1.0]] }", "25:64", &["row on a body", "two planes"]),
    ("an end of a body", "right = \"pinned\"", "right = \"glued\"", "14:9", &["body.beam.right", "\"clamped\""]),
    ("a length of a body", "length = 2.0", "length = -2.0", "8:10", &["body.beam.length", "above 0"]),
    ("turbulence on no body", "[time]", "[[turbulence]]\nspectrum = [[1.0, 1.0], [2.0, 1.0]]\nfrom = 1.0\nto = 2.0\ncorrelation_length = 0.1\ndirection = 0.0\n[time]", "30:1", &["`body` is missing in turbulence 1", "\"a\", \"b\""]),
    ("turbulence on a chain", "[time]", "[[turbulence]]\nbody = \"b\"\nspectrum = [[1.0, 1.0], [2.0, 1.0]]\nfrom = 1.0\nto = 2.0\ncorrelation_length = 0.1\ndirection = 0.0\n[time]", "30:1", &["acts on no tube", "[body.beam]"]),
    ("damping twice", "[[support]]", "[body.damping]\nrayleigh = { mass = 1.0 }\n[system.damping]\nratio = 0.01\n[[support]]", "25:1", &["`system` gives its damping twice", "bodies"]),
    ("a flow", "[time]", "[flow]\nconnors = 3.0\n[time]", "30:1", &["`flow` without the flow of a turbulence"]),
];

#[test]
fn wrong_bodies_are_refused_at_their_place() {
    assert!(Case::parse(TUBES, "right.toml", "").is_ok(), "{:?}", Case::parse(TUBES, "right.toml", ""));
    let failures = not_refused(CARTS, WRONG_CARTS) + &not_refused(TUBES, WRONG_TUBES);
    assert!(failures.is_empty(), "{failures}");
}
