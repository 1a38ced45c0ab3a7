//! The values that options accept, so that the shell can complete them.

use crate::case::{Embedded, SETTABLE};
use crate::output::format::Format;
use crate::qp::Backend;
use crate::scheme::{Integrator, Scheme};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::ffi::OsStr;

/// Text with suggestions for the shell; any other text is accepted too.
#[derive(Debug, Clone)]
pub struct Offered(Vec<&'static str>);

impl TypedValueParser for Offered {
    type Value = String;

    fn parse_ref(&self, _: &clap::Command, _: Option<&clap::Arg>, value: &OsStr) -> Result<String, clap::Error> {
        // Text that is not Unicode matches nothing; the error message shows it.
        Ok(value.to_string_lossy().into_owned())
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.0.iter().map(PossibleValue::new)))
    }
}

/// A scheme, or a method with its settings: `moreau-jean:theta=0.75`. It is interpreted later, with
/// the case at hand.
#[must_use]
pub fn schemes() -> Offered {
    Offered(Scheme::ALL.map(|scheme| scheme.entry().name).to_vec())
}

/// A key of a case and its value, for `--set`.
#[must_use]
pub fn settings() -> Offered {
    Offered(SETTABLE.iter().map(String::as_str).collect())
}

/// The name of a built-in case.
#[must_use]
pub fn built_in() -> Offered {
    Offered(Embedded::all().iter().map(|case| case.name).collect())
}

/// A solver of the quadratic programmes.
pub fn solvers() -> impl TypedValueParser<Value = Backend> {
    PossibleValuesParser::new(Backend::ALL.map(Backend::name)).try_map(|name| name.parse::<Backend>())
}

/// An integrator of the penalty.
pub fn integrators() -> impl TypedValueParser<Value = Integrator> {
    PossibleValuesParser::new(Integrator::ALL.map(Integrator::name)).try_map(|name| name.parse::<Integrator>())
}

/// A number of realisations; those that take it refuse 0.
pub fn whole(text: &str) -> Result<u64, &'static str> {
    text.parse().map_err(|_| "expected a whole number, 1 or more")
}

/// A number of a list.
pub fn number(text: &str) -> Result<f64, &'static str> {
    text.parse().map_err(|_| "expected numbers with commas between them, such as 0.743,0.033")
}

/// A format of pictures.
pub fn formats() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name)).try_map(|name| name.parse::<Format>())
}
