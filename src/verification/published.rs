//! Values of other programs and of benchmarks.

use super::entry::{Entry, Scene, value};
use super::quantity::{contact, displacement, last_displacement, rms_force, velocity, work_rate};

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
            values: &[value(
                "work rate of wear, 4 to 12 s",
                "W",
                $value,
                $tolerance,
                "5e-4 of the value, as in the source; of the body that sticks, rounding",
                work_rate,
            )],
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
            values: &[$(value(concat!("displacement of the tip at ", $at, " s"), "m", $value, 4e-5,
                "1 % of the largest displacement: the source's values differ by that much from those of an \
                independent program with 40 elements", |run| displacement(run, $at))),+],
        }
    };
}

#[rustfmt::skip]
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd101"),
        changes: &[],
        method: "event",
        source: "code_aster SDND101",
        values: &[
            value("largest force of the stop", "N", 9950.37, 5e-3, PRINTED,
                |run| contact(run, 0)?.peak_force),
            value("impulse of the stop", "N s", -198.020, 5e-4, PRINTED,
                |run| contact(run, 0).map(|contact| contact.impulse)),
            value("end of the contact", "s", 0.03126, 5e-6, PRINTED, |run| contact(run, 0)?.end),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd101"),
        changes: &[],
        method: "moreau-jean",
        source: "code_aster SDND101",
        values: &[value("largest force of the stop", "N", 9950.37, 1.0,
            "1e-4 of the value: the step of 1e-5 s is a thousandth of the period against the stop",
            |run| contact(run, 0)?.peak_force)],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd108a"),
        changes: &[],
        method: "event",
        source: "code_aster SDND108A",
        values: &[
            value("begin of the contact", "s", 0.540_312_423_74, 1e-11, PRINTED,
                |run| contact(run, 0).map(|contact| contact.start)),
            value("end of the contact", "s", 0.885_456_153_07, 1e-11, PRINTED,
                |run| contact(run, 0)?.end),
            value("largest force of the floor", "N", 74.80741, 5e-6, PRINTED,
                |run| contact(run, 0)?.peak_force),
            value("displacement at 1 s", "m", -1.332_162_981_855, 5e-13, PRINTED,
                |run| displacement(run, 1.0)),
            value("displacement at 1.1 s", "m", -0.856_394_405_035, 5e-13, PRINTED,
                last_displacement),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("code-aster-sdnd100"),
        changes: &[],
        method: "moreau-jean",
        source: "code_aster SDND100 (V5.01.100)",
        values: &[
            value("displacement where it stays", "m", 5e-5, 1e-8,
                "2e-4 of the amplitude that friction takes in a half swing, by steps of 1e-5 s",
                last_displacement),
            value("work rate of wear over 0.15 s", "W", 0.24, 2.4e-4, "1e-3 of the value",
                work_rate),
        ],
    },
    sdnd104!(15.0, 15.2671, 7.6e-3),
    sdnd104!(1.5, 0.409062, 2e-4),
    sdnd104!(1.01, 2.26164e-4, 1.13e-7),
    sdnd104!(0.99, 0.0, 1e-12),
    sdnl32!(18000.0, 0.003: -4.92e-3, 0.006: -2.87e-3, 0.009: -3.41e-3, 0.012: -0.742e-3),
    sdnl32!(45000.0, 0.003: -1.96e-3, 0.006: -0.364e-3, 0.009: -1.89e-3, 0.012: 4.99e-3),
    Entry {
        scene: Scene::Own("sdnl301", include_str!("scenes/sdnl301.toml")),
        changes: &[],
        method: "moreau-jean",
        source: "code_aster SDNL301 (V5.02.301)",
        values: &[value("RMS force of the support at the free end", "N", 23.983_313_777_2, 0.555,
            "by which the source's own two bases differ, 30 modes and 30 with static ones",
            |run| rms_force(run, "support-4"))],
    },
    Entry {
        scene: Scene::Own("sdnd125", include_str!("scenes/sdnd125.toml")),
        changes: &[],
        method: "event",
        source: "code_aster SDND125",
        values: &[value("force of the left pair at 0.68044 s", "N", 1_698.446_690_744_79, 0.02,
            "1e-5 of the value: the source has explicit steps of 1e-6 s",
            // The stop's law in the state at the end.
            |run| match run.state.q[..] {
                [left, middle, _] => Some(1e7 * (left - middle - 0.1).max(0.0)),
                _ => None,
            })],
    },
    Entry {
        scene: Scene::BuiltIn("siconos-oscillator"),
        changes: &[],
        method: "event",
        source: "Siconos LinearOscillatorED",
        values: &[
            value("instant of the first impact", "s", 4.966_983_943_889e-3, 5e-16, PRINTED,
                |run| contact(run, 0).map(|contact| contact.start)),
            value("speed of the first impact", "m/s", 316.258_786, 5e-7, PRINTED,
                |run| contact(run, 0).map(|contact| contact.approach_speed)),
        ],
    },
    Entry {
        scene: Scene::Own("siconos-two-contacts", include_str!("scenes/siconos-two-contacts.toml")),
        changes: &[],
        method: "event",
        source: "Siconos BouncingBallED-TwoContacts, reference file",
        values: &[
            value("displacement at 0.92 s", "m", 0.816_863_194_677_513_1, 1e-13,
                "rounding of both programs over 4 impacts", |run| displacement(run, 0.92)),
            value("displacement at 1.9 s", "m", 0.264_829_028_234_805_4, 1e-13,
                "rounding of both programs over 7 impacts", |run| displacement(run, 1.9)),
            value("displacement at 2.88 s", "m", 0.451_845_064_179_520_6, 1e-13,
                "rounding of both programs", |run| displacement(run, 2.88)),
            value("displacement at 4.8 s", "m", 0.033_415_485_411_028_92, 1e-12,
                "rounding of both programs", |run| displacement(run, 4.8)),
        ],
    },
    Entry {
        scene: Scene::Own("siconos-friction-oscillator", include_str!("scenes/siconos-friction-oscillator.toml")),
        changes: &[],
        method: "moreau-jean",
        source: "Siconos FrictionOscillator; closed form 15 - √205",
        values: &[value("displacement where it sticks", "m", 0.682_178_936_724, 2e-4,
            "the rest is found to the order of the step, 1e-3 s; Siconos has 0.682044 with 1e-2 s",
            last_displacement)],
    },
    Entry {
        scene: Scene::Own("siconos-bouncing-ball", include_str!("scenes/siconos-bouncing-ball.toml")),
        changes: &[],
        method: "moreau-jean",
        source: "Siconos BouncingBallTS, reference file: the same scheme",
        values: &[
            value("displacement at 0.5 s", "m", 0.174_488_499_999_999_1, 1e-12,
                "rounding of 100 steps", |run| displacement(run, 0.5)),
            value("velocity at 1 s", "m/s", -1.3734, 1e-12, "rounding of 200 steps",
                |run| velocity(run, 1.0)),
            value("displacement at 2 s", "m", 1.059_962_500_000_67e-3, 1e-12,
                "rounding of 400 steps", |run| displacement(run, 2.0)),
            value("displacement at 5 s", "m", 0.151_353_680_262_514, 1e-12,
                "rounding of 1000 steps", |run| displacement(run, 5.0)),
        ],
    },
    Entry {
        scene: Scene::Own("vm65", include_str!("scenes/vm65.toml")),
        changes: &[],
        method: "event",
        source: "ANSYS VM65, after Thomson 1965, example 4.6-1",
        values: &[
            value("begin of the contact", "s", 0.071_982, 5e-7, PRINTED,
                |run| contact(run, 0).map(|contact| contact.start)),
            value("speed of the impact", "in/s", 27.785, 5e-4, PRINTED,
                |run| contact(run, 0).map(|contact| contact.approach_speed)),
            value("largest penetration", "in", -0.550_665_6, 5e-8,
                "the digits of the closed form that are printed here", last_displacement),
        ],
    },
];
