//! `moreau-jean` with elastic rings: as [`super::super::supports`] without friction, where each
//! ring is a disk on the displacement at θ that yields.
//!
//! With w_θ = (1−θ)w + θw⁺ and r₊ = max(|w|, γ) the pressure of a ring over the step is k_a(|w_θ| −
//! γ) + c_a(|w_θ| − r₊)/θh, at least 0, towards the centre from w_θ. Rigid holes and walls keep
//! their bounds on the velocity; all together are one programme.

use super::super::supports::hole_state;
use super::disk_programme::DiskProgramme;
use super::hole_body::HoleBody;
use crate::error::Result;
use crate::qp::DiskBound;
use crate::scene::Scene;

#[derive(Debug)]
pub(super) struct Velocity {
    theta: f64,
    pub bounds: DiskProgramme,
    b: Vec<f64>,
    /// The largest angle by which the normal of each hole turned in a step since its contact began,
    /// 0 between steps if it did not push in the last one.
    turned: Vec<f64>,
}

impl Velocity {
    pub fn new(scene: &Scene, theta: f64, held: &HoleBody) -> Result<Self> {
        let ht = held.body.h * theta;
        let (a, scale) = (held.body.theta_matrix(theta), scene.gap_scale() / held.body.h);
        let turned = vec![0.0; held.rounds.len()];
        let bounds = DiskProgramme::new(scene, a, scale, |spring| spring.compliance(ht))?;
        Ok(Self { theta, bounds, b: vec![0.0; held.body.n], turned })
    }

    /// Forgets the last step.
    pub fn restart(&mut self) {
        self.turned.fill(0.0);
    }

    /// Makes a step.
    pub fn advance(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        let (h, theta) = (held.body.h, self.theta);
        let (body, frame) = (&mut held.body, &mut held.frame);
        body.theta_momentum(theta, frame, &mut self.b);
        frame.blown = body.strike((frame.start, frame.end), 1.0, &mut self.b, frame);
        self.bind(held);
        self.solve(step, held)?;
        let carried = held.body.blows.is_some() && self.solve_with_blows(step, held)?;
        held.frame.add_change((h, theta), self.bounds.x());
        if carried {
            held.body.shift(&mut held.frame.q);
        }
        for (hole, turned) in self.turned.iter_mut().enumerate() {
            if held.frame.impulse[held.index(hole)] <= 0.0 {
                *turned = 0.0;
            }
        }
        Ok(())
    }

    /// Sets the bounds on δ = v⁺ − v.
    fn bind(&mut self, held: &HoleBody) {
        let (h, ht) = (held.body.h, held.body.h * self.theta);
        for (wall, face) in held.flats.iter().map(|&wall| (wall, held.body.walls[wall])) {
            let seen = |x: &Vec<f64>| held.body.seen(wall, x);
            let (w, before, struck) = (seen(&held.frame.q), seen(&held.frame.v), seen(held.frame.struck()));
            match (face.law.spring(), face.law.restitution()) {
                // As in moreau-jean: the row exceeds a bound on δ by compliance times impulse.
                (Some(spring), _) => {
                    let offset = h * spring.force(w + ht * before, face.g, face.plate(w), ht);
                    self.bounds.bind_wall(wall, face, -offset / (ht * ht * spring.stiffness_over(ht)));
                }
                (_, Some(restitution)) if face.depth(w + 0.5 * h * struck) >= -held.body.touch => {
                    let epsilon = if face.sign * struck <= 0.0 { restitution } else { 1.0 };
                    self.bounds.bind_wall(wall, face, -epsilon * struck - before);
                }
                _ => self.bounds.open_wall(wall),
            }
        }
        for hole in 0..held.rounds.len() {
            let (now, rate) = (held.offset(hole, &held.frame.q), held.seen(hole, &held.frame.v));
            let round = held.rounds[hole];
            let bound = match round.law.spring() {
                Some(spring) => {
                    // In δ: w_θ = w + hθ ẇ + hθ² δ.
                    let per = 1.0 / (ht * self.theta);
                    DiskBound::Disk {
                        centre: [0, 1].map(|i: usize| -(now[i] + ht * rate[i]) * per),
                        radius: spring.freed_radius(round.gap, now, ht) * per,
                    }
                }
                None => {
                    let struck = held.seen(hole, held.frame.struck());
                    let e = round.law.restitution().unwrap_or(0.0);
                    match hole_state((round.gap, e), [now, struck], h, self.turned[hole]) {
                        None => DiskBound::OPEN,
                        Some(met) => {
                            self.turned[hole] = met.turned;
                            let [y, z] = met.normal;
                            let hi = met.bound - (y * rate[0] + z * rate[1]);
                            DiskBound::Strip { normal: met.normal, lo: f64::NEG_INFINITY, hi }
                        }
                    }
                }
            };
            self.bounds.bind_hole(held.index(hole), bound);
        }
    }

    /// Solves for δ, and writes the impulses.
    fn solve(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        let (h, frame) = (held.body.h, &mut held.frame);
        self.bounds.solve(&self.b, (frame.start, step))?;
        for &wall in &held.flats {
            let p = self.bounds.of_wall(wall);
            if p != 0.0 {
                frame.push(wall, p, h);
            }
        }
        for hole in 0..held.rounds.len() {
            held.push_hole(hole, 1.0, self.bounds.of_hole(held.index(hole)));
        }
        Ok(())
    }

    /// As in moreau-jean: solves again with the displacement that the blows cause in addition to
    /// the rule's, unless they drive the structure into a rigid wall or hole that pushes. Returns
    /// whether that displacement must be added.
    #[inline(never)]
    fn solve_with_blows(&mut self, step: u64, held: &mut HoleBody) -> Result<bool> {
        let (start, end, h) = (held.frame.start, held.frame.end, held.body.h);
        if !held.body.find_blows(&[(start, end, end - h * self.theta)]) || self.answers(held) {
            return Ok(false);
        }
        if held.body.damped {
            held.frame.take_back_impulses();
            held.body.damp_shift(1.0, &mut self.b);
            self.solve(step, held)?;
        }
        Ok(true)
    }

    fn answers(&self, held: &HoleBody) -> bool {
        let Some(blows) = &held.body.blows else { return false };
        held.frame.pushing.iter().any(|&index| match held.hole(index) {
            None => held.body.drives(index),
            Some(hole) => {
                let ([vy, vz], [y, z]) = (held.seen(hole, &blows.given), held.frame.normal[index]);
                held.rounds[hole].law.is_rigid() && y * vy + z * vz > 0.0
            }
        })
    }
}
