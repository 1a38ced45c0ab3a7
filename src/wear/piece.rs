//! A piece of a step in which a contact slides: impulse, work and distance on a grid, in parts of a
//! step, and along exact motion.

use super::blows::Blow;
use super::stretch::{Sliding, SlidingSums};
use super::work::{sliding_distance, work_of_impulse};
use crate::flow::Series;
use crate::linear::Segment;
use crate::scene::PlaneRows;
use crate::step::Step;

/// Number of parts of a stretch of exact motion, which lasts at most two radians of its fastest
/// motion; one that an event ends early has fewer. Two sign changes of the sliding velocity within
/// one part would be missed, but it is nearly 0 there.
const PARTS: f64 = 16.0;

/// Largest angle (rad) by which the normal of a round hole turns in one of the pieces into which a
/// stretch is divided, each with an angle of its own, and the largest number of pieces.
const TURN: f64 = 0.04;
const MOST_PARTS: f64 = 256.0;

/// How long a support's impulse lasted, as far as the step shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ImpulseDuration {
    /// At one instant.
    Instant,
    /// Over the whole piece of time, with a finite force.
    Lasting,
    /// In a step of a scheme on a grid, at a rigid support: an impact at some instant within it, or
    /// a force that lasts; the neighbouring steps show which.
    Unresolved,
}

/// Impulse, work and sliding of one contact of a support over a piece of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlidingPiece {
    /// Index of the support in the scene.
    pub support: usize,
    /// The index of the wall.
    pub contact: usize,
    pub duration: ImpulseDuration,
    /// Its angle, degrees from +y towards +z, from 0 to below 360, and its outward normal n; their
    /// means over a piece in which the normal turns.
    pub angle: f64,
    pub normal: [f64; 2],
    /// How far the normal turns in it, degrees; 0 where the angle is that of a whole step.
    pub turn: f64,
    /// Magnitude of the normal impulse, and the friction impulse along t, N s.
    pub impulse: f64,
    pub friction: f64,
    /// The work of wear ∫ |v_t| dp, and the energy dissipated by friction, J.
    pub work: f64,
    pub dissipated: f64,
    /// The distance ∫ |v_t| dt, m, and the time, s; both 0 at an instant.
    pub sliding: f64,
    pub time: f64,
}

/// The cross-section at a support.
#[derive(Debug, Clone)]
pub(super) struct Section {
    pub at: PlaneRows,
    /// Its rows, if the entries of each follow one another.
    pub segments: Option<[Segment; 2]>,
    pub blows: Vec<Blow>,
    /// A distance (m) below the rounding of places, over which nothing slides.
    pub rounding: f64,
}

impl Section {
    /// The sliding velocity of the velocities `v` along t of the normal `normal`, m/s.
    pub fn along(&self, [y, z]: [f64; 2], v: &[f64]) -> f64 {
        y * self.at.z.dot(v) - z * self.at.y.dot(v)
    }

    /// As [`Section::along`], of two vectors together.
    fn both_along(&self, [y, z]: [f64; 2], both: [&[f64]; 2]) -> [f64; 2] {
        let Some([along_y, along_z]) = &self.segments else { return both.map(|v| self.along([y, z], v)) };
        let ([y0, y1], [z0, z1]) = (along_y.products(both).0, along_z.products(both).0);
        [y * z0 - z * y0, y * z1 - z * y1]
    }
}

/// The time from `span[0]` to `span[1]` (s) in a step, at a contact that pushes in the step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece<'a> {
    pub step: &'a Step<'a>,
    pub section: &'a Section,
    pub span: [f64; 2],
    /// The contact with its impulse in the step, without what slides.
    pub blank: &'a SlidingPiece,
}

impl Piece<'_> {
    /// In a step on a grid: its share of the step's impulse, with the sliding velocity `blown`
    /// (m/s) that the blows give at its start.
    pub fn on_grid(&self, blown: f64) -> SlidingPiece {
        let Self { step, section, span: [from, to], blank } = *self;
        let length = step.end - step.start;
        let share = if length > 0.0 { ((to - from) / length).clamp(0.0, 1.0) } else { 1.0 };
        let [before, after] = section.both_along(blank.normal, [step.velocity_before, step.velocity_after]);
        let before = before + blown;
        let (impulse, friction) = (share * blank.impulse, share * blank.friction);
        let sliding = sliding_distance(to - from, before, after);
        // What sticks has the velocity of rounding, whose work is none.
        if sliding <= section.rounding {
            return SlidingPiece { impulse, friction, ..*blank };
        }
        SlidingPiece {
            impulse,
            friction,
            work: work_of_impulse(impulse, before, after),
            dissipated: -0.5 * friction * (before + after),
            sliding,
            ..*blank
        }
    }

    /// In a part of a step: the force over it, then the impulse at its end. A wall with an impulse
    /// there has its friction there.
    pub fn in_part(&self, each: &mut impl FnMut(&SlidingPiece)) {
        let Self { step, blank, .. } = *self;
        let jump = self.jump();
        let impulse = blank.impulse - jump;
        // Rounding of the sum is not a contact.
        if step.end > step.start && impulse > f64::EPSILON * jump {
            let friction = if jump == 0.0 { blank.friction } else { 0.0 };
            let over = SlidingPiece { duration: ImpulseDuration::Lasting, impulse, friction, ..*blank };
            each(&Piece { blank: &over, ..*self }.on_grid(0.0));
        }
        self.strike(|| self.section.along(blank.normal, step.velocity_after), each);
    }

    /// In a stretch of exact motion: the force over it, then the impulse at its end.
    pub fn along(&self, series: &Series, each: &mut impl FnMut(&SlidingPiece)) {
        let Self { section, span: [from, to], blank, .. } = *self;
        let wall = blank.contact;
        // The impulse of the wall apart from the jump; rounding of the sum is not a contact.
        let pushed = series.acting_walls().any(|(acting, _)| acting == wall);
        let [y, z] = blank.normal;
        let moved = series.seen_along([&section.at.y, &section.at.z], [-z, y]);
        let speed = |t: f64| series.rate_of(&moved, t);
        if pushed && to > from {
            let sliding = Sliding {
                force: &|t| series.contact_force(wall, t).abs(),
                impulse: &|a, b| series.contact_impulse(wall, a, b).abs(),
                speed: &speed,
                way: &|a, b| series.value_of(&moved, b) - series.value_of(&moved, a),
            };
            let mut sum = SlidingSums::default();
            let count = parts_of(series, [from, to]);
            parts([from, to], count as usize, |a, b| sliding.add(a, b, &mut sum));
            each(&lasting(blank, &sum));
        }
        self.strike(|| self.speed_left(speed), each);
    }

    /// The same for a round hole, in pieces over which its normal turns little.
    pub fn around(&self, series: &Series, each: &mut impl FnMut(&SlidingPiece)) {
        let Self { span: [from, to], blank, .. } = *self;
        let hole = blank.contact;
        let speed = |t: f64| {
            let ([y, z], [vy, vz]) = series.at_hole(hole, t);
            (y * vz - z * vy) / y.hypot(z)
        };
        let way = |a: f64, b: f64| {
            let ([y, z], [u, v]) = (series.at_hole(hole, a).0, series.at_hole(hole, b).0);
            y.hypot(z) * (y * v - z * u).atan2(y * u + z * v)
        };
        if let Some(impulse) = series.round_impulse(hole)
            && to > from
        {
            let sliding = Sliding {
                force: &|t| series.hole_pressure(hole, t),
                impulse: &|a, b| series.hole_push(hole, a, b),
                speed: &speed,
                way: &way,
            };
            let (mut turn, count) = (0.0, parts_of(series, [from, to]));
            parts([from, to], count as usize, |a, b| {
                let [y, z] = series.at_hole(hole, a).0;
                turn += way(a, b).abs() / y.hypot(z);
            });
            let count = count.max((turn / TURN).ceil()).min(MOST_PARTS);
            let mut time = to - from;
            parts([from, to], count as usize, |a, b| {
                let mut sum = SlidingSums::default();
                sliding.add(a, b, &mut sum);
                let [y, z] = series.at_hole(hole, 0.5 * (a + b)).0;
                let (angle, turn) = (degrees([y, z]), (way(a, b) / y.hypot(z)).to_degrees());
                // Over so short a piece the impulse vector is nearly p n; this is its magnitude p.
                let push = impulse.between(a, b);
                let normal = if sum.impulse > 0.0 { push.map(|push| -push / sum.impulse) } else { blank.normal };
                let time = std::mem::take(&mut time);
                each(&SlidingPiece { time, angle, turn, normal, ..lasting(blank, &sum) });
            });
        }
        self.strike(|| self.speed_left(speed), each);
    }

    /// The magnitude of the impulse at the end of the step, N s.
    fn jump(&self) -> f64 {
        self.step.jump.get(self.blank.contact).map_or(0.0, |p| p.abs())
    }

    /// The sliding velocity at the end of exact motion, from that at a time in it, m/s; at an
    /// instant that before it.
    fn speed_left(&self, speed: impl Fn(f64) -> f64) -> f64 {
        let Self { step, section, blank, .. } = *self;
        if step.end > step.start { speed(step.end) } else { section.along(blank.normal, step.velocity_before) }
    }

    /// The impulse at the end of the step, if the piece reaches it, with the sliding velocity
    /// `left` (m/s) before the loads' impulses there.
    fn strike(&self, left: impl Fn() -> f64, each: &mut impl FnMut(&SlidingPiece)) {
        let Self { step, section, span: [_, to], blank } = *self;
        let jump = self.jump();
        if to >= step.end && jump > 0.0 {
            let before = left() + Blow::along(&section.blows, blank.normal, [step.start, step.end]);
            let after = section.along(blank.normal, step.v);
            let (work, dissipated) = (work_of_impulse(jump, before, after), -0.5 * blank.friction * (before + after));
            let duration = ImpulseDuration::Instant;
            each(&SlidingPiece { duration, impulse: jump, work, dissipated, time: 0.0, ..*blank });
        }
    }
}

/// The angle of a vector (y, z), degrees from +y towards +z, from 0 to below 360.
pub(super) fn degrees([y, z]: [f64; 2]) -> f64 {
    let turn = z.atan2(y).to_degrees();
    let turn = if turn < 0.0 { turn + 360.0 } else { turn };
    // By rounding, a whole turn less almost nothing is a whole one.
    if turn >= 360.0 { 0.0 } else { turn }
}

/// The number of parts of a piece of a stretch: none is longer than one of [`PARTS`] of the length
/// that the stretch would have without an event.
fn parts_of(series: &Series, [from, to]: [f64; 2]) -> f64 {
    (PARTS * ((to - from) / series.longest())).ceil().clamp(1.0, PARTS)
}

/// Calls `each` for `count` equal parts of a piece of time.
fn parts([from, to]: [f64; 2], count: usize, mut each: impl FnMut(f64, f64)) {
    let span = (to - from) / count as f64;
    let mut left = from;
    for part in 1..=count {
        let right = if part == count { to } else { from + span * part as f64 };
        each(left, right);
        left = right;
    }
}

/// A contact that lasted, and what slid.
fn lasting(blank: &SlidingPiece, slid: &SlidingSums) -> SlidingPiece {
    let SlidingSums { work, impulse, way } = *slid;
    SlidingPiece { duration: ImpulseDuration::Lasting, impulse, friction: 0.0, work, sliding: way, ..*blank }
}
