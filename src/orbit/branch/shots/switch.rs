//! From a special point of a branch of a structure's orbits to the branch that begins there.

use super::Shots;
use super::follow::follow;
use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{Vector, beside, bordered, extended, no_eigenvector, null, tangent};
use crate::orbit::branch::label::Label;
use crate::orbit::branch::line::{Begin, Followed, Line, Metric, Passed};
use crate::orbit::branch::point::Point;
use crate::orbit::periodic::Orbit;
use crate::orbit::signature::Signature;
use crate::order::sort_by_number;
use nalgebra::DMatrix;

/// Orbits that differ by less than this are the same: where a branch of twice the period meets that
/// of the single one, Newton's method on the longer map finds it to half of the digits only.
const SAME: f64 = 1e-4;

impl Followed for Shots<'_> {
    fn tangent_at(&self, y: &Vector, along: &Vector) -> Result<Vector> {
        tangent(&self.linear(y, &mut None)?.matrix, along)
    }

    fn follow(
        &self,
        y: Vector,
        along: &Vector,
        range: [f64; 2],
        most: usize,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<Line<Self>> {
        follow(self, y, along, range, most, seen)
    }

    fn switch(&self, at: &Passed<Self>) -> Result<Begin<Self>> {
        let whole = Self { symmetric: false, ..self.anew() };
        match at.label {
            // A branch of orbits over several periods has met the orbit of one of them: the branch
            // of the latter goes on to both sides.
            Label::PeriodDoubling if at.point.orbit.part(None).is_some() => {
                let part = at.point.orbit.part(None).map_or(self.periods, |(once, _)| once.signature.periods);
                Self { periods: part, ..whole }.through(&at.y, None)
            }
            Label::SymmetryBreaking if !self.symmetric => Self { symmetric: true, ..whole }.through(&at.y, None),
            Label::PeriodDoubling => self.aside(at, Self { periods: 2 * self.periods, ..whole }),
            Label::SymmetryBreaking => self.aside(at, whole),
            Label::BranchPoint => self.across(at),
            Label::NeimarkSacker => Err(Error::no_orbit("what begins there is not periodic")),
            Label::Fold => Err(Error::no_orbit("the branch itself goes on beyond")),
            _ => Err(Error::no_orbit(format!("no orbit was found beyond the {}", at.label))),
        }
    }

    fn orbit_at(&self, y: &Vector) -> Result<(Orbit, Metric)> {
        let linear = self.linear(y, &mut None)?;
        let point = self.point(y, linear.posed.period, &linear.motion, super::step_start::multipliers_of(&linear));
        Ok((point.orbit, Metric { mirror: self.mirror.clone(), speed: self.scales.speed, near: SAME }))
    }
}

impl Shots<'_> {
    /// The branch `begin`, or where its orbits repeat shorter ones, as those over several periods
    /// may beyond a graze, that of these.
    pub(super) fn shortest(begin: Begin<Self>) -> Result<Begin<Self>> {
        let (orbit, metric) = begin.curve.orbit_at(&begin.y)?;
        let Some((once, _)) = orbit.part(metric.mirror.as_deref()) else { return Ok(begin) };
        let Signature { periods, symmetric, .. } = once.signature;
        let Begin { curve, y, along, both } = begin;
        Self { periods, symmetric, ..curve }.through(&y, Some(&along).filter(|_| !both))
    }

    /// This branch through the orbit at the point `y` of a longer one, to both sides or in the
    /// direction of `along`.
    fn through(self, y: &Vector, along: Option<&Vector>) -> Result<Begin<Self>> {
        let key = super::unit(y.len(), y.len() - 1);
        let (y, linear, _) = self.correct(y, &key, None)?;
        let both = along.is_none();
        let along = tangent(&linear.matrix, along.unwrap_or(&key))?;
        Ok(Begin { curve: self, y, along, both })
    }

    /// The branch that leaves along the eigenvector of a multiplier −1, at a small amplitude, on
    /// `curve`.
    fn aside(&self, at: &Passed<Self>, curve: Self) -> Result<Begin<Self>> {
        let n = at.y.len() - 1;
        let linear = self.linear(&at.y, &mut None)?;
        let twisted = linear.matrix.columns(0, n) + DMatrix::identity(n, n) * 2.0;
        let aside = extended(&null(twisted)?, 0.0);
        off(curve, &at.y, &aside)
    }

    /// The branch that leaves along the second direction in which the equations are singular.
    fn across(&self, at: &Passed<Self>) -> Result<Begin<Self>> {
        let n = at.y.len() - 1;
        let linear = self.linear(&at.y, &mut None)?;
        // Without the key's part, the branch itself is left out where it goes along the key.
        let aside = null(bordered(&linear.matrix, &self.own_tangent(&linear.matrix, n)?))?;
        off(self.anew(), &at.y, &aside)
    }

    /// The direction of the branch at a point where another one crosses: of the two in which the
    /// equations are singular the one with the largest part along the key.
    fn own_tangent(&self, matrix: &DMatrix<f64>, n: usize) -> Result<Vector> {
        let square = DMatrix::from_fn(n + 1, n + 1, |i, j| if i < n { matrix[(i, j)] } else { 0.0 });
        let svd = square.svd(false, true);
        let v = svd.v_t.ok_or_else(no_eigenvector)?;
        let mut order: Vec<usize> = (0..=n).collect();
        sort_by_number(&mut order, |&a| svd.singular_values[a]);
        let [first, second] = [order.first(), order.get(1)].map(|k| k.map(|&k| v.row(k).transpose()));
        let (first, second) = first.zip(second).ok_or_else(no_eigenvector)?;
        let own = &first * first[n] + &second * second[n];
        if own.norm() > 0.0 { Ok(own.normalize()) } else { Err(no_eigenvector()) }
    }
}

/// The branch of `curve` that leaves `origin` along `aside`, at a small amplitude.
fn off<'a>(curve: Shots<'a>, origin: &Vector, aside: &Vector) -> Result<Begin<Shots<'a>>> {
    let (y, along) = beside(origin, aside, |guess| Ok(curve.correct(guess, aside, None)?.0))?;
    Ok(Begin { curve, y, along, both: false })
}
