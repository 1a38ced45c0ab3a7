//! Derivatives of the numbers of a scene with respect to a value from which the scene is built, by
//! differences over scenes at other values.
//!
//! Only the building of the scene is differenced, never its motion. What most keys set (a mass, a
//! gap, a restitution, an amplitude) is proportional to the key, so that the difference is exact to
//! rounding. Matrices that are assembled from dimensions are smooth functions of them: the central
//! difference over twelve scenes, which are a 32nd of the value apart, errs by 4e-13 for 1/x and is
//! exact for polynomials up to degree 12. That over eight of these scenes has a larger error, so
//! that their difference bounds the error of the former. Where it tells of a large one (a value
//! near one that is not possible, such as the inner diameter of a thin tube) the scenes are taken
//! closer to each other. At a value where the second derivative jumps, such as the position of a
//! wall at a node of a beam, both one-sided differences are taken, over six scenes each: where they
//! agree, the derivative exists. Where they do not, at a kink, there is none, whatever the central
//! difference is.

use crate::error::{Error, Result};
use crate::order::sort_by_number;
use crate::scene::{Face, Row, Scene};

/// Distances of two neighbouring values as shares of the value: the first as large as keeps the
/// error of the formula below that of rounding, ε over this, where the scene is as smooth as 1/x;
/// the others for what is less smooth.
pub(super) const SPACINGS: [f64; 4] = [1.0 / 32.0, 1.0 / 128.0, 1.0 / 512.0, 1.0 / 2048.0];

/// Further ones, where the derivative needs one-sided formulas: within six of the longer ones a
/// place passes further nodes of a beam.
pub(super) const MORE_SPACINGS: [f64; 4] = [1.0 / 64.0, 1.0 / 96.0, 1.0 / 192.0, 1.0 / 256.0];

/// Number of scenes on either side of the value, and in the formula that tells the error.
const POINTS: i32 = 6;
const FEWER: i32 = 4;

/// The same on one side, where values on the other are invalid: a restitution of 1, a damping of 0.
const POINTS_ONE_SIDED: i32 = 8;
const FEWER_ONE_SIDED: i32 = 6;

/// One-sided derivatives that differ by more than this share do not agree: at the spacings above
/// rounding makes 50 times 1e-12, to which the modes of a beam are known, over the spacing.
const KINK: f64 = 1e-6;

/// The error of a central difference above which the one-sided ones are taken in its place.
const COARSE: f64 = 1e-9;

/// How often the distance is halved where a value would be invalid, before one side is tried.
const HALVINGS: usize = 12;

/// A scene at a value, and scenes at values near it.
#[derive(Debug)]
pub(super) struct Stencil {
    pub base: Scene,
    points: Vec<Point>,
    /// The value, or where it is 0 the distance, as the unit in which errors count.
    unit: f64,
    /// The largest error found so far, as a share.
    pub error: f64,
}

#[derive(Debug)]
struct Point {
    scene: Scene,
    weights: Weights,
}

/// The weights of a scene in the formulas.
#[derive(Debug, Clone, Copy, Default)]
struct Weights {
    /// In the formula over all points, and in the one that tells its error.
    central: [f64; 2],
    /// The same over the points above the value and below it; 0 in a stencil of one side.
    above: [f64; 2],
    below: [f64; 2],
}

impl Stencil {
    /// The scenes that `build` makes of `value` and of values near it, `apart` times the value from
    /// each other or less.
    ///
    /// # Errors
    /// Errors of `build`, where no values near this one are valid.
    pub fn new(value: f64, apart: f64, mut build: impl FnMut(f64) -> Result<Scene>) -> Result<Self> {
        let mut valid = |x: f64| {
            let scene = build(x)?;
            scene.validate()?;
            Ok(scene)
        };
        let base = valid(value)?;
        let size = if value == 0.0 { 1.0 } else { value.abs() };
        let two_sided = (0..HALVINGS).map(|halvings| (apart * 0.5_f64.powi(halvings as i32), -POINTS..=POINTS));
        let sides = [0..=POINTS_ONE_SIDED, -POINTS_ONE_SIDED..=0];
        let one_sided = (0..HALVINGS).flat_map(|halvings| {
            let spacing = 2.0 * apart * 0.5_f64.powi(halvings as i32);
            sides.clone().map(|side| (spacing, side))
        });
        let mut refused = None;
        for (spacing, side) in two_sided.chain(one_sided) {
            let step = spacing * size;
            // The farthest first: it is the one most likely to be invalid.
            let mut numbers: Vec<i32> = side.clone().filter(|&k| k != 0).collect();
            sort_by_number(&mut numbers, |k| -f64::from(k.abs()));
            let near = |&k: &i32| Ok(facing_as(&base, valid(value + f64::from(k) * step)?));
            let scenes: Result<Vec<Scene>> = numbers.iter().map(near).collect();
            match scenes {
                Ok(scenes) => {
                    let fewer = if *side.start() == -POINTS { FEWER } else { FEWER_ONE_SIDED };
                    let nearer: Vec<i32> = numbers.iter().copied().filter(|k| k.abs() <= fewer).collect();
                    let both = [weights(&numbers), weights(&nearer)];
                    let two = *side.start() == -POINTS;
                    let of_side = |sign: i32, most: i32| {
                        weights(&(1..=most).filter(|_| two).map(|k| sign * k).collect::<Vec<i32>>())
                    };
                    let sides = [1, -1].map(|sign| [of_side(sign, POINTS), of_side(sign, POINTS - 1)]);
                    let point = |(scene, &k): (Scene, &i32)| {
                        let of = |list: &[Vec<(i32, f64)>; 2]| list.each_ref().map(|of| weight(of, k) / step);
                        let [above, below] = sides.each_ref().map(of);
                        Point { scene, weights: Weights { central: of(&both), above, below } }
                    };
                    let points = scenes.into_iter().zip(&numbers).map(point).collect();
                    let unit = if value == 0.0 { step } else { size };
                    return Ok(Self { base, points, unit, error: 0.0 });
                }
                Err(error) => refused = refused.or(Some(error)),
            }
        }
        Err(refused.unwrap_or_else(|| Error::invalid("value", value, "one near which there are other valid values")))
    }

    /// The scenes at two values, one on either side of that of `base` or at it; nothing tells the
    /// error of the differences.
    pub fn between(base: Scene, [(low, below), (high, above)]: [(f64, Scene); 2]) -> Self {
        let weight = 1.0 / (high - low);
        let [below, above] = [below, above].map(|scene| facing_as(&base, scene));
        let point = |scene, weight| Point { scene, weights: Weights { central: [weight; 2], ..Weights::default() } };
        let points = vec![point(above, weight), point(below, -weight)];
        Self { base, points, unit: high - low, error: 0.0 }
    }

    /// The other scenes.
    pub fn scenes(&self) -> impl Iterator<Item = &Scene> {
        self.points.iter().map(|point| &point.scene)
    }

    /// The derivative of the number that `of` gives for a scene.
    pub fn derivative(&mut self, of: impl Fn(&Scene) -> f64) -> f64 {
        self.derivative_among(0.0, of)
    }

    /// The same for one of several numbers, as large as `size`: the error counts as a share of it.
    pub fn derivative_among(&mut self, size: f64, of: impl Fn(&Scene) -> f64) -> f64 {
        let own = of(&self.base);
        let mut sums = [[0.0; 2]; 3];
        for point in &self.points {
            // 0 to the last digit where the key does not change the number.
            let change = of(&point.scene) - own;
            let Weights { central, above, below } = point.weights;
            for (sum, weight) in sums.iter_mut().flatten().zip([central, above, below].iter().flatten()) {
                *sum += weight * change;
            }
        }
        let [[derivative, coarser], above, below] = sums;
        let unit = own.abs().max(size) / self.unit;
        let share = |difference: f64, derivative: f64| match difference == 0.0 {
            true => 0.0,
            false => difference.abs() / (derivative.abs() + unit),
        };
        let central = share(derivative - coarser, derivative);
        // Stencils of one side and of two scenes have no sides to compare.
        let sided = above != [0.0; 2] || below != [0.0; 2];
        let mean = 0.5 * (above[0] + below[0]);
        let apart = if sided { share(above[0] - below[0], mean) } else { 0.0 };
        if central <= COARSE || !sided {
            self.error = self.error.max(if apart > KINK { apart } else { central });
            return derivative;
        }
        let of_sides = [apart, share(above[0] - above[1], mean), share(below[0] - below[1], mean)];
        let of_sides = of_sides.into_iter().fold(0.0, f64::max);
        self.error = self.error.max(of_sides.min(if apart > KINK { of_sides } else { central }));
        if of_sides < central { mean } else { derivative }
    }

    /// The derivative of the row that `of` gives for a scene, without entries where it is 0.
    pub fn row(&mut self, of: impl Fn(&Scene) -> Option<&Row>) -> Row {
        let entries = |scene: &Scene| of(scene).map_or(&[][..], Row::entries).to_vec();
        let mut dofs: Vec<usize> = entries(&self.base).iter().map(|entry| entry.0).collect();
        self.scenes().for_each(|scene| dofs.extend(entries(scene).iter().map(|entry| entry.0)));
        dofs.sort_unstable();
        dofs.dedup();
        let weight = |scene: &Scene, dof: usize| {
            let all = of(scene).map_or(&[][..], Row::entries);
            all.iter().filter(|entry| entry.0 == dof).map(|entry| entry.1).sum::<f64>()
        };
        let size = entries(&self.base).iter().fold(0.0, |most: f64, entry| most.max(entry.1.abs()));
        let mut change = |dof: usize| self.derivative_among(size, |scene| weight(scene, dof));
        let changes: Vec<(usize, f64)> = dofs.into_iter().map(|dof| (dof, change(dof))).collect();
        Row::new(changes.into_iter().filter(|entry| entry.1 != 0.0).collect())
    }
}

/// `scene` with its flat walls on the sides on which those of `base` stand: a lower wall of the row
/// −g is an upper one of the row g, and flats whose direction passes 0° or 180° change from one to
/// the other.
fn facing_as(base: &Scene, mut scene: Scene) -> Scene {
    for (wall, own) in scene.walls.iter_mut().zip(&base.walls) {
        if let (Face::Flat { side, position, at, .. }, Face::Flat { side: own, .. }) = (&mut wall.face, &own.face)
            && side != own
        {
            *side = *own;
            *position = -*position;
            *at = Row::combination([(-1.0, &*at)]);
        }
    }
    scene
}

/// The weight of point `k` among `weights`; 0 if it is none of them.
fn weight(weights: &[(i32, f64)], k: i32) -> f64 {
    weights.iter().find(|weight| weight.0 == k).map_or(0.0, |weight| weight.1)
}

/// The weights of f(k) − f(0) in the derivative f′(0) of the polynomial through 0 and these points:
/// the derivative of the Lagrange polynomial of each point.
fn weights(points: &[i32]) -> Vec<(i32, f64)> {
    let of = |&k: &i32| {
        let x = f64::from(k);
        let others = points.iter().map(|&j| f64::from(j)).filter(|&y| y != x);
        (k, others.map(|y| y / (y - x)).product::<f64>() / x)
    };
    points.iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene whose stiffness is f(x).
    fn of(x: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
        let build = |x: f64| Ok(Scene::oscillator(1.0, 0.0, f(x)));
        let mut stencil = Stencil::new(x, SPACINGS[0], build).unwrap();
        let derivative = stencil.derivative(|scene| scene.system.structure().stiffness.get(0, 0));
        (derivative, stencil.error)
    }

    #[test]
    fn smooth_functions_have_their_derivatives() {
        // Rounding of values over a distance of 1/32.
        let (linear, _) = of(0.7, |x| 3.0 * x);
        assert!((linear - 3.0).abs() < 1e-13, "{linear}");
        let (power, _) = of(0.7, |x| x.powi(4));
        assert!((power / (4.0 * 0.7_f64.powi(3)) - 1.0).abs() < 1e-12, "{power}");
        // The stated error of the formula for 1/x, and a bound of it that is not too tight.
        let (inverse, error) = of(0.7, |x| 1.0 / x);
        assert!((inverse * 0.49 + 1.0).abs() < 1e-12, "{inverse}");
        assert!((1e-13..1e-7).contains(&error), "{error}");
    }

    #[test]
    fn a_kink_shows_in_the_error() {
        let (_, error) = of(0.7, |x| 1.0 + (x - 0.7).abs());
        assert!(error > 1e-1, "at the value itself, where the central difference is 0: {error}");
        let (_, error) = of(0.7, |x| 1.0 + (x - 0.69).abs());
        assert!(error > 1e-3, "{error}");
    }

    #[test]
    fn a_jump_of_the_second_derivative_leaves_the_first() {
        let bent = |x: f64| 1.0 / x + if x > 0.5 { 3.0 * (x - 0.5).powi(2) } else { -(x - 0.5).powi(2) };
        let build = |x: f64| Ok(Scene::oscillator(1.0, 0.0, bent(x)));
        let mut stencil = Stencil::new(0.5, SPACINGS[1], build).unwrap();
        let derivative = stencil.derivative(|scene| scene.system.structure().stiffness.get(0, 0));
        // The formulas of six and of five points for 1/x err by 6! and 5! times the sixth and the
        // fifth power of 1/128: 1.6e-10 and 3.5e-9.
        assert!((derivative / 4.0 + 1.0).abs() < 3e-10 && stencil.error < 5e-9, "{derivative} {}", stencil.error);
    }

    #[test]
    fn one_side_is_enough_at_a_bound() {
        // A stiffness below 0 is invalid.
        let (one, error) = of(0.0, |x| 2.0 * x);
        assert!((one - 2.0).abs() < 1e-11 && error < 1e-11, "{one} {error}");
        assert!(Stencil::new(-1.0, SPACINGS[0], |x| Ok(Scene::oscillator(1.0, 0.0, x))).is_err());
    }
}
