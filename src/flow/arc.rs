//! The exact motion of one degree of freedom between two events, in closed form.

use super::force::LocalForce;
use super::response::{Jet, Response};
use super::touch::{Support, Touch};
use crate::scene::{Forcing, Oscillator};

/// A stretch of exact motion on which the set of touching walls does not change.
///
/// Either the body flows, m q̈ + (c + Σc_a) q̇ + (k + Σk_a) q = f(t) + Σk_a g over the touching
/// elastic walls a, or it rests against a rigid wall, where q̇ = 0 and r = k q − f(t) − Σr_a.
///
/// Times are those of the scene, valid from [`Arc::start`] to [`Arc::end`]. With τ = t − start the
/// flow is
///
/// q(τ) = Re(Z e^{λτ}) + p₀ + p₁τ + Σ Im(P e^{iωτ}),
///
/// or, for a load whose steady solution would be much larger than the motion (near resonance, or as
/// the stiffness vanishes), the response to that load from rest, by divided differences of exp.
#[derive(Debug, Clone, PartialEq)]
pub struct Arc {
    start: f64,
    /// Correction of `start`, s: the arc starts this much later, by the rounding error of the sum
    /// of the times of many arcs.
    late: f64,
    end: f64,
    /// Its length, s, without the rounding errors of both ends.
    pub(super) span: f64,
    pub(super) body: Oscillator,
    /// 1/m, 1/kg.
    pub(super) inverse: f64,
    pub(super) force: LocalForce,
    pub(super) touching: Vec<Touch>,
    pub(super) support: Option<Support>,
    /// The state at the start: displacement (m) and velocity (m/s).
    pub(super) initial: [f64; 2],
    pub(super) response: Response,
}

/// The start of an arc.
pub(crate) struct Start<'a> {
    /// Time, s.
    pub time: f64,
    /// The rounding error of `time`, s: the arc starts this much later.
    pub late: f64,
    /// Displacement, m, and velocity, m/s.
    pub state: [f64; 2],
    /// The loads, those that the arc was made for.
    pub forcing: &'a Forcing,
    /// An additional constant force, N.
    pub extra: f64,
    /// Maximum length of the arc, s.
    pub span: f64,
    /// A typical displacement of the scene, m.
    pub length: f64,
}

impl Arc {
    /// An arc of length 0 for `body` under `forcing`, with room for `walls` touching walls;
    /// [`Arc::begin`] refills it again and again without allocating.
    pub(crate) fn new(body: Oscillator, walls: usize, forcing: &Forcing) -> Self {
        let force = LocalForce::new(forcing);
        Self {
            start: 0.0,
            late: 0.0,
            end: 0.0,
            span: 0.0,
            body,
            inverse: 1.0 / body.mass,
            touching: Vec::with_capacity(walls),
            support: None,
            initial: [0.0; 2],
            response: Response::new([body.mass, body.damping, body.stiffness], &force),
            force,
        }
    }

    /// Starts a new arc: in flight, or at rest against `support`.
    pub(crate) fn begin(&mut self, from: &Start, touching: impl Iterator<Item = Touch>, support: Option<Support>) {
        (self.start, self.late) = (from.time, from.late);
        (self.end, self.span) = (from.time + from.span, from.span);
        self.initial = from.state;
        self.force.set(from.forcing, [from.time, from.late], from.extra);
        self.touching.clear();
        self.touching.extend(touching);
        self.support = support;
        if support.is_some() {
            return;
        }
        let Oscillator { mass, damping, stiffness } = self.body;
        let mut total = [mass, damping, stiffness];
        let outer = self.force.constant;
        for wall in &self.touching {
            total[1] += wall.damping;
            total[2] += wall.stiffness;
            self.force.constant += wall.stiffness * wall.position;
        }
        self.response.set(total, &self.force, from.state, from.span, from.length);
        self.force.constant = outer;
    }

    /// Cuts the arc off at `end` (s), `span` (s) after its start.
    pub(crate) fn cut(&mut self, end: f64, span: f64) {
        (self.end, self.span) = (end, span);
    }

    /// Time since the start, s: exactly 0 and the length at the ends, without the rounding errors
    /// of these times.
    pub(super) fn since(&self, t: f64) -> f64 {
        if t == self.end {
            self.span
        } else if t == self.start {
            0.0
        } else {
            (t - self.start) - self.late
        }
    }

    /// Time at which it starts, s.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Time at which it ends, s.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Its length, s, without the rounding errors of both ends.
    pub(crate) fn span(&self) -> f64 {
        self.span
    }

    /// Displacement (m) and velocity (m/s) at the start, as given.
    pub(crate) fn start_state(&self) -> [f64; 2] {
        if self.is_rest() { [self.initial[0], 0.0] } else { self.initial }
    }

    /// The rigid wall that the body rests against; `None` in flight.
    #[must_use]
    pub fn rests_on(&self) -> Option<usize> {
        self.support.map(|s| s.wall)
    }

    /// True if the body rests against a rigid wall.
    #[must_use]
    pub fn is_rest(&self) -> bool {
        self.support.is_some()
    }

    /// Displacement (m) and velocity (m/s) at `t`, from the right at the start and from the left at
    /// the end.
    #[must_use]
    pub fn state(&self, t: f64) -> (f64, f64) {
        if self.is_rest() {
            return (self.initial[0], 0.0);
        }
        let [q, v] = self.response.state(self.since(t));
        (q, v)
    }

    /// As [`Arc::state`], at several times at once, which costs half as much for each.
    pub(crate) fn states(&self, times: &[f64], q: &mut [f64], v: &mut [f64]) {
        if self.is_rest() {
            q.fill(self.initial[0]);
            return v.fill(0.0);
        }
        for (tau, &t) in q.iter_mut().zip(times) {
            *tau = self.since(t);
        }
        self.response.states(q, v);
    }

    /// Acceleration (m/s²) at `t`.
    #[must_use]
    pub fn acceleration(&self, t: f64) -> f64 {
        self.jet(self.since(t))[2]
    }

    /// Load at `t`, N, with the extra force of the step.
    #[must_use]
    pub fn load(&self, t: f64) -> f64 {
        self.force.jet(self.since(t))[0]
    }

    /// Impulse of the load over [from, to] within the arc, N s.
    pub(crate) fn load_impulse(&self, from: f64, to: f64) -> f64 {
        self.force.integral(self.since(from), self.since(to))
    }

    /// Mass of the body, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.body.mass
    }

    /// Damping of the body and of the elastic walls that touch, N s/m.
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.body.damping + self.touching.iter().map(|w| w.damping).sum::<f64>()
    }

    /// ∂(q, q̇ at the end)/∂(q, q̇ at the start), row by row, for the free flow; zero for a body at
    /// rest on a wall, since its motion does not depend on its state at the start.
    #[must_use]
    pub fn propagator(&self) -> [[f64; 2]; 2] {
        if self.support.is_some() {
            return [[0.0; 2]; 2];
        }
        let Oscillator { mass, stiffness, .. } = self.body;
        let damping = self.damping();
        let stiffness = stiffness + self.touching.iter().map(|w| w.stiffness).sum::<f64>();
        let tau = self.span;
        let (unloaded, of) = (LocalForce::default(), [mass, damping, stiffness]);
        let mut response = Response::new(of, &unloaded);
        let mut free = |state| {
            response.set(of, &unloaded, state, tau, 1.0);
            response.jet(tau)
        };
        let (from_q, from_v) = (free([1.0, 0.0]), free([0.0, 1.0]));
        [[from_q[0], from_v[0]], [from_q[1], from_v[1]]]
    }

    /// Displacement and six derivatives `tau` after the start.
    #[inline]
    pub(crate) fn jet(&self, tau: f64) -> Jet {
        if self.support.is_some() {
            return at_rest(self.initial[0]);
        }
        self.response.jet(tau)
    }

    /// As [`Arc::jet`], at the start, from the differential equation. It does not have the closed
    /// form's rounding error near resonance, where the steady motion is far larger than the motion
    /// and large terms cancel.
    #[inline]
    pub(crate) fn start_jet(&self) -> Jet {
        let [q, v] = self.initial;
        if self.support.is_some() {
            return at_rest(q);
        }
        let mut load = self.force.start();
        let (mut c, mut k) = (self.body.damping, self.body.stiffness);
        load[0] -= k * q;
        for wall in &self.touching {
            load[0] -= wall.stiffness * (q - wall.position);
            c += wall.damping;
            k += wall.stiffness;
        }
        let mut jet = at_rest(q);
        jet[1] = v;
        jet[2] = (load[0] - c * v) * self.inverse;
        for n in 1..load.len() {
            jet[n + 2] = (load[n] - c * jet[n + 1] - k * jet[n]) * self.inverse;
        }
        jet
    }

    /// True if an elastic wall touches.
    #[inline]
    pub(crate) fn touches(&self) -> bool {
        !self.touching.is_empty()
    }

    /// The elastic walls that touch, by their index in the scene.
    pub(crate) fn touching(&self) -> impl Iterator<Item = usize> + '_ {
        self.touching.iter().map(|wall| wall.wall)
    }

    /// The same, with their laws.
    pub(crate) fn touching_walls(&self) -> impl Iterator<Item = &Touch> {
        self.touching.iter()
    }
}

/// The jet of a body that stays at `q` (m).
fn at_rest(q: f64) -> Jet {
    let mut jet = Jet::default();
    jet[0] = q;
    jet
}
