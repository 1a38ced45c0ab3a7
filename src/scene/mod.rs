//! The scene that is simulated: a linear system, its walls, its loads, its initial state and its
//! duration.
//!
//! # Files
//!
//! What is simulated: `system.rs` (M, C, K), `structure.rs` (the matrices of several degrees of
//! freedom), `shared.rs` (these matrices checked once, with the factor of M, and shared by all
//! users), `checked.rs` (a validated scene), `wall.rs`, `law.rs` (all that differs between rigid,
//! elastic and penalised walls), `planes.rs` (a structure doubled into two planes, and directions
//! there), `support.rs` (walls around a place), `flats.rs` (flats around one), `slider.rs` (places
//! that rub under a known force), `friction.rs` (coefficients of friction), `load.rs`, `table.rs`
//! (a force sampled over time), `loads.rs` (their sum over degrees of freedom), `forcing.rs` and
//! `grid_forcing.rs` (over one, and at the instants of a grid), `forcing_period.rs` (the period of
//! all loads), `random/` (random forces as tables), `turbulence/` (random forces along a line, on
//! modes), `fluid_elastic.rs` (the stability of a tube in that flow), `held.rs` (a structure held
//! at places), `clear.rs` (a start moved out of walls), `gap.rs` (the length that residuals are
//! told in), `motion_length.rs` (that of scenes whose walls stand where they start), `function.rs`,
//! `scales.rs` (frequencies, and the mass that a wall feels), `scene_key.rs` (the path of a number
//! of a scene), `row.rs` (a location on a structure, as weights of degrees of freedom), `builders/`
//! (chains, bars, tubes, modal data), `matrices/` (read from text), `condensation/` (degrees of
//! freedom without mass), `damping.rs`, `modal/` (modes, and scenes reduced to them); `validate.rs`
//! is the only place that decides which values are valid.

mod builders;
mod checked;
mod clear;
mod condensation;
mod damping;
mod flats;
mod fluid_elastic;
mod forcing;
mod forcing_period;
mod friction;
mod function;
mod gap;
mod grid_forcing;
mod held;
mod law;
mod load;
mod loads;
pub mod matrices;
mod modal;
mod motion_length;
mod planes;
mod random;
mod row;
mod scales;
mod scene_key;
mod shared;
mod slider;
mod structure;
mod support;
mod system;
mod table;
mod turbulence;
mod validate;
mod wall;

pub use builders::{
    Bar, BarEnd, Beam, BeamEnd, BeamSection, Chain, MOST_ELEMENTS, MassMatrix, ModalData, ModalPoint, SectionFault,
};
pub(crate) use checked::Checked;
pub use condensation::Condensation;
pub use damping::Damping;
pub use flats::{Flat, Flats, MOST_FLATS};
pub use fluid_elastic::{Connors, FlowMargin, FlowPiece, FlowTube, FluidElastic};
pub use forcing::{Forcing, Harmonic};
pub(crate) use forcing_period::{forcing_period, frequencies};
pub use friction::FrictionCoefficients;
pub use function::TimeFunction;
pub(crate) use grid_forcing::GridForcing;
pub use law::{WallLaw, WallSpring};
pub use load::{Load, LoadKind};
pub(crate) use loads::LastPieces;
pub use loads::Loads;
pub use modal::{MOST_DENSE, MOST_MODES, Modes, Reduction, WallTruncation};
pub use planes::{PlaneRows, heading};
pub use random::{Density, RandomForce, Scatter};
pub(crate) use row::distinct;
pub use row::{Probe, Row};
pub use scene_key::SceneKey;
pub use shared::SharedStructure;
pub use slider::Slider;
pub use structure::Structure;
#[cfg(feature = "case")]
pub(crate) use structure::of_size;
pub use support::{Hole, Support};
pub use system::{Oscillator, System};
pub(crate) use system::{finite, nonnegative, positive};
pub use table::Table;
pub use turbulence::{Turbulence, TurbulenceSpectrum};
#[cfg(test)]
pub(crate) use validate::counted;
pub use wall::{Face, Side, Wall};

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Displacements and velocities at one instant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// q, m; one value per degree of freedom.
    pub q: Vec<f64>,
    /// q̇, m/s; one value per degree of freedom.
    pub v: Vec<f64>,
}

/// M q̈ + C q̇ + K q = f(t) + Gᵀ r(t), bounded by walls, from an initial state over a duration.
///
/// ```
/// use signorini::{Load, Scene, Wall};
///
/// // 1 kg, 0.2 N s/m, 100 N/m between rigid walls at ±5 mm, driven by 3 sin(2π 5 t) N, started at
/// // −1 mm with 0.1 m/s.
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///     .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0))
///     .with_initial(&[-1e-3], &[0.1])
///     .with_duration(2.0);
/// scene.validate()?; // every run does this first
/// assert_eq!(scene.gap_scale(), 5e-3);
///
/// // What makes no sense is refused, with what would be accepted: here a start behind a wall.
/// let refused = scene.with_initial(&[6e-3], &[0.0]).validate().unwrap_err();
/// assert!(refused.to_string().contains("at most 0.005"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    /// M, C, K.
    pub system: System,
    /// The walls; results name them.
    pub walls: Vec<Wall>,
    /// The supports around places that move in two planes: groups of walls; empty in one plane.
    #[serde(default)]
    pub supports: Vec<Support>,
    /// The loads; they add up.
    pub loads: Vec<Load>,
    /// Displacements and velocities that are recorded.
    pub probes: Vec<Probe>,
    /// Times at which the states of the probes are kept beside the rows, s, increasing; those after
    /// the end are not reached.
    #[serde(default)]
    pub output_times: Vec<f64>,
    /// The state before any impulse at t = 0.
    pub initial: State,
    /// Duration, s.
    pub duration: f64,
}

impl Scene {
    /// An oscillator (kg, N s/m, N/m) at rest at 0, without walls or loads, for one second.
    #[must_use]
    pub fn oscillator(mass: f64, damping: f64, stiffness: f64) -> Self {
        let system = System::Oscillator(Oscillator { mass, damping, stiffness });
        Self { probes: vec![Probe { name: String::new(), at: Row::dof(0) }], ..Self::at_rest(system) }
    }

    /// A structure at rest at 0, without walls, loads or probes, for one second. What is to be
    /// recorded of its motion is said by [`Scene::with_probe`].
    #[must_use]
    pub fn structure(structure: impl Into<SharedStructure>) -> Self {
        Self::at_rest(System::Structure(structure.into()))
    }

    /// `system` at rest at 0 with nothing beside it, for one second.
    pub(crate) fn at_rest(system: System) -> Self {
        let rest = vec![0.0; system.degrees_of_freedom()];
        Self {
            system,
            walls: Vec::new(),
            supports: Vec::new(),
            loads: Vec::new(),
            probes: Vec::new(),
            output_times: Vec::new(),
            initial: State { q: rest.clone(), v: rest },
            duration: 1.0,
        }
    }

    /// The scene with one more wall.
    #[must_use]
    pub fn with_wall(mut self, wall: Wall) -> Self {
        self.walls.push(wall);
        self
    }

    /// The scene with one more probe: the displacement and velocity of `at` are recorded under
    /// `name`.
    #[must_use]
    pub fn with_probe(mut self, name: &str, at: Row) -> Self {
        self.probes.push(Probe { name: name.to_owned(), at });
        self
    }

    /// The scene with one more load.
    #[must_use]
    pub fn with_load(mut self, load: Load) -> Self {
        self.loads.push(load);
        self
    }

    /// The scene with initial displacements (m) and velocities (m/s), one of each per degree of
    /// freedom.
    #[must_use]
    pub fn with_initial(mut self, q: &[f64], v: &[f64]) -> Self {
        self.initial = State { q: q.to_vec(), v: v.to_vec() };
        self
    }

    /// The scene with the states of its probes at `times` (s, increasing, from 0 to its end), which
    /// [`Trajectory::output`](crate::Trajectory::output) has beside the rows:
    ///
    /// ```
    /// use signorini::{Options, Scene, Scheme, Wall, run};
    ///
    /// // Thrown up at 2 m/s under a lid, 0.1 m above, it is back at 0 after 0.1 s.
    /// let scene = Scene::oscillator(1.0, 0.0, 0.0)
    ///     .with_wall(Wall::upper("lid", 0.1))
    ///     .with_initial(&[0.0], &[2.0])
    ///     .with_output_times(&[0.025, 0.05, 0.07]);
    /// let exact = run(&scene, &Scheme::Event, &Options::with_step(0.01))?;
    /// let states = exact.trajectory.output();
    /// assert_eq!(states.displacement[0], [0.05, 0.1, 0.06]);
    /// // Right-continuous: after the impact at 0.05 s.
    /// assert_eq!(states.velocity[0], [2.0, -2.0, -2.0]);
    /// # Ok::<(), signorini::Error>(())
    /// ```
    #[must_use]
    pub fn with_output_times(mut self, times: &[f64]) -> Self {
        self.output_times = times.to_vec();
        self
    }

    /// The output times up to the end, s.
    pub(crate) fn reached_output_times(&self) -> &[f64] {
        let reached = self.output_times.partition_point(|&time| time <= self.duration);
        self.output_times.get(..reached).unwrap_or_default()
    }

    /// The scene over another duration (s).
    #[must_use]
    pub fn with_duration(mut self, duration: f64) -> Self {
        self.duration = duration;
        self
    }

    /// The scene of another `system`, the same structure in other coordinates, where `row` turns
    /// each row into that of the same place there; the initial state stays as it is.
    fn carried(&self, system: System, mut row: impl FnMut(&Row) -> Row) -> Self {
        let mut scene = Self { system, ..self.clone() };
        scene.walls.iter_mut().for_each(|wall| *wall = wall.carried(&mut row));
        scene.supports.iter_mut().for_each(|support| *support = support.carried(&mut row));
        scene.loads.iter_mut().for_each(|load| load.at = row(&load.at));
        scene.probes.iter_mut().for_each(|probe| probe.at = row(&probe.at));
        scene
    }

    /// The scene with one more support of these walls, which follow the scene's; the place and the
    /// centre are those of the support.
    #[must_use]
    pub fn with_support(mut self, name: &str, at: PlaneRows, centre: [f64; 2], walls: Vec<Wall>) -> Self {
        let first = self.walls.len();
        let walls_of = first..first + walls.len();
        self.walls.extend(walls);
        self.supports.push(Support { name: name.to_owned(), at, centre, walls: walls_of });
        self
    }

    /// Frequencies of the harmonic loads, Hz, in the order of the loads.
    pub(crate) fn harmonic_frequencies(&self) -> impl Iterator<Item = f64> {
        self.loads.iter().filter_map(|load| match load.kind {
            LoadKind::Harmonic { frequency, .. } => Some(frequency),
            _ => None,
        })
    }

    /// Index of the wall of that name.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn wall_index(&self, name: &str) -> Result<usize> {
        self.walls.iter().position(|w| w.name == name).ok_or_else(|| Error::Unknown {
            kind: "wall",
            name: name.to_owned(),
            known: self.walls.iter().map(|w| w.name.clone()).collect(),
        })
    }

    /// The first wall whose force is not linear in the depth, which neither a quadratic programme
    /// nor the exact motion takes; `None` if all are rigid or elastic.
    pub(crate) fn nonlinear_wall(&self) -> Option<&Wall> {
        self.walls.iter().find(|wall| !wall.law.is_linear())
    }

    /// The first wall whose force jumps where a contact begins, since it has a dashpot.
    pub(crate) fn dashpot_wall(&self) -> Option<&Wall> {
        let jumps = |wall: &&Wall| matches!(wall.law, WallLaw::Elastic { damping, .. } if damping > 0.0);
        self.walls.iter().find(jumps)
    }

    /// True for one degree of freedom whose walls stand on it directly: schemes on a grid then
    /// compute with numbers. A wall behind a lever makes the oscillator a structure of 1 × 1
    /// matrices.
    pub(crate) fn is_line(&self) -> bool {
        matches!(self.system, System::Oscillator(_)) && self.walls.iter().all(|wall| *wall.row() == Row::dof(0))
    }
}
