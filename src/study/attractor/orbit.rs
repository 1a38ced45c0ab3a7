//! A periodic motion near a state: Newton's method on the map over N periods of the load.

use super::motion::{Attractor, Lasts, Touch};
use crate::orbit::strobe::{Scales, is_stable, multipliers, newton_step, state, vector};
use crate::order::sort_by_number;
use crate::scene::Checked;
use crate::scheme::{Method, Scheme, Stepper};
use crate::step::Contact;
use crate::variation::Product;
use nalgebra::{Complex, DMatrix, DVector};

/// Most iterations.
const ITERATIONS: usize = 10;

/// A motion is closed if it comes back to its start to within this share of the scales …
const CLOSED: f64 = 1e-10;

/// … and is not improved further if it does so to within this share.
const ROUNDING: f64 = 1e-14;

/// A step of Newton's method that is longer than this leaves the neighbourhood.
const LONGEST: f64 = 0.03;

/// Largest distance of an orbit from the state near which it is looked for.
const FAR: f64 = 3e-3;

/// States that differ by less than this are the same: the motion has a shorter period.
const EQUAL: f64 = 1e-8;

/// Least number of impacts before a rest that are shown as one chatter.
const CHATTER: usize = 3;

/// A periodic motion.
#[derive(Debug, Clone)]
pub(super) struct Orbit {
    /// The states once a period of the load.
    pub strobes: Vec<DVector<f64>>,
    /// The derivative of the map over it, at the first of them.
    pub matrix: DMatrix<f64>,
    contacts: Vec<Contact>,
    period: f64,
}

/// The motion over several periods.
struct PeriodsPassed {
    /// The state at the start and once a period.
    strobes: Vec<DVector<f64>>,
    matrix: DMatrix<f64>,
    contacts: Vec<Contact>,
}

fn pass(
    stepper: &mut Stepper,
    scene: &Checked,
    from: &DVector<f64>,
    count: usize,
    period: f64,
) -> Option<PeriodsPassed> {
    stepper.set_state(0.0, &state(from)).ok()?;
    let mut product = Product::new(scene).ok()?;
    let (mut strobes, mut contacts) = (vec![from.clone()], Vec::new());
    while strobes.len() <= count {
        let step = stepper.step().ok()?;
        product.observe(&step).ok()?;
        contacts.extend_from_slice(step.closed);
        if step.end >= strobes.len() as f64 * period * (1.0 - 1e-12) {
            strobes.push(vector(step.q, step.v));
        }
    }
    contacts.extend(stepper.open_contacts());
    Some(PeriodsPassed { strobes, matrix: product.matrix().clone(), contacts })
}

/// The periodic motion over `count` periods (s) near `from`, if there is one.
pub(super) fn find(scene: &Checked, period: f64, count: usize, from: &DVector<f64>, scales: Scales) -> Option<Orbit> {
    let mut stepper = Stepper::by(scene, Method::new(Scheme::Event), period).ok()?;
    let (mut x, mut best) = (from.clone(), None::<(f64, PeriodsPassed)>);
    for _ in 0..ITERATIONS {
        let passed = pass(&mut stepper, scene, &x, count, period)?;
        let gap = passed.strobes.last()? - &x;
        let size = scales.size(&gap);
        let better = best.as_ref().is_none_or(|(least, _)| size < *least);
        let stalled = !better && best.as_ref().is_some_and(|(least, _)| *least <= CLOSED);
        if stalled || size.is_nan() {
            break;
        }
        let step = newton_step(&passed.matrix, &gap)?;
        if better {
            best = Some((size, passed));
        }
        if size <= ROUNDING {
            break;
        }
        let is_near = scales.size(&step) <= LONGEST;
        if !is_near {
            return None;
        }
        x += step;
    }
    let (size, passed) = best?;
    if size > CLOSED {
        return None;
    }
    let PeriodsPassed { mut strobes, matrix, contacts } = passed;
    strobes.pop();
    let repeats = |d: &usize| {
        count.is_multiple_of(*d)
            && strobes.iter().zip(strobes.iter().cycle().skip(*d)).all(|(a, b)| scales.size(&(a - b)) < EQUAL)
    };
    match (1..count).find(repeats) {
        Some(sooner) => find(scene, period, sooner, strobes.first()?, scales),
        None => Some(Orbit { strobes, matrix, contacts, period }),
    }
}

/// A stable motion of that kind no further than [`FAR`] from `x`.
pub(super) fn near(scene: &Checked, period: f64, count: usize, x: &DVector<f64>) -> Option<Orbit> {
    let scales = Scales::new(scene.orbit_length(), period);
    let is_near = |orbit: &Orbit| orbit.strobes.first().is_some_and(|first| scales.size(&(x - first)) < FAR);
    find(scene, period, count, x, scales).filter(Orbit::is_stable).filter(is_near)
}

/// The result of one Newton step over one period: the steady state of a linear motion.
pub(super) fn leap(scene: &Checked, period: f64, from: &DVector<f64>) -> Option<DVector<f64>> {
    let mut stepper = Stepper::by(scene, Method::new(Scheme::Event), period).ok()?;
    let passed = pass(&mut stepper, scene, from, 1, period)?;
    let gap = passed.strobes.last()? - from;
    Some(from + newton_step(&passed.matrix, &gap)?)
}

impl Orbit {
    /// Its Floquet multipliers, the largest first.
    pub fn multipliers(&self) -> Vec<Complex<f64>> {
        multipliers(&self.matrix)
    }

    /// True if it attracts.
    pub fn is_stable(&self) -> bool {
        is_stable(&self.multipliers().iter().map(|one| [one.re, one.im]).collect::<Vec<_>>())
    }

    /// True if it touches no wall.
    pub fn is_quiet(&self) -> bool {
        self.contacts.is_empty()
    }

    /// The motion as an attractor of `scene`.
    pub fn attractor(&self, scene: &Checked) -> Attractor {
        let mut contacts: Vec<Contact> = self.contacts.clone();
        sort_by_number(&mut contacts, |contact| contact.wall as f64);
        sort_by_number(&mut contacts, |contact| contact.start);
        // A contact that spans the start is recorded twice: at its beginning, near the end of the
        // run, and at the start of the run.
        let open: Vec<usize> = contacts.iter().filter(|c| c.end.is_none()).map(|c| c.wall).collect();
        contacts.retain(|c| !(c.start == 0.0 && c.approach_speed == 0.0 && c.end.is_some() && open.contains(&c.wall)));
        let lasts = |c: &Contact| match scene.walls.get(c.wall) {
            _ if c.start == 0.0 && c.end.is_none() => Lasts::Always,
            Some(wall) if !wall.law.is_rigid() => Lasts::Push,
            Some(_) if c.end == Some(c.start) => Lasts::Instant,
            Some(_) => Lasts::Rest,
            None => Lasts::Push,
        };
        let touch = |c: &Contact| Touch {
            wall: c.wall,
            phase: c.start / self.period,
            speed: c.approach_speed,
            lasts: lasts(c),
        };
        let mut touches: Vec<Touch> = contacts.iter().map(touch).collect();
        // The list begins after a rest, so that no chatter that leads to a rest is cut in two.
        if let Some(last) = touches.iter().rposition(|touch| touch.lasts == Lasts::Rest) {
            touches.rotate_left(last + 1);
        }
        let mut shown: Vec<Touch> = Vec::new();
        for touch in touches {
            // Impacts that accumulate become weaker from one to the next.
            let mut speed = touch.speed;
            let leads = |t: &&Touch| {
                let leads = t.wall == touch.wall && t.lasts == Lasts::Instant && t.speed > speed;
                speed = t.speed;
                leads
            };
            let before = shown.iter().rev().take_while(leads).count();
            match (touch.lasts, shown.len().checked_sub(before).and_then(|at| shown.get(at).copied())) {
                (Lasts::Rest, Some(first)) if before >= CHATTER => {
                    shown.truncate(shown.len() - before);
                    shown.push(Touch { lasts: Lasts::Chatter, ..first });
                }
                _ => shown.push(touch),
            }
        }
        sort_by_number(&mut shown, |a| a.phase);
        let (strobes, multipliers) = (self.strobes.iter().map(state).collect(), self.multipliers());
        Attractor::Periodic { strobes, touches: shown, multipliers }
    }
}
