//! Values that follow from a formula.

use super::entry::{Entry, Scene, value};
use super::quantity::{contact, displacement, last_force, velocity, work_rate};

const ROUNDING: &str = "rounding of exact motion";

#[rustfmt::skip]
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        scene: Scene::BuiltIn("independent-code"),
        changes: &[],
        method: "event",
        source: "impacts in 50-digit arithmetic",
        values: &[
            value("displacement at 1 s", "m", -0.004_273_265_748_152_696, 1e-15, ROUNDING,
                |run| displacement(run, 1.0)),
            value("velocity at 1 s", "m/s", 0.158_226_412_859_116_45, 1e-13, ROUNDING,
                |run| velocity(run, 1.0)),
            value("displacement at 2 s", "m", 0.004_819_844_401_208_915, 1e-14,
                "rounding, which the impacts have made grow tenfold", |run| displacement(run, 2.0)),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("linear-impulse"),
        changes: &[],
        method: "event",
        source: "I/(m w) exp(-s t) sin(w t), I = 0.1 N s, s = 0.1 1/s, w = √(100 - s²) rad/s",
        values: &[
            value("displacement at 1 s", "m", -0.004_918_955_700_602_812, 1e-16, ROUNDING,
                |run| displacement(run, 1.0)),
            value("displacement at 2 s", "m", 0.007_471_592_201_641_207, 1e-16, ROUNDING,
                |run| displacement(run, 2.0)),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("linear-impulse"),
        changes: &[],
        method: "generalized-alpha",
        source: "I/(m w) exp(-s t) sin(w t), as by the exact scheme",
        values: &[value("displacement at 2 s", "m", 0.007_471_592_201_641_207, 1e-7,
            "order 2: (w h)²/12 of the phase w t = 20 rad at h = 1e-4 s, 1.7e-6 of 1e-2 m, with a margin",
            |run| displacement(run, 2.0))],
    },
    Entry {
        scene: Scene::BuiltIn("bouncing-ball"),
        changes: &[],
        method: "event",
        source: "rest after √(2 h/g) (1 + e)/(1 - e)",
        values: &[
            value("begin of the rest", "s", 8.578_949_178_728_887, 5e-5,
                "the last contact begins with the last impact that is followed one by one, 1e-5 s before",
                |run| run.trajectory.contacts().last().map(|contact| contact.start)),
            value("force on the floor at rest", "N", 9.81, 1e-10,
                "rounding of 98 N s over a row of 1 ms", last_force),
            value("momentum given to the floor", "N s", 98.1, 1e-11, "rounding of 130 impacts",
                |run| run.trajectory.impulse("floor").ok()),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("bouncing-ball"),
        changes: &[],
        method: "moreau-jean",
        source: "weight times duration, less the momentum at the start",
        values: &[
            value("momentum given to the floor", "N s", 98.1, 1e-9,
                "rounding of 1e5 steps: at rest the momentum is 0",
                |run| run.trajectory.impulse("floor").ok()),
            value("force on the floor at rest", "N", 9.81, 1e-9, "rounding over the step of 1e-4 s",
                last_force),
        ],
    },
    Entry {
        scene: Scene::Own("plastic-impact", include_str!("scenes/plastic-impact.toml")),
        changes: &[],
        method: "event",
        source: "the load's sine, and the linear oscillator's motion up to the wall in 40 digits",
        values: &[
            value("instant of the impact", "s", 0.076_102_054_389_197_13, 1e-15, ROUNDING,
                |run| contact(run, 0).map(|contact| contact.start)),
            value("speed of the impact", "m/s", 0.153_672_254_837_670_87, 1e-14, ROUNDING,
                |run| contact(run, 0).map(|contact| contact.approach_speed)),
            value("largest force of the rest", "N", 1.546_619_263_279_352_7, 1e-12, ROUNDING,
                |run| contact(run, 0)?.peak_force),
            value("end of the rest", "s", 0.094_669_962_096_188_63, 1e-15, ROUNDING,
                |run| contact(run, 0)?.end),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("base-pulse"),
        changes: &[],
        method: "event",
        source: "piecewise cubic and harmonic motion up to the stop",
        values: &[
            value("instant of the first impact", "s", 0.117_409_802_814_049_07, 1e-15, ROUNDING,
                |run| contact(run, 0).map(|contact| contact.start)),
            value("speed of the first impact", "m/s", 0.233_356_480_391_353_75, 1e-14, ROUNDING,
                |run| contact(run, 0).map(|contact| contact.approach_speed)),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("whirl-in-a-hole"),
        changes: &[],
        method: "moreau-jean",
        source: "balance of forces in the turning frame",
        values: &[
            value("mean force in the hole", "N", 7.064_267_168_051_028, 7e-6,
                "midpoint rule on the circle: (W h)²/12 = 8e-7 of the centripetal force",
                |run| run.statistics.supports.first()?.force.as_ref().map(|force| force.mean_n)),
            value("work rate of wear", "W", 1.109_652_491_907, 1e-6, "midpoint rule on the circle",
                work_rate),
            value("power of friction", "W", 0.221_930_498_381, 2e-7, "midpoint rule on the circle",
                |run| run.statistics.wear.first().map(|wear| wear.friction_power_w)),
        ],
    },
    Entry {
        scene: Scene::BuiltIn("bar-impact"),
        changes: &[],
        method: "moreau-jean",
        source: "piecewise linear waves: force ½ N for 1 s in each period of 3 s",
        values: &[value("impulse of two impacts", "N s", 1.0, 2.5e-2,
            "the mesh of 100 elements, whose last mass strikes; 400 elements are off by 0.6 %",
            |run| run.trajectory.impulse("wall").ok())],
    },
];
