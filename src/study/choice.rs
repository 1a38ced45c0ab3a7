//! Which model, scheme and solver a scene needs, and no more.

use crate::error::Result;
use crate::qp::Backend;
use crate::run::Run;
use crate::scene::{Scene, System, WallLaw};
use crate::scheme::{Method, Scheme};

/// A method and why.
#[derive(Debug, Clone)]
pub struct Choice {
    /// What would be run.
    pub method: Method,
    /// Why, in a sentence.
    pub reason: String,
}

/// The constrained QP that honours every wall's restitution: moreau-jean with θ = ½.
///
/// Of the two stepping schemes that honour e, it was ahead of paoli-schatzman on the source scene with impacts (error over the gap at
/// h = 1e-4: 4e-3 against 3e-2 at e = 1 after 1 s, 8e-4 against 3e-3 at e = 0.8), conserves energy to rounding, takes unequal e wall by wall, and
/// its velocities are those of the grid's instants. paoli-schatzman is ahead at e = 0 (order 2).
#[must_use]
pub fn choose(scene: &Scene) -> Choice {
    let method = Method::new(Scheme::MoreauJean { theta: 0.5 });
    let reason = if scene.walls.is_empty() {
        "no walls: the θ-method with θ = ½ is the trapezoidal rule, and no step needs a QP"
    } else if scene.walls.iter().all(|w| !w.law.is_rigid()) {
        "elastic walls only: θ = ½ conserves energy between and within contacts to the order of the step"
    } else {
        "the constrained QP that honours every wall's restitution, and with θ = ½ keeps the energy of free motion exactly; at equal steps its \
         error was below paoli-schatzman's on the source scene"
    };
    Choice { method, reason: reason.into() }
}

/// What an error named beforehand needs, given the outcome of the exact scheme on `scene`: the exact motion where it can be had, since
/// no step comes near its cost at any error; else the stepping scheme that converges fastest to these walls.
#[must_use]
pub fn for_error(scene: &Scene, exact: &Result<Run>) -> Choice {
    let run = match exact {
        Ok(run) => run,
        Err(error) => {
            let restitution_0 = |w: &crate::scene::Wall| w.law == WallLaw::Rigid { restitution: 0.0 };
            let (scheme, why) = match scene.walls.iter().all(restitution_0) {
                true => (Scheme::PaoliSchatzman, "with e = 0 at every wall paoli-schatzman is of order 2"),
                false => (Scheme::MoreauJean { theta: 0.5 }, "the constrained QP honours every wall's restitution"),
            };
            return Choice {
                method: Method::new(scheme),
                reason: format!("{why}; the exact scheme cannot go: {error}"),
            };
        }
    };
    let contacts = run.trajectory.contacts();
    let lasting = |c: &&crate::step::Contact| {
        scene.walls.get(c.wall).is_some_and(|w| w.law.is_rigid()) && c.end.is_none_or(|end| end > c.start)
    };
    let reason = if scene.walls.is_empty() {
        "no walls: the motion is linear, and its closed form needs no step".into()
    } else if contacts.iter().any(|c| lasting(&c)) {
        let (all, lasting) = (contacts.len(), contacts.iter().filter(lasting).count());
        format!(
            "{all} contacts, {lasting} of them lasting: one degree of freedom rests, and its impacts accumulate, in closed form, so no step is \
             needed"
        )
    } else {
        format!(
            "{} separate contacts at {} walls: the closed form between them needs no step",
            contacts.len(),
            scene.walls.len()
        )
    };
    Choice { method: Method::new(Scheme::Event), reason }
}

/// Why the solver of `method` is what it is.
#[must_use]
pub fn qp_reason(method: &Method) -> String {
    match (method.scheme, method.backend) {
        (Scheme::Penalty { .. }, _) => "a penalty has no QP: Newton's method solves each step".into(),
        (Scheme::Event, _) => "at an impact of one degree of freedom the QP is solved by hand: v⁺ = −e v⁻".into(),
        (_, Backend::Condensed) => "asked for: condensed onto the walls".into(),
        (_, Backend::Clarabel) => "asked for: every step that meets a wall goes through Clarabel".into(),
        (_, Backend::Clamp) => "asked for: one unknown, so the QP is a clamp".into(),
        (_, Backend::Auto) => "one unknown: the QP is a clamp, exact and a few nanoseconds".into(),
    }
}

/// What vibrates, in words.
fn system(system: &System) -> String {
    let [slowest, fastest] = system.frequencies();
    match system {
        System::Oscillator(o) if o.stiffness > 0.0 => {
            let ratio = 0.5 * o.damping / (o.stiffness * o.mass).sqrt();
            let frequency = slowest / std::f64::consts::TAU;
            format!(
                "one degree of freedom: natural frequency {frequency:.6} Hz (ω = {slowest:.6} rad/s), damping ratio {ratio:.6}"
            )
        }
        System::Structure(s) => format!(
            "{} degrees of freedom: natural frequencies from {:.6} to about {:.6} Hz",
            s.mass.size(),
            slowest / std::f64::consts::TAU,
            fastest / std::f64::consts::TAU
        ),
        _ => "one degree of freedom without stiffness: a free or falling body".into(),
    }
}

/// The model in words: what the scene is made of, and the numbers that decide how it behaves.
#[must_use]
pub fn model(scene: &Scene) -> Vec<String> {
    let mut lines = vec![system(&scene.system)];
    let [slowest, _] = scene.system.frequencies();
    for (wall, mass) in scene.walls.iter().zip(scene.wall_masses()) {
        let side = if wall.side == crate::scene::Side::Upper { "upper" } else { "lower" };
        let law = match wall.law {
            WallLaw::Rigid { restitution } => format!("rigid, restitution {restitution}"),
            WallLaw::Elastic { stiffness, damping } => {
                let omega = (slowest * slowest + stiffness / mass).sqrt();
                format!(
                    "elastic, {stiffness:e} N/m and {damping:e} N s/m: a contact lasts about {:.3e} s",
                    std::f64::consts::PI / omega
                )
            }
            WallLaw::Quartic { epsilon, .. } => format!("penalty, ε = {epsilon:e} m³/N"),
        };
        lines.push(format!("{side} wall {:?} at {} m: {law}", wall.name, wall.position));
    }
    lines.push(match scene.loads.len() {
        0 => "no loads".into(),
        1 => "one load".into(),
        n => format!("{n} loads, added up"),
    });
    lines
}
