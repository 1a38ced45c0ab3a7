//! Closed forms.

use signorini::linear::Symmetric;
use signorini::study::derivatives::Derivatives;
use signorini::variation::{NoDerivative, SceneTangent};
use signorini::{Flat, Flats, Load, PlaneRows, Row, Scene, Structure, Wall, WallLaw};

const G: f64 = 9.81;

/// A ball of `mass` (kg) that falls from `height` (m) onto a floor at 0.
fn ball(mass: f64, height: f64, e: f64) -> Scene {
    Scene::oscillator(mass, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
        .with_load(Load::constant(-mass * G))
        .with_initial(&[height], &[0.0])
        .with_duration(4.0)
}

/// The time of impact k is t₀ (1 + 2 Σ eʲ), j = 1 … k, with t₀ = √(2h/g); its speed is g t₀ eᵏ and
/// its impulse m (1 + e) times that.
#[test]
fn a_ball_bounces_at_the_times_and_speeds_of_the_textbook() {
    let (mass, height, e) = (0.7, 1.3, 0.8_f64);
    let keys = [
        SceneTangent::new("restitution", e, |e| Ok(ball(mass, height, e))).unwrap(),
        SceneTangent::new("height", height, |height| Ok(ball(mass, height, e))).unwrap(),
        SceneTangent::new("mass", mass, |mass| Ok(ball(mass, height, e))).unwrap(),
    ];
    let found = Derivatives::new(&ball(mass, height, e), &keys, &[]).unwrap();
    let t0 = (2.0 * height / G).sqrt();
    assert!(found.contacts.len() > 3 && found.ended.is_none());
    // Rounding of a few products, relative to the largest number of its kind.
    let near = |a: f64, b: f64, size: f64| assert!((a - b).abs() <= 1e-12 * size, "{a} {b}");
    for (k, contact) in found.contacts.iter().enumerate() {
        let (power, slope) = (e.powi(k as i32), k as f64 * e.powi(k as i32 - 1));
        let sum: f64 = (1..=k).map(|j| e.powi(j as i32)).sum();
        let rate: f64 = (1..=k).map(|j| j as f64 * e.powi(j as i32 - 1)).sum();
        let speed = G * t0;
        near(contact.start_by[0], 2.0 * t0 * rate, 10.0);
        near(contact.start_by[1], t0 * (1.0 + 2.0 * sum) / (2.0 * height), 10.0);
        near(contact.start_by[2], 0.0, 10.0);
        near(contact.approach_speed_by[0], speed * slope, 10.0);
        near(contact.approach_speed_by[1], speed * power / (2.0 * height), 10.0);
        // An impact has no length, and the ball leaves it at e times the speed.
        near(contact.end_by[0], contact.start_by[0], 10.0);
        near(contact.departure_speed_by[0], speed * (power + e * slope), 10.0);
        near(contact.departure_speed_by[1], e * speed * power / (2.0 * height), 10.0);
        near(contact.impulse_by[0], mass * speed * (power + (1.0 + e) * slope), 10.0);
        near(contact.impulse_by[2], (1.0 + e) * speed * power, 10.0);
    }
    // The largest impulse is the first, and the sum of impulses its own derivative.
    let measured = found.measured();
    assert_eq!(measured[0].name, "largest_impulse");
    near(measured[0].derivative[0], mass * G * t0, 10.0);
}

/// After rest on the floor nothing depends on what was before; the sum of the impulses is the
/// change of momentum, which the restitution does not change.
#[test]
fn impacts_that_accumulate_end_in_a_rest_without_memory() {
    let scene = |e: f64| Ok(ball(1.0, 0.1, e).with_load(Load::constant(0.0)).with_duration(1.5));
    let key = SceneTangent::new("restitution", 0.5, scene).unwrap();
    let found = Derivatives::new(&scene(0.5).unwrap(), &[key], &[1.4]).unwrap();
    assert_eq!((found.motion.displacement_by[0], found.motion.velocity_by[0], found.ended), (0.0, 0.0, None));
}

/// A block inside a buffer of stiffness k and dashpot c that leaves too fast for its force, F(t) =
/// k s + c ṡ < 0, and is pushed back: the contact begins at F = 0 as it still leaves, with approach
/// speed 0 by every key. With s = s₀ − v t + a t²/2 the instant moves by −(∂F/∂key)/Ḟ.
#[test]
fn a_contact_that_begins_within_a_buffer_has_no_approach_speed() {
    let (m, k, c, v, push) = (1.0, 100.0, 10.0, 2.0, 100.0);
    let scene = |push: f64, v: f64| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::upper("buffer", 0.0).with_elasticity(k, c))
            .with_load(Load::constant(push))
            // Ends the contact again.
            .with_load(Load::impulse(-20.0, 0.05))
            .with_initial(&[0.1], &[-v])
            .with_duration(0.1))
    };
    let keys = [
        SceneTangent::new("push", push, |push| scene(push, v)).unwrap(),
        SceneTangent::new("speed", v, |v| scene(push, v)).unwrap(),
    ];
    let found = Derivatives::new(&scene(push, v).unwrap(), &keys, &[]).unwrap();
    let contact = found.contacts.get(0).expect("a contact");
    // k (0.1 − 2t + 50t²) + c (−2 + 100t) = −10 + 800t + 5000t² = 0.
    let t = (-800.0 + (800.0 * 800.0 + 4.0 * 5000.0 * 10.0_f64).sqrt()) / 1e4;
    let rate = k * (-v + push * t) + c * push;
    // Rounding, over the condition of the root.
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} {b}");
    near(contact.contact.start, t);
    assert_eq!(contact.contact.approach_speed, 0.0);
    near(contact.start_by[0], -(0.5 * k * t * t + c * t) / rate);
    near(contact.start_by[1], (k * t + c) / rate);
    assert_eq!(contact.approach_speed_by, [0.0, 0.0]);
}

/// A block thrown against a buffer of stiffness k and dashpot c leaves it where the force vanishes,
/// at e = exp(−ζ (π − 2 asin ζ)/√(1 − ζ²)) … for ζ < 1 by the phase at which k s + c ṡ = 0.
#[test]
fn a_buffer_returns_the_share_that_its_damping_leaves() {
    let (m, k, c, v) = (2.0, 900.0, 12.0, 0.4);
    let scene = |k: f64, c: f64, v: f64| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::upper("buffer", 0.1).with_elasticity(k, c))
            .with_initial(&[0.0], &[v])
            .with_duration(1.0))
    };
    let keys = [
        SceneTangent::new("stiffness", k, |k| scene(k, c, v)).unwrap(),
        SceneTangent::new("damping", c, |c| scene(k, c, v)).unwrap(),
        SceneTangent::new("speed", v, |v| scene(k, c, v)).unwrap(),
    ];
    let found = Derivatives::new(&scene(k, c, v).unwrap(), &keys, &[]).unwrap();
    // ε(ζ) = exp(−ζ φ/√(1 − ζ²)) with φ = π − 2 atan(√(1 − ζ²)/… ), where s̈ = 0: tan(ω_d t) =
    // 2ζ√(1 − ζ²)/(2ζ² − 1).
    let phase = |zeta: f64| {
        let root = (1.0 - zeta * zeta).sqrt();
        (2.0 * zeta * root).atan2(2.0 * zeta * zeta - 1.0)
    };
    let returned = |zeta: f64| (-zeta / (1.0 - zeta * zeta).sqrt() * phase(zeta)).exp();
    // The contact lasts phase/(ω √(1 − ζ²)).
    let lasts = |k: f64, c: f64| {
        let (omega, zeta) = ((k / m).sqrt(), c / (2.0 * (k * m).sqrt()));
        phase(zeta) / (omega * (1.0 - zeta * zeta).sqrt())
    };
    let zeta = c / (2.0 * (k * m).sqrt());
    let slope = (returned(zeta + 1e-5) - returned(zeta - 1e-5)) / 2e-5;
    let contact = found.contacts.get(0).expect("a contact");
    let impulse = -m * v * (1.0 + returned(zeta));
    // The difference above errs by 1e-10.
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-8 * b.abs(), "{a} {b}");
    near(contact.contact.impulse, impulse);
    near(contact.impulse_by[0], -m * v * slope * (-0.5 * zeta / k));
    near(contact.impulse_by[1], -m * v * slope * zeta / c);
    near(contact.impulse_by[2], impulse / v);
    let difference = |x: f64, of: &dyn Fn(f64) -> f64| (of(x * (1.0 + 1e-5)) - of(x * (1.0 - 1e-5))) / (2e-5 * x);
    near(contact.end_by[0], difference(k, &|k| lasts(k, c)));
    near(contact.end_by[1], difference(c, &|c| lasts(k, c)));
    near(contact.end_by[2], -0.1 / (v * v));
    near(contact.departure_speed_by[0], v * slope * (-0.5 * zeta / k));
    near(contact.departure_speed_by[1], v * slope * zeta / c);
    near(contact.departure_speed_by[2], returned(zeta));
    // Nothing but the buffer changes the momentum: the mean force is the impulse over the run.
    let means = found.means.as_ref().expect("means");
    near(means.force[0], impulse);
    near(means.force_by[0][1], contact.impulse_by[1]);
    near(contact.start_by[2], -0.1 / (v * v));
    near(contact.approach_speed_by[2], 1.0);
}

/// What a derivative cannot tell is said.
#[test]
fn a_graze_a_horizon_and_a_touched_start_are_named() {
    // A swing that just reaches its stop, at rest there to rounding.
    let swing = |amplitude: f64| {
        Ok(Scene::oscillator(1.0, 0.0, 100.0)
            .with_wall(Wall::upper("stop", 0.01))
            .with_initial(&[-amplitude], &[0.0])
            .with_duration(2.0))
    };
    let reason = |scene: &Scene, key: SceneTangent| Derivatives::new(scene, &[key], &[]).unwrap().ended;
    let key = SceneTangent::new("start", 9.9e-3, swing).unwrap();
    assert!(reason(&swing(9.9e-3).unwrap(), key).is_none());
    let key = SceneTangent::new("start", 0.01, swing).unwrap();
    let grazed = reason(&swing(0.01).unwrap(), key).expect("a reason");
    assert!(matches!(&grazed, NoDerivative::Graze { wall, .. } if wall == "stop"), "{grazed}");
    assert!(grazed.to_string().contains("wall \"stop\" is grazed"), "{grazed}");
    // A chaotic motion between two walls.
    let chaotic = |amplitude: f64| {
        Ok(Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::upper("upper", 0.01).with_restitution(0.95))
            .with_wall(Wall::lower("lower", -0.01).with_restitution(0.95))
            .with_load(Load::harmonic(amplitude, 2.0, 0.3))
            .with_initial(&[0.0], &[0.3])
            .with_duration(200.0))
    };
    let key = SceneTangent::new("amplitude", 3.0, chaotic).unwrap();
    let ended = reason(&chaotic(3.0).unwrap(), key);
    assert!(
        matches!(ended, Some(NoDerivative::Horizon { growth, .. }) if growth > 1e6)
            || matches!(ended, Some(NoDerivative::Graze { .. })),
        "{ended:?}"
    );
    // A block that stands on the floor, which the key lowers.
    let stands = |floor: f64| {
        Ok(Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::lower("floor", floor))
            .with_load(Load::constant(-G))
            .with_initial(&[0.1], &[0.0]))
    };
    let key = SceneTangent::new("floor", 0.1, stands).unwrap();
    assert!(matches!(reason(&stands(0.1).unwrap(), key), Some(NoDerivative::Touching { .. })));
    // A floor from which nothing rebounds.
    let dead = |e: f64| Ok(ball(1.0, 0.3, e));
    let key = SceneTangent::new("restitution", 0.0, dead).unwrap();
    assert!(matches!(reason(&dead(0.0).unwrap(), key), Some(NoDerivative::Rebounds { .. })));
}

/// A block that stands on a floor is lifted off by A sin(ω t) at the instant asin(mg/A)/ω.
#[test]
fn a_block_is_lifted_at_the_instant_of_its_load() {
    let (m, amplitude, frequency) = (0.5, 9.0, 0.4);
    let scene = |amplitude: f64, m: f64| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::lower("floor", 0.0))
            .with_load(Load::constant(-m * G))
            .with_load(Load::harmonic(amplitude, frequency, 0.0))
            .with_duration(0.5))
    };
    let keys = [
        SceneTangent::new("amplitude", amplitude, |a| scene(a, m)).unwrap(),
        SceneTangent::new("mass", m, |m| scene(amplitude, m)).unwrap(),
    ];
    let found = Derivatives::new(&scene(amplitude, m).unwrap(), &keys, &[]).unwrap();
    let contact = found.contacts.get(0).expect("a contact");
    let (ratio, omega) = (m * G / amplitude, 2.0 * std::f64::consts::PI * frequency);
    let slope = 1.0 / (omega * (1.0 - ratio * ratio).sqrt());
    // Rounding of a few products.
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{a} {b}");
    near(contact.contact.end.unwrap(), ratio.asin() / omega);
    near(contact.end_by[0], -slope * ratio / amplitude);
    near(contact.end_by[1], slope * ratio / m);
    near(contact.departure_speed_by[0], 0.0);
    near(contact.departure_speed_by[1], 0.0);
    // Its impulse is that of weight less load up to there, whose integrand vanishes at its end.
    let end = ratio.asin() / omega;
    near(contact.impulse_by[0], -(1.0 - (omega * end).cos()) / omega);
    near(contact.impulse_by[1], G * end);
    near(found.means.as_ref().unwrap().force_by[0][1], G * end / 0.5);
}

/// The ball between two floors falls, rises and falls: mean and mean square of its height over the
/// run follow from parabolas, and so do their derivatives by the restitution, through the instant
/// of the impact.
#[test]
fn means_have_the_derivatives_of_their_integrals() {
    let (height, e, end) = (1.3, 0.8, 1.2);
    let scene = |height: f64, e: f64| Ok(ball(1.0, height, e).with_duration(end));
    let keys = [
        SceneTangent::new("height", height, |height| scene(height, e)).unwrap(),
        SceneTangent::new("restitution", e, |e| scene(height, e)).unwrap(),
    ];
    let found = Derivatives::new(&scene(height, e).unwrap(), &keys, &[]).unwrap();
    assert_eq!(found.contacts.len(), 1);
    // ∫ and ∫² of h − g t²/2 up to t₀, and of e g t₀ s − g s²/2 after it.
    let moments = |height: f64, e: f64| {
        let t0 = (2.0 * height / G).sqrt();
        let (s, v) = (end - t0, e * G * t0);
        let mean = height * t0 - G * t0.powi(3) / 6.0 + v * s * s / 2.0 - G * s.powi(3) / 6.0;
        let fall = height * height * t0 - height * G * t0.powi(3) / 3.0 + G * G * t0.powi(5) / 20.0;
        let rise = v * v * s.powi(3) / 3.0 - v * G * s.powi(4) / 4.0 + G * G * s.powi(5) / 20.0;
        [mean / end, ((fall + rise) / end).sqrt()]
    };
    let means = found.means.as_ref().expect("means");
    let own = moments(height, e);
    // The five-point difference of polynomials over 1e-3 errs by 1e-12.
    let difference = |of: &dyn Fn(f64) -> f64| (8.0 * (of(1e-3) - of(-1e-3)) - (of(2e-3) - of(-2e-3))) / 12e-3;
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-10 * b.abs(), "{a} {b}");
    near(means.displacement[0], own[0]);
    near(means.rms[0], own[1]);
    for (part, by) in [&means.displacement_by, &means.rms_by].into_iter().enumerate() {
        near(by[0][0], difference(&|x| moments(height + x, e)[part]));
        near(by[0][1], difference(&|x| moments(height, e + x)[part]));
    }
    let weight = (1.0 + e) * (2.0 * G * height).sqrt() / end;
    near(means.force[0], weight);
    near(means.force_by[0][1], weight / (1.0 + e));
}

/// A blow J at the time τ on an oscillator at rest makes it swing as J/(m ω_d) e^{−δ(t − τ)} sin
/// ω_d(t − τ): the derivative by τ is minus its velocity. It then meets a stop later by as much.
#[test]
fn a_blow_at_another_time_moves_all_that_follows() {
    let (m, c, k, impulse, blow) = (1.2, 0.7, 90.0, 0.5, 0.3);
    let scene = |time: f64| {
        Ok(Scene::oscillator(m, c, k)
            .with_wall(Wall::upper("stop", 0.03).with_restitution(0.6))
            .with_load(Load::impulse(impulse, time))
            .with_duration(0.6))
    };
    let key = || SceneTangent::new("time", blow, scene).unwrap();
    let (decay, omega) = (c / (2.0 * m), (k / m - (c / (2.0 * m)).powi(2)).sqrt());
    let velocity = |t: f64| {
        let (sin, cos) = (omega * t).sin_cos();
        impulse / (m * omega) * (-decay * t).exp() * (omega * cos - decay * sin)
    };
    let found = Derivatives::new(&scene(blow).unwrap(), &[key()], &[0.2, 0.32]).unwrap();
    // Rounding of a few products.
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{a} {b}");
    near(found.motion.displacement_by[0], 0.0);
    near(found.motion.displacement_by[1], -velocity(0.02));
    assert!(!found.contacts.is_empty());
    for contact in found.contacts.iter() {
        near(contact.start_by[0], 1.0);
        near(contact.approach_speed_by[0], 0.0);
        near(contact.impulse_by[0], 0.0);
    }
    // A blow at the start can be moved to one side only, and one within a contact is refused.
    assert!(SceneTangent::new("time", 0.0, scene).is_err());
    let pressed = |time: f64| {
        let floor = Wall::lower("floor", 0.0).with_restitution(0.0);
        Ok(Scene::oscillator(m, c, 0.0)
            .with_wall(floor)
            .with_load(Load::constant(-5.0))
            .with_load(Load::impulse(impulse, time))
            .with_initial(&[0.0], &[-0.1])
            .with_duration(0.6))
    };
    let key = SceneTangent::new("time", 0.05, pressed).unwrap();
    let ended = Derivatives::new(&pressed(0.05).unwrap(), &[key], &[]).unwrap().ended;
    assert!(matches!(&ended, Some(NoDerivative::Blow { wall, .. }) if wall == "floor"), "{ended:?}");
}

/// A block dives into a damped buffer, from which a blow J at the time τ throws it: the buffer
/// would have to pull at once, so that the push ends with the blow, at a speed of −(ṡ + J/m). In
/// the buffer s = v/ω_d e^{−δt} sin ω_d t after the instant x/v at which it reaches the face. A
/// rest that a blow ends has no departure speed, whatever the keys are.
#[test]
fn a_contact_that_a_blow_ends_ends_with_it() {
    let (m, k, c, face, v, blow, time) = (2.0, 400.0, 40.0, 0.05, 1.0, -3.0, 0.08);
    let scene = |[blow, v]: [f64; 2]| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::upper("buffer", face).with_elasticity(k, c))
            .with_load(Load::impulse(blow, time))
            .with_initial(&[0.0], &[v])
            .with_duration(0.2))
    };
    let keys = [
        SceneTangent::new("blow", blow, |blow| scene([blow, v])).unwrap(),
        SceneTangent::new("velocity", v, |v| scene([blow, v])).unwrap(),
    ];
    let (decay, t) = (c / (2.0 * m), time - face / v);
    let omega = (k / m - decay * decay).sqrt();
    let (sin, cos) = (omega * t).sin_cos();
    let fading = v / omega * (-decay * t).exp();
    let (depth, rate) = (fading * sin, fading * (omega * cos - decay * sin));
    let acceleration = -(k * depth + c * rate) / m;
    let found = Derivatives::new(&scene([blow, v]).unwrap(), &keys, &[]).unwrap();
    let push = found.contacts.get(0).expect("a push");
    // Rounding of a few products.
    let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{a} {b}");
    near(push.contact.end.unwrap(), time);
    near(push.contact.departure_speed.unwrap(), -(rate + blow / m));
    assert_eq!(push.end_by, [0.0, 0.0]);
    near(push.departure_speed_by[0], -1.0 / m);
    near(push.departure_speed_by[1], -(rate / v + acceleration * face / (v * v)));

    let resting = |[blow, weight]: [f64; 2]| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
            .with_load(Load::constant(-weight))
            .with_load(Load::impulse(blow, 0.4))
            .with_duration(1.0))
    };
    for blow in [1.0, -1.0] {
        let keys = [
            SceneTangent::new("blow", blow, |blow| resting([blow, 19.62])).unwrap(),
            SceneTangent::new("weight", 19.62, |weight| resting([blow, weight])).unwrap(),
        ];
        let found = Derivatives::new(&resting([blow, 19.62]).unwrap(), &keys, &[]).unwrap();
        let rest = found.contacts.get(0).expect("a rest");
        near(rest.contact.end.unwrap(), 0.4);
        assert_eq!((rest.end_by, rest.departure_speed_by), (&[0.0; 2][..], &[0.0; 2][..]));
        near(rest.impulse_by[1], 0.4);
    }
}

/// A block dives into a damped buffer until it strikes a rigid stop behind its face: the push ends
/// with that impact, whose rebound would let it pull. In the buffer s = v/ω_d e^{−δt} sin ω_d t, so
/// that the stop at the depth d is struck at the first root of s = d.
#[test]
fn a_push_that_an_impact_elsewhere_ends_ends_at_its_instant() {
    let (m, k, c, face, depth, e, v) = (1.0, 50.0, 8.0, 0.1, 0.02, 0.7, 0.5);
    let scene = |[k, c, depth, e, v, m]: [f64; 6]| {
        Ok(Scene::oscillator(m, 0.0, 0.0)
            .with_wall(Wall::upper("buffer", face).with_elasticity(k, c))
            .with_wall(Wall::upper("stop", face + depth).with_restitution(e))
            .with_initial(&[0.0], &[v])
            .with_duration(0.3))
    };
    let numbers = [k, c, depth, e, v, m];
    let at = |index: usize, x: f64| {
        let mut changed = numbers;
        changed[index] = x;
        changed
    };
    // Instant of the impact, and the speed at which the block leaves the buffer, by bisection.
    let struck = |[k, c, depth, e, v, m]: [f64; 6]| {
        let decay = c / (2.0 * m);
        let omega = (k / m - decay * decay).sqrt();
        let state = |t: f64| {
            let (sin, cos) = (omega * t).sin_cos();
            let size = v / omega * (-decay * t).exp();
            [size * sin, size * (omega * cos - decay * sin)]
        };
        let (mut low, mut high) = (0.0, 0.08);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if state(middle)[0] < depth { low = middle } else { high = middle }
        }
        [face / v + low, e * state(low)[1]]
    };
    let keys: Vec<SceneTangent> =
        (0..6).map(|index| SceneTangent::new("key", numbers[index], |x| scene(at(index, x))).unwrap()).collect();
    let found = Derivatives::new(&scene(numbers).unwrap(), &keys, &[]).unwrap();
    let push = found.contacts.iter().find(|one| one.contact.wall == 0).expect("a push");
    let own = struck(numbers);
    // Rounding of a few products.
    assert!((push.contact.end.unwrap() - own[0]).abs() < 1e-12);
    assert!((push.contact.departure_speed.unwrap() - own[1]).abs() < 1e-12);
    for (index, number) in numbers.into_iter().enumerate() {
        // The five-point difference over 1e-3 of itself errs by 1e-12, and by 1e-13 of rounding
        // over that step.
        let h = 1e-3 * number;
        let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(|by| struck(at(index, number + by * h)));
        for (part, ours) in [push.end_by[index], push.departure_speed_by[index]].into_iter().enumerate() {
            let expected = (8.0 * (a[part] - b[part]) - (c[part] - d[part])) / (12.0 * h);
            assert!((ours - expected).abs() <= 1e-9 * (own[part] / number).abs(), "{index} {part}: {ours} {expected}");
        }
    }
}

/// A body in two planes that flies with the velocity v at a flat of the normal n at the distance γ
/// reaches it after γ/(n · v), and is given −(1 + e) m n · v. A flat whose direction passes 0° or
/// 180° is that of the same flat.
#[test]
fn a_flat_is_turned_through_0_and_180_degrees() {
    let (m, gap, e) = (2.0, 3e-3, 0.6);
    for (direction, v) in [(0.0, [0.5, 0.2]), (180.0, [-0.5, 0.2]), (90.0, [0.1, 0.4]), (360.0, [0.5, -0.3])] {
        let scene = |turn: f64| {
            let at = PlaneRows::doubled(&Row::dof(0), 1);
            let flats = Flats {
                name: "plate".to_owned(),
                at: at.clone(),
                flats: vec![Flat { direction: direction + turn, gap }],
                centre: [0.0, 0.0],
                law: WallLaw::Rigid { restitution: e },
                friction: 0.0.into(),
            };
            let [mass, damping, stiffness] = [m, 0.0, 0.0].map(|x| Symmetric::diagonal(&[x, x]));
            let scene = Scene::structure(Structure { mass, damping, stiffness }).with_initial(&[0.0, 0.0], &v);
            Ok(scene.with_support("plate", at, [0.0, 0.0], flats.walls()?).with_duration(0.02))
        };
        let key = SceneTangent::new("turn", 0.0, scene).expect("a tangent");
        let found = Derivatives::new(&scene(0.0).unwrap(), &[key], &[]).unwrap();
        let contact = found.contacts.get(0).expect("an impact");
        // Per degree; n turns to its left.
        let degree = 1_f64.to_radians();
        let (sin, cos) = (direction * degree).sin_cos();
        let (fast, faster) = (cos * v[0] + sin * v[1], degree * (cos * v[1] - sin * v[0]));
        // The error of a difference over a sine, and rounding.
        let near = |a: f64, b: f64| assert!((a - b).abs() <= 1e-10 * b.abs(), "{direction}: {a} {b}");
        near(contact.contact.start, gap / fast);
        near(contact.start_by[0], -gap * faster / (fast * fast));
        near(contact.contact.approach_speed, fast);
        near(contact.approach_speed_by[0], faster);
        near(contact.impulse_by[0] / contact.contact.impulse, faster / fast);
        near(contact.contact.impulse.abs(), (1.0 + e) * m * fast);
    }
}
