//! Selects the motion that was asked for: a scheme's rule over the space that suits the scene, or
//! the exact motion.

use super::central_difference::CentralDifference;
use super::disks::Disks;
use super::event::Event;
use super::generalized_alpha::GeneralizedAlpha;
use super::grid::Grid;
use super::line::Line;
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
use crate::qp::Backend;
use crate::scene::{Checked, Scene};
use crate::step::{Calm, Step};

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

/// What a scheme without friction expects instead.
const ONE_FOR_FRICTION: &str = "moreau-jean, the one scheme for friction";

/// `scheme` on a scene with round holes or friction. Only moreau-jean has friction; without it the
/// exact motion is known.
fn supported(scene: &Checked, Method { scheme, backend }: Method, h: f64) -> Result<Box<dyn Motion>> {
    if scheme == Scheme::Event {
        if let Some(support) = scene.supports.iter().find(|support| support.friction > 0.0) {
            let found = format!("event, with friction at the support {:?}", support.name);
            let expected = "moreau-jean, or no friction: where a contact sticks, slips or turns round in the middle \
                            of an impact, the exact scheme has no law for it";
            return Err(Error::invalid("scheme", found, expected));
        }
        if let Some(ring) = scene.holes().find(|hole| !hole.law.is_rigid()) {
            let found = format!("event, with the elastic round support {:?}", ring.support.name);
            let expected = "a scheme with a step: the force of an elastic hole has no series of its own";
            return Err(Error::invalid("scheme", found, expected));
        }
        return Ok(Box::new(StructureEvent::new(scene.shared(), h)?));
    }
    if backend != Backend::Auto {
        let expected = "auto: with round supports or friction a step is no quadratic programme, and sweeps over its \
                        contacts solve it";
        return Err(Error::invalid("QP solver", backend, expected));
    }
    let round = scene.holes().next().is_some();
    let ring = scene.holes().find(|hole| !hole.law.is_rigid());
    let rubs = scene.supports.iter().any(|support| support.friction > 0.0);
    if let Scheme::Penalty { integrator, .. } = scheme {
        if rubs {
            return Err(Error::invalid("scheme", scheme, ONE_FOR_FRICTION));
        }
        if integrator == Integrator::DiscreteGradient {
            return Ok(Box::new(Disks::new(scene, scheme.contract(), h)?));
        }
        let expected = "discrete-gradient: of the penalties, only that one keeps energy and angular momentum in a \
                        round hole";
        return Err(Error::invalid("integrator", integrator, expected));
    }
    if let Some(ring) = ring {
        let found = format!("{scheme}, with the elastic round support {:?}", ring.support.name);
        let expected = match scheme {
            Scheme::MoreauJean { .. } | Scheme::ImplicitEuler if rubs => {
                "no friction, or rigid round supports: the normal of an elastic one follows from the step's end"
            }
            Scheme::MoreauJean { .. } | Scheme::ImplicitEuler => {
                return Ok(Box::new(Disks::new(scene, scheme.contract(), h)?));
            }
            _ => "moreau-jean, implicit-euler or penalty, the schemes for elastic round supports",
        };
        return Err(Error::invalid("scheme", found, expected));
    }
    let expected = match scheme {
        Scheme::MoreauJean { theta } => return Ok(Box::new(Supports::new(scene, theta, scheme.contract(), h)?)),
        Scheme::ImplicitEuler | Scheme::GeneralizedAlpha { .. } if !rubs => {
            return Ok(Box::new(Disks::new(scene, scheme.contract(), h)?));
        }
        Scheme::ImplicitEuler | Scheme::GeneralizedAlpha { .. } => {
            "moreau-jean, or no friction: a bound on the displacement leaves a contact no velocity \
             at which it could stick"
        }
        Scheme::PaoliSchatzman | Scheme::Newmark if round => {
            "moreau-jean: this scheme does not keep the energy of a body in a round hole"
        }
        _ => ONE_FOR_FRICTION,
    };
    Err(Error::invalid("scheme", scheme, expected))
}

fn grid<S: Space>(scene: &Checked, method: Method, h: f64) -> Result<Grid<S>> {
    Grid::new(scene, scene.wall_masses(), rule(scene, method, h)?, method.scheme.contract(), h)
}

impl Kernel {
    /// `method` on `scene` with steps of `step` seconds; for the exact motion, the maximum length
    /// of a step.
    pub fn new(scene: &Checked, method: Method, step: f64) -> Result<Self> {
        if scene.turns_or_rubs() {
            return Ok(Self::Other(supported(scene, method, step)?));
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

    /// As [`Motion::glide`].
    pub fn glide(&mut self, step: u64, until: u64, calm: Option<&mut Calm>) -> Result<u64> {
        match self {
            Self::Line(grid) => grid.glide(step, until, calm),
            Self::Other(motion) => motion.glide(step, until, calm),
        }
    }

    /// As [`Motion::flush`].
    pub fn flush(&mut self, tiny: f64) {
        match self {
            Self::Line(grid) => grid.flush(tiny),
            Self::Other(motion) => motion.flush(tiny),
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

    /// As [`Motion::restart`].
    pub fn restart(&mut self, scene: &Scene, time: f64, q: &[f64], v: &[f64]) -> Result<()> {
        match self {
            Self::Line(grid) => grid.restart(scene, time, q, v),
            Self::Other(motion) => motion.restart(scene, time, q, v),
        }
    }
}
