//! The rows of exact motion, which is known at every instant.

use super::Recorder;
use crate::step::{Path, Step};

impl Recorder {
    /// Adds a step whose motion is known at every instant.
    pub(super) fn observe_exact(&mut self, step: &Step<'_>) {
        let path = step.path;
        let mut from = step.start;
        if step.start == 0.0 && step.end == 0.0 {
            self.wear_exactly(step, step.start);
            self.restart(step);
            return;
        }
        // States are right-continuous: a row at the very end of this arc belongs to the next arc,
        // or is the run's last.
        loop {
            let row = self.columns.time.len() as u64;
            let due = self.due;
            if row >= self.rows || due >= step.end {
                break;
            }
            let [mut q, mut v] = std::mem::take(&mut self.state);
            path.state(due, &mut q, &mut v);
            for (wall, sum) in self.pending.iter_mut().enumerate() {
                *sum += path.contact_impulse(wall, from, due);
            }
            if !self.worn.is_empty() {
                self.worn.add(step, [from, due]);
            }
            if let Path::Series(series) = path {
                self.planar.follow(series, [from, due]);
            }
            self.push(due, &q, &v);
            self.state = [q, v];
            from = due;
        }
        self.wear_exactly(step, from);
        if let Path::Series(series) = path {
            self.planar.follow(series, [from, step.end]);
            self.planar.jump(step);
        }
        for (wall, ((sum, &whole), &jump)) in self.pending.iter_mut().zip(step.impulse).zip(step.jump).enumerate() {
            *sum += if from > step.start { path.contact_impulse(wall, from, step.end) + jump } else { whole };
        }
        if step.end >= self.end {
            self.push(self.end, step.q, step.v);
        }
    }

    /// Adds an impact at t = 0 to the first row.
    fn restart(&mut self, step: &Step<'_>) {
        let t = &mut self.columns;
        for (column, row) in t.displacement.iter_mut().zip(&self.probes) {
            column[0] = row.dot(step.q);
        }
        for (column, row) in t.velocity.iter_mut().zip(&self.probes) {
            column[0] = row.dot(step.v);
        }
        for (column, &p) in t.impulse.iter_mut().zip(step.impulse).filter(|(_, p)| **p != 0.0) {
            column.resize(1, 0.0);
            column[0] += p;
        }
        for (column, hole) in t.hole_impulse.iter_mut().zip(&self.planar.walls) {
            column.iter_mut().zip(step.hole_push(*hole)).for_each(|(column, push)| column[0] += push);
        }
        for (column, &work) in t.wear_work.iter_mut().zip(&self.worn.work) {
            column[0] = work;
        }
    }

    /// Adds what slid at the end of a step of exact motion, from `from` (s) on, and its contacts.
    fn wear_exactly(&mut self, step: &Step<'_>, from: f64) {
        if !self.worn.is_empty() {
            let Self { worn, columns, .. } = self;
            worn.add(step, [from, step.end]);
            worn.close(step.closed, |wear| columns.contact_wear.push(wear));
        }
    }
}
