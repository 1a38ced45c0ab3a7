//! The walls on the rows of a programme.
//!
//! Rigid walls at one place (one row g) share a row of the programme; an elastic wall has a row of
//! its own.

use super::flat_row::FlatRow;
use crate::scene::{Scene, Side, Wall, WallLaw, distinct};

/// Which walls have which row. A wall has a number here, in the order of the rows.
#[derive(Debug)]
pub(super) struct WallRows {
    /// The walls in the order of their rows, and the number of the first wall of each row.
    faces: Vec<FlatRow>,
    starts: Vec<usize>,
    /// The row of each wall of the scene.
    row_of: Vec<usize>,
    /// The open interval of g·q, m, in which a row's rigid walls are not touched; empty for the row
    /// of an elastic wall, which must be checked in every step.
    pub clear: Vec<(f64, f64)>,
}

impl WallRows {
    /// For the walls of `scene` whose law is `wanted`.
    pub fn new(scene: &Scene, wanted: impl Fn(&WallLaw) -> bool) -> Self {
        let mut places: Vec<Vec<usize>> = Vec::new();
        let distinct = distinct(scene.walls.iter().map(|wall| wall.row()));
        // The place of the rigid walls of each distinct row.
        let mut shared: Vec<Option<usize>> = vec![None; distinct.rows.len()];
        for (index, wall) in scene.walls.iter().enumerate().filter(|(_, wall)| wanted(&wall.law)) {
            match &mut shared[distinct.of[index]] {
                Some(place) if wall.law.is_rigid() => places[*place].push(index),
                place => {
                    if wall.law.is_rigid() {
                        *place = Some(places.len());
                    }
                    places.push(vec![index]);
                }
            }
        }
        let (mut faces, mut starts, mut row_of) = (Vec::new(), vec![0], vec![0; scene.walls.len()]);
        for (row, place) in places.iter().enumerate() {
            faces.extend(place.iter().filter_map(|&wall| Some(FlatRow::new(wall, scene.walls.get(wall)?))));
            starts.push(faces.len());
            place.iter().for_each(|&wall| row_of[wall] = row);
        }
        let touch = scene.touching_distance();
        let interval = |place: &Vec<usize>| {
            let ends = |(lo, hi): (f64, f64), w: &Wall| match (w.law.is_rigid(), w.side()) {
                (false, _) => (f64::INFINITY, f64::NEG_INFINITY),
                (true, Side::Upper) => (lo, hi.min(w.position() - 2.0 * touch)),
                (true, Side::Lower) => (lo.max(w.position() + 2.0 * touch), hi),
            };
            place.iter().filter_map(|&w| scene.walls.get(w)).fold((f64::NEG_INFINITY, f64::INFINITY), ends)
        };
        Self { clear: places.iter().map(interval).collect(), faces, starts, row_of }
    }

    /// Number of rows.
    #[inline]
    pub fn count(&self) -> usize {
        self.clear.len()
    }

    /// Number of walls.
    pub fn count_walls(&self) -> usize {
        self.faces.len()
    }

    /// Index of the first wall of a row.
    pub fn first(&self, row: usize) -> Option<usize> {
        self.starts.get(row).and_then(|&first| self.faces.get(first)).map(|face| face.index)
    }

    /// The row of a wall.
    #[inline]
    pub fn of(&self, wall: usize) -> usize {
        self.row_of[wall]
    }

    /// Numbers of the walls of a row.
    #[inline]
    pub fn walls(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// The wall of that number.
    #[inline]
    pub fn wall(&self, number: usize) -> FlatRow {
        self.faces[number]
    }
}
