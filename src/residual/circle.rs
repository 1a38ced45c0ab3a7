//! Checks of round holes along a structure's exact motion against the promise
//! ([`Circle`](crate::step::Circle)), from the state at each node of the stretch, the force there,
//! and the velocities before and after the instant that ends it.

use super::Judge;
use super::place::terms;
use super::quadrature::{Panel, nodes};
use crate::flow::Series;
use crate::step::Step;

/// Rounding error of an impulse as a vector, in units in the last place of the magnitudes that add
/// up to it.
const VECTOR_UNITS: f64 = 32.0;

/// The speed of rounding is that of the gap scale within a stretch, of at least this share of the
/// run.
const SHORTEST: f64 = 1e-3;

impl Judge {
    /// Follows each hole over the stretch, and adds its impulse to the net force's.
    pub(super) fn follow_holes(&mut self, step: &Step<'_>, series: &Series) {
        let Some(mut supports) = self.supports.take() else { return };
        let scene = std::sync::Arc::clone(&self.scene);
        for hole in scene.holes() {
            let (place, gap) = (hole.index, hole.gap);
            let mut sum = [0.0; 2];
            for (t, weight) in nodes(Panel::new(step.start, step.end, series.rate())) {
                let s = &mut self.series;
                series.state(t, &mut s.q, &mut s.v);
                let [y, z] = hole.offset(&s.q);
                let [py, pz] = series.hole_force(place, t);
                let (distance, force) = (y.hypot(z), py.hypot(pz));
                let pressure = if force > 0.0 { -(y * py + z * pz) / distance } else { 0.0 };
                let across = if force > 0.0 { ((y * pz - z * py) / distance).abs() } else { 0.0 };
                for (row, push) in [(&hole.at.y, py), (&hole.at.z, pz)] {
                    for &(i, share) in row.entries() {
                        s.net[i] += weight * share * push;
                    }
                }
                sum = [sum[0] + weight * py, sum[1] + weight * pz];
                let centre = hole.centre[0].abs() + hole.centre[1].abs();
                let speed = terms(hole.at, &s.v);
                let size = terms(hole.at, &s.q) + centre + gap + speed * t;
                self.walls.observe_force(&mut self.noise, place, (pressure, force), true);
                self.walls.observe_depth(place, distance - gap);
                self.walls.observe_gap(&self.noise, place, (gap - distance, size), pressure);
                if force > 0.0 {
                    let noise = force * self.noise.of(size) / gap + self.noise.wall_force(place);
                    supports.askew.observe(across, noise, self.noise.end, Some(place));
                }
            }
            // The impulse that the step tells, without the jump at its end, is that of this force.
            let (turned, normal, impulse) = (step.turned[place], step.normal[place], step.impulse[place]);
            let told = [0, 1].map(|axis: usize| turned[axis] - (impulse - step.jump[place]) * normal[axis]);
            let apart = (told[0] - sum[0]).hypot(told[1] - sum[1]);
            let length = step.end - step.start;
            let rounding = VECTOR_UNITS * f64::EPSILON * impulse / length;
            let force = apart / length - rounding;
            supports.askew.observe(force, self.noise.wall_force(place), self.noise.end, Some(place));
        }
        self.supports = Some(supports);
    }

    /// Checks the impulses of holes at the end of a step, and sums up what each hole gave in
    /// the step.
    pub(super) fn strike_holes(&mut self, step: &Step<'_>) {
        let Some(mut supports) = self.supports.take() else { return };
        let scene = std::sync::Arc::clone(&self.scene);
        supports.turned.fill(0.0);
        let alone = step.jump.iter().filter(|p| **p != 0.0).count() == 1;
        for hole in scene.holes() {
            let (place, gap, e) = (hole.index, hole.gap, hole.restitution);
            let [y, z] = hole.offset(step.q);
            let distance = y.hypot(z);
            self.walls.observe_depth(place, distance - gap);
            let jump = step.jump[place];
            supports.give(place, step.hole_push(place), step.impulse[place]);
            self.extent.speed = self.extent.speed.max(terms(hole.at, step.v)).max(terms(hole.at, &self.series.mid));
            self.walls.tension = self.walls.tension.max(-jump);
            let (Some(law), true) = (self.contract.promise.circle, jump != 0.0) else { continue };
            let speeds = terms(hole.at, step.v) + terms(hole.at, &self.series.mid);
            let centre = hole.centre[0].abs() + hole.centre[1].abs();
            let size = terms(hole.at, step.q) + centre + gap + speeds * step.end;
            let noise = self.noise.place(size);
            // An impulse has no finite force: wherever it acts, the gap must be 0.
            self.walls.gaps.add((gap - distance, noise), (f64::INFINITY, 0.0), self.noise.end, place);
            let [ny, nz] = [y / distance, z / distance];
            let along = |v: [f64; 2]| ny * v[0] + nz * v[1];
            let (before, after) = (along(hole.seen(&self.series.mid)), along(hole.seen(step.v)));
            let unit = self.noise.span.max(SHORTEST * self.scene.duration);
            let noise = self.noise.velocity(speeds, unit) + noise / gap * speeds;
            let slow = e * before <= law.tail * self.extent.speed;
            let mut missed = after.max(0.0);
            if alone && !(slow && after <= noise && after >= -e * before) {
                missed = missed.max((after + e * before).abs());
            }
            supports.struck.observe(missed, noise, self.noise.end, Some(place));
            // Along the normal there: the impulse that the step tells has the direction of n.
            let normal = step.normal[place];
            let askew = (normal[0] - ny).hypot(normal[1] - nz);
            supports.struck.excess.observe(speeds * askew - noise, self.noise.end, Some(place));
        }
        self.supports = Some(supports);
    }
}
