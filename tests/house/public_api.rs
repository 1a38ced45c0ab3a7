//! The public API as a listing, compared with `tests/public_api.txt`: a change of it is seen and
//! meant.
//!
//! `SIGNORINI_UPDATE_API=1 cargo test --test house public_api` writes the listing anew.
//!
//! The listing is read off the sources: what `lib.rs` and the modules that it makes public declare
//! or hand on, each with its fields, variants, methods and traits. Modules under `#[doc(hidden)]`
//! are no part of it.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const LISTING: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/public_api.txt");

/// A source file without comments and tests, by items: the lines of each at no indent, with its
/// attributes.
struct Source {
    path: PathBuf,
    items: Vec<String>,
    /// The types that it declares, whoever may see them.
    types: Vec<String>,
    /// The type and the trait of each `impl` block.
    blocks: Vec<(String, Option<String>, usize)>,
}

/// The type that an item declares, whoever may see it.
fn type_of(item: &str) -> Option<String> {
    let line = declaration(item);
    let line = line.strip_prefix("pub").map_or(line, |rest| rest.split_once(' ').map_or("", |(_, rest)| rest));
    let mut words = line.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    let kind = words.next()?;
    ["struct", "enum", "trait"].contains(&kind).then(|| words.next().map(str::to_owned))?
}

/// How many brackets a line, seen without what is in quotes, opens more than it closes.
fn balance(line: &str) -> i32 {
    let bare: String = line.split('"').step_by(2).collect();
    let bare = bare.replace("'{'", "").replace("'}'", "").replace("'('", "").replace("')'", "");
    bare.chars().map(|c| i32::from("{([".contains(c)) - i32::from("})]".contains(c))).sum()
}

/// An item, with `names!` of `src/error/names.rs` written out.
fn written_out(item: String) -> Vec<String> {
    let Some((of, list)) = item.strip_prefix("names!(").and_then(|rest| rest.split_once([':', ','])) else {
        return vec![item];
    };
    let count = list.matches("=>").count();
    let parse = item.starts_with(&format!("names!({of}:")).then(|| format!("impl FromStr for {of} {{}}"));
    let members = format!("    pub const ALL: [Self; {count}];\n    pub const fn name(self) -> &'static str {{");
    let blocks = [format!("impl {of} {{\n{members}\n}}"), format!("impl fmt::Display for {of} {{}}")];
    blocks.into_iter().chain(parse).collect()
}

fn read(path: &Path) -> Source {
    let text = fs::read_to_string(path).unwrap();
    let (mut items, mut item, mut depth) = (Vec::new(), String::new(), 0);
    for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
        if line.trim().is_empty() && depth == 0 {
            continue;
        }
        item.push_str(line);
        item.push('\n');
        depth += balance(line);
        let ends = line.trim_end().ends_with([';', '}']) || line.trim() == "}";
        if depth == 0 && ends {
            items.extend(written_out(std::mem::take(&mut item)));
        }
    }
    items.retain(|item| !item.contains("#[cfg(test)]"));
    let types = items.iter().filter_map(|item| type_of(item)).collect();
    let block = |(i, item): (usize, &String)| subject(item).map(|(of, what)| (of, what, i));
    let blocks = items.iter().enumerate().filter_map(block).collect();
    Source { path: path.to_owned(), items, types, blocks }
}

/// All sources of a folder, but those compiled for tests only: `tests.rs` and folders `tests`.
fn sources(folder: &Path, found: &mut Vec<Source>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.file_stem().is_some_and(|name| name == "tests") {
            continue;
        } else if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(read(&path));
        }
    }
}

/// `item` on one line, its attributes before it: `non_exhaustive` and derives alone.
fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace("( ", "(").replace(", )", ")")
}

/// The line of an item that declares it, without attributes.
fn declaration(item: &str) -> &str {
    item.lines().find(|line| !line.starts_with("#[") && !line.starts_with([' ', ')', ']'])).unwrap_or_default()
}

/// What an item declares: kind and name.
fn declared(item: &str) -> Option<(&str, &str)> {
    let line = declaration(item).strip_prefix("pub ")?;
    let line = line.strip_prefix("const fn ").map_or(line, |_| &line["const ".len()..]);
    let (kind, rest) = line.split_once(' ')?;
    let name = rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()?;
    ["struct", "enum", "trait", "fn", "const", "type", "mod"].contains(&kind).then_some((kind, name))
}

/// The names that `pub use …;` hands on, with the first segment of the path that they come from.
fn handed_on(item: &str) -> Vec<(String, String)> {
    let Some(start) = item.find("pub use ") else { return Vec::new() };
    let path = flat(&item[start + "pub use ".len()..]).trim_end_matches(';').to_owned();
    // `super` of a file is the folder that it stands in.
    let from = path.split("::").find(|segment| *segment != "super").unwrap_or_default().to_owned();
    let from = if path.starts_with("super::") { format!("../{from}") } else { from };
    let (_, names) = path.rsplit_once("::").unwrap_or(("", &path));
    let names = names.trim_matches(['{', '}', ' ']).split(',').map(str::trim).filter(|name| !name.is_empty());
    names.map(|name| (name.to_owned(), from.clone())).collect()
}

/// The signature of a function, up to its body.
fn signature(text: &str) -> String {
    let mut depth = 0;
    for (i, c) in text.char_indices() {
        depth += i32::from("([".contains(c)) - i32::from(")]".contains(c));
        if depth == 0 && (c == '{' || c == ';') {
            return flat(&text[..i]);
        }
    }
    flat(text)
}

/// The public members of an `impl` block, or all of a trait's, each as a signature.
fn members(block: &str, all: bool) -> Vec<String> {
    let lines: Vec<&str> = block.lines().collect();
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let member = line.strip_prefix("    ").filter(|line| !line.starts_with(' '));
        let wanted = |line: &str| line.starts_with("pub ") && !line.starts_with("pub(");
        let kept = |line: &str| wanted(line) || (all && ["fn ", "type ", "const "].iter().any(|k| line.starts_with(k)));
        let hidden = i > 0 && lines[i - 1].trim() == "#[doc(hidden)]";
        if member.is_some_and(kept) && !hidden {
            found.push(signature(&lines[i..].join("\n")));
        }
    }
    found
}

/// Fields of a struct or variants of an enum: its own lines without attributes.
fn body(item: &str, kind: &str) -> Vec<String> {
    let start = item.find(declaration(item)).unwrap_or(0);
    let lines = item[start..].lines().skip(1).filter(|line| !line.trim_start().starts_with("#["));
    match kind {
        "struct" => lines.filter(|line| line.starts_with("    pub ")).map(flat).collect(),
        _ => lines.filter(|line| line.len() > 1).map(flat).collect(),
    }
}

/// The type that an `impl` block is for, and the trait, if any.
fn subject(item: &str) -> Option<(String, Option<String>)> {
    let header = flat(declaration(item).strip_prefix("impl")?.split(" {").next()?);
    let mut rest = header.as_str();
    if rest.starts_with('<') {
        let mut depth = 0;
        let end = rest.char_indices().find(|(_, c)| {
            depth += i32::from(*c == '<') - i32::from(*c == '>');
            depth == 0
        })?;
        rest = &rest[end.0 + 1..];
    }
    let name =
        |text: &str| text.trim().split(['<', ' ']).next().unwrap_or_default().rsplit("::").next().map(str::to_owned);
    match rest.split_once(" for ") {
        Some((of, to)) => Some((name(to)?, Some(of.trim().to_owned()))),
        None => Some((name(rest)?, None)),
    }
}

fn describe(sources: &[Source], place: &Path, name: &str) -> String {
    let mut text = String::new();
    let inside = |source: &&Source| source.path.starts_with(place) || source.path == place.with_extension("rs");
    for source in sources.iter().filter(inside) {
        for item in &source.items {
            let Some((kind, _)) = declared(item).filter(|(_, found)| *found == name) else { continue };
            if item.contains("#[doc(hidden)]\npub") {
                continue;
            }
            if item.contains("#[non_exhaustive]") {
                text.push_str("    #[non_exhaustive]\n");
            }
            for derive in item.lines().filter(|line| line.starts_with("#[derive")) {
                let _ = writeln!(text, "    {derive}");
            }
            let start = item.find(declaration(item)).unwrap_or(0);
            let _ = writeln!(text, "    {}", signature(&item[start..]));
            let lines = match kind {
                "struct" | "enum" => body(item, kind),
                "trait" => members(item, true),
                _ => Vec::new(),
            };
            lines.iter().for_each(|line| _ = writeln!(text, "        {line}"));
        }
    }
    let mut traits = Vec::new();
    // Several rooms may have a type of the name: a block is of the one that stands nearest.
    let declaring: Vec<&Source> = sources.iter().filter(|s| s.types.iter().any(|t| t == name)).collect();
    let near = |source: &Source| {
        let shared = |other: &Source| source.path.iter().zip(other.path.iter()).take_while(|(a, b)| a == b).count();
        declaring.iter().max_by_key(|other| (shared(other), inside(other))).is_some_and(inside)
    };
    for source in sources {
        for (_, what, item) in source.blocks.iter().filter(|(of, ..)| of == name) {
            match what {
                _ if !near(source) => {}
                Some(of) => traits.push(of.clone()),
                None => members(&source.items[*item], false).iter().for_each(|m| _ = writeln!(text, "    {m}")),
            }
        }
    }
    traits.sort();
    if !traits.is_empty() {
        let _ = writeln!(text, "    impl {}", traits.join(", "));
    }
    text
}

/// Adds what the module `path`, in `file`, makes public.
fn visit(sources: &[Source], path: &str, file: &Path, listing: &mut BTreeMap<String, String>) {
    let Some(source) = sources.iter().find(|source| source.path == file) else { panic!("{}", file.display()) };
    let folder = if ["mod", "lib"].iter().any(|own| file.file_stem().is_some_and(|stem| stem == *own)) {
        file.parent().unwrap().to_owned()
    } else {
        file.with_extension("")
    };
    for item in source.items.iter().filter(|item| !item.contains("#[doc(hidden)]")) {
        for (name, from) in handed_on(item) {
            let place = match from.strip_prefix("../") {
                Some(beside) => folder.parent().unwrap().join(beside),
                None => folder.join(&from),
            };
            listing.insert(format!("{path}::{name}"), describe(sources, &place, &name));
        }
        match declared(item) {
            Some(("mod", name)) => {
                let [beside, below] = [folder.join(format!("{name}.rs")), folder.join(name).join("mod.rs")];
                visit(sources, &format!("{path}::{name}"), if beside.is_file() { &beside } else { &below }, listing);
            }
            Some((_, name)) => {
                listing.insert(format!("{path}::{name}"), describe(sources, file, name));
            }
            None => {}
        }
    }
}

#[test]
fn the_public_api_is_the_one_that_is_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    sources(&root, &mut all);
    let mut listing = BTreeMap::new();
    visit(&all, "signorini", &root.join("lib.rs"), &mut listing);
    assert!(listing.len() > 150, "only {} names found", listing.len());
    let empty: Vec<&String> = listing.iter().filter(|(_, text)| text.is_empty()).map(|(name, _)| name).collect();
    assert!(empty.iter().all(|name| name.ends_with("matrices")), "nothing is known of {empty:?}");
    let found: String = listing.iter().map(|(name, text)| format!("{name}\n{text}")).collect();
    if std::env::var_os("SIGNORINI_UPDATE_API").is_some() {
        fs::write(LISTING, &found).unwrap();
    }
    let known = fs::read_to_string(LISTING).unwrap_or_default();
    let differs = found.lines().zip(known.lines()).find(|(found, known)| found != known);
    assert!(
        found == known,
        "the public API has changed, first at {differs:?} (found, listed): if that is meant, \
         SIGNORINI_UPDATE_API=1 cargo test --test house public_api writes {LISTING} anew"
    );
}
