//! Lyapunov exponents.

use super::no_derivative::NoDerivative;
use super::product::Variation;
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::step::Step;
use std::f64::consts::TAU;

/// Number of blocks into which the window is divided for the standard error.
const BLOCKS: usize = 40;

/// A change that becomes smaller than this share of itself, when it is made orthogonal to others,
/// is rounding error.
const NOTHING: f64 = 1e-14;

/// A Lyapunov exponent over a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponent {
    /// Mean growth of a change of the start, 1/s: ln|δ(end)|/|δ(begin)| over the length. −∞ where
    /// the change becomes 0.
    pub per_s: f64,
    /// Standard error of that mean, 1/s, from blocks of the window: s/√40 with s the standard
    /// deviation of their means. `None` for a window with steps in fewer than two blocks, and for
    /// −∞, which is exact.
    pub error_per_s: Option<f64>,
}

/// The largest Lyapunov exponents of a run of the scheme `event`, over a window [from, to].
///
/// As many changes of the start as exponents are asked for are propagated along the run
/// ([`Variation`]). After each step they are made orthogonal and scaled to size 1 (Benettin et al.
/// 1980, doi:10.1007/BF02128236); the mean of the logarithms of the factors are the exponents, the
/// largest first. Before the window the changes turn into the directions that grow most; one that a
/// rest there has made 0 begins anew with the window. The size
/// is √(|δq|² + |δq̇/ω|²) with ω the fastest circular frequency of structure and loads; for a long
/// window the exponents do not depend on this definition.
///
/// For one degree of freedom with rigid walls flows shrink areas by exp(−c t/m), and impacts by e².
/// So the two exponents add up to −c/m + 2 Σ ν ln e, with ν the impacts per second on each wall. A
/// run that rests on a wall in the window no longer depends on its state at the window's start, and
/// has the exponent −∞. On a periodic
/// motion the running mean oscillates about ln|μ|/T, with μ a Floquet multiplier and T the period,
/// and the amplitude decreases like 1/t.
#[derive(Debug)]
pub struct Exponents {
    variation: Variation,
    /// The changes, orthogonal and of size 1: δq and δq̇/ω.
    changes: Vec<f64>,
    /// The number of exponents.
    count: usize,
    omega: f64,
    window: [f64; 2],
    /// True once a step has reached into the window.
    begun: bool,
    blocks: Vec<Block>,
    /// Factors of the last step.
    factors: Vec<f64>,
}

/// Sums over one block of the window.
#[derive(Debug, Clone)]
struct Block {
    /// s.
    length: f64,
    /// Sum of the logarithms of each change.
    logs: Vec<f64>,
}

impl Exponents {
    /// The `count` largest exponents of runs of `scene`, from the time `from` (s) to `to` (s).
    ///
    /// # Errors
    /// As [`Scene::validate`]; [`Error::Invalid`] for no exponents, more than 2n of them, or a
    /// window without length.
    pub fn new(scene: &Scene, count: usize, [from, to]: [f64; 2]) -> Result<Self> {
        let variation = Variation::new(scene)?;
        let size = 2 * variation.degrees_of_freedom();
        if count == 0 || count > size {
            return Err(Error::invalid("exponents", count, format!("from 1 to {size}, two per degree of freedom")));
        }
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(Error::invalid("window", format_args!("from {from:?} to {to:?}"), "two times, s, in order"));
        }
        let fastest = scene.harmonic_frequencies().map(|frequency| TAU * frequency);
        let own = scene.system.frequencies()[1];
        let omega = Some(fastest.fold(own, f64::max)).filter(|omega| *omega > 0.0).unwrap_or(1.0 / (to - from));
        let mut changes: Vec<f64> = (0..size * count).map(direction).collect();
        let mut factors = vec![1.0; count];
        orthogonalise(&mut changes, size, &mut factors);
        Ok(Self {
            variation,
            changes,
            count,
            omega,
            window: [from, to],
            begun: false,
            blocks: vec![Block { length: 0.0, logs: vec![0.0; count] }; BLOCKS],
            factors,
        })
    }

    /// Propagates the changes over `step`. Steps before the window only turn the changes; those
    /// after it are left out. A step of the exact scheme may be longer than the window: one that
    /// reaches into it counts with the part inside, over which its changes are taken to grow
    /// evenly.
    ///
    /// # Errors
    /// [`NoDerivative`]; the exponents are meaningless from then on.
    pub fn observe(&mut self, step: &Step<'_>) -> std::result::Result<(), NoDerivative> {
        let [from, to] = self.window;
        if step.start >= to {
            return Ok(());
        }
        let (size, omega) = (2 * self.variation.degrees_of_freedom(), self.omega);
        let inside = step.end.min(to) - step.start.max(from);
        if inside > 0.0 && !self.begun {
            self.begun = true;
            self.renew(size);
        }
        let scale = |changes: &mut [f64], by: f64| {
            for change in changes.chunks_exact_mut(size) {
                change[size / 2..].iter_mut().for_each(|v| *v *= by);
            }
        };
        scale(&mut self.changes, omega);
        self.variation.propagate(step, &mut self.changes)?;
        scale(&mut self.changes, 1.0 / omega);
        orthogonalise(&mut self.changes, size, &mut self.factors);
        if inside > 0.0 {
            let share = (step.start.max(from) - from) / (to - from);
            let part = inside / (step.end - step.start);
            let block = ((share * BLOCKS as f64) as usize).min(BLOCKS - 1);
            if let Some(block) = self.blocks.get_mut(block) {
                block.length += inside;
                block.logs.iter_mut().zip(&self.factors).for_each(|(sum, factor)| *sum += part * factor.ln());
            }
        }
        Ok(())
    }

    /// Begins anew the changes that a rest before the window has made 0: the exponents are those of
    /// the window.
    fn renew(&mut self, size: usize) {
        let mut any = false;
        for (k, change) in self.changes.chunks_exact_mut(size).enumerate() {
            if change.iter().all(|x| *x == 0.0) {
                change.iter_mut().enumerate().for_each(|(i, x)| *x = direction(k * size + i));
                any = true;
            }
        }
        if any {
            orthogonalise(&mut self.changes, size, &mut self.factors);
        }
    }

    /// The largest exponent.
    #[must_use]
    pub fn largest(&self) -> Exponent {
        self.exponent(0)
    }

    /// All exponents asked for, the largest first.
    #[must_use]
    pub fn all(&self) -> Vec<Exponent> {
        (0..self.count).map(|which| self.exponent(which)).collect()
    }

    fn exponent(&self, which: usize) -> Exponent {
        let log = |block: &Block| block.logs.get(which).copied().unwrap_or(0.0);
        let (sum, length) = self.blocks.iter().fold((0.0, 0.0), |(s, l), b| (s + log(b), l + b.length));
        let per_s = if sum == f64::NEG_INFINITY { sum } else { sum / length };
        let seen: Vec<&Block> = self.blocks.iter().filter(|block| block.length > 0.0).collect();
        let error = |count: f64| {
            // Blocks are of nearly equal length: their ends are ends of steps.
            let square = |block: &&Block| (block.length / length * count * (log(block) / block.length - per_s)).powi(2);
            (seen.iter().map(square).sum::<f64>() / (count - 1.0) / count).sqrt()
        };
        Exponent { per_s, error_per_s: (seen.len() > 1 && per_s.is_finite()).then(|| error(seen.len() as f64)) }
    }
}

/// Entry `i` of all changes one after the other, at the start: linearly independent directions with
/// a component along every entry of the state.
pub(super) fn direction(i: usize) -> f64 {
    (1.0 + 0.618_033_988_75 * i as f64).fract() - 0.3
}

/// Makes changes of `size` entries each orthogonal to those before them, and scales them to 1 by
/// `factors`: the diagonal of R in a QR decomposition. A change of which only rounding is left is
/// set to 0, and stays 0.
fn orthogonalise(changes: &mut [f64], size: usize, factors: &mut [f64]) {
    for (k, factor) in factors.iter_mut().enumerate() {
        let (before, rest) = changes.split_at_mut(k * size);
        let change = &mut rest[..size];
        let norm = |change: &[f64]| change.iter().map(|x| x * x).sum::<f64>().sqrt();
        let least = NOTHING * norm(change);
        // Two passes, since the first leaves rounding errors of the components that it removes.
        for _ in 0..2 {
            for other in before.chunks_exact(size) {
                let along: f64 = other.iter().zip(&*change).map(|(a, b)| a * b).sum();
                change.iter_mut().zip(other).for_each(|(c, o)| *c -= along * o);
            }
        }
        let left = norm(change);
        if left > least {
            change.iter_mut().for_each(|x| *x /= left);
            *factor = left;
        } else {
            change.fill(0.0);
            *factor = 0.0;
        }
    }
}
