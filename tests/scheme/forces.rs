//! The contact force itself, the purpose of a run: of every scheme, as an oscillator and as a
//! structure, on rigid and elastic walls.

use crate::common::{self, schemes_of_whole_steps, source};
use crate::random_structures::{at, chain, on};
use signorini::{
    Integrator, Load, Options, PenaltyLaw, Row, Scene, Scheme, Side, Stepper, System, Table, Wall, WallLaw, run,
};

/// Spring that replaces a rigid wall under a penalty, N/m.
const STAND_IN: f64 = 1e6;

fn every() -> Vec<Scheme> {
    let mut all = schemes_of_whole_steps();
    all.extend([0.0, 1.0].map(|rho| Scheme::GeneralizedAlpha { rho }));
    all.push(Scheme::Event);
    all
}

/// A body pressed against one wall so slowly that it does not vibrate: its displacement is linear
/// in time, and so is the wall's force.
struct Press {
    scene: Scene,
    /// Force of the wall (N, signed) at t = 0, and its growth per second.
    force: f64,
    growth: f64,
}

impl Press {
    fn force(&self, t: f64) -> f64 {
        self.force + self.growth * t
    }
}

/// Over which the press pushes, s.
const DURATION: f64 = 0.5;

/// A chain of `n` masses of 1 kg, 150 N/m between neighbours and to both ends, damped by 4 ms times
/// that, its middle mass pressed by f = (10 + `growth` t) N onto a wall 5 mm off; `stiffness` and
/// `damping` are the wall's, none if it is rigid.
///
/// With the others following, the middle mass feels κ x + c ẋ + r = f, κ = k(1/(j+1) + 1/(n−j)), of
/// which x = x₀ + w t is the solution.
fn press(n: usize, side: Side, law: Option<(f64, f64)>, growth: f64) -> Press {
    let (k, beta, gap, pressed) = (150.0, 4e-3, 5e-3, 10.0);
    let (j, sign) = (n / 2, -side.sign());
    let kappa = k * (1.0 / (j + 1) as f64 + 1.0 / (n - j) as f64);
    let (wall_k, wall_c) = law.unwrap_or((0.0, 0.0));
    let rate = if law.is_some() { growth / (kappa + wall_k) } else { 0.0 };
    let place = match law {
        Some(_) => (pressed + wall_k * gap - (beta * kappa + wall_c) * rate) / (kappa + wall_k),
        None => gap,
    };
    let shape: Vec<f64> =
        (0..n).map(|i| ((i + 1) as f64 / (j + 1) as f64).min((n - i) as f64 / (n - j) as f64)).collect();
    let of = |x: f64| shape.iter().map(|share| sign * x * share).collect::<Vec<f64>>();
    let wall = match side {
        Side::Upper => Wall::upper("stop", gap),
        Side::Lower => Wall::lower("stop", -gap),
    };
    let wall = match law {
        Some((stiffness, damping)) => wall.with_elasticity(stiffness, damping),
        None => wall.with_restitution(0.5),
    };
    // Beyond the end of the run, where the table ends.
    let ramp =
        Table::new(vec![0.0, 2.0], vec![sign * pressed, sign * (pressed + 2.0 * growth)]).expect("a sound table");
    let scene = chain(n, k, beta)
        .with_wall(at(wall, Row::dof(j)))
        .with_load(on(Load::table(ramp), j))
        .with_initial(&of(place), &of(rate))
        .with_duration(DURATION);
    let force = match law {
        Some((stiffness, damping)) => stiffness * (place - gap) + damping * rate,
        None => pressed - kappa * gap,
    };
    let growth = growth * if law.is_some() { wall_k / (kappa + wall_k) } else { 1.0 };
    Press { scene, force: -sign * force, growth: -sign * growth }
}

/// The scene of one degree of freedom without matrices.
fn as_oscillator(mut scene: Scene) -> Scene {
    let (one, old) = ([1.0], &scene.system);
    let new =
        Scene::oscillator(old.mass_form(&one, &one), old.damping_form(&one, &one), old.stiffness_form(&one, &one));
    scene.system = new.system;
    scene
}

/// Checks the force in every step of `scheme` against that of the press, and the impulse against
/// the force times the step.
fn hold(press: &Press, scheme: &Scheme, h: f64, what: &str) {
    let mut stepper = Stepper::new(&press.scene, scheme, h).expect("a sound scene");
    // A force is made of displacements over h²: the rounding of 5 mm, times some steps of drift.
    let rounding = 1e-11 * press.force.abs() + 64.0 * f64::EPSILON * 5e-3 / (h * h);
    let (mut sum, mut seen) = (0.0, 0);
    while stepper.time() < DURATION - 0.5 * h {
        let step = stepper.step().expect("a step");
        let (t, end) = (step.start, step.end);
        // The instant of the step to which the force belongs depends on the scheme.
        let (lo, hi) = (press.force(t).min(press.force(end)), press.force(t).max(press.force(end)));
        let force = step.force[0];
        assert!(
            lo - rounding <= force && force <= hi + rounding,
            "{what}: {force} N at {end} s, not from {lo} to {hi}, by {rounding:e}"
        );
        let p = step.impulse[0];
        let (least, most) = (lo * (end - t), hi * (end - t));
        let rounding = rounding * (end - t).max(f64::EPSILON);
        assert!(least - rounding <= p && p <= most + rounding, "{what}: {p} N s at {end} s, not {least} to {most}");
        sum += p;
        seen += 1;
    }
    assert!(seen > 0);
    // ∫r dt, but for one step of what the force grows by.
    let whole = press.force(0.5 * DURATION) * DURATION;
    let allowed = press.growth.abs() * h * DURATION + 1e-9 * whole.abs();
    assert!((sum - whole).abs() <= allowed, "{what}: {sum} N s in all, not {whole}");
}

/// The press as the scheme sees it: a penalty has its spring for the rigid wall.
fn for_scheme(n: usize, side: Side, law: Option<(f64, f64)>, growth: f64, scheme: &Scheme) -> Press {
    let Scheme::Penalty { law: PenaltyLaw::Linear { stiffness, .. }, .. } = *scheme else {
        return press(n, side, law, growth);
    };
    assert_eq!(stiffness, STAND_IN);
    press(n, side, law.or(Some((STAND_IN, 0.0))), growth)
}

#[test]
fn a_press_is_answered_by_its_force_in_every_step_of_every_scheme() {
    // At rest, and under a growing load; a rigid wall, a spring, and a spring with a dashpot.
    for growth in [0.0, 20.0] {
        for law in [None, Some((2e3, 0.0)), Some((2e3, 5.0))] {
            for side in [Side::Upper, Side::Lower] {
                for scheme in every() {
                    for h in [1e-2, 1e-4] {
                        // The explicit rule steps through its spring up to ωh = 2.
                        let explicit =
                            matches!(scheme, Scheme::Penalty { integrator: Integrator::CentralDifference, .. });
                        if explicit && h * h * STAND_IN > 1.0 {
                            continue;
                        }
                        for n in [1, 3] {
                            let press = for_scheme(n, side, law, growth, &scheme);
                            let what = format!("{scheme}, {n} masses, h = {h}, {side:?} {law:?}, +{growth} N/s");
                            hold(&press, &scheme, h, &what);
                            if n == 1 {
                                let alone = Press { scene: as_oscillator(press.scene.clone()), ..press };
                                hold(&alone, &scheme, h, &format!("{what}, oscillator"));
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The source scene between walls of every kind, and three masses between stops and pads.
fn moving() -> Vec<(&'static str, Scene)> {
    let mut masses = chain(3, 150.0, 4e-3);
    for i in 0..3 {
        masses = masses.with_wall(at(Wall::upper(&format!("u{i}"), 3e-3).with_restitution(0.5), Row::dof(i)));
    }
    masses = masses.with_wall(at(Wall::lower("pad", -2e-3).with_elasticity(3e3, 2.0), Row::dof(0)));
    masses = masses.with_wall(at(Wall::lower("between", -2e-3), Row::new(vec![(1, 1.0), (2, -1.0)])));
    masses = masses.with_load(on(Load::harmonic(9.0, 3.0, 0.0), 0)).with_load(on(Load::constant(2.0), 2));
    let mut structure = common::elastic(3.0, 0.5);
    structure.system = System::Structure(structure.system.structure());
    vec![
        ("rigid", source(0.8, 0.4)),
        ("elastic and rigid", common::elastic(3.0, 0.5)),
        ("elastic", common::all_elastic(1.0)),
        ("the same as a structure", structure),
        ("masses", masses),
    ]
}

/// True where the impulse of a step on the wall is ½h(r + r⁺) of the forces at its ends, by the
/// scheme's own definition.
fn averages(scheme: &Scheme, law: &WallLaw) -> bool {
    match scheme {
        Scheme::Newmark => true,
        Scheme::GeneralizedAlpha { .. } => !law.is_rigid(),
        _ => false,
    }
}

#[test]
fn the_impulse_of_a_step_is_its_force_times_the_step() {
    for (name, scene) in moving() {
        for scheme in every().into_iter().filter(|scheme| *scheme != Scheme::Event) {
            for h in [1e-3, 1e-4] {
                if matches!(scheme, Scheme::Penalty { integrator: Integrator::CentralDifference, .. }) && h > 1e-4 {
                    continue;
                }
                let mut stepper = Stepper::new(&scene, &scheme, h).expect("a sound scene");
                let laws: Vec<WallLaw> = stepper.scene().walls.iter().map(|wall| wall.law).collect();
                let mut last = vec![0.0; laws.len()];
                let mut pushed = vec![0_u32; laws.len()];
                for _ in 0..(1.0 / h).round() as u32 {
                    let step = stepper.step().expect("a step");
                    for (wall, law) in laws.iter().enumerate() {
                        let (p, force) = (step.impulse[wall], step.force[wall]);
                        let mean = if averages(&scheme, law) { 0.5 * (last[wall] + force) } else { force };
                        // One product or quotient, and a sum of two at most.
                        assert!(
                            (p - h * mean).abs() <= 4.0 * f64::EPSILON * p.abs(),
                            "{name}, {scheme}, h = {h}, wall {wall} at {} s: {p} N s and {force} N",
                            step.end
                        );
                        last[wall] = force;
                        pushed[wall] += u32::from(force != 0.0);
                    }
                }
                assert!(pushed.iter().all(|&steps| steps > 0), "{name}, {scheme}, h = {h}: {pushed:?}");
            }
        }
    }
}

#[test]
fn a_run_records_the_force_of_the_press_and_its_peak() {
    let h = 1e-3;
    for law in [None, Some((2e3, 5.0))] {
        for scheme in every() {
            for n in [1, 3] {
                let press = for_scheme(n, Side::Upper, law, 20.0, &scheme);
                let what = format!("{scheme}, {n} masses, {law:?}");
                recorded(&press, &scheme, h, &what);
                if n == 1 {
                    let alone = Press { scene: as_oscillator(press.scene.clone()), ..press };
                    recorded(&alone, &scheme, h, &format!("{what}, oscillator"));
                }
            }
        }
    }
}

/// Checks the rows and the statistics of a run against the force of the press, within a step of its
/// time.
fn recorded(press: &Press, scheme: &Scheme, h: f64, what: &str) {
    let run = run(&press.scene, scheme, &Options::with_step(h)).expect("a run");
    let near = |found: f64, expected: f64| (found - expected).abs() <= press.growth.abs() * h + 1e-8;
    let force = run.trajectory.contact_force("stop").expect("the wall");
    // The first row is before the first step, which tells how hard a rigid wall pushes.
    for (&t, &force) in run.trajectory.time().iter().zip(force).skip(1) {
        assert!(near(force, press.force(t)), "{what}: {force} N at {t} s");
    }
    let statistics = &run.statistics.walls[0];
    let peak = statistics.episode_peak_force_n.max.expect("a lasting contact");
    assert!(near(peak, press.force(DURATION).abs()), "{what}: {peak} N");
    let over_time = statistics.force.expect("a window");
    assert!(near(over_time.mean_n, press.force(0.5 * DURATION).abs()), "{what}: {over_time:?}");
    assert!(near(over_time.impulse_n_s, press.force(0.5 * DURATION) * DURATION), "{what}: {over_time:?}");
}
