//! The energy ledger of a run, entry by entry, against closed forms.

use crate::common::{CONSTRAINED, INTEGRATORS, MOREAU_JEAN, spring};
use crate::rubbing::{body, isotropic, with_flats};
use signorini::linear::Symmetric;
use signorini::residual::Energy;
use signorini::{Integrator, Load, Options, Row, Scene, Scheme, Structure, Wall, run};

/// E at the start, at the end and the largest; work of loads, damping, impacts, dashpots, friction;
/// and what was exchanged, J.
type Entries = [f64; 9];

fn entries(e: &Energy) -> Entries {
    let flows = [e.load_work_j, e.damping_j, e.impact_loss_j, e.wall_damping_j, e.friction_j];
    let [work, damping, impact, dashpot, friction] = flows;
    [e.initial_j, e.final_j, e.largest_j, work, damping, impact, dashpot, friction, e.exchanged_j]
}

/// Fails unless the ledger of `scene` by `scheme` has these entries to `share` of the largest.
#[track_caller]
fn check(what: &str, scene: &Scene, scheme: &Scheme, expected: Entries, share: f64) {
    let made = run(scene, scheme, &Options::with_step(1e-4)).expect("a run");
    // No wall pulls here.
    assert!(made.residuals.tension_n < 1e-9, "{what}, {scheme}: {:?}", made.residuals);
    let found = entries(&made.residuals.energy);
    let size = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    for (k, (a, b)) in found.iter().zip(&expected).enumerate() {
        assert!((a - b).abs() <= share * size, "{what}, {scheme}, entry {k}: {found:?}, expected {expected:?}");
    }
}

fn all() -> impl Iterator<Item = Scheme> {
    let penalties = INTEGRATORS.map(|integrator| spring(1e4, integrator));
    CONSTRAINED.into_iter().chain([Scheme::GeneralizedAlpha { rho: 0.8 }, Scheme::Event]).chain(penalties)
}

#[test]
fn loads_work_and_dampers_take() {
    // A damped oscillator that a constant force moves one way all the time, on either side.
    let (m, c, k, t) = (1.0, 2.0, 10.0, 0.4_f64);
    for s in [1.0, -1.0] {
        let (f, x0, v0) = (s * 5.0, s * -0.1, s * 0.6);
        let (a, b) = (x0 - f / k, (v0 + x0 - f / k) / 3.0);
        let (sin, cos) = (3.0 * t).sin_cos();
        let x = f / k + (-t).exp() * (a * cos + b * sin);
        let v = (-t).exp() * ((3.0 * b - a) * cos - (3.0 * a + b) * sin);
        assert!(s * v > 0.0, "{v}");
        let energy = |x: f64, v: f64| 0.5 * (m * v * v + k * x * x);
        let (work, start, end) = (f * (x - x0), energy(x0, v0), energy(x, v));
        let damping = start + work - end;
        // The energy grows to the end, where the load gives more than the damper takes.
        let expected = [start, end, end, work, damping, 0.0, 0.0, 0.0, end + work.abs() + damping];
        let scene = Scene::oscillator(m, c, k)
            .with_wall(Wall::upper("far", 9.0))
            .with_load(Load::constant(f))
            .with_initial(&[x0], &[v0])
            .with_duration(t);
        for scheme in all() {
            // Order one: h ω² T/2 of the energy, and half a step at both ends of a staggered
            // scheme.
            check("a load", &scene, &scheme, expected, 2e-3);
        }
    }
}

#[test]
fn impacts_take_what_restitution_does_not_give_back() {
    for (wall, s) in [(Wall::upper("stop", 0.1), 1.0), (Wall::lower("stop", -0.1), -1.0)] {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(wall.with_restitution(0.5))
            .with_initial(&[0.0], &[s])
            .with_duration(0.2);
        for scheme in all().filter(|scheme| *scheme != Scheme::Newmark && !matches!(scheme, Scheme::Penalty { .. })) {
            // 1 J; e = ½ gives a quarter of it back, implicit Euler nothing.
            let lost = if scheme == Scheme::ImplicitEuler { 1.0 } else { 0.75 };
            check("an impact", &scene, &scheme, [1.0, 1.0 - lost, 1.0, 0.0, 0.0, lost, 0.0, 0.0, 1.0 + lost], 1e-9);
        }
    }
}

#[test]
fn blows_work_by_the_mean_of_the_velocities_around_them() {
    for (blow, v) in [(0.6, 0.8), (-0.6, 0.2), (-1.4, -0.2)] {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(Wall::upper("far", 9.0))
            .with_load(Load::impulse(blow, 0.100_03))
            .with_initial(&[0.0], &[0.5])
            .with_duration(0.2);
        let (start, end) = (0.25, v * v);
        let work: f64 = end - start;
        let exchanged = start.max(end) + 0.5 * f64::abs(blow * (0.5 + v));
        for scheme in all() {
            let expected = [start, end, start.max(end), work, 0.0, 0.0, 0.0, 0.0, exchanged];
            check("a blow", &scene, &scheme, expected, 1e-9);
        }
    }
}

#[test]
fn springs_store_and_their_dashpots_take() {
    // 1 kg at 0.4 m/s into 400 N/m, and out again: π/20 s inside. Half way through, the spring has
    // it.
    let scene = |damping: f64, duration: f64, s: f64| {
        let wall = if s > 0.0 { Wall::upper("pad", 0.0) } else { Wall::lower("pad", 0.0) };
        Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(wall.with_elasticity(400.0, damping))
            .with_initial(&[0.0], &[s * 0.4])
            .with_duration(duration)
    };
    for s in [1.0, -1.0] {
        for scheme in all() {
            let deep = [0.08, 0.08, 0.08, 0.0, 0.0, 0.0, 0.0, 0.0, 0.08];
            // ω²hT/2 of the energy in schemes of order one, and the instant of contact.
            check("a spring", &scene(0.0, 0.08, s), &scheme, deep, 4e-3);
            // With 4 N s/m, ζ = 0.1: the body leaves where the pressure ends, before it is back.
            let (decay, omega) = (2.0, 396.0_f64.sqrt());
            let state = |t: f64| {
                let x = 0.4 / omega * (-decay * t).exp() * (omega * t).sin();
                let v = 0.4 * (-decay * t).exp() * ((omega * t).cos() - decay / omega * (omega * t).sin());
                (x, v)
            };
            // 400 x + 4 v = 0 between the deepest point and the return.
            let (mut low, mut high) = (std::f64::consts::FRAC_PI_2 / omega, std::f64::consts::PI / omega);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let (x, v) = state(middle);
                if 400.0 * x + 4.0 * v > 0.0 { low = middle } else { high = middle }
            }
            let v = state(low).1;
            let end = 0.5 * v * v;
            let lost = 0.08 - end;
            let free = [0.08, end, 0.08, 0.0, 0.0, 0.0, lost, 0.0, 0.08 + lost];
            check("a damped spring", &scene(4.0, 0.3, s), &scheme, free, 6e-3);
        }
    }
}

#[test]
fn friction_takes_its_force_times_the_way() {
    // 2 kg pressed by 3 N onto a flat, sliding at ±0.3 m/s with friction 0.25: 0.15 m/s after 0.4
    // s.
    for direction in [0.0, 180.0] {
        for s in [1.0, -1.0] {
            let push = if direction == 0.0 { 3.0 } else { -3.0 };
            let scene = isotropic(2.0, 0.0, 0.0)
                .with_load(Load { at: Row::dof(0), ..Load::constant(push) })
                .with_initial(&[0.0, 0.0], &[0.0, s * 0.3])
                .with_duration(0.4);
            let scene = with_flats(scene, "bar", body(), &[(direction, 0.0)], 0.0, 0.25);
            let lost = 0.75 * 0.09;
            let expected = [0.09, 0.0225, 0.09, 0.0, 0.0, 0.0, 0.0, lost, 0.09 + lost];
            check("friction", &scene, &MOREAU_JEAN, expected, 1e-3);
        }
    }
}

#[test]
fn the_ledger_closes_to_rounding_from_a_start_within_a_spring() {
    // 1 kg on 30 N/m, 10 mm inside a wall of 400 N/m and never out of it, pressed by 8 N, with
    // blows within a step.
    for (wall, s) in [(Wall::upper("pad", 0.0), 1.0), (Wall::lower("pad", 0.0), -1.0)] {
        let scene = Scene::oscillator(1.0, 0.0, 30.0)
            .with_wall(wall.with_elasticity(400.0, 0.0))
            .with_load(Load::constant(s * 8.0))
            .with_load(Load::impulse(s * 0.02, 0.100_37))
            .with_initial(&[s * 0.01], &[s * 0.05])
            .with_duration(0.5);
        // The rules that keep the energy of linear springs.
        for scheme in [MOREAU_JEAN, spring(1e4, Integrator::Trapezoidal), spring(1e4, Integrator::DiscreteGradient)] {
            let made = run(&scene, &scheme, &Options::with_step(1e-3)).expect("a run");
            let e = made.residuals.energy;
            assert!(e.residual_j.abs() < 1e-13 * e.exchanged_j, "{scheme}, side {s}: {e:?}");
            // ½·0.05² + ½·430·0.01².
            assert!((e.initial_j - 0.02275).abs() < 1e-15, "{scheme}, side {s}: {e:?}");
            let blow = e.final_j - e.initial_j - e.load_work_j;
            assert!(blow.abs() < 1e-12, "{scheme}, side {s}: {e:?}");
        }
    }
}

#[test]
fn a_staggered_scheme_keeps_the_energy_of_half_steps_from_the_first_on() {
    // A coarse step: 0.4 rad, and half a radian.
    let free = Scene::oscillator(1.0, 0.0, 100.0).with_initial(&[0.02], &[0.3]).with_duration(4.0);
    for scheme in [Scheme::PaoliSchatzman, spring(200.0, Integrator::CentralDifference)] {
        for h in [0.04, 0.05] {
            let made = run(&free, &scheme, &Options::with_step(h)).expect("a run");
            let e = made.residuals.energy;
            // Rounding of a hundred steps.
            assert!(e.residual < 1e-14 && (e.final_j / e.initial_j - 1.0).abs() < 1e-14, "{scheme}, h = {h}: {e:?}");
            assert_eq!(made.findings, [], "{scheme}, h = {h}");
        }
    }
}

/// A ball that falls from 1 m has m g h as it strikes, more than at any other time; so do two that
/// fall side by side.
#[test]
fn the_largest_energy_of_exact_motion_is_that_at_the_impact() {
    let one = Scene::oscillator(2.0, 0.0, 0.0);
    let two = Scene::structure(Structure {
        mass: Symmetric::diagonal(&[1.0, 1.0]),
        damping: Symmetric::zeros(2),
        stiffness: Symmetric::zeros(2),
    });
    for scene in [one, two] {
        let n = scene.initial.q.len();
        let loads = (0..n).map(|i| Load { at: Row::dof(i), ..Load::constant(-9.81 * 2.0 / n as f64) });
        let floors = (0..n).map(|i| Wall::lower(["left", "right"][i], 0.0).at(Row::dof(i)).with_restitution(0.5));
        let scene = Scene { loads: loads.collect(), walls: floors.collect(), ..scene };
        let scene = scene.with_initial(&vec![1.0; n], &vec![0.0; n]).with_duration(0.6);
        let run = run(&scene, &Scheme::Event, &Options::with_step(1e-3)).unwrap();
        let largest = run.residuals.energy.largest_j;
        // Rounding of the instant.
        assert!((largest / (2.0 * 9.81) - 1.0).abs() < 1e-13, "{n}: {largest}");
    }
}
