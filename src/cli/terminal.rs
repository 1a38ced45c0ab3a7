//! Lines on a terminal: as wide as it is, broken between words.

use crate::error::escaped_lines;
use std::io::{self, Write};
use std::os::fd::AsFd;

/// Prints text on stderr; on a terminal its lines break between words. If stderr is closed, the
/// text is lost.
pub(super) fn print_message(text: &str) {
    let _ = writeln!(io::stderr(), "{}", wrapped(&escaped_lines(text), width(&io::stderr())));
}

/// Columns of text that `stream` has: `COLUMNS`, else those of the terminal; `None` for a file or a
/// pipe, which take any width.
pub(super) fn width(stream: &impl AsFd) -> Option<usize> {
    let asked = std::env::var("COLUMNS").ok().and_then(|text| text.trim().parse::<usize>().ok()).filter(|&n| n > 0);
    asked.or_else(|| terminal_size::terminal_size_of(stream).map(|(width, _)| usize::from(width.0)))
}

/// The text with its lines broken between words, so that none has more than `width` columns unless
/// a single word has. A line that goes on is indented by two columns more than it began with.
pub(super) fn wrapped(text: &str, width: Option<usize>) -> String {
    let Some(width) = width else { return text.to_owned() };
    let mut lines: Vec<String> = Vec::new();
    for line in text.split('\n') {
        if line.chars().count() <= width {
            lines.push(line.to_owned());
            continue;
        }
        let begin = line.chars().take_while(|c| *c == ' ').count();
        let (mut now, mut columns, mut words) = (" ".repeat(begin), begin, 0);
        for word in line.split_whitespace() {
            let length = word.chars().count();
            if words > 0 && columns + 1 + length > width {
                lines.push(std::mem::replace(&mut now, " ".repeat(begin + 2)));
                (columns, words) = (begin + 2, 0);
            }
            if words > 0 {
                now.push(' ');
                columns += 1;
            }
            now.push_str(word);
            (columns, words) = (columns + length, words + 1);
        }
        lines.push(now);
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn lines_break_between_words_and_a_word_that_is_too_long_stays_whole() {
        let text = "note: the body stays on the wall\n  and an indented line of seven words";
        assert_eq!(wrapped(text, None), text);
        let lines = "note: the body\n  stays on the\n  wall\n  and an\n    indented\n    line of\n    seven words";
        assert_eq!(wrapped(text, Some(15)), lines);
        assert_eq!(wrapped("results in /a/very/long/path", Some(12)), "results in\n  /a/very/long/path");
        assert_eq!(wrapped("θ = ½ and φ", Some(5)), "θ = ½\n  and\n  φ");
    }
}
