//! `signorini new tube`: a case file from the data of a tube, and what is refused.
use crate::command::said;
use signorini::BeamSection;
use signorini::case::{Case, CaseFile, Model};

#[test]
fn the_file_has_the_tube_that_was_described_and_runs() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let data = ["--length", "4.5", "--supports", "3", "--outer-diameter", "0.02", "--wall", "2e-3", "--gap", "1.5e-4"];
    said(path, &[&["new", "tube"], &data[..]].concat(), 0);
    let case = Case::read(path.join("tube.toml")).unwrap();
    let Model::Beam(beam) = &case.model else { panic!("{:?}", case.model) };
    assert_eq!(beam.length, 4.5);
    assert_eq!(beam.section, BeamSection::Tube { outer_diameter: 0.02, inner_diameter: 0.016 });
    let places: Vec<String> = case.written.supports.iter().map(|support| support.place.to_string()).collect();
    assert_eq!(places, ["1.125 m along it", "2.25 m along it", "3.375 m along it"]);
    assert!(case.scene.holes().all(|hole| hole.gap == 1.5e-4));
    assert!((case.wear.limit.unwrap() - 0.4 * 2e-3).abs() < 1e-15);
    // The fastest mode that is kept has ten steps or more in its period, so that no note complains.
    let [_, fastest] = case.scene.system.frequencies();
    assert!((10.0..20.0).contains(&(std::f64::consts::TAU / fastest / case.time.step)), "{} s", case.time.step);
    let short = ["run", "tube.toml", "--end", "0.2", "--set", "time.statistics_from=0.1", "--no-verdict"];
    let err = said(path, &short, 0).1;
    assert!(!err.contains("do not resolve"), "{err}");
    // What is there is not replaced unasked.
    let err = said(path, &["new", "tube"], 2).1;
    assert!(err.contains("tube.toml") && err.contains("already exists"), "{err}");
    said(path, &["new", "tube", "--out", "rod.toml", "--wall", "9.525e-3"], 0);
    let rod = Case::read(path.join("rod.toml")).unwrap();
    let Model::Beam(rod) = &rod.model else { panic!("{:?}", rod.model) };
    assert!(matches!(rod.section, BeamSection::Tube { inner_diameter: 0.0, .. }));
}

/// Eight modes for each of 31 spans; the fastest is that of a pinned tube, (nπ/L)² √(EI/ρA).
#[test]
fn the_most_supports_make_a_case_whose_step_resolves_its_modes() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["new", "tube", "--supports", "30", "--length", "30"], 0);
    let text = std::fs::read_to_string(dir.path().join("tube.toml")).unwrap();
    assert_eq!(text.matches("[[support]]").count(), 30);
    // Without the flow, whose coherence over all pairs of nodes takes a minute.
    let still = [&text[..text.find("[[turbulence]]").unwrap()], &text[text.find("[wear]").unwrap()..]].concat();
    let case = CaseFile::from_text(&still, "tube", "").case().unwrap();
    let Model::Beam(beam) = &case.model else { panic!("{:?}", case.model) };
    assert_eq!((case.scene.system.degrees_of_freedom(), beam.elements), (2 * 248, 620));
    let (outer, inner) = (19.05e-3_f64, 15.75e-3_f64);
    // I/A of a tube is (D² + d²)/16.
    let radius = ((outer * outer + inner * inner) / 16.0).sqrt();
    let fastest = (248.0 * std::f64::consts::PI / 30.0).powi(2) * radius * (200e9_f64 / 7850.0).sqrt();
    // One digit of the step.
    let steps = std::f64::consts::TAU / fastest / case.time.step;
    assert!((9.9..20.0).contains(&steps), "{steps}");
}

#[test]
fn values_that_make_no_tube_are_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    for (args, words) in [
        (&["tube", "--length", "0"][..], ["--length", "above 0"]),
        (&["tube", "--length", "nan"], ["--length", "above 0"]),
        (&["tube", "--length", "-1"], ["--length", "above 0"]),
        (&["tube", "--supports", "0"], ["--supports", "from 1 to 30"]),
        (&["tube", "--supports", "31"], ["--supports", "from 1 to 30"]),
        (&["tube", "--gap", "inf"], ["--gap", "above 0"]),
        (&["tube", "--wall", "0.1"], ["--wall", "half the outer diameter"]),
        (&["bouncing-ball", "--length", "1"], ["--length", "signorini new tube"]),
    ] {
        let err = said(dir.path(), &[&["new"], args].concat(), 2).1;
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    }
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 0);
}

/// A tube that is a thousand times as long as its elements has slowest modes of 1e-12 of the
/// fastest ω²: the count of the modes below them is one of rounding.
#[test]
fn a_tube_of_many_supports_over_its_usual_length_is_found_its_modes() {
    let dir = tempfile::tempdir().unwrap();
    said(dir.path(), &["new", "tube", "--supports", "20"], 0);
}
