//! The derivative of a scene with respect to a value from which it is built.

mod loads;
mod matrices;
mod stencil;

pub(super) use loads::{LoadChange, LoadTerms};

use crate::error::{Error, Result};
use crate::linear::Operator;
use crate::scene::{LoadKind, Row, Scene};
use stencil::{MORE_SPACINGS, SPACINGS, Stencil};

/// The largest error of the derivative of a number of the scene, as a share: the results are exact
/// to 1e-8 of themselves, with a hundredth of that for their own rounding.
const MOST_ERROR: f64 = 1e-8;

/// An error below which scenes closer to each other are not tried.
const ENOUGH: f64 = 1e-12;

/// The derivative of a scene with respect to a value from which it is built: δM, δC, δK, and those
/// of its walls, loads, probes and of its start.
///
/// It is a difference over scenes at other values ([`SceneTangent::error`]). The building alone is
/// differenced: the derivative of a motion that follows from it is exact.
///
/// ```
/// use signorini::variation::SceneTangent;
/// use signorini::{Scene, Wall};
///
/// let scene = |gap: f64| {
///     let stop = Wall::upper("stop", gap).with_restitution(0.8);
///     Ok(Scene::oscillator(1.0, 0.2, 100.0).with_wall(stop))
/// };
/// let tangent = SceneTangent::new("gap", 5e-3, scene)?;
/// assert!(tangent.error() < 1e-12);
///
/// // What does not change the scene is refused.
/// assert!(SceneTangent::new("nothing", 1.0, |_| scene(5e-3)).is_err());
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct SceneTangent {
    name: String,
    value: f64,
    error: f64,
    /// `None` where it is 0.
    pub(super) mass: Option<Operator>,
    pub(super) damping: Option<Operator>,
    pub(super) stiffness: Option<Operator>,
    pub(super) walls: Vec<WallTangent>,
    pub(super) loads: Vec<LoadChange>,
    pub(super) probes: Vec<Row>,
    /// The start, m and m/s per unit of the value.
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
}

/// The derivative of a wall.
#[derive(Debug, Clone)]
pub(crate) struct WallTangent {
    /// δg, m; δe; δk_a, N/m, and δc_a, N s/m: each per unit of the value.
    pub position: f64,
    pub restitution: f64,
    pub stiffness: f64,
    pub damping: f64,
    /// δG; without entries where it is 0.
    pub row: Row,
}

impl SceneTangent {
    /// The derivative, with respect to what is called `name`, at `value`, of the scenes that
    /// `build` makes of values near this one.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the scenes do not depend on the value, or by friction alone, or
    /// not smoothly: another number of walls or loads, another instant of a row of a table, a blow
    /// at the start that moves, another duration; errors of `build`.
    pub fn new(name: &str, value: f64, mut build: impl FnMut(f64) -> Result<Scene>) -> Result<Self> {
        let (mut best, mut differs): (Option<Self>, _) = (None, false);
        for (number, apart) in SPACINGS.into_iter().chain(MORE_SPACINGS).enumerate() {
            if number >= SPACINGS.len() && best.as_ref().is_some_and(|best| best.error <= MOST_ERROR) {
                break;
            }
            let stencil = Stencil::new(value, apart, &mut build)?;
            let alike = |scene: &Scene| scene.duration == stencil.base.duration && is_alike(&stencil.base, scene);
            if !stencil.scenes().all(alike) {
                return Err(refused(name, value, "a key that keeps walls, loads, their times and the duration"));
            }
            differs |= stencil.scenes().any(|scene| *scene != stencil.base);
            let found = Self::of(name, value, stencil);
            let error = if found.error.is_nan() { f64::INFINITY } else { found.error };
            if best.as_ref().is_none_or(|best| error < best.error) {
                best = Some(Self { error, ..found });
            }
            if error <= ENOUGH {
                break;
            }
        }
        let tangent = best.ok_or_else(|| refused(name, value, "a number"))?;
        if tangent.loads.iter().any(|load| load.blow_moves(0.0) != 0.0) {
            return Err(refused(name, value, "the time of a blow after the start"));
        }
        if tangent.is_zero() {
            let expected = if differs {
                "a key that changes masses, springs, dampers, walls, loads or the start; friction has no derivative"
            } else {
                "a key on which the scene depends"
            };
            return Err(refused(name, value, expected));
        }
        if tangent.error > MOST_ERROR {
            return Err(refused(name, value, "a key on which the scene depends smoothly"));
        }
        Ok(tangent)
    }

    /// The difference between the scenes at two values near that of `base`, whose error is not
    /// known: enough for the matrix of Newton's method. The durations may differ, and the scenes
    /// may be the same.
    ///
    /// # Errors
    /// [`Error::Invalid`] for scenes of other walls or loads.
    pub(crate) fn between(name: &str, value: f64, base: Scene, ends: [(f64, Scene); 2]) -> Result<Self> {
        if !ends.iter().all(|(_, scene)| is_alike(&base, scene)) {
            return Err(refused(name, value, "a key that keeps walls, loads and their times"));
        }
        Ok(Self::of(name, value, Stencil::between(base, ends)))
    }

    fn of(name: &str, value: f64, mut stencil: Stencil) -> Self {
        let n = stencil.base.system.degrees_of_freedom();
        let [mass, damping, stiffness] = matrices::changes(&mut stencil);
        let walls = (0..stencil.base.walls.len()).map(|wall| WallTangent::new(&mut stencil, wall)).collect();
        let loads = (0..stencil.base.loads.len()).filter_map(|load| LoadChange::new(&mut stencil, load)).collect();
        let probes = (0..stencil.base.probes.len())
            .map(|probe| stencil.row(|scene| scene.probes.get(probe).map(|probe| &probe.at)))
            .collect();
        let at = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(0.0);
        let q = (0..n).map(|i| stencil.derivative(|scene| at(&scene.initial.q, i))).collect();
        let v = (0..n).map(|i| stencil.derivative(|scene| at(&scene.initial.v, i))).collect();
        let error = stencil.error;
        Self { name: name.to_owned(), value, error, mass, damping, stiffness, walls, loads, probes, q, v }
    }

    /// δm (kg), δc (N s/m) and δk (N/m) of a body of one degree of freedom, per unit of the value.
    pub(crate) fn body(&self) -> [f64; 3] {
        [&self.mass, &self.damping, &self.stiffness].map(|matrix| {
            let mut of_one = [0.0];
            matrix.iter().for_each(|matrix| matrix.add_product(1.0, &[1.0], &mut of_one));
            of_one[0]
        })
    }

    /// The derivative of wall number `wall`.
    pub(crate) fn wall(&self, wall: usize) -> Option<&WallTangent> {
        self.walls.get(wall)
    }

    /// The derivative of the loads on a body of one degree of freedom at `time` (s), N per unit of
    /// the value.
    pub(crate) fn force(&self, time: f64) -> f64 {
        let (mut terms, mut force) = (LoadTerms::default(), [0.0]);
        terms.fill(&self.loads, 1, time, 1.0);
        terms.add(&self.loads, 0, &mut force);
        force[0]
    }

    /// The value.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The error of the derivatives of the scene's numbers, as a share: the largest difference
    /// between two formulas, the better of which is used.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The derivative of the common period (s) of the sines of `scene`, s per unit of the value.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the frequencies change by different shares, so that there is none.
    pub(crate) fn period(&self, scene: &Scene, period: f64) -> Result<f64> {
        let turns = |kind: &LoadKind| matches!(kind, LoadKind::Harmonic { frequency, .. } if *frequency > 0.0);
        let sines = scene.loads.iter().enumerate().filter(|(_, load)| turns(&load.kind));
        let shares: Vec<f64> =
            sines.map(|(index, _)| self.loads.iter().map(|load| load.hastening(index)).sum::<f64>()).collect();
        let (least, most) = shares.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x.abs()), b.max(x.abs())));
        if shares.is_empty() || most - least > MOST_ERROR * most {
            let expected = "a key that keeps the ratio of the frequencies of all sines";
            return if most == 0.0 { Ok(0.0) } else { Err(refused(&self.name, self.value, expected)) };
        }
        Ok(-period * shares.first().copied().unwrap_or(0.0))
    }

    fn is_zero(&self) -> bool {
        let none = [&self.mass, &self.damping, &self.stiffness].iter().all(|matrix| matrix.is_none());
        let still = self.walls.iter().all(WallTangent::is_zero) && self.loads.is_empty();
        none && still && self.q.iter().chain(&self.v).all(|&x| x == 0.0)
    }
}

fn refused(name: &str, value: f64, expected: &str) -> Error {
    Error::invalid(format!("derivative by {name}"), value, expected)
}

impl WallTangent {
    fn new(stencil: &mut Stencil, wall: usize) -> Self {
        let spring = |scene: &Scene| scene.walls.get(wall).and_then(|wall| wall.law.spring());
        Self {
            position: stencil.derivative(|scene| scene.walls.get(wall).map_or(0.0, |wall| wall.position())),
            restitution: stencil
                .derivative(|scene| scene.walls.get(wall).and_then(|wall| wall.law.restitution()).unwrap_or(0.0)),
            stiffness: stencil.derivative(|scene| spring(scene).map_or(0.0, |spring| spring.stiffness)),
            damping: stencil.derivative(|scene| spring(scene).map_or(0.0, |spring| spring.damping)),
            row: stencil.row(|scene| scene.walls.get(wall).map(|wall| wall.row())),
        }
    }

    fn is_zero(&self) -> bool {
        let numbers = [self.position, self.restitution, self.stiffness, self.damping];
        numbers.iter().all(|&x| x == 0.0) && self.row.entries().is_empty()
    }
}

/// True for scenes that differ in numbers only.
fn is_alike(a: &Scene, b: &Scene) -> bool {
    let walls = a.walls.len() == b.walls.len()
        && a.walls
            .iter()
            .zip(&b.walls)
            .all(|(a, b)| a.side() == b.side() && std::mem::discriminant(&a.law) == std::mem::discriminant(&b.law));
    let loads = a.loads.len() == b.loads.len() && a.loads.iter().zip(&b.loads).all(|(a, b)| loads::is_alike(a, b));
    let sizes = a.system.degrees_of_freedom() == b.system.degrees_of_freedom() && a.probes.len() == b.probes.len();
    walls && loads && sizes
}
