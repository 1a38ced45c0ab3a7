//! Static equilibrium between walls.

use crate::error::{Error, Result, Subject};
use crate::linear::{Rows, Symmetric};
use crate::qp::{Backend, Failure, Problem, Rhs, Solver};
use crate::scene::{LoadKind, Loads, Scene, Side, State, Wall, WallLaw};

/// Most programmes solved: with a stiffness that holds every motion two or three are enough.
const MOST_ROUNDS: usize = 200;

/// The pull back to the last answer, as a share of the slowest ω² · M: what remains of an error
/// after a programme.
const PULL: f64 = 1e-6;

/// The same as a share of the fastest, where K does not hold every motion: between what the factor
/// resolves, and what does not slow the other motions down.
const LOOSE: [f64; 2] = [1e-10, 1e-8];

/// The answer is settled if a programme moves it by less than this share of its size and of the gap
/// scale: the rounding of a factor of K.
const SETTLED: f64 = 1e-13;

/// The displacements (m, one per degree of freedom) at which the scene rests under its constant
/// loads alone, between its walls: the minimiser of
///
/// ½ qᵀK q − fᵀq + Σ k s²/2
///
/// over all rigid walls, with the depth s in each elastic wall. A wall that the free shape would
/// pass carries preload from the start.
///
/// K may leave motions free, as those of a body without springs. So the programmes add ½σ ‖q − q′‖²
/// in the metric of M, with the answer q′ of the programme before (Rockafellar 1976,
/// doi:10.1137/0314056: the proximal point method), and are repeated until it moves no further:
/// there the added term and its force are zero. A motion that neither K nor a wall holds, and that
/// no load pushes, stays at 0.
///
/// # Errors
/// [`Error::Invalid`] under `initial state: equilibrium` if a load pushes the scene on for ever,
/// with no wall in the way, and where walls leave no place; those of [`Scene::validate`] but for
/// the initial state.
pub fn equilibrium(scene: &Scene) -> Result<Vec<f64>> {
    scene.system.validate()?;
    let structure = scene.system.structure();
    let n = scene.system.degrees_of_freedom();
    let mut force = vec![0.0; n];
    let constant = scene.loads.iter().filter(|load| matches!(load.kind, LoadKind::Constant { .. })).cloned();
    Loads::new(&constant.collect::<Vec<_>>()).add_force(0.0, 1.0, &mut force);
    let scale = Scene { initial: State { q: vec![0.0; n], v: vec![0.0; n] }, ..scene.clone() }.gap_scale();
    let pull = pull(scene, &force, scale);
    let compliance = |law: &WallLaw| match law {
        WallLaw::Elastic { stiffness, .. } => 1.0 / stiffness,
        WallLaw::Rigid { .. } | WallLaw::Quartic { .. } => 0.0,
    };
    let problem = Problem {
        a: Symmetric::sum(&[(1.0, &structure.stiffness), (pull, &structure.mass)]),
        g: Rows::new(n, scene.walls.iter().map(|wall| wall.at.entries())),
        compliance: scene.walls.iter().map(|wall| compliance(&wall.law)).collect(),
    };
    let failed = |failure: &Failure| refused(scene, failure);
    let mut solver = Solver::new(problem, Backend::Condensed, scale).map_err(|failure| failed(&failure))?;
    let bound = |side: Side, none: f64| {
        let of = move |wall: &Wall| if wall.side == side { wall.position } else { none };
        scene.walls.iter().map(of).collect::<Vec<f64>>()
    };
    let (lo, hi) = (bound(Side::Lower, f64::NEG_INFINITY), bound(Side::Upper, f64::INFINITY));
    let mut q = vec![0.0; n];
    for _ in 0..MOST_ROUNDS {
        let mut b = force.clone();
        scene.system.add_mass(pull, &q, &mut b);
        let solution = solver.solve(&Rhs { b: &b, lo: &lo, hi: &hi }).map_err(|failure| failed(&failure))?;
        let size = solution.x.iter().fold(scale, |most, x| most.max(x.abs()));
        let moved = solution.x.iter().zip(&q).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
        q.clone_from(&solution.x);
        if moved <= SETTLED * size {
            let mut rest = Scene { initial: State { q, v: vec![0.0; n] }, ..scene.clone() };
            rest.step_out_of_walls();
            return Ok(rest.initial.q);
        }
    }
    let key = Subject::from(("initial state", "equilibrium"));
    let value = "not found: the constant loads move the structure, and neither its stiffness nor a wall holds it";
    Err(Error::invalid(key, value, "a structure that is held, or walls where the loads push it"))
}

/// σ, 1/s².
fn pull(scene: &Scene, force: &[f64], scale: f64) -> f64 {
    let [slowest, fastest] = scene.system.frequencies();
    if slowest > 0.0 {
        return PULL * slowest * slowest;
    }
    // A body without springs moves by the gap scale in each programme.
    let structure = scene.system.structure();
    let mut acceleration = force.to_vec();
    if let Ok(mut mass) = structure.mass_factor() {
        mass.solve(&mut acceleration);
    }
    let pushed = acceleration.iter().fold(0.0_f64, |most, a| most.max(a.abs())) / scale;
    let free = if pushed > 0.0 { pushed } else { 1.0 };
    let squared = fastest * fastest;
    if squared > 0.0 { free.clamp(LOOSE[0] * squared, LOOSE[1] * squared) } else { free }
}

/// Why there is no equilibrium.
fn refused(scene: &Scene, failure: &Failure) -> Error {
    let name = |row: usize| scene.walls.get(row).map_or_else(String::new, |wall| format!("{:?}", wall.name));
    let key = Subject::from(("initial state", "equilibrium"));
    match *failure {
        Failure::Infeasible { row, against } => {
            let value =
                format!("without a place: the walls {} and {} cannot be met together", name(row), name(against));
            Error::invalid(key, value, "walls that leave a common place")
        }
        _ => Error::invalid(key, format!("not found: {failure}"), "a structure whose matrices can be solved"),
    }
}
