use super::super::atomic::write_whole;
use super::super::manifest::MANIFEST;
use super::*;

fn request(end: f64) -> Map<String, Value> {
    let value = json!({ "command": "run", "end_s": end, "walls_fingerprint": format!("{end}") });
    value.as_object().cloned().unwrap_or_default()
}

fn fill(folder: &Path, end: f64, force: bool, name: &str) -> Result<Option<String>> {
    let mut results = Results::open(folder, request(end), force, Formats::default())?;
    let path = results.place(name)?;
    write_whole(&path, b"1")?;
    results.finish()
}

#[test]
fn results_of_another_request_stay_unless_forced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    assert_eq!(fill(path, 10.0, false, "method/summary.json").unwrap(), None);
    let refused = fill(path, 1.0, false, "other.csv").unwrap_err();
    assert!(refused.is_request());
    let text = refused.to_string();
    for words in ["made 20", "end_s: 10 there, 1 asked", "walls: other data there"] {
        assert!(text.contains(words), "{words}: {text}");
    }
    assert!(path.join("method/summary.json").exists());
    // The same request replaces, and says what.
    let replaced = fill(path, 10.0, false, "method/summary.json").unwrap();
    assert!(replaced.is_some_and(|text| text.contains("made 20")));
    // Forced, nothing of the other request is left beside the new files.
    fill(path, 1.0, true, "other.csv").unwrap();
    assert!(path.join("other.csv").exists() && !path.join("method").exists());
}

#[test]
fn results_without_a_manifest_are_those_of_an_unknown_request() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("summary.json"), "{}").unwrap();
    assert!(fill(folder.path(), 1.0, false, "a.csv").unwrap_err().to_string().contains("summary.json"));
    fs::write(folder.path().join(MANIFEST), "no JSON").unwrap();
    assert!(fill(folder.path(), 1.0, false, "a.csv").is_err());
    assert!(fill(folder.path(), 1.0, true, "a.csv").unwrap().is_some());
}

#[test]
fn a_manifest_takes_nothing_away_outside_its_folder() {
    let root = tempfile::tempdir().unwrap();
    let folder = root.path().join("results");
    let precious = root.path().join("precious");
    fs::create_dir(&folder).unwrap();
    fs::write(&precious, "1").unwrap();
    let files = json!({ "files": ["../precious", precious.display().to_string(), "", "."] });
    fs::write(folder.join(MANIFEST), files.to_string()).unwrap();
    fill(&folder, 1.0, true, "a.csv").unwrap();
    assert!(precious.exists() && folder.join("a.csv").exists());
}

/// The earlier results stay as they are until all new files are there.
#[test]
fn nothing_is_replaced_before_everything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fill(path, 1.0, false, "a.csv").unwrap();
    let manifest = fs::read(path.join(MANIFEST)).unwrap();
    let mut results = Results::open(path, request(1.0), false, Formats::default()).unwrap();
    results.write("a.csv", b"x\n2\n3\n").unwrap();
    assert_eq!(fs::read(path.join("a.csv")).unwrap(), b"1");
    // Another writer waits for its turn.
    let second = Results::open(path, request(1.0), false, Formats::default()).unwrap_err();
    assert!(second.is_request() && second.to_string().contains("another process"), "{second}");
    drop(results);
    assert_eq!(fs::read(path.join(MANIFEST)).unwrap(), manifest);
    assert_eq!(fs::read_dir(path).unwrap().count(), 2, "the table and the manifest");
    // A folder in place of a file is refused before anything is written.
    let mut results = Results::open(path, request(1.0), false, Formats::default()).unwrap();
    fs::create_dir(path.join("b.csv")).unwrap();
    assert!(results.place("b.csv").unwrap_err().is_request());
}

/// The manifest of a request that is under way lists what is to be taken away, and the file from
/// which it goes on.
#[test]
fn an_interrupted_request_names_its_journal_and_earlier_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fill(path, 1.0, false, "old.csv").unwrap();
    let mut results = Results::open(path, request(2.0), true, Formats::default()).unwrap();
    fs::write(path.join("journal"), "").unwrap();
    results.begin("journal").unwrap();
    drop(results);
    let manifest = super::manifest::read(path).unwrap();
    assert!(!super::manifest::is_finished(&manifest));
    assert_eq!(super::manifest::files(&manifest).collect::<Vec<_>>(), ["journal", "old.csv"]);
    let mut results = Results::open(path, request(2.0), false, Formats::default()).unwrap();
    results.begin("journal").unwrap();
    results.write("new.csv", b"x\n2\n3\n").unwrap();
    results.finish().unwrap();
    assert!(!path.join("journal").exists() && !path.join("old.csv").exists());
    let manifest = super::manifest::read(path).unwrap();
    assert!(super::manifest::is_finished(&manifest));
    assert_eq!(Record::read(&manifest, "new.csv").map(|record| (record.rows, record.bytes)), Some((2, 6)));
    // What is added later leaves the records as they are.
    results.write("picture.svg", b"<svg/>").unwrap();
    results.finish().unwrap();
    let later = super::manifest::read(path).unwrap();
    assert_eq!(later[TABLES], manifest[TABLES]);
    assert_eq!(super::manifest::files(&later).collect::<Vec<_>>(), ["new.csv", "picture.svg"]);
}

/// A journal that stays is one of the files of the results, until another request replaces them.
#[test]
fn a_larger_request_goes_on_from_the_journal_of_finished_results() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let open =
        |end: f64, force: bool| Results::open_growing(path, request(end), Some("end_s"), force, Formats::default());
    let mut results = open(2.0, false).unwrap();
    fs::write(path.join("journal"), "1").unwrap();
    results.begin_and_keep("journal").unwrap();
    results.write("a.csv", b"x\n").unwrap();
    results.finish().unwrap();
    // What is added later changes nothing of that.
    results.write("b.csv", b"x\n").unwrap();
    results.finish().unwrap();
    drop(results);
    let files = || {
        let manifest = super::manifest::read(path).unwrap();
        super::manifest::files(&manifest).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(files(), ["a.csv", "b.csv", "journal"]);
    // The request has a fingerprint of the same number, which may not differ.
    let refused = open(3.0, false).unwrap_err().to_string();
    assert!(refused.contains("walls: other data there") && !refused.contains("end_s"), "{refused}");
    let refused = open(1.0, false).unwrap_err().to_string();
    assert!(refused.contains("end_s: 2 there, 1 asked"), "{refused}");
    let mut grown = request(2.0);
    grown.insert("end_s".to_owned(), json!(3.0));
    let mut results = Results::open_growing(path, grown, Some("end_s"), false, Formats::default()).unwrap();
    results.begin_and_keep("journal").unwrap();
    assert_eq!(files(), ["journal", "a.csv", "b.csv"]);
    results.write("a.csv", b"x\n").unwrap();
    results.finish().unwrap();
    assert_eq!(files(), ["a.csv", "journal"]);
    assert!(path.join("journal").exists() && !path.join("b.csv").exists());
    drop(results);
    fill(path, 1.0, true, "c.csv").unwrap();
    assert!(!path.join("journal").exists());
}
