//! Files appear whole or not at all.
use std::fs;
use std::io::Write;

use signorini::Error;
use signorini::output::atomic::{WholeFile, write_whole};

#[test]
fn folders_are_made_and_an_older_file_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a/b/picture.svg");
    write_whole(&path, b"old").unwrap();
    write_whole(&path, b"new").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"new");
    assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
}

#[test]
fn a_writer_dropped_before_its_end_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trajectory.csv");
    write_whole(&path, b"old").unwrap();
    let mut file = WholeFile::create(&path).unwrap();
    file.write_all(&[b'x'; 1 << 20]).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    drop(file);
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_long_file_appears_when_finished() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trajectory.csv");
    let mut file = WholeFile::create(&path).unwrap();
    for i in 0..100_000 {
        writeln!(file, "{i},0").unwrap();
    }
    assert!(!path.exists());
    file.finish().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap().lines().count(), 100_000);
}

#[test]
fn a_place_that_cannot_be_written_is_a_wrong_request_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), b"").unwrap();
    let below_a_file = folder.path().join("file/out/picture.svg");
    let is_a_folder = folder.path().to_owned();
    for path in [below_a_file, is_a_folder, "/".into(), "..".into()] {
        let error = write_whole(&path, b"x").unwrap_err();
        assert!(error.is_request(), "{error}");
        let Error::Io { path, reason, .. } = error else { panic!("{error}") };
        assert!(!path.is_empty() && !reason.is_empty());
    }
}
