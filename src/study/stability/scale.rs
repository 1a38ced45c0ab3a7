//! The frequency by which the steps of a scene are measured.

use crate::scene::{Scene, System};
use std::f64::consts::TAU;

/// A frequency with fewer periods in the duration than this is not used: the body hardly begins to
/// swing.
const SLOWEST: f64 = 0.01;
/// A first contact after less than a thousandth of the duration is not used either: the body starts
/// at the wall.
const FASTEST_FLIGHT: f64 = 1e3;

/// Origin of the circular frequency of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// √(k/m) of the oscillator; with several degrees of freedom the slowest natural frequency.
    Spring,
    /// The slowest sine load, where only the walls hold the body.
    Load,
    /// 2π over the time from the start to the first contact, where there is no sine load either.
    Flight,
    /// 2π over the duration, where none of these exists.
    Duration,
}

impl Origin {
    /// Description for axis labels and messages.
    #[must_use]
    pub fn describe(self) -> &'static str {
        match self {
            Self::Spring => "ω = √(k/m)",
            Self::Load => "ω of the slowest sine load",
            Self::Flight => "ω = 2π / time to the first contact",
            Self::Duration => "ω = 2π / duration",
        }
    }
}

/// A circular frequency and its origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// ω, rad/s.
    pub omega: f64,
    /// Its origin.
    pub origin: Origin,
    /// Smallest mass that a wall feels, kg.
    pub mass: f64,
}

/// Share of the period within which touches of one wall count as one contact.
const JOINED: f64 = 1.0 / 32.0;

impl Scale {
    /// The time within which touches of one wall by a vibrating structure count as one contact, s.
    #[must_use]
    pub fn joined(&self) -> f64 {
        JOINED * TAU / self.omega
    }

    /// The scale of `scene`; `first_contact` (s) is used where neither spring nor sine sets one.
    #[must_use]
    pub fn of(scene: &Scene, first_contact: Option<f64>) -> Self {
        let total = total_mass(&scene.system);
        let mass = scene.wall_masses().into_iter().reduce(f64::min).unwrap_or(total);
        let [spring, _] = scene.system.frequencies();
        let sine = scene.harmonic_frequencies().map(|frequency| TAU * frequency);
        let slowest = TAU / scene.duration;
        let flight = first_contact.map(|t| TAU / t).filter(|w| *w < FASTEST_FLIGHT * slowest);
        let candidates = [
            (Some(spring), Origin::Spring),
            (sine.filter(|w| *w > 0.0).reduce(f64::min), Origin::Load),
            (flight, Origin::Flight),
        ];
        let usable = |w: &f64| w.is_finite() && *w > SLOWEST * slowest;
        let found = candidates.into_iter().find_map(|(w, origin)| Some((w.filter(usable)?, origin)));
        let (omega, origin) = found.unwrap_or((slowest, Origin::Duration));
        Self { omega, origin, mass }
    }
}

/// 1ᵀM1, kg.
pub(super) fn total_mass(system: &System) -> f64 {
    let ones = vec![1.0; system.degrees_of_freedom()];
    system.mass_form(&ones, &ones)
}
