//! Co-simulation: another program, a controller and its actuator with their own rate, presses a
//! spring-mounted body on a rigid stop.
//!
//! `cargo run --release --example co_simulation` prints the contact force every 20 ms as CSV: it
//! settles at the wanted 5 N.
//!
//! In every macro step of 1 ms both programs are advanced. The actuator is a spring that the body
//! moves against, so its force depends on where the body will be: the macro step is repeated with
//! better guesses of the force ([`Stepper::set_state`] puts the body back) until both agree.
//! Without that, a stiff actuator with a delay of one macro step would create energy.

use signorini::{Result, Scene, Scheme, Stepper, Wall};

/// The macro step after which the programs exchange values, s, and the number of steps of the body
/// in it.
const MACRO: f64 = 1e-3;
const STEPS: u32 = 20;

/// Force wanted on the stop, N.
const WANTED: f64 = 5.0;

/// The other program: an integrating force controller that moves the far end of the actuator's
/// spring.
struct Actuator {
    /// Stiffness of the spring, N/m, and the place of its far end, m.
    stiffness: f64,
    end: f64,
}

impl Actuator {
    /// Its force on a body at `q` (m), N.
    fn force(&self, q: f64) -> f64 {
        self.stiffness * (self.end - q)
    }

    /// One sample of the controller, which has measured the force on the stop (N) over the last
    /// macro step.
    fn control(&mut self, measured: f64) {
        // At most 0.2 m/s: before contact nothing else limits the approach.
        let speed = (0.05 * (WANTED - measured)).clamp(-0.2, 0.2);
        self.end += speed * MACRO;
    }
}

/// One macro step of the body under the actuator's force: displacement (m) and force on the stop
/// (N), both means over the step.
fn advance(body: &mut Stepper, force: f64) -> Result<(f64, f64)> {
    let (mut place, mut impulse) = (0.0, 0.0);
    // To a time and not for a number of steps, of which some schemes divide one at an impact.
    let end = body.time() + MACRO * (1.0 - 1e-9);
    while body.time() < end {
        let step = body.step_with(&[force])?;
        place += step.q[0] * (step.end - step.start) / MACRO;
        impulse -= step.impulse[0];
    }
    Ok((place, impulse / MACRO))
}

fn main() -> Result<()> {
    // 1 kg on 100 N/m, 2 N s/m, 10 mm before a plastic stop; nothing but the actuator drives it.
    let scene = Scene::oscillator(1.0, 2.0, 100.0).with_wall(Wall::upper("stop", 0.01).with_restitution(0.0));
    let mut body = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, MACRO / f64::from(STEPS))?;
    let mut actuator = Actuator { stiffness: 2000.0, end: 0.0 };
    let (mut place, mut on_stop, mut repeated) = (0.0, 0.0, 0_u32);

    println!("time_s,displacement_m,force_on_stop_N");
    for sample in 0..1000_u32 {
        actuator.control(on_stop);
        // The start of this macro step, to return to. (A step's time is a product, so it is taken
        // from the stepper.)
        let (time, state) = (body.time(), body.state());
        loop {
            let guess = place;
            (place, on_stop) = advance(&mut body, actuator.force(guess))?;
            if (place - guess).abs() < 1e-9 {
                break;
            }
            body.set_state(time, &state)?;
            repeated += 1;
        }
        if sample % 20 == 19 {
            println!("{:.3},{:.6},{on_stop:.4}", body.time(), place);
        }
    }
    eprintln!("{on_stop:.3} N on the stop after 1 s; {repeated} macro steps were repeated");
    assert!((on_stop - WANTED).abs() < 0.05, "the controller has not settled: {on_stop} N");
    Ok(())
}
