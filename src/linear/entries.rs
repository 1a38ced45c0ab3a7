//! Loops over the entries of vectors, in the form in which the compiler uses vector instructions
//! for them, since no vector that is read may be the one that is written; and passes, which use
//! them by name: a pass writes several vectors, and takes maxima, which the compiler may not
//! reorder by itself, since a maximum ignores NaN.

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

/// The same of vectors that are written.
pub(crate) trait ColumnsMut<T, const N: usize>: Sized {
    /// Their first `n` entries.
    fn cut(self, n: usize) -> Self;
    /// Those of index `i`.
    fn at(&self, i: usize) -> [T; N];
    /// Sets those of index `i`.
    fn put(&mut self, i: usize, values: [T; N]);
}

macro_rules! columns {
    ($($n:literal: $($x:ident $y:ident)*;)+) => { $(
        impl<T: Copy> Columns<T, $n> for [&[T]; $n] {
            #[inline(always)]
            fn cut(self, n: usize) -> Self {
                let [$($x),*] = self;
                [$(&$x[..n]),*]
            }

            #[inline(always)]
            fn at(self, i: usize) -> [T; $n] {
                let [$($x),*] = self;
                [$($x[i]),*]
            }
        }

        impl<T: Copy> ColumnsMut<T, $n> for [&mut [T]; $n] {
            #[inline(always)]
            fn cut(self, n: usize) -> Self {
                let [$($x),*] = self;
                [$(&mut $x[..n]),*]
            }

            #[inline(always)]
            fn at(&self, i: usize) -> [T; $n] {
                let [$($x),*] = self;
                [$($x[i]),*]
            }

            #[inline(always)]
            fn put(&mut self, i: usize, values: [T; $n]) {
                let ([$($x),*], [$($y),*]) = (self, values);
                $($x[i] = $y;)*
            }
        }
    )+ };
}

#[allow(unused_variables, reason = "of no vectors")]
mod of_some_vectors {
    use super::{Columns, ColumnsMut};

    columns! {
        0:; 1: a u; 2: a u b v; 3: a u b v c w; 4: a u b v c w d x; 5: a u b v c w d x e y;
        6: a u b v c w d x e y f z; 8: a u b v c w d x e y f z g s h t;
        10: a u b v c w d x e y f z g s h t k m l o;
    }
}

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
        // All bits but the sign. Not by `abs_f64s`, which calls functions that need not be inlined.
        let (simd, mask) = (self.simd, self.simd.splat_u64s(u64::MAX >> 1));
        Self { x: simd.transmute_f64s_u64s(simd.and_u64s(mask, simd.transmute_u64s_f64s(self.x))), ..self }
    }

    /// The largest of the lanes, and at least `so_far`. A NaN is ignored.
    #[inline(always)]
    pub fn largest(self, so_far: f64) -> f64 {
        running_max(so_far, self.simd.reduce_max_f64s(self.x))
    }

    /// The sum of the lanes, in any order.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        self.simd.reduce_sum_f64s(self.x)
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

/// The operators of a type of lanes, in which `simd` holds the instructions and `x` the numbers.
macro_rules! lane_operators {
    ($type:ident: $($name:ident $function:ident $simd:ident),*) => {$(
        impl<S: Simd> $name for $type<S> {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self { x: self.simd.$simd(self.x, other.x), ..self }
            }
        }
    )*};
}

pub(crate) use lane_operators;

lane_operators!(Lanes: Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s);

impl<S: Simd> Mul<f64> for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * self.all(other)
    }
}

/// What a pass over vectors makes of the entries of one index: of N numbers that are read, the K
/// that stand where it writes, and M sums or maxima so far, the K that it writes and the M with
/// this index. Zeros change no sum or maximum. No closure, which would be compiled by itself,
/// without the instructions that `S` stands for.
pub(crate) trait Pass<const N: usize, const K: usize, const M: usize> {
    fn of<S: Simd>(
        &self,
        read: [Lanes<S>; N],
        written: [Lanes<S>; K],
        so_far: [Lanes<S>; M],
    ) -> ([Lanes<S>; K], [Lanes<S>; M]);
}

/// Passes over the first `n` entries of the vectors with the instructions `simd`. Returns the sums
/// or maxima from 0 on, of each lane.
///
/// # Panics
/// If one of the vectors is shorter.
#[inline(always)]
pub(crate) fn pass<'a, S: Simd, const N: usize, const K: usize, const M: usize>(
    simd: S,
    n: usize,
    (read, written): ([&'a [f64]; N], [&'a mut [f64]; K]),
    what: &impl Pass<N, K, M>,
) -> [Lanes<S>; M]
where
    [&'a [f64]; N]: Columns<f64, N>,
    [&'a [S::f64s]; N]: Columns<S::f64s, N>,
    [&'a mut [f64]; K]: ColumnsMut<f64, K>,
    [&'a mut [S::f64s]; K]: ColumnsMut<S::f64s, K>,
{
    let (read, written) = (read.cut(n), written.cut(n));
    let (mut blocks, mut rests): ([&[S::f64s]; N], _) = ([&[]; N], read);
    for ((blocks, rest), x) in blocks.iter_mut().zip(&mut rests).zip(read) {
        (*blocks, *rest) = S::as_simd_f64s(x);
    }
    let mut out: [&mut [S::f64s]; K] = std::array::from_fn(|_| Default::default());
    let mut out_rests: [&mut [f64]; K] = std::array::from_fn(|_| Default::default());
    for ((blocks, rest), x) in out.iter_mut().zip(&mut out_rests).zip(written) {
        (*blocks, *rest) = S::as_mut_simd_f64s(x);
    }
    let (count, left) = (n / S::F64_LANES, n % S::F64_LANES);
    let (blocks, mut out) = (blocks.cut(count), out.cut(count));
    let zero = Lanes { simd, x: simd.splat_f64s(0.0) };
    let mut folded = [zero; M];
    for i in 0..count {
        let (mut x, mut old, mut values) = ([zero; N], [zero; K], out.at(i));
        for (x, block) in x.iter_mut().zip(blocks.at(i)) {
            x.x = block;
        }
        for (x, block) in old.iter_mut().zip(values) {
            x.x = block;
        }
        let (new, more) = what.of(x, old, folded);
        folded = more;
        for (value, new) in values.iter_mut().zip(new) {
            *value = new.x;
        }
        out.put(i, values);
    }
    if left > 0 {
        let (mut x, mut old) = ([zero; N], [zero; K]);
        for (x, rest) in x.iter_mut().zip(rests) {
            x.x = simd.partial_load_f64s(rest);
        }
        for (x, rest) in old.iter_mut().zip(&out_rests) {
            x.x = simd.partial_load_f64s(rest);
        }
        let (new, more) = what.of(x, old, folded);
        folded = more;
        for (rest, new) in out_rests.into_iter().zip(new) {
            simd.partial_store_f64s(rest, new.x);
        }
    }
    folded
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

    /// Two maxima and a sum of two vectors, and both vectors changed by them.
    struct All;

    impl Pass<2, 2, 3> for All {
        #[inline(always)]
        fn of<S: Simd>(
            &self,
            [x, other]: [Lanes<S>; 2],
            [a, b]: [Lanes<S>; 2],
            [most, both, sum]: [Lanes<S>; 3],
        ) -> ([Lanes<S>; 2], [Lanes<S>; 3]) {
            let size = (x - other * 2.0).abs() + x.max(other) * x;
            ([a + x, b * 10.0 - other], [most.max(x.abs()), both.max(size), sum + x * other])
        }
    }

    struct Passed<'a>(f64, usize, &'a [f64], [&'a mut [f64]; 2]);

    impl WithSimd for Passed<'_> {
        type Output = [f64; 3];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [f64; 3] {
            let [most, both, sum] = pass(simd, self.1, ([self.2, &self.2[1..]], self.3), &All);
            [most.largest(self.0), both.largest(self.0), sum.sum()]
        }
    }

    #[test]
    fn a_pass_over_any_number_of_entries_finds_the_largest_wherever_it_stands_and_a_nan_is_none() {
        let passed = |arch: bool, so_far: f64, n: usize, x: &[f64]| {
            let (mut a, mut b) = (vec![0.5; n + 1], vec![0.25; n + 1]);
            let all = Passed(so_far, n, x, [&mut a, &mut b]);
            (if arch { pulp::Arch::new().dispatch(all) } else { all.with_simd(Scalar) }, a, b)
        };
        for n in 1..20 {
            for at in 0..n {
                // Multiples of 1/8: no product is rounded.
                let mut x: Vec<f64> = (0..n + 3).map(|i| 0.125 * (i % 7) as f64 - 0.375).collect();
                (x[at], x[n + 1]) = (-7.0, 100.0);
                let both = |i: usize| (x[i] - 2.0 * x[i + 1]).abs() + x[i].max(x[i + 1]) * x[i];
                let sum = (0..n).map(|i| x[i] * x[i + 1]).sum::<f64>();
                let expected = [7.0, (0..n).map(both).fold(0.0, f64::max), sum];
                for (found, a, b) in [passed(true, 0.0, n, &x), passed(false, 0.0, n, &x)] {
                    assert_eq!(found, expected, "{n} {at}");
                    assert!((0..n).all(|i| a[i] == 0.5 + x[i] && b[i] == 2.5 - x[i + 1]), "{n} {at}");
                    assert_eq!((a[n], b[n]), (0.5, 0.25));
                }
                let most = [expected[0].max(1e3), expected[1].max(1e3), sum];
                assert_eq!(passed(true, 1e3, n, &x).0, most);
                x[at] = f64::NAN;
                let left = (0..n).map(|i| x[i].abs()).fold(0.25, f64::max);
                assert_eq!(passed(true, 0.25, n, &x).0[0], left, "{n} {at}");
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
