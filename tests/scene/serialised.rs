//! Scenes and runs written down and read again: the same to the last bit, or refused.

use serde_json::{Value, from_value, to_value};
use signorini::{
    Beam, BeamEnd, BeamSection, Damping, Load, Options, Row, Run, Scene, Scheme, Table, Trajectory, Wall,
    linear::Symmetric, run,
};

fn oscillator() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_elasticity(1e4, 3.0))
        .with_load(Load::harmonic(3.0, 5.0, 0.1))
        .with_load(Load::impulse(0.5, 0.2))
        .with_load(Load::table(Table::new(vec![0.0, 0.1, 1.0 / 3.0], vec![0.0, 1.0 / 3.0, 2.0]).unwrap()))
}

fn tube() -> Scene {
    let tube = Beam {
        length: 3.0,
        youngs_modulus: 2e11,
        density: 7850.0,
        section: BeamSection::Tube { outer_diameter: 19.05e-3, inner_diameter: 15.75e-3 },
        added_mass: 0.565,
        elements: 6,
        left: BeamEnd::Pinned,
        right: BeamEnd::Sprung { stiffness: 1e5, rotational: 0.0 },
    };
    let structure = tube.structure().unwrap().with_damping(&Damping::Rayleigh { mass: 0.1, stiffness: 1e-6 }).unwrap();
    Scene::structure(structure)
        .with_wall(Wall::upper("first", 2e-4).at(tube.at(1.0).unwrap()))
        .with_load(Load { at: Row::new(vec![(3, 1.0), (1, -0.5)]), ..Load::constant(10.0) })
        .with_duration(0.05)
}

#[test]
fn scenes_come_back_the_same() {
    for scene in [oscillator(), tube(), tube().reduced(4, true).unwrap().scene] {
        let back: Scene = from_value(to_value(&scene).unwrap()).unwrap();
        assert_eq!(back, scene);
        back.validate().unwrap();
    }
}

#[test]
fn sections_come_back_the_same() {
    for section in [
        BeamSection::Tube { outer_diameter: 19.05e-3, inner_diameter: 1.0 / 3.0 },
        BeamSection::Rectangle { width: 0.05, height: 1.0 / 3.0 },
    ] {
        assert_eq!(from_value::<BeamSection>(to_value(section).unwrap()).unwrap(), section);
    }
    assert!(from_value::<BeamSection>(serde_json::json!({ "Rectangle": { "width": 0.05 } })).is_err());
}

#[test]
fn runs_come_back_the_same() {
    let made = run(&oscillator(), &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-3)).unwrap();
    let back: Run = from_value(to_value(&made).unwrap()).unwrap();
    assert_eq!(back.trajectory, made.trajectory);
    assert_eq!(back.residuals, made.residuals);
    assert_eq!(back.statistics, made.statistics);
    assert_eq!((back.scheme, back.grid, back.state, back.notes), (made.scheme, made.grid, made.state, made.notes));
}

#[test]
fn a_function_of_time_has_no_written_form() {
    let scene = oscillator().with_load(Load::function(|t| t));
    assert!(to_value(&scene).unwrap_err().to_string().contains("Function"));
}

/// The value at `path` of `whole` changed to `value`.
fn changed(mut whole: Value, path: &str, value: Value) -> Value {
    *whole.pointer_mut(path).unwrap_or_else(|| panic!("no {path}")) = value;
    whole
}

#[test]
fn what_breaks_an_invariant_is_refused() {
    let matrix = to_value(Symmetric::from_entries(2, [(0, 0, 2.0), (1, 0, -1.0), (1, 1, 2.0)])).unwrap();
    for (path, value) in [
        ("/starts", vec![0, 1]),
        ("/starts", vec![0, 3, 1]),
        ("/starts", vec![]),
        ("/starts", vec![0, 0, 3]),
        ("/columns", vec![0, 1, 0]),
        ("/columns", vec![0, 0, 9]),
        ("/values", vec![1, 1]),
    ] {
        let error = from_value::<Symmetric>(changed(matrix.clone(), path, value.clone().into())).unwrap_err();
        assert!(error.to_string().contains("lower triangle"), "{path} {value:?}: {error}");
    }
    assert!(from_value::<Symmetric>(matrix).is_ok());

    let table = to_value(Table::new(vec![0.0, 1.0], vec![0.0, 2.0]).unwrap()).unwrap();
    let error = from_value::<Table>(changed(table, "/time", vec![1.0, 1.0].into())).unwrap_err();
    assert!(error.to_string().contains("more than the row before"), "{error}");

    let made = run(&oscillator(), &Scheme::Event, &Options::with_step(1e-3)).unwrap();
    let trajectory = to_value(&made.trajectory).unwrap();
    for (path, value) in [
        ("/walls", Value::from(vec!["upper"])),
        ("/velocity/0", vec![0.0].into()),
        ("/force", Value::Array(Vec::new())),
        ("/contacts/0/wall", 2.into()),
    ] {
        let error = from_value::<Trajectory>(changed(trajectory.clone(), path, value)).unwrap_err();
        assert!(error.to_string().contains("a column for each wall"), "{path}: {error}");
    }
}
