//! The tables of schemes in README.md and docs/researcher.md say what the schemes' entries say.

use signorini::Scheme;
use signorini::scheme::SchemeEntry;
use std::fs::read_to_string;
use std::path::Path;

/// The rows of the table under the line `head` of a page, where each scheme has one, in order.
fn check(page: &str, head: &str, row: impl Fn(&SchemeEntry) -> String) {
    let text = read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).expect(page);
    let mut rows = text.lines().skip_while(|line| *line != head).skip(2);
    for scheme in Scheme::ALL {
        assert_eq!(rows.next(), Some(&*row(scheme.entry())), "{page}");
    }
    assert_eq!(rows.next(), Some(""), "{page}: a scheme without an entry");
}

#[test]
fn the_tables_of_schemes_are_those_of_the_entries() {
    check("README.md", "| scheme | for |", |entry| format!("| `{}` | {} |", entry.name, entry.purpose));
    let head = "| scheme | for | restitution it realises | where it fails |";
    check("docs/researcher.md", head, |entry| {
        let default = if entry.default.is_empty() { String::new() } else { format!(" ({})", entry.default) };
        format!("| `{}`{default} | {} | {} | {} |", entry.name, entry.purpose, entry.realises, entry.fails)
    });
}
