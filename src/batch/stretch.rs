//! The next event of a lane that could not make a whole step: an impact, a turning point, the end
//! of a period, or none.

use super::series::ORDER;
use super::state::{Constants, State, rates};
use super::vector::{Mask, Vector, polynomial};
use pulp::Simd;

/// Maximum number of iterations: Halley's method takes three or four, bisection 52.
const MOST_STEPS: usize = 64;

/// Number of Halley's steps on the first terms of the series, which find a root to about 1e-6 of
/// the time …
const ROUGH_STEPS: usize = 3;

/// … and the number of these terms: the next one is of the size REACH⁹/9! = 1e-7.
const ROUGH: usize = 8;

/// The iteration ends after a step of Halley's method shorter than this share of the time …
const LAST: f64 = 1e-6;

/// … which changes the speed by less than this share: the error left is the cube of these.
const STRAIGHT: f64 = 1e-5;

/// Newton's iteration for a turning point ends after a step shorter than this share of the stretch:
/// the error left is its square.
const LAST_TURN: f64 = 1e-9;

/// The event of a stretch in each lane; a lane without an event has advanced, or will try a shorter
/// stretch.
pub(super) struct Ended<S: Simd> {
    /// The end of the period was reached.
    pub strobed: Mask<S>,
    /// The lower, the upper wall was struck …
    pub struck: [Mask<S>; 2],
    /// … at this speed, m per step.
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
        // The series of S begins with z, which is a motion at constant velocity.
        let mut way = [a.w; ORDER];
        for (n, x) in way.iter_mut().enumerate().skip(1) {
            *x = a.w.fma(k.impulse[n], p * k.integral[n]);
            for (wave, [sin, cos]) in k.waves.iter().zip(&a.phase) {
                *x = sin.fma(wave.series[0][n], cos.fma(wave.series[1][n], *x));
            }
        }
        let rate = rates(&way);
        let mut bend = [a.w.all(0.0); ORDER];
        for (n, x) in bend.iter_mut().enumerate().take(ORDER - 1) {
            *x = rate[n + 1] * x.all((n + 1) as f64);
        }
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

    /// The zero of u′ in (0, h), in the lanes where u′ changes its sign over it: Newton's method
    /// within a bracket.
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

    /// Where `gap` − side · (u(z) − u(0)) vanishes in (0, far), below 0 at `far` by `over`; and the
    /// lanes in which it was not found. Halley's method within a bracket, starting from the
    /// parabola through both ends.
    #[inline(always)]
    fn first_contact(
        &self,
        asked: Mask<S>,
        gap: Vector<S>,
        side: Vector<S>,
        far: Vector<S>,
        over: Vector<S>,
    ) -> (Vector<S>, Mask<S>) {
        let (zero, half, two) = (gap.all(0.0), gap.all(0.5), gap.all(2.0));
        let slope = -(side * self.way[0]);
        let curve = (slope.taken_from(far, over - gap)) / (far * far);
        let root = (curve * gap).taken_from(two + two, slope * slope).max(zero).sqrt();
        let falling = slope.le(zero);
        let above = falling.pick(two * gap, slope + root);
        let first = above / falling.pick(root - slope, -(two * curve));
        let (mut low, mut high) = (zero, far);
        let mut z = (first.gt(low) & first.lt(high)).pick(first, half * far);
        for _ in 0..ROUGH_STEPS {
            let way = z * polynomial(&self.way[..ROUGH], z);
            let (y1, y2) = (polynomial(&self.rate[..ROUGH], z), polynomial(&self.bend[..ROUGH], z));
            let y = way - side * gap;
            let halley = z - two * y * y1 / y.taken_from(y2, two * y1 * y1);
            z = (halley.gt(zero) & halley.lt(far)).pick(halley, z);
        }
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

/// Upper and lower bound of the motion over a stretch of length `z`, relative to its start at speed
/// `w0`, by the inner control points of [`Constants::march`].
#[inline(always)]
fn inner<S: Simd>(w0: Vector<S>, margin: Vector<S>, z: Vector<S>, [way, w]: [Vector<S>; 2]) -> (Vector<S>, Vector<S>) {
    let third = z * z.all(1.0 / 3.0);
    let margin = margin * (z * z) * (z * z);
    let (first, last) = (third * w0, third.taken_from(w, way));
    (first.max(last) + margin, first.min(last) - margin)
}

impl<S: Simd, const W: usize> Constants<S, W> {
    /// Advances every lane that is `active` over the next stretch of at most one step: to the first
    /// wall met in it, to a turning point that could be a grazing contact or a new extreme of the
    /// window, to the end of the period or of the step. A lane in which this cannot be decided (the
    /// bound of [`Constants::march`] does not suffice) stays where it is, and tries half the length
    /// next time.
    #[inline(always)]
    pub fn stretch(&self, a: &mut State<S, W>, active: Mask<S>) -> Ended<S> {
        // In one piece: masks and lanes of every line go into the next ones.
        let (zero, one) = (a.t.all(0.0), a.t.all(1.0));
        let rest = (self.steps - a.t).max(zero);
        let whole = rest.min(one);
        let h = whole * a.share;
        let path = Path::of(self, a);
        let (gap_upper, gap_lower) = (self.upper - a.u, a.u - self.lower);
        let (mut way, mut w) = (path.way(h), path.rate(h));
        let (mut over, mut under) = (way.gt(gap_upper), (-way).gt(gap_lower));
        let margin = self.margin(a);
        // A turning point that could be beyond the wall or the extreme: advance to it.
        let (above, below) = inner(a.w, margin, h, [way, w]);
        let upper_turn = a.w.gt(zero) & w.lt(zero) & above.max(way).ge(a.high - a.u);
        let lower_turn = a.w.lt(zero) & w.gt(zero) & below.min(way).le(a.low - a.u);
        let turns = active & (upper_turn | lower_turn) & !(over | under);
        let mut z = h;
        if turns.any() {
            let turn = path.turn(turns, h, [a.w, w]);
            (z, way, w) = (turns.pick(turn, z), turns.pick(path.way(turn), way), turns.pick(zero, w));
            (over, under) = (over | (turns & way.gt(gap_upper)), under | (turns & (-way).gt(gap_lower)));
        }
        let (on_upper, on_lower) = (a.w.abs().le(zero) & gap_upper.le(zero), a.w.abs().le(zero) & gap_lower.le(zero));
        let crossing = active & (over | under) & !(on_upper | on_lower);
        // The velocities at both ends have the same sign, but the cubic is not monotonic: two
        // turning points between them could be beyond the extreme.
        let both = a.w + w;
        let bent = (way - z * zero.all(1.0 / 3.0) * both) * both;
        let extreme = above.max(way).ge(a.high - a.u) | below.min(way).le(a.low - a.u);
        let hidden = (a.w * w).ge(zero) & bent.lt(zero) & extreme & !(turns | crossing | on_upper | on_lower);
        let (mut lost, mut bend) = (!active | hidden, zero);
        if crossing.any() {
            let side = under.pick(-one, one);
            let gap = under.pick(gap_lower, gap_upper);
            let (met, unmet) = path.first_contact(crossing, gap, side, z, side.taken_from(way, gap));
            lost = lost | unmet;
            z = crossing.pick(met, z);
            (way, w) = (crossing.pick(side * gap, way), crossing.pick(path.rate(met), w));
            bend = path.bend(met);
        }
        let (above, below) = inner(a.w, margin, z, [way, w]);
        let clear = self.lifts(&path, z, margin, on_lower.pick(one, -one));
        let before_upper = (above.le(gap_upper) & way.le(gap_upper)) | (on_upper & clear);
        let before_lower = ((-below).le(gap_lower) & (-way).le(gap_lower)) | (on_lower & clear);
        let decided = !lost & before_upper & before_lower;
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

    /// The lanes in which a body that a wall releases without speed stays off it up to `z`: with
    /// the acceleration 2c₂ and the jerk 6c₃ away from the wall its gap is at least z²(c₂ + c₃z −
    /// |u⁗|z²/24), whose bracket is concave. An acceleration that is rounding error, as at a
    /// release from rest, counts as zero.
    #[inline(always)]
    fn lifts(&self, path: &Path<S>, z: Vector<S>, margin: Vector<S>, away: Vector<S>) -> Mask<S> {
        let (c2, c3) = (away * path.way[1], away * path.way[2]);
        let end = (margin * z.all(12.0) * z).taken_from(z, c3.fma(z, c2.max(z.all(0.0))));
        c2.ge(-self.noise) & end.gt(z.all(0.0))
    }

    /// Applies Newton's impact law in the lanes that struck a wall, with u″ = `bend` before it, and
    /// to the change of the initial state the derivative of the map across the impact (Leine &
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
