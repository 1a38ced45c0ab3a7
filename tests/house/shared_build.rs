//! The tests and the Python package share one compiled library.

use std::collections::BTreeMap;
use std::process::Command;

/// The version and the features of each crate that `what` compiles with workbooks.
fn features(what: &[&str]) -> BTreeMap<String, String> {
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--features", "signorini/xlsx", "--prefix", "none", "--no-dedupe"])
        .args(["--format", "{p} with {f}"])
        .args(what)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let lines = String::from_utf8(tree.stdout).unwrap();
    lines.lines().filter_map(|line| line.split_once(" with ")).map(|(a, b)| (a.to_owned(), b.to_owned())).collect()
}

/// A crate that the tests' own dependencies give another feature is compiled twice, and with it
/// each that depends on it, up to the library: five minutes of one core.
#[test]
fn the_tests_give_no_dependency_of_the_python_package_another_feature() {
    let package = features(&["--package", "signorini-python", "--edges", "normal"]);
    let tests = features(&["--workspace", "--edges", "normal,dev"]);
    assert!(package.len() > 50, "{package:?}");
    for (name, own) in package {
        assert_eq!(tests.get(&name), Some(&own), "{name}: name the missing features in Cargo.toml");
    }
}
