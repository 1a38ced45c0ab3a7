//! Makes a scene start from a given state, such as the final state of another run.

use crate::scene::{Scene, State};

/// Makes `scene` start from `state`, if it has as many degrees of freedom. If the state lies behind
/// a rigid wall, the body is moved to the wall and keeps its velocity.
pub(super) fn start_from(scene: &mut Scene, state: &State) {
    let n = scene.system.degrees_of_freedom();
    if state.q.len() != n || state.v.len() != n {
        return;
    }
    scene.initial.clone_from(state);
    scene.step_out_of_walls();
}
