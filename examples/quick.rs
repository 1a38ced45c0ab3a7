//! quick
use signorini::*;
fn scene(e: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
}
fn main() {
    for (e, end, u) in [
        (1.0, 1.0, -0.0042732657481526961976),
        (1.0, 2.0, 0.0048198444012089150177),
        (0.8, 1.0, -0.00066964695799148853561),
        (0.8, 2.0, -0.00089661027147989510095),
    ] {
        for name in [
            "moreau-jean",
            "moreau-jean:theta=0.75",
            "paoli-schatzman",
            "implicit-euler",
            "newmark",
            "penalty:epsilon=1e-12,integrator=trapezoidal",
            "penalty:epsilon=1e-12",
            "penalty:epsilon=1e-9,integrator=central-difference",
        ] {
            let scheme: Scheme = name.parse().unwrap();
            print!("{e} {end} {name:45}");
            for h in [1e-3, 1e-4, 1e-5] {
                match run(
                    &scene(e).with_duration(end),
                    &scheme,
                    &Options {
                        time: TimeOptions { sample: Some(1e-2), ..TimeOptions::with_step(h) },
                        backend: signorini::qp::Backend::Auto,
                    },
                ) {
                    Ok(r) => {
                        let d = r.trajectory.displacement().last().unwrap();
                        print!(
                            " err {:.1e} c {:.0e} fb {:.0e} en {:.0e} |",
                            (d - u).abs() / 5e-3,
                            r.residuals.complementarity,
                            r.residuals.force_balance,
                            r.residuals.energy.residual
                        );
                    }
                    Err(x) => print!("{x}"),
                }
            }
            println!();
        }
    }
    let r = run(&scene(0.8).with_duration(2.0), &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-4)).unwrap();
    println!("{:?}", r.residuals);
    println!("{:?}", &r.trajectory.contacts()[..3]);
    println!("{:?} {}", r.statistics.walls, r.seconds);
    for name in ["moreau-jean", "paoli-schatzman", "implicit-euler", "penalty:epsilon=1e-12"] {
        let mut s = Stepper::new(&scene(0.8), &name.parse().unwrap(), 1e-5).unwrap();
        let t = std::time::Instant::now();
        let mut x = 0.0;
        for _ in 0..1_000_000 {
            x += s.step().unwrap().q[0];
        }
        println!("{name} {} ns/step {x}", t.elapsed().as_secs_f64() * 1e3);
    }
}
