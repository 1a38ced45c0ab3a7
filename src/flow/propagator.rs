//! The flow of a small change of a structure's state, by its Taylor series.
//!
//! Between events a change obeys the equation of the motion itself without its loads, with the same
//! walls touching and the same rows held: M δq̈ + C δq̇ + K δq = Gᵀ δr. So its series is that of a
//! motion that starts from the change.

use super::series::{HeldRow, HeldRows, Series, SeriesBody, Start, Touching};
use crate::scene::Scene;

/// Propagates changes (δq, δq̇) of a structure's state.
#[derive(Debug)]
pub(crate) struct Propagator {
    /// The structure without loads.
    pub body: SeriesBody,
    series: Series,
    /// The rows that are held.
    pub hold: HeldRows,
    pub touching: Vec<Touching>,
    zero: Vec<f64>,
    pub scratch: Vec<f64>,
}

/// A row in the equation of changes: it is held where it is.
pub(crate) fn held(row: usize) -> HeldRow {
    HeldRow { row, sign: 1.0, position: 0.0 }
}

impl Propagator {
    /// The propagator of the structure of `scene`; `None` if its mass matrix cannot be factored.
    pub fn new(scene: &Scene) -> Option<Self> {
        let body = SeriesBody::new(&Scene { loads: Vec::new(), ..scene.clone() })?;
        let (n, rows, walls) = (body.n, body.rows.count(), scene.walls.len());
        Some(Self {
            series: Series::new(&body),
            hold: HeldRows::with_room(rows),
            touching: Vec::with_capacity(walls),
            zero: vec![0.0; n],
            scratch: vec![0.0; rows],
            body,
        })
    }

    /// Sets the `rows` that are held, and the elastic walls (index, stiffness N/m, dashpot N s/m)
    /// that touch, from here on.
    pub fn set(
        &mut self,
        rows: impl Iterator<Item = usize> + Clone,
        touching: impl Iterator<Item = (usize, f64, f64)>,
    ) {
        let Self { body, hold, touching: walls, .. } = self;
        hold.set(body, rows.map(held), std::iter::empty());
        walls.clear();
        walls.extend(touching.map(|(wall, stiffness, damping)| Touching {
            wall,
            row: body.row_of[wall],
            position: 0.0,
            stiffness,
            damping,
        }));
    }

    /// Propagates the change (`q`, `v`), n entries each, over `span` (s).
    pub fn flow(&mut self, span: f64, q: &mut [f64], v: &mut [f64]) {
        let Self { body, series, hold, touching, zero, scratch } = self;
        let mut passed = 0.0;
        while passed < span {
            hold.stop(body, q, scratch);
            hold.stop(body, v, scratch);
            let from = Start { time: 0.0, q, v, extra: zero, until: span - passed, reach: f64::INFINITY };
            series.begin(body, &from, touching, hold, std::iter::empty(), scratch);
            // A series that does not converge is cut to length 0: some values are not finite then.
            if series.end() <= 0.0 || series.end().is_nan() {
                return;
            }
            series.state_at(series.span(), q, v);
            passed += series.end();
        }
    }
}
