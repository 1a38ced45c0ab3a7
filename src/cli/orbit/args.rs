//! The arguments of `signorini orbit`.

use crate::case::Case;
use crate::cli::case_args::CaseArgs;
use crate::cli::pipeline::Destination;
use crate::cli::values;
use crate::error::{Error, Result, counted};
use crate::orbit::{Orbit, Problem, SETTLE, Signature};
use crate::output::periodic::read;
use crate::output::request::{extended, request};
use crate::output::results::Results;
use serde_json::json;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' --settle 400
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' --list
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --signature U --symmetric --start 0.743,0.033
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --from out/rigid-walls-sine/orbit/orbit.json
  signorini orbit rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --derivative load.1.harmonic.frequency,wall.upper.restitution
      what 1 % more of each changes

A signature is a list of walls, one for each impact, by name (upper,lower) or, where no two names
begin alike, by letter (UL); other events are written upper:rest, upper:release, pad:enter,
pad:leave. --start has the phase of each event in cycles of the forcing period and its speed in
m/s. With --symmetric both mean the first half of an orbit that is its own mirror image.
Writes orbit.json (which --from and `signorini continue` read), orbit.csv (the motion),
contacts.csv, pictures of phase plane and time, and report.html, which shows them all. Of a
structure the orbit on which its run settles, or one near that of --from, is found by shooting,
and orbit.json and report.html are written. docs/orbits.md has the method.";

/// A periodic orbit: from a run that settles, a signature or a file; multipliers, forces, check
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) case: CaseArgs,
    /// Forcing periods that are run before the motion is checked for repetition
    #[arg(long, value_name = "N", default_value_t = SETTLE)]
    pub(super) settle: u32,
    /// List all orbits of one impact per period of the orbit (or one on each of two mirrored walls)
    /// up to 8 forcing periods, from closed forms; for any number of degrees of freedom
    #[arg(long, conflicts_with_all = ["signature", "from", "settle"])]
    pub(super) list: bool,
    /// Events of the orbit, such as UL or upper,lower
    #[arg(long, value_name = "EVENTS", requires = "start", conflicts_with_all = ["from", "settle"])]
    pub(super) signature: Option<String>,
    /// Phase (cycles) and speed (m/s) of each event of --signature
    #[arg(long, value_name = "θ,v,…", value_delimiter = ',', value_parser = values::number, requires = "signature")]
    #[arg(allow_hyphen_values = true)]
    pub(super) start: Vec<f64>,
    /// Forcing periods of the orbit of --signature
    #[arg(long, value_name = "N", default_value_t = 1, requires = "signature")]
    pub(super) periods: u32,
    /// --signature is the first half of an orbit that is its own mirror image
    #[arg(long, requires = "signature")]
    pub(super) symmetric: bool,
    /// Start from an orbit that was written before, of this case or one near it
    #[arg(long, value_name = "FILE", conflicts_with = "settle", value_hint = clap::ValueHint::FilePath)]
    pub(super) from: Option<PathBuf>,
    /// Derivatives of the orbit by these keys of the case: of phases and speeds, of a structure
    /// also of impulses, in derivatives.csv, of multipliers in multipliers.csv, and a table of what
    /// 1 % more of each changes
    #[arg(long, value_name = "KEY,...", value_delimiter = ',', conflicts_with = "list")]
    pub(super) derivative: Vec<String>,
    #[command(flatten)]
    pub(super) place: Destination,
}

impl Args {
    /// Opens the folder of the results.
    pub(super) fn open(&self, case: &Case) -> Result<Results> {
        let settings = json!({
            "settle": self.settle,
            "signature": self.signature,
            "start": self.start,
            "periods": self.periods,
            "symmetric": self.symmetric,
            "from": self.from,
            "derivative": self.derivative,
        });
        let mut results = self.place.open(case, "orbit", extended(request("orbit", case, &[]), settings))?;
        results.add_to_manifest("case_file", case.document.json()?);
        Ok(results)
    }

    /// The orbit from which Newton's method starts; `None` where a run is to settle.
    pub(super) fn start_orbit(&self, problem: &Problem) -> Result<Option<Orbit>> {
        if let Some(path) = &self.from {
            return read(path, problem.scene()).map(Some);
        }
        let Some(text) = &self.signature else { return Ok(None) };
        let mut signature = Signature::parse(text, self.periods, problem.scene())?;
        signature.symmetric = self.symmetric;
        signature.check(problem.scene())?;
        let count = signature.events.len();
        if self.start.len() != 2 * count {
            let expected = format!("{}: phase and speed of each of {}", 2 * count, counted(count, "event"));
            return Err(Error::invalid("--start", counted(self.start.len(), "number"), expected));
        }
        let pick = |offset: usize| self.start.iter().skip(offset).step_by(2).copied().collect();
        let forcing_period = problem.forcing_period();
        Ok(Some(Orbit { signature, phases: pick(0), speeds: pick(1), forcing_period }))
    }
}
