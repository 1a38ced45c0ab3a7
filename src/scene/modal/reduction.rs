//! A scene in modal coordinates.

use super::modes::Modes;
use super::residual::Residual;
use crate::error::{Error, Result};
use crate::linear::Symmetric;
use crate::scene::{Damping, Row, Scene, State, Structure, System, Wall};

/// A scene reduced to its slowest modes, and what was left out.
///
/// With q = Φ a for the k slowest modes, M becomes 1, K diag(ω²), C ΦᵀCΦ (stored as a diagonal if
/// it couples no modes), the row g of a wall, load or probe g Φ, and an initial q ΦᵀM q. At a wall
/// a truncation changes the effective mass 1/(g M⁻¹ gᵀ), which falls as modes are added and
/// determines an impact with restitution, and the static compliance g K⁻¹ gᵀ, which rises. Probes
/// do not include the static response of the modes left out.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Reduction {
    /// The scene in modal coordinates; walls, loads and probes keep their order.
    pub scene: Scene,
    /// The modes that are kept.
    pub modes: Modes,
    /// ω of the slowest mode that is left out, rad/s; `None` if all are kept.
    pub next_omega: Option<f64>,
    /// Degrees of freedom before the reduction.
    pub degrees_of_freedom: usize,
    /// The effect at each wall, in the scene's order.
    pub walls: Vec<WallTruncation>,
    /// Share of the initial energy, ½vᵀMv + ½qᵀKq, that is left out; 0 if there is none.
    pub start_energy_lost: f64,
    /// With a static correction: the largest |sᵢⱼ|/√(sᵢᵢ sⱼⱼ) of the residual compliance between
    /// walls at different places, which is neglected. Without a correction 0.
    pub coupling_neglected: f64,
}

/// Effect of a truncation at a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct WallTruncation {
    /// Effective mass 1/(g M⁻¹ gᵀ) of the whole structure, kg.
    pub mass: f64,
    /// Effective mass of the modes that are kept, kg: at least that of the whole structure.
    pub mass_kept: f64,
    /// Static compliance g K⁺ gᵀ of the whole structure without its rigid-body motions, m/N.
    pub compliance: f64,
    /// Static compliance of the modes that are kept, m/N: at most that of the whole structure.
    pub compliance_kept: f64,
    /// True if the wall was given the residual compliance.
    pub corrected: bool,
}

impl WallTruncation {
    /// The residual compliance s that is left out, m/N.
    #[must_use]
    pub fn residual(&self) -> f64 {
        (self.compliance - self.compliance_kept).max(0.0)
    }

    /// Share of the static compliance that is kept, from 0 to 1; 1 for a wall without compliance.
    #[must_use]
    pub fn share(&self) -> f64 {
        if self.compliance > 0.0 { (self.compliance_kept / self.compliance).min(1.0) } else { 1.0 }
    }
}

/// Whether the initial state is reduced.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Start {
    /// It is reduced too.
    Kept,
    /// It is left out.
    Left,
}

/// ΦᵀCΦ, diagonal where C couples no modes, for which `modes` of equal frequency may be turned.
fn modal_damping(modes: &mut Modes, damping: &Symmetric) -> Symmetric {
    if let Some(diagonal) = modes.uncouple(damping) {
        return Symmetric::diagonal(&diagonal);
    }
    let (k, c) = (modes.count(), modes.project(damping));
    let lower = (0..k).flat_map(|i| (0..=i).map(move |j| (i, j)));
    Symmetric::from_entries(k, lower.map(|(i, j)| (i, j, c[(i, j)])))
}

/// A residual compliance below this share of the whole is rounding and counts as 0.
const NOTHING: f64 = 1e-12;

impl Scene {
    /// The scene in the coordinates of its `modes` slowest modes.
    ///
    /// With `static_correction` the residual compliance s = g (K⁺ − ΦΩ⁻²Φᵀ) gᵀ of each wall, that
    /// of the modes left out, becomes a spring between structure and wall. A rigid wall thus
    /// becomes an elastic one of stiffness 1/s, of restitution 1: a smaller one is refused, since
    /// the spring has no mass that could lose energy. An elastic wall of stiffness k and damping c
    /// gets k′ = 1/(1/k + s), and c (k′/k)², which dissipates the same power at slow rates. Each
    /// wall is corrected separately: s between walls at different places is neglected, and
    /// reported.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `modes` for a number of modes that is out of range, fewer than the
    /// rigid-body motions, or so small that the reduced initial state lies behind a wall; under
    /// `static correction` for a wall whose law is not linear or that has a restitution below 1; or
    /// any error of [`Scene::validate`].
    pub fn reduced(&self, modes: usize, static_correction: bool) -> Result<Reduction> {
        self.validate()?;
        self.cut(modes, static_correction, Start::Kept)
    }

    /// The same at rest at 0, wherever the scene starts and on whichever side of its walls that is.
    ///
    /// # Errors
    /// As [`Scene::reduced`], but for the initial state.
    pub(crate) fn reduced_without_start(&self, modes: usize, static_correction: bool) -> Result<Reduction> {
        self.validate()?;
        self.cut(modes, static_correction, Start::Left)
    }

    fn cut(&self, modes: usize, static_correction: bool, start: Start) -> Result<Reduction> {
        let System::Structure(structure) = &self.system else {
            return Err(Error::invalid("modes", modes, "no modes: the system has one degree of freedom"));
        };
        let n = structure.mass.size();
        let (mut kept, next_omega) = split(structure, modes)?;
        let damping = modal_damping(&mut kept, &structure.damping);
        let stiffness: Vec<f64> = kept.omega.iter().map(|omega| omega * omega).collect();
        let row = |row: &Row| Row::new(kept.seen(row).into_iter().enumerate().collect());
        let (mass, stiffness) = (Symmetric::diagonal(&vec![1.0; modes]), Symmetric::diagonal(&stiffness));
        let mut scene = self.carried(Structure { mass, damping, stiffness }.into(), row);
        scene.initial = State {
            q: kept.coordinates(&structure.mass, &self.initial.q),
            v: kept.coordinates(&structure.mass, &self.initial.v),
        };
        match start {
            Start::Kept => self.keep_start(&mut scene, modes)?,
            Start::Left => scene.initial = State { q: vec![0.0; modes], v: vec![0.0; modes] },
        }
        scene.check_kept_planes(modes)?;
        let (mut walls, coupling) = self.truncation(structure, &kept, next_omega, &scene)?;
        if static_correction {
            for (wall, truncation) in scene.walls.iter_mut().zip(&mut walls) {
                correct(wall, truncation)?;
            }
        }
        let energy = |scene: &Self| scene.system.energy(&scene.initial.q, &scene.initial.v);
        let whole = energy(self);
        let start_energy_lost =
            if whole > 0.0 && start == Start::Kept { (1.0 - energy(&scene) / whole).max(0.0) } else { 0.0 };
        let coupling_neglected = if static_correction { coupling } else { 0.0 };
        Ok(Reduction {
            scene,
            modes: kept,
            next_omega,
            degrees_of_freedom: n,
            walls,
            start_energy_lost,
            coupling_neglected,
        })
    }

    /// The effect at each wall, and the largest residual coupling between walls at different
    /// places.
    fn truncation(
        &self,
        structure: &Structure,
        kept: &Modes,
        next: Option<f64>,
        reduced: &Self,
    ) -> Result<(Vec<WallTruncation>, f64)> {
        let mut residual = next.map(|next| Residual::new(structure, kept, next)).transpose()?;
        let places: Vec<&Row> = self.walls.iter().map(|wall| wall.row()).collect();
        let mut walls: Vec<WallTruncation> = Vec::with_capacity(places.len());
        // Products of different places, each taken while its response is at hand.
        let mut products = Vec::new();
        for (i, ((row, mass), mass_kept)) in
            places.iter().zip(self.wall_masses()).zip(reduced.wall_masses()).enumerate()
        {
            // Round walls have no row of their own.
            let same = places[..i].iter().position(|other| other == row).filter(|_| !row.entries().is_empty());
            if let Some(first) = same {
                walls.push(walls[first]);
                continue;
            }
            let part = |(seen, omega): (f64, &f64)| if *omega > 0.0 { (seen / omega).powi(2) } else { 0.0 };
            let compliance_kept = kept.seen(row).into_iter().zip(&kept.omega).map(part).sum::<f64>();
            let mut left_out = 0.0;
            if let Some(residual) = &mut residual {
                let response = residual.response(row);
                left_out = row.dot(&response).max(0.0);
                products.extend(places[..i].iter().enumerate().map(|(j, other)| (i, j, other.dot(&response))));
            }
            let compliance = compliance_kept + left_out;
            walls.push(WallTruncation { mass, mass_kept, compliance, compliance_kept, corrected: false });
        }
        let weight = |i: usize| walls[i].residual().sqrt();
        let share = |(i, j, s): &(usize, usize, f64)| {
            let scale = weight(*i) * weight(*j);
            if scale > 0.0 { s.abs() / scale } else { 0.0 }
        };
        let coupling = products.iter().map(share).fold(0.0, f64::max);
        Ok((walls, coupling))
    }

    /// The reduced initial state must not lie behind a wall unless the original one did. A wall
    /// that it touched remains touched: the wall's position absorbs the rounding.
    fn keep_start(&self, reduced: &mut Self, modes: usize) -> Result<()> {
        let rounding = 1e-12 * self.gap_scale();
        for (before, wall) in self.walls.iter().zip(&mut reduced.walls) {
            let w = wall.row().dot(&reduced.initial.q);
            let (gap, depth) = (before.gap(before.row().dot(&self.initial.q)), -wall.gap(w));
            if gap < 0.0 || depth <= 0.0 {
                continue;
            }
            if depth > rounding {
                let value = format!("{modes}, which put the start {depth:e} m behind the wall {:?}", wall.name);
                return Err(Error::invalid("modes", value, "more: cut to these, the initial displacement is another"));
            }
            *wall = wall.clone().with_position(w);
        }
        Ok(())
    }
}

impl Reduction {
    /// The same reduction with C from `damping` in modal coordinates, in place of the structure's
    /// C; intended for modal ratios.
    ///
    /// # Errors
    /// As [`Damping::matrix`].
    pub fn with_damping(mut self, damping: &Damping) -> Result<Self> {
        if let System::Structure(structure) = &mut self.scene.system {
            structure.damping = damping.matrix(structure)?;
        }
        Ok(self)
    }
}

/// The `count` slowest modes, and ω of the next one. All rigid-body motions must be included.
fn split(structure: &Structure, count: usize) -> Result<(Modes, Option<f64>)> {
    let n = structure.mass.size();
    if count == 0 || count > n {
        return Err(Error::invalid("modes", count, format!("from 1 to {n}, the degrees of freedom")));
    }
    let mut modes = Modes::lowest(structure, (count + 1).min(n))?;
    if modes.count() == count {
        return Ok((modes, None));
    }
    modes.shapes.truncate(count);
    match modes.omega.pop() {
        Some(next) if next > 0.0 => Ok((modes, Some(next))),
        _ => Err(Error::invalid("modes", count, "more: there are more rigid-body motions than these modes")),
    }
}

/// Adds the residual compliance to a wall.
fn correct(wall: &mut Wall, truncation: &mut WallTruncation) -> Result<()> {
    if let Some(e) = wall.law.restitution().filter(|e| *e < 1.0) {
        let value = format!("true, beside the restitution {e} of the wall {:?}", wall.name);
        let expected = "no restitution below 1: the rigid wall becomes a spring without mass, which cannot rebound \
                        otherwise";
        return Err(Error::invalid("static correction", value, expected));
    }
    let s = truncation.residual();
    if s <= NOTHING * truncation.compliance {
        return Ok(());
    }
    wall.law = wall.law.in_series(s).ok_or_else(|| {
        let value = format!("true, and the wall {:?} has {}", wall.name, wall.law.kind());
        Error::invalid("static correction", value, "rigid or elastic walls only")
    })?;
    truncation.corrected = true;
    Ok(())
}
