//! Measurements of one run for a stability map.

use super::ledger::{Ledger, at};
use super::scale::{Scale, total_mass};
use crate::error::Result;
use crate::residual::Judge;
use crate::scene::{Scene, System, WallLaw};
use crate::scheme::{Scheme, Stepper};
use crate::step::{Contact, Step};

/// The last part of the horizon, as a share, in which the body must be at rest if the reference is.
const LAST: f64 = 0.1;
/// Number of steps after which a contact that has not ended at the horizon is a lasting one: the
/// body stays at the wall, with departure speed 0.
const LASTING: f64 = 10.0;

/// The measurements of one run.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Contact episodes that ended within the horizon, in the order of their ends, then lasting
    /// ones, with a departure speed of 0.
    pub contacts: Vec<Contact>,
    /// Energy that the scheme produced, J. One degree of freedom: between impacts, away from walls
    /// and in the springs of elastic and penalised walls. Several: also the energy that rigid walls
    /// give and take.
    pub made: f64,
    /// Largest speed, m/s. Several degrees of freedom: the speed at which the total mass would have
    /// the same kinetic energy, √(vᵀMv / 1ᵀM1).
    pub speed: f64,
    /// Root mean square of the speed, m/s.
    pub rms_speed: f64,
    /// Largest speed in the last tenth of the horizon, m/s.
    pub last_speed: f64,
    /// Deepest position behind each wall at the end of a step, m, ≥ 0.
    pub depth: Vec<f64>,
    /// Largest speed at each wall, m/s.
    pub wall_speed: Vec<f64>,
    /// Largest acceleration at each wall, m/s², in steps without contact at this wall or at a wall
    /// that shares a degree of freedom with it.
    pub acceleration: Vec<f64>,
    /// Steps taken.
    pub steps: u64,
    /// Steps in which opposite walls push alternately, as counted by the scheme.
    pub frozen_steps: u64,
    /// Time at which the speed exceeded the limit, s; the run ended there.
    pub escaped: Option<f64>,
}

/// Runs `scene` by `scheme` with steps of `h` (s) over `horizon` (s).
///
/// A run whose speed exceeds `limit` (m/s) ends there.
///
/// # Errors
/// Errors of the scheme.
pub fn recorded_run(scene: &Scene, scheme: &Scheme, h: f64, horizon: f64, limit: f64) -> Result<Record> {
    let mut stepper = Stepper::new(scene, scheme, h)?;
    let mut books = EnergyAccount::new(&stepper, h);
    let steps = (horizon / h * (1.0 - 1e-12)).ceil().max(1.0) as u64;
    let m = scene.walls.len();
    let zero = || vec![0.0; m];
    let mut record = Record { depth: zero(), wall_speed: zero(), acceleration: zero(), ..Record::default() };
    let mut squares = 0.0;
    let beside = neighbours(scene);
    let gauge = EnergyNorm::new(&scene.system);
    let last = horizon * (1.0 - LAST);
    while stepper.index() < steps {
        let step = stepper.step()?;
        let speed = gauge.speed(step.velocity_after);
        record.speed = record.speed.max(speed);
        record.steps += 1;
        squares += speed * speed;
        if step.end > last {
            record.last_speed = record.last_speed.max(speed);
        }
        let pushed = step.impulse.iter().any(|&p| p != 0.0);
        let mut inside = false;
        for (index, wall) in scene.walls.iter().enumerate() {
            let now = -wall.gap(wall.row().dot(step.q));
            inside |= now > 0.0;
            record.depth[index] = record.depth[index].max(now);
            let (before, after) = (wall.row().dot(step.velocity_before), wall.row().dot(step.velocity_after));
            record.wall_speed[index] = record.wall_speed[index].max(after.abs());
            if !(pushed && beside[index].iter().any(|&other| step.impulse[other] != 0.0)) {
                record.acceleration[index] = record.acceleration[index].max((after - before).abs() / h);
            }
        }
        record.contacts.extend_from_slice(step.closed);
        books.observe(&step, pushed || inside);
        if speed > limit {
            record.escaped = Some(step.end);
            break;
        }
    }
    let (time, open) = (stepper.time(), stepper.open_contacts());
    let lasting = open.into_iter().filter(|c| c.start < time - LASTING * h);
    record.contacts.extend(lasting.map(|c| Contact { departure_speed: Some(0.0), ..c }));
    record.made = books.made();
    record.rms_speed = (squares / record.steps as f64).sqrt();
    record.frozen_steps = stepper.counters().frozen_steps;
    Ok(record)
}

/// Number of starts that are tried, and the difference of their initial speeds as a share of gap
/// scale times ω ([`NUDGE`]): too small to matter in practice, large enough for chaotic motions to
/// separate and for motions between two attractors to find both.
pub const STARTS: u32 = 4;
/// See [`STARTS`].
pub const NUDGE: f64 = 1e-3;

/// The scene with start number `start`; number 0 is its own. All degrees of freedom get the same
/// additional velocity, with the kinetic energy that the mass at a wall would have at that speed.
#[must_use]
pub fn nudged(scene: &Scene, start: u32, scale: &Scale) -> Scene {
    let mut scene = scene.clone();
    let speed = f64::from(start) * NUDGE * scene.gap_scale() * scale.omega;
    let nudge = match scene.system {
        System::Oscillator(_) => speed,
        _ => speed * (scale.mass / total_mass(&scene.system)).sqrt(),
    };
    scene.initial.v.iter_mut().for_each(|v| *v += nudge);
    scene
}

/// Keeps account of the energy.
enum EnergyAccount {
    Single(Box<Ledger>),
    /// For several degrees of freedom, the judge: the energy that no load, damping or wall accounts
    /// for, less the energy that rigid walls took.
    Several(Box<Judge>),
}

impl EnergyAccount {
    fn new(stepper: &Stepper, h: f64) -> Self {
        let state = stepper.state();
        match stepper.scene().system {
            System::Oscillator(_) => Self::Single(Box::new(Ledger::new(stepper, h))),
            _ => Self::Several(Box::new(Judge::new(stepper.scene(), stepper.contract(), h, &state.q, &state.v))),
        }
    }

    #[inline]
    fn observe(&mut self, step: &Step<'_>, busy: bool) {
        match self {
            Self::Single(ledger) => ledger.observe(step, busy),
            Self::Several(judge) => judge.observe(step),
        }
    }

    fn made(&self) -> f64 {
        match self {
            Self::Single(ledger) => ledger.made(),
            Self::Several(judge) => {
                let energy = judge.residuals().energy;
                energy.residual_j - energy.impact_loss_j
            }
        }
    }
}

/// For each wall, the walls whose impulses act on it directly: itself, and all that share a degree
/// of freedom with it.
fn neighbours(scene: &Scene) -> Vec<Vec<usize>> {
    let dofs = |wall: &crate::scene::Wall| wall.row().entries().iter().map(|entry| entry.0).collect::<Vec<_>>();
    let all: Vec<Vec<usize>> = scene.walls.iter().map(dofs).collect();
    let shares = |a: &Vec<usize>, b: &Vec<usize>| a.iter().any(|i| b.contains(i));
    let of = |(index, mine): (usize, &Vec<usize>)| {
        let others = all.iter().enumerate().filter(|(other, theirs)| *other == index || shares(mine, theirs));
        others.map(|(other, _)| other).collect()
    };
    all.iter().enumerate().map(of).collect()
}

/// How a speed is computed from a vector of velocities.
enum EnergyNorm<'a> {
    Single,
    /// The system, and its total mass, kg.
    Several(&'a System, f64),
}

impl<'a> EnergyNorm<'a> {
    fn new(system: &'a System) -> Self {
        match system {
            System::Oscillator(_) => Self::Single,
            several => Self::Several(several, total_mass(several)),
        }
    }

    fn speed(&self, v: &[f64]) -> f64 {
        match self {
            Self::Single => at(v).abs(),
            Self::Several(system, mass) => (system.mass_form(v, v) / mass).sqrt(),
        }
    }
}

/// Upper bound, m, of the depth behind a wall of this law (as the scheme sees it) in a sound run.
/// It depends on the scheme, the mass m that the wall feels (kg), the energy E that may reach it
/// (J), the largest speed `v` (m/s) and the largest free acceleration `a` (m/s²) there; h²a is
/// added for the order of the step.
///
/// | walls and scheme | bound |
/// |---|---|
/// | rigid, implicit-euler, newmark and generalized-alpha | 0 |
/// | rigid, paoli-schatzman | 2e h v/(1+e) |
/// | rigid, moreau-jean | h v (1 − e/2) |
/// | elastic or penalty of stiffness k_w, any | h v + √(2E/k_w) + 2ma/k_w: one step, the depth at
/// which the spring stores E, and twice the static depth under the load |
pub(crate) fn depth_bound(law: WallLaw, scheme: &Scheme, mass: f64, energy: f64, h: f64, v: f64, a: f64) -> f64 {
    let stated = match (law.restitution(), law.stiffness()) {
        (Some(e), _) => match scheme {
            Scheme::PaoliSchatzman => 2.0 * e * h * v / (1.0 + e),
            Scheme::MoreauJean { .. } => h * v * (1.0 - 0.5 * e),
            _ => 0.0,
        },
        (_, Some(k)) => h * v + (2.0 * energy / k).sqrt() + 2.0 * mass * a / k,
        (_, None) => 0.0,
    };
    stated + h * h * a
}
