//! What all parts of the reader of a case share: what is read so far, and where each value stands.

use super::Written;
use super::case_file::CaseFile;
use super::model::Model;
use super::planes::Planes;
use super::report::Source;
use super::schema::accepted;
use super::value::{Section, Value};
use super::wording::written;
use crate::error::{Error, Part, Result, Subject};
use crate::scene::{Scene, Wall};
use std::ops::Range;
use toml::Spanned;

/// Most masses in a chain.
pub(super) const MOST_MASSES: usize = 1_000_000;

/// Reads a case, table by table.
pub(super) struct Builder<'a> {
    pub source: Source<'a>,
    /// Subjects that an error may name, and the positions of their values.
    pub positions: Vec<(Subject, Range<usize>)>,
    /// The case file, which opens the files that it names.
    pub document: &'a CaseFile,
    /// The table that says what vibrates: "system", or "body" while a body is read.
    pub owner: &'static str,
    pub model: Model,
    pub planes: Planes,
    /// The modes of each plane to which the system is reduced, where the file says how many.
    pub modes: Option<usize>,
    /// Where the spans of a beam end, m, in order.
    pub joints: Vec<f64>,
    /// Wear coefficients that supports name.
    pub materials: Vec<Material>,
    /// The body whose places are read, where there are several.
    pub body: Option<String>,
    /// Degrees of freedom of the structure, or of that body, in one plane; of matrices, of both.
    pub n: usize,
    pub static_correction: bool,
    /// True if the system that is read is afterwards reduced to modes, or damped by ratios once it
    /// is condensed.
    pub is_changed_later: bool,
    pub written: Written,
}

/// The wear coefficients of a pair of materials, 1/Pa: of the tube and of the support.
#[derive(Debug)]
pub(super) struct Material {
    pub name: String,
    pub coefficient: Option<f64>,
    pub support_coefficient: Option<f64>,
}

impl Builder<'_> {
    /// Notes the position of a value under the subject that an error would name.
    pub fn note(&mut self, subject: impl Into<Subject>, at: Option<Range<usize>>) {
        self.positions.extend(at.map(|at| (subject.into(), at)));
    }

    /// The number; its position is noted under the subject that an error would name.
    pub fn number(&mut self, subject: impl Into<Subject>, value: &Spanned<f64>) -> f64 {
        self.positions.push((subject.into(), value.span()));
        *value.get_ref()
    }

    /// The number at `key`, which `section` must have.
    pub fn required(&mut self, subject: impl Into<Subject>, section: &Section<'_>, key: &str) -> f64 {
        self.number(subject, &section.required(key))
    }

    /// The number at `key`, where `section` has one.
    pub fn optional(&mut self, subject: impl Into<Subject>, section: &Section<'_>, key: &str) -> Option<f64> {
        section.number(key).map(|value| self.number(subject, &value))
    }

    pub fn refuse(&self, span: Range<usize>, key: &str, expected: &str) -> Error {
        let title = format!("{key} is {}", self.source.slice(span.clone()));
        self.source.error(span, &title, &format!("expected {expected}"))
    }

    /// The same error, shown at its position in the file; the original error is its source.
    pub fn locate(&self, error: Error, scene: &Scene) -> Error {
        let Error::Invalid { subject, value, expected } = &error else { return error };
        // An initial displacement that is not written is 0: in that case the error is shown at the
        // wall behind which it lies.
        let start = Subject::from(("initial state", "displacement"));
        let wall = || scene.wall_before(&scene.initial.q).filter(|_| *subject == start);
        let outside = |wall: &&Wall| wall.holds_out(&scene.initial.q);
        let hole = || scene.walls.iter().find(outside).filter(|_| *subject == start);
        let span = self
            .noted(subject)
            .or_else(|| wall().and_then(|wall| self.noted(&Subject::wall(&wall.name).part("position"))))
            .or_else(|| self.nearest(subject))
            .or_else(|| hole().and_then(|hole| self.noted(&Subject::support(&hole.name).part("gap"))))
            .unwrap_or(0..0);
        let title = format!("{} is {value}", written(subject, self.owner));
        let or = if wall().is_some() || hole().is_some() {
            "; or equilibrium = true in place of it: at rest between the walls and in the holes"
        } else {
            ""
        };
        self.source.error(span, &title, &format!("expected {expected}{or}")).caused_by(error.clone())
    }

    /// The same error of `what` as that of `owner`, at the key of its table that `span` finds by
    /// its name, or at the table.
    pub fn at_own_key(
        &self,
        [what, owner]: [&str; 2],
        table: &Section<'_>,
        error: Error,
        span: impl Fn(&str) -> Option<Range<usize>>,
    ) -> Error {
        let Error::Invalid { subject, value, expected } = &error else { return error };
        let key = subject.parts().get(1).and_then(|part| if let Part::Name(name) = part { span(name) } else { None });
        let title = format!("{} is {value}", subject.to_string().replacen(what, owner, 1));
        let span = key.unwrap_or(table.span.clone());
        self.source.error(span, &title, &format!("expected {expected}")).caused_by(error.clone())
    }

    pub fn noted(&self, subject: &Subject) -> Option<Range<usize>> {
        self.positions.iter().find(|(s, _)| s == subject).map(|(_, span)| span.clone())
    }

    /// The position of the smallest enclosing part of `subject` that was noted.
    pub fn nearest(&self, subject: &Subject) -> Option<Range<usize>> {
        let whole = subject.enclosing()?;
        self.noted(&whole).or_else(|| self.nearest(&whole))
    }

    /// A list of numbers, with the position of each noted.
    pub fn list(&mut self, key: &str, subject: Subject, items: &[Spanned<Value<'_>>]) -> Result<Vec<f64>> {
        let mut list = Vec::with_capacity(items.len());
        for (i, item) in items.iter().enumerate() {
            let Value::Number(x) = item.get_ref() else { return Err(self.refuse_as(item.span(), key)) };
            self.positions.push((subject.clone().value(i), item.span()));
            list.push(*x);
        }
        Ok(list)
    }

    /// A whole number from 1 to `most`.
    pub fn whole_number(&mut self, subject: impl Into<Subject>, value: &Spanned<f64>, most: usize) -> Result<usize> {
        let subject = subject.into();
        let x = self.number(subject.clone(), value);
        self.count(&written(&subject, self.owner), x, value.span(), most)
    }

    pub fn count(&self, key: &str, x: f64, span: Range<usize>, most: usize) -> Result<usize> {
        if x.fract() == 0.0 && (1.0..=most as f64).contains(&x) {
            Ok(x as usize)
        } else {
            Err(self.refuse(span, key, &format!("a whole number from 1 to {most}")))
        }
    }

    /// An error at a key, with the accepted values of that key.
    pub fn refuse_as(&self, span: Range<usize>, key: &str) -> Error {
        self.refuse(span, key, &accepted(key).unwrap_or_default())
    }
}
