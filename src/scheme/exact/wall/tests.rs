//! The phases of an elastic wall: every transition, on either side.

use super::*;

/// k_a = 4 N/m and c_a as given, at 1 m; and its side's state at so much depth (m) and inward speed
/// (m/s).
fn wall(side: Side, damping: f64) -> (ExactWall, impl Fn(f64, f64) -> (f64, f64)) {
    let wall = match side {
        Side::Lower => Wall::lower("wall", 1.0),
        Side::Upper => Wall::upper("wall", 1.0),
    };
    let wall = ExactWall::new(&wall.with_elasticity(4.0, damping)).unwrap();
    let sign = wall.sign;
    (wall, move |depth, speed| (1.0 - sign * depth, -sign * speed))
}

#[test]
fn the_phase_follows_from_the_state() {
    use Phase::*;
    for side in [Side::Lower, Side::Upper] {
        for (depth, speed, phase) in [
            (-1.0, 5.0, Outside),
            // On the surface, to 0.25 m: in contact if it moves inwards.
            (-0.25, 1.0, Touching),
            (-0.25, 0.0, Outside),
            (-0.25, -1.0, Outside),
            (0.0, 1.0, Touching),
            (0.0, 0.0, Outside),
            (0.0, -1.0, Outside),
            (0.25, 1.0, Touching),
            (0.25, -0.125, Outside),
            // Behind it: in contact where 4 s + 2 ṡ > 0.
            (0.5, 0.0, Touching),
            (0.5, -0.75, Touching),
            (0.5, -1.0, Detached),
            (0.5, -1.25, Detached),
        ] {
            let (mut wall, state) = wall(side, 2.0);
            let (q, v) = state(depth, speed);
            wall.classify(q, v, 0.25);
            assert_eq!(wall.phase, phase, "{side:?} {depth} {speed}");
        }
        let (mut wall, state) = wall(side, 0.0);
        wall.phase = Rigid(0.5);
        let (q, v) = state(1.0, 1.0);
        wall.classify(q, v, 0.25);
        assert_eq!(wall.phase, Rigid(0.5));
    }
}

#[test]
fn an_event_moves_a_wall_into_the_next_phase() {
    use Phase::*;
    for side in [Side::Lower, Side::Upper] {
        // The phase, c_a, depth and inward speed; the next phase, and whether the surface is
        // crossed.
        for (phase, damping, depth, speed, next, crossed) in [
            (Outside, 2.0, 0.0, 1.0, Touching, true),
            (Outside, 0.0, 0.0, 1.0, Touching, true),
            // Without a dashpot a force vanishes at the surface only, wherever rounding puts it.
            (Touching, 0.0, 0.25, -1.0, Outside, true),
            (Touching, 0.0, 1.0, -1.0, Outside, true),
            (Touching, 2.0, 0.25, -1.0, Outside, true),
            (Touching, 2.0, -0.25, -1.0, Outside, true),
            (Touching, 2.0, 0.5, -1.0, Detached, false),
            // Behind the face without force: it emerges where k_a s is nearer to 0 than
            // k_a s + c_a ṡ …
            (Detached, 2.0, 0.25, -0.5, Outside, true),
            (Detached, 2.0, 0.5, -3.0, Outside, true),
            // … and otherwise the force sets in again.
            (Detached, 2.0, 0.5, -1.25, Touching, false),
            (Detached, 2.0, 0.5, -0.75, Touching, false),
        ] {
            let (mut wall, state) = wall(side, damping);
            wall.phase = phase;
            let found = wall.cross(state(depth, speed), 0.25, 7.0);
            assert_eq!((wall.phase, wall.changed, found), (next, 7.0, crossed), "{side:?} {phase:?} {depth} {speed}");
        }
        let (mut wall, state) = wall(side, 0.0);
        (wall.phase, wall.changed) = (Rigid(1.0), 1.0);
        assert!(!wall.cross(state(0.0, 1.0), 0.25, 7.0));
        assert_eq!((wall.phase, wall.changed), (Rigid(1.0), 1.0));
    }
}
