//! What is recorded of round holes and friction: the momentum of a whole run, and the first row.

use crate::recorded_momentum::momentum;
use crate::rubbing::{MOREAU_JEAN, body, hole, isotropic, load, with, with_flats};
use signorini::{Load, Options, PlaneRows, Probe, Row, Scene, Scheme, Trajectory, Wall, run};

fn probed(mut scene: Scene) -> Scene {
    scene.probes = (0..2).map(|i| Probe { name: format!("p{i}"), at: Row::dof(i) }).collect();
    scene
}

/// A place that moves by twice the displacements.
fn lever() -> PlaneRows {
    PlaneRows { y: Row::new(vec![(0, 2.0)]), z: Row::new(vec![(1, 2.0)]) }
}

/// A free body that constant forces press round a hole, with a wall in y.
fn in_a_hole() -> Scene {
    let wall = Wall::upper("wall", 1.6e-3).with_restitution(0.4).at(Row::new(vec![(0, -2.0)]));
    let scene = with(isotropic(1.5, 0.0, 0.0), hole("hole", lever(), 2e-3, 0.5, 0.2)).with_wall(wall);
    scene
        .with_load(load(Load::constant(-3.0), Row::dof(0)))
        .with_load(load(Load::constant(2.0), Row::dof(1)))
        .with_load(load(Load::impulse(0.5, 0.110_03), Row::new(vec![(0, 0.3), (1, -1.0)])))
        .with_initial(&[0.0, 0.0], &[0.1, 0.2])
        .with_duration(0.3)
}

/// The same between three flats.
fn between_flats() -> Scene {
    let mut scene = in_a_hole();
    scene.supports.clear();
    scene.walls.retain(|wall| !wall.is_round());
    with_flats(scene, "flats", lever(), &[(20.0, 2e-3), (140.0, 2e-3), (260.0, 2e-3)], 0.3, 0.4)
}

fn recorded(scene: &Scene, h: f64) -> Trajectory {
    let mut options = Options::with_step(h);
    options.time.sample = Some(h);
    run(scene, &MOREAU_JEAN, &options).expect("a run").trajectory
}

#[test]
fn holes_walls_and_friction_account_for_the_momentum_of_a_run() {
    let h = 1e-4;
    for scene in [in_a_hole(), between_flats()].map(probed) {
        let trajectory = recorded(&scene, h);
        // The impulses on y and z of everything that pushes, one column each.
        let scaled = |column: &[f64], share: f64| column.iter().map(|p| share * p).collect::<Vec<f64>>();
        let (mut along, mut largest) = ([Vec::new(), Vec::new()], 0.0_f64);
        let mut add = |column: &[f64], share: [f64; 2]| {
            largest = column.iter().fold(largest, |most, p| most.max(p.abs() / h));
            along.iter_mut().zip(share).for_each(|(columns, share)| columns.push(scaled(column, share)));
        };
        for [y, z] in trajectory.hole_impulses() {
            add(y, [2.0, 0.0]);
            add(z, [0.0, 2.0]);
        }
        let walls = scene.walls.iter().zip(trajectory.contact_impulses());
        for (wall, column) in walls.filter(|(wall, _)| !wall.is_round()) {
            let share = |dof: usize| wall.row().entries().iter().filter(|e| e.0 == dof).map(|e| e.1).sum::<f64>();
            add(column, [share(0), share(1)]);
        }
        let rubbed = scene.walls.iter().zip(trajectory.friction_impulses());
        let flats = rubbed.filter(|(wall, _)| wall.name.starts_with("flats"));
        for (flat, (_, column)) in [20.0_f64, 140.0, 260.0].iter().zip(flats) {
            let (s, c) = flat.to_radians().sin_cos();
            add(column, [-2.0 * s, 2.0 * c]);
        }
        let total = |columns: &[Vec<f64>]| columns.iter().flatten().sum::<f64>();
        let sizes = |columns: &[Vec<f64>]| columns.iter().flatten().map(|p| p.abs()).sum::<f64>();
        let pushed = along.each_ref().map(|columns| total(columns));
        assert!(pushed.iter().all(|p| p.abs() > 0.1), "{pushed:?}");
        // Without springs and dampers the rows' trapezoid is exact.
        let seen = momentum(&scene, &trajectory).expect("a probe on both");
        assert!(seen.residual_n_s < 1e-11, "{seen:?}");
        // 3 N and 2 N over 0.3 s, and |p| of all that pushes.
        let exchanged = (0.9 + sizes(&along[0])).max(0.6 + sizes(&along[1]));
        assert!((seen.exchanged_n_s / exchanged - 1.0).abs() < 1e-11, "{seen:?}, expected {exchanged}");
        assert!((seen.step_n_s / (h * largest.max(3.0)) - 1.0).abs() < 1e-11, "{seen:?}, {largest}");
    }
}

#[test]
fn an_impact_at_the_start_is_in_the_first_row() {
    // Thrown out of a hole from its brim, 30° from y: 2 kg at 0.4 m/s, e = ½.
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let scene = with(isotropic(2.0, 0.0, 0.0), hole("hole", body(), 1e-3, 0.5, 0.0))
        .with_initial(&[1e-3 * c, 1e-3 * s], &[0.4 * c, 0.4 * s])
        .with_duration(1e-3);
    let mut options = Options::with_step(1e-4);
    options.time.sample = Some(1e-4);
    let run = run(&probed(scene), &Scheme::Event, &options).expect("a run");
    let [y, z] = &run.trajectory.hole_impulses()[0];
    // 2 kg (0.4 + 0.2) m/s, back towards the centre.
    assert!((y[0] + 1.2 * c).abs() < 1e-12 && (z[0] + 1.2 * s).abs() < 1e-12, "{y:?} {z:?}");
    assert!(y[1..].iter().chain(&z[1..]).all(|p| *p == 0.0), "{y:?} {z:?}");
    let (_, v) = run.trajectory.probe("p0").expect("a probe");
    assert!((v[0] + 0.2 * c).abs() < 1e-12, "{v:?}");
}

#[cfg(feature = "case")]
#[test]
fn what_is_read_has_a_column_of_full_length_for_each_hole() {
    use serde_json::{Value, from_value, to_value};
    let whole = to_value(recorded(&in_a_hole(), 1e-3)).expect("a trajectory");
    let with = |path: &str, value: Value| {
        let mut whole = whole.clone();
        *whole.pointer_mut(path).unwrap_or_else(|| panic!("no {path}")) = value;
        from_value::<Trajectory>(whole).map(|_| ()).map_err(|error| error.to_string())
    };
    // One wall and one hole: contacts are at 0 and 1.
    assert_eq!(with("/contacts/0/wall", 1.into()), Ok(()));
    assert_eq!(with("/contact_wear", Value::Array(Vec::new())), Ok(()));
    let short = || Value::from(vec![0.0]);
    for (path, value) in [
        ("/contacts/0/wall", 2.into()),
        ("/contact_wear", Value::Array(vec![Value::Null])),
        ("/holes", Value::Array(Vec::new())),
        ("/hole_force", Value::Array(Vec::new())),
        ("/hole_force/0/1", short()),
        ("/hole_impulse/0/0", short()),
        ("/friction/0", short()),
        ("/wear_work/0", short()),
        ("/supports", Value::Array(Vec::new())),
    ] {
        let error = with(path, value).expect_err(path);
        assert!(error.contains("a column for each wall"), "{path}: {error}");
    }
}
