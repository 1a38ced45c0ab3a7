//! How deep a run says that it went into elastic walls.

use signorini::{Chain, Damping, Load, Options, Scene, Scheme, Wall, run};

/// A spring pushes with its stiffness times the depth: the exact scheme finds the largest force at
/// its instant, the judge the depth by itself. Both are exact to rounding of the place, some 1e-16
/// of the motion of 1e-2 m, where the depths are 1e-4 m and more.
#[test]
fn exact_motion_is_as_deep_as_the_force_of_its_springs_says() {
    let walls = |scene: Scene| {
        scene
            .with_wall(Wall::upper("upper", 3e-3).with_elasticity(2e4, 0.0))
            .with_wall(Wall::lower("lower", -2e-3).with_elasticity(3e5, 0.0))
            .with_load(Load::harmonic(6.0, 3.7, 0.4))
            .with_duration(2.0)
    };
    let chain = Chain { masses: vec![1.0, 0.5, 2.0], springs: vec![900.0, 400.0], grounds: [500.0, 0.0] };
    let damping = Damping::Rayleigh { mass: 0.3, stiffness: 1e-4 };
    let chain = chain.structure().and_then(|chain| chain.with_damping(&damping)).unwrap();
    for scene in [walls(Scene::oscillator(1.0, 0.3, 100.0)), walls(Scene::structure(chain))] {
        let run = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).unwrap();
        assert_eq!(run.findings, []);
        for (index, (wall, depth)) in scene.walls.iter().zip(&run.residuals.depth_m).enumerate() {
            let peaks = run.trajectory.contacts().iter().filter(|contact| contact.wall == index);
            let largest = peaks.filter_map(|contact| contact.peak_force).fold(0.0, f64::max);
            let expected = largest / wall.law.spring().unwrap().stiffness;
            assert!(*depth > 1e-4 && (depth / expected - 1.0).abs() < 1e-11, "{}: {depth} {expected}", wall.name);
        }
    }
}
