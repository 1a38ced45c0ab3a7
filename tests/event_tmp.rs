//! tmp
use signorini::scene::*;
use signorini::scheme::event::Event;
#[test]
fn dbg() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_duration(10.0)
        .with_wall(Wall::upper("upper", 5e-3).with_elasticity(100.0, 0.0))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    let mut e = Event::new(&scene, 10.0).unwrap();
    let mut n = [0, 0];
    while !e.is_done() {
        e.advance(0.0).unwrap();
        for c in e.closed() {
            n[c.wall] += 1;
            if n[0] + n[1] < 14 {
                println!("ROW {} {:.16} {:?} {:e}", c.wall, c.start, c.end, c.approach_speed);
            }
        }
    }
    println!("ROW {n:?} q {:.16} open {}", e.q()[0], e.open_contacts().count());
    for (m, s) in [(false, 1.0), (true, 1.0)] {
        let mut scene = Scene::oscillator(1.0, 0.2, 100.0).with_duration(10.0).with_load(Load::harmonic(3.0, 5.0, 0.0));
        let _ = m;
        let e = 1.0;
        scene = scene
            .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
            .with_wall(Wall::lower("lower", -5e-3).with_restitution(e));
        let mut best = f64::MAX;
        let mut c = None;
        let mut steps = 0;
        for _ in 0..200 {
            let mut e = Event::new(&scene, 10.0 * s).unwrap();
            steps = 0;
            let t = std::time::Instant::now();
            while !e.is_done() {
                e.advance(0.0).unwrap();
                steps += 1;
            }
            best = best.min(t.elapsed().as_secs_f64());
            c = Some(e.counters());
        }
        println!("ROW best {:.2} us, {} steps {:?} {:.0} ns/impact", best * 1e6, steps, c, best * 1e9 / 104.0);
    }
}
#[test]
fn micro() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0).with_duration(0.1).with_load(Load::harmonic(3.0, 5.0, 0.0));
    let mut e = Event::new(&scene, 10.0).unwrap();
    e.advance(0.0).unwrap();
    let t0 = std::time::Instant::now();
    let mut s = 0.0;
    let n = 1_000_000;
    for i in 0..n {
        s += e.arc().state(0.1 * (i as f64) / n as f64).0;
    }
    println!("ROW jet {:.1} ns {s}", t0.elapsed().as_secs_f64() * 1e9 / n as f64);
    let t0 = std::time::Instant::now();
    let mut s = 0.0;
    for i in 0..n {
        let x = 0.1 * (i as f64) / n as f64;
        let (a, b) = (x * 31.4).sin_cos();
        let (c, d) = (x * 10.0).sin_cos();
        s += a * b + c * d * (-x).exp();
    }
    println!("ROW trig {:.1} ns {s}", t0.elapsed().as_secs_f64() * 1e9 / n as f64);
    let mut scene = Scene::oscillator(1.0, 0.2, 100.0).with_duration(1.0).with_load(Load::harmonic(3.0, 5.0, 0.0));
    scene = scene.with_wall(Wall::upper("u", 1.0)).with_wall(Wall::lower("l", -1.0));
    let t0 = std::time::Instant::now();
    let mut e = Event::new(&scene, 1e-5).unwrap();
    let mut k = 0;
    while !e.is_done() {
        e.advance(0.0).unwrap();
        k += 1;
    }
    println!("ROW quiet step {:.1} ns", t0.elapsed().as_secs_f64() * 1e9 / k as f64);
}
