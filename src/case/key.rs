//! Keys: the path of a value in a case file, as `--set` and sweeps write it.

use super::key_entry::Kind;
use super::schema::{find, is_list, paths};
use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// The path of a value in a case file: names of tables and keys, joined by dots.
///
/// A `[[wall]]`, `[[support]]` or `[[probe]]` is addressed by its `name`, a `[[load]]` by its
/// number from 1, as in messages; `*` stands for all of them. Entries of number lists count from 0,
/// as degrees of freedom do.
///
/// ```
/// use signorini::case::Key;
///
/// let key: Key = "load.1.harmonic.frequency".parse()?;
/// assert_eq!(key.unit(), Some("Hz"));
/// assert_eq!("wall.*.restitution".parse::<Key>()?.unit(), None);
/// assert!("wall.upper.restituton".parse::<Key>().unwrap_err().to_string().contains("did you mean"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Key {
    parts: Vec<String>,
}

impl Key {
    /// The parts between the dots.
    pub(super) fn parts(&self) -> &[String] {
        &self.parts
    }

    /// The last part that is a word, which is the default name of a column of its values.
    #[must_use]
    pub fn word(&self) -> &str {
        let word = |part: &&String| part.parse::<usize>().is_err() && *part != "*";
        self.parts.iter().rev().find(word).map_or("", String::as_str)
    }

    /// The unit of its values as written in column names, `N_per_m`; `None` for a value without a
    /// unit.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        find(&self.pattern()).map(|entry| entry.unit).filter(|unit| !unit.is_empty())
    }

    /// The number that holds where the file leaves the key out; `None` where there is none.
    pub(super) fn default_number(&self) -> Option<f64> {
        find(&self.pattern())?.default.parse().ok()
    }

    /// True where whole numbers alone are accepted: a count, or a seed.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        let is_entry = self.parts.last().is_some_and(|part| part.parse::<usize>().is_ok());
        !is_entry && find(&self.pattern()).is_some_and(|entry| entry.accepted.contains("a whole number"))
    }

    /// True for a value of `[system]` or of a body, which changes the structure, its modes or its
    /// coordinates.
    #[must_use]
    pub fn shapes_system(&self) -> bool {
        self.parts.first().is_some_and(|part| part == "system" || part == "body")
    }

    /// The path without names and numbers: `wall.restitution`.
    fn pattern(&self) -> String {
        let listed = self.parts.first().is_some_and(|first| is_list(first));
        let system = usize::from(self.parts.first().is_some_and(|first| first == "body"));
        // The parts of a field have the names of bodies and of the forms in which it is given.
        let field = matches!(self.parts.as_slice(), [table, of, ..]
            if table == "initial" && ["displacement", "velocity"].contains(&of.as_str()));
        let shapes = |index: usize| self.parts.get(1 + system..index).is_some_and(|path| path == ["modal", "shapes"]);
        let named = |index: usize, part: &str| {
            (listed && index == 1)
                || shapes(index)
                || (field && index > 1)
                || part == "*"
                || part.parse::<usize>().is_ok()
        };
        let kept = self.parts.iter().enumerate().filter(|(index, part)| !named(*index, part));
        kept.map(|(_, part)| part.as_str()).collect::<Vec<_>>().join(".")
    }

    /// True for the key of a value; `wall` alone is none.
    fn is_known(&self) -> bool {
        find(&self.pattern()).is_some_and(|entry| entry.kind != Kind::Tables)
    }

    /// Keys that could have been meant, with the names used in this one.
    fn alternatives(&self) -> Vec<String> {
        let first = self.parts.first().map_or("", String::as_str);
        let name = self.parts.get(1).map_or("*", String::as_str);
        let known: Vec<String> = paths()
            .filter(|path| path.split('.').next() == Some(first))
            .map(|path| match path.split_once('.') {
                Some((list, rest)) if is_list(list) => format!("{list}.{name}.{rest}"),
                _ => path.to_owned(),
            })
            .filter(|path| path.contains('.'))
            .collect();
        let top = || paths().filter(|path| !path.contains('.')).map(str::to_owned).collect();
        if known.is_empty() { top() } else { known }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.parts.join("."))
    }
}

impl FromStr for Key {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let parts: Vec<String> = text.trim().split('.').map(|part| part.trim().to_owned()).collect();
        if parts.iter().any(String::is_empty) {
            let expected = "the path of a value in a case file, such as wall.upper.restitution";
            return Err(Error::invalid("key", format_args!("{text:?}"), expected));
        }
        let key = Self { parts };
        if key.is_known() {
            return Ok(key);
        }
        Err(Error::Unknown { kind: "value of a case file", name: key.to_string(), known: key.alternatives() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> Key {
        text.parse().unwrap()
    }

    #[test]
    fn every_key_of_a_case_file_can_be_set() {
        for path in paths().filter(|path| !is_list(path)) {
            let full = match path.split_once('.') {
                Some((list, rest)) if is_list(list) => format!("{list}.1.{rest}"),
                _ => path.to_owned(),
            };
            assert_eq!(key(&full).pattern(), path);
        }
    }

    #[test]
    fn names_and_numbers_are_no_part_of_what_a_key_is() {
        assert_eq!(key("wall.upper.position").unit(), Some("m"));
        assert_eq!(key("initial.displacement.3").unit(), Some("m"));
        assert_eq!(key("penalty.epsilon.0").unit(), Some("m3_per_N"));
        assert_eq!(key("system.beam.left.rotational").unit(), Some("N_m_per_rad"));
        assert_eq!(key("initial.displacement.3").word(), "displacement");
        assert_eq!(key("wall.*.at.position").word(), "position");
        // A field may be given by bodies, which the case names, by planes and by points.
        for path in ["initial.velocity.rod", "initial.velocity.y.dofs.0.1", "initial.velocity.rod.profile.1.1"] {
            assert_eq!((key(path).pattern().as_str(), key(path).unit()), ("initial.velocity", Some("m_per_s")));
        }
        assert_eq!(key("system.modal.shapes.tip.0").pattern(), "system.modal.shapes");
    }

    #[test]
    fn what_is_no_key_is_refused_with_the_one_that_was_meant() {
        for (text, meant) in [
            ("wall.upper.restituton", "did you mean wall.upper.restitution?"),
            ("load.1.harmonic.frequncy", "did you mean load.1.harmonic.frequency?"),
            ("system.oscilator.mass", "did you mean system.oscillator.mass?"),
            ("tim.end", "there is title, source, system"),
            ("wall", "there is wall."),
        ] {
            let error = text.parse::<Key>().unwrap_err();
            assert!(error.is_request() && error.to_string().contains(meant), "{error}");
        }
        assert!("wall..restitution".parse::<Key>().is_err() && "".parse::<Key>().is_err());
    }
}
