//! Checks of round holes along a structure's exact motion against the promise
//! ([`Circle`](crate::step::Circle)), from the state at each node of the stretch, the force there,
//! and the velocities before and after the instant that ends it.

use super::Judge;
use super::pushes::terms;
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
    /// Follows each hole over the stretch, and adds its impulse to `residual`.
    pub(super) fn follow_holes(&mut self, step: &Step<'_>, series: &Series) {
        let Some(mut supports) = self.supports.take() else { return };
        let scene = std::sync::Arc::clone(&self.scene);
        let (span, clock) = (self.span, self.clock);
        for (hole, &(index, gap, _)) in supports.holes.iter().enumerate() {
            let (Some(support), Some(did)) = (scene.supports.get(index), step.holes.get(hole)) else { continue };
            let place = scene.walls.len() + hole;
            let mut sum = [0.0; 2];
            for (t, weight) in nodes(Panel::new(step.start, step.end, series.rate())) {
                let s = &mut self.scratch;
                series.state(t, &mut s.mean_q, &mut s.mean_v);
                let [y, z] = support.offset(&s.mean_q);
                let [py, pz] = series.hole_force(hole, t);
                let (distance, force) = (y.hypot(z), py.hypot(pz));
                let pressure = if force > 0.0 { -(y * py + z * pz) / distance } else { 0.0 };
                let across = if force > 0.0 { ((y * pz - z * py) / distance).abs() } else { 0.0 };
                for (row, push) in [(&support.at.y, py), (&support.at.z, pz)] {
                    for &(i, share) in row.entries() {
                        s.residual[i] += weight * share * push;
                    }
                }
                sum = [sum[0] + weight * py, sum[1] + weight * pz];
                let centre = support.centre[0].abs() + support.centre[1].abs();
                let speed = terms(support, &s.mean_v);
                let size = terms(support, &s.mean_q) + centre + gap + speed * t;
                self.force_scale = self.force_scale.max(force);
                self.tension = self.tension.max(-pressure);
                self.rounding.push(place, force, true);
                if let Some(depth) = supports.depth.get_mut(hole) {
                    *depth = depth.max(distance - gap);
                }
                let slack = gap - distance;
                self.pairs.add(slack, pressure);
                let force_noise = self.rounding.wall_force(place, span, clock);
                if slack < 0.0 || pressure != 0.0 {
                    let noise = self.rounding.met(size, self.energy.gap_scale);
                    self.doubts.gaps.add((slack, noise), (pressure, force_noise), self.now, place);
                }
                if force > 0.0 {
                    supports.askew = supports.askew.max(across);
                    let turned = force * self.rounding.of(size) / gap;
                    supports.doubt.see(across - turned - force_noise, self.now, Some(place));
                }
            }
            // The impulse that the step tells, without the jump at its end, is that of this force.
            let told = [0, 1].map(|axis: usize| did.turned[axis] - (did.impulse - did.jump) * did.normal[axis]);
            let apart = (told[0] - sum[0]).hypot(told[1] - sum[1]);
            let length = step.end - step.start;
            let rounding = VECTOR_UNITS * f64::EPSILON * did.impulse / length;
            supports.askew = supports.askew.max((apart / length - rounding).max(0.0));
            let noise = rounding + self.rounding.wall_force(place, span, clock);
            supports.doubt.see(apart / length - noise, self.now, Some(place));
        }
        self.supports = Some(supports);
    }

    /// Checks the impulses of holes at the end of a step, before which the velocity is `spring`
    /// (m/s), and sums up what each hole gave in the step.
    pub(super) fn strike_holes(&mut self, step: &Step<'_>) {
        let Some(mut supports) = self.supports.take() else { return };
        let scene = std::sync::Arc::clone(&self.scene);
        let jumps = step.jump.iter().filter(|p| **p != 0.0).count();
        let alone = jumps + step.holes.iter().filter(|did| did.jump != 0.0).count() == 1;
        for (hole, &(index, gap, e)) in supports.holes.iter().enumerate() {
            let (Some(support), Some(did)) = (scene.supports.get(index), step.holes.get(hole)) else { continue };
            let place = scene.walls.len() + hole;
            let [y, z] = support.offset(step.q);
            let distance = y.hypot(z);
            if let Some(depth) = supports.depth.get_mut(hole) {
                *depth = depth.max(distance - gap);
            }
            let push = did.push();
            if let (Some(sum), Some(size)) = (supports.impulse.get_mut(index), supports.size.get_mut(index)) {
                *sum = [sum[0] + push[0], sum[1] + push[1]];
                *size += did.impulse;
            }
            self.extent.speed = self.extent.speed.max(terms(support, step.v)).max(terms(support, &self.scratch.spring));
            self.tension = self.tension.max(-did.jump);
            let (Some(law), true) = (self.contract.promise.circle, did.jump != 0.0) else { continue };
            let speeds = terms(support, step.v) + terms(support, &self.scratch.spring);
            let centre = support.centre[0].abs() + support.centre[1].abs();
            let size = terms(support, step.q) + centre + gap + speeds * step.end;
            let noise = self.rounding.met(size, self.energy.gap_scale);
            // An impulse has no finite force: wherever it acts, the gap must be 0.
            self.pairs.add((gap - distance).max(0.0), f64::INFINITY);
            self.doubts.gaps.add((gap - distance, noise), (f64::INFINITY, 0.0), self.now, place);
            let [ny, nz] = [y / distance, z / distance];
            let along = |v: [f64; 2]| ny * v[0] + nz * v[1];
            let (before, after) = (along(support.seen(&self.scratch.spring)), along(support.seen(step.v)));
            let unit = self.span.max(SHORTEST * self.scene.duration);
            let noise = self.rounding.met(speeds, self.energy.gap_scale / unit) + noise / gap * speeds;
            let slow = before <= law.tail * self.extent.speed;
            let mut missed = after.max(0.0);
            if alone && !(slow && after <= noise && after >= -e * before) {
                missed = missed.max((after + e * before).abs());
            }
            supports.struck = supports.struck.max(missed);
            supports.struck_doubt.see(missed - noise, self.now, Some(place));
            // Along the normal there: the impulse that the step tells has the direction of n.
            let askew = (did.normal[0] - ny).hypot(did.normal[1] - nz);
            supports.struck_doubt.see(speeds * askew - noise, self.now, Some(place));
        }
        self.supports = Some(supports);
    }
}
