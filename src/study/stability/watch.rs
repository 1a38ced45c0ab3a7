//! One run, measured: what a stability map needs to know of it.

use super::scale::Scale;
use crate::error::Result;
use crate::scene::{Scene, Wall, WallLaw};
use crate::scheme::{Scheme, Stepper};
use crate::step::{Balance, Contact, Step};

/// The share of the horizon, at its end, in which a body that is due to rest must rest.
const LAST: f64 = 0.1;
/// Steps after which a contact that has not ended at the horizon is a lasting one: the body stays at the wall, and leaves with nothing.
const LASTING: f64 = 10.0;

/// What was seen of one run.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// Contact episodes that ended within the horizon, in the order of their ends, then lasting ones, with a departure speed of 0.
    pub contacts: Vec<Contact>,
    /// Energy that the scheme made between impacts, J: away from walls and in the springs of elastic and penalised ones.
    pub made: f64,
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
    /// When the speed exceeded the limit, s; the run ended there.
    pub escaped: Option<f64>,
}

/// Runs `scene` by `scheme` with steps of `h` (s) over `horizon` (s).
///
/// A run that exceeds `limit` (m/s) is left there, since nothing it does later is of interest.
///
/// # Errors
/// What the scheme reports.
pub fn watch(scene: &Scene, scheme: &Scheme, h: f64, horizon: f64, limit: f64) -> Result<Record> {
    let mut stepper = Stepper::new(scene, scheme, h)?;
    let mut ledger = Ledger::new(&stepper, h);
    let steps = (horizon / h * (1.0 - 1e-12)).ceil().max(1.0) as u64;
    let mut record = Record { depth: vec![0.0; scene.walls.len()], ..Record::default() };
    let mut squares = 0.0;
    let walls: Vec<_> = scene.walls.iter().map(|w| (w.side.sign(), w.position)).collect();
    let last = horizon * (1.0 - LAST);
    for _ in 0..steps {
        let step = stepper.step()?;
        let (q, v, before) = (at(step.q), at(step.velocity_after), at(step.velocity_before));
        let speed = v.abs();
        record.speed = record.speed.max(speed);
        record.steps += 1;
        squares += v * v;
        if step.end > last {
            record.last_speed = record.last_speed.max(speed);
        }
        let mut inside = false;
        for (depth, (sign, position)) in record.depth.iter_mut().zip(&walls) {
            let now = sign * (position - q);
            inside |= now > 0.0;
            *depth = depth.max(now);
        }
        let pushed = step.impulse.iter().any(|&p| p != 0.0);
        if !pushed {
            record.acceleration = record.acceleration.max((v - before).abs() / h);
        }
        record.contacts.extend_from_slice(step.closed);
        ledger.see(&step, pushed || inside);
        if speed > limit {
            record.escaped = Some(step.end);
            break;
        }
    }
    let (time, open) = (stepper.time(), stepper.open_contacts());
    let lasting = open.into_iter().filter(|c| c.start < time - LASTING * h);
    record.contacts.extend(lasting.map(|c| Contact { departure_speed: Some(0.0), ..c }));
    record.made = ledger.made;
    record.rms_speed = (squares / record.steps as f64).sqrt();
    record.frozen_steps = stepper.counters().frozen_steps;
    Ok(record)
}

/// Starts from which a scene is tried, and by what their speeds differ, as a share of gap scale times ω: less than anybody could tell,
/// enough for chaotic motions to part and for those between two attractors to find both.
pub const STARTS: u32 = 4;
/// See [`STARTS`].
pub const NUDGE: f64 = 1e-3;

/// The scene from start number `start`, 0 its own.
#[must_use]
pub fn nudged(scene: &Scene, start: u32, scale: &Scale) -> Scene {
    let mut scene = scene.clone();
    let nudge = f64::from(start) * NUDGE * scene.gap_scale() * scale.omega;
    scene.initial.v.iter_mut().for_each(|v| *v += nudge);
    scene
}

/// One degree of freedom: the walls' rows are the displacement itself.
fn at(x: &[f64]) -> f64 {
    x.first().copied().unwrap_or(0.0)
}

/// The energy that a scheme makes between impacts, without knowing the load: by the balance of momentum that every scheme states
/// ([`Balance`]), the work of load and dampers in a step equals the change of energy but for the terms booked here.
///
/// θ-balance: p·Δq/h + ΔU − (θ−½)(mΔv² + kΔq²). Staggered: p·(v₋ + v₊)/2 + ΔU between half steps. U is the energy in the
/// springs of the walls; what their dashpots take, and what a damped wall keeps as it lets go of the body, is no loss of the scheme.
/// Steps in which a rigid wall pushes are left out: what it makes or takes is seen in the speeds before and after.
struct Ledger {
    springs: Vec<Spring>,
    /// Numbers of the rigid walls.
    rigid: Vec<usize>,
    balance: Balance,
    h: f64,
    mass: f64,
    stiffness: f64,
    q: f64,
    /// True where a wall pushed or held the body in the last step: the staggered energy of a wall is that of two ends.
    busy: bool,
    made: f64,
}

/// A wall that is not rigid.
struct Spring {
    index: usize,
    wall: Wall,
    damping: f64,
    /// Energy in it where the last step left it, J.
    stored: f64,
}

impl Ledger {
    fn new(stepper: &Stepper, h: f64) -> Self {
        let scene = stepper.scene();
        let (mass, stiffness) = (scene.system.mass_form(&[1.0], &[1.0]), scene.system.stiffness_form(&[1.0], &[1.0]));
        let q = at(&stepper.state().q);
        let (mut springs, mut rigid) = (Vec::new(), Vec::new());
        for (index, wall) in scene.walls.iter().enumerate() {
            let damping = match wall.law {
                WallLaw::Rigid { .. } => {
                    rigid.push(index);
                    continue;
                }
                WallLaw::Elastic { damping, .. } => damping,
                WallLaw::Quartic { .. } => 0.0,
            };
            springs.push(Spring { index, wall: wall.clone(), damping, stored: wall.law.energy(-wall.gap(q)) });
        }
        Self { springs, rigid, balance: stepper.contract().balance, h, mass, stiffness, q, busy: true, made: 0.0 }
    }

    /// Takes in a step; `busy` where a wall pushed in it or holds the body at its end.
    #[inline]
    fn see(&mut self, step: &Step<'_>, busy: bool) {
        let (q, before, after) = (at(step.q), at(step.velocity_before), at(step.velocity_after));
        let shift = q - self.q;
        let touched = busy || self.busy;
        let impulse = |index: usize| step.impulse.get(index).copied().unwrap_or(0.0);
        let struck = touched && self.rigid.iter().any(|&index| impulse(index) != 0.0);
        if let (Balance::Theta(theta), false) = (self.balance, struck)
            && theta != 0.5
        {
            let jump = after - before;
            self.made -= (theta - 0.5) * (self.mass * jump * jump + self.stiffness * shift * shift);
        }
        if touched {
            let staggered = matches!(self.balance, Balance::Staggered(_));
            let rate = if staggered { 0.5 * (before + after) } else { shift / self.h };
            for spring in &mut self.springs {
                let wall = &spring.wall;
                let (depth, depth_end) = (-wall.gap(self.q), -wall.gap(q));
                let (energy, energy_end) = (wall.law.energy(depth), wall.law.energy(depth_end));
                let stored = if staggered { 0.5 * (energy + energy_end) } else { energy_end };
                let p = impulse(spring.index);
                if p != 0.0 || spring.damping == 0.0 {
                    self.made += p * rate + stored - spring.stored;
                    // What the dashpot's share of p takes.
                    let depth_rate = -wall.side.sign() * rate;
                    let plate_rate =
                        if staggered { depth_rate } else { (depth_end.max(0.0) - depth.max(0.0)) / self.h };
                    self.made += spring.damping * plate_rate * depth_rate * self.h;
                }
                spring.stored = stored;
            }
        }
        self.busy = busy;
        self.q = q;
    }
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
/// | rigid, implicit-euler, newmark and generalized-alpha | 0 |
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
