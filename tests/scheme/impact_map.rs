//! One free impact: the restitution that a scheme realises, as a function of the fraction τ of the
//! step elapsed at contact.

use signorini::{Contact, Integrator, PenaltyLaw, Scene, Scheme, Stepper, Wall};

/// Step, s; the wall is 7 + τ steps ahead of a body of 1 kg at 1 m/s.
const H: f64 = 1.0 / 1024.0;
const AHEAD: f64 = 7.0;

fn scene(tau: f64, e: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(Wall::upper("wall", (AHEAD + tau) * H).with_restitution(e))
        .with_initial(&[0.0], &[1.0])
}

/// Phases spread over [0, 1), none of them a fraction that a binary step hits.
fn phases(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| (f64::from(i) + 0.37) / f64::from(count))
}

/// Rebound speed over approach speed, after the last contact with the wall; and the reported
/// contact.
fn restitution(scene: &Scene, scheme: &Scheme, steps: u32) -> (f64, Vec<Contact>) {
    let mut stepper = Stepper::new(scene, scheme, H).expect("a sound scene");
    let mut contacts = Vec::new();
    for _ in 0..steps {
        let step = stepper.step().expect("a step");
        contacts.extend_from_slice(step.closed);
    }
    assert!(stepper.open_contacts().is_empty(), "{scheme}: still in contact");
    (-stepper.state().v[0], contacts)
}

/// Found: rounding of positions of 1e-2 m over steps of 1e-3 s, some 1e-14.
const CLOSE: f64 = 1e-9;

#[test]
fn paoli_schatzman_and_moreau_jean_return_e_at_every_phase() {
    let moreau = |theta| Scheme::MoreauJean { theta };
    for scheme in [Scheme::PaoliSchatzman, moreau(0.5), moreau(0.75), moreau(1.0)] {
        for e in [0.0, 0.25, 0.8, 1.0] {
            for tau in phases(101).chain([0.0]) {
                let (found, contacts) = restitution(&scene(tau, e), &scheme, 40);
                assert!((found - e).abs() < CLOSE, "{scheme}, e = {e}, τ = {tau}: {found}");
                // Impulse m(1 + e)v, speeds 1 and e, within one step of (7 + τ) h; an instant.
                let [contact] = contacts[..] else { panic!("{scheme}, e = {e}, τ = {tau}: {contacts:?}") };
                let true_time = (AHEAD + tau) * H;
                assert!((contact.impulse + 1.0 + e).abs() < CLOSE, "{scheme}, {tau}: {contact:?}");
                assert!((contact.approach_speed - 1.0).abs() < CLOSE, "{scheme}, {tau}: {contact:?}");
                assert!((contact.departure_speed.expect("closed") - e).abs() < CLOSE, "{scheme}, {tau}: {contact:?}");
                assert!((contact.start - true_time).abs() <= 1.000_001 * H, "{scheme}, {tau}: {contact:?}");
                assert_eq!((contact.end, contact.peak_force), (Some(contact.start), None), "{scheme}, e = {e}, {tau}");
            }
        }
    }
}

#[test]
fn implicit_euler_returns_nothing_at_every_phase() {
    for e in [0.0, 1.0] {
        for tau in phases(101).chain([0.0]) {
            let (found, contacts) = restitution(&scene(tau, e), &Scheme::ImplicitEuler, 40);
            assert!(found.abs() < CLOSE, "τ = {tau}: {found}");
            let [contact] = contacts[..] else { panic!("τ = {tau}: {contacts:?}") };
            assert!((contact.impulse + 1.0).abs() < CLOSE, "{tau}: {contact:?}");
        }
    }
}

#[test]
fn newmark_returns_a_restitution_by_chance_of_the_phase() {
    let mut squares = 0.0;
    let mut count = 0.0;
    for tau in phases(300) {
        let (found, contacts) = restitution(&scene(tau, 1.0), &Scheme::Newmark, 40);
        let expected = if tau < 2.0 / 3.0 { 3.0 - 4.0 * tau } else { 8.0 * tau - 5.0 };
        assert!((found - expected).abs() < CLOSE, "τ = {tau}: {found}, expected {expected}");
        let [contact] = contacts[..] else { panic!("τ = {tau}: {contacts:?}") };
        assert!((contact.departure_speed.expect("closed") - expected).abs() < CLOSE, "{tau}: {contact:?}");
        assert!((contact.impulse + 1.0 + expected).abs() < CLOSE, "{tau}: {contact:?}");
        squares += found * found;
        count += 1.0;
    }
    // ∫ e² dτ = 91/27 = 3.370; 300 phases leave 1e-3 of it.
    assert!((squares / count - 91.0 / 27.0).abs() < 4e-3, "{}", squares / count);
}

/// The exact recursions of a free particle of unit mass and a linear spring κ = h²k/m, in units of
/// the step: positions behind the wall x (negative before it), velocities in positions per step.
fn recursion(integrator: Integrator, kappa: f64, tau: f64) -> f64 {
    let mut x = -(AHEAD + tau);
    let mut v: f64 = 1.0;
    let inside = |x: f64| x.max(0.0);
    if integrator == Integrator::CentralDifference {
        // x⁺ = 2x − x⁻ − κ x₊
        let mut last = x - v;
        for _ in 0..STEPS {
            (x, last) = (2.0 * x - last - kappa * inside(x), x);
        }
        return last - x;
    }
    for _ in 0..STEPS {
        let free = x + v;
        match integrator {
            Integrator::ImplicitEuler => {
                // x⁺ = x + v⁺, v⁺ = v − κ x⁺₊
                let end = if free > 0.0 { free / (1.0 + kappa) } else { free };
                (x, v) = (end, end - x);
            }
            Integrator::Trapezoidal => {
                // x⁺ = x + (v + v⁺)/2, v⁺ = v − κ(x₊ + x⁺₊)/2
                let half = free - 0.25 * kappa * inside(x);
                let end = if half > 0.0 { half / (1.0 + 0.25 * kappa) } else { half };
                (x, v) = (end, 2.0 * (end - x) - v);
            }
            _ => {
                // x⁺ = x + (v + v⁺)/2, v⁺ = v − κ(x⁺₊² − x₊²)/(2(x⁺ − x)): the same with d = x⁺ −
                // x, by bisection between the rebound and the free step, d/½ − 2v + κ(x⁺₊² −
                // x₊²)/2d = 0 growing with d.
                let force = |d: f64| {
                    let (a, b) = (inside(x), inside(x + d));
                    // The secant slope of ½s₊² without dividing by d where both ends are inside.
                    if x >= 0.0 && x + d >= 0.0 { 0.5 * (a + b) } else { 0.5 * (b * b - a * a) / d }
                };
                if free <= 0.0 && x <= 0.0 {
                    x = free;
                    continue;
                }
                let (mut lo, mut hi) = (-1e3 * (1.0 + x.abs() + v.abs()), 1e3 * (1.0 + x.abs() + v.abs()));
                for _ in 0..200 {
                    let d = 0.5 * (lo + hi);
                    if 2.0 * d - 2.0 * v + kappa * force(d) > 0.0 { hi = d } else { lo = d }
                }
                let d = 0.5 * (lo + hi);
                (x, v) = (x + d, 2.0 * d - v);
            }
        }
    }
    -v
}

const STEPS: u32 = 120;

fn spring(kappa: f64, integrator: Integrator) -> Scheme {
    Scheme::Penalty { law: PenaltyLaw::Linear { stiffness: kappa / (H * H), damping: 0.0 }, integrator }
}

fn range(kappa: f64, integrator: Integrator, count: u32) -> (f64, f64) {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for tau in phases(count) {
        let (found, _) = restitution(&scene(tau, 1.0), &spring(kappa, integrator), STEPS);
        let exact = recursion(integrator, kappa, tau);
        assert!(
            (found - exact).abs() < CLOSE * exact.abs().max(1.0),
            "{integrator}, κ = {kappa}, τ = {tau}: {found}, {exact}"
        );
        (least, most) = (least.min(found), most.max(found));
    }
    println!("{integrator} {kappa}: {least:.6e} {most:.6e}");
    (least, most)
}

#[test]
fn a_penalty_spring_returns_what_an_exact_recursion_of_each_integrator_does() {
    for kappa in [0.01, 0.3, 1.0, 3.0, 10.0, 1e4] {
        for integrator in Integrator::ALL {
            let (least, most) = range(kappa, integrator, 400);
            if integrator == Integrator::DiscreteGradient {
                // It keeps the energy: e = 1 at every phase.
                assert!((least - 1.0).abs() < CLOSE && (most - 1.0).abs() < CLOSE, "κ = {kappa}: {least} … {most}");
            }
        }
    }
}

#[test]
fn the_ranges_of_restitution_are_those_of_the_reference() {
    // Printed to the last digit given; 400 phases come within one unit of it.
    let check = |kappa: f64, integrator, least: f64, most: f64, unit: f64| {
        let found = range(kappa, integrator, 400);
        assert!((found.0 - least).abs() < unit && (found.1 - most).abs() < unit, "{integrator} κ = {kappa}: {found:?}");
    };
    check(1.0, Integrator::ImplicitEuler, 0.25, 0.25, 1e-9);
    check(0.01, Integrator::ImplicitEuler, 0.8538, 0.8559, 1e-4);
    check(1e4, Integrator::ImplicitEuler, 3.3e-5, 1.0e-4, 0.1e-5);
    check(1.0, Integrator::CentralDifference, 1.0, 1.0, 1e-9);
    check(0.01, Integrator::CentralDifference, 0.9988, 1.0012, 1e-4);
    check(1e4, Integrator::Trapezoidal, 0.3336, 2.9984, 1e-2);
    check(1.0, Integrator::Trapezoidal, 0.8993, 1.1120, 1e-3);
    check(0.01, Integrator::Trapezoidal, 0.9988, 1.0012, 1e-4);
    // The explicit rule: e up to 2 at κ = 3, though the linear limit is 4, and up to κ − 1 beyond.
    let (_, most) = range(3.0, Integrator::CentralDifference, 400);
    assert!((most - 2.0).abs() < 2e-2, "{most}");
    let (_, most) = range(1e4, Integrator::CentralDifference, 400);
    assert!((most / 9999.0 - 1.0).abs() < 1e-2, "{most}");
}
