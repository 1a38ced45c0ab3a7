//! Branches of orbits of structures: the state once an orbit and a key's value as unknowns.
//!
//! P takes the state x at the strobe, an instant of the forcing period given in cycles at which
//! nothing happens, to that one orbit later, by the exact scheme; a branch is the curve of the
//! solutions of P(x; λ) = x. P is smooth as long as the orbit meets the same walls in the same
//! order, so that a branch has one signature. Where an impact begins or ends with a graze, P has a
//! square root (Nordmark 1991, doi:10.1016/0022-460X(91)90592-8): the branch is followed to it from
//! the one side and leaves it to the other by equations that are regular there (`graze.rs`). A
//! symmetric orbit is followed by its half map −P½, as with one degree of freedom.

mod change;
mod correct;
mod follow;
mod graze;
mod moved;
mod step_start;
mod switch;

use crate::error::{Error, Result};
use crate::orbit::branch::arclength::{self, Vector, extended, unit};
use crate::orbit::branch::family::{self, DIFFERENCE, Family};
use crate::orbit::orbit_run::{self, ByKey, OrbitRun, Recorded};
use crate::orbit::shooting::{Shot, posed};
use crate::orbit::strobe::{Scales, vector};
use crate::orbit::symmetry;
use crate::scene::{Scene, forcing_period};
use crate::variation::SceneTangent;
use nalgebra::DMatrix;

/// Factors by which the distance of two scenes is reduced while their contacts differ.
const FINER: [f64; 3] = [1.0, 1e-2, 1e-4];

/// An orbit is symmetric if its second half differs by less than this share of the scales from the
/// mirror image of the first.
const MIRRORED: f64 = 1e-7;

/// The curve.
#[derive(Clone)]
pub(super) struct Shots<'a> {
    family: &'a Family<'a>,
    periods: u32,
    symmetric: bool,
    /// The scales of states; the same along a branch.
    scales: Scales,
    /// The scale of the key's value: the width of its range.
    width: f64,
    /// The instant of the states, in cycles from t = 0.
    strobe: f64,
    /// Which of the events after the strobe is the first of the branch's signature.
    first: usize,
    /// The wall opposite to each wall, where the scene is its own mirror image.
    mirror: Option<Vec<usize>>,
}

/// A scene of the family and the period of its loads, s.
struct Posed {
    scene: Scene,
    period: f64,
}

/// The linearised equations at a point.
struct Linear {
    posed: Posed,
    motion: OrbitRun,
    residual: Vector,
    /// 2n × (2n + 1): the derivatives with respect to the scaled state, and to the key.
    matrix: DMatrix<f64>,
}

impl<'a> Shots<'a> {
    /// The curve through `start` at the key's value `value`, and the point there; `beside` is
    /// another value, which shows whether the key keeps the mirror symmetry.
    pub fn begin(family: &'a Family<'a>, start: &Shot, value: f64, beside: f64, width: f64) -> Result<(Self, Vector)> {
        let scene = family(value)?;
        let period = posed(&scene)?;
        start.check(scene.system.degrees_of_freedom())?;
        let scales = Scales::new(scene.orbit_length(), period);
        let other = family(beside)?;
        let keeps = forcing_period(&other).is_ok_and(|period| symmetry::mirror(&other, period).is_some());
        let mirror = symmetry::mirror(&scene, period).filter(|_| keeps);
        let strobe = start.time / start.forcing_period;
        let mut curve =
            Self { family, periods: start.periods, symmetric: false, scales, width, strobe, first: 0, mirror };
        let x = vector(&start.state.q, &start.state.v);
        if curve.mirror.is_some() && start.periods % 2 == 1 {
            let half = Self { symmetric: true, ..curve.clone() };
            let motion = half.run(&Posed { scene, period }, &x, Recorded::Events)?;
            if scales.size(&(&motion.end + &x)) <= MIRRORED {
                curve = half;
            }
        }
        let y = extended(&scales.scaled(&x), value / width);
        let (y, ..) = curve.correct(&y, &unit(y.len(), y.len() - 1), None)?;
        Ok((curve, y))
    }

    fn value(&self, y: &Vector) -> f64 {
        y[y.len() - 1] * self.width
    }

    /// The state at `y`, m and m/s.
    fn state(&self, y: &Vector) -> Vector {
        self.scales.unscaled(&y.rows(0, y.len() - 1).into_owned())
    }

    /// Number of forcing periods that the map covers.
    fn cycles(&self) -> f64 {
        f64::from(self.periods) * if self.symmetric { 0.5 } else { 1.0 }
    }

    /// −1 where the map is the half map of a symmetric orbit, otherwise 1.
    fn sign(&self) -> f64 {
        if self.symmetric { -1.0 } else { 1.0 }
    }

    fn posed(&self, value: f64) -> Result<Posed> {
        let scene = (self.family)(value)?;
        let period = forcing_period(&scene)?;
        if self.symmetric && symmetry::mirror(&scene, period).is_none() {
            return Err(Error::no_orbit(format!("the scene at {value} is not its own mirror image, as the orbit is")));
        }
        Ok(Posed { scene, period })
    }

    fn run(&self, posed: &Posed, x: &Vector, recorded: Recorded) -> Result<OrbitRun> {
        self.run_by_key(posed, x, recorded, None)
    }

    fn run_by_key(&self, posed: &Posed, x: &Vector, recorded: Recorded, key: Option<ByKey<'_>>) -> Result<OrbitRun> {
        let Posed { scene, period } = posed;
        orbit_run::run_by_key(
            scene,
            *period,
            [self.strobe * period, (self.strobe + self.cycles()) * period],
            x,
            recorded,
            key,
        )
    }

    /// The derivative of the scene at the key's value, and those of the instants between which the
    /// map runs; `None` where the scenes beside it do not tell.
    fn tangent(&self, value: f64, posed: &Posed) -> Option<(SceneTangent, [f64; 2])> {
        let tangent = family::tangent(self.family, value, self.width, &posed.scene).ok()?;
        let longer = tangent.period(&posed.scene, posed.period).ok()?;
        Some((tangent, [self.strobe, self.strobe + self.cycles()].map(|cycles| cycles * longer)))
    }

    /// Residual and derivatives at `y`. The derivative with respect to the key is taken from
    /// `column`; if it is `None` there, it is computed and stored.
    fn linear(&self, y: &Vector, column: &mut Option<Vector>) -> Result<Linear> {
        let (posed, x) = (self.posed(self.value(y))?, self.state(y));
        let tangent = if column.is_none() { self.tangent(self.value(y), &posed) } else { None };
        let key = tangent.as_ref().map(|(tangent, later)| ByKey { tangent, later: *later });
        let motion = self.run_by_key(&posed, &x, Recorded::All, key)?;
        let (n, sign) = (x.len(), self.sign());
        let residual = self.scales.scaled(&(&motion.end * sign - &x));
        let own = self.scales.similar(&motion.derivative) * sign - DMatrix::identity(n, n);
        let column = match column {
            Some(known) => known.clone(),
            None => {
                let own = match &motion.by_key {
                    Some(own) => self.scales.scaled(own) * (sign * self.width),
                    None => self.column(y, |posed| self.same(&motion, posed, &x))?,
                };
                column.insert(own).clone()
            }
        };
        let matrix = DMatrix::from_fn(n, n + 1, |i, j| if j < n { own[(i, j)] } else { column[i] });
        Ok(Linear { posed, motion, residual, matrix })
    }

    /// The scaled end of the run from `x` in another scene, if it meets the same walls as `motion`.
    fn same(&self, motion: &OrbitRun, posed: &Posed, x: &Vector) -> Result<Option<Vector>> {
        let other = self.run(posed, x, Recorded::Events)?;
        let same = motion.passages.iter().map(|p| p.event).eq(other.passages.iter().map(|p| p.event));
        Ok(same.then(|| self.scales.scaled(&other.end) * self.sign()))
    }

    /// The derivative of `of` with respect to the key over its width at `y`, by differences; `of`
    /// gives `None` where they would be meaningless.
    fn column(&self, y: &Vector, of: impl Fn(&Posed) -> Result<Option<Vector>>) -> Result<Vector> {
        let value = self.value(y);
        let at = |value: f64| self.posed(value).and_then(|posed| of(&posed));
        let between = |(above, high): (Vector, f64), (below, low): (Vector, f64)| {
            Ok((above - below) * (self.width / (high - low)))
        };
        for finer in FINER {
            let step = finer * DIFFERENCE * value.abs().max(1e-3 * self.width);
            let (high, low) = (value + step, value - step);
            let ends = match (at(high), at(low)) {
                (Err(error), Err(_)) => return Err(error),
                // At the end of the values that the key accepts the difference is one-sided.
                (above, below) => [above.ok().flatten(), below.ok().flatten()],
            };
            let last = finer == FINER[FINER.len() - 1];
            match ends {
                [Some(above), Some(below)] => return between((above, high), (below, low)),
                [Some(above), None] if last => return between((above, high), (own(at(value)?)?, value)),
                [None, Some(below)] if last => return between((own(at(value)?)?, value), (below, low)),
                _ => {}
            }
        }
        Err(no_difference())
    }

    /// The point of the curve in the plane through `guess` with the normal `border`; with its
    /// linearised equations and the number of iterations. The derivative with respect to the key
    /// enters the matrix only: `column` is one from a nearby point, if known, for the first
    /// iteration; the second iteration computes its own, which serves for the rest.
    fn correct(&self, guess: &Vector, border: &Vector, mut column: Option<Vector>) -> Result<(Vector, Linear, usize)> {
        let mut iteration = 0;
        let linear = |y: &Vector| {
            if iteration == 1 {
                column = None;
            }
            iteration += 1;
            self.linear(y, &mut column)
        };
        arclength::correct(guess, border, linear, |linear| (&linear.residual, &linear.matrix))
    }
}

/// The end of the run itself, which meets the walls that it meets.
fn own(end: Option<Vector>) -> Result<Vector> {
    end.ok_or_else(no_difference)
}

fn no_difference() -> Error {
    Error::no_orbit("other walls are met within any difference of the key")
}
