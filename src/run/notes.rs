//! What a reader must know about a run: sentences, drawn from its residuals and counters.

mod approach;
#[cfg(feature = "cli")]
mod resting;
mod setup;
mod unsettled;

#[cfg(feature = "cli")]
pub(crate) use approach::NO_CONTACT;
#[cfg(feature = "cli")]
pub(crate) use resting::resting;
pub(crate) use setup::setup;
#[cfg(feature = "cli")]
pub(crate) use setup::{NEGATIVE_DAMPING, UNRESOLVED_LOAD, misses_a_load, unstable};
pub(crate) use unsettled::unsettled;

use super::finished::Run;
use super::judging::Judging;
use super::recording::Recording;
use crate::error::counted;
use crate::residual::Energy;
use crate::scene::{Checked, Scene};
use crate::scheme::{Counters, Realised, Scheme};
use crate::statistics::WearStatistics;
use crate::step::Contact;

/// A residual of the energy ledger above this share of the energy exchanged gets a note, and so do
/// impacts that return this much more energy than arrived at them. (Paoli & Schatzman's scheme
/// returns 0.1 % more in the source scene at h = 1 ms, Newmark's several times more.)
const WORTH_SAYING: f64 = 1e-2;

/// Energy created at walls is rounding below this share of the energy exchanged, however little
/// arrived there.
const ROUNDING: f64 = 1e-9;

/// Energy created at walls also gets a note above this share of the largest energy. The share of
/// what arrived is no measure there: once a body crosses the gap within a step, newmark throws it
/// back and forth without further gain, and little of all that arrives is new. Creating more than
/// the start and the loads ever supplied gets a note in any case.
const SHARE_OF_LARGEST: f64 = 0.1;

/// The normal of a round hole may turn by this angle in a step, rad: the midpoint rule on the
/// circle then has an error of some per cent.
const LARGE_TURN: f64 = 0.2;

/// A contact of fewer steps is not resolved: that of a linear wall takes so many where h² k/m is
/// the limit of its note.
const FEW_STEPS: f64 = 10.0;

/// Maximum number of handed-over stretches with a note each.
const MOST_HANDED: usize = 5;

/// How steps and rows were fitted to the end of the run, and whether there was a contact: what the
/// results are, and not how far they hold.
pub(crate) fn remarks<J: Judging, R: Recording>(scene: &Checked, run: &Run<J, R>) -> Vec<String> {
    let mut notes = Vec::new();
    if run.grid.shortened {
        notes.push(format!(
            "the step was shortened to {:e} s so that steps end on the rows and at the end",
            run.grid.step
        ));
    }
    if run.grid.rows_shortened {
        let spacing = run.grid.row_spacing();
        notes.push(format!("the rows are {spacing:e} s apart, closer than asked for, so that the last is at the end"));
    }
    notes.extend(run.recorded().and_then(|trajectory| approach::untouched(scene, trajectory)));
    notes.extend(run.recorded().into_iter().flat_map(|trajectory| approach::untouched_supports(scene, trajectory)));
    notes.extend(run.recorded().and_then(|_| late_output(scene)));
    notes.extend(run.recorded().filter(|_| scene.probes.is_empty()).map(|_| {
        "the scene has no probe: no displacement or velocity is recorded, only contacts and forces of walls".to_owned()
    }));
    notes
}

/// Output times that the run does not reach.
pub(crate) fn late_output(scene: &Scene) -> Option<String> {
    let (times, end) = (&scene.output_times, scene.duration);
    let late = times.len() - scene.reached_output_times().len();
    (late > 0)
        .then(|| format!("{late} of {} output times lie after the end, {end:?} s: they are left out", times.len()))
}

/// What limits the use of a run of `scene` by `scheme` in steps of `step` seconds, as far as it is
/// known before it runs.
#[must_use]
pub fn foreseen(scene: &Scene, scheme: &Scheme, step: f64) -> Vec<String> {
    of_restitution(scene, scheme).into_iter().chain(setup(scene, scheme, step, true)).collect()
}

/// What limits the use of a run of which no motion was recorded; `energy` is known where it was
/// judged.
#[cfg(feature = "cli")]
pub(crate) fn unrecorded(
    scene: &Scene,
    scheme: &Scheme,
    step: f64,
    energy: Option<&Energy>,
    counters: &Counters,
) -> Vec<String> {
    let mut notes: Vec<String> = of_restitution(scene, scheme).into_iter().collect();
    notes.extend(energy.and_then(|energy| of_energy(energy, None)));
    notes.extend(of_counters(scheme, counters));
    notes.extend(setup(scene, scheme, step, true));
    notes
}

/// A note on walls whose restitution `scheme` does not realise.
fn of_restitution(scene: &Scene, scheme: &Scheme) -> Option<String> {
    let asked: Vec<f64> = scene.walls.iter().filter_map(|wall| wall.law.restitution()).collect();
    let name = scheme.entry().name;
    match scheme.entry().restitution {
        Realised::ByChance if !asked.is_empty() => Some(format!(
            "{name} is for demonstration: its restitution is between 1/3 and 3, depending on the phase of each impact, \
             and what the load does in the step of a slow one comes on top"
        )),
        Realised::Zero if asked.iter().any(|&e| e > 0.0) => {
            Some(format!("{name} realises e = 0, not the walls' own restitution"))
        }
        Realised::BySprings if scheme.is_lossless() && asked.iter().any(|&e| e < 1.0) => {
            Some("a penalty spring without damping realises e = 1, not the walls' own restitution".into())
        }
        _ => None,
    }
}

/// What limits the use of the results; `averaging` is the stretch (s) that was asked for, and that
/// over which forces of rigid walls are averaged.
pub(crate) fn cautions<J: Judging, R: Recording>(scene: &Checked, run: &Run<J, R>, averaging: [f64; 2]) -> Vec<String> {
    let mut notes: Vec<String> = of_restitution(scene, &run.scheme).into_iter().collect();
    if let Some(residuals) = run.judged() {
        notes.extend(of_energy(&residuals.energy, run.recorded().map(|t| arrived(scene, t.contacts()))));
    }
    if let (Scheme::MoreauJean { .. }, Some(trajectory)) = (run.scheme, run.recorded()) {
        notes.extend(trajectory.contacts().iter().filter_map(|contact| standing(scene, contact, &run.state.q)));
    }
    notes.extend(run.recorded().and_then(|trajectory| strongest(scene, trajectory.contacts(), run.grid.step)));
    for handed in run.handed.iter().take(MOST_HANDED) {
        notes.push(format!(
            "from {:.6} s to {:.6} s impacts follow one another faster than the exact scheme resolves: \
             moreau-jean stepped through it, with steps of {:.1e} s",
            handed.from, handed.to, handed.step
        ));
    }
    if let Some(more) = run.handed.len().checked_sub(MOST_HANDED).filter(|&more| more > 0) {
        notes.push(format!(
            "moreau-jean stepped through {more} more such stretches, {} steps in all",
            run.counters.handed_steps
        ));
    }
    notes.extend(of_counters(&run.scheme, &run.counters));
    let wear = R::statistics(&run.statistics).map_or(&[][..], |statistics| &statistics.wear);
    notes.extend(driving_friction(scene, wear));
    let touched = run.recorded().is_none_or(|trajectory| !trajectory.contacts().is_empty());
    notes.extend(setup(scene, &run.scheme, run.grid.step, touched));
    notes.extend(averaged_over_steps(scene, run, averaging));
    notes
}

/// That forces of rigid walls are averaged over the steps of a scheme that spreads impulses over
/// them, where these are longer than the stretch `asked` for, s.
fn averaged_over_steps<J: Judging, R: Recording>(
    scene: &Scene,
    run: &Run<J, R>,
    [asked, by]: [f64; 2],
) -> Option<String> {
    let statistics = R::statistics(&run.statistics)?;
    if by <= (1.0 + ROUNDING) * asked || matches!(run.scheme, Scheme::Penalty { .. }) {
        return None;
    }
    let mut walls = scene.walls.iter().zip(&statistics.walls);
    let struck = walls.any(|(wall, statistics)| wall.law.is_rigid() && statistics.contacts > 0);
    struck.then(|| {
        format!(
            "RMS and largest forces at rigid walls are means over the step, {by:e} s, and not over {asked:e} s \
             (--force-averaging): {} knows an impulse no better than its step, and both grow as the step falls; \
             use a smaller step, or located",
            run.scheme.entry().name
        )
    })
}

/// Notes on the counters of steps, of round holes and of friction.
fn of_counters(scheme: &Scheme, counters: &Counters) -> Vec<String> {
    let mut notes = Vec::new();
    let steps = |count: u64| counted(count as usize, "step");
    if counters.steps_given_up > 0 {
        notes.push(format!(
            "in {} impacts follow one another too fast for {}: the rest of each was made \
             without rebound; use a smaller step",
            steps(counters.steps_given_up),
            scheme.entry().name
        ));
    }
    if counters.frozen_steps > 0 {
        notes.push(format!(
            "in {} opposite walls pushed in turn: the body crosses the gap in less than a step and stands \
             still in the result; use a smaller step",
            steps(counters.frozen_steps)
        ));
    }
    let turn = counters.largest_turn_rad;
    if turn > LARGE_TURN {
        notes.push(format!(
            "in a step that touched a round hole its normal turned by {turn:.2} rad: the step is too large for the \
             speed along the hole, and forces there are wrong by about {:.0} %; use a smaller step",
            100.0 * turn * turn / 3.0
        ));
    }
    if counters.wedged_steps > 0 {
        notes.push(format!(
            "in {} no impulses of contacts with friction give the rebounds that their restitution demands (a \
             body is wedged), or only impulses that add energy: these contacts took a restitution of 0 there",
            steps(counters.wedged_steps)
        ));
    }
    if counters.qp_unsettled > 0 {
        notes.push(format!(
            "in {} rounding left the contacts without a common state of sticking and slipping: trust this run \
             only if the judge finds nothing",
            steps(counters.qp_unsettled)
        ));
    }
    notes
}

/// A note on supports whose friction adds energy to the motion in the mean.
fn driving_friction<'a>(scene: &'a Scene, wear: &'a [WearStatistics]) -> impl Iterator<Item = String> + 'a {
    scene.supports.iter().zip(wear).filter_map(|(support, wear)| {
        let added = -wear.friction_power_w;
        let size = support.friction(&scene.walls).sliding * wear.work_rate_w;
        (added > WORTH_SAYING * size).then(|| {
            format!(
                "friction at the support {:?} adds {added:.3e} W to the motion: where several of its flats are struck \
                 at once their rebounds drive the sliding, and the work rate there is too large; a smaller \
                 restitution or elastic flats tell by how much",
                support.name
            )
        })
    })
}

/// A note on a lasting contact that is open at the end of the run, if the structure then stands
/// behind its wall; `q` is its displacement.
fn standing(scene: &Scene, contact: &Contact, q: &[f64]) -> Option<String> {
    let wall = scene.walls.get(contact.wall).filter(|wall| wall.law.is_rigid())?;
    let depth = -wall.gap(wall.row().dot(q));
    let lasts = contact.end.is_none() && contact.peak_force.is_some();
    (lasts && depth > WORTH_SAYING * scene.gap_scale()).then(|| {
        format!(
            "at the end the body rests {depth:.2e} m behind wall {:?}, where its last impact left it: \
             moreau-jean does not push it back to the face, and the force has an error of the stiffness times \
             that depth; use a smaller step, or located, which rests on the face",
            wall.name
        )
    })
}

/// A note on walls whose stiffness grows with the depth, where the strongest contact takes few
/// steps: how stiff such walls are is known of the run only.
fn strongest(scene: &Scene, contacts: &[Contact], step: f64) -> Option<String> {
    let wall = |contact: &Contact| scene.walls.get(contact.wall).filter(|wall| !wall.law.is_linear());
    let ended = contacts.iter().filter_map(|contact| Some((contact, wall(contact)?, contact.end?)));
    let (contact, wall, end) = ended.max_by(|a, b| a.0.impulse.abs().total_cmp(&b.0.impulse.abs()))?;
    let steps = (end - contact.start) / step;
    (steps < FEW_STEPS).then(|| {
        format!(
            "the step of {step:.2e} s does not resolve the wall {:?}: its strongest contact, of {:.2e} s, takes \
             {steps:.1} steps; the contact forces there depend on the step instead of the wall's stiffness",
            wall.name,
            end - contact.start
        )
    })
}

/// A note on energy that the scheme created or lost; `arrived` is the energy (J) that arrived at
/// its rigid walls, where it is known.
fn of_energy(energy: &Energy, arrived: Option<f64>) -> Option<String> {
    let created = -energy.impact_loss_j;
    let given = energy.initial_j + energy.load_work_j.abs();
    let beyond = arrived.is_some_and(|arrived| created > WORTH_SAYING * arrived);
    let much = beyond || created > SHARE_OF_LARGEST * energy.largest_j || created > given;
    if much && created > ROUNDING * energy.exchanged_j {
        let arrived = arrived.map_or_else(String::new, |a| format!(", beyond the {a:.3e} J that arrived there"));
        return Some(format!(
            "the scheme created {created:.3e} J at the rigid walls{arrived} (largest energy of the run {:.3e} \
             J): do not trust this run",
            energy.largest_j
        ));
    }
    (energy.residual > WORTH_SAYING).then(|| {
        let verb = if energy.residual_j > 0.0 { "created" } else { "lost" };
        format!(
            "the scheme {verb} {:.3e} J that no load, damping or wall accounts for, {:.1} % of the energy \
             exchanged (largest energy of the run {:.3e} J): the step is too large for it, do not trust this run",
            energy.residual_j.abs(),
            100.0 * energy.residual,
            energy.largest_j
        )
    })
}

/// Kinetic energy that arrived at rigid walls, J, by the speeds before each contact.
fn arrived(scene: &Checked, contacts: &[Contact]) -> f64 {
    let masses = scene.wall_masses();
    let mass = |wall: usize| masses.get(wall).copied().unwrap_or(0.0);
    let rigid = |wall: usize| scene.walls.get(wall).is_some_and(|wall| wall.law.is_rigid());
    let contacts = contacts.iter().filter(|c| rigid(c.wall));
    contacts.map(|c| 0.5 * mass(c.wall) * c.approach_speed * c.approach_speed).sum()
}
