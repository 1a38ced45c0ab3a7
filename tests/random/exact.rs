use crate::draws;
use crate::random_scenes::{Units, random_scene};
use signorini::{Options, Run, Scene, Scheme, run};

fn made(scene: &Scene, scheme: Scheme, step: f64) -> Option<Run> {
    run(scene, &scheme, &Options::with_step(step)).ok().filter(|run| run.findings.is_empty())
}

#[test]
fn located_approaches_the_exact_motion() {
    let (first, cases) = (draws::seed(1), draws::cases(1000_u64));
    let names = std::env::var("TRY").unwrap_or("located".to_owned());
    let (mut tried, mut bad) = (0, 0);
    for seed in first..first + cases {
        let mut drawn = random_scene(seed, Units::Ordinary);
        let steps = (drawn.scene.duration / drawn.step).round().min(40.0);
        drawn.scene.duration = steps * drawn.step;
        let scene = &drawn.scene;
        let Some(exact) = made(scene, Scheme::Event, drawn.step) else { continue };
        let scheme = if names == "located" { Scheme::Located } else { Scheme::MoreauJean { theta: 0.5 } };
        let size = exact.state.q.iter().chain(&scene.initial.q).fold(scene.gap_scale().abs(), |a, x| a.max(x.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        let off = |parts: f64| -> Option<[f64; 2]> {
            let run = made(scene, scheme, drawn.step / parts)?;
            let q = run.state.q.iter().zip(&exact.state.q).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max);
            let sum = |run: &Run| {
                run.statistics.walls.iter().map(|w| w.force.map_or(0.0, |f| f.impulse_n_s)).collect::<Vec<_>>()
            };
            let (a, b) = (sum(&run), sum(&exact));
            let all: f64 = b.iter().sum::<f64>().max(1e-300);
            let p = a.iter().zip(&b).map(|(a, b)| (a - b).abs() / all).fold(0.0, f64::max);
            Some([q, p])
        };
        let Some(a) = off(8.0) else {
            println!("seed {seed}: failed");
            continue;
        };
        let Some(b) = off(64.0) else { continue };
        tried += 1;
        if (0..2).any(|k| b[k] > 1e-6 && b[k] > a[k] / 4.0) {
            bad += 1;
            let c = off(512.0).unwrap_or([f64::NAN; 2]);
            println!(
                "seed {seed}: n {} walls {} step {:e} steps {steps}: q {:.1e} {:.1e} {:.1e} p {:.1e} {:.1e} {:.1e}",
                scene.initial.q.len(),
                scene.walls.len(),
                drawn.step,
                a[0],
                b[0],
                c[0],
                a[1],
                b[1],
                c[1]
            );
        }
    }
    println!("{tried} tried, {bad} bad");
}
