//! What an error refers to.

use std::borrow::Cow;
use std::fmt;

/// The path to an invalid value, from the whole to the part, in the library's terms: the stiffness
/// of a wall, the second of a chain's masses, an entry of a matrix. A program that read the value
/// from a file can use it to find the place there.
///
/// ```
/// use signorini::{Error, Scene, Subject};
///
/// let refused = Scene::oscillator(-1.0, 0.0, 100.0).validate().unwrap_err();
/// let Error::Invalid { subject, .. } = &refused else { panic!("{refused}") };
/// assert_eq!(*subject, Subject::of("oscillator").part("mass"));
/// assert_eq!(refused.to_string(), "oscillator: mass is -1.0; expected a finite number above 0");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Subject(Vec<Part>);

/// One step of the path.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Part {
    /// Something that exists once, or a field of the part before.
    Name(Cow<'static, str>),
    /// One of several of a kind, by its name: wall "upper".
    Named(&'static str, String),
    /// One of several of a kind, by its number, from 1: load 2.
    Numbered(&'static str, usize),
    /// Row of a table, from 1.
    Row(usize),
    /// Row and column of a matrix, from 1.
    Entry(usize, usize),
}

impl Subject {
    /// Something that exists once.
    #[must_use]
    pub fn of(name: impl Into<Cow<'static, str>>) -> Self {
        Self(vec![Part::Name(name.into())])
    }

    /// The wall of that name.
    #[must_use]
    pub fn wall(name: &str) -> Self {
        Self(vec![Part::Named("wall", name.to_owned())])
    }

    /// The probe of that name.
    #[must_use]
    pub fn probe(name: &str) -> Self {
        Self(vec![Part::Named("probe", name.to_owned())])
    }

    /// The support of that name.
    #[must_use]
    pub fn support(name: &str) -> Self {
        Self(vec![Part::Named("support", name.to_owned())])
    }

    /// The slider of that name.
    #[must_use]
    pub fn slider(name: &str) -> Self {
        Self(vec![Part::Named("slider", name.to_owned())])
    }

    /// Item `index`, from 0, of several of a kind: a load, a wall, a penalty law.
    #[must_use]
    pub fn nth(kind: &'static str, index: usize) -> Self {
        Self(vec![Part::Numbered(kind, index + 1)])
    }

    /// A field of this subject.
    #[must_use]
    pub fn part(self, name: impl Into<Cow<'static, str>>) -> Self {
        self.then(Part::Name(name.into()))
    }

    /// Item `index`, from 0, of a list.
    #[must_use]
    pub fn value(self, index: usize) -> Self {
        self.then(Part::Numbered("value", index + 1))
    }

    /// Row `index`, from 0, of a table.
    #[must_use]
    pub fn row(self, index: usize) -> Self {
        self.then(Part::Row(index + 1))
    }

    /// The entry of row `i` and column `j`, from 0, of a matrix.
    #[must_use]
    pub fn entry(self, i: usize, j: usize) -> Self {
        self.then(Part::Entry(i + 1, j + 1))
    }

    /// The same subject as a part of `whole`.
    #[must_use]
    pub fn within(self, whole: Self) -> Self {
        Self(whole.0.into_iter().chain(self.0).collect())
    }

    fn then(mut self, part: Part) -> Self {
        self.0.push(part);
        self
    }

    /// Its parts, beginning with the whole.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.0
    }

    /// The subject that it is a part of; `None` for a whole.
    #[must_use]
    pub fn enclosing(&self) -> Option<Self> {
        match self.0.split_last() {
            Some((_, before)) if !before.is_empty() => Some(Self(before.to_vec())),
            _ => None,
        }
    }
}

impl From<&'static str> for Subject {
    fn from(name: &'static str) -> Self {
        Self::of(name)
    }
}

impl From<String> for Subject {
    fn from(name: String) -> Self {
        Self::of(name)
    }
}

impl From<(&'static str, &'static str)> for Subject {
    fn from((whole, part): (&'static str, &'static str)) -> Self {
        Self::of(whole).part(part)
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, part) in self.0.iter().enumerate() {
            let colon = if i > 0 { ": " } else { "" };
            match part {
                Part::Name(name) => write!(f, "{colon}{name}")?,
                Part::Named(kind, name) => write!(f, "{colon}{kind} {name:?}")?,
                Part::Numbered(kind, number) => write!(f, "{colon}{kind} {number}")?,
                Part::Row(row) => write!(f, ", row {row}")?,
                Part::Entry(row, column) => write!(f, ", row {row}, column {column}")?,
            }
        }
        Ok(())
    }
}
