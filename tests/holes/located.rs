//! `located` in round holes and with friction: against closed forms and the exact scheme, by the
//! order at which its error falls.
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

use crate::draws;
use crate::pendulum::{GAP, IMPULSE, PERIOD, WORK, pendulum};
use crate::random_structures::Draws;
use crate::rubbing::{body, hole, isotropic, load, random_scene, with, with_flats};
use signorini::{FrictionCoefficients, Load, Options, Row, Run, Scene, Scheme, WallLaw, run};
use std::f64::consts::{PI, TAU};

/// The run of `located` in steps of `step` seconds, of which the judge finds nothing.
fn made(scene: &Scene, step: f64) -> Run {
    let run = run(scene, &Scheme::Located, &Options::with_step(step)).unwrap_or_else(|error| panic!("{error}"));
    assert!(run.findings.is_empty(), "{:#?}", run.findings);
    // Also where a part has nearly no length, over which rounding would be a large force.
    assert!(run.residuals.force_balance < 1e-12, "{:?}", run.residuals);
    run
}

fn impulse(run: &Run) -> f64 {
    run.trajectory.contacts().iter().map(|contact| contact.impulse.abs()).sum()
}

/// True if `errors`, of steps of which each is half as long as the one before, fall with order 2 at
/// least: by a factor of 4 each, of which all together may miss a half, since impacts fall anywhere
/// within a step.
fn of_order_two(errors: &[f64]) -> bool {
    errors[0] / errors[errors.len() - 1] > 0.5 * 4_f64.powi(errors.len() as i32 - 1)
}

#[test]
fn a_pendulum_in_a_hole_keeps_its_energy_and_is_of_order_two() {
    let scene = pendulum().with_duration(PERIOD);
    let mut errors = [vec![], vec![], vec![]];
    for steps in [200, 400, 800, 1600] {
        let run = made(&scene, PERIOD / f64::from(steps));
        // At the end of a period it stands still: its place tells more on the way.
        let at = made(&pendulum().with_duration(0.05), 0.05 / f64::from(steps)).state.q;
        let off = [at[0] - 0.0007650669652438113098606166, at[1] - -0.001290221895137663836570581];
        errors[0].push(off[0].hypot(off[1]) / GAP);
        errors[1].push((impulse(&run) / IMPULSE - 1.0).abs());
        errors[2].push((run.statistics.wear[0].work_rate_w * PERIOD / WORK - 1.0).abs());
        // The push along the middle of the path does no work: rounding of some hundred steps.
        let lost = run.residuals.energy.impact_loss_j;
        assert!(lost.abs() < 1e-12 * 6.0 * GAP, "{lost:e} J");
        // The largest force is that at the lowest point, F(3 − 2 cos 60°); neighbouring means swing
        // by the change of speed over a part, which vanishes there.
        let peak = run.trajectory.contacts().iter().filter_map(|c| c.peak_force).fold(0.0, f64::max);
        assert!((peak / 12.0 - 1.0).abs() < 2e-3, "{peak} N");
        assert_eq!(run.counters.steps_given_up, 0);
        assert!(run.state.q[0].hypot(run.state.q[1]) <= GAP * (1.0 + 1e-12));
    }
    for errors in &errors {
        assert!(of_order_two(errors), "{errors:?}");
    }
    // In 200 steps a swing of 6.3 rad: (ωh)²/12 of some radians.
    assert!(errors[0][0] < 2e-3, "{errors:?}");
}

#[test]
fn a_billiard_and_its_settling_are_those_of_the_exact_motion() {
    // A free mass: parabolas are exact, so that only the end of the rebounds within a step and the
    // sliding that follows have an error.
    let free = |e: f64| {
        with(isotropic(1.3, 0.0, 0.0), hole("hole", body(), 2e-3, e, 0.0))
            .with_initial(&[0.5e-3, -0.3e-3], &[0.11, 0.07])
            .with_duration(0.5)
    };
    let run = made(&free(1.0), 1e-3);
    // 17 reflections; each turns what the search leaves, 1e-12 of the gap, by an angle of order 1.
    assert!((run.state.q[0] - 0.0003433534070038033023707511).abs() < 1e-9 * 2e-3, "{:?}", run.state);
    assert!((run.state.q[1] - -0.0004381115729204081082607272).abs() < 1e-9 * 2e-3, "{:?}", run.state);
    assert_eq!(run.trajectory.contacts().len(), 17);
    let mut errors = Vec::new();
    for step in [2e-3, 1e-3, 5e-4, 2.5e-4] {
        let run = made(&free(0.5), step);
        let [y, z] = [-0.0009181051652052060785297577, -0.001776818197121900610174778];
        errors.push((run.state.q[0] - y).hypot(run.state.q[1] - z) / 2e-3);
        assert!(errors.last().is_some_and(|error| *error < 10.0 * step), "{errors:?}");
    }
    // The rebounds end anywhere within a step, so that single ratios say little: over three
    // halvings at least by 16 of the 64 of order 2.
    assert!(errors[0] / errors[3] > 16.0, "{errors:?}");
}

#[test]
fn a_mass_on_a_spring_that_rubs_comes_to_rest_where_coulomb_says() {
    // x₀ → −(x₀ − 2μN/k) at each turn; it sticks at a turn within μN/k.
    let (mass, stiffness, push, friction, start) = (2.0, 800.0, 10.0, 0.3, 0.1);
    let (omega, band) = (20.0, friction * push / stiffness);
    let flat = with_flats(isotropic(mass, 0.0, stiffness), "flat", body(), &[(90.0, 0.0)], 0.0, friction);
    let flat = flat.with_load(load(Load::constant(push), Row::dof(1))).with_initial(&[start, 0.0], &[0.0; 2]);
    // On an elastic flat in which it lies at the depth of the load: the spring of the body there
    // takes some of that, which the load has more.
    let (contact, depth) = (1e5, push / 1e5);
    let mut elastic = flat.clone().with_initial(&[start, depth], &[0.0; 2]);
    elastic.walls[0].law = WallLaw::Elastic { stiffness: contact, damping: 30.0 };
    elastic.loads[0] = load(Load::constant(push + stiffness * depth), Row::dof(1));
    for scene in [flat, elastic] {
        let mut errors = Vec::new();
        for step in [4e-3, 2e-3, 1e-3, 5e-4] {
            // After 3½ half swings: x = −(x₀ − 7b)·… on the way from the third turn.
            let time = 3.25 * PI / omega;
            let steps = (time / step).round();
            let run = made(&scene.clone().with_duration(steps * step), step);
            let phase = omega * steps * step - 3.0 * PI;
            let turn = -(start - 6.0 * band);
            let wanted = -band + (turn + band) * phase.cos();
            errors.push((run.state.q[0] - wanted).abs() / start);
        }
        assert!(of_order_two(&errors), "{errors:?}");
        // It ends where it sticks: turns at ±(x₀ − 2nb), the first within the band b.
        let run = made(&scene.with_duration(20.0 * PI / omega), 1e-3);
        let turns = ((start / band - 1.0) / 2.0).ceil();
        let rest = (start - 2.0 * turns * band) * if turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
        assert!((run.state.q[0] - rest).abs() < 1e-3 * start, "{} {rest}", run.state.q[0]);
        assert!(run.state.v[0].abs() < 1e-12, "{:?}", run.state);
    }
}

#[test]
fn an_oblique_impact_gives_the_impulses_of_newton_and_coulomb() {
    for (friction, e) in [(0.1, 0.6), (0.9, 0.0), (0.3, 1.0)] {
        let (mass, v) = (1.3, [0.4, 0.9]);
        let scene = with(isotropic(mass, 0.0, 0.0), hole("hole", body(), 1e-2, e, friction))
            .with_initial(&[0.0, 0.0], &[0.0, 0.5])
            .with_duration(0.03);
        // Without a sliding velocity there is no friction: straight back and forth.
        let run = made(&scene, 1e-3);
        assert!(run.state.q[0] == 0.0 && run.state.v[0] == 0.0, "{:?}", run.state);
        let flat = with_flats(isotropic(mass, 0.0, 0.0), "flat", body(), &[(90.0, 3e-3)], e, friction);
        let run = made(&flat.with_initial(&[0.0, 0.0], &v).with_duration(5e-3), 1e-3);
        let p = mass * (1.0 + e) * v[1];
        let rub = (friction * p).min(mass * v[0]);
        let wanted = [v[0] - rub / mass, -e * v[1]];
        for (found, wanted) in run.state.v.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-14, "{:?} {wanted}", run.state);
        }
        // The work of wear is that of the impulse at the mean sliding velocity.
        let work = run.statistics.wear[0].work_rate_w * 5e-3;
        assert!((work - p * (v[0] - 0.5 * rub / mass)).abs() < 1e-14, "{work}");
        assert!((run.statistics.wear[0].impact_share.unwrap_or(0.0) - 1.0).abs() < 1e-12);
        let dissipated = run.statistics.wear[0].friction_power_w * 5e-3;
        assert!((dissipated - rub * (v[0] - 0.5 * rub / mass)).abs() < 1e-14, "{dissipated}");
    }
}

#[test]
fn structures_in_holes_follow_the_exact_motion_while_it_is_predictable() {
    let draws = &mut Draws::new(draws::seed(5));
    let mut compared = 0;
    for _ in 0..draws::cases(30_u64) {
        let scene = random_scene(draws, 0.0);
        // Some impacts, and the fastest vibration in some hundred steps.
        let scene = scene.with_duration(0.03);
        let exact = match run(&scene, &Scheme::Event, &Options::with_step(1e-3)) {
            Ok(run) if run.findings.is_empty() && run.counters.handed_steps == 0 => run,
            _ => continue,
        };
        let scale = exact.state.q.iter().fold(1e-4_f64, |most, q| most.max(q.abs()));
        let error = |step: f64| {
            let run = made(&scene, step);
            let apart = run.state.q.iter().zip(&exact.state.q).map(|(a, b)| (a - b).abs());
            (apart.fold(0.0, f64::max) / scale, run.counters.steps_given_up)
        };
        let ([coarse, fine], given_up) = ([error(1e-4).0, error(1.25e-5).0], error(1e-4).1);
        if given_up == 0 {
            // 64 of order 2 over three halvings; the growth of errors from impact to impact and
            // rebounds that end within a step take some of it.
            assert!(fine < 2e-3 && (fine < coarse / 8.0 || fine < 1e-7), "{coarse:e} {fine:e}");
            compared += 1;
        }
    }
    assert!(compared >= 10, "{compared}");
}

#[test]
fn a_slide_begins_and_ends_where_the_load_says() {
    // The benchmark SDND104 of code_aster at 1.01 m/s²: a mass that barely slides twice a period.
    // Its work rate without a spring is 2.26164e-4 W; here the friction limit is passed by 1 %, so
    // that the rule's error of the load, (ωh)²/12, counts a hundredfold.
    let work_rate = |step: f64| {
        let scene = with_flats(isotropic(1.0, 0.0, 3e-5), "flat", body(), &[(90.0, 0.0)], 0.0, 0.1)
            .with_load(load(Load::harmonic(1.01, 1.0, PI), Row::dof(0)))
            .with_load(load(Load::constant(10.0), Row::dof(1)))
            .with_duration(12.0);
        made(&scene, step).statistics.wear[0].work_rate_w
    };
    let errors: Vec<f64> = [4e-3, 2e-3, 1e-3].map(|step| (work_rate(step) / 2.26164e-4 - 1.0).abs()).to_vec();
    assert!(of_order_two(&errors) && errors[2] < 1e-3, "{errors:?}");
}

#[test]
fn a_ring_is_met_at_the_instant_and_with_the_speed_of_the_flight() {
    // A mass without a spring flies on a straight line into an elastic ring, across it as well.
    let (gap, start, velocity) = (2e-3, [-0.5e-3, 0.4e-3], [0.05, 0.11]);
    for damping in [0.0, 15.0] {
        let mut ring = hole("ring", body(), gap, 0.0, 0.0);
        ring.law = WallLaw::Elastic { stiffness: 4e4, damping };
        let scene = with(isotropic(1.0, 0.0, 0.0), ring).with_initial(&start, &velocity).with_duration(0.04);
        let along = start[0] * velocity[0] + start[1] * velocity[1];
        let [fast, far] = [velocity, start].map(|x: [f64; 2]| x[0] * x[0] + x[1] * x[1]);
        let meets = ((along * along + fast * (gap * gap - far)).sqrt() - along) / fast;
        let speed = (along + fast * meets) / gap;
        for step in [1e-3, 2.5e-4, 6.25e-5] {
            let made = made(&scene, step);
            let first = made.trajectory.contacts()[0];
            // The instant is that of the straight line; the normal turns by up to 0.06 rad in a
            // step of 1 ms, whose square is left of the speed across.
            assert!((first.start - meets).abs() < 1e-12, "{} {meets}", first.start);
            let left = (step * fast.sqrt() / gap).powi(2) * fast.sqrt();
            assert!((first.approach_speed - speed).abs() < left, "{step}: {} {speed}", first.approach_speed);
        }
    }
}

#[test]
fn a_blow_on_a_body_that_slides_acts_at_its_instant() {
    // A mass slides round a hole at 0.3 m/s; a blow into the wall is answered there, with e = 0.
    let (gap, speed, time) = (2e-3, 0.3, 7.3e-4);
    let scene = with(isotropic(1.5, 0.0, 0.0), hole("hole", body(), gap, 0.0, 0.0))
        .with_initial(&[gap, 0.0], &[0.0, speed])
        .with_duration(4e-3);
    let angle = speed * time / gap;
    // Along the circle at the instant of the blow.
    let blow = 0.6;
    let kick = |part: f64, dof: usize| load(Load::impulse(blow * part, time), Row::dof(dof));
    let scene = scene.with_load(kick(-angle.sin(), 0)).with_load(kick(angle.cos(), 1));
    let run = made(&scene, 1e-4);
    let end = angle + (speed + blow / 1.5) * (4e-3 - time) / gap;
    let wanted = [gap * end.cos(), gap * end.sin()];
    let off = (run.state.q[0] - wanted[0]).hypot(run.state.q[1] - wanted[1]);
    // Chords of 0.035 rad: each falls short of its arc by 1e-4 of it in the mean speed.
    assert!(off < 1e-3 * gap && (end - TAU / 2.0).abs() > 0.1, "{off:e} {end}");
    assert!((run.state.v[0].hypot(run.state.v[1]) - 0.7).abs() < 1e-3, "{:?}", run.state);
}

/// tan φ at which a mass that `force` (N) presses into a hole of the gap `gap` (m) stops, thrown
/// along the circle at `speed` (m/s) from the lowest point, under kinetic friction `friction`: with
/// u = φ̇², du/dφ = −2F(sin φ + μ cos φ)/(mγ) − 2μu, which is linear.
fn stop_on_circle((mass, gap): (f64, f64), force: f64, friction: f64, speed: f64) -> f64 {
    let (a, mu) = (2.0 * force / (mass * gap), friction);
    let along = a * (1.0 - 2.0 * mu * mu) / (1.0 + 4.0 * mu * mu);
    let across = -a * mu - 2.0 * mu * along;
    let square = |phi: f64| {
        let start = (speed / gap).powi(2) - along;
        start * (-2.0 * mu * phi).exp() + along * phi.cos() + across * phi.sin()
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if square(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    low.tan()
}

#[test]
fn static_friction_holds_a_body_where_its_sliding_along_a_circle_ends() {
    // Thrown along a hole, the body stops where the load along the circle is a tenth to a third of
    // that across it: the static friction of 0.35 holds it there.
    let (mass, gap, force) = (1.0, 5e-4, 10.0);
    let friction = FrictionCoefficients { sticking: 0.35, sliding: 0.1 };
    let thrown = |start: f64, speed: f64, law: WallLaw| {
        let mut wall = hole("hole", body(), gap, 0.0, 0.0);
        (wall.law, wall.friction) = (law, friction);
        with(isotropic(mass, 0.0, 0.0), wall)
            .with_load(load(Load::constant(force), Row::dof(0)))
            .with_initial(&[start, 0.0], &[0.0, speed])
            .with_duration(0.05)
    };
    for part in 0..24 {
        let speed = 0.0132 + 3e-4 * f64::from(part);
        let stop = stop_on_circle((mass, gap), force, friction.sliding, speed);
        assert!((0.1..0.34).contains(&stop), "{stop}");
        for step in [5e-4, 1e-4, 5e-5] {
            let run = made(&thrown(gap, speed, WallLaw::Rigid { restitution: 0.0 }), step);
            let found = run.state.q[1] / run.state.q[0];
            // It turns by 0.2 rad in some 20 of the longest steps: of order 2.
            assert!((found / stop - 1.0).abs() < 2e-2, "{speed} m/s, {step} s: {found}, {stop}");
            // It is pressed against the hole throughout.
            assert_eq!(run.trajectory.contacts().len(), 1, "{speed} m/s, {step} s");
        }
        // On a ring that vibrates under the load by a micrometre.
        let ring = WallLaw::Elastic { stiffness: 1e5, damping: 0.0 };
        let scene = thrown(gap + force / 1e5 + 1e-6, speed, ring);
        let slope = |end: f64| {
            let run = made(&scene.clone().with_duration(end), 1e-4);
            run.state.q[1] / run.state.q[0]
        };
        let (stopped, last) = (slope(0.015), slope(0.05));
        assert!(stopped > 0.09 && (last - stopped).abs() < 1e-3, "{speed} m/s: {stopped} {last}");
    }
}
