//! The arguments of `signorini sweep`.

use crate::case::{MOST_TABLE_BYTES, read_text};
use crate::cli::case_args::{Changes, case_file};
use crate::cli::pipeline::Destination;
use crate::cli::realisations::{of_argument, share};
use crate::cli::request::set_end;
use crate::cli::ui::Ui;
use crate::cli::values;
use crate::error::{Error, Result};
use crate::sweep::{
    Axis, Design, Follow, Kernel, MOST_SAMPLES, Measure, Random, Samples, Shard, Sweep, Values, Window,
};
use std::path::Path;

const EXAMPLES: &str = "\
Examples:
  signorini sweep bifurcation.toml
  signorini sweep rigid-walls-sine --vary load.1.harmonic.frequency=1:10:901 \\
      --measure contacts,displacement_max --keep 60 --settle 400
  signorini sweep rigid-walls-sine --vary 'wall.*.restitution=0.5,0.8,1' \\
      --vary time.step=1e-5:1e-3:9:log --measure force_rms
  signorini sweep rigid-walls-sine --vary load.1.harmonic.frequency=4:5:201 --follow both \\
      --scheme event --samples periods --keep 60 --settle 200
  signorini sweep rigid-walls-sine --set 'wall.*.restitution=0.8' \\
      --vary initial.displacement=-5e-3:5e-3:200 --vary initial.velocity=-0.4:0.4:200 \\
      --measure attractor,period --scheme event --settle 400 --keep 60
  signorini sweep tube.toml --vary system.damping.ratio=0.005:0.02 --random sobol \\
      --points 256 --measure impact_power
  signorini sweep tube-round-supports --vary 'support.*.gap=1e-4,2e-4,4e-4' --seeds 6 \\
      --measure work_rate          means over six realisations of the random loads
  signorini sweep tube-round-supports --vary 'support.*.gap=1e-4,2e-4,4e-4' \\
      --until-interval 5% --measure work_rate      as many of each row as that takes
  signorini sweep bifurcation.toml --plan          how many rows, how long, how many bytes
  signorini sweep bifurcation.toml --shard 3/128   one part of 128; `signorini merge` joins them

A sweep file is TOML with a key `case`; docs/sweep.md has its format, and all measures.
After an interruption at any instant, the same command continues, and ends with the same bytes.
Results: sweep.csv, one row per point, with the reason if it failed; samples.csv, the instants;
realisations.csv, with --seeds or --until-interval; effects.csv, with --one-at-a-time; shares.csv,
with --random; attractors.csv, of a basin; a picture; summary.json; report.html.";

/// Many runs of one case: curves, maps, bifurcation diagrams and random designs as one table
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Args {
    /// Sweep file; or case file, summary.json of a run, or the name of a built-in case, with --vary
    #[arg(value_hint = clap::ValueHint::FilePath)]
    file: String,
    #[command(flatten)]
    changes: Changes,
    /// Vary a value by its key: FROM:TO:POINTS, FROM:TO:POINTS:log, a list A,B,C, or FROM:TO with
    /// --random or --one-at-a-time; may be given several times
    #[arg(long, value_name = "KEY=VALUES")]
    vary: Vec<String>,
    /// Take the values of the first --vary in this direction, each row starting from the end of the
    /// last one: up, down, both
    #[arg(long, value_name = "WORD")]
    follow: Option<Follow>,
    /// Measures of every row, such as contacts, impulse, force_rms, impact_power, displacement_max,
    /// period, lyapunov, attractor
    #[arg(long, value_name = "A,B,…", value_delimiter = ',')]
    measure: Vec<Measure>,
    /// Keep instants of every row: periods (once a forcing period) or impacts
    #[arg(long, value_name = "WORD")]
    samples: Option<Samples>,
    /// Maximum number of instants of a row that are kept: the last ones [default: 200]
    #[arg(long, value_name = "N")]
    most_samples: Option<usize>,
    /// End of every row, s; a window for statistics that begins later begins at 0 then
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with = "keep")]
    end: Option<f64>,
    /// Forcing periods before the window of the measures
    #[arg(long, value_name = "N", requires = "keep")]
    settle: Option<u32>,
    /// Forcing periods in the window, in place of the case's end and statistics_from
    #[arg(long, value_name = "N")]
    keep: Option<u32>,
    /// Scheme [default: chosen from the case; see `signorini explain`]
    #[arg(long, value_name = "NAME", value_parser = values::schemes(), hide_possible_values = true)]
    scheme: Option<String>,
    /// How rows are computed: scalar, or batch (many oscillators at once, exactly) [default:
    /// scalar]
    #[arg(long, value_name = "WORD")]
    kernel: Option<Kernel>,
    /// Rows that are judged step by step, evenly spread; the others are marked unjudged [default:
    /// all; of --kernel batch 16, which the scheme event computes once more]
    #[arg(long, value_name = "N")]
    judged: Option<u64>,
    /// Run every row with N realisations of the case's random loads, the same in every row:
    /// sweep.csv has the means and the half widths of their 95 % intervals, realisations.csv each
    /// of them. Realisation k has the seeds of the case plus k - 1, as with `run --seeds`
    #[arg(long, value_name = "N", value_parser = values::whole, allow_negative_numbers = true)]
    seeds: Option<u64>,
    /// In place of --seeds: run every row under as many realisations as bring the 95 % intervals of
    /// its work rates (without work, of its mean forces) within this share of them, 5% or 0.05: six
    /// of each row say how many that takes (Stein)
    #[arg(long, value_name = "SHARE", conflicts_with = "seeds", allow_hyphen_values = true)]
    until_interval: Option<String>,
    /// Most realisations of a row with --until-interval; a row that needs more is partial [default:
    /// 200]
    #[arg(long, value_name = "N", requires = "until_interval")]
    most_seeds: Option<u64>,
    /// Vary each key by itself, from the case: --vary KEY=FROM:TO runs the case, then the case with
    /// that key at FROM and at TO; effects.csv and the picture sort the keys by what they change
    #[arg(long, conflicts_with_all = ["random", "follow"])]
    one_at_a_time: bool,
    /// Draw the values of all --vary at random: uniform, lhs (Latin hypercube), sobol; shares.csv
    /// has each key's share of the variance of each measure
    #[arg(long, value_name = "KIND", requires = "points")]
    random: Option<Design>,
    /// Points of the random design
    #[arg(long, value_name = "N", requires = "random")]
    points: Option<u64>,
    /// Seed of the random values; sobol without a seed is the plain sequence
    #[arg(long, value_name = "N", requires = "random")]
    seed: Option<u64>,
    /// Threads [default: all cores]
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..))]
    pub(super) threads: Option<u16>,
    /// Compute part I of N, in DIR/shard-I-of-N
    #[arg(long, value_name = "I/N")]
    pub(super) shard: Option<Shard>,
    /// Print the number of rows, and estimates of time and bytes; write nothing
    #[arg(long)]
    pub(super) plan: bool,
    /// Exit with code 1 if any row failed, not only if all did
    #[arg(long)]
    pub(super) strict: bool,
    #[command(flatten)]
    pub(super) place: Destination,
}

impl Args {
    /// The sweep that the arguments describe.
    pub(super) fn sweep(&self, ui: &Ui) -> Result<Sweep> {
        let path = Path::new(&self.file);
        let is_sweep = read_text(path, MOST_TABLE_BYTES).is_ok_and(|text| Sweep::is_file(&text));
        let mut sweep = if is_sweep { Sweep::read(path)? } else { Sweep::new(case_file(&self.file, ui)?) };
        for (key, value) in self.changes.pairs()? {
            sweep = sweep.set(&key, value)?;
        }
        for (index, text) in self.vary.iter().enumerate() {
            let axis = axis(text)?;
            sweep = sweep.vary(if index == 0 { axis.followed(self.follow.unwrap_or_default()) } else { axis });
        }
        if let (Some(_), true) = (self.follow, self.vary.is_empty()) {
            return Err(Error::invalid("--follow", "given", "a --vary beside it, the first of which is followed"));
        }
        if let (Some(design), Some(points)) = (self.random, self.points) {
            sweep = sweep.drawn(Random { design, points, seed: self.seed });
        }
        if self.one_at_a_time {
            sweep = sweep.one_at_a_time();
        }
        if let Some(keep) = self.keep {
            sweep = sweep.over(Window::Periods { settle: self.settle.unwrap_or(0), keep });
        }
        if let Some(end) = self.end {
            if !sweep.ends_with_case() {
                let expected =
                    "a sweep whose rows end with the case; the settle and keep of this one say when they end";
                return Err(Error::invalid("--end", end, expected));
            }
            set_end(sweep.case_file(), end, ui)?;
        }
        if let Some(kernel) = self.kernel {
            sweep = sweep.kernel(kernel);
        }
        if let Some(judged) = self.judged {
            sweep = sweep.judged(judged);
        }
        if let Some(count) = self.seeds {
            sweep = sweep.realisations(count);
        }
        if let Some(text) = &self.until_interval {
            let share = share("--until-interval", text)?;
            sweep = sweep.until_interval(share, self.most_seeds).map_err(of_argument)?;
        }
        if let Some(scheme) = &self.scheme {
            sweep = sweep.by(scheme);
        }
        sweep = sweep.measure(self.measure.iter().copied());
        if let Some(samples) = self.samples {
            sweep = sweep.sample(samples, self.most_samples.unwrap_or(MOST_SAMPLES));
        }
        Ok(sweep)
    }
}

/// The axis of an argument of `--vary`.
fn axis(text: &str) -> Result<Axis> {
    let wrong = || {
        let expected = "KEY=FROM:TO:POINTS, KEY=FROM:TO:POINTS:log, KEY=A,B,C, or KEY=FROM:TO with --random or \
                        --one-at-a-time";
        Error::invalid("--vary", format_args!("{text:?}"), expected)
    };
    let (key, values) = text.split_once('=').ok_or_else(wrong)?;
    let parts: Vec<&str> = values.split(':').map(str::trim).collect();
    let number = |text: &str| text.parse::<f64>().map_err(|_| wrong());
    let points = |text: &str| text.parse::<u64>().map_err(|_| wrong());
    let values = match parts.as_slice() {
        [from, to] if number(from).is_ok() => Values::Range { from: number(from)?, to: number(to)?, log: false },
        [from, to, "log"] => Values::Range { from: number(from)?, to: number(to)?, log: true },
        [from, to, count] if number(from).is_ok() => {
            Values::Linear { from: number(from)?, to: number(to)?, points: points(count)? }
        }
        [from, to, count, "log"] => Values::Log { from: number(from)?, to: number(to)?, points: points(count)? },
        // Words may have colons: penalty:epsilon=1e-9.
        _ => Values::List(values.split(',').map(str::parse).collect::<Result<_>>()?),
    };
    Axis::new(key.trim(), values)
}
