//! Loops over the entries of vectors, in the form in which the compiler uses vector instructions
//! for them: no vector that is read may be the one that is written, and a maximum has to be taken
//! in independent lanes, which the compiler may not introduce by itself, since a maximum ignores
//! NaN.

/// Maxima that are taken side by side.
const LANES: usize = 4;

/// N vectors of which a loop takes the entries of one index together. Written out for each N: for
/// arrays in general the compiler neither keeps all pointers in registers nor leaves out the checks
/// of lengths, without which it would not use vector instructions.
pub(crate) trait Columns<T, const N: usize>: Copy {
    /// Their first `n` entries.
    fn cut(self, n: usize) -> Self;
    /// Those of index `i`.
    fn at(self, i: usize) -> [T; N];
}

macro_rules! columns {
    ($($n:literal: $($x:ident)+;)+) => { $(
        impl<T: Copy> Columns<T, $n> for [&[T]; $n] {
            #[inline(always)]
            fn cut(self, n: usize) -> Self {
                let [$($x),+] = self;
                [$(&$x[..n]),+]
            }

            #[inline(always)]
            fn at(self, i: usize) -> [T; $n] {
                let [$($x),+] = self;
                [$($x[i]),+]
            }
        }
    )+ };
}

columns! { 1: a; 2: a b; 3: a b c; 4: a b c d; 5: a b c d e; 6: a b c d e f; }

/// Sets every entry of `out` to what `of` makes of it and of the same entries of the `others`.
///
/// # Panics
/// If one of the `others` is shorter than `out`.
#[inline(always)]
pub(crate) fn update<'a, const N: usize>(out: &mut [f64], others: [&'a [f64]; N], of: impl Fn(f64, [f64; N]) -> f64)
where
    [&'a [f64]; N]: Columns<f64, N>,
{
    let n = out.len();
    let others = others.cut(n);
    for i in 0..n {
        out[i] = of(out[i], others.at(i));
    }
}

/// The largest of each of the numbers that `of` makes of the first `n` entries of the `vectors`,
/// and at least `so_far`. A NaN is ignored.
///
/// # Panics
/// If one of the `vectors` is shorter.
#[inline(always)]
pub(crate) fn largest<'a, const N: usize, const M: usize>(
    so_far: [f64; M],
    n: usize,
    vectors: [&'a [f64]; N],
    of: impl Fn([f64; N]) -> [f64; M],
) -> [f64; M]
where
    [&'a [f64]; N]: Columns<f64, N>,
    [&'a [[f64; LANES]]; N]: Columns<[f64; LANES], N>,
{
    let vectors = vectors.cut(n);
    let mut blocks: [&[[f64; LANES]]; N] = [&[]; N];
    for (blocks, x) in blocks.iter_mut().zip(vectors) {
        *blocks = x.as_chunks().0;
    }
    let blocks = blocks.cut(n / LANES);
    let mut lanes = [[f64::NEG_INFINITY; LANES]; M];
    for i in 0..n / LANES {
        let (block, mut found) = (blocks.at(i), [[0.0; LANES]; M]);
        for lane in 0..LANES {
            let mut entries = [0.0; N];
            for (entry, x) in entries.iter_mut().zip(&block) {
                *entry = x[lane];
            }
            for (found, value) in found.iter_mut().zip(of(entries)) {
                found[lane] = value;
            }
        }
        for (lanes, found) in lanes.iter_mut().zip(found) {
            for (largest, x) in lanes.iter_mut().zip(found) {
                *largest = running_max(*largest, x);
            }
        }
    }
    let mut all = so_far;
    for (largest, lanes) in all.iter_mut().zip(lanes) {
        for x in lanes {
            *largest = running_max(*largest, x);
        }
    }
    for i in n - n % LANES..n {
        for (largest, x) in all.iter_mut().zip(of(vectors.at(i))) {
            *largest = running_max(*largest, x);
        }
    }
    all
}

/// The larger of two numbers. A NaN is ignored, as by [`f64::max`], but in one instruction.
#[inline(always)]
pub(crate) fn running_max(so_far: f64, x: f64) -> f64 {
    if x > so_far { x } else { so_far }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_of_any_number_of_entries_is_found_wherever_it_stands_and_a_nan_is_none() {
        for n in 1..=2 * LANES + 3 {
            for at in 0..n {
                let mut x: Vec<f64> = (0..n + 2).map(|i| 0.1 * i as f64 - 9.0).collect();
                (x[at], x[n]) = (7.0, 100.0);
                let lower: Vec<f64> = x.iter().map(|x| -x).collect();
                let both = |[x, lower]: [f64; 2]| [x, 2.0 * lower];
                // Of the negatives the first is the largest, unless the 7 stands there.
                let first = if at > 0 { 18.0 } else { 2.0 * (9.0 - 0.1) };
                let found = largest([0.0, 1.0], n, [&x, &lower], both);
                assert_eq!(found, [7.0, if n == 1 { 1.0 } else { first }], "{n} {at}");
                assert_eq!(largest([8.0, 20.0], n, [&x, &lower], both), [8.0, 20.0]);
                x[at] = f64::NAN;
                assert_eq!(largest([0.5], n, [&x], |x| x), [0.5], "{n} {at}");
            }
        }
    }

    #[test]
    fn entries_are_set_from_their_old_values_and_those_of_the_others() {
        for n in 0..11 {
            let a: Vec<f64> = (0..n + 1).map(|i| i as f64).collect();
            let mut out = vec![0.5; n];
            update(&mut out, [&a, &a[1..]], |old, [a, next]| old + 10.0 * a + 100.0 * next);
            let expected: Vec<f64> = (0..n).map(|i| 0.5 + 110.0 * i as f64 + 100.0).collect();
            assert_eq!(out, expected);
        }
    }
}
