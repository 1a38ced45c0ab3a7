//! The derivative of the Floquet multipliers of one degree of freedom with respect to a key.
//!
//! The monodromy matrix is the product of the propagators Φ of the flights and the saltation
//! matrices S of the events (`floquet.rs`), so that it changes by the product rule. The propagator
//! Φ = e^{Aτ} of a flight of length τ changes by
//!
//! δΦ = ∫₀^τ e^{A(τ−s)} δA e^{As} ds + A Φ δτ,
//!
//! where the integral is the upper right block of the exponential of [[A, δA], [0, A]] τ (Van Loan
//! 1978, doi:10.1109/TAC.1978.1101743). The saltation matrix of an impact contains e, its velocity
//! and the accelerations at both sides. There the displacement is that of the wall and the velocity
//! follows from the speed, so that m δq̈ = δf + ḟ δt − δ(c q̇) − δ(k q) − δm q̈ closes the system:
//! no derivative of the motion is needed beyond the changes of phases and speeds.

use super::boundary::BoundaryLaw;
use super::equations::{CYCLE, Equations, Flight};
use super::floquet::Floquet;
use super::problem::Problem;
use super::signature::Kind;
use crate::flow::Jet;
use crate::variation::SceneTangent;
use crate::variation::saltation::{IDENTITY, Matrix2, entry, impact, multiply};
use nalgebra::{Complex, DVector, Matrix4};

/// Two multipliers whose difference is below this share of their size coincide: their derivative
/// has fewer than eight digits.
const SAME: f64 = 1e-8;

/// Mass, damping and stiffness during a flight, those of touching walls included, with their
/// changes; and the change of Σ k_a g.
#[derive(Debug, Clone, Copy)]
struct Body {
    mass: [f64; 2],
    damping: [f64; 2],
    stiffness: [f64; 2],
    push: f64,
}

/// What a flight adds to the product: its propagator, the logarithm of whose determinant changes by
/// `area`, and the accelerations at both ends; each with its change.
#[derive(Debug, Clone, Copy)]
struct Share {
    propagator: Matrix2,
    changed: Matrix2,
    determinant: f64,
    area: f64,
    after: [f64; 2],
    before: [f64; 2],
}

impl Body {
    /// The change of the acceleration at an end of a flight whose state changes by `moved` and
    /// whose instant by `later` (s); `driven` is the change of the load, N.
    fn acceleration_by(&self, jet: &Jet, moved: [f64; 2], later: f64, driven: f64) -> f64 {
        let Self { mass: [m, dm], damping: [c, dc], stiffness: [k, dk], push } = *self;
        let [q, v, a, jerk, ..] = *jet;
        let rate = m * jerk + c * a + k * v;
        (driven + rate * later + push - dm * a - dc * v - dk * q - c * moved[1] - k * moved[0]) / m
    }

    /// The change of the propagator `phi` of a flight of length `span` that becomes longer by
    /// `longer` (s), in units of time in which its fastest rate is 1.
    fn propagator_by(&self, phi: &Matrix2, span: f64, longer: f64) -> Matrix2 {
        let Self { mass: [m, dm], damping: [c, dc], stiffness: [k, dk], .. } = *self;
        let (kappa, drag) = (k / m, c / m);
        let (stiffer, damped) = ((dk - kappa * dm) / m, (dc - drag * dm) / m);
        let unit = 1.0 / kappa.sqrt().max(drag).max(1.0 / span);
        let field = [[0.0, 1.0 / unit], [-kappa * unit, -drag]];
        let change = [[0.0, 0.0], [-stiffer * unit, -damped]];
        let block = Matrix4::from_fn(|i, j| match (i / 2, j / 2) {
            (0, 1) => change[i][j - 2] * span,
            (1, 0) => 0.0,
            _ => field[i % 2][j % 2] * span,
        });
        let whole = block.exp();
        // Back to metres and metres per second.
        let scale = |i: usize, j: usize| [1.0, unit][j] / [1.0, unit][i];
        let own = [[0.0, 1.0], [-kappa, -drag]];
        let along = multiply(own, *phi);
        let entry = |i: usize, j: usize| whole[(i, j + 2)] * scale(i, j) + longer * along[i][j];
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    }
}

impl Problem {
    /// The derivatives of trace and determinant of the monodromy matrix, or of the half map of a
    /// symmetric orbit, per unit of the key of `tangent`. The first of the two vectors are the
    /// scaled unknowns, the second their change; the forcing period changes by `longer` (s).
    pub(super) fn monodromy_derivative(
        &self,
        equations: &Equations<'_>,
        unknowns: [&DVector<f64>; 2],
        tangent: &SceneTangent,
        longer: f64,
    ) -> [f64; 2] {
        let signature = equations.signature;
        let sign = if signature.symmetric { -1.0 } else { 1.0 };
        if signature.rests() {
            return [0.0; 2];
        }
        let flights: Vec<Flight<'_>> =
            (0..signature.events.len()).filter_map(|i| equations.flight(self, i, unknowns[0].as_slice())).collect();
        let mut shares: Vec<Share> =
            flights.iter().map(|flight| self.share(equations, flight, unknowns[1], tangent, longer)).collect();
        if flights.is_empty() {
            shares.push(self.quiet_share(signature.cycles(), tangent, longer));
        }
        let (mut whole, mut change, mut determinant) = (IDENTITY, [[0.0; 2]; 2], [1.0, 0.0]);
        for (index, share) in shares.iter().enumerate() {
            let previous = if index == 0 { shares.len() - 1 } else { index - 1 };
            let mirrored = if index == 0 { sign } else { 1.0 };
            let before = shares.get(previous).map_or([0.0; 2], |share| share.before.map(|a| mirrored * a));
            let event = flights.get(index).map(|flight| {
                let faster = equations.scales.speed * unknowns[1][2 * index + 1];
                self.saltation_by(flight, faster, [before, share.after], tangent)
            });
            let (jump, jumped, size) = event.unwrap_or((IDENTITY, [[0.0; 2]; 2], [1.0, 0.0]));
            let reached = multiply(jump, whole);
            let moved = sum(multiply(jumped, whole), multiply(jump, change));
            change = sum(multiply(share.changed, reached), multiply(share.propagator, moved));
            whole = multiply(share.propagator, reached);
            let own = [share.determinant * size[0], share.determinant * (size[0] * share.area + size[1])];
            determinant = [determinant[0] * own[0], determinant[1] * own[0] + determinant[0] * own[1]];
        }
        [sign * (change[0][0] + change[1][1]), determinant[1]]
    }

    /// What `flight` adds, for the scaled change `change` of the unknowns.
    fn share(
        &self,
        equations: &Equations<'_>,
        flight: &Flight<'_>,
        change: &DVector<f64>,
        tangent: &SceneTangent,
        longer: f64,
    ) -> Share {
        let mut arc = self.arc();
        let span = equations.fly(self, &mut arc, flight);
        let period = self.forcing_period();
        let [start, end] = [(flight.i, 0), (flight.j, 1)]
            .map(|(event, which)| change[2 * event] * CYCLE * period + flight.phases[which] * longer);
        let (mut from, mut to) = flight.ends_by(tangent);
        let faster = [flight.i, flight.j].map(|event| change[2 * event + 1] * equations.scales.speed);
        for k in 0..2 {
            from[k] += flight.from.rate[k] * faster[0];
            to[k] = flight.sign * (to[k] + flight.to.rate[k] * faster[1]);
        }
        let body = self.body_by(equations.touching.get(flight.i).map_or(&[][..], Vec::as_slice), tangent);
        let (first, last) = (arc.start_jet(), arc.jet(span));
        let driven = flight.phases.map(|phase| tangent.force(phase * period));
        Share {
            after: [first[2], body.acceleration_by(&first, from, start, driven[0])],
            before: [last[2], body.acceleration_by(&last, to, end, driven[1])],
            ..body.share(&arc.propagator(), span, end - start)
        }
    }

    /// The same of a motion that meets no wall, over `cycles` forcing periods.
    fn quiet_share(&self, cycles: f64, tangent: &SceneTangent, longer: f64) -> Share {
        let (mut arc, span) = (self.arc(), cycles * self.forcing_period());
        self.fly(&mut arc, [0.0; 2], [0.0, span], &[], None);
        self.body_by(&[], tangent).share(&arc.propagator(), span, cycles * longer)
    }

    /// The body while the elastic walls `touching` touch.
    fn body_by(&self, touching: &[usize], tangent: &SceneTangent) -> Body {
        let (own, [m, c, k]) = (self.body(), tangent.body());
        let mut body =
            Body { mass: [own.mass, m], damping: [own.damping, c], stiffness: [own.stiffness, k], push: 0.0 };
        for touch in touching.iter().filter_map(|&wall| self.touch(wall)) {
            let Some(by) = tangent.wall(touch.wall) else { continue };
            body.damping = [body.damping[0] + touch.damping, body.damping[1] + by.damping];
            body.stiffness = [body.stiffness[0] + touch.stiffness, body.stiffness[1] + by.stiffness];
            body.push += by.stiffness * touch.position + touch.stiffness * by.position;
        }
        body
    }

    /// The saltation matrix of the event at the start of `flight`, its change, and its determinant
    /// with its change; the speed of the event changes by `faster` (m/s), the accelerations just
    /// before and just after have their changes beside them.
    fn saltation_by(
        &self,
        flight: &Flight<'_>,
        faster: f64,
        [before, after]: [[f64; 2]; 2],
        tangent: &SceneTangent,
    ) -> (Matrix2, Matrix2, [f64; 2]) {
        let (boundary, by) = (flight.boundaries[0], tangent.wall(flight.walls[0]));
        match (flight.kinds[0], boundary.law) {
            (Kind::Impact, BoundaryLaw::Rigid(e)) => {
                let (v, bouncier) = (boundary.toward * flight.speeds[0], by.map_or(0.0, |by| by.restitution));
                let own = impact(e, v, [before[0], after[0]]);
                let steeper = after[1] + e * before[1] + bouncier * before[0] - own[1][0] * boundary.toward * faster;
                (own, [[-bouncier, 0.0], [steeper / v, -bouncier]], [e * e, 2.0 * e * bouncier])
            }
            (Kind::Enter, BoundaryLaw::Elastic { damping, .. }) => {
                let (m, [heavier, ..]) = (self.body().mass, tangent.body());
                let change = (damping * heavier / m - by.map_or(0.0, |by| by.damping)) / m;
                (entry(damping, m), [[0.0, 0.0], [change, 0.0]], [1.0, 0.0])
            }
            _ => (IDENTITY, [[0.0; 2]; 2], [1.0, 0.0]),
        }
    }
}

impl Body {
    /// What a flight with the propagator `phi`, of length `span` that becomes longer by `longer`
    /// (s), adds, but for the accelerations at its ends.
    fn share(&self, phi: &Matrix2, span: f64, longer: f64) -> Share {
        let ([m, dm], [c, dc]) = (self.mass, self.damping);
        Share {
            propagator: *phi,
            changed: self.propagator_by(phi, span, longer),
            determinant: (-c / m * span).exp(),
            area: -(dc - c * dm / m) / m * span - c / m * longer,
            after: [0.0; 2],
            before: [0.0; 2],
        }
    }
}

impl Floquet {
    /// The derivatives of the multipliers for those of trace and determinant: μ² − t μ + d = 0
    /// gives δμ = (μ δt − δd)/(2μ − t), and a multiplier of a symmetric orbit is the square of that
    /// of its half map. `None` where two coincide, unless both are 0 and stay so.
    pub(super) fn derivative(&self, [trace, determinant]: [f64; 2]) -> Option<Vec<[f64; 2]>> {
        let own = self.half.as_ref().unwrap_or(&self.multipliers);
        let still = [self.trace, self.determinant, trace, determinant].iter().all(|&x| x == 0.0);
        let of = |&[re, im]: &[f64; 2]| {
            let value = Complex::new(re, im);
            let apart = value * 2.0 - self.trace;
            let size = self.trace.abs().max(self.determinant.abs().sqrt());
            if still {
                return Some([0.0; 2]);
            }
            let change = (value * trace - determinant) / apart;
            let change = if self.half.is_some() { value * change * 2.0 } else { change };
            (apart.norm() > SAME * size).then_some([change.re, change.im])
        };
        own.iter().map(of).collect()
    }
}

fn sum(a: Matrix2, b: Matrix2) -> Matrix2 {
    let entry = |i: usize, j: usize| a[i][j] + b[i][j];
    [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
}
