//! Instants of a row: which are kept, and their columns.

use crate::error::names;
use crate::scene::Scene;

/// One instant of a row.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Sample {
    /// A contact episode, when it begins.
    Impact {
        /// Name of the wall.
        wall: String,
        /// Time at which it began, s after the start of the row.
        start: f64,
        /// The same as a fraction of the forcing period; `None` without a forcing period.
        phase: Option<f64>,
        /// Speed towards the wall, m/s.
        approach: f64,
        /// Speed away from it, m/s; `None` for an episode that has not ended.
        departure: Option<f64>,
        /// Impulse on the body, N s, signed.
        impulse: f64,
    },
    /// The state of the probes at the end of a forcing period.
    Strobe {
        /// Time after the start of the row, s.
        time: f64,
        /// Displacement (m) and velocity (m/s) of each probe.
        seen: Vec<[f64; 2]>,
    },
}

/// The instants of a row that are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Samples {
    /// The probes once per forcing period: a Poincaré section.
    Periods,
    /// Every contact episode that began in the window.
    Impacts,
}

names!(Samples: "kind of samples", Periods => "periods", Impacts => "impacts");

impl Samples {
    /// Columns after the row's number.
    #[must_use]
    pub fn columns(self, scene: &Scene) -> Vec<String> {
        match self {
            Self::Impacts => {
                ["wall", "start_s", "phase_cycles", "approach_speed_m_per_s", "departure_speed_m_per_s", "impulse_N_s"]
                    .map(str::to_owned)
                    .to_vec()
            }
            Self::Periods => {
                let probes: Vec<&str> = scene.probes.iter().map(|probe| probe.name.as_str()).collect();
                let of = |word: &String| if word.is_empty() { String::new() } else { format!("_{word}") };
                let both =
                    |word: &String| [format!("displacement{}_m", of(word)), format!("velocity{}_m_per_s", of(word))];
                std::iter::once("time_s".to_owned())
                    .chain(crate::output::csv::words(&probes).iter().flat_map(both))
                    .collect()
            }
        }
    }
}
