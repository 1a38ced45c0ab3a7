//! Computations that are stopped on their way, and what is left behind.

use signorini::case::CaseFile;
use signorini::study::accuracy::{self, Target};
use signorini::study::compare::compare;
use signorini::study::stability::family::MapRequest;
use signorini::study::stability::plan::{Grid, Plan};
use signorini::study::verdict::Verdict;
use signorini::sweep::{Axis, Measure, Shard, Sweep, SweepOptions};
use signorini::{Chain, Error, Interrupt, Load, Options, Result, Scene, Scheme, Stepper, TimeOptions, Wall, run};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

const MOREAU_JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

fn scene() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
}

/// An interrupt that says yes once this has passed.
fn after(patience: Duration) -> Interrupt {
    let started = Instant::now();
    Interrupt::new(move || started.elapsed() > patience)
}

/// Fails unless `work`, which takes minutes, is given up: bounded by far more than the 0.2 s that
/// it takes on an idle machine, for machines that are not.
fn stops<T: std::fmt::Debug>(name: &str, work: impl FnOnce() -> Result<T>) {
    let started = Instant::now();
    let outcome = after(Duration::from_millis(20)).over(work);
    assert_eq!(outcome.unwrap_err(), Error::Stopped, "{name}");
    assert!(started.elapsed() < Duration::from_secs(10), "{name} went on for {:?}", started.elapsed());
}

#[test]
fn long_runs_stop() {
    let long = scene().with_duration(1e6);
    let options = Options::with_step(1e-4).with_sample(1e3);
    stops("moreau-jean", || run(&long, &MOREAU_JEAN, &options));
    stops("event", || run(&long, &Scheme::Event, &options));
    // Nothing is touched: a single step of the exact scheme, which searches for a contact all the
    // way.
    let mut far = long.clone();
    far.walls.iter_mut().for_each(|wall| *wall = wall.clone().with_position(0.7e1 * wall.position()));
    far.initial.v[0] = 0.3;
    far.system = Scene::oscillator(1.0, 0.0, 100.0).system;
    stops("one arc", || run(&far.with_duration(1e5), &Scheme::Event, &options));
}

#[test]
fn studies_stop() {
    let long = scene().with_duration(1e4);
    let time = TimeOptions { sample: Some(10.0), ..TimeOptions::with_step(1e-5) };
    stops("compare", || compare(&long, &[MOREAU_JEAN.into()], &time, &|_| {}));
    stops("accuracy", || {
        accuracy::reach(&long, &Target { method: Some(MOREAU_JEAN.into()), ..Target::new(1e-9, time) }, &mut |_| {})
    });
    let question = MapRequest { scene: &long, laws: &[] };
    stops("stability", || {
        Plan::new(question, &Grid { most_steps: 1e9, contacts: 100_000, ..Grid::of(&long) })?.run(&|_| {})
    });
    let short = scene();
    let made = run(&short, &MOREAU_JEAN, &Options::with_step(1e-3)).unwrap();
    stops("verdict", || Verdict::of(&long, &MOREAU_JEAN.into(), &made, &time, &mut |_| {}));
}

#[test]
fn a_reduction_to_modes_stops() {
    let masses = vec![1.0; 100_000];
    let chain = Chain { springs: vec![1e4; masses.len() - 1], masses, grounds: [1e4, 0.0] };
    let scene = Scene::structure(chain.structure().unwrap());
    stops("modes", || scene.reduced(400, false));
}

#[test]
fn an_interrupt_counts_those_around_it_on_every_thread() {
    let quiet = || Interrupt::new(|| false);
    assert_eq!(quiet().depth(), 0);
    let depths = quiet().over(|| {
        let inner = quiet();
        let within = inner.over(|| Ok(quiet().depth()))?;
        let carried = Interrupt::current();
        let beside = std::thread::spawn(move || carried.map(|around| around.over(|| Ok(quiet().depth()))));
        Ok([inner.depth(), within, beside.join().unwrap().unwrap()?])
    });
    assert_eq!(depths.unwrap(), [1, 2, 1]);
    assert_eq!(quiet().depth(), 0);
}

#[test]
fn what_was_stopped_is_told_whatever_became_of_it() {
    // A study may take a failed part for an answer; the interrupt does not.
    let interrupt = Interrupt::new(|| true);
    let mut stepper = interrupt.over(|| Stepper::new(&scene(), &MOREAU_JEAN, 1e-3)).unwrap();
    let outcome = interrupt.over(|| {
        while stepper.step().is_ok() {}
        Ok("done")
    });
    assert_eq!(outcome, Err(Error::Stopped));
    assert!(!Error::Stopped.is_request());
    // It stays stopped, and touches nothing outside.
    assert_eq!(interrupt.over(|| run(&scene(), &MOREAU_JEAN, &Options::with_step(1e-3))).unwrap_err(), Error::Stopped);
    assert!(run(&scene(), &MOREAU_JEAN, &Options::with_step(1e-3)).is_ok());
}

#[test]
fn an_interrupt_that_never_says_yes_changes_nothing() {
    let asked = Arc::new(AtomicU64::new(0));
    let counter = Arc::clone(&asked);
    let interrupt = Interrupt::new(move || {
        counter.fetch_add(1, Ordering::Relaxed);
        false
    });
    let long = scene().with_duration(200.0);
    let options = Options::with_step(1e-4).with_sample(1e-1);
    let under = interrupt.over(|| run(&long, &MOREAU_JEAN, &options)).unwrap();
    let free = run(&long, &MOREAU_JEAN, &options).unwrap();
    assert_eq!((under.trajectory, under.residuals), (free.trajectory, free.residuals));
    // Every 50 ms, no oftener, however cheap the steps.
    let most = (under.seconds / 0.05).ceil() as u64 + 1;
    assert!(asked.load(Ordering::Relaxed) <= most, "asked {asked:?} times in {} s", under.seconds);
}

#[test]
fn a_sweep_stopped_on_its_way_goes_on_from_there() {
    let sweep = || {
        let case = CaseFile::embedded("rigid-walls-sine").unwrap();
        let axis = Axis::linear("load.1.harmonic.frequency", 4.0, 6.0, 100).unwrap();
        Sweep::new(case)
            .set("wall.*.restitution", 0.8)
            .unwrap()
            .set("time.end", 20.0)
            .unwrap()
            .vary(axis)
            .by("moreau-jean")
            .measure([Measure::Contacts])
    };
    let folder = tempfile::tempdir().unwrap();
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let options = SweepOptions { threads: Some(2), shard: Shard::WHOLE, force: false };
    let plan = sweep().plan().unwrap();
    plan.run_into(&whole, options, &|_| {}).unwrap();
    let stopped = after(Duration::from_millis(150)).over(|| plan.run_into(&parts, options, &|_| {}));
    assert_eq!(stopped.unwrap_err(), Error::Stopped);
    let again = plan.run_into(&parts, options, &|_| {}).unwrap();
    assert!(again.found < again.rows);
    let table = |folder: &std::path::Path| std::fs::read(folder.join("sweep.csv")).unwrap();
    assert_eq!(table(&whole), table(&parts));
}
