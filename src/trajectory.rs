//! The recorded motion: columns over time, and the contacts.

mod worn;

pub use worn::ContactWear;

use crate::error::{Error, Result};
use crate::flow::Series;
use crate::scene::{Row, Scene};
use crate::step::{Contact, Path, Step};
use serde::{Deserialize, Serialize};
use worn::Worn;

/// A motion sampled at given times; the contact impulses between the samples are recorded in full.
///
/// Row 0 is the start, after any impulse at t = 0; the last row is exactly the end. States are
/// right-continuous. For a scheme on a grid, the force in a row is that of the step which ends
/// there; for the exact scheme it is the force at that instant.
///
/// ```
/// use signorini::{Load, Options, Scene, Scheme, Wall, run};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.5))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let options = Options::with_step(1e-4).with_sample(1e-2); // a row every 10 ms
/// let trajectory = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &options)?.trajectory;
///
/// assert_eq!(trajectory.time().len(), 101); // s, from 0 to 1
/// let highest = trajectory.displacement().iter().fold(0.0, |a: f64, &b| a.max(b)); // m
/// assert!(highest < 5.1e-3);
/// // Nothing that happens between two rows is lost: impulses (N s) are those since the row before.
/// let impulses: f64 = trajectory.contact_impulse("stop")?.iter().sum();
/// let contacts: f64 = trajectory.contacts().iter().map(|contact| contact.impulse).sum();
/// assert!((impulses - contacts).abs() < 1e-12 && impulses < 0.0);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Columns")]
pub struct Trajectory {
    walls: Vec<String>,
    probes: Vec<String>,
    time: Vec<f64>,
    displacement: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
    force: Vec<Vec<f64>>,
    impulse: Vec<Vec<f64>>,
    #[serde(default)]
    holes: Vec<String>,
    #[serde(default)]
    hole_force: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    hole_impulse: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    friction: Vec<Vec<f64>>,
    #[serde(default)]
    supports: Vec<String>,
    #[serde(default)]
    wear_work: Vec<Vec<f64>>,
    contacts: Vec<Contact>,
    #[serde(default)]
    contact_wear: Vec<Option<ContactWear>>,
}

/// A trajectory as it was written down, perhaps by another program.
#[derive(Deserialize)]
struct Columns {
    walls: Vec<String>,
    probes: Vec<String>,
    time: Vec<f64>,
    displacement: Vec<Vec<f64>>,
    velocity: Vec<Vec<f64>>,
    force: Vec<Vec<f64>>,
    impulse: Vec<Vec<f64>>,
    #[serde(default)]
    holes: Vec<String>,
    #[serde(default)]
    hole_force: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    hole_impulse: Vec<[Vec<f64>; 2]>,
    #[serde(default)]
    friction: Vec<Vec<f64>>,
    #[serde(default)]
    supports: Vec<String>,
    #[serde(default)]
    wear_work: Vec<Vec<f64>>,
    contacts: Vec<Contact>,
    #[serde(default)]
    contact_wear: Vec<Option<ContactWear>>,
}

impl TryFrom<Columns> for Trajectory {
    type Error = &'static str;

    fn try_from(columns: Columns) -> std::result::Result<Self, Self::Error> {
        let Columns { walls, probes, time, displacement, velocity, force, impulse, .. } = columns;
        let Columns { holes, hole_force, hole_impulse, friction, contacts, .. } = columns;
        let Columns { supports, wear_work, contact_wear, .. } = columns;
        let fit = |names: &[String], columns: [&Vec<Vec<f64>>; 2]| {
            let mut all = columns.iter().flat_map(|columns| columns.iter());
            columns.iter().all(|columns| columns.len() == names.len()) && all.all(|column| column.len() == time.len())
        };
        let mut sound = fit(&probes, [&displacement, &velocity]) && fit(&walls, [&force, &impulse]);
        sound &= friction.is_empty() || fit(&walls, [&friction, &impulse]);
        sound &= fit(&supports, [&wear_work, &wear_work]);
        sound &= contact_wear.is_empty() || contact_wear.len() == contacts.len();
        for columns in [&hole_force, &hole_impulse] {
            sound &= columns.len() == holes.len() && columns.iter().flatten().all(|column| column.len() == time.len());
        }
        match sound && contacts.iter().all(|contact| contact.wall < walls.len() + holes.len()) {
            true => Ok(Self {
                walls,
                probes,
                time,
                displacement,
                velocity,
                force,
                impulse,
                holes,
                hole_force,
                hole_impulse,
                friction,
                supports,
                wear_work,
                contacts,
                contact_wear,
            }),
            false => Err("a column for each wall, hole and probe, all of one length, and contacts at these"),
        }
    }
}

impl Trajectory {
    /// Times of the rows, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Names of the walls, in the scene's order.
    #[must_use]
    pub fn walls(&self) -> &[String] {
        &self.walls
    }

    /// Names of the probes; a single empty name for an oscillator.
    #[must_use]
    pub fn probes(&self) -> &[String] {
        &self.probes
    }

    /// Displacement of the first probe at each row, m.
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        self.displacement.first().map_or(&[], Vec::as_slice)
    }

    /// Velocity of the first probe at each row, m/s.
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        self.velocity.first().map_or(&[], Vec::as_slice)
    }

    /// Displacement at each row, m: one column per probe, in the scene's order.
    #[must_use]
    pub fn displacements(&self) -> &[Vec<f64>] {
        &self.displacement
    }

    /// Velocity at each row, m/s: one column per probe, in the scene's order.
    #[must_use]
    pub fn velocities(&self) -> &[Vec<f64>] {
        &self.velocity
    }

    /// Force of each wall on the body at each row, N: one column per wall, in the scene's order.
    #[must_use]
    pub fn contact_forces(&self) -> &[Vec<f64>] {
        &self.force
    }

    /// Impulse of each wall on the body since the previous row, N s: one column per wall, in the
    /// scene's order.
    #[must_use]
    pub fn contact_impulses(&self) -> &[Vec<f64>] {
        &self.impulse
    }

    /// Names of the round supports, in the scene's order.
    #[must_use]
    pub fn holes(&self) -> &[String] {
        &self.holes
    }

    /// Force of each round support on the body at each row along y and z, normal and friction
    /// together, N: two columns per round support, in the scene's order.
    #[must_use]
    pub fn hole_forces(&self) -> &[[Vec<f64>; 2]] {
        &self.hole_force
    }

    /// Impulse of each round support on the body since the previous row along y and z, normal and
    /// friction together, N s: two columns per round support, in the scene's order.
    #[must_use]
    pub fn hole_impulses(&self) -> &[[Vec<f64>; 2]] {
        &self.hole_impulse
    }

    /// Friction impulse at each wall since the previous row, N s, along (−n_z, n_y) with n the
    /// outward normal of the flat: one column per wall, in the scene's order; none in scenes without
    /// round supports and friction.
    #[must_use]
    pub fn friction_impulses(&self) -> &[Vec<f64>] {
        &self.friction
    }

    /// Names of the supports, in the scene's order.
    #[must_use]
    pub fn supports(&self) -> &[String] {
        &self.supports
    }

    /// Work of wear of each support from the start to each row, J: one column per support, in the
    /// scene's order.
    #[must_use]
    pub fn wear_work(&self) -> &[Vec<f64>] {
        &self.wear_work
    }

    /// What each of the contacts wore; `None` at walls that belong to no support. Empty in scenes
    /// without supports.
    #[must_use]
    pub fn contact_wear(&self) -> &[Option<ContactWear>] {
        &self.contact_wear
    }

    /// Displacement (m) and velocity (m/s) of the probe of that name at each row.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the probes there are.
    pub fn probe(&self, name: &str) -> Result<(&[f64], &[f64])> {
        let index = find("probe", name, &self.probes)?;
        Ok((&self.displacement[index], &self.velocity[index]))
    }

    /// Force of a wall on the body at each row, N: ≥ 0 for a lower wall, ≤ 0 for an upper one.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn contact_force(&self, wall: &str) -> Result<&[f64]> {
        Ok(&self.force[find("wall", wall, &self.walls)?])
    }

    /// Impulse of a wall on the body since the previous row, N s; signed as the force.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn contact_impulse(&self, wall: &str) -> Result<&[f64]> {
        Ok(&self.impulse[find("wall", wall, &self.walls)?])
    }

    /// Impulse of a wall on the body over the whole run, N s; signed as the force.
    ///
    /// # Errors
    /// [`Error::Unknown`], listing the walls there are.
    pub fn impulse(&self, wall: &str) -> Result<f64> {
        Ok(self.contact_impulse(wall)?.iter().sum())
    }

    /// The contact episodes, in the order in which they began.
    #[must_use]
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }
}

impl Trajectory {
    /// Takes the last `count` probes out of the trajectory: the displacement (m) of each.
    #[cfg(feature = "cli")]
    pub(crate) fn take_last_probes(&mut self, count: usize) -> Vec<Vec<f64>> {
        let kept = self.probes.len().saturating_sub(count);
        self.probes.truncate(kept);
        self.velocity.truncate(kept);
        self.displacement.split_off(kept)
    }
}

fn find(kind: &'static str, name: &str, known: &[String]) -> Result<usize> {
    let missing = || Error::Unknown { kind, name: name.to_owned(), known: known.to_vec() };
    known.iter().position(|k| k == name).ok_or_else(missing)
}

/// What round supports and friction did since the last row; all empty in scenes without.
#[derive(Debug, Clone)]
struct Rubbed {
    /// Impulse of each round support along y and z, and friction of each wall, N s.
    holes: Vec<[f64; 2]>,
    friction: Vec<f64>,
    /// Force of each round support in the last step, N.
    force: Vec<[f64; 2]>,
}

/// Builds a [`Trajectory`] from the steps of a run, at the requested rows.
#[derive(Debug, Clone)]
pub struct Recorder {
    trajectory: Trajectory,
    probes: Vec<Row>,
    end: f64,
    rows: u64,
    /// Rows per second, and the time of the next row, s.
    rate: f64,
    due: f64,
    /// Impulse per wall since the last row, N s.
    pending: Vec<f64>,
    partial: Vec<f64>,
    /// Impulse of each round support along y and z and friction of each wall since the last row, N
    /// s.
    rubbed: Rubbed,
    worn: Worn,
    /// Displacement and velocity at a row, n entries each.
    state: [Vec<f64>; 2],
}

impl Rubbed {
    /// Adds the impulses of the holes over a piece of a stretch of exact motion (s), and sets their
    /// forces to those at its end.
    #[inline(never)]
    fn follow(&mut self, series: &Series, [from, to]: [f64; 2]) {
        for (hole, (sum, force)) in self.holes.iter_mut().zip(&mut self.force).enumerate() {
            let push = series.hole_impulse(hole, from, to);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
            *force = series.hole_force(hole, to);
        }
    }

    /// Adds the impulses of the holes at the instant that ends a step of exact motion.
    #[inline(never)]
    fn jump(&mut self, step: &Step<'_>) {
        for (sum, hole) in self.holes.iter_mut().zip(step.holes) {
            let push = hole.normal.map(|n| -hole.jump * n);
            *sum = [sum[0] + push[0], sum[1] + push[1]];
        }
    }

    /// Adds one step on a grid.
    #[inline(never)]
    fn see(&mut self, step: &Step<'_>) {
        let h = step.end - step.start;
        for (sum, f) in self.friction.iter_mut().zip(step.friction) {
            *sum += f;
        }
        for ((sum, force), hole) in self.holes.iter_mut().zip(&mut self.force).zip(step.holes) {
            let push = hole.push();
            *sum = [sum[0] + push[0], sum[1] + push[1]];
            *force = push.map(|push| push / h);
        }
    }
}

impl Recorder {
    /// A recorder of `rows` equal intervals over the scene's duration, starting from the state `q`
    /// (m), `v` (m/s).
    #[must_use]
    pub fn new(scene: &Scene, rows: u64, q: &[f64], v: &[f64]) -> Self {
        let capacity = usize::try_from(rows).unwrap_or(0).saturating_add(1).min(1 << 24);
        let column = || Vec::with_capacity(capacity);
        let (n, m) = (scene.system.degrees_of_freedom(), scene.walls.len());
        let columns = |count: usize| (0..count).map(|_| column()).collect::<Vec<_>>();
        let holes: Vec<String> = scene.holes().map(|hole| hole.support.name.clone()).collect();
        let rubbed = if scene.turns_or_rubs() { m } else { 0 };
        let mut recorder = Self {
            trajectory: Trajectory {
                walls: scene.walls.iter().map(|w| w.name.clone()).collect(),
                probes: scene.probes.iter().map(|p| p.name.clone()).collect(),
                time: column(),
                displacement: columns(scene.probes.len()),
                velocity: columns(scene.probes.len()),
                force: columns(m),
                impulse: columns(m),
                hole_force: holes.iter().map(|_| [column(), column()]).collect(),
                hole_impulse: holes.iter().map(|_| [column(), column()]).collect(),
                friction: columns(rubbed),
                holes: holes.clone(),
                supports: scene.supports.iter().map(|support| support.name.clone()).collect(),
                wear_work: columns(scene.supports.len()),
                contacts: Vec::new(),
                contact_wear: Vec::new(),
            },
            worn: Worn::new(scene),
            probes: scene.probes.iter().map(|p| p.at.clone()).collect(),
            end: scene.duration,
            rows,
            rate: rows as f64 / scene.duration,
            due: 0.0,
            pending: vec![0.0; m],
            partial: vec![0.0; m],
            rubbed: Rubbed {
                force: vec![[0.0; 2]; holes.len()],
                holes: vec![[0.0; 2]; holes.len()],
                friction: vec![0.0; rubbed],
            },
            state: [vec![0.0; n], vec![0.0; n]],
        };
        let force: Vec<f64> = scene.walls.iter().map(|w| w.law_force(w.at.dot(q), w.at.dot(v))).collect();
        recorder.push(0.0, q, v, &force);
        recorder
    }

    /// Time of row `k`, s; the last is the end itself. The rate is often a whole number (1 ms: 1000
    /// per second), and dividing by it gives the double nearest to the decimal.
    fn row_time(&self, k: u64) -> f64 {
        if k >= self.rows { self.end } else { k as f64 / self.rate }
    }

    /// Adds one step. Steps must come in order. Steps after the last row are ignored, and so are
    /// steps of another scene, with another number of walls or degrees of freedom.
    pub fn see(&mut self, step: &Step<'_>) {
        let (n, m) = (self.state[0].len(), self.pending.len());
        let moved = [step.q, step.v, step.velocity_before];
        let pushed = [step.impulse, step.jump, step.force];
        if moved.iter().any(|x| x.len() != n) || pushed.iter().any(|x| x.len() != m) {
            return;
        }
        let known = &mut self.rubbed;
        if step.holes.len() != known.holes.len() || step.friction.len() != known.friction.len() {
            return;
        }
        if self.trajectory.time.len() as u64 > self.rows {
            return;
        }
        if !matches!(step.path, Path::Series(_)) && (!step.friction.is_empty() || !step.holes.is_empty()) {
            known.see(step);
        }
        self.trajectory.contacts.extend_from_slice(step.closed);
        match step.path {
            Path::Grid | Path::OneRestitution => {
                self.wear(step);
                for (sum, p) in self.pending.iter_mut().zip(step.impulse) {
                    *sum += p;
                }
                // The grid divides the spacing of the rows, so a row's time and a step's end differ
                // by rounding only.
                let due = self.due;
                if step.end > due - 0.5 * (step.end - step.start) {
                    self.push(due, step.q, step.v, step.force);
                }
            }
            Path::Exact(_) | Path::Series(_) => self.see_exact(step),
            Path::Handed { .. } => self.see_handed(step),
        }
    }

    /// Adds what slid in a step whose motion is known at its ends only.
    fn wear(&mut self, step: &Step<'_>) {
        if !self.worn.is_empty() {
            // On a grid a contact ends with the first step in which it does not push.
            let Self { worn, trajectory, .. } = self;
            worn.close(step.closed, |wear| trajectory.contact_wear.push(wear));
            worn.add(step, [step.start, step.end]);
        }
    }

    /// Adds what slid at the end of a step of exact motion, from `from` (s) on, and its contacts.
    fn wear_exactly(&mut self, step: &Step<'_>, from: f64) {
        if !self.worn.is_empty() {
            let Self { worn, trajectory, .. } = self;
            worn.add(step, [from, step.end]);
            worn.close(step.closed, |wear| trajectory.contact_wear.push(wear));
        }
    }

    /// Adds a step whose ends need not fall on rows: between them the displacement is interpolated
    /// linearly.
    fn see_handed(&mut self, step: &Step<'_>) {
        self.wear(step);
        for (sum, p) in self.pending.iter_mut().zip(step.impulse) {
            *sum += p;
        }
        loop {
            let row = self.trajectory.time.len() as u64;
            let due = self.due;
            if row > self.rows || due > step.end {
                break;
            }
            let [mut q, mut v] = std::mem::take(&mut self.state);
            v.copy_from_slice(if due > step.start { step.v } else { step.velocity_before });
            let back = 0.5 * (step.end - due);
            for (i, q) in q.iter_mut().enumerate() {
                *q = step.q[i] - back * (step.velocity_before[i] + step.v[i]);
            }
            self.push(due, &q, &v, step.force);
            self.state = [q, v];
        }
    }

    fn see_exact(&mut self, step: &Step<'_>) {
        let path = step.path;
        let mut from = step.start;
        if step.start == 0.0 && step.end == 0.0 {
            self.wear_exactly(step, step.start);
            self.restart(step);
            return;
        }
        if step.start == 0.0 {
            // The force at t = 0 is known only now, from the first arc: the body may rest on a
            // rigid wall.
            for (wall, column) in self.trajectory.force.iter_mut().enumerate() {
                column[0] = path.contact_force(wall, 0.0);
            }
            if let Path::Series(series) = path {
                for (hole, [y, z]) in self.trajectory.hole_force.iter_mut().enumerate() {
                    [y[0], z[0]] = series.hole_force(hole, 0.0);
                }
            }
        }
        // States are right-continuous: a row at the very end of this arc belongs to the next arc,
        // or is the run's last.
        loop {
            let row = self.trajectory.time.len() as u64;
            let due = self.due;
            if row >= self.rows || due >= step.end {
                break;
            }
            let [mut q, mut v] = std::mem::take(&mut self.state);
            path.state(due, &mut q, &mut v);
            let mut force = std::mem::take(&mut self.partial);
            for (wall, (sum, f)) in self.pending.iter_mut().zip(&mut force).enumerate() {
                *sum += path.contact_impulse(wall, from, due);
                *f = path.contact_force(wall, due);
            }
            if !self.worn.is_empty() {
                self.worn.add(step, [from, due]);
            }
            if let Path::Series(series) = path {
                self.rubbed.follow(series, [from, due]);
            }
            self.push(due, &q, &v, &force);
            (self.partial, self.state) = (force, [q, v]);
            from = due;
        }
        self.wear_exactly(step, from);
        if let Path::Series(series) = path {
            self.rubbed.follow(series, [from, step.end]);
            self.rubbed.jump(step);
        }
        for (wall, ((sum, &whole), &jump)) in self.pending.iter_mut().zip(step.impulse).zip(step.jump).enumerate() {
            *sum += if from > step.start { path.contact_impulse(wall, from, step.end) + jump } else { whole };
        }
        if step.end >= self.end {
            self.push(self.end, step.q, step.v, step.force);
        }
    }

    /// Adds an impact at t = 0 to the first row.
    fn restart(&mut self, step: &Step<'_>) {
        let t = &mut self.trajectory;
        for (column, row) in t.displacement.iter_mut().zip(&self.probes) {
            column[0] = row.dot(step.q);
        }
        for (column, row) in t.velocity.iter_mut().zip(&self.probes) {
            column[0] = row.dot(step.v);
        }
        for (column, &f) in t.force.iter_mut().zip(step.force) {
            column[0] = f;
        }
        for (column, &p) in t.impulse.iter_mut().zip(step.impulse) {
            column[0] += p;
        }
        for (column, hole) in t.hole_impulse.iter_mut().zip(step.holes) {
            column.iter_mut().zip(hole.push()).for_each(|(column, push)| column[0] += push);
        }
        for (column, &work) in t.wear_work.iter_mut().zip(&self.worn.work) {
            column[0] = work;
        }
    }

    fn push(&mut self, time: f64, q: &[f64], v: &[f64], force: &[f64]) {
        let t = &mut self.trajectory;
        t.time.push(time);
        for (index, row) in self.probes.iter().enumerate() {
            t.displacement[index].push(row.dot(q));
            t.velocity[index].push(row.dot(v));
        }
        for (index, sum) in self.pending.iter_mut().enumerate() {
            t.force[index].push(force.get(index).copied().unwrap_or(0.0));
            t.impulse[index].push(std::mem::take(sum));
        }
        for (column, &work) in t.wear_work.iter_mut().zip(&self.worn.work) {
            column.push(work);
        }
        let known = &mut self.rubbed;
        for (columns, force) in t.hole_force.iter_mut().zip(&known.force) {
            columns.iter_mut().zip(force).for_each(|(column, force)| column.push(*force));
        }
        for (columns, sum) in t.hole_impulse.iter_mut().zip(&mut known.holes) {
            columns.iter_mut().zip(sum).for_each(|(column, sum)| column.push(std::mem::take(sum)));
        }
        for (column, sum) in t.friction.iter_mut().zip(&mut known.friction) {
            column.push(std::mem::take(sum));
        }
        self.due = self.row_time(self.trajectory.time.len() as u64);
    }

    /// The trajectory, with the episodes `open` at the end of the run.
    #[must_use]
    pub fn finish(self, open: &[Contact]) -> Trajectory {
        let Self { mut trajectory, mut worn, .. } = self;
        trajectory.contacts.extend_from_slice(open);
        if worn.is_empty() {
            trajectory.contacts.sort_by(|a, b| a.start.total_cmp(&b.start));
            return trajectory;
        }
        worn.close(open, |wear| trajectory.contact_wear.push(wear));
        let contacts = std::mem::take(&mut trajectory.contacts);
        let mut both: Vec<_> = contacts.into_iter().zip(std::mem::take(&mut trajectory.contact_wear)).collect();
        both.sort_by(|a, b| a.0.start.total_cmp(&b.0.start));
        (trajectory.contacts, trajectory.contact_wear) = both.into_iter().unzip();
        trajectory
    }
}
