//! Imports go one way, and ARCHITECTURE.md names what exists.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms from the ground up: each may import those before it.
const ROOMS: &[&str] = &[
    "elementary",
    "error",
    "finite",
    "hash",
    "interrupt",
    "order",
    "parallel",
    "linear",
    "scene",
    "qp",
    "flow",
    "step",
    "wear",
    "variation",
    "contact",
    "trajectory",
    "time",
    "residual",
    "statistics",
    "scheme",
    "batch",
    "run",
    "orbit",
    "study",
    "case",
    "verification",
    "output",
    "sweep",
    "report",
    "cli",
];

/// Pairs of rooms that must not import each other although the order would allow it.
const STRANGERS: &[(&str, &str)] = &[
    ("qp", "scene"),
    ("residual", "qp"),
    ("residual", "scheme"),
    ("flow", "qp"),
    ("variation", "qp"),
    ("study", "case"),
    ("study", "output"),
    ("sweep", "qp"),
    ("orbit", "case"),
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
    room.into()
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
            let Some(other) = rank(&name) else {
                panic!("{} imports crate::{name}, which is no room", file.display());
            };
            assert!(other <= own, "{} ({room}) imports {name}, which stands above it", file.display());
            let strangers = STRANGERS.contains(&(room.as_str(), name.as_str()));
            assert!(!strangers, "{} ({room}) imports {name}: they are to be strangers", file.display());
            checked += 1;
        }
    }
    // Guards the scan itself: it would also pass if its pattern matched nothing.
    assert!(checked > 80, "only {checked} imports found");
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
    let mut order = Vec::new();
    for item in text.split("\n- ").skip(1).filter(|item| item.starts_with("`src/")) {
        let item = item.split("\n\n").next().unwrap();
        order.push(room_of(&root.join(item.split('`').nth(1).unwrap())));
        let mut room = PathBuf::new();
        for name in item.split('`').skip(1).step_by(2) {
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
    for path in text.split('`').skip(1).step_by(2).filter(|path| path.starts_with("src/")) {
        assert!(root.join(path).exists(), "ARCHITECTURE.md names {path}, which does not exist");
    }
    assert!(checked > 25, "only {checked} names found");
    assert_eq!(order, ROOMS, "the order of the rooms in ARCHITECTURE.md is that of the layers");
}

/// The head of each room's `mod.rs` lists its files.
#[test]
fn the_head_of_a_room_names_its_files_and_no_others() {
    let src = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
    let mut checked = 0;
    for room in ROOMS.iter().map(|room| src.join(room)).filter(|room| room.join("mod.rs").is_file()) {
        let text = fs::read_to_string(room.join("mod.rs")).unwrap();
        let head: String = text.lines().take_while(|line| line.starts_with("//!")).collect();
        let names: Vec<&str> = head.split('`').skip(1).step_by(2).collect();
        for name in &names {
            let is_name = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "_/.".contains(c));
            if is_name && (name.ends_with(".rs") || name.ends_with('/')) {
                let known = [&room, &src.to_owned(), &src.parent().unwrap().to_owned()];
                assert!(known.iter().any(|folder| folder.join(name).exists()), "{} names {name}", room.display());
                checked += 1;
            }
        }
        for path in fs::read_dir(&room).unwrap().map(|entry| entry.unwrap().path()) {
            let stem = path.file_stem().unwrap().to_str().unwrap();
            // A folder beside a file of its name is part of that file.
            let part = path.is_dir() && path.with_extension("rs").is_file();
            let is = |name: &&str| {
                let name = name.strip_prefix("mod@").unwrap_or(name);
                name.strip_suffix(".rs").unwrap_or(name) == stem || name.starts_with(&format!("{stem}/"))
            };
            let named = part || ["mod", "tests"].contains(&stem) || names.iter().any(is);
            assert!(named, "the head of {}/mod.rs does not name {}", room.display(), path.display());
        }
    }
    assert!(checked > 250, "only {checked} names found");
}
