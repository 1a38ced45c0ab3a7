//! What an error says.

use super::{Error, escaped, escaped_lines};
use std::borrow::Cow;
use std::fmt;

/// The entry of `known` that `word` was probably meant to be: one letter in three may be wrong,
/// left out, added, or swapped with the next; or `word` is its beginning.
pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let word = word.to_lowercase();
    let letters = word.chars().count();
    let close = known.clone().map(|name| (strsim::osa_distance(&word, &name.to_lowercase()), name));
    let best = close.min_by_key(|(distance, _)| *distance).filter(|(distance, _)| 3 * distance <= letters + 1);
    let mut begun = known.filter(|name| letters >= 3 && name.starts_with(&word));
    best.map(|(_, name)| name).or_else(|| begun.next())
}

/// The one of `all`, names with what each stands for, that is called `name`.
///
/// # Errors
/// [`Error::Unknown`], listing the names; `kind` says what they name.
pub(crate) fn named<T>(
    kind: &'static str,
    name: &str,
    all: impl IntoIterator<Item = (&'static str, T)>,
) -> Result<T, Error> {
    let mut known = Vec::new();
    for (own, value) in all {
        if own == name.trim() {
            return Ok(value);
        }
        known.push(own.to_owned());
    }
    Err(Error::Unknown { kind, name: name.to_owned(), known })
}

/// `1 row`, `12 rows`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// `x` with at most `digits` significant digits, as a person writes it: without trailing zeros, and
/// with an exponent only where it is far from 1.
pub(crate) fn amount(x: f64, digits: usize) -> String {
    let rounded: f64 = format!("{x:.*e}", digits.saturating_sub(1)).parse().unwrap_or(x);
    if x == 0.0 || (1e-3..1e6).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&escaped_lines(&Words(self).to_string()))
    }
}

/// A name in a list; that of the only probe of an oscillator is empty.
fn shown(name: &str) -> Cow<'_, str> {
    if name.is_empty() { "\"\"".into() } else { escaped(name) }
}

/// The words of an error, with names as they are.
struct Words<'a>(&'a Error);

impl fmt::Display for Words<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Error::Invalid { subject, value, expected } => write!(f, "{subject} is {value}; expected {expected}"),
            Error::Unknown { kind, name, known } if known.is_empty() => {
                write!(f, "no {kind} is named {name:?}: none exists")
            }
            Error::Unknown { kind, name, known } => {
                write!(f, "no {kind} is named {name:?}; ")?;
                if let Some(near) = nearest(name, known.iter().map(String::as_str)) {
                    write!(f, "did you mean {}? ", escaped(near))?;
                }
                let known: Vec<_> = known.iter().map(|name| shown(name)).collect();
                write!(f, "there is {}", known.join(", "))
            }
            Error::Case { report, .. } => f.write_str(report),
            Error::Io { path, reason, .. } | Error::OtherResults { path, reason } => {
                write!(f, "{}: {reason}", escaped(path))
            }
            Error::Qp { time, step, wall, reason, .. } => {
                write!(f, "the QP of step {step} at t = {time} s was not solved")?;
                if let Some(wall) = wall {
                    write!(f, " (wall {wall:?})")?;
                }
                write!(f, ": {reason}")
            }
            Error::Newton { time, step, residual } => write!(
                f,
                "Newton's method did not converge in step {step} at t = {time} s (residual {residual:e} N); \
                 a smaller step or a softer penalty would"
            ),
            Error::NotFinite { time, step, what } => {
                write!(f, "the {what} is no longer finite at t = {time:.4e} s, step {step}: the scheme has diverged")
            }
            Error::Diverged { time, step, ratio, cause } => write!(
                f,
                "the run diverged by t = {time:.4e} s, step {step}: it is {ratio:.1e} times faster than its start \
                 and its loads can make it; {cause}"
            ),
            Error::TooManyEvents { time, wall, count, window } => write!(
                f,
                "{count} contact events, or steps of the search for them, within {window:.3e} s at wall \
                 {wall:?}, t = {time:.6} s: more than the exact scheme follows; \
                 a stepping scheme (moreau-jean, paoli-schatzman) does not resolve them one by one"
            ),
            Error::Inaccurate { .. }
            | Error::Scattered { .. }
            | Error::Biased { .. }
            | Error::Truncated { .. }
            | Error::Unpredictable { .. } => not_reached(self.0, f),
            Error::Unchecked { checks } => write!(
                f,
                "checks that failed, so that part of the error is not known: the run with {}",
                checks.join("; the run with ")
            ),
            Error::Stopped => f.write_str("stopped before its end on request"),
            Error::Refuted { runs } => write!(f, "refuted by the judge, not to be used: {}", runs.join("; ")),
            Error::Unverified { values } => write!(f, "not within their tolerances: {}", values.join("; ")),
            Error::NoOrbit { reason } => write!(f, "no periodic orbit: {reason}"),
        }
    }
}

/// Says what was asked for and how near it came.
fn not_reached(error: &Error, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    match error {
        Error::Inaccurate { tolerance, reached, steps, .. } if reached.is_infinite() => write!(
            f,
            "an error of {tolerance:e} is out of reach: the coarsest runs that could see the motion take \
             {} and more",
            counted(*steps as usize, "step")
        ),
        // A change of that size is not yet an error of that size.
        Error::Inaccurate { tolerance, reached, quantity, steps, .. } if reached <= tolerance => write!(
            f,
            "an error of {tolerance:e} is not certain: in {} the last halving of the step still made a change of \
             {reached:.1e} ({quantity}), of which two in succession are to be below a quarter of the error",
            counted(*steps as usize, "step")
        ),
        Error::Inaccurate { tolerance, reached, quantity, until, steps } => write!(
            f,
            "an error of {tolerance:e} was not reached: in {} it is {reached:.1e} ({quantity}); \
             the displacement keeps it until t = {until:.6} s",
            counted(*steps as usize, "step")
        ),
        Error::Scattered { share, reached, quantity, count, needed } => write!(
            f,
            "an interval of ± {:.1} % was not reached: {count} of {needed} realisations leave ± {:.1} % \
             ({quantity}); no more than {count} were allowed",
            100.0 * share,
            100.0 * reached
        ),
        Error::Biased { part, tolerance, reached, why, .. } if reached.is_infinite() => {
            write!(f, "an error of the {part} within {} % is not known: {why}", amount(100.0 * tolerance, 3))
        }
        Error::Biased { part, tolerance, reached, seen, quantity, why } => write!(
            f,
            "an error of the {part} within {} % was not reached: it is {}seen, at most {} % ({quantity}); {why}",
            amount(100.0 * tolerance, 3),
            if *seen { "" } else { "not " },
            amount(100.0 * reached, 2)
        ),
        Error::Truncated { tolerance, reached, quantity, modes } => write!(
            f,
            "a truncation within {tolerance:e} was not reached: going to {modes} modes still changed \
             {reached:.1e} ({quantity})"
        ),
        Error::Unpredictable { tolerance, reached, horizon, end } => write!(
            f,
            "an error of {tolerance:e} is kept until t = {horizon:.6} s only ({reached:.1e} reached): \
             rounding grows to a quarter of it soon after, and no step predicts the motion up to {end} s; an error \
             of its means over starts that nobody can tell apart can be kept (--of means; realisations in Python)"
        ),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;
    use crate::error::Error;

    #[test]
    fn a_change_below_the_tolerance_is_not_told_as_an_error_above_it() {
        let of = |reached: f64| {
            let quantity = "displacement".to_owned();
            Error::Inaccurate { tolerance: 5e-2, reached, quantity, until: 3.0, steps: 1_125_120 }.to_string()
        };
        assert!(of(4.3e-2).starts_with("an error of 5e-2 is not certain: "), "{}", of(4.3e-2));
        assert!(of(6e-2).starts_with("an error of 5e-2 was not reached: "), "{}", of(6e-2));
    }

    #[test]
    fn a_word_is_taken_for_the_one_it_resembles() {
        let known = ["moreau-jean", "newmark", "event", "theta"];
        let near = |word| nearest(word, known.into_iter());
        for (word, meant) in
            [("moreau-jaen", "moreau-jean"), ("Newmark", "newmark"), ("tetha", "theta"), ("moreau", "moreau-jean")]
        {
            assert_eq!(near(word), Some(meant));
        }
        for word in ["runge-kutta", "x", ""] {
            assert_eq!(near(word), None, "{word}");
        }
    }
}
