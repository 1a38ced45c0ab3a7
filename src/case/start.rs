//! Makes a scene start from the final state of another one.

use crate::scene::{Scene, Side, State, System};

/// Most passes over the walls behind which the state lies.
const PASSES: usize = 50;

/// Makes `scene` start from `state`, if it has as many degrees of freedom. If the state lies behind
/// a rigid wall, the body is moved to the wall and keeps its velocity.
pub(super) fn carry_on(scene: &mut Scene, state: &State) {
    let n = scene.system.degrees_of_freedom();
    if state.q.len() != n || state.v.len() != n {
        return;
    }
    scene.initial.clone_from(state);
    // Several walls may require different moves: each is applied in turn, in several passes.
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
            // The smallest move that brings w = g · q to the wall, and its rounding on the free
            // side.
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
