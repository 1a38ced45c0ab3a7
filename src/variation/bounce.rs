//! The impact of one degree of freedom on a rigid wall, with nothing else touched: the saltation
//! matrix and the terms of keys of `jump.rs` for a single row, in plain numbers.

use super::contact_changes::is_late;
use super::instant::{GRAZING, ONCE, STUCK};
use super::keys::Keys;
use super::structure::{At, StructureVariation};
use crate::step::Step;

/// The impact.
#[derive(Debug, Clone, Copy)]
struct Bounce {
    wall: usize,
    sign: f64,
    restitution: f64,
    /// kg; and c, N s/m.
    mass: f64,
    damping: f64,
    /// Displacement, m; velocity before and after, m/s; acceleration before, m/s².
    q: f64,
    before: f64,
    after: f64,
    acceleration: f64,
}

/// What a key changes at the impact.
#[derive(Debug, Clone, Copy, Default)]
struct KeyChange {
    /// δG q − δg, m, δG and δe of the wall, and δm.
    offset: f64,
    row: f64,
    restitution: f64,
    mass: f64,
}

/// What the impact makes of a change: of instant, approach and departure speed and impulse, and of
/// the state after it.
struct Bounced {
    later: f64,
    approach: f64,
    departure: f64,
    impulse: f64,
    state: [f64; 2],
}

impl Bounce {
    fn of(&self, key: KeyChange, [q, v]: [f64; 2]) -> Bounced {
        let Self { sign, restitution: e, mass, damping, before, after, acceleration, .. } = *self;
        let beyond = q + key.offset;
        let later = -beyond / before;
        let faster = v + key.row * before + acceleration * later;
        let left = e * faster + key.restitution * before;
        // What mass and row make of the impulse itself, with the instant moved.
        let own = (key.row * mass - key.mass) * (after - before) / mass;
        let kick = (1.0 + e) * (acceleration / before + damping / mass);
        Bounced {
            later,
            approach: -sign * faster,
            departure: -sign * left,
            impulse: mass * (-left - key.row * after - own - v - acceleration * later),
            state: [
                q - (1.0 + e) * beyond,
                -e * (v + key.row * before) - key.restitution * before - key.row * after + kick * beyond,
            ],
        }
    }
}

impl StructureVariation {
    /// Applies the impact at the end of `step` to the columns, and notes what the keys change of
    /// its contact, if it is the bounce of a single degree of freedom from one wall, and nothing
    /// else touches before or after it; false if not.
    pub fn bounce(&mut self, step: &Step<'_>, columns: &mut [f64]) -> bool {
        let Some(bounce) = self.found_bounce(step) else { return false };
        let Self { keys: Keys { terms, contacts, .. }, .. } = self;
        contacts.begin(bounce.wall);
        let mut columns = columns.chunks_exact_mut(2);
        for (number, (terms, change)) in terms.iter().zip(columns.by_ref()).enumerate() {
            let &mut [q, v] = change else { continue };
            let key = KeyChange {
                offset: terms.offset(bounce.wall, &[bounce.q]),
                row: terms.along(bounce.wall, &[1.0]),
                restitution: terms.restitution(bounce.wall),
                mass: terms.mass_of_one(),
            };
            let found = bounce.of(key, [q, v]);
            contacts.set_start(bounce.wall, number, [found.later, found.approach]);
            contacts.set_end(bounce.wall, number, [found.later, found.departure]);
            contacts.add_impulse(bounce.wall, number, found.impulse);
            change.copy_from_slice(&found.state);
        }
        for change in columns {
            let &mut [q, v] = change else { continue };
            change.copy_from_slice(&bounce.of(KeyChange::default(), [q, v]).state);
        }
        step.closed.iter().filter(|contact| !is_late(contact, step)).for_each(|contact| contacts.end(contact));
        self.keys.motion.forget(step.end);
        true
    }

    fn found_bounce(&self, step: &Step<'_>) -> Option<Bounce> {
        let [mass, damping, _] = self.arcs.as_ref()?.body();
        let mut struck = step.jump.iter().enumerate().filter(|(_, p)| **p != 0.0);
        let (wall, _) = struck.next()?;
        let at = self.walls.get(wall)?;
        let restitution = at.restitution.filter(|e| *e > 0.0)?;
        let touched = self.during.iter().any(|&held| held) || self.walls.iter().any(|at| at.during);
        let shares = |(other, one): (usize, &At)| other != wall && at.shares_place(one, GRAZING * self.length);
        if self.walls.iter().enumerate().any(shares) {
            return None;
        }
        let presses = step.force.iter().any(|&force| force != 0.0);
        if struck.next().is_some() || touched || presses || self.keys.loads.has_blows() || step.end <= step.start {
            return None;
        }
        let ([before], [after], [q], [acceleration]) = (&self.v[..], step.v, &self.q[..], &self.a[..]) else {
            return None;
        };
        // Once, and not to rest.
        let rebounds = after.abs() >= STUCK * restitution * before.abs()
            && (after + restitution * before).abs() <= ONCE * before.abs();
        (rebounds && *before != 0.0).then_some(Bounce {
            wall,
            sign: at.sign,
            restitution,
            mass,
            damping,
            q: *q,
            before: *before,
            after: *after,
            acceleration: *acceleration,
        })
    }
}
