//! Checks of the exact motion of one degree of freedom.

use super::energy::{Along, Instant, stored};
use super::quadrature::{nodes, panels};
use super::sight::Sight;
use super::{Judge, PLACE_UNITS, most};
use crate::flow::Arc;
use crate::step::Step;

impl Judge {
    /// Checks an exact step: a stretch between two events, or an instant.
    pub(super) fn see_arc(&mut self, step: &Step<'_>, arc: &Arc) {
        for (index, wall) in self.scene.walls.iter().enumerate() {
            self.tension = self.tension.max(-wall.side.sign() * step.jump[index]);
        }
        let mut along = Along::default();
        // An instant has impulses, but no forces.
        let lasts = step.end > step.start;
        if lasts {
            let (rate, fastest) = (arc.damping() / arc.mass(), arc.fastest_motion());
            for panel in panels(step.start, step.end, rate, fastest) {
                // Tables jump at their ends, where an arc ends: a load read just inside is that of
                // the arc.
                for (t, weight) in nodes(panel) {
                    let (q, v) = arc.state(t);
                    let mut load = [step.extra.first().copied().unwrap_or(0.0)];
                    self.loads.add_force(t, 1.0, &mut load);
                    self.look(arc, Instant { t, weight, q, v, load: load[0] }, &mut along);
                }
                along.end_panel();
            }
        }
        let open = self.energy.see_arc(&self.scene, step, arc, &self.blows.impulse, &along);
        if !lasts {
            return;
        }
        let weight = self.weights.root_mass.first().copied().unwrap_or(1.0);
        let balance = open / (step.end - step.start);
        self.balance = self.balance.max(balance);
        self.normal_balance = self.balance / weight;
        self.balance_scale = self.balance_scale.max(along.largest_force / weight);
        self.doubt_balance(balance / weight);
    }

    /// Adds up what acts at an instant of an arc, and checks the force laws of the walls there.
    fn look(&mut self, arc: &Arc, at: Instant, along: &mut Along) {
        let Instant { t, q, v, .. } = at;
        let force = self.energy.look(&self.scene, at, along);
        self.rounding.load(force * self.weights.per_root_mass.first().copied().unwrap_or(1.0));
        self.rounding.state(&[q], &[v], 0.0, &self.weights);
        // In flight, most instants are in front of all walls.
        let clear = |sight: &Sight| sight.is_clear((sight.of(&[q]), sight.of(&[q])), 0.0);
        let free = !arc.is_rest() && !arc.touches() && self.sights.iter().all(clear);
        let walls = if free { 0 } else { self.scene.walls.len() };
        for index in 0..walls {
            let wall = &self.scene.walls[index];
            let (sign, rigid) = (wall.side.sign(), wall.law.is_rigid());
            let (w, wdot) = (wall.at.dot(&[q]), wall.at.dot(&[v]));
            let (gap, r) = (wall.gap(w), arc.force_at(index, t, (q, v)));
            if rigid && r == 0.0 && gap >= 0.0 {
                continue;
            }
            along.add_wall(at, r, stored(wall, w, r != 0.0), wall.law.damping() > 0.0);
            let pressure = sign * r;
            self.force_scale = most(self.force_scale, pressure.abs());
            self.tension = most(self.tension, -pressure);
            self.depth[index] = most(self.depth[index], -gap);
            self.rounding.push(index, pressure, rigid);
            let size = self.extent.reach.max(w.abs()) + wall.position.abs() + wdot.abs() * t;
            if rigid {
                self.pairs.add(gap, pressure);
                self.doubt_gap(index, gap, size, pressure);
            } else {
                let rounding = PLACE_UNITS * f64::EPSILON * size;
                let law = |s: f64| wall.law.pressure(s, -sign * wdot);
                let (low, high) = (law(-gap - rounding), law(-gap + rounding));
                // Any force between the two is right. They differ by the wall's stiffness times the
                // rounding of the place, except at the face of a damped wall, where its law jumps.
                let error = (low - pressure).max(pressure - high);
                self.law_error = self.law_error.max(error);
                self.doubt_law(index, error, 0.0);
            }
        }
        self.energy.reach(along.end_instant(at.weight));
    }
}
