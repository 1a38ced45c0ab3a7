//! Checks of a part of a step: what acts over it as in a step of its length, and the jump of the
//! velocity at its end.
//!
//! The jump keeps M(v − v₊) = J + Gᵀ p with J the blows at that instant and p the impulses of the
//! walls, and the impact law 0 ≤ rebound ⟂ |p| ≥ 0 at the walls that are touched there; at round
//! walls along the normal there, with friction by Coulomb's law on the impulse and the velocity
//! after it.

use super::Judge;
use super::complementarity::rebound;
use super::energy::Moved;
use super::friction::FrictionImpulse;
use super::place::terms;
use super::pushes::pushes;
use crate::scene::Hole;
use crate::step::Step;
use pulp::Scalar;

/// A length of a step that the scheme computed with other roundings.
const SAME: f64 = 1.0 + 1e-9;

/// Rounding error of the sum of two impulses, in units in the last place.
const SUM_UNITS: f64 = 4.0;

impl Judge {
    /// Checks a part of `length` seconds.
    pub(super) fn observe_part(&mut self, step: &Step<'_>, length: f64) {
        let mut over = std::mem::take(&mut self.over);
        let shown = step.impulse.iter().zip(step.jump).zip(step.force);
        for (over, ((p, jump), force)) in over.iter_mut().zip(shown) {
            // Their difference has the rounding of both, which is a large force over a short part;
            // the mean force has not.
            let (left, mean) = (p - jump, force * length);
            let rounding = SUM_UNITS * f64::EPSILON * (p.abs() + jump.abs());
            *over = if (left - mean).abs() <= rounding { mean } else { left };
        }
        let (own, h) = (self.contract, self.h);
        if length > 0.0 {
            self.ended = 0.0;
            // Blows and the impact law belong to the end.
            self.blows.hide();
            self.contract.promise.rigid.velocity = None;
            self.h = length;
            let before = self.balance.largest_so_far();
            if let Some(supports) = &mut self.supports {
                supports.begin_part();
            }
            let friction = self.part_friction(step, false);
            self.observe_grid(&Step { v: step.velocity_after, impulse: &over, friction: &friction, ..*step });
            self.rubbed = friction;
            if let Some(supports) = &mut self.supports {
                supports.keep_part(step, (length, h));
            }
            self.balance.spread_over_step(before, length / h);
            (self.contract, self.h) = (own, h);
            self.blows.hide();
        } else {
            self.set_load_at_end(step);
        }
        self.over = over;
        let changes = step.v.iter().zip(step.velocity_after).any(|(v, after)| v != after);
        if changes || step.jump.iter().any(|&p| p != 0.0) {
            self.observe_jump(step, length);
        }
    }

    /// The friction over a part, or that at its end, where a wall with an impulse there has it; the
    /// vector is that of `rubbed`.
    fn part_friction(&mut self, step: &Step<'_>, at_end: bool) -> Vec<f64> {
        let mut friction = std::mem::take(&mut self.rubbed);
        friction.clear();
        let part = |(f, jump): (&f64, &f64)| if (*jump != 0.0) == at_end { *f } else { 0.0 };
        friction.extend(step.friction.iter().zip(step.jump).map(part));
        friction
    }

    /// Checks the jump of the velocity at the end of a part of `length` seconds.
    fn observe_jump(&mut self, step: &Step<'_>, length: f64) {
        self.noise.begin(self.h, step.end);
        self.noise.state(step.q, step.v, 0.0, &self.weights);
        let mut ended = 0.0_f64;
        for index in 0..self.scene.walls.len() {
            ended = ended.max(self.rebound_at_end(step, length, index));
        }
        let friction = self.part_friction(step, true);
        let at_end = Step { velocity_after: step.v, impulse: step.jump, friction: &friction, ..*step };
        ended = ended.max(self.supports_at_end(step, &at_end));
        self.ended = self.ended.max(ended);
        self.jump_momentum(step, &at_end);
        self.rubbed = friction;
        let mid: Vec<f64> = step.velocity_after.iter().zip(&self.blows.struck).map(|(v, struck)| v + struck).collect();
        let (blow, left) = (&self.blows.impulse, step.velocity_after);
        self.energy.observe_series(step, Moved::default(), blow, left, &mid);
        let sums = &mut self.sums;
        sums.begin(step);
        for ((seen, size), &p) in sums.seen.iter_mut().zip(&mut sums.sizes).zip(step.jump) {
            (*seen, *size) = (*seen + p, *size + p.abs());
        }
        sums.last.copy_from_slice(step.v);
        self.extent.observe(Scalar, step.q, step.v, &self.weights, step.v.len());
    }

    /// Checks the impulses of round walls and of friction `at_end` of a part, and returns the
    /// largest speed at which rebounds end there, m/s.
    fn supports_at_end(&mut self, step: &Step<'_>, at_end: &Step<'_>) -> f64 {
        let Some(mut supports) = self.supports.take() else { return 0.0 };
        let mut ended = 0.0_f64;
        let scene = std::sync::Arc::clone(&self.scene);
        for hole in scene.holes() {
            if hole.law.is_rigid() {
                ended = ended.max(self.rebound_at_hole(step, &hole, &mut supports));
            }
            let (place, offset) = (hole.index, hole.offset(step.q));
            let (struck, distance) = (step.jump[place] != 0.0, offset[0].hypot(offset[1]));
            let impulse = if struck { [step.jump[place], step.friction[place]] } else { [0.0; 2] };
            // A hole that pushed over the part only did so along the normal there, halfway.
            let [y, z] = if struck || distance == 0.0 { step.normal[place] } else { offset.map(|x| x / distance) };
            let rub = FrictionImpulse { place, friction: hole.friction, impulse, tangent: [-z, y] };
            self.check_friction_at_end(at_end, hole.at, &rub, &mut supports);
        }
        self.rub_flats_at_end(at_end, &mut supports);
        for (index, _, [push, rub]) in pushes(&scene, at_end) {
            let force = [push[0] + rub[0], push[1] + rub[1]];
            supports.give(index, force, force[0].hypot(force[1]));
        }
        self.supports = Some(supports);
        ended
    }

    /// Checks the impact law of a round wall at the end of a part, and returns the speed at which
    /// its rebounds end there, m/s.
    fn rebound_at_hole(&mut self, step: &Step<'_>, hole: &Hole<'_>, supports: &mut super::Supports) -> f64 {
        let (place, p, end) = (hole.index, step.jump[hole.index], hole.offset(step.q));
        let distance = end[0].hypot(end[1]);
        let gap = hole.gap - distance;
        let size = terms(hole.at, step.q) + hole.centre[0].abs() + hole.centre[1].abs() + hole.gap;
        // Rounding decides whether a wall that does not push is touched.
        if p == 0.0 && gap > -self.noise.of(size) {
            return 0.0;
        }
        let n = end.map(|x| x / distance);
        let along = |v: [f64; 2]| n[0] * v[0] + n[1] * v[1];
        let struck = along(hole.seen(step.velocity_after)) + along(hole.seen(&self.blows.struck));
        let after = along(hole.seen(step.v));
        let pressure = p / self.h;
        self.walls.observe_force(&mut self.noise, place, (pressure, pressure.abs()), true);
        let speeds = terms(hole.at, step.velocity_after) + terms(hole.at, step.v) + terms(hole.at, &self.blows.struck);
        self.walls.observe_gap(&self.noise, place, (gap, size), pressure);
        let noise = self.noise.velocity(speeds, self.noise.span) + self.noise.of(size) / hole.gap * speeds;
        let rests = step.resting.contains(&place)
            && (struck <= SAME * (self.ended + noise) || supports.ends_rebounds(hole, (n, struck), self.h, noise));
        let e = if rests || step.wedged.contains(&place) { 0.0 } else { hole.restitution };
        let slack = match struck > 0.0 {
            true => -after - e * struck,
            // A wall that the body leaves need not push: what drives the body back strikes it next.
            false if p == 0.0 => -struck,
            false => -after - struck,
        };
        self.walls.observe_rebound(&self.noise, place, (slack, noise), pressure);
        if p != 0.0 {
            let across = pressure * (step.normal[place][0] - n[0]).hypot(step.normal[place][1] - n[1]);
            let noise = pressure * self.noise.of(size) / distance + self.noise.wall_force(place);
            supports.askew.observe(across, noise, self.noise.end, Some(place));
        }
        if rests && p != 0.0 { struck } else { 0.0 }
    }

    /// Checks the impact law of a wall at the end of a part, and returns the speed at which its
    /// rebounds end there, m/s.
    fn rebound_at_end(&mut self, step: &Step<'_>, length: f64, index: usize) -> f64 {
        let wall = &self.scene.walls[index];
        let row = wall.row();
        let (sign, p) = (wall.side().sign(), step.jump[index]);
        let Some(e) = wall.law.restitution().filter(|_| !wall.is_round()) else { return 0.0 };
        let (gap, before, after) = (wall.gap(row.dot(step.q)), row.dot(step.velocity_after), row.dot(step.v));
        // Rounding decides whether a wall in front of the body is touched.
        if p == 0.0 && gap > 0.0 {
            return 0.0;
        }
        let struck = before + row.dot(&self.blows.struck);
        let pressure = sign * p / self.h;
        self.walls.observe_force(&mut self.noise, index, (pressure, pressure.abs()), true);
        let wall = &self.scene.walls[index];
        let noise = self.noise.velocity(self.speeds(step, index), self.noise.span);
        let size = row.size(step.q) + wall.position().abs();
        self.walls.observe_gap(&self.noise, index, (gap, size), pressure);
        // The rebounds end within a step if the acceleration of the part presses the body so; in
        // two planes, of the last one of some length.
        let rests = step.resting.contains(&index) && {
            let change = |before: f64, after: f64| -sign * (after - before);
            let (pressed, length) = match &self.supports {
                Some(supports) => (supports.change_in_part(|v| row.dot(v), change), supports.part_length()),
                None => (change(row.dot(step.velocity_before), before), length),
            };
            struck.abs() <= SAME * (self.ended + noise)
                || e < 1.0 && self.walls.last_impacts[index].accumulate((step.end, struck.abs()), self.h, SAME)
                || 2.0 * e * struck.abs() * length <= SAME * (1.0 - e) * self.h * (pressed + noise)
        };
        let ended = if rests && p != 0.0 { struck.abs() } else { 0.0 };
        if p != 0.0 {
            self.walls.last_impacts[index].observe(step.end, struck.abs());
        }
        let e = if rests || step.wedged.contains(&index) { 0.0 } else { e };
        // A wall that the body leaves need not push: what drives the body back strikes it next.
        let is_left = p == 0.0 && sign * struck > 0.0;
        let slack = if is_left { sign * struck } else { rebound(wall, e, struck, after) };
        self.walls.observe_rebound(&self.noise, index, (slack, noise), pressure);
        ended
    }

    /// Checks the momentum that the velocity gains at the end of a part, by the impulses `at_end`.
    fn jump_momentum(&mut self, step: &Step<'_>, at_end: &Step<'_>) {
        let s = &mut self.scratch;
        for ((gained, v), after) in s.gained.iter_mut().zip(step.v).zip(step.velocity_after) {
            *gained = v - after;
        }
        s.residual.iter_mut().zip(&self.blows.impulse).for_each(|(open, blow)| *open = -blow);
        s.inertia.fill(0.0);
        self.scene.system.add_mass(1.0, &s.gained, &mut s.inertia);
        for (i, root) in self.weights.root_mass.iter().enumerate() {
            s.residual[i] += s.inertia[i];
            self.balance.raise_scale(s.inertia[i].abs().max(self.blows.impulse[i].abs()) / (self.h * root));
        }
        for (wall, &p) in self.scene.walls.iter().zip(step.jump).filter(|(_, p)| **p != 0.0) {
            wall.row().add_transposed(-p, &mut s.residual);
        }
        for (_, at, [push, rub]) in pushes(&self.scene, at_end) {
            at.y.add_transposed(-(push[0] + rub[0]), &mut s.residual);
            at.z.add_transposed(-(push[1] + rub[1]), &mut s.residual);
        }
        let (largest, worst) = s.open(Scalar, 1.0 / self.h, &self.weights, step.v.len(), self.balance.largest);
        self.balance.largest = largest;
        self.balance.force.observe(worst, self.noise.force(), self.noise.end, None);
    }
}
