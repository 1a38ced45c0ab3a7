//! The arguments of `run`, `compare` and `wear`: the case, its changes, and the settings of
//! methods.

use super::case_args::{CaseArgs, built};
use super::pipeline::Destination;
use super::ui::Ui;
use super::values;
use crate::case::{Case, CaseFile, Key, KeyValue};
use crate::error::{Error, Result};
use crate::qp::Backend;
use crate::scene::{System, forcing_period};
use crate::scheme::{Integrator, Method, Scheme};
use crate::study::choice;

/// Arguments common to `run`, `compare` and `wear`.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Request {
    #[command(flatten)]
    pub case: CaseArgs,
    /// Step of the stepping schemes, s
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// End of the run, s; a window for statistics that begins later begins at 0 then
    #[arg(long, value_name = "T", allow_hyphen_values = true, conflicts_with = "keep")]
    pub end: Option<f64>,
    /// Forcing periods before the window of the statistics
    #[arg(long, value_name = "N", requires = "keep")]
    pub settle: Option<u32>,
    /// Forcing periods in that window, in place of the case's end and statistics_from
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub keep: Option<u32>,
    /// Spacing of the recorded rows, s
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub sample: Option<f64>,
    /// Stretch over which forces of rigid walls are averaged before their RMS is taken, s [default:
    /// the case's, or 1e-3]
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub force_averaging: Option<f64>,
    /// Modes to keep, in place of the case's
    #[arg(long, value_name = "K")]
    pub modes: Option<i64>,
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

impl Request {
    /// The case with the command line's changes.
    ///
    /// # Errors
    /// As [`CaseArgs::read`], and [`Error::Case`] for an invalid change.
    pub fn read(&self, ui: &Ui) -> Result<Case> {
        let mut file = self.case.file(ui)?;
        if let Some(end) = self.end {
            set_end(&mut file, end, ui)?;
        }
        if let Some(keep) = self.keep {
            set_periods(&mut file, self.settle.unwrap_or(0), keep, ui)?;
        }
        let integrator = self.integrator.map(|integrator| KeyValue::from(integrator.name()));
        let values = [
            ("system.modes", self.modes.map(KeyValue::from)),
            ("time.step", self.step.map(KeyValue::from)),
            ("time.sample", self.sample.map(KeyValue::from)),
            ("time.force_averaging", self.force_averaging.map(KeyValue::from)),
            ("penalty.integrator", integrator),
        ];
        for (key, value) in values {
            value.map_or(Ok(()), |value| file.set(&key.parse()?, &value))?;
        }
        if let Some(epsilon) = self.epsilon {
            file.remove(&"penalty.stiffness".parse()?)?;
            file.remove(&"penalty.damping".parse()?)?;
            file.set(&"penalty.epsilon".parse()?, &KeyValue::from(&[epsilon][..]))?;
        }
        built(&file, ui)
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

    /// The method that `asked` names, or the one chosen for the case, with the reason.
    pub fn chosen(&self, asked: Option<&str>, case: &Case) -> Result<(Method, String)> {
        let (method, reason) = match asked {
            Some(name) => (self.method(name, case)?, "asked for".to_owned()),
            None => {
                let choice = choice::choose(&case.scene);
                (self.method(&choice.method.to_string(), case)?, choice.reason)
            }
        };
        self.check_use(&[method])?;
        Ok((method, reason))
    }

    /// The methods of a list, separated as [`method_names`] does.
    ///
    /// # Errors
    /// As [`Request::method`].
    pub fn methods(&self, list: &str, case: &Case) -> Result<Vec<Method>> {
        method_names(list).map(|name| self.method(name, case)).collect()
    }

    /// The options that set something of a scheme.
    fn options(&self) -> [SchemeOption; 5] {
        let number = |x: Option<f64>| x.map(|x| x.to_string());
        let penalty = |scheme: &Scheme| matches!(scheme, Scheme::Penalty { .. });
        [
            SchemeOption {
                name: "--qp",
                value: self.qp.map(|qp| qp.to_string()),
                settings: &["qp="],
                concerns: Scheme::has_qp,
                scheme: "a scheme that solves quadratic programmes",
            },
            SchemeOption {
                name: "--rho",
                value: number(self.rho),
                settings: &["rho="],
                concerns: |scheme| matches!(scheme, Scheme::GeneralizedAlpha { .. }),
                scheme: "generalized-alpha",
            },
            SchemeOption {
                name: "--theta",
                value: number(self.theta),
                settings: &["theta="],
                concerns: |scheme| matches!(scheme, Scheme::MoreauJean { .. }),
                scheme: "moreau-jean",
            },
            SchemeOption {
                name: "--epsilon",
                value: number(self.epsilon),
                settings: &["epsilon=", "stiffness="],
                concerns: penalty,
                scheme: "penalty",
            },
            SchemeOption {
                name: "--integrator",
                value: self.integrator.map(|integrator| integrator.to_string()),
                settings: &["integrator="],
                concerns: penalty,
                scheme: "penalty",
            },
        ]
    }

    /// Refuses an option that the name of the method sets as well.
    fn check_against(&self, name: &str) -> Result<()> {
        let given = |key: &&str| name.split([':', ',']).any(|part| part.trim().starts_with(key));
        for option in self.options() {
            if let (Some(value), true) = (option.value, option.settings.iter().any(given)) {
                let expected = format!("either the option or the setting in {name:?}");
                return Err(Error::invalid(option.name, value, expected));
            }
        }
        Ok(())
    }

    /// Refuses settings that no method of the request uses, and a method that is asked for twice.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the option.
    pub fn check_use(&self, methods: &[Method]) -> Result<()> {
        for (index, method) in methods.iter().enumerate() {
            if methods[..index].contains(method) {
                return Err(Error::invalid("--schemes", format!("{method}, twice"), "each method once"));
            }
        }
        if let (Some(step), true) = (self.step, methods.iter().all(|method| method.scheme == Scheme::Event)) {
            let expected = "a request with a scheme that has a step in it: event has none, and --sample sets its rows";
            return Err(Error::invalid("--step", step, expected));
        }
        for SchemeOption { name, value, concerns, scheme, .. } in self.options() {
            if let (Some(value), false) = (value, methods.iter().any(|method| concerns(&method.scheme))) {
                return Err(Error::invalid(name, value, format!("a request with {scheme} in it")));
            }
        }
        Ok(())
    }
}

/// Sets the end of the run, and leaves out rows and a window of statistics that lie beyond it, with
/// a word about the window.
pub(super) fn set_end(file: &mut CaseFile, end: f64, ui: &Ui) -> Result<()> {
    for (name, beyond) in [("time.sample", f64::gt as fn(&f64, &f64) -> bool), ("time.statistics_from", f64::ge)] {
        let key: Key = name.parse()?;
        let Some(x) = file.get(&key)?.and_then(|value| value.number()).filter(|x| beyond(x, &end)) else { continue };
        file.remove(&key)?;
        if name == "time.statistics_from" {
            ui.message(&format!("note: statistics begin at 0 s, not at {x} s, which is not before the end, {end} s"));
        }
    }
    file.set(&"time.end".parse()?, &end.into())
}

/// Sets the window of the statistics to so many forcing periods of the case, after so many before
/// it: what a row of a sweep over periods has.
fn set_periods(file: &mut CaseFile, settle: u32, keep: u32, ui: &Ui) -> Result<()> {
    let period = forcing_period(&file.case()?.scene)?;
    file.set(&"time.statistics_from".parse()?, &(f64::from(settle) * period).into())?;
    set_end(file, (f64::from(settle) + f64::from(keep)) * period, ui)
}

/// An option that sets something of a scheme.
struct SchemeOption {
    name: &'static str,
    /// The value given.
    value: Option<String>,
    /// The same as settings in the name of a method.
    settings: &'static [&'static str],
    /// True for a scheme that it concerns.
    concerns: fn(&Scheme) -> bool,
    /// These schemes in words.
    scheme: &'static str,
}

/// Methods separated by semicolons or commas; a comma before a setting (`integrator=trapezoidal`)
/// belongs to the method before it.
fn method_names(list: &str) -> impl Iterator<Item = &str> {
    let by_semicolon = list.contains(';');
    let mut parts = Vec::new();
    let mut start = 0;
    for (i, c) in list.char_indices() {
        let next = list[i + c.len_utf8()..].split([',', ';']).next().unwrap_or("");
        // `integrator=trapezoidal` is a setting, `penalty:epsilon=1e-9` and `event` are methods.
        let begins = next.contains(':') || !next.contains('=');
        if c == ';' || (c == ',' && !by_semicolon && begins) {
            parts.push(&list[start..i]);
            start = i + c.len_utf8();
        }
    }
    parts.push(&list[start..]);
    parts.into_iter().map(str::trim).filter(|part| !part.is_empty())
}
