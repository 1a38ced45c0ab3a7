//! Several degrees of freedom: one written as matrices is the oscillator.

use signorini::linear::Symmetric;
use signorini::{Load, Options, Scene, Scheme, Structure, System, Wall, run};

fn source(e: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_load(Load::impulse(0.05, 0.3))
        .with_duration(1.0)
}

fn as_matrices(mut scene: Scene) -> Scene {
    let System::Oscillator(o) = scene.system else { return scene };
    let one = |x: f64| Symmetric::diagonal(&[x]);
    let structure = Structure { mass: one(o.mass), damping: one(o.damping), stiffness: one(o.stiffness) };
    scene.system = System::Structure(Box::new(structure));
    scene
}

#[test]
fn one_degree_of_freedom_as_matrices_is_the_oscillator() {
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::MoreauJean { theta: 0.75 }] {
        for scene in [source(0.8), source(0.0), {
            let mut s = source(0.5);
            s.walls[0] = Wall::upper("upper", 5e-3).with_elasticity(1e4, 3.0);
            s
        }] {
            let options = Options::with_step(1e-3);
            let a = run(&scene, &scheme, &options).unwrap();
            let b = run(&as_matrices(scene), &scheme, &options).unwrap();
            assert_eq!(a.trajectory.contacts().len(), b.trajectory.contacts().len());
            for (x, y) in a.trajectory.displacement().iter().zip(b.trajectory.displacement()) {
                // Some roundings of the gap, in another order.
                assert!((x - y).abs() < 1e-12 * 5e-3, "{scheme}: {x} {y}");
            }
            assert!(b.residuals.complementarity < 1e-12, "{:?}", b.residuals);
            assert!(b.residuals.force_balance < 1e-12, "{:?}", b.residuals);
            println!("{:?}", b.residuals.energy);
        }
    }
}
