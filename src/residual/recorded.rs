//! The momentum balance of a whole run, from its recorded trajectory.

use crate::scene::{Face, Loads, Row, Scene, heading};
use crate::trajectory::Trajectory;

/// The residual of a run's momentum balance with the recorded impulses of the walls,
///
/// M(v_end − v_start) + C(q_end − q_start) = ∫(f − K q) dt + Σ J + Gᵀ Σ p,
///
/// with the integral taken by the trapezoid rule over the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Momentum {
    /// The largest difference of the two sides over the degrees of freedom, N s.
    pub residual_n_s: f64,
    /// Error of the trapezoid rule at the ends, as a bound: the largest force of the right-hand
    /// side, walls included, times the spacing of the rows, N s.
    pub step_n_s: f64,
    /// The largest momentum exchanged on a degree of freedom: Σ|p| and ∫|f − K q| dt, N s.
    pub exchanged_n_s: f64,
}

/// The momentum balance of a whole run, from the rows of `trajectory` alone: whatever balance a
/// scheme fulfils in each step, the recorded impulses must account for the change of momentum from
/// the first row to the last. `scene` is the one that the scheme saw (under a penalty scheme rigid
/// walls have become springs, whose impulses are recorded all the same).
///
/// Every step must be recorded, so that the trapezoid rule sums the same instants as the scheme:
/// sums with the weights of two such rules differ at the two ends only, by a step or so, however
/// long the run. `None` unless every degree of freedom has a probe of its own.
#[must_use]
pub fn momentum(scene: &Scene, trajectory: &Trajectory) -> Option<Momentum> {
    let n = scene.system.degrees_of_freedom();
    let column = |i: usize| {
        let probe = scene.probes.iter().position(|probe| probe.at == Row::dof(i))?;
        Some((trajectory.displacements().get(probe)?, trajectory.velocities().get(probe)?))
    };
    let columns: Vec<(&Vec<f64>, &Vec<f64>)> = (0..n).map(column).collect::<Option<_>>()?;
    let time = trajectory.time();
    let (first, last) = (*time.first()?, *time.last()?);
    let loads = Loads::new(&scene.loads);
    // The residual of each balance. Loads' impulses are summed here, except the one at the start,
    // which is in the state there.
    let (mut open, mut exchanged) = (vec![0.0; n], vec![0.0_f64; n]);
    let (mut q, mut force, mut before) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let (mut largest, mut spacing) = (0.0_f64, 0.0_f64);
    for (row, &t) in time.iter().enumerate() {
        q.iter_mut().zip(&columns).for_each(|(q, column)| *q = column.0.get(row).copied().unwrap_or(f64::NAN));
        force.fill(0.0);
        loads.add_force(t, 1.0, &mut force);
        scene.system.add_stiffness(-1.0, &q, &mut force);
        if row > 0 {
            let h = t - time[row - 1];
            spacing = spacing.max(h);
            for i in 0..n {
                open[i] -= 0.5 * h * (before[i] + force[i]);
                exchanged[i] += 0.5 * h * (before[i].abs() + force[i].abs());
            }
        }
        largest = force.iter().fold(largest, |largest, f| largest.max(f.abs()));
        before.copy_from_slice(&force);
    }
    let change = |column: &[f64]| column.last().zip(column.first()).map_or(f64::NAN, |(last, first)| last - first);
    let [moved, sped]: [Vec<f64>; 2] =
        [columns.iter().map(|(q, _)| change(q)).collect(), columns.iter().map(|(_, v)| change(v)).collect()];
    scene.system.add_mass(1.0, &sped, &mut open);
    scene.system.add_damping(1.0, &moved, &mut open);
    loads.blow(first, last, &mut force);
    open.iter_mut().zip(&force).for_each(|(open, blow)| *open -= blow);
    for (wall, impulses) in scene.walls.iter().zip(trajectory.contact_impulses()) {
        let (sum, sizes) = impulses.iter().fold((0.0, 0.0), |(sum, sizes), p| (sum + p, sizes + f64::abs(*p)));
        let most = impulses.iter().fold(0.0, |most, p| f64::max(most, p.abs()));
        for &(i, weight) in wall.row().entries() {
            if let (Some(open), Some(exchanged)) = (open.get_mut(i), exchanged.get_mut(i)) {
                *open -= weight * sum;
                *exchanged += weight.abs() * sizes;
            }
        }
        // The impulse of a row is the force over it times the spacing.
        largest = largest.max(if spacing > 0.0 { most / spacing } else { 0.0 });
    }
    // Friction of the flats of each support, and round supports.
    let mut add = |row: &Row, column: &[f64], weight: f64| {
        let (sum, sizes) = column.iter().fold((0.0, 0.0), |(sum, sizes), p| (sum + p, sizes + f64::abs(*p)));
        let most = column.iter().fold(0.0, |most, p| f64::max(most, p.abs()));
        for &(i, share) in row.entries() {
            if let (Some(open), Some(exchanged)) = (open.get_mut(i), exchanged.get_mut(i)) {
                *open -= weight * share * sum;
                *exchanged += (weight * share).abs() * sizes;
            }
        }
        largest = largest.max(if spacing > 0.0 { most / spacing } else { 0.0 });
    };
    for (hole, [y, z]) in scene.holes().zip(trajectory.hole_impulses()) {
        add(&hole.at.y, y, 1.0);
        add(&hole.at.z, z, 1.0);
    }
    for (index, wall) in scene.walls.iter().enumerate() {
        let (Some(column), Some(support)) = (trajectory.friction_impulses().get(index), scene.support_of(index)) else {
            continue;
        };
        let Face::Flat { direction: Some(degrees), .. } = wall.face else { continue };
        let [y, z] = heading(degrees);
        add(&support.at.y, column, -z);
        add(&support.at.z, column, y);
    }
    let worst = |x: &[f64]| x.iter().fold(0.0, |worst, x| f64::max(worst, x.abs()));
    Some(Momentum { residual_n_s: worst(&open), step_n_s: largest * spacing, exchanged_n_s: worst(&exchanged) })
}
