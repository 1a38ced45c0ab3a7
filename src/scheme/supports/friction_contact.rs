//! One contact of a step, and the exact answer to it alone.
//!
//! The contact gives the structure the impulse −p n + f t, t = (−n_z, n_y). With W the 2 × 2
//! response of its place and a = n·Wn + κ (κ the compliance of an elastic wall), b = n·Wt, c =
//! t·Wt, the end velocity under the impulses of all other contacts changes by
//!
//! n·ẇ⁺ − κp = N − a p + b f + β,    t·ẇ⁺ = T − b p + c f,
//!
//! where β is the bound on n·ẇ⁺ − κp and N what exceeds it. The law is
//!
//! 0 ≤ p ⟂ n·ẇ⁺ − κp ≤ β,    |f| ≤ μp,    f = −μp sign(t·ẇ⁺) where t·ẇ⁺ ≠ 0.
//!
//! In the plane a contact has one tangent, so the law is piecewise linear, and one of four states
//! answers it: open (N ≤ 0, no impulse); stick, t·ẇ⁺ = 0; slip either way, f = ∓μp. For large μ and
//! b ≠ 0 several may: the first in this order is taken. Where rounding leaves none, p is taken
//! without friction until a pivoting method takes over.
//!
//! Where the static μ is larger than the kinetic one, a contact that stuck in the step before has
//! the static μ. If it slides in the answer, it has the kinetic μ for the rest of the step, and all
//! contacts are answered again ([`FrictionContacts::solve`](super::FrictionContacts::solve)). One
//! that slid before has the kinetic μ, unless its sliding velocity turns in the answer: then it
//! passes rest within the step, and static friction is tried first.

use super::contact_rows::ContactRows;
use super::normal::dot;
use crate::scene::FrictionCoefficients;

/// Rounding of velocities, relative to the largest: a state is accepted within this.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// What a contact does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::scheme) enum State {
    Open,
    Stick,
    /// Slip with t·ẇ⁺ > 0, or without friction.
    Ahead,
    /// Slip with t·ẇ⁺ < 0.
    Back,
}

impl State {
    /// The sign of t·ẇ⁺.
    pub fn sign(self) -> f64 {
        match self {
            Self::Open | Self::Stick => 0.0,
            Self::Ahead => 1.0,
            Self::Back => -1.0,
        }
    }
}

/// A contact in play.
#[derive(Debug, Clone, Copy)]
pub(in crate::scheme) struct FrictionContact {
    /// Index of the wall, or number of walls plus that of the hole.
    pub index: usize,
    /// The rows of its place; twice the same for a wall by itself, whose normal is (±1, 0).
    pub rows: [usize; 2],
    pub normal: [f64; 2],
    pub tangent: [f64; 2],
    /// β, m/s.
    pub bound: f64,
    /// μ, and κ in m/s per N s.
    pub friction: f64,
    pub compliance: f64,
    /// μ_k and μ_s, of which `friction` is one.
    pub kinetic: f64,
    pub holding: f64,
    /// The sign of t·ẇ of a contact that slid in the step before; 0 where it stuck or did not push,
    /// and once static friction has failed to hold it in this step.
    pub came: f64,
    /// a − κ, b, c.
    pub own: [f64; 3],
    pub state: State,
    /// p and f, N s.
    pub impulse: [f64; 2],
    /// The sign of t·ẇ of a contact that slides with full friction throughout, also where t·ẇ⁺ has
    /// the other sign; 0 where the law applies to t·ẇ⁺.
    pub slides: f64,
}

impl FrictionContact {
    /// The contact of this normal and bound, without an impulse.
    pub fn new(
        places: &ContactRows,
        (index, rows): (usize, [usize; 2]),
        (normal, bound): ([f64; 2], f64),
        (friction, compliance): (f64, f64),
    ) -> Self {
        let tangent = if friction > 0.0 { [-normal[1], normal[0]] } else { [0.0; 2] };
        let form = |a: [f64; 2], b: [f64; 2]| places.between((rows, a), (rows, b));
        let own = if friction > 0.0 {
            [form(normal, normal), form(normal, tangent), form(tangent, tangent)]
        } else {
            [form(normal, normal), 0.0, 0.0]
        };
        Self {
            index,
            rows,
            normal,
            tangent,
            bound,
            friction,
            compliance,
            kinetic: friction,
            holding: friction,
            came: 0.0,
            own,
            state: State::Open,
            impulse: [0.0; 2],
            slides: 0.0,
        }
    }

    /// True if the body has to leave again, with a velocity that is not 0.
    pub fn rebounds(&self) -> bool {
        self.compliance == 0.0 && self.bound < 0.0
    }

    /// a, m/s per N s.
    pub fn yielding(&self) -> f64 {
        self.own[0] + self.compliance
    }

    /// n·ẇ⁺ − κp − β and t·ẇ⁺ for these velocities of all rows.
    pub fn excess(&self, y: &[f64]) -> [f64; 2] {
        let rate = self.rows.map(|row| y[row]);
        [dot(self.normal, rate) - self.compliance * self.impulse[0] - self.bound, dot(self.tangent, rate)]
    }

    /// The impulse on the rows of its place.
    pub fn push(&self, [p, f]: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i: usize| f * self.tangent[i] - p * self.normal[i])
    }

    /// Answers the contact alone: sets its state and impulse for the velocities `y` of all rows
    /// under all impulses, and changes `y` accordingly. Returns the size of the change, m/s, and
    /// whether the law has an answer.
    pub fn answer(&mut self, places: &ContactRows, y: &mut [f64]) -> (f64, bool) {
        let ([own, b, c], a) = (self.own, self.yielding());
        let [p, f] = self.impulse;
        let [n, t] = self.excess(y);
        // Without its own impulse.
        let (n, t) = (n + a * p - b * f, t + b * p - c * f);
        let (state, found) = self.alone(n, t);
        self.state = state.unwrap_or(State::Ahead);
        let change = [found[0] - p, found[1] - f];
        self.impulse = found;
        places.add(self.rows, self.push(change), y);
        (own * change[0].abs() + c * change[1].abs(), state.is_some())
    }

    /// The state in which it would answer these velocities, with the impulses of all others as they
    /// are.
    pub fn guess(&self, y: &[f64]) -> State {
        let ([_, b, c], a, [p, f]) = (self.own, self.yielding(), self.impulse);
        let [n, t] = self.excess(y);
        self.alone(n + a * p - b * f, t + b * p - c * f).0.unwrap_or(State::Ahead)
    }

    /// Sets f to what its state and p ask for, or both to 0.
    pub fn comply(&mut self) {
        match self.state {
            State::Open => self.impulse = [0.0; 2],
            State::Stick => {}
            State::Ahead | State::Back => self.impulse[1] = -self.state.sign() * self.friction * self.impulse[0],
        }
    }

    /// The same contact with the friction that it has after a step in which it `did` this.
    pub fn after(self, friction: FrictionCoefficients, did: State) -> Self {
        Self {
            friction: friction.limit(did == State::Stick),
            kinetic: friction.sliding,
            holding: friction.sticking,
            came: did.sign(),
            ..self
        }
    }

    /// Changes the coefficient of friction if its answer has another: the kinetic one, for the rest
    /// of the step, where it slides in spite of static friction; the static one where its sliding
    /// velocity turns. Returns whether it changed. The velocities are `y`, of which `noise` (m/s)
    /// is rounding: a contact at its limit that others hold does not slide, whatever its state.
    pub fn changes_friction(&mut self, y: &[f64], noise: f64) -> bool {
        let ([p, f], along) = (self.impulse, self.excess(y)[1]);
        let mut slides = matches!(self.state, State::Ahead | State::Back);
        if slides && self.friction == 0.0 {
            // The answer is the same either way.
            self.state = if along < 0.0 { State::Back } else { State::Ahead };
        } else if slides && self.slides == 0.0 && along.abs() <= noise {
            (self.state, slides) = (State::Stick, false);
        }
        if self.friction > self.kinetic {
            // What holds a body that turns acts against the new velocity, hence along the old one.
            let pulls = self.came * f < 0.0 && f.abs() > self.kinetic * p;
            if slides || pulls {
                (self.friction, self.came) = (self.kinetic, 0.0);
                return true;
            }
        } else if slides && self.state.sign() * self.came < 0.0 && self.holding > self.friction {
            self.friction = self.holding;
            return true;
        }
        false
    }

    /// Finds its state from the velocities `y` and its impulse, within a velocity of `noise` (m/s).
    pub fn recognise(&mut self, y: &[f64], noise: f64) {
        let ([p, _], [_, t]) = (self.impulse, self.excess(y));
        self.state = match t {
            _ if p == 0.0 => State::Open,
            _ if self.friction > 0.0 && t.abs() <= noise => State::Stick,
            t if t < 0.0 => State::Back,
            _ => State::Ahead,
        };
    }

    /// Takes back what rounding has left outside of Coulomb's cone: a force of −1e-20 N is none,
    /// and friction beyond μp, without which t·ẇ⁺ changes by rounding alone, is μp. Beside fast
    /// slides elsewhere, that excess may be as large as a force over a part of 1e-14 s.
    pub fn drop_rounding(&mut self) {
        let [p, f] = self.impulse;
        let p = if p < 0.0 { 0.0 } else { p };
        let most = self.friction * p;
        self.impulse = [p, if f.abs() > most { most.copysign(f) } else { f }];
    }

    fn alone(&self, n: f64, t: f64) -> (Option<State>, [f64; 2]) {
        let ([_, b, c], a, mu) = (self.own, self.yielding(), self.friction);
        if n <= 0.0 {
            return (Some(State::Open), [0.0; 2]);
        }
        if mu == 0.0 {
            return (Some(State::Ahead), [n / a, 0.0]);
        }
        if self.slides != 0.0 && a + self.slides * mu * b > 0.0 {
            let p = n / (a + self.slides * mu * b);
            let state = if self.slides > 0.0 { State::Ahead } else { State::Back };
            return (Some(state), [p, -self.slides * mu * p]);
        }
        let p = (n - b * t / c) / (a - b * b / c);
        let f = (b * p - t) / c;
        if p >= 0.0 && f.abs() <= mu * p {
            return (Some(State::Stick), [p, f]);
        }
        for (state, sign) in [(State::Ahead, 1.0), (State::Back, -1.0)] {
            let per = a + sign * mu * b;
            let p = n / per;
            if per > 0.0 && sign * (t - b * p) - c * mu * p >= 0.0 {
                return (Some(state), [p, -sign * mu * p]);
            }
        }
        (None, [n / a, 0.0])
    }

    /// True if the velocities `y` and its impulse are those of its state, within a velocity of
    /// `noise` (m/s). An elastic wall has rounding of its own in n·ẇ⁺ − κp: over a short part both
    /// κp and β are far larger than velocities.
    pub fn holds(&self, y: &[f64], noise: f64) -> bool {
        let ([n, t], [p, f], [_, _, c]) = (self.excess(y), self.impulse, self.own);
        let rubs = self.friction > 0.0;
        let own = if self.compliance > 0.0 { noise.max(ROUNDING * self.bound.abs()) } else { noise };
        let presses = p * self.yielding() >= -own && n.abs() <= own;
        match self.state {
            State::Open => n <= own,
            State::Stick => presses && t.abs() <= noise && (f.abs() - self.friction * p) * c <= noise,
            State::Ahead | State::Back => {
                presses && (!rubs || self.slides == self.state.sign() || self.state.sign() * t >= -noise)
            }
        }
    }
}

#[cfg(test)]
mod tests;
