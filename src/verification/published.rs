//! Values of other programs and of benchmarks.

use super::entry::{Entry, Expected, Scene};
use super::quantity::{contact, displacement, last_displacement, velocity, work_rate};

const PRINTED: &str = "the digits that the source prints";
const SDND104: Scene = Scene::Own("sdnd104", include_str!("scenes/sdnd104.toml"));
const SDNL32: Scene = Scene::Own("sdnl32", include_str!("scenes/sdnl32.toml"));

/// The work rate of SDND104 at one amplitude of the base's acceleration.
macro_rules! sdnd104 {
    ($amplitude:literal, $value:literal, $tolerance:literal) => {
        Entry {
            scene: SDND104,
            changes: &[("load.1.harmonic.amplitude", $amplitude)],
            method: "moreau-jean",
            source: "code_aster SDND104 (V5.01.104)",
            values: &[Expected {
                quantity: "work rate of wear, 4 to 12 s",
                unit: "W",
                value: $value,
                tolerance: $tolerance,
                reason: "5e-4 of the value, as in the source; of the body that sticks, rounding",
                found: work_rate,
            }],
        }
    };
}

/// Displacements of the tip of SDNL32 at one stiffness of the stop.
macro_rules! sdnl32 {
    ($stiffness:literal, $($at:literal: $value:literal),+) => {
        Entry {
            scene: SDNL32,
            changes: &[("wall.stop.stiffness", $stiffness)],
            method: "event",
            source: "SDNL32 of VPCS and code_aster (V5.02.032)",
            values: &[$(Expected {
                quantity: concat!("displacement of the tip at ", $at, " s"),
                unit: "m",
                value: $value,
                tolerance: 4e-5,
                reason: "1 % of the largest displacement: the source's values differ by that much from those of an \
                         independent program with 40 elements",
                found: |run| displacement(run, $at),
            }),+],
        }
    };
}

pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd101"),
        changes: &[],
        method: "event",
        source: "code_aster SDND101",
        values: &[
            Expected {
                quantity: "largest force of the stop",
                unit: "N",
                value: 9950.37,
                tolerance: 5e-3,
                reason: PRINTED,
                found: |run| contact(run, 0)?.peak_force,
            },
            Expected {
                quantity: "impulse of the stop",
                unit: "N s",
                value: -198.020,
                tolerance: 5e-4,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.impulse),
            },
            Expected {
                quantity: "end of the contact",
                unit: "s",
                value: 0.03126,
                tolerance: 5e-6,
                reason: PRINTED,
                found: |run| contact(run, 0)?.end,
            },
        ],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd101"),
        changes: &[],
        method: "moreau-jean",
        source: "code_aster SDND101",
        values: &[Expected {
            quantity: "largest force of the stop",
            unit: "N",
            value: 9950.37,
            tolerance: 1.0,
            reason: "1e-4 of the value: the step of 1e-5 s is a thousandth of the period against the stop",
            found: |run| contact(run, 0)?.peak_force,
        }],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd108a"),
        changes: &[],
        method: "event",
        source: "code_aster SDND108A",
        values: &[
            Expected {
                quantity: "begin of the contact",
                unit: "s",
                value: 0.540_312_423_74,
                tolerance: 1e-11,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.start),
            },
            Expected {
                quantity: "end of the contact",
                unit: "s",
                value: 0.885_456_153_07,
                tolerance: 1e-11,
                reason: PRINTED,
                found: |run| contact(run, 0)?.end,
            },
            Expected {
                quantity: "largest force of the floor",
                unit: "N",
                value: 74.80741,
                tolerance: 5e-6,
                reason: PRINTED,
                found: |run| contact(run, 0)?.peak_force,
            },
            Expected {
                quantity: "displacement at 1 s",
                unit: "m",
                value: -1.332_162_981_855,
                tolerance: 5e-13,
                reason: PRINTED,
                found: |run| displacement(run, 1.0),
            },
            Expected {
                quantity: "displacement at 1.1 s",
                unit: "m",
                value: -0.856_394_405_035,
                tolerance: 5e-13,
                reason: PRINTED,
                found: last_displacement,
            },
        ],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd100"),
        changes: &[],
        method: "moreau-jean",
        source: "code_aster SDND100 (V5.01.100)",
        values: &[
            Expected {
                quantity: "displacement where it stays",
                unit: "m",
                value: 5e-5,
                tolerance: 1e-8,
                reason: "2e-4 of the amplitude that friction takes in a half swing, by steps of 1e-5 s",
                found: last_displacement,
            },
            Expected {
                quantity: "work rate of wear over 0.15 s",
                unit: "W",
                value: 0.24,
                tolerance: 2.4e-4,
                reason: "1e-3 of the value",
                found: work_rate,
            },
        ],
    },
    sdnd104!(15.0, 15.2671, 7.6e-3),
    sdnd104!(1.5, 0.409062, 2e-4),
    sdnd104!(1.01, 2.26164e-4, 1.13e-7),
    sdnd104!(0.99, 0.0, 1e-12),
    sdnl32!(18000.0, 0.003: -4.92e-3, 0.006: -2.87e-3, 0.009: -3.41e-3, 0.012: -0.742e-3),
    sdnl32!(45000.0, 0.003: -1.96e-3, 0.006: -0.364e-3, 0.009: -1.89e-3, 0.012: 4.99e-3),
    Entry {
        scene: Scene::Own("sdnd125", include_str!("scenes/sdnd125.toml")),
        changes: &[],
        method: "event",
        source: "code_aster SDND125",
        values: &[Expected {
            quantity: "force of the left pair at 0.68044 s",
            unit: "N",
            value: 1_698.446_690_744_79,
            tolerance: 0.02,
            reason: "1e-5 of the value: the source has explicit steps of 1e-6 s",
            // The stop's law in the state at the end.
            found: |run| match run.state.q[..] {
                [left, middle, _] => Some(1e7 * (left - middle - 0.1).max(0.0)),
                _ => None,
            },
        }],
    },
    Entry {
        scene: Scene::BuiltIn("siconos-oscillator"),
        changes: &[],
        method: "event",
        source: "Siconos LinearOscillatorED",
        values: &[
            Expected {
                quantity: "instant of the first impact",
                unit: "s",
                value: 4.966_983_943_889e-3,
                tolerance: 5e-16,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.start),
            },
            Expected {
                quantity: "speed of the first impact",
                unit: "m/s",
                value: 316.258_786,
                tolerance: 5e-7,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.approach_speed),
            },
        ],
    },
    Entry {
        scene: Scene::Own("siconos-two-contacts", include_str!("scenes/siconos-two-contacts.toml")),
        changes: &[],
        method: "event",
        source: "Siconos BouncingBallED-TwoContacts, reference file",
        values: &[
            Expected {
                quantity: "displacement at 0.92 s",
                unit: "m",
                value: 0.816_863_194_677_513_1,
                tolerance: 1e-13,
                reason: "rounding of both programs over 4 impacts",
                found: |run| displacement(run, 0.92),
            },
            Expected {
                quantity: "displacement at 1.9 s",
                unit: "m",
                value: 0.264_829_028_234_805_4,
                tolerance: 1e-13,
                reason: "rounding of both programs over 7 impacts",
                found: |run| displacement(run, 1.9),
            },
            Expected {
                quantity: "displacement at 2.88 s",
                unit: "m",
                value: 0.451_845_064_179_520_6,
                tolerance: 1e-13,
                reason: "rounding of both programs",
                found: |run| displacement(run, 2.88),
            },
            Expected {
                quantity: "displacement at 4.8 s",
                unit: "m",
                value: 0.033_415_485_411_028_92,
                tolerance: 1e-12,
                reason: "rounding of both programs",
                found: |run| displacement(run, 4.8),
            },
        ],
    },
    Entry {
        scene: Scene::Own("siconos-friction-oscillator", include_str!("scenes/siconos-friction-oscillator.toml")),
        changes: &[],
        method: "moreau-jean",
        source: "Siconos FrictionOscillator; closed form 15 - √205",
        values: &[Expected {
            quantity: "displacement where it sticks",
            unit: "m",
            value: 0.682_178_936_724,
            tolerance: 2e-4,
            reason: "the rest is found to the order of the step, 1e-3 s; Siconos has 0.682044 with 1e-2 s",
            found: last_displacement,
        }],
    },
    Entry {
        scene: Scene::Own("siconos-bouncing-ball", include_str!("scenes/siconos-bouncing-ball.toml")),
        changes: &[],
        method: "moreau-jean",
        source: "Siconos BouncingBallTS, reference file: the same scheme",
        values: &[
            Expected {
                quantity: "displacement at 0.5 s",
                unit: "m",
                value: 0.174_488_499_999_999_1,
                tolerance: 1e-12,
                reason: "rounding of 100 steps",
                found: |run| displacement(run, 0.5),
            },
            Expected {
                quantity: "velocity at 1 s",
                unit: "m/s",
                value: -1.3734,
                tolerance: 1e-12,
                reason: "rounding of 200 steps",
                found: |run| velocity(run, 1.0),
            },
            Expected {
                quantity: "displacement at 2 s",
                unit: "m",
                value: 1.059_962_500_000_67e-3,
                tolerance: 1e-12,
                reason: "rounding of 400 steps",
                found: |run| displacement(run, 2.0),
            },
            Expected {
                quantity: "displacement at 5 s",
                unit: "m",
                value: 0.151_353_680_262_514,
                tolerance: 1e-12,
                reason: "rounding of 1000 steps",
                found: |run| displacement(run, 5.0),
            },
        ],
    },
    Entry {
        scene: Scene::Own("vm65", include_str!("scenes/vm65.toml")),
        changes: &[],
        method: "event",
        source: "ANSYS VM65, after Thomson 1965, example 4.6-1",
        values: &[
            Expected {
                quantity: "begin of the contact",
                unit: "s",
                value: 0.071_982,
                tolerance: 5e-7,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.start),
            },
            Expected {
                quantity: "speed of the impact",
                unit: "in/s",
                value: 27.785,
                tolerance: 5e-4,
                reason: PRINTED,
                found: |run| contact(run, 0).map(|contact| contact.approach_speed),
            },
            Expected {
                quantity: "largest penetration",
                unit: "in",
                value: -0.550_665_6,
                tolerance: 5e-8,
                reason: "the digits of the closed form that are printed here",
                found: last_displacement,
            },
        ],
    },
];
