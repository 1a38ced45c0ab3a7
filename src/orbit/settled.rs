//! The periodic orbit on which a run has settled.

use super::periodic::{Orbit, REPEATED};
use super::problem::Problem;
use super::signature::{Kind, Signature};
use super::watch::{Passage, Watch, gathered, orbit_of};
use crate::error::{Error, Result};
use crate::scheme::{Scheme, Stepper};
use crate::step::Contact;

/// Most forcing periods after which the events of a settled run may repeat themselves.
const LONGEST: u32 = 32;

/// Tolerance for events to count as repeated: in cycles, and in gaps times the forcing's Ω; where
/// there is no gap, as a share of the fastest event.
const NEAR: f64 = 1e-3;

/// How often they must have been repeated.
const REPEATS: usize = 3;

/// Forcing periods that a run settles before its motion is checked for repetition, unless told
/// otherwise: 400. Of a multiplier of 0.97, 5e-6 is left after them.
pub const SETTLE: u32 = 400;

impl Problem {
    /// The periodic orbit on which a run from the scene's initial state settles: `settle` forcing
    /// periods are run by the exact scheme, then as many as are needed to see the events repeat
    /// themselves three times after up to 32 forcing periods. [`Problem::correct`] then corrects
    /// them to rounding. An orbit that is its own mirror image is returned as its half.
    /// [`SETTLE`] is a usual value of `settle`.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] where the events do not repeat themselves, no orbit is found near them,
    /// or the motion never leaves a wall; those of a run.
    pub fn settled(&self, settle: u32) -> Result<Orbit> {
        self.settled_with(settle, &|_| {})
    }

    /// The same; `progress` is called with the share of the run that is done.
    ///
    /// # Errors
    /// As [`Problem::settled`].
    pub fn settled_with(&self, settle: u32, progress: &dyn Fn(f64)) -> Result<Orbit> {
        let period = self.forcing_period();
        let most = settle.saturating_add((REPEATS as u32 + 2) * LONGEST);
        let end = f64::from(most) * period;
        let mut stepper = Stepper::new(&self.scene().clone().with_duration(end), &Scheme::Event, 16.0 * period)?;
        let mut watch = Watch::new(self.scene(), period);
        let mut look = settle.saturating_add(8);
        while look <= most {
            let until = f64::from(look) * period;
            while stepper.time() < until {
                watch.observe(&stepper.step()?);
                progress(stepper.time() / end);
            }
            let settled = watch.passages.partition_point(|passage| passage.phase < f64::from(settle));
            let passages = watch.passages.get(settled..).unwrap_or_default();
            if passages.is_empty() && look == most {
                return match stepper.open_contacts().first() {
                    Some(contact) => Err(self.pressed(contact)),
                    None => self.still(),
                };
            }
            if let Some(found) = repeated(passages, self) {
                return self.recovered(found);
            }
            if look == most {
                break;
            }
            look = (2 * look - settle).min(most);
        }
        Err(Error::no_orbit(format!(
            "the events do not repeat themselves within {LONGEST} forcing periods after {settle} of them: the motion \
             is chaotic or has not settled yet (settle longer, or start elsewhere)"
        )))
    }

    /// Why a motion that never leaves a wall is not told.
    fn pressed(&self, contact: &Contact) -> Error {
        let wall = self.scene().wall_name(contact.wall).unwrap_or_default();
        Error::no_orbit(format!(
            "the motion never leaves the wall {wall:?}: it has no events to tell the orbit by, and a state, by which \
             orbits of structures are found (shoot)"
        ))
    }

    /// The motion that touches no wall.
    fn still(&self) -> Result<Orbit> {
        self.quiet()?;
        let symmetric = self.is_symmetric();
        let signature = Signature { events: Vec::new(), periods: 1, symmetric };
        Ok(Orbit { signature, phases: Vec::new(), speeds: Vec::new(), forcing_period: self.forcing_period() })
    }

    fn recovered(&self, (periods, passages): (u32, Vec<Passage>)) -> Result<Orbit> {
        let mut passages = gathered(passages, self.scene());
        let first = passages.iter().position(|passage| passage.event.kind == Kind::Release).unwrap_or(0);
        passages.rotate_left(first);
        let count = passages.len();
        for passage in passages.iter_mut().skip(count - first) {
            passage.phase += f64::from(periods);
        }
        let orbit = orbit_of(&passages, periods, self.forcing_period());
        if orbit.signature.chatters() {
            // An orbit with chatter is run from one release from rest to the next, and is exact
            // already.
            return Ok(orbit.repeated(REPEATED).unwrap_or(orbit).rotated(0, 1));
        }
        let whole = self.correct(&orbit)?;
        match whole.folded(self.mirror(), REPEATED) {
            Some(half) => self.correct(&half),
            None => Ok(whole),
        }
    }
}

/// The least number of forcing periods after which the last of `passages` repeat themselves, and
/// those of one such stretch.
fn repeated(passages: &[Passage], problem: &Problem) -> Option<(u32, Vec<Passage>)> {
    let fastest = || passages.iter().fold(0.0, |most: f64, passage| most.max(passage.speed.abs()));
    let speed = problem.scene().orbit_gap().map_or_else(fastest, |_| problem.scales().speed);
    // A body released from rest always moves in the same way: only the instant of the release
    // matters.
    let released = |passage: &Passage| passage.event.kind == Kind::Release;
    let anchor = passages.iter().rposition(released).or_else(|| passages.len().checked_sub(1))?;
    let last = passages.get(anchor)?;
    for (index, passage) in passages.iter().enumerate().take(anchor).rev() {
        let cycles = last.phase - passage.phase;
        if cycles > f64::from(LONGEST) + 0.5 {
            break;
        }
        if passage.event != last.event || cycles.round() < 1.0 || (cycles - cycles.round()).abs() > NEAR {
            continue;
        }
        let count = anchor - index;
        let same = |a: &Passage, b: &Passage| {
            a.event == b.event
                && (a.phase - b.phase - cycles.round()).abs() <= NEAR
                && (a.speed - b.speed).abs() <= NEAR * speed
        };
        let enough = released(last)
            || (anchor + 1 >= (REPEATS + 1) * count
                && (0..REPEATS * count).all(|back| same(&passages[anchor - back], &passages[anchor - back - count])));
        if enough {
            return Some((cycles.round() as u32, passages[index + 1..=anchor].to_vec()));
        }
    }
    None
}
