//! The exact scheme for structures allocates nothing after its first steps.

use crate::counting;
use signorini::linear::Symmetric;
use signorini::{Load, Row, Scene, Scheme, Stepper, Structure, Wall};

#[test]
fn steps_from_event_to_event_allocate_nothing() {
    let n = 8;
    let stiffness = |k: f64| {
        let entries = (0..n).flat_map(|i| [(i, i, 2.0 * k), (i + 1, i, -k)]);
        Symmetric::from_entries(n, entries.filter(|entry| entry.0 < n))
    };
    let structure =
        Structure { mass: Symmetric::diagonal(&vec![1.0; n]), damping: stiffness(0.05), stiffness: stiffness(1e4) };
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_initial(&vec![0.0; n], &vec![0.0; n]).with_duration(2.0);
    scene.system = structure.into();
    scene = scene.with_load(Load::harmonic(50.0, 5.0, 0.0)).with_load(Load::impulse(0.5, 0.3));
    for dof in 0..n {
        let upper = Wall::upper(&format!("u{dof}"), 1e-3).with_restitution(if dof % 2 == 0 { 0.0 } else { 0.6 });
        let lower = Wall::lower(&format!("l{dof}"), -1e-3);
        let lower = if dof % 3 == 0 { lower.with_elasticity(1e5, 20.0) } else { lower.with_restitution(0.3) };
        for wall in [upper, lower] {
            scene = scene.with_wall(wall.at(Row::dof(dof)));
        }
    }
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 2.0).unwrap();
    // The programme's work space comes with the first of them.
    while stepper.time() < 0.2 {
        stepper.step().unwrap();
    }
    let before = counting::count();
    while stepper.time() < 2.0 {
        stepper.step().unwrap();
    }
    assert_eq!(counting::count() - before, 0);
    // Guards the count itself: there is much to allocate for.
    assert!(stepper.counters().events > 100, "{:?}", stepper.counters());
}
