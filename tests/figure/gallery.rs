//! Every kind of figure, with data as the program makes them. The pictures stay in
//! `target/tmp/gallery` for inspection; the tests read them back.
use std::path::PathBuf;

use signorini::output::atomic::write_whole;
use signorini::output::figure::{Class, Curve, Figure, HeatMap, Mark, Panel, Scale};

/// Time, displacement, velocity every millisecond, and the impulses.
type Motion = (Vec<[f64; 3]>, Vec<(f64, f64)>);

/// An oscillator (1 kg, 0.2 N s/m, 100 N/m) between walls at ±5 mm under 3 N at 5 Hz.
fn bouncing(restitution: f64, phase: f64, step: f64) -> Motion {
    let (mut u, mut v) = (0.0_f64, 0.0_f64);
    let (mut samples, mut impulses) = (vec![[0.0, 0.0, 0.0]], Vec::new());
    let per_sample = (1e-3 / step).round() as usize;
    for i in 1..=10_000 * per_sample {
        let t = i as f64 * step;
        let force = 3.0 * (std::f64::consts::TAU * 5.0 * t + phase).sin();
        v += step * (force - 0.2 * v - 100.0 * u);
        u += step * v;
        if u.abs() > 5e-3 && u * v > 0.0 {
            impulses.push((t, -(1.0 + restitution) * v));
            v *= -restitution;
        }
        if i % per_sample == 0 {
            samples.push([t, u, v]);
        }
    }
    (samples, impulses)
}

fn mm(motion: &Motion) -> Vec<(f64, f64)> {
    motion.0.iter().map(|[t, u, _]| (*t, 1e3 * u)).collect()
}

fn walls(panel: Panel) -> Panel {
    panel.mark(Mark::wall(5.0, "upper")).mark(Mark::wall(-5.0, "lower"))
}

/// Writes the picture and checks that it is a document of less than 300 kB.
fn keep(name: &str, svg: &str) {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("gallery").join(format!("{name}.svg"));
    write_whole(&path, svg.as_bytes()).unwrap();
    roxmltree::Document::parse(svg).unwrap();
    assert!(svg.len() < 300_000, "{name}: {} bytes", svg.len());
}

#[test]
fn one_response_between_its_walls() {
    let motion = bouncing(0.8, 0.0, 1e-4);
    let panel = walls(Panel::new("Displacement (mm)").curve(Curve::new("moreau-jean", mm(&motion))));
    keep("displacement", &Figure::new("Two rigid walls, 5 Hz sine", "Time (s)").panel(panel).to_svg());
}

#[test]
fn three_nearly_equal_methods_overlaid_and_apart() {
    let motions = [bouncing(0.8, 0.0, 1e-4), bouncing(0.8, 0.004, 1e-4), bouncing(0.8, 0.0, 2e-4)];
    let names = ["event", "moreau-jean:qp=clarabel", "penalty:epsilon=1e-9,integrator=discrete-gradient"];
    let first_second = |motion: &Motion| mm(motion).into_iter().take(1500).collect::<Vec<_>>();
    let mut overlaid = walls(Panel::new("Displacement (mm)"));
    let mut apart = Figure::new("Two rigid walls, 5 Hz sine: one panel a method", "Time (s)");
    for (i, (name, motion)) in names.iter().zip(&motions).enumerate() {
        let curve = Curve::new(*name, first_second(motion));
        overlaid = overlaid.curve(if i == 0 { curve.backdrop() } else { curve });
        let panel = walls(Panel::new("Displacement (mm)").heading(*name));
        apart = apart.panel(panel.curve(Curve::new("", mm(motion)).look(0)));
    }
    keep("overlaid", &Figure::new("Two rigid walls, 5 Hz sine", "Time (s)").panel(overlaid).to_svg());
    keep("apart", &apart.to_svg());
}

#[test]
fn force_as_a_curve_and_impulses_as_stems() {
    let motion = bouncing(0.8, 0.0, 1e-4);
    let force = motion.0.iter().map(|[t, u, _]| (*t, -2e4 * (u - 4.5e-3).max(0.0)));
    let side = |sign: f64| motion.1.iter().copied().filter(move |(_, j)| j * sign > 0.0).collect::<Vec<_>>();
    let figure = Figure::new("Contact force", "Time (s)")
        .panel(Panel::new("Contact force (N)").heading("upper, penalty").curve(Curve::new("penalty", force)))
        .panel(
            Panel::new("Impulse (N s)")
                .heading("both walls, moreau-jean")
                .stems(Curve::new("upper wall", side(-1.0)))
                .stems(Curve::new("lower wall", side(1.0))),
        );
    keep("contact-force", &figure.to_svg());
}

#[test]
fn a_phase_plot_with_upright_walls() {
    let motion = bouncing(0.8, 0.0, 1e-4);
    let other = bouncing(0.3, 0.0, 1e-4);
    let points = |m: &Motion| m.0.iter().map(|[_, u, v]| (1e3 * u, 1e3 * v)).collect::<Vec<_>>();
    let panel = Panel::new("Velocity (mm/s)")
        .curve(Curve::new("e = 0.8", points(&motion)))
        .curve(Curve::new("e = 0.3", points(&other)))
        .mark(Mark::wall(5.0, "upper wall").upright())
        .mark(Mark::wall(-5.0, "lower wall").upright());
    keep("phase", &Figure::new("Phase plane", "Displacement (mm)").panel(panel).to_svg());
}

#[test]
fn work_against_precision_with_its_front_and_floors() {
    let names = [
        "event",
        "moreau-jean",
        "paoli-schatzman",
        "implicit-euler",
        "newmark",
        "penalty:epsilon=1e-12",
        "penalty:epsilon=1e-9",
        "scipy DOP853",
    ];
    let mut panel = Panel::new("Wall-clock time (s)").log();
    let mut all = Vec::new();
    for (k, name) in names.iter().enumerate() {
        let order = [4.0, 1.0, 1.2, 1.0, 0.8, 2.0, 2.0, 5.0][k];
        let floor = [1e-14, 0.0, 0.0, 0.0, 5e-2, 3e-3, 3e-2, 0.0][k];
        let points: Vec<_> = (0..8)
            .map(|i| {
                let h = 10_f64.powf(-3.0 - 0.4 * f64::from(i));
                let error = (0.3 * (k as f64 + 1.0) * (h * 100.0).powf(order)).max(floor);
                (error.clamp(1e-9, 1.0), (k as f64 + 1.0) * 1e-8 / h * if k == 7 { 1e3 } else { 1.0 })
            })
            .collect();
        all.extend(points.clone());
        panel = panel.curve(Curve::new(*name, points).marked());
    }
    all.sort_by(|a: &(f64, f64), b| a.1.total_cmp(&b.1));
    let mut least = f64::INFINITY;
    all.retain(|p| {
        let better = p.0 < least;
        least = least.min(p.0);
        better
    });
    let front = all;
    let panel = panel
        .curve(Curve::new("Pareto front", front).front())
        .mark(Mark::floor(3e-2, "ε = 1e-9").upright())
        .mark(Mark::floor(3e-3, "ε = 1e-12").upright())
        .mark(Mark::floor(1e-2, "real time"));
    let figure = Figure::new("Work and precision, two rigid walls, e = 1, t ≤ 1 s", "Error of displacement / gap (–)");
    keep("work-precision", &figure.log().panel(panel).to_svg());
}

#[test]
fn a_stability_map_of_classes_and_one_of_numbers() {
    let x: Vec<f64> = (0..40).map(|i| 10_f64.powf(-3.0 + 0.1 * f64::from(i))).collect();
    let y: Vec<f64> = (0..40).map(|i| 10_f64.powf(-14.0 + 0.2 * f64::from(i))).collect();
    let (mut cells, mut growth) = (Vec::new(), Vec::new());
    for (j, epsilon) in y.iter().enumerate() {
        for (i, h) in x.iter().enumerate() {
            let stiff = h * h / epsilon.sqrt() * 1e-3;
            let rough = 0.2 * ((i * 7 + j * 13) % 5) as f64;
            let value = stiff.log10() + rough;
            cells.push(if value < -1.5 { 0 } else { ((value + 1.5) as usize + 1).min(4) });
            growth.push(if value > 4.0 { f64::NAN } else { 10_f64.powf(value) });
        }
    }
    let names = [
        ("stable", 'S'),
        ("dissipative", 'D'),
        ("energy-gaining", 'G'),
        ("wall passed unseen", 'T'),
        ("diverged", 'X'),
    ];
    let classes = names.iter().map(|(name, letter)| Class::new(*name, *letter)).collect();
    let map = HeatMap::new(
        "Stability of the penalty, trapezoidal rule",
        ("Step × angular frequency, hω (–)", Scale::Log, &x),
        ("Penalty parameter ε (m³/N)", Scale::Log, &y),
    );
    keep("stability-classes", &map.clone().classes(classes, cells).to_svg());
    keep("stability-numbers", &map.numbers("Energy growth per impact (–)", Scale::Log, growth).to_svg());
}

#[test]
fn crowded_labels_and_long_chaotic_orbits_stay_legible() {
    let mut x = (0.1_f64, 0.0_f64);
    let points: Vec<(f64, f64)> = (0..400_000)
        .map(|i| {
            let t = f64::from(i) * 0.01;
            x.1 += 0.01 * (-0.05 * x.1 + x.0 - x.0.powi(3) + 0.35 * (1.2 * t).cos());
            x.0 += 0.01 * x.1;
            x
        })
        .collect();
    let mut panel = Panel::new("A velocity with a long name that will not fit beside its axis on one line (mm/s)")
        .curve(Curve::new(
            "a label that is far too long for any legend, of a method with very \
             many options, each of which its author found worth spelling out",
            points,
        ));
    for k in 0..5 {
        let at = 1.0 + 0.02 * f64::from(k);
        panel = panel.mark(Mark::wall(at, format!("wall {k}")));
        panel = panel.mark(Mark::wall(at, format!("wall {k}")).upright());
    }
    panel = panel.mark(Mark::wall(900.0, "far wall").upright());
    let title = "A title of <&\"> three lines, since the one who wrote the case file wanted to \
        tell the whole story of the \
        scene before the reader had a chance to look at the picture, which is a thing that happens";
    keep("crowded", &Figure::new(title, "Displacement (mm)").panel(panel).to_svg());
}
