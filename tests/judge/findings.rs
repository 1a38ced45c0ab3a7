//! The judge's findings: one for every kind of broken promise, and none for a run that kept its
//! scheme's contract.

use crate::common::{self, MOREAU_JEAN, source, spring};
use crate::random_structures::{Draws, random_scene};
use crate::shown::Shown;
use signorini::residual::Judge;
use signorini::{
    Bound, Contract, Error, Finding, Integrator, Load, Oscillator, Refuted, Scene, Scheme, Step, Stepper, System, Wall,
    WallLaw,
};

const STEP: f64 = 1e-3;

/// What the judge finds in `steps` steps, each passed through `alter` before it sees them.
fn judged(
    scene: &Scene,
    scheme: &Scheme,
    h: f64,
    steps: u32,
    mut alter: impl FnMut(&Step<'_>, &mut Shown),
) -> Result<Vec<Finding>, Error> {
    let mut stepper = Stepper::new(scene, scheme, h)?;
    let state = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &state.q, &state.v);
    for _ in 0..steps {
        let step = stepper.step()?;
        let mut shown = Shown::of(&step);
        alter(&step, &mut shown);
        judge.observe(&shown.in_place(&step));
    }
    Ok(judge.findings())
}

/// The kinds of findings, each once.
fn kinds(findings: &[Finding]) -> Vec<Refuted> {
    let mut kinds = Vec::new();
    for finding in findings {
        if !kinds.contains(&finding.refuted) {
            kinds.push(finding.refuted);
        }
    }
    kinds
}

/// The first impact of the source scene is at 0.076102 s, on the upper wall: in its 77th step.
const FIRST_IMPACT: u64 = 76;

#[test]
fn each_kind_of_broken_promise_is_found_with_its_place() {
    let found = |scheme: &Scheme, alter: &dyn Fn(&Step<'_>, &mut Shown)| {
        judged(&source(0.8, 0.8), scheme, STEP, 300, alter).expect("a run")
    };
    let scene_with = |scene: &Scene, scheme: &Scheme, alter: &dyn Fn(&Step<'_>, &mut Shown)| {
        judged(scene, scheme, STEP, 300, alter).expect("a run")
    };
    for scheme in [MOREAU_JEAN, Scheme::PaoliSchatzman, Scheme::ImplicitEuler, Scheme::GeneralizedAlpha { rho: 0.8 }] {
        assert_eq!(found(&scheme, &|_, _| {}), [], "{scheme}");
        let pulls = found(&scheme, &|_, a| a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p = -*p));
        assert!(kinds(&pulls).contains(&Refuted::Tension), "{scheme}: {pulls:?}");
        // A force that is one part in a thousand too large: only the momentum balance shows it.
        let more = found(&scheme, &|_, a| a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p *= 1.001));
        assert!(kinds(&more).contains(&Refuted::MomentumBalance), "{scheme}: {more:?}");
        let finding = more.iter().find(|f| f.refuted == Refuted::MomentumBalance).expect("just seen");
        assert!(finding.residual > 1e-4 && finding.tolerance == 1e-6 && finding.wall.is_none(), "{finding:?}");
        // A force in mid-air.
        let airy = found(&scheme, &|step, a| {
            if step.index == 30 {
                (a.impulse[0], a.force[0]) = (-1e-3, -1.0);
            }
        });
        let wall = airy.iter().find(|f| f.wall.as_deref() == Some("upper")).unwrap_or_else(|| panic!("{airy:?}"));
        assert!((wall.time_s - 0.031).abs() < 1e-12, "{scheme}: {wall:?}");
        assert!(matches!(wall.refuted, Refuted::Complementarity | Refuted::WallLaw), "{scheme}: {wall:?}");
    }
    // Behind the wall although the scheme promises gaps ≥ 0; the displacement does not fit the
    // velocities either.
    let behind = found(&Scheme::ImplicitEuler, &|step, a| {
        if step.index == FIRST_IMPACT {
            a.q[0] = 5.5e-3;
        }
    });
    let deep = behind.iter().find(|f| f.refuted == Refuted::Penetration).unwrap_or_else(|| panic!("{behind:?}"));
    assert!((deep.residual - 0.1).abs() < 1e-9 && (deep.time_s - 0.077).abs() < 1e-12, "{deep:?}");
    assert_eq!(deep.wall.as_deref(), Some("upper"));
    assert!(kinds(&behind).contains(&Refuted::Kinematics), "{behind:?}");
    // moreau-jean promises the rebound, not the depth: a run that lands 0.9 mm deep has no finding;
    // one with another rebound has.
    let rebound = found(&MOREAU_JEAN, &|step, a| {
        if step.index == FIRST_IMPACT {
            let change = 0.1 * step.velocity_before[0];
            a.v[0] += change;
            a.after[0] += change;
            a.impulse[0] += change;
        }
    });
    assert!(kinds(&rebound).contains(&Refuted::Complementarity), "{rebound:?}");
    // Energy from nowhere, where the scheme conserves it: the speed of a free body grows by one
    // part in a thousand.
    let free = Scene::oscillator(1.0, 0.0, 0.0).with_initial(&[0.0], &[0.1]);
    let made = |step: &Step<'_>, a: &mut Shown| {
        if step.index >= 40 {
            a.v[0] *= 1.001;
            a.after[0] *= 1.001;
        }
    };
    assert!(kinds(&scene_with(&free, &MOREAU_JEAN, &made)).contains(&Refuted::Energy));
    assert!(!kinds(&scene_with(&free, &Scheme::Newmark, &made)).contains(&Refuted::Energy));
    // A spring that gives back one part in a thousand less than its law.
    let weak = scene_with(&common::elastic(0.0, 1.0), &MOREAU_JEAN, &|_, a| {
        a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p *= 0.999);
    });
    let law = weak.iter().find(|f| f.refuted == Refuted::WallLaw).unwrap_or_else(|| panic!("{weak:?}"));
    assert!(law.wall.as_deref() == Some("upper") && law.residual > 1e-4, "{law:?}");
}

#[test]
fn a_finding_says_what_where_and_why_in_words() {
    let behind = judged(&source(0.8, 0.8), &Scheme::ImplicitEuler, STEP, 300, |step, a| {
        if step.index == FIRST_IMPACT {
            a.q[0] = 5.5e-3;
        }
    });
    let behind = behind.expect("a run");
    let text = behind.iter().map(Finding::to_string).collect::<Vec<_>>().join("\n");
    let expected =
        "the body stands behind a rigid wall, in gap scales: 1.0e-1 at wall \"upper\", t = 0.077000 s; allowed 1e-6 (";
    assert!(text.contains(expected), "{text}");
}

/// Every scheme of the crate, newmark included: what a scheme does not promise gives no finding.
fn schemes(stiffness: f64) -> Vec<Scheme> {
    let mut all = common::CONSTRAINED.to_vec();
    all.extend([0.0, 1.0].map(|rho| Scheme::GeneralizedAlpha { rho }));
    all.extend(Integrator::ALL.map(|i| spring(stiffness, i)));
    all
}

/// True for the scheme that has a stability limit.
fn explicit(scheme: &Scheme) -> bool {
    matches!(scheme, Scheme::Penalty { integrator: Integrator::CentralDifference, .. })
}

fn overflows(findings: &[Finding]) -> bool {
    findings.iter().all(|found| found.refuted == Refuted::NotFinite)
}

#[test]
fn no_run_is_accused_at_scales_far_from_one() {
    // Mass and stiffness over many decades, with loads, gaps and speeds that belong to them: and
    // with those that do not.
    let mut judged_runs = 0;
    for mass in [1e-6, 1.0, 1e6] {
        for stiffness in [1e-6_f64, 1e2, 1e12] {
            for gap in [1e-9, 5e-3, 10.0] {
                for e in [0.0, 0.7, 1.0] {
                    let omega = (stiffness / mass).sqrt();
                    let scene = Scene::oscillator(mass, 0.02 * mass * omega, stiffness)
                        .with_wall(Wall::upper("upper", gap).with_restitution(e))
                        .with_wall(Wall::lower("lower", -0.5 * gap).with_restitution(e))
                        .with_load(Load::harmonic(3.0 * stiffness * gap, 0.3 * omega, 0.2))
                        .with_load(Load::constant(1.5 * stiffness * gap))
                        .with_duration(200.0 / omega);
                    for periods in [1e-6, 1e-3, 0.05] {
                        let h = periods * std::f64::consts::TAU / omega;
                        for scheme in schemes(100.0 * stiffness) {
                            let what = format!("{scheme}, {mass} kg, {stiffness} N/m, {gap} m, e = {e}, {periods}");
                            match judged(&scene, &scheme, h, 300, |_, _| {}) {
                                // Beyond its stability limit the energy overflows.
                                Ok(findings) if explicit(&scheme) && overflows(&findings) => continue,
                                Ok(findings) => assert_eq!(findings, [], "{what}"),
                                Err(Error::NotFinite { .. } | Error::Newton { .. }) => continue,
                                Err(error) => panic!("{what}: {error}"),
                            }
                            judged_runs += 1;
                        }
                    }
                }
            }
        }
    }
    assert!(judged_runs > 2500, "{judged_runs}");
}

#[test]
fn no_run_of_a_random_structure_is_accused_at_any_scale() {
    for seed in 1000..1060 {
        let mut draws = Draws::new(seed);
        let mut scene = random_scene(&mut draws);
        // A scene in other units of mass (and force): everything that has kilograms in it is
        // scaled.
        let unit = 10_f64.powf(draws.between(-6.0, 6.0));
        if let System::Structure(s) = &mut scene.system {
            let s = &mut **s;
            for matrix in [&mut s.mass, &mut s.damping, &mut s.stiffness] {
                *matrix = signorini::linear::Symmetric::sum(&[(unit, &*matrix)]);
            }
        }
        for wall in &mut scene.walls {
            if let WallLaw::Elastic { stiffness, damping } = &mut wall.law {
                (*stiffness, *damping) = (*stiffness * unit, *damping * unit);
            }
        }
        scene.loads = scene.loads.into_iter().map(|load| scaled(load, unit)).collect();
        let mut schemes = schemes(3e4 * unit);
        if !scene.walls.iter().any(|wall| wall.law.is_rigid()) {
            schemes.retain(|s| !matches!(s, Scheme::Penalty { .. }));
        }
        for scheme in schemes {
            let what = format!("seed {seed}, unit {unit:e}, {scheme}");
            match judged(&scene, &scheme, STEP, 250, |_, _| {}) {
                Ok(findings) => assert_eq!(findings, [], "{what}"),
                // The bounds of walls with unequal e on rows that depend on one another may
                // contradict.
                Err(Error::Qp { .. } | Error::NotFinite { .. } | Error::Newton { .. }) => {}
                Err(error) => panic!("{what}: {error}"),
            }
        }
    }
}

fn scaled(mut load: Load, unit: f64) -> Load {
    use signorini::LoadKind;
    match &mut load.kind {
        LoadKind::Constant { force } => *force *= unit,
        LoadKind::Harmonic { amplitude, .. } => *amplitude *= unit,
        LoadKind::Impulse { impulse, .. } => *impulse *= unit,
        _ => {}
    }
    load
}

#[test]
fn a_body_held_fast_or_far_from_the_origin_is_not_accused() {
    // Held between two walls without a gap, pressed; and the source scene moved by a kilometre,
    // where a place is known to 1e-13 m.
    let held = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 0.0).with_restitution(0.5))
        .with_wall(Wall::lower("lower", 0.0).with_restitution(0.5))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    let mut far = Scene::oscillator(1.0, 0.2, 0.0)
        .with_wall(Wall::upper("upper", 1e3 + 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", 1e3 - 5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_initial(&[1e3], &[0.1]);
    far.system = System::Oscillator(Oscillator { mass: 1.0, damping: 0.2, stiffness: 0.0 });
    for scene in [held, far] {
        for scheme in schemes(1e6) {
            match judged(&scene, &scheme, STEP, 1000, |_, _| {}) {
                Ok(findings) => assert_eq!(findings, [], "{scheme}"),
                Err(error) => println!("{scheme}: {error}"),
            }
        }
        let exact = signorini::run(&scene, &Scheme::Event, &signorini::Options::with_step(STEP)).expect("a run");
        assert_eq!(exact.findings, []);
    }
}

/// Every built-in case by every scheme that the tool offers for it, at the case's own step: the
/// first tenth of a second, which holds the first impacts of all of them but the ball's, and at
/// most 20 000 steps.
#[cfg(feature = "cli")]
#[test]
fn no_built_in_case_is_accused() {
    use signorini::case::Embedded;
    use signorini::study::work_precision::every_method;
    use signorini::{Options, run};
    let mut judged_runs = 0;
    for embedded in Embedded::all() {
        let case = embedded.case().expect("a built-in case");
        let end = if embedded.name == "bouncing-ball" { 2.0 } else { 0.1 };
        let mut scene = case.scene.clone();
        scene.duration = scene.duration.min(end).min(2e4 * case.time.step);
        let rubs = scene.turns_or_rubs();
        for method in every_method(&case.penalty.laws) {
            for coarser in [1.0, 8.0] {
                let step = (coarser * case.time.step).min(scene.duration / 10.0);
                match run(&scene, &method, &Options::with_step(step).with_sample(scene.duration)) {
                    Ok(run) => {
                        // Steps beyond the stability limit.
                        let kept = |found: &&Finding| !(explicit(&method.scheme) && found.refuted == Refuted::Diverged);
                        let found = run.findings.iter().find(kept);
                        assert_eq!(found, None, "{}, {method}, h = {step}", embedded.name);
                    }
                    Err(Error::NotFinite { .. } | Error::Newton { .. } | Error::Qp { .. }) => continue,
                    // Round supports and friction are those of moreau-jean alone.
                    Err(error) if error.is_request() && rubs && method.scheme != MOREAU_JEAN => continue,
                    Err(error) => panic!("{}, {method}: {error}", embedded.name),
                }
                judged_runs += 1;
            }
        }
    }
    assert!(judged_runs > 200, "{judged_runs}");
}

#[test]
fn a_refuted_run_is_an_error_for_whoever_measures_others_by_it() {
    let scene = source(0.8, 0.8).with_duration(0.2);
    let mut run = signorini::run(&scene, &MOREAU_JEAN, &signorini::Options::with_step(STEP)).expect("a run");
    assert!(run.refuted().is_none());
    run.findings =
        judged(&scene, &MOREAU_JEAN, STEP, 200, |_, a| a.impulse.iter_mut().for_each(|p| *p *= 1.01)).expect("a run");
    let error = run.unrefuted().expect_err("refuted");
    assert!(!error.is_request() && error.to_string().contains("momentum balance"), "{error}");
}

#[cfg(feature = "cli")]
#[test]
fn the_summary_says_that_a_run_was_refuted_and_by_what() {
    use signorini::case::Embedded;
    use signorini::output::summary::{Checks, Reasons, document};
    let mut case = Embedded::named("rigid-walls-sine").and_then(Embedded::case).expect("a case");
    case.scene.duration = 0.2;
    let mut run = signorini::run(&case.scene, &MOREAU_JEAN, &signorini::Options::with_step(STEP)).expect("a run");
    let reasons = Reasons { scheme: String::new(), qp: String::new() };
    let read = |run: &signorini::Run| document(&case, run, &reasons, Checks::default()).expect("a document");
    let kept = read(&run);
    assert_eq!((&kept["refuted"], kept["findings"].as_array().map(Vec::len)), (&serde_json::json!(false), Some(0)));
    run.findings = judged(&case.scene, &MOREAU_JEAN, STEP, 200, |_, a| a.impulse.iter_mut().for_each(|p| *p *= 1.01))
        .expect("a run");
    let broken = read(&run);
    assert_eq!(broken["refuted"], serde_json::json!(true));
    assert_eq!(broken["findings"][0]["refuted"], serde_json::json!("momentum_balance"));
    assert!(broken["findings"][0]["residual"].as_f64().expect("a number") > 1e-3);
}

/// A promise is made of parts, and one that no scheme of the crate makes is judged like any other:
/// without restitution the reflected bound of paoli-schatzman is the bound at the step's end; with
/// it that bound lies elsewhere, and such a promise is broken.
#[test]
fn a_promise_that_no_scheme_makes_is_judged_by_its_parts() {
    let found = |e: f64| {
        let scene = source(e, e).with_duration(0.2);
        let mut stepper = Stepper::new(&scene, &Scheme::PaoliSchatzman, STEP).unwrap();
        let state = stepper.state();
        let mut contract: Contract = stepper.contract();
        contract.promise.rigid.displacement = Some(Bound::End);
        let mut judge = Judge::new(&scene, contract, STEP, &state.q, &state.v);
        let mut pushed = false;
        for _ in 0..200 {
            let step = stepper.step().unwrap();
            pushed |= step.impulse.iter().any(|&p| p != 0.0);
            judge.observe(&step);
        }
        assert!(pushed, "no wall was met");
        kinds(&judge.findings())
    };
    assert_eq!(found(0.0), []);
    assert!(found(0.8).contains(&Refuted::Complementarity));
}
