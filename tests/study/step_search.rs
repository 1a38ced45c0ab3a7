//! The step that keeps the error of means over realisations, where it is known beforehand.

use signorini::qp::Backend;
use signorini::study::accuracy::{CoarseGrid, JudgedBy};
use signorini::study::realisations::{
    Batch, FoundStep, Measure, RandomScenes, Realisation, RealisationPlan, RealisationStudy, Realisations, StepSearch,
    realisations,
};
use signorini::{
    Density, Error, Load, Method, Options, RandomForce, Result, Scene, Scheme, State, TimeOptions, Wall, run,
};
use std::f64::consts::TAU;

const METHOD: Method = Method { scheme: Scheme::MoreauJean { theta: 0.5 }, backend: Backend::Auto };

/// 1 kg pressed into a spring stop, and shaken below its resonance of 22 Hz without leaving the
/// stop: the scene is linear.
struct Pressed;

/// Of the body and of the stop, N/m.
const SPRINGS: [f64; 2] = [9108.0, 10_000.0];
const DAMPING: f64 = 13.8;
const PRESSING: f64 = 40.0;
const BAND: [f64; 2] = [1.0, 20.0];
const RMS: f64 = 3.0;
const END: f64 = 3.0;

impl RandomScenes for Pressed {
    fn realisation(&self, number: u64) -> Result<Scene> {
        let [own, stop] = SPRINGS;
        let random = Density::Flat { rms: RMS, from: BAND[0], to: BAND[1] };
        let random = RandomForce { density: random, seed: number, stream: 0 }.load(END)?;
        let wall = Wall::upper("stop", 0.0).with_elasticity(stop, 0.0);
        let scene = Scene::oscillator(1.0, DAMPING, own).with_wall(wall).with_load(Load::constant(PRESSING));
        let initial = State { q: vec![PRESSING / (own + stop)], v: vec![0.0] };
        Ok(Scene { initial, ..scene.with_load(random).with_duration(END) })
    }

    fn modes(&self) -> Option<[usize; 2]> {
        None
    }

    fn with_modes(&self, number: u64, _: usize) -> Result<Scene> {
        self.realisation(number)
    }
}

/// 1 kg that a random force throws against a rigid stop at this distance (m): motions of different
/// steps part.
struct Thrown(f64);

impl RandomScenes for Thrown {
    fn realisation(&self, number: u64) -> Result<Scene> {
        let force = RandomForce { density: Density::Flat { rms: 3.0, from: 1.0, to: 20.0 }, seed: number, stream: 0 };
        let stop = Wall::upper("stop", self.0).with_restitution(0.5);
        let scene = Scene::oscillator(1.0, 2.0, 400.0).with_wall(stop);
        Ok(scene.with_load(force.load(2.0)?).with_duration(2.0))
    }

    fn modes(&self) -> Option<[usize; 2]> {
        None
    }

    fn with_modes(&self, number: u64, _: usize) -> Result<Scene> {
        self.realisation(number)
    }
}

/// The root mean square force on the stop in the stationary motion with steps of `h`, N. The
/// trapezoidal rule answers a line of the angular frequency ω as the body answers one of
/// Ω = 2/h tan(ωh/2). Between steps the force is taken as straight, which leaves (2 + cos ωh)/3 of
/// the mean square of a line.
fn rms_force(h: f64) -> f64 {
    let [own, stop] = SPRINGS;
    let lines: Vec<f64> = (1..1000).map(|i| f64::from(i) / END).filter(|f| (BAND[0]..=BAND[1]).contains(f)).collect();
    let square = |f: &f64| {
        let omega = TAU * f;
        let answered = 2.0 / h * (0.5 * omega * h).tan();
        let kept = (2.0 + (omega * h).cos()) / 3.0;
        kept * RMS * RMS
            / lines.len() as f64
            / ((own + stop - answered * answered).powi(2) + (DAMPING * answered).powi(2))
    };
    let shaken = stop * stop * lines.iter().map(square).sum::<f64>();
    ((PRESSING * stop / (own + stop)).powi(2) + shaken).sqrt()
}

/// Twice what half of the step `h` changes of that force, as a share of it: the part of the step.
fn part(h: f64) -> f64 {
    2.0 * (rms_force(0.5 * h) / rms_force(h) - 1.0)
}

fn time(from: f64) -> TimeOptions {
    TimeOptions { statistics_from: from, ..TimeOptions::with_step(1e-3) }
}

fn search<'a>(scenes: &'a dyn RandomScenes, from: f64, share: f64, most: u64) -> StepSearch<'a> {
    StepSearch { scenes, method: &METHOD, time: time(from), share, most, most_steps: 1 << 16 }
}

/// The search and the study at its step; no realisation is run twice with one step.
fn found(search: &StepSearch<'_>) -> (FoundStep, RealisationStudy, Vec<String>) {
    let mut made: Vec<(u64, u64)> = Vec::new();
    let mut make = |batch: &Batch<'_>| -> Result<Vec<Realisation>> {
        for number in batch.numbers.clone() {
            let one = (number, batch.step().to_bits());
            assert!(!made.contains(&one), "realisation {number} was run before with this step");
            made.push(one);
        }
        batch.run(&mut |_| {})
    };
    let mut told = Vec::new();
    let mut found = search.find(&mut make, &mut |text| told.push(text.to_owned())).unwrap();
    let first = run(&search.scenes.realisation(1).unwrap(), search.method, &Options::new(found.time)).unwrap();
    let plan = RealisationPlan {
        scenes: search.scenes,
        run: &first,
        method: search.method,
        time: found.time,
        count: found.count,
        checked: found.pairs,
    };
    let mut known = std::mem::take(&mut found.known);
    let study = plan.follow(&mut |batch| known.complete(batch, &mut make), &mut |_| {}).unwrap();
    found.known = known;
    (found, study, told)
}

#[test]
fn the_step_found_is_the_coarsest_whose_error_by_the_answer_to_each_line_is_within_the_share() {
    let coarse = CoarseGrid::of(&Pressed.realisation(1).unwrap(), &time(1.0)).unwrap();
    let step = |level| coarse.options(level, &time(1.0)).step;
    // Halved, the step changes a quarter as much: in the middle between two parts each is a factor
    // of two away.
    let parts = [0, 1].map(|level| part(step(level)));
    assert!((3.5..4.5).contains(&(parts[0] / parts[1])) && parts[0].abs() > 1e-4, "{parts:?}");
    let share = (parts[0] * parts[1]).sqrt();
    let (found, study, told) = found(&search(&Pressed, 1.0, share, 6));
    assert!((found.time.step / step(1) - 1.0).abs() < 1e-12, "{told:?}");
    let rms = study.realisations.estimates.iter().find(|one| one.measure == Measure::ForceRms).unwrap();
    let of_step = rms.error.unwrap().step.unwrap();
    // The window is not the period of the force, so that its lines are not quite kept apart: 15 %.
    let measured = of_step.mean / rms.mean;
    assert!((measured / parts[1] - 1.0).abs() < 0.15, "{measured:e} instead of {:e}", parts[1]);
    let (accuracy, _) = found.judge(&study);
    assert_eq!(accuracy.judged_by, JudgedBy::Realisations);
    assert!(accuracy.reached <= share && accuracy.levels.len() == 2, "{accuracy:?}");
    // The exact motion of the same realisations is within the share, too.
    let options = Options::new(time(1.0));
    let scene = |number| Pressed.realisation(number);
    let exact = realisations(1..=6, &scene, &Scheme::Event.into(), &options, &mut |_| {}).unwrap();
    let exact = Realisations::new(exact);
    let other = exact.estimates.iter().find(|one| one.measure == Measure::ForceRms).unwrap();
    let wrong = (other.mean / rms.mean - 1.0).abs();
    assert!(wrong <= share && wrong > 0.2 * share, "{wrong:e} of {share:e}");
}

#[test]
fn the_first_step_is_taken_where_half_of_it_says_the_same() {
    let coarse = CoarseGrid::of(&Pressed.realisation(1).unwrap(), &time(1.0)).unwrap();
    let first = coarse.options(0, &time(1.0)).step;
    let (found, study, told) = found(&search(&Pressed, 1.0, 0.05, 200));
    assert_eq!((found.time.step, told.len()), (first, 3), "{told:?}");
    let (accuracy, shortfall) = found.judge(&study);
    assert_eq!(shortfall, None);
    // Both steps were tried, and the coarser is enough.
    assert!(accuracy.levels.len() == 2 && accuracy.sufficient_step_s == Some(first), "{accuracy:?}");
}

#[test]
fn what_cannot_be_told_from_chance_is_not_called_reached_and_the_same_again() {
    let narrow = search(&Thrown(2e-3), 0.2, 1e-3, 7);
    let (found_first, study, told) = found(&narrow);
    let (accuracy, shortfall) = found_first.judge(&study);
    let Some(Error::Biased { part: "step", tolerance, reached, why, .. }) = &shortfall else { panic!("{shortfall:?}") };
    assert!(*tolerance == 1e-3 && *reached > 1e-3 && *reached == accuracy.reached);
    assert!(why.contains("pairs of realisations would show it, and no more than 7"), "{why}");
    assert_eq!((study.realisations.count, accuracy.sufficient_step_s), (7, None));
    assert!(told.iter().all(|text| text.contains("at most") || text.starts_with("pilots")), "{told:?}");
    let again = found(&narrow);
    assert_eq!((accuracy, study, told), (again.0.judge(&again.1).0, again.1, again.2));
}

#[test]
fn a_step_that_is_the_last_allowed_falls_short_and_without_contact_nothing_is_judged() {
    let coarse = CoarseGrid::of(&Pressed.realisation(1).unwrap(), &time(1.0)).unwrap();
    let limited = StepSearch { most_steps: 2 * coarse.steps, ..search(&Pressed, 1.0, 1e-5, 6) };
    let (limited, study, _) = found(&limited);
    let shortfall = limited.judge(&study).1;
    let Some(Error::Biased { part: "step", seen: true, why, .. }) = &shortfall else { panic!("{shortfall:?}") };
    assert!(why.contains("half of that step would take more than"), "{why}");
    assert!(!shortfall.unwrap().is_request());
    let (untouched, study, _) = found(&search(&Thrown(1.0), 0.2, 0.05, 6));
    let shortfall = untouched.judge(&study).1.unwrap().to_string();
    assert!(shortfall.starts_with("an error of the step within 5 % is not known: no wall"), "{shortfall}");
}

#[test]
fn a_search_without_a_step_a_share_or_pilots_is_refused_by_name() {
    let plain = search(&Pressed, 1.0, 0.05, 6);
    let exact = Scheme::Event.into();
    for (search, words) in [
        (StepSearch { method: &exact, ..search(&Pressed, 1.0, 0.05, 6) }, "scheme is event; expected a scheme with"),
        (StepSearch { share: 1.0, ..search(&Pressed, 1.0, 0.05, 6) }, "accuracy is 1; expected a share"),
        (StepSearch { share: f64::NAN, ..search(&Pressed, 1.0, 0.05, 6) }, "accuracy is NaN; expected a share"),
        (StepSearch { most: 5, ..plain }, "most_seeds is 5; expected 6 or more"),
    ] {
        let error = search.find(&mut |batch| batch.run(&mut |_| {}), &mut |_| {}).unwrap_err();
        assert!(error.is_request() && error.to_string().starts_with(words), "{error}");
    }
}
