//! The impact law at an instant, at flat and round walls with friction: in the metric of the mass,
//! with Coulomb's law on the impulses and the velocity after them.

use super::super::body::Body;
use super::super::frame::Frame;
use super::super::matrices::Matrices;
use super::super::space::Space;
use super::super::supports::{ContactRows, FrictionContact, FrictionContacts};
use super::contacts::Place;
use super::plane_contact::PlaneContact;
use crate::error::Result;
use crate::scene::Row;

/// The responses of the structure to impulses, and the solver of the contacts at an instant.
#[derive(Debug)]
pub(super) struct Impact {
    pub places: ContactRows,
    sweeps: FrictionContacts,
    /// Contacts that gave up their rebound at the last instant.
    pub wedged: Vec<usize>,
    pub instants: u64,
    /// The largest speed at which rebounds ended at the current instant, m/s.
    pub ended: f64,
}

impl Impact {
    pub fn new(body: &Body<Matrices>, rows: &[&Row], contacts: usize) -> Result<Self> {
        let places = ContactRows::new(body.n, rows, &mut Matrices::mass(&body.matrices)?);
        let sweeps = FrictionContacts::new(body.matrices.mass.clone(), rows, contacts);
        Ok(Self { places, sweeps, wedged: Vec::new(), instants: 0, ended: 0.0 })
    }

    /// Changes the velocity of `frame` by the impulses of the walls that are touched, and writes
    /// these. Without `rebounds` what arrives stays.
    pub fn strike(
        &mut self,
        body: &Body<Matrices>,
        contacts: &[PlaneContact],
        frame: &mut Frame<Matrices>,
        rebounds: bool,
    ) {
        let Self { places, sweeps, wedged, instants, ended } = self;
        *instants += 1;
        frame.resting.clear();
        sweeps.wedged.clear();
        sweeps.touches.clear();
        let e = |wall: usize| body.walls[wall].law.restitution().unwrap_or(0.0);
        for (wall, contact) in contacts.iter().enumerate() {
            // With the rebounds at a wall end those at one into which its impulse drove the body.
            let driven = e(wall) < 1.0 && contact.rate[0] <= *ended;
            if contact.place == Place::Struck && (driven || contact.rebounds_end(e(wall), body.h)) {
                frame.resting.push(wall);
            }
        }
        for (wall, contact) in contacts.iter().enumerate() {
            let rate = contact.rate[0];
            let bound = match contact.place {
                // What drives the body back into a wall that it leaves strikes it next.
                Place::Away | Place::Leaving => continue,
                Place::Resting if rate < 0.0 => -rate,
                Place::Struck if frame.resting.contains(&wall) => 0.0,
                Place::Struck | Place::Resting if !rebounds => {
                    wedged.push(wall);
                    0.0
                }
                Place::Resting | Place::Struck => -e(wall) * rate,
            };
            let (laws, at) = ((contact.point.friction.sliding, 0.0), (wall, contact.point.rows));
            sweeps.touches.push(FrictionContact::new(places, at, (contact.normal, bound), laws));
        }
        for (row, rate) in sweeps.free.iter_mut().enumerate() {
            *rate = places.seen(row, &frame.v);
        }
        // At an instant nothing but the impulses changes the velocities.
        sweeps.before.copy_from_slice(&sweeps.free);
        if sweeps.strike(places) {
            places.lift(&sweeps.impulse, &mut frame.v);
            sweeps.relieve(places);
        }
        wedged.extend_from_slice(&sweeps.wedged);
        for touch in sweeps.touches.iter().filter(|touch| touch.impulse[0] != 0.0) {
            let is_round = contacts[touch.index].round.is_some();
            let sign = if is_round { 1.0 } else { body.walls[touch.index].sign };
            frame.push_at_end(touch.index, sign * touch.impulse[0]);
            if frame.resting.contains(&touch.index) {
                *ended = ended.max(contacts[touch.index].rate[0]);
            }
            frame.friction[touch.index] = touch.impulse[1];
            frame.normal[touch.index] = if is_round { touch.normal } else { [0.0; 2] };
        }
    }

    /// Instants whose contacts were not settled, and those at which contacts gave up their rebound
    /// since they contradict it.
    pub fn unsettled_and_wedged(&self) -> [u64; 2] {
        [self.sweeps.unsettled, self.sweeps.gave_up]
    }
}
