//! The elastic bar thrown against a rigid wall, compared with its closed form: contact from t = 1 s
//! to 2 s under the stress ½, then back to the start at t = 3 s (L = E = ρ = area = 1, u(x, 0) =
//! ½(1 − x), v = 0, held at x = 1, wall at x = 0, e = 0; GetFEM's test of contact in
//! elastodynamics).

use signorini::{Bar, BarEnd, MassMatrix, Options, Probe, Run, Scene, Scheme, TimeOptions, Wall, run};

fn scene(elements: usize) -> Scene {
    let bar = Bar {
        length: 1.0,
        area: 1.0,
        youngs_modulus: 1.0,
        density: 1.0,
        elements,
        left: BarEnd::Free,
        right: BarEnd::Fixed,
        mass: MassMatrix::Consistent,
    };
    let end = bar.at(0.0).unwrap();
    let wall = Wall::lower("wall", 0.0).with_restitution(0.0).at(end.clone());
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_wall(wall).with_duration(3.0);
    scene.system = bar.structure().unwrap().into();
    scene.initial.q = bar.field("initial.displacement", &|x| 0.5 * (1.0 - x)).unwrap();
    scene.initial.v = vec![0.0; scene.initial.q.len()];
    scene.probes = vec![Probe { name: "end".into(), at: end }];
    scene
}

/// What the closed form gives: how long the contact lasts (s), its mean stress (Pa), and where the
/// end returns to (m).
#[derive(Debug, Clone, Copy)]
struct Outcome {
    duration: f64,
    stress: f64,
    rebound: f64,
}

const EXACT: Outcome = Outcome { duration: 1.0, stress: 0.5, rebound: 0.5 };

impl Outcome {
    fn of(run: &Run) -> Self {
        let contacts = run.trajectory.contacts();
        let start = contacts.iter().map(|c| c.start).fold(f64::INFINITY, f64::min);
        let end = contacts.iter().filter_map(|c| c.end).fold(0.0, f64::max);
        let duration = end - start;
        let stress = run.trajectory.impulse("wall").unwrap() / duration;
        Self { duration, stress, rebound: *run.trajectory.displacement().last().unwrap() }
    }

    fn errors(self) -> [f64; 3] {
        [self.duration - EXACT.duration, self.stress - EXACT.stress, self.rebound - EXACT.rebound].map(f64::abs)
    }
}

fn outcome(scheme: &Scheme, elements: usize) -> Outcome {
    let step = 0.1 / elements as f64;
    let time = TimeOptions { sample: Some(0.1), ..TimeOptions::with_step(step) };
    Outcome::of(&run(&scene(elements), scheme, &Options { time, ..Options::with_step(step) }).unwrap())
}

#[test]
fn duration_stress_and_rebound_converge_to_the_closed_form() {
    // A wave front on a mesh is smeared over a width like the mesh to the power 2/3 (dispersion of
    // linear elements), so four times as many elements leave errors 4^(2/3) = 2.5 times smaller;
    // noise of single steps takes some of that. The implicit Euler rule damps the front as well:
    // order ½.
    let schemes = [
        (Scheme::MoreauJean { theta: 0.5 }, 2.0, 1e-3),
        (Scheme::PaoliSchatzman, 2.0, 1e-3),
        (Scheme::GeneralizedAlpha { rho: 0.8 }, 2.0, 1e-3),
        (Scheme::ImplicitEuler, 1.5, 2e-2),
        (Scheme::Event, 2.0, 1e-3),
    ];
    for (scheme, least, stress) in schemes {
        let [coarse, middle, fine] = [25, 100, 400].map(|n| outcome(&scheme, n).errors());
        println!("{scheme}: {coarse:?} {middle:?} {fine:?}");
        for (coarse, fine) in [(coarse, middle), (middle, fine)] {
            // Duration and rebound fall at that rate. The impulse falls short as the duration does,
            // so that the mean stress is right to a thousandth from the first mesh on; implicit
            // Euler loses a damped front's part of it.
            for i in [0, 2] {
                assert!(coarse[i] > least * fine[i], "{scheme}: quantity {i}: {coarse:?} to {fine:?}");
            }
        }
        assert!(fine[1] < stress, "{scheme}: stress off by {}", fine[1]);
    }
}

#[test]
fn an_impact_takes_the_energy_of_the_end_node_alone() {
    // The end node stops dead: with a consistent mass it carries ½ m v² with m = 1/(g M⁻¹ gᵀ),
    // which is 1/(2√3) of an element's mass on a long bar, at the speed ½ of the bar. What the
    // scheme takes beyond that would be its own.
    for (elements, scheme) in [(50, Scheme::Event), (50, Scheme::MoreauJean { theta: 0.5 }), (200, Scheme::Event)] {
        let scene = scene(elements).with_duration(1.5);
        let step = 0.02 / elements as f64;
        let run = run(&scene, &scheme, &Options::with_step(step)).unwrap();
        let mass = scene.wall_masses()[0];
        assert!((mass * elements as f64 - 0.5 / 3.0_f64.sqrt()).abs() < 1e-6, "{}", mass * elements as f64);
        let lost = run.residuals.energy.impact_loss_j;
        println!("{scheme}, {elements} elements: {lost:e} of {:e}", 0.5 * mass * 0.25);
        assert!(run.residuals.energy.residual < 1e-11, "{scheme}: {:?}", run.residuals.energy);
        assert!(lost > 0.0 && lost < 2.0 * 0.5 * mass * 0.25, "{scheme}: {lost:e}");
    }
}
