//! What every scheme knows of the scene.

use crate::error::{Error, Result};
use crate::linear::{Factor, Operator, Rows, Symmetric};
use crate::scene::{Loads, Scene, Side, Structure, WallLaw};

/// The structure as a kernel wants it.
#[derive(Debug)]
pub(super) struct Body {
    pub n: usize,
    pub h: f64,
    pub matrices: Structure,
    pub mass: Operator,
    pub damping: Operator,
    pub stiffness: Operator,
    pub loads: Loads,
    pub walls: Vec<Stop>,
    /// The walls' rows, one each.
    pub rows: Rows,
    /// Distance within which a wall counts as touched, m: 1e-12 of the gap scale.
    pub touch: f64,
    /// M factored: what a blow changes of the velocity. None without blows.
    inertia: Option<Factor>,
    blow: Vec<f64>,
}

/// A wall as a kernel wants it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop {
    pub upper: bool,
    /// +1 lower, −1 upper: the sign of its force.
    pub sign: f64,
    pub g: f64,
    pub law: WallLaw,
}

impl Stop {
    /// Depth behind the wall, m.
    #[inline]
    pub fn depth(&self, w: f64) -> f64 {
        self.sign * (self.g - w)
    }

    /// The larger of the depth and zero, as a coordinate: where a dashpot's plate stands when the body is at `w`.
    #[inline]
    pub fn plate(&self, w: f64) -> f64 {
        if self.upper { w.max(self.g) } else { w.min(self.g) }
    }
}

impl Body {
    pub fn new(scene: &Scene, h: f64) -> Self {
        let matrices = scene.system.structure();
        let loads = Loads::new(&scene.loads);
        let stop = |w: &crate::scene::Wall| Stop {
            upper: w.side == Side::Upper,
            sign: w.side.sign(),
            g: w.position,
            law: w.law,
        };
        let n = matrices.mass.size();
        Self {
            n,
            h,
            mass: Operator::new(&matrices.mass),
            damping: Operator::new(&matrices.damping),
            stiffness: Operator::new(&matrices.stiffness),
            walls: scene.walls.iter().map(stop).collect(),
            rows: Rows::new(n, scene.walls.iter().map(|wall| wall.at.entries())),
            touch: 1e-12 * scene.gap_scale(),
            // A mass that cannot be factored is refused by the scene.
            inertia: if loads.has_blows() { Factor::new(&matrices.mass).ok() } else { None },
            blow: vec![0.0; n],
            loads,
            matrices,
        }
    }

    /// The blows in (from, to]: adds `scale` times them to `b` (N s times that) and writes the velocity they leave to `struck`, given `v`. Returns
    /// whether there was one.
    #[inline]
    pub fn strike(
        &mut self,
        (from, to): (f64, f64),
        v: &[f64],
        scale: f64,
        b: &mut [f64],
        struck: &mut [f64],
    ) -> bool {
        if !self.loads.has_blows() || !self.loads.blow(from, to, &mut self.blow) {
            return false;
        }
        self.apply_blow(v, scale, b, struck);
        true
    }

    /// The same for the blows within half a step of the instant step · h.
    pub fn strike_about(&mut self, step: u64, v: &[f64], scale: f64, b: &mut [f64], struck: &mut [f64]) -> bool {
        if !self.loads.has_blows() || !self.loads.blow_about(step, self.h, &mut self.blow) {
            return false;
        }
        self.apply_blow(v, scale, b, struck);
        true
    }

    fn apply_blow(&mut self, v: &[f64], scale: f64, b: &mut [f64], struck: &mut [f64]) {
        b.iter_mut().zip(&self.blow).for_each(|(b, blow)| *b += scale * blow);
        if let Some(inertia) = &mut self.inertia {
            inertia.solve(&mut self.blow);
        }
        for ((struck, v), change) in struck.iter_mut().zip(v).zip(&self.blow) {
            *struck = v + change;
        }
    }

    /// Adds what the blows in (from, to] make of the velocity to `v`.
    pub fn kick(&mut self, from: f64, to: f64, v: &mut [f64]) {
        if !self.loads.has_blows() || !self.loads.blow(from, to, &mut self.blow) {
            return;
        }
        if let Some(inertia) = &mut self.inertia {
            inertia.solve(&mut self.blow);
        }
        v.iter_mut().zip(&self.blow).for_each(|(v, change)| *v += change);
    }

    /// Adds the signed `forces` of the walls to `out`, each by its row.
    #[inline]
    pub fn push(&self, scale: f64, forces: &[f64], out: &mut [f64]) {
        for (wall, &force) in forces.iter().enumerate() {
            if force != 0.0 {
                self.rows.add_transposed(wall, scale * force, out);
            }
        }
    }
}

/// The factor of a matrix of a step.
pub(super) fn factor(a: &Symmetric) -> Result<Factor> {
    Factor::new(a).map_err(|fault| Error::invalid("system: matrices", fault, "a positive definite mass"))
}
