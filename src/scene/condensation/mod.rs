//! Static condensation of degrees of freedom without mass, which lumped finite-element matrices
//! have.

mod statics;

use super::law::WallSpring;
use super::row::distinct;
use super::structure::Structure;
use super::wall::{Side, Wall};
use super::{Scene, System};
use crate::error::{Error, Result, Subject};
use statics::{Seen, Statics};

/// What was condensed out of a scene, and the effect on its walls.
///
/// With q = (a, b), where b has no mass, M_bb = 0 and M_ab = 0, the rows of b are static: K_ba a +
/// K_bb b = f_b + G_bᵀ r. So b = T a + K_bb⁻¹ (f_b + G_bᵀ r) with T = −K_bb⁻¹ K_ba, and the rest is
/// M_aa ä + C̄ ȧ + K̄ a = f_a + Tᵀf_b + Ḡᵀr with K̄ = K_aa + K_ab T, C̄ = C_aa + C_ab T and
/// Ḡ = G_a + G_b T: the condensation of Guyan (1965, doi 10.2514/3.2874), which is exact here since
/// b has no inertia.
///
/// A wall that acts on b has static compliance: w = ḡ a + s r with s = g_b K_bb⁻¹ g_bᵀ. A rigid
/// wall there is exactly an elastic one of stiffness 1/s against ḡ a, without restitution, since a
/// point without mass cannot rebound; an elastic wall of stiffness k becomes one of stiffness
/// 1/(1/k + s).
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Condensation {
    /// The degrees of freedom that are kept, in the original numbering; entry i is degree of
    /// freedom i of the condensed scene.
    pub kept: Vec<usize>,
    /// The degrees of freedom that were condensed, in the original numbering.
    pub massless: Vec<usize>,
    /// Static compliance s of the massless part at each wall, m/N, in the scene's order; 0 where
    /// the wall's row includes degrees of freedom with mass only.
    pub compliance: Vec<f64>,
}

#[cfg(feature = "case")]
impl Condensation {
    /// The same row in the degrees of freedom that are kept; `None` where it includes massless
    /// ones.
    pub(crate) fn row(&self, row: &super::Row) -> Option<super::Row> {
        let kept = |&(i, weight): &(usize, f64)| Some((self.kept.binary_search(&i).ok()?, weight));
        row.entries().iter().map(kept).collect::<Option<_>>().map(super::Row::new)
    }
}

impl Structure {
    /// The degrees of freedom whose row of the mass matrix is 0.
    #[must_use]
    pub fn massless(&self) -> Vec<usize> {
        let mut empty = vec![true; self.mass.size()];
        for (i, j, value) in self.mass.entries() {
            if value != 0.0 {
                (empty[i], empty[j]) = (false, false);
            }
        }
        (0..empty.len()).filter(|&i| empty[i]).collect()
    }
}

impl Scene {
    /// The scene without its massless degrees of freedom, and what was condensed. Where all have
    /// mass it is the scene itself.
    ///
    /// Walls, loads, probes and initial state keep their meaning. What cannot be condensed exactly
    /// is refused.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `system` where a massless degree of freedom has no stiffness, or
    /// damping acts on it; under `wall "…"`, `load …` or `probe "…"` where a wall acts on massless
    /// degrees of freedom that another wall or a load displaces too, or has a dashpot there, and
    /// where a probe records massless degrees of freedom that a load or a wall at another place
    /// displaces; under `initial.…` for an initial value that is not the static one; or any error
    /// of [`Scene::validate`].
    pub fn condensed(&self) -> Result<(Self, Condensation)> {
        let System::Structure(structure) = &self.system else { return self.uncondensed() };
        let massless = structure.massless();
        if massless.is_empty() {
            return self.uncondensed();
        }
        let mut statics = Statics::new(structure, massless)?;
        let kept: Vec<usize> = (0..statics.number.len()).filter(|&i| statics.number[i].is_ok()).collect();
        if kept.is_empty() {
            return Err(Error::invalid(
                ("system", "mass matrix"),
                "0 everywhere",
                "mass at one degree of freedom or more",
            ));
        }
        let walls: Vec<Seen> = self.walls.iter().map(|wall| statics.seen(wall.row())).collect();
        let loads: Vec<Seen> = self.loads.iter().map(|load| statics.seen(&load.at)).collect();
        let probes: Vec<Seen> = self.probes.iter().map(|probe| statics.seen(&probe.at)).collect();
        let mut scene = self.carried(statics.reduced(&kept)?.into(), |row| statics.seen(row).row);
        scene.initial.q = statics.start("displacement", &self.initial.q, &kept)?;
        scene.initial.v = statics.start("velocity", &self.initial.v, &kept)?;
        // Rigid walls are still rigid here, so that the checks of the initial state and of crossing
        // walls apply.
        scene.validate()?;
        self.check_apart(&walls, &loads, &probes)?;
        let compliance: Vec<f64> = walls.iter().map(Seen::own).collect();
        let damped = structure
            .damping
            .entries()
            .any(|(i, j, c)| c != 0.0 && (statics.number[i].is_err() || statics.number[j].is_err()));
        for (wall, &s) in scene.walls.iter_mut().zip(&compliance).filter(|(_, s)| **s > 0.0) {
            if damped {
                let expected = "a wall where degrees of freedom have mass: the damping matrix acts on the \
                                massless ones that it pushes";
                return Err(Error::invalid(Subject::wall(&wall.name).part("at"), "a place without mass", expected));
            }
            soften(wall, s)?;
        }
        Ok((scene, Condensation { kept, massless: statics.massless, compliance }))
    }

    fn uncondensed(&self) -> Result<(Self, Condensation)> {
        self.validate()?;
        let kept = (0..self.system.degrees_of_freedom()).collect();
        let condensation = Condensation { kept, massless: Vec::new(), compliance: vec![0.0; self.walls.len()] };
        Ok((self.clone(), condensation))
    }

    /// Refuses loads and walls that displace massless degrees of freedom which another row
    /// includes.
    fn check_apart(&self, walls: &[Seen], loads: &[Seen], probes: &[Seen]) -> Result<()> {
        const GIVE: &str = "give the degrees of freedom there mass, or choose a place where they have mass";
        for (index, load) in loads.iter().enumerate() {
            let key = Subject::nth("load", index).part("at");
            let what = "a place without mass, which it displaces without inertia";
            if let Some((wall, _)) = self.walls.iter().zip(walls).find(|(_, seen)| seen.meets(load)) {
                let expected = format!("a place that the wall {:?} does not see: {GIVE}", wall.name);
                return Err(Error::invalid(key, what, expected));
            }
            if let Some((probe, _)) = self.probes.iter().zip(probes).find(|(_, seen)| seen.meets(load)) {
                let expected = format!("a place that the probe {:?} does not see: {GIVE}", probe.name);
                return Err(Error::invalid(key, what, expected));
            }
        }
        let places = distinct(self.walls.iter().map(|wall| wall.row()));
        for (i, (wall, seen)) in self.walls.iter().zip(walls).enumerate().filter(|(_, (_, seen))| seen.own() > 0.0) {
            for (j, (other, beside)) in self.walls.iter().zip(walls).enumerate().take(i) {
                // Of two walls that face one another at one place, only one is in contact at a
                // time.
                let facing = match (wall.side(), other.side()) {
                    (Side::Upper, Side::Lower) => wall.position() >= other.position(),
                    (Side::Lower, Side::Upper) => other.position() >= wall.position(),
                    _ => false,
                };
                if seen.meets(beside) && !(facing && places.of.get(i) == places.of.get(j)) {
                    let value =
                        format!("a place without mass that the wall {:?} displaces without inertia", other.name);
                    return Err(Error::invalid(Subject::wall(&wall.name).part("at"), value, GIVE));
                }
            }
        }
        for (probe, seen) in self.probes.iter().zip(probes).filter(|(_, seen)| seen.own() > 0.0) {
            let pushed =
                self.walls.iter().zip(walls).find(|(wall, wall_seen)| *wall.row() != probe.at && seen.meets(wall_seen));
            if let Some((wall, _)) = pushed {
                let value = format!("a place without mass that the wall {:?} displaces without inertia", wall.name);
                let expected = format!("the place of that wall itself; or {GIVE}");
                return Err(Error::invalid(Subject::probe(&probe.name).part("at"), value, expected));
            }
        }
        Ok(())
    }
}

/// Puts the compliance `s` (m/N) of the massless part in series between wall and structure.
fn soften(wall: &mut Wall, s: f64) -> Result<()> {
    if let Some(WallSpring { damping, .. }) = wall.law.spring()
        && damping > 0.0
    {
        let expected = "0 where the wall pushes degrees of freedom without mass: in series with their \
                        spring a dashpot has a motion of its own";
        return Err(Error::invalid(Subject::wall(&wall.name).part("damping"), format!("{damping:?}"), expected));
    }
    let kind = wall.law.kind();
    wall.law = wall.law.in_series(s).ok_or_else(|| {
        let expected = "a rigid or elastic wall where degrees of freedom have no mass";
        Error::invalid(Subject::wall(&wall.name).part("law"), kind, expected)
    })?;
    Ok(())
}
