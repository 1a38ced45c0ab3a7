//! Cost of a step against the number of degrees of freedom, and against the number of walls:
//! moreau-jean, e = 0, h = 1e-3, on chains like those of the built-in cases (1 kg, 1e4 N/m, stops
//! at ±1 mm, 50 sin(10πt) N on the first mass). Prints three tables, writes a chart of each to
//! `target/scaling` or to FOLDER in `cargo bench --bench scaling -- FOLDER`, and asserts nothing
//! about time.
//!
//! With walls at the first few masses only, n grows from 1 to 1e5: the step of a banded system is
//! linear in n. With stops on every mass, driven at every tenth so that many of them touch, walls
//! grow to 1000 (of both sides together).
//!
//! It also measures the cost of the exact motion of the source scene (e = 0.8) per period of its
//! load, against the length of the run, from 100 to 1e5 periods: the bare stepper, a judged run, a
//! recorded run (a row every ten periods), and both.

use signorini::linear::{Factor, Symmetric};
use signorini::output::atomic::write_whole;
use signorini::output::figure::{Curve, Figure, Panel};
use signorini::{Chain, Load, Options, Probe, Row, Scene, Scheme, State, Stepper, Wall, run};
use std::hint::black_box;
use std::path::PathBuf;
use std::time::{Duration, Instant};

const H: f64 = 1e-3;
const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };
/// Number of masses with walls where n grows.
const FEW: usize = 5;
/// A measurement takes about this long and is repeated `TURNS` times, of which the best counts; a
/// series ends when one exceeds the limit.
const TURN: Duration = Duration::from_millis(200);
const TURNS: u32 = 3;
const LIMIT: Duration = Duration::from_secs(20);

/// A chain of `n` masses of which the first `walled` stand between stops, driven at the masses
/// `driven`.
fn chain(n: usize, walled: usize, driven: impl Iterator<Item = usize>) -> Scene {
    let chain = Chain { masses: vec![1.0; n], springs: vec![1e4; n - 1], grounds: [1e4; 2] };
    let mut structure = chain.structure().expect("a chain");
    structure.damping = Symmetric::sum(&[(1e-5, &structure.stiffness)]);
    let mut scene = Scene::oscillator(1.0, 0.0, 1.0).with_duration(1e3);
    scene.system = structure.into();
    scene.initial = State { q: vec![0.0; n], v: vec![0.0; n] };
    scene.probes = vec![Probe { name: "first".into(), at: Row::dof(0) }];
    for i in 0..walled {
        for wall in [Wall::upper(&format!("upper-{i}"), 1e-3), Wall::lower(&format!("lower-{i}"), -1e-3)] {
            scene.walls.push(wall.with_restitution(0.0).at(Row::dof(i)));
        }
    }
    for i in driven {
        // Different phases, so that neighbours do not move together.
        scene.loads.push(Load { at: Row::dof(i), ..Load::harmonic(50.0, 5.0, 0.7 * i as f64) });
    }
    scene
}

/// What was measured of one scene.
struct Cost {
    n: usize,
    walls: usize,
    /// Best of the turns, ns per step.
    step: f64,
    /// Setting up, s.
    setup: f64,
    /// Mean numbers per step.
    programmes: f64,
    pivots: f64,
    interior: f64,
    /// How the matrix of a step is factored.
    factor: String,
}

/// Steps of `scene` in turns of a fraction of a second, cut short where the limit is reached.
fn measure(scene: &Scene) -> Cost {
    let begun = Instant::now();
    let mut stepper = Stepper::new(scene, &MOREAU_JEAN, H).expect("a scene");
    let setup = begun.elapsed().as_secs_f64();
    let mut best = f64::INFINITY;
    let mut slow = false;
    // The first turn warms up, and brings the chain to its stops.
    for turn in 0..=TURNS {
        let (started, mut steps) = (Instant::now(), 0_u32);
        while started.elapsed() < TURN || steps < 3 {
            black_box(stepper.step().expect("a step").q);
            steps += 1;
            if begun.elapsed() > LIMIT {
                slow = true;
                break;
            }
        }
        if turn > 0 || slow {
            best = best.min(started.elapsed().as_secs_f64() * 1e9 / f64::from(steps.max(1)));
        }
        if slow {
            break;
        }
    }
    let counters = stepper.counters();
    let per_step = |count: u64| count as f64 / counters.steps as f64;
    let s = scene.system.structure();
    let matrix = Symmetric::sum(&[(1.0, &s.mass), (0.5 * H, &s.damping), (0.25 * H * H, &s.stiffness)]);
    Cost {
        n: s.mass.size(),
        walls: scene.walls.len(),
        step: best,
        setup,
        programmes: per_step(counters.qp_solves),
        pivots: per_step(counters.pivots),
        interior: per_step(counters.interior_point_iterations),
        factor: Factor::new(&matrix).map_or_else(|_| "-".into(), |f| f.describe()),
    }
}

/// Measures scenes until one is too slow, and prints a table of them.
fn series(title: &str, scenes: impl Iterator<Item = Scene>) -> Vec<Cost> {
    println!("{title}");
    println!(
        "{:>7} {:>6} {:>12} {:>10} {:>10} {:>10} {:>8} {:>8} {:>10}  factor",
        "n", "walls", "ns/step", "ns/dof", "ns/wall", "QPs/step", "pivots", "IP its", "set up (s)"
    );
    let mut costs = Vec::new();
    for scene in scenes {
        let cost = measure(&scene);
        let Cost { n, walls, step, setup, programmes, pivots, interior, factor } = &cost;
        let (dof, wall) = (step / *n as f64, step / (*walls).max(1) as f64);
        println!(
            "{n:>7} {walls:>6} {step:>12.0} {dof:>10.2} {wall:>10.1} {programmes:>10.3} \
             {pivots:>8.2} {interior:>8.2} {setup:>10.2e}  {factor}"
        );
        let slow = step * 1e-9 > TURN.as_secs_f64() || *setup > LIMIT.as_secs_f64();
        costs.push(cost);
        if slow {
            println!("        and no further: a step takes too long");
            break;
        }
    }
    println!();
    costs
}

/// The cost of a step over what grows, and the straight line that is linear in it.
fn picture(title: &str, x_label: &str, points: Vec<(f64, f64)>) -> String {
    let last = points.last().copied().unwrap_or((1.0, 1.0));
    let linear = points.iter().map(|p| (p.0, last.1 * p.0 / last.0)).collect::<Vec<_>>();
    let panel = Panel::new("Time of a step (ns)").log();
    let panel = panel.curve(Curve::new("moreau-jean", points).marked()).curve(Curve::new("linear", linear).backdrop());
    Figure::new(title, x_label).log().panel(panel).to_svg()
}

/// 1 kg, 0.2 N s/m, 100 N/m between walls at ±5 mm with e = 0.8, 3 sin(10πt) N.
fn source(periods: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(0.2 * periods)
}

/// Cost of `go` in ns per period, for a run of this many periods: the best of a few turns, or the
/// only one of a long run.
fn per_period(periods: f64, mut go: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    let begun = Instant::now();
    for _ in 0..TURNS {
        let started = Instant::now();
        go();
        best = best.min(started.elapsed().as_secs_f64() * 1e9 / periods);
        if begun.elapsed() > 2 * TURN {
            break;
        }
    }
    best
}

/// The cost of exact motion, and of judging and recording it, against the length of the run.
fn by_length() -> Vec<(f64, [f64; 4])> {
    println!("exact motion of the source scene, e = 0.8");
    println!(
        "{:>9} {:>12} {:>12} {:>12} {:>12}  judged/stepper (ns a period)",
        "periods", "stepper", "judged", "recorded", "both"
    );
    let mut rows = Vec::new();
    for periods in [100.0, 1e3, 1e4, 1e5] {
        let scene = source(periods);
        let options = Options::with_step(0.1).with_sample(2.0);
        let exact = Scheme::Event;
        let stepper = per_period(periods, || {
            let mut stepper = Stepper::new(&scene, &exact, scene.duration).expect("a scene");
            while stepper.time() < scene.duration {
                black_box(stepper.step().expect("a step").q);
            }
        });
        let judged = per_period(periods, || {
            black_box(run(&scene, &exact, &options.unrecorded()).expect("a run"));
        });
        let recorded = per_period(periods, || {
            black_box(run(&scene, &exact, &options.unjudged()).expect("a run"));
        });
        let both = per_period(periods, || {
            black_box(run(&scene, &exact, &options).expect("a run"));
        });
        let ratio = judged / stepper;
        println!("{periods:>9} {stepper:>12.0} {judged:>12.0} {recorded:>12.0} {both:>12.0}  {ratio:.2}");
        rows.push((periods, [stepper, judged, recorded, both]));
    }
    println!();
    rows
}

/// These costs as a chart: flat lines mean that the cost per period does not grow.
fn length_picture(rows: &[(f64, [f64; 4])]) -> String {
    let names = ["bare stepper", "judged", "recorded", "judged and recorded"];
    let mut panel = Panel::new("Time of a period of the load (ns)").log();
    for (index, name) in names.into_iter().enumerate() {
        let points: Vec<_> = rows.iter().map(|(x, costs)| (*x, costs[index])).collect();
        panel = panel.curve(Curve::new(name, points).marked());
    }
    Figure::new("Cost of exact motion against the length of the run", "Periods (–)").log().panel(panel).to_svg()
}

fn main() {
    // Cargo passes `--bench`; the first argument that is no option is the folder.
    let folder = std::env::args().skip(1).find(|a| !a.starts_with('-'));
    let folder = PathBuf::from(folder.unwrap_or_else(|| "target/scaling".to_owned()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let sizes = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000];
    let few = sizes.into_iter().map(|n| chain(n, FEW.min(n), std::iter::once(0)));
    let by_size = series("chains of n masses, stops at the first five", few);
    let counts = [1, 3, 10, 30, 100, 200, 500];
    let many = counts.into_iter().map(|n| chain(n, n, (0..n).step_by(10)));
    let by_walls = series("chains with stops at every mass", many);
    let files = [
        ("cost-by-size.svg", "Cost of a step, stops at five masses", "Degrees of freedom (–)", by_size, true),
        ("cost-by-walls.svg", "Cost of a step, stops at every mass", "Walls (–)", by_walls, false),
    ];
    for (name, title, label, costs, by_n) in files {
        let x = |c: &Cost| if by_n { c.n as f64 } else { c.walls as f64 };
        let svg = picture(title, label, costs.iter().map(|c| (x(c), c.step)).collect());
        let path = folder.join(name);
        write_whole(&path, svg.as_bytes()).expect("a file");
        println!("wrote {}", path.display());
    }
    let path = folder.join("cost-by-length.svg");
    write_whole(&path, length_picture(&by_length()).as_bytes()).expect("a file");
    println!("wrote {}", path.display());
}
