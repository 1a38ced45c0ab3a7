//! Which scenes are valid.

use super::system::{finite, positive};
use super::{Row, Scene, Side, Wall, distinct};
use crate::error::{Error, Result, Subject};
use std::collections::HashSet;

impl Scene {
    /// Checks everything that a scheme relies on.
    ///
    /// # Errors
    /// [`Error::Invalid`] for the first invalid value: what it is, and what would be accepted.
    pub fn validate(&self) -> Result<()> {
        #[cfg(test)]
        counted::count();
        self.validate_but_start()?;
        let n = self.system.degrees_of_freedom();
        for (part, values) in [("displacement", &self.initial.q), ("velocity", &self.initial.v)] {
            let key = || Subject::of("initial state").part(part);
            if values.len() != n {
                return Err(Error::invalid(
                    key(),
                    format!("{} values", values.len()),
                    format!("{n}, one per degree of freedom"),
                ));
            }
            values.iter().try_for_each(|&x| finite(key(), x))?;
        }
        self.check_start()
    }

    /// Checks everything but the initial state, as [`Scene::validate`] does.
    pub(crate) fn validate_but_start(&self) -> Result<()> {
        self.system.validate()?;
        positive("duration", self.duration)?;
        for (index, load) in self.loads.iter().enumerate() {
            load.validate(index)?;
            self.check_row(|| Subject::nth("load", index), &load.at)?;
        }
        let mut names = HashSet::new();
        for (index, probe) in self.probes.iter().enumerate() {
            if probe.name.chars().any(char::is_control) {
                let key = Subject::nth("probe", index).part("name");
                return Err(Error::invalid(key, format!("{:?}", probe.name), "no control characters"));
            }
            if !names.insert(probe.name.as_str()) {
                return Err(taken("probe", index, &probe.name));
            }
            self.check_row(|| Subject::probe(&probe.name), &probe.at)?;
        }
        self.check_output_times()?;
        let mut names = HashSet::new();
        for (index, wall) in self.walls.iter().enumerate() {
            wall.validate_name(index)?;
            if !names.insert(wall.name.as_str()) {
                return Err(taken("wall", index, &wall.name));
            }
        }
        for wall in &self.walls {
            if wall.is_round() {
                continue;
            }
            wall.validate()?;
            self.check_row(|| Subject::wall(&wall.name), wall.row())?;
            if wall.row().is_blind() {
                let key = Subject::wall(&wall.name).part("at");
                return Err(Error::invalid(key, "a place that nothing moves", "a place that can move"));
            }
        }
        check_crossing(&self.walls)?;
        self.check_supports(|name, row| self.check_row(|| Subject::support(name), row))
    }

    /// Times in order. Those after the end are accepted, since a scene may be cut short.
    fn check_output_times(&self) -> Result<()> {
        let times = &self.output_times;
        let before = std::iter::once(None).chain(times.iter().map(Some));
        for (index, (&time, before)) in times.iter().zip(before).enumerate() {
            let key = || Subject::of("output times").value(index);
            finite(key(), time)?;
            match before {
                None if time < 0.0 => return Err(Error::invalid(key(), format_args!("{time:?}"), "0 or more")),
                Some(&before) if time <= before => {
                    let expected = format!("more than the one before, {before:?}");
                    return Err(Error::invalid(key(), format_args!("{time:?}"), expected));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Refuses a row of `owner` beyond the degrees of freedom, or with weights that are not finite.
    pub(super) fn check_row(&self, owner: impl Fn() -> Subject, row: &Row) -> Result<()> {
        let n = self.system.degrees_of_freedom();
        for &(i, weight) in row.entries() {
            if i >= n {
                let least = format!("a degree of freedom from 0 to {}", n.saturating_sub(1));
                return Err(Error::invalid(owner().part("at"), i, least));
            }
            finite(owner().part("weight"), weight)?;
        }
        Ok(())
    }

    fn check_start(&self) -> Result<()> {
        let Some(wall) = self.wall_before(&self.initial.q) else { return self.check_start_in_holes() };
        let w = wall.row().dot(&self.initial.q);
        let relation = if wall.side() == Side::Upper { "at most" } else { "at least" };
        let expected = format!("{relation} {:?}, the position of the rigid wall {:?}", wall.position(), wall.name);
        Err(Error::invalid(("initial state", "displacement"), format_args!("{w:?}"), expected))
    }

    /// The first flat rigid wall behind which the structure is at `q`, by more than the rounding of
    /// a place on it.
    pub(crate) fn wall_before(&self, q: &[f64]) -> Option<&Wall> {
        let touch = self.touching_distance();
        self.walls.iter().find(|wall| wall.is_before(q, touch))
    }
}

/// The error of one of the walls or probes that has the name of another.
fn taken(kind: &'static str, index: usize, name: &str) -> Error {
    let key = Subject::nth(kind, index).part("name");
    Error::invalid(key, format!("{name:?}, which another {kind} has"), format!("a name of its own for each {kind}"))
}

/// Refuses a rigid upper wall below a rigid lower one of its row.
fn check_crossing(walls: &[Wall]) -> Result<()> {
    let places = distinct(walls.iter().map(|wall| wall.row()));
    let mut lower = vec![Vec::new(); places.rows.len()];
    let rigid = |side| walls.iter().zip(&places.of).filter(move |(wall, _)| wall.side() == side && wall.law.is_rigid());
    for (wall, &place) in rigid(Side::Lower) {
        lower[place].push(wall);
    }
    for (upper, &place) in rigid(Side::Upper) {
        if let Some(lower) = lower[place].iter().find(|lower| lower.position() > upper.position()) {
            return Err(Error::invalid(
                Subject::wall(&upper.name).part("position"),
                format_args!("{:?}", upper.position()),
                format!("at least {:?}, the position of the rigid lower wall {:?}", lower.position(), lower.name),
            ));
        }
    }
    Ok(())
}

/// Number of scenes that this thread has checked; used by tests.
#[cfg(test)]
pub(crate) mod counted {
    use std::cell::Cell;

    thread_local!(static CHECKS: Cell<usize> = const { Cell::new(0) });

    pub(super) fn count() {
        CHECKS.set(CHECKS.get() + 1);
    }

    /// The number since the last call.
    pub(crate) fn take() -> usize {
        CHECKS.replace(0)
    }
}
