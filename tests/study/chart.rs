//! Accuracy against speed: orders, front, floors and hard scenes from the chart's own data, and the
//! command itself. Errors, files and counters only: no time is asserted.

use crate::horizon::source;
use signorini::scheme::SchemeKind;
use signorini::study::work_precision::{
    Effort, Measured, MethodPoints, Quantity, Steps, WorkPrecision, every_method, study,
};
use signorini::{Integrator, Load, Method, PenaltyLaw, Scene, Scheme, Wall};
use std::process::{Command, Output};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

fn penalty(law: PenaltyLaw, integrator: Integrator) -> Scheme {
    Scheme::Penalty { law, integrator }
}

/// Charts `schemes` on `scene` over `levels` steps from `coarsest` to `finest` (s).
fn chart(scene: &Scene, schemes: &[Scheme], (coarsest, finest): (f64, f64), levels: u32) -> WorkPrecision {
    let methods: Vec<Method> = schemes.iter().map(|&s| Method::new(s)).collect();
    let steps = Steps { coarsest: Some(coarsest), finest: Some(finest), levels: Some(levels) };
    study(scene, &methods, &Effort { steps, repeats: 1, most_seconds: 60.0 }, &|_| {}).unwrap()
}

fn order(chart: &WorkPrecision, scheme: Scheme) -> f64 {
    let series = series(chart, scheme);
    series.order(chart.known(&scheme)).unwrap_or_else(|| panic!("{scheme}: no order from {series:?}"))
}

fn series(chart: &WorkPrecision, scheme: Scheme) -> &MethodPoints {
    chart.series.iter().find(|s| s.method.scheme == scheme).unwrap()
}

fn finest(chart: &WorkPrecision, scheme: Scheme) -> &Measured {
    series(chart, scheme).measured().last().unwrap().1
}

fn assert_orders(chart: &WorkPrecision, expected: &[(Scheme, f64)], tolerance: f64) {
    for &(scheme, order_expected) in expected {
        let found = order(chart, scheme);
        assert!((found - order_expected).abs() <= tolerance, "{scheme}: order {found}, expected {order_expected}");
    }
}

#[test]
fn free_motion_shows_the_order_of_every_scheme() {
    let expected = [(MOREAU, 2.0), (Scheme::PaoliSchatzman, 2.0), (Scheme::ImplicitEuler, 1.0), (Scheme::Newmark, 2.0)];
    let scene = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(3.0, 5.0, 0.0));
    let chart = chart(&scene, &expected.map(|e| e.0), (2e-3, 1e-4), 5);
    // Smooth motion: slopes are within 0.03 of the integer.
    assert_orders(&chart, &expected, 0.05);
}

#[test]
fn impacts_bring_every_stepping_scheme_to_order_one() {
    let expected = [(MOREAU, 1.0), (Scheme::PaoliSchatzman, 1.0)];
    let chart = chart(&source(1.0, 0.6), &expected.map(|e| e.0), (1e-3, 3e-6), 9);
    // The phase of each impact within its step is random: over nine steps the slope stays within
    // 0.2.
    assert_orders(&chart, &expected, 0.3);
    for scheme in [MOREAU, Scheme::PaoliSchatzman] {
        // The other errors fall with it: impulse, contact times, and the velocity in the measure of
        // its graph.
        let e = &finest(&chart, scheme).errors;
        assert_eq!((e.missing, e.spurious), (0, 0), "{scheme}");
        assert!(e.velocity < 2e-3, "{scheme}: {}", e.velocity);
        assert!(e.worst_impulse().unwrap() < 1e-3, "{scheme}: {:?}", e.impulse);
        assert!(e.contact_time.unwrap() < 1e-3, "{scheme}: {:?}", e.contact_time);
    }
}

#[test]
fn penalties_show_their_order_against_their_own_springs() {
    let laws = [PenaltyLaw::Quartic { epsilon: 1e-6 }, PenaltyLaw::Quartic { epsilon: 1e-9 }];
    let all = laws.map(|law| Integrator::ALL.map(|integrator| penalty(law, integrator)));
    let chart = chart(&source(1.0, 0.2), &all.concat(), (4e-4, 2.5e-5), 5);
    for scheme in all.concat() {
        let Scheme::Penalty { integrator, .. } = scheme else { unreachable!() };
        let expected = if integrator == Integrator::ImplicitEuler { 1.0 } else { 2.0 };
        let found = order(&chart, scheme);
        // Entering and leaving the wall within a step adds an error of the same order and a random
        // factor.
        assert!((found - expected).abs() <= 0.3, "{scheme}: order {found}");
    }
}

#[test]
fn a_smaller_step_takes_a_penalty_to_the_floor_of_its_springs_and_no_lower() {
    let floors = [(1e-12, 0.063), (1e-9, 0.59)];
    let schemes = floors.map(|(epsilon, _)| penalty(PenaltyLaw::Quartic { epsilon }, Integrator::DiscreteGradient));
    let chart = chart(&source(1.0, 1.0), &schemes, (1e-4, 5e-5), 2);
    for ((_, expected), scheme) in floors.into_iter().zip(schemes) {
        let floor = chart.floor(&scheme).unwrap().errors.as_ref().unwrap().displacement;
        // 6 % and 59 % of the gap, by independent solvers.
        assert!((floor - expected).abs() < 0.01, "{scheme}: {floor}");
        let found = finest(&chart, scheme);
        assert!((found.errors.displacement - floor).abs() < 0.03 * floor);
        assert!(found.own.as_ref().unwrap().displacement < 0.05 * floor);
    }
}

#[test]
fn the_front_on_the_source_scene_ends_at_the_exact_scheme_with_an_error_of_rounding() {
    let schemes = [Scheme::Event, MOREAU, Scheme::PaoliSchatzman, Scheme::ImplicitEuler, Scheme::Newmark];
    let chart = chart(&source(1.0, 1.0), &schemes, (1e-3, 1e-5), 4);
    assert_eq!(chart.horizon.end, 1.0);
    let exact = finest(&chart, Scheme::Event);
    // Rounding is 2e-16 and the scene makes it grow by 27: the estimate is 2e-14, never 0.
    assert!((1e-16..=1e-11).contains(&exact.errors.displacement), "{:e}", exact.errors.displacement);
    let others = chart.series.iter().filter(|s| s.method.scheme != Scheme::Event);
    let least =
        others.flat_map(MethodPoints::measured).map(|(_, m)| m.errors.displacement).fold(f64::INFINITY, f64::min);
    assert!(least > 1e4 * exact.errors.displacement);
    for tolerance in [1e-6, 1e-9] {
        assert!(series(&chart, Scheme::Event).cheapest(Quantity::Displacement, tolerance).is_some());
        assert!(series(&chart, MOREAU).cheapest(Quantity::Displacement, tolerance).is_none());
    }
    assert_eq!(exact.counters.events, 10);
    assert!(exact.counters.flow_evaluations > 0 && finest(&chart, MOREAU).counters.qp_solves > 0);
}

#[test]
fn each_kind_of_method_has_its_cheapest_and_none_stands_for_another() {
    let soft = penalty(PenaltyLaw::Quartic { epsilon: 1e-9 }, Integrator::DiscreteGradient);
    let schemes = [Scheme::Event, MOREAU, Scheme::PaoliSchatzman, soft];
    let chart = chart(&source(1.0, 1.0), &schemes, (1e-3, 1e-5), 4);
    let kinds = SchemeKind::ALL.map(|kind| chart.cheapest(kind, Quantity::Displacement, 1e-2));
    assert_eq!(kinds[0].unwrap().0.method.scheme, Scheme::Event);
    let (series, step, measured) = kinds[1].unwrap();
    assert!([MOREAU, Scheme::PaoliSchatzman].contains(&series.method.scheme) && step.unwrap() < 1e-3);
    assert!(measured.errors.displacement <= 1e-2);
    // Springs of this softness stay 59 % of the gap away from rigid walls, whatever the step.
    assert!(kinds[2].is_none());
    // Impulses and contact times are errors of their own.
    for quantity in [Quantity::Impulse, Quantity::ContactTime] {
        let (_, _, measured) = chart.cheapest(SchemeKind::Qp, quantity, 1e-2).unwrap();
        assert!(quantity.of(&measured.errors).unwrap() <= 1e-2);
        assert!(chart.cheapest(SchemeKind::Qp, quantity, 1e-9).is_none());
    }
}

#[test]
fn a_zeno_point_is_handled_by_every_scheme_that_knows_restitution() {
    let schemes = [Scheme::Event, MOREAU, Scheme::PaoliSchatzman];
    let scene = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(2.0);
    // Rest is reached at √(2/g)·3 = 1.3546 s, and the weight is carried from then on.
    let chart = chart(&scene, &schemes, (1e-2, 2e-5), 10);
    assert!(finest(&chart, Scheme::Event).errors.displacement < 1e-12);
    for scheme in [MOREAU, Scheme::PaoliSchatzman] {
        let e = &finest(&chart, scheme).errors;
        assert!(e.displacement < 1e-3, "{scheme}: {}", e.displacement);
        // All of the momentum: the total impulse is m g T = 19.62 N s for any motion that comes to
        // rest.
        assert!(e.worst_impulse().unwrap() < 1e-4, "{scheme}: {:?}", e.impulse);
        assert!((order(&chart, scheme) - 1.0).abs() < 0.3, "{scheme}");
    }
}

#[test]
fn lasting_contact_is_handled_by_every_scheme_that_claims_it() {
    let schemes = [Scheme::Event, MOREAU, Scheme::PaoliSchatzman, Scheme::ImplicitEuler];
    let chart = chart(&source(0.0, 1.0), &schemes, (1e-3, 4e-6), 8);
    assert!(finest(&chart, Scheme::Event).errors.displacement < 1e-12);
    for scheme in schemes.into_iter().skip(1) {
        let e = &finest(&chart, scheme).errors;
        assert_eq!(e.missing, 0, "{scheme}");
        assert!(e.displacement < 1e-3, "{scheme}: {}", e.displacement);
        assert!(e.velocity < 2e-3, "{scheme}: {}", e.velocity);
        assert!(order(&chart, scheme) > 0.8, "{scheme}: {}", order(&chart, scheme));
    }
}

#[test]
fn the_comparison_ends_before_the_motion_is_too_sensitive() {
    let chart = chart(&source(1.0, 5.0), &[Scheme::Event, MOREAU], (1e-3, 5e-4), 2);
    assert!((1.0..3.0).contains(&chart.horizon.end), "{:?}", chart.horizon);
    assert!(chart.horizon.growth <= 100.0 && chart.horizon.growth_of_all > 1e3);
}

#[test]
fn every_scheme_and_integrator_is_charted_by_default() {
    let methods = every_method(&[PenaltyLaw::Quartic { epsilon: 1e-9 }, PenaltyLaw::Quartic { epsilon: 1e-6 }]);
    // The penalty is one entry of the schemes.
    assert_eq!(methods.len(), Scheme::ALL.len() - 1 + 2 * Integrator::ALL.len());
}

fn signorini(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_signorini")).args(arguments).output().unwrap()
}

#[test]
fn the_command_writes_table_and_picture_and_lays_other_programs_over() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let peers = folder.path().join("peers.csv");
    std::fs::write(&peers, "program,setting,method,error_over_gap,seconds\nOther,x,RK,1e-7,0.5\nOther,y,RK,,\n")
        .unwrap();
    let explicit = "penalty:epsilon=1e-12,integrator=central-difference";
    let schemes = format!("event;moreau-jean;{explicit}");
    let output = signorini(&[
        "--json",
        "chart",
        "rigid-walls-sine",
        "--end",
        "0.5",
        "--steps",
        "1e-2:1e-3",
        "--levels",
        "4",
        "--repeats",
        "1",
        "--schemes",
        &schemes,
        "--with",
        peers.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rows = table["cheapest"].as_array().unwrap();
    assert_eq!(table["series"].as_array().unwrap().len(), 3);
    // Three errors, three kinds and eight tolerances; other programs tell the displacement's error
    // only.
    assert_eq!(rows.len(), 3 * 3 * 8 + 8);
    let find = |error: &str, kind: &str, tolerance: f64| {
        let this = |r: &&serde_json::Value| {
            r["error"] == error && r["kind"] == kind && r["tolerance"].as_f64() == Some(tolerance)
        };
        rows.iter().find(this).unwrap_or_else(|| panic!("{error}, {kind}, {tolerance}: {rows:?}"))
    };
    for error in ["displacement", "impulse", "contact time"] {
        assert_eq!(find(error, "exact", 1e-8)["method"], "event");
        let missed = find(error, "QP", 1e-8);
        assert!(missed["method"].is_null() && missed["missed"].as_str().unwrap().starts_with("stays above "));
    }
    assert_eq!(find("impulse", "QP", 0.1)["method"], "moreau-jean");
    assert!(find("impulse", "QP", 0.1)["step_s"].as_f64().unwrap() <= 1e-2);
    assert_eq!(find("displacement", "other program", 1e-6)["method"], "Other RK");
    assert!(find("displacement", "other program", 1e-8)["method"].is_null());
    let csv = std::fs::read_to_string(out.join("work-precision.csv")).unwrap();
    // A run that fails is a row with the reason in it.
    assert!(csv.lines().any(|l| l.contains(explicit) && l.contains("failed: ") && l.contains("diverged")), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 1 + 2 * 4);
    // However many walls there are, the columns are the same; each wall has its rows beside it.
    let header = csv.lines().next().unwrap();
    assert!(header.contains(",impulse_error_of_the_worst_wall,") && !header.contains("upper"), "{header}");
    let cells = |text: &str| {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let row = |record: csv::StringRecord| -> std::collections::HashMap<String, String> {
            header.iter().map(str::to_owned).zip(record.iter().map(str::to_owned)).collect()
        };
        reader.records().map(|record| row(record.unwrap())).collect::<Vec<_>>()
    };
    let by_wall = cells(&std::fs::read_to_string(out.join("work-precision-walls.csv")).unwrap());
    let ran: Vec<_> = cells(&csv).into_iter().filter(|row| !row["seconds"].is_empty()).collect();
    assert!(!ran.is_empty() && by_wall.len() == 2 * ran.len(), "{by_wall:?}");
    for point in &ran {
        let walls = by_wall.iter().filter(|w| w["method"] == point["method"] && w["step_s"] == point["step_s"]);
        let worst = walls.map(|w| w["impulse_error"].parse::<f64>().unwrap()).fold(0.0, f64::max);
        assert_eq!(point["impulse_error_of_the_worst_wall"].parse::<f64>().unwrap(), worst, "{point:?}");
    }
    let svg = std::fs::read_to_string(out.join("work-precision.svg")).unwrap();
    let texts = ["Other RK", "Pareto front", "moreau-jean", "ε = 1e-12", "Displacement:", "Impulse:", "Contact times:"];
    for text in texts {
        assert!(svg.contains(text), "{text}");
    }
    // The error of the exact scheme, some 1e-15, is noted at the edge; the axis ends at 1e-9 at the
    // latest.
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts = document.descendants().filter(|n| n.has_tag_name("text"));
    let texts: Vec<String> = texts.map(|n| n.descendants().filter_map(|d| d.text()).collect()).collect();
    assert!(texts.iter().any(|t| t.starts_with("event ") && t.contains("e-1")), "{texts:?}");
    assert!(texts.iter().all(|t| !["10−10", "10−12", "10−14"].contains(&t.as_str())), "{texts:?}");
    // All integrators of a penalty are in a figure of their own.
    let penalties = std::fs::read_to_string(out.join("work-precision-penalties.svg")).unwrap();
    assert!(penalties.contains("against their own springs"));
}

#[test]
fn a_wrong_request_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let peers = folder.path().join("peers.csv");
    std::fs::write(&peers, "program,method,error_over_gap,seconds\nOther,RK,-1,0.5\n").unwrap();
    let cases: [(&[&str], &str); 5] = [
        (&["--steps", "1e-2"], "COARSE:FINE"),
        (&["--steps", "1e-4:1e-2"], "finest step"),
        (&["--steps", "nan:1e-2"], "coarsest step"),
        (&["--with", peers.to_str().unwrap()], "line 2: error_over_gap"),
        (&["--longest", "0"], "--longest"),
    ];
    for (arguments, expected) in cases {
        let all = [&["chart", "rigid-walls-sine", "--end", "0.1"], arguments].concat();
        let output = signorini(&all);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
}
