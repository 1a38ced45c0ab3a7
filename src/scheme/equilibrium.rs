//! Static equilibrium between walls and in holes.

use super::static_programme::{StaticProgramme, depth_at};
use crate::error::{Error, Result, Subject};
use crate::linear::{Factor, Symmetric};
use crate::qp::Failure;
use crate::scene::{LoadKind, Loads, Scene, State, Wall};

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

/// Where K leaves motions free, the factor resolves less. There the answer is settled if a
/// programme moves it by less than this share, and no less than the programme before: moves shrink
/// from programme to programme until only rounding is left.
const ROUNDED: f64 = 1e-8;

/// Where no displacement is more than this share of what the loads would cause without any wall,
/// the walls hold the scene at 0: the rounding of a programme.
const HELD: f64 = 1e-13;

/// The displacements (m, one per degree of freedom) at which the scene rests under its constant
/// loads alone, between its walls: the minimiser of
///
/// ½ qᵀK q − fᵀq + Σ k s²/2
///
/// over all rigid walls and holes, with the depth s in each elastic one. Where the force grows with
/// the depth to the power n the energy is the integral of that force, and the programmes are those
/// of Newton's method: each has the tangent of that force at the depth found by the one before. A
/// wall or hole that the free shape would pass carries preload from the start. Friction is left
/// out.
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
    scene.validate_but_start()?;
    let structure = scene.system.structure();
    let n = scene.system.degrees_of_freedom();
    let mut force = vec![0.0; n];
    let constant = scene.loads.iter().filter(|load| matches!(load.kind, LoadKind::Constant { .. })).cloned();
    Loads::new(&constant.collect::<Vec<_>>()).add_force(0.0, 1.0, &mut force);
    let scale = Scene { initial: State { q: vec![0.0; n], v: vec![0.0; n] }, ..scene.clone() }.gap_scale();
    let pull = pull(scene, &force, scale);
    let a = Symmetric::sum(&[(1.0, &structure.stiffness), (pull, &structure.mass)]);
    let open = open_size(scene, &a, &force);
    let stiffens = scene.walls.iter().any(|wall| !wall.law.is_linear());
    let mut depths = vec![0.0; scene.walls.len()];
    let programme = |depths: &[f64]| {
        StaticProgramme::new(scene, a.clone(), scale, depths).map_err(|failure| refused(scene, &failure))
    };
    let mut held = programme(&depths)?;
    let (mut q, mut before) = (vec![0.0; n], f64::INFINITY);
    for round in 0..MOST_ROUNDS {
        if stiffens && round > 0 {
            let reached = scene.walls.iter().zip(held.forces(&scene.walls));
            // Of the first programme, to which the wall is hard, the depth at its force.
            depths =
                reached.map(|(wall, force)| depth_at(&wall.law, force).max(-wall.gap(wall.coordinate(&q)))).collect();
            held = programme(&depths)?;
        }
        let mut b = force.clone();
        scene.system.add_mass(pull, &q, &mut b);
        let x = held.solve(&b).map_err(|failure| refused(scene, &failure))?;
        let size = x.iter().fold(scale, |most, x| most.max(x.abs()));
        let moved = x.iter().zip(&q).map(|(new, old)| (new - old).abs()).fold(0.0, f64::max);
        q.copy_from_slice(x);
        if moved <= SETTLED * size || (before <= moved && moved <= ROUNDED * size) {
            let pressed = held.pressed(&scene.walls);
            if is_zero(scene, &q, &pressed, open) {
                return Ok(vec![0.0; n]);
            }
            let mut rest = Scene { initial: State { q, v: vec![0.0; n] }, ..scene.clone() };
            rest.press_onto(&pressed);
            rest.step_out_of_walls();
            return Ok(rest.initial.q);
        }
        before = moved;
    }
    let key = Subject::from(("initial state", "equilibrium"));
    let value = "not found: the constant loads move the structure, and neither its stiffness nor a wall holds it";
    Err(Error::invalid(key, value, "a structure that is held, or walls where the loads push it"))
}

/// The largest displacement of the first programme without walls, m, for a scene that rigid walls
/// may hold at 0: `a` is its matrix.
fn open_size(scene: &Scene, a: &Symmetric, force: &[f64]) -> Option<f64> {
    scene.walls.iter().find(|wall| stands_at_zero(wall))?;
    let mut x = force.to_vec();
    Factor::new(a).ok()?.solve(&mut x);
    Some(x.iter().fold(0.0, |most: f64, x| most.max(x.abs())))
}

fn stands_at_zero(wall: &Wall) -> bool {
    wall.law.is_rigid() && !wall.is_round() && wall.position() == 0.0
}

/// True if the walls `pressed` are rigid ones at 0, and the displacements `q` only rounding beside
/// the size `open` (m) of those without walls. Taken for lengths, they would be the only ones of a
/// scene all of whose walls stand at 0.
fn is_zero(scene: &Scene, q: &[f64], pressed: &[usize], open: Option<f64>) -> bool {
    let at_zero = |&index: &usize| scene.walls.get(index).is_some_and(stands_at_zero);
    open.is_some_and(|open| q.iter().all(|q| q.abs() <= HELD * open)) && pressed.iter().all(at_zero)
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
    let name = |row: usize| scene.wall_name(row).map_or_else(String::new, |name| format!("{name:?}"));
    let key = Subject::from(("initial state", "equilibrium"));
    match *failure {
        Failure::Infeasible { row, against } => {
            let value = format!("without a place: {} and {} cannot be met together", name(row), name(against));
            Error::invalid(key, value, "walls and holes that leave a common place")
        }
        _ => Error::invalid(key, format!("not found: {failure}"), "a structure whose matrices can be solved"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Chain, Load, Row};

    /// Three masses of `mass` (kg) without a ground, between springs of `stiffness` (N/m).
    fn floating(mass: f64, stiffness: f64) -> Scene {
        let chain = Chain { masses: vec![mass; 3], springs: vec![stiffness; 2], grounds: [0.0; 2] };
        Scene::structure(chain.structure().unwrap())
    }

    /// Stiffness times displacement and the walls' own forces balance the loads, whatever the
    /// exponents of the walls; the force of each follows from its law at the depth found.
    #[test]
    fn walls_that_stiffen_hold_a_structure_by_their_own_force() {
        let chain = Chain { masses: vec![1.0; 3], springs: vec![200.0, 300.0], grounds: [50.0, 0.0] };
        for exponent in [1.0, 1.5, 2.0, 10.0] {
            // Deep and shallow: of 1e6 N/mⁿ and softer, with a gap, without one, and with preload.
            for (stiffness, position) in [(1e6, 0.0), (1e6, -1e-3), (1e3, 2e-3), (20.0, 5e-2)] {
                let scene = Scene::structure(chain.structure().unwrap())
                    .with_wall(
                        Wall::lower("low", position).at(Row::dof(0)).with_hunt_crossley(stiffness, exponent, 0.1),
                    )
                    .with_wall(Wall::upper("high", 1e-3).at(Row::dof(2)).with_hunt_crossley(1e5, exponent, 0.0))
                    .with_load(Load { at: Row::dof(0), ..Load::constant(-3.0) })
                    .with_load(Load { at: Row::dof(2), ..Load::constant(40.0) });
                let q = equilibrium(&scene).unwrap();
                let mut balance = vec![-3.0, 0.0, 40.0];
                scene.system.structure().stiffness.add_product(-1.0, &q, &mut balance);
                for (wall, at) in scene.walls.iter().zip([0, 2]) {
                    balance[at] += wall.law_force(q[at], 0.0);
                }
                let worst = balance.iter().fold(0.0_f64, |worst, x| worst.max(x.abs()));
                // Rounding of forces of up to 1e3 N that stiffen tenfold with the depth.
                assert!(worst < 1e-9, "{exponent} {stiffness} {position}: {q:?} {balance:?}");
            }
        }
    }

    #[test]
    fn the_pull_is_a_small_share_of_the_squared_frequencies_in_all_units() {
        let held = |mass: f64, stiffness: f64| pull(&Scene::oscillator(mass, 0.0, stiffness), &[3.0], 0.1);
        // Times sixteen times as long, and masses eight times as large.
        for (mass, stiffness) in [(2.0, 50.0), (2.0, 50.0 / 256.0), (16.0, 400.0), (2.0, 50.0 * 65536.0)] {
            let share = held(mass, stiffness) / (stiffness / mass);
            // What is left of an error after each programme; the frequency is computed to rounding.
            assert!((share / PULL - 1.0).abs() < 1e-12, "{share:e}");
        }
        // Hardly pushed, and pushed so that it flies: both ends of the range.
        for (force, end) in [(1e-12, 0), (1e9, 1)] {
            for (mass, stiffness, time) in [(2.0, 50.0, 1.0), (2.0, 50.0 / 256.0, 16.0), (16.0, 400.0, 1.0)] {
                let force = [force * mass / (time * time), 0.0, 0.0];
                // Three equal masses and two springs: the fastest motion has ω² = 3 k/m.
                let share = pull(&floating(mass, stiffness), &force, 0.1) / (3.0 * stiffness / mass);
                assert!((share / LOOSE[end] - 1.0).abs() < 1e-6, "{share:e}, {force:?}");
            }
        }
    }

    #[test]
    fn a_spring_yields_by_its_load_whatever_the_unit_of_length() {
        for unit in [1e-12, 1e-3, 1.0, 1e6] {
            // Half of the way to the wall.
            let scene = Scene::oscillator(1.0, 0.0, 4.0)
                .with_wall(Wall::upper("stop", 1.5 * unit))
                .with_load(Load::constant(3.0 * unit));
            let q = equilibrium(&scene).unwrap()[0];
            // Settled to 1e-13 of the gap, and rounding.
            assert!((q / (0.75 * unit) - 1.0).abs() < 1e-12, "{q:e} of {unit:e}");
        }
    }

    #[test]
    fn what_nothing_holds_and_nothing_pushes_stays_where_it_is() {
        assert_eq!(equilibrium(&Scene::oscillator(1.0, 0.0, 0.0)), Ok(vec![0.0]));
        assert_eq!(equilibrium(&floating(2.0, 50.0)), Ok(vec![0.0; 3]));
    }

    #[test]
    fn an_invalid_scene_is_refused_but_for_its_start() {
        let own = || Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("stop", 1e-3));
        // Beyond the wall, where it may start: the answer takes its place.
        assert_eq!(equilibrium(&own().with_initial(&[1.0], &[0.0])), Ok(vec![0.0]));
        let row = Load { at: crate::scene::Row::dof(99), ..Load::constant(1.0) };
        for (scene, words) in [
            (own().with_load(row), "load 1: at is 99"),
            (own().with_wall(Wall::lower("stop", -1.0)), "which another wall has"),
            (own().with_wall(Wall::lower("low", f64::NAN)), "wall \"low\": position is NaN"),
            (own().with_duration(-3.0), "duration is -3"),
        ] {
            let error = equilibrium(&scene).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    /// Three masses between springs, whose first and last stand at levers of two lengths.
    fn levered(load: f64, walls: [Wall; 2]) -> Scene {
        let chain = Chain { masses: vec![2.0; 3], springs: vec![50.0; 2], grounds: [30.0, 40.0] };
        let scene = Scene::structure(chain.structure().unwrap()).with_load(Load::constant(load));
        walls.into_iter().fold(scene, Scene::with_wall)
    }

    #[test]
    fn a_snug_place_and_a_wall_that_presses_are_met_to_rounding() {
        for position in [0.0, 1e-4, -0.37] {
            for weights in [vec![(2, 1.0)], vec![(0, 0.3), (2, 0.7)], vec![(0, -1.0), (1, 0.1), (2, 0.7)]] {
                let row = Row::new(weights);
                let snug = [Wall::upper("upper", position).at(row.clone()), Wall::lower("lower", position).at(row)];
                let mut scene = levered(3.0, snug);
                scene.initial.q = equilibrium(&scene).unwrap();
                scene.initial.v = vec![0.0; 3];
                let w = scene.walls[0].row().dot(&scene.initial.q);
                // Rounding of three displacements below 0.5 m.
                assert!((w - position).abs() < 1e-15, "{w:e} at {position}");
                assert_eq!(scene.validate(), Ok(()));
                // The start is on both walls, so that their distance from it is no length.
                assert!(scene.gap().is_none() && scene.gap_scale() > 1e-5, "{:e}", scene.gap_scale());
            }
        }
    }
}
