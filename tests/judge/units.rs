//! A run in other units of length, mass and time is the same run: every result is the other one
//! times the factor that its own unit takes.
//!
//! The factors are powers of two, and those of mass powers of four (the judge takes roots of
//! masses), so that no number is rounded otherwise than before: results agree to the bit. A size
//! anywhere that is not made of the scene's own, be it the start of a sum or of a largest value,
//! shows in one of the two.
use crate::common::{self, INTEGRATORS, MOREAU_JEAN, elastic, source};
use crate::random_structures::{Draws, random_scene};
use serde_json::Value;
use signorini::linear::Symmetric;
use signorini::residual::Judge;
use signorini::{
    Finding, Load, LoadKind, Options, PenaltyLaw, Run, Scene, Scheme, SharedStructure, Stepper, Structure, System,
    Table, TimeOptions, Wall, WallLaw, run,
};

/// How many of the new units an old one is.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

impl Units {
    const SMALL: Self = Self { length: two(-30), mass: two(40), time: two(-20) };
    const LARGE: Self = Self { length: two(30), mass: two(-40), time: two(20) };

    fn speed(self) -> f64 {
        self.length / self.time
    }

    fn impulse(self) -> f64 {
        self.mass * self.speed()
    }

    fn force(self) -> f64 {
        self.impulse() / self.time
    }

    fn stiffness(self) -> f64 {
        self.force() / self.length
    }

    fn damping(self) -> f64 {
        self.force() / self.speed()
    }

    fn energy(self) -> f64 {
        self.force() * self.length
    }

    fn load(self, load: &Load) -> Load {
        let kind = match &load.kind {
            LoadKind::Constant { force } => LoadKind::Constant { force: force * self.force() },
            &LoadKind::Harmonic { amplitude, frequency, phase } => {
                LoadKind::Harmonic { amplitude: amplitude * self.force(), frequency: frequency / self.time, phase }
            }
            LoadKind::Impulse { impulse, time } => {
                LoadKind::Impulse { impulse: impulse * self.impulse(), time: time * self.time }
            }
            LoadKind::Table(table) => {
                let times = table.time().iter().map(|t| t * self.time).collect();
                let forces = table.force().iter().map(|f| f * self.force()).collect();
                LoadKind::Table(Table::new(times, forces).expect("a sound table"))
            }
            kind => panic!("{kind:?} has units of its own"),
        };
        Load { kind, at: load.at.clone() }
    }

    fn wall(self, wall: &Wall) -> Wall {
        let law = match wall.law {
            WallLaw::Elastic { stiffness, damping } => {
                WallLaw::Elastic { stiffness: stiffness * self.stiffness(), damping: damping * self.damping() }
            }
            law => law,
        };
        Wall { law, ..wall.clone().with_position(wall.position() * self.length) }
    }

    fn scene(self, scene: &Scene) -> Scene {
        let system = match &scene.system {
            System::Oscillator(o) => {
                Scene::oscillator(o.mass * self.mass, o.damping * self.damping(), o.stiffness * self.stiffness()).system
            }
            System::Structure(s) => {
                let times = |unit: f64, matrix: &Symmetric| Symmetric::sum(&[(unit, matrix)]);
                System::Structure(SharedStructure::from(Structure {
                    mass: times(self.mass, &s.mass),
                    damping: times(self.damping(), &s.damping),
                    stiffness: times(self.stiffness(), &s.stiffness),
                }))
            }
            system => panic!("{system:?} is new"),
        };
        let by = |unit: f64, values: &[f64]| values.iter().map(|x| x * unit).collect::<Vec<_>>();
        let mut other = scene.clone();
        other.system = system;
        other.walls = scene.walls.iter().map(|wall| self.wall(wall)).collect();
        other.loads = scene.loads.iter().map(|load| self.load(load)).collect();
        other
            .with_initial(&by(self.length, &scene.initial.q), &by(self.speed(), &scene.initial.v))
            .with_duration(scene.duration * self.time)
    }

    fn scheme(self, scheme: Scheme) -> Scheme {
        let Scheme::Penalty { law, integrator } = scheme else { return scheme };
        let law = match law {
            PenaltyLaw::Linear { stiffness, damping } => {
                PenaltyLaw::Linear { stiffness: stiffness * self.stiffness(), damping: damping * self.damping() }
            }
            // The pressure is φ/ε times a length, with φ an area.
            PenaltyLaw::Quartic { epsilon } => {
                PenaltyLaw::Quartic { epsilon: epsilon * self.length.powi(3) / self.force() }
            }
            law => panic!("{law:?} is new"),
        };
        Scheme::Penalty { law, integrator }
    }

    /// The factors that a result of this name may take: names end in their unit. γ₀ is a length, or
    /// a speed where the scheme promises speeds.
    fn of(self, name: &str) -> Vec<f64> {
        let ends = |unit: &str| name.ends_with(unit);
        match name {
            "gap_scale" => vec![self.length, self.speed()],
            _ if ends("_per_s") => vec![1.0 / self.time],
            _ if ends("_n_s") => vec![self.impulse()],
            _ if ends("_s") => vec![self.time],
            _ if ends("_m") => vec![self.length],
            _ if ends("_n") => vec![self.force()],
            _ if ends("_j") => vec![self.energy()],
            _ if ends("_w") => vec![self.energy() / self.time],
            _ => vec![1.0],
        }
    }

    /// Compares two results of one name.
    fn compare(self, name: &str, found: &Value, other: &Value, what: &str) {
        match (found, other) {
            (Value::Object(found), Value::Object(other)) => {
                assert_eq!(found.len(), other.len(), "{what}: {name}");
                for (key, value) in found {
                    // A half width has its unit in front of the share that it holds for; a summary
                    // has it in its own name.
                    let key_name = key.replace("_half_width_95", "");
                    let inner = if key == "mean" || key == "max" { name } else { key_name.as_str() };
                    self.compare(inner, value, &other[key], what);
                }
            }
            (Value::Array(found), Value::Array(other)) => {
                assert_eq!(found.len(), other.len(), "{what}: {name}");
                found.iter().zip(other).for_each(|(found, other)| self.compare(name, found, other, what));
            }
            (Value::Number(found), Value::Number(other)) => {
                let number = |value: &serde_json::Number| value.as_f64().expect("a number");
                let same = self.of(name).iter().any(|unit| number(found) * unit == number(other));
                assert!(same, "{what}: {name} {found}, in other units {other}");
            }
            _ => assert_eq!(found, other, "{what}: {name}"),
        }
    }

    /// Compares the runs of a scene in the two units.
    fn compare_runs(self, one: &Run, other: &Run, what: &str) {
        assert_eq!(one.counters, other.counters, "{what}");
        let rows = |unit: f64, one: &[Vec<f64>], other: &[Vec<f64>], name: &str| {
            for (row, (one, other)) in one.iter().zip(other).enumerate() {
                for (index, (x, y)) in one.iter().zip(other).enumerate() {
                    assert!(x * unit == *y, "{what}: {name} {row}, number {index}: {x:e}, in other units {y:e}");
                }
            }
        };
        let (a, b) = (&one.trajectory, &other.trajectory);
        rows(self.time, &[a.time().to_vec()], &[b.time().to_vec()], "time");
        rows(
            self.length,
            std::slice::from_ref(&one.state.q),
            std::slice::from_ref(&other.state.q),
            "displacement at the end",
        );
        rows(
            self.speed(),
            std::slice::from_ref(&one.state.v),
            std::slice::from_ref(&other.state.v),
            "velocity at the end",
        );
        rows(self.length, a.displacements(), b.displacements(), "displacement");
        rows(self.speed(), a.velocities(), b.velocities(), "velocity");
        rows(self.force(), a.contact_forces(), b.contact_forces(), "contact force");
        rows(self.impulse(), a.contact_impulses(), b.contact_impulses(), "contact impulse");
        assert_eq!(a.contacts().len(), b.contacts().len(), "{what}");
        for (x, y) in a.contacts().iter().zip(b.contacts()) {
            let mut scaled = *x;
            scaled.start *= self.time;
            scaled.end = x.end.map(|end| end * self.time);
            scaled.impulse *= self.impulse();
            scaled.peak_force = x.peak_force.map(|force| force * self.force());
            scaled.approach_speed *= self.speed();
            scaled.departure_speed = x.departure_speed.map(|speed| speed * self.speed());
            assert_eq!(scaled, *y, "{what}");
        }
        assert_eq!(one.findings.len(), other.findings.len(), "{what}: {:?}, {:?}", one.findings, other.findings);
        self.compare("", &json(&one.residuals), &json(&other.residuals), what);
        self.compare("", &json(&one.statistics), &json(&other.statistics), what);
    }
}

/// Results as JSON, whose names say their units.
fn json(results: &impl serde::Serialize) -> Value {
    serde_json::to_value(results).expect("numbers")
}

const fn two(power: i64) -> f64 {
    f64::from_bits(((1023 + power) as u64) << 52)
}

/// Every scheme on a grid.
fn schemes() -> Vec<Scheme> {
    let mut all = vec![
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        MOREAU_JEAN,
        Scheme::MoreauJean { theta: 0.75 },
        Scheme::GeneralizedAlpha { rho: 0.8 },
        Scheme::Newmark,
        Scheme::Located,
    ];
    all.extend(INTEGRATORS.map(|integrator| {
        let law = PenaltyLaw::Linear { stiffness: 3e4, damping: 0.3 };
        Scheme::Penalty { law, integrator }
    }));
    all.extend(
        INTEGRATORS.map(|integrator| Scheme::Penalty { law: PenaltyLaw::Quartic { epsilon: 1e-7 }, integrator }),
    );
    all
}

/// Runs `scene` in three systems of units by `scheme`, and compares; false where it does not run.
fn is_one_run(scene: &Scene, scheme: Scheme, h: f64, what: &str) -> bool {
    let what = format!("{what}, {scheme}");
    let options = |time: f64| {
        let times = TimeOptions {
            statistics_from: 0.125 * scene.duration * time,
            force_averaging: 4.0 * h * time,
            ..TimeOptions::with_step(h * time)
        };
        Options::new(times)
    };
    let one = run(scene, &scheme, &options(1.0));
    for units in [Units::SMALL, Units::LARGE] {
        let other = run(&units.scene(scene), &units.scheme(scheme), &options(units.time));
        match (&one, &other) {
            (Ok(one), Ok(other)) => units.compare_runs(one, other, &what),
            (Err(_), Err(_)) => {}
            (one, other) => panic!("{what}: {:?}, in other units {:?}", one.as_ref().err(), other.as_ref().err()),
        }
    }
    one.is_ok()
}

#[test]
fn one_degree_of_freedom_moves_alike_in_all_units() {
    let table = Table::new(vec![0.0, 0.25, 0.5, 4.0], vec![0.0, -2.0, 1.0, -1.0]).expect("a sound table");
    let scenes = [
        ("rigid walls", source(0.8, 0.4)),
        ("walls that keep", source(0.0, 0.0)),
        ("an elastic wall", elastic(3.0, 0.5)),
        ("a blow and a table", elastic(0.0, 1.0).with_load(Load::impulse(0.1, 0.3)).with_load(Load::table(table))),
        ("a start on a wall", source(0.8, 0.0).with_load(Load::constant(9.0)).with_initial(&[common::GAP], &[0.0])),
        ("a blow at the start", source(0.5, 0.5).with_load(Load::impulse(-0.2, 0.0))),
    ];
    for (name, scene) in scenes {
        for scheme in schemes() {
            assert!(is_one_run(&scene, scheme, two(-10), name), "{name}, {scheme}");
        }
    }
}

/// No gap and no displacement gives a length.
#[test]
fn a_body_that_starts_on_a_wall_at_0_moves_alike_in_all_units() {
    let wall = Wall::upper("stop", 0.0).with_restitution(0.5);
    let preload = Scene::oscillator(1.0, 0.1, 100.0).with_wall(wall.clone()).with_load(Load::constant(5.0));
    let ball = Scene::oscillator(2.0, 0.0, 0.0).with_wall(wall).with_load(Load::constant(9.0));
    let scenes = [
        ("a preload", preload.with_load(Load::harmonic(8.0, 3.0, 0.0))),
        ("a throw", ball.with_initial(&[0.0], &[-1.0])),
    ];
    // The φ² law needs a gap.
    let quartic = |scheme: &Scheme| matches!(scheme, Scheme::Penalty { law: PenaltyLaw::Quartic { .. }, .. });
    for (name, scene) in scenes {
        for scheme in schemes().into_iter().filter(|scheme| !quartic(scheme)) {
            assert!(is_one_run(&scene, scheme, two(-10), name), "{name}, {scheme}");
        }
    }
}

#[test]
fn structures_move_alike_in_all_units() {
    let mut ran = 0;
    for seed in 0..12 {
        let scene = random_scene(&mut Draws::new(seed)).with_duration(0.25);
        for scheme in schemes() {
            ran += usize::from(is_one_run(&scene, scheme, two(-10), &format!("seed {seed}")));
        }
    }
    // The φ² law needs walls that face each other, which few of them have; the other 11 of the 15
    // schemes run on nearly all.
    assert!(ran >= 100, "{ran}");
}

/// What is wrong with a run that a judge sees.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    /// All wall forces and impulses that the judge is shown are larger by this share.
    Pushed(f64),
    /// All velocities after a step are larger by this share.
    Fast(f64),
    /// All displacements are larger by this share.
    Far(f64),
    /// The judge's walls stand farther out by this share, and its springs are stiffer.
    Walls(f64),
    /// The judge's loads are larger by this share.
    Loads(f64),
}

/// Findings of a judge over `steps` steps, in the units given.
fn accused(scene: &Scene, scheme: Scheme, (h, steps): (f64, u32), fault: Fault, units: Units) -> Option<Vec<Finding>> {
    let mut other = scene.clone();
    if let Fault::Walls(share) = fault {
        for wall in &mut other.walls {
            *wall = wall.clone().with_position(wall.position() * (1.0 + share));
            if let WallLaw::Elastic { stiffness, .. } = &mut wall.law {
                *stiffness *= 1.0 + share;
            }
        }
    }
    if let Fault::Loads(share) = fault {
        for load in &mut other.loads {
            match &mut load.kind {
                LoadKind::Constant { force } => *force *= 1.0 + share,
                LoadKind::Harmonic { amplitude, .. } => *amplitude *= 1.0 + share,
                LoadKind::Impulse { impulse, .. } => *impulse *= 1.0 + share,
                _ => {}
            }
        }
    }
    let (scheme, h) = (units.scheme(scheme), h * units.time);
    let mut stepper = Stepper::new(&units.scene(scene), &scheme, h).ok()?;
    let mut judged = units.scene(&other);
    if let Scheme::Penalty { law, .. } = scheme {
        judged = judged.penalised(law).ok()?;
    }
    let state = stepper.state();
    let mut judge = Judge::new(&judged, stepper.contract(), h, &state.q, &state.v);
    let times = |values: &[f64], factor: f64| values.iter().map(|x| x * factor).collect::<Vec<_>>();
    let (push, fast, far) = match fault {
        Fault::Pushed(share) => (1.0 + share, 1.0, 1.0),
        Fault::Fast(share) => (1.0, 1.0 + share, 1.0),
        Fault::Far(share) => (1.0, 1.0, 1.0 + share),
        _ => (1.0, 1.0, 1.0),
    };
    for _ in 0..steps {
        let mut step = stepper.step().ok()?;
        let (q, v, after) = (times(step.q, far), times(step.v, fast), times(step.velocity_after, fast));
        let [impulse, jump, force] = [step.impulse, step.jump, step.force].map(|values| times(values, push));
        (step.q, step.v, step.velocity_after) = (&q, &v, &after);
        (step.impulse, step.jump, step.force) = (&impulse, &jump, &force);
        judge.observe(&step);
    }
    Some(judge.findings())
}

#[test]
fn a_fault_is_found_alike_in_all_units() {
    let mut scenes = vec![
        ("rigid walls".to_owned(), source(0.8, 0.4)),
        ("an elastic wall".into(), elastic(3.0, 0.5).with_load(Load::constant(1.0))),
        ("a blow".into(), elastic(0.0, 1.0).with_load(Load::impulse(0.1, 0.3))),
    ];
    for seed in 0..6 {
        let scene = random_scene(&mut Draws::new(seed)).with_duration(0.25);
        if !scene.walls.is_empty() {
            scenes.push((format!("seed {seed}"), scene));
        }
    }
    let faults = [Fault::Pushed(1e-3), Fault::Fast(1e-3), Fault::Far(1e-3), Fault::Walls(1e-2), Fault::Loads(1e-2)];
    let units = Units { length: 1.0, mass: 1.0, time: 1.0 };
    let (mut found, mut exact) = (0, 0);
    for (name, scene) in &scenes {
        for scheme in schemes().into_iter().chain([Scheme::Event]) {
            for fault in faults {
                let accused = |units| accused(scene, scheme, (two(-10), 200), fault, units);
                let Some(one) = accused(units) else { continue };
                for units in [Units::SMALL, Units::LARGE] {
                    let what = format!("{name}, {scheme}, {fault:?}, {units:?}");
                    let other = accused(units).unwrap_or_else(|| panic!("{what}: no run"));
                    assert_eq!(one.len(), other.len(), "{what}: {one:?}, in other units {other:?}");
                    for (one, other) in one.iter().zip(&other) {
                        let mut expected = one.clone();
                        expected.time_s *= units.time;
                        assert_eq!(*other, expected, "{what}");
                    }
                }
                found += one.len();
                exact += if scheme == Scheme::Event { one.len() } else { 0 };
            }
        }
    }
    assert!(found > 500 && exact > 20, "{found} findings, {exact} of them of exact motion");
}
