//! Bodies in two planes for tests: scenes with round holes and flats, and sums over their steps.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use crate::random_structures::Draws;
use signorini::linear::Symmetric;
use signorini::{
    Face, Flat, Flats, Load, LoadKind, PlaneRows, Row, Scene, Scheme, Step, Stepper, Structure, Wall, WallLaw, heading,
};

pub const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// The place of a body whose coordinates are y and z.
pub fn body() -> PlaneRows {
    PlaneRows { y: Row::dof(0), z: Row::dof(1) }
}

/// A body of one place: M, c and k the same in both planes.
pub fn isotropic(mass: f64, damping: f64, stiffness: f64) -> Scene {
    Scene::structure(Structure {
        mass: Symmetric::diagonal(&[mass; 2]),
        damping: Symmetric::diagonal(&[damping; 2]),
        stiffness: Symmetric::diagonal(&[stiffness; 2]),
    })
}

/// A rigid round hole about the origin.
pub fn hole(name: &str, at: PlaneRows, gap: f64, restitution: f64, friction: f64) -> Wall {
    Wall::round(name, at, gap).with_restitution(restitution).with_friction(friction)
}

/// The scene with this hole, in a support of its name.
pub fn with(scene: Scene, hole: Wall) -> Scene {
    let Face::Round { at, centre, .. } = &hole.face else { panic!("{hole:?}") };
    let (name, at, centre) = (hole.name.clone(), at.clone(), *centre);
    scene.with_support(&name, at, centre, vec![hole])
}

/// Makes another hole of the one of support number `support`, at the same index among the walls.
pub fn change_hole(scene: &mut Scene, support: usize, change: impl FnOnce(Wall) -> Wall) {
    let support = &mut scene.supports[support];
    let wall = &mut scene.walls[support.walls.start];
    *wall = change(wall.clone());
    let Face::Round { at, centre, .. } = &wall.face else { panic!("{wall:?}") };
    (support.name, support.at, support.centre) = (wall.name.clone(), at.clone(), *centre);
}

/// The scene with flats in these directions (degrees) at these gaps (m).
pub fn with_flats(scene: Scene, name: &str, at: PlaneRows, flats: &[(f64, f64)], e: f64, friction: f64) -> Scene {
    let flats = Flats {
        name: name.to_owned(),
        at,
        flats: flats.iter().map(|&(direction, gap)| Flat { direction, gap }).collect(),
        centre: [0.0, 0.0],
        law: WallLaw::Rigid { restitution: e },
        friction: friction.into(),
    };
    let walls = flats.walls().expect("flats");
    scene.with_support(name, flats.at, flats.centre, walls)
}

pub fn load(kind: Load, row: Row) -> Load {
    Load { at: row, ..kind }
}

/// `amplitude` (cos, sin)(2π `frequency` t).
pub fn rotating(scene: Scene, amplitude: f64, frequency: f64) -> Scene {
    scene
        .with_load(load(Load::harmonic(amplitude, frequency, std::f64::consts::FRAC_PI_2), Row::dof(0)))
        .with_load(load(Load::harmonic(amplitude, frequency, 0.0), Row::dof(1)))
}

/// Random masses in two planes, coupled by random matrices, in holes and between flats, from a
/// random start, with this friction everywhere.
pub fn random_scene(draws: &mut Draws, friction: f64) -> Scene {
    let n = 2 * (1 + draws.below(4));
    // A Gram matrix of random vectors, plus a diagonal: positive definite.
    let mut gram = |own: f64, scale: f64| {
        let x: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| draws.between(-1.0, 1.0)).collect()).collect();
        let entry = |i: usize, j: usize| -> f64 { x.iter().map(|row| row[i] * row[j]).sum::<f64>() };
        let all = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let entries = all.map(|(i, j)| (i, j, scale * (entry(i, j) + if i == j { own } else { 0.0 })));
        Symmetric::from_entries(n, entries.collect::<Vec<_>>())
    };
    let (mass, stiffness) = (gram(0.3, 1.0), gram(0.0, 300.0));
    let mut scene = Scene::structure(Structure { mass, damping: Symmetric::diagonal(&vec![0.0; n]), stiffness });
    for index in 0..1 + draws.below(3) {
        let mut row = || Row::new((0..n).map(|i| (i, draws.between(-1.0, 1.0))).collect());
        let at = PlaneRows { y: row(), z: row() };
        let (name, gap) = (format!("support-{index}"), draws.between(0.5e-3, 2e-3));
        let e = [0.0, 1.0, draws.unit()][draws.below(3)];
        if draws.chance(0.6) {
            scene = with(scene, hole(&name, at, gap, e, friction));
        } else {
            let turn = draws.between(0.0, 360.0);
            let flats: Vec<(f64, f64)> = (0..3 + draws.below(3)).map(|k| (turn + 73.0 * k as f64, gap)).collect();
            scene = with_flats(scene, &name, at, &flats, e, friction);
        }
    }
    // Flats alone are no scene with supports.
    scene = with(scene, hole("wide", body(), 5e-3, draws.unit(), friction));
    let v: Vec<f64> = (0..n).map(|_| draws.between(-0.3, 0.3)).collect();
    scene.with_initial(&vec![0.0; n], &v)
}

/// What contacts did over a run.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sums {
    /// Σp, N s.
    pub impulse: f64,
    /// Σ p(|v_t⁻| + |v_t⁺|)/2: the work of wear, J, where v_t keeps its sign in every step.
    pub work: f64,
    /// Work of friction, J.
    pub friction: f64,
    /// Σ h|v_t| while pushing, m.
    pub sliding: f64,
    /// Steps in which something pushed after one in which nothing did.
    pub arrivals: u32,
    pub pushed: bool,
}

impl Sums {
    /// Adds all contacts of a step of `scene`.
    pub fn observe(&mut self, scene: &Scene, step: &Step<'_>) {
        let mut pushed = false;
        for support in &scene.supports {
            let contacts = support.members(&scene.walls).map(|(index, wall)| {
                let (normal, p) = match wall.face {
                    Face::Flat { direction, .. } => {
                        (heading(direction.expect("a flat of a support")), step.impulse[index].abs())
                    }
                    Face::Round { .. } => (step.normal[index], step.impulse[index]),
                };
                (normal, p, step.friction[index])
            });
            let rates = [step.velocity_before, step.velocity_after].map(|v| support.at.dot(v));
            for ([y, z], p, f) in contacts.filter(|contact| contact.1 > 0.0) {
                let [before, after] = rates.map(|[vy, vz]| vz * y - vy * z);
                self.impulse += p;
                self.work += 0.5 * p * (before.abs() + after.abs());
                self.friction -= 0.5 * f * (before + after);
                self.sliding += 0.5 * (step.end - step.start) * (before.abs() + after.abs());
                pushed = true;
            }
        }
        self.arrivals += u32::from(pushed && !self.pushed);
        self.pushed = pushed;
    }
}

/// `steps` steps of `h` seconds by moreau-jean, each shown to `observe`.
pub fn follow(scene: &Scene, h: f64, steps: u64, mut observe: impl FnMut(&Step<'_>)) -> Stepper {
    let mut stepper = Stepper::new(scene, &MOREAU_JEAN, h).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..steps {
        observe(&stepper.step().unwrap_or_else(|error| panic!("{error}")));
    }
    stepper
}

/// Kinetic and strain energy, J.
pub fn energy(scene: &Scene, q: &[f64], v: &[f64]) -> f64 {
    0.5 * (scene.system.mass_form(v, v) + scene.system.stiffness_form(q, q))
}

/// The scene turned by `degrees`: flats, holes, loads, centres and start. All its walls are those
/// of supports.
pub fn turned(scene: &Scene, degrees: f64) -> Scene {
    let [c, s] = heading(degrees);
    let turn = |[y, z]: [f64; 2]| [c * y - s * z, s * y + c * z];
    let both = |x: &[f64]| {
        // Degrees of freedom 2k and 2k + 1 are y and z of one mass.
        x.chunks_exact(2).flat_map(|pair| turn([pair[0], pair[1]])).collect::<Vec<f64>>()
    };
    let mut other = scene.clone();
    (other.initial.q, other.initial.v) = (both(&scene.initial.q), both(&scene.initial.v));
    assert!((0..scene.walls.len()).all(|wall| scene.support_of(wall).is_some()));
    for support in &mut other.supports {
        support.centre = turn(support.centre);
        for wall in &mut other.walls[support.walls.clone()] {
            let direction = match &mut wall.face {
                Face::Flat { direction, .. } => direction.expect("a flat of a support") + degrees,
                Face::Round { centre, .. } => {
                    *centre = support.centre;
                    continue;
                }
            };
            let turned = Flats {
                name: wall.name.clone(),
                at: support.at.clone(),
                flats: vec![Flat { direction, gap: wall.gap(0.0).abs() }],
                centre: support.centre,
                law: wall.law,
                friction: wall.friction,
            };
            *wall = turned.walls().expect("a flat").remove(0);
        }
    }
    // Loads on y and z at once: their rows turn.
    for load in &mut other.loads {
        assert!(!matches!(load.kind, LoadKind::Function(_)));
        let n = scene.initial.q.len();
        let mut weights = vec![0.0; n];
        for &(i, weight) in load.at.entries() {
            weights[i] += weight;
        }
        load.at = Row::new(both(&weights).into_iter().enumerate().collect());
    }
    other
}
