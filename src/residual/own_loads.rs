//! The extra force of steps in which no caller adds one.
//!
//! A step tells an extra force: that of the caller, and what makes up for a jump of a load within
//! the step ([`LoadJumps`]). Of a run that no caller takes part in, the judge computes the latter
//! itself and uses it in place of what the step tells, so that a force that no load explains breaks
//! the momentum balance.

use crate::scene::Scene;
use crate::step::{Balance, Contract, LoadJumps, Path, Step};

/// The extra force that the loads of a scene explain.
#[derive(Debug, Clone)]
pub(super) struct OwnLoads {
    jumps: Option<LoadJumps>,
    none: Vec<f64>,
}

impl OwnLoads {
    /// `None` for a balance under which a step tells the extra force of more than itself, or that
    /// of exact motion, whose stretches end at jumps.
    pub fn new(scene: &Scene, contract: &Contract, h: f64) -> Option<Box<Self>> {
        let Balance::Theta(_) = contract.balance else { return None };
        let none = vec![0.0; scene.system.degrees_of_freedom()];
        Some(Box::new(Self { jumps: LoadJumps::new(scene, contract.balance, h), none }))
    }

    /// What the loads explain of the extra force of `step`, whose length on the grid is `h` (s), N.
    pub fn force<'a>(&'a mut self, step: &Step<'a>, h: f64) -> &'a [f64] {
        let length = match step.path {
            Path::Grid | Path::OneRestitution => h,
            Path::Part { length } => length,
            Path::Exact(_) | Path::Series(_) | Path::Handed { .. } => return step.extra,
        };
        match &mut self.jumps {
            Some(jumps) => jumps.force_within((step.start, step.end), length, None),
            None => &self.none,
        }
    }
}
