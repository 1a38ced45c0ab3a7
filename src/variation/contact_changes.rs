//! The derivatives of contacts.
//!
//! An event at the zero of a function of state, time and key moves by δt: that which δt removes
//! from the function is what the change at a fixed instant adds to it. So an impact moves by
//! δt = −(G δq + δG q − δg)/G q̇⁻, its approach speed changes as G q̇⁻ does at the moved instant,
//! and its impulse p as in Newton's law there. The impulse ∫r dt of a lasting contact changes by
//! ∫δr dt and, at each event within it at which its force jumps from r⁻ to r⁺, by (r⁻ − r⁺) δt. It
//! ends where its force vanishes, so that the end moves by −δr/ṙ, or with the instant of an impact
//! elsewhere that ends it.

use crate::step::Contact;

/// A contact, and its derivatives with respect to each key.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ContactDerivative {
    /// The contact.
    pub contact: Contact,
    /// Of the time at which it begins, s per unit of the key.
    pub start_by: Vec<f64>,
    /// Of the time at which it ends, s per unit of the key. NaN where a blow, or several impacts
    /// elsewhere at one instant, end a lasting contact: this derivative is not known.
    pub end_by: Vec<f64>,
    /// Of the approach speed, m/s per unit of the key.
    pub approach_speed_by: Vec<f64>,
    /// Of the departure speed, m/s per unit of the key; NaN as `end_by`.
    pub departure_speed_by: Vec<f64>,
    /// Of the impulse, N s per unit of the key, signed as the impulse.
    pub impulse_by: Vec<f64>,
    /// The largest growth of a change of the start until the contact ended.
    pub growth: f64,
}

/// The changes of the open contacts of each wall, and of those that have ended.
#[derive(Debug)]
pub(super) struct ContactChanges {
    keys: usize,
    open: Vec<Option<Open>>,
    ended: Vec<ContactDerivative>,
    /// The number of those whose growth is noted.
    noted: usize,
    /// Of the impulses of each wall up to now, N s: for each wall the keys.
    total: Vec<Vec<f64>>,
    /// Of the force of each wall at the end of the last stretch in contact, N.
    force: Vec<Vec<f64>>,
}

#[derive(Debug)]
struct Open {
    start: Vec<f64>,
    speed: Vec<f64>,
    impulse: Vec<f64>,
    end: Vec<f64>,
    departure: Vec<f64>,
}

impl ContactChanges {
    pub fn new(keys: usize, walls: usize) -> Self {
        let of_walls = || vec![vec![0.0; keys]; walls];
        let open = (0..walls).map(|_| None).collect();
        Self { keys, open, ended: Vec::new(), noted: 0, total: of_walls(), force: of_walls() }
    }

    /// Begins a contact of `wall`, unless one is open.
    pub fn begin(&mut self, wall: usize) {
        let zero = || vec![0.0; self.keys];
        if let Some(open) = self.open.get_mut(wall).filter(|open| open.is_none()) {
            let unknown = || vec![f64::NAN; self.keys];
            *open = Some(Open { start: zero(), speed: zero(), impulse: zero(), end: unknown(), departure: unknown() });
            self.force.get_mut(wall).into_iter().for_each(|force| force.fill(0.0));
        }
    }

    /// Sets the changes of beginning (s) and approach speed (m/s) of the open contact of `wall`.
    pub fn set_start(&mut self, wall: usize, key: usize, [start, speed]: [f64; 2]) {
        let Some(open) = self.open.get_mut(wall).and_then(Option::as_mut) else { return };
        if let (Some(a), Some(b)) = (open.start.get_mut(key), open.speed.get_mut(key)) {
            (*a, *b) = (start, speed);
        }
    }

    /// Sets the changes of end (s) and departure speed (m/s) of the open contact of `wall`.
    pub fn set_end(&mut self, wall: usize, key: usize, [end, speed]: [f64; 2]) {
        let Some(open) = self.open.get_mut(wall).and_then(Option::as_mut) else { return };
        if let (Some(a), Some(b)) = (open.end.get_mut(key), open.departure.get_mut(key)) {
            (*a, *b) = (end, speed);
        }
    }

    /// Sets the change of the force (N) of the open contact of `wall`.
    pub fn set_force(&mut self, wall: usize, key: usize, change: f64) {
        self.force.get_mut(wall).and_then(|force| force.get_mut(key)).into_iter().for_each(|force| *force = change);
    }

    /// That change, N.
    pub fn force(&self, wall: usize, key: usize) -> f64 {
        self.force.get(wall).and_then(|force| force.get(key)).copied().unwrap_or(f64::NAN)
    }

    /// The changes of the impulses of each wall up to now, N s, open contacts included.
    pub fn total(&self) -> &[Vec<f64>] {
        &self.total
    }

    /// Adds a change of the impulse (N s) of the open contact of `wall`.
    pub fn add_impulse(&mut self, wall: usize, key: usize, change: f64) {
        self.total.get_mut(wall).and_then(|of_wall| of_wall.get_mut(key)).into_iter().for_each(|sum| *sum += change);
        let open = self.open.get_mut(wall).and_then(Option::as_mut);
        if let Some(impulse) = open.and_then(|open| open.impulse.get_mut(key)) {
            *impulse += change;
        }
    }

    /// Ends the contact of a wall.
    pub fn end(&mut self, contact: &Contact) {
        let Some(Open { start, speed, impulse, end, departure }) =
            self.open.get_mut(contact.wall).and_then(Option::take)
        else {
            return;
        };
        self.ended.push(ContactDerivative {
            contact: *contact,
            start_by: start,
            end_by: end,
            approach_speed_by: speed,
            departure_speed_by: departure,
            impulse_by: impulse,
            growth: f64::NAN,
        });
    }

    /// Notes the growth up to now with the contacts that have ended since it was last noted.
    pub fn note_growth(&mut self, growth: f64) {
        self.ended.iter_mut().skip(self.noted).for_each(|one| one.growth = growth);
        self.noted = self.ended.len();
    }

    /// As [`Self::ended`], for good.
    pub fn take_ended(&mut self) -> Vec<ContactDerivative> {
        let mut ended = std::mem::take(&mut self.ended);
        ended.truncate(std::mem::take(&mut self.noted));
        ended
    }

    /// The contacts that have ended and whose growth is noted, in the order of their ends: those of
    /// a step that ends the derivatives are left out.
    pub fn ended(&self) -> &[ContactDerivative] {
        self.ended.get(..self.noted).unwrap_or_default()
    }
}
