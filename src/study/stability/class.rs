//! What the measurements of a run amount to.

use super::scale::Scale;
use super::watch::{Record, depth_bound};
use crate::scene::Scene;
use crate::scheme::Scheme;
use crate::step::Contact;
use std::fmt;

/// Speeds over this many times the reference's largest have left the motion: energy is up by more than a hundred.
pub const DIVERGED: f64 = 10.0;
/// Growth of energy per impact above which a scheme gains: 1 % compounds to e-fold in a hundred impacts, one run of the source scene.
pub const GAIN: f64 = 0.01;
/// Loss of energy per impact above which a scheme dissipates: 5 % is a restitution off by 0.025, less than the 0.05 to which it is
/// known for any real wall. A loss does not compound: a load makes up for it.
pub const LOSS: f64 = 0.05;
/// Speed over the reference's largest above which energy came from nowhere. In the chaotic motion at e = 1 the largest speed of a
/// hundred impacts scatters by a fifth between starts that differ in rounding; half as much again is not scatter.
pub const FAST: f64 = 1.5;
/// Root-mean-square speed over the reference's below which motion was lost: half the kinetic energy. The same scatter is a tenth.
pub const SLOW: f64 = 0.7;
/// Share of steps in which opposite walls took turns above which a body is frozen: a body that crosses a gap in one step now and then is not.
pub const FROZEN: f64 = 0.01;
/// Root-mean-square speed over the reference's below which a body stands still.
pub const STILL: f64 = 0.01;
/// Contacts are counted where the approach is faster than this share of the reference's largest: the number of slower ones,
/// in chatter and accumulations, depends on resolution alone.
pub const COUNTED: f64 = 0.05;
/// Contact counts off by more than this factor are wrong; chaos alone moves them by a tenth.
pub const MISCOUNTED: f64 = 2.0;
/// Fewer contacts than this are too few to be held against a factor.
pub const FEW: usize = 4;
/// Depth over the stated bound above which a wall was passed: 5 % for the terms of higher order in it.
pub const PASSED: f64 = 1.05;
/// Depths below this share of the scene's gap scale are rounding, for bounds of 0.
pub const TOUCH: f64 = 1e-9;
/// Speeds below this share of the reference's largest are rest.
pub const REST: f64 = 1e-3;

/// What becomes of a scene under a scheme at a step, from harmless to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Energy, speeds and contacts as the reference has them.
    Stable,
    /// More than [`LOSS`] of the energy lost per impact, or motion below [`SLOW`].
    Dissipative,
    /// The body stands still where it should move: it crosses the gap in less than a step.
    Frozen,
    /// A wall passed beyond the scheme's bound, or contacts off by more than [`MISCOUNTED`].
    Missed,
    /// More than [`GAIN`] of the energy gained per impact, speeds above [`FAST`], or no rest where rest is due.
    Gaining,
    /// Speeds beyond [`DIVERGED`], numbers that are not finite, or a step that cannot be solved.
    Diverged,
}

impl Class {
    /// Every class, from harmless to worst.
    pub const ALL: [Self; 6] =
        [Self::Stable, Self::Dissipative, Self::Frozen, Self::Missed, Self::Gaining, Self::Diverged];

    /// The name in tables and legends.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Dissipative => "dissipative",
            Self::Frozen => "frozen",
            Self::Missed => "contacts missed",
            Self::Gaining => "energy-gaining",
            Self::Diverged => "diverged",
        }
    }

    /// The letter on a map.
    #[must_use]
    pub fn letter(self) -> char {
        match self {
            Self::Stable => 'S',
            Self::Dissipative => 'D',
            Self::Frozen => 'F',
            Self::Missed => 'M',
            Self::Gaining => 'G',
            Self::Diverged => 'X',
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Whether the body comes to rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rest {
    /// The reference does not rest.
    NotDue,
    /// It rests, as the reference does.
    Reached,
    /// It moves where the reference rests.
    Missing,
}

impl fmt::Display for Rest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::NotDue => "not due",
            Self::Reached => "reached",
            Self::Missing => "missing",
        })
    }
}

/// A fine run that others are held against.
#[derive(Debug, Clone)]
pub struct Ruler {
    /// Largest speed, m/s.
    pub speed: f64,
    rms_speed: f64,
    energy_ratio: f64,
    /// Approach speed above which a contact is counted, m/s.
    threshold: f64,
    /// Number of contacts counted.
    pub contacts: usize,
    rests: bool,
}

impl Ruler {
    /// The ruler that a fine run makes.
    #[must_use]
    pub fn new(record: &Record) -> Self {
        let threshold = COUNTED * record.contacts.iter().map(|c| c.approach_speed).fold(0.0, f64::max);
        Self {
            speed: record.speed,
            rms_speed: record.rms_speed,
            energy_ratio: energy_ratio(&record.contacts, threshold).unwrap_or(0.0),
            threshold,
            contacts: counted(&record.contacts, threshold).count(),
            rests: record.last_speed < REST * record.speed,
        }
    }

    /// Times of the contacts counted, s.
    pub fn contact_times<'a>(&self, record: &'a Record) -> impl Iterator<Item = f64> + use<'a> {
        counted(&record.contacts, self.threshold).map(|c| c.start)
    }
}

fn counted(contacts: &[Contact], threshold: f64) -> impl Iterator<Item = &Contact> {
    contacts.iter().filter(move |c| c.approach_speed > threshold)
}

/// Kinetic energy that left the walls over that which arrived.
fn energy_ratio(contacts: &[Contact], threshold: f64) -> Option<f64> {
    let sum = |speed: fn(&Contact) -> f64| counted(contacts, threshold).map(|c| speed(c).powi(2)).sum::<f64>();
    let arrived = sum(|c| c.approach_speed);
    (arrived > 0.0).then(|| sum(|c| c.departure_speed.unwrap_or(0.0)) / arrived)
}

/// A run held against its ruler.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Kinetic energy that left the walls over that which arrived, less the same ratio in the reference: 0 where the scheme
    /// realises the law, a share of the arriving energy made (+) or taken (−) per impact elsewhere; none without a contact.
    pub growth: Option<f64>,
    /// Largest speed over the reference's.
    pub speed: f64,
    /// Root-mean-square speed over the reference's.
    pub rms_speed: f64,
    /// Contacts counted ([`COUNTED`]).
    pub contacts: usize,
    /// How many fewer than in the reference.
    pub missed: usize,
    /// How many more than in the reference.
    pub spurious: usize,
    /// Deepest position behind a wall at the end of a step, m.
    pub depth: f64,
    /// The largest ratio of depth and stated bound over the walls ([`depth_bound`]); 0 where no wall is passed.
    pub passed: f64,
    /// Share of steps in which opposite walls took turns.
    pub frozen: f64,
    /// Whether it rests.
    pub rest: Rest,
}

impl Measurement {
    /// The run `record` of `scene` (as the scheme sees it) by `scheme` with steps of `h` (s) against `ruler`.
    #[must_use]
    pub fn new(record: &Record, ruler: &Ruler, scene: &Scene, scheme: &Scheme, scale: &Scale, h: f64) -> Self {
        let over = |x: f64, reference: f64| if x == reference { 1.0 } else { x / reference };
        let contacts = counted(&record.contacts, ruler.threshold).count();
        let touch = TOUCH * scene.gap_scale();
        let passed = scene.walls.iter().zip(&record.depth).filter(|(_, depth)| **depth > touch);
        let bound = |law| depth_bound(law, scheme, scale, h, record.speed, record.acceleration).max(touch);
        Self {
            growth: energy_ratio(&record.contacts, ruler.threshold).map(|ratio| ratio - ruler.energy_ratio),
            speed: over(record.speed, ruler.speed),
            rms_speed: over(record.rms_speed, ruler.rms_speed),
            contacts,
            missed: ruler.contacts.saturating_sub(contacts),
            spurious: contacts.saturating_sub(ruler.contacts),
            depth: record.depth.iter().copied().fold(0.0, f64::max),
            passed: passed.map(|(wall, depth)| depth / bound(wall.law)).fold(0.0, f64::max),
            frozen: record.frozen_steps as f64 / record.steps.max(1) as f64,
            rest: match (ruler.rests, record.last_speed < REST * ruler.speed) {
                (false, _) => Rest::NotDue,
                (true, true) => Rest::Reached,
                (true, false) => Rest::Missing,
            },
        }
    }

    /// The class, and the finding that decided it.
    #[must_use]
    pub fn classify(&self) -> (Class, String) {
        let growth = self.growth.unwrap_or(0.0);
        let reference = self.contacts + self.missed - self.spurious;
        let (most, least) = (self.contacts.max(reference) as f64, self.contacts.min(reference) as f64);
        let count = || format!("{} contacts, the reference has {reference}", self.contacts);
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        if self.speed > DIVERGED {
            return (Class::Diverged, format!("speed {:.1} times the reference's", self.speed));
        }
        if self.frozen > FROZEN {
            return (Class::Frozen, format!("opposite walls take turns in {} of the steps", percent(self.frozen)));
        }
        if self.rms_speed < STILL {
            return (Class::Frozen, "the body stands still".to_owned());
        }
        if self.passed > PASSED {
            return (Class::Missed, format!("a wall passed by {:.2} times the stated depth", self.passed));
        }
        if growth > GAIN {
            return (Class::Gaining, format!("{} of the energy gained per impact", percent(growth)));
        }
        if self.speed > FAST {
            return (Class::Gaining, format!("speed {:.2} times the reference's", self.speed));
        }
        if self.rest == Rest::Missing {
            return (Class::Gaining, "still moving where rest is due".to_owned());
        }
        if growth < -LOSS {
            return (Class::Dissipative, format!("{} of the energy lost per impact", percent(-growth)));
        }
        if self.rms_speed < SLOW {
            return (Class::Dissipative, format!("mean speed {:.2} times the reference's", self.rms_speed));
        }
        if most >= FEW as f64 && most > MISCOUNTED * least {
            return (Class::Missed, count());
        }
        (Class::Stable, count())
    }
}
