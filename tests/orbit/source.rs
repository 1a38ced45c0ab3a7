//! What several files here share: two oscillators, and how branches are compared with references.

use signorini::orbit::branch::{Graph, Label, Special};
use signorini::{Load, Scene, Wall};

/// The source oscillator at a frequency (Hz) and restitution: 1 kg, 0.2 N s/m, 100 N/m, walls at
/// ±5 mm, 3 N.
pub fn source(frequency: f64, restitution: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(restitution))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(restitution))
        .with_load(Load::harmonic(3.0, frequency, 0.0))
}

/// A ball on a moving table, in its frame, at the table's acceleration `gamma` g.
pub fn ball(gamma: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("table", 0.0).with_restitution(0.7))
        .with_load(Load::constant(-9.81))
        .with_load(Load::harmonic(9.81 * gamma, 10.0, 0.0))
}

/// Equal to `share` of the value: the references have thirty digits, the orbits the rounding of a
/// few flights, amplified by at most the inverse distance of a multiplier from 1.
pub fn near(found: f64, expected: f64, share: f64) {
    assert!((found - expected).abs() <= share * expected.abs(), "{found:.16} for {expected:.16}");
}

pub fn values(graph: &Graph) -> Vec<(Label, f64, usize)> {
    graph.specials.iter().map(|special| (special.label, special.point.value, special.branch)).collect()
}

/// The one special point of `label` on branch number `branch`.
pub fn only_of(graph: &Graph, branch: usize, label: Label) -> &Special {
    let mut found = graph.specials.iter().filter(|special| special.branch == branch && special.label == label);
    let special = found.next().unwrap_or_else(|| panic!("{label}: {:?}", values(graph)));
    assert!(found.next().is_none(), "{label}: {:?}", values(graph));
    special
}
