//! The arguments of `signorini continue`.

use crate::cli::case_args::CaseArgs;
use crate::cli::pipeline::Destination;
use crate::cli::ui::Ui;
use crate::error::{Error, Result};
use crate::orbit::SETTLE;
use crate::orbit::branch::{Label, Switch};
use crate::output::branch_folder::BranchSettings;
use crate::output::scene_family::SceneFamily;
use crate::output::varied::KeyRange;
use clap::builder::PossibleValuesParser;
use serde_json::{Value, json};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  signorini continue rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --set load.1.harmonic.frequency=5 --key load.1.harmonic.frequency --range 1:16
  signorini continue rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --key 'wall.*.restitution' --range 0.3:1 --switch all
  signorini continue bouncing-ball.toml --key load.2.harmonic.amplitude --range 1:30 \\
      --from out/bouncing-ball/orbit/orbit.json
  signorini continue rigid-walls-sine … --second 'wall.*.restitution' \\
      --second-range 0.3:0.95 --locus fold,symmetry-breaking
  signorini continue rigid-walls-sine … --over out/rigid-walls-sine/sweep
      a sweep's points beneath the branches; so can be the branches of another case

The branch starts from the orbit of --from, or from the one on which the case settles, at the
case's value of the key. Writes branches.csv (every orbit), special.csv (folds, period doublings,
broken symmetries, grazings, rests), branches.json, a picture (stable orbits solid, unstable ones
dashed), and report.html, in which a click on an orbit shows it, drawn from orbits.csv. With
--second also loci.csv and a picture: where the special points of the branches move in the plane
of two keys. Of a structure the motion is drawn at the place of the wall that most orbits meet; a
change of the walls that an orbit meets ends a branch, and the next one begins there.
docs/orbits.md has the method and the labels.";

/// Branches of periodic orbits over a key: special points located, other branches found
#[derive(Debug, clap::Args)]
#[command(name = "continue", after_help = EXAMPLES)]
pub struct Args {
    #[command(flatten)]
    pub(super) case: CaseArgs,
    /// The key whose value changes along the branches, such as load.1.harmonic.frequency
    #[arg(long, value_name = "KEY")]
    pub(super) key: String,
    /// The range of its values
    #[arg(long, value_name = "A:B", allow_hyphen_values = true)]
    pub(super) range: String,
    /// Start from an orbit that `signorini orbit` has written
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    pub(super) from: Option<PathBuf>,
    /// Forcing periods that are run before the motion is checked for repetition
    #[arg(long, value_name = "N", default_value_t = SETTLE, conflicts_with = "from")]
    pub(super) settle: u32,
    /// Which branches that begin at special points are followed: no, stable (beside stable orbits),
    /// all
    #[arg(long, value_name = "WORD", default_value = "stable")]
    #[arg(value_parser = PossibleValuesParser::new(Switch::ALL.map(Switch::name)), hide_possible_values = true)]
    pub(super) switch: String,
    /// Maximum number of switches between the first branch and any other
    #[arg(long, value_name = "N", default_value_t = 4)]
    pub(super) depth: u32,
    /// Most points of a branch in each direction from where it begins
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(2..))]
    pub(super) points: u32,
    /// Draw the impacts of other results beneath the branches: the folder of a sweep or of branches
    /// over the same key, of a run, an orbit or a comparison; or a sweep.csv
    #[arg(long, value_name = "RESULTS", value_hint = clap::ValueHint::AnyPath)]
    pub(super) over: Option<PathBuf>,
    /// Follow special points in the plane of --key and this key
    #[arg(long, value_name = "KEY", requires = "second_range")]
    pub(super) second: Option<String>,
    /// The range of the values of --second
    #[arg(long, value_name = "A:B", requires = "second", allow_hyphen_values = true)]
    pub(super) second_range: Option<String>,
    /// Which special points: fold, period-doubling, symmetry-breaking, grazing-in, grazing-out
    /// [default: all of them]
    #[arg(long, value_name = "A,B,…", value_delimiter = ',', requires = "second", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(Label::WITH_LOCUS.map(Label::name)))]
    pub(super) locus: Vec<String>,
    #[command(flatten)]
    pub(super) place: Destination,
}

impl Args {
    /// The scenes over which the branches are followed.
    pub(super) fn family(&self, ui: &Ui) -> Result<SceneFamily> {
        let file = self.case.file(ui)?;
        let key = KeyRange { names: ["--key", "--range"], key: &self.key, range: limits("--range", &self.range)? };
        let names = ["--second", "--second-range"];
        let second = match (&self.second, &self.second_range) {
            (Some(key), Some(range)) => Some(KeyRange { names, key, range: limits(names[1], range)? }),
            _ => None,
        };
        SceneFamily::new(file, &key, second.as_ref())
    }

    /// What decides on the results beside the case.
    pub(super) fn settings(&self) -> Value {
        json!(BranchSettings {
            key: &self.key,
            range: &self.range,
            from: self.from.as_deref(),
            settle: self.settle,
            switch: &self.switch,
            depth: self.depth,
            points: self.points,
            over: self.over.as_deref(),
            second: self.second.as_deref(),
            second_range: self.second_range.as_deref(),
            locus: &self.locus,
        })
    }
}

/// The two ends of the range that an option gives.
fn limits(option: &'static str, text: &str) -> Result<[f64; 2]> {
    let wrong = || Error::invalid(option, format_args!("{text:?}"), "A:B, two numbers, the first below the second");
    let (low, high) = text.split_once(':').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite()).ok_or_else(wrong);
    let (low, high) = (number(low)?, number(high)?);
    if low < high { Ok([low, high]) } else { Err(wrong()) }
}
