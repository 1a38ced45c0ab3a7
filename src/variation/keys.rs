//! The keys by which a motion is differentiated, along the run.

use super::contact_changes::ContactChanges;
use super::key_terms::KeyTerms;
use super::tangent::SceneTangent;
use crate::flow::{Change, Propagator, Series, SeriesBody};
use crate::scene::{Loads, Row, Scene};

/// The terms of the keys, and the derivatives read along the run.
#[derive(Debug)]
pub(super) struct Keys {
    pub terms: Vec<KeyTerms>,
    pub contacts: ContactChanges,
    pub motion: MotionChanges,
    pub loads: Loads,
    /// The largest |δq| (m) and |δq̇| (m/s) of each key so far.
    pub sizes: Vec<[f64; 2]>,
    change: Change,
    work: [Vec<f64>; 2],
}

/// The derivatives of displacements and velocities at given times.
#[derive(Debug)]
pub(super) struct MotionChanges {
    times: Vec<f64>,
    /// The number of times passed.
    pub passed: usize,
    probes: Vec<Row>,
    keys: usize,
    /// For each time, probe and key: m and m/s per unit of the key.
    pub displacement: Vec<f64>,
    pub velocity: Vec<f64>,
}

impl Keys {
    /// No keys.
    pub fn none(body: &SeriesBody) -> Self {
        Self {
            terms: Vec::new(),
            contacts: ContactChanges::new(0, 0),
            motion: MotionChanges::new(&[], Vec::new(), 0),
            loads: Loads::new(&[]),
            sizes: Vec::new(),
            change: Change::new(body),
            work: [vec![0.0; body.n], vec![0.0; body.n]],
        }
    }

    /// The keys of `tangents`, along a run of `scene`; displacements and velocities at `times` (s,
    /// increasing).
    pub fn new(scene: &Scene, body: &SeriesBody, tangents: &[SceneTangent], times: &[f64]) -> Self {
        let places: Vec<(Row, f64)> = scene.walls.iter().map(|wall| (wall.row().clone(), wall.position())).collect();
        let rows = body.rows.count();
        let probes = scene.probes.iter().map(|probe| probe.at.clone()).collect();
        Self {
            terms: tangents.iter().map(|tangent| KeyTerms::new(tangent.clone(), &places, rows)).collect(),
            contacts: ContactChanges::new(tangents.len(), scene.walls.len()),
            motion: MotionChanges::new(times, probes, tangents.len()),
            loads: Loads::new(&scene.loads),
            sizes: vec![[0.0; 2]; tangents.len()],
            ..Self::none(body)
        }
    }

    /// True where a key changes the two walls in different ways.
    pub fn differ(&self, a: usize, b: usize) -> bool {
        a != b && self.terms.iter().any(|terms| terms.differ(a, b))
    }

    /// Propagates the column of key number `column` over a stretch without events; false if there
    /// is no such key.
    pub fn pass(
        &mut self,
        column: usize,
        (flow, wall_of): (&mut Propagator, &[usize]),
        base: &Series,
        (q, v): (&mut [f64], &mut [f64]),
    ) -> bool {
        let Self { terms, contacts, motion, change, sizes, work: [work_q, work_v], .. } = self;
        let Some((terms, sizes)) = terms.get_mut(column).zip(sizes.get_mut(column)) else { return false };
        for (size, change) in sizes.iter_mut().zip([&*q, &*v]) {
            *size = change.iter().fold(*size, |most, x| most.max(x.abs()));
        }
        terms.begin(base, wall_of);
        let Propagator { body, hold, touching, scratch, .. } = flow;
        // Rounding errors must not move a row from its wall.
        let wall = |row: usize| wall_of.get(row).copied().unwrap_or(0);
        base.state(base.start(), work_q, work_v);
        hold.change(body, q, scratch, |held| -terms.offset(wall(held.row), work_q));
        hold.change(body, v, scratch, |held| -terms.along(wall(held.row), work_v));
        change.fill(body, base, (touching, hold), (q, v), terms, scratch);
        motion.read(column, base, change, terms, (work_q, work_v));
        let end = base.span();
        for (wall, share) in base.acting_shares() {
            contacts.add_impulse(wall, column, share * change.impulse(body, (touching, hold), wall, end));
        }
        change.state_at(end, q, v);
        true
    }

    /// Notes that all keys have passed `time` (s).
    pub fn passed(&mut self, time: f64) {
        let MotionChanges { times, passed, .. } = &mut self.motion;
        while times.get(*passed).is_some_and(|&t| t <= time) {
            *passed += 1;
        }
    }
}

impl MotionChanges {
    fn new(times: &[f64], probes: Vec<Row>, keys: usize) -> Self {
        let size = times.len() * probes.len() * keys;
        let values = || vec![f64::NAN; size];
        Self { times: times.to_vec(), passed: 0, probes, keys, displacement: values(), velocity: values() }
    }

    /// Reads the changes at the times that lie in the stretch of `base`.
    fn read(
        &mut self,
        column: usize,
        base: &Series,
        change: &Change,
        terms: &KeyTerms,
        (q, v): (&mut Vec<f64>, &mut Vec<f64>),
    ) {
        let mut changes = [q.clone(), v.clone()];
        for number in self.passed..self.times.len() {
            let Some(&time) = self.times.get(number).filter(|&&time| time <= base.end()) else { return };
            let [dq, dv] = &mut changes;
            change.state_at((time - base.start()) / base.unit(), dq, dv);
            base.state(time, q, v);
            for (probe, row) in self.probes.iter().enumerate() {
                let own = terms.tangent.probes.get(probe);
                let along = |change: &[f64], x: &[f64]| row.dot(change) + own.map_or(0.0, |own| own.dot(x));
                let index = (number * self.probes.len() + probe) * self.keys + column;
                if let (Some(a), Some(b)) = (self.displacement.get_mut(index), self.velocity.get_mut(index)) {
                    (*a, *b) = (along(dq, q), along(dv, v));
                }
            }
        }
    }

    /// Forgets what was read at `time` (s): an instant at which the velocity jumps.
    pub fn forget(&mut self, time: f64) {
        let size = self.probes.len() * self.keys;
        let at = |number: usize| self.times.get(number) == Some(&time);
        for number in (0..self.passed).rev().take_while(|&number| at(number)) {
            let values = number * size..(number + 1) * size;
            for list in [&mut self.displacement, &mut self.velocity] {
                list.get_mut(values.clone()).into_iter().flatten().for_each(|x| *x = f64::NAN);
            }
        }
    }
}
