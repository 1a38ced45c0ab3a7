//! Schemes as words: `moreau-jean:theta=0.6`, `penalty:epsilon=1e-9,integrator=trapezoidal`.

use super::generalized_alpha::RHO;
use super::{Integrator, PenaltyLaw, Scheme};
use crate::error::{Error, Result, named};
use crate::scene::{nonnegative, positive};
use std::fmt;
use std::str::FromStr;

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.entry().name)?;
        match *self {
            Self::MoreauJean { theta } if theta != 0.5 => write!(f, ":theta={theta}"),
            Self::GeneralizedAlpha { rho } if rho != RHO => write!(f, ":rho={rho}"),
            Self::Penalty { law, integrator } => {
                let integrator = (integrator != Integrator::default()).then(|| format!("integrator={integrator}"));
                let settings = [law.to_string(), integrator.unwrap_or_default()];
                let settings: Vec<_> = settings.into_iter().filter(|setting| !setting.is_empty()).collect();
                if settings.is_empty() { Ok(()) } else { write!(f, ":{}", settings.join(",")) }
            }
            _ => Ok(()),
        }
    }
}

/// Settings behind the colon of a scheme's name, as given.
#[derive(Debug, Default)]
struct Settings {
    theta: Option<f64>,
    rho: Option<f64>,
    epsilon: Option<f64>,
    stiffness: Option<f64>,
    damping: Option<f64>,
    integrator: Option<Integrator>,
}

impl Settings {
    fn parse(text: &str, keys: &[&str]) -> Result<Self> {
        let (mut settings, mut given) = (Self::default(), Vec::new());
        for part in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
            let accepted = || format!("key=value with one of the keys {}", keys.join(", "));
            let (key, value) =
                part.split_once('=').ok_or_else(|| Error::invalid("scheme setting", part, accepted()))?;
            let number = || {
                let parsed = value.trim().parse::<f64>().ok().filter(|x| x.is_finite());
                parsed.ok_or_else(|| Error::invalid(format!("scheme setting {key}"), value, "a finite number"))
            };
            if given.contains(&key.trim()) {
                return Err(Error::invalid("scheme setting", format!("{} twice", key.trim()), accepted()));
            }
            given.push(key.trim());
            match key.trim() {
                key if !keys.contains(&key) => return Err(Error::invalid("scheme setting", key, accepted())),
                "theta" => settings.theta = Some(number()?),
                "rho" => settings.rho = Some(number()?),
                "epsilon" => settings.epsilon = Some(number()?),
                "stiffness" => settings.stiffness = Some(number()?),
                "damping" => settings.damping = Some(number()?),
                _ => settings.integrator = Some(value.trim().parse()?),
            }
        }
        Ok(settings)
    }
}

impl FromStr for Scheme {
    type Err = Error;

    /// Parses a name as [`fmt::Display`] writes it; settings may be left out where they have a
    /// default (θ = ½, ρ∞ = 0.8, the discrete-gradient integrator, no damping); a penalty without
    /// epsilon and stiffness takes no rigid wall.
    fn from_str(text: &str) -> Result<Self> {
        let (name, settings) = text.split_once(':').unwrap_or((text, ""));
        let mut scheme = named("scheme", name, Self::ALL.map(|scheme| (scheme.entry().name, scheme)))?;
        let entry = scheme.entry();
        if entry.settings.is_empty() && !settings.trim().is_empty() {
            return Err(Error::invalid(format!("setting of {name}"), settings, "none: this scheme has no settings"));
        }
        let settings = Settings::parse(settings, entry.settings)?;
        match &mut scheme {
            Self::MoreauJean { theta } => *theta = settings.theta.unwrap_or(*theta),
            Self::GeneralizedAlpha { rho } => *rho = settings.rho.unwrap_or(*rho),
            Self::Penalty { law, integrator } => {
                *law = penalty_law(&settings)?;
                *integrator = settings.integrator.unwrap_or_default();
            }
            _ => {}
        }
        scheme.validate()?;
        Ok(scheme)
    }
}

fn penalty_law(settings: &Settings) -> Result<PenaltyLaw> {
    match (settings.epsilon, settings.stiffness) {
        (None, Some(stiffness)) => Ok(PenaltyLaw::Linear { stiffness, damping: settings.damping.unwrap_or(0.0) }),
        (_, None) if settings.damping.is_some() => {
            Err(Error::invalid("setting of penalty", "damping without stiffness", "damping with stiffness"))
        }
        (Some(epsilon), None) => Ok(PenaltyLaw::Quartic { epsilon }),
        (Some(_), Some(_)) => Err(Error::invalid("setting of penalty", "epsilon and stiffness", "one of the two")),
        (None, None) => Ok(PenaltyLaw::None),
    }
}

impl Scheme {
    /// Checks the scheme's own numbers.
    ///
    /// # Errors
    /// [`Error::Invalid`]: θ outside [½, 1], ρ∞ outside [0, 1], an ε or stiffness that is not
    /// positive, a negative damping.
    pub fn validate(&self) -> Result<()> {
        match *self {
            Self::MoreauJean { theta } if !(0.5..=1.0).contains(&theta) => Err(Error::invalid(
                "theta",
                format_args!("{theta:?}"),
                "a number from 0.5 to 1: below 0.5 the rule is unstable",
            )),
            Self::GeneralizedAlpha { rho } if !(0.0..=1.0).contains(&rho) => Err(Error::invalid(
                "rho",
                format_args!("{rho:?}"),
                "a number from 0 to 1: what is left of the fastest vibration after a step",
            )),
            Self::Penalty { law: PenaltyLaw::Quartic { epsilon }, .. } => positive("penalty.epsilon", epsilon),
            Self::Penalty { law: PenaltyLaw::Linear { stiffness, damping }, .. } => {
                positive("penalty.stiffness", stiffness)?;
                nonnegative("penalty.damping", damping)
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_says_what_is_not_the_default_and_reads_back_as_the_scheme() {
        for (text, name) in [
            ("moreau-jean:theta=0.5", "moreau-jean"),
            ("moreau-jean: theta = 0.75 ", "moreau-jean:theta=0.75"),
            ("generalized-alpha:rho=0.8,", "generalized-alpha"),
            ("generalized-alpha:rho=0", "generalized-alpha:rho=0"),
            ("penalty", "penalty"),
            ("penalty:integrator=trapezoidal", "penalty:integrator=trapezoidal"),
            ("penalty:epsilon=1e-9,integrator=discrete-gradient", "penalty:epsilon=1e-9"),
            ("penalty:epsilon=1e-9,integrator=trapezoidal", "penalty:epsilon=1e-9,integrator=trapezoidal"),
            ("penalty:stiffness=1e8,damping=0", "penalty:stiffness=1e8"),
            ("penalty:damping=20,stiffness=1e8", "penalty:stiffness=1e8,damping=2e1"),
        ] {
            let scheme: Scheme = text.parse().unwrap();
            assert_eq!(scheme.to_string(), name);
            assert_eq!(name.parse(), Ok(scheme), "{name}");
        }
    }

    #[test]
    fn settings_of_other_schemes_and_those_that_exclude_one_another_are_refused() {
        for (text, reason) in [
            ("moreau-jean:rho=0.5", "one of the keys theta"),
            ("generalized-alpha:theta=0.5", "one of the keys rho"),
            ("moreau-jean:theta", "key=value"),
            ("newmark:theta=0.5", "no settings"),
            ("penalty:damping=1", "damping without stiffness"),
            ("penalty:epsilon=1e-9,damping=1", "damping without stiffness"),
            ("penalty:epsilon=1e-9,stiffness=1", "epsilon and stiffness"),
            ("moreau-jean:theta=0.5,theta=0.6", "theta twice"),
            ("penalty:epsilon=1e-9,integrator=leapfrog", "integrator"),
            ("leapfrog", "scheme"),
        ] {
            let error = text.parse::<Scheme>().unwrap_err().to_string();
            assert!(error.contains(reason), "{text}: {error}");
        }
    }

    #[test]
    fn numbers_outside_of_their_range_are_refused_by_key() {
        let integrator = Integrator::Trapezoidal;
        let alpha = |rho| Scheme::GeneralizedAlpha { rho };
        let spring =
            |stiffness, damping| Scheme::Penalty { law: PenaltyLaw::Linear { stiffness, damping }, integrator };
        let quartic = |epsilon| Scheme::Penalty { law: PenaltyLaw::Quartic { epsilon }, integrator };
        let theta = |theta| Scheme::MoreauJean { theta };
        let none = f64::NAN;
        for sound in
            [theta(0.5), theta(1.0), alpha(0.0), alpha(1.0), spring(1e-3, 0.0), spring(1.0, 2.0), quartic(1e-9)]
        {
            assert_eq!(sound.validate(), Ok(()), "{sound}");
        }
        for (key, wrong) in [
            ("theta", [theta(0.49), theta(1.01), theta(none), theta(f64::INFINITY)]),
            ("rho", [alpha(-0.01), alpha(1.01), alpha(none), alpha(f64::NEG_INFINITY)]),
            ("penalty.epsilon", [quartic(0.0), quartic(-1.0), quartic(none), quartic(f64::INFINITY)]),
            ("penalty.stiffness", [spring(0.0, 0.0), spring(-1.0, 0.0), spring(none, 0.0), spring(f64::INFINITY, 0.0)]),
            (
                "penalty.damping",
                [spring(1.0, -0.1), spring(1.0, none), spring(1.0, f64::INFINITY), spring(1.0, f64::NEG_INFINITY)],
            ),
        ] {
            for scheme in wrong {
                let error = scheme.validate().unwrap_err().to_string();
                assert!(error.contains(key), "{scheme}: {error}");
            }
        }
    }
}
