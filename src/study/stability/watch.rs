//! One run, measured: what a stability map needs to know of it.

use super::scale::Scale;
use crate::error::{Error, Result};
use crate::scene::{Scene, WallLaw};
use crate::scheme::{Scheme, Stepper};
use crate::step::Contact;

/// The share of the horizon, at its end, in which a body that is due to rest must rest.
const LAST: f64 = 0.1;

/// What was seen of one run.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Contact episodes that ended within the horizon, in time order of their ends.
    pub contacts: Vec<Contact>,
    /// Largest speed, m/s.
    pub speed: f64,
    /// Root mean square of the speed, m/s.
    pub rms_speed: f64,
    /// Largest speed in the last tenth of the horizon, m/s.
    pub last_speed: f64,
    /// Deepest position behind each wall at the end of a step, m, ≥ 0.
    pub depth: Vec<f64>,
    /// Largest acceleration in a step without contact, m/s².
    pub acceleration: f64,
    /// Steps taken.
    pub steps: u64,
    /// Steps in which opposite walls took turns, as the scheme itself counts them.
    pub frozen_steps: u64,
}

/// Runs `scene` by `scheme` with steps of `h` (s) over `horizon` (s).
///
/// A run that exceeds `limit` (m/s) has diverged; it is left there, since nothing it does later is of interest.
///
/// # Errors
/// What the scheme reports, and [`Error::NotFinite`] for a speed beyond the limit.
pub fn watch(scene: &Scene, scheme: &Scheme, h: f64, horizon: f64, limit: f64) -> Result<Record> {
    let mut stepper = Stepper::new(scene, scheme, h)?;
    let steps = (horizon / h * (1.0 - 1e-12)).ceil().max(1.0) as u64;
    let mut record = Record { depth: vec![0.0; scene.walls.len()], ..Record::default() };
    let mut squares = 0.0;
    let walls: Vec<_> = scene.walls.iter().map(|w| (w.side.sign(), w.position)).collect();
    let last = horizon * (1.0 - LAST);
    for _ in 0..steps {
        let step = stepper.step()?;
        // One degree of freedom: the walls' rows are the displacement itself.
        let at = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        let (q, v, before) = (at(step.q), at(step.velocity_after), at(step.velocity_before));
        let speed = v.abs();
        record.speed = record.speed.max(speed);
        squares += v * v;
        if step.end > last {
            record.last_speed = record.last_speed.max(speed);
        }
        for (depth, (sign, position)) in record.depth.iter_mut().zip(&walls) {
            *depth = depth.max(sign * (position - q));
        }
        if step.impulse.iter().all(|&p| p == 0.0) {
            record.acceleration = record.acceleration.max((v - before).abs() / h);
        }
        record.contacts.extend_from_slice(step.closed);
        if speed > limit {
            return Err(Error::NotFinite { time: step.end, step: step.index, what: "speed in any useful sense" });
        }
    }
    record.steps = steps;
    record.rms_speed = (squares / steps as f64).sqrt();
    record.frozen_steps = stepper.counters().frozen_steps;
    Ok(record)
}

/// Stiffness of a wall where the body meets it, N/m; none for a rigid one.
#[must_use]
pub fn wall_stiffness(law: WallLaw) -> Option<f64> {
    match law {
        WallLaw::Rigid { .. } => None,
        WallLaw::Elastic { stiffness, .. } => Some(stiffness),
        WallLaw::Quartic { epsilon, span } => Some(span * span / epsilon),
    }
}

/// How deep behind wall number `wall` of `scene` (as the scheme sees it) a body may come that behaves, m: the bound
/// stated for the scheme, with the speed `v` (m/s) and free acceleration `a` (m/s²) of the run, plus h²a for the order
/// of the step.
///
/// | walls and scheme | bound |
/// |---|---|
/// | rigid, implicit-euler and newmark | 0 |
/// | rigid, paoli-schatzman | 2e h v/(1+e) |
/// | rigid, moreau-jean | h v (1 − e/2) |
/// | elastic or penalty of stiffness k_w, any | h v + v√(m/k_w) + 2ma/k_w: a step, the way in which the spring stores ½mv², and twice what the load holds in |
#[must_use]
pub fn depth_bound(law: WallLaw, scheme: &Scheme, scale: &Scale, h: f64, v: f64, a: f64) -> f64 {
    let stated = match (law, wall_stiffness(law)) {
        (WallLaw::Rigid { restitution: e }, _) => match scheme {
            Scheme::PaoliSchatzman => 2.0 * e * h * v / (1.0 + e),
            Scheme::MoreauJean { .. } => h * v * (1.0 - 0.5 * e),
            _ => 0.0,
        },
        (_, Some(k)) => h * v + v * (scale.mass / k).sqrt() + 2.0 * scale.mass * a / k,
        (_, None) => 0.0,
    };
    stated + h * h * a
}
