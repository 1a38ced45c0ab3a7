//! Text: escaped for XML, its width estimated without a font, wrapped and shortened.

/// Escapes `text` for element content and attribute values; characters that XML 1.0 forbids become
/// spaces.
pub(super) fn escape_into(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => out.push(' '),
            c => out.push(c),
        }
    }
}

/// Upper estimate of the width of `text` at font size `size`: that in DejaVu Sans, the widest
/// common sans-serif font.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' | '\u{a0}' => 0.34,
        '(' | ')' | '[' | ']' | 'f' | 't' | 'r' | '-' | '/' => 0.42,
        'm' | 'w' | 'M' | 'W' | '@' | '%' => 0.99,
        '−' | '+' | '=' | '×' | '<' | '>' | '~' | '±' => 0.84,
        'A'..='Z' | '&' => 0.74,
        '\u{1100}'.. => 1.0,
        _ => 0.64,
    };
    text.chars().map(em).sum::<f64>() * size
}

/// `text`, or its beginning with an ellipsis, no wider than `room`.
pub(super) fn shorten(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut kept = String::new();
    for c in text.chars() {
        kept.push(c);
        if width(&kept, size) + size > room {
            kept.pop();
            break;
        }
    }
    kept.truncate(kept.trim_end().len());
    kept.push('…');
    kept
}

/// `text` broken at spaces (not at no-break spaces) into at most `lines` lines no wider than
/// `room`; what does not fit is replaced by an ellipsis.
pub(super) fn wrap(text: &str, size: f64, room: f64, lines: usize) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut current = String::new();
    for word in
        text.split(|c: char| (c.is_whitespace() && c != '\u{a0}') || c.is_control()).filter(|word| !word.is_empty())
    {
        let longer = if current.is_empty() { word.to_owned() } else { format!("{current} {word}") };
        if current.is_empty() || width(&longer, size) <= room || out.len() + 1 == lines {
            current = longer;
        } else {
            out.push(std::mem::replace(&mut current, word.to_owned()));
        }
        if out.len() + 1 == lines && width(&current, size) > room {
            break;
        }
    }
    if !current.is_empty() {
        out.push(current);
    }
    out.iter().map(|line| shorten(line, size, room)).collect()
}
