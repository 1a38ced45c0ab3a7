//! Spectra against closed forms: Parseval's theorem, a sine, a random force of known density, and
//! what an oscillator makes of it.

use signorini::{Density, Options, RandomForce, Scene, Scheme, Spectrum, run};
use std::f64::consts::TAU;

/// Hann's window of length n.
fn hann(n: usize) -> Vec<f64> {
    (0..n).map(|j| (0.5 * TAU * j as f64 / n as f64).sin().powi(2)).collect()
}

#[test]
fn the_density_holds_the_variance() {
    let signal: Vec<f64> = (0..1000).map(|i| 3.0 + (0.37 * f64::from(i)).sin() + f64::from(i * i % 17)).collect();
    let spectrum = Spectrum::of(&signal, 0.02).unwrap();
    // 1000 values hold 14 segments of 128 that overlap by half, and not 8 of 256.
    assert_eq!((spectrum.segments, spectrum.density.len()), (14, 65));
    assert!((spectrum.spacing - 50.0 / 128.0).abs() < 1e-12);
    let mean = signal.iter().sum::<f64>() / 1000.0;
    let window = hann(128);
    let square: f64 = window.iter().map(|w| w * w).sum();
    let segment = |k: usize| {
        let part = signal[64 * k..].iter().zip(&window);
        part.map(|(x, w)| (w * (x - mean)).powi(2)).sum::<f64>() / square
    };
    let variance = (0..14).map(segment).sum::<f64>() / 14.0;
    let power: f64 = spectrum.density.iter().sum::<f64>() * spectrum.spacing;
    // Sums of a few hundred terms.
    assert!((power / variance - 1.0).abs() < 1e-12, "{power} {variance}");
    assert!((spectrum.degrees_of_freedom() - 36.0 * 196.0 / 265.0).abs() < 1e-12);
}

#[test]
fn a_sine_on_a_line_has_three_lines() {
    // A sin(2π 20 i/64) with A = 3 at 100 Hz: L = 64 of 288 values, K = 8. |X| is A L/4 on the line
    // and half of it beside, Σw² = 3L/8: S = A² L/(3 f_s), and a quarter of that beside.
    let signal: Vec<f64> = (0..288).map(|i| 3.0 * (TAU * 20.0 / 64.0 * f64::from(i) + 0.4).sin()).collect();
    let spectrum = Spectrum::of(&signal, 0.01).unwrap();
    assert_eq!(spectrum.segments, 8);
    let top = 9.0 * 64.0 / 300.0;
    for (k, s) in spectrum.density.iter().enumerate() {
        let expected = match k {
            20 => top,
            19 | 21 => 0.25 * top,
            _ => 0.0,
        };
        // Rounding of the sines, which are computed at arguments up to 600.
        assert!((s - expected).abs() < 1e-12 * top, "line {k}: {s} instead of {expected}");
    }
}

/// A force with a density that rises from 1 to 10 N²/Hz between 2 and 40 Hz.
fn force() -> RandomForce {
    RandomForce { density: Density::Points(vec![[2.0, 1.0], [40.0, 10.0]]), seed: 3, stream: 0 }
}

fn density(f: f64) -> f64 {
    (10.0_f64.ln() * (f / 2.0).ln() / 20.0_f64.ln()).exp()
}

/// Mean of estimate over truth between 4 and 36 Hz.
fn ratio(spectrum: &Spectrum, truth: impl Fn(f64) -> f64) -> f64 {
    let inside = spectrum.frequencies().zip(&spectrum.density).filter(|(f, _)| (4.0..36.0).contains(f));
    let ratios: Vec<f64> = inside.map(|(f, s)| s / truth(f)).collect();
    assert!(ratios.len() > 200, "{}", ratios.len());
    ratios.iter().sum::<f64>() / ratios.len() as f64
}

#[test]
fn a_random_force_has_the_density_it_was_made_with() {
    let end = 64.0;
    let table = force().table(end).unwrap();
    let values: Vec<f64> = (0..16_384).map(|i| table.piece(f64::from(i) / 256.0).0).collect();
    let spectrum = Spectrum::of(&values, 1.0 / 256.0).unwrap();
    // 15 segments, ν = 28: each of 256 lines scatters by √(2/28) = 0.27; with neighbours that have
    // most in common about 100 are independent, so their mean scatters by 0.027. Three of these.
    let ratio = ratio(&spectrum, density);
    assert!((ratio - 1.0).abs() < 0.08, "{ratio}");
}

#[test]
fn an_oscillator_filters_it_as_its_transfer_function_says() {
    let [m, c, k] = [1.0, 12.0, 4000.0];
    let end = 64.0;
    let scene = Scene::oscillator(m, c, k).with_load(force().load(end).unwrap()).with_duration(end);
    let options = Options::with_step(1.0 / 1024.0).with_sample(1.0 / 256.0);
    let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &options).unwrap();
    let spectrum = Spectrum::of(run.trajectory.displacement(), 1.0 / 256.0).unwrap();
    let transfer = |f: f64| {
        let omega = TAU * f;
        density(f) / ((k - m * omega * omega).powi(2) + (c * omega).powi(2))
    };
    // The same scatter; the step shortens frequencies by (ωh)²/12 = 0.4 % at 36 Hz, and the start
    // from rest has died out within a second.
    let ratio = ratio(&spectrum, transfer);
    assert!((ratio - 1.0).abs() < 0.08, "{ratio}");
}

#[test]
fn what_makes_no_spectrum_is_refused() {
    for (count, spacing, words) in [(71, 1.0, "71 values"), (0, 1.0, "72 or more"), (100, 0.0, "above 0")] {
        let error = Spectrum::of(&vec![1.0; count], spacing).unwrap_err();
        assert!(error.is_request() && error.to_string().contains(words), "{error}");
    }
    assert!(Spectrum::of(&[1.0; 100], f64::NAN).is_err());
    // A signal that stands still has no power.
    assert!(Spectrum::of(&[5.0; 72], 1.0).unwrap().density.iter().all(|s| *s == 0.0));
}
