//! The errors of means over realisations, of a body whose errors of step and window are known.

use signorini::linear::Symmetric;
use signorini::study::realisations::{Check, ErrorParts, Measure, Realisation, Realisations, Refined, realisations};
use signorini::{Flat, Flats, Load, Options, PlaneRows, Result, Row, Scene, Scheme, Structure, WallLaw, run};

/// 1 kg with that damping (N s/m) and stiffness (N/m) in both planes, pressed on a flat by 10 N.
pub fn pressed_on_a_flat([damping, stiffness]: [f64; 2], friction: f64, duration: f64) -> Result<Scene> {
    let [mass, damping, stiffness] = [1.0, damping, stiffness].map(|x| Symmetric::diagonal(&[x, x]));
    let at = PlaneRows::doubled(&Row::dof(0), 1);
    let flats = Flats {
        name: "flat".to_owned(),
        at: at.clone(),
        flats: vec![Flat { direction: 90.0, gap: 0.0 }],
        centre: [0.0, 0.0],
        law: WallLaw::Rigid { restitution: 0.0 },
        friction: friction.into(),
    };
    let mut scene = Scene::structure(Structure { mass, damping, stiffness }).with_duration(duration);
    for wall in flats.walls()? {
        scene = scene.with_wall(wall);
    }
    scene.supports.push(flats.support(0));
    Ok(scene.with_load(Load { at: at.along(90.0), ..Load::constant(10.0) }))
}

/// The benchmark SDND104 of code_aster (V5.01.104): 1 kg pressed on a flat by 10 N with friction
/// 0.1, on a base shaken by 1 Hz.
fn rubbing(acceleration: f64, duration: f64) -> Result<Scene> {
    let at = PlaneRows::doubled(&Row::dof(0), 1).along(0.0);
    let shaken = Load { at, ..Load::harmonic(acceleration, 1.0, std::f64::consts::PI) };
    Ok(pressed_on_a_flat([0.0, 3e-5], 0.1, duration)?.with_load(shaken))
}

/// Four realisations whose accelerations differ from `least` by some `spread`, with steps of `step`
/// and a window from `from` to the end.
fn four(scheme: Scheme, (least, spread): (f64, f64), step: f64, [from, end]: [f64; 2]) -> Vec<Realisation> {
    let scene = |number: u64| rubbing(least + spread * (number - 1) as f64, end);
    let mut options = Options::with_step(step).with_sample(0.1);
    options.time.statistics_from = from;
    let members = realisations(1..=4, &scene, &scheme.into(), &options, &mut |_| {}).unwrap();
    assert!(members.iter().all(|member| member.findings.is_empty()));
    members
}

/// The mean work rate, and its error in parts where it is known.
fn work_rate(study: &Realisations) -> (f64, Option<ErrorParts>) {
    let rate = study.estimates.iter().find(|one| one.measure == Measure::WorkRate).unwrap();
    (rate.mean, rate.error)
}

#[test]
fn the_error_of_the_step_is_that_to_a_fine_one() {
    // At 1.01 m/s² the mass barely slides, so that a step of 0.01 s errs by 7 % of the work rate.
    let of = |scheme, step| four(scheme, (1.01, 1e-4), step, [1.0, 4.0]);
    let error = |scheme: Scheme, step: f64| {
        let refined = Refined::HalfStep { step_s: 0.5 * step, order: scheme.entry().order.unwrap() };
        let check = Check::new(refined, of(scheme, 0.5 * step));
        let (mean, error) = work_rate(&Realisations::new(of(scheme, step)).with_checks(vec![check]));
        (mean, error.unwrap().step.unwrap())
    };
    let (fine, _) = work_rate(&Realisations::new(of(Scheme::Located, 5e-4)));
    // Order 2: 4/3 of the change is the error, up to the next order.
    let (mean, step) = error(Scheme::Located, 4e-3);
    assert!(step.is_seen() && (step.mean / (fine - mean) - 1.0).abs() < 0.1, "{step:?}, {:e}", fine - mean);
    // Sliding alone is of order 2 by moreau-jean, too, whose impacts are of order 1: twice the
    // change is up to half as much again.
    let (mean, step) = error(Scheme::MoreauJean { theta: 0.5 }, 1e-2);
    let ratio = step.mean / (fine - mean);
    assert!(step.is_seen() && (0.95..1.7).contains(&ratio), "{step:?}, {:e}", fine - mean);
    assert!((0.02..0.2).contains(&((fine - mean) / fine).abs()), "{mean:e}, {fine:e}");
}

#[test]
fn a_window_that_begins_with_the_transient_is_seen() {
    // At 15 m/s² the base carries the mass along for some seconds: the work rate is 15.1 W in the
    // end, and more in the beginning.
    let error = |from: f64| {
        let scheme = Scheme::MoreauJean { theta: 0.5 };
        let study = Realisations::new(four(scheme, (15.0, 0.05), 2e-3, [from, 12.0])).with_checks(Vec::new());
        (work_rate(&study).0, work_rate(&study).1.unwrap())
    };
    let (last, _) = error(11.0);
    for from in [0.0, 4.0] {
        let (mean, error) = error(from);
        let wrong = last - mean;
        assert!(error.start.is_seen() && error.start.mean.signum() == wrong.signum(), "{error:?} {wrong}");
        assert!(error.start.at_most() > wrong.abs() && error.total > wrong.abs(), "{error:?} {wrong}");
    }
    assert!((error(0.0).1.start.mean / error(4.0).1.start.mean) > 4.0);
}

#[test]
fn the_interval_of_a_window_that_begins_with_the_transient_holds_the_steady_rate() {
    // Ten batches of 0.8 s would cut the periods of 1 s: 1.03 W.
    let (mean, half) = {
        let mut options = Options::with_step(2e-3).with_sample(0.1);
        options.time.statistics_from = 4.0;
        let scheme = Scheme::MoreauJean { theta: 0.5 };
        let run = run(&rubbing(15.0, 12.0).unwrap(), &scheme, &options).unwrap();
        let wear = &run.statistics.wear[0];
        (wear.work_rate_w, wear.work_rate_half_width_95_w.unwrap())
    };
    // The mass settles slowly: the work rate of the last period is 15.126 W.
    assert!((mean - 15.126).abs() < half && half < 0.2, "{mean} {half}");
}
