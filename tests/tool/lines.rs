//! The moving pictures of modes and matrices: along the line that the case states, and what is said
//! where it states none.
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A tube by its first two modes in two planes, with a round support off its middle.
const MODES: &str = r#"[system]
planes = 2
[system.modal]
frequencies = [10.0, 10.0, 40.0, 40.0]
damping_ratios = 0.01
line = { a = 1.0, b = 1.5, c = 2.0, d = 3.0 }
[system.modal.shapes]
a-y = [0.0, 0.0, 0.0, 0.0]
a-z = [0.0, 0.0, 0.0, 0.0]
b-y = [0.7, 0.0, 1.0, 0.0]
b-z = [0.0, 0.7, 0.0, 1.0]
c-y = [1.0, 0.0, 0.0, 0.0]
c-z = [0.0, 1.0, 0.0, 0.0]
d-y = [0.0, 0.0, 0.0, 0.0]
d-z = [0.0, 0.0, 0.0, 0.0]
[[support]]
name = "plate"
at = { point = "b" }
shape = "round"
gap = 1e-4
restitution = 0.5
[[load]]
at = { point = "c" }
direction = 30
harmonic = { amplitude = 2.0, frequency = 9.0 }
[time]
end = 0.5
step = 1e-3
"#;

/// Three masses by matrices, in one plane, with a stop.
const MATRICES: &str = r#"[system.matrices]
mass = "m.csv"
stiffness = "k.csv"
line = [[0, 0.0], [2, 0.5], [1, 2.0]]
[[wall]]
name = "stop"
at = { dof = 2 }
side = "upper"
position = 1e-3
restitution = 0.5
[[load]]
at = { dof = 1 }
harmonic = { amplitude = 2.0, frequency = 2.0 }
[time]
end = 0.5
step = 1e-3
"#;

/// The tool on `case` in `dir`, whose results are in the folder `out`.
fn run(dir: &Path, case: &str) -> Output {
    fs::write(dir.join("m.csv"), "1,0,0\n0,1,0\n0,0,1\n").unwrap();
    fs::write(dir.join("k.csv"), "900,-400,0\n-400,900,-400\n0,-400,900\n").unwrap();
    fs::write(dir.join("case.toml"), case).unwrap();
    let tool = env!("CARGO_BIN_EXE_signorini");
    let arguments = ["run", "case.toml", "--no-verdict", "--force", "--out", "out"];
    Command::new(tool).current_dir(dir).args(arguments).output().unwrap()
}

/// The places across the page of the first frame of each line that moves.
fn across(svg: &str) -> Vec<Vec<f64>> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let moving = document.descendants().filter(|n| n.attribute("attributeName") == Some("points"));
    let first = |values: &str| {
        let frame = values.split(';').next().unwrap();
        frame.split(' ').map(|point| point.split(',').next().unwrap().parse().unwrap()).collect()
    };
    moving.map(|n| first(n.attribute("values").unwrap())).collect()
}

/// The share of the way from the first to the last place at which each is.
fn shares(places: &[f64]) -> Vec<f64> {
    let [first, last] = [places[0], places[places.len() - 1]];
    places.iter().map(|x| (x - first) / (last - first)).collect()
}

#[test]
fn modes_and_matrices_are_drawn_along_their_line() {
    let both = MATRICES
        .replace("[system.matrices]", "[system]\nplanes = 2\n[system.matrices]")
        .replace("[[0, 0.0], [2, 0.5], [1, 2.0]]", "[[0, 1, 0.0], [2, 1, 0.5]]")
        .replace("at = { dof = 2 }", "at = { y = [[2, 1.0]], z = [[1, 1.0]] }\ndirection = 0")
        .replace("at = { dof = 1 }", "at = { y = [[0, 1.0]], z = [[1, 1.0]] }\ndirection = 0");
    let cases: [(&str, usize, &[f64]); 3] =
        [(MODES, 2, &[0.0, 0.25, 0.5, 1.0]), (MATRICES, 1, &[0.0, 0.25, 1.0]), (&both, 2, &[0.0, 1.0])];
    for (case, planes, expected) in cases {
        let dir = tempfile::tempdir().unwrap();
        let output = run(dir.path(), case);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success() && !said.contains("animation.svg"), "{said}");
        let svg = fs::read_to_string(dir.path().join("out/animation.svg")).unwrap();
        let lines = across(&svg);
        assert_eq!(lines.len(), planes, "one line a plane");
        for line in lines {
            // Places on the page have one decimal.
            let near = shares(&line).iter().zip(expected).all(|(x, y)| (x - y).abs() < 1e-3);
            assert!(line.len() == expected.len() && near, "{line:?}");
        }
        assert_eq!(svg.contains("attributeName=\"cx\""), case == MODES, "the path within the support");
        let page = fs::read_to_string(dir.path().join("out/report.html")).unwrap();
        let ends = if case == MODES { "\"ends\":[1.0,3.0]" } else { "\"ends\":[0.0," };
        assert!(page.contains(ends), "{ends}");
    }
}

#[test]
fn points_that_lie_nowhere_are_named() {
    let without = |case: &str| case.lines().filter(|line| !line.starts_with("line")).collect::<Vec<_>>().join("\n");
    for (case, table, expected) in
        [(MODES, "[system.modal]", "line = { POINT = 0.0"), (MATRICES, "[system.matrices]", "line = [[0, 0.0]")]
    {
        let dir = tempfile::tempdir().unwrap();
        let output = run(dir.path(), &without(case));
        let said = String::from_utf8_lossy(&output.stderr).replace('\n', " ");
        assert!(output.status.success());
        for word in ["animation.svg", table, expected] {
            assert!(said.contains(word), "{word}: {said}");
        }
        assert!(!dir.path().join("out/animation.svg").exists());
    }
}
