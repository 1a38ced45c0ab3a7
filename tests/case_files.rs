//! The case files that come with the crate: each holds the scene that it says.
#![cfg(feature = "cli")]

use signorini::case::{Case, Embedded};
use signorini::{Integrator, PenaltyLaw};
use signorini::{Load, LoadKind, Scene, Wall};
use std::fs;
use std::path::Path;

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/cases"))
}

fn embedded(name: &str) -> Case {
    Case::embedded(name).unwrap_or_else(|error| panic!("{error}"))
}

fn source(end: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_duration(end)
}

fn between_rigid_walls(end: f64) -> Scene {
    source(end).with_wall(Wall::upper("upper", 5e-3)).with_wall(Wall::lower("lower", -5e-3))
}

fn sine() -> Load {
    Load::harmonic(3.0, 5.0, 0.0)
}

fn quartic() -> Vec<PenaltyLaw> {
    [1e-12, 1e-9, 1e-6].map(|epsilon| PenaltyLaw::Quartic { epsilon }).to_vec()
}

#[test]
fn every_file_of_the_folder_is_embedded_and_reads_the_same() {
    let mut names: Vec<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    let mut known: Vec<String> = Embedded::all().iter().map(|case| case.name.to_owned()).collect();
    known.sort();
    assert_eq!(names, known);
    for name in names {
        let read = Case::read(folder().join(format!("{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(read, embedded(&name));
        assert_eq!(read.name, name);
        assert!(read.title.is_some() && read.source.is_some(), "{name}");
        assert!(read.time.sample.is_some(), "{name}");
    }
    assert!(Case::embedded("no-such-case").is_err_and(|e| e.to_string().contains("bouncing-ball")));
}

#[test]
fn the_page_about_the_cases_names_each_of_them() {
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    for case in Embedded::all() {
        assert!(page.contains(&format!("`{}`", case.name)), "{}", case.name);
    }
}

#[test]
fn linear_cases_have_no_walls() {
    let case = embedded("linear-sine");
    assert_eq!(case.scene, source(10.0).with_load(sine()));
    assert_eq!((case.time.step, case.time.sample, case.time.statistics_from), (1e-4, Some(1e-3), 0.0));
    assert_eq!(embedded("linear-impulse").scene, source(10.0).with_load(Load::impulse(0.1, 0.0)));
}

#[test]
fn the_main_scene_stands_between_rigid_walls_of_restitution_1() {
    for (name, end) in [("rigid-walls-sine", 10.0), ("penalty-epsilon", 10.0), ("independent-code", 2.0)] {
        let case = embedded(name);
        assert_eq!(case.scene, between_rigid_walls(end).with_load(sine()), "{name}");
        assert_eq!(case.penalty.laws, quartic(), "{name}");
    }
    assert_eq!(embedded("penalty-epsilon").penalty.integrator, Some(Integrator::DiscreteGradient));
    let case = embedded("rigid-walls-impulse");
    assert_eq!(case.scene, between_rigid_walls(10.0).with_load(Load::impulse(0.1, 0.0)));
    assert!(Embedded::named("rigid-walls-impulse").is_ok_and(|case| case.text.contains("ASSUMED")));
}

#[test]
fn the_elastic_wall_is_as_stiff_as_the_oscillator() {
    let case = embedded("elastic-wall");
    let walls = [Wall::upper("upper", 5e-3).with_elasticity(100.0, 0.0), Wall::lower("lower", -5e-3)];
    let scene = walls.into_iter().fold(source(10.0), Scene::with_wall);
    assert_eq!(case.scene, scene.with_load(sine()));
    assert_eq!(case.penalty.laws, quartic());
}

#[test]
fn the_cases_of_the_field_are_the_published_ones() {
    let ball = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(10.0);
    assert_eq!(embedded("bouncing-ball").scene, ball);
    let sdnd101 = Scene::oscillator(100.0, 0.0, 1e4)
        .with_wall(Wall::upper("stop", 0.0).with_elasticity(1e6, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.5);
    assert_eq!(embedded("code-aster-sdnd101").scene, sdnd101);
    let sdnd108a = Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::lower("floor", -2.0).with_elasticity(100.0, 0.0))
        .with_load(Load::constant(-10.0))
        .with_initial(&[0.0], &[-1.0])
        .with_duration(1.1);
    assert_eq!(embedded("code-aster-sdnd108a").scene, sdnd108a);
    let siconos = Scene::oscillator(1e-3, 0.0, 100.0)
        .with_wall(Wall::lower("floor", 0.0).with_restitution(0.9))
        .with_load(Load::constant(-9.81e-3))
        .with_initial(&[1.0], &[0.0])
        .with_duration(0.1);
    assert_eq!(embedded("siconos-oscillator").scene, siconos);
}

#[test]
fn the_tabulated_pulse_reads_its_table() {
    let case = embedded("tabulated-pulse");
    let [Load { kind: LoadKind::Table(table), .. }] = case.scene.loads.as_slice() else {
        panic!("{:?}", case.scene.loads);
    };
    assert_eq!(table.time(), [0.0, 0.01, 0.02, 0.03, 0.04, 0.05]);
    assert_eq!(table.force(), [0.0, 5000.0, 4200.0, 2600.0, 1100.0, 0.0]);
    assert_eq!(case.scene.walls, [Wall::upper("restraint", 0.01).with_elasticity(2e6, 1000.0)]);
}

#[test]
fn changed_values_are_checked_again() {
    let mut case = embedded("rigid-walls-sine");
    case.time.step = 20.0;
    assert!(case.validate().is_err_and(|e| e.is_request() && e.to_string().contains("time.step")));
}
