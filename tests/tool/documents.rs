//! The pages for one's own data: every file of them is written and every command run, in their
//! order, as a reader would.
use std::fs;
use std::path::Path;
use std::process::Command;

/// The fenced blocks of a page: language, name of the file that it is, if any, and text.
fn blocks(page: &str) -> Vec<(String, Option<String>, String)> {
    let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).unwrap();
    let mut blocks = Vec::new();
    let mut open: Option<(String, Option<String>, String)> = None;
    for line in text.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (Some(_), Some("")) => blocks.extend(open.take()),
            (Some((_, _, text)), _) => *text += &format!("{line}\n"),
            (None, Some(info)) => {
                let (language, name) =
                    info.split_once(' ').map_or((info, None), |(l, name)| (l, Some(name.to_owned())));
                open = Some((language.to_owned(), name, String::new()));
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "{page}: a block without end");
    blocks
}

/// The words of a command line: split at spaces, but within quotes.
fn words(line: &str) -> Vec<String> {
    line.split('\'')
        .enumerate()
        .flat_map(|(index, part)| match index % 2 {
            0 => part.split_whitespace().map(str::to_owned).collect(),
            _ => vec![part.to_owned()],
        })
        .collect()
}

/// The lines of a block of shell, without their remarks.
fn lines(text: &str) -> Vec<String> {
    let joined = text.replace("\\\n", " ");
    joined.lines().map(|line| line.split(" #").next().unwrap_or_default().to_owned()).collect()
}

/// Runs a command line of a page with `more` arguments, which succeeds, and returns what it prints.
fn done(page: &str, line: &str, more: &[&str], folder: &Path) -> String {
    let words = words(line);
    assert_eq!(words.first().map(String::as_str), Some("signorini"), "{page}: {line}");
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    let output = command.args(&words[1..]).args(more).current_dir(folder).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{page}: {line}: {told}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Writes the files and runs the commands; returns how many of each, and what was printed.
fn follow(page: &str, folder: &Path) -> (usize, usize, String) {
    let (mut files, mut commands, mut said) = (0, 0, String::new());
    for (language, name, text) in blocks(page) {
        if let Some(name) = name {
            fs::write(folder.join(name), text).unwrap();
            files += 1;
        } else if language == "sh" {
            for line in lines(&text) {
                said += &done(page, &line, &[], folder);
                commands += 1;
            }
        }
    }
    (files, commands, said)
}

#[test]
fn my_own_tube_in_ten_minutes() {
    let dir = tempfile::tempdir().unwrap();
    let (files, commands, said) = follow("docs/own-tube.md", dir.path());
    assert_eq!((files, commands), (1, 6));
    for word in ["plate", "bars", "work", "worn", "natural frequencies"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    for file in ["run/report.html", "run/animation.svg", "sweep/sweep.csv"] {
        assert!(dir.path().join("out/my-tube").join(file).is_file(), "{file}");
    }
}

#[test]
fn my_own_paper_figure_in_ten_minutes() {
    let dir = tempfile::tempdir().unwrap();
    let (files, commands, said) = follow("docs/own-paper-figure.md", dir.path());
    assert_eq!((files, commands), (1, 5));
    // Of the chart the exact motion: which scheme on a grid is the cheapest depends on the machine.
    for word in ["stop-upper", "symmetry-breaking", "event"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    for file in [
        "out/my-paper/run/phase.svg",
        "out/my-paper/run/contact-force.svg",
        "bifurcation/sweep.svg",
        "branches/beneath.csv",
        "out/my-paper/chart/work-precision.csv",
    ] {
        assert!(dir.path().join(file).is_file(), "{file}");
    }
}

/// The modes of the page are those of its matrices, so both motions have the same contacts before
/// they can have grown apart.
#[test]
fn my_own_matrices_in_ten_minutes() {
    let dir = tempfile::tempdir().unwrap();
    let (files, commands, said) = follow("docs/own-matrices.md", dir.path());
    assert_eq!((files, commands), (8, 6));
    // 2 √1000 sin(π/14) / 2π and 2 √1000 sin(5π/14) / 2π.
    assert!(said.contains("natural frequencies from 2.239861 to about 9.069011 Hz"), "{said}");
    assert!(said.contains("natural frequencies, all: 2.239861, 6.275950, 9.069011 Hz"), "{said}");
    let first = |case: &str| {
        let contacts = fs::read_to_string(dir.path().join("out").join(case).join("run/contacts.csv")).unwrap();
        let mut table = csv::Reader::from_reader(contacts.as_bytes());
        let start = table.headers().unwrap().iter().position(|name| name == "start_s").unwrap();
        table.records().next().unwrap().unwrap()[start].parse::<f64>().unwrap()
    };
    // Four digits of the shapes are left out: a share of 1e-3 of the time to the first contact.
    let (full, modal) = (first("my-structure"), first("my-modes"));
    assert!((full - modal).abs() < 1e-3 * full, "{full} {modal}");
    // The U-bend slides in its plate, with and without the turbulence of a flow.
    let work_rate = |case: &str| {
        let supports = fs::read_to_string(dir.path().join("out").join(case).join("run/supports.csv")).unwrap();
        let mut table = csv::Reader::from_reader(supports.as_bytes());
        let rate = table.headers().unwrap().iter().position(|name| name == "work_rate_W").unwrap();
        table.records().next().unwrap().unwrap()[rate].parse::<f64>().unwrap()
    };
    let own = fs::read_to_string(dir.path().join("u-bend.toml")).unwrap();
    let is_turbulence = |text: &&String| text.starts_with("[[turbulence]]");
    let blocks = blocks("docs/own-matrices.md");
    let turbulence = blocks.iter().map(|(_, _, text)| text).find(is_turbulence).unwrap();
    fs::write(dir.path().join("in-flow.toml"), format!("{own}\n{turbulence}")).unwrap();
    done("docs/own-matrices.md", "signorini run in-flow.toml", &[], dir.path());
    let (alone, in_flow) = (work_rate("u-bend"), work_rate("in-flow"));
    assert!(alone > 0.0 && in_flow > 0.0 && in_flow != alone, "{alone} {in_flow}");
}

/// Whole sweeps of these pages take minutes: they are planned, which checks all but the runs.
#[test]
fn the_sweeps_of_the_documents_can_be_made() {
    let dir = tempfile::tempdir().unwrap();
    let mut planned = 0;
    for page in ["docs/engineer.md", "docs/sweep.md"] {
        let (files, others): (Vec<_>, Vec<_>) = blocks(page).into_iter().partition(|(_, name, _)| name.is_some());
        for (_, name, text) in files {
            fs::write(dir.path().join(name.unwrap()), text).unwrap();
        }
        for (language, _, text) in others {
            if language == "sh" {
                for line in lines(&text).iter().filter(|line| line.starts_with("signorini sweep ")) {
                    done(page, line, if line.contains("--plan") { &[] } else { &["--plan"] }, dir.path());
                    planned += 1;
                }
            }
        }
    }
    assert!(planned >= 10, "{planned}");
}

/// The commands of all other pages take minutes: they are parsed.
#[test]
fn the_commands_of_the_documents_are_known() {
    let mut known = 0;
    for page in ["README.md", "cases/README.md", "docs/engineer.md", "docs/orbits.md", "docs/statistics.md"]
        .into_iter()
        .chain(["docs/researcher.md", "docs/sweep.md", "docs/holes.md"])
    {
        let shell = blocks(page).into_iter().filter(|(language, ..)| language == "sh");
        let lines = shell.flat_map(|(_, _, text)| lines(&text));
        for line in lines.filter(|line| line.starts_with("signorini ")) {
            let parsed = signorini::cli::command().try_get_matches_from(words(&line));
            assert!(parsed.is_ok(), "{page}: {line}: {}", parsed.err().unwrap());
            known += 1;
        }
    }
    assert!(known >= 40, "{known}");
}
