//! One scheme on one scene, over all steps.

use super::class::{Class, DIVERGED, Measurement};
use super::family::{Parameter, SchemeFamily};
use super::fine_reference::FineReference;
use super::recorded_run::{STARTS, nudged, recorded_run};
use super::scale::Scale;
use crate::scene::Scene;
use crate::scheme::Scheme;

/// Number of bisections, in the logarithm, of the interval between the last stable step and the
/// next one of the grid.
const BISECTIONS: u32 = 2;

/// One run of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Step, s.
    pub step: f64,
    /// The measurements; `None` where the run failed.
    pub measured: Option<Measurement>,
    /// The class of the run.
    pub class: Class,
    /// The criterion that decided the class, or why the run failed.
    pub reason: String,
}

/// A scheme with its second parameter set, on its scene: a row of a map.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Which map it belongs to.
    pub family: SchemeFamily,
    /// The second parameter.
    pub parameter: Parameter,
    /// Its value.
    pub value: f64,
    /// The scheme.
    pub scheme: Scheme,
    /// The scene given to the scheme.
    pub scene: Scene,
    /// The scene as the scheme sees it: a penalty's walls are springs.
    pub seen: Scene,
    /// True where the parameter's value is the case's own.
    pub own: bool,
    /// True where the row is drawn on the map; false for a case whose walls differ in the
    /// parameter.
    pub mapped: bool,
}

impl Subject {
    /// h²k_w/m at the step `h` (s) for the stiffest wall; `None` where all walls are rigid.
    #[must_use]
    pub fn kappa(&self, scale: &Scale, h: f64) -> Option<f64> {
        let stiffest = self.seen.walls.iter().filter_map(|w| w.law.stiffness()).reduce(f64::max);
        stiffest.map(|k| h * h * k / scale.mass)
    }

    /// The run with steps of `h` (s) over `horizon` (s), compared with `ruler`.
    ///
    /// A run classified as astray is repeated from the other starts of the reference. If one of
    /// these is not astray, the scene has two possible motions, and the scheme is not to blame for
    /// following the other one.
    #[must_use]
    pub fn cell(&self, ruler: &FineReference, scale: &Scale, h: f64, horizon: f64) -> Cell {
        let first = self.attempt(0, ruler, scale, h, horizon);
        if first.class != Class::Astray {
            return first;
        }
        let others = (1..STARTS).map(|start| self.attempt(start, ruler, scale, h, horizon));
        let mut on_course = others.filter(|cell| cell.class != Class::Astray);
        on_course.next().unwrap_or(first)
    }

    fn attempt(&self, start: u32, ruler: &FineReference, scale: &Scale, h: f64, horizon: f64) -> Cell {
        // Far above the limit of the class, so that the speed is still measured where a run
        // diverges.
        let limit = 10.0 * DIVERGED * ruler.speed.high.max(f64::MIN_POSITIVE);
        match recorded_run(&nudged(&self.scene, start, scale), &self.scheme, h, horizon, limit) {
            Err(error) => Cell { step: h, measured: None, class: Class::Diverged, reason: error.to_string() },
            Ok(record) => {
                let measured = Measurement::new(&record, ruler, &self.seen, &self.scheme, h);
                let (class, reason) = measured.classify();
                Cell { step: h, measured: Some(measured), class, reason }
            }
        }
    }
}

/// The range of stable steps of a scheme on a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct StableRange {
    /// The largest step that is stable together with all smaller ones of the grid, s; `None` where
    /// the smallest is not stable.
    pub step: Option<f64>,
    /// The run with the smallest step found that is not stable; `None` where all are stable.
    pub beyond: Option<Cell>,
}

impl StableRange {
    /// Finds it from the `cells` of a row, in the order of their steps, and then by bisection.
    #[must_use]
    pub fn find(subject: &Subject, cells: &[Cell], ruler: &FineReference, scale: &Scale, horizon: f64) -> Self {
        let stable = |cell: &Cell| cell.class == Class::Stable;
        let first_bad = cells.iter().position(|cell| !stable(cell));
        let Some(bad) = first_bad.and_then(|i| cells.get(i)) else {
            return Self { step: cells.last().map(|cell| cell.step), beyond: None };
        };
        let mut beyond = bad.clone();
        let Some(good) = first_bad.and_then(|i| i.checked_sub(1)).and_then(|i| cells.get(i)) else {
            return Self { step: None, beyond: Some(beyond) };
        };
        let mut step = good.step;
        for _ in 0..BISECTIONS {
            let cell = subject.cell(ruler, scale, (step * beyond.step).sqrt(), horizon);
            if stable(&cell) {
                step = cell.step;
            } else {
                beyond = cell;
            }
        }
        Self { step: Some(step), beyond: Some(beyond) }
    }
}
