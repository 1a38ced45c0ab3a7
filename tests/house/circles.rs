//! No two files import each other, directly or through others: every file can be read after those
//! it builds on, and moved without them.
//!
//! A `use` or a path in code counts as an import of the file that defines the name; a name
//! re-exported by a room's `mod.rs` (`pub use`) counts for the file that defines it. Test modules
//! are not counted.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Path of a module in the crate: `["study", "horizon"]`.
type Module = Vec<String>;

/// What one file names.
#[derive(Default)]
struct File {
    /// Paths that it uses, as written.
    used: Vec<Vec<String>>,
    /// Paths that it re-exports.
    handed_on: Vec<Vec<String>>,
}

fn read(folder: &Path, module: &[String], files: &mut BTreeMap<Module, File>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let below = || module.iter().cloned().chain([name.clone()]).collect::<Module>();
        if path.is_dir() {
            read(&path, &below(), files);
        } else if path.extension().is_some_and(|e| e == "rs") && name != "main" {
            let own = if name == "mod" || name == "lib" { module.to_vec() } else { below() };
            files.insert(own, scan(&fs::read_to_string(&path).unwrap()));
        }
    }
}

/// The code of a file without comments and without its test module.
fn code(text: &str) -> String {
    let production = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    production.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

fn scan(text: &str) -> File {
    let mut file = File::default();
    let mut body = String::new();
    for statement in code(text).split_inclusive(';') {
        match use_tree(statement) {
            Some((public, before, tree)) => {
                let into = if public { &mut file.handed_on } else { &mut file.used };
                expand(tree, &[], into);
                body.push_str(before);
            }
            None => body.push_str(statement),
        }
    }
    file.used.extend(paths(&body));
    file
}

/// A statement that ends in `use …;`: whether it is public, what stands before it, and its tree.
fn use_tree(statement: &str) -> Option<(bool, &str, &str)> {
    let at = statement.rfind("use ")?;
    let before = &statement[..at];
    let line = before.rsplit('\n').next().unwrap_or_default().trim();
    let public = line.starts_with("pub");
    (line.is_empty() || public).then(|| (public, before, statement[at + 4..].trim_end_matches(';')))
}

/// Writes every path of a use tree such as `super::{a, b::{c, d as e}}` to `out`.
fn expand(tree: &str, prefix: &[String], out: &mut Vec<Vec<String>>) {
    let (mut depth, mut start) = (0, 0);
    let mut parts = Vec::new();
    for (at, character) in tree.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&tree[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&tree[start..]);
    for part in parts.into_iter().map(str::trim).filter(|part| !part.is_empty()) {
        let (path, inner) = match part.split_once('{') {
            Some((path, inner)) => (path, inner.strip_suffix('}')),
            None => (part.split(" as ").next().unwrap_or_default(), None),
        };
        let names = path.split("::").map(|name| name.trim().to_owned()).filter(|name| !name.is_empty());
        let whole: Vec<String> = prefix.iter().cloned().chain(names).collect();
        match inner {
            Some(inner) => expand(inner, &whole, out),
            None => out.push(whole),
        }
    }
}

/// Paths of lower-case modules that end in a name, wherever they stand in code.
fn paths(body: &str) -> Vec<Vec<String>> {
    let is_path = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == ':';
    body.split(|c: char| !is_path(c))
        .filter(|word| word.contains("::") && word.starts_with(|c: char| c.is_ascii_lowercase()))
        .map(|word| word.split("::").map(str::to_owned).filter(|name| !name.is_empty()).collect())
        .collect()
}

/// The file that defines what `path`, written in `module`, names; none for other crates and whole
/// modules.
fn resolve(files: &BTreeMap<Module, File>, module: &[String], path: &[String], depth: usize) -> Option<Module> {
    let supers = path.iter().take_while(|name| *name == "super").count();
    let (mut base, mut rest): (Module, _) = match path.first()?.as_str() {
        "crate" => (Vec::new(), &path[1..]),
        "self" => (module.to_vec(), &path[1..]),
        "super" => (module[..module.len().checked_sub(supers)?].to_vec(), &path[supers..]),
        name => {
            files.get(&[module, &[name.to_owned()]].concat())?;
            (module.to_vec(), path)
        }
    };
    while let Some(next) = rest.first().map(|name| [&base[..], std::slice::from_ref(name)].concat()) {
        if !files.contains_key(&next) {
            break;
        }
        (base, rest) = (next, &rest[1..]);
    }
    let name = rest.first()?;
    let handed = files.get(&base)?.handed_on.iter().find(|path| path.last() == Some(name));
    match handed {
        Some(path) if depth < 8 => resolve(files, &base, path, depth + 1),
        _ => Some(base),
    }
}

/// Every file that can be reached from `start`.
fn reached(imports: &BTreeMap<Module, BTreeSet<Module>>, start: &Module) -> BTreeSet<Module> {
    let (mut seen, mut waiting) = (BTreeSet::new(), vec![start.clone()]);
    while let Some(file) = waiting.pop() {
        for next in imports.get(&file).into_iter().flatten() {
            if seen.insert(next.clone()) {
                waiting.push(next.clone());
            }
        }
    }
    seen
}

#[test]
fn no_file_imports_itself_through_others() {
    let mut files = BTreeMap::new();
    read(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &[], &mut files);
    let mut imports: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
    for (module, file) in &files {
        let targets = file.used.iter().filter_map(|path| resolve(&files, module, path, 0));
        imports.insert(module.clone(), targets.filter(|target| target != module).collect());
    }
    let count: usize = imports.values().map(BTreeSet::len).sum();
    // Guards the scan itself: it would also pass if it found no imports.
    assert!(count > 700, "only {count} imports found");
    let reach: BTreeMap<&Module, BTreeSet<Module>> =
        imports.keys().map(|module| (module, reached(&imports, module))).collect();
    let mut circles = BTreeSet::new();
    for (module, far) in &reach {
        if far.contains(*module) {
            let circle: BTreeSet<String> =
                far.iter().filter(|other| reach[other].contains(*module)).map(|other| other.join("::")).collect();
            circles.insert(circle);
        }
    }
    assert!(circles.is_empty(), "files that import each other: {circles:#?}");
}

#[test]
fn the_scan_reads_trees_paths_and_hands() {
    let file =
        scan("pub use a::{B, c::D as E};\nuse super::{f::G, H};\n// use super::X;\nfn i() { j::k(); crate::l::M }");
    let joined = |paths: &[Vec<String>]| paths.iter().map(|path| path.join("::")).collect::<Vec<_>>();
    assert_eq!(joined(&file.handed_on), ["a::B", "a::c::D"]);
    assert_eq!(joined(&file.used), ["super::f::G", "super::H", "j::k", "crate::l::M"]);
}
