//! A wall at a place in two planes, and where the body is at it.
//!
//! A round wall that pushed over a part does so in the next one, until it would have to pull: a
//! part leaves a speed across the circle, half the angle by which the normal turns times the change
//! of the sliding velocity, which the next part reflects, also where it turns less.
//!
//! Sliding ends where the velocity along the tangent in the middle of a part vanishes. Along the
//! tangent at its end there is left what the place moves outwards, times half the angle by which
//! the normal turns: there the place does not slide.

use super::super::body::Body;
use super::super::matrices::Matrices;
use super::super::supports::{ContactPoint, ContactRows, dot};
use super::contacts::Place;
use super::part::{Push, ROUNDING};
use crate::scene::Wall;

/// A wall, and where the body is at it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneContact {
    /// Index of the wall.
    pub wall: usize,
    pub point: ContactPoint,
    /// Centre (m) and gap (m) of a round wall.
    pub round: Option<([f64; 2], f64)>,
    pub place: Place,
    /// True if a round wall pushed over the last part.
    pub lasts: bool,
    /// True if it pushes over the part that was computed last.
    pub pushes: bool,
    /// True if it pushed over the last part of some length, or at the instant after that.
    pub pushed: bool,
    /// True if its friction ended the sliding in the last part.
    pub stopped: bool,
    /// Outward normal, and the rate of the place along it and along the tangent, m/s.
    pub normal: [f64; 2],
    pub rate: [f64; 2],
    /// Rounding error of a rate, m/s, and below which one counts as 0.
    pub rounding: f64,
    pub least: f64,
    /// The acceleration of the place in the last part of some length, and the one that pressed the
    /// body against the wall there, m/s².
    pub acceleration: [f64; 2],
    pub pressed: f64,
    /// The middle (s) of the last two parts in which it stuck, and what was left of the
    /// static friction there, μp − |f| as a mean force, N.
    pub stuck: [Option<(f64, f64)>; 2],
}

impl PlaneContact {
    /// Wall number `index`, which pushes at this point.
    pub fn new(index: usize, point: ContactPoint, wall: &Wall) -> Self {
        Self {
            wall: index,
            point,
            round: wall.hole(index).map(|hole| (hole.centre, hole.gap)),
            place: Place::Away,
            lasts: false,
            pushes: false,
            pushed: false,
            stopped: false,
            normal: point.normal,
            rate: [0.0; 2],
            rounding: 0.0,
            least: 0.0,
            acceleration: [0.0; 2],
            pressed: 0.0,
            stuck: [None; 2],
        }
    }

    /// Forgets the last part.
    pub fn forget(&mut self) {
        (self.lasts, self.pushed, self.stopped, self.stuck) = (false, false, false, [None; 2]);
        (self.acceleration, self.pressed) = ([0.0; 2], 0.0);
    }

    /// Displacement of the place from the centre of a round wall, m; of a flat one from rest.
    pub fn offset(&self, places: &ContactRows, q: &[f64]) -> [f64; 2] {
        let ([y, z], [cy, cz]) = (places.pair(self.point.rows, q), self.round.map_or([0.0; 2], |(centre, _)| centre));
        [y - cy, z - cz]
    }

    /// The gap, m, and the outward normal.
    pub fn gap(&self, (body, places): (&Body<Matrices>, &ContactRows), q: &Vec<f64>) -> (f64, [f64; 2]) {
        match self.round {
            None => (-body.walls[self.wall].depth(body.seen(self.wall, q)), self.point.normal),
            Some((_, gap)) => {
                let from = self.offset(places, q);
                let distance = dot(from, from).sqrt();
                (gap - distance, if distance > 0.0 { from.map(|x| x / distance) } else { [1.0, 0.0] })
            }
        }
    }

    /// Finds where the body is at the wall: touching it or not, with this outward normal and rate
    /// of the place (m/s), whose terms have the sum `size` (m/s). `touch` is the touching distance
    /// (m), a rate of `rest` (m/s) is rest, and a contact that lasts ends with a blow.
    pub fn classify(
        &mut self,
        touches: bool,
        (normal, pair, size): ([f64; 2], [f64; 2], f64),
        (touch, rest): (f64, f64),
        blown: bool,
    ) {
        self.stopped &= !blown;
        self.normal = normal;
        self.rate = [dot(normal, pair), normal[0] * pair[1] - normal[1] * pair[0]];
        // A body that leaves more slowly comes back before it is out of touch.
        let turning = self.round.map_or(0.0, |(_, gap)| self.rate[1] * self.rate[1] / gap);
        let returns = (2.0 * touch * turning).sqrt();
        self.rounding = ROUNDING * size;
        self.least = returns.max(rest) + self.rounding;
        self.place = if !touches {
            Place::Away
        } else if self.rate[0].abs() <= self.least || (self.lasts && !blown) {
            Place::Resting
        } else if self.rate[0] < 0.0 {
            Place::Leaving
        } else {
            Place::Struck
        };
    }

    /// The sign of the sliding velocity of a contact with friction; 0 where it does not slide.
    pub fn slides(&self) -> f64 {
        let slides = self.point.friction.acts() && !self.stopped && self.rate[1].abs() > self.least;
        if slides { self.rate[1].signum() } else { 0.0 }
    }

    /// μ at the begin of a part: the static one where it pushed before and does not slide.
    pub fn friction(&self) -> f64 {
        self.point.friction.limit(self.pushed && self.slides() == 0.0)
    }

    /// True if the rebounds of a body that strikes the wall with the restitution `e` end within a
    /// step of `h` seconds, under the acceleration of the last part of some length.
    pub fn rebounds_end(&self, e: f64, h: f64) -> bool {
        e > 0.0 && e < 1.0 && 2.0 * e * self.rate[0] <= (1.0 - e) * h * self.pressed
    }

    /// Keeps a part of `length` seconds with this middle (s) of a step of `h` seconds: what the
    /// wall did, the normal and the rate of the place (m/s) at its end, and the `change` of that
    /// rate.
    pub fn keep(
        &mut self,
        push: Option<&Push>,
        (normal, rate, change): ([f64; 2], [f64; 2], [f64; 2]),
        (length, middle, h): (f64, f64, f64),
    ) {
        let sliding = normal[0] * rate[1] - normal[1] * rate[0];
        self.stuck = match push {
            Some(push) if self.rate[1].abs().max(sliding.abs()) <= self.least => {
                let left = self.point.friction.sticking * push.impulse.abs() - push.friction.abs();
                [self.stuck[1], Some((middle, left / length))]
            }
            _ => [None; 2],
        };
        self.pushed = push.is_some();
        let stopped = |push: &Push| (push.normal[0] * rate[1] - push.normal[1] * rate[0]).abs() <= self.least;
        self.stopped = self.round.is_some() && push.is_some_and(stopped);
        self.acceleration = change.map(|change| change / length);
        self.pressed = dot(normal, self.acceleration);
        let reflected = if self.lasts { self.rate[0].abs() } else { 0.0 };
        self.lasts = false;
        let Some((_, gap)) = self.round else { return };
        let gained = normal[0] * change[1] - normal[1] * change[0];
        self.pressed += sliding * sliding / gap;
        let fastest = sliding.abs().max((sliding - gained).abs());
        let across = 0.5 * h / gap * fastest * (fastest + gained.abs());
        self.lasts = push.is_some() && dot(normal, rate).abs() <= across + reflected + self.least;
    }

    /// The time (s) at which it begins to slide: where the straight line through what was left of
    /// its friction vanishes.
    pub fn slips(&self) -> Option<f64> {
        let [Some((before, more)), Some((middle, left))] = self.stuck else { return None };
        (more > left).then(|| middle + left * (middle - before) / (more - left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{FrictionCoefficients, PlaneRows, Row};

    const FRICTION: FrictionCoefficients = FrictionCoefficients { sticking: 0.5, sliding: 0.2 };

    /// A contact in a hole of 0.02 m about the origin, or at a flat in the direction of y.
    fn contact(round: bool) -> PlaneContact {
        let point = ContactPoint { rows: [0, 1], normal: [1.0, 0.0], friction: FRICTION };
        let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
        let wall = if round { Wall::round("hole", at, 0.02) } else { Wall::upper("flat", 0.0) };
        PlaneContact { rounding: 1e-15, least: 1e-9, ..PlaneContact::new(0, point, &wall) }
    }

    fn push(impulse: f64, friction: f64) -> Push {
        Push { wall: 0, impulse, friction, normal: [1.0, 0.0] }
    }

    #[test]
    fn rebounds_end_within_a_step_if_their_flights_add_up_to_no_more() {
        // 2 e v/(a(1 − e)) = 2 · 0.5 · 3/(8 · 0.5) = 0.75 s.
        let struck = PlaneContact { rate: [3.0, 0.0], pressed: 8.0, ..contact(false) };
        assert!(struck.rebounds_end(0.5, 0.76) && !struck.rebounds_end(0.5, 0.74));
        // Where it stays, or rebounds for ever, none end.
        assert!(!struck.rebounds_end(0.0, 10.0) && !struck.rebounds_end(1.0, 10.0));
        assert!(!PlaneContact { pressed: -8.0, ..struck }.rebounds_end(0.5, 10.0));
    }

    #[test]
    fn what_presses_a_body_is_its_acceleration_and_the_turning_of_the_circle() {
        // At w = (0.02, 0) it slides at 0.3 m/s, 0.1 m/s faster than 0.05 s before, and 0.2 m/s of
        // its velocity were taken along the normal.
        let ends = ([1.0, 0.0], [0.0, 0.3], [-0.2, 0.1]);
        let [mut flat, mut round] = [contact(false), contact(true)];
        for contact in [&mut flat, &mut round] {
            contact.rate = [0.0, 0.2];
            contact.keep(Some(&push(0.4, -0.08)), ends, (0.05, 1.0, 0.1));
            assert_eq!((contact.pushed, contact.stopped, contact.acceleration), (true, false, [-4.0, 2.0]));
        }
        assert!((flat.pressed + 4.0).abs() < 1e-12 && (round.pressed - (0.3 * 0.3 / 0.02 - 4.0)).abs() < 1e-12);
        // A hole that pushed does so in the next part; a flat is asked anew.
        assert!(round.lasts && !flat.lasts);
    }

    #[test]
    fn a_round_wall_lasts_while_what_is_left_across_it_is_that_of_the_turning() {
        // Half the angle by which the normal turns in a step of 0.1 s, ½ · 0.1 · 0.3/0.02, times
        // the sum of the fastest sliding and of its change: 0.75 · 0.4 = 0.3 m/s.
        let lasts = |across: f64, reflected: f64, pushes: bool| {
            let mut contact = PlaneContact { lasts: reflected != 0.0, rate: [reflected, 0.2], ..contact(true) };
            let push = push(0.4, -0.08);
            contact.keep(pushes.then_some(&push), ([1.0, 0.0], [across, 0.3], [0.0, 0.1]), (0.05, 1.0, 0.1));
            contact.lasts
        };
        assert!(lasts(0.299, 0.0, true) && lasts(-0.299, 0.0, true) && !lasts(0.301, 0.0, true));
        // What the last part left is reflected by this one.
        assert!(lasts(0.349, 0.05, true) && lasts(-0.349, -0.05, true) && !lasts(0.351, 0.05, true));
        assert!(!lasts(0.0, 0.0, false));
    }

    #[test]
    fn a_body_begins_to_slide_where_what_is_left_of_static_friction_vanishes() {
        let mut contact = contact(false);
        assert_eq!(contact.slips(), None);
        // 0.5 · 2 − 0.4 = 0.6 N s over 0.1 s at 1 s; 0.5 · 2 − 0.8 = 0.2 N s at 1.1 s: in 0.05 s.
        for (friction, middle) in [(0.4, 1.0), (-0.8, 1.1)] {
            contact.keep(Some(&push(-2.0, friction)), ([1.0, 0.0], [0.0, 1e-10], [0.0; 2]), (0.1, middle, 0.1));
        }
        let [Some((_, more)), Some((_, left))] = contact.stuck else { panic!("{contact:?}") };
        assert!((more - 6.0).abs() < 1e-12 && (left - 2.0).abs() < 1e-12);
        assert!((contact.slips().unwrap() - 1.15).abs() < 1e-12);
        // Where more is left each time, it never does; nor where it slid in one of the parts.
        contact.stuck.swap(0, 1);
        assert_eq!(contact.slips(), None);
        contact.keep(Some(&push(-2.0, 0.4)), ([1.0, 0.0], [0.0, 1e-3], [0.0; 2]), (0.1, 1.2, 0.1));
        assert_eq!(contact.stuck, [None; 2]);
    }

    #[test]
    fn static_friction_holds_what_pushed_before_and_does_not_slide() {
        let resting = PlaneContact { pushed: true, rate: [0.0, 1e-10], ..contact(false) };
        assert_eq!((resting.slides(), resting.friction()), (0.0, 0.5));
        let sliding = PlaneContact { rate: [0.0, -1e-3], ..resting };
        assert_eq!((sliding.slides(), sliding.friction()), (-1.0, 0.2));
        assert_eq!(PlaneContact { stopped: true, ..sliding }.friction(), 0.5);
        assert_eq!(PlaneContact { pushed: false, ..resting }.friction(), 0.2);
    }

    #[test]
    fn a_body_in_touch_rests_where_it_comes_back_before_it_is_out_of_it() {
        // At 0.2 m/s along the circle of 0.02 m it turns with 2 m/s², and comes back within the
        // touching distance of 1e-6 m if it leaves with less than √(2 · 1e-6 · 2) = 2e-3 m/s.
        let place = |outwards: f64, round: bool, lasts: bool, blown: bool| {
            let mut contact = PlaneContact { lasts, ..contact(round) };
            contact.classify(true, ([1.0, 0.0], [outwards, 0.2], 0.2), (1e-6, 1e-5), blown);
            contact.place
        };
        assert_eq!(
            (place(-1.9e-3, true, false, false), place(-2.1e-3, true, false, false)),
            (Place::Resting, Place::Leaving)
        );
        assert_eq!(
            (place(1.9e-3, true, false, false), place(2.1e-3, true, false, false)),
            (Place::Resting, Place::Struck)
        );
        assert_eq!(
            (place(-0.9e-5, false, false, false), place(-1.1e-5, false, false, false)),
            (Place::Resting, Place::Leaving)
        );
        // A contact that lasts does so however fast it is across the circle, but for a blow.
        assert_eq!((place(0.1, true, true, false), place(0.1, true, true, true)), (Place::Resting, Place::Struck));
        let mut away = contact(true);
        away.classify(false, ([1.0, 0.0], [0.0, 0.2], 0.2), (1e-6, 1e-5), false);
        assert_eq!(away.place, Place::Away);
    }
}
