//! An error asked for is kept, and the step found for it is not far from the best.
#![cfg(feature = "cli")]

use signorini::qp::Backend;
use signorini::study::accuracy::{Against, Target, reach};
use signorini::study::change::Change;
use signorini::{Load, Method, Options, Run, Scene, Scheme, Table, TimeOptions, Wall, run};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// The main scene: an oscillator of 1.6 Hz under a sine.
fn driven(amplitude: f64, frequency: f64, duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(amplitude, frequency, 0.0)).with_duration(duration)
}

fn upper(position: f64, e: f64) -> Wall {
    Wall::upper("upper", position).with_restitution(e)
}

fn lower(position: f64, e: f64) -> Wall {
    Wall::lower("lower", position).with_restitution(e)
}

fn spring(wall: Wall, stiffness: f64, damping: f64) -> Wall {
    wall.with_elasticity(stiffness, damping)
}

fn ball(e: f64, duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(lower(0.0, e))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(duration)
}

fn pulse() -> Load {
    Load::table(Table::new(vec![0.05, 0.15, 0.35, 0.4], vec![0.0, 4.0, -3.0, 0.0]).unwrap())
}

/// Scenes with walls, each with a name.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    let mut add = |name: &str, scene: Scene| scenes.push((name.to_owned(), scene));
    for e in [0.0, 0.3, 0.5, 0.8, 0.9, 1.0] {
        let duration = if e == 1.0 { 1.0 } else { 1.5 };
        add(
            &format!("two walls, e = {e}"),
            driven(3.0, 5.0, duration).with_wall(upper(5e-3, e)).with_wall(lower(-5e-3, e)),
        );
    }
    for e in [0.0, 0.5, 0.8, 1.0] {
        add(&format!("one wall, e = {e}"), driven(3.0, 5.0, 1.0).with_wall(upper(3e-3, e)));
    }
    add("unequal gaps", driven(3.0, 5.0, 1.0).with_wall(upper(4e-3, 0.8)).with_wall(lower(-8e-3, 0.8)));
    add("unequal restitution", driven(3.0, 5.0, 1.0).with_wall(upper(4e-3, 0.9)).with_wall(lower(-8e-3, 0.4)));
    add("wall at the rest position", driven(3.0, 5.0, 1.0).with_wall(upper(0.0, 0.5)));
    add("slow load", driven(3.0, 2.0, 1.5).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    add("fast load", driven(6.0, 8.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    add("strong load", driven(10.0, 5.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    for e in [0.8, 1.0] {
        let blown = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::impulse(0.1, 0.0)).with_duration(1.5);
        add(&format!("a blow, e = {e}"), blown.with_wall(upper(5e-3, e)).with_wall(lower(-5e-3, e)));
    }
    let late = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::impulse(0.1, 0.2371)).with_duration(1.5);
    add("a late blow", late.with_wall(upper(5e-3, 0.7)));
    let tabulated = Scene::oscillator(1.0, 0.2, 100.0).with_load(pulse()).with_duration(1.5);
    add("a tabulated pulse", tabulated.clone().with_wall(upper(5e-3, 0.6)).with_wall(lower(-5e-3, 0.6)));
    add("a tabulated pulse on a spring", tabulated.with_wall(spring(Wall::upper("upper", 5e-3), 1e3, 0.0)));
    for (stiffness, damping) in [(100.0, 0.0), (1e3, 0.0), (1e4, 0.0), (1e4, 1.0), (1e4, 10.0), (1e3, 100.0)] {
        let name = format!("a spring, {stiffness} N/m, {damping} N s/m");
        add(&name, driven(3.0, 5.0, 1.0).with_wall(spring(Wall::upper("upper", 3e-3), stiffness, damping)));
    }
    let between = driven(3.0, 5.0, 1.0).with_wall(spring(Wall::upper("upper", 3e-3), 1e4, 2.0));
    add("two springs", between.clone().with_wall(spring(Wall::lower("lower", -3e-3), 1e3, 0.0)));
    add("a spring and a wall, e = 1", between.clone().with_wall(lower(-5e-3, 1.0)));
    add("a spring and a wall, e = 0.5", between.with_wall(lower(-5e-3, 0.5)));
    for (e, duration) in [(0.0, 1.0), (0.5, 2.0), (0.8, 2.5), (1.0, 3.0)] {
        add(&format!("a ball, e = {e}"), ball(e, duration));
    }
    for e in [0.0, 0.3, 0.7] {
        let pressed = driven(8.0, 3.0, 1.5).with_load(Load::constant(4.0));
        add(&format!("pressed and released, e = {e}"), pressed.with_wall(upper(5e-3, e)));
    }
    let swinging = Scene::oscillator(2.0, 0.5, 300.0).with_initial(&[8e-3], &[-0.05]).with_duration(1.5);
    add("free vibration against a wall", swinging.with_wall(lower(-4e-3, 0.7)));
    scenes
}

/// Rows fine enough to see an error between impacts.
fn time() -> TimeOptions {
    TimeOptions { sample: None, ..TimeOptions::with_step(1e-3) }
}

/// Largest error of a run against the exact motion at its own rows, in the sense of a target.
fn true_error(scene: &Scene, found: &Run) -> (f64, String) {
    let sample = found.grid.end / found.grid.rows as f64;
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(sample) };
    let exact = run(scene, &Scheme::Event, &Options { time, backend: Backend::Auto }).unwrap();
    let change = Change::of_runs(scene, found, &exact, scene.duration, 0.0).unwrap();
    change.worst()
}

fn at_step(scene: &Scene, scheme: &Scheme, step: f64, sample: f64) -> Run {
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(step) };
    run(scene, scheme, &Options { time, backend: Backend::Auto }).unwrap()
}

#[test]
#[ignore]
fn measure() {
    for (scheme, against) in
        [(MOREAU, Against::Exact), (MOREAU, Against::Refinements), (Scheme::PaoliSchatzman, Against::Refinements)]
    {
        for tolerance in [3e-2, 3e-3] {
            let clock = std::time::Instant::now();
            let talk = std::env::var("TALK").is_ok();
            let (mut missed, mut short) = (0, 0);
            let mut accepted = Vec::new();
            let mut total = Vec::new();
            let mut suff = Vec::new();
            for (name, scene) in scenes() {
                if talk {
                    println!("{name} {:.1}", clock.elapsed().as_secs_f64());
                }
                let target = Target {
                    method: Some(Method::new(scheme)),
                    against,
                    most_steps: 1 << 20,
                    ..Target::new(tolerance, time())
                };
                let outcome = match reach(&scene, &target, &mut |_| {}) {
                    Ok(o) => o,
                    Err(e) => {
                        println!("  {name}: {e}");
                        continue;
                    }
                };
                if let Some(e) = &outcome.shortfall {
                    short += 1;
                    println!("  {scheme} {tolerance} {name}: {e}");
                    continue;
                }
                let a = &outcome.accuracy;
                let (error, what) = true_error(&scene, &outcome.run);
                if !(error <= tolerance) {
                    missed += 1;
                    println!("  {scheme} {against:?} {tolerance} {name}: MISS {error:.2e} {what} step {:?}", a.step_s);
                }
                let sample = outcome.run.grid.end / outcome.run.grid.rows as f64;
                let s = a.sufficient_step_s.unwrap();
                let rs = at_step(&scene, &scheme, s, sample);
                let (es, ws) = true_error(&scene, &rs);
                if !(es <= tolerance) {
                    println!("  {scheme} {against:?} {tolerance} {name}: SUFF MISS {es:.2e} {ws} step {s:?}");
                }
                // best in hindsight
                let per_row0 = (outcome.run.grid.steps / outcome.run.grid.rows) >> (a.levels.len() - 1);
                let mut best = outcome.run.grid.steps;
                let mut k = 0;
                loop {
                    let n = (per_row0 as f64 * 2f64.powf(f64::from(k) / 2.0)).round() as u64;
                    k += 1;
                    let steps = n * outcome.run.grid.rows;
                    if steps >= outcome.run.grid.steps {
                        break;
                    }
                    let r = at_step(&scene, &scheme, sample / n as f64, sample);
                    if true_error(&scene, &r).0 <= tolerance {
                        best = steps;
                        break;
                    }
                }
                let b = best as f64;
                accepted.push(outcome.run.grid.steps as f64 / b);
                total.push(a.total_steps as f64 / b);
                suff.push(rs.grid.steps as f64 / b);
            }
            let show = |mut v: Vec<f64>| {
                v.sort_by(f64::total_cmp);
                format!("median {:.1} p90 {:.1} max {:.1}", v[v.len() / 2], v[v.len() * 9 / 10], v[v.len() - 1])
            };
            println!(
                "{scheme} {against:?} {tolerance}: n {} missed {missed} short {short} | accepted {} | total {} | sufficient {} | {:.1} s",
                accepted.len(),
                show(accepted.clone()),
                show(total),
                show(suff),
                clock.elapsed().as_secs_f64()
            );
        }
    }
}
