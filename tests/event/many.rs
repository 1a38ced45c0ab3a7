//! The exact scheme for several degrees of freedom: against that for one, closed forms, and refined
//! runs.

use crate::common;
use signorini::linear::Symmetric;
use signorini::{Load, Options, Probe, Row, Run, Scene, Scheme, Structure, System, TimeOptions, Wall, run};
use std::f64::consts::PI;

fn as_matrices(mut scene: Scene) -> Scene {
    let System::Oscillator(o) = scene.system else { return scene };
    let one = |x: f64| Symmetric::diagonal(&[x]);
    let structure = Structure { mass: one(o.mass), damping: one(o.damping), stiffness: one(o.stiffness) };
    scene.system = structure.into();
    scene
}

fn options(scene: &Scene, rows: f64) -> Options {
    let mut options = Options::with_step(0.5 * scene.duration);
    options.time = TimeOptions { sample: Some(scene.duration / rows), ..options.time };
    options
}

fn exact(scene: &Scene, rows: f64) -> Run {
    run(scene, &Scheme::Event, &options(scene, rows)).unwrap()
}

fn assert_judged(run: &Run) {
    let r = &run.residuals;
    assert!(r.energy.residual < 1e-12, "{:?}", r.energy);
    assert!(r.complementarity < 1e-10, "{}", r.complementarity);
    assert!(r.force_balance < 1e-9, "{}", r.force_balance);
    assert!(r.tension_n <= 1e-12 * r.force_scale_n, "{}", r.tension_n);
}

/// One run by each exact scheme, and the largest difference of displacement over half the gap.
fn difference(scene: Scene) -> (f64, Run, Run) {
    let (a, b) = (exact(&scene, 500.0), exact(&as_matrices(scene), 500.0));
    let error = common::error(a.trajectory.displacement(), b.trajectory.displacement());
    (error, a, b)
}

#[test]
fn one_degree_of_freedom_as_matrices_is_the_oscillator() {
    let mut weak = common::elastic(0.0, 1.0);
    weak.duration = 1.0;
    for (name, scene) in [
        ("e = 1", common::source(1.0, 1.0).with_duration(2.0)),
        ("e = 0.8", common::source(0.8, 0.8).with_duration(2.0)),
        ("e = 0", common::source(0.0, 0.0).with_duration(2.0)),
        (
            "e = 0.5 above, 0 below, a blow",
            common::source(0.5, 0.0).with_load(Load::impulse(0.05, 0.3)).with_duration(2.0),
        ),
        ("elastic above", weak),
        ("damped elastic above", common::elastic(5.0, 0.5).with_duration(1.0)),
        ("damped elastic on both sides", common::all_elastic(20.0).with_duration(1.0)),
    ] {
        let (error, a, b) = difference(scene);
        println!("{name}: {error:e} {:?}", b.counters);
        // Rounding, amplified at e = 1 by a factor of 60 in 2 s.
        assert!(error < 1e-11, "{name}: {error:e}");
        assert_eq!(a.trajectory.contacts().len(), b.trajectory.contacts().len(), "{name}");
        for (x, y) in a.trajectory.contacts().iter().zip(b.trajectory.contacts()) {
            assert_eq!(x.wall, y.wall, "{name}");
            assert!((x.start - y.start).abs() < 1e-11, "{name}: {x:?} {y:?}");
            assert!((x.impulse - y.impulse).abs() < 1e-9, "{name}: {x:?} {y:?}");
            let peak = |c: &signorini::Contact| c.peak_force.unwrap_or(0.0);
            assert!((peak(x) - peak(y)).abs() < 1e-7, "{name}: {x:?} {y:?}");
        }
        assert_judged(&b);
    }
}

#[test]
fn a_ball_comes_to_rest_when_its_rebounds_accumulate() {
    let ball = as_matrices(common::ball(1.0, 0.9)).with_duration(10.0);
    let run = exact(&ball, 1000.0);
    // t∞ = √(2h/g)(1+e)/(1−e); the tail that is closed is 1e-12 of the height.
    let rest = run.trajectory.contacts().last().unwrap();
    assert!((rest.start - 8.578_949).abs() < 1e-4, "{rest:?}");
    assert_eq!(rest.end, None);
    let steady = run.trajectory.contact_force("floor").unwrap();
    assert!((steady[990] - 9.81).abs() < 1e-12);
    assert_judged(&run);
}

fn diagonal(mass: &[f64], damping: &[f64], stiffness: &[f64]) -> Structure {
    let of = Symmetric::diagonal;
    Structure { mass: of(mass), damping: of(damping), stiffness: of(stiffness) }
}

/// A scene with a probe at each degree of freedom.
pub fn scene(structure: Structure) -> Scene {
    let probes = (0..structure.mass.size()).map(|i| Probe { name: format!("q{i}"), at: Row::dof(i) }).collect();
    Scene { probes, ..Scene::structure(structure) }
}

/// Masses m between springs k, fixed at both ends, with damping β K.
fn chain(n: usize, m: f64, k: f64, beta: f64) -> Structure {
    let stiffness = |factor: f64| {
        let inner = (0..n).flat_map(|i| {
            let next = (i + 1 < n).then_some((i, i + 1, -factor * k));
            std::iter::once((i, i, 2.0 * factor * k)).chain(next)
        });
        Symmetric::from_entries(n, inner)
    };
    Structure { mass: Symmetric::diagonal(&vec![m; n]), damping: stiffness(beta), stiffness: stiffness(1.0) }
}

fn at(wall: Wall, row: Row) -> Wall {
    wall.at(row)
}

fn load_at(mut load: Load, row: Row) -> Load {
    load.at = row;
    load
}

#[test]
fn oscillators_that_do_not_touch_each_other_move_alone() {
    let (one, other) = (common::source(0.8, 0.8), common::source(0.0, 0.0));
    let other = Scene { loads: vec![Load::harmonic(5.0, 3.0, 0.4)], ..other };
    let both = scene(diagonal(&[1.0, 1.0], &[0.2, 0.2], &[100.0, 100.0]))
        .with_load(load_at(one.loads[0].clone(), Row::dof(0)))
        .with_load(load_at(other.loads[0].clone(), Row::dof(1)));
    let renamed = |walls: &[Wall], dof: usize| {
        let named = |w: &Wall| at(Wall { name: format!("{}{dof}", w.name), ..w.clone() }, Row::dof(dof));
        walls.iter().map(named).collect::<Vec<_>>()
    };
    let walls = [renamed(&one.walls, 0), renamed(&other.walls, 1)].concat();
    let both = Scene { walls, ..both }.with_duration(2.0);
    let run = exact(&both, 500.0);
    for (alone, name) in [(one, "q0"), (other, "q1")] {
        let alone = exact(&alone.with_duration(2.0), 500.0);
        let error = common::error(alone.trajectory.displacement(), run.trajectory.probe(name).unwrap().0);
        // Rounding only: these motions do not amplify it.
        assert!(error < 1e-12, "{name}: {error:e}");
    }
    assert_judged(&run);
}

#[test]
fn two_masses_collide_as_their_restitution_says() {
    for e in [0.0, 0.3, 1.0] {
        let (m1, m2, v) = (2.0, 0.7, 1.5);
        let relative = Row::new(vec![(0, 1.0), (1, -1.0)]);
        let free = scene(diagonal(&[m1, m2], &[0.0; 2], &[0.0; 2]))
            .with_wall(at(Wall::upper("between", 0.0).with_restitution(e), relative))
            .with_initial(&[-1.0, 0.5], &[v, 0.0])
            .with_duration(2.0);
        let run = exact(&free, 100.0);
        let (_, v1) = run.trajectory.probe("q0").unwrap();
        let (_, v2) = run.trajectory.probe("q1").unwrap();
        let expected = [(m1 - e * m2) / (m1 + m2) * v, m1 * (1.0 + e) / (m1 + m2) * v];
        assert!((v1[100] - expected[0]).abs() < 1e-14, "{} {expected:?}", v1[100]);
        assert!((v2[100] - expected[1]).abs() < 1e-14, "{} {expected:?}", v2[100]);
        let loss = 0.5 * m1 * m2 / (m1 + m2) * (1.0 - e * e) * v * v;
        assert!((run.residuals.energy.impact_loss_j - loss).abs() < 1e-14);
        let contact = run.trajectory.contacts()[0];
        assert!((contact.start - 1.0).abs() < 1e-15 && (contact.approach_speed - v).abs() < 1e-15, "{contact:?}");
        assert_judged(&run);
    }
}

#[test]
fn free_flight_is_the_sum_of_its_modes_over_a_thousand_periods() {
    let (n, m, k) = (4, 2.0, 50.0);
    let omega = |j: usize| 2.0 * f64::sqrt(k / m) * (0.5 * PI * (j + 1) as f64 / (n + 1) as f64).sin();
    let shape = |j: usize, i: usize| (PI * ((j + 1) * (i + 1)) as f64 / (n + 1) as f64).sin();
    let q0: Vec<f64> = (0..n).map(|i| (0..n).map(|j| shape(j, i) / (j + 1) as f64).sum()).collect();
    let end = 1000.0 * 2.0 * PI / omega(0);
    let run = exact(&scene(chain(n, m, k, 0.0)).with_initial(&q0, &[0.0; 4]).with_duration(end), 100.0);
    for i in 0..n {
        let (q, _) = run.trajectory.probe(&format!("q{i}")).unwrap();
        let closed: f64 = (0..n).map(|j| shape(j, i) / (j + 1) as f64 * (omega(j) * end).cos()).sum();
        // Rounding of the time: at t = 1000 periods ω t is known to 4e-13, and some thousand series
        // have been rounded since the start.
        assert!((q[100] - closed).abs() < 1e-11, "{} {closed}", q[100]);
    }
    assert_judged(&run);
}

#[test]
fn lasting_contact_at_several_walls_carries_the_static_reaction() {
    // Three masses pressed onto walls at the outer two, and hanging between them.
    let (k, load) = (100.0, -3.0);
    let mut pressed = scene(chain(3, 1.0, k, 0.05)).with_duration(60.0);
    for dof in 0..3 {
        pressed = pressed.with_load(load_at(Load::constant(load), Row::dof(dof)));
    }
    for (name, dof, e) in [("left", 0, 0.0), ("right", 2, 0.5)] {
        pressed = pressed.with_wall(at(Wall::lower(name, -0.01).with_restitution(e), Row::dof(dof)));
    }
    let run = exact(&pressed, 600.0);
    // q₂ = (load − 2 k 0.01)/(2k); reaction = 2k·(−0.01) − k q₂ − load.
    let q2 = (load - 2.0 * k * 0.01) / (2.0 * k);
    let reaction = -2.0 * k * 0.01 - k * q2 - load;
    for name in ["left", "right"] {
        let force = run.trajectory.contact_force(name).unwrap();
        assert!((force[600] - reaction).abs() < 1e-12, "{} {reaction}", force[600]);
    }
    assert!((run.trajectory.probe("q1").unwrap().0[600] - q2).abs() < 1e-14);
    assert_judged(&run);
}

/// The chain of 20 between walls at every mass.
fn chain_20(duration: f64) -> Scene {
    let mut scene = scene(chain(20, 1.0, 1e4, 1e-5)).with_load(Load::harmonic(50.0, 5.0, 0.0)).with_duration(duration);
    for dof in 0..20 {
        for wall in [Wall::upper(&format!("u{dof}"), 1e-3), Wall::lower(&format!("l{dof}"), -1e-3)] {
            scene = scene.with_wall(at(wall.with_restitution(0.0), Row::dof(dof)));
        }
    }
    scene
}

#[test]
fn a_chain_is_what_refined_steps_tend_to() {
    let scene = chain_20(0.2);
    let reference = exact(&scene, 100.0);
    println!("{:?} {} s", reference.counters, reference.seconds);
    assert_judged(&reference);
    let error = |h: f64| {
        let mut options = Options::with_step(h);
        options.time = TimeOptions { sample: Some(2e-3), ..options.time };
        let run = run(&scene, &common::MOREAU_JEAN, &options).unwrap();
        let of = |name: String| {
            let (a, b) = (reference.trajectory.probe(&name).unwrap().0, run.trajectory.probe(&name).unwrap().0);
            a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / 1e-3
        };
        (0..20).map(|i| of(format!("q{i}"))).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(2e-5), error(2.5e-6));
    println!("{coarse:e} {fine:e}");
    // Order 1 through impacts: an eighth of the step, about an eighth of the error, which the
    // impacts have made grow by some thousands.
    assert!(fine < 0.03 && fine < 0.25 * coarse, "{coarse:e} {fine:e}");
}

#[test]
fn permuting_degrees_of_freedom_permutes_the_motion() {
    let scene = chain_20(0.1);
    let run = exact(&scene, 50.0);
    let turn = |i: usize| (7 * i + 3) % 20;
    let mut turned = scene.clone();
    if let System::Structure(s) = &mut turned.system {
        let matrix = |m: &Symmetric| Symmetric::from_entries(20, m.entries().map(|(i, j, x)| (turn(i), turn(j), x)));
        **s = Structure { mass: matrix(&s.mass), damping: matrix(&s.damping), stiffness: matrix(&s.stiffness) };
    }
    let row = |row: &Row| Row::new(row.entries().iter().map(|&(i, x)| (turn(i), x)).collect());
    turned.walls.iter_mut().for_each(|w| *w = w.clone().at(row(w.row())));
    turned.loads.iter_mut().for_each(|l| l.at = row(&l.at));
    turned.probes.iter_mut().for_each(|p| p.at = row(&p.at));
    let other = exact(&turned, 50.0);
    assert_eq!(run.trajectory.contacts().len(), other.trajectory.contacts().len());
    for i in 0..20 {
        let name = format!("q{i}");
        let (a, b) = (run.trajectory.probe(&name).unwrap().0, other.trajectory.probe(&name).unwrap().0);
        let error = a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(error < 1e-13, "{name}: {error:e}");
    }
}

#[test]
fn three_supports_of_a_rigid_bar_share_its_weight() {
    // Heave and tilt of a free bar on three walls: the reactions of least Σ Wᵢᵢ rᵢ² among those in
    // balance. By symmetry the outer two are equal, and of r = (a, N − 2a, a) with W = (1/m + d²/I,
    // 1/m, 1/m + d²/I) the least is at a = N/(m (2 W₀ + 4 W₁)) · 2 … solved below.
    let (m, inertia, d, g) = (2.0, 0.5, 0.7, 9.81);
    let mut bar = scene(diagonal(&[m, inertia], &[0.1, 0.1], &[0.0; 2]))
        .with_load(load_at(Load::constant(-m * g), Row::dof(0)))
        .with_initial(&[1e-3, 0.0], &[0.0; 2])
        .with_duration(1.0);
    for (name, arm) in [("left", -d), ("middle", 0.0), ("right", d)] {
        let row = Row::new(vec![(0, 1.0), (1, arm)]);
        bar = bar.with_wall(at(Wall::lower(name, 0.0).with_restitution(0.0), row));
    }
    let run = exact(&bar, 100.0);
    let (outer, middle) = (1.0 / m + d * d / inertia, 1.0 / m);
    // d/da [2 W₀ a² + W₁ (N − 2a)²] = 0.
    let a = middle * m * g / (outer + 2.0 * middle);
    for (name, expected) in [("left", a), ("middle", m * g - 2.0 * a), ("right", a)] {
        let force = run.trajectory.contact_force(name).unwrap();
        assert!((force[100] - expected).abs() < 1e-12, "{name}: {} {expected}", force[100]);
    }
    assert_judged(&run);
}

#[test]
fn code_aster_benchmarks_hold_for_matrices_of_one_entry() {
    // SDND101: an oscillator thrown at a spring of 1e6 N/m at gap 0.
    let hit = as_matrices(
        Scene::oscillator(100.0, 0.0, 1e4)
            .with_initial(&[0.0], &[-1.0])
            .with_duration(0.4)
            .with_wall(Wall::lower("spring", 0.0).with_elasticity(1e6, 0.0)),
    );
    let run_ = exact(&hit, 400.0);
    let first = run_.trajectory.contacts()[0];
    let omega = f64::sqrt(1.01e6 / 100.0);
    assert!((first.end.unwrap() - PI / omega).abs() < 1e-14, "{first:?}");
    assert!((first.peak_force.unwrap() - 9950.37).abs() < 5e-3, "{first:?}");
    assert!((first.impulse - 198.020).abs() < 5e-4, "{first:?}");
    // SDND108A: a free fall onto a spring 2 m below.
    let fall = as_matrices(
        Scene::oscillator(1.0, 0.0, 0.0)
            .with_load(Load::constant(-10.0))
            .with_initial(&[0.0], &[-1.0])
            .with_duration(1.1),
    )
    .with_wall(Wall::lower("spring", -2.0).with_elasticity(100.0, 0.0));
    let run_ = exact(&fall, 11.0);
    let contact = run_.trajectory.contacts()[0];
    assert!((contact.start - 0.540_312_423_74).abs() < 1e-11, "{contact:?}");
    assert!((contact.end.unwrap() - 0.885_456_153_07).abs() < 1e-11, "{contact:?}");
    assert!((contact.peak_force.unwrap() - 74.807_41).abs() < 5e-6, "{contact:?}");
    let z = run_.trajectory.displacement();
    assert!((z[10] + 1.332_162_981_855).abs() < 1e-12 && (z[11] + 0.856_394_405_035).abs() < 1e-12, "{:?}", &z[10..]);
}

#[test]
fn elastic_and_rigid_walls_on_one_structure_are_what_refined_steps_tend_to() {
    let mut mixed = scene(chain(5, 1.0, 500.0, 2e-3)).with_load(Load::harmonic(20.0, 2.0, 0.0)).with_duration(1.0);
    mixed = mixed
        .with_wall(at(Wall::upper("stop", 0.02).with_restitution(0.6), Row::dof(0)))
        .with_wall(at(Wall::lower("pad", -0.02).with_elasticity(5e3, 10.0), Row::dof(1)))
        .with_wall(at(Wall::upper("between", 0.015).with_restitution(0.2), Row::new(vec![(3, 1.0), (4, -1.0)])))
        .with_wall(at(Wall::lower("soft", -0.01).with_elasticity(1e3, 0.0), Row::new(vec![(2, 0.5), (4, 0.5)])));
    let reference = exact(&mixed, 100.0);
    println!("{:?}", reference.counters);
    assert_judged(&reference);
    assert!(reference.trajectory.contacts().len() > 8);
    let error = |h: f64| {
        let mut options = Options::with_step(h);
        options.time = TimeOptions { sample: Some(0.01), ..options.time };
        let run = run(&mixed, &common::MOREAU_JEAN, &options).unwrap();
        let of = |i: usize| {
            let name = format!("q{i}");
            let (a, b) = (reference.trajectory.probe(&name).unwrap().0, run.trajectory.probe(&name).unwrap().0);
            a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / 0.02
        };
        (0..5).map(of).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(1e-4), error(1e-5));
    println!("{coarse:e} {fine:e}");
    // Order 1 through impacts.
    assert!(fine < 2e-3 && fine < 0.3 * coarse, "{coarse:e} {fine:e}");
}

/// Bodies that lie on each other and fall as one strike the floor as one: with e = ½ everywhere the
/// stack leaves the floor at half its speed, whatever its masses are. Roundings of the fall, which
/// part the bodies by 1e-18 m, decide nothing.
#[test]
fn a_stack_that_falls_strikes_the_floor_as_one_body() {
    const G: f64 = 9.81;
    let stacks: [&[f64]; 8] = [
        &[1.0, 1.5],
        &[1.0, 2.0],
        &[1.1, 1.3],
        &[0.7, 0.2],
        &[3.0, 1.0],
        &[1.0, 1.5, 0.4],
        &[0.3, 0.7, 1.1],
        &[2.0; 3],
    ];
    for masses in stacks {
        let (n, height, duration) = (masses.len(), 0.01, 0.05);
        let mut stack = scene(diagonal(masses, &vec![0.0; n], &vec![0.0; n])).with_duration(duration);
        for (i, mass) in masses.iter().enumerate() {
            let row = if i == 0 { Row::dof(0) } else { Row::new(vec![(i - 1, -1.0), (i, 1.0)]) };
            stack = stack.with_wall(at(Wall::lower(&format!("{i}"), 0.0).with_restitution(0.5), row));
            stack = stack.with_load(Load { at: Row::dof(i), ..Load::constant(-mass * G) });
        }
        let stack = stack.with_initial(&vec![height; n], &vec![0.0; n]);
        let (fall, speed) = ((2.0 * height / G).sqrt(), (2.0 * height * G).sqrt());
        let after = 0.5 * speed - G * (duration - fall);
        let run = run(&stack, &Scheme::Event, &Options::with_step(duration)).unwrap();
        // Rounding of a dozen operations.
        assert!(run.state.v.iter().all(|v| (v - after).abs() < 1e-13), "{masses:?}: {:?}, {after}", run.state.v);
        let impulse = run.trajectory.contacts().iter().filter(|c| c.wall == 0).map(|c| c.impulse).sum::<f64>();
        let expected = 1.5 * speed * masses.iter().sum::<f64>();
        assert!((impulse - expected).abs() < 1e-12 * expected, "{masses:?}: {impulse}, {expected}");
    }
}
