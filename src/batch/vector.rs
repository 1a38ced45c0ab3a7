//! Vectors with one number per lane: the arithmetic of the engine.
//!
//! Every operation acts on each lane by itself, so what a lane computes does not depend on its
//! neighbours. Products and sums are fused only where [`Vector::fma`] says so; there, a machine
//! without such an instruction rounds twice (plain lanes), one with it once.

use crate::linear::lane_operators;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// One number per lane.
///
/// Code that uses it must not contain closures: a closure is compiled separately, without the
/// instructions that the engine is compiled for, and every product in it would become a function
/// call.
#[derive(Clone, Copy)]
pub(super) struct Vector<S: Simd> {
    simd: S,
    x: S::f64s,
}

/// One boolean per lane.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    m: S::m64s,
}

impl<S: Simd> Vector<S> {
    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Self {
        Self { simd, x: simd.splat_f64s(value) }
    }

    /// The same number in every lane of a vector like this one.
    #[inline(always)]
    pub fn all(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// self · b + c.
    #[inline(always)]
    pub fn fma(self, b: Self, c: Self) -> Self {
        Self { x: self.simd.mul_add_e_f64s(self.x, b.x, c.x), ..self }
    }

    /// c − self · b.
    #[inline(always)]
    pub fn taken_from(self, b: Self, c: Self) -> Self {
        Self { x: self.simd.negate_mul_add_e_f64s(self.x, b.x, c.x), ..self }
    }

    #[inline(always)]
    pub fn min(self, b: Self) -> Self {
        Self { x: self.simd.min_f64s(self.x, b.x), ..self }
    }

    #[inline(always)]
    pub fn max(self, b: Self) -> Self {
        Self { x: self.simd.max_f64s(self.x, b.x), ..self }
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Self { x: self.simd.abs_f64s(self.x), ..self }
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self { x: self.simd.sqrt_f64s(self.x), ..self }
    }

    #[inline(always)]
    pub fn lt(self, b: Self) -> Mask<S> {
        Mask { simd: self.simd, m: self.simd.less_than_f64s(self.x, b.x) }
    }

    #[inline(always)]
    pub fn le(self, b: Self) -> Mask<S> {
        Mask { simd: self.simd, m: self.simd.less_than_or_equal_f64s(self.x, b.x) }
    }

    #[inline(always)]
    pub fn gt(self, b: Self) -> Mask<S> {
        Mask { simd: self.simd, m: self.simd.greater_than_f64s(self.x, b.x) }
    }

    #[inline(always)]
    pub fn ge(self, b: Self) -> Mask<S> {
        Mask { simd: self.simd, m: self.simd.greater_than_or_equal_f64s(self.x, b.x) }
    }

    /// The number of one lane; 0 if there is no such lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> f64 {
        cast_slice::<S::f64s, f64>(std::slice::from_ref(&self.x)).get(lane).copied().unwrap_or(0.0)
    }

    /// Sets the number of one lane.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, value: f64) {
        if let Some(x) = cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut self.x)).get_mut(lane) {
            *x = value;
        }
    }
}

impl<S: Simd> Mask<S> {
    /// `a` in the lanes where this is true, `b` in the others.
    #[inline(always)]
    pub fn pick(self, a: Vector<S>, b: Vector<S>) -> Vector<S> {
        Vector { simd: self.simd, x: self.simd.select_f64s(self.m, a.x, b.x) }
    }

    /// True if it is true in any lane.
    #[inline(always)]
    pub fn any(self) -> bool {
        self.simd.first_true_m64s(self.m) < S::F64_LANES
    }

    /// True if it is true in every lane.
    #[inline(always)]
    pub fn every(self) -> bool {
        !(!self).any()
    }
}

lane_operators!(Vector: Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);

impl<S: Simd> Neg for Vector<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: self.simd.neg_f64s(self.x), ..self }
    }
}

impl<S: Simd> BitAnd for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, b: Self) -> Self {
        Self { m: self.simd.and_m64s(self.m, b.m), ..self }
    }
}

impl<S: Simd> BitOr for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, b: Self) -> Self {
        Self { m: self.simd.or_m64s(self.m, b.m), ..self }
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self { m: self.simd.not_m64s(self.m), ..self }
    }
}

/// Σ cₙ zⁿ of an even number of coefficients. Even and odd powers are summed separately, which
/// makes two short chains of dependent products from a long one.
#[inline(always)]
pub(super) fn polynomial<S: Simd>(c: &[Vector<S>], z: Vector<S>) -> Vector<S> {
    let square = z * z;
    let mut pairs = c.chunks_exact(2).rev();
    let Some(&[mut even, mut odd]) = pairs.next() else { return z.all(0.0) };
    for pair in pairs {
        if let &[a, b] = pair {
            (even, odd) = (even.fma(square, a), odd.fma(square, b));
        }
    }
    odd.fma(z, even)
}

/// The same with coefficients that are equal in all lanes.
#[inline(always)]
pub(super) fn series<S: Simd, const N: usize>(c: &[f64; N], z: Vector<S>) -> Vector<S> {
    let mut vectors = [z; N];
    for (vector, value) in vectors.iter_mut().zip(c) {
        *vector = z.all(*value);
    }
    polynomial(&vectors, z)
}
