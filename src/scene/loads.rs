//! The loads of a scene as vectors over its degrees of freedom.

use super::forcing::Forcing;
use super::load::Load;
use super::row::{Row, distinct};
use super::table::{Table, TablePiece};
use crate::linear::Segment;

/// All loads, sorted by where they act: one sum over time for each row, however many degrees of
/// freedom it reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Loads {
    parts: Vec<(Row, Forcing)>,
    /// The row of each part as a segment, where its entries follow one another.
    segments: Vec<Option<Segment>>,
    /// True if there is a blow among them.
    blows: bool,
}

impl Loads {
    /// The loads, those of one row together.
    #[must_use]
    pub fn new(loads: &[Load]) -> Self {
        let places = distinct(loads.iter().map(|load| &load.at));
        let mut lists = vec![Vec::new(); places.rows.len()];
        for (load, place) in loads.iter().zip(places.of) {
            lists[place].push(Load { kind: load.kind.clone(), at: Row::dof(0) });
        }
        let parts: Vec<_> =
            places.rows.into_iter().zip(lists).map(|(row, list)| (row.clone(), Forcing::on(0, &list))).collect();
        let blows = parts.iter().any(|(_, forcing)| !forcing.impulses.is_empty());
        let segments = parts.iter().map(|(row, _)| Segment::following(row.entries())).collect();
        Self { parts, segments, blows }
    }

    /// Each row with the loads that act through it.
    #[must_use]
    pub fn parts(&self) -> &[(Row, Forcing)] {
        &self.parts
    }

    /// True if there is a blow at any time.
    #[inline]
    #[must_use]
    pub fn has_blows(&self) -> bool {
        self.blows
    }

    /// Sets what the loads act on to 0 in `out`.
    #[inline(always)]
    pub(crate) fn clear(&self, out: &mut [f64]) {
        for ((row, _), segment) in self.parts.iter().zip(&self.segments) {
            match segment {
                Some(segment) if segment.fits(out.len()) => segment.clear(out),
                _ => row.entries().iter().for_each(|&(i, _)| out.get_mut(i).into_iter().for_each(|x| *x = 0.0)),
            }
        }
    }

    /// Adds `scale` times the forces at `t` (N) to `out`, one value per degree of freedom, without
    /// the blows.
    #[inline(always)]
    pub fn add_force(&self, t: f64, scale: f64, out: &mut [f64]) {
        for (part, segment) in self.parts.iter().zip(&self.segments) {
            scatter((part, segment), scale * part.1.force(t), out);
        }
    }

    /// As [`Loads::add_force`], at instants that mostly follow one another closely.
    #[inline(always)]
    pub(crate) fn add_force_near(&self, t: f64, scale: f64, out: &mut [f64], last: &mut LastPieces) {
        let mut last = last.0.iter_mut();
        for (part, segment) in self.parts.iter().zip(&self.segments) {
            let of_table = |table: &Table| match last.next() {
                Some(last) => table.force_near(t, last),
                None => table.piece(t).0,
            };
            scatter((part, segment), scale * part.1.force_by(t, of_table), out);
        }
    }

    /// Writes the sum of the blows in (from, to] to `out`, N s. Returns whether there is one.
    pub fn blow(&self, from: f64, to: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse(from, to), out)
    }

    /// Writes the moment of the blows in (from, to] about `about` (s) to `out`, N s², as
    /// [`Forcing::impulse_moment`]. Returns whether it is not zero.
    pub(crate) fn blow_moment(&self, from: f64, to: f64, about: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_moment(from, to, about), out)
    }

    /// Writes the sum of the blows within half a step `h` (s) of the instant `step` · h to `out`,
    /// as [`Forcing::impulse_about`]. Returns whether there is one.
    pub(crate) fn blow_about(&self, step: u64, h: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_about(step, h), out)
    }

    /// The same for the blows after the time `since` (s) only, as [`Forcing::impulse_about_since`].
    pub(crate) fn blow_about_since(&self, since: f64, step: u64, h: f64, out: &mut [f64]) -> bool {
        self.blow_by(|forcing| forcing.impulse_about_since(since, step, h), out)
    }

    /// Writes the blows at t = 0 to `out`, N s: the start is the state after them. Returns whether
    /// there is one.
    pub(crate) fn initial_blow(&self, out: &mut [f64]) -> bool {
        self.blow_by(Forcing::initial_impulse, out)
    }

    fn blow_by(&self, of: impl Fn(&Forcing) -> f64, out: &mut [f64]) -> bool {
        out.fill(0.0);
        if !self.blows {
            return false;
        }
        let mut any = false;
        for (part, segment) in self.parts.iter().zip(&self.segments) {
            let impulse = of(&part.1);
            any |= impulse != 0.0;
            scatter((part, segment), impulse, out);
        }
        any
    }
}

/// The piece of each table of some loads from which its force was read last: at the ends of steps
/// that follow one another, mostly the same.
#[derive(Debug, Clone)]
pub(crate) struct LastPieces(Vec<TablePiece>);

impl LastPieces {
    /// None yet, for the tables of `loads`.
    pub fn new(loads: &Loads) -> Self {
        let count = loads.parts.iter().map(|(_, forcing)| forcing.tables.len()).sum();
        Self(vec![TablePiece::NONE; count])
    }
}

/// Adds a part's row, which may be a segment, times `value` to `out`.
#[inline(always)]
fn scatter(((row, _), segment): (&(Row, Forcing), &Option<Segment>), value: f64, out: &mut [f64]) {
    match segment {
        _ if value == 0.0 => {}
        Some(segment) if segment.fits(out.len()) => segment.add(value, out),
        _ => row.add_transposed(value, out),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_from_the_last_pieces_are_those_of_the_tables_in_whatever_order_the_times_come() {
        let table = |time: &[f64], force: &[f64]| Load::table(Table::new(time.to_vec(), force.to_vec()).unwrap());
        let at = |load: Load, dof| Load { at: Row::dof(dof), ..load };
        let loads = Loads::new(&[
            at(table(&[0.0, 0.1, 0.7, 1.0], &[1.0, -2.0, 0.3, 5.0]), 0),
            at(table(&[0.25, 0.3, 2.0], &[7.0, 1.0, -1.0]), 1),
            at(table(&[0.05, 0.9], &[0.1, 0.2]), 0),
            at(Load::harmonic(1.0, 3.0, 0.2), 1),
        ]);
        let ahead = (0..300).map(|i| 0.01 * f64::from(i) - 0.3);
        let times = ahead.clone().chain(ahead.rev()).chain([0.7, 0.1, f64::NAN, 0.1, 0.25, 1.0, 0.0]);
        let mut last = LastPieces::new(&loads);
        for t in times {
            let (mut near, mut alone) = ([0.5; 2], [0.5; 2]);
            loads.add_force_near(t, 2.0, &mut near, &mut last);
            loads.add_force(t, 2.0, &mut alone);
            assert!(near.map(f64::to_bits) == alone.map(f64::to_bits), "{t}: {near:?} {alone:?}");
        }
    }
}
