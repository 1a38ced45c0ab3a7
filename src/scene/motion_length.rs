//! The length over which the initial velocity and the loads move a structure: the scale of a scene
//! whose walls stand where it starts.

use super::load::LoadKind;
use super::{Face, Scene, Wall};
use std::f64::consts::TAU;

/// A throw is no shorter than this share of the way that the force which ends it moves a free body:
/// a start of 1e-20 m/s says nothing of lengths.
const SHORTEST: f64 = 1e-9;

/// What moves a degree of freedom by itself.
#[derive(Debug, Clone, Copy, Default)]
struct Motion {
    /// Its initial speed and the changes of it by blows, m/s.
    speed: f64,
    /// Its acceleration by the constant loads, m/s².
    constant: f64,
    /// How far the loads that change move it, m.
    varying: f64,
    /// The least of √(m/k) and the duration, s.
    time: f64,
}

impl Scene {
    /// The largest length of the motion of a degree of freedom by itself, m; 0 where nothing moves.
    /// With the acceleration a by a load, and the time τ, the least of √(m/k), of 1/Ω of a harmonic
    /// load and of the duration, it is |v| τ of the initial velocity (an amplitude, or the way of a
    /// free body), but v²/|a| where a constant load presses the body against a wall (a throw); and
    /// |a| τ² of each load, but of a constant one that presses against a wall only where nothing
    /// else moves. Functions of time, which may be a user's code, are not called and count as none.
    pub(super) fn length_of_motion(&self) -> f64 {
        let motions = self.motions();
        let held = |i: usize, motion: &Motion| self.walls.iter().any(|wall| holds(wall, i, motion.constant));
        let length = |(i, motion): (usize, &Motion)| {
            let Motion { speed, constant, varying, time } = *motion;
            let (pull, way) = (constant.abs(), constant.abs() * time * time);
            let throw = (speed * time.min(speed / pull)).max(SHORTEST * way);
            match (pull > 0.0 && held(i, motion), speed > 0.0) {
                (true, true) => varying.max(throw),
                (true, false) => varying,
                (false, _) => varying.max(speed * time).max(way),
            }
        };
        let moved = motions.iter().enumerate().map(length).fold(0.0, f64::max);
        if moved > 0.0 {
            return moved;
        }
        motions.iter().map(|motion| motion.constant.abs() * motion.time * motion.time).fold(0.0, f64::max)
    }

    /// The largest way by which the loads that change move a degree of freedom by itself, m: the
    /// part of [`Self::length_of_motion`] in which neither the start nor the duration has a part.
    pub(super) fn length_of_vibration(&self) -> f64 {
        let all = self.clone().with_duration(f64::INFINITY).motions();
        all.iter().map(|motion| motion.varying).filter(|length| length.is_finite()).fold(0.0, f64::max)
    }

    fn motions(&self) -> Vec<Motion> {
        let structure = self.system.structure();
        let mass = structure.mass.diagonal_entries();
        let start = |((v, m), k): ((&f64, &f64), f64)| {
            let time = if k > 0.0 { (m / k).sqrt().min(self.duration) } else { self.duration };
            Motion { speed: v.abs(), time, ..Motion::default() }
        };
        let stiffness = structure.stiffness.diagonal_entries();
        let mut motions: Vec<Motion> = self.initial.v.iter().zip(&mass).zip(stiffness).map(start).collect();
        for load in &self.loads {
            let table = match &load.kind {
                LoadKind::Table(table) => table.force().iter().fold(0.0, |most: f64, force| most.max(force.abs())),
                _ => 0.0,
            };
            for &(i, weight) in load.at.entries() {
                let (Some(motion), Some(m)) = (motions.get_mut(i), mass.get(i)) else { continue };
                let (by, time) = (weight / m, motion.time);
                match load.kind {
                    LoadKind::Constant { force } => motion.constant += by * force,
                    LoadKind::Harmonic { amplitude, frequency, .. } => {
                        motion.varying += (by * amplitude).abs() * time.min(1.0 / (TAU * frequency)).powi(2);
                    }
                    LoadKind::Impulse { impulse, .. } => motion.speed += (by * impulse).abs(),
                    LoadKind::Table(_) => motion.varying += by.abs() * table * time * time,
                    LoadKind::Function(_) => {}
                }
            }
        }
        motions
    }
}

/// True if the wall holds degree of freedom `i` against a force of this sign.
fn holds(wall: &Wall, i: usize, force: f64) -> bool {
    let feels = |weight: f64| match wall.face {
        Face::Flat { side, .. } => side.sign() * weight * force < 0.0,
        Face::Round { .. } => true,
    };
    wall.row().entries().iter().any(|&(at, weight)| at == i && feels(weight))
}

#[cfg(test)]
mod tests {
    use crate::scene::{Load, Scene, Table, Wall};

    /// A body of 1 kg on 100 N/m (ω = 10 rad/s) between walls where it starts.
    fn snug() -> Scene {
        let walls = [Wall::upper("upper", 0.0), Wall::lower("lower", 0.0)];
        walls.into_iter().fold(Scene::oscillator(1.0, 0.0, 100.0), Scene::with_wall).with_duration(3.0)
    }

    /// Fails unless the gap scale is `length` (m) but for the rounding of some products.
    fn assert_scale(scene: &Scene, length: f64) {
        let scale = scene.gap_scale();
        assert!((scale / length - 1.0).abs() < 1e-14, "{scale:e} for {length:e}");
    }

    #[test]
    fn at_walls_where_the_body_starts_the_gap_scale_is_an_amplitude() {
        assert_scale(&snug(), 1.0);
        // v/ω, and the deflection F/k.
        assert_scale(&snug().with_initial(&[0.0], &[-2e-9]), 2e-10);
        assert_scale(&snug().with_load(Load::impulse(2e-9, 0.5)), 2e-10);
        let table = Table::new(vec![0.0, 0.5], vec![-3e-7, 1e-7]).unwrap();
        let loads = [Load::constant(-3e-7), Load::harmonic(-3e-7, 1.0, 0.0), Load::table(table)];
        for load in loads {
            assert_scale(&snug().with_load(load), 3e-9);
        }
        assert_scale(&snug().with_load(Load::function(|_| panic!("called"))), 1.0);
        // Faster than the body's own vibration: A/mΩ².
        let omega = 200.0;
        let fast = Load::harmonic(3e-7, omega / std::f64::consts::TAU, 0.0);
        assert_scale(&snug().with_load(fast), 3e-7 / (omega * omega));
    }

    #[test]
    fn of_a_free_body_on_a_wall_the_gap_scale_is_a_throw_or_the_way_in_the_run() {
        let ball = Scene::oscillator(2.0, 0.0, 0.0).with_wall(Wall::lower("floor", 0.0)).with_duration(3.0);
        let thrown = ball.clone().with_initial(&[0.0], &[4e-9]);
        assert_scale(&thrown, 12e-9);
        let weight = Load::constant(-4e-8);
        assert_scale(&thrown.clone().with_load(weight.clone()), 8e-10);
        // Away from the wall a slow start counts for nothing.
        assert_scale(&thrown.with_load(Load::constant(4e-2)), 18e-2);
        assert_scale(&ball.clone().with_initial(&[0.0], &[1e-20]).with_load(weight.clone()), 18e-17);
        // Nothing but its weight: it lies there.
        assert_scale(&ball.with_load(weight), 18e-8);
    }
}
