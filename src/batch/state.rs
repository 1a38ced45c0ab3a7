//! A group of lanes: their constants, their states, and one step of fixed length.

use super::lane::{Lane, LaneWall};
use super::series::{COSINE, LaneConstants, ORDER, SINE};
use super::vector::{Mask, Vector, polynomial, series};
use crate::scheme::TAIL_HEIGHT;
use pulp::Simd;

/// Constants of one sine in every lane, as in [`super::series::Wave`].
#[derive(Clone, Copy)]
pub(super) struct Waves<S: Simd> {
    pub theta: Vector<S>,
    pub turn: [Vector<S>; 2],
    pub start: [Vector<S>; 2],
    pub series: [[Vector<S>; ORDER]; 2],
    pub whole: [[Vector<S>; 2]; 2],
}

/// Constants of every lane, as in [`LaneConstants`], and its walls.
#[derive(Clone, Copy)]
pub(super) struct Constants<S: Simd, const W: usize> {
    pub steps: Vector<S>,
    pub alpha: Vector<S>,
    pub kappa: Vector<S>,
    pub push: Vector<S>,
    pub impulse: [Vector<S>; ORDER],
    pub integral: [Vector<S>; ORDER],
    pub whole: [Vector<S>; 3],
    pub bound: [Vector<S>; 3],
    pub waves: [Waves<S>; W],
    /// Positions of the walls, m; infinite for a wall that does not exist.
    pub lower: Vector<S>,
    pub upper: Vector<S>,
    /// e of the walls.
    pub restitution: [Vector<S>; 2],
    /// The square of a speed after an impact, (m per step)², above which the body does not come to
    /// rest.
    pub tail: Vector<S>,
    /// An acceleration below this is rounding error, m per step squared.
    pub noise: Vector<S>,
}

/// The state of every lane.
#[derive(Clone, Copy)]
pub(super) struct State<S: Simd, const W: usize> {
    /// Steps since the period began.
    pub t: Vector<S>,
    /// Displacement, m, and velocity, m per step.
    pub u: Vector<S>,
    pub w: Vector<S>,
    /// Sine and cosine of the phase of every sine of the load.
    pub phase: [[Vector<S>; 2]; W],
    /// A small change of the initial state, propagated along the motion: of displacement, of
    /// velocity.
    pub tangent: [Vector<S>; 2],
    /// The largest and the smallest displacement in the window; before the window, the positions of
    /// the walls.
    pub high: Vector<S>,
    pub low: Vector<S>,
    /// The share of a step that is tried next: 1 unless a whole step could not be decided.
    pub share: Vector<S>,
}

impl<S: Simd, const W: usize> Constants<S, W> {
    pub fn new(simd: S) -> Self {
        let zero = Vector::splat(simd, 0.0);
        let none =
            Waves { theta: zero, turn: [zero; 2], start: [zero; 2], series: [[zero; ORDER]; 2], whole: [[zero; 2]; 2] };
        Self {
            steps: zero,
            alpha: zero,
            kappa: zero,
            push: zero,
            impulse: [zero; ORDER],
            integral: [zero; ORDER],
            whole: [zero; 3],
            bound: [zero; 3],
            waves: [none; W],
            lower: zero,
            upper: zero,
            restitution: [zero; 2],
            tail: zero,
            noise: zero,
        }
    }

    /// Assigns an oscillator to lane `slot`.
    pub fn put(&mut self, slot: usize, lane: &Lane, series: &LaneConstants) {
        self.steps.put(slot, series.steps);
        self.alpha.put(slot, series.alpha);
        self.kappa.put(slot, series.kappa);
        self.push.put(slot, series.push);
        put_all(&mut self.impulse, slot, &series.impulse);
        put_all(&mut self.integral, slot, &series.integral);
        put_all(&mut self.whole, slot, &series.whole);
        put_all(&mut self.bound, slot, &series.bound);
        for (index, wave) in self.waves.iter_mut().enumerate() {
            // Sines that the oscillator does not have get amplitude 0.
            let (theta, turn, start, of, whole) = match series.waves.get(index) {
                Some(w) => (w.theta, w.turn, w.start, w.series, w.whole),
                None => (0.0, [1.0, 0.0], [0.0, 1.0], [[0.0; ORDER]; 2], [[0.0; 2]; 2]),
            };
            wave.theta.put(slot, theta);
            put_all(&mut wave.turn, slot, &turn);
            put_all(&mut wave.start, slot, &start);
            for i in 0..2 {
                put_all(&mut wave.series[i], slot, &of[i]);
                put_all(&mut wave.whole[i], slot, &whole[i]);
            }
        }
        let place = |stop: Option<LaneWall>, none: f64| stop.map_or(none, |s| s.position);
        self.lower.put(slot, place(lane.lower, f64::NEG_INFINITY));
        self.upper.put(slot, place(lane.upper, f64::INFINITY));
        let far = [lane.lower, lane.upper].into_iter().flatten().fold(0.0, |far: f64, s| far.max(s.position.abs()));
        let most = series.load + series.kappa * far;
        self.noise.put(slot, 16.0 * f64::EPSILON * most);
        // Twice the largest v²/2p of such a flight, with the rounding error of the wall's position.
        self.tail.put(slot, 4.0 * most * (TAIL_HEIGHT * lane.length() + 8.0 * f64::EPSILON * far));
        for (e, stop) in self.restitution.iter_mut().zip([lane.lower, lane.upper]) {
            e.put(slot, stop.and_then(|s| s.law.restitution()).unwrap_or(0.0));
        }
    }

    /// Advances every lane by a whole step, and returns in which lanes it could have met a wall or
    /// passed an extreme of its window.
    ///
    /// Over a step of length h the motion is within |u⁗|z²(h − z)²/24 of the cubic that has its
    /// values and slopes at both ends. In Bernstein form that cubic has the control points u₀, u₀ +
    /// w₀h/3, u₁ − w₁h/3, u₁ with weights B₀ … B₃ ≥ 0 of sum 1, and z²(h − z)² ≤ h⁴(B₁ + B₂)/12. So
    /// where u₀ and u₁ are before a wall, and the two inner points are before it by at least
    /// |u⁗|h⁴/288, the motion is before it throughout the step: no grazing contact is missed.
    #[inline(always)]
    pub fn march(&self, a: &State<S, W>) -> (State<S, W>, Mask<S>) {
        let p = self.kappa.taken_from(a.u, self.push);
        let [s, rate, i] = self.whole;
        let mut u = a.w.fma(s, p.fma(i, a.u));
        let mut w = a.w.fma(rate, p * s);
        let mut phase = a.phase;
        for (wave, [sin, cos]) in self.waves.iter().zip(&mut phase) {
            let [f, g] = wave.whole;
            u = sin.fma(f[0], cos.fma(g[0], u));
            w = sin.fma(f[1], cos.fma(g[1], w));
            let [c, s] = wave.turn;
            (*sin, *cos) = (sin.fma(c, *cos * s), sin.taken_from(s, *cos * c));
        }
        let [du, dw] = a.tangent;
        let back = self.kappa * du;
        let tangent = [dw.fma(s, back.taken_from(i, du)), dw.fma(rate, -(back * s))];
        let b = State { t: a.t + a.t.all(1.0), u, w, phase, tangent, ..*a };
        let third = a.t.all(1.0 / 3.0);
        let margin = self.margin(a);
        let inner = [third.fma(a.w, a.u), third.taken_from(w, u)];
        let above = (inner[0].max(inner[1]) + margin).max(u);
        let below = (inner[0].min(inner[1]) - margin).min(u);
        let held = above.ge(a.high) | below.le(a.low) | b.t.ge(self.steps);
        (b, held)
    }

    /// |u⁗|/288 over the step from `a`.
    #[inline(always)]
    pub fn margin(&self, a: &State<S, W>) -> Vector<S> {
        let [b0, b1, b2] = self.bound;
        b1.fma(a.w.abs(), b2.fma(a.u.abs(), b0))
    }

    /// Advances phases and propagated changes by `z`.
    #[inline(always)]
    pub fn turn(&self, a: &mut State<S, W>, z: Vector<S>) {
        for (wave, [sin, cos]) in self.waves.iter().zip(&mut a.phase) {
            let angle = wave.theta * z;
            let square = angle * angle;
            let (s, c) = (angle * series(&SINE, square), series(&COSINE, square));
            (*sin, *cos) = (sin.fma(c, *cos * s), sin.taken_from(s, *cos * c));
        }
        // S and S′ by their series; the response to a displacement is S′ + αS, its rate −κS.
        let s = z * polynomial(&self.impulse, z);
        let rate = polynomial(&rates(&self.impulse), z);
        let [du, dw] = a.tangent;
        let stay = self.alpha.fma(s, rate);
        a.tangent = [dw.fma(s, du * stay), dw.fma(rate, -(self.kappa * s * du))];
    }

    /// Starts a new period in the lanes where `begun`: time and phases are known exactly there, and
    /// are set, so that rounding errors do not accumulate.
    #[inline(always)]
    pub fn restart(&self, a: &mut State<S, W>, begun: Mask<S>) {
        a.t = begun.pick(a.t.all(0.0), a.t);
        for (wave, phase) in self.waves.iter().zip(&mut a.phase) {
            for (now, start) in phase.iter_mut().zip(wave.start) {
                *now = begun.pick(start, *now);
            }
        }
    }
}

impl<S: Simd, const W: usize> State<S, W> {
    pub fn new(simd: S) -> Self {
        let zero = Vector::splat(simd, 0.0);
        Self {
            t: zero,
            u: zero,
            w: zero,
            phase: [[zero; 2]; W],
            tangent: [zero; 2],
            high: zero,
            low: zero,
            share: zero.all(1.0),
        }
    }
}

/// Coefficients of the derivative of z(c₀ + c₁z + …).
#[inline(always)]
pub(super) fn rates<S: Simd>(c: &[Vector<S>; ORDER]) -> [Vector<S>; ORDER] {
    let mut rates = *c;
    for (n, x) in rates.iter_mut().enumerate().skip(1) {
        *x = *x * x.all((n + 1) as f64);
    }
    rates
}

fn put_all<S: Simd>(vectors: &mut [Vector<S>], slot: usize, values: &[f64]) {
    for (vector, value) in vectors.iter_mut().zip(values) {
        vector.put(slot, *value);
    }
}
