//! `generalized-alpha`: nonsmooth generalized-α, the walls on the displacement and on the velocity.
//!
//! Chen, Acary, Virlez & Brüls 2013, Int. J. Numer. Methods Engrg. 96, doi:10.1002/nme.4563, and
//! Brüls, Acary & Cardona 2014, Comput. Methods Appl. Mech. Engrg. 281,
//! doi:10.1016/j.cma.2014.07.025. The rule of [`ChungHulbert`] carries an auxiliary acceleration a
//! of the smooth forces, which are evaluated at the state with the walls' corrections: F = f − Cv −
//! Kq + r_elastic at (t, q, v), F⁺ at (t⁺, q⁺, v⁺);
//!
//! the rigid walls act in addition, on the displacement by a correction U and on the velocity by
//! their impulses p:
//!
//! q⁺ = q + hv + h²[(½−β)a + βa⁺] + U,            0 ≤ gap(q⁺) ⟂ |ν| ≥ 0,
//!
//! v⁺ = v + h[(1−γ)a + γa⁺] + M⁻¹Gᵀp, 0 ≤ ±(ẇ⁺ + εẇ) ⟂ |p| ≥ 0 at the walls that are closed at q⁺,
//!
//! with ε = e where the body approaches or rests, 1 where it separates; ẇ is the velocity after the
//! step's blows, so v⁺ = −v is always admissible: a solution exists. A body at rest keeps v = 0, so
//! that M a = F and p = −hF: the force at rest is the static one in every step. (With the smooth
//! force at the state before the walls' correction it would be too small, by a factor of 1 +
//! (1−α_f)(hc/m + h²k/2m) for one degree of freedom.)
//!
//! The papers solve for U and p together; their problem is not symmetric. Here they are solved one
//! after the other, each by a convex programme: first that of the rule,
//!
//! S Δ = b + Gᵀν,     then     T(v⁺ − v_c) = μ Gᵀp,
//!
//! where v_c is the velocity that the rule gives at q⁺ without p. Without damping U is that of the
//! papers, M U = Gᵀν/μ. With damping, U differs by the effect of p through C within a step; and
//! where a rigid wall is met, the damper in b takes v̂ − h(1−γ/2β)a, so that a body at rest is not
//! moved by an a that the walls cancel (at ρ∞ = 1, where γ = 2β, the difference is zero).
//!
//! No rigid wall is ever penetrated, and the force of a rigid wall never enters the acceleration a.
//! In return, the work of the smooth force over U is not accounted for: each impact gains or loses
//! energy of order h. With a step that does not resolve the fastest mode (hω of 2 and more) and
//! restitutions near 1 the gains may add up without bound: such a run ends as diverged.

use super::Counters;
use super::body::Body;
use super::chung_hulbert::{ChungHulbert, is_met, weights};
use super::entry::{Coverage, NO_LAW_OF_RINGS, NO_SPEED_TO_STICK_AT, Realised, SchemeEntry, SchemeKind};
use super::flat_row::FlatRow;
use super::frame::Frame;
use super::programme::Programme;
use super::rule::Rule;
use super::space::{Space, zero};
use super::supports::{CROSSING, TURNING};
use crate::error::Result;
use crate::qp::Backend;
use crate::scene::{Scene, WallLaw};
use crate::step::{
    Balance, Bound, Conserves, Contract, Law, Normal, Promise, PromisedForce, Reached, Tolerances, Turning,
};

/// Default ρ∞: each step takes a fifth off the amplitude of the fastest free vibrations, and almost
/// nothing off those that it resolves.
pub(super) const RHO: f64 = 0.8;

/// What is known of the scheme beside its rule.
pub(super) const ENTRY: SchemeEntry = SchemeEntry {
    name: "generalized-alpha",
    settings: &["rho"],
    default: "ρ∞, default 0.8",
    kind: SchemeKind::Qp,
    restitution: Realised::PerWall,
    realises: "e, per wall",
    purpose: "stiff structures: order 2 between impacts; vibrations that the step does not resolve shrink by the \
              factor ρ∞ per step; no rigid wall or round hole is ever penetrated",
    order: Some(1),
    fails: "order 1 through impacts (2 at e = 0); each impact gains or loses energy of order h (reported), and \
            may diverge with a step that does not resolve the fastest mode: prefer moreau-jean where impacts are many",
    round: Coverage::Stepped(
        "has the law of moreau-jean, after it has put the body within the circle, which it never \
                             passes",
    ),
    elastic_round: Coverage::Refused(NO_LAW_OF_RINGS),
    friction: Coverage::Refused(NO_SPEED_TO_STICK_AT),
    elastic_round_friction: Coverage::Refused(NO_SPEED_TO_STICK_AT),
};

/// What every step with this ρ∞ satisfies.
pub(super) fn contract(rho: f64) -> Contract {
    let mut promise = Promise::constraints(Some(Bound::End), Some(Reached::Closed), Law::Depth(1.0));
    promise.elastic.force = PromisedForce::Trapezoid;
    promise.hole = Some(Bound::End);
    promise.round = Some(Turning { normal: Normal::Middle(CROSSING), ..TURNING });
    Contract {
        balance: weights(rho),
        promise,
        instant: 0.5,
        tolerances: Tolerances::of(Conserves::Nothing),
        divides: false,
    }
}

#[derive(Debug)]
pub(super) struct GeneralizedAlpha<S: Space> {
    body: Body<S>,
    rule: ChungHulbert<S>,
    /// True if a rigid wall is closed at the step's start.
    closed: bool,
    elastic: ElasticForces,
    /// All walls, in Δ, m.
    place: Programme<S>,
    /// The rigid walls, in v⁺ − v_c, m/s.
    rate: Programme<S>,
    zero: S::Vector,
    /// Multipliers of the programmes, and the walls where they are not zero.
    multiplier: Vec<f64>,
    pushing: Vec<usize>,
}

/// The forces of elastic walls at the step's start.
#[derive(Debug)]
struct ElasticForces {
    /// Of each wall, N.
    force: Vec<f64>,
    /// The walls where it is not zero.
    walls: Vec<usize>,
}

impl ElasticForces {
    /// Adds the forces to `out`.
    fn push<S: Space>(&self, body: &Body<S>, out: &mut S::Vector) {
        for &wall in &self.walls {
            S::add_transposed(&body.rows, wall, self.force[wall], out);
        }
    }
}

impl<S: Space> GeneralizedAlpha<S> {
    pub fn new(scene: &Scene, balance: Balance, h: f64, backend: Backend) -> Result<Self> {
        let body = Body::<S>::new(scene, h)?;
        let rule = ChungHulbert::new(&body, balance)?;
        let (gap, walls) = (scene.gap_scale(), body.walls.len());
        let place = Programme::new(scene, rule.matrix(&body), gap, |spring| 1.0 / spring.stiffness_over(h), backend)?;
        let rate = Programme::over(scene, WallLaw::is_rigid, rule.velocity_matrix(&body), gap / h, |_| 0.0, backend)?;
        Ok(Self {
            rule,
            closed: false,
            elastic: ElasticForces { force: vec![0.0; walls], walls: Vec::with_capacity(walls) },
            place,
            rate,
            zero: zero::<S>(body.n),
            multiplier: vec![0.0; walls],
            pushing: Vec::with_capacity(walls),
            body,
        })
    }

    /// q⁺, v⁺ without the rigid walls' impulses unless one was met, a⁺ likewise, and the elastic
    /// walls' forces. Returns whether a rigid wall was met.
    fn displace(&mut self, step: u64, frame: &mut Frame<S>) -> Result<bool> {
        let (unfelt, closed) = (self.rule.unfelt, self.closed);
        let met = is_met(unfelt, closed, |unfelt| self.place(step, frame, unfelt))?;
        self.rule.displace(self.place.x().as_ref(), met, self.body.h, frame);
        Ok(met)
    }

    /// Solves for Δ, the damper not feeling a and the extra force over `unfelt` (s). Returns
    /// whether a rigid wall pushes.
    fn place(&mut self, step: u64, frame: &Frame<S>, unfelt: f64) -> Result<bool> {
        let h = self.body.h;
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        self.rule.ask(&self.body, unfelt);
        let Self { body, place, rule, .. } = self;
        place.free();
        for row in 0..place.count_rows() {
            let ahead = place.seen(row, &rule.q);
            for number in place.walls(row) {
                let wall = place.wall(number);
                let bound = match wall.law.spring() {
                    // |r| = k_a s⁺ + c_a(s⁺ − s₊)/h, written in Δ.
                    Some(spring) => {
                        let plate = wall.plate(place.seen(row, &frame.q));
                        -spring.force(ahead, wall.g, plate, h) / spring.stiffness_over(h)
                    }
                    None => wall.g - ahead,
                };
                place.bind(row, number, bound);
            }
        }
        place.solve(&rule.b, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
        Ok(self.pushing.iter().any(|&wall| body.walls[wall].law.is_rigid()))
    }

    /// Writes the forces of the elastic walls, and the impulses ½h(r + r⁺) of those that push at
    /// either end of the step.
    fn press(&mut self, frame: &mut Frame<S>) {
        let h = self.body.h;
        let elastic = &mut self.elastic;
        for wall in elastic.walls.drain(..) {
            frame.impulse[wall] = 0.5 * h * elastic.force[wall];
            elastic.force[wall] = 0.0;
            frame.pushing.push(wall);
        }
        for &wall in self.pushing.iter().filter(|&&wall| !self.body.walls[wall].law.is_rigid()) {
            let force = self.multiplier[wall];
            if frame.impulse[wall] == 0.0 {
                frame.pushing.push(wall);
            }
            frame.impulse[wall] += 0.5 * h * force;
            frame.force[wall] = force;
            elastic.force[wall] = force;
            elastic.walls.push(wall);
        }
    }

    /// True if the blows drive the body into a rigid wall that is closed at q⁺: it keeps the body
    /// from that displacement, and the momentum that they would lose to the damper goes to the
    /// wall.
    fn answers(&self, frame: &Frame<S>) -> bool {
        let Self { body, multiplier, .. } = self;
        let closed =
            |wall: usize| multiplier[wall] != 0.0 || body.walls[wall].depth(body.seen(wall, &frame.q)) >= -body.touch;
        (0..body.walls.len()).any(|wall| body.drives(wall) && closed(wall))
    }

    /// Solves for v⁺ and the impulses of the rigid walls that are closed. Returns whether one of
    /// them pushes.
    fn correct_velocity(&mut self, frame: &mut Frame<S>, step: u64) -> Result<bool> {
        let (h, rate) = (self.body.h, &mut self.rate);
        let mut approaches = false;
        self.closed = false;
        rate.free();
        for row in 0..rate.count_rows() {
            let w = rate.seen(row, &frame.q);
            if rate.is_clear(row, w) && self.pushing.is_empty() {
                continue;
            }
            for number in rate.walls(row) {
                let wall = rate.wall(number);
                // A wall with a multiplier is closed too: q⁺ is at it to the rounding error of q.
                if self.multiplier[wall.index] == 0.0 && wall.depth(w) < -self.body.touch {
                    continue;
                }
                self.closed = true;
                let struck = rate.seen(row, frame.struck());
                let epsilon = if wall.sign * struck <= 0.0 { wall.law.restitution().unwrap_or(0.0) } else { 1.0 };
                let bound = -epsilon * struck - rate.seen(row, &frame.v);
                rate.bind(row, number, bound);
                approaches |= wall.sign * bound > 0.0;
            }
        }
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        if approaches {
            let mu = self.rule.mu();
            self.rate.solve(&self.zero, (frame.start, step), &mut self.multiplier, &mut self.pushing)?;
            frame.v.as_mut().iter_mut().zip(self.rate.x().as_ref()).for_each(|(v, d)| *v += d);
            for &wall in &self.pushing {
                frame.impulse[wall] = self.multiplier[wall] / mu;
                frame.force[wall] = frame.impulse[wall] / h;
                frame.pushing.push(wall);
            }
        }
        Ok(approaches)
    }
}

impl<S: Space> Rule<S> for GeneralizedAlpha<S> {
    fn restart(&mut self, _: &Scene, time: f64, frame: &Frame<S>) -> Result<()> {
        self.body.restart(time);
        self.elastic.force = self.rule.restart(&self.body, &frame.q, &frame.v);
        let ElasticForces { force, walls } = &mut self.elastic;
        walls.clear();
        walls.extend((0..force.len()).filter(|&wall| force[wall] != 0.0));
        self.closed = closed(&self.body, &frame.q);
        for wall in self.pushing.drain(..) {
            self.multiplier[wall] = 0.0;
        }
        Ok(())
    }

    fn carried(&mut self) -> [Option<(&mut S::Vector, i32)>; 2] {
        self.rule.carried()
    }

    fn advance(&mut self, step: u64, frame: &mut Frame<S>) -> Result<()> {
        frame.begin(step, self.body.h);
        frame.before.clone_from(&frame.v);
        self.rule.predict(&mut self.body, frame);
        let met = self.displace(step, frame)?;
        self.press(frame);
        let answered = frame.blown && self.body.damped && self.answers(frame);
        if answered {
            self.rule.damp_blows(-1.0, &mut self.body, frame);
        }
        if met || answered {
            self.rule.free_velocity(&self.body, frame, |b| self.elastic.push(&self.body, b));
        }
        let pushed = self.correct_velocity(frame, step)?;
        let changed = met || pushed || answered;
        self.rule.renew(&self.body, frame, changed, |force| self.elastic.push(&self.body, force));
        frame.after.clone_from(&frame.v);
        Ok(())
    }

    fn count(&self, counters: &mut Counters) {
        self.rate.count(counters);
        self.place.count(counters);
    }

    fn backend(&self) -> Option<Backend> {
        Some(self.rate.backend())
    }
}

/// True if a rigid wall is closed at `q` (m).
fn closed<S: Space>(body: &Body<S>, q: &S::Vector) -> bool {
    let rests = |(wall, face): (usize, &FlatRow)| face.law.is_rigid() && face.depth(body.seen(wall, q)) >= -body.touch;
    body.walls.iter().enumerate().any(rests)
}

#[cfg(test)]
mod tests;
