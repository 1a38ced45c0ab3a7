//! Checks of a step on a grid at each wall.

use super::Judge;
use super::complementarity::{expected_pressure, rebound, slack};
use super::place::Place;
use super::row_walls::RowMotion;
use crate::scene::Hole;
use crate::step::{Bound, PromisedForce, Reached, Step};

/// The quantities of a step at one wall.
#[derive(Debug, Clone, Copy)]
struct Seen {
    index: usize,
    /// The force that the promise refers to, as a pressure, N: negative where the wall pulls.
    pressure: f64,
    /// Displacements at both ends, m.
    w: (f64, f64),
    /// Velocities, m/s: before the step's blows, after them, and after the step.
    before: f64,
    struck: f64,
    after: f64,
    /// Impulses of all walls of its row, each counted as positive, N s.
    impulses: f64,
}

impl Judge {
    /// Checks every wall against its part of the promise; `beyond` says that blows add to the
    /// displacement of the step's rule.
    #[inline(always)]
    pub(super) fn walls_on_grid(&mut self, step: &Step<'_>, beyond: bool) {
        let blows = self.loads.has_blows();
        for place in 0..self.row_walls.len() {
            let walls_of_row = &self.row_walls[place];
            let still = |&wall: &usize| {
                step.impulse[wall] == 0.0 && step.force[wall] == 0.0 && self.walls.last_force[wall] == 0.0
            };
            if !beyond && walls_of_row.walls.iter().all(still) {
                let mut rate = walls_of_row.row.of(step.velocity_before).abs();
                if blows {
                    rate += walls_of_row.row.of(&self.blows.struck).abs();
                }
                if walls_of_row.is_clear((walls_of_row.row.of(&self.q), walls_of_row.row.of(step.q)), self.h * rate) {
                    continue;
                }
            }
            self.check_row(step, beyond, place);
        }
    }

    /// Checks the walls of one row.
    #[inline(never)]
    fn check_row(&mut self, step: &Step<'_>, beyond: bool, place: usize) {
        let row = self.row_walls[place].seen(step, &self.q);
        for wall in 0..self.row_walls[place].walls.len() {
            self.check_wall(step, beyond, &row, self.row_walls[place].walls[wall]);
        }
    }

    /// Checks one wall of a row.
    fn check_wall(&mut self, step: &Step<'_>, beyond: bool, row: &RowMotion, index: usize) {
        let promise = self.contract.promise;
        let wall = &self.scene.walls[index];
        let (sign, is_rigid) = (wall.side().sign(), wall.law.is_rigid());
        let p = step.impulse[index];
        // Most impulses are 0: avoid the division.
        let mean = if p == 0.0 { 0.0 } else { p / self.h };
        let force = match if is_rigid { promise.rigid.force } else { promise.elastic.force } {
            PromisedForce::Mean => mean,
            PromisedForce::End | PromisedForce::Trapezoid => step.force[index],
        };
        let pressure = sign * force;
        let largest = pressure.abs().max(mean.abs());
        self.walls.observe_force(&mut self.noise, index, (pressure.min(sign * mean), largest), is_rigid);
        // A bound on the displacement at the end includes what the blows add to it; everything else
        // is without that.
        let bound_there = is_rigid && promise.rigid.displacement == Some(Bound::End);
        let end = if bound_there || !beyond { row.end } else { wall.row().dot(&self.blows.arrived) };
        // Without blows what they give is zero.
        let given = if is_rigid && self.loads.has_blows() { wall.row().dot(&self.blows.struck) } else { 0.0 };
        let &RowMotion { start, before, after, impulses, .. } = row;
        let seen = Seen { index, pressure, w: (start, end), before, struck: before + given, after, impulses };
        self.walls.observe_depth(index, -wall.gap(row.end));
        if is_rigid {
            self.hold_rigid(step, seen);
        } else {
            self.hold_elastic(step, seen, mean);
        }
    }

    /// True if walls may have corrected the displacement of the step: a rigid wall or hole pushes,
    /// or the body is at it. Of a gap and a correction, which exclude each other, the gap counts as
    /// none up to the tolerance of the promise: how near a solver comes to the bound depends on how
    /// far the walls carry the body, which the step does not show.
    pub(super) fn closes(&self, step: &Step<'_>) -> bool {
        let near = self.contract.tolerances.walls.limit * self.energy.gap_scale;
        let at = |gap: f64, size: f64| gap <= near + self.noise.of(size);
        let wall = |&index: &usize| {
            let wall = &self.scene.walls[index];
            wall.law.is_rigid()
                && (step.impulse[index] != 0.0 || at(wall.gap(wall.row().dot(step.q)), self.size(step, index)))
        };
        let hole = |(hole, place): (Hole<'_>, &Place)| {
            let [y, z] = hole.offset(step.q);
            step.impulse[hole.index] != 0.0
                || at(hole.gap - y.hypot(z), self.way(&hole, &self.hole_motion(step, &hole, place)))
        };
        let places = self.places.iter().flat_map(|places| &places.holes);
        self.row_walls.iter().any(|walls_of_row| walls_of_row.walls.iter().any(wall))
            || self.scene.holes().zip(places).any(hole)
    }

    /// Size of the terms that add up to the body's position, for its rounding error, and of its way
    /// within a step, m; with those of the other degrees of freedom, from which the equations of
    /// the step find it.
    fn size(&self, step: &Step<'_>, index: usize) -> f64 {
        let wall = &self.scene.walls[index];
        let terms = wall.row().entries().iter().map(|&(i, g)| (g * step.q[i]).abs() + (g * self.q[i]).abs());
        let speeds = wall.row().dot(step.velocity_before).abs() + wall.row().dot(step.velocity_after).abs();
        terms.sum::<f64>() + wall.position().abs() + self.h * speeds + self.noise.reach(index)
    }

    /// Size of the terms that add up to the body's velocities at a wall in a step, for their
    /// rounding error, m/s. What the loads give and the impulse of the wall takes away may be far
    /// larger than the velocities at both ends.
    pub(super) fn speeds(&self, step: &Step<'_>, index: usize) -> f64 {
        let row = self.scene.walls[index].row();
        let kick = self.noise.kick(index, step.impulse[index]);
        let given = if self.loads.has_blows() { row.size(&self.blows.struck) } else { 0.0 };
        row.size(step.velocity_before) + row.size(step.velocity_after) + given + kick
    }

    fn hold_elastic(&mut self, step: &Step<'_>, seen: Seen, mean: f64) {
        let promise = self.contract.promise.elastic;
        let wall = &self.scene.walls[seen.index];
        let mut error =
            (seen.pressure - expected_pressure(wall, promise.law, self.h, seen.w, (seen.before, seen.after))).abs();
        if promise.force == PromisedForce::Trapezoid
            && let Some(last) = self.walls.last_force.get_mut(seen.index)
        {
            let force = step.force[seen.index];
            error = error.max((mean - 0.5 * (*last + force)).abs());
            *last = force;
        }
        // Where several walls of a row push against each other, what they leave to the body is
        // known to the rounding error of their impulses, and so is where it goes.
        let size = self.size(step, seen.index) + self.h * self.noise.kick(seen.index, seen.impulses);
        let depth = (-wall.gap(seen.w.0)).max(-wall.gap(seen.w.1)).max(f64::MIN_POSITIVE);
        let dashpot = wall.law.dashpot(wall.law.pressure(depth, 0.0));
        let rate = (seen.w.1 - seen.w.0).abs() / self.h;
        let slope = wall.law.tangent(depth) * (1.0 + wall.law.dissipation() * rate) + 2.0 * dashpot / self.h;
        self.walls.observe_law(&self.noise, seen.index, error, slope * self.noise.place(size));
    }

    fn hold_rigid(&mut self, step: &Step<'_>, seen: Seen) {
        let Seen { index, pressure, w, struck, after, .. } = seen;
        let promise = self.contract.promise.rigid;
        let wall = &self.scene.walls[index];
        if let Some(bound) = promise.displacement {
            let slack = slack(&self.scene, index, (bound, step.path), self.h, w, struck);
            if slack < 0.0 || pressure != 0.0 {
                self.walls.observe_gap(&self.noise, index, (slack, self.size(step, index)), pressure);
            }
        }
        let (reached, way) = match promise.velocity {
            Some(Reached::Ahead(at)) => {
                let gap = wall.gap(w.0 + at * self.h * struck);
                (gap <= self.walls.touch, gap)
            }
            Some(Reached::Closed) => {
                let gap = wall.gap(w.1);
                (gap <= self.walls.touch || pressure != 0.0, gap)
            }
            None => (false, f64::INFINITY),
        };
        let e = wall.law.restitution().filter(|&e| !self.gives_up(step, index, e, struck)).unwrap_or(0.0);
        let slack = if reached { rebound(wall, e, struck, after) } else { 0.0 };
        if pressure != 0.0 || slack < 0.0 {
            let closes = promise.velocity == Some(Reached::Closed);
            let is_edge = if closes {
                // The promise does not cover a wall that is closed only by the rounding error of
                // its gap.
                pressure == 0.0 && way > 0.0
            } else {
                // Near the limit, rounding decides whether the body reaches the wall within the
                // step: either is accepted.
                (way - self.walls.touch).abs() <= self.noise.of(self.size(step, index))
            };
            if is_edge {
                return;
            }
            if reached {
                let noise = self.noise.velocity(self.speeds(step, index), self.noise.span);
                self.walls.observe_rebound(&self.noise, index, (slack, noise), pressure);
            } else if !closes && promise.displacement.is_none() {
                self.walls.observe_law(&self.noise, index, pressure.abs(), 0.0);
            }
        }
    }
}
