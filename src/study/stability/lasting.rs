//! The effect of a scheme on the energy of a run, and on the force of a lasting contact.
//!
//! Lasting contacts show the known weakness of time stepping on a mesh: every touch stops the node
//! at the wall but not the elements behind it, and the force oscillates at the frequencies of the
//! mesh though the exact force is smooth, or constant as in the impact of a bar. The measure is the
//! ripple
//!
//! ρ = √(mean of (F − F̄)²) / F̄
//!
//! of the mean force F of each step over the inner four fifths of the contact, F̄ being its mean
//! there: 0 for a constant force; 1 for a force present in every other step. The first and the last
//! tenth are left out: they hold the rise and the fall, which take a step or two even without
//! oscillations.
//!
//! Pushes of one wall that follow one another within a thirty-second of the slowest period are one
//! contact, since an oscillating force may vanish in between.

use super::family::SchemeFamily;
use super::scale::Scale;
use crate::error::Result;
use crate::run::{Options, Run, run};
use crate::scene::Scene;
use crate::scheme::Scheme;
use crate::time::TimeOptions;
use rayon::prelude::*;

/// Share of a contact left out at each end.
const EDGE: f64 = 0.1;
/// Fewest steps of a contact whose ripple is measured.
const FEWEST: usize = 10;
/// Steps tried, as multiples of the case's own step.
pub const MULTIPLES: [f64; 3] = [4.0, 1.0, 0.25];

/// A lasting contact at one wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lasting {
    /// Start of its first push, s.
    pub start: f64,
    /// End of its last push, s.
    pub end: f64,
    /// Impulse over it, N s, as a magnitude.
    pub impulse: f64,
    /// Ripple ρ.
    pub ripple: f64,
}

/// The contact with the largest impulse among those of a wall that last more than ten steps; `None`
/// where there is no such contact. `impulse` holds the wall's impulse (N s) in each of equal steps
/// of `h` (s) from t = 0 on; pushes at most `joined` (s) apart belong to one contact.
///
/// ```
/// use signorini::study::stability::lasting::lasting;
///
/// let constant: Vec<f64> = (0..100).map(|i| if (20..80).contains(&i) { 0.5 } else { 0.0 }).collect();
/// let contact = lasting(&constant, 0.1, 0.5).unwrap();
/// assert!(contact.ripple < 1e-15 && (contact.start, contact.end) == (2.0, 8.0));
/// ```
#[must_use]
pub fn lasting(impulse: &[f64], h: f64, joined: f64) -> Option<Lasting> {
    let mut contacts: Vec<(usize, usize)> = Vec::new();
    for (i, _) in impulse.iter().enumerate().filter(|(_, p)| **p != 0.0) {
        match contacts.last_mut() {
            Some(last) if (i - last.1) as f64 * h <= joined => last.1 = i,
            _ => contacts.push((i, i)),
        }
    }
    let seen = contacts.into_iter().filter(|(first, last)| last - first >= FEWEST).filter_map(|(first, last)| {
        let all = impulse.get(first..=last)?;
        let edge = (EDGE * all.len() as f64).ceil() as usize;
        let inner = all.get(edge..all.len() - edge)?;
        let mean = inner.iter().sum::<f64>() / inner.len() as f64;
        let square = inner.iter().map(|p| (p - mean) * (p - mean)).sum::<f64>() / inner.len() as f64;
        Some(Lasting {
            start: first as f64 * h,
            end: (last + 1) as f64 * h,
            impulse: all.iter().sum::<f64>().abs(),
            ripple: square.sqrt() / mean.abs(),
        })
    });
    seen.max_by(|a, b| a.impulse.total_cmp(&b.impulse))
}

/// One run: one scheme with one step.
#[derive(Debug, Clone)]
pub struct LastingForce {
    /// The scheme.
    pub scheme: Scheme,
    /// Its name: of a penalty in a scene without rigid walls, which it would replace, that of its
    /// integrator.
    pub name: String,
    /// Its step, s; for the exact scheme, the spacing of its rows.
    pub step: f64,
    /// The measurements, or why there are none.
    pub outcome: Result<Seen>,
}

/// Energies as shares of the reference energy of [`Quality`], and the contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// Largest energy of the run.
    pub largest: f64,
    /// Energy at its end.
    pub last: f64,
    /// Energy taken by the walls; negative where the scheme produced energy there.
    pub lost_at_walls: f64,
    /// Energy change that no load, damping or wall accounts for.
    pub unexplained: f64,
    /// The largest lasting contact, and the name of its wall.
    pub contact: Option<(String, Lasting)>,
}

/// The effect of every scheme on the energy and the lasting contact of a case.
#[derive(Debug, Clone)]
pub struct Quality {
    /// Reference energy, J: the largest energy of the exact run, or of moreau-jean with the finest
    /// step where the exact scheme cannot follow the case.
    pub energy: f64,
    /// The runs, scheme by scheme, coarse steps first.
    pub lines: Vec<LastingForce>,
}

impl Quality {
    /// Runs `schemes` on `scene` with [`MULTIPLES`] of the step of `time`, in parallel; a run that
    /// fails is a line with the reason. `scale` gives the slowest period.
    ///
    /// # Errors
    /// Errors of the reference run.
    pub fn of(scene: &Scene, schemes: &[Scheme], time: &TimeOptions, scale: &Scale) -> Result<Self> {
        let joined = scale.joined();
        let go = |scheme: Scheme, step: f64| {
            let time = TimeOptions { sample: Some(step), ..TimeOptions::with_step(step) };
            run(scene, &scheme, &Options::new(time)).and_then(Run::unrefuted)
        };
        let finest = MULTIPLES.iter().copied().fold(1.0, f64::min) * time.step;
        let exact = crate::study::exact::affordable(scene).and_then(|()| go(Scheme::Event, finest));
        let energy = match &exact {
            Ok(run) => run.residuals.energy.largest_j,
            Err(_) => go(Scheme::MoreauJean { theta: 0.5 }, finest)?.residuals.energy.largest_j,
        };
        let jobs: Vec<(Scheme, f64)> =
            schemes.iter().flat_map(|&s| MULTIPLES.iter().map(move |m| (s, m * time.step))).collect();
        let rigid = scene.walls.iter().any(|wall| wall.law.is_rigid());
        let name = |scheme: Scheme| match scheme {
            Scheme::Penalty { integrator, .. } if !rigid => SchemeFamily::Penalty(integrator).to_string(),
            _ => scheme.to_string(),
        };
        let line = |&(scheme, step): &(Scheme, f64)| {
            let run = go(scheme, step);
            let step = run.as_ref().map_or(step, |run| run.grid.step);
            LastingForce { scheme, name: name(scheme), step, outcome: run.map(|run| seen(&run, step, joined, energy)) }
        };
        let mut lines: Vec<LastingForce> = jobs.par_iter().map(line).collect();
        let outcome = exact.map(|run| seen(&run, run.grid.row_spacing(), joined, energy));
        lines.push(LastingForce { scheme: Scheme::Event, name: name(Scheme::Event), step: finest, outcome });
        Ok(Self { energy, lines })
    }
}

fn seen(run: &Run, spacing: f64, joined: f64, energy: f64) -> Seen {
    let e = &run.residuals.energy;
    let share = |x: f64| if energy > 0.0 { x / energy } else { 0.0 };
    let walls = run.trajectory.walls().iter().zip(run.trajectory.contact_impulses());
    // Row 0 is the start.
    let contacts = walls.filter_map(|(name, rows)| Some((name.clone(), lasting(rows.get(1..)?, spacing, joined)?)));
    Seen {
        largest: share(e.largest_j),
        last: share(e.final_j),
        lost_at_walls: share(e.impact_loss_j + e.wall_damping_j),
        unexplained: share(e.residual_j),
        contact: contacts.max_by(|a, b| a.1.impulse.total_cmp(&b.1.impulse)),
    }
}
