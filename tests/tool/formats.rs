//! `--format`: pictures as SVG, PDF and PNG, or one clear refusal in a program that cannot write
//! them.
use std::path::Path;
use std::process::{Command, Output};

fn signorini(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_signorini")).arg("-q").args(arguments).output().unwrap()
}

/// Requests of every command that draws, for results in `out`.
fn drawing(out: &str) -> Vec<Vec<&str>> {
    vec![
        vec!["run", "rigid-walls-sine", "--end", "0.5", "--no-verdict", "--out", out],
        vec!["compare", "rigid-walls-sine", "--end", "0.5", "--no-verdict", "--out", out],
        vec!["chart", "rigid-walls-sine", "--end", "0.1", "--levels", "2", "--repeats", "1", "--out", out],
        vec!["stability", "bouncing-ball", "--most-steps", "20000", "--out", out],
        vec!["figures", "--out", out],
    ]
}

fn with<'a>(request: &[&'a str], formats: &'a str) -> Vec<&'a str> {
    [request, &["--format", formats]].concat()
}

/// Names of the files under `folder` that end so, without the ending.
fn stems(folder: &Path, ending: &str) -> Vec<String> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(stems(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            found.push(path.with_extension("").display().to_string());
        }
    }
    found.sort();
    found
}

#[test]
fn a_format_that_nobody_writes_is_a_wrong_request() {
    let folder = tempfile::tempdir().unwrap();
    for request in drawing(folder.path().to_str().unwrap()) {
        for formats in ["gif", "svg,gif", ""] {
            let output = signorini(&with(&request, formats));
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{request:?}: {said}");
            assert!(["--format", "svg", "pdf", "png"].iter().all(|word| said.contains(word)), "{request:?}: {said}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn svg_is_written_by_every_build_once_however_often_it_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let run = &drawing(folder.path().to_str().unwrap())[0];
    let output = signorini(&[&["--json"], &with(run, "svg,svg")[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let written = document["files_written"].as_array().unwrap();
    assert_eq!(written.iter().filter(|name| *name == "displacement.svg").count(), 1, "{written:?}");
    assert_eq!(stems(folder.path(), "svg").len(), 4);
}

#[cfg(not(feature = "pictures"))]
#[test]
fn a_build_without_the_feature_says_how_to_get_it_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    for request in drawing(folder.path().to_str().unwrap()) {
        for formats in ["pdf", "png", "svg,pdf"] {
            let output = signorini(&with(&request, formats));
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{request:?}: {said}");
            assert!(said.contains("cargo install --path . --features pictures"), "{request:?}: {said}");
            assert_eq!(said.matches("error").count(), 1, "{said}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[cfg(feature = "pictures")]
mod pictures {
    use super::{drawing, signorini, stems, with};
    use resvg::tiny_skia::Pixmap;
    use std::path::Path;

    /// The whole of a PDF is where its cross-reference table says it is.
    fn assert_pdf(path: &Path) {
        let bytes = std::fs::read(path).unwrap();
        let name = path.display();
        // Latin-1: a character a byte, so that places in the text are places in the file.
        let text: String = bytes.iter().map(|b| char::from(*b)).collect();
        let (start, end) =
            text.trim_end().rsplit_once("startxref").map(|(_, rest)| rest.trim().split_once('\n')).unwrap().unwrap();
        assert!(text.starts_with("%PDF-1.") && end.trim() == "%%EOF", "{name}");
        let at = |place: usize| bytes[place..].iter().map(|b| char::from(*b)).take(40).collect::<String>();
        let start: usize = start.trim().parse().unwrap();
        assert!(at(start).starts_with("xref"), "{name}");
        let table: Vec<String> =
            bytes[start..].iter().map(|b| char::from(*b)).collect::<String>().lines().map(str::to_owned).collect();
        let used: Vec<(usize, usize)> = table[2..]
            .iter()
            .take_while(|line| !line.starts_with("trailer"))
            .enumerate()
            .filter(|(_, line)| line.trim_end().ends_with('n'))
            .map(|(number, line)| (number, line[..10].parse().unwrap()))
            .collect();
        assert!(used.len() > 5, "{name}");
        for (number, place) in used {
            assert!(at(place).starts_with(&format!("{number} 0 obj")), "{name}: object {number}");
        }
        // Texts are texts, in a font that is in the file and whose letters can be copied out of it.
        for word in ["DejaVuSans", "/FontFile", "/ToUnicode", "/Type /Page"] {
            assert!(text.contains(word), "{name}: {word}");
        }
        // 160 mm in points, 1/72 inch.
        let page = text.split("/MediaBox [").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
        let width: f64 = page.split_whitespace().nth(2).unwrap().parse().unwrap();
        assert!((width - 160.0 / 25.4 * 72.0).abs() < 0.1, "{name}: {width}");
    }

    /// Decodes, has its size, a white ground, a title and something below it.
    fn assert_png(path: &Path) {
        let bytes = std::fs::read(path).unwrap();
        let name = path.display();
        let picture = Pixmap::decode_png(&bytes).unwrap();
        // 160 mm at 300 dots an inch, up to the next whole dot; 300 dots an inch are 11811 a metre.
        assert!((1890..=1891).contains(&picture.width()), "{name}: {}", picture.width());
        let dots = bytes.windows(4).position(|w| w == b"pHYs").unwrap() + 4;
        assert_eq!(u32::from_be_bytes(bytes[dots..dots + 4].try_into().unwrap()), 11811, "{name}");
        let row = 4 * picture.width() as usize;
        let ink = |bytes: &[u8]| bytes.chunks(4).filter(|p| p[0] < 128 && p[1] < 128 && p[2] < 128).count();
        let data = picture.data();
        assert!(data.chunks(4).all(|p| p[3] == 255), "{name}: transparent");
        // The first line of the title: 26 of the 640 units of the width.
        let title = ink(&data[..row * 26 * 1890 / 640]);
        assert!(title > 500, "{name}: {title} dark dots in the title");
        assert!(ink(data) > 2 * title, "{name}: nothing below the title");
        assert!(data.chunks(4).filter(|p| p[..3] == [255, 255, 255]).count() > data.len() / 20, "{name}: no ground");
    }

    #[test]
    fn every_command_that_draws_writes_each_picture_in_every_format_asked_for() {
        for number in 0..drawing("").len() {
            let folder = tempfile::tempdir().unwrap();
            let request = &drawing(folder.path().to_str().unwrap())[number];
            let output = signorini(&with(request, "svg,pdf,png"));
            assert!(output.status.success(), "{request:?}: {}", String::from_utf8_lossy(&output.stderr));
            let svg = stems(folder.path(), "svg");
            assert!(!svg.is_empty(), "{request:?}");
            assert_eq!(stems(folder.path(), "pdf"), svg, "{request:?}");
            assert_eq!(stems(folder.path(), "png"), svg, "{request:?}");
            for stem in svg {
                assert_pdf(Path::new(&format!("{stem}.pdf")));
                assert_png(Path::new(&format!("{stem}.png")));
            }
            // The same results in another format: the pictures before go with them.
            if number == 0 {
                assert!(signorini(&with(request, "pdf")).status.success());
                assert!(stems(folder.path(), "svg").is_empty() && stems(folder.path(), "png").is_empty());
                assert_eq!(stems(folder.path(), "pdf").len(), 4);
            }
        }
    }
}
