//! Cases that leave step and elements to their modes.
use signorini::case::{Case, CaseFile, Model};

/// A pinned tube of two spans with `system` in its table, and `beam` and `time` in theirs.
fn tube(system: &str, beam: &str, time: &str) -> signorini::Result<Case> {
    let text = format!(
        "[system]\n{system}\n[system.beam]\nspans = [1.0, 1.0]\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
         outer_diameter = 0.02\nleft = \"pinned\"\nright = \"pinned\"\n{beam}\n\
         [[load]]\nat = {{ position = 0.5 }}\nconstant = {{ force = 10.0 }}\n[time]\nend = 0.01\n{time}\n"
    );
    CaseFile::from_text(&text, "tube", "").case()
}

/// The frequencies of a pinned beam, (nπ/L)² √(EI/ρA), are known: of a rod EI/ρA is E D²/16ρ.
#[test]
fn a_case_without_step_and_elements_has_those_of_its_modes() {
    let case = tube("modes = 6", "", "").unwrap();
    let fastest = (6.0 * std::f64::consts::PI / 2.0).powi(2) * (2e11_f64 * 0.02 * 0.02 / (16.0 * 7850.0)).sqrt();
    let tenth = std::f64::consts::TAU / (10.0 * fastest);
    assert!((2e-4..3e-4).contains(&tenth), "{tenth}");
    assert_eq!((case.time.step, case.written.chosen_step), (5e-5, Some(5e-5)));
    let Model::Beam(beam) = &case.model else { panic!("{:?}", case.model) };
    assert_eq!(beam.elements, 40);
    // It is the case that states them, to the last bit.
    let stated = tube("modes = 6", "elements = 40", "step = 5e-5").unwrap();
    assert_eq!((&case.scene, case.time), (&stated.scene, stated.time));
    assert_eq!(stated.written.chosen_step, None);
    // A tenth of the period where that is shorter, with one digit.
    let fast = tube("modes = 20", "", "").unwrap();
    let tenth = tenth * (6.0_f64 / 20.0).powi(2);
    assert!((2e-5..3e-5).contains(&tenth) && fast.time.step == 2e-5, "{tenth} {}", fast.time.step);
    let Model::Beam(beam) = &tube("modes = 40", "", "").unwrap().model else { panic!("a beam") };
    assert_eq!(beam.elements, 100);
}

#[test]
fn a_step_that_is_left_out_can_be_changed_and_is_at_most_half_the_run() {
    let case = tube("modes = 6", "", "").unwrap();
    let other = case.with("time.step", 1e-5).unwrap();
    assert_eq!((other.time.step, other.written.chosen_step), (1e-5, None));
    let text = "[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1.0\n[time]\nend = 6e-5\n";
    assert_eq!(CaseFile::from_text(text, "short", "").case().unwrap().time.step, 3e-5);
}

/// Of a pinned beam with one element in each half wave the fastest mode is √1.21 times too fast,
/// with two and a half by less than 0.3 %.
#[test]
fn a_mesh_too_coarse_for_its_modes_is_told() {
    let said = |case: &Case| case.notes().into_iter().find(|note| note.contains("half wave"));
    let [coarse, fine] = ["elements = 20", ""].map(|elements| tube("modes = 20", elements, "").unwrap());
    assert!(said(&coarse).is_some_and(|note| note.contains("elements = 50")), "{:?}", coarse.notes());
    assert_eq!(said(&fine), None);
    let exact = (20.0 * std::f64::consts::PI / 2.0).powi(2) * (2e11_f64 * 0.02 * 0.02 / (16.0 * 7850.0)).sqrt();
    let [coarse, fine] = [coarse, fine].map(|case| case.scene.system.frequencies()[1] / exact);
    assert!(coarse > 1.1 && (1.0..1.003).contains(&fine), "{coarse} {fine}");
}

/// The fastest motion of a mesh is that of its smallest element: no step is chosen for it.
#[test]
fn elements_without_modes_need_a_step() {
    let said = tube("", "", "").unwrap_err().to_string();
    let words = ["`step` is missing in `time`", "expected step = a number above 0, in s", "`modes` in [system]"];
    assert!(words.iter().all(|word| said.contains(word)) && said.contains("--> tube:14:1"), "{said}");
}
