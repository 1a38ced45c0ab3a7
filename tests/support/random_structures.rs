//! Structures for tests: chains, and random ones with random walls.
#![allow(dead_code, reason = "each test binary uses a part of it")]

use signorini::linear::Symmetric;
use signorini::{Load, Row, Scene, Structure, Wall};

/// Numbers drawn one after the other from a seed (a linear congruential generator, Knuth's
/// multiplier).
pub struct Draws(u64);

impl Draws {
    pub fn new(seed: u64) -> Self {
        let mut draws = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5DEE_CE66);
        draws.unit();
        draws.unit();
        draws
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        ((self.unit() * n as f64) as usize).min(n - 1)
    }

    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

/// A scene at rest with these matrices, without walls, for one second.
pub fn scene(mass: Symmetric, damping: Symmetric, stiffness: Symmetric) -> Scene {
    let n = mass.size();
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0);
    scene.system = Structure { mass, damping, stiffness }.into();
    scene.with_initial(&vec![0.0; n], &vec![0.0; n])
}

/// A chain of `n` masses of 1 kg, springs of `k` (N/m) between neighbours and to both ends, and
/// damping `beta` (s) times the stiffness.
pub fn chain(n: usize, k: f64, beta: f64) -> Scene {
    let stiffness = |k: f64| {
        let between = (1..n).map(move |i| (i, i - 1, -k));
        Symmetric::from_entries(n, (0..n).map(move |i| (i, i, 2.0 * k)).chain(between))
    };
    scene(Symmetric::diagonal(&vec![1.0; n]), stiffness(beta * k), stiffness(k))
}

/// The wall on another place.
pub fn at(wall: Wall, row: Row) -> Wall {
    wall.at(row)
}

/// The load on another place.
pub fn on(mut load: Load, dof: usize) -> Load {
    load.at = Row::dof(dof);
    load
}

/// D + Bᵀ B with B of `rank` random rows: definite with `least` > 0, else semidefinite.
fn gram(draws: &mut Draws, n: usize, rank: usize, least: f64, size: f64) -> Symmetric {
    let rows: Vec<Vec<f64>> = (0..rank).map(|_| (0..n).map(|_| draws.between(-1.0, 1.0)).collect()).collect();
    let mut entries = Vec::new();
    for i in 0..n {
        for j in 0..=i {
            let dot: f64 = rows.iter().map(|row| row[i] * row[j]).sum();
            entries.push((i, j, size * dot + if i == j { least } else { 0.0 }));
        }
    }
    Symmetric::from_entries(n, entries)
}

/// A structure of 1 to 8 degrees of freedom with up to 6 walls and some loads.
pub fn random_scene(draws: &mut Draws) -> Scene {
    let n = 1 + draws.below(8);
    let mass = match draws.below(3) {
        0 => Symmetric::diagonal(&(0..n).map(|_| draws.between(0.5, 3.0)).collect::<Vec<_>>()),
        1 => gram(draws, n, n, 0.5, 1.0),
        _ => Symmetric::diagonal(&vec![1.0; n]),
    };
    // Free bodies and mechanisms are among them.
    let rank = draws.below(n + 2);
    let size = 10_f64.powf(draws.between(1.0, 4.0));
    let stiffness = gram(draws, n, rank, 0.0, size);
    let damping = match draws.below(3) {
        0 => Symmetric::zeros(n),
        1 => Symmetric::sum(&[(draws.between(0.0, 1.0), &mass), (draws.between(0.0, 1e-3), &stiffness)]),
        _ => {
            let rank = draws.below(n + 1);
            let size = draws.between(0.0, 3.0);
            gram(draws, n, rank, 0.0, size)
        }
    };
    let mut scene = scene(mass, damping, stiffness);
    for index in 0..draws.below(7) {
        let wall = random_wall(draws, &scene, index, n);
        scene = scene.with_wall(wall);
    }
    let velocity: Vec<f64> = (0..n).map(|_| draws.between(-0.3, 0.3)).collect();
    scene = scene.with_initial(&vec![0.0; n], &velocity);
    for _ in 0..draws.below(4) {
        let load = match draws.below(3) {
            0 => Load::constant(draws.between(-10.0, 10.0)),
            1 => Load::harmonic(draws.between(0.0, 20.0), draws.between(0.5, 20.0), draws.between(0.0, 3.0)),
            _ => Load::impulse(draws.between(-0.3, 0.3), draws.between(0.0, 0.2)),
        };
        scene = scene.with_load(on(load, draws.below(n)));
    }
    scene
}

fn random_wall(draws: &mut Draws, scene: &Scene, index: usize, n: usize) -> Wall {
    let name = format!("w{index}");
    // A duplicate, a little looser or at the very place, with another law.
    let copied =
        (!scene.walls.is_empty() && draws.chance(0.2)).then(|| scene.walls[draws.below(scene.walls.len())].clone());
    let row = match draws.below(3) {
        0 if n > 1 => {
            let first = draws.below(n);
            Row::new(vec![
                (first, 1.0),
                ((first + 1 + draws.below(n - 1)) % n, -draws.between(0.3, 1.0).round().max(0.5)),
            ])
        }
        1 if n > 2 => Row::new((0..3).map(|i| (i, draws.between(-1.0, 1.0))).collect()),
        _ => Row::dof(draws.below(n)),
    };
    let gap = if draws.chance(0.1) { 0.0 } else { draws.between(1e-4, 6e-3) };
    let wall = if draws.chance(0.5) { Wall::upper(&name, gap) } else { Wall::lower(&name, -gap) };
    let mut wall = at(wall, row);
    if let Some(other) = copied {
        wall = Wall { name: wall.name, ..other };
        if draws.chance(0.5) {
            let position = wall.position() - wall.side().sign() * 1e-3 * draws.unit();
            wall = wall.with_position(position);
        }
    }
    match draws.below(4) {
        0 => {
            let stiffness = 10_f64.powf(draws.between(2.0, 4.5));
            let damping = if draws.chance(0.5) { draws.between(0.0, 5.0) } else { 0.0 };
            wall.with_elasticity(stiffness, damping)
        }
        1 => wall.with_restitution(draws.below(2) as f64),
        _ => wall.with_restitution(draws.unit()),
    }
}
