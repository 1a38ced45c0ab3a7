//! A scene that starts from where another one has ended.

use crate::scene::{Scene, Side, State, System};

/// How often the walls are gone through that the state lies beyond.
const PASSES: usize = 50;

/// Lets `scene` start from `state`, if it has as many degrees of freedom. A rigid wall beyond which that lies takes the body along, and leaves
/// it its velocity.
pub(super) fn carry_on(scene: &mut Scene, state: &State) {
    let n = scene.system.degrees_of_freedom();
    if state.q.len() != n || state.v.len() != n {
        return;
    }
    scene.initial.clone_from(state);
    // Several walls may want the body elsewhere: each in turn, and all of them a few times.
    for _ in 0..PASSES {
        let mut moved = false;
        for wall in scene.walls.iter().filter(|wall| wall.law.is_rigid()) {
            let w = wall.at.dot(&scene.initial.q);
            let beyond = match wall.side {
                Side::Upper => (w - wall.position).max(0.0),
                Side::Lower => (w - wall.position).min(0.0),
            };
            if beyond == 0.0 {
                continue;
            }
            moved = true;
            if let (System::Oscillator(_), [(0, 1.0)]) = (&scene.system, wall.at.entries()) {
                scene.initial.q = vec![wall.position];
                continue;
            }
            // The least move that brings w = g · q onto the wall, and its rounding before it.
            let square: f64 = wall.at.entries().iter().map(|(_, weight)| weight * weight).sum();
            let size = scene.initial.q.iter().fold(wall.position.abs(), |most, q| most.max(q.abs()));
            let by = beyond + (4.0 * f64::EPSILON * size).copysign(beyond);
            for &(index, weight) in wall.at.entries() {
                if let Some(q) = scene.initial.q.get_mut(index) {
                    *q -= by * weight / square;
                }
            }
        }
        if !moved {
            break;
        }
    }
}
