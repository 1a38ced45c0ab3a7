//! Means over realisations of random loads, with intervals that hold what they promise.

use crate::error_parts::pressed_on_a_flat;
use signorini::linear::Symmetric;
use signorini::study::realisations::{Interval, Measure, Realisation, Realisations, realisations};
use signorini::{
    Density, Error, Flat, Flats, Interrupt, Load, Options, PlaneRows, RandomForce, Result, Row, Scene, Scheme, State,
    Structure, Wall, WallLaw, run,
};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// A body pressed into a spring stop by 10 N, and shaken without leaving it: the scene is linear.
fn pressed(seed: u64) -> Result<Scene> {
    let density = Density::Flat { rms: 0.3, from: 0.5, to: 20.0 };
    let random = RandomForce { density, seed, stream: 0 }.load(2.0)?;
    let scene = Scene::oscillator(1.0, 20.0, 100.0).with_wall(Wall::upper("stop", 0.0).with_elasticity(1000.0, 0.0));
    let initial = State { q: vec![10.0 / 1100.0], v: vec![0.0] };
    Ok(Scene { initial, ..scene.with_load(Load::constant(10.0)).with_load(random).with_duration(2.0) })
}

#[test]
fn nineteen_of_twenty_intervals_hold_the_expectation() {
    // The load has the mean 0 at every instant over all phases, and the scene is linear: the
    // expectation of the stop's force is the static one, 10 N of which the stop carries 1000/1100.
    let mut options = Options::with_step(4e-3);
    options.time.statistics_from = 1.3;
    let (studies, size) = (200, 5);
    let mut holding = 0;
    for study in 0..studies {
        let numbers = study * size + 1..=(study + 1) * size;
        let members = realisations(numbers, &pressed, &MOREAU.into(), &options, &mut |_| {}).unwrap();
        let study = Realisations::new(members);
        assert_eq!((study.count, study.interval), (5, Interval::StudentOfRealisations));
        assert!(study.refuted.is_empty());
        let force = study.estimates.iter().find(|one| one.measure == Measure::ForceMean).unwrap();
        assert!(force.standard_deviation.unwrap() > 0.0);
        holding += usize::from((force.mean - 10.0 / 1.1).abs() <= force.half_width_95.unwrap());
    }
    // 190 of 200, with a standard deviation of √(200·0.95·0.05) = 3.1: 91 to 99 %.
    assert!((182..=198).contains(&holding), "{holding} of {studies} intervals hold the expectation");
}

/// A body pressed on a flat by 10 N, which a random force shakes along it, without friction.
fn slid(seed: u64) -> Result<Scene> {
    let density = Density::Flat { rms: 0.3, from: 0.5, to: 20.0 };
    let at = PlaneRows::doubled(&Row::dof(0), 1).along(0.0);
    let random = Load { at, ..RandomForce { density, seed, stream: 0 }.load(2.0)? };
    Ok(pressed_on_a_flat([20.0, 100.0], 0.0, 2.0)?.with_load(random))
}

#[test]
fn nineteen_of_twenty_intervals_hold_the_expected_work_rate_and_with_it_volume_and_even_depth() {
    // The velocity along the flat is normal, with the variance ∫ S ω²/((k − mω²)² + (cω)²) df of
    // linear vibration: its mean magnitude is σ √(2/π), and the work rate 10 N times that. The
    // volume worn and the depth evenly all round are multiples of it. The lines of 0.5 Hz take the
    // integral to a per cent, a fiftieth of an interval.
    let (count, [from, to]) = (4000, [0.5, 20.0]);
    let width = (to - from) / f64::from(count);
    let share = |k: i32| {
        let omega = std::f64::consts::TAU * (from + (f64::from(k) + 0.5) * width);
        omega.powi(2) / ((100.0 - omega.powi(2)).powi(2) + (20.0 * omega).powi(2)) * width
    };
    let variance = 0.3_f64.powi(2) / (to - from) * (0..count).map(share).sum::<f64>();
    let expected = 10.0 * (2.0 * variance / std::f64::consts::PI).sqrt();
    let mut options = Options::with_step(4e-3);
    options.time.statistics_from = 1.3;
    let (studies, size) = (200, 5);
    let holds = |study: u64| {
        let numbers = study * size + 1..=(study + 1) * size;
        let study = Realisations::new(realisations(numbers, &slid, &MOREAU.into(), &options, &mut |_| {}).unwrap());
        let rate = study.estimates.iter().find(|one| one.measure == Measure::WorkRate).unwrap();
        (rate.mean - expected).abs() <= rate.half_width_95.unwrap()
    };
    let holding = (0..studies).filter(|study| holds(*study)).count();
    // 190 of 200, with a standard deviation of √(200·0.95·0.05) = 3.1: 91 to 99 %.
    assert!((182..=198).contains(&holding), "{holding} of {studies} intervals hold {expected} W");
}

#[test]
fn realisations_are_runs_of_their_own_in_the_order_of_their_numbers() {
    let mut options = Options::with_step(4e-3);
    options.time.statistics_from = 0.5;
    let mut told = Vec::new();
    let members = realisations(3..=9, &pressed, &MOREAU.into(), &options, &mut |share| told.push(share)).unwrap();
    let alone = |number: u64| Realisation::of(number, &run(&pressed(number).unwrap(), &MOREAU, &options).unwrap());
    let expected: Vec<Realisation> = (3..=9).map(alone).collect();
    assert_eq!(members, expected);
    assert_eq!(told.last(), Some(&1.0));
    assert!(told.iter().all(|share| (0.0..=1.0).contains(share)), "{told:?}");
    // None asked for, none made.
    let (first, last) = (2, 1);
    assert!(realisations(first..=last, &pressed, &MOREAU.into(), &options, &mut |_| {}).unwrap().is_empty());
}

#[test]
fn what_fails_or_is_stopped_ends_all() {
    let failing = |number: u64| match number {
        4 => Ok(Scene::oscillator(-4.0, 0.0, 100.0)),
        _ => pressed(number),
    };
    let options = Options::with_step(4e-3);
    let error = realisations(1..=6, &failing, &MOREAU.into(), &options, &mut |_| {}).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("-4"), "{error}");
    // Ten thousand million steps each, which nobody waits for.
    let endless = |_: u64| Ok(Scene::oscillator(1.0, 0.0, 100.0).with_duration(1e6));
    let options = Options::with_step(1e-4).with_sample(1e3);
    let interrupt = Interrupt::new(|| true);
    let outcome = interrupt.over(|| realisations(1..=4, &endless, &MOREAU.into(), &options, &mut |_| {}));
    assert_eq!(outcome.unwrap_err(), Error::Stopped);
}

#[test]
fn a_hole_carries_what_presses_into_it() {
    // 1 kg in two planes on springs of 100 N/m in a hole of 1 mm, pushed by 10 N along (−0.6,
    // −0.8): it rests on the hole there, which carries the load less the spring's 0.1 N. The start
    // is a millionth short of the hole; the impact there dies out in the first half of the run.
    let [mass, damping, stiffness] = [1.0, 0.0, 100.0].map(|x| Symmetric::diagonal(&[x, x]));
    let mut scene = Scene::structure(Structure { mass, damping, stiffness }).with_duration(1.0);
    let at = PlaneRows::doubled(&Row::dof(0), 1);
    let wall = Wall::round("hole", at.clone(), 1e-3).with_restitution(0.0);
    scene = scene.with_support("hole", at, [0.0, 0.0], vec![wall]);
    let way = [-0.6, -0.8];
    let load = Load { at: Row::new(vec![(0, way[0]), (1, way[1])]), ..Load::constant(10.0) };
    let initial = State { q: way.map(|x| 1e-3 * (1.0 - 1e-6) * x).to_vec(), v: vec![0.0, 0.0] };
    let scene = Scene { initial, ..scene.with_load(load) };
    let mut options = Options::with_step(1e-3);
    options.time.statistics_from = 0.5;
    let run = run(&scene, &MOREAU, &options).unwrap();
    let [support] = run.statistics.supports.as_slice() else { panic!("one support") };
    let force = support.force.unwrap();
    // It rests where it landed, up to the way of a step beyond the hole: h²·10 N/kg = 1e-5 m, and
    // the spring carries 1e-3 N more there.
    let close = |x: f64, y: f64| assert!((x - y).abs() < 2e-3, "{x} instead of {y}");
    close(force.mean_n, 9.9);
    close(force.rms_n, 9.9);
    close(force.mean_vector_n[0], 0.6 * 9.9);
    close(force.mean_vector_n[1], 0.8 * 9.9);
    // Rest does not scatter.
    assert!(force.mean_half_width_95_n.unwrap() < 1e-9 && (force.rms_n - force.mean_n).abs() < 1e-9);
}

#[test]
fn a_support_carries_what_its_flats_do() {
    // 1 kg in two planes on springs of 100 N/m in a square of half width 1 mm, pushed by 10 N
    // towards 240°: it rests in the corner of the flats at 180° and 270°, and each carries its part
    // of the load less the spring's 0.1 N.
    let [mass, damping, stiffness] = [1.0, 0.0, 100.0].map(|x| Symmetric::diagonal(&[x, x]));
    let structure = Structure { mass, damping, stiffness };
    let at = PlaneRows::doubled(&Row::dof(0), 1);
    let flats = Flats {
        name: "square".to_owned(),
        at: at.clone(),
        flats: [0.0, 90.0, 180.0, 270.0].map(|direction| Flat { direction, gap: 1e-3 }).to_vec(),
        centre: [0.0, 0.0],
        law: WallLaw::Rigid { restitution: 0.5 },
        friction: 0.0.into(),
    };
    let mut scene = Scene::structure(structure).with_duration(1.0);
    for wall in flats.walls().unwrap() {
        scene = scene.with_wall(wall);
    }
    scene.supports.push(flats.support(0));
    let load = Load { at: at.along(240.0), ..Load::constant(10.0) };
    let initial = State { q: vec![-1e-3, -1e-3], v: vec![0.0, 0.0] };
    let scene = Scene { initial, ..scene.with_load(load) };
    let expected = [10.0 * 0.5 - 0.1, 10.0 * 0.75_f64.sqrt() - 0.1];
    let run = run(&scene, &MOREAU, &Options::with_step(1e-3)).unwrap();
    let [support] = run.statistics.supports.as_slice() else { panic!("one support") };
    let force = support.force.unwrap();
    // A thousand steps of rounding.
    let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-11, "{x} instead of {y}");
    close(force.mean_vector_n[0], expected[0]);
    close(force.mean_vector_n[1], expected[1]);
    close(force.mean_n, expected[0] + expected[1]);
    close(force.rms_n, expected[0].hypot(expected[1]));
    close(force.mean_half_width_95_n.unwrap(), 0.0);
    assert_eq!(support.contacts, 2);
    assert_eq!(force.rms_averaged_over_s, 1e-3);
    // Its flats are walls too: two of them push, and no other.
    let walls: Vec<f64> = run.statistics.walls.iter().map(|wall| wall.force.unwrap().mean_n).collect();
    close(walls[0] + walls[1], 0.0);
    close(walls[2], expected[0]);
    close(walls[3], expected[1]);
}
