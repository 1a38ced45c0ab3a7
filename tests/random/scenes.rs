//! Each random scene is run by each scheme that takes it: no run is refuted, none panics, and every
//! number of a run without findings is finite.
//!
//! `SIGNORINI_CASES` sets how many scenes, `SIGNORINI_SEED` the first, and `SIGNORINI_UNITS=wild`
//! the units: case number k is the scene of seed `SIGNORINI_SEED` + k, so that a failure is run
//! again by its seed and one case.

use crate::draws;
use crate::random_scenes::{Drawn, Units, random_scene};
use signorini::{Integrator, Options, Refuted, Run, Scene, Scheme, WallLaw, run};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What became of a run.
enum Outcome {
    /// It kept its contract, and all of its numbers are finite.
    Kept,
    /// The scheme refuses the scene.
    Refused,
    /// It failed with a reason that a scheme may have on a sound scene.
    Failed(String),
    /// It is a defect.
    Defect(String),
}

/// True for the schemes that create energy at walls where the step is too large for them, at rigid
/// ones or at elastic ones: they may diverge.
fn gains_energy(scene: &Scene, scheme: &Scheme, step: f64) -> bool {
    use Integrator::{CentralDifference, Trapezoidal};
    let laws = scene.walls.iter().map(|wall| wall.law).chain(scene.holes().map(|hole| hole.law));
    // The limit below which a run says nothing of walls that its step does not resolve.
    let unresolved = |(law, mass): (WallLaw, f64)| step * step * law.tangent(f64::MIN_POSITIVE) / mass >= 0.1;
    laws.zip(scene.wall_masses()).any(unresolved)
        || matches!(scheme, Scheme::Newmark | Scheme::Penalty { integrator: CentralDifference | Trapezoidal, .. })
}

/// Scenes of a kind in which a scheme is known to fail now and then: penalties of several degrees
/// of freedom on stiff springs, whose step is made with the forces of the law at the displacement
/// found rather than with those by which it was found, so that rounding may move a body across a
/// face.
fn is_known(scene: &Scene, scheme: &Scheme) -> bool {
    matches!(scheme, Scheme::Penalty { .. }) && scene.initial.q.len() > 1
}

fn outcome(scene: &Scene, scheme: &Scheme, step: f64) -> Outcome {
    let made = catch_unwind(AssertUnwindSafe(|| run(scene, scheme, &Options::with_step(step))));
    match made {
        Err(panic) => {
            let said = panic.downcast_ref::<String>().cloned();
            let said = said.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            Outcome::Defect(format!("panicked: {}", said.unwrap_or_default()))
        }
        Ok(Err(error)) if error.is_request() => Outcome::Refused,
        Ok(Err(error)) => Outcome::Failed(error.to_string()),
        Ok(Ok(run)) => match (run.findings.first(), not_finite(&run)) {
            (Some(found), _) if found.refuted == Refuted::Diverged && gains_energy(scene, scheme, step) => {
                Outcome::Failed(format!("diverged, {}", found.reason))
            }
            (Some(found), _) => Outcome::Defect(format!("refuted: {found}")),
            (None, Some(part)) => Outcome::Defect(format!("not finite: {part}")),
            (None, None) => Outcome::Kept,
        },
    }
}

/// A part of the results that holds a number that is not finite.
fn not_finite(run: &Run) -> Option<String> {
    let parts = [
        ("residuals", format!("{:?}", run.residuals)),
        ("statistics", format!("{:?}", run.statistics)),
        ("state", format!("{:?}", run.state)),
        ("contacts", format!("{:?}", run.trajectory.contacts())),
    ];
    let strange = |text: &str| text.split(|c: char| !c.is_alphanumeric()).any(|word| word == "NaN" || word == "inf");
    parts.into_iter().find(|(_, text)| strange(text)).map(|(name, text)| format!("{name}: {text}"))
}

/// How often each thing happened, by scheme and by the first words of its description.
type Counts = BTreeMap<(String, String), (usize, u64)>;

/// The kind of a scene, in words.
fn kind(scene: &Scene) -> String {
    let n = scene.initial.q.len();
    let holes = scene.holes().count();
    let elastic = scene.holes().filter(|hole| !hole.law.is_rigid()).count();
    let friction = if scene.supports.iter().any(|support| support.friction > 0.0) { ", friction" } else { "" };
    let flats = scene.walls.len();
    match (n, scene.supports.is_empty()) {
        (1, _) => format!("one degree of freedom, {flats} walls"),
        (_, true) => format!("several degrees of freedom, {flats} walls"),
        _ => format!("two planes, {holes} holes, {elastic} of them elastic, {flats} flats{friction}"),
    }
}

fn count(counts: &mut Counts, scheme: &Scheme, what: &str, seed: u64) {
    let name = scheme.to_string();
    let letters = |text: &str| text.chars().filter(|c| !c.is_ascii_digit()).collect::<String>();
    let name = match scheme {
        Scheme::Penalty { integrator, .. } => format!("penalty by {}", integrator.name()),
        _ => name.split(':').next().unwrap_or_default().to_owned(),
    };
    let words = letters(&what.chars().take(70).collect::<String>());
    counts.entry((name, words)).or_insert((0, seed)).0 += 1;
}

#[test]
fn every_scheme_keeps_its_contract_on_random_scenes() {
    let units = match std::env::var("SIGNORINI_UNITS").as_deref() {
        Ok("wild") => Units::Wild,
        _ => Units::Ordinary,
    };
    let (first, cases) = (draws::seed(1), draws::cases(1000_u64));
    // Scenes that were refuted once: a blow that moves stiff springs within a step, and a body that
    // travels far along its wall.
    let once = [101_985, 100_994];
    let before = if units == Units::Ordinary && cases >= 1000 { &once[..] } else { &[] };
    let (mut made, mut met, mut defects, mut known) = (0_u64, 0_u64, 0_u64, 0_u64);
    let (mut failed, mut wrong) = (Counts::new(), Counts::new());
    for seed in (first..first + cases).chain(before.iter().copied()) {
        let Drawn { scene, step, schemes } = random_scene(seed, units);
        for scheme in &schemes {
            match outcome(&scene, scheme, step) {
                Outcome::Kept => made += 1,
                Outcome::Refused => {}
                Outcome::Failed(text) => count(&mut failed, scheme, &text, seed),
                Outcome::Defect(text) => {
                    made += 1;
                    if is_known(&scene, scheme) {
                        known += 1;
                        continue;
                    }
                    defects += 1;
                    let shown: String = text.chars().take(300).collect();
                    println!("seed {seed} ({}), {scheme}, step {step:e}: {shown}", kind(&scene));
                    if cases == 1 {
                        println!("{scene:?}");
                    }
                    count(&mut wrong, scheme, &text, seed);
                }
            }
        }
        met += u64::from(!scene.walls.is_empty() || !scene.supports.is_empty());
    }
    for (name, counts) in [("failed", &failed), ("wrong", &wrong)] {
        for ((scheme, what), (times, seed)) in counts {
            println!("{name}: {times} x {scheme}: {what} (first: seed {seed})");
        }
    }
    println!("{made} runs of {cases} scenes, {met} with walls, {defects} defects beside {known} known ones");
    assert_eq!(defects, 0);
}
