//! What slides in a step: each contact of each support, with its force and its sliding velocity.
//!
//! The sliding velocity is v_t = t · (g_y · q̇, g_z · q̇) with t = (−n_z, n_y) and n the outward normal
//! of the contact. For a step on a grid it goes evenly from the step's start, after the impulses of
//! loads, to its end. For exact
//! motion force and velocity are polynomials in time, and |v_t| is integrated from one sign change
//! to the next.

use super::blows::Blow;
use super::work::{sliding_distance, work_of_impulse};
use crate::flow::Series;
use crate::scene::{PlaneRows, Scene, Shape, heading};
use crate::step::{Path, Step};

/// Parts of a stretch of exact motion, which lasts at most two radians of its fastest motion: two
/// sign changes of the sliding velocity within one would be missed, where it is next to nothing.
const PARTS: usize = 16;

/// Gauss's rule of four points on [−1, 1]: nodes and weights.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// What is known of the time over which a support gave its impulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Manner {
    /// At one instant.
    Instant,
    /// Over the whole piece of time, with a finite force.
    Lasting,
    /// In a step of a scheme on a grid, at a rigid support: an impact at some instant within it, or
    /// a force that lasts, as the neighbouring steps tell.
    Unresolved,
}

/// What one contact of a support did over a piece of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rub {
    /// Index of the support in the scene.
    pub support: usize,
    /// The contact: the index of the wall of a flat, or the number of walls plus that of the hole.
    pub contact: usize,
    pub manner: Manner,
    /// Where it is, degrees from +y towards +z, from 0 to below 360, and its outward normal n.
    pub angle: f64,
    pub normal: [f64; 2],
    /// Magnitude of the normal impulse, and the friction impulse along t, N s.
    pub impulse: f64,
    pub friction: f64,
    /// The work of wear ∫ |v_t| dp, and what friction takes out of the motion, J.
    pub work: f64,
    pub dissipated: f64,
    /// The distance ∫ |v_t| dt, m, and the time, s; both 0 at an instant.
    pub sliding: f64,
    pub time: f64,
}

/// The contacts of a scene's supports.
#[derive(Debug, Clone)]
pub(crate) struct Rubs {
    walls: usize,
    places: Vec<Place>,
}

/// A support.
#[derive(Debug, Clone)]
struct Place {
    at: PlaneRows,
    contacts: Vec<Contact>,
    blows: Vec<Blow>,
}

/// A contact of a support.
#[derive(Debug, Clone, Copy)]
enum Contact {
    Flat { wall: usize, rigid: bool, angle: f64, normal: [f64; 2] },
    Hole { hole: usize, rigid: bool },
}

impl Rubs {
    /// The contacts of `scene` as the scheme sees it.
    pub fn new(scene: &Scene) -> Self {
        let mut holes = 0;
        let place = |(support, blows): (&crate::scene::Support, Vec<Blow>)| {
            let contacts = match &support.shape {
                Shape::Flats(flats) => flats
                    .iter()
                    .map(|flat| Contact::Flat {
                        wall: flat.wall,
                        rigid: scene.walls.get(flat.wall).is_some_and(|wall| wall.law.is_rigid()),
                        angle: flat.direction.rem_euclid(360.0) % 360.0,
                        normal: heading(flat.direction),
                    })
                    .collect(),
                Shape::Round { law, .. } => {
                    holes += 1;
                    vec![Contact::Hole { hole: holes - 1, rigid: law.is_rigid() }]
                }
            };
            Place { at: support.at.clone(), contacts, blows }
        };
        let places = scene.supports.iter().zip(Blow::all(scene)).map(place).collect();
        Self { walls: scene.walls.len(), places }
    }

    /// True for a scene without supports.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Number of contacts; a [`Rub::contact`] is below it.
    pub fn contacts(&self) -> usize {
        let holes = self.places.iter().flat_map(|place| &place.contacts);
        self.walls + holes.filter(|contact| matches!(contact, Contact::Hole { .. })).count()
    }

    /// Calls `each` with what slid in `step` between two times in it, s; impulses at the instant of
    /// its end are in it where `to` reaches the end.
    pub fn see(&self, step: &Step<'_>, [from, to]: [f64; 2], mut each: impl FnMut(&Rub)) {
        for (support, place) in self.places.iter().enumerate() {
            for contact in &place.contacts {
                let Some((index, push)) = contact.push(step, self.walls) else { continue };
                let blank = Rub {
                    support,
                    contact: index,
                    manner: if contact.is_rigid() { Manner::Unresolved } else { Manner::Lasting },
                    angle: push.angle,
                    normal: push.normal,
                    impulse: push.impulse,
                    friction: push.friction,
                    work: 0.0,
                    dissipated: 0.0,
                    sliding: 0.0,
                    time: to - from,
                };
                match (&step.path, contact) {
                    (Path::Series(series), Contact::Flat { wall, .. }) => {
                        along(series, (step, *wall), place, [from, to], &blank, &mut each);
                    }
                    _ => each(&on_grid(step, place, [from, to], &blank)),
                }
            }
        }
    }
}

/// What a contact gave in a step.
struct Push {
    angle: f64,
    normal: [f64; 2],
    impulse: f64,
    friction: f64,
}

impl Contact {
    fn is_rigid(self) -> bool {
        match self {
            Self::Flat { rigid, .. } | Self::Hole { rigid, .. } => rigid,
        }
    }

    /// The index of the contact and what it gave; `None` if it gave nothing.
    fn push(self, step: &Step<'_>, walls: usize) -> Option<(usize, Push)> {
        match self {
            Self::Flat { wall, angle, normal, .. } => {
                let impulse = step.impulse.get(wall).copied().filter(|p| *p != 0.0)?.abs();
                let friction = step.friction.get(wall).copied().unwrap_or(0.0);
                Some((wall, Push { angle, normal, impulse, friction }))
            }
            Self::Hole { hole, .. } => {
                let done = step.holes.get(hole).filter(|done| done.impulse != 0.0)?;
                let [y, z] = done.normal;
                let angle = z.atan2(y).to_degrees().rem_euclid(360.0) % 360.0;
                Some((walls + hole, Push { angle, normal: [y, z], impulse: done.impulse, friction: done.friction }))
            }
        }
    }
}

impl Place {
    /// The sliding velocity of the velocities `v` along t of the normal `normal`, m/s.
    fn along(&self, [y, z]: [f64; 2], v: &[f64]) -> f64 {
        y * self.at.z.dot(v) - z * self.at.y.dot(v)
    }
}

/// A piece of a step on a grid: its share of the step's impulse.
fn on_grid(step: &Step<'_>, place: &Place, [from, to]: [f64; 2], blank: &Rub) -> Rub {
    let length = step.end - step.start;
    let share = if length > 0.0 { ((to - from) / length).clamp(0.0, 1.0) } else { 1.0 };
    let [before, after] = [step.velocity_before, step.velocity_after].map(|v| place.along(blank.normal, v));
    let before = before + Blow::along(&place.blows, blank.normal, [step.start, step.end]);
    let (impulse, friction) = (share * blank.impulse, share * blank.friction);
    Rub {
        impulse,
        friction,
        work: work_of_impulse(impulse, before, after),
        dissipated: -0.5 * friction * (before + after),
        sliding: sliding_distance(to - from, before, after),
        ..*blank
    }
}

/// A piece of a stretch of exact motion: the force over it, then the impulse at its end.
fn along(
    series: &Series,
    (step, wall): (&Step<'_>, usize),
    place: &Place,
    [from, to]: [f64; 2],
    blank: &Rub,
    each: &mut impl FnMut(&Rub),
) {
    let jump = step.jump.get(wall).map_or(0.0, |p| p.abs());
    // What the wall gave beside the jump; rounding of the sum is not a contact.
    let pushed = series.acting_walls().any(|(acting, _)| acting == wall);
    let [y, z] = blank.normal;
    let moved = series.seen_along([&place.at.y, &place.at.z], [-z, y]);
    let speed = |t: f64| series.rate_of(&moved, t);
    if pushed && to > from {
        let mut sum = Rub { manner: Manner::Lasting, impulse: 0.0, friction: 0.0, ..*blank };
        let span = (to - from) / PARTS as f64;
        let mut piece = |a: f64, b: f64| {
            let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
            for (node, weight) in GAUSS {
                let t = middle + half * node;
                let force = series.contact_force(wall, t).abs();
                sum.work += half * weight * force * speed(t).abs();
            }
            sum.impulse += series.contact_impulse(wall, a, b).abs();
            sum.sliding += (series.value_of(&moved, b) - series.value_of(&moved, a)).abs();
        };
        let mut left = (from, speed(from));
        for part in 1..=PARTS {
            let t = if part == PARTS { to } else { from + span * part as f64 };
            let right = (t, speed(t));
            if left.1 * right.1 < 0.0 {
                let root = turn(&speed, left, right);
                piece(left.0, root);
                piece(root, right.0);
            } else {
                piece(left.0, right.0);
            }
            left = right;
        }
        each(&sum);
    }
    if jump > 0.0 && to >= step.end {
        let left =
            if step.end > step.start { speed(step.end) } else { place.along(blank.normal, step.velocity_before) };
        let before = left + Blow::along(&place.blows, blank.normal, [step.start, step.end]);
        let work = work_of_impulse(jump, before, place.along(blank.normal, step.v));
        each(&Rub { manner: Manner::Instant, impulse: jump, friction: 0.0, work, time: 0.0, ..*blank });
    }
}

/// The instant between two at which the speed changes its sign, by bisection down to rounding.
fn turn(speed: &impl Fn(f64) -> f64, mut left: (f64, f64), mut right: (f64, f64)) -> f64 {
    loop {
        let middle = 0.5 * (left.0 + right.0);
        if middle <= left.0 || middle >= right.0 {
            return middle;
        }
        let there = (middle, speed(middle));
        if there.1 * left.1 > 0.0 { left = there } else { right = there }
    }
}
