//! Complementarity of every QP scheme: by the judge, by an independent account computed here, and
//! tests of the judge itself.

use crate::common::{self, CONSTRAINED, MOREAU_JEAN, source};
use signorini::linear::{Rows, Symmetric};
use signorini::qp::{Backend, Problem, Rhs, ScalarRow, Solver, clamp};
use signorini::residual::{Judge, Residuals};
use signorini::{
    Finding, Load, LoadKind, Method, Options, Refuted, Run, Scene, Scheme, Side, Step, Stepper, System, TimeOptions,
    Wall, WallLaw, run,
};

/// Scenes of every kind of wall, by name; all of them over two seconds.
fn scenes() -> Vec<(&'static str, Scene)> {
    let upper = |e: f64| Wall::upper("upper", 5e-3).with_restitution(e);
    let one_place = common::driven().with_wall(upper(0.5)).with_wall(Wall::lower("lower", 5e-3).with_restitution(0.25));
    let twice = common::driven()
        .with_wall(upper(0.9))
        .with_wall(Wall::upper("twin", 5e-3).with_restitution(0.4))
        .with_wall(Wall::lower("lower", -5e-3).with_elasticity(1e4, 2.0));
    let mut pressed = source(0.3, 0.6);
    pressed.loads.push(Load::constant(5.0));
    let scenes = vec![
        ("e = 1", source(1.0, 1.0)),
        ("e = 0.8", source(0.8, 0.8)),
        ("e = 0", source(0.0, 0.0)),
        ("unequal e", source(0.9, 0.2)),
        ("one elastic wall", common::elastic(0.0, 1.0)),
        ("one damped elastic wall", common::elastic(3.0, 0.8)),
        ("two damped elastic walls", common::all_elastic(5.0)),
        ("a ball, e = 0.8", common::ball(0.1, 0.8)),
        ("a ball at rest", common::ball(0.0, 1.0)),
        ("both walls at one place", one_place.with_initial(&[5e-3], &[0.1])),
        ("two upper walls at one place, one stiff", twice),
        ("pressed for ever", pressed),
        ("a blow on a wall", source(0.5, 0.5).with_initial(&[5e-3], &[0.0]).with_load(Load::impulse(0.2, 0.5))),
    ];
    scenes.into_iter().map(|(name, scene)| (name, scene.with_duration(2.0))).collect()
}

fn options(step: f64) -> Options {
    Options::new(TimeOptions { sample: Some(1e-2), ..TimeOptions::with_step(step) })
}

fn by(scheme: Scheme, backend: Backend) -> Method {
    Method { scheme, backend }
}

#[test]
fn complementarity_holds_to_1e_12_with_the_clamp_at_every_step_of_every_scheme() {
    for (name, scene) in scenes() {
        for scheme in CONSTRAINED {
            for step in [1e-2, 1e-3, 1e-4] {
                let run = run(&scene, &by(scheme, Backend::Clamp), &options(step)).expect("a run");
                let (what, r) = (format!("{scheme}, {name}, h = {step}"), run.residuals);
                // Newmark gains energy at impacts, without limit at a rigid and an elastic wall.
                let kept = |found: &&Finding| !(scheme == Scheme::Newmark && found.refuted == Refuted::Diverged);
                assert_eq!(run.findings.iter().find(kept), None, "{what}");
                // Rounding of positions leaves some 1e-15 of the scales.
                assert!(r.complementarity <= 1e-12, "{what}: {r:?}");
                assert!(r.tension_n <= 1e-12 * r.force_scale_n, "{what}: {r:?}");
                // Newmark drives the body to speeds whose rounding is no longer small against the
                // gap.
                assert!(r.force_balance <= 1e-12 || scheme == Scheme::Newmark, "{what}: {r:?}");
            }
        }
    }
}

/// Largest difference of two runs: in displacement over the gap scale, and in the net wall force
/// over the largest. (Walls at one place share a force in no stated way.)
fn difference(a: &Run, b: &Run, scene: &Scene) -> (f64, f64) {
    let largest = |x: &[f64], y: &[f64]| x.iter().zip(y).fold(0.0, |w, (x, y)| f64::max(w, (x - y).abs()));
    let net = |run: &Run| {
        let mut sum = vec![0.0; run.trajectory.time().len()];
        for wall in run.trajectory.walls() {
            let force = run.trajectory.contact_force(wall).expect("a wall of the run");
            sum.iter_mut().zip(force).for_each(|(s, f)| *s += f);
        }
        sum
    };
    let scale = a.residuals.force_scale_n.max(f64::MIN_POSITIVE);
    let displacement = largest(a.trajectory.displacement(), b.trajectory.displacement());
    (displacement / scene.gap_scale(), largest(&net(a), &net(b)) / scale)
}

#[test]
fn clarabel_keeps_it_to_1e_9_and_agrees_with_the_clamp_over_whole_runs() {
    let (mut compared, mut chaotic) = (0, Vec::new());
    for (name, scene) in scenes() {
        // Newmark's own gain of energy makes every run of it with a rigid wall chaotic.
        for scheme in CONSTRAINED.into_iter().filter(|s| *s != Scheme::Newmark) {
            for step in [1e-2, 1e-3] {
                let what = format!("{scheme}, {name}, h = {step}");
                let by_clamp = run(&scene, &by(scheme, Backend::Clamp), &options(step)).expect("a run");
                let by_clarabel = run(&scene, &by(scheme, Backend::Clarabel), &options(step)).expect("a run");
                assert!(by_clarabel.residuals.complementarity <= 1e-9, "{what}: {:?}", by_clarabel.residuals);
                assert_eq!(by_clarabel.findings, [], "{what}");
                // A run is chaotic for this purpose if a load changed by rounding (1e-15) moves it
                // by more than a hundredth of the tolerance.
                let mut nudged = scene.clone();
                for load in &mut nudged.loads {
                    match &mut load.kind {
                        LoadKind::Harmonic { amplitude, .. } => *amplitude *= 1.0 + 1e-15,
                        LoadKind::Constant { force } => *force *= 1.0 + 1e-15,
                        _ => {}
                    }
                }
                let nudged = run(&nudged, &by(scheme, Backend::Clamp), &options(step)).expect("a run");
                let growth = difference(&by_clamp, &nudged, &scene);
                if growth.0.max(growth.1) > 1e-11 {
                    chaotic.push(what);
                    continue;
                }
                compared += 1;
                let (displacement, force) = difference(&by_clamp, &by_clarabel, &scene);
                assert!(displacement <= 1e-9, "{what}: {displacement:e} of the gap");
                assert!(force <= 1e-9, "{what}: {force:e} of the largest force");
            }
        }
    }
    println!("{compared} compared; chaotic: {chaotic:?}");
    assert!(compared > 100, "only {compared}; chaotic: {chaotic:?}");
}

/// A step written here from the literature, for an oscillator: the programme of moreau-jean,
/// paoli-schatzman or implicit-euler.
struct Programme {
    a: f64,
    b: f64,
    rows: Vec<ScalarRow>,
}

struct Oscillation {
    m: f64,
    c: f64,
    k: f64,
    h: f64,
}

fn load(scene: &Scene, t: f64) -> f64 {
    let of = |kind: &LoadKind| match *kind {
        LoadKind::Constant { force } => force,
        LoadKind::Harmonic { amplitude, frequency, phase } => {
            amplitude * (std::f64::consts::TAU * frequency * t + phase).sin()
        }
        _ => 0.0,
    };
    scene.loads.iter().map(|load| of(&load.kind)).sum()
}

fn blow(scene: &Scene, from: f64, to: f64) -> f64 {
    let of = |kind: &LoadKind| match *kind {
        LoadKind::Impulse { impulse, time } if time > from && time <= to => impulse,
        _ => 0.0,
    };
    scene.loads.iter().map(|load| of(&load.kind)).sum()
}

/// Σ (about − t_b) J_b of the blows in (from, to], N s².
fn shift(scene: &Scene, from: f64, to: f64, about: f64) -> f64 {
    let of = |kind: &LoadKind| match *kind {
        LoadKind::Impulse { impulse, time } if time > from && time <= to => (about - time) * impulse,
        _ => 0.0,
    };
    scene.loads.iter().map(|load| of(&load.kind)).sum()
}

fn bound(side: Side, at: f64) -> ScalarRow {
    match side {
        Side::Upper => ScalarRow { lo: f64::NEG_INFINITY, hi: at, compliance: 0.0 },
        Side::Lower => ScalarRow { lo: at, hi: f64::INFINITY, compliance: 0.0 },
    }
}

/// The least e, if the bounds with each wall's own e would cross.
fn shared(scene: &Scene, back: f64) -> Option<f64> {
    let e =
        |w: &Wall| if let WallLaw::Rigid { restitution } = w.law { restitution } else { panic!("rigid walls only") };
    let bounds = |side| {
        let walls = scene.walls.iter().filter(move |w| w.side() == side);
        walls.map(move |w| (1.0 + e(w)) * w.position() - e(w) * back)
    };
    let (lo, hi) =
        (bounds(Side::Lower).fold(f64::NEG_INFINITY, f64::max), bounds(Side::Upper).fold(f64::INFINITY, f64::min));
    (lo > hi).then(|| scene.walls.iter().map(e).fold(1.0, f64::min))
}

impl Oscillation {
    fn of(scene: &Scene, h: f64) -> Self {
        let System::Oscillator(o) = &scene.system else { panic!("one degree of freedom") };
        Self { m: o.mass, c: o.damping, k: o.stiffness, h }
    }

    /// In v⁺, in the metric M + hθC + h²θ²K.
    fn moreau_jean(&self, scene: &Scene, theta: f64, t: f64, q: f64, v: f64) -> Programme {
        let Self { m, c, k, h } = *self;
        let a = m + h * theta * c + h * h * theta * theta * k;
        let f = (1.0 - theta) * load(scene, t) + theta * load(scene, t + h);
        let b = (m - h * (1.0 - theta) * c - h * h * theta * (1.0 - theta) * k) * v - h * k * q
            + h * f
            + blow(scene, t, t + h);
        // The wall answers the velocity that a blow of the step leaves.
        let v = v + blow(scene, t, t + h) / m;
        // The damper feels the blow from its own instant on, not from where the rule counts it; a
        // blow that a wall answers stays where the rule counts it.
        let reached = |w: &Wall| w.side().sign() * (q + 0.5 * h * v - w.position()) <= 1e-12 * scene.gap_scale();
        let answers = |w: &Wall| reached(w) && w.side().sign() * blow(scene, t, t + h) < 0.0;
        let felt = if scene.walls.iter().any(answers) { 0.0 } else { shift(scene, t, t + h, t + h - theta * h) / m };
        let b = b - c * felt;
        let row = |w: &Wall| {
            let WallLaw::Rigid { restitution } = w.law else { panic!("rigid walls only") };
            let sign = w.side().sign();
            if !reached(w) {
                return ScalarRow { lo: f64::NEG_INFINITY, hi: f64::INFINITY, compliance: 0.0 };
            }
            let e = if sign * v <= 0.0 { restitution } else { 1.0 };
            bound(w.side(), -e * v)
        };
        Programme { a, b, rows: scene.walls.iter().map(row).collect() }
    }

    /// In q⁺, in the metric M/h² + C/2h + K/4.
    fn paoli_schatzman(&self, scene: &Scene, t: f64, back: f64, q: f64) -> Programme {
        let Self { m, c, k, h } = *self;
        let a = m / (h * h) + c / (2.0 * h) + k / 4.0;
        let b = m * (2.0 * q - back) / (h * h) + c * back / (2.0 * h) - k * (q / 2.0 + back / 4.0)
            + load(scene, t)
            + blow(scene, (t - h / 2.0).max(0.0), t + h / 2.0) / h;
        let row = |w: &Wall| {
            let WallLaw::Rigid { restitution } = w.law else { panic!("rigid walls only") };
            // The wall answers the velocity that a blow leaves: it would have come from there.
            let back = back - h * blow(scene, (t - h / 2.0).max(0.0), t + h / 2.0) / m;
            let e = shared(scene, back).unwrap_or(restitution);
            bound(w.side(), (1.0 + e) * w.position() - e * back)
        };
        Programme { a, b, rows: scene.walls.iter().map(row).collect() }
    }

    /// In q⁺, in the metric M/h² + C/h + K.
    fn implicit_euler(&self, scene: &Scene, t: f64, q: f64, v: f64) -> Programme {
        let Self { m, c, k, h } = *self;
        let a = m / (h * h) + c / h + k;
        // The rule counts a blow from the step's start on, where it acts from its own instant, for
        // the damper too.
        let early = shift(scene, t, t + h, t) / m;
        let b = m * (q / h + v) / h + c * q / h + load(scene, t + h) + blow(scene, t, t + h) / h + a * early
            - c * early / h;
        Programme { a, b, rows: scene.walls.iter().map(|w| bound(w.side(), w.position())).collect() }
    }
}

/// The independent account: at each step the programme is written from the states alone, its
/// residuals are taken from what the stepper returned, and the same programme is given to both
/// solvers.
#[test]
fn an_independent_account_finds_the_same_complementarity_and_both_solvers_agree_on_every_programme() {
    for (name, scene) in scenes().into_iter().filter(|(_, s)| s.walls.iter().all(|w| w.law.is_rigid())) {
        for scheme in [Scheme::ImplicitEuler, Scheme::PaoliSchatzman, MOREAU_JEAN, Scheme::MoreauJean { theta: 0.75 }] {
            for h in [1e-2, 1e-3] {
                account(name, &scene, &scheme, h);
            }
        }
    }
}

fn account(name: &str, scene: &Scene, scheme: &Scheme, h: f64) {
    let what = format!("{scheme}, {name}, h = {h}");
    let o = Oscillation::of(scene, h);
    let mut stepper = Stepper::new(scene, scheme, h).expect("a sound scene");
    let (mut q, mut v) = (stepper.state().q[0], stepper.state().v[0]);
    let mut back = f64::NAN;
    let mut solver: Option<Solver> = None;
    // (programme, x⁺, r, size of the unknown) of every step; r as a force.
    let (mut pairs, mut largest_force, mut largest_x) = (Vec::new(), 0.0_f64, 0.0_f64);
    for i in 0..(scene.duration / h).round() as u32 {
        let t = f64::from(i) * h;
        let step = stepper.step().expect("a step");
        if back.is_nan() {
            back = q - h * step.velocity_before[0];
        }
        let velocity = matches!(scheme, Scheme::MoreauJean { .. });
        let programme = match *scheme {
            Scheme::MoreauJean { theta } => o.moreau_jean(scene, theta, t, q, v),
            Scheme::PaoliSchatzman => o.paoli_schatzman(scene, t, back, q),
            _ => o.implicit_euler(scene, t, q, v),
        };
        let Programme { a, b, rows } = programme;
        let x = if velocity { step.v[0] } else { step.q[0] };
        let unit = if velocity { h } else { 1.0 };
        let net: f64 = step.impulse.iter().sum::<f64>() / h;
        // The wall force that the states require, against what the walls report.
        let needed = (a * x - b) / unit;
        largest_force = largest_force.max(needed.abs());
        largest_x = largest_x.max(x.abs());
        for (row, wall) in rows.iter().zip(&scene.walls) {
            let slack = if wall.side() == Side::Upper { row.hi - x } else { x - row.lo };
            let pressure = wall.side().sign() * step.impulse[scene.wall_index(&wall.name).expect("its own")] / h;
            pairs.push((slack, pressure, needed - net));
        }
        // Both solvers on this very programme, where it meets a wall.
        let free = b / a;
        if rows.iter().any(|row| free < row.lo || free > row.hi) {
            let scale = if velocity { scene.gap_scale() / h } else { scene.gap_scale() };
            let solver = solver.get_or_insert_with(|| {
                let problem = Problem {
                    a: Symmetric::diagonal(&[a]),
                    g: Rows::new(1, rows.iter().map(|_| [(0, 1.0)].as_slice())),
                    compliance: vec![0.0; rows.len()],
                };
                Solver::new(problem, Backend::Clarabel, scale).expect("a sound problem")
            });
            let (lo, hi): (Vec<f64>, Vec<f64>) = rows.iter().map(|row| (row.lo, row.hi)).unzip();
            let by_clarabel =
                solver.solve(&Rhs { b: &[b], lo: &lo, hi: &hi }).unwrap_or_else(|e| panic!("{what}: {e}"));
            let mut r = vec![0.0; rows.len()];
            let by_clamp = clamp(a, b, &rows, &mut r).unwrap_or_else(|e| panic!("{what}: {e}"));
            let total: f64 = r.iter().sum();
            let other: f64 = by_clarabel.multiplier.iter().sum();
            assert!((by_clamp - by_clarabel.x[0]).abs() <= 1e-9 * scale, "{what}: {by_clamp} {by_clarabel:?}");
            assert!((total - other).abs() <= 1e-9 * (a * scale), "{what}: {total} {other}");
            // And the stepper's own answer is this one, to the rounding of b.
            assert!((by_clamp - x).abs() <= 1e-12 * scale.max(largest_x), "{what}: {by_clamp} {x}");
        }
        (back, q, v) = (q, step.q[0], step.v[0]);
    }
    let scale = if matches!(scheme, Scheme::MoreauJean { .. }) { largest_x } else { scene.gap_scale() };
    let relative = |x: f64, scale: f64| if x == 0.0 { 0.0 } else { x / scale };
    // A force taken from a second difference of positions is known to a ulp of position times A:
    // for the weakest contact here, gravity on a ball at h = 1e-3, 1e-18·1e6 of 10 N. Measured
    // against the largest force of the run, and 1 N where that is smaller.
    let force_scale = largest_force.max(1.0);
    for (slack, pressure, mismatch) in pairs {
        let worst = relative(slack, scale).min(relative(pressure, force_scale)).abs();
        let free = slack.is_infinite() && pressure == 0.0;
        assert!(free || worst <= 1e-12, "{what}: slack {slack:e}, pressure {pressure:e}");
        assert!(mismatch.abs() <= 1e-11 * force_scale, "{what}: {mismatch:e} of {force_scale:e} N");
    }
}

/// The verdict on 0.3 s of `scene`, each step passed through `alter` before the judge sees it.
fn judged(scene: &Scene, scheme: &Scheme, mut alter: impl FnMut(&Step<'_>, &mut Altered)) -> Residuals {
    let h = 1e-3;
    let mut stepper = Stepper::new(scene, scheme, h).expect("a sound scene");
    let state = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), h, &state.q, &state.v);
    for _ in 0..300 {
        let step = stepper.step().expect("a step");
        let mut altered = Altered {
            q: step.q[0],
            v: step.v[0],
            after: step.velocity_after[0],
            impulse: step.impulse.to_vec(),
            force: step.force.to_vec(),
        };
        alter(&step, &mut altered);
        let Altered { q, v, after, impulse, force } = altered;
        let (q, v, after) = ([q], [v], [after]);
        let mut altered = step;
        (altered.q, altered.v, altered.velocity_after) = (&q, &v, &after);
        (altered.impulse, altered.force) = (&impulse, &force);
        judge.observe(&altered);
    }
    judge.residuals()
}

struct Altered {
    q: f64,
    v: f64,
    after: f64,
    impulse: Vec<f64>,
    force: Vec<f64>,
}

/// The first impact of the source scene is at 0.076102 s, on the upper wall: in its 77th step.
const FIRST_IMPACT: u64 = 76;

#[test]
fn the_judge_reports_what_is_wrong_with_a_corrupted_step() {
    let scene = source(0.8, 0.8);
    let paoli = Scheme::PaoliSchatzman;
    let sound = |r: &Residuals| r.complementarity < 1e-12 && r.force_balance < 1e-12 && r.tension_n == 0.0;
    for scheme in [MOREAU_JEAN, paoli, Scheme::ImplicitEuler] {
        let r = judged(&scene, &scheme, |_, _| {});
        assert!(sound(&r), "{scheme}: {r:?}");
        assert!(r.energy.residual < 1e-14 || scheme == Scheme::ImplicitEuler, "{scheme}: {r:?}");

        // A wall that pulls: the impulses change sign.
        let r = judged(&scene, &scheme, |_, a| a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p = -*p));
        assert!((r.complementarity - 1.0).abs() < 1e-12 && r.tension_n == r.force_scale_n, "{scheme}: {r:?}");

        // A force in mid-air: 1 % of the largest where the body is far from the wall.
        let r = judged(&scene, &scheme, |step, a| {
            if step.index == 30 {
                (a.impulse[0], a.force[0]) = (-1e-3, -1.0);
            }
        });
        assert!(r.complementarity > 1e-3 && r.force_balance > 1e-3, "{scheme}: {r:?}");

        // A force that is 1 % too large: only the momentum balance shows it.
        let r = judged(&scene, &scheme, |_, a| a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p *= 1.01));
        assert!(r.complementarity < 1e-12 && r.force_balance > 9e-3, "{scheme}: {r:?}");

        // A displacement that does not follow from the velocities: 1 % of the gap, for one step.
        let r = judged(&scene, &scheme, |step, a| {
            if step.index == 30 {
                a.q += 5e-5;
            }
        });
        assert!(r.force_balance > 9e-3, "{scheme}: {r:?}");
    }
}

#[test]
fn the_judge_reports_penetration_where_a_scheme_promises_none() {
    let r = judged(&source(0.8, 0.8), &Scheme::ImplicitEuler, |step, a| {
        if step.index == FIRST_IMPACT {
            a.q = 5.5e-3;
        }
    });
    // Half a millimetre of five.
    assert!((r.penetration_m - 5e-4).abs() < 1e-12 && (r.complementarity - 0.1).abs() < 1e-9, "{r:?}");
    assert!((r.depth_m[0] - 5e-4).abs() < 1e-12 && r.depth_m[1] < 1e-15, "{r:?}");
}

#[test]
fn the_judge_reports_a_wrong_restitution_though_momentum_is_kept() {
    let scene = source(0.8, 0.8);
    // The rebound and the impulse that goes with it are those of e = 0.7: 1 kg of mass, so Δp = Δv
    // (but for the damping within the step, 1e-4 of it).
    let mut left = 0.0;
    let r = judged(&scene, &MOREAU_JEAN, |step, a| {
        if step.index == FIRST_IMPACT {
            let change = 0.1 * step.velocity_before[0];
            assert!(change > 0.0 && step.impulse[0] < 0.0);
            a.v += change;
            a.after += change;
            a.impulse[0] += change;
            left = change;
        }
    });
    // Slack 0.1 v of the largest speed, 0.2 m/s or so; force far from 0.
    assert!(left > 0.01 && r.complementarity > 0.05, "{r:?}");
}

#[test]
fn the_judge_reports_energy_that_is_lost_or_made() {
    // A free body of 5 mJ whose velocities are a tenth off from some step on.
    let free = Scene::oscillator(1.0, 0.0, 0.0).with_initial(&[0.0], &[0.1]);
    for factor in [0.9, 1.1] {
        let r = judged(&free, &MOREAU_JEAN, |step, a| {
            if step.index >= 40 {
                a.v *= factor;
                a.after *= factor;
            }
        });
        let expected = 5e-3 * (factor * factor - 1.0);
        assert!((r.energy.residual_j - expected).abs() < 1e-12, "{:?}", r.energy);
        assert!((r.energy.residual - expected.abs() / r.energy.exchanged_j).abs() < 1e-12, "{:?}", r.energy);
        assert!(r.force_balance > 1e-3, "{r:?}");
    }
    // An elastic wall that gives back less than its law says.
    let r = judged(&common::elastic(0.0, 1.0), &MOREAU_JEAN, |_, a| {
        a.impulse.iter_mut().chain(&mut a.force).for_each(|p| *p *= 0.99);
    });
    assert!((r.complementarity - 0.01).abs() < 2e-3, "{r:?}");
}

#[test]
fn a_judge_takes_no_harm_from_what_does_not_fit_its_scene() {
    let scene = source(0.8, 0.8).with_duration(1.0);
    let other = Scene::oscillator(1.0, 0.0, 100.0);
    for scheme in [MOREAU_JEAN, Scheme::Event] {
        let mut stepper = Stepper::new(&other, &scheme, 1e-3).expect("a sound scene");
        for (q, v) in [(&[][..], &[][..]), (&[0.0, 1.0], &[0.0])] {
            let mut judge = Judge::new(&scene, stepper.contract(), 1e-3, q, v);
            let before = judge.residuals();
            // A step without walls does not fit, and is ignored.
            judge.observe(&stepper.step().expect("a step"));
            assert_eq!(judge.residuals(), before);
        }
    }
}
