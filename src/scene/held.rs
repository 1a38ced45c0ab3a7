//! A structure that is held at some places: its motions under g q = 0.
//!
//! With T, whose columns span the motions q = T x that every row g of a held place does not see
//! (G T = 0), the held structure has the matrices TᵀMT and TᵀKT. Each row is solved for one degree
//! of freedom, the one that it moves most for its mass, so that T stays as sparse as the rows are.

use super::{Face, Row, Scene, Structure, System, Wall, distinct, heading};
use crate::linear::Symmetric;
use std::collections::BTreeMap;

/// What is left of a row by those before it, as a share of its largest weight, is rounding below
/// this: the row depends on them.
const DEPENDENT: f64 = 1e-9;

/// Flats whose normals differ by less than this, as the sine of the angle, hold one line.
const PARALLEL: f64 = 1e-9;

/// A structure with places held, and its motions in the coordinates of the structure it was.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct HeldStructure {
    /// TᵀMT and TᵀKT, without damping.
    pub structure: Structure,
    /// T by its rows: each degree of freedom as a sum of those of the held structure.
    motion: Vec<Row>,
}

impl HeldStructure {
    /// `structure` with g q = 0 for each of `rows`; rows that depend on others change nothing.
    pub fn new(structure: &Structure, rows: &[Row]) -> Self {
        let n = structure.mass.size();
        let masses = structure.mass.diagonal_entries();
        let mut motion: Vec<BTreeMap<usize, f64>> = (0..n).map(|i| BTreeMap::from([(i, 1.0)])).collect();
        let mut free = vec![true; n];
        for row in rows {
            let mut left = BTreeMap::new();
            for &(i, weight) in row.entries() {
                for (&j, share) in motion.get(i).into_iter().flatten() {
                    *left.entry(j).or_insert(0.0) += weight * share;
                }
            }
            let scale = row.entries().iter().fold(0.0_f64, |most, entry| most.max(entry.1.abs()));
            left.retain(|_, weight| weight.abs() > DEPENDENT * scale);
            let moved = |(j, weight): (&usize, &f64)| weight.abs() / masses.get(*j).map_or(1.0, |m| m.sqrt());
            let Some((&solved, &own)) = left.iter().max_by(|a, b| moved(*a).total_cmp(&moved(*b))) else { continue };
            left.remove(&solved);
            for one in &mut motion {
                let Some(share) = one.remove(&solved) else { continue };
                left.iter().for_each(|(j, weight)| *one.entry(*j).or_insert(0.0) -= share * weight / own);
            }
            if let Some(free) = free.get_mut(solved) {
                *free = false;
            }
        }
        let mut number = vec![0; n];
        let mut count = 0;
        for (number, free) in number.iter_mut().zip(&free) {
            *number = count;
            count += usize::from(*free);
        }
        let renumbered = |one: BTreeMap<usize, f64>| {
            Row::new(one.into_iter().filter_map(|(j, share)| Some((*number.get(j)?, share))).collect())
        };
        let motion: Vec<Row> = motion.into_iter().map(renumbered).collect();
        let structure = Structure {
            mass: congruent(&structure.mass, &motion, count),
            damping: Symmetric::zeros(count),
            stiffness: congruent(&structure.stiffness, &motion, count),
        };
        Self { structure, motion }
    }

    /// T x: the displacement of the whole structure.
    pub fn expand(&self, x: &[f64]) -> Vec<f64> {
        self.motion.iter().map(|row| row.dot(x)).collect()
    }
}

/// TᵀAT, `count` × `count`, with T by its rows.
fn congruent(matrix: &Symmetric, motion: &[Row], count: usize) -> Symmetric {
    let none = Row::NONE;
    let of = |i: usize| motion.get(i).unwrap_or(&none).entries();
    let mut entries = Vec::with_capacity(matrix.stored());
    for (i, j, value) in matrix.entries().filter(|entry| entry.2 != 0.0) {
        for &(a, left) in of(i) {
            // An entry off the diagonal stands for two; one on it gives each pair in both orders.
            for &(b, right) in of(j) {
                let twice = if i != j && a == b { 2.0 } else { 1.0 };
                let once = i != j || a >= b;
                entries.extend(once.then_some((a, b, twice * value * left * right)));
            }
        }
    }
    Symmetric::from_entries(count, entries)
}

/// What a place is held by.
struct HeldPlace {
    row: Row,
    /// N/m; `None` for a rigid hold.
    stiffness: Option<f64>,
}

impl Scene {
    /// The structure with all its supports active: rigid ones hold their place, elastic ones are
    /// springs to the ground of their stiffness. A round support, or flats that stand in several
    /// directions, holds in both planes; flats along one line, and a wall beside supports, hold
    /// that line. `None` for one degree of freedom and for a scene without walls.
    pub(super) fn all_active(&self) -> Option<HeldStructure> {
        let System::Structure(structure) = &self.system else { return None };
        let holds = self.holds();
        if holds.is_empty() {
            return None;
        }
        let spring = |hold: &HeldPlace| {
            let stiffness = hold.stiffness?;
            let pairs = |&(i, a): &(usize, f64)| {
                let up_to = hold.row.entries().iter().filter(move |entry| entry.0 <= i);
                up_to.map(move |&(j, b)| (i, j, stiffness * a * b)).collect::<Vec<_>>()
            };
            Some(hold.row.entries().iter().flat_map(pairs).collect::<Vec<_>>())
        };
        let springs = Symmetric::from_entries(structure.mass.size(), holds.iter().filter_map(spring).flatten());
        let sprung = Structure {
            mass: structure.mass.clone(),
            damping: Symmetric::zeros(structure.mass.size()),
            stiffness: Symmetric::sum(&[(1.0, &structure.stiffness), (1.0, &springs)]),
        };
        let rigid: Vec<Row> = holds.into_iter().filter(|hold| hold.stiffness.is_none()).map(|hold| hold.row).collect();
        Some(HeldStructure::new(&sprung, &rigid))
    }

    /// The rows that the supports hold, and those of the walls beside them.
    fn holds(&self) -> Vec<HeldPlace> {
        let mut holds = Vec::new();
        for support in &self.supports {
            let walls = support.members(&self.walls).map(|(_, wall)| wall);
            let stiffness = softest(walls.clone());
            let normals: Vec<[f64; 2]> = walls
                .filter_map(|wall| match wall.face {
                    Face::Flat { direction, .. } => direction.map(heading),
                    Face::Round { .. } => None,
                })
                .collect();
            let line = normals.first().filter(|first| normals.iter().all(|other| are_parallel(first, other)));
            match line {
                Some(normal) => holds.push(HeldPlace { row: support.at.towards(*normal), stiffness }),
                None => {
                    holds.extend([&support.at.y, &support.at.z].map(|row| HeldPlace { row: row.clone(), stiffness }))
                }
            }
        }
        let beside = |index: &usize| self.support_of(*index).is_none();
        let others: Vec<&Wall> =
            (0..self.walls.len()).filter(beside).filter_map(|index| self.walls.get(index)).collect();
        let places = distinct(others.iter().map(|wall| wall.row()));
        for (place, row) in places.rows.into_iter().enumerate() {
            let here = others.iter().zip(&places.of).filter(|(_, of)| **of == place).map(|(wall, _)| *wall);
            holds.push(HeldPlace { row: row.clone(), stiffness: softest(here) });
        }
        holds
    }
}

/// The stiffness of the softest elastic one of the walls of a place, N/m; `None` where all of them
/// are rigid.
fn softest<'a>(walls: impl Iterator<Item = &'a Wall>) -> Option<f64> {
    walls.filter_map(|wall| wall.law.spring()).map(|spring| spring.stiffness).reduce(f64::min)
}

fn are_parallel([a, b]: &[f64; 2], [c, d]: &[f64; 2]) -> bool {
    (a * d - b * c).abs() < PARALLEL
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Modes;

    #[test]
    fn a_string_of_masses_held_between_two_of_them_moves_as_two_strings() {
        // Five masses of 1 kg between springs of 1 N/m; q₁ + q₂ = 0 leaves four motions. Without
        // those the product of all ω² is that of the constrained matrices, det(TᵀKT)/det(TᵀMT).
        let structure = Structure {
            mass: Symmetric::diagonal(&[1.0; 5]),
            damping: Symmetric::zeros(5),
            stiffness: Symmetric::from_entries(5, (0..5).map(|i| (i, i, 2.0)).chain((1..5).map(|i| (i, i - 1, -1.0)))),
        };
        let row = Row::new(vec![(1, 1.0), (2, 1.0)]);
        // The second row says the same, twice.
        let held = HeldStructure::new(&structure, &[row.clone(), Row::new(vec![(2, 2.0), (1, 2.0)])]);
        assert_eq!(held.structure.mass.size(), 4);
        let modes = Modes::lowest(&held.structure, 4).unwrap();
        for (omega, shape) in modes.omega.iter().zip(&modes.shapes) {
            let q = held.expand(shape);
            assert!(row.dot(&q).abs() < 1e-14);
            assert!((structure.mass.form(&q, &q) - 1.0).abs() < 1e-13);
            assert!((structure.stiffness.form(&q, &q) / (omega * omega) - 1.0).abs() < 1e-12);
        }
        // By hand with x = q₁ = −q₂: M = diag(1, 2, 1, 1),
        // K = [2 −1 0 0; −1 6 1 0; 0 1 2 −1; 0 0 −1 2]:
        // det K = 2·(6·3 − 2) − (4 − 1) = 29 and det M = 2.
        let product: f64 = modes.omega.iter().map(|omega| omega * omega).product();
        assert!((product / 14.5 - 1.0).abs() < 1e-12, "{product}");
    }

    #[test]
    fn all_held_leaves_nothing() {
        let structure = Structure {
            mass: Symmetric::diagonal(&[1.0, 2.0]),
            damping: Symmetric::zeros(2),
            stiffness: Symmetric::diagonal(&[3.0, 4.0]),
        };
        let held = HeldStructure::new(&structure, &[Row::new(vec![(0, 1.0), (1, -1.0)]), Row::dof(1)]);
        assert_eq!((held.structure.mass.size(), held.expand(&[])), (0, vec![0.0, 0.0]));
    }
}
