//! `implicit-euler` with round holes: as [`super::super::position`] at θ = 1, with disks.
//!
//! A rigid hole takes all of the speed at which a body arrives (e = 0). A body that slides moves on
//! chords, whose ends lie on the circle: each step takes the part of its speed that the turning of
//! the normal brings along the next one, a rate of h v²/γ².

use super::disk_programme::DiskProgramme;
use super::hole_body::HoleBody;
use crate::error::Result;
use crate::linear::Symmetric;
use crate::scene::Scene;

#[derive(Debug)]
pub(super) struct Position {
    pub bounds: DiskProgramme,
    b: Vec<f64>,
}

impl Position {
    pub fn new(scene: &Scene, held: &HoleBody) -> Result<Self> {
        let (h, m) = (held.body.h, &held.body.matrices);
        let a = Symmetric::sum(&[(1.0 / (h * h), &m.mass), (1.0 / h, &m.damping), (1.0, &m.stiffness)]);
        let bounds = DiskProgramme::new(scene, a, scene.gap_scale(), |spring| 1.0 / spring.stiffness_over(h))?;
        Ok(Self { bounds, b: vec![0.0; held.body.n] })
    }

    /// Makes a step.
    pub fn advance(&mut self, step: u64, held: &mut HoleBody) -> Result<()> {
        let (h, b) = (held.body.h, &mut self.b);
        let (body, frame) = (&mut held.body, &mut held.frame);
        body.load_at(frame.end);
        body.applied(frame, b);
        body.mass.add_product(1.0 / h, &frame.v, b);
        body.stiffness.add_product(-1.0, &frame.q, b);
        frame.before.clone_from(&frame.v);
        frame.blown = body.strike((frame.start, frame.end), 1.0 / h, b, frame);
        let blown = body.find_blows(&[(frame.start, frame.end, frame.start)]);
        if blown {
            body.damp_shift(1.0 / h, b);
        }
        self.bind(held, blown);
        self.bounds.solve(&self.b, (held.frame.start, step))?;
        let frame = &mut held.frame;
        for ((q, v), delta) in frame.q.iter_mut().zip(&mut frame.v).zip(self.bounds.x()) {
            *q += delta;
            *v = delta / h;
        }
        if blown {
            held.body.shift(&mut frame.q);
        }
        frame.after.clone_from(&frame.v);
        for &wall in &held.flats {
            frame.force[wall] = self.bounds.of_wall(wall);
        }
        frame.push_by_force(h);
        for hole in 0..held.rounds.len() {
            held.push_hole(hole, h, self.bounds.of_hole(held.index(hole)));
        }
        Ok(())
    }

    /// Sets the bounds on Δ. Those of rigid walls and holes apply to the displacement with that by
    /// the blows.
    fn bind(&mut self, held: &HoleBody, blown: bool) {
        let (body, q) = (&held.body, &held.frame.q);
        let shift = body.blows.as_ref().filter(|_| blown).map(|blows| &blows.shift);
        for (wall, face) in held.flats.iter().map(|&wall| (wall, body.walls[wall])) {
            let w = body.seen(wall, q);
            let bound = match face.law.spring() {
                // As in implicit-euler between walls: |r| = k_a s⁺ + c_a(s⁺ − s₊)/h.
                Some(spring) => -spring.force(w, face.g, face.plate(w), body.h) / spring.stiffness_over(body.h),
                None => face.g - w - shift.map_or(0.0, |shift| body.seen(wall, shift)),
            };
            self.bounds.bind_wall(wall, face, bound);
        }
        for hole in 0..held.rounds.len() {
            let now = held.offset(hole, q);
            let given = match shift {
                Some(shift) if held.rounds[hole].law.is_rigid() => held.seen(hole, shift),
                _ => [0.0; 2],
            };
            let disk = held.disk(hole, now, [now[0] + given[0], now[1] + given[1]]);
            self.bounds.bind_hole(held.index(hole), disk);
        }
    }
}
