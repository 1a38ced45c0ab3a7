//! The judge: checks every step of a run against the contract of its scheme. It uses the scene and
//! the steps only, no scheme and no QP.
//!
//! | files | what they check or hold |
//! |---|---|
//! | `grid.rs`, `part.rs` | steps on a grid, and their parts |
//! | `corrected.rs`, `previous_step.rs` | steps that predict and correct, and what carries over between them |
//! | `step_motion.rs`, `scratch.rs`, `matrices.rs` | what a step did, the passes over it, its products with M, C and K |
//! | `quiet_steps.rs`, `quiet_scratch.rs` | many steps of one degree of freedom in the same passes |
//! | `wall_step.rs`, `complementarity.rs` | each wall in a step, and what contact laws demand of it |
//! | `row_walls.rs`, `view.rs` | walls by their rows, and rows prepared for products |
//! | `blow_check.rs`, `blows.rs` | loads of no duration |
//! | `round.rs`, `brim.rs`, `disk.rs`, `ring.rs`, `hole_motion.rs`, `place.rs` | round holes |
//! | `friction.rs`, `pushes.rs`, `supports.rs` | friction, impulses in two planes, and what a run keeps of both |
//! | `arc.rs`, `series.rs`, `series_scratch.rs`, `circle.rs`, `quadrature.rs`, `deepest.rs` | exact motion, of structures, in round holes; its integrals and depths |
//! | `energy/` | the energy ledger |
//! | `momentum_sums.rs`, `run_momentum.rs` | the momentum of a whole run |
//! | `own_loads.rs` | the extra force of steps in which no caller adds one |
//! | `walls.rs`, `front.rs`, `balance.rs`, `extent.rs` | what a run shows of its walls and its momentum, and how far it moves |
//! | `noise.rs`, `largest_residual.rs`, `weights.rs`, `scales.rs` | the rounding errors and the reference sizes of residuals |
//! | `verdict.rs`, `finding.rs`, `residuals.rs` | what exceeds both becomes a finding; the residuals as they are told |

mod arc;
mod balance;
mod blow_check;
mod blows;
mod brim;
mod circle;
mod complementarity;
mod corrected;
mod deepest;
mod disk;
mod energy;
mod extent;
mod finding;
mod friction;
mod front;
mod grid;
mod hole_motion;
mod largest_residual;
mod matrices;
mod momentum_sums;
mod noise;
mod own_loads;
mod part;
mod place;
mod previous_step;
mod pushes;
mod quadrature;
mod quiet_scratch;
mod quiet_steps;
mod residuals;
mod ring;
mod round;
mod row_walls;
mod run_momentum;
mod scales;
mod scratch;
mod series;
mod series_scratch;
mod step_motion;
mod supports;
mod verdict;
mod view;
mod wall_step;
mod walls;
mod weights;

pub use energy::Energy;
pub use finding::{Finding, Refuted};
pub use residuals::Residuals;
pub(crate) use residuals::penetration;

use crate::linear::{Factor, running_max};
use crate::scene::{Forcing, GridForcing, LastPieces, Loads, Scene, System};
use crate::step::{Contract, Path, Step};
use balance::BalanceCheck;
use blows::Blows;
use extent::Extent;
use matrices::Matrices;
use momentum_sums::MomentumSums;
use noise::NoiseModel;
use own_loads::OwnLoads;
use place::Places;
use previous_step::PreviousStep;
use pulp::{Scalar, Simd};
use quiet_scratch::QuietScratch;
use row_walls::RowWalls;
use scales::Scales;
use scratch::Scratch;
use series_scratch::SeriesScratch;
use std::sync::Arc;
use supports::Supports;
use walls::WallCheck;
use weights::Weights;

/// Rounding error of the position of a body along exact motion, in units in the last place of its
/// terms and of the time.
const PLACE_UNITS: f64 = 32.0;

/// Checks every step of a run, and keeps its residuals.
#[derive(Debug)]
pub struct Judge {
    scene: Arc<Scene>,
    contract: Contract,
    h: f64,
    loads: Loads,
    last_pieces: LastPieces,
    /// The loads of an oscillator at the instants of a grid, where schemes take their sines from
    /// rotations: computed otherwise, a sine would differ by the rounding of its phase.
    grid_load: Option<GridForcing>,
    matrices: Matrices,
    /// The walls by their rows, and the indices of the rows with rigid walls that reach several
    /// degrees of freedom.
    row_walls: Vec<RowWalls>,
    wide: Vec<usize>,
    weights: Weights,
    mass: Option<Factor>,
    q: Vec<f64>,
    /// Load at the end of the last step and of the current one, N.
    load: Vec<f64>,
    load_end: Vec<f64>,
    blows: Blows,
    /// Where no caller adds a force to the loads: what the extra force of a step may be.
    own_loads: Option<Box<OwnLoads>>,
    scratch: Scratch,
    series: SeriesScratch,
    /// Impulses over a part of a step, one entry a wall, N s.
    over: Vec<f64>,
    /// Friction over a part of a step, or at its end, N s.
    rubbed: Vec<f64>,
    /// The largest speed at which rebounds ended at the instant of the last part, m/s.
    ended: f64,
    /// The vector instructions of the machine.
    arch: pulp::Arch,
    /// Work space for several steps at once; `None` where each is to be seen alone.
    quiet_scratch: Option<Box<QuietScratch>>,
    walls: WallCheck,
    balance: BalanceCheck,
    extent: Extent,
    /// Largest velocity in the metric of the mass along exact motion, √J.
    normal_speed: f64,
    scales: Scales,
    /// Quantities of a generalized-α run that carry over from step to step.
    previous: Option<Box<PreviousStep>>,
    /// Round holes and friction; `None` in scenes without them.
    supports: Option<Box<Supports>>,
    /// Their places.
    places: Option<Box<Places>>,
    energy: energy::Ledger,
    noise: NoiseModel,
    /// True once a step was handed to another scheme, which may not conserve energy.
    handed: bool,
    /// The momentum of the whole run.
    sums: MomentumSums,
}

impl Judge {
    /// A judge of a run on `scene` (the scene as the scheme sees it) under `contract` with steps of
    /// `h` seconds, started from the state `q` (m), `v` (m/s), one value of each per degree of
    /// freedom. Missing values count as 0, surplus ones are ignored.
    #[must_use]
    pub fn new(scene: &Scene, contract: Contract, h: f64, q: &[f64], v: &[f64]) -> Self {
        let judge = Self::over(&Arc::new(scene.clone()), &scene.wall_masses(), contract, h, (q, v));
        Self { own_loads: None, ..judge }
    }

    /// As [`Judge::new`], for a shared scene whose walls feel `masses` (kg), and a run in which no
    /// caller adds a force to the loads: one that no load explains breaks the momentum balance.
    pub(crate) fn over(
        scene: &Arc<Scene>,
        masses: &[f64],
        contract: Contract,
        h: f64,
        (q, v): (&[f64], &[f64]),
    ) -> Self {
        let (n, loads) = (scene.system.degrees_of_freedom(), Loads::new(&scene.loads));
        let mut load = vec![0.0; n];
        loads.add_force(0.0, 1.0, &mut load);
        // The factor of M, for the velocities that blows give. A mass matrix without a factor is an
        // error of the scene, reported earlier.
        let mass = match &scene.system {
            System::Structure(s) if loads.has_blows() => s.mass_factor().ok(),
            _ => None,
        };
        let [q, v] = [q, v].map(|x| x.iter().copied().chain(std::iter::repeat(0.0)).take(n).collect::<Vec<f64>>());
        let walls = WallCheck::new(scene, &q, &v);
        let grid_load = scene.is_line().then(|| GridForcing::new(Forcing::on(0, &scene.loads), h));
        let (row_walls, weights, blows) = (RowWalls::all(scene), Weights::new(scene), loads.has_blows());
        let mut noise = NoiseModel::new(&weights, masses, scene.gap_scale());
        noise.begin(h, 0.0);
        Self {
            contract,
            h,
            last_pieces: LastPieces::new(&loads),
            loads,
            grid_load,
            matrices: Matrices::new(&scene.system),
            wide: (0..row_walls.len()).filter(|&index| row_walls[index].is_wide(scene)).collect(),
            row_walls,
            mass,
            energy: energy::Ledger::new(scene, contract, &q, &v),
            scales: Scales::new(scene, masses),
            sums: MomentumSums::new(scene, &q, &v),
            previous: PreviousStep::new(scene, contract, (&q, &v), &load, &walls.last_force),
            walls,
            supports: Supports::new(scene, masses, (&q, &v)),
            places: Places::new(scene, &weights.root_mass),
            q,
            load,
            load_end: vec![0.0; n],
            blows: Blows::new(n),
            own_loads: OwnLoads::new(scene, &contract, h),
            scratch: Scratch::new(n),
            series: SeriesScratch::new(n),
            over: vec![0.0; scene.walls.len()],
            ended: 0.0,
            rubbed: Vec::new(),
            arch: pulp::Arch::new(),
            quiet_scratch: QuietScratch::new(scene, contract, &weights, blows),
            balance: BalanceCheck::default(),
            extent: Extent::default(),
            normal_speed: 0.0,
            noise,
            handed: false,
            weights,
            scene: Arc::clone(scene),
        }
    }

    /// Checks one step. Steps must come in order, none left out. A step of another scene, with
    /// another number of walls or degrees of freedom than the judge was made for, is ignored.
    pub fn observe(&mut self, step: &Step<'_>) {
        let (n, walls) = (self.q.len(), self.scene.walls.len());
        let planar = if self.supports.is_some() { walls } else { 0 };
        if !step.fits(n, walls, planar) {
            return;
        }
        let Some(mut own_loads) = self.own_loads.take() else { return self.observe_forced(step) };
        self.observe_forced(&Step { extra: own_loads.force(step, self.h), ..*step });
        self.own_loads = Some(own_loads);
    }

    /// Checks one step under the extra force that it tells.
    fn observe_forced(&mut self, step: &Step<'_>) {
        // Without blows these vectors stay zero.
        if self.loads.has_blows() {
            self.take_blows(step);
        }
        match step.path {
            Path::Grid if self.previous.is_some() => self.observe_apart(step, |judge| judge.observe_corrected(step)),
            Path::Grid | Path::OneRestitution => self.observe_grid(step),
            Path::Part { length } => self.observe_part(step, length),
            Path::Exact(arc) => self.observe_apart(step, |judge| judge.observe_arc(step, arc)),
            Path::Series(series) => self.observe_apart(step, |judge| judge.observe_series(step, series)),
            Path::Handed { contract, step: h } => {
                self.handed = true;
                let own = (self.contract, self.h);
                (self.contract, self.h) = (*contract, h);
                self.observe_grid(step);
                (self.contract, self.h) = own;
            }
        }
        std::mem::swap(&mut self.load, &mut self.load_end);
    }

    /// Sets the load at the end of a step.
    #[inline(always)]
    fn set_load_at_end(&mut self, step: &Step<'_>) {
        match (&mut self.grid_load, step.path, &mut self.load_end[..]) {
            (Some(forcing), Path::Grid | Path::OneRestitution | Path::Part { .. }, [load]) => {
                *load = forcing.at(step.end)
            }
            (_, _, load) => {
                // All other entries have been 0 from the beginning.
                self.loads.clear(load);
                self.loads.add_force_near(step.end, 1.0, load, &mut self.last_pieces);
            }
        }
    }

    /// Checks a step by `observe`, with its sizes noted before, and its momentum summed and the
    /// depths behind the walls updated after. [`Judge::observe_grid`] does that in its own passes.
    fn observe_apart(&mut self, step: &Step<'_>, observe: impl FnOnce(&mut Self)) {
        let n = self.q.len();
        self.set_load_at_end(step);
        self.prepare(step);
        observe(self);
        self.sum(Scalar, step, 1.0 / self.h, n);
        for (index, wall) in self.scene.walls.iter().enumerate() {
            self.walls.observe_depth(index, -wall.gap(wall.row().dot(step.q)));
        }
        self.begin_next_step(Scalar, step, n);
    }

    /// Makes the state at the end of a step that at the start of the next.
    #[inline(always)]
    fn begin_next_step<S: Simd>(&mut self, simd: S, step: &Step<'_>, n: usize) {
        for walls_of_row in self.wide.iter().filter_map(|&index| self.row_walls.get(index)) {
            self.extent.speed = self.extent.speed.max(walls_of_row.row.size(step.velocity_after));
        }
        self.extent.observe(simd, step.q, step.velocity_after, &self.weights, n);
        self.q[..n].copy_from_slice(&step.q[..n]);
    }

    /// The scale of speeds of rebound, m/s.
    fn rebound_scale(&self) -> f64 {
        self.extent.speed.max(self.energy.gap_scale / self.scene.duration)
    }
}

#[cfg(test)]
mod tests;
