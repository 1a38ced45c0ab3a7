//! The motion of one degree of freedom as a series in plain numbers, and its responses.
//!
//! Over a flight m q̈ + c q̇ + k q = f a change of the start, of m, c, k and of f changes the
//! motion by
//!
//! δq = C δq₀ + S δq̇₀ − R₀ δk − R₁ δc − R₂ δm + F,
//!
//! where C and S are the free motions from (1, 0) and (0, 1), and R₀, R₁, R₂ and F the responses
//! from rest to q, q̇, q̈ and δf. So what depends on the flight alone is computed once for all
//! changes: each is a combination of the same few responses. They obey one recurrence, side by
//! side, four in a block.

use super::TERMS;
use super::truncation::terms_for;
use crate::elementary::sin_cos;
use crate::scene::Harmonic;

/// Number of responses in a block.
const LANES: usize = 4;

/// The longest stretch, in radians of the fastest motion: no term of its series is more than eight
/// times the motion, and the first one left out of [`TERMS`] is 1e-16 of it.
const RADIANS: f64 = 3.5;

/// The series ends where a term of the acceleration is below this share of the first.
const LAST: f64 = 1e-16;

/// A response and its rate at the end of the flight, and the integrals of the response, alone and
/// times the motion.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Response {
    /// Its unit, and that per s.
    pub state: [f64; 2],
    /// ∫ of it, and ∫ of it times q.
    pub integrals: [f64; 2],
}

/// The motion and its responses, stretch by stretch.
#[derive(Debug)]
pub(crate) struct Responses {
    /// m, c, k.
    body: [f64; 3],
    /// The length of the stretch, s: x is 1 at its end.
    unit: f64,
    terms: usize,
    /// Terms of q.
    motion: [f64; TERMS],
    /// q (m) and q̇ (m/s) at the end of the stretch; ∫q and ∫q² over the flight so far.
    own: Response,
    /// The number of the response to q, where those to q, q̇ and q̈ are computed.
    inner: Option<usize>,
    count: usize,
    blocks: Vec<Block>,
}

/// Four responses.
#[derive(Debug, Clone)]
struct Block {
    terms: [[f64; LANES]; TERMS],
    /// The [`Response`]s, number by number.
    state: [[f64; LANES]; 2],
    integrals: [[f64; LANES]; 2],
}

impl Responses {
    /// Responses to `forces` forces, and to q, q̇ and q̈ where `inner` is true.
    pub fn new(forces: usize, inner: bool) -> Self {
        let count = 2 + forces + if inner { 3 } else { 0 };
        let zero = [[0.0; LANES]; 2];
        let block = Block { terms: [[0.0; LANES]; TERMS], state: zero, integrals: zero };
        Self {
            body: [1.0, 0.0, 0.0],
            unit: 1.0,
            terms: 1,
            motion: [0.0; TERMS],
            own: Response::default(),
            inner: inner.then_some(2 + forces),
            count,
            blocks: vec![block; count.div_ceil(LANES)],
        }
    }

    /// Begins a flight of mass (kg), damping (N s/m) and stiffness (N/m).
    pub fn begin(&mut self, body: [f64; 3]) {
        self.body = body;
        self.own = Response::default();
        for block in &mut self.blocks {
            (block.state, block.integrals) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        }
        if let Some(first) = self.blocks.first_mut() {
            first.state = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
        }
    }

    /// Divides a flight of `span` (s), under loads of up to `fastest` (rad/s), into stretches of
    /// one length, the unit of x (s); returns their number.
    pub fn divide(&mut self, span: f64, fastest: f64) -> usize {
        let [mass, damping, stiffness] = self.body;
        let (own, rub) = ((stiffness / mass).sqrt(), damping / mass);
        // An underdamped oscillation is no faster than the undamped one.
        let radians = span * fastest.max(if rub < 2.0 * own { own } else { rub });
        let stretches = ((radians / RADIANS).ceil() as usize).max(1);
        self.unit = span / stretches as f64;
        self.terms = terms_for(radians / stretches as f64, LAST);
        stretches
    }

    /// Number of terms of the motion and of the forces.
    pub fn terms(&self) -> usize {
        self.terms
    }

    /// The length of a stretch, s.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// Computes the stretch, on which the motion starts from `start` (m, m/s) under `load`, and the
    /// responses to `forces`: polynomials in x, N. `product` asks for the integrals times q.
    pub fn fill(&mut self, start: [f64; 2], load: &[f64; TERMS], forces: &[[f64; TERMS]], product: bool) {
        let Self { body: [mass, damping, stiffness], unit, terms, motion, own, inner, blocks, .. } = self;
        let (unit, count) = (*unit, terms.saturating_sub(2));
        let push = unit * unit / *mass;
        let (spring, dash) = (-push * *stiffness, -unit * *damping / *mass);
        // Each term waits for the one before it: they stay in registers, and what does not wait is
        // added first.
        let [mut now, mut next] = [start[0], start[1] * unit];
        (motion[0], motion[1]) = (now, next);
        for (k, motion) in motion[2..count + 2].iter_mut().enumerate() {
            *motion = PAIRS[k] * (push * load[k] + spring * now) + dash * INVERSE[k + 1] * next;
            (now, next) = (next, *motion);
        }
        for block in blocks.iter_mut() {
            block.terms[2..*terms].fill([0.0; LANES]);
        }
        for (number, force) in forces.iter().enumerate().map(|(i, force)| (i + 2, force)) {
            if let Some(block) = blocks.get_mut(number / LANES) {
                let to = block.terms[2..].iter_mut().zip(force).zip(&PAIRS).take(count);
                to.for_each(|((term, force), pair)| term[number % LANES] = push * pair * force);
            }
        }
        for (order, number) in inner.iter().flat_map(|&first| (first..first + 3).enumerate()) {
            let scale = push / unit.powi(order as i32);
            if let Some(block) = blocks.get_mut(number / LANES) {
                let to = block.terms[2..].iter_mut().zip(&motion[order..]).zip(&SHARES[order]).take(count);
                to.for_each(|((term, a), share)| term[number % LANES] = scale * share * a);
            }
        }
        let weights = if product { weights(motion, *terms, unit) } else { [0.0; TERMS] };
        for block in blocks.iter_mut() {
            block.extend(unit, count, [spring, dash]);
            block.add_up(&weights, unit, *terms);
        }
        own.state = [0.0; 2];
        for k in (0..*terms).rev() {
            own.state[0] += motion[k];
            own.state[1] += k as f64 * motion[k];
            own.integrals[0] += unit * INVERSE[k] * motion[k];
            own.integrals[1] += weights[k] * motion[k];
        }
        own.state[1] /= unit;
    }

    /// The motion at the end of the last stretch, and its integrals.
    pub fn own(&self) -> Response {
        self.own
    }

    /// Response number `number`: 0 and 1 are C and S, those to the forces follow.
    pub fn response(&self, number: usize) -> Response {
        let (block, lane) = (&self.blocks[number / LANES], number % LANES);
        let of = |pair: &[[f64; LANES]; 2]| [pair[0][lane], pair[1][lane]];
        Response { state: of(&block.state), integrals: of(&block.integrals) }
    }

    /// The number of the response to q, where it is computed; those to q̇ and q̈ follow.
    pub fn inner(&self) -> Option<usize> {
        self.inner
    }

    /// Number of the responses.
    pub fn count(&self) -> usize {
        self.count
    }

    /// A response and its rate at x.
    pub fn state_at(&self, number: usize, x: f64) -> [f64; 2] {
        let (block, lane) = (&self.blocks[number / LANES], number % LANES);
        let (mut value, mut rate) = (0.0, 0.0);
        for k in (0..self.terms).rev() {
            value = value * x + block.terms[k][lane];
            if k > 0 {
                rate = rate * x + k as f64 * block.terms[k][lane];
            }
        }
        [value, rate / self.unit]
    }
}

impl Block {
    /// Computes the terms, which from the third on hold what the forces contribute to them.
    fn extend(&mut self, unit: f64, count: usize, [spring, dash]: [f64; 2]) {
        let Self { terms, state, .. } = self;
        terms[0] = state[0];
        terms[1] = state[1].map(|rate| rate * unit);
        let ([mut now, mut next], last) = ([terms[0], terms[1]], count + 2);
        for ((term, pair), inverse) in terms[2..last].iter_mut().zip(&PAIRS).zip(&INVERSE[1..]) {
            let (own, rub) = (spring * pair, dash * inverse);
            let new = std::array::from_fn(|lane| (term[lane] + own * now[lane]) + rub * next[lane]);
            (*term, now, next) = (new, next, new);
        }
    }

    /// Sets the state at the end of the stretch, and adds its integrals, those times q by
    /// `weights`.
    fn add_up(&mut self, weights: &[f64; TERMS], unit: f64, count: usize) {
        let Self { terms, state, integrals } = self;
        let ([mut value, mut rate], [mut area, mut product]) = ([[0.0; LANES]; 2], [[0.0; LANES]; 2]);
        for (k, term) in terms[..count].iter().enumerate().rev() {
            let (per, inverse, weight) = (k as f64, INVERSE[k], weights[k]);
            for lane in 0..LANES {
                value[lane] += term[lane];
                rate[lane] += per * term[lane];
                area[lane] += inverse * term[lane];
                product[lane] += weight * term[lane];
            }
        }
        *state = [value, rate.map(|rate| rate / unit)];
        for lane in 0..LANES {
            integrals[0][lane] += unit * area[lane];
            integrals[1][lane] += product[lane];
        }
    }
}

/// Adds the terms of A sin(ω t + φ) from the time `start` (s) on to a polynomial in x of the unit
/// `unit` (s).
pub(crate) fn add_sine(wave: &Harmonic, (start, unit): (f64, f64), out: &mut [f64]) {
    let (sin, cos) = sin_cos(wave.omega * start + wave.phase);
    let (phases, radians) = ([sin, cos, -sin, -cos], wave.omega * unit);
    let mut amplitude = wave.amplitude;
    for (k, out) in out.iter_mut().enumerate() {
        *out += amplitude * phases[k % 4];
        amplitude *= radians * INVERSE[k];
    }
}

/// `unit` ∫₀¹ q xᵏ of the polynomial `q` of `terms` terms.
fn weights(q: &[f64; TERMS], terms: usize, unit: f64) -> [f64; TERMS] {
    let mut weights = [0.0; TERMS];
    for (k, a) in q.iter().enumerate().take(terms) {
        let (a, inverse) = (unit * a, &INVERSE[k..k + terms]);
        for (weight, inverse) in weights.iter_mut().zip(inverse) {
            *weight += a * inverse;
        }
    }
    weights
}

/// 1/(k + 1).
pub(crate) const INVERSE: [f64; 2 * TERMS] = {
    let mut inverse = [0.0; 2 * TERMS];
    let mut k = 0;
    while k < inverse.len() {
        inverse[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    inverse
};

/// 1/(k + 1)(k + 2).
const PAIRS: [f64; TERMS] = SHARES[0];

/// 1/(k + 1)(k + 2) times what the derivatives of order 0, 1 and 2 multiply term k of theirs by.
const SHARES: [[f64; TERMS]; 3] = {
    let mut shares = [[1.0; TERMS]; 3];
    let mut k = 0;
    while k < TERMS {
        shares[0][k] = 1.0 / ((k + 1) * (k + 2)) as f64;
        shares[1][k] = 1.0 / (k + 2) as f64;
        k += 1;
    }
    shares
};
