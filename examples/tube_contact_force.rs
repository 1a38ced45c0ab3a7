//! The contact force of a tube that rattles in two loose supports.
//!
//! `cargo run --release --example tube_contact_force > force.csv` prints the force of the first
//! support, averaged over 1 ms, as CSV, and the mean and largest force of each support to stderr.
//!
//! The force of a rigid impact is not finite, so impulse/h of a step has no limit as h shrinks. The
//! impulse has one, and so has the force averaged over a stated time: here the impulse between two
//! rows, 1 ms apart, divided by that time.

use signorini::{Beam, BeamEnd, BeamSection, Damping, Load, Options, Result, Scene, Scheme, Wall, run};

/// Spacing of the rows, s, over which the force is averaged.
const WINDOW: f64 = 1e-3;

fn main() -> Result<()> {
    // A heat-exchanger tube, 19.05 × 1.65 mm steel, three spans of 1 m, 0.2 mm from its supports on
    // either side.
    let tube = Beam {
        length: 3.0,
        youngs_modulus: 2e11,
        density: 7850.0,
        section: BeamSection::Tube { outer_diameter: 19.05e-3, inner_diameter: 15.75e-3 },
        added_mass: 0.565,
        elements: 30,
        left: BeamEnd::Pinned,
        right: BeamEnd::Pinned,
    };
    let mut scene = Scene::structure(tube.structure()?).with_duration(2.0);
    let supports = [("first", 1.0), ("second", 2.0)];
    for (name, position) in supports {
        let at = tube.at(position)?;
        let upper = Wall::upper(&format!("{name}-upper"), 2e-4).with_restitution(0.5);
        let lower = Wall::lower(&format!("{name}-lower"), -2e-4).with_restitution(0.5);
        scene = scene.with_wall(upper.at(at.clone())).with_wall(lower.at(at.clone())).with_probe(name, at);
    }
    let scene = scene.with_load(Load { at: tube.at(0.5)?, ..Load::harmonic(10.0, 25.0, 0.0) });

    // Twenty modes, each with 1 % of critical damping. The share of the mass at each wall that
    // these keep is reported.
    let cut = scene.reduced(20, false)?.with_damping(&Damping::Modal(vec![0.01]))?;
    let run = run(&cut.scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(5e-5).with_sample(WINDOW))?
        .unrefuted()?;

    let trajectory = &run.trajectory;
    let (displacement, _) = trajectory.probe("first")?;
    let (upper, lower) = (trajectory.contact_impulse("first-upper")?, trajectory.contact_impulse("first-lower")?);
    println!("time_s,displacement_first_m,mean_force_first_N");
    for (row, time) in trajectory.time().iter().enumerate().skip(1) {
        println!("{time},{},{}", displacement[row], (upper[row] + lower[row]) / WINDOW);
    }

    for (name, _) in supports {
        let (mut impulse, mut largest) = (0.0, 0.0_f64);
        for side in ["upper", "lower"] {
            let impulses = trajectory.contact_impulse(&format!("{name}-{side}"))?;
            impulse += impulses.iter().map(|p| p.abs()).sum::<f64>();
            largest = impulses.iter().fold(largest, |most, p| most.max(p.abs() / WINDOW));
        }
        let force = impulse / scene.duration;
        eprintln!("{name}: {force:.3} N in the mean, {largest:.1} N at most over {WINDOW} s");
    }
    // The judge has checked every step: the laws at the walls hold, and momentum is balanced.
    let (walls, balance) = (run.residuals.complementarity, run.residuals.force_balance);
    eprintln!("residuals: {walls:.1e} at the walls, {balance:.1e} in the momentum balance");
    Ok(())
}
