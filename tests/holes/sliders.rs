//! Sliders: Coulomb friction under a known normal force in one plane, against closed forms.

use signorini::case::CaseFile;
use signorini::{Load, LoadKind, Options, Row, Scene, Scheme, Slider, run};
use std::f64::consts::{PI, TAU};

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// 1 kg on 1e4 N/m, pressed by 10 N on a flat with this friction.
fn pressed(friction: f64) -> Scene {
    let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 10.0, friction: friction.into() };
    Scene::oscillator(1.0, 0.0, 1e4).with_initial(&[0.85e-3], &[0.0]).with_duration(0.15).with_slider(&slider).unwrap()
}

/// The displacement at `t` of that oscillator with μ = 0.1: half cosines about ±μN/k = ±0.1 mm,
/// each 0.2 mm smaller than the one before, until it turns within 0.1 mm of 0 and stays there.
fn decaying(t: f64) -> f64 {
    let (mut turn, mut tau) = (0.85e-3_f64, 100.0 * t);
    while turn.abs() > 0.1e-3 {
        let centre = 0.1e-3 * turn.signum();
        if tau < PI {
            return centre + (turn - centre) * tau.cos();
        }
        (turn, tau) = (2.0 * centre - turn, tau - PI);
    }
    turn
}

#[test]
fn a_free_decay_is_that_of_the_closed_form_and_located_converges_to_it_with_order_2() {
    let error = |scheme: &Scheme, step: f64| {
        let run = run(&pressed(0.1), scheme, &Options::with_step(step)).unwrap();
        assert_eq!(run.findings, []);
        let (w, _) = run.trajectory.probe("").unwrap();
        let apart = |(t, w): (&f64, &f64)| (w - decaying(*t)).abs();
        run.trajectory.time().iter().zip(w).map(apart).fold(0.0, f64::max)
    };
    // No step divides a half swing of π/100 s.
    let located = [4e-4, 2e-4, 1e-4].map(|step| error(&Scheme::Located, step));
    // Twice the frequency error ω³h²/12 · t · 0.85 mm of the trapezoidal rule at h = 1e-4.
    assert!(located[2] < 2.2e-7, "{located:?}");
    // Halving the step divides an error of order 2 by 4; its second term leaves more than 3.
    assert!(located[0] > 3.0 * located[1] && located[1] > 3.0 * located[2], "{located:?}");
    // Steps of moreau-jean are not divided where the motion turns: order 1 in h v there.
    assert!(error(&MOREAU_JEAN, 1e-4) < 2e-6);
}

/// Den Hartog, Trans. ASME 53 (1931): under P cos(ωt + φ) a motion without stops turns at ±A with
/// A² = (P/k)²V² − (F/k)²U², V = 1/(1 − β²), U = tan(π/2β)/β and β = ω/ω₀; from a turn at A on,
/// (P/k)V cos φ = A and (P/k)V sin φ = −(F/k)U.
#[test]
fn a_driven_motion_without_stops_has_den_hartogs_amplitude() {
    let (k, p, friction, beta) = (1e4, 10.0, 2.0, 1.25);
    let (v, u) = (p / k / (1.0 - beta * beta), friction / k * (0.5 * PI / beta).tan() / beta);
    let amplitude = (v * v - u * u).sqrt();
    let phase = (-u / v).atan2(amplitude / v) + 0.5 * PI;
    let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 10.0, friction: 0.2.into() };
    let period = TAU / (beta * 100.0);
    let scene = Scene::oscillator(1.0, 0.0, k)
        .with_load(Load::harmonic(p, 1.0 / period, phase))
        .with_initial(&[amplitude], &[0.0])
        .with_duration(10.0 * period)
        .with_slider(&slider)
        .unwrap();
    let run = run(&scene, &Scheme::Located, &Options::with_step(period / 400.0)).unwrap();
    assert_eq!(run.findings, []);
    let (w, _) = run.trajectory.probe("").unwrap();
    for (turn, row) in w.iter().step_by(200).enumerate() {
        let sign = if turn % 2 == 0 { 1.0 } else { -1.0 };
        // The trapezoidal rule errs by (ω₀h)²/12 = 1.3e-5 in ω₀, which the free part of the motion
        // gathers over ten periods: 8 · 2π · 1.3e-5.
        assert!((sign * row / amplitude - 1.0).abs() < 1e-3, "turn {turn}: {row} {amplitude}");
    }
    assert_eq!(w.len(), 4001);
}

#[test]
fn the_static_coefficient_holds_what_the_kinetic_one_would_let_slide() {
    let released = |at: f64| {
        let friction = signorini::FrictionCoefficients { sticking: 0.2, sliding: 0.1 };
        let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 10.0, friction };
        let scene = Scene::oscillator(1.0, 0.0, 1e4).with_initial(&[at], &[0.0]).with_duration(0.02);
        let scene = scene.with_slider(&slider).unwrap();
        run(&scene, &MOREAU_JEAN, &Options::with_step(1e-4)).unwrap().state.q[0]
    };
    // The spring pulls 1.9 N and 2.1 N; μ_s N is 2 N.
    assert!((released(0.19e-3) - 0.19e-3).abs() < 1e-18);
    assert!(released(0.21e-3) < 0.15e-3);
}

/// SDND100 of code_aster, whose built-in case has two planes, in one plane.
const SDND100: &str = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1e4\n\
    [[slider]]\nname = \"flat\"\nnormal_force = 10.0\nfriction = 0.1\n\
    [initial]\ndisplacement = 0.85e-3\n\
    [time]\nend = 0.15\nstep = 1e-4\n";

fn file(text: &str) -> CaseFile {
    CaseFile::from_text(text, "case.toml", "")
}

#[test]
fn the_two_planes_of_sdnd100_and_one_plane_turn_at_the_same_places() {
    let case = file(SDND100).case().unwrap();
    assert_eq!((case.scene.probes.len(), case.without_sliders().system.degrees_of_freedom()), (1, 1));
    let run = run(&case.scene, &Scheme::Located, &Options::new(case.time)).unwrap();
    let (w, _) = run.trajectory.probe("").unwrap();
    let turns: Vec<f64> = w.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).map(|w| w[1]).collect();
    // A turn lies up to half a step from a row: ½(ωh/2)² of 0.85 mm, 1e-8 m; the last one stays.
    for (turn, known) in turns.iter().chain(w.last()).zip([-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3]) {
        assert!((turn - known).abs() < 2e-8, "{turn} {known}");
    }
    // It slides 3.6 mm under 10 N: 0.036 J of wear in 0.15 s, and friction takes a tenth of it.
    let wear = &run.statistics.wear[0];
    assert!((wear.work_rate_w - 0.24).abs() < 1e-5 && (wear.friction_power_w - 0.024).abs() < 1e-6, "{wear:?}");
    assert_eq!((&*wear.support, &*run.statistics.walls[0].wall), ("flat", "flat"));
    // The normal force and the friction limit are sweepable keys.
    let heavier = case.with("slider.flat.normal_force", 20.0).unwrap().with("slider.flat.friction", 0.05).unwrap();
    let after = signorini::run(&heavier.scene, &Scheme::Located, &Options::new(heavier.time)).unwrap();
    assert!((after.state.q[0] - 0.05e-3).abs() < 2e-8, "μN is the same, {:?}", after.state);
}

/// A pinned beam of one mode that rubs in its middle.
const BEAM: &str = "[system]\nmodes = 1\n\
    [system.beam]\nlength = 1.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.02\nelements = 10\n\
    left = \"pinned\"\nright = \"pinned\"\n\
    [[slider]]\nname = \"clamp\"\nat = { position = 0.5 }\nnormal_force = 100.0\nfriction = 0.3\n\
    [initial]\ndisplacement = { profile = [[0.0, 0.0], [0.25, 3.5e-3], [0.5, 5e-3], [0.75, 3.5e-3], [1.0, 0.0]] }\n\
    [time]\nend = 0.02\nstep = 1e-5\n";

#[test]
fn a_mode_of_a_beam_loses_in_a_half_swing_what_its_generalised_mass_says() {
    let case = file(BEAM).case().unwrap();
    let run = run(&case.scene, &Scheme::Located, &Options::new(case.time)).unwrap();
    assert_eq!(run.findings, []);
    let (w, _) = run.trajectory.probe("clamp").unwrap();
    // One mode: stiffness π⁴EI/2L³ in the middle. Half a swing takes 0.0126 s.
    let stiffness = PI.powi(4) * 2e11 * (PI * 0.02_f64.powi(4) / 64.0) / 2.0;
    let least = w.iter().copied().fold(f64::INFINITY, f64::min);
    let lost = w[0] + least;
    // Ten elements give the first frequency to 1e-5; the loss is 2 μN/k.
    assert!((lost * stiffness / (2.0 * 30.0) - 1.0).abs() < 1e-3, "{lost} {}", 60.0 / stiffness);
}

#[test]
fn realisations_and_the_start_in_equilibrium_keep_the_slider() {
    let loaded = "[[load]]\nat = { position = 0.3 }\nrandom = { rms = 5.0, from = 100.0, to = 300.0 }\n\
        [[load]]\nat = { position = 0.5 }\nconstant = { force = 40.0 }\n[time]\nend = 0.05";
    let text = BEAM.replace("[time]\nend = 0.02", loaded).replace("modes = 1", "modes = 3");
    let (before, after) = text.split_once("displacement").unwrap();
    let text = format!("{before}equilibrium = true\n{}", after.split_once('\n').unwrap().1);
    let case = file(&text).case().unwrap();
    let other = case.realisation(2).unwrap();
    for case in [&case, &other] {
        let last = case.scene.loads.last().unwrap();
        assert_eq!((&last.kind, &last.at), (&LoadKind::Constant { force: 100.0 }, &Row::dof(3)));
    }
    assert_ne!(case.scene.loads[0], other.scene.loads[0]);
    // In equilibrium under 40 N in the middle, PL³/48EI less the modes left out (1 % in all).
    let there = case.scene.probes[0].at.dot(&case.scene.initial.q);
    let whole = 40.0 / (48.0 * 2e11 * (PI * 0.02_f64.powi(4) / 64.0));
    assert!((there / whole - 1.0).abs() < 0.01, "{there} {whole}");
}

#[test]
fn what_makes_no_slider_is_refused_by_name() {
    let plane = |text: &str| text.replace("[system.oscillator]", "[system]\nplanes = 2\n[system.oscillator]");
    for (text, words) in [
        (SDND100.replace("10.0", "-1.0"), "slider \"flat\": normal_force is -1"),
        (SDND100.replace("normal_force = 10.0\n", ""), "`normal_force` is missing"),
        (SDND100.replace("friction = 0.1\n", ""), "`friction` is missing"),
        (SDND100.replace("friction = 0.1", "friction = -0.1"), "slider \"flat\": friction is -0.1"),
        (SDND100.replace("0.1\n", "{ static = 0.1, kinetic = 0.2 }\n"), "slider \"flat\": friction: static is 0.1"),
        (SDND100.replace("0.1\n", "{ static = 0.1 }\n"), "slider \"flat\": friction has no kinetic coefficient"),
        (SDND100.replace("mass = 1.0", "mass = 0.0"), "system.oscillator.mass is 0"),
        (plane(SDND100).replace("displacement = 0.85e-3", ""), "slider \"flat\", and the system moves in two planes"),
        (
            SDND100.replace("[initial]", "[[wall]]\nname = \"flat\"\nside = \"upper\"\nposition = 1.0\n[initial]"),
            "slider 1: name is \"flat\"",
        ),
        (
            SDND100.replace(
                "[initial]",
                "[[wall]]\nname = \"hc\"\nside = \"upper\"\nposition = 1.0\nstiffness = 1e6\nexponent = 1.5\n[initial]",
            ),
            "wall \"hc\" is the law of Hunt and Crossley, beside the friction at \"flat\"",
        ),
        (BEAM.replace("position = 0.5", "position = 0.0"), "slider \"clamp\": at: nothing moves there"),
        (BEAM.replace("at = { position = 0.5 }\n", ""), "`at` is missing in slider \"clamp\""),
        (BEAM.replace("modes = 1", "modes = 1\nstatic_correction = true"), "and static_correction is true"),
        (format!("{SDND100}[wear]\nservice = 1.0\n"), "`wear` has a service and no coefficient"),
    ] {
        let error = file(&text).case().unwrap_err();
        assert!(error.is_request() && error.to_string().contains(words), "{words}: {error}");
        assert_eq!(error.to_string().matches("error:").count(), 1, "{error}");
    }
    let refused = run(&pressed(0.1), &Scheme::Event, &Options::with_step(1e-3)).unwrap_err();
    assert!(refused.is_request() && refused.to_string().contains("friction at the slider \"pad\""), "{refused}");
}

/// A slider between two masses that knock against each other.
const KNOCKING: &str = "[[body]]\nname = \"p\"\n[body.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 800.0\n\
    [[body]]\nname = \"q\"\n[body.oscillator]\nmass = 1.5\ndamping = 0.1\nstiffness = 300.0\n\
    [[wall]]\nname = \"knock\"\nat = { body = \"p\", dof = 0, relative_to = { body = \"q\", dof = 0 } }\n\
    side = \"both\"\ngap = 3e-3\nrestitution = 0.6\n\
    [[slider]]\nname = \"rub\"\nat = { body = \"p\", dof = 0, relative_to = { body = \"q\", dof = 0 } }\n\
    normal_force = 2.0\nfriction = 0.2\n\
    [[load]]\nat = { body = \"p\", dof = 0 }\nharmonic = { amplitude = 5.0, frequency = 3.0 }\n\
    [time]\nend = 1.0\nstep = 1e-4\n";

/// The normal force never ends, whatever strikes elsewhere.
#[test]
fn the_contact_of_a_slider_is_one() {
    let case = file(KNOCKING).case().unwrap();
    for scheme in [Scheme::Located, MOREAU_JEAN] {
        let run = run(&case.scene, &scheme, &Options::new(case.time)).unwrap();
        let of = |name: &str| {
            let walls = run.trajectory.walls();
            run.trajectory.contacts().iter().filter(|contact| walls[contact.wall].starts_with(name)).count()
        };
        assert!(of("knock") > 4 && of("rub") == 1, "{scheme}: {} and {}", of("knock"), of("rub"));
    }
}

/// 10 N on a pad that holds 30 N: it sticks for ever, and wears nothing.
#[test]
fn what_sticks_wears_nothing() {
    let text = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 100.0\n\
        [[slider]]\nname = \"pad\"\nnormal_force = 100.0\nfriction = { static = 0.3, kinetic = 0.2 }\n\
        [[load]]\nharmonic = { amplitude = 10.0, frequency = 2.0 }\n[time]\nend = 2.0\nstep = 1e-3\n";
    let case = file(text).case().unwrap();
    for scheme in [Scheme::Located, MOREAU_JEAN] {
        let run = run(&case.scene, &scheme, &Options::new(case.time)).unwrap();
        let wear = &run.statistics.wear[0];
        assert_eq!((wear.work_rate_w, wear.friction_power_w, wear.sliding_m), (0.0, 0.0, 0.0), "{scheme}");
    }
}

/// Storeys of 1000 t with friction dampers on the first and between the first two.
const STOREYS: &str = "[system]\nmodes = 3\n[system.chain]\nmasses = [1e6, 1e6, 1e6]\n\
    springs = [3.5e8, 3.5e8]\nleft = { stiffness = 3.5e8 }\n[system.damping]\nratio = 0.02\n\
    [[slider]]\nname = \"ground\"\nat = { dof = 0 }\nnormal_force = 9.81e6\nfriction = 0.1\n\
    [[slider]]\nname = \"storey\"\nat = { row = [[1, 1.0], [0, -1.0]] }\nnormal_force = 9.81e6\nfriction = 0.1\n\
    [[load]]\nbase = { amplitude = 3.0, frequency = 0.8 }\n[time]\nend = 2.0\nstep = 2.5e-3\n";

/// 1/(g M⁻¹ gᵀ): 1e6 kg of one storey, half of that between two, in the coordinates of all modes
/// as in those of the storeys. A mass of another size has other roundings: bodies of 1e6 kg on
/// pads of 1e-6 kg left them some hundred times.
#[test]
fn a_slider_has_the_mass_of_its_place_in_any_coordinates() {
    for text in [STOREYS, &STOREYS.replace("modes = 3\n", "")] {
        let case = file(text).case().unwrap();
        let structure = case.scene.system.structure();
        for (i, expected) in [(3, 1e6), (4, 0.5e6)] {
            // The modes are known to some units of rounding of the solver of eigenvalues.
            assert!((structure.mass.get(i, i) / expected - 1.0).abs() < 1e-9, "{}", structure.mass.get(i, i));
        }
        let run = run(&case.scene, &Scheme::Located, &Options::new(case.time)).unwrap();
        assert_eq!((run.findings.len(), run.trajectory.contacts().len(), run.counters.steps_given_up), (0, 2, 0));
    }
}

/// The normal force is the one that is given, however the structure starts.
#[test]
fn a_start_that_scatters_does_not_move_what_presses_a_slider() {
    let scattered = "[initial]\nscatter = { velocity = 1e-3, seed = 4 }\n[time]";
    let oscillator = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1e4\n\
        [[slider]]\nname = \"pad\"\nnormal_force = 10.0\nfriction = 0.1\n[time]\nend = 0.2\nstep = 1e-3\n";
    let storeys = STOREYS.replace("9.81e6", "10.0");
    for text in [oscillator, &storeys, &storeys.replace("modes = 3\n", "")] {
        let case = file(&text.replace("[time]", scattered)).case().unwrap();
        for case in [&case, &case.realisation(5).unwrap()] {
            let run = run(&case.scene, &MOREAU_JEAN, &Options::new(case.time)).unwrap();
            for wall in &run.statistics.walls {
                let force = wall.force.as_ref().unwrap().mean_n;
                // The first step has no force yet, and rounding.
                assert!((force.abs() - 10.0).abs() < 1e-9, "{force}");
            }
        }
    }
}
