//! Errors that show the position in the file: what is wrong, file, line and column, the line
//! itself, and what would be accepted.

use super::schema::{accepted, is_list};
use crate::error::{Error, escaped};
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use std::borrow::Cow;
use std::ops::Range;

/// A text that was read, and its name in messages.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Source<'a> {
    pub name: &'a str,
    pub text: &'a str,
}

/// Most bytes of a line that are marked.
const MOST_MARKED: usize = 80;

/// Most characters of a title, since it may quote the file.
const MOST_QUOTED: usize = 160;

/// `title` with its middle removed if it is long.
fn shortened(title: &str) -> Cow<'_, str> {
    let count = title.chars().count();
    if count <= MOST_QUOTED {
        return Cow::Borrowed(title);
    }
    let head: String = title.chars().take(MOST_QUOTED * 3 / 4).collect();
    let tail: String = title.chars().skip(count - MOST_QUOTED / 4).collect();
    Cow::Owned(format!("{head} … {tail}"))
}

impl Source<'_> {
    /// The error `title` at `span` (bytes of the text), with what would be accepted.
    pub fn error(&self, span: Range<usize>, title: &str, help: &str) -> Error {
        self.error_with_note(span, title, help, None)
    }

    /// The same, with a remark below.
    pub fn error_with_note(&self, span: Range<usize>, title: &str, help: &str, note: Option<&str>) -> Error {
        let place = AnnotationKind::Primary.span(self.marked(span));
        let title = escaped(title);
        let mut report = Level::ERROR
            .primary_title(shortened(&title))
            .element(Snippet::source(self.text).path(self.name).annotation(place))
            .element(Level::HELP.message(help));
        if let Some(note) = note {
            report = report.element(Level::NOTE.message(note));
        }
        Error::Case { report: Renderer::plain().render(&[report]), cause: None }
    }

    /// The text at `span`.
    pub fn slice(&self, span: Range<usize>) -> &str {
        self.text.get(self.within(span)).unwrap_or_default()
    }

    /// `span`, shortened to the part of a line that is shown, since the renderer cuts off the rest
    /// of the line.
    fn marked(&self, span: Range<usize>) -> Range<usize> {
        let Range { start, end } = self.within(span);
        let mut most = end.min(start + MOST_MARKED);
        while !self.text.is_char_boundary(most) {
            most -= 1;
        }
        start..most
    }

    /// The part of `span` on its first line, within the text and between whole characters.
    fn within(&self, span: Range<usize>) -> Range<usize> {
        let floor = |mut at: usize| {
            at = at.min(self.text.len());
            while !self.text.is_char_boundary(at) {
                at -= 1;
            }
            at
        };
        let start = floor(span.start);
        let end = floor(span.end).max(start);
        let line = self.text.get(start..end).and_then(|s| s.lines().next()).map_or(0, str::len);
        start..start + line
    }

    /// The error of a text that is not TOML, in the terms of a case file.
    pub fn toml(&self, mut error: toml::de::Error) -> Error {
        error.set_input(None);
        let span = error.span().unwrap_or(0..0);
        let message = error.message();
        let (title, wanted) = message.split_once(", expected ").unwrap_or((message, "TOML"));
        if title == "duplicate key" {
            let key = self.slice(span.clone());
            let title = format!("duplicate key `{key}`");
            let help = match key {
                list if is_list(list) => accepted(list).unwrap_or_default(),
                _ => "each key once in a table".to_owned(),
            };
            return self.error(span, &title, &format!("expected {help}"));
        }
        let path = self.key_at(span.start);
        if let Some((comma, number)) = self.decimal_comma(span.start) {
            let key = if path.is_empty() { String::new() } else { format!("`{path}`: ") };
            let takes = accepted(&path).map_or_else(String::new, |takes| format!("; {takes}"));
            let help = format!("expected a decimal point, {}{takes}", number.replace(',', "."));
            return self.error(comma, &format!("{key}{number} has a decimal comma"), &help);
        }
        match accepted(&path) {
            Some(wanted) => self.error(span, &format!("`{path}`: {title}"), &format!("expected {wanted}")),
            None => {
                let help =
                    format!("expected {wanted}: a case file has [table] lines with `key = value` lines below them");
                self.error(span, title, &help)
            }
        }
    }

    /// The error for a number beyond those of 64 bits.
    pub fn overflow(&self, span: Range<usize>) -> Error {
        let path = self.key_at(span.start);
        let help = accepted(&path).unwrap_or_else(|| "a number up to 1.8e308".to_owned());
        self.error(span, &format!("`{path}`: number overflow"), &format!("expected {help}"))
    }

    /// The number with a decimal comma on the line of the byte `at`, such as `0,5` in `gap = 0,5`,
    /// and the position of its comma.
    fn decimal_comma(&self, at: usize) -> Option<(Range<usize>, &str)> {
        let before = self.text.get(..at)?;
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let line = self.text.get(start..)?.lines().next()?;
        let value = line.split_once('=')?.1.split('#').next()?.trim();
        let (whole, part) = value.split_once(',')?;
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let (fraction, exponent) = part.split_once(['e', 'E']).unwrap_or((part, "0"));
        let number = digits(whole.trim_start_matches(['+', '-']))
            && digits(fraction)
            && digits(exponent.trim_start_matches(['+', '-']));
        let comma = start + line.find(value).filter(|_| number)? + whole.len();
        Some((comma..comma + 1, value))
    }

    /// Path of the key on the line of the byte `at`, as far as single lines show it.
    fn key_at(&self, at: usize) -> String {
        let mut table = "";
        let mut key = "";
        let mut start = 0;
        for line in self.text.split_inclusive('\n') {
            if start > at {
                break;
            }
            start += line.len();
            let line = line.trim();
            key = line.split('=').next().filter(|_| line.contains('=')).unwrap_or_default().trim();
            if let Some(header) = line.strip_prefix('[').filter(|_| key.is_empty()) {
                table = header.trim_start_matches('[').split(']').next().unwrap_or_default().trim();
            }
        }
        if table.is_empty() { key.to_owned() } else { format!("{table}.{key}") }
    }
}
