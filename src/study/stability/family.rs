//! The schemes of the maps, and the second parameter of each map.

use crate::error::{Error, Result, Subject};
use crate::scene::{Scene, WallLaw};
use crate::scheme::{Integrator, PenaltyLaw, Scheme};
use std::fmt;

/// What is mapped: a scene and the penalties that replace its rigid walls.
#[derive(Debug, Clone, Copy)]
pub struct MapRequest<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The penalty laws; their values are among those of the maps.
    pub laws: &'a [PenaltyLaw],
}

/// Fewest decades of penalty parameters, and the number of values per decade.
const DECADES: f64 = 6.0;
const PER_DECADE: f64 = 2.0;
/// Spacing of restitutions.
const RESTITUTIONS: u32 = 10;

/// One scheme with its second parameter left open: it gives one map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SchemeFamily {
    /// A scheme that treats walls as constraints.
    Constrained(Scheme),
    /// A penalty with this integrator.
    Penalty(Integrator),
}

impl SchemeFamily {
    /// Every family, in the order of tables; generalized-alpha with its default ρ∞.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let constrained = [
            Scheme::MoreauJean { theta: 0.5 },
            Scheme::MoreauJean { theta: 1.0 },
            Scheme::Located,
            Scheme::PaoliSchatzman,
            Scheme::GeneralizedAlpha { rho: 0.8 },
            Scheme::ImplicitEuler,
            Scheme::Newmark,
        ];
        constrained.map(Self::Constrained).into_iter().chain(Integrator::ALL.map(Self::Penalty)).collect()
    }
}

impl fmt::Display for SchemeFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constrained(scheme) => scheme.fmt(f),
            Self::Penalty(integrator) => write!(f, "penalty:integrator={integrator}"),
        }
    }
}

/// The second parameter of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// e of every rigid wall.
    Restitution,
    /// ε of the penalty, m³/N.
    Epsilon,
    /// Stiffness of the penalty spring, N/m.
    PenaltyStiffness,
    /// Stiffness of every elastic wall, N/m, in a scene without rigid walls; dampers are scaled in
    /// proportion.
    WallStiffness,
}

impl Parameter {
    /// The parameter of a family on a case.
    #[must_use]
    pub fn of(family: SchemeFamily, case: MapRequest<'_>) -> Self {
        let walls = &case.scene.walls;
        let quartic = PenaltyLaw::Quartic { epsilon: 1.0 };
        let linear_asked = matches!(case.laws.first(), Some(PenaltyLaw::Linear { .. }));
        match family {
            _ if !walls.iter().any(|w| w.law.is_rigid()) => Self::WallStiffness,
            SchemeFamily::Constrained(_) => Self::Restitution,
            SchemeFamily::Penalty(_) if linear_asked || quartic.validate(case.scene).is_err() => Self::PenaltyStiffness,
            SchemeFamily::Penalty(_) => Self::Epsilon,
        }
    }

    /// The label of an axis.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Restitution => "Restitution e (–)",
            Self::Epsilon => "Penalty parameter ε (m³/N)",
            Self::PenaltyStiffness => "Penalty stiffness (N/m)",
            Self::WallStiffness => "Wall stiffness (N/m)",
        }
    }

    /// The name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Restitution => "restitution",
            Self::Epsilon => "epsilon_m3_per_N",
            Self::PenaltyStiffness => "penalty_stiffness_N_per_m",
            Self::WallStiffness => "wall_stiffness_N_per_m",
        }
    }

    /// The values of the case itself, in its order.
    #[must_use]
    pub fn own(self, case: MapRequest<'_>) -> Vec<f64> {
        let walls = case.scene.walls.iter().map(|w| w.law);
        let laws = case.laws.iter();
        let mut values: Vec<f64> = match self {
            Self::Restitution => walls.filter_map(|l| l.restitution()).collect(),
            Self::Epsilon => laws
                .filter_map(|l| if let PenaltyLaw::Quartic { epsilon } = l { Some(*epsilon) } else { None })
                .collect(),
            Self::PenaltyStiffness => {
                let stiffness =
                    |l: &PenaltyLaw| if let PenaltyLaw::Linear { stiffness, .. } = l { Some(*stiffness) } else { None };
                laws.filter_map(stiffness).collect()
            }
            Self::WallStiffness => walls.filter_map(|law| law.stiffness()).collect(),
        };
        let mut seen = Vec::new();
        values.retain(|v| {
            !seen.contains(v) && {
                seen.push(*v);
                true
            }
        });
        values
    }

    /// The values of a map, increasing, with those of the case among them. For penalties without
    /// values of their own they begin at the stiffness that the wall spring needs to vibrate the
    /// mass as `stiffness` (N/m) would, and go up to 10⁶ times that.
    #[must_use]
    pub fn values(self, case: MapRequest<'_>, stiffness: f64) -> Vec<f64> {
        let own = self.own(case);
        let mut values: Vec<f64> = match self {
            Self::Restitution => (0..=RESTITUTIONS).map(|i| f64::from(i) / f64::from(RESTITUTIONS)).collect(),
            _ => {
                let exponent = |x: f64| x.log10();
                let low = own.iter().copied().map(exponent).reduce(f64::min);
                let high = own.iter().copied().map(exponent).reduce(f64::max);
                let (low, high) = match (low, high) {
                    (Some(low), Some(high)) => (low, high),
                    _ if self == Self::Epsilon => {
                        let span2 = (2.0 * case.scene.gap_scale()).powi(2);
                        ((span2 / stiffness).log10() - DECADES, (span2 / stiffness).log10())
                    }
                    _ => (stiffness.log10(), stiffness.log10() + DECADES),
                };
                let widen = (0.5 * (DECADES - (high - low))).max(0.0);
                let (low, high) = ((PER_DECADE * (low - widen)).floor(), (PER_DECADE * (high + widen)).ceil());
                (low as i32..=high as i32).map(|i| 10_f64.powf(f64::from(i) / PER_DECADE)).collect()
            }
        };
        // Where a grid value differs from one of the case's own only by rounding, the case's own is
        // kept.
        values.retain(|v| !own.iter().any(|o| (v - o).abs() <= 1e-9 * o.abs()));
        values.extend(own);
        values.sort_by(f64::total_cmp);
        values
    }

    /// The scene and scheme of a family at a value of the parameter.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a value that makes no sense.
    pub fn at(self, family: SchemeFamily, value: f64, scene: &Scene) -> Result<(Scene, Scheme)> {
        let mut scene = scene.clone();
        match self {
            Self::Restitution => {
                for wall in scene.walls.iter_mut().filter(|w| w.law.is_rigid()) {
                    wall.law = WallLaw::Rigid { restitution: value };
                }
            }
            Self::WallStiffness => {
                for wall in &mut scene.walls {
                    if let WallLaw::Elastic { stiffness, damping } = &mut wall.law {
                        *damping *= value / *stiffness;
                        *stiffness = value;
                    }
                }
            }
            Self::Epsilon | Self::PenaltyStiffness => {}
        }
        let scheme = match family {
            SchemeFamily::Constrained(scheme) => scheme,
            SchemeFamily::Penalty(integrator) => {
                let law = match self {
                    Self::Epsilon => PenaltyLaw::Quartic { epsilon: value },
                    // In a scene with elastic walls only, there is no rigid wall to replace: the
                    // integrator steps through the elastic walls.
                    _ => PenaltyLaw::Linear { stiffness: value, damping: 0.0 },
                };
                Scheme::Penalty { law, integrator }
            }
        };
        scene.validate()?;
        scheme.validate()?;
        Ok((scene, scheme))
    }
}

/// Refuses a case without walls, and one with round supports or friction.
///
/// # Errors
/// [`Error::Invalid`] for such a case.
pub fn check(case: MapRequest<'_>) -> Result<()> {
    let scene = case.scene;
    if scene.turns_or_rubs() {
        let expected = "walls without friction: the maps compare schemes, and most of them do not step such a scene";
        let slider = scene.walls.iter().enumerate().find(|(index, _)| scene.is_slider(*index));
        let (subject, value) = match slider {
            Some((_, wall)) => (Subject::slider(&wall.name), "a contact with friction"),
            None => (Subject::of("support"), "round or with friction"),
        };
        return Err(Error::invalid(subject, value, expected));
    }
    if let Some(wall) = scene.nonlinear_wall() {
        let expected = "rigid and elastic walls, whose restitution or stiffness the maps vary";
        return Err(Error::invalid(Subject::wall(&wall.name).part("law"), wall.law.kind(), expected));
    }
    if scene.walls.is_empty() {
        return Err(Error::invalid("wall", "missing", "a scene with a wall to hit"));
    }
    Ok(())
}
