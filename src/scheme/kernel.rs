//! Selects the motion that was asked for: a scheme's rule over the space that suits the scene, or
//! the exact motion.

use super::central_difference::CentralDifference;
use super::disks::Disks;
use super::event::Event;
use super::generalized_alpha::GeneralizedAlpha;
use super::grid::Grid;
use super::line::Line;
use super::located::{Located, LocatedPlanar};
use super::matrices::Matrices;
use super::moreau_jean::MoreauJean;
use super::motion::Motion;
use super::paoli_schatzman::PaoliSchatzman;
use super::penalty::{Mean, Penalty};
use super::position::Position;
use super::rule::Rule;
use super::space::Space;
use super::structure_event::StructureEvent;
use super::supports::Supports;
use super::{Integrator, Method, Scheme};
use crate::error::{Error, Result};
use crate::scene::{Checked, Scene};
use crate::step::{QuietSteps, Step};

/// A motion. That of one degree of freedom on a grid is stored without a pointer, so that its steps
/// can be inlined into a caller's loop.
#[derive(Debug)]
#[allow(clippy::large_enum_variant)]
pub(super) enum Kernel {
    Line(Grid<Line>),
    Other(Box<dyn Motion>),
}

/// `scheme` over a space, with steps of `h` seconds. A new scheme is added here.
fn rule<S: Space>(scene: &Scene, Method { scheme, backend }: Method, h: f64) -> Result<Box<dyn Rule<S>>> {
    Ok(match scheme {
        Scheme::ImplicitEuler => Box::new(Position::<S>::new(scene, 1.0, h, backend)?),
        Scheme::Newmark => Box::new(Position::<S>::new(scene, 0.5, h, backend)?),
        Scheme::PaoliSchatzman => Box::new(PaoliSchatzman::<S>::new(scene, h, backend)?),
        Scheme::MoreauJean { theta } => Box::new(MoreauJean::<S>::new(scene, theta, h, backend)?),
        Scheme::Located => Box::new(Located::<S>::new(scene, h, backend)?),
        Scheme::GeneralizedAlpha { .. } => {
            Box::new(GeneralizedAlpha::<S>::new(scene, scheme.contract().balance, h, backend)?)
        }
        Scheme::Penalty { integrator, .. } => match integrator {
            Integrator::Trapezoidal => Box::new(Penalty::<S>::new(scene, 0.5, Mean::Ends, h)?),
            Integrator::ImplicitEuler => Box::new(Penalty::<S>::new(scene, 1.0, Mean::Ends, h)?),
            Integrator::DiscreteGradient => Box::new(Penalty::<S>::new(scene, 0.5, Mean::DiscreteGradient, h)?),
            Integrator::CentralDifference => Box::new(CentralDifference::<S>::new(scene, h)?),
        },
        Scheme::Event => return Err(Error::invalid("scheme", scheme, "a scheme with a step")),
    })
}

/// `scheme` on a scene with round holes or friction that it does not refuse.
fn planar(scene: &Checked, scheme: Scheme, h: f64) -> Result<Box<dyn Motion>> {
    let rigid = scene.holes().all(|hole| hole.law.is_rigid());
    Ok(match scheme {
        Scheme::Event => Box::new(StructureEvent::new(scene.shared(), h)?),
        Scheme::Located => Box::new(LocatedPlanar::new(scene, scheme.contract(), h)?),
        Scheme::MoreauJean { theta } if rigid => Box::new(Supports::new(scene, theta, scheme.contract(), h)?),
        _ => Box::new(Disks::new(scene, scheme.contract(), h)?),
    })
}

fn grid<S: Space>(scene: &Checked, method: Method, h: f64) -> Result<Grid<S>> {
    Grid::new(scene, scene.wall_masses(), rule(scene, method, h)?, method.scheme.contract(), h)
}

impl Kernel {
    /// `method` on `scene` with steps of `step` seconds; for the exact motion, the maximum length
    /// of a step. The scheme takes the scene.
    pub fn new(scene: &Checked, method: Method, step: f64) -> Result<Self> {
        if scene.turns_or_rubs() {
            return Ok(Self::Other(planar(scene, method.scheme, step)?));
        }
        let line = scene.is_line();
        Ok(match method.scheme {
            Scheme::Event if line => Self::Other(Box::new(Event::over(scene, step)?)),
            Scheme::Event => Self::Other(Box::new(StructureEvent::new(scene.shared(), step)?)),
            _ if line => Self::Line(grid(scene, method, step)?),
            _ => Self::Other(Box::new(grid::<Matrices>(scene, method, step)?)),
        })
    }

    /// As [`Motion::advance`].
    #[inline]
    pub fn advance(&mut self, step: u64, extra: Option<&[f64]>) -> Result<()> {
        match self {
            Self::Line(grid) => grid.advance(step, extra),
            Self::Other(motion) => motion.advance(step, extra),
        }
    }

    /// As [`Motion::is_divided`].
    #[inline]
    pub fn is_divided(&self) -> bool {
        match self {
            Self::Line(grid) => grid.is_divided(),
            Self::Other(motion) => motion.is_divided(),
        }
    }

    /// As [`Motion::advance_quiet`].
    pub fn advance_quiet(&mut self, step: u64, until: u64, quiet: Option<&mut QuietSteps>) -> Result<u64> {
        match self {
            Self::Line(grid) => grid.advance_quiet(step, until, quiet),
            Self::Other(motion) => motion.advance_quiet(step, until, quiet),
        }
    }

    /// As [`Motion::step`]. Inlined, so that the compiler leaves out the fields that a caller does
    /// not read.
    #[inline(always)]
    pub fn step(&self, index: u64) -> Step<'_> {
        match self {
            Self::Line(grid) => grid.step(index),
            Self::Other(motion) => motion.step(index),
        }
    }

    /// The motion, for what is not called in every step.
    pub fn motion(&self) -> &dyn Motion {
        match self {
            Self::Line(grid) => grid,
            Self::Other(motion) => &**motion,
        }
    }

    /// The same, to change it.
    pub fn motion_mut(&mut self) -> &mut dyn Motion {
        match self {
            Self::Line(grid) => grid,
            Self::Other(motion) => &mut **motion,
        }
    }
}
