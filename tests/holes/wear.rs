//! Sliding and work of wear at supports made of flats, against closed forms.
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

use signorini::case::CaseFile;
use signorini::linear::Symmetric;
use signorini::{
    Flat, Flats, Load, LoadKind, Options, PlaneRows, Row, Run, Scene, Scheme, Structure, TimeOptions, WallLaw,
    WearStatistics, run,
};

const JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// A body of two degrees of freedom, y and z, with the lower triangle of its mass matrix (kg) and a
/// stiffness (N/m) in both directions, in the state (q, v).
fn body(mass: [f64; 3], stiffness: f64, (q, v): ([f64; 2], [f64; 2])) -> Scene {
    let [yy, yz, zz] = mass;
    let structure = Structure {
        mass: Symmetric::from_entries(2, [(0, 0, yy), (1, 0, yz), (1, 1, zz)]),
        damping: Symmetric::from_entries(2, []),
        stiffness: Symmetric::from_entries(2, [(0, 0, stiffness), (1, 1, stiffness)]),
    };
    Scene::structure(structure).with_initial(&q, &v)
}

/// Adds a support of flats at the body.
fn among(mut scene: Scene, directions: &[f64], gap: f64, law: WallLaw) -> Scene {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let flats = directions.iter().map(|&direction| Flat { direction, gap }).collect();
    let flats = Flats { name: "plate".to_owned(), at, flats, centre: [0.0; 2], law, friction: 0.0.into() };
    scene.supports.push(flats.support(scene.walls.len()));
    scene.walls.extend(flats.walls().unwrap());
    scene
}

fn rigid(restitution: f64) -> WallLaw {
    WallLaw::Rigid { restitution }
}

fn made(scene: &Scene, scheme: Scheme, step: f64) -> Run {
    run(scene, &scheme, &Options::with_step(step)).unwrap_or_else(|error| panic!("{scheme}: {error}"))
}

fn only(run: &Run) -> &WearStatistics {
    let [support] = run.statistics.wear.as_slice() else { panic!("{:?}", run.statistics.wear) };
    support
}

/// The sectors add up to the support, to the rounding of their sums.
fn adds_up(support: &WearStatistics) {
    let work: f64 = support.sectors.iter().map(|sector| sector.work_rate_w).sum();
    let share: f64 = support.sectors.iter().map(|sector| sector.impulse_share).sum();
    assert!((work / support.work_rate_w - 1.0).abs() < 1e-12 && (share - 1.0).abs() < 1e-12, "{support:?}");
}

#[test]
fn an_oblique_impact_turns_the_sliding_round() {
    // The mass that the flat feels is not the same along it and across: the sliding velocity
    // changes its sign within the impulse. Impulse and work with 40 digits.
    let scene = body([2.0, 0.9, 1.0], 0.0, ([0.0; 2], [0.3, 0.05]));
    let scene = among(scene, &[0.4_f64.to_degrees()], 1e-2, rigid(0.6)).with_duration(0.06);
    for scheme in [JEAN, Scheme::Event] {
        let run = made(&scene, scheme, 1e-3);
        let impulse = run.trajectory.impulse("plate-flat-1").unwrap().abs();
        let support = only(&run);
        // Motion without forces: a few roundings.
        assert!((impulse / 1.112951674372231955350017 - 1.0).abs() < 1e-13, "{scheme}: {impulse}");
        let work = support.work_rate_w * 0.06;
        assert!((work / 0.08311015061068987033609258 - 1.0).abs() < 1e-13, "{scheme}: {work}");
        assert!((support.impact_share.unwrap() - 1.0).abs() < 1e-13);
        assert_eq!((support.sliding_m, support.contact_time_ratio), (0.0, 0.0));
        assert!(support.upper_figure && support.friction_power_w == 0.0);
        // The flat pushes the body against its normal.
        let [y, z] = run.statistics.supports[0].force.unwrap().mean_vector_n.map(|force| force * 0.06 / impulse);
        assert!((y + 0.4_f64.cos()).abs() < 1e-13 && (z + 0.4_f64.sin()).abs() < 1e-13, "{y} {z}");
        adds_up(support);
    }
}

#[test]
fn a_billiard_in_a_square_hole_slides_by_at_every_impact() {
    let scene = body([1.3, 0.0, 1.3], 0.0, ([2e-4, -6e-4], [0.05, 0.083]));
    let scene = among(scene, &[20.0, 110.0, 200.0, 290.0], 1e-3, rigid(1.0));
    // 68 impacts with 40 digits by unfolding; every impact gives some roundings. In a step of a
    // grid that meets two flats each turns the sliding along the other round, and a pair of impacts
    // loses half of its work: one such pair is allowed.
    for (scheme, tolerance) in [(Scheme::Event, 1e-12), (JEAN, 1.6e-2)] {
        let run = made(&scene, scheme, 1e-5);
        let support = only(&run);
        assert!((support.work_rate_w / 0.8114557507972737095142388 - 1.0).abs() < tolerance, "{scheme}: {support:?}");
        let force = run.statistics.supports[0].force.unwrap();
        assert!((force.mean_n / 12.19647499800806411517645 - 1.0).abs() < 1e-12, "{scheme}: {force:?}");
        assert!((support.impact_share.unwrap() - 1.0).abs() < 1e-13 && support.sliding_m == 0.0);
        // Each flat in the sector of its normal.
        let busy = support.sectors.iter().filter(|sector| sector.work_rate_w > 0.0);
        assert_eq!(busy.map(|sector| sector.from_deg).collect::<Vec<_>>(), [0.0, 90.0, 180.0, 270.0]);
        adds_up(support);
    }
}

#[test]
fn a_body_pressed_on_a_flat_slides_two_amplitudes_a_swing() {
    // 1 kg on 1e4 N/m, released at 0.85 mm along y and pressed onto a flat by 10 N along z.
    let (amplitude, force) = (0.85e-3, 10.0);
    let swings = 7.0;
    let scene = body([1.0, 0.0, 1.0], 1e4, ([amplitude, 0.0], [0.0; 2]));
    let mut scene = among(scene, &[90.0], 0.0, rigid(0.5));
    scene.loads.push(Load { at: Row::dof(1), kind: LoadKind::Constant { force } });
    let scene = scene.with_duration(swings * std::f64::consts::PI / 100.0);
    let distance = swings * 2.0 * amplitude;
    // Seven turning points, found to rounding; the trapezium rule of the motion is 1/12 (ωh)² slow
    // in phase, which leaves the swings whole up to its square, and each end of a swing is cut by a
    // step: (ωh)²/8 of an amplitude.
    for (scheme, steps, tolerance) in [(Scheme::Event, 700, 1e-13), (JEAN, 7000, 1e-5), (JEAN, 28000, 1e-6)] {
        let run = made(&scene, scheme, scene.duration / f64::from(steps));
        let support = only(&run);
        let work = support.work_rate_w * scene.duration;
        assert!((work / (force * distance) - 1.0).abs() < tolerance, "{scheme}: {work}");
        assert!((support.sliding_m / distance - 1.0).abs() < tolerance, "{scheme}: {}", support.sliding_m);
        let mean = run.statistics.supports[0].force.unwrap();
        assert!((mean.mean_n / force - 1.0).abs() < 1e-9 && mean.mean_vector_n[0] == 0.0);
        assert!((support.contact_time_ratio - 1.0).abs() < 1e-12, "{scheme}: {support:?}");
        let speed = support.sliding_speed_m_per_s.unwrap();
        assert!((speed * scene.duration / distance - 1.0).abs() < tolerance, "{scheme}: {speed}");
        // On a grid the first two steps cannot be told from an impact.
        assert!(support.impact_share.is_none_or(|share| share < 1e-3), "{scheme}: {support:?}");
        assert!((support.sectors[3].work_rate_w / support.work_rate_w - 1.0).abs() < 1e-12);
        adds_up(support);
    }
}

#[test]
fn a_blow_comes_before_the_impact_that_it_makes() {
    // At rest on a flat, struck obliquely: the sliding velocity of the impact is what the blow
    // gave, J_t/m throughout, and its impulse (1 + e) J_n.
    let scene = body([1.3, 0.0, 1.3], 0.0, ([0.0; 2], [0.0; 2]));
    let mut scene = among(scene, &[0.0], 0.0, rigid(0.5)).with_duration(0.05);
    scene
        .loads
        .push(Load { at: Row::new(vec![(0, 0.4), (1, -0.7)]), kind: LoadKind::Impulse { impulse: 0.5, time: 0.0205 } });
    let work = 1.5 * 0.2 * (0.35 / 1.3);
    for scheme in [Scheme::Event, JEAN] {
        let support = made(&scene, scheme, 1e-3);
        // A body without other forces: roundings.
        let found = only(&support).work_rate_w * 0.05;
        assert!((found / work - 1.0).abs() < 1e-12, "{scheme}: {found} {work}");
    }
}

#[test]
fn an_elastic_flat_gives_the_work_of_its_impulse() {
    // Thrown obliquely at a spring: the impulse is 2 m v_n, and the sliding velocity stays.
    let scene = body([1.3, 0.0, 1.3], 0.0, ([0.0; 2], [0.2, -0.15]));
    let scene = among(scene, &[0.0], 1e-3, WallLaw::Elastic { stiffness: 1e5, damping: 0.0 }).with_duration(0.05);
    let work = 2.0 * 1.3 * 0.2 * 0.15;
    let lasts = std::f64::consts::PI * (1.3_f64 / 1e5).sqrt();
    for (scheme, tolerance) in [(Scheme::Event, 1e-13), (JEAN, 1e-6)] {
        // moreau-jean meets and leaves the spring within a step: to the square of the step over the
        // duration of the contact, 8e-6.
        let run = made(&scene, scheme, 1e-5);
        let support = only(&run);
        assert!((support.work_rate_w * 0.05 / work - 1.0).abs() < tolerance, "{scheme}: {support:?}");
        assert_eq!(support.impact_share, None);
        // The contact on a grid begins and ends within a step.
        assert!((support.sliding_m / (0.15 * lasts) - 1.0).abs() < 2e-5 / lasts, "{scheme}: {support:?}");
        assert!((support.sectors[0].work_rate_w / support.work_rate_w - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_window_and_the_number_of_sectors_are_kept() {
    let scene = body([1.3, 0.0, 1.3], 0.0, ([2e-4, -6e-4], [0.05, 0.083]));
    let scene = among(scene, &[20.0, 110.0, 200.0, 290.0], 1e-3, rigid(1.0));
    let time = TimeOptions { statistics_from: 0.5, sectors: 36, ..TimeOptions::with_step(1e-4) };
    let run = run(&scene, &Scheme::Event, &Options::new(time)).unwrap();
    let support = only(&run);
    assert_eq!(support.sectors.len(), 36);
    assert_eq!((support.sectors[2].from_deg, support.sectors[2].to_deg), (20.0, 30.0));
    assert!(support.sectors[2].work_rate_w > 0.0 && support.sectors[3].work_rate_w == 0.0);
    // Each impact slides at the speed that it leaves: the work is that of the impacts in the
    // window.
    let walls = &run.trajectory;
    let late = walls.contacts().iter().filter(|contact| contact.start >= 0.5);
    let (turn, v) = (20_f64.to_radians(), [0.05_f64, 0.083]);
    let along = [v[0] * turn.cos() + v[1] * turn.sin(), -v[0] * turn.sin() + v[1] * turn.cos()];
    let work: f64 = late.map(|contact| contact.impulse.abs() * along[(contact.wall + 1) % 2].abs()).sum();
    assert!((support.work_rate_w * 0.5 / work - 1.0).abs() < 1e-12, "{support:?}");
    for sectors in [0, 3601] {
        let time = TimeOptions { sectors, ..TimeOptions::with_step(1e-4) };
        let error = signorini::run(&scene, &JEAN, &Options::new(time)).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("from 1 to 3600"), "{error}");
    }
}

#[test]
fn every_scheme_tells_the_work_of_a_flat() {
    use signorini::{Integrator, PenaltyLaw};
    // The oblique impact of a free body with equal masses: the work is 2 m v_n v_t at e = 1, and
    // half of it where a scheme realises e = 0.
    let scene = body([1.3, 0.0, 1.3], 0.0, ([0.0; 2], [0.2, -0.15]));
    let scene = among(scene, &[0.0], 1e-3, rigid(1.0)).with_duration(0.05);
    let law = PenaltyLaw::Linear { stiffness: 1e5, damping: 0.0 };
    let whole = 2.0 * 1.3 * 0.2 * 0.15;
    for (scheme, work) in [
        (Scheme::PaoliSchatzman, whole),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, whole),
        (Scheme::ImplicitEuler, 0.5 * whole),
        (Scheme::Penalty { law, integrator: Integrator::DiscreteGradient }, whole),
    ] {
        let run = made(&scene, scheme, 1e-5);
        let found = only(&run).work_rate_w * 0.05;
        // The sliding velocity never changes, so the work has the error of the impulse.
        let impulse = run.trajectory.impulse("plate-flat-1").unwrap().abs();
        assert!((found / (impulse * 0.15) - 1.0).abs() < 1e-12, "{scheme}: {found}");
        assert!((found / work - 1.0).abs() < 1e-2, "{scheme}: {found} {work}");
    }
}

/// A mass is pressed on one flat for ever and strikes another one at a right angle to it: that
/// takes nothing from the time in contact, whichever of the two comes first.
#[test]
fn a_blow_of_one_flat_takes_no_time_from_another() {
    let text = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 100.0\n\
        [[support]]\nname = \"flat\"\nshape = \"flats\"\ndirections = [0.0, 90.0]\ngap = [5e-3, 0.0]\n\
        restitution = 0.5\n[[load]]\ndirection = 90.0\nconstant = { force = 10.0 }\n\
        [initial]\ndisplacement = [-0.01, 0.0]\n[time]\nend = 3.0\nstep = 1e-3\n";
    let turned = text.replace("[0.0, 90.0]", "[90.0, 0.0]").replace("[5e-3, 0.0]", "[0.0, 5e-3]");
    for text in [text, &turned] {
        let case = CaseFile::from_text(text, "case.toml", "").case().unwrap();
        for scheme in [Scheme::Event, Scheme::Located] {
            let run = run(&case.scene, &scheme, &Options::new(case.time)).unwrap();
            assert!(run.trajectory.contacts().len() > 5, "{scheme}");
            let ratio = run.statistics.wear[0].contact_time_ratio;
            assert!((ratio - 1.0).abs() < 1e-12, "{scheme}: {ratio}");
        }
    }
}
