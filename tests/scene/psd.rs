//! Random forces: their spectrum as asked for, the response to it in closed form, and the same
//! force for every step.
use signorini::case::Case;
use signorini::{Density, LoadKind, Options, RandomForce, Scene, Scheme, Table, run};
use std::f64::consts::TAU;

fn case(text: &str) -> Case {
    Case::parse(text, "psd.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

/// The amplitude of the line at f = i/T of a table of linear pieces over [0, T], by the integral of
/// each piece times e^{−iωt} in closed form: no transform, and no sinc.
fn amplitude(table: &Table, period: f64, line: usize) -> f64 {
    let omega = TAU * line as f64 / period;
    let (mut re, mut im) = (0.0, 0.0);
    let rows = table.time().iter().zip(table.force()).take_while(|(t, _)| **t <= period * (1.0 + 1e-12));
    let rows: Vec<(f64, f64)> = rows.map(|(&t, &f)| (t, f)).collect();
    for pair in rows.windows(2) {
        let [(t0, f0), (t1, f1)] = [pair[0], pair[1]];
        let slope = (f1 - f0) / (t1 - t0);
        // ∫ (f0 + slope (t − t0)) cos ωt dt and the same with sin, by parts.
        let of = |t: f64, f: f64| {
            let (s, c) = (omega * t).sin_cos();
            (f * s / omega + slope * c / (omega * omega), f * c / omega - slope * s / (omega * omega))
        };
        let ((a0, b0), (a1, b1)) = (of(t0, f0), of(t1, f1));
        re += a1 - a0;
        im += b1 - b0;
    }
    2.0 / period * re.hypot(im)
}

#[test]
fn the_density_of_the_force_is_the_one_asked_for() {
    // A density with corners, of which every line is known in closed form: straight in logarithms.
    let points = vec![[2.0, 0.5], [10.0, 0.02], [37.5, 0.3]];
    let asked = |f: f64| {
        let [[f0, s0], [f1, s1]] = if f <= 10.0 { [points[0], points[1]] } else { [points[1], points[2]] };
        s0 * (f / f0).powf((s1 / s0).ln() / (f1 / f0).ln())
    };
    let end = 8.0;
    for seed in [1, 2] {
        let force = RandomForce { density: Density::Points(points.clone()), seed, stream: 0 };
        let table = force.table(end).unwrap();
        for line in [16, 17, 40, 79, 80, 81, 200, 299, 300] {
            // S Δf is half the square of the amplitude. The closed form takes differences of f/ω
            // over 8192 pieces, which round by 1e-16 of the largest force each.
            let density = 0.5 * amplitude(&table, end, line).powi(2) * end;
            let error = density / asked(line as f64 / end) - 1.0;
            assert!(error.abs() < 1e-12, "{seed} {line}: {error:e}");
        }
        // Nothing outside the band.
        for line in [1, 15, 301, 350] {
            let outside = amplitude(&table, end, line);
            assert!(outside < 1e-12, "{line}: {outside:e}");
        }
    }
}

#[test]
fn the_response_has_the_variance_of_the_line_spectrum() {
    // Σ S Δf |H(f_i)|² of an oscillator, with 40 digits, for 781 lines over 20 s: the mean square
    // of the steady response over one period of the force, whatever the phases. Four periods of the
    // table, one after another; after three the start has decayed by e^(−0.4·60) = 4e-11.
    let (end, steady) = (20.0, 1.560_804_164_802_229_5e-6);
    for seed in [3, 4] {
        let density = Density::Points(vec![[1.0, 0.02], [40.0, 0.02]]);
        let table = RandomForce { density, seed, stream: 0 }.table(end).unwrap();
        let rows = table.time().len() - 2;
        let time: Vec<f64> = (0..=4 * rows).map(|j| end * j as f64 / rows as f64).collect();
        let force: Vec<f64> = (0..=4 * rows).map(|j| table.force()[j % rows]).collect();
        let mut square = force[..rows].iter().map(|f| f * f).sum::<f64>() / rows as f64;
        // The mean square of the rows: that of the lines, each over sinc⁴.
        let over = |i: f64| (std::f64::consts::PI * i / rows as f64).sin() / (std::f64::consts::PI * i / rows as f64);
        let rows_asked: f64 = (20..=800).map(|i| 0.02 / end / over(f64::from(i)).powi(4)).sum();
        assert!((square / rows_asked - 1.0).abs() < 1e-12, "{square}");
        let scene = Scene::oscillator(1.0, 0.8, 4000.0)
            .with_load(signorini::Load::table(Table::new(time, force).unwrap()))
            .with_duration(4.0 * end);
        // Sampled at 64 instants of the shortest period: the mean square of a band-limited signal
        // over whole periods is exact; images above the band are 1e-9 of the response.
        let sample = end / (16.0 * 800.0 * 4.0);
        let run = run(&scene, &Scheme::Event, &Options::with_step(sample).with_sample(sample)).unwrap();
        let last: Vec<f64> =
            run.trajectory.displacement().iter().rev().take((end / sample).round() as usize).copied().collect();
        square = last.iter().map(|q| q * q).sum::<f64>() / last.len() as f64;
        assert!((square / steady - 1.0).abs() < 1e-8, "{seed}: {square:e}");
    }
}

/// A tube in two planes between flats, under random forces in both.
fn tube(step: f64) -> Case {
    case(&text(0.5, step))
}

#[test]
fn half_the_step_sees_the_same_force_and_follows_the_exact_motion() {
    let [coarse, fine] = [tube(1e-4), tube(5e-5)];
    assert_eq!(coarse.scene.loads, fine.scene.loads);
    // Without walls the θ-method is of order 2: with half the step four times closer to the exact
    // scheme. The rows of the table do not lie on the steps.
    let end = 0.05;
    let at = |case: &Case, scheme: Scheme, step: f64| {
        let mut scene = case.scene.clone();
        scene.duration = end;
        scene.walls.clear();
        scene.supports.clear();
        let run = run(&scene, &scheme, &Options::with_step(step)).unwrap();
        run.trajectory.probe("bars-y").unwrap().0.last().copied().unwrap()
    };
    let exact = at(&coarse, Scheme::Event, 1e-3);
    let [a, b] = [(&coarse, 1e-4), (&fine, 5e-5)]
        .map(|(case, step)| (at(case, Scheme::MoreauJean { theta: 0.5 }, step) - exact).abs());
    assert!(a > 0.0 && (3.5..4.5).contains(&(a / b)), "{a:e} {b:e}");
}

#[test]
fn signals_of_a_seed_are_independent_and_repeat() {
    let case = tube(1e-4);
    assert_eq!(case.scene.loads, tube(1e-4).scene.loads);
    let tables: Vec<&Table> = case
        .scene
        .loads
        .iter()
        .map(|load| match &load.kind {
            LoadKind::Table(table) => table,
            other => panic!("{other:?}"),
        })
        .collect();
    // The load along y, the second load, and last the first one along z: of one seed, three
    // signals. Correlations of 30 lines scatter by 1/√60 = 0.13.
    assert_eq!(tables.len(), 3);
    for (i, a) in tables.iter().enumerate() {
        for b in &tables[..i] {
            let product: f64 = a.force().iter().zip(b.force()).map(|(a, b)| a * b).sum();
            let correlation = product / (25.0 * a.force().len() as f64);
            assert!(correlation.abs() < 0.5, "{correlation}");
        }
    }
    // Another seed, another signal of the same mean square.
    let other = RandomForce { density: Density::Flat { rms: 5.0, from: 1.0, to: 60.0 }, seed: 10, stream: 0 };
    let (other, rows) = (other.table(0.5).unwrap(), tables[0].force().len() - 2);
    assert!(other.force() != tables[0].force());
    let square = |table: &Table| table.force()[..rows].iter().map(|f| f * f).sum::<f64>();
    assert!((square(&other) / square(tables[0]) - 1.0).abs() < 1e-12);
}

#[test]
fn the_values_of_many_lines_are_nearly_gaussian() {
    // Kurtosis 3 of a Gaussian, less 1.5/lines of a sum of lines; one realisation of 1485 lines
    // scatters by 0.1.
    let force = RandomForce { density: Density::Flat { rms: 1.0, from: 1.0, to: 100.0 }, seed: 5, stream: 0 };
    let table = force.table(15.0).unwrap();
    let mean = |p: i32| table.force().iter().map(|f| f.powi(p)).sum::<f64>() / table.force().len() as f64;
    assert!((mean(4) / mean(2).powi(2) - 3.0).abs() < 0.3, "{}", mean(4) / mean(2).powi(2));
}

#[test]
fn another_end_makes_the_random_force_anew() {
    let changed = tube(1e-4).with("time.end", 0.8).unwrap();
    assert_eq!(changed.scene, case(&text(0.8, 1e-4)).scene);
    assert_ne!(changed.scene.loads, tube(1e-4).scene.loads);
}

#[test]
fn a_realisation_is_the_case_of_its_document() {
    let third = tube(1e-4).realisation(3).unwrap();
    assert_ne!(third.scene.loads, tube(1e-4).scene.loads);
    assert_eq!(third.document.case().unwrap(), third);
}

fn text(end: f64, step: f64) -> String {
    format!(
        "[system]\nplanes = 2\nmodes = 5\n[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
         outer_diameter = 19.05e-3\ninner_diameter = 15.75e-3\nelements = 12\nleft = \"pinned\"\nright = \"pinned\"\n\
         [system.damping]\nratio = 0.02\n\
         [[support]]\nname = \"bars\"\nat = {{ position = 1.0 }}\nshape = \"flats\"\nsides = 4\n\
         gap = 0.2e-3\nrestitution = 0.5\n\
         [[load]]\nat = {{ position = 0.5 }}\ndirection = \"both\"\n\
         random = {{ rms = 5.0, from = 1.0, to = 60.0, seed = 9 }}\n\
         [[load]]\nat = {{ position = 2.0 }}\ndirection = 30\n\
         random = {{ rms = 5.0, from = 1.0, to = 60.0, seed = 9 }}\n\
         [time]\nend = {end:?}\nstep = {step:e}\n"
    )
}

#[test]
fn a_density_in_a_file_is_the_same_as_in_the_case() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("psd.csv"), "frequency_Hz,density_N2_per_Hz\n1,0.02\n50,0.3\n").unwrap();
    let of = |density: &str| {
        format!(
            "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n[[load]]\n\
             random = {{ {density}, seed = 3 }}\n[time]\nend = 2.0\nstep = 1e-3\n"
        )
    };
    let [listed, filed] = ["psd = [[1.0, 0.02], [50.0, 0.3]]", "file = \"psd.csv\""]
        .map(|density| Case::parse(&of(density), "psd.toml", folder.path()).unwrap_or_else(|error| panic!("{error}")));
    assert_eq!(listed.scene, filed.scene);
}
