//! The derivatives of contacts.
//!
//! An event at the zero of a function of state, time and key moves by δt: that which δt removes
//! from the function is what the change at a fixed instant adds to it. So an impact moves by
//! δt = −(G δq + δG q − δg)/G q̇⁻, its approach speed changes as G q̇⁻ does at the moved instant,
//! and its impulse p as in Newton's law there. The impulse ∫r dt of a lasting contact changes by
//! ∫δr dt and, at each event within it at which its force jumps from r⁻ to r⁺, by (r⁻ − r⁺) δt. It
//! ends where its force vanishes, so that the end moves by −δr/ṙ, or with the instant of an impact
//! elsewhere that ends it.

use crate::step::{Contact, Step};

/// A contact, and its derivatives with respect to each key.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactDerivative<'a> {
    /// The contact.
    pub contact: &'a Contact,
    /// Of the time at which it begins, s per unit of the key.
    pub start_by: &'a [f64],
    /// Of the time at which it ends, s per unit of the key. NaN where several impacts elsewhere at
    /// one instant end a lasting contact: this derivative is not known.
    pub end_by: &'a [f64],
    /// Of the approach speed, m/s per unit of the key.
    pub approach_speed_by: &'a [f64],
    /// Of the departure speed, m/s per unit of the key; NaN as `end_by`, and where a blow and an
    /// impact at one instant end a push.
    pub departure_speed_by: &'a [f64],
    /// Of the impulse, N s per unit of the key, signed as the impulse.
    pub impulse_by: &'a [f64],
    /// The largest growth of a change of the start until the contact ended.
    pub growth: f64,
}

/// The contacts of a run that have ended, in the order of their ends, with their derivatives.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ContactDerivatives {
    keys: usize,
    contacts: Vec<Contact>,
    /// Of those whose growth is noted: the contacts of a step that ends the derivatives are left
    /// out.
    growth: Vec<f64>,
    /// For each contact and [`Part`] one after the other a number for each key.
    by: Vec<f64>,
}

/// A number of a contact that has a derivative.
#[derive(Debug, Clone, Copy)]
enum Part {
    Start,
    End,
    Approach,
    Departure,
    Impulse,
}

/// Number of [`Part`]s.
const PARTS: usize = Part::Impulse as usize + 1;

impl ContactDerivatives {
    /// Number of contacts.
    #[must_use]
    pub fn len(&self) -> usize {
        self.growth.len()
    }

    /// True without contacts.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.growth.is_empty()
    }

    /// Contact number `index`, if there is one.
    #[must_use]
    pub fn get(&self, index: usize) -> Option<ContactDerivative<'_>> {
        let (contact, &growth) = self.contacts.get(index).zip(self.growth.get(index))?;
        let by = self.by.get(index * PARTS * self.keys..)?;
        let of =
            |part: Part| by.get(part as usize * self.keys..).and_then(|by| by.get(..self.keys)).unwrap_or_default();
        Some(ContactDerivative {
            contact,
            start_by: of(Part::Start),
            end_by: of(Part::End),
            approach_speed_by: of(Part::Approach),
            departure_speed_by: of(Part::Departure),
            impulse_by: of(Part::Impulse),
            growth,
        })
    }

    /// The contacts in the order of their ends.
    pub fn iter(&self) -> impl Iterator<Item = ContactDerivative<'_>> {
        (0..self.len()).filter_map(|index| self.get(index))
    }
}

/// True for a lasting contact that has ended before the motion of `step` begins: where the scheme
/// finds at its end a row with a speed of rounding size, it takes that away first, and releases the
/// row with the next step.
pub(super) fn is_late(contact: &Contact, step: &Step<'_>) -> bool {
    step.start < step.end && contact.start < step.start && contact.end.is_some_and(|end| end <= step.start)
}

/// The changes of the open contacts of each wall, and of those that have ended.
#[derive(Debug)]
pub(super) struct ContactChanges {
    keys: usize,
    /// For each key whether it has no derivatives any more.
    lost: Vec<bool>,
    /// Whether a contact of each wall is open.
    open: Vec<bool>,
    /// For each wall and [`Part`] one after the other the changes by each key of its open contact.
    changes: Vec<f64>,
    ended: ContactDerivatives,
    /// Of the impulses of each wall up to now, N s: for each wall the keys.
    total: Vec<f64>,
    /// Of the force of each wall at the end of the last stretch in contact, N.
    force: Vec<f64>,
}

impl ContactChanges {
    pub fn new(keys: usize, walls: usize) -> Self {
        Self {
            keys,
            lost: vec![false; keys],
            open: vec![false; walls],
            changes: vec![0.0; walls * PARTS * keys],
            ended: ContactDerivatives { keys, ..ContactDerivatives::default() },
            total: vec![0.0; walls * keys],
            force: vec![0.0; walls * keys],
        }
    }

    /// Begins a contact of `wall`, unless one is open.
    pub fn begin(&mut self, wall: usize) {
        let Some(open) = self.open.get_mut(wall).filter(|open| !**open) else { return };
        *open = true;
        for part in [Part::Start, Part::End, Part::Approach, Part::Departure, Part::Impulse] {
            let unknown = matches!(part, Part::End | Part::Departure);
            let first = (wall * PARTS + part as usize) * self.keys;
            let own = self.changes.get_mut(first..first + self.keys).unwrap_or_default();
            let none = |lost: bool| if unknown || lost { f64::NAN } else { 0.0 };
            own.iter_mut().zip(&self.lost).for_each(|(own, &lost)| *own = none(lost));
        }
        self.force.get_mut(wall * self.keys..(wall + 1) * self.keys).unwrap_or_default().fill(0.0);
    }

    /// Begins a contact of `wall`, unless one is open, without approach speed at an instant that
    /// moves as the beginning of the last contact there does, if that has ended at the time `since`
    /// (s) or later; else how it moves is not known.
    pub fn begin_again(&mut self, wall: usize, since: f64) {
        if self.open.get(wall) == Some(&true) {
            return;
        }
        let mut ended = self.ended.contacts.iter().enumerate().rev();
        let last = ended.find(|(_, contact)| contact.wall == wall);
        let last = last.filter(|(_, contact)| contact.end.is_some_and(|end| end >= since));
        let first = last.map(|(index, _)| (index * PARTS + Part::Start as usize) * self.keys);
        let starts: Vec<f64> = (0..self.keys)
            .map(|key| first.and_then(|first| self.ended.by.get(first + key)).copied().unwrap_or(f64::NAN))
            .collect();
        self.begin(wall);
        starts.into_iter().enumerate().for_each(|(key, start)| self.set_start(wall, key, [start, 0.0]));
    }

    /// Sets the changes of beginning (s) and approach speed (m/s) of the open contact of `wall`.
    pub fn set_start(&mut self, wall: usize, key: usize, [start, speed]: [f64; 2]) {
        self.set(wall, key, Part::Start, start);
        self.set(wall, key, Part::Approach, speed);
    }

    /// Sets the changes of end (s) and departure speed (m/s) of the open contact of `wall`.
    pub fn set_end(&mut self, wall: usize, key: usize, [end, speed]: [f64; 2]) {
        self.set(wall, key, Part::End, end);
        self.set(wall, key, Part::Departure, speed);
    }

    fn set(&mut self, wall: usize, key: usize, part: Part, change: f64) {
        let at = (wall * PARTS + part as usize) * self.keys + key;
        let known = self.lost.get(key) == Some(&false);
        self.changes.get_mut(at).into_iter().filter(|_| known).for_each(|own| *own = change);
    }

    /// Gives up the derivatives by `key`: of contacts that are open those of their starts hold.
    pub fn lose(&mut self, key: usize) {
        for wall in 0..self.open.len() {
            self.set_end(wall, key, [f64::NAN; 2]);
            self.add_impulse(wall, key, f64::NAN);
        }
        self.lost.get_mut(key).into_iter().for_each(|lost| *lost = true);
    }

    /// Sets the change of the force (N) of the open contact of `wall`.
    pub fn set_force(&mut self, wall: usize, key: usize, change: f64) {
        self.force.get_mut(wall * self.keys + key).into_iter().for_each(|force| *force = change);
    }

    /// That change, N.
    pub fn force(&self, wall: usize, key: usize) -> f64 {
        self.force.get(wall * self.keys + key).copied().unwrap_or(f64::NAN)
    }

    /// The changes of the impulses of each wall up to now, N s, open contacts included: for each
    /// wall a list of keys.
    pub fn total(&self) -> Vec<Vec<f64>> {
        let of = |wall: usize| self.total.get(wall * self.keys..(wall + 1) * self.keys).unwrap_or_default().to_vec();
        (0..self.open.len()).map(of).collect()
    }

    /// Adds a change of the impulse (N s) of the open contact of `wall`.
    pub fn add_impulse(&mut self, wall: usize, key: usize, change: f64) {
        let at = (wall * PARTS + Part::Impulse as usize) * self.keys + key;
        for sum in self.total.get_mut(wall * self.keys + key).into_iter().chain(self.changes.get_mut(at)) {
            *sum += change;
        }
    }

    /// Ends the contact of a wall.
    pub fn end(&mut self, contact: &Contact) {
        let Some(open) = self.open.get_mut(contact.wall).filter(|open| **open) else { return };
        *open = false;
        let of_wall = PARTS * self.keys;
        self.ended.contacts.push(*contact);
        let own = self.changes.get(contact.wall * of_wall..(contact.wall + 1) * of_wall).unwrap_or_default();
        self.ended.by.extend_from_slice(own);
    }

    /// Notes the growth up to now with the contacts that have ended since it was last noted.
    pub fn note_growth(&mut self, growth: f64) {
        self.ended.growth.resize(self.ended.contacts.len(), growth);
    }

    /// The number of contacts that are open.
    pub fn open(&self) -> usize {
        self.open.iter().filter(|open| **open).count()
    }

    /// The contacts that have ended; afterwards it has none of them.
    pub fn take_ended(&mut self) -> ContactDerivatives {
        let none = ContactDerivatives { keys: self.keys, ..ContactDerivatives::default() };
        std::mem::replace(&mut self.ended, none)
    }
}
