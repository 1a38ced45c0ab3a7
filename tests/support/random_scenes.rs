//! Random scenes of every kind, in ordinary units and in wild ones: one degree of freedom, masses
//! between walls on rows of several, bodies in two planes in holes and between flats, under loads
//! of every kind, from starts at rest, on a wall and fast.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use crate::random_structures::{self, Draws};
use crate::rubbing;
use signorini::linear::Symmetric;
use signorini::{
    Density, Face, FrictionCoefficients, Integrator, Load, LoadKind, PenaltyLaw, RandomForce, Scene, Scheme, Structure,
    System, Table, Wall, WallLaw,
};
use std::f64::consts::TAU;

/// A random scene, the step (s) at which schemes on a grid are to run it, and the schemes to try:
/// each of them may refuse it.
#[derive(Debug)]
pub struct Drawn {
    pub scene: Scene,
    pub step: f64,
    pub schemes: Vec<Scheme>,
}

/// The quantities of a draw are those of ordinary machines, or each is multiplied by up to 1e±9.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    Ordinary,
    Wild,
}

/// Of every 32 scenes the one whose flat walls leave no gap.
const SNUG: u64 = 3;

/// The scene of this seed.
pub fn random_scene(seed: u64, units: Units) -> Drawn {
    let draws = &mut Draws::new(seed);
    let mut scene = match draws.below(4) {
        0 | 1 => oscillator(draws),
        2 => random_structures::random_scene(draws),
        _ => {
            let friction = [0.0, draws.between(0.05, 0.8)][draws.below(2)];
            let mut scene = rubbing::random_scene(draws, friction);
            // A draw of its own where there is friction leaves the rest of the scene as it was
            // before elastic walls had friction.
            if friction > 0.0 {
                soften(&mut Draws::new(!seed), &mut scene);
                drop_friction(&mut Draws::new(!seed.rotate_left(32)), &mut scene);
            } else {
                soften(draws, &mut scene)
            }
            scene
        }
    };
    // Draws of their own, of seeds that never were refuted, leave the rest of the scene as it is.
    if seed % 16 == 5 && scene.supports.is_empty() {
        bend(&mut Draws::new(!seed.rotate_left(16)), &mut scene);
    }
    if seed % 32 == SNUG {
        close(&mut Draws::new(!seed.rotate_left(48)), &mut scene);
    }
    let fastest = fastest(&scene.system);
    // 3 to 300 steps in a period of the fastest vibration; a free body takes that of 10 Hz.
    let step = if fastest > 0.0 { TAU / fastest } else { 0.1 } / 10_f64.powf(draws.between(0.5, 2.5));
    let steps = if draws.chance(0.01) { 2000 } else { 40 + draws.below(260) };
    scene.duration = step * steps as f64;
    load(draws, &mut scene, step);
    start(draws, &mut scene);
    equilibrate(draws, &mut scene);
    let schemes = schemes(draws, &scene);
    let mut drawn = Drawn { scene, step, schemes };
    if units == Units::Wild {
        in_wild_units(draws, &mut drawn);
    }
    drawn
}

/// A mass of 10 g to 100 kg at 0.1 to 300 Hz, or free, with up to four walls.
fn oscillator(draws: &mut Draws) -> Scene {
    let log = |draws: &mut Draws, from: f64, to: f64| 10_f64.powf(draws.between(from, to));
    let mass = log(draws, -2.0, 2.0);
    let omega = TAU * log(draws, -1.0, 2.5);
    let stiffness = if draws.chance(0.15) { 0.0 } else { mass * omega * omega };
    let ratio = match draws.below(4) {
        0 => 0.0,
        1 | 2 => draws.between(0.0, 0.05),
        _ => draws.between(0.0, 2.0),
    };
    let mut scene = Scene::oscillator(mass, 2.0 * ratio * mass * omega, stiffness);
    let gap = log(draws, -5.0, -1.0);
    for index in 0..draws.below(5) {
        let upper = if index < 2 { index == 0 } else { draws.chance(0.5) };
        let away = if draws.chance(0.1) { 0.0 } else { gap * draws.between(0.5, 2.0) };
        let away = match scene.walls.last() {
            // At the place of the wall before, or at the same distance on the other side.
            Some(last) if draws.chance(0.15) => last.position().abs(),
            _ => away,
        };
        let name = format!("w{index}");
        let wall = if upper { Wall::upper(&name, away) } else { Wall::lower(&name, -away) };
        let contact = omega * log(draws, -0.5, 2.5);
        scene = scene.with_wall(match draws.below(8) {
            0 | 1 => {
                let damping = [0.0, draws.between(0.0, 2.0) * mass * contact][draws.below(2)];
                wall.with_elasticity(mass * contact * contact, damping)
            }
            2 => Wall { law: WallLaw::Quartic { epsilon: gap * gap / (mass * contact * contact), span: gap }, ..wall },
            3 => wall.with_restitution(0.0),
            4 => wall.with_restitution(1.0),
            _ => wall.with_restitution(draws.unit()),
        });
    }
    scene
}

/// Gives some of the walls the law of Hunt and Crossley, as stiff at the depth of the gap as an
/// elastic wall may be.
fn bend(draws: &mut Draws, scene: &mut Scene) {
    let (gap, omega) = (scene.gap_scale(), fastest(&scene.system).max(TAU));
    let masses = scene.wall_masses();
    for (wall, mass) in scene.walls.iter_mut().zip(masses).filter(|(_, mass)| *mass > 0.0 && mass.is_finite()) {
        if draws.chance(0.6) {
            let contact = omega * 10_f64.powf(draws.between(-0.5, 2.5));
            let exponent = [1.0, 1.5, draws.between(1.0, 3.0)][draws.below(3)];
            let stiffness = mass * contact * contact * gap.powf(1.0 - exponent);
            let dissipation = [0.0, draws.between(0.0, 2.0) / (gap * omega)][draws.below(2)];
            *wall = wall.clone().with_hunt_crossley(stiffness, exponent, dissipation);
        }
    }
}

/// Puts the flat walls to 0, where bodies start: most of them, or all.
fn close(draws: &mut Draws, scene: &mut Scene) {
    let share = [0.7, 1.0, 1.0][draws.below(3)];
    for wall in scene.walls.iter_mut().filter(|wall| !wall.is_round()) {
        if draws.chance(share) {
            *wall = wall.clone().with_position(0.0);
        }
    }
}

/// Makes some of the holes elastic; where there is friction, some of the flats too.
fn soften(draws: &mut Draws, scene: &mut Scene) {
    for wall in scene.walls.iter_mut().filter(|wall| wall.is_round() || wall.friction.acts()) {
        if draws.chance(0.2) {
            let damping = [0.0, draws.between(0.0, 20.0)][draws.below(2)];
            wall.law = WallLaw::Elastic { stiffness: 10_f64.powf(draws.between(2.0, 5.0)), damping };
        }
    }
}

/// Gives a quarter of the scenes static coefficients above the kinetic ones, some of which are 0.
fn drop_friction(draws: &mut Draws, scene: &mut Scene) {
    if draws.chance(0.25) {
        let (more, share) = (draws.between(1.0, 3.0), [1.0, 1.0, 0.0][draws.below(3)]);
        for wall in &mut scene.walls {
            let friction = wall.friction.sliding;
            wall.friction = FrictionCoefficients { sticking: more * friction, sliding: share * friction };
        }
    }
}

/// The largest √(Kᵢᵢ/Mᵢᵢ), rad/s.
fn fastest(system: &System) -> f64 {
    let structure = system.structure();
    let (m, k) = (structure.mass.diagonal_entries(), structure.stiffness.diagonal_entries());
    k.iter().zip(&m).map(|(k, m)| (k / m).sqrt()).fold(0.0, f64::max)
}

/// Adds up to three loads of any kind, of the size that moves the body by some gaps.
fn load(draws: &mut Draws, scene: &mut Scene, step: f64) {
    let masses = scene.system.structure().mass.diagonal_entries();
    let end = scene.duration;
    for _ in 0..draws.below(4) {
        let dof = draws.below(masses.len());
        let omega = TAU / end * draws.between(0.5, 20.0);
        let size = masses[dof] * scene.gap_scale() * omega * omega * 10_f64.powf(draws.between(-2.0, 2.0));
        let frequency = omega / TAU;
        let load = match draws.below(7) {
            0 => Load::constant(if draws.chance(0.5) { size } else { -size }),
            1 | 2 => Load::harmonic(size, frequency, draws.between(0.0, TAU)),
            3 => {
                // On a step, between two, or at the start.
                let at = draws.below(30) as f64 * step;
                let time = if draws.chance(0.5) { at } else { at + step * draws.unit() };
                Load::impulse(size / omega * draws.between(-1.0, 1.0), time)
            }
            4 => table(draws, size, end),
            5 => {
                let band = Density::Flat { rms: size, from: 1.0 / end, to: 10.0 / end };
                let force = RandomForce { density: band, seed: draws.below(1000) as u64, stream: 0 };
                force.load(end).expect("a band of ten lines")
            }
            _ => {
                // The base moves: every mass feels its own share.
                for (other, mass) in masses.iter().enumerate() {
                    let share = Load::harmonic(size * mass / masses[dof], frequency, 0.0);
                    scene.loads.push(random_structures::on(share, other));
                }
                continue;
            }
        };
        scene.loads.push(random_structures::on(load, dof));
    }
}

/// Up to 20 rows, from 0 to 0 and to the end or beyond.
fn table(draws: &mut Draws, size: f64, end: f64) -> Load {
    let rows = 3 + draws.below(18);
    let last = end * draws.between(0.5, 1.5);
    let time = (0..rows).map(|i| last * i as f64 / (rows - 1) as f64).collect();
    let force = (0..rows).map(|i| if i == 0 || i == rows - 1 { 0.0 } else { size * draws.between(-1.0, 1.0) });
    Load::table(Table::new(time, force.collect()).expect("rows in order"))
}

/// At rest, at rest on a wall, or moving by up to some gaps in a period.
fn start(draws: &mut Draws, scene: &mut Scene) {
    let n = scene.initial.q.len();
    let speed = scene.gap_scale() * TAU / scene.duration * [0.0, 1.0, 10.0, 100.0, 1e4][draws.below(5)];
    scene.initial.v = (0..n).map(|_| speed * draws.between(-1.0, 1.0)).collect();
    let rigid = |wall: &&Wall| wall.law.is_rigid();
    if n == 1 && draws.chance(0.3) && !scene.walls.is_empty() {
        let lowest = scene.walls.iter().filter(rigid).filter(|w| w.side().sign() < 0.0).map(|w| w.position());
        let highest = scene.walls.iter().filter(rigid).filter(|w| w.side().sign() > 0.0).map(|w| w.position());
        let (upper, lower) = (lowest.fold(f64::INFINITY, f64::min), highest.fold(f64::NEG_INFINITY, f64::max));
        let wall = &scene.walls[draws.below(scene.walls.len())];
        scene.initial.q = vec![wall.position().clamp(lower.min(upper), upper)];
        if draws.chance(0.5) {
            scene.initial.v = vec![0.0];
        }
    } else if n == 1 && draws.chance(0.5) && scene.walls.iter().all(|wall| wall.position() != 0.0) {
        let least = scene.walls.iter().map(|wall| wall.position().abs()).fold(f64::INFINITY, f64::min);
        scene.initial.q = vec![least.min(1e-2) * draws.between(-1.0, 1.0)];
    }
}

/// Some scenes start in the balance of a constant load, with a wall that just touches or is pressed
/// from the first instant.
fn equilibrate(draws: &mut Draws, scene: &mut Scene) {
    let System::Oscillator(o) = scene.system else { return };
    if scene.walls.is_empty() || draws.chance(0.9) {
        return;
    }
    let wall = &scene.walls[draws.below(scene.walls.len())];
    let more = [0.0, 1.0, -1.0][draws.below(3)] * draws.unit();
    let load = Load::constant(o.stiffness * wall.position() * (1.0 + more));
    scene.loads = vec![load];
    if draws.chance(0.5) {
        scene.loads.push(Load::impulse(o.mass * scene.gap_scale() / scene.duration, 0.0));
    }
}

/// Every scheme with some of its options.
fn schemes(draws: &mut Draws, scene: &Scene) -> Vec<Scheme> {
    let mut all = vec![
        Scheme::ImplicitEuler,
        Scheme::PaoliSchatzman,
        Scheme::MoreauJean { theta: 0.5 },
        Scheme::Located,
        Scheme::MoreauJean { theta: draws.between(0.5, 1.0) },
        Scheme::GeneralizedAlpha { rho: [0.0, 0.8, 1.0, draws.unit()][draws.below(4)] },
        Scheme::Newmark,
        Scheme::Event,
    ];
    let heaviest = scene.system.structure().mass.diagonal_entries().into_iter().fold(0.0, f64::max);
    let contact = fastest(&scene.system).max(TAU * 10.0) * 10_f64.powf(draws.between(-0.5, 3.0));
    let stiffness = heaviest * contact * contact;
    let damping = [0.0, draws.between(0.0, 2.0) * heaviest * contact][draws.below(2)];
    for integrator in Integrator::ALL {
        all.push(Scheme::Penalty { law: PenaltyLaw::Linear { stiffness, damping }, integrator });
    }
    let gap = scene.gap_scale();
    let law = PenaltyLaw::Quartic { epsilon: gap * gap / stiffness };
    all.push(Scheme::Penalty { law, integrator: Integrator::ALL[draws.below(Integrator::ALL.len())] });
    if scene.walls.iter().all(|wall| matches!(wall.law, WallLaw::HuntCrossley { .. })) && !scene.walls.is_empty() {
        all.extend(Integrator::ALL.map(|integrator| Scheme::Penalty { law: PenaltyLaw::None, integrator }));
    }
    all
}

/// The scene in other units of length, mass and time, 1e-9 to 1e9 of the SI ones; half of the draws
/// multiply single quantities besides.
fn in_wild_units(draws: &mut Draws, drawn: &mut Drawn) {
    let mut factor = || 10_f64.powf(draws.between(-9.0, 9.0));
    let (length, mass, time) = (factor(), factor(), factor());
    let single = draws.chance(0.5);
    let own = |draws: &mut Draws| if single && draws.chance(0.2) { 10_f64.powf(draws.between(-9.0, 9.0)) } else { 1.0 };
    let (force, rate, spring) = (mass * length / (time * time), mass / time, mass / (time * time));
    let scene = &mut drawn.scene;
    match &mut scene.system {
        System::Oscillator(o) => {
            o.mass *= mass * own(draws);
            o.damping *= rate * own(draws);
            o.stiffness *= spring * own(draws);
        }
        System::Structure(s) => {
            let by = |factor: f64, matrix: &Symmetric| Symmetric::sum(&[(factor, matrix)]);
            let structure = Structure {
                mass: by(mass * own(draws), &s.mass),
                damping: by(rate * own(draws), &s.damping),
                stiffness: by(spring * own(draws), &s.stiffness),
            };
            scene.system = structure.into();
        }
        _ => {}
    }
    let law = |draws: &mut Draws, law: &mut WallLaw| match law {
        WallLaw::Elastic { stiffness, damping } => {
            *stiffness *= spring * own(draws);
            *damping *= rate * own(draws);
        }
        WallLaw::Quartic { epsilon, span } => {
            *epsilon *= length * length / spring * own(draws);
            *span *= length;
        }
        WallLaw::HuntCrossley { stiffness, exponent, dissipation } => {
            *stiffness *= force / length.powf(*exponent) * own(draws);
            *dissipation *= time / length;
        }
        _ => {}
    };
    for round in [false, true] {
        for wall in scene.walls.iter_mut().filter(|wall| wall.is_round() == round) {
            *wall = wall.clone().with_position(wall.position() * (length * own(draws)));
            law(draws, &mut wall.law);
            if let Face::Round { centre, .. } = &mut wall.face {
                *centre = centre.map(|x| x * length);
            }
        }
    }
    for support in &mut scene.supports {
        support.centre = support.centre.map(|x| x * length);
    }
    for load in &mut scene.loads {
        let strength = force * own(draws);
        match &mut load.kind {
            LoadKind::Constant { force } => *force *= strength,
            LoadKind::Harmonic { amplitude, frequency, .. } => {
                *amplitude *= strength;
                *frequency *= own(draws) / time;
            }
            LoadKind::Impulse { impulse, time: at } => {
                *impulse *= strength * time;
                *at *= time;
            }
            LoadKind::Table(table) => {
                let at = table.time().iter().map(|t| t * time).collect();
                let forces = table.force().iter().map(|f| f * strength).collect();
                if let Ok(other) = Table::new(at, forces) {
                    *table = other;
                }
            }
            _ => {}
        }
    }
    scene.initial.q.iter_mut().for_each(|q| *q *= length);
    let speed = length / time * own(draws);
    scene.initial.v.iter_mut().for_each(|v| *v *= speed);
    let pace = time * own(draws);
    drawn.step *= pace;
    scene.duration *= pace;
    for scheme in &mut drawn.schemes {
        if let Scheme::Penalty { law, .. } = scheme {
            match law {
                PenaltyLaw::Linear { stiffness, damping } => {
                    *stiffness *= spring;
                    *damping *= rate;
                }
                PenaltyLaw::Quartic { epsilon } => *epsilon *= length * length / spring,
                _ => {}
            }
        }
    }
}
