//! `--tables csv,xlsx`: workbooks, read back by a reader of this file's own, have the cells of the
//! CSV tables beside them; or one clear refusal in a program that cannot write them.
use crate::command::said;

#[test]
fn a_format_of_tables_that_nobody_writes_is_a_wrong_request() {
    let dir = tempfile::tempdir().unwrap();
    for formats in ["xls", "csv,ods", ""] {
        let (_, err) = said(dir.path(), &["run", "rigid-walls-sine", "--tables", formats, "--out", "o"], 2);
        assert!(["--tables", "csv", "xlsx"].iter().all(|word| err.contains(word)), "{err}");
    }
    assert!(!dir.path().join("o").exists());
}

#[cfg(not(feature = "xlsx"))]
#[test]
fn a_build_without_workbooks_says_how_to_get_them_before_anything_runs() {
    let dir = tempfile::tempdir().unwrap();
    for request in [
        &["run", "rigid-walls-sine"][..],
        &["compare", "rigid-walls-sine"],
        &["chart", "rigid-walls-sine"],
        &["stability", "bouncing-ball", "--most-steps", "20000"],
        &["sweep", "rigid-walls-sine", "--vary", "time.step=1e-4:1e-3:2", "--measure", "contacts"],
        &["wear", "tube-round-supports"],
        &["orbit", "rigid-walls-sine"],
        &["continue", "rigid-walls-sine", "--key", "load.1.harmonic.frequency", "--range", "1:16"],
        &["merge", "o"],
        &["verify"],
    ] {
        let (_, err) = said(dir.path(), &[request, &["--tables", "csv,xlsx", "--out", "o", "-q"]].concat(), 2);
        assert!(err.contains("--tables is xlsx") && err.contains("--features xlsx"), "{request:?}: {err}");
        assert_eq!(err.matches("error").count(), 1, "{err}");
    }
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
    said(dir.path(), &["run", "rigid-walls-sine", "--end", "0.1", "--no-verdict", "--tables", "csv"], 0);
}

#[cfg(feature = "xlsx")]
mod sheets {
    use crate::command::said;
    use crate::shaken::square_of_bars;
    use roxmltree::{Document, Node};
    use std::collections::{BTreeMap, BTreeSet};
    use std::fs;
    use std::path::{Path, PathBuf};

    /// The files in a ZIP archive, by the format's specification (APPNOTE 6.3).
    fn archived(path: &Path) -> BTreeMap<String, String> {
        let bytes = fs::read(path).unwrap();
        let number = |at: usize, length: usize| {
            bytes[at..at + length].iter().rev().fold(0, |number, byte| number << 8 | usize::from(*byte))
        };
        let end = bytes.windows(4).rposition(|word| word == b"PK\x05\x06").unwrap();
        let (count, mut entry) = (number(end + 10, 2), number(end + 16, 4));
        let mut files = BTreeMap::new();
        for _ in 0..count {
            assert_eq!(&bytes[entry..entry + 4], b"PK\x01\x02");
            assert_eq!((number(entry + 12, 2), number(entry + 14, 2)), (0, 0x21), "the first day of 1980");
            let (method, crc, length) = (number(entry + 10, 2), number(entry + 16, 4), number(entry + 20, 4));
            let (name, local) = (number(entry + 28, 2), number(entry + 42, 4));
            let data = local + 30 + number(local + 26, 2) + number(local + 28, 2);
            let data = &bytes[data..data + length];
            let text = match method {
                0 => data.to_vec(),
                _ => miniz_oxide::inflate::decompress_to_vec(data).unwrap(),
            };
            assert_eq!(checksum(&text) as usize, crc);
            let named = String::from_utf8(bytes[entry + 46..entry + 46 + name].to_vec()).unwrap();
            files.insert(named, String::from_utf8(text).unwrap());
            entry += 46 + name + number(entry + 30, 2) + number(entry + 32, 2);
        }
        files
    }

    /// CRC-32 of ISO 3309.
    fn checksum(bytes: &[u8]) -> u32 {
        let shift = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xEDB8_8320 } else { crc >> 1 };
        !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), shift))
    }

    /// What a cell of a sheet holds.
    #[derive(Debug, PartialEq)]
    enum Cell {
        Empty,
        Number(f64),
        Text(String),
    }

    /// The cells of a sheet by their rows, filled up with empty ones to the width of the header.
    fn cells(xml: &str) -> Vec<Vec<Cell>> {
        let sheet = Document::parse(xml).unwrap();
        let pane = sheet.descendants().find(|node| is(node, "pane")).unwrap();
        assert_eq!((pane.attribute("ySplit"), pane.attribute("state")), (Some("1"), Some("frozen")));
        let mut rows: Vec<Vec<Cell>> = Vec::new();
        for row in sheet.descendants().filter(|node| is(node, "row")) {
            assert_eq!(row.attribute("r"), Some(&*(rows.len() + 1).to_string()));
            let mut cells = Vec::new();
            for cell in row.children().filter(Node::is_element) {
                let letters = cell.attribute("r").unwrap().trim_end_matches(|c: char| c.is_ascii_digit());
                let column = letters.bytes().fold(0, |column, letter| 26 * column + usize::from(letter - b'A') + 1);
                cells.resize_with(column - 1, || Cell::Empty);
                let text: String =
                    cell.descendants().filter_map(|node| node.text().filter(|_| node.is_text())).collect();
                cells.push(match cell.attribute("t") {
                    Some("inlineStr") => Cell::Text(text),
                    None => Cell::Number(text.parse().unwrap()),
                    other => panic!("a cell of type {other:?}"),
                });
            }
            let width = rows.first().map_or(cells.len(), Vec::len);
            cells.resize_with(width, || Cell::Empty);
            rows.push(cells);
        }
        rows
    }

    /// Elements are known by their local names: no file has two of one name.
    fn is(node: &Node<'_, '_>, name: &str) -> bool {
        node.is_element() && node.tag_name().name() == name
    }

    /// The sheets of a workbook by their names.
    fn sheets(path: &Path) -> BTreeMap<String, Vec<Vec<Cell>>> {
        let files = archived(path);
        let of = |file: &str, element: &str, pair: [&str; 2]| -> Vec<[String; 2]> {
            let xml = Document::parse(&files[file]).unwrap();
            let value = |node: Node<'_, '_>, name: &str| {
                node.attributes().find(|one| one.name() == name).unwrap().value().to_owned()
            };
            let elements = xml.descendants().filter(|node| is(node, element));
            elements.map(|node| pair.map(|name| value(node, name))).collect()
        };
        let targets = of("xl/_rels/workbook.xml.rels", "Relationship", ["Id", "Target"]);
        let target = |id: &str| targets.iter().find(|[known, _]| known == id).map(|[_, target]| target).unwrap();
        // `id` of the sheet, whose number has the name `sheetId`.
        let named = of("xl/workbook.xml", "sheet", ["name", "id"]);
        named.into_iter().map(|[name, id]| (name, cells(&files[&format!("xl/{}", target(&id))]))).collect()
    }

    /// The workbooks under `folder`.
    fn workbooks(folder: &Path) -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
        let own = files.into_iter().filter(|path| path.ends_with("tables.xlsx"));
        folders.iter().flat_map(|folder| workbooks(folder)).chain(own).collect()
    }

    /// The tables in `folder`, without `.csv`.
    fn tables(folder: &Path) -> Vec<String> {
        let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter_map(|name| name.strip_suffix(".csv").map(str::to_owned)).collect()
    }

    /// Checks that each workbook under `folder` has the tables beside it, cell by cell, each number
    /// as a number, but for the sheets `without`. Returns the names of all sheets.
    fn assert_equal_tables(folder: &Path, without: &[String]) -> BTreeSet<String> {
        let mut names = BTreeSet::new();
        for workbook in workbooks(folder) {
            let mut sheets = sheets(&workbook);
            let folder = workbook.parent().unwrap();
            for stem in tables(folder).iter().filter(|stem| !without.contains(stem)) {
                let path = folder.join(format!("{stem}.csv"));
                let name = if stem == "history" { "history.csv" } else { stem.as_str() };
                let sheet = sheets.remove(name).unwrap_or_else(|| panic!("no sheet {name} in {}", workbook.display()));
                let mut table = csv::ReaderBuilder::new().has_headers(false).from_path(&path).unwrap();
                let rows: Vec<_> = table.records().map(Result::unwrap).collect();
                assert_eq!(sheet.len(), rows.len(), "{}", path.display());
                for (row, (cells, texts)) in sheet.iter().zip(&rows).enumerate() {
                    assert_eq!(cells.len(), texts.len(), "row {row} of {}", path.display());
                    for (cell, text) in cells.iter().zip(texts) {
                        let wanted = match text.parse::<f64>() {
                            _ if text.is_empty() => Cell::Empty,
                            Ok(x) if row > 0 && x.is_finite() => Cell::Number(x),
                            _ => Cell::Text(text.to_owned()),
                        };
                        assert_eq!(*cell, wanted, "row {row} of {}", path.display());
                    }
                }
                names.insert(name.to_owned());
            }
            assert!(sheets.is_empty(), "{} has sheets of no table", workbook.display());
        }
        names
    }

    const XLSX: [&str; 3] = ["--tables", "csv,xlsx", "-q"];

    #[test]
    fn workbooks_of_every_kind_of_results_equal_the_tables_beside_them() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path();
        let time = "[time]\nend = 1.0\nstep = 1e-3\nstatistics_from = 0.5\n";
        fs::write(path.join("square.toml"), square_of_bars("", time)).unwrap();
        let sets = ["time.end=1", "wear.service=3e6", "wear.support_coefficient=1e-12", "support.hole.width=25e-3"];
        let sets = sets.iter().chain(&["support.hole.radius=9.525e-3"]).flat_map(|set| ["--set", set]);
        let worn: Vec<&str> = ["wear", "whirl-in-a-hole", "--years", "0.01"].into_iter().chain(sets).collect();
        for (request, wanted) in [
            (
                &["run", "square.toml", "--seeds", "2"][..],
                "contacts errors realisations sector-means sectors supports trajectory",
            ),
            (&["compare", "rigid-walls-sine", "--end", "0.5"], "compare compare-walls contacts distance trajectory"),
            (
                &[
                    "sweep",
                    "square.toml",
                    "--seeds",
                    "2",
                    "--vary",
                    "support.bars.gap=1e-3,2e-3",
                    "--measure",
                    "work_rate",
                ],
                "realisations sweep",
            ),
            (&worn, "contacts history.csv sector-means sectors supports trajectory years"),
            (&["orbit", "rigid-walls-sine", "--set", "wall.*.restitution=0.8"], "contacts orbit"),
        ] {
            let out = request[0];
            said(path, &[request, &XLSX, &["--out", out]].concat(), 0);
            let names = assert_equal_tables(&path.join(out), &[]);
            assert_eq!(names.into_iter().collect::<Vec<_>>().join(" "), wanted, "{request:?}");
        }
    }

    #[test]
    fn a_finished_sweep_gets_its_workbook_afterwards_with_the_same_bytes() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path();
        let sweep =
            ["sweep", "rigid-walls-sine", "--vary", "time.step=1e-3:2e-3:2", "--set", "time.end=0.2", "--measure"];
        let asked = |more: &[&str]| said(path, &[&sweep[..], &["contacts", "-q", "--out", "o"], more].concat(), 0);
        let workbook = || fs::read(path.join("o/tables.xlsx")).ok();
        asked(&["--tables", "xlsx"]);
        let first = workbook().unwrap();
        let files = fs::read_to_string(path.join("o/request.json")).unwrap();
        assert!(files.contains("\"tables.xlsx\"") && files.contains("\"sweep.csv\""), "{files}");
        // What is not asked for again does not stay beside other tables.
        asked(&[]);
        assert_eq!(workbook(), None);
        asked(&["--tables", "csv,xlsx"]);
        assert!(workbook() == Some(first), "another workbook of the same table");
        assert_eq!(
            fs::read_dir(path.join("o")).unwrap().filter(|file| is_temporary(file.as_ref().unwrap())).count(),
            0
        );
    }

    fn is_temporary(file: &fs::DirEntry) -> bool {
        let name = file.file_name().into_string().unwrap();
        name.starts_with('.') && !name.ends_with(".lock")
    }

    #[test]
    fn a_table_that_no_sheet_can_hold_is_left_out_with_a_message() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path();
        let (long, rest) = ("a".repeat(40), "[time]\nend = 2.0\nstep = 1e-3\n[statistics]\nspectra = true\n");
        fs::write(path.join("square.toml"), square_of_bars("", rest).replace("\"bars\"", &format!("{long:?}")))
            .unwrap();
        let (_, err) = said(path, &["run", "square.toml", "--no-verdict", "--tables", "xlsx", "--out", "o"], 0);
        let left_out = tables(&path.join("o")).into_iter().filter(|stem| stem.chars().count() > 31).collect::<Vec<_>>();
        assert!(left_out.contains(&format!("spectrum-{long}-y")), "{left_out:?}");
        for stem in &left_out {
            let length = stem.chars().count();
            let told =
                format!("tables.xlsx is without {stem}.csv, which has {length} characters in its name, where a sheet");
            assert!(err.contains(&told), "{err}");
        }
        let names = assert_equal_tables(&path.join("o"), &left_out);
        assert!(names.contains("trajectory") && names.contains("episodes"), "{names:?}");
    }
}
