//! The restitution that a scheme realises in one free impact, in closed form where there is one.
//!
//! A free particle reaches one wall after the fraction τ of a step. κ = h²k_w/m measures the spring
//! of a penalty.

use crate::scheme::{Integrator, Scheme};

/// The restitution that `scheme` realises at the phase `tau` in [0, 1), for a rigid wall of
/// restitution `e` or a penalty spring of `kappa` = h²k_w/m; `None` where no closed form is known
/// here.
///
/// - moreau-jean, located, paoli-schatzman, generalized-alpha and event: e at every phase;
///   implicit-euler: 0.
/// - newmark: 3 − 4τ for τ < ⅔, one step on the wall; 8τ − 5 beyond, two steps.
/// - discrete gradient: 1, it keeps the energy of the spring.
/// - implicit Euler on the spring at κ = 1: s⁺ = (2s − s⁻)/2 turns (s⁻, s) into half of itself in
///   two steps that leave the wall, hence ¼ at every phase. Central difference at κ = 1: s⁺ = s −
///   s⁻ reverses the motion exactly, 1.
#[must_use]
pub fn restitution(scheme: &Scheme, e: f64, kappa: Option<f64>, tau: f64) -> Option<f64> {
    match *scheme {
        Scheme::MoreauJean { .. }
        | Scheme::Located
        | Scheme::PaoliSchatzman
        | Scheme::GeneralizedAlpha { .. }
        | Scheme::Event => Some(e),
        Scheme::ImplicitEuler => Some(0.0),
        Scheme::Newmark if tau < 2.0 / 3.0 => Some(3.0 - 4.0 * tau),
        Scheme::Newmark => Some(8.0 * tau - 5.0),
        Scheme::Penalty { integrator, .. } => match integrator {
            Integrator::DiscreteGradient => Some(1.0),
            Integrator::ImplicitEuler if kappa == Some(1.0) => Some(0.25),
            Integrator::CentralDifference if kappa == Some(1.0) => Some(1.0),
            _ => None,
        },
    }
}
