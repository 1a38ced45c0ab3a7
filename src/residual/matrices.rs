//! M, C and K prepared for products: numbers for one degree of freedom, else bands or sparse rows.

use crate::linear::Operator;
use crate::scene::System;
use std::sync::Arc;

/// One of the three matrices.
#[derive(Debug, Clone, Copy)]
pub(super) enum Part {
    Mass = 0,
    Damping = 1,
    Stiffness = 2,
}

/// M, C and K.
#[derive(Debug, Clone)]
pub(super) enum Matrices {
    One([f64; 3]),
    Many(Arc<[Operator; 3]>),
}

impl Matrices {
    pub fn new(system: &System) -> Self {
        match system {
            System::Oscillator(o) => Self::One([o.mass, o.damping, o.stiffness]),
            System::Structure(s) => Self::Many(s.operators()),
        }
    }

    /// Writes `scale` times the product with `x` to `out`, n entries each; of one degree of
    /// freedom, any number of products with the entries of `x`.
    #[inline(always)]
    pub fn product(&self, part: Part, scale: f64, x: &[f64], out: &mut [f64]) {
        match self {
            Self::One(numbers) => {
                let number = scale * numbers[part as usize];
                out.iter_mut().zip(x).for_each(|(out, x)| *out = number * x);
            }
            Self::Many(operators) => {
                operators[part as usize].product(scale, x, out);
            }
        }
    }

    /// xᵀA x.
    #[inline(always)]
    pub fn form(&self, part: Part, x: &[f64]) -> f64 {
        match self {
            Self::One(numbers) => numbers[part as usize] * x.iter().map(|x| x * x).sum::<f64>(),
            Self::Many(operators) => operators[part as usize].form(x),
        }
    }
}
