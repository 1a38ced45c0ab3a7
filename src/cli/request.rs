//! The case of a command, and the changes by the command line.

use super::drawing::Formats;
use super::report::{command_line, quoted};
use super::ui::Ui;
use super::values;
use crate::case::{Case, CaseFile, Embedded, KeyValue};
use crate::error::{Error, Result};
use crate::output::results::Results;
use crate::qp::Backend;
use crate::scene::{Shape, System, WallLaw};
use crate::scheme::{Integrator, Method, PenaltyLaw, Scheme};
use serde_json::{Map, Value, json};
use std::path::{Path, PathBuf};

/// Arguments common to `run` and `compare`.
#[derive(Debug, Clone, clap::Args)]
pub struct Request {
    /// Case file, summary.json of a run, or the name of a built-in case; a file is taken before a
    /// built-in case
    #[arg(value_hint = clap::ValueHint::FilePath)]
    pub case: String,
    /// Changes of the case by its keys
    #[command(flatten)]
    pub changes: Changes,
    /// Step of the stepping schemes, s
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// End of the run, s; a window for statistics that begins later begins at 0 then
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub end: Option<f64>,
    /// Spacing of the recorded rows, s
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub sample: Option<f64>,
    /// Stretch over which forces of rigid walls are averaged before their RMS is taken, s [default:
    /// the case's, or 1e-3]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub force_averaging: Option<f64>,
    /// Restitution of every rigid wall and round support, 0 to 1
    #[arg(long, value_name = "E", allow_hyphen_values = true)]
    pub restitution: Option<f64>,
    /// Modes to keep, in place of the case's
    #[arg(long, value_name = "K")]
    pub modes: Option<usize>,
    /// Penalty parameter ε, m³/N, in place of the case's
    #[arg(long, value_name = "EPS", allow_hyphen_values = true)]
    pub epsilon: Option<f64>,
    /// Solver of the quadratic programmes: auto, clamp, condensed, clarabel
    #[arg(long, value_name = "NAME", value_parser = values::solvers(), hide_possible_values = true)]
    pub qp: Option<Backend>,
    /// θ of moreau-jean, 0.5 to 1
    #[arg(long, value_name = "θ", allow_hyphen_values = true)]
    pub theta: Option<f64>,
    /// ρ∞ of generalized-alpha, 0 to 1
    #[arg(long, value_name = "ρ", allow_hyphen_values = true)]
    pub rho: Option<f64>,
    /// Integrator of the penalty: trapezoidal, implicit-euler, central-difference,
    /// discrete-gradient
    #[arg(long, value_name = "NAME", value_parser = values::integrators(), hide_possible_values = true)]
    pub integrator: Option<Integrator>,
    /// Where the results go
    #[command(flatten)]
    pub place: Destination,
}

/// Where results are written, and the formats of their pictures.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Destination {
    /// Folder for the results [default: out/CASE/COMMAND]
    #[arg(long, value_name = "DIR", value_hint = clap::ValueHint::DirPath)]
    pub out: Option<PathBuf>,
    /// Replace the results of another request
    #[arg(long)]
    pub force: bool,
    /// Write no report.html, nor the shape.csv or orbits.csv from which it draws motions
    #[arg(long)]
    pub no_report: bool,
    /// File formats of pictures
    #[command(flatten)]
    pub formats: Formats,
}

impl Destination {
    /// The folder for the results of `command` on `case`: `--out`, or `out/CASE/COMMAND`. It must
    /// be writable and must not hold results of another request than `request`.
    ///
    /// # Errors
    /// As [`Results::open`]; [`Error::Invalid`] for a format that this build cannot write.
    pub fn results(&self, case: &Case, command: &str, request: Map<String, Value>) -> Result<Results> {
        let folder = self.out.clone().unwrap_or_else(|| Path::new("out").join(&case.name).join(command));
        let mut results = Results::open(&folder, request, self.force, self.formats.usable()?)?;
        results.tell("command_line", json!(command_line()));
        results.tell("title", json!(case.title));
        Ok(results)
    }
}

/// Finds the case `name`: the file of that name; else, for a name without an extension, the file
/// NAME.toml in the current folder; else the built-in case of that name. Says which it took
/// wherever there is a built-in case of that name.
///
/// # Errors
/// As [`CaseFile::read`].
pub fn case_file(name: &str, ui: &Ui) -> Result<CaseFile> {
    let file = Path::new(name);
    let beside = PathBuf::from(format!("{name}.toml"));
    // `..` and `.toml` do not get an extension.
    let bare = !name.is_empty() && file.extension().is_none() && file.file_name().is_some();
    let built_in = Embedded::named(name);
    let taken = match &built_in {
        _ if file.is_file() => file,
        _ if bare && beside.is_file() => &beside,
        Ok(embedded) => {
            ui.message(&format!("{name}: the built-in case"));
            return CaseFile::embedded(embedded.name);
        }
        Err(_) => file,
    };
    if built_in.is_ok() || taken != file {
        let other = if built_in.is_ok() { ", not the built-in case of that name" } else { "" };
        ui.message(&format!("{name}: the file {}{other}", taken.display()));
    }
    CaseFile::read(taken)
}

/// Values of the case that the command line changes by their keys.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Changes {
    /// Set a value of the case by its key, such as wall.upper.position=6e-3,
    /// load.1.harmonic.frequency=4, wall.*.restitution=0.8; may be given several times
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl Changes {
    /// The file of the case `name`, found by [`case_file`], with the values set.
    ///
    /// # Errors
    /// As [`case_file`] and [`CaseFile::set`]; [`Error::Invalid`] for an argument that is not
    /// KEY=VALUE.
    pub fn case_file(&self, name: &str, ui: &Ui) -> Result<CaseFile> {
        let mut file = case_file(name, ui)?;
        if !self.set.is_empty() {
            // Errors of the file itself are shown with its own lines, before any change.
            file.case()?;
        }
        for (key, value) in self.pairs()? {
            file.set(&key.parse()?, &value)?;
        }
        Ok(file)
    }

    /// The keys and values as they were given.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an argument that is not KEY=VALUE.
    pub fn pairs(&self) -> Result<Vec<(String, KeyValue)>> {
        let pair = |text: &String| {
            let expected = "KEY=VALUE, such as wall.upper.position=6e-3";
            let wrong = || Error::invalid("--set", format_args!("{text:?}"), expected);
            let (key, value) = text.split_once('=').ok_or_else(wrong)?;
            Ok((key.to_owned(), value.parse()?))
        };
        self.set.iter().map(pair).collect()
    }

    /// The command line that asks `command` of the case `name` with the values set, without its
    /// other options.
    #[must_use]
    pub fn command_line(&self, command: &str, name: &str) -> String {
        let sets = self.set.iter().map(|pair| format!(" --set {}", quoted(pair)));
        format!("signorini {command} {}{}", quoted(name), sets.collect::<String>())
    }

    /// The case of that file. Says the size of random forces that take time and memory.
    ///
    /// # Errors
    /// As [`Changes::case_file`] and [`CaseFile::case`].
    pub fn case(&self, name: &str, ui: &Ui) -> Result<Case> {
        let case = self.case_file(name, ui)?.case()?;
        case.large_random_forces().for_each(|said| ui.message(&said));
        Ok(case)
    }

    /// The same case with another restitution at every rigid wall, checked.
    ///
    /// # Errors
    /// As [`Changes::case`], and [`Error::Invalid`] for an invalid restitution.
    pub fn case_with_restitution(&self, name: &str, restitution: Option<f64>, ui: &Ui) -> Result<Case> {
        let mut case = self.case(name, ui)?;
        set_restitution(&mut case, restitution)?;
        case.validate()?;
        Ok(case)
    }
}

fn set_restitution(case: &mut Case, restitution: Option<f64>) -> Result<()> {
    let Some(restitution) = restitution else { return Ok(()) };
    let holes = case.whole().holes().any(|hole| hole.law.is_rigid());
    if !holes && !case.whole().walls.iter().any(|wall| wall.law.is_rigid()) {
        return Err(Error::invalid("--restitution", restitution, "a case with a rigid wall; this one has none"));
    }
    if case.truncated.as_ref().is_some_and(|truncated| truncated.whole.static_correction) {
        let expected = "a case without static_correction: the compliance that modes leave out has no mass, and \
                        what has no mass cannot rebound";
        return Err(Error::invalid("--restitution", restitution, expected));
    }
    case.change(|scene| {
        for wall in scene.walls.iter_mut().filter(|wall| wall.law.is_rigid()) {
            wall.law = WallLaw::Rigid { restitution };
        }
        for support in &mut scene.supports {
            if let Shape::Round { law, .. } = &mut support.shape
                && law.is_rigid()
            {
                *law = WallLaw::Rigid { restitution };
            }
        }
    })
}

impl Request {
    /// The case with the command line's changes, checked.
    ///
    /// # Errors
    /// As [`Changes::case`], and [`Error::Invalid`] for an invalid change.
    pub fn case(&self, ui: &Ui) -> Result<Case> {
        let read = self.changes.case(&self.case, ui)?;
        let mut case = read.clone();
        if let Some(modes) = self.modes {
            case = case.with_modes(modes)?;
        }
        if let Some(end) = self.end {
            case.change_end(end)?;
            let until_end = |x: &f64| *x <= end;
            case.time.sample = case.time.sample.filter(until_end);
            if case.time.statistics_from >= end {
                case.time.statistics_from = 0.0;
            }
        }
        case.time.step = self.step.unwrap_or(case.time.step);
        case.time.sample = self.sample.or(case.time.sample);
        case.time.force_averaging = self.force_averaging.unwrap_or(case.time.force_averaging);
        set_restitution(&mut case, self.restitution)?;
        if let Some(epsilon) = self.epsilon {
            case.penalty.laws = vec![PenaltyLaw::Quartic { epsilon }];
        }
        if self.integrator.is_some() {
            case.penalty.integrator = self.integrator;
        }
        // A case that was only read has been checked already.
        if case != read {
            case.validate()?;
        }
        Ok(case)
    }

    /// The method named `name`; settings that it leaves open come from the command line and the
    /// case.
    ///
    /// # Errors
    /// [`Error::Unknown`] or [`Error::Invalid`] for a name that is not a method.
    pub fn method(&self, name: &str, case: &Case) -> Result<Method> {
        let name = name.trim();
        self.check_against(name)?;
        let mut method = case.method(name)?;
        match &mut method.scheme {
            Scheme::MoreauJean { theta } if !name.contains("theta=") => *theta = self.theta.unwrap_or(*theta),
            Scheme::GeneralizedAlpha { rho } if !name.contains("rho=") => *rho = self.rho.unwrap_or(*rho),
            _ => {}
        }
        if method.scheme.has_qp() {
            method.backend = self.qp.unwrap_or(method.backend);
        }
        if method.backend == Backend::Clamp && !matches!(case.scene.system, System::Oscillator(_)) {
            return Err(Error::invalid(
                "qp",
                "clamp",
                "auto, condensed or clarabel: the case has more than one unknown",
            ));
        }
        method.scheme.validate()?;
        Ok(method)
    }

    /// Refuses an option that the name of the method sets as well.
    fn check_against(&self, name: &str) -> Result<()> {
        let given = |key: &str| name.split([':', ',']).any(|part| part.trim().starts_with(key));
        let number = |x: Option<f64>| x.map(|x| x.to_string());
        let options = [
            ("--theta", number(self.theta), given("theta=")),
            ("--rho", number(self.rho), given("rho=")),
            ("--epsilon", number(self.epsilon), given("epsilon=") || given("stiffness=")),
            ("--integrator", self.integrator.map(|i| i.to_string()), given("integrator=")),
            ("--qp", self.qp.map(|q| q.to_string()), given("qp=")),
        ];
        for (option, value, beside) in options {
            if let (Some(value), true) = (value, beside) {
                return Err(Error::invalid(option, value, format!("either the option or the setting in {name:?}")));
            }
        }
        Ok(())
    }

    /// Refuses settings that no method of the request uses, and a method that is asked for twice.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the option.
    pub fn check_use(&self, methods: &[Method]) -> Result<()> {
        let any = |test: fn(&Scheme) -> bool| methods.iter().any(|m| test(&m.scheme));
        let penalty = |s: &Scheme| matches!(s, Scheme::Penalty { .. });
        let unused = |option: &'static str, value: String, scheme: &str| {
            Err(Error::invalid(option, value, format!("a request with {scheme} in it")))
        };
        for (index, method) in methods.iter().enumerate() {
            if methods[..index].contains(method) {
                return Err(Error::invalid("--schemes", format!("{method}, twice"), "each method once"));
            }
        }
        if let (Some(step), false) = (self.step, any(|s| *s != Scheme::Event)) {
            let expected = "a request with a scheme that has a step in it: event has none, and --sample sets its rows";
            return Err(Error::invalid("--step", step, expected));
        }
        if let (Some(qp), false) = (self.qp, any(Scheme::has_qp)) {
            return unused("--qp", qp.to_string(), "a scheme that solves quadratic programmes");
        }
        if let (Some(rho), false) = (self.rho, any(|s| matches!(s, Scheme::GeneralizedAlpha { .. }))) {
            return unused("--rho", rho.to_string(), "generalized-alpha");
        }
        match (self.theta, self.epsilon, self.integrator) {
            (Some(theta), _, _) if !any(|s| matches!(s, Scheme::MoreauJean { .. })) => {
                unused("--theta", theta.to_string(), "moreau-jean")
            }
            (_, Some(epsilon), _) if !any(penalty) => unused("--epsilon", epsilon.to_string(), "penalty"),
            (_, _, Some(integrator)) if !any(penalty) => unused("--integrator", integrator.to_string(), "penalty"),
            _ => Ok(()),
        }
    }

    /// The folder for the results of `command` on the case, for `request`.
    ///
    /// # Errors
    /// As [`Destination::results`].
    pub fn results(&self, case: &Case, command: &str, request: Map<String, Value>) -> Result<Results> {
        self.place.results(case, command, request)
    }
}
