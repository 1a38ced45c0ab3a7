//! Chooses the simplest model, scheme and solver that a scene allows.

use crate::error::{Result, amount};
use crate::linear::{Factor, Symmetric};
use crate::qp::Backend;
use crate::run::Run;
use crate::scene::{MOST_DENSE, Scene, Structure, System, Wall, WallLaw};
use crate::scheme::{Coverage, Integrator, Method, PenaltyLaw, Scheme, SchemeKind, Stepper};

/// A method and the reason for it.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Choice {
    /// The method to run.
    pub method: Method,
    /// The reason, in one sentence.
    pub reason: String,
}

/// The default method: the constrained QP with every wall's restitution.
///
/// At rigid flat walls that is located, whose steps are divided at the impacts: over the built-in
/// cases with such walls its error at the case's step was below moreau-jean's wherever the motion
/// is predictable, on `rigid-walls-sine` 3e-5 of the gap against 1e-1 at h = 1e-4 (`signorini
/// compare CASE --schemes moreau-jean,located`). Likewise where no wall is rigid and one has a
/// dashpot, whose force jumps where a contact begins: on `tabulated-pulse` 7e-7 against
/// 2.5e-4. In round holes and with friction an impact costs it several steps, and a random motion
/// gains nothing from its order: there, and at springs alone, where both make the same steps, it is
/// moreau-jean with θ = ½, but for friction at elastic round supports, which that does not step.
#[must_use]
pub fn choose(scene: &Scene) -> Choice {
    let moreau_jean = Scheme::MoreauJean { theta: 0.5 };
    let rubs = scene.walls.iter().any(|wall| wall.friction.acts());
    let (scheme, reason) = if rubs && scene.holes().any(|hole| !hole.law.is_rigid()) {
        let reason = "the one scheme for friction at an elastic round support, whose force and normal it takes in the \
                      middle of each part of a step";
        (Scheme::Located, reason)
    } else if scene.nonlinear_wall().is_none() && has_dashpots_alone(scene) {
        let reason = "elastic walls only, and the force of a dashpot jumps where a contact begins: steps are divided \
                      there, and are of order 2, where whole steps err by the order 1";
        (Scheme::Located, reason)
    } else if scene.holes().next().is_some() {
        let reason = "it turns with the normal of a round support: what slides there keeps its speed, an impact \
                      never adds energy, and with θ = ½ free motion keeps its own";
        (moreau_jean, reason)
    } else if rubs {
        (
            moreau_jean,
            "it has friction, at the least cost a step, and with θ = ½ keeps the energy of free motion exactly",
        )
    } else if scene.nonlinear_wall().is_some() {
        let reason = "the force of a wall is no multiple of its depth, so that a step minimises a convex function that \
                      is no QP: Newton's method finds its minimum, and the discrete gradient keeps the energy of what \
                      has no dissipation";
        let integrator = Integrator::DiscreteGradient;
        (Scheme::Penalty { law: PenaltyLaw::None, integrator }, reason)
    } else if scene.walls.is_empty() {
        (moreau_jean, "no walls: the θ-method with θ = ½ is the trapezoidal rule, and no step needs a QP")
    } else if scene.walls.iter().all(|w| !w.law.is_rigid()) {
        let reason = "springs for walls: θ = ½ conserves energy between and within contacts to the order of the step";
        (moreau_jean, reason)
    } else {
        let reason = "the constrained QP that honours every wall's restitution at the instant of each impact: of \
                      order 2 through impacts, without penetration, and free motion keeps its energy exactly";
        (Scheme::Located, reason)
    };
    Choice { method: Method::new(scheme), reason: reason.into() }
}

/// True where no wall is rigid, and one has a dashpot.
fn has_dashpots_alone(scene: &Scene) -> bool {
    !scene.walls.iter().any(|wall| wall.law.is_rigid()) && scene.dashpot_wall().is_some()
}

/// The method for an error named beforehand, given the outcome of the exact scheme on `scene`: the
/// exact scheme where it succeeds, since no stepping scheme is as cheap at any error; else the
/// stepping scheme that converges fastest for these walls.
pub(crate) fn for_error(scene: &Scene, exact: &Result<Run>) -> Choice {
    let run = match exact {
        Ok(run) => run,
        Err(error) => {
            let Choice { method, reason } = stepping_for_error(scene);
            return Choice { method, reason: format!("{reason}; the exact scheme cannot follow the scene: {error}") };
        }
    };
    let contacts = run.trajectory.contacts();
    let lasting = |c: &&crate::step::Contact| {
        scene.walls.get(c.wall).is_none_or(|w| w.law.is_rigid()) && c.end.is_none_or(|end| end > c.start)
    };
    let holes = scene.holes().count();
    let reason = if scene.walls.is_empty() {
        "no walls: the motion is linear, and its closed form needs no step".into()
    } else if contacts.iter().any(|c| lasting(&c)) {
        let (all, lasting) = (contacts.len(), contacts.iter().filter(lasting).count());
        let what = match scene.system {
            System::Oscillator(_) => "one degree of freedom rests, and its impacts accumulate, in closed form",
            System::Structure(_) => "while a contact lasts, the rest of the structure moves on in closed form",
        };
        format!("{all} contacts, {lasting} of them lasting: {what}, so no step is needed")
    } else {
        let beside = if holes > 0 { format!(" and {holes} round holes") } else { String::new() };
        let (all, walls) = (contacts.len(), scene.walls.len() - holes);
        format!("{all} separate contacts at {walls} walls{beside}: the closed form between them needs no step")
    };
    Choice { method: Method::new(Scheme::Event), reason }
}

/// The stepping scheme that converges fastest for the walls of `scene`: for an error named
/// beforehand, and for runs with finer steps that others are compared with.
pub(crate) fn stepping_for_error(scene: &Scene) -> Choice {
    if scene.nonlinear_wall().is_some() {
        return choose(scene);
    }
    let reason = "located divides its steps at the impacts, and is of order 2 through them".into();
    Choice { method: Method::new(Scheme::Located), reason }
}

/// The laws of the schemes at round supports; and which schemes refuse them or their
/// friction; empty for a scene without round supports and friction. A scheme refuses a scene where
/// its stepper does.
#[must_use]
pub fn at_supports(scene: &Scene, step: f64) -> Vec<String> {
    if !scene.turns_or_rubs() {
        return Vec::new();
    }
    let (taken, refused): (Vec<_>, Vec<_>) = Scheme::ALL.into_iter().partition(|one| Stepper::takes(scene, one, step));
    let names = |of: &[Scheme]| of.iter().map(|one| one.entry().name).collect::<Vec<_>>().join(", ");
    let law = |one: &Scheme| match one.entry().round {
        Coverage::Stepped(law) => Some(format!("at round supports {} {law}", one.entry().name)),
        Coverage::Refused(_) => None,
    };
    let mut lines = Vec::new();
    if scene.holes().next().is_some() && scene.holes().all(|hole| hole.law.is_rigid()) {
        lines.extend(taken.iter().filter_map(law));
    } else {
        lines.push(format!("schemes for these supports: {}", names(&taken)));
    }
    lines.extend(refused_in_words(&refused.into_iter().map(Method::new).collect::<Vec<_>>()));
    lines
}

/// Names the `methods` that refuse a scene, if there are any.
#[must_use]
pub fn refused_in_words(methods: &[Method]) -> Option<String> {
    let names = methods.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    (!methods.is_empty()).then(|| format!("refused here: {names}; `run --scheme NAME` says why"))
}

/// True if a step of `method` on a scene with round walls is a programme with disks, not one of
/// velocities along the normals of contacts.
#[must_use]
pub(crate) fn takes_disks(method: &Method, scene: &Scene) -> bool {
    match method.scheme {
        Scheme::Located => false,
        Scheme::MoreauJean { .. } => scene.holes().any(|hole| !hole.law.is_rigid()),
        _ => scene.turns_or_rubs(),
    }
}

/// Why `method` on `scene` uses its solver.
#[must_use]
pub fn qp_reason(method: &Method, scene: &Scene) -> String {
    let single = matches!(scene.system, System::Oscillator(_));
    let kind = method.scheme.entry().kind;
    if scene.turns_or_rubs() && kind == SchemeKind::Qp {
        return if takes_disks(method, scene) {
            "a programme with disks: one round support in closed form, several by sweeps and Newton's method on \
             their multipliers; Clarabel is the fallback"
        } else {
            "round supports and friction are no QP: the contacts are solved one by one in closed form, in sweeps, \
             and then together"
        }
        .to_owned();
    }
    match (kind, method.backend) {
        (SchemeKind::Penalty, _) => "a penalty has no QP: Newton's method solves each step",
        (SchemeKind::Exact, _) if single => {
            "for one degree of freedom the QP at an impact has the closed form v⁺ = −e v⁻"
        }
        (SchemeKind::Exact, _) => "at an impact, a QP in the mass metric over the walls in contact",
        (_, Backend::Condensed) => "asked for: condensed onto the walls",
        (_, Backend::Clarabel) => "asked for: every step that meets a wall goes through Clarabel",
        (_, Backend::Clamp) => "asked for: one unknown, so the QP is a clamp",
        (_, Backend::Auto) if single => "one unknown: the QP is a clamp, exact and a few nanoseconds",
        (_, Backend::Auto) => {
            "several unknowns: condensed onto the walls and solved exactly by block principal pivoting, \
             warm-started; Clarabel is the fallback"
        }
    }
    .into()
}

/// The system in words.
fn system(system: &System) -> String {
    let [slowest, fastest] = system.frequencies();
    match system {
        System::Oscillator(o) if o.stiffness > 0.0 => {
            let ratio = 0.5 * o.damping / (o.stiffness * o.mass).sqrt();
            let frequency = slowest / std::f64::consts::TAU;
            format!(
                "one degree of freedom: natural frequency {frequency:.6} Hz (ω = {slowest:.6} rad/s), damping \
                 ratio {ratio:.6}"
            )
        }
        System::Structure(s) => {
            let n = s.mass.size();
            let degrees = if n == 1 { "degree" } else { "degrees" };
            let about = if s.uncoupled_squares().is_some() { "" } else { "about " };
            format!(
                "{n} {degrees} of freedom: natural frequencies from {} to {about}{} Hz",
                hertz(slowest / std::f64::consts::TAU),
                hertz(fastest / std::f64::consts::TAU)
            )
        }
        _ => "one degree of freedom without stiffness: a free or falling body".into(),
    }
}

/// A natural frequency, Hz, so that a slow one does not look like none.
pub(crate) fn hertz(frequency: f64) -> String {
    match frequency {
        0.0 => "0".to_owned(),
        f if f < 1e-2 => amount(f, 6),
        f => format!("{f:.6}"),
    }
}

/// A share of damping below this is rounding.
const NOTHING: f64 = 1e-9;

/// The damping of a structure in words, and whether it couples its modes.
fn damping(system: &System, structure: &Structure) -> String {
    if structure.damping.entries().all(|entry| entry.2 == 0.0) {
        return "no damping".into();
    }
    if let Some((mass, stiffness)) = structure.rayleigh() {
        let words = |x: f64| amount(x, 12);
        // The share of one Rayleigh term in a mode's damping may be rounding beside that of the
        // other.
        let [slowest, fastest] = system.frequencies();
        let sum = match (
            mass.abs() > NOTHING * stiffness * slowest * slowest,
            stiffness * fastest * fastest > NOTHING * mass,
        ) {
            (true, false) => format!("{} M", words(mass)),
            (false, true) => format!("{} K", words(stiffness)),
            _ => format!("{} M + {} K", words(mass), words(stiffness)),
        };
        return format!("classical damping: C = {sum}, the modes are uncoupled");
    }
    let widths = [&structure.mass, &structure.damping, &structure.stiffness].map(|m| m.half_bandwidth());
    if widths == [0; 3] {
        return "classical damping: the coordinates are uncoupled".into();
    }
    if structure.is_classically_damped() {
        "classical damping: the modes are uncoupled".into()
    } else if structure.mass.size() > MOST_DENSE {
        format!(
            "damping not known to be classical: beyond {MOST_DENSE} degrees of freedom Rayleigh's alone is \
             recognised"
        )
    } else {
        "damping that couples the modes".into()
    }
}

/// How the matrices of a step of `h` seconds are solved, in words; `None` for one degree of
/// freedom, which has no matrices.
#[must_use]
pub fn path(scene: &Scene, h: f64) -> Option<String> {
    let System::Structure(s) = &scene.system else { return None };
    let iteration = Symmetric::sum(&[(1.0, &s.mass), (0.5 * h, &s.damping), (0.25 * h * h, &s.stiffness)]);
    Some(format!("{}: factored once, solved in every step", Factor::described(&iteration)))
}

/// The system and its damping in words.
#[must_use]
pub fn body(scene: &Scene) -> Vec<String> {
    let mut lines = vec![system(&scene.system)];
    if let System::Structure(structure) = &scene.system {
        lines.push(damping(&scene.system, structure));
    }
    lines
}

/// Each flat wall in words, with its index, in the scene's order.
#[must_use]
pub fn walls(scene: &Scene) -> Vec<(usize, String)> {
    let several = matches!(scene.system, System::Structure(_));
    let [slowest, _] = scene.system.frequencies();
    let line = |(index, (wall, mass)): (usize, (&Wall, f64))| {
        let side = wall.side().name();
        let law = match wall.law {
            WallLaw::Rigid { restitution } => format!("rigid, restitution {restitution}"),
            WallLaw::Elastic { stiffness, damping } if several => {
                format!("elastic, {stiffness:e} N/m and {damping:e} N s/m")
            }
            WallLaw::Elastic { stiffness, damping } => {
                let omega = (slowest * slowest + stiffness / mass).sqrt();
                format!(
                    "elastic, {stiffness:e} N/m and {damping:e} N s/m: a contact lasts about {:.3e} s",
                    std::f64::consts::PI / omega
                )
            }
            WallLaw::HuntCrossley { stiffness, exponent, dissipation } => {
                let law = format!("Hunt and Crossley's law, {stiffness:e} N/m^{exponent} and {dissipation:e} s/m");
                if dissipation == 0.0 {
                    format!("{law}: an impact loses nothing")
                } else {
                    format!("{law}: an impact at v m/s has a restitution of about 1 − {:.3e} v", dissipation / 1.5)
                }
            }
            WallLaw::Quartic { epsilon, .. } => format!("penalty, ε = {epsilon:e} m³/N"),
        };
        let feels = if several { format!("; feels {mass:.4e} kg") } else { String::new() };
        (index, format!("{side} wall {:?} at {} m: {law}{feels}", wall.name, wall.position()))
    };
    let walls = scene.walls.iter().zip(scene.wall_masses()).enumerate();
    walls.filter(|(_, (wall, _))| !wall.is_round()).map(line).collect()
}

/// The loads in words.
#[must_use]
pub fn loads(scene: &Scene) -> String {
    loads_in_words(scene.loads.len())
}

/// This number of loads in words.
pub(crate) fn loads_in_words(count: usize) -> String {
    match count {
        0 => "no loads".into(),
        1 => "one load".into(),
        n => format!("{n} loads, added up"),
    }
}
