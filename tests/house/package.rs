//! The packages of the two crates hold their sources and each file that these embed, and no tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// What cargo would pack, by paths from the crate's folder.
fn packed(name: &str) -> BTreeSet<PathBuf> {
    let list = Command::new(env!("CARGO"))
        .args(["package", "--list", "--allow-dirty", "--offline", "--package", name])
        .current_dir(ROOT)
        .output()
        .unwrap();
    assert!(list.status.success(), "{}", String::from_utf8_lossy(&list.stderr));
    // Cargo prints the separators of the system.
    String::from_utf8(list.stdout).unwrap().lines().map(PathBuf::from).collect()
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// The files that a source embeds, or reads as a module of another folder: the one that it names
/// or, where a macro puts the name together from a folder and more, all of the folder.
fn embedded(source: &Path) -> Vec<PathBuf> {
    let text = fs::read_to_string(source).unwrap();
    let mut found = Vec::new();
    for embed in ["include_str!(", "include_bytes!(", "include!(", "#[path = "] {
        for (start, _) in text.match_indices(embed) {
            let argument = text[start + embed.len()..].trim_start();
            let name = argument.split('"').nth(1).unwrap();
            let path = source.parent().unwrap().join(name);
            let path = path.canonicalize().unwrap_or_else(|e| panic!("{}: {name}: {e}", source.display()));
            if argument.starts_with("concat!(") {
                assert!(path.is_dir(), "{}: the first part of {name} … is no folder", source.display());
                files(&path, &mut found);
            } else {
                found.push(path);
            }
        }
    }
    found
}

/// The files of a crate that its package lacks, and how many it needs besides its sources.
fn missing(folder: &Path, packed: &BTreeSet<PathBuf>) -> (Vec<PathBuf>, usize) {
    let folder = folder.canonicalize().unwrap();
    let mut needed = Vec::new();
    for sources in ["src", "examples", "benches"].map(|name| folder.join(name)) {
        if sources.is_dir() {
            files(&sources, &mut needed);
        }
    }
    needed.retain(|path| path.extension().is_some_and(|ending| ending == "rs"));
    let embedded: Vec<PathBuf> = needed.iter().flat_map(|source| embedded(source)).collect();
    let count = embedded.len();
    needed.extend(embedded);
    needed.extend(["Cargo.toml", "README.md", "LICENSE-MIT", "LICENSE-APACHE"].map(|name| folder.join(name)));
    let own = |path: &PathBuf| path.strip_prefix(&folder).unwrap_or(path).to_owned();
    (needed.iter().map(own).filter(|path| !packed.contains(path)).collect(), count)
}

#[test]
fn the_package_holds_what_its_sources_embed_and_no_tests() {
    let packed = packed("signorini");
    let (missing, embedded) = missing(Path::new(ROOT), &packed);
    assert!(missing.is_empty(), "the package lacks {missing:#?}");
    assert!(embedded > 80, "only {embedded} embedded files found");
    // The licence of the embedded fonts.
    assert!(packed.contains(Path::new("assets/fonts/LICENSE.txt")));
    for folder in ["tests", "python", "figure", "benches/peers", "target", "release", ".ci"] {
        let inside: Vec<_> = packed.iter().filter(|path| path.starts_with(folder)).collect();
        assert!(inside.is_empty(), "the package holds {inside:#?}");
    }
}

/// The places that the documents of the package link to, by paths from the crate's folder.
fn linked(document: &Path) -> Vec<PathBuf> {
    let text = fs::read_to_string(Path::new(ROOT).join(document)).unwrap();
    let folder = document.parent().unwrap();
    let links = [("](", ')'), ("src=\"", '"')].map(|(before, after)| {
        text.split(before).skip(1).filter_map(move |rest| rest.split_once(after)).map(|(link, _)| link)
    });
    // A link within the page, one to elsewhere, and what is no link (`[x](a b)` in code).
    let local = |link: &&str| !link.is_empty() && !link.starts_with('#') && !link.contains([':', ' ', '\n']);
    let path = |link: &str| folder.join(link.split('#').next().unwrap());
    links.into_iter().flatten().filter(local).map(path).collect()
}

#[test]
fn the_documents_of_the_package_link_only_to_what_it_holds() {
    let packed = packed("signorini");
    let plain = |path: &Path| {
        path.components().fold(PathBuf::new(), |path, part| match part.as_os_str().to_str() {
            Some("..") => path.parent().unwrap().to_owned(),
            _ => path.join(part),
        })
    };
    let documents = packed.iter().filter(|path| path.extension().is_some_and(|ending| ending == "md"));
    let links = documents.flat_map(|document| linked(document).into_iter().map(move |link| (document, plain(&link))));
    let links: Vec<(&PathBuf, PathBuf)> = links.collect();
    assert!(links.len() > 30, "only {} links found", links.len());
    let lost: Vec<_> = links.iter().filter(|(_, link)| !packed.contains(link)).collect();
    assert!(lost.is_empty(), "not in the package: {lost:#?}");
}

#[test]
fn the_package_of_the_figures_holds_its_sources_and_licences() {
    let (missing, _) = missing(&Path::new(ROOT).join("figure"), &packed("signorini-figure"));
    assert!(missing.is_empty(), "the package lacks {missing:#?}");
}
