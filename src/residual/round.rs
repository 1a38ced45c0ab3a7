//! Checks of round holes against the scheme's promise ([`Turning`]), from the states and impulses
//! of a step: which holes are in reach, that they push along their normals and never pull, and that
//! the velocity at the end keeps the bound.

use super::Judge;
use super::brim::Brim;
use super::friction::FrictionImpulse;
use super::hole_motion::HoleMotion;
use super::largest_residual::Residual;
use super::place::Place;
use super::pushes::pushes;
use super::supports::Supports;
use crate::scene::{Hole, Scene};
use crate::step::{Bound, Normal, Step, Turning};
use pulp::Simd;

impl Judge {
    /// Checks round holes and friction, and adds their impulses to the momentum balance of the
    /// step; `beyond` says that blows add to the displacement of the step's rule.
    #[inline(always)]
    pub(super) fn supports_on_grid<S: Simd>(&mut self, simd: S, step: &Step<'_>, beyond: bool) {
        let (Some(mut supports), Some(places)) = (self.supports.take(), self.places.take()) else { return };
        for (hole, place) in places.scene.holes().zip(&places.holes) {
            if supports.turned[hole.index] == 0.0 && self.is_out_of_reach(simd, step, &hole, place) {
                supports.slid[hole.index] = f64::INFINITY;
            } else {
                self.check_hole(step, (&hole, place), beyond, &mut supports);
            }
        }
        if places.has_flats {
            self.rub_flats(step, &mut supports);
        }
        supports.pushed.copy_from_slice(step.impulse);
        for place in &places.flats {
            if !place.stays_below(self.extent.speed, step.velocity_after) {
                self.extent.speed = self.extent.speed.max(place.terms(step.velocity_after));
            }
        }
        if [step.impulse, step.friction].iter().any(|x| x.iter().any(|x| *x != 0.0)) {
            self.book_pushes(step, &places.scene, &mut supports);
        }
        (self.supports, self.places) = (Some(supports), Some(places));
    }

    /// Adds the impulses of holes and of friction to the balance of the step and to their sums.
    #[inline(never)]
    fn book_pushes(&mut self, step: &Step<'_>, scene: &Scene, supports: &mut Supports) {
        for (index, at, [push, rub]) in pushes(scene, step) {
            let force = [push[0] + rub[0], push[1] + rub[1]];
            at.y.add_transposed(-force[0], &mut self.scratch.residual);
            at.z.add_transposed(-force[1], &mut self.scratch.residual);
            if !scene.walls[index].is_round() {
                supports.rates[index] = [at.dot(step.velocity_before), at.dot(step.velocity_after)];
            }
            supports.give(index, force, force[0].hypot(force[1]));
        }
    }

    /// Checks one hole and its friction.
    #[inline(never)]
    fn check_hole(
        &mut self,
        step: &Step<'_>,
        (hole, place): (&Hole<'_>, &Place),
        beyond: bool,
        supports: &mut Supports,
    ) {
        let Some(did) = HolePush::of(step, hole.index) else { return };
        let motion = self.hole_motion(step, hole, place);
        let HoleMotion { before, after, struck, .. } = motion;
        supports.rates[hole.index] = [before.value, after.value];
        self.walls.observe_depth(hole.index, motion.end[0].hypot(motion.end[1]) - hole.gap);
        self.extent.speed = self.extent.speed.max(after.terms);
        let turned = &mut supports.turned[hole.index];
        self.hold_hole(step, (hole, &motion, &did), (beyond, *turned), &mut supports.askew);
        let lasts = matches!(self.contract.promise.round, Some(Turning { normal: Normal::Ahead(_), .. }));
        *turned = if lasts && hole.law.is_rigid() && did.impulse != 0.0 {
            let ([y, z], [vy, vz]) = (did.normal, motion.rate());
            turned.max(self.h * (y * vz - z * vy).abs() / hole.gap)
        } else {
            0.0
        };
        let rub = FrictionImpulse {
            place: hole.index,
            friction: hole.friction,
            impulse: [did.impulse, did.friction],
            tangent: [-did.normal[1], did.normal[0]],
        };
        let speeds = before.terms + after.terms + struck.terms;
        self.check_friction_of(&rub, supports, || (after.value, speeds));
    }

    /// Checks one hole, and notes the part of its force that is not along the normal in `askew`
    /// (N). `turned` is the largest angle by which its normal turned in a step of its contact so
    /// far, rad, 0 if it did not push in the step before.
    fn hold_hole(
        &mut self,
        step: &Step<'_>,
        (hole, motion, did): (&Hole<'_>, &HoleMotion, &HolePush),
        (beyond, turned): (bool, f64),
        askew: &mut Residual,
    ) {
        // In one piece: which bound holds depends on where the hole is in reach.
        let (place, gap) = (hole.index, hole.gap);
        let force = did.impulse.hypot(did.friction) / self.h;
        let pressure = did.impulse / self.h;
        self.walls.observe_force(&mut self.noise, place, (pressure, force), hole.law.is_rigid());
        if !hole.law.is_rigid() {
            let end = if beyond { hole.offset(&self.blows.arrived) } else { motion.end };
            return self.hold_ring(hole, motion, (did, end), askew);
        }
        match self.contract.promise.hole {
            Some(Bound::Along) => return self.hold_along(hole, motion, did, askew),
            Some(Bound::End) => self.hold_disk(hole, motion, pressure),
            _ => {}
        }
        let Some(turning) = self.contract.promise.round else {
            return self.along_end(hole, motion, did, askew);
        };
        let (start, end, after, rate) = (motion.start, motion.end, motion.after.value, motion.rate());
        let ahead = [0, 1].map(|i: usize| match turning.normal {
            Normal::Ahead(part) => start[i] + part * self.h * rate[i],
            Normal::Middle(_) => start[i] + end[i],
        });
        let reach = ahead[0].hypot(ahead[1]);
        let speeds = motion.before.terms + motion.after.terms + motion.struck.terms;
        let place_noise = self.noise.of(motion.size + self.h * speeds);
        let middle = matches!(turning.normal, Normal::Middle(_));
        let far = if middle { end[0].hypot(end[1]) } else { reach };
        let way = far - gap * (1.0 - turning.touching);
        // Of a bound on the displacement, rounding is as large as the solver's tolerance.
        let closes = middle && did.impulse != 0.0;
        let (brim, distance) = (Brim::new(&turning, gap, (rate, self.h), turned), start[0].hypot(start[1]));
        // In the units of rounding.
        let (way, keeps) = (way / (place_noise + turning.touching * gap), brim.keeps(distance, reach) / place_noise);
        let furthest = way.max(keeps);
        let (reached, edge) = (furthest >= 0.0 || closes, furthest.abs() <= 1.0);
        if !reached && !edge {
            return self.walls.observe_law(&self.noise, place, force, 0.0);
        }
        if edge && force == 0.0 {
            // Rounding decides whether the hole is in reach: either is accepted.
            return;
        }
        let crosses = crosses(&turning, did.normal, [(ahead, reach), (end, far)], gap, place_noise);
        let (ahead, reach) = if crosses { (end, far) } else { (ahead, reach) };
        let normal = ahead.map(|x| x / reach);
        let wedged = self.contract.promise.friction.is_some() && step.wedged.contains(&place);
        let left = |touches| {
            let bound = bound(hole.restitution, (start, rate, normal), touches);
            bound.max(if wedged { 0.0 } else { f64::MIN }) - (normal[0] * after[0] + normal[1] * after[1])
        };
        let brim = brim.passed(if crosses { 0.0 } else { distance });
        let mut slack = left(brim >= 0.0);
        // Rounding may decide whether the body touched at the start.
        if brim.abs() <= place_noise {
            let other = left(brim < 0.0);
            slack = if other.abs() < slack.abs() { other } else { slack };
        }
        let noise = self.noise.velocity(speeds, self.noise.span) + place_noise / gap * speeds;
        self.walls.observe_rebound(&self.noise, place, (slack, noise), pressure);
        if force != 0.0 {
            let across = force * (did.normal[0] - normal[0]).hypot(did.normal[1] - normal[1]);
            let noise = force * place_noise / reach + self.noise.wall_force(place);
            askew.observe(across, noise, self.noise.end, Some(place));
        }
    }
}

/// True if the body comes through the middle of the hole, so that the step's end gives the normal:
/// by the promise it is `ahead`, at the distance `reach` from the centre, and at the `end` of the
/// step `far` from it.
fn crosses(
    turning: &Turning,
    normal: [f64; 2],
    [(ahead, reach), (end, far)]: [([f64; 2], f64); 2],
    gap: f64,
    place_noise: f64,
) -> bool {
    let Normal::Middle(share) = turning.normal else { return false };
    let apart = |at: [f64; 2], r: f64| (normal[0] - at[0] / r).hypot(normal[1] - at[1] / r);
    let inside = reach - 2.0 * share * gap;
    // Rounding may decide: then the hole's own normal says which it was.
    if inside.abs() <= place_noise { apart(end, far) < apart(ahead, reach) } else { inside < 0.0 }
}

/// The impulse of a hole in a step on a grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct HolePush {
    pub normal: [f64; 2],
    pub impulse: f64,
    pub friction: f64,
}

impl HolePush {
    pub fn of(step: &Step<'_>, place: usize) -> Option<Self> {
        let (normal, impulse, friction) =
            (step.normal.get(place)?, step.impulse.get(place)?, step.friction.get(place)?);
        Some(Self { normal: *normal, impulse: *impulse, friction: *friction })
    }
}

/// The bound on n·ẇ⁺ of a body that `touches` the hole at the start of the step, or comes from
/// inside.
fn bound(e: f64, (start, rate, normal): ([f64; 2], [f64; 2], [f64; 2]), touches: bool) -> f64 {
    let a = normal[0] * rate[0] + normal[1] * rate[1];
    if a <= 0.0 {
        return -a;
    }
    let along = (start[0] * rate[0] + start[1] * rate[1]) / start[0].hypot(start[1]);
    let arriving = if touches { along.max(0.0).min(a) } else { a };
    -(e * arriving + (a - arriving))
}
