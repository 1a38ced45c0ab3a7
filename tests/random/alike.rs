//! Scenes that say the same in another way move alike: seen in a mirror, with their walls and loads
//! in the other order, and with each load in two halves. What scheme and judge both have wrong in
//! one of them no residual shows.
//!
//! `SIGNORINI_CASES` and `SIGNORINI_SEED` as for the other tests.

use crate::draws;
use crate::random_scenes::{Units, random_scene};
use signorini::{Face, Load, Options, Row, Scene, Scheme, Side, run};

/// Steps of the scene's own length that are compared: roundings have little time to grow.
const STEPS: f64 = 15.0;

fn scaled(row: &Row, by: f64) -> Row {
    Row::new(row.entries().iter().map(|&(i, weight)| (i, by * weight)).collect())
}

fn with_loads(scene: &Scene, by: f64) -> impl Iterator<Item = Load> {
    scene.loads.iter().map(move |load| Load { at: scaled(&load.at, by), ..load.clone() })
}

/// The scene with all displacements and forces of the other sign.
fn mirrored(scene: &Scene) -> Scene {
    let mut mirrored = scene.clone();
    mirrored.loads = with_loads(scene, -1.0).collect();
    for wall in &mut mirrored.walls {
        if let Face::Flat { side, position, .. } = &mut wall.face {
            *side = if *side == Side::Upper { Side::Lower } else { Side::Upper };
            *position = -*position;
        }
    }
    for x in mirrored.initial.q.iter_mut().chain(&mut mirrored.initial.v) {
        *x = -*x;
    }
    mirrored
}

/// The scene with its walls and loads in the other order.
fn reversed(scene: &Scene) -> Scene {
    let mut reversed = scene.clone();
    reversed.walls.reverse();
    reversed.loads.reverse();
    reversed
}

/// The scene with each load in two halves.
fn halved(scene: &Scene) -> Scene {
    let mut halved = scene.clone();
    halved.loads = with_loads(scene, 0.5).chain(with_loads(scene, 0.5)).collect();
    halved
}

#[test]
fn scenes_that_say_the_same_move_alike() {
    let (first, cases) = (draws::seed(41_000_000), draws::cases(150_u64));
    let (mut compared, mut apart) = (0_u64, 0_u64);
    for seed in first..first + cases {
        let drawn = random_scene(seed, Units::Ordinary);
        let mut scene = drawn.scene;
        scene.duration = drawn.step * (scene.duration / drawn.step).round().min(STEPS);
        // Supports own walls by their numbers, and turn with the planes.
        let plane = scene.supports.is_empty() && scene.walls.iter().all(|wall| !wall.is_round());
        let variants = [
            ("loads in halves", 1.0, Some(halved(&scene))),
            ("in a mirror", -1.0, plane.then(|| mirrored(&scene))),
            ("in the other order", 1.0, plane.then(|| reversed(&scene))),
        ];
        for scheme in [Scheme::Located, Scheme::MoreauJean { theta: 0.5 }] {
            let end = |scene: &Scene| {
                let run = run(scene, &scheme, &Options::with_step(drawn.step)).ok()?;
                run.findings.is_empty().then_some(run.state.q)
            };
            let Some(own) = end(&scene) else { continue };
            let size = own.iter().chain(&scene.initial.q).fold(scene.gap_scale(), |size, x| size.max(x.abs()));
            for (how, sign, variant) in &variants {
                let Some(variant) = variant else { continue };
                compared += 1;
                let error = end(variant).map_or(f64::INFINITY, |q| {
                    q.iter().zip(&own).map(|(q, own)| (q - sign * own).abs() / size).fold(0.0, f64::max)
                });
                // Rounding, 1e-16, grows at each of some tens of impacts.
                if error > 1e-8 {
                    apart += 1;
                    println!("seed {seed}, {scheme}, step {:e}, {how}: {error:.1e}", drawn.step);
                    if cases == 1 {
                        println!("{scene:?}");
                    }
                }
            }
        }
    }
    println!("{compared} pairs of {cases} scenes compared, {apart} apart");
    assert!(compared > 2 * cases && 100 * apart < compared, "{apart} of {compared} apart");
}
