use super::*;
use crate::scene::LoadKind;
use std::f64::consts::PI;

/// S = 1 (N/m)²/Hz everywhere.
fn white() -> TurbulenceSpectrum {
    TurbulenceSpectrum::Even(vec![[1e-3, 1.0], [1e3, 1.0]])
}

/// A field over `length` (m) in `cells` cells, whose mean displacements are the degrees of freedom.
fn field(length: f64, cells: usize, correlation_length: f64) -> Turbulence {
    Turbulence {
        cells: (0..cells).map(Row::dof).collect(),
        along: [0.0, length],
        spectrum: white(),
        correlation_length,
        band: [1.0, 20.0],
        seed: 1,
        stream: 0,
    }
}

/// The modes sin iπx/L, i = 1 to `count`, in their means over cells.
fn sines(length: f64, cells: usize, count: usize) -> Modes {
    let size = length / cells as f64;
    let shape = |i: usize| {
        let k = PI * i as f64 / length;
        let edge = |cell: usize| (k * size * cell as f64).cos();
        (0..cells).map(|cell| (edge(cell) - edge(cell + 1)) / (k * size)).collect()
    };
    Modes { omega: vec![1.0; count], shapes: (1..=count).map(shape).collect() }
}

/// D at a frequency at which S = 1.
fn densities(field: &Turbulence, modes: &Modes) -> Vec<Vec<f64>> {
    let coherence = CellCoherence::new(field.cell_length(), field.correlation_length);
    field.cross_densities(coherence, &field.weights(modes), 5.0)
}

fn force(load: &Load) -> &[f64] {
    match &load.kind {
        LoadKind::Table(table) => table.force(),
        _ => &[],
    }
}

#[test]
fn the_density_of_a_mode_is_that_of_the_double_integral() {
    // ∬ φ₃φ₃ e^(−|x−x′|/λ) over 3 m for λ = 0.1 m, by quadrature in 30 digits.
    let known = 0.274_686_165_379_587;
    let error = |cells| densities(&field(3.0, cells, 0.1), &sines(3.0, cells, 3))[2][2] / known - 1.0;
    let errors = [300, 600, 1200].map(error);
    // (kℓ)²/6 at k = π and cells of 10 mm: 1.6e-4; a quarter of it each time.
    assert!(errors[0].abs() < 2.0 * (PI * 0.01_f64).powi(2) / 6.0, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 0.05, "{errors:?}");
    }
    // At large λ/ℓ as at small.
    for correlation_length in [1e-4, 1e4] {
        let coarse = densities(&field(3.0, 300, correlation_length), &sines(3.0, 300, 3))[2][2];
        let fine = densities(&field(3.0, 2400, correlation_length), &sines(3.0, 2400, 3))[2][2];
        assert!((coarse / fine - 1.0).abs() < 2.0 * (PI * 0.01_f64).powi(2) / 6.0);
    }
}

#[test]
fn forces_have_the_cross_densities_that_were_asked_for() {
    let modes = sines(3.0, 120, 3);
    for correlation_length in [0.05, 0.5, 5.0] {
        let asked = densities(&field(3.0, 120, correlation_length), &modes);
        let mut found = [[0.0; 3]; 3];
        let (seeds, end) = (64, 20.0);
        let mut lines = 0;
        for seed in 0..seeds {
            let field = Turbulence { seed, ..field(3.0, 120, correlation_length) };
            let grid = field.lines(end).expect("lines");
            let amplitudes = field.amplitudes(&grid, &field.weights(&modes));
            lines += grid.numbers().len();
            for (i, j) in (0..3).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                let products = amplitudes[i].iter().zip(&amplitudes[j]).map(|(a, b)| a.0 * b.0 + a.1 * b.1);
                // A line of amplitude c has the mean square ½c², that of its density times 1/T.
                found[i][j] += 0.5 * end * products.sum::<f64>();
            }
        }
        for (i, j) in (0..3).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let scale = (asked[i][i] * asked[j][j]).sqrt();
            let error = (found[i][j] / lines as f64 - asked[i][j]) / scale;
            // 64 seeds of 381 lines: the mean of products of unit phasors scatters by 1/√24384,
            // 0.64 %; three times that.
            assert!(error.abs() < 0.02, "λ = {correlation_length}: D{i}{j} off by {error:e} of the diagonal");
            // The first mode has one phasor, so that its mean square does not scatter.
            assert!(i > 0 || error.abs() < 1e-12);
        }
    }
}

#[test]
fn the_table_is_the_sum_of_its_lines() {
    let (modes, field) = (sines(3.0, 60, 2), field(3.0, 60, 0.1));
    let lines = field.lines(2.0).expect("lines");
    let amplitudes = field.amplitudes(&lines, &field.weights(&modes));
    let loads = field.forces(&modes, 2.0).expect("forces");
    assert_eq!(loads.iter().map(|load| load.at.clone()).collect::<Vec<_>>(), [Row::dof(0), Row::dof(1)]);
    for (load, amplitudes) in loads.iter().zip(&amplitudes) {
        for row in [0, 17, 300] {
            let sum: f64 = lines
                .numbers()
                .zip(amplitudes)
                .map(|(i, (a, b))| {
                    let x = PI * i as f64 / lines.rows() as f64;
                    let (sin, cos) = (2.0 * x * row as f64).sin_cos();
                    (a * cos - b * sin) / (x.sin() / x).powi(2)
                })
                .sum();
            let size = amplitudes.iter().map(|(a, b)| a.hypot(*b)).sum::<f64>();
            assert!((force(load)[row] - sum).abs() < 1e-13 * size);
        }
    }
}

#[test]
fn the_first_forces_stay_as_modes_are_added() {
    let field = field(3.0, 120, 0.1);
    let few = field.forces(&sines(3.0, 120, 3), 4.0).expect("forces");
    let many = field.forces(&sines(3.0, 120, 9), 4.0).expect("forces");
    assert_eq!(few[..], many[..3]);
}

#[test]
fn a_field_that_is_coherent_everywhere_is_one_signal() {
    // λ = 1e12 m over 3 m: what is not coherent is 3e-12 of the whole, its root 2e-6.
    let (modes, field) = (sines(3.0, 120, 5), field(3.0, 120, 1e12));
    let loads = field.forces(&modes, 4.0).expect("forces");
    let sum = |i: usize| modes.shapes[i].iter().sum::<f64>();
    // The second and fourth have equal positive and negative parts, of which rounding is left.
    for (load, i) in loads.iter().zip(0..5).filter(|(_, i)| i % 2 == 0) {
        for (one, first) in force(load).iter().zip(force(&loads[0])) {
            assert!((one - first * sum(i) / sum(0)).abs() < 1e-5 * field.cell_length() * sum(0) * 10.0);
        }
    }
}

#[test]
fn seeds_and_streams_are_independent() {
    let modes = sines(3.0, 60, 1);
    let signal = |seed, stream| {
        let field = Turbulence { seed, stream, ..field(3.0, 60, 0.1) };
        force(&field.forces(&modes, 50.0).expect("forces")[0]).to_vec()
    };
    let correlation = |a: &[f64], b: &[f64]| {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
    };
    let first = signal(1, 0);
    assert_eq!(first, signal(1, 0));
    // 951 lines: scatters by 1/√(2·951), 2.3 %; three times that.
    assert!(correlation(&first, &signal(2, 0)).abs() < 0.07);
    assert!(correlation(&first, &signal(1, 1)).abs() < 0.07);
}

#[test]
fn modes_that_do_not_move_along_the_stretch_have_no_force() {
    let mut modes = sines(3.0, 60, 3);
    modes.shapes[1].fill(0.0);
    let loads = field(3.0, 60, 0.1).forces(&modes, 2.0).expect("forces");
    assert_eq!(loads.iter().map(|load| load.at.clone()).collect::<Vec<_>>(), [Row::dof(0), Row::dof(2)]);
    modes.shapes.iter_mut().for_each(|shape| shape.fill(0.0));
    assert_eq!(field(3.0, 60, 0.1).forces(&modes, 2.0), Ok(Vec::new()));
}

#[test]
fn the_spectrum_of_a_flow_follows_its_velocity() {
    let flow = |velocity| TurbulenceSpectrum::Flow {
        density: 740.0,
        diameter: 0.02,
        velocity: vec![velocity, 0.0],
        reduced: vec![[0.01, 1.0], [1.0, 1e-4]],
    };
    // At fD/V = 0.1: Φ = 1e-2, (½ 740 2² 0.02)² 0.01 = 8.7616 N²/m² s.
    assert!((flow(2.0).at(0, 10.0) / (8.7616 * 1e-2) - 1.0).abs() < 1e-12);
    assert_eq!(flow(2.0).band(0), [1.0, 100.0]);
    assert_eq!((flow(2.0).at(0, 0.99), flow(2.0).at(0, 101.0), flow(2.0).at(1, 10.0)), (0.0, 0.0, 0.0));
}

#[test]
fn what_makes_no_field_is_refused() {
    let modes = sines(3.0, 60, 5);
    let refused = |change: &dyn Fn(&mut Turbulence), words: &str| {
        let mut field = field(3.0, 60, 0.1);
        change(&mut field);
        let error = field.forces(&modes, 2.0).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&|field| field.along = [1.0, 1.0], "along");
    refused(&|field| field.cells.clear(), "along");
    refused(&|field| field.correlation_length = f64::NAN, "correlation_length");
    refused(&|field| field.band = [0.0, 2.0], "from");
    refused(&|field| field.band = [3.0, 2.0], "to");
    refused(&|field| field.band = [0.6, 0.9], "without a line");
    refused(&|field| field.band = [1.0, 1e7], "2^24 rows");
    refused(&|field| field.band = [1.0, 5e5], "2^26 values");
    refused(&|field| field.spectrum = TurbulenceSpectrum::Even(vec![[1.0, 1.0]]), "two pairs");
    let flow = |velocity: Vec<f64>| TurbulenceSpectrum::Flow {
        density: 1000.0,
        diameter: 0.02,
        velocity,
        reduced: vec![[0.01, 1.0], [1.0, 1e-4]],
    };
    refused(&|field| field.spectrum = flow(vec![1.0]), "one of each of 60 cells");
    refused(&|field| field.spectrum = flow(vec![-1.0; 60]), "velocity");
}
