//! The statics of the degrees of freedom without mass.

use crate::error::{Error, Result, Subject};
use crate::linear::{Factor, NotDefinite, Symmetric};
use crate::order::sort_by_number;
use crate::scene::matrices::MOST_ENTRIES;
use crate::scene::structure::matrix_of;
use crate::scene::{Row, SharedStructure, Structure};
use std::collections::BTreeMap;
use std::ops::Range;
use std::result::Result as Either;

/// Two places are independent if their mutual compliance is below this share of their own.
const APART: f64 = 1e-9;
/// K_bb counts as singular if subtracting this share of its diagonal makes it indefinite.
const SINGULAR: f64 = 1e-12;
/// An entry of the condensed stiffness below this share of √(kᵢᵢ kⱼⱼ) is rounding, and is dropped.
const LOST: f64 = 1e-18;
/// A damping force on a massless degree of freedom below this share of its terms is rounding.
const ROUNDING: f64 = 1e-9;
/// Relative tolerance between an initial value given to a massless degree of freedom and its static
/// value.
const START: f64 = 1e-6;

/// The statics of the massless part.
pub(super) struct Statics<'a> {
    structure: &'a Structure,
    /// Index among the kept (Ok) or the massless (Err) degrees of freedom.
    pub number: Vec<Either<usize, usize>>,
    factor: Factor,
    /// K_ab as (kept, massless, value).
    coupling: Vec<(usize, usize, f64)>,
    pub massless: Vec<usize>,
}

/// A row in terms of the condensed structure: ḡ, g_b, and K_bb⁻¹ g_bᵀ.
pub(super) struct Seen {
    pub row: Row,
    inner: Vec<(usize, f64)>,
    response: Vec<f64>,
}

impl Seen {
    /// g_b K_bb⁻¹ h_bᵀ with another row h.
    fn compliance(&self, other: &Self) -> f64 {
        self.inner.iter().map(|&(b, weight)| weight * other.response.get(b).copied().unwrap_or(0.0)).sum()
    }

    pub fn own(&self) -> f64 {
        self.compliance(self)
    }

    /// True if a force through the other row displaces the massless part of this one.
    pub fn meets(&self, other: &Self) -> bool {
        self.compliance(other).abs() > APART * (self.own() * other.own()).sqrt()
    }
}

impl<'a> Statics<'a> {
    pub fn new(structure: &'a Structure, massless: Vec<usize>) -> Result<Self> {
        // With a mass of 1 on the massless degrees of freedom, the remaining checks apply
        // unchanged, and their errors use the original numbering.
        let mut one = vec![0.0; structure.mass.size()];
        massless.iter().for_each(|&b| one[b] = 1.0);
        let mass = Symmetric::sum(&[(1.0, &structure.mass), (1.0, &Symmetric::diagonal(&one))]);
        let filled = Structure { mass, damping: structure.damping.clone(), stiffness: structure.stiffness.clone() };
        SharedStructure::from(filled).validate()?;
        let (mut kept, mut condensed) = (0, 0);
        let count = |counter: &mut usize| std::mem::replace(counter, *counter + 1);
        let number: Vec<_> =
            one.iter().map(|m| if *m > 0.0 { Err(count(&mut condensed)) } else { Ok(count(&mut kept)) }).collect();
        let (mut inner, mut coupling) = (Vec::new(), Vec::new());
        for (i, j, k) in structure.stiffness.entries() {
            match (number[i], number[j]) {
                (Err(i), Err(j)) => inner.push((i, j, k)),
                (Ok(a), Err(b)) | (Err(b), Ok(a)) if k != 0.0 => coupling.push((a, b, k)),
                _ => {}
            }
        }
        let inner = Symmetric::from_entries(massless.len(), inner);
        let less = inner.diagonal_entries().into_iter().map(|k| -SINGULAR * k).collect::<Vec<_>>();
        let singular = |fault: NotDefinite| {
            let dof = massless.get(fault.row).copied().unwrap_or(0);
            let value = "without mass, and free to move without stiffness";
            let expected = "stiffness or mass there: a motion with neither has no equation";
            Error::invalid(Subject::of("system").part(format!("degree of freedom {dof}")), value, expected)
        };
        Factor::new(&Symmetric::sum(&[(1.0, &inner), (1.0, &Symmetric::diagonal(&less))])).map_err(singular)?;
        let factor = Factor::new(&inner).map_err(singular)?;
        Ok(Self { structure, number, factor, coupling, massless })
    }

    /// The condensed form of a row.
    pub fn seen(&mut self, row: &Row) -> Seen {
        let (mut outer, mut inner) = (Vec::new(), Vec::new());
        for &(i, weight) in row.entries() {
            match self.number.get(i) {
                Some(Ok(a)) => outer.push((*a, weight)),
                Some(Err(b)) => inner.push((*b, weight)),
                // The check of the scene reports this error, with the name of the row.
                None => outer.push((i, weight)),
            }
        }
        if inner.iter().all(|entry| entry.1 == 0.0) {
            return Seen { row: Row::new(outer), inner: Vec::new(), response: Vec::new() };
        }
        let mut response = vec![0.0; self.massless.len()];
        inner.iter().for_each(|&(b, weight)| response[b] += weight);
        self.factor.solve(&mut response);
        let mut weights = BTreeMap::new();
        outer.into_iter().for_each(|(a, weight)| *weights.entry(a).or_insert(0.0) += weight);
        for &(a, b, k) in &self.coupling {
            *weights.entry(a).or_insert(0.0) -= k * response[b];
        }
        let largest = weights.values().fold(0.0_f64, |most, w: &f64| most.max(w.abs()));
        let row = weights.into_iter().filter(|(_, weight)| weight.abs() > LOST * largest).collect();
        Seen { row: Row::new(row), inner, response }
    }

    /// The part of C that acts on massless degrees of freedom, by their rows: C_ba and C_bb.
    fn damping_of_massless(&self) -> Vec<(usize, Either<usize, usize>, f64)> {
        let entries = self.structure.damping.entries().filter(|entry| entry.2 != 0.0);
        let both = entries.flat_map(|(i, j, x)| {
            let twin = (i != j).then_some((j, i));
            [Some((i, j)), twin].into_iter().flatten().map(move |(i, j)| (i, j, x))
        });
        both.filter_map(|(i, j, x)| Some((self.number[i].err()?, self.number[j], x))).collect()
    }

    /// M_aa, C̄ and K̄.
    pub fn reduced(&mut self, kept: &[usize]) -> Result<Structure> {
        let n = kept.len();
        let [mass, damping, stiffness] = [&self.structure.mass, &self.structure.damping, &self.structure.stiffness];
        let outer = |matrix: &Symmetric| -> Vec<(usize, usize, f64)> {
            let both = matrix.entries().filter_map(|(i, j, x)| Some((self.number[i].ok()?, self.number[j].ok()?, x)));
            both.collect()
        };
        let (mass, mut c, mut k) = (Symmetric::from_entries(n, outer(mass)), outer(damping), outer(stiffness));
        let mut diagonal = vec![0.0; n];
        k.iter().filter(|entry| entry.0 == entry.1).for_each(|&(i, _, x)| diagonal[i] = x);
        let touching = self.damping_of_massless();
        let mut column: Vec<Range<usize>> = Vec::with_capacity(n);
        sort_by_number(&mut self.coupling, |entry| entry.0 as f64);
        let mut start = 0;
        for a in 0..n {
            let end = start + self.coupling[start..].iter().take_while(|entry| entry.0 == a).count();
            column.push(start..end);
            start = end;
        }
        let mut t = vec![0.0; self.massless.len()];
        let mut sums = vec![0.0; n];
        for (a, entries) in column.iter().enumerate() {
            let moved = entries.clone();
            if moved.is_empty() && touching.is_empty() {
                continue;
            }
            t.fill(0.0);
            self.coupling[moved].iter().for_each(|&(_, b, x)| t[b] -= x);
            self.factor.solve(&mut t);
            sums.fill(0.0);
            self.coupling.iter().for_each(|&(other, b, x)| sums[other] += x * t[b]);
            for (other, &x) in sums.iter().enumerate().take(a + 1) {
                if x.abs() > LOST * (diagonal[a] * diagonal[other]).sqrt() {
                    k.push((a, other, x));
                }
            }
            if k.len() > MOST_ENTRIES {
                let value =
                    format!("{} degrees of freedom without mass that couple {n} with mass", self.massless.len());
                let expected = format!(
                    "so few that the condensed matrix has at most {MOST_ENTRIES} entries; or modal data in its place"
                );
                return Err(Error::invalid(("system", "stiffness matrix"), value, expected));
            }
            if !touching.is_empty() {
                self.damped(a, &t, &touching, &mut c)?;
            }
        }
        let (damping, stiffness) = (Symmetric::from_entries(n, c), Symmetric::from_entries(n, k));
        Ok(Structure { mass, damping, stiffness })
    }

    /// Adds column `a` of C_ab T, where `t` is column a of T, to C̄. The damping force on the
    /// massless degrees of freedom, C_ba + C_bb T, must be zero.
    fn damped(
        &self,
        a: usize,
        t: &[f64],
        touching: &[(usize, Either<usize, usize>, f64)],
        c: &mut Vec<(usize, usize, f64)>,
    ) -> Result<()> {
        let (mut force, mut size) = (vec![0.0; t.len()], vec![0.0_f64; t.len()]);
        let mut sums = BTreeMap::new();
        for &(b, other, x) in touching {
            let term = match other {
                Ok(other) => {
                    if other <= a {
                        *sums.entry(other).or_insert(0.0) += x * t[b];
                    }
                    if other == a { x } else { 0.0 }
                }
                Err(other) => x * t[other],
            };
            force[b] += term;
            size[b] = size[b].max(term.abs());
        }
        let largest = size.iter().fold(0.0_f64, |most, x| most.max(*x));
        if let Some(b) = (0..t.len()).find(|&b| force[b].abs() > ROUNDING * largest) {
            let key = matrix_of("damping").row(self.massless[b]);
            let expected = "no damping force on a degree of freedom without mass, which would creep: leave its \
                            row 0, give it mass, or say \
                            the damping as Rayleigh's coefficients or modal ratios";
            return Err(Error::invalid(
                key,
                format!("damping degree of freedom {}, which has no mass", self.massless[b]),
                expected,
            ));
        }
        c.extend(sums.into_iter().map(|(other, x)| (a, other, x)));
        Ok(())
    }

    /// The kept part of an initial field; the massless part must be 0 or the static displacement.
    pub fn start(&mut self, part: &'static str, whole: &[f64], kept: &[usize]) -> Result<Vec<f64>> {
        if whole.len() != self.number.len() {
            let expected = format!("{}, one per degree of freedom", self.number.len());
            return Err(Error::invalid(("initial state", part), format!("{} values", whole.len()), expected));
        }
        let outer: Vec<f64> = kept.iter().map(|&i| whole[i]).collect();
        if self.massless.iter().all(|&i| whole[i] == 0.0) {
            return Ok(outer);
        }
        let mut held = vec![0.0; self.massless.len()];
        self.coupling.iter().for_each(|&(a, b, k)| held[b] -= k * outer[a]);
        self.factor.solve(&mut held);
        let size = self.massless.iter().zip(&held).fold(0.0_f64, |most, (&i, x)| most.max(x.abs()).max(whole[i].abs()));
        let off = |(i, x): &(&usize, &f64)| {
            let off = (whole[**i] - **x).abs();
            off.is_nan() || off > START * size
        };
        match self.massless.iter().zip(&held).find(off) {
            Some((&i, x)) => {
                let value = format!("{:?} at degree of freedom {i}, which has no mass", whole[i]);
                let expected = format!("{x:?}, what the others hold it at, or 0 for all that have no mass");
                Err(Error::invalid(("initial state", part), value, expected))
            }
            None => Ok(outer),
        }
    }
}
