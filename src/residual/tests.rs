//! Steps made by hand, whose numbers can be added up on paper: what the judge notes of them.

mod blow_check;
mod circle;
mod corrected;
mod disk;
mod flight;
mod friction;
mod grid;
mod ledger;
mod ring;
mod round;
mod sizes;
mod stretch;

use super::*;
use crate::linear::Symmetric;
use crate::scene::{PlaneRows, Row, Structure, Wall, WallLaw};
use crate::step::Balance;
use crate::step::{Conserves, Promise, Tolerances};

/// A body with these masses (kg) in two planes, dashpots (N s/m) and no springs.
fn body(mass: [f64; 2], damping: f64) -> Scene {
    let diagonal = |x: [f64; 2]| Symmetric::diagonal(&x);
    let (damping, stiffness) = (diagonal([damping; 2]), diagonal([0.0; 2]));
    Scene::structure(Structure { mass: diagonal(mass), damping, stiffness })
}

/// The scene with a round hole around the body.
fn with_hole(scene: Scene, name: &str, gap: f64, law: WallLaw) -> Scene {
    let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
    let wall = Wall { law, ..Wall::round(name, at.clone(), gap) };
    scene.with_support(name, at, [0.0; 2], vec![wall])
}

const RIGID: WallLaw = WallLaw::Rigid { restitution: 0.5 };

/// A judge of such steps from rest at `q` (m) on.
fn judge(scene: &Scene, (balance, promise): (Balance, Promise), h: f64, q: &[f64]) -> Judge {
    let tolerances = Tolerances::of(Conserves::Nothing);
    Judge::new(scene, Contract { balance, promise, instant: 1.0, tolerances, divides: false }, h, q, &[])
}

/// A step, to be changed at will.
#[derive(Debug, Clone)]
struct Made {
    start: f64,
    end: f64,
    q: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
    impulse: Vec<f64>,
    jump: Vec<f64>,
    force: Vec<f64>,
    friction: Vec<f64>,
    normal: Vec<[f64; 2]>,
    turned: Vec<[f64; 2]>,
    wedged: Vec<usize>,
    resting: Vec<usize>,
    extra: Vec<f64>,
}

impl Made {
    /// The first step of `h` seconds on `scene`, in which nothing moves.
    fn rest(scene: &Scene, h: f64) -> Self {
        let (n, contacts) = (scene.system.degrees_of_freedom(), scene.walls.len());
        let planar = if scene.turns_or_rubs() { contacts } else { 0 };
        let (zero, none) = (vec![0.0; n], vec![0.0; contacts]);
        Self {
            start: 0.0,
            end: h,
            q: zero.clone(),
            before: zero.clone(),
            after: zero.clone(),
            impulse: none.clone(),
            jump: none.clone(),
            force: none,
            friction: vec![0.0; planar],
            normal: vec![[0.0; 2]; planar],
            turned: vec![[0.0; 2]; planar],
            wedged: Vec::new(),
            resting: Vec::new(),
            extra: zero,
        }
    }

    /// The same with a push of a round hole, counted after the walls, along its normal, N s.
    fn pushing(mut self, hole: usize, normal: [f64; 2], impulse: f64) -> Self {
        (self.normal[hole], self.impulse[hole]) = (normal, impulse);
        self
    }

    fn step(&self) -> Step<'_> {
        self.along(Path::Grid)
    }

    fn along<'a>(&'a self, path: Path<'a>) -> Step<'a> {
        Step {
            index: 0,
            start: self.start,
            end: self.end,
            q: &self.q,
            v: &self.after,
            velocity_before: &self.before,
            velocity_after: &self.after,
            impulse: &self.impulse,
            jump: &self.jump,
            force: &self.force,
            friction: &self.friction,
            normal: &self.normal,
            turned: &self.turned,
            wedged: &self.wedged,
            resting: &self.resting,
            extra: &self.extra,
            closed: &[],
            path,
        }
    }
}

/// Fails unless `found` is `size` less a rounding error of `noise`, which itself is known to a part
/// in a thousand: the tests choose sizes of which each term of the noise is a larger share.
#[track_caller]
fn assert_less(found: f64, size: f64, noise: f64) {
    assert!((found - (size - noise)).abs() < 1e-3 * noise, "{found:e}, expected {size:e} − {noise:e}");
}
