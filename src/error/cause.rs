//! The cause of an error.

use std::fmt;
use std::sync::Arc;

/// The error that led to another one. Two causes are equal if their messages are.
#[derive(Clone)]
pub struct Cause(Arc<dyn std::error::Error + Send + Sync>);

impl Cause {
    pub(crate) fn new(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self(Arc::new(error))
    }

    /// The underlying error.
    #[must_use]
    pub fn error(&self) -> &(dyn std::error::Error + 'static) {
        &*self.0
    }
}

impl PartialEq for Cause {
    fn eq(&self, other: &Self) -> bool {
        self.0.to_string() == other.0.to_string()
    }
}

impl fmt::Debug for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The words of the operating system without the number that the standard library puts behind them,
/// "(os error 13)", which says nothing more.
pub(crate) fn unnumbered(text: &str) -> String {
    const BEFORE: &str = " (os error ";
    let mut parts = text.split(BEFORE);
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        match part.split_once(')') {
            Some((number, rest)) if number.parse::<i32>().is_ok() => whole.push_str(rest),
            _ => whole.extend([BEFORE, part]),
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_the_operating_system_stay_and_their_numbers_go() {
        let full = std::io::Error::from_raw_os_error(28).to_string();
        let words = full.strip_suffix(" (os error 28)").expect("the number of the standard library");
        assert_eq!(unnumbered(&full), words);
        let twice = format!("no folder there ({full}); expected one\n{full}");
        assert_eq!(unnumbered(&twice), format!("no folder there ({words}); expected one\n{words}"));
        for other in ["", "line 3 (os error codes)", " (os error "] {
            assert_eq!(unnumbered(other), other);
        }
        let error = crate::error::Error::io("a/b", full.clone(), false);
        assert_eq!(error.to_string(), format!("a/b: {words}"));
    }
}
