//! Runs of a structure over an orbit or a part of it: their end, its derivative with respect to the
//! start, and the events on the way.

use super::periodic::Orbit;
use super::signature::{Event, Kind};
use super::strobe::{state, vector};
use super::watch::{Passage, Watch, gathered, orbit_of};
use crate::error::{Error, Result};
use crate::flow::{Series, bisect};
use crate::scene::{Scene, Wall};
use crate::scheme::{Scheme, Stepper};
use crate::step::{Path, Step};
use crate::variation::{KeyVariation, Product, SceneTangent};
use nalgebra::{DMatrix, DVector};

/// Number of samples of a series, which covers at most two radians of the fastest motion. Between
/// two of them the velocity at a wall is taken to have at most one root.
const SAMPLES: usize = 8;

/// A point at which the motion turns back before a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    pub wall: usize,
    /// Cycles of the forcing period since t = 0.
    pub phase: f64,
    /// Distance to the wall there, m.
    pub gap: f64,
}

/// What a run records.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Recorded {
    /// The events only.
    Events,
    /// Also the points where the motion turns back before walls.
    Touches,
    /// Both, and the derivative.
    All,
}

/// A key by which a run is differentiated, and the derivatives of the instants between which it
/// runs, s per unit of the key.
#[derive(Debug, Clone, Copy)]
pub(super) struct ByKey<'a> {
    pub tangent: &'a SceneTangent,
    pub later: [f64; 2],
}

/// A run.
#[derive(Debug, Clone)]
pub(super) struct OrbitRun {
    pub end: DVector<f64>,
    /// The derivative of the end with respect to the start; empty unless asked for.
    pub derivative: DMatrix<f64>,
    /// The derivative of the end with respect to a key, from a start that stays; `None` unless
    /// asked for, or where it is not known.
    pub by_key: Option<DVector<f64>>,
    pub passages: Vec<Passage>,
    pub touches: Vec<Touch>,
    /// The largest |displacement| at the place of a wall, m; 0 unless asked for.
    pub largest: f64,
    /// Contact episodes that end at each wall, and the impulse of each on the structure, N s.
    pub contacts: Vec<u64>,
    pub impulses: Vec<f64>,
    /// The walls that push without end, where nothing else happens.
    pub always: Vec<usize>,
}

impl OrbitRun {
    /// The orbit over `periods` periods of `period` (s) that was run once around.
    pub fn orbit(&self, periods: u32, period: f64) -> Orbit {
        let mut orbit = orbit_of(&self.passages, periods, period);
        for &wall in &self.always {
            orbit.insert(orbit.phases.len(), Event { kind: Kind::Always, wall }, 0.0, 0.0);
        }
        orbit
    }
}

/// Runs `scene`, whose loads repeat themselves after `period` (s), from the state `start` at the
/// first time of `span` (s) to the second.
///
/// # Errors
/// Those of a run; [`Error::NoOrbit`] where its derivative does not exist.
pub(super) fn run(
    scene: &Scene,
    period: f64,
    span: [f64; 2],
    start: &DVector<f64>,
    recorded: Recorded,
) -> Result<OrbitRun> {
    run_by_key(scene, period, span, start, recorded, None)
}

/// As [`run`], with the derivative by a key.
///
/// # Errors
/// As [`run`].
pub(super) fn run_by_key(
    scene: &Scene,
    period: f64,
    span: [f64; 2],
    start: &DVector<f64>,
    recorded: Recorded,
    key: Option<ByKey<'_>>,
) -> Result<OrbitRun> {
    let [from, to] = span;
    let mut stepper = Stepper::new(&scene.clone().with_duration(to), &Scheme::Event, to)?;
    stepper.set_state(from, &state(start))?;
    let mut product = if recorded == Recorded::All { Some(Product::new(scene)?) } else { None };
    let mut column = key.map(|key| Column::new(scene, key));
    let mut watch = Watch::new(scene, period);
    let mut turns = Turns::new(scene, period, recorded != Recorded::Events);
    let walls = scene.walls.len();
    let (mut contacts, mut impulses) = (vec![0; walls], vec![0.0; walls]);
    while stepper.time() < to {
        let step = stepper.step()?;
        if let Some(product) = &mut product {
            product.observe(&step).map_err(|error| Error::no_orbit(error.to_string()))?;
        }
        if let Some(column) = &mut column {
            column.propagate(&step);
        }
        watch.observe(&step);
        turns.observe(&step);
        for contact in step.closed {
            if let Some(count) = contacts.get_mut(contact.wall) {
                *count += 1;
            }
        }
        impulses.iter_mut().zip(step.impulse).for_each(|(sum, impulse)| *sum += impulse);
    }
    let end = stepper.state();
    let always = if watch.passages.is_empty() { stepper.open_contacts() } else { Vec::new() };
    Ok(OrbitRun {
        end: vector(&end.q, &end.v),
        by_key: column.and_then(|column| column.end(&end.v)),
        derivative: product.map_or_else(|| DMatrix::zeros(0, 0), |product| product.matrix().clone()),
        passages: gathered(watch.passages, scene),
        touches: turns.touches,
        largest: turns.largest,
        contacts,
        impulses,
        always: always.iter().map(|contact| contact.wall).collect(),
    })
}

/// The derivative by a key along a run.
struct Column<'a> {
    scene: &'a Scene,
    key: ByKey<'a>,
    variation: Option<KeyVariation>,
    known: bool,
    /// The acceleration at the end of the last step, m/s².
    acceleration: Vec<f64>,
}

impl<'a> Column<'a> {
    fn new(scene: &'a Scene, key: ByKey<'a>) -> Self {
        Self { scene, key, variation: None, known: true, acceleration: vec![0.0; scene.system.degrees_of_freedom()] }
    }

    /// Propagates the derivative over `step`. At the first one the state of the moved start, as it
    /// was at the fixed instant, is (q, q̇) less its rate times δt.
    fn propagate(&mut self, step: &Step<'_>) {
        if !self.known {
            return;
        }
        let mut begin = self.acceleration.clone();
        step.path.accelerations(&mut begin, &mut self.acceleration);
        let variation = match self.variation.take() {
            Some(variation) => Ok(variation),
            None => {
                let rate = step.velocity_before.iter().chain(&begin);
                let start: Vec<f64> = rate.map(|x| -x * self.key.later[0]).collect();
                KeyVariation::from_state(self.scene, std::slice::from_ref(self.key.tangent), &start)
            }
        };
        self.variation = variation.ok().and_then(|mut one| one.propagate(step).is_ok().then_some(one));
        self.known = self.variation.is_some();
    }

    /// The derivative of the end, at which the velocity is `v`.
    fn end(self, v: &[f64]) -> Option<DVector<f64>> {
        let variation = self.variation.filter(|_| self.known)?;
        let rate = v.iter().chain(&self.acceleration).map(|x| x * self.key.later[1]);
        Some(DVector::from_vec(variation.state().iter().zip(rate).map(|(x, later)| x + later).collect()))
    }
}

/// Watches where the motion turns back at the places of walls.
struct Turns<'a> {
    walls: &'a [Wall],
    period: f64,
    wanted: bool,
    touches: Vec<Touch>,
    largest: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    /// For each wall whether it acts, and the speed at its place at the last instant, m/s.
    acts: Vec<bool>,
    last: Vec<f64>,
}

impl<'a> Turns<'a> {
    fn new(scene: &'a Scene, period: f64, wanted: bool) -> Self {
        let (n, walls) = (scene.system.degrees_of_freedom(), scene.walls.len());
        Self {
            walls: &scene.walls,
            period,
            wanted,
            touches: Vec::new(),
            largest: 0.0,
            q: vec![0.0; n],
            v: vec![0.0; n],
            acts: vec![false; walls],
            last: vec![0.0; walls],
        }
    }

    fn observe(&mut self, step: &Step<'_>) {
        let Path::Series(series) = step.path else { return };
        if !self.wanted || series.end() <= series.start() {
            return;
        }
        self.acts.fill(false);
        series.acting_walls().for_each(|(wall, _)| {
            if let Some(acts) = self.acts.get_mut(wall) {
                *acts = true;
            }
        });
        let (start, width) = (series.start(), (series.end() - series.start()) / SAMPLES as f64);
        let mut before = start;
        for sample in 0..=SAMPLES {
            let now = if sample == SAMPLES { series.end() } else { start + width * sample as f64 };
            series.state(now, &mut self.q, &mut self.v);
            for (wall, place) in self.walls.iter().enumerate() {
                let (w, speed) = (place.row().dot(&self.q), place.row().dot(&self.v));
                self.largest = self.largest.max(w.abs());
                let last = std::mem::replace(&mut self.last[wall], speed);
                if sample > 0 && last * speed < 0.0 {
                    self.turn(series, wall, [before, now]);
                    series.state(now, &mut self.q, &mut self.v);
                }
            }
            before = now;
        }
    }

    /// The motion turns back at the place of `wall` within `span` (s).
    fn turn(&mut self, series: &Series, wall: usize, [from, to]: [f64; 2]) {
        let (Some(place), Some(acts)) = (self.walls.get(wall), self.acts.get(wall)) else { return };
        let (mut q, mut v) = (self.q.clone(), self.v.clone());
        let mut speed = |t: f64| {
            series.state(t, &mut q, &mut v);
            place.row().dot(&v)
        };
        let approaches = place.side().sign() * speed(from) < 0.0;
        let time = bisect(speed, from, to);
        series.state(time, &mut self.q, &mut self.v);
        let w = place.row().dot(&self.q);
        self.largest = self.largest.max(w.abs());
        let gap = place.gap(w);
        if approaches && !acts {
            self.touches.push(Touch { wall, phase: time / self.period, gap });
        }
    }
}
