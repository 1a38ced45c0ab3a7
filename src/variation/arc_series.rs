//! Closed-form motion of one degree of freedom as series.

use crate::flow::{Arc, HeldRow, HeldRows, Series, SeriesBody, SeriesStart, Touching};
use crate::scene::Scene;

/// The series of an arc, stretch by stretch, from the states that its closed form has.
#[derive(Debug)]
pub(super) struct ArcSeries {
    body: SeriesBody,
    pub series: Series,
    hold: HeldRows,
    touching: Vec<Touching>,
    carriers: Vec<(usize, usize, f64)>,
    duration: f64,
}

impl ArcSeries {
    /// Series of arcs of `scene`; `None` if its mass cannot be divided by.
    pub fn new(scene: &Scene) -> Option<Self> {
        let body = SeriesBody::new(scene)?;
        Some(Self {
            series: Series::new(&body),
            hold: HeldRows::with_room(1),
            touching: Vec::with_capacity(scene.walls.len()),
            carriers: Vec::with_capacity(1),
            duration: scene.duration,
            body,
        })
    }

    /// Computes the series from `from` (s) on: to the end of `arc`, or as far as two radians of the
    /// fastest motion.
    pub fn begin(&mut self, arc: &Arc, from: f64) {
        let Self { body, series, hold, touching, carriers, duration } = self;
        let (q, v) = arc.state(from);
        touching.clear();
        touching.extend(arc.touching_walls().map(|t| Touching {
            wall: t.wall,
            row: 0,
            position: t.position,
            stiffness: t.stiffness,
            damping: t.damping,
        }));
        carriers.clear();
        carriers.extend(arc.rests_on().map(|wall| (wall, 0, 1.0)));
        let held = arc.resting_side().map(|side| HeldRow { row: 0, sign: side.sign(), position: q });
        hold.set(body, held.into_iter(), std::iter::empty());
        // An arc of length 0 has a series all the same.
        let until = if arc.end() > from { arc.end() } else { from + *duration };
        let start = SeriesStart { time: from, q: &[q], v: &[v], extra: &[0.0], until, reach: f64::INFINITY };
        series.begin(body, &start, touching, hold, carriers.iter().copied(), &mut [0.0]);
        if arc.end() <= from {
            series.cut(arc.end());
        }
    }
}
