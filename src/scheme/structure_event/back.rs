//! The structure put back in front of the walls that a stretch of moreau-jean left it behind, up to
//! the way of a step.
//!
//! The displacement nearest to the present one, q*, at which no gap is below 0:
//!
//! minimise ½ (q − q*)ᵀ M (q − q*)   subject to   gap(q) ≥ 0 at every wall.
//!
//! Walls along the holes, which turn as it moves there, put it onto them to rounding.
//!
//! To put the structure onto each wall that it is behind would be too little, since that may move
//! it behind others, and too much where there are more such walls than degrees of freedom.

use super::StructureEvent;
use super::round::PLACINGS;
use super::rows::SIGNS;
use crate::error::Result;
use crate::flow::HeldRow;
use crate::qp::DiskBound;
use crate::scene::Hole;
use crate::scheme::disks::DiskProgramme;
use crate::scheme::flat_row::FlatRow;

impl StructureEvent {
    /// Puts the structure in front of the walls and holes that it is behind, also where it is
    /// leaving them. The rows of holes turn as it moves, so this is repeated.
    pub(super) fn put_back(&mut self) -> Result<()> {
        self.turn();
        if !self.body.rounds.is_empty() {
            self.put_into_holes();
        }
        for _ in 0..PLACINGS {
            let behind: Vec<HeldRow> = self.rows_where(|gap, _| gap < 0.0);
            if behind.is_empty() {
                return Ok(());
            }
            for (row, place) in self.places.iter().enumerate() {
                [self.lo[row], self.hi[row]] = place.bound;
            }
            self.rhs.fill(0.0);
            self.body.add_inertia(&self.q, &mut self.rhs);
            // Where walls leave no room, as at the start of a scene that stands behind them, the
            // structure goes onto those that it is behind.
            let onto = if self.solve()? { self.nearest() } else { behind };
            let Self { surface, body, q, scratch, .. } = self;
            surface.set(body, std::iter::empty(), onto.into_iter());
            surface.place(body, q, scratch);
            self.turn();
        }
        Ok(())
    }

    /// Moves the structure to the displacement sought, up to the tolerance of a solver. From far
    /// behind several holes, the walls along which these are now would lead it farther off. Leaves
    /// it where it is if no such displacement is found.
    fn put_into_holes(&mut self) {
        let mass = self.scene.system.structure().mass.clone();
        let Ok(mut bounds) = DiskProgramme::new(&self.scene, mass, self.length, |_| 0.0) else { return };
        for (index, wall) in self.scene.walls.iter().enumerate() {
            match wall.hole(index) {
                Some(Hole { centre, gap, .. }) => bounds.bind_hole(index, DiskBound::Disk { centre, radius: gap }),
                None if wall.law.is_rigid() => bounds.bind_wall(index, FlatRow::new(index, wall), wall.position()),
                None => bounds.open_wall(index),
            }
        }
        self.rhs.fill(0.0);
        self.body.add_inertia(&self.q, &mut self.rhs);
        if bounds.solve(&self.rhs, (self.time, self.steps)).is_ok() {
            self.q.copy_from_slice(bounds.x());
        }
        self.turn();
    }

    /// Moves the structure to the solution of the programme, and returns the walls that push it
    /// there: it stands on them up to the tolerance of the solver.
    fn nearest(&mut self) -> Vec<HeldRow> {
        let Some(solver) = &self.solver else { return Vec::new() };
        let solution = solver.solution();
        self.q.copy_from_slice(&solution.x);
        let pushes = solution.multiplier.clone();
        self.rows_where(|_, row| pushes.get(row.row).is_some_and(|push| push * row.sign > 0.0))
    }

    /// The sides of rows with a wall for which `is` holds of the gap (m) and the row.
    fn rows_where(&self, is: impl Fn(f64, &HeldRow) -> bool) -> Vec<HeldRow> {
        let mut found = Vec::new();
        for (row, place) in self.places.iter().enumerate() {
            let w = self.body.rows.dot(row, &self.q);
            for (side, sign) in SIGNS.into_iter().enumerate() {
                let held = HeldRow { row, sign, position: place.bound[side] };
                if place.bound[side].is_finite() && is(place.gap(side, w), &held) {
                    found.push(held);
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests;
