//! Sliding over a piece of exact motion, whose force and sliding velocity are known at every
//! instant: |v_t| is integrated from one sign change to the next.

/// Gauss's rule of four points on [−1, 1]: nodes and weights.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// A contact that slides: functions of time (s).
pub(super) struct Sliding<'a> {
    /// Magnitude of the normal force, N, and of its impulse between two times, N s.
    pub force: &'a dyn Fn(f64) -> f64,
    pub impulse: &'a dyn Fn(f64, f64) -> f64,
    /// v_t, m/s, and the distance between two times, m, if v_t keeps its sign between them.
    pub speed: &'a dyn Fn(f64) -> f64,
    pub way: &'a dyn Fn(f64, f64) -> f64,
}

/// The result: the work of wear ∫ F |v_t| dt, J, the impulse, N s, and the distance, m.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SlidingSums {
    pub work: f64,
    pub impulse: f64,
    pub way: f64,
}

impl Sliding<'_> {
    /// Adds to `sum` the sliding between two times, between which v_t changes its sign at most
    /// once.
    pub fn add(&self, from: f64, to: f64, sum: &mut SlidingSums) {
        let (left, right) = ((from, (self.speed)(from)), (to, (self.speed)(to)));
        if left.1 * right.1 < 0.0 {
            let root = self.turn(left, right);
            self.piece(from, root, sum);
            self.piece(root, to, sum);
        } else {
            self.piece(from, to, sum);
        }
    }

    fn piece(&self, a: f64, b: f64, sum: &mut SlidingSums) {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        for (node, weight) in GAUSS {
            let t = middle + half * node;
            sum.work += half * weight * (self.force)(t) * (self.speed)(t).abs();
        }
        sum.impulse += (self.impulse)(a, b);
        sum.way += (self.way)(a, b).abs();
    }

    /// The instant between two at which the speed changes its sign, by bisection down to rounding.
    fn turn(&self, mut left: (f64, f64), mut right: (f64, f64)) -> f64 {
        loop {
            let middle = 0.5 * (left.0 + right.0);
            if middle <= left.0 || middle >= right.0 {
                return middle;
            }
            let there = (middle, (self.speed)(middle));
            if there.1 * left.1 > 0.0 { left = there } else { right = there }
        }
    }
}
