//! Judging and recording are left out one by one: what remains is unchanged, and what was left out
//! is absent.

use crate::common::source;
use signorini::qp::Backend;
use signorini::{
    Chain, Load, Method, Options, Recorded, Row, Run, Scene, Scheme, TimeOptions, Trajectory, Unjudged, Wall, run,
};

fn structure() -> Scene {
    let chain = Chain { masses: vec![1.0; 3], springs: vec![100.0; 2], grounds: [100.0, 0.0] };
    let scene = Scene::structure(chain.structure().expect("a chain"))
        .with_wall(Wall::upper("stop", 0.01).with_restitution(0.5).at(Row::dof(2)));
    let load = Load { at: Row::dof(0), ..Load::harmonic(2.0, 1.5, 0.0) };
    scene.with_load(load).with_probe("end", Row::dof(2)).with_duration(1.0)
}

#[test]
fn a_structure_without_a_probe_says_that_nothing_of_its_motion_is_recorded() {
    let told = |scene: &Scene, options: Options| {
        let notes = run(scene, &Scheme::MoreauJean { theta: 0.5 }, &options).expect("a run").notes;
        notes.iter().filter(|note| note.contains("no probe")).count()
    };
    let (seen, options) = (structure(), Options::with_step(2e-3));
    let blind = Scene { probes: Vec::new(), ..seen.clone() };
    assert_eq!([&blind, &seen, &source(0.8, 0.8).with_duration(1.0)].map(|scene| told(scene, options)), [1, 0, 0]);
    let refused = seen.with_probe("tip", Row::dof(1)).with_probe("end", Row::dof(0)).validate().unwrap_err();
    let expected = "probe 3: name is \"end\", which another probe has; expected a name of its own for each probe";
    assert_eq!(refused.to_string(), expected);
}

fn same_motion<J: signorini::Judging, R: signorini::Recording>(a: &Run, b: &Run<J, R>) {
    assert_eq!((&a.state, a.grid, a.counters), (&b.state, b.grid, b.counters));
    assert_eq!(a.backend, b.backend);
}

#[test]
fn what_is_left_out_changes_nothing_of_what_remains() {
    for scene in [source(0.8, 0.8).with_duration(1.0), structure()] {
        for scheme in [Scheme::Event, Scheme::MoreauJean { theta: 0.5 }, Scheme::PaoliSchatzman] {
            // A spacing of rows that shortens the step: it stays where there are no rows.
            let time = TimeOptions { sample: Some(7e-3), ..TimeOptions::with_step(2e-3) };
            let options = Options { time, ..Options::with_step(2e-3) };
            let full = run(&scene, &scheme, &options).expect("a run");
            let judged = run(&scene, &scheme, &options.unrecorded()).expect("a run");
            let recorded = run(&scene, &scheme, &options.unjudged()).expect("a run");
            let bare = run(&scene, &scheme, &options.unrecorded().unjudged()).expect("a run");
            same_motion(&full, &judged);
            same_motion(&full, &recorded);
            same_motion(&full, &bare);
            assert_eq!(full.residuals, judged.residuals);
            assert_eq!((&full.trajectory, &full.statistics), (&recorded.trajectory, &recorded.statistics));
            // For code that takes runs of any kind.
            let nothing = (judged.recorded().is_none(), recorded.judged().is_none(), bare.judged().is_none());
            assert_eq!(nothing, (true, true, true));
            assert_eq!(recorded.recorded(), Some(&full.trajectory));
            assert_eq!(judged.judged(), Some(&full.residuals));
        }
    }
}

#[test]
fn what_was_left_out_is_absent_from_the_type() {
    let scene = source(1.0, 1.0).with_duration(0.1);
    let Run { residuals: (), trajectory, .. }: Run<Unjudged, Recorded> =
        run(&scene, &Scheme::Event, &Options::with_step(1e-3).unjudged()).expect("a run");
    let _: Trajectory = trajectory;
    let Run { trajectory: (), statistics: (), .. } =
        run(&scene, &Scheme::Event, &Options::with_step(1e-3).unrecorded()).expect("a run");
}

#[test]
fn a_run_without_rows_may_have_more_steps_than_rows_are_allowed() {
    // 2e7 steps would be refused with every step recorded; the first check of an unrecorded run is
    // another.
    let scene = Scene::oscillator(1.0, 0.0, 1.0).with_duration(1.0);
    let scheme = Scheme::MoreauJean { theta: 0.5 };
    let options = Options::with_step(0.9e-7);
    assert!(run(&scene, &scheme, &options).is_err());
    let bare = run(&scene, &scheme, &options.unjudged().unrecorded()).expect("a run");
    assert!(bare.grid.steps > 10_000_000, "{:?}", bare.grid);
}

#[test]
fn a_solver_is_named_beside_schemes_that_have_programmes_only() {
    let method: Method = "moreau-jean:theta=0.75,qp=clarabel".parse().expect("a scheme and a solver");
    assert_eq!(method, Method { scheme: Scheme::MoreauJean { theta: 0.75 }, backend: Backend::Clarabel });
    let method: Method = " moreau-jean:qp=clarabel ".parse().expect("a solver alone");
    assert_eq!(method, Method { scheme: Scheme::MoreauJean { theta: 0.5 }, backend: Backend::Clarabel });
    let error = "event:qp=clarabel".parse::<Method>().expect_err("no programmes").to_string();
    assert!(error.contains("a scheme that solves quadratic programmes"), "{error}");
    // The solver that is taken anyway may be named everywhere.
    assert_eq!("event:qp=auto".parse::<Method>().expect("the default").scheme, Scheme::Event);
}
