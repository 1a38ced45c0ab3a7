//! Bodies that slide round a hole and never leave it: each has one contact, in every step of which
//! the hole pushes with the force that holds the body on the circle.

use crate::draws::cases;
use crate::random_structures::Draws;
use crate::rubbing::{MOREAU_JEAN, body, follow, hole, isotropic, load, with};
use signorini::residual::Judge;
use signorini::{Load, Options, Row, Scene, Scheme, Stepper, run};
use std::f64::consts::TAU;

const GAP: f64 = 1e-3;

/// A mass of 1 kg on a spring round the centre, pressed against a hole, on which it starts.
struct Slide {
    stiffness: f64,
    force: [f64; 2],
    friction: f64,
    scene: Scene,
}

impl Slide {
    fn new(stiffness: f64, [at, turn]: [f64; 2], speed: f64, [restitution, friction]: [f64; 2]) -> Self {
        let (c, s) = (at.cos(), at.sin());
        let force = [(at + turn).cos(), (at + turn).sin()].map(|part| (10.0 + stiffness * GAP) * part);
        let free = with(isotropic(1.0, 0.0, stiffness), hole("hole", body(), GAP, restitution, friction));
        let scene = force
            .into_iter()
            .enumerate()
            .fold(free, |scene, (axis, force)| scene.with_load(load(Load::constant(force), Row::dof(axis))));
        let scene = scene.with_initial(&[GAP * c, GAP * s], &[-speed * s, speed * c]).with_duration(0.1);
        Self { stiffness, force, friction, scene }
    }

    /// A random one; the force presses at first up to 60° beside the place.
    fn draw(draws: &mut Draws) -> Self {
        let stiffness = if draws.chance(0.5) { draws.between(1.0, 500.0) } else { 0.0 };
        let angles = [draws.between(0.0, TAU), draws.between(-TAU / 6.0, TAU / 6.0)];
        let speed = if draws.chance(0.5) { draws.between(-0.1, 0.1) } else { 0.0 };
        Self::new(stiffness, angles, speed, [[0.0, 0.5][draws.below(2)], [0.0, 0.0, 0.2][draws.below(3)]])
    }

    /// What holds the body on the circle in the direction `n` at the speed `v` along it, N.
    fn held(&self, [y, z]: [f64; 2], v: f64) -> f64 {
        v * v / GAP + self.force[0] * y + self.force[1] * z - self.stiffness * GAP
    }

    /// The impulse of the hole by `located`, N s; `None` where it does not push throughout.
    fn located(&self) -> Option<f64> {
        let mut stepper = Stepper::new(&self.scene, &Scheme::Located, 1e-4).expect("a scene");
        let (mut sum, mut pushes) = (0.0, true);
        for _ in 0..1000 {
            loop {
                let step = stepper.step().expect("a step");
                pushes &= step.impulse[0] > 0.0;
                sum += step.impulse[0];
                if step.end >= 1e-4 * (step.index + 1) as f64 - 1e-12 {
                    break;
                }
            }
        }
        pushes.then_some(sum)
    }
}

/// Largest difference of a force from what holds the body, as a share of the mean force, and of the
/// impulse from this one.
fn missed(slide: &Slide, h: f64, whole: f64) -> [f64; 2] {
    let steps = (0.1 / h).round() as u64;
    let contract = MOREAU_JEAN.contract();
    let initial = &slide.scene.initial;
    let mut judge = Judge::new(&slide.scene, contract, h, &initial.q, &initial.v);
    let (mut sum, mut worst, mut from) = (0.0, 0.0_f64, [initial.q[0], initial.q[1]]);
    follow(&slide.scene, h, steps, |step| {
        judge.observe(step);
        let p = step.impulse[0];
        assert!(p > 0.0, "h = {h}: no push at {} s", step.start);
        let way = [step.q[0] - from[0], step.q[1] - from[1]];
        let [y, z] = [from[0] + step.q[0], from[1] + step.q[1]];
        let n = [y / y.hypot(z), z / y.hypot(z)];
        worst = worst.max((p / h - slide.held(n, way[0].hypot(way[1]) / h)).abs());
        (sum, from) = (sum + p, [step.q[0], step.q[1]]);
        let depth = from[0].hypot(from[1]) / GAP - 1.0;
        assert!(depth.abs() < 0.2 * (h / 1e-3).powi(2), "h = {h}: {depth:e} of the gap at {} s", step.end);
    });
    assert_eq!(judge.findings(), [], "h = {h}");
    [worst / (whole / 0.1), (sum / whole - 1.0).abs()]
}

#[test]
fn a_body_that_slows_down_keeps_its_contact_with_the_force_that_holds_it_on_the_circle() {
    let mut draws = Draws::new(41);
    // The swing of a pendulum without friction, from its lowest place.
    let pendulum = Slide::new(0.0, [0.0, 0.0], 0.05, [0.0, 0.0]);
    let (mut slides, mut rubbing) = (0, 0);
    let (mut coarse, mut fine) = ([0.0_f64; 2], [0.0_f64; 2]);
    for slide in std::iter::once(pendulum).chain((1..cases(24)).map(|_| Slide::draw(&mut draws))) {
        let Some(whole) = slide.located() else { continue };
        (slides, rubbing) = (slides + 1, rubbing + u32::from(slide.friction > 0.0));
        for (most, h) in [(&mut coarse, 1e-3), (&mut fine, 1e-4)] {
            let found = missed(&slide, h, whole);
            *most = [most[0].max(found[0]), most[1].max(found[1])];
            let run = run(&slide.scene, &MOREAU_JEAN, &Options::with_step(h)).expect("a run");
            assert_eq!(run.trajectory.contacts().len(), 1, "{:?}", run.trajectory.contacts());
        }
    }
    assert!(slides > 15 && rubbing > 2, "{slides} {rubbing}");
    assert!(coarse[0] < 0.08 && fine[0] < 0.008, "{coarse:?} {fine:?}");
    assert!(coarse[1] < 5e-3 && fine[1] < 3e-4, "{coarse:?} {fine:?}");
}
