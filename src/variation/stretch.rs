//! The motion of a step: a closed form or a series.

use crate::flow::{Arc, Series};

/// The motion between two events.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stretch<'a> {
    /// Of one degree of freedom, with the motion at its end.
    Arc(&'a Arc, ArcEnd),
    /// Of a structure.
    Series(&'a Series),
}

/// The motion of one degree of freedom at the end of an arc.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ArcEnd {
    /// Displacement, m, and velocity, m/s.
    pub state: [f64; 2],
    /// m/s².
    pub acceleration: f64,
}

/// What the force of a wall does at the end of a stretch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Release {
    /// Its rate, N/s.
    pub rate: f64,
    /// The acceleration of the row of the wall, m/s².
    pub pull: f64,
}

impl Stretch<'_> {
    /// Time at which it starts, s.
    pub fn start(&self) -> f64 {
        match self {
            Self::Arc(arc, _) => arc.start(),
            Self::Series(series) => series.start(),
        }
    }

    /// True for one of no length.
    pub fn is_empty(&self) -> bool {
        match self {
            Self::Arc(arc, _) => arc.end() <= arc.start(),
            Self::Series(series) => series.end() <= series.start(),
        }
    }

    /// Writes displacement (m) and velocity (m/s) halfway between start and end.
    pub fn middle_state(&self, q: &mut [f64], v: &mut [f64]) {
        match self {
            Self::Arc(arc, _) => write(arc.state(0.5 * (arc.start() + arc.end())).into(), q, v),
            Self::Series(series) => series.state(0.5 * (series.start() + series.end()), q, v),
        }
    }

    /// Writes displacement (m) and velocity (m/s) at the start.
    pub fn start_state(&self, q: &mut [f64], v: &mut [f64]) {
        match self {
            Self::Arc(arc, _) => write(arc.start_state(), q, v),
            Self::Series(series) => series.state(series.start(), q, v),
        }
    }

    /// Writes displacement (m), velocity (m/s) and acceleration (m/s²) at the end.
    pub fn end_state(&self, q: &mut [f64], v: &mut [f64], a: &mut [f64]) {
        match self {
            Self::Arc(_, end) => {
                write(end.state, q, v);
                a.fill(end.acceleration);
            }
            Self::Series(series) => {
                series.state(series.end(), q, v);
                series.acceleration_at_end(a);
            }
        }
    }

    /// Walls that act, each with whether it is one that holds a row; the others are elastic walls
    /// that touch.
    pub fn acting_walls(&self) -> impl Iterator<Item = (usize, bool)> {
        let (arc, series) = self.parts();
        let of_arc = arc.into_iter().flat_map(|arc| {
            let touching = arc.touching().map(|wall| (wall, false));
            touching.chain(arc.rests_on().map(|wall| (wall, true)))
        });
        of_arc.chain(series.into_iter().flat_map(Series::acting_walls))
    }

    /// The share of wall `wall` in the force at its row; `None` if it does not act.
    pub fn share(&self, wall: usize) -> Option<f64> {
        match self {
            Self::Arc(..) => self.acting_walls().find(|acting| acting.0 == wall).map(|_| 1.0),
            Self::Series(series) => series.acting_shares().find(|acting| acting.0 == wall).map(|acting| acting.1),
        }
    }

    /// Force of wall `wall` at the end, N, signed: 0 if it does not act.
    pub fn force_at_end(&self, wall: usize) -> f64 {
        match self {
            Self::Arc(arc, ArcEnd { state: [q, v], .. }) => arc.force_at(wall, arc.end(), (*q, *v)),
            Self::Series(series) => series.contact_force(wall, series.end()),
        }
    }

    /// The rate of that force, N/s; `None` if the wall does not act.
    pub fn force_rate_at_end(&self, wall: usize) -> Option<f64> {
        let share = self.share(wall)?;
        match self {
            Self::Arc(arc, end) => Some(arc.force_rate_at_end(wall, [end.state[1], end.acceleration])),
            Self::Series(series) => {
                let (_, force, _) = series.acting().find(|acting| acting.0 == wall)?;
                let x = series.span();
                let slope = force.iter().enumerate().skip(1).rev().fold(0.0, |sum, (k, c)| sum * x + k as f64 * c);
                Some(share * slope / series.unit())
            }
        }
    }

    fn parts(&self) -> (Option<&Arc>, Option<&Series>) {
        match self {
            Self::Arc(arc, _) => (Some(arc), None),
            Self::Series(series) => (None, Some(series)),
        }
    }
}

fn write([displacement, velocity]: [f64; 2], q: &mut [f64], v: &mut [f64]) {
    q.fill(displacement);
    v.fill(velocity);
}
