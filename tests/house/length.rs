//! Functions are short enough to read at once, and files hold one noun.

use std::fs;
use std::path::{Path, PathBuf};

/// Lines of a function beyond which a comment within its first lines has to begin with [`REASON`].
const FUNCTION: usize = 60;

/// What the reason of a longer function begins with.
const REASON: &str = "// In one piece";

/// Lines of any function.
const LONGEST: usize = 80;

/// All Rust files of the library and the tool, without those of tests.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && name != "tests" {
            sources(&path, found);
        } else if name.ends_with(".rs") && name != "tests.rs" {
            found.push(path);
        }
    }
}

/// The first line of each function of `lines`, and the line after its last.
fn functions(lines: &[&str]) -> Vec<(usize, usize)> {
    let end = lines.windows(2).position(|two| two[0] == "#[cfg(test)]" && two[1].starts_with("mod tests {"));
    let lines = &lines[..end.unwrap_or(lines.len())];
    let begins = |line: &str| {
        let words = line.split_whitespace().take_while(|word| *word != "fn");
        line.contains("fn ")
            && words.clone().count() < line.split_whitespace().count()
            && words
                .into_iter()
                .all(|word| word.starts_with("pub") || ["in", "const", "async"].contains(&word) || word.ends_with(')'))
    };
    let indent = |line: &str| line.len() - line.trim_start().len();
    let closing = |from: usize| {
        let brace = format!("{}}}", " ".repeat(indent(lines[from])));
        (from..lines.len()).find(|&at| lines[at] == brace)
    };
    // A signature alone, as in a trait, has no body.
    let of = |(from, line): (usize, &&str)| {
        (begins(line) && !line.ends_with(';')).then(|| closing(from)).flatten().map(|last| (from, last + 1))
    };
    lines.iter().enumerate().filter_map(of).collect()
}

#[test]
fn a_function_is_at_most_sixty_lines_or_says_why_it_is_more() {
    let mut files = Vec::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    sources(&root.join("src"), &mut files);
    sources(&root.join("python/rust"), &mut files);
    let (mut long, mut seen) = (Vec::new(), 0);
    for path in files {
        let text = fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        for (from, end) in functions(&lines) {
            seen += 1;
            let explained = lines[from..(from + 15).min(end)].iter().any(|line| line.trim_start().starts_with(REASON));
            if end - from > if explained { LONGEST } else { FUNCTION } {
                long.push(format!("{}:{}: {} lines", path.display(), from + 1, end - from));
            }
        }
    }
    // The search finds functions at all.
    assert!(seen > 4000, "{seen}");
    assert!(long.is_empty(), "more than {FUNCTION} lines without `{REASON}`, or than {LONGEST}: {long:#?}");
}
