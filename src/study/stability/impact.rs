//! One free impact: the restitution that a scheme realises, as a function of the position of the
//! contact within its step.
//!
//! A free particle (no spring, no load) flies at 1 m/s towards one wall and would reach it after
//! the fraction τ of a step. Departure speed over approach speed depends on the scheme, τ, e and,
//! for a penalty, κ = h²k_w/m only, so one map holds for every mass and step.

use super::theory;
use crate::error::Result;
use crate::scene::{Scene, Wall};
use crate::scheme::{Integrator, PenaltyLaw, Scheme, Stepper};
use crate::step::Path;
use rayon::prelude::*;

/// κ = h²k_w/m of the maps: well resolved, one radian per step, beyond one radian, and a wall far
/// too stiff for the step.
pub const KAPPAS: [f64; 4] = [0.01, 1.0, 3.0, 1e4];
/// θ of the moreau-jean maps.
pub const THETAS: [f64; 3] = [0.5, 0.75, 1.0];
/// Phases of a map: midpoints of equal parts of the step, so that no contact falls exactly on a
/// grid point.
pub const PHASES: usize = 200;

/// Free steps before the impact: enough for multistep schemes to forget the start.
const RUN_UP: f64 = 2.0;
/// Number of steps after which a body that has not left is taken to stay. At κ = 0.01 a contact
/// lasts 32.
const MOST_STEPS: u64 = 400;
/// Number of successive free steps after which the body has left.
const LEFT: u32 = 2;

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// τ, the fraction of the step that has passed at contact, in [0, 1).
    pub phase: f64,
    /// Departure speed over approach speed, ≥ 0; 0 for a body that stays.
    pub restitution: f64,
    /// Deepest position behind the wall at the end of a step, over h·v.
    pub depth: f64,
    /// Steps in which the wall pushed.
    pub contact_steps: u64,
    /// The closed form, where there is one.
    pub theory: Option<f64>,
}

/// The impacts of one scheme over all phases.
#[derive(Debug, Clone)]
pub struct ImpactMap {
    /// The scheme; for a penalty, with the stiffness that κ gives.
    pub scheme: Scheme,
    /// Name in tables and legends, without the mass and the step.
    pub label: String,
    /// κ = h²k_w/m of a penalty.
    pub kappa: Option<f64>,
    /// One impact per phase, or why it failed.
    pub impacts: Vec<Result<Impact>>,
}

impl ImpactMap {
    /// The impacts that succeeded.
    pub fn measured(&self) -> impl Iterator<Item = &Impact> {
        self.impacts.iter().flatten()
    }

    /// Smallest and largest restitution over the phases; `None` if every impact failed.
    #[must_use]
    pub fn range(&self) -> Option<(f64, f64)> {
        let e = || self.measured().map(|i| i.restitution);
        Some((e().reduce(f64::min)?, e().reduce(f64::max)?))
    }
}

/// The maps of all schemes for a body of `mass` (kg), steps of `h` (s) and a rigid wall of
/// restitution `e`.
#[must_use]
pub fn maps(mass: f64, h: f64, e: f64) -> Vec<ImpactMap> {
    let mut schemes: Vec<(Scheme, String, Option<f64>)> = Vec::new();
    let rigid = [Scheme::Event, Scheme::Located, Scheme::PaoliSchatzman].into_iter();
    let jean = THETAS.into_iter().map(|theta| Scheme::MoreauJean { theta });
    let others = [Scheme::GeneralizedAlpha { rho: 0.8 }, Scheme::ImplicitEuler, Scheme::Newmark];
    for scheme in rigid.chain(jean).chain(others) {
        schemes.push((scheme, scheme.to_string(), None));
    }
    for kappa in KAPPAS {
        for integrator in Integrator::ALL {
            let law = PenaltyLaw::Linear { stiffness: kappa * mass / (h * h), damping: 0.0 };
            let label = format!("penalty, {integrator}, κ = {kappa}");
            schemes.push((Scheme::Penalty { law, integrator }, label, Some(kappa)));
        }
    }
    let map = |(scheme, label, kappa)| {
        let phase = |i: usize| (i as f64 + 0.5) / PHASES as f64;
        let impacts = (0..PHASES).map(|i| impact(&scheme, kappa, mass, h, e, phase(i))).collect();
        ImpactMap { scheme, label, kappa, impacts }
    };
    schemes.into_par_iter().map(map).collect()
}

/// Restitutions that differ by less than this are the same.
const SAME: f64 = 1e-9;

/// The maps in groups that have the same restitution at every phase: of one κ each, in their order.
#[must_use]
pub fn alike(maps: &[ImpactMap]) -> Vec<Vec<&ImpactMap>> {
    let same = |a: &ImpactMap, b: &ImpactMap| {
        let mut pairs = a.impacts.iter().zip(&b.impacts);
        a.kappa == b.kappa
            && pairs.all(|pair| match pair {
                (Ok(a), Ok(b)) => (a.restitution - b.restitution).abs() < SAME,
                _ => false,
            })
    };
    let mut groups: Vec<Vec<&ImpactMap>> = Vec::new();
    for map in maps {
        match groups.iter_mut().find(|group| group.first().is_some_and(|first| same(first, map))) {
            Some(group) => group.push(map),
            None => groups.push(vec![map]),
        }
    }
    groups
}

/// One impact of a body of `mass` (kg) by `scheme` with steps of `h` (s) on a wall of restitution
/// `e`, which it would reach after the fraction `phase` of a step.
///
/// # Errors
/// Errors of the scheme: invalid values, or a state that became NaN or infinite.
pub fn impact(scheme: &Scheme, kappa: Option<f64>, mass: f64, h: f64, e: f64, phase: f64) -> Result<Impact> {
    let wall = Wall::upper("wall", 0.0).with_restitution(e);
    let start = -(RUN_UP + phase) * h;
    let scene = Scene::oscillator(mass, 0.0, 0.0).with_wall(wall).with_initial(&[start], &[1.0]);
    let mut stepper = Stepper::new(&scene.with_duration(MOST_STEPS as f64 * h), scheme, h)?;
    let (mut depth, mut contact_steps, mut free) = (0.0_f64, 0, 0);
    let mut speed = 1.0_f64;
    for _ in 0..MOST_STEPS {
        let step = stepper.step()?;
        let at = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        depth = depth.max(at(step.q) / h);
        // A part of a step shows the velocity after an impact at its end.
        speed = at(if matches!(step.path, Path::Part { .. }) { step.v } else { step.velocity_after });
        let pushed = step.impulse.iter().any(|&p| p != 0.0);
        contact_steps += u64::from(pushed);
        free = if pushed || contact_steps == 0 { 0 } else { free + 1 };
        if free >= LEFT && speed < 0.0 {
            break;
        }
    }
    let theory = theory::restitution(scheme, e, kappa, phase);
    Ok(Impact { phase, restitution: (-speed).max(0.0), depth, contact_steps, theory })
}

/// The restitution used for the maps of a scene: that of its first rigid wall, 1 where it has none.
#[must_use]
pub fn wall_restitution(scene: &Scene) -> f64 {
    let rigid = |wall: &Wall| wall.law.restitution();
    scene.walls.iter().find_map(rigid).unwrap_or(1.0)
}
