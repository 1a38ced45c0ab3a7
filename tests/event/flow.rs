//! The closed-form flow against an independent Taylor integration, in every regime.

use signorini::scheme::event::Event;
use signorini::{Load, LoadKind, Scene, System, Table};

/// m q̈ + c q̇ + k q = f(t) by power series of 24 terms in steps of at most 0.25 of the fastest
/// time: its truncation is below 1e-30 a step, its rounding a few ulp a step.
///
/// Gives the state at the end, and the largest displacement and speed on the way.
fn taylor(scene: &Scene, end: f64) -> [f64; 4] {
    let System::Oscillator(o) = scene.system else { unreachable!() };
    let (mut q, mut v) = (scene.initial.q[0], scene.initial.v[0]);
    let mut fastest = (o.stiffness / o.mass).sqrt() + o.damping / o.mass + 1.0 / end;
    for load in &scene.loads {
        if let LoadKind::Harmonic { frequency, .. } = load.kind {
            fastest += std::f64::consts::TAU * frequency;
        }
    }
    let (mut far, mut fast) = (q.abs(), v.abs());
    let steps = (4.0 * fastest * end).ceil();
    let h = end / steps;
    for i in 0..steps as usize {
        let t = i as f64 * h;
        let mut f = [0.0; 24];
        for load in &scene.loads {
            match &load.kind {
                LoadKind::Constant { force } => f[0] += force,
                LoadKind::Harmonic { amplitude, frequency, phase } => {
                    let w = std::f64::consts::TAU * frequency;
                    let (s, c) = (w * t + phase).sin_cos();
                    let mut scale = *amplitude;
                    for (n, f) in f.iter_mut().enumerate() {
                        *f += scale * [s, c, -s, -c][n % 4];
                        scale *= w / (n + 1) as f64;
                    }
                }
                LoadKind::Table(table) => {
                    let (value, slope) = table.piece(t);
                    f[0] += value;
                    f[1] += slope;
                }
                _ => {}
            }
        }
        let mut a = [0.0; 26];
        (a[0], a[1]) = (q, v);
        for n in 0..24 {
            let rise = (n + 1) as f64;
            a[n + 2] = (f[n] - o.damping * rise * a[n + 1] - o.stiffness * a[n]) / (o.mass * rise * (rise + 1.0));
        }
        (q, v) = (0.0, 0.0);
        for n in (0..26).rev() {
            q = q * h + a[n];
            if n > 0 {
                v = v * h + n as f64 * a[n];
            }
        }
        (far, fast) = (far.max(q.abs()), fast.max(v.abs()));
    }
    [q, v, far, fast]
}

fn flow(scene: &Scene, end: f64, stride: f64) -> (f64, f64) {
    let mut event = Event::new(&scene.clone().with_duration(end), stride).unwrap();
    while !event.is_done() {
        event.advance(0.0).unwrap();
    }
    (event.q()[0], event.v()[0])
}

/// One long arc, and many short ones, against the series; relative to the size of the motion and
/// its speed.
fn check(name: &str, scene: &Scene, end: f64, tolerance: f64) {
    let [q, v, length, speed] = taylor(scene, end);
    for stride in [end, end / 7.0, end / 300.0] {
        let (x, y) = flow(scene, end, stride);
        assert!((x - q).abs() <= tolerance * length, "{name}, stride {stride}: q {x:e} {q:e} {:e}", (x - q) / length);
        assert!((y - v).abs() <= tolerance * speed, "{name}, stride {stride}: v {y:e} {v:e} {:e}", (y - v) / speed);
    }
}

#[test]
fn every_regime_matches_an_independent_series() {
    let table = Table::new(vec![0.0, 0.7, 1.1, 1.6, 4.0], vec![0.0, 2.0, -1.0, 0.5, 3.0]).unwrap();
    // (name, m, c, k): damping from none to 50 times critical through its neighbourhood; stiffness
    // down to none.
    let systems = [
        ("undamped", 1.0, 0.0, 10.0),
        ("underdamped", 1.0, 0.3, 10.0),
        ("just under critical", 1.0, 2.0 - 1e-9, 1.0),
        ("critical", 1.0, 2.0, 1.0),
        ("just over critical", 1.0, 2.0 + 1e-9, 1.0),
        ("overdamped", 2.0, 20.0, 3.0),
        ("50 x critical", 1.0, 100.0, 1.0),
        ("tiny stiffness", 1.0, 0.0, 1e-12),
        ("tiny stiffness, damped", 1.0, 0.5, 1e-9),
        ("small stiffness", 1.0, 0.0, 1e-3),
        ("free", 3.0, 0.0, 0.0),
        ("free, damped", 3.0, 1.5, 0.0),
        ("free, hardly damped", 3.0, 1e-10, 0.0),
    ];
    let resonance = 10f64.sqrt() / std::f64::consts::TAU;
    let loads: [(&str, Vec<Load>); 9] = [
        ("free motion", vec![]),
        ("constant", vec![Load::constant(-2.0)]),
        ("sine", vec![Load::harmonic(1.5, 0.8, 0.4)]),
        ("resonance", vec![Load::harmonic(1.0, resonance, 0.3)]),
        ("near resonance", vec![Load::harmonic(1.0, resonance * (1.0 + 1e-7), 0.3)]),
        ("off resonance", vec![Load::harmonic(1.0, resonance * 1.02, 0.3)]),
        ("frequency 0", vec![Load::harmonic(2.0, 0.0, 1.0)]),
        ("slow sine", vec![Load::harmonic(2.0, 1e-9, 1.0), Load::harmonic(1.0, 0.01, 0.0)]),
        ("several", vec![Load::constant(1.0), Load::harmonic(1.0, 1.3, 0.0), Load::harmonic(0.4, 4.0, 2.0)]),
    ];
    for (system, m, c, k) in systems {
        for (load, pieces) in &loads {
            for initial in [[0.0, 0.0], [0.3, -1.0]] {
                let mut scene = Scene::oscillator(m, c, k).with_initial(&initial[..1], &initial[1..]);
                scene.loads.clone_from(pieces);
                // The series itself takes up to 2000 steps of a few ulp.
                check(&format!("{system}, {load}"), &scene, 4.0, 2e-13);
            }
        }
        // A table's rows must fall on the series' own steps: one piece of it.
        let scene = Scene::oscillator(m, c, k).with_load(Load::table(table.clone())).with_initial(&[0.1], &[0.0]);
        check(&format!("{system}, ramp"), &scene, 0.7, 2e-13);
    }
}

#[test]
fn a_million_times_critical_damping_follows_both_roots() {
    let (c, k) = (2e6, 1.0f64);
    let delta = (1e12f64 - 1.0).sqrt();
    let (slow, fast) = (-k / (1e6 + delta), -(1e6 + delta));
    let scene = Scene::oscillator(1.0, c, k).with_initial(&[1.0], &[5.0]);
    for t in [1e-8, 1e-6, 1e-3, 1.0, 1e5, 3e6] {
        let (q, v) = flow(&scene, t, t);
        let s = ((slow * t).exp() - (fast * t).exp()) / (slow - fast);
        let s = if t < 1e-5 { (slow * t).exp() * -((fast - slow) * t).exp_m1() / (slow - fast) } else { s };
        let exact = (slow * t).exp() + (5.0 - slow) * s;
        assert!((q - exact).abs() < 2e-15, "{t}: {q} {exact}");
        let rate = slow * exact + (5.0 - slow) * (fast * t).exp();
        assert!((v - rate).abs() < 1e-14 * rate.abs() + 1e-21, "{t}: {v:e} {rate:e}");
    }
}

#[test]
fn accelerations_and_impulses_agree_with_the_motion() {
    let scene = Scene::oscillator(1.3, 0.4, 20.0)
        .with_wall(signorini::Wall::upper("soft", -0.5).with_elasticity(300.0, 1.5))
        .with_load(Load::harmonic(5.0, 0.7, 0.2))
        .with_load(Load::constant(60.0))
        .with_duration(0.5);
    let mut event = Event::new(&scene, 0.5).unwrap();
    event.advance(0.0).unwrap();
    let arc = event.arc();
    let (from, to) = (arc.start(), arc.end());
    // Gauss's rule of three points over 200 pieces: its error is far below 1e-13 here.
    let mut sum = 0.0;
    for i in 0..200 {
        let h = (to - from) / 200.0;
        let mid = from + (i as f64 + 0.5) * h;
        for (x, w) in [(-0.6f64.sqrt(), 5.0), (0.0, 8.0), (0.6f64.sqrt(), 5.0)] {
            let t = mid + 0.5 * h * x;
            sum += w / 18.0 * h * arc.contact_force(0, t);
            let (q, v) = arc.state(t);
            let balance = arc.load(t) + arc.contact_force(0, t) - 0.4 * v - 20.0 * q;
            assert!((1.3 * arc.acceleration(t) - balance).abs() < 1e-12 * 200.0);
        }
    }
    let impulse = arc.contact_impulse(0, from, to);
    assert!((impulse - sum).abs() < 1e-12 * sum.abs(), "{impulse} {sum}");
    let half = arc.contact_impulse(0, from, 0.1) + arc.contact_impulse(0, 0.1, to);
    assert!((impulse - half).abs() < 1e-13 * sum.abs());
}
