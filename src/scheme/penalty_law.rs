//! The springs that replace rigid walls in a penalty run, and the integrators.

use crate::error::{Error, Result, names};
use crate::scene::{Scene, Side, Wall, WallLaw, nonnegative, positive};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The spring that replaces every rigid wall of a scene in a penalty run. Elastic walls stay as
/// they are.
///
/// Both springs conserve energy (except for the damping of the linear one). The stiffer they are,
/// the closer to rigid walls of restitution 1, whatever restitution the walls have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum PenaltyLaw {
    /// No spring: every wall keeps its own law, and none may be rigid.
    None,
    /// The φ² law: energy φ²/(2ε) with φ = (u − g_u)(u − g_l) > 0. Needs an upper and a lower wall.
    Quartic {
        /// ε, m³/N.
        epsilon: f64,
    },
    /// A linear spring, with a dashpot that never pulls.
    Linear {
        /// N/m.
        stiffness: f64,
        /// N s/m.
        damping: f64,
    },
}

impl PenaltyLaw {
    /// The law that `wall`, one of `walls`, has in a penalty run: its own unless it is rigid.
    ///
    /// The φ² law spans from the wall to the nearest wall on the other side of the same row; of a
    /// round wall its diameter.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the φ² law finds no wall on the other side, or none a positive
    /// distance away.
    pub fn at(&self, wall: &Wall, walls: &[Wall]) -> Result<WallLaw> {
        match *self {
            _ if !wall.law.is_rigid() => Ok(wall.law),
            Self::None => Err(Error::invalid(
                "setting of penalty",
                "neither epsilon nor stiffness",
                format!("one of the two, for the spring in place of the rigid wall {:?}", wall.name),
            )),
            Self::Linear { stiffness, damping } => Ok(WallLaw::Elastic { stiffness, damping }),
            Self::Quartic { epsilon } if wall.is_round() => {
                Ok(WallLaw::Quartic { epsilon, span: 2.0 * wall.position() })
            }
            Self::Quartic { epsilon } => {
                let span = span(wall, walls).ok_or_else(|| {
                    let facing = if wall.side() == Side::Upper { "a lower" } else { "an upper" };
                    Error::invalid(
                        "epsilon",
                        format!("{epsilon:e} with nothing facing the wall {:?}", wall.name),
                        format!(
                            "{facing} wall a positive distance from it, or the linear penalty: stiffness, in N/m, \
                             in place of epsilon"
                        ),
                    )
                })?;
                Ok(WallLaw::Quartic { epsilon, span })
            }
        }
    }

    /// True for a spring without damping, which conserves energy.
    pub(crate) fn is_lossless(&self) -> bool {
        !matches!(*self, Self::Linear { damping, .. } if damping > 0.0)
    }

    /// Checks the numbers, and that `scene` has rigid walls or round holes to replace; not whether
    /// the scheme takes the scene.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming `epsilon`, `stiffness` or `damping`.
    pub fn validate(&self, scene: &Scene) -> Result<()> {
        let (key, value) = match *self {
            Self::None => return scene.walls.iter().try_for_each(|wall| self.at(wall, &scene.walls).map(|_| ())),
            Self::Quartic { epsilon } => positive("epsilon", epsilon).map(|()| ("epsilon", epsilon))?,
            Self::Linear { stiffness, damping } => {
                positive("stiffness", stiffness)?;
                nonnegative("damping", damping)?;
                ("stiffness", stiffness)
            }
        };
        let walls = &scene.walls;
        if !walls.iter().any(|wall| wall.law.is_rigid()) {
            let found = format!("{value:e}, and no wall or support is rigid");
            return Err(Error::invalid(key, found, "a scene with a rigid wall for the penalty to stand in for"));
        }
        // Where there is friction no value of the law is at fault: the scheme refuses the scene.
        let smooth = walls.iter().filter(|wall| !wall.friction.acts());
        smooth.map(|wall| self.at(wall, walls)).try_for_each(|law| law.map(|_| ()))
    }
}

/// Distance from `wall` to the nearest wall that faces it on its row, m; `None` unless it is
/// positive.
fn span(wall: &Wall, walls: &[Wall]) -> Option<f64> {
    let facing = walls.iter().filter(|other| other.side() != wall.side() && other.row() == wall.row());
    facing
        .map(|other| wall.side().sign() * (other.position() - wall.position()))
        .reduce(f64::min)
        .filter(|span| *span > 0.0)
}

impl fmt::Display for PenaltyLaw {
    /// `epsilon=1e-9`, `stiffness=1e8` or `stiffness=1e8,damping=2e1`; empty without a spring.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::None => Ok(()),
            Self::Quartic { epsilon } => write!(f, "epsilon={epsilon:e}"),
            Self::Linear { stiffness, damping: 0.0 } => write!(f, "stiffness={stiffness:e}"),
            Self::Linear { stiffness, damping } => write!(f, "stiffness={stiffness:e},damping={damping:e}"),
        }
    }
}

impl Scene {
    /// The scene with every rigid wall and round hole replaced by the penalty `law`; elastic ones
    /// stay.
    ///
    /// # Errors
    /// As [`PenaltyLaw::at`], and for numbers that make no sense.
    pub fn penalised(&self, law: PenaltyLaw) -> Result<Self> {
        let mut scene = self.clone();
        for (wall, original) in scene.walls.iter_mut().zip(&self.walls) {
            wall.law = law.at(original, &self.walls)?;
            wall.validate()?;
        }
        Ok(scene)
    }
}

/// How a penalty run advances in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Integrator {
    /// The trapezoidal rule: order 2, gains energy once the wall is stiffer than the step resolves.
    Trapezoidal,
    /// Implicit Euler: order 1, damps; the effective restitution is below 1 and depends on the
    /// step.
    ImplicitEuler,
    /// Central difference: explicit, order 2, unstable once the wall is stiffer than the step
    /// resolves.
    CentralDifference,
    /// The discrete gradient: order 2, conserves the energy of the penalised system at any step.
    #[default]
    DiscreteGradient,
}

names!(Integrator: "integrator",
    Trapezoidal => "trapezoidal", ImplicitEuler => "implicit-euler", CentralDifference => "central-difference",
    DiscreteGradient => "discrete-gradient");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Row, Slider};

    #[test]
    fn names_of_integrators_round_trip() {
        for integrator in Integrator::ALL {
            assert_eq!(integrator.to_string().parse::<Integrator>(), Ok(integrator));
        }
        assert!("leapfrog".parse::<Integrator>().is_err_and(|e| e.to_string().contains("discrete-gradient")));
    }

    #[test]
    fn the_quartic_law_spans_to_the_nearest_facing_wall_and_leaves_elastic_walls_alone() {
        let walls = [
            Wall::upper("upper", 0.5),
            Wall::lower("near", -0.25).with_elasticity(100.0, 0.0),
            Wall::lower("far", -0.5),
        ];
        let law = PenaltyLaw::Quartic { epsilon: 1e-9 };
        let spans: Vec<_> = walls.iter().map(|w| law.at(w, &walls)).collect();
        assert_eq!(spans[0], Ok(WallLaw::Quartic { epsilon: 1e-9, span: 0.75 }));
        assert_eq!(spans[1], Ok(walls[1].law));
        assert_eq!(spans[2], Ok(WallLaw::Quartic { epsilon: 1e-9, span: 1.0 }));
        let scene = |wall: &Wall| Scene::oscillator(1.0, 0.0, 1.0).with_wall(wall.clone());
        for (wall, facing) in [(&walls[0], "a lower wall"), (&walls[2], "an upper wall")] {
            let error = law.validate(&scene(wall)).unwrap_err().to_string();
            assert!(error.contains("stiffness") && error.contains(facing), "{error}");
        }
        let elastic = law.validate(&scene(&walls[1])).unwrap_err().to_string();
        assert!(elastic.starts_with("epsilon is 1e-9, and no wall or support is rigid; expected"), "{elastic}");
        // A slider has no wall facing it: the law is not at fault.
        let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 1.0, friction: 0.2.into() };
        assert_eq!(law.validate(&scene(&walls[1]).with_slider(&slider).unwrap()), Ok(()));
        assert!(PenaltyLaw::Linear { stiffness: 1e8, damping: 0.0 }.validate(&scene(&walls[0])).is_ok());
        let at = crate::scene::PlaneRows::doubled(&crate::scene::Row::dof(0), 1);
        let round = Wall::round("hole", at, 0.5);
        assert_eq!(law.at(&round, &walls), Ok(WallLaw::Quartic { epsilon: 1e-9, span: 1.0 }));
        let ring = round.with_elasticity(100.0, 0.0);
        assert_eq!(law.at(&ring, &walls), Ok(ring.law));
    }

    #[test]
    fn walls_at_one_place_have_no_span_between_them() {
        let law = PenaltyLaw::Quartic { epsilon: 1e-9 };
        let behind = |position: f64| [Wall::upper("upper", 0.5), Wall::lower("lower", position)];
        assert!(behind(0.5).iter().all(|wall| law.at(wall, &behind(0.5)).is_err()));
        assert!(behind(0.75).iter().all(|wall| law.at(wall, &behind(0.75)).is_err()));
        assert!(behind(0.25).iter().all(|wall| law.at(wall, &behind(0.25)).is_ok()));
    }

    #[test]
    fn only_a_dashpot_loses_energy() {
        let linear = |damping: f64| PenaltyLaw::Linear { stiffness: 1e8, damping };
        assert!(linear(0.0).is_lossless() && !linear(1e-3).is_lossless());
        assert!(PenaltyLaw::Quartic { epsilon: 1e-9 }.is_lossless());
    }
}
