//! The table of schemes in README.md says what the schemes' entries say.

use signorini::Scheme;
use std::fs::read_to_string;

#[test]
fn the_table_of_schemes_in_the_readme_is_that_of_the_entries() {
    let readme = read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).expect("README.md");
    let mut rows = readme.lines().skip_while(|line| !line.starts_with("| scheme | for |")).skip(2);
    for entry in Scheme::ALL.map(|scheme| scheme.entry()) {
        let default = if entry.default.is_empty() { String::new() } else { format!(" ({})", entry.default) };
        let row = format!("| `{}`{default} | {} | {} | {} |", entry.name, entry.purpose, entry.realises, entry.fails);
        assert_eq!(rows.next(), Some(&*row));
    }
    assert_eq!(rows.next(), Some(""), "a scheme without an entry");
}
