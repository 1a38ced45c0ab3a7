//! The exact scheme round holes: closed forms with 25 digits, and what holds of every scene.
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

use crate::draws;
use crate::pendulum::{IMPULSE, PERIOD, WORK, pendulum};
use crate::random_structures::Draws;
use crate::rubbing::{
    MOREAU_JEAN, body, change_hole, energy, hole, isotropic, load, random_scene, rotating, turned, with, with_flats,
};
use crate::steps::{HoleStep, Pushes};
use signorini::case::Case;
use signorini::linear::Symmetric;
use signorini::residual::Judge;
use signorini::variation::Product;
use signorini::{
    Load, Options, PlaneRows, Refuted, Row, Run, Scene, Scheme, State, Step, Stepper, Structure, Wall, run,
};

/// Follows `scene` to its end under a judge, who finds nothing.
fn follow(scene: &Scene, stride: f64, mut observe: impl FnMut(&Step<'_>)) -> Stepper {
    let mut stepper = Stepper::new(scene, &Scheme::Event, stride).unwrap_or_else(|error| panic!("{error}"));
    let state = stepper.state();
    let mut judge = Judge::new(scene, stepper.contract(), stride, &state.q, &state.v);
    while stepper.time() < scene.duration {
        let step = stepper.step().unwrap_or_else(|error| panic!("{error}"));
        judge.observe(&step);
        observe(&step);
    }
    let findings = judge.findings();
    assert!(findings.is_empty(), "{findings:#?}");
    stepper
}

/// The run with all its rows and statistics.
fn made(scene: &Scene, rows: f64) -> Run {
    let options = Options::with_step(scene.duration / rows).with_sample(scene.duration / rows);
    let run = run(scene, &Scheme::Event, &options).unwrap_or_else(|error| panic!("{error}"));
    assert!(run.findings.is_empty(), "{:#?}", run.findings);
    run
}

/// The work of wear of the first support, J: in the statistics, in the last row and in the
/// contacts.
fn works(run: &Run, duration: f64) -> [f64; 3] {
    let contacts = run.trajectory.contact_wear().iter().flatten().map(|wear| wear.work).sum();
    let rate = run.statistics.wear[0].work_rate_w;
    [rate * duration, *run.trajectory.wear_work()[0].last().unwrap(), contacts]
}

fn near(found: f64, wanted: f64, share: f64) -> bool {
    (found / wanted - 1.0).abs() <= share
}

/// A free mass in a round hole: `disk-billiard` at e = 1, `disk-settling` at e = ½.
pub fn free(restitution: f64) -> Scene {
    with(isotropic(1.3, 0.0, 0.0), hole("hole", body(), 2e-3, restitution, 0.0))
        .with_initial(&[0.5e-3, -0.3e-3], &[0.11, 0.07])
        .with_duration(0.5)
}

#[test]
fn a_billiard_is_followed_to_rounding() {
    let state = follow(&free(1.0), 1.0, |_| {}).state();
    // Each of 17 reflections turns the rounding of a place by an angle of the order of 1.
    let off = |found: f64, wanted: f64, scale: f64| ((found - wanted) / scale).abs();
    assert!(off(state.q[0], 0.0003433534070038033023707511, 2e-3) < 1e-13, "{state:?}");
    assert!(off(state.q[1], -0.0004381115729204081082607272, 2e-3) < 1e-13, "{state:?}");
    assert!(off(state.v[0], 0.0680491580300597057513295, 0.13) < 1e-13, "{state:?}");
    assert!(off(state.v[1], 0.1112174091201551083268255, 0.13) < 1e-13, "{state:?}");
    let run = made(&free(1.0), 50.0);
    let contacts = run.trajectory.contacts();
    assert_eq!((contacts.len(), run.counters.handed_steps), (17, 0));
    let chord = 0.02961716513422976636508525;
    for (k, contact) in contacts.iter().enumerate() {
        let start = 0.01280858256711488317754263 + chord * k as f64;
        assert!((contact.start - start).abs() < 1e-15 && contact.end == Some(contact.start), "{contact:?}");
        assert!(near(contact.approach_speed, 0.1258729518204765070091123, 1e-13), "{contact:?}");
        assert!(near(contact.impulse, 5.563584470465061609802764 / 17.0, 1e-13), "{contact:?}");
    }
    let [y, z] = &run.trajectory.hole_impulses()[0];
    assert!(near(y.iter().sum(), -0.05453609456092238252327166, 1e-12));
    assert!(near(z.iter().sum(), 0.05358263185620164082487309, 1e-12));
    for work in works(&run, 0.5) {
        assert!(near(work, 0.189161871995812094733294, 1e-13), "{work}");
    }
    let angle = run.trajectory.contact_wear()[0].unwrap().angle.to_radians();
    assert!(near(angle, 0.302911476391115159729852, 1e-13), "{angle}");
    let support = &run.statistics.wear[0];
    assert!(
        support.upper_figure && near(support.impact_share.unwrap(), 1.0, 1e-14) && support.sliding_m == 0.0,
        "{support:?}"
    );
    let force = run.statistics.supports[0].force.unwrap();
    assert!(near(force.mean_n, 5.563584470465061609802764 / 0.5, 1e-13));
    assert!(near(force.mean_vector_n[0], -0.05453609456092238252327166 / 0.5, 1e-12));
}

#[test]
fn infinitely_many_impacts_end_in_sliding() {
    let run = made(&free(0.5), 40.0);
    let state = follow(&free(0.5), 1.0, |_| {}).state();
    // The accumulation is cut where the flights are 1e-12 of the gap high: their speeds are 1e-6 of
    // the others, and what is cut off is the square of that.
    assert!((state.q[0] - -0.0009181051652052060785297577).abs() < 1e-12 * 2e-3, "{state:?}");
    assert!((state.q[1] - -0.001776818197121900610174778).abs() < 1e-12 * 2e-3, "{state:?}");
    assert!(near(state.v[0].hypot(state.v[1]), 0.034, 1e-12));
    for work in works(&run, 0.5) {
        assert!(near(work, 0.0238862564138352009454, 1e-12), "{work}");
    }
    let contacts = run.trajectory.contacts();
    let impulse: f64 = contacts.iter().map(|contact| contact.impulse).sum();
    assert!(near(impulse, 0.7025369533480941454529411, 1e-12), "{impulse}");
    let last = contacts.last().unwrap();
    // Settled up to the time of the rest of the flights: 1e-6 of the last ones.
    assert!(last.end.is_none() && (last.start - 0.218349159903865094334039).abs() < 1e-6, "{last:?}");
    assert!(near(last.peak_force.unwrap(), 0.7514, 1e-12));
    let support = &run.statistics.wear[0];
    assert!(near(support.sliding_m, 0.009576128563268586792642672, 1e-5), "{}", support.sliding_m);
    let sectors: f64 = support.sectors.iter().map(|sector| sector.work_rate_w).sum();
    assert!(near(sectors, support.work_rate_w, 1e-13));
}

#[test]
fn a_pendulum_slides_as_elliptic_functions_say() {
    // 1e-14 of the gap after a period of 12 stretches, and roundings that add up after 100.
    for (periods, most) in [(1.0, 1e-14), (100.0, 1e-13)] {
        let scene = pendulum().with_duration(periods * PERIOD);
        let stepper = follow(&scene, 1.0, |_| {});
        let state = stepper.state();
        let off = |k: usize| ((state.q[k] - scene.initial.q[k]) / 1.5e-3).abs();
        assert!(off(0) < most && off(1) < most, "{periods}: {:e} {:e}", off(0), off(1));
        assert!(stepper.counters().steps as f64 <= 14.0 * periods, "{:?}", stepper.counters());
    }
    let scene = pendulum().with_duration(0.05);
    let stepper = follow(&scene, 1.0, |_| {});
    let state = stepper.state();
    assert!((state.q[0] - 0.0007650669652438113098606166).abs() < 1e-14 * 1.5e-3);
    assert!((state.q[1] - -0.001290221895137663836570581).abs() < 1e-14 * 1.5e-3);
    // 37 rows a period: rows end inside stretches, and the speed turns inside of one.
    let run = made(&pendulum().with_duration(2.0 * PERIOD), 74.0);
    // The mean force holds the weight.
    let [y, z] = run.trajectory.hole_forces()[0].each_ref().map(|column| column.iter().sum::<f64>() / 74.0);
    assert!(near(y, -6.0, 1e-12) && z.abs() < 1e-12, "{y} {z}");
    for work in works(&run, 2.0 * PERIOD) {
        assert!(near(work, 2.0 * WORK, 1e-13), "{work}");
    }
    let support = &run.statistics.wear[0];
    assert!(near(support.sliding_m, 2.0 * 0.006283185307179586476925287, 1e-12));
    assert!(near(support.contact_time_ratio, 1.0, 1e-12));
    let force = run.statistics.supports[0].force.unwrap();
    assert!(near(force.mean_n, IMPULSE / PERIOD, 1e-13));
    assert!(near(force.mean_vector_n[0], -6.0, 1e-12) && force.mean_vector_n[1].abs() < 1e-12, "{force:?}");
    let contacts = run.trajectory.contacts();
    assert!(contacts.len() == 1 && near(contacts[0].peak_force.unwrap(), 12.0, 1e-13), "{contacts:?}");
}

/// `disk-whirl`: pressed round a hole by a rotating force.
fn whirl() -> Scene {
    let scene = with(isotropic(1.0, 0.2, 100.0), hole("hole", body(), 5e-3, 0.3, 0.0));
    rotating(scene, 3.0, 5.0)
        .with_initial(
            &[0.004999725836805646248435293, -0.00005235987755982988730771072],
            &[0.001644934066848226436472415, 0.1570710195887169973571628],
        )
        .with_duration(2.0)
}

#[test]
fn a_whirling_body_is_pressed_with_the_force_of_the_closed_form() {
    let mut worst = 0.0_f64;
    let stepper = follow(&whirl(), 1.0, |step| {
        let span = step.end - step.start;
        if span > 0.0 {
            worst = worst.max((step.impulse[0] / span / 7.434637702628067058478421 - 1.0).abs());
        }
    });
    // The start has roundings, which swing about the steady motion.
    assert!(worst < 1e-13, "{worst:e}");
    // Ten turns: 2.1 stretches each, and those that rows would cut.
    assert!(stepper.counters().steps < 60, "{:?}", stepper.counters());
    let run = made(&whirl(), 100.0);
    for work in works(&run, 2.0) {
        assert!(near(work, 2.0 * 1.16783015943390166549683, 1e-13), "{work}");
    }
    // All round, twelve sectors get the same.
    let sectors = &run.statistics.wear[0].sectors;
    for sector in sectors {
        // A sector's edge lies in a piece of at most 0.04 rad.
        assert!(near(sector.impulse_share, 1.0 / sectors.len() as f64, 0.1), "{sector:?}");
    }
    assert_eq!(run.counters.handed_steps, 0);
}

#[test]
fn a_body_lets_go_where_its_force_vanishes() {
    let gap = 1.5e-3;
    let scene = with(isotropic(0.8, 0.5, 200.0), hole("hole", body(), gap, 0.5, 0.0))
        .with_initial(&[gap, 0.0], &[0.0, 0.06])
        .with_duration(1.6);
    let run = made(&scene, 160.0);
    let contacts = run.trajectory.contacts();
    // N falls by 1.1 N/s there, so the instant has the rounding of the force over that.
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    assert!((contacts[0].end.unwrap() - 1.485038392292500937988321).abs() < 1e-12, "{contacts:?}");
    assert!(near(contacts[0].impulse, 0.8504884823122497186035037, 1e-12), "{contacts:?}");
    assert!(near(contacts[0].peak_force.unwrap(), 1.62, 1e-13));
    for work in works(&run, 1.6) {
        assert!(near(work, 0.04022946638440411039679734, 1e-12), "{work}");
    }
}

#[test]
fn flats_in_two_planes_are_unfolded_billiards() {
    let flats = [0.0, 90.0, 180.0, 270.0].map(|direction| (direction + 20.0, 1e-3));
    let scene = with_flats(isotropic(1.3, 0.0, 0.0), "square", body(), &flats, 1.0, 0.0)
        .with_initial(&[0.0002, -0.0006], &[0.05, 0.083])
        .with_duration(1.0);
    // A round hole that is never reached makes it a scene with holes.
    for scene in [scene.clone(), with(scene, hole("wide", body(), 1.0, 0.5, 0.0))] {
        let state = follow(&scene, 1.0, |_| {}).state();
        assert!((state.q[0] - -0.0006954305801889132054663282).abs() < 1e-15, "{state:?}");
        assert!((state.q[1] - 0.00002491186009467324540187264).abs() < 1e-15, "{state:?}");
        let run = made(&scene, 100.0);
        assert_eq!(run.trajectory.contacts().len(), 68);
        for work in works(&run, 1.0) {
            assert!(near(work, 0.8114557507972737095142388, 1e-12), "{work}");
        }
    }
}

#[test]
fn on_a_diameter_a_hole_is_a_pair_of_planar_walls() {
    // An oscillator under a sine that hits and, at e = 0, rests on its walls for a while.
    for (restitution, stiffness) in [(0.0, 50.0), (0.4, 100.0), (1.0, 100.0)] {
        let gap = 2e-3;
        let line = Scene::structure(Structure {
            mass: Symmetric::diagonal(&[0.7, 0.7]),
            damping: Symmetric::diagonal(&[0.1; 2]),
            stiffness: Symmetric::diagonal(&[stiffness; 2]),
        })
        .with_load(load(Load::harmonic(2.0, 3.1, 0.2), Row::dof(0)))
        .with_duration(1.5);
        let walls = [Wall::upper("upper", gap), Wall::lower("lower", -gap)];
        let planar =
            walls.into_iter().fold(line.clone(), |scene, wall| scene.with_wall(wall.with_restitution(restitution)));
        let round = with(line, hole("hole", body(), gap, restitution, 0.0));
        let [flat, round] = [planar, round].map(|scene| {
            let mut sum = 0.0;
            let stepper = follow(&scene, 1.0, |step| {
                sum += step.impulse.iter().map(|p| p.abs()).sum::<f64>();
            });
            (stepper.state(), sum, stepper.counters().events)
        });
        // Errors grow with each impact; at most some hundred of them.
        let apart = (flat.0.q[0] - round.0.q[0]).abs() / gap;
        assert!(apart < 1e-9 && round.0.q[1] == 0.0, "{restitution}: {apart:e} {:?}", (flat, round));
        assert!(near(round.1, flat.1, 1e-9), "{restitution}: {:?}", (flat, round));
    }
}

/// Two masses in two planes, joined and held by springs, in two holes of which one lies beside its
/// place, under rotating forces.
fn two_holes() -> Scene {
    let chain = |a: f64, b: f64| {
        let entries = [(0, 0, a), (1, 1, a), (2, 2, b), (3, 3, b)];
        Symmetric::from_entries(4, entries)
    };
    let mut stiffness = chain(900.0, 1400.0);
    stiffness =
        Symmetric::from_entries(4, stiffness.entries().chain([(2, 0, -500.0), (3, 1, -500.0)]).collect::<Vec<_>>());
    let scene =
        Scene::structure(Structure { mass: chain(0.5, 0.8), damping: Symmetric::diagonal(&[0.4; 4]), stiffness });
    let place = |i: usize| PlaneRows { y: Row::dof(2 * i), z: Row::dof(2 * i + 1) };
    let off = hole("off", place(1), 0.8e-3, 0.6, 0.0).with_centre([0.3e-3, -0.2e-3]);
    let scene = with(with(scene, hole("first", place(0), 1e-3, 0.4, 0.0)), off);
    rotating(scene, 4.0, 7.0).with_initial(&[0.0; 4], &[0.1, 0.05, 0.0, 0.08]).with_duration(0.4)
}

#[test]
fn several_holes_at_once_and_flats_keep_their_laws() {
    let mut together = 0;
    let stepper = follow(&two_holes(), 1.0, |step| {
        together += u32::from(step.impulse.iter().all(|p| *p > 0.0));
    });
    assert!(together > 0 && stepper.counters().handed_steps == 0, "{:?}", stepper.counters());
    // Flats at the place of the first hole cut off pieces of its circle.
    let flats = [(10.0, 0.9e-3), (200.0, 0.95e-3)];
    let mixed = with_flats(two_holes(), "flats", PlaneRows { y: Row::dof(0), z: Row::dof(1) }, &flats, 0.3, 0.0);
    let mut both = 0;
    follow(&mixed, 1.0, |step| {
        let mut walls = mixed.walls.iter().zip(step.impulse);
        let flat = walls.clone().any(|(wall, p)| !wall.is_round() && *p != 0.0);
        both += u32::from(flat && walls.any(|(wall, p)| wall.is_round() && *p > 0.0));
    });
    assert!(both > 0);
}

#[test]
fn turning_a_scene_turns_its_motion() {
    let scene = two_holes();
    let state = follow(&scene, 1.0, |_| {}).state();
    let other = follow(&turned(&scene, 37.0), 1.0, |_| {}).state();
    let (s, c) = 37.0_f64.to_radians().sin_cos();
    for k in [0, 2] {
        let back = [c * other.q[k] + s * other.q[k + 1], c * other.q[k + 1] - s * other.q[k]];
        let apart = (back[0] - state.q[k]).hypot(back[1] - state.q[k + 1]) / 1e-3;
        // Rounding that some dozen impacts enlarge.
        assert!(apart < 1e-9, "{apart:e}");
    }
}

#[test]
fn energy_stays_without_losses() {
    // Reflected for ever at e = 1 between springs, and sliding round the hole.
    let bouncing = with(isotropic(0.8, 0.0, 300.0), hole("hole", body(), 1e-3, 1.0, 0.0))
        .with_initial(&[0.2e-3, 0.1e-3], &[0.05, -0.02])
        .with_duration(2.0);
    let sliding = with(isotropic(0.8, 0.0, 0.0), hole("hole", body(), 1e-3, 0.0, 0.0))
        .with_initial(&[1e-3, 0.0], &[0.0, 0.1])
        .with_duration(10.0);
    for (scene, most) in [(bouncing, 1e-13), (sliding, 1e-12)] {
        let start = energy(&scene, &scene.initial.q, &scene.initial.v);
        let mut worst = 0.0_f64;
        follow(&scene, 1.0, |step| worst = worst.max((energy(&scene, step.q, step.v) / start - 1.0).abs()));
        // Roundings of a few hundred events, and of some hundred turns.
        assert!(worst < most, "{worst:e}");
    }
}

#[test]
fn moreau_jean_converges_to_it() {
    let off = |scene: &Scene, exact: &State, steps: u64| {
        let mut stepper = Stepper::new(scene, &MOREAU_JEAN, scene.duration / steps as f64).unwrap();
        for _ in 0..steps {
            stepper.step().unwrap();
        }
        let q = stepper.state().q;
        q.iter().zip(&exact.q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    // Sliding: order 2. A pendulum over a part of its period.
    let scene = pendulum().with_duration(0.04);
    let exact = follow(&scene, 1.0, |_| {}).state();
    let [coarse, fine] = [1000, 4000].map(|steps| off(&scene, &exact, steps));
    let order = (coarse / fine).log2() / 2.0;
    assert!((1.9..2.1).contains(&order), "{order}: {coarse:e} {fine:e}");
    // Through impacts: order 1. The error of one step length has a phase; take the worst of some.
    let scene = two_holes().with_duration(0.1);
    let exact = follow(&scene, 1.0, |_| {}).state();
    let worst = |steps: u64| (0..5).map(|k| off(&scene, &exact, steps + 7 * k)).fold(0.0, f64::max);
    let [coarse, fine] = [4000, 64_000].map(worst);
    let order = (coarse / fine).log2() / 4.0;
    assert!((0.7..1.4).contains(&order), "{order}: {coarse:e} {fine:e}");
}

#[test]
fn random_scenes_keep_every_law() {
    let mut draws = Draws::new(draws::seed(11));
    let (mut slid, mut struck, mut handed) = (0_u64, 0_u64, 0_u64);
    for case in 0..draws::cases(60) {
        let scene = random_scene(&mut draws, 0.0).with_duration(0.3);
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap_or_else(|error| panic!("{case}: {error}"));
        let state = stepper.state();
        let mut judge = Judge::new(&scene, stepper.contract(), 1.0, &state.q, &state.v);
        let mut last = energy(&scene, &state.q, &state.v);
        let scale = last;
        let mut exact = true;
        while stepper.time() < scene.duration {
            let step = stepper.step().unwrap_or_else(|error| panic!("{case}: {error}"));
            judge.observe(&step);
            let now = energy(&scene, step.q, step.v);
            exact &= matches!(step.path, signorini::Path::Series(_));
            // Nothing but impacts changes the energy, and they never add any; steps that are handed
            // over move what is behind a wall back onto it.
            assert!(!exact || now <= last + 1e-13 * scale, "{case}: {:e} at {}", now - last, step.end);
            last = now;
            slid += u64::from(step.impulse.iter().zip(step.jump).any(|(impulse, jump)| impulse > jump));
            struck += u64::from(step.jump.iter().any(|jump| *jump > 0.0));
        }
        let findings = judge.findings();
        assert!(findings.is_empty(), "{case}: {findings:#?}");
        handed += u64::from(!stepper.handed().is_empty());
    }
    assert!(slid > 100 && struck > 100, "{slid} {struck} {handed}");
}

/// The findings on the motion of `scene` of a judge who is told the scene `told`, and of each step
/// what `alter` makes of its holes.
fn accused(scene: &Scene, told: &Scene, alter: impl Fn(&mut HoleStep)) -> Vec<Refuted> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, 1.0).unwrap();
    let state = stepper.state();
    let mut judge = Judge::new(told, stepper.contract(), 1.0, &state.q, &state.v);
    while stepper.time() < scene.duration {
        let mut step = stepper.step().unwrap();
        let mut pushes = Pushes::of(&step);
        for hole in (0..step.impulse.len()).filter(|&hole| step.impulse[hole] > 0.0) {
            pushes.alter(hole, &alter);
        }
        pushes.show(&mut step);
        judge.observe(&step);
    }
    judge.findings().into_iter().map(|finding| finding.refuted).collect()
}

#[test]
fn the_judge_of_exact_motion_finds_faults() {
    let changed = |scene: &Scene, share: f64, e: f64, centre: [f64; 2]| {
        let mut told = scene.clone();
        change_hole(&mut told, 0, |hole| {
            let gap = hole.position() * share;
            hole.with_position(gap).with_centre(centre).with_restitution(e)
        });
        told
    };
    let (settling, sliding, still) = (free(0.5), pendulum().with_duration(PERIOD), |_: &mut HoleStep| ());
    for (scene, e) in [(&settling, 0.5), (&sliding, 0.7)] {
        assert_eq!(accused(scene, &changed(scene, 1.0, e, [0.0; 2]), still), []);
        // Faults of 1e-4 and 1e-5, beyond the tolerance of 1e-6.
        let narrow = accused(scene, &changed(scene, 1.0 - 1e-5, e, [0.0; 2]), still);
        assert!(narrow.contains(&Refuted::Penetration), "{narrow:?}");
        let wide = accused(scene, &changed(scene, 1.0 + 1e-5, e, [0.0; 2]), still);
        assert!(wide.contains(&Refuted::Complementarity), "{wide:?}");
        let beside = accused(scene, &changed(scene, 1.0, e, [1e-5 * 1.5e-3, 0.0]), still);
        assert!(beside.contains(&Refuted::Complementarity) || beside.contains(&Refuted::Penetration), "{beside:?}");
    }
    let elastic = accused(&settling, &changed(&settling, 1.0, 0.5001, [0.0; 2]), still);
    assert!(elastic.contains(&Refuted::Complementarity), "{elastic:?}");
    let askew = accused(&sliding, &sliding, |hole| hole.turned[1] += 1e-4 * hole.impulse);
    assert!(askew.contains(&Refuted::Normal), "{askew:?}");
    // Impulses that the change of the energy does not show.
    let more = accused(&settling, &settling, |hole| (hole.jump, hole.impulse) = (1.001 * hole.jump, hole.impulse));
    assert!(more.contains(&Refuted::Energy), "{more:?}");
}

#[test]
fn impacts_that_never_settle_are_handed_over_and_told() {
    // e = 1 under drag and a constant pull: flights shrink for ever.
    let scene = with(isotropic(1.0, 20.0, 0.0), hole("hole", body(), 1e-3, 1.0, 0.0))
        .with_load(load(Load::constant(5.0), Row::dof(0)))
        .with_initial(&[0.0, 0.0], &[0.1, 0.0])
        .with_duration(100.0);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
    let state = stepper.state();
    let mut judge = Judge::new(&scene, stepper.contract(), 1.0, &state.q, &state.v);
    let mut handed = 0;
    while handed < 1000 {
        let step = stepper.step().unwrap();
        handed += u32::from(matches!(step.path, signorini::Path::Handed { .. }));
        judge.observe(&step);
    }
    assert_eq!(judge.findings(), []);
    // 200 steps a stretch; what is told is where they are and how long their steps.
    let [told] = stepper.handed() else { panic!("{:?}", stepper.handed()) };
    assert!(stepper.counters().handed_steps == 1000 && told.from > 0.5 && told.to > told.from + 0.1, "{told:?}");
    assert!(near(told.step, 0.1 / 200.0, 0.1), "{told:?}");
}

#[test]
fn what_is_not_exact_is_refused_by_name() {
    let rough = with(isotropic(1.0, 0.0, 100.0), hole("rough", body(), 1e-3, 0.5, 0.2));
    let error = Stepper::new(&rough, &Scheme::Event, 1.0).unwrap_err();
    let text = error.to_string();
    assert!(error.is_request() && text.contains("friction") && text.contains("\"rough\""), "{text}");
    let round = with(isotropic(1.0, 0.0, 100.0), hole("hole", body(), 1e-3, 0.5, 0.0));
    let error = Product::new(&round).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("round"), "{error}");
    // A restart outside of the hole.
    let mut stepper = Stepper::new(&round, &Scheme::Event, 1.0).unwrap();
    let outside = State { q: vec![0.8e-3, 0.8e-3], v: vec![0.0; 2] };
    let error = stepper.set_state(0.1, &outside).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("\"hole\""), "{error}");
    let inside = State { q: vec![0.5e-3, 0.5e-3], v: vec![0.0; 2] };
    assert!(stepper.set_state(0.1, &inside).is_ok());
    assert!(stepper.step().is_ok());
}

/// A free mass of 1 kg pushed along y from the centre of a hole.
fn pushed(gap: f64, e: f64, force: f64, stiffness: f64) -> Scene {
    with(isotropic(1.0, 0.0, stiffness), hole("hole", body(), gap, e, 0.0))
        .with_load(load(Load::constant(force), Row::dof(0)))
        .with_duration(1.0)
}

#[test]
fn bounces_against_a_push_are_followed_until_their_height_is_1e_minus_12_of_the_gap() {
    // Without a spring the impact of number k has the speed v eᵏ and the flight after it the height
    // γ e²ᵏ⁺²: those of 1e-12 γ and less are the tail, whose first impact ends the bounces.
    for e in [0.2, 0.5, 0.7, 0.8] {
        let run = made(&pushed(1e-3, e, 10.0, 0.0), 100.0);
        let contacts = run.trajectory.contacts();
        let tail = (0.5 * 1e-12_f64.ln() / f64::ln(e)).ceil() as usize;
        assert_eq!(contacts.len(), tail, "{e}");
        let speed = (2.0 * 10.0 * 1e-3_f64).sqrt();
        for (k, contact) in contacts.iter().enumerate() {
            let share = e.powi(k as i32);
            // The height is known to rounding of the gap: the later, the fewer digits are left.
            let left = 1e-15 / (share * share);
            assert!(near(contact.approach_speed, speed * share, 1e-12 + left), "{e}, {k}: {contact:?}");
        }
    }
}

#[test]
fn a_push_that_ends_in_rest_is_accused_at_no_restitution_force_or_gap() {
    for share in 1..20 {
        for force in [0.1, 1.0, 10.0] {
            for gap in [1e-4, 1e-3, 1e-2] {
                made(&pushed(gap, 0.05 * f64::from(share), force, 1.0), 20.0);
            }
        }
    }
}

#[test]
fn a_slide_begins_where_the_body_stands() {
    let run = made(&pendulum().with_duration(0.05), 10.0);
    let wear = run.trajectory.contact_wear()[0].expect("a contact in the hole");
    // An angle of some units in the last place.
    assert!((wear.angle - 60.0).abs() < 1e-12, "{}", wear.angle);
}

/// A body that whirls round a hole passes its sectors one after the other: the work in each changes
/// little from the last, however narrow they are. A piece of motion in one sector alone had ± 25 %.
#[test]
fn the_work_of_exact_motion_is_divided_among_the_sectors_that_it_passes() {
    let changed = [("support.hole.friction", 0.0), ("wear.sectors", 72.0), ("time.end", 0.4)];
    let case = changed
        .into_iter()
        .fold(Case::embedded("whirl-in-a-hole").unwrap(), |case, (key, value)| case.with(key, value).unwrap());
    let run = run(&case.scene, &Scheme::Event, &Options::new(case.time)).unwrap();
    let sectors = &run.statistics.wear[0].sectors;
    // In the sectors away from the two at which the passages of 0.4 s begin and end.
    let apart = |pair: &[signorini::SectorStatistics]| (pair[1].work_rate_w / pair[0].work_rate_w - 1.0).abs();
    let worst = sectors[28..43].windows(2).map(apart).fold(0.0, f64::max);
    assert!(worst < 0.02, "{worst}");
}
