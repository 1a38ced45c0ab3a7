//! Rows of one degree of freedom side by side, by the batch engine.

use super::forcing;
use super::measure::Measure;
use super::plan::{Plan, Point};
use super::request::Window;
use super::row::Row;
use super::sample::{Sample, Samples};
use super::status::Status;
use super::strobe::repeats;
use crate::batch;
use crate::batch::{AtWall, By, Lane, Outcome};
use crate::error::{Error, Result};
use crate::scene::{Checked, Scene, Side, State};
use crate::scheme::Scheme;
use crate::study::attractor;
use std::cell::LazyCell;

/// Rows that go through the lanes together.
pub(super) const TOGETHER: u64 = 256;

/// The measures that the batch engine computes.
const KNOWN: [Measure; 9] = [
    Measure::Impacts,
    Measure::ImpactsPerPeriod,
    Measure::Impulse,
    Measure::PeakForceMax,
    Measure::DisplacementMax,
    Measure::DisplacementHighest,
    Measure::DisplacementLowest,
    Measure::Period,
    Measure::Lyapunov,
];

impl Plan {
    /// An error for schemes, options and measures that the batch engine does not support.
    pub(super) fn check_batch(&self) -> Result<()> {
        let refuse = |key: &'static str, found: String, expected: &str| {
            Err(Error::invalid(key, found, format!("{expected} beside kernel = \"batch\"")))
        };
        let Window::Periods { .. } = self.sweep.window else {
            return refuse("[run] keep", "not in periods".to_owned(), "settle and keep in forcing periods");
        };
        if self.method.scheme != Scheme::Event || self.sweep.varies_scheme() {
            return refuse("[run] scheme", self.method.to_string(), "event");
        }
        if self.chain_rows() > 1 {
            return refuse("follow", "given".to_owned(), "no followed value: its rows go one after another");
        }
        if self.sweep.samples == Some(Samples::Impacts) {
            return refuse("[measure] samples", "\"impacts\"".to_owned(), "\"periods\"");
        }
        if let Some(measure) = self.sweep.measures.iter().find(|measure| !KNOWN.contains(measure)) {
            let known = KNOWN.map(Measure::name).join(", ");
            return refuse("[measure] columns", measure.to_string(), &format!("one of {known}"));
        }
        Lane::of(&self.base.scene, forcing::period(&self.base.scene)?)?;
        if self.base.scene.probes.iter().any(|probe| probe.at != crate::scene::Row::dof(0)) {
            return refuse("probe", "with a weight".to_owned(), "the displacement itself");
        }
        Ok(())
    }

    /// The rows of `points`. Each row depends on its point only, not on the others computed with
    /// it.
    pub(super) fn batched(&self, points: &[Point]) -> Vec<Row> {
        let lanes: Vec<Result<(Lane, Scene)>> = points.iter().map(|point| self.lane(point)).collect();
        let seated: Vec<Lane> = lanes.iter().flatten().map(|(lane, _)| lane.clone()).collect();
        let Window::Periods { settle, keep } = self.sweep.window else { return Vec::new() };
        let batch = batch::Plan { threads: 1, ..batch::Plan::new(settle, keep) }.run(&seated);
        let mut seat = 0;
        let mut rows = Vec::with_capacity(points.len());
        for (point, lane) in points.iter().zip(lanes) {
            let mut row = self.blank(point);
            let measured_values = lane.and_then(|(lane, scene)| {
                let batch = batch.as_ref().map_err(Clone::clone)?;
                let missing = || Error::invalid("lane", seat, "an outcome");
                let outcome = batch.outcomes().get(seat).cloned().unwrap_or_else(|| Err(missing()));
                let strobes = batch.strobes(seat);
                seat += 1;
                Ok((outcome?, strobes, lane, scene))
            });
            match measured_values {
                Ok((outcome, strobes, lane, scene)) => {
                    row.measures = self.measured_values(&outcome, strobes, &lane, &scene);
                    if self.sweep.samples.is_some() {
                        let time = |index: usize| (f64::from(settle) + 1.0 + index as f64) * lane.period;
                        let from = strobes.len().saturating_sub(self.sweep.most_samples);
                        let sample = |(index, state): (usize, &[f64; 2])| {
                            let seen = vec![*state; scene.probes.len()];
                            Sample::Strobe { time: time(index), seen }
                        };
                        row.samples = strobes.iter().enumerate().skip(from).map(sample).collect();
                    }
                    if outcome.by == By::Event {
                        row.error = "by the scheme event: kernel = \"batch\" has no elastic walls, no more than four \
                                     sines, and cannot decide every graze"
                            .to_owned();
                    }
                    self.check_finite(&mut row);
                }
                Err(error) => row.fail(&error),
            }
            // The batch engine makes no steps that could be judged, so the judged rows are computed
            // by the scheme `event`, which it replaces.
            if row.status == Status::Ok && self.is_judged(point.row) {
                let judged = self.row(point, None);
                match judged.status {
                    Status::Ok | Status::Handed => {}
                    Status::Refuted => (row.status, row.error) = (judged.status, judged.error),
                    _ => {
                        row.mark_unjudged();
                        row.error = format!("the scheme event, by which it is judged: {}", judged.error);
                    }
                }
            } else {
                row.mark_unjudged();
            }
            rows.push(row);
        }
        rows
    }

    fn lane(&self, point: &Point) -> Result<(Lane, Scene)> {
        let (case, _) = self.build(point, None)?;
        let period = forcing::period(&case.scene)?;
        Ok((Lane::of(&case.scene, period)?, case.scene))
    }

    fn measured_values(&self, outcome: &Outcome, strobes: &[[f64; 2]], lane: &Lane, scene: &Scene) -> Vec<Option<f64>> {
        let mut values = Vec::with_capacity(self.measured());
        let [low, high] = outcome.extent;
        let repeating = LazyCell::new(|| repeating(strobes, lane, scene));
        for measure in &self.sweep.measures {
            let mut of_walls = |value: &dyn Fn(&AtWall) -> Option<f64>| {
                let wall = |side| if side == Side::Upper { &outcome.upper } else { &outcome.lower };
                values.extend(scene.walls.iter().map(|w| value(wall(w.side()))));
            };
            let of_probes = |x: f64| vec![Some(x); scene.probes.len()];
            match measure {
                Measure::Impacts => of_walls(&|wall| Some(wall.impacts as f64)),
                Measure::Impulse => of_walls(&|wall| Some(wall.impulse)),
                Measure::PeakForceMax => of_walls(&|wall| wall.peak_force),
                Measure::DisplacementMax => values.extend(of_probes(high.abs().max(low.abs()))),
                Measure::DisplacementHighest => values.extend(of_probes(high)),
                Measure::DisplacementLowest => values.extend(of_probes(low)),
                Measure::ImpactsPerPeriod => {
                    let impacts = (outcome.lower.impacts + outcome.upper.impacts) as f64;
                    values.push(Some(impacts / strobes.len().max(1) as f64));
                }
                Measure::Period => values.push(repeating.as_ref().map(|(periods, _)| *periods as f64)),
                // Of a periodic motion it is that of the orbit; the mean over the window oscillates
                // about it.
                Measure::Lyapunov => {
                    let orbit = repeating.as_ref().and_then(|(periods, last)| {
                        attractor::exponent(&Checked::new(scene).ok()?, lane.period, *periods, last)
                    });
                    values.push(Some(orbit.unwrap_or(outcome.exponent)));
                }
                _ => values.push(None),
            }
        }
        values
    }
}

/// After how many periods the motion of `strobes` repeats itself, with the last of these states;
/// `None` where it does not.
fn repeating(strobes: &[[f64; 2]], lane: &Lane, scene: &Scene) -> Option<(usize, State)> {
    let states: Vec<State> = strobes.iter().map(|[q, v]| State { q: vec![*q], v: vec![*v] }).collect();
    let periods = repeats(&states.iter().collect::<Vec<_>>(), lane.period, scene.orbit_gap())?;
    Some((periods, states.last()?.clone()))
}
