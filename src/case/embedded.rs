//! The built-in case files.

use crate::error::{Result, named};

/// A case file, as text, with the tables it reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Embedded {
    /// Its name: the file name without `.toml`.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
    /// File name and text of each table that it reads.
    pub tables: &'static [(&'static str, &'static str)],
}

macro_rules! embed {
    ($($name:literal $([$($table:literal),+])?),+ $(,)?) => {
        &[$(Embedded {
            name: $name,
            text: include_str!(concat!("../../cases/", $name, ".toml")),
            tables: &[$($(($table, include_str!(concat!("../../cases/", $table)))),+)?],
        }),+]
    };
}

const ALL: &[Embedded] = embed![
    "linear-sine",
    "linear-impulse",
    "rigid-walls-sine",
    "penalty-epsilon",
    "independent-code",
    "rigid-walls-impulse",
    "elastic-wall",
    "bouncing-ball",
    "code-aster-sdnd101",
    "code-aster-sdnd108a",
    "siconos-oscillator",
    "tabulated-pulse"["tabulated-pulse.csv"],
    "two-masses",
    "bar-impact",
    "chain-20",
    "chain-200",
    "tube-loose-supports",
    "fuel-rod",
    "tube-lattice-bars",
    "base-pulse"["base-pulse.csv"],
    "tube-in-cross-flow",
    "two-tubes",
    "tube-round-supports",
    "whirl-in-a-hole",
    "code-aster-sdnd100",
    "dry-friction-damper",
];

impl Embedded {
    /// Every case: those of the source in the order of its figures, then those of other programs
    /// and of structures.
    #[must_use]
    pub fn all() -> &'static [Self] {
        ALL
    }

    /// The case of that name.
    ///
    /// # Errors
    /// [`Error::Unknown`](crate::Error::Unknown), listing the names that exist.
    pub fn named(name: &str) -> Result<&'static Self> {
        named("case", name, ALL.iter().map(|case| (case.name, case)))
    }

    /// Time (s) and displacement (m) of the first impacts, and of two states, of the case
    /// `independent-code`, from 50-digit arithmetic; `None` if the embedded table were malformed,
    /// which its test excludes.
    #[must_use]
    pub fn reference_points() -> Option<Vec<(f64, f64)>> {
        let lines = include_str!("../../cases/independent-code-reference.csv").lines().skip(1);
        let point = |line: &str| {
            let mut cells = line.split(',');
            Some((cells.next()?.parse().ok()?, cells.next()?.parse().ok()?))
        };
        lines.map(point).collect()
    }
}
