//! What the judge keeps of round holes and friction over a run.

use super::front::ComplementarityFront;
use super::largest_residual::Residual;
use crate::scene::{Hole, Scene};
use crate::step::Step;

/// An acceleration that the scheme computed with other roundings.
const SAME: f64 = 1.0 + 1e-9;

/// A part shorter than this share of a step has no acceleration to tell.
const INSTANT: f64 = 1e-12;

/// Round supports and friction of a run.
#[derive(Debug, Default)]
pub(super) struct Supports {
    /// Parts of forces that are not along the hole's normal, N.
    pub askew: Residual,
    /// Speeds by which impacts on holes in exact motion miss their law, m/s.
    pub struck: Residual,
    /// Pairs of sliding speed (m/s) and missing friction (N).
    pub rubs: ComplementarityFront,
    /// The mass that each wall feels, kg, and its impulse in the step before, N s.
    pub mass: Vec<f64>,
    pub pushed: Vec<f64>,
    /// The largest angle by which the normal turned in a step of the contact of each hole that
    /// pushed in the step before, rad, where the promise tells; else 0.
    pub turned: Vec<f64>,
    /// How fast the body slid along each wall at the end of the step or part before, along t and
    /// less rounding, m/s; infinite where the wall did not push.
    pub slid: Vec<f64>,
    /// The same before the last part.
    slid_before: Vec<f64>,
    /// Impulse of each wall along y and z, without the normal ones of flats, N s; and the sum of
    /// the magnitudes.
    pub impulse: Vec<[f64; 2]>,
    pub size: Vec<f64>,
    /// The sums of the round walls as the recorder has them, in their order, if told.
    pub recorded: Option<Vec<[f64; 2]>>,
    /// Velocities that enter and leave the balance of the step at the place of each wall that
    /// pushes or rubs, m/s.
    pub rates: Vec<[[f64; 2]; 2]>,
    /// Velocities at both ends of the last part of some length, m/s, and its length, s.
    part: [Vec<f64>; 2],
    length: f64,
}

impl Supports {
    /// `None` for a scene without round holes and friction. The run begins at this displacement (m)
    /// and velocity (m/s), and walls feel these masses.
    pub fn new(scene: &Scene, masses: &[f64], (q, v): (&[f64], &[f64])) -> Option<Box<Self>> {
        if !scene.turns_or_rubs() {
            return None;
        }
        let stands = |index| if scene.stands_on(index, q, v) { 0.0 } else { f64::INFINITY };
        let slid = (0..scene.walls.len()).map(stands);
        Some(Box::new(Self {
            mass: masses.iter().copied().take(scene.walls.len()).collect(),
            pushed: vec![0.0; scene.walls.len()],
            turned: vec![0.0; scene.walls.len()],
            slid: slid.collect(),
            impulse: vec![[0.0; 2]; scene.walls.len()],
            size: vec![0.0; scene.walls.len()],
            rates: vec![[[0.0; 2]; 2]; scene.walls.len()],
            ..Self::default()
        }))
    }

    /// A part of a step begins.
    pub fn begin_part(&mut self) {
        self.slid_before.clone_from(&self.slid);
    }

    /// Keeps a part of `length` seconds of a step of `h` seconds.
    pub fn keep_part(&mut self, step: &Step<'_>, (length, h): (f64, f64)) {
        // In the last roundings before a blow there is no acceleration to tell.
        if length > INSTANT * h {
            self.length = length;
            for (kept, v) in self.part.iter_mut().zip([step.velocity_before, step.velocity_after]) {
                kept.clear();
                kept.extend_from_slice(v);
            }
        } else {
            // And no rigid wall to tell of: each slides or sticks as before.
            self.slid.clone_from(&self.slid_before);
        }
    }

    /// Adds an impulse (N s, along y and z) of the wall `index`, and its magnitude.
    pub fn give(&mut self, index: usize, impulse: [f64; 2], magnitude: f64) {
        if let (Some([y, z]), Some(size)) = (self.impulse.get_mut(index), self.size.get_mut(index)) {
            (*y, *z) = (*y + impulse[0], *z + impulse[1]);
            *size += magnitude;
        }
    }

    /// Length of the last part, s.
    pub fn part_length(&self) -> f64 {
        self.length
    }

    /// `change` between the `seen` velocities at both ends of the last part.
    pub fn change_in_part(&self, seen: impl Fn(&[f64]) -> f64, change: impl Fn(f64, f64) -> f64) -> f64 {
        let [before, after] = &self.part;
        change(seen(before), seen(after))
    }

    /// True if the rebounds of a body that strikes a hole at the speed `struck` (m/s) along the
    /// normal `n` end within a step of `h` seconds: under the acceleration of the last part along n
    /// and that of its way along the circle.
    pub fn ends_rebounds(&self, hole: &Hole<'_>, (n, struck): ([f64; 2], f64), h: f64, noise: f64) -> bool {
        let [before, after] = [&self.part[0], &self.part[1]].map(|v| hole.seen(v));
        let gained = n[0] * (after[0] - before[0]) + n[1] * (after[1] - before[1]);
        let along = n[0] * after[1] - n[1] * after[0];
        let pressed = gained + self.length * along * along / hole.gap + noise;
        2.0 * hole.restitution * struck * self.length <= SAME * (1.0 - hole.restitution) * h * pressed
    }
}
