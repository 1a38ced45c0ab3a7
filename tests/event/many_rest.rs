//! Structures that start on their walls: at rest, pressed, pulled, directly or through many others,
//! of any mass and stiffness.
//!
//! Each is judged by the judge's residuals, and some by closed forms.

use crate::draws;
use crate::random_structures::{Draws, at, on, scene};
use signorini::linear::Symmetric;
use signorini::residual::{Judge, Residuals};
use signorini::{Contact, Load, Options, Row, Scene, Scheme, Stepper, Wall, run};

/// Two free masses of `m` (kg) joined by a spring of `k` (N/m). Mass 1 touches an upper wall, mass
/// 0 is pushed towards it with 1 N.
fn pair(m: f64, k: f64, e: f64) -> Scene {
    let stiffness = Symmetric::from_entries(2, [(0, 0, k), (1, 1, k), (1, 0, -k)]);
    scene(Symmetric::diagonal(&[m, m]), Symmetric::zeros(2), stiffness)
        .with_wall(at(Wall::upper("wall", 0.0).with_restitution(e), Row::dof(1)))
        .with_load(on(Load::constant(1.0), 0))
}

#[test]
fn what_is_pressed_onto_a_wall_through_another_mass_stays_there() {
    // While mass 1 stands, mass 0 swings about 1/k: r = −k x₀ = −(1 − cos ωt), ω² = k/m. It never
    // pulls, and falls to 0 once a period.
    for (m, k, end) in [(1e3, 1.0, 500.0), (1.0, 1.0, 20.0), (1e-6, 1e12, 2e-8), (1e6, 1e-6, 5e6)] {
        for e in [0.0, 0.5, 1.0] {
            let scene = pair(m, k, e).with_duration(end);
            let mut options = Options::with_step(end / 100.0);
            // Statistics of 5e6 s in stretches of 1 ms would take minutes.
            options.time.force_averaging = end / 1e3;
            let run = run(&scene, &Scheme::Event, &options).unwrap();
            let what = format!("m = {m}, k = {k}, e = {e}: {:?}", run.residuals);
            // Of the amplitude, with the rounding of some hundred stretches.
            assert!(run.residuals.penetration_m <= 1e-13 / k, "{what}");
            assert!(run.residuals.energy.residual <= 1e-12, "{what}");
            assert!(run.residuals.complementarity <= 1e-13 * (1.0 / k).max(1.0), "{what}");
            let omega = (k / m).sqrt();
            // The mean of −(1 − cos ωt) over each row.
            let rows = run.trajectory.time().windows(2);
            for (t, r) in rows.zip(run.trajectory.contact_force("wall").unwrap().iter().skip(1)) {
                let exact = ((omega * t[1]).sin() - (omega * t[0]).sin()) / (omega * (t[1] - t[0])) - 1.0;
                assert!((r - exact).abs() <= 1e-11, "{t:?} s: {r} N for {exact}, {what}");
            }
        }
    }
}

#[test]
fn a_push_through_twenty_masses_arrives_at_the_wall() {
    // At the start the first forty derivatives of the last mass vanish: no series shows which way
    // it will go.
    let n = 20;
    let entries = (0..n).map(|i| (i, i, if i == 0 || i == n - 1 { 1.0 } else { 2.0 }));
    let stiffness = Symmetric::from_entries(n, entries.chain((1..n).map(|i| (i, i - 1, -1.0))));
    let free = scene(Symmetric::diagonal(&vec![1.0; n]), Symmetric::zeros(n), stiffness)
        .with_load(on(Load::constant(1.0), 0))
        .with_duration(60.0);
    for (e, sign) in [(0.0, 1.0), (1.0, 1.0), (0.0, -1.0), (1.0, -1.0)] {
        let wall = if sign > 0.0 { Wall::upper("wall", 0.0) } else { Wall::lower("wall", 0.0) };
        let scene = free.clone().with_wall(at(wall.with_restitution(e), Row::dof(n - 1)));
        let run = run(&scene, &Scheme::Event, &Options::with_step(0.1)).unwrap();
        let what = format!("e = {e}, {sign}: {:?}", run.residuals);
        assert!(run.residuals.penetration_m <= 1e-13, "{what}");
        assert!(run.residuals.energy.residual <= 1e-12, "{what}");
        let pushed = run.trajectory.impulse("wall").unwrap();
        // The wave front arrives after about 19 s at 1 m/s; then the wall carries the push, and
        // twice the push while the wave is reflected.
        if sign > 0.0 {
            assert!(-pushed > 30.0 && -pushed < 80.0, "{pushed} N s, {what}");
        } else {
            assert!(pushed == 0.0 && run.trajectory.contacts().is_empty(), "{pushed} N s, {what}");
        }
    }
}

#[test]
fn a_body_that_touches_without_force_is_not_in_contact() {
    // Mass 1 rests on the wall with no force on it until a blow at 0.5 s drives mass 0 towards it.
    let mut scene = pair(1.0, 100.0, 0.0).with_duration(2.0);
    scene.loads = vec![on(Load::impulse(1.0, 0.5), 0)];
    let run = run(&scene, &Scheme::Event, &Options::with_step(0.01)).unwrap();
    let contacts: &[Contact] = run.trajectory.contacts();
    assert_eq!(contacts.len(), 1, "{contacts:?}");
    // Half a period of mass 0 on the spring: ω = 10, and its force is 0 before and after.
    let (start, end) = (contacts[0].start, contacts[0].end.unwrap());
    assert!((start - 0.5).abs() < 1e-12 && (end - start - 0.1 * std::f64::consts::PI).abs() < 1e-9, "{contacts:?}");
    assert!((contacts[0].impulse + 2.0).abs() < 1e-12, "{contacts:?}");
}

/// A structure on its walls: any scale, any push.
fn random(draws: &mut Draws) -> Scene {
    let n = 1 + draws.below(8);
    let power = |draws: &mut Draws, from: f64, to: f64| 10_f64.powf(draws.between(from, to));
    // Masses and springs of one size, of neighbouring ones, or of any.
    let spread = [0.0, 1.0, 12.0][draws.below(3)];
    let (heavy, stiff) = (draws.between(-6.0, 6.0), draws.between(-6.0, 12.0));
    let within = |draws: &mut Draws, middle: f64, least: f64, most: f64| {
        let half = 0.5 * spread;
        10_f64.powf(draws.between((middle - half).max(least), (middle + half).min(most)))
    };
    let masses: Vec<f64> = (0..n).map(|_| within(draws, heavy, -6.0, 6.0)).collect();
    let mut stiffness = Vec::new();
    for i in 1..n {
        let k = within(draws, stiff, -6.0, 12.0);
        stiffness.extend([(i, i, k), (i - 1, i - 1, k), (i, i - 1, -k)]);
    }
    for end in [0, n - 1] {
        if draws.chance(0.4) {
            stiffness.push((end, end, within(draws, stiff, -6.0, 12.0)));
        }
    }
    let mut mass: Vec<(usize, usize, f64)> = masses.iter().enumerate().map(|(i, &m)| (i, i, m)).collect();
    if draws.chance(0.3) {
        // As of finite elements.
        mass.extend((1..n).map(|i| (i, i - 1, 0.3 * masses[i].min(masses[i - 1]))));
    }
    let (mass, stiffness) = (Symmetric::from_entries(n, mass), Symmetric::from_entries(n, stiffness));
    let fastest = (0..n).map(|i| (stiffness.get(i, i) / masses[i]).sqrt()).fold(0.0, f64::max);
    let rate = if fastest > 0.0 { fastest } else { power(draws, -3.0, 3.0) };
    let damping = match draws.below(3) {
        0 => Symmetric::sum(&[(power(draws, -4.0, 0.0) / rate, &stiffness)]),
        1 => Symmetric::sum(&[(power(draws, -4.0, -1.0) * rate, &mass)]),
        _ => Symmetric::zeros(n),
    };
    let length = power(draws, -6.0, 0.0);
    let place = |draws: &mut Draws| if draws.chance(0.5) { 0.0 } else { draws.between(-1.0, 1.0) * length };
    let q: Vec<f64> = if draws.chance(0.6) { vec![0.0; n] } else { (0..n).map(|_| place(draws)).collect() };
    let v: Vec<f64> =
        (0..n)
            .map(|_| {
                if draws.chance(0.8) {
                    0.0
                } else {
                    draws.between(-1.0, 1.0) * length * rate * power(draws, -12.0, 0.0)
                }
            })
            .collect();
    let end = draws.between(2.0, 60.0) / rate;
    let mut scene = scene(mass, damping, stiffness).with_initial(&q, &v).with_duration(end);
    for index in 0..1 + draws.below(n + 1) {
        let dof = draws.below(n);
        let row =
            if n > 1 && draws.chance(0.2) { Row::new(vec![(dof, 1.0), ((dof + 1) % n, -1.0)]) } else { Row::dof(dof) };
        let gap = if draws.chance(0.7) { 0.0 } else { length * power(draws, -14.0, 0.0) };
        let (w, name) = (row.dot(&q), format!("w{index}"));
        let wall = if draws.chance(0.5) { Wall::upper(&name, w + gap) } else { Wall::lower(&name, w - gap) };
        let e = [0.0, 1.0, 0.5][draws.below(3)];
        scene = scene.with_wall(at(wall.with_restitution(e), row));
    }
    for _ in 0..draws.below(3) {
        // A push that moves its mass by about the length in a radian of the fastest motion, or by
        // far less.
        let dof = draws.below(n);
        let force = draws.between(-1.0, 1.0) * masses[dof] * rate * rate * length * power(draws, -6.0, 0.0);
        let load = match draws.below(4) {
            0 => Load::harmonic(force, draws.between(0.02, 0.3) * rate, draws.between(0.0, 3.0)),
            1 => Load::impulse(force / rate, draws.between(0.0, 1.0) * end),
            _ => Load::constant(force),
        };
        scene = scene.with_load(on(load, dof));
    }
    scene
}

/// Sizes and residuals of a run.
struct Judged {
    residuals: Residuals,
    /// The largest |q|, m.
    reach: f64,
    steps: u64,
    /// Stretches handed over.
    handed: usize,
}

fn judged(scene: &Scene) -> Result<Judged, signorini::Error> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, scene.duration)?;
    let start = stepper.state();
    let mut judge = Judge::new(stepper.scene(), stepper.contract(), scene.duration, &start.q, &start.v);
    let largest = |q: &[f64]| q.iter().fold(0.0, |most: f64, q| most.max(q.abs()));
    let (mut steps, mut reach) = (0, largest(&start.q));
    while stepper.time() < scene.duration && steps < 4000 {
        let step = stepper.step()?;
        reach = reach.max(largest(step.q));
        judge.observe(&step);
        steps += 1;
    }
    Ok(Judged { residuals: judge.residuals(), reach, steps, handed: stepper.handed().len() })
}

/// Displacements and energies are measured by the largest of the run, or by `reach` (m) and
/// `energy` (J).
///
/// Where the run reports a stretch that was handed over, moreau-jean may have passed walls by a
/// step, and may have lost the energy that such a step loses.
fn sound(scene: &Scene, run: &Judged, reach: f64, energy: f64) -> bool {
    let r = &run.residuals;
    if run.handed > 0 {
        return r.energy.residual_j.abs() <= 1e-6 * r.energy.exchanged_j.max(energy);
    }
    // A gap may be far less than the displacements that it is the difference of, or far more than
    // all motion.
    let reach = scene.walls.iter().map(|w| w.position().abs()).fold(reach.max(run.reach), f64::max);
    let share = (reach / r.gap_scale).max(1.0);
    r.penetration_m <= 1e-11 * reach
        && r.complementarity * r.gap_scale <= 1e-11 * reach
        && r.energy.residual_j.abs() <= 1e-10 * r.energy.exchanged_j.max(energy)
        && r.force_balance <= 1e-9 * share
        && r.tension_n <= 1e-12 * r.force_scale_n
}

/// `SIGNORINI_CASES` sets how many, `SIGNORINI_SEED` where they begin.
#[test]
fn whatever_starts_on_its_walls_keeps_to_them() {
    let first = draws::seed(0);
    let (mut met, mut handed, mut wrong) = (0, 0, Vec::new());
    let cases = draws::cases(600);
    for seed in first..first + cases {
        let scene = random(&mut Draws::new(seed));
        let run = match judged(&scene) {
            Ok(judged) => judged,
            Err(error) => {
                wrong.push(format!("seed {seed}: {error}"));
                continue;
            }
        };
        let r = &run.residuals;
        met += u64::from(r.force_scale_n > 0.0);
        handed += u64::from(run.handed > 0);
        if sound(&scene, &run, 0.0, 0.0) {
            continue;
        }
        // A structure that walls hold moves and exchanges rounding only: measured by its motion
        // without walls.
        let free = judged(&Scene { walls: Vec::new(), ..scene.clone() }).expect("a run without walls");
        if !sound(&scene, &run, free.reach, free.residuals.energy.exchanged_j) {
            wrong.push(format!(
                "seed {seed}, {} steps, {} handed, {} dofs, {} walls, reach {:e}, free {:e}, {:e} J: {r:?}",
                run.steps,
                run.handed,
                scene.system.degrees_of_freedom(),
                scene.walls.len(),
                run.reach,
                free.reach,
                free.residuals.energy.exchanged_j
            ));
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
    println!("{met} of {cases} runs met a wall, {handed} handed a stretch over");
    assert!(2 * met > cases && 100 * handed <= cases, "{met} {handed} {cases}");
}

#[test]
fn impacts_at_two_walls_in_turn_accumulate_to_rest_at_both() {
    // A floor at x₀ = 0 with e = 0.9, and x₀ − ½x₁ ≤ 0 with e = 0, along which the body flies to
    // the floor. An impact at the floor with the speed u gives 0.9 u there and 1.9 u towards the
    // side, whose impact takes 1.9 u/W₁₁ = 1.52 u from the floor's row: the next one has 0.62 u.
    // Each flight is of the order of the square of the one before, so that few are resolved before
    // the speeds are small; but all of them end in rest at both walls. From there forces that press
    // on neither take the body away: x₀ = ½ f₀ τ², ẋ₀ = f₀ τ, and likewise x₁.
    for forces in [[2.0, 10.0], [0.5, 3.0], [7.0, 20.0]] {
        let free = || Symmetric::zeros(2);
        let side = Row::new(vec![(0, 1.0), (1, -0.5)]);
        let scene = scene(Symmetric::diagonal(&[1.0; 2]), free(), free())
            .with_wall(at(Wall::lower("floor", 0.0).with_restitution(0.9), Row::dof(0)))
            .with_wall(at(Wall::upper("side", 0.0).with_restitution(0.0), side))
            .with_load(on(Load::constant(forces[0]), 0))
            .with_load(on(Load::constant(forces[1]), 1))
            .with_initial(&[1e-3, 2e-3], &[-0.5, -1.0])
            .with_duration(0.5);
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.1).unwrap();
        let start = stepper.state();
        let mut judge = Judge::new(&scene, stepper.contract(), 0.1, &start.q, &start.v);
        while stepper.time() < scene.duration {
            judge.observe(&stepper.step().unwrap());
        }
        assert!(judge.findings().is_empty() && stepper.handed().is_empty(), "{:?}", judge.findings());
        let end = stepper.state();
        let since = end.v[0] / forces[0];
        // The floor is reached after 2 ms and some 1e-5 s, and what follows is over soon.
        assert!(since > 0.4975 && since < 0.498, "{forces:?}: {since}");
        // Some hundred units in the last place of what the body has moved.
        let near = |found: f64, expected: f64| (found / expected - 1.0).abs() < 1e-12;
        assert!(near(end.v[1], forces[1] * since), "{forces:?}: {end:?}");
        assert!(near(end.q[0], 0.5 * forces[0] * since * since), "{forces:?}: {end:?}");
        assert!(near(end.q[1], 0.5 * forces[1] * since * since), "{forces:?}: {end:?}");
    }
}
