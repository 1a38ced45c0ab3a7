//! Integrals along an exact arc, by Gauss's rule on halved panels.

/// Nodes and weights of the five-point Gauss–Legendre rule on [−1, 1].
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Panels are halved this often at most; a panel then is 1e-12 of the arc, and its error what it is.
const DEPTH: u32 = 40;

/// Panels that one arc may take, and those beside them for each radian of its fastest oscillation: beyond them what is left is taken as it
/// is, so that no integrand, be it noise, holds up a run.
const MOST_PANELS: f64 = 2000.0;
const PANELS_PER_RADIAN: f64 = 16.0;

/// What is integrated at an instant: values, the sizes of the terms that they are sums of, and a magnitude that goes along without being
/// held to any accuracy, for it may have kinks.
pub(super) struct Sample<const N: usize> {
    pub value: [f64; N],
    pub size: [f64; N],
    pub along: f64,
}

/// Instants at which an arc is looked at: inside it, never at its ends.
pub(super) fn nodes(start: f64, end: f64) -> impl Iterator<Item = f64> {
    GAUSS.iter().map(move |&(x, _)| 0.5 * (start + end) + 0.5 * (end - start) * x)
}

/// ∫ f dt over [start, end] for several integrands at once, and of what goes along. A panel is halved until its two halves change no integral by
/// more than 1e-14 of the integral of the sizes so far: with the error of a tenth-order rule the halves are then far better. Sizes are
/// those of the terms, not of their sum: where terms cancel, as the forces on a body at rest do, the sum is rounding, which no halving settles.
///
/// What decays does so from the start, at `rate` (1/s) at most: the first panel is no longer than 1/rate and each that follows twice as
/// long as the one before, or a few nodes over the whole arc would miss it. What oscillates does so over `radians` at most.
pub(super) fn integrate<const N: usize>(
    start: f64,
    end: f64,
    rate: f64,
    radians: f64,
    f: &mut impl FnMut(f64) -> Sample<N>,
) -> ([f64; N], f64) {
    let left = (MOST_PANELS + PANELS_PER_RADIAN * radians) as u64;
    let mut sums = Sums { total: [0.0; N], along: 0.0, scale: [0.0; N], left };
    let (mut from, mut width) = (start, if rate > 0.0 { 1.0 / rate } else { f64::INFINITY });
    while from < end {
        // Too short a layer for the clock is none that it can see.
        let to = if from + width > from { (from + width).min(end) } else { end };
        let whole = panel(from, to, f);
        for (scale, size) in sums.scale.iter_mut().zip(whole.size) {
            *scale = scale.max(size);
        }
        refine(from, to, whole.value, &mut sums, f, DEPTH);
        (from, width) = (to, 2.0 * width);
    }
    (sums.total, sums.along)
}

/// The integrals so far, the scales they are held to, and the panels left to take.
struct Sums<const N: usize> {
    total: [f64; N],
    along: f64,
    scale: [f64; N],
    left: u64,
}

fn refine<const N: usize>(
    a: f64,
    b: f64,
    whole: [f64; N],
    sums: &mut Sums<N>,
    f: &mut impl FnMut(f64) -> Sample<N>,
    depth: u32,
) {
    let middle = 0.5 * (a + b);
    let (left, right) = (panel(a, middle, f), panel(middle, b, f));
    sums.left = sums.left.saturating_sub(2);
    let mut settled = true;
    for (i, (scale, whole)) in sums.scale.iter_mut().zip(whole).enumerate() {
        *scale = scale.max(left.size[i] + right.size[i]);
        settled &= (left.value[i] + right.value[i] - whole).abs() <= 1e-14 * *scale;
    }
    if settled || depth == 0 || sums.left == 0 {
        for (total, (left, right)) in sums.total.iter_mut().zip(left.value.iter().zip(right.value)) {
            *total += left + right;
        }
        sums.along += left.along + right.along;
        return;
    }
    refine(a, middle, left.value, sums, f, depth - 1);
    refine(middle, b, right.value, sums, f, depth - 1);
}

/// One panel: the integrals, and those of the sizes.
fn panel<const N: usize>(a: f64, b: f64, f: &mut impl FnMut(f64) -> Sample<N>) -> Sample<N> {
    let mut sum = Sample { value: [0.0; N], size: [0.0; N], along: 0.0 };
    let half = 0.5 * (b - a);
    for (x, weight) in GAUSS {
        let at = f(0.5 * (a + b) + half * x);
        for i in 0..N {
            sum.value[i] += half * weight * at.value[i];
            sum.size[i] += half * weight * at.size[i];
        }
        sum.along += half * weight * at.along;
    }
    sum
}
