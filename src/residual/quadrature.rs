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

/// Instants at which an arc is looked at: inside it, never at its ends.
pub(super) fn nodes(start: f64, end: f64) -> impl Iterator<Item = f64> {
    GAUSS.iter().map(move |&(x, _)| 0.5 * (start + end) + 0.5 * (end - start) * x)
}

/// ∫ f dt over [start, end] for several integrands at once. A panel is halved until its two halves change no integral by
/// more than 1e-14 of the integral of the magnitudes so far: with the error of a tenth-order rule the halves are then far better.
pub(super) fn integrate<const N: usize>(start: f64, end: f64, f: &mut impl FnMut(f64) -> [f64; N]) -> [f64; N] {
    let whole = panel(start, end, f);
    let mut total = [0.0; N];
    let mut scale = whole.1;
    refine(start, end, whole.0, &mut scale, f, &mut total, DEPTH);
    total
}

fn refine<const N: usize>(
    a: f64,
    b: f64,
    whole: [f64; N],
    scale: &mut [f64; N],
    f: &mut impl FnMut(f64) -> [f64; N],
    total: &mut [f64; N],
    depth: u32,
) {
    let middle = 0.5 * (a + b);
    let (left, right) = (panel(a, middle, f), panel(middle, b, f));
    let mut settled = true;
    for i in 0..N {
        scale[i] = scale[i].max(left.1[i] + right.1[i]);
        settled &= (left.0[i] + right.0[i] - whole[i]).abs() <= 1e-14 * scale[i];
    }
    if settled || depth == 0 {
        for (total, (left, right)) in total.iter_mut().zip(left.0.iter().zip(right.0)) {
            *total += left + right;
        }
        return;
    }
    refine(a, middle, left.0, scale, f, total, depth - 1);
    refine(middle, b, right.0, scale, f, total, depth - 1);
}

/// One panel: the integrals, and those of the magnitudes.
fn panel<const N: usize>(a: f64, b: f64, f: &mut impl FnMut(f64) -> [f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sum, mut size) = ([0.0; N], [0.0; N]);
    let half = 0.5 * (b - a);
    for (x, weight) in GAUSS {
        let values = f(0.5 * (a + b) + half * x);
        for i in 0..N {
            sum[i] += half * weight * values[i];
            size[i] += half * weight * values[i].abs();
        }
    }
    (sum, size)
}
