//! Keys that have no derivative from a time on, beside keys that have; and moved blows in a push.

use signorini::study::derivatives::Derivatives;
use signorini::variation::{NoDerivative, SceneTangent};
use signorini::{Load, Options, Result, Scene, Scheme, Wall, run};

/// A body between two stops of these restitutions, under a sine of this amplitude.
fn stopped([upper, lower, amplitude]: [f64; 3]) -> Result<Scene> {
    Ok(Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(upper))
        .with_wall(Wall::lower("lower", -6e-3).with_restitution(lower))
        .with_load(Load::harmonic(amplitude, 1.2, 0.0))
        .with_duration(3.0))
}

#[test]
fn a_key_that_has_no_derivative_leaves_the_others_theirs() {
    let own = [0.0, 0.0, 3.0];
    let key = |name: &str, index: usize| {
        let build = |x: f64| {
            let mut changed = own;
            changed[index] = x;
            stopped(changed)
        };
        SceneTangent::new(name, own[index], build).expect("a tangent")
    };
    let scene = stopped(own).unwrap();
    let all = [key("upper", 0), key("amplitude", 2), key("lower", 1)];
    let found = Derivatives::new(&scene, &all, &[0.05, 2.0]).expect("a run");
    let alone = Derivatives::new(&scene, &all[1..2], &[0.05, 2.0]).expect("a run");
    assert!(found.ended.is_none() && found.contacts.len() == alone.contacts.len() && found.contacts.len() >= 7);
    // Each reason names the wall whose restitution the key raises, at the first rest there.
    let first = |wall: usize| alone.contacts.iter().find(|one| one.contact.wall == wall).expect("a rest").contact.start;
    for (key, wall, name) in [(0, 0, "upper"), (2, 1, "lower")] {
        let Some(NoDerivative::Rebounds { time, wall: named }) = &found.lost[key] else { panic!("{:?}", found.lost) };
        assert!(named == name && *time == first(wall), "{time} {named}");
    }
    assert!(found.lost[1].is_none() && found.lost[0].as_ref().unwrap().by("e").starts_with("no derivative by e: "));
    for (one, alone) in found.contacts.iter().zip(alone.contacts.iter()) {
        let lists = |one: &signorini::variation::ContactDerivative<'_>, key: usize| {
            [
                one.start_by[key],
                one.end_by[key],
                one.approach_speed_by[key],
                one.departure_speed_by[key],
                one.impulse_by[key],
            ]
        };
        assert_eq!(lists(&one, 1), lists(&alone, 0));
        assert!(lists(&one, 0).iter().all(|x| x.is_nan()), "{one:?}");
        // A restitution changes nothing before the first contact at its wall.
        let before = one.contact.start < first(1);
        assert!(lists(&one, 2).iter().all(|x| if before { *x == 0.0 } else { x.is_nan() }), "{one:?}");
    }
    let means = found.means.expect("means");
    assert!(means.force_by.iter().all(|by| by[0].is_nan() && by[1].is_finite()));
    let motion = |key: usize| [0, 1].map(|time| found.motion.displacement_by[3 * time + key]);
    let known = |key: usize| motion(key).map(f64::is_finite);
    assert_eq!(scene.probes.len(), 1);
    assert_eq!((known(0), known(1), known(2)), ([true, false], [true, true], [true, false]));
}

#[test]
fn without_any_key_left_the_derivatives_end() {
    let scene = |e: f64| stopped([e, 0.0, 3.0]);
    let key = SceneTangent::new("upper", 0.0, scene).unwrap();
    let found = Derivatives::new(&scene(0.0).unwrap(), &[key], &[]).unwrap();
    assert!(matches!(found.ended, Some(NoDerivative::Rebounds { .. })) && found.ended == found.lost[0]);
    assert!(found.contacts.is_empty());
}

/// A body pressed into a damped buffer, struck by a blow there, by the time of the blow.
#[test]
fn a_blow_that_is_moved_within_a_push_has_the_differences_of_its_runs() {
    let build = |time: f64| {
        Ok(Scene::oscillator(1.0, 0.2, 100.0)
            .with_wall(Wall::upper("buffer", 2e-3).with_elasticity(1000.0, 2.0))
            .with_load(Load::constant(1.0))
            .with_load(Load::impulse(0.01, time))
            .with_duration(1.0))
    };
    let tangent = SceneTangent::new("time", 0.1, build).unwrap();
    let run = |time: f64| {
        let found = Derivatives::new(&build(time).unwrap(), std::slice::from_ref(&tangent), &[0.3, 0.8]).unwrap();
        assert!(found.ended.is_none() && found.contacts.len() == 4, "{:?}", found.ended);
        let own = |i: usize| *found.contacts.get(i).unwrap().contact;
        let of = |one: signorini::Contact| {
            [one.start, one.end.unwrap(), one.approach_speed, one.departure_speed.unwrap(), one.impulse]
        };
        let mut numbers: Vec<f64> = (0..4).flat_map(|i| of(own(i))).collect();
        let means = found.means.as_ref().unwrap();
        numbers.extend(found.motion.displacement.iter().chain(&found.motion.velocity));
        numbers.extend([means.force[0], means.rms[0], means.displacement[0]]);
        (found, numbers)
    };
    let (found, _) = run(0.1);
    let mut ours: Vec<f64> = Vec::new();
    for one in found.contacts.iter() {
        ours.extend([
            one.start_by[0],
            one.end_by[0],
            one.approach_speed_by[0],
            one.departure_speed_by[0],
            one.impulse_by[0],
        ]);
    }
    let means = found.means.as_ref().unwrap();
    ours.extend(found.motion.displacement_by.iter().chain(&found.motion.velocity_by));
    ours.extend([means.force_by[0][0], means.rms_by[0][0], means.displacement_by[0][0]]);
    let h = 1e-5;
    let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(|k| run(0.1 + k * h).1);
    for (i, ours) in ours.iter().enumerate() {
        let difference = (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
        // Rounding of numbers below 1 over the step: 1e-16 times the growth of 6 over 1e-5.
        assert!((ours - difference).abs() <= 1e-9 + 1e-8 * difference.abs(), "{i}: {ours} and {difference}");
    }
}

/// 1 kg at this displacement and speed beside a pad at 0 with this dashpot, pressed by this force
/// from the start, and struck at 0.1 s.
fn pressed([displacement, speed, damping, force, pad, blow]: [f64; 6]) -> Result<Scene> {
    Ok(Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("pad", pad).with_elasticity(100.0, damping))
        .with_initial(&[displacement], &[speed])
        .with_load(Load::constant(force))
        .with_load(Load::impulse(blow, 0.1))
        .with_duration(0.25))
}

/// The reasons of the keys of [`pressed`], and the derivatives of the displacement at the end.
fn of_pressed(own: [f64; 6], keys: &[usize]) -> (Vec<Option<NoDerivative>>, Vec<f64>) {
    let key = |&index: &usize| {
        let build = |x: f64| {
            let mut changed = own;
            changed[index] = x;
            pressed(changed)
        };
        SceneTangent::new("key", own[index], build).expect("a tangent")
    };
    let all: Vec<SceneTangent> = keys.iter().map(key).collect();
    let found = Derivatives::new(&pressed(own).unwrap(), &all, &[0.25]).expect("a run");
    let lost = found.lost.iter().map(|lost| lost.clone().or(found.ended.clone())).collect();
    (lost, found.motion.displacement_by)
}

/// A pad with a dashpot that is moved into the body acts on it from the start, and one that is
/// moved away only once the body has come to it, by the impulse c δ less: the displacement after a
/// short time differs by c t as much as that would be without the pad.
#[test]
fn a_pad_with_a_dashpot_that_touches_at_the_start_has_no_derivative_by_its_position() {
    let touching = |time: f64| Some(NoDerivative::Touching { time, wall: "pad".to_owned() });
    let (displacement, speed, damping, force, pad, blow) = (0, 1, 2, 3, 4, 5);
    let keys = [pad, displacement, force, speed, damping];
    // At rest or moving into the pad.
    for own in [[0.0, 0.0, 10.0, 1.0, 0.0, 0.0], [0.0, 0.2, 10.0, 0.0, 0.0, 0.0]] {
        let (lost, by) = of_pressed(own, &keys);
        assert_eq!(lost, [touching(0.0), touching(0.0), None, None, None]);
        assert!(by[2..].iter().all(|by| by.is_finite()), "{by:?}");
    }
    // A blow that drives the body into a pad that it touches.
    let (lost, _) = of_pressed([0.0, 0.0, 10.0, 0.0, 0.0, 0.2], &[pad, displacement, blow]);
    assert_eq!(lost, [touching(0.1), touching(0.1), None]);
    // Without a dashpot, away from the pad, and within it both sides agree.
    for own in [[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], [-1e-6, 0.0, 10.0, 1.0, 0.0, 0.0], [1e-6, 0.0, 10.0, 1.0, 0.0, 0.0]] {
        let (lost, by) = of_pressed(own, &keys[..3]);
        assert!(lost.iter().all(Option::is_none), "{lost:?}");
        // What moves both moves the motion along.
        assert!((by[0] + by[1] - 1.0).abs() < 1e-9, "{by:?}");
    }
}

#[test]
fn a_contact_that_begins_with_the_motion_approaches_at_the_speed_of_the_start() {
    let speed = |v: f64| {
        let scene = pressed([0.0, 0.0, 4.0, -1.0, 0.0, 0.0])?;
        Ok(scene.with_initial(&[0.0], &[v]).with_duration(1.0))
    };
    let key = SceneTangent::new("speed", 0.2, speed).expect("a tangent");
    let found = Derivatives::new(&speed(0.2).unwrap(), &[key], &[]).expect("a run");
    let first = found.contacts.get(0).expect("a contact");
    assert_eq!((first.contact.start, first.contact.approach_speed), (0.0, 0.2));
    // Rounding of the derivative of the start.
    assert!(first.start_by[0] == 0.0 && (first.approach_speed_by[0] - 1.0).abs() < 1e-14);
}

/// A body that strikes two walls at one place, of these positions and restitutions, and a dashpot
/// there.
fn doubled([first, second, e, dashpot]: [f64; 4]) -> Result<Scene> {
    Ok(Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("first", first).with_restitution(e))
        .with_wall(Wall::upper("second", second).with_restitution(0.6))
        .with_wall(Wall::upper("dashpot", dashpot).with_elasticity(10.0, 5.0))
        .with_load(Load::harmonic(3.0, 2.5, 0.0))
        .with_output_times(&[0.5]))
}

#[test]
fn walls_at_one_place_have_no_derivative_by_the_position_of_one_of_them() {
    let own = [5e-3, 5e-3, 0.6, 5e-3];
    let place = |index: Option<usize>, x: f64| {
        let mut changed = own;
        match index {
            Some(index) => changed[index] = x,
            None => [changed[0], changed[1], changed[3]] = [x; 3],
        }
        doubled(changed)
    };
    let keys = [Some(0), Some(1), Some(3), None];
    let tangents = keys.map(|index| SceneTangent::new("position", 5e-3, |x| place(index, x)).expect("a tangent"));
    let found = Derivatives::new(&doubled(own).unwrap(), &tangents, &[0.5]).expect("a run");
    let at = |index: Option<usize>, x: f64| {
        let run = run(&place(index, x).unwrap(), &Scheme::Event, &Options::with_step(0.5)).expect("a run");
        *run.trajectory.output().displacement[0].last().unwrap()
    };
    for (key, index) in keys.into_iter().enumerate() {
        let step = 1e-8;
        let [before, now, after] = [-step, 0.0, step].map(|change| at(index, 5e-3 + change));
        let [left, right] = [(now - before) / step, (after - now) / step];
        // Both differ by the second derivative times the step where there is a derivative at all.
        let exists = (left - right).abs() < 1e-4 * left.abs();
        assert_eq!(exists, index.is_none(), "{left} {right}");
        if exists {
            assert!((found.motion.displacement_by[key] / left - 1.0).abs() < 1e-4, "{:?}", found.motion);
        } else {
            assert!(matches!(&found.lost[key], Some(NoDerivative::Together { .. })), "{:?}", found.lost);
            assert!(found.motion.displacement_by[key].is_nan());
        }
    }
}

#[test]
fn derivatives_by_no_key_are_refused() {
    let refused = Derivatives::new(&stopped([0.5, 0.5, 3.0]).unwrap(), &[], &[0.5]).unwrap_err();
    assert_eq!(refused.to_string(), "keys is none; expected one key or more");
}
