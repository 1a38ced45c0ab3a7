//! Imports go one way, and ARCHITECTURE.md names what exists.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms from the ground up: each may import those before it.
const ROOMS: [&str; 17] = [
    "error",
    "linear",
    "scene",
    "qp",
    "flow",
    "step",
    "contact",
    "trajectory",
    "time",
    "residual",
    "statistics",
    "scheme",
    "run",
    "study",
    "case",
    "output",
    "cli",
];

/// Rooms that must not meet although the order would let them.
const STRANGERS: [(&str, &str); 6] = [
    ("qp", "scene"),
    ("residual", "qp"),
    ("residual", "scheme"),
    ("flow", "qp"),
    ("study", "case"),
    ("study", "output"),
];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

fn room_of(path: &Path) -> String {
    let inside = path.strip_prefix(concat!(env!("CARGO_MANIFEST_DIR"), "/src")).unwrap();
    let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
    let room = first.trim_end_matches(".rs");
    // notes.rs is part of the run.
    if room == "notes" { "run".into() } else { room.into() }
}

#[test]
fn a_room_imports_only_rooms_below_it() {
    let mut files = Vec::new();
    sources(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &mut files);
    let rank = |room: &str| ROOMS.iter().position(|r| *r == room);
    let mut checked = 0;
    for file in files {
        let room = room_of(&file);
        if ["lib", "main"].contains(&room.as_str()) {
            continue;
        }
        let own = rank(&room).unwrap_or_else(|| panic!("{room} stands in no layer: {}", file.display()));
        let text = fs::read_to_string(&file).unwrap();
        let code = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
        for import in code.split("crate::").skip(1) {
            let name: String = import.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            let name = if name == "notes" { "run".to_owned() } else { name };
            let Some(other) = rank(&name) else {
                panic!("{} imports crate::{name}, which is no room", file.display());
            };
            assert!(other <= own, "{} ({room}) imports {name}, which stands above it", file.display());
            let strangers = STRANGERS.contains(&(room.as_str(), name.as_str()));
            assert!(!strangers, "{} ({room}) imports {name}: they are to be strangers", file.display());
            checked += 1;
        }
    }
    // Guards the scan itself: a pattern that finds nothing would pass for ever.
    assert!(checked > 80, "only {checked} imports found");
}

/// The files beside it that a file imports.
fn neighbours(file: &Path) -> BTreeSet<String> {
    let text = fs::read_to_string(file).unwrap();
    let code: Vec<_> = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    let before_tests = code.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = BTreeSet::new();
    for (at, _) in before_tests.match_indices("super::") {
        if before_tests[..at].ends_with("super::") {
            continue;
        }
        let rest = &before_tests[at + "super::".len()..];
        let names = match rest.strip_prefix('{') {
            Some(list) => list.split('}').next().unwrap_or_default().split(',').collect(),
            None => vec![rest],
        };
        let word =
            |text: &str| text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
        found.extend(names.into_iter().map(word));
    }
    let beside = |name: &String| {
        let folder = file.parent().unwrap();
        folder.join(format!("{name}.rs")).exists() || folder.join(name).is_dir()
    };
    found.into_iter().filter(beside).collect()
}

#[test]
fn files_of_the_output_and_of_the_tool_import_one_another_in_one_direction() {
    let mut files = Vec::new();
    for room in ["output", "cli"] {
        sources(&Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")).join(room), &mut files);
    }
    let mut imports: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
    // A mod.rs stands for its folder: what its files import of one another is seen file by file.
    for file in files.iter().filter(|file| file.file_name().is_some_and(|name| name != "mod.rs")) {
        let folder = file.parent().unwrap();
        let known = neighbours(file).into_iter().map(|name| folder.join(name)).collect();
        imports.insert(file.with_extension(""), known);
    }
    assert!(imports.values().map(BTreeSet::len).sum::<usize>() > 60, "the scan finds too few imports");
    // Files that import nothing that is left are taken away, until none is: what stays goes in a circle.
    loop {
        let left: BTreeSet<PathBuf> = imports.keys().cloned().collect();
        imports.retain(|_, known| known.iter().any(|other| left.contains(other)));
        if imports.len() == left.len() {
            break;
        }
    }
    assert!(imports.is_empty(), "these import one another in a circle, or what does: {imports:#?}");
}

#[test]
fn only_one_file_names_clarabel_as_a_crate() {
    let mut files = Vec::new();
    sources(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &mut files);
    let names = |path: &&PathBuf| fs::read_to_string(path).unwrap().contains("clarabel::solver");
    let found: Vec<_> = files.iter().filter(names).map(|p| p.file_name().unwrap().to_owned()).collect();
    assert_eq!(found, ["clarabel.rs"]);
}

#[test]
fn every_path_that_the_architecture_names_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join("ARCHITECTURE.md")).unwrap();
    let mut checked = 0;
    for line in text.lines().filter(|l| l.starts_with("| `src/")) {
        let mut room = PathBuf::new();
        for name in line.split('`').skip(1).step_by(2) {
            let path = if name.starts_with("src/") {
                room = root.join(name);
                room.clone()
            } else if name.ends_with(".rs") || name.ends_with('/') {
                room.join(name)
            } else {
                continue;
            };
            assert!(path.exists(), "ARCHITECTURE.md names {name}, which does not exist");
            checked += 1;
        }
    }
    assert!(checked > 25, "only {checked} names found");
}
