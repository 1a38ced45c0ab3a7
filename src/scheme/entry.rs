//! What is known of each scheme beside its rule. Refusals, the table of schemes in README.md,
//! `explain`, notes and comparisons are made from these entries.

use crate::error::names;

/// How a scheme treats walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SchemeKind {
    /// Finds the instants of contact; nothing is discretised.
    Exact,
    /// Solves a quadratic programme in every step that meets a wall.
    Qp,
    /// Replaces the walls by springs.
    Penalty,
}

names!(SchemeKind, Exact => "exact", Qp => "QP", Penalty => "penalty");

/// The restitution that a scheme realises at rigid walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Realised {
    /// That of each wall.
    PerWall,
    /// 0, whatever the walls say.
    Zero,
    /// That of the springs in their place.
    BySprings,
    /// Any, by the phase of each impact within its step.
    ByChance,
}

/// A part of scenes that not every scheme steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// The scheme steps scenes with it; at round supports by this law, in words that follow the
    /// scheme's name.
    Stepped(&'static str),
    /// It refuses them, for this reason; what is accepted in its place follows from the other
    /// schemes' entries.
    Refused(&'static str),
}

/// What one scheme is, and which scenes it steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SchemeEntry {
    /// Its name, in case files and on the command line.
    pub name: &'static str,
    /// The keys of its settings.
    pub settings: &'static [&'static str],
    /// The default of its setting, in words; empty without.
    pub default: &'static str,
    /// How it treats walls.
    pub kind: SchemeKind,
    /// The restitution that it realises.
    pub restitution: Realised,
    /// The same in words.
    pub realises: &'static str,
    /// What it is for.
    pub purpose: &'static str,
    /// The order of convergence that it keeps through impacts, whatever their restitution; of a
    /// penalty with any integrator, against its own springs. `None` for a scheme without a step.
    pub order: Option<u32>,
    /// Where it fails.
    pub fails: &'static str,
    /// Rigid round supports.
    pub round: Coverage,
    /// Elastic round supports.
    pub elastic_round: Coverage,
    /// Friction.
    pub friction: Coverage,
    /// Friction at elastic round supports.
    pub elastic_round_friction: Coverage,
}

/// Why a scheme without a law of friction refuses it.
pub(super) const NO_LAW_OF_FRICTION: &str = "this scheme has no law of friction";

/// Why a scheme that bounds displacements refuses friction.
pub(super) const NO_SPEED_TO_STICK_AT: &str =
    "a bound on the displacement leaves a contact no velocity at which it could stick";

/// Why a scheme that gains or loses energy on a circle refuses round supports.
pub(super) const NO_ENERGY_ON_A_CIRCLE: &str = "this scheme does not keep the energy of a body in a round hole";

/// Why a scheme refuses elastic round supports through whose law it cannot step.
pub(super) const NO_LAW_OF_RINGS: &str = "this scheme has no law of an elastic round support";
