//! Classification of a run from its measurements.

use super::fine_reference::{FineReference, REST, exchanged};
use super::recorded_run::{Record, depth_bound};
use crate::error::names;
use crate::scene::{Scene, System};
use crate::scheme::Scheme;
use crate::step::Contact;
use std::fmt;

/// Speed above this multiple of the reference's largest counts as diverged: the energy is up by
/// more than a hundred.
pub const DIVERGED: f64 = 10.0;
/// Share of the arriving energy gained per impact above which a scheme gains energy: 1 % compounds
/// to a factor e in a hundred impacts, one run of the case `rigid-walls-sine`.
pub const GAIN: f64 = 0.01;
/// Share of the arriving energy lost per impact above which a scheme dissipates: 5 % is a
/// restitution off by 0.025, less than the uncertainty of the restitution of any real wall. A loss
/// does not compound, since the load replaces it.
pub const LOSS: f64 = 0.05;
/// Speed over the reference's largest above which the motion is a different one: twice its energy.
pub const FAST: f64 = 1.5;
/// Root-mean-square speed over the reference's below which the motion is a different one: half its
/// energy.
pub const SLOW: f64 = 0.7;
/// Share of steps in which opposite walls push alternately above which a body is frozen; a body
/// that crosses the gap in one step now and then is not.
pub const FROZEN: f64 = 0.01;
/// Root-mean-square speed over the reference's below which a body stands still.
pub const STILL: f64 = 0.01;
/// Contact counts that differ by more than this factor are wrong.
pub const MISCOUNTED: f64 = 2.0;
/// Contact counts below this are too few to compare by a factor.
pub const FEW: usize = 4;
/// Depth over the stated bound above which a wall was passed: 5 % allow for the higher-order terms
/// of the bound.
pub const PASSED: f64 = 1.05;
/// Depths below this share of the scene's gap scale are rounding, where the bound is 0.
pub const TOUCH: f64 = 1e-9;

/// Behaviour of a scheme on a scene at a step, from harmless to worst.
///
/// Stable does not mean accurate: it means that the motion is of the right kind, without spurious
/// gain or loss.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Energy changes as the wall laws say; speeds, contacts and rest agree with the reference.
    Stable,
    /// More than [`LOSS`] of the energy that arrives at the walls is lost per impact, beyond what
    /// restitution takes.
    Dissipative,
    /// The body stands still where it should move: it crosses the gap in less than a step, or the
    /// steps do not sample the load.
    Frozen,
    /// The energy is kept but the motion is a different one: a wall passed beyond the scheme's
    /// bound, contacts off by more than [`MISCOUNTED`], speeds above [`FAST`] or below [`SLOW`], or
    /// no rest where the reference rests.
    Astray,
    /// More than [`GAIN`] of the energy that arrives at the walls is gained per impact.
    Gaining,
    /// Speeds beyond [`DIVERGED`], values that are not finite, or a step that cannot be solved.
    Diverged,
}

names!(Class,
    Stable => "stable", Dissipative => "dissipative", Frozen => "frozen", Astray => "another-motion",
    Gaining => "energy-gaining", Diverged => "diverged");

impl Class {
    /// The letter on a map.
    #[must_use]
    pub fn letter(self) -> char {
        match self {
            Self::Stable => 'S',
            Self::Dissipative => 'D',
            Self::Frozen => 'F',
            Self::Astray => 'A',
            Self::Gaining => 'G',
            Self::Diverged => 'X',
        }
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

/// A run compared with its reference runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// Energy that the scheme produced, beyond what restitution takes, over the kinetic energy that
    /// arrived at the walls: the share gained (+) or lost (−) per impact; `None` without a contact.
    /// With several degrees of freedom: the energy produced in all, at and between the walls (+),
    /// or taken beyond what the walls of the reference take (−), over the larger of the energy that
    /// arrived and the reference's largest kinetic energy.
    pub growth: Option<f64>,
    /// Largest speed over the reference's.
    pub speed: f64,
    /// Root-mean-square speed over the reference's.
    pub rms_speed: f64,
    /// Number of contacts counted ([`COUNTED`](super::fine_reference::COUNTED)).
    pub contacts: usize,
    /// How many fewer than in any reference run.
    pub missed: usize,
    /// How many more than in any reference run.
    pub spurious: usize,
    /// Number of contacts over the reference's.
    pub contact_ratio: f64,
    /// Deepest position behind a wall at the end of a step, m.
    pub depth: f64,
    /// The largest ratio of depth and stated bound over the walls (`depth_bound`); 0 where no
    /// wall is passed.
    pub passed: f64,
    /// Share of steps in which opposite walls push alternately.
    pub frozen: f64,
    /// Whether the body comes to rest.
    pub rest: Rest,
    /// Time at which the speed exceeded the limit, s.
    pub escaped: Option<f64>,
}

impl Measurement {
    /// Measures the run `record` of `scene` (as the scheme sees it) by `scheme` with steps of `h`
    /// (s) against `ruler`.
    #[must_use]
    pub fn new(record: &Record, ruler: &FineReference, scene: &Scene, scheme: &Scheme, h: f64) -> Self {
        let contacts = ruler.contact_times(record).len();
        let touch = TOUCH * scene.gap_scale();
        let masses = scene.wall_masses();
        let passed = scene.walls.iter().zip(&record.depth).enumerate().filter(|(_, (_, depth))| **depth > touch);
        let of = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
        let bound = |index: usize, law| {
            let (v, a) = (of(&record.wall_speed, index), of(&record.acceleration, index));
            // The energy that can reach a wall: that of the mass at the wall for an oscillator,
            // that of everything that moves for a structure.
            let energy = match scene.system {
                System::Oscillator(_) => 0.5 * of(&masses, index) * v * v,
                _ => ruler.energy,
            };
            depth_bound(law, scheme, of(&masses, index), energy, h, v, a).max(touch)
        };
        Self {
            growth: growth(record, scene, &masses, ruler),
            speed: ruler.speed.ratio(record.speed),
            rms_speed: ruler.rms_speed.ratio(record.rms_speed),
            contacts,
            missed: (ruler.contacts.low as usize).saturating_sub(contacts),
            spurious: contacts.saturating_sub(ruler.contacts.high as usize),
            contact_ratio: ruler.contacts.ratio(contacts as f64),
            depth: record.depth.iter().copied().fold(0.0, f64::max),
            passed: passed.map(|(index, (wall, depth))| depth / bound(index, wall.law)).fold(0.0, f64::max),
            frozen: record.frozen_steps as f64 / record.steps.max(1) as f64,
            rest: match (ruler.rests, record.last_speed < REST * ruler.speed.high) {
                (false, _) => Rest::NotDue,
                (true, true) => Rest::Reached,
                (true, false) => Rest::Missing,
            },
            escaped: record.escaped,
        }
    }

    /// The class, and the criterion that decided it.
    #[must_use]
    pub fn classify(&self) -> (Class, String) {
        let growth = self.growth.unwrap_or(0.0);
        let percent = |x: f64| format!("{:.1} %", 100.0 * x);
        let many = self.contacts + self.missed >= FEW;
        if let Some(time) = self.escaped {
            return (Class::Diverged, format!("speed {:.0} times the reference's at t = {time:.4} s", self.speed));
        }
        if self.speed > DIVERGED {
            return (Class::Diverged, format!("speed {:.1} times the reference's", self.speed));
        }
        if self.frozen > FROZEN {
            return (
                Class::Frozen,
                format!("opposite walls push alternately in {} of the steps", percent(self.frozen)),
            );
        }
        if self.rms_speed < STILL {
            return (Class::Frozen, "the body stands still".to_owned());
        }
        if growth > GAIN {
            return (Class::Gaining, format!("{} of the energy gained per impact", percent(growth)));
        }
        if growth < -LOSS {
            // More than all that arrives is lost between the impacts, too.
            let lost = match -growth {
                lost if lost <= 1.0 => format!("{} of the energy lost per impact", percent(lost)),
                lost => format!("{lost:.1} times the energy lost that arrives at the walls"),
            };
            return (Class::Dissipative, lost);
        }
        if self.passed > PASSED {
            return (Class::Astray, format!("a wall passed by {:.2} times the stated depth", self.passed));
        }
        if many && self.contact_ratio > MISCOUNTED {
            return (Class::Astray, format!("{} contacts too many", self.spurious));
        }
        if many && self.contact_ratio < 1.0 / MISCOUNTED {
            return (Class::Astray, format!("{} contacts missed", self.missed));
        }
        if self.speed > FAST {
            return (Class::Astray, format!("speed {:.2} times the reference's", self.speed));
        }
        if self.rms_speed < SLOW {
            return (Class::Astray, format!("mean speed {:.2} times the reference's", self.rms_speed));
        }
        if self.rest == Rest::Missing {
            return (Class::Astray, "still moving where rest is due".to_owned());
        }
        (Class::Stable, String::new())
    }
}

/// For one degree of freedom: kinetic energy with which the body leaves rigid walls beyond e² times
/// that of its arrival, plus the energy that the scheme produced elsewhere, over the kinetic energy
/// that arrived at all walls.
fn growth(record: &Record, scene: &Scene, masses: &[f64], ruler: &FineReference) -> Option<f64> {
    if let System::Structure(_) = scene.system {
        let share = record.made / exchanged(record, masses, ruler.energy);
        // Walls that take less energy than those of the reference make the motion livelier but
        // produce none: only a positive share is a gain.
        let growth = if share > 0.0 { share } else { ruler.taken.beyond(share).min(0.0) };
        return (!record.contacts.is_empty()).then_some(growth);
    }
    let mass = masses.iter().copied().reduce(f64::min).unwrap_or(0.0);
    let energy = |speed: f64| 0.5 * mass * speed * speed;
    let arrived: f64 = record.contacts.iter().map(|c| energy(c.approach_speed)).sum();
    let beyond = |c: &Contact| match (scene.walls.get(c.wall).and_then(|w| w.law.restitution()), c.departure_speed) {
        (Some(e), Some(departure)) => energy(departure) - e * e * energy(c.approach_speed),
        _ => 0.0,
    };
    (arrived > 0.0).then(|| (record.made + record.contacts.iter().map(beyond).sum::<f64>()) / arrived)
}
