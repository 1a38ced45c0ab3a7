//! Blows and rounding in the table of contacts: where an episode begins and ends, with what speed.

use crate::common::{CONSTRAINED, INTEGRATORS, spring};
use signorini::{Contact, Finding, Load, Options, Refuted, Scene, Scheme, Statistics, Table, Wall, run};

const GENERALIZED_ALPHA: Scheme = Scheme::GeneralizedAlpha { rho: 0.8 };

fn made(scene: &Scene, scheme: &Scheme, h: f64) -> (Vec<Contact>, Statistics) {
    let run = run(scene, scheme, &Options::with_step(h)).expect("a run");
    (run.trajectory.contacts().to_vec(), run.statistics)
}

fn all() -> impl Iterator<Item = Scheme> {
    let penalties = INTEGRATORS.map(|integrator| spring(1e6, integrator));
    CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA, Scheme::Event]).chain(penalties)
}

/// An elastic wall at 0 on either side, of 1000 N/m, with the sign of what moves into it.
fn pads() -> [(Wall, f64); 2] {
    [(Wall::upper("pad", 0.0), 1.0), (Wall::lower("pad", 0.0), -1.0)].map(|(w, s)| (w.with_elasticity(1e3, 0.0), s))
}

#[test]
fn a_blow_that_moves_a_stiff_spring_within_a_step_is_no_open_momentum() {
    // ωh = 32 and 316: the rule's damping takes the displacement of the blow within a step, so that
    // no mean force of a step contains the spring's force over it, while the ends of the steps do.
    for (stiffness, time) in [(1e5, 0.512), (1e5, 0.595), (1e7, 0.512), (1e7, 0.595)] {
        let scene = Scene::oscillator(1.0, 60.0, stiffness)
            .with_wall(Wall::upper("stop", 1.0))
            .with_load(Load::impulse(1.0, time))
            .with_duration(4.0);
        for scheme in all().chain([0.6, 0.9].map(|theta| Scheme::MoreauJean { theta })) {
            let run = run(&scene, &scheme, &Options::with_step(0.1)).expect("a run");
            // central-difference is beyond its stability limit.
            let kept = |found: &&Finding| found.refuted != Refuted::Diverged;
            assert_eq!(run.findings.iter().find(kept), None, "{scheme}, {stiffness} N/m, {time} s");
        }
    }
}

#[test]
fn a_blow_does_not_divide_a_contact_with_a_spring() {
    // 1 kg enters at 0.3 m/s; 0.03 s later a blow of 0.5 N s drives it further in.
    let (entered, speed, omega) = (1e-3 / 0.3, 0.3, 1e3_f64.sqrt());
    let phase = omega * (0.03 - entered);
    let (deep, after) = (speed / omega * phase.sin(), speed * phase.cos() + 0.5);
    let leaves = after.hypot(omega * deep);
    for (wall, s) in pads() {
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(wall)
            .with_load(Load::impulse(s * 0.5, 0.03))
            .with_initial(&[-s * 1e-3], &[s * speed])
            .with_duration(0.3);
        for scheme in all() {
            let (found, statistics) = made(&scene, &scheme, 1e-4);
            let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
            // The instants of contact and blow are known to a step, 0.01 of the length of either;
            // of order one the energy falls by some ωh.
            let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 0.01;
            let what = format!("{scheme}, side {s}: {contact:?}");
            assert!(near(contact.approach_speed, speed), "{what}");
            assert!(near(contact.departure_speed.expect("closed"), leaves), "{what}, expected {leaves}");
            assert!(near(-s * contact.impulse, speed + 0.5 + leaves), "{what}");
            // What arrived is the energy at which it entered, over 0.3 s.
            assert!((statistics.walls[0].impact_power_w / (0.5 * speed * speed / 0.3) - 1.0).abs() < 0.02, "{what}");
        }
    }
}

#[test]
fn a_blow_onto_a_body_at_rest_is_an_impact_with_the_speed_of_the_blow() {
    // 2 N press 2 kg onto a stop, with a blow of 1 N s at 0.0305 s.
    for (wall, s) in [(Wall::upper("stop", 0.0), 1.0), (Wall::lower("stop", 0.0), -1.0)] {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(wall.with_restitution(0.0))
            .with_load(Load::constant(s * 2.0))
            .with_load(Load::impulse(s, 0.0305))
            .with_duration(0.2);
        // Newmark's rule, a demonstration, throws the body off the wall.
        let schemes = CONSTRAINED.into_iter().filter(|scheme| *scheme != Scheme::Newmark);
        for scheme in schemes.chain([GENERALIZED_ALPHA, Scheme::Event, Scheme::Located]) {
            let (found, statistics) = made(&scene, &scheme, 1e-3);
            let [rest, impact] = found[..2] else { panic!("{scheme}: {found:?}") };
            let what = format!("{scheme}, side {s}: {found:?}");
            assert!((rest.end.expect("closed") - 0.0305).abs() <= 1.5e-3, "{what}");
            assert!((impact.start - 0.0305).abs() <= 1.5e-3 && rest.start < 1.5e-3, "{what}");
            // Forces are those of the rest, to rounding: no blow is one.
            let most = statistics.walls[0].episode_peak_force_n.max.expect("a rest");
            assert!((most - 2.0).abs() < 1e-9, "{what}: {most}");
            assert!((impact.approach_speed - 0.5).abs() < 1e-9 && rest.approach_speed == 0.0, "{what}");
            let total: f64 = found.iter().map(|contact| contact.impulse).sum();
            assert!((-s * total - 1.4).abs() < 1e-9, "{what}: {total}");
            assert!((statistics.walls[0].impact_power_w - 0.25 / 0.2).abs() < 1e-9, "{what}");
        }
    }
}

/// 2 kg rest on the ground under 4 N; a blow of 3 N s against it arrives at 1.5 m/s and leaves at
/// 0.75 m/s: the blow works ½·3·1.5 J, of which the impact takes three quarters.
#[test]
fn a_blow_works_before_the_wall_that_answers_it() {
    for (side, s) in [(Wall::upper("ground", 0.0), 1.0), (Wall::lower("ground", 0.0), -1.0)] {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(side.with_restitution(0.5))
            .with_load(Load::constant(4.0 * s))
            .with_load(Load::impulse(3.0 * s, 0.5037))
            .with_duration(0.52);
        for (scheme, h) in [(Scheme::MoreauJean { theta: 0.5 }, 1e-3), (Scheme::Located, 1e-2)] {
            let run = run(&scene, &scheme, &Options::with_step(h)).expect("a run");
            let energy = &run.judged().expect("a judge").energy;
            // A step of moreau-jean has 4 N · h beside the blow of 3 N s, at 1.5 m/s.
            let allowed = if scheme == Scheme::Located { 1e-12 } else { 1e-2 };
            let flight = -4.0 * 0.75 * (0.52 - 0.5037) + 0.5 * 4.0 / 2.0 * 4.0 * (0.52_f64 - 0.5037).powi(2);
            assert!((energy.load_work_j - (2.25 + flight)).abs() < allowed, "{scheme}: {energy:?}");
            assert!((energy.impact_loss_j - 0.75 * 2.25).abs() < allowed, "{scheme}: {energy:?}");
            assert_eq!(run.cautions, Vec::<String>::new(), "{scheme}");
            let [rest, impact] = run.trajectory.contacts() else { panic!("{:?}", run.trajectory.contacts()) };
            assert_eq!((rest.departure_speed, impact.approach_speed), (Some(0.0), 1.5), "{scheme}");
        }
    }
}

/// A body of 1 kg that touches a wall, with a blow of 0.1 N s against it: the blow works as on the
/// free body, J²/2m, and the wall takes (1 − e²) of that.
#[test]
fn a_blow_on_a_body_that_touches_a_wall_works_as_on_the_free_body() {
    let schemes = [GENERALIZED_ALPHA, Scheme::GeneralizedAlpha { rho: 1.0 }, Scheme::MoreauJean { theta: 0.5 }];
    for (side, s) in [(Wall::upper("wall", 0.0), 1.0), (Wall::lower("wall", 0.0), -1.0)] {
        for (scheme, e) in schemes.iter().flat_map(|scheme| [0.0, 0.5, 1.0].map(|e| (scheme, e))) {
            let scene = Scene::oscillator(1.0, 0.0, 0.0)
                .with_wall(side.clone().with_restitution(e))
                .with_load(Load::impulse(0.1 * s, 0.05))
                .with_duration(0.1);
            let run = run(&scene, scheme, &Options::with_step(1e-3)).expect("a run");
            let energy = &run.judged().expect("a judge").energy;
            assert!((energy.load_work_j - 0.005).abs() < 1e-15, "{scheme}, {e}: {energy:?}");
            assert!((energy.impact_loss_j - (1.0 - e * e) * 0.005).abs() < 1e-15, "{scheme}, {e}: {energy:?}");
            assert_eq!(run.cautions, Vec::<String>::new(), "{scheme}, {e}");
        }
    }
}

#[test]
fn a_blow_within_the_step_that_meets_a_spring_is_in_the_speed_of_approach() {
    // From rest a thousandth of a step before the wall.
    let h = 1e-4;
    for (wall, s) in pads() {
        let scene = Scene::oscillator(2.0, 0.0, 0.0)
            .with_wall(wall)
            .with_load(Load::impulse(s, 2.9e-3))
            .with_initial(&[-s * 0.5e-3 * h], &[0.0])
            .with_duration(4e-3);
        for scheme in all() {
            let (found, _) = made(&scene, &scheme, h);
            let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
            assert!((contact.approach_speed - 0.5).abs() < 1e-9, "{scheme}, side {s}: {contact:?}");
        }
    }
}

#[test]
fn a_contact_ends_where_its_force_falls_to_rounding() {
    let (place, k) = (0.1_f64 / 7.0, 31.7);
    // The load that the spring carries there, up to a unit in the last place.
    let carried = (k * place).next_up();
    let table = |s: f64| {
        let forces = [carried + 1.0, carried + 1.0, carried, carried].map(|f| s * f);
        Load::table(Table::new(vec![0.0, 0.05, 0.0501, 9.0], forces.to_vec()).expect("a sound table"))
    };
    for (wall, s) in [(Wall::upper("wall", place), 1.0), (Wall::lower("wall", -place), -1.0)] {
        for scheme in CONSTRAINED.into_iter().chain([GENERALIZED_ALPHA]) {
            let scene = Scene::oscillator(1.0, 0.1, k)
                .with_wall(wall.clone())
                .with_load(table(s))
                .with_initial(&[s * place], &[0.0])
                .with_duration(0.1);
            let (found, _) = made(&scene, &scheme, 1e-2);
            let [contact] = found[..] else { panic!("{scheme}: {found:?}") };
            // 1 N for 0.05 s, up to one step and a half: which instant stands for a step's load is
            // the scheme's affair.
            assert!(contact.end.is_some_and(|end| (end - 0.05).abs() < 0.0151), "{scheme}: {contact:?}");
            assert!((-s * contact.impulse - 0.05).abs() < 0.0101, "{scheme}: {contact:?}");
        }
    }
}
