//! What slides in a step: each contact of each support, with its force and its sliding velocity.
//!
//! The sliding velocity is v_t = t · (g_y · q̇, g_z · q̇) with t = (−n_z, n_y) and n the outward
//! normal of the contact. In a step on a grid it varies linearly from the step's start, after the
//! impulses of loads, to its end; in a part of a step, whose impulses come at its end, from its
//! start to its end, and at the instant that ends it. For exact motion force and velocity are
//! polynomials in time, and |v_t|
//! is integrated from one sign change to the next.

use super::blows::Blow;
use super::piece::{ImpulseDuration, Piece, Section, SlidingPiece, degrees};
use crate::linear::Segment;
use crate::scene::{Face, Scene, Support, Wall, heading};
use crate::step::{Path, Step};

/// The contacts of a scene's supports.
#[derive(Debug, Clone)]
pub(crate) struct SlidingContacts {
    walls: usize,
    supports: Vec<SupportContacts>,
}

/// A support: its cross-section and its contacts.
#[derive(Debug, Clone)]
struct SupportContacts {
    section: Section,
    contacts: Vec<Contact>,
}

/// A distance slid in a step below this share of the gap scale is the rounding of a place.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A body as near to a round hole as this share of the gap touches it.
const TOUCHING: f64 = 1e-9;

/// A contact of a support.
#[derive(Debug, Clone, Copy)]
enum Contact {
    Flat { wall: usize, rigid: bool, angle: f64, normal: [f64; 2] },
    Hole { wall: usize, rigid: bool, centre: [f64; 2], gap: f64 },
}

impl SlidingContacts {
    /// The contacts of `scene` as the scheme sees it.
    pub fn new(scene: &Scene) -> Self {
        let rounding = ROUNDING * scene.gap_scale();
        let of = |(support, blows): (&Support, Vec<Blow>)| {
            let contact = |(index, wall): (usize, &Wall)| {
                let rigid = wall.law.is_rigid();
                Some(match wall.face {
                    Face::Flat { direction, .. } => Contact::Flat {
                        wall: index,
                        rigid,
                        angle: direction?.rem_euclid(360.0) % 360.0,
                        normal: heading(direction?),
                    },
                    Face::Round { centre, gap, .. } => Contact::Hole { wall: index, rigid, centre, gap },
                })
            };
            let contacts = support.members(&scene.walls).filter_map(contact).collect();
            let at = support.at.clone();
            let [y, z] = [&at.y, &at.z].map(|row| Segment::following(row.entries()));
            let segments = y.zip(z).map(|(y, z)| [y, z]);
            SupportContacts { section: Section { at, segments, blows, rounding }, contacts }
        };
        let supports = scene.supports.iter().zip(Blow::all(scene)).map(of).collect();
        Self { walls: scene.walls.len(), supports }
    }

    /// True for a scene without supports.
    pub fn is_empty(&self) -> bool {
        self.supports.is_empty()
    }

    /// Number of contacts; a [`SlidingPiece::contact`] is below it.
    pub fn contacts(&self) -> usize {
        self.walls
    }

    /// Calls `each` with every contact that pushed in `step` between the times `from` and `to` (s);
    /// impulses at the end of the step are included where `to` reaches the end.
    pub fn observe(&self, step: &Step<'_>, [from, to]: [f64; 2], mut each: impl FnMut(&SlidingPiece)) {
        for (support, SupportContacts { section, contacts }) in self.supports.iter().enumerate() {
            for contact in contacts {
                let Some((index, push)) = contact.push(step) else { continue };
                let blank = SlidingPiece {
                    support,
                    contact: index,
                    duration: if contact.is_rigid() { ImpulseDuration::Unresolved } else { ImpulseDuration::Lasting },
                    angle: push.angle,
                    turn: 0.0,
                    normal: push.normal,
                    impulse: push.impulse,
                    friction: push.friction,
                    work: 0.0,
                    dissipated: 0.0,
                    sliding: 0.0,
                    time: to - from,
                };
                let piece = Piece { step, section, span: [from, to], blank: &blank };
                match (&step.path, contact) {
                    (Path::Series(series), Contact::Flat { .. }) => piece.along(series, &mut each),
                    (Path::Series(series), Contact::Hole { .. }) => piece.around(series, &mut each),
                    (Path::Part { .. }, _) => piece.in_part(&mut each),
                    _ => {
                        let blown = Blow::along(&section.blows, blank.normal, [step.start, step.end]);
                        each(&piece.on_grid(blown));
                    }
                }
            }
        }
    }
}

impl SlidingContacts {
    /// The angle (degrees) at which the contact of `piece` begins at the time `from` (s) in `step`,
    /// or with that step on a grid. Over a step on a grid that ends in a round hole with contact
    /// the normal is that of its middle: it turns from the start to there as from there to the end.
    pub fn angle_at_start(&self, piece: &SlidingPiece, step: &Step<'_>, from: f64) -> f64 {
        let support = self.supports.get(piece.support).filter(|_| piece.duration != ImpulseDuration::Instant);
        let found = support.and_then(|all| all.contacts.iter().find(|contact| contact.wall() == piece.contact));
        let (Some(SupportContacts { section, .. }), Some(&Contact::Hole { centre, gap, .. })) = (support, found) else {
            return piece.angle;
        };
        if let Path::Series(series) = &step.path {
            return degrees(series.at_hole(piece.contact, from).0);
        }
        let [y, z] = piece.normal;
        let end = [section.at.y.dot(step.q) - centre[0], section.at.z.dot(step.q) - centre[1]];
        if end[0].hypot(end[1]) < (1.0 - TOUCHING) * gap {
            return piece.angle;
        }
        let along = 2.0 * (y * end[0] + z * end[1]);
        degrees([along * y - end[0], along * z - end[1]])
    }
}

/// Force and impulse of a contact in a step.
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

    fn wall(self) -> usize {
        match self {
            Self::Flat { wall, .. } | Self::Hole { wall, .. } => wall,
        }
    }

    /// The index of the contact, with its force and impulse; `None` if there was none.
    fn push(self, step: &Step<'_>) -> Option<(usize, Push)> {
        match self {
            Self::Flat { wall, angle, normal, .. } => {
                let impulse = step.impulse.get(wall).copied().filter(|p| *p != 0.0)?.abs();
                let friction = step.friction.get(wall).copied().unwrap_or(0.0);
                Some((wall, Push { angle, normal, impulse, friction }))
            }
            Self::Hole { wall: index, .. } => {
                let impulse = step.impulse.get(index).copied().filter(|p| *p != 0.0)?;
                let (normal, friction) = (*step.normal.get(index)?, *step.friction.get(index)?);
                Some((index, Push { angle: degrees(normal), normal, impulse, friction }))
            }
        }
    }
}
