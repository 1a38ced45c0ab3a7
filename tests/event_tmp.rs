//! tmp
use signorini::scene::*;
use signorini::scheme::event::Event;
#[test]
fn dbg() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_duration(1.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.0))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.0))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    let mut e = Event::new(&scene, 1.0).unwrap();
    for _ in 0..7 {
        e.advance(0.0).unwrap();
        println!(
            "{:.16} q {:.3e} v {:.16} {:?} rest {:?} a{:e} {:?} ev {:?}",
            e.end(),
            e.q()[0],
            e.v()[0],
            e.force(),
            e.rests_on(),
            e.arc().acceleration(e.end()),
            e.closed(),
            e.counters()
        );
    }
}
