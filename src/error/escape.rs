//! Control characters in names and messages.

use std::borrow::Cow;

/// `name` with its control characters written as `\u{1b}`. A name comes from a file and may hold
/// any of them: a terminal takes some for commands, a newline breaks the line of a message, and
/// XML allows none.
pub(crate) fn escaped(name: &str) -> Cow<'_, str> {
    without_controls(name, &[])
}

/// The same of a text of several lines: line breaks and tabs stay.
pub(crate) fn escaped_lines(text: &str) -> Cow<'_, str> {
    without_controls(text, &['\n', '\t'])
}

fn without_controls<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    let refused = |c: char| c.is_control() && !kept.contains(&c);
    if !text.contains(refused) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        if refused(c) { out.extend(c.escape_unicode()) } else { out.push(c) }
    }
    Cow::Owned(out)
}

#[cfg(test)]
mod tests {
    use super::{escaped, escaped_lines};

    #[test]
    fn control_characters_are_escaped_and_nothing_else() {
        let name = "stütze ± \u{1b}[31m\n\0\t\u{9b}\u{7f}";
        assert_eq!(escaped(name), "stütze ± \\u{1b}[31m\\u{a}\\u{0}\\u{9}\\u{9b}\\u{7f}");
        assert_eq!(escaped_lines(name), "stütze ± \\u{1b}[31m\n\\u{0}\t\\u{9b}\\u{7f}");
        assert!(matches!(escaped("upper-1"), std::borrow::Cow::Borrowed(_)));
    }
}
