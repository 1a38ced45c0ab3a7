//! The pictures of `run` and `compare`, read back: what they show of long runs, where curves meet
//! walls, and whether texts are kept apart.
use signorini::output::figure::{Curve, Figure, Mark, Panel};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

fn signorini(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_signorini")).arg("-q").args(arguments).output().unwrap()
}

fn drawn(folder: &Path, arguments: &[&str]) {
    let output = signorini(&[arguments, &["--no-verdict", "--out", folder.to_str().unwrap()]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// A text of a picture: its body and its box on the page.
#[derive(Debug)]
struct Label {
    body: String,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// The texts that stand upright, with the width of Helvetica: 0.55 of the size a letter.
fn labels(svg: &str) -> Vec<Label> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let mut out = Vec::new();
    for node in document.descendants().filter(|n| n.has_tag_name("text") && n.attribute("transform").is_none()) {
        let number = |name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
        let body: String = node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        let (x, y, size) = (number("x"), number("y"), number("font-size"));
        let width = 0.55 * size * body.chars().count() as f64;
        let left = match node.attribute("text-anchor") {
            Some("middle") => x - 0.5 * width,
            Some("end") => x - width,
            _ => x,
        };
        out.push(Label { body, left, right: left + width, top: y - 0.75 * size, bottom: y });
    }
    out
}

fn assert_texts_are_apart(svg: &str) {
    let labels = labels(svg);
    assert!(labels.len() > 3);
    for (i, a) in labels.iter().enumerate() {
        for b in labels.iter().take(i) {
            let apart = a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
            assert!(apart, "{a:?} covers {b:?}");
        }
    }
}

/// The vertical places of a polyline and of the wall lines (grey, 1.8 wide) of a picture.
fn heights(svg: &str, colour: &str) -> (Vec<f64>, Vec<f64>) {
    let document = roxmltree::Document::parse(svg).unwrap();
    let of = |stroke: &str, width: &str| -> Vec<f64> {
        let paths = document
            .descendants()
            .filter(|n| n.attribute("stroke") == Some(stroke) && n.attribute("stroke-width") == Some(width));
        let pairs = paths.filter_map(|n| n.attribute("d")).flat_map(|d| d.split(['M', 'L', ' ']).collect::<Vec<_>>());
        pairs.filter_map(|pair| pair.split_once(',')).map(|(_, y)| y.parse().unwrap()).collect()
    };
    (of(colour, "1.2"), of("#555", "1.8"))
}

#[test]
fn peaks_of_the_exact_motion_reach_the_walls_between_the_rows() {
    let folder = tempfile::tempdir().unwrap();
    // Rows of 10 ms: the fastest arrival, 0.3 m/s, passes 3 mm of the 5 mm gap from one to the
    // next.
    let sparse = ["run", "rigid-walls-sine", "--scheme", "event", "--sample", "1e-2", "--from", "0", "--to", "2"];
    drawn(folder.path(), &sparse);
    let (curve, walls) = heights(&read(folder.path(), "displacement.svg"), "#000000");
    let (top, bottom) = (walls.iter().copied().fold(f64::MAX, f64::min), walls.iter().copied().fold(0.0, f64::max));
    // Coordinates are written to a tenth.
    let near = |wall: f64| curve.iter().filter(|y| (**y - wall).abs() < 0.11).count();
    assert!(bottom - top > 100.0);
    // contacts.csv is made by the scheme and not by the picture.
    let contacts = read(folder.path(), "contacts.csv");
    let early = |line: &&str| line.split(',').nth(1).is_some_and(|t| t.parse::<f64>().is_ok_and(|t| t < 2.0));
    let expected = contacts.lines().filter(early).count();
    assert!(expected > 15, "{contacts}");
    assert!(near(top) + near(bottom) >= expected, "{} and {} of {expected}", near(top), near(bottom));
    assert!(curve.iter().all(|y| *y > top - 0.11 && *y < bottom + 0.11), "nothing is drawn behind a wall");
}

#[test]
fn a_long_run_shows_its_envelope_and_its_last_periods_and_orbits_of_these_alone() {
    let folder = tempfile::tempdir().unwrap();
    drawn(folder.path(), &["run", "rigid-walls-sine"]);
    let displacement = read(folder.path(), "displacement.svg");
    assert!(displacement.contains("Last 10 periods of 5 Hz") && displacement.contains("fill-opacity"));
    assert_texts_are_apart(&displacement);
    let phase = read(folder.path(), "phase.svg");
    let title = &labels(&phase)[0].body;
    assert!(title.contains("rigid walls"), "{title}");
    assert!(phase.contains("last 10 periods of 5\u{a0}Hz, 8 to 10\u{a0}s"));
    // Two seconds of it are drawn as they are.
    drawn(folder.path(), &["run", "rigid-walls-sine", "--from", "4", "--to", "6"]);
    let displacement = read(folder.path(), "displacement.svg");
    assert!(!displacement.contains("Last 10") && !displacement.contains("fill-opacity"));
    let numbers: Vec<String> = labels(&displacement).into_iter().map(|l| l.body).collect();
    assert!(numbers.contains(&"4.2".to_owned()) && !numbers.contains(&"10".to_owned()), "{numbers:?}");
}

#[test]
fn a_stretch_outside_the_run_is_a_wrong_request() {
    for (arguments, expected) in [
        (["--from", "10"], "from 0 to below the end of the run, 10 s"),
        (["--from", "-1"], "from 0 to below"),
        (["--to", "11"], "up to the end, 10 s"),
        (["--to", "0"], "above 0 s"),
        (["--to", "nan"], "above 0 s"),
    ] {
        for command in ["run", "compare"] {
            let output = signorini(&[&[command, "rigid-walls-sine"], arguments.as_slice()].concat());
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{command} {arguments:?}: {said}");
            assert!(said.contains(expected), "{command} {arguments:?}: {said}");
        }
    }
}

/// The colour of each label of a legend: that of the line drawn just before it.
fn legend(svg: &str) -> BTreeMap<String, String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let mut out = BTreeMap::new();
    let mut sample = None;
    for node in document.root_element().children().filter(roxmltree::Node::is_element) {
        match (node.tag_name().name(), sample.take()) {
            ("text", Some(colour)) => {
                out.insert(node.text().unwrap_or_default().to_owned(), colour);
            }
            ("path", before) => sample = before.or(node.attribute("stroke").map(str::to_owned)),
            ("circle", before) => sample = before,
            _ => {}
        }
    }
    out
}

#[test]
fn a_method_has_one_colour_in_all_figures_of_a_command() {
    let folder = tempfile::tempdir().unwrap();
    drawn(folder.path(), &["compare", "rigid-walls-sine", "--end", "1"]);
    let mut colours: BTreeMap<String, String> = BTreeMap::new();
    for name in ["displacement.svg", "velocity.svg", "phase.svg", "contact-force.svg"] {
        let legend = legend(&read(folder.path(), name));
        for method in ["located", "located:qp=clarabel", "penalty:epsilon=1e-9", "event"] {
            let colour = legend.get(method).unwrap_or_else(|| panic!("{name}: {legend:?}")).clone();
            let first = colours.entry(method.to_owned()).or_insert_with(|| colour.clone());
            assert_eq!(*first, colour, "{method} in {name}");
        }
    }
    // A method's own folder keeps its colour, and a curve that is alone has no legend.
    let own = read(folder.path(), "penalty-epsilon-1e-9/displacement.svg");
    assert!(own.contains(&format!("stroke=\"{}\" stroke-width=\"1.2\"", colours["penalty:epsilon=1e-9"])));
    let said = labels(&own).into_iter().filter(|l| l.body.contains("penalty:epsilon=1e-9")).count();
    assert_eq!(said, 1, "the title alone names it");
}

#[test]
fn four_hundred_walls_and_tiny_powers_of_ten_leave_every_text_legible() {
    let points: Vec<(f64, f64)> =
        (0..200).map(f64::from).map(|i| (3e-81 * (0.1 * i).sin(), 2e-81 * (0.1 * i).cos())).collect();
    let mut level = Panel::new("Displacement (mm)").heading("last").curve(Curve::new("a", points.clone()));
    let mut upright = Panel::new("Velocity (mm/s)").heading("last").curve(Curve::new("b", points));
    for i in 0..400 {
        let place = 1e-83 * f64::from(i) - 2e-81;
        level = level.mark(Mark::wall(place, format!("stop-{i}")));
        upright = upright.mark(Mark::wall(place, format!("stop-{i}")).upright());
    }
    let svg = Figure::new("Four hundred walls", "Displacement with a name as long as it can be, and more (mm)")
        .panel(level)
        .panel(upright)
        .to_svg();
    assert_texts_are_apart(&svg);
    let labels = labels(&svg);
    assert!(labels.iter().all(|l| l.right < 645.0 && l.left > -5.0), "{labels:?}");
    assert!(labels.iter().any(|l| l.body.contains("stop-0 … stop-")));
}

/// The frames of the moving points and lines of a picture: numbers of an attribute, frame by frame.
fn frames(svg: &str, attribute: &str) -> Vec<Vec<Vec<f64>>> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let moving = document.descendants().filter(|n| n.attribute("attributeName") == Some(attribute));
    let numbers = |frame: &str| frame.split([' ', ',']).map(|number| number.parse().unwrap()).collect();
    moving.map(|n| n.attribute("values").unwrap().split(';').map(numbers).collect()).collect()
}

/// The axis of a tube moves within its round supports, frame by frame, and the tube from the side
/// is at its place in each plane.
#[test]
fn a_tube_moves_within_its_supports() {
    let dir = tempfile::tempdir().unwrap();
    let end = ["--end", "0.5", "--set", "time.statistics_from=0"];
    drawn(dir.path(), &[&["run", "tube-round-supports"], &end[..]].concat());
    let svg = read(dir.path(), "animation.svg");
    let (across, down) = (frames(&svg, "cx"), frames(&svg, "cy"));
    assert_eq!((across.len(), down.len()), (2, 2));
    let document = roxmltree::Document::parse(&svg).unwrap();
    let outlines = document.descendants().filter(|n| n.attribute("stroke-width") == Some("2"));
    let circles: Vec<Vec<(f64, f64)>> = outlines
        .filter_map(|n| n.attribute("d"))
        .map(|d| d.split(['M', 'L', ' ']).filter_map(|pair| pair.split_once(',')).collect::<Vec<_>>())
        .filter(|points| points.len() > 3)
        .map(|points| points.into_iter().map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap())).collect())
        .collect();
    assert_eq!(circles.len(), 2);
    for (circle, (across, down)) in circles.iter().zip(across.iter().zip(&down)) {
        let [left, right] = [f64::min, f64::max].map(|pick| circle.iter().map(|p| p.0).reduce(pick).unwrap());
        let [top, bottom] = [f64::min, f64::max].map(|pick| circle.iter().map(|p| p.1).reduce(pick).unwrap());
        let radius = 0.5 * (right - left);
        assert!((bottom - top - 2.0 * radius).abs() < 0.3, "not a circle: {left} {right} {top} {bottom}");
        let distances: Vec<f64> = (across.iter().flatten().zip(down.iter().flatten()))
            .map(|(x, y)| (x - 0.5 * (left + right)).hypot(y - 0.5 * (top + bottom)))
            .collect();
        assert!(distances.len() > 100 && distances.len() <= 240, "{}", distances.len());
        // moreau-jean passes the circle by up to 2.5e-6 of 2e-4 m here; numbers have one decimal.
        let farthest = distances.iter().copied().fold(0.0, f64::max);
        assert!(farthest < 1.02 * radius + 0.2 && farthest > 0.9 * radius, "{farthest} of {radius}");
    }
    let tubes = frames(&svg, "points");
    assert_eq!(tubes.len(), 2, "one line a plane");
    for tube in tubes {
        assert_eq!(tube.len(), across[0].len());
        // A tube pinned at its ends stays there, and moves between them.
        let ends = |frame: &Vec<f64>| (frame[1], frame[frame.len() - 1]);
        assert!(tube.iter().all(|frame| ends(frame) == ends(&tube[0])));
        let middle = (tube[0].len() / 2) | 1;
        assert!(tube.iter().any(|frame| (frame[middle] - tube[0][middle]).abs() > 1.0));
    }
}

/// In one plane the walls stand above and below the tube; an oscillator has no such picture.
#[test]
fn a_moving_picture_is_made_of_tubes_alone() {
    let dir = tempfile::tempdir().unwrap();
    drawn(&dir.path().join("tube"), &["run", "tube-loose-supports", "--end", "0.2"]);
    let svg = read(&dir.path().join("tube"), "animation.svg");
    assert_eq!((frames(&svg, "points").len(), frames(&svg, "cx").len()), (1, 0));
    assert_eq!(svg.matches("stroke-width=\"2\"").count(), 4, "two walls at each of two supports");
    drawn(&dir.path().join("oscillator"), &["run", "rigid-walls-sine", "--end", "0.2"]);
    assert!(!dir.path().join("oscillator").join("animation.svg").exists());
}

/// What README.md shows is what the tool draws. The motion is chaotic and its bits are those of the
/// processor's vectors, so that the paths differ from machine to machine: the words are compared,
/// with every number left out, and how many curves there are.
#[test]
fn the_pictures_of_the_readme_are_those_of_the_tool() {
    let dir = tempfile::tempdir().unwrap();
    drawn(dir.path(), &["run", "tube-round-supports"]);
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures");
    let words = |svg: &str| -> Vec<String> {
        let letters = |body: String| body.chars().filter(|c| !c.is_ascii_digit()).collect();
        labels(svg).into_iter().map(|label| letters(label.body)).collect()
    };
    for (file, picture) in [("animation.svg", "tube.svg"), ("orbit.svg", "orbit.svg")] {
        let (now, then) = (read(dir.path(), file), read(&kept, picture));
        assert_eq!(words(&now), words(&then), "CONTRIBUTING.md says how docs/pictures/{picture} is made");
        for element in ["<path", "<polyline", "<circle", "<animate"] {
            assert_eq!(now.matches(element).count(), then.matches(element).count(), "{element} of {picture}");
        }
    }
}
