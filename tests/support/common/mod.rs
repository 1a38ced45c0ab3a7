//! Shared by the tests of the schemes: scenes, reference values, an independent event-driven
//! solution, and a slope.
#![allow(dead_code, reason = "each test binary uses a part of it")]
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

pub mod event_driven;
pub mod penalty_values;

use signorini::{Integrator, Load, PenaltyLaw, Scene, Scheme, Stepper, Wall};

/// Half the distance between the walls of the source scene, m.
pub const GAP: f64 = 5e-3;

/// The source scene: 1 kg, 0.2 N s/m, 100 N/m between walls at ±5 mm, 3 sin(10πt) N, from rest.
pub fn source(upper: f64, lower: f64) -> Scene {
    driven()
        .with_wall(Wall::upper("upper", GAP).with_restitution(upper))
        .with_wall(Wall::lower("lower", -GAP).with_restitution(lower))
}

/// Its upper wall elastic (100 N/m and the damping given, N s/m), its lower one rigid with
/// restitution `e`.
pub fn elastic(damping: f64, e: f64) -> Scene {
    driven()
        .with_wall(Wall::upper("upper", GAP).with_elasticity(100.0, damping))
        .with_wall(Wall::lower("lower", -GAP).with_restitution(e))
}

/// Both walls elastic: no rigid wall, so no restitution that a scheme could or could not honour.
pub fn all_elastic(damping: f64) -> Scene {
    driven()
        .with_wall(Wall::upper("upper", GAP).with_elasticity(100.0, damping))
        .with_wall(Wall::lower("lower", -GAP).with_elasticity(200.0, damping))
}

/// The oscillator of the source scene with its sine and no walls.
pub fn driven() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(3.0, 5.0, 0.0))
}

/// A ball of 1 kg under gravity, `height` above a rigid floor at 0.
pub fn ball(height: f64, e: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(e))
        .with_load(Load::constant(-9.81))
        .with_initial(&[height], &[0.0])
}

pub const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

pub fn penalty(epsilon: f64, integrator: Integrator) -> Scheme {
    Scheme::Penalty { law: PenaltyLaw::Quartic { epsilon }, integrator }
}

pub fn spring(stiffness: f64, integrator: Integrator) -> Scheme {
    Scheme::Penalty { law: PenaltyLaw::Linear { stiffness, damping: 0.0 }, integrator }
}

/// Displacements on a grid of `spacing` seconds up to `end`, by `per` steps in each interval; the
/// start is left out.
pub fn on_grid(scene: &Scene, scheme: &Scheme, spacing: f64, per: u64, end: f64) -> Vec<f64> {
    let mut stepper = Stepper::new(scene, scheme, spacing / per as f64).expect("a sound scene");
    let rows = (end / spacing).round() as usize;
    let mut out = Vec::with_capacity(rows);
    for _ in 0..rows {
        for _ in 0..per {
            stepper.step().expect("a step");
        }
        out.push(stepper.state().q[0]);
    }
    out
}

/// Largest difference over half the gap.
pub fn error(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |worst, (x, y)| f64::max(worst, (x - y).abs())) / GAP
}

/// Least-squares slope of log y over log x.
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    let (mx, my) = logs.iter().fold((0.0, 0.0), |(a, b), &(x, y)| (a + x / n, b + y / n));
    let (sxy, sxx) = logs.iter().fold((0.0, 0.0), |(a, b), &(x, y)| (a + (x - mx) * (y - my), b + (x - mx) * (x - mx)));
    sxy / sxx
}

/// At least `count` whole numbers from `from` to `to`, spread evenly in their logarithm.
pub fn spread(from: u64, to: u64, count: usize) -> Vec<u64> {
    let mut parts = count;
    loop {
        let ratio = (to as f64 / from as f64).powf(1.0 / (parts - 1) as f64);
        let mut out: Vec<u64> = (0..parts).map(|i| (from as f64 * ratio.powi(i as i32)).round() as u64).collect();
        out.dedup();
        if out.len() >= count {
            return out;
        }
        parts += 1;
    }
}

/// States (t, u, v) of the source scene at e = 1: 50-digit arithmetic, exact between events.
pub const RIGID_E1: [(f64, f64, f64); 2] = [
    (1.0, -0.004_273_265_748_152_696_197_6, 0.158_226_412_859_116_451_62),
    (2.0, 0.004_819_844_401_208_915_017_7, 0.169_243_311_964_714_789_64),
];
/// The same at e = 0.8.
pub const RIGID_E08: [(f64, f64, f64); 4] = [
    (1.0, -0.000_669_646_957_991_488_535_61, 0.063_944_158_912_728_478_044),
    (2.0, -0.000_896_610_271_479_895_100_95, 0.066_645_045_501_405_070_971),
    (5.0, -0.000_919_122_858_403_666_478_26, 0.067_430_940_134_800_498_306),
    (10.0, -0.000_919_123_582_678_305_620_76, 0.067_432_135_430_038_047_142),
];
/// The same with the lower wall rigid at e = 1 and the upper one elastic, 100 N/m.
pub const ELASTIC_UPPER: [(f64, f64, f64); 1] = [(1.0, 0.008_889_837_391_506_388_128_4, -0.234_697_841_038_873_201_02)];
/// Two rigid walls at e = 1, no load, v(0) = 0.1 m/s.
pub const IMPULSE_E1: [(f64, f64, f64); 3] = [
    (1.0, 0.003_660_272_198_293_940_159_8, -0.075_227_196_627_182_892_087),
    (2.0, -0.003_206_847_640_396_922_585_3, 0.062_956_750_229_846_163_573),
    (5.0, -0.004_530_150_378_068_209_483_4, -0.013_213_654_331_731_555_954),
];
/// Times of the second impact of the source scene at (e, t): 50-digit arithmetic, printed to 1e-8
/// s.
pub const SECOND_IMPACT: [(f64, f64); 4] =
    [(0.0, 0.193_754_75), (0.5, 0.168_335_66), (0.8, 0.151_677_82), (1.0, 0.141_734_77)];

/// Every integrator of the penalty.
pub const INTEGRATORS: [Integrator; 4] = Integrator::ALL;

/// The schemes on a grid that constrain by a QP.
pub const CONSTRAINED: [Scheme; 8] = [
    Scheme::ImplicitEuler,
    Scheme::PaoliSchatzman,
    MOREAU_JEAN,
    Scheme::MoreauJean { theta: 0.75 },
    Scheme::MoreauJean { theta: 1.0 },
    Scheme::GeneralizedAlpha { rho: 0.8 },
    Scheme::Newmark,
    Scheme::Located,
];

/// As [`schemes`], but for `located`: those of which each step is one of the grid, with a fixed
/// relation of its states, and of which none allocates after the first.
pub fn schemes_of_whole_steps() -> Vec<Scheme> {
    schemes().into_iter().filter(|scheme| *scheme != Scheme::Located).collect()
}

/// Every scheme on a grid; the penalty with a spring that a step of 0.1 ms resolves.
pub fn schemes() -> Vec<Scheme> {
    let mut all = CONSTRAINED.to_vec();
    all.extend(INTEGRATORS.map(|i| spring(1e6, i)));
    all
}
