//! From the steps of a run to its rows.

mod exact;

use super::Trajectory;
use super::columns::Columns;
use super::output::OutputRecorder;
use super::plane_impulses::PlaneImpulses;
use super::worn::Worn;
use crate::order::sort_by_number;
use crate::scene::{Row, Scene};
use crate::step::{Contact, Path, QuietSteps, Step};
use crate::wear::SlidingPiece;

/// Rounding error of the time of a row and of the end of a step there, in units in the last place.
const ROW_UNITS: f64 = 8.0;

/// Builds a [`Trajectory`] from the steps of a run, at the requested rows.
#[derive(Debug, Clone)]
pub struct Recorder {
    columns: Columns,
    probes: Vec<Row>,
    end: f64,
    rows: u64,
    /// Rows per second, and the time of the next row, s.
    rate: f64,
    due: f64,
    /// Impulse per wall since the last row, N s.
    pending: Vec<f64>,
    /// True once a part of a step, or a step that was handed over, has ended at the last row, whose
    /// state waits in `state`.
    ended: bool,
    planar: PlaneImpulses,
    worn: Worn,
    output: OutputRecorder,
    /// Displacement and velocity at a row, n entries each.
    state: [Vec<f64>; 2],
}

impl Recorder {
    /// A recorder of `rows` equal intervals over the scene's duration, starting from the state `q`
    /// (m), `v` (m/s).
    #[must_use]
    pub fn new(scene: &Scene, rows: u64, q: &[f64], v: &[f64]) -> Self {
        let (n, m) = (scene.system.degrees_of_freedom(), scene.walls.len());
        let probes: Vec<Row> = scene.probes.iter().map(|p| p.at.clone()).collect();
        let mut recorder = Self {
            columns: Columns::new(scene, rows),
            worn: Worn::new(scene),
            output: OutputRecorder::new(scene, &probes, q, v),
            probes,
            end: scene.duration,
            rows,
            rate: rows as f64 / scene.duration,
            due: 0.0,
            pending: vec![0.0; m],
            ended: false,
            planar: PlaneImpulses::new(scene),
            state: [vec![0.0; n], vec![0.0; n]],
        };
        recorder.push(0.0, q, v);
        recorder
    }

    /// Time of row `k`, s; the last is the end itself. The rate is often a whole number (1 ms: 1000
    /// per second), and dividing by it gives the double nearest to the decimal.
    fn row_time(&self, k: u64) -> f64 {
        if k >= self.rows { self.end } else { k as f64 / self.rate }
    }

    /// Adds one step. Steps must come in order. Steps after the last row are ignored, and so are
    /// steps of another scene, with another number of walls or degrees of freedom.
    pub fn observe(&mut self, step: &Step<'_>) {
        self.worn.begin();
        let planar = self.planar.friction.len();
        if !step.fits(self.state[0].len(), self.pending.len(), planar) {
            return;
        }
        self.output.observe(step, &self.probes);
        if self.columns.time.len() as u64 > self.rows {
            return;
        }
        if !matches!(step.path, Path::Series(_)) && planar > 0 {
            self.planar.observe(step);
        }
        self.columns.contacts.extend_from_slice(step.closed);
        let exact = matches!(step.path, Path::Exact(_) | Path::Series(_));
        if !exact {
            self.wear(step);
            self.pending.iter_mut().zip(step.impulse).for_each(|(sum, p)| *sum += p);
        }
        match step.path {
            Path::Grid | Path::OneRestitution => {
                // The grid divides the spacing of the rows, so a row's time and a step's end differ
                // by rounding only.
                let due = self.due;
                if step.end > due - 0.5 * (step.end - step.start) {
                    self.push(due, step.q, step.v);
                }
            }
            Path::Part { .. } => {
                // Rows are due where steps end, up to the rounding of both products.
                let due = self.due;
                if step.end >= due * (1.0 - ROW_UNITS * f64::EPSILON) {
                    if self.columns.time.len() as u64 == self.rows {
                        // A part of a few roundings or of no length may follow, with an impact.
                        self.ended = true;
                        self.state[0].copy_from_slice(step.q);
                        self.state[1].copy_from_slice(step.v);
                    } else {
                        self.push(due, step.q, step.v);
                    }
                }
            }
            Path::Exact(_) | Path::Series(_) => self.observe_exact(step),
            Path::Handed { .. } => self.push_between(step),
        }
    }

    /// Displacements at the rows so far, m: one column per probe.
    pub(crate) fn displacements(&self) -> &[Vec<f64>] {
        &self.columns.displacement
    }

    /// What slid between two times (s) of the last step: on a grid the whole step, of exact motion
    /// the piece since its last row.
    pub(crate) fn slid(&self) -> ([f64; 2], &[SlidingPiece]) {
        self.worn.slid()
    }

    /// Adds steps in which no wall pushes and no contact ends, as [`Recorder::observe`] adds each
    /// of them.
    pub(crate) fn observe_quiet(&mut self, quiet: &QuietSteps) {
        let mut from = 0;
        // Impulses since the last row belong to the next one.
        while from < quiet.len() && (!self.worn.is_empty() || self.pending.iter().any(|&sum| sum != 0.0)) {
            self.observe(&quiet.step(from));
            from += 1;
        }
        self.output.observe_quiet(quiet, from, &self.probes);
        let mut rows = [0; QuietSteps::capacity()];
        let mut count = 0;
        for k in from..quiet.len() {
            let (start, end) = (quiet.start(k), quiet.end()[k]);
            if self.columns.time.len() as u64 <= self.rows && end > self.due - 0.5 * (end - start) {
                self.columns.time.push(self.due);
                self.due = self.row_time(self.columns.time.len() as u64);
                (rows[count], count) = (k, count + 1);
            }
        }
        let Columns { displacement, velocity, .. } = &mut self.columns;
        for (columns, values) in [(displacement, quiet.q()), (velocity, quiet.v())] {
            for (column, probe) in columns.iter_mut().zip(&self.probes) {
                column.extend(rows[..count].iter().map(|&k| probe.dot(&values[k..=k])));
            }
        }
    }

    /// Adds what slid in a step whose motion is known at its ends only.
    fn wear(&mut self, step: &Step<'_>) {
        if !self.worn.is_empty() {
            // On a grid a contact ends with the first step in which it does not push.
            let Self { worn, columns, .. } = self;
            worn.close(step.closed, |wear| columns.contact_wear.push(wear));
            worn.add(step, [step.start, step.end]);
        }
    }

    /// Adds the rows within a step whose ends need not fall on rows: between them the displacement
    /// is interpolated linearly.
    fn push_between(&mut self, step: &Step<'_>) {
        loop {
            let row = self.columns.time.len() as u64;
            let due = self.due;
            if row > self.rows || due * (1.0 - ROW_UNITS * f64::EPSILON) > step.end {
                break;
            }
            let [mut q, mut v] = std::mem::take(&mut self.state);
            v.copy_from_slice(if due > step.start { step.v } else { step.velocity_before });
            let back = 0.5 * (step.end - due);
            for (i, q) in q.iter_mut().enumerate() {
                *q = step.q[i] - back * (step.velocity_before[i] + step.v[i]);
            }
            self.ended = row == self.rows;
            if !self.ended {
                self.push(due, &q, &v);
            }
            self.state = [q, v];
            if self.ended {
                // As after a part: one with an impact may follow.
                break;
            }
        }
    }

    fn push(&mut self, time: f64, q: &[f64], v: &[f64]) {
        let t = &mut self.columns;
        t.time.push(time);
        for (index, row) in self.probes.iter().enumerate() {
            t.displacement[index].push(row.dot(q));
            t.velocity[index].push(row.dot(v));
        }
        // A wall is touched in few rows: its zeros are written when its next impulse comes.
        let row = t.time.len() - 1;
        let late = |column: &mut Vec<f64>, value: f64| {
            if value != 0.0 {
                column.resize(row, 0.0);
                column.push(value);
            }
        };
        for (column, sum) in t.impulse.iter_mut().zip(&mut self.pending) {
            late(column, std::mem::take(sum));
        }
        for (column, &work) in t.wear_work.iter_mut().zip(&self.worn.work) {
            column.push(work);
        }
        let known = &mut self.planar;
        for (columns, sum) in t.hole_impulse.iter_mut().zip(&mut known.holes) {
            columns.iter_mut().zip(sum).for_each(|(column, sum)| column.push(std::mem::take(sum)));
        }
        for (column, sum) in t.friction.iter_mut().zip(&mut known.friction) {
            late(column, std::mem::take(sum));
        }
        self.due = self.row_time(self.columns.time.len() as u64);
    }

    /// The trajectory, with the episodes `open` at the end of the run.
    #[must_use]
    pub fn finish(self, open: &[Contact]) -> Trajectory {
        let mut whole = self;
        if whole.ended && whole.columns.time.len() as u64 == whole.rows {
            let [q, v] = std::mem::take(&mut whole.state);
            whole.push(whole.end, &q, &v);
        }
        let Self { mut columns, mut worn, output, rate, .. } = whole;
        columns.output = output.finish();
        columns.fill(rate);
        columns.contacts.extend_from_slice(open);
        if worn.is_empty() {
            sort_by_number(&mut columns.contacts, |a| a.start);
            return Trajectory(columns);
        }
        worn.close(open, |wear| columns.contact_wear.push(wear));
        let contacts = std::mem::take(&mut columns.contacts);
        let mut both: Vec<_> = contacts.into_iter().zip(std::mem::take(&mut columns.contact_wear)).collect();
        sort_by_number(&mut both, |a| a.0.start);
        (columns.contacts, columns.contact_wear) = both.into_iter().unzip();
        Trajectory(columns)
    }
}

#[cfg(test)]
mod tests;
