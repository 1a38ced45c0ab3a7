//! The momentum balance of a whole run, from its recorded trajectory.

use signorini::{Face, Loads, Row, Scene, Trajectory, heading};

/// The residual of a run's momentum balance with the recorded impulses of the walls,
///
/// M(v_end − v_start) + C(q_end − q_start) = ∫(f − K q) dt + Σ J + Gᵀ Σ p,
///
/// with the integral taken by the trapezoid rule over the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    let mut sums = Sums::new(scene.system.degrees_of_freedom());
    let loads = Loads::new(&scene.loads);
    sums.integrate(scene, &loads, time, &columns);
    let change = |column: &[f64]| column.last().zip(column.first()).map_or(f64::NAN, |(last, first)| last - first);
    let [moved, sped]: [Vec<f64>; 2] =
        [columns.iter().map(|(q, _)| change(q)).collect(), columns.iter().map(|(_, v)| change(v)).collect()];
    scene.system.add_mass(1.0, &sped, &mut sums.open);
    scene.system.add_damping(1.0, &moved, &mut sums.open);
    // Loads' impulses are summed here, except the one at the start, which is in the state there.
    let mut blow = vec![0.0; n];
    loads.blow(first, last, &mut blow);
    sums.open.iter_mut().zip(&blow).for_each(|(open, blow)| *open -= blow);
    for (wall, impulses) in scene.walls.iter().zip(trajectory.contact_impulses()) {
        sums.push(wall.row(), impulses, 1.0);
    }
    for (hole, [y, z]) in scene.holes().zip(trajectory.hole_impulses()) {
        sums.push(&hole.at.y, y, 1.0);
        sums.push(&hole.at.z, z, 1.0);
    }
    // Friction of the flats of each support.
    for (index, wall) in scene.walls.iter().enumerate() {
        let (Some(column), Some(support)) = (trajectory.friction_impulses().get(index), scene.support_of(index)) else {
            continue;
        };
        let Face::Flat { direction: Some(degrees), .. } = wall.face else { continue };
        let [y, z] = heading(degrees);
        sums.push(&support.at.y, column, -z);
        sums.push(&support.at.z, column, y);
    }
    let worst = |x: &[f64]| x.iter().fold(0.0, |worst, x| f64::max(worst, x.abs()));
    Some(Momentum {
        residual_n_s: worst(&sums.open),
        step_n_s: sums.largest * sums.spacing,
        exchanged_n_s: worst(&sums.exchanged),
    })
}

/// The two sides of the balance, summed over the rows.
struct Sums {
    /// The residual of each degree of freedom, N s.
    open: Vec<f64>,
    /// The momentum exchanged on each, N s.
    exchanged: Vec<f64>,
    /// The largest force of the right-hand side in any row, N.
    largest: f64,
    /// The largest distance of two rows, s.
    spacing: f64,
}

impl Sums {
    fn new(n: usize) -> Self {
        Self { open: vec![0.0; n], exchanged: vec![0.0; n], largest: 0.0, spacing: 0.0 }
    }

    /// Takes ∫(f − K q) dt off the residual; `columns` are q and v of each degree of freedom.
    fn integrate(&mut self, scene: &Scene, loads: &Loads, time: &[f64], columns: &[(&Vec<f64>, &Vec<f64>)]) {
        let n = columns.len();
        let (mut q, mut force, mut before) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut earlier = None;
        for (row, &t) in time.iter().enumerate() {
            q.iter_mut().zip(columns).for_each(|(q, column)| *q = column.0.get(row).copied().unwrap_or(f64::NAN));
            force.fill(0.0);
            loads.add_force(t, 1.0, &mut force);
            scene.system.add_stiffness(-1.0, &q, &mut force);
            if let Some(earlier) = earlier.replace(t) {
                let h = t - earlier;
                self.spacing = self.spacing.max(h);
                let sums = self.open.iter_mut().zip(&mut self.exchanged);
                for ((open, exchanged), (before, force)) in sums.zip(before.iter().zip(&force)) {
                    *open -= 0.5 * h * (before + force);
                    *exchanged += 0.5 * h * (before.abs() + force.abs());
                }
            }
            self.largest = force.iter().fold(self.largest, |largest, f| largest.max(f.abs()));
            before.copy_from_slice(&force);
        }
    }

    /// Takes `impulses` (N s, one a row) along `weight` times `row` off the residual.
    fn push(&mut self, row: &Row, impulses: &[f64], weight: f64) {
        let (sum, sizes) = impulses.iter().fold((0.0, 0.0), |(sum, sizes), p| (sum + p, sizes + f64::abs(*p)));
        let most = impulses.iter().fold(0.0, |most, p| f64::max(most, p.abs()));
        for &(i, share) in row.entries() {
            if let (Some(open), Some(exchanged)) = (self.open.get_mut(i), self.exchanged.get_mut(i)) {
                *open -= weight * share * sum;
                *exchanged += (weight * share).abs() * sizes;
            }
        }
        // The impulse of a row is the force over it times the spacing.
        self.largest = self.largest.max(if self.spacing > 0.0 { most / self.spacing } else { 0.0 });
    }
}
