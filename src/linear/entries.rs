//! Loops over the entries of vectors, in the form in which the compiler uses vector instructions
//! for them, since no vector that is read may be the one that is written; and maxima, which take
//! them by name: the compiler may not reorder them by itself, since a maximum ignores NaN.

use pulp::Simd;
use std::ops::{Add, Mul, Sub};

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
#[allow(clippy::needless_range_loop, reason = "so the compiler knows that no index is out of bounds")]
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

/// As many numbers as vector instructions take at a time.
#[derive(Clone, Copy)]
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    x: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// The same number in all lanes of such a vector.
    #[inline(always)]
    fn all(self, x: f64) -> Self {
        Self { x: self.simd.splat_f64s(x), ..self }
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { x: self.simd.abs_f64s(self.x), ..self }
    }

    /// As [`running_max`] in each lane.
    #[inline(always)]
    pub fn max(self, x: Self) -> Self {
        // The instruction of x86 returns its second operand where one of them is no number.
        if cfg!(target_arch = "x86_64") {
            return Self { x: self.simd.max_f64s(x.x, self.x), ..self };
        }
        let greater = self.simd.greater_than_f64s(x.x, self.x);
        Self { x: self.simd.select_f64s(greater, x.x, self.x), ..self }
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.simd.add_f64s(self.x, other.x), ..self }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.simd.sub_f64s(self.x, other.x), ..self }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { x: self.simd.mul_f64s(self.x, other.x), ..self }
    }
}

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * self.all(other)
    }
}

/// M sizes that follow from N numbers: 0 from zeros. No closure, which would be compiled by itself,
/// without the instructions that `S` stands for.
pub(crate) trait Sizes<const N: usize, const M: usize> {
    fn of<S: Simd>(&self, x: [Lanes<S>; N]) -> [Lanes<S>; M];
}

/// The largest of each of the `sizes` of the first `n` entries of the `vectors`, and at least
/// `so_far`, 0 or more. A NaN is ignored. `simd` are the instructions to be used.
///
/// # Panics
/// If one of the `vectors` is shorter.
#[inline(always)]
pub(crate) fn largest<'a, S: Simd, const N: usize, const M: usize>(
    simd: S,
    so_far: [f64; M],
    n: usize,
    vectors: [&'a [f64]; N],
    sizes: &impl Sizes<N, M>,
) -> [f64; M]
where
    [&'a [f64]; N]: Columns<f64, N>,
    [&'a [S::f64s]; N]: Columns<S::f64s, N>,
{
    let vectors = vectors.cut(n);
    let (mut blocks, mut rests): ([&[S::f64s]; N], _) = ([&[]; N], vectors);
    for ((blocks, rest), x) in blocks.iter_mut().zip(&mut rests).zip(vectors) {
        (*blocks, *rest) = S::as_simd_f64s(x);
    }
    let (count, left) = blocks.first().zip(rests.first()).map_or((0, 0), |(block, rest)| (block.len(), rest.len()));
    let blocks = blocks.cut(count);
    let zero = Lanes { simd, x: simd.splat_f64s(0.0) };
    let mut lanes = [zero; M];
    for i in 0..count {
        let mut x = [zero; N];
        for (x, block) in x.iter_mut().zip(blocks.at(i)) {
            x.x = block;
        }
        for (largest, size) in lanes.iter_mut().zip(sizes.of(x)) {
            *largest = largest.max(size);
        }
    }
    if left > 0 {
        let mut x = [zero; N];
        for (x, rest) in x.iter_mut().zip(rests) {
            x.x = simd.partial_load_f64s(rest);
        }
        for (largest, size) in lanes.iter_mut().zip(sizes.of(x)) {
            *largest = largest.max(size);
        }
    }
    let mut all = so_far;
    for (largest, lanes) in all.iter_mut().zip(lanes) {
        *largest = running_max(*largest, simd.reduce_max_f64s(lanes.x));
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
    use pulp::{Scalar, WithSimd};

    struct Both;

    impl Sizes<2, 2> for Both {
        #[inline(always)]
        fn of<S: Simd>(&self, [x, other]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
            [x.abs(), (x - other * 2.0).abs() + x.max(other) * x]
        }
    }

    struct Largest<'a>(f64, usize, &'a [f64]);

    impl WithSimd for Largest<'_> {
        type Output = [f64; 2];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [f64; 2] {
            largest(simd, [self.0; 2], self.1, [self.2, &self.2[1..]], &Both)
        }
    }

    #[test]
    fn the_largest_of_any_number_of_entries_is_found_wherever_it_stands_and_a_nan_is_none() {
        for n in 1..20 {
            for at in 0..n {
                // Multiples of 1/8: no product is rounded.
                let mut x: Vec<f64> = (0..n + 3).map(|i| 0.125 * (i % 7) as f64 - 0.375).collect();
                (x[at], x[n + 1]) = (-7.0, 100.0);
                let both = |i: usize| (x[i] - 2.0 * x[i + 1]).abs() + x[i].max(x[i + 1]) * x[i];
                let expected = [7.0, (0..n).map(both).fold(0.0, f64::max)];
                for found in [pulp::Arch::new().dispatch(Largest(0.0, n, &x)), Largest(0.0, n, &x).with_simd(Scalar)] {
                    assert_eq!(found, expected, "{n} {at}");
                }
                let most = [expected[0].max(1e3), expected[1].max(1e3)];
                assert_eq!(pulp::Arch::new().dispatch(Largest(1e3, n, &x)), most);
                x[at] = f64::NAN;
                let left = (0..n).map(|i| x[i].abs()).fold(0.25, f64::max);
                assert_eq!(pulp::Arch::new().dispatch(Largest(0.25, n, &x))[0], left, "{n} {at}");
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
