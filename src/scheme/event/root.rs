//! First roots that are never skipped: one-sided steps by polynomials that are lower bounds of a
//! function.

/// A lower bound of a function g from one instant on: g(u) ≥ Σ cₙ uⁿ/n! (n ≤ 3) − b u⁴/24 for 0 ≤ u
/// ≤ w.
#[derive(Debug, Clone, Copy)]
pub(super) struct Below {
    /// g, g′, g″, g‴ at the instant.
    pub c: [f64; 4],
    /// g⁗ at the instant; used only where all the others vanish.
    pub fourth: f64,
    /// A bound on |g⁗| over the window, ≥ 0.
    pub bound: f64,
    /// The sizes below which the first four are rounding.
    pub noise: [f64; 4],
    /// True if reaching 0 is no event, but only going below it.
    pub passes_touch: bool,
}

/// How far one can go by a [`Below`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    /// g is at 0, within rounding, and goes below it at once.
    Now,
    /// The first root of g, within rounding; the polynomial is exact to rounding up to it.
    Root(f64),
    /// A minimum of g that is 0 within rounding.
    Touch(f64),
    /// g has no root before this; the whole window where it has none there.
    Free(f64),
}

/// Maximum number of Newton steps: each is one-sided, so stopping early costs time, not safety.
const INNER_STEPS: usize = 16;

/// A minimum whose magnitude is below this many times its rounding error is a touch.
const TOUCH: f64 = 4.0;

/// A release stands unless the acceleration towards the wall exceeds this many times its rounding
/// error.
const LET_GO: f64 = 16.0;

/// A tenth of the 1/24 with which the bound enters.
const BLUR: f64 = 0.1 / 24.0;

const SIXTH: f64 = 1.0 / 6.0;

impl Below {
    /// How far one can go, at most `window`, without skipping a root of g.
    #[inline]
    pub fn step(&self, window: f64) -> Step {
        if self.c[0] > self.noise[0] {
            return if stays_above(self.c, self.bound, window, self.noise[0]) {
                Step::Free(window)
            } else {
                self.approach(window)
            };
        }
        self.depart(window)
    }

    /// Prevents rounding alone from making g negative at once where it starts at 0 with velocity 0:
    /// the caller has decided that g grows.
    pub fn set_aside(&mut self) {
        let [c0, c1, c2, _] = &mut self.c;
        if *c0 <= self.noise[0] && *c2 > -LET_GO * self.noise[2] {
            (*c0, *c1, *c2) = (c0.max(0.0), c1.max(0.0), c2.max(0.0));
        }
    }

    /// Where g falls towards its rounding error at `s` from now: a touch if its minimum is 0 to
    /// rounding. `None` if g goes on falling, or if the minimum cannot be told from here.
    ///
    /// Taking the place where g first falls to its rounding error for a root would be too early by
    /// the square root of that error.
    #[inline(never)]
    pub fn touch(&self, s: f64, window: f64) -> Option<Step> {
        let [c0, c1, c2, c3] = self.c;
        let b = self.bound;
        let g = c0 + s * (c1 + s * (0.5 * c2 + s * (c3 * SIXTH - s * b * (0.25 * SIXTH))));
        let rate = c1 + s * (c2 + s * (0.5 * c3 - s * b * SIXTH));
        let curve = c2 + s * (c3 - 0.5 * s * b);
        let noise = self.noise[0];
        if !(rate < 0.0
            && curve > self.noise[2]
            && g <= TOUCH * noise
            && g - 0.5 * rate * rate / curve >= -TOUCH * noise)
        {
            return None;
        }
        // Past the minimum by the same distance, plus twice the distance at which a parabola
        // exceeds the rounding error.
        let past = 2.0 * (-rate / curve) + 4.0 * (noise / curve).sqrt();
        let varies = past * (c3.abs() + b * (s + past));
        if varies > 0.5 * curve {
            return None;
        }
        let lowest = s - rate / curve;
        Some(if self.passes_touch {
            Step::Free((s + past).min(window))
        } else if lowest < window {
            Step::Touch(lowest)
        } else {
            Step::Free(window)
        })
    }

    /// g is above 0 now.
    #[inline(never)]
    fn approach(&self, window: f64) -> Step {
        let (s, left) = first_root(self.c, self.bound, window, self.noise[0]);
        if s >= window {
            Step::Free(window)
        } else if let Some(touch) = self.touch(s, window) {
            touch
        } else if left <= self.noise[0] && self.bound * s.powi(4) <= 24.0 * self.noise[0] {
            Step::Root(s)
        } else {
            Step::Free(s)
        }
    }

    /// g is 0 now: the root at 0 is divided out with its multiplicity.
    #[inline(never)]
    fn depart(&self, window: f64) -> Step {
        let [c0, c1, c2, c3] = self.c;
        if let Some(touch) = self.touch(0.0, window) {
            return touch;
        }
        if c0 < -self.noise[0] && !self.passes_touch && c1 <= 0.0 {
            return Step::Now;
        }
        if self.passes_touch && c0 < -TOUCH * self.noise[0] {
            return Step::Now;
        }
        let tail = if c1.abs() > self.noise[1] {
            (c1, [c1, c2 / 2.0, c3 / 3.0, -self.bound / 4.0])
        } else if c2.abs() > self.noise[2] {
            (c2, [c2 / 2.0, c3 / 6.0, -self.bound / 12.0, 0.0])
        } else if c3.abs() > self.noise[3] {
            (c3, [c3 / 6.0, -self.bound / 24.0, 0.0, 0.0])
        } else if self.fourth > 0.0 {
            // Both u⁴ terms: no root of g is nearer than where the bound, grown over a window,
            // would cancel the fourth derivative.
            return Step::Free(window * (self.fourth / self.bound).min(1.0));
        } else if self.fourth < 0.0 {
            return Step::Now;
        } else {
            return Step::Free(window);
        };
        if tail.0 < 0.0 {
            return Step::Now;
        }
        if stays_above(tail.1, 0.0, window, 0.0) {
            return Step::Free(window);
        }
        Step::Free(first_root(tail.1, 0.0, window, 0.0).0)
    }
}

/// True if p(u) = Σ cₙ uⁿ/n! − b u⁴/24 stays above `enough` with each negative term at its largest
/// in [0, w]: the common case, which must be cheap.
#[inline]
fn stays_above([c0, c1, c2, c3]: [f64; 4], b: f64, w: f64, enough: f64) -> bool {
    let cubic = SIXTH * c3.min(0.0) - w * b * (0.25 * SIXTH);
    c0 + w * (c1.min(0.0) + w * (0.5 * c2.min(0.0) + w * cubic)) > enough
}

/// A lower bound of the first root of p + p′u − ½Mu²; `far` where it has none.
#[inline(always)]
fn below_root(p: f64, p1: f64, m: f64, far: f64) -> f64 {
    if p1 < 0.0 && m * p <= p1 * p1 {
        -2.0 * p * p1 / (2.0 * p1 * p1 + m * p)
    } else if m > 0.0 {
        let square = (p1 * p1 + 2.0 * m * p).sqrt();
        if p1 < 0.0 { 2.0 * p / (square - p1) } else { (square + p1) / m }
    } else {
        far
    }
}

/// A step of less than this share of the window is short only because the bound is taken far beyond
/// it …
const NEAR: f64 = 0.125;

/// … and is tried again with up to this many nearer ends, each the geometric mean of the step and
/// the last end.
const NEARER: usize = 6;

/// The longest safe step found with M taken over less than the whole window: a bound that is left
/// from a transient grows like the square of the window, and is irrelevant within the time to the
/// root. The cubic has p, p′, p″ and the third derivative `p3`.
#[inline(never)]
fn within_reach([p, p1, p2]: [f64; 3], p3: f64, b: f64, mut u: f64, mut reach: f64) -> f64 {
    for _ in 0..NEARER {
        reach = (u * reach).sqrt();
        let m = (-p2.min(p2 + reach * (p3 - 0.5 * b * reach))).max(0.0);
        u = u.max(below_root(p, p1, m, reach).min(reach));
        if u >= NEAR * reach || (p1 < 0.0 && m * p <= p1 * p1) {
            break;
        }
    }
    u
}

/// A lower bound of the first root of p(u) = Σ cₙ uⁿ/n! − b u⁴/24 in [0, w], or w if there is none,
/// with p there; p(0) > 0.
///
/// p″ is concave for b ≥ 0, so its least value over [s, w] is at an end, and p(s + u) ≥ p + p′u −
/// ½Mu² there with M = max(0, −least). Where p falls, the root of that is at least Halley's
/// 2p|p′|/(2p′² + Mp), which is close to it for Mp ≤ p′².
#[inline]
fn first_root([c0, c1, c2, c3]: [f64; 4], b: f64, w: f64, enough: f64) -> (f64, f64) {
    let (mut s, mut p, mut p1, mut p2) = (0.0, c0, c1, c2);
    let last = c2 + c3 * w - 0.5 * b * w * w;
    for _ in 0..INNER_STEPS {
        let m = (-p2.min(last)).max(0.0);
        let mut u = below_root(p, p1, m, w);
        if u < NEAR * (w - s) && (p1 >= 0.0 || m * p > p1 * p1) {
            u = within_reach([p, p1, p2], c3 - b * s, b, u, w - s);
        }
        let next = s + u;
        if next >= w || next.is_nan() {
            return (if next.is_nan() { s } else { w }, p);
        }
        let at = |s: f64| c0 + s * (c1 + s * (0.5 * c2 + s * (c3 * SIXTH - s * b * (0.25 * SIXTH))));
        let value = at(next);
        if value <= enough {
            // Rounding may put the value below 0: a step a little shorter is then above it.
            let safe = if value < -enough { s + 0.999 * u } else { next };
            return (safe, if value < -enough { p } else { value.abs() });
        }
        // The bound's term in p outweighs the value of p: a new evaluation of g gains more than a
        // closer root of p.
        let blur = if enough > 0.0 { BLUR * b * next.powi(4) } else { f64::INFINITY };
        if next == s || (u <= 0.1 * next && value <= blur) {
            return (next, value);
        }
        (s, p) = (next, value);
        p1 = c1 + s * (c2 + s * (0.5 * c3 - s * b * SIXTH));
        p2 = c2 + s * (c3 - 0.5 * s * b);
    }
    (s, p)
}

#[cfg(test)]
mod tests;
