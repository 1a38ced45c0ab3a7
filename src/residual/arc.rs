//! Checks of the exact motion of one degree of freedom.

use super::deepest::{behind, deepest};
use super::energy::{Along, Instants, stored};
use super::quadrature::{nodes, panels};
use super::row_walls::RowWalls;
use super::{Judge, PLACE_UNITS, running_max};
use crate::flow::Arc;
use crate::scene::Wall;
use crate::step::Step;

impl Judge {
    /// Checks an exact step: a stretch between two events, or an instant.
    pub(super) fn observe_arc(&mut self, step: &Step<'_>, arc: &Arc) {
        for (index, wall) in self.scene.walls.iter().enumerate() {
            self.walls.tension = self.walls.tension.max(-wall.side().sign() * step.jump[index]);
        }
        let mut along = Along::default();
        // An instant has impulses, but no forces.
        let lasts = step.end > step.start;
        if lasts {
            let (rate, fastest) = (arc.damping() / arc.mass(), arc.fastest_motion());
            for panel in panels(step.start, step.end, rate, fastest) {
                let mut at = Instants::of(nodes(panel));
                arc.states(&at.t[..at.count], &mut at.q[..at.count], &mut at.v[..at.count]);
                self.load_at(&mut at, step.extra.first().copied().unwrap_or(0.0));
                self.sample(arc, &mut at, &mut along);
                let largest = along.end_panel(&at);
                self.energy.reach(largest);
            }
            for index in arc.touching() {
                let wall = &self.scene.walls[index];
                let motion = |t: f64| {
                    let (q, v) = arc.state(t);
                    behind(wall, &[q], &[v])
                };
                self.walls.observe_depth(index, deepest([step.start, step.end], fastest.max(rate), motion));
            }
        }
        let open = self.energy.observe_arc(step, arc, &self.blows.impulse, &along);
        if !lasts {
            return;
        }
        let weight = self.weights.root_mass.first().copied().unwrap_or(1.0);
        let balance = open / (step.end - step.start);
        self.balance.raise_largest(balance);
        self.balance.raise_scale(along.largest_force / weight);
        self.balance.observe(&self.noise, balance / weight, 0.0);
    }

    /// Computes the loads at instants inside an arc. Tables jump at their ends, where an arc ends:
    /// a load read just inside is that of the arc.
    fn load_at(&self, at: &mut Instants, extra: f64) {
        let (times, loads) = (&at.t[..at.count], &mut at.load[..at.count]);
        match &self.grid_load {
            Some(forcing) => forcing.forces(times, loads),
            None => loads.iter_mut().zip(times).for_each(|(load, &t)| {
                *load = 0.0;
                self.loads.add_force(t, 1.0, std::slice::from_mut(load));
            }),
        }
        loads.iter_mut().for_each(|load| *load += extra);
    }

    /// Adds up what acts at the instants of a panel, and checks the force laws of the walls there.
    fn sample(&mut self, arc: &Arc, at: &mut Instants, along: &mut Along) {
        let force = self.energy.sample(at, along);
        self.noise.load(force * self.weights.per_root_mass.first().copied().unwrap_or(1.0));
        let (mut low, mut high, mut fastest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for (&q, v) in at.q[..at.count].iter().zip(&at.v) {
            (low, high, fastest) = (-running_max(-low, -q), running_max(high, q), running_max(fastest, v.abs()));
        }
        self.noise.state(&[running_max(-low, high)], &[fastest], 0.0, &self.weights);
        // In flight, most instants are in front of all walls.
        let clear = |walls: &RowWalls| walls.is_clear((walls.row.of(&[low]), walls.row.of(&[high])), 0.0);
        if arc.is_rest() || arc.touches() || !self.row_walls.iter().all(clear) {
            (0..at.count).for_each(|k| self.sample_walls(arc, k, at, along));
        }
    }

    /// Checks the walls at instant `k`.
    fn sample_walls(&mut self, arc: &Arc, k: usize, at: &mut Instants, along: &mut Along) {
        let (t, q, v) = (at.t[k], at.q[k], at.v[k]);
        for index in 0..self.scene.walls.len() {
            let wall = &self.scene.walls[index];
            let (sign, rigid) = (wall.side().sign(), wall.law.is_rigid());
            let (w, wdot) = (wall.row().dot(&[q]), wall.row().dot(&[v]));
            let (gap, r) = (wall.gap(w), arc.force_at(index, t, (q, v)));
            if rigid && r == 0.0 && gap >= 0.0 {
                continue;
            }
            at.add_wall(k, r, stored(wall, w, r != 0.0));
            if wall.law.is_damped() {
                along.add_damped(-at.weight[k] * r * v);
            }
            let pressure = sign * r;
            self.walls.observe_force(&mut self.noise, index, (pressure, pressure.abs()), rigid);
            self.walls.observe_depth(index, -gap);
            let size = self.extent.reach.max(w.abs()) + wall.position().abs() + wdot.abs() * t;
            if rigid {
                self.walls.observe_gap(&self.noise, index, (gap, size), pressure);
            } else {
                let rounding = PLACE_UNITS * f64::EPSILON * size;
                let law = |s: f64| wall.law.pressure(s, -sign * wdot);
                // Any force between the two is right. They differ by the wall's stiffness times the
                // rounding of the place, except at the face of a damped wall, where its law jumps.
                let beyond = |rounding: f64| {
                    let (low, high) = (law(-gap - rounding), law(-gap + rounding));
                    (low - pressure).max(pressure - high)
                };
                let mut error = beyond(rounding);
                if error > 0.0 && self.stands_at_rigid_wall(wall, q) {
                    error = beyond(rounding + self.noise.place(0.0));
                }
                self.walls.observe_law(&self.noise, index, error, 0.0);
            }
        }
    }

    /// True if the body at `q` (m) stands at a rigid wall on the side of `wall`, to the tolerance
    /// of its bound: a rigid wall stops the body in front of a spring with the same face only so
    /// exactly.
    fn stands_at_rigid_wall(&self, wall: &Wall, q: f64) -> bool {
        let near = |other: &Wall| other.gap(other.row().dot(&[q])).abs() <= self.noise.place(0.0);
        self.scene.walls.iter().any(|other| other.law.is_rigid() && other.side() == wall.side() && near(other))
    }
}
