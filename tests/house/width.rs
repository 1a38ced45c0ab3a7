//! Lines are short enough to read side by side, and rustfmt can format all of them.

use std::fs;
use std::path::{Path, PathBuf};

/// What comments and Markdown are wrapped at.
const PROSE: usize = 100;

/// What rustfmt.toml allows for code. A line of more is a string for which rustfmt gives up
/// formatting the whole expression.
const CODE: usize = 120;

const FOLDERS: [&str; 8] = ["src", "tests", "benches", "examples", "figure", "python", "docs", "cases"];

fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() && !name.starts_with('.') && name != "target" {
            files(&path, ending, found);
        } else if name.ends_with(ending) {
            found.push(path);
        }
    }
}

/// The places of wide lines in all files of this ending, by what is too wide at a line's number,
/// its text, and whether it stands in a fenced block.
fn wide(ending: &str, most: impl Fn(&str, bool) -> usize) -> Vec<String> {
    let (root, mut found) = (Path::new(env!("CARGO_MANIFEST_DIR")), Vec::new());
    for folder in FOLDERS {
        files(&root.join(folder), ending, &mut found);
    }
    for name in ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md"] {
        found.extend(name.ends_with(ending).then(|| root.join(name)));
    }
    assert!(found.len() > 5, "{ending}: {found:?}");
    let mut wide = Vec::new();
    for path in found {
        let text = fs::read_to_string(&path).unwrap();
        let mut fenced = false;
        for (index, line) in text.lines().enumerate() {
            let bare = line.trim_start().trim_start_matches(['/', '!']).trim_start();
            fenced ^= bare.starts_with("```");
            if line.chars().count() > most(line, fenced) {
                wide.push(format!("{}:{}", path.strip_prefix(root).unwrap().display(), index + 1));
            }
        }
    }
    wide
}

#[test]
fn markdown_is_wrapped_but_for_tables_and_what_programs_print() {
    let wide = wide(".md", |line, fenced| if line.starts_with('|') || fenced { usize::MAX } else { PROSE });
    assert!(wide.is_empty(), "more than {PROSE} columns: {wide:#?}");
}

#[test]
fn comments_are_wrapped_and_no_line_is_too_wide_for_rustfmt() {
    // Tables cannot be wrapped, and those of wrong case files are kept from rustfmt on purpose:
    // a line of them is a mistake, where it is, and what is said of it.
    let wide = wide(".rs", |line, fenced| match line.trim_start() {
        row if row.starts_with("//! |") || row.starts_with("/// |") => usize::MAX,
        row if row.starts_with("(\"") => usize::MAX,
        comment if comment.starts_with("//") && !fenced => PROSE,
        _ => CODE,
    });
    assert!(wide.is_empty(), "comments of more than {PROSE} columns, or code of {CODE}: {wide:#?}");
}
