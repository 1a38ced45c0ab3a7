//! The studies on several degrees of freedom: compared with one degree of freedom, with sums by
//! hand, and with closed forms.
use crate::horizon::source;
use signorini::linear::Symmetric;
use signorini::study::accuracy::{Against, Target, reach};
use signorini::study::change::Change;
use signorini::study::compare::compare;
use signorini::study::horizon::{Growth, Source};
use signorini::study::stability::class::Class;
use signorini::study::stability::family::{MapRequest, SchemeFamily};
use signorini::study::stability::lasting::{Quality, lasting};
use signorini::study::stability::plan::{Grid, Plan};
use signorini::study::stability::scale::Scale;
use signorini::study::work_precision::{Effort, Steps, study};
use signorini::{
    Contact, Load, LoadKind, Method, Options, Probe, Row, Scene, Scheme, State, Statistics, Structure, System,
    TimeOptions, Wall, run,
};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// Two uncoupled oscillators in one scene; names of the second end in 2, and each has its probe.
fn beside(first: &Scene, second: &Scene) -> Scene {
    let parts = [&first.system, &second.system].map(|system| match system {
        System::Oscillator(o) => *o,
        _ => panic!("one degree of freedom each"),
    });
    let diagonal = |of: fn(&signorini::Oscillator) -> f64| Symmetric::diagonal(&parts.map(|o| of(&o)));
    let structure = Structure {
        mass: diagonal(|o| o.mass),
        damping: diagonal(|o| o.damping),
        stiffness: diagonal(|o| o.stiffness),
    };
    let mut scene = first.clone();
    scene.system = structure.into();
    let renamed = |w: &Wall| Wall { name: format!("{}2", w.name), ..w.clone() };
    scene.walls.extend(second.walls.iter().map(|w| renamed(w).at(Row::dof(1))));
    scene.loads.extend(second.loads.iter().map(|l| Load { at: Row::dof(1), kind: l.kind.clone() }));
    scene.probes = [0, 1].map(|i| Probe { name: format!("mass-{i}"), at: Row::dof(i) }).to_vec();
    let joined = |a: &[f64], b: &[f64]| [a, b].concat();
    scene.initial =
        State { q: joined(&first.initial.q, &second.initial.q), v: joined(&first.initial.v, &second.initial.v) };
    scene
}

/// A bar of unit length, modulus and density, its free end at a rigid wall with e = 0 and its other
/// end held: the closed form is contact for t in [1, 2] under the stress ½.
fn bar(elements: usize) -> Scene {
    let (n, size) = (elements, 1.0 / elements as f64);
    let masses: Vec<f64> = (0..n).map(|i| if i == 0 { 0.5 * size } else { size }).collect();
    let springs = (0..n).flat_map(|i| {
        let k = 1.0 / size;
        let mut entries = vec![(i, i, k)];
        if i + 1 < n {
            entries.extend([(i + 1, i + 1, k), (i + 1, i, -k)]);
        }
        entries
    });
    let structure = Structure {
        mass: Symmetric::diagonal(&masses),
        damping: Symmetric::zeros(n),
        stiffness: Symmetric::from_entries(n, springs),
    };
    let mut scene = Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::lower("wall", 0.0).with_restitution(0.0));
    scene.system = structure.into();
    scene.initial = State { q: (0..n).map(|i| 0.5 * (1.0 - i as f64 * size)).collect(), v: vec![0.0; n] };
    scene.probes = vec![Probe { name: "end".into(), at: Row::dof(0) }];
    scene.with_duration(3.0)
}

#[test]
fn two_oscillators_side_by_side_grow_as_the_more_sensitive_of_them() {
    // Alone at e = 1 the source scene grows 25-fold in a second, at e = 0.5 not at all.
    let (wild, tame) = (source(1.0, 1.0), source(0.5, 1.0));
    let exact = [&wild, &tame].map(|scene| Growth::of(scene).unwrap().until(1.0));
    let larger = exact[0].max(exact[1]);
    let found = Growth::by_runs(&beside(&wild, &tame), &Method::new(MOREAU), 1e-6).unwrap();
    assert!(matches!(found.source, Source::Runs(_)));
    let by_exact_runs = Growth::of(&beside(&wild, &tame)).unwrap();
    assert_eq!(by_exact_runs.source, Source::ExactRuns);
    // So small a change of exact runs is their derivative in two directions, which misses the worst
    // one: never above the growth, but for rows beside impacts.
    let exactly = by_exact_runs.until(1.0);
    assert!(exactly > 0.2 * larger && exactly < 1.1 * larger, "{exactly}, alone {exact:?}");
    let found = found.until(1.0);
    // An estimate from below: two directions of four miss the worst one by a factor of order 1. It
    // may exceed it a little, since the change is finite.
    assert!(found > 0.2 * larger && found < 1.5 * larger, "{found}, alone {exact:?}");
    // Two tame ones: little grows but the phase of impacts within steps, which is part of what
    // separates two runs of a scheme.
    let both_tame = Growth::by_runs(&beside(&tame, &tame), &Method::new(MOREAU), 1e-5).unwrap().until(1.0);
    assert!(both_tame < 5.0 && found > 3.0 * both_tame, "{both_tame} and {found}, alone {exact:?}");
}

#[test]
fn errors_are_those_of_the_worst_probe_and_a_method_that_cannot_go_is_a_row_with_the_reason() {
    // The first mass meets no wall and is at rest, so all of the error is the second's; a second
    // probe sees half of it.
    let still = Scene::oscillator(1.0, 0.2, 100.0).with_duration(0.5);
    let mut scene = beside(&still, &source(0.8, 0.5));
    scene.probes.push(Probe { name: "half".into(), at: Row::new(vec![(1, 0.5)]) });
    let time = TimeOptions { sample: Some(1e-3), ..TimeOptions::with_step(1e-3) };
    let refused = Method { scheme: MOREAU, backend: signorini::qp::Backend::Clamp };
    let comparison = compare(&scene, &[Method::new(MOREAU), refused], &time, &|_| {}).unwrap();
    let alone = compare(&source(0.8, 0.5), &[Method::new(MOREAU)], &time, &|_| {}).unwrap();
    let (found, expected) = (comparison.rows[0].error.unwrap(), alone.rows[0].error.unwrap());
    // Where the exact scheme does not go the reference is the same scheme at an eighth of the step:
    // its own error, of order 1, is an eighth of this one and a phase of impacts within steps that
    // makes it twice that at worst.
    assert!((found / expected - 1.0).abs() < 0.5, "{found} against {expected}");
    assert_eq!(comparison.rows.len(), 3);
    assert!(comparison.rows[1].outcome.is_err(), "a clamp is for one unknown");
    assert!(comparison.findings.iter().any(|f| f.contains("errors are against") || f.contains("perturbation")));
}

#[test]
fn a_change_counts_at_every_probe_and_is_measured_by_the_mass_that_each_wall_feels() {
    let still = Scene::oscillator(3.0, 0.0, 100.0).with_duration(0.5);
    let scene = beside(&still, &source(0.8, 0.5));
    let go = |h: f64| {
        let time = TimeOptions { sample: Some(1e-3), ..TimeOptions::with_step(h) };
        run(&scene, &MOREAU, &Options::new(time)).unwrap()
    };
    let (coarse, fine) = (go(1e-3), go(1e-4));
    let change = Change::of_runs(&scene, &coarse, &fine, 0.5);
    let [first, second] = [0, 1].map(|p| {
        let pairs = coarse.trajectory.displacements()[p].iter().zip(&fine.trajectory.displacements()[p]);
        pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    });
    assert!(first == 0.0 && second > 0.0);
    assert_eq!(change.displacement, second / 5e-3);
}

#[test]
fn statistics_take_the_mass_that_each_wall_feels() {
    // Masses of 2 and 3 kg: a wall on the first, and one between the two, which feels 1/(1/2 + 1/3)
    // = 1.2 kg.
    let structure = Structure {
        mass: Symmetric::diagonal(&[2.0, 3.0]),
        damping: Symmetric::zeros(2),
        stiffness: Symmetric::diagonal(&[1.0, 1.0]),
    };
    let mut scene = Scene::oscillator(1.0, 0.0, 1.0).with_wall(Wall::upper("ground", 1.0)).with_duration(10.0);
    let between = Row::new(vec![(0, 1.0), (1, -1.0)]);
    scene.walls.push(Wall::upper("between", 0.5).at(between));
    scene.system = structure.into();
    scene.initial = State { q: vec![0.0; 2], v: vec![0.0; 2] };
    let contact = |wall| Contact {
        wall,
        start: 1.0,
        end: Some(1.0),
        impulse: -1.0,
        peak_force: None,
        approach_speed: 2.0,
        departure_speed: Some(1.0),
    };
    let statistics = Statistics::new(&scene, &[contact(0), contact(1)], 0.0);
    let powers: Vec<_> = statistics.walls.iter().map(|w| (w.impact_power_w, w.arrived_less_departed_power_w)).collect();
    // ½ m (4, 4 − 1) over 10 s; a few roundings of numbers of order 1.
    for ((power, kept), mass) in powers.into_iter().zip([2.0, 1.2]) {
        assert!((power - 0.2 * mass).abs() < 1e-15 && (kept - 0.15 * mass).abs() < 1e-15, "{power} {kept} {mass}");
    }
}

#[test]
fn the_ripple_of_a_force_is_what_its_definition_says() {
    let steps = 1000;
    let contact = |force: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..steps).map(|i| if (100..900).contains(&i) { force(i) } else { 0.0 }).collect()
    };
    let ripple = |force: &dyn Fn(usize) -> f64| lasting(&contact(force), 1e-3, 1e-2).unwrap().ripple;
    assert!(ripple(&|_| 0.5) < 1e-14);
    // 1 + a sin over whole periods of 20 steps within the inner 640: a/√2.
    let wave = |i: usize| 1.0 + 0.3 * (std::f64::consts::TAU * i as f64 / 20.0).sin();
    assert!((ripple(&wave) - 0.3 / 2f64.sqrt()).abs() < 1e-12);
    // On and off every other step: 1, and one contact, not four hundred.
    let found = lasting(&contact(&|i| if i % 2 == 0 { 1.0 } else { 0.0 }), 1e-3, 1e-2).unwrap();
    // One more of the 639 steps may be off than on.
    assert!((found.ripple - 1.0).abs() < 2.0 / 639.0 && (found.end - found.start - 0.799).abs() < 1e-12, "{found:?}");
    // A rise and a fall within the first and the last tenth do not count.
    assert!(ripple(&|i| if (150..850).contains(&i) { 1.0 } else { 0.2 }) < 1e-14);
    // Single pushes are no lasting contact; of two contacts far apart the stronger is reported.
    assert_eq!(lasting(&[0.0, 1.0, 0.0], 1e-3, 1e-2), None);
    let two: Vec<f64> = (0..steps).map(|i| if i % 500 > 400 { 1.0 + (i / 500) as f64 } else { 0.0 }).collect();
    assert!((lasting(&two, 1e-3, 1e-2).unwrap().start - 0.901).abs() < 1e-12);
}

#[test]
fn a_bar_on_a_wall_shows_what_each_scheme_does_to_energy_and_to_the_force() {
    let scene = bar(50);
    let time = TimeOptions::with_step(2e-3);
    let alpha = Scheme::GeneralizedAlpha { rho: 0.8 };
    let schemes = [MOREAU, Scheme::PaoliSchatzman, Scheme::ImplicitEuler, Scheme::Newmark, alpha];
    let scale = Scale::of(&scene, None);
    let quality = Quality::of(&scene, &schemes, &time, &scale).unwrap();
    // ½ E A ε² L = 1/8 J at the start, by linear elements exactly.
    assert!((quality.energy - 0.125).abs() < 1e-9, "{}", quality.energy);
    let at = |scheme: Scheme, multiple: f64| {
        let near = |line: &&signorini::study::stability::lasting::LastingForce| {
            line.scheme == scheme && (line.step / (multiple * 2e-3) - 1.0).abs() < 0.1
        };
        quality.lines.iter().find(near).unwrap().outcome.clone().unwrap()
    };
    for scheme in schemes {
        let seen = at(scheme, 1.0);
        let (wall, contact) = seen.contact.unwrap();
        assert_eq!(wall, "wall");
        // Contact in [1, 2] with the impulse ½: to the time a wave takes through four elements,
        // 4/50 s at either end. Newmark's wall gives energy, and its contact ends early.
        let late = (contact.end - 2.0).abs();
        assert!(
            (contact.start - 1.0).abs() < 0.08 && (late < 0.08 || scheme == Scheme::Newmark),
            "{scheme}: {contact:?}"
        );
        assert!((contact.impulse - 0.5).abs() < 0.5 * 0.08, "{scheme}: {contact:?}");
        // No scheme rings more than newmark, whose wall gives energy.
        assert!(contact.ripple <= at(Scheme::Newmark, 1.0).contact.unwrap().1.ripple, "{scheme}: {contact:?}");
    }
    // What stops at the wall with e = 0 is the end node, a hundredth of the mass: ½ (1/100) ½² =
    // 1e-2 of 1/8 J; touching again takes some more.
    for scheme in [MOREAU, Scheme::PaoliSchatzman] {
        let seen = at(scheme, 1.0);
        assert!(seen.largest < 1.0 + 1e-9 && seen.lost_at_walls > 0.0 && seen.lost_at_walls < 0.03, "{seen:?}");
        assert!(seen.unexplained.abs() < 1e-9, "{seen:?}");
    }
    // The exact stress is constant: this mesh of lumped masses rings by a hundredth, newmark by
    // more than the force itself.
    let ripple = |scheme: Scheme| at(scheme, 1.0).contact.unwrap().1.ripple;
    assert!(ripple(MOREAU) < 0.05 && ripple(alpha) < 0.05 && ripple(Scheme::Newmark) > 1.0);
    // Implicit Euler damps the bar, less at a finer step.
    let [coarse, fine] = [4.0, 0.25].map(|m| at(Scheme::ImplicitEuler, m));
    assert!(coarse.last < fine.last && fine.last < 0.95, "{coarse:?} {fine:?}");
    // Newmark's wall makes energy.
    let newmark = at(Scheme::Newmark, 1.0);
    assert!(newmark.lost_at_walls < 0.0 && newmark.largest > 1.1, "{newmark:?}");
}

#[test]
fn cells_of_two_masses_have_the_classes_that_each_mass_alone_has() {
    let scene = beside(&source(0.8, 2.0), &source(0.8, 2.0));
    let families = [MOREAU, Scheme::Newmark].map(SchemeFamily::Constrained);
    let grid = Grid { finest: 1e-3, coarsest: 0.9, per_decade: 2.0, families: families.to_vec(), ..Grid::of(&scene) };
    let maps = Plan::new(MapRequest { scene: &scene, laws: &[] }, &grid).unwrap().run(&|_| {}).unwrap();
    let own = |family: SchemeFamily| maps.map(family).find(|row| (row.subject.value - 0.8).abs() < 1e-9).unwrap();
    for cell in own(families[0]).cells.iter().filter(|c| c.step < 5e-3) {
        assert_eq!(cell.class, Class::Stable, "{cell:?}");
    }
    for cell in own(families[1]).cells.iter().filter(|c| c.step < 5e-3) {
        assert!(matches!(cell.class, Class::Gaining | Class::Diverged), "{cell:?}");
    }
}

#[test]
fn a_chart_of_two_masses_shows_the_order_of_each_scheme_between_impacts() {
    let mut scene = beside(&source(0.8, 0.3), &source(0.8, 0.3));
    scene.walls.clear();
    // A spring between the two, so that both move with two frequencies.
    if let System::Structure(s) = &mut scene.system {
        s.stiffness = Symmetric::from_entries(2, [(0, 0, 400.0), (1, 1, 300.0), (1, 0, -200.0)]);
    }
    scene.loads.truncate(1);
    let expected = [(MOREAU, 2.0), (Scheme::PaoliSchatzman, 2.0), (Scheme::ImplicitEuler, 1.0)];
    let methods = expected.map(|e| Method::new(e.0));
    let steps = Steps { coarsest: Some(2e-3), finest: Some(1e-4), levels: Some(5) };
    let chart = study(&scene, &methods, &Effort { steps, repeats: 1, most_seconds: 60.0 }, &|_| {}).unwrap();
    for ((_, order), series) in expected.iter().zip(&chart.series) {
        let found = series.order(chart.known(&series.method.scheme)).unwrap();
        // Smooth motion: slopes are within 0.1 of the integer; the reference is a run of
        // moreau-jean, four times finer than the finest.
        assert!((found - order).abs() < 0.15, "{}: order {found}", series.method);
    }
    scene.probes.clear();
    assert!(study(&scene, &methods, &Effort::default(), &|_| {}).is_err(), "nothing to compare");
}

#[test]
fn an_error_is_kept_by_halving_and_the_result_is_within_it_of_a_much_finer_run() {
    let scene = beside(&source(0.5, 0.5), &source(0.8, 0.5));
    let time = TimeOptions { sample: Some(1e-3), ..TimeOptions::with_step(1e-3) };
    let target = Target { method: Some(Method::new(MOREAU)), against: Against::Refinements, ..Target::new(1e-2, time) };
    let outcome = reach(&scene, &target, &mut |_| {}).unwrap();
    assert!(outcome.shortfall.is_none(), "{:?}", outcome.shortfall);
    let step = outcome.accuracy.step_s.unwrap() / 16.0;
    let rows = outcome.run.grid.end / outcome.run.grid.rows as f64;
    let time = TimeOptions { sample: Some(rows), ..TimeOptions::with_step(step) };
    let fine = run(&scene, &MOREAU, &Options::new(time)).unwrap();
    let change = Change::of_runs(&scene, &outcome.run, &fine, scene.duration);
    assert!(change.displacement < 1e-2, "{}", change.displacement);
}

#[test]
fn a_load_and_a_probe_elsewhere_than_at_the_first_mass_are_where_they_say() {
    // Only the second mass is loaded: the first probe sees nothing, the second what the oscillator
    // alone sees.
    let mut alone = source(0.8, 0.3);
    let scene = beside(&Scene::oscillator(1.0, 0.2, 100.0).with_duration(0.3), &alone);
    assert!(matches!(scene.loads[0].kind, LoadKind::Harmonic { .. }));
    alone.probes[0].name = "mass-1".into();
    let options = Options::with_step(1e-3);
    let (two, one) = (run(&scene, &MOREAU, &options).unwrap(), run(&alone, &MOREAU, &options).unwrap());
    assert!(two.trajectory.displacement().iter().all(|u| *u == 0.0));
    for (x, y) in two.trajectory.displacements()[1].iter().zip(one.trajectory.displacement()) {
        // Some roundings of the gap, in another order.
        assert!((x - y).abs() < 1e-12 * 5e-3, "{x} {y}");
    }
}
