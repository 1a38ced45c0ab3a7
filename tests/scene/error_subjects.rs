//! What errors refer to: typed paths in the library's terms, and the place in the file where a case
//! was read.

use signorini::case::Case;
use signorini::{
    Bar, BarEnd, Chain, Damping, Error, MassMatrix, Options, Part, Row, Scene, Scheme, Subject, Wall, run,
};
use std::error::Error as _;

const CASE: &str = "[system.chain]\nmasses = [1.0, 1.0]\nsprings = [1e4]\n[[wall]]\nname = \"stop\"\nside = \"upper\"\n\
                    position = 1e-3\nrestitution = 1.5\nat = { dof = 1 }\n[time]\nend = 1.0\nstep = 1e-3\n";

fn subject(error: &Error) -> Subject {
    let Error::Invalid { subject, .. } = error else { panic!("{error}") };
    subject.clone()
}

#[test]
fn a_library_user_is_told_of_no_case_keys() {
    let oscillator = Scene::oscillator(1.0, 0.0, 100.0);
    let chain = Chain { masses: vec![1.0, -1.0], springs: vec![1e4], grounds: [0.0; 2] };
    let bar = Bar {
        length: 1.0,
        area: -1e-4,
        youngs_modulus: 2e11,
        density: 7850.0,
        elements: 4,
        left: BarEnd::Free,
        right: BarEnd::Free,
        mass: MassMatrix::Lumped,
    };
    let sound = Chain { masses: vec![1.0, 1.0], ..chain.clone() }.structure().unwrap();
    let step = |step: f64| run(&oscillator, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(step)).map(|_| ());
    let errors = [
        (oscillator.clone().with_duration(-1.0).validate(), "duration"),
        (oscillator.clone().with_initial(&[f64::NAN], &[0.0]).validate(), "initial state: displacement"),
        (Scene::oscillator(1.0, -1.0, 1.0).validate(), "oscillator: damping"),
        (chain.structure().map(|_| ()), "chain: masses: value 2"),
        (bar.structure().map(|_| ()), "bar: area"),
        (sound.with_damping(&Damping::Modal(Vec::new())).map(|_| ()), "damping: ratios"),
        (step(-1.0), "step"),
        (step(2.0), "step"),
    ];
    for (refused, named) in errors {
        let error = refused.unwrap_err();
        assert_eq!(subject(&error).to_string(), named);
        for key in ["time.", "system.", "initial.", "[["] {
            assert!(!error.to_string().contains(key), "{error}");
        }
    }
}

#[test]
fn an_error_of_a_case_file_has_its_place_its_key_and_its_cause() {
    let error = Case::parse(CASE, "two.toml", ".").unwrap_err();
    let said = error.to_string();
    assert!(said.contains("two.toml:8:15") && said.contains("wall \"stop\": restitution is 1.5"), "{said}");
    let cause = error.source().expect("a cause").downcast_ref::<Error>().expect("an error of the library");
    assert_eq!(subject(cause), Subject::wall("stop").part("restitution"));
    assert_eq!(subject(cause).parts(), [Part::Named("wall", "stop".into()), Part::Name("restitution".into())]);

    // A value within a list, under the key of the list's own table.
    let error = Case::parse(&CASE.replace("[1.0, 1.0]", "[1.0, -1.0]"), "two.toml", ".").unwrap_err();
    let said = error.to_string();
    assert!(said.contains("two.toml:2:16") && said.contains("system.chain.masses: value 2 is -1.0"), "{said}");

    // A text that is not TOML gives the TOML reader's own error.
    let error = Case::parse("[system", "two.toml", ".").unwrap_err();
    assert!(error.source().is_some());
    // An error of the library itself has no place in a file.
    let wall = Wall::upper("far", 1.0).at(Row::dof(7));
    let error = Scene::oscillator(1.0, 0.0, 1.0).with_wall(wall).validate().unwrap_err();
    assert_eq!(subject(&error), Subject::wall("far").part("at"));
    assert_eq!(subject(&error).enclosing(), Some(Subject::wall("far")));
    assert!(error.source().is_none());
}

#[test]
fn a_case_that_was_changed_is_refused_by_its_keys() {
    let case = Case::embedded("rigid-walls-sine").unwrap();
    let refused = |key: &str, x: f64| case.with(key, x).unwrap_err().to_string();
    assert!(refused("time.step", 20.0).starts_with("error: time.step is 20.0"));
    assert!(refused("time.end", f64::INFINITY).starts_with("error: time.end is inf"));
}
