//! What a reader must know about a scene and a step, independent of the run.

use crate::error::amount;
use crate::linear::Symmetric;
use crate::scene::{Load, LoadKind, Row, Scene, Side, Structure, System, Table, Wall, WallLaw};
use crate::scheme::Scheme;
use std::f64::consts::{PI, TAU};

/// Minimum number of steps per period: with ten the trapezoidal rule makes the period 3 % longer.
const STEPS_A_PERIOD: f64 = 10.0;
/// An elastic wall is resolved below this h² k/m: ten steps per contact.
const RESOLVED: f64 = 0.1;
/// The steps resolve a table if its largest departure between them is below this share of its
/// range.
const MISSED: f64 = 1e-2;
/// The steps pass over a table that changes this share of its range between two of them.
const PASSED: f64 = 0.1;
/// A step resolves what a wall strikes if it adds less than this share to the mass there.
const HEAVIER: f64 = 0.25;
/// A mode matters if it contributes this share of the static compliance at a wall or load.
const MATTERS: f64 = 1e-2;
/// Range of natural frequencies usual in engineering, Hz.
const USUAL: [f64; 2] = [1e-2, 1e5];

/// Notes on `scene` run by `scheme` in steps of `step` seconds; those on what walls do only where
/// they may be `touched`.
pub(crate) fn setup(scene: &Scene, scheme: &Scheme, step: f64, touched: bool) -> Vec<String> {
    let mut notes: Vec<String> = scene.loads.iter().enumerate().filter_map(|(i, load)| span(scene, i, load)).collect();
    notes.extend(scene.loads.iter().enumerate().filter_map(|(i, load)| turned(i, load)));
    notes.extend(scene.loads.iter().enumerate().filter_map(|(i, load)| idle(scene, i, load)));
    notes.extend(unusual(scene));
    notes.extend(unstable(scene));
    notes.extend(clamped(scene));
    if !scheme.is_exact() {
        notes.extend(
            scene.loads.iter().enumerate().filter_map(|(i, load)| load_resolved(scene, i, load, (scheme, step))),
        );
        notes.extend(modes_resolved(scene, step));
    }
    if !scheme.is_exact() && touched {
        notes.extend((*scheme == Scheme::Located).then(|| struck_resolved(scene, step)).flatten());
        notes.extend(walls_resolved(scene, step));
        notes.extend(dashpots_resolved(scene, step));
    }
    notes
}

/// A note on a table that does not cover the whole run, where that is not the end of a pulse.
fn span(scene: &Scene, index: usize, load: &Load) -> Option<String> {
    let LoadKind::Table(table) = &load.kind else { return None };
    let (number, end) = (index + 1, scene.duration);
    let (first, last) = (*table.time().first()?, *table.time().last()?);
    let acts = |force: Option<&f64>| force.is_some_and(|force| *force != 0.0);
    if last < end * (1.0 - 1e-9) && acts(table.force().last()) {
        return Some(format!(
            "the table of load {number} ends at {} s, before the run does at {end} s: from then on it is 0",
            amount(last, 6)
        ));
    }
    let starts = first > 0.0 && acts(table.force().first());
    starts.then(|| format!("the table of load {number} begins at {} s: before, it is 0", amount(first, 6)))
}

/// A note on a load that moves nothing: a blow after the end of the run, or a place without a
/// degree of freedom.
fn idle(scene: &Scene, index: usize, load: &Load) -> Option<String> {
    let (number, end) = (index + 1, scene.duration);
    if load.at.is_blind() {
        return Some(format!("load {number} acts on nothing: no degree of freedom moves its place"));
    }
    let LoadKind::Impulse { time, .. } = load.kind else { return None };
    (time > end).then(|| format!("the blow of load {number} at {time} s never comes: the run ends at {end} s"))
}

/// A note on a harmonic load whose phase suggests degrees.
fn turned(index: usize, load: &Load) -> Option<String> {
    let LoadKind::Harmonic { phase, .. } = load.kind else { return None };
    let number = index + 1;
    (phase.abs() > TAU * (1.0 + 1e-9)).then(|| {
        format!("the phase of load {number}, {phase} rad, is more than a turn: a phase in degrees is to be times π/180")
    })
}

/// A note on natural frequencies that suggest a wrong unit.
fn unusual(scene: &Scene) -> Option<String> {
    let slowest = slowest(scene)? / TAU;
    (!(USUAL[0]..=USUAL[1]).contains(&slowest)).then(|| {
        format!(
            "the slowest natural frequency is {} Hz, far from what structures between walls have: \
             are lengths in m, masses in kg, stiffnesses in N/m and moduli in Pa?",
            amount(slowest, 4)
        )
    })
}

/// A note on two rigid walls that leave a row no room. The rebounds between them at gaps above 0
/// take ever less time as the gap closes, and come to rest unless e is 1; at a gap of 0 there is no
/// sequence of impacts to follow.
fn clamped(scene: &Scene) -> Option<String> {
    let rigid =
        |side| scene.walls.iter().filter(move |wall| wall.law.is_rigid() && !wall.is_round() && wall.side() == side);
    let touch = scene.touching_distance();
    let closed =
        |upper: &Wall, lower: &Wall| upper.position() - lower.position() <= touch && upper.row() == lower.row();
    let (upper, lower) = rigid(Side::Upper)
        .find_map(|upper| rigid(Side::Lower).find(|lower| closed(upper, lower)).map(|lower| (upper, lower)))?;
    Some(format!(
        "walls {:?} and {:?} leave no room between them: the structure is held there, and how impulses divide between \
         the two differs from scheme to scheme. With a restitution of 0 at both their sum is that of the motion; with \
         another it may be none, and grow as the step shrinks",
        lower.name, upper.name
    ))
}

/// Most unstable modes that are named.
const MOST_UNSTABLE: usize = 5;

/// With these words modes that grow say so.
pub(crate) const NEGATIVE_DAMPING: &str = "a negative damping ratio";

/// A note on modes with negative damping, as a flow gives them.
pub(crate) fn unstable(scene: &Scene) -> Option<String> {
    let System::Structure(structure) = &scene.system else { return None };
    let modes = diagonal(structure)?;
    let (m, c) = (structure.mass.diagonal_entries(), structure.damping.diagonal_entries());
    let ratio = |((omega, _), (m, c)): (&(f64, f64), (&f64, &f64))| (*omega, 0.5 * c / (m * omega));
    let mut negative: Vec<(f64, f64)> =
        modes.iter().zip(m.iter().zip(&c)).map(ratio).filter(|(_, z)| *z < 0.0).collect();
    // In two planes a mode comes twice.
    negative.dedup();
    let named: Vec<String> =
        negative.iter().take(MOST_UNSTABLE).map(|(omega, z)| format!("{:.4} Hz ({z:.3e})", omega / TAU)).collect();
    let more = if negative.len() > MOST_UNSTABLE { ", .." } else { "" };
    let (modes, have) = if negative.len() == 1 { ("the mode of", "has") } else { ("the modes of", "have") };
    let are = if negative.len() == 1 { "is" } else { "are" };
    (!negative.is_empty()).then(|| {
        format!(
            "{modes} {}{more} {have} {NEGATIVE_DAMPING} and {are} unstable: without contact their motion grows, \
             and walls alone limit it",
            named.join(", ")
        )
    })
}

/// The smallest circular frequency above 0, rad/s.
fn slowest(scene: &Scene) -> Option<f64> {
    let all = match &scene.system {
        System::Structure(structure) => diagonal(structure),
        System::Oscillator(_) => None,
    };
    let slowest = match all {
        Some(modes) => modes.into_iter().map(|(omega, _)| omega).filter(|omega| *omega > 0.0).reduce(f64::min)?,
        None => scene.system.frequencies()[0],
    };
    (slowest > 0.0).then_some(slowest)
}

/// ω and k of each coordinate of a structure whose M and K are diagonal, as in modal coordinates.
fn diagonal(structure: &Structure) -> Option<Vec<(f64, f64)>> {
    let squares = structure.uncoupled_squares()?;
    Some(squares.into_iter().map(f64::sqrt).zip(structure.stiffness.diagonal_entries()).collect())
}

/// With this begins the note on a harmonic load that the step does not resolve.
pub(crate) const UNRESOLVED_LOAD: &str = "a period of load ";

/// True if the step does not resolve a load: half of it may miss the same, so that the change to
/// half the step says little.
#[cfg(feature = "cli")]
pub(crate) fn misses_a_load(scene: &Scene, scheme: &Scheme, step: f64) -> bool {
    !scheme.is_exact()
        && scene.loads.iter().enumerate().any(|(i, load)| load_resolved(scene, i, load, (scheme, step)).is_some())
}

/// A note on a load that changes faster than the step resolves.
fn load_resolved(scene: &Scene, index: usize, load: &Load, (scheme, step): (&Scheme, f64)) -> Option<String> {
    let number = index + 1;
    match &load.kind {
        LoadKind::Harmonic { amplitude, frequency, .. } => {
            let steps = 1.0 / (frequency.abs() * step);
            (*amplitude != 0.0 && steps < STEPS_A_PERIOD).then(|| {
                format!(
                    "{UNRESOLVED_LOAD}{number} ({frequency} Hz) takes {steps:.1} steps of {step:.2e} s: fewer \
                     than {STEPS_A_PERIOD} do not resolve it"
                )
            })
        }
        LoadKind::Table(table) => {
            let divided = if *scheme == Scheme::Located { table.steep_rows(step) } else { Vec::new() };
            let (missed, rows, at) = missed(table, (step, &divided), scene.duration)?;
            let passes = match rows > 1.0 {
                true => format!("skips rows of the table of load {number}, {} rows a step", amount(rows.round(), 6)),
                false => format!("passes over a change of the table of load {number} at {at} s"),
            };
            Some(format!(
                "a step of {step:.2e} s {passes}: between steps its force departs by up to {missed:.3e} N from the \
                 line through its values at the steps"
            ))
        }
        _ => None,
    }
}

/// The largest departure (N) of a table from the line through its values at the steps, the number
/// of its rows per step, and where that departure is (s); `None` where the departure is small. The
/// steps are `divided` at these rows.
fn missed(table: &Table, (step, divided): (f64, &[f64]), end: f64) -> Option<(f64, f64, f64)> {
    let (time, force) = (table.time(), table.force());
    let rows = step * (time.len() - 1) as f64 / (time.last()? - time.first()?);
    let (mut most, mut most_at) = (0.0_f64, 0.0);
    // The first and last row are jumps from and to 0, which no step resolves.
    let inner = time.iter().zip(force).take(time.len() - 1).skip(1);
    for (&t, &f) in inner.filter(|(t, _)| (0.0..=end).contains(*t) && !divided.contains(t)) {
        let before = (t / step).floor();
        let [a, b] =
            [before, before + 1.0].map(|n| (n * step).clamp(*time.first().unwrap_or(&t), *time.last().unwrap_or(&t)));
        let at =
            |x: f64| if x >= *time.last().unwrap_or(&x) { *force.last().unwrap_or(&0.0) } else { table.piece(x).0 };
        if b > a {
            let seen = at(a) + (at(b) - at(a)) * (t - a) / (b - a);
            if (f - seen).abs() > most {
                (most, most_at) = ((f - seen).abs(), t);
            }
        }
    }
    let limit = if rows > 1.0 { MISSED } else { PASSED };
    (most > limit * table.range()).then_some((most, rows, most_at))
}

/// A note on a mode that the step does not resolve: in modal coordinates the fastest that matters,
/// for coupled matrices the slowest.
fn modes_resolved(scene: &Scene, step: f64) -> Option<String> {
    let (omega, what) = match &scene.system {
        System::Oscillator(_) => (scene.system.frequencies()[0], "the natural frequency"),
        System::Structure(structure) => match diagonal(structure) {
            Some(modes) => {
                (fastest_that_matters(scene, &modes)?, "the fastest mode that a wall or load moves by 1 % or more")
            }
            None => (slowest(scene)?, "the slowest mode"),
        },
    };
    let steps = TAU / (omega.abs() * step);
    (steps < STEPS_A_PERIOD).then(|| {
        format!(
            "a period of {what}, {} Hz, takes {steps:.1} steps of {step:.2e} s: fewer than {STEPS_A_PERIOD} \
             do not resolve it",
            amount(omega / TAU, 5)
        )
    })
}

/// A note on walls that strike what the step does not resolve. `located` gives an impact the mass
/// of all modes there, 1/(g M⁻¹ gᵀ), and what it sets off in modes that the step does not resolve
/// goes on without settling: a step moves the structure as if M were M + ¼h²K.
fn struck_resolved(scene: &Scene, step: f64) -> Option<String> {
    let System::Structure(structure) = &scene.system else { return None };
    // The largest share that any mode adds; the frequency is an estimate from below.
    let resolved = 0.25 * (step * scene.system.frequencies()[1]).powi(2) <= 0.5 * HEAVIER;
    if resolved || scene.walls.iter().all(|wall| !wall.law.is_rigid()) {
        return None;
    }
    let all = scene.wall_masses();
    let mut stepped = (**structure).clone();
    stepped.mass = Symmetric::sum(&[(1.0, &structure.mass), (0.25 * step * step, &structure.stiffness)]);
    let seen = Scene { system: System::Structure(stepped.into()), ..scene.clone() }.wall_masses();
    // Nothing strikes what presses a slider.
    let walls = scene.walls.iter().enumerate().zip(all.iter().zip(&seen));
    let struck = walls.filter(|((index, wall), _)| wall.law.is_rigid() && !scene.is_slider(*index));
    let heavier = struck.filter(|(_, (all, seen))| all.is_finite() && **seen > (1.0 + HEAVIER) * **all);
    let ((_, wall), (all, seen)) = heavier.max_by(|a, b| (a.1.1 / a.1.0).total_cmp(&(b.1.1 / b.1.0)))?;
    Some(format!(
        "a step of {step:.2e} s does not resolve what the wall {:?} strikes: impacts are those of {} kg, the mass of \
         all modes there, and the step moves {} kg; the impulses depend on the step. A smaller step resolves these \
         modes, or moreau-jean, whose impacts are those of the step",
        wall.name,
        amount(*all, 3),
        amount(*seen, 3)
    ))
}

/// ω of the fastest of `modes` that contributes a relevant share of the static compliance at a wall
/// or load, rad/s; that of the slowest where there is neither.
fn fastest_that_matters(scene: &Scene, modes: &[(f64, f64)]) -> Option<f64> {
    let flats = scene.walls.iter().filter(|wall| !wall.is_round()).map(Wall::row);
    let holes = scene.holes().flat_map(|hole| [&hole.at.y, &hole.at.z]);
    let rows = flats.chain(holes).chain(scene.loads.iter().map(|load| &load.at));
    let fastest = |row: &Row| {
        let part = |&(i, weight): &(usize, f64)| {
            let (omega, k) = *modes.get(i)?;
            (k > 0.0).then_some((omega, weight * weight / k))
        };
        let parts: Vec<(f64, f64)> = row.entries().iter().filter_map(part).collect();
        let all: f64 = parts.iter().map(|part| part.1).sum();
        parts.into_iter().filter(|part| part.1 >= MATTERS * all && part.1 > 0.0).map(|part| part.0).reduce(f64::max)
    };
    let slowest = || modes.iter().map(|mode| mode.0).filter(|omega| *omega > 0.0).reduce(f64::min);
    rows.filter_map(fastest).reduce(f64::max).or_else(slowest)
}

/// The wall whose `ratio`, of its law and the mass (kg) that it feels, is the largest of those from
/// `limit` on: its name, with how many more there are, and its ratio.
fn unresolved(scene: &Scene, limit: f64, ratio: impl Fn(&WallLaw, f64) -> f64) -> Option<(String, f64)> {
    if scene.walls.iter().all(|wall| wall.law.is_rigid()) {
        return None;
    }
    let masses = scene.wall_masses();
    let all = scene.walls.iter().zip(&masses).map(|(wall, mass)| (wall, ratio(&wall.law, *mass)));
    let coarse: Vec<_> = all.filter(|(_, ratio)| *ratio >= limit).collect();
    let (wall, ratio) = coarse.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let others = match coarse.len() {
        1 => String::new(),
        n => format!(", and {} more", n - 1),
    };
    Some((format!("the wall {:?}{others}", wall.name), *ratio))
}

/// A note on dashpots of elastic walls that stop the body within a step.
fn dashpots_resolved(scene: &Scene, step: f64) -> Option<String> {
    let (wall, ratio) = unresolved(scene, 1.0, |law, mass| step * law.dashpot(0.0) / mass)?;
    Some(format!(
        "the step of {step:.2e} s does not resolve the dashpot of {wall}: h c/m = {ratio:.2e}, and it takes a \
         body's speed within {:.2e} s; the impulses there depend on the step instead of the wall's damping",
        step / ratio
    ))
}

/// A note on elastic walls that the step does not resolve. The springs that a penalty scheme puts
/// in place of rigid walls are left to the judge: some integrators need not resolve them.
fn walls_resolved(scene: &Scene, step: f64) -> Option<String> {
    let squared = |law: &WallLaw, mass: f64| step * step * law.stiffness().unwrap_or(0.0) / mass;
    let (wall, ratio) = unresolved(scene, RESOLVED, squared)?;
    let steps = PI / ratio.sqrt();
    Some(format!(
        "the step of {step:.2e} s does not resolve {wall}: h² k/m = {ratio:.2e}, and a contact of {:.2e} s takes \
         {steps:.1} steps; the contact forces there depend on the step instead of the wall's stiffness",
        steps * step
    ))
}
