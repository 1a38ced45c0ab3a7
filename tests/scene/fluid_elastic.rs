//! Margins of a tube in a cross flow by Connors' criterion, against closed forms; and tables that
//! are refused.
use crate::refused::{Wrong, not_refused};
use signorini::FlowMargin;
use signorini::case::{Case, KeyValue};
use std::f64::consts::{PI, TAU};

/// A tube of three spans of 1 m in two planes, in a uniform flow of 0.5 m/s.
const TUBE: &str = r#"[system]
planes = 2
modes = 3

[system.beam]
spans = [1.0, 1.0, 1.0]
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 19.05e-3
inner_diameter = 15.75e-3
added_mass = 0.565
elements = 30
left = "pinned"
right = "pinned"

[system.damping]
ratio = 0.01

[[support]]
name = "plate-1"
at = { joint = 1 }
shape = "round"
gap = 0.2e-3

[[support]]
name = "plate-2"
at = { joint = 2 }
shape = "flats"
sides = 4
gap = 0.2e-3

[[turbulence]]
direction = "both"
density = 740.0
velocity = 0.5
reduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]
from = 5.0
to = 50.0
correlation_length = 0.06
seed = 1

[flow]
connors = 3.0

[time]
end = 2.0
step = 1e-3
"#;

/// m and EI of it.
const MASS: f64 = 7850.0 * PI / 4.0 * (0.01905 * 0.01905 - 0.01575 * 0.01575) + 0.565;

fn stiffness() -> f64 {
    2e11 * PI / 64.0 * (0.01905_f64.powi(4) - 0.01575_f64.powi(4))
}

/// Hz, of the wave number `k` (1/m).
fn frequency(k: f64) -> f64 {
    k * k * (stiffness() / MASS).sqrt() / TAU
}

pub fn case(text: &str) -> Case {
    Case::parse(text, "tube.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

pub fn with(case: &Case, key: &str, value: impl Into<KeyValue>) -> Case {
    case.with(key, value).unwrap_or_else(|error| panic!("{error}"))
}

/// The margins with supports inactive and active.
fn margins(case: &Case) -> [Vec<FlowMargin>; 2] {
    let found = case.fluid_elastic.clone().expect("a table flow");
    [found.inactive, found.active]
}

/// Relative error of `found`.
fn off(found: f64, wanted: f64) -> f64 {
    (found / wanted - 1.0).abs()
}

#[test]
fn a_uniform_flow_has_the_margins_of_closed_forms_with_supports_inactive_and_active() {
    let [inactive, active] = margins(&case(TUBE));
    // Each mode once, though it is in both planes: sines, and a beam over three spans, whose modes
    // are a sine of a span and the two of which βℓ solves the three-moment equations.
    assert_eq!((inactive.len(), active.len()), (3, 3));
    let free = [PI / 3.0, TAU / 3.0, PI];
    let pinned = [PI, 3.556_40, 4.297_54];
    for (found, waves, digits) in [(&inactive, free, 2e-5), (&active, pinned, 6e-5)] {
        for (one, k) in found.iter().zip(waves) {
            let f = frequency(k);
            assert!(off(one.frequency_hz, f) < digits, "{} for {f}", one.frequency_hz);
            let critical = 3.0 * f * 0.01905 * (TAU * 0.01 * MASS / (740.0 * 0.01905_f64.powi(2))).sqrt();
            assert!(off(one.critical_velocity_m_per_s, critical) < digits);
            // ∫ρV²φ² ÷ ∫mφ² of a uniform flow, whatever the mode.
            assert!(off(one.effective_velocity_m_per_s, 0.5) < 1e-9, "{}", one.effective_velocity_m_per_s);
            assert!(off(one.margin.unwrap(), critical / 0.5) < 2.0 * digits);
        }
    }
    // The figures by hand.
    assert!(off(inactive[0].frequency_hz, 4.05987) < 1e-5 && off(active[0].frequency_hz, 36.53886) < 1e-4);
    assert!(off(inactive[0].critical_velocity_m_per_s, 0.126_627) < 1e-5);
    assert!(off(active[0].critical_velocity_m_per_s, 1.139_646) < 1e-4);
    assert!(off(active[1].frequency_hz, 46.825) < 1e-4 && off(active[2].frequency_hz, 68.374) < 1e-4);
}

#[test]
fn a_flow_over_half_the_span_counts_half_for_a_mode_that_is_symmetric() {
    let half = case(&TUBE.replace("seed = 1", "seed = 1\nalong = [0.0, 1.5]"));
    for one in margins(&half).concat() {
        // The square of a mode of a symmetric tube is symmetric, too.
        assert!(off(one.effective_velocity_m_per_s, 0.5 / 2.0_f64.sqrt()) < 1e-8, "{}", one.effective_velocity_m_per_s);
    }
    // The other half comes with a table of its own, where the fluid is lighter; lift beside drag is
    // the same flow.
    let other = "[[turbulence]]\ndirection = 0\ndensity = 370.0\nvelocity = 0.5\nalong = [1.5, 3.0]\n\
                 reduced = [[0.01, 0.05], [3.0, 8.6e-7]]\nfrom = 5.0\nto = 50.0\ncorrelation_length = 0.06\n\n[flow]";
    let text = TUBE.replace("seed = 1", "seed = 1\nalong = [0.0, 1.5]");
    let lift = other.replace("direction = 0", "direction = 90").replace("[flow]", other);
    for text in [text.replace("[flow]", other), text.replace("[flow]", &lift)] {
        for one in margins(&case(&text)).concat() {
            assert!(off(one.effective_velocity_m_per_s, 0.5 * 0.75_f64.sqrt()) < 1e-8);
        }
    }
}

#[test]
fn supports_hold_the_planes_and_lines_in_which_they_stand() {
    let own = case(TUBE);
    let [_, both] = margins(&own);
    // Two flats on one line leave the other direction: a beam over spans of 1 and 2 m there.
    let bars = TUBE.replace("sides = 4", "directions = [30, 210]");
    let [_, active] = margins(&case(&bars));
    assert!(off(active[1].frequency_hz, both[0].frequency_hz) < 1e-9);
    assert!(active[0].frequency_hz < 0.6 * both[0].frequency_hz);
    // Springs of no stiffness to speak of, and some that are as good as rigid.
    let soft = case(&TUBE.replace("gap = 0.2e-3", "gap = 0.2e-3\nstiffness = 1e-3"));
    let [inactive, active] = margins(&soft);
    assert!(off(active[0].frequency_hz, inactive[0].frequency_hz) < 1e-5);
    let hard = case(&TUBE.replace("gap = 0.2e-3", "gap = 0.2e-3\nstiffness = 1e12"));
    assert!(off(margins(&hard)[1][0].frequency_hz, both[0].frequency_hz) < 1e-5);
    // Springs k at 1 m and 2 m add Σ k φ² to ω², to first order in k, with φ² = 2/(mL) sin²(πx/3).
    let weak = case(&TUBE.replace("gap = 0.2e-3", "gap = 0.2e-3\nstiffness = 1.0"));
    let [inactive, active] = margins(&weak);
    let gained = (TAU * active[0].frequency_hz).powi(2) - (TAU * inactive[0].frequency_hz).powi(2);
    assert!(off(gained, 2.0 * 2.0 / (MASS * 3.0) * 0.75) < 1e-3, "{gained}");
}

#[test]
fn places_between_nodes_and_walls_in_one_plane_hold_too() {
    let text = TUBE
        .replace("planes = 2\n", "")
        .replace("direction = \"both\"\n", "")
        .replace("elements = 30", "elements = 31");
    let from = text.find("[[support]]").unwrap();
    let to = text.find("[[turbulence]]").unwrap();
    let wall = |side: &str, at: f64| {
        let sign = if side == "upper" { "" } else { "-" };
        format!(
            "[[wall]]\nname = \"{side}-{at}\"\nside = \"{side}\"\nposition = {sign}2e-4\nat = {{ position = {at:?} }}\n"
        )
    };
    let walls: String = [1.0, 2.0].map(|at| wall("upper", at) + &wall("lower", at)).concat();
    let text = format!("{}{walls}{}", &text[..from], &text[to..]);
    let [_, active] = margins(&case(&text));
    // Elements of 97 mm, within which a place is held: the cubics bend at nodes alone.
    assert!(off(active[0].frequency_hz, 36.53886) < 2e-3, "{}", active[0].frequency_hz);
    assert!(active[0].frequency_hz > 36.53);
    assert!(off(active[0].effective_velocity_m_per_s, 0.5) < 1e-9);
    // Without walls nothing is active.
    let bare = format!("{}{}", &text[..from], &text[from + walls.len()..]);
    assert!(margins(&case(&bare))[1].is_empty());
}

#[test]
fn ratios_of_modes_are_straight_in_between_and_those_of_matrices_are_exact() {
    let listed = case(&TUBE.replace("ratio = 0.01", "ratios = [0.01, 0.02, 0.04]"));
    let [inactive, active] = margins(&listed);
    assert_eq!(inactive.iter().map(|one| one.damping_ratio).collect::<Vec<_>>(), [0.01, 0.02, 0.04]);
    // Beyond the third free mode, 36.54 Hz, its ratio.
    assert!(active.iter().all(|one| off(one.damping_ratio, 0.04) < 1e-9), "{active:?}");
    let more = with(&case(&TUBE.replace("ratio = 0.01", "ratios = [0.01, 0.02, 0.04, 0.08]")), "system.modes", 4.0);
    let [inactive, active] = margins(&more);
    let share =
        (active[1].frequency_hz - inactive[2].frequency_hz) / (inactive[3].frequency_hz - inactive[2].frequency_hz);
    assert!(off(active[1].damping_ratio, 0.04 + share * 0.04) < 1e-9);
    // Rayleigh damping of the mass, ζ = α/2ω, in any mode.
    let rayleigh = case(&TUBE.replace("ratio = 0.01", "rayleigh = { mass = 2.0, stiffness = 0.0 }"));
    for one in margins(&rayleigh).concat() {
        assert!(off(one.damping_ratio, 1.0 / (TAU * one.frequency_hz)) < 1e-9);
    }
}

#[test]
fn what_is_below_1_is_said_and_warned_of_only_where_no_support_helps() {
    let own = case(TUBE);
    let notes = own.notes().join("\n");
    // 0.126627/0.5 = 0.253 free, 1.139646/0.5 = 2.28 held.
    assert!(notes.contains("no support active") && notes.contains("margin 0.253"), "{notes}");
    assert!(notes.contains("with all of them active it is stable") && !notes.contains("work rates"), "{notes}");
    let fast = with(&own, "turbulence.1.velocity", 1.5).notes().join("\n");
    assert!(fast.contains("unstable: work rates mean nothing") && fast.contains("margin 0.760"), "{fast}");
    assert!(fast.contains("36.5") && !fast.contains("no support active"), "{fast}");
    let slow = with(&own, "turbulence.1.velocity", 0.1).notes().join("\n");
    assert!(!slow.contains("Connors"), "{slow}");
    let still = with(&own, "turbulence.1.velocity", 0.0);
    assert!(margins(&still).concat().iter().all(|one| one.margin.is_none()));
}

/// Two tubes of 2 m side by side, in flows of 0.3 and 0.6 m/s; what touches at midspan holds them
/// together along y.
fn pair() -> String {
    let beam = "youngs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 19.05e-3\ninner_diameter = 15.75e-3\n\
                added_mass = 0.565\nelements = 40\nleft = \"pinned\"\nright = \"pinned\"\n";
    let flow = TUBE.split_once("[[turbulence]]").unwrap().1.split_once("[flow]").unwrap().0;
    let mut text = "[system]\nplanes = 2\nmodes = 4\n[system.damping]\nratio = 0.01\n".to_owned();
    for name in ["slow", "fast"] {
        text += &format!("[[body]]\nname = \"{name}\"\n[body.beam]\nlength = 2.0\n{beam}");
    }
    text += "[[support]]\nname = \"midspan\"\nshape = \"flats\"\ndirections = [0.0]\ngap = 1e-4\n\
             at = { body = \"slow\", position = 1.0, relative_to = { body = \"fast\", position = 1.0 } }\n";
    for (name, velocity) in [("slow", "0.3"), ("fast", "0.6")] {
        text += &format!(
            "[[turbulence]]\nbody = \"{name}\"\n{}",
            flow.replace("0.5\nreduced", &format!("{velocity}\nreduced"))
        );
    }
    text + "[flow]\nconnors = 3.0\n[time]\nend = 2.0\nstep = 1e-3\n"
}

#[test]
fn tubes_that_a_support_couples_have_the_margins_of_the_modes_that_move_both() {
    let [inactive, active] = margins(&case(&pair()));
    let told = |margins: &[FlowMargin]| -> Vec<(String, f64, f64)> {
        let mut all: Vec<_> = margins
            .iter()
            .map(|one| (one.bodies.join("+"), one.frequency_hz, one.effective_velocity_m_per_s))
            .collect();
        let slow = |f: f64| (f * 100.0).round();
        all.sort_by(|a, b| slow(a.1).total_cmp(&slow(b.1)).then(a.2.total_cmp(&b.2)));
        all
    };
    // Each tube alone: sines, in both planes, each in its own flow.
    let [first, second] = [PI / 2.0, PI].map(frequency);
    let alone = [("slow", first, 0.3), ("fast", first, 0.6), ("slow", second, 0.3), ("fast", second, 0.6)];
    // Along y both move as one in the first mode, whose mass and flow are those of both: V² is the
    // mean. The second has its node where they touch, so that it is that of either; against each
    // other they are held there, as a beam pinned and clamped over 1 m (βℓ of tan βℓ = tanh βℓ).
    // Along z nothing holds, so that the modes of each alone are there, too.
    let both = (0.5_f64 * (0.09 + 0.36)).sqrt();
    let coupled = [
        ("slow", first, 0.3),
        ("slow+fast", first, both),
        ("fast", first, 0.6),
        ("slow", second, 0.3),
        ("fast", second, 0.6),
        ("slow+fast", frequency(3.926_602), both),
    ];
    for (found, wanted) in [(told(&inactive), &alone[..]), (told(&active), &coupled[..])] {
        assert_eq!(found.len(), wanted.len(), "{found:?}");
        for ((bodies, f, velocity), wanted) in found.iter().zip(wanted) {
            // Errors of the elements, (kℓ)⁴/1440 of ω² for k ℓ = 0.2; integrals are as exact as the
            // modes, whose errors count twice.
            assert!(bodies == wanted.0 && off(*f, wanted.1) < 2e-6 && off(*velocity, wanted.2) < 1e-6, "{found:?}");
        }
    }
    // Margins by hand: K f √(2πζ m) ÷ √(ρV²), whatever the diameter.
    for one in inactive.iter().chain(&active) {
        let pressure = 740.0 * one.effective_velocity_m_per_s.powi(2);
        let by_hand = 3.0 * one.frequency_hz * (TAU * 0.01 * MASS / pressure).sqrt();
        assert!(off(one.margin.unwrap(), by_hand) < 1e-12);
    }
}

#[test]
fn the_margin_of_a_coupled_mode_depends_on_no_tube_that_its_velocities_are_told_by() {
    // The second tube in a heavier fluid, at the speed of the same ρV²; the larger share then is
    // told by another m₀, ρ₀ and D, and the margin is the same.
    let own = case(&pair());
    let heavy = pair().replacen("density = 740.0\nvelocity = 0.6", "density = 2960.0\nvelocity = 0.3", 1);
    let [margin, heavier] = [own, case(&heavy)].map(|case| {
        let [_, active] = margins(&case);
        active.into_iter().find(|one| one.bodies.len() == 2).unwrap()
    });
    assert!(off(heavier.margin.unwrap(), margin.margin.unwrap()) < 1e-12);
    assert!(off(heavier.effective_velocity_m_per_s, 0.5 * margin.effective_velocity_m_per_s) < 1e-12);
    // A tube in no flow is in no list, but its mass is in the mode that moves it.
    let (kept, rest) =
        pair().split_once("[[turbulence]]\nbody = \"slow\"").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let one = case(&(kept + rest.split_at(rest.find("[[turbulence]]").unwrap()).1));
    let [inactive, active] = margins(&one);
    assert!(inactive.iter().chain(&active).all(|one| one.bodies == ["fast"]));
    assert!(active.iter().any(|one| off(one.effective_velocity_m_per_s, 0.6 / 2.0_f64.sqrt()) < 1e-6), "{active:?}");
}

#[test]
fn sliders_hold_nothing_in_margins_and_a_note_names_them() {
    let text = TUBE.replace("planes = 2\n", "").replace("direction = \"both\"\n", "");
    let (from, to) = (text.find("[[support]]").unwrap(), text.find("[[turbulence]]").unwrap());
    let bare = format!("{}{}", &text[..from], &text[to..]);
    let slider = "[[slider]]\nname = \"clip\"\nat = { joint = 1 }\nnormal_force = 5.0\nfriction = 0.3\n";
    let rubbed = case(&format!("{}{slider}{}", &text[..from], &text[to..]));
    assert_eq!(margins(&rubbed), margins(&case(&bare)));
    let notes = rubbed.notes().join("\n");
    assert!(notes.contains("count no slider (\"clip\")") && notes.contains("a pin"), "{notes}");
    assert!(!case(&bare).notes().join("\n").contains("slider"));
}

#[rustfmt::skip]
const WRONG_PAIR: &[Wrong] = &[
    ("a tube without damping", "[system.damping]\nratio = 0.01\n[[body]]\nname = \"slow\"", "[[body]]\nname = \"slow\"\n[body.damping]\nrayleigh = { mass = 1.0 }", "61:11", &["without damping of the body \"fast\"", "[body.damping]"]),
];

#[test]
fn wrong_tubes_among_several_are_refused_by_name() {
    let missed = not_refused(&pair(), WRONG_PAIR);
    assert!(missed.is_empty(), "{missed}");
    let modal = "[system]\n[[body]]\nname = \"bend\"\n[body.modal]\nfrequencies = [4.0]\ndamping_ratios = 0.02\n\
                 shapes = { a = [0.0], b = [1.0] }\n[[body]]\nname = \"post\"\n[body.oscillator]\nmass = 1.0\n\
                 damping = 0.0\nstiffness = 1.0\n[[turbulence]]\nbody = \"bend\"\nline = { a = 0.0, b = 1.0 }\n\
                 diameter = 0.02\ndensity = 740.0\nvelocity = 0.5\nreduced = [[0.01, 0.05], [3.0, 8.6e-7]]\n\
                 from = 1.0\nto = 9.0\ncorrelation_length = 0.1\n[flow]\nconnors = 3.0\n\
                 [time]\nend = 2.0\nstep = 1e-3\n";
    let modal = modal.replace("[system]", "[system]\nmodes = 2");
    let bend = |mass: &str| {
        let text = modal.replace("connors = 3.0\n", &format!("connors = 3.0\n{mass}"));
        Case::parse(&text, "bend.toml", "").unwrap_err().to_string()
    };
    let told = bend("");
    assert!(told.contains("without the mass per metre of the body \"bend\""), "{told}");
    let told = bend("mass_per_metre = 0.0\n");
    assert!(told.contains("flow: mass is 0.0"), "{told}");
}

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    ("no constant", "connors = 3.0\n", "", "42:1", &["`connors` is missing in `flow`", "Connors' constant"]),
    ("a constant of 0", "connors = 3.0", "connors = 0.0", "43:11", &["flow: connors", "above 0"]),
    ("no number", "connors = 3.0", "connors = nan", "43:11", &["flow: connors", "above 0"]),
    ("a word", "connors = 3.0", "connors = \"three\"", "43:11", &["flow.connors", "a number above 0"]),
    ("another key", "connors = 3.0", "connors = 3.0\ndamping = 0.01", "44:1", &["unknown key `damping`"]),
    ("a mass beside a beam", "connors = 3.0", "connors = 3.0\nmass_per_metre = 1.2", "44:18", &["`flow.mass_per_metre` beside a beam", "modal data only"]),
    ("no damping", "[system.damping]\nratio = 0.01\n", "", "41:11", &["without damping", "[system.damping]"]),
    ("no flow", "density = 740.0\nvelocity = 0.5\nreduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]", "spectrum = [[1.0, 0.02], [60.0, 0.02]]", "40:1", &["without the flow of a turbulence", "density, velocity and reduced"]),
    ("a ratio below 0", "ratio = 0.01", "ratios = [0.01, -0.02]", "17:10", &["system.damping.ratios is a list with -0.02", "feeds into a mode already"]),
];

#[test]
fn every_wrong_table_is_refused_at_its_place() {
    let missed = not_refused(TUBE, WRONG);
    assert!(missed.is_empty(), "{missed}");
}

#[test]
fn what_is_no_tube_has_no_margins() {
    let said = |text: &str| Case::parse(text, "wrong.toml", "").unwrap_err().to_string();
    let chain = "[system]\nmodes = 1\n\n[system.chain]\nmasses = [1.0, 1.0]\nsprings = [1.0]\n\
                 left = { stiffness = 1.0 }\n\n[flow]\nconnors = 3.0\n\n[time]\nend = 1.0\nstep = 1e-3\n";
    let told = said(chain);
    assert!(told.contains("wrong.toml:9:1") && told.contains("a beam or modal data"), "{told}");
    let from = TUBE.find("[[turbulence]]").unwrap();
    let to = TUBE.find("[flow]").unwrap();
    let still = format!("{}{}", &TUBE[..from], &TUBE[to..]);
    assert!(said(&still).contains("without the flow of a turbulence"));
    assert!(said(&still.replace("modes = 3\n", "")).contains("without the flow of a turbulence"));
    let plank = TUBE
        .replace("planes = 2\n", "")
        .replace("direction = \"both\"\n", "")
        .replace("outer_diameter = 19.05e-3\ninner_diameter = 15.75e-3", "width = 0.05\nheight = 0.02");
    let (from, to) = (plank.find("[[support]]").unwrap(), plank.find("[[turbulence]]").unwrap());
    let plank = format!("{}{}", &plank[..from], &plank[to..]).replace(
        "density = 740.0\nvelocity = 0.5\nreduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]",
        "spectrum = [[1.0, 0.02], [60.0, 0.02]]",
    );
    let told = said(&plank);
    assert!(told.contains("without the flow of a turbulence"), "{told}");
}
