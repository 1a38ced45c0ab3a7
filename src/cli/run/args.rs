//! The arguments of `signorini run`.

use super::derivative::DerivativeKeys;
use super::seeds::Seeds;
use crate::case::Case;
use crate::cli::drawing::PlotSpan;
use crate::cli::realisations::share;
use crate::cli::request::Request;
use crate::cli::values;
use crate::error::{Error, Result};
use crate::output::results::Results;
use crate::output::run_folder::{RunGoal, RunRequest};
use crate::scheme::Method;
use serde_json::json;

const EXAMPLES: &str = "\
Examples:
  signorini run cases/rigid-walls-sine.toml
  signorini run rigid-walls-sine --restitution 0.8 --step 1e-5
  signorini run rigid-walls-sine --scheme penalty --epsilon 1e-9 --integrator trapezoidal
  signorini run elastic-wall --scheme event --out results
  signorini run elastic-wall --end 4 --accuracy 1e-6
  signorini run rigid-walls-sine --restitution 0.8 --scheme moreau-jean --accuracy 1e-3
  signorini run tube-loose-supports --modes 40
  signorini run rigid-walls-sine --from 4 --to 6   pictures of these two seconds
  signorini run tube-lattice-bars --seeds 6        means over six realisations of the random loads
  signorini run elastic-wall --derivative wall.upper.stiffness,load.1.harmonic.amplitude
  signorini run tube-in-cross-flow --until-interval 5%   as many as that takes
  signorini run tube-lattice-bars --accuracy 20%   step and seeds for means within 20 %
  signorini run rigid-walls-sine --end 20 --accuracy 10%   chaos: means, over starts that scatter
  signorini run rigid-walls-sine --end 20 --accuracy 1e-3 --of motion   its first seconds

Schemes: implicit-euler, paoli-schatzman, moreau-jean, located, generalized-alpha, newmark (for
demonstration), penalty, event (exact).";

/// What an accuracy is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Of {
    /// One motion: its displacement, and impulse and statistics of each wall; of a chaotic motion
    /// up to where rounding grows to the error
    Motion,
    /// Work rates, mean and RMS forces over realisations. Where nothing is random the velocities of
    /// the start scatter for it, by 1e-4 of the gap in a forcing period (initial.scatter)
    Means,
}

/// Run one case by one scheme: trajectory, contacts, summary and figures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) request: Request,
    /// Scheme [default: chosen from the scene; see `signorini explain`]
    #[arg(long, value_name = "NAME", value_parser = values::schemes(), hide_possible_values = true)]
    pub(super) scheme: Option<String>,
    /// Find scheme and step for this error, 1e-3 or 0.1%. Of a motion it is a share of the gap
    /// (without one, of the largest displacement) and, for the impulse, contacts, impact energy,
    /// peak force at springs of each wall, of the largest of all walls (at least of an impact at a
    /// hundredth of the body's speed), and for the contact time of the window; RMS and largest
    /// forces at rigid walls are not judged; for a case reduced to modes, the number of
    /// modes is found too; exit code 1 if it is not kept to the end. Of means it is a share of the
    /// work rates, mean and RMS forces over realisations: the coarsest step whose part in their
    /// errors is within it is found, and as many seeds as its interval and theirs take; exit code 1
    /// where no step or no number of seeds keeps it
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    accuracy: Option<String>,
    /// What --accuracy is an error of [default: of means where a load or the start is random, and
    /// where no step predicts the motion to its end (chaos); else of the motion]
    #[arg(long, value_name = "WHAT", requires = "accuracy")]
    pub(super) of: Option<Of>,
    /// Do not repeat the run with half the step, nor, for a case reduced to modes, with more modes;
    /// of several realisations up to six are repeated so
    #[arg(long)]
    pub(super) no_verdict: bool,
    #[command(flatten)]
    pub(super) seeds: Seeds,
    #[command(flatten)]
    pub(super) derivatives: DerivativeKeys,
    #[command(flatten)]
    pub(super) span: PlotSpan,
}

impl Args {
    /// The error asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a text that is no number, and beside a step.
    pub(super) fn accuracy(&self) -> Result<Option<f64>> {
        let Some(text) = &self.accuracy else { return Ok(None) };
        if let Some(step) = self.request.step {
            return Err(Error::invalid("--step", step, "no step beside --accuracy, which finds one"));
        }
        share("--accuracy", text).map(Some)
    }

    /// The method asked for or chosen, with the reason.
    pub(super) fn chosen(&self, case: &Case) -> Result<(Method, String)> {
        match self.derivatives.scheme().filter(|_| self.scheme.is_none()) {
            Some(exact) => {
                let (method, _) = self.request.chosen(Some(&exact), case)?;
                Ok((method, "derivatives are those of the exact motion".into()))
            }
            None => self.request.chosen(self.scheme.as_deref(), case),
        }
    }

    /// Opens the folder of the results of `case` by `method`, or by one that the `goal` chooses.
    pub(super) fn open(&self, case: &Case, method: Option<&Method>, goal: RunGoal) -> Result<Results> {
        let several = self.seeds.count.is_some() || self.seeds.until_interval.is_some();
        let count = if several { self.seeds.check(case)? } else { None };
        let mut asked = RunRequest { case, method, goal, count }.recorded();
        if let Some(keys) = self.derivatives.asked() {
            asked.insert("derivative".to_owned(), json!(keys));
        }
        self.request.place.open(case, "run", asked)
    }
}
