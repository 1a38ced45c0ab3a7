//! What happens next in a lane that could not march: an impact, a turn of the motion, the end of a
//! period, or nothing.

use super::series::ORDER;
use super::state::{Constants, State, rates};
use super::vector::{Mask, Vector, polynomial};
use pulp::Simd;

/// Steps of an iteration at most: Halley's method takes three or four, halving between two bounds
/// 52.
const MOST_STEPS: usize = 64;

/// Halley's step is the last if it is shorter than this share of the time …
const LAST: f64 = 1e-6;

/// … and changes the speed by less than this share: what is left is the cube of either.
const STRAIGHT: f64 = 1e-5;

/// Newton's step to a turn is the last if it is shorter than this share of the stretch: what is
/// left is its square.
const LAST_TURN: f64 = 1e-9;

/// What came of a stretch, lane by lane; a lane in which nothing of it is true has moved on, or
/// will look at less.
pub(super) struct Ended<S: Simd> {
    /// The end of the period was reached.
    pub strobed: Mask<S>,
    /// The lower, the upper wall was struck …
    pub struck: [Mask<S>; 2],
    /// … at this speed, m a step.
    pub speed: Vector<S>,
}

/// The motion from one instant on: u(z) − u(0), u′ and u″ by their series.
struct Path<S: Simd> {
    way: [Vector<S>; ORDER],
    rate: [Vector<S>; ORDER],
    bend: [Vector<S>; ORDER],
}

impl<S: Simd> Path<S> {
    #[inline(always)]
    fn of<const W: usize>(k: &Constants<S, W>, a: &State<S, W>) -> Self {
        let p = k.kappa.taken_from(a.u, k.push);
        let way = std::array::from_fn(|n| {
            // S begins with z: an exact velocity stays so.
            if n == 0 {
                return a.w;
            }
            let mut x = a.w.fma(k.impulse[n], p * k.integral[n]);
            for (wave, [sin, cos]) in k.waves.iter().zip(&a.phase) {
                x = sin.fma(wave.series[0][n], cos.fma(wave.series[1][n], x));
            }
            x
        });
        let rate = rates(&way);
        let zero = a.w.all(0.0);
        let bend = std::array::from_fn(|n| rate.get(n + 1).map_or(zero, |r| *r * zero.all((n + 1) as f64)));
        Self { way, rate, bend }
    }

    #[inline(always)]
    fn way(&self, z: Vector<S>) -> Vector<S> {
        z * polynomial(&self.way, z)
    }

    #[inline(always)]
    fn rate(&self, z: Vector<S>) -> Vector<S> {
        polynomial(&self.rate, z)
    }

    #[inline(always)]
    fn bend(&self, z: Vector<S>) -> Vector<S> {
        polynomial(&self.bend, z)
    }

    /// Where u′ vanishes in (0, h), in the lanes where it changes its sign over it: Newton's method
    /// kept between two bounds.
    #[inline(always)]
    fn turn(&self, asked: Mask<S>, h: Vector<S>, [w0, w1]: [Vector<S>; 2]) -> Vector<S> {
        let half = h.all(0.5);
        let (mut low, mut high) = (h.all(0.0), h);
        let mut z = h * w0 / (w0 - w1);
        let mut moving = asked;
        for _ in 0..MOST_STEPS {
            let w = self.rate(z);
            let same = (w * w0).gt(h.all(0.0));
            (low, high) = (same.pick(z, low), same.pick(high, z));
            let newton = z - w / self.bend(z);
            // A short step is taken even if rounding has put it beyond a bound.
            let done = (newton - z).abs().le(h.all(LAST_TURN) * h);
            let inside = newton.gt(low) & newton.lt(high);
            z = moving.pick((done | inside).pick(newton, half * (low + high)), z);
            moving = moving & !done;
            if !moving.any() {
                break;
            }
        }
        z
    }

    /// Where `gap` − side · (u(z) − u(0)) vanishes in (0, far), below 0 at `far` by `over`; and
    /// where it was not found. Halley's method kept between two bounds, from the parabola through
    /// both ends.
    #[inline(always)]
    fn meet(
        &self,
        asked: Mask<S>,
        gap: Vector<S>,
        side: Vector<S>,
        far: Vector<S>,
        over: Vector<S>,
    ) -> (Vector<S>, Mask<S>) {
        let [zero, half, two] = [0.0, 0.5, 2.0].map(|x| gap.all(x));
        let slope = -(side * self.way[0]);
        let curve = (slope.taken_from(far, over - gap)) / (far * far);
        let root = (curve * gap).taken_from(two + two, slope * slope).max(zero).sqrt();
        let falling = slope.le(zero);
        let above = falling.pick(two * gap, slope + root);
        let first = above / falling.pick(root - slope, -(two * curve));
        let (mut low, mut high) = (zero, far);
        let mut z = (first.gt(low) & first.lt(high)).pick(first, half * far);
        let mut moving = asked;
        for _ in 0..MOST_STEPS {
            let y = side.taken_from(self.way(z), gap);
            let (y1, y2) = (-(side * self.rate(z)), -(side * self.bend(z)));
            let past = y.lt(zero);
            (low, high) = (past.pick(low, z), past.pick(z, high));
            let halley = z - two * y * y1 / y.taken_from(y2, two * y1 * y1);
            let by = (halley - z).abs();
            let done = by.le(zero.all(LAST) * z) & (by * y2.abs()).le(zero.all(STRAIGHT) * y1.abs());
            let inside = halley.gt(low) & halley.lt(high);
            z = moving.pick((done | inside).pick(halley, half * (low + high)), z);
            moving = moving & !done;
            if !moving.any() {
                break;
            }
        }
        (z, moving)
    }
}

impl<S: Simd, const W: usize> Constants<S, W> {
    /// Moves every lane that is `active` over the next stretch of at most one step: to the first
    /// wall met on it, to a turn that could be a graze or the window's new extreme, to the end of
    /// the period or of the step. What cannot be decided (the certificate of [`Constants::march`]
    /// fails) stays where it is, and looks at half as much next time.
    #[inline(always)]
    pub fn stretch(&self, a: &mut State<S, W>, active: Mask<S>) -> Ended<S> {
        let [zero, one, third] = [0.0, 1.0, 1.0 / 3.0].map(|x| a.t.all(x));
        let rest = (self.steps - a.t).max(zero);
        let whole = rest.min(one);
        let h = whole * a.share;
        let path = Path::of(self, a);
        let (gap_upper, gap_lower) = (self.upper - a.u, a.u - self.lower);
        let (mut way, mut w) = (path.way(h), path.rate(h));
        let (mut over, mut under) = (way.gt(gap_upper), (-way).gt(gap_lower));
        let margin = self.margin(a);
        let inner = |z: Vector<S>, way: Vector<S>, w: Vector<S>| {
            let margin = margin * (z * z) * (z * z);
            let points = [third * a.w * z, (third * w).taken_from(z, way)];
            (points[0].max(points[1]) + margin, points[0].min(points[1]) - margin)
        };
        // A turn that could pass the wall or the extreme: to the turn.
        let (above, below) = inner(h, way, w);
        let upper_turn = a.w.gt(zero) & w.lt(zero) & above.max(way).ge(a.high - a.u);
        let lower_turn = a.w.lt(zero) & w.gt(zero) & below.min(way).le(a.low - a.u);
        let turns = active & (upper_turn | lower_turn) & !(over | under);
        let mut z = h;
        if turns.any() {
            let turn = path.turn(turns, h, [a.w, w]);
            (z, way, w) = (turns.pick(turn, z), turns.pick(path.way(turn), way), turns.pick(zero, w));
            (over, under) = (over | (turns & way.gt(gap_upper)), under | (turns & (-way).gt(gap_lower)));
        }
        let crossing = active & (over | under);
        let (mut lost, mut bend) = (!active, zero);
        if crossing.any() {
            let side = under.pick(-one, one);
            let gap = under.pick(gap_lower, gap_upper);
            let (met, unmet) = path.meet(crossing, gap, side, z, side.taken_from(way, gap));
            lost = lost | unmet;
            z = crossing.pick(met, z);
            (way, w) = (crossing.pick(side * gap, way), crossing.pick(path.rate(met), w));
            bend = path.bend(met);
        }
        let (above, below) = inner(z, way, w);
        let decided = !lost & above.le(gap_upper) & way.le(gap_upper) & (-below).le(gap_lower) & (-way).le(gap_lower);
        let strobed = decided & !crossing & !turns & rest.le(one) & a.share.ge(one);
        let struck = [decided & crossing & under, decided & crossing & over & !under];
        let half = zero.all(0.5) * z / whole;
        a.share = decided.pick(one, active.pick(half, a.share));
        let z = decided.pick(z, zero);
        a.t = a.t + z;
        self.turn(a, z);
        a.u = decided.pick(a.u + way, a.u);
        a.w = decided.pick(w, a.w);
        let speed = a.w.abs();
        if crossing.any() {
            self.strike(a, struck, bend);
        }
        a.high = decided.pick(a.high.max(a.u), a.high);
        a.low = decided.pick(a.low.min(a.u), a.low);
        Ended { strobed, struck, speed }
    }

    /// Newton's law in the lanes that struck a wall, with u″ = `bend` before it; and on the change
    /// of the start the derivative of the map from one side of the impact to the other (Leine &
    /// Nijmeijer 2004, doi:10.1007/978-3-540-44398-8, ch. 7):
    ///
    /// δu⁺ = −e δu⁻,  δw⁺ = −e δw⁻ + (u″⁺ + e u″⁻)/w⁻ δu⁻ with u″⁺ = u″⁻ + α(1 + e)w⁻.
    #[inline(always)]
    fn strike(&self, a: &mut State<S, W>, [lower, upper]: [Mask<S>; 2], bend: Vector<S>) {
        let hit = lower | upper;
        let e = lower.pick(self.restitution[0], self.restitution[1]);
        let place = lower.pick(self.lower, self.upper);
        let gain = (e + e.all(1.0)) * self.alpha.fma(a.w, bend) / a.w;
        let [du, dw] = a.tangent;
        a.tangent = [hit.pick(-(e * du), du), hit.pick(gain * du - e * dw, dw)];
        a.u = hit.pick(place, a.u);
        a.w = hit.pick(-(e * a.w), a.w);
    }
}
