//! The walls in front of a body, and on which side of them it is.

use super::*;
use crate::scene::Wall;

fn barriers(walls: &[Wall]) -> Vec<ExactWall> {
    walls.iter().map(|wall| ExactWall::new(wall).unwrap()).collect()
}

/// Just off the start of a motion of this displacement (m) and velocity (m/s).
fn moving(q: f64, v: f64) -> Jet {
    let mut jet = Jet::default();
    (jet[0], jet[1]) = (q, v);
    jet
}

#[test]
fn the_nearest_wall_on_each_side_bounds_the_room_and_of_two_at_one_place_the_first() {
    let (lower, upper) = (|g| Wall::lower("lower", g), |g| Wall::upper("upper", g));
    for walls in [
        [lower(-3.0), lower(-1.0), lower(-2.0), lower(-1.0), upper(5.0), upper(2.0), upper(4.0), upper(2.0)],
        [lower(-3.0), lower(-1.0), lower(-1.0), lower(-2.0), upper(3.0), upper(2.0), upper(2.0), upper(9.0)],
    ] {
        let room = GapBounds::between(&barriers(&walls)).unwrap();
        assert_eq!((room.low, room.high), ((-1.0, Some(1)), (2.0, Some(5))));
    }
    let room = GapBounds::between(&[]).unwrap();
    assert_eq!((room.low, room.high), ((f64::NEG_INFINITY, None), (f64::INFINITY, None)));
}

#[test]
fn behind_the_face_of_an_elastic_wall_there_is_no_room() {
    let mut walls = barriers(&[Wall::lower("hard", -1.0), Wall::upper("soft", 1.0).with_elasticity(3.0, 4.0)]);
    for (phase, room) in [(Phase::Outside, true), (Phase::Touching, false), (Phase::Detached, false)] {
        walls[1].phase = phase;
        assert_eq!(GapBounds::between(&walls).is_some(), room, "{phase:?}");
    }
}

#[test]
fn a_body_is_in_the_room_where_both_walls_are_in_front_of_it_by_more_than_asked() {
    let room = GapBounds::between(&barriers(&[Wall::lower("lower", -1.0), Wall::upper("upper", 2.0)])).unwrap();
    for (q, by, held) in [
        (1.5, 0.25, true),
        (1.5, 0.5, false),
        (1.5, 0.75, false),
        (-0.5, 0.25, true),
        (-0.5, 0.5, false),
        (-0.5, 0.75, false),
        // By less than nothing: a wall may be passed by that.
        (2.25, -0.5, true),
        (2.25, -0.125, false),
        (-1.25, -0.5, true),
        (-1.25, -0.125, false),
    ] {
        assert_eq!(room.holds(q, by), held, "{q} {by}");
    }
}

#[test]
fn the_wall_ahead_is_the_one_passed_or_else_the_one_that_the_body_moves_to() {
    let room = GapBounds::between(&barriers(&[Wall::lower("lower", -1.0), Wall::upper("upper", 2.0)])).unwrap();
    for (q, v, wall) in [
        (0.0, 1.0, 1),
        (0.0, -1.0, 0),
        // At a wall, and behind it.
        (-1.0, 1.0, 1),
        (2.0, -1.0, 0),
        (2.5, -1.0, 1),
        (2.5, 1.0, 1),
        (-1.5, 1.0, 0),
        (-1.5, -1.0, 0),
    ] {
        assert_eq!(room.ahead(&moving(q, v)), ([-1.0, 2.0][wall], Some(wall)), "{q} {v}");
    }
}
