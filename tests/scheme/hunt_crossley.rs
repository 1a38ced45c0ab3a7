//! Walls with the law of Hunt and Crossley, k sⁿ (1 + α ṡ): a single impact against its closed
//! form, a structure against an integrator of its own, energy, and what refuses such walls.

use crate::draws::{cases, seed};
use signorini::{
    Chain, Integrator, Load, Method, Options, PenaltyLaw, Refuted, Scene, Scheme, Side, System, TimeOptions, Wall,
    WallLaw, run,
};

const MASS: f64 = 0.5;
/// Speed of approach, m/s.
const SPEED: f64 = 1.2;

/// A body that flies against a wall with this law.
fn impact(law: WallLaw) -> Scene {
    Scene::oscillator(MASS, 0.0, 0.0)
        .with_wall(Wall { law, ..Wall::upper("stop", 0.0) })
        .with_initial(&[-1e-3], &[SPEED])
        .with_duration(0.02)
}

fn law(exponent: f64, dissipation: f64) -> WallLaw {
    // As deep at every exponent: some 4 mm.
    WallLaw::HuntCrossley { stiffness: 2e4 * 200.0_f64.powf(exponent - 1.0), exponent, dissipation }
}

fn penalty(integrator: Integrator) -> Method {
    Method::new(Scheme::Penalty { law: PenaltyLaw::None, integrator })
}

/// The speed after an impact and the greatest depth, m: from m v dv/ds = −k sⁿ(1 + αv), whose
/// variables separate.
fn closed_form(law: WallLaw) -> [f64; 2] {
    let WallLaw::HuntCrossley { stiffness, exponent, dissipation } = law else { panic!("{law:?}") };
    let depth = |work: f64| (work * MASS * (exponent + 1.0) / stiffness).powf(1.0 / (exponent + 1.0));
    if dissipation == 0.0 {
        return [SPEED, depth(0.5 * SPEED * SPEED)];
    }
    let x = dissipation * SPEED;
    let target = x - x.ln_1p();
    // −y − ln(1 − y) grows from 0 at 0 beyond all bounds at 1.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let y: f64 = 0.5 * (low + high);
        if -y - (-y).ln_1p() < target { low = y } else { high = y }
    }
    [low / dissipation, depth(target / (dissipation * dissipation))]
}

/// The errors of the speed after the impact and of the greatest depth, as shares, with `step` (s).
fn errors(scene: &Scene, integrator: Integrator, step: f64, [speed, depth]: [f64; 2]) -> [f64; 2] {
    let run = run(scene, &penalty(integrator), &Options::new(TimeOptions::with_step(step))).expect("a run");
    assert!(run.refuted().is_none(), "{integrator}: {:?}", run.findings);
    let deepest = run.trajectory.displacement().iter().fold(0.0, |a: f64, &b| a.max(b));
    [(run.state.v[0] + speed).abs() / speed, (deepest - depth).abs() / depth]
}

#[test]
fn an_impact_gives_back_what_the_closed_form_does_whatever_the_exponent() {
    for exponent in [1.0, 1.5, 3.0] {
        for dissipation in [0.0, 0.2, 1.5] {
            let law = law(exponent, dissipation);
            let (scene, known) = (impact(law), closed_form(law));
            // Without dissipation the discrete gradient keeps the energy to rounding.
            let integrators: &[Integrator] = match dissipation {
                0.0 => &[Integrator::Trapezoidal, Integrator::CentralDifference],
                _ => &[Integrator::Trapezoidal, Integrator::CentralDifference, Integrator::DiscreteGradient],
            };
            for &integrator in integrators {
                let of = |step: f64| errors(&scene, integrator, step, known);
                let (coarse, fine) = (of(1e-5), of(2.5e-6));
                // Some 1 000 steps a contact. Order 2: at least eight times less for a fourth of
                // the step, down to the share of a step in the greatest depth, between two.
                assert!(fine[0] < 2e-5 && fine[1] < 2e-5, "{law:?}, {integrator}: {coarse:?}, {fine:?}");
                assert!(fine[0] < coarse[0] / 8.0 || fine[0] < 1e-7, "{law:?}, {integrator}: {coarse:?}, {fine:?}");
            }
            let implicit = [1e-5, 5e-6].map(|step| errors(&scene, Integrator::ImplicitEuler, step, known)[0]);
            assert!(implicit[1] < 0.6 * implicit[0] && implicit[1] < 0.01, "{law:?}: {implicit:?}");
        }
        let [speed, _] = errors(&impact(law(exponent, 0.0)), Integrator::DiscreteGradient, 1e-4, [SPEED, 1.0]);
        assert!(speed < 1e-12, "exponent {exponent}: energy is kept at any step, but {speed:e}");
    }
}

/// Three masses under a sine, of which the last strikes a wall above and a wall below.
fn chain() -> Scene {
    let chain = Chain { masses: vec![1.0, 0.5, 0.8], springs: vec![300.0, 200.0], grounds: [100.0, 0.0] };
    let wall = |name, side, position| Wall { law: law(1.5, 0.8), ..Wall::flat(name, side, position) };
    Scene::structure(chain.structure().expect("a chain"))
        .with_wall(wall("above", Side::Upper, 4e-3).at(signorini::Row::dof(2)))
        .with_wall(wall("below", Side::Lower, -6e-3).at(signorini::Row::dof(2)))
        .with_load(Load::harmonic(8.0, 2.0, 0.4))
        .with_duration(1.0)
}

/// The state at `end` by the classical method of order 4 in equal steps.
fn runge_kutta(rates: &dyn Fn(f64, &[f64; 6]) -> [f64; 6], mut state: [f64; 6], end: f64, steps: u32) -> [f64; 6] {
    let h = end / f64::from(steps);
    let along = |state: &[f64; 6], by: f64, rate: &[f64; 6]| std::array::from_fn(|i| state[i] + by * rate[i]);
    for step in 0..steps {
        let t = h * f64::from(step);
        let a = rates(t, &state);
        let b = rates(t + 0.5 * h, &along(&state, 0.5 * h, &a));
        let c = rates(t + 0.5 * h, &along(&state, 0.5 * h, &b));
        let d = rates(t + h, &along(&state, h, &c));
        let mean = std::array::from_fn(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        state = along(&state, h, &mean);
    }
    state
}

#[test]
fn a_structure_follows_an_integrator_of_its_own_with_order_2() {
    let scene = chain();
    let System::Structure(structure) = &scene.system else { panic!("a structure") };
    let rates = |t: f64, state: &[f64; 6]| {
        let (q, v) = state.split_at(3);
        let mut force = vec![8.0 * (std::f64::consts::TAU * 2.0 * t + 0.4).sin(), 0.0, 0.0];
        structure.stiffness.add_product(-1.0, q, &mut force);
        for wall in &scene.walls {
            let (depth, toward) = (-wall.gap(q[2]), -wall.side().sign());
            if depth > 0.0
                && let WallLaw::HuntCrossley { stiffness, exponent, dissipation } = wall.law
            {
                force[2] -= toward * stiffness * depth.powf(exponent) * (1.0 + dissipation * toward * v[2]).max(0.0);
            }
        }
        let mass = structure.mass.diagonal_entries();
        [v[0], v[1], v[2], force[0] / mass[0], force[1] / mass[1], force[2] / mass[2]]
    };
    let end = runge_kutta(&rates, [0.0; 6], 1.0, 200_000);
    let error = |integrator: Integrator, step: f64| {
        let run = run(&scene, &penalty(integrator), &Options::new(TimeOptions::with_step(step))).expect("a run");
        assert!(run.refuted().is_none(), "{integrator}: {:?}", run.findings);
        assert!(run.trajectory.contacts().len() > 3, "{}", run.trajectory.contacts().len());
        let state = &run.state;
        state.q.iter().zip(&end).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    for integrator in [Integrator::DiscreteGradient, Integrator::Trapezoidal, Integrator::CentralDifference] {
        let [coarse, fine] = [2e-4, 5e-5].map(|step| error(integrator, step));
        // The gap is 4 mm; order 2 gives a sixteenth, of which contacts that begin within a step
        // leave a little.
        assert!(fine < coarse / 10.0 && fine < 1e-6, "{integrator}: {coarse:e}, {fine:e}");
    }
}

#[test]
fn what_takes_no_such_wall_says_so_and_the_choice_does_not_fall_on_it() {
    let scene = impact(law(1.5, 0.2));
    let options = Options::new(TimeOptions::with_step(1e-4));
    for scheme in Scheme::ALL.into_iter().filter(|scheme| scheme.entry().name != "penalty") {
        let error = run(&scene, &Method::new(scheme), &options).expect_err("refused").to_string();
        assert!(error.contains("Hunt and Crossley") && error.contains("penalty"), "{error}");
    }
    let chosen = signorini::study::choice::choose(&scene).method;
    assert_eq!(chosen.to_string(), "penalty");
    assert_eq!(chosen, "penalty".parse().expect("a method"));
    // Beside a rigid wall the penalty needs a spring for that.
    let mixed = scene.with_wall(Wall::lower("rigid", -1.0));
    let error = run(&mixed, &chosen, &options).expect_err("no spring").to_string();
    assert!(error.contains("rigid wall \"rigid\"") && error.contains("stiffness"), "{error}");
    run(&mixed, &"penalty:stiffness=1e8".parse::<Method>().expect("a method"), &options).expect("a spring");
}

#[test]
fn the_judge_accuses_no_random_scene_with_such_walls() {
    for index in 0..cases(60_u64) {
        let mut seed = seed(0x4c_0000) + index;
        // Numbers of all sizes between two, by splitmix (Steele et al. 2014).
        let mut draw = |from: f64, to: f64| {
            seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (seed ^ (seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            from * (to / from).powf((mixed ^ (mixed >> 31)) as f64 / u64::MAX as f64)
        };
        let n = 1 + index as usize % 3;
        let chain = Chain {
            masses: (0..n).map(|_| draw(0.1, 10.0)).collect(),
            springs: (1..n).map(|_| draw(10.0, 1e4)).collect(),
            grounds: [draw(10.0, 1e3), 0.0],
        };
        let gap = draw(1e-4, 1e-2);
        let mut scene = Scene::structure(chain.structure().expect("a chain")).with_duration(1.0);
        for (name, side) in [("above", Side::Upper), ("below", Side::Lower)] {
            let exponent = draw(1.0, 4.0);
            let stiffness = draw(1e3, 1e6) * gap.powf(1.0 - exponent);
            let law = WallLaw::HuntCrossley { stiffness, exponent, dissipation: draw(1e-3, 30.0) };
            let position = if side == Side::Upper { gap } else { -gap };
            scene = scene.with_wall(Wall { law, ..Wall::flat(name, side, position) }.at(signorini::Row::dof(n - 1)));
        }
        let scene = scene.with_load(Load::harmonic(draw(0.1, 100.0), draw(0.5, 20.0), 0.3));
        let step = draw(1e-5, 1e-2);
        for integrator in Integrator::ALL {
            let run = run(&scene, &penalty(integrator), &Options::new(TimeOptions::with_step(step)));
            let run = run.unwrap_or_else(|error| panic!("{index}, {integrator}, step {step:e}: {error}"));
            // Steps that do not resolve a wall make these two gain energy: such runs end by name.
            let grows = matches!(integrator, Integrator::Trapezoidal | Integrator::CentralDifference);
            let found: Vec<_> =
                run.findings.iter().filter(|found| !(grows && found.refuted == Refuted::Diverged)).collect();
            assert!(found.is_empty(), "{index}, {integrator}, step {step:e}: {found:?}");
        }
    }
}
