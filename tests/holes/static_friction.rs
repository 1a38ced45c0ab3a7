//! Friction that drops where a slide begins: closed forms, and what the judge notices.

use crate::draws::cases;
use crate::random_structures::Draws;
use crate::rubbing::{MOREAU_JEAN, body, hole, isotropic, load, random_scene, rotating, with, with_flats};
use signorini::residual::Judge;
use signorini::{
    Finding, FrictionCoefficients, Load, Options, Refuted, Row, Scene, Scheme, Slider, Stepper, Table, WallLaw, run,
};
use std::f64::consts::PI;

const BOTH: FrictionCoefficients = FrictionCoefficients { sticking: 0.3, sliding: 0.2 };

/// The push on the flat, N.
const PUSH: f64 = 10.0;

/// A body on a flat, pressed by [`PUSH`] and drawn along it by a force that grows at `rate` (N/s)
/// for `duration` seconds.
fn drawn(scene: Scene, rate: f64, duration: f64) -> Scene {
    let mut scene = with_flats(scene, "floor", body(), &[(0.0, 0.0)], 0.5, 0.0)
        .with_load(load(Load::constant(PUSH), Row::dof(0)))
        .with_load(load(Load::table(Table::new(vec![0.0, 1e2], vec![0.0, 1e2 * rate]).unwrap()), Row::dof(1)))
        .with_duration(duration);
    scene.walls[0].friction = BOTH;
    scene
}

/// The instants at which slides begin, s, and the state at the end.
fn slides(scene: &Scene, scheme: Scheme, h: f64) -> (Vec<f64>, [f64; 2]) {
    let mut stepper = Stepper::new(scene, &scheme, h).unwrap();
    let (mut begins, mut moved) = (Vec::new(), false);
    while stepper.time() < scene.duration - 0.5 * h {
        let step = stepper.step().unwrap();
        let moves = step.velocity_after[1].abs() > 1e-9;
        if moves && !moved && step.end > step.start {
            begins.push(step.start);
        }
        moved = moves;
    }
    let state = stepper.state();
    (begins, [state.q[1], state.v[1]])
}

fn findings(scene: &Scene, scheme: Scheme, h: f64) -> Vec<Finding> {
    run(scene, &scheme, &Options::with_step(h)).unwrap_or_else(|error| panic!("{error}")).findings
}

#[test]
fn a_drawn_body_begins_to_slide_at_the_static_limit_and_goes_on_with_kinetic_friction() {
    let (mass, rate, duration) = (2.0, 9.7, 0.5);
    let scene = drawn(isotropic(mass, 0.0, 0.0), rate, duration);
    let mut pressed = scene.clone();
    // The same on a floor that yields by 0.1 mm under the push.
    pressed.walls[0].law = WallLaw::Elastic { stiffness: 1e5, damping: 0.0 };
    pressed.initial.q[0] = 1e-4;
    let begin = BOTH.sticking * PUSH / rate;
    let left = duration - begin;
    let gained = [3, 2].map(|power| (duration.powi(power) - begin.powi(power)) / f64::from(power));
    let v = (rate * gained[1] - BOTH.sliding * PUSH * left) / mass;
    let x = (rate * (0.5 * gained[0] - 0.5 * begin * begin * left) - BOTH.sliding * PUSH * left * left * 0.5) / mass;
    for scene in [scene, pressed] {
        for h in [1e-3, 2.5e-4] {
            let (begins, state) = slides(&scene, MOREAU_JEAN, h);
            // The step in which the mean force exceeds the limit slides as a whole.
            assert!(begins.len() == 1 && (begins[0] - begin).abs() <= h, "{begins:?}");
            let within = h * (BOTH.sticking - BOTH.sliding) * PUSH / mass;
            assert!((state[1] - v).abs() < within && (state[0] - x).abs() < within * left, "{state:?}");
            let (begins, state) = slides(&scene, Scheme::Located, h);
            // A force linear in time gives the instant itself.
            assert!(begins.len() == 1 && (begins[0] - begin).abs() < 1e-10, "{begins:?}");
            assert!((state[1] - v).abs() < 1e-9, "{} {v}", state[1]);
            // The θ-rule with a force linear in time is off by h² of its rate.
            assert!((state[0] - x).abs() < rate * h * h * left / mass, "{} {x}", state[0]);
            for scheme in [MOREAU_JEAN, Scheme::Located] {
                assert_eq!(findings(&scene, scheme, h), []);
            }
        }
    }
}

#[test]
fn a_mass_that_a_spring_drags_sticks_and_slips_with_the_period_of_the_closed_form() {
    let (mass, stiffness, speed) = (1.0_f64, 100.0, 0.05);
    let (omega, drop) = ((stiffness / mass).sqrt(), (BOTH.sticking - BOTH.sliding) * PUSH / stiffness);
    // A slide begins with the spring 2·drop longer than it ends with; the spring grows at `speed`.
    let period = 2.0 * drop / speed + 2.0 * (PI - (drop * omega / speed).atan()) / omega;
    let first = BOTH.sticking * PUSH / (stiffness * speed);
    let scene = drawn(isotropic(mass, 0.0, stiffness), stiffness * speed, first + 3.9 * period);
    let error = |scheme: Scheme, h: f64| {
        let (begins, [x, v]) = slides(&scene, scheme, h);
        assert!(begins.len() == 4 && v.abs() < 1e-15, "{begins:?} {v:e}");
        let expected = (0..4).map(|n| first + f64::from(n) * period);
        let late = begins.iter().zip(expected).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max);
        // It rests after four jumps, each of which makes up for a period.
        [late / period, (x / (4.0 * speed * period) - 1.0).abs()]
    };
    let [coarse, fine] = [1e-3, 1e-4].map(|h| error(MOREAU_JEAN, h));
    for (coarse, fine) in coarse.iter().zip(fine) {
        assert!(*coarse < 1e-3 && fine < coarse / 5.0, "{coarse:e} {fine:e}");
    }
    let [coarse, fine] = [4e-3, 1e-3].map(|h| error(Scheme::Located, h));
    for (coarse, fine) in coarse.iter().zip(fine) {
        assert!(*coarse < 1e-3 && fine < coarse / 8.0, "{coarse:e} {fine:e}");
    }
    for scheme in [MOREAU_JEAN, Scheme::Located] {
        assert_eq!(findings(&scene, scheme, 1e-3), []);
    }
}

#[test]
fn a_body_in_a_hole_stays_until_the_load_leaves_the_static_cone() {
    // A load of 3 N turns at 0.05 Hz; the body slides once it is atan μ from the normal.
    let scene = rotating(with(isotropic(1.0, 0.0, 0.0), hole("hole", body(), 5e-3, 0.3, 0.0)), 3.0, 0.05);
    let mut scene = scene.with_initial(&[5e-3, 0.0], &[0.0; 2]).with_duration(1.2);
    scene.walls[0].friction = BOTH;
    let begin = BOTH.sticking.atan() / (2.0 * PI * 0.05);
    let late = |scheme, h| (slides(&scene, scheme, h).0[0] - begin).abs();
    assert!(late(MOREAU_JEAN, 1e-3) <= 1e-3 && late(MOREAU_JEAN, 1e-4) <= 1e-4);
    assert!(late(Scheme::Located, 1e-3) < 1e-7 && late(Scheme::Located, 1e-2) < 1e-5);
    for scheme in [MOREAU_JEAN, Scheme::Located] {
        assert_eq!(findings(&scene, scheme, 1e-3), []);
    }
}

#[test]
fn a_body_that_arrives_sliding_has_kinetic_friction_until_it_stands() {
    // Drawn with 2.5 N, between both limits: one that slides gains speed, one that stands stays.
    let mut scene = drawn(isotropic(2.0, 0.0, 0.0), 0.0, 0.5);
    scene.loads[1] = load(Load::constant(2.5), Row::dof(1));
    for scheme in [MOREAU_JEAN, Scheme::Located] {
        for (start, end) in [(0.0, 0.0), (0.1, 0.1 + 0.5 * 0.5 / 2.0), (-0.3, 0.0)] {
            // Thrown against the load it comes to stand.
            let scene = scene.clone().with_initial(&[0.0; 2], &[0.0, start]);
            let (_, [_, v]) = slides(&scene, scheme, 1e-3);
            assert!((v - end).abs() < 1e-12, "{start} {v}");
            assert_eq!(findings(&scene, scheme, 1e-3), []);
        }
        // Pushed off the floor and back, it has slid.
        let lifted = scene.clone().with_initial(&[-1e-3, 0.0], &[0.0; 2]);
        assert!(slides(&lifted, scheme, 1e-3).1[1] > 0.05);
        assert_eq!(findings(&lifted, scheme, 1e-3), []);
    }
}

#[test]
fn the_judge_notices_either_coefficient_and_the_memory() {
    let scene = drawn(isotropic(2.0, 0.0, 0.0), 9.7, 0.5);
    for scheme in [MOREAU_JEAN, Scheme::Located] {
        for (sticking, sliding, honest) in
            [(0.3, 0.2, true), (0.29, 0.2, false), (0.3, 0.19, false), (0.3, 0.21, false), (0.2, 0.2, false)]
        {
            let mut told = scene.clone();
            told.walls[0].friction = FrictionCoefficients { sticking, sliding };
            let mut stepper = Stepper::new(&scene, &scheme, 1e-3).unwrap();
            let mut judge = Judge::new(&told, stepper.contract(), 1e-3, &scene.initial.q, &scene.initial.v);
            while stepper.time() < 0.4995 {
                judge.observe(&stepper.step().unwrap());
            }
            let found = judge.findings().iter().any(|finding| finding.refuted == Refuted::Friction);
            assert_eq!(found, !honest, "{scheme}, {sticking}, {sliding}: {:?}", judge.findings());
        }
    }
}

#[test]
fn no_random_scene_with_a_static_coefficient_is_refuted() {
    for seed in 0..cases(10_u64) {
        let mut scene = random_scene(&mut Draws::new(seed), 0.0).with_duration(0.2);
        let sliding = 0.1 * (seed % 5) as f64;
        for wall in &mut scene.walls {
            wall.friction = FrictionCoefficients { sticking: sliding + 0.15, sliding };
        }
        let scene = scene.with_load(load(Load::harmonic(40.0, 7.0, 0.3), Row::dof(0)));
        for scheme in [MOREAU_JEAN, Scheme::Located] {
            match run(&scene, &scheme, &Options::with_step(1e-4)) {
                Ok(run) => assert_eq!(run.findings, [], "seed {seed}, {scheme}"),
                // A body that friction jams may have no motion at a coarse step.
                Err(error) => assert!(scheme == Scheme::Located && error.to_string().contains("no motion"), "{error}"),
            }
        }
    }
}

/// 1 kg on 1000 N/m between pads of 10 N in all that hold 4 N together, under a load that grows by
/// 10 N/s. How pads share what holds the body is not determined: one may be at its limit alone.
#[test]
fn contacts_that_hold_the_same_motion_let_go_together() {
    let scene = |pads: u32| {
        let load = Table::new(vec![0.0, 1.0], vec![0.0, 10.0]).unwrap();
        let scene = Scene::oscillator(1.0, 0.0, 1000.0).with_load(Load::table(load)).with_duration(0.6);
        (0..pads).fold(scene, |scene, number| {
            let friction = FrictionCoefficients { sticking: 0.4, sliding: 0.2 };
            let name = format!("pad-{number}");
            let normal_force = 10.0 / f64::from(pads);
            scene.with_slider(&Slider { name, at: Row::dof(0), normal_force, friction }).unwrap()
        })
    };
    for scheme in [Scheme::MoreauJean { theta: 0.5 }, Scheme::Located] {
        for step in [2e-4, 1e-4] {
            let [one, two, three] =
                [1, 2, 3].map(|pads| run(&scene(pads), &scheme, &Options::with_step(step)).unwrap());
            for several in [&two, &three] {
                assert_eq!(several.findings, []);
                let [(w, _), (alone, _)] = [several, &one].map(|run| run.trajectory.probe("").unwrap());
                let slides = several.trajectory.time().iter().zip(w).find(|(_, w)| w.abs() > 1e-9).unwrap().0;
                // Its first step of motion is well below 1e-9 m.
                assert!((slides - 0.4).abs() < 4.0 * step + 1e-3, "{scheme}, {step}: {slides}");
                let apart = w.iter().zip(alone).map(|(w, alone)| (w - alone).abs()).fold(0.0, f64::max);
                // Of 8 mm: the rounding of impulses that are shared another way.
                assert!(apart < 1e-10, "{scheme}, {step}: {apart:e}");
            }
        }
    }
}
