//! The signature of a periodic orbit: its events in order.

use crate::error::{Error, Result, names};
use crate::scene::Scene;

/// What happens at a wall. Each event has a speed, defined here for each kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// An impact on a rigid wall, q̇⁺ = −e q̇⁻. Its speed is the approach speed.
    Impact,
    /// An impact after which the body rests on the wall; its speed is the approach speed.
    Rest,
    /// The first of impacts that accumulate and end at rest; its speed is the approach speed.
    Chatter,
    /// The end of a rest; its speed is 0.
    Release,
    /// The body meets an elastic wall; its speed is the approach speed.
    Enter,
    /// The force of an elastic wall vanishes; its speed is that away from the wall.
    Leave,
    /// An elastic wall with a dashpot pushes again before the body is out of it; its speed is that
    /// away from the wall.
    Again,
    /// A wall pushes without end, and nothing else happens; its speed is 0. Of orbits that are told
    /// by a state alone.
    Always,
}

names!(Kind: "kind of event",
    Impact => "impact", Rest => "rest", Chatter => "chatter", Release => "release", Enter => "enter",
    Leave => "leave", Again => "again", Always => "always");

impl Kind {
    /// True for a kind whose speed is an approach speed.
    #[must_use]
    pub fn is_approach(self) -> bool {
        matches!(self, Self::Impact | Self::Rest | Self::Chatter | Self::Enter)
    }

    /// True for a kind that needs a rigid wall.
    #[must_use]
    pub fn is_rigid(self) -> bool {
        matches!(self, Self::Impact | Self::Rest | Self::Chatter | Self::Release)
    }
}

/// One event: its kind and its wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Event {
    /// What happens.
    pub kind: Kind,
    /// Index of the wall in the scene.
    pub wall: usize,
}

/// The cyclic list of the events of a periodic orbit.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Signature {
    /// The events in order; those of the first half where the orbit is symmetric; none for a motion
    /// that touches no wall.
    pub events: Vec<Event>,
    /// Forcing periods after which the orbit repeats itself, from 1.
    pub periods: u32,
    /// True for an orbit that is its own mirror image half an orbit later; `periods` is odd then.
    pub symmetric: bool,
}

/// The most forcing periods of an orbit.
pub const MOST_PERIODS: u32 = 64;

/// The most events of a signature: the system of equations is dense.
pub const MOST_EVENTS: usize = 256;

impl Signature {
    /// Impacts on these walls, in order, over that many forcing periods.
    #[must_use]
    pub fn impacts(walls: &[usize], periods: u32) -> Self {
        let events = walls.iter().map(|&wall| Event { kind: Kind::Impact, wall }).collect();
        Self { events, periods, symmetric: false }
    }

    /// Forcing periods after which an event is repeated; for a symmetric orbit, after which its
    /// mirror image follows.
    #[must_use]
    pub fn cycles(&self) -> f64 {
        f64::from(self.periods) * if self.symmetric { 0.5 } else { 1.0 }
    }

    /// True if the body rests on a wall somewhere in the orbit.
    #[must_use]
    pub fn rests(&self) -> bool {
        self.events.iter().any(|event| event.kind == Kind::Release)
    }

    /// True if impacts accumulate somewhere in the orbit.
    #[must_use]
    pub fn chatters(&self) -> bool {
        self.events.iter().any(|event| event.kind == Kind::Chatter)
    }

    /// The signature that `text` writes for the walls of `scene`: events with commas or spaces
    /// between them, each a wall's name, or the name, a colon and the kind of the event
    /// (`upper`, `upper:rest`). Where no two walls begin with the same letter, letters alone write
    /// impacts: `UL`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a wall or kind that does not exist; [`Error::Invalid`] for an event
    /// that the wall does not have, or more than [`MOST_EVENTS`].
    pub fn parse(text: &str, periods: u32, scene: &Scene) -> Result<Self> {
        let words: Vec<&str> = text.split([',', ' ']).filter(|word| !word.is_empty()).collect();
        let letters = initials(scene);
        let by_letters = |word: &str| {
            let find = |c: char| letters.as_ref()?.iter().position(|&letter| letter == c.to_ascii_uppercase());
            word.chars().map(find).collect::<Option<Vec<usize>>>()
        };
        let mut events = Vec::new();
        for word in words {
            let known = scene.walls.iter().any(|wall| wall.name == word);
            if let (false, Some(walls)) = (known, by_letters(word)) {
                events.extend(walls.into_iter().map(|wall| Event { kind: Kind::Impact, wall }));
                continue;
            }
            let (name, kind) = word.split_once(':').unwrap_or((word, Kind::Impact.name()));
            events.push(Event { kind: kind.parse()?, wall: scene.wall_index(name)? });
        }
        let signature = Self { events, periods, symmetric: false };
        signature.check(scene)?;
        Ok(signature)
    }

    /// Checks the signature against the walls of `scene`.
    ///
    /// # Errors
    /// [`Error::Invalid`], saying what would be accepted.
    pub fn check(&self, scene: &Scene) -> Result<()> {
        let wrong = |found: String, expected: String| Err(Error::invalid("signature", found, expected));
        if !(1..=MOST_PERIODS).contains(&self.periods) {
            return wrong(format!("of {} forcing periods", self.periods), format!("1 to {MOST_PERIODS} of them"));
        }
        if self.symmetric && self.periods.is_multiple_of(2) {
            return wrong(
                format!("symmetric over {} forcing periods", self.periods),
                "an odd number of forcing periods: half of a symmetric orbit ends half a period after whole ones"
                    .to_owned(),
            );
        }
        if self.events.len() > MOST_EVENTS {
            return wrong(format!("{} events", self.events.len()), format!("at most {MOST_EVENTS}"));
        }
        for (index, event) in self.events.iter().enumerate() {
            let Some(wall) = scene.walls.get(event.wall) else {
                return wrong(format!("at wall {}", event.wall + 1), format!("one of {} walls", scene.walls.len()));
            };
            if event.kind == Kind::Always {
                return wrong(
                    format!("always at wall {:?}", wall.name),
                    "events: a motion that never leaves its wall is told by its state".to_owned(),
                );
            }
            if event.kind.is_rigid() != wall.law.is_rigid() {
                let law = if wall.law.is_rigid() { "rigid" } else { "elastic" };
                let fits = if wall.law.is_rigid() { "impact, rest and release" } else { "enter, leave and again" };
                return wrong(
                    format!("{} at wall {:?}, which is {law}", event.kind.name(), wall.name),
                    format!("{fits} there"),
                );
            }
            let bounces = wall.law.restitution().filter(|e| event.kind == Kind::Rest && *e > 0.0);
            if let Some(e) = bounces {
                return wrong(
                    format!("rest at wall {:?}, whose restitution is {e:?}", wall.name),
                    "chatter there, or a restitution of 0: only without a rebound does one impact end in rest"
                        .to_owned(),
                );
            }
            let next = self.events.get(index + 1).or_else(|| self.events.first().filter(|_| !self.symmetric));
            let resting = matches!(event.kind, Kind::Rest | Kind::Chatter);
            let release = Event { kind: Kind::Release, wall: event.wall };
            if resting && next.is_some_and(|next| *next != release) {
                return wrong(
                    format!("{} at wall {:?} without its release", event.kind.name(), wall.name),
                    "a rest, then the release from that wall".to_owned(),
                );
            }
        }
        Ok(())
    }

    /// The signature in the words that [`Signature::parse`] reads.
    #[must_use]
    pub fn written(&self, scene: &Scene) -> String {
        let letters = initials(scene);
        if let (Some(letters), true) = (&letters, self.events.iter().all(|event| event.kind == Kind::Impact)) {
            return self.events.iter().filter_map(|event| letters.get(event.wall)).collect();
        }
        let name = |wall: usize| scene.wall_name(wall).unwrap_or_default();
        let word = |event: &Event| match event.kind {
            Kind::Impact => name(event.wall).to_owned(),
            kind => format!("{}:{}", name(event.wall), kind.name()),
        };
        self.events.iter().map(word).collect::<Vec<_>>().join(" ")
    }
}

/// The capital first letter of each wall's name, if they differ.
fn initials(scene: &Scene) -> Option<Vec<char>> {
    let letters: Vec<char> =
        scene.walls.iter().filter_map(|wall| wall.name.chars().next()).map(|c| c.to_ascii_uppercase()).collect();
    let alone = |(index, letter): (usize, &char)| !letters[..index].contains(letter) && letter.is_ascii_alphabetic();
    (letters.len() == scene.walls.len() && letters.iter().enumerate().all(alone)).then_some(letters)
}
