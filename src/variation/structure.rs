//! Several degrees of freedom: changes of the state propagated over each step.

use super::jump::{Jump, Struck};
use super::no_derivative::NoDerivative;
use super::oscillator::ON_THE_FACE;
use crate::error::{Error, Result};
use crate::flow::{Hold, Propagator, Series, held};
use crate::scene::Scene;
use crate::step::{Path, Step};

/// The data of a wall for the propagation of changes.
#[derive(Debug, Clone, Copy)]
struct At {
    row: usize,
    sign: f64,
    position: f64,
    /// e of a rigid wall; `None` for an elastic one.
    restitution: Option<f64>,
    stiffness: f64,
    damping: f64,
    /// For an elastic wall: true if it pushes during the present stretch, and after the last event.
    during: bool,
    after: bool,
}

/// Propagates changes of the start over the steps of a structure.
#[derive(Debug)]
pub(super) struct StructureVariation {
    flow: Propagator,
    walls: Vec<At>,
    jump: Jump,
    /// Rows held during the present stretch, and after the last event.
    during: Vec<bool>,
    after: Vec<bool>,
    /// The latter as constraints.
    hold: Hold,
    /// A typical displacement, m.
    length: f64,
    /// True once a step has been seen.
    began: bool,
    /// The state and the acceleration just before an event, and work space.
    q: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    work: Vec<f64>,
}

/// A row that leaves an impact with less than this share of e times its approach speed has come to
/// rest: the scheme has skipped the remaining impacts of an accumulation.
const STUCK: f64 = 0.5;

/// A row whose departure speed differs from e times its approach speed by more than this share was
/// struck more than once.
const ONCE: f64 = 1e-6;

impl StructureVariation {
    pub fn new(scene: &Scene) -> Result<Self> {
        if let Some(hole) = scene.holes().next() {
            let found = format!("round, at the support {:?}", hole.name);
            let expected = "walls and flats: the derivative of a motion round a hole is not known";
            return Err(Error::invalid("support", found, expected));
        }
        let singular = || Error::invalid(("system", "mass matrix"), "singular", "a positive definite matrix");
        let flow = Propagator::new(scene).ok_or_else(singular)?;
        let (n, rows) = (flow.body.n, flow.body.rows.count());
        let walls = scene.walls.iter().zip(&flow.body.row_of).map(|(wall, &row)| {
            let (stiffness, damping) = wall.law.spring().map_or((0.0, 0.0), |s| (s.stiffness, s.damping));
            let (sign, position, restitution) = (wall.side().sign(), wall.position(), wall.law.restitution());
            At { row, sign, position, restitution, stiffness, damping, during: false, after: false }
        });
        Ok(Self {
            walls: walls.collect(),
            jump: Jump::with_room(n, rows),
            during: vec![false; rows],
            after: vec![false; rows],
            hold: Hold::with_room(rows),
            length: scene.gap_scale(),
            began: false,
            q: vec![0.0; n],
            v: vec![0.0; n],
            a: vec![0.0; n],
            work: vec![0.0; n],
            flow,
        })
    }

    /// n.
    pub fn degrees_of_freedom(&self) -> usize {
        self.flow.body.n
    }

    /// Propagates `columns`, changes of 2n entries (δq, δq̇) one after the other, over `step`. They
    /// must not be used after an error.
    pub fn carry(&mut self, step: &Step<'_>, columns: &mut [f64]) -> std::result::Result<(), NoDerivative> {
        let n = self.degrees_of_freedom();
        let series = match step.path {
            Path::Series(series) if step.q.len() == n && step.force.len() == self.walls.len() => series,
            _ => return Err(NoDerivative::Unresolved { time: step.end }),
        };
        self.look(series);
        self.come_to_rest(columns);
        if self.began {
            series.state(series.start(), &mut self.q, &mut self.v);
            for w in 0..self.walls.len() {
                if self.walls[w].during && !self.walls[w].after {
                    self.enter(w, columns);
                }
            }
        }
        for change in columns.chunks_exact_mut(2 * n) {
            let (q, v) = change.split_at_mut(n);
            self.flow.flow(series.end() - series.start(), q, v);
        }
        series.state(series.end(), &mut self.q, &mut self.v);
        self.after.fill(false);
        for (at, &force) in self.walls.iter_mut().zip(step.force) {
            at.after = force != 0.0 && at.restitution.is_none();
            self.after[at.row] |= force != 0.0 && at.restitution.is_some();
        }
        self.began = true;
        if step.jump.iter().any(|&p| p != 0.0) {
            return self.impact(step, series, columns);
        }
        for w in 0..self.walls.len() {
            if self.walls[w].after && !self.walls[w].during {
                self.enter(w, columns);
            }
        }
        Ok(())
    }

    /// Records which rows are held and which elastic walls push during `series`.
    fn look(&mut self, series: &Series) {
        self.during.fill(false);
        self.walls.iter_mut().for_each(|at| at.during = false);
        for (wall, holds) in series.acting_walls() {
            let Some(at) = self.walls.get_mut(wall) else { continue };
            at.during = !holds;
            self.during[at.row] |= holds;
        }
        let pushing = self.walls.iter().enumerate().filter(|(_, at)| at.during);
        let rows = (0..self.during.len()).filter(|&row| self.during[row]);
        self.flow.set(rows, pushing.map(|(wall, at)| (wall, at.stiffness, at.damping)));
    }

    /// Applies the matrix of coming to rest for rows that are held from here on without an impact:
    /// they were at rest already, to rounding.
    fn come_to_rest(&mut self, columns: &mut [f64]) {
        let Self { flow, walls, jump, during, after, hold, .. } = self;
        let rows = 0..during.len();
        let rests = |row| Struck { row, restitution: 0.0, speed: 0.0, pull: 0.0 };
        let fresh: Vec<Struck> = rows.clone().filter(|&row| during[row] && !after[row]).map(rests).collect();
        if fresh.is_empty() {
            return;
        }
        let held_rows = rows.filter(|&row| during[row]);
        hold.set(&flow.body, held_rows.clone().map(held), std::iter::empty());
        jump.begin(flow, &fresh, held_rows.filter(|&row| after[row]));
        jump.kick(flow, hold, |flow, _, shift, force| {
            for at in walls.iter().filter(|at| at.during) {
                let rate = flow.body.rows.dot(at.row, shift);
                flow.body.rows.add_transposed(at.row, at.damping * rate, force);
            }
        });
        jump.apply_to(flow, columns);
    }

    /// Enters elastic wall `w`, if the state is on its face and moves into it: a push that begins
    /// elsewhere begins with a force of 0.
    fn enter(&mut self, w: usize, columns: &mut [f64]) {
        let Self { flow, walls, q, v, work, .. } = self;
        let (at, n) = (walls[w], q.len());
        let (place, rate) = (flow.body.rows.dot(at.row, q), flow.body.rows.dot(at.row, v));
        let inwards = -at.sign * rate > 0.0;
        if at.damping == 0.0 || !inwards || (place - at.position).abs() > ON_THE_FACE * self.length {
            return;
        }
        work.fill(0.0);
        flow.body.add_column(at.row, -at.damping, work);
        flow.hold.stop(&flow.body, work, &mut flow.scratch);
        for change in columns.chunks_exact_mut(2 * n) {
            let (q, v) = change.split_at_mut(n);
            let by = flow.body.rows.dot(at.row, q);
            v.iter_mut().zip(&*work).for_each(|(v, w)| *v += by * w);
        }
    }

    /// The impacts at the end of `step`.
    fn impact(
        &mut self,
        step: &Step<'_>,
        series: &Series,
        columns: &mut [f64],
    ) -> std::result::Result<(), NoDerivative> {
        series.acceleration_at_end(&mut self.a);
        let together = || NoDerivative::Together {
            time: step.end,
            walls: step.jump.iter().enumerate().filter(|(_, p)| **p != 0.0).map(|(wall, _)| wall).collect(),
        };
        let Self { flow, walls, jump, during, after, hold, v, a, .. } = self;
        let (mut struck, mut passing): (Vec<Struck>, Vec<usize>) = (Vec::new(), Vec::new());
        for row in 0..during.len() {
            let here = walls.iter().zip(step.jump).filter(|(at, p)| at.row == row && **p != 0.0);
            let Some(e) = here.filter_map(|(at, _)| at.restitution).reduce(f64::max) else { continue };
            let [speed, left, acceleration] = [&v[..], step.v, &a[..]].map(|x| flow.body.rows.dot(row, x));
            if during[row] || speed == 0.0 {
                passing.push(row);
                continue;
            }
            let rests = after[row] || (e > 0.0 && left.abs() < STUCK * e * speed.abs());
            if !rests && (left + e * speed).abs() > ONCE * speed.abs() {
                return Err(together());
            }
            after[row] |= rests;
            let (restitution, pull) = if rests { (0.0, 0.0) } else { (e, acceleration / speed) };
            struck.push(Struck { row, restitution, speed, pull });
        }
        jump.begin(flow, &struck, passing.into_iter());
        let turned = walls.iter().any(|at| at.during != at.after && at.damping > 0.0);
        let released = (0..during.len()).any(|row| during[row] && !after[row]);
        if struck.len() > 1 && (turned || released || jump.is_coupled(flow)) {
            return Err(together());
        }
        hold.set(&flow.body, (0..after.len()).filter(|&row| after[row]).map(held), std::iter::empty());
        let before = |wall: usize| series.contact_force(wall, series.end());
        jump.kick(flow, hold, |flow, s, shift, force| {
            for (wall, at) in walls.iter().enumerate() {
                let push = match (at.restitution, at.during, at.after) {
                    // A reaction that ends with the impact.
                    (Some(_), ..) if during[at.row] && !after[at.row] => -before(wall) / s.speed,
                    (None, true, true) => at.damping * flow.body.rows.dot(at.row, shift),
                    (None, true, false) | (None, false, true) => (step.force[wall] - before(wall)) / s.speed,
                    _ => continue,
                };
                flow.body.rows.add_transposed(at.row, push, force);
            }
        });
        jump.apply_to(flow, columns);
        Ok(())
    }
}
